//! The simulation of the Banana Machine: common random numbers, settings and results.

use crate::common::{MAX_STANDARD_ERRORS, NOISE_KINDS, max_difference, seeded_rng, settings_of_preset};
use motion::geom::lanes::MAX_SIN_COS_ERROR;
use motion::geom::se2::SE2;
use motion::sim::banana::{ADDITIVE_NOISE_STD, BananaMachine, ModelKind, Sample, Settings, command_drawn_at};
use motion::stats::ExponentialMoments;
use motion::{
    ConfiguredOdometry, MotionModel, OdomAlphas, OdomDelta, OdometryModel, VelocityAlphas, VelocityCmd,
    VelocityModel,
};
use nalgebra::{Matrix3, Vector3};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::PI;

const GENTLE_COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };

pub fn new_simulation(settings: Settings) -> BananaMachine {
    BananaMachine::new(settings).expect("a valid setting")
}

fn poses_of(simulation: &BananaMachine) -> Vec<SE2> {
    simulation.poses().collect()
}

fn settings_of_both_models() -> [Settings; 2] {
    [settings_of_preset("gentle"), Settings { model: ModelKind::Odometry, ..settings_of_preset("gentle") }]
}

/// Runs a check for clouds of each model and noise, with the given command and with others: forward, reverse, nearly on the spot, straight.
pub fn check_in_varied_clouds(
    command: [f64; 3],
    sample_counts: &[usize],
    mut check_simulation: impl FnMut(&BananaMachine, &str),
) {
    for settings in settings_of_both_models() {
        for noise in NOISE_KINDS {
            for [v, omega, duration] in
                [[1.0, 0.5, 1.0], [-1.0, 1.2, 1.4], [0.06, -1.5, 1.0], [2.0, 0.0, 2.0], command]
            {
                for &sample_count in sample_counts {
                    let command = VelocityCmd { v, omega, dt: duration };
                    let odometry_alphas = [0.02, 0.01, 0.02, 0.01];
                    let settings =
                        Settings { noise, command, odometry_alphas, samples: sample_count, ..settings };
                    check_simulation(&new_simulation(settings), &format!("{settings:?}"));
                }
            }
        }
    }
}

fn format_results(simulation: &BananaMachine) -> String {
    format!(
        "{:?} {:?} {:?} {:?}",
        simulation.settings(),
        poses_of(simulation),
        simulation.stats(),
        simulation.contours()
    )
}

/// Accuracy of a pose after a metre or two, whose coordinates are products with a sine or cosine.
const POSE_TOLERANCE: f64 = 4.0 * MAX_SIN_COS_ERROR;

#[test]
fn the_cloud_equals_samples_of_the_model() {
    let origin_pose = SE2::identity();
    let reverse_command = VelocityCmd { v: -1.0, omega: 0.5, dt: 1.0 };
    for (noise, command) in NOISE_KINDS
        .into_iter()
        .flat_map(|noise| [GENTLE_COMMAND, reverse_command].map(|command| (noise, command)))
    {
        let settings = Settings { noise, command, samples: 500, seed: 2005, ..settings_of_preset("gentle") };
        let assert_same_poses =
            |settings: Settings, sample_pose: &mut dyn FnMut(&mut Xoshiro256PlusPlus) -> SE2| {
                let mut rng = seeded_rng(2005);
                for pose in new_simulation(settings).poses() {
                    assert!(max_difference(&pose, &sample_pose(&mut rng)) < POSE_TOLERANCE, "{settings:?}");
                }
            };
        let model = VelocityModel { alphas: VelocityAlphas(settings.velocity_alphas), noise };
        assert_same_poses(settings, &mut |rng| model.sample(&command, &origin_pose, rng));
        let odometry_settings = Settings { model: ModelKind::Odometry, ..settings };
        let model = OdometryModel { alphas: OdomAlphas(settings.odometry_alphas), noise };
        let commanded_end = origin_pose.boxplus(Vector3::new(command.v, 0.0, command.omega));
        let odometry_reading = OdomDelta::from_poses(&origin_pose, &commanded_end);
        assert_same_poses(odometry_settings, &mut |rng| model.sample(&odometry_reading, &origin_pose, rng));
        let reverse_aware_settings = Settings { reverse_aware: true, ..odometry_settings };
        assert_same_poses(reverse_aware_settings, &mut |rng| {
            ConfiguredOdometry { model, reverse_aware: true }.sample(&odometry_reading, &origin_pose, rng)
        });
    }
}

#[test]
fn changed_settings_move_the_same_robots() {
    let first_settings = Settings { samples: 300, ..settings_of_preset("gentle") };
    let mut simulation = new_simulation(first_settings);
    let unit_noises_of = |simulation: &BananaMachine| -> Vec<[f64; 3]> {
        let settings = simulation.settings();
        let model = VelocityModel { alphas: VelocityAlphas(settings.velocity_alphas), noise: settings.noise };
        let [v_std, omega_std, gamma_std] =
            model.variances(&settings.command).map(|noise_variance| noise_variance.0.sqrt());
        (0..300)
            .map(|i| {
                let inspected_sample = simulation.inspect(i).unwrap();
                [
                    (inspected_sample.v_hat - settings.command.v) / v_std,
                    (inspected_sample.omega_hat - settings.command.omega) / omega_std,
                    inspected_sample.gamma_hat / gamma_std,
                ]
            })
            .collect()
    };
    let initial_noises = unit_noises_of(&simulation);
    let command = VelocityCmd { v: -0.6, omega: 1.1, dt: 0.7 };
    for settings in [
        Settings { velocity_alphas: [0.01, 0.2, 0.03, 0.04, 0.3, 0.2], ..first_settings },
        Settings { command, ..first_settings },
    ] {
        simulation.configure(settings).unwrap();
        for (a, b) in unit_noises_of(&simulation).iter().zip(&initial_noises) {
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9), "{a:?} was {b:?}");
        }
    }
    simulation.configure(first_settings).unwrap();
    assert_eq!(unit_noises_of(&simulation), initial_noises, "and back again to the bit");
    simulation.configure(Settings { seed: 8, ..first_settings }).unwrap();
    assert!(
        unit_noises_of(&simulation).iter().zip(&initial_noises).all(|(a, b)| a != b),
        "a new seed changes it"
    );
}

/// If a command turns by more than half a circle, its samples still form one cloud in exponential coordinates, around the twist τ.
#[test]
fn long_turns_stay_on_the_branch_of_the_command() {
    for omega in [3.1, -4.5, 5.0] {
        let command = VelocityCmd { v: 1.0, omega, dt: 1.0 };
        let velocity_alphas = [0.01, 0.0, 0.0, 0.001, 0.0, 0.0];
        let simulation = new_simulation(Settings {
            command,
            velocity_alphas,
            samples: 20_000,
            ..settings_of_preset("gentle")
        });
        let ExponentialMoments { mean, cov } = simulation.stats().exponential;
        let turn_variance = 0.001 * omega * omega;
        assert!((mean.x - 1.0).abs() < MAX_STANDARD_ERRORS * 0.1 / 20_000f64.sqrt(), "{omega}: {mean}");
        assert!(
            (mean.z - omega).abs() < MAX_STANDARD_ERRORS * (turn_variance / 20_000.0).sqrt(),
            "{omega}: {mean}"
        );
        assert!(
            (cov[(2, 2)] / turn_variance - 1.0).abs() < MAX_STANDARD_ERRORS * (2.0f64 / 20_000.0).sqrt(),
            "{omega}: {cov}"
        );
        for (pose, twist) in simulation.poses().zip(simulation.twists()) {
            assert!((twist.z - omega).abs() <= PI);
            assert!(max_difference(&SE2::exp(&twist), &pose) < 1e-12);
        }
    }
}

#[test]
fn isolating_an_alpha_sets_the_others_to_zero() {
    let straight_settings = Settings {
        command: settings_of_preset::<Settings>("straight").command,
        samples: 1000,
        ..settings_of_preset("gentle")
    };
    let commanded_end = SE2::new(2.0, 0.0, 0.0);
    let simulate_isolated =
        |isolated_alpha| new_simulation(Settings { isolate: Some(isolated_alpha), ..straight_settings });
    for alpha_number in [4, 6] {
        let simulation = simulate_isolated(alpha_number);
        assert!(
            simulation.poses().all(|pose| pose == commanded_end),
            "α₄ and α₆ are silent where nothing is turned"
        );
        assert!(simulation.stats().cross_track_skew.is_nan());
        assert_eq!(simulation.stats().cartesian.cov, Matrix3::zeros(), "no spread is exactly none");
    }
    assert!(
        simulate_isolated(1).poses().all(|pose| (pose.y(), pose.theta()) == (0.0, 0.0)),
        "α₁ turns nobody"
    );
    assert!(
        simulate_isolated(3).poses().all(|pose| (pose.log().x - 2.0).abs() < 1e-14),
        "α₃ fans arcs of one length"
    );
    assert!(simulate_isolated(5).poses().all(|pose| (pose.x(), pose.y()) == (2.0, 0.0)), "α₅ moves nothing");
    assert!(simulate_isolated(5).poses().any(|pose| pose.theta().abs() > 0.1), "and turns");
    let mut reconfigured_simulation = simulate_isolated(3);
    assert_eq!(
        reconfigured_simulation.settings().velocity_alphas,
        straight_settings.velocity_alphas,
        "the sliders stay where they are"
    );
    reconfigured_simulation.configure(straight_settings).unwrap();
    assert_eq!(format_results(&reconfigured_simulation), format_results(&new_simulation(straight_settings)));
}

#[test]
fn the_reaching_command_ends_at_the_target() {
    for (x, y) in [(1.0, 0.2), (1.0, -2.0), (-1.0, 0.3), (-0.5, -0.5), (2.0, 0.0), (-2.0, 0.0), (0.0, 1.0)] {
        for (omega, duration) in [(0.3, 0.5), (-0.2, 2.0), (2.0, 3.0), (-1.5, 2.5)] {
            let command = command_drawn_at([x, y], &VelocityCmd { v: 1.0, omega, dt: duration }, 0.0);
            let settings = Settings { command, ..settings_of_preset("gentle") };
            let end_pose = new_simulation(settings).linearized_moments().mean;
            let end_position = SE2::new(end_pose.x, end_pose.y, 0.0);
            // The rounding of the end pose is proportional to the length |v|Δt of the arc.
            let rounding_tolerance = 1e-14 * (1.0 + (command.v * duration).abs());
            assert!(
                max_difference(&end_position, &SE2::new(x, y, 0.0)) < rounding_tolerance,
                "({x}, {y}): {end_pose}"
            );
            // The turns of arcs to the same end differ by full circles. The nearest turn is therefore within π. A straight line has no
            // alternative.
            assert!(((command.omega - omega) * duration).abs() <= PI + 1e-14 || command.omega == 0.0);
        }
    }
    let current_command = VelocityCmd { v: 1.0, omega: 1.2, dt: 3.0 };
    assert_eq!(
        command_drawn_at([0.0; 2], &current_command, 0.0),
        VelocityCmd { v: 0.0, omega: 0.0, dt: 3.0 }
    );
}

#[test]
fn exponential_statistics_are_undefined_near_a_full_turn() {
    let simulate_turn = |omega: f64| {
        let command = VelocityCmd { v: 1.0, omega, dt: 3.0 };
        new_simulation(Settings {
            command,
            velocity_alphas: [0.01; 6],
            samples: 500,
            ..settings_of_preset("gentle")
        })
    };
    // The turn 3ω has the standard deviation 3·√(0.02·(1 + ω²)): 2.7 ± 0.6 rad is far from a full circle, 6 ± 0.9 rad is near it.
    for (omega, is_defined) in [(0.9, true), (2.0, false), (-2.0, false)] {
        let simulation = simulate_turn(omega);
        assert_eq!(simulation.is_exponential_defined(), is_defined, "ω = {omega}");
        let (cloud_stats, cloud_contours) = (simulation.stats(), simulation.contours());
        let exponential_values =
            [cloud_stats.gaussian_skew, cloud_stats.coverage.exponential, cloud_stats.exponential.mean.x];
        assert!(
            exponential_values.iter().all(|exponential_value| exponential_value.is_nan() != is_defined),
            "ω = {omega}: {cloud_stats:?}"
        );
        assert_eq!(cloud_contours.exponential.is_empty(), !is_defined);
        assert_eq!(cloud_contours.twist_ellipse.is_empty(), !is_defined);
        assert!(cloud_stats.cross_track_skew.is_finite() && cloud_stats.coverage.ellipse.is_finite());
        assert_eq!(cloud_contours.ellipse.len(), cloud_contours.linearized.len());
    }
}

#[test]
fn both_views_find_the_nearest_sample() {
    let simulation = new_simulation(Settings { samples: 3000, ..settings_of_preset("gentle") });
    for morph in [0.0, 1.0] {
        let view_points: Vec<[f64; 2]> = simulation
            .poses()
            .zip(simulation.twists())
            .map(|(pose, twist)| if morph == 0.0 { [pose.x(), pose.y()] } else { [twist.x, twist.z] })
            .collect();
        assert_eq!(simulation.find_nearest(morph, view_points[17], [1e-9, 1e-9]), Some(17));
        assert_eq!(simulation.find_nearest(morph, [50.0, 50.0], [1.0, 1.0]), None);
        // The search finds the outermost sample from a position just inside of the search radius, and not from a position just outside.
        let rightmost_index =
            (0..view_points.len()).max_by(|&a, &b| view_points[a][0].total_cmp(&view_points[b][0])).unwrap();
        let position_right_of_rightmost = |target_distance| {
            [view_points[rightmost_index][0] + target_distance, view_points[rightmost_index][1]]
        };
        assert_eq!(
            simulation.find_nearest(morph, position_right_of_rightmost(0.0099), [0.01, 1e-9]),
            Some(rightmost_index)
        );
        assert_eq!(simulation.find_nearest(morph, position_right_of_rightmost(0.0101), [0.01, 1e-9]), None);
    }
}

#[test]
fn the_executed_motion_leads_to_the_pose() {
    for settings in settings_of_both_models() {
        let simulation = new_simulation(Settings { samples: 200, ..settings });
        for ((i, executed_motion), pose) in simulation.executed_motions().enumerate().zip(simulation.poses())
        {
            let Sample { v_hat, omega_hat, gamma_hat, legs, .. } = simulation.inspect(i).unwrap();
            let executed_pose = match legs {
                None => {
                    assert_eq!(executed_motion, [v_hat, omega_hat, gamma_hat]);
                    let duration = settings.command.dt;
                    let executed_pose = SE2::exp(&Vector3::new(v_hat * duration, 0.0, omega_hat * duration));
                    executed_pose * SE2::new(0.0, 0.0, gamma_hat * duration)
                }
                Some(legs) => {
                    assert_eq!(executed_motion, [legs.rot1, legs.trans, legs.rot2]);
                    legs.apply(&SE2::identity())
                }
            };
            assert!(max_difference(&executed_pose, &pose) < 1e-12);
        }
    }
}

#[test]
fn a_reverse_aware_robot_has_no_noise_of_half_turns() {
    let command = VelocityCmd { v: -1.0, ..GENTLE_COMMAND };
    let odometry_settings =
        Settings { model: ModelKind::Odometry, command, samples: 10, ..settings_of_preset("gentle") };
    let aware_and_unaware_simulations =
        [false, true].map(|reverse_aware| new_simulation(Settings { reverse_aware, ..odometry_settings }));
    let [alpha1, alpha2, ..] = odometry_settings.odometry_alphas;
    let odometry_reading = aware_and_unaware_simulations[0].reading();
    // For a reverse command of turn θ, both rotations have the size π − θ/2 without `reverse_aware`, and θ/2 with it.
    let possible_rotations = [odometry_reading.rot1.abs(), PI - odometry_reading.rot1.abs()];
    for (simulation, expected_rotation) in aware_and_unaware_simulations.iter().zip(possible_rotations) {
        let heading_variance = 2.0
            * (alpha1 * expected_rotation * expected_rotation
                + alpha2 * odometry_reading.trans * odometry_reading.trans);
        assert!((simulation.exact_moments().cov[(2, 2)] / heading_variance - 1.0).abs() < 1e-12);
        assert!((simulation.linearized_moments().cov[(2, 2)] / heading_variance - 1.0).abs() < 1e-12);
    }
}

/// The outline of additive noise is a circle, equally large for a short and a long drive. The circle fits the cloud of the preset "gentle".
#[test]
fn additive_noise_does_not_depend_on_the_motion() {
    for [v, omega, duration] in [[0.05, 0.0, 1.0], [1.0, 0.5, 1.0], [1.0, 0.5, 10.0]] {
        let command = VelocityCmd { v, omega, dt: duration };
        let simulation = new_simulation(Settings { command, samples: 10, ..settings_of_preset("gentle") });
        let commanded_end = simulation.linearized_moments().mean;
        for [x, y] in simulation.contours().additive {
            let circle_radius = libm::hypot(x - commanded_end.x, y - commanded_end.y);
            assert!((circle_radius - 2.0 * ADDITIVE_NOISE_STD).abs() < 1e-12);
        }
    }
    let cov = new_simulation(Settings { samples: 10, ..settings_of_preset("gentle") }).exact_moments().cov;
    let rounded_position_std = (10.0 * (0.5 * (cov[(0, 0)] + cov[(1, 1)])).sqrt()).round() / 10.0;
    assert_eq!(rounded_position_std, ADDITIVE_NOISE_STD);
}

/// The default seed is chosen so that each displayed statistic differs from its exact value by less than a fifth of a standard error.
#[test]
fn statistics_of_the_initial_cloud_are_close_to_the_exact_values() {
    let simulation = new_simulation(Settings::default());
    let (cloud_stats, exact_column) = (simulation.stats(), simulation.table().exact);
    assert!(
        (cloud_stats.cross_track_skew - exact_column.cross_track_skew).abs()
            < 0.2 * cloud_stats.cross_track_skew_error
    );
    assert!((cloud_stats.area_ratio - exact_column.area_ratio).abs() < 0.2 * cloud_stats.area_ratio_error);
    assert!(
        (cloud_stats.likelihood_gain.pose - exact_column.likelihood_gain.pose).abs()
            < 0.2 * cloud_stats.likelihood_gain_error.pose
    );
}
