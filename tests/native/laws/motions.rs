//! Arcs and odometry readings that are computed from two poses and lead from one to the other.

use super::doubles::{any_pose, assert_same_pose, doubles_up_to, position_extent, proptest_config};
use motion::geom::arc::{Arc, arc_end, arc_with_turn_near, invert_arc};
use motion::geom::se2::SE2;
use motion::models::OdomDelta;
use proptest::prelude::*;
use std::f64::consts::PI;

/// Tolerance in units in the last place. Each map tested here composes up to eight maps with errors of a few units.
const TOLERANCE_UNITS: f64 = 64.0;

fn any_duration() -> impl Strategy<Value = f64> {
    prop_oneof![1e-6..1e6, Just(1e-6), Just(1e6), Just(1.0)]
}

proptest! {
    #![proptest_config(proptest_config(400))]

    /// For any two poses, the inverted controls lead from one to the other.
    #[test]
    fn an_inverted_arc_ends_at_the_given_pose(x in any_pose(), x_next in any_pose(), dt in any_duration()) {
        let inversion = invert_arc(&x, &x_next, dt);
        let [arc_length, arc_turn, last_turn] = [inversion.v_hat, inversion.omega_hat, inversion.gamma_hat].map(|rate| rate * dt);
        let max_turn = PI * (1.0 + 2.0 * f64::EPSILON);
        prop_assert!(arc_turn.abs() <= max_turn && last_turn.abs() <= max_turn, "{:?}", inversion);
        let (forward, left) = arc_end(arc_length, arc_turn);
        let end_pose = x * SE2::new(forward, left, arc_turn + last_turn);
        assert_same_pose(&end_pose, &x_next, TOLERANCE_UNITS, position_extent(&x) + position_extent(&x_next))?;
    }

    /// The start is the origin, whose coordinates add no rounding. Turns stay below half a turn, where rounding would decide
    /// between forward and reverse.
    #[test]
    fn inverting_a_driven_arc_returns_its_controls(arc_length in doubles_up_to(1e300), arc_turn in doubles_up_to(3.1), last_turn in doubles_up_to(3.1), dt in any_duration()) {
        let (forward, left) = arc_end(arc_length, arc_turn);
        // The bearing of a chord outside these limits is inaccurate.
        prop_assume!(forward.hypot(left) > 1e-290 && forward.hypot(left) < 1e290);
        let inversion = invert_arc(&SE2::identity(), &SE2::new(forward, left, arc_turn + last_turn), dt);
        let rounding_tolerance = TOLERANCE_UNITS * f64::EPSILON;
        prop_assert!((inversion.v_hat * dt - arc_length).abs() <= rounding_tolerance * arc_length.abs(), "{:?}", inversion);
        // Turns below `chord_rounding` are lost in the rounding of the chord.
        let chord_rounding = f64::MIN_POSITIVE * (1.0 + 1.0 / forward.hypot(left));
        prop_assert!((inversion.omega_hat * dt - arc_turn).abs() <= rounding_tolerance * arc_turn.abs() + chord_rounding, "{:?}", inversion);
        prop_assert!((inversion.gamma_hat * dt - last_turn).abs() <= rounding_tolerance * PI, "{:?}", inversion);
    }

    /// With any number of additional full turns the arc ends at the same place.
    #[test]
    fn arcs_with_additional_full_turns_end_at_the_same_position(x in -50.0..50.0, y in -50.0..50.0, near_turn in -300.0..300.0) {
        let target_pose = SE2::new(x, y, 0.0);
        let (arc_length, arc_turn) = arc_with_turn_near(&SE2::identity(), &target_pose, near_turn);
        // The circle of a nearly straight arc is so long that its end cannot be represented.
        prop_assume!(arc_length.abs() < 1e6);
        prop_assert!(arc_turn == 0.0 || (arc_turn - near_turn).abs() <= PI * (1.0 + 1e-12), "{}", arc_turn);
        let end_pose = Arc { start: SE2::identity(), length: arc_length, turn: arc_turn }.end();
        let end_position_error = (end_pose.x() - x).hypot(end_pose.y() - y);
        prop_assert!(end_position_error <= TOLERANCE_UNITS * f64::EPSILON * (arc_length.abs() + position_extent(&target_pose)), "{:e}", end_position_error);
    }

    /// A displacement below a nanometre counts as 0 in an odometry reading.
    #[test]
    fn an_odometry_reading_leads_to_the_second_pose(prev in any_pose(), curr in any_pose()) {
        let reading = OdomDelta::from_poses(&prev, &curr);
        prop_assert!(reading.trans >= 0.0 && [reading.rot1, reading.rot2].iter().all(|arc_turn| -PI < *arc_turn && *arc_turn <= PI));
        let total_extent = position_extent(&prev) + position_extent(&curr);
        let displacement_tolerance = 1e-9 / (TOLERANCE_UNITS * f64::EPSILON);
        assert_same_pose(&reading.apply(&prev), &curr, TOLERANCE_UNITS, total_extent + if reading.trans == 0.0 { displacement_tolerance } else { 0.0 })?;
    }

    /// The reading depends on the relative pose only. It stays the same if both poses move with their frame.
    #[test]
    fn an_odometry_reading_does_not_depend_on_the_frame(x in -1e3..1e3, y in -1e3..1e3, theta in -3.0..3.0, frame in (-1e3..1e3, -1e3..1e3, -3.0..3.0)) {
        let (prev, curr) = (SE2::new(1.0, 2.0, 0.5), SE2::new(x, y, theta));
        let frame = SE2::new(frame.0, frame.1, frame.2);
        let (reading, moved_reading) = (OdomDelta::from_poses(&prev, &curr), OdomDelta::from_poses(&(frame * prev), &(frame * curr)));
        // The bearing of a displacement that is small relative to the coordinates loses digits.
        prop_assume!(reading.trans > 1.0);
        let rounding_tolerance = TOLERANCE_UNITS * f64::EPSILON * 1e4;
        prop_assert!((reading.trans - moved_reading.trans).abs() <= rounding_tolerance);
        for (a, b) in [(reading.rot1, moved_reading.rot1), (reading.rot2, moved_reading.rot2)] {
            prop_assert!(libm::remainder(a - b, 2.0 * PI).abs() <= rounding_tolerance, "{} {}", a, b);
        }
    }
}
