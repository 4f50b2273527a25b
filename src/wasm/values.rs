//! JavaScript values made of Rust's.

use super::fields::no_memory;
use crate::models::VelocityCmd;
use js_sys::{Array, Float64Array, Object, Reflect};
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

/// The numbers of one item after the other. A RangeError where memory does not suffice, on either side: an array of a
/// million poses may be the one that is too much.
pub fn doubles<const N: usize>(
    items: impl ExactSizeIterator<Item = [f64; N]>,
) -> Result<Float64Array, JsValue> {
    let count = items.len() * N;
    let mut numbers = Vec::new();
    numbers.try_reserve_exact(count).map_err(|_| no_memory("samples"))?;
    numbers.extend(items.flatten());
    // By `Reflect`, so that a failed allocation comes back as a value.
    let constructor = Reflect::get(&js_sys::global(), &"Float64Array".into())?;
    let array = Reflect::construct(&constructor.into(), &Array::of1(&(count as f64).into()))?;
    let array: Float64Array = array.into();
    array.copy_from(&numbers);
    Ok(array)
}

/// An object whose values are not all plain.
pub fn object(entries: &[(&str, JsValue)]) -> Result<JsValue, JsValue> {
    let object = Object::new();
    for (key, value) in entries {
        Reflect::set(&object, &(*key).into(), value)?;
    }
    Ok(object.into())
}
