//! What there is to say of a fit besides its intervals, one step after the other.

use super::bootstrap::Bootstrap;
use super::calibration::Options;
use super::doubts::{Doubts, Halves, Inflation, Judged, Verdict, doubts};
use super::legs::Leg;
use super::mismatch::mismatch;
use super::model::Observation;
use super::overstated::{is_below_it, is_too_much_of_all};
use super::profile::Fitted;
use super::systematic::Systematic;

/// The bootstrap; a fit to the first half of the log; the doubts; inflation.
#[derive(Clone, Debug, Default)]
pub(super) struct Judging {
    drawing: Option<Bootstrap>,
    /// By how much longer the bootstrap has each α's interval, once it is known.
    pub longer: Option<Vec<f64>>,
    halves: Option<Halves>,
    halved: bool,
    /// Of each leg.
    pub judged: Option<Vec<Judged>>,
    pub doubts: Option<Doubts>,
    /// Whether the log was asked if it is what it is taken for.
    asked: bool,
    pub inflation: Inflation,
}

/// What the fit is of.
#[derive(Clone, Copy)]
pub(super) struct Judge<'a> {
    pub options: &'a Options,
    pub legs: &'a [Leg],
    pub observations: &'a [Observation],
    pub removed: &'a Systematic,
}

/// Sorting a number or two of each leg, and what a doubt costs besides, in legs.
const SORTED: usize = 4;

impl Judging {
    /// Goes on by a few passes; whether all is said.
    pub fn step(&mut self, fitted: &Fitted, of: Judge) -> bool {
        let Judge {
            options: &Options { model, noise, robust, seed, legs: length, reference_error, .. },
            legs,
            ..
        } = of;
        let (observations, work) = (of.observations, &fitted.evidence.work);
        if self.longer.is_none() {
            let drawing = self.drawing.get_or_insert_with(|| Bootstrap::new(fitted, model.alphas(), seed));
            self.longer = drawing.step(fitted);
            return false;
        }
        let Some(halves) = &mut self.halves else {
            self.halves = Some(Halves::new(model, robust, fitted.evidence, observations, &fitted.best));
            return false;
        };
        if !self.halved {
            self.halved = halves.fit();
            return false;
        }
        let Some(judged) = &self.judged else {
            self.judged = Some(Judged::all(fitted.evidence, &fitted.best, observations));
            return false;
        };
        let Some(doubted) = &mut self.doubts else {
            work.add(SORTED * legs.len());
            let neighbours: Vec<bool> =
                (0..legs.len()).map(|i| i > 0 && legs[i - 1].times[1] == legs[i].times[0]).collect();
            self.doubts = Some(doubts(model, noise, observations, judged, &neighbours, halves));
            return false;
        };
        if !self.asked {
            self.asked = true;
            if doubted.verdict != Verdict::FewLegs {
                work.add(SORTED * legs.len());
                let is_overstated = || {
                    let is_overstated = reference_error.is_stated()
                        && (is_below_it(observations, judged)
                            // Tails and what is systematic leave it undecided.
                            || (![Verdict::HeavyTails, Verdict::Correlated].contains(&doubted.verdict)
                                && is_too_much_of_all(model, observations, judged, &fitted.best.alphas)));
                    is_overstated.then_some(Verdict::Overstated)
                };
                let found = mismatch(legs, observations, of.removed, length).or_else(is_overstated);
                doubted.verdict = found.unwrap_or(doubted.verdict);
            }
            return false;
        }
        halves.inflate(&mut self.inflation)
    }
}
