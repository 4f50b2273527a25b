//! Pictures of densities for JavaScript: readers of their arguments, and Uint8ClampedArray views of their pixels in the core's memory.

use super::fields::{check_range, read_array, read_integer};
use crate::sim::picture::{RAMP_STEP_COUNT, Ramp};
use crate::sim::views::{EXTENT_RANGE, MAX_CELLS, MAX_CELLS_PER_SIDE, ViewGrid};
use js_sys::{RangeError, Uint8ClampedArray, WebAssembly};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

/// Allowed radii for searches around a point: all but negative numbers and NaN.
pub const RADIUS_RANGE: RangeInclusive<f64> = 0.0..=f64::INFINITY;

pub fn pixel_view(rgba_pixels: &[[u8; 4]]) -> Uint8ClampedArray {
    let (first_byte, byte_count) = (rgba_pixels.as_ptr() as u32, rgba_pixels.as_flattened().len() as u32);
    let create_view = || {
        let module_memory: WebAssembly::Memory = wasm_bindgen::memory().unchecked_into();
        Uint8ClampedArray::new_with_byte_offset_and_length(&module_memory.buffer(), first_byte, byte_count)
    };
    let first_view = create_view();
    // Creating a view may let the memory grow, which detaches the view: its length is then 0. A second view needs no more memory.
    if first_view.length() == byte_count { first_view } else { create_view() }
}

/// Returns the index that `find_index` returns for the point (x, y) (m) and the radius (m); −1 if it returns None.
pub fn nearest_index(
    x: f64,
    y: f64,
    radius: f64,
    find_index: impl FnOnce([f64; 2], f64) -> Option<usize>,
) -> Result<i32, JsValue> {
    Ok(find_index([x, y], check_range("radius", radius, &RADIUS_RANGE)?).map_or(-1, |index| index as i32))
}

/// Reads the bounds of a rectangle, xMin, yMin, xMax and yMax, and returns its minimum and maximum corner.
pub fn read_bounds(bounds: &JsValue) -> Result<[[f64; 2]; 2], JsValue> {
    let [x_min, y_min, x_max, y_max] = read_array("bounds", bounds)?;
    let min_corner = [check_range("xMin", x_min, &EXTENT_RANGE)?, check_range("yMin", y_min, &EXTENT_RANGE)?];
    let extent_limit = *EXTENT_RANGE.end();
    let max_corner = [
        check_range("xMax", x_max, &(min_corner[0]..=extent_limit))?,
        check_range("yMax", y_max, &(min_corner[1]..=extent_limit))?,
    ];
    Ok([min_corner, max_corner])
}

pub fn read_grid(bounds: &JsValue, columns: f64, rows: f64) -> Result<ViewGrid, JsValue> {
    let [min_corner, max_corner] = read_bounds(bounds)?;
    let columns = read_integer("columns", columns, 1..=MAX_CELLS_PER_SIDE)?;
    let rows = read_integer("rows", rows, 1..=MAX_CELLS_PER_SIDE.min(MAX_CELLS / columns))?;
    Ok(ViewGrid { min_corner, max_corner, column_count: columns as usize, row_count: rows as usize })
}

/// Reads consecutive colour ramps from their bytes.
pub fn read_ramps<const RAMP_COUNT: usize>(field: &str, bytes: &[u8]) -> Result<[Ramp; RAMP_COUNT], JsValue> {
    let mut colour_ramps = [[[0; 4]; RAMP_STEP_COUNT]; RAMP_COUNT];
    let ramp_bytes = colour_ramps.as_flattened_mut().as_flattened_mut();
    if bytes.len() != ramp_bytes.len() {
        let (byte_length, expected_length) = (bytes.len(), ramp_bytes.len());
        let error_message = format!(
            "{field} has length {byte_length}; allowed is a Uint8Array of {expected_length} bytes, {} colours of four",
            RAMP_STEP_COUNT * RAMP_COUNT
        );
        return Err(RangeError::new(&error_message).into());
    }
    ramp_bytes.copy_from_slice(bytes);
    Ok(colour_ramps)
}
