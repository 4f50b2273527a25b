//! Reading JavaScript values, each checked once. Every refusal is a TypeError or RangeError that names the field, the
//! value and what is allowed. Nothing here can throw past Rust or run the caller's code unguarded: properties are read
//! by `Reflect`, whose exceptions come back as values.

use crate::models::VelocityCmd;
use crate::printed::printed;
use crate::sim::settings::{SettingsError, check_real, check_whole};
use js_sys::{RangeError, Reflect, TypeError};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

impl From<SettingsError> for JsValue {
    fn from(error: SettingsError) -> Self {
        RangeError::new(&error.to_string()).into()
    }
}

/// An object of named fields, with no other keys than those it may have.
pub struct Fields<'a> {
    object: &'a JsValue,
    /// Where it stands in what the caller gave: "" at the top, "command." one below.
    prefix: &'a str,
}

impl<'a> Fields<'a> {
    pub fn new(name: &str, prefix: &'a str, object: &'a JsValue, known: &[&str]) -> Result<Self, JsValue> {
        if !object.is_object() {
            return Err(type_error(name, object, &format!("an object with keys from {}", known.join(", "))));
        }
        let keys = Reflect::own_keys(object).map_err(|_| unreadable(name))?;
        if object.is_array() {
            let message =
                format!("{name} is an array; allowed is an object with keys from {}", known.join(", "));
            return Err(TypeError::new(&message).into());
        }
        for key in keys.iter() {
            let Some(key) = key.as_string() else { continue };
            if !known.contains(&key.as_str()) {
                let message = format!("{prefix}{key} is an unknown key; allowed are {}", known.join(", "));
                return Err(TypeError::new(&message).into());
            }
        }
        Ok(Self { object, prefix })
    }

    /// An object that may have other keys too.
    pub fn open(name: &str, prefix: &'a str, object: &'a JsValue) -> Result<Self, JsValue> {
        if object.is_object() {
            Ok(Self { object, prefix })
        } else {
            Err(type_error(name, object, "an object"))
        }
    }

    pub fn path(&self, key: &str) -> String {
        format!("{}{key}", self.prefix)
    }

    /// The value of a field; undefined where it is missing.
    pub fn value(&self, key: &str) -> Result<JsValue, JsValue> {
        Reflect::get(self.object, &key.into()).map_err(|_| unreadable(&self.path(key)))
    }

    /// What `read` makes of a field, or None where it is missing or undefined.
    pub fn optional<T>(
        &self,
        key: &str,
        read: impl FnOnce(&str, &JsValue) -> Result<T, JsValue>,
    ) -> Result<Option<T>, JsValue> {
        let value = self.value(key)?;
        if value.is_undefined() { Ok(None) } else { read(&self.path(key), &value).map(Some) }
    }

    /// A number that must be there; its range is not looked at.
    pub fn number(&self, key: &str) -> Result<f64, JsValue> {
        number(&self.path(key), &self.value(key)?)
    }
}

/// A number, any number.
pub fn number(field: &str, value: &JsValue) -> Result<f64, JsValue> {
    value.as_f64().ok_or_else(|| type_error(field, value, "a number"))
}

/// A number of the given range.
pub fn in_range(field: &str, value: &JsValue, allowed: &RangeInclusive<f64>) -> Result<f64, JsValue> {
    let number = number(field, value)?;
    check_real(field, number, allowed)?;
    Ok(number)
}

/// A whole number of the given range.
pub fn whole(field: &str, value: &JsValue, least: u64, most: u64) -> Result<u64, JsValue> {
    Ok(check_whole(field, number(field, value)?, least, most)?)
}

/// One of a few words.
pub fn word<T: Copy>(field: &str, value: &JsValue, words: &[(&str, T)]) -> Result<T, JsValue> {
    let allowed = || words.iter().map(|(word, _)| quoted(word)).collect::<Vec<_>>().join(" or ");
    let text = value.as_string().ok_or_else(|| type_error(field, value, &allowed()))?;
    words.iter().find(|(word, _)| *word == text).map(|(_, meaning)| *meaning).ok_or_else(|| {
        RangeError::new(&format!("{field} is {}; allowed is {}", describe(value), allowed())).into()
    })
}

/// An array (or typed array) of exactly N numbers, their ranges not looked at.
pub fn numbers<const N: usize>(field: &str, value: &JsValue) -> Result<[f64; N], JsValue> {
    let expected = format!("an array of {N} numbers");
    let length = length(field, value, &expected)?;
    if length != N {
        return Err(RangeError::new(&format!("{field} has length {length}; allowed is {expected}")).into());
    }
    let mut result = [0.0; N];
    for (i, slot) in result.iter_mut().enumerate() {
        *slot = number(&format!("{field}[{i}]"), &item(field, value, i)?)?;
    }
    Ok(result)
}

/// A whole command: speeds without their duration would mean another motion.
pub fn read_command(field: &str, value: &JsValue) -> Result<VelocityCmd, JsValue> {
    let fields = Fields::new(field, "command.", value, &["v", "omega", "dt"])?;
    Ok(VelocityCmd { v: fields.number("v")?, omega: fields.number("omega")?, dt: fields.number("dt")? })
}

/// What a caller is told who asks for more than there is memory for.
pub fn no_memory(field: &str) -> JsValue {
    RangeError::new(&format!("{field} is a number for which there is no memory; allowed is a smaller one"))
        .into()
}

pub fn boolean(field: &str, value: &JsValue) -> Result<bool, JsValue> {
    value.as_bool().ok_or_else(|| type_error(field, value, "true or false"))
}

/// The length of an array or typed array.
pub fn length(field: &str, value: &JsValue, expected: &str) -> Result<usize, JsValue> {
    if !value.is_object() {
        return Err(type_error(field, value, expected));
    }
    let length = Reflect::get(value, &"length".into()).map_err(|_| unreadable(field))?;
    let length = length.as_f64().ok_or_else(|| type_error(field, value, expected))?;
    Ok(check_whole(&format!("{field}.length"), length, 0, u64::from(u32::MAX))? as usize)
}

/// Item `index` of an array.
pub fn item(field: &str, value: &JsValue, index: usize) -> Result<JsValue, JsValue> {
    Reflect::get_u32(value, index as u32).map_err(|_| unreadable(&format!("{field}[{index}]")))
}

pub fn type_error(field: &str, value: &JsValue, allowed: &str) -> JsValue {
    TypeError::new(&format!("{field} is {}; allowed is {allowed}", describe(value))).into()
}

fn unreadable(field: &str) -> JsValue {
    TypeError::new(&format!("{field} is a property that throws; allowed is a plain value")).into()
}

/// A text between quotation marks. Not as `Debug` has it, which knows all of Unicode and takes a twentieth of the module.
fn quoted(text: &str) -> String {
    let mut result = String::from('"');
    for character in text.chars() {
        if matches!(character, '"' | '\\') {
            result.push('\\');
        }
        result.push(if character.is_control() { char::REPLACEMENT_CHARACTER } else { character });
    }
    result.push('"');
    result
}

/// The value as a sentence can hold it, without running any of the caller's code.
fn describe(value: &JsValue) -> String {
    /// Characters of a string that are quoted: enough to recognize it.
    const MOST_CHARACTERS: usize = 40;
    if let Some(text) = value.as_string() {
        let shown: String = text.chars().take(MOST_CHARACTERS).collect();
        return quoted(&shown) + if shown.len() < text.len() { "…" } else { "" };
    }
    if let Some(number) = value.as_f64() {
        return printed(number);
    }
    if let Some(truth) = value.as_bool() {
        return truth.to_string();
    }
    match value.js_typeof().as_string().as_deref() {
        Some("undefined") => "undefined".to_owned(),
        Some("object") if value.is_null() => "null".to_owned(),
        Some("object") => "an object".to_owned(),
        Some(kind) => format!("a {kind}"),
        None => "a value".to_owned(),
    }
}
