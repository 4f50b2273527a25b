//! Checks of a fit: validity of the log, and goodness of fit of the model.

use super::fit::{Fit, LegSet};
use super::legs::{LostLegs, turn};
use super::residuals::Model;
use super::systematic::{ERROR_COUNT, ErrorMask, SystematicError};
use super::trajectory::median;
use crate::models::OdometryRule;
use serde::{Deserialize, Serialize};

/// Overall judgement of a calibration.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// Every check passed.
    Consistent,
    /// A check failed, so the α's may be wrong. The recommended α's compensate for a part of the error of the α's.
    Questionable,
    /// The log gives no α's.
    #[default]
    Unusable,
}

/// Names of the checks that judge a calibration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum CheckName {
    /// Mismatch of reference and odometry: difference from 1 of the median ratio of their turns, or of their driven distances. If the
    /// reference is a copy of the odometry, the value is the square root of the largest lower end of the α's 95 % intervals.
    ReferenceMatches,
    /// Number of legs.
    EnoughLegs,
    /// Fraction of the legs that were left out of the fit.
    LegsLost,
    /// Median length of a leg, divided by the length that the options ask for.
    SamplingDense,
    /// Fraction of outliers.
    OutliersFew,
    /// Fraction of the legs in which the odometry moves sideways. Motion backwards also counts under rules that decompose it into two
    /// turns.
    SidewaysRare,
    /// Difference of the distance scales of straight and turning legs, or of both halves of the log, whichever is larger.
    DistanceScaleConstant,
    /// Difference of the turn scales of both halves of the log.
    TurnScaleConstant,
    /// Inflation: smallest factor on the α's with which they cover 95 % of the windows of 1 m.
    InflationBounded,
    /// Correlation of the innovations of neighbouring legs.
    ResidualsUncorrelated,
    /// Kurtosis of the innovations. The kurtosis of a normal distribution is 3. Smaller values do no harm, and no distribution has less
    /// than 1.
    TailsNormal,
    /// Fraction of the legs whose error is inside of the 95 % region that the fit to the other half of the log predicts.
    HoldoutCovered,
    /// Fraction of the windows of 1 m whose error is inside of the 95 % ellipsoid that the fit to the other half of the log predicts.
    #[serde(rename = "window-1m-covered")]
    Window1Covered,
    /// Fraction of the windows of 2 m whose error is inside of the 95 % ellipsoid that the fit to the other half of the log predicts.
    #[serde(rename = "window-2m-covered")]
    Window2Covered,
    /// Fraction of the windows of 5 m whose error is inside of the 95 % ellipsoid that the fit to the other half of the log predicts.
    #[serde(rename = "window-5m-covered")]
    Window5Covered,
}

/// Causes of the failure of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
#[serde(rename_all = "camelCase")]
pub enum FailureCause {
    /// The reference is a copy of the odometry, computed from it, or too noisy.
    Copied,
    /// The turns of the reference and of the odometry have opposite signs.
    Mirrored,
    /// Most lost legs lack a pose of the reference.
    WithoutReference,
    /// Most lost legs cross a break, at which the pose may have jumped.
    AcrossBreaks,
    /// Most lost legs are too long because of a pause of the recording.
    AcrossPauses,
}

/// Check of a log or of a fit, with its outcome.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify), tsify(rename = "CalibrationCheck"))]
pub struct Check {
    /// Name of the check.
    pub name: CheckName,
    /// Value that is compared with the range.
    pub value: f64,
    /// Smallest and largest value with which the check passes.
    pub expected: [f64; 2],
    /// True if the value is in the range.
    pub passed: bool,
    /// Cause of the failure, if the check can determine a cause.
    pub cause: Option<FailureCause>,
    /// Indices of the drives that fail a check of each drive; empty for checks of the whole log.
    pub drives: Vec<usize>,
    /// Meaning of a failure for the α's, and the remedy; empty if the check passed.
    pub message: String,
}

impl Check {
    /// Returns the check of a value. The check passes if the value is in the expected range.
    pub(super) fn new(name: CheckName, value: f64, expected: [f64; 2]) -> Self {
        let passed = (expected[0]..=expected[1]).contains(&value);
        let message = if passed { "" } else { name.failure_message() };
        Self { name, value, expected, passed, cause: None, drives: Vec::new(), message: message.to_owned() }
    }

    /// Returns the check with the cause of its failure, and the message of that cause. A check that passed stays as it is.
    pub(super) fn with_cause(self, cause: FailureCause) -> Self {
        if self.passed {
            return self;
        }
        Self { cause: Some(cause), message: cause.message().to_owned(), ..self }
    }
}

/// Coverage of windows of one length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
pub struct WindowCoverage {
    /// Mean distance driven in a window, m. A window ends with the leg that completes 1, 2 or 5 m.
    pub length: f64,
    /// Number of windows of this length.
    pub count: usize,
    /// Fraction of the windows whose error is inside the 95 % ellipsoid.
    pub coverage: f64,
    /// Mean squared Mahalanobis distance over its 3 degrees of freedom (NEES); 1 if the α's hold.
    pub nees: f64,
}

/// Checks, and the verdict that follows from the checks.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
pub struct Diagnostics {
    /// Judgement of the whole calibration.
    pub verdict: Verdict,
    /// All checks: first those of the log, then those of the fit.
    #[cfg_attr(target_arch = "wasm32", tsify(type = "CalibrationCheck[]"))]
    pub checks: Vec<Check>,
    /// Coverage of windows of 1, 2 and 5 m by the fitted α's.
    pub windows: Vec<WindowCoverage>,
}

impl Diagnostics {
    /// Returns the diagnostics of a log that could not be fitted.
    pub(super) fn too_few_legs() -> Self {
        let legs = Check::new(CheckName::EnoughLegs, 0.0, [SUFFICIENT_LEGS, f64::INFINITY]);
        Self { checks: vec![legs], ..Self::default() }
    }
}

impl CheckName {
    /// Returns what a failure of the check means for the α's, and the remedy.
    fn failure_message(self) -> &'static str {
        match self {
            Self::ReferenceMatches => {
                "The reference does not follow the odometry: it may be of another drive, have other units (degrees, feet, millimetres), a mirrored y axis or another vertical axis than z, or its columns may be swapped. The α's mean nothing. Compare both files of each drive."
            }
            Self::EnoughLegs => {
                "There are few legs, so the intervals are wide and the other checks weak. Record a longer drive: a quarter of an hour of straight drives, arcs and turns on the spot."
            }
            Self::LegsLost => "Many legs were lost. The α's describe the remaining legs.",
            Self::SamplingDense => {
                "Rows are too sparse for legs of this length: legs are longer than requested, and the α's are valid for that length. Record at a higher rate, or choose longer legs."
            }
            Self::OutliersFew => {
                "Many legs are outliers. The α's describe the remaining legs, and are too small if the outliers are wheel slip. Look at the outliers: jumps of the reference, or slip?"
            }
            Self::SidewaysRare => {
                "The odometry moves sideways, or backwards under Table 5.6: its positions are noisy, its frame is off the axle, it is swapped with the reference, or the robot reverses. α₁ and α₄ are too small. Use odometry of the axle, or the rule of Nav2."
            }
            Self::DistanceScaleConstant => {
                "The odometry's distance scale is not constant, so it was corrected only if requested. Check wheel diameters, load and slip in turns; calibrate the wheels, then the noise."
            }
            Self::TurnScaleConstant => {
                "The odometry's turn scale is not constant, so it was corrected only if requested. Check the track width and slip on this floor, and try longer legs: noise hides small turns."
            }
            Self::InflationBounded => {
                "No inflation up to 30 covers the errors over 1 m: they are not noise of the wheels. Find their cause first: kept outliers, a reference that jumps or drifts, or slip."
            }
            Self::ResidualsUncorrelated => {
                "Errors of neighbouring legs are correlated: they persist, a systematic error is left, or the reference is below 30 Hz. Over longer distances the fitted α's are too small if errors persist, too large if they cancel. Recommended α's hold over 1 m."
            }
            Self::TailsNormal => {
                "A few errors are much larger than a normal distribution predicts. Intervals of the predicted pose are too narrow in the tails. Look at the largest residuals. Recommended α's allow for these errors."
            }
            Self::HoldoutCovered => {
                "The α's of one half of the log do not fit the other: floor, load or speed changed, or the reference drifts. Calibrate for each condition, with a reference that does not drift."
            }
            Self::Window1Covered | Self::Window2Covered | Self::Window5Covered => {
                "Over windows of this length the fitted α's do not predict the error: it grows differently, as with unequal wheels, a heading error that grows along a leg, or a reference that drifts. Recommended α's hold over 1 m: use them if the filter corrects its pose that often."
            }
        }
    }
}

impl FailureCause {
    /// Returns what a failure of this cause means for the α's, and the remedy.
    fn message(self) -> &'static str {
        match self {
            Self::Copied => {
                "No error of the odometry is visible: the reference is a copy of it, computed from it, or too noisy. The α's mean nothing. Use a precise and independent measurement, such as motion capture or SLAM."
            }
            Self::Mirrored => {
                "The reference turns left where the odometry turns right: one of the two has Z down or a mirrored axis. The α's mean nothing. Negate y and the heading of either: the logs cannot show which one is wrong, and the α's are the same."
            }
            Self::WithoutReference => {
                "Many legs were lost. The α's describe the remaining legs. Most lack the reference: record it for the whole drive."
            }
            Self::AcrossBreaks => {
                "Many legs were lost. The α's describe the remaining legs. Most cross a break: look at the jumps and at the rows left out."
            }
            Self::AcrossPauses => {
                "Many legs were lost. The α's describe the remaining legs. Most are stretched by a pause: record both logs without gaps."
            }
        }
    }
}

/// Number of standard errors by which a sample statistic may differ from its expectation. Logs simulated by the model rarely differ more.
pub(super) const MAX_STD_ERRORS: f64 = 3.0;

/// Number of legs below which the check [`CheckName::EnoughLegs`] fails, and below which the log is unusable.
const SUFFICIENT_LEGS: f64 = 100.0;
const MIN_USABLE_LEGS: f64 = 30.0;

/// Maximum inflation (factor on the fitted α's). α's that need a larger factor do not describe the robot.
pub(super) const MAX_INFLATION: f64 = 30.0;

/// Returns the checks of the log itself. Checks that decide whether a log is usable come first, because the first failure is displayed.
pub(super) fn log_checks(leg_set: &LegSet, lost: &LostLegs, inflation: f64) -> Vec<Check> {
    let leg_count = leg_set.legs.len();
    let mut length_ratios: Vec<f64> =
        leg_set.legs.iter().map(|leg| leg_set.options.legs.ratio(&leg.odometry, leg.duration())).collect();
    let outlier_count = leg_set.outliers.iter().filter(|is| **is).count();
    let lost_count = lost.total() - lost.standing;
    let lost_fraction = lost_count as f64 / (leg_count + lost_count) as f64;
    let legs_lost = Check::new(CheckName::LegsLost, lost_fraction, [0.0, 0.2]).with_cause(lost.main_cause());
    let mut checks = vec![
        Check::new(CheckName::EnoughLegs, leg_count as f64, [SUFFICIENT_LEGS, f64::INFINITY]),
        // The factor on the α's is infinite if no factor makes the predictions cover the errors over windows.
        Check::new(CheckName::InflationBounded, inflation, [1.0, MAX_INFLATION]),
        legs_lost,
        Check::new(CheckName::SamplingDense, median(&mut length_ratios), [0.0, 1.5]),
        Check::new(CheckName::OutliersFew, outlier_count as f64 / leg_count as f64, [0.0, 0.05]),
    ];
    let model = leg_set.options.model;
    if matches!(model, Model::Odometry(rule) if rule != OdometryRule::Omni) {
        let sideways = leg_set.observations.iter().filter(|leg| leg.moves_sideways(model)).count();
        checks.push(Check::new(CheckName::SidewaysRare, sideways as f64 / leg_count as f64, [0.0, 0.02]));
    }
    checks
}

/// Turn (rad) above which a leg counts as turning. All other legs count as straight.
const TURNING_LEG_ANGLE: f64 = 0.05;

/// Minimum number of legs in each of two groups whose scales are compared.
const MIN_GROUP_LEGS: usize = 20;

/// Maximum difference of two scales, in standard errors, that chance explains. Their 95 % intervals then overlap.
const MAX_SCALE_STD_ERRORS: f64 = 2.8;

/// Difference of two scales that is too small to matter.
const NEGLIGIBLE_SCALE_DIFFERENCE: f64 = 0.01;

/// Returns a check of each scale that is identifiable, and the mask of the systematic errors that are constant.
///
/// Only scales are tested. All other errors, and scales that are not identifiable, count as constant. `correlation` is the correlation of
/// neighbouring legs.
pub(super) fn scale_checks(fit: &Fit, correlation: f64) -> (Vec<Check>, ErrorMask) {
    let (mut checks, mut is_constant) = (Vec::new(), [true; ERROR_COUNT]);
    let first_half_count = fit.sample.legs.len() / 2;
    let is_turning = |leg: usize| turn(&fit.sample.observations[leg].expected) > TURNING_LEG_ANGLE;
    let checked_scales = [
        (SystematicError::DistanceScale, CheckName::DistanceScaleConstant),
        (SystematicError::TurnScale, CheckName::TurnScaleConstant),
    ];
    for (scale, name) in checked_scales.into_iter().filter(|(scale, _)| fit.sample.estimated[*scale as usize])
    {
        // Difference of the scales of two groups, and its standard error.
        let compare_groups = |is_in_first_group: &dyn Fn(usize) -> bool| {
            let [a, a_std] = scale_of(fit, scale, correlation, is_in_first_group)?;
            let [b, b_std] = scale_of(fit, scale, correlation, |leg| !is_in_first_group(leg))?;
            Some((a - b, libm::hypot(a_std, b_std)))
        };
        let halves = compare_groups(&|leg| leg < first_half_count);
        let other_comparison = match scale {
            SystematicError::DistanceScale => compare_groups(&is_turning),
            _ => compare_long_turns(fit, correlation),
        };
        let ratio_of = |(difference, tolerance): &(f64, f64)| difference.abs() / tolerance;
        let comparisons = halves.into_iter().chain(other_comparison).map(|(difference, std)| {
            (difference, NEGLIGIBLE_SCALE_DIFFERENCE.max(MAX_SCALE_STD_ERRORS * std))
        });
        let largest_difference = comparisons.max_by(|a, b| ratio_of(a).total_cmp(&ratio_of(b)));
        let (difference, tolerance) = largest_difference.unwrap_or((0.0, NEGLIGIBLE_SCALE_DIFFERENCE));
        let check = Check::new(name, difference, [-tolerance, tolerance]);
        is_constant[scale as usize] = check.passed;
        checks.push(check);
    }
    (checks, is_constant)
}

/// Number of neighbouring legs whose turns are added up.
const RUN_LEGS: usize = 8;

/// Returns the scale of turns of single legs minus that of runs of [`RUN_LEGS`] legs, and the standard error of this difference.
///
/// Noise of the odometry makes the scale of small turns too small (regression dilution). Over a run, turns add up more than their noise.
fn compare_long_turns(Fit { sample, maximum, .. }: &Fit, correlation: f64) -> Option<(f64, f64)> {
    let is_inlier = |leg: usize| !sample.outliers[leg];
    let inliers: Vec<usize> = (0..sample.legs.len()).filter(|leg| is_inlier(*leg)).collect();
    let sections = inliers.chunk_by(|_, next| sample.follows(*next, is_inlier));
    // Turns by the corrected odometry and by the reference.
    let turns_of_run = |run: &[usize]| {
        let observations_of_run = || run.iter().map(|leg| &sample.observations[*leg]);
        let expected_turn: f64 = observations_of_run().map(|leg| leg.expected.theta()).sum();
        [expected_turn, observations_of_run().map(|leg| leg.measured.theta()).sum()]
    };
    let runs: Vec<[f64; 2]> =
        sections.flat_map(|section| section.chunks_exact(RUN_LEGS)).map(turns_of_run).collect();
    if runs.len() < MIN_GROUP_LEGS {
        return None;
    }
    let square_sum: f64 = runs.iter().map(|[read, _]| read * read).sum();
    let slope = runs.iter().map(|[read, measured]| read * measured).sum::<f64>() / square_sum;
    let score_squares = runs.iter().map(|[read, measured]| (read * (measured - slope * read)).powi(2));
    let slope_std = score_squares.sum::<f64>().sqrt() / square_sum;
    let scale_index = SystematicError::TurnScale as usize;
    let mean_scale_std = maximum.filtered.error_stds(correlation)[scale_index];
    let turn_scale = sample.systematic.turn_scale;
    Some((turn_scale * (1.0 - slope), libm::hypot(mean_scale_std, turn_scale * slope_std)))
}

/// Returns the scale of the selected legs minus that of all legs, and the standard error of this difference. Other systematic errors are
/// not estimated again. None if the legs do not identify the scale.
fn scale_of(
    fit: &Fit,
    scale: SystematicError,
    correlation: f64,
    select: impl Fn(usize) -> bool,
) -> Option<[f64; 2]> {
    let mut mask = [false; ERROR_COUNT];
    mask[scale as usize] = true;
    let residuals = fit.sample.residuals(mask, |leg| select(leg) && !fit.sample.outliers[leg]);
    if residuals.observations.len() < MIN_GROUP_LEGS {
        return None;
    }
    let filtered = residuals.filtered(&fit.maximum.parameters);
    let std = filtered.error_stds(correlation)[scale as usize];
    let difference = -filtered.errors[scale as usize];
    (std > 0.0 && std < scale.identifiability_limit()).then_some([difference, std])
}

/// Returns the verdict that follows from all checks. `identifies` is true if the log identifies at least one α.
pub(super) fn verdict(checks: &[Check], identifies: bool) -> Verdict {
    let has_failed = |name: CheckName| checks.iter().any(|check| check.name == name && !check.passed);
    let leg_count =
        checks.iter().find(|check| check.name == CheckName::EnoughLegs).map_or(0.0, |check| check.value);
    let is_covered = !has_failed(CheckName::InflationBounded);
    if has_failed(CheckName::ReferenceMatches) || leg_count < MIN_USABLE_LEGS || !identifies || !is_covered {
        Verdict::Unusable
    } else if checks.iter().all(|check| check.passed) {
        Verdict::Consistent
    } else {
        Verdict::Questionable
    }
}
