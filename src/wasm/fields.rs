//! Readers of JavaScript values. Every error is a TypeError or RangeError that names the field, the value and the allowed values.

use crate::numbers::format_number;
use crate::sim::settings::{
    KeywordSetting, Setting, SettingRules, SettingValue, SettingsError, check_integer, check_real,
};
use js_sys::{Array, JSON, RangeError, Reflect, TypeError};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

impl From<SettingsError> for JsValue {
    fn from(settings_error: SettingsError) -> Self {
        RangeError::new(&settings_error.to_string()).into()
    }
}

/// Reader of the fields of a JavaScript object, by their names.
pub struct FieldReader<'a> {
    js_object: &'a JsValue,
    /// Path of the object in the argument with a final dot: "" at the top, "command." one level below.
    key_prefix: &'a str,
}

impl<'a> FieldReader<'a> {
    pub fn new(name: &str, key_prefix: &'a str, object: &'a JsValue, keys: &[&str]) -> Result<Self, JsValue> {
        if Array::is_array(object) || !object.is_object() {
            return Err(type_error(name, object, &format!("an object with keys from {}", keys.join(", "))));
        }
        for object_key in Reflect::own_keys(object)?.iter().filter_map(|object_key| object_key.as_string()) {
            if !keys.contains(&object_key.as_str()) {
                let (object_key, keys) = (shorten_text(&object_key), keys.join(", "));
                return Err(TypeError::new(&format!(
                    "{key_prefix}{object_key} is an unknown key; allowed are {keys}"
                ))
                .into());
            }
        }
        Ok(Self { js_object: object, key_prefix })
    }

    /// Returns the reader of an object that may also have other keys.
    pub fn new_with_any_keys(
        name: &str,
        key_prefix: &'a str,
        object: &'a JsValue,
        allowed: &str,
    ) -> Result<Self, JsValue> {
        if object.is_object() {
            Ok(Self { js_object: object, key_prefix })
        } else {
            Err(type_error(name, object, allowed))
        }
    }

    pub fn path(&self, key: &str) -> String {
        format!("{}{key}", self.key_prefix)
    }

    /// Returns the value of a field; undefined if the field is missing.
    pub fn value(&self, key: &str) -> Result<JsValue, JsValue> {
        Reflect::get(self.js_object, &key.into())
    }

    /// Reads a field with the function `read_value`; None if the field is missing or undefined.
    pub fn read_optional<T>(
        &self,
        key: &str,
        read_value: impl FnOnce(&str, &JsValue) -> Result<T, JsValue>,
    ) -> Result<Option<T>, JsValue> {
        let value = self.value(key)?;
        if value.is_undefined() { Ok(None) } else { read_value(&self.path(key), &value).map(Some) }
    }

    /// Reads a field that is a value of any type that a setting may have; `default` if the field is missing or undefined.
    pub fn read_or<T: SettingValue>(&self, key: &str, default: T, allowed: T::Range) -> Result<T, JsValue> {
        let value = self.value(key)?;
        if value.is_undefined() { Ok(default) } else { read_value(&self.path(key), &value, default, allowed) }
    }

    /// Reads a required number without checking its range.
    pub fn number(&self, key: &str) -> Result<f64, JsValue> {
        read_number(&self.path(key), &self.value(key)?)
    }
}

pub fn read_number(field: &str, value: &JsValue) -> Result<f64, JsValue> {
    value.as_f64().ok_or_else(|| type_error(field, value, "a number"))
}

pub fn check_range(field: &str, number: f64, allowed: &RangeInclusive<f64>) -> Result<f64, JsValue> {
    check_real(field, number, allowed)?;
    Ok(number)
}

pub fn read_integer(field: &str, number: f64, allowed: RangeInclusive<u64>) -> Result<u64, JsValue> {
    Ok(check_integer(field, number, &allowed)?)
}

/// Returns the error for an index beyond the samples shown.
pub fn not_shown_error(index: usize, shown_count: usize) -> JsValue {
    let allowed_text = format!("one of the {shown_count} samples shown, counted from 0");
    RangeError::new(&format!("index is {index}; allowed is {allowed_text}")).into()
}

/// Reads a value of any type that a setting may have, and checks its range. `initial_value` is any value of the type.
pub fn read_value<T: SettingValue>(
    field: &str,
    value: &JsValue,
    mut initial_value: T,
    allowed: T::Range,
) -> Result<T, JsValue> {
    read_setting_in_range(field, value, initial_value.setting(allowed))?;
    Ok(initial_value)
}

fn read_setting_in_range(field: &str, value: &JsValue, mut target_setting: Setting) -> Result<(), JsValue> {
    read_setting(field, value, &mut target_setting)?;
    Ok(target_setting.check(field)?)
}

fn set_keyword(field: &str, value: &JsValue, setting: &mut dyn KeywordSetting) -> Result<(), JsValue> {
    let allowed = |setting: &dyn KeywordSetting| {
        setting.all_keywords().into_iter().map(quote_text).collect::<Vec<_>>().join(" or ")
    };
    let setting_keyword = value.as_string().ok_or_else(|| type_error(field, value, &allowed(setting)))?;
    if setting.set(&setting_keyword) {
        return Ok(());
    }
    Err(RangeError::new(&format!("{field} is {}; allowed is {}", describe_value(value), allowed(setting)))
        .into())
}

/// Reads an array (or typed array) of exactly N numbers without checking ranges.
pub fn read_array<const N: usize>(field: &str, value: &JsValue) -> Result<[f64; N], JsValue> {
    let mut array_numbers = [0.0; N];
    fill_array(field, value, &mut array_numbers)?;
    Ok(array_numbers)
}

pub fn read_array_in_range<const N: usize>(
    field: &str,
    value: &JsValue,
    allowed: &RangeInclusive<f64>,
) -> Result<[f64; N], JsValue> {
    let mut numbers = [0.0; N];
    read_setting_in_range(field, value, Setting::Numbers(&mut numbers, allowed.clone()))?;
    Ok(numbers)
}

fn fill_array(field: &str, value: &JsValue, numbers: &mut [f64]) -> Result<(), JsValue> {
    let expected_text = format!("an array of {} numbers", numbers.len());
    let given_length = array_length(field, value, &expected_text)?;
    if given_length != numbers.len() {
        return Err(RangeError::new(&format!(
            "{field} has length {given_length}; allowed is {expected_text}"
        ))
        .into());
    }
    for (i, number_slot) in numbers.iter_mut().enumerate() {
        *number_slot = read_number(&format!("{field}[{i}]"), &array_item(value, i)?)?;
    }
    Ok(())
}

/// Returns the initial settings of a simulation: the values in `options`, and the default of every other setting.
pub fn read_initial_settings<S: SettingRules>(options: &JsValue) -> Result<S, JsValue> {
    if options.is_undefined() { Ok(S::default()) } else { read_settings(&S::default(), options) }
}

/// Returns the current settings, changed to the values in `options`. The simulation checks the ranges of doubles later.
pub fn read_settings<S: SettingRules>(current_settings: &S, options: &JsValue) -> Result<S, JsValue> {
    let option_fields = FieldReader::new("options", "", options, S::KEYS)?;
    let (mut settings, mut given_keys) = (*current_settings, Vec::new());
    settings.try_visit_settings(|declaration, mut setting| {
        let key = declaration.key;
        let value = option_fields.value(key)?;
        if value.is_undefined() {
            return Ok(());
        }
        if let Some(original_key) = declaration.of.filter(|original_key| given_keys.contains(original_key)) {
            let error_message = format!("{key} is given beside {original_key}; allowed is one of the two");
            return Err(TypeError::new(&error_message).into());
        }
        given_keys.push(key);
        read_setting(key, &value, &mut setting)
    })?;
    settings.adjust_settings(current_settings, &given_keys);
    Ok(settings)
}

fn read_setting(field: &str, js_value: &JsValue, setting: &mut Setting) -> Result<(), JsValue> {
    match setting {
        Setting::Number(setting_slot, _) => **setting_slot = read_number(field, js_value)?,
        Setting::Integer(setting_slot, allowed) => {
            setting_slot.set(read_integer(field, read_number(field, js_value)?, allowed.clone())?)
        }
        Setting::OptionalInteger(setting_slot, _) if js_value.is_null() => **setting_slot = None,
        Setting::OptionalInteger(setting_slot, allowed) => {
            **setting_slot =
                Some(read_integer(field, read_number(field, js_value)?, allowed.clone())? as usize);
        }
        Setting::Boolean(setting_slot) => **setting_slot = read_boolean(field, js_value)?,
        Setting::Keyword(setting_slot) => set_keyword(field, js_value, *setting_slot)?,
        Setting::Numbers(setting_slots, _) => fill_array(field, js_value, setting_slots)?,
        // The level is checked before it is converted to α's. If the α's were checked instead, the error message would name an α.
        Setting::Level(setting_slot, allowed) => {
            setting_slot.set(check_range(field, read_number(field, js_value)?, allowed)?)
        }
        // A group of numbers, such as a command, must be complete: speeds without their duration would mean another motion.
        Setting::Group(group_members, numbers) => {
            let keys = group_members.each_ref().map(|group_member| group_member.declaration.key);
            let key_prefix = format!("{field}.");
            let option_fields = FieldReader::new(field, &key_prefix, js_value, &keys)?;
            for (key, number) in keys.iter().zip(numbers) {
                **number = option_fields.number(key)?;
            }
        }
    }
    Ok(())
}

pub fn read_boolean(field: &str, js_value: &JsValue) -> Result<bool, JsValue> {
    js_value.as_bool().ok_or_else(|| type_error(field, js_value, "true or false"))
}

pub fn array_length(field: &str, js_value: &JsValue, expected_text: &str) -> Result<usize, JsValue> {
    if !js_value.is_object() {
        return Err(type_error(field, js_value, expected_text));
    }
    let length = Reflect::get(js_value, &"length".into())?;
    let length = length.as_f64().ok_or_else(|| type_error(field, js_value, expected_text))?;
    Ok(check_integer(&format!("{field}.length"), length, &(0..=u64::from(u32::MAX)))? as usize)
}

pub fn array_item(js_value: &JsValue, index: usize) -> Result<JsValue, JsValue> {
    Reflect::get_u32(js_value, index as u32)
}

pub fn type_error(field: &str, js_value: &JsValue, allowed: &str) -> JsValue {
    TypeError::new(&format!("{field} is {}; allowed is {allowed}", describe_value(js_value))).into()
}

/// Maximum number of quoted characters of a value. They suffice to recognize a text, and no key or keyword is longer.
const MAX_QUOTED_CHARACTERS: usize = 40;

fn shorten_text(original_text: &str) -> String {
    let mut shown_characters = original_text.chars().map(|text_character| {
        if text_character.is_control() { char::REPLACEMENT_CHARACTER } else { text_character }
    });
    let mut shortened_text: String = shown_characters.by_ref().take(MAX_QUOTED_CHARACTERS).collect();
    if shown_characters.next().is_some() {
        shortened_text.push('…');
    }
    shortened_text
}

/// Returns a text in quotation marks. Rust's `Debug` format would include Unicode tables, which would be 5 % of the module.
pub fn quote_text(text: &str) -> String {
    JSON::stringify(&text.into()).map_or_else(|_| String::new(), String::from)
}

fn describe_value(value: &JsValue) -> String {
    if let Some(text) = value.as_string() {
        return quote_text(&shorten_text(&text));
    }
    if let Some(number) = value.as_f64() {
        return format_number(number);
    }
    if let Some(js_boolean) = value.as_bool() {
        return js_boolean.to_string();
    }
    if value.is_null() || value.is_undefined() {
        return if value.is_null() { "null" } else { "undefined" }.to_owned();
    }
    match value.js_typeof().as_string() {
        Some(type_name) if type_name != "object" => format!("a {type_name}"),
        _ if Array::is_array(value) => "an array".to_owned(),
        _ => "an object".to_owned(),
    }
}
