//! Residuals of a leg: the motion that the reference measured, less the one that the odometry read.
//!
//! Residuals are in the model's own coordinates, in which noise components are independent and have variances that are linear in the α's.

use super::legs::{Leg, distance};
use super::likelihood::Parameters;
use super::systematic::{Systematic, log_sinc_derivative};
use crate::geom::arc::invert_arc;
use crate::geom::se2::{SE2, wrap_angle};
use crate::geom::sinc::sinc;
use crate::models::{LegVariances, MAX_SPIN_DISTANCE, OdomDelta, OdometryRule};
use nalgebra::{Matrix3, RowVector3, Vector3};
use serde::{Deserialize, Serialize};

/// Model whose α's are fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// Odometry model with the variances of a rule: four α's, under [`OdometryRule::Omni`] five.
    Odometry(OdometryRule),
    /// Velocity model: six α's.
    Velocity,
}

impl Model {
    /// Number of α's.
    pub fn alphas(self) -> usize {
        match self {
            Self::Odometry(OdometryRule::Omni) => 5,
            Self::Odometry(_) => 4,
            Self::Velocity => 6,
        }
    }

    /// Indices, from 0, of the two α's in the variance of each component of [`Observation::residuals`].
    pub fn component_alphas(self) -> [[usize; 2]; 3] {
        match self {
            // Second rotation, translation, strafe.
            Self::Odometry(OdometryRule::Omni) => [[0, 1], [2, 3], [4, 3]],
            // First rotation, translation, second rotation.
            Self::Odometry(_) => [[0, 1], [2, 3], [0, 1]],
            // v, ω, γ.
            Self::Velocity => [[0, 1], [2, 3], [4, 5]],
        }
    }

    /// Variances of the wheels' noise in one leg.
    #[inline(always)]
    pub(super) fn wheel_variances(
        self,
        coefficients: &[[f64; 2]; 3],
        parameters: &Parameters,
    ) -> Vector3<f64> {
        let mut variances = Vector3::zeros();
        for (k, [first, second]) in self.component_alphas().into_iter().enumerate() {
            variances[k] = parameters[first] * coefficients[k][0] + parameters[second] * coefficients[k][1];
        }
        variances
    }

    pub(super) fn drives_sideways(self) -> bool {
        self == Self::Odometry(OdometryRule::Omni)
    }

    /// Tells whether an α (index from 0) multiplies the square of a turn or turn rate, and not that of a distance or speed.
    pub fn grows_with_turn(self, alpha: usize) -> bool {
        match self {
            Self::Odometry(_) => [0, 3].contains(&alpha),
            Self::Velocity => alpha % 2 == 1,
        }
    }
}

/// Residuals of one leg, with the coefficients of their variances and their Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// Executed minus expected motion in the model's coordinates. NaN of a component that the leg does not show: a turn on the spot has no
    /// first rotation.
    pub residuals: [f64; 3],
    /// Factors of the two α's in the variance of each component.
    pub coefficients: [[f64; 2]; 3],
    /// Reading in the model's coordinates: rot1, trans, rot2 (rad, m, rad), or v, ω, Δt (m/s, rad/s, s).
    pub reading: [f64; 3],
    /// Motion that the model expects by the odometry, in the frame of the leg's start.
    pub expected: SE2,
    /// Jacobian of the residuals by the motion of the base (x, y, θ).
    pub(super) jacobian: Matrix3<f64>,
}

/// Largest noise of the reference, over the length of a leg, with which directions are computed by atan2. With more noise atan2 is biased,
/// and directions are linear in the displacement.
const MAX_ATAN2_NOISE_RATIO: f64 = 0.05;

impl Observation {
    /// Returns the residuals of a leg, with these systematic errors corrected.
    ///
    /// `position_std` (m) is the standard deviation of the reference.
    pub(super) fn new(model: Model, leg: &Leg, corrected: &Systematic, position_std: f64) -> Self {
        let expected = corrected.expected(model, leg);
        let motion = corrected.motion(leg);
        let is_linear = position_std > MAX_ATAN2_NOISE_RATIO * distance(&expected);
        let mut observation = match model {
            Model::Odometry(OdometryRule::Omni) => omni(expected, &motion),
            Model::Odometry(rule) => differential(rule, expected, &motion, is_linear),
            Model::Velocity => velocity(leg.duration(), &expected, &motion, is_linear),
        };
        for component in 0..3 {
            if observation.residuals[component].is_nan() {
                observation.jacobian.row_mut(component).fill(0.0);
            }
        }
        observation
    }
}

/// Returns the variances of a reading where the first α of each component is 1 and the second is 0, and those where it is the other way round.
fn unit_variances(rule: OdometryRule, reading: &OdomDelta) -> [LegVariances; 2] {
    [[1.0, 0.0, 1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0, 0.0]].map(|alphas| rule.variances(reading, &alphas))
}

/// Returns whether a leg has a direction: its lengths by the reading and by the reference, in m, are not below [`MAX_SPIN_DISTANCE`]. A linear
/// direction does not need the length by the reference. That length is negative if the reference saw a motion opposite to the reading.
fn has_direction(read: f64, executed: f64, is_linear: bool) -> bool {
    read >= MAX_SPIN_DISTANCE && (is_linear || executed >= MAX_SPIN_DISTANCE)
}

/// Returns the residuals of rot1, trans and rot2; in a turn on the spot the second rotation is the whole turn.
fn differential(rule: OdometryRule, expected: SE2, motion: &SE2, is_linear: bool) -> Observation {
    let read = OdomDelta::from_poses(&SE2::identity(), &expected);
    let OdomDelta { rot1, trans, rot2 } = rule.legs(&read);
    let unit = unit_variances(rule, &read);
    let [first, along, second] =
        [unit.map(|unit| unit.rot1.0), unit.map(|unit| unit.trans.0), unit.map(|unit| unit.rot2.0)];
    let (sin, cos) = libm::sincos(rot1);
    let [ahead, left] = [cos * motion.x() + sin * motion.y(), cos * motion.y() - sin * motion.x()];
    let turned = wrap_angle(motion.theta() - rot1 - rot2);
    let (residuals, coefficients, across) = if has_direction(read.trans, ahead, is_linear) {
        let (off, longer) = if is_linear {
            (left / trans, ahead - trans)
        } else {
            (libm::atan2(left, ahead), libm::hypot(ahead, left) - trans)
        };
        let across = RowVector3::new(-sin, cos, 0.0) / trans;
        ([off, longer, wrap_angle(turned - off)], [first, along, second], across)
    } else {
        let both = [first[0] + second[0], first[1] + second[1]];
        ([f64::NAN, ahead - trans, turned], [[0.0; 2], along, both], RowVector3::zeros())
    };
    let forward = RowVector3::new(cos, sin, 0.0);
    let jacobian = Matrix3::from_rows(&[across, forward, RowVector3::new(0.0, 0.0, 1.0) - across]);
    Observation { residuals, coefficients, reading: [rot1, trans, rot2], expected, jacobian }
}

/// Returns the residuals of the turn, of the drive and of the slide across the drive.
fn omni(expected: SE2, motion: &SE2) -> Observation {
    let read = OdomDelta::from_poses(&SE2::identity(), &expected);
    let OdomDelta { rot1, trans, rot2 } = read;
    let unit = unit_variances(OdometryRule::Omni, &read);
    let (sin, cos) = libm::sincos(rot1);
    let residuals = [
        wrap_angle(motion.theta() - rot1 - rot2),
        cos * motion.x() + sin * motion.y() - trans,
        cos * motion.y() - sin * motion.x(),
    ];
    let coefficients =
        [unit.map(|unit| unit.rot2.0), unit.map(|unit| unit.trans.0), unit.map(|unit| unit.strafe.0)];
    let jacobian = Matrix3::new(0.0, 0.0, 1.0, cos, sin, 0.0, -sin, cos, 0.0);
    Observation { residuals, coefficients, reading: [rot1, trans, rot2], expected, jacobian }
}

/// Returns the residuals of v, ω and γ: the constant command that leads where the odometry says, against the arc that was driven.
fn velocity(dt: f64, read: &SE2, motion: &SE2, is_linear: bool) -> Observation {
    let twist = read.log();
    // A command does not lead sideways.
    let expected = SE2::exp(&Vector3::new(twist.x, 0.0, twist.z));
    let [length, turn] = [twist.x, twist.z];
    let [v, omega] = [length / dt, turn / dt];
    let squares = [v * v, omega * omega];
    let half = 0.5 * turn;
    let (sin, cos) = libm::sincos(half);
    let forward = RowVector3::new(cos, sin, 0.0) / sinc(half);
    let executed = invert_arc(&SE2::identity(), motion, dt);
    let (residuals, coefficients, jacobian) =
        if has_direction(length.abs(), length.signum() * executed.v_hat * dt, is_linear) {
            let bearing = RowVector3::new(-sin, cos, 0.0) / (length * sinc(half));
            let jacobian = Matrix3::from_rows(&[
                forward - bearing * (length * log_sinc_derivative(half)),
                bearing * 2.0,
                RowVector3::new(0.0, 0.0, 1.0) - bearing * 2.0,
            ]) / dt;
            let residuals = if is_linear {
                let turned = wrap_angle(motion.theta() - expected.theta());
                let off = Vector3::new(motion.x() - expected.x(), motion.y() - expected.y(), turned);
                (jacobian * off).into()
            } else {
                [executed.v_hat - v, wrap_angle((executed.omega_hat - omega) * dt) / dt, executed.gamma_hat]
            };
            (residuals, [squares; 3], jacobian)
        } else {
            let ahead = (cos * motion.x() + sin * motion.y()) / sinc(half) / dt;
            let jacobian = Matrix3::from_rows(&[forward / dt, RowVector3::zeros(), RowVector3::zeros()]);
            ([ahead - v, f64::NAN, f64::NAN], [squares, [0.0; 2], [0.0; 2]], jacobian)
        };
    Observation { residuals, coefficients, reading: [v, omega, dt], expected, jacobian }
}
