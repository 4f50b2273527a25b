//! α's that a filter can use: the fitted ones, inflated until held-out windows of a metre are covered.

use super::checks::{Check, holdout_check, window_checks};
use super::fit::{Fit, Sample, free_parameters};
use super::likelihood::Parameters;
use super::optimizer::maximize;
use super::result::{Options, Recommended};
use super::windows::{MIN_WINDOWS, Window, WindowCoverage, WindowedLegs, coverage, required_inflation};
use std::ops::Range;

/// Lengths of the windows, m; the first one is that which the recommended α's have to cover.
const LENGTHS: [f64; 3] = [1.0, 2.0, 5.0];

/// Quantiles 0.95 of χ² with 1, 2 and 3 degrees of freedom.
const CHI2_95: [f64; 3] = [3.841, 5.991, 7.815];

pub(super) struct Recommendation {
    pub recommended: Recommended,
    pub checks: Vec<Check>,
    pub windows: Vec<WindowCoverage>,
}

/// Fits each half of the log, compares the other one with that, and finds the inflation that windows need.
pub(super) fn recommend(
    fit: &Fit,
    all: &Sample,
    options: &Options,
    alphas: &[Option<f64>],
) -> Recommendation {
    let count = fit.sample.legs.len();
    let halves = [0..count / 2, count / 2..count];
    let parameters = halves.clone().map(|half| fit_part(fit, options, &half));
    let (mut inside, mut compared) = (0, 0);
    for (half, parameters) in halves.iter().zip([&parameters[1], &parameters[0]]) {
        let residuals = fit.sample.residuals(options, fit.residuals.estimated, |leg| {
            half.contains(&leg) && !fit.sample.outliers[leg]
        });
        let errors = residuals.least_squares(parameters).errors;
        let innovations = residuals.innovations(parameters, &errors);
        compared += innovations.len();
        inside += innovations
            .iter()
            .filter(|each| each.observed > 0 && each.squared < CHI2_95[each.observed - 1])
            .count();
    }
    // Variances of n legs have the relative variance 2/3n; α's share them.
    let scale_std = (2.0 * options.model.alphas() as f64 / (3 * count / 2).max(1) as f64).sqrt();
    let mut checks = vec![holdout_check(inside as f64 / compared as f64, compared, scale_std)];
    // Windows of the whole log, each under the fit to the half in which it is not.
    let total = all.legs.len();
    let ranges = [0..total / 2, total / 2..total];
    let legs = WindowedLegs {
        model: options.model,
        corrected: &fit.systematic,
        legs: &all.legs,
        observations: &all.observations,
        outliers: &all.outliers,
    };
    let held_out = |length: f64| -> Vec<Window> {
        let of = |(range, parameters): (&Range<usize>, &Parameters)| {
            legs.windows(range.clone(), length, parameters)
        };
        ranges.iter().zip([&parameters[1], &parameters[0]]).flat_map(of).collect()
    };
    let windows: Vec<Vec<Window>> = LENGTHS.map(held_out).into();
    let inflation = required_inflation(&windows[0]);
    let covered: Vec<WindowCoverage> =
        windows.iter().zip(LENGTHS).map(|(windows, length)| coverage(windows, length, 1.0)).collect();
    checks.extend(window_checks(&covered, scale_std));
    let reason = reason(&covered[0], inflation);
    let recommended = Recommended {
        alphas: alphas.iter().map(|alpha| alpha.map(|alpha| inflation * alpha)).collect(),
        inflation,
        reason,
    };
    Recommendation { recommended, checks, windows: covered }
}

fn fit_part(fit: &Fit, options: &Options, part: &Range<usize>) -> Parameters {
    let residuals = fit
        .sample
        .residuals(options, fit.residuals.estimated, |leg| part.contains(&leg) && !fit.sample.outliers[leg]);
    maximize(&residuals, fit.maximum.parameters, &free_parameters(options)).parameters
}

fn reason(window: &WindowCoverage, inflation: f64) -> String {
    let WindowCoverage { count, coverage, nees, .. } = *window;
    if count < MIN_WINDOWS {
        return format!(
            "The log has {count} windows of 1 m that were not used for the fit; {MIN_WINDOWS} are needed to judge it, so the fit stands as it is."
        );
    }
    let percent = 100.0 * coverage;
    if inflation == 1.0 {
        return format!(
            "The fit covers {percent:.1} % of {count} held-out windows of 1 m, where 95 % is right."
        );
    }
    format!(
        "The fit covers {percent:.1} % of {count} held-out windows of 1 m (NEES {nees:.2}, where 1 is right); times {inflation:.2} it covers 95 %."
    )
}
