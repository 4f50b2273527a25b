//! JavaScript class `ArcAnatomy`.

use super::fields::check_range;
use super::pictures::read_bounds;
use super::simulation_class::simulation_class;
use super::values::{to_plain_js, to_ts, triple_array};
use crate::geom::arc_forms::{FormErrors, form_errors};
use crate::sim::arc_anatomy::ArcAnatomy;
use js_sys::Float64Array;
use tsify::Ts;
use wasm_bindgen::prelude::*;

simulation_class! {
    /// Arc between two poses, and how likely the second pose is after a command from the first.
    JsArcAnatomy(ArcAnatomy), "ArcAnatomy", "ArcAnatomySettings", "Partial<ArcAnatomySettings>", |simulation|
    /// All values that a figure shows, except for the heat map, in one call.
    read as "ArcAnatomyView" {
        stats: "AnatomyStats" = to_plain_js(&simulation.stats());
        table: "AnatomyTable" = to_plain_js(&simulation.table());
        paths: "AnatomyPaths" = to_plain_js(&simulation.paths());
    }
    others {}
}

#[wasm_bindgen(js_class = ArcAnatomy)]
impl JsArcAnatomy {
    /// Returns the errors of the three formulas of exercise 1 for the end of an arc at small turn rates.
    #[wasm_bindgen(js_name = formErrors)]
    pub fn form_errors() -> Ts<FormErrors> {
        to_ts(&form_errors())
    }

    /// Returns a heat map of final positions in the rectangle with the bounds xMin, yMin, xMax and yMax (m), for the heading of the final
    /// pose; null if no heat map is selected.
    #[wasm_bindgen(unchecked_return_type = "AnatomySurface | null")]
    pub fn surface(
        &self,
        #[wasm_bindgen(unchecked_param_type = "ArrayLike<number>")] bounds: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let [min_corner, max_corner] = read_bounds(bounds)?;
        Ok(to_plain_js(&self.0.surface(min_corner, max_corner)))
    }

    /// Returns three poses after a fraction of the time, 0 to 1, as x, y (m) and θ (rad). They are on the commanded arc, on the arc that
    /// the estimates v̂ and ω̂ drive, and on the path of constant twist.
    #[wasm_bindgen(js_name = underway)]
    pub fn poses_at(&self, share: f64) -> Result<Float64Array, JsValue> {
        let poses = self.0.poses_at(check_range("share", share, &(0.0..=1.0))?);
        Ok(triple_array(poses))
    }
}
