//! Reading JavaScript values, each checked once. Every refusal is a TypeError or RangeError that names the field, the
//! value and what is allowed. Nothing here throws past Rust: what may run the caller's code, or fail, is called by
//! `Reflect` or with `catch`, and its exceptions come back as values. Nothing is copied before its length is known.

use crate::sim::settings::{
    Group, MAX_SEED, Rules, Setting, SettingsError, Word, Words, check_group, check_real, check_whole,
};
use js_sys::{ArrayBuffer, JsString, Number, RangeError, Reflect, TypeError};
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
    /// Where it stands in what the caller gave: "" at the top, "command." one below.
    prefix: &'a str,
}

impl<'a> Fields<'a> {
    pub fn new(name: &str, prefix: &'a str, object: &'a JsValue, known: &[&str]) -> Result<Self, JsValue> {
        if !object.is_object() {
            return Err(type_error(name, object, &format!("an object with keys from {}", known.join(", "))));
        }
        // What has a length may have as many keys: arrays, typed arrays, text as an object.
        let length = Reflect::get(object, &"length".into()).map_err(|_| unreadable(name))?;
        if !length.is_undefined() {
            let (length, known) = (describe(&length), known.join(", "));
            let message = format!("{name} has length {length}; allowed is an object with keys from {known}");
            return Err(TypeError::new(&message).into());
        }
        let keys = Reflect::own_keys(object).map_err(|_| unreadable(name))?;
        for key in keys.iter() {
            let Some(key) = key.dyn_ref::<JsString>() else { continue };
            let key = beginning(key);
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
pub fn whole(field: &str, value: &JsValue, allowed: RangeInclusive<u64>) -> Result<u64, JsValue> {
    Ok(check_whole(field, number(field, value)?, &allowed)?)
}

/// How much is to be done at once: as much as a word of this processor says, where the number is larger.
pub fn work(field: &str, value: &JsValue) -> Result<usize, JsValue> {
    let work = whole(field, value, 1..=MAX_SEED)?;
    Ok(usize::try_from(work).unwrap_or(usize::MAX))
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
    let text: &JsString = value.dyn_ref().ok_or_else(|| type_error(field, value, &allowed(word)))?;
    if text.length() <= LONGEST && word.set(&beginning(text)) {
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
        *slot = number(&format!("{field}[{i}]"), &item(field, value, i)?)?;
    }
    Ok(())
}

/// All numbers of a group, their ranges not looked at: speeds without their duration would mean another motion.
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
        Setting::Whole(slot, allowed) => slot.set(whole(field, value, allowed)?),
        Setting::WholeOrNone(slot, _) if value.is_null() => *slot = None,
        Setting::WholeOrNone(slot, allowed) => *slot = Some(whole(field, value, allowed)? as usize),
        Setting::Truth(slot) => *slot = boolean(field, value)?,
        Setting::Word(slot) => read_word(field, value, slot)?,
        Setting::Numbers(slots, _) => read_numbers(field, value, slots)?,
        // Once it is taken apart, nobody could say that it was the level that is out of range.
        Setting::Level(slot, allowed) => slot.set(in_range(field, value, &allowed)?),
        Setting::Group(group) => read_group(field, value, group)?,
    }
    Ok(())
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
    Ok(check_whole(&format!("{field}.length"), length, &(0..=u64::from(u32::MAX)))? as usize)
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

/// A number as JavaScript prints it.
pub fn printed(number: f64) -> String {
    // Only another radix could throw.
    Number::from(number).to_string_with_radix(10).map_or_else(|_| String::new(), String::from)
}

/// Characters of a text that are quoted: enough to recognize it, and more than any key or word has.
const MAX_CHARACTERS: usize = 40;

/// UTF-16 units up to which a text is looked at: the engine may have put a longer one together of pieces that it would
/// have to copy into one.
const LONGEST: u32 = 1 << 20;

/// The first characters of a text, whole ones, and "…" where there are more.
fn beginning(text: &JsString) -> String {
    // Two units are one character at most; a half of the last one would be the one that is left out.
    let units = String::from(text.slice(0, 2 * MAX_CHARACTERS as u32 + 2));
    let mut characters = units
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

/// The value as a sentence can hold it, without running any of the caller's code.
fn describe(value: &JsValue) -> String {
    if let Some(text) = value.dyn_ref::<JsString>() {
        let length = text.length();
        return if length <= LONGEST {
            quoted(&beginning(text))
        } else {
            format!("a text of {length} characters")
        };
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

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(catch, js_namespace = ["Uint8Array", "prototype", "set"], js_name = call)]
    fn set_bytes(target: &mut [u8], source: &JsValue) -> Result<(), JsValue>;

    #[wasm_bindgen(catch, js_namespace = ["Float64Array", "prototype", "set"], js_name = call)]
    fn set_doubles(target: &mut [f64], source: &JsValue) -> Result<(), JsValue>;
}

/// A copy of the `length` bytes of an array of bytes.
pub fn bytes(field: &str, source: &JsValue, length: usize) -> Result<Vec<u8>, JsValue> {
    let mut bytes = room(field, length, 0)?;
    copy_bytes(field, source, &mut bytes)?;
    Ok(bytes)
}

/// Fills `target` with the bytes of an array of bytes.
pub fn copy_bytes(field: &str, source: &JsValue, target: &mut [u8]) -> Result<(), JsValue> {
    copied(field, source, || set_bytes(target, source))
}

/// A copy of the `length` numbers of an array of doubles.
pub fn doubles(field: &str, source: &JsValue, length: usize) -> Result<Vec<f64>, JsValue> {
    let mut doubles = room(field, length, 0.0)?;
    copied(field, source, || set_doubles(&mut doubles, source))?;
    Ok(doubles)
}

fn room<T: Clone>(field: &str, length: usize, empty: T) -> Result<Vec<T>, JsValue> {
    let mut room = Vec::new();
    room.try_reserve_exact(length).map_err(|_| no_memory(&format!("{field}.length")))?;
    room.resize(length, empty);
    Ok(room)
}

fn copied(field: &str, source: &JsValue, copy: impl FnOnce() -> Result<(), JsValue>) -> Result<(), JsValue> {
    // What only looks like one may have numbers that are objects with code of the caller's.
    if ArrayBuffer::is_view(source) && copy().is_ok() {
        return Ok(());
    }
    let message = format!(
        "{field} is an array that has lost its bytes, as when they are transferred; allowed is one that has them"
    );
    Err(TypeError::new(&message).into())
}
