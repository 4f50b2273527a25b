//! Simulated log that the Alpha Calibrator shows first. Its true α's are known.
//!
//! A robot follows a curve through a hall, and sometimes turns on the spot. Between two updates of a localizer, the true motion and the
//! odometry differ by noise with the variances of Table 5.6. The reference has a lever arm, a mount yaw, a clock offset, and jumps. The
//! wheels deviate from their nominal size.

use super::Truth;
use crate::calibrate::{Drive, Trajectory};
use crate::geom::se2::{SE2, wrap_angle};
use crate::models::{OdomDelta, OdometryRule};
use crate::noise::{NoiseKind, Variance};
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;

/// True parameters of the simulated log, which a calibration should find.
pub const TRUE_PARAMETERS: Truth = Truth {
    alphas: [0.05, 0.008, 0.004, 0.003],
    clock_offset: 0.15,
    mount_yaw: 0.07,
    lever_arm: [0.12, 0.0],
    distance_scale: 1.02,
    turn_scale: 0.97,
};

/// Length of the legs to which the true α's apply, m: the default of `update_min_d` in Nav2's AMCL.
const LEG_DISTANCE: f64 = 0.25;
/// Turn of the legs to which the true α's apply, rad: the default of `update_min_a` in Nav2's AMCL.
const LEG_ANGLE: f64 = 0.2;

/// Jumps of the reference log: size (m), duration in rows, and probability that a jump begins at a row. With these values one leg in 70 is
/// an outlier.
const JUMP_SIZE: f64 = 0.5;
const ROWS_PER_JUMP: usize = 25;
const JUMP_PROBABILITY: f64 = 4e-4;

/// Time between two rows of the log, s, and number of rows.
const ROW_INTERVAL: f64 = 0.02;
const ROW_COUNT: usize = 9000;

const MAX_SPEED: f64 = 0.6;
const MAX_TURN_RATE: f64 = 0.8;

const TURN_INTERVAL: f64 = 20.0;

/// Returns the point (m) that the robot follows, at a phase (rad) of its path: a rosette, which crosses the hall in all directions.
fn target_position(path_phase: f64) -> [f64; 2] {
    let radius = 2.1 + 1.1 * libm::cos(2.4 * path_phase);
    [1.35 * radius * libm::cos(path_phase), radius * libm::sin(path_phase)]
}

struct DriveController {
    /// Phase of the point that the robot follows, rad: see [`target_position`].
    phase: f64,
    remaining_turn: f64,
    next_turn_time: f64,
}

impl DriveController {
    /// Returns the speed (m/s) and turn rate (rad/s) of the robot at a time and estimated pose.
    fn next_speeds(&mut self, row_time: f64, pose: &SE2, rng: &mut Xoshiro256PlusPlus) -> [f64; 2] {
        if row_time >= self.next_turn_time {
            self.next_turn_time += TURN_INTERVAL;
            self.remaining_turn = rng.random_range(1.2..3.0) * if rng.random_bool(0.5) { 1.0 } else { -1.0 };
        }
        if self.remaining_turn != 0.0 {
            let row_turn =
                self.remaining_turn.clamp(-MAX_TURN_RATE * ROW_INTERVAL, MAX_TURN_RATE * ROW_INTERVAL);
            self.remaining_turn -= row_turn;
            return [0.0, row_turn / ROW_INTERVAL];
        }
        // The followed point stays 0.7 m or more ahead of the robot.
        let mut target_point = target_position(self.phase);
        while libm::hypot(target_point[0] - pose.x(), target_point[1] - pose.y()) < 0.7 {
            self.phase += 0.002;
            target_point = target_position(self.phase);
        }
        let bearing = libm::atan2(target_point[1] - pose.y(), target_point[0] - pose.x());
        let heading_error = wrap_angle(bearing - pose.theta());
        let v = MAX_SPEED * libm::cos(heading_error).max(0.0);
        [v, (2.0 * heading_error).clamp(-MAX_TURN_RATE, MAX_TURN_RATE)]
    }
}

struct CurrentLeg {
    odometry_start: SE2,
    true_start: SE2,
    /// Time of each row, and noise-free motion from the start of the leg to that row.
    timed_motions: Vec<(f64, SE2)>,
}

/// Simulates the odometry and the reference of a log, with random numbers from a seed.
pub fn simulate_log(seed: u64) -> Drive {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let [x, y] = target_position(0.0);
    let start_pose = SE2::new(x, y, 1.6);
    let mut drive_controller = DriveController { phase: 0.0, remaining_turn: 0.0, next_turn_time: 6.0 };
    let mut odometry_poses = vec![(0.0, SE2::identity())];
    let mut true_poses = vec![(0.0, start_pose)];
    let mut current_leg = CurrentLeg {
        odometry_start: SE2::identity(),
        true_start: start_pose,
        timed_motions: vec![(0.0, SE2::identity())],
    };
    for row in 1..ROW_COUNT {
        let row_time = ROW_INTERVAL * row as f64;
        let (_, leg_motion) = current_leg.timed_motions[current_leg.timed_motions.len() - 1];
        // The robot steers by its odometry. Steering by the true pose would correct the errors, and correlate them with the turns.
        let [v, omega] =
            drive_controller.next_speeds(row_time, &(start_pose * odometry_poses[row - 1].1), &mut rng);
        let next_motion = leg_motion * SE2::exp(&Vector3::new(v * ROW_INTERVAL, 0.0, omega * ROW_INTERVAL));
        let odometry_twist = Vector3::new(
            v * ROW_INTERVAL / TRUE_PARAMETERS.distance_scale,
            0.0,
            omega * ROW_INTERVAL / TRUE_PARAMETERS.turn_scale,
        );
        let odometry_pose = odometry_poses[row - 1].1 * SE2::exp(&odometry_twist);
        odometry_poses.push((row_time, odometry_pose));
        current_leg.timed_motions.push((row_time, next_motion));
        let has_moved_far = |start_value: f64, end_value: f64| (end_value - start_value).abs() > LEG_DISTANCE;
        let has_turned =
            wrap_angle(odometry_pose.theta() - current_leg.odometry_start.theta()).abs() > LEG_ANGLE;
        if has_moved_far(current_leg.odometry_start.x(), odometry_pose.x())
            || has_moved_far(current_leg.odometry_start.y(), odometry_pose.y())
            || has_turned
        {
            let leg_end = finish_leg(&current_leg, &mut true_poses, &mut rng);
            current_leg = CurrentLeg {
                odometry_start: odometry_pose,
                true_start: leg_end,
                timed_motions: vec![(row_time, SE2::identity())],
            };
        }
    }
    true_poses.extend(
        current_leg
            .timed_motions
            .iter()
            .skip(1)
            .map(|(row_time, leg_motion)| (*row_time, current_leg.true_start * *leg_motion)),
    );
    let create_trajectory = |timed_poses| {
        let Ok(trajectory) = Trajectory::new(timed_poses) else { unreachable!() };
        trajectory
    };
    Drive {
        odometry: create_trajectory(odometry_poses),
        reference: create_trajectory(simulate_reference(&true_poses, &mut rng)),
    }
}

/// Appends the true poses of a finished leg, and returns its true end pose. Each row adds an independent part of the noise. If the noise of
/// a leg were spread evenly over its rows, legs with other boundaries would have too little noise.
fn finish_leg(leg: &CurrentLeg, true_poses: &mut Vec<(f64, SE2)>, rng: &mut Xoshiro256PlusPlus) -> SE2 {
    let [a1, a2, a3, a4] = TRUE_PARAMETERS.alphas;
    let row_motions = &leg.timed_motions[1..];
    let (_, leg_motion) = leg.timed_motions[row_motions.len()];
    let leg_reading = OdomDelta::from_poses(&SE2::identity(), &leg_motion);
    let leg_variances = OdometryRule::Table.variances(&leg_reading, &[a1, a2, a3, a4, 0.0]);
    let variance_per_row = Variance(1.0 / row_motions.len() as f64);
    let mut unit_noise = [0.0; 3];
    let mut leg_end = leg_motion;
    for (row_time, row_motion) in row_motions {
        unit_noise
            .iter_mut()
            .for_each(|row_noise| *row_noise += NoiseKind::Normal.sample(variance_per_row, rng));
        [.., leg_end] = leg_variances.executed_motion(&leg_reading, unit_noise).poses(&SE2::identity());
        true_poses.push((*row_time, leg.true_start * row_motion.boxplus(leg_end.boxminus(&leg_motion))));
    }
    leg.true_start * leg_end
}

fn simulate_reference(true_poses: &[(f64, SE2)], rng: &mut Xoshiro256PlusPlus) -> Vec<(f64, SE2)> {
    let mut jump_offset = SE2::identity();
    let mut remaining_rows = 0;
    true_poses
        .iter()
        .map(|(row_time, pose)| {
            if remaining_rows > 0 {
                remaining_rows -= 1;
            } else if rng.random_bool(JUMP_PROBABILITY) {
                let bearing = TAU * rng.random::<f64>();
                jump_offset = SE2::new(JUMP_SIZE * libm::cos(bearing), JUMP_SIZE * libm::sin(bearing), 0.0);
                remaining_rows = ROWS_PER_JUMP;
            }
            let current_offset = if remaining_rows > 0 { jump_offset } else { SE2::identity() };
            let [lever_arm_ahead, lever_arm_left] = TRUE_PARAMETERS.lever_arm;
            let sensor_pose = *pose * SE2::new(lever_arm_ahead, lever_arm_left, TRUE_PARAMETERS.mount_yaw);
            let measured_pose = SE2::new(
                sensor_pose.x() + current_offset.x(),
                sensor_pose.y() + current_offset.y(),
                sensor_pose.theta(),
            );
            (row_time + TRUE_PARAMETERS.clock_offset, measured_pose)
        })
        .collect()
}
