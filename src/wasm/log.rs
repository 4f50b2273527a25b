//! Reader of the logs that JavaScript passes: odometry and reference.

use super::fields::{FieldReader, array_item, array_length, read_integer, read_number};
use crate::calibrate::{Drive, Trajectory, TrajectoryError};
use crate::geom::se2::SE2;
use crate::sim::settings::check_real;
use js_sys::{Float64Array, RangeError};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

/// Maximum number of samples of a trajectory: a day at 100 Hz.
const MAX_ROWS: usize = 10_000_000;

const TIME_RANGE: RangeInclusive<f64> = -1e12..=1e12;

/// Range of coordinates (m) and other numbers of a log. It includes the coordinates of any national map grid.
const COORDINATE_RANGE: RangeInclusive<f64> = -1e9..=1e9;

/// Reads odometry and reference of one drive, or arrays with the logs of several drives.
pub fn read_logs(odometry_value: &JsValue, reference_value: &JsValue) -> Result<Vec<Drive>, JsValue> {
    let odometry_drives = read_drives("odometry", odometry_value, read_odometry)?;
    let reference_drives = read_drives("reference", reference_value, read_poses)?;
    let [odometry_count, reference_count] = [odometry_drives.len(), reference_drives.len()];
    if odometry_count != reference_count {
        let error_message = format!(
            "reference has {reference_count} drives; allowed is one for each of the {odometry_count} of odometry"
        );
        return Err(RangeError::new(&error_message).into());
    }
    Ok(odometry_drives
        .into_iter()
        .zip(reference_drives)
        .map(|(odometry, reference)| Drive { odometry, reference })
        .collect())
}

fn read_drives(
    field_path: &str,
    value: &JsValue,
    read_drive: fn(&str, &JsValue) -> Result<Trajectory, JsValue>,
) -> Result<Vec<Trajectory>, JsValue> {
    if !js_sys::Array::is_array(value) {
        return Ok(vec![read_drive(field_path, value)?]);
    }
    let drive_count = array_length(field_path, value, "an array of drives")?;
    if drive_count == 0 {
        return Err(RangeError::new(&format!("{field_path} is empty; allowed is one drive at least")).into());
    }
    (0..drive_count).map(|i| read_drive(&format!("{field_path}[{i}]"), &array_item(value, i)?)).collect()
}

fn read_odometry(field_path: &str, value: &JsValue) -> Result<Trajectory, JsValue> {
    let path_prefix = format!("{field_path}.");
    let allowed_text = "an object with keys from t, x, y, theta, breaks or from t, v, omega, breaks";
    let log_fields = FieldReader::new_with_any_keys(field_path, &path_prefix, value, allowed_text)?;
    if log_fields.value("v")?.is_undefined() && log_fields.value("omega")?.is_undefined() {
        return read_poses(field_path, value);
    }
    let log_fields = FieldReader::new(field_path, &path_prefix, value, &["t", "v", "omega", "breaks"])?;
    let log_columns = read_columns(&log_fields, ["t", "v", "omega"])?;
    let [t, v, omega] = &log_columns;
    let timed_commands = t.iter().zip(v).zip(omega).map(|((t, v), omega)| (*t, *v, *omega));
    checked_trajectory(&log_fields, Trajectory::from_commands(timed_commands))
}

fn read_poses(field_path: &str, value: &JsValue) -> Result<Trajectory, JsValue> {
    let path_prefix = format!("{field_path}.");
    let log_fields = &FieldReader::new(field_path, &path_prefix, value, &["t", "x", "y", "theta", "breaks"])?;
    let log_columns = read_columns(log_fields, ["t", "x", "y", "theta"])?;
    let [t, x, y, theta] = &log_columns;
    let poses = x.iter().zip(y).zip(theta).map(|((x, y), theta)| SE2::new(*x, *y, *theta));
    checked_trajectory(log_fields, Trajectory::new(t.iter().copied().zip(poses)))
}

/// Returns the trajectory with the columns in `log_fields`. The pose may jump before the samples that `log_fields.breaks` lists.
fn checked_trajectory(
    log_fields: &FieldReader,
    trajectory: Result<Trajectory, TrajectoryError>,
) -> Result<Trajectory, JsValue> {
    let name_field = |error| format!("{}: {error}", log_fields.path("").trim_end_matches('.'));
    let trajectory = trajectory.map_err(|error| RangeError::new(&name_field(error)))?;
    let last_sample = trajectory.samples().len() as u64 - 1;
    let read_breaks = |field_path: &str, break_values: &JsValue| {
        let break_count = array_length(field_path, break_values, "an array of numbers")?;
        let break_numbers = read_numbers_of_column(field_path, break_values, break_count)?;
        let indexed_numbers = break_numbers.into_iter().enumerate();
        let break_indices = indexed_numbers.map(|(i, break_index)| {
            read_integer(&format!("{field_path}[{i}]"), break_index, 1..=last_sample)
        });
        break_indices.collect::<Result<Vec<u64>, JsValue>>()
    };
    let break_indices = log_fields.read_optional("breaks", read_breaks)?.unwrap_or_default();
    Ok(trajectory.with_breaks_before(break_indices.into_iter().map(|break_index| break_index as usize)))
}

/// Reads arrays of numbers, all of which must have the length of the first array, the times.
fn read_columns<const N: usize>(log_fields: &FieldReader, keys: [&str; N]) -> Result<[Vec<f64>; N], JsValue> {
    let mut log_columns = [const { Vec::new() }; N];
    for (i, column_key) in keys.into_iter().enumerate() {
        let (field_path, value) = (log_fields.path(column_key), log_fields.value(column_key)?);
        let expected_text = "an array of numbers";
        let row_count = array_length(&field_path, &value, expected_text)?;
        let row_counts = if i == 0 { 2..=MAX_ROWS } else { log_columns[0].len()..=log_columns[0].len() };
        if !row_counts.contains(&row_count) {
            let row_counts = if i == 0 {
                format!("2 to {MAX_ROWS}")
            } else {
                format!("{}, as of {}", log_columns[0].len(), log_fields.path(keys[0]))
            };
            return Err(RangeError::new(&format!(
                "{field_path} has length {row_count}; allowed is {row_counts}"
            ))
            .into());
        }
        log_columns[i] = read_numbers_of_column(&field_path, &value, row_count)?;
        for (row, column_value) in log_columns[i].iter().enumerate() {
            let column_range = if i == 0 { &TIME_RANGE } else { &COORDINATE_RANGE };
            if !column_range.contains(column_value) {
                check_real(&format!("{field_path}[{row}]"), *column_value, column_range)?;
            }
        }
    }
    Ok(log_columns)
}

fn read_numbers_of_column(field_path: &str, value: &JsValue, row_count: usize) -> Result<Vec<f64>, JsValue> {
    if let Some(float64_array) = value.dyn_ref::<Float64Array>() {
        return Ok(float64_array.to_vec());
    }
    let read_numbers = (0..row_count).map(|row| {
        let js_number = array_item(value, row)?;
        js_number.as_f64().map_or_else(|| read_number(&format!("{field_path}[{row}]"), &js_number), Ok)
    });
    read_numbers.collect()
}
