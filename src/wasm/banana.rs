//! `BananaMachine` for JavaScript.

use super::fields::{in_range, no_memory, not_shown, number, read_opening, read_settings, whole, word, work};
use super::held::Held;
use super::pictures::{RADIUS, place_of, read_grid, read_ramps, view_of};
use super::values::{Plain, doubles, float64_array, gathered, list, object, settings_to_js, whole_numbers};
use crate::geom::arc::ArcInversion;
use crate::geom::se2::SE2;
use crate::models::{OdomDelta, VelocityCmd};
use crate::sim::banana::{
    BananaMachine, Contours, Executed, MAX_CURVE_POINTS, MAX_SAMPLES, PRESETS, Preset, Sample, Settings,
    Stats, Table,
};
use crate::sim::settings::QUANTITY;
use js_sys::{Array, Float64Array, Uint8ClampedArray, Uint32Array};
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** "plane" is (x, y); "twist" is (ξ along, ξ heading). */
export type ViewName = 'plane' | 'twist';

/** Of (x, y, θ) in m, m, rad; in exponential coordinates of ξ along, lateral (m) and heading (rad). */
export interface Moments {
  /** Three numbers; θ is a circular mean. */
  mean: number[];
  /** Three rows of three. */
  cov: number[][];
}

/**
 * Mean log-likelihood of a robot under a Gaussian in coordinates that bend with the cloud, less that under one in plain
 * ones, each with the moments of the cloud; in nats a robot. Infinity where the cloud fills no volume in the bent ones.
 */
export interface LikelihoodGain {
  /** Of exponential coordinates over (x, y, θ). */
  pose: number;
  /** Of length and turn of the arc that ends there over (x, y). */
  floor: number;
}

/** All over the samples shown; NaN where undefined. */
export interface Stats {
  /** Samples shown. */
  n: number;
  /** Of the poses. */
  cartesian: Moments;
  /** Of the poses in exponential coordinates about the start. NaN where the chart does not hold. */
  exponential: Moments;
  /** Third standardized moment across the mean heading; positive with the longer tail at its left. */
  crossTrackSkew: number;
  /** Its standard error. */
  crossTrackSkewError: number;
  /** The skew that the fitted Gaussian in exponential coordinates predicts. */
  gaussianSkew: number;
  /** Correlation of cross-track position and heading, −1 to 1. */
  rhoCrossHeading: number;
  /** Shares, 0 to 1, inside the 2σ outlines in (x, y) and in (ξ along, ξ heading). */
  coverage: { ellipse: number; exponential: number };
  likelihoodGain: LikelihoodGain;
  /** Its standard errors. */
  likelihoodGainError: LikelihoodGain;
  /** Area of the 2σ ellipse in (x, y) over that of the 2σ outline of exponential coordinates on the floor, as drawn. */
  areaRatio: number;
}

/** Outlines on the floor as x, y pairs in m, the first point repeated at the end; empty where undefined. */
export interface Contours {
  /** The arc driven without noise, from the start to its end; open. */
  command: Float64Array;
  /** 2σ, of the Gaussian fitted in (x, y). */
  ellipse: Float64Array;
  /** 2σ, of the linearization at the command that an extended Kalman filter uses. */
  linearized: Float64Array;
  /** 2σ, of the Gaussian fitted in exponential coordinates. */
  exponential: Float64Array;
  /** The same in (ξ along, ξ heading), m and rad. */
  twistEllipse: Float64Array;
  /** 2σ of noise added to the pose: a circle of 0.4 m around the noise-free end, whatever the command and the noise. */
  additive: Float64Array;
}

export interface TableColumn extends Moments {
  crossTrackSkew: number;
  /** Of the linearization 0. */
  likelihoodGain: LikelihoodGain;
  /** Of the linearization 1. */
  areaRatio: number;
}

/** Moments of the pose three ways, and of its exponential coordinates. */
export interface Table {
  /** Noise-free end, and covariance to first order in the noise. */
  linearized: TableColumn;
  /** By quadrature. */
  exact: TableColumn;
  /** On the samples shown. */
  measured: TableColumn;
  /** The commanded twist and its noise; null for the odometry model, whose noise has no such form. */
  tangent: Moments | null;
}

/** The legs of the odometry model: turn (rad), drive (m), turn (rad). */
export interface Legs {
  rot1: number;
  trans: number;
  rot2: number;
}

/** One sample, and what it did to get there. */
export interface Inspection {
  /** x, y in m, θ in rad, in (−π, π]. */
  pose: Float64Array;
  /** ξ along and lateral in m, heading in rad. */
  twist: Float64Array;
  /** Speed of its arc, m/s; like the next two NaN under the odometry model, which knows no arc. */
  vHat: number;
  /** Turn rate of the arc, rad/s. */
  omegaHat: number;
  /** Turn rate after it, rad/s over the same duration. */
  gammaHat: number;
  /** Its legs under the odometry model; null under the velocity model. */
  legs: Legs | null;
  /** Its way as x, y pairs in m from the start. */
  path: Float64Array;
}
"#;

/// One command sent to many identical robots from (0, 0), heading along x. Metres, radians, seconds throughout. Whatever
/// is out of range throws a TypeError or RangeError that names the field, and changes nothing.
#[wasm_bindgen(js_name = BananaMachine)]
pub struct JsBananaMachine(Held<BananaMachine>);

#[wasm_bindgen(js_class = BananaMachine)]
impl JsBananaMachine {
    /// What is left out is as the widget opens: the gentle arc, velocity model, normal noise.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(unchecked_optional_param_type = "Partial<BananaMachineSettings>")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(BananaMachine::new(read_opening(options)?)?)))
    }

    /// A machine as the constructor makes it, of whose samples none is shown yet.
    pub fn empty(
        #[wasm_bindgen(unchecked_optional_param_type = "Partial<BananaMachineSettings>")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(BananaMachine::empty(read_opening(options)?)?)))
    }

    /// Largest `samples`.
    #[wasm_bindgen(getter, js_name = maxSamples)]
    pub fn max_samples() -> usize {
        MAX_SAMPLES
    }

    #[wasm_bindgen(getter, unchecked_return_type = "BananaMachinePreset[]")]
    pub fn presets() -> Result<Array, JsValue> {
        let preset = |Preset { name, command: VelocityCmd { v, omega, dt }, alphas }| {
            let alphas = alphas.map_or(Ok(JsValue::NULL), |alphas| list(&alphas))?;
            object(&[
                ("name", name.into()),
                ("v", v.into()),
                ("omega", omega.into()),
                ("dt", dt.into()),
                ("alphas", alphas),
            ])
        };
        PRESETS.into_iter().map(preset).collect()
    }

    /// Changes the settings that are named. A complete cloud stays complete.
    pub fn configure(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<BananaMachineSettings>")] settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.configure(settings))?)
    }

    /// As `configure`, in slices: `advance` is to be called until it says true. Until then the figures are the former
    /// ones, and the samples partly so.
    pub fn begin(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<BananaMachineSettings>")] settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.begin(settings))?)
    }

    /// Works on what was begun, for about as many poses of twice as many as are shown; whether all is done.
    pub fn advance(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] poses: &JsValue,
    ) -> Result<bool, JsValue> {
        let poses = work("poses", poses)?;
        Ok(self.0.with(move |machine| machine.advance(poses)))
    }

    /// A copy; changing it changes nothing.
    #[wasm_bindgen(getter, unchecked_return_type = "BananaMachineSettings")]
    pub fn config(&self) -> Result<JsValue, JsValue> {
        settings_to_js(&self.settings())
    }

    /// The noise parameters that each model has, or will have when it is chosen again.
    #[wasm_bindgen(
        getter,
        js_name = alphasOfModels,
        unchecked_return_type = "{ velocity: number[]; odometry: number[] }"
    )]
    pub fn alphas_of_models(&self) -> Result<JsValue, JsValue> {
        let Settings { velocity_alphas, odometry_alphas, .. } = self.settings();
        object(&[("velocity", list(&velocity_alphas)?), ("odometry", list(&odometry_alphas)?)])
    }

    /// How many samples there are now, 0 to `config.samples`.
    #[wasm_bindgen(getter)]
    pub fn shown(&self) -> usize {
        self.0.with(|machine| machine.shown())
    }

    /// Whether exponential coordinates reach as far as the robots turn: to short of a full circle. Where not, figures and
    /// contours in them are undefined.
    #[wasm_bindgen(getter, js_name = chartHolds)]
    pub fn chart_holds(&self) -> bool {
        self.0.with(|machine| machine.chart_holds())
    }

    /// Shows up to `count` samples more, 0 to 10 000 000. Returns how many are shown then.
    pub fn grow(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] count: &JsValue,
    ) -> Result<usize, JsValue> {
        let count = whole("count", count, 0..=MAX_SAMPLES as u64)? as usize;
        Ok(self.0.with(move |machine| machine.grow(count)))
    }

    /// As `grow`, in slices like `begin`.
    #[wasm_bindgen(js_name = beginToGrow)]
    pub fn begin_to_grow(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] count: &JsValue,
    ) -> Result<(), JsValue> {
        let count = whole("count", count, 0..=MAX_SAMPLES as u64)? as usize;
        self.0.with(move |machine| machine.begin_to_grow(count));
        Ok(())
    }

    /// Shows none; the same samples come again.
    pub fn restart(&self) {
        self.0.with(BananaMachine::restart);
    }

    /// x, y (m), θ (rad) of each sample shown; a copy.
    #[wasm_bindgen(getter)]
    pub fn poses(&self) -> Result<Float64Array, JsValue> {
        let numbers = |pose: SE2| [pose.x(), pose.y(), pose.theta()];
        doubles("samples", self.0.with(move |machine| gathered(machine.poses().map(numbers))))
    }

    /// ξ along, lateral (m), heading (rad) of each sample shown; a copy.
    #[wasm_bindgen(getter)]
    pub fn twists(&self) -> Result<Float64Array, JsValue> {
        doubles("samples", self.0.with(|machine| gathered(machine.twists().map(<[f64; 3]>::from))))
    }

    /// What each sample shown executed: v̂ (m/s), ω̂, γ̂ (rad/s); under the odometry model the legs δ̂_rot1 (rad), δ̂_trans (m),
    /// δ̂_rot2 (rad). A copy.
    #[wasm_bindgen(getter)]
    pub fn executed(&self) -> Result<Float64Array, JsValue> {
        doubles("samples", self.0.with(|machine| gathered(machine.executed())))
    }

    /// The command as odometry without noise reads it.
    #[wasm_bindgen(getter, unchecked_return_type = "Legs")]
    pub fn reading(&self) -> Result<JsValue, JsValue> {
        legs_to_js(self.0.with(|machine| machine.reading()))
    }

    #[wasm_bindgen(getter, unchecked_return_type = "Stats")]
    pub fn stats(&self) -> Plain<Stats> {
        Plain(Ok(self.0.with(|machine| machine.stats())))
    }

    #[wasm_bindgen(getter, unchecked_return_type = "Table")]
    pub fn table(&self) -> Plain<Table> {
        Plain(Ok(self.0.with(|machine| machine.table())))
    }

    #[wasm_bindgen(getter, unchecked_return_type = "Contours")]
    pub fn contours(&self) -> Result<JsValue, JsValue> {
        let Contours { command, ellipse, linearized, exponential, twist_ellipse, additive } =
            self.0.with(|machine| machine.contours());
        object(&[
            ("command", float64_array(command.as_flattened())?.into()),
            ("ellipse", float64_array(ellipse.as_flattened())?.into()),
            ("linearized", float64_array(linearized.as_flattened())?.into()),
            ("exponential", float64_array(exponential.as_flattened())?.into()),
            ("twistEllipse", float64_array(twist_ellipse.as_flattened())?.into()),
            ("additive", float64_array(additive.as_flattened())?.into()),
        ])
    }

    /// Exact cross-track skew at 2 to 10 000 evenly spaced turn rates, rad/s; NaN where undefined.
    #[wasm_bindgen(js_name = skewCurve)]
    pub fn skew_curve(
        &self,
        #[wasm_bindgen(js_name = omegaMin, unchecked_param_type = "number")] omega_min: &JsValue,
        #[wasm_bindgen(js_name = omegaMax, unchecked_param_type = "number")] omega_max: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] points: &JsValue,
    ) -> Result<Vec<f64>, JsValue> {
        let first = in_range("omegaMin", omega_min, &QUANTITY)?;
        let last = in_range("omegaMax", omega_max, &QUANTITY)?;
        let points = whole("points", points, 2..=MAX_CURVE_POINTS)?;
        Ok(self.0.with(move |machine| machine.skew_curve(first, last, points as usize)))
    }

    /// A sample shown, counted from 0.
    #[wasm_bindgen(unchecked_return_type = "Inspection")]
    pub fn inspect(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] index: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let index = whole("index", index, 0..=MAX_SAMPLES as u64)? as usize;
        let Sample { pose, twist, executed, path } = self
            .0
            .with(move |machine| machine.inspect(index))
            .ok_or_else(|| not_shown(index, self.shown()))?;
        let (ArcInversion { v_hat, omega_hat, gamma_hat }, legs) = match executed {
            Executed::Arc { arc, .. } => (arc, JsValue::NULL),
            Executed::Legs(legs) => {
                let none = ArcInversion { v_hat: f64::NAN, omega_hat: f64::NAN, gamma_hat: f64::NAN };
                (none, legs_to_js(legs)?)
            }
        };
        object(&[
            ("pose", float64_array(&[pose.x(), pose.y(), pose.theta()])?.into()),
            ("twist", float64_array(twist.as_slice())?.into()),
            ("vHat", v_hat.into()),
            ("omegaHat", omega_hat.into()),
            ("gammaHat", gamma_hat.into()),
            ("legs", legs),
            ("path", float64_array(path.as_flattened())?.into()),
        ])
    }

    /// The heading of a sample shown, counted from 0, rad.
    pub fn heading(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] index: &JsValue,
    ) -> Result<f64, JsValue> {
        let index = whole("index", index, 0..=MAX_SAMPLES as u64)? as usize;
        let pose = self.0.with(move |machine| machine.pose(index));
        Ok(pose.ok_or_else(|| not_shown(index, self.shown()))?.theta())
    }

    /// The nearest sample inside an ellipse of these radii around a point of the view; −1 for none.
    pub fn nearest(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ViewName")] view: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] x: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: &JsValue,
        #[wasm_bindgen(js_name = radiusX, unchecked_param_type = "number")] radius_x: &JsValue,
        #[wasm_bindgen(js_name = radiusY, unchecked_param_type = "number")] radius_y: &JsValue,
    ) -> Result<i32, JsValue> {
        let view = word("view", view)?;
        let target = [number("x", x)?, number("y", y)?];
        let radii = [in_range("radiusX", radius_x, &RADIUS)?, in_range("radiusY", radius_y, &RADIUS)?];
        Ok(self.0.with(move |machine| machine.nearest(view, target, radii)).map_or(-1, |index| index as i32))
    }

    /// Samples a cell of a grid over a part of the view, row by row from yMax down; 2²⁴ cells, 2¹⁴ a side at most.
    #[expect(clippy::too_many_arguments, reason = "a view, a rectangle and a size")]
    pub fn density(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ViewName")] view: &JsValue,
        #[wasm_bindgen(js_name = xMin, unchecked_param_type = "number")] x_min: &JsValue,
        #[wasm_bindgen(js_name = yMin, unchecked_param_type = "number")] y_min: &JsValue,
        #[wasm_bindgen(js_name = xMax, unchecked_param_type = "number")] x_max: &JsValue,
        #[wasm_bindgen(js_name = yMax, unchecked_param_type = "number")] y_max: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] columns: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] rows: &JsValue,
    ) -> Result<Uint32Array, JsValue> {
        let view = word("view", view)?;
        let grid = read_grid([x_min, y_min, x_max, y_max], columns, rows)?;
        let counts = self.0.with(move |machine| machine.density(view, &grid));
        whole_numbers(&counts.map_err(|_| no_memory("columns"))?)
    }

    /// The same as RGBA pixels, each count c in the colour ramp[255·√(c/most)] of 256, transparent where there is nobody.
    /// A view of the core's memory: to be used before the machine is asked for anything else.
    #[expect(clippy::too_many_arguments, reason = "a view, a rectangle, a size and colours")]
    #[wasm_bindgen(unchecked_return_type = "Uint8ClampedArray<ArrayBuffer>")]
    pub fn picture(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ViewName")] view: &JsValue,
        #[wasm_bindgen(js_name = xMin, unchecked_param_type = "number")] x_min: &JsValue,
        #[wasm_bindgen(js_name = yMin, unchecked_param_type = "number")] y_min: &JsValue,
        #[wasm_bindgen(js_name = xMax, unchecked_param_type = "number")] x_max: &JsValue,
        #[wasm_bindgen(js_name = yMax, unchecked_param_type = "number")] y_max: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] columns: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] rows: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array")] ramp: &JsValue,
    ) -> Result<Uint8ClampedArray, JsValue> {
        let view = word("view", view)?;
        let grid = read_grid([x_min, y_min, x_max, y_max], columns, rows)?;
        let [ramp] = read_ramps("ramp", ramp)?;
        let pixels = self.0.with(move |machine| machine.paint(view, &grid, &ramp).map(place_of));
        Ok(view_of(&pixels.map_err(|_| no_memory("columns"))?))
    }
}

fn legs_to_js(OdomDelta { rot1, trans, rot2 }: OdomDelta) -> Result<JsValue, JsValue> {
    object(&[("rot1", rot1.into()), ("trans", trans.into()), ("rot2", rot2.into())])
}

impl JsBananaMachine {
    fn settings(&self) -> Settings {
        self.0.with(|machine| *machine.settings())
    }
}
