//! Statistics of a cloud of the Banana Machine, as the widget shows them.

use super::OUTLINE_SEGMENTS;
use crate::geom::arc::ArcInversion;
use crate::geom::se2::SE2;
use crate::models::OdomDelta;
use crate::sim::cloud::START;
use crate::stats::fused::CloudFigures;
use crate::stats::{
    CartesianMoments, CrossTrack, Ellipse, ExponentialContour, ExponentialMoments, LikelihoodGain,
    MeasuredGain, predicted_cross_track_skew,
};
use nalgebra::{ArrayStorage, Matrix3, Vector3};

/// Statistics of the shown samples. They are NaN if all samples are equal, or if there are too few.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    pub cartesian: CartesianMoments,
    pub exponential: ExponentialMoments,
    pub cross_track: CrossTrack,
    /// Cross-track skew of the Gaussian with the moments of the samples in exponential coordinates.
    pub gaussian_skew: f64,
    /// Fraction of the samples inside the 2σ ellipse in (x, y).
    pub inside_ellipse: f64,
    /// Fraction of the samples inside the 2σ contour in exponential coordinates.
    pub inside_exponential: f64,
    /// Gain in mean log-likelihood of Gaussians in exponential and in arc coordinates over those in (x, y, θ) and (x, y).
    pub gain: MeasuredGain,
    /// Area of the 2σ ellipse in (x, y), divided by that of the 2σ outline of exponential coordinates in the plane.
    pub area_ratio: f64,
    /// Standard error of `area_ratio`.
    pub area_ratio_error: f64,
}

/// Coordinates that are defined for all turns of a cloud.
#[derive(Clone, Copy, Debug)]
pub struct Charted {
    /// True for exponential coordinates.
    pub pose: bool,
    /// True for the length and turn of the arc that ends at the robot.
    pub arc: bool,
}

impl Figures {
    /// Statistics of a cloud without samples.
    pub const NONE: Self = {
        let (mean, cov) = (
            Vector3::new(f64::NAN, f64::NAN, f64::NAN),
            Matrix3::from_array_storage(ArrayStorage([[f64::NAN; 3]; 3])),
        );
        Self {
            cartesian: CartesianMoments { mean, cov },
            exponential: ExponentialMoments { mean, cov },
            cross_track: CrossTrack { skew: f64::NAN, skew_error: f64::NAN, rho_heading: f64::NAN },
            gaussian_skew: f64::NAN,
            inside_ellipse: f64::NAN,
            inside_exponential: f64::NAN,
            gain: MeasuredGain { value: LikelihoodGain::NONE, error: LikelihoodGain::NONE },
            area_ratio: f64::NAN,
            area_ratio_error: f64::NAN,
        }
    };

    /// Returns the statistics of a cloud. Those in coordinates that are undefined for the cloud are NaN.
    pub fn of(cloud: &CloudFigures, charted: Charted) -> Self {
        let CloudFigures {
            cartesian,
            exponential,
            cross_track,
            inside_ellipse,
            inside_exponential,
            gain,
            log_area_error,
        } = *cloud;
        let ellipse = Ellipse::from_moments(&cartesian);
        let mut figures = Self { cartesian, cross_track, inside_ellipse, gain, ..Self::NONE };
        if charted.pose {
            figures.exponential = exponential;
            // The shape is undefined if all positions are equal. Exponential coordinates may then differ, because of the headings.
            if !ellipse.is_point() {
                figures.gaussian_skew = predicted_cross_track_skew(&exponential.mean, &exponential.cov);
                figures.inside_exponential = inside_exponential;
            }
            let contour = ExponentialContour::new(&exponential, &START);
            figures.area_ratio = contour.area_ratio(&ellipse, OUTLINE_SEGMENTS);
            figures.area_ratio_error = figures.area_ratio * log_area_error;
        } else {
            (figures.gain.value.pose, figures.gain.error.pose) = (f64::NAN, f64::NAN);
        }
        if !charted.arc {
            (figures.gain.value.floor, figures.gain.error.floor) = (f64::NAN, f64::NAN);
        }
        figures
    }
}

/// Statistics, and number of samples shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stats {
    pub n: usize,
    pub figures: Figures,
}

#[cfg(target_arch = "wasm32")]
impl serde::Serialize for Stats {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        #[derive(serde::Serialize)]
        struct Coverage {
            ellipse: f64,
            exponential: f64,
        }
        let Self { n, figures } = self;
        let coverage = Coverage { ellipse: figures.inside_ellipse, exponential: figures.inside_exponential };
        let mut stats = serializer.serialize_struct("Stats", 12)?;
        stats.serialize_field("n", n)?;
        stats.serialize_field("cartesian", &figures.cartesian)?;
        stats.serialize_field("exponential", &figures.exponential)?;
        stats.serialize_field("crossTrackSkew", &figures.cross_track.skew)?;
        stats.serialize_field("crossTrackSkewError", &figures.cross_track.skew_error)?;
        stats.serialize_field("gaussianSkew", &figures.gaussian_skew)?;
        stats.serialize_field("rhoCrossHeading", &figures.cross_track.rho_heading)?;
        stats.serialize_field("coverage", &coverage)?;
        stats.serialize_field("likelihoodGain", &figures.gain.value)?;
        stats.serialize_field("likelihoodGainError", &figures.gain.error)?;
        stats.serialize_field("areaRatio", &figures.area_ratio)?;
        stats.serialize_field("areaRatioError", &figures.area_ratio_error)?;
        stats.end()
    }
}

/// Moments of the pose, in m and rad, and measures of how far its distribution is from a Gaussian.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), serde(rename_all = "camelCase"))]
pub struct TableColumn {
    #[cfg_attr(
        target_arch = "wasm32",
        serde(serialize_with = "crate::stats::plain::vector"),
        tsify(type = "number[]")
    )]
    pub mean: Vector3<f64>,
    #[cfg_attr(
        target_arch = "wasm32",
        serde(serialize_with = "crate::stats::plain::matrix"),
        tsify(type = "number[][]")
    )]
    pub cov: Matrix3<f64>,
    pub cross_track_skew: f64,
    /// Gain; 0 for the linearization.
    pub likelihood_gain: LikelihoodGain,
    /// Ratio of the areas; 1 for the linearization.
    pub area_ratio: f64,
}

/// Moments of the pose by three methods, and moments of its exponential coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), tsify(missing_as_null))]
pub struct Table {
    /// Noise-free end pose, and covariance to first order in the noise.
    pub linearized: TableColumn,
    /// Moments by quadrature.
    pub exact: TableColumn,
    /// Moments of the samples shown.
    pub measured: TableColumn,
    /// Commanded twist and covariance of its noise; null (None) if the model has no such form.
    #[cfg_attr(target_arch = "wasm32", tsify(type = "Moments | null"))]
    pub tangent: Option<ExponentialMoments>,
}

/// Curves over the cloud, as (x, y) in m. Outlines are closed. They are empty for fewer than two samples, or if their
/// coordinates are undefined.
#[derive(Clone, Debug, PartialEq)]
pub struct Contours {
    /// Commanded arc, not closed.
    pub command: Vec<[f64; 2]>,
    pub ellipse: Vec<[f64; 2]>,
    /// 2σ ellipse of an EKF.
    pub linearized: Vec<[f64; 2]>,
    pub exponential: Vec<[f64; 2]>,
    /// 2σ ellipse of the coordinates along the track (m) and heading (rad) of the samples' twists.
    pub twist_ellipse: Vec<[f64; 2]>,
    /// The 2σ circle of noise that is added to the pose: see [`super::BananaMachine::additive`].
    pub additive: Vec<[f64; 2]>,
}

/// One sample in detail.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    pub pose: SE2,
    pub twist: Vector3<f64>,
    pub executed: Executed,
    /// Driven path, as (x, y) in m.
    pub path: Vec<[f64; 2]>,
}

/// Motion that a robot executed instead of the command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Executed {
    /// Arc and final turn, both of duration `dt` (s).
    Arc { arc: ArcInversion, dt: f64 },
    /// Three legs of the odometry model, which has no arc.
    Legs(OdomDelta),
}
