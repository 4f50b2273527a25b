//! Logs of JavaScript: odometry and reference.

use super::fields::{Fields, doubles, in_range, item, length, no_memory, number, printed};
use crate::calibrate::{ReferenceError, Trajectory, TrajectoryError, TrajectoryFault};
use crate::geom::se2::SE2;
use crate::sim::settings::check_real;
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
}

/** Commands with times, each held until the next: s, rising; m/s; rad/s. */
export interface LoggedCommands {
  t: ArrayLike<number>;
  v: ArrayLike<number>;
  omega: ArrayLike<number>;
}

/** Where the robot really was, in any fixed frame, and how well that is known at one moment. */
export interface LoggedReference extends LoggedPoses {
  /** Standard deviation of each coordinate, m; opens with 0. */
  positionDeviation?: number;
  /** Of the heading, rad; opens with 0. */
  headingDeviation?: number;
}
"#;

/// Samples of a trajectory at most: a day at 100 Hz.
const MAX_ROWS: usize = 10_000_000;

/// Times, s: those of any clock.
const TIME: RangeInclusive<f64> = -1e12..=1e12;

/// Coordinates, m, and what else a log has: those of any map of a country.
const COORDINATE: RangeInclusive<f64> = -1e9..=1e9;

/// Poses or commands.
pub fn read_odometry(field: &str, value: &JsValue) -> Result<Trajectory, JsValue> {
    let prefix = format!("{field}.");
    let fields = Fields::open(field, &prefix, value)?;
    if fields.value("v")?.is_undefined() && fields.value("omega")?.is_undefined() {
        return poses(&Fields::new(field, &prefix, value, &["t", "x", "y", "theta"])?);
    }
    let fields = Fields::new(field, &prefix, value, &["t", "v", "omega"])?;
    let columns = columns(&fields, ["t", "v", "omega"])?;
    let [t, v, omega] = &columns;
    let commands = t.iter().zip(v).zip(omega).map(|((t, v), omega)| (*t, *v, *omega));
    trajectory(field, Trajectory::from_commands(commands))
}

/// Poses, and how well they are known.
pub fn read_reference(field: &str, value: &JsValue) -> Result<(Trajectory, ReferenceError), JsValue> {
    let prefix = format!("{field}.");
    let keys = ["t", "x", "y", "theta", "positionDeviation", "headingDeviation"];
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
    trajectory(fields.path("").trim_end_matches('.'), Trajectory::new(t.iter().copied().zip(poses)))
}

/// In the words of [`TrajectoryError`], whose numbers Rust would print: that is a twentieth of a module.
fn trajectory(field: &str, read: Result<Trajectory, TrajectoryError>) -> Result<Trajectory, JsValue> {
    read.map_err(|TrajectoryError { sample, fault }| {
        let what = match fault {
            TrajectoryFault::NotFinite => {
                "has a time or a coordinate that is not finite; allowed are finite numbers".to_owned()
            }
            TrajectoryFault::NotLater { before } => {
                let before = printed(before);
                format!("is not later than the one before, at {before} s; allowed are times that rise")
            }
        };
        RangeError::new(&format!("{field}: sample {sample} {what}")).into()
    })
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
