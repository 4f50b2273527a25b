//! The density of a cloud as an image, in buffers that stay.

use super::Cloud;
use super::views::{Grid, View};
use std::collections::TryReserveError;
use wide::{f64x4, u32x4};

/// Colours by the share of the fullest cell, from next to nothing to all: RGBA, each a byte.
pub type Ramp = [[u8; 4]; RAMP];

/// Steps of a ramp: what a byte of alpha can tell apart.
pub const RAMP: usize = 256;

/// Counts up to here have their colour looked up; the few cells that hold more have it computed.
const TABLE: usize = 4096;

/// Draws densities.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// One a cell, row by row from the top, inside a frame a cell wide for all that is outside. All 0 between pictures.
    counts: Vec<u32>,
    pixels: Vec<[u8; 4]>,
    /// The colour of a count.
    table: Vec<[u8; 4]>,
}

/// 2⁵²: from here on the last bit of a double is worth 1.
const UNITS: f64 = 4_503_599_627_370_496.0;

/// Cells that are skipped together where all are empty, as most are.
const RUN: usize = 16;

impl Picture {
    /// Counts the samples in each cell.
    fn count(&mut self, cloud: &Cloud, view: View, grid: &Grid) -> Result<(), TryReserveError> {
        let cells = (grid.columns + 2) * (grid.rows + 2);
        self.counts.try_reserve_exact(cells.saturating_sub(self.counts.len()))?;
        self.counts.resize(cells, 0);
        let (columns, rows) = (grid.columns as f64, grid.rows as f64);
        let columns_per_unit = columns / (grid.max[0] - grid.min[0]);
        let rows_per_unit = rows / (grid.max[1] - grid.min[1]);
        let stride = columns + 2.0;
        let before = f64x4::splat(-1.0);
        let counts = self.counts.as_mut_slice();
        cloud.each_four(view, |[x, y]| {
            let column = (x - grid.min[0]) * columns_per_unit;
            let row = (grid.max[1] - y) * rows_per_unit;
            let column = column.fast_max(before).fast_min(f64x4::splat(columns)).floor();
            let row = row.fast_max(before).fast_min(f64x4::splat(rows)).floor();
            let cell = row * stride + (column + (UNITS + stride + 1.0));
            for cell in cell.to_array() {
                if let Some(count) = counts.get_mut(cell.to_bits() as u32 as usize) {
                    *count += 1;
                }
            }
        });
        Ok(())
    }

    /// How many of the shown samples lie in each cell, row by row from the top (greatest second coordinate). Those
    /// outside count nowhere.
    ///
    /// # Errors
    /// Where memory does not suffice for the cells.
    pub fn density(&mut self, cloud: &Cloud, view: View, grid: &Grid) -> Result<Vec<u32>, TryReserveError> {
        let mut cells = Vec::new();
        cells.try_reserve_exact(grid.columns * grid.rows)?;
        self.count(cloud, view, grid)?;
        cells.extend(rows_of(&mut self.counts, grid).flat_map(|row| row.iter().copied()));
        self.counts.fill(0);
        Ok(cells)
    }

    /// The density in colours, a pixel a cell: ramp[255·√(count/most)], transparent where there is nobody. The square root
    /// keeps the thin ends of a cloud visible beside its crowded middle.
    ///
    /// # Errors
    /// Where memory does not suffice for the cells.
    pub fn paint(
        &mut self,
        cloud: &Cloud,
        view: View,
        grid: &Grid,
        ramp: &Ramp,
    ) -> Result<&[[u8; 4]], TryReserveError> {
        let cells = grid.columns * grid.rows;
        self.pixels.try_reserve_exact(cells.saturating_sub(self.pixels.len()))?;
        self.table.try_reserve_exact((TABLE + 1).saturating_sub(self.table.len()))?;
        self.count(cloud, view, grid)?;
        self.pixels.resize(cells, [0; 4]);
        let most = most_of(rows_of(&mut self.counts, grid));
        let colour = |count: u32| ramp[shade(count, most)];
        self.table.clear();
        self.table.push([0; 4]);
        self.table.extend((1..=most.min(TABLE as u32)).map(colour));
        let table = self.table.as_slice();
        for (counts, pixels) in
            rows_of(&mut self.counts, grid).zip(self.pixels.chunks_exact_mut(grid.columns))
        {
            for (counts, pixels) in counts.chunks_mut(RUN).zip(pixels.chunks_mut(RUN)) {
                if is_empty(counts) {
                    pixels.fill([0; 4]);
                    continue;
                }
                for (count, pixel) in counts.iter_mut().zip(pixels) {
                    *pixel = table.get(*count as usize).copied().unwrap_or_else(|| colour(*count));
                    *count = 0;
                }
            }
        }
        clear_frame(&mut self.counts, grid);
        Ok(&self.pixels)
    }
}

/// The step of a ramp for a count: 255·√(count/most).
#[inline(always)]
pub fn shade(count: u32, most: u32) -> usize {
    let share = (f64::from(count) / f64::from(most)).sqrt();
    ((RAMP - 1) as f64 * share + 0.5) as usize % RAMP
}

/// The fullest cell of some rows.
fn most_of<'a>(rows: impl Iterator<Item = &'a mut [u32]>) -> u32 {
    let (mut most, mut most_of_rest) = (u32x4::splat(0), 0);
    for row in rows {
        let (fours, rest) = row.as_chunks();
        most = fours.iter().fold(most, |most, four| most.max(u32x4::new(*four)));
        most_of_rest = rest.iter().fold(most_of_rest, |most, count| most.max(*count));
    }
    most.to_array().into_iter().fold(most_of_rest, u32::max)
}

/// Whether nobody is in any cell.
fn is_empty(counts: &[u32]) -> bool {
    let (fours, rest) = counts.as_chunks();
    let all = fours.iter().fold(u32x4::splat(0), |all, four| all | u32x4::new(*four));
    all == u32x4::splat(0) && rest.iter().all(|count| *count == 0)
}

/// The rows of counts without their frame.
fn rows_of<'a>(counts: &'a mut [u32], grid: &Grid) -> impl Iterator<Item = &'a mut [u32]> {
    let Grid { columns, rows, .. } = *grid;
    counts.chunks_exact_mut(columns + 2).skip(1).take(rows).map(move |row| &mut row[1..=columns])
}

fn clear_frame(counts: &mut [u32], grid: &Grid) {
    let last = grid.rows + 1;
    for (i, row) in counts.chunks_exact_mut(grid.columns + 2).enumerate() {
        if i == 0 || i == last {
            row.fill(0);
        }
        (row[0], row[grid.columns + 1]) = (0, 0);
    }
}
