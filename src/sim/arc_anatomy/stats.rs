//! Arc between the two poses, and likelihood of the final pose.

use super::Settings;
use crate::geom::arc::{Arc, ArcInversion, invert_arc};
use crate::geom::se2::SE2;
use crate::js::js_structs;
use crate::models::MotionModel;
use crate::noise::{NoiseKind, Variance, product_or_zero};

js_structs! {
    /// An arc with its circle.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct ArcWithCircle {
        /// Length, m; negative in reverse.
        pub arc_length: f64,
        /// Turn, rad, positive to the left.
        pub turn: f64,
        /// Radius, m; positive with the centre to the left of the heading, infinite for a straight arc.
        pub radius: f64,
        /// Centre, m; null (None) for a straight arc.
        #[cfg_attr(target_arch = "wasm32", serde(rename = "center"))]
        pub centre: Option<[f64; 2]>,
        /// End pose: x, y (m) and θ (rad).
        pub end: [f64; 3],
    }
}

impl ArcWithCircle {
    /// Returns the first part of the arc, up to this fraction of its length.
    pub(super) fn leading_part(&self, start: SE2, fraction: f64) -> Arc {
        Arc { start, length: self.arc_length * fraction, turn: self.turn * fraction }
    }

    fn of(arc: &Arc) -> Self {
        let Arc { start, length, turn } = *arc;
        let inversion = ArcInversion { v_hat: length, omega_hat: turn, gamma_hat: 0.0 };
        Self {
            arc_length: length,
            turn,
            radius: inversion.radius(),
            centre: inversion.centre(&start),
            end: arc.end().into(),
        }
    }
}

js_structs! {
    /// Factor of p, which is the product of three.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Factor {
        /// Estimated v̂, ω̂ or γ̂ (m/s, rad/s).
        pub estimate: f64,
        /// Residual v − v̂, ω − ω̂ or γ̂: the argument of `prob` in the table.
        pub residual: f64,
        /// Standard deviation σ of the noise.
        pub deviation: f64,
        /// Residual divided by σ. Without noise it is 0 if the residual is 0 up to rounding, and infinite otherwise.
        pub deviations: f64,
        /// `prob` of the residual.
        pub value: f64,
        /// Ratio of `prob` at the residual to `prob` at 0, from 0 to 1.
        pub share: f64,
    }
}

impl Factor {
    fn of(noise: NoiseKind, (estimate, residual, variance): (f64, f64, Variance)) -> Self {
        let (value, peak) = (noise.prob(residual, variance), noise.prob(0.0, variance));
        let deviation = variance.0.sqrt();
        let deviations = match (deviation == 0.0, value > 0.0) {
            (false, _) => residual / deviation,
            (true, true) => 0.0,
            (true, false) => f64::INFINITY.copysign(residual),
        };
        Self { estimate, residual, deviation, deviations, value, share: value / peak }
    }
}

js_structs! {
    /// Numbers that are shown next to the picture.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Stats as "AnatomyStats" {
        /// Arc of the command.
        pub commanded: ArcWithCircle,
        /// Arc to the final position.
        pub inverted: ArcWithCircle,
        /// Arc that v̂ and ω̂ drive: the inverted one, unless the radius is unsigned as printed.
        pub driven: ArcWithCircle,
        /// Final turn γ̂Δt, rad.
        pub last_turn: f64,
        /// Factors of v̂, ω̂ and γ̂.
        pub factors: [Factor; 3],
        /// Index of the factor whose residual is the most standard deviations from 0.
        pub weakest: usize,
        /// p, the product of the three factors.
        pub prob: f64,
        /// p relative to the p of the noise-free pose, from 0 to 1.
        pub share: f64,
        /// Density of the sampler over dx dy dθ; null (None) if a variance is 0.
        pub density: Option<f64>,
        /// ξ = next ⊟ start: along (m), lateral (m), heading (rad).
        pub xi: [f64; 3],
    }
}

/// Returns the arc to the final position, with a signed radius.
pub(super) fn signed_inversion(settings: &Settings) -> ArcInversion {
    let inversion = invert_arc(&settings.start(), &settings.next(), settings.command.dt);
    // A straight drive in reverse has the turn rate −0. Adding 0 makes it 0, so that no minus is shown.
    ArcInversion { omega_hat: inversion.omega_hat + 0.0, ..inversion }
}

/// Returns the inverted arc with the radius that the settings select. With the unsigned radius r* of Table 5.1,
/// v̂ = Δθ/Δt · r* has the sign of Δθ. That sign is wrong if the centre is to the right of the heading.
pub(super) fn selected_inversion(settings: &Settings) -> ArcInversion {
    let inversion = signed_inversion(settings);
    let ArcInversion { v_hat, omega_hat, .. } = inversion;
    if !settings.printed || omega_hat == 0.0 {
        return inversion;
    }
    ArcInversion { v_hat: v_hat.abs().copysign(omega_hat), ..inversion }
}

/// Returns the estimate, the residual and the variance of each of the three noises.
fn noise_residuals(settings: &Settings, estimates: &ArcInversion) -> [(f64, f64, Variance); 3] {
    let ArcInversion { v_hat, omega_hat, gamma_hat } = *estimates;
    let [v, omega, gamma] = settings.model().variances(&settings.command);
    [
        (v_hat, settings.command.v - v_hat, v),
        (omega_hat, settings.command.omega - omega_hat, omega),
        (gamma_hat, gamma_hat, gamma),
    ]
}

pub(super) fn prob(settings: &Settings) -> f64 {
    product_or_zero(
        noise_residuals(settings, &selected_inversion(settings))
            .map(|(_, residual, variance)| settings.noise.prob(residual, variance)),
    )
}

impl Stats {
    pub(super) fn of(settings: &Settings) -> Self {
        let Settings { command, noise, .. } = settings;
        let (start, next, model) = (settings.start(), settings.next(), settings.model());
        let estimated_controls = selected_inversion(settings);
        let inverted_arc = signed_inversion(settings);
        let factors =
            noise_residuals(settings, &estimated_controls).map(|residual| Factor::of(*noise, residual));
        let abs_deviation = |i: &usize| factors[*i].deviations.abs();
        let weakest = (0..3).rev().max_by(|a, b| abs_deviation(a).total_cmp(&abs_deviation(b))).unwrap_or(0);
        let arc = |v: f64, omega: f64| Arc { start, length: v * command.dt, turn: omega * command.dt };
        Self {
            commanded: ArcWithCircle::of(&arc(command.v, command.omega)),
            inverted: ArcWithCircle::of(&arc(inverted_arc.v_hat, inverted_arc.omega_hat)),
            driven: ArcWithCircle::of(&arc(estimated_controls.v_hat, estimated_controls.omega_hat)),
            last_turn: estimated_controls.gamma_hat * command.dt,
            factors,
            weakest,
            prob: prob(settings),
            share: factors.iter().map(|factor| factor.share).product(),
            density: model.pose_density(&next, command, &start),
            xi: next.boxminus(&start).into(),
        }
    }
}
