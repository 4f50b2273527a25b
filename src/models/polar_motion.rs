//! Common form of the velocity and odometry models for a start at the origin.

use super::{OdomDelta, RotTransRot, VelocityCmd, VelocityModel};
use crate::noise::NoiseKind;

/// Motion of a model from the origin: a length along a bearing, and a last turn, with independent noises. Each pair of numbers is a mean
/// and a standard deviation.
///
/// An arc of length s and turn φ ends at the distance s·sinc(φ/2) on the bearing φ/2. The last turn is γ̂Δt. An odometry motion ends at the
/// distance δ̂_trans on the bearing δ̂_rot1. The last turn is δ̂_rot2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolarMotion {
    /// Distribution of the noises.
    pub noise_kind: NoiseKind,
    /// True if `length` is the length of an arc, false if it is the length of its chord.
    pub is_arc: bool,
    /// Length of the motion (mean, standard deviation), m.
    pub length: [f64; 2],
    /// Variance of the length, m². It is not computed from the standard deviation, because roots are rounded.
    pub length_variance: f64,
    /// Bearing of the end of the motion, seen from the origin, rad.
    pub bearing: [f64; 2],
    /// Turn after the arc or the translation (mean, standard deviation), rad.
    pub last_turn: [f64; 2],
    /// Variance of the last turn, rad².
    pub last_turn_variance: f64,
    /// Turn of the command, rad. A pose has several logarithms, and a position several arcs that lead to it: the one whose turn is nearest to this turn
    /// is used.
    pub commanded_turn: f64,
}

impl PolarMotion {
    /// Returns the motion of the velocity model under a command.
    pub fn of_velocity(velocity_model: &VelocityModel, u: &VelocityCmd) -> Self {
        let [length_std, turn_std, last_turn_std] = velocity_model.noise_stds(u).map(|std| std * u.dt);
        let [v_variance, _, gamma_variance] = velocity_model.variances(u).map(|variance| variance.0);
        let commanded_turn = u.omega * u.dt;
        Self {
            noise_kind: velocity_model.noise,
            is_arc: true,
            length: [u.v * u.dt, length_std],
            length_variance: u.dt * u.dt * v_variance,
            bearing: [0.5 * commanded_turn, 0.5 * turn_std],
            last_turn: [0.0, last_turn_std],
            last_turn_variance: u.dt * u.dt * gamma_variance,
            commanded_turn,
        }
    }

    /// Returns the motion of the odometry model for a reading. `commanded_turn` (rad) is the turn of the command that caused the reading.
    pub fn of_odometry(odometry_model: &impl RotTransRot, u: &OdomDelta, commanded_turn: f64) -> Self {
        let [rot1_variance, trans_variance, rot2_variance] =
            odometry_model.variances(u).map(|variance| variance.0);
        Self {
            noise_kind: odometry_model.noise(),
            is_arc: false,
            length: [u.trans, trans_variance.sqrt()],
            length_variance: trans_variance,
            bearing: [u.rot1, rot1_variance.sqrt()],
            last_turn: [u.rot2, rot2_variance.sqrt()],
            last_turn_variance: rot2_variance,
            commanded_turn,
        }
    }

    /// Returns the turn per radian of the bearing: 2 for an arc, and 1 for a chord.
    pub fn turn_per_bearing(&self) -> f64 {
        if self.is_arc { 2.0 } else { 1.0 }
    }

    /// Returns the mean of the whole turn, rad.
    pub fn mean_turn(&self) -> f64 {
        self.turn_per_bearing() * self.bearing[0] + self.last_turn[0]
    }
}
