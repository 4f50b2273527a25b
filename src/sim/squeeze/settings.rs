//! Settings of Map Squeeze, except for the map.

use crate::geom::se2::SE2;
use crate::map::{Sampler, UnknownCells};
use crate::models::VelocityCmd;
use crate::sim::noise_level::{NoiseLevel, alphas_of_noise_level};
use crate::sim::settings::{
    ALPHA_RANGE, MAX_SEED, SettingRules, SettingsError, check_integer, keywords, settings,
};
use std::f64::consts::FRAC_PI_2;

keywords!(
    Sampler:
    "endpoint" = Self::Endpoint, "whole-arc" = Self::WholeArc, "sub-stepped" = Self::SubStepped(1)
);

keywords!(UnknownCells: "free" = Self::Free, "blocked" = Self::Blocked);

/// Start pose x, y (m) and θ (rad) in front of a doorway of the apartment.
const DOORWAY_START: [f64; 3] = [2.05, 2.6, FRAC_PI_2];

/// Maximum number of attempts (motions, accepted or rejected). They take 56 MB, and some seconds on a difficult map.
pub const MAX_SAMPLES: usize = 1_000_000;
/// Maximum number of parts of a command. A thousand parts are as exact as testing the whole arc, and a thousand times slower.
pub const MAX_STEPS: u64 = 1000;

settings! {
    /// Settings of Map Squeeze, except for the map.
    pub struct Settings {
        /// Start pose of the robot.
        start: [f64; 3] = DOORWAY_START, each "at which the robot starts";
        /// Command of all sampled motions.
        command: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.0, dt: 2.0 };
        /// Noise parameters, the six of the velocity model.
        alphas: [f64; 6] = alphas_of_noise_level(0.12), in ALPHA_RANGE;
        /// Noise level n: the first four noise parameters are n, the others n/4. Null if they have other ratios.
        noise, by noise_level of alphas, in ALPHA_RANGE;
        /// Radius of the robot.
        clearance: f64 = 0.13, "m", in 0.0..=10.0;
        /// True if the map decides which draws are accepted; false if all are accepted.
        conditioned: bool = true;
        /// Treatment of unknown cells as free or blocked.
        unknown: UnknownCells = UnknownCells::Free;
        /// Acceptance test of the draws.
        sampler: Sampler = Sampler::Endpoint;
        // The default is the smallest number of parts whose effect is visible.
        /// Number of parts into which the sub-stepped sampler splits the command.
        steps: u32 = 4, in 1..=MAX_STEPS;
        /// Number of attempts to draw a motion that the map allows.
        samples: usize = 600, in 1..=MAX_SAMPLES as u64;
        /// Seed of the random numbers. Equal seeds draw equal motions.
        seed: u64 = 7, in 0..=MAX_SEED;
    }
}

impl Settings {
    fn noise_level(&mut self) -> NoiseLevel<'_> {
        NoiseLevel(&mut self.alphas)
    }

    /// Returns the noise level n of the α's; None unless the first four α's are n, and the others n/4.
    pub fn noise(mut self) -> Option<f64> {
        self.noise_level().get()
    }

    /// Returns the number of parts into which the sampler splits a motion.
    pub fn part_count(&self) -> u32 {
        self.sampler.part_count()
    }

    pub(super) fn start_pose(&self) -> SE2 {
        self.start.into()
    }
}

impl SettingRules for Settings {
    const PRESETS: &'static [(&'static str, Self)] = &[
        ("doorway", Self::DEFAULT),
        ("wall", Self { start: [3.3, 2.6, FRAC_PI_2], ..Self::DEFAULT }),
        ("corridor", Self { start: [1.4, 4.4, 0.0], ..Self::DEFAULT }),
    ];

    /// Copies the setting `steps` into the sub-stepped sampler. Other samplers have no number of steps, and stay unchanged.
    fn adjust_settings(&mut self, _: &Self, _: &[&str]) {
        self.sampler = self.sampler.with_part_count(self.steps);
    }

    fn check_combinations(&self) -> Result<(), SettingsError> {
        let part_count = check_integer("steps", f64::from(self.part_count()), &(1..=MAX_STEPS))?;
        check_integer("samples", self.samples as f64, &(1..=MAX_SAMPLES as u64 / part_count)).map(|_| ())
    }
}
