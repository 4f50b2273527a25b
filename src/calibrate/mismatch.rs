//! Check that the reference matches the odometry: units, axes and drive.

use super::checks::{Check, CheckName, FailureCause};
use super::fit::LegSet;
use super::legs::{MIN_DRIVE_DISTANCE, MIN_LEGS, MIN_TURN_ANGLE, distance, turn};
use super::systematic::Systematic;
use super::trajectory::median;
use std::cmp::Ordering;

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

/// Returns the check that the reference matches the odometry and is no copy of it; `None` if too few legs turn and too few drive.
pub(super) fn check_reference(
    leg_set: &LegSet,
    systematic: &Systematic,
    alpha_intervals: &[Option<[f64; 2]>],
) -> Option<Check> {
    // In the median over several drives, a short drive could not be recognized.
    let check_drive = |drive| Some((drive, check_ratios_of_drive(leg_set, drive, systematic)?));
    let drive_checks: Vec<(usize, Check)> =
        (0..=leg_set.legs.last()?.drive).filter_map(check_drive).collect();
    let failed_drives = drive_checks.iter().filter(|(_, check)| !check.passed);
    let drives = failed_drives.map(|(drive, _)| *drive).collect();
    let worst_check = drive_checks.into_iter().map(|(_, check)| check).max_by(compare_mismatches);
    let ratio_check = worst_check.map(|check| Check { drives, ..check });
    // A reference that is a copy of the odometry is recognized by α's whose intervals start near 0: α's are squares of relative
    // errors. Any other unsuitable reference is recognized by the difference of its motions from the odometry's.
    let max_alpha = alpha_intervals.iter().flatten().map(|[start, _]| *start).reduce(f64::max);
    let copy_error = max_alpha.map(f64::sqrt).filter(|error| *error < MIN_RELATIVE_ERROR);
    let copy_check =
        copy_error.map(|error| new_match_check(error, MAX_DRIVE_MISMATCH).with_cause(FailureCause::Copied));
    ratio_check.filter(|check| copy_check.is_none() || !check.passed).or(copy_check)
}

/// Returns the check that the reference matches the odometry, from their mismatch or from the relative error of a copy.
fn new_match_check(value: f64, max_mismatch: f64) -> Check {
    Check::new(CheckName::ReferenceMatches, value, [MIN_RELATIVE_ERROR, max_mismatch])
}

/// Compares the values of two checks, divided by the largest values that pass.
fn compare_mismatches(a: &Check, b: &Check) -> Ordering {
    (a.value / a.expected[1]).total_cmp(&(b.value / b.expected[1]))
}

/// Returns the check of the mismatch of odometry and reference; `None` if too few legs turn and too few drive. Turns and drives have one
/// mismatch each, and the one that is larger relative to its maximum counts.
///
/// The mismatch is the distance from 1 of the median ratio: over the legs, the reference's motion along the odometry's motion is divided by
/// the odometry's motion. Scales are not corrected, because a scale far from 1 is another unit.
fn check_ratios_of_drive(leg_set: &LegSet, drive: usize, systematic: &Systematic) -> Option<Check> {
    let systematic = Systematic { distance_scale: 1.0, turn_scale: 1.0, ..*systematic };
    let [mut turn_ratios, mut drive_ratios]: [Vec<f64>; 2] = Default::default();
    let (mut leg_count, mut outlier_count) = (0, 0);
    for (leg, is_outlier) in leg_set.legs.iter().zip(&leg_set.outliers).filter(|(leg, _)| leg.drive == drive)
    {
        leg_count += 1;
        outlier_count += usize::from(*is_outlier);
        let (expected, measured) = (systematic.expected(leg_set.options.model, leg), systematic.motion(leg));
        if turn(&expected) > MIN_TURN_ANGLE {
            turn_ratios.push(measured.theta() / expected.theta());
        }
        if distance(&expected) > MIN_DRIVE_DISTANCE {
            let along = measured.x() * expected.x() + measured.y() * expected.y();
            drive_ratios.push(along / distance(&expected).powi(2));
        }
    }
    let median_of = |mut ratios: Vec<f64>| (ratios.len() >= MIN_LEGS).then(|| median(&mut ratios));
    let [turn_ratio, drive_ratio] = [turn_ratios, drive_ratios].map(median_of);
    // Values below the allowed range are reserved for a reference that is a copy of the odometry.
    let mismatch_of = |ratio: f64| (ratio - 1.0).abs().max(MIN_RELATIVE_ERROR);
    let turn_check = turn_ratio.map(|ratio| new_match_check(mismatch_of(ratio), MAX_TURN_MISMATCH));
    // The drives of a mirrored reference differ by chance, because its mount yaw and lever arm are meaningless.
    if turn_ratio.is_some_and(|ratio| (ratio + 1.0).abs() < MIRRORED_TOLERANCE) {
        return turn_check.map(|check| check.with_cause(FailureCause::Mirrored));
    }
    let drive_check = drive_ratio.map(|ratio| new_match_check(mismatch_of(ratio), MAX_DRIVE_MISMATCH));
    // If most legs are outliers, the fit to the other drives does not describe this drive.
    let outlier_fraction = outlier_count as f64 / leg_count as f64;
    let outlier_check = (leg_count >= MIN_LEGS && outlier_fraction > MAX_OUTLIERS_OF_DRIVE)
        .then(|| new_match_check(outlier_fraction, MAX_OUTLIERS_OF_DRIVE));
    [turn_check, drive_check, outlier_check].into_iter().flatten().max_by(compare_mismatches)
}
