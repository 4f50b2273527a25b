//! Error for a setting that is not allowed, and checks of numbers.

use crate::numbers::format_number;
use std::ops::RangeInclusive;
use thiserror::Error;

/// Error for a setting whose value is not allowed. The message has the field, the value and the allowed values.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{}", self.format_message())]
pub struct SettingsError {
    /// Name of the setting, as in attributes and states.
    pub key: String,
    /// The number that is not allowed; NaN for a keyword.
    pub value: f64,
    /// The values that are allowed.
    pub allowed: AllowedValues,
}

/// Allowed values of a setting.
#[derive(Clone, Debug, PartialEq)]
pub enum AllowedValues {
    /// Numbers in a range.
    Real(RangeInclusive<f64>),
    /// Integers in a range.
    Integer(RangeInclusive<u64>),
    /// Numbers of samples for which there is enough memory.
    FitsInMemory,
    /// Keywords that are allowed instead of `given_keyword`.
    Keyword {
        /// The keyword that is not allowed.
        given_keyword: &'static str,
        /// Keywords that are allowed, as text.
        allowed: &'static str,
    },
}

impl SettingsError {
    /// Returns the error for a number of samples that need more memory than there is.
    pub(crate) fn out_of_memory(sample_count: usize) -> Self {
        Self { key: "samples".to_owned(), value: sample_count as f64, allowed: AllowedValues::FitsInMemory }
    }

    fn format_message(&self) -> String {
        let allowed_text = match &self.allowed {
            AllowedValues::Keyword { given_keyword, allowed } => {
                return format!("{} is {given_keyword}; allowed is {allowed}", self.key);
            }
            AllowedValues::Real(range) => {
                format!("a number from {} to {}", format_number(*range.start()), format_number(*range.end()))
            }
            AllowedValues::Integer(range) => {
                format!("a whole number from {} to {}", range.start(), range.end())
            }
            AllowedValues::FitsInMemory => "a number for which there is memory".to_owned(),
        };
        format!("{} is {}; allowed is {allowed_text}", self.key, format_number(self.value))
    }
}

pub(crate) fn check_real(
    field_path: &str,
    value: f64,
    allowed: &RangeInclusive<f64>,
) -> Result<(), SettingsError> {
    if allowed.contains(&value) {
        return Ok(());
    }
    Err(SettingsError { key: field_path.to_owned(), value, allowed: AllowedValues::Real(allowed.clone()) })
}

/// Converts a double to an integer in the `allowed` range. The ends of the range must be exact as doubles.
pub(crate) fn check_integer(
    field_path: &str,
    value: f64,
    allowed: &RangeInclusive<u64>,
) -> Result<u64, SettingsError> {
    let whole_number = value as u64;
    if whole_number as f64 == value && allowed.contains(&whole_number) {
        return Ok(whole_number);
    }
    Err(SettingsError { key: field_path.to_owned(), value, allowed: AllowedValues::Integer(allowed.clone()) })
}
