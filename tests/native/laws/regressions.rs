//! Regression tests of failures that property tests and fuzzing found.

use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::map::FloorPlan;
use motion::sim::banana::{BananaMachine, Settings};
use motion::stats::CrossTrackStats;
use motion::{MotionModel, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel};
use std::f64::consts::PI;

#[test]
fn the_skew_error_is_not_zero_if_sixth_powers_underflow() {
    for (unit, is_finite) in [(1.0, true), (1e-48, true), (1e-52, false), (1e-60, false), (1e-110, false)] {
        let tiny_cloud = [0.0, 1.0, 3.0, 7.0].map(|y| SE2::new(unit, unit * y, 0.0));
        let cross_track = CrossTrackStats::from_poses(&tiny_cloud);
        let skew_and_error = [cross_track.skew, cross_track.skew_error];
        assert!(skew_and_error.iter().all(|value| value.is_finite() == is_finite), "{unit}: {cross_track:?}");
    }
    let tiny_command = VelocityCmd { v: 1e-60, omega: 0.5, dt: 1.0 };
    let alphas = [0.05, 0.0, 0.05, 0.05, 0.0, 0.0];
    let settings =
        Settings { command: tiny_command, velocity_alphas: alphas, samples: 100, ..Settings::default() };
    let stats = *BananaMachine::new(settings).expect("allowed").stats();
    assert!(stats.cross_track_skew.is_nan() && stats.cross_track_skew_error.is_nan(), "{stats:?}");
}

/// The direction of a subnormal chord must not be computed with a reciprocal, which overflows.
#[test]
fn an_arc_of_subnormal_length_is_tested_correctly() {
    let plan = FloorPlan::apartment();
    for length in [0.0, 1e-300, 9.7e-310, 5e-324, -5e-324] {
        for turn in [0.0, 1.7e-308, 0.5, 3.0, 100.0] {
            let start_pose = SE2::new(2.05, 2.6, 1.0);
            assert!(plan.test_arc(&Arc { start: start_pose, length, turn }, 0.13).is_free, "{length} {turn}");
            assert!(!plan.test_arc(&Arc { start: SE2::new(2.05, 0.1, 1.0), length, turn }, 0.13).is_free);
        }
    }
}

fn new_model(alphas: [f64; 6]) -> VelocityModel {
    VelocityModel { alphas: VelocityAlphas(alphas), noise: NoiseKind::Normal }
}

/// The circumference of a circle may overflow to ∞ where the density of the speed is 0. Their product must count as 0.
#[test]
fn an_arc_around_a_circle_too_long_for_a_double_has_density_zero() {
    let velocity_model = new_model([0.0, 0.55, 0.0, 0.29, 0.0, 0.41]);
    let u = VelocityCmd { v: 0.0, omega: 882_194.88, dt: 1e-6 };
    let (x, x_next) = (SE2::new(0.0, -3e-269, 0.0), SE2::new(5.3e17, 0.0, 0.0));
    assert_eq!(velocity_model.pose_density(&x_next, &u, &x), Some(0.0));
}

#[test]
fn a_displacement_with_a_subnormal_square_counts_as_zero() {
    let velocity_model = new_model([0.0, 0.73, 0.06, 0.0, 0.0, 0.33]);
    let u = VelocityCmd { v: 78.0, omega: 38.0, dt: 633_457.9 };
    let (x, next_pose) = (SE2::new(2.2e-308, 0.0, PI), SE2::identity());
    assert_eq!(velocity_model.pose_density(&next_pose, &u, &x), velocity_model.pose_density(&x, &u, &x));
}

/// The inverse of a covariance's root is applied twice, and is huge for a subnormal variance. The product 0 · ∞ must not become NaN.
#[test]
fn a_last_turn_with_a_tiny_variance_has_a_finite_density() {
    let u = VelocityCmd { v: 56.0, omega: 0.0, dt: 1e-6 };
    let tangent_model = TangentNoiseModel::from_velocity(&new_model([0.0, 0.0, 0.0, 0.0, 2.2e-308, 0.0]), &u)
        .expect("variances");
    let log_prob = tangent_model.log_prob(&SE2::new(-8.9e17, 0.0, 1e-6), &u, &SE2::identity());
    assert!(log_prob < 0.0, "{log_prob}");
}

/// The search for a free pose divides the area into squares. On a floor plan whose sides differ by a factor above 256, it must divide the
/// shorter side too.
#[test]
fn a_narrow_plan_has_a_free_pose() {
    for plan_bounds in [[0.0, 0.0, 100.0, 0.3], [0.0, 0.0, 0.01, 100.0], [-1e6, 5.0, -9e5, 5.02]] {
        let plan = FloorPlan::new(Vec::new(), plan_bounds).expect("bounds");
        let free_pose = plan.find_free_pose(0.0).expect("nothing is in the way");
        assert!(plan.test_point([free_pose.x(), free_pose.y()], 0.0).is_free, "{free_pose:?}");
    }
}
