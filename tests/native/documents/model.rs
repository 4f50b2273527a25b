//! The figures of doc/model.md on the Banana Machine, computed: they are read from there.

use crate::common::told::{Number, Told};
use crate::common::{SIGMAS, mean, preset, variance, winds_around};
use motion::geom::se2::SE2;
use motion::sim::banana::{BananaMachine, ModelKind, Settings};
use motion::stats::{ExponentialMoments, cross_track_skew, predicted_cross_track_skew};
use nalgebra::Vector2;

fn machine(settings: Settings) -> BananaMachine {
    BananaMachine::new(settings).expect("a valid setting")
}

fn document() -> Told {
    Told::in_document(include_str!("../../../doc/model.md"))
}

#[test]
fn the_presets_are_those_of_the_table() {
    for (name, label) in
        [("straight", "Straight"), ("gentle", "Gentle arc"), ("hard", "Hard arc"), ("pivot", "Pivot")]
    {
        let told: [Number; 3] = document().numbers(&format!("| {label} | #, #, # | |"));
        let command = preset(name).command;
        assert_eq!(told.map(|number| number.value), [command.v, command.omega, command.dt], "{name}");
    }
    for (name, label) in [("banana", "Banana"), ("worked", "Worked example")] {
        let told: [Number; 9] = document().numbers(&format!("| {label} | #, #, # | #, #, #, #, #, # |"));
        let Settings { command: c, velocity_alphas: [a1, a2, a3, a4, a5, a6], .. } = preset(name);
        assert_eq!(told.map(|number| number.value), [c.v, c.omega, c.dt, a1, a2, a3, a4, a5, a6], "{name}");
    }
}

/// Shares to 4.5 standard errors of a million robots.
#[test]
fn the_gains_are_those_of_the_table() {
    let row = |name, gains: &[Number], [area, ellipse, skew]: [Number; 3]| {
        let machine = machine(Settings { samples: 1_000_000, ..preset(name) });
        let exact = machine.table().exact;
        let computed = [exact.likelihood_gain.floor, exact.likelihood_gain.pose];
        gains.iter().rev().zip(computed).for_each(|(told, gain)| told.assert(gain, 0.0));
        area.assert(exact.area_ratio, 0.0);
        ellipse.assert_percent(machine.figures().inside_ellipse, SIGMAS * (0.117f64 / 1e6).sqrt());
        skew.assert(exact.cross_track_skew, 1e-12);
    };
    for (name, what) in [
        ("gentle", "| 1, 0.5, 1; the widget's opening ones"),
        ("hard", "| 1, 1.2, 1.4; the same"),
        ("banana", "| 1, 0, 2; (0.002, 0.002, 0.1, 0.1, 0.002, 0.002)"),
    ] {
        let [pose, floor, rest @ ..]: [Number; 5] =
            document().numbers(&format!("{what} | # | # | # | # % | # |"));
        row(name, &[pose, floor], rest);
    }
    let [floor, rest @ ..]: [Number; 4] =
        document().numbers("| 1, 0.5, 1; α₁₋₄ = 0.02, α₅,₆ = 0 | ∞ | # | # | # % | # |");
    row("worked", &[floor], rest);
}

#[test]
fn the_exact_skews_are_those_told() {
    let [worked, opening] = document().numbers(
        "α₁₋₄ = 0.02, α₅,₆ = 0: skew #; the widget's opening α = (0.05, 0.05, 0.05, 0.09, 0.01, 0.01): #.",
    );
    worked.assert(machine(preset("worked")).exact().cross_track_skew, 0.0);
    let opened = machine(Settings::default());
    opening.assert(opened.exact().cross_track_skew, 0.0);
    let [robots, error] = document()
        .numbers("The widget opens with # robots: at the opening command they tell the skew to ±#,");
    assert_eq!(robots.value, opened.settings().samples as f64);
    error.assert(opened.figures().cross_track.skew_error, 0.0);
}

/// The branch of the logarithm that is nearest to no turn at all, instead of that to the commanded one.
#[test]
fn torn_in_two_the_hard_arc_has_too_much_heading_variance() {
    let [stray, times] = document().numbers("would otherwise be torn in two at heading π, and # % of stray samples would make its heading variance # times as large");
    let hard = machine(Settings { samples: 200_000, ..preset("hard") });
    let torn: Vec<f64> = hard.poses().map(|pose| pose.log().z).collect();
    let whole: Vec<f64> = hard.twists().map(|twist| twist.z).collect();
    let strays = torn.iter().zip(&whole).filter(|(torn, whole)| (*torn - *whole).abs() > 1.0).count();
    stray.assert_percent(strays as f64 / 200_000.0, 0.001);
    let ratio = variance(&torn) / variance(&whole);
    times.assert(ratio, 0.0);
}

/// Of γ̂ alone: what the Gaussian with the moments of ξ says of robots that all stand at one point.
#[test]
fn the_gaussian_of_one_point_has_figures_that_mean_nothing() {
    let [alpha, skew, inside] = document()
        .numbers("at the opening command and α₅ = # with a skew of # and # % of the robots inside:");
    let velocity_alphas = [0.0, 0.0, 0.0, 0.0, alpha.value, 0.0];
    let point = machine(Settings { velocity_alphas, samples: 1_000_000, ..Settings::default() });
    let cloud: Vec<SE2> = point.poses().collect();
    let ExponentialMoments { mean, cov } = ExponentialMoments::from_poses(&cloud, &SE2::identity());
    let predicted = predicted_cross_track_skew(&mean, &cov);
    let plane = nalgebra::Matrix2::new(cov[(0, 0)], cov[(0, 2)], cov[(2, 0)], cov[(2, 2)]);
    let precision = plane.try_inverse().unwrap();
    let within = point.twists().filter(|twist| {
        let off = Vector2::new(twist.x - mean.x, twist.z - mean.z);
        off.dot(&(precision * off)) <= 4.0
    });
    let share = within.count() as f64 / 1e6;
    skew.assert(predicted, 0.003);
    inside.assert_percent(share, 0.0015);
}

/// The share inside the curve on the floor less the one inside the ellipse in (along, heading).
#[test]
fn the_two_shares_inside_the_outline_differ_as_told() {
    let [robots, arcs, pivot, odometry, held] = document().numbers(
        "at the opening α's, of # samples, by up to # % for Straight, Gentle and Hard arc and by # % for Pivot. Under the \
         odometry model, up to # %, but for Pivot, whose cloud lies around the start: there no great circle serves, and \
         the curve holds # %.",
    );
    for model in [ModelKind::Velocity, ModelKind::Odometry] {
        for name in ["straight", "gentle", "hard", "pivot"] {
            let machine = machine(Settings { model, samples: robots.value as usize, ..preset(name) });
            let outline = machine.contours().exponential;
            let inside = machine.poses().filter(|pose| winds_around(&outline, [pose.x(), pose.y()])).count();
            let drawn = inside as f64 / robots.value;
            let off = 100.0 * (drawn - machine.figures().inside_exponential).abs();
            match (model, name) {
                (ModelKind::Velocity, "pivot") => pivot.assert(off, 0.0),
                (ModelKind::Odometry, "pivot") => held.assert_percent(drawn, 0.0),
                (ModelKind::Velocity, _) => assert!(off <= arcs.value + arcs.rounding),
                (ModelKind::Odometry, _) => assert!(off <= odometry.value + odometry.rounding),
            }
        }
    }
}

/// Of twenty thousand clouds of ten.
#[test]
fn ten_samples_have_half_the_skew() {
    document().says("at ten samples the measured skew is on average about half the exact one;");
    let many = machine(Settings { samples: 200_000, ..Settings::default() });
    let poses: Vec<SE2> = many.poses().collect();
    let skews: Vec<f64> = poses.chunks(10).map(cross_track_skew).collect();
    let ratio = mean(&skews) / many.exact().cross_track_skew;
    assert!((ratio - 0.5).abs() < 0.1, "{ratio}");
}
