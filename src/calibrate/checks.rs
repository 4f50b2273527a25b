//! Checks of a fit: validity of the log, and goodness of fit of the model.

use super::legs::{LostLegs, MIN_DRIVE_DISTANCE, MIN_LEGS, MIN_TURN_ANGLE, distance, distance_along, turn};
use super::optimizer::{Fit, LegSet};
use super::residuals::{ERROR_COUNT, ErrorMask, Model, Systematic, SystematicError};
use super::trajectory::median;
use crate::models::OdometryRule;
use serde::{Deserialize, Serialize};
use thiserror::Error;

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

/// Names of the checks that judge a calibration. Messages say what a failure of the check means for the α's, and the remedy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Error)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
pub enum CheckName {
    /// Mismatch of reference and odometry: difference from 1 of the median ratio of their turns, or of their driven distances. If the
    /// reference is a copy of the odometry, the value is the square root of the largest lower end of the α's 95 % intervals.
    #[error(
        "The reference does not follow the odometry: it may be of another drive, have other units (degrees, feet, millimetres), a mirrored y axis or another vertical axis than z, or its columns may be swapped. The α's mean nothing. Compare both files of each drive."
    )]
    ReferenceMatches,
    /// Number of legs.
    #[error(
        "There are few legs, so the intervals are wide and the other checks weak. Record a longer drive: a quarter of an hour of straight drives, arcs and turns on the spot."
    )]
    EnoughLegs,
    /// Fraction of the legs that were left out of the fit.
    #[error("Many legs were lost. The α's describe the remaining legs.")]
    LegsLost,
    /// Median length of a leg, divided by the length that the options ask for.
    #[error(
        "Rows are too sparse for legs of this length: legs are longer than requested, and the α's are valid for that length. Record at a higher rate, or choose longer legs."
    )]
    SamplingDense,
    /// Fraction of outliers.
    #[error(
        "Many legs are outliers. The α's describe the remaining legs, and are too small if the outliers are wheel slip. Look at the outliers: jumps of the reference, or slip?"
    )]
    OutliersFew,
    /// Fraction of the legs in which the odometry moves sideways. Motion backwards also counts under rules that decompose it into two
    /// turns.
    #[error(
        "The odometry moves sideways: its positions are noisy (under Table 5.6 this counts in turns on the spot too), its frame is off the axle, it is swapped with the reference, or the robot reverses (counts only under Table 5.6). α₁ and α₄ are too small. Use the rule of Nav2, or odometry of the axle."
    )]
    SidewaysRare,
    /// Difference of the distance scales of straight and turning legs, or of both halves of the log, whichever is larger.
    #[error(
        "The odometry's distance scale is not constant, so it was corrected only if requested. Check wheel diameters, load and slip in turns; calibrate the wheels, then the noise."
    )]
    DistanceScaleConstant,
    /// Difference of the turn scales of single legs and windows of 2 m, or of both halves of the log, whichever is larger.
    #[error(
        "The odometry's turn scale is not constant, so it was corrected only if requested. Check the track width and slip on this floor, and try longer legs: noise hides small turns."
    )]
    TurnScaleConstant,
    /// Inflation: smallest factor on the α's with which they cover 95 % of the windows of 1 m.
    #[error(
        "No inflation up to 30 covers the errors over 1 m: they are not noise of the wheels. Find their cause first: kept outliers, a reference that jumps or drifts, or slip."
    )]
    InflationBounded,
    /// Correlation of the innovations of neighbouring legs.
    #[error(
        "Errors of neighbouring legs are correlated: they persist, a systematic error is left, or the reference is below 30 Hz. Over longer distances the fitted α's are too small if errors persist, too large if they cancel. Recommended α's hold over 1 m."
    )]
    ResidualsUncorrelated,
    /// Kurtosis of the innovations. The kurtosis of a normal distribution is 3. Smaller values do no harm, and no distribution has less
    /// than 1.
    #[error(
        "A few errors are much larger than a normal distribution predicts. Intervals of the predicted pose are too narrow in the tails. Look at the largest residuals. Recommended α's allow for these errors."
    )]
    TailsNormal,
    /// Fraction of the legs whose error is inside of the 95 % region that the fit to the other half of the log predicts.
    #[error(
        "The α's of one half of the log do not fit the other: floor, load or speed changed, or the reference drifts. Calibrate for each condition, with a reference that does not drift."
    )]
    HoldoutCovered,
    /// Fraction of the windows of 1 m whose error is inside of the 95 % ellipsoid that the fit to the other half of the log predicts.
    #[error("{WINDOW_MESSAGE}")]
    #[serde(rename = "window-1m-covered")]
    Window1Covered,
    /// Fraction of the windows of 2 m whose error is inside of the 95 % ellipsoid that the fit to the other half of the log predicts.
    #[error("{WINDOW_MESSAGE}")]
    #[serde(rename = "window-2m-covered")]
    Window2Covered,
    /// Fraction of the windows of 5 m whose error is inside of the 95 % ellipsoid that the fit to the other half of the log predicts.
    #[error("{WINDOW_MESSAGE}")]
    #[serde(rename = "window-5m-covered")]
    Window5Covered,
}

/// Message of the checks of windows.
const WINDOW_MESSAGE: &str = "Over windows of this length the fitted α's do not predict the error: it grows differently, as with unequal wheels, a heading error that grows along a leg, or a reference that drifts. Recommended α's hold over 1 m: use them if the filter corrects its pose that often.";

/// Causes of the failure of a check. The message of a cause is more specific than that of the check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Error)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
#[serde(rename_all = "camelCase")]
pub enum FailureCause {
    /// The reference is a copy of the odometry, computed from it, or too noisy.
    #[error(
        "No error of the odometry is visible: the reference is a copy of it, computed from it, or too noisy. The α's mean nothing. Use a precise and independent measurement, such as motion capture or SLAM."
    )]
    Copied,
    /// The turns of the reference and of the odometry have opposite signs.
    #[error(
        "The reference turns left where the odometry turns right: one of the two has Z down or a mirrored axis. The α's mean nothing. Negate y and the heading of either: the logs cannot show which one is wrong, and the α's are the same."
    )]
    Mirrored,
    /// Most lost legs lack a pose of the reference.
    #[error(
        "Many legs were lost. The α's describe the remaining legs. Most lack the reference: it ends early, has gaps, or stands still. Record it for the whole drive."
    )]
    WithoutReference,
    /// Most lost legs cross a break, at which the pose may have jumped.
    #[error(
        "Many legs were lost. The α's describe the remaining legs. Most cross a break: look at the jumps and at the rows left out."
    )]
    AcrossBreaks,
    /// Most lost legs are too long because of a pause of the recording.
    #[error(
        "Many legs were lost. The α's describe the remaining legs. Most are stretched by a pause: record both logs without gaps."
    )]
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
        let message = if passed { String::new() } else { name.to_string() };
        Self { name, value, expected, passed, cause: None, drives: Vec::new(), message }
    }

    /// Returns the check with the cause of its failure, and the message of that cause. A check that passed stays as it is.
    pub(super) fn with_cause(self, cause: FailureCause) -> Self {
        if self.passed { self } else { Self { cause: Some(cause), message: cause.to_string(), ..self } }
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

/// Number of standard errors by which a sample statistic may differ from its expectation. Logs simulated by the model rarely differ more.
pub(super) const MAX_STD_ERRORS: f64 = 3.0;

/// Number of legs below which the check [`CheckName::EnoughLegs`] fails, and below which the log is unusable.
pub(super) const SUFFICIENT_LEGS: f64 = 100.0;
const MIN_USABLE_LEGS: f64 = 30.0;

/// Maximum inflation (factor on the fitted α's). α's that need a larger factor do not describe the robot.
pub(super) const MAX_INFLATION: f64 = 30.0;

/// Returns the checks of the log itself. Checks that decide whether a log is usable come first, because the first failure is displayed.
pub(super) fn log_checks(leg_set: &LegSet, lost: &LostLegs, inflation: f64) -> Vec<Check> {
    let leg_count = leg_set.legs.len();
    let mut length_ratios: Vec<f64> =
        leg_set.legs.iter().map(|leg| leg_set.options.legs.ratio(&leg.odometry, leg.duration())).collect();
    let outlier_count = leg_set.outliers.iter().filter(|is_outlier| **is_outlier).count();
    let lost_count = lost.total() - lost.standing;
    let lost_fraction = lost_count as f64 / (leg_count + lost_count) as f64;
    let mut checks = vec![
        Check::new(CheckName::EnoughLegs, leg_count as f64, [SUFFICIENT_LEGS, f64::INFINITY]),
        // The factor on the α's is infinite if no factor makes the predictions cover the errors over windows.
        Check::new(CheckName::InflationBounded, inflation, [1.0, MAX_INFLATION]),
        Check::new(CheckName::LegsLost, lost_fraction, [0.0, 0.2]).with_cause(lost.main_cause()),
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

/// Minimum number of legs or windows in each of two groups whose scales are compared.
const MIN_GROUP_LEGS: usize = 20;

/// Maximum difference of two scales, in standard errors, that chance explains. Their 95 % intervals then overlap.
const MAX_SCALE_STD_ERRORS: f64 = 2.8;

/// Difference of two scales of the odometry that is too small to matter.
const NEGLIGIBLE_SCALE_DIFFERENCE: f64 = 0.01;

/// Returns a check of each scale that is identifiable, and the mask of the systematic errors that are constant.
///
/// Only scales are tested. All other errors, and scales that are not identifiable, count as constant. `correlation` is the correlation of
/// neighbouring legs.
pub(super) fn scale_checks(fit: &Fit, correlation: f64) -> (Vec<Check>, ErrorMask) {
    let (mut checks, mut is_constant) = (Vec::new(), [true; ERROR_COUNT]);
    let first_half_count = fit.leg_set.legs.len() / 2;
    let is_in_first_half = |leg: usize| leg < first_half_count;
    let is_turning = |leg: usize| turn(&fit.leg_set.observations[leg].expected) > TURNING_LEG_ANGLE;
    let compare_groups = |scale, is_in_first_group: &dyn Fn(usize) -> bool| {
        let [a, a_std] = scale_of(fit, scale, correlation, is_in_first_group)?;
        let [b, b_std] = scale_of(fit, scale, correlation, |leg| !is_in_first_group(leg))?;
        Some([a - b, libm::hypot(a_std, b_std)])
    };
    let [distance_scale, turn_scale] = [SystematicError::DistanceScale, SystematicError::TurnScale];
    let compared_scales = [
        (CheckName::DistanceScaleConstant, distance_scale, compare_groups(distance_scale, &is_turning)),
        (CheckName::TurnScaleConstant, turn_scale, compare_long_turns(fit, correlation)),
    ];
    for (name, scale, difference) in compared_scales {
        if fit.leg_set.estimated[scale as usize] {
            let differences = [difference, compare_groups(scale, &is_in_first_half)].into_iter().flatten();
            let check = largest_of(differences.chain([[0.0; 2]]).map(|[difference, std]| {
                let tolerance = NEGLIGIBLE_SCALE_DIFFERENCE.max(MAX_SCALE_STD_ERRORS * std);
                Check::new(name, difference, [-tolerance, tolerance])
            }));
            is_constant[scale as usize] = check.iter().all(|check| check.passed);
            checks.extend(check);
        }
    }
    (checks, is_constant)
}

/// Returns the scale of turns of single legs minus that of windows of 2 m, and the standard error of this difference.
///
/// Noise of the odometry makes the scale of small turns too small (regression dilution). Over a window, turns add up more than their noise.
fn compare_long_turns(Fit { leg_set, maximum }: &Fit, correlation: f64) -> Option<[f64; 2]> {
    let [_, windows, _] = leg_set.windows(0..leg_set.legs.len(), &maximum.parameters);
    if windows.len() < MIN_GROUP_LEGS {
        return None;
    }
    // Regression of the errors of turns on the turns.
    let square_sum: f64 = windows.iter().map(|window| window.turn * window.turn).sum();
    let slope = windows.iter().map(|window| window.turn * window.error.z).sum::<f64>() / square_sum;
    let scores = windows.iter().map(|window| window.turn * (window.error.z - slope * window.turn));
    let slope_std = scores.map(|score| score * score).sum::<f64>().sqrt() / square_sum;
    let mean_scale_std = maximum.filter_result.error_stds(correlation)[SystematicError::TurnScale as usize];
    let turn_scale = leg_set.systematic.turn_scale;
    Some([-turn_scale * slope, libm::hypot(mean_scale_std, turn_scale * slope_std)])
}

/// Returns the scale of the selected legs minus that of all legs, and the standard error of this difference. Other systematic errors are
/// not estimated again. None if the legs do not identify the scale.
fn scale_of(
    Fit { leg_set, maximum }: &Fit,
    scale: SystematicError,
    correlation: f64,
    is_selected: impl Fn(usize) -> bool,
) -> Option<[f64; 2]> {
    let mut residuals = leg_set.residuals();
    residuals.estimated = std::array::from_fn(|error| error == scale as usize);
    (0..).zip(&mut residuals.is_fitted).for_each(|(leg, is_fitted)| *is_fitted &= is_selected(leg));
    if residuals.is_fitted.iter().filter(|is_fitted| **is_fitted).count() < MIN_GROUP_LEGS {
        return None;
    }
    let filter_result = residuals.filter_result(&maximum.parameters);
    let std = filter_result.error_stds(correlation)[scale as usize];
    (std > 0.0 && std < scale.identifiability_limit()).then_some([-filter_result.errors[scale as usize], std])
}

/// Returns the check whose value is largest in relation to the largest value that passes.
fn largest_of(checks: impl IntoIterator<Item = Check>) -> Option<Check> {
    let relative_value_of = |check: &Check| check.value.abs() / check.expected[1];
    checks.into_iter().max_by(|a, b| relative_value_of(a).total_cmp(&relative_value_of(b)))
}

/// Maximum mismatch of the turns and of the drives of a log. A wrong track width, or slip of skid steering, scales turns by a factor of up
/// to two. Wheels never scale distances as much as a reference in feet (factor 0.305), or a reference whose y is a height (factor 0.5).
const MAX_TURN_MISMATCH: f64 = 0.7;
const MAX_DRIVE_MISMATCH: f64 = 0.4;

/// Maximum fraction of the legs of one drive that may be outliers.
const MAX_OUTLIERS_OF_DRIVE: f64 = 0.5;

/// Tolerance on the median ratio of the turns of a mirrored reference to those of the odometry, which is −1.
const MIRRORED_TOLERANCE: f64 = 0.1;

/// Relative error below which the reference is a copy of the odometry: wheels never measure every motion to a thousandth. A copy may be
/// rounded or have noise of its own, which does not accumulate.
const MIN_RELATIVE_ERROR: f64 = 1e-3;

/// Returns the check that the reference matches the odometry and is no copy of it; None if too few legs turn and too few drive.
pub(super) fn reference_check(
    leg_set: &LegSet,
    systematic: &Systematic,
    alpha_intervals: &[Option<[f64; 2]>],
) -> Option<Check> {
    // In the median over several drives, a short drive could not be recognized.
    let checks = (0..=leg_set.legs.last()?.drive).filter_map(|drive| match_check(leg_set, drive, systematic));
    let checks: Vec<Check> = checks.collect();
    let drives = checks.iter().flat_map(|check| check.drives.clone()).collect();
    let match_check = largest_of(checks).map(|check| Check { drives, ..check });
    // α's are squares of relative errors. If the reference is a copy of the odometry, these errors are nearly 0, and so are all ends of the
    // intervals of the α's. Any other unsuitable reference is recognized by the difference of its motions from the odometry's.
    let max_alpha = alpha_intervals.iter().flatten().map(|[lower_end, _]| *lower_end).reduce(f64::max);
    let copy_error = max_alpha.map(f64::sqrt).filter(|error| *error < MIN_RELATIVE_ERROR);
    match copy_error {
        Some(error) if match_check.iter().all(|check| check.passed) => {
            Some(new_match_check(error, MAX_DRIVE_MISMATCH).with_cause(FailureCause::Copied))
        }
        _ => match_check,
    }
}

/// Returns the check that the reference matches the odometry, from their mismatch or from the relative error of a copy.
fn new_match_check(value: f64, max_mismatch: f64) -> Check {
    Check::new(CheckName::ReferenceMatches, value, [MIN_RELATIVE_ERROR, max_mismatch])
}

/// Returns the check of one drive's mismatch of odometry and reference; None if too few legs turn and too few drive. Turns and drives have
/// one mismatch each, and the one that is larger relative to its maximum counts. If most legs are outliers, the fit to the other drives
/// does not describe this drive.
///
/// The mismatch is the distance from 1 of the median ratio: over the legs, the reference's motion along the odometry's motion is divided by
/// the odometry's motion. Scales are not corrected, because a scale far from 1 is another unit.
fn match_check(leg_set: &LegSet, drive: usize, systematic: &Systematic) -> Option<Check> {
    let legs_of_drive = leg_set.legs.iter().zip(&leg_set.outliers).filter(|(leg, _)| leg.drive == drive);
    let [mut turn_ratios, mut drive_ratios]: [Vec<f64>; 2] = Default::default();
    let (mut leg_count, mut outlier_count) = (0, 0);
    for (leg, is_outlier) in legs_of_drive {
        leg_count += 1;
        outlier_count += usize::from(*is_outlier);
        let (expected, measured) = (leg.odometry[0].motion_to(&leg.odometry[1]), systematic.motion(leg));
        if turn(&expected) > MIN_TURN_ANGLE {
            turn_ratios.push(measured.theta() / expected.theta());
        }
        if distance(&expected) > MIN_DRIVE_DISTANCE {
            drive_ratios.push(distance_along(&measured, &expected) / distance(&expected));
        }
    }
    let [turn_ratio, drive_ratio] = [&mut turn_ratios, &mut drive_ratios]
        .map(|ratios| (ratios.len() >= MIN_LEGS).then(|| median(ratios)));
    // A mismatch below the allowed range would mean that the reference is a copy of the odometry, which is found by other means.
    let mismatch_of = |ratio: f64| (ratio - 1.0).abs().max(MIN_RELATIVE_ERROR);
    let is_mirrored = turn_ratio.is_some_and(|ratio| (ratio + 1.0).abs() < MIRRORED_TOLERANCE);
    let outlier_fraction = Some(outlier_count as f64 / leg_count as f64);
    let mismatches = [
        (turn_ratio.map(mismatch_of), MAX_TURN_MISMATCH),
        // With a mirrored reference, the fitted mount yaw and lever arm are meaningless, and so is the ratio of the drives.
        (drive_ratio.map(mismatch_of).filter(|_| !is_mirrored), MAX_DRIVE_MISMATCH),
        (
            outlier_fraction.filter(|fraction| {
                leg_count >= MIN_LEGS && *fraction > MAX_OUTLIERS_OF_DRIVE && !is_mirrored
            }),
            MAX_OUTLIERS_OF_DRIVE,
        ),
    ];
    let checks = mismatches.into_iter().filter_map(|(mismatch, max)| Some(new_match_check(mismatch?, max)));
    let check = largest_of(checks)?;
    let check = if is_mirrored { check.with_cause(FailureCause::Mirrored) } else { check };
    Some(Check { drives: if check.passed { Vec::new() } else { vec![drive] }, ..check })
}

/// Returns the verdict that follows from all checks. `identifies_any` is true if the log identifies at least one α.
pub(super) fn verdict(checks: &[Check], identifies_any: bool) -> Verdict {
    let is_unusable = |check: &Check| match check.name {
        CheckName::ReferenceMatches | CheckName::InflationBounded => !check.passed,
        CheckName::EnoughLegs => check.value < MIN_USABLE_LEGS,
        _ => false,
    };
    if !identifies_any || checks.iter().any(is_unusable) {
        Verdict::Unusable
    } else if checks.iter().all(|check| check.passed) {
        Verdict::Consistent
    } else {
        Verdict::Questionable
    }
}
