//! Skewness across the track, which distinguishes a banana-shaped cloud from an ellipse.

use super::moments::CartesianMoments;
use crate::geom::se2::{SE2, wrap_angle};
use std::ops::Mul;

/// Cross-track skew of a cloud with its standard error, and correlation of cross-track residual and heading.
///
/// The cross-track residual of a pose is its distance to the left of the mean position, perpendicular to the circular mean heading h: d =
/// −(x − x̄)·sin h + (y − ȳ)·cos h. All values are NaN if the residuals are all equal, or for fewer than three poses. The skew of a small
/// sample is biased towards 0, for ten poses by about half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossTrackStats {
    /// Skewness m₃/m₂^1.5 of the residual d, with central moments over n. It is 0 if (x, y) is Gaussian.
    pub skew: f64,
    /// Standard error of `skew` by the delta method, from the moments of the sample up to the sixth. It includes the
    /// uncertainty of the mean heading.
    pub skew_error: f64,
    /// Correlation of the residual d with the heading; NaN if one of them is constant.
    pub rho_heading: f64,
}

/// Relative limit below which a standard deviation counts as 0. It is multiplied by the extent of the cloud and the cloud's distance from
/// the origin. The rounding error of an operation is about 1e-16. With a larger bound narrow clouds would count as lines.
pub(super) const MIN_RELATIVE_STD: f64 = 1e-12;

/// Variance (m²) below which a standard deviation also counts as 0, because the standard error needs its sixth power, which must not
/// underflow.
const MIN_VARIANCE: f64 = 1e-100;

impl CrossTrackStats {
    const UNDEFINED: Self = Self { skew: f64::NAN, skew_error: f64::NAN, rho_heading: f64::NAN };

    /// Returns the statistics of `poses`, which must be near the origin.
    pub fn from_poses(poses: &[SE2]) -> Self {
        let CartesianMoments { mean, .. } = CartesianMoments::from_poses(poses);
        let (sin, cos) = libm::sincos(mean.z);
        let mut term_sums = [0.0; 16];
        for pose in poses {
            let (dx, dy, t) = (pose.x() - mean.x, pose.y() - mean.y, wrap_angle(pose.theta() - mean.z));
            let (s, c) = libm::sincos(t);
            let [products @ .., squared_distance, resultant_length] = &mut term_sums;
            let added_products = track_products(dx * cos + dy * sin, dy * cos - dx * sin, s, t);
            products.iter_mut().zip(added_products).for_each(|(sum, added_product)| *sum += added_product);
            *squared_distance += dx * dx + dy * dy;
            *resultant_length += c;
        }
        let [products @ .., squared_spread, resultant_length] = term_sums.map(|sum| sum / poses.len() as f64);
        let squared_extent = squared_spread + mean.xy().norm_squared();
        Self::from_moments(poses.len(), &TrackMoments { products, squared_extent, resultant_length })
    }

    pub(super) fn from_moments(pose_count: usize, track_moments: &TrackMoments) -> Self {
        let TrackMoments { products, squared_extent, resultant_length } = *track_moments;
        let [along_d, along_d2, m2, m3, d4, d5, d6, s2, s_d, s_d2, s_d3, t, tt, td] = products;
        if pose_count < 3 || m2 <= (MIN_RELATIVE_STD * MIN_RELATIVE_STD * squared_extent).max(MIN_VARIANCE) {
            return Self::UNDEFINED;
        }
        // Means of dᵏ for k = 0 … 6, and of sin(t)·dᵏ for k = 0 … 3. The means of d and of sin(t) are 0.
        let (d, sin_d) = ([1.0, 0.0, m2, m3, d4, d5, d6], [0.0, s_d, s_d2, s_d3]);
        let std = m2.sqrt();
        let skew = m3 / (m2 * std);
        // Rotating the mean heading by dh changes d by −along·dh. The influence of a pose on the mean heading is sin(turn)/resultant.
        let heading_influence = 3.0 * (skew * along_d / m2 - along_d2 / (m2 * std)) / resultant_length;
        // The influence of a pose on the skew is z³ − skew − 3z − 1.5·skew·(z² − 1) + heading_influence·sin(turn), with z = d/std. The
        // influence is a polynomial in d, so that its mean square is a sum of moments.
        let influence_polynomial = [0.5 * skew, -3.0 / std, -1.5 * skew / m2, 1.0 / (m2 * std)];
        let mut mean_squared_influence = heading_influence * heading_influence * s2;
        for (i, a) in influence_polynomial.iter().enumerate() {
            mean_squared_influence += 2.0 * heading_influence * a * sin_d[i];
            for (j, b) in influence_polynomial.iter().enumerate() {
                mean_squared_influence += a * b * d[i + j];
            }
        }
        let heading_variance = tt - t * t;
        let rho_heading = if heading_variance > MIN_RELATIVE_STD * MIN_RELATIVE_STD {
            (td / (m2 * heading_variance).sqrt()).clamp(-1.0, 1.0)
        } else {
            f64::NAN
        };
        Self { skew, skew_error: (mean_squared_influence.max(0.0) / pose_count as f64).sqrt(), rho_heading }
    }
}

/// Moments across the track: means of products of three residuals of a cloud. The residual d is across the mean heading, a is along it, and
/// t is that of the heading.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrackMoments {
    /// Means of the products that [`track_products`] returns.
    pub products: [f64; 14],
    /// Mean of the squared distance from the origin.
    pub squared_extent: f64,
    /// Mean of cos t: the resultant length of the headings.
    pub resultant_length: f64,
}

/// Returns the products ad, ad², d², …, d⁶, s², sd, sd², sd³, t², t² and td of the residuals of `TrackMoments`, with s = sin t.
#[inline(always)]
pub(super) fn track_products<T: Copy + Mul<Output = T>>(a: T, d: T, s: T, t: T) -> [T; 14] {
    let d2 = d * d;
    let d3 = d2 * d;
    [a * d, a * d2, d2, d3, d2 * d2, d2 * d3, d3 * d3, s * s, s * d, s * d2, s * d3, t, t * t, t * d]
}

/// Returns the cross-track skew of `poses`, which must be near the origin: see [`CrossTrackStats::skew`].
pub fn cross_track_skew(poses: &[SE2]) -> f64 {
    CrossTrackStats::from_poses(poses).skew
}
