//! `DeadReckoning` for JavaScript.

use super::fields::{not_shown, read_opening, read_settings, whole, work};
use super::held::Held;
use super::pictures::read_disc;
use super::values::{
    Plain, doubles, float64_array, gathered, group_to_js, list, number_or_null, object, settings_to_js,
};
use crate::models::Compounding;
use crate::sim::dead_reckoning::{
    DeadReckoning, MAX_SAMPLES, MAX_STEPS, Measured, Outlines, PRESETS, Preset, Settings, Stats, Straight,
};
use crate::sim::settings::Words;
use js_sys::{Array, Float64Array};
use nalgebra::Vector3;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** By the recursion that is compared with the robots. */
export type ByRecursion<T> = Record<DeadReckoningSettings['compounding'], T>;

/** Where a ratio of variances is off by more than 5 %. */
export interface Misses {
  /** Whether there is a spread, and robots are many enough to tell. */
  told: boolean;
  /** The first such step; null where there is none, or none can be told. */
  first: number | null;
  /** The last. */
  last: number | null;
  /** The ratio after the last step, less 1; NaN where there is none. */
  end: number;
  /** Its standard error. */
  error: number;
}

/** All over the robots driven; NaN where undefined. Components are along, lateral (m) and heading (rad). */
export interface ReckoningStats {
  /** Robots driven. */
  n: number;
  /** Of ξ about the commanded pose, after the step that is looked at. */
  measured: Moments;
  /** Predicted covariance after that step; null where the recursion leaves none. */
  predicted: ByRecursion<number[][] | null>;
  /** Of each component. */
  misses: ByRecursion<Misses[]>;
}

/** 2σ, as x, y pairs in m, the first point repeated at the end; empty where undefined. */
export interface StepOutlines {
  /** Of the predicted Gaussian in (x, y). */
  ellipse: Float64Array;
  /** Of the predicted Gaussian in exponential coordinates about the commanded pose, on the floor. */
  exponential: Float64Array;
  /** The same in (ξ along, ξ lateral). */
  predicted: Float64Array;
  /** Of the robots’ own covariance there. */
  measured: Float64Array;
}

/** Variances of one straight command by its duration, m². */
export interface StraightGrowth {
  /** Δt, s, at even steps of its logarithm. */
  durations: Float64Array;
  along: Float64Array;
  across: Float64Array;
  /** α₁v²Δt². */
  alongFirstOrder: Float64Array;
  /** ¼α₃v⁴Δt⁴. */
  acrossFirstOrder: Float64Array;
  /** Where these two are equal, s; null where they never are. */
  crossing: number | null;
}
"#;

/// One command driven step after step by many identical robots from (0, 0), heading along x, and the covariance that
/// recursions predict of it. Metres, radians, seconds throughout. Whatever is out of range throws a TypeError or RangeError
/// that names the field, and changes nothing.
#[wasm_bindgen(js_name = DeadReckoning)]
pub struct JsDeadReckoning(Held<DeadReckoning>);

#[wasm_bindgen(js_class = DeadReckoning)]
impl JsDeadReckoning {
    /// What is left out is as the widget opens: the chapter's twenty steps. `headingNoise` sets α₃ to α₆.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(
            unchecked_optional_param_type = "Partial<DeadReckoningSettings> & { headingNoise?: number }"
        )]
        options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(DeadReckoning::new(read_opening(options)?)?)))
    }

    /// A machine as the constructor makes it, which has driven no robot yet.
    pub fn empty(
        #[wasm_bindgen(
            unchecked_optional_param_type = "Partial<DeadReckoningSettings> & { headingNoise?: number }"
        )]
        options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(DeadReckoning::empty(read_opening(options)?)?)))
    }

    /// Largest `samples`.
    #[wasm_bindgen(getter, js_name = maxSamples)]
    pub fn max_samples() -> usize {
        MAX_SAMPLES
    }

    #[wasm_bindgen(getter, unchecked_return_type = "DeadReckoningPreset[]")]
    pub fn presets() -> Result<Array, JsValue> {
        let preset = |Preset { name, mut command, steps, alphas }| {
            object(&[
                ("name", name.into()),
                ("command", group_to_js(&mut command)?),
                ("steps", steps.into()),
                ("alphas", list(&alphas)?),
            ])
        };
        PRESETS.into_iter().map(preset).collect()
    }

    /// Changes the settings that are named. A complete cloud stays complete.
    pub fn configure(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<DeadReckoningSettings> & { headingNoise?: number }")]
        settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.configure(settings))?)
    }

    /// As `configure`, in slices: `advance` is to be called until it says true. Until then the figures are the former ones.
    pub fn begin(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<DeadReckoningSettings> & { headingNoise?: number }")]
        settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.begin(settings))?)
    }

    /// Works on what was begun, for about as many robots’ steps; whether all is done.
    pub fn advance(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] steps: &JsValue,
    ) -> Result<bool, JsValue> {
        let steps = work("steps", steps)?;
        Ok(self.0.with(move |machine| machine.advance(steps)))
    }

    /// How much is done of what was begun, from 0 to 1.
    #[wasm_bindgen(getter)]
    pub fn progress(&self) -> f64 {
        self.0.with(|machine| machine.progress())
    }

    /// Gives up what was begun: settings and figures are the former ones.
    pub fn stop(&self) {
        self.0.with(DeadReckoning::stop);
    }

    /// A copy; changing it changes nothing.
    #[wasm_bindgen(getter, unchecked_return_type = "DeadReckoningSettings")]
    pub fn config(&self) -> Result<JsValue, JsValue> {
        settings_to_js(&self.settings())
    }

    /// Level h of the heading noise; null where α₃ to α₆ are not those of a level.
    #[wasm_bindgen(getter, js_name = headingNoise, unchecked_return_type = "number | null")]
    pub fn heading_noise(&self) -> JsValue {
        number_or_null(self.settings().heading_noise())
    }

    /// How many robots are driven now, 0 to `config.samples`.
    #[wasm_bindgen(getter)]
    pub fn shown(&self) -> usize {
        self.0.with(|machine| machine.shown())
    }

    /// Drives up to `count` robots more, 0 to 1 000 000. Returns how many are driven then.
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

    /// Takes all robots off; the same come again.
    pub fn restart(&self) {
        self.0.with(DeadReckoning::restart);
    }

    #[wasm_bindgen(getter, unchecked_return_type = "ReckoningStats")]
    pub fn stats(&self) -> Plain<Stats> {
        Plain(Ok(self.0.with(|machine| machine.stats())))
    }

    /// Predicted over measured variance of along, lateral and heading after each step, three numbers a step; NaN where there
    /// is none.
    #[wasm_bindgen(getter, unchecked_return_type = "ByRecursion<Float64Array>")]
    pub fn ratios(&self) -> Result<JsValue, JsValue> {
        by_recursion(|order| self.0.with(move |machine| numbers(&machine.compared(order).ratios)))
    }

    /// Predicted variances of along, lateral (m²) and heading (rad²) after each step, three numbers a step; NaN where there is
    /// none.
    #[wasm_bindgen(getter, unchecked_return_type = "ByRecursion<Float64Array>")]
    pub fn predicted(&self) -> Result<JsValue, JsValue> {
        by_recursion(|order| {
            self.0.with(move |machine| {
                let none = Vector3::repeat(f64::NAN);
                let variances: Vec<_> = machine
                    .predicted(order)
                    .iter()
                    .map(|cov| cov.map_or(none, |cov| cov.diagonal()))
                    .collect();
                numbers(&variances)
            })
        })
    }

    /// Measured variances, as `predicted`.
    #[wasm_bindgen(getter)]
    pub fn measured(&self) -> Result<Float64Array, JsValue> {
        self.of_each_step(|measured| measured.cov.diagonal())
    }

    /// Their standard errors, as shares of them.
    #[wasm_bindgen(getter, js_name = relativeErrors)]
    pub fn relative_errors(&self) -> Result<Float64Array, JsValue> {
        self.of_each_step(|measured| measured.relative_error)
    }

    /// The way that is driven without noise, as x, y pairs (m) from the start.
    #[wasm_bindgen(getter)]
    pub fn commanded(&self) -> Result<Float64Array, JsValue> {
        float64_array(self.0.with(|machine| machine.commanded()).as_flattened())
    }

    /// How the variances of a straight drive at this speed and noise grow with its duration, each as one command.
    #[wasm_bindgen(getter, unchecked_return_type = "StraightGrowth")]
    pub fn straight(&self) -> Result<JsValue, JsValue> {
        let Straight { durations, along, across, along_first_order, across_first_order, crossing } =
            self.0.with(|machine| machine.straight());
        object(&[
            ("durations", float64_array(&durations)?.into()),
            ("along", float64_array(&along)?.into()),
            ("across", float64_array(&across)?.into()),
            ("alongFirstOrder", float64_array(&along_first_order)?.into()),
            ("acrossFirstOrder", float64_array(&across_first_order)?.into()),
            ("crossing", number_or_null(crossing)),
        ])
    }

    /// x, y (m), θ (rad) of the commanded pose after each step.
    #[wasm_bindgen(getter)]
    pub fn nominal(&self) -> Result<Float64Array, JsValue> {
        let poses = self.0.with(|machine| {
            machine.nominal().iter().map(|pose| [pose.x(), pose.y(), pose.theta()]).collect::<Vec<_>>()
        });
        float64_array(poses.as_flattened())
    }

    /// x, y (m), θ (rad) of the first robots after the step that is looked at, 600 at most; a copy.
    #[wasm_bindgen(getter)]
    pub fn poses(&self) -> Result<Float64Array, JsValue> {
        self.poses_of(|settings| settings.step)
    }

    /// As `poses`, after another step, 1 to 200; empty where the path is shorter.
    #[wasm_bindgen(js_name = posesAfter)]
    pub fn poses_after(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] step: &JsValue,
    ) -> Result<Float64Array, JsValue> {
        let step = whole("step", step, 1..=MAX_STEPS)? as u32;
        self.poses_of(move |_| step)
    }

    /// ξ along, lateral (m), heading (rad) of the robots of `poses` about the commanded pose; a copy.
    #[wasm_bindgen(getter)]
    pub fn twists(&self) -> Result<Float64Array, JsValue> {
        doubles("samples", self.0.with(|machine| gathered(machine.twists())))
    }

    /// x, y (m), θ (rad) of one robot after each step, counted from 0.
    pub fn rollout(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] index: &JsValue,
    ) -> Result<Float64Array, JsValue> {
        let index = whole("index", index, 0..=MAX_SAMPLES as u64)? as usize;
        let poses = self.0.with(move |machine| machine.rollout(index));
        let poses = poses.ok_or_else(|| not_shown(index, self.shown()))?;
        float64_array(poses.as_flattened())
    }

    /// The robot of `poses` that is nearest to a point and within `radius` of it; −1 for none.
    pub fn nearest(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] x: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] radius: &JsValue,
    ) -> Result<i32, JsValue> {
        let (target, radius) = read_disc(x, y, radius)?;
        Ok(self.0.with(move |machine| machine.nearest(target, radius)).map_or(-1, |index| index as i32))
    }

    /// Of a step, 1 to 200, and the recursion that is looked at; null where the path is shorter.
    #[wasm_bindgen(unchecked_return_type = "StepOutlines | null")]
    pub fn outlines(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] step: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let step = whole("step", step, 1..=MAX_STEPS)? as u32;
        let outlines = self.0.with(move |machine| machine.outlines(step));
        let Some(Outlines { ellipse, exponential, predicted, measured }) = outlines else {
            return Ok(JsValue::NULL);
        };
        object(&[
            ("ellipse", float64_array(ellipse.as_flattened())?.into()),
            ("exponential", float64_array(exponential.as_flattened())?.into()),
            ("predicted", float64_array(predicted.as_flattened())?.into()),
            ("measured", float64_array(measured.as_flattened())?.into()),
        ])
    }
}

impl JsDeadReckoning {
    fn settings(&self) -> Settings {
        self.0.with(|machine| *machine.settings())
    }

    fn poses_of(&self, step: impl FnOnce(&Settings) -> u32 + 'static) -> Result<Float64Array, JsValue> {
        let poses = self.0.with(move |machine| {
            let step = step(machine.shown_settings());
            gathered(machine.poses(step).iter().copied())
        });
        doubles("samples", poses)
    }

    fn of_each_step(&self, what: fn(&Measured) -> Vector3<f64>) -> Result<Float64Array, JsValue> {
        let vectors: Vec<_> = self.0.with(move |machine| machine.measured().iter().map(what).collect());
        float64_array(&numbers(&vectors))
    }
}

fn numbers(vectors: &[Vector3<f64>]) -> Vec<f64> {
    vectors.iter().flat_map(|vector| [vector.x, vector.y, vector.z]).collect()
}

fn by_recursion(of: impl Fn(Compounding) -> Vec<f64>) -> Result<JsValue, JsValue> {
    let entries =
        Compounding::WORDS.iter().map(|(word, order)| Ok((*word, float64_array(&of(*order))?.into())));
    object(&entries.collect::<Result<Vec<_>, JsValue>>()?)
}
