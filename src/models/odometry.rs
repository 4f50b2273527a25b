//! The odometry motion model: Tables 5.5 and 5.6.

use super::MotionModel;
use crate::geom::se2::{SE2, wrap_angle};
use crate::noise::{NoiseKind, Variance, product_or_zero, wrapped_density};
use nalgebra::{Matrix3, Vector3};
use rand::Rng;
use std::f64::consts::PI;

/// Odometry reading as rotation, translation and rotation: `rot1` and `rot2` in (−π, π] rad, `trans` ≥ 0 in m.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify))]
pub struct OdomDelta {
    /// First rotation, from the heading to the direction of the displacement, rad.
    pub rot1: f64,
    /// Translation, m.
    pub trans: f64,
    /// Second rotation, from the direction of the displacement to the new heading, rad.
    pub rot2: f64,
}

/// Displacement (m) below which a reading counts as a turn on the spot. The direction of so small a displacement is only rounding error. No
/// encoder resolves a nanometre, so that no real drive is affected. With a larger bound, slow drives would count as turns on the spot.
const MIN_TRANSLATION: f64 = 1e-9;

impl OdomDelta {
    /// Returns the decomposition of the motion between two poses of the odometry frame (Table 5.5, lines 2–4). For a turn
    /// on the spot, `rot1` is 0 and `rot2` the whole turn.
    pub fn from_poses(previous_pose: &SE2, current_pose: &SE2) -> Self {
        let (dx, dy) = (current_pose.x() - previous_pose.x(), current_pose.y() - previous_pose.y());
        let trans = libm::hypot(dx, dy);
        let whole_turn = current_pose.theta() - previous_pose.theta();
        if trans < MIN_TRANSLATION {
            return Self { rot1: 0.0, trans: 0.0, rot2: wrap_angle(whole_turn) };
        }
        let rot1 = wrap_angle(libm::atan2(dy, dx) - previous_pose.theta());
        Self { rot1, trans, rot2: wrap_angle(whole_turn - rot1) }
    }

    /// Returns the pose that this motion reaches from `x` without noise.
    pub fn apply(&self, x: &SE2) -> SE2 {
        let (sin, cos) = libm::sincos(self.rot1);
        *x * SE2::new(self.trans * cos, self.trans * sin, self.rot1 + self.rot2)
    }
}

/// Noise parameters α₁…α₄, each 0 or more. A rotation δ has the variance α₁δ² + α₂δ_trans². The translation has the variance
/// α₃δ_trans² + α₄(δ_rot1² + δ_rot2²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OdomAlphas(pub [f64; 4]);

/// Odometry motion model of Tables 5.5 and 5.6: independent noise of the two rotations and the translation.
///
/// ```
/// use motion::geom::se2::SE2;
/// use motion::{MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel};
///
/// let (start, end) = (SE2::identity(), SE2::new(1.0, 0.5, 0.8));
/// let reading = OdomDelta::from_poses(&start, &end);
/// let model = OdometryModel { alphas: OdomAlphas([0.02; 4]), noise: NoiseKind::Normal };
/// assert!(model.prob(&end, &reading, &start) > model.prob(&SE2::new(1.2, 0.5, 0.8), &reading, &start));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OdometryModel {
    /// Noise parameters α₁ to α₄.
    pub alphas: OdomAlphas,
    /// Distribution of the noise.
    pub noise: NoiseKind,
}

/// Odometry model with independent noises of first rotation, translation and second rotation. The implementation defines their variances.
pub trait RotTransRot {
    /// Returns the distribution of the noise.
    fn noise(&self) -> NoiseKind;

    /// Returns the variances of rot1, trans and rot2 of `odometry_reading` (rad², m², rad²).
    fn variances(&self, odometry_reading: &OdomDelta) -> [Variance; 3];

    /// Returns the rotation, translation and rotation that the robot executes. Their noises are `unit_noise` times their standard
    /// deviations. As in Table 5.6, noise is subtracted.
    fn executed_motion(&self, u: &OdomDelta, unit_noise: [f64; 3]) -> OdomDelta {
        let [rot1, trans, rot2] = self.variances(u).map(|variance| variance.0.sqrt());
        OdomDelta {
            rot1: u.rot1 - rot1 * unit_noise[0],
            trans: u.trans - trans * unit_noise[1],
            rot2: u.rot2 - rot2 * unit_noise[2],
        }
    }

    /// Returns the covariance of (x, y, θ) that an EKF carries, by linearizing the three noises at the reading. The covariance is 3 × 3, in
    /// the frame of `x` (m², m·rad, rad²).
    fn cartesian_cov(&self, u: &OdomDelta, x: &SE2) -> Matrix3<f64> {
        let (sin, cos) = libm::sincos(x.theta() + u.rot1);
        let rot1_derivative = Vector3::new(-u.trans * sin, u.trans * cos, 1.0);
        let jacobian = Matrix3::from_columns(&[rot1_derivative, Vector3::new(cos, sin, 0.0), Vector3::z()]);
        let leg_variances = self.variances(u).map(|variance| variance.0);
        jacobian * Matrix3::from_diagonal(&Vector3::from(leg_variances)) * jacobian.transpose()
    }
}

impl<M: RotTransRot> MotionModel for M {
    /// Odometry reading, as [`OdomDelta::from_poses`] computes it from two poses of the odometry frame.
    type Control = OdomDelta;

    /// Returns the score of Table 5.5. As in the table, the variances are those of the hypothetical motion between the two poses, not of
    /// the reading.
    fn prob(&self, x_next: &SE2, u: &OdomDelta, x: &SE2) -> f64 {
        let (noise_kind, hypothetical_legs) = (self.noise(), OdomDelta::from_poses(x, x_next));
        let [rot1_variance, trans_variance, rot2_variance] = self.variances(&hypothetical_legs);
        product_or_zero([
            noise_kind.prob(wrap_angle(u.rot1 - hypothetical_legs.rot1), rot1_variance),
            noise_kind.prob(u.trans - hypothetical_legs.trans, trans_variance),
            noise_kind.prob(wrap_angle(u.rot2 - hypothetical_legs.rot2), rot2_variance),
        ])
    }

    /// The map from (δ̂_rot1, δ̂_trans, δ̂_rot2) to poses has the determinant δ̂_trans. Two such motions lead to each pose. One drives
    /// forward. The other drives in reverse, because noise has made the translation negative.
    fn pose_density(&self, x_next: &SE2, u: &OdomDelta, x: &SE2) -> Option<f64> {
        let (noise_kind, variances) = (self.noise(), self.variances(u));
        if variances.iter().any(|variance| variance.0 == 0.0) {
            return None;
        }
        let [rot1_variance, trans_variance, rot2_variance] = variances;
        let relative_pose = x.motion_to(x_next);
        let end_distance = libm::hypot(relative_pose.x(), relative_pose.y());
        let bearing = libm::atan2(relative_pose.y(), relative_pose.x());
        let leg_density: f64 = [(bearing, end_distance), (bearing + PI, -end_distance)]
            .into_iter()
            .map(|(rot1, trans)| {
                product_or_zero([
                    wrapped_density(noise_kind, rot1 - u.rot1, rot1_variance),
                    noise_kind.prob(trans - u.trans, trans_variance),
                    wrapped_density(noise_kind, relative_pose.theta() - rot1 - u.rot2, rot2_variance),
                ])
            })
            .sum();
        Some(if leg_density > 0.0 { leg_density / end_distance } else { 0.0 })
    }

    fn sample<R: Rng + ?Sized>(&self, u: &OdomDelta, x: &SE2, rng: &mut R) -> SE2 {
        self.executed_motion(u, self.noise().sample_unit_triple(rng)).apply(x)
    }
}

/// Returns the variances of rot1, trans and rot2 of an odometry reading (rad², m², rad²). If `is_reverse_aware`, a rotation δ counts as
/// min(|δ|, |π − |δ||). This is the smallest turn of a robot that may drive in reverse instead.
pub(super) fn leg_variances(
    alphas: OdomAlphas,
    odometry_reading: &OdomDelta,
    is_reverse_aware: bool,
) -> [Variance; 3] {
    let [a1, a2, a3, a4] = alphas.0;
    let [rot1_sq, rot2_sq] = [odometry_reading.rot1, odometry_reading.rot2].map(|rotation_angle| {
        let turn = rotation_angle.abs();
        let counted_turn = if is_reverse_aware { turn.min((PI - turn).abs()) } else { turn };
        counted_turn * counted_turn
    });
    let trans_sq = odometry_reading.trans * odometry_reading.trans;
    [
        Variance(a1 * rot1_sq + a2 * trans_sq),
        Variance(a3 * trans_sq + a4 * (rot1_sq + rot2_sq)),
        Variance(a1 * rot2_sq + a2 * trans_sq),
    ]
}

impl RotTransRot for OdometryModel {
    fn noise(&self) -> NoiseKind {
        self.noise
    }

    fn variances(&self, odometry_reading: &OdomDelta) -> [Variance; 3] {
        leg_variances(self.alphas, odometry_reading, false)
    }
}

/// The odometry model, optionally for robots that reverse: a rotation δ then counts as min(|δ|, |π − |δ||) in the variances.
///
/// A drive in reverse decomposes into rot1 ≈ π, drive, rot2 ≈ −π. With the variances of the tables it has the noise of two half turns that
/// the robot never made. Deployed localizers also use the smaller angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConfiguredOdometry {
    /// Model of Tables 5.5 and 5.6.
    pub model: OdometryModel,
    /// True if a rotation δ counts as min(|δ|, |π − |δ||).
    pub reverse_aware: bool,
}

impl RotTransRot for ConfiguredOdometry {
    fn noise(&self) -> NoiseKind {
        self.model.noise
    }

    fn variances(&self, odometry_reading: &OdomDelta) -> [Variance; 3] {
        leg_variances(self.model.alphas, odometry_reading, self.reverse_aware)
    }
}
