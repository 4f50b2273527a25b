//! Maximum of the restricted likelihood over variances of 0 or more.

use super::likelihood::{Expansion, Information, PARAMETER_COUNT, Parameters, Residuals};
use super::matrices::masked_inverse;

/// Mask of the parameters that are fitted. All other parameters are kept fixed.
pub(super) type FreeMask = [bool; PARAMETER_COUNT];

/// Maximum of the likelihood.
#[derive(Clone, Debug)]
pub(super) struct Maximum {
    pub parameters: Parameters,
    pub expansion: Expansion,
    pub free: FreeMask,
    /// Inverse information on the free parameters; 0 for all other parameters, and for those without information.
    pub covariance: Information,
}

/// Minimum gain of log-likelihood (nats). A step with a smaller predicted gain is not tried, and a smaller actual gain ends the search.
const MIN_GAIN: f64 = 1e-5;

const MAX_STEPS: usize = 60;

/// Relative rounding error of a step that makes a variance 0.
const ROUNDING_TOLERANCE: f64 = 1e-9;

/// Maximum number of halvings of a scoring step. A step of the minorize-maximize algorithm then replaces it.
const MAX_HALVINGS: i32 = 4;

/// Returns the maximum, by Fisher scoring with the average information. Negative variances are clamped to 0.
///
/// A step that does not increase the likelihood is replaced by θⱼ √(rᵀP Vⱼ P r / tr(P Vⱼ)), which always increases it (Zhou, Hu, Qiao,
/// Cho and Lange 2019).
pub(super) fn maximize(residuals: &Residuals, start: Parameters, free: &FreeMask) -> Maximum {
    let (mut parameters, mut expansion) = (start, residuals.expansion(residuals.filtered(&start)));
    for _ in 0..MAX_STEPS {
        let step = feasible_step(&parameters, &expansion, free, |covariance, score| covariance * score);
        if 0.5 * expansion.score.dot(&step) < MIN_GAIN {
            break;
        }
        let halvings = (0..=MAX_HALVINGS).map(|halvings| parameters + step * 0.5_f64.powi(halvings));
        let minorized = minorized_parameters(&parameters, &expansion, free);
        let better_parameters = halvings.chain([minorized]).find_map(|candidate| {
            let candidate = candidate.map(|parameter| parameter.max(0.0));
            let filtered = residuals.filtered(&candidate);
            let gain = filtered.log_likelihood - expansion.filtered.log_likelihood;
            (gain > 0.0).then_some((candidate, filtered, gain))
        });
        let Some((candidate, filtered, gain)) = better_parameters else { break };
        (parameters, expansion) = (candidate, residuals.expansion(filtered));
        if gain < MIN_GAIN {
            break;
        }
    }
    let (covariance, _) = masked_inverse(&expansion.information, free);
    Maximum { parameters, expansion, free: *free, covariance }
}

/// Returns a step of the parameters, which `step_of` computes from the inverse information and the score. A variance that would become negative
/// becomes 0, and the steps of the others are computed again for that.
pub(super) fn feasible_step(
    parameters: &Parameters,
    Expansion { score, information, .. }: &Expansion,
    free: &FreeMask,
    step_of: impl Fn(&Information, &Parameters) -> Parameters,
) -> Parameters {
    let (mut active, mut step_to_zero) = (*free, Parameters::zeros());
    loop {
        let remaining_score = score - information * step_to_zero;
        let step = step_of(&masked_inverse(information, &active).0, &remaining_score) + step_to_zero;
        let is_negative =
            |i: &usize| active[*i] && parameters[*i] + step[*i] < -ROUNDING_TOLERANCE * parameters[*i];
        match (0..PARAMETER_COUNT).find(is_negative) {
            Some(i) => (active[i], step_to_zero[i]) = (false, -parameters[i]),
            None => return step,
        }
    }
}

/// Returns the parameters after a step of the minorize-maximize algorithm.
fn minorized_parameters(parameters: &Parameters, expansion: &Expansion, free: &FreeMask) -> Parameters {
    Parameters::from_fn(|j, _| {
        let ratio = 1.0 + 2.0 * expansion.score[j] / expansion.traces[j];
        if free[j] && ratio >= 0.0 && ratio.is_finite() {
            parameters[j] * ratio.sqrt()
        } else {
            parameters[j]
        }
    })
}
