//! Systematic errors of odometry and reference, which are equal in all legs and estimated together with the noise.

use super::legs::Leg;
use super::residuals::Model;
use crate::geom::se2::SE2;
use nalgebra::{Matrix3, SMatrix, Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// Systematic errors of odometry and reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Systematic {
    /// Offset of the reference's clock from the odometry's clock, s.
    pub clock_offset: f64,
    /// Heading of the reference minus heading of the robot's base, rad.
    pub mount_yaw: f64,
    /// Position of the point that the reference measures, in the frame of the base, m.
    pub lever_arm: [f64; 2],
    /// True distance divided by odometry distance.
    pub distance_scale: f64,
    /// True turn divided by odometry turn.
    pub turn_scale: f64,
}

/// One systematic error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SystematicError {
    /// Offset of the clocks: [`Systematic::clock_offset`].
    ClockOffset,
    /// Yaw of the reference's mount: [`Systematic::mount_yaw`].
    MountYaw,
    /// First coordinate of [`Systematic::lever_arm`].
    LeverArmAhead,
    /// Second coordinate of [`Systematic::lever_arm`].
    LeverArmLeft,
    /// Scale of distances: [`Systematic::distance_scale`].
    DistanceScale,
    /// Scale of turns: [`Systematic::turn_scale`].
    TurnScale,
}

/// Number of kinds of systematic errors.
pub const ERROR_COUNT: usize = 6;

impl SystematicError {
    /// All systematic errors, in the order of masks and covariances.
    pub const ALL: [Self; ERROR_COUNT] = [
        Self::ClockOffset,
        Self::MountYaw,
        Self::LeverArmAhead,
        Self::LeverArmLeft,
        Self::DistanceScale,
        Self::TurnScale,
    ];

    /// Returns the maximum standard error (s, rad or m; no unit for a scale) with which a systematic error counts as identifiable. An error
    /// this large is visible without a calibration.
    pub(super) fn identifiability_limit(self) -> f64 {
        match self {
            Self::ClockOffset | Self::LeverArmAhead | Self::LeverArmLeft => 0.25,
            Self::MountYaw => 0.1,
            Self::DistanceScale | Self::TurnScale => 0.05,
        }
    }
}

impl Default for Systematic {
    fn default() -> Self {
        Self::NONE
    }
}

impl Systematic {
    /// No systematic errors.
    pub const NONE: Self =
        Self { clock_offset: 0.0, mount_yaw: 0.0, lever_arm: [0.0; 2], distance_scale: 1.0, turn_scale: 1.0 };

    /// Returns the value of one systematic error.
    pub fn get(mut self, error: SystematicError) -> f64 {
        *self.get_mut(error)
    }

    /// Returns a reference to the value of one systematic error.
    pub fn get_mut(&mut self, error: SystematicError) -> &mut f64 {
        match error {
            SystematicError::ClockOffset => &mut self.clock_offset,
            SystematicError::MountYaw => &mut self.mount_yaw,
            SystematicError::LeverArmAhead => &mut self.lever_arm[0],
            SystematicError::LeverArmLeft => &mut self.lever_arm[1],
            SystematicError::DistanceScale => &mut self.distance_scale,
            SystematicError::TurnScale => &mut self.turn_scale,
        }
    }

    /// Returns the initial guess of the mount's yaw: the mean angle between the directions of legs by odometry and by reference.
    pub(super) fn initial_mount_yaw(legs: &[Leg]) -> f64 {
        let (mut cos_sum, mut sin_sum) = (0.0, 0.0);
        for leg in legs {
            let [odometry_motion, measured_motion] = [leg.odometry, leg.reference].map(|[from, to]| {
                let motion = from.between(&to);
                Vector2::new(motion.x(), motion.y())
            });
            cos_sum += odometry_motion.dot(&measured_motion);
            sin_sum += odometry_motion.y * measured_motion.x - odometry_motion.x * measured_motion.y;
        }
        libm::atan2(sin_sum, cos_sum)
    }

    /// Returns the pose that the reference measures, in the frame of the base.
    fn mount(&self) -> SE2 {
        SE2::new(self.lever_arm[0], self.lever_arm[1], self.mount_yaw)
    }

    /// Returns the pose of the base in the frame of the pose that the reference measures.
    pub fn base(&self) -> SE2 {
        self.mount().inverse()
    }

    /// Returns the motion of the base as measured by the reference, in the frame of the leg's start.
    pub(crate) fn motion(&self, leg: &Leg) -> SE2 {
        let base = self.base();
        let [start, end] = leg.reference.map(|pose| pose * base);
        start.between(&end)
    }

    /// Returns the motion that the odometry measured, with its scales corrected. The sideways motion of a robot that cannot drive sideways is a
    /// product of distances and turns, and has both scales.
    pub(super) fn expected(&self, model: Model, leg: &Leg) -> SE2 {
        let reading = leg.odometry[0].between(&leg.odometry[1]);
        let Self { distance_scale, turn_scale, .. } = *self;
        if distance_scale == 1.0 && turn_scale == 1.0 {
            return reading;
        }
        let sideways_scale =
            if model.drives_sideways() { distance_scale } else { distance_scale * turn_scale };
        SE2::exp(&reading.log().component_mul(&Vector3::new(distance_scale, sideways_scale, turn_scale)))
    }

    /// Returns the Jacobians of the end of the base's motion with respect to the errors of the reference at the leg's start and end. An
    /// error is a small motion (x, y, θ) in the frame of the reference pose. A change of the end is a small motion in the frame of the end.
    pub(super) fn reference_jacobians(&self, measured: &SE2) -> [Matrix3<f64>; 2] {
        let to_base = self.mount().adjoint();
        [measured.inverse().adjoint() * -to_base, to_base]
    }

    /// Returns the Jacobian of the difference between reference motion and odometry motion, in the frame of the end, with respect to
    /// [`SystematicError::ALL`].
    ///
    /// The Jacobian is evaluated at the reading, because the noise of the measured motion would bias the estimate.
    pub(super) fn motion_jacobian(
        &self,
        model: Model,
        leg: &Leg,
        reading: &SE2,
    ) -> SMatrix<f64, 3, ERROR_COUNT> {
        let (to_end_frame, twist) = (reading.inverse().adjoint(), reading.log());
        let [start_velocity, end_velocity] = leg.velocities;
        // A change of the mount moves the start and the end of the leg by the same small motion.
        let mount_derivative = |mount_change: Vector3<f64>| to_end_frame * mount_change - mount_change;
        let yaw_change = self.mount().adjoint().column(2).into_owned();
        let twist_per_turn_scale =
            Vector3::new(0.0, if model.drives_sideways() { 0.0 } else { twist.y }, twist.z);
        let twist_jacobian = SE2::right_jacobian(&twist);
        let mut twist_per_second =
            SE2::right_jacobian_inverse(&twist) * (end_velocity - to_end_frame * start_velocity);
        // A command has no sideways component at any clock offset.
        if model == Model::Velocity {
            twist_per_second.y = 0.0;
        }
        SMatrix::from_columns(&[
            twist_jacobian * twist_per_second,
            mount_derivative(yaw_change),
            mount_derivative(Vector3::x()),
            mount_derivative(Vector3::y()),
            twist_jacobian * Vector3::new(twist.x, twist.y, 0.0) / -self.distance_scale,
            twist_jacobian * twist_per_turn_scale / -self.turn_scale,
        ])
    }
}

/// Mask of systematic errors: one boolean for each of [`SystematicError::ALL`].
pub type ErrorMask = [bool; ERROR_COUNT];
