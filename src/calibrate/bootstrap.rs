//! How well the α's are known if legs are not independent: by logs made of pieces of this one.

use super::density::NORMAL_95;
use super::profile::{Estimate, Fitted};
use super::trajectory::sort;
use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Logs that are put together: a twentieth of them, the fifty that are furthest out, tell how far that is to a tenth.
const LOGS: usize = 1000;

/// So many in a step.
const A_STEP: usize = 100;

/// What drawing a log costs besides its blocks, in legs.
const DRAWN: usize = 4;

/// By how much longer the 95 % intervals of the α's have to be than legs would have them that have nothing in common, by a block
/// bootstrap.
///
/// An interval by the likelihood is as long as the slope of that, at its maximum, varies by chance, if the model is true. How much it
/// really does, logs of as many legs tell that are put together of blocks of ∛n neighbouring ones, drawn with replacement, so that what
/// neighbours have in common stays: of each α that part of the slope which the other α's cannot answer for. The profile's interval,
/// which knows that an α is 0 or more and how skew its likelihood is, is then stretched about the estimate.
#[derive(Clone, Debug)]
pub(super) struct Bootstrap {
    /// Of each block the α's parts of the slope, each by its deviation if the model is true, less the mean.
    blocks: Vec<[f64; 6]>,
    rng: Xoshiro256PlusPlus,
    /// Of each α how large the slopes of the logs are so far.
    drawn: Vec<Vec<f64>>,
}

impl Bootstrap {
    pub fn new(fitted: &Fitted, count: usize, seed: u64) -> Self {
        let legs = fitted.evidence.legs();
        let inside: Vec<usize> =
            fitted.free.iter().copied().filter(|k| fitted.best.alphas[*k] > 0.0).collect();
        let efficient: [_; 6] = std::array::from_fn(|alpha| fitted.slope.efficient(alpha, &inside));
        let score = |gradient: [f64; 6]| -> [f64; 6] {
            efficient.map(|(factors, information)| {
                let score: f64 = factors.iter().zip(gradient).map(|(factor, slope)| factor * slope).sum();
                if information > 0.0 { score / information.sqrt() } else { 0.0 }
            })
        };
        let scores: Vec<[f64; 6]> =
            fitted.evidence.each(&fitted.best, 0..legs).map(|leg| score(leg.gradient)).collect();
        let length = libm::cbrt(legs as f64).ceil().max(1.0) as usize;
        let mut blocks: Vec<[f64; 6]> = scores.chunks(length).map(|block| sum(block.iter())).collect();
        let count_of_blocks = blocks.len() as f64;
        let mean = sum(blocks.iter()).map(|sum| sum / count_of_blocks);
        blocks.iter_mut().for_each(|block| block.iter_mut().zip(mean).for_each(|(of, mean)| *of -= mean));
        Self {
            blocks,
            rng: Xoshiro256PlusPlus::seed_from_u64(seed),
            drawn: vec![Vec::with_capacity(LOGS); count],
        }
    }

    /// Goes on by some logs; after the last one how much longer the interval of each α is, 1 or more.
    pub fn step(&mut self, fitted: &Fitted) -> Option<Vec<f64>> {
        let Self { blocks, rng, drawn } = self;
        if blocks.len() < 2 {
            return Some(vec![1.0; drawn.len()]);
        }
        // Eight vectors are summed in the time of a leg.
        fitted.evidence.work.add(A_STEP * (blocks.len() / 8 + DRAWN));
        for _ in 0..A_STEP {
            let scores = sum((0..blocks.len()).map(|_| &blocks[rng.random_range(0..blocks.len())]));
            drawn.iter_mut().zip(scores).for_each(|(drawn, score)| drawn.push(score.abs()));
        }
        if drawn.iter().any(|drawn| drawn.len() < LOGS) {
            return None;
        }
        // Of few blocks the mean that was taken off is theirs, and how far apart they are is known by few.
        let others = blocks.len() as f64 - 1.0;
        let few = (blocks.len() as f64 / others).sqrt() * student_95(others) / NORMAL_95;
        let longer = |drawn: &mut Vec<f64>| {
            sort(drawn);
            (few * drawn[LOGS - 1 - LOGS / 20] / NORMAL_95).max(1.0)
        };
        Some(drawn.iter_mut().map(longer).collect())
    }
}

/// The intervals of an estimate, each about its α by so much longer.
pub(super) fn stretched(estimate: &Estimate, longer: &[f64]) -> Vec<Option<[f64; 2]>> {
    let stretched = |(alpha, longer): (usize, &f64)| {
        let (best, [from, to]) = (estimate.alphas[alpha], estimate.intervals[alpha]?);
        // What has no end has none if it is longer.
        let end = if to.is_finite() { best + longer * (to - best) } else { to };
        Some([(best - longer * (best - from)).max(0.0), end])
    };
    longer.iter().enumerate().map(stretched).collect()
}

/// The end of the 95 % interval of Student's t with so many degrees of freedom, by Cornish and Fisher's expansion: to a hundredth from
/// three on.
fn student_95(freedom: f64) -> f64 {
    let z = NORMAL_95;
    let powers = |[a, b, c, d]: [f64; 4]| z * (a + z * z * (b + z * z * (c + z * z * d)));
    z + powers([1.0, 1.0, 0.0, 0.0]) / (4.0 * freedom)
        + powers([3.0, 16.0, 5.0, 0.0]) / (96.0 * freedom * freedom)
        + powers([-15.0, 17.0, 19.0, 3.0]) / (384.0 * freedom * freedom * freedom)
}

fn sum<'a>(vectors: impl Iterator<Item = &'a [f64; 6]>) -> [f64; 6] {
    vectors.fold([0.0; 6], |sum, vector| std::array::from_fn(|k| sum[k] + vector[k]))
}
