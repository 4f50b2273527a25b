//! Reading JavaScript values, each checked once. Every refusal is a TypeError or RangeError that names the field, the
//! value and what is allowed.

use crate::sim::settings::{
    Group, Rules, Setting, SettingsError, Word, Words, check_group, check_real, check_whole,
};
use js_sys::{Array, Number, RangeError, Reflect, TypeError};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

impl From<SettingsError> for JsValue {
    fn from(error: SettingsError) -> Self {
        RangeError::new(&error.message(printed)).into()
    }
}

/// An object of named fields, with no other keys than those it may have.
pub struct Fields<'a> {
    object: &'a JsValue,
    /// Path of the object in the argument: "" at the top, "command." one below.
    prefix: &'a str,
}

impl<'a> Fields<'a> {
    pub fn new(name: &str, prefix: &'a str, object: &'a JsValue, known: &[&str]) -> Result<Self, JsValue> {
        let allowed = || format!("an object with keys from {}", known.join(", "));
        if Array::is_array(object) {
            return Err(TypeError::new(&format!("{name} is an array; allowed is {}", allowed())).into());
        }
        if !object.is_object() {
            return Err(type_error(name, object, &allowed()));
        }
        for key in Reflect::own_keys(object)?.iter().filter_map(|key| key.as_string()) {
            if !known.contains(&key.as_str()) {
                let (key, known) = (shortened(&key), known.join(", "));
                return Err(
                    TypeError::new(&format!("{prefix}{key} is an unknown key; allowed are {known}")).into()
                );
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
        Reflect::get(self.object, &key.into())
    }

    /// Reads a field by `read`; None where it is missing or undefined.
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

/// Checks that a number is of the given range.
pub fn in_range(field: &str, number: f64, allowed: &RangeInclusive<f64>) -> Result<f64, JsValue> {
    check_real(field, number, allowed)?;
    Ok(number)
}

/// Checks that a number is a whole one of the given range.
pub fn whole(field: &str, number: f64, allowed: RangeInclusive<u64>) -> Result<u64, JsValue> {
    Ok(check_whole(field, number, &allowed)?)
}

/// The refusal of the number of a sample that is not shown.
pub fn not_shown(index: usize, shown: usize) -> JsValue {
    let allowed = format!("one of the {shown} samples shown, counted from 0");
    RangeError::new(&format!("index is {index}; allowed is {allowed}")).into()
}

/// One of the words of an enum.
pub fn word<T: Words>(field: &str, value: &JsValue) -> Result<T, JsValue> {
    let mut result = T::WORDS[0].1;
    read_word(field, value, &mut result)?;
    Ok(result)
}

fn read_word(field: &str, value: &JsValue, word: &mut dyn Word) -> Result<(), JsValue> {
    let allowed = |word: &dyn Word| word.all().into_iter().map(quoted).collect::<Vec<_>>().join(" or ");
    let text = value.as_string().ok_or_else(|| type_error(field, value, &allowed(word)))?;
    if word.set(&text) {
        return Ok(());
    }
    Err(RangeError::new(&format!("{field} is {}; allowed is {}", describe(value), allowed(word))).into())
}

/// An array (or typed array) of exactly N numbers, their ranges not looked at.
pub fn numbers<const N: usize>(field: &str, value: &JsValue) -> Result<[f64; N], JsValue> {
    let mut result = [0.0; N];
    read_numbers(field, value, &mut result)?;
    Ok(result)
}

fn read_numbers(field: &str, value: &JsValue, numbers: &mut [f64]) -> Result<(), JsValue> {
    let expected = format!("an array of {} numbers", numbers.len());
    let length = length(field, value, &expected)?;
    if length != numbers.len() {
        return Err(RangeError::new(&format!("{field} has length {length}; allowed is {expected}")).into());
    }
    for (i, slot) in numbers.iter_mut().enumerate() {
        *slot = number(&format!("{field}[{i}]"), &item(value, i)?)?;
    }
    Ok(())
}

/// Reads all numbers of a group without checking ranges. A group has to be complete: speeds without their duration
/// would mean another motion.
fn read_group(field: &str, value: &JsValue, group: &mut dyn Group) -> Result<(), JsValue> {
    let keys: Vec<&str> = group.fields().iter().map(|field| field.declaration.key).collect();
    let prefix = format!("{field}.");
    let fields = Fields::new(field, &prefix, value, &keys)?;
    for (i, key) in keys.iter().enumerate() {
        *group.number(i) = fields.number(key)?;
    }
    Ok(())
}

/// [`read_group`], with each number in its range.
pub fn group_in_range(field: &str, value: &JsValue, group: &mut dyn Group) -> Result<(), JsValue> {
    read_group(field, value, group)?;
    Ok(check_group(field, group)?)
}

/// The settings that a machine opens with: the default ones but for those that `options` names, if there are any.
pub fn read_opening<S: Rules>(options: &JsValue) -> Result<S, JsValue> {
    if options.is_undefined() { Ok(S::default()) } else { read_settings(&S::default(), options) }
}

/// The present settings with those that `options` names. Ranges of doubles are left to the simulation.
pub fn read_settings<S: Rules>(present: &S, options: &JsValue) -> Result<S, JsValue> {
    let fields = Fields::new("options", "", options, S::KEYS)?;
    let (mut settings, mut named) = (*present, Vec::new());
    settings.try_each(|declaration, setting| {
        let key = declaration.key;
        let value = fields.value(key)?;
        if value.is_undefined() {
            return Ok(());
        }
        if let Some(original) = declaration.of.filter(|original| named.contains(original)) {
            let message = format!("{key} is given beside {original}; allowed is one of the two");
            return Err(TypeError::new(&message).into());
        }
        named.push(key);
        read_setting(key, &value, setting)
    })?;
    settings.settle(present, &named);
    Ok(settings)
}

fn read_setting(field: &str, value: &JsValue, setting: Setting) -> Result<(), JsValue> {
    match setting {
        Setting::Number(slot, _) => *slot = number(field, value)?,
        Setting::Whole(slot, allowed) => slot.set(whole(field, number(field, value)?, allowed)?),
        Setting::WholeOrNone(slot, _) if value.is_null() => *slot = None,
        Setting::WholeOrNone(slot, allowed) => {
            *slot = Some(whole(field, number(field, value)?, allowed)? as usize);
        }
        Setting::Truth(slot) => *slot = boolean(field, value)?,
        Setting::Word(slot) => read_word(field, value, slot)?,
        Setting::Numbers(slots, _) => read_numbers(field, value, slots)?,
        // Once it is taken apart, nobody could say that it was the level that is out of range.
        Setting::Level(slot, allowed) => slot.set(in_range(field, number(field, value)?, &allowed)?),
        Setting::Group(group) => read_group(field, value, group)?,
    }
    Ok(())
}

pub fn boolean(field: &str, value: &JsValue) -> Result<bool, JsValue> {
    value.as_bool().ok_or_else(|| type_error(field, value, "true or false"))
}

/// The length of an array or typed array.
pub fn length(field: &str, value: &JsValue, expected: &str) -> Result<usize, JsValue> {
    if !value.is_object() {
        return Err(type_error(field, value, expected));
    }
    let length = Reflect::get(value, &"length".into())?;
    let length = length.as_f64().ok_or_else(|| type_error(field, value, expected))?;
    Ok(check_whole(&format!("{field}.length"), length, &(0..=u64::from(u32::MAX)))? as usize)
}

/// Item `index` of an array.
pub fn item(value: &JsValue, index: usize) -> Result<JsValue, JsValue> {
    Reflect::get_u32(value, index as u32)
}

pub fn type_error(field: &str, value: &JsValue, allowed: &str) -> JsValue {
    TypeError::new(&format!("{field} is {}; allowed is {allowed}", describe(value))).into()
}

/// A number as JavaScript prints it.
pub fn printed(number: f64) -> String {
    // Only another radix could throw.
    Number::from(number).to_string_with_radix(10).map_or_else(|_| String::new(), String::from)
}

/// Characters of a text that are quoted: enough to recognize it, and more than any key or word has.
const MAX_CHARACTERS: usize = 40;

/// Shortens a text to what a sentence can hold.
fn shortened(text: &str) -> String {
    let mut characters = text
        .chars()
        .map(|character| if character.is_control() { char::REPLACEMENT_CHARACTER } else { character });
    let mut shown: String = characters.by_ref().take(MAX_CHARACTERS).collect();
    if characters.next().is_some() {
        shown.push('…');
    }
    shown
}

/// A text between quotation marks. Not as `Debug` has it, which knows all of Unicode and takes a twentieth of the module.
pub fn quoted(text: &str) -> String {
    let mut result = String::from('"');
    for character in text.chars() {
        if matches!(character, '"' | '\\') {
            result.push('\\');
        }
        result.push(character);
    }
    result.push('"');
    result
}

/// Describes a value as a sentence can hold it.
fn describe(value: &JsValue) -> String {
    if let Some(text) = value.as_string() {
        return quoted(&shortened(&text));
    }
    if let Some(number) = value.as_f64() {
        return printed(number);
    }
    if let Some(truth) = value.as_bool() {
        return truth.to_string();
    }
    if value.is_null() || value.is_undefined() {
        return if value.is_null() { "null" } else { "undefined" }.to_owned();
    }
    match value.js_typeof().as_string() {
        Some(kind) if kind != "object" => format!("a {kind}"),
        _ => "an object".to_owned(),
    }
}
