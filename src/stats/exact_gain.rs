//! Exact likelihood gain of a model, by quadrature over the two noises that turn the robot. The noise of the length has a closed form.

use super::exact::{ExactMoments, UnitMotionMoments};
use super::gain::{FittedGaussians, LikelihoodGain, MeanAndCov};
use super::moments::ExponentialMoments;
use super::quadrature::{Node, piecewise_nodes};
use crate::geom::angle::wrap_angle;
use crate::geom::sinc::sinc;
use crate::models::PolarMotion;
use crate::noise::NoiseKind;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{LN_2, PI, TAU};

/// Likelihood gain of a model, and the moments of its exponential coordinates, without sampling error. Robots start at the identity pose.
///
/// Exponential coordinates diverge at a turn of a full circle. Gaussian noise reaches it with some probability, so that the exact moments
/// of ξ are infinite. Turns beyond `MAX_SIGMAS` standard deviations are therefore omitted, which changes a variance by a fraction of 1e-7.
/// The values are NaN if a full circle is within `MAX_SIGMAS`.
///
/// Turns are not wrapped here. In the statistics of a cloud, however, turns of more than half a circle beyond the commanded turn are
/// wrapped. If many robots make such turns, [`LikelihoodGain::pose`] of the cloud differs from the exact gain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactGain {
    /// Gain of exponential coordinates over (x, y, θ), and of arc coordinates over (x, y), without sampling error.
    pub likelihood_gain: LikelihoodGain,
    /// Mean and covariance of ξ, on the branch of the turn that was made.
    pub exponential_moments: ExponentialMoments,
}

/// Integration limit of a normally distributed turn, in standard deviations. The largest of ten million samples is at 5.3 standard
/// deviations. A smaller limit would change the fourth digit. A larger limit would reach a full circle for commands whose clouds do not.
const MAX_SIGMAS: f64 = 6.0;

/// Break points for [`piecewise_nodes`] of a function that is smooth everywhere.
const NO_BREAKS: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Motion whose bearing is near half the commanded turn, and not wrapped to ±π.
struct BranchedMotion {
    polar_motion: PolarMotion,
    /// Mean of the change of heading, its standard deviation due to the noise of the bearing, and the standard deviation of the last turn
    /// on the spot, rad.
    turn_moments: [f64; 3],
}

impl ExactGain {
    /// Computes the exact likelihood gain and moments for one motion.
    pub fn new(polar_motion: &PolarMotion) -> Self {
        let PolarMotion {
            length: [length, length_std], bearing: [bearing, bearing_std], commanded_turn, ..
        } = *polar_motion;
        // The translation of an odometry reading is never negative. After a drive in reverse, the first rotation of the reading therefore
        // differs by half a circle.
        let half_circles = ((bearing - 0.5 * commanded_turn) / PI).round();
        let drive_sign = if libm::remainder(half_circles, 2.0) == 0.0 { 1.0 } else { -1.0 };
        let turn = commanded_turn + wrap_angle(polar_motion.mean_turn() - commanded_turn);
        let branched_motion = BranchedMotion {
            polar_motion: PolarMotion {
                length: [drive_sign * length, length_std],
                bearing: [bearing - half_circles * PI, bearing_std],
                ..*polar_motion
            },
            turn_moments: [turn, polar_motion.turn_per_bearing() * bearing_std, polar_motion.last_turn[1]],
        };
        branched_motion.compute_gain(&ExactMoments::new(polar_motion))
    }
}

impl BranchedMotion {
    fn compute_gain(&self, cartesian: &ExactMoments) -> ExactGain {
        let (mean_log_length, [bearing, bearing_std]) = (self.mean_log_length(), self.polar_motion.bearing);
        let (twist, twist_log_jacobian) = self.twist_moments();
        let (arc_moments, arc_log_jacobian) = self.arc_moments();
        let mean_log_jacobians = [twist_log_jacobian, mean_log_length + arc_log_jacobian - LN_2];
        let gaussians =
            FittedGaussians::new((cartesian.mean, cartesian.cov), twist, arc_moments, mean_log_jacobians);
        let [turn, bearing_turn_std, last_turn_std] = self.turn_moments;
        let one_or_nan_of =
            |turn: f64, max_excess_turn: f64| if turn.abs() + max_excess_turn < TAU { 1.0 } else { f64::NAN };
        let pose_factor = one_or_nan_of(turn, self.integration_limit(bearing_turn_std, last_turn_std));
        let floor_factor = one_or_nan_of(2.0 * bearing, self.integration_limit(2.0 * bearing_std, 0.0));
        let likelihood_gain = gaussians.likelihood_gain;
        ExactGain {
            likelihood_gain: LikelihoodGain {
                pose: likelihood_gain.pose * pose_factor,
                floor: likelihood_gain.floor * floor_factor,
            },
            exponential_moments: ExponentialMoments {
                mean: twist.0 * pose_factor,
                cov: twist.1 * pose_factor,
            },
        }
    }

    fn nodes_up_to_limit(&self, std: f64, break_points: [f64; 2]) -> Vec<Node> {
        if std == 0.0 {
            return vec![Node { node_value: 0.0, node_weight: 1.0 }];
        }
        piecewise_nodes(self.polar_motion.noise_kind, self.integration_limit(1.0, 0.0), break_points)
    }

    fn integration_limit(&self, first_std: f64, second_std: f64) -> f64 {
        match self.polar_motion.noise_kind {
            NoiseKind::Normal => MAX_SIGMAS * libm::hypot(first_std, second_std),
            NoiseKind::Triangular => 6f64.sqrt() * (first_std + second_std),
        }
    }

    /// Returns the moments of the exponential coordinates ξ, and the mean of ln sinc²(ξ_ω/2). A motion that ends at the distance r on the
    /// bearing β with the heading θ has ξ = r/sinc(θ/2) · (cos(β − θ/2), sin(β − θ/2)).
    fn twist_moments(&self) -> (MeanAndCov, f64) {
        let ([bearing, bearing_std], [turn, bearing_turn_std, last_turn_std]) =
            (self.polar_motion.bearing, self.turn_moments);
        let max_excess_turn = self.integration_limit(bearing_turn_std, last_turn_std);
        let (mut unit_moments, mut log_sum) = (UnitMotionMoments::default(), 0.0);
        let last_turn_nodes = self.nodes_up_to_limit(last_turn_std, NO_BREAKS);
        for bearing_node in self.nodes_up_to_limit(bearing_std, NO_BREAKS) {
            let bearing = bearing + bearing_std * bearing_node.node_value;
            let chord_ratio = if self.polar_motion.is_arc { sinc(bearing) } else { 1.0 };
            for turn_node in &last_turn_nodes {
                let excess_turn =
                    bearing_turn_std * bearing_node.node_value + last_turn_std * turn_node.node_value;
                let node_weight = bearing_node.node_weight * turn_node.node_weight;
                if excess_turn.abs() > max_excess_turn {
                    continue;
                }
                let half_turn = 0.5 * (turn + excess_turn);
                let twist_sinc = sinc(half_turn);
                let (sin, cos) = libm::sincos(bearing - half_turn);
                let scaled_direction =
                    [cos, sin].map(|direction_component| direction_component * (chord_ratio / twist_sinc));
                log_sum += node_weight * libm::log(twist_sinc * twist_sinc);
                unit_moments.add(node_weight, scaled_direction, excess_turn);
            }
        }
        let (mean, cov) = unit_moments.mean_and_cov(self.polar_motion.length);
        ((mean + Vector3::z() * turn, cov), log_sum / unit_moments.weight_sum)
    }

    /// Returns the moments of the length and turn φ of the arc that ends at the robot's final position. Also returns the
    /// mean of ln|c·sinc²(φ/2)|, with c the length of that arc divided by the driven length.
    fn arc_moments(&self) -> (MeanAndCov, f64) {
        let ([bearing, bearing_std], half_commanded_turn) =
            (self.polar_motion.bearing, 0.5 * self.turn_moments[0]);
        let (mut unit_moments, mut log_sum) = (UnitMotionMoments::default(), 0.0);
        // Statistics of a cloud use the arc whose turn is nearest to the commanded turn. This arc is driven in the opposite direction if
        // the bearing differs from half the commanded turn by more than π/2.
        let break_points = [-0.5 * PI, 0.5 * PI]
            .map(|bearing_offset| (half_commanded_turn + bearing_offset - bearing) / bearing_std);
        for noise_node in self.nodes_up_to_limit(bearing_std, break_points) {
            let driven_bearing = bearing + bearing_std * noise_node.node_value;
            let half_circles = ((driven_bearing - half_commanded_turn) / PI).round();
            let half_turn = driven_bearing - half_circles * PI;
            let drive_sign = if libm::remainder(half_circles, 2.0) == 0.0 { 1.0 } else { -1.0 };
            let arc_sinc = sinc(half_turn);
            let length_ratio =
                drive_sign * if self.polar_motion.is_arc { sinc(driven_bearing) } else { 1.0 } / arc_sinc;
            log_sum += noise_node.node_weight * libm::log((length_ratio * arc_sinc * arc_sinc).abs());
            unit_moments.add(noise_node.node_weight, [length_ratio, 0.0], 2.0 * (half_turn - bearing));
        }
        let (mean, cov) = unit_moments.mean_and_cov(self.polar_motion.length);
        let cov = Matrix3::new(cov[(0, 0)], cov[(0, 2)], 0.0, cov[(0, 2)], cov[(2, 2)], 0.0, 0.0, 0.0, 0.0);
        ((Vector3::new(mean.x, mean.z + 2.0 * bearing, 0.0), cov), log_sum / unit_moments.weight_sum)
    }

    fn mean_log_length(&self) -> f64 {
        let [mean, std] = self.polar_motion.length.map(f64::abs);
        if std == 0.0 {
            return libm::log(mean);
        }
        match self.polar_motion.noise_kind {
            NoiseKind::Normal => libm::log(std) + mean_log_abs_of_normal(mean / std),
            NoiseKind::Triangular => triangular_mean_log(mean, 6f64.sqrt() * std),
        }
    }
}

/// Returns E ln|m + Z| for a standard normal Z, to 1e-10.
///
/// (m + Z)² is noncentral χ² with one degree of freedom. It is a mixture of χ² with 1 + 2j degrees of freedom, where j has
/// a Poisson distribution of mean m²/2. The mean logarithm of χ² with 1 + 2j degrees is ln 2 + ψ(½ + j).
fn mean_log_abs_of_normal(m: f64) -> f64 {
    /// Value of m from which the fourth term of the asymptotic series is below 1e-10. The other method would fail for large m, because
    /// exp(−m²/2) underflows.
    const MIN_ASYMPTOTIC_MEAN: f64 = 30.0;
    const DIGAMMA_HALF: f64 = -1.963_510_026_021_423_5;
    if m > MIN_ASYMPTOTIC_MEAN {
        // The terms of the asymptotic series contain the moments E (Z/m)²ᵏ = (2k − 1)!!/m²ᵏ.
        let inverse_square = 1.0 / (m * m);
        return libm::log(m) - inverse_square * (0.5 + inverse_square * (0.75 + inverse_square * 2.5));
    }
    let poisson_mean = 0.5 * m * m;
    let (mut poisson_probability, mut digamma, mut mean_log) = (libm::exp(-poisson_mean), DIGAMMA_HALF, LN_2);
    // The sum over j ends twelve standard deviations or more beyond the mean of the Poisson distribution, which is at most 450.
    for j in 0..720 {
        let j = f64::from(j);
        mean_log += poisson_probability * digamma;
        poisson_probability *= poisson_mean / (j + 1.0);
        digamma += 1.0 / (j + 0.5);
    }
    0.5 * mean_log
}

/// Returns E ln|m + T| to 1e-14, with T triangular on ±`half_width`. For m far from 0 it is a series of moments of T. Otherwise it is a
/// second difference of the second antiderivative of the logarithm, because T is a sum of two uniform numbers.
fn triangular_mean_log(m: f64, half_width: f64) -> f64 {
    if half_width < 0.5 * m {
        let ratio_squared = (half_width / m) * (half_width / m);
        let (mut ratio_power, mut series_sum) = (1.0, libm::log(m));
        for k in 1..=24 {
            let even_index = f64::from(2 * k);
            ratio_power *= ratio_squared;
            series_sum -= 2.0 * ratio_power / (even_index * (even_index + 1.0) * (even_index + 2.0));
        }
        return series_sum;
    }
    let antiderivative_at = |x: f64| if x == 0.0 { 0.0 } else { x * x * (0.5 * libm::log(x.abs()) - 0.75) };
    (antiderivative_at(m + half_width) - 2.0 * antiderivative_at(m) + antiderivative_at(m - half_width))
        / (half_width * half_width)
}
