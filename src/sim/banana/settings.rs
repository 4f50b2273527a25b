//! Settings of the Banana Machine.

use crate::models::VelocityCmd;
use crate::noise::NoiseKind;
use crate::sim::settings::{ALPHA_RANGE, MAX_SEED, SettingRules, keywords, settings};

/// Motion model of the simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelKind {
    /// Velocity model; its input is the command.
    Velocity,
    /// Odometry model; its input is the reading of noise-free wheels for the command.
    Odometry,
}

keywords!(ModelKind: "velocity" = Self::Velocity, "odometry" = Self::Odometry);

keywords!(NoiseKind: "normal" = Self::Normal, "triangular" = Self::Triangular);

/// Maximum number of samples. They take 400 MB of the 4 GB that a browser allows a page.
pub const MAX_SAMPLES: usize = 10_000_000;

/// Initial number of samples. It is so large that the standard error of the initial skew is only 0.007, and so small that a device four
/// times slower than a laptop computes and draws the samples within a frame.
const INITIAL_SAMPLES: usize = 50_000;

/// Seed whose initial cloud has, among the seeds 0 to 99, the area ratio and likelihood gain nearest to the exact values.
const INITIAL_SEED: u64 = 87;

settings! {
    /// Settings of the Banana Machine.
    pub struct Settings {
        /// Motion model; each model keeps its own alphas.
        model: ModelKind = ModelKind::Velocity;
        /// Distribution of the noise. Its choice does not change the variances.
        noise: NoiseKind = NoiseKind::Normal;
        // The default is a straight drive with much noise in the turn and little in the length, which gives the clearest banana shape. By
        // symmetry its cloud has no skew, although no ellipse fits it.
        /// Command of all robots.
        command: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.0, dt: 2.0 };
        /// Noise parameters of the present model: six of the velocity model, four of the odometry model.
        alphas, by alphas_mut, in ALPHA_RANGE,
            each "Noise parameter of the present model; only the velocity model has the fifth and the sixth.";
        /// True if a drive in reverse gets noise for the rotations that the robot made, and not for two additional half turns.
        reverse_aware as "reverseAware": bool = false;
        /// Number (from 1) of the only noise parameter in effect, while the others count as 0; null if all are in effect.
        isolate: Option<usize> = None, in 1..=6, up to alpha_count;
        /// Number of robots in the whole cloud.
        samples: usize = INITIAL_SAMPLES, in 1..=MAX_SAMPLES as u64;
        /// Seed of the random numbers. Equal seeds draw equal robots.
        seed: u64 = INITIAL_SEED, in 0..=MAX_SEED;
        kept {
            /// Noise parameters of the velocity model. Each model keeps its own α's, so that switching between models loses no α's.
            velocity_alphas: [f64; 6] = [0.002, 0.002, 0.1, 0.1, 0.002, 0.002];
            /// Noise parameters of the odometry model.
            odometry_alphas: [f64; 4] = [0.05, 0.05, 0.05, 0.05];
        }
    }
}

impl Settings {
    /// Returns all α's of the selected model, regardless of `isolate`.
    pub fn alphas(&self) -> &[f64] {
        match self.model {
            ModelKind::Velocity => &self.velocity_alphas,
            ModelKind::Odometry => &self.odometry_alphas,
        }
    }

    fn alphas_mut(&mut self) -> &mut [f64] {
        match self.model {
            ModelKind::Velocity => &mut self.velocity_alphas,
            ModelKind::Odometry => &mut self.odometry_alphas,
        }
    }

    fn alpha_count(&self) -> u64 {
        self.alphas().len() as u64
    }

    /// Returns the α's with which the simulation draws: all α's, or the isolated α and 0 for all others.
    pub(super) fn effective_alphas<const N: usize>(&self, alphas: [f64; N]) -> [f64; N] {
        std::array::from_fn(|i| {
            if self.isolate.is_none_or(|isolated_number| isolated_number == i + 1) { alphas[i] } else { 0.0 }
        })
    }
}

impl SettingRules for Settings {
    /// Presets: the four commands of the chapter, the command with the clearest banana shape, and the chapter's example to check by hand.
    const PRESETS: &'static [(&'static str, Self)] = &[
        ("straight", create_preset([1.0, 0.0, 2.0], PRESET_ALPHAS)),
        ("gentle", create_preset([1.0, 0.5, 1.0], PRESET_ALPHAS)),
        ("hard", create_preset([1.0, 1.2, 1.4], PRESET_ALPHAS)),
        ("pivot", create_preset([0.06, 1.5, 1.0], PRESET_ALPHAS)),
        ("banana", Self::DEFAULT),
        ("worked", create_preset([1.0, 0.5, 1.0], [0.02, 0.02, 0.02, 0.02, 0.0, 0.0])),
    ];

    fn adjust_settings(&mut self, previous_settings: &Self, changed_keys: &[&str]) {
        // A change of the model deselects the isolated α, because the α with the same number has another meaning in the other model.
        if self.model != previous_settings.model && !changed_keys.contains(&"isolate") {
            self.isolate = None;
        }
    }
}

const PRESET_ALPHAS: [f64; 6] = [0.05, 0.05, 0.05, 0.09, 0.01, 0.01];

const fn create_preset([v, omega, dt]: [f64; 3], velocity_alphas: [f64; 6]) -> Settings {
    Settings { command: VelocityCmd { v, omega, dt }, velocity_alphas, ..Settings::DEFAULT }
}
