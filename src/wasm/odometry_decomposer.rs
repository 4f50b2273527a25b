//! `OdometryDecomposer` for JavaScript.

use super::fields::{in_range, read_opening, read_settings, whole};
use super::held::Held;
use super::pictures::read_disc;
use super::values::{Plain, doubles, float64_array, gathered, group_to_js, object, settings_to_js};
use crate::geom::se2::SE2;
use crate::sim::odometry_decomposer::{
    CurvePoint, MAX_CURVE_POINTS, MAX_SAMPLES, OdometryDecomposer, OdometryPose, PRESETS, Preset,
    RuleFigures, Settings, Stats,
};
use crate::sim::settings::{QUANTITY, Word};
use js_sys::{Array, Float64Array};
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** What one rule makes of the reading. */
export interface RuleFigures {
  rule: OdometryDecomposerSettings['rule'];
  /** Where it takes a short reading for a spin, the second rotation has the whole turn. */
  legs: Legs;
  /** Standard deviations of the three legs (rad, m, rad) and across the second (m). */
  deviations: Float64Array;
  /** Standard deviation across the measured bearing, m. */
  crossTrack: number;
  /** Standard deviation of the turn made, rad. */
  heading: number;
}

/** What the outcomes shown say, beside what is exact; NaN without any. */
export interface DecomposerStats {
  n: number;
  /** Root mean square of the distance from the measured bearing, m. */
  crossTrack: number;
  /** Standard error of `crossTrack`, m. */
  crossTrackError: number;
  exactCrossTrack: number;
  /** How far the first rotation's standard deviation moves the end of the drive, m. */
  lever: number;
  /** Root mean square of the turn made but for the measured one, rad. */
  heading: number;
  /** Standard error of `heading`, rad. */
  headingError: number;
  exactHeading: number;
  /** `exactHeading` if the two rotations were independent. */
  independentHeading: number;
}

/** The odometry in the world, where its frame has drifted. */
export interface Drifted {
  /** Poses x, y (m), θ (rad) of the frame, and in the world of the two odometry poses, one after the other. */
  poses: Float64Array;
  /** The legs that are read of them there. */
  legs: Legs;
}
"#;

/// An odometry reading as rotate, drive, rotate, and what noise makes of it under the rules of several localizers. Metres,
/// radians, seconds throughout. Whatever is out of range throws a TypeError or RangeError that names the field, and changes
/// nothing.
#[wasm_bindgen(js_name = OdometryDecomposer)]
pub struct JsOdometryDecomposer(Held<OdometryDecomposer>);

#[wasm_bindgen(js_class = OdometryDecomposer)]
impl JsOdometryDecomposer {
    /// What is left out is as the widget opens: three legs under the table's rule.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(unchecked_optional_param_type = "Partial<OdometryDecomposerSettings>")]
        options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(OdometryDecomposer::new(read_opening(options)?)?)))
    }

    #[wasm_bindgen(getter, unchecked_return_type = "OdometryDecomposerPreset[]")]
    pub fn presets() -> Result<Array, JsValue> {
        let pose = |mut pose: OdometryPose| group_to_js(&mut pose);
        let preset = |Preset { name, from, to }: Preset| {
            object(&[("name", name.into()), ("from", pose(from)?), ("to", pose(to)?)])
        };
        PRESETS.into_iter().map(preset).collect()
    }

    /// Changes the settings that are named. A complete cloud stays complete.
    pub fn configure(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<OdometryDecomposerSettings>")] settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.configure(settings))?)
    }

    /// As `configure`: every change is done at once.
    pub fn begin(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<OdometryDecomposerSettings>")] settings: &JsValue,
    ) -> Result<(), JsValue> {
        self.configure(settings)
    }

    /// True: nothing is ever left to do.
    pub fn advance(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] _work: &JsValue,
    ) -> Result<bool, JsValue> {
        Ok(true)
    }

    /// A copy; changing it changes nothing.
    #[wasm_bindgen(getter, unchecked_return_type = "OdometryDecomposerSettings")]
    pub fn config(&self) -> Result<JsValue, JsValue> {
        settings_to_js(&self.settings())
    }

    /// How many outcomes there are now, 0 to `config.samples`.
    #[wasm_bindgen(getter)]
    pub fn shown(&self) -> usize {
        self.0.with(|machine| machine.poses().len())
    }

    /// Shows up to `count` outcomes more. Returns how many are shown then.
    pub fn grow(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] count: &JsValue,
    ) -> Result<usize, JsValue> {
        let count = whole("count", count, 0..=MAX_SAMPLES)? as usize;
        Ok(self.0.with(move |machine| machine.grow(count)))
    }

    /// As `grow`: it is done at once.
    #[wasm_bindgen(js_name = beginToGrow)]
    pub fn begin_to_grow(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] count: &JsValue,
    ) -> Result<(), JsValue> {
        self.grow(count).map(|_| ())
    }

    /// Shows none; the same outcomes come again.
    pub fn restart(&self) {
        self.0.with(OdometryDecomposer::restart);
    }

    /// x, y (m), θ (rad) of each outcome shown, in the frame of the odometry; a copy.
    #[wasm_bindgen(getter)]
    pub fn poses(&self) -> Result<Float64Array, JsValue> {
        doubles("samples", self.0.with(|machine| gathered(machine.poses().iter().map(numbers))))
    }

    /// The reading without noise, as four poses x, y, θ: the start, turned, at the end of the drive, and turned again.
    #[wasm_bindgen(getter)]
    pub fn linkage(&self) -> Result<Float64Array, JsValue> {
        float64_array(self.0.with(|machine| machine.linkage().map(|pose| numbers(&pose))).as_flattened())
    }

    /// The linkages of the first `count` outcomes shown, one after the other as `linkage` has it.
    pub fn ghosts(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] count: &JsValue,
    ) -> Result<Float64Array, JsValue> {
        let count = whole("count", count, 0..=MAX_SAMPLES)? as usize;
        let ghosts = self.0.with(move |machine| machine.ghosts(count));
        doubles("count", gathered(ghosts.as_flattened().iter().map(numbers)))
    }

    /// Where the robot is on its way.
    #[wasm_bindgen(getter, unchecked_return_type = "Start")]
    pub fn robot(&self) -> Result<JsValue, JsValue> {
        let pose = self.0.with(|machine| machine.robot());
        group_to_js(&mut numbers(&pose))
    }

    /// What each rule makes of the reading.
    #[wasm_bindgen(getter, unchecked_return_type = "RuleFigures[]")]
    pub fn rules(&self) -> Result<Array, JsValue> {
        let figures = |RuleFigures { rule, mut legs, deviations, cross_track, heading }: RuleFigures| {
            object(&[
                ("rule", rule.get().into()),
                ("legs", group_to_js(&mut legs)?),
                ("deviations", float64_array(&deviations)?.into()),
                ("crossTrack", cross_track.into()),
                ("heading", heading.into()),
            ])
        };
        self.0.with(|machine| machine.rules()).into_iter().map(figures).collect()
    }

    #[wasm_bindgen(getter, unchecked_return_type = "DecomposerStats")]
    pub fn stats(&self) -> Plain<Stats> {
        Plain(Ok(self.0.with(|machine| machine.stats())))
    }

    /// Against the length of the drive, from 0 to `longest` m: that length, the standard deviation across the bearing, the lever
    /// alone, and the standard deviation of the length, all in m, for each of `count` points.
    pub fn curve(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] longest: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] count: &JsValue,
    ) -> Result<Float64Array, JsValue> {
        let longest = in_range("longest", longest, &(0.0..=*QUANTITY.end()))?;
        let count = whole("count", count, 1..=MAX_CURVE_POINTS)? as usize;
        let point = |CurvePoint { trans, cross_track, lever, along }| [trans, cross_track, lever, along];
        doubles(
            "count",
            self.0.with(move |machine| gathered(machine.curve(longest, count).into_iter().map(point))),
        )
    }

    #[wasm_bindgen(getter, unchecked_return_type = "Drifted")]
    pub fn drifted(&self) -> Result<JsValue, JsValue> {
        let mut drifted = self.0.with(|machine| machine.drifted());
        let poses = [drifted.frame, drifted.from, drifted.to].map(|pose| numbers(&pose));
        object(&[
            ("poses", float64_array(poses.as_flattened())?.into()),
            ("legs", group_to_js(&mut drifted.legs)?),
        ])
    }

    /// The index of the outcome that ends nearest to a point and within `radius` of it; −1 for none.
    pub fn nearest(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] x: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] radius: &JsValue,
    ) -> Result<i32, JsValue> {
        let (target, radius) = read_disc(x, y, radius)?;
        Ok(self.0.with(move |machine| machine.nearest(target, radius)).map_or(-1, |index| index as i32))
    }
}

impl JsOdometryDecomposer {
    fn settings(&self) -> Settings {
        self.0.with(|machine| *machine.settings())
    }
}

fn numbers(pose: &SE2) -> [f64; 3] {
    [pose.x(), pose.y(), pose.theta()]
}
