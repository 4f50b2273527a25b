//! configurations.json: settings of machines, and the arguments of the methods that are digested.

use motion::sim::picture::{RAMP_STEPS, Ramp};
use motion::sim::settings::{Rules, Setting};
use motion::sim::views::Grid;
use serde_json::Value;

const CONFIGURATIONS: &str = include_str!("../../digest/configurations.json");

/// One line of the list.
pub struct Configuration<'a> {
    pub all: &'a Value,
    pub widget: &'a str,
    pub name: &'a str,
    pub value: &'a Value,
}

pub fn list() -> Value {
    serde_json::from_str(CONFIGURATIONS).expect("configurations.json is JSON")
}

/// Arguments for each widget.
pub fn each(all: &Value) -> impl Iterator<Item = Configuration<'_>> {
    let widgets = all["widgets"].as_object().expect("widgets");
    widgets.iter().flat_map(move |(widget, said)| {
        let configurations = said["configurations"].as_object().expect("configurations");
        configurations.iter().map(move |(name, value)| Configuration { all, widget, name, value })
    })
}

impl Configuration<'_> {
    /// Returns the settings with the values of the configuration.
    pub fn settings<S: Rules>(&self, opening: S) -> S {
        let given = self.value["settings"].as_object().expect("settings");
        let unknown = given.keys().find(|key| !S::KEYS.contains(&key.as_str()));
        assert!(unknown.is_none(), "{}/{} has {unknown:?}", self.widget, self.name);
        let (mut settings, mut named) = (opening, Vec::new());
        let _ = settings.try_each(|declaration, setting| {
            if let Some(value) = given.get(declaration.key) {
                named.push(declaration.key);
                set(setting, value);
            }
            Ok::<_, ()>(())
        });
        settings.settle(&opening, &named);
        settings
    }

    /// Returns the preset that the configuration begins with.
    pub fn preset<'a, P>(&self, presets: &'a [P], name: impl Fn(&'a P) -> &'a str) -> Option<&'a P> {
        let wanted = self.value.get("preset")?;
        Some(presets.iter().find(|preset| wanted == name(preset)).expect("a preset of that name"))
    }

    pub fn grid(&self) -> Grid {
        let bounds = self.value.get("bounds").unwrap_or(&self.all["widgets"][self.widget]["bounds"]);
        let [x_min, y_min, x_max, y_max] = numbers(bounds);
        let size = |key| self.all["picture"][key].as_u64().expect("a size") as usize;
        Grid { min: [x_min, y_min], max: [x_max, y_max], columns: size("columns"), rows: size("rows") }
    }
}

fn set(setting: Setting, value: &Value) {
    match setting {
        Setting::Number(slot, _) => *slot = number(value),
        Setting::Whole(slot, _) => slot.set(value.as_u64().expect("a whole number")),
        Setting::WholeOrNone(slot, _) => *slot = value.as_u64().map(|whole| whole as usize),
        Setting::Truth(slot) => *slot = value.as_bool().expect("true or false"),
        Setting::Word(slot) => assert!(slot.set(value.as_str().expect("a word")), "{value}"),
        Setting::Numbers(slots, _) => {
            let given = value.as_array().expect("a list");
            assert_eq!(given.len(), slots.len(), "{value}");
            slots.iter_mut().zip(given).for_each(|(slot, value)| *slot = number(value));
        }
        Setting::Level(slot, _) => slot.set(number(value)),
        Setting::Group(group) => {
            for (i, field) in group.fields().iter().enumerate() {
                *group.number(i) = number(&value[field.declaration.key]);
            }
        }
    }
}

pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

pub fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| number(&value[i]))
}

/// Returns distinct colours, as digest.js does.
pub fn ramp(which: usize) -> Ramp {
    std::array::from_fn(|i| [i as u8, (RAMP_STEPS - 1 - i) as u8, 85 * which as u8, 255])
}
