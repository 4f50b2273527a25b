//! Calibration of simulated logs whose α's and systematic errors are known.

mod accuracy;
mod checks;
mod errors;
mod identifiability;
mod likelihood;
mod logs;
mod simulated;
mod windows;

use crate::common::seeded_rng;
use motion::calibrate::{
    Calibration, Drive, Leg, LegLength, LostLegs, Model, Options, Trajectory, calibrate,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::{NoiseKind, Variance};
use nalgebra::Vector3;
use simulated::Simulation;

const NAV2: Model = Model::Odometry(OdometryRule::Nav2);

fn calibrate_simulation(simulation: &Simulation) -> Calibration {
    calibrate_log(&simulation.simulate_log(), &simulation.calibration_options())
}

fn calibrate_log(odometry_and_reference: &[Trajectory; 2], calibration_options: &Options) -> Calibration {
    let [odometry_log, reference_log] = odometry_and_reference.clone();
    calibrate(&[Drive { odometry: odometry_log, reference: reference_log }], calibration_options)
        .expect("enough legs")
}

/// Returns the legs of a log, and the numbers of omitted legs.
fn split_into_legs(
    odometry_log: &Trajectory,
    reference_log: &Trajectory,
    leg_length: LegLength,
    clock_offset: f64,
) -> (Vec<Leg>, LostLegs) {
    let (mut legs, mut lost_legs) = (Vec::new(), LostLegs::default());
    let drive = Drive { odometry: odometry_log.clone(), reference: reference_log.clone() };
    drive.cut_into_legs(0, leg_length, clock_offset, &mut legs, &mut lost_legs);
    (legs, lost_legs)
}

fn options_of(model: Model) -> Options {
    Simulation::new(model, 0, 0).calibration_options()
}

fn new_trajectory(timed_poses: impl IntoIterator<Item = (f64, SE2)>) -> Trajectory {
    Trajectory::new(timed_poses.into_iter().collect::<Vec<_>>()).expect("times rise")
}

/// Returns the odometry with normal noise added to each step. `step_stds` are the standard deviations of distance (m) and heading (rad).
fn add_step_noise(odometry_log: &Trajectory, step_stds: [f64; 2], rng_seed: u64) -> Trajectory {
    let (mut rng, mut noisy_pose) = (seeded_rng(rng_seed), SE2::identity());
    let odometry_samples: Vec<(f64, SE2)> = odometry_log.samples().collect();
    new_trajectory(odometry_samples.windows(2).map(|sample_pair| {
        let [distance_noise, turn_noise] =
            step_stds.map(|step_std| NoiseKind::Normal.sample(Variance(step_std * step_std), &mut rng));
        noisy_pose = noisy_pose.boxplus(
            sample_pair[1].1.boxminus(&sample_pair[0].1) + Vector3::new(distance_noise, 0.0, turn_noise),
        );
        (sample_pair[1].0, noisy_pose)
    }))
}
