//! The α's of one log by the length of its legs.
//!
//! In the tables the variance of a drive grows with the square of its length. Where that is so, the α's are the same whatever the
//! legs; where it grows with the length itself, as of a random walk, they fall as 1 over it. Which of the two a robot does only
//! legs of several lengths can tell.

use super::legs::{Leg, LegLength};
use super::profile::Estimate;
use super::trajectory::Trajectory;
use std::f64::consts::PI;

/// How many times as long as asked legs are. Each is twice the one before, for laws of growth are powers; and from end to end they
/// are sixteenfold, over which 1, 1/d and 1/d² are far apart even where an interval's ends are.
pub const FACTORS: [f64; 5] = [0.25, 0.5, ASKED, 2.0, 4.0];

/// The legs that were asked for.
pub(super) const ASKED: f64 = 1.0;

/// What legs of another length say, without the systematic errors that those asked for have told.
#[derive(Clone, Debug, PartialEq)]
pub struct AtLength {
    /// One of [`FACTORS`].
    pub factor: f64,
    /// How many legs were fitted: of more than 20 000 as many are taken evenly.
    pub legs: usize,
    /// None where they are fewer than [`super::FEWEST`], most of them shorter than four rows of the log, or such that turns of more
    /// than half a circle are lost.
    pub estimate: Option<Estimate>,
    /// As that of [`super::Calibration`]: where a few legs are far out and decide, these say so. Empty without an estimate.
    pub bootstrap: Vec<Option<[f64; 2]>>,
}

/// So many legs tell an α to a hundredth, and do not take longer than those that were asked for.
pub(super) const MOST: usize = 20_000;

/// A leg ends at the first row that is beyond its trigger, half a row too late in the mean: of four rows that is an eighth of its
/// length. And between two rows of the reference there is an arc, no robot.
const FEWEST_ROWS: f64 = 4.0;

impl LegLength {
    /// Legs that are so many times as long. None where turns on the spot then would not end one.
    pub(super) fn times(self, factor: f64) -> Option<Self> {
        match self {
            Self::Moved { angle, .. } if angle <= PI && factor * angle > PI => None,
            Self::Moved { distance, angle } => {
                Some(Self::Moved { distance: factor * distance, angle: factor * angle })
            }
            Self::Lasted { duration } => Some(Self::Lasted { duration: factor * duration }),
        }
    }
}

/// Whether most legs are of a few rows of either trajectory.
pub(super) fn have_rows(legs: &[Leg], odometry: &Trajectory, reference: &Trajectory) -> bool {
    // Times are multiples of a step, as far as they are rounded well.
    let shortest = (FEWEST_ROWS - 1e-6) * odometry.usual_step().max(reference.usual_step());
    2 * legs.iter().filter(|leg| leg.duration() >= shortest).count() > legs.len()
}
