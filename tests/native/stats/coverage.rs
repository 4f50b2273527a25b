//! Coverage of the reported standard errors and intervals: fractions of thousands of seeds with which they contain the exact value.

use crate::common::text::PlainText;
use crate::common::{MAX_STANDARD_ERRORS, settings_of_preset};
use motion::geom::se2::SE2;
use motion::map::{FloorPlan, MapConditioned, Sampler};
use motion::sim::banana::{BananaMachine, ModelKind, Settings};
use motion::sim::settings::SettingRules;
use motion::sim::squeeze::{self, MapSqueeze};
use motion::{NoiseKind, VelocityAlphas, VelocityModel};

/// Number of seeds of each case. A fraction of 95 % then has a standard error of 0.2 %. The tolerance, 4.5 standard errors, is 1 %.
const REPETITION_COUNT: u64 = 10_000;

/// Number of seeds for clouds of ten times [`ROBOT_COUNT`] robots. The tolerance of the fraction 95 % is then 1.8 %.
const LARGE_CLOUD_REPETITION_COUNT: u64 = 3000;

/// Number of robots of a cloud, a tenth of the widget's default. In smaller clouds the skew and its error are biased.
const ROBOT_COUNT: usize = 5000;

/// Returns for each of several intervals the fraction of repetitions in which it contains the exact value.
fn measure_coverage<const N: usize>(
    seed_count: u64,
    mut is_covered_by_interval: impl FnMut(u64) -> [bool; N],
) -> [f64; N] {
    let mut covered_counts = [0; N];
    for seed in 0..seed_count {
        for (covered_count, is_covered) in covered_counts.iter_mut().zip(is_covered_by_interval(seed)) {
            *covered_count += u32::from(is_covered);
        }
    }
    covered_counts.map(|covered_count| f64::from(covered_count) / seed_count as f64)
}

fn assert_covered(case: &str, fraction: f64, seed_count: u64) {
    let tolerance = MAX_STANDARD_ERRORS * (0.95 * 0.05 / seed_count as f64).sqrt();
    assert!((fraction - 0.95).abs() <= tolerance, "{case}: {:.2} % hold the exact value", 100.0 * fraction);
}

/// Returns the fractions of clouds whose statistics differ by at most 1.96 standard errors from the exact values: cross-track skew, and
/// likelihood gain of poses and of positions on the floor.
fn measure_error_coverage(settings: Settings, seed_count: u64) -> [f64; 3] {
    let mut simulation = BananaMachine::new(settings).expect("valid settings");
    let (exact_skew, exact_gain) =
        (simulation.exact_moments().cross_track_skew, simulation.exact_gain().likelihood_gain);
    measure_coverage(seed_count, |seed| {
        simulation.configure(Settings { seed, ..settings }).expect("valid settings");
        let stats = simulation.stats();
        let (likelihood_gains, standard_errors) = (stats.likelihood_gain, stats.likelihood_gain_error);
        let is_within_standard_errors = |estimated_value: f64, standard_error: f64, exact_value: f64| {
            (estimated_value - exact_value).abs() <= 1.959_964 * standard_error
        };
        [
            is_within_standard_errors(stats.cross_track_skew, stats.cross_track_skew_error, exact_skew),
            is_within_standard_errors(likelihood_gains.pose, standard_errors.pose, exact_gain.pose),
            is_within_standard_errors(likelihood_gains.floor, standard_errors.floor, exact_gain.floor),
        ]
    })
}

/// The banana preset is the hardest case, because a few distant robots cause most of the variance.
#[test]
#[ignore = "nightly: thousands of clouds"]
fn standard_errors_cover_95_percent() {
    let with_small_cloud = |settings| (Settings { samples: ROBOT_COUNT, ..settings }, REPETITION_COUNT);
    for (cloud_name, (settings, repetition_count)) in [
        ("gentle arc", with_small_cloud(settings_of_preset("gentle"))),
        (
            "hard arc",
            with_small_cloud(Settings { noise: NoiseKind::Triangular, ..settings_of_preset("hard") }),
        ),
        (
            "odometry",
            with_small_cloud(Settings { model: ModelKind::Odometry, ..settings_of_preset("gentle") }),
        ),
        ("banana", (settings_of_preset("banana"), LARGE_CLOUD_REPETITION_COUNT)),
    ] {
        let covered_fractions = measure_error_coverage(settings, repetition_count);
        for (statistic_name, fraction) in
            ["skew", "gain of poses", "gain on the floor"].into_iter().zip(covered_fractions)
        {
            assert_covered(&format!("{statistic_name}, {cloud_name}"), fraction, repetition_count);
        }
    }
}

#[test]
#[ignore = "nightly: thousands of clouds"]
fn intervals_of_small_clouds_contain_the_exact_skew_as_often_as_printed() {
    let document_text = PlainText::from_document(include_str!("../../../doc/statistics.md"));
    let [small_cloud_percentage, small_cloud_size, larger_cloud_percentage, larger_cloud_size] =
        document_text.sentence_numbers(
            "1.96 errors hold the exact one in # of 100 clouds of #, in # of #, and in 95 of 5000 and more",
        );
    for (printed_percentage, robot_count) in
        [(small_cloud_percentage, small_cloud_size), (larger_cloud_percentage, larger_cloud_size)]
    {
        let settings = Settings { samples: robot_count.value as usize, ..settings_of_preset("gentle") };
        let [skew_fraction, ..] = measure_error_coverage(settings, REPETITION_COUNT);
        printed_percentage.assert_percent(skew_fraction, 0.0);
    }
}

/// Returns the fraction of motions whose path is blocked, among motions with a free end, by a sum over the noises of speed and turn rate.
/// The turn after the arc does not matter, because it does not change the position.
fn integrate_fraction_through_walls(settings: &squeeze::Settings) -> f64 {
    const NODE_COUNT: usize = 600;
    const MAX_SIGMAS: f64 = 6.0;
    let (plan, [x, y, theta]) = (FloorPlan::apartment(), settings.start);
    let model = VelocityModel { alphas: VelocityAlphas(settings.alphas), noise: NoiseKind::Normal };
    let conditioned_model =
        MapConditioned { model, plan: &plan, clearance: settings.clearance, sampler: Sampler::Endpoint };
    let collision_tester = conditioned_model.collision_tester(&settings.command, &SE2::new(x, y, theta));
    let unit_noise_at = |i: usize| ((i as f64 + 0.5) / NODE_COUNT as f64 * 2.0 - 1.0) * MAX_SIGMAS;
    let (mut free_end_weight, mut blocked_path_weight) = (0.0, 0.0);
    for v in (0..NODE_COUNT).map(unit_noise_at) {
        for omega in (0..NODE_COUNT).map(unit_noise_at) {
            let noise_weight = libm::exp(-0.5 * (v * v + omega * omega));
            let tested_draw = collision_tester.test_draw([v, omega, 0.0]);
            if tested_draw.end_verdict.is_free {
                free_end_weight += noise_weight;
                blocked_path_weight += if tested_draw.path_verdict.is_free { 0.0 } else { noise_weight };
            }
        }
    }
    blocked_path_weight / free_end_weight
}

#[test]
#[ignore = "nightly: thousands of clouds"]
fn the_interval_of_the_fraction_through_walls_covers_95_percent() {
    for &(preset_name, squeeze::Settings { start: start_pose, .. }) in squeeze::Settings::PRESETS {
        let settings = squeeze::Settings { start: start_pose, ..squeeze::Settings::default() };
        let exact_fraction = integrate_fraction_through_walls(&settings);
        let mut simulation = MapSqueeze::new(settings).expect("valid settings");
        let [fraction] = measure_coverage(REPETITION_COUNT, |seed| {
            simulation.configure(squeeze::Settings { seed, ..settings }).expect("valid settings");
            let [interval_low, interval_high] = simulation.stats().through_wall_interval;
            [interval_low <= exact_fraction && exact_fraction <= interval_high]
        });
        assert_covered(&format!("{preset_name}, exactly {exact_fraction}"), fraction, REPETITION_COUNT);
    }
}
