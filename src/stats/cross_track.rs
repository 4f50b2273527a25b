//! The statistic that tells a banana from an ellipse: skewness across the track.

use super::moments::mean_heading;
use crate::geom::se2::{SE2, wrap_angle};

/// Cross-track skew of a cloud, how far to trust it, and how cross-track error and heading go together.
///
/// The cross-track residual of a pose is its distance to the left of the mean position, measured perpendicular to
/// the circular mean heading h: d = −(x − x̄)·sin h + (y − ȳ)·cos h. Every figure is NaN where the cloud has no
/// cross-track spread (all on one line along h), and for fewer than three poses, of which any two are alike in shape.
/// Small samples understate skew: at ten poses by about half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossTrack {
    /// m₃/m₂^1.5 with moments over n. 0 for every Gaussian in (x, y).
    pub skew: f64,
    /// Standard error of `skew` by the delta method, from the sample's own moments up to the sixth, the uncertainty
    /// of the mean heading included.
    pub skew_error: f64,
    /// Correlation of d with the heading; NaN also where the headings have no spread.
    pub rho_heading: f64,
}

/// A spread below this fraction of the cloud's extent and distance is rounding and counts as none. Doubles leave
/// about 1e-16 of those a step; a larger bound would begin to call narrow clouds lines.
pub(super) const NO_SPREAD: f64 = 1e-12;

impl CrossTrack {
    /// The figures of `poses`, all in one frame in which they are near the origin or spread around it.
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

        let (mut aa, mut dd, mut ddd, mut ad, mut add) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let (mut t, mut tt, mut dt, mut resultant) = (0.0, 0.0, 0.0, 0.0);
        for (along, d, turn) in poses.iter().map(residual) {
            aa += along * along;
            dd += d * d;
            ddd += d * d * d;
            ad += along * d;
            add += along * d * d;
            t += turn;
            tt += turn * turn;
            dt += d * turn;
            resultant += libm::cos(turn);
        }
        let [aa, m2, m3, ad, add, t, tt, dt, resultant] =
            [aa, dd, ddd, ad, add, t, tt, dt, resultant].map(|sum| sum / count);
        let extent = aa + first.x() * first.x() + first.y() * first.y();
        if m2 <= NO_SPREAD * NO_SPREAD * extent {
            return undefined;
        }

        let skew = m3 / (m2 * m2.sqrt());
        // Turning the axis by dh moves d by −along·dh.
        let skew_by_heading = 3.0 * (skew * ad / m2 - add / (m2 * m2.sqrt()));
        let influence_squared = |pose: &SE2| {
            let (_, d, turn) = residual(pose);
            let z = d / m2.sqrt();
            let influence = z * z * z - skew - 3.0 * z - 1.5 * skew * (z * z - 1.0)
                + skew_by_heading * libm::sin(turn) / resultant;
            influence * influence
        };
        let skew_error = poses.iter().map(influence_squared).sum::<f64>().sqrt() / count;
        let heading_variance = tt - t * t;
        let rho_heading = if heading_variance > NO_SPREAD * NO_SPREAD {
            (dt / (m2 * heading_variance).sqrt()).clamp(-1.0, 1.0)
        } else {
            f64::NAN
        };
        Self { skew, skew_error, rho_heading }
    }
}

/// [`CrossTrack::skew`] of `poses`.
pub fn cross_track_skew(poses: &[SE2]) -> f64 {
    CrossTrack::from_poses(poses).skew
}
