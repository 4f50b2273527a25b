//! Density of a cloud, as counts and as an image.

use super::Cloud;
use super::views::ViewGrid;
use crate::geom::lanes::LANE_COUNT;

/// Colour ramp (RGBA, one byte each) by the number of samples in a cell relative to the largest number.
pub type Ramp = [[u8; 4]; RAMP_STEP_COUNT];

/// Number of colours of a ramp, one for each value of a byte.
pub const RAMP_STEP_COUNT: usize = 256;

/// Counts the shown samples in each cell, row by row from the top (largest second coordinate). Samples outside of the grid are not counted.
pub fn count_samples_in_cells(pose_cloud: &Cloud, morph_fraction: f64, view_grid: &ViewGrid) -> Vec<u32> {
    let (ViewGrid { min_corner, max_corner, .. }, cells_per_unit) = (*view_grid, view_grid.cells_per_unit());
    let mut cell_counts = vec![0; view_grid.column_count * view_grid.row_count];
    pose_cloud.point_groups(morph_fraction).for_each(|[x, y]| {
        let cell_columns = ((x - min_corner[0]) * cells_per_unit[0]).floor().to_array();
        let cell_rows = ((max_corner[1] - y) * cells_per_unit[1]).floor().to_array();
        for cell_index in (0..LANE_COUNT)
            .filter_map(|lane_index| view_grid.cell_index(cell_columns[lane_index], cell_rows[lane_index]))
        {
            cell_counts[cell_index] += 1;
        }
    });
    cell_counts
}

/// Paints the counts of the cells of a grid, one pixel for each cell, with a ramp for each of `K` kinds of samples. The most frequent kind
/// in a cell selects the ramp. Of several equally frequent kinds, the last one counts. The colour is ramp[255·√(count/max_count)], where
/// `count` is the number of samples of all kinds. With the square root the sparse ends of a cloud stay visible. Empty cells are
/// transparent.
pub fn paint_cell_counts<const K: usize>(counts_of_cells: &[[u32; K]], ramps: &[Ramp; K]) -> Vec<[u8; 4]> {
    let total_count_of = |kind_counts: &[u32; K]| kind_counts.iter().sum::<u32>();
    let max_count = counts_of_cells.iter().map(total_count_of).max().unwrap_or(0);
    let colour_of = |kind_counts: &[u32; K]| {
        let total_count = total_count_of(kind_counts);
        if total_count == 0 {
            return [0; 4];
        }
        let most_frequent_kind = (0..K).max_by_key(|kind_index| kind_counts[*kind_index]).unwrap_or(0);
        ramps[most_frequent_kind][ramp_step(total_count, max_count)]
    };
    counts_of_cells.iter().map(colour_of).collect()
}

#[inline(always)]
fn ramp_step(sample_count: u32, max_count: u32) -> usize {
    let root_of_fraction = (f64::from(sample_count) / f64::from(max_count)).sqrt();
    ((RAMP_STEP_COUNT - 1) as f64 * root_of_fraction + 0.5) as usize % RAMP_STEP_COUNT
}
