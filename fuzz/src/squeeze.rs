//! Fuzz target of Map Squeeze: arbitrary settings, maps and calls.

use super::input::InputReader;
use super::settings::{are_settings_allowed, change_settings};
use super::{assertions, banana, grid, plan};
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, Sampler};
use motion::sim::picture::RAMP_STEP_COUNT;
use motion::sim::squeeze::{OUTCOME_KIND_COUNT, MapSqueeze, Settings};
use std::cell::LazyCell;

/// Maximum numbers of samples, of sub-steps (parts) of the command, and of calls for one input.
const MAX_SAMPLES: usize = 8;
const MAX_SUB_STEPS: u32 = 3;
const MAX_CALLS: usize = 3;

thread_local! {
    /// Simulation in a room with one wall, with which each input begins.
    static OPENING_SIMULATION: LazyCell<MapSqueeze> = LazyCell::new(|| {
        let opening_wall = Segment { from: [0.0, 3.5], to: [2.0, 3.5] };
        let opening_plan = FloorPlan::new(vec![opening_wall], [0.0, 0.0, 4.0, 5.0]).expect("a plan");
        let mut simulation = MapSqueeze::new(limit_settings(Settings::default(), false)).expect("the opening state");
        simulation.set_plan(opening_plan);
        assert!(simulation.is_start_free());
        simulation
    });
}

pub fn check_input(input_bytes: &[u8]) {
    let mut fuzz_input = InputReader(input_bytes);
    let mut simulation = OPENING_SIMULATION.with(|opening_simulation| (**opening_simulation).clone());
    for _ in 0..MAX_CALLS {
        if fuzz_input.is_empty() {
            break;
        }
        call_method(&mut simulation, &mut fuzz_input);
    }
    assert_results(&simulation);
}

/// Returns the settings with few samples, and with a sampler that divides the command into sub-steps only if `allows_sub_steps`.
///
/// Few inputs divide the command, because a robot that cannot move in one of the sub-steps takes 10 000 draws.
fn limit_settings(settings: Settings, allows_sub_steps: bool) -> Settings {
    let limited_part_count = settings.steps.min(MAX_SUB_STEPS);
    let sampler = if allows_sub_steps { settings.sampler.with_part_count(limited_part_count) } else { remove_sub_steps(settings.sampler) };
    Settings { samples: settings.samples.min(MAX_SAMPLES), steps: limited_part_count, sampler, ..settings }
}

fn remove_sub_steps(sampler: Sampler) -> Sampler {
    if let Sampler::SubStepped(_) = sampler { Sampler::WholeArc } else { sampler }
}

fn call_method(simulation: &mut MapSqueeze, fuzz_input: &mut InputReader) {
    match fuzz_input.next_below(10) {
        0 => change_simulation_settings(simulation, fuzz_input),
        1 => assert_same_if_added_in_blocks(simulation, fuzz_input),
        2 => {
            if let Some(floor_plan) = plan::read_floor_plan(fuzz_input) {
                simulation.set_plan(floor_plan);
            }
        }
        3 => {
            if let Some((occupancy_grid, _)) = grid::read_random_grid(fuzz_input) {
                let (wall_count, is_refused) = (simulation.plan().walls().len(), simulation.set_grid(occupancy_grid).is_err());
                assert!(!is_refused || simulation.plan().walls().len() == wall_count);
            }
        }
        4 => {
            let count_before = simulation.attempts().len();
            let count_after = simulation.add_samples(fuzz_input.next_below(MAX_SAMPLES));
            assert!(count_before <= count_after && count_after <= simulation.settings().samples);
        }
        5 => {
            simulation.configure_first(*simulation.settings(), 0).expect("allowed");
            assert!(simulation.attempts().is_empty());
        }
        6 => assert_picture(simulation, fuzz_input),
        7 => {
            let search_point = [0; 2].map(|_| fuzz_input.next_number());
            let search_radius = fuzz_input.draw_number_within(0.0..=f64::INFINITY);
            let nearest_index = simulation.find_nearest(search_point, search_radius);
            assert!(nearest_index.is_none_or(|attempt_index| attempt_index < simulation.attempts().len()));
        }
        // Few inputs test the search for a free pose. It tries 72 headings, and takes as long as ten other calls.
        8 => assert_equals_new_simulation(simulation),
        _ if fuzz_input.next_below(64) == 1 => assert_free_pose(simulation),
        _ => {}
    }
}

fn change_simulation_settings(simulation: &mut MapSqueeze, fuzz_input: &mut InputReader) {
    let settings = change_settings(simulation.settings(), fuzz_input);
    let settings_before = *simulation.settings();
    if are_settings_allowed(&settings) {
        let should_divide_command = fuzz_input.next_below(16) == 1;
        simulation.configure(limit_settings(settings, should_divide_command)).expect("allowed");
        return;
    }
    let attempts_before = simulation.attempts().to_vec();
    assert!(simulation.configure(settings).is_err());
    assert_eq!(*simulation.settings(), settings_before);
    assert_eq!(simulation.attempts(), attempts_before);
}

/// Asserts that attempts that are added in several blocks equal attempts that are added in one call.
fn assert_same_if_added_in_blocks(simulation: &mut MapSqueeze, fuzz_input: &mut InputReader) {
    let settings = limit_settings(change_settings(simulation.settings(), fuzz_input), false);
    if !are_settings_allowed(&settings) {
        return;
    }
    let mut simulation_in_one_call = simulation.clone();
    simulation_in_one_call.configure(settings).expect("allowed");
    let block_size = 1 + fuzz_input.next_below(MAX_SAMPLES);
    simulation.configure_first(settings, block_size).expect("allowed");
    while simulation.shown_count() < settings.samples && !simulation.stats().gave_up {
        simulation.add_samples(block_size);
    }
    assert_eq!(simulation.attempts(), simulation_in_one_call.attempts());
}

/// Asserts that a simulation depends on its settings and its map only, and not on earlier calls.
fn assert_equals_new_simulation(simulation: &MapSqueeze) {
    let mut new_simulation = MapSqueeze::with_shown_count(*simulation.settings(), 0).expect("allowed");
    new_simulation.set_plan(simulation.plan().clone());
    new_simulation.add_samples(simulation.attempts().len());
    assert_eq!(new_simulation.attempts(), simulation.attempts());
}

/// Asserts that the robot fits at the free pose that the simulation finds.
fn assert_free_pose(simulation: &MapSqueeze) {
    let Some(free_pose) = simulation.plan().find_free_pose(simulation.settings().clearance) else { return };
    assertions::assert_pose("a free pose", &free_pose);
    let does_robot_fit = simulation.plan().test_point([free_pose.x(), free_pose.y()], simulation.settings().clearance).is_free;
    assert!(does_robot_fit, "{free_pose:?}");
}

/// Asserts that all results are finite and consistent.
fn assert_results(simulation: &MapSqueeze) {
    let (settings, stats, shown_attempts) = (simulation.settings(), simulation.stats(), simulation.attempts());
    assert_eq!(stats.attempts, shown_attempts.len());
    assert!(shown_attempts.len() <= settings.samples);
    assert_eq!(stats.accepted, shown_attempts.iter().filter(|attempt| attempt.accepted).count());
    let through_wall_count = shown_attempts.iter().filter(|attempt| attempt.accepted && !attempt.path_free).count();
    assert_eq!(stats.through_wall, through_wall_count);
    assertions::assert_fraction("acceptance", stats.acceptance_rate);
    assertions::assert_fraction("through a wall", stats.through_wall_rate);
    let [interval_low, interval_high] = stats.through_wall_interval;
    assert!(0.0 <= interval_low && interval_low <= interval_high && interval_high <= 1.0, "{stats:?}");
    if stats.accepted > 0 {
        assert!((interval_low..=interval_high).contains(&stats.through_wall_rate), "{stats:?}");
        assert!(stats.draws_per_accepted >= 1.0 && stats.draws_per_accepted.is_finite(), "{stats:?}");
    }
    for (attempt_index, attempt) in shown_attempts.iter().enumerate() {
        assertions::assert_pose("an attempt", &attempt.pose);
        assert!(attempt.end_free || !attempt.path_free, "{attempt:?}");
        let should_be_accepted = match settings.sampler {
            _ if !settings.conditioned => true,
            Sampler::Endpoint => attempt.end_free,
            Sampler::WholeArc => attempt.path_free,
            Sampler::SubStepped(_) => attempt.accepted,
        };
        assert_eq!(attempt.accepted, should_be_accepted, "{attempt:?}");
        let arcs = simulation.arcs(attempt_index);
        if attempt.accepted || !settings.conditioned {
            assert_eq!(arcs.len(), settings.part_count() as usize);
        }
        for path_arc in &arcs {
            assertions::assert_finite("arc", &[path_arc.length, path_arc.turn]);
        }
    }
    assert!(simulation.arcs(shown_attempts.len()).is_empty());
    if let Some(path_arc) = simulation.arcs(0).first() {
        assertions::assert_finite("path", path_arc.points().as_flattened());
    }
    assert_finite_plan(simulation.plan());
}

fn assert_finite_plan(floor_plan: &FloorPlan) {
    assertions::assert_finite("bounds", &floor_plan.bounds());
    for wall in floor_plan.walls() {
        assertions::assert_finite("wall", &[wall.from, wall.to].concat());
    }
}

fn assert_picture(simulation: &mut MapSqueeze, fuzz_input: &mut InputReader) {
    let view_grid = banana::read_view_grid(fuzz_input);
    let shown_count = simulation.attempts().len();
    let pixels = simulation.paint_picture(&view_grid, &[[[1; 4]; RAMP_STEP_COUNT]; OUTCOME_KIND_COUNT]);
    assert_eq!(pixels.len(), view_grid.column_count * view_grid.row_count);
    assert!(pixels.iter().filter(|pixel| pixel[3] > 0).count() <= shown_count);
}
