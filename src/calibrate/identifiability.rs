//! Whether the log identifies an α, and if not what to drive that it does.

use super::likelihood::{Expansion, Parameters};
use super::optimizer::{Free, conditional_information};
use super::residuals::{Model, Observation};

/// Reason for which a log does not identify an α.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

/// Least information on an α: its standard error is then 0.5, and its interval leads from 0 to 1.
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
    let of = |alpha: usize| {
        let marginal = expansion.information[(alpha, alpha)];
        let conditional = conditional_information(expansion, parameters, free, alpha);
        if conditional >= MIN_INFORMATION && conditional >= MIN_FREE_INFORMATION * marginal {
            return None;
        }
        if marginal >= MIN_INFORMATION {
            return Some(NotIdentifiable::Collinear);
        }
        let turns = model.grows_with_turn(alpha);
        let uses = |observation: &&Observation| {
            let shown = (0..3)
                .any(|k| model.components()[k].alphas.contains(&alpha) && !observation.residuals[k].is_nan());
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
