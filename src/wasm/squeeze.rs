//! `MapSqueeze` for JavaScript.

use super::fields::{
    Fields, boolean, in_range, item, length, no_memory, number, numbers, printed, read_command, type_error,
    whole, word,
};
use super::values::{Command, bytes, doubles, float64_array, object, to_js};
use crate::geom::se2::SE2;
use crate::geom::segment::Segment;
use crate::map::{
    FloorPlan, FloorPlanError, Image, Interpretation, MOST_PIXELS, Mode, OccupancyGrid, Pixel, Sampler,
    Wedged, read_pgm,
};
use crate::sim::settings::{MAX_SEED, SPEED};
use crate::sim::squeeze::{
    Attempt, CLEARANCE, MAX_SAMPLES, MAX_STEPS, MapSqueeze, PRESETS, Settings, Tally, alphas_of_noise,
};
use crate::sim::views::Nearest;
use js_sys::{Float64Array, RangeError, Uint8Array};
use serde::Serialize;
use wasm_bindgen::prelude::*;

const KEYS: [&str; 9] =
    ["start", "command", "alphas", "clearance", "conditioned", "sampler", "steps", "samples", "seed"];

#[derive(Clone, Copy, PartialEq)]
enum SamplerName {
    Endpoint,
    WholeArc,
    SubStepped,
}

const SAMPLERS: [(&str, SamplerName); 3] = [
    ("endpoint", SamplerName::Endpoint),
    ("whole-arc", SamplerName::WholeArc),
    ("sub-stepped", SamplerName::SubStepped),
];
/// Parts of a command where nobody says how many: the first number that shows the point.
const OPENING_STEPS: u32 = 4;
const MODES: [(&str, Mode); 3] = [("trinary", Mode::Trinary), ("scale", Mode::Scale), ("raw", Mode::Raw)];
/// From a millimetre to a hundred metres a cell.
const RESOLUTION: std::ops::RangeInclusive<f64> = 1e-3..=100.0;
/// Of a PGM file: a plain one takes six characters a pixel.
const MOST_BYTES: u64 = 6 * MOST_PIXELS as u64 + 4096;
/// Accepted samples of a trial, times parts: enough to time, few enough not to freeze a page.
const MAX_TRIAL: u64 = 100_000;

impl From<FloorPlanError> for JsValue {
    fn from(error: FloorPlanError) -> Self {
        RangeError::new(&error.message(printed)).into()
    }
}

impl From<Wedged> for JsValue {
    fn from(wedged: Wedged) -> Self {
        RangeError::new(&wedged.to_string()).into()
    }
}

#[derive(Serialize)]
struct Start {
    x: f64,
    y: f64,
    theta: f64,
}

impl From<[f64; 3]> for Start {
    fn from([x, y, theta]: [f64; 3]) -> Self {
        Self { x, y, theta }
    }
}

#[derive(Serialize)]
struct Config {
    start: Start,
    command: Command,
    alphas: [f64; 6],
    clearance: f64,
    conditioned: bool,
    sampler: &'static str,
    steps: u32,
    samples: usize,
    seed: u64,
}

#[derive(Serialize)]
struct Preset {
    name: &'static str,
    start: Start,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Stats {
    attempts: usize,
    drawn: usize,
    accepted: usize,
    acceptance_rate: f64,
    through_wall: usize,
    through_wall_rate: f64,
    through_wall_interval: [f64; 2],
    draws_per_accepted: f64,
    wall_tests_per_accepted: f64,
    gave_up: bool,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Cost {
    draws: usize,
    wall_tests: usize,
}

#[wasm_bindgen(js_name = MapSqueeze)]
pub struct JsMapSqueeze {
    machine: MapSqueeze,
    /// The number of parts, kept while another sampler is in use.
    steps: u32,
}

#[wasm_bindgen(js_class = MapSqueeze)]
impl JsMapSqueeze {
    #[wasm_bindgen(constructor)]
    pub fn new(options: &JsValue) -> Result<Self, JsValue> {
        let defaults = Settings::default();
        let (settings, steps) = if options.is_undefined() {
            (defaults, OPENING_STEPS)
        } else {
            read_settings(defaults, OPENING_STEPS, options)?
        };
        Ok(Self { machine: MapSqueeze::new(settings)?, steps })
    }

    #[wasm_bindgen(getter, js_name = maxSamples)]
    pub fn max_samples() -> usize {
        MAX_SAMPLES
    }

    #[wasm_bindgen(getter)]
    pub fn presets() -> Result<JsValue, JsValue> {
        to_js(&PRESETS.map(|(name, start)| Preset { name, start: start.into() }))
    }

    /// The α's of the widget's noise slider.
    #[wasm_bindgen(js_name = alphasOfNoise)]
    pub fn alphas_of_noise(n: &JsValue) -> Result<Float64Array, JsValue> {
        Ok(Float64Array::from(alphas_of_noise(number("n", n)?).as_slice()))
    }

    pub fn configure(&mut self, options: &JsValue) -> Result<(), JsValue> {
        let (settings, steps) = read_settings(*self.machine.settings(), self.steps, options)?;
        self.machine.configure(settings)?;
        self.steps = steps;
        Ok(())
    }

    #[wasm_bindgen(getter)]
    pub fn config(&self) -> Result<JsValue, JsValue> {
        let settings = self.machine.settings();
        to_js(&Config {
            start: settings.start.into(),
            command: settings.command.into(),
            alphas: settings.alphas,
            clearance: settings.clearance,
            conditioned: settings.conditioned,
            sampler: name_of(settings.sampler),
            steps: self.steps,
            samples: settings.samples,
            seed: settings.seed,
        })
    }

    /// { bounds: x, y, x, y; walls: x, y, x, y of one after the other }, m.
    #[wasm_bindgen(getter)]
    pub fn plan(&self) -> Result<JsValue, JsValue> {
        let plan = self.machine.plan();
        let walls = plan.walls().iter().map(|Segment { from, to }| [from[0], from[1], to[0], to[1]]);
        object(&[
            ("bounds", float64_array(&plan.bounds())?.into()),
            ("walls", doubles("plan", walls)?.into()),
        ])
    }

    /// The cells of an occupancy grid, row by row from the bottom, 1 where occupied: { columns, rows, resolution (m),
    /// origin: x, y, yaw of the lower left corner; occupied }. Null for a plan of walls.
    #[wasm_bindgen(getter)]
    pub fn grid(&self) -> Result<JsValue, JsValue> {
        let Some(grid) = self.machine.plan().grid() else { return Ok(JsValue::NULL) };
        let [columns, rows] = grid.size();
        let origin = grid.origin();
        let occupied = grid.occupied().iter().map(|occupied| u8::from(*occupied));
        object(&[
            ("columns", (columns as f64).into()),
            ("rows", (rows as f64).into()),
            ("resolution", grid.resolution().into()),
            ("origin", float64_array(&[origin.x(), origin.y(), origin.theta()])?.into()),
            ("occupied", bytes("grid", occupied)?.into()),
        ])
    }

    /// Another floor plan: { bounds: [x, y, x, y], walls: [[x, y, x, y], …] }; undefined for the apartment.
    #[wasm_bindgen(js_name = setPlan)]
    pub fn set_plan(&mut self, plan: &JsValue) -> Result<(), JsValue> {
        let plan = if plan.is_undefined() { FloorPlan::apartment() } else { read_plan(plan)? };
        self.machine.set_plan(plan);
        Ok(())
    }

    /// A map of `map_server`: what its YAML file says, and its image as the bytes of a PGM file or as ImageData.
    #[wasm_bindgen(js_name = setGrid)]
    pub fn set_grid(&mut self, description: &JsValue, image: &JsValue) -> Result<(), JsValue> {
        let plan = FloorPlan::from_grid(read_grid(description, image)?)?;
        self.machine.set_plan(plan);
        Ok(())
    }

    /// [x, y] where the robot fits, near the origin of the map; null where it fits nowhere.
    #[wasm_bindgen(getter, js_name = freePoint)]
    pub fn free_point(&self) -> Result<JsValue, JsValue> {
        to_js(&self.machine.plan().free_point(self.machine.settings().clearance))
    }

    /// Whether the robot fits where it starts.
    #[wasm_bindgen(getter, js_name = startFree)]
    pub fn start_free(&self) -> bool {
        self.machine.start_free()
    }

    /// The way that the command drives without noise as x, y of one point after the other.
    #[wasm_bindgen(getter)]
    pub fn commanded(&self) -> Result<Float64Array, JsValue> {
        float64_array(self.machine.commanded().points().as_flattened())
    }

    #[wasm_bindgen(getter)]
    pub fn shown(&self) -> usize {
        self.machine.attempts().len()
    }

    pub fn grow(&mut self, count: &JsValue) -> Result<usize, JsValue> {
        let count = whole("count", count, 0, MAX_SAMPLES as u64)?;
        Ok(self.machine.grow(count as usize))
    }

    pub fn restart(&mut self) {
        self.machine.restart();
    }

    /// x, y, θ of each attempt shown.
    #[wasm_bindgen(getter)]
    pub fn poses(&self) -> Result<Float64Array, JsValue> {
        let poses = self.machine.attempts().iter().map(|attempt| attempt.pose);
        doubles("samples", poses.map(|pose| [pose.x(), pose.y(), pose.theta()]))
    }

    /// One byte an attempt: 1 where its end is free, 2 where its path is, 4 where it is accepted, added up.
    #[wasm_bindgen(getter)]
    pub fn verdicts(&self) -> Result<Uint8Array, JsValue> {
        let verdict = |attempt: &Attempt| {
            u8::from(attempt.end_free) + 2 * u8::from(attempt.path_free) + 4 * u8::from(attempt.accepted)
        };
        bytes("samples", self.machine.attempts().iter().map(verdict))
    }

    /// The path driven in attempt `index` as x, y of one point after the other; empty where it is not shown.
    pub fn path(&self, index: &JsValue) -> Result<Float64Array, JsValue> {
        let index = whole("index", index, 0, MAX_SAMPLES as u64)?;
        let points: Vec<[f64; 2]> =
            self.machine.arcs(index as usize).iter().flat_map(|arc| arc.points()).collect();
        float64_array(points.as_flattened())
    }

    #[wasm_bindgen(getter)]
    pub fn stats(&self) -> Result<JsValue, JsValue> {
        let tally: &Tally = self.machine.tally();
        let per_accepted = |count: usize| count as f64 / tally.accepted as f64;
        to_js(&Stats {
            attempts: self.machine.attempts().len(),
            drawn: tally.draws,
            accepted: tally.accepted,
            acceptance_rate: tally.acceptance_rate(self.machine.settings().parts()),
            through_wall: tally.through_wall,
            through_wall_rate: tally.through_wall_rate(),
            through_wall_interval: tally.through_wall_interval(),
            draws_per_accepted: per_accepted(tally.draws),
            wall_tests_per_accepted: per_accepted(tally.wall_tests),
            gave_up: self.machine.gave_up(),
        })
    }

    /// Draws `count` accepted samples with a sampler and forgets them: for timing it. Returns { draws, wallTests };
    /// throws a RangeError where the robot is wedged.
    pub fn trial(&self, sampler: &JsValue, steps: &JsValue, count: &JsValue) -> Result<JsValue, JsValue> {
        let steps = whole("steps", steps, 1, MAX_STEPS)? as u32;
        let sampler = sampler_of(word("sampler", sampler, &SAMPLERS)?, steps);
        let count = whole("count", count, 1, MAX_TRIAL / u64::from(steps))?;
        let cost = self.machine.trial(sampler, count as usize)?;
        to_js(&Cost { draws: cost.draws, wall_tests: cost.wall_tests })
    }

    /// The index of the attempt that ends nearest to a point and within `radius` of it, −1 where there is none.
    pub fn nearest(&self, x: &JsValue, y: &JsValue, radius: &JsValue) -> Result<i32, JsValue> {
        let (target, radius) = ([number("x", x)?, number("y", y)?], number("radius", radius)?);
        let mut nearest = Nearest::new(target, [radius, radius]);
        self.machine.attempts().iter().for_each(|attempt| nearest.see([attempt.pose.x(), attempt.pose.y()]));
        Ok(nearest.index().map_or(-1, |index| index as i32))
    }
}

fn sampler_of(name: SamplerName, steps: u32) -> Sampler {
    match name {
        SamplerName::Endpoint => Sampler::Endpoint,
        SamplerName::WholeArc => Sampler::WholeArc,
        SamplerName::SubStepped => Sampler::SubStepped(steps),
    }
}

fn name_of(sampler: Sampler) -> &'static str {
    match sampler {
        Sampler::Endpoint => "endpoint",
        Sampler::WholeArc => "whole-arc",
        Sampler::SubStepped(_) => "sub-stepped",
    }
}

/// The present settings and number of parts, with those that `options` names.
fn read_settings(present: Settings, steps: u32, options: &JsValue) -> Result<(Settings, u32), JsValue> {
    let fields = Fields::new("options", "", options, &KEYS)?;
    let mut settings = present;
    if let Some(start) = fields.optional("start", read_start)? {
        settings.start = start;
    }
    if let Some(command) = fields.optional("command", read_command)? {
        settings.command = command;
    }
    if let Some(alphas) = fields.optional("alphas", numbers)? {
        settings.alphas = alphas;
    }
    if let Some(clearance) =
        fields.optional("clearance", |field, value| in_range(field, value, &CLEARANCE))?
    {
        settings.clearance = clearance;
    }
    if let Some(conditioned) = fields.optional("conditioned", boolean)? {
        settings.conditioned = conditioned;
    }
    let steps = fields
        .optional("steps", |field, value| whole(field, value, 1, MAX_STEPS))?
        .map_or(steps, |steps| steps as u32);
    let present_name = match settings.sampler {
        Sampler::Endpoint => SamplerName::Endpoint,
        Sampler::WholeArc => SamplerName::WholeArc,
        Sampler::SubStepped(_) => SamplerName::SubStepped,
    };
    let name =
        fields.optional("sampler", |field, value| word(field, value, &SAMPLERS))?.unwrap_or(present_name);
    settings.sampler = sampler_of(name, steps);
    if let Some(samples) =
        fields.optional("samples", |field, value| whole(field, value, 1, MAX_SAMPLES as u64))?
    {
        settings.samples = samples as usize;
    }
    if let Some(seed) = fields.optional("seed", |field, value| whole(field, value, 0, MAX_SEED))? {
        settings.seed = seed;
    }
    Ok((settings, steps))
}

fn read_start(field: &str, value: &JsValue) -> Result<[f64; 3], JsValue> {
    let fields = Fields::new(field, "start.", value, &["x", "y", "theta"])?;
    Ok([fields.number("x")?, fields.number("y")?, fields.number("theta")?])
}

fn read_plan(plan: &JsValue) -> Result<FloorPlan, JsValue> {
    let fields = Fields::new("plan", "", plan, &["bounds", "walls"])?;
    let bounds = numbers("bounds", &fields.value("bounds")?)?;
    let walls = fields.value("walls")?;
    let count = length("walls", &walls, "an array of walls, each [x, y, x, y]")?;
    if count > FloorPlan::MOST_WALLS {
        return Err(FloorPlanError::TooManyWalls(count).into());
    }
    let segments = (0..count).map(|i| {
        let [x0, y0, x1, y1] = numbers(&format!("walls[{i}]"), &item("walls", &walls, i)?)?;
        Ok(Segment { from: [x0, y0], to: [x1, y1] })
    });
    Ok(FloorPlan::new(segments.collect::<Result<_, JsValue>>()?, bounds)?)
}

/// What the YAML file of `map_server` says, its defaults where it says nothing.
fn read_grid(description: &JsValue, image: &JsValue) -> Result<OccupancyGrid, JsValue> {
    let fields = Fields::open("description", "", description)?;
    let resolution = in_range("resolution", &fields.value("resolution")?, &RESOLUTION)?;
    let origin: [f64; 3] = numbers("origin", &fields.value("origin")?)?;
    for (i, coordinate) in origin.iter().enumerate() {
        in_range(&format!("origin[{i}]"), &(*coordinate).into(), &SPEED)?;
    }
    let negate = fields.optional("negate", |field, value| {
        if value.as_bool().is_some() { boolean(field, value) } else { Ok(whole(field, value, 0, 1)? == 1) }
    })?;
    let threshold = |key: &str| fields.optional(key, |field, value| in_range(field, value, &(0.0..=1.0)));
    let occupied_thresh = threshold("occupied_thresh")?.unwrap_or(0.65);
    if threshold("free_thresh")?.is_some_and(|free| free > occupied_thresh) {
        let limit = printed(occupied_thresh);
        let message = format!("free_thresh is above occupied_thresh ({limit}); allowed is at most that");
        return Err(RangeError::new(&message).into());
    }
    let mode = fields.optional("mode", |field, value| word(field, value, &MODES))?.unwrap_or(Mode::Trinary);
    let interpretation = Interpretation { mode, negate: negate.unwrap_or(false), occupied_thresh };
    let [x, y, yaw] = origin;
    Ok(OccupancyGrid::new(&read_image(image)?, &interpretation, resolution, SE2::new(x, y, yaw)))
}

/// The bytes of a PGM file, or an ImageData.
fn read_image(image: &JsValue) -> Result<Image, JsValue> {
    if let Some(bytes) = image.dyn_ref::<Uint8Array>() {
        let length = whole("image.length", &bytes.length().into(), 0, MOST_BYTES)? as usize;
        let mut copy = Vec::new();
        copy.try_reserve_exact(length).map_err(|_| no_memory("image.length"))?;
        copy.resize(length, 0);
        bytes.copy_to(&mut copy);
        return read_pgm(&copy).map_err(|error| RangeError::new(&error.to_string()).into());
    }
    let fields = Fields::open("image", "image.", image)?;
    let width = whole("image.width", &fields.value("width")?, 1, MOST_PIXELS as u64)? as usize;
    let height = whole("image.height", &fields.value("height")?, 1, (MOST_PIXELS / width) as u64)? as usize;
    let data = fields.value("data")?;
    let Some(data) = data.dyn_ref::<js_sys::Uint8ClampedArray>() else {
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
