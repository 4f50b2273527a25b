//! α's that a filter can use: the fitted ones, inflated until held-out windows of a metre are covered.
//!
//! A filter needs α's that hold between two corrections, not over one leg: errors of real wheels persist.

use super::checks::{
    Check, CheckName, MAX_INFLATION, MIN_WINDOWS, WindowCoverage, coverage_range, window_checks,
};
use super::fit::{Fit, Sample, free_parameters};
use super::legs::{Leg, distance};
use super::likelihood::{LeastSquares, Parameters, reference_covariance};
use super::optimizer::maximize;
use super::residuals::Observation;
use super::result::Recommended;
use crate::geom::se2::SE2;
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// Error of the motion over a window in exponential coordinates, and what it is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// log of (expected motion)⁻¹ (motion seen).
    error: Vector3<f64>,
    wheels: Matrix3<f64>,
    reference: Matrix3<f64>,
}

impl Window {
    fn squared(&self, inflation: f64) -> f64 {
        let covariance = self.wheels * inflation + self.reference;
        covariance.try_inverse().map_or(f64::INFINITY, |inverse| self.error.dot(&(inverse * self.error)))
    }
}

impl Sample {
    /// Cuts the legs in `range` into windows of `length` (m) driven. None of them contains an outlier or leads across a gap.
    fn windows(&self, range: Range<usize>, length: f64, parameters: &Parameters) -> Vec<Window> {
        let mut windows = Vec::new();
        let (mut first, mut driven) = (range.start, 0.0);
        for leg in range {
            let is_usable = !self.outliers[leg] && self.noise_jacobian(leg).is_some();
            if leg == first || !self.legs[leg].follows || !is_usable {
                (first, driven) = (if is_usable { leg } else { leg + 1 }, 0.0);
            }
            if !is_usable {
                continue;
            }
            let motion = &self.observations[leg].expected;
            driven += distance(motion);
            if driven >= length {
                windows.push(self.window(first, leg, parameters));
                first = leg + 1;
            }
        }
        windows
    }

    fn window(&self, first: usize, last: usize, parameters: &Parameters) -> Window {
        let (mut expected, mut wheels) = (SE2::identity(), Matrix3::zeros());
        for leg in first..=last {
            let observation = &self.observations[leg];
            let motion = observation.expected;
            let carried = motion.inverse().adjoint();
            wheels = carried * wheels * carried.transpose();
            if let Some(jacobian) = self.noise_jacobian(leg) {
                let to_end = to_end_frame(&motion) * jacobian;
                let variances = self.options.model.wheel_variances(&observation.coefficients, parameters);
                wheels += to_end * Matrix3::from_diagonal(&variances) * to_end.transpose();
            }
            expected = expected * motion;
        }
        let whole = Leg {
            reference: [self.legs[first].reference[0], self.legs[last].reference[1]],
            interpolation_variances: [
                self.legs[first].interpolation_variances[0],
                self.legs[last].interpolation_variances[1],
            ],
            ..self.legs[first]
        };
        let seen = self.systematic.motion(&whole);
        let reference = self
            .systematic
            .reference_jacobians(&whole)
            .map(|jacobian| {
                let to_end = to_end_frame(&seen) * jacobian;
                to_end * reference_covariance(parameters) * to_end.transpose()
            })
            .iter()
            .sum();
        Window { error: seen.boxminus(&expected), wheels, reference }
    }

    /// Jacobian of the base's motion by the model's noise; None where the leg does not show all of it. The noise of a turn on the spot
    /// has no first rotation.
    fn noise_jacobian(&self, leg: usize) -> Option<Matrix3<f64>> {
        let Observation { residuals, jacobian, .. } = &self.observations[leg];
        let mut rows = *jacobian;
        if residuals[0].is_nan() {
            let normal = rows.row(1).transpose().cross(&rows.row(2).transpose());
            rows.set_row(0, &normal.transpose());
        }
        rows.try_inverse()
    }
}

/// Jacobian from a motion (x, y, θ) in the frame of its start to one in the frame of its end.
fn to_end_frame(motion: &SE2) -> Matrix3<f64> {
    let (sin, cos) = libm::sincos(motion.theta());
    Matrix3::new(cos, sin, 0.0, -sin, cos, 0.0, 0.0, 0.0, 1.0)
}

/// Returns the fraction of windows inside of their 95 % ellipsoid, and their NEES: the mean squared Mahalanobis distance divided by its 3
/// degrees of freedom. The wheels' variances are multiplied by `inflation`.
fn coverage(windows: &[Window], length: f64, inflation: f64) -> WindowCoverage {
    let squares: Vec<f64> = windows.iter().map(|window| window.squared(inflation)).collect();
    let count = squares.len();
    let inside = squares.iter().filter(|square| **square < CHI2_95[2]).count();
    WindowCoverage {
        length,
        count,
        coverage: inside as f64 / count as f64,
        nees: squares.iter().sum::<f64>() / (3 * count) as f64,
    }
}

/// Standard error of NEES over `count` windows: χ² with 3 degrees of freedom has variance 6.
fn nees_std(count: usize) -> f64 {
    (6.0 / count as f64).sqrt() / 3.0
}

/// Returns the smallest inflation, 1 at least, under which 95 % of the windows are covered and NEES is not above its 95 % interval. None
/// where [`MAX_INFLATION`] is not enough.
fn required_inflation(windows: &[Window]) -> Option<f64> {
    let holds = |inflation: f64| {
        let WindowCoverage { coverage, nees, count, .. } = coverage(windows, 0.0, inflation);
        coverage >= 0.95 && nees <= 1.0 + 1.96 * nees_std(count)
    };
    if windows.len() < MIN_WINDOWS || holds(1.0) {
        return Some(1.0);
    }
    if !holds(MAX_INFLATION) {
        return None;
    }
    let (mut low, mut high) = (1.0, MAX_INFLATION);
    while high / low > 1.005 {
        let middle = f64::sqrt(low * high);
        if holds(middle) { high = middle } else { low = middle }
    }
    Some(high)
}

/// Lengths of the windows, m; the first one is that which the recommended α's have to cover.
const LENGTHS: [f64; 3] = [1.0, 2.0, 5.0];

/// Quantiles 0.95 of χ² with 1, 2 and 3 degrees of freedom.
const CHI2_95: [f64; 3] = [3.841, 5.991, 7.815];

pub(super) struct Recommendation {
    pub recommended: Option<Recommended>,
    pub checks: Vec<Check>,
    pub windows: Vec<WindowCoverage>,
}

/// Fits each half of the log, compares the other one with that, and finds the inflation that windows need.
pub(super) fn recommend(fit: &Fit, all: &Sample, alphas: &[Option<f64>]) -> Recommendation {
    let count = fit.sample.legs.len();
    let halves = [0..count / 2, count / 2..count];
    let free = free_parameters(&fit.sample.options);
    let residuals = halves.map(|half| fit.sample.kept(half));
    let parameters = [0, 1].map(|half| maximize(&residuals[half], fit.maximum.parameters, &free).parameters);
    let (mut inside, mut compared) = (0, 0);
    for (residuals, parameters) in residuals.iter().zip([&parameters[1], &parameters[0]]) {
        let (innovations, LeastSquares { errors, .. }) = residuals.innovations(parameters);
        compared += innovations.len();
        let fits = innovations.iter().map(|innovation| innovation.leg_fit(&errors, false));
        inside += fits.filter(|fit| fit.observed() > 0 && fit.squared < CHI2_95[fit.observed() - 1]).count();
    }
    // Variances of n legs have the relative variance 2/3n; α's share them.
    let scale_std = (2.0 * alphas.len() as f64 / (3 * count / 2).max(1) as f64).sqrt();
    let coverage_by_other_half = inside as f64 / compared as f64;
    let expected = coverage_range(compared, scale_std);
    let mut checks = vec![Check::new(CheckName::HoldoutCovered, coverage_by_other_half, expected)];
    // Windows of the whole log, each under the fit to the half in which it is not.
    let total = all.legs.len();
    let ranges = [0..total / 2, total / 2..total];
    let held_out = |length: f64| -> Vec<Window> {
        let of = |(range, parameters): (&Range<usize>, &Parameters)| {
            all.windows(range.clone(), length, parameters)
        };
        ranges.iter().zip([&parameters[1], &parameters[0]]).flat_map(of).collect()
    };
    let windows: Vec<Vec<Window>> = LENGTHS.map(held_out).into();
    let inflation = required_inflation(&windows[0]);
    let covered: Vec<WindowCoverage> =
        windows.iter().zip(LENGTHS).map(|(windows, length)| coverage(windows, length, 1.0)).collect();
    checks.extend(window_checks(&covered, scale_std));
    let recommended = inflation.map(|inflation| Recommended {
        alphas: alphas.iter().map(|alpha| alpha.map(|alpha| inflation * alpha)).collect(),
        inflation,
        reason: reason(&covered[0], inflation),
    });
    Recommendation { recommended, checks, windows: covered }
}

fn reason(window: &WindowCoverage, inflation: f64) -> String {
    let WindowCoverage { count, coverage, nees, .. } = *window;
    if count < MIN_WINDOWS {
        return format!(
            "The log has {count} windows of 1 m that were not used for the fit; {MIN_WINDOWS} are needed to judge it, so the fit stands as it is."
        );
    }
    let percent = decimal(100.0 * coverage, 1);
    if inflation == 1.0 {
        return format!(
            "The fit covers {percent} % of {count} held-out windows of 1 m, where 95 % is right."
        );
    }
    let [nees, inflation] = [nees, inflation].map(|number| decimal(number, 2));
    format!(
        "The fit covers {percent} % of {count} held-out windows of 1 m (squared error over predicted variance {nees}, where 1 is right); times {inflation} it covers 95 %."
    )
}

/// Prints a positive number with decimals. The formatting of floating-point numbers would be a twentieth of the module for a page.
fn decimal(number: f64, decimals: usize) -> String {
    let scale = 10_u64.pow(decimals as u32);
    let scaled = (number * scale as f64).round() as u64;
    format!("{}.{:0decimals$}", scaled / scale, scaled % scale)
}
