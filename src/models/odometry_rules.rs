//! Rules by which localizers add noise to an odometry reading: Table 5.6, and the rules of deployed software.

use super::odometry::{OdomAlphas, OdomDelta, leg_variances};
use crate::geom::se2::{SE2, wrap_angle};
use crate::noise::{NoiseKind, Variance};

/// Rule that relates the α's to the variances of the noise. Each rule uses α₁ to α₄. The omnidirectional rule also uses α₅.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OdometryRule {
    /// Table 5.6 as it is printed.
    Table,
    /// AMCL of Navigation2 for a differential drive: `nav2_amcl/src/motion_model/differential_motion_model.cpp` (ros-navigation/
    /// navigation2, commit 0051083). A rotation δ counts as min(|δ|, |π − |δ||), so that a drive in reverse does not count as two half
    /// turns; a reading shorter than a centimetre has no first rotation. The sums of α·δ² are variances. In AMCL of ROS 1 the same sums
    /// were the standard deviations themselves.
    Nav2,
    /// Beluga for a differential drive: `beluga/motion/differential_drive_model.hpp` (Ekumen-OS/beluga, release 2.0 and later). As
    /// [`OdometryRule::Nav2`], except that a reading of exactly a centimetre has no first rotation. Before release 2.0, α₄ applied to the
    /// whole turn rot1 + rot2 instead of to each rotation.
    Beluga,
    /// AMCL of Navigation2 for a robot that can drive sideways: `nav2_amcl/src/motion_model/omni_motion_model.cpp` (same commit). The noise
    /// changes the distance, the position across it (the strafe, α₄ and α₅), and the whole turn, but not the bearing. The turn counts in
    /// full, even if the robot drives in reverse.
    Omni,
}

/// Distance (m) below which deployed localizers treat a reading as a turn on the spot. The direction of so short a motion is only jitter of
/// the encoders. With a larger bound, slow forward motion would lose its bearing.
pub const MAX_SPIN_DISTANCE: f64 = 0.01;

/// Noise parameters α₁…α₅, each 0 or more. Only [`OdometryRule::Omni`] uses α₅.
pub type RuleAlphas = [f64; 5];

/// Variances of the noises of rotation, translation and rotation, and of the displacement across the translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegVariances {
    /// Variance of the first rotation, rad².
    pub rot1: Variance,
    /// Variance of the length of the drive, m².
    pub trans: Variance,
    /// Variance of the second rotation, rad².
    pub rot2: Variance,
    /// Variance of the displacement across the drive, m², which is 0 if the robot cannot drive sideways.
    pub strafe: Variance,
}

impl OdometryRule {
    /// All four odometry rules.
    pub const ALL: [Self; 4] = [Self::Table, Self::Nav2, Self::Beluga, Self::Omni];

    /// Returns the rotation, translation and rotation into which the rule decomposes a reading. Together the three are the same motion to
    /// within [`MAX_SPIN_DISTANCE`]. If the rule treats the reading as a turn on the spot, the second rotation is the whole turn.
    pub fn legs(self, reading: &OdomDelta) -> OdomDelta {
        let is_spin = match self {
            Self::Table | Self::Omni => false,
            Self::Nav2 => reading.trans < MAX_SPIN_DISTANCE,
            Self::Beluga => reading.trans <= MAX_SPIN_DISTANCE,
        };
        if !is_spin {
            return *reading;
        }
        OdomDelta { rot1: 0.0, trans: reading.trans, rot2: wrap_angle(reading.rot1 + reading.rot2) }
    }

    /// Returns the variances of the noises of a measured reading, which may already be decomposed by [`OdometryRule::legs`].
    ///
    /// | rule | rot1 | trans | rot2 | strafe |
    /// |---|---|---|---|---|
    /// | except `Omni` | α₁c₁² + α₂t² | α₃t² + α₄(c₁² + c₂²) | α₁c₂² + α₂t² | 0 |
    /// | `Omni` | 0 | α₃t² + α₄δ² | α₁δ² + α₂t² | α₅t² + α₄δ² |
    ///
    /// In this table t is the length of the drive, cᵢ the angle that rotation i counts as, and δ = rot1 + rot2 the wrapped turn.
    pub fn variances(self, reading: &OdomDelta, alphas: &RuleAlphas) -> LegVariances {
        let [a1, a2, a3, a4, a5] = *alphas;
        let legs = self.legs(reading);
        match self {
            Self::Table | Self::Nav2 | Self::Beluga => {
                let alphas = OdomAlphas([a1, a2, a3, a4]);
                let [rot1, trans, rot2] = leg_variances(alphas, &legs, self != Self::Table);
                LegVariances { rot1, trans, rot2, strafe: Variance(0.0) }
            }
            Self::Omni => {
                let whole_turn = wrap_angle(legs.rot1 + legs.rot2);
                let (trans_sq, turn_sq) = (legs.trans * legs.trans, whole_turn * whole_turn);
                LegVariances {
                    rot1: Variance(0.0),
                    trans: Variance(a3 * trans_sq + a4 * turn_sq),
                    rot2: Variance(a1 * turn_sq + a2 * trans_sq),
                    strafe: Variance(a5 * trans_sq + a4 * turn_sq),
                }
            }
        }
    }
}

/// Motion that a robot executed instead of the measured motion: rotation, translation, rotation, and a displacement across the translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExecutedLegs {
    /// Rotation, translation and rotation of the executed motion.
    pub legs: OdomDelta,
    /// Displacement to the left of the drive, m.
    pub strafe: f64,
}

impl ExecutedLegs {
    /// Returns four poses of a robot that starts from `x`: at the start, after the first turn, at the end of the drive, and after the
    /// second turn. All poses are in the frame of `x`.
    pub fn poses(&self, x: &SE2) -> [SE2; 4] {
        let OdomDelta { rot1, trans, rot2 } = self.legs;
        let pose_after_rot1 = *x * SE2::new(0.0, 0.0, rot1);
        let pose_after_drive = pose_after_rot1 * SE2::new(trans, self.strafe, 0.0);
        [*x, pose_after_rot1, pose_after_drive, pose_after_drive * SE2::new(0.0, 0.0, rot2)]
    }
}

impl LegVariances {
    /// Returns the executed motion when the noises are the given multiples of their standard deviations. `across_noise` is the noise of the
    /// first rotation or of the strafe, because no rule has both. `along_noise` is that of the drive, `turn_noise` that of the second
    /// rotation. As in Table 5.6, noise is subtracted.
    pub fn executed_motion(
        &self,
        legs: &OdomDelta,
        [across_noise, along_noise, turn_noise]: [f64; 3],
    ) -> ExecutedLegs {
        ExecutedLegs {
            legs: OdomDelta {
                rot1: legs.rot1 - self.rot1.0.sqrt() * across_noise,
                trans: legs.trans - self.trans.0.sqrt() * along_noise,
                rot2: legs.rot2 - self.rot2.0.sqrt() * turn_noise,
            },
            strafe: -self.strafe.0.sqrt() * across_noise,
        }
    }

    /// Returns the variance (m²) of the end position across the measured bearing, after a drive of `trans` metres. The closed form is (t² +
    /// σ²_trans)·E[sin² ε_rot1] + σ²_strafe. The mean of the end position across the bearing is 0.
    pub fn cross_track_variance(&self, trans: f64, noise_kind: NoiseKind) -> f64 {
        (trans * trans + self.trans.0) * noise_kind.mean_squared_sine(self.rot1) + self.strafe.0
    }

    /// Returns the variance (rad²) of the unwrapped turn, for a correlation ρ of the noises of both rotations: σ₁² + σ₂² + 2ρσ₁σ₂.
    pub fn heading_variance(&self, rotation_correlation: f64) -> f64 {
        let [rot1_std, rot2_std] = [self.rot1, self.rot2].map(|variance| variance.0.sqrt());
        // The variance is computed as a sum of squares, which is never negative. The three terms might add up to slightly less than 0 for
        // equal variances and ρ = −1.
        let correlated_std = rot1_std + rotation_correlation * rot2_std;
        correlated_std * correlated_std
            + (1.0 - rotation_correlation * rotation_correlation) * rot2_std * rot2_std
    }
}
