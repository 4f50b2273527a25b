//! What a cloud says, as the widget shows it.

use crate::stats::fused::CloudFigures;
use crate::stats::{CartesianMoments, CrossTrack, ExponentialMoments, predicted_cross_track_skew};
use nalgebra::{ArrayStorage, Matrix3, Vector3};

/// What the shown samples say. Figures without meaning (no spread, too few
/// samples) are NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    pub cartesian: CartesianMoments,
    pub exponential: ExponentialMoments,
    pub cross_track: CrossTrack,
    /// The cross-track skew of the Gaussian with the exponential moments.
    pub gaussian_skew: f64,
    /// Shares of the samples inside the two 2σ contours.
    pub inside_ellipse: f64,
    pub inside_exponential: f64,
}

impl Figures {
    /// Of no cloud.
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
        }
    };

    /// Without a chart nothing is said in exponential coordinates.
    pub fn of(cloud: &CloudFigures, chart_holds: bool) -> Self {
        let CloudFigures { cartesian, exponential, cross_track, inside_ellipse, inside_exponential } = *cloud;
        let figures = Self {
            cartesian,
            exponential,
            cross_track,
            gaussian_skew: predicted_cross_track_skew(&exponential.mean, &exponential.cov),
            inside_ellipse,
            inside_exponential,
        };
        if chart_holds {
            return figures;
        }
        let (mean, cov) = (Vector3::repeat(f64::NAN), Matrix3::repeat(f64::NAN));
        let exponential = ExponentialMoments { mean, cov };
        Self { exponential, gaussian_skew: f64::NAN, inside_exponential: f64::NAN, ..figures }
    }
}
