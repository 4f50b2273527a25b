//! Outliers: legs whose innovation is outside a gate, for example because the reference jumped. Outliers are listed in the result, and not
//! fitted. The innovations of the other legs are tested for correlation and heavy tails.

use super::Outliers;
use super::checks::{Check, CheckName, MAX_STD_ERRORS};
use super::optimizer::LegSet;
use super::result::LegFit;
use super::trajectory::median;

/// Quantiles 0.9999 of χ² with 1, 2 and 3 degrees of freedom.
const CHI2_9999: [f64; 3] = [15.137, 18.421, 21.108];

/// Median of χ² with 3 degrees of freedom.
const MEDIAN_CHI2: f64 = 2.366;

/// Last round in which an outlier may become an inlier again. In later rounds a leg near the gate that defines outliers could otherwise
/// alternate forever.
const LAST_RETURN_ROUND: usize = 2;

impl LegSet {
    /// Marks the outliers by the innovations of all legs, and returns true if the set of outliers changed. `round` counts the rounds of the
    /// fit from 1.
    pub(super) fn mark_outliers(&mut self, leg_fits: &[LegFit], round: usize) -> bool {
        if self.options.outliers == Outliers::Keep {
            return false;
        }
        // Variances may be too small in early rounds. The gate that defines outliers is then wider, so that at most half of the legs are
        // outliers.
        let mut squared_distances: Vec<f64> = leg_fits.iter().map(|fit| fit.squared).collect();
        let gate_factor = (median(&mut squared_distances) / MEDIAN_CHI2).max(1.0);
        let gate = CHI2_9999.map(|quantile| gate_factor * quantile);
        let is_marked = |fit: &LegFit| fit.is_outlier && round > LAST_RETURN_ROUND || !fit.is_within(&gate);
        let new_outliers: Vec<bool> = leg_fits.iter().map(is_marked).collect();
        let has_changed = new_outliers != self.outliers;
        self.outliers = new_outliers;
        has_changed
    }
}

/// Correlation of neighbouring legs, and excess kurtosis, that are negligible in a long log.
const NEGLIGIBLE_CORRELATION: f64 = 0.1;
const NEGLIGIBLE_KURTOSIS: f64 = 0.5;

/// Returns the checks of the innovations of legs that are no outliers: correlation of neighbouring legs, and kurtosis.
pub(super) fn residual_checks(leg_fits: &[LegFit], correlation: f64) -> Vec<Check> {
    let standardized = leg_fits.iter().filter(|fit| !fit.is_outlier).flat_map(|fit| fit.standardized);
    let standardized: Vec<f64> = standardized.filter(|residual| !residual.is_nan()).collect();
    let component_count = standardized.len() as f64;
    let mean_power =
        |power: i32| standardized.iter().map(|residual| residual.powi(power)).sum::<f64>() / component_count;
    let kurtosis = mean_power(4) / mean_power(2).powi(2);
    let correlation_limit = NEGLIGIBLE_CORRELATION.max(MAX_STD_ERRORS / component_count.sqrt());
    // Kurtosis of a normal sample has variance 24/n.
    let max_excess_kurtosis = NEGLIGIBLE_KURTOSIS.max(MAX_STD_ERRORS * (24.0 / component_count).sqrt());
    vec![
        Check::new(CheckName::ResidualsUncorrelated, correlation, [-correlation_limit, correlation_limit]),
        Check::new(CheckName::TailsNormal, kurtosis, [1.0, 3.0 + max_excess_kurtosis]),
    ]
}
