//! Residuals of a leg: the motion measured by the reference minus the motion measured by the odometry.
//!
//! Residuals are in the model's own coordinates, in which noise components are independent and have variances that are linear in the α's.
//! Systematic errors of odometry and reference are equal in all legs.

use super::legs::{Leg, distance, distance_along};
use super::likelihood::{Columns, Parameters};
use crate::geom::arc::invert_arc;
use crate::geom::se2::{SE2, wrap_angle};
use crate::models::{LegVariances, MAX_SPIN_DISTANCE, OdomDelta, OdometryRule};
use nalgebra::{Complex, Matrix3, SMatrix, Vector3};
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
    pub fn alpha_count(self) -> usize {
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
        let alphas = self.component_alphas().map(|alphas| alphas.map(|alpha_index| parameters[alpha_index]));
        Vector3::from_fn(|k, _| alphas[k][0] * coefficients[k][0] + alphas[k][1] * coefficients[k][1])
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

    /// Returns the coordinates of a motion of duration `dt` (s): rot1, trans, rot2 (rad, m, rad), or v, ω, γ (m/s, rad/s, rad/s).
    fn coordinates(self, motion: &SE2, dt: f64) -> [f64; 3] {
        match self {
            Self::Odometry(rule) => {
                let OdomDelta { rot1, trans, rot2 } =
                    rule.legs(&OdomDelta::from_poses(&SE2::identity(), motion));
                [rot1, trans, rot2]
            }
            Self::Velocity => {
                let arc = invert_arc(&SE2::identity(), motion, dt);
                [arc.v_hat, arc.omega_hat, arc.gamma_hat]
            }
        }
    }

    /// Returns the difference of two coordinates of motions of duration `dt` (s), with angles in (−π, π].
    fn difference(self, measured: [f64; 3], expected: [f64; 3], dt: f64) -> [f64; 3] {
        let difference: [f64; 3] = std::array::from_fn(|k| measured[k] - expected[k]);
        match self {
            Self::Odometry(_) => [wrap_angle(difference[0]), difference[1], wrap_angle(difference[2])],
            Self::Velocity => [difference[0], wrap_angle(difference[1] * dt) / dt, difference[2]],
        }
    }

    /// Returns the coefficients of the α's in the variances: see [`Observation::coefficients`].
    fn coefficients(self, [first, second, third]: [f64; 3]) -> [[f64; 2]; 3] {
        let Self::Odometry(rule) = self else { return [[first * first, second * second]; 3] };
        let reading = OdomDelta { rot1: first, trans: second, rot2: third };
        // Variances per unit of the first α of each component, and per unit of the second α.
        let [first, second] = [[1.0, 0.0, 1.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0, 0.0]].map(|alphas| {
            let LegVariances { rot1, trans, rot2, strafe } = rule.variances(&reading, &alphas);
            if self.drives_sideways() { [rot2, trans, strafe] } else { [rot1, trans, rot2] }
        });
        std::array::from_fn(|k| [first[k].0, second[k].0])
    }

    /// Returns the Jacobian of the end of a motion with respect to the noise of its coordinates, in the frame of the end. In a motion without
    /// a direction, noise across the motion takes the place of the component that is then not observable.
    fn noise_jacobian(
        self,
        motion: &SE2,
        coordinates: [f64; 3],
        dt: f64,
        has_direction: bool,
    ) -> Matrix3<f64> {
        let perpendicular_of = |along: Vector3<f64>| Vector3::new(-along.y, along.x, 0.0);
        if self == Self::Velocity {
            // Noise of v and ω changes the twist. Noise of γ turns the final pose on the spot.
            let jacobian = SE2::right_jacobian(&motion.log()) * dt;
            let [along, turn] = [0, 2].map(|twist_component| jacobian.column(twist_component).into_owned());
            let second = if has_direction { turn } else { perpendicular_of(along) };
            return Matrix3::from_columns(&[along, second, Vector3::z() * dt]);
        }
        let [_, trans, rot2] = coordinates;
        let (sin, cos) = libm::sincos(rot2);
        let (along, turn) = (Vector3::new(cos, -sin, 0.0), Vector3::z());
        Matrix3::from_columns(&match has_direction {
            _ if self.drives_sideways() => [turn, along, perpendicular_of(along)],
            true => [trans * perpendicular_of(along) + turn, along, turn],
            false => [perpendicular_of(along), along, turn],
        })
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

/// Sine of the angle between a leg's displacement and its mean heading, above which the leg moves sideways. The sine is 0 for an arc.
const MIN_SIDEWAYS_SINE: f64 = 0.5;

/// Maximum ratio of the reference's noise to the length of a leg for which residuals are differences of coordinates. With more noise the
/// direction by atan2 is biased, and residuals are linearized in the displacement.
const MAX_EXACT_NOISE_RATIO: f64 = 0.05;

impl Observation {
    /// Returns the residuals of a leg, with the systematic errors `corrected` removed.
    ///
    /// `position_std` (m) is the standard deviation of the reference.
    pub(super) fn new(model: Model, leg: &Leg, corrected: &Systematic, position_std: f64) -> Self {
        let (expected, measured, dt) =
            (corrected.expected(model, leg), corrected.motion(leg), leg.duration());
        let coordinates = model.coordinates(&expected, dt);
        let mut coefficients = model.coefficients(coordinates);
        let is_exact =
            !model.drives_sideways() && position_std <= MAX_EXACT_NOISE_RATIO * distance(&expected);
        let has_direction = model.drives_sideways()
            || distance(&expected) >= MAX_SPIN_DISTANCE
                && (!is_exact || distance_along(&measured, &expected) >= MAX_SPIN_DISTANCE);
        let noise_jacobian = model.noise_jacobian(&expected, coordinates, dt, has_direction);
        let mut jacobian = noise_jacobian.try_inverse().unwrap_or_default();
        let displacement = Vector3::from(<[f64; 3]>::from(expected.motion_to(&measured)));
        let mut residuals = if is_exact && has_direction {
            model.difference(model.coordinates(&measured, dt), coordinates, dt)
        } else {
            // Angles are not wrapped at π, because their covariances are linearized too.
            (jacobian * displacement).into()
        };
        let mut columns = Columns::zeros();
        let unobserved_components: &[usize] = match model {
            _ if has_direction => &[],
            Model::Velocity => &[1, 2],
            Model::Odometry(_) => {
                // The second rotation is the whole turn, with the noise of both rotations.
                coefficients[2] = std::array::from_fn(|k| coefficients[0][k] + coefficients[2][k]);
                &[0]
            }
        };
        columns.set_column(ERROR_COUNT, &Vector3::from(residuals));
        for &k in unobserved_components {
            (residuals[k], coefficients[k], columns[(k, ERROR_COUNT)]) = (f64::NAN, [0.0; 2], 0.0);
            jacobian.row_mut(k).fill(0.0);
        }
        let error_jacobian = jacobian * corrected.motion_jacobian(model, leg, &expected);
        columns.fixed_columns_mut::<ERROR_COUNT>(0).copy_from(&error_jacobian);
        // Errors of the reference are given in the frame of the measured end pose. The Jacobian expects the frame of the expected end pose.
        let end_jacobian = jacobian * SE2::new(0.0, 0.0, displacement.z).adjoint();
        let reference_jacobians =
            corrected.reference_jacobians(&measured).map(|pose_jacobian| end_jacobian * pose_jacobian);
        let reading =
            if model == Model::Velocity { [coordinates[0], coordinates[1], dt] } else { coordinates };
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
        let rotation_of = |leg: &Leg| {
            let [odometry, measured] = [leg.odometry, leg.reference].map(|[start, end]| {
                let motion = start.motion_to(&end);
                Complex::new(motion.x(), motion.y())
            });
            odometry * measured.conj()
        };
        let rotation: Complex<f64> = legs.iter().map(rotation_of).sum();
        libm::atan2(rotation.im, rotation.re)
    }

    /// Returns the pose that the reference measures, in the frame of the base.
    fn mount_pose(&self) -> SE2 {
        SE2::new(self.lever_arm[0], self.lever_arm[1], self.mount_yaw)
    }

    /// Returns the pose of the base in the frame of the pose that the reference measures.
    pub fn base(&self) -> SE2 {
        self.mount_pose().inverse()
    }

    /// Returns the motion of the base as measured by the reference, in the frame of the leg's start.
    pub(crate) fn motion(&self, leg: &Leg) -> SE2 {
        let base = self.base();
        let [start, end] = leg.reference.map(|pose| pose * base);
        start.motion_to(&end)
    }

    /// Returns the motion that the odometry measured, with its scales corrected. The sideways motion of a robot that cannot drive sideways is a
    /// product of distances and turns, and has both scales. The velocity model has no sideways motion.
    pub(super) fn expected(&self, model: Model, leg: &Leg) -> SE2 {
        let reading = leg.odometry[1].boxminus(&leg.odometry[0]);
        let Self { distance_scale, turn_scale, .. } = *self;
        let sideways_scale = match model {
            Model::Odometry(OdometryRule::Omni) => distance_scale,
            Model::Odometry(_) => distance_scale * turn_scale,
            Model::Velocity => 0.0,
        };
        SE2::exp(&reading.component_mul(&Vector3::new(distance_scale, sideways_scale, turn_scale)))
    }

    /// Returns the Jacobians of the end of the base's motion with respect to the errors of the reference at the leg's start and end. An
    /// error is a small motion (x, y, θ) in the frame of the reference pose. A change of the end is a small motion in the frame of the end.
    pub(super) fn reference_jacobians(&self, measured: &SE2) -> [Matrix3<f64>; 2] {
        let to_base = self.mount_pose().adjoint();
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
        let yaw_change = self.mount_pose().adjoint().column(2).into_owned();
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
