//! α's that are not identifiable from a log: the reason, and a drive that identifies them.

use super::simulated::{ALPHAS, MODELS, Simulation};
use super::{NAV2, calibrate_log, calibrate_simulation};
use motion::calibrate::NotIdentifiable::{
    self, Collinear, InsufficientRotation, InsufficientTranslation, ReferenceTooNoisy,
};
use motion::calibrate::{Calibration, Model, Options, Verdict};

type VelocityOfLeg = fn(usize) -> [f64; 2];

fn calibrate_velocities(model: Model, velocity_of_leg: VelocityOfLeg) -> Calibration {
    calibrate_simulation(&Simulation {
        velocity_of_leg: Some(velocity_of_leg),
        ..Simulation::new(model, 400, 17)
    })
}

/// v and ω of a straight leg, of a turn on the spot, and of a bend.
const STRAIGHT_LEG: [f64; 2] = [0.3, 0.0];
const SPIN_LEG: [f64; 2] = [0.0, 0.6];
const BEND_LEG: [f64; 2] = [0.2, 0.8];

const LACKS_TURNS: Option<NotIdentifiable> = Some(InsufficientRotation);
const LACKS_DISTANCE: Option<NotIdentifiable> = Some(InsufficientTranslation);

/// Drive from which some α's are not identifiable, with the reason for each of them.
struct IncompleteDrive {
    drive_name: &'static str,
    velocity_of_leg: VelocityOfLeg,
    odometry_reasons: [Option<NotIdentifiable>; 5],
    velocity_reasons: [Option<NotIdentifiable>; 6],
    /// Drives with fifty additional legs, which identify all α's. The first drive is for odometry models. The second is for the velocity
    /// model, which does not use turns on the spot.
    completed_drives: [VelocityOfLeg; 2],
}

const INCOMPLETE_DRIVES: [IncompleteDrive; 3] = [
    IncompleteDrive {
        drive_name: "straight",
        velocity_of_leg: |_| STRAIGHT_LEG,
        odometry_reasons: [LACKS_TURNS, None, None, LACKS_TURNS, None],
        velocity_reasons: [None, LACKS_TURNS, None, LACKS_TURNS, None, LACKS_TURNS],
        completed_drives: [
            |leg_index| if leg_index.is_multiple_of(8) { SPIN_LEG } else { STRAIGHT_LEG },
            |leg_index| if leg_index.is_multiple_of(8) { BEND_LEG } else { STRAIGHT_LEG },
        ],
    },
    IncompleteDrive {
        drive_name: "on the spot",
        velocity_of_leg: |_| SPIN_LEG,
        odometry_reasons: [None, LACKS_DISTANCE, LACKS_DISTANCE, None, LACKS_DISTANCE],
        velocity_reasons: [LACKS_DISTANCE, None, LACKS_DISTANCE, LACKS_TURNS, LACKS_DISTANCE, LACKS_TURNS],
        completed_drives: [
            |leg_index| if leg_index.is_multiple_of(8) { STRAIGHT_LEG } else { SPIN_LEG },
            |leg_index| {
                [SPIN_LEG, STRAIGHT_LEG, BEND_LEG, STRAIGHT_LEG, BEND_LEG, STRAIGHT_LEG, BEND_LEG, BEND_LEG]
                    [leg_index % 8]
            },
        ],
    },
    IncompleteDrive {
        drive_name: "one bend",
        velocity_of_leg: |leg_index| [0.3, if leg_index.is_multiple_of(2) { 0.29 } else { 0.31 }],
        odometry_reasons: [Some(Collinear); 5],
        velocity_reasons: [Some(Collinear); 6],
        completed_drives: [
            |leg_index| [[0.3, 0.3], STRAIGHT_LEG, [0.3, 0.3], SPIN_LEG][leg_index % 4],
            |leg_index| [[0.3, 0.3], STRAIGHT_LEG, [0.3, 0.3], BEND_LEG][leg_index % 4],
        ],
    },
];

#[test]
fn incomplete_drives_give_reasons_and_complete_drives_identify_all_alphas() {
    assert_reasons_and_intervals(&[NAV2, Model::Velocity]);
}

#[test]
#[ignore = "nightly: 30 calibrations"]
fn incomplete_drives_give_reasons_under_every_model() {
    assert_reasons_and_intervals(&MODELS);
}

fn assert_reasons_and_intervals(models: &[Model]) {
    let (mut covered_count, mut interval_count) = (0, 0);
    for &model in models {
        for drive in &INCOMPLETE_DRIVES {
            let is_velocity_model = model == Model::Velocity;
            let expected_reasons: &[_] =
                if is_velocity_model { &drive.velocity_reasons } else { &drive.odometry_reasons };
            let calibration = calibrate_velocities(model, drive.velocity_of_leg);
            let case_name = format!("{model:?} {}", drive.drive_name);
            assert_eq!(calibration.not_identifiable, expected_reasons[..model.alpha_count()], "{case_name}");
            for (k, missing_reason) in calibration.not_identifiable.iter().enumerate() {
                let has_alpha_and_interval =
                    [calibration.alphas[k].is_some(), calibration.intervals[k].is_some()];
                assert_eq!(has_alpha_and_interval, [missing_reason.is_none(); 2], "{case_name}: α{}", k + 1);
            }
            let calibration_of_complete =
                calibrate_velocities(model, drive.completed_drives[usize::from(is_velocity_model)]);
            assert!(calibration_of_complete.not_identifiable.iter().all(Option::is_none), "{case_name}");
            for (alpha_interval, true_alpha) in calibration_of_complete.intervals.iter().zip(ALPHAS) {
                let [interval_low, interval_high] = alpha_interval.expect("identifiable");
                covered_count += u32::from((interval_low..=interval_high).contains(&true_alpha));
                interval_count += 1;
            }
        }
    }
    // The fraction of intervals that contain the true α may be below 0.95 by three standard errors.
    let covered_fraction = f64::from(covered_count) / f64::from(interval_count);
    let standard_error = (0.95 * 0.05 / f64::from(interval_count)).sqrt();
    assert!(covered_fraction > 0.95 - 3.0 * standard_error, "{covered_fraction}");
}

/// The reference noise is set to 100 m and 100 rad. An α of 1 adds only about 0.3 m and 0.3 rad of noise to a leg.
#[test]
fn a_reference_that_hides_the_noise_of_the_wheels_is_too_noisy() {
    let simulation = Simulation::new(NAV2, 400, 32);
    let known_noise_options =
        Options { position_std: Some(100.0), yaw_std: Some(100.0), ..simulation.calibration_options() };
    let calibration = calibrate_log(&simulation.simulate_log(), &known_noise_options);
    assert_eq!(calibration.not_identifiable, [Some(ReferenceTooNoisy); 4]);
    assert_eq!(calibration.diagnostics.verdict, Verdict::Unusable);
}
