//! Readers of floor plans and occupancy grids from JavaScript.

use super::fields::{
    FieldReader, array_item, array_length, check_range, read_array, read_array_in_range, read_integer,
    type_error,
};
use crate::geom::se2::SE2;
use crate::geom::segment::Segment;
use crate::map::{
    FloorPlan, FloorPlanError, Image, MAX_BYTES, MAX_PIXELS, MapMode, OccupancyGrid, PixelClassifier,
    RESOLUTION_RANGE, read_grid,
};
use crate::numbers::format_number;
use crate::sim::settings::{QUANTITY_RANGE, keywords};
use js_sys::{Float64Array, RangeError, Uint8Array, Uint8ClampedArray};
use wasm_bindgen::prelude::*;

keywords!(MapMode: "trinary" = Self::Trinary, "scale" = Self::Scale, "raw" = Self::Raw);

impl From<FloorPlanError> for JsValue {
    fn from(plan_error: FloorPlanError) -> Self {
        RangeError::new(&plan_error.to_string()).into()
    }
}

/// Reads a floor plan { bounds: [x, y, x, y], walls: [[x, y, x, y], …] }, as in JSON. The walls may also be a Float64Array.
pub fn read_plan(plan_value: &JsValue) -> Result<FloorPlan, JsValue> {
    let plan_fields = FieldReader::new("plan", "", plan_value, &["bounds", "walls"])?;
    let bounds = read_array("bounds", &plan_fields.value("bounds")?)?;
    let walls = plan_fields.value("walls")?;
    if let Some(walls) = walls.dyn_ref::<Float64Array>() {
        if !walls.length().is_multiple_of(4) {
            let allowed_text = "an array of walls, or a Float64Array of four numbers a wall";
            return Err(type_error("walls", walls, allowed_text));
        }
        let to_segment = |wall: &[f64; 4]| Segment { from: [wall[0], wall[1]], to: [wall[2], wall[3]] };
        return Ok(FloorPlan::new(walls.to_vec().as_chunks().0.iter().map(to_segment).collect(), bounds)?);
    }
    let wall_count = array_length("walls", &walls, "an array of walls, each [x, y, x, y]")?;
    if wall_count > FloorPlan::MAX_WALLS {
        return Err(FloorPlanError::TooManyWalls(wall_count).into());
    }
    let wall_segments = (0..wall_count).map(|i| {
        let [x0, y0, x1, y1] = read_array(&format!("walls[{i}]"), &array_item(&walls, i)?)?;
        Ok(Segment { from: [x0, y0], to: [x1, y1] })
    });
    Ok(FloorPlan::new(wall_segments.collect::<Result<_, JsValue>>()?, bounds)?)
}

/// Reads a map as `map_server` does: from an image (the bytes of a file, or pixels), and the fields of its YAML file with their defaults.
pub fn read_map(description_value: &JsValue, image_value: &JsValue) -> Result<OccupancyGrid, JsValue> {
    let map_fields = FieldReader::new_with_any_keys("description", "", description_value, "an object")?;
    let resolution = check_range("resolution", map_fields.number("resolution")?, &RESOLUTION_RANGE)?;
    let origin: [f64; 3] = read_array_in_range("origin", &map_fields.value("origin")?, &QUANTITY_RANGE)?;
    let default_classifier = PixelClassifier::default();
    let is_negated = match map_fields.value("negate")?.as_bool() {
        Some(is_negated) => is_negated,
        None => map_fields.read_or("negate", u32::from(default_classifier.negate), 0..=1)? == 1,
    };
    let occupied_thresh =
        map_fields.read_or("occupied_thresh", default_classifier.occupied_thresh, 0.0..=1.0)?;
    let default_free_thresh = default_classifier.free_thresh.min(occupied_thresh);
    let free_thresh = map_fields.read_or("free_thresh", default_free_thresh, 0.0..=1.0)?;
    if free_thresh > occupied_thresh {
        let [free_thresh_text, occupied_text] = [free_thresh, occupied_thresh].map(format_number);
        let error_message =
            format!("free_thresh is {free_thresh_text}; allowed is at most occupied_thresh, {occupied_text}");
        return Err(RangeError::new(&error_message).into());
    }
    let map_mode = map_fields.read_or("mode", default_classifier.mode, ())?;
    let pixel_classifier =
        PixelClassifier { mode: map_mode, negate: is_negated, occupied_thresh, free_thresh };
    let origin = SE2::from(origin);
    if let Some(file_bytes) = image_value.dyn_ref::<Uint8Array>() {
        read_integer("image.length", f64::from(file_bytes.length()), 0..=MAX_BYTES as u64)?;
        return read_grid(&file_bytes.to_vec(), &pixel_classifier, resolution, origin)
            .map_err(|plan_error| RangeError::new(&plan_error.to_string()).into());
    }
    let (width, height, pixel_bytes) = read_pixels(image_value)?;
    let pixels = pixel_bytes.as_chunks::<4>().0.to_vec();
    Ok(OccupancyGrid::new(&Image { width, height, pixels }, &pixel_classifier, resolution, origin))
}

/// Reads width, height, and the red, green, blue and opacity of each pixel of an ImageData. An object with the same properties is accepted,
/// because Node has no such class.
fn read_pixels(image_value: &JsValue) -> Result<(usize, usize, Vec<u8>), JsValue> {
    let image_fields = FieldReader::new_with_any_keys("image", "image.", image_value, "an object")?;
    let width = read_integer("image.width", image_fields.number("width")?, 1..=MAX_PIXELS as u64)? as usize;
    let height =
        read_integer("image.height", image_fields.number("height")?, 1..=(MAX_PIXELS / width) as u64)?
            as usize;
    let rgba = image_fields.value("data")?;
    let Some(rgba) = rgba.dyn_ref::<Uint8ClampedArray>() else {
        return Err(type_error("image.data", &rgba, "a Uint8ClampedArray of red, green, blue, opacity"));
    };
    let (byte_count, expected_byte_count) = (rgba.length() as usize, 4 * width * height);
    if byte_count != expected_byte_count {
        let error_message = format!("image.data has length {byte_count}; allowed is {expected_byte_count}");
        return Err(RangeError::new(&error_message).into());
    }
    Ok((width, height, rgba.to_vec()))
}
