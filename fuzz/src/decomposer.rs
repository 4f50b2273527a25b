//! Fuzz target of the Odometry Decomposer: arbitrary settings and calls.

use super::input::InputReader;
use super::assertions;
use super::settings::{are_settings_allowed, change_settings};
use motion::geom::se2::SE2;
use motion::models::{OdomDelta, MAX_SPIN_DISTANCE};
use motion::sim::odometry_decomposer::{DriftedOdometry, OdometryDecomposer, Settings, Stats};
use motion::sim::settings::QUANTITY_RANGE;

/// Maximum numbers of outcomes, of points of a deviation curve, and of calls for one input.
const MAX_SAMPLES: usize = 12;
const MAX_CURVE_POINTS: usize = 6;
const MAX_CALLS: usize = 4;

pub fn check_input(input_bytes: &[u8]) {
    let mut fuzz_input = InputReader(input_bytes);
    let first_settings = change_settings(&limit_settings(Settings::default()), &mut fuzz_input);
    if !are_settings_allowed(&first_settings) {
        assert!(OdometryDecomposer::new(first_settings).is_err());
        return;
    }
    let mut simulation = OdometryDecomposer::new(limit_settings(first_settings)).expect("allowed");
    for _ in 0..MAX_CALLS {
        if fuzz_input.is_empty() {
            break;
        }
        call_method(&mut simulation, &mut fuzz_input);
    }
    assert_results(&simulation);
}

fn limit_settings(settings: Settings) -> Settings {
    Settings { samples: settings.samples.min(MAX_SAMPLES), ..settings }
}

fn call_method(simulation: &mut OdometryDecomposer, fuzz_input: &mut InputReader) {
    let shown_count = simulation.poses().len();
    match fuzz_input.next_below(7) {
        0 | 1 => change_simulation_settings(simulation, fuzz_input),
        2 => {
            let added_count = fuzz_input.next_below(MAX_SAMPLES);
            assert_eq!(simulation.add_samples(added_count), (shown_count + added_count).min(simulation.settings().samples));
        }
        3 => {
            simulation.configure_first(*simulation.settings(), 0).expect("allowed");
            assert!(simulation.poses().is_empty());
        }
        4 => {
            let leg_poses = simulation.sample_leg_poses(usize::from(fuzz_input.next_byte()));
            assert!(leg_poses.len() <= shown_count);
            leg_poses.as_flattened().iter().for_each(|pose| assertions::assert_pose("a leg pose", pose));
            assert!(leg_poses.iter().zip(simulation.poses()).all(|(poses_of_outcome, pose)| poses_of_outcome[3] == *pose));
        }
        5 => assert_deviation_curve(simulation, fuzz_input.draw_number_within(0.0..=*QUANTITY_RANGE.end()), 1 + fuzz_input.next_below(MAX_CURVE_POINTS)),
        _ => assert_nearest_pose(simulation, fuzz_input),
    }
}

fn change_simulation_settings(simulation: &mut OdometryDecomposer, fuzz_input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), fuzz_input);
    let (settings_before, poses_before) = (*simulation.settings(), simulation.poses().to_vec());
    if !are_settings_allowed(&settings) {
        assert!(simulation.configure(settings).is_err());
        assert_eq!(*simulation.settings(), settings_before);
        assert_eq!(simulation.poses(), poses_before);
        return;
    }
    let settings = limit_settings(settings);
    simulation.configure(settings).expect("allowed");
    assert_eq!(simulation.poses().len(), settings.samples);
}

fn assert_deviation_curve(simulation: &OdometryDecomposer, max_distance: f64, point_count: usize) {
    let curve_points = simulation.deviation_curve(max_distance, point_count);
    assert_eq!(curve_points.len(), point_count);
    for curve_point in curve_points {
        assertions::assert_finite("curve", &curve_point);
        assert!(curve_point[1..].iter().all(|std_dev| *std_dev >= 0.0), "{curve_point:?}");
    }
}

fn assert_nearest_pose(simulation: &OdometryDecomposer, fuzz_input: &mut InputReader) {
    let search_point = [0; 2].map(|_| fuzz_input.next_number());
    let search_radius = fuzz_input.draw_number_within(0.0..=f64::INFINITY);
    let Some(nearest_index) = simulation.find_nearest(search_point, search_radius) else { return };
    let relative_distance_to = |pose: &SE2| ((pose.x() - search_point[0]) / search_radius).hypot((pose.y() - search_point[1]) / search_radius);
    let min_relative_distance = simulation.poses().iter().map(relative_distance_to).fold(f64::INFINITY, f64::min);
    // The absolute tolerance allows for distances below 1e-154 of the radius, whose squares underflow to 0.
    let found_relative_distance = relative_distance_to(&simulation.poses()[nearest_index]);
    assert!(found_relative_distance <= min_relative_distance * (1.0 + 1e-9) + 1e-150 && found_relative_distance <= 1.0 + 1e-9, "{search_point:?} {search_radius}: {nearest_index}");
}

/// Asserts that every result of the simulation is finite, or NaN if there are no outcomes.
fn assert_results(simulation: &OdometryDecomposer) {
    let settings = simulation.settings();
    simulation.poses().iter().for_each(|pose| assertions::assert_pose("an outcome", pose));
    simulation.leg_poses().iter().for_each(|pose| assertions::assert_pose("a leg pose", pose));
    assertions::assert_pose("the robot", &simulation.robot_pose());
    let DriftedOdometry { poses: drifted_poses, legs: drifted_legs } = simulation.drifted_odometry();
    drifted_poses.into_iter().for_each(|pose| assertions::assert_pose("drifted", &pose.into()));
    assert_legs("drifted legs", &drifted_legs);
    assert_legs("reading", &simulation.reading());

    let Stats {
        n,
        cross_track: cross_track_std,
        cross_track_error: cross_track_std_error,
        exact_cross_track: exact_cross_track_std,
        lever: lever_arm_estimate,
        heading: heading_std,
        heading_error: heading_std_error,
        exact_heading: exact_heading_std,
        independent_heading: independent_heading_std,
    } = simulation.stats();
    assert_eq!(n, simulation.poses().len());
    let exact_stds = [exact_cross_track_std, lever_arm_estimate, exact_heading_std, independent_heading_std];
    let measured_stds_and_errors = [cross_track_std, cross_track_std_error, heading_std, heading_std_error];
    assertions::assert_finite("exact", &exact_stds);
    assertions::assert_all_finite_or_all_nan("measured", &measured_stds_and_errors);
    assert_eq!(n == 0, cross_track_std.is_nan());
    assert!(
        exact_stds.iter().chain(&measured_stds_and_errors).all(|std_dev| std_dev.is_nan() || *std_dev >= 0.0),
        "{exact_stds:?} {measured_stds_and_errors:?}"
    );

    for rule_noise in simulation.rule_noises() {
        assert_legs("legs", &rule_noise.legs);
        let rule_stds = [&rule_noise.deviations[..], &[rule_noise.cross_track, rule_noise.heading]].concat();
        assertions::assert_finite("a rule", &rule_stds);
        assert!(rule_stds.iter().all(|rule_std| *rule_std >= 0.0), "{rule_noise:?}");
        if rule_noise.rule == settings.rule {
            assert_eq!(rule_noise.legs, simulation.legs());
            assertions::assert_same_numbers("exact", &rule_stds[4..], &[exact_cross_track_std, exact_heading_std]);
        }
    }

    // The rotation, translation and rotation of the reading lead to the second odometry pose, to within the distance below which odometry
    // rules ignore the direction of a translation.
    let [x, y, _] = settings.to;
    let [.., final_leg_pose] = simulation.leg_poses();
    let distance_to_second_pose = (final_leg_pose.x() - x).hypot(final_leg_pose.y() - y);
    let largest_coordinate = settings.from.iter().chain(&settings.to).fold(0.0, |max_so_far: f64, coordinate| max_so_far.max(coordinate.abs()));
    assert!(distance_to_second_pose <= 2.0 * MAX_SPIN_DISTANCE + 1e-14 * largest_coordinate, "{final_leg_pose:?} for {settings:?}: {distance_to_second_pose}");

    // Asserts that a simulation depends on its settings only, and not on earlier calls.
    let mut new_simulation = OdometryDecomposer::new(*settings).expect("allowed");
    if n < settings.samples {
        new_simulation.configure_first(*settings, 0).expect("allowed");
        new_simulation.add_samples(n);
    }
    assert_eq!(new_simulation.poses(), simulation.poses());
}

fn assert_legs(legs_name: &str, legs: &OdomDelta) {
    assertions::assert_finite(legs_name, &[legs.rot1, legs.trans, legs.rot2]);
    assert!(legs.trans >= 0.0, "{legs_name}: {legs:?}");
}
