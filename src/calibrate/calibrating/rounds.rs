//! The rounds in which the systematic errors are found: each is a step of least squares, by the α's of the one before.

use super::{ARCS, Calibrating, LEGS};
use crate::calibrate::calibration::ReferenceError;
use crate::calibrate::legs::FEWEST;
use crate::calibrate::mismatch::DRIVES;
use crate::calibrate::stages::{Purpose, ROUNDS};
use crate::calibrate::systematic::{ERRORS, Error, LeastSquares, Step};
use crate::calibrate::trajectory::sort;
use crate::geom::se2::wrap_angle;

/// A change that is so small a part of its deviation is none.
const STAYS: f64 = 0.01;

/// What a reference is taken to err by at least (m, rad), where wheels err by less than that in a quarter of the legs, until the errors stay.
/// These would be exact, whatever the clocks, and those that tell the clocks' offset, in which the robot starts, stops or turns off, would
/// pass for bad.
const LEAST_ERROR: f64 = 1e-3;

/// Rounds that are left at least for how well errors are known, once the reference is taken for as good as it is.
const LAST: usize = 3;

impl Calibrating {
    /// What the reference errs by at one moment, m and rad.
    pub(super) fn reference_error(&self) -> [f64; 2] {
        let ReferenceError { position, heading } = self.options.reference_error;
        [position, heading].map(|error| error.max(self.least_error.unwrap_or(0.0)))
    }

    /// Whether it has just turned out that a quarter of the legs that drive end where the wheels say, as near as a reference shows.
    pub(super) fn turns_out_exact(&mut self, purpose: Purpose) -> bool {
        if self.least_error.is_some() || !matches!(purpose, Purpose::Round(_)) {
            return false;
        }
        let without = self.without(purpose);
        let mut off: Vec<f64> = self
            .legs
            .iter()
            .step_by(1 + self.legs.len() / LEGS)
            .map(|leg| (without.expected(leg), without.motion(leg)))
            .filter(|(expected, _)| libm::hypot(expected.x(), expected.y()) > DRIVES)
            .map(|(expected, motion)| libm::hypot(motion.x() - expected.x(), motion.y() - expected.y()))
            .collect();
        self.work.add(ARCS * off.len());
        sort(&mut off);
        if off.len() < FEWEST || off[off.len() / 4] >= LEAST_ERROR {
            return false;
        }
        self.least_error = Some(LEAST_ERROR);
        true
    }

    /// Whether the reference was taken to err by more than is said until now, and the errors are near enough to take it for what it is. What
    /// was fitted with it is no beginning: the α's of wheels that err by less are 0, from which nothing leads away.
    pub(super) fn is_now_exact(&mut self, round: usize, stays: bool) -> bool {
        let is_now = self.least_error == Some(LEAST_ERROR) && (stays || round + 1 + LAST >= ROUNDS);
        if is_now {
            (self.least_error, self.best, self.known) = (Some(0.0), None, [[0.0; ERRORS]; ERRORS]);
        }
        is_now
    }

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
