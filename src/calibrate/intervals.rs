//! 95 % intervals of variances, by the profile likelihood, and whether the log identifies an α at all.

use super::likelihood::{ALPHAS, Expansion, Information, PARAMETERS, Parameters, Residuals};
use super::optimizer::{Free, Maximum, conditional_information, conditional_inverse};
use super::residuals::{Model, Observation};
use nalgebra::SVector;
use serde::{Deserialize, Serialize};

/// Quantile 0.975 of the standard normal distribution.
pub(super) const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Steps of the search for an end of an interval; the root of the deviance is nearly linear.
const MAX_STEPS: usize = 12;

/// Relative tolerance on the root of the deviance at an end of an interval.
const TOLERANCE: f64 = 0.02;

/// Returns the 95 % interval of each free parameter; that of a parameter without information is [0, ∞].
///
/// An end is where twice the log-likelihood is t² below its maximum, the other parameters moving along the ridge that the
/// information gives. The distance to it is multiplied by √(S/I⁻¹), if above 1, S being the sandwich covariance over blocks of legs.
pub(super) fn intervals(
    residuals: &Residuals,
    maximum: &Maximum,
    free: &Free,
    persistence: f64,
) -> Vec<[f64; 2]> {
    let count = residuals.len();
    let blocks = Blocks::new(maximum, count, persistence);
    let freedom = (count.saturating_sub(PARAMETERS)).max(1) as f64;
    (0..PARAMETERS)
        .map(|parameter| {
            let value = maximum.parameters[parameter];
            let information =
                conditional_information(&maximum.expansion, &maximum.parameters, free, parameter);
            if !free[parameter] {
                return [value; 2];
            }
            if information <= 0.0 {
                return [0.0, f64::INFINITY];
            }
            let lines = ridges(maximum, free, parameter);
            let threshold = student_95(freedom);
            let widening = blocks.widening(maximum, free, parameter);
            let end = |sign: f64| {
                profile_end(
                    residuals,
                    maximum,
                    &lines,
                    parameter,
                    sign * threshold / information.sqrt(),
                    threshold,
                )
            };
            let [low, high] = [end(-1.0), end(1.0)];
            [(value + widening * low).max(0.0), value + widening * high]
        })
        .collect()
}

/// Ridges of the likelihood: one on which variances of 0 stay 0, and another, where there are such α's, on which these rise.
fn ridges(maximum: &Maximum, free: &Free, parameter: usize) -> Vec<Parameters> {
    let at_zero = (0..ALPHAS).any(|alpha| free[alpha] && maximum.parameters[alpha] == 0.0);
    let risen = at_zero.then(|| unknown_alphas(&maximum.parameters));
    [Some(maximum.parameters), risen]
        .iter()
        .flatten()
        .map(|parameters| ridge(&maximum.expansion, parameters, free, parameter))
        .collect()
}

/// Returns the parameters with α's of 0 as small as can be: they are unknown like the others.
fn unknown_alphas(parameters: &Parameters) -> Parameters {
    Parameters::from_fn(|j, _| if j < ALPHAS { parameters[j].max(f64::MIN_POSITIVE) } else { parameters[j] })
}

/// Change of all parameters when one of them changes by 1 along the ridge of the likelihood.
fn ridge(expansion: &Expansion, parameters: &Parameters, free: &Free, parameter: usize) -> Parameters {
    let column = conditional_inverse(expansion, parameters, free, parameter).column(parameter).into_owned();
    if column[parameter] > 0.0 {
        column / column[parameter]
    } else {
        Parameters::from_fn(|j, _| f64::from(u8::from(j == parameter)))
    }
}

/// Distance from the maximum to an end of the profile, from a guess of it; as far as 0 where the likelihood does not fall enough before.
fn profile_end(
    residuals: &Residuals,
    maximum: &Maximum,
    lines: &[Parameters],
    parameter: usize,
    guess: f64,
    threshold: f64,
) -> f64 {
    let value = maximum.parameters[parameter];
    let root = |distance: f64| {
        let along = |line: &Parameters| {
            residuals.log_likelihood(&(maximum.parameters + line * distance).map(|each| each.max(0.0)))
        };
        let best = lines.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
        (2.0 * (maximum.expansion.log_likelihood - best)).max(0.0).sqrt()
    };
    let mut distance = guess.max(-value);
    if distance == -value && (value == 0.0 || root(distance) <= threshold) {
        return distance;
    }
    let (mut inside, mut outside) = (0.0, None::<f64>);
    for _ in 0..MAX_STEPS {
        let height = root(distance);
        if (height / threshold - 1.0).abs() < TOLERANCE {
            break;
        }
        if height < threshold {
            inside = distance;
        } else {
            outside = Some(distance);
        }
        let next = if height > 0.0 { distance * threshold / height } else { 2.0 * distance };
        distance = match outside {
            Some(outside) if (next - inside) * (next - outside) >= 0.0 => 0.5 * (inside + outside),
            Some(_) => next,
            None => (4.0 * distance.abs()).min(next.abs()).copysign(distance).max(-value),
        };
        if outside.is_none() && distance == -value && root(distance) <= threshold {
            break;
        }
    }
    distance
}

/// Scores summed over blocks of neighbouring legs.
struct Blocks {
    scores: Vec<Parameters>,
    /// Factor of a variance's standard error where errors have the correlation ρ from leg to leg: √((1 + ρ²)/(1 − ρ²)).
    repeated: f64,
}

impl Blocks {
    /// A block has ∛n legs, and more where errors persist: the correlation of squares falls by ρ² from leg to leg.
    fn new(maximum: &Maximum, count: usize, persistence: f64) -> Self {
        let square = persistence * persistence;
        let repeated = (1.0 + square) / (1.0 - square);
        let length = ((count as f64).cbrt() * repeated).ceil().max(1.0) as usize;
        let scores = maximum.expansion.scores.chunks(length).map(|block| block.iter().sum()).collect();
        Self { scores, repeated: repeated.sqrt() }
    }

    /// Returns by how much an interval is longer, at least 1, than the likelihood has it.
    fn widening(&self, maximum: &Maximum, free: &Free, parameter: usize) -> f64 {
        let inverse: Information =
            conditional_inverse(&maximum.expansion, &maximum.parameters, free, parameter);
        let row: SVector<f64, PARAMETERS> = inverse.column(parameter).into_owned();
        let variance: f64 = self.scores.iter().map(|score| row.dot(score).powi(2)).sum();
        let freedom = self.scores.len().saturating_sub(1).max(1) as f64;
        let model = inverse[(parameter, parameter)];
        if model <= 0.0 {
            return 1.0;
        }
        ((variance / model).sqrt() * student_95(freedom) / NORMAL_95).max(self.repeated)
    }
}

/// Quantile 0.975 of Student's t, by the expansion of Fisher and Cornish.
fn student_95(freedom: f64) -> f64 {
    let (z, z3) = (NORMAL_95, NORMAL_95.powi(3));
    z + (z3 + z) / (4.0 * freedom)
        + (5.0 * NORMAL_95.powi(5) + 16.0 * z3 + 3.0 * z) / (96.0 * freedom * freedom)
}

/// Reason for which a log does not identify an α.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum NotIdentifiable {
    /// The robot turned too little. Under the velocity model: while it drove, for a turn on the spot shows no executed turn rate.
    InsufficientRotation,
    /// The robot drove too little.
    InsufficientTranslation,
    /// The error of the reference hides the noise of the wheels.
    ReferenceTooNoisy,
    /// Turn and distance had one ratio in all legs: the noise may be this α's or that of the other one of its component.
    Collinear,
}

/// Fisher information below which an α is not identifiable: 4 is a standard error of 0.5, far above any plausible α.
const MIN_INFORMATION: f64 = 4.0;

/// Least fraction of the information on an α that is left when the others are unknown. Below it, the ratio of turn and distance varies
/// by less than a seventh.
const MIN_FREE_INFORMATION: f64 = 0.02;

/// Drive (m) and turn (rad) of a leg that counts as one of a robot that drives or turns.
const DRIVES: f64 = 0.05;
const TURNS: f64 = 0.1;

/// Number of such legs that identify an α against an exact reference: its standard error is then a fifth.
const ENOUGH_LEGS: usize = 50;

/// Returns of each α why it is not identifiable; None where it is.
pub(super) fn identifiability(
    model: Model,
    expansion: &Expansion,
    parameters: &Parameters,
    free: &Free,
    observations: &[Observation],
) -> Vec<Option<NotIdentifiable>> {
    let unknown = unknown_alphas(parameters);
    let of = |alpha: usize| {
        let marginal = expansion.information[(alpha, alpha)];
        let conditional = conditional_information(expansion, &unknown, free, alpha);
        if conditional >= MIN_INFORMATION && conditional >= MIN_FREE_INFORMATION * marginal {
            return None;
        }
        if marginal >= MIN_INFORMATION {
            return Some(NotIdentifiable::Collinear);
        }
        let turns = model.grows_with_turn(alpha);
        let uses = |observation: &&Observation| {
            let shown = (0..3)
                .any(|k| model.component_alphas()[k].contains(&alpha) && !observation.residuals[k].is_nan());
            let motion = &observation.expected;
            shown
                && if turns {
                    motion.theta().abs() > TURNS
                } else {
                    libm::hypot(motion.x(), motion.y()) > DRIVES
                }
        };
        Some(match observations.iter().filter(uses).count() {
            count if count >= ENOUGH_LEGS => NotIdentifiable::ReferenceTooNoisy,
            _ if turns => NotIdentifiable::InsufficientRotation,
            _ => NotIdentifiable::InsufficientTranslation,
        })
    };
    (0..model.alphas()).map(of).collect()
}
