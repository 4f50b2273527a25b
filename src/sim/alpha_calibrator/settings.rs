//! Settings of the Alpha Calibrator.

use crate::calibrate::{self, ERROR_COUNT, LegLength, Options, Outliers};
use crate::models::OdometryRule;
use crate::noise::NoiseKind;
use crate::sim::settings::{
    AllowedValues, KeywordSetting, MAX_SEED, SettingRules, SettingsError, keywords, settings,
};

/// Motion model whose α's are calibrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// Odometry model with four α's, by the selected odometry rule.
    Odometry,
    /// Odometry model with five α's of a robot that can drive sideways: [`OdometryRule::Omni`].
    Omnidirectional,
    /// Velocity model with six α's. Its logs contain commands instead of odometry.
    Velocity,
}

keywords!(
    Model:
    "odometry" = Self::Odometry, "omnidirectional" = Self::Omnidirectional, "velocity" = Self::Velocity
);

keywords!(Outliers: "reject" = Self::Reject, "keep" = Self::Keep);

settings! {
    /// Settings of the Alpha Calibrator.
    pub struct Settings {
        /// Model whose α’s are calibrated: four of odometry, five of a robot that can drive sideways, or six of commands.
        model: Model = Model::Odometry;
        /// Odometry rule, which relates the α’s to the noise of odometry. The rule omni belongs to the omnidirectional model.
        rule: OdometryRule = OdometryRule::Table;
        /// Distribution of the noise in the predicted end poses of a leg. Its choice does not change the variances.
        noise: NoiseKind = NoiseKind::Normal;
        /// Treatment of outliers, such as jumps of the reference log: excluded, or fitted as noise.
        outliers: Outliers = Outliers::Reject;
        /// Distance by odometry, in x or in y, after which a leg ends: `update_min_d` of AMCL.
        distance: f64 = 0.25, "m", in 0.01..=100.0;
        /// Rotation by odometry after which a leg ends: `update_min_a` of AMCL.
        angle: f64 = 0.2, "rad", in 0.01..=3.0;
        /// Duration of a leg; 0 for legs that end after a distance or rotation.
        duration: f64 = 0.0, "s", in 0.0..=1e3;
        /// Correction of the yaw at which the reference is mounted, if the log identifies it.
        mount_yaw as "mountYaw": bool = true;
        /// Correction of the reference’s lever arm, if the log identifies it.
        lever_arm as "leverArm": bool = true;
        /// Correction of the odometry’s scale of distances, if the log identifies it and it is constant.
        distance_scale as "distanceScale": bool = true;
        /// Correction of the odometry’s scale of turns, if the log identifies it and it is constant.
        turn_scale as "turnScale": bool = true;
        /// Correction of the offset between the two clocks, if the log identifies it.
        clock_offset as "clockOffset": bool = true;
        /// Standard deviation of each coordinate in the reference log; 0 if it is estimated.
        position_std as "positionStd": f64 = 0.0, "m", in 0.0..=1e3;
        /// Standard deviation of the heading in the reference log; 0 if it is estimated.
        yaw_std as "yawStd": f64 = 0.0, "rad", in 0.0..=1e3;
        /// Factor by which the fitted α’s are multiplied in predictions.
        inflation: f64 = 1.0, in 0.01..=100.0;
        // With the default seed, all confidence intervals contain the true values.
        /// Seed of the simulated log, and of the predicted end poses of a leg.
        seed: u64 = 8, in 0..=MAX_SEED;
    }
}

impl Settings {
    /// Copies the settings on which the fit does not depend: inflation, noise distribution and seed of the predicted end poses.
    pub(super) fn copy_prediction_settings(&mut self, other_settings: &Self) {
        let Self { inflation: alpha_inflation, noise: noise_kind, seed, .. } = *other_settings;
        *self = Self { inflation: alpha_inflation, noise: noise_kind, seed, ..*self };
    }

    /// Returns true if `other_settings` give the same fit, because they differ at most in settings of the predicted end poses.
    pub(super) fn has_same_fit(&self, other_settings: &Self) -> bool {
        let mut with_other_prediction = *self;
        with_other_prediction.copy_prediction_settings(other_settings);
        with_other_prediction == *other_settings
    }

    /// Returns the motion model, which contains the odometry rule if it is an odometry model.
    pub fn model(&self) -> calibrate::Model {
        match self.model {
            Model::Odometry | Model::Omnidirectional => calibrate::Model::Odometry(self.rule),
            Model::Velocity => calibrate::Model::Velocity,
        }
    }

    /// Returns the options of the calibration.
    pub fn options(&self) -> Options {
        let Self { mount_yaw, lever_arm, distance_scale, turn_scale, clock_offset, .. } = *self;
        let is_corrected: [bool; ERROR_COUNT] =
            [clock_offset, mount_yaw, lever_arm, lever_arm, distance_scale, turn_scale];
        let none_unless_positive = |std: f64| (std > 0.0).then_some(std);
        Options {
            model: self.model(),
            legs: self.leg_length(),
            outliers: self.outliers,
            correct: is_corrected.map(|should_correct| if should_correct { None } else { Some(false) }),
            position_std: none_unless_positive(self.position_std),
            yaw_std: none_unless_positive(self.yaw_std),
        }
    }

    fn leg_length(&self) -> LegLength {
        if self.duration > 0.0 {
            return LegLength::Duration { duration: self.duration };
        }
        LegLength::Displacement { distance: self.distance, angle: self.angle }
    }

    fn is_omnidirectional(&self) -> bool {
        self.model == Model::Omnidirectional
    }
}

impl SettingRules for Settings {
    /// Keeps model and odometry rule consistent: if the chosen model does not have the rule, it changes the rule; if the chosen rule
    /// belongs to another model, it changes the model.
    fn adjust_settings(&mut self, _: &Self, changed_keys: &[&str]) {
        let does_model_fit_rule = self.is_omnidirectional() == (self.rule == OdometryRule::Omni);
        match [changed_keys.contains(&"model"), changed_keys.contains(&"rule")] {
            [true, false] if !does_model_fit_rule => {
                self.rule = if self.is_omnidirectional() { OdometryRule::Omni } else { OdometryRule::Table };
            }
            [false, true] if !does_model_fit_rule => {
                self.model =
                    if self.rule == OdometryRule::Omni { Model::Omnidirectional } else { Model::Odometry };
            }
            _ => {}
        }
    }

    fn check_combinations(&self) -> Result<(), SettingsError> {
        if self.is_omnidirectional() == (self.rule == OdometryRule::Omni) {
            return Ok(());
        }
        let allowed_rules = if self.is_omnidirectional() { "omni" } else { "thrun, nav2 or beluga" };
        let allowed_values =
            AllowedValues::Keyword { given_keyword: self.rule.get(), allowed: allowed_rules };
        Err(SettingsError { key: "rule".to_owned(), value: f64::NAN, allowed: allowed_values })
    }
}
