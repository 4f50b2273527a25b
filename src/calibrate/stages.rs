//! Which stage a calibration is at, and how many are behind it.

use super::leg_lengths::FACTORS;

/// Rounds at most: systematic errors of the usual sizes stay after three or four.
pub(super) const ROUNDS: usize = 12;

/// What legs are cut for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Purpose {
    /// For the systematic errors, without those that are known by then.
    Round(usize),
    /// For the α's, without the errors that are to be removed.
    Alphas,
    /// For the α's of the length at this place among [`FACTORS`].
    Length(usize),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stage {
    Align,
    Cut(Purpose),
    Observe(Purpose),
    Fit(Purpose),
    Refine(usize),
    /// Of the α at this place.
    Interval(Purpose, usize),
    Judge,
}

impl Stage {
    /// How many parts are done that progress tells apart, of a model with so many α's.
    pub fn done(self, alphas: usize) -> usize {
        let before = |purpose: Purpose| match purpose {
            Purpose::Round(round) => 1 + round,
            Purpose::Alphas => ROUNDS + 1,
            Purpose::Length(place) => ROUNDS + 3 + alphas + place * (2 + alphas),
        };
        match self {
            Self::Align => 0,
            Self::Cut(purpose) | Self::Observe(purpose) => before(purpose),
            Self::Fit(purpose @ Purpose::Length(_)) => before(purpose) + 1,
            Self::Fit(purpose) => before(purpose),
            Self::Refine(round) => before(Purpose::Round(round)),
            Self::Interval(purpose @ Purpose::Length(_), alpha) => before(purpose) + 2 + alpha,
            Self::Interval(purpose, alpha) => before(purpose) + 1 + alpha,
            Self::Judge => before(Purpose::Alphas) + 1 + alphas,
        }
    }
}

/// How many parts there are in all.
pub(super) fn parts(alphas: usize, by_length: bool) -> usize {
    let asked = ROUNDS + 3 + alphas;
    if by_length { asked + FACTORS.len() * (2 + alphas) + 1 } else { asked }
}
