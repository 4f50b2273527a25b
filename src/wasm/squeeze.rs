//! `MapSqueeze` for JavaScript.

use super::fields::{in_range, no_memory, quoted, read_opening, read_settings, whole, word, work};
use super::held::Held;
use super::maps::{read_map, read_plan};
use super::pictures::{place_of, read_disc, read_grid, read_ramps, view_of};
use super::values::{
    Plain, bytes, bytes_in_pieces, doubles, float64_array, gathered, group_to_js, number_or_null, object,
    settings_to_js,
};
use crate::geom::segment::Segment;
use crate::map::{Cell, Cost, FloorPlan, MAX_DRAWS, OccupancyGrid, Sampler, Wedged};
use crate::sim::settings::{ALPHA, Word};
use crate::sim::squeeze::{
    Attempt, MAX_SAMPLES, MAX_STEPS, MAX_TRIAL, MapSqueeze, PRESETS, Settings, Stats, alphas_of_noise,
    most_draws,
};
use js_sys::{Array, Float64Array, RangeError, Uint8Array, Uint8ClampedArray};
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** All over the attempts shown; NaN where undefined. */
export interface SqueezeStats {
  attempts: number;
  /** Draws of the model; of its shorter motions, for the sub-stepped sampler. */
  drawn: number;
  accepted: number;
  acceptanceRate: number;
  throughWall: number;
  throughWallRate: number;
  /** 95 %. */
  throughWallInterval: [number, number];
  drawsPerAccepted: number;
  /** Walls whose distance was computed; most verdicts need none. */
  wallTestsPerAccepted: number;
  /** Whether the machine stopped short of its samples. */
  gaveUp: boolean;
}

/** As read, in m: least x, least y, greatest x, greatest y; x0, y0, x1, y1 of one wall after the other. */
export interface Plan {
  bounds: Float64Array;
  walls: Float64Array;
}

/** Square cells, row by row from the bottom. */
export interface Grid {
  columns: number;
  rows: number;
  /** Side of a cell, m. */
  resolution: number;
  /** x, y (m) and yaw (rad) of the lower left corner. */
  origin: Float64Array;
  /** 1 where occupied. */
  occupied: Uint8Array;
  /** 1 where the map says nothing. */
  unknown: Uint8Array;
}
"#;

/// One command in a map, tried many times by a round robot. Metres, radians, seconds throughout. Whatever is out of range
/// throws a TypeError or RangeError that names the field, and changes nothing.
#[wasm_bindgen(js_name = MapSqueeze)]
pub struct JsMapSqueeze(Held<MapSqueeze>);

#[wasm_bindgen(js_class = MapSqueeze)]
impl JsMapSqueeze {
    /// What is left out is as the widget opens: facing a doorway in the apartment. `noise` sets all of `alphas`.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(unchecked_optional_param_type = "Partial<MapSqueezeSettings> & { noise?: number }")]
        options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(MapSqueeze::new(read_opening(options)?)?)))
    }

    /// A machine as the constructor makes it, of whose samples none is tried yet.
    pub fn empty(
        #[wasm_bindgen(unchecked_optional_param_type = "Partial<MapSqueezeSettings> & { noise?: number }")]
        options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(MapSqueeze::empty(read_opening(options)?)?)))
    }

    /// Largest `samples`.
    #[wasm_bindgen(getter, js_name = maxSamples)]
    pub fn max_samples() -> usize {
        MAX_SAMPLES
    }

    #[wasm_bindgen(getter, unchecked_return_type = "MapSqueezePreset[]")]
    pub fn presets() -> Result<Array, JsValue> {
        let preset = |(name, mut start): (&str, [f64; 3])| {
            object(&[("name", name.into()), ("start", group_to_js(&mut start)?)])
        };
        PRESETS.into_iter().map(preset).collect()
    }

    /// The noise parameters of level n, 0 to 1e6: the first four are n, the others n/4.
    #[wasm_bindgen(js_name = alphasOfNoise)]
    pub fn alphas_of_noise(
        #[wasm_bindgen(unchecked_param_type = "number")] n: &JsValue,
    ) -> Result<Float64Array, JsValue> {
        float64_array(&alphas_of_noise::<6>(in_range("n", n, &ALPHA)?))
    }

    /// Changes the settings that are named. `noise` sets all of `alphas`. A complete cloud stays complete.
    pub fn configure(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<MapSqueezeSettings> & { noise?: number }")]
        settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.configure(settings))?)
    }

    /// As `configure`, in slices: `advance` is to be called until it says true. Until then only some of the samples are
    /// shown.
    pub fn begin(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<MapSqueezeSettings> & { noise?: number }")]
        settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.begin(settings))?)
    }

    /// Reads the map and looks at it, where that is a new one, and works on what was begun, for computing about as many
    /// distances; whether all is done.
    pub fn advance(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] distances: &JsValue,
    ) -> Result<bool, JsValue> {
        let distances = work("distances", distances)?;
        Ok(self.0.with(move |machine| machine.advance(distances))?)
    }

    /// How much is done of reading a map, of looking at it or, after that, of the samples; from 0 to 1.
    #[wasm_bindgen(getter)]
    pub fn progress(&self) -> f64 {
        self.0.with(|machine| machine.progress())
    }

    /// Gives up what was begun: the settings and samples are the former ones.
    pub fn stop(&self) {
        self.0.with(MapSqueeze::stop);
    }

    /// A copy; changing it changes nothing.
    #[wasm_bindgen(getter, unchecked_return_type = "MapSqueezeSettings")]
    pub fn config(&self) -> Result<JsValue, JsValue> {
        settings_to_js(&self.settings())
    }

    /// Level n of the noise parameters; null where they are not those of a level.
    #[wasm_bindgen(getter, unchecked_return_type = "number | null")]
    pub fn noise(&self) -> JsValue {
        number_or_null(self.settings().noise())
    }

    #[wasm_bindgen(getter, unchecked_return_type = "Plan")]
    pub fn plan(&self) -> Result<JsValue, JsValue> {
        let wall = |Segment { from, to }: &Segment| [from[0], from[1], to[0], to[1]];
        let (bounds, walls) = self.0.with(move |machine| {
            let plan = machine.plan();
            (plan.bounds(), gathered(plan.walls().iter().map(wall)))
        });
        object(&[("bounds", float64_array(&bounds)?.into()), ("walls", doubles("plan", walls)?.into())])
    }

    /// The cells that the walls of the plan outline; null for a plan of walls alone.
    #[wasm_bindgen(getter, unchecked_return_type = "Grid | null")]
    pub fn grid(&self) -> Result<JsValue, JsValue> {
        let read = |grid: &OccupancyGrid| (grid.size(), grid.resolution(), grid.origin());
        let grid = self.0.with(move |machine| machine.plan().grid().map(read));
        let Some(([columns, rows], resolution, origin)) = grid else {
            return Ok(JsValue::NULL);
        };
        let cells = |kind| {
            bytes_in_pieces(columns * rows, |from| {
                self.0
                    .with(move |machine| machine.plan().grid().map(|grid| grid.marks(kind, from)))
                    .unwrap_or_default()
            })
        };
        object(&[
            ("columns", (columns as f64).into()),
            ("rows", (rows as f64).into()),
            ("resolution", resolution.into()),
            ("origin", float64_array(&[origin.x(), origin.y(), origin.theta()])?.into()),
            ("occupied", cells(Cell::Occupied)?.into()),
            ("unknown", cells(Cell::Unknown)?.into()),
        ])
    }

    /// { bounds: [x, y, x, y], walls: [[x, y, x, y], …] } in m, as a JSON floor plan has them; undefined for the apartment.
    #[wasm_bindgen(js_name = setPlan)]
    pub fn set_plan(
        &self,
        #[wasm_bindgen(unchecked_optional_param_type = "unknown")] plan: &JsValue,
    ) -> Result<(), JsValue> {
        let plan = if plan.is_undefined() { FloorPlan::apartment() } else { read_plan(plan)? };
        self.0.with(move |machine| machine.set_plan(plan));
        Ok(())
    }

    /// What the YAML file of map_server says, and the bytes of a PGM file or the pixels of another.
    #[wasm_bindgen(js_name = setGrid)]
    pub fn set_grid(
        &self,
        #[wasm_bindgen(unchecked_param_type = "unknown")] description: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array | Pick<ImageData, 'width' | 'height' | 'data'>")]
        image: &JsValue,
    ) -> Result<(), JsValue> {
        let reading = read_map(description, image)?;
        Ok(self.0.with(move |machine| machine.set_map(reading))?)
    }

    /// As `setGrid`, in slices like `begin`. Until the image is read, the map is the former one; what is wrong with it and
    /// could not be said before is thrown by `advance`, and the map stays.
    #[wasm_bindgen(js_name = beginGrid)]
    pub fn begin_grid(
        &self,
        #[wasm_bindgen(unchecked_param_type = "unknown")] description: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array | Pick<ImageData, 'width' | 'height' | 'data'>")]
        image: &JsValue,
    ) -> Result<(), JsValue> {
        let reading = read_map(description, image)?;
        self.0.with(move |machine| machine.begin_map(reading));
        Ok(())
    }

    /// A start in the open: in the middle of the largest square that is known to be free, heading where the way is known
    /// to be free for longest. Where the robot does not fit there, where it does; null where that is nowhere.
    #[wasm_bindgen(getter, js_name = openPlace, unchecked_return_type = "Start | null")]
    pub fn open_place(&self) -> Result<JsValue, JsValue> {
        let Some(place) = self.0.with(|machine| machine.open_place()) else { return Ok(JsValue::NULL) };
        group_to_js(&mut [place.x(), place.y(), place.theta()])
    }

    /// Whether the robot fits where it starts.
    #[wasm_bindgen(getter, js_name = startFree)]
    pub fn start_free(&self) -> bool {
        self.0.with(|machine| machine.start_free())
    }

    /// The way that the command drives without noise, as x, y pairs.
    #[wasm_bindgen(getter)]
    pub fn commanded(&self) -> Result<Float64Array, JsValue> {
        float64_array(self.0.with(|machine| machine.commanded()).points().as_flattened())
    }

    /// How many attempts there are now, 0 to `config.samples`.
    #[wasm_bindgen(getter)]
    pub fn shown(&self) -> usize {
        self.0.with(|machine| machine.attempts().len())
    }

    /// Shows up to `count` attempts more, 0 to 1 000 000. Returns how many are shown then.
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

    /// Shows none; the same attempts come again.
    pub fn restart(&self) {
        self.0.with(MapSqueeze::restart);
    }

    /// x, y (m), θ (rad) of each attempt shown; a copy.
    #[wasm_bindgen(getter)]
    pub fn poses(&self) -> Result<Float64Array, JsValue> {
        let numbers = |Attempt { pose, .. }: &Attempt| [pose.x(), pose.y(), pose.theta()];
        doubles("samples", self.0.with(move |machine| gathered(machine.attempts().iter().map(numbers))))
    }

    /// A byte an attempt: 1 where its end is free, 2 where its path is, 4 where it is accepted, added up.
    #[wasm_bindgen(getter)]
    pub fn verdicts(&self) -> Result<Uint8Array, JsValue> {
        bytes("samples", self.0.with(|machine| gathered(machine.attempts().iter().map(Attempt::verdict))))
    }

    /// The path driven in an attempt, as x, y pairs; empty where it is not shown.
    pub fn path(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] index: &JsValue,
    ) -> Result<Float64Array, JsValue> {
        let index = whole("index", index, 0..=MAX_SAMPLES as u64)? as usize;
        let arcs = self.0.with(move |machine| machine.arcs(index));
        let points: Vec<[f64; 2]> = arcs.iter().flat_map(|arc| arc.points()).collect();
        float64_array(points.as_flattened())
    }

    #[wasm_bindgen(getter, unchecked_return_type = "SqueezeStats")]
    pub fn stats(&self) -> Plain<Stats> {
        Plain(Ok(self.0.with(|machine| machine.stats())))
    }

    /// Draws `count` accepted samples with a sampler and forgets them, for timing it; throws where the robot is wedged.
    #[wasm_bindgen(unchecked_return_type = "{ draws: number; wallTests: number }")]
    pub fn trial(
        &self,
        #[wasm_bindgen(unchecked_param_type = "MapSqueezeSettings['sampler']")] sampler: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] steps: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] count: &JsValue,
    ) -> Plain<Cost> {
        let cost = || {
            let steps = whole("steps", steps, 1..=MAX_STEPS)?;
            let sampler = word::<Sampler>("sampler", sampler)?.in_parts(steps as u32);
            let count = whole("count", count, 1..=MAX_TRIAL / steps)? as usize;
            let cost = self.0.with(move |machine| machine.trial(sampler, count));
            cost.map_err(|wedged| too_dear(sampler, count, &wedged).into())
        };
        Plain(cost())
    }

    /// Where the attempts shown end, as RGBA pixels of a grid, row by row from the top. Each cell has the colour of what most
    /// of those in it are, rejected, accepted or accepted through a wall, for which there are 256 colours each one after
    /// the other: of them number 255·√(c/most) for a count c of all in the cell. Transparent where there is nobody. A view
    /// of the core's memory: to be used before the machine is asked for anything else.
    #[expect(clippy::too_many_arguments, reason = "a rectangle, a size and colours")]
    #[wasm_bindgen(unchecked_return_type = "Uint8ClampedArray<ArrayBuffer>")]
    pub fn picture(
        &self,
        #[wasm_bindgen(js_name = xMin, unchecked_param_type = "number")] x_min: &JsValue,
        #[wasm_bindgen(js_name = yMin, unchecked_param_type = "number")] y_min: &JsValue,
        #[wasm_bindgen(js_name = xMax, unchecked_param_type = "number")] x_max: &JsValue,
        #[wasm_bindgen(js_name = yMax, unchecked_param_type = "number")] y_max: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] columns: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] rows: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "Uint8Array")] ramps: &JsValue,
    ) -> Result<Uint8ClampedArray, JsValue> {
        let grid = read_grid([x_min, y_min, x_max, y_max], columns, rows)?;
        let ramps = read_ramps("ramps", ramps)?;
        let pixels = self.0.with(move |machine| machine.paint(&grid, &ramps).map(place_of));
        Ok(view_of(&pixels.map_err(|_| no_memory("columns"))?))
    }

    /// The index of the attempt that ends nearest to a point and within `radius` of it; −1 for none.
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

impl JsMapSqueeze {
    fn settings(&self) -> Settings {
        self.0.with(|machine| *machine.settings())
    }
}

/// The refusal of a trial that would take too many draws.
fn too_dear(sampler: Sampler, count: usize, wedged: &Wedged) -> RangeError {
    let most = most_draws(sampler.parts() as usize * count);
    RangeError::new(&format!(
        "sampler is {}, by which {wedged}; allowed is one of at most {MAX_DRAWS} draws an accepted sample and {most} for \
         {count} of them",
        quoted(sampler.get()),
    ))
}
