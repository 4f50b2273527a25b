//! Maximum of the restricted likelihood over variances of 0 or more.

use super::likelihood::{Expansion, FreeMask, PARAMETER_COUNT, Parameters, Residuals, masked_inverse};

/// Gain of log-likelihood (nats) below which a search counts as exact: that of a step of 0.014 standard errors.
pub(super) const EXACT_GAIN: f64 = 1e-4;

const MAX_STEPS: usize = 60;

/// Maximum number of halvings of a scoring step.
const MAX_HALVINGS: i32 = 10;

/// Relative rounding error of a step that makes a variance 0.
const ROUNDING_TOLERANCE: f64 = 1e-9;

/// Returns the expansion around the maximum, by Fisher scoring from another expansion. A step that does not increase the likelihood is
/// halved. The search ends at a step whose predicted or actual gain of log-likelihood (nats) is below `min_gain`.
pub(super) fn maximize(residuals: &Residuals, mut expansion: Expansion, min_gain: f64) -> Expansion {
    for _ in 0..MAX_STEPS {
        let Expansion { parameters, score, filtered, .. } = &expansion;
        let step = feasible_parameters(&expansion, residuals.free, Parameters::zeros()) - parameters;
        if 0.5 * score.dot(&step) < min_gain {
            break;
        }
        let better_parameters = (0..=MAX_HALVINGS).find_map(|halvings| {
            let candidate = parameters + step * 0.5_f64.powi(halvings);
            let candidate_filtered = residuals.filtered(&candidate);
            let gain = candidate_filtered.log_likelihood - filtered.log_likelihood;
            (gain > 0.0).then_some((candidate, candidate_filtered, gain))
        });
        let Some((candidate, filtered, gain)) = better_parameters else { break };
        expansion = residuals.expansion(&candidate, filtered);
        if gain < min_gain {
            break;
        }
    }
    expansion
}

/// Returns the parameters after a scoring step of the parameters in `mask`. Other parameters move by `fixed_step`. A variance that would
/// become negative is set to 0, and the steps of the remaining parameters are computed again.
pub(super) fn feasible_parameters(
    Expansion { parameters, score, information, .. }: &Expansion,
    mut mask: FreeMask,
    mut fixed_step: Parameters,
) -> Parameters {
    loop {
        let remaining_score = score - information * fixed_step;
        let step = masked_inverse(information, &mask).0 * remaining_score + fixed_step;
        let is_negative =
            |i: &usize| mask[*i] && parameters[*i] + step[*i] < -ROUNDING_TOLERANCE * parameters[*i];
        match (0..PARAMETER_COUNT).find(is_negative) {
            Some(i) => (mask[i], fixed_step[i]) = (false, -parameters[i]),
            None => return (parameters + step).map(|parameter| parameter.max(0.0)),
        }
    }
}
