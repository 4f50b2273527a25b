//! Calibration of a robot's α's, from a log of its odometry and a reference of its true poses.
//!
//! [`calibrate`] cuts the log into [`Leg`]s. A leg is as long as the motion between two updates of the filter that uses the α's. Its residuals
//! have variances that are linear in the α's ([`Observation`]). The α's, the noise of the reference and the systematic errors maximize the
//! restricted likelihood. Checks tell whether to trust them. Windows of a metre give the factor by which α's for a filter are inflated.
//! `doc/calibration-method.md` has the formulas.

mod alignment;
mod checks;
mod constancy;
mod fit;
mod intervals;
mod legs;
mod likelihood;
mod optimizer;
mod options;
mod outliers;
mod residuals;
mod result;
mod systematic;
mod trajectory;
mod windows;

pub use checks::{Check, CheckName, Diagnostics, LegFit, Verdict, WindowCoverage};
pub use intervals::NotIdentifiable;
pub use legs::{Leg, LegLength, LostLegs, MIN_LEGS, split_into_legs};
pub use options::{CalibrateError, Drive, Options, Outliers};
pub use residuals::{Model, Observation};
pub use result::{Calibration, Estimate, Persistence, Recommended};
pub use systematic::{ERRORS, ErrorMask, Systematic, SystematicError};
pub use trajectory::{Trajectory, TrajectoryError, TrajectoryFault};

use fit::{Log, Sample, fit_corrected, fit_systematic, free_parameters};
use intervals::{NORMAL_95, identifiability, intervals};
use likelihood::{POSITION, Standardized, YAW};

/// Calibrates the α's of a robot from one drive or several.
///
/// # Errors
/// [`CalibrateError`] where odometry and reference have nothing in common, or there are fewer than [`MIN_LEGS`] legs.
///
/// ```
/// use motion::calibrate::{CalibrateError, Drive, LegLength, Model, Options, Outliers, Trajectory, calibrate};
/// use motion::geom::se2::SE2;
/// use motion::models::OdometryRule;
///
/// let samples = (0..10).map(|i| (0.1 * f64::from(i), SE2::new(0.1 * f64::from(i), 0.0, 0.0)));
/// let odometry = Trajectory::new(samples.clone())?;
/// let reference = Trajectory::new(samples)?;
/// let options = Options {
///     model: Model::Odometry(OdometryRule::Nav2),
///     legs: LegLength::AMCL,
///     outliers: Outliers::Reject,
///     correct: Default::default(),
///     position_std: None,
///     yaw_std: None,
/// };
/// // Ten samples are too short a log.
/// let result = calibrate(&[Drive { odometry: &odometry, reference: &reference }], &options);
/// assert!(matches!(result, Err(CalibrateError::TooFewLegs { .. })));
/// # Ok::<(), motion::calibrate::TrajectoryError>(())
/// ```
pub fn calibrate(drives: &[Drive], options: &Options) -> Result<Calibration, CalibrateError> {
    let log = Log::new(drives)?;
    let systematic = fit_systematic(&log, options)?;
    let persistence = persistence(&systematic.sample, &systematic.innovations);
    // Noise that is correlated between legs increases the standard errors, as fewer legs would.
    let correlation = persistence.correlation.value;
    let repeated = ((1.0 + correlation) / (1.0 - correlation)).sqrt();
    let systematic_stds = systematic.stds.map(|std| (std > 0.0).then_some(repeated * std));
    let (scale_checks, is_constant) = constancy::scale_checks(&systematic, repeated);
    let is_corrected: ErrorMask =
        std::array::from_fn(|i| systematic_stds[i].is_some() && options.correct[i].unwrap_or(is_constant[i]));
    let mut corrected = Systematic::NONE;
    for (i, error) in SystematicError::ALL.into_iter().enumerate().filter(|(i, _)| is_corrected[*i]) {
        corrected.set(error, systematic.sample.systematic.get(error));
        debug_assert_eq!(error as usize, i);
    }
    let (fit, all, lost) =
        fit_corrected(&log, options, &corrected, is_corrected, &systematic.maximum.parameters)?;
    let free = free_parameters(options);
    let parameters = &fit.maximum.parameters;
    let not_identifiable =
        identifiability(options.model, &fit.maximum.expansion, parameters, &free, &fit.sample.observations);
    let all_intervals = intervals(&fit.residuals, &fit.maximum, &free, correlation);
    let identified = |alpha: usize| not_identifiable[alpha].is_none();
    let alphas: Vec<Option<f64>> =
        (0..options.model.alphas()).map(|alpha| identified(alpha).then_some(parameters[alpha])).collect();
    let std = |parameter: usize| Estimate {
        value: parameters[parameter].sqrt(),
        interval: all_intervals[parameter].map(f64::sqrt),
    };
    let leg_fits = leg_fits(&all, &fit);
    let mut checks = checks::log_checks(&all, &lost, options.legs, &systematic.sample.systematic);
    checks.extend(scale_checks);
    let recommendation = windows::recommend(&fit, &all, &alphas);
    let inflation =
        recommendation.recommended.as_ref().map_or(f64::INFINITY, |recommended| recommended.inflation);
    // Checks that decide whether a log is usable come first: the first failure is the advice.
    checks.insert(2, checks::inflation_check(inflation));
    let signed = correlation_of(&fit.sample, &fit.innovations).0;
    checks.extend(checks::residual_checks(&all, &leg_fits, signed));
    checks.extend(recommendation.checks);
    let verdict = checks::verdict(&checks, alphas.iter().any(Option::is_some));
    Ok(Calibration {
        intervals: (0..alphas.len()).map(|alpha| identified(alpha).then_some(all_intervals[alpha])).collect(),
        alphas,
        not_identifiable,
        systematic: systematic.sample.systematic,
        systematic_stds,
        is_constant,
        corrected,
        is_corrected,
        reference_noise: [std(POSITION), std(YAW)],
        persistence,
        log_likelihood: fit.maximum.expansion.log_likelihood,
        legs: all.legs,
        observations: all.observations,
        leg_fits,
        lost,
        diagnostics: Diagnostics { verdict, checks, windows: recommendation.windows },
        recommended: recommendation.recommended.filter(|_| verdict != Verdict::Unusable),
    })
}

/// Innovations of all legs under the fit to a sample of them.
fn leg_fits(all: &Sample, fit: &fit::Fit) -> Vec<LegFit> {
    let innovations = if all.legs.len() == fit.sample.legs.len() {
        fit.innovations.clone()
    } else {
        all.innovations(&fit.maximum.parameters)
    };
    let of = |(Standardized { stds, components, squared, .. }, is_outlier): (Standardized, &bool)| LegFit {
        stds,
        standardized: components,
        squared,
        is_outlier: *is_outlier,
    };
    innovations.into_iter().zip(&all.outliers).map(of).collect()
}

/// Correlation of the innovations of neighbouring legs, and its standard error.
fn correlation_of(sample: &Sample, innovations: &[Standardized]) -> (f64, f64) {
    let (mut product, mut squares, mut count) = (0.0, 0.0, 0);
    for leg in 1..sample.legs.len() {
        if !sample.legs[leg].follows || sample.outliers[leg] || sample.outliers[leg - 1] {
            continue;
        }
        for component in 0..3 {
            let seen = |leg: usize| !sample.observations[leg].residuals[component].is_nan();
            if seen(leg) && seen(leg - 1) {
                let [before, after] = [leg - 1, leg].map(|leg| innovations[leg].components[component]);
                product += before * after;
                squares += 0.5 * (before * before + after * after);
                count += 1;
            }
        }
    }
    if count == 0 { (0.0, 1.0) } else { (product / squares, 1.0 / f64::from(count).sqrt()) }
}

/// Correlation of the wheels' errors in neighbouring legs, and how far it reaches.
fn persistence(sample: &Sample, innovations: &[Standardized]) -> Persistence {
    let (correlation, std) = correlation_of(sample, innovations);
    let inside = |value: f64| value.clamp(0.0, 0.95);
    // A correlation that chance explains is none.
    let value = if correlation > NORMAL_95 * std { inside(correlation) } else { 0.0 };
    let interval = [inside(correlation - NORMAL_95 * std), inside(correlation + NORMAL_95 * std)];
    let driven = |leg: &Leg| {
        let motion = leg.odometry[0].inverse() * leg.odometry[1];
        libm::hypot(motion.x(), motion.y())
    };
    let mean = sample.legs.iter().map(driven).sum::<f64>() / sample.legs.len() as f64;
    let length = if value > 0.0 { -mean / libm::log(value) } else { 0.0 };
    Persistence { correlation: Estimate { value, interval }, length }
}
