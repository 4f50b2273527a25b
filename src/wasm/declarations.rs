//! Declarations of all settings and presets, in a module that the build scripts run. Pages need them before they load the core.

use super::values::{js_array, js_object, setting_to_js, settings_to_js, to_plain_js};
use crate::map::{MAX_BYTES, MAX_PIXELS};
use crate::sim::picture::RAMP_STEP_COUNT;
use crate::sim::settings::{Declaration, DeclaredSettings, Field, Setting};
use crate::sim::squeeze::{ACCEPTED_BIT, END_FREE_BIT, MAX_TRIAL_PARTS, PATH_FREE_BIT};
use crate::sim::{alpha_calibrator, arc_anatomy, banana, dead_reckoning, odometry_decomposer, squeeze};
use js_sys::{Array, Reflect};
use serde::Serialize;
use tsify::Tsify;
use wasm_bindgen::prelude::*;

/// Declaration of a setting.
#[derive(Clone, Default, Serialize, Tsify)]
#[tsify(rename = "Declaration")]
struct SettingDeclaration {
    /// Name of the setting as attribute, as property and in states.
    key: String,
    /// Key of the group or list that contains the setting.
    #[serde(rename = "in", skip_serializing_if = "Option::is_none")]
    container: Option<&'static str>,
    /// Key of another setting that this setting sets in another form.
    #[serde(skip_serializing_if = "Option::is_none")]
    of: Option<&'static str>,
    /// Ratios of the last numbers of that other setting to this setting.
    #[serde(skip_serializing_if = "Option::is_none")]
    weights: Option<Vec<f64>>,
    /// Key in the group, if a field of another group has the same key.
    #[serde(skip_serializing_if = "Option::is_none")]
    field: Option<&'static str>,
    /// Index in the list, from 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<usize>,
    #[serde(rename = "type")]
    #[tsify(type = "'word' | 'number' | 'whole' | 'boolean' | 'numbers' | 'group'")]
    kind: &'static str,
    /// Allowed words.
    #[serde(skip_serializing_if = "Option::is_none")]
    words: Option<Vec<&'static str>>,
    /// Keys of the fields of a group.
    #[serde(skip_serializing_if = "Option::is_none")]
    fields: Option<Vec<&'static str>>,
    #[serde(skip_serializing_if = "str::is_empty")]
    #[tsify(optional)]
    unit: &'static str,
    /// True if the value may be null.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    #[tsify(optional)]
    nullable: bool,
    /// Minimum of the number, or of each number of a list.
    #[serde(skip_serializing_if = "Option::is_none")]
    min: Option<f64>,
    /// Maximum of the number, or of each number of a list.
    #[serde(skip_serializing_if = "Option::is_none")]
    max: Option<f64>,
    /// Initial value.
    #[serde(with = "serde_wasm_bindgen::preserve")]
    #[tsify(type = "string | number | boolean | number[] | Record<string, number> | null")]
    default: JsValue,
    /// Description.
    sentence: &'static str,
}

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
    let mut declarations = Vec::new();
    defaults.visit_settings(&mut |declaration, setting| {
        append_setting(declaration, setting, number_sentences, &shared_keys, &mut declarations);
    });
    to_plain_js(&declarations)
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
    declarations: &mut Vec<SettingDeclaration>,
) {
    let Declaration { key, of, sentence, unit } = *declaration;
    let (kind, [min, max]) = kind_and_range(&setting);
    let mut whole =
        SettingDeclaration { key: key.to_owned(), of, kind, min, max, unit, sentence, ..Default::default() };
    let mut fields: &[Field] = &[];
    match &setting {
        Setting::OptionalInteger(..) => whole.nullable = true,
        Setting::Level(level, _) => {
            (whole.nullable, whole.weights) = (true, Some(level.weights().collect()));
        }
        Setting::Keyword(keyword) => whole.words = Some(keyword.all()),
        Setting::Group(group) => {
            fields = group.fields();
            whole.fields = Some(fields.iter().map(|field| field.declaration.key).collect());
        }
        _ => {}
    }
    let default = setting_to_js(setting);
    declarations.push(SettingDeclaration { default: default.clone(), ..whole });
    let part = SettingDeclaration { container: Some(key), kind: "number", ..Default::default() };
    if kind == "numbers" {
        for (index, (&sentence, default)) in number_sentences.iter().zip(Array::from(&default)).enumerate() {
            // The last numbers are null in models with fewer α's.
            let nullable = sentence != number_sentences[0];
            let (key, index) = (format!("alpha{}", index + 1), Some(index));
            declarations.push(SettingDeclaration {
                key,
                index,
                nullable,
                min,
                max,
                default,
                sentence,
                ..part.clone()
            });
        }
    }
    for Field { declaration: Declaration { key: field_key, sentence, unit, .. }, allowed } in fields {
        let is_shared = shared_keys.contains(field_key);
        let (initial, remaining_key) = field_key.split_at(1);
        declarations.push(SettingDeclaration {
            key: if is_shared {
                format!("{key}{}{remaining_key}", initial.to_uppercase())
            } else {
                (*field_key).to_owned()
            },
            field: is_shared.then_some(*field_key),
            unit,
            min: Some(*allowed.start()),
            max: Some(*allowed.end()),
            default: Reflect::get(&default, &(*field_key).into()).unwrap_or(JsValue::NULL),
            sentence,
            ..part.clone()
        });
    }
}

/// Returns the type of a setting, and its minimum and maximum if it has them.
fn kind_and_range(setting: &Setting) -> (&'static str, [Option<f64>; 2]) {
    match setting {
        Setting::Number(_, allowed) | Setting::Level(_, allowed) => {
            ("number", [Some(*allowed.start()), Some(*allowed.end())])
        }
        Setting::Numbers(_, allowed) => ("numbers", [Some(*allowed.start()), Some(*allowed.end())]),
        Setting::Integer(_, allowed) | Setting::OptionalInteger(_, allowed) => {
            ("whole", [Some(*allowed.start() as f64), Some(*allowed.end() as f64)])
        }
        Setting::Boolean(_) => ("boolean", [None; 2]),
        Setting::Keyword(_) => ("word", [None; 2]),
        Setting::Group(_) => ("group", [None; 2]),
    }
}
