//! What the inversion finds, and how likely that is.

use super::Settings;
use crate::geom::arc::{Arc, ArcInversion, invert_arc};
use crate::geom::se2::SE2;
use crate::models::MotionModel;
use crate::noise::{NoiseKind, Variance, joint};

/// An arc with its circle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    target_arch = "wasm32",
    derive(serde::Serialize, tsify::Tsify),
    serde(rename_all = "camelCase"),
    tsify(missing_as_null)
)]
pub struct Bend {
    /// m; negative in reverse.
    pub arc_length: f64,
    /// rad, positive to the left.
    pub turn: f64,
    /// m; positive with the center to the left of the heading, infinite where the arc is straight.
    pub radius: f64,
    /// m; null (None) where the arc is straight.
    #[cfg_attr(target_arch = "wasm32", serde(rename = "center"))]
    pub centre: Option<[f64; 2]>,
    /// x, y (m) and θ (rad) where it ends.
    pub end: [f64; 3],
}

impl Bend {
    /// The first part of the arc, a share of all of it, from its start.
    pub(super) fn arc(&self, start: SE2, share: f64) -> Arc {
        Arc { start, length: self.arc_length * share, turn: self.turn * share }
    }

    fn of(arc: &Arc) -> Self {
        let Arc { start, length, turn } = *arc;
        let rates = ArcInversion { v_hat: length, omega_hat: turn, gamma_hat: 0.0 };
        let end = arc.end();
        Self {
            arc_length: length,
            turn,
            radius: rates.radius(),
            centre: rates.centre(&start),
            end: [end.x(), end.y(), end.theta()],
        }
    }
}

/// One of the three factors of p.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), serde(rename_all = "camelCase"))]
pub struct Factor {
    /// v̂, ω̂ or γ̂ (m/s, rad/s).
    pub estimate: f64,
    /// v − v̂, ω − ω̂ or γ̂: what the table gives to `prob`.
    pub residual: f64,
    /// Standard deviation σ of the noise.
    pub deviation: f64,
    /// Residual over σ. Without noise it is 0 if the residual is 0 up to rounding, and infinite otherwise.
    pub deviations: f64,
    /// `prob` of the residual.
    pub value: f64,
    /// Ratio of `prob` at the residual to `prob` at 0, from 0 to 1.
    pub share: f64,
}

impl Factor {
    fn of(noise: NoiseKind, Residual { estimate, residual, variance }: Residual) -> Self {
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

/// Everything that is read beside the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    target_arch = "wasm32",
    derive(serde::Serialize, tsify::Tsify),
    serde(rename_all = "camelCase"),
    tsify(rename = "AnatomyStats", missing_as_null)
)]
pub struct Stats {
    pub commanded: Bend,
    /// The arc to the final position.
    pub inverted: Bend,
    /// The arc that v̂ and ω̂ drive: the inverted one, unless the radius is as printed.
    pub driven: Bend,
    /// γ̂Δt, the last turn, rad.
    pub last_turn: f64,
    /// Of v̂, ω̂ and γ̂.
    pub factors: [Factor; 3],
    /// Which of them is the most deviations off, from 0.
    pub weakest: usize,
    /// p, the product of the three.
    pub prob: f64,
    /// p over that of the pose without noise, from 0 to 1.
    pub share: f64,
    /// The density of the sampler over dx dy dθ; null (None) where a variance is 0.
    pub density: Option<f64>,
    /// ξ = next ⊟ start: along (m), lateral (m), heading (rad).
    pub xi: [f64; 3],
}

/// The arc to the final position, with a signed radius.
pub(super) fn inverted(settings: &Settings) -> ArcInversion {
    let executed = invert_arc(&settings.start(), &settings.next(), settings.command.dt);
    // A straight drive in reverse has the turn rate −0. Adding 0 makes it 0, so that no minus is shown.
    ArcInversion { omega_hat: executed.omega_hat + 0.0, ..executed }
}

/// As [`inverted`], or with the radius as Table 5.1 prints it, r* ≥ 0: v̂ = Δθ/Δt · r* has the sign of Δθ then, which is wrong
/// where the centre lies to the right of the heading.
pub(super) fn estimated(settings: &Settings) -> ArcInversion {
    let executed = inverted(settings);
    let ArcInversion { v_hat, omega_hat, .. } = executed;
    if !settings.printed || omega_hat == 0.0 {
        return executed;
    }
    ArcInversion { v_hat: v_hat.abs().copysign(omega_hat), ..executed }
}

/// What one of the three noises would have to explain.
struct Residual {
    estimate: f64,
    residual: f64,
    variance: Variance,
}

fn residuals(settings: &Settings, estimates: &ArcInversion) -> [Residual; 3] {
    let Settings { command, .. } = settings;
    let ArcInversion { v_hat, omega_hat, gamma_hat } = *estimates;
    let [v, omega, gamma] = settings.model().variances(command);
    [
        Residual { estimate: v_hat, residual: command.v - v_hat, variance: v },
        Residual { estimate: omega_hat, residual: command.omega - omega_hat, variance: omega },
        Residual { estimate: gamma_hat, residual: gamma_hat, variance: gamma },
    ]
}

/// p of the final pose.
pub(super) fn prob(settings: &Settings) -> f64 {
    joint(
        residuals(settings, &estimated(settings))
            .map(|Residual { residual, variance, .. }| settings.noise.prob(residual, variance)),
    )
}

impl Stats {
    pub(super) fn of(settings: &Settings) -> Self {
        let Settings { command, noise, .. } = settings;
        let (start, next, model) = (settings.start(), settings.next(), settings.model());
        let estimates = estimated(settings);
        let found = inverted(settings);
        let factors = residuals(settings, &estimates).map(|residual| Factor::of(*noise, residual));
        let off = |i: &usize| factors[*i].deviations.abs();
        let weakest = (0..3).rev().max_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0);
        let arc = |v: f64, omega: f64| Arc { start, length: v * command.dt, turn: omega * command.dt };
        Self {
            commanded: Bend::of(&arc(command.v, command.omega)),
            inverted: Bend::of(&arc(found.v_hat, found.omega_hat)),
            driven: Bend::of(&arc(estimates.v_hat, estimates.omega_hat)),
            last_turn: estimates.gamma_hat * command.dt,
            factors,
            weakest,
            prob: prob(settings),
            share: factors.iter().map(|factor| factor.share).product(),
            density: model.pose_density(&next, command, &start),
            xi: next.boxminus(&start).into(),
        }
    }
}
