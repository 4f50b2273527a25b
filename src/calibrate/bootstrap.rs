//! How well the α's are known if legs are not independent: by logs made of pieces of this one.

use super::profile::Fitted;
use super::trajectory::sort;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Logs that are put together: the ends of an interval are then the 25th from either side, known to a fifth of their distance from
/// the estimate.
const LOGS: usize = 1000;

/// So many in a step.
const A_STEP: usize = 100;

/// What drawing a log costs, in legs: its parabola has its maximum within some hundred sweeps.
const SWEPT: usize = 100;

/// The 95 % intervals of the α's by a block bootstrap: logs of as many legs are put together of blocks of ∛n neighbouring ones,
/// drawn with replacement, so that what neighbours have in common stays. Of each log the α's are found by one step of scoring
/// from those of the whole, by sums that are kept for each block.
#[derive(Clone, Debug)]
pub(super) struct Bootstrap {
    blocks: Vec<[f64; 6]>,
    rng: Xoshiro256PlusPlus,
    /// Of each α its values so far.
    drawn: Vec<Vec<f64>>,
}

impl Bootstrap {
    pub fn new(fitted: &Fitted, count: usize, seed: u64) -> Self {
        let legs = fitted.evidence.legs();
        let gradients: Vec<[f64; 6]> =
            fitted.evidence.each(&fitted.best, 0..legs).map(|leg| leg.gradient).collect();
        let length = libm::cbrt(legs as f64).ceil().max(1.0) as usize;
        Self {
            blocks: gradients.chunks(length).map(|block| sum(block.iter())).collect(),
            rng: Xoshiro256PlusPlus::seed_from_u64(seed),
            drawn: vec![Vec::with_capacity(LOGS); count],
        }
    }

    /// Goes on by some logs; the intervals after the last one, none of an α of which no residual says anything.
    pub fn step(&mut self, fitted: &Fitted) -> Option<Vec<Option<[f64; 2]>>> {
        let Self { blocks, rng, drawn } = self;
        if blocks.is_empty() {
            return Some(vec![None; drawn.len()]);
        }
        // Eight vectors are summed in the time of a leg.
        fitted.evidence.work.add(A_STEP * (blocks.len() / 8 + SWEPT));
        for _ in 0..A_STEP {
            let gradient = sum((0..blocks.len()).map(|_| &blocks[rng.random_range(0..blocks.len())]));
            let alphas =
                fitted.slope.maximum(&gradient, &fitted.best.alphas, fitted.best.alphas, &fitted.free);
            drawn.iter_mut().zip(alphas).for_each(|(drawn, alpha)| drawn.push(alpha));
        }
        if drawn.iter().any(|drawn| drawn.len() < LOGS) {
            return None;
        }
        let count = drawn.len();
        let mut interval = |alpha: usize| {
            let drawn = &mut drawn[alpha];
            sort(drawn);
            [drawn[LOGS / 40], drawn[LOGS - 1 - LOGS / 40]]
        };
        Some((0..count).map(|alpha| fitted.free.contains(&alpha).then(|| interval(alpha))).collect())
    }
}

fn sum<'a>(vectors: impl Iterator<Item = &'a [f64; 6]>) -> [f64; 6] {
    vectors.fold([0.0; 6], |sum, vector| std::array::from_fn(|k| sum[k] + vector[k]))
}
