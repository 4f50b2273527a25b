//! Maximum of the restricted likelihood over variances of 0 or more.

use super::likelihood::{Expansion, Information, PARAMETERS, Parameters, Residuals};
use nalgebra::{DMatrix, DVector};

/// Parameters that are fitted; the others stay as they are.
pub(super) type Free = [bool; PARAMETERS];

/// Maximum of the likelihood.
#[derive(Clone, Debug)]
pub(super) struct Maximum {
    pub parameters: Parameters,
    pub expansion: Expansion,
}

/// Gain (nats) that a step has to promise.
const MIN_GAIN: f64 = 1e-5;

const MAX_STEPS: usize = 60;

/// Halvings of a step before the other kind of step is taken.
const MAX_HALVINGS: usize = 4;

/// Returns the maximum by Fisher scoring with the average information, projected to where no variance is negative.
///
/// A step that gains nothing gives way to θⱼ √(rᵀP Vⱼ P r / tr(P Vⱼ)), which always gains (Zhou, Hu, Qiao, Cho and Lange 2019).
pub(super) fn maximize(residuals: &Residuals, start: Parameters, free: &Free) -> Maximum {
    let mut parameters = start;
    let mut expansion = residuals.expansion(&parameters);
    for _ in 0..MAX_STEPS {
        let Some(step) = scoring_step(&parameters, &expansion, free) else { break };
        let mut next = None;
        for halving in 0..=MAX_HALVINGS {
            let candidate = (parameters + step * 0.5_f64.powi(halving as i32)).map(|each| each.max(0.0));
            if residuals.log_likelihood(&candidate) > expansion.log_likelihood {
                next = Some(candidate);
                break;
            }
        }
        let next = next.unwrap_or_else(|| minorized(&parameters, &expansion, free));
        let better = residuals.expansion(&next);
        if better.log_likelihood <= expansion.log_likelihood {
            break;
        }
        let gain = better.log_likelihood - expansion.log_likelihood;
        (parameters, expansion) = (next, better);
        if gain < MIN_GAIN {
            break;
        }
    }
    Maximum { parameters, expansion }
}

/// Step of Fisher scoring; None where it promises no gain. A variance of 0 whose score is negative stays there.
fn scoring_step(parameters: &Parameters, expansion: &Expansion, free: &Free) -> Option<Parameters> {
    let score = expansion.score();
    let mut moving: Vec<usize> = (0..PARAMETERS)
        .filter(|j| {
            free[*j] && expansion.information[(*j, *j)] > 0.0 && (parameters[*j] > 0.0 || score[*j] > 0.0)
        })
        .collect();
    loop {
        let count = moving.len();
        // Parameters differ by orders of magnitude: each has the scale of its information.
        let scale: Vec<f64> = moving.iter().map(|j| expansion.information[(*j, *j)].sqrt()).collect();
        let matrix = DMatrix::from_fn(count, count, |a, b| {
            let entry = expansion.information[(moving[a], moving[b])] / (scale[a] * scale[b]);
            if a == b { entry * (1.0 + 1e-9) + 1e-9 } else { entry }
        });
        let gradient = DVector::from_fn(count, |a, _| score[moving[a]] / scale[a]);
        let solved = matrix.cholesky()?.solve(&gradient);
        // One that would leave 0 for a negative variance stays, and the others move without it.
        if let Some(stuck) = (0..count).find(|a| parameters[moving[*a]] == 0.0 && solved[*a] < 0.0) {
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

fn minorized(parameters: &Parameters, expansion: &Expansion, free: &Free) -> Parameters {
    Parameters::from_fn(|j, _| {
        let ratio = expansion.quadratic[j] / expansion.trace[j];
        if free[j] && ratio.is_finite() && ratio >= 0.0 {
            parameters[j] * ratio.sqrt()
        } else {
            parameters[j]
        }
    })
}

/// Returns the inverse of the information matrix over the free parameters above 0 and `parameter`. Other parameters at 0 are fixed
/// there: their rows and columns are 0.
pub(super) fn conditional_inverse(
    expansion: &Expansion,
    parameters: &Parameters,
    free: &Free,
    parameter: usize,
) -> Information {
    let moving: Vec<usize> = (0..PARAMETERS)
        .filter(|j| *j == parameter || free[*j] && parameters[*j] > 0.0)
        .filter(|j| expansion.information[(*j, *j)] > 0.0)
        .collect();
    let count = moving.len();
    let scale: Vec<f64> = moving.iter().map(|j| expansion.information[(*j, *j)].sqrt()).collect();
    let matrix = DMatrix::from_fn(count, count, |a, b| {
        let entry = expansion.information[(moving[a], moving[b])] / (scale[a] * scale[b]);
        if a == b { entry * (1.0 + 1e-12) } else { entry }
    });
    let mut inverse = Information::zeros();
    if let Some(small) = matrix.cholesky().map(|factor| factor.inverse()) {
        for a in 0..count {
            for b in 0..count {
                inverse[(moving[a], moving[b])] = small[(a, b)] / (scale[a] * scale[b]);
            }
        }
    }
    inverse
}

/// Information on one parameter when the other free ones are unknown; 0 where there is none.
pub(super) fn conditional_information(
    expansion: &Expansion,
    parameters: &Parameters,
    free: &Free,
    parameter: usize,
) -> f64 {
    let variance = conditional_inverse(expansion, parameters, free, parameter)[(parameter, parameter)];
    if variance > 0.0 { 1.0 / variance } else { 0.0 }
}
