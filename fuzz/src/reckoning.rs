//! Fuzz target of Dead Reckoning: arbitrary settings and calls.

use super::input::{InputReader, is_selected_by_hash};
use super::assertions;
use super::settings::{are_settings_allowed, change_settings};
use motion::sim::dead_reckoning::{
    DeadReckoning, MAX_SHOWN_ROBOTS, MeasuredMoments, Misses, StepOutlines, RECURSIONS, Settings, Stats, StraightGrowth,
};
use nalgebra::Matrix3;

/// Maximum numbers of robots, steps and calls for one input. The simulation drives robots in blocks of 256. Most inputs need one block of
/// robots, and a few need several blocks.
const MAX_SAMPLES_OF_MOST_RUNS: usize = 200;
const MAX_SAMPLES: usize = 800;
const MAX_STEPS: u32 = 5;
const MAX_CALLS: usize = 4;

pub fn check_input(input_bytes: &[u8]) {
    let mut fuzz_input = InputReader(input_bytes);
    let [should_check_straight_growth, should_compare_new_simulation] = [0; 2].map(|_| fuzz_input.next_below(4) == 1);
    let first_settings = Settings { samples: 3, steps: MAX_STEPS, ..Settings::default() };
    let first_settings = change_settings(&first_settings, &mut fuzz_input);
    if !are_settings_allowed(&first_settings) {
        assert!(DeadReckoning::with_shown_count(first_settings, 0).is_err());
        return;
    }
    let max_samples = if is_selected_by_hash(16, input_bytes) { MAX_SAMPLES } else { MAX_SAMPLES_OF_MOST_RUNS };
    let limit_settings = |settings| limit_settings(settings, max_samples);
    let mut simulation = DeadReckoning::with_shown_count(limit_settings(first_settings), 0).expect("allowed");
    if fuzz_input.next_bool() {
        simulation.add_samples(MAX_SAMPLES);
    }
    for _ in 0..MAX_CALLS {
        if fuzz_input.is_empty() {
            break;
        }
        call_method(&mut simulation, &limit_settings, &mut fuzz_input);
    }
    assert_results(&simulation);
    if should_check_straight_growth && is_selected_by_hash(8, input_bytes) {
        assert_straight_growth(&simulation);
    }
    if should_compare_new_simulation && is_selected_by_hash(8, input_bytes) {
        assert_equals_new_simulation(&simulation);
    }
}

/// Returns the settings with few robots and steps.
fn limit_settings(settings: Settings, max_samples: usize) -> Settings {
    Settings {
        samples: settings.samples.min(max_samples),
        steps: settings.steps.min(MAX_STEPS),
        step: settings.step.min(settings.steps.min(MAX_STEPS)),
        ..settings
    }
}

fn call_method(simulation: &mut DeadReckoning, limit_settings: &dyn Fn(Settings) -> Settings, fuzz_input: &mut InputReader) {
    let shown_count = simulation.shown_count();
    match fuzz_input.next_below(9) {
        0 | 1 => change_simulation_settings(simulation, limit_settings, fuzz_input),
        2 | 3 => assert_same_if_added_in_blocks(simulation, limit_settings, fuzz_input),
        4 => {
            let added_count = usize::from(u16::from_le_bytes(fuzz_input.next_bytes())) % MAX_SAMPLES;
            assert_eq!(simulation.add_samples(added_count), (shown_count + added_count).min(simulation.settings().samples));
        }
        5 => {
            simulation.configure_first(*simulation.settings(), 0).expect("allowed");
            assert_eq!(simulation.shown_count(), 0);
        }
        6 => assert_nearest_pose(simulation, fuzz_input),
        7 => assert_outlines(simulation, 1 + fuzz_input.next_below(MAX_STEPS as usize) as u32),
        _ => assert_rollout(simulation, usize::from(u16::from_le_bytes(fuzz_input.next_bytes())) % MAX_SAMPLES),
    }
}

fn change_simulation_settings(simulation: &mut DeadReckoning, limit_settings: &dyn Fn(Settings) -> Settings, fuzz_input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), fuzz_input);
    if are_settings_allowed(&settings) {
        simulation.configure(limit_settings(settings)).expect("allowed");
        return;
    }
    let results_before = collect_results(simulation);
    assert!(simulation.configure(settings).is_err() && simulation.configure_first(settings, 0).is_err());
    assert_eq!(collect_results(simulation), results_before);
}

/// Asserts that robots that are added in several blocks equal robots that are added in one call.
fn assert_same_if_added_in_blocks(simulation: &mut DeadReckoning, limit_settings: &dyn Fn(Settings) -> Settings, fuzz_input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), fuzz_input);
    if !are_settings_allowed(&settings) {
        return;
    }
    let settings = limit_settings(settings);
    let mut simulation_in_one_call = simulation.clone();
    simulation_in_one_call.configure(settings).expect("allowed");
    let block_size = 1 + usize::from(u16::from_le_bytes(fuzz_input.next_bytes())) % MAX_SAMPLES;
    simulation.configure_first(settings, block_size).expect("allowed");
    while simulation.shown_count() < settings.samples {
        simulation.add_samples(block_size);
    }
    assert_eq!(collect_results(simulation), collect_results(&simulation_in_one_call));
    assert_results(simulation);
}

/// Asserts that a simulation depends on its settings only, and not on earlier calls.
fn assert_equals_new_simulation(simulation: &DeadReckoning) {
    let mut new_simulation = DeadReckoning::with_shown_count(*simulation.settings(), 0).expect("allowed");
    new_simulation.add_samples(simulation.shown_count());
    assert_eq!(collect_results(&new_simulation), collect_results(simulation));
}

/// Returns the settings and statistics as text, in which NaN equals NaN, and the coordinates of the robots after the selected step as bits.
fn collect_results(simulation: &DeadReckoning) -> (String, Vec<u64>) {
    let (settings, stats, measured_moments) = (simulation.settings(), simulation.stats(), simulation.measured_moments());
    let outlines = simulation.outlines(settings.step);
    let outline_lines = outlines.iter().flat_map(|StepOutlines { ellipse: pose_ellipse, exponential: exponential_contour, predicted: predicted_ellipse, measured: measured_ellipse }| {
        [pose_ellipse, exponential_contour, predicted_ellipse, measured_ellipse].into_iter().flat_map(|outline| outline.as_flattened())
    });
    let outline_and_pose_coordinates = simulation.poses(settings.step).as_flattened().iter().chain(outline_lines);
    (format!("{settings:?} {stats:?} {measured_moments:?}"), outline_and_pose_coordinates.map(|coordinate| coordinate.to_bits()).collect())
}

/// Asserts that every result of the simulation is finite, or has the documented value (NaN or an empty list) if it is undefined.
fn assert_results(simulation: &DeadReckoning) {
    let settings = simulation.settings();
    let (n, step_count) = (simulation.shown_count(), settings.steps as usize);
    assert!(n <= MAX_SAMPLES && (1..=settings.steps).contains(&settings.step), "{settings:?} of {n}");
    assert_eq!([simulation.measured_moments().len(), simulation.nominal_poses().len()], [step_count; 2]);
    simulation.nominal_poses().iter().for_each(|pose| assertions::assert_pose("nominal", pose));
    assertions::assert_finite("commanded", simulation.commanded_path().as_flattened());
    for measured_moments in simulation.measured_moments() {
        if n > 0 {
            assertions::assert_finite("mean", measured_moments.mean.as_slice());
        }
        if n > 1 {
            assert_covariance("measured", &measured_moments.cov, rounding_error_of_cov_entries(measured_moments));
        }
        for (i, relative_error) in measured_moments.relative_error.iter().enumerate() {
            assert!(relative_error.is_nan() || *relative_error >= 0.0, "{measured_moments:?}");
            // A relative error of a variance is defined only if the variance is above 0.
            let has_variance = n > 1 && measured_moments.cov[(i, i)] > 0.0;
            assert!(relative_error.is_nan() || has_variance, "{measured_moments:?} of {n}");
        }
    }
    let selected_step = settings.step;
    assert_eq!(simulation.poses(selected_step).len(), n.min(MAX_SHOWN_ROBOTS));
    assert!(simulation.poses(0).is_empty() && simulation.poses(settings.steps + 1).is_empty());
    assertions::assert_finite("poses", simulation.poses(selected_step).as_flattened());
    simulation.twists().for_each(|twist| assertions::assert_finite("a twist", &twist));
    assert_eq!(simulation.twists().len(), n.min(MAX_SHOWN_ROBOTS));
    for recursion in RECURSIONS {
        let (predicted_covs, variance_comparison) = (simulation.predicted_covariances(recursion), simulation.comparison(recursion));
        assert_eq!([predicted_covs.len(), variance_comparison.ratios.len()], [step_count; 2]);
        for (predicted_cov, variance_ratios) in predicted_covs.iter().zip(&variance_comparison.ratios) {
            assert!(
                variance_ratios.iter().all(|variance_ratio| variance_ratio.is_nan() || (predicted_cov.is_some() && *variance_ratio >= 0.0)),
                "{variance_ratios:?}"
            );
            let Some(predicted_cov) = predicted_cov else { continue };
            // All entries of a covariance have the same tolerance, because rotations by the heading mix them and their rounding errors.
            assert_covariance("predicted", predicted_cov, |_, _| 1e-12 * predicted_cov.amax());
        }
        variance_comparison.misses.iter().for_each(|component_misses| assert_misses(component_misses, step_count));
    }
    let Stats { n: robot_count, .. } = simulation.stats();
    assert_eq!(robot_count, n);
    assert_outlines(simulation, selected_step);
}

/// Asserts that a matrix is finite and symmetric, and has no correlation above 1. `rounding_of_entry` gives the tolerance of an entry.
fn assert_covariance(cov_name: &str, cov: &Matrix3<f64>, rounding_of_entry: impl Fn(usize, usize) -> f64) {
    assertions::assert_finite(cov_name, cov.as_slice());
    for i in 0..3 {
        assert!(cov[(i, i)] >= 0.0, "{cov_name}: {cov:?}");
        for j in 0..i {
            let entry_tolerance = rounding_of_entry(i, j) + f64::MIN_POSITIVE;
            assert!((cov[(i, j)] - cov[(j, i)]).abs() <= entry_tolerance, "{cov_name}: {cov:?}");
            let [row_std, column_std] = [i, j].map(|k| (cov[(k, k)] + rounding_of_entry(k, k)).sqrt());
            assert!(cov[(i, j)].abs() <= row_std * column_std + entry_tolerance, "{cov_name}: {cov:?}");
        }
    }
}

/// Returns the rounding error of a covariance that is computed as the mean of products minus the product of means.
fn rounding_error_of_cov_entries(MeasuredMoments { mean, cov, .. }: &MeasuredMoments) -> impl Fn(usize, usize) -> f64 + use<> {
    let [along_scale, lateral_scale, heading_scale] = [0, 1, 2].map(|i| mean[i].abs() + cov[(i, i)].sqrt());
    let coordinate_scales = [along_scale + lateral_scale, along_scale + lateral_scale, heading_scale];
    move |i, j| assertions::ROUNDING_TOLERANCE * coordinate_scales[i] * coordinate_scales[j] + assertions::SQUARE_UNDERFLOW_LIMIT * (coordinate_scales[i] + coordinate_scales[j])
}

fn assert_misses(misses: &Misses, step_count: usize) {
    let Misses { decidable: is_decidable, first: first_missed_step, last: last_missed_step, end: relative_error_at_end, error: standard_error } = *misses;
    assert_eq!(first_missed_step.is_some(), last_missed_step.is_some(), "{misses:?}");
    assert!(is_decidable || first_missed_step.is_none(), "{misses:?}");
    let are_in_order = 1 <= first_missed_step.unwrap_or(1) && first_missed_step <= last_missed_step && last_missed_step.unwrap_or(1) as usize <= step_count;
    assert!(are_in_order && !relative_error_at_end.is_infinite() && (standard_error.is_nan() || standard_error >= 0.0), "{misses:?}");
}

fn assert_straight_growth(simulation: &DeadReckoning) {
    let StraightGrowth { durations: drive_durations, along: along_variances, across: across_variances, along_first_order, across_first_order, crossing: crossing_time } =
        simulation.straight_growth();
    for growth_curve in [&drive_durations, &along_variances, &across_variances, &along_first_order, &across_first_order] {
        assertions::assert_finite("straight", growth_curve);
        assert!(growth_curve.len() == drive_durations.len() && growth_curve.iter().all(|variance| *variance >= 0.0), "{growth_curve:?}");
    }
    assert!(crossing_time.is_none_or(|crossing_time| crossing_time.is_finite() && crossing_time > 0.0), "{crossing_time:?}");
}

fn assert_outlines(simulation: &DeadReckoning, selected_step: u32) {
    let settings = simulation.settings();
    let Some(step_outlines) = simulation.outlines(selected_step) else {
        assert!(selected_step > settings.steps);
        return;
    };
    let StepOutlines { ellipse: pose_ellipse, exponential: exponential_contour, predicted: predicted_ellipse, measured: measured_ellipse } = step_outlines;
    for outline in [&pose_ellipse, &exponential_contour, &predicted_ellipse, &measured_ellipse] {
        assertions::assert_finite("an outline", outline.as_flattened());
        assert_eq!(outline.first(), outline.last(), "an outline is closed");
    }
    let lacks_covariance = simulation.predicted_covariances(settings.compounding)[selected_step as usize - 1].is_none();
    assert!([&pose_ellipse, &exponential_contour, &predicted_ellipse].iter().all(|outline| outline.is_empty() == lacks_covariance));
    assert_eq!(measured_ellipse.is_empty(), simulation.shown_count() < 2);
}

/// Asserts that the path of a robot equals the poses of this robot in the clouds of the steps.
fn assert_rollout(simulation: &DeadReckoning, robot_index: usize) {
    let Some(rollout_path) = simulation.rollout(robot_index) else {
        assert!(robot_index >= simulation.shown_count());
        return;
    };
    assert_eq!(rollout_path.len(), simulation.settings().steps as usize);
    assertions::assert_finite("a path", rollout_path.as_flattened());
    for (step, pose) in (1..).zip(&rollout_path) {
        assert!(simulation.poses(step).get(robot_index).is_none_or(|pose_of_robot| pose_of_robot == pose), "{robot_index} at {step}");
    }
}

fn assert_nearest_pose(simulation: &DeadReckoning, fuzz_input: &mut InputReader) {
    let search_point = [0; 2].map(|_| fuzz_input.next_number());
    let search_radius = fuzz_input.draw_number_within(0.0..=f64::INFINITY);
    let Some(nearest_index) = simulation.find_nearest(search_point, search_radius) else { return };
    let poses = simulation.poses(simulation.settings().step);
    let relative_distance_to = |[x, y, _]: &[f64; 3]| ((x - search_point[0]) / search_radius).hypot((y - search_point[1]) / search_radius);
    let min_relative_distance = poses.iter().map(relative_distance_to).fold(f64::INFINITY, f64::min);
    // The absolute tolerance allows for distances below 1e-154 of the radius, whose squares underflow to 0.
    let found_relative_distance = relative_distance_to(&poses[nearest_index]);
    assert!(found_relative_distance <= min_relative_distance * (1.0 + 1e-9) + 1e-150 && found_relative_distance <= 1.0 + 1e-9, "{search_point:?} {search_radius}: {nearest_index}");
}
