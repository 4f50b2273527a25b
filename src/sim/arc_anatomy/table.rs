//! Table 5.1 line by line.

use super::Settings;
use super::figures::{Stats, estimated, inverted};
use crate::geom::arc::ArcInversion;

/// Values of the lines of Table 5.1, in their order; line 4 is signed unless the settings ask for it as printed.
///
/// Where the displacement is parallel to the heading μ, the centre and r* are infinite, and where there is none μ is NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    target_arch = "wasm32",
    derive(serde::Serialize, tsify::Tsify),
    serde(rename_all = "camelCase"),
    tsify(rename = "AnatomyTable")
)]
pub struct Table {
    /// μ, x* (m), y* (m), r* (m), Δθ (rad), v̂ (m/s), ω̂ (rad/s), γ̂ (rad/s) and p.
    pub lines: [f64; 9],
    /// The middle between both positions, from which the centre is μ times `normal` away, m.
    pub middle: [f64; 2],
    /// (y − y′, x′ − x): the displacement turned by a quarter, to the left, m.
    pub normal: [f64; 2],
}

impl Table {
    /// With (a, b) the displacement in the frame of the start, the numerator of line 1 is −a and its denominator −b.
    pub(super) fn of(settings: &Settings, stats: &Stats) -> Self {
        let (start, next) = (settings.start(), settings.next());
        let step = start.inverse() * next;
        let executed @ ArcInversion { v_hat, omega_hat, gamma_hat } = estimated(settings);
        // The centre is where it is, whatever sign its distance is printed with.
        let [x, y] = inverted(settings).centre(&start).unwrap_or([f64::INFINITY; 2]);
        let turn = omega_hat * settings.command.dt;
        Self {
            lines: [
                // The half of the smallest double would be 0.
                0.5 * (step.x() / step.y()),
                x,
                y,
                executed.radius(),
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
