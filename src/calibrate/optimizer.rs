//! Maximum of the restricted likelihood over variances of 0 or more.

use super::likelihood::{Expansion, Information, PARAMETER_COUNT, Parameters, Residuals};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Mask of the parameters that are fitted; the others stay as they are.
pub(super) type FreeMask = [bool; PARAMETER_COUNT];

/// Maximum of the likelihood.
#[derive(Clone, Debug)]
pub(super) struct Maximum {
    pub parameters: Parameters,
    pub expansion: Expansion,
    pub free: FreeMask,
}

/// Least gain of log-likelihood (nats) for which a step is tried, and after which the optimizer goes on.
const MIN_GAIN: f64 = 1e-5;

const MAX_STEPS: usize = 60;

/// Number of halvings of a scoring step before a minorized step is taken instead.
const MAX_HALVINGS: usize = 4;

/// Returns the maximum by Fisher scoring with the average information, projected to where no variance is negative.
///
/// A step that gains nothing gives way to θⱼ √(rᵀP Vⱼ P r / tr(P Vⱼ)), which always gains (Zhou, Hu, Qiao, Cho and Lange 2019).
pub(super) fn maximize(residuals: &Residuals, start: Parameters, free: &FreeMask) -> Maximum {
    let mut parameters = start;
    let mut expansion = residuals.expansion(residuals.filtered(&parameters));
    for _ in 0..MAX_STEPS {
        let Some(step) = scoring_step(&parameters, &expansion, free) else { break };
        let mut next = None;
        for halving in 0..=MAX_HALVINGS {
            let candidate = (parameters + step * 0.5_f64.powi(halving as i32)).map(|each| each.max(0.0));
            let filtered = residuals.filtered(&candidate);
            if filtered.least_squares.log_likelihood > expansion.log_likelihood() {
                next = Some((candidate, residuals.expansion(filtered)));
                break;
            }
        }
        let (next, better) = next.unwrap_or_else(|| {
            let candidate = minorized(&parameters, &expansion, free);
            (candidate, residuals.expansion(residuals.filtered(&candidate)))
        });
        let gain = better.log_likelihood() - expansion.log_likelihood();
        if gain <= 0.0 {
            break;
        }
        (parameters, expansion) = (next, better);
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
    let is_moving =
        |j: &usize| free[*j] && information[(*j, *j)] > 0.0 && (parameters[*j] > 0.0 || score[*j] > 0.0);
    let mut moving: Vec<usize> = (0..PARAMETER_COUNT).filter(is_moving).collect();
    loop {
        let (factor, scale) = scaled_cholesky(information, &moving, [1e-9, 1e-9])?;
        let gradient = DVector::from_fn(moving.len(), |a, _| score[moving[a]] / scale[a]);
        let solved = factor.solve(&gradient);
        // A variance of 0 that would become negative stays 0, and the step of the others is computed without it.
        if let Some(stuck) = (0..moving.len()).find(|a| parameters[moving[*a]] == 0.0 && solved[*a] < 0.0) {
            moving.remove(stuck);
            continue;
        }
        if 0.5 * gradient.dot(&solved) < MIN_GAIN {
            return None;
        }
        let mut step = Parameters::zeros();
        moving.iter().enumerate().for_each(|(a, j)| step[*j] = solved[a] / scale[a]);
        return Some(step);
    }
}

/// Returns the step of the minorize-maximize algorithm, which always gains.
fn minorized(parameters: &Parameters, expansion: &Expansion, free: &FreeMask) -> Parameters {
    Parameters::from_fn(|j, _| {
        let ratio = expansion.quadratic[j] / expansion.trace[j];
        let can_move = free[j] && ratio.is_finite() && ratio >= 0.0;
        if can_move { parameters[j] * ratio.sqrt() } else { parameters[j] }
    })
}

/// Returns the Cholesky factor of the information on some parameters, each in units of its scale, and these scales. Parameters differ by
/// orders of magnitude; the scale of one is the root of its information. The diagonal of 1 is increased by a relative and an absolute amount.
fn scaled_cholesky(
    information: &Information,
    parameters: &[usize],
    [relative, absolute]: [f64; 2],
) -> Option<(Cholesky<f64, Dyn>, Vec<f64>)> {
    let scale: Vec<f64> = parameters.iter().map(|j| information[(*j, *j)].sqrt()).collect();
    let matrix = DMatrix::from_fn(scale.len(), scale.len(), |a, b| {
        let entry = information[(parameters[a], parameters[b])] / (scale[a] * scale[b]);
        if a == b { entry * (1.0 + relative) + absolute } else { entry }
    });
    Some((matrix.cholesky()?, scale))
}

impl Maximum {
    /// Returns the covariances of one parameter with all: a column of the inverse information matrix over the free parameters above 0 and
    /// this one. Other parameters at 0 are fixed there: their covariances are 0. All are 0 if there is no information on this one.
    pub fn covariances(&self, parameters: &Parameters, parameter: usize) -> Parameters {
        let information = &self.expansion.information;
        let moving: Vec<usize> = (0..PARAMETER_COUNT)
            .filter(|j| *j == parameter || self.free[*j] && parameters[*j] > 0.0)
            .filter(|j| information[(*j, *j)] > 0.0)
            .collect();
        let mut column = Parameters::zeros();
        if let Some(place) = moving.iter().position(|j| *j == parameter)
            && let Some((factor, scale)) = scaled_cholesky(information, &moving, [1e-12, 0.0])
        {
            let solved = factor.solve(&DVector::from_fn(scale.len(), |a, _| f64::from(u8::from(a == place))));
            moving.iter().enumerate().for_each(|(a, j)| column[*j] = solved[a] / (scale[a] * scale[place]));
        }
        column
    }
}
