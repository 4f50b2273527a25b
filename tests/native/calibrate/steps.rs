//! How much a calibration does in one step: legs gone through, for these are the same on every machine.

use super::simulated::{MODELS, Simulation};
use motion::NoiseKind;
use motion::calibrate::{Calibrating, Options, ReferenceError, Robust};

const NOISES: [NoiseKind; 2] = [NoiseKind::Normal, NoiseKind::Triangular];

/// Of a good motion capture.
const STATED: ReferenceError = ReferenceError { position: 1e-3, heading: 2e-3 };

/// To normal noise it makes no difference.
fn stated_or_not(noise: NoiseKind) -> Vec<ReferenceError> {
    let stated = (noise == NoiseKind::Triangular).then_some(STATED);
    std::iter::once(ReferenceError::default()).chain(stated).collect()
}

/// The most legs that one step goes through, fifty nanoseconds each, on a log with bad legs or a perfect one.
fn longest_step(simulation: &Simulation, perfect: bool, options: Options) -> usize {
    let [odometry, reference] = simulation.log();
    let reference = if perfect { odometry.clone() } else { reference };
    let mut calibrating = Calibrating::new(options);
    let (mut most, mut progress) = (0, 0.0);
    loop {
        let before = calibrating.work();
        let done = calibrating.step(&odometry, &reference).expect("it has legs enough").is_some();
        most = most.max(calibrating.work() - before);
        if done {
            return most;
        }
        assert!((progress..1.0).contains(&calibrating.progress()), "{}", calibrating.progress());
        progress = calibrating.progress();
    }
}

#[test]
#[ignore = "nightly: 180 calibrations"]
fn no_step_goes_through_many_legs() {
    for model in MODELS {
        for noise in NOISES {
            for (robust, jumps) in [(Robust::No, 0.0), (Robust::Estimated, 0.0), (Robust::Estimated, 0.01)] {
                for perfect in [false, true] {
                    for count in [500, 10_000] {
                        let simulation = Simulation { jumps, ..Simulation::of(model, noise, count, 7) };
                        for reference_error in stated_or_not(noise) {
                            let options =
                                Options { reference_error, by_length: true, ..simulation.options(robust) };
                            let most = longest_step(&simulation, perfect, options);
                            let what = format!(
                                "{model:?} {noise:?} {robust:?} {jumps} {perfect} {count} {reference_error:?}"
                            );
                            assert!(most <= 1_000_000, "{what}: {most}");
                        }
                    }
                }
            }
        }
    }
}
