//! Arcs and odometry readings that are computed from two poses and lead from one to the other.

use super::doubles::{any_pose, assert_same_pose, doubles_up_to, new_proptest_config, sum_of_coordinates};
use motion::geom::arc::{Arc, arc_end, arc_with_turn_near, invert_arc};
use motion::geom::se2::SE2;
use motion::models::OdomDelta;
use proptest::prelude::*;
use std::f64::consts::PI;

/// Tolerance in units in the last place. Each map tested here composes up to eight maps with errors of a few units.
const TOLERANCE_ULPS: f64 = 64.0;

fn any_duration() -> impl Strategy<Value = f64> {
    prop_oneof![1e-6..1e6, Just(1e-6), Just(1e6), Just(1.0)]
}

proptest! {
    #![proptest_config(new_proptest_config(400))]

    #[test]
    fn an_inverted_arc_ends_at_the_given_pose(x in any_pose(), x_next in any_pose(), dt in any_duration()) {
        let inverted_arc = invert_arc(&x, &x_next, dt);
        let [arc_length, arc_turn, last_turn] = [inverted_arc.v_hat, inverted_arc.omega_hat, inverted_arc.gamma_hat].map(|rate_of_motion| rate_of_motion * dt);
        let max_turn = PI * (1.0 + 2.0 * f64::EPSILON);
        prop_assert!(arc_turn.abs() <= max_turn && last_turn.abs() <= max_turn, "{:?}", inverted_arc);
        let (forward_offset, left_offset) = arc_end(arc_length, arc_turn);
        let end_pose = x * SE2::new(forward_offset, left_offset, arc_turn + last_turn);
        assert_same_pose(&end_pose, &x_next, TOLERANCE_ULPS, sum_of_coordinates(&x) + sum_of_coordinates(&x_next))?;
    }

    /// The start is the origin, whose coordinates add no rounding. Turns stay below half a turn. At half a turn, rounding would decide
    /// between forward and reverse.
    #[test]
    fn inverting_a_driven_arc_returns_its_controls(arc_length in doubles_up_to(1e300), arc_turn in doubles_up_to(3.1), last_turn in doubles_up_to(3.1), dt in any_duration()) {
        let (forward_offset, left_offset) = arc_end(arc_length, arc_turn);
        // If a chord is shorter or longer than these limits, its computed bearing is inaccurate.
        prop_assume!(forward_offset.hypot(left_offset) > 1e-290 && forward_offset.hypot(left_offset) < 1e290);
        let inverted_arc = invert_arc(&SE2::identity(), &SE2::new(forward_offset, left_offset, arc_turn + last_turn), dt);
        let rounding_tolerance = TOLERANCE_ULPS * f64::EPSILON;
        prop_assert!((inverted_arc.v_hat * dt - arc_length).abs() <= rounding_tolerance * arc_length.abs(), "{:?}", inverted_arc);
        // If a turn is below `smallest_turn`, the rounding of the chord hides the turn.
        let smallest_turn = f64::MIN_POSITIVE * (1.0 + 1.0 / forward_offset.hypot(left_offset));
        prop_assert!((inverted_arc.omega_hat * dt - arc_turn).abs() <= rounding_tolerance * arc_turn.abs() + smallest_turn, "{:?}", inverted_arc);
        prop_assert!((inverted_arc.gamma_hat * dt - last_turn).abs() <= rounding_tolerance * PI, "{:?}", inverted_arc);
    }

    #[test]
    fn arcs_with_additional_full_turns_end_at_the_same_position(x in -50.0..50.0, y in -50.0..50.0, requested_turn in -300.0..300.0) {
        let target_pose = SE2::new(x, y, 0.0);
        let (arc_length, arc_turn) = arc_with_turn_near(&SE2::identity(), &target_pose, requested_turn);
        // A nearly straight arc that adds full turns is so long that its end cannot be represented.
        prop_assume!(arc_length.abs() < 1e6);
        prop_assert!(arc_turn == 0.0 || (arc_turn - requested_turn).abs() <= PI * (1.0 + 1e-12), "{}", arc_turn);
        let end_pose = Arc { start: SE2::identity(), length: arc_length, turn: arc_turn }.end();
        let end_position_error = (end_pose.x() - x).hypot(end_pose.y() - y);
        prop_assert!(end_position_error <= TOLERANCE_ULPS * f64::EPSILON * (arc_length.abs() + sum_of_coordinates(&target_pose)), "{:e}", end_position_error);
    }

    /// A displacement below a nanometre counts as 0 in an odometry reading.
    #[test]
    fn an_odometry_reading_leads_to_the_second_pose(first_pose in any_pose(), second_pose in any_pose()) {
        let odometry_reading = OdomDelta::from_poses(&first_pose, &second_pose);
        prop_assert!(odometry_reading.trans >= 0.0 && [odometry_reading.rot1, odometry_reading.rot2].iter().all(|arc_turn| -PI < *arc_turn && *arc_turn <= PI));
        let coordinate_extent = sum_of_coordinates(&first_pose) + sum_of_coordinates(&second_pose);
        let displacement_tolerance = 1e-9 / (TOLERANCE_ULPS * f64::EPSILON);
        assert_same_pose(&odometry_reading.apply(&first_pose), &second_pose, TOLERANCE_ULPS, coordinate_extent + if odometry_reading.trans == 0.0 { displacement_tolerance } else { 0.0 })?;
    }

    #[test]
    fn an_odometry_reading_does_not_depend_on_the_frame(x in -1e3..1e3, y in -1e3..1e3, theta in -3.0..3.0, frame_shift in (-1e3..1e3, -1e3..1e3, -3.0..3.0)) {
        let (first_pose, second_pose) = (SE2::new(1.0, 2.0, 0.5), SE2::new(x, y, theta));
        let frame_shift = SE2::new(frame_shift.0, frame_shift.1, frame_shift.2);
        let (odometry_reading, reading_in_moved_frame) = (OdomDelta::from_poses(&first_pose, &second_pose), OdomDelta::from_poses(&(frame_shift * first_pose), &(frame_shift * second_pose)));
        // The bearing of a displacement that is small relative to the coordinates loses digits.
        prop_assume!(odometry_reading.trans > 1.0);
        let rounding_tolerance = TOLERANCE_ULPS * f64::EPSILON * 1e4;
        prop_assert!((odometry_reading.trans - reading_in_moved_frame.trans).abs() <= rounding_tolerance);
        for (a, b) in [(odometry_reading.rot1, reading_in_moved_frame.rot1), (odometry_reading.rot2, reading_in_moved_frame.rot2)] {
            prop_assert!(libm::remainder(a - b, 2.0 * PI).abs() <= rounding_tolerance, "{} {}", a, b);
        }
    }
}
