//! `ArcAnatomy` for JavaScript.

use super::fields::{in_range, read_opening, read_settings};
use super::held::Held;
use super::pictures::read_grid;
use super::values::{Plain, bytes, float64_array, object, settings_to_js};
use crate::models::VelocityCmd;
use crate::sim::arc_anatomy::{
    ArcAnatomy, CHAPTERS_THRESHOLD, FormErrors, PRESETS, Paths, Preset, Settings, Stats, Surface, Table,
    form_errors,
};
use crate::sim::views::Grid;
use js_sys::{Array, Float64Array};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** An arc with its circle. */
export interface Bend {
  /** m; negative in reverse. */
  arcLength: number;
  /** rad, positive to the left. */
  turn: number;
  /** m; positive with the center to the left of the heading, infinite where the arc is straight. */
  radius: number;
  /** m; null where the arc is straight. */
  center: [number, number] | null;
  /** x, y (m) and θ (rad) where it ends. */
  end: [number, number, number];
}

/** One of the three factors of p. */
export interface Factor {
  /** v̂, ω̂ or γ̂ (m/s, rad/s). */
  estimate: number;
  /** v − v̂, ω − ω̂ or γ̂. */
  residual: number;
  /** Standard deviation of its noise. */
  deviation: number;
  /** residual/deviation: without noise 0 where the residual is 0 to rounding, and infinite elsewhere. */
  deviations: number;
  /** The density of the noise at the residual. */
  value: number;
  /** That over the density at 0, from 0 to 1. */
  share: number;
}

/** What the inversion finds, and how likely that is. */
export interface AnatomyStats {
  commanded: Bend;
  /** The arc to the final position. */
  inverted: Bend;
  /** The arc that v̂ and ω̂ drive: the inverted one, unless the radius is as printed. */
  driven: Bend;
  /** γ̂Δt, rad. */
  lastTurn: number;
  /** Of v̂, ω̂ and γ̂. */
  factors: [Factor, Factor, Factor];
  /** Which of them is the most deviations off, from 0. */
  weakest: number;
  /** p, the product of the three. */
  prob: number;
  /** p over that of the pose without noise, from 0 to 1. */
  share: number;
  /** The density of the sampler over dx dy dθ; null where a variance is 0. */
  density: number | null;
  /** Along (m), lateral (m), heading (rad). */
  xi: [number, number, number];
}

/** Table 5.1 line by line. */
export interface AnatomyTable {
  /** μ, x* and y* (m), r* (m), Δθ (rad), v̂ (m/s), ω̂ and γ̂ (rad/s), p. */
  lines: number[];
  /** The middle between both positions, from which the center is μ times `normal` away, m. */
  middle: [number, number];
  /** The displacement turned by a quarter to the left, m. */
  normal: [number, number];
}

/** Root mean square errors of the end of a motion at 1 m/s for 0.1 s, m, over all headings, by the turn rate. */
export interface FormErrors {
  /** rad/s. */
  omega: Float64Array;
  /** By the arc’s radius. */
  arc: Float64Array;
  /** By the straight line. */
  straight: Float64Array;
  /** By the chord. */
  chord: Float64Array;
  /** Where arc and straight line are estimated to be equally bad, rad/s. */
  estimatedCrossover: number;
  /** Where the chapter’s code goes over to the straight line, rad/s. */
  threshold: number;
}

/** A map of positions. */
export interface AnatomySurface {
  columns: number;
  rows: number;
  /** What is mapped over its highest value, in 255ths: cell by cell, row by row from the top. All 0 where a noise has no variance. */
  shades: Uint8Array;
  /** Contours of p, at a half, a tenth and a hundredth of its highest value; x, y pairs, m. */
  prob: Float64Array[];
  /** The same of the density of the sampler. */
  density: Float64Array[];
}

/** Points of lines, x, y pairs, m. */
export interface AnatomyPaths {
  commanded: Float64Array;
  inverted: Float64Array;
  driven: Float64Array;
  /** Of constant twist. */
  lie: Float64Array;
  /** From points of that, each x, y, to where its lateral velocity alone would lead in the whole time, x, y. */
  ticks: Float64Array;
}
"#;

/// Shares of a motion.
const SHARE: RangeInclusive<f64> = 0.0..=1.0;

/// The arc between two poses, and how likely it is after a command. Metres, radians, seconds throughout. Whatever is out of
/// range throws a TypeError or RangeError that names the field, and changes nothing.
#[wasm_bindgen(js_name = ArcAnatomy)]
pub struct JsArcAnatomy(Held<ArcAnatomy>);

#[wasm_bindgen(js_class = ArcAnatomy)]
impl JsArcAnatomy {
    /// What is left out is as the widget opens.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(unchecked_optional_param_type = "Partial<ArcAnatomySettings>")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(ArcAnatomy::new(read_opening(options)?)?)))
    }

    #[wasm_bindgen(getter, unchecked_return_type = "ArcAnatomyPreset[]")]
    pub fn presets() -> Result<Array, JsValue> {
        let preset = |Preset { name, command: VelocityCmd { v, omega, dt }, next }: Preset| {
            object(&[
                ("name", name.into()),
                ("v", v.into()),
                ("omega", omega.into()),
                ("dt", dt.into()),
                ("nextX", next.x.into()),
                ("nextY", next.y.into()),
                ("nextTheta", next.theta.into()),
            ])
        };
        PRESETS.into_iter().map(preset).collect()
    }

    /// What the forms of the arc lose at small turn rates: exercise 1.
    #[wasm_bindgen(js_name = formErrors, unchecked_return_type = "FormErrors")]
    pub fn form_errors() -> Result<JsValue, JsValue> {
        let FormErrors { omega, arc, straight, chord, estimated_crossover } = form_errors();
        object(&[
            ("omega", float64_array(&omega)?.into()),
            ("arc", float64_array(&arc)?.into()),
            ("straight", float64_array(&straight)?.into()),
            ("chord", float64_array(&chord)?.into()),
            ("estimatedCrossover", estimated_crossover.into()),
            ("threshold", CHAPTERS_THRESHOLD.into()),
        ])
    }

    /// Changes the settings that are named.
    pub fn configure(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<ArcAnatomySettings>")] settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.configure(settings))?)
    }

    /// A copy; changing it changes nothing.
    #[wasm_bindgen(getter, unchecked_return_type = "ArcAnatomySettings")]
    pub fn config(&self) -> Result<JsValue, JsValue> {
        settings_to_js(&self.settings())
    }

    #[wasm_bindgen(getter, unchecked_return_type = "AnatomyStats")]
    pub fn stats(&self) -> Plain<Stats> {
        Plain(Ok(self.0.with(|machine| machine.stats())))
    }

    #[wasm_bindgen(getter, unchecked_return_type = "AnatomyTable")]
    pub fn table(&self) -> Plain<Table> {
        Plain(Ok(self.0.with(|machine| machine.table())))
    }

    #[wasm_bindgen(getter, unchecked_return_type = "AnatomyPaths")]
    pub fn paths(&self) -> Result<JsValue, JsValue> {
        let Paths { commanded, inverted, driven, lie, ticks } = self.0.with(|machine| machine.paths());
        object(&[
            ("commanded", float64_array(commanded.as_flattened())?.into()),
            ("inverted", float64_array(inverted.as_flattened())?.into()),
            ("driven", float64_array(driven.as_flattened())?.into()),
            ("lie", float64_array(lie.as_flattened())?.into()),
            ("ticks", float64_array(ticks.as_flattened())?.into()),
        ])
    }

    /// What is mapped over the positions of a rectangle (m), for the heading of the final pose; null for nothing.
    #[wasm_bindgen(unchecked_return_type = "AnatomySurface | null")]
    pub fn surface(
        &self,
        #[wasm_bindgen(js_name = xMin, unchecked_param_type = "number")] x_min: &JsValue,
        #[wasm_bindgen(js_name = yMin, unchecked_param_type = "number")] y_min: &JsValue,
        #[wasm_bindgen(js_name = xMax, unchecked_param_type = "number")] x_max: &JsValue,
        #[wasm_bindgen(js_name = yMax, unchecked_param_type = "number")] y_max: &JsValue,
    ) -> Result<JsValue, JsValue> {
        // Of its own number of cells.
        let one = JsValue::from(1);
        let Grid { min, max, .. } = read_grid([x_min, y_min, x_max, y_max], &one, &one)?;
        let surface = self.0.with(move |machine| machine.surface(min, max));
        let Some(Surface { columns, rows, shades, prob, density }) = surface else {
            return Ok(JsValue::NULL);
        };
        let lines = |lines: Vec<Vec<[f64; 2]>>| -> Result<Array, JsValue> {
            lines.iter().map(|line| float64_array(line.as_flattened())).collect()
        };
        object(&[
            ("columns", (columns as f64).into()),
            ("rows", (rows as f64).into()),
            ("shades", bytes("map", Some(shades))?.into()),
            ("prob", lines(prob)?.into()),
            ("density", lines(density)?.into()),
        ])
    }

    /// Where the robot is after a share of the time, 0 to 1: x, y (m) and θ (rad) on the commanded arc, on the one that v̂ and ω̂
    /// drive, and on the way of constant twist.
    pub fn underway(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] share: &JsValue,
    ) -> Result<Float64Array, JsValue> {
        let share = in_range("share", share, &SHARE)?;
        let poses = self.0.with(move |machine| machine.underway(share));
        float64_array(poses.map(|pose| [pose.x(), pose.y(), pose.theta()]).as_flattened())
    }
}

impl JsArcAnatomy {
    fn settings(&self) -> Settings {
        self.0.with(|machine| *machine.settings())
    }
}
