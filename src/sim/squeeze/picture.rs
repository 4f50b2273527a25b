//! Density map of attempts, coloured by their outcome.

use super::driver::Attempt;
use crate::sim::cloud::picture::{Ramp, ramp_step};
use crate::sim::cloud::views::Grid;

/// Outcome of an attempt in the picture. If several kinds are equally frequent in a cell, the last one is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutcomeKind {
    /// Not accepted.
    Rejected,
    /// Accepted, and the path was free.
    Free,
    /// Accepted, although the path was blocked.
    ThroughWall,
}

/// Number of outcome kinds.
pub const OUTCOME_KIND_COUNT: usize = 3;

impl Attempt {
    /// Returns the kind of the attempt's outcome.
    pub fn outcome_kind(&self) -> OutcomeKind {
        match (self.accepted, self.path_free) {
            (false, _) => OutcomeKind::Rejected,
            (true, true) => OutcomeKind::Free,
            (true, false) => OutcomeKind::ThroughWall,
        }
    }
}

/// Paints the ends of attempts, row by row from the top.
pub fn paint_attempts(attempts: &[Attempt], grid: &Grid, ramps: &[Ramp; OUTCOME_KIND_COUNT]) -> Vec<[u8; 4]> {
    let (Grid { min, max, .. }, per_metre) = (*grid, grid.cells_per_unit());
    let mut cell_counts = vec![[0u32; OUTCOME_KIND_COUNT]; grid.columns * grid.rows];
    for attempt in attempts {
        let column = ((attempt.pose.x() - min[0]) * per_metre[0]).floor();
        let row = ((max[1] - attempt.pose.y()) * per_metre[1]).floor();
        if let Some(cell) = grid.index_of(column, row) {
            cell_counts[cell][attempt.outcome_kind() as usize] += 1;
        }
    }
    let total_count = |counts: &[u32; OUTCOME_KIND_COUNT]| counts.iter().sum::<u32>();
    let highest_count = cell_counts.iter().map(total_count).max().unwrap_or(0);
    let cell_colour = |counts: &[u32; OUTCOME_KIND_COUNT]| {
        let count = total_count(counts);
        let kind = (0..OUTCOME_KIND_COUNT).max_by_key(|kind| counts[*kind]).unwrap_or(0);
        if count == 0 { [0; 4] } else { ramps[kind][ramp_step(count, highest_count)] }
    };
    cell_counts.iter().map(cell_colour).collect()
}
