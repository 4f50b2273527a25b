//! The chapter's worked example: the arc, what an EKF makes of its noise, and what 200 000 robots do.
//! `cargo run --release --example worked_example`

use motion::geom::se2::SE2;
use motion::stats::{CartesianMoments, ExponentialMoments, cross_track_skew};
use motion::{MotionModel, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel};
use rand::{SeedableRng, rngs::SmallRng};

fn main() {
    let command = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
    let alphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]);
    let model = VelocityModel { alphas, noise: NoiseKind::Normal };
    let start = SE2::identity();

    let twist = TangentNoiseModel::twist(&command);
    let end = SE2::exp(&twist);
    println!("noise-free end  ({:.6}, {:.6}, {:.6})", end.x(), end.y(), end.theta());
    println!("linearized Σ    {:.6}", model.cartesian_cov(&command, &start));

    let mut rng = SmallRng::seed_from_u64(7);
    let poses: Vec<SE2> = (0..200_000).map(|_| model.sample(&command, &start, &mut rng)).collect();
    let (floor, tangent) =
        (CartesianMoments::from_poses(&poses), ExponentialMoments::from_poses(&poses, &start));
    println!("measured Σ      {:.6}", floor.cov);
    println!("mean of ξ       {:.4}   commanded {:.4}", tangent.mean.transpose(), twist.transpose());
    println!("covariance of ξ {:.5}", tangent.cov);
    println!("cross-track skew {:.3}, and 0 for any Gaussian in (x, y)", cross_track_skew(&poses));
}
