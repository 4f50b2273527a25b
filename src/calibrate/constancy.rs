//! Constancy of the odometry's scales: on straight and on turning legs, and in both halves of the log.

use super::checks::{Check, CheckName, scale_check};
use super::fit::Fit;
use super::systematic::{ERRORS, ErrorMask, SystematicError};

/// Turn (rad) above which a leg counts as turning.
const TURNS: f64 = 0.05;

/// Legs of a group at least.
const MIN_GROUP: usize = 20;

/// Standard errors of a difference that chance explains: the intervals of both groups overlap.
const MAX_STD_ERRORS: f64 = 2.8;

/// Difference that is too small to matter.
const NEGLIGIBLE: f64 = 0.01;

/// Returns a check of each scale that is identifiable, and which systematic errors are constant.
///
/// Only scales are tested: all others, and scales that are not identifiable, count as constant. `repeated` multiplies standard errors
/// where errors persist; it is 1 otherwise.
pub(super) fn scale_checks(fit: &Fit, repeated: f64) -> (Vec<Check>, ErrorMask) {
    let (mut checks, mut is_constant) = (Vec::new(), [true; ERRORS]);
    let half = fit.sample.legs.len() / 2;
    let is_turning = |leg: usize| fit.sample.observations[leg].expected.theta().abs() > TURNS;
    let scales = [
        (SystematicError::DistanceScale, CheckName::DistanceScaleConstant),
        (SystematicError::TurnScale, CheckName::TurnScaleConstant),
    ];
    for (scale, name) in scales {
        if fit.stds[scale as usize] == 0.0 {
            continue;
        }
        let mut worst = (0.0, NEGLIGIBLE);
        let mut compare = |in_first: &dyn Fn(usize) -> bool| {
            let [first, second] =
                [true, false].map(|which| scale_of(fit, scale, |leg| in_first(leg) == which));
            if let Some(([a, a_std], [b, b_std])) = first.zip(second) {
                let tolerance = NEGLIGIBLE.max(MAX_STD_ERRORS * repeated * libm::hypot(a_std, b_std));
                if (a - b).abs() / tolerance > f64::abs(worst.0) / worst.1 {
                    worst = (a - b, tolerance);
                }
            }
        };
        compare(&|leg| leg < half);
        if scale == SystematicError::DistanceScale {
            compare(&is_turning);
        }
        let check = scale_check(name, worst.0, worst.1);
        is_constant[scale as usize] = check.passed;
        checks.push(check);
    }
    (checks, is_constant)
}

/// Scale of some legs, relative to that of all, and its standard error; the other errors stay as they are. None where the legs do not
/// identify it.
fn scale_of(fit: &Fit, scale: SystematicError, select: impl Fn(usize) -> bool) -> Option<[f64; 2]> {
    let mut mask = [false; ERRORS];
    mask[scale as usize] = true;
    let residuals = fit.sample.residuals(mask, |leg| select(leg) && !fit.sample.outliers[leg]);
    if residuals.len() < MIN_GROUP {
        return None;
    }
    let squares = residuals.least_squares(&fit.maximum.parameters);
    let variance = squares.covariance[(scale as usize, scale as usize)];
    let std = variance.sqrt();
    (variance > 0.0 && std < scale.identifiability_limit()).then(|| [-squares.errors[scale as usize], std])
}
