//! Density of a cloud, as counts and as an image.

use super::Cloud;
use super::views::{View, ViewGrid};
use crate::geom::lanes::LANE_COUNT;

/// Colour ramp (RGBA, one byte each) by the count of a cell relative to the largest count.
pub type Ramp = [[u8; 4]; RAMP_STEP_COUNT];

/// Number of steps of a ramp, one for each value of a byte.
pub const RAMP_STEP_COUNT: usize = 256;

/// Counts the shown samples in each cell, row by row from the top (largest second coordinate). Samples outside are not counted.
pub fn count_samples_in_cells(cloud: &Cloud, view: View, grid: &ViewGrid) -> Vec<u32> {
    let (ViewGrid { min_corner, max_corner, .. }, cells_per_unit) = (*grid, grid.cells_per_unit());
    let mut cell_counts = vec![0; grid.columns * grid.rows];
    cloud.point_groups(view).for_each(|[x, y]| {
        let column = ((x - min_corner[0]) * cells_per_unit[0]).floor().to_array();
        let row = ((max_corner[1] - y) * cells_per_unit[1]).floor().to_array();
        for cell_index in (0..LANE_COUNT).filter_map(|lane| grid.cell_index(column[lane], row[lane])) {
            cell_counts[cell_index] += 1;
        }
    });
    cell_counts
}

/// Paints the counts of the cells of a grid, one pixel for each cell: ramp[255·√(count/max_count)], transparent for empty cells. With the
/// square root the sparse ends of a cloud stay visible.
pub fn paint_cell_counts(counts: &[u32], ramp: &Ramp) -> Vec<[u8; 4]> {
    let max_count = counts.iter().copied().max().unwrap_or(0);
    counts.iter().map(|count| if *count == 0 { [0; 4] } else { ramp[ramp_step(*count, max_count)] }).collect()
}

/// Returns the index in a colour ramp for a count: 255·√(count/max_count).
#[inline(always)]
pub fn ramp_step(count: u32, max_count: u32) -> usize {
    let root_of_fraction = (f64::from(count) / f64::from(max_count)).sqrt();
    ((RAMP_STEP_COUNT - 1) as f64 * root_of_fraction + 0.5) as usize % RAMP_STEP_COUNT
}
