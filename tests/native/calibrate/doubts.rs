//! Verdicts, inflation curves and the block bootstrap of simulated logs.

use super::simulated::{ALPHAS, Simulation, Unlike};
use motion::NoiseKind;
use motion::calibrate::{Calibration, Inflation, Model, Robust, Verdict, calibrate};
use motion::models::OdometryRule;

const OMNI: Model = Model::Odometry(OdometryRule::Omni);

fn calibrated(simulation: &Simulation, robust: Robust) -> Calibration {
    let [odometry, reference] = simulation.log();
    calibrate(&odometry, &reference, &simulation.options(robust)).expect("legs enough")
}

/// Of so many logs that are made alike, how many get a verdict.
fn verdicts(made: Simulation, logs: u64, verdict: Verdict) -> usize {
    let of = |seed| calibrated(&Simulation { seed, ..made }, Robust::No).doubts.verdict;
    (0..logs).filter(|seed| of(300 + seed) == verdict).count()
}

#[test]
fn each_verdict_comes_from_a_matching_log() {
    // Chance gives one log in twenty another verdict.
    const LOGS: u64 = 3;
    let noise = |unlike, count| Simulation { unlike, ..Simulation::of(OMNI, NoiseKind::Normal, count, 0) };
    let later = |times: fn(f64) -> f64| noise(Unlike::Changing(times), 1000);
    for (name, made, verdict) in [
        ("90 legs", noise(Unlike::Nothing, 90), Verdict::FewLegs),
        ("of the model", noise(Unlike::Nothing, 1000), Verdict::Fits),
        ("Student's t", noise(Unlike::Tails(5), 1000), Verdict::HeavyTails),
        ("a bias that drifts", noise(Unlike::Autoregressive(0.95), 1000), Verdict::Correlated),
        // Of a mixture the kurtosis would be 4.1: that is no tail.
        (
            "twice as large from the middle on",
            later(|course| if course < 0.5 { 1.0 } else { 2.0 }),
            Verdict::Overconfident,
        ),
        ("smaller from the middle on", later(|course| if course < 0.5 { 1.3 } else { 1.0 }), Verdict::Lazy),
    ] {
        let count = verdicts(made, LOGS, verdict);
        assert!(count >= 2, "{name}: {verdict:?} in {count} of {LOGS}");
    }
}

#[test]
fn a_first_half_without_turns_gives_no_verdict_on_turns() {
    // Straight on at first, and then with turns, which need α's that nobody could know by then.
    for model in [OMNI, Model::Odometry(OdometryRule::Nav2), Model::Velocity] {
        let made = Simulation { straight: 0.5, ..Simulation::of(model, NoiseKind::Normal, 800, 5) };
        let told = calibrated(&made, Robust::No);
        assert_eq!(told.doubts.held_out.coverage_interval, [0.0, 1.0], "{model:?}");
        assert_eq!(told.doubts.verdict, Verdict::Fits, "{model:?}");
        // With the turns all through the log it says something.
        let [from, to] =
            calibrated(&Simulation { straight: 0.0, ..made }, Robust::No).doubts.held_out.coverage_interval;
        assert!(0.92 < from && from < 0.95 && 0.95 < to && to < 0.98, "{model:?}: {from} to {to}");
    }
}

/// The factor under which the held-out half is likeliest.
fn likeliest(Inflation { log_likelihood, .. }: &Inflation) -> usize {
    (0..log_likelihood.len()).max_by(|a, b| log_likelihood[*a].total_cmp(&log_likelihood[*b])).expect("some")
}

#[test]
fn coverage_and_likelihood_show_alphas_that_are_too_small_or_too_large() {
    for model in [OMNI, Model::Velocity] {
        // Of 12,000 residuals in two halves the logarithm of their variances has a deviation of √(2/3000 + 2/3000) at most: a fifth
        // of the way to the next factor, 10^(1/12).
        let told = calibrated(&Simulation::of(model, NoiseKind::Normal, 4000, 21), Robust::No);
        let Inflation { factors, coverage, log_likelihood } = &told.inflation;
        assert_eq!((factors.len(), factors[12]), (25, 1.0), "{model:?}");
        assert_eq!(likeliest(&told.inflation), 12, "{model:?}");
        assert_eq!(coverage[12], told.doubts.held_out.coverage, "{model:?}");
        assert!(coverage.is_sorted(), "{model:?}");
        let [from, to] = told.doubts.held_out.coverage_interval;
        for k in (0..25).filter(|k| *k != 12) {
            let (share, there) = (coverage[k], log_likelihood[k]);
            assert!(there < log_likelihood[12], "{model:?}, times {}: {there}", factors[k]);
            // Three factors away the share is outside of where it belongs, on the side that tells what is wrong.
            assert!(k > 9 || share < from, "{model:?}, times {}: {share}", factors[k]);
            assert!(k < 15 || share > to, "{model:?}, times {}: {share}", factors[k]);
        }
    }
}

#[test]
#[ignore = "nightly: 180 calibrations"]
fn the_block_bootstrap_covers_correlated_legs() {
    // Each α of each log is one of 300 intervals, whose share has a deviation of 0.03 at most.
    const LOGS: u64 = 60;
    let shares = |unlike| {
        let [mut profile, mut bootstrap] = [0.0; 2];
        for seed in 0..LOGS {
            let made = Simulation { unlike, ..Simulation::of(OMNI, NoiseKind::Normal, 1000, 700 + seed) };
            let told = calibrated(&made, Robust::No);
            for (k, real) in ALPHAS.iter().enumerate().take(5) {
                let within = |interval: Option<[f64; 2]>| {
                    let [from, to] = interval.expect("known");
                    f64::from(u8::from((from..=to).contains(real))) / (5.0 * LOGS as f64)
                };
                profile += within(told.estimate.intervals[k]);
                bootstrap += within(told.bootstrap[k]);
            }
        }
        [profile, bootstrap]
    };
    // Where they have nothing in common both are right: a deviation of 0.013 about 0.95, of which three are allowed. The bootstrap's are
    // never shorter.
    let [profile, bootstrap] = shares(Unlike::Nothing);
    assert!(profile > 0.91 && bootstrap >= profile, "{profile} {bootstrap}");
    // Of tails that are heavy alone too; what takes legs for normal falls short by a fifth.
    let [profile, bootstrap] = shares(Unlike::Tails(5));
    assert!(bootstrap > 0.9 && profile < 0.85, "{profile} {bootstrap}");
    // Where their squares have something in common over more than a block, the bootstrap falls short by an eighth or so, what takes legs for
    // independent by far more.
    let [profile, bootstrap] = shares(Unlike::Wandering(1.0));
    assert!(bootstrap > profile + 0.2 && bootstrap > 0.75, "{profile} {bootstrap}");
}
