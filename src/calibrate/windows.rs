//! Windows of several legs: whether the α's cover what the robot does over a metre, and by how much to inflate them if not.
//!
//! A filter needs α's that hold between two corrections, not over one leg: errors of real wheels persist.

use super::legs::Leg;
use super::likelihood::{POSITION, Parameters, YAW};
use super::residuals::{Model, Observation};
use super::systematic::Systematic;
use crate::geom::se2::SE2;
use nalgebra::{Matrix3, Vector3};

/// Error of the motion over a window in exponential coordinates, and what it is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window {
    /// log of (expected motion)⁻¹ (motion seen).
    error: Vector3<f64>,
    wheels: Matrix3<f64>,
    reference: Matrix3<f64>,
}

/// Coverage of windows of one length.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize))]
pub struct WindowCoverage {
    /// Least distance driven, m.
    pub length: f64,
    pub count: usize,
    /// Fraction of windows inside of the 95 % ellipsoid.
    pub coverage: f64,
    /// Mean squared Mahalanobis distance over its 3 degrees of freedom (NEES); 1 if the α's hold.
    pub nees: f64,
}

/// Quantile 0.95 of χ² with 3 degrees of freedom.
const CHI2_95: f64 = 7.815;

/// Number of windows below which nothing is concluded from them.
pub(super) const MIN_WINDOWS: usize = 20;

/// Bounds of the inflation.
const MAX_INFLATION: f64 = 100.0;

impl Window {
    fn squared(&self, inflation: f64) -> f64 {
        let covariance = self.wheels * inflation + self.reference;
        covariance.try_inverse().map_or(f64::INFINITY, |inverse| self.error.dot(&(inverse * self.error)))
    }
}

/// Legs with their residuals, as windows are made of them.
pub(super) struct WindowedLegs<'a> {
    pub model: Model,
    pub corrected: &'a Systematic,
    pub legs: &'a [Leg],
    pub observations: &'a [Observation],
    pub outliers: &'a [bool],
}

impl WindowedLegs<'_> {
    /// Cuts the legs in `range` into windows of `length` (m) driven. None of them contains an outlier or leads across a gap.
    pub fn windows(
        &self,
        range: std::ops::Range<usize>,
        length: f64,
        parameters: &Parameters,
    ) -> Vec<Window> {
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
            driven += libm::hypot(motion.x(), motion.y());
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
                let variances = Vector3::from_fn(|k, _| {
                    let [first, second] = self.model.components()[k].alphas;
                    parameters[first] * observation.coefficients[k][0]
                        + parameters[second] * observation.coefficients[k][1]
                });
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
        let seen = self.corrected.motion(&whole);
        let error = Vector3::new(parameters[POSITION], parameters[POSITION], parameters[YAW]);
        let reference = self
            .corrected
            .reference_jacobians(&whole)
            .map(|jacobian| {
                let to_end = to_end_frame(&seen) * jacobian;
                to_end * Matrix3::from_diagonal(&error) * to_end.transpose()
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

/// Returns the fraction of windows inside of their 95 % ellipsoid, and the mean of their squared distance over 3, with the wheels' variances
/// inflated.
pub(super) fn coverage(windows: &[Window], length: f64, inflation: f64) -> WindowCoverage {
    let squares: Vec<f64> = windows.iter().map(|window| window.squared(inflation)).collect();
    let count = squares.len();
    let inside = squares.iter().filter(|square| **square < CHI2_95).count();
    WindowCoverage {
        length,
        count,
        coverage: inside as f64 / count as f64,
        nees: squares.iter().sum::<f64>() / (3 * count) as f64,
    }
}

/// Standard error of NEES over `count` windows: χ² with 3 degrees of freedom has variance 6.
pub(super) fn nees_std(count: usize) -> f64 {
    (6.0 / count as f64).sqrt() / 3.0
}

/// Returns the smallest inflation, 1 at least, under which 95 % of the windows are covered and NEES is not above its 95 % interval.
pub(super) fn required_inflation(windows: &[Window]) -> f64 {
    let holds = |inflation: f64| {
        let WindowCoverage { coverage, nees, count, .. } = coverage(windows, 0.0, inflation);
        coverage >= 0.95 && nees <= 1.0 + 1.96 * nees_std(count)
    };
    if windows.len() < MIN_WINDOWS || holds(1.0) {
        return 1.0;
    }
    let (mut low, mut high) = (1.0, MAX_INFLATION);
    while high / low > 1.005 {
        let middle = f64::sqrt(low * high);
        if holds(middle) { high = middle } else { low = middle }
    }
    high
}
