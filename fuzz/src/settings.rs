//! Changes settings to any values, as users do.

use super::input::Input;
use motion::sim::settings::{AllowedValues, Group, Rules, Setting, SettingsError};

/// Returns the current settings with some of them changed.
pub fn change_settings<S: Rules>(current: &S, input: &mut Input) -> S {
    let (mut settings, mut changed_keys) = (*current, Vec::new());
    let setting_mask = u16::from_le_bytes(input.next_bytes());
    let mut setting_count = 0;
    let _: Result<(), ()> = settings.try_visit_settings(|declaration, setting| {
        setting_count += 1;
        if setting_mask >> (setting_count - 1) & 1 == 1 {
            changed_keys.push(declaration.key);
            set_any_value(setting, input);
        }
        Ok(())
    });
    settings.adjust(current, &changed_keys);
    settings
}

fn set_any_value(setting: Setting, input: &mut Input) {
    match setting {
        Setting::Number(slot, allowed) => *slot = input.draw_number_near(&allowed),
        Setting::Integer(slot, allowed) => slot.set(input.draw_integer_near(&allowed)),
        Setting::OptionalInteger(slot, allowed) => {
            *slot = input.next_bool().then(|| input.draw_integer_near(&allowed) as usize);
        }
        Setting::Boolean(slot) => *slot = input.next_bool(),
        Setting::Keyword(slot) => {
            let keywords = slot.all();
            assert!(slot.set(input.choose_one(&keywords)) && !slot.set("") && !slot.set("__proto__"));
        }
        Setting::Numbers(slots, allowed) => {
            slots.iter_mut().for_each(|slot| *slot = input.draw_number_near(&allowed))
        }
        // A level outside of its range is refused earlier, before it is converted to the numbers that it sets.
        Setting::Level(mut slot, allowed) => slot.set(input.draw_number_within(allowed)),
        Setting::Group(group) => {
            for (field, number) in group.fields().iter().zip(group.numbers_mut()) {
                *number = input.draw_number_near(&field.allowed);
            }
        }
    }
}

/// Returns true if the settings are allowed, and checks the message if not.
pub fn are_settings_allowed<S: Rules>(settings: &S) -> bool {
    let Err(error) = settings.check() else {
        assert_in_range(settings);
        return true;
    };
    let SettingsError { field, value, allowed } = &error;
    let root_key = field.split(['.', '[']).next();
    assert!(S::KEYS.iter().any(|key| Some(*key) == root_key), "{error}");
    let message = error.to_string();
    assert!(message.starts_with(field) && message.contains("; allowed is "), "{message}");
    match allowed {
        AllowedValues::Real(range) => assert!(!range.contains(value), "{message}"),
        AllowedValues::Integer(range) => {
            let integer_value = *value as u64;
            assert!(integer_value as f64 != *value || !range.contains(&integer_value), "{message}");
        }
        AllowedValues::FitsInMemory | AllowedValues::Keyword { .. } => panic!("{message}"),
    }
    false
}

/// Asserts that every number is in its range.
fn assert_in_range<S: Rules>(settings: &S) {
    let mut settings = *settings;
    let _: Result<(), ()> = settings.try_visit_settings(|declaration, setting| {
        let is_in_range = match setting {
            Setting::Number(number, range) => range.contains(number),
            Setting::Integer(whole, range) => range.contains(&whole.get()),
            Setting::OptionalInteger(whole, range) => {
                whole.is_none_or(|whole| range.contains(&(whole as u64)))
            }
            Setting::Numbers(numbers, range) => numbers.iter().all(|number| range.contains(number)),
            Setting::Group(group) => is_group_in_range(group),
            Setting::Boolean(_) | Setting::Keyword(_) | Setting::Level(..) => true,
        };
        assert!(is_in_range, "{}", declaration.key);
        Ok(())
    });
}

fn is_group_in_range(group: &dyn Group) -> bool {
    group.fields().iter().zip(group.numbers()).all(|(field, number)| field.allowed.contains(&number))
}
