//! `sample(b²)` and `prob(a, b²)` of normal and triangular noise, compared with the exact distributions.

use crate::common::{
    MAX_KS_STATISTIC, NOISE_KINDS, ReferenceTable, SAMPLE_COUNT, scaled_ks_distance, seeded_rng, unit_cdf,
};
use motion::{NoiseKind, Variance};

fn sample_noise(noise_kind: NoiseKind, variance: f64, sample_count: usize, seed: u64) -> Vec<f64> {
    let mut rng = seeded_rng(seed);
    (0..sample_count).map(|_| noise_kind.sample(Variance(variance), &mut rng)).collect()
}

#[test]
fn samples_follow_the_exact_distribution() {
    for noise in NOISE_KINDS {
        for (seed, variance) in [(1, 1.0), (2, 0.025), (3, 1e-8), (4, 400.0)] {
            let noise_sample = sample_noise(noise, variance, SAMPLE_COUNT, seed);
            let ks_statistic = scaled_ks_distance(noise_sample, |a| unit_cdf(noise, a / variance.sqrt()));
            assert!(
                ks_statistic < MAX_KS_STATISTIC,
                "{noise:?} of variance {variance}: √n·D = {ks_statistic}"
            );
        }
    }
}

#[test]
fn prob_is_the_density_of_the_samples() {
    for noise in NOISE_KINDS {
        for variance in [1e-6, 0.025, 1.0, 90.0] {
            let noise_std = f64::sqrt(variance);
            // Simpson's rule over each of 60 intervals must give the increase of the distribution function, and 1 in total. The kinks of
            // the triangular density lie on ends of intervals.
            let (integration_limit, interval_count) = (6f64.sqrt() * 4.0 * noise_std, 60);
            let interval_width = 2.0 * integration_limit / interval_count as f64;
            let mut integral = 0.0;
            for interval_index in 0..interval_count {
                let interval_start = -integration_limit + interval_index as f64 * interval_width;
                let integration_step = interval_width / 64.0;
                let interval_probability: f64 = (0..=64)
                    .map(|i| {
                        let simpson_weight = if i == 0 || i == 64 { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
                        simpson_weight
                            * noise.prob(interval_start + i as f64 * integration_step, Variance(variance))
                    })
                    .sum::<f64>()
                    * integration_step
                    / 3.0;
                let expected_increase = unit_cdf(noise, (interval_start + interval_width) / noise_std)
                    - unit_cdf(noise, interval_start / noise_std);
                assert!(
                    (interval_probability - expected_increase).abs() < 3e-10,
                    "{noise:?} b² = {variance} at {interval_start}: {interval_probability}, not {expected_increase}"
                );
                integral += interval_probability;
            }
            assert!((integral - 1.0).abs() < 1e-9, "{noise:?} b² = {variance}: integral {integral}");
        }
    }
}

#[test]
fn with_zero_variance_samples_are_zero_and_prob_is_zero_or_one() {
    for noise in NOISE_KINDS {
        let mut rng = seeded_rng(8);
        for _ in 0..100 {
            assert_eq!(noise.sample(Variance(0.0), &mut rng), 0.0);
        }
        for noise_residual in [0.0, -0.0, 1e-16, -1e-16, 1e-12] {
            assert_eq!(noise.prob(noise_residual, Variance(0.0)), 1.0, "{noise_residual} is 0 to rounding");
        }
        for noise_residual in [1e-6, -1e-6, 0.1, -3.0, f64::INFINITY] {
            assert_eq!(noise.prob(noise_residual, Variance(0.0)), 0.0);
        }
        // With a tiny variance `prob` is a density with a high peak. It is 0 or 1 only if the variance is 0.
        assert!(noise.prob(0.0, Variance(1e-20)) > 1e9);
        assert_eq!(noise.prob(1.0, Variance(1e-20)), 0.0);
    }
}

#[test]
fn quantiles_match_references_to_1e_15() {
    for csv_row in ReferenceTable::parse(include_str!("../../reference/quantile.csv")).rows() {
        let q = csv_row.cell_number("q");
        for (noise, column_name) in [(NoiseKind::Normal, "normal"), (NoiseKind::Triangular, "triangular")] {
            let z = noise.quantile(q);
            let relative_error = csv_row.deviation_of(column_name, z) / csv_row.cell_number(column_name);
            assert!(
                relative_error <= 1e-15,
                "{noise:?} quantile({q}) = {z}: relative error {relative_error:e}"
            );
        }
    }
}
