//! JavaScript values made of Rust's.

use super::fields::no_memory;
use crate::sim::settings::{Declared, Group, Setting};
use js_sys::{Array, Float64Array, Object, Reflect, Uint8Array};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// A plain JavaScript value; None becomes null.
pub fn to_js(value: &(impl Serialize + ?Sized)) -> Result<JsValue, JsValue> {
    Ok(value.serialize(&serde_wasm_bindgen::Serializer::new().serialize_missing_as_null(true))?)
}

/// The settings of a widget; what is another way to say one of them is left out.
pub fn settings_to_js<S: Declared>(settings: &S) -> Result<JsValue, JsValue> {
    let (object, mut settings) = (Object::new(), *settings);
    settings.try_each(|declaration, setting| {
        if declaration.of.is_none() {
            Reflect::set(&object, &declaration.key.into(), &setting_to_js(setting)?)?;
        }
        Ok::<_, JsValue>(())
    })?;
    Ok(object.into())
}

fn setting_to_js(setting: Setting) -> Result<JsValue, JsValue> {
    Ok(match setting {
        Setting::Number(number, _) => (*number).into(),
        Setting::Whole(whole, _) => (whole.get() as f64).into(),
        Setting::WholeOrNone(whole, _) => number_or_null(whole.map(|whole| whole as f64)),
        Setting::Truth(truth) => (*truth).into(),
        Setting::Word(word) => word.get().into(),
        Setting::Numbers(numbers, _) => to_js(&*numbers)?,
        Setting::Level(level, _) => number_or_null(level.get()),
        Setting::Group(group) => group_to_js(group)?,
    })
}

pub fn number_or_null(number: Option<f64>) -> JsValue {
    number.map_or(JsValue::NULL, JsValue::from)
}

pub fn group_to_js(group: &mut dyn Group) -> Result<JsValue, JsValue> {
    let object = Object::new();
    for (i, field) in group.fields().iter().enumerate() {
        Reflect::set(&object, &field.declaration.key.into(), &(*group.number(i)).into())?;
    }
    Ok(object.into())
}

/// The numbers of one item after the other. A RangeError that names `field` where memory does not suffice, on either
/// side: an array of a million poses may be the one that is too much.
pub fn doubles<const N: usize>(
    field: &str,
    items: impl ExactSizeIterator<Item = [f64; N]>,
) -> Result<Float64Array, JsValue> {
    let mut numbers: Vec<[f64; N]> = Vec::new();
    numbers.try_reserve_exact(items.len()).map_err(|_| no_memory(field))?;
    items.for_each(|item| numbers.push(item));
    float64_array(numbers.as_flattened())
}

/// A copy of these numbers, with an error where JavaScript has no memory for it.
#[inline(never)]
pub fn float64_array(numbers: &[f64]) -> Result<Float64Array, JsValue> {
    let array: Float64Array = typed_array("Float64Array", numbers.len())?.into();
    array.copy_from(numbers);
    Ok(array)
}

/// As [`doubles`] for single bytes.
pub fn bytes(field: &str, items: impl ExactSizeIterator<Item = u8>) -> Result<Uint8Array, JsValue> {
    let mut numbers = Vec::new();
    numbers.try_reserve_exact(items.len()).map_err(|_| no_memory(field))?;
    items.for_each(|item| numbers.push(item));
    let array: Uint8Array = typed_array("Uint8Array", numbers.len())?.into();
    array.copy_from(&numbers);
    Ok(array)
}

/// By `Reflect`, so that a failed allocation comes back as a value.
#[inline(never)]
fn typed_array(kind: &str, length: usize) -> Result<JsValue, JsValue> {
    let constructor = Reflect::get(&js_sys::global(), &kind.into())?;
    Reflect::construct(&constructor.into(), &Array::of1(&(length as f64).into()))
}

/// An object whose values are not all plain.
#[inline(never)]
pub fn object(entries: &[(&str, JsValue)]) -> Result<JsValue, JsValue> {
    let object = Object::new();
    for (key, value) in entries {
        Reflect::set(&object, &(*key).into(), value)?;
    }
    Ok(object.into())
}
