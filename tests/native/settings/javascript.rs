//! Generator of `www/settings.js`, in which scripts find the settings before the core is loaded. Messages about refused settings write
//! numbers as JavaScript does.

use motion::VelocityCmd;
use motion::map::{MAX_BYTES, MAX_PIXELS};
use motion::sim::picture::RAMP_STEPS;
use motion::sim::settings::{Declaration, DeclaredSettings, Field, Group, Setting};
use motion::sim::squeeze::{ACCEPTED_BIT, END_FREE_BIT, MAX_TRIAL_PARTS, PATH_FREE_BIT};
use motion::sim::{alpha_calibrator, arc_anatomy, banana, dead_reckoning, odometry_decomposer, squeeze};
use std::fmt::Write;
use std::ops::RangeInclusive;

const SETTINGS_JS_PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/www/settings.js");

#[test]
fn numbers_in_messages_are_formatted_as_in_javascript() {
    let assert_message = |field: &str, text: &str, change: &dyn Fn(&mut VelocityCmd)| {
        let mut settings = banana::Settings::default();
        change(&mut settings.command);
        let error = banana::BananaMachine::new(settings).expect_err(text);
        assert!(error.to_string().starts_with(&format!("command.{field} is {text}; ")), "{error}");
    };
    for (number, text) in [
        (f64::INFINITY, "Infinity"),
        (f64::NEG_INFINITY, "-Infinity"),
        (f64::NAN, "NaN"),
        (1e6 + 0.5, "1000000.5"),
        (-1e20, "-100000000000000000000"),
        (1e21, "1e21"),
        (-2.5e300, "-2.5e300"),
    ] {
        assert_message("v", text, &|command| command.v = number);
    }
    for (seconds, text) in [(0.0, "0"), (-0.000_001, "-0.000001"), (5e-7, "5e-7"), (-1e-300, "-1e-300")] {
        assert_message("dt", text, &|command| command.dt = seconds);
    }
}

#[test]
fn settings_js_equals_the_declarations_in_the_core() {
    let expected_text = settings_js();
    if std::env::var_os("UPDATE_SETTINGS").is_some() {
        std::fs::write(SETTINGS_JS_PATH, &expected_text).expect("www/settings.js can be written");
    }
    let existing_text = std::fs::read_to_string(SETTINGS_JS_PATH).unwrap_or_default();
    let equal_line_count = existing_text
        .lines()
        .zip(expected_text.lines())
        .take_while(|(existing, expected)| existing == expected)
        .count();
    assert!(
        existing_text == expected_text,
        "www/settings.js is stale, at line {}: `UPDATE_SETTINGS=1 cargo test --test native settings` writes it anew",
        equal_line_count + 1,
    );
}

fn settings_js() -> String {
    let banana::Settings { velocity_alphas, odometry_alphas, .. } = banana::Settings::default();
    let settings = [
        ("banana-machine", declaration_lines(banana::Settings::default(), &banana::ALPHA_SENTENCES)),
        ("map-squeeze", declaration_lines(squeeze::Settings::default(), &[])),
        ("arc-anatomy", declaration_lines(arc_anatomy::Settings::default(), &arc_anatomy::ALPHA_SENTENCES)),
        (
            "odometry-decomposer",
            declaration_lines(
                odometry_decomposer::Settings::default(),
                &odometry_decomposer::ALPHA_SENTENCES,
            ),
        ),
        (
            "dead-reckoning",
            declaration_lines(dead_reckoning::Settings::default(), &dead_reckoning::ALPHA_SENTENCES),
        ),
        ("alpha-calibrator", declaration_lines(alpha_calibrator::Settings::default(), &[])),
    ];
    let presets = [
        object_lines(banana::PRESETS.map(|banana::Preset { name, command, alphas }| {
            format!("name: '{name}', {}, alphas: {alphas:?}", group_entries(command))
        })),
        object_lines(
            squeeze::PRESETS
                .map(|(name, start)| format!("name: '{name}', start: {{ {} }}", group_entries(start))),
        ),
        object_lines(arc_anatomy::PRESETS.map(|arc_anatomy::Preset { name, command, next }| {
            let arc_anatomy::FinalPose { x, y, theta } = next;
            format!("name: '{name}', {}, nextX: {x}, nextY: {y}, nextTheta: {theta}", group_entries(command))
        })),
        object_lines(odometry_decomposer::PRESETS.map(|odometry_decomposer::Preset { name, from, to }| {
            format!("name: '{name}', from: {{ {} }}, to: {{ {} }}", group_entries(from), group_entries(to))
        })),
        object_lines(dead_reckoning::PRESETS.map(
            |dead_reckoning::Preset { name, command, steps, step, alphas }| {
                format!(
                    "name: '{name}', command: {{ {} }}, steps: {steps}, step: {step}, alphas: {alphas:?}",
                    group_entries(command)
                )
            },
        )),
    ];
    let presets =
        settings.iter().zip(presets).map(|((tag, _), lines)| list_entry(tag, &lines)).collect::<String>();
    let settings = settings.iter().map(|(tag, lines)| list_entry(tag, lines)).collect::<String>();
    format!(
        "{SETTINGS_JS_HEAD}
/** @type {{Record<string, Declaration[]>}} declared settings of each widget by its tag, in order */
export const settings = {{
{settings}}};

/** Presets of the widgets, by their tags. */
export const presets = {{
{presets}  'alpha-calibrator': [],
}};

/** Initial noise parameters of each model. */
export const openingAlphas = {{ velocity: {velocity_alphas:?}, odometry: {odometry_alphas:?} }};

/**
 * Limits of the core. `cells` is the maximum number of cells of a grid and of pixels of an image. `bytes` is the maximum size of an image
 * file. `trial` is the maximum product of samples and parts in a call of `MapSqueeze.trial`. `ramp` is the number of colours of a ramp.
 */
export const limits = {{ cells: {MAX_PIXELS}, bytes: {MAX_BYTES}, trial: {MAX_TRIAL_PARTS}, ramp: {RAMP_STEPS} }};

/** Bits of a verdict on an attempt of Map Squeeze. */
export const verdict = {{ endFree: {END_FREE_BIT}, pathFree: {PATH_FREE_BIT}, accepted: {ACCEPTED_BIT} }};
"
    )
}

/// Returns the entry of an object whose key is a tag, and whose value is a list with these lines.
fn list_entry(tag: &str, lines: &str) -> String {
    format!("  '{tag}': [\n{lines}  ],\n")
}

const SETTINGS_JS_HEAD: &str = "\
// Generated from the declarations in src/sim by `UPDATE_SETTINGS=1 cargo test --test native settings`. Do not edit it.

/**
 * Declaration of a setting.
 *
 * @typedef {object} Declaration
 * @property {string} key name of the setting as attribute, as property and in states
 * @property {string} [in] key of the group or list that contains the setting
 * @property {string} [of] key of another setting that this setting sets in another form
 * @property {number[]} [weights] ratios of the last numbers of that other setting to this setting
 * @property {string} [field] key in the group, if a field of another group has the same key
 * @property {number} [index] index in the list, from 0
 * @property {'word' | 'number' | 'whole' | 'boolean' | 'numbers' | 'group'} type
 * @property {string[]} [words] allowed words
 * @property {string[]} [fields] keys of the fields of a group
 * @property {string} [unit]
 * @property {boolean} [nullable] true if the value may be null
 * @property {number} [min] minimum of the number, or of each number of a list
 * @property {number} [max] maximum of the number, or of each number of a list
 * @property {string | number | boolean | number[] | null} [default] initial value
 * @property {string} sentence description
 */
";

/// Returns objects of JavaScript, one on each line.
fn object_lines(objects: impl IntoIterator<Item = String>) -> String {
    objects.into_iter().fold(String::new(), |mut text, object| {
        writeln!(text, "    {{ {object} }},").expect("a string takes all");
        text
    })
}

/// Returns a line of JavaScript, an object, for each setting, and for each number of a group or list. `number_sentences` describe the numbers of a list.
fn declaration_lines(mut defaults: impl DeclaredSettings, number_sentences: &[&str]) -> String {
    let mut objects = Vec::new();
    let shared_keys = shared_field_keys(&mut defaults);
    defaults.visit_settings(&mut |declaration, setting| {
        append_setting(declaration, setting, number_sentences, &shared_keys, &mut objects);
    });
    object_lines(objects)
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

/// Appends the JavaScript object that describes a setting. A setting with several numbers has another object for each of them.
fn append_setting(
    declaration: &Declaration,
    setting: Setting,
    number_sentences: &[&str],
    shared_keys: &[&str],
    objects: &mut Vec<String>,
) {
    let Declaration { key, of, sentence, unit } = *declaration;
    let of = of.map(|target| format!("of: '{target}', ")).unwrap_or_default();
    let unit = if unit.is_empty() { String::new() } else { format!("unit: '{unit}', ") };
    let mut append = |text: String| objects.push(format!("key: '{key}', {of}{text}, sentence: '{sentence}'"));
    match setting {
        Setting::Number(default_value, allowed) => {
            append(format!("type: 'number', {unit}{}, default: {default_value}", range_entries(&allowed)));
        }
        Setting::Integer(default_value, allowed) => {
            append(format!(
                "type: 'whole', {unit}{}, default: {}",
                range_entries(&allowed),
                default_value.get()
            ));
        }
        Setting::OptionalInteger(default_value, allowed) => {
            let default_value =
                default_value.map_or("null".to_owned(), |default_value| default_value.to_string());
            append(format!(
                "type: 'whole', nullable: true, {unit}{}, default: {default_value}",
                range_entries(&allowed)
            ));
        }
        Setting::Boolean(default_value) => append(format!("type: 'boolean', default: {default_value}")),
        Setting::Keyword(word) => {
            append(format!("type: 'word', words: {}, default: '{}'", js_array(word.all()), word.get()));
        }
        Setting::Level(level, allowed) => {
            let default_value = level.get().map_or("null".to_owned(), |level| level.to_string());
            let weights: Vec<f64> = level.weights().collect();
            append(format!(
                "weights: {weights:?}, type: 'number', nullable: true, {unit}{}, default: {default_value}",
                range_entries(&allowed)
            ));
        }
        Setting::Numbers(values, allowed) => {
            append(format!("type: 'numbers', {}, default: {values:?}", range_entries(&allowed)));
            for (index, (default_value, sentence)) in values.iter().zip(number_sentences).enumerate() {
                // The last numbers are null in models with fewer α's.
                let nullable = if sentence == &number_sentences[0] { "" } else { "nullable: true, " };
                objects.push(format!(
                    "key: 'alpha{}', in: '{key}', index: {index}, type: 'number', {nullable}{}, default: {default_value}, \
                     sentence: '{sentence}'",
                    index + 1,
                    range_entries(&allowed),
                ));
            }
        }
        Setting::Group(group) => {
            let keys = group.fields().iter().map(|field| field.declaration.key).collect();
            append(format!("type: 'group', fields: {}", js_array(keys)));
            for (i, field) in group.fields().iter().enumerate() {
                let default_value = *group.number(i);
                let Declaration { key: field_key, sentence, unit, .. } = field.declaration;
                let key_entries = if shared_keys.contains(&field_key) {
                    let (initial, remaining_key) = field_key.split_at(1);
                    format!(
                        "key: '{key}{}{remaining_key}', in: '{key}', field: '{field_key}'",
                        initial.to_uppercase()
                    )
                } else {
                    format!("key: '{field_key}', in: '{key}'")
                };
                objects.push(format!(
                    "{key_entries}, type: 'number', unit: '{unit}', {}, default: {default_value}, \
                     sentence: '{sentence}'",
                    range_entries(&field.allowed),
                ));
            }
        }
    }
}

fn range_entries<T: std::fmt::Display>(allowed: &RangeInclusive<T>) -> String {
    format!("min: {}, max: {}", allowed.start(), allowed.end())
}

fn js_array(words: Vec<&str>) -> String {
    format!("['{}']", words.join("', '"))
}

/// Returns the numbers of a group by their keys.
fn group_entries(mut group: impl Group) -> String {
    let numbers = group.fields().iter().enumerate();
    let entries: Vec<String> =
        numbers.map(|(i, field)| format!("{}: {}", field.declaration.key, group.number(i))).collect();
    entries.join(", ")
}
