//! Fit of the variances and the systematic errors, in rounds. The residuals depend on the systematic errors, their weights on the variances,
//! and the outliers on both.

use super::alignment::clock_offset;
use super::legs::{Leg, LostLegs, MIN_LEGS};
use super::likelihood::{POSITION_VARIANCE, Parameters, Residuals, Term, YAW_VARIANCE, identifiable_errors};
use super::optimizer::{FreeMask, Maximum, maximize};
use super::options::{CalibrateError, Drive, Options};
use super::residuals::Observation;
use super::systematic::{ERROR_COUNT, ErrorMask, Systematic, SystematicError};
use super::trajectory::median;
use crate::geom::se2::wrap_angle;
use std::ops::Range;
use std::rc::Rc;

/// Legs with their residuals, under the systematic errors that are corrected.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub options: Options,
    pub legs: Vec<Leg>,
    pub observations: Vec<Observation>,
    pub terms: Rc<Vec<Term>>,
    pub outliers: Vec<bool>,
    /// Systematic errors with which the residuals were computed.
    pub systematic: Systematic,
    /// Systematic errors that are estimated along with the variances.
    pub estimated: ErrorMask,
}

/// Fit to the legs of a sample.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    pub sample: Sample,
    pub residuals: Residuals,
    pub maximum: Maximum,
    /// Standard errors of the systematic errors; 0 for an error that is not estimated.
    pub stds: [f64; ERROR_COUNT],
}

/// Maximum number of legs that are fitted, in blocks spread over the log. With this many legs the standard error of an α is about 3 %.
const MAX_LEGS: usize = 6_000;
const LEGS_PER_BLOCK: usize = 100;

const MAX_ROUNDS: usize = 15;

/// Change of a systematic error between rounds, relative to its standard error, below which the rounds end.
const CONVERGENCE_TOLERANCE: f64 = 0.05;

/// Factor by which the outlier gate is wider in the first round, in which variances are an initial guess.
const FIRST_ROUND_GATE_FACTOR: f64 = 4.0;

impl Sample {
    fn new(legs: Vec<Leg>, estimated: ErrorMask, options: &Options) -> Self {
        let (outliers, terms) = (vec![false; legs.len()], Rc::default());
        Self {
            options: *options,
            legs,
            observations: Vec::new(),
            terms,
            outliers,
            systematic: Systematic::NONE,
            estimated,
        }
    }

    /// Returns all legs, or evenly spread blocks of neighbouring legs if there are more than [`MAX_LEGS`].
    fn with_max_legs(legs: &[Leg], estimated: ErrorMask, options: &Options) -> Self {
        if legs.len() <= MAX_LEGS {
            return Self::new(legs.to_vec(), estimated, options);
        }
        let block_count = MAX_LEGS / LEGS_PER_BLOCK;
        let mut legs_of_blocks = Vec::with_capacity(MAX_LEGS);
        for block in 0..block_count {
            let first_leg = block * (legs.len() - LEGS_PER_BLOCK) / (block_count - 1);
            legs_of_blocks.extend_from_slice(&legs[first_leg..first_leg + LEGS_PER_BLOCK]);
            let start = legs_of_blocks.len() - LEGS_PER_BLOCK;
            legs_of_blocks[start].follows = false;
        }
        Self::new(legs_of_blocks, estimated, options)
    }

    fn update_observations(&mut self, corrected: &Systematic, position_std: f64) {
        let model = self.options.model;
        self.systematic = *corrected;
        self.observations =
            self.legs.iter().map(|leg| Observation::new(model, leg, corrected, position_std)).collect();
        let term = |(leg, observation): (&Leg, &Observation)| Term::new(model, leg, observation, corrected);
        self.terms = Rc::new(self.legs.iter().zip(&self.observations).map(term).collect());
    }

    /// Returns the residuals of the legs that `select` accepts. A leg follows the one before it only if both are selected.
    pub fn residuals(&self, estimated: ErrorMask, select: impl Fn(usize) -> bool) -> Residuals {
        let follows = |leg: usize| self.legs[leg].follows && leg > 0 && select(leg - 1);
        let chosen_terms = (0..self.legs.len()).filter(|leg| select(*leg)).map(|leg| (leg, follows(leg)));
        Residuals::new(self.options.model, estimated, &self.terms, chosen_terms.collect())
    }

    /// Returns the residuals of the legs in a range that are not outliers.
    pub fn inlier_residuals(&self, range: Range<usize>) -> Residuals {
        self.residuals(self.estimated, |leg| range.contains(&leg) && !self.outliers[leg])
    }

    /// Fits the variances to the legs that are not outliers.
    fn fit(&self, start: Parameters) -> Result<(Residuals, Maximum), CalibrateError> {
        let residuals = self.inlier_residuals(0..self.legs.len());
        if residuals.len() < MIN_LEGS {
            return Err(CalibrateError::TooFewLegs { legs: residuals.len() });
        }
        let maximum = maximize(&residuals, start, &free_parameters(&self.options));
        Ok((residuals, maximum))
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
            let alpha = (median(&mut leg_alphas) / MEDIAN_CHI2_1).clamp(1e-8, 10.0);
            alphas.iter().for_each(|index| parameters[*index] = alpha.max(parameters[*index]));
        }
        let Options { position_std, yaw_std, .. } = self.options;
        parameters[POSITION_VARIANCE] =
            position_std.map_or(INITIAL_REFERENCE_STD * INITIAL_REFERENCE_STD, |std| std * std);
        parameters[YAW_VARIANCE] =
            yaw_std.map_or(INITIAL_REFERENCE_STD * INITIAL_REFERENCE_STD, |std| std * std);
        parameters
    }
}

/// Median of χ² with one degree of freedom, the distribution of the square of a standard normal number.
const MEDIAN_CHI2_1: f64 = 0.4549;

/// Initial guess of the standard deviations of the reference, m and rad.
const INITIAL_REFERENCE_STD: f64 = 1e-3;

/// Returns the parameters that are fitted: α's of the model, and those variances of the reference that the options do not state.
pub(super) fn free_parameters(options: &Options) -> FreeMask {
    std::array::from_fn(|parameter| match parameter {
        POSITION_VARIANCE => options.position_std.is_none(),
        YAW_VARIANCE => options.yaw_std.is_none(),
        alpha => alpha < options.model.alphas(),
    })
}

/// Legs of all drives.
pub(super) struct Log<'a> {
    drives: &'a [Drive<'a>],
    /// Clock offset (s) of each drive, as found by the correlation of turn rates.
    offsets: Vec<f64>,
}

impl<'a> Log<'a> {
    pub fn new(drives: &'a [Drive<'a>]) -> Result<Self, CalibrateError> {
        let clock_offset_of =
            |drive: &Drive| clock_offset(drive.odometry, drive.reference).ok_or(CalibrateError::NoCommonTime);
        Ok(Self { drives, offsets: drives.iter().map(clock_offset_of).collect::<Result<_, _>>()? })
    }

    pub fn clock_offset(&self) -> f64 {
        self.offsets.first().copied().unwrap_or(0.0)
    }

    /// Cuts all drives into legs. `clock_offset` (s) is the offset of the first drive.
    pub fn legs(&self, options: &Options, clock_offset: f64) -> (Vec<Leg>, LostLegs) {
        let (mut legs, mut lost) = (Vec::new(), LostLegs::default());
        for (index, drive) in self.drives.iter().enumerate() {
            let (offset, first_leg) = (clock_offset + self.offsets[index] - self.clock_offset(), legs.len());
            drive.cut_into_legs(options.legs, offset, &mut legs, &mut lost);
            legs[first_leg..].iter_mut().for_each(|leg| leg.drive = index);
        }
        (legs, lost)
    }

    /// Moves the reference poses of a leg by a change of the clock offset. `clock_offset` is the new offset of the first drive. A leg that
    /// would leave the log stays as it is.
    fn realign(&self, leg: &mut Leg, clock_offset: f64, offset_change: f64) {
        let offset = clock_offset + self.offsets[leg.drive] - self.clock_offset();
        if let Some(realigned) = self.drives[leg.drive].realigned(*leg, offset, offset_change) {
            *leg = realigned;
        }
    }
}

/// Fits all identifiable systematic errors. Each round fits the variances, and then corrects the errors by generalized least squares.
pub(super) fn fit_systematic(log: &Log, options: &Options) -> Result<Fit, CalibrateError> {
    let initial_errors = Systematic { clock_offset: log.clock_offset(), ..Systematic::NONE };
    let (legs, _) = log.legs(options, initial_errors.clock_offset);
    if legs.len() < MIN_LEGS {
        return Err(CalibrateError::TooFewLegs { legs: legs.len() });
    }
    let mut sample = Sample::with_max_legs(&legs, [true; ERROR_COUNT], options);
    let mut systematic =
        Systematic { mount_yaw: Systematic::initial_mount_yaw(&sample.legs), ..initial_errors };
    let mut parameters: Option<Parameters> = None;
    for round in 1.. {
        let position_std =
            parameters.map_or(f64::INFINITY, |parameters| parameters[POSITION_VARIANCE].sqrt());
        sample.update_observations(&systematic, position_std);
        let start_parameters = parameters.unwrap_or_else(|| sample.initial_guess());
        sample.estimated = identifiable_errors(
            &sample.inlier_residuals(0..legs.len()).least_squares(&start_parameters).information,
        );
        let gate_factor = if parameters.is_some() { 1.0 } else { FIRST_ROUND_GATE_FACTOR };
        let mut has_converged = !sample.mark_outliers(&start_parameters, gate_factor, round) && round > 1;
        let (residuals, maximum) = sample.fit(start_parameters)?;
        let solution = &maximum.expansion.filtered.least_squares;
        let previous_errors = systematic;
        for (i, error) in SystematicError::ALL.into_iter().enumerate() {
            if sample.estimated[i] {
                let max_change = 4.0 * error.identifiability_limit();
                let error_change = -solution.errors[i];
                has_converged &=
                    error_change.abs() <= CONVERGENCE_TOLERANCE * solution.covariance[(i, i)].sqrt();
                *systematic.get_mut(error) += error_change.clamp(-max_change, max_change);
            } else {
                *systematic.get_mut(error) = initial_errors.get(error);
            }
        }
        systematic.mount_yaw = wrap_angle(systematic.mount_yaw);
        if has_converged || round == MAX_ROUNDS {
            let block_length = (residuals.len() as f64).cbrt().ceil() as usize;
            let sandwich = maximum.expansion.filtered.sandwich(block_length);
            let std = |i: usize| solution.covariance[(i, i)].max(sandwich[(i, i)]).max(0.0).sqrt();
            let stds = std::array::from_fn(std);
            return Ok(Fit { sample, residuals, maximum, stds });
        }
        let offset_change = systematic.clock_offset - previous_errors.clock_offset;
        sample.legs.iter_mut().for_each(|leg| log.realign(leg, systematic.clock_offset, offset_change));
        parameters = Some(maximum.parameters);
    }
    unreachable!("the last round returns")
}

/// Fits the variances with only the given errors corrected. Also returns the sample of all legs, because the fit may use only some of them.
pub(super) fn fit_corrected(
    log: &Log,
    options: &Options,
    corrected: &Systematic,
    mask: ErrorMask,
    start: &Parameters,
) -> Result<(Fit, Sample, LostLegs), CalibrateError> {
    let (legs, lost) = log.legs(options, corrected.clock_offset);
    let mut sample = Sample::with_max_legs(&legs, mask, options);
    let mut parameters = *start;
    let mut last_fit = None;
    for round in 1..=MAX_ROUNDS {
        sample.update_observations(corrected, parameters[POSITION_VARIANCE].sqrt());
        if !sample.mark_outliers(&parameters, 1.0, round) && last_fit.is_some() {
            break;
        }
        let (residuals, maximum) = sample.fit(parameters)?;
        parameters = maximum.parameters;
        last_fit = Some((residuals, maximum));
    }
    let Some((residuals, maximum)) = last_fit else { unreachable!("the first round fits") };
    let mut all_legs = sample.clone();
    if legs.len() > sample.legs.len() {
        all_legs = Sample::new(legs, mask, options);
        all_legs.update_observations(corrected, parameters[POSITION_VARIANCE].sqrt());
        all_legs.mark_outliers(&parameters, 1.0, 1);
    }
    let fit = Fit { sample, residuals, maximum, stds: [0.0; ERROR_COUNT] };
    Ok((fit, all_legs, lost))
}
