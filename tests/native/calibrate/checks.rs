//! Diagnostic checks of a calibration. Each check fails on a log that violates its assumption. All checks pass on good logs.

use super::simulated::{MODELS, Simulation, Violation};
use super::{NAV2, add_step_noise, calibrate_log, calibrate_simulation, new_trajectory};
use crate::common::seeded_rng;
use motion::calibrate::CheckName::{self, *};
use motion::calibrate::{
    Calibration, Drive, FailureCause, LegLength, Model, Options, Outliers, Systematic, SystematicError,
    Trajectory, Verdict, calibrate,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::{NoiseKind, Variance};
use nalgebra::Vector3;

fn new_passing_simulation(leg_count: usize, seed: u64) -> Simulation {
    Simulation::new(NAV2, leg_count, seed)
}

fn failed_check_names_of(calibration: &Calibration) -> Vec<CheckName> {
    let failed_check_names =
        calibration.diagnostics.checks.iter().filter(|diagnostic_check| !diagnostic_check.passed);
    failed_check_names.map(|check| check.name).collect()
}

/// Asserts that a check fails with a message, and that the verdict is `Questionable`.
fn assert_fails(check_name: CheckName, calibration: &Calibration) {
    let failed_check_names = failed_check_names_of(calibration);
    assert!(failed_check_names.contains(&check_name), "{check_name:?} is not among {failed_check_names:?}");
    assert!(calibration.diagnostics.checks.iter().all(|check| check.passed == check.message.is_empty()));
    assert_eq!(calibration.diagnostics.verdict, Verdict::Questionable, "{check_name:?}");
    let recommended_alphas = calibration.recommended.as_ref().expect("it is usable");
    assert!(recommended_alphas.inflation >= 1.0 && !recommended_alphas.reason.is_empty());
}

fn assert_unusable(calibration: &Calibration, case_description: &str) {
    assert_eq!(
        (calibration.diagnostics.verdict, &calibration.recommended),
        (Verdict::Unusable, &None),
        "{case_description}"
    );
}

fn change_poses(trajectory: &Trajectory, mut change_pose: impl FnMut(SE2) -> SE2) -> Trajectory {
    new_trajectory(trajectory.samples().map(|(sample_time, old_pose)| (sample_time, change_pose(old_pose))))
}

#[test]
fn a_reference_with_other_units_or_axes_or_of_another_drive_is_unusable() {
    let sim = new_passing_simulation(600, 1);
    let [odometry, reference] = sim.simulate_log();
    let [_, other_reference] = new_passing_simulation(600, 2).simulate_log();
    type PoseChange = fn(SE2) -> SE2;
    let pose_changes: [(&str, PoseChange); 8] = [
        ("degrees", |pose| SE2::new(pose.x(), pose.y(), pose.theta().to_degrees())),
        ("y up", |pose| SE2::new(pose.x(), 0.1, 0.0)),
        ("mirrored", |pose| SE2::new(-pose.x(), pose.y(), pose.theta())),
        ("columns swapped", |pose| SE2::new(pose.y(), pose.x(), pose.theta())),
        ("a height instead of y", |pose| SE2::new(pose.x(), 0.1, pose.theta())),
        ("millimetres", |pose| SE2::new(1e3 * pose.x(), 1e3 * pose.y(), pose.theta())),
        ("feet", |pose| SE2::new(pose.x() / 0.3048, pose.y() / 0.3048, pose.theta())),
        ("odometry in feet", |pose| SE2::new(0.3048 * pose.x(), 0.3048 * pose.y(), pose.theta())),
    ];
    let corrupted_references = pose_changes
        .map(|(corruption_name, change_pose)| (corruption_name, change_poses(&reference, change_pose)));
    for (corruption_name, reference) in
        corrupted_references.into_iter().chain([("another drive", other_reference)])
    {
        let calibration = calibrate_log(&[odometry.clone(), reference], &sim.calibration_options());
        assert!(failed_check_names_of(&calibration).contains(&ReferenceMatches), "{corruption_name}");
        assert_unusable(&calibration, corruption_name);
    }
}

#[test]
fn a_reference_that_turns_the_other_way_is_recognized_at_any_clock_offset() {
    for (seed, clock_offset) in [(1, 0.0), (2, -3.7), (3, 3600.0)] {
        let sim = new_passing_simulation(600, seed);
        let [odometry, reference] = sim.simulate_log();
        let mirrored_reference = reference.samples().map(|(sample_time, pose)| {
            (sample_time + clock_offset, SE2::new(pose.x(), -pose.y(), -pose.theta()))
        });
        let calibration =
            calibrate_log(&[odometry, new_trajectory(mirrored_reference)], &sim.calibration_options());
        let check = &calibration.diagnostics.checks[0];
        assert_eq!(check.cause, Some(FailureCause::Mirrored), "{seed}: {check:?}");
        assert_unusable(&calibration, "mirrored");
    }
}

#[test]
fn one_bad_drive_of_two_is_recognized() {
    let [consistent_log, [odometry, reference], [_, other_reference]] =
        [(1200, 1), (60, 2), (60, 3)].map(|(legs, seed)| new_passing_simulation(legs, seed).simulate_log());
    let mirrored_reference = change_poses(&reference, |pose| SE2::new(pose.x(), -pose.y(), -pose.theta()));
    for (reference, failure_cause) in
        [(mirrored_reference, Some(FailureCause::Mirrored)), (other_reference, None)]
    {
        let checked_logs = [consistent_log.clone(), [odometry.clone(), reference]];
        let checked_drives = checked_logs.map(|[odometry, reference]| Drive { odometry, reference });
        let calibration =
            calibrate(&checked_drives, &new_passing_simulation(0, 0).calibration_options()).unwrap();
        let check = &calibration.diagnostics.checks[0];
        assert_eq!((check.cause, &check.drives), (failure_cause, &vec![1]));
    }
}

/// The robot drives along a figure of eight, half of which takes 20 s, and the clocks differ by 20 s. At equal times the odometry therefore turns right
/// where the reference turns left.
#[test]
fn a_drive_along_an_eight_is_not_called_mirrored() {
    let sim = Simulation {
        systematic_errors: Systematic { clock_offset: 20.0, ..Systematic::NONE },
        velocity_of_leg: Some(|leg_index| {
            [0.3, if leg_index < 30 { 0.0 } else { [0.4, -0.4][leg_index / 40 % 2] }]
        }),
        ..new_passing_simulation(600, 1)
    };
    let calibration = calibrate_simulation(&sim);
    assert!(
        (calibration.systematic.clock_offset - 20.0).abs() < 0.1,
        "{}",
        calibration.systematic.clock_offset
    );
    assert!(!failed_check_names_of(&calibration).contains(&ReferenceMatches));
}

/// This reference differs from the odometry by twice the driven distance, just as a mirrored reference differs by twice the turns.
#[test]
fn a_reference_three_times_as_long_is_not_called_mirrored() {
    let sim = new_passing_simulation(600, 1);
    let [odometry, reference] = sim.simulate_log();
    let three_times_as_long =
        change_poses(&reference, |pose| SE2::new(3.0 * pose.x(), 3.0 * pose.y(), pose.theta()));
    let calibration = calibrate_log(&[odometry, three_times_as_long], &sim.calibration_options());
    let check = &calibration.diagnostics.checks[0];
    assert!((check.value - 2.0).abs() < 0.1, "{check:?}");
    assert_eq!(check.cause, None, "{check:?}");
    assert_unusable(&calibration, "three times as long");
}

#[test]
fn a_copy_of_the_odometry_is_no_reference() {
    // Each reference is a copy of the odometry in another coordinate frame. Its lengths are scaled by 1.02, its times are delayed by 0.1 s,
    // and its coordinates are rounded.
    for (leg_count, decimal_count) in [(600, 6), (600, 3), (250, 3), (600, 2), (250, 2)] {
        let sim = new_passing_simulation(leg_count, 1);
        let [odometry, _] = sim.simulate_log();
        let round_to_decimals = |exact_coordinate: f64| {
            (exact_coordinate * 10_f64.powi(decimal_count)).round() / 10_f64.powi(decimal_count)
        };
        let copied_samples = odometry.samples().map(|(sample_time, pose)| {
            let transformed_pose =
                SE2::new(3.0, 1.0, 0.5) * SE2::new(1.02 * pose.x(), 1.02 * pose.y(), pose.theta());
            let [x, y, theta] =
                [transformed_pose.x(), transformed_pose.y(), transformed_pose.theta()].map(round_to_decimals);
            (sample_time + 0.1, SE2::new(x, y, theta))
        });
        let calibration =
            calibrate_log(&[odometry.clone(), new_trajectory(copied_samples)], &sim.calibration_options());
        let check = &calibration.diagnostics.checks[0];
        assert_eq!(
            check.cause,
            Some(FailureCause::Copied),
            "{leg_count} legs, {decimal_count} digits: {check:?}"
        );
        assert_unusable(&calibration, "a copy");
    }
    // The reference of a precise robot differs from the odometry by a millimetre and half a milliradian over a metre. This reference is not
    // taken for a copy.
    for seed in 1..=12 {
        for leg_count in [600, 200] {
            let violation = Violation::ScaledNoise(0.01);
            let precise_simulation =
                Simulation { noise_violation: violation, ..new_passing_simulation(leg_count, seed) };
            let failed_checks = failed_check_names_of(&calibrate_simulation(&precise_simulation));
            assert!(!failed_checks.contains(&ReferenceMatches), "{leg_count} legs, seed {seed}");
        }
        // Reference noise of 3 cm and 0.03 rad hides the noise of a precise robot, but not that of an ordinary robot.
        let noisy_simulation = Simulation { reference_stds: [0.03; 2], ..new_passing_simulation(100, seed) };
        let failed_checks = failed_check_names_of(&calibrate_simulation(&noisy_simulation));
        assert!(!failed_checks.contains(&ReferenceMatches), "noisy reference, seed {seed}");
    }
}

/// On legs of 3 cm and 0.05 rad, a good reference may differ from the odometry by its noise alone.
#[test]
fn legs_that_hardly_move_are_not_compared() {
    let leg_length = LegLength::Duration { duration: 1.0 };
    let slow_simulation =
        Simulation { leg_length, velocity_of_leg: Some(|_| [0.03, 0.05]), ..new_passing_simulation(200, 4) };
    let calibration = calibrate_simulation(&slow_simulation);
    let check_names: Vec<CheckName> = calibration.diagnostics.checks.iter().map(|check| check.name).collect();
    assert!(check_names.contains(&EnoughLegs) && !check_names.contains(&ReferenceMatches), "{check_names:?}");
}

#[test]
fn few_legs_are_questionable_and_fewer_unusable() {
    assert_fails(EnoughLegs, &calibrate_simulation(&new_passing_simulation(80, 3)));
    let fit_of_few_legs = calibrate_simulation(&new_passing_simulation(25, 3));
    assert!(failed_check_names_of(&fit_of_few_legs).contains(&EnoughLegs));
    assert_unusable(&fit_of_few_legs, "25 legs");
}

#[test]
fn lost_legs_are_reported() {
    let sim = new_passing_simulation(600, 4);
    let [odometry, reference] = sim.simulate_log();
    let reference_with_gaps =
        new_trajectory(reference.samples().filter(|(sample_time, _)| sample_time.rem_euclid(90.0) > 30.0));
    let calibration = calibrate_log(&[odometry, reference_with_gaps], &sim.calibration_options());
    assert_fails(LegsLost, &calibration);
    let causes = calibration.diagnostics.checks.iter().map(|check| check.cause);
    assert!(causes.into_iter().any(|cause| cause == Some(FailureCause::WithoutReference)));
}

#[test]
fn legs_that_are_longer_than_asked_for_are_reported() {
    let sim = new_passing_simulation(600, 5);
    let [odometry, reference] = sim.simulate_log();
    let sparse_reference = new_trajectory(reference.samples().step_by(40));
    assert_fails(SamplingDense, &calibrate_log(&[odometry, sparse_reference], &sim.calibration_options()));
}

/// Each of the three violations is large enough for its check. A tenth of the legs are outliers. Noise of Student's t distribution has a
/// kurtosis of 9 with five degrees of freedom, and an infinite one with four. If noise grows in the second half, the 95 % region of a fit to
/// the first half covers only two thirds of the legs in the second half.
#[test]
fn violations_of_the_model_are_reported() {
    let noise_factor_at: fn(f64) -> f64 = |fraction_of_log| if fraction_of_log < 0.5 { 1.0 } else { 1.5 };
    let simulate_violation =
        |violation, seed| Simulation { noise_violation: violation, ..new_passing_simulation(600, seed) };
    for (check_name, simulation) in [
        (OutliersFew, Simulation { jump_fraction: 0.1, ..new_passing_simulation(600, 6) }),
        (TailsNormal, simulate_violation(Violation::HeavyTailedNoise(4), 10)),
        (TailsNormal, simulate_violation(Violation::HeavyTailedNoise(5), 10)),
        (HoldoutCovered, simulate_violation(Violation::ChangingNoise(noise_factor_at), 11)),
    ] {
        assert_fails(check_name, &calibrate_simulation(&simulation));
    }
}

/// The fit to the half without the jump predicts too little noise. No inflation of the α's of this fit covers a jump of 10 m.
#[test]
fn a_log_that_no_inflation_covers_is_unusable() {
    let sim = new_passing_simulation(600, 12);
    let [odometry, reference] = sim.simulate_log();
    let jump_time = 0.75 * reference.span().expect("samples")[1];
    let jump_offset = SE2::new(10.0, 0.0, 0.0);
    let jumped_samples = reference.samples().map(|(sample_time, pose)| {
        (sample_time, if sample_time < jump_time { pose } else { jump_offset * pose })
    });
    let keep_options = Options { outliers: Outliers::Keep, ..sim.calibration_options() };
    let calibration = calibrate_log(&[odometry, new_trajectory(jumped_samples)], &keep_options);
    assert_eq!(failed_check_names_of(&calibration)[0], InflationBounded);
    assert_unusable(&calibration, "a jump");
}

/// Returns the calibration of a log whose odometry is divided by varying scales. `scale_at` returns the scales of distance and turn at a time
/// (as a fraction of the log) and a velocity.
fn calibrate_with_scales(sim: &Simulation, scale_at: impl Fn(f64, &Vector3<f64>) -> [f64; 2]) -> Calibration {
    let [odometry, reference] = sim.simulate_log();
    let odometry_rows: Vec<(f64, SE2)> = odometry.samples().collect();
    let log_duration = odometry_rows[odometry_rows.len() - 1].0;
    let mut odometry_pose = SE2::identity();
    let mut scaled_odometry = vec![(odometry_rows[0].0, odometry_pose)];
    for adjacent_rows in odometry_rows.windows(2) {
        let twist = adjacent_rows[1].1.boxminus(&adjacent_rows[0].1);
        let [distance_scale, turn_scale] =
            scale_at(adjacent_rows[1].0 / log_duration, &(twist / (adjacent_rows[1].0 - adjacent_rows[0].0)));
        odometry_pose =
            odometry_pose.boxplus(Vector3::new(twist.x / distance_scale, 0.0, twist.z / turn_scale));
        scaled_odometry.push((adjacent_rows[1].0, odometry_pose));
    }
    calibrate_log(&[new_trajectory(scaled_odometry), reference], &sim.calibration_options())
}

/// Noisy odometry, and the odometry of a point 5 cm ahead of the axle, move sideways in turns on the spot. Nav2's AMCL treats a leg of
/// less than a centimetre as a turn on the spot. Noise of a millimetre is therefore reported under Table 5.6, but not under the rule of Nav2.
#[test]
fn odometry_that_moves_sideways_is_reported_if_the_rule_takes_its_direction() {
    let sim = new_passing_simulation(600, 12);
    let [odometry, reference] = sim.simulate_log();
    let jitter_odometry = |jitter_std: f64| {
        let mut noise_rng = seeded_rng(12);
        let mut sample_noise_of =
            || NoiseKind::Normal.sample(Variance(jitter_std * jitter_std), &mut noise_rng);
        change_poses(&odometry, |pose| {
            SE2::new(pose.x() + sample_noise_of(), pose.y() + sample_noise_of(), pose.theta())
        })
    };
    let shifted_odometry = change_poses(&odometry, |pose| pose * SE2::new(0.05, 0.0, 0.0));
    let does_sideways_check_pass = |odometry: &Trajectory, model: Model| {
        let calibration = calibrate_log(
            &[odometry.clone(), reference.clone()],
            &Options { model, ..sim.calibration_options() },
        );
        let mut check_iter = calibration.diagnostics.checks.into_iter();
        let sideways_check = check_iter.find(|check| check.name == SidewaysRare);
        sideways_check
            .inspect(|check| assert_eq!(check.passed, check.message.is_empty()))
            .map(|check| check.passed)
    };
    let [table_5_6_model, omni_model] = [OdometryRule::Table, OdometryRule::Omni].map(Model::Odometry);
    for (odometry, model, should_pass) in [
        (&jitter_odometry(0.01), NAV2, Some(false)),
        (&shifted_odometry, NAV2, Some(false)),
        (&jitter_odometry(1e-3), table_5_6_model, Some(false)),
        (&jitter_odometry(1e-3), NAV2, Some(true)),
        (&shifted_odometry, omni_model, None),
        (&shifted_odometry, Model::Velocity, None),
    ] {
        assert_eq!(does_sideways_check_pass(odometry, model), should_pass, "{model:?}");
    }
    // Table 5.6 treats a backward drive as half a turn, a forward drive and half a turn.
    let reversing_simulation = Simulation {
        velocity_of_leg: Some(|leg_index| [if leg_index % 5 == 0 { -0.3 } else { 0.3 }, 0.2]),
        ..new_passing_simulation(300, 12)
    };
    let is_sideways_motion_reported = |model| {
        let calibration = calibrate_log(
            &reversing_simulation.simulate_log(),
            &Options { model, ..sim.calibration_options() },
        );
        failed_check_names_of(&calibration).contains(&SidewaysRare)
    };
    assert_eq!([table_5_6_model, NAV2].map(is_sideways_motion_reported), [true, false]);
}

/// Asserts that a check fails because a systematic error is not constant, and that the error is not corrected.
fn assert_not_constant(check_name: CheckName, error_kind: SystematicError, calibration: &Calibration) {
    assert_fails(check_name, calibration);
    assert!(!calibration.is_constant[error_kind as usize] && !calibration.is_corrected[error_kind as usize]);
}

/// The distance scale is 1 on straight legs and 0.85 on turning legs. Its estimates from straight legs and from turning legs have standard
/// errors of 0.01.
#[test]
fn a_distance_scale_that_differs_in_turns_is_no_constant() {
    let odometry_scales_at =
        |_, leg_velocity: &Vector3<f64>| [if leg_velocity.z.abs() > 0.05 { 0.85 } else { 1.0 }, 1.0];
    let calibration = calibrate_with_scales(&new_passing_simulation(600, 7), odometry_scales_at);
    assert_not_constant(DistanceScaleConstant, SystematicError::DistanceScale, &calibration);
}

/// The turn scales of the two halves of the log differ by 0.1. Their estimates have standard errors of a few hundredths.
#[test]
fn a_turn_scale_that_changes_with_time_is_no_constant() {
    let odometry_scales_at =
        |fraction_of_log: f64, _: &Vector3<f64>| [1.0, if fraction_of_log < 0.5 { 1.0 } else { 1.1 }];
    let calibration = calibrate_with_scales(&new_passing_simulation(600, 8), odometry_scales_at);
    assert_not_constant(TurnScaleConstant, SystematicError::TurnScale, &calibration);
}

/// The noise of a leg's turn is as large as the turn, so that the scale of single legs is too small (regression dilution). The turns of 16
/// successive legs have one sign, so that their sum grows faster than their noise.
#[test]
fn a_turn_scale_of_noisy_encoders_is_not_corrected() {
    let sim = Simulation {
        velocity_of_leg: Some(|leg_index| {
            [0.3 + 0.1 * (leg_index % 3) as f64, if leg_index / 16 % 2 == 0 { 0.15 } else { -0.15 }]
        }),
        ..new_passing_simulation(600, 8)
    };
    let [odometry, reference] = sim.simulate_log();
    let calibration =
        calibrate_log(&[add_step_noise(&odometry, [0.001, 0.03], 8), reference], &sim.calibration_options());
    assert!(calibration.systematic.turn_scale < 0.9, "{}", calibration.systematic.turn_scale);
    assert_not_constant(TurnScaleConstant, SystematicError::TurnScale, &calibration);
}

/// Robots with skid steering turn about half as far as their tracks suggest.
#[test]
fn a_wrong_track_width_is_a_turn_scale_and_no_mismatch() {
    let calibration = calibrate_with_scales(&new_passing_simulation(600, 8), |_, _| [1.0, 0.53]);
    assert!(!failed_check_names_of(&calibration).contains(&ReferenceMatches));
    assert!((calibration.systematic.turn_scale - 0.53).abs() < 0.02, "{}", calibration.systematic.turn_scale);
}

#[test]
fn errors_that_persist_over_legs_are_correlated_and_leave_windows_uncovered() {
    let calibration = calibrate_simulation(&Simulation {
        noise_violation: Violation::AutocorrelatedNoise(0.7),
        ..new_passing_simulation(600, 9)
    });
    for check_name in [ResidualsUncorrelated, Window1Covered, Window2Covered] {
        assert_fails(check_name, &calibration);
    }
    // A correlation of 1,800 residuals has a standard error of 0.02.
    let error_correlation = calibration.persistence.correlation.value;
    assert!((error_correlation - 0.7).abs() < 0.08, "{error_correlation}");
    // A window (successive legs) of a given length ends with the leg that completes this length. No leg is longer than 0.4 m.
    for (leg_window, min_length) in calibration.diagnostics.windows.iter().zip([1.0, 2.0, 5.0]) {
        assert!(min_length < leg_window.length && leg_window.length < min_length + 0.4, "{leg_window:?}");
    }
    assert!(calibration.recommended.expect("usable").inflation > 1.5);
}

fn count_consistent_logs(model: Model, log_count: u64) -> usize {
    let mut failed_check_names = Vec::new();
    let calibrate_log_of_seed = |seed: u64| calibrate_simulation(&Simulation::new(model, 600, 3000 + seed));
    let is_consistent = |calibration: &Calibration| {
        failed_check_names.extend(failed_check_names_of(calibration));
        calibration.diagnostics.verdict == Verdict::Consistent
    };
    let consistent_count = (0..log_count).map(calibrate_log_of_seed).filter(is_consistent).count();
    println!("{model:?}: {consistent_count} of {log_count} are consistent; failed: {failed_check_names:?}");
    consistent_count
}

/// If a log is consistent with a probability of 0.95, nine or more of twelve logs are consistent, except in one of five thousand runs.
#[test]
fn good_logs_are_consistent() {
    assert!(count_consistent_logs(NAV2, 12) > 8);
}

#[test]
#[ignore = "nightly: 500 calibrations"]
fn ninety_of_a_hundred_good_logs_of_every_model_are_consistent() {
    for model in MODELS {
        assert!(count_consistent_logs(model, 100) >= 90, "{model:?}");
    }
}
