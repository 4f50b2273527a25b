//! The motion models of the chapter: p(x_t | u_t, x_{t−1}) as a scoring function, a density and a sampler.

mod odometry;
mod odometry_rules;
mod tangent;
mod velocity;

pub use odometry::{Hinges, OdomAlphas, OdomDelta, OdometryModel, ReverseAware};
pub use odometry_rules::{ExecutedLegs, LegVariances, OdometryRule, RuleAlphas, SPIN_BELOW};
pub(crate) use tangent::covariance_root;
pub use tangent::{Compounding, TangentNoiseError, TangentNoiseModel};
pub use velocity::{VelocityAlphas, VelocityCmd, VelocityModel};

use crate::geom::se2::SE2;
use nalgebra::Matrix3;
use rand::Rng;

/// A probabilistic motion model. Poses are in any one frame; the control decides whether the model can look ahead
/// (a command) or only back (an odometry reading).
pub trait MotionModel {
    type Control: Copy;

    /// Returns the scoring function of Tables 5.1 and 5.5: the product of the three noise densities at the residuals
    /// that explain `x_next`. Largest at the noise-free pose, but not a density over poses: see
    /// [`MotionModel::pose_density`].
    fn prob(&self, x_next: &SE2, u: &Self::Control, x: &SE2) -> f64;

    /// Returns the density over dx dy dθ (1/(m²·rad)) from which [`MotionModel::sample`] draws: every combination of
    /// noises that leads to `x_next`, each divided by the Jacobian determinant of the map from noises to poses. It
    /// integrates to 1 over the plane and the circle, and is infinite where the robot has not moved at all.
    ///
    /// None where one of the three variances is 0: the poses then fill no volume and have no density. None too of a model that does
    /// not say it.
    fn pose_density(&self, _x_next: &SE2, _u: &Self::Control, _x: &SE2) -> Option<f64> {
        None
    }

    /// Returns a draw of x_t (Tables 5.3 and 5.6).
    fn sample<R: Rng + ?Sized>(&self, u: &Self::Control, x: &SE2, rng: &mut R) -> SE2;

    /// R_u, the covariance in exponential coordinates, where the noise is additive there; None elsewhere.
    fn tangent_cov(&self, _u: &Self::Control) -> Option<Matrix3<f64>> {
        None
    }
}
