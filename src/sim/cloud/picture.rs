//! The density of a cloud as counts and as an image.

use super::Cloud;
use super::views::{Grid, View};
use crate::geom::lanes::LANES;

/// Colours by the share of the fullest cell, from next to nothing to all: RGBA, each a byte.
pub type Ramp = [[u8; 4]; RAMP];

/// Steps of a ramp: what a byte of alpha can tell apart.
pub const RAMP: usize = 256;

/// Counts the shown samples in each cell, row by row from the top (greatest second coordinate). Those outside count nowhere.
pub fn density(cloud: &Cloud, view: View, grid: &Grid) -> Vec<u32> {
    let Grid { min, max, columns, rows } = *grid;
    let mut counts = vec![0; columns * rows];
    let (width, height) = (columns as f64, rows as f64);
    let [columns_per_unit, rows_per_unit] = [width / (max[0] - min[0]), height / (max[1] - min[1])];
    cloud.each_four(view, |[x, y]| {
        let column = ((x - min[0]) * columns_per_unit).floor().to_array();
        let row = ((max[1] - y) * rows_per_unit).floor().to_array();
        for (column, row) in (0..LANES).map(|lane| (column[lane], row[lane])) {
            if column >= 0.0 && column < width && row >= 0.0 && row < height {
                counts[row as usize * columns + column as usize] += 1;
            }
        }
    });
    counts
}

/// Paints a density, a pixel a cell: ramp[255·√(count/most)], transparent where there is nobody. The square root keeps the
/// thin ends of a cloud visible beside its crowded middle.
pub fn paint(counts: &[u32], ramp: &Ramp) -> Vec<[u8; 4]> {
    let most = counts.iter().copied().max().unwrap_or(0);
    counts.iter().map(|count| if *count == 0 { [0; 4] } else { ramp[shade(*count, most)] }).collect()
}

/// Returns the step of a ramp for a count: 255·√(count/most).
#[inline(always)]
pub fn shade(count: u32, most: u32) -> usize {
    let share = (f64::from(count) / f64::from(most)).sqrt();
    ((RAMP - 1) as f64 * share + 0.5) as usize % RAMP
}
