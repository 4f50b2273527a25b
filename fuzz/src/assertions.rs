//! Assertions on numbers that figures display.

use motion::geom::se2::SE2;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

pub fn assert_finite(quantity_name: &str, numbers: &[f64]) {
    assert!(numbers.iter().all(|number| number.is_finite()), "{quantity_name}: {numbers:?}");
}

pub fn assert_all_finite_or_all_nan(quantity_name: &str, numbers: &[f64]) {
    if !numbers.iter().all(|number| number.is_nan()) {
        assert_finite(quantity_name, numbers);
    }
}

pub fn assert_fraction(quantity_name: &str, fraction: f64) {
    assert!(fraction.is_nan() || (0.0..=1.0).contains(&fraction), "{quantity_name}: {fraction}");
}

pub fn assert_pose(quantity_name: &str, pose: &SE2) {
    assert_finite(quantity_name, &[pose.x(), pose.y(), pose.theta()]);
    assert!(-PI < pose.theta() && pose.theta() <= PI, "{quantity_name}: {pose:?}");
}

/// Asserts that moments are finite, and that the covariance is symmetric without a correlation above 1. The tolerance for rounding is
/// in proportion to the magnitudes of the values.
pub fn assert_valid_moments(quantity_name: &str, mean: &Vector3<f64>, cov: &Matrix3<f64>) {
    assert_finite(quantity_name, mean.as_slice());
    assert_finite(quantity_name, cov.as_slice());
    let coordinate_scales = Vector3::from_fn(|i, _| mean[i].abs() + cov[(i, i)].sqrt());
    let position_magnitude = coordinate_scales.x + coordinate_scales.y;
    let coordinate_scales = [position_magnitude, position_magnitude, coordinate_scales.z];
    for i in 0..3 {
        assert!(cov[(i, i)] >= 0.0, "{quantity_name}: {mean:?} {cov:?}");
        for j in 0..i {
            let max_cov = cov[(i, i)].sqrt() * cov[(j, j)].sqrt();
            let tolerance = ROUNDING_TOLERANCE * coordinate_scales[i] * coordinate_scales[j]
                + SQUARE_UNDERFLOW_LIMIT * (coordinate_scales[i] + coordinate_scales[j]);
            assert!((cov[(i, j)] - cov[(j, i)]).abs() <= tolerance, "{quantity_name}: {mean:?} {cov:?}");
            assert!(cov[(i, j)].abs() <= max_cov + tolerance, "{quantity_name}: {mean:?} {cov:?}");
        }
    }
}

/// Relative rounding error of a few dozen units in the last place.
pub const ROUNDING_TOLERANCE: f64 = 64.0 * f64::EPSILON;

/// Limit below which the square of a number may underflow to 0.
pub const SQUARE_UNDERFLOW_LIMIT: f64 = 1e-161;

/// Asserts that two lists have the same numbers, where NaN equals NaN.
pub fn assert_same_numbers(list_name: &str, a: &[f64], b: &[f64]) {
    let are_equal = |(a, b): (&f64, &f64)| a == b || (a.is_nan() && b.is_nan());
    assert!(a.len() == b.len() && a.iter().zip(b).all(are_equal), "{list_name}: {a:?} and {b:?}");
}
