//! Logs of simulated robots whose α's and systematic errors are known.

use super::new_trajectory;
use crate::common::seeded_rng;
use motion::calibrate::{
    LegLength, Model, Options, Outliers, Systematic, SystematicError as Error, Trajectory,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::{NoiseKind, OdomDelta, Variance, VelocityAlphas, VelocityCmd, VelocityModel};
use nalgebra::Vector3;
use rand::{Rng, RngExt};

pub const ALPHAS: [f64; 6] = [0.03, 0.01, 0.02, 0.005, 0.015, 0.008];

pub const MODELS: [Model; 5] = [
    Model::Odometry(OdometryRule::Table),
    Model::Odometry(OdometryRule::Nav2),
    Model::Odometry(OdometryRule::Beluga),
    Model::Odometry(OdometryRule::Omni),
    Model::Velocity,
];

/// Violation of the model's assumption that the unit noises of all legs are independent and normal, with variance 1.
#[derive(Clone, Copy, Debug)]
pub enum Violation {
    None,
    /// Noise with Student's t distribution, with this number of degrees of freedom.
    HeavyTailedNoise(usize),
    AutocorrelatedNoise(f64),
    ScaledNoise(f64),
    /// Noise whose standard deviation is a function of the position in the log, from 0 to 1.
    ChangingNoise(fn(f64) -> f64),
}

#[derive(Clone, Copy, Debug)]
pub struct Simulation {
    pub model: Model,
    pub leg_length: LegLength,
    pub leg_count: usize,
    pub systematic_errors: Systematic,
    /// Fraction of legs in which the reference jumps by half a metre and stays there.
    pub jump_fraction: f64,
    /// Function from the index of a leg to its v and ω. `None` draws random velocities.
    pub velocity_of_leg: Option<fn(usize) -> [f64; 2]>,
    pub noise_violation: Violation,
    pub seed: u64,
    pub reference_stds: [f64; 2],
    pub sample_times: SampleTimes,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SampleTimes {
    /// Odometry and reference both have a sample every 50 ms.
    Synchronous,
    /// Odometry and reference have samples at unrelated times. Their sample intervals are these multiples of [`FINE_STEP_SECONDS`]. The
    /// noise of a leg is then a random walk.
    Asynchronous([usize; 2]),
}

const STEP_SECONDS: f64 = 0.05;
const FINE_STEP_SECONDS: f64 = 0.005;

impl Simulation {
    pub fn new(model: Model, leg_count: usize, seed: u64) -> Self {
        Self {
            model,
            leg_length: LegLength::AMCL,
            leg_count,
            systematic_errors: Systematic::NONE,
            jump_fraction: 0.0,
            velocity_of_leg: None,
            noise_violation: Violation::None,
            seed,
            reference_stds: [0.0; 2],
            sample_times: SampleTimes::Synchronous,
        }
    }

    pub fn calibration_options(&self) -> Options {
        let Self { model, leg_length, .. } = *self;
        Options {
            model,
            legs: leg_length,
            outliers: Outliers::Reject,
            correct: [None; 6],
            position_std: None,
            yaw_std: None,
        }
    }

    pub fn simulate_log(&self) -> [Trajectory; 2] {
        let (step_seconds, [rows_per_reading, rows_per_reference]) = match self.sample_times {
            SampleTimes::Synchronous => (STEP_SECONDS, [1, 1]),
            SampleTimes::Asynchronous(sample_intervals) => (FINE_STEP_SECONDS, sample_intervals),
        };
        let rows_per_step = (STEP_SECONDS / step_seconds).round() as usize;
        let mut rng = seeded_rng(self.seed);
        let [distance_scale, turn_scale] =
            [Error::DistanceScale, Error::TurnScale].map(|scale_kind| self.systematic_errors.get(scale_kind));
        let mut odometry_samples = vec![(0.0, SE2::identity())];
        let mut base_poses = vec![(0.0, SE2::new(1.0, 2.0, 0.5))];
        let (mut drawn_velocity, mut remaining_rows, mut start_row) = ([0.3, 0.0], 40 * rows_per_step, 0);
        // Motion since the start of the leg, as the odometry would measure it without systematic errors.
        let (mut leg_motion, mut leg_rows) = (SE2::identity(), Vec::new());
        let (mut leg_index, mut unit_noise) = (0, [0.0; 3]);
        while leg_index < self.leg_count {
            if remaining_rows == 0 {
                drawn_velocity = self.sample_velocity(&mut rng);
                remaining_rows = rng.random_range(15..60) * rows_per_step;
            }
            remaining_rows -= 1;
            let drawn_velocity =
                self.velocity_of_leg.map_or(drawn_velocity, |velocity_of_leg| velocity_of_leg(leg_index));
            let row_time = odometry_samples.len() as f64 * step_seconds;
            let step_twist = Vector3::new(drawn_velocity[0], 0.0, drawn_velocity[1]) * step_seconds;
            leg_motion = leg_motion.boxplus(step_twist);
            let odometry_twist = Vector3::new(step_twist.x / distance_scale, 0.0, step_twist.z / turn_scale);
            odometry_samples
                .push((row_time, odometry_samples.last().expect("some").1.boxplus(odometry_twist)));
            leg_rows.push((row_time, leg_motion));
            let [(start_time, start_pose), (_, odometry_pose)] =
                [odometry_samples[start_row], odometry_samples[odometry_samples.len() - 1]];
            let has_reading = (odometry_samples.len() - 1) % rows_per_reading == 0;
            if !has_reading
                || !has_leg_ended(self.leg_length, row_time - start_time, &start_pose, &odometry_pose)
            {
                continue;
            }
            let base_start = base_poses.last().expect("some").1;
            unit_noise =
                self.sample_unit_noise(leg_index as f64 / self.leg_count as f64, unit_noise, &mut rng);
            // The noise of a leg is distributed evenly over its rows, plus a random walk that returns to 0.
            let row_count = leg_rows.len();
            let mut random_walk = vec![[0.0; 3]];
            for row_index in 0..row_count {
                let step_std = 1.0 / (row_count as f64).sqrt();
                random_walk
                    .push(random_walk[row_index].map(|sum| sum + step_std * self.sample_walk_step(&mut rng)));
            }
            let twist_noise_of = |unit_noise| {
                let duration = row_time - start_time;
                let noisy_motion = execute_motion(self.model, &ALPHAS, &leg_motion, duration, unit_noise);
                (leg_motion.inverse() * noisy_motion).log()
            };
            let [leg_noise, mean_noise] = [unit_noise, [0.0; 3]].map(twist_noise_of);
            for (row_index, (t, leg_pose)) in leg_rows.iter().enumerate() {
                let leg_fraction = (row_index + 1) as f64 / row_count as f64;
                let walk_bridge = std::array::from_fn(|k| {
                    random_walk[row_index + 1][k] - leg_fraction * random_walk[row_count][k]
                });
                let row_noise = leg_noise * leg_fraction + twist_noise_of(walk_bridge) - mean_noise;
                base_poses.push((*t, base_start * leg_pose.boxplus(row_noise)));
            }
            if rng.random_bool(self.jump_fraction) {
                let jump_heading = rng.random_range(-3.0..3.0);
                let jump_offset = SE2::new(0.5 * libm::cos(jump_heading), 0.5 * libm::sin(jump_heading), 0.0);
                let (_, last_pose) = base_poses.last_mut().expect("some");
                *last_pose = jump_offset * *last_pose;
            }
            (leg_motion, start_row, leg_index) = (SE2::identity(), odometry_samples.len() - 1, leg_index + 1);
            leg_rows.clear();
        }
        let [lever_ahead, lever_left] = self.systematic_errors.lever_arm;
        let mount_pose = SE2::new(lever_ahead, lever_left, self.systematic_errors.mount_yaw);
        let [position_variance, yaw_variance] =
            self.reference_stds.map(|reference_std| Variance(reference_std * reference_std));
        let mut sample_reference_error = |variance| NoiseKind::Normal.sample(variance, &mut rng);
        let reference_samples = base_poses.iter().map(|(t, leg_pose)| {
            let sensor_pose = *leg_pose * mount_pose;
            let [x, y, theta] = [
                sample_reference_error(position_variance),
                sample_reference_error(position_variance),
                sample_reference_error(yaw_variance),
            ];
            (
                t + self.systematic_errors.clock_offset,
                SE2::new(sensor_pose.x() + x, sensor_pose.y() + y, sensor_pose.theta() + theta),
            )
        });
        [
            new_trajectory(odometry_samples.into_iter().step_by(rows_per_reading)),
            new_trajectory(reference_samples.skip(rows_per_reference / 2).step_by(rows_per_reference)),
        ]
    }

    fn sample_walk_step(&self, rng: &mut impl Rng) -> f64 {
        if self.sample_times == SampleTimes::Synchronous {
            0.0
        } else {
            NoiseKind::Normal.sample(Variance(1.0), rng)
        }
    }

    /// Returns v and ω of a random motion: a straight drive, a bend, a turn on the spot or, unless the rule is Table 5.6, a drive in reverse.
    fn sample_velocity(&self, rng: &mut impl Rng) -> [f64; 2] {
        let [v, turn_rate] = [rng.random_range(0.2..0.6), rng.random_range(-0.5..0.5)];
        match rng.random_range(0..6) {
            0 if self.model != Model::Velocity => [0.0, if turn_rate > 0.0 { 0.6 } else { -0.6 }],
            0 => [0.06, 2.0 * turn_rate],
            1 if self.model != Model::Odometry(OdometryRule::Table) => [-v, turn_rate],
            2 => [v, 0.0],
            _ => [v, 2.0 * turn_rate],
        }
    }

    /// Returns the three noises of a leg, with variance 1. `log_fraction` is the position of the leg in the log, from 0 to 1.
    fn sample_unit_noise(&self, log_fraction: f64, previous_noise: [f64; 3], rng: &mut impl Rng) -> [f64; 3] {
        previous_noise.map(|previous_noise| {
            let normal_noise = NoiseKind::Normal.sample(Variance(1.0), rng);
            match self.noise_violation {
                Violation::None => normal_noise,
                Violation::HeavyTailedNoise(degrees_of_freedom) => {
                    let sample_normal = |_| NoiseKind::Normal.sample(Variance(1.0), rng);
                    let chi_squared: f64 = (0..degrees_of_freedom).map(sample_normal).map(|z| z * z).sum();
                    normal_noise * f64::sqrt((degrees_of_freedom as f64 - 2.0) / chi_squared)
                }
                Violation::AutocorrelatedNoise(noise_autocorrelation) => {
                    noise_autocorrelation * previous_noise
                        + (1.0 - noise_autocorrelation * noise_autocorrelation).sqrt() * normal_noise
                }
                Violation::ScaledNoise(std_factor) => std_factor * normal_noise,
                Violation::ChangingNoise(noise_std_at) => noise_std_at(log_fraction) * normal_noise,
            }
        })
    }
}

/// Returns the motion that a robot executed while its odometry measured `odometry_motion` in the time `duration`.
pub fn execute_motion(
    model: Model,
    alphas: &[f64; 6],
    odometry_motion: &SE2,
    duration: f64,
    unit_noise: [f64; 3],
) -> SE2 {
    let origin_pose = SE2::identity();
    match model {
        Model::Odometry(odometry_rule) => {
            let odom_delta = OdomDelta::from_poses(&origin_pose, odometry_motion);
            let true_alphas_of_model = std::array::from_fn(|k| alphas[k]);
            odometry_rule
                .variances(&odom_delta, &true_alphas_of_model)
                .executed_motion(&odometry_rule.legs(&odom_delta), unit_noise)
                .poses(&origin_pose)[3]
        }
        Model::Velocity => {
            let twist = odometry_motion.log();
            let leg_command = VelocityCmd { v: twist.x / duration, omega: twist.z / duration, dt: duration };
            let velocity_model = VelocityModel { alphas: VelocityAlphas(*alphas), noise: NoiseKind::Normal };
            velocity_model.apply_noise(&leg_command, &origin_pose, unit_noise)
        }
    }
}

/// Relative tolerance of the length of a leg, because sums of equal steps reach a limit only up to rounding.
const ROUNDING_TOLERANCE: f64 = 1e-6;

/// Returns true if a leg ends at the odometry pose, by the rule that `LegLength` documents.
fn has_leg_ended(leg_length: LegLength, elapsed_time: f64, leg_start: &SE2, odometry_pose: &SE2) -> bool {
    match leg_length {
        LegLength::Displacement { distance: min_distance, angle: min_angle } => {
            let turn_of_leg = motion::geom::se2::wrap_angle(odometry_pose.theta() - leg_start.theta());
            let axis_displacements = [odometry_pose.x() - leg_start.x(), odometry_pose.y() - leg_start.y()];
            let largest_displacement = axis_displacements
                .iter()
                .fold(0.0, |max_so_far, axis_displacement| f64::max(max_so_far, axis_displacement.abs()));
            largest_displacement > min_distance * (1.0 + ROUNDING_TOLERANCE)
                || turn_of_leg.abs() > min_angle * (1.0 + ROUNDING_TOLERANCE)
        }
        LegLength::Duration { duration } => elapsed_time > duration - 1e-6,
    }
}
