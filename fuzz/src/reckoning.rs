//! Dead Reckoning under any settings and calls.

use super::input::{Input, turn_of};
use super::laws;
use super::settings::{allowed, changed};
use motion::sim::dead_reckoning::{
    DeadReckoning, MAX_SHOWN_ROBOTS, Measured, Misses, Outlines, RECURSIONS, Settings, Stats, StraightGrowth,
};
use nalgebra::Matrix3;

/// Maximum numbers of robots, steps and calls in a run. Robots are driven in blocks of 256. Most runs have one block, and some several.
const FEW_SAMPLES: usize = 200;
const SAMPLES: usize = 800;
const STEPS: u32 = 5;
const CALLS: usize = 4;

pub fn run(bytes: &[u8]) {
    let mut input = Input(bytes);
    let [with_straight, with_double] = [0; 2].map(|_| input.choice(4) == 1);
    let opening = Settings { samples: 3, steps: STEPS, ..Settings::default() };
    let opening = changed(&opening, &mut input);
    if !allowed(&opening) {
        assert!(DeadReckoning::showing(opening, 0).is_err());
        return;
    }
    let most = if turn_of(16, bytes) { SAMPLES } else { FEW_SAMPLES };
    let few = |settings| few(settings, most);
    let mut machine = DeadReckoning::showing(few(opening), 0).expect("allowed");
    if input.truth() {
        machine.add_samples(SAMPLES);
    }
    for _ in 0..CALLS {
        if input.is_empty() {
            break;
        }
        call(&mut machine, &few, &mut input);
    }
    assert_results(&machine);
    // Slow checks run for some inputs only.
    if with_straight && turn_of(8, bytes) {
        assert_straight_growth(&machine);
    }
    if with_double && turn_of(8, bytes) {
        assert_as_new(&machine);
    }
}

/// Returns the same settings with few robots and steps.
fn few(settings: Settings, most: usize) -> Settings {
    Settings {
        samples: settings.samples.min(most),
        steps: settings.steps.min(STEPS),
        step: settings.step.min(settings.steps.min(STEPS)),
        ..settings
    }
}

fn call(machine: &mut DeadReckoning, few: &dyn Fn(Settings) -> Settings, input: &mut Input) {
    let shown = machine.shown();
    match input.choice(9) {
        0 | 1 => configure(machine, few, input),
        2 | 3 => assert_same_in_blocks(machine, few, input),
        4 => {
            let count = usize::from(u16::from_le_bytes(input.bytes())) % SAMPLES;
            assert_eq!(machine.add_samples(count), (shown + count).min(machine.settings().samples));
        }
        5 => {
            machine.configure_first(*machine.settings(), 0).expect("allowed");
            assert_eq!(machine.shown(), 0);
        }
        6 => assert_nearest(machine, input),
        7 => assert_outlines(machine, 1 + input.choice(STEPS as usize) as u32),
        _ => assert_rollout(machine, usize::from(u16::from_le_bytes(input.bytes())) % SAMPLES),
    }
}

fn configure(machine: &mut DeadReckoning, few: &dyn Fn(Settings) -> Settings, input: &mut Input) {
    let settings = changed(machine.settings(), input);
    if allowed(&settings) {
        machine.configure(few(settings)).expect("allowed");
        return;
    }
    let before = results(machine);
    assert!(machine.configure(settings).is_err() && machine.configure_first(settings, 0).is_err());
    assert_eq!(results(machine), before);
}

/// Asserts that robots added in blocks equal the robots of one call.
fn assert_same_in_blocks(machine: &mut DeadReckoning, few: &dyn Fn(Settings) -> Settings, input: &mut Input) {
    let settings = changed(machine.settings(), input);
    if !allowed(&settings) {
        return;
    }
    let settings = few(settings);
    let mut other = machine.clone();
    other.configure(settings).expect("allowed");
    let count = 1 + usize::from(u16::from_le_bytes(input.bytes())) % SAMPLES;
    machine.configure_first(settings, count).expect("allowed");
    while machine.shown() < settings.samples {
        machine.add_samples(count);
    }
    assert_eq!(results(machine), results(&other));
    assert_results(machine);
}

/// Asserts that a machine depends on its settings only, and not on earlier calls.
fn assert_as_new(machine: &DeadReckoning) {
    let mut other = DeadReckoning::showing(*machine.settings(), 0).expect("allowed");
    other.add_samples(machine.shown());
    assert_eq!(results(&other), results(machine));
}

/// Returns all results: those of the selected step as bits, and the others as text, in which NaN equals NaN.
fn results(machine: &DeadReckoning) -> (String, Vec<u64>) {
    let (settings, stats, measured) = (machine.settings(), machine.stats(), machine.measured());
    let outlines = machine.outlines(settings.step);
    let lines = outlines.iter().flat_map(|Outlines { ellipse, exponential, predicted, measured }| {
        [ellipse, exponential, predicted, measured].into_iter().flat_map(|line| line.as_flattened())
    });
    let numbers = machine.poses(settings.step).as_flattened().iter().chain(lines);
    (format!("{settings:?} {stats:?} {measured:?}"), numbers.map(|number| number.to_bits()).collect())
}

/// Asserts that all results are finite, or NaN or empty where they are undefined.
fn assert_results(machine: &DeadReckoning) {
    let settings = machine.settings();
    let (n, steps) = (machine.shown(), settings.steps as usize);
    assert!(n <= SAMPLES && (1..=settings.steps).contains(&settings.step), "{settings:?} of {n}");
    assert_eq!([machine.measured().len(), machine.nominal().len()], [steps; 2]);
    machine.nominal().iter().for_each(|pose| laws::assert_pose("nominal", pose));
    laws::assert_finite("commanded", machine.commanded().as_flattened());
    for measured in machine.measured() {
        if n > 0 {
            laws::assert_finite("mean", measured.mean.as_slice());
        }
        if n > 1 {
            assert_covariance("measured", &measured.cov, rounding_of_sums(measured));
        }
        for (i, error) in measured.relative_error.iter().enumerate() {
            assert!(error.is_nan() || *error >= 0.0, "{measured:?}");
            // A relative error needs a variance above 0.
            let spreads = n > 1 && measured.cov[(i, i)] > 0.0;
            assert!(error.is_nan() || spreads, "{measured:?} of {n}");
        }
    }
    let step = settings.step;
    assert_eq!(machine.poses(step).len(), n.min(MAX_SHOWN_ROBOTS));
    assert!(machine.poses(0).is_empty() && machine.poses(settings.steps + 1).is_empty());
    laws::assert_finite("poses", machine.poses(step).as_flattened());
    machine.twists().for_each(|twist| laws::assert_finite("a twist", &twist));
    assert_eq!(machine.twists().len(), n.min(MAX_SHOWN_ROBOTS));
    for order in RECURSIONS {
        let (predicted, compared) = (machine.predicted(order), machine.comparison(order));
        assert_eq!([predicted.len(), compared.ratios.len()], [steps; 2]);
        for (cov, ratio) in predicted.iter().zip(&compared.ratios) {
            assert!(
                ratio.iter().all(|ratio| ratio.is_nan() || (cov.is_some() && *ratio >= 0.0)),
                "{ratio:?}"
            );
            let Some(cov) = cov else { continue };
            // Each step turns along and across into each other.
            assert_covariance("predicted", cov, |_, _| 1e-12 * cov.amax());
        }
        compared.misses.iter().for_each(|misses| assert_misses(misses, steps));
    }
    let Stats { n: counted, .. } = machine.stats();
    assert_eq!(counted, n);
    assert_outlines(machine, step);
}

/// Asserts that a matrix is finite and symmetric, and has no correlation above 1, to within `rounding`.
fn assert_covariance(what: &str, cov: &Matrix3<f64>, rounding: impl Fn(usize, usize) -> f64) {
    laws::assert_finite(what, cov.as_slice());
    for i in 0..3 {
        assert!(cov[(i, i)] >= 0.0, "{what}: {cov:?}");
        for j in 0..i {
            let rounded = rounding(i, j) + f64::MIN_POSITIVE;
            assert!((cov[(i, j)] - cov[(j, i)]).abs() <= rounded, "{what}: {cov:?}");
            let [first, second] = [i, j].map(|k| (cov[(k, k)] + rounding(k, k)).sqrt());
            assert!(cov[(i, j)].abs() <= first * second + rounded, "{what}: {cov:?}");
        }
    }
}

/// Returns the rounding error of a covariance computed as mean of products minus product of means.
fn rounding_of_sums(Measured { mean, cov, .. }: &Measured) -> impl Fn(usize, usize) -> f64 + use<> {
    let [along, lateral, heading] = [0, 1, 2].map(|i| mean[i].abs() + cov[(i, i)].sqrt());
    let sizes = [along + lateral, along + lateral, heading];
    move |i, j| laws::ROUNDING * sizes[i] * sizes[j] + laws::UNDERFLOW * (sizes[i] + sizes[j])
}

fn assert_misses(misses: &Misses, steps: usize) {
    let Misses { told, first, last, end, error } = *misses;
    assert_eq!(first.is_some(), last.is_some(), "{misses:?}");
    assert!(told || first.is_none(), "{misses:?}");
    let in_order = 1 <= first.unwrap_or(1) && first <= last && last.unwrap_or(1) as usize <= steps;
    assert!(in_order && !end.is_infinite() && (error.is_nan() || error >= 0.0), "{misses:?}");
}

fn assert_straight_growth(machine: &DeadReckoning) {
    let StraightGrowth { durations, along, across, along_first_order, across_first_order, crossing } =
        machine.straight_growth();
    for curve in [&durations, &along, &across, &along_first_order, &across_first_order] {
        laws::assert_finite("straight", curve);
        assert!(curve.len() == durations.len() && curve.iter().all(|variance| *variance >= 0.0), "{curve:?}");
    }
    assert!(crossing.is_none_or(|crossing| crossing.is_finite() && crossing > 0.0), "{crossing:?}");
}

fn assert_outlines(machine: &DeadReckoning, step: u32) {
    let settings = machine.settings();
    let Some(outlines) = machine.outlines(step) else {
        assert!(step > settings.steps);
        return;
    };
    let Outlines { ellipse, exponential, predicted, measured } = outlines;
    for outline in [&ellipse, &exponential, &predicted, &measured] {
        laws::assert_finite("an outline", outline.as_flattened());
        assert_eq!(outline.first(), outline.last(), "an outline is closed");
    }
    let none = machine.predicted(settings.compounding)[step as usize - 1].is_none();
    assert!([&ellipse, &exponential, &predicted].iter().all(|outline| outline.is_empty() == none));
    assert_eq!(measured.is_empty(), machine.shown() < 2);
}

/// Asserts that the path of one robot has the poses that the steps show.
fn assert_rollout(machine: &DeadReckoning, index: usize) {
    let Some(way) = machine.rollout(index) else {
        assert!(index >= machine.shown());
        return;
    };
    assert_eq!(way.len(), machine.settings().steps as usize);
    laws::assert_finite("a way", way.as_flattened());
    for (step, pose) in (1..).zip(&way) {
        assert!(machine.poses(step).get(index).is_none_or(|shown| shown == pose), "{index} at {step}");
    }
}

fn assert_nearest(machine: &DeadReckoning, input: &mut Input) {
    let target = [0; 2].map(|_| input.number());
    let radius = input.within(0.0..=f64::INFINITY);
    let Some(index) = machine.nearest(target, radius) else { return };
    let poses = machine.poses(machine.settings().step);
    let away = |[x, y, _]: &[f64; 3]| ((x - target[0]) / radius).hypot((y - target[1]) / radius);
    let least = poses.iter().map(away).fold(f64::INFINITY, f64::min);
    // A square of a distance below 1e-154 of the radius is 0.
    let found = away(&poses[index]);
    assert!(found <= least * (1.0 + 1e-9) + 1e-150 && found <= 1.0 + 1e-9, "{target:?} {radius}: {index}");
}
