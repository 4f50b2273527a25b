//! `motion.calibrate` for JavaScript: logs in, α's out.

use super::calibration::{SYSTEMATIC, calibration_to_js, columns_to_js};
use super::fields::{Fields, boolean, in_range, number, type_error, whole, word};
use super::log::{read_odometry, read_reference};
use crate::calibrate::{ERRORS, LegLength, Model, Options, ReferenceError, Robust, Which, calibrate};
use crate::models::OdometryRule;
use crate::noise::NoiseKind;
use crate::sim::alpha_calibrator::Model as Asked;
use crate::sim::settings::MAX_SEED;
use js_sys::RangeError;
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** The names of what may be wrong with every leg in the same way. */
export type SystematicError = 'clockOffset' | 'mountYaw' | 'leverArm' | 'distanceScale' | 'turnScale';

/** What `calibrate` is asked. */
export interface CalibrationOptions {
  odometry: LoggedPoses | LoggedCommands;
  reference: LoggedReference;
  /** Whose α's: four of odometry, five of a robot that can drive sideways, six of commands. Opens with "odometry". */
  model?: 'odometry' | 'omnidirectional' | 'velocity';
  /** Whose bookkeeping of the odometry; "omni" is that of the omnidirectional model. Opens with "table". */
  rule?: 'table' | 'nav2' | 'beluga' | 'omni';
  /** Where a leg ends: as AMCL's `update_min_d` (m) and `update_min_a` (rad), 0.25 and 0.2 unless said, or after a duration (s). */
  legs?: { distance?: number; angle?: number } | { duration: number };
  /** Opens with "normal". */
  noise?: 'normal' | 'triangular';
  /** Whether legs may be bad, as where a reference jumps: a share of them that is estimated, or stated. Opens with false. */
  robust?: boolean | { outliers: number };
  /** Which systematic errors are removed; those left out are. Opens with true, for all. */
  systematic?: boolean | { [name in SystematicError]?: boolean };
  /** Of the bootstrap, a whole number; opens with 0. */
  seed?: number;
  /**
   * Whether the α's of other lengths of legs are told too. Opens with false: legs a quarter as long are four times as many,
   * and with all of them it takes up to three times as long.
   */
  byLength?: boolean;
}
"#;

/// Lengths of legs, m, rad or s.
const LEG: RangeInclusive<f64> = 1e-6..=1e6;

/// The likeliest α's of a robot, from where its odometry (or its commands) and a reference say that it was: legs as the filter
/// sees them, systematic errors found and removed first, 95 % intervals, and what there is to doubt. `doc/calibration.md` has the
/// method.
#[wasm_bindgen(js_name = calibrate, unchecked_return_type = "Calibration")]
pub fn calibrated(
    #[wasm_bindgen(unchecked_param_type = "CalibrationOptions")] options: &JsValue,
) -> Result<JsValue, JsValue> {
    const KEYS: [&str; 10] = [
        "odometry",
        "reference",
        "model",
        "rule",
        "legs",
        "noise",
        "robust",
        "systematic",
        "seed",
        "byLength",
    ];
    let fields = Fields::new("options", "", options, &KEYS)?;
    let options = Options {
        model: model(&fields)?,
        legs: fields.optional("legs", legs)?.unwrap_or(LegLength::AMCL),
        noise: fields.optional("noise", word)?.unwrap_or(NoiseKind::Normal),
        robust: fields.optional("robust", robust)?.unwrap_or_default(),
        remove: fields.optional("systematic", removed)?.unwrap_or([true; ERRORS]),
        reference_error: ReferenceError::default(),
        seed: fields
            .optional("seed", |field, value| whole(field, number(field, value)?, 0..=MAX_SEED))?
            .unwrap_or(0),
        by_length: fields.optional("byLength", boolean)?.unwrap_or(false),
    };
    let odometry = read_odometry("odometry", &fields.value("odometry")?)?;
    let (reference, reference_error) = read_reference("reference", &fields.value("reference")?)?;
    let options = Options { reference_error, ..options };
    let calibration =
        calibrate(&odometry, &reference, &options).map_err(|error| RangeError::new(&error.to_string()))?;
    let gaps = [odometry.gaps(), reference.gaps()];
    Ok(calibration_to_js(&calibration, options.remove, gaps, Some(columns_to_js(&calibration))))
}

fn model(fields: &Fields) -> Result<Model, JsValue> {
    let asked: Option<Asked> = fields.optional("model", word)?;
    let rule: Option<OdometryRule> = fields.optional("rule", word)?;
    let is_omni = rule == Some(OdometryRule::Omni);
    let fits = match asked {
        None => true,
        Some(Asked::Odometry) => !is_omni,
        Some(Asked::Omnidirectional) => is_omni || rule.is_none(),
        Some(Asked::Velocity) => rule.is_none(),
    };
    if !fits {
        let message = "rule does not go with the model; allowed is table, nav2 or beluga with odometry, omni with omnidirectional, and none with velocity";
        return Err(RangeError::new(message).into());
    }
    Ok(match asked {
        Some(Asked::Velocity) => Model::Velocity,
        Some(Asked::Omnidirectional) => Model::Odometry(OdometryRule::Omni),
        Some(Asked::Odometry) | None => Model::Odometry(rule.unwrap_or(OdometryRule::Table)),
    })
}

fn legs(field: &str, value: &JsValue) -> Result<LegLength, JsValue> {
    let fields = Fields::new(field, "legs.", value, &["distance", "angle", "duration"])?;
    let [distance, angle, duration] = ["distance", "angle", "duration"]
        .map(|key| fields.optional(key, |path, value| in_range(path, number(path, value)?, &LEG)));
    let (distance, angle) = (distance?, angle?);
    match duration? {
        Some(_) if distance.is_some() || angle.is_some() => {
            let message = "legs.duration is given beside a distance or an angle; allowed is one of the two";
            Err(RangeError::new(message).into())
        }
        Some(duration) => Ok(LegLength::Lasted { duration }),
        None => Ok(LegLength::Moved {
            distance: distance.unwrap_or(LegLength::AMCL_DISTANCE),
            angle: angle.unwrap_or(LegLength::AMCL_ANGLE),
        }),
    }
}

fn robust(field: &str, value: &JsValue) -> Result<Robust, JsValue> {
    if let Some(robust) = value.as_bool() {
        return Ok(if robust { Robust::Estimated } else { Robust::No });
    }
    if !value.is_object() {
        return Err(type_error(field, value, "true, false or an object with the key outliers"));
    }
    let fields = Fields::new(field, "robust.", value, &["outliers"])?;
    Ok(Robust::Stated(in_range("robust.outliers", fields.number("outliers")?, &(1e-9..=0.5))?))
}

fn removed(field: &str, value: &JsValue) -> Result<Which, JsValue> {
    if let Some(all) = value.as_bool() {
        return Ok([all; ERRORS]);
    }
    let keys = SYSTEMATIC.map(|(key, _)| key);
    if !value.is_object() {
        let allowed = format!("true, false or an object with keys from {}", keys.join(", "));
        return Err(type_error(field, value, &allowed));
    }
    let fields = Fields::new(field, "systematic.", value, &keys)?;
    let mut remove = [true; ERRORS];
    for (key, errors) in SYSTEMATIC {
        let wanted = fields.optional(key, boolean)?.unwrap_or(true);
        errors.iter().for_each(|error| remove[*error as usize] = wanted);
    }
    Ok(remove)
}
