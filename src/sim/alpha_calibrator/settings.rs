//! What a user sets of the Alpha Calibrator.

use crate::calibrate::{self, LegLength, ReferenceError, Which};
use crate::models::OdometryRule;
use crate::noise::NoiseKind;
use crate::sim::settings::{Allowed, MAX_SEED, Rules, SettingsError, Word, Words, settings};

/// Whose α's are sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// Four, by the rule that is set.
    Odometry,
    /// Five, of a robot that can drive sideways: [`OdometryRule::Omni`].
    Omnidirectional,
    /// Six, of the commands.
    Velocity,
}

impl Words for Model {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("odometry", Self::Odometry),
        ("omnidirectional", Self::Omnidirectional),
        ("velocity", Self::Velocity),
    ];
}

settings! {
    /// Everything that a user sets.
    pub struct Settings {
        /// Whose α’s are sought: four of odometry, five of a robot that can drive sideways, six of commands.
        model: Model = Model::Odometry;
        /// Whose bookkeeping of the odometry’s noise it is; omni goes with the omnidirectional model, and with no other.
        rule: OdometryRule = OdometryRule::Table;
        /// Distribution of the noise; the variances are the same.
        noise: NoiseKind = NoiseKind::Normal;
        /// Whether a share of the legs may be bad, as where the reference jumps: it is estimated then.
        robust: bool = true;
        /// A leg ends where the odometry is further away in x or in y: `update_min_d` of AMCL.
        distance: f64 = 0.25, "m", in 0.01..=100.0;
        /// A leg ends where the odometry has turned by more: `update_min_a` of AMCL.
        angle: f64 = 0.2, "rad", in 0.01..=3.0;
        /// Where it is above 0, a leg ends after so long instead, whatever the odometry says.
        duration: f64 = 0.0, "s", in 0.0..=1e3;
        /// Whether the yaw at which the reference is mounted is removed.
        mountYaw, by mount_yaw_mut;
        /// Whether the reference’s lever arm is removed.
        leverArm, by lever_arm_mut;
        /// Whether the odometry’s scale of distances is removed.
        distanceScale, by distance_scale_mut;
        /// Whether the odometry’s scale of turns is removed.
        turnScale, by turn_scale_mut;
        /// Whether the offset between the two clocks is removed.
        clockOffset, by clock_offset_mut;
        /// Whether the α’s of legs of other lengths are fitted too, which takes up to three times as long.
        byLength, by by_length_mut;
        /// Standard deviation of the reference’s own coordinates; 0: as the log says, if it does.
        positionDeviation, by position_deviation_mut, "m", in 0.0..=1e3;
        /// Standard deviation of the reference’s own heading; 0: as the log says, if it does.
        headingDeviation, by heading_deviation_mut, "rad", in 0.0..=1e3;
        /// What the α’s are multiplied by in what is predicted.
        inflation: f64 = 1.0, in 0.01..=100.0;
        // One whose intervals hold all of the true values: what everybody sees first should not be bad luck.
        /// The same seed is the same luck of the simulated log, and of the bootstrap.
        seed: u64 = 8, in 0..=MAX_SEED;
        kept {
            /// The setting `mountYaw`.
            mount_yaw: bool = true;
            /// The setting `leverArm`.
            lever_arm: bool = true;
            /// The setting `distanceScale`.
            distance_scale: bool = true;
            /// The setting `turnScale`.
            turn_scale: bool = true;
            /// The setting `clockOffset`.
            clock_offset: bool = true;
            /// The setting `byLength`.
            by_length: bool = false;
            /// The settings `positionDeviation` and `headingDeviation`.
            deviations: ReferenceError = ReferenceError { position: 0.0, heading: 0.0 };
        }
    }
}

impl Settings {
    fn mount_yaw_mut(&mut self) -> &mut bool {
        &mut self.mount_yaw
    }

    fn lever_arm_mut(&mut self) -> &mut bool {
        &mut self.lever_arm
    }

    fn distance_scale_mut(&mut self) -> &mut bool {
        &mut self.distance_scale
    }

    fn turn_scale_mut(&mut self) -> &mut bool {
        &mut self.turn_scale
    }

    fn clock_offset_mut(&mut self) -> &mut bool {
        &mut self.clock_offset
    }

    fn by_length_mut(&mut self) -> &mut bool {
        &mut self.by_length
    }

    fn position_deviation_mut(&mut self) -> &mut f64 {
        &mut self.deviations.position
    }

    fn heading_deviation_mut(&mut self) -> &mut f64 {
        &mut self.deviations.heading
    }

    /// Whether what is fitted under these settings is what is fitted under others: the factor is for the picture alone.
    pub(super) fn fits_as(&self, other: &Self) -> bool {
        Self { inflation: other.inflation, ..*self } == *other
    }
}

impl Rules for Settings {
    /// Of the model and the rule, the one that is named takes the other along.
    fn settle(&mut self, _: &Self, named: &[&str]) {
        let fits = self.omnidirectional() == (self.rule == OdometryRule::Omni);
        match [named.contains(&"model"), named.contains(&"rule")] {
            [true, false] if !fits => {
                self.rule = if self.omnidirectional() { OdometryRule::Omni } else { OdometryRule::Table };
            }
            [false, true] if !fits => {
                self.model =
                    if self.rule == OdometryRule::Omni { Model::Omnidirectional } else { Model::Odometry };
            }
            _ => {}
        }
    }

    fn check_together(&self) -> Result<(), SettingsError> {
        if self.omnidirectional() == (self.rule == OdometryRule::Omni) {
            return Ok(());
        }
        let allowed = if self.omnidirectional() { "omni" } else { "table, nav2 or beluga" };
        let allowed = Allowed::Word { is: self.rule.get(), allowed };
        Err(SettingsError { field: "rule".to_owned(), value: f64::NAN, allowed })
    }
}

impl Settings {
    /// The model with its rule.
    pub fn model(&self) -> calibrate::Model {
        match self.model {
            Model::Odometry | Model::Omnidirectional => calibrate::Model::Odometry(self.rule),
            Model::Velocity => calibrate::Model::Velocity,
        }
    }

    /// Which of [`calibrate::Error::ALL`] are removed.
    pub fn removed(&self) -> Which {
        [
            self.clock_offset,
            self.mount_yaw,
            self.lever_arm,
            self.lever_arm,
            self.distance_scale,
            self.turn_scale,
        ]
    }

    /// Where a leg ends.
    pub fn legs(&self) -> LegLength {
        if self.duration > 0.0 {
            return LegLength::Lasted { duration: self.duration };
        }
        LegLength::Moved { distance: self.distance, angle: self.angle }
    }

    /// How well a reference is known of which a log says this.
    pub fn reference_error(&self, said: ReferenceError) -> ReferenceError {
        let of = |own: f64, said: f64| if own > 0.0 { own } else { said };
        ReferenceError {
            position: of(self.deviations.position, said.position),
            heading: of(self.deviations.heading, said.heading),
        }
    }

    fn omnidirectional(&self) -> bool {
        self.model == Model::Omnidirectional
    }
}
