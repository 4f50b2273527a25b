//! Result of a calibration.

use super::checks::{Check, CheckName, Diagnostics, SUFFICIENT_LEGS};
use super::intervals::{NORMAL_95, NotIdentifiable};
use super::legs::{Leg, LostLegs};
use super::residuals::{ERROR_COUNT, ErrorMask, Model, Observation, Systematic, SystematicError};
use serde::{Deserialize, Serialize};

/// Estimate with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
pub struct Estimate {
    /// Estimate.
    pub value: f64,
    /// Ends of the 95 % interval.
    pub interval: [f64; 2],
}

impl Default for Estimate {
    /// Returns the estimate 0, with the interval from 0 to ∞.
    fn default() -> Self {
        Self { value: 0.0, interval: [0.0, f64::INFINITY] }
    }
}

/// Persistence of the wheels' errors over several legs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
pub struct Persistence {
    /// Correlation of the errors in neighbouring legs: 0 if legs are independent, at most 1.
    pub correlation: Estimate,
    /// Distance (m) over which the correlation falls to 1/e. 0 if legs are independent.
    pub length: f64,
}

/// Recommended α's, which a filter can use.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify), tsify(missing_as_null))]
pub struct Recommendation {
    /// Fitted α's times the inflation. None for an α that is not identifiable.
    pub alphas: Vec<Option<f64>>,
    /// Factor on the fitted α's, 1 or more.
    pub inflation: f64,
    /// Sentence on the windows on which the factor is based.
    pub reason: String,
}

/// Innovation of one leg under the fit: its residual minus the prediction from the previous legs. Unobserved components are NaN.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LegFit {
    /// Standard deviations of the innovation's components.
    pub stds: [f64; 3],
    /// Innovation divided by its standard deviations.
    pub standardized: [f64; 3],
    /// Squared Mahalanobis distance of the innovation: χ² distributed, with one degree of freedom per observed component.
    pub squared: f64,
    /// True if the leg is an outlier, which is left out of the fit.
    pub is_outlier: bool,
}

impl LegFit {
    /// Returns true if the squared distance is below the χ² quantile for its degrees of freedom. `chi2_quantiles` are for 1, 2 and 3
    /// degrees.
    pub(super) fn is_within(&self, chi2_quantiles: &[f64; 3]) -> bool {
        let observed_count = self.stds.iter().filter(|std| !std.is_nan()).count();
        observed_count == 0 || self.squared < chi2_quantiles[observed_count - 1]
    }
}

/// Result of a calibration.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Fitted α's. None for an α that the log does not identify.
    pub alphas: Vec<Option<f64>>,
    /// 95 % intervals of the α's.
    pub intervals: Vec<Option<[f64; 2]>>,
    /// Reason for each α that the log does not identify.
    pub not_identifiable: Vec<Option<NotIdentifiable>>,
    /// Systematic errors, all estimated together.
    pub systematic: Systematic,
    /// Standard errors of [`SystematicError::ALL`]; None for an error that the log does not identify.
    pub systematic_stds: [Option<f64>; ERROR_COUNT],
    /// True for each systematic error that is the same on straight and turning legs, and in both halves of the log, up to its standard
    /// error. Only scales are tested; other errors count as constant.
    pub is_constant: ErrorMask,
    /// Systematic errors that were corrected. An error that was not corrected is 0, or 1 if it is a scale. A clock offset that the log does
    /// not identify is that with the largest correlation of turn rates.
    pub corrected: Systematic,
    /// True for each systematic error that was corrected.
    pub is_corrected: ErrorMask,
    /// Standard deviations of the reference: each coordinate (m) and heading (rad).
    pub reference_noise: [Estimate; 2],
    /// Correlation of the errors of neighbouring legs.
    pub persistence: Persistence,
    /// Restricted log-likelihood at its maximum, nats.
    pub log_likelihood: f64,
    /// Legs of all drives, in the order of drives and times.
    pub legs: Vec<Leg>,
    /// Residuals of each leg.
    pub observations: Vec<Observation>,
    /// Innovation of each leg under the fit.
    pub leg_fits: Vec<LegFit>,
    /// Number of legs that were omitted, by cause.
    pub lost: LostLegs,
    /// Checks, and the verdict that follows from the checks.
    pub diagnostics: Diagnostics,
    /// Recommended α's; None if the log is unusable.
    pub recommended: Option<Recommendation>,
}

impl Calibration {
    /// Returns the result of a log with too few legs for a fit.
    pub fn empty(model: Model) -> Self {
        Self {
            alphas: vec![None; model.alpha_count()],
            intervals: vec![None; model.alpha_count()],
            not_identifiable: vec![None; model.alpha_count()],
            is_constant: [true; ERROR_COUNT],
            log_likelihood: f64::NAN,
            diagnostics: Diagnostics {
                checks: vec![Check::new(CheckName::EnoughLegs, 0.0, [SUFFICIENT_LEGS, f64::INFINITY])],
                ..Diagnostics::default()
            },
            ..Self::default()
        }
    }

    /// Returns the 95 % interval of a systematic error; None if the log does not identify the error.
    pub fn interval_of(&self, error: SystematicError) -> Option<[f64; 2]> {
        let (value, std) = (self.systematic.get(error), self.systematic_stds[error as usize]?);
        Some([value - NORMAL_95 * std, value + NORMAL_95 * std])
    }
}
