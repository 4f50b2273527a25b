//! Statistics of a large cloud, in two passes over its poses, which are processed in groups of four.
//!
//! The first pass computes means and covariances. The second pass needs them for higher moments across the track, and for the fractions
//! inside the contours. Sums are compensated, and contain differences from a point near the mean. The relative error for ten million poses
//! is about 1e-13.

use super::contour::{Ellipse, ExponentialContour};
use super::cross_track::{CrossTrackStats, TrackMoments, track_products};
use super::gain::{FittedGaussians, FourRobots, LogDensityDifferences, MeanAndCov, MeasuredGain};
use super::moments::{CartesianMoments, ExponentialMoments, non_negative};
use super::sums::{CompensatedSums, PairSums, add_to_block};
use crate::geom::angle::wrap_angle;
use crate::geom::lanes::{LANE_COUNT, is_any_lane_set, split_into_lane_pairs};
use crate::geom::se2::SE2;
use nalgebra::{Matrix2, Matrix3, Vector3};
use std::f64::consts::{LN_2, PI, TAU};
use wide::{f64x2, f64x4};

/// Four poses with their logarithms (along, lateral, half heading), and the sine and cosine of the half heading. Sine and cosine with both
/// signs reversed describe the same heading.
#[derive(Clone, Copy)]
pub struct FourPoses {
    pub x: f64x4,
    pub y: f64x4,
    pub along: f64x4,
    pub lateral: f64x4,
    /// Half heading (half the heading angle) on the branch of the logarithm, rad.
    pub half_heading: f64x4,
    pub half_sin: f64x4,
    pub half_cos: f64x4,
    /// sinc of the half heading h: sin h/h.
    pub sinc: f64x4,
}

/// Arcs that end at the positions of four poses: signed length (m), half the turn φ (rad), and sinc(φ/2). Of all arcs to a position, it is
/// the arc whose turn is nearest to the commanded turn.
#[derive(Clone, Copy)]
pub struct FourArcs {
    pub arc_length: f64x4,
    pub half_turn: f64x4,
    pub sinc: f64x4,
}

/// Reference point of the sums, from which all coordinates are subtracted: x, y, along, lateral and half heading of a pose; length of the
/// arc to it, and half the turn of the arc.
pub type ReferencePoint = [f64; 7];

/// Factors that scale the two terms of the Jacobians to about 1, so that a product of many terms does not underflow. One term is
/// sinc(ξ_ω/2), with the turn ξ_ω of a twist. The other is |s|·sinc²(φ/2), with the length s and the turn φ of an arc.
pub type JacobianScale = [f64; 2];

/// First pass: sums for means, covariances and the mean logarithms of the Jacobians.
#[derive(Clone, Debug)]
pub struct FirstPass {
    reference_point: ReferencePoint,
    pub jacobian_scale: JacobianScale,
    summed_products: CompensatedSums<16>,
    /// Sums of the first two random numbers of variance 1 of each robot.
    pub unit_noise: PairSums,
    /// Corrections for robots whose arc in [`FourArcs`] is not the arc that they drove (see `NoisyDrive::end_points`). The sums of the
    /// noise count the driven arc. A correction adds the values of the arc in [`FourArcs`], and subtracts those of the driven arc.
    irregular_arcs: PairSums,
    /// Products of the scaled factors sinc(ξ_ω/2) and |s|·sinc²(φ/2) over a block, and sums of the logarithms of these products. One
    /// logarithm for a block takes hardly any time. The factors are on average above e⁻¹, so that a product is above 1e-111.
    jacobian_products: [f64x2; 2],
    log_jacobian_sums: [f64; 2],
}

impl FirstPass {
    pub fn new(reference_point: ReferencePoint, jacobian_scale: JacobianScale) -> Self {
        Self {
            reference_point,
            jacobian_scale,
            summed_products: CompensatedSums::new(),
            unit_noise: PairSums::new(),
            irregular_arcs: PairSums::new(),
            jacobian_products: [f64x2::splat(1.0); 2],
            log_jacobian_sums: [0.0; 2],
        }
    }

    /// Adds poses, and the first two random numbers of variance 1 of their robots. Only SIMD lanes that are set in `lane_mask` are added.
    #[inline(always)]
    pub fn add(&mut self, poses: &FourPoses, unit_noise: [f64x4; 2], lane_mask: f64x4) {
        self.unit_noise.add(unit_noise, lane_mask);
        let [x, y, along, lateral, half_heading, ..] = self.reference_point;
        let (sin, cos) = (poses.half_sin & lane_mask, poses.half_cos);
        let [x, y] = [(poses.x - x) & lane_mask, (poses.y - y) & lane_mask];
        let [a, l] = [(poses.along - along) & lane_mask, (poses.lateral - lateral) & lane_mask];
        let h = (poses.half_heading - half_heading) & lane_mask;
        let [xx, xy, yy] = [x * x, x * y, y * y];
        let [aa, al, ll, ah, lh, hh] = [a * a, a * l, l * l, a * h, l * h, h * h];
        let summed_terms = [x, y, a, l, h, xx, xy, yy, aa, al, ll, ah, lh, hh, sin * cos, sin * sin];
        add_to_block(&mut self.summed_products.block_sums, summed_terms);
    }

    #[inline(always)]
    pub fn multiply_jacobians(&mut self, poses: &FourPoses, four_arcs: &FourArcs) {
        let multiply_lanes = |factor_lanes: f64x4| {
            let [low_lanes, high_lanes] = split_into_lane_pairs(factor_lanes);
            low_lanes * high_lanes
        };
        let (twist_sincs, arc_sincs) = (multiply_lanes(poses.sinc), multiply_lanes(four_arcs.sinc));
        let [twist_scale, arc_scale] = self.jacobian_scale;
        self.jacobian_products[0] *= twist_sincs * (twist_scale * twist_scale);
        self.jacobian_products[1] *=
            multiply_lanes(four_arcs.arc_length) * (arc_sincs * arc_sincs) * (arc_scale * arc_scale);
    }

    /// Multiplies the products by the Jacobians of the poses in the SIMD lanes that are set in `lane_mask`.
    #[inline(never)]
    pub fn multiply_masked_jacobians(&mut self, poses: &FourPoses, four_arcs: &FourArcs, lane_mask: f64x4) {
        let masked_or_one = |lane_factors: f64x4| lane_mask.bitselect(lane_factors, f64x4::splat(1.0));
        let [twist, arc_length, arc_factor] =
            [poses.sinc, four_arcs.arc_length, four_arcs.sinc].map(masked_or_one);
        self.multiply_jacobians(
            &FourPoses { sinc: twist, ..*poses },
            &FourArcs { arc_length, sinc: arc_factor, ..*four_arcs },
        );
    }

    /// Adds the values of arcs that the robots did not drive, and subtracts those of the driven arcs (`regular_arcs`).
    #[inline(never)]
    pub fn add_irregular_arcs(&mut self, four_arcs: &FourArcs, regular_arcs: [f64x4; 2], lane_mask: f64x4) {
        let [.., arc_length, half_turn] = self.reference_point;
        self.irregular_arcs
            .add([four_arcs.arc_length - arc_length, four_arcs.half_turn - half_turn], lane_mask);
        self.irregular_arcs.subtract(regular_arcs, lane_mask);
    }

    pub fn flush_block(&mut self) {
        self.summed_products.flush_block();
        self.unit_noise.flush_block();
        self.irregular_arcs.flush_block();
        for (jacobian_product, log_sum) in self.jacobian_products.iter_mut().zip(&mut self.log_jacobian_sums)
        {
            let [a, b] = jacobian_product.to_array();
            *log_sum += libm::log((a * b).abs());
            *jacobian_product = f64x2::splat(1.0);
        }
    }

    /// Returns the moments of `pose_count` poses. The Cartesian covariance contains only the position. `regular_sums` are the sums over the
    /// driven arcs, in the order of [`PairSums`]; the corrections of [`FirstPass::add_irregular_arcs`] are added to them.
    pub fn moments(&self, pose_count: usize, regular_sums: [f64; 5]) -> FirstPassMoments {
        let n = pose_count as f64;
        let [x, y, a, l, h, xx, xy, yy, aa, al, ll, ah, lh, hh, sin_cos, sin_sin] =
            self.summed_products.totals();
        let irregular_sums = self.irregular_arcs.totals();
        let [s, t, ss, st, tt] = std::array::from_fn(|i| regular_sums[i] + irregular_sums[i]);
        let cov_of = |product_sum: f64, first_sum: f64, second_sum: f64| {
            if pose_count > 1 { (product_sum - first_sum * (second_sum / n)) / (n - 1.0) } else { f64::NAN }
        };
        let variance_of_sums = |square_sum: f64, coordinate_sum: f64| {
            non_negative(cov_of(square_sum, coordinate_sum, coordinate_sum))
        };
        let [x0, y0, along, lateral, half_heading, arc_length, half_turn] = self.reference_point;
        // Sums of sin θ and cos θ, by the formulas for double angles. They are rotated into the frame in which the reference point has the
        // heading 0.
        let (sin, cos) = libm::sincos(2.0 * half_heading);
        let (sum_sin, sum_cos) = (2.0 * sin_cos, n - 2.0 * sin_sin);
        let rotated_sums = (sum_sin * cos - sum_cos * sin, sum_cos * cos + sum_sin * sin);
        // If all headings equal the reference heading, the turn is exactly 0, which rounded sines might not give.
        let turn_from_reference = if hh == 0.0 { 0.0 } else { libm::atan2(rotated_sums.0, rotated_sums.1) };
        let mean_turn = 2.0 * half_heading + turn_from_reference;
        let position_cov = [variance_of_sums(xx, x), cov_of(xy, x, y), variance_of_sums(yy, y)];
        let [aa, al, ll] = [variance_of_sums(aa, a), cov_of(al, a, l), variance_of_sums(ll, l)];
        let [ah, lh, hh] = [2.0 * cov_of(ah, a, h), 2.0 * cov_of(lh, l, h), 4.0 * variance_of_sums(hh, h)];
        let [ss, st, tt] = [variance_of_sums(ss, s), 2.0 * cov_of(st, s, t), 4.0 * variance_of_sums(tt, t)];
        // The scale applies to all four SIMD lanes, including lanes without a pose.
        let scaled_lane_count = pose_count.next_multiple_of(LANE_COUNT) as f64;
        let [mean_log_twist, mean_log_arc] = [0, 1]
            .map(|i| (self.log_jacobian_sums[i] - scaled_lane_count * libm::log(self.jacobian_scale[i])) / n);
        FirstPassMoments {
            mean_position: [x0 + x / n, y0 + y / n],
            position_cov,
            mean_turn,
            resultant_length: libm::hypot(rotated_sums.0, rotated_sums.1) / n,
            exponential_moments: ExponentialMoments {
                mean: Vector3::new(along + a / n, lateral + l / n, 2.0 * (half_heading + h / n)),
                cov: Matrix3::new(aa, al, ah, al, ll, lh, ah, lh, hh),
            },
            arc_moments: (
                Vector3::new(arc_length + s / n, 2.0 * (half_turn + t / n), 0.0),
                Matrix3::new(ss, st, 0.0, st, tt, 0.0, 0.0, 0.0, 0.0),
            ),
            log_jacobians: [2.0 * mean_log_twist, mean_log_arc - LN_2],
        }
    }

    /// Returns the means as a better reference point if the sums have lost more than two digits by cancellation. That happens if the mean
    /// of a small cloud is many of its standard deviations away from the reference point.
    pub fn better_reference_point(&self, pose_count: usize) -> Option<ReferencePoint> {
        let n = pose_count as f64;
        let product_sums = self.summed_products.totals();
        let product_means = [0, 1, 2, 3, 4].map(|i| product_sums[i] / n);
        let mean_squares = [5, 7, 8, 10, 13].map(|i| product_sums[i] / n);
        let has_lost_digits = (0..5)
            .any(|i| product_means[i] * product_means[i] > 0.99 * mean_squares[i] && mean_squares[i] > 0.0);
        has_lost_digits
            .then(|| std::array::from_fn(|i| self.reference_point[i] + product_means.get(i).unwrap_or(&0.0)))
    }
}

#[derive(Clone, Copy, Debug)]
pub struct FirstPassMoments {
    mean_position: [f64; 2],
    position_cov: [f64; 3],
    /// Circular mean of the headings (rad), on the branch within π of the reference heading, and therefore not wrapped to (−π, π].
    mean_turn: f64,
    /// Length of the mean of the unit vectors in the directions of the headings.
    resultant_length: f64,
    pub exponential_moments: ExponentialMoments,
    arc_moments: MeanAndCov,
    /// Mean logarithms of the Jacobians of [`FourRobots`].
    log_jacobians: [f64; 2],
}

/// Second pass: sums for moments across the track, and counts of poses inside the contours.
#[derive(Clone, Debug)]
pub struct SecondPass {
    first_pass: FirstPassMoments,
    heading_sin_cos: (f64, f64),
    cartesian_ellipse: Ellipse,
    twist_ellipse: Ellipse,
    summed_products: CompensatedSums<17>,
}

#[derive(Clone, Copy, Debug)]
pub struct CloudStats {
    pub cartesian_moments: CartesianMoments,
    pub exponential: ExponentialMoments,
    pub cross_track: CrossTrackStats,
    /// Fractions of the poses inside the 2σ ellipse in (x, y) and inside the 2σ contour in exponential coordinates; NaN for a contour
    /// without area.
    pub fraction_in_ellipse: f64,
    pub fraction_in_exponential: f64,
    pub measured_gain: MeasuredGain,
    /// Standard error of the logarithm of the ratio of two areas: of the ellipse in (x, y) and of the exponential contour.
    pub log_area_ratio_error: f64,
}

impl SecondPass {
    /// Starts the second pass over the same poses, all of which were driven from `start_pose`.
    pub fn new(first_pass: FirstPassMoments, start_pose: &SE2) -> Self {
        let [xx, xy, yy] = first_pass.position_cov;
        Self {
            first_pass,
            heading_sin_cos: libm::sincos(first_pass.mean_turn),
            cartesian_ellipse: Ellipse::new(first_pass.mean_position.into(), Matrix2::new(xx, xy, xy, yy)),
            twist_ellipse: ExponentialContour::new(&first_pass.exponential_moments, start_pose).ellipse,
            summed_products: CompensatedSums::new(),
        }
    }

    /// Adds the poses in the SIMD lanes that are set in `lane_mask`.
    #[inline(always)]
    pub fn add(&mut self, poses: &FourPoses, lane_mask: f64x4) {
        let ([mean_x, mean_y], (sin, cos)) = (self.first_pass.mean_position, self.heading_sin_cos);
        let (x, y) = (poses.x - mean_x, poses.y - mean_y);
        let d = (y * cos - x * sin) & lane_mask;
        let a = (x * cos + y * sin) & lane_mask;
        let t = wrap_turns(poses.half_heading * 2.0 - self.first_pass.mean_turn) & lane_mask;
        // sin(θ − h) of the heading θ and the mean heading h, from the sine and cosine of θ/2.
        let theta_sin = poses.half_sin * poses.half_cos * 2.0;
        let theta_cos = 1.0 - poses.half_sin * poses.half_sin * 2.0;
        let s = (theta_sin * cos - theta_cos * sin) & lane_mask;
        let lane_counts = f64x4::splat(1.0) & lane_mask;
        let ellipse_counts = self.cartesian_ellipse.contains_four(poses.x, poses.y) & lane_counts;
        let contour_counts =
            self.twist_ellipse.contains_four(poses.along, poses.half_heading * 2.0) & lane_counts;
        let [ad, ad2, d2, d3, d4, d5, d6, ss, sd, sd2, sd3, t, tt, td] = track_products(a, d, s, t);
        let summed_terms =
            [ad, ad2, d2, d3, d4, d5, d6, ss, sd, sd2, sd3, t, tt, td, t * a, ellipse_counts, contour_counts];
        add_to_block(&mut self.summed_products.block_sums, summed_terms);
    }

    pub fn flush_block(&mut self) {
        self.summed_products.flush_block();
    }

    /// Returns the statistics of `pose_count` poses. `robot_groups` is a weighted subsample of the poses, from which the standard errors of
    /// the likelihood gain are computed.
    pub fn stats(
        &self,
        pose_count: usize,
        robot_groups: impl Iterator<Item = (FourPoses, FourArcs, f64x4)>,
    ) -> CloudStats {
        let n = pose_count as f64;
        let product_means = self.summed_products.totals().map(|coordinate_sum| coordinate_sum / n);
        let [products @ .., mean_ta, fraction_in_ellipse, inside_contour] = product_means;
        let [.., t, tt, td] = products;
        let FirstPassMoments { mean_position: [x, y], position_cov: [xx, xy, yy], .. } = self.first_pass;
        let (sin, cos) = self.heading_sin_cos;
        let bessel_factor = if pose_count > 1 { n / (n - 1.0) } else { f64::NAN };
        let [x_turn_cov, y_turn_cov, turn_variance] =
            [mean_ta * cos - td * sin, mean_ta * sin + td * cos, tt - t * t].map(|mean| bessel_factor * mean);
        let cov = Matrix3::new(xx, xy, x_turn_cov, xy, yy, y_turn_cov, x_turn_cov, y_turn_cov, turn_variance);
        let track_moments = TrackMoments {
            products,
            squared_extent: x * x + y * y + if pose_count > 1 { (xx + yy) / bessel_factor } else { 0.0 },
            resultant_length: self.first_pass.resultant_length,
        };
        let FirstPassMoments { exponential_moments, arc_moments, log_jacobians, .. } = self.first_pass;
        let fitted_gaussians = FittedGaussians::new(
            (Vector3::new(x, y, t), cov),
            (exponential_moments.mean, exponential_moments.cov),
            arc_moments,
            log_jacobians,
        );
        let mut density_differences = LogDensityDifferences::new(fitted_gaussians);
        for (poses, four_arcs, robot_weights) in robot_groups {
            let FourPoses { x, y, along, lateral, half_heading, sinc, .. } = poses;
            let turn_residual = wrap_turns(half_heading * 2.0 - self.first_pass.mean_turn);
            let four_robots = FourRobots {
                cartesian_points: [x, y, turn_residual],
                twist: [along, lateral, half_heading * 2.0],
                arc_points: [four_arcs.arc_length, four_arcs.half_turn * 2.0, f64x4::splat(0.0)],
                jacobians: [
                    sinc * sinc,
                    four_arcs.arc_length.abs() * 0.5 * (four_arcs.sinc * four_arcs.sinc),
                ],
            };
            density_differences.add(&four_robots, robot_weights);
        }
        let fraction_or_nan = |cartesian_ellipse: &Ellipse, share_inside: f64| {
            if cartesian_ellipse.has_area() { share_inside } else { f64::NAN }
        };
        CloudStats {
            cartesian_moments: CartesianMoments {
                mean: Vector3::new(x, y, wrap_angle(self.first_pass.mean_turn)),
                cov,
            },
            exponential: self.first_pass.exponential_moments,
            cross_track: CrossTrackStats::from_moments(pose_count, &track_moments),
            fraction_in_ellipse: fraction_or_nan(&self.cartesian_ellipse, fraction_in_ellipse),
            fraction_in_exponential: fraction_or_nan(&self.twist_ellipse, inside_contour),
            measured_gain: density_differences.measured_gain(pose_count),
            log_area_ratio_error: density_differences.log_area_ratio_error(pose_count),
        }
    }
}

/// Wraps differences of angles to [−π, π]. The differences must be in [−3π, 3π].
#[inline(always)]
fn wrap_turns(turn_residual: f64x4) -> f64x4 {
    let needs_wrapping = turn_residual.abs().simd_gt(f64x4::splat(PI));
    if is_any_lane_set(needs_wrapping) {
        needs_wrapping.bitselect(turn_residual - f64x4::splat(TAU).copysign(turn_residual), turn_residual)
    } else {
        turn_residual
    }
}
