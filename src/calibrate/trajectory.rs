//! Trajectories: poses with times.

use crate::geom::se2::{SE2, wrap_angle};
use nalgebra::Vector3;
use thiserror::Error;

/// Poses in one fixed frame, in the order of their times.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// Times (s) in ascending order.
    times: Vec<f64>,
    poses: Vec<SE2>,
    /// Ascending indices of samples before which the pose may have jumped, so that the motion there is unknown.
    breaks: Vec<usize>,
    /// Ascending indices of samples before which poses are unknown: after a break, or after a pause of the recording.
    gaps: Vec<usize>,
    median_period: f64,
}

/// Reason why a sample is not allowed in a trajectory. `sample` is the index (from 0) of the first such sample.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum TrajectoryError {
    /// A time or a coordinate is not finite.
    #[error("sample {sample} has a time or a coordinate that is not finite; allowed are finite numbers")]
    NotFinite {
        /// Index of the sample.
        sample: usize,
    },
    /// The time of the sample is not later than the time of the sample before it.
    #[error("sample {sample} is not later than the one before; allowed are increasing times")]
    NotLater {
        /// Index of the sample.
        sample: usize,
    },
}

/// Number of median periods above which a period is a pause. Shorter gaps are only dropped messages.
const MAX_PERIOD_RATIO: f64 = 5.0;

/// Maximum time (s) between two poses of the integration of a command. Legs end at these poses.
const MAX_COMMAND_STEP: f64 = 0.1;

/// Number of samples that are searched for a time first. Most logs have nearly equal periods, by which the sample is guessed. A search of the
/// whole log needs more memory than the cache of a processor has.
const SEARCH_WIDTH: usize = 64;

impl Trajectory {
    /// Returns the trajectory through `samples`, each a time (s) and a pose.
    ///
    /// # Errors
    /// [`TrajectoryError`] at the first sample that is not finite or not later than the previous sample.
    pub fn new(samples: impl IntoIterator<Item = (f64, SE2)>) -> Result<Self, TrajectoryError> {
        let samples = samples.into_iter();
        let (sample_count, _) = samples.size_hint();
        let (mut times, mut poses) = (Vec::with_capacity(sample_count), Vec::with_capacity(sample_count));
        for (sample, (time, pose)) in samples.enumerate() {
            let pose: SE2 = pose;
            if ![time, pose.x(), pose.y(), pose.theta()].iter().all(|number| number.is_finite()) {
                return Err(TrajectoryError::NotFinite { sample });
            }
            if times.last().is_some_and(|previous_time| time <= *previous_time) {
                return Err(TrajectoryError::NotLater { sample });
            }
            times.push(time);
            poses.push(pose);
        }
        let mut periods: Vec<f64> = times.windows(2).map(|time_pair| time_pair[1] - time_pair[0]).collect();
        let median_period = median(&mut periods);
        let is_pause = |sample: &usize| times[*sample] - times[sample - 1] > MAX_PERIOD_RATIO * median_period;
        let gaps = (1..times.len()).filter(is_pause).collect();
        Ok(Self { times, poses, breaks: Vec::new(), gaps, median_period })
    }

    /// Returns the trajectory with a break before each of `samples`, for example where the reference jumped. No leg leads across a break.
    #[must_use]
    pub fn with_breaks_before(mut self, samples: impl IntoIterator<Item = usize>) -> Self {
        let count = self.times.len();
        self.breaks.extend(samples.into_iter().filter(|sample| (1..count).contains(sample)));
        self.gaps.extend(&self.breaks);
        for samples in [&mut self.breaks, &mut self.gaps] {
            samples.sort_unstable();
            samples.dedup();
        }
        self
    }

    /// Integrates commands from the origin, each (time in s, v in m/s, ω in rad/s) held until the next. While a command is held, poses are
    /// added at most 0.1 s apart, so that there are no pauses.
    ///
    /// # Errors
    /// [`TrajectoryError`] at the first command that is not finite or not later than the previous command.
    pub fn from_commands(
        commands: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Result<Self, TrajectoryError> {
        let commands: Vec<(f64, f64, f64)> = commands.into_iter().collect();
        // A command that is not finite is reported by its own index.
        let command_times = commands.iter().map(|(t, v, omega)| {
            (if v.is_finite() && omega.is_finite() { *t } else { f64::NAN }, SE2::identity())
        });
        let command_step = Self::new(command_times)?.median_period.min(MAX_COMMAND_STEP);
        let (mut integrated_samples, mut pose) = (Vec::with_capacity(commands.len()), SE2::identity());
        for (row, (time, v, omega)) in commands.iter().enumerate() {
            let Some((next_time, ..)) = commands.get(row + 1) else {
                integrated_samples.push((*time, pose));
                break;
            };
            let part_count = ((next_time - time) / (1.5 * command_step)).ceil().clamp(1.0, 1e3);
            let dt = (next_time - time) / part_count;
            for part_index in 0..part_count as usize {
                integrated_samples.push((time + part_index as f64 * dt, pose));
                pose = pose.boxplus(Vector3::new(v * dt, 0.0, omega * dt));
            }
        }
        Ok(Self { gaps: Vec::new(), ..Self::new(integrated_samples)? })
    }

    /// Returns the times (s) and poses of all samples.
    pub fn samples(&self) -> impl ExactSizeIterator<Item = (f64, SE2)> + '_ {
        self.times.iter().copied().zip(self.poses.iter().copied())
    }

    /// Returns the times (s) of the first and the last sample; None for an empty trajectory.
    pub fn span(&self) -> Option<[f64; 2]> {
        Some([*self.times.first()?, *self.times.last()?])
    }

    /// Returns the median time between two samples, s; 0 of fewer than two samples.
    pub fn median_period(&self) -> f64 {
        self.median_period
    }

    /// Returns the unwrapped heading (rad) of each sample, relative to the first sample. Each step must turn by less than half a circle.
    pub(super) fn unwrapped_heading(&self) -> Vec<f64> {
        let mut heading = 0.0;
        let heading_steps = self.poses.windows(2).map(|pose_pair| {
            heading += wrap_angle(pose_pair[1].theta() - pose_pair[0].theta());
            heading
        });
        self.poses.first().map(|_| 0.0).into_iter().chain(heading_steps).collect()
    }

    /// Returns the pose and the velocity (m/s ahead and to the left, rad/s) at a time (s). Between two samples the pose lies on the arc of
    /// constant velocities that joins them. None outside of the trajectory and inside of a gap.
    ///
    /// The velocity is interpolated between the samples before and after the time. Noise of a step is both in its velocity and in the residuals
    /// of legs. A velocity from one side of a leg's end only would correlate with the residual of one leg, and bias the clock offset.
    // The function is not inlined, because two copies would make the module larger.
    #[inline(never)]
    pub fn motion_at(&self, time: f64) -> Option<(SE2, Vector3<f64>)> {
        let (sample_index, fraction) = self.locate(time)?;
        let (pose, velocity) = (self.poses[sample_index], self.velocity_of_sample(sample_index));
        if fraction == 1.0 {
            return Some((pose, velocity));
        }
        let previous_pose = self.poses[sample_index - 1];
        let pose_at_time = previous_pose.boxplus(pose.boxminus(&previous_pose) * fraction);
        Some((pose_at_time, self.velocity_of_sample(sample_index - 1).lerp(&velocity, fraction)))
    }

    /// Returns the mean velocity over the steps before and after a sample.
    fn velocity_of_sample(&self, sample_index: usize) -> Vector3<f64> {
        let is_known_step =
            |end: &usize| (1..self.times.len()).contains(end) && self.gaps.binary_search(end).is_err();
        let known_steps = [sample_index, sample_index + 1].map(|end| usize::from(is_known_step(&end)));
        let (first_sample, end_sample) = (sample_index - known_steps[0], sample_index + known_steps[1]);
        if first_sample == end_sample {
            return Vector3::zeros();
        }
        self.poses[end_sample].boxminus(&self.poses[first_sample])
            / (self.times[end_sample] - self.times[first_sample])
    }

    /// Returns true if a pause of the recording, or a break, is between two times (s).
    pub(super) fn has_gap(&self, start_time: f64, end_time: f64) -> bool {
        self.has_any_between(&self.gaps, start_time, end_time)
    }

    pub(super) fn has_break(&self, start_time: f64, end_time: f64) -> bool {
        self.has_any_between(&self.breaks, start_time, end_time)
    }

    /// Returns true if the step to one of `samples` overlaps the time between two times (s).
    fn has_any_between(&self, samples: &[usize], start_time: f64, end_time: f64) -> bool {
        let next_index = samples.partition_point(|sample| self.times[*sample] <= start_time);
        samples.get(next_index).is_some_and(|sample| self.times[sample - 1] < end_time)
    }

    /// Returns the first sample that is not earlier than `time` (s), and the elapsed fraction of the step to this sample; 1 at the sample.
    /// None outside of the trajectory and inside of a gap.
    pub(super) fn locate(&self, time: f64) -> Option<(usize, f64)> {
        let ([start, end], is_earlier) = (self.span()?, |row_time: &f64| *row_time < time);
        let guess = ((time - start) / (end - start) * self.times.len() as f64) as usize;
        let first = guess.min(self.times.len()).saturating_sub(SEARCH_WIDTH / 2);
        let sample = match self.times.get(first..first + SEARCH_WIDTH) {
            Some(near @ [before, .., after]) if is_earlier(before) && !is_earlier(after) => {
                first + near.partition_point(is_earlier)
            }
            _ => self.times.partition_point(is_earlier),
        };
        let time_after = *self.times.get(sample)?;
        if time_after == time {
            return Some((sample, 1.0));
        }
        let time_before =
            self.times[sample.checked_sub(1).filter(|_| self.gaps.binary_search(&sample).is_err())?];
        Some((sample, (time - time_before) / (time_after - time_before)))
    }

    pub(super) fn sample(&self, sample: usize) -> (f64, SE2) {
        (self.times[sample], self.poses[sample])
    }
}

/// Returns the upper median; 0 if there are no numbers. Reorders the numbers.
pub(crate) fn median(numbers: &mut [f64]) -> f64 {
    let middle_index = numbers.len() / 2;
    if numbers.is_empty() { 0.0 } else { *numbers.select_nth_unstable_by(middle_index, f64::total_cmp).1 }
}
