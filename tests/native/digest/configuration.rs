//! Reader of configurations.json, which has settings of simulations and arguments of the methods whose results are digested.

use motion::sim::picture::{RAMP_STEP_COUNT, Ramp};
use motion::sim::settings::{Setting, SettingRules};
use motion::sim::views::ViewGrid;
use serde_json::Value;

const CONFIGURATIONS_JSON: &str = include_str!("../../digest/configurations.json");

pub struct Configuration<'a> {
    pub configurations_json: &'a Value,
    pub widget_tag: &'a str,
    pub configuration_name: &'a str,
    pub settings_json: &'a Value,
}

pub fn parse_configurations() -> Value {
    serde_json::from_str(CONFIGURATIONS_JSON).expect("configurations.json is JSON")
}

pub fn configurations_of(configurations_json: &Value) -> impl Iterator<Item = Configuration<'_>> {
    let widgets_json = configurations_json["widgets"].as_object().expect("widgets");
    widgets_json.iter().flat_map(move |(widget_name, widget_json)| {
        let settings_by_name = widget_json["configurations"].as_object().expect("configurations");
        settings_by_name.iter().map(move |(configuration_name, settings_json)| Configuration {
            configurations_json,
            widget_tag: widget_name,
            configuration_name,
            settings_json,
        })
    })
}

impl Configuration<'_> {
    /// Returns the preset on which the configuration is based, or the defaults, with the settings of the configuration.
    pub fn read_settings<S: SettingRules>(&self) -> S {
        let preset_name =
            self.settings_json.get("preset").map(|name_json| name_json.as_str().expect("a name"));
        let is_named_preset = |(configuration_name, _): &&(&str, S)| preset_name == Some(*configuration_name);
        let default_settings = match S::PRESETS.iter().find(is_named_preset) {
            Some((_, configured_settings)) => *configured_settings,
            None if preset_name.is_none() => S::default(),
            None => panic!("{preset_name:?} is no preset"),
        };
        let given_settings = self.settings_json["settings"].as_object().expect("settings");
        let unknown_key = given_settings.keys().find(|setting_key| !S::KEYS.contains(&setting_key.as_str()));
        assert!(unknown_key.is_none(), "{}/{} has {unknown_key:?}", self.widget_tag, self.configuration_name);
        let (mut configured_settings, mut given_keys) = (default_settings, Vec::new());
        configured_settings.visit_settings(&mut |setting_declaration, setting_value| {
            if let Some(setting_json) = given_settings.get(setting_declaration.key) {
                given_keys.push(setting_declaration.key);
                set_from_json(setting_value, setting_json);
            }
        });
        configured_settings.adjust_settings(&default_settings, &given_keys);
        configured_settings
    }

    pub fn view_grid(&self) -> ViewGrid {
        let view_bounds = self
            .settings_json
            .get("bounds")
            .unwrap_or(&self.configurations_json["widgets"][self.widget_tag]["bounds"]);
        let [x_min, y_min, x_max, y_max] = to_numbers(view_bounds);
        let view_size_of =
            |size_key| self.configurations_json["picture"][size_key].as_u64().expect("a size") as usize;
        ViewGrid {
            min_corner: [x_min, y_min],
            max_corner: [x_max, y_max],
            column_count: view_size_of("columns"),
            row_count: view_size_of("rows"),
        }
    }
}

fn set_from_json(changed_setting: Setting, setting_json: &Value) {
    match changed_setting {
        Setting::Number(setting_value, _) => *setting_value = to_number(setting_json),
        Setting::Integer(setting_value, _) => {
            setting_value.set(setting_json.as_u64().expect("a whole number"))
        }
        Setting::OptionalInteger(setting_value, _) => {
            *setting_value = setting_json.as_u64().map(|whole_number| whole_number as usize)
        }
        Setting::Boolean(setting_value) => *setting_value = setting_json.as_bool().expect("true or false"),
        Setting::Keyword(setting_value) => {
            assert!(setting_value.set(setting_json.as_str().expect("a word")), "{setting_json}")
        }
        Setting::Numbers(setting_values, _) => {
            let given_numbers = setting_json.as_array().expect("a list");
            assert_eq!(given_numbers.len(), setting_values.len(), "{setting_json}");
            setting_values
                .iter_mut()
                .zip(given_numbers)
                .for_each(|(setting_value, number_json)| *setting_value = to_number(number_json));
        }
        Setting::Level(mut setting_value, _) => setting_value.set(to_number(setting_json)),
        Setting::Group(group_members, group_numbers) => {
            for (group_member, group_number) in group_members.iter().zip(group_numbers) {
                *group_number = to_number(&setting_json[group_member.declaration.key]);
            }
        }
    }
}

pub fn to_number(number_json: &Value) -> f64 {
    number_json.as_f64().unwrap_or_else(|| panic!("{number_json} is no number"))
}

pub fn to_numbers<const N: usize>(numbers_json: &Value) -> [f64; N] {
    std::array::from_fn(|i| to_number(&numbers_json[i]))
}

/// Returns a colour ramp with the same distinct colours as in digest.js.
pub fn new_test_ramp(ramp_index: usize) -> Ramp {
    std::array::from_fn(|i| [i as u8, (RAMP_STEP_COUNT - 1 - i) as u8, 85 * ramp_index as u8, 255])
}
