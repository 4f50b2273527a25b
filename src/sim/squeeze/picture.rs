//! Density map of attempts, coloured by their outcome.

use super::driver::Attempt;
use crate::sim::cloud::picture::{Ramp, ramp_step};
use crate::sim::cloud::views::Grid;

/// Number of kinds of outcomes, each with a ramp: rejected, accepted with a free path, and accepted through a wall.
pub const OUTCOME_KIND_COUNT: usize = 3;

impl Attempt {
    /// Returns the index of the attempt's kind of outcome.
    pub fn outcome_kind(&self) -> usize {
        usize::from(self.accepted) + usize::from(self.is_through_wall())
    }
}

/// Paints the ends of attempts, row by row from the top. If several kinds are equally frequent in a cell, the last one is drawn.
pub fn paint_attempts(attempts: &[Attempt], grid: &Grid, ramps: &[Ramp; OUTCOME_KIND_COUNT]) -> Vec<[u8; 4]> {
    let (Grid { min, max, .. }, per_metre) = (*grid, grid.cells_per_unit());
    let mut cell_counts = vec![[0u32; OUTCOME_KIND_COUNT]; grid.columns * grid.rows];
    for attempt in attempts {
        let column = ((attempt.pose.x() - min[0]) * per_metre[0]).floor();
        let row = ((max[1] - attempt.pose.y()) * per_metre[1]).floor();
        if let Some(cell) = grid.cell_index(column, row) {
            cell_counts[cell][attempt.outcome_kind()] += 1;
        }
    }
    let total_count = |counts: &[u32; OUTCOME_KIND_COUNT]| counts.iter().sum::<u32>();
    let highest_count = cell_counts.iter().map(total_count).max().unwrap_or(0);
    let cell_colour = |counts: &[u32; OUTCOME_KIND_COUNT]| {
        let attempt_count = total_count(counts);
        let most_frequent_kind = (0..OUTCOME_KIND_COUNT).max_by_key(|kind| counts[*kind]).unwrap_or(0);
        if attempt_count == 0 {
            [0; 4]
        } else {
            ramps[most_frequent_kind][ramp_step(attempt_count, highest_count)]
        }
    };
    cell_counts.iter().map(cell_colour).collect()
}
