//! Calibrations as plain JavaScript values.

use super::values::{float_array, js_array, js_object, number_or_null, to_plain_js};
use crate::calibrate::{
    Calibration, Check, ErrorMask, Estimate, NotIdentifiable, Recommendation, SystematicError, Verdict,
};
use js_sys::Array;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPESCRIPT_TYPES: &str = r#"
/** A 95 % confidence interval: it contains the true value in 95 of 100 logs. */
export type Interval = [number, number];

/** A systematic error. Null where the log does not identify it. */
export interface SystematicValue {
  value: number | null;
  interval: Interval | null;
  /**
   * True if the error is the same on straight and turning legs, and in both halves of the log; only scales are
   * compared.
   */
  constant: boolean;
  /** True if the error was corrected before the α's were fitted. */
  corrected: boolean;
}

/** One check of a calibration. */
export interface CalibrationCheck {
  name:
    | 'reference-matches' | 'enough-legs' | 'legs-lost' | 'sampling-dense' | 'outliers-few' | 'sideways-rare'
    | 'distance-scale-constant' | 'turn-scale-constant' | 'inflation-bounded' | 'residuals-uncorrelated' | 'tails-normal'
    | 'holdout-covered' | 'window-1m-covered' | 'window-2m-covered' | 'window-5m-covered';
  value: number;
  /** Smallest and largest value that passes; ±Infinity where there is no bound. */
  expected: Interval;
  passed: boolean;
  /** Meaning of the value for the α's, and what to do; empty if the check passed. */
  message: string;
}

/** Result of a calibration. */
export interface Calibration {
  /** Fitted α's. Null where the log does not identify one. */
  alphas: (number | null)[];
  /** 95 % intervals by the profile likelihood, wider where the errors of neighbouring legs are correlated. */
  intervals: (Interval | null)[];
  /** Why the log does not identify an α; null where it does. */
  notIdentifiable: ('insufficient-rotation' | 'insufficient-translation' | 'reference-too-noisy' | 'collinear' | null)[];
  /**
   * Reference's time = odometry's time + clockOffset (s); reference's heading = base's heading + mountYaw (rad); the point that
   * the reference follows is at leverArm (m, ahead and to the left) of the base; true distance = distanceScale × odometry's;
   * true turn = turnScale × odometry's.
   */
  systematicErrors: {
    clockOffset: SystematicValue;
    mountYaw: SystematicValue;
    leverArm: Omit<SystematicValue, 'value' | 'interval'> & { value: [number | null, number | null]; interval: [Interval | null, Interval | null] };
    distanceScale: SystematicValue;
    turnScale: SystematicValue;
  };
  /** Standard deviations of the reference: each coordinate (m) and heading (rad). */
  referenceNoise: { positionStd: Estimate; yawStd: Estimate };
  /** Correlation of the wheels' errors in neighbouring legs, 0 for independent errors, and the distance (m) over which it falls to 1/e. */
  persistence: { correlation: Estimate; length: number };
  legs: CalibrationLegs;
  /** Legs that the log does not give, by cause. */
  lost: { withoutReference: number; acrossBreaks: number; acrossPauses: number; standing: number };
  /** Restricted log-likelihood of the residuals, nats. */
  logLikelihood: number;
  diagnostics: {
    verdict: 'consistent' | 'questionable' | 'unusable';
    checks: CalibrationCheck[];
    windows: WindowCoverage[];
  };
  /** α's for a filter: the fitted ones times the inflation under which held-out windows of 1 m are covered. Null where the log is unusable. */
  recommended: { alphas: (number | null)[]; inflation: number; reason: string } | null;
}

/** Legs, one after the other in each array. */
export interface CalibrationLegs {
  count: number;
  /** Start and end, s. */
  times: Float64Array;
  /** Both ends in the odometry frame, x, y, θ. */
  odometry: Float64Array;
  /** Both ends of the robot's base by the reference, x, y, θ. */
  reference: Float64Array;
  /** rot1, trans, rot2; or v, ω, Δt. */
  readings: Float64Array;
  /** Executed minus expected value of each noise component; NaN if the leg does not determine the component. */
  residuals: Float64Array;
  /** Innovations over their standard deviations. */
  standardized: Float64Array;
  /** Standard deviations of the innovations. */
  stds: Float64Array;
  /** Squared Mahalanobis distance of the innovation. */
  squared: Float64Array;
  /** 1 for an outlier, otherwise 0. */
  outliers: Float64Array;
}
"#;

/// Name of each systematic error, and its members of [`SystematicError::ALL`].
pub const SYSTEMATIC_ERROR_KEYS: [(&str, &[SystematicError]); 5] = [
    ("clockOffset", &[SystematicError::ClockOffset]),
    ("mountYaw", &[SystematicError::MountYaw]),
    ("leverArm", &[SystematicError::LeverArmAhead, SystematicError::LeverArmLeft]),
    ("distanceScale", &[SystematicError::DistanceScale]),
    ("turnScale", &[SystematicError::TurnScale]),
];

/// Makes an object of a calibration, with its legs where they are given.
pub fn calibration_to_js(calibration: &Calibration, legs: Option<JsValue>) -> Result<JsValue, JsValue> {
    let Calibration { not_identifiable, reference_noise, persistence, diagnostics, recommended, .. } =
        calibration;
    let reasons: Array = not_identifiable.iter().map(|reason| reason_keyword(*reason)).collect();
    let [position, yaw] = reference_noise.map(|estimate| estimate_to_js(&estimate));
    let checks: Array = diagnostics.checks.iter().map(check_to_js).collect::<Result<_, _>>()?;
    let entries = [
        ("alphas", alphas_to_js(&calibration.alphas)),
        ("intervals", intervals_to_js(&calibration.intervals)),
        ("notIdentifiable", reasons.into()),
        ("systematicErrors", systematic_to_js(calibration)),
        ("referenceNoise", js_object(&[("positionStd", position), ("yawStd", yaw)])),
        (
            "persistence",
            js_object(&[
                ("correlation", estimate_to_js(&persistence.correlation)),
                ("length", persistence.length.into()),
            ]),
        ),
        ("lost", to_plain_js(&calibration.lost)?),
        ("logLikelihood", calibration.log_likelihood.into()),
        (
            "diagnostics",
            js_object(&[
                ("verdict", verdict_keyword(diagnostics.verdict).into()),
                ("checks", checks.into()),
                ("windows", to_plain_js(&diagnostics.windows)?),
            ]),
        ),
        ("recommended", recommended.as_ref().map_or(JsValue::NULL, recommended_to_js)),
    ];
    Ok(js_object(&entries.into_iter().chain(legs.map(|legs| ("legs", legs))).collect::<Vec<_>>()))
}

fn alphas_to_js(alphas: &[Option<f64>]) -> JsValue {
    alphas.iter().map(|alpha| number_or_null(*alpha)).collect::<Array>().into()
}

fn interval_to_js(interval: Option<[f64; 2]>) -> JsValue {
    interval.map_or(JsValue::NULL, |interval| js_array(&interval))
}

fn intervals_to_js(intervals: &[Option<[f64; 2]>]) -> JsValue {
    intervals.iter().map(|interval| interval_to_js(*interval)).collect::<Array>().into()
}

fn estimate_to_js(Estimate { value, interval }: &Estimate) -> JsValue {
    js_object(&[("value", (*value).into()), ("interval", js_array(interval))])
}

fn reason_keyword(reason: Option<NotIdentifiable>) -> JsValue {
    reason.map_or(JsValue::NULL, |reason| {
        let keyword = match reason {
            NotIdentifiable::InsufficientRotation => "insufficient-rotation",
            NotIdentifiable::InsufficientTranslation => "insufficient-translation",
            NotIdentifiable::ReferenceTooNoisy => "reference-too-noisy",
            NotIdentifiable::Collinear => "collinear",
        };
        keyword.into()
    })
}

fn systematic_to_js(calibration: &Calibration) -> JsValue {
    let estimate_of = |error: SystematicError| {
        let is_identified = calibration.systematic_stds[error as usize].is_some();
        number_or_null(is_identified.then(|| calibration.systematic.get(error)))
    };
    let interval_of_error = |error: SystematicError| interval_to_js(calibration.interval_of(error));
    let has_any =
        |mask: &ErrorMask, errors: &[SystematicError]| errors.iter().any(|error| mask[*error as usize]);
    let error_entries = SYSTEMATIC_ERROR_KEYS.iter().map(|(key, errors)| {
        let [value, interval] = match errors {
            [error] => [estimate_of(*error), interval_of_error(*error)],
            errors => [
                errors.iter().map(|error| estimate_of(*error)).collect::<Array>().into(),
                errors.iter().map(|error| interval_of_error(*error)).collect::<Array>().into(),
            ],
        };
        let constant = has_any(&calibration.is_constant, errors).into();
        let corrected = has_any(&calibration.is_corrected, errors).into();
        let entries =
            [("value", value), ("interval", interval), ("constant", constant), ("corrected", corrected)];
        (*key, js_object(&entries))
    });
    js_object(&error_entries.collect::<Vec<_>>())
}

fn verdict_keyword(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Consistent => "consistent",
        Verdict::Questionable => "questionable",
        Verdict::Unusable => "unusable",
    }
}

fn check_to_js(check: &Check) -> Result<JsValue, JsValue> {
    Ok(js_object(&[
        ("name", to_plain_js(&check.name)?),
        ("value", check.value.into()),
        ("expected", js_array(&check.expected)),
        ("passed", check.passed.into()),
        ("message", check.message().into()),
    ]))
}

fn recommended_to_js(
    Recommendation { alphas: recommended_alphas, inflation, reason }: &Recommendation,
) -> JsValue {
    js_object(&[
        ("alphas", alphas_to_js(recommended_alphas)),
        ("inflation", (*inflation).into()),
        ("reason", reason.as_str().into()),
    ])
}

/// Makes arrays of the legs of a calibration, one leg after the other in each.
pub fn columns_to_js(calibration: &Calibration) -> JsValue {
    let Calibration { legs, observations, leg_fits, corrected, .. } = calibration;
    let empty_column = |width: usize| Vec::with_capacity(width * legs.len());
    let [mut times, mut odometry, mut reference] = [2, 6, 6].map(empty_column);
    let [mut readings, mut residuals, mut standardized, mut stds] = [3; 4].map(empty_column);
    let [mut squared_distances, mut outliers] = [1; 2].map(empty_column);
    let base = corrected.base();
    for ((leg, observation), fit) in legs.iter().zip(observations).zip(leg_fits) {
        times.extend_from_slice(&leg.times);
        for [read, pose] in [0, 1].map(|end| [leg.odometry[end], leg.reference[end] * base]) {
            odometry.extend_from_slice(&<[f64; 3]>::from(read));
            reference.extend_from_slice(&<[f64; 3]>::from(pose));
        }
        readings.extend_from_slice(&observation.reading);
        residuals.extend_from_slice(&observation.residuals);
        standardized.extend_from_slice(&fit.standardized);
        stds.extend_from_slice(&fit.stds);
        squared_distances.push(fit.squared);
        outliers.push(f64::from(u8::from(fit.is_outlier)));
    }
    js_object(&[
        ("count", (legs.len() as f64).into()),
        ("times", float_array(&times)),
        ("odometry", float_array(&odometry)),
        ("reference", float_array(&reference)),
        ("readings", float_array(&readings)),
        ("residuals", float_array(&residuals)),
        ("standardized", float_array(&standardized)),
        ("stds", float_array(&stds)),
        ("squared", float_array(&squared_distances)),
        ("outliers", float_array(&outliers)),
    ])
}
