//! Plans and grids from JavaScript.

use super::fields::{
    Fields, boolean, bytes, doubles, in_range, item, length, no_memory, numbers, printed, type_error, whole,
    word,
};
use crate::geom::se2::SE2;
use crate::geom::segment::Segment;
use crate::map::{
    FloorPlan, FloorPlanError, Image, Interpretation, MAX_BYTES, MAX_PIXELS, MapError, MapReading, Mode,
    RESOLUTION,
};
use crate::sim::settings::{QUANTITY, Words};
use js_sys::{ArrayBuffer, Float64Array, RangeError, Uint8Array, Uint8ClampedArray};
use wasm_bindgen::prelude::*;
use web_sys::ImageData;

impl Words for Mode {
    const WORDS: &'static [(&'static str, Self)] =
        &[("trinary", Self::Trinary), ("scale", Self::Scale), ("raw", Self::Raw)];
}

impl From<FloorPlanError> for JsValue {
    fn from(error: FloorPlanError) -> Self {
        RangeError::new(&error.message(printed)).into()
    }
}

impl From<MapError> for JsValue {
    fn from(error: MapError) -> Self {
        match error {
            MapError::Image(error) => RangeError::new(&error.to_string()).into(),
            MapError::Plan(error) => error.into(),
            MapError::NoMemory => no_memory("samples"),
        }
    }
}

/// { bounds: [x, y, x, y], walls: [[x, y, x, y], …] }, as a JSON floor plan has them, or with the walls in one
/// Float64Array, as a machine tells them.
pub fn read_plan(plan: &JsValue) -> Result<FloorPlan, JsValue> {
    let fields = Fields::new("plan", "", plan, &["bounds", "walls"])?;
    let bounds = numbers("bounds", &fields.value("bounds")?)?;
    let walls = fields.value("walls")?;
    // What only looks like an array of numbers is no view of a memory.
    if walls.is_instance_of::<Float64Array>() && ArrayBuffer::is_view(&walls) {
        let allowed = "an array of walls, or a Float64Array of four numbers a wall";
        let length = length("walls", &walls, allowed)?;
        if length % 4 > 0 {
            return Err(type_error("walls", &walls, allowed));
        }
        if length / 4 > FloorPlan::MAX_WALLS {
            return Err(FloorPlanError::TooManyWalls(length / 4).into());
        }
        let segment = |wall: &[f64]| Segment { from: [wall[0], wall[1]], to: [wall[2], wall[3]] };
        let walls = doubles("walls", &walls, length)?.chunks_exact(4).map(segment).collect();
        return Ok(FloorPlan::new(walls, bounds)?);
    }
    let count = length("walls", &walls, "an array of walls, each [x, y, x, y]")?;
    if count > FloorPlan::MAX_WALLS {
        return Err(FloorPlanError::TooManyWalls(count).into());
    }
    let segments = (0..count).map(|i| {
        let [x0, y0, x1, y1] = numbers(&format!("walls[{i}]"), &item("walls", &walls, i)?)?;
        Ok(Segment { from: [x0, y0], to: [x1, y1] })
    });
    Ok(FloorPlan::new(segments.collect::<Result<_, JsValue>>()?, bounds)?)
}

/// The map that `map_server` would make of an image, a PGM file or pixels, and what its YAML file says of it, the defaults
/// where it says nothing. What is to be read of the image is still to be looked at.
pub fn read_map(description: &JsValue, image: &JsValue) -> Result<MapReading, JsValue> {
    let fields = Fields::open("description", "", description)?;
    let resolution = in_range("resolution", &fields.value("resolution")?, &RESOLUTION)?;
    let origin: [f64; 3] = numbers("origin", &fields.value("origin")?)?;
    for (i, coordinate) in origin.iter().enumerate() {
        in_range(&format!("origin[{i}]"), &(*coordinate).into(), &QUANTITY)?;
    }
    let negate = fields.optional("negate", |field, value| {
        if value.as_bool().is_some() { boolean(field, value) } else { Ok(whole(field, value, 0..=1)? == 1) }
    })?;
    let threshold = |key: &str| fields.optional(key, |field, value| in_range(field, value, &(0.0..=1.0)));
    let usual = Interpretation::default();
    let occupied_thresh = threshold("occupied_thresh")?.unwrap_or(usual.occupied_thresh);
    let free_thresh = threshold("free_thresh")?;
    if let Some(free) = free_thresh.filter(|free| *free > occupied_thresh) {
        let [free, limit] = [free, occupied_thresh].map(printed);
        let message = format!("free_thresh is {free}; allowed is at most occupied_thresh, {limit}");
        return Err(RangeError::new(&message).into());
    }
    let mode = fields.optional("mode", word)?.unwrap_or(usual.mode);
    let free_thresh = free_thresh.unwrap_or(usual.free_thresh.min(occupied_thresh));
    let negate = negate.unwrap_or(usual.negate);
    let interpretation = Interpretation { mode, negate, occupied_thresh, free_thresh };
    let [x, y, yaw] = origin;
    let origin = SE2::new(x, y, yaw);
    if image.is_instance_of::<Uint8Array>() {
        return Ok(MapReading::of_pgm(read_file(image)?, &interpretation, resolution, origin)?);
    }
    Ok(MapReading::of_colours(read_pixels(image.unchecked_ref())?, &interpretation, resolution, origin))
}

/// The bytes of a PGM file.
fn read_file(file: &JsValue) -> Result<Vec<u8>, JsValue> {
    let length = length("image", file, "the bytes of a PGM file")?;
    whole("image.length", &(length as f64).into(), 0..=MAX_BYTES as u64)?;
    bytes("image", file, length)
}

/// Red, green, blue and opacity of an ImageData or, where there is no such class, as in Node, of what has its properties.
/// They are read by name: its own getters would throw past Rust on what only looks like one, and take pixels of another format for bytes.
fn read_pixels(image: &ImageData) -> Result<Image<Vec<u8>>, JsValue> {
    let fields = Fields::open("image", "image.", image)?;
    let width = whole("image.width", &fields.value("width")?, 1..=MAX_PIXELS as u64)? as usize;
    let height = whole("image.height", &fields.value("height")?, 1..=(MAX_PIXELS / width) as u64)? as usize;
    let (data, allowed) = (fields.value("data")?, "a Uint8ClampedArray of red, green, blue, opacity");
    if !data.is_instance_of::<Uint8ClampedArray>() {
        return Err(type_error("image.data", &data, allowed));
    }
    let length = length("image.data", &data, allowed)?;
    if length != 4 * width * height {
        let message = format!("image.data has length {length}; allowed is {}", 4 * width * height);
        return Err(RangeError::new(&message).into());
    }
    Ok(Image { width, height, pixels: bytes("image.data", &data, length)? })
}
