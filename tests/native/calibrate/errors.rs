//! Systematic errors: estimated, corrected if they are constant, and without effect on the α's.

use super::simulated::{ALPHAS, MODELS, Simulation};
use super::{NAV2, calibrated, calibrated_log, options_of, trajectory};
use crate::common::seeded;
use motion::calibrate::{
    CalibrateError, Calibration, Drive, LegLength, Model, Options, Systematic, SystematicError, Trajectory,
    calibrate,
};
use motion::geom::se2::{SE2, wrap_angle};
use nalgebra::Vector3;
use rand::RngExt;
use std::f64::consts::{FRAC_PI_2, PI};

fn simulation_with_errors(model: Model, count: usize, errors: Systematic) -> Simulation {
    Simulation { errors, ..Simulation::of(model, count, 77) }
}

/// Asserts that an estimated error is within four standard errors of the truth; by chance one in sixteen thousand is not. A standard error
/// below 1e-3 is raised to 1e-3, because it neglects products of noises.
fn assert_recovers(calibration: &Calibration, error: SystematicError, truth: f64) {
    let std = calibration.systematic_stds[error as usize].expect("identifiable");
    let deviation = wrap_angle(calibration.systematic.get(error) - truth).abs();
    assert!(deviation < 4.0 * std.max(1e-3) && deviation < 0.05, "{error:?} is off by {deviation}, {std}");
}

#[test]
fn a_mount_yaw_of_any_size_and_a_lever_arm_are_found() {
    for (model, yaw) in MODELS.into_iter().zip([0.07, FRAC_PI_2, -2.6, PI, -FRAC_PI_2]) {
        let errors = Systematic { mount_yaw: yaw, lever_arm: [0.3, -0.2], ..Systematic::NONE };
        let calibration = calibrated(&simulation_with_errors(model, 500, errors));
        assert_recovers(&calibration, SystematicError::MountYaw, yaw);
        assert_recovers(&calibration, SystematicError::LeverArmAhead, 0.3);
        assert_recovers(&calibration, SystematicError::LeverArmLeft, -0.2);
        // The most uncertain α has a standard error of 13 %; four standard errors are allowed.
        for (alpha, truth) in calibration.alphas.iter().zip(ALPHAS) {
            let ratio = alpha.expect("identifiable") / truth;
            assert!((ratio - 1.0).abs() < 0.5, "{model:?} {yaw}: {:?}", calibration.alphas);
        }
    }
}

#[test]
fn clocks_with_any_offset_are_aligned() {
    for offset in [-1.7e9, -4000.0, 0.12, 7.25, 15.12, 1.7e9] {
        let errors = Systematic { clock_offset: offset, ..Systematic::NONE };
        let calibration = calibrated(&simulation_with_errors(NAV2, 500, errors));
        assert_recovers(&calibration, SystematicError::ClockOffset, offset);
        assert!(calibration.legs.len() > 490, "{offset}: {}", calibration.legs.len());
    }
}

/// Three references: one restarts every twenty seconds in a frame with another heading, one is visible a third of the time, and
/// one exists for a fifth of the drive.
#[test]
fn clocks_are_aligned_by_the_turns_of_a_broken_reference() {
    let errors = Systematic { clock_offset: 3.2, ..Systematic::NONE };
    let simulation = simulation_with_errors(NAV2, 2000, errors);
    let [odometry, reference] = simulation.log();
    let rows = reference.samples().len();
    let mut rng = seeded(2);
    let mut frame_heading = 0.0;
    let restarting_reference = trajectory(reference.samples().enumerate().map(|(row, (time, pose))| {
        if row % 400 == 0 {
            frame_heading = rng.random_range(-3.0..3.0);
        }
        (time, SE2::new(0.0, 0.0, frame_heading) * pose)
    }));
    let partly_visible_reference =
        trajectory(reference.samples().filter(|(time, _)| time.rem_euclid(60.0) < 20.0));
    let short_log = trajectory(reference.samples().skip(rows / 2).take(rows / 5));
    for reference in
        [restarting_reference.with_breaks_before((0..rows).step_by(400)), partly_visible_reference, short_log]
    {
        let calibration = calibrated_log(&[odometry.clone(), reference], &simulation.options());
        assert_recovers(&calibration, SystematicError::ClockOffset, 3.2);
    }
}

#[test]
fn trajectories_without_a_common_time_are_refused() {
    let result_of = |odometry: &Trajectory, reference: &Trajectory| {
        calibrate(&[Drive { odometry, reference }], &options_of(NAV2))
            .map(|calibration| calibration.systematic)
    };
    let with_delay =
        |log: &Trajectory, s: f64| trajectory(log.samples().map(|(time, pose)| (time + s, pose)));
    let [odometry, _] = Simulation::of(NAV2, 500, 6).log();
    let [_, other_reference] = Simulation::of(NAV2, 500, 7).log();
    assert_eq!(result_of(&odometry, &with_delay(&other_reference, 1e6)), Err(CalibrateError::NoCommonTime));
    // Straight drives have no turns to align by. Their clocks are assumed equal, provided that the times overlap.
    let straight_drive = |from: f64| {
        let rows = (0..1000).map(f64::from);
        trajectory(rows.map(|row| (from + 0.1 * row, SE2::new(0.05 * row, 0.0, 0.0))))
    };
    assert_eq!(result_of(&straight_drive(0.0), &straight_drive(70.0)).map(|fit| fit.clock_offset), Ok(0.0));
    assert_eq!(result_of(&straight_drive(0.0), &straight_drive(100.0)), Err(CalibrateError::NoCommonTime));
}

#[test]
fn too_few_legs_are_refused() {
    let simulation = Simulation::of(Model::Velocity, 7, 1);
    let [odometry, reference] = simulation.log();
    let result = calibrate(&[Drive { odometry: &odometry, reference: &reference }], &simulation.options());
    assert!(matches!(result, Err(CalibrateError::TooFewLegs { legs: 6 | 7 })));
}

/// A mount yaw of 0.07 rad changes each rotation of a leg by 0.07 rad. On legs of a quarter of a metre this has the effect of an α₂ of 0.08, and
/// on shorter legs with turns that of a larger α₂. An estimated noise of the reference absorbs the error, because both headings of a leg have it.
#[test]
fn an_uncorrected_error_appears_as_noise_of_the_wheels_or_of_the_reference() {
    let simulation = simulation_with_errors(NAV2, 600, Systematic { mount_yaw: 0.07, ..Systematic::NONE });
    let log = simulation.log();
    let exact_reference = Options { position_std: Some(0.0), yaw_std: Some(0.0), ..simulation.options() };
    let fit_as_is =
        |options: Options| calibrated_log(&log, &Options { correct: [Some(false); 6], ..options });
    let [corrected, estimated, uncorrected] =
        [calibrated_log(&log, &exact_reference), fit_as_is(simulation.options()), fit_as_is(exact_reference)];
    let alpha2 = |calibration: &Calibration| calibration.alphas[1].expect("identifiable");
    let added_alpha2 = alpha2(&uncorrected) - alpha2(&corrected);
    assert!((0.05..0.2).contains(&added_alpha2), "{added_alpha2}");
    let ratio = alpha2(&estimated) / alpha2(&corrected);
    assert!((0.7..1.5).contains(&ratio), "{ratio}");
    let yaw = estimated.reference_noise[1].value;
    assert!((yaw / 0.07 - 1.0).abs() < 0.1, "{yaw}");
    // The mount yaw is reported also if it is not corrected.
    let [interval, other_interval] =
        [&uncorrected, &corrected].map(|calibration| calibration.interval_of(SystematicError::MountYaw));
    assert_eq!(interval, other_interval);
    assert_eq!((uncorrected.corrected, uncorrected.is_corrected), (Systematic::NONE, [false; 6]));
}

#[test]
fn an_error_that_the_log_does_not_identify_is_not_corrected() {
    let simulation = Simulation { drive: Some(|_| [0.4, 0.0]), ..Simulation::of(NAV2, 600, 4) };
    let calibration = calibrated(&simulation);
    let is_not_identified = |error: SystematicError| calibration.systematic_stds[error as usize].is_none();
    assert!(
        is_not_identified(SystematicError::TurnScale) && is_not_identified(SystematicError::LeverArmAhead)
    );
    for error in SystematicError::ALL.into_iter().filter(|error| is_not_identified(*error)) {
        assert!(!calibration.is_corrected[error as usize], "{error:?}");
        assert_eq!(calibration.corrected.get(error), Systematic::NONE.get(error), "{error:?}");
    }
}

/// From odometry without noise all errors are estimated up to rounding, also if the reference has fewer rows, or rows at times between
/// those of the odometry.
#[test]
fn errors_of_a_robot_without_noise_are_exact() {
    const OFFSET: f64 = 0.123;
    let (mut pose, mut samples) = (SE2::identity(), Vec::new());
    for row in 0..20_000_u32 {
        samples.push((0.01 * f64::from(row), pose));
        let phase = row as usize / 170;
        let turn = [0.7, -0.5, 0.9][phase / 3 % 3];
        let twist = [[0.0, turn], [0.4, 0.0], [0.4, 0.3]][phase % 3];
        pose = pose.boxplus(Vector3::new(twist[0], 0.0, twist[1]) * 0.01);
    }
    let odometry = trajectory(samples.iter().copied().step_by(2));
    for (first, every) in [(0, 2), (0, 10), (7, 50), (7, 100)] {
        let with_delay = samples.iter().skip(first).step_by(every).map(|(time, pose)| (time + OFFSET, *pose));
        let log = [odometry.clone(), trajectory(with_delay)];
        let calibration =
            calibrated_log(&log, &Options { correct: [Some(true); 6], ..options_of(MODELS[0]) });
        let truth = Systematic { clock_offset: OFFSET, ..Systematic::NONE };
        for error in SystematicError::ALL {
            let deviation = calibration.systematic.get(error) - truth.get(error);
            assert!(deviation.abs() < 1e-6, "{error:?} is off by {deviation}, every {every}");
        }
        assert!(
            calibration.alphas.iter().all(|alpha| alpha.is_none_or(|alpha| alpha < 1e-7)),
            "every {every}"
        );
    }
}

/// Four drives with a quarter of the legs each, and each with its own clock, give the standard errors of one drive with all legs.
#[test]
fn four_drives_are_as_informative_as_one_of_the_same_length() {
    let simulation_with_clock = |clock_offset: f64, count: usize, seed: u64| {
        let errors = Systematic { clock_offset, ..Systematic::NONE };
        Simulation { errors, seed, ..simulation_with_errors(NAV2, count, errors) }
    };
    let logs: Vec<[Trajectory; 2]> = [0.0, 0.4, -3.0, 900.0]
        .into_iter()
        .zip(20..)
        .map(|(offset, seed)| simulation_with_clock(offset, 300, seed).log())
        .collect();
    let drives: Vec<Drive> = logs.iter().map(|[odometry, reference]| Drive { odometry, reference }).collect();
    let four_drives = calibrate(&drives, &options_of(NAV2)).expect("legs enough");
    let one_drive = calibrated(&simulation_with_clock(0.0, 1200, 20));
    assert!(four_drives.legs.len() > 1190, "{}", four_drives.legs.len());
    for (alpha, truth) in ALPHAS.into_iter().enumerate().take(4) {
        let relative_width = |calibration: &Calibration| {
            let [low, high] = calibration.intervals[alpha].expect("identifiable");
            (high - low) / calibration.alphas[alpha].expect("identifiable")
        };
        let ratio = relative_width(&four_drives) / relative_width(&one_drive);
        assert!((ratio - 1.0).abs() < 0.3, "α{}: {ratio}", alpha + 1);
        // Standard errors are at most 9 %; four of them are allowed.
        let ratio_to_truth = four_drives.alphas[alpha].expect("identifiable") / truth;
        assert!((ratio_to_truth - 1.0).abs() < 0.36, "α{}: {ratio_to_truth}", alpha + 1);
    }
}

/// The encoders jitter by 3 mm and 3 mrad, and the robot stands half of the time. In legs of a standing robot, jitter must not count as motion
/// with a scale of 0.
#[test]
fn encoder_jitter_of_a_standing_robot_does_not_change_the_scales() {
    let mut rng = seeded(5);
    let mut uniform_noise = |limit: f64| rng.random_range(-limit..limit);
    let (mut odometry_pose, mut true_pose, mut rows) = (SE2::identity(), SE2::identity(), Vec::new());
    for row in 0..16_000_usize {
        let phase = row / 40;
        let twist = match phase % 4 {
            0 => [0.4, if phase % 8 == 0 { 0.5 } else { -0.6 }],
            2 => [0.0, if phase % 8 == 2 { 0.7 } else { -0.5 }],
            _ => [0.0, 0.0],
        };
        let twist = Vector3::new(twist[0], 0.0, twist[1]) * 0.05;
        let jitter = SE2::new(uniform_noise(0.003), uniform_noise(0.003), uniform_noise(0.003));
        rows.push([(0.05 * row as f64, odometry_pose * jitter), (0.05 * row as f64, true_pose)]);
        odometry_pose = odometry_pose.boxplus(twist);
        let is_moving = twist.norm() > 0.0;
        let noise_step = if is_moving {
            Vector3::new(uniform_noise(0.004), 0.0, uniform_noise(0.008))
        } else {
            Vector3::zeros()
        };
        true_pose = true_pose.boxplus(twist + noise_step);
    }
    let log = [0, 1].map(|trajectory_index| trajectory(rows.iter().map(|row| row[trajectory_index])));
    let options = Options { legs: LegLength::Duration { duration: 0.5 }, ..options_of(NAV2) };
    let calibration = calibrated_log(&log, &options);
    assert_recovers(&calibration, SystematicError::TurnScale, 1.0);
    assert_recovers(&calibration, SystematicError::DistanceScale, 1.0);
}
