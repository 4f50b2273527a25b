//! Conversion of Rust values to JavaScript values.

use crate::geom::se2::SE2;
use crate::sim::settings::{HasKeywords, KeywordSetting, SettingValue};
use js_sys::{Array, Float64Array, Object, Uint8Array};
use nalgebra::{Matrix3, Vector3};
use serde::{Serialize, Serializer};
use tsify::{Ts, Tsify};
use wasm_bindgen::prelude::*;

/// Converts a value to a plain JavaScript value, in which None is null.
pub fn to_plain_js<T: Serialize>(rust_value: &T) -> JsValue {
    let js_serializer = serde_wasm_bindgen::Serializer::new().serialize_missing_as_null(true);
    // Serialization fails only for maps whose keys are not strings. Results of the core contain no such maps.
    rust_value.serialize(&js_serializer).unwrap_or(JsValue::NULL)
}

/// Converts a value as [`to_plain_js`] does, with its TypeScript type.
pub fn to_ts<T: Serialize + Tsify>(rust_value: &T) -> Ts<T> {
    Ts::new_unchecked(to_plain_js(rust_value))
}

/// Conversion of Rust values to JavaScript values that serde does not create, such as a Float64Array.
pub trait ToJs {
    fn to_js(&self) -> JsValue;
}

/// Serializes a field of a struct of [`crate::js::js_structs`] by the conversion of [`ToJs`].
pub fn serialize<T: ToJs, S: Serializer>(rust_value: &T, js_serializer: S) -> Result<S::Ok, S::Error> {
    serde_wasm_bindgen::preserve::serialize(&rust_value.to_js(), js_serializer)
}

macro_rules! to_js {
    ($($type:ty: |$value:ident| $js:expr;)+) => {$(
        impl ToJs for $type {
            fn to_js(&self) -> JsValue {
                let $value = self;
                $js.into()
            }
        }
    )+};
}
to_js! {
    Vec<f64>: |numbers| float_array(numbers);
    Vec<[f64; 2]>: |points| float_array(points.as_flattened());
    Vec<[f64; 3]>: |poses| float_array(poses.as_flattened());
    Vec<[f64; 4]>: |segments| float_array(segments.as_flattened());
    [f64; 3]: |pose| float_array(pose);
    [f64; 4]: |numbers| float_array(numbers);
    Vec<Vec<[f64; 2]>>: |lines| lines.iter().map(Vec::to_js).collect::<Array>();
    Vec<u8>: |bytes| Uint8Array::from(&bytes[..]);
    Vector3<f64>: |vector| js_array(vector.as_slice());
    // Array of the columns, which equal the rows, because all matrices in results are symmetric.
    Matrix3<f64>: |matrix| matrix.as_slice().chunks(3).map(js_array).collect::<Array>();
}

impl<T: HasKeywords> ToJs for T {
    fn to_js(&self) -> JsValue {
        self.get().into()
    }
}

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(typescript_type = "Start")]
    pub type JsPose;
}

pub fn pose_to_js(pose: SE2) -> JsPose {
    to_plain_js(&<[f64; 3]>::from(pose).setting(())).unchecked_into()
}

pub fn js_array(numbers: &[f64]) -> JsValue {
    numbers.iter().copied().map(JsValue::from).collect::<Array>().into()
}

/// Returns a Float64Array of the numbers of all points or poses in order.
pub fn flat_float_array<const N: usize>(numbers: &[[f64; N]]) -> Float64Array {
    Float64Array::from(numbers.as_flattened())
}

/// Returns a Float64Array of the three numbers of each pose or vector in order.
pub fn triple_array<T: Into<[f64; 3]>>(three_numbers: impl IntoIterator<Item = T>) -> Float64Array {
    flat_float_array(&three_numbers.into_iter().map(Into::into).collect::<Vec<[f64; 3]>>())
}

#[inline(never)]
pub fn float_array(numbers: &[f64]) -> JsValue {
    Float64Array::from(numbers).into()
}

#[inline(never)]
pub fn js_object(object_entries: &[(&str, JsValue)]) -> JsValue {
    let object_entries: Array = object_entries
        .iter()
        .map(|(entry_key, entry_value)| Array::of2(&(*entry_key).into(), entry_value))
        .collect();
    Object::from_entries(&object_entries).unwrap_or_else(|_| Object::new()).into()
}
