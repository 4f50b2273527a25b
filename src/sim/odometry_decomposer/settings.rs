//! Settings of the Odometry Decomposer.

use crate::geom::se2::SE2;
use crate::models::{OdometryRule, RuleAlphas};
use crate::noise::NoiseKind;
use crate::sim::settings::{ALPHA_RANGE, Keywords, MAX_SEED, QUANTITY_RANGE, Rules, group, settings};

impl Keywords for OdometryRule {
    const KEYWORDS: &'static [(&'static str, Self)] =
        &[("thrun", Self::Table), ("nav2", Self::Nav2), ("beluga", Self::Beluga), ("omni", Self::Omni)];
}

/// Pose in the odometry frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OdometryPose(pub [f64; 3]);

impl From<OdometryPose> for SE2 {
    fn from(OdometryPose(pose): OdometryPose) -> Self {
        pose.into()
    }
}

group!(OdometryPose as OdometryPose([x, y, theta]) => {
    /// Position x that odometry reports.
    x: "m", in QUANTITY_RANGE;
    /// Position y that odometry reports.
    y: "m", in QUANTITY_RANGE;
    /// Heading that odometry reports.
    theta: "rad", in QUANTITY_RANGE;
});

/// Maximum number of outcomes. All of them move within a frame, and more dots would not be distinguishable.
pub const MAX_SAMPLES: u64 = 5000;

settings! {
    /// Settings of the user.
    pub struct Settings {
        /// Odometry pose before the motion.
        from: OdometryPose = REVERSE_PRESET.from;
        /// Odometry pose after the motion.
        to: OdometryPose = REVERSE_PRESET.to;
        /// Rule that relates the α’s to the noise.
        rule: OdometryRule = OdometryRule::Table;
        /// Noise parameters of the rule; only the rule omni has the fifth.
        alphas: RuleAlphas = [0.03, 0.01, 0.01, 0.02, 0.01], in ALPHA_RANGE;
        /// Distribution of the noise; the variances are the same.
        noise: NoiseKind = NoiseKind::Normal;
        /// Correlation of the noises of the two rotations, which the rules take to be independent.
        correlation: f64 = 0.0, in -1.0..=1.0;
        /// Time for which the frame of the odometry has drifted away from the world.
        drift: f64 = 40.0, "s", in 0.0..=1e6;
        /// Progress of the robot: in the first rotation up to 1, in the drive up to 2, in the second rotation up to 3.
        phase: f64 = 3.0, in 0.0..=3.0;
        /// Number of outcomes in the whole cloud.
        samples: usize = 500, in 1..=MAX_SAMPLES;
        // Among the seeds 0 to 39, the default has the initial standard deviations nearest to the exact ones.
        /// Seed of the random numbers. Equal seeds draw equal outcomes.
        seed: u64 = 25, in 0..=MAX_SEED;
    }
}

/// Descriptions of the attributes `alpha1`, `alpha2`, …, for build/settings.js.
#[cfg(widget = "declarations")]
pub const ALPHA_SENTENCES: [&str; 5] =
    ["Noise parameter; the first four are every rule’s, the fifth the omnidirectional one’s."; 5];

impl Rules for Settings {}

/// Reading of a preset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Name in attributes and states.
    pub name: &'static str,
    /// Odometry pose before the motion.
    pub from: OdometryPose,
    /// Odometry pose after the motion.
    pub to: OdometryPose,
}

const fn preset(name: &'static str, to: [f64; 3]) -> Preset {
    Preset { name, from: OdometryPose([0.0; 3]), to: OdometryPose(to) }
}

/// Initial reading: a drive in reverse, on which the rules disagree.
pub const REVERSE_PRESET: Preset = preset("reverse", [-1.2, -0.3, 0.1]);

/// Presets: readings with one, two or all three legs, and readings on which the rules disagree (a drive in reverse, and jitter of
/// half a centimetre).
pub const PRESETS: [Preset; 6] = [
    preset("all", [1.2, 1.0, 1.2]),
    // 0.6435 rad is the direction of (4, 3).
    preset("turn-drive", [1.2, 0.9, 0.6435]),
    preset("drive-turn", [1.5, 0.0, 1.0]),
    REVERSE_PRESET,
    preset("spin", [0.0, 0.0, 2.2]),
    preset("rest", [-0.004, 0.003, 0.001]),
];
