//! `sample(b²)` and `prob(a, b²)`: both kinds of noise compared with their exact distributions.

use crate::common::{
    MAX_KOLMOGOROV_SMIRNOV, NOISE_KINDS, SAMPLES, Table, kolmogorov_smirnov, seeded, unit_cdf,
};
use motion::{NoiseKind, Variance};

fn draws(kind: NoiseKind, b2: f64, count: usize, seed: u64) -> Vec<f64> {
    let mut rng = seeded(seed);
    (0..count).map(|_| kind.sample(Variance(b2), &mut rng)).collect()
}

#[test]
fn samples_follow_the_exact_distribution() {
    for kind in NOISE_KINDS {
        for (seed, b2) in [(1, 1.0), (2, 0.025), (3, 1e-8), (4, 400.0)] {
            let sample = draws(kind, b2, SAMPLES, seed);
            let distance = kolmogorov_smirnov(sample, |a| unit_cdf(kind, a / b2.sqrt()));
            assert!(distance < MAX_KOLMOGOROV_SMIRNOV, "{kind:?} of variance {b2}: √n·D = {distance}");
        }
    }
}

#[test]
fn prob_is_the_density_of_the_samples() {
    for kind in NOISE_KINDS {
        for b2 in [1e-6, 0.025, 1.0, 90.0] {
            let b = f64::sqrt(b2);
            // Simpson's rule over each of 60 intervals must give the increase of the distribution function, and 1 in total. The kinks of the
            // triangular density lie on ends of intervals.
            let (limit, panels) = (6f64.sqrt() * 4.0 * b, 60);
            let width = 2.0 * limit / panels as f64;
            let mut integral = 0.0;
            for panel in 0..panels {
                let interval_start = -limit + panel as f64 * width;
                let h = width / 64.0;
                let simpson: f64 = (0..=64)
                    .map(|i| {
                        let weight = if i == 0 || i == 64 { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
                        weight * kind.prob(interval_start + i as f64 * h, Variance(b2))
                    })
                    .sum::<f64>()
                    * h
                    / 3.0;
                let increase_of_cdf =
                    unit_cdf(kind, (interval_start + width) / b) - unit_cdf(kind, interval_start / b);
                assert!(
                    (simpson - increase_of_cdf).abs() < 3e-10,
                    "{kind:?} b² = {b2} at {interval_start}: {simpson}, not {increase_of_cdf}"
                );
                integral += simpson;
            }
            assert!((integral - 1.0).abs() < 1e-9, "{kind:?} b² = {b2}: integral {integral}");
            assert_eq!(kind.prob(0.3 * b, Variance(b2)), kind.prob(-0.3 * b, Variance(b2)));
        }
        // With variance 1 the densities at 0 are 1/√(2π) and 1/√6.
        let peak = kind.prob(0.0, Variance(1.0));
        let expected =
            if kind == NoiseKind::Normal { 0.398_942_280_401_432_7 } else { 0.408_248_290_463_863 };
        assert!((peak - expected).abs() < 1e-15);
    }
}

#[test]
fn with_zero_variance_samples_are_zero_and_prob_is_zero_or_one() {
    for kind in NOISE_KINDS {
        let mut rng = seeded(8);
        for _ in 0..100 {
            assert_eq!(kind.sample(Variance(0.0), &mut rng), 0.0);
        }
        for residual in [0.0, -0.0, 1e-16, -1e-16, 1e-12] {
            assert_eq!(kind.prob(residual, Variance(0.0)), 1.0, "{residual} is 0 to rounding");
        }
        for residual in [1e-6, -1e-6, 0.1, -3.0, f64::INFINITY] {
            assert_eq!(kind.prob(residual, Variance(0.0)), 0.0);
        }
        // With a tiny variance `prob` is a density with a high peak. Only with variance 0 it is 0 or 1.
        assert!(kind.prob(0.0, Variance(1e-20)) > 1e9);
        assert_eq!(kind.prob(1.0, Variance(1e-20)), 0.0);
    }
}

#[test]
fn quantiles_match_references_to_1e_15() {
    for row in Table::parse(include_str!("../../reference/quantile.csv")).rows() {
        let q = row.get("q");
        for (kind, column) in [(NoiseKind::Normal, "normal"), (NoiseKind::Triangular, "triangular")] {
            let z = kind.quantile(q);
            let error = row.error(column, z) / row.get(column);
            assert!(error <= 1e-15, "{kind:?} quantile({q}) = {z}: relative error {error:e}");
            assert_eq!(kind.quantile(-q), -z, "the distribution is symmetric");
        }
    }
}
