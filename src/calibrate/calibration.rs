//! What is asked of a log, and what it says.

use super::bad::Robust;
use super::density::NORMAL_95;
use super::doubts::{Doubts, Inflation, Judged};
use super::leg_lengths::AtLength;
use super::legs::{FEWEST, Leg, LegLength};
use super::model::{Model, Observation};
use super::profile::Estimate;
use super::systematic::{ERRORS, Error, Systematic, Which};
use super::undetermined::Undetermined;
use crate::noise::NoiseKind;
use std::fmt;

/// The standard deviations of the reference's own error at one moment: of each coordinate (m), and of its heading (rad).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReferenceError {
    pub position: f64,
    pub heading: f64,
}

impl ReferenceError {
    /// Whether it is any at all.
    pub(super) fn is_stated(&self) -> bool {
        *self != Self::default()
    }
}

/// What is asked of a log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    pub model: Model,
    pub legs: LegLength,
    pub noise: NoiseKind,
    pub robust: Robust,
    /// Which systematic errors are removed before the α's are fitted; all are estimated.
    pub remove: Which,
    pub reference_error: ReferenceError,
    /// Of the bootstrap.
    pub seed: u64,
    /// Whether legs of other lengths are fitted too: a quarter as long they are four times as many, and with all of them it takes up to
    /// three times as long.
    pub by_length: bool,
}

/// What a log says.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    pub estimate: Estimate,
    /// Of each α why the log does not determine it; None where it does.
    pub undetermined: Vec<Option<Undetermined>>,
    /// 95 % intervals that do not take legs for independent, never shorter than the estimate's: stretched by a block bootstrap.
    pub bootstrap: Vec<Option<[f64; 2]>>,
    /// The systematic errors, all estimated together.
    pub systematic: Systematic,
    /// The standard deviations of [`Error::ALL`]; None of one that the log does not determine.
    pub deviations: [Option<f64>; ERRORS],
    /// What was removed: of what was to be removed, what the log determines.
    pub removed: Systematic,
    pub legs: Vec<Leg>,
    /// Of each leg.
    pub observations: Vec<Observation>,
    /// Of each leg.
    pub judged: Vec<Judged>,
    pub doubts: Doubts,
    pub inflation: Inflation,
    /// The α's of legs of other lengths, one for each of [`super::FACTORS`]; empty unless asked for.
    pub by_length: Vec<AtLength>,
}

impl Calibration {
    /// The 95 % interval of a systematic error; None where the log does not determine it.
    pub fn interval_of(&self, error: Error) -> Option<[f64; 2]> {
        let (value, deviation) = (self.systematic.get(error), self.deviations[error as usize]?);
        Some([value - NORMAL_95 * deviation, value + NORMAL_95 * deviation])
    }
}

/// Why a log says nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CalibrateError {
    /// They have no time in common, and turn alike at no offset of their clocks.
    Apart,
    /// There are fewer legs than [`FEWEST`].
    FewLegs { legs: usize },
}

impl fmt::Display for CalibrateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Apart => f.write_str(
                "odometry and reference have no time in common, and turn alike at no offset of their clocks; allowed are two logs of one drive",
            ),
            Self::FewLegs { legs } => write!(
                f,
                "the log has {legs} legs for which both trajectories are known; allowed are {FEWEST} at least: shorter legs, a longer drive, or clocks that agree"
            ),
        }
    }
}

impl std::error::Error for CalibrateError {}
