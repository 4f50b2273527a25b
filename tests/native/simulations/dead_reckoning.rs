//! The simulation of Dead Reckoning: rollouts are compared with poses of the models, and statistics with simple sums.

use crate::common::seeded_rng;
use motion::geom::se2::SE2;
use motion::sim::dead_reckoning::{DeadReckoning, NoisePer, PRESETS, RECURSIONS, Settings};
use motion::{Compounding, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel};
use nalgebra::{Matrix3, Vector3};

/// Returns a simulation. If the path has fewer steps than the selected one, the last step is selected.
pub fn simulation(settings: Settings) -> DeadReckoning {
    let step = settings.step.min(settings.steps);
    DeadReckoning::new(Settings { step, ..settings }).expect("valid settings")
}

/// Returns the settings with which the widget opens, with fewer robots.
fn settings_with_robots(samples: usize) -> Settings {
    Settings { samples, ..Settings::default() }
}

/// Returns settings where approximations fail: sharp turns, reverse, large noise, headings beyond half a turn.
fn difficult_settings() -> Vec<Settings> {
    let with_command = |v: f64, omega: f64, dt: f64, alphas| Settings {
        command: VelocityCmd { v, omega, dt },
        alphas,
        steps: 12,
        ..settings_with_robots(700)
    };
    let default_alphas = Settings::default().alphas;
    vec![
        settings_with_robots(700),
        with_command(-1.0, 0.5, 0.2, default_alphas),
        with_command(1.0, -2.0, 1.0, default_alphas),
        with_command(1.0, 0.0, 0.5, default_alphas),
        with_command(0.0, 1.5, 0.4, default_alphas),
        with_command(0.3, 7.0, 1.0, [0.1; 6]),
        with_command(1.0, 0.5, 0.2, [0.0; 6]),
        with_command(1.0, 0.5, 0.2, [0.5, 0.1, 20.0, 4.0, 3.0, 1.0]),
        Settings { per: NoisePer::Path, ..settings_with_robots(700) },
    ]
}

/// Asserts that two poses are equal up to rounding at the scale of the path.
fn assert_same([x, y, theta]: [f64; 3], expected: &SE2, scale: f64) {
    let difference = SE2::new(x, y, theta).boxminus(expected);
    assert!(difference.amax() < 1e-13 * scale, "({x}, {y}, {theta}), not {expected:?}: {difference}");
}

/// Paths that are computed in lanes equal poses that are composed one by one, from the same random numbers.
#[test]
fn lanes_agree_with_poses_composed_one_by_one() {
    use motion::noise::centred_uniform;
    for settings in difficult_settings() {
        let simulation = simulation(settings);
        let (u, model) = (settings.command, settings.model());
        // Robot 513 is the second robot of the third block of 256. Each block has its own stream of random numbers.
        let mut block_rng = seeded_rng(settings.seed);
        block_rng.jump();
        block_rng.jump();
        let mut pose = SE2::identity();
        let poses = simulation.rollout(513).expect("a robot");
        let mut path_size = 1.0;
        for rollout_pose in poses {
            let uniforms: Vec<[f64; 3]> =
                (0..256).map(|_| std::array::from_fn(|_| centred_uniform(&mut block_rng))).collect();
            let unit_noise = uniforms[1].map(|q| NoiseKind::Normal.quantile(q));
            let previous = pose;
            pose = model.apply_noise(&u, &pose, unit_noise);
            // The rounding of a path grows with its length and its turn.
            path_size += (pose.x() - previous.x()).hypot(pose.y() - previous.y()) + (u.omega * u.dt).abs();
            let turn = model.variances(&u)[1].0.sqrt() * u.dt * unit_noise[1].abs();
            assert_same(rollout_pose, &pose, path_size * (1.0 + turn) * 4.0);
        }
    }
}

/// The expected means, covariances and relative errors are sums over the paths of all robots.
#[test]
fn moments_are_those_of_the_cloud() {
    for (i, settings) in difficult_settings().into_iter().enumerate() {
        let simulation = simulation(settings);
        let n = settings.samples as f64;
        let paths: Vec<_> =
            (0..settings.samples).map(|index| simulation.rollout(index).expect("a robot")).collect();
        for k in [0, settings.steps as usize / 2, settings.steps as usize - 1] {
            let nominal = simulation.nominal_poses()[k];
            let xi: Vec<Vector3<f64>> = paths
                .iter()
                .map(|path| SE2::new(path[k][0], path[k][1], path[k][2]).boxminus(&nominal))
                .collect();
            let mean = xi.iter().sum::<Vector3<f64>>() / n;
            let cov =
                xi.iter().map(|xi| (xi - mean) * (xi - mean).transpose()).sum::<Matrix3<f64>>() / (n - 1.0);
            let measured = simulation.measured_moments()[k];
            let scale = 1e-11 * (1.0 + cov.amax());
            assert!((measured.mean - mean).amax() < scale, "{i}, {k}: {} {mean}", measured.mean);
            assert!((measured.cov - cov).amax() < scale, "{i}, {k}: {} {cov}", measured.cov);
            for axis in 0..3 {
                let moment = |p: i32| xi.iter().map(|xi| (xi[axis] - mean[axis]).powi(p)).sum::<f64>() / n;
                let expected = ((moment(4) / moment(2).powi(2) - 1.0) / n).sqrt();
                let relative_std_error = measured.relative_error[axis];
                if moment(2) > 1e-20 {
                    assert!(
                        (relative_std_error / expected - 1.0).abs() < 1e-6,
                        "{i}, {k}, {axis}: {relative_std_error}, not {expected}"
                    );
                }
            }
        }
    }
}

/// A ratio is the predicted variance over the measured one. Steps with a miss (a ratio off by more than 5 %) are counted from 1.
#[test]
fn ratios_and_misses_are_counted() {
    let simulation = simulation(Settings::default());
    for order in RECURSIONS {
        let comparison = simulation.comparison(order);
        for (axis, misses) in comparison.misses.iter().enumerate() {
            let ratios: Vec<f64> = (0..20)
                .map(|k| {
                    let predicted = simulation.predicted_covariances(order)[k].expect("a covariance");
                    predicted[(axis, axis)] / simulation.measured_moments()[k].cov[(axis, axis)]
                })
                .collect();
            assert!(comparison.ratios.iter().zip(&ratios).all(|(row, ratio)| row[axis] == *ratio));
            let steps: Vec<u32> = (1..=20).filter(|k| (ratios[*k as usize - 1] - 1.0).abs() > 0.05).collect();
            assert!(misses.decidable);
            assert_eq!((misses.first, misses.last), (steps.first().copied(), steps.last().copied()));
            assert_eq!(misses.end, ratios[19] - 1.0);
        }
    }
}

/// Returns, for each component, whether misses of the chapter's recursion can be established.
fn are_misses_decidable(settings: Settings) -> [bool; 3] {
    simulation(settings).comparison(Compounding::Chapter).misses.map(|misses| misses.decidable)
}

/// Misses of the chapter's recursion are reported only if the robots have a spread and are enough to measure it.
#[test]
fn misses_are_reported_with_enough_robots_only() {
    assert_eq!(are_misses_decidable(Settings::default()), [true; 3]);
    assert_eq!(are_misses_decidable(settings_with_robots(5000)), [false; 3]);
    assert_eq!(
        are_misses_decidable(Settings { alphas: [0.0; 6], ..settings_with_robots(20_000) }),
        [false; 3]
    );
    let empty_simulation = DeadReckoning::with_shown_count(Settings::default(), 0).expect("valid settings");
    assert!(
        empty_simulation
            .comparison(Compounding::Chapter)
            .misses
            .iter()
            .all(|misses| !misses.decidable && misses.end.is_nan())
    );
    assert_eq!(empty_simulation.stats().n, 0);
}

/// A component without variance has no relative error, however small the numbers are.
#[test]
fn a_zero_variance_has_no_relative_error() {
    let errors = |settings| simulation(settings).measured_moments()[1].relative_error;
    for samples in [1, 2] {
        assert!(
            errors(Settings { alphas: [0.0; 6], ..settings_with_robots(samples) })
                .iter()
                .all(|error| error.is_nan())
        );
    }
    assert!(errors(settings_with_robots(1)).iter().all(|error| error.is_nan()));
    // Two robots always have a kurtosis of 1, from which the error would be 0.
    assert!(errors(settings_with_robots(2)).iter().all(|error| error.is_finite() && *error >= 2f64.sqrt()));
    // Robots that only turn have no variance along the track.
    let on_the_spot = VelocityCmd { v: 0.0, omega: 0.5, dt: 0.2 };
    let [along, _, heading] = errors(Settings {
        command: on_the_spot,
        alphas: [0.0, 0.0, 0.0, 0.02, 0.0, 0.0],
        ..settings_with_robots(300)
    })
    .into();
    assert!(along.is_nan() && heading.is_finite(), "{along} {heading}");
    // The squares of such small variances underflow.
    let slow_drive =
        Settings { command: VelocityCmd { v: 1e-100, omega: 0.0, dt: 0.2 }, ..settings_with_robots(300) };
    assert_eq!(are_misses_decidable(slow_drive), [false; 3]);
}

/// Fourth-order corrections can produce a matrix that is no covariance. From that step on there is no covariance and no ratio.
#[test]
fn a_fourth_order_without_a_covariance_has_no_ratio() {
    let settings = Settings { alphas: [0.02, 0.02, 60.0, 60.0, 5.0, 5.0], ..settings_with_robots(1000) };
    let simulation = simulation(settings);
    let covs = simulation.predicted_covariances(Compounding::FourthOrder);
    let end = covs.iter().position(Option::is_none).expect("some step without");
    assert!(covs[end..].iter().all(Option::is_none));
    assert!(
        simulation.comparison(Compounding::FourthOrder).ratios[end..].iter().all(|ratio| ratio.x.is_nan())
    );
    assert!(simulation.predicted_covariances(Compounding::FirstOrder).iter().all(Option::is_some));
    let settings = Settings { step: end as u32 + 1, compounding: Compounding::FourthOrder, ..settings };
    let outlines =
        DeadReckoning::new(settings).expect("valid settings").outlines(settings.step).expect("a step");
    assert!(outlines.ellipse.is_empty() && outlines.exponential.is_empty() && outlines.predicted.is_empty());
    assert!(!outlines.measured.is_empty());
}

/// Equal seeds give equal random numbers. A smaller cloud is the first part of a larger one, and a shorter path that of a longer one.
/// Other α's scale the noise.
#[test]
fn a_seed_gives_the_same_draws() {
    let large_cloud = simulation(settings_with_robots(1500));
    let small_cloud = simulation(settings_with_robots(300));
    let short_path = simulation(Settings { steps: 7, ..settings_with_robots(300) });
    let noisy_cloud =
        simulation(Settings { alphas: [0.08, 0.08, 0.08, 0.08, 0.02, 0.02], ..settings_with_robots(300) });
    for index in [0, 1, 255, 256, 299] {
        let path = large_cloud.rollout(index).expect("a robot");
        assert_eq!(small_cloud.rollout(index).as_ref(), Some(&path));
        assert_eq!(short_path.rollout(index).as_deref(), Some(&path[..7]));
        // With twice the noise, the executed velocities of the first step differ from the command by twice as much.
        let u = Settings::default().command;
        let noise = |path: &[[f64; 3]]| {
            let [x, y, theta] = path[0];
            let inversion = motion::invert_arc(&SE2::identity(), &SE2::new(x, y, theta), u.dt);
            Vector3::new(inversion.v_hat - u.v, inversion.omega_hat - u.omega, inversion.gamma_hat)
        };
        let double_noise = noise(&noisy_cloud.rollout(index).expect("a robot"));
        assert!((double_noise - noise(&path) * 2.0).amax() < 1e-12, "{double_noise}");
    }
    assert_ne!(
        large_cloud.rollout(0),
        simulation(Settings { seed: 4, ..settings_with_robots(300) }).rollout(0)
    );
    assert_eq!(large_cloud.rollout(1500), None);
}

/// Each step has a share of the variance of the whole path. The shares add up to that variance for any number of steps.
#[test]
fn noise_of_the_whole_path_is_divided_among_its_steps() {
    let whole_command = VelocityCmd { v: 1.0, omega: 0.5, dt: 4.0 };
    let expected =
        VelocityModel { alphas: VelocityAlphas(Settings::default().alphas), noise: NoiseKind::Normal }
            .variances(&whole_command)
            .map(|variance| variance.0 * whole_command.dt * whole_command.dt);
    for steps in [1, 20, 200] {
        let command = VelocityCmd { dt: whole_command.dt / f64::from(steps), ..whole_command };
        let settings = Settings { command, steps, step: 1, per: NoisePer::Path, ..settings_with_robots(1) };
        let noise = settings.model().variances(&command).map(|variance| variance.0 * command.dt * command.dt);
        for i in 0..3 {
            assert!((noise[i] * f64::from(steps) / expected[i] - 1.0).abs() < 1e-12, "{steps}, {i}");
        }
        // The heading's variance adds up.
        let covariance = simulation(settings).predicted_covariances(Compounding::FirstOrder)
            [steps as usize - 1]
            .expect("a covariance");
        assert!((covariance[(2, 2)] / (expected[1] + expected[2]) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn the_level_of_heading_noise_is_that_of_four_alphas() {
    assert_eq!(Settings::default().heading_noise(), Some(0.02));
    assert_eq!(Settings { alphas: PRESETS[1].alphas, ..settings_with_robots(1) }.heading_noise(), Some(0.08));
    assert_eq!(
        Settings { alphas: [0.02, 0.02, 0.02, 0.02, 0.005, 0.0], ..settings_with_robots(1) }.heading_noise(),
        None
    );
}

/// Points of the outlines of both Gaussians are two standard deviations from the commanded pose.
#[test]
fn outlines_are_two_standard_deviations_from_the_commanded_pose() {
    let settings = Settings { step: 20, compounding: Compounding::FirstOrder, ..settings_with_robots(300) };
    let simulation = simulation(settings);
    let covariance = simulation.predicted_covariances(Compounding::FirstOrder)[19].expect("a covariance");
    let nominal = simulation.nominal_poses()[19];
    let outlines = simulation.outlines(20).expect("a step");
    assert_eq!([simulation.outlines(0), simulation.outlines(21)], [None, None]);
    let information = covariance.fixed_view::<2, 2>(0, 0).into_owned().try_inverse().expect("full rank");
    for [x, y] in &outlines.ellipse {
        let relative_pose = nominal.inverse() * SE2::new(*x, *y, 0.0);
        let position = nalgebra::Vector2::new(relative_pose.x(), relative_pose.y());
        assert!(((position.transpose() * information * position)[0] - 4.0).abs() < 1e-9);
    }
    for [a, l] in &outlines.predicted {
        let position = nalgebra::Vector2::new(*a, *l);
        assert!(((position.transpose() * information * position)[0] - 4.0).abs() < 1e-9);
    }
    // In the first step the lateral variance is 0. The predicted outline is a line.
    let first =
        DeadReckoning::new(settings_with_robots(300)).expect("valid settings").outlines(1).expect("a step");
    assert!(first.predicted.iter().all(|[_, lateral]| *lateral == 0.0));
}

#[test]
fn the_commanded_path_leads_through_its_poses() {
    for settings in difficult_settings() {
        let simulation = simulation(settings);
        let path = simulation.commanded_path();
        let chords_per_step = (path.len() - 1) / settings.steps as usize;
        assert_eq!((path.len() - 1) % settings.steps as usize, 0);
        let twist = TangentNoiseModel::twist(&settings.command);
        let mut pose = SE2::identity();
        for k in 1..=settings.steps as usize {
            pose = pose.boxplus(twist);
            let nominal = simulation.nominal_poses()[k - 1];
            assert!(nominal.boxminus(&pose).amax() < 1e-11, "{nominal:?}, not {pose:?}");
            assert_eq!(path[k * chords_per_step], [nominal.x(), nominal.y()]);
        }
    }
}

/// Duration at which the variances along and across a straight drive are equal (exercise 2). At small noise the formula is compared with
/// bisection of the exact variances.
#[test]
fn variances_of_a_straight_drive_cross_where_the_formula_says() {
    for (v, [along, turn]) in [(1.0, [1e-6, 1e-6]), (-0.5, [2e-6, 1e-6]), (1.4, [1e-6, 7e-6])] {
        let command = VelocityCmd { v, omega: 0.3, dt: 0.2 };
        let alphas = [along, 1e-6, turn, 1e-6, 0.0, 0.0];
        let simulation = simulation(Settings { command, alphas, ..settings_with_robots(1) });
        let growth = simulation.straight_growth();
        let crossing = growth.crossing.expect("a crossing");
        let model = VelocityModel { alphas: VelocityAlphas(alphas), noise: NoiseKind::Normal };
        let exact_ratio = |dt: f64| {
            let cov =
                motion::stats::ExactMoments::of_velocity(&model, &VelocityCmd { v, omega: 0.0, dt }).cov;
            cov[(1, 1)] / cov[(0, 0)]
        };
        let (mut low, mut high) = (1e-3, 1e3);
        for _ in 0..100 {
            let middle = f64::sqrt(low * high);
            if exact_ratio(middle) < 1.0 { low = middle } else { high = middle }
        }
        // The formula is exact to first order in the noise. Its relative error is a few times the variances, 1e-6.
        assert!((crossing / low - 1.0).abs() < 1e-4, "{crossing}, found {low}");
        // Exact variances equal the first-order ones while headings are small: for three seconds they stay within 0.01 rad.
        for (first_order, exact_values) in
            [(&growth.along_first_order, &growth.along), (&growth.across_first_order, &growth.across)]
        {
            for ((line, exact), dt) in first_order.iter().zip(exact_values).zip(&growth.durations) {
                assert!(*dt > 3.0 || (exact / line - 1.0).abs() < 2e-3, "{exact} {line}");
            }
        }
    }
    let crossing_time_of = |v, alphas| {
        let command = VelocityCmd { v, ..Settings::default().command };
        simulation(Settings { command, alphas, ..settings_with_robots(1) }).straight_growth().crossing
    };
    for (v, alphas) in [(0.0, [0.02; 6]), (1.0, [0.0; 6]), (1.0, [0.02, 0.0, 0.0, 0.0, 0.0, 0.0])] {
        assert_eq!(crossing_time_of(v, alphas), None, "{v} {alphas:?}");
    }
}
