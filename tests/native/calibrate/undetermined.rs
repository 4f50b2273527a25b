//! Alphas that a log does not determine, the reason given, and the drive that determines them.

use super::simulated::{ALPHAS, MODELS, Simulation};
use crate::common::KINDS;
use motion::NoiseKind;
use motion::calibrate::Undetermined::{DrivesTooLittle, OneRatio, TurnsTooLittle};
use motion::calibrate::{Calibration, Estimate, Model, Robust, Undetermined, calibrate};

const LEGS: usize = 400;

fn calibrated(model: Model, noise: NoiseKind, drive: fn(usize) -> [f64; 2]) -> Calibration {
    let simulation = Simulation { drive: Some(drive), ..Simulation::of(model, noise, LEGS, 17) };
    let [odometry, reference] = simulation.log();
    calibrate(&odometry, &reference, &simulation.options(Robust::No)).expect("legs enough")
}

const STRAIGHT: [f64; 2] = [0.3, 0.0];
const ON_THE_SPOT: [f64; 2] = [0.0, 0.6];
const BEND: [f64; 2] = [0.2, 0.8];

/// A drive that lacks something, and what each α lacks then.
struct Drive {
    lacking: fn(usize) -> [f64; 2],
    of_odometry: [Option<Undetermined>; 5],
    of_velocity: [Option<Undetermined>; 6],
    /// With an eighth of it as advised, fifty times; the second under the velocity model, of which turns on the spot tell no
    /// executed turn.
    advised: [fn(usize) -> [f64; 2]; 2],
}

const NEVER_TURNS: Drive = Drive {
    lacking: |_| STRAIGHT,
    of_odometry: [Some(TurnsTooLittle), None, None, Some(TurnsTooLittle), None],
    of_velocity: [None, Some(TurnsTooLittle), None, Some(TurnsTooLittle), None, Some(TurnsTooLittle)],
    advised: [
        |leg| if leg.is_multiple_of(8) { ON_THE_SPOT } else { STRAIGHT },
        |leg| if leg.is_multiple_of(8) { BEND } else { STRAIGHT },
    ],
};

const NEVER_DRIVES: Drive = Drive {
    lacking: |_| ON_THE_SPOT,
    of_odometry: [None, Some(DrivesTooLittle), Some(DrivesTooLittle), None, Some(DrivesTooLittle)],
    of_velocity: [
        Some(DrivesTooLittle),
        None,
        Some(DrivesTooLittle),
        Some(DrivesTooLittle),
        Some(DrivesTooLittle),
        Some(DrivesTooLittle),
    ],
    advised: [
        |leg| if leg.is_multiple_of(8) { STRAIGHT } else { ON_THE_SPOT },
        |leg| [ON_THE_SPOT, STRAIGHT, BEND, STRAIGHT, BEND, STRAIGHT, BEND, BEND][leg % 8],
    ],
};

/// Held to a few hundredths.
const BENDS: Drive = Drive {
    lacking: |leg| [0.3, if leg.is_multiple_of(2) { 0.29 } else { 0.31 }],
    of_odometry: [Some(OneRatio); 5],
    of_velocity: [Some(OneRatio); 6],
    advised: [
        |leg| [[0.3, 0.3], STRAIGHT, [0.3, 0.3], ON_THE_SPOT][leg % 4],
        |leg| [[0.3, 0.3], STRAIGHT, [0.3, 0.3], BEND][leg % 4],
    ],
};

#[test]
fn each_log_names_the_missing_drive_and_adding_it_determines_all_alphas() {
    let [mut covered, mut intervals] = [0, 0];
    // Three of the rules say the same of such drives.
    for (i, model) in [MODELS[0], MODELS[3], MODELS[4]].into_iter().enumerate() {
        let noise = KINDS[i % 2];
        for (name, drive) in [("straight", NEVER_TURNS), ("on the spot", NEVER_DRIVES), ("bends", BENDS)] {
            let by_commands = model == Model::Velocity;
            let expected: &[_] = if by_commands { &drive.of_velocity } else { &drive.of_odometry };
            let told = calibrated(model, noise, drive.lacking);
            assert_eq!(told.undetermined, expected[..model.alphas()], "{model:?} {noise:?} {name}");
            for (k, reason) in told.undetermined.iter().enumerate() {
                let Estimate { alphas, intervals, .. } = &told.estimate;
                let told = [!alphas[k].is_nan(), intervals[k].is_some(), told.bootstrap[k].is_some()];
                assert_eq!(told, [reason.is_none(); 3], "{model:?} {noise:?} {name}: α{}", k + 1);
            }
            let all = calibrated(model, noise, drive.advised[usize::from(by_commands)]);
            assert!(all.undetermined.iter().all(Option::is_none), "{model:?} {noise:?} {name}: {all:?}");
            for (interval, real) in all.estimate.intervals.iter().zip(ALPHAS) {
                let [from, to] = interval.expect("determined");
                covered += u32::from((from..=to).contains(&real));
                intervals += 1;
            }
        }
    }
    // A share of 0.95 of 45 intervals has the deviation 0.032, and is allowed three.
    let share = f64::from(covered) / f64::from(intervals);
    assert!(share > 0.95 - 3.0 * 0.032, "{share}");
}
