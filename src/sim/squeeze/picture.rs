//! Density map of attempts, coloured by their outcome.

use super::driver::Attempt;
use crate::sim::cloud::picture::{Ramp, shade};
use crate::sim::cloud::views::Grid;

/// Outcome of an attempt in the picture. If several kinds are equally frequent in a cell, the last one is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Rejected,
    /// Accepted, and the path was free.
    Free,
    /// Accepted, although the path was blocked.
    ThroughWall,
}

/// Number of kinds.
pub const KINDS: usize = 3;

impl Attempt {
    pub fn kind(&self) -> Kind {
        match (self.accepted, self.path_free) {
            (false, _) => Kind::Rejected,
            (true, true) => Kind::Free,
            (true, false) => Kind::ThroughWall,
        }
    }
}

/// Paints the ends of attempts, row by row from the top.
pub fn paint(attempts: &[Attempt], grid: &Grid, ramps: &[Ramp; KINDS]) -> Vec<[u8; 4]> {
    let (Grid { min, max, .. }, per_metre) = (*grid, grid.cells_per_unit());
    let mut cells = vec![[0u32; KINDS]; grid.columns * grid.rows];
    for attempt in attempts {
        let column = ((attempt.pose.x() - min[0]) * per_metre[0]).floor();
        let row = ((max[1] - attempt.pose.y()) * per_metre[1]).floor();
        if let Some(cell) = grid.index_of(column, row) {
            cells[cell][attempt.kind() as usize] += 1;
        }
    }
    let all = |counts: &[u32; KINDS]| counts.iter().sum::<u32>();
    let most = cells.iter().map(all).max().unwrap_or(0);
    let colour = |counts: &[u32; KINDS]| {
        let count = all(counts);
        let kind = (0..KINDS).max_by_key(|kind| counts[*kind]).unwrap_or(0);
        if count == 0 { [0; 4] } else { ramps[kind][shade(count, most)] }
    };
    cells.iter().map(colour).collect()
}
