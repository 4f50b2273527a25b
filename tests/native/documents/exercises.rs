//! Comparison of the numbers in doc/exercises.md with computed numbers. Exercises 2 and 7 are in `dead_reckoning.rs`.

use super::read_exercises;
use crate::common::text::PrintedNumber;
use crate::common::{derivative_by_noise, seeded_rng, settings_of_preset, unit_cdf};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::map::Sampler;
use motion::sim::banana::{BananaMachine, Settings};
use motion::sim::squeeze::{self, MapSqueeze, alphas_of_noise_level};
use motion::{
    MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, RotTransRot, TangentNoiseModel, Variance,
    VelocityAlphas, VelocityCmd, VelocityModel,
};
use std::f64::consts::PI;

const U: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };

fn new_velocity_model(alphas: [f64; 6]) -> VelocityModel {
    VelocityModel { alphas: VelocityAlphas(alphas), noise: NoiseKind::Normal }
}

/// Returns the root mean square error (m) of the arc form of the velocity model over all headings, at v = 1 m/s. The exact end is computed
/// by a series for small turns.
fn rms_error_of_arc_form(omega: f64, dt: f64) -> f64 {
    let (arc_radius, arc_turn) = (1.0 / omega, omega * dt);
    let (forward_distance, left_offset) =
        (dt * (1.0 - arc_turn * arc_turn / 6.0), dt * arc_turn * (0.5 - arc_turn * arc_turn / 24.0));
    let heading_count = 1001;
    let squared_errors = (0..heading_count).map(|i| {
        let theta = 2.0 * PI * f64::from(i) / f64::from(heading_count) - PI;
        let (sin, cos) = theta.sin_cos();
        let (x, y) = (forward_distance * cos - left_offset * sin, forward_distance * sin + left_offset * cos);
        let end_heading = theta + arc_turn;
        (arc_radius * end_heading.sin() - arc_radius * sin - x).powi(2)
            + (arc_radius * cos - arc_radius * end_heading.cos() - y).powi(2)
    });
    (squared_errors.sum::<f64>() / f64::from(heading_count)).sqrt()
}

#[test]
fn exercise_1_prints_the_errors_of_the_straight_line_branch() {
    let dt = 0.1;
    let expected_line_error_at = |omega: f64| 0.5 * omega * dt * dt;
    // The error of the arc form varies strongly with ω. Its geometric mean over a tenth of a decade is therefore compared.
    let line_to_arc_error_ratio = |omega: f64| {
        let turn_rates = (0..20).map(|i| omega * 10f64.powf(f64::from(i) / 200.0 - 0.05));
        (turn_rates
            .map(|omega| (rms_error_of_arc_form(omega, dt) / expected_line_error_at(omega)).ln())
            .sum::<f64>()
            / 20.0)
            .exp()
    };
    let crossover_turn_rate = (0..400)
        .map(|i| 1e-9 * 10f64.powf(f64::from(i) / 100.0))
        .find(|omega| line_to_arc_error_ratio(*omega) < 1.0);
    let [printed_crossover, printed_estimate]: [PrintedNumber; 2] = read_exercises()
        .sentence_numbers("below |ω̂| = # × 10⁻⁷ rad/s, where the estimate √(2ε)/Δt says # × 10⁻⁷");
    printed_crossover.assert_near(crossover_turn_rate.expect("a crossover") / 1e-7, 0.0);
    printed_estimate.assert_near((2.0 * f64::EPSILON).sqrt() / dt / 1e-7, 0.0);
    let [printed_line_error, printed_arc_error, printed_ratio]: [PrintedNumber; 3] = read_exercises()
        .sentence_numbers(
            "the straight line is off by # nm, and the arc form by # nm. Switching so early costs # times",
        );
    let (expected_line_error_at, arc_error) = (expected_line_error_at(1e-6), rms_error_of_arc_form(1e-6, dt));
    printed_line_error.assert_near(expected_line_error_at / 1e-9, 0.0);
    printed_arc_error.assert_near(arc_error / 1e-9, 0.0);
    printed_ratio.assert_near(expected_line_error_at / arc_error, 0.0);
    read_exercises().assert_contains("up to half a micrometre where Δt is a second");
    let arc_end = Arc { start: SE2::identity(), length: 1.0, turn: 1e-6 }.end();
    assert!(((arc_end.x() - 1.0).hypot(arc_end.y()) - 0.5e-6).abs() < 1e-12, "{arc_end:?}");
}

/// The Jacobian determinant is computed by central differences, with an error proportional to the square of the step.
#[test]
fn exercise_3_prints_the_jacobian_determinant() {
    let model = new_velocity_model([0.02, 0.02, 0.02, 0.02, 0.01, 0.01]);
    let x = SE2::identity();
    let noise_free_end = x.boxplus(TangentNoiseModel::twist(&U));
    let [printed_determinant]: [PrintedNumber; 1] = read_exercises()
        .sentence_numbers("At the noise-free end of the worked example's command it is #, and");
    let noise_stds = model.variances(&U).map(|variance| variance.0.sqrt());
    let noise_jacobian = derivative_by_noise([0.0; 3], |unit_noise| model.apply_noise(&U, &x, unit_noise));
    let unit_jacobian_determinant = noise_jacobian.determinant() / noise_stds.iter().product::<f64>();
    printed_determinant.assert_near(unit_jacobian_determinant, 0.0);
    let prob_ratio = model.prob(&noise_free_end, &U, &x)
        / model.pose_density(&noise_free_end, &U, &x).expect("noise of full rank");
    assert!(
        (prob_ratio / unit_jacobian_determinant - 1.0).abs() < 1e-8,
        "{prob_ratio} {unit_jacobian_determinant}"
    );

    let odometry_model = OdometryModel { alphas: OdomAlphas([0.02; 4]), noise: NoiseKind::Normal };
    let u = OdomDelta { rot1: 0.3, trans: 0.8, rot2: 0.2 };
    let pose_density = odometry_model.pose_density(&u.apply(&x), &u, &x).expect("noise of full rank");
    let peak_noise_densities: f64 =
        odometry_model.variances(&u).map(|variance| NoiseKind::Normal.prob(0.0, variance)).iter().product();
    assert!((pose_density / peak_noise_densities * u.trans - 1.0).abs() < 1e-12);
}

#[test]
fn exercise_4_prints_the_effect_of_each_alpha() {
    let exact_column_and_uniqueness = |alpha_index: usize, command: VelocityCmd| {
        let mut alphas = [0.0; 6];
        alphas[alpha_index] = 0.09;
        let settings =
            Settings { command, velocity_alphas: alphas, samples: 1000, ..settings_of_preset("straight") };
        let simulation = BananaMachine::new(settings).expect("valid settings");
        let first_pose = simulation.poses().next();
        (simulation.table().exact, simulation.poses().all(|end_pose| Some(end_pose) == first_pose))
    };
    let Settings { command: straight_command, .. } = settings_of_preset("straight");
    assert_eq!(straight_command.omega, 0.0);
    assert!([3, 5].iter().all(|i| exact_column_and_uniqueness(*i, straight_command).1));
    let turning_command = VelocityCmd { omega: 0.5, ..straight_command };
    let [printed_alpha, printed_variance, printed_skew]: [PrintedNumber; 3] = [
        "Δt = 2 s as they are, with # for the one and 0",
        "headings spread with a variance of # rad²",
        "its curve has a cross-track skew of #, which",
    ]
    .map(|sentence_pattern| read_exercises().sentence_numbers::<1>(sentence_pattern)[0]);
    assert_eq!(printed_alpha.value, 0.09);
    let [exact_with_alpha4, exact_with_alpha6] =
        [3, 5].map(|alpha_index| exact_column_and_uniqueness(alpha_index, turning_command).0);
    printed_variance.assert_near(exact_with_alpha4.cov[(2, 2)], 0.0);
    printed_variance.assert_near(exact_with_alpha6.cov[(2, 2)], 0.0);
    printed_skew.assert_near(exact_with_alpha4.cross_track_skew, 0.0);
    assert_eq!(exact_with_alpha6.cov.fixed_rows::<2>(0).amax(), 0.0);
}

/// Equal seeds give equal motions. The computed fractions therefore equal those of the table in every digit.
#[test]
fn exercise_5_prints_the_fractions_through_walls() {
    let new_settings = |noise_level: f64, omega: f64, map_sampler: Sampler| {
        let command = VelocityCmd { omega, ..squeeze::Settings::default().command };
        let (alphas, substep_count, sample_count) =
            (alphas_of_noise_level(noise_level), map_sampler.part_count(), 20_000);
        squeeze::Settings {
            command,
            alphas,
            sampler: map_sampler,
            steps: substep_count,
            samples: sample_count,
            ..Default::default()
        }
    };
    let squeeze_stats_of = |settings| MapSqueeze::new(settings).expect("valid settings").stats();
    for n in ["0.02", "0.05", "0.12", "0.4"] {
        let printed_numbers: [PrintedNumber; 5] =
            read_exercises().sentence_numbers(&format!("| {n} | # | # | # | # | # |"));
        for (printed_fraction, omega) in printed_numbers.into_iter().zip([0.0, 0.2, 0.4, 0.6, 0.8]) {
            let settings = new_settings(n.parse().expect("a number"), omega, Sampler::Endpoint);
            printed_fraction.assert_percent(squeeze_stats_of(settings).through_wall_rate, 0.0);
        }
    }
    read_exercises().assert_contains("Noise alone, up to 0.4, never gets it to 40 %.");
    for i in [8, 24, 40, 56, 80] {
        let endpoint_stats = squeeze_stats_of(new_settings(0.005 * f64::from(i), 0.0, Sampler::Endpoint));
        assert!(endpoint_stats.through_wall_rate < 0.4, "{i}: {}", endpoint_stats.through_wall_rate);
    }
    let [printed_arc_draws, printed_quarters_draws, printed_quarters_percentage, printed_eighths_draws]: [PrintedNumber; 4] = [
        "Judging the whole arc costs # draws",
        "a quarter of the time cost # draws",
        "draws, and # % still go through one",
        "eight cost # draws",
    ]
    .map(|sentence_pattern| read_exercises().sentence_numbers::<1>(sentence_pattern)[0]);
    let stats_of_sampler = |map_sampler| squeeze_stats_of(new_settings(0.12, 0.6, map_sampler));
    let whole_arc_stats = stats_of_sampler(Sampler::WholeArc);
    printed_arc_draws.assert_near(whole_arc_stats.draws_per_accepted, 0.0);
    assert_eq!(whole_arc_stats.through_wall, 0);
    let [quarters_stats, eighths_stats] =
        [4, 8].map(|part_count| stats_of_sampler(Sampler::SubStepped(part_count)));
    printed_quarters_draws.assert_near(quarters_stats.draws_per_accepted, 0.0);
    printed_quarters_percentage.assert_percent(quarters_stats.through_wall_rate, 0.0);
    printed_eighths_draws.assert_near(eighths_stats.draws_per_accepted, 0.0);
    let [draws_per_second]: [PrintedNumber; 1] =
        read_exercises().sentence_numbers("at 20 Hz that is # draws a second");
    assert!((draws_per_second.value - 2000.0 * 20.0 * whole_arc_stats.draws_per_accepted).abs() <= 500.0);
}

#[test]
fn exercise_6_prints_the_skew_of_the_triangular_sampler() {
    let heading_variance = Variance(0.025);
    let [printed_limit, printed_tail]: [PrintedNumber; 2] = read_exercises()
        .sentence_numbers("√6·b is # rad for the heading, beyond which # % of normal draws are");
    printed_limit.assert_near((6.0 * heading_variance.0).sqrt(), 0.0);
    let iter_poses = |noise| {
        let model = VelocityModel { alphas: VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]), noise };
        let mut rng = seeded_rng(7);
        (0..200_000).map(move |_| model.sample(&U, &SE2::identity(), &mut rng))
    };
    printed_tail.assert_percent(2.0 * unit_cdf(NoiseKind::Normal, -6f64.sqrt()), 0.0);
    assert!(
        iter_poses(NoiseKind::Triangular)
            .all(|end_pose| (end_pose.theta() - 0.5).abs()
                <= printed_limit.value + printed_limit.rounding_error)
    );
    let printed_skews: [PrintedNumber; 2] =
        read_exercises().sentence_numbers("the skew is # with normal noise and # with triangular noise");
    for (printed_skew, noise) in printed_skews.into_iter().zip([NoiseKind::Normal, NoiseKind::Triangular]) {
        let simulation = BananaMachine::new(Settings { noise, samples: 10, ..settings_of_preset("worked") })
            .expect("valid settings");
        printed_skew.assert_near(simulation.table().exact.cross_track_skew, 0.0);
    }
}
