//! Fuzz target of the calibration: random logs and options.

use super::input::{InputReader, is_selected_by_hash};
use super::assertions;
use motion::calibrate::{
    CalibrateError, Calibration, Check, Drive, LegLength, MIN_LEGS, Model, Options, Outliers,
    SystematicError, Trajectory, TrajectoryError, Verdict, calibrate,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Maximum number of sections of a drive, after the first. The velocity is constant in a section.
const MAX_ADDED_SECTIONS: usize = 6;

/// Maximum number of rows in a section of a drive, for most inputs. The time of a calibration grows with the number of rows.
const MAX_SECTION_ROWS_OF_MOST_RUNS: usize = 12;
const MAX_SECTION_ROWS: usize = 64; // in a few long runs

const MODELS: [Model; 5] = [
    Model::Odometry(OdometryRule::Table),
    Model::Odometry(OdometryRule::Nav2),
    Model::Odometry(OdometryRule::Beluga),
    Model::Odometry(OdometryRule::Omni),
    Model::Velocity,
];

pub fn check_input(input_bytes: &[u8]) {
    let mut fuzz_input = InputReader(input_bytes);
    let calibration_options = read_options(&mut fuzz_input);
    let mut odometry_log = read_odometry_rows(&mut fuzz_input, if is_selected_by_hash(128, input_bytes) { MAX_SECTION_ROWS } else { MAX_SECTION_ROWS_OF_MOST_RUNS });
    let mut reference_log = read_reference_rows(&odometry_log, &mut fuzz_input);
    edit_rows(&mut odometry_log, &mut fuzz_input);
    edit_rows(&mut reference_log, &mut fuzz_input);
    let (Some(odometry_trajectory), Some(reference_trajectory)) = (build_trajectory(&odometry_log, &mut fuzz_input), build_trajectory(&reference_log, &mut fuzz_input))
    else {
        return;
    };
    let drive = Drive { odometry: odometry_trajectory, reference: reference_trajectory };
    match calibrate(std::slice::from_ref(&drive), &calibration_options) {
        Ok(calibration) => assert_calibration(&calibration, &calibration_options),
        Err(CalibrateError::TooFewLegs { legs: leg_count }) => assert!(leg_count < MIN_LEGS),
        Err(CalibrateError::NoCommonTime) => {
            let [odometry_span, reference_span] = [&drive.odometry, &drive.reference].map(|trajectory| trajectory.span().expect("a row at least"));
            assert!(odometry_span[1] < reference_span[0] || reference_span[1] < odometry_span[0], "{odometry_span:?} {reference_span:?}");
        }
    }
}

fn read_options(fuzz_input: &mut InputReader) -> Options {
    let leg_length = match fuzz_input.next_below(4) {
        0 => LegLength::AMCL,
        1 => LegLength::Duration { duration: read_leg_size(fuzz_input) },
        _ => LegLength::Displacement { distance: read_leg_size(fuzz_input), angle: read_leg_size(fuzz_input) },
    };
    let outlier_handling = fuzz_input.choose_one(&[Outliers::Reject, Outliers::Keep]);
    let correction_mask = fuzz_input.next_byte();
    let mut read_std = || (fuzz_input.next_below(3) == 0).then(|| fuzz_input.draw_number_within(0.0..=1e3));
    let [position_std, yaw_std] = [read_std(), read_std()];
    Options {
        model: fuzz_input.choose_one(&MODELS),
        legs: leg_length,
        outliers: outlier_handling,
        correct: std::array::from_fn(|error_index| (correction_mask >> error_index & 1 == 1).then_some(correction_mask & 64 == 0)),
        position_std,
        yaw_std,
    }
}

/// Reads a random leg length from the fuzz input: a distance in m, an angle in rad, or a duration in s.
fn read_leg_size(fuzz_input: &mut InputReader) -> f64 {
    if fuzz_input.next_bool() { fuzz_input.choose_one(&[0.1, 0.2, 0.25, 0.5]) } else { fuzz_input.draw_number_within(1e-6..=1e6) }
}

type LogRow = (f64, SE2);

fn choose_number_or_draw_any(number_choices: &[f64], fuzz_input: &mut InputReader) -> f64 {
    let choice_index = fuzz_input.next_below(number_choices.len() + 1);
    number_choices.get(choice_index).copied().unwrap_or_else(|| fuzz_input.draw_number_within(-1e9..=1e9))
}

fn read_odometry_rows(fuzz_input: &mut InputReader, max_section_rows: usize) -> Vec<LogRow> {
    let time_step = choose_number_or_draw_any(&[0.05, 0.1, 0.1, 0.5, 1.0], fuzz_input).abs();
    let mut log_rows = vec![(choose_number_or_draw_any(&[0.0, 10.0, 1.7e9], fuzz_input), SE2::identity())];
    for _ in 0..=fuzz_input.next_below(MAX_ADDED_SECTIONS) {
        let v = choose_number_or_draw_any(&[0.0, 0.2, 0.5, 0.8, -0.3], fuzz_input);
        let omega = choose_number_or_draw_any(&[0.0, 0.2, -0.4, 0.9, -0.9], fuzz_input);
        for _ in 0..1 + usize::from(fuzz_input.next_byte()) % max_section_rows {
            let (row_time, last_pose) = log_rows[log_rows.len() - 1];
            log_rows.push((row_time + time_step, last_pose.boxplus(Vector3::new(v, 0.0, omega) * time_step)));
        }
    }
    log_rows
}

/// Returns the rows of the reference log. They are the rows of the odometry with an error in each step, and with occasional jumps.
fn read_reference_rows(odometry: &[LogRow], fuzz_input: &mut InputReader) -> Vec<LogRow> {
    let clock_offset = choose_number_or_draw_any(&[0.0, 0.12, -3.0, 50.0], fuzz_input);
    let mount_pose = SE2::new(0.1 * f64::from(fuzz_input.next_below(3) as u8), 0.0, choose_number_or_draw_any(&[0.0, 0.07, 3.0], fuzz_input));
    let relative_noise = choose_number_or_draw_any(&[0.0, 0.01, 0.1, 0.5], fuzz_input);
    let jump_interval = usize::from(fuzz_input.next_byte());
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(u64::from(fuzz_input.next_byte()));
    let mut pose = SE2::new(1.0, 2.0, 3.0);
    let mut reference_log = vec![(odometry[0].0 + clock_offset, pose * mount_pose)];
    for (i, adjacent_rows) in odometry.windows(2).enumerate() {
        let odometry_motion = adjacent_rows[1].1.boxminus(&adjacent_rows[0].1);
        let motion_noise = Vector3::from_fn(|_, _| rng.random_range(-1.0..=1.0)) * relative_noise * odometry_motion.norm();
        pose = pose.boxplus(odometry_motion + motion_noise);
        if jump_interval > 0 && i % jump_interval == 0 {
            pose = SE2::new(0.5, 0.0, 0.0) * pose;
        }
        reference_log.push((adjacent_rows[1].0 + clock_offset, pose * mount_pose));
    }
    reference_log
}

/// Changes or removes randomly chosen rows of a log.
fn edit_rows(log_rows: &mut Vec<LogRow>, fuzz_input: &mut InputReader) {
    for _ in 0..fuzz_input.next_below(4) {
        let row_index = usize::from(u16::from_le_bytes(fuzz_input.next_bytes())) % log_rows.len();
        let (row_time, pose) = log_rows[row_index];
        let [x, y, theta] = [pose.x(), pose.y(), pose.theta()];
        match fuzz_input.next_below(6) {
            0 => log_rows[row_index].0 = fuzz_input.next_number(),
            1 => log_rows[row_index].1 = SE2::new(fuzz_input.next_number(), y, theta),
            2 => log_rows[row_index].1 = SE2::new(x, y, fuzz_input.next_number()),
            3 => log_rows[row_index..].iter_mut().for_each(|row| row.0 += 10.0),
            4 => log_rows[row_index].0 = row_time.next_up(),
            _ => drop(log_rows.drain(row_index..(row_index + 1 + usize::from(fuzz_input.next_byte()) % MAX_SECTION_ROWS).min(log_rows.len()))),
        }
        if log_rows.is_empty() {
            log_rows.push((row_time, pose));
        }
    }
}

/// Returns the trajectory of the rows, with breaks (positions at which the pose may jump) before randomly chosen rows. Returns None if the
/// trajectory is refused because of a row.
fn build_trajectory(rows: &[LogRow], fuzz_input: &mut InputReader) -> Option<Trajectory> {
    let trajectory_or_error = match fuzz_input.next_below(4) {
        // The coordinates x and θ of the poses are used as speed and turn rate, because the velocities are arbitrary.
        0 => Trajectory::from_commands(rows.iter().map(|(row_time, pose)| (*row_time, pose.x(), pose.theta()))),
        _ => Trajectory::new(rows.iter().copied()),
    };
    match trajectory_or_error {
        Ok(trajectory) => {
            assert!(rows.is_sorted_by(|a, b| a.0 < b.0));
            let break_indices: Vec<usize> = (0..fuzz_input.next_below(4)).map(|_| usize::from(fuzz_input.next_byte())).collect();
            Some(trajectory.with_breaks_before(break_indices))
        }
        Err(TrajectoryError::NotLater { sample: refused_index }) => {
            assert!(refused_index > 0 && rows[refused_index].0 <= rows[refused_index - 1].0);
            None
        }
        // Poses after large commands may exceed the range of doubles, so that the trajectory is refused.
        Err(TrajectoryError::NotFinite { sample: refused_index }) => {
            assert!(refused_index < rows.len());
            None
        }
    }
}

fn assert_calibration(calibration: &Calibration, calibration_options: &Options) {
    let Calibration { alphas, intervals, not_identifiable, legs, observations, leg_fits, .. } = calibration;
    assert!(legs.len() >= MIN_LEGS);
    assert_eq!([observations.len(), leg_fits.len()], [legs.len(); 2]);
    let alpha_count = calibration_options.model.alpha_count();
    assert_eq!([alphas.len(), intervals.len(), not_identifiable.len()], [alpha_count; 3]);
    for (k, fitted_alpha) in alphas.iter().enumerate() {
        assert_eq!([fitted_alpha.is_none(), intervals[k].is_none()], [not_identifiable[k].is_some(); 2]);
        let Some((fitted_alpha, [interval_low, interval_high])) = fitted_alpha.zip(intervals[k]) else { continue };
        let is_in_interval = 0.0 <= interval_low && interval_low <= fitted_alpha && fitted_alpha <= interval_high && fitted_alpha.is_finite();
        assert!(is_in_interval, "α{}: {interval_low} {fitted_alpha} {interval_high}", k + 1);
    }
    for noise_estimate in calibration.reference_noise {
        let [interval_low, interval_high] = noise_estimate.interval;
        assert!(0.0 <= interval_low && interval_low <= noise_estimate.value && noise_estimate.value <= interval_high, "{noise_estimate:?}");
    }
    // A log is unusable if squares of its coordinates exceed the range of doubles.
    let is_usable = calibration.diagnostics.verdict != Verdict::Unusable;
    assert!(!is_usable || !calibration.log_likelihood.is_nan());
    for (i, error_kind) in SystematicError::ALL.into_iter().enumerate() {
        let (error_estimate, error_interval) = (calibration.systematic.get(error_kind), calibration.interval_of(error_kind));
        assert!(error_estimate.is_finite() && error_interval.is_none_or(|[interval_low, interval_high]| interval_low <= error_estimate && error_estimate <= interval_high));
        let may_be_corrected = error_interval.is_some() && calibration_options.correct[i] != Some(false);
        assert!(may_be_corrected || !calibration.is_corrected[i], "{error_kind:?}");
    }
    for adjacent_legs in legs.windows(2) {
        assert!(adjacent_legs[0].times[1] <= adjacent_legs[1].times[0]);
    }
    assert!(legs.iter().all(|leg| leg.times[0] < leg.times[1]));
    for leg_fit in leg_fits {
        let is_fit_finite = leg_fit.squared.is_finite() && leg_fit.stds.iter().all(|innovation_std| innovation_std.is_nan() || *innovation_std >= 0.0);
        assert!(!is_usable || is_fit_finite, "{leg_fit:?}");
        assert!(calibration_options.outliers == Outliers::Reject || !leg_fit.is_outlier);
    }
    assert_diagnostics(calibration);
}

fn assert_diagnostics(Calibration { alphas, diagnostics, persistence: error_persistence, recommended: recommendation, .. }: &Calibration) {
    for Check { name: check_name, value: check_value, expected: [interval_low, interval_high], passed: has_passed, cause: failure_cause, drives: _, message: failure_message } in &diagnostics.checks {
        assert_eq!(failure_message.is_empty(), *has_passed, "{check_name:?}");
        assert!(failure_cause.is_none() || !has_passed, "{check_name:?}");
        assert_eq!(*has_passed, interval_low <= check_value && check_value <= interval_high, "{check_name:?}: {check_value} {interval_low} {interval_high}");
    }
    let have_all_passed = diagnostics.checks.iter().all(|diagnostic_check| diagnostic_check.passed);
    assert!(have_all_passed || diagnostics.verdict != Verdict::Consistent);
    for leg_window in diagnostics.windows.iter().filter(|leg_window| leg_window.count > 0) {
        assertions::assert_fraction("covered windows", leg_window.coverage);
    }
    assertions::assert_fraction("persistence", error_persistence.correlation.value);
    assert_eq!(recommendation.is_none(), diagnostics.verdict == Verdict::Unusable);
    let Some(recommendation) = recommendation else { return };
    assert!((1.0..=100.0).contains(&recommendation.inflation), "{recommendation:?}");
    for (alpha, inflated_alpha) in alphas.iter().zip(&recommendation.alphas) {
        assert_eq!(alpha.map(|alpha| alpha * recommendation.inflation), *inflated_alpha);
    }
}
