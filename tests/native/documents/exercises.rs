//! Numbers of doc/exercises.md, compared with computed ones; those of exercises 2 and 7 are in `dead_reckoning.rs`.

use super::exercises_document;
use crate::common::text::Number;
use crate::common::{derivative, preset, seeded, unit_cdf};
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

fn velocity_model(alphas: [f64; 6]) -> VelocityModel {
    VelocityModel { alphas: VelocityAlphas(alphas), noise: NoiseKind::Normal }
}

/// Returns the root mean square error (m) of the arc form over all headings, at v = 1 m/s. For small turns the exact
/// end is computed by its series.
fn error_of_arc_form(omega: f64, dt: f64) -> f64 {
    let (radius, phi) = (1.0 / omega, omega * dt);
    let (forward, left) = (dt * (1.0 - phi * phi / 6.0), dt * phi * (0.5 - phi * phi / 24.0));
    let headings = 1001;
    let squared_errors = (0..headings).map(|i| {
        let theta = 2.0 * PI * f64::from(i) / f64::from(headings) - PI;
        let (sin, cos) = theta.sin_cos();
        let (x, y) = (forward * cos - left * sin, forward * sin + left * cos);
        let next = theta + phi;
        (radius * next.sin() - radius * sin - x).powi(2) + (radius * cos - radius * next.cos() - y).powi(2)
    });
    (squared_errors.sum::<f64>() / f64::from(headings)).sqrt()
}

#[test]
fn exercise_1_prints_the_errors_of_the_straight_line_branch() {
    let dt = 0.1;
    let line_error = |omega: f64| 0.5 * omega * dt * dt;
    // The error varies strongly with ω. Its mean over a tenth of a decade is compared.
    let ratio = |omega: f64| {
        let turn_rates = (0..20).map(|i| omega * 10f64.powf(f64::from(i) / 200.0 - 0.05));
        (turn_rates.map(|omega| (error_of_arc_form(omega, dt) / line_error(omega)).ln()).sum::<f64>() / 20.0)
            .exp()
    };
    let crossover =
        (0..400).map(|i| 1e-9 * 10f64.powf(f64::from(i) / 100.0)).find(|omega| ratio(*omega) < 1.0);
    let [crossover_printed, estimate_printed]: [Number; 2] =
        exercises_document().numbers("below |ω̂| = # × 10⁻⁷ rad/s, where the estimate √(2ε)/Δt says # × 10⁻⁷");
    crossover_printed.assert(crossover.expect("a crossover") / 1e-7, 0.0);
    estimate_printed.assert((2.0 * f64::EPSILON).sqrt() / dt / 1e-7, 0.0);
    let [line_printed, arc_printed, ratio_printed]: [Number; 3] = exercises_document().numbers(
        "the straight line is off by # nm, and the arc form by # nm. Switching so early costs # times",
    );
    let (line_error, arc_error) = (line_error(1e-6), error_of_arc_form(1e-6, dt));
    line_printed.assert(line_error / 1e-9, 0.0);
    arc_printed.assert(arc_error / 1e-9, 0.0);
    ratio_printed.assert(line_error / arc_error, 0.0);
    exercises_document().assert_says("up to half a micrometre where Δt is a second");
    let end = Arc { start: SE2::identity(), length: 1.0, turn: 1e-6 }.end();
    assert!(((end.x() - 1.0).hypot(end.y()) - 0.5e-6).abs() < 1e-12, "{end:?}");
}

/// The determinant is computed by central differences, with an error of the square of the step.
#[test]
fn exercise_3_prints_the_jacobian_determinant() {
    let model = velocity_model([0.02, 0.02, 0.02, 0.02, 0.01, 0.01]);
    let x = SE2::identity();
    let end = x.boxplus(TangentNoiseModel::twist(&U));
    let [printed]: [Number; 1] =
        exercises_document().numbers("At the noise-free end of the worked example's command it is #, and");
    let deviations = model.variances(&U).map(|variance| variance.0.sqrt());
    let noise_jacobian = derivative([0.0; 3], |unit| model.apply_noise(&U, &x, unit));
    let determinant = noise_jacobian.determinant() / deviations.iter().product::<f64>();
    printed.assert(determinant, 0.0);
    let ratio = model.prob(&end, &U, &x) / model.pose_density(&end, &U, &x).expect("noise of full rank");
    assert!((ratio / determinant - 1.0).abs() < 1e-8, "{ratio} {determinant}");

    let odometry = OdometryModel { alphas: OdomAlphas([0.02; 4]), noise: NoiseKind::Normal };
    let u = OdomDelta { rot1: 0.3, trans: 0.8, rot2: 0.2 };
    let density = odometry.pose_density(&u.apply(&x), &u, &x).expect("noise of full rank");
    let factors: f64 =
        odometry.variances(&u).map(|variance| NoiseKind::Normal.prob(0.0, variance)).iter().product();
    assert!((density / factors * u.trans - 1.0).abs() < 1e-12);
}

#[test]
fn exercise_4_prints_the_effect_of_each_alpha() {
    let exact_and_is_point = |index: usize, command: VelocityCmd| {
        let mut alphas = [0.0; 6];
        alphas[index] = 0.09;
        let settings = Settings { command, velocity_alphas: alphas, samples: 1000, ..preset("straight") };
        let simulation = BananaMachine::new(settings).expect("valid settings");
        let end = simulation.poses().next();
        (simulation.table().exact, simulation.poses().all(|pose| Some(pose) == end))
    };
    let straight_command = preset("straight").command;
    assert_eq!(straight_command.omega, 0.0);
    assert!([3, 5].iter().all(|i| exact_and_is_point(*i, straight_command).1));
    let turning_command = VelocityCmd { omega: 0.5, ..straight_command };
    let [alpha, variance, skew]: [Number; 3] = [
        "Δt = 2 s as they are, with # for the one and 0",
        "headings spread with a variance of # rad²",
        "its curve has a cross-track skew of #, which",
    ]
    .map(|sentence| exercises_document().numbers::<1>(sentence)[0]);
    assert_eq!(alpha.value, 0.09);
    let [with_alpha4, with_alpha6] = [3, 5].map(|index| exact_and_is_point(index, turning_command).0);
    variance.assert(with_alpha4.cov[(2, 2)], 0.0);
    variance.assert(with_alpha6.cov[(2, 2)], 0.0);
    skew.assert(with_alpha4.cross_track_skew, 0.0);
    assert_eq!(with_alpha6.cov.fixed_rows::<2>(0).amax(), 0.0);
}

/// Equal seeds give equal motions, so that the fractions equal those of the table to a digit.
#[test]
fn exercise_5_prints_the_fractions_through_walls() {
    let settings = |n: f64, omega: f64, sampler: Sampler| {
        let command = VelocityCmd { omega, ..squeeze::Settings::default().command };
        let alphas = alphas_of_noise_level(n);
        squeeze::Settings {
            command,
            alphas,
            sampler,
            steps: sampler.parts(),
            samples: 20_000,
            ..Default::default()
        }
    };
    let stats = |settings| MapSqueeze::new(settings).expect("valid settings").stats();
    for n in ["0.02", "0.05", "0.12", "0.4"] {
        let printed: [Number; 5] = exercises_document().numbers(&format!("| {n} | # | # | # | # | # |"));
        for (printed, omega) in printed.into_iter().zip([0.0, 0.2, 0.4, 0.6, 0.8]) {
            let settings = settings(n.parse().expect("a number"), omega, Sampler::Endpoint);
            printed.assert_percent(stats(settings).through_wall_rate, 0.0);
        }
    }
    exercises_document().assert_says("Noise alone, up to 0.4, never gets it to 40 %.");
    for i in [8, 24, 40, 56, 80] {
        let stats = stats(settings(0.005 * f64::from(i), 0.0, Sampler::Endpoint));
        assert!(stats.through_wall_rate < 0.4, "{i}: {}", stats.through_wall_rate);
    }
    let [arc_cost_printed, quarters_printed, share_printed, eighths_printed]: [Number; 4] = [
        "Judging the whole arc costs # draws",
        "a quarter of the time cost # draws",
        "draws, and # % still go through one",
        "eight cost # draws",
    ]
    .map(|sentence| exercises_document().numbers::<1>(sentence)[0]);
    let stats_of = |sampler| stats(settings(0.12, 0.6, sampler));
    let whole_arc = stats_of(Sampler::WholeArc);
    arc_cost_printed.assert(whole_arc.draws_per_accepted, 0.0);
    assert_eq!(whole_arc.through_wall, 0);
    let [quarters, eighths] = [4, 8].map(|parts| stats_of(Sampler::SubStepped(parts)));
    quarters_printed.assert(quarters.draws_per_accepted, 0.0);
    share_printed.assert_percent(quarters.through_wall_rate, 0.0);
    eighths_printed.assert(eighths.draws_per_accepted, 0.0);
    let [draws_per_second]: [Number; 1] = exercises_document().numbers("at 20 Hz that is # draws a second");
    // Printed in thousands.
    assert!((draws_per_second.value - 2000.0 * 20.0 * whole_arc.draws_per_accepted).abs() <= 500.0);
}

#[test]
fn exercise_6_prints_the_skew_of_the_triangular_sampler() {
    let b2 = Variance(0.025);
    let [limit, tail_printed]: [Number; 2] =
        exercises_document().numbers("√6·b is # rad for the heading, beyond which # % of normal draws are");
    limit.assert((6.0 * b2.0).sqrt(), 0.0);
    let poses = |noise| {
        let model = VelocityModel { alphas: VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]), noise };
        let mut rng = seeded(7);
        (0..200_000).map(move |_| model.sample(&U, &SE2::identity(), &mut rng))
    };
    tail_printed.assert_percent(2.0 * unit_cdf(NoiseKind::Normal, -6f64.sqrt()), 0.0);
    assert!(
        poses(NoiseKind::Triangular).all(|pose| (pose.theta() - 0.5).abs() <= limit.value + limit.rounding)
    );
    let printed: [Number; 2] =
        exercises_document().numbers("the skew is # with normal noise and # with triangular noise");
    for (printed, noise) in printed.into_iter().zip([NoiseKind::Normal, NoiseKind::Triangular]) {
        let simulation =
            BananaMachine::new(Settings { noise, samples: 10, ..preset("worked") }).expect("valid settings");
        printed.assert(simulation.table().exact.cross_track_skew, 0.0);
    }
}
