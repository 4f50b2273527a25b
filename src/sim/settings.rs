//! Settings, each declared once by `settings!`, and the refusal of what they do not allow.

use std::fmt;
use std::ops::{ControlFlow, RangeInclusive};

/// A parameter outside its range. The message names the field, the value and what is allowed.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingsError {
    pub field: String,
    pub value: f64,
    pub allowed: Allowed,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Allowed {
    Real(RangeInclusive<f64>),
    Whole(RangeInclusive<u64>),
    /// A number for which there is memory.
    LessMemory,
    /// Another word than this one.
    Word {
        is: &'static str,
        allowed: &'static str,
    },
}

impl SettingsError {
    /// Returns a sample count for which memory does not suffice.
    pub(crate) fn no_memory(samples: usize) -> Self {
        Self { field: "samples".to_owned(), value: samples as f64, allowed: Allowed::LessMemory }
    }

    /// Returns the message, with numbers as `number` prints them. WebAssembly leaves that to JavaScript: Rust's own
    /// printing of floating point takes an eighth of the module.
    pub fn message(&self, number: impl Fn(f64) -> String) -> String {
        let allowed = match &self.allowed {
            Allowed::Word { is, allowed } => return format!("{} is {is}; allowed is {allowed}", self.field),
            Allowed::Real(range) => {
                format!("a number from {} to {}", number(*range.start()), number(*range.end()))
            }
            Allowed::Whole(range) => format!("a whole number from {} to {}", range.start(), range.end()),
            Allowed::LessMemory => "a number for which there is memory".to_owned(),
        };
        format!("{} is {}; allowed is {allowed}", self.field, number(self.value))
    }
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message(number))
    }
}

impl std::error::Error for SettingsError {}

/// Returns a number as JavaScript would print it.
fn number(value: f64) -> String {
    if value.is_infinite() {
        return if value > 0.0 { "Infinity" } else { "-Infinity" }.to_owned();
    }
    let plain = value.abs() >= 1e-6 && value.abs() < 1e21;
    if plain || value == 0.0 || value.is_nan() { format!("{value}") } else { format!("{value:e}") }
}

pub(crate) fn check_real(
    field: &str,
    value: f64,
    allowed: &RangeInclusive<f64>,
) -> Result<(), SettingsError> {
    if allowed.contains(&value) {
        return Ok(());
    }
    Err(SettingsError { field: field.to_owned(), value, allowed: Allowed::Real(allowed.clone()) })
}

/// Returns the whole number that a double is, of a range whose ends are exact as doubles.
pub(crate) fn check_whole(
    field: &str,
    value: f64,
    allowed: &RangeInclusive<u64>,
) -> Result<u64, SettingsError> {
    let whole = value as u64;
    if whole as f64 == value && allowed.contains(&whole) {
        return Ok(whole);
    }
    Err(SettingsError { field: field.to_owned(), value, allowed: Allowed::Whole(allowed.clone()) })
}

/// Positions (m), angles (rad) and speeds (m/s, rad/s) up to a million: far beyond any robot, and the square of the
/// largest still leaves every later product a finite double.
pub const QUANTITY: RangeInclusive<f64> = -1e6..=1e6;
/// Variance coefficients up to a million, for the same reason.
pub const ALPHA: RangeInclusive<f64> = 0.0..=1e6;
/// From a microsecond to a million seconds. Shorter steps would make v̂ = length/Δt lose the digits that tell samples
/// apart.
pub const DURATION: RangeInclusive<f64> = 1e-6..=1e6;
/// The largest whole number up to which JavaScript's numbers are exact.
pub const MAX_SEED: u64 = (1 << 53) - 1;

/// Description of a setting beside its type and its range.
#[derive(Clone, Copy, Debug)]
pub struct Declaration {
    pub key: &'static str,
    /// The setting that this one is another way to say.
    pub of: Option<&'static str>,
    // The module for browsers omits the sentence and the unit of settings: no page shows them, and they would make the module larger.
    #[cfg(not(target_arch = "wasm32"))]
    pub sentence: &'static str,
    /// Unit; "" for a number without one.
    #[cfg(not(target_arch = "wasm32"))]
    pub unit: &'static str,
}

/// A setting where it is stored, with what it allows.
pub enum Setting<'a> {
    Number(&'a mut f64, RangeInclusive<f64>),
    Whole(&'a mut dyn Whole, RangeInclusive<u64>),
    WholeOrNone(&'a mut Option<usize>, RangeInclusive<u64>),
    Truth(&'a mut bool),
    Word(&'a mut dyn Word),
    /// A list of fixed length, all of its numbers of one range.
    Numbers(&'a mut [f64], RangeInclusive<f64>),
    Level(&'a mut dyn Level, RangeInclusive<f64>),
    Group(&'a mut dyn Group),
}

impl Setting<'_> {
    /// # Errors
    /// [`SettingsError`] for the first number out of its range.
    fn check(self, key: &str) -> Result<(), SettingsError> {
        match self {
            Self::Number(number, allowed) => check_real(key, *number, &allowed),
            Self::Whole(whole, allowed) => check_whole(key, whole.get() as f64, &allowed).map(|_| ()),
            Self::WholeOrNone(Some(whole), allowed) => check_whole(key, *whole as f64, &allowed).map(|_| ()),
            Self::Numbers(numbers, allowed) => {
                match numbers.iter().position(|number| !allowed.contains(number)) {
                    Some(i) => check_real(&format!("{key}[{i}]"), numbers[i], &allowed),
                    None => Ok(()),
                }
            }
            Self::Group(group) => check_group(key, group),
            // A level is checked as what it stands for.
            Self::WholeOrNone(None, _) | Self::Truth(_) | Self::Word(_) | Self::Level(..) => Ok(()),
        }
    }
}

pub(crate) fn check_group(key: &str, group: &mut dyn Group) -> Result<(), SettingsError> {
    for (i, Field { declaration, allowed }) in group.fields().iter().enumerate() {
        let number = *group.number(i);
        if !allowed.contains(&number) {
            return check_real(&format!("{key}.{}", declaration.key), number, allowed);
        }
    }
    Ok(())
}

/// A whole number of any type.
pub trait Whole {
    fn get(&self) -> u64;
    fn set(&mut self, whole: u64);
}

/// A number that stands for several others, as a slider for all of them does.
pub trait Level {
    /// Returns the level; None where the others are not those of any.
    fn get(&self) -> Option<f64>;
    fn set(&mut self, level: f64);
    /// Returns the shares of the level that the numbers have, the last of the whole list.
    fn weights(&self) -> Vec<f64>;
}

/// An enum whose values have words: in settings, attributes and states.
pub trait Words: Copy + 'static {
    const WORDS: &'static [(&'static str, Self)];
}

/// [`Words`] of any type.
pub trait Word {
    fn get(&self) -> &'static str;
    /// Takes on the value of a word; false where it is none of [`Word::all`].
    fn set(&mut self, word: &str) -> bool;
    fn all(&self) -> Vec<&'static str>;
}

impl<T: Words> Word for T {
    fn get(&self) -> &'static str {
        let kind = std::mem::discriminant(self);
        T::WORDS.iter().find(|(_, value)| std::mem::discriminant(value) == kind).map_or("", |(word, _)| word)
    }

    fn set(&mut self, word: &str) -> bool {
        let found = T::WORDS.iter().find(|(candidate, _)| *candidate == word);
        found.inspect(|(_, value)| *self = *value).is_some()
    }

    fn all(&self) -> Vec<&'static str> {
        T::WORDS.iter().map(|(word, _)| *word).collect()
    }
}

/// Numbers that only make sense together.
pub trait Group {
    fn fields(&self) -> &'static [Field];
    /// Returns the number of a field by its place among them, from 0; panics past the last.
    fn number(&mut self, index: usize) -> &mut f64;
}

/// A number of a [`Group`].
pub struct Field {
    pub declaration: Declaration,
    pub allowed: RangeInclusive<f64>,
}

/// Types that a setting may have.
pub trait Settable {
    /// Declarations of the values that are allowed.
    type Allowed;
    fn setting(&mut self, allowed: Self::Allowed) -> Setting<'_>;
}

impl Settable for f64 {
    type Allowed = RangeInclusive<f64>;
    fn setting(&mut self, allowed: Self::Allowed) -> Setting<'_> {
        Setting::Number(self, allowed)
    }
}

impl Settable for [f64] {
    type Allowed = RangeInclusive<f64>;
    fn setting(&mut self, allowed: Self::Allowed) -> Setting<'_> {
        Setting::Numbers(self, allowed)
    }
}

impl Settable for Option<usize> {
    type Allowed = RangeInclusive<u64>;
    fn setting(&mut self, allowed: Self::Allowed) -> Setting<'_> {
        Setting::WholeOrNone(self, allowed)
    }
}

impl Settable for bool {
    type Allowed = ();
    fn setting(&mut self, (): ()) -> Setting<'_> {
        Setting::Truth(self)
    }
}

impl<T: Words> Settable for T {
    type Allowed = ();
    fn setting(&mut self, (): ()) -> Setting<'_> {
        Setting::Word(self)
    }
}

macro_rules! whole {
    ($($type:ty),+) => {$(
        impl Whole for $type {
            fn get(&self) -> u64 {
                *self as u64
            }
            fn set(&mut self, whole: u64) {
                *self = whole as $type;
            }
        }
        impl Settable for $type {
            type Allowed = RangeInclusive<u64>;
            fn setting(&mut self, allowed: Self::Allowed) -> Setting<'_> {
                Setting::Whole(self, allowed)
            }
        }
    )+};
}
whole!(u32, u64, usize);

/// Visitor of one setting after the other, which may stop.
pub type See<'a> = dyn FnMut(&'static Declaration, Setting) -> ControlFlow<()> + 'a;

/// Trait that `settings!` implements: the settings of a widget one by one.
pub trait Declared: Copy + Default {
    const KEYS: &'static [&'static str];

    /// Shows each setting to `see`, in the order of declaration.
    fn each(&mut self, see: &mut See) -> ControlFlow<()>;

    /// Shows each setting to `see`, in the order of declaration, until one is refused.
    ///
    /// # Errors
    /// The refusal of `see`.
    fn try_each<E>(
        &mut self,
        mut see: impl FnMut(&'static Declaration, Setting) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut refusal = None;
        let _ = self.each(&mut |declaration, setting| match see(declaration, setting) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                refusal = Some(error);
                ControlFlow::Break(())
            }
        });
        refusal.map_or(Ok(()), Err)
    }
}

/// Rules across the settings of a widget.
pub trait Rules: Declared {
    /// Adjusts other settings after the `named` ones were set one by one.
    fn settle(&mut self, _before: &Self, _named: &[&str]) {}

    /// Called when each setting is known to be in its range.
    ///
    /// # Errors
    /// [`SettingsError`] where they do not fit together.
    fn check_together(&self) -> Result<(), SettingsError> {
        Ok(())
    }

    /// # Errors
    /// [`SettingsError`] for the first setting out of range.
    fn check(&self) -> Result<(), SettingsError> {
        let mut settings = *self;
        settings.try_each(|declaration, setting| setting.check(declaration.key))?;
        self.check_together()
    }
}

/// Declares the settings of a widget, each by a sentence, its name, type and default; a number by its unit, if it has one,
/// and its range besides:
///
/// ```text
/// /// Radius of the robot.
/// clearance: f64 = 0.13, "m", in 0.0..=10.0;
/// ```
///
/// The end of a range may depend on other settings: `up to` names a method for it. A setting that is not a field of its
/// own says `by` which method it is reached, and `of` which setting it is another way to say. What is `kept` besides is
/// part of the struct and not a setting by itself.
macro_rules! settings {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $(
                #[doc = $sentence:literal]
                $key:ident
                $(: $type:ty = $default:expr $(, $unit:literal)?)?
                $(, by $accessor:ident $(of $original:ident)? $(, $its_unit:literal)?)?
                $(, in $range:expr $(, up to $most:ident)?)?
                ;
            )+
            $(kept { $($(#[$kept_meta:meta])* $kept:ident: $kept_type:ty = $kept_default:expr;)+ })?
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $($(#[doc = $sentence] $(#[doc = concat!(" In ", $unit, ".")])? pub $key: $type,)?)+
            $($($(#[$kept_meta])* pub $kept: $kept_type,)+)?
        }

        impl Default for $name {
            /// The widget's opening state.
            fn default() -> Self {
                Self { $($($key: $default,)?)+ $($($kept: $kept_default,)+)? }
            }
        }

        impl $crate::sim::settings::Declared for $name {
            const KEYS: &'static [&'static str] = &[$(stringify!($key)),+];

            fn each(&mut self, see: &mut $crate::sim::settings::See) -> std::ops::ControlFlow<()> {
                use $crate::sim::settings::{Settable, declaration};
                $(see(
                    const { &declaration!($key, $sentence, [$($($unit)?)? $($($its_unit)?)?] $($(, of $original)?)?) },
                    settings!(@place self $key $($accessor)?)
                        .setting(settings!(@allowed self $($range $(, $most)?)?)),
                )?;)+
                std::ops::ControlFlow::Continue(())
            }
        }
    };
    (@allowed $this:ident) => { () };
    (@allowed $this:ident $range:expr) => { $range };
    (@allowed $this:ident $range:expr, $most:ident) => { *($range).start()..=$this.$most() };
    (@place $this:ident $key:ident) => { $this.$key };
    (@place $this:ident $key:ident $accessor:ident) => { $this.$accessor() };
}
pub(crate) use settings;

/// The [`Declaration`] of a setting or of a number of a group.
macro_rules! declaration {
    ($key:ident, $sentence:literal, [$($unit:literal)?] $(, of $original:ident)?) => {
        $crate::sim::settings::Declaration {
            key: stringify!($key),
            of: $crate::sim::settings::declaration!(@of $($original)?),
            #[cfg(not(target_arch = "wasm32"))]
            sentence: $sentence.trim_ascii(),
            #[cfg(not(target_arch = "wasm32"))]
            unit: concat!($($unit)?),
        }
    };
    (@of) => { None };
    (@of $original:ident) => { Some(stringify!($original)) };
}
pub(crate) use declaration;

/// Declares the numbers of a group: `sentence, key: "unit", in range;`, each key being bound by the pattern.
macro_rules! group {
    ($type:ty as $pattern:pat => { $(#[doc = $sentence:literal] $key:ident: $unit:literal, in $range:expr;)+ }) => {
        impl $crate::sim::settings::Group for $type {
            fn fields(&self) -> &'static [$crate::sim::settings::Field] {
                static FIELDS: &[$crate::sim::settings::Field] = &[$($crate::sim::settings::Field {
                    declaration: $crate::sim::settings::declaration!($key, $sentence, [$unit]),
                    allowed: $range,
                }),+];
                FIELDS
            }

            fn number(&mut self, index: usize) -> &mut f64 {
                let $pattern = self;
                [$($key),+].into_iter().nth(index).expect("a number of the group")
            }
        }

        impl $crate::sim::settings::Settable for $type {
            type Allowed = ();
            fn setting(&mut self, (): ()) -> $crate::sim::settings::Setting<'_> {
                $crate::sim::settings::Setting::Group(self)
            }
        }
    };
}
pub(crate) use group;
