//! `DeadReckoning` for JavaScript.

use super::fields::{not_shown_error, read_integer};
use super::pictures::nearest_index;
use super::simulation_class::{cloud_simulation_class, getters};
use super::values::{flat_float_array, js_object, number_or_null, to_plain_js, triple_array};
use crate::models::Compounding;
use crate::sim::dead_reckoning::{DeadReckoning, MAX_SAMPLES, MAX_STEPS, Settings};
use crate::sim::settings::Keywords;
use js_sys::{Array, Float64Array};
use nalgebra::{Matrix3, Vector3};
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPESCRIPT_TYPES: &str = r#"
/** Robots and outlines after a quarter of the path. */
export interface Milestone {
  /** Poses as in `posesAfter`. */
  poses: Float64Array;
  outlines: StepOutlines;
}
"#;

cloud_simulation_class! {
    /// One command driven step after step by many identical robots from (0, 0), heading along x, and the covariance that
    /// recursions predict of it. `headingNoise` sets α₃ to α₆.
    JsDeadReckoning(DeadReckoning), "DeadReckoning", "DeadReckoningSettings",
    "Partial<DeadReckoningSettings> & { headingNoise?: number }", MAX_SAMPLES
}

getters! {
    JsDeadReckoning, "DeadReckoning", |it| {
        /// Level h of the heading noise; null where α₃ to α₆ are not those of a level.
        heading_noise as headingNoise: "number | null" = number_or_null(it.settings().heading_noise());
        stats: "ReckoningStats" = to_plain_js(&it.stats());
        /// Predicted divided by measured variance of along, lateral and heading after each step, three numbers a step; NaN if
        /// undefined.
        ratios: "ByRecursion<Float64Array>" =
            js_by_recursion(|order| triple_array(it.comparison(order).ratios.iter().copied()));
        /// Predicted variances of along, lateral (m²) and heading (rad²) after each step, three numbers a step; NaN if
        /// undefined.
        predicted: "ByRecursion<Float64Array>" = js_by_recursion(|order| {
            let to_variances = |cov: &Matrix3<f64>| cov.diagonal();
            let covariances = it.predicted_covariances(order).iter();
            triple_array(covariances.map(|cov| cov.as_ref().map_or(Vector3::repeat(f64::NAN), to_variances)))
        });
        /// Measured variances, in the form of `predicted`.
        measured: "Float64Array" = triple_array(it.measured_moments().iter().map(|moments| moments.cov.diagonal()));
        /// Standard errors of the measured variances, relative to them.
        relative_errors as relativeErrors: "Float64Array" =
            triple_array(it.measured_moments().iter().map(|moments| moments.relative_error));
        /// Path driven without noise, as x, y pairs (m) from the start.
        commanded: "Float64Array" = flat_float_array(&it.commanded_path());
        /// Variances of a straight drive as functions of its duration, at this speed and noise. Each drive is one command.
        straight_growth as straightGrowth: "StraightGrowth" = to_plain_js(&it.straight_growth());
        /// x, y (m), θ (rad) of the commanded pose after each step.
        nominal: "Float64Array" = triple_array(it.nominal_poses().iter().copied());
        /// x, y (m), θ (rad) of the first robots after the selected step, 600 at most; a copy.
        poses: "Float64Array" = flat_float_array(it.poses(it.settings().step));
        /// Exponential coordinates (along and lateral in m, heading in rad) of the robots of `poses`, relative to the commanded pose; a copy.
        twists: "Float64Array" = triple_array(it.twists());
    }
}

#[wasm_bindgen(js_class = DeadReckoning)]
impl JsDeadReckoning {
    /// Returns everything that is shown, in one call. There is a milestone after each quarter of the path, except at the current step.
    #[wasm_bindgen(
        unchecked_return_type = "Pick<DeadReckoning, 'config' | 'shown' | 'block' | 'stats' | 'ratios' | 'relativeErrors' | 'commanded' | 'nominal' | 'poses' | 'twists'> & { outlines: StepOutlines; milestones: Milestone[] }"
    )]
    pub fn read(&self) -> Result<JsValue, JsValue> {
        let Settings { step, steps, .. } = *self.0.settings();
        let milestone_after = |after: u32| {
            let (poses, outlines) = (self.poses_after(after.into())?, self.outlines(after.into())?);
            Ok(js_object(&[("poses", poses.into()), ("outlines", outlines)]))
        };
        let milestones = quarters_of(steps).filter(|after| *after != step).map(milestone_after);
        Ok(js_object(&[
            ("config", self.config()),
            ("shown", self.shown_count()),
            ("block", self.block_size()),
            ("stats", self.stats()),
            ("ratios", self.ratios()),
            ("relativeErrors", self.relative_errors()),
            ("commanded", self.commanded()),
            ("nominal", self.nominal()),
            ("poses", self.poses()),
            ("twists", self.twists()),
            ("outlines", self.outlines(step.into())?),
            ("milestones", milestones.collect::<Result<Array, JsValue>>()?.into()),
        ]))
    }

    /// Poses as in `poses`, after another step from 1 to 200; empty if the path is shorter.
    #[wasm_bindgen(js_name = posesAfter)]
    pub fn poses_after(&self, step: f64) -> Result<Float64Array, JsValue> {
        Ok(flat_float_array(self.0.poses(read_integer("step", step, 1..=MAX_STEPS)? as u32)))
    }

    /// x, y (m), θ (rad) of one robot after each step, counted from 0.
    pub fn rollout(&self, index: f64) -> Result<Float64Array, JsValue> {
        let index = read_integer("index", index, 0..=MAX_SAMPLES as u64)? as usize;
        let poses = self.0.rollout(index).ok_or_else(|| not_shown_error(index, self.0.shown_count()))?;
        Ok(flat_float_array(&poses))
    }

    /// The robot of `poses` that is nearest to a point and within `radius` of it; −1 for none.
    pub fn nearest(&self, x: f64, y: f64, radius: f64) -> Result<i32, JsValue> {
        nearest_index(x, y, radius, |target, radius| self.0.nearest(target, radius))
    }

    /// Outlines of a step, 1 to 200, by the selected recursion; null where the path is shorter.
    #[wasm_bindgen(unchecked_return_type = "StepOutlines | null")]
    pub fn outlines(&self, step: f64) -> Result<JsValue, JsValue> {
        Ok(to_plain_js(&self.0.outlines(read_integer("step", step, 1..=MAX_STEPS)? as u32)))
    }
}

/// Returns the steps that end the quarters of a path; fewer if the path has less than four steps.
fn quarters_of(steps: u32) -> impl Iterator<Item = u32> {
    let mut quarter_ends: Vec<_> =
        (1..=4).map(|quarter| ((f64::from(quarter * steps) / 4.0).round() as u32).max(1)).collect();
    quarter_ends.dedup();
    quarter_ends.into_iter()
}

fn js_by_recursion(of: impl Fn(Compounding) -> Float64Array) -> JsValue {
    let recursion_entries: Vec<_> =
        Compounding::KEYWORDS.iter().map(|(word, order)| (*word, of(*order).into())).collect();
    js_object(&recursion_entries)
}
