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
    /// Both ends in the reference’s.
    pub reference: [SE2; 2],
}

impl Leg {
    /// s.
    pub fn duration(&self) -> f64 {
        self.times[1] - self.times[0]
    }
}

/// The legs of a log: one begins where the one before ended. Where a leg of the odometry led across a gap of either trajectory,
/// or beyond an end of the reference, it is left out.
///
/// `clock_offset` (s) is how far the reference's clock is ahead of the odometry's.
pub fn cut(odometry: &Trajectory, reference: &Trajectory, length: LegLength, clock_offset: f64) -> Vec<Leg> {
    let mut legs = Vec::new();
    let mut began: Option<(usize, f64, SE2)> = None;
    for (sample, (time, reading)) in odometry.samples().enumerate() {
        let Some((first, start_time, start)) = began.filter(|_| !odometry.has_gap_before(sample)) else {
            began = Some((sample, time, reading));
            continue;
        };
        if !length.ends(time, &reading, (start_time, start)) {
            continue;
        }
        began = Some((sample, time, reading));
        let times = [start_time, time];
        let [from, to] = times.map(|time| time + clock_offset);
        if reference.has_gap(from, to) {
            continue;
        }
        let Some((start_truth, truth)) = reference.pose_at(from).zip(reference.pose_at(to)) else { continue };
        legs.push(Leg {
            times,
            odometry: [start, reading],
            velocities: [first, sample].map(|each| odometry.velocity(each)),
            reference: [start_truth, truth],
        });
    }
    legs
}
