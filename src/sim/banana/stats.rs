//! Statistics of the cloud of the Banana Machine.

use super::{BananaMachine, OUTLINE_SEGMENTS};
use crate::geom::arc::arc_with_turn_near;
use crate::geom::se2::SE2;
use crate::js::js_structs;
use crate::models::OdomDelta;
use crate::sim::cloud::START_POSE;
use crate::stats::two_pass::CloudStats;
use crate::stats::{
    CartesianMoments, Ellipse, ExponentialContour, ExponentialMoments, LikelihoodGain,
    predicted_cross_track_skew,
};
use nalgebra::{Matrix3, Vector2, Vector3};

js_structs! {
    /// Statistics of the samples shown. They are NaN if all samples are equal, or if there are too few.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Stats {
        /// Number of samples shown.
        pub n: usize,
        /// Moments of the poses in (x, y, θ).
        pub cartesian: CartesianMoments,
        /// Moments of the poses in exponential coordinates about the start; NaN if the coordinates are undefined for the cloud.
        pub exponential: ExponentialMoments,
        /// Third standardized moment of the position across the mean heading; positive if the longer tail is to the left.
        pub cross_track_skew: f64,
        /// Standard error of the cross-track skew.
        pub cross_track_skew_error: f64,
        /// Cross-track skew of the Gaussian with the moments of the samples in exponential coordinates.
        pub gaussian_skew: f64,
        /// Correlation of cross-track position and heading, −1 to 1.
        pub rho_cross_heading: f64,
        /// Fractions of the samples inside the 2σ outlines of the Gaussians in (x, y) and in exponential coordinates.
        pub coverage: Coverage,
        /// Gains in mean log-likelihood: of a Gaussian in exponential coordinates over one in (x, y, θ), and of a Gaussian in arc
        /// coordinates over one in (x, y).
        pub likelihood_gain: LikelihoodGain,
        /// Standard errors of the two gains in mean log-likelihood.
        pub likelihood_gain_error: LikelihoodGain,
        /// Area of the 2σ ellipse in (x, y), divided by the area that the 2σ outline of the Gaussian in exponential coordinates has in (x,
        /// y).
        pub area_ratio: f64,
        /// Standard error of the area ratio.
        pub area_ratio_error: f64,
    }

    /// Coverage: fractions of the samples, from 0 to 1, inside the 2σ outlines.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Coverage {
        /// Fraction inside the ellipse in (x, y).
        pub ellipse: f64,
        /// Fraction inside the outline in exponential coordinates.
        pub exponential: f64,
    }
}

/// Flags that tell whether exponential and arc coordinates are defined for the turns of a cloud.
#[derive(Clone, Copy, Debug)]
pub struct DefinedCoordinates {
    /// True if exponential coordinates are defined.
    pub pose: bool,
    /// True if arc coordinates are defined: length and turn of the arc that ends at the robot.
    pub arc: bool,
}

impl Stats {
    /// Returns the statistics of a cloud of `n` samples. Statistics in coordinates that are undefined for the cloud are NaN.
    pub fn of_cloud(n: usize, cloud_stats: &CloudStats, defined_coordinates: DefinedCoordinates) -> Self {
        let CloudStats { cartesian_moments, cross_track, measured_gain, .. } = *cloud_stats;
        let one_or_nan_of = |is_defined: bool| if is_defined { 1.0 } else { f64::NAN };
        let [pose_factor, arc_factor] =
            [defined_coordinates.pose, defined_coordinates.arc].map(one_or_nan_of);
        let exponential = ExponentialMoments {
            mean: cloud_stats.exponential.mean * pose_factor,
            cov: cloud_stats.exponential.cov * pose_factor,
        };
        let gain_if_defined = |LikelihoodGain { pose, floor: plane_gain }: LikelihoodGain| LikelihoodGain {
            pose: pose * pose_factor,
            floor: plane_gain * arc_factor,
        };
        let ellipse = Ellipse::from_moments(&cartesian_moments);
        // The cross-track statistics are undefined if all positions are equal. Statistics of exponential coordinates may still be defined,
        // because the headings may differ.
        let shape_factor = one_or_nan_of(defined_coordinates.pose && !ellipse.is_point());
        let contour = ExponentialContour::new(&exponential, &START_POSE);
        let area_ratio = contour.area_ratio(&ellipse, OUTLINE_SEGMENTS);
        Self {
            n,
            cartesian: cartesian_moments,
            exponential,
            cross_track_skew: cross_track.skew,
            cross_track_skew_error: cross_track.skew_error,
            gaussian_skew: shape_factor * predicted_cross_track_skew(&exponential.mean, &exponential.cov),
            rho_cross_heading: cross_track.rho_heading,
            coverage: Coverage {
                ellipse: cloud_stats.fraction_in_ellipse,
                exponential: shape_factor * cloud_stats.fraction_in_exponential,
            },
            likelihood_gain: gain_if_defined(measured_gain.likelihood_gain),
            likelihood_gain_error: gain_if_defined(measured_gain.gain_error),
            area_ratio,
            area_ratio_error: area_ratio * cloud_stats.log_area_ratio_error,
        }
    }
}

js_structs! {
    /// Moments of the pose, in m and rad, and measures of how far the distribution of the pose is from a Gaussian.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct TableColumn {
        /// Mean pose, m, m, rad.
        pub mean: Vector3<f64> as "number[]",
        /// Covariance of the pose, 3 × 3.
        pub cov: Matrix3<f64> as "number[][]",
        /// Third standardized moment of the position across the mean heading.
        pub cross_track_skew: f64,
        /// Gains in mean log-likelihood: of a Gaussian in exponential coordinates over one in (x, y, θ), and of a Gaussian in arc
        /// coordinates over one in (x, y). Both gains are 0 for the linearization.
        pub likelihood_gain: LikelihoodGain,
        /// Area of the 2σ ellipse in (x, y), divided by that of the 2σ outline in exponential coordinates; 1 for the linearization.
        pub area_ratio: f64,
    }

    /// Moments of the pose by linearization, by quadrature and of the samples, and moments of its exponential coordinates.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Table {
        /// Noise-free end pose, and covariance to first order in the noise.
        pub linearized: TableColumn,
        /// Moments by quadrature.
        pub exact: TableColumn,
        /// Moments of the samples shown.
        pub measured: TableColumn,
        /// Commanded twist and covariance of its noise; null (None) under the odometry model, whose noise is not added to a twist.
        pub tangent: Option<ExponentialMoments>,
    }

    /// Curves over the cloud, as x, y pairs in m. Outlines are closed: the first point is repeated at the end. A curve is empty for fewer
    /// than two samples, or if its coordinates are undefined.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Contours {
        /// Arc driven without noise, from the start to its end; not closed.
        pub command: Vec<[f64; 2]> as "Float64Array",
        /// 2σ ellipse of the Gaussian fitted in (x, y).
        pub ellipse: Vec<[f64; 2]> as "Float64Array",
        /// 2σ ellipse of the covariance that an extended Kalman filter predicts by linearization at the command.
        pub linearized: Vec<[f64; 2]> as "Float64Array",
        /// 2σ outline of the Gaussian fitted in exponential coordinates.
        pub exponential: Vec<[f64; 2]> as "Float64Array",
        /// 2σ ellipse of the samples in exponential coordinates: along the track (m) and heading (rad).
        pub twist_ellipse: Vec<[f64; 2]> as "Float64Array",
        /// 2σ circle of a naive model that adds noise to the noise-free end. Its radius is 0.4 m for every command and noise.
        pub additive: Vec<[f64; 2]> as "Float64Array",
    }

    /// One sample, and the motion that it executed.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Sample as "Inspection" {
        /// End pose: x, y in m, θ in rad, in (−π, π].
        pub pose: [f64; 3] as "Float64Array",
        /// Exponential coordinates ξ: along and lateral in m, heading in rad.
        pub twist: [f64; 3] as "Float64Array",
        /// Speed along the arc, m/s; NaN under the odometry model, which has no arc.
        pub v_hat: f64,
        /// Turn rate along the arc, rad/s; NaN under the odometry model.
        pub omega_hat: f64,
        /// Rate of the final turn, rad/s over the same duration; NaN under the odometry model.
        pub gamma_hat: f64,
        /// Rotation, translation and rotation executed under the odometry model; null (None) under the velocity model.
        pub legs: Option<OdomDelta>,
        /// Path as x, y pairs in m from the start.
        pub path: Vec<[f64; 2]> as "Float64Array",
    }
}

/// Area of the 2σ ellipse divided by the area of the 2σ outline in exponential coordinates, below which the two nearly coincide, so that
/// [`BananaMachine::gaps`] returns none.
const MIN_AREA_RATIO: f64 = 1.15;

/// Minimum Mahalanobis distance, in exponential coordinates, from the mean to a gap: a point inside the 2σ ellipse of (x, y) where
/// practically no robot ends. One robot in 900 is at a larger distance from the mean.
const MIN_GAP_DISTANCE: f64 = 3.7;

/// Distance of a gap from the centre of the 2σ ellipse, as a fraction of the radius of the ellipse in this direction. A point at this
/// distance is clearly inside the ellipse.
const GAP_FRACTION: f64 = 0.95;

impl BananaMachine {
    /// Returns up to two gaps: points (x, y) in m that lie inside the 2σ ellipse of (x, y), but where practically no robot ends. One gap is
    /// behind the mean in the direction of travel, and one is beyond it. Each is the candidate on its side with the largest Mahalanobis
    /// distance in exponential coordinates.
    pub fn gaps(&self) -> Vec<[f64; 2]> {
        let Self { stats, .. } = self;
        if stats.area_ratio.is_nan() || stats.area_ratio < MIN_AREA_RATIO {
            return Vec::new();
        }
        let plane_ellipse = Ellipse::from_moments(&stats.cartesian);
        let contour = ExponentialContour::new(&stats.exponential, &START_POSE);
        let (ellipse_centre, twist_mean) = (stats.cartesian.mean.xy(), stats.exponential.mean);
        let gap_candidates: Vec<_> = plane_ellipse
            .boundary(OUTLINE_SEGMENTS)
            .into_iter()
            .map(|sampled_point| {
                let [x, y]: [f64; 2] =
                    (ellipse_centre + (Vector2::from(sampled_point) - ellipse_centre) * GAP_FRACTION).into();
                let (arc_length, turn) = arc_with_turn_near(&START_POSE, &SE2::new(x, y, 0.0), twist_mean.z);
                ([x, y], contour.ellipse.mahalanobis_distance([arc_length, turn]), arc_length < twist_mean.x)
            })
            .filter(|(_, gap_distance, _)| *gap_distance > MIN_GAP_DISTANCE)
            .collect();
        let find_furthest_candidate = |is_near_side: bool| {
            let candidates_of_side =
                gap_candidates.iter().filter(|(_, _, is_before)| *is_before == is_near_side);
            candidates_of_side.max_by(|(_, a, _), (_, b, _)| a.total_cmp(b))
        };
        let mut gaps: Vec<_> = [true, false].into_iter().filter_map(find_furthest_candidate).collect();
        gaps.sort_by(|(_, a, _), (_, b, _)| b.total_cmp(a));
        gaps.into_iter().map(|(sampled_point, _, _)| *sampled_point).collect()
    }
}
