//! Declarations of all settings and presets, in a module that the build scripts run. Pages need them before they load the core.

use super::values::{js_array, js_object, setting_to_js, settings_to_js};
use crate::map::{MAX_BYTES, MAX_PIXELS};
use crate::sim::picture::RAMP_STEP_COUNT;
use crate::sim::settings::{Declaration, DeclaredSettings, Field, Setting};
use crate::sim::squeeze::{ACCEPTED_BIT, END_FREE_BIT, MAX_TRIAL_PARTS, PATH_FREE_BIT};
use crate::sim::{alpha_calibrator, arc_anatomy, banana, dead_reckoning, odometry_decomposer, squeeze};
use js_sys::{Array, Reflect};
use std::ops::RangeInclusive;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const DECLARATION_TYPE: &str = "
/** Declaration of a setting. */
export interface Declaration {
  /** Name of the setting as attribute, as property and in states. */
  key: string;
  /** Key of the group or list that contains the setting. */
  in?: string;
  /** Key of another setting that this setting sets in another form. */
  of?: string;
  /** Ratios of the last numbers of that other setting to this setting. */
  weights?: number[];
  /** Key in the group, if a field of another group has the same key. */
  field?: string;
  /** Index in the list, from 0. */
  index?: number;
  type: 'word' | 'number' | 'whole' | 'boolean' | 'numbers' | 'group';
  /** Allowed words. */
  words?: string[];
  /** Keys of the fields of a group. */
  fields?: string[];
  unit?: string;
  /** True if the value may be null. */
  nullable?: boolean;
  /** Minimum and maximum of the number, or of each number of a list. */
  min?: number;
  max?: number;
  /** Initial value. */
  default: string | number | boolean | number[] | Record<string, number> | null;
  /** Description. */
  sentence: string;
}
";

type Entry = (&'static str, JsValue);

/// Returns the constants of build/settings.js, each by its name.
#[wasm_bindgen]
pub fn constants() -> JsValue {
    let banana::Settings { velocity_alphas, odometry_alphas, .. } = banana::Settings::default();
    js_object(&[
        ("settings", declared_settings()),
        ("presets", presets()),
        // Initial noise parameters of each model.
        (
            "openingAlphas",
            js_object(&[("velocity", js_array(&velocity_alphas)), ("odometry", js_array(&odometry_alphas))]),
        ),
        // Maximum number of cells of a grid and of pixels of an image; maximum size of an image file, bytes. `trial`: maximum product of samples
        // and parts in a call of `MapSqueeze.trial`. `ramp`: number of colours of a ramp.
        (
            "limits",
            number_object(&[
                ("cells", MAX_PIXELS as f64),
                ("bytes", MAX_BYTES as f64),
                ("trial", MAX_TRIAL_PARTS as f64),
                ("ramp", RAMP_STEP_COUNT as f64),
            ]),
        ),
        // Bits of a verdict on an attempt of Map Squeeze.
        (
            "verdict",
            number_object(&[
                ("endFree", f64::from(END_FREE_BIT)),
                ("pathFree", f64::from(PATH_FREE_BIT)),
                ("accepted", f64::from(ACCEPTED_BIT)),
            ]),
        ),
    ])
}

/// Returns the declarations of each widget by its tag, in order.
fn declared_settings() -> JsValue {
    js_object(&[
        ("banana-machine", declarations(banana::Settings::default(), &banana::ALPHA_SENTENCES)),
        ("map-squeeze", declarations(squeeze::Settings::default(), &[])),
        ("arc-anatomy", declarations(arc_anatomy::Settings::default(), &arc_anatomy::ALPHA_SENTENCES)),
        (
            "odometry-decomposer",
            declarations(odometry_decomposer::Settings::default(), &odometry_decomposer::ALPHA_SENTENCES),
        ),
        (
            "dead-reckoning",
            declarations(dead_reckoning::Settings::default(), &dead_reckoning::ALPHA_SENTENCES),
        ),
        ("alpha-calibrator", declarations(alpha_calibrator::Settings::default(), &[])),
    ])
}

/// Returns the presets of each widget by its tag, each with its name and all settings.
fn presets() -> JsValue {
    js_object(&[
        (
            "banana-machine",
            named_settings(banana::PRESETS.map(|banana::Preset { name, command, alphas }| {
                (name, banana::Settings { command, velocity_alphas: alphas, ..Default::default() })
            })),
        ),
        (
            "map-squeeze",
            named_settings(
                squeeze::PRESETS
                    .map(|(name, start)| (name, squeeze::Settings { start, ..Default::default() })),
            ),
        ),
        (
            "arc-anatomy",
            named_settings(arc_anatomy::PRESETS.map(|arc_anatomy::Preset { name, command, next }| {
                (name, arc_anatomy::Settings { command, next, ..Default::default() })
            })),
        ),
        (
            "odometry-decomposer",
            named_settings(odometry_decomposer::PRESETS.map(
                |odometry_decomposer::Preset { name, from, to }| {
                    (name, odometry_decomposer::Settings { from, to, ..Default::default() })
                },
            )),
        ),
        (
            "dead-reckoning",
            named_settings(dead_reckoning::PRESETS.map(
                |dead_reckoning::Preset { name, command, steps, step, alphas }| {
                    let settings =
                        dead_reckoning::Settings { command, steps, step, alphas, ..Default::default() };
                    (name, settings)
                },
            )),
        ),
        ("alpha-calibrator", Array::new().into()),
    ])
}

fn named_settings<S: DeclaredSettings, const N: usize>(presets: [(&str, S); N]) -> JsValue {
    let to_object = |(name, settings): (&str, S)| {
        js_object(&[("name", name.into()), ("settings", settings_to_js(&settings))])
    };
    presets.into_iter().map(to_object).collect::<Array>().into()
}

fn number_object(entries: &[(&'static str, f64)]) -> JsValue {
    js_object(&entries.iter().map(|&(key, number)| (key, number.into())).collect::<Vec<_>>())
}

/// Returns the declarations of settings, and of each number of a group or list. `number_sentences` describe the numbers of a list.
fn declarations(mut defaults: impl DeclaredSettings, number_sentences: &[&'static str]) -> JsValue {
    let shared_keys = shared_field_keys(&mut defaults);
    let declarations = Array::new();
    defaults.visit_settings(&mut |declaration, setting| {
        append_setting(declaration, setting, number_sentences, &shared_keys, &declarations);
    });
    declarations.into()
}

/// Returns the keys of fields that belong to more than one group, such as two poses. Their attributes consist of the group's name and the
/// key.
fn shared_field_keys(defaults: &mut impl DeclaredSettings) -> Vec<&'static str> {
    let (mut seen_keys, mut shared_keys) = (Vec::new(), Vec::new());
    defaults.visit_settings(&mut |_, setting| {
        if let Setting::Group(group) = setting {
            for Field { declaration, .. } in group.fields() {
                if seen_keys.contains(&declaration.key) { &mut shared_keys } else { &mut seen_keys }
                    .push(declaration.key);
            }
        }
    });
    shared_keys
}

/// Appends the declaration of a setting. Each number of a group or list has another declaration.
fn append_setting(
    declaration: &Declaration,
    setting: Setting,
    number_sentences: &[&'static str],
    shared_keys: &[&str],
    declarations: &Array,
) {
    let Declaration { key, of, sentence, unit } = *declaration;
    let append = |mut entries: Vec<Entry>, sentence: &str, unit: &str, default: JsValue| {
        entries.extend([("sentence", sentence.into()), ("default", default)]);
        entries.extend((!unit.is_empty()).then(|| ("unit", unit.into())));
        declarations.push(&js_object(&entries));
    };
    let mut entries = vec![("key", key.into())];
    entries.extend(of.map(|original| ("of", original.into())));
    let nullable = ("nullable", true.into());
    let mut fields: &[Field] = &[];
    let mut list_entries = None;
    let type_of = |name: &str| ("type", name.into());
    match &setting {
        Setting::Boolean(_) => entries.push(type_of("boolean")),
        Setting::Keyword(keyword) => entries.extend([type_of("word"), ("words", text_array(keyword.all()))]),
        Setting::Number(_, allowed) => entries.extend(number_entries_in("number", allowed)),
        Setting::Integer(_, allowed) => entries.extend(whole_number_entries(allowed)),
        Setting::OptionalInteger(_, allowed) => {
            entries.push(nullable.clone());
            entries.extend(whole_number_entries(allowed));
        }
        Setting::Level(level, allowed) => {
            let weights: Vec<f64> = level.weights().collect();
            entries.extend([nullable.clone(), ("weights", js_array(&weights))]);
            entries.extend(number_entries_in("number", allowed));
        }
        Setting::Numbers(_, allowed) => {
            entries.extend(number_entries_in("numbers", allowed));
            list_entries = Some(number_entries_in("number", allowed));
        }
        Setting::Group(group) => {
            fields = group.fields();
            let keys = fields.iter().map(|field| field.declaration.key);
            entries.extend([type_of("group"), ("fields", text_array(keys))]);
        }
    }
    let default = setting_to_js(setting);
    append(entries, sentence, unit, default.clone());
    if let Some(list_entries) = list_entries {
        for (index, (&sentence, number)) in number_sentences.iter().zip(Array::from(&default)).enumerate() {
            let own_key = format!("alpha{}", index + 1);
            let mut entries = vec![("key", own_key.into()), ("in", key.into()), ("index", index.into())];
            // The last numbers are null in models with fewer α's.
            entries.extend((sentence != number_sentences[0]).then(|| nullable.clone()));
            entries.extend(list_entries.clone());
            append(entries, sentence, "", number);
        }
    }
    for Field { declaration: field, allowed } in fields {
        let mut entries = vec![("in", key.into())];
        if shared_keys.contains(&field.key) {
            let (initial, remaining_key) = field.key.split_at(1);
            let own_key = format!("{key}{}{remaining_key}", initial.to_uppercase());
            entries.extend([("key", own_key.into()), ("field", field.key.into())]);
        } else {
            entries.push(("key", field.key.into()));
        }
        entries.extend(number_entries_in("number", allowed));
        let number = Reflect::get(&default, &field.key.into()).unwrap_or(JsValue::NULL);
        append(entries, field.sentence, field.unit, number);
    }
}

fn number_entries_in(kind: &str, allowed: &RangeInclusive<f64>) -> [Entry; 3] {
    [("type", kind.into()), ("min", (*allowed.start()).into()), ("max", (*allowed.end()).into())]
}

fn whole_number_entries(allowed: &RangeInclusive<u64>) -> [Entry; 3] {
    number_entries_in("whole", &(*allowed.start() as f64..=*allowed.end() as f64))
}

fn text_array(texts: impl IntoIterator<Item = &'static str>) -> JsValue {
    texts.into_iter().map(JsValue::from).collect::<Array>().into()
}
