//! Random changes of settings, as a user can make them.

use super::input::InputReader;
use motion::sim::settings::{AllowedValues, Setting, SettingRules, SettingsError};

/// Returns the current settings with random changes.
pub fn change_settings<S: SettingRules>(current_settings: &S, fuzz_input: &mut InputReader) -> S {
    let (mut changed_settings, mut changed_keys) = (*current_settings, Vec::new());
    let setting_mask = u16::from_le_bytes(fuzz_input.next_bytes());
    let mut visited_count = 0;
    let _: Result<(), ()> = changed_settings.try_visit_settings(|setting_declaration, setting| {
        visited_count += 1;
        if setting_mask >> (visited_count - 1) & 1 == 1 {
            changed_keys.push(setting_declaration.key);
            set_any_value(setting, fuzz_input);
        }
        Ok(())
    });
    changed_settings.adjust_settings(current_settings, &changed_keys);
    changed_settings
}

fn set_any_value(setting: Setting, fuzz_input: &mut InputReader) {
    match setting {
        Setting::Number(setting_value, allowed) => *setting_value = fuzz_input.draw_number_near(&allowed),
        Setting::Integer(setting_value, allowed) => setting_value.set(fuzz_input.draw_integer_near(&allowed)),
        Setting::OptionalInteger(setting_value, allowed) => {
            *setting_value = fuzz_input.next_bool().then(|| fuzz_input.draw_integer_near(&allowed) as usize);
        }
        Setting::Boolean(setting_value) => *setting_value = fuzz_input.next_bool(),
        Setting::Keyword(setting_value) => {
            let keyword_choices = setting_value.all_keywords();
            assert!(
                setting_value.set(fuzz_input.choose_one(&keyword_choices))
                    && !setting_value.set("")
                    && !setting_value.set("__proto__")
            );
        }
        Setting::Numbers(setting_values, allowed) => setting_values
            .iter_mut()
            .for_each(|setting_value| *setting_value = fuzz_input.draw_number_near(&allowed)),
        // A noise level is one number that sets several α's. A noise level outside of its range is refused before it is converted to α's.
        Setting::Level(mut setting_value, allowed) => {
            setting_value.set(fuzz_input.draw_number_within(allowed))
        }
        Setting::Group(group_members, group_numbers) => {
            for (group_member, number) in group_members.iter().zip(group_numbers) {
                *number = fuzz_input.draw_number_near(&group_member.allowed);
            }
        }
    }
}

/// Returns true if the settings are allowed. Otherwise checks the message of the error.
pub fn are_settings_allowed<S: SettingRules>(settings: &S) -> bool {
    let Err(settings_error) = settings.check() else {
        assert_in_range(settings);
        return true;
    };
    let SettingsError { key: refused_key, value: refused_number, allowed: allowed_values } = &settings_error;
    let root_key = refused_key.split(['.', '[']).next();
    assert!(S::KEYS.iter().any(|known_key| Some(*known_key) == root_key), "{settings_error}");
    let error_message = settings_error.to_string();
    assert!(
        error_message.starts_with(refused_key) && error_message.contains("; allowed is "),
        "{error_message}"
    );
    match allowed_values {
        AllowedValues::Real(allowed_range) => {
            assert!(!allowed_range.contains(refused_number), "{error_message}")
        }
        AllowedValues::Integer(allowed_range) => {
            let integer_value = *refused_number as u64;
            assert!(
                integer_value as f64 != *refused_number || !allowed_range.contains(&integer_value),
                "{error_message}"
            );
        }
        AllowedValues::FitsInMemory | AllowedValues::Keyword { .. } => panic!("{error_message}"),
    }
    false
}

/// Asserts that every number of the settings is in its range.
fn assert_in_range<S: SettingRules>(settings: &S) {
    let mut settings = *settings;
    let _: Result<(), ()> = settings.try_visit_settings(|declaration, setting| {
        let is_in_range = match setting {
            Setting::Number(number, range) => range.contains(number),
            Setting::Integer(integer_value, range) => range.contains(&integer_value.get()),
            Setting::OptionalInteger(integer_value, range) => {
                integer_value.is_none_or(|integer_value| range.contains(&(integer_value as u64)))
            }
            Setting::Numbers(list_numbers, range) => list_numbers.iter().all(|number| range.contains(number)),
            Setting::Group(members, numbers) => {
                members.iter().zip(numbers).all(|(member, number)| member.allowed.contains(number))
            }
            Setting::Boolean(_) | Setting::Keyword(_) | Setting::Level(..) => true,
        };
        assert!(is_in_range, "{}", declaration.key);
        Ok(())
    });
}
