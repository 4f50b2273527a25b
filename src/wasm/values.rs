//! JavaScript values made of Rust's.

use super::fields::no_memory;
use crate::sim::settings::{Declared, Group, Setting};
use js_sys::{Array, Float64Array, Object, Uint8Array, Uint32Array};
use serde::Serialize;
use wasm_bindgen::convert::ReturnWasmAbi;
use wasm_bindgen::describe::WasmDescribe;
use wasm_bindgen::prelude::*;

/// What a method returns as a plain JavaScript value, in which None is null. It is made after the machine was given back: a
/// page may have put setters on what all objects inherit, and what they throw passes through Rust.
pub struct Plain<T>(pub Result<T, JsValue>);

impl<T> WasmDescribe for Plain<T> {
    fn describe() {
        Result::<JsValue, JsValue>::describe();
    }
}

impl<T: Serialize> ReturnWasmAbi for Plain<T> {
    type Abi = <Result<JsValue, JsValue> as ReturnWasmAbi>::Abi;

    fn return_abi(self) -> Self::Abi {
        let serializer = serde_wasm_bindgen::Serializer::new().serialize_missing_as_null(true);
        self.0.and_then(|value| Ok(value.serialize(&serializer)?)).return_abi()
    }
}

/// The settings of a widget; what is another way to say one of them is left out.
pub fn settings_to_js<S: Declared>(settings: &S) -> Result<JsValue, JsValue> {
    let (mut entries, mut settings) = (Vec::new(), *settings);
    settings.try_each(|declaration, setting| {
        if declaration.of.is_none() {
            entries.push((declaration.key, setting_to_js(setting)?));
        }
        Ok::<_, JsValue>(())
    })?;
    object(&entries)
}

fn setting_to_js(setting: Setting) -> Result<JsValue, JsValue> {
    Ok(match setting {
        Setting::Number(number, _) => (*number).into(),
        Setting::Whole(whole, _) => (whole.get() as f64).into(),
        Setting::WholeOrNone(whole, _) => number_or_null(whole.map(|whole| whole as f64)),
        Setting::Truth(truth) => (*truth).into(),
        Setting::Word(word) => word.get().into(),
        Setting::Numbers(numbers, _) => list(numbers)?,
        Setting::Level(level, _) => number_or_null(level.get()),
        Setting::Group(group) => group_to_js(group)?,
    })
}

pub fn number_or_null(number: Option<f64>) -> JsValue {
    number.map_or(JsValue::NULL, JsValue::from)
}

pub fn group_to_js(group: &mut dyn Group) -> Result<JsValue, JsValue> {
    let entries: Vec<_> = group
        .fields()
        .iter()
        .enumerate()
        .map(|(i, field)| (field.declaration.key, (*group.number(i)).into()))
        .collect();
    object(&entries)
}

/// A plain array of numbers.
pub fn list(numbers: &[f64]) -> Result<JsValue, JsValue> {
    Ok(Array::from(float64_array(numbers)?.as_ref()).into())
}

/// The items one after the other; None where memory does not suffice.
pub fn gathered<T>(items: impl ExactSizeIterator<Item = T>) -> Option<Vec<T>> {
    let mut gathered = Vec::new();
    gathered.try_reserve_exact(items.len()).ok()?;
    items.for_each(|item| gathered.push(item));
    Some(gathered)
}

/// The numbers of what was gathered. A RangeError that names `field` where memory does not suffice, on either side: an
/// array of a million poses may be the one that is too much.
pub fn doubles<const N: usize>(field: &str, items: Option<Vec<[f64; N]>>) -> Result<Float64Array, JsValue> {
    float64_array(items.ok_or_else(|| no_memory(field))?.as_flattened())
}

/// A copy of these numbers, with an error where JavaScript has no memory for it.
#[inline(never)]
pub fn float64_array(numbers: &[f64]) -> Result<Float64Array, JsValue> {
    Ok(Doubles::of(numbers)?.unchecked_into())
}

/// As [`float64_array`].
pub fn whole_numbers(numbers: &[u32]) -> Result<Uint32Array, JsValue> {
    Ok(WholeNumbers::of(numbers)?.unchecked_into())
}

/// As [`doubles`] for single bytes.
pub fn bytes(field: &str, items: Option<Vec<u8>>) -> Result<Uint8Array, JsValue> {
    let items = items.ok_or_else(|| no_memory(field))?;
    Ok(Bytes::of(&items)?.unchecked_into())
}

/// So many bytes, of which `piece` has the next ones from each place on: here there is no second copy of all of them.
pub fn bytes_in_pieces(length: usize, piece: impl Fn(usize) -> Vec<u8>) -> Result<Uint8Array, JsValue> {
    let bytes = Bytes::zeros(length)?;
    let mut from = 0;
    while from < length {
        let next = piece(from);
        bytes.set(&next, from)?;
        // There is always one, and without one there would be no end.
        from += next.len().max(1);
    }
    Ok(bytes.unchecked_into())
}

// Those of js-sys let what a failed allocation throws pass through Rust.
#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_name = Float64Array)]
    type Doubles;
    #[wasm_bindgen(constructor, catch, js_class = "Float64Array")]
    fn of(numbers: &[f64]) -> Result<Doubles, JsValue>;

    #[wasm_bindgen(js_name = Uint32Array)]
    type WholeNumbers;
    #[wasm_bindgen(constructor, catch, js_class = "Uint32Array")]
    fn of(numbers: &[u32]) -> Result<WholeNumbers, JsValue>;

    #[wasm_bindgen(js_name = Uint8Array)]
    type Bytes;
    #[wasm_bindgen(constructor, catch, js_class = "Uint8Array")]
    fn of(bytes: &[u8]) -> Result<Bytes, JsValue>;
    #[wasm_bindgen(constructor, catch, js_class = "Uint8Array")]
    fn zeros(length: usize) -> Result<Bytes, JsValue>;
    #[wasm_bindgen(method, catch, js_class = "Uint8Array")]
    fn set(this: &Bytes, bytes: &[u8], from: usize) -> Result<(), JsValue>;
}

/// A plain object. Its properties are defined, not assigned: what all objects inherit may have setters of the page's.
#[inline(never)]
pub fn object(entries: &[(&str, JsValue)]) -> Result<JsValue, JsValue> {
    let entries: Vec<_> = entries.iter().map(|(key, value)| Array::of2(&(*key).into(), value)).collect();
    Ok(Object::from_entries(&Array::of(&entries))?.into())
}
