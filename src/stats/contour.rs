//! 2σ contours of Gaussians in the plane, and of Gaussians in exponential coordinates, which exp maps to the plane.

use super::cross_track::MIN_RELATIVE_STD;
use super::moments::{CartesianMoments, ExponentialMoments};
use crate::geom::se2::SE2;
use crate::geom::sinc::sinc;
use crate::geom::unbend::{unbend, unbend_jacobian};
use crate::models::covariance_root;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use std::f64::consts::{PI, TAU};
use wide::f64x4;

/// Mahalanobis distance of the contours. A Gaussian in the plane has 1 − exp(−2²/2) = 86.5 % of its mass inside.
const CONTOUR_SIGMAS: f64 = 2.0;

/// Limit of 1 − ρ², with the correlation ρ of the coordinates, below which an ellipse counts as a line, because its width may be a rounding
/// error. A larger limit would turn narrow ellipses into lines. With a smaller limit, divisors could be rounding errors.
const MIN_UNCORRELATED_FRACTION: f64 = 1e-12;

/// 2σ ellipse of a Gaussian in two coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    centre: Vector2<f64>,
    /// Cholesky factor: lower triangular L with L·Lᵀ = covariance.
    cov_root: Matrix2<f64>,
    /// L⁻¹, with 0 for a coordinate in which the Gaussian has no extent.
    whitening_matrix: Matrix2<f64>,
}

impl Ellipse {
    /// Creates the ellipse around `centre` with covariance `cov` (symmetric, 2 × 2, in the squared units of the coordinates).
    pub fn new(centre: Vector2<f64>, cov: Matrix2<f64>) -> Self {
        let rounding_variance = MIN_RELATIVE_STD * MIN_RELATIVE_STD * (centre.norm_squared() + cov.trace());
        let std_or_zero =
            |variance: f64, min_variance: f64| if variance > min_variance { variance.sqrt() } else { 0.0 };
        let first_std = std_or_zero(cov[(0, 0)], rounding_variance);
        let cross_term = if first_std > 0.0 { cov[(1, 0)] / first_std } else { 0.0 };
        let second_std = std_or_zero(
            cov[(1, 1)] - cross_term * cross_term,
            rounding_variance.max(MIN_UNCORRELATED_FRACTION * cov[(1, 1)]),
        );
        let inverse_or_zero_of = |std: f64| if std > 0.0 { 1.0 / std } else { 0.0 };
        let (z, w) = (inverse_or_zero_of(first_std), inverse_or_zero_of(second_std));
        let whitening_matrix = Matrix2::new(z, 0.0, -cross_term * z * w, w);
        Self { centre, cov_root: Matrix2::new(first_std, 0.0, cross_term, second_std), whitening_matrix }
    }

    /// Creates the 2σ ellipse of the position (x, y), m.
    pub fn from_moments(cartesian_moments: &CartesianMoments) -> Self {
        Self::new(cartesian_moments.mean.xy(), cartesian_moments.cov.fixed_view::<2, 2>(0, 0).into_owned())
    }

    /// Returns true if the ellipse has an area, so that points can be inside. A line or a point has none.
    pub fn has_area(&self) -> bool {
        self.cov_root[(0, 0)] > 0.0 && self.cov_root[(1, 1)] > 0.0
    }

    /// Returns the area, in the unit of the first coordinate times that of the second; 0 for a line or a point.
    pub fn area(&self) -> f64 {
        PI * CONTOUR_SIGMAS * CONTOUR_SIGMAS * self.cov_root[(0, 0)] * self.cov_root[(1, 1)]
    }

    /// Returns true if the Gaussian has no extent at all.
    pub fn is_point(&self) -> bool {
        self.cov_root[(0, 0)] == 0.0 && self.cov_root[(1, 1)] == 0.0
    }

    /// Returns the closed outline as `segment_count` chords: `segment_count` + 1 points, the last equal to the first.
    pub fn boundary(&self, segment_count: usize) -> Vec<[f64; 2]> {
        unit_circle_points(segment_count)
            .map(|circle_point| (self.centre + self.cov_root * circle_point * CONTOUR_SIGMAS).into())
            .collect()
    }

    /// Returns the Mahalanobis distance of a point from the centre, in standard deviations.
    pub fn mahalanobis_distance(&self, [x, y]: [f64; 2]) -> f64 {
        (self.whitening_matrix * (Vector2::new(x, y) - self.centre)).norm()
    }

    /// Returns true if a point lies inside the ellipse.
    pub fn contains(&self, point: [f64; 2]) -> bool {
        let [x, y] = point.map(f64x4::splat);
        self.contains_four(x, y).any()
    }

    #[inline(always)]
    pub(super) fn contains_four(&self, x: f64x4, y: f64x4) -> f64x4 {
        if !self.has_area() {
            return f64x4::splat(0.0);
        }
        let (x, y) = (x - self.centre.x, y - self.centre.y);
        let z = x * self.whitening_matrix[(0, 0)];
        let w = x * self.whitening_matrix[(1, 0)] + y * self.whitening_matrix[(1, 1)];
        (z * z + w * w).simd_le(f64x4::splat(CONTOUR_SIGMAS * CONTOUR_SIGMAS))
    }
}

/// 2σ contour of a Gaussian N(m, Σ) in exponential coordinates.
///
/// A pose counts as inside if its coordinates (along, heading) are inside their 2σ ellipse. The outline in the plane approximates the
/// boundary of the image of the 2σ ellipsoid under exp. It is the image of a great circle of the ellipsoid. Without noise of the final
/// rotation γ̂, the ellipsoid is flat, and the great circle is its edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialContour {
    start_pose: SE2,
    mean: Vector3<f64>,
    /// 2σ ellipse in (along, heading), m, rad.
    pub ellipse: Ellipse,
    cov_root: Matrix3<f64>,
}

impl ExponentialContour {
    /// Creates the contour for `exponential_moments` of exponential coordinates about `start_pose`. The outline is in the reference frame of
    /// `start_pose`.
    pub fn new(exponential_moments: &ExponentialMoments, start_pose: &SE2) -> Self {
        let ExponentialMoments { mean, cov } = *exponential_moments;
        let along_heading = Matrix2::new(cov[(0, 0)], cov[(0, 2)], cov[(2, 0)], cov[(2, 2)]);
        Self {
            start_pose: *start_pose,
            mean,
            ellipse: Ellipse::new(Vector2::new(mean.x, mean.z), along_heading),
            cov_root: covariance_root(&cov).unwrap_or_else(|_| Matrix3::zeros()),
        }
    }

    /// Returns the closed outline in the plane as `segment_count` chords: `segment_count` + 1 points, the last equal to the first.
    pub fn boundary(&self, segment_count: usize) -> Vec<[f64; 2]> {
        self.iter_outline(segment_count).map(|(_, point)| point).collect()
    }

    /// Returns the closed outline, in the frame of the start, at a stage `morph` of the transition from positions to exponential
    /// coordinates. At stage 0 the outline is [`ExponentialContour::boundary`], and at stage 1 the boundary of `ellipse`.
    pub fn morphed_boundary(&self, segment_count: usize, morph: f64) -> Vec<[f64; 2]> {
        self.silhouette_twists(segment_count, morph).map(|twist| unbend(&twist, morph)).collect()
    }

    /// Returns the area of `ellipse`, which is in the plane, divided by the area of the outline of this contour. Both boundaries consist of
    /// `segment_count` chords. NaN if the ellipse, or the contour in (along, heading), has no area.
    ///
    /// Motions in reverse make the outline cross itself. The area is then the sum of the areas of the loops.
    #[inline(never)]
    pub fn area_ratio(&self, ellipse: &Ellipse, segment_count: usize) -> f64 {
        if !ellipse.has_area() || !self.ellipse.has_area() {
            return f64::NAN;
        }
        // The sum has twice the signed areas of the triangles from the start to each chord. The sign is reversed for motions in reverse.
        let (mut doubled_area, mut previous_point) = (0.0, [0.0; 2]);
        for (i, (along_coordinate, [x, y])) in self.iter_outline(segment_count).enumerate() {
            let [x, y] = [x - self.start_pose.x(), y - self.start_pose.y()];
            if i > 0 {
                let doubled_triangle_area = previous_point[0] * y - previous_point[1] * x;
                doubled_area +=
                    if along_coordinate < 0.0 { -doubled_triangle_area } else { doubled_triangle_area };
            }
            previous_point = [x, y];
        }
        // The ellipse also counts as a polygon of n chords, which has sinc(2π/n) times the area of the ellipse.
        ellipse.area() * sinc(TAU / segment_count as f64) / (0.5 * doubled_area.abs())
    }

    fn iter_outline(&self, segment_count: usize) -> impl Iterator<Item = (f64, [f64; 2])> {
        self.silhouette_twists(segment_count, 0.0)
            .map(|twist| (twist.x, self.start_pose.boxplus(twist).position()))
    }

    /// Returns twists on the silhouette of the 2σ ellipsoid, at a stage of the transition from positions to exponential coordinates.
    ///
    /// The ellipsoid is ξ = m + 2·G·u with |u| = 1, where G·Gᵀ is the covariance. H(ξ) is ∂position/∂ξ. On the silhouette u is
    /// perpendicular to the null vector k with H(ξ)·G·k = 0. The direction of k varies little over the ellipsoid. So the great circle
    /// perpendicular to the principal direction of k approximates the silhouette.
    fn silhouette_twists(&self, segment_count: usize, morph: f64) -> impl Iterator<Item = Vector3<f64>> {
        let twist_at = move |u: &Vector3<f64>| self.mean + self.cov_root * u * CONTOUR_SIGMAS;
        // Sum of k·kᵀ over the ends of the three axes of the ellipsoid. The null vector k is the cross product of the two rows of H·G.
        let mut null_direction_scatter = Matrix3::zeros();
        for ellipsoid_axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            for axis_end in [ellipsoid_axis, -ellipsoid_axis] {
                let jacobian = unbend_jacobian(&twist_at(&axis_end), morph) * self.cov_root;
                let null_direction = jacobian.row(0).transpose().cross(&jacobian.row(1).transpose());
                null_direction_scatter += null_direction * null_direction.transpose();
            }
        }
        let null_direction = principal_direction(&null_direction_scatter);
        // Two directions span the great circle. The coordinate axis least parallel to k makes the first direction well-conditioned.
        let least_parallel_axis = Matrix3::identity().column(null_direction.iamin()).into_owned();
        let circle_x =
            (least_parallel_axis - null_direction * least_parallel_axis.dot(&null_direction)).normalize();
        let circle_y = null_direction.cross(&circle_x);
        unit_circle_points(segment_count)
            .map(move |unit_vector| twist_at(&(circle_x * unit_vector.x + circle_y * unit_vector.y)))
    }

    /// Returns true if the exponential coordinates of `pose` lie inside the ellipse.
    pub fn contains(&self, pose: &SE2) -> bool {
        let twist = self.start_pose.motion_to(pose).log_near(self.mean.z);
        self.ellipse.contains([twist.x, twist.z])
    }
}

/// Returns the unit eigenvector of the largest eigenvalue of a symmetric, positive semidefinite matrix; (0, 1, 0) for the zero matrix. Ten
/// squarings raise the ratio of the eigenvalues to its 1024th power.
fn principal_direction(symmetric_matrix: &Matrix3<f64>) -> Vector3<f64> {
    let mut matrix_power = *symmetric_matrix;
    for _ in 0..10 {
        let largest_entry = matrix_power.amax();
        if largest_entry == 0.0 || !largest_entry.is_finite() {
            return Vector3::y();
        }
        matrix_power /= largest_entry;
        matrix_power *= matrix_power;
    }
    let longest_column =
        (0..3).map(|i| matrix_power.column(i).into_owned()).max_by(|a, b| a.norm().total_cmp(&b.norm()));
    longest_column.and_then(|matrix_column| matrix_column.try_normalize(0.0)).unwrap_or_else(Vector3::y)
}

fn unit_circle_points(segment_count: usize) -> impl Iterator<Item = Vector2<f64>> {
    (0..=segment_count).map(move |i| {
        // The last point has the angle of the first point, so that the outline is closed exactly.
        let (sin, cos) = libm::sincos(TAU * (i % segment_count) as f64 / segment_count as f64);
        Vector2::new(cos, sin)
    })
}
