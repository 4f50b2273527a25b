//! Options of a calibration, and the errors that it returns.

use super::legs::{LegLength, MIN_LEGS};
use super::residuals::Model;
use super::systematic::ERROR_COUNT;
use super::trajectory::Trajectory;
use thiserror::Error;

/// Odometry and reference of one drive.
#[derive(Clone, Copy, Debug)]
pub struct Drive<'a> {
    /// Poses by the odometry, in its own frame.
    pub odometry: &'a Trajectory,
    /// Poses by the reference, in another frame and by another clock.
    pub reference: &'a Trajectory,
}

/// Treatment of outliers: legs whose residuals the fit does not explain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outliers {
    /// Outliers are left out of the fit.
    #[default]
    Reject,
    /// Outliers are fitted as noise.
    Keep,
}

/// Options of a calibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Model whose α's are fitted.
    pub model: Model,
    /// Condition on which a leg ends.
    pub legs: LegLength,
    /// Treatment of outliers.
    pub outliers: Outliers,
    /// True or false for each of [`SystematicError::ALL`](super::SystematicError::ALL) that is corrected or not. None: an error is corrected if
    /// it is identifiable and constant.
    pub correct: [Option<bool>; ERROR_COUNT],
    /// Standard deviation of each coordinate of the reference, m. None: estimated.
    pub position_std: Option<f64>,
    /// Standard deviation of the reference's heading, rad. None: estimated.
    pub yaw_std: Option<f64>,
}

/// Reason for which a log cannot be fitted.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum CalibrateError {
    /// The times of odometry and reference do not overlap, and at no clock offset are their turn rates correlated.
    #[error(
        "odometry and reference have no time in common, and their turn rates correlate at no clock offset; give two logs of one drive"
    )]
    NoCommonTime,
    /// There are fewer than [`MIN_LEGS`] legs.
    #[error(
        "the log has {legs} legs for which both trajectories are known; at least {MIN_LEGS} are needed: choose shorter legs, drive longer, or check the clocks"
    )]
    TooFewLegs {
        /// Number of legs.
        legs: usize,
    },
}
