//! Plans and grids from JavaScript.

use super::fields::{
    Fields, boolean, in_range, item, length, no_memory, numbers, printed, type_error, whole, word,
};
use crate::geom::se2::SE2;
use crate::geom::segment::Segment;
use crate::map::{
    FloorPlan, FloorPlanError, Image, Interpretation, MAX_BYTES, MAX_PIXELS, Mode, OccupancyGrid, Pixel,
    RESOLUTION, read_pgm,
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

/// { bounds: [x, y, x, y], walls: [[x, y, x, y], …] }, as a JSON floor plan has them, or with the walls in one
/// Float64Array, as a machine tells them.
pub fn read_plan(plan: &JsValue) -> Result<FloorPlan, JsValue> {
    let fields = Fields::new("plan", "", plan, &["bounds", "walls"])?;
    let bounds = numbers("bounds", &fields.value("bounds")?)?;
    let walls = fields.value("walls")?;
    // What only looks like an array of numbers is no view of a memory.
    if let Some(numbers) = walls.dyn_ref::<Float64Array>().filter(|walls| ArrayBuffer::is_view(walls)) {
        let (count, rest) = (numbers.length() as usize / 4, numbers.length() % 4);
        if rest > 0 {
            return Err(type_error("walls", &walls, "a list of four numbers a wall"));
        }
        if count > FloorPlan::MAX_WALLS {
            return Err(FloorPlanError::TooManyWalls(count).into());
        }
        let segment = |wall: &[f64]| Segment { from: [wall[0], wall[1]], to: [wall[2], wall[3]] };
        return Ok(FloorPlan::new(numbers.to_vec().chunks_exact(4).map(segment).collect(), bounds)?);
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

/// The grid that `map_server` would make of an image, a PGM file or pixels, and what its YAML file says of it, the
/// defaults where it says nothing.
pub fn read_map(description: &JsValue, image: &JsValue) -> Result<OccupancyGrid, JsValue> {
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
    if free_thresh.is_some_and(|free| free > occupied_thresh) {
        let limit = printed(occupied_thresh);
        let message = format!("free_thresh is above occupied_thresh ({limit}); allowed is at most that");
        return Err(RangeError::new(&message).into());
    }
    let mode = fields.optional("mode", word)?.unwrap_or(usual.mode);
    let free_thresh = free_thresh.unwrap_or(usual.free_thresh.min(occupied_thresh));
    let negate = negate.unwrap_or(usual.negate);
    let interpretation = Interpretation { mode, negate, occupied_thresh, free_thresh };
    let [x, y, yaw] = origin;
    Ok(OccupancyGrid::new(&read_image(image)?, &interpretation, resolution, SE2::new(x, y, yaw)))
}

/// The bytes of a PGM file, or an ImageData.
fn read_image(image: &JsValue) -> Result<Image, JsValue> {
    match image.dyn_ref::<Uint8Array>() {
        Some(bytes) => read_file(bytes),
        None => read_pixels(image.unchecked_ref()),
    }
}

fn read_file(bytes: &Uint8Array) -> Result<Image, JsValue> {
    let length = whole("image.length", &bytes.length().into(), 0..=MAX_BYTES as u64)? as usize;
    let mut copy = Vec::new();
    copy.try_reserve_exact(length).map_err(|_| no_memory("image.length"))?;
    copy.resize(length, 0);
    bytes.copy_to(&mut copy);
    read_pgm(&copy).map_err(|error| RangeError::new(&error.to_string()).into())
}

/// An ImageData or, where there is no such class, as in Node, what has its properties. They are read by name: its own
/// getters would throw past Rust on what only looks like one, and take pixels of another format for bytes.
fn read_pixels(image: &ImageData) -> Result<Image, JsValue> {
    let fields = Fields::open("image", "image.", image)?;
    let width = whole("image.width", &fields.value("width")?, 1..=MAX_PIXELS as u64)? as usize;
    let height = whole("image.height", &fields.value("height")?, 1..=(MAX_PIXELS / width) as u64)? as usize;
    let data = fields.value("data")?;
    let Some(data) = data.dyn_ref::<Uint8ClampedArray>() else {
        return Err(type_error("image.data", &data, "a Uint8ClampedArray of red, green, blue, opacity"));
    };
    if data.length() as usize != 4 * width * height {
        let message = format!("image.data has length {}; allowed is {}", data.length(), 4 * width * height);
        return Err(RangeError::new(&message).into());
    }
    let pixels = data
        .to_vec()
        .chunks_exact(4)
        .map(|pixel| Pixel {
            shade: (f32::from(pixel[0]) + f32::from(pixel[1]) + f32::from(pixel[2])) / 765.0,
            opacity: f32::from(pixel[3]) / 255.0,
        })
        .collect();
    Ok(Image { width, height, pixels })
}
