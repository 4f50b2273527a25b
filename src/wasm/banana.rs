//! JavaScript class `BananaMachine`.

use std::ops::RangeInclusive;

use super::fields::{check_range, not_shown_error, read_integer};
use super::pictures::{RADIUS_RANGE, pixel_view, read_grid, read_ramps};
use super::simulation_class::cloud_simulation_class;
use super::values::{flat_float_array, js_array, js_object, to_plain_js, to_ts, triple_array};
use crate::geom::se2::SE2;
use crate::geom::unbend::unbend_line;
use crate::sim::banana::{BananaMachine, MAX_CURVE_POINTS, MAX_SAMPLES, OUTLINE_SEGMENTS, Sample};
use crate::sim::settings::QUANTITY_RANGE;
use crate::sim::views::MORPH_RANGE;
use crate::stats::{ExponentialContour, ExponentialMoments};
use js_sys::{Float64Array, RangeError, Uint8ClampedArray, Uint32Array};
use nalgebra::{Matrix3, Vector3};
use tsify::Ts;
use wasm_bindgen::prelude::*;

cloud_simulation_class! {
    /// One command from the origin, many robots that execute it with noise, and Gaussians fitted to their end poses.
    JsBananaMachine(BananaMachine), "BananaMachine", "BananaMachineSettings", "Partial<BananaMachineSettings>", MAX_SAMPLES, |simulation|
    /// All values that a figure shows, except for the robots, in one call.
    read as "BananaMachineView" {
        stats: "Stats" = to_plain_js(simulation.stats());
        contours: "Contours" = to_plain_js(&simulation.contours());
        /// Up to two positions inside the 2σ ellipse where practically no robot ends, as x, y pairs in m; empty if the outlines nearly
        /// coincide.
        gaps: "Float64Array" = flat_float_array(&simulation.gaps());
        table: "Table" = to_plain_js(&simulation.table());
        /// True if the robots turn by less than a full circle, so that exponential coordinates are defined. Otherwise statistics and
        /// contours in exponential coordinates are undefined.
        is_exponential_defined as "chartHolds": "boolean" = simulation.is_exponential_defined();
        /// Noise parameters of each model. A model that is not selected keeps its own parameters.
        alphas_of_models as "alphasOfModels": "{ velocity: number[]; odometry: number[] }" = js_object(&[
            ("velocity", js_array(&simulation.settings().velocity_alphas)),
            ("odometry", js_array(&simulation.settings().odometry_alphas)),
        ]);
        /// Noise-free odometry reading of the command.
        reading: "OdomDelta" = to_plain_js(&simulation.reading());
    }
    others {
        /// x, y (m), θ (rad) of each sample shown; a copy.
        poses: "Float64Array" = triple_array(simulation.poses());
        /// Exponential coordinates ξ of each sample shown: three numbers, along and lateral (m) and heading (rad). A copy.
        twists: "Float64Array" = triple_array(simulation.twists());
        /// Motion executed by each sample shown: v̂ (m/s), ω̂, γ̂ (rad/s); or δ̂_rot1 (rad), δ̂_trans (m), δ̂_rot2 (rad) under the odometry
        /// model. A copy.
        executed_motions as "executed": "Float64Array" = triple_array(simulation.executed_motions());
    }
}

#[wasm_bindgen(js_class = BananaMachine)]
impl JsBananaMachine {
    /// Returns `poses` of the first `count` samples, or of all samples if there are fewer.
    #[wasm_bindgen(js_name = firstPoses)]
    pub fn first_poses(&self, count: usize) -> Float64Array {
        triple_array(self.0.poses().take(count))
    }

    /// Returns `twists` of the first `count` samples, or of all samples if there are fewer.
    #[wasm_bindgen(js_name = firstTwists)]
    pub fn first_twists(&self, count: usize) -> Float64Array {
        triple_array(self.0.twists().take(count))
    }

    /// Returns the exact cross-track skew at 2 to 10 000 evenly spaced turn rates (rad/s); NaN where it is undefined.
    #[wasm_bindgen(js_name = skewCurve)]
    pub fn skew_curve(
        &self,
        #[wasm_bindgen(js_name = omegaMin)] omega_min: f64,
        #[wasm_bindgen(js_name = omegaMax)] omega_max: f64,
        points: f64,
    ) -> Result<Vec<f64>, JsValue> {
        let first_omega = check_range("omegaMin", omega_min, &QUANTITY_RANGE)?;
        let last_omega = check_range("omegaMax", omega_max, &QUANTITY_RANGE)?;
        let point_count = read_integer("points", points, 2..=MAX_CURVE_POINTS)?;
        Ok(self.0.skew_curve(first_omega, last_omega, point_count as usize))
    }

    /// Returns a shown sample by its index, counted from 0.
    pub fn inspect(&self, index: f64) -> Result<Ts<Sample>, JsValue> {
        let index = read_integer("index", index, 0..=MAX_SAMPLES as u64)? as usize;
        let pose_sample =
            self.0.inspect(index).ok_or_else(|| not_shown_error(index, self.0.shown_count()))?;
        Ok(to_ts(&pose_sample))
    }

    /// Returns the index of the nearest sample inside the ellipse with these semi-axes around a point of the picture; −1 for none. `morph`
    /// is the stage of the picture, from 0 (the plane) to 1 (exponential coordinates).
    pub fn nearest(
        &self,
        morph: f64,
        x: f64,
        y: f64,
        #[wasm_bindgen(js_name = radiusX)] radius_x: f64,
        #[wasm_bindgen(js_name = radiusY)] radius_y: f64,
    ) -> Result<i32, JsValue> {
        let search_radii = [
            check_range("radiusX", radius_x, &RADIUS_RANGE)?,
            check_range("radiusY", radius_y, &RADIUS_RANGE)?,
        ];
        let nearest = self.0.find_nearest(check_range("morph", morph, &MORPH_RANGE)?, [x, y], search_radii);
        Ok(nearest.map_or(-1, |index| index as i32))
    }

    /// Returns the number of samples in each cell of a grid over a part of the picture, row by row from yMax down. `bounds` are xMin, yMin,
    /// xMax and yMax. The grid has at most 2²⁴ cells, and at most 2¹⁴ on a side.
    pub fn density(
        &self,
        morph: f64,
        #[wasm_bindgen(unchecked_param_type = "ArrayLike<number>")] bounds: &JsValue,
        columns: f64,
        rows: f64,
    ) -> Result<Uint32Array, JsValue> {
        let view_grid = read_grid(bounds, columns, rows)?;
        Ok(Uint32Array::from(&self.0.density(check_range("morph", morph, &MORPH_RANGE)?, &view_grid)[..]))
    }

    /// Returns the `density` of the samples as RGBA pixels. A count c has the colour ramp[255·√(c/max)], one of 256, where max is the
    /// largest count. Empty cells are transparent. The result is a view of the core's memory, valid until the next call of the simulation.
    #[wasm_bindgen(unchecked_return_type = "Uint8ClampedArray<ArrayBuffer>")]
    pub fn picture(
        &mut self,
        morph: f64,
        #[wasm_bindgen(unchecked_param_type = "ArrayLike<number>")] bounds: &JsValue,
        columns: f64,
        rows: f64,
        ramp: &[u8],
    ) -> Result<Uint8ClampedArray, JsValue> {
        let view_grid = read_grid(bounds, columns, rows)?;
        let [colour_ramp] = read_ramps("ramp", ramp)?;
        Ok(pixel_view(self.0.paint_picture(
            check_range("morph", morph, &MORPH_RANGE)?,
            &view_grid,
            &colour_ramp,
        )))
    }
}

/// Range of turns of commands, rad: the product of the ranges of turn rate and duration.
const TURN_RANGE: RangeInclusive<f64> = -1e12..=1e12;

/// Returns a polyline at a stage of the transition from positions (0) to exponential coordinates (1), as x, y pairs in m. Each of `points`
/// is a position (x, y), and counts as the end of the arc whose turn is nearest to `turn` (rad). The result is empty for a polyline around
/// the start.
#[wasm_bindgen(js_name = unbendLine)]
pub fn js_unbend_line(points: &[f64], turn: f64, morph: f64) -> Result<Float64Array, JsValue> {
    let (turn, morph) = (check_range("turn", turn, &TURN_RANGE)?, check_range("morph", morph, &MORPH_RANGE)?);
    Ok(flat_float_array(&unbend_line(points.as_chunks().0, turn, morph)))
}

/// Returns the 2σ outline of a Gaussian in exponential coordinates, as x, y pairs. `morph` is the stage of the transition from positions
/// (0) to exponential coordinates (1). `moments` are the Gaussian's mean (three numbers) and covariance (nine numbers).
#[wasm_bindgen(js_name = unbendGaussian)]
pub fn js_unbend_gaussian(moments: &[f64], morph: f64) -> Result<Float64Array, JsValue> {
    let morph = check_range("morph", morph, &MORPH_RANGE)?;
    let (mean, cov) = moments
        .split_at_checked(3)
        .filter(|(_, cov)| cov.len() == 9)
        .ok_or_else(|| RangeError::new(&format!("moments has length {}; allowed is 12", moments.len())))?;
    let moments =
        ExponentialMoments { mean: Vector3::from_column_slice(mean), cov: Matrix3::from_row_slice(cov) };
    Ok(flat_float_array(
        &ExponentialContour::new(&moments, &SE2::identity()).morphed_boundary(OUTLINE_SEGMENTS, morph),
    ))
}
