//! Arc Anatomy under any settings and calls.

use super::input::{InputReader, is_selected_by_hash};
use super::settings::{are_settings_allowed, change_settings};
use super::{assertions, banana};
use motion::geom::se2::SE2;
use motion::sim::arc_anatomy::{ArcAnatomy, ArcWithCircle, SurfaceKind, Paths, Settings, Stats, Surface, Table};
use motion::sim::views::ViewGrid;

/// Maximum number of calls in a run.
const MAX_CALLS: usize = 4;

pub fn run(input_bytes: &[u8]) {
    let mut input = InputReader(input_bytes);
    let should_check_paths = input.next_below(8) == 1;
    let first_settings = change_settings(&Settings::default(), &mut input);
    if !are_settings_allowed(&first_settings) {
        assert!(ArcAnatomy::new(first_settings).is_err());
        return;
    }
    let mut simulation = ArcAnatomy::new(first_settings).expect("allowed");
    for _ in 0..MAX_CALLS {
        if input.is_empty() {
            break;
        }
        if input.next_below(3) == 0 {
            position_at(&simulation, input.draw_number_within(0.0..=1.0));
        } else {
            change_simulation_settings(&mut simulation, &mut input);
        }
    }
    assert_results(&simulation);
    // Paths are rarely checked, because each of their thousand points needs a sine and a cosine.
    if should_check_paths && is_selected_by_hash(4, input_bytes) {
        assert_paths(&simulation);
    }
    // Heat maps are rarely checked, because a heat map takes as long as hundreds of other calls.
    if is_selected_by_hash(256, input_bytes) {
        assert_surface(&simulation, &mut input);
    }
}

fn change_simulation_settings(simulation: &mut ArcAnatomy, input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), input);
    if are_settings_allowed(&settings) {
        simulation.configure(settings).expect("allowed");
        return;
    }
    let settings_before = *simulation.settings();
    assert!(simulation.configure(settings).is_err());
    assert_eq!(*simulation.settings(), settings_before);
}

/// Asserts that all results are finite. An undefined result must have its documented value.
fn assert_results(simulation: &ArcAnatomy) {
    let settings = simulation.settings();
    let Stats { commanded, inverted, driven, last_turn, factors, weakest, prob, share, density, xi } =
        simulation.stats();
    for (arc_name, tested_arc) in [("commanded", &commanded), ("inverted", &inverted), ("driven", &driven)] {
        assert_arc(arc_name, tested_arc);
    }
    assertions::assert_finite("last turn", &[last_turn]);
    assertions::assert_finite("xi", &xi);
    for factor in &factors {
        assertions::assert_finite("factor", &[factor.estimate, factor.residual, factor.deviation, factor.value]);
        assert!(factor.deviation >= 0.0 && factor.value >= 0.0, "{factor:?}");
        assert!((0.0..=1.0).contains(&factor.share), "{factor:?}");
        let sigma_count = factor.deviations.abs();
        assert!(sigma_count <= factors[weakest].deviations.abs(), "{factor:?} {weakest}");
        assert!(sigma_count.is_finite() || factor.deviation == 0.0, "{factor:?}");
    }
    assert!(prob >= 0.0 && (0.0..=1.0).contains(&share), "p = {prob}, {share} of its highest");
    let are_all_factors_noisy = factors.iter().all(|factor| factor.deviation > 0.0);
    assert!(density.is_some() == are_all_factors_noisy && density.is_none_or(|density| density >= 0.0), "{density:?}");
    assert!(settings.printed || driven == inverted, "{driven:?} {inverted:?}");

    let (start_pose, next_pose) = start_and_next_pose(settings);
    let largest_coordinate =
        [start_pose.x(), start_pose.y(), next_pose.x(), next_pose.y()].iter().fold(0.0, |max_so_far: f64, coordinate| max_so_far.max(coordinate.abs()));
    let distance_to_next_pose = |[x, y]: [f64; 2]| (x - next_pose.x()).hypot(y - next_pose.y());
    // With a signed radius, both the inverted arc and the constant twist lead to the final position.
    let end_positions = [[inverted.end[0], inverted.end[1]], position_at(simulation, 1.0)];
    let position_tolerance = assertions::ROUNDING_TOLERANCE * largest_coordinate + f64::MIN_POSITIVE;
    assert!(end_positions.iter().all(|end_position| distance_to_next_pose(*end_position) <= position_tolerance), "{end_positions:?} for {settings:?}");
    assert_eq!(position_at(simulation, 0.0), [start_pose.x(), start_pose.y()]);
    assert_table(simulation, prob);
}

fn start_and_next_pose(settings: &Settings) -> (SE2, SE2) {
    (settings.start.into(), settings.next.into())
}

fn assert_table(simulation: &ArcAnatomy, prob: f64) {
    let (start_pose, next_pose) = start_and_next_pose(simulation.settings());
    let Table { lines: [mu, x, y, radius, controls @ ..], middle, normal } = simulation.table();
    let relative_pose = start_pose.inverse() * next_pose;
    let has_no_displacement = [relative_pose.x(), relative_pose.y()] == [0.0; 2];
    assert!([x, y, radius].iter().all(|table_value| !table_value.is_nan()), "{x} {y} {radius}");
    assert!(!mu.is_nan() || has_no_displacement, "{mu} for {relative_pose:?}");
    assert!(!simulation.settings().printed || radius >= 0.0, "{radius}");
    assertions::assert_finite("controls", &controls[..4]);
    assertions::assert_same_numbers("p", &controls[4..], &[prob]);
    assertions::assert_finite("middle and normal", &[middle, normal].concat());
}

fn assert_paths(simulation: &ArcAnatomy) {
    let Paths { commanded, inverted, driven, lie, ticks } = simulation.paths();
    for (path_name, path_points) in
        [("commanded", &commanded), ("inverted", &inverted), ("driven", &driven), ("lie", &lie)]
    {
        assertions::assert_finite(path_name, path_points.as_flattened());
    }
    assertions::assert_finite("ticks", ticks.as_flattened());
    let Stats { inverted: ArcWithCircle { end: [x, y, _], .. }, .. } = simulation.stats();
    assert_eq!(inverted.last(), Some(&[x, y]));
}

fn assert_arc(arc_name: &str, tested_arc: &ArcWithCircle) {
    assertions::assert_finite(arc_name, &[tested_arc.arc_length, tested_arc.turn]);
    assertions::assert_finite(arc_name, &tested_arc.end);
    assert!(!tested_arc.radius.is_nan(), "{arc_name}: {tested_arc:?}");
    assert_eq!(tested_arc.centre.is_some(), tested_arc.radius.is_finite(), "{arc_name}: {tested_arc:?}");
    assertions::assert_finite(arc_name, &tested_arc.centre.unwrap_or_default());
}

/// Returns the position on the path with constant twist after `time_fraction` of the time.
fn position_at(simulation: &ArcAnatomy, time_fraction: f64) -> [f64; 2] {
    let poses = simulation.poses_at(time_fraction);
    poses.iter().for_each(|pose| assertions::assert_pose("poses_at", pose));
    [poses[2].x(), poses[2].y()]
}

/// Asserts that the contours of the heat map are inside its rectangle.
fn assert_surface(simulation: &ArcAnatomy, input: &mut InputReader) {
    let ViewGrid { min, max, .. } = banana::read_grid(input);
    let surface = simulation.surface(min, max);
    assert_eq!(surface.is_none(), simulation.settings().map == SurfaceKind::Nothing);
    let Some(Surface { columns, rows, shades, prob, density }) = surface else { return };
    assert!(shades.len() == columns * rows && !shades.is_empty(), "{columns} × {rows}");
    for [x, y] in prob.iter().chain(&density).flatten() {
        let is_inside = (min[0]..=max[0]).contains(x) && (min[1]..=max[1]).contains(y);
        assert!(is_inside, "{x}, {y} of {min:?} to {max:?}");
    }
}
