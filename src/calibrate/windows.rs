//! Recommended α's for a filter: fitted α's, inflated until held-out windows of a metre are covered.
//!
//! Errors of real wheels persist over several legs. A filter needs α's that hold between two corrections of its pose.

use super::checks::{Check, CheckName, MAX_INFLATION, MAX_STD_ERRORS, WindowCoverage};
use super::fit::{Fit, LegSet};
use super::legs::{Leg, distance};
use super::likelihood::{Parameters, Residuals, reference_covariance};
use super::optimizer::{EXACT_GAIN, maximize};
use super::residuals::Observation;
use super::result::Recommendation;
use crate::geom::se2::SE2;
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// Error of the predicted motion over a window of several legs, with its covariances due to wheels and reference, in exponential coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// Distance driven by the odometry, m.
    length: f64,
    /// SE(2) logarithm of (expected motion)⁻¹ · (motion that the reference measured).
    error: Vector3<f64>,
    wheel_covariance: Matrix3<f64>,
    reference_covariance: Matrix3<f64>,
}

impl Window {
    fn squared_distance(&self, inflation: f64) -> f64 {
        let covariance = self.wheel_covariance * inflation + self.reference_covariance;
        covariance.try_inverse().map_or(f64::INFINITY, |inverse| self.error.dot(&(inverse * self.error)))
    }
}

impl LegSet {
    /// Cuts the legs in `range` into windows with the driven distance `length` (m). Legs without a covariance are in no window, and no
    /// window leads across a gap.
    fn windows(
        &self,
        range: Range<usize>,
        length: f64,
        covariances: &[Option<Matrix3<f64>>],
        parameters: &Parameters,
    ) -> Vec<Window> {
        let mut windows = Vec::new();
        // Window that is not long enough yet: its first leg, driven distance, expected motion and covariance.
        let mut open_window = None;
        for leg in range {
            let previous_legs = open_window.take().filter(|_| self.legs[leg].follows);
            let Some(leg_covariance) = covariances[leg] else { continue };
            let (first_leg, mut driven_distance, mut expected, mut wheel_covariance) =
                previous_legs.unwrap_or((leg, 0.0, SE2::identity(), Matrix3::zeros()));
            let expected_motion = &self.observations[leg].expected;
            let to_leg_end = expected_motion.inverse().adjoint();
            wheel_covariance = to_leg_end * wheel_covariance * to_leg_end.transpose() + leg_covariance;
            expected = expected * *expected_motion;
            driven_distance += distance(expected_motion);
            if driven_distance < length {
                open_window = Some((first_leg, driven_distance, expected, wheel_covariance));
                continue;
            }
            let reference_poses = [self.legs[first_leg].reference[0], self.legs[leg].reference[1]];
            let measured = self.systematic.motion(&Leg { reference: reference_poses, ..self.legs[leg] });
            let [at_start, at_end] = self.systematic.reference_jacobians(&measured);
            let pose_covariance = reference_covariance(parameters);
            let reference_covariance = at_start * pose_covariance * at_start.transpose()
                + at_end * pose_covariance * at_end.transpose();
            let error = measured.boxminus(&expected);
            windows.push(Window { length: driven_distance, error, wheel_covariance, reference_covariance });
        }
        windows
    }

    /// Returns the covariance of the wheels' noise over one leg, in the frame of its end. None for an outlier, and for a leg whose residuals do not
    /// determine the noise.
    fn wheel_covariance(&self, leg: usize, parameters: &Parameters) -> Option<Matrix3<f64>> {
        let Observation { residuals, coefficients, noise_jacobian, .. } = &self.observations[leg];
        // In a turn on the spot the first rotation has no noise.
        let is_determined = !residuals[1].is_nan() && !self.outliers[leg];
        let variances = self.options.model.wheel_variances(coefficients, parameters);
        let covariance = noise_jacobian * Matrix3::from_diagonal(&variances) * noise_jacobian.transpose();
        is_determined.then_some(covariance)
    }
}

/// Returns the fraction of windows whose error is inside the 95 % ellipsoid, and the NEES: the mean squared Mahalanobis distance divided
/// by its 3 degrees of freedom. The wheels' variances are multiplied by `inflation`.
fn coverage(windows: &[Window], min_window_length: f64, inflation: f64) -> WindowCoverage {
    let squared_distances: Vec<f64> =
        windows.iter().map(|window| window.squared_distance(inflation)).collect();
    let window_count = squared_distances.len();
    let covered_count = squared_distances.iter().filter(|square| **square < CHI2_95[2]).count();
    WindowCoverage {
        // Without windows the mean is NaN, and `max` returns its argument.
        length: (windows.iter().map(|window| window.length).sum::<f64>() / window_count as f64)
            .max(min_window_length),
        count: window_count,
        coverage: covered_count as f64 / window_count as f64,
        nees: squared_distances.iter().sum::<f64>() / (3 * window_count) as f64,
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
        let WindowCoverage { coverage, nees, .. } = coverage(windows, 0.0, inflation);
        coverage >= 0.95 && nees <= 1.0 + 1.96 * nees_std
    };
    let inflations = std::iter::successors(Some(1.0), |inflation| Some(inflation * INFLATION_STEP));
    let inflations: Vec<f64> = inflations.take_while(|inflation| *inflation <= MAX_INFLATION).collect();
    inflations.get(inflations.partition_point(|inflation| !is_covered(*inflation))).copied()
}

/// Minimum lengths of the windows, m. Recommended α's have to cover windows of the first length.
const WINDOW_LENGTHS: [f64; 3] = [1.0, 2.0, 5.0];

/// Quantiles 0.95 of χ² with 1, 2 and 3 degrees of freedom.
const CHI2_95: [f64; 3] = [3.841, 5.991, 7.815];

/// Difference from 95 % of the coverage (fraction of errors inside their 95 % region) that is too small to matter in a long log.
const NEGLIGIBLE_COVERAGE: f64 = 0.015;

/// Returns the range of the coverage of logs that the model simulates. `variance_std_error` is the relative standard error of the variances.
/// The factor 0.14 is the density of ln χ² with 3 degrees of freedom at the quantile 0.95.
fn coverage_range(count: usize, variance_std_error: f64) -> [f64; 2] {
    let variance = 0.95 * 0.05 / count as f64;
    let tolerance =
        NEGLIGIBLE_COVERAGE.max(MAX_STD_ERRORS * (variance + (0.14 * variance_std_error).powi(2)).sqrt());
    [0.95 - tolerance, (0.95 + tolerance).min(1.0)]
}

/// Recommended α's, with the checks and windows of held-out data on which they are based.
pub(super) struct CrossValidation {
    pub recommended: Option<Recommendation>,
    pub checks: Vec<Check>,
    pub windows: Vec<WindowCoverage>,
}

/// Fits each half of the log, compares each half with the fit to the other half, and finds the inflation with which the fit covers 95 % of
/// the errors over a metre.
pub(super) fn cross_validate(fit: &Fit, all_legs: &LegSet, alphas: &[Option<f64>]) -> CrossValidation {
    let split_in_halves = |legs: usize| [0..legs / 2, legs / 2..legs];
    let leg_count = fit.sample.legs.len();
    let residuals = split_in_halves(leg_count).map(|half| fit.sample.inlier_residuals(half));
    let parameters_of =
        |half: &Residuals| maximize(half, half.expansion_at(&fit.maximum.parameters), EXACT_GAIN).parameters;
    let parameters_by_other_half = [parameters_of(&residuals[1]), parameters_of(&residuals[0])];
    let (mut covered_legs, mut compared_legs) = (0, 0);
    for (residuals, parameters) in residuals.iter().zip(&parameters_by_other_half) {
        compared_legs += residuals.observations.len();
        covered_legs +=
            residuals.filtered(parameters).leg_fits().filter(|fit| fit.is_within(&CHI2_95)).count();
    }
    // Variances estimated from the 3n components of n legs have the relative variance 2/(3n). With k α's, each α has a k-th of the
    // components.
    let variance_std_error = (2.0 * alphas.len() as f64 / (3 * leg_count / 2).max(1) as f64).sqrt();
    let coverage_by_other_half = covered_legs as f64 / compared_legs as f64;
    let expected_coverage = coverage_range(compared_legs, variance_std_error);
    let mut checks = vec![Check::new(CheckName::HoldoutCovered, coverage_by_other_half, expected_coverage)];
    // The windows in each half of the log are compared with the parameters that were fitted to the other half.
    let half_ranges_of_log = split_in_halves(all_legs.legs.len());
    let halves_with_parameters = || half_ranges_of_log.iter().cloned().zip(&parameters_by_other_half);
    let covariances: Vec<Option<Matrix3<f64>>> = halves_with_parameters()
        .flat_map(|(half, parameters)| half.map(|leg| all_legs.wheel_covariance(leg, parameters)))
        .collect();
    let windows = WINDOW_LENGTHS.map(|length| {
        let windows_of_half = |(half, parameters)| all_legs.windows(half, length, &covariances, parameters);
        halves_with_parameters().flat_map(windows_of_half).collect::<Vec<_>>()
    });
    let inflation = required_inflation(&windows[0]);
    let window_coverages: Vec<WindowCoverage> =
        windows.iter().zip(WINDOW_LENGTHS).map(|(windows, length)| coverage(windows, length, 1.0)).collect();
    let check_names = [CheckName::Window1Covered, CheckName::Window2Covered, CheckName::Window5Covered];
    let named_windows = check_names.into_iter().zip(&window_coverages);
    checks.extend(named_windows.filter(|(_, window)| window.count >= MIN_WINDOWS).map(|(name, window)| {
        Check::new(name, window.coverage, coverage_range(window.count, variance_std_error))
    }));
    let recommendation = inflation.map(|inflation| Recommendation {
        alphas: alphas.iter().map(|alpha| alpha.map(|alpha| inflation * alpha)).collect(),
        inflation,
        reason: recommendation_reason(&window_coverages[0], inflation),
    });
    CrossValidation { recommended: recommendation, checks, windows: window_coverages }
}

fn recommendation_reason(window: &WindowCoverage, inflation: f64) -> String {
    let WindowCoverage { count, coverage, nees, .. } = *window;
    if count < MIN_WINDOWS {
        return format!(
            "The log has {count} windows of ≥ 1 m that were not used for the fit; {MIN_WINDOWS} are needed to judge it, so the fitted α's are recommended unchanged."
        );
    }
    let coverage_percent = format_decimal(100.0 * coverage, 1);
    let [nees, inflation] = [nees, inflation].map(|number| format_decimal(number, 2));
    format!(
        "The fit covers {coverage_percent} % of {count} held-out windows of ≥ 1 m (squared error over predicted variance {nees}, expected 1). The fitted α's times {inflation} cover at least 95 %."
    )
}

/// Formats a positive number with decimals. The standard formatting of floating-point numbers would be 5 % of the wasm module of a page.
fn format_decimal(number: f64, decimals: usize) -> String {
    let power_of_ten = 10_u64.pow(decimals as u32);
    let scaled_number = (number * power_of_ten as f64).round() as u64;
    format!("{}.{:0decimals$}", scaled_number / power_of_ten, scaled_number % power_of_ten)
}
