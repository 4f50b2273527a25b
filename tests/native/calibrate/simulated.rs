//! Logs of robots whose α's and errors are known.

use super::trajectory;
use crate::common::seeded;
use motion::calibrate::{
    LegLength, Model, Options, Outliers, Systematic, SystematicError as Error, Trajectory,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::{NoiseKind, OdomDelta, Variance, VelocityAlphas, VelocityCmd, VelocityModel};
use nalgebra::Vector3;
use rand::{Rng, RngExt};

/// True α's of every simulated robot.
pub const ALPHAS: [f64; 6] = [0.03, 0.01, 0.02, 0.005, 0.015, 0.008];

/// Every model and rule.
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
    /// Noise as the model assumes it.
    None,
    /// Student's t distribution with this number of degrees of freedom.
    Tails(usize),
    /// Autocorrelated noise: this fraction of the noise of the previous leg, plus independent noise.
    Autoregressive(f64),
    /// Standard deviation times this factor.
    Times(f64),
    /// Standard deviation as a function of the position in the log, from 0 to 1.
    Changing(fn(f64) -> f64),
}

/// Parameters of a simulated log.
#[derive(Clone, Copy, Debug)]
pub struct Simulation {
    pub model: Model,
    pub legs: LegLength,
    /// Number of legs.
    pub count: usize,
    pub errors: Systematic,
    /// Fraction of legs in which the reference jumps by half a metre and stays there.
    pub jumps: f64,
    /// Function from the number of a leg to its v and ω; `None` draws random ones.
    pub drive: Option<fn(usize) -> [f64; 2]>,
    pub violation: Violation,
    pub seed: u64,
    /// Standard deviations of the reference, m and rad.
    pub reference_stds: [f64; 2],
}

impl Simulation {
    pub fn of(model: Model, count: usize, seed: u64) -> Self {
        Self {
            model,
            legs: LegLength::AMCL,
            count,
            errors: Systematic::NONE,
            jumps: 0.0,
            drive: None,
            violation: Violation::None,
            seed,
            reference_stds: [0.0; 2],
        }
    }

    /// Returns the options for a calibration of the log.
    pub fn options(&self) -> Options {
        let Self { model, legs, .. } = *self;
        Options {
            model,
            legs,
            outliers: Outliers::Reject,
            correct: [None; 6],
            position_std: None,
            yaw_std: None,
        }
    }

    /// Returns odometry and reference.
    pub fn log(&self) -> [Trajectory; 2] {
        const STEP_SECONDS: f64 = 0.05;
        let mut rng = seeded(self.seed);
        let [distance_scale, turn_scale] =
            [Error::DistanceScale, Error::TurnScale].map(|scale| self.errors.get(scale));
        let mut odometry = vec![(0.0, SE2::identity())];
        let mut base_poses = vec![(0.0, SE2::new(1.0, 2.0, 0.5))];
        let (mut speeds, mut rows_left, mut start_row) = ([0.3, 0.0], 40, 0);
        // Motion since the start of the leg that the odometry would measure without systematic errors.
        let (mut motion, mut leg_rows) = (SE2::identity(), Vec::new());
        let (mut legs, mut unit_noise) = (0, [0.0; 3]);
        while legs < self.count {
            if rows_left == 0 {
                speeds = self.speeds(&mut rng);
                rows_left = rng.random_range(15..60);
            }
            rows_left -= 1;
            let speeds = self.drive.map_or(speeds, |drive| drive(legs));
            let time = odometry.len() as f64 * STEP_SECONDS;
            let twist = Vector3::new(speeds[0], 0.0, speeds[1]) * STEP_SECONDS;
            motion = motion.boxplus(twist);
            let reading_step = Vector3::new(twist.x / distance_scale, 0.0, twist.z / turn_scale);
            odometry.push((time, odometry.last().expect("some").1.boxplus(reading_step)));
            leg_rows.push((time, motion));
            let [(start_time, start), (_, reading)] = [odometry[start_row], odometry[odometry.len() - 1]];
            if !has_leg_ended(self.legs, time - start_time, &start, &reading) {
                continue;
            }
            let from = base_poses.last().expect("some").1;
            unit_noise = self.unit_noise(legs as f64 / self.count as f64, unit_noise, &mut rng);
            let to = from * executed_motion(self.model, &ALPHAS, &motion, time - start_time, unit_noise);
            // The noise of a leg is distributed evenly over its rows.
            let leg_noise = (motion.inverse() * from.inverse() * to).log();
            let progress = |time: f64| (time - start_time) / (leg_rows.len() as f64 * STEP_SECONDS);
            base_poses
                .extend(leg_rows.iter().map(|(t, pose)| (*t, from * pose.boxplus(leg_noise * progress(*t)))));
            if rng.random_bool(self.jumps) {
                let direction = rng.random_range(-3.0..3.0);
                let jump = SE2::new(0.5 * libm::cos(direction), 0.5 * libm::sin(direction), 0.0);
                let (_, last) = base_poses.last_mut().expect("some");
                *last = jump * *last;
            }
            (motion, start_row, legs) = (SE2::identity(), odometry.len() - 1, legs + 1);
            leg_rows.clear();
        }
        let [lever_ahead, lever_left] = self.errors.lever_arm;
        let mount_pose = SE2::new(lever_ahead, lever_left, self.errors.mount_yaw);
        let [position_variance, yaw_variance] = self.reference_stds.map(|std| Variance(std * std));
        let mut reference_error = |variance| NoiseKind::Normal.sample(variance, &mut rng);
        let reference = base_poses.iter().map(|(t, pose)| {
            let sensor_pose = *pose * mount_pose;
            let [x, y, theta] = [
                reference_error(position_variance),
                reference_error(position_variance),
                reference_error(yaw_variance),
            ];
            (
                t + self.errors.clock_offset,
                SE2::new(sensor_pose.x() + x, sensor_pose.y() + y, sensor_pose.theta() + theta),
            )
        });
        [trajectory(odometry), trajectory(reference)]
    }

    /// Returns v and ω of a straight drive, a bend, a turn on the spot or, if the rule allows it, a drive in reverse.
    fn speeds(&self, rng: &mut impl Rng) -> [f64; 2] {
        let [v, bend] = [rng.random_range(0.2..0.6), rng.random_range(-0.5..0.5)];
        match rng.random_range(0..6) {
            0 if self.model != Model::Velocity => [0.0, if bend > 0.0 { 0.6 } else { -0.6 }],
            0 => [0.06, 2.0 * bend],
            1 if self.model != Model::Odometry(OdometryRule::Table) => [-v, bend],
            2 => [v, 0.0],
            _ => [v, 2.0 * bend],
        }
    }

    /// Returns the three unit noises of a leg, from those of the leg before it and the position in the log, from 0 to 1.
    fn unit_noise(&self, fraction: f64, previous: [f64; 3], rng: &mut impl Rng) -> [f64; 3] {
        previous.map(|previous| {
            let unit_draw = NoiseKind::Normal.sample(Variance(1.0), rng);
            match self.violation {
                Violation::None => unit_draw,
                Violation::Tails(freedom) => {
                    let normal = |_| NoiseKind::Normal.sample(Variance(1.0), rng);
                    let chi_squared: f64 = (0..freedom).map(normal).map(|z| z * z).sum();
                    unit_draw * f64::sqrt((freedom as f64 - 2.0) / chi_squared)
                }
                Violation::Autoregressive(correlation) => {
                    correlation * previous + (1.0 - correlation * correlation).sqrt() * unit_draw
                }
                Violation::Times(times) => times * unit_draw,
                Violation::Changing(deviation) => deviation(fraction) * unit_draw,
            }
        })
    }
}

/// Returns the motion that a robot executed if its odometry read the motion `reading_motion` within `dt`, from noises with variance 1.
pub fn executed_motion(
    model: Model,
    alphas: &[f64; 6],
    reading_motion: &SE2,
    dt: f64,
    unit_noise: [f64; 3],
) -> SE2 {
    let start = SE2::identity();
    match model {
        Model::Odometry(rule) => {
            let reading = OdomDelta::from_poses(&start, reading_motion);
            let alphas = std::array::from_fn(|k| alphas[k]);
            rule.variances(&reading, &alphas).executed_motion(&rule.legs(&reading), unit_noise).poses(&start)
                [3]
        }
        Model::Velocity => {
            let twist = reading_motion.log();
            let command = VelocityCmd { v: twist.x / dt, omega: twist.z / dt, dt };
            let model = VelocityModel { alphas: VelocityAlphas(*alphas), noise: NoiseKind::Normal };
            model.apply_noise(&command, &start, unit_noise)
        }
    }
}

/// Relative tolerance of the length of a leg: sums of equal steps reach a limit up to rounding.
const ROUNDING: f64 = 1e-6;

/// Returns true if a leg ends at a reading, as `LegLength` documents it, by independent code.
fn has_leg_ended(legs: LegLength, duration_so_far: f64, start: &SE2, reading: &SE2) -> bool {
    match legs {
        LegLength::Displacement { distance, angle } => {
            let turn = motion::geom::se2::wrap_angle(reading.theta() - start.theta());
            let displacement = [reading.x() - start.x(), reading.y() - start.y()];
            let largest_displacement = displacement
                .iter()
                .fold(0.0, |largest_displacement, along| f64::max(largest_displacement, along.abs()));
            largest_displacement > distance * (1.0 + ROUNDING) || turn.abs() > angle * (1.0 + ROUNDING)
        }
        LegLength::Duration { duration } => duration_so_far > duration - 1e-6,
    }
}
