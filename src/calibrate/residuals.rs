//! Residuals of a leg: the motion measured by the reference minus the motion measured by the odometry.
//!
//! Residuals are in the model's own coordinates, in which noise components are independent and have variances that are linear in the α's.

use super::legs::{Leg, distance};
use super::likelihood::Parameters;
use super::systematic::Systematic;
use crate::geom::arc::invert_arc;
use crate::geom::se2::{SE2, wrap_angle};
use crate::models::{LegVariances, MAX_SPIN_DISTANCE, OdomDelta, OdometryRule};
use nalgebra::{Matrix3, Vector3};
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

    /// Returns true if an α (index from 0) multiplies the square of a turn or turn rate, and false for that of a distance or speed.
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
    /// Executed minus expected motion in the model's coordinates. An unobservable component is NaN, for example the first rotation of a turn on
    /// the spot.
    pub residuals: [f64; 3],
    /// Coefficients of the two α's in the variance of each component.
    pub coefficients: [[f64; 2]; 3],
    /// Reading in the model's coordinates: rot1, trans, rot2 (rad, m, rad), or v, ω, Δt (m/s, rad/s, s).
    pub reading: [f64; 3],
    /// Motion that the model expects from the odometry, in the frame of the leg's start.
    pub expected: SE2,
    /// Jacobian of the residuals with respect to a displacement of the leg's end (x, y, θ), in the frame of the end.
    pub(super) jacobian: Matrix3<f64>,
    /// Jacobian of the displacement of the leg's end with respect to the wheels' noise in the model's coordinates.
    pub(super) noise_jacobian: Matrix3<f64>,
}

/// Maximum ratio of the reference's noise to the length of a leg for which directions are computed by atan2. With more noise atan2 is
/// biased, and directions are linearized in the displacement.
const MAX_ATAN2_NOISE_RATIO: f64 = 0.05;

impl Observation {
    /// Returns the residuals of a leg, with these systematic errors corrected.
    ///
    /// `position_std` (m) is the standard deviation of the reference.
    pub(super) fn new(model: Model, leg: &Leg, corrected: &Systematic, position_std: f64) -> Self {
        let expected = corrected.expected(model, leg);
        let motion = corrected.motion(leg);
        let is_linear = position_std > MAX_ATAN2_NOISE_RATIO * distance(&expected);
        match model {
            Model::Odometry(OdometryRule::Omni) => omni_residuals(expected, &motion),
            Model::Odometry(rule) => differential_residuals(rule, expected, &motion, is_linear),
            Model::Velocity => velocity_residuals(leg.duration(), &expected, &motion, is_linear),
        }
    }
}

/// Sine of the angle between a leg's displacement and its mean heading, above which the leg moves sideways. It is 0 for an arc.
const MIN_SIDEWAYS_SINE: f64 = 0.5;

impl Observation {
    /// Returns true if the reading is a drive to the side, which the rule decomposes into large turns. Under Table 5.6 a drive backwards counts
    /// too. A reading without a first rotation has no direction, and does not count.
    pub(crate) fn moves_sideways(&self, model: Model) -> bool {
        let [rot1, _, rot2] = self.reading;
        let (sin, cos) = libm::sincos(rot1 - 0.5 * wrap_angle(rot1 + rot2));
        match model {
            Model::Odometry(OdometryRule::Omni) | Model::Velocity => false,
            Model::Odometry(rule) => {
                rot1 != 0.0 && (sin.abs() > MIN_SIDEWAYS_SINE || (rule == OdometryRule::Table && cos < 0.0))
            }
        }
    }
}

/// Returns the variances of a reading per unit of the first α of each component, and per unit of the second.
fn unit_variances(rule: OdometryRule, reading: &OdomDelta) -> [LegVariances; 2] {
    [[1.0, 0.0, 1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0, 0.0]].map(|alphas| rule.variances(reading, &alphas))
}

/// Returns true if a leg has a direction: its length by the reading and that by the reference (m) are at least [`MAX_SPIN_DISTANCE`]. For a
/// linearized direction the first is enough. The second is negative if the reference measured a motion opposite to the reading.
fn has_direction(reading_length: f64, executed_length: f64, is_linear: bool) -> bool {
    reading_length >= MAX_SPIN_DISTANCE && (is_linear || executed_length >= MAX_SPIN_DISTANCE)
}

/// Returns the residuals of rot1, trans and rot2. In a turn on the spot the second rotation is the whole turn.
fn differential_residuals(rule: OdometryRule, expected: SE2, motion: &SE2, is_linear: bool) -> Observation {
    let odometry_reading = OdomDelta::from_poses(&SE2::identity(), &expected);
    let OdomDelta { rot1, trans, rot2 } = rule.legs(&odometry_reading);
    let unit_variance_pair = unit_variances(rule, &odometry_reading);
    let [rot1_coefficients, trans_coefficients, rot2_coefficients] = [
        unit_variance_pair.map(|variances| variances.rot1.0),
        unit_variance_pair.map(|variances| variances.trans.0),
        unit_variance_pair.map(|variances| variances.rot2.0),
    ];
    let (sin, cos) = libm::sincos(rot1);
    let [ahead, left] = [cos * motion.x() + sin * motion.y(), cos * motion.y() - sin * motion.x()];
    let turn_residual = wrap_angle(motion.theta() - rot1 - rot2);
    let (sin, cos) = libm::sincos(rot2);
    let noise_jacobian = Matrix3::new(trans * sin, cos, 0.0, trans * cos, -sin, 0.0, 1.0, 0.0, 1.0);
    let (residuals, coefficients, jacobian) = if has_direction(odometry_reading.trans, ahead, is_linear) {
        let (bearing_error, length_error) = if is_linear {
            (left / trans, ahead - trans)
        } else {
            (libm::atan2(left, ahead), libm::hypot(ahead, left) - trans)
        };
        let residuals = [bearing_error, length_error, wrap_angle(turn_residual - bearing_error)];
        let jacobian = noise_jacobian.try_inverse().unwrap_or_default();
        (residuals, [rot1_coefficients, trans_coefficients, rot2_coefficients], jacobian)
    } else {
        let turn_coefficients =
            [rot1_coefficients[0] + rot2_coefficients[0], rot1_coefficients[1] + rot2_coefficients[1]];
        let jacobian = Matrix3::new(0.0, 0.0, 0.0, cos, -sin, 0.0, 0.0, 0.0, 1.0);
        let coefficients = [[0.0; 2], trans_coefficients, turn_coefficients];
        ([f64::NAN, ahead - trans, turn_residual], coefficients, jacobian)
    };
    let reading = [rot1, trans, rot2];
    Observation { residuals, coefficients, reading, expected, jacobian, noise_jacobian }
}

/// Returns the residuals of the turn, of the translation and of the strafe across it.
fn omni_residuals(expected: SE2, motion: &SE2) -> Observation {
    let odometry_reading = OdomDelta::from_poses(&SE2::identity(), &expected);
    let OdomDelta { rot1, trans, rot2 } = odometry_reading;
    let unit_variance_pair = unit_variances(OdometryRule::Omni, &odometry_reading);
    let (sin, cos) = libm::sincos(rot1);
    let residuals = [
        wrap_angle(motion.theta() - rot1 - rot2),
        cos * motion.x() + sin * motion.y() - trans,
        cos * motion.y() - sin * motion.x(),
    ];
    let coefficients = [
        unit_variance_pair.map(|variances| variances.rot2.0),
        unit_variance_pair.map(|variances| variances.trans.0),
        unit_variance_pair.map(|variances| variances.strafe.0),
    ];
    let (sin, cos) = libm::sincos(rot2);
    let jacobian = Matrix3::new(0.0, 0.0, 1.0, cos, -sin, 0.0, sin, cos, 0.0);
    let (reading, noise_jacobian) = ([rot1, trans, rot2], jacobian.transpose());
    Observation { residuals, coefficients, reading, expected, jacobian, noise_jacobian }
}

/// Returns the residuals of v, ω and γ: the arc measured by the reference minus the constant command that explains the odometry.
fn velocity_residuals(dt: f64, reading_motion: &SE2, motion: &SE2, is_linear: bool) -> Observation {
    let twist = reading_motion.log();
    // A velocity command has no sideways component.
    let expected = SE2::exp(&Vector3::new(twist.x, 0.0, twist.z));
    let [length, turn] = [twist.x, twist.z];
    let [v, omega] = [length / dt, turn / dt];
    let squared_rates = [v * v, omega * omega];
    // A change of v or ω changes the twist, and γ turns the end.
    let twist_jacobian = SE2::right_jacobian(&(Vector3::new(length, 0.0, turn)));
    let noise_jacobian =
        Matrix3::from_columns(&[twist_jacobian.column(0), twist_jacobian.column(2), Vector3::z().column(0)])
            * dt;
    let executed_arc = invert_arc(&SE2::identity(), motion, dt);
    let displacement = <[f64; 3]>::from(expected.between(motion));
    let (residuals, coefficients, jacobian) =
        if has_direction(length.abs(), length.signum() * executed_arc.v_hat * dt, is_linear) {
            let jacobian = noise_jacobian.try_inverse().unwrap_or_default();
            let residuals = if is_linear {
                (jacobian * Vector3::from(displacement)).into()
            } else {
                [
                    executed_arc.v_hat - v,
                    wrap_angle((executed_arc.omega_hat - omega) * dt) / dt,
                    executed_arc.gamma_hat,
                ]
            };
            (residuals, [squared_rates; 3], jacobian)
        } else {
            // Only v is observed.
            let end_per_v = noise_jacobian.column(0);
            let row = end_per_v.transpose() / end_per_v.norm_squared();
            let residual = (row * Vector3::from(displacement)).x;
            let mut jacobian = Matrix3::zeros();
            jacobian.set_row(0, &row);
            ([residual, f64::NAN, f64::NAN], [squared_rates, [0.0; 2], [0.0; 2]], jacobian)
        };
    let reading = [v, omega, dt];
    Observation { residuals, coefficients, reading, expected, jacobian, noise_jacobian }
}
