//! Exercise 7: covariances propagated along twenty steps, compared with rollouts.
//! `cargo run --release --example exercise_7`

use motion::geom::se2::SE2;
use motion::{
    Compounding, MotionModel, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel,
};
use nalgebra::Matrix3;
use rand::{SeedableRng, rngs::SmallRng};

const COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 0.2 };
const STEP_COUNT: usize = 20;
const ROLLOUT_COUNT: usize = 50_000;
const RECURSIONS: [Compounding; 3] =
    [Compounding::Chapter, Compounding::FirstOrder, Compounding::FourthOrder];

fn main() {
    for (noise_name, heading_factor) in [("the chapter's noise", 1.0), ("the heading's noise doubled", 4.0)] {
        let turn_alpha = 0.02 * heading_factor;
        let alphas = VelocityAlphas([
            0.02,
            0.02,
            turn_alpha,
            turn_alpha,
            0.005 * heading_factor,
            0.005 * heading_factor,
        ]);
        let model = VelocityModel { alphas, noise: NoiseKind::Normal };
        println!("{noise_name}: predicted over measured variance (along, lateral, heading)");
        println!("step   the chapter's             with J_r                  fourth order");
        let twist = TangentNoiseModel::twist(&COMMAND);
        let tangent_model =
            TangentNoiseModel::from_velocity(&model, &COMMAND).expect("variances of 0 or more");
        let mut rng = SmallRng::seed_from_u64(7);
        let mut robot_poses = vec![SE2::identity(); ROLLOUT_COUNT];
        let mut nominal_pose = SE2::identity();
        let mut predicted_covs = [Matrix3::zeros(); 3];
        for step in 1..=STEP_COUNT {
            robot_poses.iter_mut().for_each(|pose| *pose = model.sample(&COMMAND, pose, &mut rng));
            nominal_pose = nominal_pose.boxplus(twist);
            for (predicted_cov, recursion) in predicted_covs.iter_mut().zip(RECURSIONS) {
                *predicted_cov = tangent_model.propagate(predicted_cov, &twist, recursion);
            }
            let pose_errors = robot_poses.iter().map(|pose| pose.boxminus(&nominal_pose));
            let measured_cov =
                pose_errors.map(|xi| xi * xi.transpose()).sum::<Matrix3<f64>>() / ROLLOUT_COUNT as f64;
            let variance_ratios = predicted_covs
                .map(|predicted_cov| predicted_cov.diagonal().component_div(&measured_cov.diagonal()));
            let [a, b, c] =
                variance_ratios.map(|ratio| format!("{:.3} {:.3} {:.3}", ratio.x, ratio.y, ratio.z));
            println!("{step:4}   {a}         {b}         {c}");
        }
    }
}
