//! The Banana Machine under any settings and calls.

use super::input::InputReader;
use super::assertions;
use super::settings::{are_settings_allowed, change_settings};
use motion::geom::se2::SE2;
use motion::sim::View;
use motion::sim::banana::{
    BananaMachine, Contours, Stats, Settings, TableColumn, command_reaching,
};
use motion::sim::picture::RAMP_STEP_COUNT;
use motion::sim::settings::QUANTITY_RANGE;
use motion::sim::views::{EXTENT_RANGE, ViewGrid};

/// Maximum numbers of samples and of calls in a run. The limits are large enough to reach every branch, and small enough to allow many
/// runs.
const MAX_SAMPLES: usize = 12;
const MAX_CALLS: usize = 4;

pub fn run(input_bytes: &[u8]) {
    let mut input = InputReader(input_bytes);
    let [should_check_curves, should_compare_new_simulation] = [0; 2].map(|_| input.next_below(4) == 1);
    let first_settings = change_settings(&limit_samples(Settings::default()), &mut input);
    if !are_settings_allowed(&first_settings) {
        assert!(BananaMachine::with_shown_count(first_settings, 0).is_err());
        return;
    }
    let mut simulation = BananaMachine::with_shown_count(limit_samples(first_settings), 0).expect("allowed");
    if input.next_bool() {
        simulation.add_samples(MAX_SAMPLES);
    }
    for _ in 0..MAX_CALLS {
        if input.is_empty() {
            break;
        }
        call_method(&mut simulation, &mut input);
    }
    assert_results(&simulation);
    // Slow checks run for some inputs only.
    if should_check_curves {
        assert_contours(&simulation);
    }
    if should_compare_new_simulation {
        assert_equals_new_simulation(&simulation);
    }
}

/// Returns the settings with at most `MAX_SAMPLES` samples.
fn limit_samples(settings: Settings) -> Settings {
    Settings { samples: settings.samples.min(MAX_SAMPLES), ..settings }
}

fn call_method(simulation: &mut BananaMachine, input: &mut InputReader) {
    match input.next_below(9) {
        0 => change_simulation_settings(simulation, input),
        1 => assert_same_if_added_in_blocks(simulation, input),
        2 => {
            let count_before = simulation.shown_count();
            let added_count = input.next_below(MAX_SAMPLES);
            let count_after = simulation.add_samples(added_count);
            assert_eq!(count_after, (count_before + added_count).min(simulation.settings().samples));
        }
        3 => {
            simulation.configure_first(*simulation.settings(), 0).expect("allowed");
            assert_eq!(simulation.shown_count(), 0);
        }
        4 => assert_picture(simulation, input),
        5 => assert_nearest_pose(simulation, input),
        6 => assert_executed_motion(simulation, usize::from(input.next_byte())),
        7 => assert_table(simulation),
        _ => {
            let [x, y] = [0; 2].map(|_| input.draw_number_within(QUANTITY_RANGE));
            let current_command = simulation.settings().command;
            let reaching_command = command_reaching(x, y, &current_command);
            // The speed may be infinite, because the circle of a nearly straight arc may be too long for a double.
            assert!(!reaching_command.v.is_nan() && reaching_command.omega.is_finite(), "{reaching_command:?} to {x}, {y}");
        }
    }
}

fn change_simulation_settings(simulation: &mut BananaMachine, input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), input);
    if are_settings_allowed(&settings) {
        simulation.configure(limit_samples(settings)).expect("allowed");
        return;
    }
    let (settings_before, results_before) = (*simulation.settings(), all_results(simulation));
    assert!(simulation.configure(settings).is_err() && simulation.configure_first(settings, 0).is_err());
    assert_eq!(*simulation.settings(), settings_before);
    assertions::assert_same_numbers("after a refusal", &all_results(simulation), &results_before);
}

/// Asserts that samples that are added in several blocks equal samples that are added in one call.
fn assert_same_if_added_in_blocks(simulation: &mut BananaMachine, input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), input);
    if !are_settings_allowed(&settings) {
        return;
    }
    let mut simulation_in_one_call = simulation.clone();
    simulation_in_one_call.configure(limit_samples(settings)).expect("allowed");
    let block_size = 1 + usize::from(input.next_byte());
    simulation.configure_first(limit_samples(settings), block_size).expect("allowed");
    while simulation.shown_count() < simulation.settings().samples {
        simulation.add_samples(block_size);
    }
    assertions::assert_same_numbers("in blocks", &all_results(simulation), &all_results(&simulation_in_one_call));
}

/// Asserts that a simulation depends on its settings only, and not on earlier calls.
fn assert_equals_new_simulation(simulation: &BananaMachine) {
    let mut new_simulation = BananaMachine::with_shown_count(*simulation.settings(), 0).expect("allowed");
    if simulation.shown_count() > 0 {
        new_simulation.add_samples(simulation.shown_count());
        assertions::assert_same_numbers("as if new", &all_results(simulation), &all_results(&new_simulation));
    }
}

/// Returns the poses and statistics.
fn all_results(simulation: &BananaMachine) -> Vec<f64> {
    let mut all_numbers: Vec<f64> = simulation.poses().flat_map(|pose| [pose.x(), pose.y(), pose.theta()]).collect();
    let stats @ Stats { cartesian, exponential, coverage, .. } = simulation.stats();
    all_numbers.extend(cartesian.mean.iter().chain(cartesian.cov.iter()));
    all_numbers.extend(exponential.mean.iter().chain(exponential.cov.iter()));
    all_numbers.extend([stats.cross_track_skew, stats.cross_track_skew_error]);
    all_numbers.extend([stats.rho_cross_heading, stats.gaussian_skew]);
    all_numbers.extend([coverage.ellipse, coverage.exponential, stats.area_ratio, stats.area_ratio_error]);
    for gain_or_error in [stats.likelihood_gain, stats.likelihood_gain_error] {
        all_numbers.extend([gain_or_error.pose, gain_or_error.floor]);
    }
    all_numbers
}

/// Asserts that all results are finite. An undefined result must be NaN.
fn assert_results(simulation: &BananaMachine) {
    let (n, stats) = (simulation.shown_count(), simulation.stats());
    simulation.poses().for_each(|pose| assertions::assert_pose("a pose", &pose));
    assert_eq!(simulation.poses().len(), n);
    assertions::assert_finite("executed", simulation.executed_motions().collect::<Vec<_>>().as_flattened());
    let is_chart_defined = simulation.is_chart_defined();
    if is_chart_defined {
        simulation.twists().for_each(|twist| assertions::assert_finite("a twist", twist.as_slice()));
    }
    if n > 0 {
        assertions::assert_finite("mean", stats.cartesian.mean.as_slice());
    }
    if n > 1 {
        assertions::assert_valid_moments("pose", &stats.cartesian.mean, &stats.cartesian.cov);
    }
    if is_chart_defined && n > 1 {
        assertions::assert_valid_moments("exponential", &stats.exponential.mean, &stats.exponential.cov);
    } else {
        assert!(n == 1 || stats.exponential.cov.iter().all(|cov_entry| cov_entry.is_nan()));
    }
    let (skew, skew_error) = (stats.cross_track_skew, stats.cross_track_skew_error);
    assertions::assert_all_finite_or_all_nan("skew", &[skew, skew_error]);
    // The skew of n samples is largest for n − 1 equal samples and one different sample.
    let max_skew = (n as f64 - 2.0) / (n as f64 - 1.0).sqrt();
    assert!(skew.is_nan() || skew.abs() <= max_skew * (1.0 + 1e-9), "{skew} of {n}");
    assert!(skew_error.is_nan() || skew_error >= 0.0, "{skew_error}");
    let lateral_heading_correlation = stats.rho_cross_heading;
    assert!(lateral_heading_correlation.is_nan() || lateral_heading_correlation.abs() <= 1.0, "{lateral_heading_correlation}");
    assertions::assert_all_finite_or_all_nan("gaussian skew", &[stats.gaussian_skew]);
    assertions::assert_fraction("inside the ellipse", stats.coverage.ellipse);
    assertions::assert_fraction("inside the contour", stats.coverage.exponential);
    assert!(stats.area_ratio.is_nan() || stats.area_ratio >= 0.0, "{}", stats.area_ratio);
    let (likelihood_gain, gain_error) = (stats.likelihood_gain, stats.likelihood_gain_error);
    for (likelihood_gain, gain_error) in [(likelihood_gain.pose, gain_error.pose), (likelihood_gain.floor, gain_error.floor)] {
        assert!(gain_error.is_nan() || (gain_error >= 0.0 && likelihood_gain.is_finite()), "gain {likelihood_gain} ± {gain_error}");
    }
}

fn assert_contours(simulation: &BananaMachine) {
    let Contours { command, ellipse, linearized, exponential, twist_ellipse, additive } = simulation.contours();
    for (outline_name, outline) in [
        ("command", &command),
        ("ellipse", &ellipse),
        ("linearized", &linearized),
        ("exponential", &exponential),
        ("twist ellipse", &twist_ellipse),
        ("additive", &additive),
    ] {
        assertions::assert_finite(outline_name, outline.as_flattened());
    }
    for outline in [&ellipse, &linearized, &exponential, &twist_ellipse, &additive] {
        assert_eq!(outline.first(), outline.last(), "an outline is closed");
    }
    assert_eq!(ellipse.is_empty(), simulation.shown_count() < 2);
    assert_eq!(exponential.is_empty(), simulation.shown_count() < 2 || !simulation.is_chart_defined());
}

/// Checks every column of the table. The check is slow, because exact moments need quadrature.
fn assert_table(simulation: &BananaMachine) {
    let table = simulation.table();
    for (column_name, table_column) in [("linearized", &table.linearized), ("exact", &table.exact)] {
        let TableColumn { mean, cov, cross_track_skew, likelihood_gain, area_ratio } = table_column;
        assertions::assert_valid_moments(column_name, mean, cov);
        assertions::assert_all_finite_or_all_nan(column_name, &[*cross_track_skew]);
        assert!(
            !likelihood_gain.pose.is_infinite() || likelihood_gain.pose > 0.0,
            "{column_name}: {likelihood_gain:?}"
        );
        assert!(area_ratio.is_nan() || *area_ratio >= 0.0, "{column_name}: {area_ratio}");
    }
    if let Some(tangent) = table.tangent {
        assertions::assert_valid_moments("tangent", &tangent.mean, &tangent.cov);
    }
    let reading = simulation.reading();
    assertions::assert_finite("reading", &[reading.rot1, reading.trans, reading.rot2]);
}

fn assert_executed_motion(simulation: &BananaMachine, robot_index: usize) {
    let Some(inspected_sample) = simulation.inspect(robot_index) else {
        assert!(robot_index >= simulation.shown_count());
        return;
    };
    assertions::assert_pose("inspected", &inspected_sample.pose.into());
    assertions::assert_finite("path", inspected_sample.path.as_flattened());
    if let Some(executed_legs) = inspected_sample.legs {
        assertions::assert_finite("legs", &[executed_legs.rot1, executed_legs.trans, executed_legs.rot2]);
    }
    let [x, y] = *inspected_sample.path.last().expect("a path has an end");
    // Paths are computed by scalar functions, and poses by SIMD functions. Paths and poses agree to 2e-15 of the length.
    let path_length = inspected_sample.path.windows(2).map(|segment_ends| point_distance(segment_ends[0], segment_ends[1])).sum::<f64>();
    let command = simulation.settings().command;
    let commanded_path_length = (command.v * command.dt).abs();
    let max_path_length = inspected_sample.legs.map_or((inspected_sample.v_hat * command.dt).abs(), |executed_legs| executed_legs.trans.abs());
    assert!(path_length <= max_path_length * (1.0 + 1e-9) + 1e-9, "{path_length}, {max_path_length}");
    // If the noise nearly cancels the command, the motion still has the rounding error of the command.
    let rounding_factor = 1.0 + (command.omega * command.dt).abs();
    let rounding_error = 1e-14 * (max_path_length * rounding_factor + commanded_path_length) + f64::MIN_POSITIVE;
    assert!(
        point_distance([x, y], [inspected_sample.pose[0], inspected_sample.pose[1]]) <= rounding_error,
        "{inspected_sample:?} of {:?}",
        simulation.settings()
    );
}

fn point_distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Returns a rectangle of a view with few cells.
pub fn read_grid(input: &mut InputReader) -> ViewGrid {
    let grid_min = [0; 2].map(|_| input.draw_number_within(EXTENT_RANGE));
    let grid_max = grid_min.map(|min_coordinate| input.draw_number_within(min_coordinate..=*EXTENT_RANGE.end()));
    let [column_count, row_count] = [0; 2].map(|_| 1 + input.next_below(40));
    ViewGrid { min: grid_min, max: grid_max, columns: column_count, rows: row_count }
}

fn assert_picture(simulation: &mut BananaMachine, input: &mut InputReader) {
    let (view, grid) = (input.choose_one(&[View::Plane, View::Twist]), read_grid(input));
    let cell_counts = simulation.density(view, &grid);
    assert_eq!(cell_counts.len(), grid.columns * grid.rows);
    assert!(cell_counts.iter().sum::<u32>() as usize <= simulation.shown_count(), "{grid:?}: {cell_counts:?}");
    let pixels = simulation.paint(view, &grid, &[[1; 4]; RAMP_STEP_COUNT]);
    assert_eq!(pixels.len(), cell_counts.len());
    assert!(pixels.iter().zip(&cell_counts).all(|(pixel, cell_count)| (pixel[3] > 0) == (*cell_count > 0)), "{grid:?}");
}

fn assert_nearest_pose(simulation: &BananaMachine, input: &mut InputReader) {
    let search_point = [0; 2].map(|_| input.next_number());
    let search_radii = [0; 2].map(|_| input.draw_number_within(0.0..=f64::INFINITY));
    let Some(nearest_index) = simulation.nearest(View::Plane, search_point, search_radii) else { return };
    let nearest_pose: SE2 = simulation.pose(nearest_index).expect("a sample that is shown");
    let relative_distance_to = |pose: &SE2| ((pose.x() - search_point[0]) / search_radii[0]).hypot((pose.y() - search_point[1]) / search_radii[1]);
    // The square of a distance below 1e-154 underflows to 0.
    let min_relative_distance = simulation.poses().map(|pose| relative_distance_to(&pose)).fold(f64::INFINITY, f64::min);
    assert!(relative_distance_to(&nearest_pose) <= min_relative_distance * (1.0 + 1e-9) + 1e-150, "{search_point:?} {search_radii:?}: {nearest_index}");
}
