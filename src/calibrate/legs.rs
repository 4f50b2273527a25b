//! A log in pieces as long as those of the filter that is to use the α's.
//!
//! The α's belong to one length of leg: in the tables the variance of a drive grows with the square of its length, that of
//! real wheels mostly with the length itself. What is fitted to legs of a centimetre is wrong for a filter that updates
//! every quarter of a metre.

use super::trajectory::Trajectory;
use crate::geom::se2::{SE2, wrap_angle};
use nalgebra::Vector3;

/// When a leg ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LegLength {
    /// As in AMCL (`update_min_d`, `update_min_a`): at the first reading that is more than `distance` (m) away in x or in y, each by
    /// itself and along the axes of the odometry frame, or turned by more than `angle` (rad).
    Moved { distance: f64, angle: f64 },
    /// At the first reading after this time (s) or more.
    Lasted { duration: f64 },
}

impl LegLength {
    /// The defaults of AMCL in Navigation2.
    pub const AMCL: Self = Self::Moved { distance: Self::AMCL_DISTANCE, angle: Self::AMCL_ANGLE };
    /// `update_min_d`, m.
    pub const AMCL_DISTANCE: f64 = 0.25;
    /// `update_min_a`, rad.
    pub const AMCL_ANGLE: f64 = 0.2;

    /// How far a leg is, as a share of the trigger that ended it.
    pub(super) fn share_of(&self, leg: &Leg) -> f64 {
        let [from, to] = leg.odometry;
        match *self {
            Self::Moved { distance, angle } => ((to.x() - from.x()).abs() / distance)
                .max((to.y() - from.y()).abs() / distance)
                .max(wrap_angle(to.theta() - from.theta()).abs() / angle),
            Self::Lasted { duration } => leg.duration() / duration,
        }
    }

    fn ends(&self, time: f64, reading: &SE2, began: (f64, SE2)) -> bool {
        let (start_time, start) = began;
        match *self {
            Self::Moved { distance, angle } => {
                (reading.x() - start.x()).abs() > distance
                    || (reading.y() - start.y()).abs() > distance
                    || wrap_angle(reading.theta() - start.theta()).abs() > angle
            }
            // Times are multiples of a step, as far as they are rounded well.
            Self::Lasted { duration } => time - start_time >= duration * (1.0 - 1e-9),
        }
    }
}

/// A motion: what the wheels said of it, and what it was.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Beginning and end by the clock of the odometry, s.
    pub times: [f64; 2],
    /// Both ends in the odometry frame.
    pub odometry: [SE2; 2],
    /// Velocities by the odometry at both ends: m/s ahead and to the left, rad/s.
    pub velocities: [Vector3<f64>; 2],
    /// By how much they are less just before the ends, and more just after them.
    pub(super) kinks: [Vector3<f64>; 2],
    /// Both ends in the reference’s.
    pub reference: [SE2; 2],
    /// How much of the variance of a sample of the reference there is at both ends: all at one, half in the middle between two.
    pub(super) averaged: [f64; 2],
}

impl Leg {
    /// s.
    pub fn duration(&self) -> f64 {
        self.times[1] - self.times[0]
    }
}

/// Fewer than this and halves, blocks and tails would be of single legs.
pub const FEWEST: usize = 8;

/// One end of a leg.
#[derive(Clone, Copy, Debug)]
struct End {
    /// By the clock of the odometry, s.
    time: f64,
    reading: SE2,
    velocity: Vector3<f64>,
    kink: Vector3<f64>,
    truth: SE2,
    averaged: f64,
}

/// A reference with steps that are longer than the odometry's by more than this is the sparser one.
const SPARSER: f64 = 1.5;

/// Both trajectories, and how far (s) the reference's clock is ahead of the odometry's.
struct Log<'a> {
    odometry: &'a Trajectory,
    reference: &'a Trajectory,
    clock_offset: f64,
    /// Whether the reference has fewer samples.
    sparse: bool,
}

impl Log<'_> {
    /// The end of a leg at or next to a reading; none where that is beyond an end of either trajectory or in a gap.
    fn end_at(&self, sample: usize, time: f64, reading: SE2) -> Option<End> {
        let Self { odometry, reference, clock_offset, sparse } = *self;
        if !sparse {
            let truth = reference.pose_at(time + clock_offset)?;
            let averaged = reference.averaged_at(time + clock_offset);
            let (velocity, kink) = (odometry.velocity(sample), odometry.kink(sample));
            return Some(End { time, reading, velocity, kink, truth, averaged });
        }
        let (seen, truth) = reference.sample(reference.nearest(time + clock_offset)?);
        let time = seen - clock_offset;
        let sample = odometry.nearest(time)?;
        let (velocity, kink) = (odometry.velocity(sample), odometry.kink(sample));
        Some(End { time, reading: odometry.pose_at(time)?, velocity, kink, truth, averaged: 1.0 })
    }
}

/// The legs of a log: one begins where the one before ended. Where a leg of the odometry led across a gap of either trajectory,
/// or beyond an end of the reference, it is left out.
///
/// A leg ends at a sample of the trajectory that has fewer of them, for between these nobody knows where the robot was: on the arc from
/// one to the next it would cut corners, and have half of the noise of a leg and half of its neighbour's. Of a reference with
/// fewer samples than the odometry it is the one that is next to the reading.
///
/// `clock_offset` (s) is how far the reference's clock is ahead of the odometry's.
pub fn cut(odometry: &Trajectory, reference: &Trajectory, length: LegLength, clock_offset: f64) -> Vec<Leg> {
    let mut cutting = Cutting::new(length, clock_offset);
    cutting.go_on(odometry, reference, odometry.samples().len());
    cutting.legs
}

/// A log being cut, from its first row on.
#[derive(Clone, Debug)]
pub(super) struct Cutting {
    length: LegLength,
    clock_offset: f64,
    /// The next sample of the odometry.
    next: usize,
    /// The reading with which a leg began, and its end there.
    began: Option<(f64, SE2, Option<End>)>,
    pub legs: Vec<Leg>,
}

impl Cutting {
    pub fn new(length: LegLength, clock_offset: f64) -> Self {
        Self { length, clock_offset, next: 0, began: None, legs: Vec::new() }
    }

    /// Goes on by so many rows of the odometry; whether all of it is cut.
    pub fn go_on(&mut self, odometry: &Trajectory, reference: &Trajectory, rows: usize) -> bool {
        let Self { length, clock_offset, .. } = *self;
        let sparse = reference.usual_step() > SPARSER * odometry.usual_step();
        let log = Log { odometry, reference, clock_offset, sparse };
        let all = odometry.samples().len();
        let until = all.min(self.next + rows);
        for sample in self.next..until {
            let (time, reading) = odometry.sample(sample);
            let Some((start_time, start_reading, start)) =
                self.began.filter(|_| !odometry.has_gap_before(sample))
            else {
                self.began = Some((time, reading, log.end_at(sample, time, reading)));
                continue;
            };
            if !length.ends(time, &reading, (start_time, start_reading)) {
                continue;
            }
            let end = log.end_at(sample, time, reading);
            // A reference that has fewer samples than there are legs ends one as soon as it has another.
            if start.zip(end).is_some_and(|(start, end)| end.time <= start.time) {
                continue;
            }
            self.began = Some((time, reading, end));
            let Some((start, end)) = start.zip(end) else { continue };
            if reference.has_gap(start.time + clock_offset, end.time + clock_offset) {
                continue;
            }
            self.legs.push(Leg {
                times: [start.time, end.time],
                odometry: [start.reading, end.reading],
                velocities: [start.velocity, end.velocity],
                kinks: [start.kink, end.kink],
                reference: [start.truth, end.truth],
                averaged: [start.averaged, end.averaged],
            });
        }
        self.next = until;
        until == all
    }
}
