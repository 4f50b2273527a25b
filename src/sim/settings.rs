//! What a user may ask for: the limits of every parameter, checked once.

use crate::models::VelocityCmd;
use crate::printed::printed;
use std::fmt;
use std::ops::RangeInclusive;

/// A parameter outside its range. The message names the field, the value and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SettingsError {
    pub field: String,
    pub value: String,
    pub allowed: String,
}

impl SettingsError {
    /// A sample count for which memory does not suffice.
    pub(crate) fn no_memory(samples: usize) -> Self {
        Self {
            field: "samples".to_owned(),
            value: samples.to_string(),
            allowed: "a number for which there is memory".to_owned(),
        }
    }
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {}; allowed is {}", self.field, self.value, self.allowed)
    }
}

impl std::error::Error for SettingsError {}

/// Speeds up to a million metres or radians a second and α's up to a million: far beyond any robot, and the square of
/// the largest noise still leaves every later product a finite double.
pub const SPEED: RangeInclusive<f64> = -1e6..=1e6;
pub const ALPHA: RangeInclusive<f64> = 0.0..=1e6;
/// From a microsecond to a million seconds. Shorter steps would make v̂ = length/Δt lose the digits that tell samples
/// apart.
pub const DURATION: RangeInclusive<f64> = 1e-6..=1e6;
/// Ten million poses take 400 MB; a browser's page may have 4 GB.
pub const MAX_SAMPLES: usize = 10_000_000;
/// The largest whole number up to which JavaScript's numbers are exact.
pub const MAX_SEED: u64 = (1 << 53) - 1;

pub(crate) fn check_real(
    field: &str,
    value: f64,
    allowed: &RangeInclusive<f64>,
) -> Result<(), SettingsError> {
    if allowed.contains(&value) {
        return Ok(());
    }
    Err(SettingsError {
        field: field.to_owned(),
        value: printed(value),
        allowed: format!("a number from {} to {}", printed(*allowed.start()), printed(*allowed.end())),
    })
}

/// A whole number from `least` to `most`, both exact as doubles.
pub(crate) fn check_whole(field: &str, value: f64, least: u64, most: u64) -> Result<u64, SettingsError> {
    let whole = value as u64;
    if whole as f64 == value && (least..=most).contains(&whole) {
        return Ok(whole);
    }
    Err(SettingsError {
        field: field.to_owned(),
        value: printed(value),
        allowed: format!("a whole number from {least} to {most}"),
    })
}

pub(crate) fn check_command(command: &VelocityCmd) -> Result<(), SettingsError> {
    check_real("command.v", command.v, &SPEED)?;
    check_real("command.omega", command.omega, &SPEED)?;
    check_real("command.dt", command.dt, &DURATION)
}

pub(crate) fn check_alphas(alphas: &[f64]) -> Result<(), SettingsError> {
    match alphas.iter().position(|alpha| !ALPHA.contains(alpha)) {
        Some(i) => check_real(&format!("alphas[{i}]"), alphas[i], &ALPHA),
        None => Ok(()),
    }
}
