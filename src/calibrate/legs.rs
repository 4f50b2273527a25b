//! A log in pieces as long as those of the filter that is to use the α's.
//!
//! The α's belong to one length of leg: in the tables the variance of a drive grows with the square of its length, that of
//! real wheels mostly with the length itself. What is fitted to legs of a centimetre is wrong for a filter that updates
//! every quarter of a metre.

use super::trajectory::Trajectory;
use crate::geom::se2::{SE2, wrap_angle};

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
    /// Beginning and end, s.
    pub times: [f64; 2],
    /// Both ends in the odometry frame.
    pub odometry: [SE2; 2],
    /// Both ends in the reference’s.
    pub reference: [SE2; 2],
}

/// The legs of a log: one begins where the one before ended. None leads across a gap of either trajectory; the next one
/// begins after it.
pub fn cut(odometry: &Trajectory, reference: &Trajectory, length: LegLength) -> Vec<Leg> {
    let mut legs = Vec::new();
    let mut began: Option<(f64, SE2, SE2)> = None;
    let mut last = f64::NEG_INFINITY;
    for (time, reading) in odometry.samples() {
        let truth = reference.pose_at(time);
        let gap = last.is_finite() && (odometry.has_gap(last, time) || reference.has_gap(last, time));
        last = time;
        let Some(truth) = truth else {
            began = None;
            continue;
        };
        let Some((start_time, start, start_truth)) = began.filter(|_| !gap) else {
            began = Some((time, reading, truth));
            continue;
        };
        if length.ends(time, &reading, (start_time, start)) {
            legs.push(Leg {
                times: [start_time, time],
                odometry: [start, reading],
                reference: [start_truth, truth],
            });
            began = Some((time, reading, truth));
        }
    }
    legs
}
