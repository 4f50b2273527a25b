//! How far the nearest wall is, about, from everywhere on a map.

use super::occupancy::OccupancyGrid;
use crate::geom::lanes::{ROUND, lanes};
use crate::geom::segment::Segment;
use std::f64::consts::FRAC_1_SQRT_2;
use wide::f64x4;

/// Square cells over the bounds of a map, and for each the least distance that any of its points has to a wall. It
/// decides most questions about room without looking at a wall, at the same price however many there are.
#[derive(Clone, Debug)]
pub(super) struct DistanceField {
    /// Least x and y.
    corner: [f64; 2],
    cells_per_metre: f64,
    columns: usize,
    /// Index of the last column and of the last row.
    last: [f64; 2],
    /// Half the diagonal of a cell, m.
    radius: f64,
    /// Row by row from the bottom, m. Negative where a wall passes through the cell or its neighbour, −∞ where the cell is
    /// inside of an occupied one, NaN where nothing is known.
    least: Vec<f32>,
}

/// Cells a wall, and of a map at least and at most. Fewer would leave more to be measured, more would take longer to
/// fill: the apartment's cells have sides of 4 cm and take a millisecond, 2²⁰ cells have 4 MB.
const CELLS_A_WALL: f64 = 4096.0;
const MIN_CELLS: f64 = 4096.0;
const MAX_CELLS: f64 = 1_048_576.0;

/// Walls that may be measured for one cell. Where more of them are equally near (a hundred thousand copies of one) the
/// field would take seconds to fill; nothing is known there instead.
const MAX_WALLS_A_CELL: usize = 32;

/// The lower bound where nothing is known.
const UNKNOWN: f32 = f32::MIN;

/// A block of cells is not divided further when the nearest wall is this many times its radius away.
const FAR: f64 = 8.0;

impl DistanceField {
    /// The field of `walls` within `bounds` (least x, least y, greatest x, greatest y; m), and of the cells they outline.
    pub fn new(walls: &[Segment], bounds: [f64; 4], solid: Option<&OccupancyGrid>) -> Self {
        let [left, bottom, right, top] = bounds;
        let (width, height) = (right - left, top - bottom);
        let cells = (CELLS_A_WALL * walls.len() as f64).clamp(MIN_CELLS, MAX_CELLS);
        // A narrow map must not have more cells than that in a single row.
        let side = (width * height / cells).sqrt().max(width.max(height) / cells);
        let [columns, rows] = [width, height].map(|length| (length / side).ceil() as usize + 1);
        let mut filling = Filling {
            field: Self {
                corner: [left, bottom],
                cells_per_metre: 1.0 / side,
                columns,
                last: [columns, rows].map(|count| count as f64 - 1.0),
                radius: FRAC_1_SQRT_2 * side,
                least: vec![UNKNOWN; columns * rows],
            },
            rows,
            side,
            slack: 1e-12 * bounds.iter().fold(0.0, |most: f64, bound| most.max(bound.abs())),
            solid,
            lines: walls.iter().map(Line::new).collect(),
            squares: Vec::new(),
        };
        filling.fill([0, 0], columns.max(rows).next_power_of_two(), 0);
        filling.field
    }

    /// Half the diagonal of a cell, m: how well the field knows where the walls are.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// A lower bound (m) on the distance from a point inside the bounds to the nearest wall.
    #[inline(always)]
    pub fn least(&self, [x, y]: [f64; 2]) -> f64 {
        // A point that rounding has put a little outside belongs to the nearest cell.
        let column = (((x - self.corner[0]) * self.cells_per_metre) as u32 as usize).min(self.columns - 1);
        let row = ((y - self.corner[1]) * self.cells_per_metre) as u32 as usize;
        f64::from(self.least.get(row * self.columns + column).copied().unwrap_or(UNKNOWN))
    }

    /// [`DistanceField::least`] of four points, told by their x and y.
    #[inline(always)]
    pub fn least_of_four(&self, points: &[f64x4; 2]) -> f64x4 {
        let zero = f64x4::splat(0.0);
        // Between two cells either will do, so that it does not matter which of them rounding takes.
        let [column, row] = [0, 1].map(|axis| {
            let cell = (points[axis] - self.corner[axis]) * self.cells_per_metre - 0.5;
            cell.fast_max(zero).fast_min(f64x4::splat(self.last[axis])) + ROUND - ROUND
        });
        // Where a whole number is added to it, it becomes the last bits of the sum.
        let cells = (row * self.columns as f64 + column + ROUND).to_array();
        lanes(|i| f64::from(self.least.get(cells[i].to_bits() as u32 as usize).copied().unwrap_or(UNKNOWN)))
    }

    /// The upper bound (m) that comes with a lower one; −∞ inside of an occupied cell.
    pub fn most(&self, least: f64) -> f64 {
        // With the middle of the cell at distance d from the wall, `least` is d − radius and the upper bound d + radius.
        // In a block that was not divided d is known to d/8: at most (1 + 1/8)/(1 − 1/8) times as far.
        let radius = 1.001 * self.radius;
        let most = (FAR + 1.0) / (FAR - 1.0) * (least + radius) + radius;
        if least == f64::from(UNKNOWN) { f64::INFINITY } else { most }
    }
}

/// A wall, ready to be measured many times.
#[derive(Clone, Copy)]
struct Line {
    from: [f64; 2],
    along: [f64; 2],
    /// 1/|along|²; 0 for a wall without length.
    per_square: f64,
}

impl Line {
    fn new(wall: &Segment) -> Self {
        let along = [wall.to[0] - wall.from[0], wall.to[1] - wall.from[1]];
        let per_square = 1.0 / (along[0] * along[0] + along[1] * along[1]);
        Self { from: wall.from, along, per_square: if per_square.is_finite() { per_square } else { 0.0 } }
    }

    /// The square of the distance to a point, m².
    #[inline(always)]
    fn square(&self, point: [f64; 2]) -> f64 {
        let Self { from, along, per_square } = *self;
        let offset = [point[0] - from[0], point[1] - from[1]];
        let t = ((offset[0] * along[0] + offset[1] * along[1]) * per_square).clamp(0.0, 1.0);
        let [x, y] = [offset[0] - t * along[0], offset[1] - t * along[1]];
        x * x + y * y
    }
}

struct Filling<'a> {
    field: DistanceField,
    rows: usize,
    side: f64,
    /// More than the rounding of any coordinate on the map, m.
    slack: f64,
    solid: Option<&'a OccupancyGrid>,
    /// The walls near the present block, after those near the blocks that it is in.
    lines: Vec<Line>,
    /// The squared distances of `lines` from the middle of the block.
    squares: Vec<f64>,
}

impl Filling<'_> {
    /// Fills a block of `size` · `size` cells from `first` on; the walls that may be the nearest to any of its points are
    /// among `lines` from index `from` on.
    fn fill(&mut self, first: [usize; 2], size: usize, from: usize) {
        let [left, bottom] = first;
        if left >= self.field.columns || bottom >= self.rows {
            return;
        }
        let centre = self.centre(first, size);
        self.squares.clear();
        self.squares.extend(self.lines[from..].iter().map(|line| line.square(centre)));
        let distance = self.squares.iter().copied().fold(f64::INFINITY, f64::min).sqrt();
        let radius = size as f64 * self.field.radius;
        if size > 1 && distance <= FAR * radius {
            let end = self.lines.len();
            if end - from > MAX_WALLS_A_CELL * size * size {
                return;
            }
            let reach = distance + 2.0 * radius + self.slack;
            for (i, square) in self.squares.iter().enumerate() {
                if *square <= reach * reach {
                    self.lines.push(self.lines[from + i]);
                }
            }
            let half = size / 2;
            for [column, row] in [[0, 0], [half, 0], [0, half], [half, half]] {
                self.fill([left + column, bottom + row], half, end);
            }
            self.lines.truncate(end);
            return;
        }
        // No wall passes through the block where this holds, so that all of it is on one side of every outline.
        let buried = distance > radius && self.solid.is_some_and(|solid| solid.holds(centre));
        for row in bottom..(bottom + size).min(self.rows) {
            for column in left..(left + size).min(self.field.columns) {
                let [x, y] = self.centre([column, row], 1);
                let off = self.field.radius
                    + ((x - centre[0]) * (x - centre[0]) + (y - centre[1]) * (y - centre[1])).sqrt();
                // A millionth is more than a float rounds.
                let least =
                    if buried { f64::NEG_INFINITY } else { distance * (1.0 - 1e-6) - off - self.slack };
                self.field.least[row * self.field.columns + column] = least as f32;
            }
        }
    }

    fn centre(&self, first: [usize; 2], size: usize) -> [f64; 2] {
        std::array::from_fn(|axis| {
            self.field.corner[axis] + (first[axis] as f64 + 0.5 * size as f64) * self.side
        })
    }
}
