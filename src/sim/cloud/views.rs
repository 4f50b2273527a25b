//! Views of a cloud, with density and nearest sample.

use crate::sim::settings::Keywords;
use std::ops::RangeInclusive;

/// Coordinates in which the cloud is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// Positions (x, y), m.
    Plane,
    /// Exponential coordinates (along, heading), m and rad.
    Twist,
    /// Points between both, for a morph from 0 (plane) to 1 (twist): see [`crate::geom::unbend`].
    Morph(f64),
}

impl View {
    /// Returns the view at a morph. At 0 and 1 it is exactly the plane and the twists.
    pub fn from_morph(morph: f64) -> Self {
        match morph {
            0.0 => Self::Plane,
            1.0 => Self::Twist,
            _ => Self::Morph(morph),
        }
    }
}

impl Keywords for View {
    const KEYWORDS: &'static [(&'static str, Self)] = &[("plane", Self::Plane), ("twist", Self::Twist)];
}

/// Range of the morph, from the plane to the twists.
pub const MORPH_RANGE: RangeInclusive<f64> = 0.0..=1.0;

/// Range of the coordinates of a view. It includes every position that the largest settings reach.
pub const EXTENT_RANGE: RangeInclusive<f64> = -1e18..=1e18;

/// Largest number of cells of a [`Grid`], beyond any screen. They take 64 MB.
pub const MAX_CELLS: u64 = 1 << 24;

/// Maximum number of rows or columns of a [`Grid`], more than a browser's canvas may have on some devices. Margins of
/// one cell around a longer grid would take more memory than the grid.
pub const MAX_CELLS_PER_SIDE: u64 = 1 << 14;

/// Rectangle of a view, divided into cells of equal size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Smallest coordinates, finite.
    pub min: [f64; 2],
    /// Largest coordinates, finite and above the smallest.
    pub max: [f64; 2],
    /// Number of cells along x.
    pub columns: usize,
    /// Number of cells along y.
    pub rows: usize,
}

impl Grid {
    /// Returns the number of columns for each unit of the first coordinate, and of rows for each of the second.
    pub(in crate::sim) fn cells_per_unit(&self) -> [f64; 2] {
        let Self { min, max, columns, rows } = *self;
        [columns as f64 / (max[0] - min[0]), rows as f64 / (max[1] - min[1])]
    }

    /// Returns the index of the cell in a column and row, row by row from the top; None outside of the grid.
    #[inline(always)]
    pub(in crate::sim) fn index_of(&self, column: f64, row: f64) -> Option<usize> {
        let is_inside = column >= 0.0 && column < self.columns as f64 && row >= 0.0 && row < self.rows as f64;
        is_inside.then(|| row as usize * self.columns + column as usize)
    }
}

/// Search for the point nearest to a target. Points are given one by one.
#[derive(Clone, Copy, Debug)]
pub struct NearestSearch {
    target: [f64; 2],
    radii: [f64; 2],
    min_squared_distance: f64,
    visited_count: usize,
    index: Option<usize>,
}

impl NearestSearch {
    /// Starts a search inside an ellipse with the given radii around the target. Distances are in units of those radii.
    pub fn new(target: [f64; 2], radii: [f64; 2]) -> Self {
        Self { target, radii, min_squared_distance: 1.0, visited_count: 0, index: None }
    }

    /// Compares the next sample with the nearest one so far.
    #[inline(always)]
    pub fn visit_point(&mut self, [x, y]: [f64; 2]) {
        let (dx, dy) = ((x - self.target[0]) / self.radii[0], (y - self.target[1]) / self.radii[1]);
        let squared_distance = dx * dx + dy * dy;
        if squared_distance < self.min_squared_distance
            || (squared_distance == self.min_squared_distance && self.index.is_none())
        {
            self.min_squared_distance = squared_distance;
            self.index = Some(self.visited_count);
        }
        self.visited_count += 1;
    }

    /// Returns the index of the nearest point, in the order in which points were given.
    pub fn index(&self) -> Option<usize> {
        self.index
    }
}
