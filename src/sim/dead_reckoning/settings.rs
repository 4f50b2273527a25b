//! Settings of Dead Reckoning.

use crate::models::{Compounding, VelocityAlphas, VelocityCmd, VelocityModel};
use crate::noise::NoiseKind;
use crate::sim::noise_level::NoiseLevel;
use crate::sim::settings::{
    ALPHA_RANGE, MAX_SEED, SettingRules, SettingsError, check_integer, keywords, settings,
};

keywords!(
    Compounding:
    "chapter" = Self::Chapter, "first-order" = Self::FirstOrder, "fourth-order" = Self::FourthOrder
);

/// Motion to which the α's apply: each step, or the whole path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoisePer {
    /// Each step, as in the chapter. More and shorter steps along the same path add less noise in total.
    Step,
    /// The whole path, driven as one command. Each of n steps has 1/n of its variance.
    Path,
}

keywords!(NoisePer: "step" = Self::Step, "path" = Self::Path);

/// Maximum number of rollouts. With two hundred steps, this many rollouts take about ten seconds. Only the poses of the robots in the
/// picture are stored.
pub const MAX_SAMPLES: usize = 1_000_000;
/// Maximum number of steps, ten times that of the chapter. Longer paths would show nothing new.
pub const MAX_STEPS: u64 = 200;

/// Seed with typical rollouts. For some of the seeds 0 to 99, the first wrong prediction (see [`super::Misses`]) is at the same step as
/// with exact variances. Of these seeds, this one has the variance ratios nearest to the exact ratios.
const INITIAL_SEED: u64 = 29;

settings! {
    /// Settings of Dead Reckoning.
    pub struct Settings {
        /// Command of each step.
        command: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 0.2 };
        /// Number of steps.
        steps: u32 = 20, in 1..=MAX_STEPS;
        /// Number of the selected step.
        step: u32 = 20, in 1..=MAX_STEPS;
        /// Noise parameters, the six of the velocity model.
        alphas: [f64; 6] = [0.02, 0.02, 0.02, 0.02, 0.005, 0.005], in ALPHA_RANGE,
            each "Noise parameter of the velocity model.";
        /// Level h of the heading noise: α₃ and α₄ are h, α₅ and α₆ are h/4. Null if they have other ratios.
        heading_noise as "headingNoise", by heading_noise_level_mut of alphas, in ALPHA_RANGE;
        /// Motion to which the noise parameters apply: each step, or the whole path. Each of n steps then has 1/n of its variance.
        per: NoisePer = NoisePer::Step;
        /// Recursion whose predicted covariance is shown.
        compounding: Compounding = Compounding::Chapter;
        /// Number of rollouts of the whole path.
        samples: usize = 50_000, in 1..=MAX_SAMPLES as u64;
        /// Seed of the random numbers. Equal seeds draw equal noise for each step.
        seed: u64 = INITIAL_SEED, in 0..=MAX_SEED;
    }
}

impl Settings {
    fn heading_noise_level_mut(&mut self) -> NoiseLevel<'_> {
        let [_, _, heading_alphas @ ..] = &mut self.alphas;
        NoiseLevel(heading_alphas)
    }

    /// Returns the level h of the heading noise; None unless α₃ and α₄ are h, and α₅ and α₆ are h/4.
    pub fn heading_noise(mut self) -> Option<f64> {
        self.heading_noise_level_mut().get()
    }

    /// Returns the noise parameters of one step.
    pub fn model(&self) -> VelocityModel {
        let variance_factor = match self.per {
            NoisePer::Step => 1.0,
            // A step has 1/n of the variance of the path: (nΔt)²σ²/n = Δt²·nσ².
            NoisePer::Path => f64::from(self.steps),
        };
        VelocityModel {
            alphas: VelocityAlphas(self.alphas.map(|alpha| variance_factor * alpha)),
            noise: NoiseKind::Normal,
        }
    }

    /// Returns true if rollouts under `other_settings` settings are equal to the last bit. The number of robots, the selected step and the
    /// recursion may differ.
    pub(super) fn has_same_rollouts(&self, other_settings: &Self) -> bool {
        let Self { step: selected_step, compounding: selected_recursion, samples: sample_count, .. } =
            *other_settings;
        // −0 equals 0, but leads to other signs of zeros in the results.
        let sign_bits_of = |settings: &Self| {
            let VelocityCmd { v, omega, dt } = settings.command;
            ([v, omega, dt].map(f64::is_sign_negative), settings.alphas.map(f64::is_sign_negative))
        };
        Self { step: selected_step, compounding: selected_recursion, samples: sample_count, ..*self }
            == *other_settings
            && sign_bits_of(self) == sign_bits_of(other_settings)
    }
}

impl SettingRules for Settings {
    /// Presets: the chapter's path of twenty steps, the path with twice the standard deviation of the heading (exercise 7), the path in two
    /// hundred steps, and a straight path. Each of the two hundred steps is so short that J_r is nearly the identity.
    const PRESETS: &'static [(&'static str, Self)] = &[
        ("chapter", Self::DEFAULT),
        ("doubled", path([1.0, 0.5, 0.2], 20, 0.08)),
        ("fine", path([1.0, 0.5, 0.02], 200, 0.02)),
        ("straight", path([1.0, 0.0, 0.2], 20, 0.02)),
    ];

    /// Selects the last step if the path does not contain the selected step.
    fn adjust_settings(&mut self, _: &Self, changed_keys: &[&str]) {
        if !changed_keys.contains(&"step") {
            self.step = self.step.min(self.steps);
        }
    }

    fn check_combinations(&self) -> Result<(), SettingsError> {
        check_integer("step", f64::from(self.step), &(1..=u64::from(self.steps))).map(|_| ())
    }
}

const fn path([v, omega, dt]: [f64; 3], step_count: u32, heading_noise: f64) -> Settings {
    let [h, last_turn_alpha] = [heading_noise, heading_noise / 4.0];
    Settings {
        command: VelocityCmd { v, omega, dt },
        steps: step_count,
        step: step_count,
        alphas: [0.02, 0.02, h, h, last_turn_alpha, last_turn_alpha],
        ..Settings::DEFAULT
    }
}
