//! Worked example of the chapter: the arc, the covariance that an EKF predicts, and the moments of 200 000 sampled robots.
//! `cargo run --release --example worked_example`

use motion::geom::se2::SE2;
use motion::stats::{CartesianMoments, ExponentialMoments, cross_track_skew};
use motion::{MotionModel, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel};
use rand::{SeedableRng, rngs::SmallRng};

fn main() {
    let command = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
    let alphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]);
    let model = VelocityModel { alphas, noise: NoiseKind::Normal };
    let start_pose = SE2::identity();

    let twist = TangentNoiseModel::twist(&command);
    let end_pose = SE2::exp(&twist);
    println!("noise-free end  ({:.6}, {:.6}, {:.6})", end_pose.x(), end_pose.y(), end_pose.theta());
    println!("linearized Σ    {:.6}", model.cartesian_cov(&command, &start_pose));

    let mut rng = SmallRng::seed_from_u64(7);
    let poses: Vec<SE2> = (0..200_000).map(|_| model.sample(&command, &start_pose, &mut rng)).collect();
    let (cartesian_moments, exponential_moments) =
        (CartesianMoments::from_poses(&poses), ExponentialMoments::from_poses(&poses, &start_pose));
    println!("measured Σ      {:.6}", cartesian_moments.cov);
    println!(
        "mean of ξ       {:.4}   commanded {:.4}",
        exponential_moments.mean.transpose(),
        twist.transpose()
    );
    println!("covariance of ξ {:.5}", exponential_moments.cov);
    println!("cross-track skew {:.3}, and 0 for any Gaussian in (x, y)", cross_track_skew(&poses));
}
