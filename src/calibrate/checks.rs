//! Checks of a fit: validity of the log, and goodness of fit of the model.

use super::fit::Sample;
use super::legs::{LegLength, LostLegs, MIN_LEGS};
use super::residuals::Model;
use super::systematic::{Systematic, SystematicError};
use super::trajectory::median;
use crate::geom::se2::{SE2, wrap_angle};
use crate::models::OdometryRule;
use serde::{Deserialize, Serialize};

/// Overall judgement of a calibration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// Every check passed.
    Consistent,
    /// A check failed: the α's may be off, the recommended ones less so.
    Questionable,
    /// The log does not tell α's.
    Unusable,
}

/// Names of the checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum CheckName {
    /// Median difference of the two motions over the median motion.
    ReferenceMatches,
    /// Number of legs.
    EnoughLegs,
    /// Fraction of the legs that were lost.
    LegsLost,
    /// Median length of a leg over the length that the options ask for.
    SamplingDense,
    /// Fraction of outliers.
    OutliersFew,
    /// Fraction of the legs in which the odometry moves sideways.
    SidewaysRare,
    /// Difference of the distance scales of straight and turning legs, or of both halves: the larger one.
    DistanceScaleConstant,
    /// Difference of the turn scales of both halves.
    TurnScaleConstant,
    /// Inflation under which windows of 1 m are covered.
    InflationBounded,
    /// Correlation of the innovations of neighbouring legs.
    ResidualsUncorrelated,
    /// Kurtosis of the innovations: 3 of normal ones, at least 1 of any, and less than 3 does no harm.
    TailsNormal,
    /// Fraction of the legs of each half inside of the 95 % region by the fit to the other half.
    HoldoutCovered,
    /// As before, of windows of 1, 2 and 5 m.
    Window1Covered,
    Window2Covered,
    Window5Covered,
}

/// One check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Check {
    pub name: CheckName,
    pub value: f64,
    /// Smallest and largest value that passes.
    pub expected: [f64; 2],
    pub passed: bool,
}

impl Check {
    /// Returns the meaning for the α's of a check that failed, and the remedy; nothing where it passed.
    pub fn message(&self) -> &'static str {
        if self.passed { "" } else { self.name.failure() }
    }
}

/// One leg under the fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LegFit {
    /// Standard deviations of the innovation's components.
    pub stds: [f64; 3],
    /// Innovation over its standard deviations.
    pub standardized: [f64; 3],
    /// Squared Mahalanobis distance of the innovation.
    pub squared: f64,
    pub is_outlier: bool,
}

/// Coverage of windows of one length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
pub struct WindowCoverage {
    /// Least distance driven, m.
    pub length: f64,
    pub count: usize,
    /// Fraction of windows inside of the 95 % ellipsoid.
    pub coverage: f64,
    /// Mean squared Mahalanobis distance over its 3 degrees of freedom (NEES); 1 if the α's hold.
    pub nees: f64,
}

/// Checks with the judgement that follows from them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Diagnostics {
    pub verdict: Verdict,
    pub checks: Vec<Check>,
    /// Coverage of windows of 1, 2 and 5 m by the fitted α's.
    pub windows: Vec<WindowCoverage>,
}

impl Diagnostics {
    /// Returns the diagnostics of a log that could not be fitted.
    pub(super) fn too_few_legs() -> Self {
        let legs = check(CheckName::EnoughLegs, 0.0, [ENOUGH_LEGS, f64::INFINITY]);
        Self { verdict: Verdict::Unusable, checks: vec![legs], windows: Vec::new() }
    }
}

impl CheckName {
    /// Name in results, for scripts.
    pub fn key(self) -> &'static str {
        match self {
            Self::ReferenceMatches => "reference-matches",
            Self::EnoughLegs => "enough-legs",
            Self::LegsLost => "legs-lost",
            Self::SamplingDense => "sampling-dense",
            Self::OutliersFew => "outliers-few",
            Self::SidewaysRare => "sideways-rare",
            Self::DistanceScaleConstant => "distance-scale-constant",
            Self::TurnScaleConstant => "turn-scale-constant",
            Self::InflationBounded => "inflation-bounded",
            Self::ResidualsUncorrelated => "residuals-uncorrelated",
            Self::TailsNormal => "tails-normal",
            Self::HoldoutCovered => "holdout-covered",
            Self::Window1Covered => "window-1m-covered",
            Self::Window2Covered => "window-2m-covered",
            Self::Window5Covered => "window-5m-covered",
        }
    }

    /// Returns the meaning of a failure for the α's, and the remedy.
    fn failure(self) -> &'static str {
        match self {
            Self::ReferenceMatches => {
                "The reference does not follow the odometry: it may be of another drive, have other units (degrees, millimetres) or a mirrored y axis, or its columns are swapped. The α's mean nothing. Compare both files row by row."
            }
            Self::EnoughLegs => {
                "There are few legs, so the intervals are wide and the other checks weak. Drive on: a quarter of an hour of straight drives, arcs and turns on the spot."
            }
            Self::LegsLost => {
                "Many legs were lost to gaps, breaks or a standing robot. The α's are those of the rest. Look at the counts by cause, and record without gaps."
            }
            Self::SamplingDense => {
                "Rows are too sparse for legs of this length: legs are longer than asked, and the α's belong to the longer ones. Record more often, or ask for longer legs."
            }
            Self::OutliersFew => {
                "Many legs are outliers. The α's are those of the rest, and too small if the outliers are slip of the wheels. Look at the listed legs: a jump of the reference or slip?"
            }
            Self::SidewaysRare => {
                "The odometry moves sideways: its positions are noisy, or its frame is off the axle. α₁ and α₄ are too small. Use odometry of the axle."
            }
            Self::DistanceScaleConstant => {
                "The odometry's scale of distances is not a constant, so it was not corrected unless asked for. Check wheel diameters, load and slip in turns; calibrate the wheels, then the noise."
            }
            Self::TurnScaleConstant => {
                "The odometry's scale of turns is not a constant, so it was not corrected unless asked for. Check the track width and slip on this floor."
            }
            Self::InflationBounded => {
                "No inflation up to 30 covers the errors over 1 m: they are no noise of the wheels. Find their cause first: outliers that were kept, a reference that jumps, slip."
            }
            Self::ResidualsUncorrelated => {
                "Errors of neighbouring legs are correlated: they persist over several legs, or a systematic error is left in. α's fitted to legs are too small for longer ways. Recommended α's allow for it."
            }
            Self::TailsNormal => {
                "A few errors are much larger than normal noise has them. Intervals of the predicted pose are too narrow in the tails. Look at the largest residuals. Recommended α's allow for it."
            }
            Self::HoldoutCovered => {
                "The α's of one half of the log do not fit the other: floor, load or speed changed. Calibrate for each condition. Recommended α's allow for it."
            }
            Self::Window1Covered | Self::Window2Covered | Self::Window5Covered => {
                "Over windows of this length the fitted α's do not predict the error: it grows otherwise than they say. Recommended α's hold over 1 m: use them if the filter corrects its pose that often."
            }
        }
    }
}

/// Number of standard errors by which a sample statistic may be off. With it, few logs that are simulated by the model fail any check.
const MAX_STD_ERRORS: f64 = 3.0;

/// Correlation of neighbours, and excess kurtosis, that is too small to matter in a long log.
const NEGLIGIBLE_CORRELATION: f64 = 0.1;
const NEGLIGIBLE_KURTOSIS: f64 = 0.5;

/// Difference of the coverage from 95 % that is too small to matter in a long log.
const NEGLIGIBLE_COVERAGE: f64 = 0.015;

/// Number of legs that are enough, and that make a log usable at all.
const ENOUGH_LEGS: f64 = 100.0;
const USABLE_LEGS: f64 = 30.0;

/// Median difference of odometry and reference, relative to the median motion, above which they do not belong together.
const MAX_MISMATCH: f64 = 0.7;

/// Scales that no wheel has: the reference has another unit.
const SCALES: std::ops::RangeInclusive<f64> = 0.5..=2.0;

/// Motion (m, rad) below which a leg is not compared with the reference.
const DRIVES: f64 = 0.05;
const TURNS: f64 = 0.1;

/// Sine of the angle between the drive of a leg and its heading halfway, above which it moves sideways. An arc has 0.
const SIDEWAYS: f64 = 0.5;

/// Number of windows below which nothing is concluded from them.
pub(super) const MIN_WINDOWS: usize = 20;

/// Largest inflation: α's that need more do not describe the robot.
pub(super) const MAX_INFLATION: f64 = 30.0;

fn check(name: CheckName, value: f64, expected: [f64; 2]) -> Check {
    Check { name, value, expected, passed: value >= expected[0] && value <= expected[1] }
}

/// Returns the check of a scale: its largest difference between groups of legs, which may be `tolerance`.
pub(super) fn scale_check(name: CheckName, difference: f64, tolerance: f64) -> Check {
    check(name, difference, [-tolerance, tolerance])
}

/// Checks of the log itself: of the reference, of the number of legs, of rows and outliers.
pub(super) fn log_checks(
    sample: &Sample,
    lost: &LostLegs,
    length: LegLength,
    systematic: &Systematic,
) -> Vec<Check> {
    let count = sample.legs.len();
    let scales = [SystematicError::DistanceScale, SystematicError::TurnScale];
    let in_units = scales.iter().all(|scale| SCALES.contains(&systematic.get(*scale)));
    let mismatch = if in_units { mismatch(sample, systematic) } else { f64::INFINITY };
    let mut ratios: Vec<f64> =
        sample.legs.iter().map(|leg| length.ratio(&leg.odometry, leg.duration())).collect();
    let outliers = sample.outliers.iter().filter(|is| **is).count();
    let lost = lost.total() - lost.standing;
    let mut checks = vec![
        check(CheckName::ReferenceMatches, mismatch, [0.0, MAX_MISMATCH]),
        check(CheckName::EnoughLegs, count as f64, [ENOUGH_LEGS, f64::INFINITY]),
        check(CheckName::LegsLost, lost as f64 / (count + lost) as f64, [0.0, 0.2]),
        check(CheckName::SamplingDense, median(&mut ratios), [0.0, 1.5]),
        check(CheckName::OutliersFew, outliers as f64 / count as f64, [0.0, 0.05]),
    ];
    if matches!(sample.options.model, Model::Odometry(rule) if rule != OdometryRule::Omni) {
        let sideways = sample.observations.iter().filter(|leg| moves_sideways(leg.reading)).count();
        checks.push(check(CheckName::SidewaysRare, sideways as f64 / count as f64, [0.0, 0.02]));
    }
    checks
}

/// Tells whether a reading is a drive to the side of its heading. Its first rotation is large then, and in a turn on the spot it is that of
/// noise. A reading without a first rotation has no direction.
fn moves_sideways([rot1, _, rot2]: [f64; 3]) -> bool {
    rot1 != 0.0 && libm::sin(rot1 - 0.5 * wrap_angle(rot1 + rot2)).abs() > SIDEWAYS
}

/// Median difference of the two motions over the median motion: of turns, or of drives, whichever is larger.
fn mismatch(sample: &Sample, systematic: &Systematic) -> f64 {
    let ratio = |least: f64, size: fn(&SE2) -> f64, between: fn(&SE2, &SE2) -> f64| {
        let (mut sizes, mut differences) = (Vec::new(), Vec::new());
        for leg in &sample.legs {
            let expected = systematic.expected(sample.options.model, leg);
            if size(&expected) > least {
                sizes.push(size(&expected));
                differences.push(between(&systematic.motion(leg), &expected));
            }
        }
        if sizes.len() < MIN_LEGS { 0.0 } else { median(&mut differences) / median(&mut sizes) }
    };
    let turns = ratio(TURNS, |motion| motion.theta().abs(), |one, other| (one.theta() - other.theta()).abs());
    let drives = ratio(
        DRIVES,
        |motion| libm::hypot(motion.x(), motion.y()),
        |one, other| libm::hypot(one.x() - other.x(), one.y() - other.y()),
    );
    turns.max(drives)
}

/// Checks of the innovations: correlation of neighbours and tails.
pub(super) fn residual_checks(sample: &Sample, fits: &[LegFit], correlation: f64) -> Vec<Check> {
    let kept: Vec<f64> = fits
        .iter()
        .zip(&sample.observations)
        .filter(|(fit, _)| !fit.is_outlier)
        .flat_map(|(fit, observation)| {
            (0..3)
                .filter(|k| !observation.residuals[*k].is_nan())
                .map(|k| fit.standardized[k])
                .collect::<Vec<_>>()
        })
        .collect();
    let count = kept.len() as f64;
    let moment = |power: i32| kept.iter().map(|each| each.powi(power)).sum::<f64>() / count;
    let kurtosis = moment(4) / moment(2).powi(2);
    let limit = NEGLIGIBLE_CORRELATION.max(MAX_STD_ERRORS / count.sqrt());
    // Kurtosis of a normal sample has variance 24/n.
    let tails = NEGLIGIBLE_KURTOSIS.max(MAX_STD_ERRORS * (24.0 / count).sqrt());
    vec![
        check(CheckName::ResidualsUncorrelated, correlation, [-limit, limit]),
        check(CheckName::TailsNormal, kurtosis, [1.0, 3.0 + tails]),
    ]
}

/// Returns the check of coverage by the fit to the other half. `scale_std` is the mean relative standard error of a half's variances.
pub(super) fn holdout_check(coverage: f64, count: usize, scale_std: f64) -> Check {
    check(CheckName::HoldoutCovered, coverage, coverage_range(count, scale_std))
}

/// Returns the range of coverage on logs that are simulated by the model. A relative error of the variances moves it by 0.14 times as
/// much: that is the density of ln χ² with 3 degrees of freedom at its quantile 0.95.
fn coverage_range(count: usize, scale_std: f64) -> [f64; 2] {
    let binomial = 0.95 * 0.05 / count as f64;
    let off = NEGLIGIBLE_COVERAGE.max(MAX_STD_ERRORS * (binomial + (0.14 * scale_std).powi(2)).sqrt());
    [0.95 - off, (0.95 + off).min(1.0)]
}

/// Checks of windows, of those lengths of which there are enough.
pub(super) fn window_checks(windows: &[WindowCoverage], scale_std: f64) -> Vec<Check> {
    let names = [CheckName::Window1Covered, CheckName::Window2Covered, CheckName::Window5Covered];
    let enough = windows.iter().zip(names).filter(|(window, _)| window.count >= MIN_WINDOWS);
    let of = |(window, name): (&WindowCoverage, CheckName)| {
        check(name, window.coverage, coverage_range(window.count, scale_std))
    };
    enough.map(of).collect()
}

/// Check of the inflation that windows of 1 m need; ∞ where none is enough.
pub(super) fn inflation_check(inflation: f64) -> Check {
    check(CheckName::InflationBounded, inflation, [1.0, MAX_INFLATION])
}

/// Judges by all checks, and by whether the log identifies any α.
pub(super) fn verdict(checks: &[Check], identifies: bool) -> Verdict {
    let failed = |name: CheckName| checks.iter().any(|check| check.name == name && !check.passed);
    let legs =
        checks.iter().find(|check| check.name == CheckName::EnoughLegs).map_or(0.0, |check| check.value);
    let is_covered = !failed(CheckName::InflationBounded);
    if failed(CheckName::ReferenceMatches) || legs < USABLE_LEGS || !identifies || !is_covered {
        Verdict::Unusable
    } else if checks.iter().all(|check| check.passed) {
        Verdict::Consistent
    } else {
        Verdict::Questionable
    }
}
