//! JavaScript class `DeadReckoning`.

use super::fields::{not_shown_error, read_integer};
use super::pictures::nearest_index;
use super::simulation_class::cloud_simulation_class;
use super::values::{flat_float_array, js_object, to_plain_js, triple_array};
use crate::models::Compounding;
use crate::sim::dead_reckoning::{DeadReckoning, MAX_SAMPLES};
use crate::sim::settings::HasKeywords;
use js_sys::Float64Array;
use nalgebra::{Matrix3, Vector3};
use wasm_bindgen::prelude::*;

cloud_simulation_class! {
    /// One command driven step after step by many identical robots from (0, 0), heading along x, and the covariances that recursions
    /// predict. `headingNoise` sets α₃ to α₆.
    JsDeadReckoning(DeadReckoning), "DeadReckoning", "DeadReckoningSettings",
    "Partial<DeadReckoningSettings> & { headingNoise?: number }", MAX_SAMPLES, |simulation|
    /// All values that a figure shows, in one call.
    read as "DeadReckoningView" {
        stats: "ReckoningStats" = to_plain_js(&simulation.stats());
        /// Predicted divided by measured variance of along, lateral and heading after each step, three numbers a step; NaN if undefined.
        ratios: "ByRecursion<Float64Array>" =
            js_by_recursion(|compounding| triple_array(simulation.comparison(compounding).ratios.iter().copied()));
        /// Standard errors of the measured variances, as fractions of the variances.
        relative_errors as "relativeErrors": "Float64Array" =
            triple_array(simulation.measured_moments().iter().map(|moments| moments.relative_error));
        /// Path driven without noise, as x, y pairs (m) from the start.
        commanded: "Float64Array" = flat_float_array(&simulation.commanded_path());
        /// x, y (m), θ (rad) of the commanded pose after each step.
        nominal: "Float64Array" = triple_array(simulation.nominal_poses().iter().copied());
        /// x, y (m), θ (rad) of the first robots after the selected step, 600 at most; a copy.
        poses: "Float64Array" = flat_float_array(simulation.poses(simulation.settings().step));
        /// Exponential coordinates (along and lateral in m, heading in rad) of the robots of `poses`, relative to the commanded pose; a
        /// copy.
        twists: "Float64Array" = triple_array(simulation.twists());
        /// Outlines of the selected step, by the selected recursion.
        outlines: "StepOutlines" = to_plain_js(&simulation.outlines(simulation.settings().step));
        /// Robots and outlines after each quarter of the path, except at the selected step.
        milestones: "Milestone[]" = to_plain_js(&simulation.milestones());
    }
    others {
        /// Level h of the heading noise; null unless α₃ and α₄ are h, and α₅ and α₆ are h/4.
        heading_noise as "headingNoise": "number | null" = to_plain_js(&simulation.settings().heading_noise());
        /// Predicted variances of along, lateral (m²) and heading (rad²) after each step, three numbers a step; NaN if undefined.
        predicted: "ByRecursion<Float64Array>" = js_by_recursion(|compounding| {
            let to_variances = |cov: &Matrix3<f64>| cov.diagonal();
            let cov_matrices = simulation.predicted_covariances(compounding).iter();
            triple_array(cov_matrices.map(|cov| cov.as_ref().map_or(Vector3::repeat(f64::NAN), to_variances)))
        });
        /// Measured variances, in the form of `predicted`.
        measured: "Float64Array" = triple_array(simulation.measured_moments().iter().map(|moments| moments.cov.diagonal()));
        /// Variances of a straight drive as functions of its duration, at the present speed and noise. Each drive is one command.
        straight_growth as "straightGrowth": "StraightGrowth" = to_plain_js(&simulation.straight_growth());
    }
}

#[wasm_bindgen(js_class = DeadReckoning)]
impl JsDeadReckoning {
    /// Returns x, y (m), θ (rad) after each step of one robot, by its index, counted from 0.
    pub fn rollout(&self, index: f64) -> Result<Float64Array, JsValue> {
        let index = read_integer("index", index, 0..=MAX_SAMPLES as u64)? as usize;
        let poses = self.0.rollout(index).ok_or_else(|| not_shown_error(index, self.0.shown_count()))?;
        Ok(flat_float_array(&poses))
    }

    /// Returns the index in `poses` of the robot that is nearest to a point and within `radius` of it; −1 for none.
    pub fn nearest(&self, x: f64, y: f64, radius: f64) -> Result<i32, JsValue> {
        nearest_index(x, y, radius, |target_point, radius| self.0.find_nearest(target_point, radius))
    }
}

fn js_by_recursion(value_of: impl Fn(Compounding) -> Float64Array) -> JsValue {
    let recursion_entries: Vec<_> = Compounding::KEYWORDS
        .iter()
        .map(|(recursion_name, compounding)| (*recursion_name, value_of(*compounding).into()))
        .collect();
    js_object(&recursion_entries)
}
