//! Free start pose for a robot that enters a map.

use super::floor_plan::FloorPlan;
use super::occupancy::OccupancyGrid;
use crate::geom::se2::SE2;
use std::f64::consts::TAU;

/// Number of headings that are tried, one in five degrees.
const HEADINGS: u32 = 72;

/// Number of squares along the longer side of a plan without a grid.
const SQUARES: f64 = 256.0;

impl FloorPlan {
    /// Returns a free pose for a disc of radius `clearance` (m): the centre of the largest square that is known to be free, in the heading
    /// with the longest free path. If the disc does not fit there, the first place where it fits; None if it fits nowhere.
    pub fn open_place(&self, clearance: f64) -> Option<SE2> {
        let squares = Squares::of(self);
        let open = squares.middle_of_largest().map(|middle| squares.point(middle));
        let fits = |point: &[f64; 2]| self.point_free(*point, clearance).free;
        let [x, y] = open.filter(fits).or_else(|| squares.middles().find(fits))?;
        Some(SE2::new(x, y, squares.heading_of_longest_path([x, y], fits)))
    }
}

/// A map in squares: the cells of its grid, or those of a raster over its bounds.
struct Squares<'a> {
    plan: &'a FloorPlan,
    columns: usize,
    rows: usize,
    /// Width and height, m. They are equal, except on a plan that is narrower than one square.
    sides: [f64; 2],
}

impl<'a> Squares<'a> {
    fn of(plan: &'a FloorPlan) -> Self {
        if let Some(grid) = plan.grid() {
            let [columns, rows] = grid.size();
            return Self { plan, columns, rows, sides: [grid.resolution(); 2] };
        }
        let [left, bottom, right, top] = plan.bounds();
        let (width, height) = (right - left, top - bottom);
        let side = width.max(height) / SQUARES;
        let sides = [width, height].map(|length| side.min(length));
        let [columns, rows] = [width / sides[0], height / sides[1]].map(|count| count as usize);
        Self { plan, columns, rows, sides }
    }

    fn longer_side(&self) -> f64 {
        self.sides[0].max(self.sides[1])
    }

    fn grid(&self) -> Option<&OccupancyGrid> {
        self.plan.grid()
    }

    /// Returns the point at these coordinates, in squares from the lower left corner.
    fn point(&self, at: [f64; 2]) -> [f64; 2] {
        let [left, bottom, ..] = self.plan.bounds();
        let on_plan = [left + at[0] * self.sides[0], bottom + at[1] * self.sides[1]];
        self.grid().map_or(on_plan, |grid| grid.point(at))
    }

    fn middles(&self) -> impl Iterator<Item = [f64; 2]> {
        let middle = |i: usize| i as f64 + 0.5;
        (0..self.rows).flat_map(move |row| {
            (0..self.columns).map(move |column| self.point([middle(column), middle(row)]))
        })
    }

    /// Returns true if all of a square is known to be free.
    fn free(&self, column: usize, row: usize) -> bool {
        if let Some(grid) = self.grid() {
            return grid.is_known_free(column, row);
        }
        let middle = self.point([column as f64 + 0.5, row as f64 + 0.5]);
        let is_inside = column < self.columns && row < self.rows;
        is_inside && self.plan.field().lower_bound(middle) > 0.75 * self.longer_side()
    }

    /// Returns the middle of the largest square of free ones, in squares from the lower left corner; None where none is
    /// free. Of several, that of the first upper right corner, row by row.
    fn middle_of_largest(&self) -> Option<[f64; 2]> {
        let (mut largest, mut middle) = (0, None);
        // Row from which on each column has been free so far.
        let mut free_from = vec![0u32; self.columns];
        for row in 0..self.rows {
            for (column, from) in free_from.iter_mut().enumerate() {
                if !self.free(column, row) {
                    *from = row as u32 + 1;
                }
            }
            // A square with a side of `largest + 1` ends at this row if each column from `left` to `right` has been free for as many rows.
            // Columns below `open` were checked already.
            let (mut left, mut open) = (0, 0);
            while left + largest < self.columns {
                let right = left + largest;
                let is_short = |column: &usize| free_from[*column] as usize + largest > row;
                if let Some(short) = (left.max(open)..=right).rev().find(is_short) {
                    (left, open) = (short + 1, right + 1);
                    continue;
                }
                largest += 1;
                let half = 0.5 * largest as f64;
                middle = Some([right as f64 + 1.0 - half, row as f64 + 1.0 - half]);
                // The next side is longer by one row, so that all columns are checked again.
                open = 0;
            }
        }
        middle
    }

    /// Returns the heading in which the robot gets furthest over free squares.
    fn heading_of_longest_path(&self, [x, y]: [f64; 2], fits: impl Fn(&[f64; 2]) -> bool) -> f64 {
        let (mut longest, mut heading) = (0, 0.0);
        for i in 0..HEADINGS {
            let angle = TAU * f64::from(i) / f64::from(HEADINGS);
            let (sin, cos) = libm::sincos(angle);
            let way = (1..)
                .map(|steps| 0.5 * self.longer_side() * f64::from(steps))
                .map(|length| [x + length * cos, y + length * sin])
                .take_while(|point| self.free_at(*point) && fits(point))
                .count();
            if way > longest {
                (longest, heading) = (way, angle);
            }
        }
        heading
    }

    fn free_at(&self, [x, y]: [f64; 2]) -> bool {
        let [left, bottom, ..] = self.plan.bounds();
        let on_plan = [(x - left) / self.sides[0], (y - bottom) / self.sides[1]];
        let [column, row] = self.grid().map_or(on_plan, |grid| grid.cell_coordinates([x, y]));
        column >= 0.0 && row >= 0.0 && self.free(column as usize, row as usize)
    }
}
