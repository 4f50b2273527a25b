//! Predicted covariances of the recursions after each step, compared with the covariance of the robots.

use super::rollouts::MeasuredMoments;
use super::settings::Settings;
use crate::js::js_structs;
use crate::models::{Compounding, TangentNoiseModel, covariance_root};
use nalgebra::{Matrix3, Vector3};

/// Recursions that are compared, in the order in which they are listed.
pub const RECURSIONS: [Compounding; 3] =
    [Compounding::Chapter, Compounding::FirstOrder, Compounding::FourthOrder];

/// Relative error of a variance above which a step counts as a miss.
pub const MISS_TOLERANCE: f64 = 0.05;

/// Maximum relative standard error at which rollouts can establish a miss, a quarter of the tolerance. Of dozens of ratios
/// some are off by three standard errors by chance, but hardly any by four.
const MAX_STANDARD_ERROR: f64 = MISS_TOLERANCE / 4.0;

/// Standard deviation below which a spread is only rounding. It is relative to the path, or in radians.
const NEGLIGIBLE_STD: f64 = 1e-12;

/// Comparison of a recursion with the robots.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Predicted divided by measured variance of along, lateral and heading after each step; NaN if one of them is undefined.
    pub ratios: Vec<Vector3<f64>>,
    /// Steps at which the prediction is off, for along, lateral and heading.
    pub misses: [Misses; 3],
}

js_structs! {
    /// Misses: steps at which the ratio of one component is off by more than 5 % ([`MISS_TOLERANCE`]).
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Misses {
        /// True if there is a spread, and enough robots to decide whether a step is a miss.
        pub decidable: bool,
        /// First step with a miss; null (None) if there is none, or if that cannot be decided.
        pub first: Option<u32>,
        /// Last step with a miss.
        pub last: Option<u32>,
        /// Predicted over measured variance after the last step, minus 1; NaN without a prediction or a measured spread.
        pub end: f64,
        /// Standard error of `end`.
        pub error: f64,
    }
}

impl Comparison {
    /// Compares predicted covariances after each step with those measured. `None` stands for a step at which
    /// the recursion has no covariance, because its matrix is indefinite.
    pub fn new(settings: &Settings, covs: &[Option<Matrix3<f64>>], measured: &[MeasuredMoments]) -> Self {
        let negligible_stds = negligible_stds(settings);
        let ratios: Vec<Vector3<f64>> = covs
            .iter()
            .zip(measured)
            .map(|(cov, measured)| match cov {
                Some(cov) => variance_ratio(cov, measured, &negligible_stds),
                None => Vector3::repeat(f64::NAN),
            })
            .collect();
        let misses = std::array::from_fn(|axis| misses_of(&ratios, measured, axis));
        Self { ratios, misses }
    }
}

/// Returns the covariance of ξ after each step from a known start, by a recursion; the first is that of step 1. It is None
/// from the step on at which the fourth-order terms make the matrix indefinite.
pub fn propagate_covariances(settings: &Settings, order: Compounding) -> Vec<Option<Matrix3<f64>>> {
    let twist = TangentNoiseModel::twist(&settings.command);
    // All allowed settings have finite variances of 0 or more.
    let tangent_noise = TangentNoiseModel::from_velocity(&settings.model(), &settings.command).ok();
    let mut covariance = Some(Matrix3::zeros());
    (0..settings.steps)
        .map(|_| {
            covariance = covariance
                .zip(tangent_noise)
                .map(|(sigma, noise)| noise.propagate(&sigma, &twist, order))
                .filter(|next| covariance_root(next).is_ok());
            covariance
        })
        .collect()
}

/// Returns the largest standard deviations of ξ (m, m, rad) that count as 0.
fn negligible_stds(settings: &Settings) -> Vector3<f64> {
    let u = &settings.command;
    let negligible_length = NEGLIGIBLE_STD * (u.v * u.dt).abs() * f64::from(settings.steps);
    Vector3::new(negligible_length, negligible_length, NEGLIGIBLE_STD)
}

fn variance_ratio(
    cov: &Matrix3<f64>,
    measured: &MeasuredMoments,
    negligible_stds: &Vector3<f64>,
) -> Vector3<f64> {
    Vector3::from_fn(|i, _| {
        let variance = measured.cov[(i, i)];
        if variance > negligible_stds[i] * negligible_stds[i] { cov[(i, i)] / variance } else { f64::NAN }
    })
}

fn misses_of(ratios: &[Vector3<f64>], measured: &[MeasuredMoments], axis: usize) -> Misses {
    let defined_ratios =
        || ratios.iter().map(|ratio| ratio[axis]).zip(measured).filter(|(ratio, _)| !ratio.is_nan());
    let is_decidable = defined_ratios().next().is_some()
        && defined_ratios().all(|(_, measured)| measured.relative_error[axis] <= MAX_STANDARD_ERROR);
    let is_miss = |ratio: &Vector3<f64>| is_decidable && (ratio[axis] - 1.0).abs() > MISS_TOLERANCE;
    let step_number = |index: usize| index as u32 + 1;
    let [end, error] = match (ratios.last(), measured.last()) {
        (Some(ratio), Some(measured)) => [ratio[axis] - 1.0, ratio[axis] * measured.relative_error[axis]],
        _ => [f64::NAN; 2],
    };
    Misses {
        decidable: is_decidable,
        first: ratios.iter().position(is_miss).map(step_number),
        last: ratios.iter().rposition(is_miss).map(step_number),
        end,
        error,
    }
}
