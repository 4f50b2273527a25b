//! Sine and cosine of four angles in SIMD lanes: accuracy over the whole range, and independence of the lanes from each other.

use crate::common::seeded_rng;
use motion::geom::lanes::{MAX_SIN_COS_ERROR, Trigonometry};
use motion::geom::se2::wrap_angle;
use rand::RngExt;
use std::f64::consts::{FRAC_PI_2, PI};
use wide::f64x4;

/// Returns angles of either sign that are log-uniform over 32 decades, and angles near multiples of a quarter turn.
fn list_tested_angles() -> Vec<f64> {
    let mut rng = seeded_rng(9);
    let mut tested_angles =
        vec![0.0, -0.0, FRAC_PI_2, -FRAC_PI_2, PI, -PI, f64::MIN_POSITIVE, 3e6, -3e6, 3.1e6];
    for _ in 0..20_000 {
        let absolute_angle = libm::pow(10.0, rng.random_range(-17.0..15.0));
        tested_angles.push(if rng.random() { absolute_angle } else { -absolute_angle });
        tested_angles.push(rng.random_range(-2.0 * PI..2.0 * PI));
        let multiple_of_quarter_turn = f64::from(rng.random_range(-2000..2000)) * FRAC_PI_2;
        tested_angles.push(multiple_of_quarter_turn + libm::pow(10.0, rng.random_range(-16.0..0.0)));
    }
    tested_angles
}

fn first_lane_of(equal_lanes: f64x4) -> f64 {
    equal_lanes.to_array()[0]
}

#[test]
fn sines_and_cosines_agree_with_libm_over_the_whole_range() {
    let lane_trigonometry = Trigonometry::default();
    for angle in list_tested_angles() {
        let sin_cos = lane_trigonometry.sin_cos_any_angle(f64x4::splat(angle));
        let expected_sinc = if angle == 0.0 { 1.0 } else { libm::sin(angle) / angle };
        assert!((first_lane_of(sin_cos.sin) - libm::sin(angle)).abs() <= MAX_SIN_COS_ERROR, "sin {angle}");
        assert!((first_lane_of(sin_cos.cos) - libm::cos(angle)).abs() <= MAX_SIN_COS_ERROR, "cos {angle}");
        assert!((first_lane_of(sin_cos.sinc) - expected_sinc).abs() <= MAX_SIN_COS_ERROR, "sinc {angle}");
        if angle.abs() <= FRAC_PI_2 {
            // The sine of a small angle has the same relative accuracy as that of a large one.
            assert!(
                (first_lane_of(sin_cos.sin) - libm::sin(angle)).abs() <= MAX_SIN_COS_ERROR * angle.abs(),
                "sin {angle}"
            );
        }
    }
}

#[test]
fn half_headings_lie_on_the_requested_branch() {
    let lane_trigonometry = Trigonometry::default();
    for branch_centre in [0.0, 0.25, -1.5, 1.7, -2.9] {
        for half_heading in list_tested_angles().into_iter().step_by(7) {
            let (half_turn_lanes, sin_cos) =
                lane_trigonometry.sin_cos_on_branch(f64x4::splat(half_heading), branch_centre);
            let expected_half_turn = branch_centre + 0.5 * wrap_angle(2.0 * (half_heading - branch_centre));
            let half_turn = first_lane_of(half_turn_lanes);
            // Reducing the angle by half circles causes rounding in proportion to their number. An angle at one end of the branch may be
            // reduced to the other end.
            let rounding_tolerance = MAX_SIN_COS_ERROR * (1.0 + half_heading.abs());
            let half_turn_error = (half_turn - expected_half_turn)
                .abs()
                .min(((half_turn - expected_half_turn).abs() - PI).abs());
            assert!(
                half_turn_error <= rounding_tolerance,
                "{half_heading} near {branch_centre}: {half_turn} is not {expected_half_turn}"
            );
            assert!(
                (half_turn - branch_centre).abs() <= FRAC_PI_2 + rounding_tolerance,
                "{half_heading} near {branch_centre}: {half_turn}"
            );
            let (sin, cos) = libm::sincos(half_turn);
            assert!((first_lane_of(sin_cos.sin).abs() - sin.abs()).abs() <= rounding_tolerance);
            assert!(
                (first_lane_of(sin_cos.sin) * first_lane_of(sin_cos.cos) - sin * cos).abs()
                    <= 2.0 * rounding_tolerance
            );
            let half_turn_cotangent = if half_turn == 0.0 { 1.0 } else { half_turn * cos / sin };
            // The cotangent divides the error of the sine by the square of the sine.
            let cotangent_tolerance = 4.0 * rounding_tolerance * (1.0 + half_turn.abs())
                / (sin * sin / (half_turn * half_turn).min(1.0)).max(1e-300);
            assert!(
                (first_lane_of(sin_cos.cos / sin_cos.sinc) - half_turn_cotangent).abs()
                    <= cotangent_tolerance.max(4.0 * MAX_SIN_COS_ERROR),
                "{half_heading} {branch_centre}"
            );
        }
    }
}
