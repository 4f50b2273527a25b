//! Fuzz target of the Banana Machine: arbitrary settings and calls.

use super::input::InputReader;
use super::assertions;
use super::settings::{are_settings_allowed, change_settings};
use motion::geom::se2::SE2;
use motion::sim::banana::{
    BananaMachine, Contours, Stats, Settings, TableColumn, command_drawn_at,
};
use motion::sim::picture::RAMP_STEP_COUNT;
use motion::sim::settings::QUANTITY_RANGE;
use motion::sim::views::{EXTENT_RANGE, ViewGrid};

/// Maximum numbers of samples and of calls for one input: large enough to reach every branch, and small enough to test many inputs.
const MAX_SAMPLES: usize = 12;
const MAX_CALLS: usize = 4;

pub fn check_input(input_bytes: &[u8]) {
    let mut fuzz_input = InputReader(input_bytes);
    let [should_check_contours, should_compare_new_simulation] = [0; 2].map(|_| fuzz_input.next_below(4) == 1);
    let first_settings = change_settings(&limit_settings(Settings::default()), &mut fuzz_input);
    if !are_settings_allowed(&first_settings) {
        assert!(BananaMachine::with_shown_count(first_settings, 0).is_err());
        return;
    }
    let mut simulation = BananaMachine::with_shown_count(limit_settings(first_settings), 0).expect("allowed");
    if fuzz_input.next_bool() {
        simulation.add_samples(MAX_SAMPLES);
    }
    for _ in 0..MAX_CALLS {
        if fuzz_input.is_empty() {
            break;
        }
        call_method(&mut simulation, &mut fuzz_input);
    }
    assert_results(&simulation);
    if should_check_contours {
        assert_contours(&simulation);
    }
    if should_compare_new_simulation {
        assert_equals_new_simulation(&simulation);
    }
}

fn limit_settings(settings: Settings) -> Settings {
    Settings { samples: settings.samples.min(MAX_SAMPLES), ..settings }
}

fn call_method(simulation: &mut BananaMachine, fuzz_input: &mut InputReader) {
    match fuzz_input.next_below(9) {
        0 => change_simulation_settings(simulation, fuzz_input),
        1 => assert_same_if_added_in_blocks(simulation, fuzz_input),
        2 => {
            let count_before = simulation.shown_count();
            let added_count = fuzz_input.next_below(MAX_SAMPLES);
            let count_after = simulation.add_samples(added_count);
            assert_eq!(count_after, (count_before + added_count).min(simulation.settings().samples));
        }
        3 => {
            simulation.configure_first(*simulation.settings(), 0).expect("allowed");
            assert_eq!(simulation.shown_count(), 0);
        }
        4 => assert_picture(simulation, fuzz_input),
        5 => assert_nearest_pose(simulation, fuzz_input),
        6 => assert_executed_motion(simulation, usize::from(fuzz_input.next_byte())),
        7 => assert_table(simulation),
        _ => {
            let [x, y] = [0; 2].map(|_| fuzz_input.draw_number_within(QUANTITY_RANGE));
            let current_command = simulation.settings().command;
            let reaching_command = command_drawn_at([x, y], &current_command, 0.0);
            // The executed speed may be infinite, because the length of a nearly straight arc may exceed the range of doubles.
            assert!(!reaching_command.v.is_nan() && reaching_command.omega.is_finite(), "{reaching_command:?} to {x}, {y}");
        }
    }
}

fn change_simulation_settings(simulation: &mut BananaMachine, fuzz_input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), fuzz_input);
    if are_settings_allowed(&settings) {
        simulation.configure(limit_settings(settings)).expect("allowed");
        return;
    }
    let (settings_before, results_before) = (*simulation.settings(), collect_results(simulation));
    assert!(simulation.configure(settings).is_err() && simulation.configure_first(settings, 0).is_err());
    assert_eq!(*simulation.settings(), settings_before);
    assertions::assert_same_numbers("after a refusal", &collect_results(simulation), &results_before);
}

/// Asserts that samples that are added in several blocks equal samples that are added in one call.
fn assert_same_if_added_in_blocks(simulation: &mut BananaMachine, fuzz_input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), fuzz_input);
    if !are_settings_allowed(&settings) {
        return;
    }
    let mut simulation_in_one_call = simulation.clone();
    simulation_in_one_call.configure(limit_settings(settings)).expect("allowed");
    let block_size = 1 + usize::from(fuzz_input.next_byte());
    simulation.configure_first(limit_settings(settings), block_size).expect("allowed");
    while simulation.shown_count() < simulation.settings().samples {
        simulation.add_samples(block_size);
    }
    assertions::assert_same_numbers("in blocks", &collect_results(simulation), &collect_results(&simulation_in_one_call));
}

/// Asserts that a simulation depends on its settings only, and not on earlier calls.
fn assert_equals_new_simulation(simulation: &BananaMachine) {
    let mut new_simulation = BananaMachine::with_shown_count(*simulation.settings(), 0).expect("allowed");
    if simulation.shown_count() > 0 {
        new_simulation.add_samples(simulation.shown_count());
        assertions::assert_same_numbers("as if new", &collect_results(simulation), &collect_results(&new_simulation));
    }
}

/// Returns the poses and statistics of a simulation as a list of numbers.
fn collect_results(simulation: &BananaMachine) -> Vec<f64> {
    let mut result_numbers: Vec<f64> = simulation.poses().flat_map(|pose| [pose.x(), pose.y(), pose.theta()]).collect();
    let stats @ Stats { cartesian: cartesian_moments, exponential: exponential_moments, coverage: contour_coverage, .. } = simulation.stats();
    result_numbers.extend(cartesian_moments.mean.iter().chain(cartesian_moments.cov.iter()));
    result_numbers.extend(exponential_moments.mean.iter().chain(exponential_moments.cov.iter()));
    result_numbers.extend([stats.cross_track_skew, stats.cross_track_skew_error]);
    result_numbers.extend([stats.rho_cross_heading, stats.gaussian_skew]);
    result_numbers.extend([contour_coverage.ellipse, contour_coverage.exponential, stats.area_ratio, stats.area_ratio_error]);
    for gain_or_error in [stats.likelihood_gain, stats.likelihood_gain_error] {
        result_numbers.extend([gain_or_error.pose, gain_or_error.floor]);
    }
    result_numbers
}

/// Asserts that every result of the simulation is finite, or NaN if it is undefined.
fn assert_results(simulation: &BananaMachine) {
    let (n, stats) = (simulation.shown_count(), simulation.stats());
    simulation.poses().for_each(|pose| assertions::assert_pose("a pose", &pose));
    assert_eq!(simulation.poses().len(), n);
    assertions::assert_finite("executed", simulation.executed_motions().collect::<Vec<_>>().as_flattened());
    let are_twists_defined = simulation.is_exponential_defined();
    if are_twists_defined {
        simulation.twists().for_each(|twist| assertions::assert_finite("a twist", twist.as_slice()));
    }
    if n > 0 {
        assertions::assert_finite("mean", stats.cartesian.mean.as_slice());
    }
    if n > 1 {
        assertions::assert_valid_moments("pose", &stats.cartesian.mean, &stats.cartesian.cov);
    }
    if are_twists_defined && n > 1 {
        assertions::assert_valid_moments("exponential", &stats.exponential.mean, &stats.exponential.cov);
    } else {
        assert!(n == 1 || stats.exponential.cov.iter().all(|cov_entry| cov_entry.is_nan()));
    }
    let (cross_track_skew, skew_error) = (stats.cross_track_skew, stats.cross_track_skew_error);
    assertions::assert_all_finite_or_all_nan("skew", &[cross_track_skew, skew_error]);
    // The skew of n samples is largest for n − 1 equal samples and one different sample.
    let max_skew = (n as f64 - 2.0) / (n as f64 - 1.0).sqrt();
    assert!(cross_track_skew.is_nan() || cross_track_skew.abs() <= max_skew * (1.0 + 1e-9), "{cross_track_skew} of {n}");
    assert!(skew_error.is_nan() || skew_error >= 0.0, "{skew_error}");
    let lateral_heading_correlation = stats.rho_cross_heading;
    assert!(lateral_heading_correlation.is_nan() || lateral_heading_correlation.abs() <= 1.0, "{lateral_heading_correlation}");
    assertions::assert_all_finite_or_all_nan("gaussian skew", &[stats.gaussian_skew]);
    assertions::assert_fraction("inside the ellipse", stats.coverage.ellipse);
    assertions::assert_fraction("inside the contour", stats.coverage.exponential);
    assert!(stats.area_ratio.is_nan() || stats.area_ratio >= 0.0, "{}", stats.area_ratio);
    let (gain, gain_error) = (stats.likelihood_gain, stats.likelihood_gain_error);
    for (gain, gain_error) in [(gain.pose, gain_error.pose), (gain.floor, gain_error.floor)] {
        assert!(gain_error.is_nan() || (gain_error >= 0.0 && gain.is_finite()), "gain {gain} ± {gain_error}");
    }
}

fn assert_contours(simulation: &BananaMachine) {
    let Contours { command: command_path, ellipse: covariance_ellipse, linearized: linearized_ellipse,
        exponential: exponential_contour, twist_ellipse, additive: additive_contour } = simulation.contours();
    for (outline_name, outline) in [
        ("command", &command_path),
        ("ellipse", &covariance_ellipse),
        ("linearized", &linearized_ellipse),
        ("exponential", &exponential_contour),
        ("twist ellipse", &twist_ellipse),
        ("additive", &additive_contour),
    ] {
        assertions::assert_finite(outline_name, outline.as_flattened());
    }
    for outline in [&covariance_ellipse, &linearized_ellipse, &exponential_contour, &twist_ellipse, &additive_contour] {
        assert_eq!(outline.first(), outline.last(), "an outline is closed");
    }
    assert_eq!(covariance_ellipse.is_empty(), simulation.shown_count() < 2);
    assert_eq!(exponential_contour.is_empty(), simulation.shown_count() < 2 || !simulation.is_exponential_defined());
}

/// Checks every column of the simulation's table of moments. The check is slow, because exact moments need quadrature.
fn assert_table(simulation: &BananaMachine) {
    let moment_table = simulation.table();
    for (column_name, table_column) in [("linearized", &moment_table.linearized), ("exact", &moment_table.exact)] {
        let TableColumn { mean, cov, cross_track_skew, likelihood_gain, area_ratio } = table_column;
        assertions::assert_valid_moments(column_name, mean, cov);
        assertions::assert_all_finite_or_all_nan(column_name, &[*cross_track_skew]);
        assert!(
            !likelihood_gain.pose.is_infinite() || likelihood_gain.pose > 0.0,
            "{column_name}: {likelihood_gain:?}"
        );
        assert!(area_ratio.is_nan() || *area_ratio >= 0.0, "{column_name}: {area_ratio}");
    }
    if let Some(tangent_moments) = moment_table.tangent {
        assertions::assert_valid_moments("tangent", &tangent_moments.mean, &tangent_moments.cov);
    }
    let odometry_reading = simulation.reading();
    assertions::assert_finite("reading", &[odometry_reading.rot1, odometry_reading.trans, odometry_reading.rot2]);
}

fn assert_executed_motion(simulation: &BananaMachine, robot_index: usize) {
    let Some(inspected_sample) = simulation.inspect(robot_index) else {
        assert!(robot_index >= simulation.shown_count());
        return;
    };
    assertions::assert_pose("inspected", &inspected_sample.pose.into());
    assertions::assert_finite("path", inspected_sample.path.as_flattened());
    if let Some(executed_odometry) = inspected_sample.legs {
        assertions::assert_finite("legs", &[executed_odometry.rot1, executed_odometry.trans, executed_odometry.rot2]);
    }
    let [x, y] = *inspected_sample.path.last().expect("a path has an end");
    // Paths are computed by scalar functions, and poses by SIMD functions. Paths and poses agree to 2e-15 of the length.
    let path_length = inspected_sample.path.windows(2).map(|segment_ends| distance_between(segment_ends[0], segment_ends[1])).sum::<f64>();
    let command = simulation.settings().command;
    let commanded_path_length = (command.v * command.dt).abs();
    let max_path_length = inspected_sample.legs.map_or((inspected_sample.v_hat * command.dt).abs(), |executed_odometry| executed_odometry.trans.abs());
    assert!(path_length <= max_path_length * (1.0 + 1e-9) + 1e-9, "{path_length}, {max_path_length}");
    // If the noise nearly cancels the command, the executed motion is short, but has the rounding error of the longer commanded motion.
    let rounding_factor = 1.0 + (command.omega * command.dt).abs();
    let rounding_error = 1e-14 * (max_path_length * rounding_factor + commanded_path_length) + f64::MIN_POSITIVE;
    assert!(
        distance_between([x, y], [inspected_sample.pose[0], inspected_sample.pose[1]]) <= rounding_error,
        "{inspected_sample:?} of {:?}",
        simulation.settings()
    );
}

fn distance_between(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Reads a random rectangle of a view from the fuzz input, divided into at most 40 × 40 cells.
pub fn read_view_grid(fuzz_input: &mut InputReader) -> ViewGrid {
    let view_min = [0; 2].map(|_| fuzz_input.draw_number_within(EXTENT_RANGE));
    let view_max = view_min.map(|min_coordinate| fuzz_input.draw_number_within(min_coordinate..=*EXTENT_RANGE.end()));
    let [column_count, row_count] = [0; 2].map(|_| 1 + fuzz_input.next_below(40));
    ViewGrid { min_corner: view_min, max_corner: view_max, column_count, row_count }
}

fn assert_picture(simulation: &mut BananaMachine, fuzz_input: &mut InputReader) {
    let (morph, view_grid) = (fuzz_input.choose_one(&[0.0, 1.0]), read_view_grid(fuzz_input));
    let cell_counts = simulation.density(morph, &view_grid);
    assert_eq!(cell_counts.len(), view_grid.column_count * view_grid.row_count);
    assert!(cell_counts.iter().sum::<u32>() as usize <= simulation.shown_count(), "{view_grid:?}: {cell_counts:?}");
    let pixels = simulation.paint_picture(morph, &view_grid, &[[1; 4]; RAMP_STEP_COUNT]);
    assert_eq!(pixels.len(), cell_counts.len());
    assert!(pixels.iter().zip(&cell_counts).all(|(pixel_rgba, cell_count)| (pixel_rgba[3] > 0) == (*cell_count > 0)), "{view_grid:?}");
}

fn assert_nearest_pose(simulation: &BananaMachine, fuzz_input: &mut InputReader) {
    let search_point = [0; 2].map(|_| fuzz_input.next_number());
    let search_radii = [0; 2].map(|_| fuzz_input.draw_number_within(0.0..=f64::INFINITY));
    let Some(nearest_index) = simulation.find_nearest(0.0, search_point, search_radii) else { return };
    let nearest_pose: SE2 = simulation.poses().nth(nearest_index).expect("a sample that is shown");
    let relative_distance_to = |pose: &SE2| ((pose.x() - search_point[0]) / search_radii[0]).hypot((pose.y() - search_point[1]) / search_radii[1]);
    // The absolute tolerance is 1e-150, because squares of distances below 1e-154 underflow to 0.
    let min_relative_distance = simulation.poses().map(|pose| relative_distance_to(&pose)).fold(f64::INFINITY, f64::min);
    assert!(relative_distance_to(&nearest_pose) <= min_relative_distance * (1.0 + 1e-9) + 1e-150, "{search_point:?} {search_radii:?}: {nearest_index}");
}
