//! Skewness across the track, which distinguishes a banana-shaped cloud from an ellipse.

use super::moments::mean_heading;
use crate::geom::se2::{SE2, wrap_angle};

/// Cross-track skew of a cloud with its standard error, and correlation of cross-track residual and heading.
///
/// The cross-track residual of a pose is its distance to the left of the mean position, perpendicular to the circular mean
/// heading h: d = −(x − x̄)·sin h + (y − ȳ)·cos h. All values are NaN if the residuals are all equal, or for fewer than three
/// poses. The skew of small samples is biased towards 0: of ten poses by about half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossTrack {
    /// Skewness m₃/m₂^1.5, with central moments over n. It is 0 for every Gaussian in (x, y).
    pub skew: f64,
    /// Standard error of `skew` by the delta method, from the moments of the sample up to the sixth. It includes the
    /// uncertainty of the mean heading.
    pub skew_error: f64,
    /// Correlation of d with the heading; NaN if one of them is constant.
    pub rho_heading: f64,
}

/// Standard deviation, relative to the extent and distance of the cloud, below which it counts as 0. Rounding is about 1e-16
/// per step. A larger bound would take narrow clouds for lines.
pub(super) const NO_SPREAD: f64 = 1e-12;

/// Variance (m²) below which a standard deviation also counts as 0. The sixth power of 10⁻⁵⁰ m nearly underflows, so that the
/// standard error would be 0.
const LEAST_SQUARE: f64 = 1e-100;

impl CrossTrack {
    /// Returns the statistics of `poses`, all in a frame whose origin they are near or spread around.
    pub fn from_poses(poses: &[SE2]) -> Self {
        let undefined = Self { skew: f64::NAN, skew_error: f64::NAN, rho_heading: f64::NAN };
        let [first, _, _, ..] = poses else { return undefined };
        let count = poses.len() as f64;
        let heading = mean_heading(poses);
        let (sin, cos) = libm::sincos(heading);
        let turned = |x: f64, y: f64| (x * cos + y * sin, y * cos - x * sin);

        let (mut x, mut y) = (0.0, 0.0);
        for pose in poses {
            x += pose.x() - first.x();
            y += pose.y() - first.y();
        }
        let (x, y) = (x / count, y / count);
        // (along, d, turn from the mean heading) of a pose.
        let residual = |pose: &SE2| {
            let (along, d) = turned(pose.x() - first.x() - x, pose.y() - first.y() - y);
            (along, d, wrap_angle(pose.theta() - heading))
        };

        let mut moments = TrackMoments::default();
        for (along, d, turn) in poses.iter().map(residual) {
            let (sin, cos) = libm::sincos(turn);
            moments.extent_squared += along * along + d * d;
            moments.along_d += along * d;
            moments.along_d2 += along * d * d;
            let mut power = 1.0;
            for (k, sum) in moments.d.iter_mut().enumerate() {
                *sum += power;
                if let Some(sum) = moments.sin_d.get_mut(k) {
                    *sum += sin * power;
                }
                power *= d;
            }
            moments.sin_sin += sin * sin;
            moments.turn += turn;
            moments.turn_turn += turn * turn;
            moments.turn_d += turn * d;
            moments.resultant += cos;
        }
        let mut moments = moments.divided_by(count);
        moments.extent_squared += (first.x() + x) * (first.x() + x) + (first.y() + y) * (first.y() + y);
        Self::from_moments(poses.len(), &moments)
    }

    /// Returns the statistics of `count` poses from their moments.
    pub(super) fn from_moments(count: usize, moments: &TrackMoments) -> Self {
        let TrackMoments { d: [.., m2, m3, _, _, _], sin_d, .. } = moments;
        let (m2, m3) = (*m2, *m3);
        if count < 3 || m2 <= (NO_SPREAD * NO_SPREAD * moments.extent_squared).max(LEAST_SQUARE) {
            return Self { skew: f64::NAN, skew_error: f64::NAN, rho_heading: f64::NAN };
        }
        let sd = m2.sqrt();
        let skew = m3 / (m2 * sd);
        // Rotating the axis by dh changes d by −along·dh. The influence of a pose on the mean heading is sin(turn)/resultant.
        let by_heading =
            3.0 * (skew * moments.along_d / m2 - moments.along_d2 / (m2 * sd)) / moments.resultant;
        // The influence of a pose on the skew is z³ − skew − 3z − 1.5·skew·(z² − 1) + by_heading·sin(turn), with z = d/sd. It
        // is a polynomial in d, so that its mean square is a sum of moments.
        let influence = [0.5 * skew, -3.0 / sd, -1.5 * skew / m2, 1.0 / (m2 * sd)];
        let mut squared = by_heading * by_heading * moments.sin_sin;
        for (i, a) in influence.iter().enumerate() {
            squared += 2.0 * by_heading * a * sin_d[i];
            for (j, b) in influence.iter().enumerate() {
                squared += a * b * moments.d[i + j];
            }
        }
        let heading_variance = moments.turn_turn - moments.turn * moments.turn;
        let rho_heading = if heading_variance > NO_SPREAD * NO_SPREAD {
            (moments.turn_d / (m2 * heading_variance).sqrt()).clamp(-1.0, 1.0)
        } else {
            f64::NAN
        };
        Self { skew, skew_error: (squared.max(0.0) / count as f64).sqrt(), rho_heading }
    }
}

/// Means over a cloud of products of residuals from the mean: `d` across the track, `along` along it, and `turn` of the heading.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct TrackMoments {
    /// Mean of the squared distance from the origin.
    pub extent_squared: f64,
    pub along_d: f64,
    pub along_d2: f64,
    /// Means of dᵏ for k = 0 … 6.
    pub d: [f64; 7],
    /// Means of sin(turn)·dᵏ for k = 0 … 3.
    pub sin_d: [f64; 4],
    pub sin_sin: f64,
    pub turn: f64,
    pub turn_turn: f64,
    pub turn_d: f64,
    /// Mean of cos(turn).
    pub resultant: f64,
}

impl TrackMoments {
    /// Returns means from sums over `count` poses.
    fn divided_by(&self, count: f64) -> Self {
        Self {
            extent_squared: self.extent_squared / count,
            along_d: self.along_d / count,
            along_d2: self.along_d2 / count,
            d: self.d.map(|sum| sum / count),
            sin_d: self.sin_d.map(|sum| sum / count),
            sin_sin: self.sin_sin / count,
            turn: self.turn / count,
            turn_turn: self.turn_turn / count,
            turn_d: self.turn_d / count,
            resultant: self.resultant / count,
        }
    }
}

/// Returns [`CrossTrack::skew`] of `poses`.
pub fn cross_track_skew(poses: &[SE2]) -> f64 {
    CrossTrack::from_poses(poses).skew
}
