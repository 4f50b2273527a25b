//! Circular arcs driven from a pose, in the chord form.
//!
//! A robot at the origin with heading 0 that drives the signed length `s` while turning by `φ` ends at distance
//! s · sinc(φ/2) on the bearing φ/2. That is the chapter's arc update with the radius r = s/φ cancelled: it needs no
//! straight-line branch and loses no digits as φ → 0, where the centre of the circle runs off to infinity.

use super::angle::wrap_angle;
use super::se2::SE2;
use super::sinc::{chord_factors, sinc};

/// The end (x, y) of an arc of signed length `length` (m) that turns by `turn` (rad), in the frame of its start:
/// x forward, y left. (s·sin φ/φ, s·(1 − cos φ)/φ), with (1 − cos φ)/φ = sin(φ/2)·sinc(φ/2).
pub fn chord(length: f64, turn: f64) -> (f64, f64) {
    let (forward, left) = chord_factors(turn);
    (length * forward, length * left)
}

/// The controls that one pose pair implies: an arc at (v̂, ω̂), then a final rotation at the rate γ̂.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcInversion {
    /// Translational velocity along the arc, m/s; negative where the robot reversed.
    pub v_hat: f64,
    /// Rotational velocity along the arc, rad/s, with |ω̂·Δt| ≤ π.
    pub omega_hat: f64,
    /// The heading that the arc leaves unexplained, as a rate over Δt, rad/s, with |γ̂·Δt| ≤ π.
    pub gamma_hat: f64,
}

/// The arc that leaves `x` along its heading and reaches the position of `x_next` in `dt` seconds (Table 5.1, lines
/// 1–8, with a signed radius).
///
/// With the displacement in the frame of `x` at distance d and bearing β, the arc turns by φ = 2β and
/// v̂Δt = d / sinc(β). Of the arcs of that circle (it can be driven either way, and more than once round) this is the
/// one with |φ| ≤ π: forward where the displacement points ahead, in reverse where it points behind.
/// γ̂ = wrap(θ′ − θ − φ)/Δt.
///
/// Without displacement every arc of length 0 serves; the turn on the spot that leaves γ̂ = 0 is taken.
///
/// `dt` > 0. Frames: both poses in the same frame; the result does not depend on which.
pub fn invert_arc(x: &SE2, x_next: &SE2, dt: f64) -> ArcInversion {
    let step = x.inverse() * *x_next;
    let distance = libm::hypot(step.x(), step.y());
    if distance == 0.0 {
        return ArcInversion { v_hat: 0.0, omega_hat: step.theta() / dt, gamma_hat: 0.0 };
    }
    let direction = if step.x() < 0.0 { -1.0 } else { 1.0 };
    let bearing = libm::atan2(direction * step.y(), direction * step.x());
    let turn = 2.0 * bearing;
    ArcInversion {
        v_hat: direction * distance / sinc(bearing) / dt,
        omega_hat: turn / dt,
        gamma_hat: wrap_angle(step.theta() - turn) / dt,
    }
}
