//! Fuzz target of Arc Anatomy: arbitrary settings and calls.

use super::input::{InputReader, is_selected_by_hash};
use super::settings::{are_settings_allowed, change_settings};
use super::{assertions, banana};
use motion::geom::se2::SE2;
use motion::sim::arc_anatomy::{ArcAnatomy, ArcWithCircle, HeatMapKind, Paths, Settings, Stats, Surface, Table};
use motion::sim::views::ViewGrid;

const MAX_CALLS: usize = 4;

pub fn check_input(fuzz_input_bytes: &[u8]) {
    let mut fuzz_input = InputReader(fuzz_input_bytes);
    let should_check_paths = fuzz_input.next_below(8) == 1;
    let first_settings = change_settings(&Settings::default(), &mut fuzz_input);
    if !are_settings_allowed(&first_settings) {
        assert!(ArcAnatomy::new(first_settings).is_err());
        return;
    }
    let mut simulation = ArcAnatomy::new(first_settings).expect("allowed");
    for _ in 0..MAX_CALLS {
        if fuzz_input.is_empty() {
            break;
        }
        if fuzz_input.next_below(3) == 0 {
            find_position_at(&simulation, fuzz_input.draw_number_within(0.0..=1.0));
        } else {
            change_simulation_settings(&mut simulation, &mut fuzz_input);
        }
    }
    assert_results(&simulation);
    // The points of paths are checked for one input in four only, because each of a thousand points needs a sine and a cosine.
    if should_check_paths && is_selected_by_hash(4, fuzz_input_bytes) {
        assert_paths(&simulation);
    }
    // Heat maps are checked for one input in 256 only, because a heat map takes as long as hundreds of other calls.
    if is_selected_by_hash(256, fuzz_input_bytes) {
        assert_surface(&simulation, &mut fuzz_input);
    }
}

fn change_simulation_settings(simulation: &mut ArcAnatomy, fuzz_input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), fuzz_input);
    if are_settings_allowed(&settings) {
        simulation.configure(settings).expect("allowed");
        return;
    }
    let settings_before = *simulation.settings();
    assert!(simulation.configure(settings).is_err());
    assert_eq!(*simulation.settings(), settings_before);
}

/// Asserts that all results are finite. A result that is undefined must have the value that its documentation states.
fn assert_results(simulation: &ArcAnatomy) {
    let settings = simulation.settings();
    let Stats { commanded: commanded_arc, inverted: inverted_arc, driven: driven_arc, last_turn,
        factors: probability_factors, weakest: weakest_factor_index, prob: table_score, share: share_of_highest_score, density: pose_density, xi: final_twist } =
        simulation.stats();
    for (arc_name, tested_arc) in [("commanded", &commanded_arc), ("inverted", &inverted_arc), ("driven", &driven_arc)] {
        assert_arc(arc_name, tested_arc);
    }
    assertions::assert_finite("last turn", &[last_turn]);
    assertions::assert_finite("xi", &final_twist);
    for probability_factor in &probability_factors {
        assertions::assert_finite("factor", &[probability_factor.estimate, probability_factor.residual, probability_factor.deviation, probability_factor.value]);
        assert!(probability_factor.deviation >= 0.0 && probability_factor.value >= 0.0, "{probability_factor:?}");
        assert!((0.0..=1.0).contains(&probability_factor.share), "{probability_factor:?}");
        let sigma_count = probability_factor.deviations.abs();
        assert!(sigma_count <= probability_factors[weakest_factor_index].deviations.abs(), "{probability_factor:?} {weakest_factor_index}");
        assert!(sigma_count.is_finite() || probability_factor.deviation == 0.0, "{probability_factor:?}");
    }
    assert!(table_score >= 0.0 && (0.0..=1.0).contains(&share_of_highest_score), "p = {table_score}, {share_of_highest_score} of its highest");
    let are_all_factors_noisy = probability_factors.iter().all(|probability_factor| probability_factor.deviation > 0.0);
    assert!(pose_density.is_some() == are_all_factors_noisy && pose_density.is_none_or(|pose_density| pose_density >= 0.0), "{pose_density:?}");
    assert!(settings.printed || driven_arc == inverted_arc, "{driven_arc:?} {inverted_arc:?}");

    let (start_pose, next_pose) = find_start_and_next_pose(settings);
    let largest_coordinate =
        [start_pose.x(), start_pose.y(), next_pose.x(), next_pose.y()].iter().fold(0.0, |max_so_far: f64, coordinate| max_so_far.max(coordinate.abs()));
    let distance_to_next_pose = |[x, y]: [f64; 2]| (x - next_pose.x()).hypot(y - next_pose.y());
    // With a signed radius, both the inverted arc and the constant twist lead to the final position.
    let end_positions = [[inverted_arc.end[0], inverted_arc.end[1]], find_position_at(simulation, 1.0)];
    let position_tolerance = assertions::ROUNDING_TOLERANCE * largest_coordinate + f64::MIN_POSITIVE;
    assert!(end_positions.iter().all(|end_position| distance_to_next_pose(*end_position) <= position_tolerance), "{end_positions:?} for {settings:?}");
    assert_eq!(find_position_at(simulation, 0.0), [start_pose.x(), start_pose.y()]);
    assert_table(simulation, table_score);
}

fn find_start_and_next_pose(settings: &Settings) -> (SE2, SE2) {
    (settings.start.into(), settings.next.into())
}

fn assert_table(simulation: &ArcAnatomy, table_score: f64) {
    let (start_pose, next_pose) = find_start_and_next_pose(simulation.settings());
    let Table { lines: [table_mu, x, y, table_radius, table_controls @ ..], middle: chord_middle, normal: left_normal } = simulation.table();
    let relative_pose = start_pose.inverse() * next_pose;
    let has_no_displacement = [relative_pose.x(), relative_pose.y()] == [0.0; 2];
    assert!([x, y, table_radius].iter().all(|table_value| !table_value.is_nan()), "{x} {y} {table_radius}");
    assert!(!table_mu.is_nan() || has_no_displacement, "{table_mu} for {relative_pose:?}");
    assert!(!simulation.settings().printed || table_radius >= 0.0, "{table_radius}");
    assertions::assert_finite("controls", &table_controls[..4]);
    assertions::assert_same_numbers("p", &table_controls[4..], &[table_score]);
    assertions::assert_finite("middle and normal", &[chord_middle, left_normal].concat());
}

fn assert_paths(simulation: &ArcAnatomy) {
    let Paths { commanded: commanded_path, inverted: inverted_path, driven: driven_path, lie: constant_twist_path, ticks: lateral_velocity_segments } = simulation.paths();
    for (path_name, path_points) in
        [("commanded", &commanded_path), ("inverted", &inverted_path), ("driven", &driven_path), ("lie", &constant_twist_path)]
    {
        assertions::assert_finite(path_name, path_points.as_flattened());
    }
    assertions::assert_finite("ticks", lateral_velocity_segments.as_flattened());
    let Stats { inverted: ArcWithCircle { end: [x, y, _], .. }, .. } = simulation.stats();
    assert_eq!(inverted_path.last(), Some(&[x, y]));
}

fn assert_arc(arc_name: &str, tested_arc: &ArcWithCircle) {
    assertions::assert_finite(arc_name, &[tested_arc.arc_length, tested_arc.turn]);
    assertions::assert_finite(arc_name, &tested_arc.end);
    assert!(!tested_arc.radius.is_nan(), "{arc_name}: {tested_arc:?}");
    assert_eq!(tested_arc.centre.is_some(), tested_arc.radius.is_finite(), "{arc_name}: {tested_arc:?}");
    assertions::assert_finite(arc_name, &tested_arc.centre.unwrap_or_default());
}

/// Returns the position after `time_fraction` of the time on the path with constant twist.
fn find_position_at(simulation: &ArcAnatomy, time_fraction: f64) -> [f64; 2] {
    let poses = simulation.poses_at(time_fraction);
    poses.iter().for_each(|pose| assertions::assert_pose("poses_at", pose));
    [poses[2].x(), poses[2].y()]
}

/// Asserts that the contours of the heat map are inside its rectangle.
fn assert_surface(simulation: &ArcAnatomy, fuzz_input: &mut InputReader) {
    let ViewGrid { min_corner: view_min, max_corner: view_max, .. } = banana::read_view_grid(fuzz_input);
    let heat_map = simulation.surface(view_min, view_max);
    assert_eq!(heat_map.is_none(), simulation.settings().map == HeatMapKind::NoHeatMap);
    let Some(Surface { columns: column_count, rows: row_count, shades: pixel_shades, prob: score_contours, density: density_contours }) = heat_map else { return };
    assert!(pixel_shades.len() == column_count * row_count && !pixel_shades.is_empty(), "{column_count} × {row_count}");
    for [x, y] in score_contours.iter().chain(&density_contours).flatten() {
        let is_inside_view = (view_min[0]..=view_max[0]).contains(x) && (view_min[1]..=view_max[1]).contains(y);
        assert!(is_inside_view, "{x}, {y} of {view_min:?} to {view_max:?}");
    }
}
