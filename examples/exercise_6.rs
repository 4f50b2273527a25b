//! Exercise 6: a triangular noise as a sum of two uniforms, in the place of the normal one.
//! `cargo run --release --example exercise_6`

use motion::geom::se2::SE2;
use motion::stats::{CartesianMoments, cross_track_skew};
use motion::{MotionModel, NoiseKind, Variance, VelocityAlphas, VelocityCmd, VelocityModel};
use rand::{Rng, RngExt, SeedableRng, rngs::SmallRng};

/// Two uniforms on ±1 have the variance ⅓ each: their sum times b·√6/2 has b², and is never beyond √6·b.
fn sample_triangular_distribution<R: Rng + ?Sized>(b2: Variance, rng: &mut R) -> f64 {
    let mut uniform = || rng.random::<f64>() * 2.0 - 1.0;
    (6.0 * b2.0).sqrt() / 2.0 * (uniform() + uniform())
}

fn main() {
    let mut rng = SmallRng::seed_from_u64(7);
    let b2 = Variance(0.025);
    let draws: Vec<f64> = (0..200_000).map(|_| sample_triangular_distribution(b2, &mut rng)).collect();
    let variance = draws.iter().map(|draw| draw * draw).sum::<f64>() / draws.len() as f64;
    println!("variance {variance:.5}, asked for {}", b2.0);

    let command = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
    let alphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]);
    for noise in [NoiseKind::Normal, NoiseKind::Triangular] {
        let model = VelocityModel { alphas, noise };
        let poses: Vec<SE2> =
            (0..200_000).map(|_| model.sample(&command, &SE2::identity(), &mut rng)).collect();
        let moments = CartesianMoments::from_poses(&poses);
        let turns = poses.iter().map(|pose| (pose.theta() - 0.5).abs());
        println!(
            "{noise:?}: Σxx {:.5}, Σyy {:.5}, skew {:.3}, furthest heading off by {:.3} rad",
            moments.cov[(0, 0)],
            moments.cov[(1, 1)],
            cross_track_skew(&poses),
            turns.fold(0.0, f64::max),
        );
    }
}
