//! Outliers: legs outside of a gate on the innovation, as where the reference jumped. They are listed, and the fit leaves them out.

use super::fit::Sample;
use super::likelihood::{Parameters, Residuals};
use super::options::Outliers;
use super::result::LegFit;
use super::trajectory::median;

/// Quantiles 0.9999 of χ² with 1, 2 and 3 degrees of freedom.
const CHI2_9999: [f64; 3] = [15.137, 18.421, 21.108];

/// Median of χ² with 3 degrees of freedom.
const MEDIAN_CHI2: f64 = 2.366;

/// Last round in which an outlier may become an inlier again. Later ones forbid it, because a leg at the gate could alternate forever.
const LAST_RETURN_ROUND: usize = 2;

impl Sample {
    /// Returns all legs under these parameters: an outlier without the leg before it, the others along the chain of kept legs.
    pub(super) fn leg_fits(&self, parameters: &Parameters) -> Vec<LegFit> {
        let kept = self.kept(0..self.legs.len());
        let outliers = (0..self.legs.len()).filter(|leg| self.outliers[*leg]).map(|leg| (leg, false));
        let outliers = Residuals::new(self.options.model, self.estimated, &self.terms, outliers.collect());
        let [inside, outside] = [kept, outliers].map(|residuals| residuals.filtered(parameters));
        let errors = inside.least_squares.errors;
        let [mut inside, mut outside] = [inside, outside].map(|filtered| filtered.innovations.into_iter());
        let next = |is_outlier: &bool| {
            let innovation = if *is_outlier { outside.next() } else { inside.next() };
            innovation.map(|innovation| innovation.leg_fit(&errors, *is_outlier))
        };
        self.outliers.iter().filter_map(next).collect()
    }

    /// Marks the outliers under these parameters, and returns true if they changed. `gate` is a factor of the gate on the squared distance.
    pub(super) fn mark_outliers(&mut self, parameters: &Parameters, gate: f64, round: usize) -> bool {
        if self.options.outliers == Outliers::Keep {
            return false;
        }
        let fits = self.leg_fits(parameters);
        // Variances may still be too small in early rounds. The gate is wider then, so that at most half of the legs are outliers.
        let mut squares: Vec<f64> = fits.iter().map(|fit| fit.squared).collect();
        let gate = gate * (median(&mut squares) / MEDIAN_CHI2).max(1.0);
        let is_outside =
            |fit: &LegFit| fit.observed() > 0 && fit.squared > gate * CHI2_9999[fit.observed() - 1];
        let is_marked = |fit: &LegFit| fit.is_outlier && round > LAST_RETURN_ROUND || is_outside(fit);
        let marked: Vec<bool> = fits.iter().map(is_marked).collect();
        let changed = marked != self.outliers;
        self.outliers = marked;
        changed
    }
}
