//! JavaScript interface of the crate: reads arguments, calls the simulation and returns copies.

// A page with one widget loads a module that has only this widget. The module is compiled with the widget's tag as the value of the cfg
// `widget`.
#![cfg_attr(widget, allow(dead_code, reason = "used by the other widgets"))]

#[cfg(any(not(widget), widget = "alpha-calibrator"))]
mod alpha_calibrator;
#[cfg(any(not(widget), widget = "arc-anatomy"))]
mod arc_anatomy;
#[cfg(any(not(widget), widget = "banana-machine"))]
mod banana;
#[cfg(not(widget))]
mod calibrate;
#[cfg(any(not(widget), widget = "alpha-calibrator"))]
mod calibration;
#[cfg(any(not(widget), widget = "dead-reckoning"))]
mod dead_reckoning;
mod fields;
#[cfg(any(not(widget), widget = "alpha-calibrator"))]
mod log;
mod maps;
#[cfg(not(widget))]
mod models;
#[cfg(any(not(widget), widget = "odometry-decomposer"))]
mod odometry_decomposer;
mod pictures;
mod simulation_class;
#[cfg(any(not(widget), widget = "map-squeeze"))]
mod squeeze;
pub(crate) mod values;

use crate::models::VelocityCmd;
use crate::sim::banana::command_drawn_at;
use crate::sim::settings::QUANTITY_RANGE;
use crate::sim::views::MORPH_RANGE;
use fields::{check_range, read_value};
use values::js_object;
use wasm_bindgen::prelude::*;

/// Returns a seed from the platform's entropy source: a whole number, 0 to 2³² − 1.
#[wasm_bindgen(js_name = randomSeed)]
pub fn random_seed() -> Result<f64, JsError> {
    Ok(f64::from(getrandom::u32()?))
}

/// Returns the command that leads from the origin, heading along x, to the point (x, y) of the picture. Its duration is that of the given
/// command. x and y are from −1e6 to 1e6 m. Of the many arcs that lead there, it is the one whose turn is nearest to that of the given
/// command. `morph` is the stage of the picture's transition from positions (0, the default) to exponential coordinates (1).
#[wasm_bindgen(js_name = commandReaching, unchecked_return_type = "{ v: number; omega: number }")]
pub fn js_command_reaching(
    x: f64,
    y: f64,
    #[wasm_bindgen(unchecked_param_type = "Command")] command: &JsValue,
    morph: Option<f64>,
) -> Result<JsValue, JsValue> {
    let (x, y) = (check_range("x", x, &QUANTITY_RANGE)?, check_range("y", y, &QUANTITY_RANGE)?);
    let zero_command = VelocityCmd { v: 0.0, omega: 0.0, dt: 0.0 };
    let current_command = read_value("command", command, zero_command, ())?;
    let morph = check_range("morph", morph.unwrap_or(0.0), &MORPH_RANGE)?;
    let VelocityCmd { v, omega, .. } = command_drawn_at([x, y], &current_command, morph);
    Ok(js_object(&[("v", v.into()), ("omega", omega.into())]))
}
