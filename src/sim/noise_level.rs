//! One number for several noise parameters.

use super::settings::{Level, Settable, Setting};
use std::ops::RangeInclusive;

/// The level n of noise parameters that end with γ̂'s two: these are n/4, and all before them n.
pub struct NoiseLevel<'a>(pub &'a mut [f64]);

impl Level for NoiseLevel<'_> {
    fn get(&self) -> Option<f64> {
        let (first, last) = self.0.split_at(self.0.len() - 2);
        let level = first[0];
        let is = first.iter().all(|alpha| *alpha == level) && last.iter().all(|alpha| *alpha == level / 4.0);
        is.then_some(level)
    }

    fn set(&mut self, level: f64) {
        let (first, last) = self.0.split_at_mut(self.0.len() - 2);
        first.fill(level);
        last.fill(level / 4.0);
    }
}

impl Settable for NoiseLevel<'_> {
    type Allowed = RangeInclusive<f64>;
    fn setting(&mut self, allowed: Self::Allowed) -> Setting<'_> {
        Setting::Level(self, allowed)
    }
}
