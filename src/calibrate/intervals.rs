//! 95 % intervals of variances by the profile likelihood, and reasons for which a log does not identify an α.

use super::fit::Fit;
use super::legs::{MIN_DRIVE_DISTANCE, MIN_TURN_ANGLE, distance, turn};
use super::likelihood::{MAX_ALPHAS, PARAMETER_COUNT, Parameters, Residuals};
use super::optimizer::Maximum;
use super::residuals::Observation;
use serde::{Deserialize, Serialize};

/// Quantile 0.975 of the standard normal distribution.
pub(super) const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Maximum number of steps of the search for an end of an interval. The square root of the deviance is nearly linear, so few are needed.
const MAX_SEARCH_STEPS: usize = 12;

/// Relative tolerance on the square root of the deviance at an end of an interval.
const ROOT_TOLERANCE: f64 = 0.02;

/// Returns the function that computes the 95 % interval of a parameter. The interval of a parameter without information is [0, ∞].
///
/// At an end, twice the log-likelihood is t² below its maximum, with t the quantile of Student's t. The other parameters follow the ridge of the
/// likelihood, which the information matrix I predicts. The distance from the maximum to the end is multiplied by √(S/I⁻¹) if that is above 1,
/// with S the sandwich covariance over blocks of legs. A block has ∛n of the n legs, and more if errors persist. If the errors of neighbouring
/// legs have the correlation ρ, their squares have the correlation ρ². Distances are therefore multiplied by at least √((1 + ρ²)/(1 − ρ²)).
pub(super) fn intervals(
    Fit { residuals, maximum, .. }: &Fit,
    correlation: f64,
) -> impl Fn(usize) -> [f64; 2] {
    let leg_count = residuals.len();
    let threshold = student_95(leg_count.saturating_sub(PARAMETER_COUNT));
    let squared_correlation = correlation * correlation;
    let variance_factor = (1.0 + squared_correlation) / (1.0 - squared_correlation);
    let block_length = ((leg_count as f64).cbrt() * variance_factor).ceil().max(1.0) as usize;
    let block_scores: Vec<Parameters> =
        maximum.expansion.scores.chunks(block_length).map(|block| block.iter().sum()).collect();
    let quantile = student_95(block_scores.len().saturating_sub(1));
    move |parameter| {
        let estimate = maximum.parameters[parameter];
        if !maximum.free[parameter] {
            return [estimate; 2];
        }
        let covariances = maximum.covariances(&maximum.parameters, parameter);
        let variance = covariances[parameter];
        if variance <= 0.0 {
            return [0.0, f64::INFINITY];
        }
        let ridges = ridges(maximum, parameter);
        let guess = threshold / (1.0 / variance).sqrt();
        let end = |sign: f64| profile_end(residuals, maximum, &ridges, parameter, sign * guess, threshold);
        let sandwich: f64 = block_scores.iter().map(|score| covariances.dot(score).powi(2)).sum();
        let widening_factor =
            ((sandwich / variance).sqrt() * quantile / NORMAL_95).max(variance_factor.sqrt());
        [(estimate + widening_factor * end(-1.0)).max(0.0), estimate + widening_factor * end(1.0)]
    }
}

/// Returns the ridges of the likelihood: the predicted change of all parameters when one of them changes by 1. On the first ridge variances of 0
/// stay 0. If an α is 0, there is a second ridge, on which α's of 0 change too.
fn ridges(maximum: &Maximum, parameter: usize) -> Vec<Parameters> {
    let parameters = maximum.parameters;
    let has_zero_alpha = (0..MAX_ALPHAS).any(|alpha| maximum.free[alpha] && parameters[alpha] == 0.0);
    let raised_parameters = has_zero_alpha.then(|| with_positive_alphas(&parameters));
    let ridge = |parameters| {
        let covariances = maximum.covariances(&parameters, parameter);
        let variance = covariances[parameter];
        if variance > 0.0 { covariances / variance } else { Parameters::ith(parameter, 1.0) }
    };
    let mut ridges: Vec<Parameters> =
        [Some(parameters), raised_parameters].into_iter().flatten().map(ridge).collect();
    ridges.dedup();
    ridges
}

/// Returns the parameters with α's of 0 replaced by tiny positive ones, so that they do not count as fixed.
fn with_positive_alphas(parameters: &Parameters) -> Parameters {
    Parameters::from_fn(
        |j, _| if j < MAX_ALPHAS { parameters[j].max(f64::MIN_POSITIVE) } else { parameters[j] },
    )
}

/// Returns the distance from the estimate of a parameter to an end of its interval. The search starts at `guess`, whose sign selects the end. If
/// the deviance stays below its threshold down to a parameter of 0, the interval ends at 0.
fn profile_end(
    residuals: &Residuals,
    maximum: &Maximum,
    ridges: &[Parameters],
    parameter: usize,
    guess: f64,
    threshold: f64,
) -> f64 {
    let estimate = maximum.parameters[parameter];
    let deviance_root = |distance: f64| {
        let log_likelihood_along = |ridge: &Parameters| {
            let parameters = (maximum.parameters + ridge * distance).map(|parameter| parameter.max(0.0));
            residuals.least_squares(&parameters).log_likelihood
        };
        let max_log_likelihood = ridges.iter().map(log_likelihood_along).fold(f64::NEG_INFINITY, f64::max);
        (2.0 * (maximum.expansion.log_likelihood() - max_log_likelihood)).max(0.0).sqrt()
    };
    let mut distance = guess.max(-estimate);
    if distance == 0.0 {
        return distance;
    }
    let (mut inside, mut outside) = (0.0, None::<f64>);
    for _ in 0..MAX_SEARCH_STEPS {
        let root = deviance_root(distance);
        if (root / threshold - 1.0).abs() < ROOT_TOLERANCE || distance == -estimate && root <= threshold {
            break;
        }
        if root < threshold {
            inside = distance;
        } else {
            outside = Some(distance);
        }
        let next_distance = if root > 0.0 { distance * threshold / root } else { 2.0 * distance };
        distance = match outside {
            Some(outside) if (next_distance - inside) * (next_distance - outside) >= 0.0 => {
                0.5 * (inside + outside)
            }
            Some(_) => next_distance,
            None => (4.0 * distance.abs()).min(next_distance.abs()).copysign(distance).max(-estimate),
        };
    }
    distance
}

/// Quantile 0.975 of Student's t, by the expansion of Fisher and Cornish.
fn student_95(degrees_of_freedom: usize) -> f64 {
    let freedom = degrees_of_freedom.max(1) as f64;
    let (z, z3) = (NORMAL_95, NORMAL_95.powi(3));
    z + (z3 + z) / (4.0 * freedom)
        + (5.0 * NORMAL_95.powi(5) + 16.0 * z3 + 3.0 * z) / (96.0 * freedom * freedom)
}

/// Reason for which a log does not identify an α.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum NotIdentifiable {
    /// The robot turned too little. Under the velocity model only turns while driving count, because a turn on the spot shows no turn rate.
    InsufficientRotation,
    /// The robot drove too little.
    InsufficientTranslation,
    /// The error of the reference hides the noise of the wheels.
    ReferenceTooNoisy,
    /// Turn and distance had the same ratio in all legs: noise may be due to this α, or to the other α of the same component.
    Collinear,
}

/// Fisher information below which an α is not identifiable. An information of 4 is a standard error of 0.5, far above any plausible α.
const MIN_INFORMATION: f64 = 4.0;

/// Minimum ratio of the information on an α with and without the other α's being estimated too. Below it, the ratio of turn to distance varies
/// by less than a seventh between legs.
const MIN_FREE_INFORMATION: f64 = 0.02;

/// Minimum number of legs with a motion that identify an α against an exact reference. Its standard error is then 20 %.
const MIN_MOVING_LEGS: usize = 50;

/// Returns, for each α, the reason why it is not identifiable; None if it is identifiable.
pub(super) fn identifiability(Fit { sample, maximum, .. }: &Fit) -> Vec<Option<NotIdentifiable>> {
    let motion_model = sample.options.model;
    let positive_parameters = with_positive_alphas(&maximum.parameters);
    let reason_for = |alpha: usize| {
        let marginal_information = maximum.expansion.information[(alpha, alpha)];
        let variance = maximum.covariances(&positive_parameters, alpha)[alpha];
        let free_information = if variance > 0.0 { 1.0 / variance } else { 0.0 };
        if free_information >= MIN_INFORMATION
            && free_information >= MIN_FREE_INFORMATION * marginal_information
        {
            return None;
        }
        if marginal_information >= MIN_INFORMATION {
            return Some(NotIdentifiable::Collinear);
        }
        let uses_turn = motion_model.grows_with_turn(alpha);
        let uses_alpha = |observation: &&Observation| {
            let is_observed = |k: usize| {
                motion_model.component_alphas()[k].contains(&alpha) && !observation.residuals[k].is_nan()
            };
            let motion = &observation.expected;
            let has_motion =
                if uses_turn { turn(motion) > MIN_TURN_ANGLE } else { distance(motion) > MIN_DRIVE_DISTANCE };
            has_motion && (0..3).any(is_observed)
        };
        Some(match sample.observations.iter().filter(uses_alpha).count() {
            count if count >= MIN_MOVING_LEGS => NotIdentifiable::ReferenceTooNoisy,
            _ if uses_turn => NotIdentifiable::InsufficientRotation,
            _ => NotIdentifiable::InsufficientTranslation,
        })
    };
    (0..motion_model.alphas()).map(reason_for).collect()
}
