//! Why a log does not determine an α, and so what to drive that it does.

use super::bad::Robust;
use super::likelihood::Parameters;
use super::mismatch::{DRIVES, TURNS};
use super::model::{Kind, Model, Observation};
use super::profile::Fitted;
use crate::noise::NoiseKind;

/// What a log lacks that would tell an α.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undetermined {
    /// The robot never turned, or so little that even an α of 1 could not be seen. Under the velocity model: while it drove, for a
    /// turn on the spot tells no executed turn there.
    TurnsTooLittle,
    /// The robot never went anywhere, or hardly.
    DrivesTooLittle,
    /// The stated error of the reference is larger than what even an α of 1 would make of the legs, of which there are enough.
    ReferenceTooCoarse,
    /// In all legs turn and way had the same ratio: the noise may be this α's or that of another one of the same kind.
    OneRatio,
}

/// Turn² and way² have one ratio where, the other α's being unknown, no more than this share of what is known of an α is left: the
/// ratio then varies by less than a seventh.
const SAME: f64 = 0.02;

/// With less information than this an α has a deviation above ½, even if all others were known: its interval would lead from
/// 0 to 1, where it is told to be anything.
const SEEN: f64 = 4.0;

/// (2 deviations)²: an interval that is shorter, where the likelihood would have it four long, ends where an α is 0.
const SHORT: f64 = 4.0;

/// So many legs tell an α that is alone in their variance to a fifth.
const ENOUGH: usize = 50;

/// Of each α why it is not determined; None where it is.
///
/// It is not where its profile has no end; nor where that has ends that are not the likelihood's: with turn and way in one ratio
/// an α may take all that the other has, and the ends are where one of them is 0. What there is to know of an α is asked of normal
/// noise: of triangular noise a few legs at its edges would tell most. `is_stated` says whether the reference errs.
pub(super) fn undetermined(
    fitted: &Fitted,
    model: Model,
    observations: &[Observation],
    intervals: &[Option<[f64; 2]>],
    is_stated: bool,
) -> Vec<Option<Undetermined>> {
    let normal = Parameters { bad: None, noise: NoiseKind::Normal, ..fitted.best };
    let slope = fitted.evidence.slope(&normal, Robust::No);
    let of = |(alpha, interval): (usize, &Option<[f64; 2]>)| {
        let alone = slope.information_of(alpha, &[]);
        let beside = slope.information_of(alpha, &fitted.free);
        let one_ratio = alone >= SEEN && beside < SAME * alone;
        let shares = model.kinds().iter().filter(|kind| kind.alphas.contains(&alpha));
        let from_zero = |alpha: usize| intervals[alpha].is_none_or(|[from, _]| from == 0.0);
        match interval {
            Some([from, to]) => {
                let short = beside * (to - from) * (to - from) < SHORT;
                let one_ratio = one_ratio && short && shares.flat_map(|kind| kind.alphas).any(from_zero);
                one_ratio.then_some(Undetermined::OneRatio)
            }
            None if one_ratio => Some(Undetermined::OneRatio),
            None => Some(lacking(model, observations, alpha, is_stated)),
        }
    };
    intervals.iter().enumerate().map(of).collect()
}

fn lacking(model: Model, observations: &[Observation], alpha: usize, is_stated: bool) -> Undetermined {
    let tells = |observation: &Observation| {
        model
            .kinds()
            .iter()
            .zip(observation.residuals)
            .any(|(kind, residual)| kind.alphas.contains(&alpha) && !residual.is_nan())
    };
    // Of as many as one would be told to drive.
    let hidden = observations.iter().filter(|observation| is_hidden(model, observation, alpha)).count();
    if is_stated && hidden >= ENOUGH {
        Undetermined::ReferenceTooCoarse
    } else if model.grows_with_turn(alpha) && observations.iter().any(tells) {
        Undetermined::TurnsTooLittle
    } else {
        Undetermined::DrivesTooLittle
    }
}

/// Whether a leg has much of what drives an α, and yet less than the reference errs by.
fn is_hidden(model: Model, observation: &Observation, alpha: usize) -> bool {
    let Observation { expected, residuals, coefficients, floors, .. } = observation;
    let drives = if model.grows_with_turn(alpha) {
        expected.theta().abs() > TURNS
    } else {
        libm::hypot(expected.x(), expected.y()) > DRIVES
    };
    let below = |(k, kind): (usize, &Kind)| {
        let place = kind.alphas.iter().position(|of| *of == alpha)?;
        (!residuals[k].is_nan()).then_some(coefficients[k][place] < floors[k])
    };
    let mut told = model.kinds().iter().enumerate().filter_map(below).peekable();
    drives && told.peek().is_some() && told.all(|below| below)
}
