//! Reader of configurations.json, which has settings of simulations and arguments of the methods whose results are digested.

use motion::sim::picture::{RAMP_STEP_COUNT, Ramp};
use motion::sim::settings::{Rules, Setting};
use motion::sim::views::Grid;
use serde_json::Value;

const CONFIGURATIONS: &str = include_str!("../../digest/configurations.json");

/// Configuration of a widget.
pub struct Configuration<'a> {
    pub document: &'a Value,
    pub widget: &'a str,
    pub name: &'a str,
    pub value: &'a Value,
}

pub fn parsed_configurations() -> Value {
    serde_json::from_str(CONFIGURATIONS).expect("configurations.json is JSON")
}

/// Returns every configuration of every widget.
pub fn configurations_of(document: &Value) -> impl Iterator<Item = Configuration<'_>> {
    let widgets_json = document["widgets"].as_object().expect("widgets");
    widgets_json.iter().flat_map(move |(widget, entry)| {
        let configurations_json = entry["configurations"].as_object().expect("configurations");
        configurations_json.iter().map(move |(name, value)| Configuration { document, widget, name, value })
    })
}

impl Configuration<'_> {
    /// Returns the preset on which the configuration is based, or the defaults, with the settings of the configuration.
    pub fn settings<S: Rules>(&self) -> S {
        let preset_name = self.value.get("preset").map(|name| name.as_str().expect("a name"));
        let is_named = |(name, _): &&(&str, S)| preset_name == Some(*name);
        let defaults = match S::PRESETS.iter().find(is_named) {
            Some((_, settings)) => *settings,
            None if preset_name.is_none() => S::default(),
            None => panic!("{preset_name:?} is no preset"),
        };
        let given_settings = self.value["settings"].as_object().expect("settings");
        let unknown_key = given_settings.keys().find(|key| !S::KEYS.contains(&key.as_str()));
        assert!(unknown_key.is_none(), "{}/{} has {unknown_key:?}", self.widget, self.name);
        let (mut settings, mut given_keys) = (defaults, Vec::new());
        settings.visit_settings(&mut |declaration, setting| {
            if let Some(value) = given_settings.get(declaration.key) {
                given_keys.push(declaration.key);
                set_from_json(setting, value);
            }
        });
        settings.adjust(&defaults, &given_keys);
        settings
    }

    pub fn grid(&self) -> Grid {
        let bounds = self.value.get("bounds").unwrap_or(&self.document["widgets"][self.widget]["bounds"]);
        let [x_min, y_min, x_max, y_max] = numbers_of(bounds);
        let picture_size = |key| self.document["picture"][key].as_u64().expect("a size") as usize;
        Grid {
            min: [x_min, y_min],
            max: [x_max, y_max],
            columns: picture_size("columns"),
            rows: picture_size("rows"),
        }
    }
}

fn set_from_json(setting: Setting, value: &Value) {
    match setting {
        Setting::Number(slot, _) => *slot = number_of(value),
        Setting::Integer(slot, _) => slot.set(value.as_u64().expect("a whole number")),
        Setting::OptionalInteger(slot, _) => *slot = value.as_u64().map(|whole| whole as usize),
        Setting::Boolean(slot) => *slot = value.as_bool().expect("true or false"),
        Setting::Keyword(slot) => assert!(slot.set(value.as_str().expect("a word")), "{value}"),
        Setting::Numbers(slots, _) => {
            let given_numbers = value.as_array().expect("a list");
            assert_eq!(given_numbers.len(), slots.len(), "{value}");
            slots.iter_mut().zip(given_numbers).for_each(|(slot, value)| *slot = number_of(value));
        }
        Setting::Level(mut slot, _) => slot.set(number_of(value)),
        Setting::Group(group) => {
            for (field, number) in group.fields().iter().zip(group.numbers_mut()) {
                *number = number_of(&value[field.declaration.key]);
            }
        }
    }
}

pub fn number_of(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

pub fn numbers_of<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| number_of(&value[i]))
}

/// Returns a colour ramp with the same distinct colours as in digest.js.
pub fn test_ramp(ramp_index: usize) -> Ramp {
    std::array::from_fn(|i| [i as u8, (RAMP_STEP_COUNT - 1 - i) as u8, 85 * ramp_index as u8, 255])
}
