//! Prints the constants of build/settings.js as JSON: declarations and presets of all settings, and limits. Pages need them before they
//! load the core. `scripts/build.mjs` runs this program.

use motion::map::{MAX_BYTES, MAX_PIXELS};
use motion::sim::picture::RAMP_STEP_COUNT;
use motion::sim::settings::{Declaration, Field, Rules, Setting};
use motion::sim::squeeze::{ACCEPTED_BIT, END_FREE_BIT, MAX_TRIAL_PARTS, PATH_FREE_BIT};
use motion::sim::{alpha_calibrator, arc_anatomy, banana, dead_reckoning, odometry_decomposer, squeeze};
use serde::Serialize;
use serde_json::json;
use serde_json::value::{RawValue, to_raw_value};

/// Declaration of a setting, as `Declaration` in `www/types.d.ts` describes it.
#[derive(Clone, Default, Serialize)]
struct SettingDeclaration {
    key: String,
    #[serde(rename = "in", skip_serializing_if = "Option::is_none")]
    container: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    of: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    weights: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    field: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    index: Option<usize>,
    #[serde(rename = "type")]
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    words: Option<Vec<&'static str>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fields: Option<Vec<&'static str>>,
    #[serde(skip_serializing_if = "str::is_empty")]
    unit: &'static str,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    nullable: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    min: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max: Option<f64>,
    default: Box<RawValue>,
    sentence: String,
}

/// Preset of a widget.
#[derive(Serialize)]
struct Preset<S: 'static> {
    name: &'static str,
    settings: &'static S,
}

/// Declarations and presets of the settings of a widget.
#[derive(Serialize)]
struct Widget {
    tag: &'static str,
    declarations: Vec<SettingDeclaration>,
    presets: Box<RawValue>,
}

fn main() -> serde_json::Result<()> {
    let widgets = [
        describe::<banana::Settings>("banana-machine")?,
        describe::<squeeze::Settings>("map-squeeze")?,
        describe::<arc_anatomy::Settings>("arc-anatomy")?,
        describe::<odometry_decomposer::Settings>("odometry-decomposer")?,
        describe::<dead_reckoning::Settings>("dead-reckoning")?,
        describe::<alpha_calibrator::Settings>("alpha-calibrator")?,
    ];
    let banana::Settings { velocity_alphas, odometry_alphas, .. } = banana::Settings::DEFAULT;
    let constants = json!({
        // Initial noise parameters of each model.
        "openingAlphas": { "velocity": velocity_alphas, "odometry": odometry_alphas },
        // Maximum number of cells of a grid and of pixels of an image; maximum size of an image file, bytes. `trial`: maximum product of
        // samples and parts in a call of `MapSqueeze.trial`. `ramp`: number of colours of a ramp.
        "limits": { "cells": MAX_PIXELS, "bytes": MAX_BYTES, "trial": MAX_TRIAL_PARTS, "ramp": RAMP_STEP_COUNT },
        // Bits of a verdict on an attempt of Map Squeeze.
        "verdict": { "endFree": END_FREE_BIT, "pathFree": PATH_FREE_BIT, "accepted": ACCEPTED_BIT },
    });
    println!("{}", serde_json::to_string(&(widgets, constants))?);
    Ok(())
}

fn describe<S: Rules>(tag: &'static str) -> serde_json::Result<Widget> {
    let presets: Vec<_> = S::PRESETS.iter().map(|(name, settings)| Preset { name, settings }).collect();
    Ok(Widget { tag, declarations: declarations::<S>()?, presets: to_raw_value(&presets)? })
}

/// Returns the declarations of all settings, and of each number of a group or list.
fn declarations<S: Rules>() -> serde_json::Result<Vec<SettingDeclaration>> {
    let (shared_keys, mut declarations) = (shared_field_keys::<S>(), Vec::new());
    S::default().try_visit_settings(|&Declaration { key, of, sentence, unit, each }, setting| {
        let (kind, [min, max]) = kind_and_range(&setting);
        let mut whole = SettingDeclaration {
            key: key.to_owned(),
            of,
            kind,
            min,
            max,
            unit,
            sentence: sentence.to_owned(),
            default: to_raw_value(&setting)?,
            ..Default::default()
        };
        let part = SettingDeclaration { container: Some(key), kind: "number", ..Default::default() };
        let mut parts = Vec::new();
        match &setting {
            Setting::OptionalInteger(..) => whole.nullable = true,
            Setting::Level(level, _) => {
                (whole.nullable, whole.weights) = (true, Some(level.weights().collect()))
            }
            Setting::Keyword(keyword) => whole.words = Some(keyword.all()),
            Setting::Numbers(numbers, _) if !each.is_empty() => {
                let shortest_length = shortest_length::<S>(key);
                for (index, number) in numbers.iter().enumerate() {
                    parts.push(SettingDeclaration {
                        key: format!("alpha{}", index + 1),
                        index: Some(index),
                        nullable: index >= shortest_length,
                        min,
                        max,
                        default: to_raw_value(number)?,
                        sentence: each.to_owned(),
                        ..part.clone()
                    });
                }
            }
            Setting::Group(group) => {
                whole.fields = Some(group.fields().iter().map(|field| field.declaration.key).collect());
                for (Field { declaration, allowed }, number) in group.fields().iter().zip(group.numbers()) {
                    let is_shared = shared_keys.contains(&declaration.key);
                    let (initial, remaining_key) = declaration.key.split_at(1);
                    let key_with_group = || format!("{key}{}{remaining_key}", initial.to_uppercase());
                    let sentence = declaration.sentence;
                    parts.push(SettingDeclaration {
                        key: if is_shared { key_with_group() } else { declaration.key.to_owned() },
                        field: is_shared.then_some(declaration.key),
                        unit: declaration.unit,
                        min: Some(*allowed.start()),
                        max: Some(*allowed.end()),
                        default: to_raw_value(&number)?,
                        sentence: if each.is_empty() {
                            sentence.to_owned()
                        } else {
                            format!("{sentence} {each}.")
                        },
                        ..part.clone()
                    });
                }
            }
            _ => {}
        }
        declarations.push(whole);
        declarations.append(&mut parts);
        Ok(())
    })?;
    Ok(declarations)
}

/// Returns the keys of fields that belong to more than one group, such as two poses. Their attributes consist of the group's name and the
/// key.
fn shared_field_keys<S: Rules>() -> Vec<&'static str> {
    let (mut seen_keys, mut shared_keys) = (Vec::new(), Vec::new());
    S::default().visit_settings(&mut |_, setting| {
        if let Setting::Group(group) = setting {
            for Field { declaration, .. } in group.fields() {
                if seen_keys.contains(&declaration.key) { &mut shared_keys } else { &mut seen_keys }
                    .push(declaration.key);
            }
        }
    });
    shared_keys
}

/// Returns the minimum length of a list whose length may depend on a keyword, such as the motion model. Numbers beyond it may be null.
fn shortest_length<S: Rules>(list_key: &str) -> usize {
    let mut keywords = Vec::new();
    S::default().visit_settings(&mut |declaration, setting| {
        if let Setting::Keyword(keyword) = setting {
            keywords.extend(keyword.all().into_iter().map(|word| (declaration.key, word)));
        }
    });
    let mut shortest_length = usize::MAX;
    for (key, word) in keywords {
        let mut settings = S::default();
        settings.visit_settings(&mut |declaration, setting| match setting {
            Setting::Keyword(keyword) if declaration.key == key => assert!(keyword.set(word)),
            _ => {}
        });
        settings.visit_settings(&mut |declaration, setting| match setting {
            Setting::Numbers(numbers, _) if declaration.key == list_key => {
                shortest_length = shortest_length.min(numbers.len());
            }
            _ => {}
        });
    }
    shortest_length
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
