//! Legs: sections of a log, each as long as the motion between two updates of the filter that will use the α's.
//!
//! Fitted α's depend on the length of the legs. In the models the variance of a drive grows with the square of its length. The variance of
//! real wheels mostly grows with the length itself.

use super::Drive;
use super::checks::FailureCause;
use crate::geom::se2::{SE2, wrap_angle};
use crate::models::MAX_SPIN_DISTANCE;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// Relative tolerance on the length of a leg. Equal steps reach the limit exactly, except for rounding. The rounding of text with six decimals
/// is smaller than this tolerance.
const LENGTH_TOLERANCE: f64 = 1e-5;

/// Condition on which a leg ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LegLength {
    /// A leg ends as in AMCL (`update_min_d`, `update_min_a`): at the first odometry reading that is more than `distance` (m) away from its
    /// start, or turned by more than `angle` (rad). The distance is compared along each axis of the odometry frame.
    Displacement {
        /// `update_min_d`, m.
        distance: f64,
        /// `update_min_a`, rad.
        angle: f64,
    },
    /// A leg ends at the first reading after this time (s).
    Duration {
        /// Time, s.
        duration: f64,
    },
}

impl LegLength {
    /// Defaults of AMCL in Navigation2.
    pub const AMCL: Self = Self::Displacement { distance: Self::AMCL_DISTANCE, angle: Self::AMCL_ANGLE };
    /// AMCL's parameter `update_min_d`, m.
    pub const AMCL_DISTANCE: f64 = 0.25;
    /// AMCL's parameter `update_min_a`, rad.
    pub const AMCL_ANGLE: f64 = 0.2;

    /// Returns the displacement, turn or duration of a leg divided by its limit; for a displacement and a turn, the larger quotient.
    pub(super) fn ratio(&self, [start, end]: &[SE2; 2], elapsed_time: f64) -> f64 {
        match *self {
            Self::Displacement { distance, angle } => ((end.x() - start.x()).abs() / distance)
                .max((end.y() - start.y()).abs() / distance)
                .max(wrap_angle(end.theta() - start.theta()).abs() / angle),
            Self::Duration { duration } => elapsed_time / duration,
        }
    }

    /// Returns true if a leg with these start and end poses is complete. Displacements must exceed their limit by more than
    /// [`LENGTH_TOLERANCE`]. Durations may be shorter than their limit by this tolerance.
    fn is_complete(&self, end_poses: &[SE2; 2], elapsed_time: f64) -> bool {
        let excess_ratio = self.ratio(end_poses, elapsed_time) - 1.0;
        match self {
            Self::Displacement { .. } => excess_ratio > LENGTH_TOLERANCE,
            Self::Duration { .. } => excess_ratio >= -LENGTH_TOLERANCE,
        }
    }
}

/// One leg: its motion as measured by the odometry and by the reference.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Leg {
    /// Times of start and end by the clock of the odometry, s.
    pub times: [f64; 2],
    /// Poses at start and end in the odometry frame.
    pub odometry: [SE2; 2],
    /// Velocities at start and end by the odometry: m/s ahead and to the left, rad/s.
    pub velocities: [Vector3<f64>; 2],
    /// Poses at start and end in the frame of the reference.
    pub reference: [SE2; 2],
    /// True if the leg starts at the reference pose at which the previous leg ends.
    pub follows: bool,
    /// Index of the drive to which the leg belongs.
    pub(super) drive: usize,
}

impl Leg {
    /// Duration, s.
    pub fn duration(&self) -> f64 {
        self.times[1] - self.times[0]
    }
}

/// Numbers of legs that were left out, by cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(target_arch = "wasm32", derive(tsify::Tsify))]
#[serde(rename_all = "camelCase")]
pub struct LostLegs {
    /// Legs for which the reference has no pose at the start or at the end.
    pub without_reference: usize,
    /// Legs across a break, at which the pose of a trajectory may have jumped.
    pub across_breaks: usize,
    /// Legs across a pause that are more than twice as long as the options ask for.
    pub across_pauses: usize,
    /// Legs of a standing robot: less than 1 cm and 0.02 rad.
    pub standing: usize,
}

impl LostLegs {
    /// Returns the number of lost legs of all causes.
    pub fn total(&self) -> usize {
        self.without_reference + self.across_breaks + self.across_pauses + self.standing
    }

    /// Returns the most frequent cause. A standing robot needs no remedy, and does not count.
    pub(super) fn main_cause(&self) -> FailureCause {
        if self.without_reference > self.across_breaks.max(self.across_pauses) {
            FailureCause::WithoutReference
        } else if self.across_breaks > self.across_pauses {
            FailureCause::AcrossBreaks
        } else {
            FailureCause::AcrossPauses
        }
    }
}

/// Distance (m) above which the motion of a leg counts as a drive, and turn (rad) above which it counts as a turn.
pub(super) const MIN_DRIVE_DISTANCE: f64 = 0.05;
pub(super) const MIN_TURN_ANGLE: f64 = 0.1;

/// Returns the length of a motion, m.
pub(super) fn distance(motion: &SE2) -> f64 {
    libm::hypot(motion.x(), motion.y())
}

/// Returns the length (m) of a measured motion in the direction of the expected motion.
pub(super) fn distance_along(measured: &SE2, expected: &SE2) -> f64 {
    (measured.x() * expected.x() + measured.y() * expected.y()) / distance(expected)
}

/// Returns the turn of a motion, rad, 0 or more.
pub(super) fn turn(motion: &SE2) -> f64 {
    motion.theta().abs()
}

/// Number of legs below which no fit is tried.
pub const MIN_LEGS: usize = 8;

/// Turn (rad) below which the robot counts as standing during a leg without translation.
const MAX_STANDING_TURN: f64 = 0.02;

/// Maximum ratio of the length of a leg across a pause to the length in the options. Longer legs are left out.
const MAX_RATIO_ACROSS_PAUSE: f64 = 2.0;

#[derive(Clone, Copy, Debug)]
struct LegEnd {
    /// Time and pose of the odometry reading that completes the leg.
    reading: (f64, SE2),
    /// Time by the clock of the odometry, s.
    time: f64,
    odometry: SE2,
    velocity: Vector3<f64>,
    /// Pose by the reference; None if the reference has no sample near the odometry reading.
    reference: Option<SE2>,
}

impl Drive {
    /// Returns the end of a leg at the sample of the reference nearest to a reading of the odometry.
    ///
    /// The odometry is interpolated. An interpolated reference would lose noise of the wheels, and mix the noise of neighbouring legs.
    fn leg_end(&self, reading: (f64, SE2), clock_offset: f64) -> LegEnd {
        let reference_place = self.reference.locate(reading.0 + clock_offset);
        let neighbour_samples = reference_place.map(|(sample_index, fraction)| {
            let previous_index = sample_index.saturating_sub(1);
            if fraction < 0.5 { [previous_index, sample_index] } else { [sample_index, previous_index] }
        });
        let end_at_sample = |sample_index| {
            let (reference_time, pose) = self.reference.sample(sample_index);
            let time = reference_time - clock_offset;
            let (odometry, velocity) = self.odometry.motion_at(time)?;
            Some(LegEnd { reading, time, odometry, velocity, reference: Some(pose) })
        };
        neighbour_samples.into_iter().flatten().find_map(end_at_sample).unwrap_or(LegEnd {
            reading,
            time: reading.0,
            odometry: reading.1,
            velocity: Vector3::zeros(),
            reference: None,
        })
    }

    /// Cuts the drive, which has the index `drive`, into legs. Adds the legs to `legs`, and the numbers of omitted legs to `lost_legs`. Each
    /// leg begins where the previous leg ended.
    ///
    /// `clock_offset` (s) is the time of the reference's clock minus the time of the odometry's clock. A leg may lead across a pause of a
    /// trajectory, because its start and end poses are known, but not across a break.
    pub fn cut_into_legs(
        &self,
        drive: usize,
        leg_length: LegLength,
        clock_offset: f64,
        legs: &mut Vec<Leg>,
        lost_legs: &mut LostLegs,
    ) {
        let Self { odometry, reference } = self;
        let mut leg_start: Option<LegEnd> = None;
        for reading in odometry.samples() {
            let (reading_time, pose) = reading;
            let has_break = leg_start.is_some_and(|start| odometry.has_break(start.time, reading_time));
            lost_legs.across_breaks += usize::from(has_break);
            let Some(start) = leg_start.filter(|_| !has_break) else {
                leg_start = Some(self.leg_end(reading, clock_offset));
                continue;
            };
            let (start_time, start_reading) = start.reading;
            if !leg_length.is_complete(&[start_reading, pose], reading_time - start_time) {
                continue;
            }
            let end = self.leg_end(reading, clock_offset);
            let (times, poses) = ([start.time, end.time], [start.odometry, end.odometry]);
            let motion = start.odometry.motion_to(&end.odometry);
            let is_too_long = leg_length.ratio(&poses, end.time - start.time) > MAX_RATIO_ACROSS_PAUSE;
            // The leg stays open until the reference has another sample, or the leg is too long.
            let is_unknown = end.reference.is_none() && !is_too_long || end.time <= start.time;
            if start.reference.is_some() && is_unknown {
                continue;
            }
            leg_start = Some(end);
            let (Some(start_reference), Some(end_reference)) = (start.reference, end.reference) else {
                lost_legs.without_reference += 1;
                continue;
            };
            if reference.has_break(start.time + clock_offset, end.time + clock_offset) {
                lost_legs.across_breaks += 1;
            } else if is_too_long && odometry.has_gap(start.time, end.time) {
                lost_legs.across_pauses += 1;
            } else if turn(&motion) < MAX_STANDING_TURN && distance(&motion) < MAX_SPIN_DISTANCE {
                lost_legs.standing += 1;
            } else {
                let follows_leg = |before: &Leg| before.drive == drive && before.times[1] == start.time;
                legs.push(Leg {
                    times,
                    odometry: poses,
                    velocities: [start.velocity, end.velocity],
                    reference: [start_reference, end_reference],
                    follows: legs.last().is_some_and(follows_leg),
                    drive,
                });
            }
        }
    }
}
