//! Whether a reference errs less than it is stated to: then what the wheels err by is taken for its error.

use super::calibration::FEWEST;
use super::doubts::Judged;
use super::model::{Model, Observation};

/// Residuals of which the squares are four fifths of what that error alone would make them: a deviation that is stated a tenth too large.
const SHARE: f64 = 0.8;

/// So many deviations of a mean: of three kinds one is beyond by chance in every two hundredth log of wheels that err by nothing.
const SURE: f64 = 3.0;

/// The variance of a normal error's square by its own; and by half as much more, for neighbours share the place where they meet.
const OF_SQUARES: f64 = 3.0;

/// A leg that leads so many deviations of a place far has a direction that errs as much as its variance says. That of a nearer one is lost, and
/// cannot be off by more than half a circle.
const LEADS: f64 = 3.0;

/// Whether the residuals of some kind are smaller, in the mean, than the reference's stated error alone makes them.
pub(super) fn overstated(model: Model, observations: &[Observation], judged: &[Judged]) -> bool {
    let along = model.along();
    let is_smaller = |kind: usize| {
        let (mut count, mut sum) = (0.0, 0.0);
        for (Observation { residuals, floors, reading, .. }, judged) in observations.iter().zip(judged) {
            let leads = kind == along || reading[along].abs() > LEADS * floors[along].sqrt();
            let square = residuals[kind] * residuals[kind] / floors[kind];
            if judged.bad <= 0.5 && leads && square.is_finite() {
                count += 1.0;
                sum += square;
            }
        }
        count >= FEWEST as f64 && sum < count * SHARE.min(1.0 - SURE * (OF_SQUARES / count).sqrt())
    };
    (0..3).any(is_smaller)
}
