//! The JavaScript face of the crate: nothing but reading arguments, calling the simulation and handing back copies.

mod banana;
mod fields;
mod squeeze;
mod values;

use crate::sim::banana::command_reaching;
use crate::sim::settings::{SPEED, check_command};
use fields::{in_range, read_command};
use serde::Serialize;
use values::to_js;
use wasm_bindgen::prelude::*;

/// A seed from the platform's entropy source: a whole number below 2³².
#[wasm_bindgen(js_name = randomSeed)]
pub fn random_seed() -> Result<f64, JsError> {
    Ok(f64::from(getrandom::u32()?))
}

#[derive(Serialize)]
struct Speeds {
    v: f64,
    omega: f64,
}

/// The { v, omega } whose arc from the origin ends at (x, y): of those that do in the time of the command { v, omega,
/// dt }, the one nearest to it.
#[wasm_bindgen(js_name = commandReaching)]
pub fn speeds_reaching(x: &JsValue, y: &JsValue, command: &JsValue) -> Result<JsValue, JsValue> {
    let (x, y) = (in_range("x", x, &SPEED)?, in_range("y", y, &SPEED)?);
    let near = read_command("command", command)?;
    check_command(&near)?;
    let command = command_reaching(x, y, &near);
    to_js(&Speeds { v: command.v, omega: command.omega })
}
