//! Noise level: one number that sets several noise parameters.

use super::settings::{Level, Settable, Setting};
use std::ops::RangeInclusive;

/// Returns the α's of a noise level n. The last two, those of γ̂, are n/4, and all others n.
pub fn alphas_of_noise_level<const N: usize>(n: f64) -> [f64; N] {
    std::array::from_fn(|i| if i + 2 < N { n } else { n / 4.0 })
}

/// Access to α's as one noise level. α's have a level n only if they are equal to [`alphas_of_noise_level`] of n.
pub struct NoiseLevel<'a, const N: usize>(pub &'a mut [f64; N]);

impl<const N: usize> Level for NoiseLevel<'_, N> {
    fn get(&self) -> Option<f64> {
        let n = self.0[0];
        (*self.0 == alphas_of_noise_level(n)).then_some(n)
    }

    fn set(&mut self, level: f64) {
        *self.0 = alphas_of_noise_level(level);
    }

    fn weights(&self) -> Vec<f64> {
        alphas_of_noise_level::<N>(1.0).to_vec()
    }
}

impl<const N: usize> Settable for NoiseLevel<'_, N> {
    type Range = RangeInclusive<f64>;
    fn setting(&mut self, allowed: Self::Range) -> Setting<'_> {
        Setting::Level(self, allowed)
    }
}
