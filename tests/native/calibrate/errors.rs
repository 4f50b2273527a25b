//! Systematic errors: their estimates, and their correction, after which they do not change the α's.

use super::simulated::{ALPHAS, MODELS, Simulation};
use super::{NAV2, add_step_noise, calibrate_log, calibrate_simulation, new_trajectory, options_of};
use crate::common::seeded_rng;
use motion::calibrate::{
    CalibrateError, Calibration, Drive, LegLength, Model, Options, Systematic, SystematicError, Trajectory,
    calibrate,
};
use motion::geom::se2::{SE2, wrap_angle};
use nalgebra::Vector3;
use rand::RngExt;
use std::f64::consts::{FRAC_PI_2, PI};

fn simulation_with_errors(model: Model, leg_count: usize, systematic_errors: Systematic) -> Simulation {
    Simulation { systematic_errors, ..Simulation::new(model, leg_count, 77) }
}

/// Asserts that an estimated error is within four standard errors of the truth. Standard errors below 1e-3 are raised to 1e-3, because they
/// neglect products of noises.
fn assert_systematic_error_near(calibration: &Calibration, error_kind: SystematicError, true_value: f64) {
    let standard_error = calibration.systematic_stds[error_kind as usize].expect("identifiable");
    let deviation = wrap_angle(calibration.systematic.get(error_kind) - true_value).abs();
    assert!(
        deviation < 4.0 * standard_error.max(1e-3) && deviation < 0.05,
        "{error_kind:?} is off by {deviation}, {standard_error}"
    );
}

#[test]
fn a_mount_yaw_of_any_size_and_a_lever_arm_are_found() {
    for (model, mount_yaw) in MODELS.into_iter().zip([0.07, FRAC_PI_2, -2.6, PI, -FRAC_PI_2]) {
        let true_errors = Systematic { mount_yaw, lever_arm: [0.3, -0.2], ..Systematic::NONE };
        let calibration = calibrate_simulation(&simulation_with_errors(model, 500, true_errors));
        assert_systematic_error_near(&calibration, SystematicError::MountYaw, mount_yaw);
        assert_systematic_error_near(&calibration, SystematicError::LeverArmAhead, 0.3);
        assert_systematic_error_near(&calibration, SystematicError::LeverArmLeft, -0.2);
        // The ratio of fitted to true α may differ from 1 by four standard errors, which are at most 13 % each.
        for (fitted_alpha, true_alpha) in calibration.alphas.iter().zip(ALPHAS) {
            let alpha_ratio = fitted_alpha.expect("identifiable") / true_alpha;
            assert!((alpha_ratio - 1.0).abs() < 0.5, "{model:?} {mount_yaw}: {:?}", calibration.alphas);
        }
    }
}

#[test]
fn clocks_with_any_offset_are_aligned() {
    for clock_offset in [-1.7e9, -4000.0, 0.12, 7.25, 15.12, 1.7e9] {
        let true_errors = Systematic { clock_offset, ..Systematic::NONE };
        let calibration = calibrate_simulation(&simulation_with_errors(NAV2, 500, true_errors));
        assert_systematic_error_near(&calibration, SystematicError::ClockOffset, clock_offset);
        assert!(calibration.legs.len() > 490, "{clock_offset}: {}", calibration.legs.len());
    }
}

/// Three broken references are tested. The first one restarts every twenty seconds in a coordinate frame with another heading. The second
/// one has samples for a third of the time. The third one covers a fifth of the drive.
#[test]
fn clocks_are_aligned_by_the_turns_of_a_broken_reference() {
    let true_errors = Systematic { clock_offset: 3.2, ..Systematic::NONE };
    let simulation = simulation_with_errors(NAV2, 2000, true_errors);
    let [odometry, reference] = simulation.simulate_log();
    let row_count = reference.samples().len();
    let mut rng = seeded_rng(2);
    let mut frame_heading = 0.0;
    let restarting_reference =
        new_trajectory(reference.samples().enumerate().map(|(row_index, (sample_time, pose))| {
            if row_index % 400 == 0 {
                frame_heading = rng.random_range(-3.0..3.0);
            }
            (sample_time, SE2::new(0.0, 0.0, frame_heading) * pose)
        }));
    let partly_visible_reference =
        new_trajectory(reference.samples().filter(|(time, _)| time.rem_euclid(60.0) < 20.0));
    let short_reference = new_trajectory(reference.samples().skip(row_count / 2).take(row_count / 5));
    for reference in [
        restarting_reference.with_breaks_before((0..row_count).step_by(400)),
        partly_visible_reference,
        short_reference,
    ] {
        let calibration = calibrate_log(&[odometry.clone(), reference], &simulation.calibration_options());
        assert_systematic_error_near(&calibration, SystematicError::ClockOffset, 3.2);
    }
}

#[test]
fn trajectories_without_a_common_time_are_refused() {
    let calibrate_logs = |odometry: &Trajectory, reference: &Trajectory| {
        calibrate(&[Drive { odometry: odometry.clone(), reference: reference.clone() }], &options_of(NAV2))
            .map(|calibration| calibration.systematic)
    };
    let delay_trajectory = |delayed_trajectory: &Trajectory, time_shift: f64| {
        new_trajectory(delayed_trajectory.samples().map(|(time, pose)| (time + time_shift, pose)))
    };
    let [odometry, _] = Simulation::new(NAV2, 500, 6).simulate_log();
    let [_, other_reference] = Simulation::new(NAV2, 500, 7).simulate_log();
    assert_eq!(
        calibrate_logs(&odometry, &delay_trajectory(&other_reference, 1e6)),
        Err(CalibrateError::NoCommonTime)
    );
    // Straight drives have no turns that could align the clocks. Their clocks are assumed equal, provided that the times overlap.
    let straight_drive_from = |start_time: f64| {
        let row_indices = (0..1000).map(f64::from);
        new_trajectory(row_indices.map(|row| (start_time + 0.1 * row, SE2::new(0.05 * row, 0.0, 0.0))))
    };
    assert_eq!(
        calibrate_logs(&straight_drive_from(0.0), &straight_drive_from(70.0))
            .map(|systematic_errors| systematic_errors.clock_offset),
        Ok(0.0)
    );
    assert_eq!(
        calibrate_logs(&straight_drive_from(0.0), &straight_drive_from(100.0)),
        Err(CalibrateError::NoCommonTime)
    );
}

#[test]
fn too_few_legs_are_refused() {
    let simulation = Simulation::new(Model::Velocity, 7, 1);
    let [odometry, reference] = simulation.simulate_log();
    let calibration_result = calibrate(&[Drive { odometry, reference }], &simulation.calibration_options());
    assert!(matches!(calibration_result, Err(CalibrateError::TooFewLegs { legs: 6 | 7 })));
}

/// A mount yaw of 0.07 rad changes each rotation of a leg by 0.07 rad. On legs of a quarter of a metre this has the effect of an α₂ of
/// 0.08, and of a larger α₂ on shorter legs with turns. If the noise of the reference is estimated, the estimate increases instead of α₂.
#[test]
fn an_uncorrected_error_appears_as_noise_of_the_wheels_or_of_the_reference() {
    let simulation = simulation_with_errors(NAV2, 600, Systematic { mount_yaw: 0.07, ..Systematic::NONE });
    let uncorrected_log = simulation.simulate_log();
    let exact_reference_options =
        Options { position_std: Some(0.0), yaw_std: Some(0.0), ..simulation.calibration_options() };
    let calibrate_uncorrected = |error_options: Options| {
        calibrate_log(&uncorrected_log, &Options { correct: [Some(false); 6], ..error_options })
    };
    let [corrected_fit, fit_with_estimated_noise, uncorrected_fit] = [
        calibrate_log(&uncorrected_log, &exact_reference_options),
        calibrate_uncorrected(simulation.calibration_options()),
        calibrate_uncorrected(exact_reference_options),
    ];
    let fitted_alpha2_of = |calibration: &Calibration| calibration.alphas[1].expect("identifiable");
    let added_alpha2 = fitted_alpha2_of(&uncorrected_fit) - fitted_alpha2_of(&corrected_fit);
    assert!((0.05..0.2).contains(&added_alpha2), "{added_alpha2}");
    let alpha2_ratio = fitted_alpha2_of(&fit_with_estimated_noise) / fitted_alpha2_of(&corrected_fit);
    assert!((0.7..1.5).contains(&alpha2_ratio), "{alpha2_ratio}");
    let yaw_std = fit_with_estimated_noise.reference_noise[1].value;
    assert!((yaw_std / 0.07 - 1.0).abs() < 0.1, "{yaw_std}");
    let [uncorrected_interval, corrected_interval] = [&uncorrected_fit, &corrected_fit]
        .map(|calibration| calibration.interval_of(SystematicError::MountYaw));
    assert_eq!(uncorrected_interval, corrected_interval);
    assert_eq!((uncorrected_fit.corrected, uncorrected_fit.is_corrected), (Systematic::NONE, [false; 6]));
}

#[test]
fn an_error_that_the_log_does_not_identify_is_not_corrected() {
    let simulation = Simulation { velocity_of_leg: Some(|_| [0.4, 0.0]), ..Simulation::new(NAV2, 600, 4) };
    let calibration = calibrate_simulation(&simulation);
    let is_unidentified =
        |error_kind: SystematicError| calibration.systematic_stds[error_kind as usize].is_none();
    assert!(is_unidentified(SystematicError::TurnScale) && is_unidentified(SystematicError::LeverArmAhead));
    for error_kind in SystematicError::ALL.into_iter().filter(|error_kind| is_unidentified(*error_kind)) {
        assert!(!calibration.is_corrected[error_kind as usize], "{error_kind:?}");
        assert_eq!(calibration.corrected.get(error_kind), Systematic::NONE.get(error_kind), "{error_kind:?}");
    }
}

/// On a circle, a mount yaw acts like a lever arm ahead. The second fit, without the lever arm, could identify the mount yaw.
#[test]
fn an_error_that_only_the_second_fit_identifies_is_not_corrected() {
    let simulation = Simulation { velocity_of_leg: Some(|_| [0.3, 0.3]), ..Simulation::new(NAV2, 600, 4) };
    let [mount_yaw, lever_arm] = [SystematicError::MountYaw, SystematicError::LeverArmAhead];
    let correct = SystematicError::ALL.map(|error_kind| (error_kind == lever_arm).then_some(false));
    let Calibration { systematic_stds, is_corrected, .. } =
        calibrate_log(&simulation.simulate_log(), &Options { correct, ..simulation.calibration_options() });
    assert!(systematic_stds[lever_arm as usize].is_some());
    assert!(systematic_stds[mount_yaw as usize].is_none() && !is_corrected[mount_yaw as usize]);
}

/// The effect of a lever arm that is not corrected hides the turn scale.
#[test]
fn an_error_that_uncorrected_errors_hide_is_not_corrected() {
    let true_errors = Systematic { lever_arm: [0.3, -0.2], ..Systematic::NONE };
    let simulation = simulation_with_errors(NAV2, 300, true_errors);
    let mut corrected_kinds = [None; 6];
    corrected_kinds[SystematicError::LeverArmAhead as usize] = Some(false);
    let error_options = Options { correct: corrected_kinds, ..simulation.calibration_options() };
    let calibration = calibrate_log(&simulation.simulate_log(), &error_options);
    let turn_scale_index = SystematicError::TurnScale as usize;
    assert!(calibration.is_constant[turn_scale_index]);
    assert!(calibration.systematic_stds[turn_scale_index].is_some());
    assert!(!calibration.is_corrected[turn_scale_index]);
    assert_eq!(calibration.corrected.get(SystematicError::TurnScale), 1.0);
}

/// The reference has fewer rows than the odometry, or rows at other times.
#[test]
fn errors_of_a_robot_without_noise_are_exact() {
    const CLOCK_OFFSET: f64 = 0.123;
    let (mut robot_pose, mut odometry_samples) = (SE2::identity(), Vec::new());
    for row in 0..20_000_u32 {
        odometry_samples.push((0.01 * f64::from(row), robot_pose));
        let section_index = row as usize / 170;
        let turn_rate = [0.7, -0.5, 0.9][section_index / 3 % 3];
        let twist = [[0.0, turn_rate], [0.4, 0.0], [0.4, 0.3]][section_index % 3];
        robot_pose = robot_pose.boxplus(Vector3::new(twist[0], 0.0, twist[1]) * 0.01);
    }
    let odometry = new_trajectory(odometry_samples.iter().copied().step_by(2));
    for (first_row_index, sample_stride) in [(0, 2), (0, 10), (7, 50), (7, 100)] {
        let delayed_samples = odometry_samples
            .iter()
            .skip(first_row_index)
            .step_by(sample_stride)
            .map(|(time, robot_pose)| (time + CLOCK_OFFSET, *robot_pose));
        let log_of_times = [odometry.clone(), new_trajectory(delayed_samples)];
        let calibration =
            calibrate_log(&log_of_times, &Options { correct: [Some(true); 6], ..options_of(MODELS[0]) });
        let true_errors = Systematic { clock_offset: CLOCK_OFFSET, ..Systematic::NONE };
        for error_kind in SystematicError::ALL {
            let deviation = calibration.systematic.get(error_kind) - true_errors.get(error_kind);
            assert!(deviation.abs() < 1e-6, "{error_kind:?} is off by {deviation}, every {sample_stride}");
        }
        assert!(
            calibration.alphas.iter().all(|alpha| alpha.is_none_or(|alpha| alpha < 1e-7)),
            "every {sample_stride}"
        );
    }
}

/// The reference has half the rate of the odometry, so that legs end between steps of the odometry. The noise of a split step affects both
/// the residuals and the velocities. This correlation must not bias the clock offset.
#[test]
fn noise_of_the_odometry_does_not_bias_the_clock_offset() {
    const CLOCK_OFFSET: f64 = 0.06;
    const STEP_SECONDS: f64 = 0.05;
    let (mut error_sum, mut variance_sum) = (0.0, 0.0);
    for seed in 1..=8 {
        let mut true_pose = SE2::identity();
        let true_trajectory = new_trajectory((0..12_000).map(|row_index| {
            let time = STEP_SECONDS * f64::from(row_index);
            let sine_wave_of = |angular_frequency: f64| (angular_frequency * time).sin();
            let v = 0.4 + 0.15 * sine_wave_of(2.0) + 0.1 * sine_wave_of(0.91);
            let omega = 0.5 * sine_wave_of(1.3) + 0.4 * sine_wave_of(0.41) + 0.3 * sine_wave_of(3.17);
            true_pose = true_pose.boxplus(Vector3::new(v, 0.0, omega) * STEP_SECONDS);
            (time, true_pose)
        }));
        let reference =
            true_trajectory.samples().step_by(2).map(|(time, true_pose)| (time + CLOCK_OFFSET, true_pose));
        let noisy_log = [add_step_noise(&true_trajectory, [0.0015, 0.005], seed), new_trajectory(reference)];
        let Calibration { systematic: fitted_errors, systematic_stds, .. } =
            calibrate_log(&noisy_log, &options_of(NAV2));
        let clock_offset_std = systematic_stds[SystematicError::ClockOffset as usize].expect("identifiable");
        error_sum += fitted_errors.clock_offset - CLOCK_OFFSET;
        variance_sum += clock_offset_std * clock_offset_std;
    }
    assert!(error_sum.abs() < 4.0 * variance_sum.sqrt(), "{error_sum} {}", variance_sum.sqrt());
}

#[test]
fn four_drives_are_as_informative_as_one_of_the_same_length() {
    let new_simulation_with_offset = |clock_offset: f64, leg_count: usize, seed: u64| {
        let true_errors = Systematic { clock_offset, ..Systematic::NONE };
        Simulation { seed, ..simulation_with_errors(NAV2, leg_count, true_errors) }
    };
    let shifted_drives: Vec<Drive> = [0.0, 0.4, -3.0, 900.0]
        .into_iter()
        .zip(20..)
        .map(|(clock_offset, seed)| new_simulation_with_offset(clock_offset, 300, seed).simulate_log())
        .map(|[odometry, reference]| Drive { odometry, reference })
        .collect();
    let fit_of_four_drives = calibrate(&shifted_drives, &options_of(NAV2)).expect("legs enough");
    let fit_of_one_drive = calibrate_simulation(&new_simulation_with_offset(0.0, 1200, 20));
    assert!(fit_of_four_drives.legs.len() > 1190, "{}", fit_of_four_drives.legs.len());
    for (alpha_index, true_alpha) in ALPHAS.into_iter().enumerate().take(4) {
        let relative_interval_width_of = |calibration: &Calibration| {
            let [interval_low, interval_high] = calibration.intervals[alpha_index].expect("identifiable");
            (interval_high - interval_low) / calibration.alphas[alpha_index].expect("identifiable")
        };
        let width_ratio =
            relative_interval_width_of(&fit_of_four_drives) / relative_interval_width_of(&fit_of_one_drive);
        assert!((width_ratio - 1.0).abs() < 0.3, "α{}: {width_ratio}", alpha_index + 1);
        // The ratio of fitted to true α may differ from 1 by four standard errors, which are at most 9 % each.
        let alpha_ratio = fit_of_four_drives.alphas[alpha_index].expect("identifiable") / true_alpha;
        assert!((alpha_ratio - 1.0).abs() < 0.36, "α{}: {alpha_ratio}", alpha_index + 1);
    }
}

/// The encoders jitter by 3 mm and 3 mrad, and the robot stands still half of the time.
#[test]
fn encoder_jitter_of_a_standing_robot_does_not_change_the_scales() {
    let mut rng = seeded_rng(5);
    let mut sample_uniform_noise = |noise_bound: f64| rng.random_range(-noise_bound..noise_bound);
    let (mut odometry_pose, mut true_pose, mut pose_rows) = (SE2::identity(), SE2::identity(), Vec::new());
    for row in 0..16_000_usize {
        let section_index = row / 40;
        let twist = match section_index % 4 {
            0 => [0.4, if section_index % 8 == 0 { 0.5 } else { -0.6 }],
            2 => [0.0, if section_index % 8 == 2 { 0.7 } else { -0.5 }],
            _ => [0.0, 0.0],
        };
        let twist = Vector3::new(twist[0], 0.0, twist[1]) * 0.05;
        let encoder_jitter =
            SE2::new(sample_uniform_noise(0.003), sample_uniform_noise(0.003), sample_uniform_noise(0.003));
        pose_rows.push([(0.05 * row as f64, odometry_pose * encoder_jitter), (0.05 * row as f64, true_pose)]);
        odometry_pose = odometry_pose.boxplus(twist);
        let is_moving = twist.norm() > 0.0;
        let motion_noise = if is_moving {
            Vector3::new(sample_uniform_noise(0.004), 0.0, sample_uniform_noise(0.008))
        } else {
            Vector3::zeros()
        };
        true_pose = true_pose.boxplus(twist + motion_noise);
    }
    let noisy_log =
        [0, 1].map(|trajectory_index| new_trajectory(pose_rows.iter().map(|row| row[trajectory_index])));
    let error_options = Options { legs: LegLength::Duration { duration: 0.5 }, ..options_of(NAV2) };
    let calibration = calibrate_log(&noisy_log, &error_options);
    assert_systematic_error_near(&calibration, SystematicError::TurnScale, 1.0);
    assert_systematic_error_near(&calibration, SystematicError::DistanceScale, 1.0);
}
