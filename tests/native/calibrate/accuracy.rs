//! Accuracy of the α's, their intervals and the noise of the reference, over many simulated logs.

use super::calibrate_simulation;
use super::simulated::{ALPHAS, MODELS, Sampling, Simulation, Violation};
use motion::calibrate::{ERROR_COUNT, Model, Systematic, SystematicError};

const LEG_COUNT: usize = 600;

/// Kind of simulated log.
struct Scenario {
    name: &'static str,
    modify: fn(&mut Simulation),
    /// Allowed relative error of a median in addition to three standard errors.
    allowed_bias: f64,
}

const fn scenario(name: &'static str, modify: fn(&mut Simulation)) -> Scenario {
    Scenario { name, modify, allowed_bias: 0.05 }
}

const EXACT_REFERENCE: Scenario = scenario("exact reference", |_| ());
const FINE_REFERENCE: Scenario = scenario("5 mm, 2 mrad", |sim| sim.reference_stds = [0.005, 0.002]);
const COARSE_REFERENCE: Scenario = scenario("20 mm, 20 mrad", |sim| sim.reference_stds = [0.02, 0.02]);
const SYSTEMATIC_ERRORS: Scenario =
    scenario("systematic errors", |sim| sim.systematic_errors = TRUE_SYSTEMATIC_ERRORS);
const JUMPING_REFERENCE: Scenario = scenario("jumps", |sim| sim.jump_fraction = 0.01);
const PERSISTENT_ERRORS: Scenario = Scenario {
    allowed_bias: 0.1,
    ..scenario("persistent", |sim| sim.violation = Violation::Autoregressive(0.7))
};

const UNRELATED_TIMES: Scenario =
    scenario("67 Hz and 29 Hz", |sim| sim.sampling = Sampling::Unrelated([3, 7]));

const TRUE_SYSTEMATIC_ERRORS: Systematic = Systematic {
    clock_offset: 0.12,
    mount_yaw: 0.05,
    lever_arm: [0.1, -0.05],
    distance_scale: 1.02,
    turn_scale: 0.97,
};

/// Margin by which intervals of systematic errors (s, m, rad) are extended at both ends. The estimates neglect products of noises, and products
/// of noise and clock offset within a row of 50 ms.
const INTERVAL_MARGIN: f64 = 1e-3;

/// Results of calibrations of many logs.
struct StudyResults {
    /// Sorted ratios of fitted to true value, for each α.
    ratios: Vec<Vec<f64>>,
    /// Number of 95 % intervals that contain the true value, for each α.
    covered_counts: Vec<usize>,
    errors_covered: [usize; ERROR_COUNT],
    /// Sorted estimates of the reference's standard deviations: position (m) and yaw (rad).
    stds: [Vec<f64>; 2],
    stds_covered: [usize; 2],
    log_count: usize,
}

/// Returns 1 if an interval contains a value, and otherwise 0.
fn count_covered(interval: Option<[f64; 2]>, value: f64) -> usize {
    usize::from(interval.is_some_and(|[low, high]| (low..=high).contains(&value)))
}

fn run_study(model: Model, scenario: &Scenario, log_count: usize) -> StudyResults {
    let alpha_count = model.alphas();
    let mut study = StudyResults {
        ratios: vec![Vec::new(); alpha_count],
        covered_counts: vec![0; alpha_count],
        errors_covered: [0; ERROR_COUNT],
        stds: [Vec::new(), Vec::new()],
        stds_covered: [0; 2],
        log_count,
    };
    for seed in 0..log_count as u64 {
        let mut sim = Simulation::of(model, LEG_COUNT, 5000 + seed);
        (scenario.modify)(&mut sim);
        let calibration = calibrate_simulation(&sim);
        for (alpha, truth) in ALPHAS.into_iter().enumerate().take(alpha_count) {
            study.ratios[alpha].extend(calibration.alphas[alpha].map(|fitted| fitted / truth));
            study.covered_counts[alpha] += count_covered(calibration.intervals[alpha], truth);
        }
        for (error, covered_counts) in SystematicError::ALL.into_iter().zip(&mut study.errors_covered) {
            let interval = calibration.interval_of(error);
            let extended_interval =
                interval.map(|[low, high]| [low - INTERVAL_MARGIN, high + INTERVAL_MARGIN]);
            *covered_counts += count_covered(extended_interval, sim.systematic_errors.get(error));
        }
        for (index, noise) in calibration.reference_noise.iter().enumerate() {
            study.stds[index].push(noise.value);
            study.stds_covered[index] += count_covered(Some(noise.interval), sim.reference_stds[index]);
        }
    }
    study.ratios.iter_mut().chain(&mut study.stds).for_each(|sample| sample.sort_unstable_by(f64::total_cmp));
    let median_ratios: Vec<f64> = study.ratios.iter().map(|ratios| sorted_median(ratios)).collect();
    let StudyResults { covered_counts, errors_covered, stds_covered, .. } = &study;
    let median_stds = [0, 1].map(|index| sorted_median(&study.stds[index]));
    println!(
        "{}, {model:?}: {median_ratios:.3?}, covered {covered_counts:?}, σ {median_stds:.4?} {stds_covered:?}, errors {errors_covered:?}",
        scenario.name
    );
    study
}

fn sorted_median(sorted: &[f64]) -> f64 {
    sorted[sorted.len() / 2]
}

/// Returns the standard error of the median of normal numbers, estimated from the range of their middle 68 %.
fn standard_error_of_median(sorted: &[f64]) -> f64 {
    let value_count = sorted.len();
    let [low, high] = [0.16, 0.84].map(|quantile| sorted[(quantile * value_count as f64) as usize]);
    1.25 * 0.5 * (high - low) / (value_count as f64).sqrt()
}

/// Returns three standard errors of a fraction that is estimated from `log_count` logs.
fn three_standard_errors(fraction: f64, log_count: usize) -> f64 {
    3.0 * (fraction * (1.0 - fraction) / log_count as f64).sqrt()
}

/// Reports the fraction of intervals that contain the truth, if it is outside of 92 to 98 % by more than three standard errors.
fn report_wrong_coverage(name: &str, covered_count: usize, log_count: usize) -> Option<String> {
    let covered_fraction = covered_count as f64 / log_count as f64;
    let allowed_fractions =
        0.92 - three_standard_errors(0.92, log_count)..=0.98 + three_standard_errors(0.98, log_count);
    (!allowed_fractions.contains(&covered_fraction))
        .then(|| format!("{covered_count} of {log_count} intervals hold {name}"))
}

/// Reports α's whose medians are off by more than the allowed bias plus three standard errors, and α's with wrong intervals.
fn report_wrong_alphas(model: Model, scenario: &Scenario, study: &StudyResults) -> Vec<String> {
    let report_alpha = |alpha: usize| {
        let (ratios, name) = (&study.ratios[alpha], format!("α{}", alpha + 1));
        let (median_ratio, standard_error) = (sorted_median(ratios), standard_error_of_median(ratios));
        let is_off = ratios.len() < study.log_count
            || (median_ratio - 1.0).abs() > scenario.allowed_bias + 3.0 * standard_error;
        let median_report = is_off.then(|| {
            format!("median of {name} in {} logs: {median_ratio:.3} ± {standard_error:.3}", ratios.len())
        });
        [median_report, report_wrong_coverage(&name, study.covered_counts[alpha], study.log_count)]
    };
    let alpha_reports = (0..study.covered_counts.len()).flat_map(report_alpha).flatten();
    alpha_reports.map(|report| format!("{}, {model:?}: {report}", scenario.name)).collect()
}

/// Asserts that the α's of every model are right in a hundred logs, and that `further_reports` reports nothing.
fn assert_right_in_every_model(scenario: &Scenario, further_reports: impl Fn(&StudyResults) -> Vec<String>) {
    let reports: Vec<String> = MODELS
        .into_iter()
        .flat_map(|model| {
            let study = run_study(model, scenario, 100);
            let other_reports =
                further_reports(&study).into_iter().map(move |report| format!("{model:?}: {report}"));
            report_wrong_alphas(model, scenario, &study).into_iter().chain(other_reports).collect::<Vec<_>>()
        })
        .collect();
    assert!(reports.is_empty(), "{}", reports.join("\n"));
}

/// Reports a standard deviation of the reference that is off by more than 10 % plus three standard errors.
fn report_wrong_std(study: &StudyResults, component: usize, true_std: f64) -> Vec<String> {
    let median_std = sorted_median(&study.stds[component]);
    let tolerance = 0.1 * true_std + 3.0 * standard_error_of_median(&study.stds[component]);
    let is_off = (median_std - true_std).abs() > tolerance;
    is_off.then(|| format!("median of std {component}: {median_std}")).into_iter().collect()
}

#[test]
fn alphas_of_one_rule_are_right_in_every_kind_of_log() {
    let model = MODELS[1];
    let scenarios = [
        EXACT_REFERENCE,
        FINE_REFERENCE,
        COARSE_REFERENCE,
        SYSTEMATIC_ERRORS,
        JUMPING_REFERENCE,
        PERSISTENT_ERRORS,
    ];
    for scenario in &scenarios {
        assert_eq!(
            report_wrong_alphas(model, scenario, &run_study(model, scenario, 10)),
            Vec::<String>::new()
        );
    }
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_an_exact_reference() {
    assert_right_in_every_model(&EXACT_REFERENCE, |_| Vec::new());
}

/// A yaw noise of two milliradians is a tenth of the wheels' rotation error on a leg. The log therefore gives only an upper bound for its σ.
#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_an_unstated_noise_of_5_mm_and_2_mrad() {
    assert_right_in_every_model(&FINE_REFERENCE, |study| report_wrong_std(study, 0, 0.005));
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_an_unstated_noise_of_20_mm_and_20_mrad() {
    assert_right_in_every_model(&COARSE_REFERENCE, |study| {
        [0, 1].map(|component| report_wrong_std(study, component, 0.02)).concat()
    });
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_and_errors_are_right_with_five_systematic_errors() {
    assert_right_in_every_model(&SYSTEMATIC_ERRORS, |study| {
        let report_error = |error: SystematicError| {
            report_wrong_coverage(
                &format!("{error:?}"),
                study.errors_covered[error as usize],
                study.log_count,
            )
        };
        SystematicError::ALL.into_iter().filter_map(report_error).collect()
    });
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_jumps_of_half_a_metre_in_a_hundredth_of_the_legs() {
    assert_right_in_every_model(&JUMPING_REFERENCE, |_| Vec::new());
}

/// Poses have to be interpolated, because the readings and the samples of the reference have different times.
#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_if_odometry_and_reference_have_unrelated_times() {
    assert_right_in_every_model(&UNRELATED_TIMES, |_| Vec::new());
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_persistent_errors() {
    assert_right_in_every_model(&PERSISTENT_ERRORS, |_| Vec::new());
}
