//! Accuracy of the α's, their intervals and the noise of the reference, over many simulated logs.

use super::calibrated;
use super::simulated::{ALPHAS, MODELS, Simulation, Violation};
use motion::calibrate::{ERROR_COUNT, Model, Systematic, SystematicError};

/// Number of legs of a log.
const LEG_COUNT: usize = 600;

/// Kind of simulated log.
struct Scenario {
    name: &'static str,
    change: fn(&mut Simulation),
    /// Allowed relative error of a median in addition to three standard errors.
    bias: f64,
}

const EXACT_REFERENCE: Scenario = Scenario { name: "exact reference", change: |_| (), bias: 0.05 };
const FINE_REFERENCE: Scenario =
    Scenario { name: "5 mm, 2 mrad", change: |sim| sim.reference_stds = [0.005, 0.002], bias: 0.05 };
const COARSE_REFERENCE: Scenario =
    Scenario { name: "20 mm, 20 mrad", change: |sim| sim.reference_stds = [0.02, 0.02], bias: 0.05 };
const SYSTEMATIC_ERRORS: Scenario =
    Scenario { name: "systematic errors", change: |sim| sim.errors = TRUE_ERRORS, bias: 0.05 };
const JUMPING_REFERENCE: Scenario = Scenario { name: "jumps", change: |sim| sim.jumps = 0.01, bias: 0.05 };
const PERSISTENT_ERRORS: Scenario =
    Scenario { name: "persistent", change: |sim| sim.violation = Violation::Autoregressive(0.7), bias: 0.1 };

const TRUE_ERRORS: Systematic = Systematic {
    clock_offset: 0.12,
    mount_yaw: 0.05,
    lever_arm: [0.1, -0.05],
    distance_scale: 1.02,
    turn_scale: 0.97,
};

/// Margin by which intervals of systematic errors (s, m, rad) are extended at both ends. The estimates neglect products of noises, and of noise
/// and clock offset within a row of 50 ms.
const NEGLECTED_TERMS: f64 = 1e-3;

/// Results of calibrations of many logs.
struct Study {
    /// Sorted ratios of fitted to true value, for each α.
    ratios: Vec<Vec<f64>>,
    /// Number of 95 % intervals that contain the true value, for each α.
    covered: Vec<usize>,
    errors_covered: [usize; ERROR_COUNT],
    /// Sorted estimates of the reference's standard deviations: position (m) and yaw (rad).
    stds: [Vec<f64>; 2],
    stds_covered: [usize; 2],
    logs: usize,
}

/// Returns 1 if an interval contains a value, and otherwise 0.
fn count_covered(interval: Option<[f64; 2]>, value: f64) -> usize {
    usize::from(interval.is_some_and(|[low, high]| (low..=high).contains(&value)))
}

fn run_study(model: Model, scenario: &Scenario, logs: usize) -> Study {
    let count = model.alphas();
    let mut study = Study {
        ratios: vec![Vec::new(); count],
        covered: vec![0; count],
        errors_covered: [0; ERROR_COUNT],
        stds: [Vec::new(), Vec::new()],
        stds_covered: [0; 2],
        logs,
    };
    for seed in 0..logs as u64 {
        let mut sim = Simulation::of(model, LEG_COUNT, 5000 + seed);
        (scenario.change)(&mut sim);
        let calibration = calibrated(&sim);
        for (alpha, truth) in ALPHAS.into_iter().enumerate().take(count) {
            study.ratios[alpha].extend(calibration.alphas[alpha].map(|fitted| fitted / truth));
            study.covered[alpha] += count_covered(calibration.intervals[alpha], truth);
        }
        for (error, covered) in SystematicError::ALL.into_iter().zip(&mut study.errors_covered) {
            let interval = calibration.interval_of(error);
            let extended_interval =
                interval.map(|[low, high]| [low - NEGLECTED_TERMS, high + NEGLECTED_TERMS]);
            *covered += count_covered(extended_interval, sim.errors.get(error));
        }
        for (index, noise) in calibration.reference_noise.iter().enumerate() {
            study.stds[index].push(noise.value);
            study.stds_covered[index] += count_covered(Some(noise.interval), sim.reference_stds[index]);
        }
    }
    study.ratios.iter_mut().chain(&mut study.stds).for_each(|sample| sample.sort_unstable_by(f64::total_cmp));
    let medians: Vec<f64> = study.ratios.iter().map(|ratios| median(ratios)).collect();
    let Study { covered, errors_covered, stds_covered, .. } = &study;
    let stds = [0, 1].map(|index| median(&study.stds[index]));
    println!(
        "{}, {model:?}: {medians:.3?}, covered {covered:?}, σ {stds:.4?} {stds_covered:?}, errors {errors_covered:?}",
        scenario.name
    );
    study
}

fn median(sorted: &[f64]) -> f64 {
    sorted[sorted.len() / 2]
}

/// Returns the standard error of a median of normal numbers, from the range of their middle 68 %.
fn median_std(sorted: &[f64]) -> f64 {
    let count = sorted.len();
    let [low, high] = [0.16, 0.84].map(|quantile| sorted[(quantile * count as f64) as usize]);
    1.25 * 0.5 * (high - low) / (count as f64).sqrt()
}

/// Returns three standard errors of a fraction of this number of logs.
fn three_standard_errors(fraction: f64, logs: usize) -> f64 {
    3.0 * (fraction * (1.0 - fraction) / logs as f64).sqrt()
}

/// Reports the fraction of intervals that contain the truth, if it is outside of 92 to 98 % by more than three standard errors.
fn report_wrong_coverage(name: &str, covered: usize, logs: usize) -> Option<String> {
    let fraction = covered as f64 / logs as f64;
    let allowed = 0.92 - three_standard_errors(0.92, logs)..=0.98 + three_standard_errors(0.98, logs);
    (!allowed.contains(&fraction)).then(|| format!("{covered} of {logs} intervals hold {name}"))
}

/// Reports α's whose medians are off by more than the bias and three standard errors, and α's with wrong intervals.
fn report_wrong_alphas(model: Model, scenario: &Scenario, study: &Study) -> Vec<String> {
    let reports_of_alpha = |alpha: usize| {
        let (ratios, name) = (&study.ratios[alpha], format!("α{}", alpha + 1));
        let (median_ratio, std) = (median(ratios), median_std(ratios));
        let is_off = ratios.len() < study.logs || (median_ratio - 1.0).abs() > scenario.bias + 3.0 * std;
        let wrong_median = is_off
            .then(|| format!("median of {name} in {} logs: {median_ratio:.3} ± {std:.3}", ratios.len()));
        [wrong_median, report_wrong_coverage(&name, study.covered[alpha], study.logs)]
    };
    let reports = (0..study.covered.len()).flat_map(reports_of_alpha).flatten();
    reports.map(|report| format!("{}, {model:?}: {report}", scenario.name)).collect()
}

/// Asserts that the α's of every model are right in a hundred logs, and that `further_reports` reports nothing.
fn assert_right_in_every_model(scenario: &Scenario, further_reports: impl Fn(&Study) -> Vec<String>) {
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

/// Reports a standard deviation of the reference that is off by more than 10 % and three standard errors.
fn report_wrong_std(study: &Study, component: usize, true_std: f64) -> Vec<String> {
    let median_of_std = median(&study.stds[component]);
    let allowed = 0.1 * true_std + 3.0 * median_std(&study.stds[component]);
    let is_off = (median_of_std - true_std).abs() > allowed;
    is_off.then(|| format!("median of std {component}: {median_of_std}")).into_iter().collect()
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

/// Two milliradians are a tenth of the wheels' rotation error on a leg. The log therefore gives only an upper bound for σ of the yaw.
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
        let report_of_error = |error: SystematicError| {
            report_wrong_coverage(&format!("{error:?}"), study.errors_covered[error as usize], study.logs)
        };
        SystematicError::ALL.into_iter().filter_map(report_of_error).collect()
    });
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_jumps_of_half_a_metre_in_a_hundredth_of_the_legs() {
    assert_right_in_every_model(&JUMPING_REFERENCE, |_| Vec::new());
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_persistent_errors() {
    assert_right_in_every_model(&PERSISTENT_ERRORS, |_| Vec::new());
}
