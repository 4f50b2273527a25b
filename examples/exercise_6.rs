//! Exercise 6: triangular noise as a sum of two uniform numbers, instead of normal noise.
//! `cargo run --release --example exercise_6`

use motion::geom::se2::SE2;
use motion::stats::{CartesianMoments, cross_track_skew};
use motion::{MotionModel, NoiseKind, Variance, VelocityAlphas, VelocityCmd, VelocityModel};
use rand::{Rng, RngExt, SeedableRng, rngs::SmallRng};

/// Returns a random number with a triangular distribution and the standard deviation b. Two uniform numbers on ±1 have the variance ⅓ each.
/// Their sum times b·√6/2 has the variance b², and an absolute value of at most √6·b.
fn sample_triangular_distribution<R: Rng + ?Sized>(variance: Variance, rng: &mut R) -> f64 {
    let mut draw_uniform = || rng.random::<f64>() * 2.0 - 1.0;
    (6.0 * variance.0).sqrt() / 2.0 * (draw_uniform() + draw_uniform())
}

fn main() {
    let mut rng = SmallRng::seed_from_u64(7);
    let noise_variance = Variance(0.025);
    let draws: Vec<f64> =
        (0..200_000).map(|_| sample_triangular_distribution(noise_variance, &mut rng)).collect();
    let sample_variance = draws.iter().map(|draw| draw * draw).sum::<f64>() / draws.len() as f64;
    println!("variance {sample_variance:.5}, asked for {}", noise_variance.0);

    let command = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
    let alphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]);
    for noise in [NoiseKind::Normal, NoiseKind::Triangular] {
        let model = VelocityModel { alphas, noise };
        let sampled_poses: Vec<SE2> =
            (0..200_000).map(|_| model.sample(&command, &SE2::identity(), &mut rng)).collect();
        let moments = CartesianMoments::from_poses(&sampled_poses);
        let heading_errors = sampled_poses.iter().map(|pose| (pose.theta() - 0.5).abs());
        println!(
            "{noise:?}: Σxx {:.5}, Σyy {:.5}, skew {:.3}, furthest heading off by {:.3} rad",
            moments.cov[(0, 0)],
            moments.cov[(1, 1)],
            cross_track_skew(&sampled_poses),
            heading_errors.fold(0.0, f64::max),
        );
    }
}
