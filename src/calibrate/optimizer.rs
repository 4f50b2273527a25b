//! Fit of the variances and the systematic errors: maximum of the restricted likelihood over variances of 0 or more.

use super::alignment::clock_offset;
use super::legs::{Leg, LegLength, LostLegs, MIN_LEGS};
use super::likelihood::{
    Expansion, FreeMask, PARAMETER_COUNT, POSITION_VARIANCE, Parameters, Residuals, YAW_VARIANCE,
    identifiable_errors, masked_inverse,
};
use super::residuals::{ErrorMask, Observation, Systematic, SystematicError};
use super::result::LegFit;
use super::{CalibrateError, Drive, Options};
use crate::geom::se2::wrap_angle;
use std::ops::Range;

/// Legs of all drives.
pub(super) struct Log<'a> {
    drives: &'a [Drive],
    pub legs: Vec<Leg>,
    pub lost: LostLegs,
    /// Clock offset (s) of the first drive, with which its legs were cut.
    clock_offset: f64,
}

impl<'a> Log<'a> {
    /// Cuts all drives into legs, at the clock offsets with the largest correlation of turn rates.
    pub fn new(drives: &'a [Drive], leg_length: LegLength) -> Result<Self, CalibrateError> {
        let mut log = Self { drives, legs: Vec::new(), lost: LostLegs::default(), clock_offset: 0.0 };
        for (drive_index, drive) in drives.iter().enumerate() {
            let drive_offset =
                clock_offset(&drive.odometry, &drive.reference).ok_or(CalibrateError::NoCommonTime)?;
            if drive_index == 0 {
                log.clock_offset = drive_offset;
            }
            drive.cut_into_legs(drive_index, leg_length, drive_offset, &mut log.legs, &mut log.lost);
        }
        if log.legs.len() < MIN_LEGS {
            return Err(CalibrateError::TooFewLegs { legs: log.legs.len() });
        }
        Ok(log)
    }

    /// Moves the ends of legs of this log to another clock offset (s) of the first drive. An end beyond the first or last reading of the
    /// odometry is extrapolated at its velocity.
    fn align_legs(&self, legs: &mut [Leg], clock_offset: f64) {
        let offset_change = clock_offset - self.clock_offset;
        let mut previous_end = Default::default();
        for leg in legs {
            let align_end = |end_index: usize| {
                let (time, velocity) = (leg.times[end_index] - offset_change, leg.velocities[end_index]);
                let extrapolate = || (leg.odometry[end_index].boxplus(-offset_change * velocity), velocity);
                let motion = self.drives[leg.drive].odometry.motion_at(time);
                (time, motion.unwrap_or_else(extrapolate))
            };
            // Neighbouring legs share an end.
            let aligned_ends = [if leg.follows { previous_end } else { align_end(0) }, align_end(1)];
            leg.times = aligned_ends.map(|(time, _)| time);
            leg.odometry = aligned_ends.map(|(_, (pose, _))| pose);
            leg.velocities = aligned_ends.map(|(_, (_, velocity))| velocity);
            previous_end = aligned_ends[1];
        }
    }
}

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

impl LegSet {
    fn new(legs: Vec<Leg>, estimated: ErrorMask, options: &Options) -> Self {
        let (outliers, observations) = (vec![false; legs.len()], Vec::new());
        Self { options: *options, legs, observations, outliers, systematic: Systematic::NONE, estimated }
    }

    /// Computes the residuals under systematic errors. `position_std` (m) is the standard deviation of the reference.
    fn update_observations(&mut self, systematic: Systematic, position_std: f64) {
        self.systematic = systematic;
        let observe_leg = |leg| Observation::new(self.options.model, leg, &systematic, position_std);
        self.observations = self.legs.iter().map(observe_leg).collect();
    }

    /// Returns the residuals of all legs.
    pub fn residuals(&self) -> Residuals<'_> {
        self.residuals_in(0..self.legs.len())
    }

    /// Returns the residuals of the legs in `range`. All legs are fitted but the outliers. Fitted parameters are the α's of the model, and
    /// each variance of the reference that the options do not state.
    pub fn residuals_in(&self, range: Range<usize>) -> Residuals<'_> {
        let Options { model, position_std, yaw_std, .. } = self.options;
        let free = std::array::from_fn(|parameter| match parameter {
            POSITION_VARIANCE => position_std.is_none(),
            YAW_VARIANCE => yaw_std.is_none(),
            alpha => alpha < model.alpha_count(),
        });
        let is_fitted = self.outliers[range.clone()].iter().map(|is_outlier| !is_outlier).collect();
        let observations = &self.observations[range];
        Residuals { model, free, estimated: self.estimated, observations, is_fitted }
    }

    /// Returns the systematic errors after a step of generalized least squares, and true if the step is small. Errors that are not
    /// estimated are reset to their neutral value, except for the clock offset, which stays unchanged.
    fn corrected_errors(&self, maximum: &Expansion) -> (Systematic, bool) {
        let mut corrected = Systematic { clock_offset: self.systematic.clock_offset, ..Systematic::NONE };
        let (mut is_small_change, filter_result) = (true, &maximum.filter_result);
        for error in SystematicError::ALL.into_iter().filter(|error| self.estimated[*error as usize]) {
            let i = error as usize;
            is_small_change &= filter_result.errors[i].abs()
                <= CONVERGENCE_TOLERANCE * filter_result.covariance[(i, i)].sqrt();
            *corrected.get_mut(error) = self.systematic.get(error) - filter_result.errors[i];
        }
        corrected.mount_yaw = wrap_angle(corrected.mount_yaw);
        (corrected, is_small_change)
    }
}

/// Maximum number of legs that are fitted, in blocks spread over the log. With 6,000 legs the standard error of an α is about 3 %.
const MAX_LEGS: usize = 6_000;
const LEGS_PER_BLOCK: usize = 100;

/// Returns all legs, or every n-th block of neighbouring legs if there are more than [`MAX_LEGS`].
fn sample_legs(legs: &[Leg]) -> Vec<Leg> {
    let block_step = legs.len().div_ceil(MAX_LEGS);
    let mut sample = legs.chunks(LEGS_PER_BLOCK).step_by(block_step).flatten().copied().collect::<Vec<_>>();
    if block_step > 1 {
        sample.iter_mut().step_by(LEGS_PER_BLOCK).for_each(|leg| leg.follows = false);
    }
    sample
}

const MAX_ROUNDS: usize = 15;

/// Gain of log-likelihood (nats) below which the search in a round ends: that of a step of half a standard error. The next round continues
/// the search.
const ROUND_GAIN: f64 = 0.1;

/// Change of a systematic error between rounds, relative to its standard error, below which the rounds end.
const CONVERGENCE_TOLERANCE: f64 = 0.05;

/// Fit to a sample of the legs.
#[derive(Clone, Debug)]
pub(super) struct Fit {
    pub leg_set: LegSet,
    pub maximum: Expansion,
}

/// Initial guess of α's.
const INITIAL_ALPHA: f64 = 0.02;

/// Initial guess of the standard deviations of the reference, m and rad. The guess is large: if outliers are kept, a search from a small
/// guess can end at a local maximum of the likelihood at which the reference has no noise.
const INITIAL_REFERENCE_STD: f64 = 1e-2;

impl Options {
    /// Returns the initial guess of the parameters.
    fn initial_guess(&self) -> Parameters {
        Parameters::from_fn(|parameter, _| match parameter {
            POSITION_VARIANCE => self.position_std.unwrap_or(INITIAL_REFERENCE_STD).powi(2),
            YAW_VARIANCE => self.yaw_std.unwrap_or(INITIAL_REFERENCE_STD).powi(2),
            alpha => {
                if alpha < self.model.alpha_count() {
                    INITIAL_ALPHA
                } else {
                    0.0
                }
            }
        })
    }
}

impl Fit {
    /// Fits the variances and the systematic errors in rounds, because residuals depend on the errors, weights on the variances, and
    /// outliers on residuals and weights. Each round chooses the errors in `correctable_errors` that are identifiable, and corrects them by
    /// generalized least squares. The first round starts at the given errors and variances, or at a guess.
    pub fn new(
        log: &Log,
        options: &Options,
        correctable_errors: ErrorMask,
        start_values: Option<(Systematic, Parameters)>,
    ) -> Self {
        let (start_errors, mut parameters) = start_values.unzip();
        let legs = sample_legs(&log.legs);
        let mut systematic = start_errors.unwrap_or_else(|| Systematic {
            mount_yaw: Systematic::initial_mount_yaw(&legs),
            clock_offset: log.clock_offset,
            ..Systematic::NONE
        });
        let mut leg_set = LegSet::new(legs.clone(), correctable_errors, options);
        for round_number in 1.. {
            let position_std = parameters.map_or(f64::INFINITY, |found| found[POSITION_VARIANCE].sqrt());
            leg_set.legs.clone_from(&legs);
            log.align_legs(&mut leg_set.legs, systematic.clock_offset);
            leg_set.update_observations(systematic, position_std);
            let start_parameters = parameters.unwrap_or_else(|| options.initial_guess());
            let filter_result = leg_set.residuals().filter_result(&start_parameters);
            leg_set.estimated = identifiable_errors(&filter_result.information, correctable_errors);
            let errors = filter_result.errors_in(&leg_set.estimated);
            let has_new_outliers = leg_set.mark_outliers(&filter_result.leg_fits(&errors), round_number);
            let residuals = leg_set.residuals();
            let maximum = maximize(&residuals, &start_parameters, ROUND_GAIN);
            let (corrected, is_small_change) = leg_set.corrected_errors(&maximum);
            if !has_new_outliers && round_number > 1 && is_small_change || round_number == MAX_ROUNDS {
                let maximum = maximize(&residuals, &maximum.parameters, EXACT_GAIN);
                return Self { leg_set, maximum };
            }
            (systematic, parameters) = (corrected, Some(maximum.parameters));
        }
        unreachable!("the last round returns")
    }

    /// Returns the innovations of legs under the fit.
    pub fn leg_fits(&self, leg_set: &LegSet) -> Vec<LegFit> {
        let Expansion { parameters, filter_result, .. } = &self.maximum;
        let residuals = leg_set.residuals();
        residuals
            .innovations(parameters)
            .map(|innovation| innovation.leg_fit(&filter_result.errors))
            .collect()
    }

    /// Returns all legs with their residuals. The sample that was fitted has only some of the legs if there are many. The log may then lose
    /// its legs.
    pub fn all_legs(&self, log: &mut Log) -> LegSet {
        let Self { leg_set, maximum } = self;
        if log.legs.len() == leg_set.legs.len() {
            return leg_set.clone();
        }
        let mut legs = std::mem::take(&mut log.legs);
        log.align_legs(&mut legs, leg_set.systematic.clock_offset);
        let mut all_legs = LegSet::new(legs, leg_set.estimated, &leg_set.options);
        all_legs.update_observations(leg_set.systematic, maximum.parameters[POSITION_VARIANCE].sqrt());
        all_legs.mark_outliers(&self.leg_fits(&all_legs), 1);
        all_legs
    }
}

/// Gain of log-likelihood (nats) below which a search counts as exact: that of a step of 0.014 standard errors.
pub(super) const EXACT_GAIN: f64 = 1e-4;

const MAX_STEPS: usize = 60;

/// Maximum number of halvings of a scoring step.
const MAX_HALVINGS: i32 = 10;

/// Relative rounding error of a step that makes a variance 0.
const ROUNDING_TOLERANCE: f64 = 1e-9;

/// Returns the expansion around the maximum, by Fisher scoring from given parameters. A step that does not increase the likelihood is
/// halved. The search ends at a step whose predicted or actual gain of log-likelihood (nats) is below `min_gain`.
pub(super) fn maximize(residuals: &Residuals, start: &Parameters, min_gain: f64) -> Expansion {
    let mut expansion = residuals.expansion(start, residuals.filter_result(start));
    for _ in 0..MAX_STEPS {
        let Expansion { parameters, score, filter_result: filtered, .. } = &expansion;
        let step = feasible_parameters(&expansion, residuals.free, Parameters::zeros()) - parameters;
        if 0.5 * score.dot(&step) < min_gain {
            break;
        }
        let better_parameters = (0..=MAX_HALVINGS).find_map(|halving_count| {
            let candidate_parameters = parameters + step * 0.5_f64.powi(halving_count);
            let candidate_filtered = residuals.filter_result(&candidate_parameters);
            let gain = candidate_filtered.log_likelihood - filtered.log_likelihood;
            (gain > 0.0).then_some((candidate_parameters, candidate_filtered, gain))
        });
        let Some((candidate_parameters, filtered, gain)) = better_parameters else { break };
        expansion = residuals.expansion(&candidate_parameters, filtered);
        if gain < min_gain {
            break;
        }
    }
    expansion
}

/// Returns the parameters after a scoring step of the parameters in `free_mask`. Other parameters move by `fixed_step`. A variance that would
/// become negative is set to 0, and the steps of the remaining parameters are computed again.
pub(super) fn feasible_parameters(
    Expansion { parameters, score, information, .. }: &Expansion,
    mut free_mask: FreeMask,
    mut fixed_step: Parameters,
) -> Parameters {
    loop {
        let remaining_score = score - information * fixed_step;
        let step = masked_inverse(information, &free_mask).0 * remaining_score + fixed_step;
        let is_negative =
            |i: &usize| free_mask[*i] && parameters[*i] + step[*i] < -ROUNDING_TOLERANCE * parameters[*i];
        match (0..PARAMETER_COUNT).find(is_negative) {
            Some(i) => (free_mask[i], fixed_step[i]) = (false, -parameters[i]),
            None => return (parameters + step).map(|parameter| parameter.max(0.0)),
        }
    }
}
