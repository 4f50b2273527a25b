//! Accuracy of the α's, their intervals and the noise of the reference, over many simulated logs.

use super::calibrated;
use super::simulated::{ALPHAS, MODELS, Simulation, Unlike};
use motion::NoiseKind;
use motion::calibrate::{ERRORS as ERROR_COUNT, Model, Systematic, SystematicError};

/// Number of legs of a log.
const LEGS: usize = 600;

/// Kind of log.
struct Scenario {
    name: &'static str,
    change: fn(&mut Simulation),
    /// Tolerance of medians in addition to chance.
    bias: f64,
}

const EXACT: Scenario = Scenario { name: "exact reference", change: |_| (), bias: 0.05 };
const FINE: Scenario =
    Scenario { name: "5 mm, 2 mrad", change: |made| made.reference_stds = [0.005, 0.002], bias: 0.05 };
const COARSE: Scenario =
    Scenario { name: "20 mm, 20 mrad", change: |made| made.reference_stds = [0.02, 0.02], bias: 0.05 };
const SYSTEMATIC: Scenario =
    Scenario { name: "systematic errors", change: |made| made.errors = ERRORS, bias: 0.05 };
const JUMPS: Scenario = Scenario { name: "jumps", change: |made| made.jumps = 0.01, bias: 0.05 };
const PERSISTENT: Scenario =
    Scenario { name: "persistent", change: |made| made.unlike = Unlike::Autoregressive(0.7), bias: 0.1 };

const ERRORS: Systematic = Systematic {
    clock_offset: 0.12,
    mount_yaw: 0.05,
    lever_arm: [0.1, -0.05],
    distance_scale: 1.02,
    turn_scale: 0.97,
};

/// Part (s, m, rad) of a systematic error that is accepted: products of the noises, and of noise and clock offset
/// within a row of 50 ms.
const RESOLUTION: f64 = 1e-3;

/// Results of calibrations of many logs.
struct Study {
    /// Fitted over true α's, sorted.
    ratios: Vec<Vec<f64>>,
    /// Numbers of 95 % intervals that hold the true values.
    held: Vec<usize>,
    errors_held: [usize; ERROR_COUNT],
    /// Standard deviations of the reference, sorted.
    stds: [Vec<f64>; 2],
    stds_held: [usize; 2],
    logs: usize,
}

fn holds(interval: Option<[f64; 2]>, value: f64) -> usize {
    usize::from(interval.is_some_and(|[low, high]| (low..=high).contains(&value)))
}

fn study(model: Model, scenario: &Scenario, logs: usize) -> Study {
    let count = model.alphas();
    let mut study = Study {
        ratios: vec![Vec::new(); count],
        held: vec![0; count],
        errors_held: [0; ERROR_COUNT],
        stds: [Vec::new(), Vec::new()],
        stds_held: [0; 2],
        logs,
    };
    for seed in 0..logs as u64 {
        let mut made = Simulation::of(model, NoiseKind::Normal, LEGS, 5000 + seed);
        (scenario.change)(&mut made);
        let calibration = calibrated(&made);
        for (alpha, truth) in ALPHAS.into_iter().enumerate().take(count) {
            study.ratios[alpha].extend(calibration.alphas[alpha].map(|fitted| fitted / truth));
            study.held[alpha] += holds(calibration.intervals[alpha], truth);
        }
        for (error, held) in SystematicError::ALL.into_iter().zip(&mut study.errors_held) {
            let interval = calibration.interval_of(error);
            let wider = interval.map(|[low, high]| [low - RESOLUTION, high + RESOLUTION]);
            *held += holds(wider, made.errors.get(error));
        }
        for (which, noise) in calibration.reference_noise.iter().enumerate() {
            study.stds[which].push(noise.value);
            study.stds_held[which] += holds(Some(noise.interval), made.reference_stds[which]);
        }
    }
    study.ratios.iter_mut().chain(&mut study.stds).for_each(|each| each.sort_unstable_by(f64::total_cmp));
    let medians: Vec<f64> = study.ratios.iter().map(|ratios| median(ratios)).collect();
    let Study { held, errors_held, stds_held, .. } = &study;
    let stds = [0, 1].map(|which| median(&study.stds[which]));
    println!(
        "{}, {model:?}: {medians:.3?}, held {held:?}, σ {stds:.4?} {stds_held:?}, errors {errors_held:?}",
        scenario.name
    );
    study
}

fn median(sorted: &[f64]) -> f64 {
    sorted[sorted.len() / 2]
}

/// Standard error of a median of normal numbers, by the range that holds their middle 68 %.
fn median_std(sorted: &[f64]) -> f64 {
    let count = sorted.len();
    let [low, high] = [0.16, 0.84].map(|part| sorted[(part * count as f64) as usize]);
    1.25 * 0.5 * (high - low) / (count as f64).sqrt()
}

/// Returns the tolerance of a fraction of `logs`: three binomial standard errors.
fn chance(share: f64, logs: usize) -> f64 {
    3.0 * (share * (1.0 - share) / logs as f64).sqrt()
}

/// Reports a number of 95 % intervals that is outside of 92 to 98 % by more than chance.
fn coverage(what: &str, held: usize, logs: usize) -> Option<String> {
    let share = held as f64 / logs as f64;
    let allowed = 0.92 - chance(0.92, logs)..=0.98 + chance(0.98, logs);
    (!allowed.contains(&share)).then(|| format!("{held} of {logs} intervals hold {what}"))
}

/// Reports α's whose medians are off by more than the bias and three standard errors, and their intervals.
fn complaints(model: Model, scenario: &Scenario, study: &Study) -> Vec<String> {
    let of = |alpha: usize| {
        let (ratios, name) = (&study.ratios[alpha], format!("α{}", alpha + 1));
        let (middle, std) = (median(ratios), median_std(ratios));
        let is_off = ratios.len() < study.logs || (middle - 1.0).abs() > scenario.bias + 3.0 * std;
        let off =
            is_off.then(|| format!("median of {name} in {} logs: {middle:.3} ± {std:.3}", ratios.len()));
        [off, coverage(&name, study.held[alpha], study.logs)]
    };
    let all = (0..study.held.len()).flat_map(of).flatten();
    all.map(|complaint| format!("{}, {model:?}: {complaint}", scenario.name)).collect()
}

/// Judges the α's of every model in a hundred logs.
fn every_model(scenario: &Scenario, more: impl Fn(&Study) -> Vec<String>) {
    let found: Vec<String> = MODELS
        .into_iter()
        .flat_map(|model| {
            let study = study(model, scenario, 100);
            let more = more(&study).into_iter().map(move |complaint| format!("{model:?}: {complaint}"));
            complaints(model, scenario, &study).into_iter().chain(more).collect::<Vec<_>>()
        })
        .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Reports a standard deviation of the reference that is off by more than 10 % and three standard errors.
fn std_complaints(study: &Study, which: usize, true_std: f64) -> Vec<String> {
    let middle = median(&study.stds[which]);
    let allowed = 0.1 * true_std + 3.0 * median_std(&study.stds[which]);
    let off = (middle - true_std).abs() > allowed;
    off.then(|| format!("median of std {which}: {middle}")).into_iter().collect()
}

#[test]
fn alphas_of_one_rule_are_right_in_every_kind_of_log() {
    let model = MODELS[1];
    let found: Vec<String> = [EXACT, FINE, COARSE, SYSTEMATIC, JUMPS, PERSISTENT]
        .iter()
        .flat_map(|scenario| complaints(model, scenario, &study(model, scenario, 12)))
        .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_an_exact_reference() {
    every_model(&EXACT, |_| Vec::new());
}

/// Two milliradians are a tenth of the error of the wheels' rotation on a leg: the log gives only an upper bound.
#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_an_unstated_noise_of_5_mm_and_2_mrad() {
    every_model(&FINE, |study| std_complaints(study, 0, 0.005));
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_an_unstated_noise_of_20_mm_and_20_mrad() {
    every_model(&COARSE, |study| [0, 1].map(|which| std_complaints(study, which, 0.02)).concat());
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_and_errors_are_right_with_five_systematic_errors() {
    every_model(&SYSTEMATIC, |study| {
        let of = |error: SystematicError| {
            coverage(&format!("{error:?}"), study.errors_held[error as usize], study.logs)
        };
        SystematicError::ALL.into_iter().filter_map(of).collect()
    });
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_jumps_of_half_a_metre_in_a_hundredth_of_the_legs() {
    every_model(&JUMPS, |_| Vec::new());
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn alphas_are_right_with_persistent_errors() {
    every_model(&PERSISTENT, |_| Vec::new());
}
