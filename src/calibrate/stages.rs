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
    /// For how far the errors that are removed may be off by the legs of the length at this place among [`FACTORS`]: what is not known of
    /// them a leg that hardly leads anywhere shows most, and it would decide on the α's.
    Scatter(usize),
    /// For the α's of that length.
    Length(usize),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stage {
    Align,
    Cut(Purpose),
    Observe(Purpose),
    Fit(Purpose),
    Refine(Purpose),
    /// Of the α at this place.
    Interval(Purpose, usize),
    /// The bootstrap of legs of the length at this place.
    Stretch(usize),
    Judge,
}

impl Stage {
    /// How many parts are done that progress tells apart, of a model with so many α's.
    pub fn done(self, alphas: usize) -> usize {
        let before = |purpose: Purpose| match purpose {
            Purpose::Round(round) => 1 + round,
            Purpose::Alphas => ROUNDS + 1,
            Purpose::Scatter(place) => ROUNDS + 3 + alphas + place * (5 + alphas),
            Purpose::Length(place) => ROUNDS + 5 + alphas + place * (5 + alphas),
        };
        match self {
            Self::Align => 0,
            Self::Cut(purpose) | Self::Observe(purpose) => before(purpose),
            Self::Fit(purpose @ (Purpose::Scatter(_) | Purpose::Length(_))) => before(purpose) + 1,
            Self::Refine(purpose @ Purpose::Scatter(_)) => before(purpose) + 1,
            Self::Fit(purpose) | Self::Refine(purpose) => before(purpose),
            Self::Interval(purpose @ Purpose::Length(_), alpha) => before(purpose) + 2 + alpha,
            Self::Interval(purpose, alpha) => before(purpose) + 1 + alpha,
            Self::Stretch(place) => before(Purpose::Length(place)) + 2 + alphas,
            Self::Judge => before(Purpose::Alphas) + 1 + alphas,
        }
    }
}

/// How many parts there are in all.
pub(super) fn parts(alphas: usize, by_length: bool) -> usize {
    let asked = ROUNDS + 3 + alphas;
    if by_length { asked + FACTORS.len() * (5 + alphas) + 1 } else { asked }
}
