//! The simulation of Map Squeeze: common random numbers, the limit of random draws, and counts of attempts with their confidence intervals.

use crate::common::seeded_rng;
use crate::map::conditioned::{SAMPLERS, STRAIGHT_COMMAND, new_too_small_room};
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, MAX_DRAWS, MapConditioned, Sampler};
use motion::sim::settings::SettingRules;
use motion::sim::squeeze::{MapSqueeze, Settings, wilson_interval};
use motion::{NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};

fn new_simulation(settings: Settings) -> MapSqueeze {
    MapSqueeze::new(settings).expect("a valid setting")
}

fn attempt_poses(simulation: &MapSqueeze) -> Vec<SE2> {
    simulation.attempts().iter().map(|attempt| attempt.pose).collect()
}

fn format_results(simulation: &MapSqueeze) -> String {
    let (settings, stats) = (simulation.settings(), simulation.stats());
    format!(
        "{settings:?} {:?} {stats:?} {} {:?}",
        simulation.attempts(),
        simulation.stats().gave_up,
        simulation.plan().walls()
    )
}

/// The sampler, the conditioning and the map decide which attempts are accepted. They do not change the random numbers.
#[test]
fn changed_samplers_and_maps_move_no_sample() {
    let settings = Settings { samples: 3000, ..Settings::default() };
    let mut simulation = new_simulation(settings);
    let (results_before, poses_before) = (format_results(&simulation), attempt_poses(&simulation));
    let attempt_verdicts = |simulation: &MapSqueeze| -> Vec<[bool; 2]> {
        simulation.attempts().iter().map(|attempt| [attempt.end_free, attempt.path_free]).collect()
    };
    let verdicts_before = attempt_verdicts(&simulation);
    assert!(simulation.attempts().iter().all(|attempt| attempt.accepted == attempt.end_free));
    simulation.configure(Settings { sampler: Sampler::WholeArc, ..settings }).expect("valid");
    assert!(simulation.attempts().iter().all(|attempt| attempt.accepted == attempt.path_free));
    assert_eq!(
        (attempt_poses(&simulation), attempt_verdicts(&simulation)),
        (poses_before.clone(), verdicts_before.clone())
    );
    assert_eq!(simulation.stats().through_wall, 0);
    for sampler in [Sampler::Endpoint, Sampler::WholeArc] {
        simulation.configure(Settings { conditioned: false, sampler, ..settings }).expect("valid");
        assert!(
            (attempt_poses(&simulation), attempt_verdicts(&simulation))
                == (poses_before.clone(), verdicts_before.clone()),
            "{sampler:?}"
        );
        assert_eq!(simulation.stats().accepted, 3000, "no attempt is rejected");
        assert_eq!((simulation.stats().drawn, simulation.stats().wall_tests_per_accepted), (3000, 0.0));
    }
    simulation.set_plan(new_too_small_room());
    assert_eq!(attempt_poses(&simulation), poses_before);
    assert_eq!(simulation.stats().through_wall, 3000);
    simulation.set_plan(FloorPlan::apartment());
    simulation.configure(settings).expect("valid");
    assert_eq!(format_results(&simulation), results_before, "and back again to the bit");
    simulation.configure(Settings { seed: 8, ..settings }).expect("valid");
    assert!(
        attempt_poses(&simulation).iter().zip(&poses_before).all(|(a, b)| a != b),
        "a new seed changes it"
    );
}

/// A rejected part of a motion is drawn again, which moves the parts after it. Without a rejection, conditioning moves no sample.
#[test]
fn only_rejected_parts_move_samples() {
    let settings = Settings { sampler: Sampler::SubStepped(4), samples: 500, ..Settings::default() };
    let mut simulation = new_simulation(settings);
    simulation.set_plan(FloorPlan::new(Vec::new(), [-50.0, -50.0, 50.0, 50.0]).expect("an open field"));
    let poses_in_open_field = attempt_poses(&simulation);
    simulation.configure(Settings { conditioned: false, ..settings }).expect("valid");
    assert!(attempt_poses(&simulation) == poses_in_open_field);
    simulation.set_plan(FloorPlan::apartment());
    assert!(attempt_poses(&simulation) == poses_in_open_field, "without conditioning walls have no effect");
    let stats = simulation.stats();
    assert_eq!((stats.accepted, stats.drawn, stats.wall_tests_per_accepted), (500, 2000, 0.0));
    simulation.configure(settings).expect("valid");
    let moved_count =
        attempt_poses(&simulation).iter().zip(&poses_in_open_field).filter(|(a, b)| a != b).count();
    let rejected_count = simulation.stats().drawn - 2000;
    assert!(
        moved_count > 0 && moved_count <= rejected_count,
        "{moved_count} moved by {rejected_count} rejections"
    );
}

#[test]
fn the_arcs_of_an_attempt_end_at_its_pose() {
    for sampler in SAMPLERS {
        let simulation = new_simulation(Settings { sampler, samples: 2000, ..Settings::default() });
        let (stats, shown_attempts) = (simulation.stats(), simulation.attempts());
        let part_count = if let Sampler::SubStepped(part_count) = sampler { part_count } else { 1 };
        assert!(stats.drawn >= shown_attempts.len() * part_count as usize);
        let acceptance_rate = stats.acceptance_rate;
        assert!(
            (acceptance_rate - (stats.accepted * part_count as usize) as f64 / stats.drawn as f64).abs()
                < 1e-15
        );
        assert!(
            stats.wall_tests_per_accepted > 0.0 && acceptance_rate > 0.4 && acceptance_rate < 1.0,
            "{stats:?}"
        );
        for (attempt_index, attempt) in shown_attempts.iter().enumerate().step_by(17) {
            let attempt_arcs = simulation.arcs(attempt_index);
            assert_eq!(attempt_arcs.len(), part_count as usize);
            let arc_end = attempt_arcs[attempt_arcs.len() - 1].end();
            assert!((arc_end.x() - attempt.pose.x()).abs() + (arc_end.y() - attempt.pose.y()).abs() < 1e-12);
            let is_path_free =
                attempt_arcs.iter().all(|attempt_arc| simulation.plan().test_arc(attempt_arc, 0.13).is_free);
            assert_eq!(attempt.path_free, is_path_free);
            let are_joined = attempt_arcs.windows(2).all(|arc_pair| {
                let first_end = arc_pair[0].end();
                (first_end.x(), first_end.y()) == (arc_pair[1].start.x(), arc_pair[1].start.y())
            });
            assert!(are_joined && (attempt_arcs[0].start.x(), attempt_arcs[0].start.y()) == (2.05, 2.6));
        }
    }
}

#[test]
fn the_first_contact_is_at_the_first_wall_on_the_path() {
    let command = VelocityCmd { v: 4.0, omega: 0.0, dt: 1.0 };
    let alphas = [0.0; 6];
    let mut simulation =
        new_simulation(Settings { command, alphas, start: [1.0, 0.5, 0.0], ..Settings::default() });
    assert_eq!(simulation.first_contact(usize::MAX), None);
    let walls = [[3.0, 0.0, 3.0, 1.5], [4.0, 0.0, 4.0, 1.5]];
    let to_segment = |[x0, y0, x1, y1]: [f64; 4]| Segment { from: [x0, y0], to: [x1, y1] };
    simulation.set_plan(FloorPlan::new(walls.map(to_segment).to_vec(), [0.0, 0.0, 6.0, 4.0]).expect("valid"));
    assert_eq!(simulation.first_contact(0), Some([3.0, 0.5]));
}

#[test]
fn the_commanded_arc_and_the_test_of_its_start_follow_the_settings() {
    let command = VelocityCmd { v: -0.5, omega: 0.8, dt: 1.5 };
    let mut simulation = new_simulation(Settings { command, ..Settings::default() });
    let attempt_arc = simulation.commanded_arc();
    assert_eq!((attempt_arc.start.x(), attempt_arc.start.y(), attempt_arc.length), (2.05, 2.6, -0.75));
    assert!((attempt_arc.turn - 1.2).abs() < 1e-15);
    // The doorposts are 1.2 m ahead and 0.45 m to either side: √(1.2² + 0.45²) = 1.2816 m away.
    assert!(simulation.is_start_free());
    for (robot_radius, is_start_free) in [(1.282, false), (1.281, true)] {
        simulation.configure(Settings { clearance: robot_radius, ..Settings::default() }).expect("valid");
        assert_eq!(simulation.is_start_free(), is_start_free, "{robot_radius}");
    }
    simulation.set_plan(new_too_small_room());
    assert!(!simulation.is_start_free());
}

#[test]
fn the_product_of_samples_and_parts_is_limited() {
    for (sampler, max_samples) in [(Sampler::WholeArc, 1_000_000), (Sampler::SubStepped(4), 250_000)] {
        let refused_field_of = |samples| {
            Settings { samples, sampler, ..Settings::default() }.check().err().map(|refusal| refusal.key)
        };
        assert_eq!(
            [refused_field_of(max_samples), refused_field_of(max_samples + 1)],
            [None, Some("samples".to_owned())]
        );
    }
}

#[test]
fn the_simulation_stops_after_a_bounded_number_of_draws() {
    let settings =
        Settings { start: [2.1, 2.1, 0.0], sampler: Sampler::SubStepped(4), ..Settings::default() };
    let mut simulation = new_simulation(settings);
    assert!(!simulation.stats().gave_up);
    simulation.set_plan(new_too_small_room());
    assert!(simulation.stats().gave_up);
    let stats = simulation.stats();
    assert_eq!((stats.accepted, stats.through_wall), (0, 0));
    assert!((MAX_DRAWS..=3 * MAX_DRAWS).contains(&stats.drawn), "{stats:?}");
    let attempt_count = simulation.attempts().len();
    assert!((1..10).contains(&attempt_count));
    assert!(simulation.attempts().iter().all(|a| !(a.accepted || a.end_free || a.path_free)));
    assert_eq!(simulation.add_samples(100), attempt_count, "it stops for good");
    assert_eq!(simulation.stats().drawn, stats.drawn);
    simulation.configure(Settings { sampler: Sampler::Endpoint, ..settings }).expect("valid");
    assert!(!simulation.stats().gave_up);
    assert_eq!((simulation.attempts().len(), simulation.stats().accepted), (600, 0));
    assert_eq!(simulation.stats().acceptance_rate, 0.0);
    assert!(simulation.stats().through_wall_rate.is_nan());
    assert_eq!(simulation.stats().through_wall_interval, [0.0, 1.0], "nothing is known");
    for sampler in SAMPLERS {
        assert_eq!(simulation.sampling_trial(sampler, 10).expect_err("no room").0.draws, MAX_DRAWS);
    }
    simulation.configure(settings).expect("valid");
    assert!(simulation.stats().gave_up);
    simulation.set_plan(FloorPlan::apartment());
    assert!(!simulation.stats().gave_up);
    assert_eq!((simulation.attempts().len(), simulation.stats().accepted), (600, 600));
}

#[test]
fn a_trial_motion_reports_its_cost_and_changes_nothing() {
    let settings = Settings::default();
    let simulation = new_simulation(settings);
    let velocity_model = VelocityModel { alphas: VelocityAlphas(settings.alphas), noise: NoiseKind::Normal };
    let [x, y, theta] = settings.start;
    let start_pose = SE2::new(x, y, theta);
    let results_before = format_results(&simulation);
    for sampler in SAMPLERS {
        let trial_cost = simulation.sampling_trial(sampler, 500).expect("it fits");
        let floor_plan = FloorPlan::apartment();
        let conditioned_model =
            MapConditioned { model: velocity_model, plan: &floor_plan, clearance: 0.13, sampler };
        let mut rng = seeded_rng(7);
        let mut expected_cost = (0, 0);
        for _ in 0..500 {
            let accepted_motion =
                conditioned_model.sample(&STRAIGHT_COMMAND, &start_pose, &mut rng).expect("it fits");
            expected_cost = (
                expected_cost.0 + accepted_motion.cost.draws,
                expected_cost.1 + accepted_motion.cost.wall_tests,
            );
        }
        assert_eq!((trial_cost.draws, trial_cost.wall_tests), expected_cost);
    }
    assert_eq!(format_results(&simulation), results_before);
}

/// The expected intervals are from Newcombe, "Two-sided confidence intervals for the single proportion", Statistics in
/// Medicine 17 (1998), table I, method 3.
#[test]
fn the_interval_of_the_fraction_through_walls_is_the_wilson_interval() {
    for (through_wall_count, accepted_count, expected_low, expected_high) in
        [(81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)]
    {
        let through_wall_interval = wilson_interval(through_wall_count, accepted_count);
        assert!(
            (through_wall_interval[0] - expected_low).abs() < 5e-5
                && (through_wall_interval[1] - expected_high).abs() < 5e-5,
            "{through_wall_interval:?}"
        );
        let [rest_lower_bound, rest_upper_bound] =
            wilson_interval(accepted_count - through_wall_count, accepted_count);
        assert!(
            (rest_lower_bound + through_wall_interval[1] - 1.0).abs() < 1e-15
                && (rest_upper_bound + through_wall_interval[0] - 1.0).abs() < 1e-15
        );
    }
}
