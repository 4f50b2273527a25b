//! Whether a log is what it is taken for: of one drive, in m and rad, with rows enough for its legs.

use super::doubts::Verdict;
use super::legs::{FEWEST, Leg, LegLength};
use super::model::Observation;
use super::systematic::{Error, Systematic};
use super::trajectory::sort;
use crate::geom::se2::SE2;

/// Half of the legs that drive, or that turn, are off by this share of what was read: a reference that has to do with it is nearer.
const LOST: f64 = 0.7;

/// What a leg turns (rad) or drives (m) at least to be asked: noise is small beside it, and such legs tell of it.
pub(super) const TURNS: f64 = 0.1;
pub(super) const DRIVES: f64 = 0.05;

/// No wheel is half as large as it is taken for, or twice: what was removed as a scale is another unit.
const SCALES: std::ops::RangeInclusive<f64> = 0.5..=2.0;

/// Half of the legs are so many times as long as asked: more than a sample or two too late.
const LONGER: f64 = 1.5;

/// Of legs that were to be so long, without the systematic errors that were removed.
pub(super) fn mismatch(
    legs: &[Leg],
    observations: &[Observation],
    removed: &Systematic,
    length: LegLength,
) -> Option<Verdict> {
    let follows = |least: f64, size: fn(&SE2) -> f64, between: fn(&SE2, &SE2) -> f64| {
        let (mut read, mut off) = (Vec::new(), Vec::new());
        for (leg, observation) in legs.iter().zip(observations) {
            let expected = &observation.expected;
            if size(expected) > least {
                read.push(size(expected));
                off.push(between(&removed.motion(leg), expected));
            }
        }
        read.len() < FEWEST || median(&mut off) < LOST * median(&mut read)
    };
    let turns =
        follows(TURNS, |motion| motion.theta().abs(), |one, other| (one.theta() - other.theta()).abs());
    let drives = follows(
        DRIVES,
        |motion| libm::hypot(motion.x(), motion.y()),
        |one, other| libm::hypot(one.x() - other.x(), one.y() - other.y()),
    );
    let in_units =
        [Error::DistanceScale, Error::TurnScale].iter().all(|scale| SCALES.contains(&removed.get(*scale)));
    if !turns || !drives || !in_units {
        return Some(Verdict::Unrelated);
    }
    let mut lengths: Vec<f64> = legs.iter().map(|leg| length.share_of(leg)).collect();
    (median(&mut lengths) > LONGER).then_some(Verdict::LongLegs)
}

/// Of one number at least.
fn median(numbers: &mut [f64]) -> f64 {
    sort(numbers);
    numbers[numbers.len() / 2]
}
