//! What a user sets of the Banana Machine.

use crate::models::VelocityCmd;
use crate::noise::NoiseKind;
use crate::sim::settings::{ALPHA, MAX_SEED, Rules, Words, settings};

/// Which of the chapter's models the machine runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelKind {
    Velocity,
    /// Fed with the reading that noise-free wheels would give for the command.
    Odometry,
}

impl Words for ModelKind {
    const WORDS: &'static [(&'static str, Self)] =
        &[("velocity", Self::Velocity), ("odometry", Self::Odometry)];
}

impl Words for NoiseKind {
    const WORDS: &'static [(&'static str, Self)] =
        &[("normal", Self::Normal), ("triangular", Self::Triangular)];
}

/// Ten million poses take 400 MB; a browser's page may have 4 GB.
pub const MAX_SAMPLES: usize = 10_000_000;

settings! {
    /// Everything that a user sets.
    pub struct Settings {
        /// Whose noise it is; each model keeps its own alphas.
        model: ModelKind = ModelKind::Velocity;
        /// Distribution of the noise; the variances are the same.
        noise: NoiseKind = NoiseKind::Normal;
        /// The same for every robot.
        command: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
        /// Noise parameters of the present model: six of the velocity model, four of the odometry model.
        alphas, by alphas_mut, in ALPHA;
        /// Number of the only noise parameter in effect; null for all of them.
        isolate: Option<usize> = None, in 1..=6, up to alpha_count;
        /// Robots in the whole cloud.
        samples: usize = 2000, in 1..=MAX_SAMPLES as u64;
        /// The same seed is the same robots.
        seed: u64 = 7, in 0..=MAX_SEED;
        kept {
            /// Each model keeps its own α's, so that switching back and forth loses nothing.
            velocity_alphas: [f64; 6] = [0.05, 0.05, 0.05, 0.09, 0.01, 0.01];
            odometry_alphas: [f64; 4] = [0.05, 0.05, 0.05, 0.05];
        }
    }
}

/// What is said of each noise parameter, the first of which is α₁; in a page each is an attribute of its own.
#[cfg(not(target_arch = "wasm32"))]
pub const ALPHA_SENTENCES: [&str; 6] = {
    let (of_present, of_velocity) =
        ("Noise parameter of the present model.", "Noise parameter of the velocity model.");
    [of_present, of_present, of_present, of_present, of_velocity, of_velocity]
};

impl Settings {
    /// The α's of the present model as set, whether isolated or not.
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

    /// The α's in effect: those of the given ones that are not silenced by another's isolation.
    pub(super) fn effective<const N: usize>(&self, alphas: [f64; N]) -> [f64; N] {
        std::array::from_fn(
            |i| if self.isolate.is_none_or(|number| number == i + 1) { alphas[i] } else { 0.0 },
        )
    }
}

impl Rules for Settings {
    fn settle(&mut self, before: &Self, named: &[&str]) {
        // α numbers mean other things in the other model.
        if self.model != before.model && !named.contains(&"isolate") {
            self.isolate = None;
        }
    }
}

/// The commands of the widget's presets.
pub const PRESETS: [(&str, VelocityCmd); 4] = [
    ("straight", VelocityCmd { v: 1.0, omega: 0.0, dt: 2.0 }),
    ("gentle", VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 }),
    ("hard", VelocityCmd { v: 1.0, omega: 1.2, dt: 1.4 }),
    ("pivot", VelocityCmd { v: 0.06, omega: 1.5, dt: 1.0 }),
];
