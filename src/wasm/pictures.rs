//! Densities for JavaScript: what is asked for, and pixels as a view of the core's memory.

use super::fields::{in_range, type_error, whole};
use crate::sim::picture::{RAMP, Ramp};
use crate::sim::views::{EXTENT, Grid, MAX_CELLS};
use js_sys::{Uint8Array, Uint8ClampedArray, WebAssembly};
use wasm_bindgen::prelude::*;

/// A view of bytes in the core's memory.
pub fn view_of(bytes: &[u8]) -> Uint8ClampedArray {
    let view = || {
        let memory: WebAssembly::Memory = wasm_bindgen::memory().unchecked_into();
        Uint8ClampedArray::new_with_byte_offset_and_length(
            &memory.buffer(),
            bytes.as_ptr() as u32,
            bytes.len() as u32,
        )
    };
    let first = view();
    // The handle of the view itself may have made the memory grow, which empties all views of it; it does so once.
    if first.length() as usize == bytes.len() { first } else { view() }
}

pub fn read_grid(bounds: [&JsValue; 4], columns: &JsValue, rows: &JsValue) -> Result<Grid, JsValue> {
    let [x_min, y_min, x_max, y_max] = bounds;
    let min = [in_range("xMin", x_min, &EXTENT)?, in_range("yMin", y_min, &EXTENT)?];
    let max = [
        in_range("xMax", x_max, &(min[0]..=*EXTENT.end()))?,
        in_range("yMax", y_max, &(min[1]..=*EXTENT.end()))?,
    ];
    let columns = whole("columns", columns, 1..=MAX_CELLS)?;
    let rows = whole("rows", rows, 1..=MAX_CELLS / columns)?;
    Ok(Grid { min, max, columns: columns as usize, rows: rows as usize })
}

/// As many ramps one after the other.
pub fn read_ramps<const COUNT: usize>(field: &str, value: &JsValue) -> Result<[Ramp; COUNT], JsValue> {
    let mut ramps = [[[0; 4]; RAMP]; COUNT];
    match value.dyn_ref::<Uint8Array>() {
        Some(bytes) if bytes.length() as usize == 4 * RAMP * COUNT => {
            bytes.copy_to(ramps.as_flattened_mut().as_flattened_mut());
        }
        _ => {
            let allowed = format!("a Uint8Array of {} colours of four bytes", RAMP * COUNT);
            return Err(type_error(field, value, &allowed));
        }
    }
    Ok(ramps)
}
