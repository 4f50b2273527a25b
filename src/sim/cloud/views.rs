//! Grids over parts of a picture of a cloud, and the nearest sample to a point.

use std::ops::RangeInclusive;

/// Range of the stages of the transition of pictures from positions (x, y) (0) to exponential coordinates (along, heading) (1), see
/// [`crate::geom::unbend`].
pub const MORPH_RANGE: RangeInclusive<f64> = 0.0..=1.0;

/// Allowed coordinates of a picture. The range includes every position that the largest settings reach.
pub const EXTENT_RANGE: RangeInclusive<f64> = -1e18..=1e18;

/// Maximum number of cells of a [`ViewGrid`], more than the pixels of any screen. The counts of so many cells take 64 MB.
pub const MAX_CELLS: u64 = 1 << 24;

/// Maximum number of rows or columns of a [`ViewGrid`], more than a browser's canvas may have on some devices. A margin of one cell around
/// a longer, narrow grid would take more memory than the grid.
pub const MAX_CELLS_PER_SIDE: u64 = 1 << 14;

/// Rectangle of a picture, divided into cells of equal size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewGrid {
    /// Smallest coordinates of the rectangle, finite.
    pub min_corner: [f64; 2],
    /// Largest coordinates of the rectangle, finite and above the smallest coordinates.
    pub max_corner: [f64; 2],
    /// Number of cells along x.
    pub column_count: usize,
    /// Number of cells along y.
    pub row_count: usize,
}

impl ViewGrid {
    /// Returns the number of columns per unit of the first coordinate, and of rows per unit of the second coordinate.
    pub(in crate::sim) fn cells_per_unit(&self) -> [f64; 2] {
        let Self { min_corner: [x_min, y_min], max_corner: [x_max, y_max], column_count, row_count } = *self;
        [column_count as f64 / (x_max - x_min), row_count as f64 / (y_max - y_min)]
    }

    /// Returns the index of the cell in a column and row, row by row from the top; None outside of the grid.
    #[inline(always)]
    pub(in crate::sim) fn cell_index(&self, cell_column: f64, cell_row: f64) -> Option<usize> {
        let is_inside = cell_column >= 0.0
            && cell_column < self.column_count as f64
            && cell_row >= 0.0
            && cell_row < self.row_count as f64;
        is_inside.then(|| cell_row as usize * self.column_count + cell_column as usize)
    }
}

/// Returns the index of the point nearest to `target_point` inside the ellipse around it, in units of the ellipse's semi-axes
/// `search_radii`.
pub fn nearest_index(
    candidate_points: impl IntoIterator<Item = [f64; 2]>,
    target_point: [f64; 2],
    search_radii: [f64; 2],
) -> Option<usize> {
    let squared_distance_to = |[x, y]: [f64; 2]| {
        let (dx, dy) = ((x - target_point[0]) / search_radii[0], (y - target_point[1]) / search_radii[1]);
        dx * dx + dy * dy
    };
    let squared_distances = candidate_points.into_iter().map(squared_distance_to).enumerate();
    squared_distances
        .filter(|(_, squared_distance)| *squared_distance <= 1.0)
        .min_by(|(_, a), (_, b)| a.total_cmp(b))
        .map(|(index, _)| index)
}
