//! Poses of the plane and their group, SE(2).
//!
//! Equation numbers are those of Solà, Deray and Atchuthan, "A micro Lie theory for state estimation in robotics", arXiv:1812.01537. Twists
//! and tangent vectors have the order (v_x, v_y, ω). Perturbations act on the right, in the body frame: x ⊞ τ = x · exp(τ).

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};
use std::ops::Mul;

pub use super::angle::wrap_angle;
use super::sinc::{sinc, unit_arc_end};

/// Pose of a body frame in a reference frame: position (x, y) in metres and heading θ in (−π, π] radians.
///
/// ```
/// use motion::geom::se2::SE2;
/// use nalgebra::Vector3;
///
/// let start = SE2::new(1.0, 2.0, 0.5);
/// let end = start.boxplus(Vector3::new(1.0, 0.0, 0.5));
/// assert!((end.boxminus(&start) - Vector3::new(1.0, 0.0, 0.5)).norm() < 1e-12);
/// assert!((start.inverse() * end).log().y.abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SE2 {
    x: f64,
    y: f64,
    theta: f64,
}

impl SE2 {
    /// Creates the pose at (x, y) with heading `theta`, which may be any angle and is wrapped.
    pub fn new(x: f64, y: f64, theta: f64) -> Self {
        Self { x, y, theta: wrap_angle(theta) }
    }

    /// Returns the identity, which is the pose of a frame in itself.
    pub const fn identity() -> Self {
        Self { x: 0.0, y: 0.0, theta: 0.0 }
    }

    /// Returns the position x, m.
    pub fn x(&self) -> f64 {
        self.x
    }

    /// Returns the position y, m.
    pub fn y(&self) -> f64 {
        self.y
    }

    pub(crate) fn position(&self) -> [f64; 2] {
        [self.x, self.y]
    }

    /// Returns the heading in (−π, π], radians.
    pub fn theta(&self) -> f64 {
        self.theta
    }

    /// Returns the exponential map of a twist (Solà et al., eq. 156): the pose after one unit of time at the constant body velocity `twist`
    /// = (v_x, v_y, ω), from the identity.
    ///
    /// The position is V(ω)·(v_x, v_y) with V = [sin ω/ω, −(1 − cos ω)/ω; (1 − cos ω)/ω, sin ω/ω]. The heading is ω, wrapped. The chord
    /// form of V needs no series near ω = 0. For |ω| ≤ π the error of a component is at most 4e-16 · max(1, ‖twist‖).
    pub fn exp(twist: &Vector3<f64>) -> Self {
        let (a, b) = unit_arc_end(twist.z);
        Self::new(a * twist.x - b * twist.y, b * twist.x + a * twist.y, twist.z)
    }

    /// Returns the logarithm (Solà et al., eq. 157), inverse of [`SE2::exp`]: the twist in (m, m, rad) with |ω| ≤ π.
    ///
    /// V⁻¹ = [h·cot h, h; −h, h·cot h] with h = θ/2. Like every logarithm of SE(2) it is discontinuous at the heading π.
    pub fn log(&self) -> Vector3<f64> {
        self.log_with_turn(self.theta)
    }

    /// Returns the logarithm whose ω is within π of `approximate_turn` (rad). `approximate_turn` is the approximate turn of a body that may
    /// have turned by more than half a circle. If the heading of this pose differs from `approximate_turn` by less than π, the result
    /// equals [`SE2::log`]. Near a turn of whole circles the logarithm grows without bound, unless the body is back at its start.
    pub fn log_near(&self, approximate_turn: f64) -> Vector3<f64> {
        self.log_with_turn(approximate_turn + wrap_angle(self.theta - approximate_turn))
    }

    fn log_with_turn(&self, turn: f64) -> Vector3<f64> {
        let (half_turn, h_cot_h) = (0.5 * turn, h_cot_h(turn));
        Vector3::new(h_cot_h * self.x + half_turn * self.y, h_cot_h * self.y - half_turn * self.x, turn)
    }

    /// Returns x ⊞ τ = x · exp(τ), which is this pose moved by a twist in its own body frame (Solà et al., eq. 25).
    pub fn boxplus(&self, twist: Vector3<f64>) -> Self {
        *self * Self::exp(&twist)
    }

    /// Returns x ⊟ y = log(y⁻¹ · x), the twist in the body frame of `other` that takes `other` to this pose (Solà et al., eq. 26).
    pub fn boxminus(&self, other: &Self) -> Vector3<f64> {
        other.motion_to(self).log()
    }

    /// Returns the inverse, which is the pose of the reference frame in the body frame.
    pub fn inverse(&self) -> Self {
        let (sin, cos) = libm::sincos(self.theta);
        Self::new(-cos * self.x - sin * self.y, sin * self.x - cos * self.y, -self.theta)
    }

    /// Returns x⁻¹ · y, which is the pose of `other` in the frame of this pose.
    pub(crate) fn motion_to(&self, other: &Self) -> Self {
        let (sin, cos) = libm::sincos(self.theta);
        let (x, y) = (-cos * self.x - sin * self.y, sin * self.x - cos * self.y);
        Self::new(
            x + (cos * other.x + sin * other.y),
            y + (cos * other.y - sin * other.x),
            wrap_angle(-self.theta) + other.theta,
        )
    }

    /// Returns the adjoint Ad (Solà et al., eq. 159), 3 × 3, with x · exp(τ) = exp(Ad τ) · x. The adjoint converts a twist from the body
    /// frame to the reference frame.
    pub fn adjoint(&self) -> Matrix3<f64> {
        let (sin, cos) = libm::sincos(self.theta);
        Matrix3::new(cos, -sin, self.y, sin, cos, -self.x, 0.0, 0.0, 1.0)
    }

    /// Returns the right Jacobian J_r (Solà et al., eq. 163), 3 × 3: exp(τ + δ) = exp(τ) · exp(J_r(τ)·δ) to first order in δ.
    ///
    /// The error of each entry is at most 4e-16 · max(1, ‖τ‖) for |ω| ≤ π. det J_r = sinc²(ω/2).
    pub fn right_jacobian(twist: &Vector3<f64>) -> Matrix3<f64> {
        let (a, b) = unit_arc_end(twist.z);
        let (c, half_sinc) = (sine_defect(twist.z), sinc(0.5 * twist.z));
        // (1 − cos ω)/ω², without the cancellation of 1 − cos ω.
        let d = 0.5 * (half_sinc * half_sinc);
        Matrix3::new(a, b, c * twist.x - d * twist.y, -b, a, d * twist.x + c * twist.y, 0.0, 0.0, 1.0)
    }

    /// Returns the inverse of the right Jacobian in closed form, 3 × 3: log(exp(τ) · exp(δ)) = τ + J_r⁻¹(τ)·δ to first order in δ.
    ///
    /// Entries have the accuracy of [`SE2::right_jacobian`] for |ω| ≤ π. They grow without bound towards |ω| = 2π.
    pub fn right_jacobian_inverse(twist: &Vector3<f64>) -> Matrix3<f64> {
        let (x, y, half_turn) = (twist.x, twist.y, 0.5 * twist.z);
        let (k, g) = (h_cot_h(twist.z), cotangent_defect(twist.z));
        Matrix3::new(k, -half_turn, g * x + 0.5 * y, half_turn, k, g * y - 0.5 * x, 0.0, 0.0, 1.0)
    }
}

impl Mul for SE2 {
    type Output = Self;

    /// Returns the composition of two poses (Solà et al., eq. 154). `other` is in the frame of `self`, and the result is in the reference
    /// frame of `self`.
    fn mul(self, other: Self) -> Self {
        let (sin, cos) = libm::sincos(self.theta);
        Self::new(
            self.x + (cos * other.x - sin * other.y),
            self.y + (sin * other.x + cos * other.y),
            self.theta + other.theta,
        )
    }
}

impl From<SE2> for [f64; 3] {
    fn from(SE2 { x, y, theta }: SE2) -> Self {
        [x, y, theta]
    }
}

impl From<[f64; 3]> for SE2 {
    fn from([x, y, theta]: [f64; 3]) -> Self {
        Self::new(x, y, theta)
    }
}

/// Returns h·cot h with h = ω/2. Near 0 a series is used, because the rounding error of the closed form would dominate the error of the
/// logarithm.
fn h_cot_h(turn: f64) -> f64 {
    if turn.abs() < MAX_SERIES_ANGLE {
        return 1.0 - turn * cotangent_defect(turn);
    }
    let (sin, cos) = libm::sincos(0.5 * turn);
    0.5 * turn * cos / sin
}

/// Maximum |ω| (rad) at which [`sine_defect`] and [`cotangent_defect`] are computed by series, because their closed forms cancel. At larger
/// angles the closed forms lose at most four bits. Their values are small there, so that this error vanishes in the sums that contain them.
/// A smaller bound would lose more bits, and a larger bound would need more terms.
const MAX_SERIES_ANGLE: f64 = 1.0;

/// Returns (ω − sin ω)/ω² = ω/3! − ω³/5! + ω⁵/7! − …
fn sine_defect(turn: f64) -> f64 {
    if turn.abs() >= MAX_SERIES_ANGLE {
        return (turn - libm::sin(turn)) / (turn * turn);
    }
    let turn_squared = turn * turn;
    // The series is evaluated by Horner's scheme in −ω². Each term is the previous term divided by (2k)(2k + 1). At |ω| = 1 the first
    // omitted term is 1/21! ≈ 2e-20.
    let mut series_sum = 1.0;
    for k in (2..=9).rev() {
        let k = f64::from(2 * k);
        series_sum = 1.0 - turn_squared / (k * (k + 1.0)) * series_sum;
    }
    turn / 6.0 * series_sum
}

/// Returns (1 − h·cot h)/ω with h = ω/2, which is ω/12 + ω³/720 + ω⁵/30240 + …
fn cotangent_defect(turn: f64) -> f64 {
    if turn.abs() >= MAX_SERIES_ANGLE {
        return (1.0 - h_cot_h(turn)) / turn;
    }
    /// Coefficients of the series: |B₂ₖ|/(2k)! for k = 1, 2, …, with Bernoulli numbers B. Each coefficient is about 1/(2π)² of the previous
    /// one. The first omitted coefficient is 1e-18.
    const SERIES_COEFFICIENTS: [f64; 10] = [
        1.0 / 12.0,
        1.0 / 720.0,
        1.0 / 30_240.0,
        1.0 / 1_209_600.0,
        1.0 / 47_900_160.0,
        691.0 / 1_307_674_368_000.0,
        1.0 / 74_724_249_600.0,
        3_617.0 / 10_670_622_842_880_000.0,
        43_867.0 / 5_109_094_217_170_944_000.0,
        174_611.0 / 802_857_662_698_291_200_000.0,
    ];
    let turn_squared = turn * turn;
    turn * SERIES_COEFFICIENTS.iter().rev().fold(0.0, |sum, coefficient| sum * turn_squared + coefficient)
}
