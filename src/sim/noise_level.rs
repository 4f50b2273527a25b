//! Noise level: one number that sets several noise parameters.

/// Returns the α's of a noise level n: n for v̂ and ω̂, and n/4 for γ̂.
pub const fn alphas_of_noise_level(n: f64) -> [f64; 6] {
    [n, n, n, n, 0.25 * n, 0.25 * n]
}

/// Access to α's through one noise level n: the last two α's are n/4, and all others are n.
pub struct NoiseLevel<'a>(pub &'a mut [f64]);

impl NoiseLevel<'_> {
    pub fn alpha_ratios(&self) -> impl Iterator<Item = f64> + use<> {
        let alpha_count = self.0.len();
        (0..alpha_count).map(move |i| if i + 2 < alpha_count { 1.0 } else { 0.25 })
    }

    /// Returns the noise level n; None if the α's have other ratios than those that a noise level sets.
    pub fn get(&self) -> Option<f64> {
        let n = self.0[0];
        self.alpha_ratios().zip(&*self.0).all(|(alpha_ratio, alpha)| *alpha == n * alpha_ratio).then_some(n)
    }

    pub fn set(&mut self, noise_level: f64) {
        self.alpha_ratios()
            .zip(&mut *self.0)
            .for_each(|(alpha_ratio, alpha)| *alpha = noise_level * alpha_ratio);
    }
}
