//! Counts of draws, wall tests and accepted attempts, and their statistics.

use crate::js::js_structs;
use crate::noise::NoiseKind;

/// Counts for the attempts shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Draws of the model; for the sub-stepped sampler, of its shorter motions.
    pub draws: usize,
    /// Number of walls whose distance was computed; most collision checks need none.
    pub wall_tests: usize,
    /// Number of accepted attempts.
    pub accepted: usize,
    /// Number of attempts accepted although the path was blocked.
    pub through_wall: usize,
}

impl Tally {
    /// Returns the fraction of accepted draws. In an accepted attempt of k parts, k draws were accepted.
    pub fn acceptance_rate(&self, steps: u32) -> f64 {
        ratio(self.accepted * steps as usize, self.draws)
    }

    /// Returns the fraction of accepted attempts whose path was blocked.
    pub fn through_wall_rate(&self) -> f64 {
        ratio(self.through_wall, self.accepted)
    }

    /// Returns the 95 % interval of the fraction through a wall (Wilson, 1927), which is also valid at 0 and 1.
    pub fn through_wall_interval(&self) -> [f64; 2] {
        let (n, p) = (self.accepted as f64, self.through_wall_rate());
        // 97.5 % quantile of the normal distribution. `quantile` takes the probability above the median.
        let z = NoiseKind::Normal.quantile(0.475);
        let (middle, scale) = (p + z * z / (2.0 * n), 1.0 + z * z / n);
        let half_width = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
        // The interval of a fraction of 0 begins at exactly 0, and that of a fraction of 1 ends at exactly 1, despite rounding.
        let lower = if self.through_wall == 0 { 0.0 } else { (middle - half_width) / scale };
        let upper = if self.through_wall == self.accepted { 1.0 } else { (middle + half_width) / scale };
        if n > 0.0 { [lower, upper] } else { [0.0, 1.0] }
    }
}

/// Returns a quotient: NaN for 0/0, and infinity for another number over 0.
pub(super) fn ratio(count: usize, total: usize) -> f64 {
    count as f64 / total as f64
}

js_structs! {
    /// Statistics of the attempts shown. Fractions of 0 attempts are NaN. Costs per accepted attempt are infinite if none is
    /// accepted.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Stats as "SqueezeStats" {
        /// Number of attempts.
        pub attempts: usize,
        /// Draws of the model; for the sub-stepped sampler, of its shorter motions.
        pub drawn: usize,
        /// Number of accepted attempts.
        pub accepted: usize,
        /// Fraction of accepted draws.
        pub acceptance_rate: f64,
        /// Number of attempts accepted although the path was blocked.
        pub through_wall: usize,
        /// Fraction of accepted attempts whose path was blocked.
        pub through_wall_rate: f64,
        /// 95 % interval of the fraction through a wall.
        pub through_wall_interval: [f64; 2],
        /// Draws per accepted attempt.
        pub draws_per_accepted: f64,
        /// Walls whose distance was computed, per accepted attempt.
        pub wall_tests_per_accepted: f64,
        /// True if the simulation stopped before it had all samples, because too few draws were accepted.
        pub gave_up: bool,
    }
}
