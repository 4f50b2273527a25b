//! JavaScript function `calibrate`, which computes α's from logs.

use super::calibration::{SYSTEMATIC_ERROR_KEYS, calibration_to_js, legs_to_js};
use super::fields::{FieldReader, read_boolean, read_value, type_error};
use super::log::read_logs;
use crate::calibrate::{ERROR_COUNT, LegLength, Model, Options, Outliers, calibrate};
use crate::models::OdometryRule;
use crate::sim::alpha_calibrator::Model as ModelChoice;
use js_sys::{RangeError, Reflect};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

const LEG_LENGTH_RANGE: RangeInclusive<f64> = 1e-6..=1e6;

const STD_RANGE: RangeInclusive<f64> = 0.0..=1e3;

/// Fits the α's of a robot to logs of its odometry (or its commands) and of a reference. `doc/calibration-method.md` describes the method.
#[wasm_bindgen(js_name = calibrate, unchecked_return_type = "Calibration")]
pub fn js_calibrate(
    #[wasm_bindgen(unchecked_param_type = "CalibrationOptions")] options: &JsValue,
) -> Result<JsValue, JsValue> {
    const KEYS: [&str; 9] =
        ["odometry", "reference", "model", "rule", "legs", "outliers", "correct", "positionStd", "yawStd"];
    let fields = FieldReader::new("options", "", options, &KEYS)?;
    let read_std = |option_key: &str| {
        fields.read_optional(option_key, |field_path, value| read_value(field_path, value, 0.0, STD_RANGE))
    };
    let options = Options {
        model: read_model(&fields)?,
        legs: fields.read_optional("legs", read_leg_length)?.unwrap_or(LegLength::AMCL),
        outliers: fields.read_or("outliers", Outliers::default(), ())?,
        correct: fields.read_optional("correct", read_corrections)?.unwrap_or_default(),
        position_std: read_std("positionStd")?,
        yaw_std: read_std("yawStd")?,
    };
    let drives = read_logs(&fields.value("odometry")?, &fields.value("reference")?)?;
    let calibration = calibrate(&drives, &options).map_err(|error| RangeError::new(&error.to_string()))?;
    let calibration_object = calibration_to_js(&calibration);
    Reflect::set(&calibration_object, &"legs".into(), &legs_to_js(&calibration))?;
    Ok(calibration_object)
}

fn read_model(fields: &FieldReader) -> Result<Model, JsValue> {
    let read_model_name =
        |path: &str, model_name: &JsValue| read_value(path, model_name, ModelChoice::Odometry, ());
    let read_rule = |path: &str, model_name: &JsValue| read_value(path, model_name, OdometryRule::Table, ());
    Ok(match (fields.read_optional("model", read_model_name)?, fields.read_optional("rule", read_rule)?) {
        (None | Some(ModelChoice::Odometry), None) => Model::Odometry(OdometryRule::Table),
        (None, Some(odometry_rule)) => Model::Odometry(odometry_rule),
        (Some(ModelChoice::Odometry), Some(odometry_rule)) if odometry_rule != OdometryRule::Omni => {
            Model::Odometry(odometry_rule)
        }
        (Some(ModelChoice::Omnidirectional), None | Some(OdometryRule::Omni)) => {
            Model::Odometry(OdometryRule::Omni)
        }
        (Some(ModelChoice::Velocity), None) => Model::Velocity,
        _ => {
            let error_message = "rule does not go with the model; allowed is thrun, nav2 or beluga with odometry, omni with omnidirectional, and none with velocity";
            return Err(RangeError::new(error_message).into());
        }
    })
}

fn read_leg_length(field_path: &str, value: &JsValue) -> Result<LegLength, JsValue> {
    let fields = FieldReader::new(field_path, "legs.", value, &["distance", "angle", "duration"])?;
    let [leg_distance, leg_angle, leg_duration] = ["distance", "angle", "duration"].map(|option_key| {
        fields.read_optional(option_key, |path, value| read_value(path, value, 1.0, LEG_LENGTH_RANGE))
    });
    let (leg_distance, leg_angle) = (leg_distance?, leg_angle?);
    match leg_duration? {
        Some(_) if leg_distance.is_some() || leg_angle.is_some() => {
            let error_message =
                "legs.duration is given beside a distance or an angle; allowed is one of the two";
            Err(RangeError::new(error_message).into())
        }
        Some(leg_duration) => Ok(LegLength::Duration { duration: leg_duration }),
        None => Ok(LegLength::Displacement {
            distance: leg_distance.unwrap_or(LegLength::AMCL_DISTANCE),
            angle: leg_angle.unwrap_or(LegLength::AMCL_ANGLE),
        }),
    }
}

fn read_corrections(field_path: &str, value: &JsValue) -> Result<[Option<bool>; ERROR_COUNT], JsValue> {
    if let Some(all_errors) = value.as_bool() {
        return Ok([Some(all_errors); ERROR_COUNT]);
    }
    let error_keys = SYSTEMATIC_ERROR_KEYS.map(|(option_key, _)| option_key);
    if !value.is_object() {
        let allowed_text = format!("true, false or an object with keys from {}", error_keys.join(", "));
        return Err(type_error(field_path, value, &allowed_text));
    }
    let fields = FieldReader::new(field_path, "correct.", value, &error_keys)?;
    let mut should_correct = [None; ERROR_COUNT];
    for (option_key, systematic_errors) in SYSTEMATIC_ERROR_KEYS {
        let is_corrected = fields.read_optional(option_key, read_boolean)?;
        systematic_errors.iter().for_each(|error| should_correct[*error as usize] = is_corrected);
    }
    Ok(should_correct)
}
