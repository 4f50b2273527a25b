//! JavaScript class `OdometryDecomposer`.

use super::fields::{check_range, read_integer};
use super::pictures::nearest_index;
use super::simulation_class::cloud_simulation_class;
use super::values::{flat_float_array, pose_to_js, to_plain_js, triple_array};
use crate::sim::odometry_decomposer::{MAX_CURVE_POINTS, MAX_SAMPLES, OdometryDecomposer};
use crate::sim::settings::QUANTITY_RANGE;
use js_sys::Float64Array;
use wasm_bindgen::prelude::*;

cloud_simulation_class! {
    /// Odometry reading as rotation, drive and rotation, and its noise under the rules of several localizers.
    JsOdometryDecomposer(OdometryDecomposer), "OdometryDecomposer", "OdometryDecomposerSettings",
    "Partial<OdometryDecomposerSettings>", MAX_SAMPLES, |simulation|
    /// All values that a figure shows, in one call.
    read as "OdometryDecomposerView" {
        stats: "DecomposerStats" = to_plain_js(&simulation.stats());
        /// Decomposition of the reading and its noise by each odometry rule.
        rules: "RuleNoise[]" = to_plain_js(&simulation.rule_noises());
        /// x, y (m), θ (rad) of each outcome shown (end pose drawn with noise), in the odometry frame; a copy.
        poses: "Float64Array" = triple_array(simulation.poses().iter().copied());
        /// Noise-free reading as four poses x, y, θ: at the start, after the first rotation, after the drive, after the second rotation.
        leg_poses as "linkage": "Float64Array" = triple_array(simulation.leg_poses());
        /// Pose of the robot at the progress that the setting `phase` gives.
        robot: "Start" = pose_to_js(simulation.robot_pose());
        drifted: "Drifted" = to_plain_js(&simulation.drifted_odometry());
        /// Poses of the outcomes that are shown, one outcome after the other. Each has four poses, in the form of `linkage`.
        sample_leg_poses as "ghosts": "Float64Array" =
            triple_array(simulation.sample_leg_poses(MAX_SHOWN_LINKAGES).into_iter().flatten());
    }
    others {}
}

#[wasm_bindgen(js_class = OdometryDecomposer)]
impl JsOdometryDecomposer {
    /// Returns standard deviations for `count` lengths of the drive from 0 to `longest` (m). A point of the curve has four numbers in m.
    /// They are the length of the drive, the standard deviation of the end position across the bearing, its part due to the first rotation,
    /// and the standard deviation of the length.
    pub fn curve(&self, longest: f64, count: f64) -> Result<Float64Array, JsValue> {
        let max_length = check_range("longest", longest, &(0.0..=*QUANTITY_RANGE.end()))?;
        let count = read_integer("count", count, 1..=MAX_CURVE_POINTS)? as usize;
        Ok(flat_float_array(&self.0.deviation_curve(max_length, count)))
    }

    /// Returns the index of the outcome (noisy end pose) that is nearest to a point and within `radius` of it; −1 for none.
    pub fn nearest(&self, x: f64, y: f64, radius: f64) -> Result<i32, JsValue> {
        nearest_index(x, y, radius, |target_point, radius| self.0.find_nearest(target_point, radius))
    }
}

/// Maximum number of outcomes for which rotation, translation and rotation are drawn as lines. More lines would hide the lines of the
/// noise-free reading.
const MAX_SHOWN_LINKAGES: usize = 12;
