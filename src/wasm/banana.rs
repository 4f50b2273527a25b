//! `BananaMachine` for JavaScript.

use super::fields::{Fields, in_range, no_memory, number, numbers, read_command, type_error, whole, word};
use super::values::{Command, doubles, float64_array, object, to_js};
use crate::models::VelocityCmd;
use crate::noise::NoiseKind;
use crate::sim::View;
use crate::sim::banana::{BananaMachine, Contours, ModelKind, PRESETS, Sample, Settings};
use crate::sim::picture::{RAMP, Ramp};
use crate::sim::settings::{MAX_SAMPLES, MAX_SEED, SPEED};
use crate::sim::views::Grid;
use js_sys::{Float64Array, RangeError, Uint8Array, Uint8ClampedArray, Uint32Array, WebAssembly};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;
use wasm_bindgen::prelude::*;

const MODELS: [(&str, ModelKind); 2] = [("velocity", ModelKind::Velocity), ("odometry", ModelKind::Odometry)];
const NOISES: [(&str, NoiseKind); 2] = [("normal", NoiseKind::Normal), ("triangular", NoiseKind::Triangular)];
const VIEWS: [(&str, View); 2] = [("plane", View::Plane), ("twist", View::Twist)];
const KEYS: [&str; 7] = ["model", "noise", "command", "alphas", "isolate", "samples", "seed"];
/// Cells of a density grid: 16 million, beyond any screen, take 64 MB.
const MAX_CELLS: u64 = 1 << 24;
/// Points of a skew curve; each costs some ten microseconds.
const MAX_CURVE_POINTS: u64 = 10_000;

fn name_of<T: PartialEq>(words: &[(&'static str, T)], meaning: &T) -> &'static str {
    words.iter().find(|(_, candidate)| candidate == meaning).map_or("", |(word, _)| *word)
}

#[derive(Serialize)]
struct Config<'a> {
    model: &'static str,
    noise: &'static str,
    command: Command,
    alphas: &'a [f64],
    isolate: Option<usize>,
    samples: usize,
    seed: u64,
}

#[derive(Serialize)]
struct Preset {
    name: &'static str,
    v: f64,
    omega: f64,
    dt: f64,
}

#[derive(Serialize)]
struct Moments {
    mean: [f64; 3],
    cov: [[f64; 3]; 3],
}

impl Moments {
    fn new(mean: &Vector3<f64>, cov: &Matrix3<f64>) -> Self {
        // Columns stand for rows: covariances are symmetric.
        Self { mean: (*mean).into(), cov: (*cov).into() }
    }
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Stats {
    n: usize,
    cartesian: Moments,
    exponential: Moments,
    cross_track_skew: f64,
    cross_track_skew_error: f64,
    gaussian_skew: f64,
    rho_cross_heading: f64,
    coverage: Coverage,
}

#[derive(Serialize)]
struct Coverage {
    ellipse: f64,
    exponential: f64,
}

#[derive(Serialize)]
struct Table {
    linearized: TableColumn,
    exact: TableColumn,
    measured: TableColumn,
    tangent: Option<Moments>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct TableColumn {
    mean: [f64; 3],
    cov: [[f64; 3]; 3],
    cross_track_skew: f64,
}

impl TableColumn {
    fn new(mean: &Vector3<f64>, cov: &Matrix3<f64>, cross_track_skew: f64) -> Self {
        let Moments { mean, cov } = Moments::new(mean, cov);
        Self { mean, cov, cross_track_skew }
    }
}

#[wasm_bindgen(js_name = BananaMachine)]
pub struct JsBananaMachine(BananaMachine);

#[wasm_bindgen(js_class = BananaMachine)]
impl JsBananaMachine {
    #[wasm_bindgen(constructor)]
    pub fn new(options: &JsValue) -> Result<Self, JsValue> {
        let settings = Settings::default();
        let settings = if options.is_undefined() { settings } else { read_settings(settings, options)? };
        Ok(Self(BananaMachine::new(settings)?))
    }

    #[wasm_bindgen(getter, js_name = maxSamples)]
    pub fn max_samples() -> usize {
        MAX_SAMPLES
    }

    #[wasm_bindgen(getter)]
    pub fn presets() -> Result<JsValue, JsValue> {
        to_js(&PRESETS.map(|(name, VelocityCmd { v, omega, dt })| Preset { name, v, omega, dt }))
    }

    pub fn configure(&mut self, options: &JsValue) -> Result<(), JsValue> {
        Ok(self.0.configure(read_settings(*self.0.settings(), options)?)?)
    }

    /// As `configure`, in slices.
    pub fn begin(&mut self, options: &JsValue) -> Result<(), JsValue> {
        Ok(self.0.begin(read_settings(*self.0.settings(), options)?)?)
    }

    /// Works on what was begun, for about as many poses of twice as many as are shown; whether all is done.
    pub fn advance(&mut self, poses: &JsValue) -> Result<bool, JsValue> {
        let poses = whole("poses", poses, 1, MAX_SEED)?;
        Ok(self.0.advance(usize::try_from(poses).unwrap_or(usize::MAX)))
    }

    #[wasm_bindgen(getter)]
    pub fn config(&self) -> Result<JsValue, JsValue> {
        let settings = self.0.settings();
        to_js(&Config {
            model: name_of(&MODELS, &settings.model),
            noise: name_of(&NOISES, &settings.noise),
            command: settings.command.into(),
            alphas: settings.alphas(),
            isolate: settings.isolate,
            samples: settings.samples,
            seed: settings.seed,
        })
    }

    #[wasm_bindgen(getter)]
    pub fn shown(&self) -> usize {
        self.0.shown()
    }

    /// Whether figures and contours in exponential coordinates are defined: no robot to speak of turns a whole circle.
    #[wasm_bindgen(getter, js_name = chartHolds)]
    pub fn chart_holds(&self) -> bool {
        self.0.chart_holds()
    }

    pub fn grow(&mut self, count: &JsValue) -> Result<usize, JsValue> {
        let count = whole("count", count, 0, MAX_SAMPLES as u64)?;
        Ok(self.0.grow(count as usize))
    }

    /// As `grow`, in slices.
    #[wasm_bindgen(js_name = beginToGrow)]
    pub fn begin_to_grow(&mut self, count: &JsValue) -> Result<(), JsValue> {
        self.0.begin_to_grow(whole("count", count, 0, MAX_SAMPLES as u64)? as usize);
        Ok(())
    }

    pub fn restart(&mut self) {
        self.0.restart();
    }

    /// x, y, θ of each sample shown.
    #[wasm_bindgen(getter)]
    pub fn poses(&self) -> Result<Float64Array, JsValue> {
        doubles("samples", self.0.poses().map(|pose| [pose.x(), pose.y(), pose.theta()]))
    }

    /// ξ along, lateral, heading of each sample shown.
    #[wasm_bindgen(getter)]
    pub fn twists(&self) -> Result<Float64Array, JsValue> {
        doubles("samples", self.0.twists().map(<[f64; 3]>::from))
    }

    #[wasm_bindgen(getter)]
    pub fn stats(&self) -> Result<JsValue, JsValue> {
        let figures = self.0.figures();
        to_js(&Stats {
            n: self.0.shown(),
            cartesian: Moments::new(&figures.cartesian.mean, &figures.cartesian.cov),
            exponential: Moments::new(&figures.exponential.mean, &figures.exponential.cov),
            cross_track_skew: figures.cross_track.skew,
            cross_track_skew_error: figures.cross_track.skew_error,
            gaussian_skew: figures.gaussian_skew,
            rho_cross_heading: figures.cross_track.rho_heading,
            coverage: Coverage { ellipse: figures.inside_ellipse, exponential: figures.inside_exponential },
        })
    }

    #[wasm_bindgen(getter)]
    pub fn table(&self) -> Result<JsValue, JsValue> {
        let (linearized, exact, figures) = (self.0.linearized(), self.0.exact(), self.0.figures());
        to_js(&Table {
            // A Gaussian in (x, y), whatever its moments, has no skew.
            linearized: TableColumn::new(&linearized.mean, &linearized.cov, 0.0),
            exact: TableColumn::new(&exact.mean, &exact.cov, exact.cross_track_skew),
            measured: TableColumn::new(
                &figures.cartesian.mean,
                &figures.cartesian.cov,
                figures.cross_track.skew,
            ),
            tangent: self.0.tangent().map(|tangent| Moments::new(&tangent.mean, &tangent.cov)),
        })
    }

    #[wasm_bindgen(getter)]
    pub fn contours(&self) -> Result<JsValue, JsValue> {
        let Contours { command, ellipse, linearized, exponential, twist_ellipse } = self.0.contours();
        object(&[
            ("command", float64_array(command.as_flattened())?.into()),
            ("ellipse", float64_array(ellipse.as_flattened())?.into()),
            ("linearized", float64_array(linearized.as_flattened())?.into()),
            ("exponential", float64_array(exponential.as_flattened())?.into()),
            ("twistEllipse", float64_array(twist_ellipse.as_flattened())?.into()),
        ])
    }

    #[wasm_bindgen(js_name = skewCurve)]
    pub fn skew_curve(&self, first: &JsValue, last: &JsValue, points: &JsValue) -> Result<Vec<f64>, JsValue> {
        let first = in_range("omegaMin", first, &SPEED)?;
        let last = in_range("omegaMax", last, &SPEED)?;
        let points = whole("points", points, 2, MAX_CURVE_POINTS)?;
        Ok(self.0.skew_curve(first, last, points as usize))
    }

    pub fn inspect(&self, index: &JsValue) -> Result<JsValue, JsValue> {
        let index = whole("index", index, 0, MAX_SAMPLES as u64)? as usize;
        let Sample { pose, twist, executed, path } =
            self.0.inspect(index).ok_or_else(|| self.not_shown(index))?;
        object(&[
            ("pose", float64_array(&[pose.x(), pose.y(), pose.theta()])?.into()),
            ("twist", float64_array(twist.as_slice())?.into()),
            ("vHat", executed.v_hat.into()),
            ("omegaHat", executed.omega_hat.into()),
            ("gammaHat", executed.gamma_hat.into()),
            ("path", float64_array(path.as_flattened())?.into()),
        ])
    }

    /// θ of a sample.
    pub fn heading(&self, index: &JsValue) -> Result<f64, JsValue> {
        let index = whole("index", index, 0, MAX_SAMPLES as u64)? as usize;
        Ok(self.0.pose(index).ok_or_else(|| self.not_shown(index))?.theta())
    }

    /// The index of the nearest sample in the ellipse of the given radii, −1 where there is none.
    pub fn nearest(
        &self,
        view: &JsValue,
        x: &JsValue,
        y: &JsValue,
        radius_x: &JsValue,
        radius_y: &JsValue,
    ) -> Result<i32, JsValue> {
        let view = word("view", view, &VIEWS)?;
        let target = [number("x", x)?, number("y", y)?];
        let radii = [number("radiusX", radius_x)?, number("radiusY", radius_y)?];
        Ok(self.0.nearest(view, target, radii).map_or(-1, |index| index as i32))
    }

    /// Samples a cell, row by row from the top.
    #[expect(clippy::too_many_arguments, reason = "a view, a rectangle and a size")]
    pub fn density(
        &mut self,
        view: &JsValue,
        x_min: &JsValue,
        y_min: &JsValue,
        x_max: &JsValue,
        y_max: &JsValue,
        columns: &JsValue,
        rows: &JsValue,
    ) -> Result<Uint32Array, JsValue> {
        let view = word("view", view, &VIEWS)?;
        let grid = read_grid([x_min, y_min, x_max, y_max], columns, rows)?;
        let counts = self.0.density(view, &grid).map_err(|_| no_memory("columns"))?;
        Ok(Uint32Array::from(counts.as_slice()))
    }

    /// The same as pixels, each count in its colour of a ramp: a view of the core's memory, to be used before the core is
    /// asked for anything else.
    #[expect(clippy::too_many_arguments, reason = "a view, a rectangle, a size and colours")]
    pub fn picture(
        &mut self,
        view: &JsValue,
        x_min: &JsValue,
        y_min: &JsValue,
        x_max: &JsValue,
        y_max: &JsValue,
        columns: &JsValue,
        rows: &JsValue,
        ramp: &JsValue,
    ) -> Result<Uint8ClampedArray, JsValue> {
        let view = word("view", view, &VIEWS)?;
        let grid = read_grid([x_min, y_min, x_max, y_max], columns, rows)?;
        let ramp = read_ramp(ramp)?;
        let pixels = self.0.paint(view, &grid, &ramp).map_err(|_| no_memory("columns"))?;
        Ok(view_of(pixels.as_flattened()))
    }
}

/// A view of bytes in the core's memory.
fn view_of(bytes: &[u8]) -> Uint8ClampedArray {
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

impl JsBananaMachine {
    fn not_shown(&self, index: usize) -> RangeError {
        let shown = self.0.shown();
        RangeError::new(&format!(
            "index is {index}; allowed is one of the {shown} samples shown, counted from 0"
        ))
    }
}

fn read_grid(bounds: [&JsValue; 4], columns: &JsValue, rows: &JsValue) -> Result<Grid, JsValue> {
    let [x_min, y_min, x_max, y_max] = bounds;
    let min = [in_range("xMin", x_min, &EXTENT)?, in_range("yMin", y_min, &EXTENT)?];
    let max = [
        in_range("xMax", x_max, &(min[0]..=*EXTENT.end()))?,
        in_range("yMax", y_max, &(min[1]..=*EXTENT.end()))?,
    ];
    let columns = whole("columns", columns, 1, MAX_CELLS)?;
    let rows = whole("rows", rows, 1, MAX_CELLS / columns)?;
    Ok(Grid { min, max, columns: columns as usize, rows: rows as usize })
}

fn read_ramp(value: &JsValue) -> Result<Ramp, JsValue> {
    let mut ramp = [[0; 4]; RAMP];
    match value.dyn_ref::<Uint8Array>() {
        Some(bytes) if bytes.length() as usize == 4 * RAMP => bytes.copy_to(ramp.as_flattened_mut()),
        _ => return Err(type_error("ramp", value, "a Uint8Array of 256 colours of four bytes")),
    }
    Ok(ramp)
}

/// Coordinates that a view may reach: as far as the fastest robot gets in the longest step, and some.
const EXTENT: std::ops::RangeInclusive<f64> = -1e18..=1e18;

/// The present settings with those that `options` names.
fn read_settings(present: Settings, options: &JsValue) -> Result<Settings, JsValue> {
    let fields = Fields::new("options", "", options, &KEYS)?;
    let mut settings = present;
    if let Some(model) = fields.optional("model", |field, value| word(field, value, &MODELS))? {
        // α numbers mean other things in the other model.
        if model != settings.model {
            settings.isolate = None;
        }
        settings.model = model;
    }
    if let Some(noise) = fields.optional("noise", |field, value| word(field, value, &NOISES))? {
        settings.noise = noise;
    }
    if let Some(command) = fields.optional("command", read_command)? {
        settings.command = command;
    }
    match settings.model {
        ModelKind::Velocity => {
            if let Some(alphas) = fields.optional("alphas", numbers)? {
                settings.velocity_alphas = alphas;
            }
        }
        ModelKind::Odometry => {
            if let Some(alphas) = fields.optional("alphas", numbers)? {
                settings.odometry_alphas = alphas;
            }
        }
    }
    let numbered = settings.alphas().len() as u64;
    let isolate = fields.optional("isolate", |field, value| {
        if value.is_null() { Ok(None) } else { whole(field, value, 1, numbered).map(Some) }
    })?;
    if let Some(isolate) = isolate {
        settings.isolate = isolate.map(|number| number as usize);
    }
    if let Some(samples) =
        fields.optional("samples", |field, value| whole(field, value, 1, MAX_SAMPLES as u64))?
    {
        settings.samples = samples as usize;
    }
    if let Some(seed) = fields.optional("seed", |field, value| whole(field, value, 0, MAX_SEED))? {
        settings.seed = seed;
    }
    Ok(settings)
}
