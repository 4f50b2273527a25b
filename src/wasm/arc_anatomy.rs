//! `ArcAnatomy` for JavaScript.

use super::face::configured;
use super::fields::in_range;
use super::pictures::read_bounds;
use super::values::{flat, floats, object, plain};
use crate::sim::arc_anatomy::{ArcAnatomy, CHAPTERS_THRESHOLD, FormErrors, Paths, Surface, form_errors};
use js_sys::{Array, Float64Array, Uint8Array};
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** Root mean square errors of the end of a motion at 1 m/s for 0.1 s, m, over all headings, by the turn rate. */
export interface FormErrors {
  /** rad/s. */
  omega: Float64Array;
  /** Errors (m) of the formula with the arc’s radius. */
  arc: Float64Array;
  /** Errors (m) of the straight line. */
  straight: Float64Array;
  /** Errors (m) of the chord. */
  chord: Float64Array;
  /** Turn rate (rad/s) at which the errors of arc and straight line are estimated to be equal. */
  estimatedCrossover: number;
  /** Turn rate (rad/s) below which the chapter’s code uses the straight line. */
  threshold: number;
}

/** A map of positions. */
export interface AnatomySurface {
  columns: number;
  rows: number;
  /** Mapped value relative to its maximum, from 0 to 255, row by row from the top. All 0 if a noise has no variance. */
  shades: Uint8Array;
  /** Contours of p, at a half, a tenth and a hundredth of its highest value; x, y pairs, m. */
  prob: Float64Array[];
  /** Contours of the sampler's density at the same fractions of its maximum. */
  density: Float64Array[];
}

/** Points of lines, x, y pairs, m. */
export interface AnatomyPaths {
  commanded: Float64Array;
  inverted: Float64Array;
  driven: Float64Array;
  /** Path of the constant twist ξ. */
  lie: Float64Array;
  /**
   * Line segments that start on the path `lie`, as x, y, x, y in m. Each is the displacement that the lateral velocity at its start
   * would cause within Δt.
   */
  ticks: Float64Array;
}
"#;

configured!(
    /// The arc between two poses, and how likely it is after a command.
    JsArcAnatomy,
    ArcAnatomy,
    "ArcAnatomy",
    "ArcAnatomySettings",
    "Partial<ArcAnatomySettings>"
);

#[wasm_bindgen(js_class = ArcAnatomy)]
impl JsArcAnatomy {
    /// Errors of the forms of the arc at small turn rates: exercise 1.
    #[wasm_bindgen(js_name = formErrors, unchecked_return_type = "FormErrors")]
    pub fn form_errors() -> JsValue {
        let FormErrors { omega, arc, straight, chord, estimated_crossover } = form_errors();
        object(&[
            ("omega", floats(&omega)),
            ("arc", floats(&arc)),
            ("straight", floats(&straight)),
            ("chord", floats(&chord)),
            ("estimatedCrossover", estimated_crossover.into()),
            ("threshold", CHAPTERS_THRESHOLD.into()),
        ])
    }

    /// Returns everything that is shown besides the surface, in one call.
    #[wasm_bindgen(unchecked_return_type = "Pick<ArcAnatomy, 'config' | 'stats' | 'table' | 'paths'>")]
    pub fn read(&self) -> Result<JsValue, JsValue> {
        Ok(object(&[
            ("config", self.config()),
            ("stats", self.stats()?),
            ("table", self.table()?),
            ("paths", self.paths()),
        ]))
    }

    #[wasm_bindgen(getter, unchecked_return_type = "AnatomyStats")]
    pub fn stats(&self) -> Result<JsValue, JsValue> {
        plain(&self.0.stats())
    }

    #[wasm_bindgen(getter, unchecked_return_type = "AnatomyTable")]
    pub fn table(&self) -> Result<JsValue, JsValue> {
        plain(&self.0.table())
    }

    #[wasm_bindgen(getter, unchecked_return_type = "AnatomyPaths")]
    pub fn paths(&self) -> JsValue {
        let Paths { commanded, inverted, driven, lie, ticks } = self.0.paths();
        object(&[
            ("commanded", flat(&commanded).into()),
            ("inverted", flat(&inverted).into()),
            ("driven", flat(&driven).into()),
            ("lie", flat(&lie).into()),
            ("ticks", flat(&ticks).into()),
        ])
    }

    /// Surface over the positions of a rectangle (m), for the heading of the final pose; null for none.
    #[wasm_bindgen(unchecked_return_type = "AnatomySurface | null")]
    pub fn surface(
        &self,
        #[wasm_bindgen(js_name = xMin)] x_min: f64,
        #[wasm_bindgen(js_name = yMin)] y_min: f64,
        #[wasm_bindgen(js_name = xMax)] x_max: f64,
        #[wasm_bindgen(js_name = yMax)] y_max: f64,
    ) -> Result<JsValue, JsValue> {
        let [min, max] = read_bounds([x_min, y_min, x_max, y_max])?;
        let Some(Surface { columns, rows, shades, prob, density }) = self.0.surface(min, max) else {
            return Ok(JsValue::NULL);
        };
        let lines = |lines: &[Vec<[f64; 2]>]| lines.iter().map(|line| flat(line)).collect::<Array>().into();
        Ok(object(&[
            ("columns", (columns as f64).into()),
            ("rows", (rows as f64).into()),
            ("shades", Uint8Array::from(&shades[..]).into()),
            ("prob", lines(&prob)),
            ("density", lines(&density)),
        ]))
    }

    /// Poses after a share of the time, 0 to 1: x, y (m) and θ (rad) on the commanded arc, on the one that v̂ and ω̂
    /// drive, and on the way of constant twist.
    pub fn underway(&self, share: f64) -> Result<Float64Array, JsValue> {
        let poses = self.0.underway(in_range("share", share, &(0.0..=1.0))?);
        Ok(flat(&poses.map(|pose| [pose.x(), pose.y(), pose.theta()])))
    }
}
