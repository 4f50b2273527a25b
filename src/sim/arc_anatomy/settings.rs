//! Settings of Arc Anatomy.

use crate::geom::se2::SE2;
use crate::models::{VelocityAlphas, VelocityCmd, VelocityModel};
use crate::noise::NoiseKind;
use crate::sim::settings::{ALPHA_RANGE, Keywords, QUANTITY_RANGE, Rules, group, settings};

/// Pose whose likelihood is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FinalPose {
    /// Position x, m.
    pub x: f64,
    /// Position y, m.
    pub y: f64,
    /// Heading, rad.
    pub theta: f64,
}

group!(FinalPose as FinalPose { x, y, theta } => {
    /// Position of the robot after the command.
    x: "m", in QUANTITY_RANGE;
    /// Position of the robot after the command.
    y: "m", in QUANTITY_RANGE;
    /// Heading of the robot after the command.
    theta: "rad", in QUANTITY_RANGE;
});

/// Quantity of the heat map over the positions of the final pose, at its heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurfaceKind {
    /// No heat map.
    Nothing,
    /// [`crate::MotionModel::prob`], the score of Table 5.1.
    Prob,
    /// [`crate::MotionModel::pose_density`], the density of the sampler.
    Density,
}

impl Keywords for SurfaceKind {
    const KEYWORDS: &'static [(&'static str, Self)] =
        &[("none", Self::Nothing), ("prob", Self::Prob), ("density", Self::Density)];
}

/// Command from the origin, and pose of the robot after the command. The pose is off the commanded arc, so that no residual is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Name in attributes and states.
    pub name: &'static str,
    /// Command from the origin.
    pub command: VelocityCmd,
    /// Pose after the command.
    pub next: FinalPose,
}

const fn preset(name: &'static str, [v, omega]: [f64; 2], [x, y, theta]: [f64; 3]) -> Preset {
    Preset { name, command: VelocityCmd { v, omega, dt: 1.0 }, next: FinalPose { x, y, theta } }
}

/// Presets: an arc to the left, its mirror images to the right and in reverse, and a straight drive.
pub const PRESETS: [Preset; 4] = [
    preset("left", [1.0, 0.5], [1.1, 0.5, 1.1]),
    preset("right", [1.0, -0.5], [1.1, -0.5, -1.1]),
    preset("reverse", [-1.0, 0.5], [-1.1, -0.5, 1.1]),
    preset("straight", [1.0, 0.0], [1.2, 0.0, 0.2]),
];

settings! {
    /// Settings of the user.
    pub struct Settings {
        /// Start pose of the robot.
        start: [f64; 3] = [0.0; 3];
        /// Pose of the robot after the command.
        next: FinalPose = PRESETS[0].next;
        /// Command between the two poses.
        command: VelocityCmd = PRESETS[0].command;
        /// Noise parameters, the six of the velocity model.
        alphas: [f64; 6] = [0.05, 0.05, 0.05, 0.09, 0.01, 0.01], in ALPHA_RANGE;
        /// Distribution of the noise; the variances are the same.
        noise: NoiseKind = NoiseKind::Normal;
        /// True for a radius without a sign, as Table 5.1 prints it.
        printed: bool = false;
        /// Quantity of the heat map over all positions, at the heading of the final pose.
        map: SurfaceKind = SurfaceKind::Nothing;
    }
}

/// Descriptions of the attributes `alpha1`, `alpha2`, …, for build/settings.js.
#[cfg(widget = "declarations")]
pub const ALPHA_SENTENCES: [&str; 6] = ["Noise parameter of the velocity model."; 6];

impl Rules for Settings {}

impl Settings {
    pub(super) fn start(&self) -> SE2 {
        self.start.into()
    }

    pub(super) fn next(&self) -> SE2 {
        let FinalPose { x, y, theta } = self.next;
        SE2::new(x, y, theta)
    }

    pub(super) fn model(&self) -> VelocityModel {
        VelocityModel { alphas: VelocityAlphas(self.alphas), noise: self.noise }
    }
}
