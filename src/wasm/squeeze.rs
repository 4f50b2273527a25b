//! JavaScript class `MapSqueeze`.

use super::fields::{quote_text, read_integer, read_value};
use super::maps::{read_map, read_plan};
use super::pictures::{nearest_index, pixel_view, read_grid, read_ramps};
use super::simulation_class::cloud_simulation_class;
use super::values::{ToJs, flat_float_array, pose_to_js, to_plain_js, to_ts, triple_array};
use crate::geom::arc::Arc;
use crate::geom::segment::Segment;
use crate::js::js_structs;
use crate::map::{Cell, Cost, FloorPlan, MAX_DRAWS, Sampler};
use crate::sim::settings::KeywordSetting;
use crate::sim::squeeze::{Attempt, MAX_SAMPLES, MAX_STEPS, MAX_TRIAL_PARTS, MapSqueeze, max_draws};
use js_sys::{Array, Float64Array, RangeError, Uint8ClampedArray};
use tsify::Ts;
use wasm_bindgen::prelude::*;

js_structs! {
    /// Floor plan of the simulation; lengths in m.
    pub struct Plan {
        /// Smallest x and y, and largest x and y, of the map.
        pub bounds: [f64; 4] as "Float64Array",
        /// Walls as the coordinates of both ends, x0, y0, x1, y1, of each wall.
        pub walls: Vec<[f64; 4]> as "Float64Array",
    }

    /// Occupancy grid of a map. Cells are listed row by row from the bottom.
    pub struct Grid {
        pub columns: usize,
        pub rows: usize,
        /// Side of a cell, m.
        pub resolution: f64,
        /// x, y (m) and yaw (rad) of the lower left corner of the grid.
        pub origin: [f64; 3] as "Float64Array",
        /// One byte for each cell: 1 if occupied, 0 otherwise.
        pub occupied: Vec<u8> as "Uint8Array",
        /// One byte for each cell: 1 if unknown, 0 otherwise.
        pub unknown: Vec<u8> as "Uint8Array",
    }
}

cloud_simulation_class! {
    /// Many attempts of a round robot to drive one command on a map. At first the robot faces a doorway in the apartment. `noise` sets all
    /// of `alphas`.
    JsMapSqueeze(MapSqueeze), "MapSqueeze", "MapSqueezeSettings",
    "Partial<MapSqueezeSettings> & { noise?: number }", MAX_SAMPLES, |simulation|
    /// All values that a figure shows, except for the map, in one call.
    read as "MapSqueezeView" {
        stats: "SqueezeStats" = to_plain_js(&simulation.stats());
        /// Outcome of each attempt as one byte: 1 for a free end, plus 2 for a free path, plus 4 if it is accepted.
        verdicts: "Uint8Array" =
            simulation.attempts().iter().map(Attempt::verdict_bits).collect::<Vec<_>>().to_js();
        /// x, y (m), θ (rad) at the end of each attempt shown (motion, accepted or rejected); a copy.
        poses: "Float64Array" = triple_array(simulation.attempts().iter().map(|attempt| attempt.pose));
        /// Noise-free path of the command, as x, y pairs.
        commanded: "Float64Array" = flat_float_array(&simulation.commanded_arc().points());
        /// True if the robot collides with nothing at its start pose.
        is_start_free as "startFree": "boolean" = simulation.is_start_free();
        /// Paths of the first attempts that are accepted through a wall, each as x, y pairs.
        wall_paths as "paths": "Float64Array[]" = {
            let indexed_attempts = simulation.attempts().iter().enumerate();
            let through_wall = indexed_attempts.filter(|(_, attempt)| attempt.is_through_wall()).take(MAX_SHOWN_PATHS);
            through_wall.map(|(index, _)| path_of(simulation, index)).collect::<Array>()
        };
    }
    others {
        /// Noise level n; null unless the first four noise parameters are n, and the others n/4.
        noise: "number | null" = to_plain_js(&simulation.settings().noise());
        plan: "Plan" = {
            let wall_coordinates_of = |Segment { from, to }: &Segment| [from[0], from[1], to[0], to[1]];
            let walls = simulation.plan().walls().iter().map(wall_coordinates_of).collect();
            to_plain_js(&Plan { bounds: simulation.plan().bounds(), walls })
        };
        /// Cells of the map; null for a floor plan that has walls only.
        grid: "Grid | null" = to_plain_js(&simulation.plan().grid().map(|grid| {
            let ([column_count, row_count], origin) = (grid.size(), grid.origin().into());
            let cell_flags_of = |cell_state| grid.cells().map(|grid_cell| u8::from(grid_cell == cell_state)).collect();
            let [occupied_flags, unknown_flags] = [Cell::Occupied, Cell::Unknown].map(cell_flags_of);
            Grid { columns: column_count, rows: row_count, resolution: grid.resolution(), origin, occupied: occupied_flags, unknown: unknown_flags }
        }));
        /// Free start pose: in the middle of the largest square that is known to be free, heading where the path is free for longest. If
        /// the robot does not fit there, it is another pose where the robot fits; null if there is none.
        find_free_pose as "openPlace": "Start | null" =
            simulation.plan().find_free_pose(simulation.settings().clearance).map_or(JsValue::NULL, |pose| pose_to_js(pose).into());
    }
}

#[wasm_bindgen(js_class = MapSqueeze)]
impl JsMapSqueeze {
    /// Replaces the map by a floor plan { bounds: [x, y, x, y], walls: [[x, y, x, y], …] } in m, as in JSON; by the apartment if it is
    /// undefined.
    #[wasm_bindgen(js_name = setPlan)]
    pub fn set_plan(
        &mut self,
        #[wasm_bindgen(unchecked_optional_param_type = "unknown")] plan: &JsValue,
    ) -> Result<(), JsValue> {
        self.0.set_plan(if plan.is_undefined() { FloorPlan::apartment() } else { read_plan(plan)? });
        Ok(())
    }

    /// Replaces the map by a grid, from the fields of the YAML file of map_server, and the bytes of a PGM file or the pixels of another
    /// image. The core with all simulations also takes the bytes of a PNG file.
    #[wasm_bindgen(js_name = setGrid)]
    pub fn set_grid(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "unknown")] description: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array | Pick<ImageData, 'width' | 'height' | 'data'>")]
        image: &JsValue,
    ) -> Result<(), JsValue> {
        Ok(self.0.set_grid(read_map(description, image)?)?)
    }

    /// Returns the path driven in an attempt, as x, y pairs; empty if the attempt is not shown.
    pub fn path(&self, index: f64) -> Result<Float64Array, JsValue> {
        Ok(path_of(&self.0, read_integer("index", index, 0..=MAX_SAMPLES as u64)? as usize))
    }

    /// Returns the point (x, y) of a wall that the robot touches first in an attempt; undefined if it touches no wall.
    #[wasm_bindgen(js_name = firstContact)]
    pub fn first_contact(&self, index: usize) -> Option<Vec<f64>> {
        self.0.first_contact(index).map(Vec::from)
    }

    /// Draws `count` accepted samples with a sampler and discards them, to measure the time. Throws if too many draws are rejected.
    pub fn trial(
        &self,
        #[wasm_bindgen(unchecked_param_type = "MapSqueezeSettings['sampler']")] sampler: &JsValue,
        steps: f64,
        count: f64,
    ) -> Result<Ts<Cost>, JsValue> {
        let steps = read_integer("steps", steps, 1..=MAX_STEPS)?;
        let sampler = read_value("sampler", sampler, Sampler::Endpoint, ())?.with_part_count(steps as u32);
        let attempt_count = read_integer("count", count, 1..=MAX_TRIAL_PARTS / steps)? as usize;
        let trial_cost = self.0.sampling_trial(sampler, attempt_count).map_err(|no_sample| {
            let max_total_draws = max_draws(sampler.part_count() as usize * attempt_count);
            RangeError::new(&format!(
                "sampler is {}, by which {no_sample}; allowed is one of at most {MAX_DRAWS} draws an accepted sample and {max_total_draws} \
                 for {attempt_count} of them",
                quote_text(sampler.get()),
            ))
        })?;
        Ok(to_ts(&trial_cost))
    }

    /// Returns the density of the ends of the attempts shown, as RGBA pixels of a grid, row by row from the top. `bounds` are xMin, yMin,
    /// xMax and yMax of the grid. `ramps` are three ramps of 256 colours: for rejected attempts, accepted attempts, and attempts accepted
    /// through a wall. The most frequent kind in a cell selects the ramp. A count c of attempts in the cell has the colour
    /// ramp[255·√(c/max)], where max is the largest count of all cells. Empty cells are transparent. The result is a view of the core's
    /// memory, valid until the next call of the simulation.
    #[wasm_bindgen(unchecked_return_type = "Uint8ClampedArray<ArrayBuffer>")]
    pub fn picture(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "ArrayLike<number>")] bounds: &JsValue,
        columns: f64,
        rows: f64,
        ramps: &[u8],
    ) -> Result<Uint8ClampedArray, JsValue> {
        let grid = read_grid(bounds, columns, rows)?;
        let ramps = read_ramps("ramps", ramps)?;
        Ok(pixel_view(self.0.paint_picture(&grid, &ramps)))
    }

    /// Returns the index of the attempt (accepted or rejected motion) that ends nearest to a point and within `radius` of it; −1 for none.
    pub fn nearest(&self, x: f64, y: f64, radius: f64) -> Result<i32, JsValue> {
        nearest_index(x, y, radius, |target_point, radius| self.0.find_nearest(target_point, radius))
    }
}

fn path_of(map_simulation: &MapSqueeze, index: usize) -> Float64Array {
    flat_float_array(&map_simulation.arcs(index).iter().flat_map(Arc::points).collect::<Vec<_>>())
}

/// Maximum number of paths shown. More paths would be indistinguishable, and take longer than a frame.
const MAX_SHOWN_PATHS: usize = 60;

/// Decodes a PNG image to red, green, blue and opacity of its pixels, also for modules of single widgets, which have no decoder.
#[cfg(not(widget))]
#[wasm_bindgen(
    js_name = readMapImage,
    unchecked_return_type = "{ width: number; height: number; data: Uint8ClampedArray<ArrayBuffer> }"
)]
pub fn read_map_image(bytes: &[u8]) -> Result<JsValue, JsValue> {
    let image = crate::map::read_png(bytes).map_err(|error| RangeError::new(&error.to_string()))?;
    Ok(super::values::js_object(&[
        ("width", (image.width as f64).into()),
        ("height", (image.height as f64).into()),
        ("data", js_sys::Uint8ClampedArray::from(image.pixels.as_flattened()).into()),
    ]))
}
