//! From a log to parameters, one step after the other.

use super::bootstrap;
use super::calibration::{CalibrateError, Calibration, FEWEST, Options};
use super::clock::Alignment;
use super::doubts::{Halves, Judged, Verdict, doubts};
use super::leg_lengths::{ASKED, AtLength, FACTORS, MOST, have_rows};
use super::legs::{Leg, cut};
use super::likelihood::{Evidence, Parameters, Robust, Slope};
use super::mismatch::mismatch;
use super::model::{Observation, Uncertainty};
use super::profile::{Estimate, Fitted, Search};
use super::systematic::{ERRORS, Error, LeastSquares, Step, Systematic, Which};
use super::trajectory::Trajectory;
use super::undetermined::{Undetermined, undetermined};
use nalgebra::Matrix2;

/// A calibration under way: the same in pieces, so that nobody has to wait for all of it.
///
/// 1. Clocks are aligned by the robot's turns.
/// 2. Legs are cut, α's fitted to them, and systematic errors found by least squares with the weights that these α's give; again with
///    those errors removed, until they stay.
/// 3. The α's are fitted with the errors removed that are to be.
/// 4. Each α's interval, one a step; a fit to the first half of the log; the bootstrap; the doubts; inflation.
/// 5. If asked for, legs of each other length, and the intervals of their α's, one a step.
///
/// Each fit is a climb, of whose steps one is a step.
#[derive(Clone, Debug)]
pub struct Calibrating {
    options: Options,
    stage: Stage,
    alignment: Alignment,
    /// The systematic errors as long as no leg has told any: none but the offset of the clocks.
    begun: Systematic,
    systematic: Systematic,
    deviations: [Option<f64>; ERRORS],
    /// Of the last round.
    known: [[f64; ERRORS]; ERRORS],
    removed: Systematic,
    legs: Vec<Leg>,
    observations: Vec<Observation>,
    evidence: Evidence,
    best: Option<(Parameters, Slope)>,
    /// For the next best, while it is under way.
    search: Option<Search>,
    intervals: Vec<Option<[f64; 2]>>,
    halves: Option<Halves>,
    /// Of the legs that were asked for, while those of other lengths are fitted.
    asked: Option<Calibration>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    Align,
    /// Cuts legs, without the errors that are known by then.
    Round(usize),
    RoundFit(usize),
    /// Cuts legs, without the errors that are to be removed.
    Remove,
    Fit,
    Interval(usize),
    Judge,
    /// Cuts legs of this place among [`FACTORS`].
    Length(usize),
    LengthFit(usize),
    /// Of the α's of this place.
    LengthInterval(usize, usize),
}

/// Rounds at most: systematic errors of the usual sizes stay after three or four.
const ROUNDS: usize = 12;

/// A change that is so small a part of its deviation is none.
const STAYS: f64 = 0.01;

impl Calibrating {
    pub fn new(options: Options) -> Self {
        Self {
            options,
            stage: Stage::Align,
            alignment: Alignment::default(),
            begun: Systematic::NONE,
            systematic: Systematic::NONE,
            deviations: [None; ERRORS],
            known: [[0.0; ERRORS]; ERRORS],
            removed: Systematic::NONE,
            legs: Vec::new(),
            observations: Vec::new(),
            evidence: Evidence::new(options.model, options.noise, []),
            best: None,
            search: None,
            intervals: Vec::new(),
            halves: None,
            asked: None,
        }
    }

    /// How much is done, 0 to 1.
    pub fn progress(&self) -> f64 {
        let alphas = self.options.model.alphas();
        let asked = ROUNDS + 3 + alphas;
        let steps = asked + if self.options.by_length { FACTORS.len() * (2 + alphas) + 1 } else { 0 };
        let done = match self.stage {
            Stage::Align => return self.alignment.progress() / steps as f64,
            Stage::Round(round) | Stage::RoundFit(round) => 1 + round,
            Stage::Remove | Stage::Fit => ROUNDS + 1,
            Stage::Interval(alpha) => ROUNDS + 2 + alpha,
            Stage::Judge => asked - 1,
            Stage::Length(place) => asked + place * (2 + alphas),
            Stage::LengthFit(place) => asked + place * (2 + alphas) + 1,
            Stage::LengthInterval(place, alpha) => asked + place * (2 + alphas) + 2 + alpha,
        };
        // Nobody knows how many steps a climb takes.
        let climbed = |search: Option<&Search>| {
            let steps = search.map_or(0, Search::steps) as f64;
            (1.0 + steps) / (10.0 + steps)
        };
        let part = match self.stage {
            Stage::RoundFit(_) | Stage::Fit | Stage::LengthFit(_) => climbed(self.search.as_ref()),
            Stage::Judge => climbed(self.halves.as_ref().map(Halves::search)),
            _ => 0.0,
        };
        (done as f64 + part) / steps as f64
    }

    /// Goes on by one step; the calibration after the last one.
    ///
    /// # Errors
    /// [`CalibrateError`] where there are too few legs, or the two are not of one drive.
    pub fn step(
        &mut self,
        odometry: &Trajectory,
        reference: &Trajectory,
    ) -> Result<Option<Calibration>, CalibrateError> {
        self.stage = match self.stage {
            Stage::Align => {
                let Some(offset) = self.alignment.step(odometry, reference) else { return Ok(None) };
                self.begun.clock_offset = offset.ok_or(CalibrateError::Apart)?;
                self.systematic = self.begun;
                Stage::Round(0)
            }
            Stage::Round(round) => {
                self.observe(odometry, reference, self.systematic, [true; ERRORS])?;
                Stage::RoundFit(round)
            }
            Stage::RoundFit(round) => {
                // Bad legs are set aside here even if the α's are to answer for them.
                let robust = self.options.robust;
                if !self.search(if robust == Robust::No { Robust::Estimated } else { robust }) {
                    return Ok(None);
                }
                let stays = self.refine();
                if stays || round + 1 == ROUNDS { Stage::Remove } else { Stage::Round(round + 1) }
            }
            Stage::Remove => {
                self.removed = Systematic::NONE;
                for (i, error) in Error::ALL.into_iter().enumerate() {
                    if self.options.remove[i] {
                        self.removed.set(error, self.systematic.get(error));
                    }
                }
                self.observe(odometry, reference, self.removed, self.options.remove)?;
                Stage::Fit
            }
            Stage::Fit => {
                if !self.search(self.options.robust) {
                    return Ok(None);
                }
                Stage::Interval(0)
            }
            Stage::Interval(alpha) => {
                let interval = self.fitted().interval(alpha);
                self.intervals.push(interval);
                if alpha + 1 < self.options.model.alphas() {
                    Stage::Interval(alpha + 1)
                } else {
                    Stage::Judge
                }
            }
            Stage::Judge => {
                let Options { model, noise, robust, .. } = self.options;
                let mut halves = self.halves.take().unwrap_or_else(|| {
                    Halves::new(model, noise, robust, &self.observations, &self.fitted().best)
                });
                if !halves.fit() {
                    self.halves = Some(halves);
                    return Ok(None);
                }
                let calibration = self.judge(&halves);
                if !self.options.by_length {
                    return Ok(Some(calibration));
                }
                self.asked = Some(calibration);
                Stage::Length(0)
            }
            Stage::Length(place) => {
                let Some(factor) = FACTORS.get(place).copied() else { return Ok(self.asked.take()) };
                if self.cut_again(odometry, reference, factor) {
                    Stage::LengthFit(place)
                } else {
                    Stage::Length(place + 1)
                }
            }
            Stage::LengthFit(place) => {
                if !self.search(self.options.robust) {
                    return Ok(None);
                }
                Stage::LengthInterval(place, 0)
            }
            Stage::LengthInterval(place, alpha) => {
                let interval = self.fitted().interval(alpha);
                self.intervals.push(interval);
                if alpha + 1 < self.options.model.alphas() {
                    Stage::LengthInterval(place, alpha + 1)
                } else {
                    let (estimate, _) = self.estimate(&self.fitted());
                    self.tell(FACTORS[place], Some(estimate));
                    Stage::Length(place + 1)
                }
            }
        };
        Ok(None)
    }

    /// Legs, and what they say without some systematic errors.
    fn observe(
        &mut self,
        odometry: &Trajectory,
        reference: &Trajectory,
        without: Systematic,
        estimated: Which,
    ) -> Result<(), CalibrateError> {
        self.legs = cut(odometry, reference, self.options.legs, without.clock_offset);
        if self.legs.len() < FEWEST {
            return Err(CalibrateError::FewLegs { legs: self.legs.len() });
        }
        self.observe_legs(without, estimated);
        Ok(())
    }

    /// What the legs say without some systematic errors.
    fn observe_legs(&mut self, without: Systematic, estimated: Which) {
        let Options { model, noise, reference_error, .. } = self.options;
        let deviations = std::array::from_fn(|i| self.deviations[i].filter(|_| estimated[i]));
        let observe = |leg: &Leg| {
            let own = Matrix2::identity() * (2.0 * reference_error.position * reference_error.position);
            let heading = reference_error.heading * reference_error.heading;
            let bearing = own + without.uncertainty(leg, &deviations);
            model.observe(leg, &without, &Uncertainty { place: own, bearing, heading })
        };
        self.observations = self.legs.iter().map(observe).collect();
        self.evidence = Evidence::new(model, noise, &self.observations);
    }

    /// Legs of another length, without what was removed of those that were asked for; whether α's are to be fitted to them.
    fn cut_again(&mut self, odometry: &Trajectory, reference: &Trajectory, factor: f64) -> bool {
        if let Some(asked) = self.asked.as_mut().filter(|_| factor == ASKED) {
            let estimate = Some(asked.estimate.clone());
            asked.by_length.push(AtLength { factor, legs: asked.legs.len(), estimate });
            return false;
        }
        let length = self.options.legs.times(factor);
        let cut = |length| cut(odometry, reference, length, self.removed.clock_offset);
        self.legs = length.map_or_else(Vec::new, cut);
        let (all, kept) = (self.legs.len(), self.legs.len().min(MOST));
        (0..kept).for_each(|place| self.legs[place] = self.legs[place * all / kept]);
        self.legs.truncate(kept);
        let enough = self.legs.len() >= FEWEST && have_rows(&self.legs, odometry, reference);
        if enough {
            self.observe_legs(self.removed, self.options.remove);
            self.best = None;
            self.intervals.clear();
        } else {
            self.tell(factor, None);
        }
        enough
    }

    /// What the legs of another length say.
    fn tell(&mut self, factor: f64, estimate: Option<Estimate>) {
        let legs = self.legs.len();
        if let Some(asked) = &mut self.asked {
            asked.by_length.push(AtLength { factor, legs, estimate });
        }
    }

    /// Goes on with the search for the likeliest α's; whether they are found.
    fn search(&mut self, robust: Robust) -> bool {
        let mut search = self.search.take().unwrap_or_else(|| {
            let near = self.best.map(|(near, _)| near);
            let near = near.filter(|near| near.bad.is_some() == (robust != Robust::No));
            Search::new(&self.evidence, robust, near.as_ref())
        });
        let found = search.step(&self.evidence, self.options.model.alphas());
        if found {
            self.best = Some(search.best());
        } else {
            self.search = Some(search);
        }
        found
    }

    /// What was found.
    fn fitted(&self) -> Fitted<'_> {
        let Options { model, robust, .. } = self.options;
        match self.best {
            Some(best) => Fitted::at(&self.evidence, model.alphas(), best),
            None => Fitted::new(&self.evidence, model.alphas(), robust, None),
        }
    }

    /// The systematic errors a step better; whether they are as they were.
    fn refine(&mut self) -> bool {
        let best = self.fitted().best;
        let mut squares = LeastSquares::after(self.known);
        let legs = self.legs.iter().zip(&self.observations).zip(self.evidence.each(&best));
        for ((leg, observation), density) in legs {
            let variances = density.variances.map(|variance| variance.unwrap_or(0.0));
            let weights = self
                .options
                .model
                .first_order_variances(observation, variances)
                .map(|variance| if variance > 0.0 { (1.0 - density.bad) / variance } else { 0.0 });
            squares.add(&self.systematic, leg, observation, weights);
        }
        let Step { change, deviations, inverse } = squares.step();
        (self.deviations, self.known) = (deviations, inverse);
        let mut stays = true;
        for (i, error) in Error::ALL.into_iter().enumerate() {
            let Some(deviation) = deviations[i] else {
                // Whatever an earlier round made of it.
                self.systematic.set(error, self.begun.get(error));
                continue;
            };
            let most = 4.0 * error.largest_deviation();
            let change = change[i].max(-most).min(most);
            self.systematic.set(error, self.systematic.get(error) + change);
            stays &= change.abs() <= STAYS * deviation;
        }
        stays
    }

    fn judge(&mut self, halves: &Halves) -> Calibration {
        let Options { model, noise, seed, .. } = self.options;
        let fitted = self.fitted();
        let (estimate, undetermined) = self.estimate(&fitted);
        let mut bootstrap = bootstrap::intervals(&fitted, model.alphas(), seed);
        bootstrap
            .iter_mut()
            .enumerate()
            .for_each(|(k, interval)| *interval = interval.filter(|_| undetermined[k].is_none()));
        let judged = Judged::all(&self.evidence, &fitted.best, &self.observations);
        let neighbours: Vec<bool> = (0..self.legs.len())
            .map(|i| i > 0 && self.legs[i - 1].times[1] == self.legs[i].times[0])
            .collect();
        let mut doubts = doubts(model, noise, &self.observations, &judged, &neighbours, halves);
        if doubts.verdict != Verdict::FewLegs {
            doubts.verdict = mismatch(&self.legs, &self.observations, &self.removed, self.options.legs)
                .unwrap_or(doubts.verdict);
        }
        Calibration {
            estimate,
            undetermined,
            bootstrap,
            systematic: self.systematic,
            deviations: self.deviations,
            removed: self.removed,
            doubts,
            inflation: halves.inflation(),
            judged,
            legs: std::mem::take(&mut self.legs),
            observations: std::mem::take(&mut self.observations),
            by_length: Vec::new(),
        }
    }

    /// The α's that are determined, and why the others are not.
    fn estimate(&self, fitted: &Fitted) -> (Estimate, Vec<Option<Undetermined>>) {
        let reasons = undetermined(fitted, self.options.model, &self.observations, &self.intervals);
        let told = |(interval, reason): (&Option<[f64; 2]>, &Option<Undetermined>)| {
            interval.filter(|_| reason.is_none())
        };
        (fitted.estimate(self.intervals.iter().zip(&reasons).map(told).collect()), reasons)
    }
}
