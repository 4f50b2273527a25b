//! Residuals of a leg: the motion measured by the reference minus the motion measured by the odometry.
//!
//! Residuals are in the model's own coordinates, in which noise components are independent and have variances that are linear in the α's.

use super::legs::{Leg, distance};
use super::likelihood::{Columns, Parameters};
use super::systematic::{ERROR_COUNT, Systematic};
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
    /// Returns the number of α's.
    pub fn alphas(self) -> usize {
        match self {
            Self::Odometry(OdometryRule::Omni) => 5,
            Self::Odometry(_) => 4,
            Self::Velocity => 6,
        }
    }

    /// Returns the indices, from 0, of the two α's in the variance of each component of [`Observation::residuals`].
    pub fn component_alphas(self) -> [[usize; 2]; 3] {
        match self {
            // Components of the omnidirectional rule: second rotation, translation, strafe.
            Self::Odometry(OdometryRule::Omni) => [[0, 1], [2, 3], [4, 3]],
            // Components of all other rules: first rotation, translation, second rotation.
            Self::Odometry(_) => [[0, 1], [2, 3], [0, 1]],
            // Components of the velocity model: v, ω, γ.
            Self::Velocity => [[0, 1], [2, 3], [4, 5]],
        }
    }

    /// Returns the variances of the wheels' noise in one leg.
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

    /// Returns true if an α (index from 0) multiplies the square of a turn or turn rate, and false if it multiplies the square of a
    /// distance or speed.
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
    /// Odometry reading in the model's coordinates: rot1, trans, rot2 (rad, m, rad), or v, ω, Δt (m/s, rad/s, s).
    pub reading: [f64; 3],
    /// Motion that the model expects from the odometry, in the frame of the leg's start.
    pub expected: SE2,
    /// Motion that the reference measured, in the frame of the leg's start.
    pub measured: SE2,
    /// Jacobian of the residuals with respect to each systematic error, then the residuals, 0 where they are NaN.
    pub(super) columns: Columns,
    /// Jacobians of the residuals with respect to the reference's errors at the start and at the end of the leg.
    pub(super) reference_jacobians: [Matrix3<f64>; 2],
    /// Jacobian of the displacement of the leg's end with respect to the wheels' noise in the model's coordinates.
    pub(super) noise_jacobian: Matrix3<f64>,
    /// True if the leg starts at the reference pose at which the previous leg of the fit ends.
    pub(super) follows: bool,
}

/// Maximum ratio of the reference's noise to the length of a leg for which directions are computed by atan2. With more noise atan2 is
/// biased, and directions are linearized in the displacement.
const MAX_ATAN2_NOISE_RATIO: f64 = 0.05;

impl Observation {
    /// Returns the residuals of a leg, with the systematic errors `corrected` removed.
    ///
    /// `position_std` (m) is the standard deviation of the reference.
    pub(super) fn new(model: Model, leg: &Leg, corrected: &Systematic, position_std: f64) -> Self {
        let (expected, measured) = (corrected.expected(model, leg), corrected.motion(leg));
        let Prediction { reading, motion, mut coefficients, noise_jacobian } = match model {
            Model::Odometry(OdometryRule::Omni) => Prediction::omnidirectional(&expected),
            Model::Odometry(rule) => Prediction::differential(rule, &expected),
            Model::Velocity => Prediction::velocity(&expected, leg.duration()),
        };
        let exact_residuals = match model {
            _ if position_std > MAX_ATAN2_NOISE_RATIO * distance(&expected) => None,
            Model::Odometry(OdometryRule::Omni) => None,
            Model::Odometry(_) => Some(exact_odometry_residuals(reading, &measured)),
            Model::Velocity => Some(exact_velocity_residuals(reading, &measured)),
        };
        let has_direction = model.drives_sideways()
            || distance(&motion) >= MAX_SPIN_DISTANCE
                && exact_residuals.is_none_or(|(length, _)| length >= MAX_SPIN_DISTANCE);
        let expected = if model == Model::Velocity { motion } else { expected };
        let (mut jacobian, mut residuals) = (Matrix3::zeros(), [f64::NAN; 3]);
        let displacement = Vector3::from(<[f64; 3]>::from(motion.between(&measured)));
        if has_direction {
            jacobian = noise_jacobian.try_inverse().unwrap_or_default();
            // Angles of linearized residuals are not wrapped at π, because their covariances are linearized too.
            residuals =
                exact_residuals.map_or_else(|| (jacobian * displacement).into(), |(_, residuals)| residuals);
        } else {
            let observed_components: &[usize] = match model {
                Model::Velocity => &[0],
                // A leg without a direction has no first rotation. Its second rotation is the whole turn, with the noise of both rotations.
                Model::Odometry(_) => &[1, 2],
            };
            // The observed columns of the noise's Jacobian are orthogonal, which makes their pseudoinverse simple.
            for k in observed_components.iter().copied() {
                let column = noise_jacobian.column(k);
                jacobian.set_row(k, &(column.transpose() / column.norm_squared()));
                residuals[k] = (jacobian.row(k) * displacement).x;
            }
            if residuals[0].is_nan() {
                coefficients[2] = std::array::from_fn(|k| coefficients[0][k] + coefficients[2][k]);
            }
        }
        let mut columns = Columns::zeros();
        let error_jacobian = jacobian * corrected.motion_jacobian(model, leg, &expected);
        columns.fixed_columns_mut::<ERROR_COUNT>(0).copy_from(&error_jacobian);
        for k in 0..3 {
            if residuals[k].is_nan() {
                coefficients[k] = [0.0; 2];
            } else {
                columns[(k, ERROR_COUNT)] = residuals[k];
            }
        }
        // Errors of the reference are given in the frame of the measured end pose. The Jacobian expects the frame of the expected end pose.
        let heading_error = expected.between(&measured).theta();
        let end_jacobian = jacobian * SE2::new(0.0, 0.0, heading_error).adjoint();
        let reference_jacobians =
            corrected.reference_jacobians(&measured).map(|pose_jacobian| end_jacobian * pose_jacobian);
        Self {
            residuals,
            coefficients,
            reading,
            expected,
            measured,
            columns,
            reference_jacobians,
            noise_jacobian,
            follows: leg.follows,
        }
    }
}

/// Sine of the angle between a leg's displacement and its mean heading, above which the leg moves sideways. The sine is 0 for an arc.
const MIN_SIDEWAYS_SINE: f64 = 0.5;

impl Observation {
    /// Returns true if the reading is a drive to the side, which the model's odometry rule decomposes into large turns. Under Table 5.6 a
    /// drive backwards also counts. A turn on the spot, with the first rotation 0, has no direction and does not count.
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

/// Returns the variances of an odometry reading per unit of the first α of each component, and per unit of the second α.
fn unit_variances(rule: OdometryRule, reading: &OdomDelta) -> [LegVariances; 2] {
    [[1.0, 0.0, 1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0, 0.0]].map(|alphas| rule.variances(reading, &alphas))
}

/// Motion that a model expects from an odometry reading, and the noise of this motion.
struct Prediction {
    /// Odometry reading: see [`Observation::reading`].
    reading: [f64; 3],
    motion: SE2,
    /// Coefficients of the α's in the variances: see [`Observation::coefficients`].
    coefficients: [[f64; 2]; 3],
    /// Jacobian of the end of the motion with respect to the noise, in the frame of the end.
    noise_jacobian: Matrix3<f64>,
}

impl Prediction {
    /// Returns the prediction of an odometry rule, with noise of rot1, trans and rot2.
    fn differential(rule: OdometryRule, expected: &SE2) -> Self {
        let odometry_reading = OdomDelta::from_poses(&SE2::identity(), expected);
        let OdomDelta { rot1, trans, rot2 } = rule.legs(&odometry_reading);
        let variances = unit_variances(rule, &odometry_reading);
        let coefficients = [
            variances.map(|variances| variances.rot1.0),
            variances.map(|variances| variances.trans.0),
            variances.map(|variances| variances.rot2.0),
        ];
        let (sin, cos) = libm::sincos(rot1);
        let motion = SE2::new(trans * cos, trans * sin, rot1 + rot2);
        let (sin, cos) = libm::sincos(rot2);
        let noise_jacobian = Matrix3::new(trans * sin, cos, 0.0, trans * cos, -sin, 0.0, 1.0, 0.0, 1.0);
        Self { reading: [rot1, trans, rot2], motion, coefficients, noise_jacobian }
    }

    /// Returns the prediction of the omnidirectional rule, with noise of the turn, the translation, and the strafe across the translation.
    fn omnidirectional(expected: &SE2) -> Self {
        let odometry_reading = OdomDelta::from_poses(&SE2::identity(), expected);
        let OdomDelta { rot1, trans, rot2 } = odometry_reading;
        let variances = unit_variances(OdometryRule::Omni, &odometry_reading);
        let coefficients = [
            variances.map(|variances| variances.rot2.0),
            variances.map(|variances| variances.trans.0),
            variances.map(|variances| variances.strafe.0),
        ];
        let (sin, cos) = libm::sincos(rot2);
        let noise_jacobian = Matrix3::new(0.0, cos, sin, 0.0, -sin, cos, 1.0, 0.0, 0.0);
        Self { reading: [rot1, trans, rot2], motion: *expected, coefficients, noise_jacobian }
    }

    /// Returns the prediction with noise of v, ω and γ of the constant command that explains the odometry. A command has no sideways
    /// component.
    fn velocity(expected: &SE2, dt: f64) -> Self {
        let twist = expected.log().component_mul(&Vector3::new(1.0, 0.0, 1.0));
        let [v, omega] = [twist.x / dt, twist.z / dt];
        // Noise of v and ω changes the twist. Noise of γ turns the final pose on the spot.
        let mut noise_jacobian = SE2::right_jacobian(&twist) * dt;
        noise_jacobian.swap_columns(1, 2);
        noise_jacobian.set_column(2, &(Vector3::z() * dt));
        let coefficients = [[v * v, omega * omega]; 3];
        Self { reading: [v, omega, dt], motion: SE2::exp(&twist), coefficients, noise_jacobian }
    }
}

/// Returns the length (m) of a measured motion in the direction of the reading, and its residuals of rot1, trans and rot2.
fn exact_odometry_residuals([rot1, trans, rot2]: [f64; 3], measured: &SE2) -> (f64, [f64; 3]) {
    let (sin, cos) = libm::sincos(rot1);
    let ahead = cos * measured.x() + sin * measured.y();
    let left = cos * measured.y() - sin * measured.x();
    let bearing_error = libm::atan2(left, ahead);
    let turn_error = wrap_angle(measured.theta() - rot1 - rot2 - bearing_error);
    (ahead, [bearing_error, libm::hypot(ahead, left) - trans, turn_error])
}

/// Returns the length (m) of a measured motion in the direction of the reading, and its residuals of v, ω and γ.
fn exact_velocity_residuals([v, omega, dt]: [f64; 3], measured: &SE2) -> (f64, [f64; 3]) {
    let arc = invert_arc(&SE2::identity(), measured, dt);
    let omega_error = wrap_angle((arc.omega_hat - omega) * dt) / dt;
    (v.signum() * arc.v_hat * dt, [arc.v_hat - v, omega_error, arc.gamma_hat])
}
