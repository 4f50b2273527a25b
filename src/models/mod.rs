//! Motion models of the chapter: p(x_t | u_t, x_{t−1}) as a scoring function, a density and a sampler.

mod odometry;
mod odometry_rules;
mod polar_motion;
mod tangent;
mod velocity;

pub use odometry::{ConfiguredOdometry, OdomAlphas, OdomDelta, OdometryModel, RotTransRot};
pub use odometry_rules::{ExecutedLegs, LegVariances, MAX_SPIN_DISTANCE, OdometryRule, RuleAlphas};
pub use polar_motion::PolarMotion;
pub(crate) use tangent::covariance_root;
pub use tangent::{Compounding, TangentNoiseError, TangentNoiseModel};
pub use velocity::{VelocityAlphas, VelocityCmd, VelocityModel};

use crate::geom::se2::SE2;
use nalgebra::Matrix3;
use rand::Rng;

/// Probabilistic motion model. All poses are in the same frame. A model whose control is a command can predict a motion. A model whose
/// control is an odometry reading needs a motion that has been measured.
///
/// Arguments are not checked: a negative α, or a command whose `dt` is not positive, gives meaningless results, NaN for most.
pub trait MotionModel {
    /// Command or odometry reading that leads from one pose to the next.
    type Control: Copy;

    /// Returns the score of Tables 5.1 and 5.5: the product of the three noise densities at the residuals that explain
    /// `x_next`. It is largest at the noise-free pose. It is not a density over poses, see [`MotionModel::pose_density`].
    fn prob(&self, x_next: &SE2, u: &Self::Control, x: &SE2) -> f64;

    /// Returns the density over dx dy dθ (1/(m²·rad)) from which [`MotionModel::sample`] draws. It is the sum over all noises
    /// that lead to `x_next`, each divided by the Jacobian determinant of the map from noises to poses. It integrates to 1 over
    /// the plane and the circle. It is infinite if the robot has not moved.
    ///
    /// None if one of the three variances is 0, because the poses then fill no volume. By default a model returns None.
    fn pose_density(&self, _x_next: &SE2, _u: &Self::Control, _x: &SE2) -> Option<f64> {
        None
    }

    /// Returns a random draw of the next pose x_t (Tables 5.3 and 5.6).
    fn sample<R: Rng + ?Sized>(&self, u: &Self::Control, x: &SE2, rng: &mut R) -> SE2;

    /// Returns R_u, the covariance in exponential coordinates, if the noise is additive in these coordinates. Otherwise returns None.
    fn tangent_cov(&self, _u: &Self::Control) -> Option<Matrix3<f64>> {
        None
    }
}
