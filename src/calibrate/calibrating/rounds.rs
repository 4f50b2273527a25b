//! The rounds in which the systematic errors are found: each is a step of least squares, by the α's of the one before.

use super::{ARCS, Calibrating, LEGS};
use crate::calibrate::stages::Purpose;
use crate::calibrate::systematic::{Error, LeastSquares, Step};
use crate::geom::se2::wrap_angle;

/// A change that is so small a part of its deviation is none.
const STAYS: f64 = 0.01;

impl Calibrating {
    /// Goes on with the step to better systematic errors.
    pub(super) fn refine(&mut self, purpose: Purpose) -> Option<Step> {
        let model = self.options.model;
        let (mut squares, from) = self.squares.take().unwrap_or((LeastSquares::after(self.known), 0));
        let until = self.legs.len().min(from + LEGS);
        let best = self.fitted().best;
        let densities = self.evidence.each(&best, from..until);
        let legs = self.legs[from..until].iter().zip(&self.observations[from..until]);
        for ((leg, observation), density) in legs.zip(densities) {
            squares.add(self.without(purpose), leg, observation, model.weights(observation, &density));
        }
        self.work.add(ARCS * (until - from));
        if until < self.legs.len() {
            self.squares = Some((squares, until));
            return None;
        }
        Some(squares.step())
    }

    /// Takes a step; whether the systematic errors are as they were.
    pub(super) fn improve(&mut self, &Step { change, deviations, inverse }: &Step) -> bool {
        (self.deviations, self.known) = (deviations, inverse);
        let mut stays = true;
        for (i, error) in Error::ALL.into_iter().enumerate() {
            let Some(deviation) = deviations[i] else {
                // Whatever an earlier round made of it.
                self.systematic.set(error, self.begun.get(error));
                continue;
            };
            let most = 4.0 * error.largest_deviation();
            let change = change[i].max(-most).min(most);
            self.systematic.set(error, self.systematic.get(error) + change);
            self.systematic.mount_yaw = wrap_angle(self.systematic.mount_yaw);
            stays &= change.abs() <= STAYS * deviation;
        }
        stays
    }

    /// Sets what is to be removed.
    pub(super) fn remove(&mut self) {
        for (i, error) in Error::ALL.into_iter().enumerate() {
            if self.options.remove[i] {
                self.removed.set(error, self.systematic.get(error));
            }
        }
    }
}
