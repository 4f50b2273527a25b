//! Gate that sets outliers aside, as where the reference jumped: they are listed, and the fit goes on without them.

use super::fit::Sample;
use super::likelihood::{Parameters, Residuals, Standardized};
use super::options::Outliers;
use super::trajectory::median;

/// Quantiles 0.9999 of χ² with 1, 2 and 3 degrees of freedom.
const GATES: [f64; 3] = [15.137, 18.421, 21.108];

/// Median of χ² with 3 degrees of freedom.
const MEDIAN_CHI2: f64 = 2.366;

/// Last round after which an outlier may become an inlier again; otherwise a leg at the gate would alternate in every round.
const LAST_RETURN: usize = 2;

impl Sample {
    /// Innovations of all legs: of an outlier without the leg before it, of the others along the chain of kept legs.
    pub(super) fn innovations(&self, parameters: &Parameters) -> Vec<Standardized> {
        let kept = self.kept(0..self.legs.len());
        let errors = kept.least_squares(parameters).errors;
        let chosen = (0..self.legs.len()).filter(|leg| self.outliers[*leg]).map(|leg| (leg, false));
        let outside = Residuals::new(self.options.model, self.estimated, &self.terms, chosen.collect());
        let [mut inside, mut outside] =
            [kept, outside].map(|all| all.innovations(parameters, &errors).into_iter());
        let next = |is_outlier: &bool| if *is_outlier { outside.next() } else { inside.next() };
        self.outliers.iter().filter_map(next).collect()
    }

    /// Marks the outliers under these parameters, with the squared gate multiplied by `gate`; returns whether they are others than before.
    pub(super) fn mark_outliers(&mut self, parameters: &Parameters, gate: f64, round: usize) -> bool {
        if self.options.outliers == Outliers::Keep {
            return false;
        }
        let innovations = self.innovations(parameters);
        // Variances may still be too small: half of the legs must not pass for outliers then.
        let mut squares: Vec<f64> = innovations.iter().map(|innovation| innovation.squared).collect();
        let gate = gate * (median(&mut squares) / MEDIAN_CHI2).max(1.0);
        let is_outside =
            |each: &Standardized| each.observed > 0 && each.squared > gate * GATES[each.observed - 1];
        let mark = |(each, was): (&Standardized, &bool)| *was && round > LAST_RETURN || is_outside(each);
        let marked: Vec<bool> = innovations.iter().zip(&self.outliers).map(mark).collect();
        let changed = marked != self.outliers;
        self.outliers = marked;
        changed
    }
}
