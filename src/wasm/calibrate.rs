//! `motion.calibrate` for JavaScript: logs in, α's out.

use super::calibration::{calibration_to_js, legs_to_js};
use super::fields::{
    Fields, boolean, doubles, in_range, item, length, no_memory, number, printed, type_error, whole, word,
};
use crate::calibrate::{
    ERRORS, Error, LegLength, Model, Options, ReferenceError, Robust, Trajectory, TrajectoryError,
    TrajectoryFault, Which, calibrate,
};
use crate::geom::se2::SE2;
use crate::models::OdometryRule;
use crate::noise::NoiseKind;
use crate::sim::settings::{MAX_SEED, Words, check_real};
use js_sys::{Float64Array, RangeError};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** Poses with times, each array of the same length: s, rising; m; m; rad. */
export interface LoggedPoses {
  t: ArrayLike<number>;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  theta: ArrayLike<number>;
  /** The places, rising, of poses before which nothing is known of the way, besides those after a pause: where rows are missing, or it jumps. */
  breaks?: ArrayLike<number>;
}

/** Commands with times, each held until the next: s, rising; m/s; rad/s. */
export interface LoggedCommands {
  t: ArrayLike<number>;
  v: ArrayLike<number>;
  omega: ArrayLike<number>;
  /** As of poses. */
  breaks?: ArrayLike<number>;
}

/** Where the robot really was, in any fixed frame, and how well that is known at one moment. */
export interface LoggedReference extends LoggedPoses {
  /** Standard deviation of each coordinate, m; opens with 0. */
  positionDeviation?: number;
  /** Of the heading, rad; opens with 0. */
  headingDeviation?: number;
}

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
}

/** An interval that holds the true value in 95 of 100 logs. */
export type Interval = [number, number];

/** A systematic error: what the reference says of the odometry. Null where the log does not determine it. */
export interface SystematicValue {
  value: number | null;
  interval: Interval | null;
  /** Whether it was removed before the α's were fitted. */
  removed: boolean;
}

/** The residuals of one kind, each by its standard deviation; bad legs left out. */
export interface KindDoubts {
  name: 'rot1' | 'trans' | 'rot2' | 'strafe' | 'v' | 'omega' | 'gamma';
  count: number;
  /** Of each half of the log by itself, in the mean: of the normal distribution 3, of the triangular 2.4. */
  kurtosis: number;
  /** Of neighbouring legs; the model says 0. */
  autocorrelation: number;
  /** Below this it is in 95 of 100 logs of which the model is true. */
  autocorrelationLimit: number;
  /** At 0.01, 0.02, … 0.99. */
  quantiles: Float64Array;
}

/** What a log says of a robot's α's. */
export interface Calibration {
  /** Null where this log does not determine one. */
  alphas: (number | null)[];
  /** By the profile of the likelihood. */
  intervals: (Interval | null)[];
  /** By a bootstrap of blocks of legs, which does not take them for independent. */
  bootstrap: (Interval | null)[];
  /**
   * Reference's time = odometry's time + clockOffset (s); reference's heading = base's heading + mountYaw (rad); the point that
   * the reference follows is at leverArm (m, ahead and to the left) of the base; true distance = distanceScale × odometry's;
   * true turn = turnScale × odometry's.
   */
  systematic: {
    clockOffset: SystematicValue;
    mountYaw: SystematicValue;
    leverArm: { value: [number | null, number | null]; interval: [Interval | null, Interval | null]; removed: boolean };
    distanceScale: SystematicValue;
    turnScale: SystematicValue;
  };
  legs: CalibrationLegs;
  /** Of the residuals, nats. */
  logLikelihood: number;
  /** The share of bad legs; null where none is taken for bad. */
  outliers: number | null;
  doubts: {
    kinds: KindDoubts[];
    /** The second half of the log by the α's of the first; intervals say where a figure is in 95 of 100 logs of which the model is true. */
    heldOut: { count: number; coverage: number; expected: number; interval: Interval; logLikelihood: number };
    /** The mean of (r/σ)² over the held-out residuals. */
    squaredError: { mean: number; interval: Interval };
    /** Places of the legs that are furthest from what was expected, the worst first. */
    worst: number[];
    verdict: 'few-legs' | 'heavy-tails' | 'correlated' | 'overconfident' | 'lazy' | 'fits';
  };
  /** What α's larger by a factor make of the held-out half: the share inside of 95 % intervals, and nats a leg. */
  inflation: { factors: Float64Array; coverage: Float64Array; logLikelihood: Float64Array };
  /** How often nothing is known of the way, because a trajectory pauses or is said to break: no leg leads across. */
  gaps: { odometry: number; reference: number };
}

/** Legs, one after the other in each array. */
export interface CalibrationLegs {
  count: number;
  /** Beginning and end, s. */
  times: Float64Array;
  /** Both ends in the odometry frame, x, y, θ. */
  odometry: Float64Array;
  /** Both ends of the robot's base by the reference, x, y, θ, without the lever arm and the mount's yaw. */
  reference: Float64Array;
  /** rot1, trans, rot2; or v, ω, Δt. */
  readings: Float64Array;
  /** Executed less expected, of the three kinds in their order; NaN of one that a leg does not tell. */
  residuals: Float64Array;
  /** Their standard deviations under the α's. */
  deviations: Float64Array;
  /** Σ (r/σ)². */
  squaredError: Float64Array;
  /** The probability that the leg is bad. */
  bad: Float64Array;
}
"#;

/// Samples of a trajectory at most: a day at 100 Hz.
const MAX_ROWS: usize = 10_000_000;

/// Times, s: those of any clock.
const TIME: RangeInclusive<f64> = -1e12..=1e12;

/// Coordinates, m, and what else a log has: those of any map of a country.
const COORDINATE: RangeInclusive<f64> = -1e9..=1e9;

/// Lengths of legs, m, rad or s.
pub const LEG: RangeInclusive<f64> = 1e-6..=1e6;

/// Whose α's are asked for.
#[derive(Clone, Copy, PartialEq)]
enum Asked {
    Odometry,
    Omnidirectional,
    Velocity,
}

impl Words for Asked {
    const WORDS: &'static [(&'static str, Self)] = &[
        ("odometry", Self::Odometry),
        ("omnidirectional", Self::Omnidirectional),
        ("velocity", Self::Velocity),
    ];
}

/// The likeliest α's of a robot, from where its odometry (or its commands) and a reference say that it was: legs as the filter
/// sees them, systematic errors found and removed first, 95 % intervals, and what there is to doubt. `doc/calibration.md` has the
/// method.
#[wasm_bindgen(js_name = calibrate, unchecked_return_type = "Calibration")]
pub fn calibrated(
    #[wasm_bindgen(unchecked_param_type = "CalibrationOptions")] options: &JsValue,
) -> Result<JsValue, JsValue> {
    const KEYS: [&str; 9] =
        ["odometry", "reference", "model", "rule", "legs", "noise", "robust", "systematic", "seed"];
    let fields = Fields::new("options", "", options, &KEYS)?;
    let options = Options {
        model: model(&fields)?,
        legs: fields.optional("legs", legs)?.unwrap_or(LegLength::AMCL),
        noise: fields.optional("noise", word)?.unwrap_or(NoiseKind::Normal),
        robust: fields.optional("robust", robust)?.unwrap_or_default(),
        remove: fields.optional("systematic", removed)?.unwrap_or([true; ERRORS]),
        reference_error: ReferenceError::default(),
        seed: fields.optional("seed", |field, value| whole(field, value, 0..=MAX_SEED))?.unwrap_or(0),
    };
    let odometry = read_odometry("odometry", &fields.value("odometry")?)?;
    let (reference, reference_error) = read_reference("reference", &fields.value("reference")?)?;
    let options = Options { reference_error, ..options };
    let calibration =
        calibrate(&odometry, &reference, &options).map_err(|error| RangeError::new(&error.to_string()))?;
    let gaps = [odometry.gaps(), reference.gaps()];
    let legs = legs_to_js(&calibration)?;
    calibration_to_js(&calibration, options.remove, gaps, legs)
}

fn model(fields: &Fields) -> Result<Model, JsValue> {
    let asked = fields.optional("model", word)?.unwrap_or(Asked::Odometry);
    let rule: Option<OdometryRule> = fields.optional("rule", word)?;
    let fits = match asked {
        Asked::Velocity => rule.is_none(),
        Asked::Omnidirectional => rule.is_none_or(|rule| rule == OdometryRule::Omni),
        Asked::Odometry => true,
    };
    if !fits {
        let message =
            "rule is given beside a model that has its own; allowed is a rule of the odometry model";
        return Err(RangeError::new(message).into());
    }
    Ok(match asked {
        Asked::Odometry => Model::Odometry(rule.unwrap_or(OdometryRule::Table)),
        Asked::Omnidirectional => Model::Odometry(OdometryRule::Omni),
        Asked::Velocity => Model::Velocity,
    })
}

fn legs(field: &str, value: &JsValue) -> Result<LegLength, JsValue> {
    let fields = Fields::new(field, "legs.", value, &["distance", "angle", "duration"])?;
    let [distance, angle, duration] = ["distance", "angle", "duration"]
        .map(|key| fields.optional(key, |path, value| in_range(path, value, &LEG)));
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
    Ok(Robust::Stated(in_range("robust.outliers", &fields.value("outliers")?, &(1e-9..=0.5))?))
}

/// What each systematic error is called, and which of [`Error::ALL`] it is.
pub const SYSTEMATIC: [(&str, &[Error]); 5] = [
    ("clockOffset", &[Error::ClockOffset]),
    ("mountYaw", &[Error::MountYaw]),
    ("leverArm", &[Error::LeverArmAhead, Error::LeverArmLeft]),
    ("distanceScale", &[Error::DistanceScale]),
    ("turnScale", &[Error::TurnScale]),
];

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

/// Poses or commands.
pub fn read_odometry(field: &str, value: &JsValue) -> Result<Trajectory, JsValue> {
    let prefix = format!("{field}.");
    if !value.is_object() {
        let allowed = "an object with keys from t, x, y, theta, breaks or from t, v, omega, breaks";
        return Err(type_error(field, value, allowed));
    }
    let fields = Fields::open(field, &prefix, value)?;
    if fields.value("v")?.is_undefined() && fields.value("omega")?.is_undefined() {
        return poses(&Fields::new(field, &prefix, value, &["t", "x", "y", "theta", "breaks"])?);
    }
    let fields = Fields::new(field, &prefix, value, &["t", "v", "omega", "breaks"])?;
    let columns = columns(&fields, ["t", "v", "omega"])?;
    let [t, v, omega] = &columns;
    let commands = t.iter().zip(v).zip(omega).map(|((t, v), omega)| (*t, *v, *omega));
    trajectory(&fields, Trajectory::from_commands(commands))
}

/// Poses, and how well they are known.
pub fn read_reference(field: &str, value: &JsValue) -> Result<(Trajectory, ReferenceError), JsValue> {
    let prefix = format!("{field}.");
    let keys = ["t", "x", "y", "theta", "breaks", "positionDeviation", "headingDeviation"];
    let fields = Fields::new(field, &prefix, value, &keys)?;
    let deviation = |key: &str| fields.optional(key, |path, value| in_range(path, value, &(0.0..=1e3)));
    let error = ReferenceError {
        position: deviation("positionDeviation")?.unwrap_or(0.0),
        heading: deviation("headingDeviation")?.unwrap_or(0.0),
    };
    Ok((poses(&fields)?, error))
}

fn poses(fields: &Fields) -> Result<Trajectory, JsValue> {
    let columns = columns(fields, ["t", "x", "y", "theta"])?;
    let [t, x, y, theta] = &columns;
    let poses = x.iter().zip(y).zip(theta).map(|((x, y), theta)| SE2::new(*x, *y, *theta));
    trajectory(fields, Trajectory::new(t.iter().copied().zip(poses)))
}

/// With its breaks. Errors are in the words of [`TrajectoryError`], whose numbers Rust would print: that is a twentieth of a module.
fn trajectory(fields: &Fields, read: Result<Trajectory, TrajectoryError>) -> Result<Trajectory, JsValue> {
    let read = read.map_err(|TrajectoryError { sample, fault }| {
        let what = match fault {
            TrajectoryFault::NotFinite => {
                "has a time or a coordinate that is not finite; allowed are finite numbers".to_owned()
            }
            TrajectoryFault::NotLater { before } => {
                let before = printed(before);
                format!("is not later than the one before, at {before} s; allowed are times that rise")
            }
        };
        let field = fields.path("");
        JsValue::from(RangeError::new(&format!("{}: sample {sample} {what}", field.trim_end_matches('.'))))
    })?;
    broken(fields, read)
}

/// With gaps where the caller says that there are some.
fn broken(fields: &Fields, mut trajectory: Trajectory) -> Result<Trajectory, JsValue> {
    let (field, breaks) = (fields.path("breaks"), fields.value("breaks")?);
    if breaks.is_undefined() {
        return Ok(trajectory);
    }
    let (last, mut before) = (trajectory.samples().len() - 1, 0);
    for i in 0..length(&field, &breaks, "an array of numbers")? {
        let item = item(&field, &breaks, i)?;
        let sample = item.as_f64().map_or(0, |number| number as usize);
        if sample <= before || sample > last || item.as_f64() != Some(sample as f64) {
            let path = format!("{field}[{i}]");
            whole(&path, &item, 1..=last as u64)?;
            let message = format!("{path} is {sample}; allowed is more than {before}, the one before it");
            return Err(RangeError::new(&message).into());
        }
        trajectory = trajectory.broken_before([sample]);
        before = sample;
    }
    Ok(trajectory)
}

/// Arrays of numbers, as long as the first of them, which has times.
fn columns<const N: usize>(fields: &Fields, keys: [&str; N]) -> Result<[Vec<f64>; N], JsValue> {
    let mut columns = [const { Vec::new() }; N];
    for (i, key) in keys.into_iter().enumerate() {
        let (path, value) = (fields.path(key), fields.value(key)?);
        let expected = "an array of numbers";
        let rows = length(&path, &value, expected)?;
        let allowed = if i == 0 { 2..=MAX_ROWS } else { columns[0].len()..=columns[0].len() };
        if !allowed.contains(&rows) {
            let allowed = if i == 0 {
                format!("2 to {MAX_ROWS}")
            } else {
                format!("{}, as of {}", columns[0].len(), fields.path(keys[0]))
            };
            return Err(RangeError::new(&format!("{path} has length {rows}; allowed is {allowed}")).into());
        }
        columns[i] = column(&path, &value, rows)?;
        for (row, number) in columns[i].iter().enumerate() {
            let range = if i == 0 { &TIME } else { &COORDINATE };
            if !range.contains(number) {
                check_real(&format!("{path}[{row}]"), *number, range)?;
            }
        }
    }
    Ok(columns)
}

fn column(path: &str, value: &JsValue, rows: usize) -> Result<Vec<f64>, JsValue> {
    if value.is_instance_of::<Float64Array>() {
        return doubles(path, value, rows);
    }
    let mut column = Vec::new();
    column.try_reserve_exact(rows).map_err(|_| no_memory(&format!("{path}.length")))?;
    for row in 0..rows {
        let item = item(path, value, row)?;
        column.push(match item.as_f64() {
            Some(number) => number,
            None => number(&format!("{path}[{row}]"), &item)?,
        });
    }
    Ok(column)
}
