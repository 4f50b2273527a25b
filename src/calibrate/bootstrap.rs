//! How well the α's are known if legs are not independent: by logs made of pieces of this one.

use super::profile::Fitted;
use super::trajectory::sort;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Logs that are put together: the ends of an interval are then the 25th from either side, known to a fifth of their distance from
/// the estimate.
const LOGS: usize = 1000;

/// The 95 % intervals of the α's by a block bootstrap: logs of as many legs are put together of blocks of ∛n neighbouring ones,
/// drawn with replacement, so that what neighbours have in common stays. Of each log the α's are found by one step of scoring
/// from those of the whole, by sums that are kept for each block.
///
/// None of an α of which no residual says anything.
pub(super) fn intervals(fitted: &Fitted, count: usize, seed: u64) -> Vec<Option<[f64; 2]>> {
    let gradients: Vec<[f64; 6]> = fitted.evidence.each(&fitted.best).map(|leg| leg.gradient).collect();
    let length = libm::cbrt(gradients.len() as f64).ceil().max(1.0) as usize;
    let blocks: Vec<[f64; 6]> = gradients.chunks(length).map(|block| sum(block.iter())).collect();
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut drawn: Vec<Vec<f64>> = vec![Vec::with_capacity(LOGS); count];
    if blocks.is_empty() {
        return vec![None; count];
    }
    for _ in 0..LOGS {
        let gradient = sum((0..blocks.len()).map(|_| &blocks[rng.random_range(0..blocks.len())]));
        let alphas = fitted.slope.maximum(&gradient, &fitted.best.alphas, fitted.best.alphas, &fitted.free);
        drawn.iter_mut().zip(alphas).for_each(|(drawn, alpha)| drawn.push(alpha));
    }
    let mut interval = |alpha: usize| {
        let drawn = &mut drawn[alpha];
        sort(drawn);
        [drawn[LOGS / 40], drawn[LOGS - 1 - LOGS / 40]]
    };
    (0..count).map(|alpha| fitted.free.contains(&alpha).then(|| interval(alpha))).collect()
}

fn sum<'a>(vectors: impl Iterator<Item = &'a [f64; 6]>) -> [f64; 6] {
    vectors.fold([0.0; 6], |sum, vector| std::array::from_fn(|k| sum[k] + vector[k]))
}
