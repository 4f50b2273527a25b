//! Gain in log-likelihood of a Gaussian in exponential or arc coordinates over a Gaussian in (x, y, θ) or (x, y). The gain also detects
//! banana-shaped clouds without skew, which bend symmetrically to the left and right.

use super::cross_track::MIN_RELATIVE_STD;
use super::moments::non_negative;
use crate::geom::lanes::ln;
use crate::models::covariance_root;
use nalgebra::{Matrix3, Vector3};
use wide::f64x4;

/// Mean log-likelihood of a cloud under one Gaussian minus that under another Gaussian, in nats per robot. Each Gaussian has the cloud's
/// moments in its own coordinates. The densities are over the same measure, so that neither units nor the frame matter.
///
/// A gain is NaN if there are too few poses. It is also NaN if the Gaussian in (x, y, θ) has no volume, or the Gaussian in (x, y) no area.
/// It is infinite if only the Gaussian in exponential coordinates has no volume, or only the Gaussian in arc coordinates no area.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify))]
pub struct LikelihoodGain {
    /// Gain of a Gaussian in exponential coordinates ξ over a Gaussian in (x, y, θ): ½(ln det Σ_xyθ − ln det Σ_ξ) − mean of ln
    /// sinc²(ξ_ω/2). The densities are over dx dy dθ = sinc²(ξ_ω/2) dξ.
    pub pose: f64,
    /// Gain of a Gaussian in arc coordinates over a Gaussian in (x, y): ½(ln det Σ_xy − ln det Σ_sφ) − mean of ln(|s|·sinc²(φ/2)/2). Arc
    /// coordinates are the length s and the turn φ of the arc to the end position. The densities are over dx dy = |s|·sinc²(φ/2)/2 ds dφ.
    pub floor: f64,
}

/// Likelihood gain with its standard errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredGain {
    /// Gain of a Gaussian in exponential coordinates over one in (x, y, θ), and of a Gaussian in arc coordinates over one in (x, y).
    pub likelihood_gain: LikelihoodGain,
    /// Standard errors: the standard deviation, over all robots, of the difference of the two log-densities, divided by √n. The fitted
    /// moments add nothing to first order, because they maximize the likelihood of each Gaussian. NaN if the gain is not finite.
    pub gain_error: LikelihoodGain,
}

#[derive(Clone, Copy)]
pub(super) struct FourRobots {
    /// x and y (m), and the heading relative to the mean heading (rad).
    pub cartesian_points: [f64x4; 3],
    pub twist: [f64x4; 3],
    /// Length (m) and turn (rad) of the arc that ends at (x, y); the third component is 0.
    pub arc_points: [f64x4; 3],
    /// Jacobian determinants: dx dy dθ over dξ, and dx dy over ds dφ.
    pub jacobians: [f64x4; 2],
}

/// Gaussians fitted to a cloud or model, one in each of three coordinate systems.
#[derive(Clone, Copy, Debug)]
pub(super) struct FittedGaussians {
    cartesian: Gaussian,
    twist: Gaussian,
    arc: Gaussian,
    pub likelihood_gain: LikelihoodGain,
    mean_jacobian: f64,
}

pub(super) type MeanAndCov = (Vector3<f64>, Matrix3<f64>);

impl FittedGaussians {
    /// Fits the Gaussians to the moments of the coordinates in [`FourRobots`], given the mean logarithms of the Jacobians.
    pub fn new(cartesian: MeanAndCov, twist: MeanAndCov, arc: MeanAndCov, log_jacobians: [f64; 2]) -> Self {
        let (cartesian, twist, arc) =
            (Gaussian::new(&cartesian, 2), Gaussian::new(&twist, 2), Gaussian::new(&arc, 1));
        let gain_in = |dimensions: usize, curved_gaussian: &Gaussian| {
            let (cartesian, curved_gaussian) =
                (cartesian.log_volumes[dimensions - 1], curved_gaussian.log_volumes[dimensions - 1]);
            let likelihood_gain = cartesian - curved_gaussian - log_jacobians[3 - dimensions];
            // The gain is undefined if the Gaussian in (x, y, θ), or in (x, y), has no volume, up to rounding.
            if likelihood_gain > f64::NEG_INFINITY { likelihood_gain } else { f64::NAN }
        };
        let likelihood_gain = LikelihoodGain { pose: gain_in(3, &twist), floor: gain_in(2, &arc) };
        Self { cartesian, twist, arc, likelihood_gain, mean_jacobian: libm::exp(log_jacobians[1]) }
    }
}

/// Weighted sums over a subsample of the robots, for the standard errors of the likelihood gain and of the area ratio.
#[derive(Clone, Debug)]
pub(super) struct LogDensityDifferences {
    fitted_gaussians: FittedGaussians,
    weight_sums: f64x4,
    /// Sums of the squared deviations of the log-density difference from the gain: for (x, y, θ), and for (x, y). The mean difference is
    /// the gain of all robots. It needs no sum over the subsample.
    squared_deviations: [f64x4; 2],
    /// Sums of u, u², h·u and h² for [`LogDensityDifferences::log_area_ratio_error`]. u is the Jacobian divided by its geometric mean,
    /// minus 1. h is half the difference of the squared Mahalanobis distances in (x, y) and in arc coordinates.
    area_sums: [f64x4; 4],
}

impl LogDensityDifferences {
    pub fn new(fitted_gaussians: FittedGaussians) -> Self {
        Self {
            fitted_gaussians,
            weight_sums: f64x4::splat(0.0),
            squared_deviations: [f64x4::splat(0.0); 2],
            area_sums: [f64x4::splat(0.0); 4],
        }
    }

    /// Adds four robots with their weights; SIMD lanes without a robot have the weight 0.
    #[inline(never)]
    pub fn add(&mut self, four_robots: &FourRobots, robot_weights: f64x4) {
        let FittedGaussians { cartesian, twist, arc, likelihood_gain, mean_jacobian } =
            &self.fitted_gaussians;
        let has_robot = robot_weights.simd_gt(f64x4::splat(0.0));
        let cartesian_distances = cartesian.squared_distances(&four_robots.cartesian_points);
        let twist_distance = twist.squared_distances(&four_robots.twist)[2];
        let arc_distance = arc.squared_distances(&four_robots.arc_points)[1];
        let cartesian_log_volumes = [2, 1].map(|last_coordinate| cartesian.log_volumes[last_coordinate]);
        let (curved_log_volumes, likelihood_gains) =
            ([twist.log_volumes[2], arc.log_volumes[1]], [likelihood_gain.pose, likelihood_gain.floor]);
        let squared_distance_differences =
            [cartesian_distances[2] - twist_distance, cartesian_distances[1] - arc_distance];
        for i in 0..2 {
            let log_ratio = cartesian_log_volumes[i] - curved_log_volumes[i] - likelihood_gains[i];
            let log_density_differences =
                (squared_distance_differences[i] * 0.5 - ln(four_robots.jacobians[i]) + log_ratio)
                    & has_robot;
            self.squared_deviations[i] += log_density_differences * log_density_differences * robot_weights;
        }
        let (u, h) = (four_robots.jacobians[1] / *mean_jacobian - 1.0, squared_distance_differences[1] * 0.5);
        for (area_sum, added_term) in self.area_sums.iter_mut().zip([u, u * u, h * u, h * h]) {
            *area_sum += (added_term & has_robot) * robot_weights;
        }
        self.weight_sums += robot_weights;
    }

    /// Returns the likelihood gain of a cloud of `pose_count` poses, of which the added robots are a weighted subsample, with its standard
    /// errors.
    pub fn measured_gain(&self, pose_count: usize) -> MeasuredGain {
        let degrees_of_freedom = self.weight_sums.reduce_add() - 1.0;
        let [pose, floor] = self.squared_deviations.map(|squared_deviations| {
            (squared_deviations.reduce_add() / degrees_of_freedom / pose_count as f64).sqrt()
        });
        MeasuredGain {
            likelihood_gain: self.fitted_gaussians.likelihood_gain,
            gain_error: LikelihoodGain { pose, floor },
        }
    }

    /// Returns the standard error of ln(A/B) by the delta method. A is the area of the 2σ ellipse of the Gaussian in (x, y). B is the area
    /// in (x, y) that the 2σ ellipse of the Gaussian in arc coordinates covers.
    ///
    /// A is 4π√(det Σ_xy). B is 4π√(det Σ_sφ) times the mean over that ellipse of the Jacobian J of (x, y) with respect to arc coordinates.
    /// A uniform distribution on a 2σ ellipse has the covariance of its Gaussian. Therefore the mean of J over the ellipse equals its mean
    /// over the robots to third order. The influence of a robot on ln(A/B) is then ½(z² − w²) − J/mean J, up to a constant. Here z and w
    /// are the robot's Mahalanobis distances in (x, y) and in arc coordinates. The area of the outline in exponential coordinates has the
    /// same error as B to first order. With the presets the estimate is 0 to 14 % smaller than the standard deviation of the ratio.
    pub fn log_area_ratio_error(&self, pose_count: usize) -> f64 {
        let total_weight = self.weight_sums.reduce_add();
        let [u, uu, hu, hh] = self.area_sums.map(|area_sum| area_sum.reduce_add() / total_weight);
        let mean_jacobian = 1.0 + u;
        let influence_var = hh - 2.0 * hu / mean_jacobian + (uu - u * u) / (mean_jacobian * mean_jacobian);
        (non_negative(influence_var) / (total_weight - 1.0) * total_weight / pose_count as f64).sqrt()
    }
}

/// Gaussian in up to three dimensions, with its marginals in the first and the first two coordinates.
#[derive(Clone, Copy, Debug)]
struct Gaussian {
    mean: Vector3<f64>,
    /// Lower triangular L with L·Lᵀ = covariance, except that the diagonal has the reciprocals of the entries of L, or 0 for a direction
    /// without extent.
    cov_root: Matrix3<f64>,
    /// Three values of ½ ln det of the covariance: of the first, of the first two and of all three coordinates; −∞ if the determinant is 0
    /// up to rounding.
    log_volumes: [f64; 3],
}

impl Gaussian {
    /// Creates the Gaussian. The first `length_count` coordinates are in metres, the remaining coordinates in rad.
    #[inline(never)]
    fn new((mean, cov): &MeanAndCov, length_count: usize) -> Self {
        let squared_extent: f64 = (0..length_count).map(|i| mean[i] * mean[i] + cov[(i, i)]).sum();
        let mut cov_root = covariance_root(cov).unwrap_or_else(|_| Matrix3::zeros());
        let mut log_volume = 0.0;
        let log_volumes = std::array::from_fn(|j| {
            let pivot_std = cov_root[(j, j)];
            let is_flat =
                pivot_std <= MIN_RELATIVE_STD * if j < length_count { squared_extent.sqrt() } else { 1.0 };
            log_volume += if is_flat { f64::NEG_INFINITY } else { libm::log(pivot_std) };
            cov_root[(j, j)] = if is_flat { 0.0 } else { 1.0 / pivot_std };
            log_volume
        });
        Self { mean: *mean, cov_root, log_volumes }
    }

    /// Returns the squared Mahalanobis distances of four points: in the first coordinate, in the first two, and in all three.
    #[inline(never)]
    fn squared_distances(&self, four_points: &[f64x4; 3]) -> [f64x4; 3] {
        let mut centred_points: [f64x4; 3] = std::array::from_fn(|j| four_points[j] - self.mean[j]);
        let mut squared_distance = f64x4::splat(0.0);
        std::array::from_fn(|j| {
            let whitened_offset = centred_points[j] * self.cov_root[(j, j)];
            (j + 1..3).for_each(|row| centred_points[row] -= whitened_offset * self.cov_root[(row, j)]);
            squared_distance += whitened_offset * whitened_offset;
            squared_distance
        })
    }
}
