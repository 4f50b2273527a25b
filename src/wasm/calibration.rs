//! Conversion of calibrations to plain JavaScript objects.

use super::values::to_plain_js;
use crate::calibrate::{
    Calibration, Diagnostics, ERROR_COUNT, Estimate, LostLegs, NotIdentifiable, Persistence, Recommendation,
    SystematicError,
};
use crate::js::js_structs;
use serde::Serialize;
use tsify::Tsify;
use wasm_bindgen::prelude::*;

/// Keys of the systematic errors in JavaScript, each with its variants of [`SystematicError`].
pub const SYSTEMATIC_ERROR_KEYS: [(&str, &[SystematicError]); 5] = [
    ("clockOffset", &[SystematicError::ClockOffset]),
    ("mountYaw", &[SystematicError::MountYaw]),
    ("leverArm", &[SystematicError::LeverArmAhead, SystematicError::LeverArmLeft]),
    ("distanceScale", &[SystematicError::DistanceScale]),
    ("turnScale", &[SystematicError::TurnScale]),
];

/// Estimate of a systematic error of odometry or reference; null if the log does not identify the error.
#[derive(Serialize, Tsify)]
#[tsify(missing_as_null)]
pub struct SystematicValue<Value, Interval> {
    value: Value,
    interval: Interval,
    /// True if the error is the same on straight and turning legs, and in both halves of the log. Only scales are compared; other errors
    /// count as constant.
    constant: bool,
    /// True if the error was corrected before the α's were fitted.
    corrected: bool,
}

/// Systematic errors of odometry and reference.
///
/// - The reference's time is the odometry's time plus clockOffset (s).
/// - The reference's heading is the base's heading plus mountYaw (rad).
/// - The point that the reference follows is at leverArm (m, ahead and to the left) of the base.
/// - True distances are distanceScale times those of the odometry, and true turns turnScale times those of the odometry.
#[derive(Serialize, Tsify)]
#[serde(rename_all = "camelCase")]
#[tsify(missing_as_null)]
pub struct SystematicErrors {
    clock_offset: SystematicValue<Option<f64>, Option<[f64; 2]>>,
    mount_yaw: SystematicValue<Option<f64>, Option<[f64; 2]>>,
    lever_arm: SystematicValue<[Option<f64>; 2], [Option<[f64; 2]>; 2]>,
    distance_scale: SystematicValue<Option<f64>, Option<[f64; 2]>>,
    turn_scale: SystematicValue<Option<f64>, Option<[f64; 2]>>,
}

/// Noise of the reference log: standard deviations of each coordinate (m) and of the heading (rad).
#[derive(Serialize, Tsify)]
#[serde(rename_all = "camelCase")]
pub struct ReferenceNoise {
    position_std: Estimate,
    yaw_std: Estimate,
}

/// Result of a calibration, without its legs.
#[derive(Serialize, Tsify)]
#[serde(rename_all = "camelCase")]
#[tsify(missing_as_null)]
pub struct CalibrationStats<'a> {
    /// Fitted α's; null for an α that the log does not identify.
    alphas: &'a [Option<f64>],
    /// 95 % intervals by the profile likelihood. They are widened if the errors of neighbouring legs are correlated.
    intervals: &'a [Option<[f64; 2]>],
    /// Reason why the log does not identify an α; null for an identified α.
    not_identifiable: &'a [Option<NotIdentifiable>],
    systematic_errors: SystematicErrors,
    reference_noise: ReferenceNoise,
    persistence: Persistence,
    /// Parts of the log from which no legs are made, by cause.
    lost: LostLegs,
    /// Restricted log-likelihood of the residuals (REML), nats.
    log_likelihood: f64,
    diagnostics: &'a Diagnostics,
    /// Recommended α's for a filter: the fitted α's times an inflation (1 or more), with which the model covers 95 % of the pose errors
    /// over held-out stretches of 1 m. Null if the log is unusable.
    recommended: Option<&'a Recommendation>,
}

pub fn calibration_to_js(calibration: &Calibration) -> JsValue {
    let [position_std, yaw_std] = calibration.reference_noise;
    to_plain_js(&CalibrationStats {
        alphas: &calibration.alphas,
        intervals: &calibration.intervals,
        not_identifiable: &calibration.not_identifiable,
        systematic_errors: systematic_errors(calibration),
        reference_noise: ReferenceNoise { position_std, yaw_std },
        persistence: calibration.persistence,
        lost: calibration.lost,
        log_likelihood: calibration.log_likelihood,
        diagnostics: &calibration.diagnostics,
        recommended: calibration.recommended.as_ref(),
    })
}

fn systematic_errors(calibration: &Calibration) -> SystematicErrors {
    let Calibration { systematic, systematic_stds, is_constant, is_corrected, .. } = calibration;
    let optional_value =
        |error: SystematicError| systematic_stds[error as usize].map(|_| systematic.get(error));
    let scalar_value_of = |error: SystematicError| SystematicValue {
        value: optional_value(error),
        interval: calibration.interval_of(error),
        constant: is_constant[error as usize],
        corrected: is_corrected[error as usize],
    };
    let lever_arm = [SystematicError::LeverArmAhead, SystematicError::LeverArmLeft];
    let has_any =
        |error_flags: &[bool; ERROR_COUNT]| lever_arm.iter().any(|error| error_flags[*error as usize]);
    SystematicErrors {
        clock_offset: scalar_value_of(SystematicError::ClockOffset),
        mount_yaw: scalar_value_of(SystematicError::MountYaw),
        lever_arm: SystematicValue {
            value: lever_arm.map(optional_value),
            interval: lever_arm.map(|error| calibration.interval_of(error)),
            constant: has_any(is_constant),
            corrected: has_any(is_corrected),
        },
        distance_scale: scalar_value_of(SystematicError::DistanceScale),
        turn_scale: scalar_value_of(SystematicError::TurnScale),
    }
}

js_structs! {
    /// Legs of a calibration as columns of numbers. A column has one or several numbers for each leg, leg after leg.
    #[derive(Default)]
    pub struct CalibrationLegs {
        pub count: usize,
        /// Start and end times of each leg, s.
        pub times: Vec<f64> as "Float64Array",
        /// Poses x, y, θ at the start and the end of each leg, in the odometry frame.
        pub odometry: Vec<f64> as "Float64Array",
        /// Poses x, y, θ of the robot's base at the start and the end of each leg, by the reference.
        pub reference: Vec<f64> as "Float64Array",
        /// Odometry readings rot1, trans, rot2; or commands v, ω, Δt.
        pub readings: Vec<f64> as "Float64Array",
        /// Executed minus expected value of each noise component; NaN if the leg does not determine the component.
        pub residuals: Vec<f64> as "Float64Array",
        /// Innovations divided by their standard deviations.
        pub standardized: Vec<f64> as "Float64Array",
        /// Standard deviations of the innovations.
        pub stds: Vec<f64> as "Float64Array",
        /// Squared Mahalanobis distance of the innovation of each leg.
        pub squared: Vec<f64> as "Float64Array",
        /// Flag of each leg: 1 for an outlier, otherwise 0.
        pub outliers: Vec<f64> as "Float64Array",
    }
}

pub fn legs_to_js(calibration: &Calibration) -> JsValue {
    let Calibration { legs, observations: leg_observations, leg_fits, corrected, .. } = calibration;
    let mut leg_columns = CalibrationLegs { count: legs.len(), ..Default::default() };
    let base_trajectory = corrected.base();
    for ((calibrated_leg, leg_observation), leg_fit) in legs.iter().zip(leg_observations).zip(leg_fits) {
        leg_columns.times.extend_from_slice(&calibrated_leg.times);
        for end_index in [0, 1] {
            leg_columns.odometry.extend(<[f64; 3]>::from(calibrated_leg.odometry[end_index]));
            leg_columns
                .reference
                .extend(<[f64; 3]>::from(calibrated_leg.reference[end_index] * base_trajectory));
        }
        leg_columns.readings.extend_from_slice(&leg_observation.reading);
        leg_columns.residuals.extend_from_slice(&leg_observation.residuals);
        leg_columns.standardized.extend_from_slice(&leg_fit.standardized);
        leg_columns.stds.extend_from_slice(&leg_fit.stds);
        leg_columns.squared.push(leg_fit.squared);
        leg_columns.outliers.push(f64::from(u8::from(leg_fit.is_outlier)));
    }
    to_plain_js(&leg_columns)
}
