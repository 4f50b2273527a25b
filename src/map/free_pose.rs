//! Free start pose for a robot that enters a map.

use super::floor_plan::FloorPlan;
use super::occupancy::OccupancyGrid;
use crate::geom::se2::SE2;
use std::f64::consts::TAU;

/// Number of headings that are tried: one every five degrees.
const HEADING_COUNT: u32 = 72;

/// Number of squares along the longer side of a plan without a grid.
const SQUARES_ALONG_SIDE: f64 = 256.0;

impl FloorPlan {
    /// Returns a free pose for a disc of radius `clearance` (m): the centre of the largest square that is known to be free, with the
    /// heading of the longest free path. If the disc does not fit there, takes the first square where it fits; None if it fits nowhere.
    pub fn find_free_pose(&self, clearance: f64) -> Option<SE2> {
        let raster = SquareRaster::of(self);
        let square_middle = raster.middle_of_largest_free_square().map(|middle| raster.point(middle));
        let disc_fits = |point: &[f64; 2]| self.test_point(*point, clearance).free;
        let [x, y] = square_middle.filter(disc_fits).or_else(|| raster.square_middles().find(disc_fits))?;
        Some(SE2::new(x, y, raster.heading_of_longest_path([x, y], disc_fits)))
    }
}

/// A map divided into squares: the cells of its grid, or of a raster over its bounds if it has no grid.
struct SquareRaster<'a> {
    plan: &'a FloorPlan,
    columns: usize,
    rows: usize,
    /// Width and height, m. They are equal, except on a plan that is narrower than one square.
    sides: [f64; 2],
}

impl<'a> SquareRaster<'a> {
    fn of(plan: &'a FloorPlan) -> Self {
        if let Some(grid) = plan.grid() {
            let [columns, rows] = grid.size();
            return Self { plan, columns, rows, sides: [grid.resolution(); 2] };
        }
        let [left, bottom, right, top] = plan.bounds();
        let (width, height) = (right - left, top - bottom);
        let square_side = width.max(height) / SQUARES_ALONG_SIDE;
        let square_sides = [width, height].map(|length| square_side.min(length));
        let [columns, rows] = [width / square_sides[0], height / square_sides[1]].map(|count| count as usize);
        Self { plan, columns, rows, sides: square_sides }
    }

    fn longer_side(&self) -> f64 {
        self.sides[0].max(self.sides[1])
    }

    fn grid(&self) -> Option<&OccupancyGrid> {
        self.plan.grid()
    }

    /// Returns the point at these coordinates, in squares from the lower left corner.
    fn point(&self, [column, row]: [f64; 2]) -> [f64; 2] {
        let [left, bottom, ..] = self.plan.bounds();
        let bounds_point = [left + column * self.sides[0], bottom + row * self.sides[1]];
        self.grid().map_or(bounds_point, |grid| grid.point([column, row]))
    }

    fn square_middles(&self) -> impl Iterator<Item = [f64; 2]> {
        let middle = |i: usize| i as f64 + 0.5;
        (0..self.rows).flat_map(move |row| {
            (0..self.columns).map(move |column| self.point([middle(column), middle(row)]))
        })
    }

    /// Returns true if all of a square is known to be free.
    fn is_free_square(&self, column: usize, row: usize) -> bool {
        if let Some(grid) = self.grid() {
            return grid.is_known_free(column, row);
        }
        let square_middle = self.point([column as f64 + 0.5, row as f64 + 0.5]);
        let is_inside = column < self.columns && row < self.rows;
        is_inside && self.plan.distance_field().lower_bound(square_middle) > 0.75 * self.longer_side()
    }

    /// Returns the middle of the largest square that consists of free squares, in squares from the lower left corner; None if none is
    /// free. Of equally large ones it takes the first, row by row, by their upper right corners.
    fn middle_of_largest_free_square(&self) -> Option<[f64; 2]> {
        let (mut largest_side, mut middle) = (0, None);
        // For each column, the row from which on it has been free so far.
        let mut free_from_row = vec![0u32; self.columns];
        for row in 0..self.rows {
            for (column, first_free_row) in free_from_row.iter_mut().enumerate() {
                if !self.is_free_square(column, row) {
                    *first_free_row = row as u32 + 1;
                }
            }
            // A square with a side of `largest_side + 1` columns and rows ends at this row if it is free from `left` to `right`.
            // Columns below `first_unchecked` were checked already.
            let (mut left, mut first_unchecked) = (0, 0);
            while left + largest_side < self.columns {
                let right = left + largest_side;
                let is_too_short = |column: &usize| free_from_row[*column] as usize + largest_side > row;
                if let Some(short_column) = (left.max(first_unchecked)..=right).rev().find(is_too_short) {
                    (left, first_unchecked) = (short_column + 1, right + 1);
                    continue;
                }
                largest_side += 1;
                let half_side = 0.5 * largest_side as f64;
                middle = Some([right as f64 + 1.0 - half_side, row as f64 + 1.0 - half_side]);
                // The next square has one row more, so that all columns are checked again.
                first_unchecked = 0;
            }
        }
        middle
    }

    /// Returns the heading along which the path over free squares is longest.
    fn heading_of_longest_path(&self, [x, y]: [f64; 2], disc_fits: impl Fn(&[f64; 2]) -> bool) -> f64 {
        let (mut max_steps, mut heading) = (0, 0.0);
        for i in 0..HEADING_COUNT {
            let tried_heading = TAU * f64::from(i) / f64::from(HEADING_COUNT);
            let (sin, cos) = libm::sincos(tried_heading);
            let free_steps = (1..)
                .map(|steps| 0.5 * self.longer_side() * f64::from(steps))
                .map(|length| [x + length * cos, y + length * sin])
                .take_while(|point| self.is_free_at(*point) && disc_fits(point))
                .count();
            if free_steps > max_steps {
                (max_steps, heading) = (free_steps, tried_heading);
            }
        }
        heading
    }

    fn is_free_at(&self, [x, y]: [f64; 2]) -> bool {
        let [left, bottom, ..] = self.plan.bounds();
        let raster_coordinates = [(x - left) / self.sides[0], (y - bottom) / self.sides[1]];
        let [column, row] = self.grid().map_or(raster_coordinates, |grid| grid.cell_coordinates([x, y]));
        column >= 0.0 && row >= 0.0 && self.is_free_square(column as usize, row as usize)
    }
}
