//! Densities for JavaScript: what is asked for, and pixels as a view of the core's memory.

use super::fields::{copy_bytes, in_range, length, number, type_error, whole};
use crate::sim::picture::{RAMP, Ramp};
use crate::sim::views::{EXTENT, Grid, MAX_CELLS, MAX_SIDE};
use js_sys::{RangeError, Uint8Array, Uint8ClampedArray, WebAssembly};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

/// Radii around a point; NaN is none.
pub const RADIUS: RangeInclusive<f64> = 0.0..=f64::INFINITY;

/// Where pixels are in the core's memory: from which byte, and how many bytes.
pub fn place_of(pixels: &[[u8; 4]]) -> [u32; 2] {
    [pixels.as_ptr() as u32, pixels.as_flattened().len() as u32]
}

/// A view of bytes in the core's memory.
pub fn view_of(&[start, length]: &[u32; 2]) -> Uint8ClampedArray {
    let view = || {
        let memory: WebAssembly::Memory = wasm_bindgen::memory().unchecked_into();
        Uint8ClampedArray::new_with_byte_offset_and_length(&memory.buffer(), start, length)
    };
    let first = view();
    // The handle of the view itself may have made the memory grow, which empties all views of it; it does so once.
    if first.length() == length { first } else { view() }
}

/// A point, and how far around it.
pub fn read_disc(x: &JsValue, y: &JsValue, radius: &JsValue) -> Result<([f64; 2], f64), JsValue> {
    Ok(([number("x", x)?, number("y", y)?], in_range("radius", radius, &RADIUS)?))
}

pub fn read_grid(bounds: [&JsValue; 4], columns: &JsValue, rows: &JsValue) -> Result<Grid, JsValue> {
    let [x_min, y_min, x_max, y_max] = bounds;
    let min = [in_range("xMin", x_min, &EXTENT)?, in_range("yMin", y_min, &EXTENT)?];
    let max = [
        in_range("xMax", x_max, &(min[0]..=*EXTENT.end()))?,
        in_range("yMax", y_max, &(min[1]..=*EXTENT.end()))?,
    ];
    let columns = whole("columns", columns, 1..=MAX_SIDE)?;
    let rows = whole("rows", rows, 1..=MAX_SIDE.min(MAX_CELLS / columns))?;
    Ok(Grid { min, max, columns: columns as usize, rows: rows as usize })
}

/// As many ramps one after the other.
pub fn read_ramps<const COUNT: usize>(field: &str, value: &JsValue) -> Result<[Ramp; COUNT], JsValue> {
    let mut ramps = [[[0; 4]; RAMP]; COUNT];
    let bytes = ramps.as_flattened_mut().as_flattened_mut();
    let allowed = format!("a Uint8Array of {} bytes, {} colours of four", bytes.len(), RAMP * COUNT);
    if !value.is_instance_of::<Uint8Array>() {
        return Err(type_error(field, value, &allowed));
    }
    let length = length(field, value, &allowed)?;
    if length != bytes.len() {
        return Err(RangeError::new(&format!("{field} has length {length}; allowed is {allowed}")).into());
    }
    copy_bytes(field, value, bytes)?;
    Ok(ramps)
}
