//! Poses with times, as a log has them.

use crate::geom::se2::{SE2, wrap_angle};
use nalgebra::Vector3;
use std::fmt;

/// Poses in one fixed frame, in the order of their times.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// s, each later than the one before.
    times: Vec<f64>,
    poses: Vec<SE2>,
    /// Of each sample, whether there is a gap before it: nobody knows how the robot came there from the one before.
    gaps: Vec<bool>,
    /// s.
    usual_step: f64,
}

/// Which sample is no part of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrajectoryError {
    /// From 0.
    pub sample: usize,
    pub fault: TrajectoryFault,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrajectoryFault {
    /// A time or a coordinate is not finite.
    NotFinite,
    /// It is not later than the one before, which is at this time (s).
    NotLater { before: f64 },
}

impl fmt::Display for TrajectoryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { sample, fault } = self;
        match fault {
            TrajectoryFault::NotFinite => {
                write!(
                    f,
                    "sample {sample} has a time or a coordinate that is not finite; allowed are finite numbers"
                )
            }
            TrajectoryFault::NotLater { before } => {
                write!(
                    f,
                    "sample {sample} is not later than the one before, at {before} s; allowed are times that rise"
                )
            }
        }
    }
}

impl std::error::Error for TrajectoryError {}

/// A gap is longer than this many usual steps: a recording that drops a message or two now and then is whole, one that
/// pauses is not.
const STEPS_OF_A_GAP: f64 = 5.0;

impl Trajectory {
    /// The trajectory through `samples`, each a time (s) and a pose.
    ///
    /// # Errors
    /// [`TrajectoryError`] at the first sample that is not finite or not later than the one before.
    pub fn new(samples: impl IntoIterator<Item = (f64, SE2)>) -> Result<Self, TrajectoryError> {
        let samples = samples.into_iter();
        // Of a long log, to grow takes longer than all the rest.
        let (known, _) = samples.size_hint();
        let (mut times, mut poses) = (Vec::with_capacity(known), Vec::with_capacity(known));
        for (sample, (time, pose)) in samples.enumerate() {
            let pose: SE2 = pose;
            let error = |fault| Err(TrajectoryError { sample, fault });
            if ![time, pose.x(), pose.y(), pose.theta()].iter().all(|number| number.is_finite()) {
                return error(TrajectoryFault::NotFinite);
            }
            if let Some(before) = times.last().copied().filter(|before| time <= *before) {
                return error(TrajectoryFault::NotLater { before });
            }
            times.push(time);
            poses.push(pose);
        }
        let usual_step = middle(times.windows(2).map(|pair| pair[1] - pair[0]));
        let longest = STEPS_OF_A_GAP * usual_step;
        let mut gaps = vec![false; times.len()];
        gaps.iter_mut()
            .skip(1)
            .zip(times.windows(2))
            .for_each(|(gap, pair)| *gap = pair[1] - pair[0] > longest);
        Ok(Self { times, poses, gaps, usual_step })
    }

    /// With a gap before each of these samples too, as where rows were of no use, or a reference jumped. Before the first sample
    /// nothing is known in any case.
    #[must_use]
    pub fn broken_before(mut self, samples: impl IntoIterator<Item = usize>) -> Self {
        for sample in samples {
            if let Some(gap) = self.gaps.get_mut(sample) {
                *gap = true;
            }
        }
        self
    }

    /// Where commands lead from the origin, each (a time in s, v in m/s, ω in rad/s) held until the next one.
    ///
    /// # Errors
    /// [`TrajectoryError`] at the first that is not finite or not later than the one before.
    pub fn from_commands(
        commands: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Result<Self, TrajectoryError> {
        let (mut pose, mut held) = (SE2::identity(), None::<(f64, f64, f64)>);
        Self::new(commands.into_iter().map(|(time, v, omega)| {
            if let Some((since, v, omega)) = held {
                let dt = time - since;
                pose = pose.boxplus(Vector3::new(v * dt, 0.0, omega * dt));
            }
            held = Some((time, v, omega));
            // A last command that is not finite drives nowhere any more.
            (if v.is_finite() && omega.is_finite() { time } else { f64::NAN }, pose)
        }))
    }

    /// The samples: times (s) and poses.
    pub fn samples(&self) -> impl ExactSizeIterator<Item = (f64, SE2)> + '_ {
        self.times.iter().copied().zip(self.poses.iter().copied())
    }

    /// How many gaps there are.
    pub fn gaps(&self) -> usize {
        self.gaps.iter().skip(1).filter(|gap| **gap).count()
    }

    /// The times of its first and last sample, s. None of an empty one.
    pub fn span(&self) -> Option<[f64; 2]> {
        Some([*self.times.first()?, *self.times.last()?])
    }

    /// The usual time between two samples, s; 0 where there are none.
    pub fn usual_step(&self) -> f64 {
        self.usual_step
    }

    /// By how much it has turned at each sample since the first, rad, not wrapped: as if no step turned by more than half a
    /// circle, not even one across a gap.
    pub(super) fn turned(&self) -> Vec<f64> {
        let mut sum = 0.0;
        let steps = self.poses.windows(2).map(|pair| {
            sum += wrap_angle(pair[1].theta() - pair[0].theta());
            sum
        });
        self.poses.first().map(|_| 0.0).into_iter().chain(steps).collect()
    }

    /// Its velocity (m/s ahead and to the left, rad/s) at a sample: the mean over the steps before and after it.
    pub(super) fn velocity(&self, sample: usize) -> Vector3<f64> {
        let from = if sample > 0 && !self.gaps[sample] { sample - 1 } else { sample };
        let next = sample + 1;
        let to = if next < self.times.len() && !self.gaps[next] { next } else { sample };
        if from == to {
            return Vector3::zeros();
        }
        self.velocity_between(from, to)
    }

    fn velocity_between(&self, from: usize, to: usize) -> Vector3<f64> {
        self.poses[to].boxminus(&self.poses[from]) / (self.times[to] - self.times[from])
    }

    /// Half of what its velocity changes by at a sample: the step after it is by so much faster than the mean, and the one before it by as
    /// much slower.
    pub(super) fn kink(&self, sample: usize) -> Vector3<f64> {
        let next = sample + 1;
        if sample == 0 || next == self.times.len() || self.gaps[sample] || self.gaps[next] {
            return Vector3::zeros();
        }
        (self.velocity_between(sample, next) - self.velocity_between(sample - 1, sample)) * 0.5
    }

    /// A sample: its time (s) and its pose.
    pub(super) fn sample(&self, sample: usize) -> (f64, SE2) {
        (self.times[sample], self.poses[sample])
    }

    /// The sample that is next to a time (s); none where there is none within half of a gap.
    pub(super) fn nearest(&self, time: f64) -> Option<usize> {
        let after = self.times.partition_point(|each| *each < time);
        let off = |sample: usize| self.times.get(sample).map_or(f64::INFINITY, |at| (at - time).abs());
        let before = after.saturating_sub(1);
        let nearest = if off(before) < off(after) { before } else { after };
        (off(nearest) <= 0.5 * STEPS_OF_A_GAP * self.usual_step).then_some(nearest)
    }

    /// Whether there is a gap before this sample.
    pub(super) fn has_gap_before(&self, sample: usize) -> bool {
        self.gaps[sample]
    }

    /// Whether nothing is known of some time between these two (s).
    pub fn has_gap(&self, from: f64, to: f64) -> bool {
        let Some((first, last)) = self.times.first().zip(self.times.last()) else { return true };
        if from < *first || to > *last {
            return true;
        }
        let after = self.times.partition_point(|time| *time <= from);
        let end = self.times.partition_point(|time| *time < to);
        self.gaps[after..].iter().take((end + 1).saturating_sub(after)).any(|gap| *gap)
    }

    /// Where the robot is at `time` (s): between two samples on the arc of constant velocities that joins them. None before
    /// the first, after the last, and inside of a gap.
    // Arcs are long code.
    #[inline(never)]
    pub fn pose_at(&self, time: f64) -> Option<SE2> {
        let after = self.times.partition_point(|each| *each < time);
        let (at, pose) = (*self.times.get(after)?, self.poses[after]);
        if at == time {
            return Some(pose);
        }
        let before = after.checked_sub(1).filter(|_| !self.gaps[after])?;
        let share = (time - self.times[before]) / (at - self.times[before]);
        let way = pose.boxminus(&self.poses[before]);
        Some(self.poses[before].boxplus(way * share))
    }

    /// How much of the variance of a sample's own error [`Trajectory::pose_at`] has, where the samples are independent: (1 − s)² + s² at the
    /// share s of the way from one to the next.
    pub(super) fn averaged_at(&self, time: f64) -> f64 {
        let after = self.times.partition_point(|each| *each < time);
        let (Some(at), Some(before)) = (self.times.get(after), after.checked_sub(1)) else { return 1.0 };
        let share = (time - self.times[before]) / (at - self.times[before]);
        (1.0 - share) * (1.0 - share) + share * share
    }
}

/// The one in the middle of positive numbers, as if they were sorted; 0 of none. Positive numbers are in the order of their bits, so
/// that it is found by a quarter of these after the other, from the first: to sort an hour's steps takes longer.
fn middle(numbers: impl ExactSizeIterator<Item = f64> + Clone) -> f64 {
    const QUARTER: u32 = u64::BITS / 4;
    if numbers.len() == 0 {
        return 0.0;
    }
    let (mut found, mut place) = (0, numbers.len() / 2);
    let mut counts = vec![0; 1 << QUARTER];
    for quarter in (0..4).rev() {
        counts.fill(0);
        for bits in numbers.clone().map(f64::to_bits) {
            let begins = bits >> (quarter * QUARTER);
            if begins >> QUARTER == found {
                counts[usize::from(begins as u16)] += 1;
            }
        }
        let mut digit = 0;
        while place >= counts[digit] {
            place -= counts[digit];
            digit += 1;
        }
        found = found << QUARTER | digit as u64;
    }
    f64::from_bits(found)
}

/// In one place: sorting is long code.
#[inline(never)]
pub(crate) fn sort(numbers: &mut [f64]) {
    numbers.sort_unstable_by(f64::total_cmp);
}
