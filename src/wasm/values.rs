//! JavaScript values made of Rust's.

use crate::models::VelocityCmd;
use js_sys::{Float64Array, Object, Reflect};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// A plain JavaScript value; None becomes null.
pub fn to_js(value: &impl Serialize) -> Result<JsValue, JsValue> {
    Ok(value.serialize(&serde_wasm_bindgen::Serializer::new().serialize_missing_as_null(true))?)
}

#[derive(Serialize)]
pub struct Command {
    v: f64,
    omega: f64,
    dt: f64,
}

impl From<VelocityCmd> for Command {
    fn from(VelocityCmd { v, omega, dt }: VelocityCmd) -> Self {
        Self { v, omega, dt }
    }
}

/// x, y of one point after the other.
pub fn pairs(points: &[[f64; 2]]) -> Float64Array {
    Float64Array::from(points.as_flattened())
}

pub fn triples(items: impl Iterator<Item = [f64; 3]>) -> Float64Array {
    Float64Array::from(items.collect::<Vec<_>>().as_flattened())
}

/// An object whose values are not all plain.
pub fn object(entries: &[(&str, JsValue)]) -> Result<JsValue, JsValue> {
    let object = Object::new();
    for (key, value) in entries {
        Reflect::set(&object, &(*key).into(), value)?;
    }
    Ok(object.into())
}
