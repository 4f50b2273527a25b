//! Common random numbers: the unit noise of every sample, drawn once for a seed.

use crate::noise::{NoiseKind, centred_uniform};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::collections::TryReserveError;

/// Three unit-variance variates a sample, in sample order. Depends on seed and kind alone, so that a slider moves the
/// same robots, a larger cloud begins with the smaller one, and both kinds of noise come from the same uniforms.
#[derive(Clone, Debug)]
pub struct Draws {
    seed: u64,
    noise: NoiseKind,
    /// Xoshiro256++ by name: the same stream on every target, which `SmallRng` does not promise.
    rng: Xoshiro256PlusPlus,
    unit_noise: Vec<[f64; 3]>,
}

impl Draws {
    pub fn new(seed: u64, noise: NoiseKind) -> Self {
        Self { seed, noise, rng: Xoshiro256PlusPlus::seed_from_u64(seed), unit_noise: Vec::new() }
    }

    /// Makes these the draws of a seed and kind, at least `count` of them. Nothing has changed where memory is short.
    pub fn prepare(&mut self, seed: u64, noise: NoiseKind, count: usize) -> Result<(), TryReserveError> {
        if self.seed == seed && self.noise == noise {
            return self.extend_to(count);
        }
        let mut draws = Self::new(seed, noise);
        draws.extend_to(count)?;
        *self = draws;
        Ok(())
    }

    fn extend_to(&mut self, count: usize) -> Result<(), TryReserveError> {
        let missing = count.saturating_sub(self.unit_noise.len());
        self.unit_noise.try_reserve_exact(missing)?;
        let Self { noise, rng, unit_noise, .. } = self;
        unit_noise
            .extend((0..missing).map(|_| std::array::from_fn(|_| noise.quantile(centred_uniform(rng)))));
        Ok(())
    }

    pub fn unit_noise(&self) -> &[[f64; 3]] {
        &self.unit_noise
    }
}
