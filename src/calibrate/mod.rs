//! Calibration of a robot's α's, from a log of its odometry and a reference of its true poses.
//!
//! [`calibrate`] cuts the log into [`Leg`]s. A leg is as long as the motion between two updates of the filter that uses the α's. Its
//! residuals have variances that are linear in the α's ([`Observation`]). The α's, the noise of the reference and the systematic errors
//! maximize the restricted likelihood. Checks tell whether to trust the result. Windows of a metre give the factor by which α's for a
//! filter are inflated. `doc/calibration-method.md` has the formulas.

mod alignment;
mod checks;
mod intervals;
mod legs;
mod likelihood;
mod optimizer;
mod outliers;
mod residuals;
mod result;
mod trajectory;
mod windows;

pub use checks::{Check, CheckName, Diagnostics, FailureCause, Verdict, WindowCoverage};
pub use intervals::NotIdentifiable;
pub use legs::{Leg, LegLength, LostLegs, MIN_LEGS};
pub use residuals::{ERROR_COUNT, ErrorMask, Model, Observation, Systematic, SystematicError};
pub use result::{Calibration, Estimate, LegFit, Persistence, Recommendation};
pub use trajectory::{Trajectory, TrajectoryError};

use intervals::{NORMAL_95, identifiability, intervals};
use legs::distance;
use likelihood::{POSITION_VARIANCE, YAW_VARIANCE};
use optimizer::{Fit, Log};
use thiserror::Error;

/// Odometry and reference of one drive.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Poses by the odometry, in its own frame.
    pub odometry: Trajectory,
    /// Poses by the reference, in another frame and by another clock.
    pub reference: Trajectory,
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
    /// Correction of each of [`SystematicError::ALL`]: true or false. None: the error is corrected if it is identifiable and constant.
    pub correct: [Option<bool>; ERROR_COUNT],
    /// Standard deviation of each coordinate of the reference, m. None if it is estimated.
    pub position_std: Option<f64>,
    /// Standard deviation of the reference's heading, rad. None if it is estimated.
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
        "not enough data: {legs} legs have poses in both logs, and {MIN_LEGS} are needed. Take both logs from one drive, choose shorter legs, or drive longer"
    )]
    TooFewLegs {
        /// Number of legs.
        legs: usize,
    },
}

/// Calibrates the α's of a robot from one drive or several.
///
/// # Errors
/// [`CalibrateError`] if odometry and reference do not overlap in time, or if there are fewer than [`MIN_LEGS`] legs.
///
/// ```
/// use motion::calibrate::{CalibrateError, Drive, LegLength, Model, Options, Outliers, Trajectory, calibrate};
/// use motion::geom::se2::SE2;
///
/// let samples = (0..10).map(|i| (0.1 * f64::from(i), SE2::new(0.1 * f64::from(i), 0.0, 0.0)));
/// let trajectory = Trajectory::new(samples)?;
/// let drive = Drive { odometry: trajectory.clone(), reference: trajectory };
/// let (model, legs, outliers) = (Model::Velocity, LegLength::AMCL, Outliers::Reject);
/// let options = Options { model, legs, outliers, correct: [None; 6], position_std: None, yaw_std: None };
/// // Ten samples are too short a log.
/// assert!(matches!(calibrate(&[drive], &options), Err(CalibrateError::TooFewLegs { .. })));
/// # Ok::<(), motion::calibrate::TrajectoryError>(())
/// ```
pub fn calibrate(drives: &[Drive], options: &Options) -> Result<Calibration, CalibrateError> {
    let mut log = Log::new(drives, options.legs)?;
    let mut fit = Fit::new(&log, options, [true; ERROR_COUNT], None);
    let systematic = fit.leg_set.systematic;
    let persistence = persistence(&fit);
    let correlation = persistence.correlation.value;
    let error_stds = fit.maximum.filter_result.error_stds(correlation);
    let (scale_checks, is_constant) = checks::scale_checks(&fit, correlation);
    let is_allowed: ErrorMask = std::array::from_fn(|i| options.correct[i].unwrap_or(is_constant[i]));
    let correctable: ErrorMask = std::array::from_fn(|i| is_allowed[i] && fit.leg_set.estimated[i]);
    let mut corrected = systematic;
    for error in SystematicError::ALL.into_iter().filter(|error| !is_allowed[*error as usize]) {
        *corrected.get_mut(error) = Systematic::NONE.get(error);
    }
    if corrected != systematic {
        fit = Fit::new(&log, options, correctable, Some((corrected, fit.maximum.parameters)));
    }
    // Errors that are left uncorrected act as noise, which can make another error unidentifiable.
    let is_corrected = std::array::from_fn(|i| correctable[i] && fit.leg_set.estimated[i]);
    let all_legs = fit.all_legs(&mut log);
    let parameters = &fit.maximum.parameters;
    let not_identifiable = identifiability(&fit);
    let interval_of = intervals(&fit, correlation);
    let identified_alphas =
        (0..).zip(&not_identifiable).map(|(alpha, reason)| reason.is_none().then_some(alpha));
    let alphas: Vec<Option<f64>> = identified_alphas.clone().map(|alpha| Some(parameters[alpha?])).collect();
    let alpha_intervals: Vec<Option<[f64; 2]>> =
        identified_alphas.map(|alpha| alpha.map(&interval_of)).collect();
    let reference_noise = [POSITION_VARIANCE, YAW_VARIANCE].map(|variance| Estimate {
        value: parameters[variance].sqrt(),
        interval: interval_of(variance).map(f64::sqrt),
    });
    let leg_fits = fit.leg_fits(&all_legs);
    let (recommended, window_checks, windows) = windows::cross_validate(&fit, &all_legs, &alphas);
    let inflation = recommended.as_ref().map_or(f64::INFINITY, |recommendation| recommendation.inflation);
    let identifies_any_alpha = alphas.iter().any(Option::is_some);
    // The reference comes first, because the first failure is displayed.
    let reference_check = checks::reference_check(&all_legs, &systematic, &alpha_intervals);
    let mut checks = Vec::from_iter(reference_check);
    checks.extend(checks::log_checks(&all_legs, &log.lost, inflation));
    checks.extend(scale_checks);
    checks.extend(outliers::residual_checks(&leg_fits, neighbour_correlation(&fit).0));
    checks.extend(window_checks);
    let verdict = checks::verdict(&checks, identifies_any_alpha);
    Ok(Calibration {
        alphas,
        intervals: alpha_intervals,
        not_identifiable,
        systematic,
        systematic_stds: error_stds.map(|std| (std > 0.0).then_some(std)),
        is_constant,
        corrected: fit.leg_set.systematic,
        is_corrected,
        reference_noise,
        persistence,
        log_likelihood: fit.maximum.filter_result.log_likelihood,
        legs: all_legs.legs,
        observations: all_legs.observations,
        leg_fits,
        lost: log.lost,
        diagnostics: Diagnostics { verdict, checks, windows },
        recommended: recommended.filter(|_| verdict != Verdict::Unusable),
    })
}

/// Returns the correlation of the innovations of neighbouring legs, and its standard error.
fn neighbour_correlation(Fit { leg_set, maximum }: &Fit) -> (f64, f64) {
    let fits = maximum.filter_result.leg_fits(&maximum.filter_result.errors);
    let (mut product_sum, mut square_sum, mut pair_count) = (0.0, 0.0, 0);
    let pairs = fits.windows(2).zip(&leg_set.legs[1..]);
    for (pair, _) in pairs.filter(|(pair, leg)| leg.follows && pair.iter().all(|leg| !leg.is_outlier)) {
        for (before, after) in pair[0].standardized.into_iter().zip(pair[1].standardized) {
            if !before.is_nan() && !after.is_nan() {
                product_sum += before * after;
                square_sum += 0.5 * (before * before + after * after);
                pair_count += 1;
            }
        }
    }
    if pair_count == 0 { (0.0, 1.0) } else { (product_sum / square_sum, 1.0 / f64::from(pair_count).sqrt()) }
}

/// Returns the correlation of the wheels' errors in neighbouring legs, and the distance over which the correlation falls to 1/e.
fn persistence(fit: &Fit) -> Persistence {
    let (correlation, std) = neighbour_correlation(fit);
    let clamp_correlation = |value: f64| value.clamp(0.0, 0.95);
    // A correlation that is not significant counts as 0.
    let value = if correlation > NORMAL_95 * std { clamp_correlation(correlation) } else { 0.0 };
    let interval =
        [clamp_correlation(correlation - NORMAL_95 * std), clamp_correlation(correlation + NORMAL_95 * std)];
    let legs = &fit.leg_set.legs;
    let driven_distance_of = |leg: &Leg| distance(&leg.odometry[0].motion_to(&leg.odometry[1]));
    let mean_leg_distance = legs.iter().map(driven_distance_of).sum::<f64>() / legs.len() as f64;
    let correlation_length = if value > 0.0 { -mean_leg_distance / libm::log(value) } else { 0.0 };
    Persistence { correlation: Estimate { value, interval }, length: correlation_length }
}
