//! Maximum of the restricted likelihood over variances of 0 or more.

use super::likelihood::{Expansion, Information, PARAMETER_COUNT, Parameters, Residuals};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Mask of the parameters that are fitted. All other parameters are kept fixed.
pub(super) type FreeMask = [bool; PARAMETER_COUNT];

/// Maximum of the likelihood.
#[derive(Clone, Debug)]
pub(super) struct Maximum {
    pub parameters: Parameters,
    pub expansion: Expansion,
    pub free: FreeMask,
}

/// Minimum gain of log-likelihood (nats). A step with a smaller predicted gain is not tried, and a smaller actual gain ends the search.
const MIN_GAIN: f64 = 1e-5;

const MAX_STEPS: usize = 60;

/// Maximum number of halvings of a scoring step. A step of the minorize-maximize algorithm then replaces it.
const MAX_HALVINGS: usize = 4;

/// Returns the maximum, by Fisher scoring with the average information. Negative variances are clamped to 0.
///
/// A step that does not increase the likelihood is replaced by θⱼ √(rᵀP Vⱼ P r / tr(P Vⱼ)), which always increases it (Zhou, Hu, Qiao,
/// Cho and Lange 2019).
pub(super) fn maximize(residuals: &Residuals, start: Parameters, free: &FreeMask) -> Maximum {
    let mut parameters = start;
    let mut expansion = residuals.expansion(residuals.filtered(&parameters));
    for _ in 0..MAX_STEPS {
        let Some(step) = scoring_step(&parameters, &expansion, free) else { break };
        let mut accepted_step = None;
        for halving in 0..=MAX_HALVINGS {
            let candidate =
                (parameters + step * 0.5_f64.powi(halving as i32)).map(|parameter| parameter.max(0.0));
            let filtered = residuals.filtered(&candidate);
            if filtered.least_squares.log_likelihood > expansion.log_likelihood() {
                accepted_step = Some((candidate, residuals.expansion(filtered)));
                break;
            }
        }
        let (next, next_expansion) = accepted_step.unwrap_or_else(|| {
            let candidate = minorized_step(&parameters, &expansion, free);
            (candidate, residuals.expansion(residuals.filtered(&candidate)))
        });
        let gain = next_expansion.log_likelihood() - expansion.log_likelihood();
        if gain <= 0.0 {
            break;
        }
        (parameters, expansion) = (next, next_expansion);
        if gain < MIN_GAIN {
            break;
        }
    }
    Maximum { parameters, expansion, free: *free }
}

/// Returns the step of Fisher scoring; None if the predicted gain is below [`MIN_GAIN`]. A variance of 0 whose score is negative stays 0.
fn scoring_step(parameters: &Parameters, expansion: &Expansion, free: &FreeMask) -> Option<Parameters> {
    let score = expansion.score();
    let information = &expansion.information;
    let is_free =
        |j: &usize| free[*j] && information[(*j, *j)] > 0.0 && (parameters[*j] > 0.0 || score[*j] > 0.0);
    let mut active_parameters: Vec<usize> = (0..PARAMETER_COUNT).filter(is_free).collect();
    loop {
        let (cholesky, scales) = scaled_cholesky(information, &active_parameters, [1e-9, 1e-9])?;
        let gradient =
            DVector::from_fn(active_parameters.len(), |a, _| score[active_parameters[a]] / scales[a]);
        let steps = cholesky.solve(&gradient);
        // A variance of 0 that would become negative stays 0, and the step of the others is computed again without it.
        if let Some(blocked) =
            (0..active_parameters.len()).find(|a| parameters[active_parameters[*a]] == 0.0 && steps[*a] < 0.0)
        {
            active_parameters.remove(blocked);
            continue;
        }
        if 0.5 * gradient.dot(&steps) < MIN_GAIN {
            return None;
        }
        let mut step = Parameters::zeros();
        active_parameters.iter().enumerate().for_each(|(a, j)| step[*j] = steps[a] / scales[a]);
        return Some(step);
    }
}

/// Returns the parameters after a step of the minorize-maximize algorithm, which always increases the likelihood.
fn minorized_step(parameters: &Parameters, expansion: &Expansion, free: &FreeMask) -> Parameters {
    Parameters::from_fn(|j, _| {
        let quadratic_ratio = expansion.quadratic[j] / expansion.trace[j];
        let can_update = free[j] && quadratic_ratio.is_finite() && quadratic_ratio >= 0.0;
        if can_update { parameters[j] * quadratic_ratio.sqrt() } else { parameters[j] }
    })
}

/// Returns the Cholesky factor of the information on some parameters, scaled to a diagonal of 1 because parameters differ by orders of magnitude.
/// Also returns the scales: the square roots of the diagonal. A relative and an absolute amount regularize the diagonal.
fn scaled_cholesky(
    information: &Information,
    parameters: &[usize],
    [relative, absolute]: [f64; 2],
) -> Option<(Cholesky<f64, Dyn>, Vec<f64>)> {
    let scales: Vec<f64> = parameters.iter().map(|j| information[(*j, *j)].sqrt()).collect();
    let scaled_matrix = DMatrix::from_fn(scales.len(), scales.len(), |a, b| {
        let scaled_entry = information[(parameters[a], parameters[b])] / (scales[a] * scales[b]);
        if a == b { scaled_entry * (1.0 + relative) + absolute } else { scaled_entry }
    });
    Some((scaled_matrix.cholesky()?, scales))
}

impl Maximum {
    /// Returns the covariances of one parameter with all parameters: a column of the inverse information matrix over this parameter and the
    /// free parameters above 0. All other parameters count as fixed, with covariance 0. Without information on the parameter all are 0.
    pub fn covariances(&self, parameters: &Parameters, parameter: usize) -> Parameters {
        let information = &self.expansion.information;
        let active_parameters: Vec<usize> = (0..PARAMETER_COUNT)
            .filter(|j| *j == parameter || self.free[*j] && parameters[*j] > 0.0)
            .filter(|j| information[(*j, *j)] > 0.0)
            .collect();
        let mut column = Parameters::zeros();
        if let Some(position) = active_parameters.iter().position(|j| *j == parameter)
            && let Some((cholesky, scales)) = scaled_cholesky(information, &active_parameters, [1e-12, 0.0])
        {
            let steps =
                cholesky.solve(&DVector::from_fn(scales.len(), |a, _| f64::from(u8::from(a == position))));
            active_parameters
                .iter()
                .enumerate()
                .for_each(|(a, j)| column[*j] = steps[a] / (scales[a] * scales[position]));
        }
        column
    }
}
