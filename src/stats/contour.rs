//! 2σ contours: of a Gaussian in the plane, and of one in exponential coordinates, pushed through exp.

use super::moments::{CartesianMoments, ExponentialMoments};
use crate::geom::se2::SE2;
use nalgebra::{Matrix2, Matrix2x3, Matrix3x2, Vector2, Vector3};
use std::f64::consts::TAU;

/// The contours are at two standard deviations: a Gaussian of the plane has 1 − exp(−2²/2) = 86.5 % of its mass inside.
const SIGMAS: f64 = 2.0;

/// The share of correlation that may be missing from ±1 before an ellipse has an area to speak of: what rounding
/// leaves of 1 − ρ². A larger bound would call needles lines, a smaller one would invert rounding.
const NO_AREA: f64 = 1e-12;

/// The 2σ ellipse of a Gaussian in two coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    centre: Vector2<f64>,
    /// Lower triangular L with L·Lᵀ the covariance.
    root: Matrix2<f64>,
}

impl Ellipse {
    /// The ellipse around `centre` with covariance `cov` (symmetric, 2 × 2, in the squared units of the coordinates).
    pub fn new(centre: Vector2<f64>, cov: Matrix2<f64>) -> Self {
        let first = cov[(0, 0)].max(0.0).sqrt();
        let shared = if first > 0.0 { cov[(1, 0)] / first } else { 0.0 };
        let left_over = cov[(1, 1)] - shared * shared;
        let second = if left_over > NO_AREA * cov[(1, 1)] { left_over.sqrt() } else { 0.0 };
        Self { centre, root: Matrix2::new(first, 0.0, shared, second) }
    }

    /// The ellipse of the position (x, y), m.
    pub fn from_moments(moments: &CartesianMoments) -> Self {
        Self::new(moments.mean.xy(), moments.cov.fixed_view::<2, 2>(0, 0).into_owned())
    }

    /// False where the Gaussian has no extent in some direction: a line or a point. Nothing is then inside.
    pub fn has_area(&self) -> bool {
        self.root[(0, 0)] > 0.0 && self.root[(1, 1)] > 0.0
    }

    /// The closed outline as `segments` chords: `segments` + 1 points, the last equal to the first.
    pub fn boundary(&self, segments: usize) -> Vec<[f64; 2]> {
        unit_circle(segments).map(|direction| (self.centre + self.root * direction * SIGMAS).into()).collect()
    }

    /// Whether the position of `pose` lies inside.
    pub fn contains(&self, pose: &SE2) -> bool {
        self.has_area() && self.whiten(Vector2::new(pose.x(), pose.y())).norm_squared() <= SIGMAS * SIGMAS
    }

    /// L⁻¹·(point − centre), with 0 for a coordinate in which the Gaussian has no extent.
    fn whiten(&self, point: Vector2<f64>) -> Vector2<f64> {
        let quotient = |value: f64, extent: f64| if extent > 0.0 { value / extent } else { 0.0 };
        let offset = point - self.centre;
        let first = quotient(offset.x, self.root[(0, 0)]);
        Vector2::new(first, quotient(offset.y - self.root[(1, 0)] * first, self.root[(1, 1)]))
    }
}

/// The 2σ contour in the plane of a Gaussian N(m, Σ) in exponential coordinates.
///
/// Three coordinates lead to two, so the contour is drawn through the most probable ξ for each direction of
/// displacement: with H the 2 × 3 Jacobian of position by ξ at m and L·Lᵀ = HΣHᵀ, it is the image under exp of
/// m + 2ΣHᵀL⁻ᵀ·(cos t, sin t). Where Σ has rank 2, as without γ̂, that is the 2σ ellipse of Σ itself, exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialContour {
    start: SE2,
    mean: Vector3<f64>,
    /// The 2σ ellipse of the linearized displacement H(ξ − m), around 0.
    displacement: Ellipse,
    /// H.
    jacobian: Matrix2x3<f64>,
    /// ΣHᵀL⁻ᵀ: from the whitened displacement to ξ − m.
    lift: Matrix3x2<f64>,
}

impl ExponentialContour {
    /// The contour of `moments`, whose chart is anchored at `start`; drawn in the frame of `start`'s coordinates.
    pub fn new(moments: &ExponentialMoments, start: &SE2) -> Self {
        let jacobian = position_jacobian(&moments.mean);
        let crossed = moments.cov * jacobian.transpose();
        let displacement = Ellipse::new(Vector2::zeros(), jacobian * crossed);
        let rows = crossed.row_iter().map(|row| displacement.whiten(row.transpose()).transpose());
        let lift = Matrix3x2::from_rows(&rows.collect::<Vec<_>>());
        Self { start: *start, mean: moments.mean, displacement, jacobian, lift }
    }

    /// False where the positions have no extent in some direction: a line or a point. Nothing is then inside.
    pub fn has_area(&self) -> bool {
        self.displacement.has_area()
    }

    /// The closed outline as `segments` chords: `segments` + 1 points, the last equal to the first.
    pub fn boundary(&self, segments: usize) -> Vec<[f64; 2]> {
        let outline = |direction: Vector2<f64>| {
            let pose = self.start.boxplus(self.mean + self.lift * direction * SIGMAS);
            [pose.x(), pose.y()]
        };
        unit_circle(segments).map(outline).collect()
    }

    /// Whether the position of `pose` lies inside the contour.
    pub fn contains(&self, pose: &SE2) -> bool {
        let step = self.start.inverse() * *pose;
        self.contains_step(&step, &step.log_near(self.mean.z))
    }

    /// As [`ExponentialContour::contains`] for a pose given in the frame of the start, with its exponential
    /// coordinates.
    ///
    /// Solves exp(m + lift·w) = position for w by Newton's method from the pose's own ξ, which is the solution already
    /// where Σ has rank 2; inside is |w| ≤ 2.
    pub fn contains_step(&self, step: &SE2, twist: &Vector3<f64>) -> bool {
        /// A correction of w below which only rounding is left of it.
        const ROUNDING: f64 = 1e-9;
        /// Each step squares the error: from a heading slack of a whole radian four suffice.
        const MOST_STEPS: usize = 6;
        if !self.has_area() {
            return false;
        }
        let mut w = self.displacement.whiten(self.jacobian * (twist - self.mean));
        for _ in 0..MOST_STEPS {
            let guess = self.mean + self.lift * w;
            let reached = SE2::exp(&guess);
            let residual = Vector2::new(step.x() - reached.x(), step.y() - reached.y());
            let Some(inverse) = (position_jacobian(&guess) * self.lift).try_inverse() else { break };
            let correction = inverse * residual;
            w += correction;
            // The corrections to come are smaller than this one: too small to cross the boundary.
            if correction.norm() < (w.norm() - SIGMAS).abs().max(ROUNDING) {
                break;
            }
        }
        w.norm() <= SIGMAS
    }
}

/// The 2 × 3 Jacobian of the position of exp(ξ) by ξ: the upper rows of R(ω)·J_r(ξ).
fn position_jacobian(twist: &Vector3<f64>) -> Matrix2x3<f64> {
    let rotation = SE2::new(0.0, 0.0, twist.z).adjoint();
    (rotation * SE2::right_jacobian(twist)).fixed_view::<2, 3>(0, 0).into_owned()
}

fn unit_circle(segments: usize) -> impl Iterator<Item = Vector2<f64>> {
    (0..=segments).map(move |i| {
        // The last index comes round to the first, so that the outline closes to the bit.
        let (sin, cos) = libm::sincos(TAU * (i % segments) as f64 / segments as f64);
        Vector2::new(cos, sin)
    })
}
