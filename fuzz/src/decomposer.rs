//! The Odometry Decomposer under any settings and calls.

use super::input::InputReader;
use super::assertions;
use super::settings::{are_settings_allowed, change_settings};
use motion::geom::se2::SE2;
use motion::models::{OdomDelta, MAX_SPIN_DISTANCE};
use motion::sim::odometry_decomposer::{DriftedOdometry, OdometryDecomposer, Settings, Stats};
use motion::sim::settings::QUANTITY_RANGE;

/// Maximum numbers of outcomes, of points of a curve, and of calls in a run.
const MAX_SAMPLES: usize = 12;
const MAX_CURVE_POINTS: usize = 6;
const MAX_CALLS: usize = 4;

pub fn run(input_bytes: &[u8]) {
    let mut input = InputReader(input_bytes);
    let first_settings = change_settings(&limit_samples(Settings::default()), &mut input);
    if !are_settings_allowed(&first_settings) {
        assert!(OdometryDecomposer::new(first_settings).is_err());
        return;
    }
    let mut simulation = OdometryDecomposer::new(limit_samples(first_settings)).expect("allowed");
    for _ in 0..MAX_CALLS {
        if input.is_empty() {
            break;
        }
        call_method(&mut simulation, &mut input);
    }
    assert_results(&simulation);
}

/// Returns the settings with at most `MAX_SAMPLES` outcomes.
fn limit_samples(settings: Settings) -> Settings {
    Settings { samples: settings.samples.min(MAX_SAMPLES), ..settings }
}

fn call_method(simulation: &mut OdometryDecomposer, input: &mut InputReader) {
    let shown_count = simulation.poses().len();
    match input.next_below(7) {
        0 | 1 => change_simulation_settings(simulation, input),
        2 => {
            let added_count = input.next_below(MAX_SAMPLES);
            assert_eq!(simulation.add_samples(added_count), (shown_count + added_count).min(simulation.settings().samples));
        }
        3 => {
            simulation.configure_first(*simulation.settings(), 0).expect("allowed");
            assert!(simulation.poses().is_empty());
        }
        4 => {
            let leg_poses = simulation.sample_leg_poses(usize::from(input.next_byte()));
            assert!(leg_poses.len() <= shown_count);
            leg_poses.as_flattened().iter().for_each(|pose| assertions::assert_pose("a leg pose", pose));
            assert!(leg_poses.iter().zip(simulation.poses()).all(|(outcome_poses, pose)| outcome_poses[3] == *pose));
        }
        5 => assert_deviation_curve(simulation, input.draw_number_within(0.0..=*QUANTITY_RANGE.end()), 1 + input.next_below(MAX_CURVE_POINTS)),
        _ => assert_nearest_pose(simulation, input),
    }
}

fn change_simulation_settings(simulation: &mut OdometryDecomposer, input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), input);
    let (settings_before, poses_before) = (*simulation.settings(), simulation.poses().to_vec());
    if !are_settings_allowed(&settings) {
        assert!(simulation.configure(settings).is_err());
        assert_eq!(*simulation.settings(), settings_before);
        assert_eq!(simulation.poses(), poses_before);
        return;
    }
    let settings = limit_samples(settings);
    simulation.configure(settings).expect("allowed");
    assert_eq!(simulation.poses().len(), settings.samples);
}

fn assert_deviation_curve(simulation: &OdometryDecomposer, max_distance: f64, point_count: usize) {
    let curve_points = simulation.deviation_curve(max_distance, point_count);
    assert_eq!(curve_points.len(), point_count);
    for curve_point in curve_points {
        assertions::assert_finite("curve", &curve_point);
        assert!(curve_point[1..].iter().all(|deviation| *deviation >= 0.0), "{curve_point:?}");
    }
}

fn assert_nearest_pose(simulation: &OdometryDecomposer, input: &mut InputReader) {
    let search_point = [0; 2].map(|_| input.next_number());
    let search_radius = input.draw_number_within(0.0..=f64::INFINITY);
    let Some(nearest_index) = simulation.nearest(search_point, search_radius) else { return };
    let relative_distance_to = |pose: &SE2| ((pose.x() - search_point[0]) / search_radius).hypot((pose.y() - search_point[1]) / search_radius);
    let min_relative_distance = simulation.poses().iter().map(relative_distance_to).fold(f64::INFINITY, f64::min);
    // The square of a distance below 1e-154 of the radius underflows to 0.
    let found_relative_distance = relative_distance_to(&simulation.poses()[nearest_index]);
    assert!(found_relative_distance <= min_relative_distance * (1.0 + 1e-9) + 1e-150 && found_relative_distance <= 1.0 + 1e-9, "{search_point:?} {search_radius}: {nearest_index}");
}

/// Asserts that all results are finite. Without outcomes they must be NaN.
fn assert_results(simulation: &OdometryDecomposer) {
    let settings = simulation.settings();
    simulation.poses().iter().for_each(|pose| assertions::assert_pose("an outcome", pose));
    simulation.leg_poses().iter().for_each(|pose| assertions::assert_pose("a leg pose", pose));
    assertions::assert_pose("the robot", &simulation.robot_pose());
    let DriftedOdometry { poses, legs } = simulation.drifted_odometry();
    poses.into_iter().for_each(|pose| assertions::assert_pose("drifted", &pose.into()));
    assert_legs("drifted legs", &legs);
    assert_legs("reading", &simulation.reading());

    let Stats {
        n,
        cross_track,
        cross_track_error,
        exact_cross_track,
        lever,
        heading,
        heading_error,
        exact_heading,
        independent_heading,
    } = simulation.stats();
    assert_eq!(n, simulation.poses().len());
    let exact_values = [exact_cross_track, lever, exact_heading, independent_heading];
    let measured_values = [cross_track, cross_track_error, heading, heading_error];
    assertions::assert_finite("exact", &exact_values);
    assertions::assert_all_finite_or_all_nan("measured", &measured_values);
    assert_eq!(n == 0, cross_track.is_nan());
    assert!(
        exact_values.iter().chain(&measured_values).all(|deviation| deviation.is_nan() || *deviation >= 0.0),
        "{exact_values:?} {measured_values:?}"
    );

    for rule_noise in simulation.rule_noises() {
        assert_legs("legs", &rule_noise.legs);
        let rule_deviations = [&rule_noise.deviations[..], &[rule_noise.cross_track, rule_noise.heading]].concat();
        assertions::assert_finite("a rule", &rule_deviations);
        assert!(rule_deviations.iter().all(|rule_deviation| *rule_deviation >= 0.0), "{rule_noise:?}");
        if rule_noise.rule == settings.rule {
            assert_eq!(rule_noise.legs, simulation.legs());
            assertions::assert_same_numbers("exact", &rule_deviations[4..], &[exact_cross_track, exact_heading]);
        }
    }

    // The last leg ends at the second odometry pose. Noise rules may ignore the direction of a tiny translation.
    let [x, y, _] = settings.to;
    let [.., last_leg_end] = simulation.leg_poses();
    let distance_to_second_pose = (last_leg_end.x() - x).hypot(last_leg_end.y() - y);
    let largest_coordinate = settings.from.iter().chain(&settings.to).fold(0.0, |max_so_far: f64, coordinate| max_so_far.max(coordinate.abs()));
    assert!(distance_to_second_pose <= 2.0 * MAX_SPIN_DISTANCE + 1e-14 * largest_coordinate, "{last_leg_end:?} for {settings:?}: {distance_to_second_pose}");

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
