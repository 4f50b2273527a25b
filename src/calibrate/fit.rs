//! Fit of the variances and the systematic errors.

use super::alignment::clock_offset;
use super::legs::{Leg, LostLegs, MIN_LEGS};
use super::likelihood::{
    Expansion, POSITION_VARIANCE, Parameters, Residuals, YAW_VARIANCE, identifiable_errors,
};
use super::optimizer::{EXACT_GAIN, maximize};
use super::residuals::Observation;
use super::systematic::{ErrorMask, Systematic, SystematicError};
use super::trajectory::median;
use super::{CalibrateError, Drive, Options};
use crate::geom::se2::wrap_angle;
use std::ops::Range;

/// Legs of a log with their residuals, for given systematic errors.
#[derive(Clone, Debug)]
pub(super) struct LegSet {
    pub options: Options,
    pub legs: Vec<Leg>,
    pub observations: Vec<Observation>,
    pub outliers: Vec<bool>,
    /// Systematic errors with which the residuals were computed.
    pub systematic: Systematic,
    /// Systematic errors that are estimated along with the variances.
    pub estimated: ErrorMask,
}

/// Fit to a sample of the legs.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    pub sample: LegSet,
    pub residuals: Residuals,
    pub maximum: Expansion,
    /// All legs, at the clock offset before the fit.
    uncorrected_legs: Vec<Leg>,
    uncorrected_offset: f64,
    pub lost: LostLegs,
}

/// Maximum number of legs that are fitted, in blocks spread over the log. With 6,000 legs the standard error of an α is about 3 %.
const MAX_LEGS: usize = 6_000;
const LEGS_PER_BLOCK: usize = 100;

const MAX_ROUNDS: usize = 15;

/// Gain of log-likelihood (nats) below which the search in a round ends: that of a step of half a standard error. The next round continues
/// the search.
const ROUND_GAIN: f64 = 0.1;

/// Change of a systematic error between rounds, relative to its standard error, below which the rounds end.
const CONVERGENCE_TOLERANCE: f64 = 0.05;

impl LegSet {
    fn new(legs: Vec<Leg>, systematic: &Systematic, estimated: ErrorMask, options: &Options) -> Self {
        let (outliers, observations) = (vec![false; legs.len()], Vec::new());
        Self { options: *options, legs, observations, outliers, systematic: *systematic, estimated }
    }

    /// Computes the residuals under the present systematic errors. `position_std` (m) is the standard deviation of the reference.
    fn update_observations(&mut self, position_std: f64) {
        let Self { systematic, options: Options { model, .. }, .. } = *self;
        let observe = |leg| Observation::new(model, leg, &systematic, position_std);
        self.observations = self.legs.iter().map(observe).collect();
    }

    /// Returns true if a leg and the previous leg are selected, and the leg starts where the previous leg ends.
    pub fn follows(&self, leg: usize, select: impl Fn(usize) -> bool) -> bool {
        self.legs[leg].follows && leg > 0 && select(leg - 1) && select(leg)
    }

    /// Returns the residuals of the legs that `select` accepts. Fitted parameters are the α's of the model, and each variance of the
    /// reference that the options do not state.
    pub fn residuals(&self, estimated: ErrorMask, select: impl Fn(usize) -> bool) -> Residuals {
        let selected_legs = (0..self.legs.len()).filter(|leg| select(*leg));
        let observation_of =
            |leg| Observation { follows: self.follows(leg, &select), ..self.observations[leg] };
        let Options { model, position_std, yaw_std, .. } = self.options;
        let free = std::array::from_fn(|parameter| match parameter {
            POSITION_VARIANCE => position_std.is_none(),
            YAW_VARIANCE => yaw_std.is_none(),
            alpha => alpha < model.alphas(),
        });
        Residuals { model, free, estimated, observations: selected_legs.map(observation_of).collect() }
    }

    pub fn inlier_residuals(&self, range: Range<usize>) -> Residuals {
        self.residuals(self.estimated, |leg| range.contains(&leg) && !self.outliers[leg])
    }

    /// Returns the systematic errors after a step of generalized least squares, and true if the step is small. Errors that are not
    /// estimated are reset to their neutral value, except for the clock offset, which stays unchanged.
    fn corrected_errors(&self, maximum: &Expansion) -> (Systematic, bool) {
        let mut corrected = Systematic { clock_offset: self.systematic.clock_offset, ..Systematic::NONE };
        let (mut is_small_change, solution) = (true, &maximum.filtered);
        for error in SystematicError::ALL.into_iter().filter(|error| self.estimated[*error as usize]) {
            let (i, max_change) = (error as usize, 4.0 * error.identifiability_limit());
            is_small_change &=
                solution.errors[i].abs() <= CONVERGENCE_TOLERANCE * solution.covariance[(i, i)].sqrt();
            *corrected.get_mut(error) =
                self.systematic.get(error) - solution.errors[i].clamp(-max_change, max_change);
        }
        corrected.mount_yaw = wrap_angle(corrected.mount_yaw);
        (corrected, is_small_change)
    }

    /// Returns the initial guess of the parameters, from the median of the squared residuals of each component.
    fn initial_guess(&self) -> Parameters {
        let mut parameters = Parameters::zeros();
        for (component, alphas) in self.options.model.component_alphas().into_iter().enumerate() {
            let alpha_from = |observation: &Observation| {
                let [first_coefficient, second_coefficient] = observation.coefficients[component];
                observation.residuals[component].powi(2) / (first_coefficient + second_coefficient)
            };
            let mut leg_alphas: Vec<f64> =
                self.observations.iter().map(alpha_from).filter(|ratio| ratio.is_finite()).collect();
            let initial_alpha = (median(&mut leg_alphas) / MEDIAN_CHI2_1).clamp(1e-8, 10.0);
            alphas.iter().for_each(|index| parameters[*index] = initial_alpha.max(parameters[*index]));
        }
        let Options { position_std, yaw_std, .. } = self.options;
        for (variance, std) in [(POSITION_VARIANCE, position_std), (YAW_VARIANCE, yaw_std)] {
            parameters[variance] = std.unwrap_or(INITIAL_REFERENCE_STD).powi(2);
        }
        parameters
    }
}

/// Median of χ² with one degree of freedom, the distribution of the square of a standard normal number.
const MEDIAN_CHI2_1: f64 = 0.4549;

/// Initial guess of the standard deviations of the reference, m and rad. The guess is large: if outliers are kept, a search from a small
/// guess can end at a local maximum of the likelihood at which the reference has no noise.
const INITIAL_REFERENCE_STD: f64 = 1e-2;

/// Legs of all drives.
pub(super) struct Log<'a> {
    drives: &'a [Drive],
    /// Clock offset (s) of each drive, as found by the correlation of turn rates.
    offsets: Vec<f64>,
}

impl<'a> Log<'a> {
    pub fn new(drives: &'a [Drive]) -> Result<Self, CalibrateError> {
        let clock_offset_of = |drive: &Drive| {
            clock_offset(&drive.odometry, &drive.reference).ok_or(CalibrateError::NoCommonTime)
        };
        Ok(Self { drives, offsets: drives.iter().map(clock_offset_of).collect::<Result<_, _>>()? })
    }

    /// Returns the systematic errors before the fit. The clock offset is the offset of the first drive.
    fn initial_errors(&self) -> Systematic {
        Systematic { clock_offset: self.offsets.first().copied().unwrap_or(0.0), ..Systematic::NONE }
    }

    /// Cuts all drives into legs. `clock_offset` (s) is the offset of the first drive.
    fn legs(&self, options: &Options, clock_offset: f64) -> Result<(Vec<Leg>, LostLegs), CalibrateError> {
        let (mut legs, mut lost) = (Vec::new(), LostLegs::default());
        for (index, drive) in self.drives.iter().enumerate() {
            let first_leg = legs.len();
            let drive_offset = self.offsets[index] + clock_offset - self.initial_errors().clock_offset;
            drive.cut_into_legs(options.legs, drive_offset, &mut legs, &mut lost);
            legs[first_leg..].iter_mut().for_each(|leg| leg.drive = index);
        }
        if legs.len() < MIN_LEGS {
            Err(CalibrateError::TooFewLegs { legs: legs.len() })
        } else {
            Ok((legs, lost))
        }
    }

    /// Recomputes the ends of legs for a clock offset that is `change` (s) larger.
    fn realign(&self, legs: &mut [Leg], change: f64) {
        legs.iter_mut().for_each(|leg| self.drives[leg.drive].realign(leg, change));
    }
}

/// Returns all legs, or evenly spread blocks of neighbouring legs if there are more than [`MAX_LEGS`].
fn with_max_legs(legs: &[Leg]) -> Vec<Leg> {
    if legs.len() <= MAX_LEGS {
        return legs.to_vec();
    }
    let block_count = MAX_LEGS / LEGS_PER_BLOCK;
    let blocks = (0..block_count).map(|block| block * (legs.len() - LEGS_PER_BLOCK) / (block_count - 1));
    let legs_of_block = |first_leg: usize| {
        let mut block = legs[first_leg..first_leg + LEGS_PER_BLOCK].to_vec();
        block[0].follows = false;
        block
    };
    blocks.flat_map(legs_of_block).collect()
}

/// Fits the variances and the systematic errors in rounds, because residuals depend on the errors, weights on the variances, and outliers on
/// residuals and weights. Each round chooses the errors in `correctable` that are identifiable, and corrects them by generalized least
/// squares. The first round starts at the given errors and variances, or at a guess.
pub(super) fn fit(
    log: &Log,
    options: &Options,
    correctable: ErrorMask,
    start: Option<(Systematic, Parameters)>,
) -> Result<Fit, CalibrateError> {
    let (start_errors, mut parameters) = start.unzip();
    let uncorrected_offset = start_errors.unwrap_or(log.initial_errors()).clock_offset;
    let (uncorrected_legs, lost) = log.legs(options, uncorrected_offset)?;
    let legs = with_max_legs(&uncorrected_legs);
    let systematic = start_errors.unwrap_or_else(|| Systematic {
        mount_yaw: Systematic::initial_mount_yaw(&legs),
        ..log.initial_errors()
    });
    let mut sample = LegSet::new(legs, &systematic, correctable, options);
    let all_legs = 0..sample.legs.len();
    for round in 1.. {
        sample.update_observations(parameters.map_or(f64::INFINITY, |found| found[POSITION_VARIANCE].sqrt()));
        let start_parameters = parameters.unwrap_or_else(|| sample.initial_guess());
        let solution = sample.inlier_residuals(all_legs.clone()).filtered(&start_parameters);
        sample.estimated = identifiable_errors(&solution.information, correctable);
        let errors = solution.errors_in(&sample.estimated);
        let has_new_outliers = sample.mark_outliers(&start_parameters, &errors, round);
        let residuals = sample.inlier_residuals(all_legs.clone());
        if residuals.observations.len() < MIN_LEGS {
            return Err(CalibrateError::TooFewLegs { legs: residuals.observations.len() });
        }
        let maximum = maximize(&residuals, residuals.expansion_at(&start_parameters), ROUND_GAIN);
        let (corrected, is_small_change) = sample.corrected_errors(&maximum);
        if !has_new_outliers && round > 1 && is_small_change || round == MAX_ROUNDS {
            let maximum = maximize(&residuals, maximum, EXACT_GAIN);
            return Ok(Fit { sample, residuals, maximum, uncorrected_legs, uncorrected_offset, lost });
        }
        log.realign(&mut sample.legs, corrected.clock_offset - sample.systematic.clock_offset);
        sample.systematic = corrected;
        parameters = Some(maximum.parameters);
    }
    unreachable!("the last round returns")
}

impl Fit {
    /// Returns all legs with their residuals. The sample that was fitted has only some of the legs if there are many.
    pub fn all_legs(&self, log: &Log) -> LegSet {
        let Self { sample, maximum, .. } = self;
        if self.uncorrected_legs.len() == sample.legs.len() {
            return sample.clone();
        }
        let mut legs = self.uncorrected_legs.clone();
        log.realign(&mut legs, sample.systematic.clock_offset - self.uncorrected_offset);
        let mut all_legs = LegSet::new(legs, &sample.systematic, sample.estimated, &sample.options);
        all_legs.update_observations(maximum.parameters[POSITION_VARIANCE].sqrt());
        all_legs.mark_outliers(&maximum.parameters, &maximum.filtered.errors, 1);
        all_legs
    }
}
