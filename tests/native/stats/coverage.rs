//! Coverage of the reported errors and intervals over thousands of seeds.

use crate::common::text::Text;
use crate::common::{MAX_STANDARD_ERRORS, preset};
use motion::geom::se2::SE2;
use motion::map::{FloorPlan, MapConditioned, Sampler};
use motion::sim::banana::{BananaMachine, ModelKind, Settings};
use motion::sim::squeeze::{self, MapSqueeze, PRESETS};
use motion::{NoiseKind, VelocityAlphas, VelocityModel};

/// Number of seeds of each case. A share of 95 % then has a standard error of 0.2 %. The tolerance, 4.5 standard errors, is 1 %.
const REPETITIONS: u64 = 10_000;

/// Number of seeds of clouds that are ten times as large. 4.5 standard errors of a share are 1.8 % then.
const LARGE_REPETITIONS: u64 = 3000;

/// Number of robots of a cloud, a tenth of the widget's default. The skew of smaller clouds, and its error, are biased.
const ROBOTS: usize = 5000;

/// Returns the share of repetitions in which an interval holds the exact value, for each of several intervals.
fn coverage_fractions<const N: usize>(
    repetitions: u64,
    mut covered_by: impl FnMut(u64) -> [bool; N],
) -> [f64; N] {
    let mut counts = [0; N];
    for seed in 0..repetitions {
        for (count, holds) in counts.iter_mut().zip(covered_by(seed)) {
            *count += u32::from(holds);
        }
    }
    counts.map(|count| f64::from(count) / repetitions as f64)
}

fn assert_covered(case: &str, fraction: f64, repetitions: u64) {
    let allowed = MAX_STANDARD_ERRORS * (0.95 * 0.05 / repetitions as f64).sqrt();
    assert!((fraction - 0.95).abs() <= allowed, "{case}: {:.2} % hold the exact value", 100.0 * fraction);
}

/// Returns shares of clouds: those whose skew, pose gain and floor gain differ by at most 1.96 standard errors from the exact value.
fn fractions_within_errors(settings: Settings, repetitions: u64) -> [f64; 3] {
    let mut simulation = BananaMachine::new(settings).expect("valid settings");
    let (skew, gain) = (simulation.exact_moments().cross_track_skew, simulation.exact_gain().value);
    coverage_fractions(repetitions, |seed| {
        simulation.configure(Settings { seed, ..settings }).expect("valid settings");
        let stats = simulation.stats();
        let (gains, error) = (stats.likelihood_gain, stats.likelihood_gain_error);
        let is_within = |value: f64, error: f64, exact: f64| (value - exact).abs() <= 1.959_964 * error;
        [
            is_within(stats.cross_track_skew, stats.cross_track_skew_error, skew),
            is_within(gains.pose, error.pose, gain.pose),
            is_within(gains.floor, error.floor, gain.floor),
        ]
    })
}

const STATISTIC_NAMES: [&str; 3] = ["skew", "gain of poses", "gain on the floor"];

#[test]
#[ignore = "nightly: thousands of clouds"]
fn standard_errors_of_small_clouds_cover_95_percent() {
    for (cloud_name, settings) in [
        ("gentle arc", preset("gentle")),
        ("hard arc", Settings { noise: NoiseKind::Triangular, ..preset("hard") }),
        ("odometry", Settings { model: ModelKind::Odometry, ..preset("gentle") }),
    ] {
        let settings = Settings { samples: ROBOTS, ..settings };
        for (statistic, fraction) in
            STATISTIC_NAMES.into_iter().zip(fractions_within_errors(settings, REPETITIONS))
        {
            assert_covered(&format!("{statistic}, {cloud_name}"), fraction, REPETITIONS);
        }
    }
}

/// In the cloud of this preset, a few distant robots cause most of the variance.
#[test]
#[ignore = "nightly: thousands of clouds"]
fn standard_errors_of_the_banana_preset_cover_95_percent() {
    let coverage_fractions = fractions_within_errors(preset("banana"), LARGE_REPETITIONS);
    for (statistic, fraction) in STATISTIC_NAMES.into_iter().zip(coverage_fractions) {
        assert_covered(&format!("{statistic}, banana"), fraction, LARGE_REPETITIONS);
    }
}

#[test]
#[ignore = "nightly: thousands of clouds"]
fn small_clouds_hold_the_exact_skew_as_often_as_printed() {
    let text = Text::in_document(include_str!("../../../doc/statistics.md"));
    let [percent_of_few, few, percent_of_more, more] = text.numbers(
        "1.96 errors hold the exact one in # of 100 clouds of #, in # of #, and in 95 of 5000 and more",
    );
    for (percent, robots) in [(percent_of_few, few), (percent_of_more, more)] {
        let settings = Settings { samples: robots.value as usize, ..preset("gentle") };
        let [skew, ..] = fractions_within_errors(settings, REPETITIONS);
        percent.assert_percent(skew, 0.0);
    }
}

/// Returns the share of motions whose path is blocked among those whose end is free. It is a sum over the noises of speed and turn rate,
/// because the turn after the arc does not change the position.
fn fraction_through_walls(settings: &squeeze::Settings) -> f64 {
    const NODES: usize = 600;
    const MAX_SIGMAS: f64 = 6.0;
    let (plan, [x, y, theta]) = (FloorPlan::apartment(), settings.start);
    let model = VelocityModel { alphas: VelocityAlphas(settings.alphas), noise: NoiseKind::Normal };
    let conditioned =
        MapConditioned { model, plan: &plan, clearance: settings.clearance, sampler: Sampler::Endpoint };
    let draw_tester = conditioned.draw_tester(&settings.command, &SE2::new(x, y, theta));
    let node_value = |i: usize| ((i as f64 + 0.5) / NODES as f64 * 2.0 - 1.0) * MAX_SIGMAS;
    let (mut free_weight, mut wall_weight) = (0.0, 0.0);
    for v in (0..NODES).map(node_value) {
        for omega in (0..NODES).map(node_value) {
            let weight = libm::exp(-0.5 * (v * v + omega * omega));
            let draw = draw_tester.test_draw([v, omega, 0.0]);
            if draw.end.free {
                free_weight += weight;
                wall_weight += if draw.path.free { 0.0 } else { weight };
            }
        }
    }
    wall_weight / free_weight
}

#[test]
#[ignore = "nightly: thousands of clouds"]
fn the_interval_of_the_fraction_through_walls_covers_95_percent() {
    for (name, start) in PRESETS {
        let settings = squeeze::Settings { start, ..squeeze::Settings::default() };
        let exact = fraction_through_walls(&settings);
        let mut simulation = MapSqueeze::new(settings).expect("valid settings");
        let [fraction] = coverage_fractions(REPETITIONS, |seed| {
            simulation.configure(squeeze::Settings { seed, ..settings }).expect("valid settings");
            let [low, high] = simulation.tally().through_wall_interval();
            [low <= exact && exact <= high]
        });
        assert_covered(&format!("{name}, exactly {exact}"), fraction, REPETITIONS);
    }
}
