//! From a log to parameters, one step after the other.

mod rounds;

use super::bad::Robust;
use super::bootstrap::{Bootstrap, stretched};
use super::calibration::{CalibrateError, Calibration, Options};
use super::clock::{Alignment, KNOWN_TO};
use super::judging::{Judge, Judging};
use super::leg_lengths::{ASKED, AtLength, FACTORS, MOST, have_rows};
use super::legs::{Cutting, FEWEST, Leg};
use super::likelihood::{Alphas, Evidence, LegDensity, Parameters, Slope};
use super::model::{Observation, Uncertainty};
use super::profile::{Ends, Estimate, Fitted, Search};
use super::stages::{Purpose, ROUNDS, Stage, parts};
use super::systematic::{ERRORS, Error, LeastSquares, Systematic};
use super::trajectory::Trajectory;
use super::undetermined::{Undetermined, undetermined};
use super::work::Work;
use nalgebra::Matrix2;

/// A calibration under way: the same in pieces, so that nobody has to wait for all of it.
///
/// 1. Clocks are aligned by the robot's turns.
/// 2. Legs are cut, α's fitted to them, and systematic errors found by least squares with the weights that these α's give; again with
///    those errors removed, until they stay.
/// 3. The α's are fitted with the errors removed that are to be.
/// 4. Each α's interval; the bootstrap; a fit to the first half of the log; the doubts; inflation.
/// 5. If asked for, legs of each other length, the intervals of their α's, and the bootstrap.
///
/// No step is longer than a few passes over the legs: what takes more comes in several.
#[derive(Clone, Debug)]
pub struct Calibrating {
    options: Options,
    stage: Stage,
    /// Since the latest part of the progress was done.
    steps: usize,
    alignment: Alignment,
    /// The systematic errors as long as no leg has told any: none but the offset of the clocks.
    begun: Systematic,
    systematic: Systematic,
    deviations: [Option<f64>; ERRORS],
    /// What the reference is taken to err by at least, m and rad, once the wheels turn out to err by less than a reference shows.
    least_error: Option<f64>,
    /// Of the last round.
    known: [[f64; ERRORS]; ERRORS],
    removed: Systematic,
    /// What `deviations` and `known` are by the legs of another length.
    of_length: ([Option<f64>; ERRORS], [[f64; ERRORS]; ERRORS]),
    cutting: Option<Cutting>,
    legs: Vec<Leg>,
    observations: Vec<Observation>,
    evidence: Evidence,
    best: Option<(Parameters, Slope)>,
    /// For the next best, while it is under way.
    search: Option<Search>,
    /// The next errors, with how many legs they are of so far.
    squares: Option<(LeastSquares, usize)>,
    /// Of the next interval.
    ends: Option<Ends>,
    intervals: Vec<Option<[f64; 2]>>,
    judging: Judging,
    /// Of the next bootstrap of another length.
    drawing: Option<Bootstrap>,
    /// Of the legs that were asked for, while those of other lengths are fitted.
    asked: Option<Calibration>,
    work: Work,
}

/// Rows that are cut in a step, and legs that are looked at.
const ROWS: usize = 40_000;
const LEGS: usize = 20_000;

/// What cutting or looking at one costs, in legs gone through: its ends are on arcs.
const ARCS: usize = 8;

impl Calibrating {
    pub fn new(options: Options) -> Self {
        let work = Work::default();
        Self {
            options,
            stage: Stage::Align,
            steps: 0,
            alignment: Alignment::default(),
            begun: Systematic::NONE,
            systematic: Systematic::NONE,
            deviations: [None; ERRORS],
            least_error: None,
            known: [[0.0; ERRORS]; ERRORS],
            removed: Systematic::NONE,
            of_length: ([None; ERRORS], [[0.0; ERRORS]; ERRORS]),
            cutting: None,
            legs: Vec::new(),
            observations: Vec::new(),
            evidence: Evidence::none(options.model, options.noise, work.clone()),
            best: None,
            search: None,
            squares: None,
            ends: None,
            intervals: Vec::new(),
            judging: Judging::default(),
            drawing: None,
            asked: None,
            work,
        }
    }

    /// How many legs were gone through for the likelihood of their residuals so far, and what else takes so long, but for the
    /// alignment of the clocks: what it costs, the same on every machine.
    pub fn work(&self) -> usize {
        self.work.total()
    }

    /// How much is done, 0 to 1.
    pub fn progress(&self) -> f64 {
        let Options { model, by_length, .. } = self.options;
        let part = if self.stage == Stage::Align {
            self.alignment.progress()
        } else {
            // Nobody knows how many there are.
            self.steps as f64 / (10.0 + self.steps as f64)
        };
        (self.done() as f64 + part) / parts(model.alphas(), by_length) as f64
    }

    fn done(&self) -> usize {
        self.stage.done(self.options.model.alphas())
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
        let before = self.done();
        let told = self.go_on(odometry, reference);
        self.steps = if self.done() == before { self.steps + 1 } else { 0 };
        told
    }

    fn go_on(
        &mut self,
        odometry: &Trajectory,
        reference: &Trajectory,
    ) -> Result<Option<Calibration>, CalibrateError> {
        self.stage = match self.stage {
            Stage::Align => {
                let Some(offset) = self.alignment.step(odometry, reference) else { return Ok(None) };
                self.begun.clock_offset = offset.ok_or(CalibrateError::Apart)?;
                self.systematic = self.begun;
                Stage::Cut(Purpose::Round(0))
            }
            Stage::Cut(Purpose::Scatter(place)) if place == FACTORS.len() => return Ok(self.asked.take()),
            Stage::Cut(Purpose::Scatter(place)) if FACTORS[place] == ASKED => {
                if let Some(asked) = &mut self.asked {
                    let (legs, estimate) = (asked.legs.len(), Some(asked.estimate.clone()));
                    let bootstrap = asked.bootstrap.clone();
                    asked.by_length.push(AtLength { factor: ASKED, legs, estimate, bootstrap });
                }
                Stage::Cut(Purpose::Scatter(place + 1))
            }
            Stage::Cut(purpose) => {
                let Some(enough) = self.cut(odometry, reference, purpose) else { return Ok(None) };
                if purpose == Purpose::Round(0) {
                    self.systematic.mount_yaw = Systematic::far_mount_yaw(&self.legs);
                }
                match purpose {
                    _ if enough => Stage::Observe(purpose),
                    Purpose::Scatter(place) => {
                        self.tell(FACTORS[place], None);
                        Stage::Cut(Purpose::Scatter(place + 1))
                    }
                    _ => return Err(CalibrateError::FewLegs { legs: self.legs.len() }),
                }
            }
            Stage::Observe(purpose) => {
                if !self.observe(purpose) {
                    return Ok(None);
                }
                if self.turns_out_exact(purpose) {
                    self.forget();
                    return Ok(None);
                }
                Stage::Fit(purpose)
            }
            Stage::Fit(purpose) => {
                // Bad legs are set aside in rounds even if the α's are to answer for them.
                let robust = match (purpose, self.options.robust) {
                    (Purpose::Round(_) | Purpose::Scatter(_), Robust::No) => Robust::Estimated,
                    (_, robust) => robust,
                };
                if !self.search(robust) {
                    return Ok(None);
                }
                match purpose {
                    Purpose::Round(_) | Purpose::Scatter(_) => Stage::Refine(purpose),
                    _ => Stage::Interval(purpose, 0),
                }
            }
            Stage::Refine(purpose) => {
                let Some(step) = self.refine(purpose) else { return Ok(None) };
                if let Purpose::Scatter(place) = purpose {
                    self.of_length = (step.deviations, step.inverse);
                    self.forget();
                    Stage::Observe(Purpose::Length(place))
                } else {
                    let stays = self.improve(&step);
                    match purpose {
                        Purpose::Round(round)
                            if self.is_now_exact(round, stays) || !stays && round + 1 < ROUNDS =>
                        {
                            Stage::Cut(Purpose::Round(round + 1))
                        }
                        _ => {
                            self.remove();
                            Stage::Cut(Purpose::Alphas)
                        }
                    }
                }
            }
            Stage::Interval(purpose, alpha) => {
                if !self.interval(alpha) {
                    return Ok(None);
                }
                match purpose {
                    _ if alpha + 1 < self.options.model.alphas() => Stage::Interval(purpose, alpha + 1),
                    Purpose::Length(place) => Stage::Stretch(place),
                    _ => Stage::Judge,
                }
            }
            Stage::Stretch(place) => {
                let mut drawing = self.drawing.take();
                let Options { model, seed, .. } = self.options;
                let fitted = self.fitted();
                let longer = drawing
                    .get_or_insert_with(|| Bootstrap::new(&fitted, model.alphas(), seed))
                    .step(&fitted);
                let Some(longer) = longer else {
                    self.drawing = drawing;
                    return Ok(None);
                };
                let (estimate, _) = self.estimate(&fitted);
                self.tell(FACTORS[place], Some((estimate, longer)));
                Stage::Cut(Purpose::Scatter(place + 1))
            }
            Stage::Judge => {
                let Some(calibration) = self.judge() else { return Ok(None) };
                if !self.options.by_length {
                    return Ok(Some(calibration));
                }
                self.asked = Some(calibration);
                Stage::Cut(Purpose::Scatter(0))
            }
        };
        Ok(None)
    }

    /// What is taken off the legs.
    fn without(&self, purpose: Purpose) -> &Systematic {
        if let Purpose::Round(_) = purpose { &self.systematic } else { &self.removed }
    }

    /// Goes on with cutting; once that is done, whether there are legs enough.
    fn cut(&mut self, odometry: &Trajectory, reference: &Trajectory, purpose: Purpose) -> Option<bool> {
        let asked = self.options.legs;
        self.legs.clear();
        let length = match purpose {
            Purpose::Scatter(place) => asked.times(FACTORS[place]),
            _ => Some(asked),
        };
        let Some(length) = length else { return Some(false) };
        let clock_offset = self.without(purpose).clock_offset;
        let cutting = self.cutting.get_or_insert_with(|| Cutting::new(length, clock_offset));
        let before = cutting.legs.len();
        let done = cutting.go_on(odometry, reference, ROWS);
        self.work.add(ROWS / 4 + ARCS * (cutting.legs.len() - before));
        if !done {
            return None;
        }
        self.legs = self.cutting.take().map_or_else(Vec::new, |cutting| cutting.legs);
        self.forget();
        if let Purpose::Scatter(_) = purpose {
            let (all, kept) = (self.legs.len(), self.legs.len().min(MOST));
            (0..kept).for_each(|place| self.legs[place] = self.legs[place * all / kept]);
            self.legs.truncate(kept);
            (self.best, self.intervals) = (None, Vec::new());
            return Some(kept >= FEWEST && have_rows(&self.legs, odometry, reference));
        }
        Some(self.legs.len() >= FEWEST)
    }

    /// Forgets what the legs say: they are to be asked again.
    fn forget(&mut self) {
        let Options { model, noise, .. } = self.options;
        self.observations.clear();
        self.evidence = Evidence::none(model, noise, self.work.clone());
    }

    /// Goes on with what the legs say; whether all have been asked.
    ///
    /// What is removed was fitted to the same residuals, each of which is told as the others would have it.
    fn observe(&mut self, purpose: Purpose) -> bool {
        let Options { model, noise, remove, .. } = self.options;
        let without = *self.without(purpose);
        let estimated = if let Purpose::Round(_) = purpose { [true; ERRORS] } else { remove };
        let (deviations, known) =
            if let Purpose::Length(_) = purpose { self.of_length } else { (self.deviations, self.known) };
        let deviations: [_; ERRORS] = std::array::from_fn(|i| deviations[i].filter(|_| estimated[i]));
        let clock = Error::ClockOffset as usize;
        // As long as no leg has told it, by how the turns did.
        let unsure = if estimated[clock] { deviations[clock].unwrap_or(KNOWN_TO) } else { 0.0 };
        let [place, heading] = self.reference_error().map(|deviation| deviation * deviation);
        let alphas = self.best.map_or(Alphas::default(), |(best, _)| best.alphas);
        let from = self.observations.len();
        let until = self.legs.len().min(from + LEGS);
        let legs = &self.legs[from..until];
        let observe = |leg: &Leg| {
            let [from, to] = leg.averaged;
            let kink = without.kink(leg);
            let off = kink * deviations[clock].unwrap_or(0.0);
            let place = Matrix2::identity() * (place * (from + to)) + off.xy() * off.xy().transpose();
            let bearing = place + without.uncertainty(leg, &deviations);
            let headings = [from * heading, to * heading + off.z * off.z];
            let mut observation =
                model.observe(leg, &without, &Uncertainty { place, bearing, headings, alphas });
            observation.hide(&(kink * unsure));
            let own = without.own_share(leg, &deviations);
            observation.coefficients = observation.coefficients.map(|pair| pair.map(|each| own * each));
            observation
        };
        let mut observations: Vec<Observation> = legs.iter().map(observe).collect();
        let evidence = Evidence::new(model, noise, &observations);
        // In the first round, and the first time of a length, nothing was fitted to them yet.
        if let Some((best, _)) = &self.best {
            let densities: Vec<LegDensity> = evidence.each(best, 0..legs.len()).collect();
            for ((leg, observation), density) in legs.iter().zip(&mut observations).zip(densities) {
                let unknown = without.unknown(leg, observation, &known, &estimated);
                observation.by_the_others(&unknown, model.weights(observation, &density));
            }
        }
        observations.iter().for_each(|observation| self.evidence.add(observation));
        self.observations.append(&mut observations);
        self.work.add(ARCS * (until - from));
        until == self.legs.len()
    }

    /// What the legs of another length say: their estimate, and by how much longer its intervals are.
    fn tell(&mut self, factor: f64, told: Option<(Estimate, Vec<f64>)>) {
        let legs = self.legs.len();
        let bootstrap = told.as_ref().map_or_else(Vec::new, |(estimate, longer)| stretched(estimate, longer));
        let estimate = told.map(|(estimate, _)| estimate);
        if let Some(asked) = &mut self.asked {
            asked.by_length.push(AtLength { factor, legs, estimate, bootstrap });
        }
    }

    /// Goes on with the search for the likeliest α's; whether they are found.
    fn search(&mut self, robust: Robust) -> bool {
        let Some(search) = &mut self.search else {
            let near = self.best.map(|(near, _)| near);
            let near = near.filter(|near| near.bad.is_some() == (robust != Robust::No));
            self.search = Some(Search::new(&self.evidence, robust, near.as_ref()));
            return false;
        };
        let found = search.step(&self.evidence, self.options.model.alphas());
        if found {
            self.best = self.search.take().map(|search| search.best());
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

    /// Goes on with the interval of an α; whether it is there.
    fn interval(&mut self, alpha: usize) -> bool {
        let before = self.ends.take();
        let fitted = self.fitted();
        let mut ends = before.unwrap_or_else(|| Ends::new(&fitted, alpha));
        let found = ends.step(&fitted);
        self.ends = found.is_none().then_some(ends);
        self.intervals.extend(found);
        found.is_some()
    }

    /// Goes on with what there is to say besides; all of it once that is done.
    fn judge(&mut self) -> Option<Calibration> {
        let mut judging = std::mem::take(&mut self.judging);
        let Self { options, legs, observations, removed, .. } = &*self;
        let all_said = judging.step(&self.fitted(), Judge { options, legs, observations, removed });
        if !all_said {
            self.judging = judging;
            return None;
        }
        let (estimate, undetermined) = self.estimate(&self.fitted());
        let bootstrap = stretched(&estimate, &judging.longer?);
        Some(Calibration {
            estimate,
            undetermined,
            bootstrap,
            systematic: self.systematic,
            deviations: self.deviations,
            removed: self.removed,
            doubts: judging.doubts?,
            inflation: judging.inflation,
            judged: judging.judged?,
            legs: std::mem::take(&mut self.legs),
            observations: std::mem::take(&mut self.observations),
            by_length: Vec::new(),
        })
    }

    /// The α's that are determined, and why the others are not.
    fn estimate(&self, fitted: &Fitted) -> (Estimate, Vec<Option<Undetermined>>) {
        let Options { model, reference_error, .. } = self.options;
        let is_stated = reference_error.is_stated();
        let reasons = undetermined(fitted, model, &self.observations, &self.intervals, is_stated);
        let told = |(interval, reason): (&Option<[f64; 2]>, &Option<Undetermined>)| {
            interval.filter(|_| reason.is_none())
        };
        (fitted.estimate(self.intervals.iter().zip(&reasons).map(told).collect()), reasons)
    }
}

/// From a log to parameters: [`Calibrating`] to its end.
///
/// # Errors
/// [`CalibrateError`] where there are too few legs, or the two are not of one drive.
pub fn calibrate(
    odometry: &Trajectory,
    reference: &Trajectory,
    options: &Options,
) -> Result<Calibration, CalibrateError> {
    let mut calibrating = Calibrating::new(*options);
    loop {
        if let Some(calibration) = calibrating.step(odometry, reference)? {
            return Ok(calibration);
        }
    }
}
