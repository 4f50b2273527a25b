//! Accuracy of the α's, their intervals and the noise of the reference, over many simulated logs.

use super::calibrate_simulation;
use super::simulated::{ALPHAS, MODELS, SampleTimes, Simulation, Violation};
use motion::calibrate::{ERROR_COUNT, Model, Systematic, SystematicError};

const LEGS_PER_LOG: usize = 600;

struct Scenario {
    scenario_name: &'static str,
    modify_simulation: fn(&mut Simulation),
    /// Allowed bias of a median α, relative to the true α. Three standard errors are allowed in addition.
    allowed_bias: f64,
}

const fn new_scenario(name: &'static str, modify_simulation: fn(&mut Simulation)) -> Scenario {
    Scenario { scenario_name: name, modify_simulation, allowed_bias: 0.05 }
}

const EXACT_REFERENCE: Scenario = new_scenario("exact reference", |_| ());
const FINE_REFERENCE: Scenario = new_scenario("5 mm, 2 mrad", |sim| sim.reference_stds = [0.005, 0.002]);
const COARSE_REFERENCE: Scenario = new_scenario("20 mm, 20 mrad", |sim| sim.reference_stds = [0.02, 0.02]);
const SYSTEMATIC_ERRORS: Scenario =
    new_scenario("systematic errors", |sim| sim.systematic_errors = TRUE_SYSTEMATIC_ERRORS);
const JUMPING_REFERENCE: Scenario = new_scenario("jumps", |sim| sim.jump_fraction = 0.01);
const PERSISTENT_ERRORS: Scenario = Scenario {
    allowed_bias: 0.1,
    ..new_scenario("persistent", |sim| sim.noise_violation = Violation::AutocorrelatedNoise(0.7))
};

const UNRELATED_TIMES: Scenario =
    new_scenario("67 Hz and 29 Hz", |sim| sim.sample_times = SampleTimes::Asynchronous([3, 7]));

const TRUE_SYSTEMATIC_ERRORS: Systematic = Systematic {
    clock_offset: 0.12,
    mount_yaw: 0.05,
    lever_arm: [0.1, -0.05],
    distance_scale: 1.02,
    turn_scale: 0.97,
};

/// Margin by which intervals of systematic errors (s, m, rad) are extended at both ends. The estimates neglect terms of second order:
/// products of two noises, and products of a noise and the clock offset.
const INTERVAL_MARGIN: f64 = 1e-3;

struct StudyResults {
    alpha_ratios: Vec<Vec<f64>>,
    /// Number of 95 % intervals that contain the true value, for each α.
    covered_alphas: Vec<usize>,
    covered_errors: [usize; ERROR_COUNT],
    /// Sorted estimates of the reference's standard deviations, of position (m) and yaw (rad).
    reference_stds: [Vec<f64>; 2],
    covered_std_counts: [usize; 2],
    log_count: usize,
}

fn count_covered(confidence_interval: Option<[f64; 2]>, true_value: f64) -> usize {
    usize::from(confidence_interval.is_some_and(|[low, high]| (low..=high).contains(&true_value)))
}

fn run_calibration_study(model: Model, scenario: &Scenario, log_count: usize) -> StudyResults {
    let alpha_count = model.alpha_count();
    let mut study = StudyResults {
        alpha_ratios: vec![Vec::new(); alpha_count],
        covered_alphas: vec![0; alpha_count],
        covered_errors: [0; ERROR_COUNT],
        reference_stds: [Vec::new(), Vec::new()],
        covered_std_counts: [0; 2],
        log_count,
    };
    for seed in 0..log_count as u64 {
        let mut sim = Simulation::new(model, LEGS_PER_LOG, 5000 + seed);
        (scenario.modify_simulation)(&mut sim);
        let log_calibration = calibrate_simulation(&sim);
        for (alpha_index, true_alpha) in ALPHAS.into_iter().enumerate().take(alpha_count) {
            study.alpha_ratios[alpha_index]
                .extend(log_calibration.alphas[alpha_index].map(|fitted_alpha| fitted_alpha / true_alpha));
            study.covered_alphas[alpha_index] +=
                count_covered(log_calibration.intervals[alpha_index], true_alpha);
        }
        for (error_kind, covered_count) in SystematicError::ALL.into_iter().zip(&mut study.covered_errors) {
            let error_interval = log_calibration.interval_of(error_kind);
            let extended_interval =
                error_interval.map(|[low, high]| [low - INTERVAL_MARGIN, high + INTERVAL_MARGIN]);
            *covered_count += count_covered(extended_interval, sim.systematic_errors.get(error_kind));
        }
        for (component_index, noise_estimate) in log_calibration.reference_noise.iter().enumerate() {
            study.reference_stds[component_index].push(noise_estimate.value);
            study.covered_std_counts[component_index] +=
                count_covered(Some(noise_estimate.interval), sim.reference_stds[component_index]);
        }
    }
    study
        .alpha_ratios
        .iter_mut()
        .chain(&mut study.reference_stds)
        .for_each(|sorted_estimates| sorted_estimates.sort_unstable_by(f64::total_cmp));
    let median_ratios: Vec<f64> =
        study.alpha_ratios.iter().map(|sorted_ratios| median_of(sorted_ratios)).collect();
    let StudyResults { covered_alphas, covered_errors, covered_std_counts: covered_stds, .. } = &study;
    let median_stds = [0, 1].map(|component_index| median_of(&study.reference_stds[component_index]));
    println!(
        "{}, {model:?}: {median_ratios:.3?}, covered {covered_alphas:?}, σ {median_stds:.4?} {covered_stds:?}, errors {covered_errors:?}",
        scenario.scenario_name
    );
    study
}

fn median_of(sorted_numbers: &[f64]) -> f64 {
    sorted_numbers[sorted_numbers.len() / 2]
}

/// Returns the standard error of the median of normal numbers, estimated from the range of their middle 68 %.
fn estimate_error_of_median(sorted_numbers: &[f64]) -> f64 {
    let number_count = sorted_numbers.len();
    let [low, high] =
        [0.16, 0.84].map(|quantile_level| sorted_numbers[(quantile_level * number_count as f64) as usize]);
    1.25 * 0.5 * (high - low) / (number_count as f64).sqrt()
}

fn three_standard_errors_of(true_fraction: f64, log_count: usize) -> f64 {
    3.0 * (true_fraction * (1.0 - true_fraction) / log_count as f64).sqrt()
}

/// Reports the fraction of intervals that contain the truth, if it is outside of 92 to 98 % by more than three standard errors.
fn report_wrong_coverage(quantity_name: &str, covered_count: usize, log_count: usize) -> Option<String> {
    let covered_fraction = covered_count as f64 / log_count as f64;
    let allowed_coverage =
        0.92 - three_standard_errors_of(0.92, log_count)..=0.98 + three_standard_errors_of(0.98, log_count);
    (!allowed_coverage.contains(&covered_fraction))
        .then(|| format!("{covered_count} of {log_count} intervals hold {quantity_name}"))
}

/// Reports α's with a median error above the allowed bias plus three standard errors, or with too narrow or too wide intervals.
fn report_wrong_alphas(model: Model, scenario: &Scenario, study: &StudyResults) -> Vec<String> {
    let report_wrong_alpha = |alpha_index: usize| {
        let (ratios, name) = (&study.alpha_ratios[alpha_index], format!("α{}", alpha_index + 1));
        let (median_ratio, standard_error) = (median_of(ratios), estimate_error_of_median(ratios));
        let is_median_wrong = ratios.len() < study.log_count
            || (median_ratio - 1.0).abs() > scenario.allowed_bias + 3.0 * standard_error;
        let median_report = is_median_wrong.then(|| {
            format!("median of {name} in {} logs: {median_ratio:.3} ± {standard_error:.3}", ratios.len())
        });
        [median_report, report_wrong_coverage(&name, study.covered_alphas[alpha_index], study.log_count)]
    };
    let alpha_reports = (0..study.covered_alphas.len()).flat_map(report_wrong_alpha).flatten();
    alpha_reports
        .map(|alpha_report| format!("{}, {model:?}: {alpha_report}", scenario.scenario_name))
        .collect()
}

/// Asserts that the α's of every model are right in a hundred logs, and that `further_reports_of` reports nothing.
fn assert_right_in_every_model(
    scenario: &Scenario,
    further_reports_of: impl Fn(&StudyResults) -> Vec<String>,
) {
    let failure_reports: Vec<String> = MODELS
        .into_iter()
        .flat_map(|model| {
            let study = run_calibration_study(model, scenario, 100);
            let other_reports = further_reports_of(&study)
                .into_iter()
                .map(move |alpha_report| format!("{model:?}: {alpha_report}"));
            report_wrong_alphas(model, scenario, &study).into_iter().chain(other_reports).collect::<Vec<_>>()
        })
        .collect();
    assert!(failure_reports.is_empty(), "{}", failure_reports.join("\n"));
}

fn report_wrong_std(study: &StudyResults, component_index: usize, true_std: f64) -> Vec<String> {
    let median_std = median_of(&study.reference_stds[component_index]);
    let tolerance = 0.1 * true_std + 3.0 * estimate_error_of_median(&study.reference_stds[component_index]);
    let is_median_wrong = (median_std - true_std).abs() > tolerance;
    is_median_wrong.then(|| format!("median of std {component_index}: {median_std}")).into_iter().collect()
}

#[test]
fn alphas_of_one_rule_are_right_in_every_kind_of_log() {
    let model = MODELS[1];
    let tested_scenarios = [
        EXACT_REFERENCE,
        FINE_REFERENCE,
        COARSE_REFERENCE,
        SYSTEMATIC_ERRORS,
        JUMPING_REFERENCE,
        PERSISTENT_ERRORS,
    ];
    for scenario in &tested_scenarios {
        assert_eq!(
            report_wrong_alphas(model, scenario, &run_calibration_study(model, scenario, 10)),
            Vec::<String>::new()
        );
    }
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_an_exact_reference() {
    assert_right_in_every_model(&EXACT_REFERENCE, |_| Vec::new());
}

/// A yaw noise of two milliradians is a tenth of the wheels' rotation error on a leg. The log therefore bounds this noise only from above.
#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_an_unstated_reference_noise_of_5_mm_and_2_mrad() {
    assert_right_in_every_model(&FINE_REFERENCE, |study| report_wrong_std(study, 0, 0.005));
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_an_unstated_reference_noise_of_20_mm_and_20_mrad() {
    assert_right_in_every_model(&COARSE_REFERENCE, |study| {
        [0, 1].map(|component_index| report_wrong_std(study, component_index, 0.02)).concat()
    });
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_and_errors_are_right_with_five_systematic_errors() {
    assert_right_in_every_model(&SYSTEMATIC_ERRORS, |study| {
        let report_wrong_interval = |error_kind: SystematicError| {
            report_wrong_coverage(
                &format!("{error_kind:?}"),
                study.covered_errors[error_kind as usize],
                study.log_count,
            )
        };
        SystematicError::ALL.into_iter().filter_map(report_wrong_interval).collect()
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
