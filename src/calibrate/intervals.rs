//! 95 % intervals of variances by the profile likelihood, and reasons for which a log does not identify an α.

use super::legs::{MIN_DRIVE_DISTANCE, MIN_TURN_ANGLE, distance, turn};
use super::likelihood::{PARAMETER_COUNT, Parameters, legs_per_score_block};
use super::optimizer::Fit;
use super::optimizer::feasible_parameters;
use super::residuals::Observation;
use serde::{Deserialize, Serialize};

/// Quantile 0.975 of the standard normal distribution.
pub(super) const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Maximum number of steps of the search for an end of an interval. The square root of the deviance is nearly linear, so that few steps are
/// needed.
const MAX_SEARCH_STEPS: usize = 12;

/// Relative tolerance on the distance from the estimate to an end of its interval.
const DISTANCE_TOLERANCE: f64 = 0.02;

/// Returns the function that computes the 95 % interval of a parameter. The interval of a parameter without information is [0, ∞].
///
/// At an end of the interval, twice the log-likelihood is t² below its maximum, with t the quantile of Student's t. The other parameters
/// maximize the likelihood's expansion, with variances of 0 or more. Neighbouring legs may be correlated. The distance from the maximum to
/// the end is therefore multiplied by √(S/C) if this is above 1, with C the inverse information and S the sandwich covariance over blocks
/// of legs. If the errors of neighbouring legs have the correlation ρ, their squares have the correlation ρ², and the factor is at least
/// √((1 + ρ²)/(1 − ρ²)).
pub(super) fn intervals(Fit { leg_set, maximum }: &Fit, correlation: f64) -> impl Fn(usize) -> [f64; 2] {
    let residuals = leg_set.residuals();
    let threshold = student_95(maximum.scores.len().saturating_sub(PARAMETER_COUNT));
    let score_blocks = maximum.scores.chunks(legs_per_score_block(maximum.scores.len()));
    // At the maximum the mean score is 0, except for a variance that is 0.
    let mean_score = maximum.score / score_blocks.len() as f64;
    let block_scores: Vec<Parameters> =
        score_blocks.map(|score_block| score_block.iter().sum::<Parameters>() - mean_score).collect();
    let student_quantile = student_95(block_scores.len().saturating_sub(1));
    let squared_correlation = correlation * correlation;
    let min_widening = ((1.0 + squared_correlation) / (1.0 - squared_correlation)).sqrt();
    move |parameter| {
        let estimate = maximum.parameters[parameter];
        if !residuals.free[parameter] {
            return [estimate; 2];
        }
        let covariances = maximum.covariance.column(parameter);
        let variance = covariances[parameter];
        if variance <= 0.0 {
            return [0.0, f64::INFINITY];
        }
        let mut free_others = residuals.free;
        free_others[parameter] = false;
        let deviance_root_at = |distance: f64| {
            let candidate = feasible_parameters(maximum, free_others, Parameters::ith(parameter, distance));
            let log_likelihood = residuals.filter_result(&candidate).log_likelihood;
            (2.0 * (maximum.filter_result.log_likelihood - log_likelihood)).max(0.0).sqrt()
        };
        let guessed_distance = threshold * variance.sqrt();
        let distance_to_end =
            |sign: f64| profile_end(deviance_root_at, sign * guessed_distance, -estimate, threshold);
        let sandwich: f64 = block_scores.iter().map(|score| covariances.dot(score).powi(2)).sum();
        let widening_factor = ((sandwich / variance).sqrt() * student_quantile / NORMAL_95).max(min_widening);
        [-1.0, 1.0].map(|sign| (estimate + widening_factor * distance_to_end(sign)).max(0.0))
    }
}

/// Returns the distance from an estimate at which the square root of the deviance reaches `threshold`. The search starts at `guess`. If the
/// root is below the threshold at `min_distance`, where the parameter is 0, `min_distance` is returned.
fn profile_end(deviance_root_at: impl Fn(f64) -> f64, guess: f64, min_distance: f64, threshold: f64) -> f64 {
    let mut distance = guess.max(min_distance);
    for _ in 0..MAX_SEARCH_STEPS {
        let last_distance = distance;
        distance = (distance * (threshold / deviance_root_at(distance)).clamp(0.25, 4.0)).max(min_distance);
        if (distance - last_distance).abs() <= DISTANCE_TOLERANCE * last_distance.abs() {
            break;
        }
    }
    distance
}

/// Quantile 0.975 of Student's t, by the expansion of Fisher and Cornish.
fn student_95(degrees_of_freedom: usize) -> f64 {
    let dof = degrees_of_freedom.max(1) as f64;
    let (z, z3) = (NORMAL_95, NORMAL_95.powi(3));
    z + (z3 + z) / (4.0 * dof) + (5.0 * NORMAL_95.powi(5) + 16.0 * z3 + 3.0 * z) / (96.0 * dof * dof)
}

/// Reason for which a log does not identify an α.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
#[serde(rename_all = "kebab-case")]
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

/// Minimum of A/B, where A is the information on an α if all α's are estimated, and B the information if only this α is estimated. Below
/// this minimum, the ratio of turn to distance varies by less than a seventh between legs.
const MIN_FREE_INFORMATION: f64 = 0.02;

/// Minimum number of legs with a motion (drive or turn) that identify an α, if the reference is exact. With 50 legs the standard error of
/// the α is 20 %.
const MIN_MOVING_LEGS: usize = 50;

/// Returns, for each α, the reason why it is not identifiable; None if it is identifiable.
pub(super) fn identifiability(Fit { leg_set, maximum }: &Fit) -> Vec<Option<NotIdentifiable>> {
    let model = leg_set.options.model;
    let reason_for = |alpha: usize| {
        let marginal_information = maximum.information[(alpha, alpha)];
        let variance = maximum.covariance[(alpha, alpha)];
        if marginal_information >= MIN_INFORMATION {
            let min_free_information = MIN_INFORMATION.max(MIN_FREE_INFORMATION * marginal_information);
            let is_free = variance > 0.0 && 1.0 / variance >= min_free_information;
            return (!is_free).then_some(NotIdentifiable::Collinear);
        }
        let uses_turn = model.grows_with_turn(alpha);
        let uses_alpha = |observation: &&Observation| {
            let mut components = model.component_alphas().into_iter().zip(observation.residuals);
            let motion = &observation.expected;
            let has_motion =
                if uses_turn { turn(motion) > MIN_TURN_ANGLE } else { distance(motion) > MIN_DRIVE_DISTANCE };
            has_motion && components.any(|(alphas, residual)| alphas.contains(&alpha) && !residual.is_nan())
        };
        Some(match leg_set.observations.iter().filter(uses_alpha).count() {
            MIN_MOVING_LEGS.. => NotIdentifiable::ReferenceTooNoisy,
            _ if uses_turn => NotIdentifiable::InsufficientRotation,
            _ => NotIdentifiable::InsufficientTranslation,
        })
    };
    (0..model.alpha_count()).map(reason_for).collect()
}
