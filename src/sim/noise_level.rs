//! Noise level: one number that sets several noise parameters.

use super::settings::{Settable, Setting};
use std::ops::RangeInclusive;

/// Returns the α's of a noise level n. The last two, those of γ̂, are n/4, and all others n.
pub fn alphas_of_noise_level<const N: usize>(n: f64) -> [f64; N] {
    let mut alphas = [0.0; N];
    NoiseLevel(&mut alphas).set(n);
    alphas
}

/// Access to α's as one noise level. α's have a level n only if they are equal to [`alphas_of_noise_level`] of n.
pub struct NoiseLevel<'a>(pub &'a mut [f64]);

impl NoiseLevel<'_> {
    /// Returns the ratios of the α's to the level.
    pub fn weights(&self) -> impl Iterator<Item = f64> + use<> {
        let alpha_count = self.0.len();
        (0..alpha_count).map(move |i| if i + 2 < alpha_count { 1.0 } else { 0.25 })
    }

    /// Returns the level; None if the α's are not in the ratios of a level.
    pub fn get(&self) -> Option<f64> {
        let n = self.0[0];
        self.weights().zip(&*self.0).all(|(weight, alpha)| *alpha == n * weight).then_some(n)
    }

    /// Sets the α's to the level times their ratios.
    pub fn set(&mut self, level: f64) {
        self.weights().zip(&mut *self.0).for_each(|(weight, alpha)| *alpha = level * weight);
    }
}

impl Settable for NoiseLevel<'_> {
    type Range = RangeInclusive<f64>;
    fn setting(&mut self, allowed: Self::Range) -> Setting<'_> {
        Setting::Level(NoiseLevel(self.0), allowed)
    }
}
