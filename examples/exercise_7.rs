//! Exercise 7: covariances carried along twenty steps, against rollouts.
//! `cargo run --release --example exercise_7`

use motion::geom::se2::SE2;
use motion::{
    Compounding, MotionModel, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel,
};
use nalgebra::Matrix3;
use rand::{SeedableRng, rngs::SmallRng};

const COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 0.2 };
const STEPS: usize = 20;
const ROLLOUTS: usize = 50_000;
const ORDERS: [Compounding; 3] = [Compounding::Chapter, Compounding::FirstOrder, Compounding::FourthOrder];

fn main() {
    for (name, heading) in [("the chapter's noise", 1.0), ("the heading's noise doubled", 4.0)] {
        let turn = 0.02 * heading;
        let alphas = VelocityAlphas([0.02, 0.02, turn, turn, 0.005 * heading, 0.005 * heading]);
        let model = VelocityModel { alphas, noise: NoiseKind::Normal };
        println!("{name}: predicted over measured variance (along, lateral, heading)");
        println!("step   the chapter's             with J_r                  fourth order");
        let twist = TangentNoiseModel::twist(&COMMAND);
        let tangent = TangentNoiseModel::from_velocity(&model, &COMMAND).expect("variances of 0 or more");
        let mut rng = SmallRng::seed_from_u64(7);
        let mut poses = vec![SE2::identity(); ROLLOUTS];
        let mut nominal = SE2::identity();
        let mut sigmas = [Matrix3::zeros(); 3];
        for step in 1..=STEPS {
            poses.iter_mut().for_each(|pose| *pose = model.sample(&COMMAND, pose, &mut rng));
            nominal = nominal.boxplus(twist);
            for (sigma, order) in sigmas.iter_mut().zip(ORDERS) {
                *sigma = tangent.propagate(sigma, &twist, order);
            }
            let spread = poses.iter().map(|pose| pose.boxminus(&nominal));
            let measured = spread.map(|xi| xi * xi.transpose()).sum::<Matrix3<f64>>() / ROLLOUTS as f64;
            let ratios = sigmas.map(|sigma| sigma.diagonal().component_div(&measured.diagonal()));
            let [a, b, c] = ratios.map(|ratio| format!("{:.3} {:.3} {:.3}", ratio.x, ratio.y, ratio.z));
            println!("{step:4}   {a}         {b}         {c}");
        }
    }
}
