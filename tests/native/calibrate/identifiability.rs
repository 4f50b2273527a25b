//! α's that are not identifiable from a log: the reason, and a drive that identifies them.

use super::simulated::{ALPHAS, MODELS, Simulation};
use super::{NAV2, calibrate_log, calibrate_simulation};
use motion::calibrate::NotIdentifiable::{
    self, Collinear, InsufficientRotation, InsufficientTranslation, ReferenceTooNoisy,
};
use motion::calibrate::{Calibration, Model, Options, Verdict};

/// Function from the index of a leg to its v and ω.
type VelocityOfLeg = fn(usize) -> [f64; 2];

/// Returns the calibration of the log of a drive.
fn calibrate_drive(model: Model, drive: VelocityOfLeg) -> Calibration {
    calibrate_simulation(&Simulation { leg_velocity: Some(drive), ..Simulation::of(model, 400, 17) })
}

/// v and ω of a straight leg.
const STRAIGHT_LEG: [f64; 2] = [0.3, 0.0];
/// v and ω of a turn on the spot.
const SPIN_LEG: [f64; 2] = [0.0, 0.6];
/// v and ω of a bend.
const BEND_LEG: [f64; 2] = [0.2, 0.8];

const NO_TURNS: Option<NotIdentifiable> = Some(InsufficientRotation);
const NO_DISTANCE: Option<NotIdentifiable> = Some(InsufficientTranslation);

/// Drive that does not identify all α's, with the reason for each.
struct IncompleteDrive {
    name: &'static str,
    drive: VelocityOfLeg,
    odometry: [Option<NotIdentifiable>; 5],
    velocity: [Option<NotIdentifiable>; 6],
    /// Drives with fifty legs of the missing motion: for odometry models, and for the velocity model, which does not use turns on the spot.
    complete: [VelocityOfLeg; 2],
}

const INCOMPLETE_DRIVES: [IncompleteDrive; 3] = [
    IncompleteDrive {
        name: "straight",
        drive: |_| STRAIGHT_LEG,
        odometry: [NO_TURNS, None, None, NO_TURNS, None],
        velocity: [None, NO_TURNS, None, NO_TURNS, None, NO_TURNS],
        complete: [
            |leg| if leg.is_multiple_of(8) { SPIN_LEG } else { STRAIGHT_LEG },
            |leg| if leg.is_multiple_of(8) { BEND_LEG } else { STRAIGHT_LEG },
        ],
    },
    IncompleteDrive {
        name: "on the spot",
        drive: |_| SPIN_LEG,
        odometry: [None, NO_DISTANCE, NO_DISTANCE, None, NO_DISTANCE],
        velocity: [NO_DISTANCE, None, NO_DISTANCE, NO_TURNS, NO_DISTANCE, NO_TURNS],
        complete: [
            |leg| if leg.is_multiple_of(8) { STRAIGHT_LEG } else { SPIN_LEG },
            |leg| {
                [SPIN_LEG, STRAIGHT_LEG, BEND_LEG, STRAIGHT_LEG, BEND_LEG, STRAIGHT_LEG, BEND_LEG, BEND_LEG]
                    [leg % 8]
            },
        ],
    },
    // The radii of the bends differ by a few percent only.
    IncompleteDrive {
        name: "one bend",
        drive: |leg| [0.3, if leg.is_multiple_of(2) { 0.29 } else { 0.31 }],
        odometry: [Some(Collinear); 5],
        velocity: [Some(Collinear); 6],
        complete: [
            |leg| [[0.3, 0.3], STRAIGHT_LEG, [0.3, 0.3], SPIN_LEG][leg % 4],
            |leg| [[0.3, 0.3], STRAIGHT_LEG, [0.3, 0.3], BEND_LEG][leg % 4],
        ],
    },
];

#[test]
fn incomplete_drives_give_the_reason_and_complete_ones_identify_all_alphas() {
    assert_reasons(&[NAV2, Model::Velocity]);
}

#[test]
#[ignore = "nightly: 30 calibrations"]
fn incomplete_drives_give_the_reason_for_every_model() {
    assert_reasons(&MODELS);
}

fn assert_reasons(models: &[Model]) {
    let (mut covered_count, mut interval_count) = (0, 0);
    for &model in models {
        for IncompleteDrive { name, drive, odometry, velocity, complete } in &INCOMPLETE_DRIVES {
            let uses_commands = model == Model::Velocity;
            let expected_reasons: &[_] = if uses_commands { velocity } else { odometry };
            let calibration = calibrate_drive(model, *drive);
            assert_eq!(calibration.not_identifiable, expected_reasons[..model.alphas()], "{model:?} {name}");
            for (k, reason) in calibration.not_identifiable.iter().enumerate() {
                let is_estimated = [calibration.alphas[k].is_some(), calibration.intervals[k].is_some()];
                assert_eq!(is_estimated, [reason.is_none(); 2], "{model:?} {name}: α{}", k + 1);
            }
            let complete_calibration = calibrate_drive(model, complete[usize::from(uses_commands)]);
            assert!(complete_calibration.not_identifiable.iter().all(Option::is_none), "{model:?} {name}");
            for (interval, truth) in complete_calibration.intervals.iter().zip(ALPHAS) {
                let [low, high] = interval.expect("identifiable");
                covered_count += u32::from((low..=high).contains(&truth));
                interval_count += 1;
            }
        }
    }
    // Three standard errors of a fraction of 0.95 are allowed.
    let covered_fraction = f64::from(covered_count) / f64::from(interval_count);
    let standard_error = (0.95 * 0.05 / f64::from(interval_count)).sqrt();
    assert!(covered_fraction > 0.95 - 3.0 * standard_error, "{covered_fraction}");
}

/// The reference noise is set to 100 m and 100 rad. An α of 1 adds only about 0.3 m and 0.3 rad of noise to a leg.
#[test]
fn a_reference_that_hides_the_noise_of_the_wheels_is_too_noisy() {
    let sim = Simulation::of(NAV2, 400, 32);
    let options = Options { position_std: Some(100.0), yaw_std: Some(100.0), ..sim.calibration_options() };
    let calibration = calibrate_log(&sim.log(), &options);
    assert_eq!(calibration.not_identifiable, [Some(ReferenceTooNoisy); 4]);
    assert_eq!(calibration.diagnostics.verdict, Verdict::Unusable);
}
