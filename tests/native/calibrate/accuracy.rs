//! Accuracy of the α's, their intervals and the noise of the reference, over many simulated logs.

use super::calibrated;
use super::simulated::{ALPHAS, MODELS, Simulation, Unlike};
use motion::NoiseKind;
use motion::calibrate::{Model, Systematic, SystematicError};

/// Legs of a log.
const LEGS: usize = 600;

/// Kind of log.
#[derive(Clone, Copy)]
struct Scenario {
    name: &'static str,
    change: fn(&mut Simulation),
    /// Tolerance of medians beside that of chance.
    bias: f64,
}

const SCENARIOS: [Scenario; 6] = [
    Scenario { name: "exact reference", change: |_| (), bias: 0.05 },
    Scenario { name: "5 mm, 2 mrad", change: |made| made.reference_stds = [0.005, 0.002], bias: 0.05 },
    Scenario { name: "20 mm, 20 mrad", change: |made| made.reference_stds = [0.02, 0.02], bias: 0.05 },
    Scenario { name: "systematic errors", change: |made| made.errors = ERRORS, bias: 0.05 },
    Scenario { name: "jumps", change: |made| made.jumps = 0.01, bias: 0.05 },
    Scenario { name: "persistent", change: |made| made.unlike = Unlike::Autoregressive(0.7), bias: 0.1 },
];

const ERRORS: Systematic = Systematic {
    clock_offset: 0.12,
    mount_yaw: 0.05,
    lever_arm: [0.1, -0.05],
    distance_scale: 1.02,
    turn_scale: 0.97,
};

/// Results of calibrations of many logs.
struct Study {
    /// Fitted over true α's, sorted.
    ratios: Vec<Vec<f64>>,
    /// Numbers of 95 % intervals that hold the true values.
    held: Vec<usize>,
    errors_held: [usize; 6],
    /// Standard deviations of the reference, sorted.
    stds: [Vec<f64>; 2],
    logs: usize,
}

fn holds(interval: Option<[f64; 2]>, value: f64) -> usize {
    usize::from(interval.is_some_and(|[low, high]| (low..=high).contains(&value)))
}

fn study(model: Model, change: fn(&mut Simulation), logs: usize) -> Study {
    let count = model.alphas();
    let mut study = Study {
        ratios: vec![Vec::new(); count],
        held: vec![0; count],
        errors_held: [0; 6],
        stds: [Vec::new(), Vec::new()],
        logs,
    };
    for seed in 0..logs as u64 {
        let mut made = Simulation::of(model, NoiseKind::Normal, LEGS, 5000 + seed);
        change(&mut made);
        let calibration = calibrated(&made);
        for alpha in 0..count {
            study.ratios[alpha].extend(calibration.alphas[alpha].map(|fitted| fitted / ALPHAS[alpha]));
            study.held[alpha] += holds(calibration.intervals[alpha], ALPHAS[alpha]);
        }
        for (error, held) in SystematicError::ALL.into_iter().zip(&mut study.errors_held) {
            *held += holds(calibration.interval_of(error), made.errors.get(error));
        }
        for (stds, noise) in study.stds.iter_mut().zip(calibration.reference_noise) {
            stds.push(noise.value);
        }
    }
    study.ratios.iter_mut().chain(&mut study.stds).for_each(|each| each.sort_unstable_by(f64::total_cmp));
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

/// Returns what the study contradicts: a median that is off by more than the bias and three standard errors, or a number of intervals three
/// binomial standard errors outside of 92 to 98 %.
fn contradictions(name: &str, model: Model, bias: f64, study: &Study) -> Vec<String> {
    let mut found = Vec::new();
    let logs = study.logs as f64;
    for (alpha, (ratios, held)) in study.ratios.iter().zip(&study.held).enumerate() {
        let (middle, std) = (median(ratios), median_std(ratios));
        if ratios.len() < study.logs || (middle - 1.0).abs() > bias + 3.0 * std {
            found.push(format!(
                "{name}, {model:?}: median of α{} is {middle:.3} ± {std:.3} times the true one, in {} logs",
                alpha + 1,
                ratios.len()
            ));
        }
        let share = *held as f64 / logs;
        let binomial = |p: f64| 3.0 * (p * (1.0 - p) / logs).sqrt();
        if share < 0.92 - binomial(0.92) || share > 0.98 + binomial(0.98) {
            found.push(format!("{name}, {model:?}: {held} of {logs} intervals hold α{}", alpha + 1));
        }
    }
    found
}

#[test]
fn alphas_of_one_rule_are_right_in_every_kind_of_log() {
    let model = MODELS[1];
    let found: Vec<String> = SCENARIOS
        .iter()
        .flat_map(|each| contradictions(each.name, model, each.bias, &study(model, each.change, 12)))
        .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
#[ignore = "nightly: 3,000 calibrations"]
fn alphas_of_every_model_are_right_in_every_kind_of_log() {
    let found: Vec<String> = SCENARIOS
        .iter()
        .flat_map(|each| MODELS.map(|model| (each, model)))
        .flat_map(|(each, model)| {
            contradictions(each.name, model, each.bias, &study(model, each.change, 100))
        })
        .collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
}
