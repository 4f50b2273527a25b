//! Many attempts as a density, by what became of them.

use super::driver::Attempt;
use crate::sim::cloud::picture::{Ramp, shade};
use crate::sim::cloud::views::Grid;
use std::collections::TryReserveError;

/// What became of an attempt, as the picture tells it. Of kinds that are as many in a cell, the last one shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Rejected,
    /// Accepted, and the way there was free.
    Free,
    /// Accepted although the way there was not free.
    ThroughWall,
}

/// How many kinds there are.
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

/// Draws densities, in buffers that stay.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// How many of each kind there are in each cell, row by row from the top. All 0 between pictures.
    counts: Vec<[u32; KINDS]>,
    pixels: Vec<[u8; 4]>,
}

impl Picture {
    pub fn paint(
        &mut self,
        attempts: &[Attempt],
        grid: &Grid,
        ramps: &[Ramp; KINDS],
    ) -> Result<&[[u8; 4]], TryReserveError> {
        let Grid { min, max, columns, rows } = *grid;
        let cells = columns * rows;
        self.counts.try_reserve_exact(cells.saturating_sub(self.counts.len()))?;
        self.pixels.try_reserve_exact(cells.saturating_sub(self.pixels.len()))?;
        self.counts.resize(cells, [0; KINDS]);
        self.pixels.resize(cells, [0; 4]);
        let [columns_per_metre, rows_per_metre] =
            [columns as f64 / (max[0] - min[0]), rows as f64 / (max[1] - min[1])];
        for attempt in attempts {
            let column = ((attempt.pose.x() - min[0]) * columns_per_metre).floor();
            let row = ((max[1] - attempt.pose.y()) * rows_per_metre).floor();
            if column >= 0.0 && column < columns as f64 && row >= 0.0 && row < rows as f64 {
                self.counts[row as usize * columns + column as usize][attempt.kind() as usize] += 1;
            }
        }
        let all = |counts: &[u32; KINDS]| counts.iter().sum::<u32>();
        let most = self.counts.iter().map(all).max().unwrap_or(0);
        for (counts, pixel) in self.counts.iter_mut().zip(&mut self.pixels) {
            let count = all(counts);
            let kind = (0..KINDS).max_by_key(|kind| counts[*kind]).unwrap_or(0);
            *pixel = if count == 0 { [0; 4] } else { ramps[kind][shade(count, most)] };
            *counts = [0; KINDS];
        }
        Ok(&self.pixels)
    }
}
