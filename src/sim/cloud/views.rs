//! Pictures of a cloud, and what is asked of them: where is it dense, which sample is nearest.

use crate::sim::settings::Words;
use std::ops::RangeInclusive;

/// A picture of the cloud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// Positions (x, y), m.
    Plane,
    /// Exponential coordinates (along, heading), m and rad.
    Twist,
    /// Places between the two, at a morph from 0 to 1: see [`crate::geom::unbend`].
    Morph(f64),
}

impl View {
    /// Returns the view at a morph. At the ends it is the plane and the twists, without rounding.
    pub fn at(morph: f64) -> Self {
        match morph {
            0.0 => Self::Plane,
            1.0 => Self::Twist,
            _ => Self::Morph(morph),
        }
    }
}

impl Words for View {
    const WORDS: &'static [(&'static str, Self)] = &[("plane", Self::Plane), ("twist", Self::Twist)];
}

/// Shares of the way from the plane to the twists.
pub const MORPH: RangeInclusive<f64> = 0.0..=1.0;

/// Coordinates that a rectangle of a view may reach: as far as the fastest robot gets in the longest step, and some.
pub const EXTENT: RangeInclusive<f64> = -1e18..=1e18;

/// Largest number of cells of a [`Grid`], beyond any screen. They take 64 MB.
pub const MAX_CELLS: u64 = 1 << 24;

/// Cells of a side of a [`Grid`] at most: more than a browser's canvas may have on some devices. Longer rows or columns would
/// have a frame around them, a cell wide, that takes more memory than they do.
pub const MAX_SIDE: u64 = 1 << 14;

/// A rectangle of a view divided into cells of equal size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Least and greatest coordinates, finite, each least below its greatest.
    pub min: [f64; 2],
    pub max: [f64; 2],
    pub columns: usize,
    pub rows: usize,
}

/// Finds, among points shown to it one after the other, the nearest to a target.
#[derive(Clone, Copy, Debug)]
pub struct Nearest {
    target: [f64; 2],
    radii: [f64; 2],
    least: f64,
    seen: usize,
    index: Option<usize>,
}

impl Nearest {
    /// Looks for the nearest of the points inside the ellipse of the given radii around the target, distances counted in those radii.
    pub fn new(target: [f64; 2], radii: [f64; 2]) -> Self {
        Self { target, radii, least: 1.0, seen: 0, index: None }
    }

    #[inline(always)]
    pub fn see(&mut self, [x, y]: [f64; 2]) {
        let (dx, dy) = ((x - self.target[0]) / self.radii[0], (y - self.target[1]) / self.radii[1]);
        let distance = dx * dx + dy * dy;
        if distance < self.least || (distance == self.least && self.index.is_none()) {
            self.least = distance;
            self.index = Some(self.seen);
        }
        self.seen += 1;
    }

    /// The number of the nearest, from 0 in the order of showing.
    pub fn index(&self) -> Option<usize> {
        self.index
    }
}
