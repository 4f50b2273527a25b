//! Recommended α's for a filter: fitted α's, inflated until held-out windows of a metre are covered.
//!
//! Errors of real wheels persist over several legs. A filter needs α's that hold between two corrections of its pose.

use super::checks::{Check, CheckName, MAX_INFLATION, MAX_STD_ERRORS, WindowCoverage};
use super::legs::{Leg, distance};
use super::likelihood::{Parameters, Residuals, propagated, reference_covariance};
use super::optimizer::{EXACT_GAIN, Fit, LegSet, maximize};
use super::residuals::Observation;
use super::result::Recommendation;
use crate::geom::se2::SE2;
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// Minimum lengths of the windows, m. Recommended α's are inflated until 95 % of the errors over windows of the first length are within their
/// 95 % regions.
const WINDOW_LENGTHS: [f64; 3] = [1.0, 2.0, 5.0];

/// Window of several legs, with the covariances of its error due to wheels and reference.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Window {
    first_leg: usize,
    /// Length (m) and turn (rad) by the odometry.
    length: f64,
    pub turn: f64,
    expected: SE2,
    /// SE(2) logarithm of (expected motion)⁻¹ · (motion that the reference measured).
    pub error: Vector3<f64>,
    wheel_covariance: Matrix3<f64>,
    reference_covariance: Matrix3<f64>,
}

impl Window {
    /// Returns the squared Mahalanobis distance of the error, with the wheels' variances multiplied by `inflation`.
    fn squared_distance(&self, inflation: f64) -> f64 {
        let covariance = self.wheel_covariance * inflation + self.reference_covariance;
        covariance.try_inverse().map_or(f64::INFINITY, |inverse| self.error.dot(&(inverse * self.error)))
    }
}

impl LegSet {
    /// Cuts the legs in `range` into windows of each of [`WINDOW_LENGTHS`]. No window leads across a gap. Outliers, and legs whose residuals do
    /// not determine the noise, are in no window.
    pub(super) fn windows(&self, range: Range<usize>, parameters: &Parameters) -> [Vec<Window>; 3] {
        let mut windows = [const { Vec::new() }; 3];
        let mut open_windows: [Option<Window>; 3] = [None; 3];
        let pose_covariance = reference_covariance(parameters);
        for index in range {
            let (leg, observation) = (&self.legs[index], &self.observations[index]);
            let Observation { residuals, coefficients, expected, noise_jacobian, .. } = observation;
            let has_noise = !residuals[1].is_nan() && !self.outliers[index];
            let variances = self.options.model.wheel_variances(coefficients, parameters);
            let leg_covariance = propagated(noise_jacobian, &Matrix3::from_diagonal(&variances));
            let to_leg_end = expected.inverse().adjoint();
            for (i, open_window) in open_windows.iter_mut().enumerate() {
                let previous_legs = open_window.take().filter(|_| leg.follows);
                if !has_noise {
                    continue;
                }
                let mut window = previous_legs.unwrap_or(Window { first_leg: index, ..Window::default() });
                window.length += distance(expected);
                window.turn += expected.theta();
                window.expected = window.expected * *expected;
                window.wheel_covariance = propagated(&to_leg_end, &window.wheel_covariance) + leg_covariance;
                if window.length < WINDOW_LENGTHS[i] {
                    *open_window = Some(window);
                    continue;
                }
                let reference = [self.legs[window.first_leg].reference[0], leg.reference[1]];
                let measured = self.systematic.motion(&Leg { reference, ..*leg });
                window.error = measured.boxminus(&window.expected);
                let jacobians = self.systematic.reference_jacobians(&measured);
                window.reference_covariance =
                    jacobians.iter().map(|jacobian| propagated(jacobian, &pose_covariance)).sum();
                windows[i].push(window);
            }
        }
        windows
    }
}

/// Returns the fraction of windows whose error is inside the 95 % ellipsoid, and the NEES: the mean squared Mahalanobis distance divided
/// by its 3 degrees of freedom. The wheels' variances are multiplied by `inflation`.
fn coverage(windows: &[Window], inflation: f64) -> WindowCoverage {
    let squared_distances: Vec<f64> =
        windows.iter().map(|window| window.squared_distance(inflation)).collect();
    let count = windows.len();
    let covered_count = squared_distances.iter().filter(|square| **square < CHI2_95[2]).count();
    WindowCoverage {
        length: windows.iter().map(|window| window.length).sum::<f64>() / count as f64,
        count,
        coverage: covered_count as f64 / count as f64,
        nees: squared_distances.iter().sum::<f64>() / (3 * count) as f64,
    }
}

/// Minimum number of windows for conclusions from their coverage.
const MIN_WINDOWS: usize = 20;

/// Ratio of two successive inflations that are tried.
const INFLATION_STEP: f64 = 1.005;

/// Returns the smallest inflation of at least 1 under which 95 % of the windows are covered and NEES is not above its 95 % interval. None
/// if [`MAX_INFLATION`] is not enough.
fn required_inflation(windows: &[Window]) -> Option<f64> {
    if windows.len() < MIN_WINDOWS {
        return Some(1.0);
    }
    // χ² with 3 degrees of freedom has variance 6.
    let nees_std = (6.0 / windows.len() as f64).sqrt() / 3.0;
    let is_covered = |inflation: f64| {
        let WindowCoverage { coverage, nees, .. } = coverage(windows, inflation);
        coverage >= 0.95 && nees <= 1.0 + 1.96 * nees_std
    };
    let inflations = std::iter::successors(Some(1.0), |inflation| Some(inflation * INFLATION_STEP));
    let inflations: Vec<f64> = inflations.take_while(|inflation| *inflation <= MAX_INFLATION).collect();
    inflations.get(inflations.partition_point(|inflation| !is_covered(*inflation))).copied()
}

/// Quantiles 0.95 of χ² with 1, 2 and 3 degrees of freedom.
const CHI2_95: [f64; 3] = [3.841, 5.991, 7.815];

/// Difference from 95 % of the coverage (fraction of errors inside their 95 % region) that is too small to matter in a long log.
const NEGLIGIBLE_COVERAGE: f64 = 0.015;

/// Returns the range of the coverage of logs that the model simulates. `variance_std_error` is the relative standard error of the variances.
/// The factor 0.14 is the density of ln χ² with 3 degrees of freedom at the quantile 0.95.
fn coverage_range(count: usize, variance_std_error: f64) -> [f64; 2] {
    let std_error = libm::hypot((0.95 * 0.05 / count as f64).sqrt(), 0.14 * variance_std_error);
    let tolerance = NEGLIGIBLE_COVERAGE.max(MAX_STD_ERRORS * std_error);
    [0.95 - tolerance, (0.95 + tolerance).min(1.0)]
}

/// Fits each half of the log, compares each half with the fit to the other half, and finds the inflation with which the fit covers 95 % of
/// the errors over a metre. Returns the recommended α's, the checks, and the coverage of windows of each length.
pub(super) fn cross_validate(
    fit: &Fit,
    all_legs: &LegSet,
    alphas: &[Option<f64>],
) -> (Option<Recommendation>, Vec<Check>, Vec<WindowCoverage>) {
    let split_in_halves = |legs: usize| [0..legs / 2, legs / 2..legs];
    let leg_count = fit.leg_set.legs.len();
    let residuals = split_in_halves(leg_count).map(|half| fit.leg_set.residuals_in(half));
    let parameters_of = |half: &Residuals| maximize(half, &fit.maximum.parameters, EXACT_GAIN).parameters;
    let parameters_by_other_half = [parameters_of(&residuals[1]), parameters_of(&residuals[0])];
    let (mut covered_legs, mut compared_legs) = (0, 0);
    for (residuals, parameters) in residuals.iter().zip(&parameters_by_other_half) {
        let filter_result = residuals.filter_result(parameters);
        for fit in filter_result.leg_fits(&filter_result.errors).iter().filter(|fit| !fit.is_outlier) {
            compared_legs += 1;
            covered_legs += usize::from(fit.is_within(&CHI2_95));
        }
    }
    // Variances estimated from the 3n components of n legs have the relative variance 2/(3n). With k α's, each α has a k-th of the
    // components.
    let variance_std_error = (2.0 * alphas.len() as f64 / (3 * leg_count / 2) as f64).sqrt();
    let new_check =
        |name, coverage, count| Check::new(name, coverage, coverage_range(count, variance_std_error));
    let holdout_coverage = covered_legs as f64 / compared_legs as f64;
    let mut checks = vec![new_check(CheckName::HoldoutCovered, holdout_coverage, compared_legs)];
    let halves_of_log = split_in_halves(all_legs.legs.len());
    let windows_of_halves: [[Vec<Window>; 3]; 2] =
        std::array::from_fn(|i| all_legs.windows(halves_of_log[i].clone(), &parameters_by_other_half[i]));
    let windows = [0, 1, 2].map(|i| [&windows_of_halves[0][i][..], &windows_of_halves[1][i]].concat());
    let coverages: Vec<WindowCoverage> = windows.iter().map(|windows| coverage(windows, 1.0)).collect();
    let check_names = [CheckName::Window1Covered, CheckName::Window2Covered, CheckName::Window5Covered];
    let named_coverages = check_names.into_iter().zip(&coverages);
    checks.extend(
        named_coverages
            .filter(|(_, window)| window.count >= MIN_WINDOWS)
            .map(|(name, window)| new_check(name, window.coverage, window.count)),
    );
    let recommendation = required_inflation(&windows[0]).map(|inflation| Recommendation {
        alphas: alphas.iter().map(|alpha| alpha.map(|alpha| inflation * alpha)).collect(),
        inflation,
        reason: recommendation_reason(windows[0].len()).to_string(),
    });
    (recommendation, checks, coverages)
}

/// Returns the sentence that names the windows on which the inflation is based.
fn recommendation_reason(window_count: usize) -> &'static str {
    if window_count < MIN_WINDOWS {
        "Fewer than 20 windows of 1 m were held out of the fit, so the fitted α's are recommended unchanged."
    } else {
        "The fitted α's times the inflation cover at least 95 % of the held-out windows of 1 m."
    }
}
