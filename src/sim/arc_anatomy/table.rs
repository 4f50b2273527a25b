//! Values of each line of Table 5.1.

use super::Settings;
use super::stats::{Stats, selected_inversion, signed_inversion};
use crate::geom::arc::ArcInversion;
use crate::js::js_structs;

js_structs! {
    /// Values of the lines of Table 5.1. Line 4 is signed, unless the settings select the unsigned radius.
    ///
    /// μ, the centre and r* are infinite if the displacement is parallel to the heading. μ is NaN without a displacement.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Table as "AnatomyTable" {
        /// μ, x* (m), y* (m), r* (m), Δθ (rad), v̂ (m/s), ω̂ (rad/s), γ̂ (rad/s) and p.
        pub lines: [f64; 9],
        /// Midpoint of both positions, m. The centre is the midpoint plus μ times `normal`.
        pub middle: [f64; 2],
        /// Displacement rotated by a quarter turn to the left, m: (y − y′, x′ − x).
        pub normal: [f64; 2],
    }
}

impl Table {
    /// Computes the lines. With the displacement (a, b) in the frame of the start, line 1 is ½ · (−a)/(−b).
    pub(super) fn of(settings: &Settings, stats: &Stats) -> Self {
        let (start, next) = (settings.start(), settings.next());
        let displacement = start.between(&next);
        let inversion @ ArcInversion { v_hat, omega_hat, gamma_hat } = selected_inversion(settings);
        // The centre does not depend on the sign of the radius.
        let [x, y] = signed_inversion(settings).centre(&start).unwrap_or([f64::INFINITY; 2]);
        let turn = omega_hat * settings.command.dt;
        Self {
            lines: [
                // The quotient is halved last, because half of the smallest double is 0.
                0.5 * (displacement.x() / displacement.y()),
                x,
                y,
                inversion.radius(),
                turn,
                v_hat,
                omega_hat,
                gamma_hat,
                stats.prob,
            ],
            middle: [0.5 * (start.x() + next.x()), 0.5 * (start.y() + next.y())],
            normal: [start.y() - next.y(), next.x() - start.x()],
        }
    }
}
