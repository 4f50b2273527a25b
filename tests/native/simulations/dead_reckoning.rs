//! The simulation of Dead Reckoning. Rollouts are compared with poses of the models, and statistics with simple sums.

use crate::common::{seeded_rng, settings_of_preset};
use motion::geom::se2::SE2;
use motion::models::PolarMotion;
use motion::sim::dead_reckoning::{DeadReckoning, NoisePer, RECURSIONS, Settings};
use motion::{Compounding, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel};
use nalgebra::{Matrix3, Vector3};

/// Returns a simulation. If the selected step is beyond the end of the path, the last step is selected instead.
pub fn new_simulation(settings: Settings) -> DeadReckoning {
    let selected_step = settings.step.min(settings.steps);
    DeadReckoning::new(Settings { step: selected_step, ..settings }).expect("valid settings")
}

fn robot_settings(robot_count: usize) -> Settings {
    Settings { samples: robot_count, ..Settings::default() }
}

/// Returns settings where approximations fail, such as sharp turns, reverse, large noise, and headings beyond half a turn.
fn list_challenging_settings() -> Vec<Settings> {
    let settings_with_command = |v: f64, omega: f64, dt: f64, alphas| Settings {
        command: VelocityCmd { v, omega, dt },
        alphas,
        steps: 12,
        ..robot_settings(700)
    };
    let default_alphas = Settings::default().alphas;
    vec![
        robot_settings(700),
        settings_with_command(-1.0, 0.5, 0.2, default_alphas),
        settings_with_command(1.0, -2.0, 1.0, default_alphas),
        settings_with_command(1.0, 0.0, 0.5, default_alphas),
        settings_with_command(0.0, 1.5, 0.4, default_alphas),
        settings_with_command(0.3, 7.0, 1.0, [0.1; 6]),
        settings_with_command(1.0, 0.5, 0.2, [0.0; 6]),
        settings_with_command(1.0, 0.5, 0.2, [0.5, 0.1, 20.0, 4.0, 3.0, 1.0]),
        Settings { per: NoisePer::Path, ..robot_settings(700) },
    ]
}

/// Asserts that two poses are equal up to rounding, which is proportional to `path_scale`.
fn assert_same_pose([x, y, theta]: [f64; 3], expected_pose: &SE2, path_scale: f64) {
    let pose_difference = SE2::new(x, y, theta).boxminus(expected_pose);
    assert!(
        pose_difference.amax() < 1e-13 * path_scale,
        "({x}, {y}, {theta}), not {expected_pose:?}: {pose_difference}"
    );
}

#[test]
fn lanes_agree_with_poses_composed_one_by_one() {
    use motion::noise::draw_centred_uniform;
    for settings in list_challenging_settings() {
        let simulation = new_simulation(settings);
        let (u, velocity_model) = (settings.command, settings.model());
        // Robot 513 is the second robot of the third block of 256. Each block has its own stream of random numbers.
        let mut block_rng = seeded_rng(settings.seed);
        block_rng.jump();
        block_rng.jump();
        let mut composed_pose = SE2::identity();
        let rollout_poses = simulation.rollout(513).expect("a robot");
        let mut path_size = 1.0;
        for rollout_pose in rollout_poses {
            let uniform_draws: Vec<[f64; 3]> =
                (0..256).map(|_| std::array::from_fn(|_| draw_centred_uniform(&mut block_rng))).collect();
            let unit_noise = uniform_draws[1].map(|q| NoiseKind::Normal.quantile(q));
            let previous_pose = composed_pose;
            composed_pose = velocity_model.apply_noise(&u, &composed_pose, unit_noise);
            path_size += (composed_pose.x() - previous_pose.x()).hypot(composed_pose.y() - previous_pose.y())
                + (u.omega * u.dt).abs();
            let turn_noise = velocity_model.variances(&u)[1].0.sqrt() * u.dt * unit_noise[1].abs();
            assert_same_pose(rollout_pose, &composed_pose, path_size * (1.0 + turn_noise) * 4.0);
        }
    }
}

#[test]
fn moments_are_those_of_the_cloud() {
    for (i, settings) in list_challenging_settings().into_iter().enumerate() {
        let simulation = new_simulation(settings);
        let n = settings.samples as f64;
        let rollout_paths: Vec<_> = (0..settings.samples)
            .map(|robot_index| simulation.rollout(robot_index).expect("a robot"))
            .collect();
        for k in [0, settings.steps as usize / 2, settings.steps as usize - 1] {
            let nominal_pose = simulation.nominal_poses()[k];
            let twists: Vec<Vector3<f64>> = rollout_paths
                .iter()
                .map(|path| SE2::new(path[k][0], path[k][1], path[k][2]).boxminus(&nominal_pose))
                .collect();
            let expected_mean = twists.iter().sum::<Vector3<f64>>() / n;
            let expected_cov = twists
                .iter()
                .map(|twist| (twist - expected_mean) * (twist - expected_mean).transpose())
                .sum::<Matrix3<f64>>()
                / (n - 1.0);
            let measured_moments = simulation.measured_moments()[k];
            let tolerance = 1e-11 * (1.0 + expected_cov.amax());
            assert!(
                (measured_moments.mean - expected_mean).amax() < tolerance,
                "{i}, {k}: {} {expected_mean}",
                measured_moments.mean
            );
            assert!(
                (measured_moments.cov - expected_cov).amax() < tolerance,
                "{i}, {k}: {} {expected_cov}",
                measured_moments.cov
            );
            for axis in 0..3 {
                let moment_of = |p: i32| {
                    twists.iter().map(|twist| (twist[axis] - expected_mean[axis]).powi(p)).sum::<f64>() / n
                };
                let expected_std_error = ((moment_of(4) / moment_of(2).powi(2) - 1.0) / n).sqrt();
                let relative_std_error = measured_moments.relative_error[axis];
                if moment_of(2) > 1e-20 {
                    assert!(
                        (relative_std_error / expected_std_error - 1.0).abs() < 1e-6,
                        "{i}, {k}, {axis}: {relative_std_error}, not {expected_std_error}"
                    );
                }
            }
        }
    }
}

/// A ratio is the predicted variance divided by the measured variance. A step is a miss if the ratio is not in 1 ± 5 %. Steps are
/// counted from 1.
#[test]
fn ratios_and_misses_are_counted() {
    let simulation = new_simulation(Settings::default());
    for compounding in RECURSIONS {
        let variance_comparison = simulation.comparison(compounding);
        for (axis, axis_misses) in variance_comparison.misses.iter().enumerate() {
            let expected_ratios: Vec<f64> = (0..20)
                .map(|k| {
                    let predicted_cov =
                        simulation.predicted_covariances(compounding)[k].expect("a covariance");
                    predicted_cov[(axis, axis)] / simulation.measured_moments()[k].cov[(axis, axis)]
                })
                .collect();
            assert!(
                variance_comparison
                    .ratios
                    .iter()
                    .zip(&expected_ratios)
                    .all(|(ratio_row, axis_ratio)| ratio_row[axis] == *axis_ratio)
            );
            let missed_steps: Vec<u32> =
                (1..=20).filter(|k| (expected_ratios[*k as usize - 1] - 1.0).abs() > 0.05).collect();
            assert!(axis_misses.decidable);
            assert_eq!(
                (axis_misses.first, axis_misses.last),
                (missed_steps.first().copied(), missed_steps.last().copied())
            );
            assert_eq!(axis_misses.end, expected_ratios[19] - 1.0);
        }
    }
}

/// Returns for each component whether there are enough robots to decide at which steps the chapter's recursion is wrong.
fn are_misses_decidable(settings: Settings) -> [bool; 3] {
    new_simulation(settings).comparison(Compounding::Chapter).misses.map(|axis_misses| axis_misses.decidable)
}

/// A step at which the chapter's recursion is wrong is reported only if enough robots measure the variance, and the variance is not 0.
#[test]
fn misses_are_reported_with_enough_robots_only() {
    assert_eq!(are_misses_decidable(Settings::default()), [true; 3]);
    assert_eq!(are_misses_decidable(robot_settings(5000)), [false; 3]);
    assert_eq!(are_misses_decidable(Settings { alphas: [0.0; 6], ..robot_settings(20_000) }), [false; 3]);
    let empty_simulation = DeadReckoning::with_shown_count(Settings::default(), 0).expect("valid settings");
    assert!(
        empty_simulation
            .comparison(Compounding::Chapter)
            .misses
            .iter()
            .all(|axis_misses| !axis_misses.decidable && axis_misses.end.is_nan())
    );
    assert_eq!(empty_simulation.stats().n, 0);
}

#[test]
fn a_zero_variance_has_no_relative_error() {
    let errors_with = |settings| new_simulation(settings).measured_moments()[1].relative_error;
    for sample_count in [1, 2] {
        assert!(
            errors_with(Settings { alphas: [0.0; 6], ..robot_settings(sample_count) })
                .iter()
                .all(|relative_error| relative_error.is_nan())
        );
    }
    assert!(errors_with(robot_settings(1)).iter().all(|relative_error| relative_error.is_nan()));
    // Two robots always have a kurtosis of 1. The formula for large clouds would therefore give an error of 0.
    assert!(errors_with(robot_settings(2)).iter().all(|error| error.is_finite() && *error >= 2f64.sqrt()));
    let command_on_the_spot = VelocityCmd { v: 0.0, omega: 0.5, dt: 0.2 };
    let [along_error, _, heading_error] = errors_with(Settings {
        command: command_on_the_spot,
        alphas: [0.0, 0.0, 0.0, 0.02, 0.0, 0.0],
        ..robot_settings(300)
    })
    .into();
    assert!(along_error.is_nan() && heading_error.is_finite(), "{along_error} {heading_error}");
    // At v = 1e-100 m/s the squares of the variances underflow to 0.
    let slow_drive_settings =
        Settings { command: VelocityCmd { v: 1e-100, omega: 0.0, dt: 0.2 }, ..robot_settings(300) };
    assert_eq!(are_misses_decidable(slow_drive_settings), [false; 3]);
}

/// Fourth-order corrections can produce a matrix that is no covariance. From that step on there is no covariance and no ratio.
#[test]
fn a_fourth_order_without_a_covariance_has_no_ratio() {
    let settings = Settings { alphas: [0.02, 0.02, 60.0, 60.0, 5.0, 5.0], ..robot_settings(1000) };
    let simulation = new_simulation(settings);
    let predicted_covs = simulation.predicted_covariances(Compounding::FourthOrder);
    let first_undefined = predicted_covs.iter().position(Option::is_none).expect("some step without");
    assert!(predicted_covs[first_undefined..].iter().all(Option::is_none));
    assert!(
        simulation.comparison(Compounding::FourthOrder).ratios[first_undefined..]
            .iter()
            .all(|variance_ratio| variance_ratio.x.is_nan())
    );
    assert!(simulation.predicted_covariances(Compounding::FirstOrder).iter().all(Option::is_some));
    let settings =
        Settings { step: first_undefined as u32 + 1, compounding: Compounding::FourthOrder, ..settings };
    let outlines =
        DeadReckoning::new(settings).expect("valid settings").outlines(settings.step).expect("a step");
    assert!(outlines.ellipse.is_empty() && outlines.exponential.is_empty() && outlines.predicted.is_empty());
    assert!(!outlines.measured.is_empty());
}

/// Equal seeds give equal random numbers. A smaller cloud or a shorter path is the first part of a larger cloud or a longer path. A change
/// of the α's only scales the noise.
#[test]
fn a_seed_gives_the_same_draws() {
    let large_simulation = new_simulation(robot_settings(1500));
    let small_simulation = new_simulation(robot_settings(300));
    let short_simulation = new_simulation(Settings { steps: 7, ..robot_settings(300) });
    let noisy_simulation =
        new_simulation(Settings { alphas: [0.08, 0.08, 0.08, 0.08, 0.02, 0.02], ..robot_settings(300) });
    for robot_index in [0, 1, 255, 256, 299] {
        let path = large_simulation.rollout(robot_index).expect("a robot");
        assert_eq!(small_simulation.rollout(robot_index).as_ref(), Some(&path));
        assert_eq!(short_simulation.rollout(robot_index).as_deref(), Some(&path[..7]));
        // With twice the noise, the executed velocities of the first step differ from the command by twice as much.
        let u = Settings::default().command;
        let first_step_noise_of = |path: &[[f64; 3]]| {
            let [x, y, theta] = path[0];
            let executed_arc = motion::invert_arc(&SE2::identity(), &SE2::new(x, y, theta), u.dt);
            Vector3::new(executed_arc.v_hat - u.v, executed_arc.omega_hat - u.omega, executed_arc.gamma_hat)
        };
        let double_noise = first_step_noise_of(&noisy_simulation.rollout(robot_index).expect("a robot"));
        assert!((double_noise - first_step_noise_of(&path) * 2.0).amax() < 1e-12, "{double_noise}");
    }
    assert_ne!(
        large_simulation.rollout(0),
        new_simulation(Settings { seed: 4, ..robot_settings(300) }).rollout(0)
    );
    assert_eq!(large_simulation.rollout(1500), None);
}

#[test]
fn noise_of_the_whole_path_is_divided_among_its_steps() {
    let command_of_path = VelocityCmd { v: 1.0, omega: 0.5, dt: 4.0 };
    let expected_variances =
        VelocityModel { alphas: VelocityAlphas(Settings::default().alphas), noise: NoiseKind::Normal }
            .variances(&command_of_path)
            .map(|variance| variance.0 * command_of_path.dt * command_of_path.dt);
    for step_count in [1, 20, 200] {
        let command = VelocityCmd { dt: command_of_path.dt / f64::from(step_count), ..command_of_path };
        let settings =
            Settings { command, steps: step_count, step: 1, per: NoisePer::Path, ..robot_settings(1) };
        let step_variances =
            settings.model().variances(&command).map(|variance| variance.0 * command.dt * command.dt);
        for i in 0..3 {
            assert!(
                (step_variances[i] * f64::from(step_count) / expected_variances[i] - 1.0).abs() < 1e-12,
                "{step_count}, {i}"
            );
        }
        let covariance = new_simulation(settings).predicted_covariances(Compounding::FirstOrder)
            [step_count as usize - 1]
            .expect("a covariance");
        assert!((covariance[(2, 2)] / (expected_variances[1] + expected_variances[2]) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn the_level_of_heading_noise_is_that_of_four_alphas() {
    assert_eq!(Settings::default().heading_noise(), Some(0.02));
    assert_eq!(
        Settings { alphas: settings_of_preset::<Settings>("doubled").alphas, ..robot_settings(1) }
            .heading_noise(),
        Some(0.08)
    );
    assert_eq!(
        Settings { alphas: [0.02, 0.02, 0.02, 0.02, 0.005, 0.0], ..robot_settings(1) }.heading_noise(),
        None
    );
}

#[test]
fn outlines_are_two_standard_deviations_from_the_commanded_pose() {
    let settings = Settings { step: 20, compounding: Compounding::FirstOrder, ..robot_settings(300) };
    let simulation = new_simulation(settings);
    let covariance = simulation.predicted_covariances(Compounding::FirstOrder)[19].expect("a covariance");
    let nominal_pose = simulation.nominal_poses()[19];
    let outlines = simulation.outlines(20).expect("a step");
    assert_eq!([simulation.outlines(0), simulation.outlines(21)], [None, None]);
    let inverse_cov = covariance.fixed_view::<2, 2>(0, 0).into_owned().try_inverse().expect("full rank");
    let relative_positions = outlines.ellipse.iter().map(|[x, y]| {
        let relative_pose = nominal_pose.inverse() * SE2::new(*x, *y, 0.0);
        [relative_pose.x(), relative_pose.y()]
    });
    for outline_position in relative_positions.chain(outlines.predicted).map(nalgebra::Vector2::from) {
        assert!((outline_position.dot(&(inverse_cov * outline_position)) - 4.0).abs() < 1e-9);
    }
    // In the first step the predicted lateral variance is 0, so that the outline is a line.
    let outlines_after_first_step =
        DeadReckoning::new(robot_settings(300)).expect("valid settings").outlines(1).expect("a step");
    assert!(outlines_after_first_step.predicted.iter().all(|[_, lateral_offset]| *lateral_offset == 0.0));
}

#[test]
fn milestones_are_the_quarters_of_the_path_but_not_the_selected_step() {
    let milestone_steps_of = |step_count: u32, step: u32| {
        let simulation = new_simulation(Settings { steps: step_count, step, ..robot_settings(20) });
        let step_of = |poses: &[[f64; 3]]| (1..=step_count).find(|step| simulation.poses(*step) == poses);
        simulation.milestones().iter().map(|milestone| step_of(&milestone.poses)).collect::<Vec<_>>()
    };
    assert_eq!(milestone_steps_of(20, 20), [5, 10, 15].map(Some));
    assert_eq!(milestone_steps_of(20, 5), [10, 15, 20].map(Some));
    assert_eq!(milestone_steps_of(2, 1), [Some(2)]);
}

#[test]
fn the_commanded_path_leads_through_its_poses() {
    for settings in list_challenging_settings() {
        let simulation = new_simulation(settings);
        let path = simulation.commanded_path();
        let chords_per_step = (path.len() - 1) / settings.steps as usize;
        assert_eq!((path.len() - 1) % settings.steps as usize, 0);
        let twist = TangentNoiseModel::twist(&settings.command);
        let mut pose = SE2::identity();
        for k in 1..=settings.steps as usize {
            pose = pose.boxplus(twist);
            let nominal_pose = simulation.nominal_poses()[k - 1];
            assert!(nominal_pose.boxminus(&pose).amax() < 1e-11, "{nominal_pose:?}, not {pose:?}");
            assert_eq!(path[k * chords_per_step], [nominal_pose.x(), nominal_pose.y()]);
        }
    }
}

/// At the crossing time the variances along and across a straight drive are equal (exercise 2). The formula is compared with a bisection of
/// the exact variances at small noise.
#[test]
fn variances_of_a_straight_drive_cross_where_the_formula_says() {
    for (v, [along_alpha, turn_alpha]) in [(1.0, [1e-6, 1e-6]), (-0.5, [2e-6, 1e-6]), (1.4, [1e-6, 7e-6])] {
        let command = VelocityCmd { v, omega: 0.3, dt: 0.2 };
        let alphas = [along_alpha, 1e-6, turn_alpha, 1e-6, 0.0, 0.0];
        let simulation = new_simulation(Settings { command, alphas, ..robot_settings(1) });
        let straight_growth = simulation.straight_growth();
        let crossing_time = straight_growth.crossing.expect("a crossing");
        let velocity_model = VelocityModel { alphas: VelocityAlphas(alphas), noise: NoiseKind::Normal };
        let exact_variance_ratio_at = |dt: f64| {
            let position_cov = motion::stats::ExactMoments::new(&PolarMotion::of_velocity(
                &velocity_model,
                &VelocityCmd { v, omega: 0.0, dt },
            ))
            .cov;
            position_cov[(1, 1)] / position_cov[(0, 0)]
        };
        let (mut low, mut high) = (1e-3, 1e3);
        for _ in 0..100 {
            let middle_time = f64::sqrt(low * high);
            if exact_variance_ratio_at(middle_time) < 1.0 { low = middle_time } else { high = middle_time }
        }
        // The formula of exercise 2 is exact to first order in the noise. Its relative error is a few times the variances, 1e-6.
        assert!((crossing_time / low - 1.0).abs() < 1e-4, "{crossing_time}, found {low}");
        // Exact variances equal first-order variances while headings are small, here for three seconds.
        for (first_order_cov, exact_variances) in [
            (&straight_growth.along_first_order, &straight_growth.along),
            (&straight_growth.across_first_order, &straight_growth.across),
        ] {
            for ((first_order_variance, exact_variance), dt) in
                first_order_cov.iter().zip(exact_variances).zip(&straight_growth.durations)
            {
                assert!(
                    *dt > 3.0 || (exact_variance / first_order_variance - 1.0).abs() < 2e-3,
                    "{exact_variance} {first_order_variance}"
                );
            }
        }
    }
    let crossing_time_of_simulation = |v, alphas| {
        let command = VelocityCmd { v, ..Settings::default().command };
        new_simulation(Settings { command, alphas, ..robot_settings(1) }).straight_growth().crossing
    };
    for (v, alphas) in [(0.0, [0.02; 6]), (1.0, [0.0; 6]), (1.0, [0.02, 0.0, 0.0, 0.0, 0.0, 0.0])] {
        assert_eq!(crossing_time_of_simulation(v, alphas), None, "{v} {alphas:?}");
    }
}
