//! Trajectories, and their division into legs.

use super::{new_trajectory, split_into_legs};
use motion::calibrate::{Leg, LegLength, LostLegs, Trajectory};
use motion::geom::se2::{SE2, wrap_angle};
use nalgebra::Vector3;

const AMCL_LENGTH: LegLength = LegLength::Displacement { distance: 0.25, angle: 0.2 };

/// Returns the trajectory of a robot that drives straight ahead, with a row every 0.1 s.
fn new_straight_drive(row_count: usize, step_length: f64) -> Trajectory {
    new_trajectory((0..row_count).map(|row| (0.1 * row as f64, SE2::new(step_length * row as f64, 0.0, 0.0))))
}

fn remove_rows_between(full_trajectory: &Trajectory, first_row: usize, last_row: usize) -> Trajectory {
    super::new_trajectory(
        full_trajectory
            .samples()
            .enumerate()
            .filter(|(row_index, _)| !(first_row < *row_index && *row_index < last_row))
            .map(|(_, timed_pose)| timed_pose),
    )
}

fn times_of_legs(leg_list: &[Leg]) -> Vec<[f64; 2]> {
    leg_list.iter().map(|leg| leg.times).collect()
}

fn times_of(full_trajectory: &Trajectory) -> Vec<f64> {
    full_trajectory.samples().map(|(time, _)| time).collect()
}

#[test]
fn legs_end_as_amcl_ends_them() {
    let odometry_log = new_straight_drive(41, 0.0625);
    let (legs, lost_legs) = split_into_legs(&odometry_log, &odometry_log, AMCL_LENGTH, 0.0);
    // Four steps reach exactly the limit of a quarter of a metre, at which no leg ends. Each leg therefore has five steps.
    assert_eq!((legs.len(), lost_legs), (8, LostLegs::default()));
    for (i, leg) in legs.iter().enumerate() {
        assert_eq!(leg.odometry[1].x() - leg.odometry[0].x(), 0.3125);
        assert_eq!(leg.times[0], times_of(&odometry_log)[5 * i]);
        assert_eq!(leg.follows, i > 0);
    }
    // Each axis has its own limit. A motion of 0.24 m along both axes ends no leg, although its distance is 0.34 m.
    let diagonal_drive =
        new_trajectory([(0.0, 0.0), (0.1, 0.24), (0.2, 0.26)].map(|(t, x)| (t, SE2::new(x, x, 0.0))));
    assert_eq!(split_into_legs(&diagonal_drive, &diagonal_drive, AMCL_LENGTH, 0.0).0[0].times, [0.0, 0.2]);
    let turning_drive =
        [(0.0, 3.1), (0.1, -3.1), (0.2, -2.9)].map(|(t, theta)| (t, SE2::new(0.0, 0.0, theta)));
    let turning_drive = new_trajectory(turning_drive);
    assert_eq!(split_into_legs(&turning_drive, &turning_drive, AMCL_LENGTH, 0.0).0[0].times, [0.0, 0.2]);
    let timed_legs =
        split_into_legs(&odometry_log, &odometry_log, LegLength::Duration { duration: 0.5 }, 0.0).0;
    assert_eq!(timed_legs.len(), 8);
}

/// Ten steps of 0.02 rad equal the limit of 0.2 rad, except for the rounding of doubles or of text with six decimals.
#[test]
fn rounding_does_not_decide_where_a_leg_ends() {
    let leg_end_times_with = |round_heading: fn(f64) -> f64| {
        let heading_at = |row: usize| round_heading(wrap_angle(0.123_456_7 + 0.02 * row as f64));
        let turning_drive = new_trajectory(
            (0..400).map(|row_index| (0.1 * row_index as f64, SE2::new(0.0, 0.0, heading_at(row_index)))),
        );
        times_of_legs(&split_into_legs(&turning_drive, &turning_drive, AMCL_LENGTH, 0.0).0)
    };
    let exact_leg_times = leg_end_times_with(|exact_heading| exact_heading);
    // Ten steps reach exactly the limit, at which no leg ends. Each leg therefore has eleven steps.
    assert_eq!(exact_leg_times.len(), 36);
    assert_eq!(leg_end_times_with(|exact_heading| (exact_heading * 1e6).round() / 1e6), exact_leg_times);
}

/// A leg normally has five steps. A leg with a pause of six steps after its first step is 0.44 m long. With the pause after the fourth step
/// it would be 0.63 m long, more than twice the requested length, and is left out.
#[test]
fn a_leg_leads_across_a_pause_if_it_stays_short_enough() {
    let drive = new_straight_drive(101, 0.0625);
    for (steps_before_pause, next_leg_row, lost_across_pauses) in [(1, 37, 0), (4, 40, 1)] {
        let drive_with_pause =
            remove_rows_between(&drive, 30 + steps_before_pause, 30 + steps_before_pause + 6);
        let (legs, lost_legs) = split_into_legs(&drive_with_pause, &drive, AMCL_LENGTH, 0.0);
        assert_eq!(lost_legs, LostLegs { across_pauses: lost_across_pauses, ..LostLegs::default() });
        let leg_across_pause = legs.iter().find(|leg| leg.times[0] == times_of(&drive)[30]);
        assert_eq!(
            leg_across_pause.map(|leg| leg.times[1]),
            (lost_across_pauses == 0).then_some(times_of(&drive)[next_leg_row])
        );
        // A leg after an omitted leg is not marked as the successor of the previous leg in the list.
        let next_leg =
            legs.iter().find(|leg| leg.times[0] == times_of(&drive)[next_leg_row]).expect("it goes on");
        assert_eq!(next_leg.follows, lost_across_pauses == 0);
    }
    let (legs, lost_legs) = split_into_legs(&drive, &remove_rows_between(&drive, 30, 35), AMCL_LENGTH, 0.0);
    assert_eq!((legs, lost_legs), split_into_legs(&drive, &drive, AMCL_LENGTH, 0.0));
}

#[test]
fn lost_legs_are_counted_by_cause() {
    let drive = new_straight_drive(101, 0.05);
    let all_legs = split_into_legs(&drive, &drive, AMCL_LENGTH, 0.0).0;
    // The reference has the rows from 12 to 66. It begins after two of sixteen legs and ends before the last five.
    let shorter_reference = new_trajectory(drive.samples().skip(12).take(55));
    let (legs, lost_legs) = split_into_legs(&drive, &shorter_reference, AMCL_LENGTH, 0.0);
    assert_eq!(times_of_legs(&legs), times_of_legs(&all_legs[2..11]));
    assert!(
        lost_legs.without_reference >= 4 && lost_legs.total() == lost_legs.without_reference,
        "{lost_legs:?}"
    );
    // The robot stands still for 4 s, in four legs of a second.
    let drive_with_stop = new_trajectory(drive.samples().map(|(time, pose)| {
        (time, SE2::new(if time < 3.0 { pose.x() } else { 1.5 + (pose.x() - 3.5).max(0.0) }, 0.0, 0.0))
    }));
    let (legs, lost_legs) =
        split_into_legs(&drive_with_stop, &drive_with_stop, LegLength::Duration { duration: 1.0 }, 0.0);
    assert_eq!((legs.len(), lost_legs), (6, LostLegs { standing: 4, ..LostLegs::default() }));
}

#[test]
fn no_leg_leads_across_a_break() {
    let drive = new_straight_drive(101, 0.1);
    let all_legs = split_into_legs(&drive, &drive, AMCL_LENGTH, 0.0).0;
    let break_rows = [17, 33, 34, 70];
    let drive_with_breaks = drive.clone().with_breaks_before(break_rows);
    let spans_break = |leg: &Leg| {
        let contains_row =
            |row: usize| leg.times[0] < times_of(&drive)[row] && times_of(&drive)[row] <= leg.times[1];
        break_rows.into_iter().any(contains_row)
    };
    let kept_legs: Vec<Leg> = all_legs.iter().filter(|leg| !spans_break(leg)).copied().collect();
    let (legs, lost_legs) = split_into_legs(&drive, &drive_with_breaks, AMCL_LENGTH, 0.0);
    assert_eq!(times_of_legs(&legs), times_of_legs(&kept_legs));
    let lost_across_breaks = all_legs.len() - kept_legs.len();
    assert_eq!(lost_legs, LostLegs { across_breaks: lost_across_breaks, ..LostLegs::default() });
    let (legs, lost_legs) = split_into_legs(&drive_with_breaks, &drive, AMCL_LENGTH, 0.0);
    assert!(legs.len() > 25 && !legs.iter().any(spans_break));
    assert_eq!(lost_legs, LostLegs { across_breaks: 4, ..LostLegs::default() });
    assert!([17, 34, 70].iter().all(|row| legs.iter().any(|leg| leg.times[0] == times_of(&drive)[*row])));
    // No pose exists between the two rows of a break. Breaks before the first row or after the last row are ignored.
    assert!(drive_with_breaks.motion_at(times_of(&drive)[16] + 0.01).is_none());
    assert!([16, 17].iter().all(|row| drive_with_breaks.motion_at(times_of(&drive)[*row]).is_some()));
    assert_eq!(drive.clone().with_breaks_before([0, 101]), drive);
}

#[test]
fn velocities_are_not_computed_across_a_declared_jump() {
    let jump_offset_at = |row_index: usize| if (40..43).contains(&row_index) { 5.0 } else { 0.0 };
    let rows_with_jumps = new_straight_drive(101, 0.1);
    let rows_with_jumps = rows_with_jumps
        .samples()
        .enumerate()
        .map(|(row_index, (time, pose))| (time, SE2::new(pose.x(), jump_offset_at(row_index), 0.0)));
    let drive_with_jumps = new_trajectory(rows_with_jumps).with_breaks_before([40, 43]);
    let leg_length = LegLength::Displacement { distance: 0.15, angle: 0.2 };
    let legs = split_into_legs(&drive_with_jumps, &drive_with_jumps, leg_length, 0.0).0;
    assert!(legs.len() > 45 && legs.iter().any(|leg| leg.odometry[0].y() == 5.0));
    for leg in legs {
        assert!(leg.velocities.iter().all(|leg_velocity| (leg_velocity - Vector3::x()).norm() < 1e-9));
    }
}

/// A leg ends at the reference sample nearest to the time of its length limit. The next leg is measured from that time.
#[test]
fn a_leg_ends_at_the_sample_of_the_reference_nearest_to_a_reading() {
    let drive = new_straight_drive(1001, 0.05);
    let leg_length = LegLength::Duration { duration: 0.5 };
    let all_legs = split_into_legs(&drive, &drive, leg_length, 0.0).0;
    for row_stride in [2, 4, 8] {
        let sparse_reference = new_trajectory(drive.samples().skip(3).step_by(row_stride));
        let (legs, _) = split_into_legs(&drive, &sparse_reference, leg_length, 0.0);
        for leg in &legs {
            assert!(leg.times.iter().all(|time| times_of(&sparse_reference).contains(time)), "{leg:?}");
            assert_eq!(leg.odometry, leg.reference);
        }
        assert!(legs.windows(2).all(|adjacent_legs| adjacent_legs[0].times[1] == adjacent_legs[1].times[0]));
        // If the samples of the reference are closer together than the ends of legs, the mean length of legs does not change.
        let count_ratio = legs.len() as f64 / all_legs.len() as f64;
        assert!((count_ratio - if row_stride == 8 { 5.0 / 8.0 } else { 1.0 }).abs() < 0.02, "{count_ratio}");
    }
    // In the clock offset of 0.01 s the robot drives 5 mm. The sparse odometry is interpolated at the nearest sample of the reference.
    let sparse_odometry = new_trajectory(drive.samples().step_by(8));
    let (legs, _) = split_into_legs(&sparse_odometry, &drive, leg_length, 0.01);
    assert!(legs.len() > 100);
    for leg in legs {
        let end_offsets = [0, 1].map(|end_index| leg.reference[end_index].x() - leg.odometry[end_index].x());
        assert!(end_offsets.iter().all(|position_offset| (position_offset - 0.005).abs() < 1e-9), "{leg:?}");
    }
}

#[test]
fn poses_between_samples_lie_on_an_arc() {
    let constant_twist = Vector3::new(0.5, 0.1, 0.8);
    let start_pose = SE2::new(2.0, 1.0, 3.0);
    let arc_trajectory = new_trajectory([(1.0, start_pose), (2.0, start_pose.boxplus(constant_twist))]);
    let (pose, _) = arc_trajectory.motion_at(1.25).expect("inside");
    assert!(pose.boxminus(&start_pose.boxplus(constant_twist * 0.25)).norm() < 1e-12);
    assert_eq!([0.99, 2.01].map(|time| arc_trajectory.motion_at(time)), [None; 2]);
}

#[test]
fn times_must_rise_and_numbers_must_be_finite() {
    let error_message_for = |timed_positions: &[(f64, f64)]| {
        let timed_poses = timed_positions.iter().map(|(time, x)| (*time, SE2::new(*x, 0.0, 0.0)));
        Trajectory::new(timed_poses).err().map(|trajectory_error| trajectory_error.to_string())
    };
    assert_eq!([error_message_for(&[]), error_message_for(&[(1.0, 2.0)])], [None, None]);
    let time_order_message = "sample 2 is not later than the one before; allowed are increasing times";
    assert_eq!(error_message_for(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0)]).as_deref(), Some(time_order_message));
    let finite_message = "sample 1 has a time or a coordinate that is not finite; allowed are finite numbers";
    assert_eq!(error_message_for(&[(0.0, 0.0), (f64::NAN, 0.0)]).as_deref(), Some(finite_message));
    assert_eq!(error_message_for(&[(0.0, 0.0), (1.0, f64::INFINITY)]).as_deref(), Some(finite_message));
    assert!(Trajectory::from_commands([(0.0, 1.0, 0.0), (1.0, f64::NAN, 0.0)]).is_err());
}

#[test]
fn commands_are_integrated_along_arcs() {
    let full_trajectory =
        Trajectory::from_commands([(0.0, 1.0, 0.0), (1.0, 0.5, 1.0), (3.0, 0.0, -2.0), (4.0, 9.0, 9.0)]);
    let full_trajectory = full_trajectory.expect("times rise");
    // The commands are a metre straight ahead, an arc of a metre that turns by 2 rad, and a turn on the spot back to the first
    // heading. The radius of the arc is ½ m.
    let arc_end = SE2::new(1.0 + 0.5 * libm::sin(2.0), 0.5 * (1.0 - libm::cos(2.0)), 2.0);
    let expected_poses =
        [SE2::identity(), SE2::new(1.0, 0.0, 0.0), arc_end, SE2::new(arc_end.x(), arc_end.y(), 0.0)];
    for (time, expected_pose) in [0.0, 1.0, 3.0, 4.0].into_iter().zip(expected_poses) {
        let (pose, _) = full_trajectory.motion_at(time).expect("inside");
        assert!(pose.boxminus(&expected_pose).norm() < 1e-12, "{pose:?} is not {expected_pose:?}");
    }
}

/// A command that lasts 20 s has no rows during 40 legs. The trajectory is therefore cut into steps of a tenth of a second, or 5 cm.
/// A leg is longer than 25 cm by at most one and a half steps, up to half a step at either end.
#[test]
fn a_long_command_is_split_into_legs_between_its_rows() {
    let full_trajectory =
        Trajectory::from_commands([(0.0, 0.5, 0.0), (20.0, 0.5, 0.0), (40.0, 0.0, 0.0)]).expect("times rise");
    let (legs, lost_legs) =
        split_into_legs(&full_trajectory, &new_straight_drive(401, 0.05), AMCL_LENGTH, 0.0);
    assert_eq!(lost_legs, LostLegs::default());
    assert!(legs.len() > 60, "{}", legs.len());
    for leg in legs {
        let leg_distance = leg.odometry[1].x() - leg.odometry[0].x();
        assert!(0.2 < leg_distance && leg_distance <= 0.375, "{leg_distance}");
    }
}
