//! Settings of the widgets, declared by `settings!`, and checks of their values.

mod error;
mod groups;

pub use error::{AllowedValues, SettingsError};
pub(crate) use error::{check_integer, check_real};
pub use groups::GroupMember;

use super::noise_level::NoiseLevel;
use crate::models::{OdomDelta, VelocityCmd};
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};
use std::ops::RangeInclusive;

/// Range of positions (m), angles (rad) and speeds (m/s, rad/s). It is far larger than any robot needs, and products of squares of its
/// numbers do not overflow.
pub const QUANTITY_RANGE: RangeInclusive<f64> = -1e6..=1e6;
/// Range of the noise parameters α, chosen for the same reasons as [`QUANTITY_RANGE`].
pub const ALPHA_RANGE: RangeInclusive<f64> = 0.0..=1e6;
/// Range of durations. With shorter durations v̂ = length/Δt would lose the digits that distinguish samples.
pub const DURATION_RANGE: RangeInclusive<f64> = 1e-6..=1e6;
/// Largest integer up to which JavaScript's numbers are exact.
pub const MAX_SEED: u64 = (1 << 53) - 1;

/// Description of a setting, without its type and range.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Declaration {
    /// Name of the setting in attributes and states.
    pub key: &'static str,
    /// Name of another setting that this setting sets in another form, if there is one: a noise level sets `alphas`.
    pub of: Option<&'static str>,
    // WebAssembly modules omit the descriptions, which no page shows.
    /// Description of the setting.
    #[cfg(not(target_arch = "wasm32"))]
    pub sentence: &'static str,
    /// Unit; "" for a number without one.
    #[cfg(not(target_arch = "wasm32"))]
    pub unit: &'static str,
    /// Description of each number of a list that is an attribute. For a pose or command: text that is appended to the description of each
    /// of its numbers.
    #[cfg(not(target_arch = "wasm32"))]
    pub each: &'static str,
}

impl Declaration {
    #[cfg_attr(target_arch = "wasm32", expect(unused_variables, reason = "modules omit the descriptions"))]
    pub(crate) const fn new(
        key: &'static str,
        of: &'static str,
        setting_sentence: &'static str,
        setting_unit: &'static str,
        number_sentence: &'static str,
    ) -> Self {
        Self {
            key,
            of: if of.is_empty() { None } else { Some(of) },
            #[cfg(not(target_arch = "wasm32"))]
            sentence: setting_sentence.trim_ascii(),
            #[cfg(not(target_arch = "wasm32"))]
            unit: setting_unit,
            #[cfg(not(target_arch = "wasm32"))]
            each: number_sentence,
        }
    }
}

/// Reference to the value of a setting, with the range of its numbers.
pub enum Setting<'a> {
    /// Number with its allowed range.
    Number(&'a mut f64, RangeInclusive<f64>),
    /// Integer with its allowed range.
    Integer(&'a mut dyn IntegerSetting, RangeInclusive<u64>),
    /// Integer with its allowed range, or null (None).
    OptionalInteger(&'a mut Option<usize>, RangeInclusive<u64>),
    /// Boolean: true or false.
    Boolean(&'a mut bool),
    /// Value of an enum, by its keyword.
    Keyword(&'a mut dyn KeywordSetting),
    /// List of fixed length, whose numbers have one common range.
    Numbers(&'a mut [f64], RangeInclusive<f64>),
    /// Noise level, which sets several α's in fixed ratios, and its range.
    Level(NoiseLevel<'a>, RangeInclusive<f64>),
    /// Three numbers with names, such as the coordinates of a pose.
    Group(&'static [GroupMember; 3], [&'a mut f64; 3]),
}

impl Setting<'_> {
    /// Checks that the numbers are in their ranges. Fails with [`SettingsError`] for the first number out of its range.
    pub(crate) fn check(self, key: &str) -> Result<(), SettingsError> {
        match self {
            Self::Number(setting_number, allowed) => check_real(key, *setting_number, &allowed),
            Self::Integer(integer, allowed) => check_integer(key, integer.get() as f64, &allowed).map(|_| ()),
            Self::OptionalInteger(Some(integer), allowed) => {
                check_integer(key, *integer as f64, &allowed).map(|_| ())
            }
            Self::Numbers(setting_numbers, allowed) => {
                let mut indexed_numbers = setting_numbers.iter().enumerate();
                indexed_numbers.try_for_each(|(i, setting_number)| {
                    check_real(&format!("{key}[{i}]"), *setting_number, &allowed)
                })
            }
            Self::Group(group_members, setting_numbers) => {
                let mut declared_numbers = group_members.iter().zip(setting_numbers);
                declared_numbers.try_for_each(|(GroupMember { declaration, allowed }, setting_number)| {
                    check_real(&format!("{key}.{}", declaration.key), *setting_number, allowed)
                })
            }
            // The α's that a noise level sets are checked instead of the level.
            Self::OptionalInteger(None, _) | Self::Boolean(_) | Self::Keyword(_) | Self::Level(..) => Ok(()),
        }
    }
}

impl Serialize for Setting<'_> {
    fn serialize<S: Serializer>(&self, value_serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(setting_number, _) => setting_number.serialize(value_serializer),
            Self::Integer(integer, _) => integer.get().serialize(value_serializer),
            Self::OptionalInteger(integer, _) => integer.serialize(value_serializer),
            Self::Boolean(boolean) => boolean.serialize(value_serializer),
            Self::Keyword(setting_keyword) => setting_keyword.get().serialize(value_serializer),
            Self::Numbers(setting_numbers, _) => setting_numbers.serialize(value_serializer),
            Self::Level(noise_level, _) => noise_level.get().serialize(value_serializer),
            Self::Group(group_members, setting_numbers) => {
                let mut serialized_object = value_serializer.serialize_struct("", setting_numbers.len())?;
                for (group_member, setting_number) in group_members.iter().zip(setting_numbers) {
                    serialized_object.serialize_field(group_member.declaration.key, setting_number)?;
                }
                serialized_object.end()
            }
        }
    }
}

/// Serializes settings as an object, without settings that are alternative forms of others.
pub(crate) fn serialize_settings<S: DeclaredSettings, Z: Serializer>(
    mut settings: S,
    value_serializer: Z,
) -> Result<Z::Ok, Z::Error> {
    let mut settings_object = value_serializer.serialize_struct("", S::KEYS.len())?;
    settings.try_visit_settings(|declaration, setting| match declaration.of {
        None => settings_object.serialize_field(declaration.key, &setting),
        Some(_) => Ok(()),
    })?;
    settings_object.end()
}

/// Reference to an integer setting, whatever its integer type.
pub trait IntegerSetting {
    /// Returns the integer.
    fn get(&self) -> u64;
    /// Sets the integer, which must be in the range of its type.
    fn set(&mut self, integer: u64);
}

/// Enum whose values users write as keywords (strings) in settings, attributes and states.
pub trait HasKeywords: Copy + 'static {
    /// Pairs of a keyword and the value of the enum that it stands for.
    const KEYWORDS: &'static [(&'static str, Self)];
}

/// Implements [`HasKeywords`] for an enum.
macro_rules! keywords {
    ($enum:ty: $($keyword:literal = $value:expr),+) => {
        impl $crate::sim::settings::HasKeywords for $enum {
            const KEYWORDS: &'static [(&'static str, Self)] = &[$(($keyword, $value)),+];
        }
    };
}
pub(crate) use keywords;

/// Reference to a setting of any enum that implements [`HasKeywords`].
pub trait KeywordSetting {
    /// Returns the keyword of the value.
    fn get(&self) -> &'static str;
    /// Sets the value by its keyword. Returns false if the keyword is not in [`KeywordSetting::all_keywords`].
    fn set(&mut self, setting_keyword: &str) -> bool;
    /// Returns the keywords of all values.
    fn all_keywords(&self) -> Vec<&'static str>;
}

impl<T: HasKeywords> KeywordSetting for T {
    fn get(&self) -> &'static str {
        let enum_discriminant = std::mem::discriminant(self);
        T::KEYWORDS
            .iter()
            .find(|(_, enum_value)| std::mem::discriminant(enum_value) == enum_discriminant)
            .map_or("", |(setting_keyword, _)| setting_keyword)
    }

    fn set(&mut self, setting_keyword: &str) -> bool {
        let matching_keyword =
            T::KEYWORDS.iter().find(|(known_keyword, _)| *known_keyword == setting_keyword);
        matching_keyword.inspect(|(_, enum_value)| *self = *enum_value).is_some()
    }

    fn all_keywords(&self) -> Vec<&'static str> {
        T::KEYWORDS.iter().map(|(setting_keyword, _)| *setting_keyword).collect()
    }
}

/// Type that a setting may have, such as a number or a list of numbers.
pub trait SettingValue {
    /// Type that states the allowed values of the setting in its declaration, for example a range.
    type Range;
    /// Returns a [`Setting`] that borrows this value, so that it can be read and changed. `allowed` are the values that are accepted.
    fn setting(&mut self, allowed: Self::Range) -> Setting<'_>;
}

impl<T: HasKeywords> SettingValue for T {
    type Range = ();
    fn setting(&mut self, (): ()) -> Setting<'_> {
        Setting::Keyword(self)
    }
}

/// Implements [`SettingValue`] for each listed type, with the type of its range, and the expression that makes the setting.
macro_rules! setting_values {
    ($($type:ty, $range:ty: |$value:ident, $allowed:pat_param| $setting:expr;)+) => {$(
        impl SettingValue for $type {
            type Range = $range;
            fn setting(&mut self, $allowed: $range) -> Setting<'_> {
                let $value = self;
                $setting
            }
        }
    )+};
}
setting_values! {
    f64, RangeInclusive<f64>: |number, allowed| Setting::Number(number, allowed);
    u32, RangeInclusive<u64>: |integer, allowed| Setting::Integer(integer, allowed);
    u64, RangeInclusive<u64>: |integer, allowed| Setting::Integer(integer, allowed);
    usize, RangeInclusive<u64>: |integer, allowed| Setting::Integer(integer, allowed);
    Option<usize>, RangeInclusive<u64>: |integer, allowed| Setting::OptionalInteger(integer, allowed);
    bool, (): |boolean, ()| Setting::Boolean(boolean);
    [f64], RangeInclusive<f64>: |numbers, allowed| Setting::Numbers(numbers, allowed);
    [f64; 5], RangeInclusive<f64>: |numbers, allowed| Setting::Numbers(numbers, allowed);
    [f64; 6], RangeInclusive<f64>: |numbers, allowed| Setting::Numbers(numbers, allowed);
    NoiseLevel<'_>, RangeInclusive<f64>: |level, allowed| Setting::Level(NoiseLevel(level.0), allowed);
    [f64; 3], (): |pose, ()| Setting::Group(&groups::POSE_MEMBERS, pose.each_mut());
    VelocityCmd, (): |command, ()| {
        Setting::Group(&groups::COMMAND_MEMBERS, [&mut command.v, &mut command.omega, &mut command.dt])
    };
    OdomDelta, (): |reading, ()| {
        Setting::Group(&groups::READING_MEMBERS, [&mut reading.rot1, &mut reading.trans, &mut reading.rot2])
    };
}

macro_rules! integers {
    ($($type:ty),+) => {$(
        impl IntegerSetting for $type {
            fn get(&self) -> u64 {
                *self as u64
            }
            fn set(&mut self, integer: u64) {
                *self = integer as $type;
            }
        }
    )+};
}
integers!(u32, u64, usize);

/// Function that is called with each setting and its declaration.
pub type SettingVisitor<'a> = dyn FnMut(&'static Declaration, Setting) + 'a;

/// Settings of a widget that can be visited one by one. `settings!` implements it.
pub trait DeclaredSettings: Copy + Default + Serialize {
    /// Names of the settings, in the order of declaration.
    const KEYS: &'static [&'static str];

    /// Calls `visit_setting` for each setting, in the order of declaration.
    fn visit_settings(&mut self, visit_setting: &mut SettingVisitor);

    /// Calls `visit_setting` for each setting, in the order of declaration, until it returns an error. Returns that error.
    fn try_visit_settings<E>(
        &mut self,
        mut visit_setting: impl FnMut(&'static Declaration, Setting) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut visit_result = Ok(());
        self.visit_settings(&mut |declaration, setting| {
            if visit_result.is_ok() {
                visit_result = visit_setting(declaration, setting);
            }
        });
        visit_result
    }
}

/// Rules that connect several settings of a widget, and its presets.
pub trait SettingRules: DeclaredSettings + 'static {
    /// Presets, each with its name in attributes and states.
    const PRESETS: &'static [(&'static str, Self)] = &[];

    /// Adjusts other settings to the settings whose keys are `changed_keys`.
    fn adjust_settings(&mut self, _previous: &Self, _changed_keys: &[&str]) {}

    /// Checks combinations of settings, each of which is in its range. Fails with [`SettingsError`] for settings that contradict each
    /// other.
    fn check_combinations(&self) -> Result<(), SettingsError> {
        Ok(())
    }

    /// Checks each setting, and combinations of settings. Fails with [`SettingsError`] for the first setting out of range.
    fn check(&self) -> Result<(), SettingsError> {
        let mut settings = *self;
        settings.try_visit_settings(|declaration, setting| setting.check(declaration.key))?;
        self.check_combinations()
    }
}

/// Declares the settings of a widget. Each has a sentence (its comment), a name, a type and a default. Numbers also
/// have a range, and a unit if they are not dimensionless:
///
/// ```text
/// /// Radius of the robot.
/// clearance: f64 = 0.13, "m", in 0.0..=10.0;
/// ```
///
/// - `as` gives the key in JavaScript, if it differs from the name of the field.
/// - `up to` names a method that returns the end of the range, if it depends on other settings.
/// - `by` names a method that returns a reference to the value, if the setting is not a field.
/// - `of` names the setting that this setting sets in another form, such as `alphas` for a noise level.
/// - `each` describes each number of a list. For a pose or command, it is appended to the description of each of its numbers.
/// - `kept` lists fields of the struct that are not settings.
macro_rules! settings {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $(
                #[doc = $sentence:literal]
                $field:ident $(as $key:literal)?
                $(: $type:ty = $default:expr $(, $unit:literal)?)?
                $(, by $accessor:ident $(of $original:ident)?)?
                $(, in $range:expr $(, up to $max:ident)?)?
                $(, each $each:literal)?
                ;
            )+
            $(kept { $($(#[$kept_meta:meta])* $kept:ident: $kept_type:ty = $kept_default:expr;)+ })?
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $($(#[doc = $sentence] $(#[doc = concat!(" In ", $unit, ".")])? pub $field: $type,)?)+
            $($($(#[$kept_meta])* pub $kept: $kept_type,)+)?
        }

        impl $name {
            /// Settings with which the widget opens.
            pub const DEFAULT: Self = Self { $($($field: $default,)?)+ $($($kept: $kept_default,)+)? };
        }

        impl Default for $name {
            fn default() -> Self {
                Self::DEFAULT
            }
        }

        impl serde::Serialize for $name {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $crate::sim::settings::serialize_settings(*self, serializer)
            }
        }

        impl $crate::sim::settings::DeclaredSettings for $name {
            const KEYS: &'static [&'static str] = &[$(settings!(@key $field $($key)?)),+];

            fn visit_settings(&mut self, visit: &mut $crate::sim::settings::SettingVisitor) {
                use $crate::sim::settings::{Declaration, SettingValue};
                $(visit(
                    const {
                        &Declaration::new(
                            settings!(@key $field $($key)?),
                            stringify!($($($original)?)?),
                            $sentence,
                            concat!($($($unit)?)?),
                            concat!($($each)?),
                        )
                    },
                    settings!(@place self $field $($accessor)?)
                        .setting(settings!(@allowed self $($range $(, $max)?)?)),
                );)+
            }
        }
    };
    (@key $field:ident) => { stringify!($field) };
    (@key $field:ident $key:literal) => { $key };
    (@allowed $this:ident) => { () };
    (@allowed $this:ident $range:expr) => { $range };
    (@allowed $this:ident $range:expr, $max:ident) => { *($range).start()..=$this.$max() };
    (@place $this:ident $field:ident) => { $this.$field };
    (@place $this:ident $field:ident $accessor:ident) => { $this.$accessor() };
}
pub(crate) use settings;
