//! Outliers: legs whose innovation is outside a gate, for example because the reference jumped. Outliers are listed in the result, and not
//! fitted.

use super::Outliers;
use super::fit::LegSet;
use super::likelihood::{ErrorVector, Parameters, innovations};
use super::result::LegFit;
use super::trajectory::median;

/// Quantiles 0.9999 of χ² with 1, 2 and 3 degrees of freedom.
const CHI2_9999: [f64; 3] = [15.137, 18.421, 21.108];

/// Median of χ² with 3 degrees of freedom.
const MEDIAN_CHI2: f64 = 2.366;

/// Last round in which an outlier may become an inlier again. In later rounds a leg near the gate that defines outliers could otherwise
/// alternate forever.
const LAST_RETURN_ROUND: usize = 4;

impl LegSet {
    /// Returns the innovations of all legs under `parameters`, without the part that the systematic `errors` explain. Each outlier is
    /// filtered independently of its neighbours.
    pub(super) fn leg_fits(&self, parameters: &Parameters, errors: &ErrorVector) -> Vec<LegFit> {
        let is_inlier = |leg: usize| !self.outliers[leg];
        let terms = self.terms.iter().enumerate().map(|(leg, term)| (term, self.follows(leg, is_inlier)));
        innovations(self.options.model, parameters, Box::new(terms))
            .zip(&self.outliers)
            .map(|(innovation, is_outlier)| innovation.leg_fit(errors, *is_outlier))
            .collect()
    }

    /// Marks the outliers under `parameters` and systematic `errors`, and returns true if the set of outliers changed. `round` counts the
    /// rounds of the fit from 1.
    pub(super) fn mark_outliers(
        &mut self,
        parameters: &Parameters,
        errors: &ErrorVector,
        round: usize,
    ) -> bool {
        if self.options.outliers == Outliers::Keep {
            return false;
        }
        let fits = self.leg_fits(parameters, errors);
        // Variances may be too small in early rounds. The gate that defines outliers is then wider, so that at most half of the legs are
        // outliers.
        let mut squared_distances: Vec<f64> = fits.iter().map(|fit| fit.squared).collect();
        let gate_factor = (median(&mut squared_distances) / MEDIAN_CHI2).max(1.0);
        let gate = CHI2_9999.map(|quantile| gate_factor * quantile);
        let is_marked = |fit: &LegFit| fit.is_outlier && round > LAST_RETURN_ROUND || !fit.is_within(&gate);
        let new_outliers: Vec<bool> = fits.iter().map(is_marked).collect();
        let has_changed = new_outliers != self.outliers;
        self.outliers = new_outliers;
        has_changed
    }
}
