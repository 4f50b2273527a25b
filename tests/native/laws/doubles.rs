//! Proptest strategies for doubles, poses and twists of any size, and the configuration of property tests.

use motion::geom::se2::SE2;
use nalgebra::Vector3;
use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Returns a configuration with a fixed seed, so that results are equal on every machine. Failing cases are not stored. Each becomes a
/// test of its own in `regressions.rs`.
pub fn new_proptest_config(case_count: u32) -> ProptestConfig {
    ProptestConfig {
        cases: case_count,
        rng_seed: RngSeed::Fixed(19),
        failure_persistence: None,
        max_global_rejects: 10 * case_count,
        max_local_rejects: 100 * case_count,
        ..ProptestConfig::default()
    }
}

pub fn any_double() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => any::<u64>().prop_map(f64::from_bits),
        1 => finite_doubles(),
        1 => prop_oneof![Just(f64::INFINITY), Just(f64::NEG_INFINITY), Just(f64::NAN), Just(-f64::NAN)],
    ]
}

/// Returns finite doubles of any exponent, of common sizes, and near limits of ranges.
pub fn finite_doubles() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO,
        3 => -100.0..100.0,
        2 => range_limits(),
    ]
}

/// Returns limits of floating-point arithmetic and of angles, such as the smallest normal double or π, and their neighbouring doubles.
fn range_limits() -> impl Strategy<Value = f64> {
    const LIMITS_OF_RANGES: [f64; 15] = [
        0.0,
        f64::from_bits(1),
        f64::MIN_POSITIVE,
        f64::EPSILON,
        1e-6,
        0.5,
        1.0,
        FRAC_PI_2,
        PI,
        TAU,
        100.0,
        1e6,
        1e18,
        9_007_199_254_740_993.0,
        f64::MAX,
    ];
    (0..LIMITS_OF_RANGES.len(), any::<bool>(), -1..=1).prop_map(|(i, is_negative, neighbour_step)| {
        let neighbouring_double = match neighbour_step {
            -1 => LIMITS_OF_RANGES[i].next_down(),
            0 => LIMITS_OF_RANGES[i],
            _ => LIMITS_OF_RANGES[i].next_up().min(f64::MAX),
        };
        if is_negative { -neighbouring_double } else { neighbouring_double }
    })
}

pub fn doubles_up_to(max_abs: f64) -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => finite_doubles().prop_filter("too large", move |drawn_number| drawn_number.abs() <= max_abs),
        1 => -max_abs..=max_abs,
        1 => prop_oneof![Just(max_abs), Just(-max_abs)],
    ]
}

/// Largest coordinate of the poses and twists. Sums of such coordinates, and their products with an angle, do not overflow.
pub const MAX_COORDINATE: f64 = 1e300;

pub fn any_pose() -> impl Strategy<Value = SE2> {
    (doubles_up_to(MAX_COORDINATE), doubles_up_to(MAX_COORDINATE), doubles_up_to(PI))
        .prop_map(|(x, y, theta)| SE2::new(x, y, theta))
}

pub fn any_twist(max_turn: f64) -> impl Strategy<Value = Vector3<f64>> {
    (doubles_up_to(MAX_COORDINATE), doubles_up_to(MAX_COORDINATE), doubles_up_to(max_turn))
        .prop_map(|(x, y, twist_turn)| Vector3::new(x, y, twist_turn))
}

pub fn sum_of_coordinates(pose: &SE2) -> f64 {
    pose.x().abs() + pose.y().abs()
}

/// Asserts that positions are equal up to `units_in_last_place` of `scale`, and headings up to as many units of a full circle.
pub fn assert_same_pose(a: &SE2, b: &SE2, units_in_last_place: f64, scale: f64) -> Result<(), TestCaseError> {
    let tolerance = units_in_last_place * f64::EPSILON * scale + f64::MIN_POSITIVE;
    let heading_difference = libm::remainder(a.theta() - b.theta(), TAU).abs();
    let is_position_equal = (a.x() - b.x()).abs() <= tolerance && (a.y() - b.y()).abs() <= tolerance;
    prop_assert!(
        is_position_equal && heading_difference <= units_in_last_place * f64::EPSILON * TAU,
        "{:?} and {:?}, allowed {}",
        a,
        b,
        tolerance
    );
    Ok(())
}
