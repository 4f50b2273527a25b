//! Occupancy grids as ROS `map_server` stores them.

use crate::geom::arc::Departure;
use crate::geom::se2::SE2;
use crate::geom::segment::Segment;
use std::ops::RangeInclusive;

/// How pixels become cells, as `map_server` reads its YAML file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interpretation {
    pub mode: Mode,
    /// Dark pixels are free instead of occupied.
    pub negate: bool,
    /// A cell is occupied where its occupancy, 0 (white) to 1 (black), exceeds this.
    pub occupied_thresh: f64,
}

/// What `map_server` takes where its YAML file says nothing.
impl Default for Interpretation {
    fn default() -> Self {
        Self { mode: Mode::Trinary, negate: false, occupied_thresh: 0.65 }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Pixels darker than the threshold are occupied.
    Trinary,
    /// As [`Mode::Trinary`], and transparent pixels are unknown.
    Scale,
    /// Pixel values are occupancies from 0 to 100; 100 is occupied.
    Raw,
}

/// A picture of shades from 0 (black) to 1 (white), row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    pub width: usize,
    pub height: usize,
    /// width · height of them.
    pub pixels: Vec<Pixel>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Mean of the colours.
    pub shade: f32,
    /// From 0 (transparent) to 1.
    pub opacity: f32,
}

impl Interpretation {
    pub fn occupied(&self, pixel: Pixel) -> bool {
        let Pixel { shade, opacity } = pixel;
        let occupancy = if self.negate { shade } else { 1.0 - shade };
        // Rounded as the shade is, so that a pixel at the threshold is not above it.
        let threshold = self.occupied_thresh as f32;
        match self.mode {
            Mode::Trinary => occupancy > threshold,
            Mode::Scale => opacity == 1.0 && occupancy > threshold,
            Mode::Raw => (shade * 255.0).round() == 100.0,
        }
    }
}

/// Sides of a cell, m: from a millimetre to a hundred metres.
pub const RESOLUTION: RangeInclusive<f64> = 1e-3..=100.0;

/// Square cells, occupied or not. Cells that are free and cells of which nothing is known are alike: only occupied ones
/// are in a robot's way.
#[derive(Clone, Debug, PartialEq)]
pub struct OccupancyGrid {
    width: usize,
    height: usize,
    /// Side of a cell, m.
    resolution: f64,
    /// The lower left corner of the lower left cell, rows and columns along its axes.
    origin: SE2,
    /// The plane in the frame of the origin.
    to_local: Departure,
    /// Row by row from the bottom.
    occupied: Vec<bool>,
}

impl OccupancyGrid {
    /// The grid of an image whose lower left corner is at `origin`, with cells of `resolution` (m, positive).
    ///
    /// As in `map_server`, opacity counts as a fourth colour in mode trinary if the image has transparency.
    pub fn new(image: &Image, interpretation: &Interpretation, resolution: f64, origin: SE2) -> Self {
        let Image { width, height, ref pixels } = *image;
        let transparent = pixels.iter().any(|pixel| pixel.opacity < 1.0);
        let four_colours = interpretation.mode == Mode::Trinary && transparent;
        let seen = |pixel: &Pixel| match *pixel {
            Pixel { shade, opacity } if four_colours => {
                Pixel { shade: (3.0 * shade + opacity) / 4.0, opacity }
            }
            opaque => opaque,
        };
        let occupied = pixels
            .chunks(width.max(1))
            .rev()
            .flat_map(|row| row.iter().map(|pixel| interpretation.occupied(seen(pixel))))
            .collect();
        Self { width, height, resolution, origin, to_local: Departure::new(origin.inverse()), occupied }
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Side of a cell, m.
    pub fn resolution(&self) -> f64 {
        self.resolution
    }

    /// The lower left corner of the lower left cell, rows and columns along its axes.
    pub fn origin(&self) -> SE2 {
        self.origin
    }

    /// Whether each cell is occupied, row by row from the bottom.
    pub fn occupied(&self) -> &[bool] {
        &self.occupied
    }

    /// Whether a point of the plane lies in an occupied cell.
    pub fn holds(&self, point: [f64; 2]) -> bool {
        let [column, row] = self.cell_coordinates(point).map(f64::floor);
        column >= 0.0 && row >= 0.0 && self.cell(column as usize, row as usize)
    }

    /// Whether a point of the plane lies on the grid, its edge included.
    pub fn spans(&self, point: [f64; 2]) -> bool {
        let [column, row] = self.cell_coordinates(point);
        (0.0..=self.width as f64).contains(&column) && (0.0..=self.height as f64).contains(&row)
    }

    /// The corners of the grid, counter-clockwise from the origin.
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let (width, height) = (self.width, self.height);
        [(0, 0), (width, 0), (width, height), (0, height)].map(|(column, row)| self.corner(column, row))
    }

    fn corner(&self, column: usize, row: usize) -> [f64; 2] {
        let (x, y) = (column as f64 * self.resolution, row as f64 * self.resolution);
        let point = self.origin * SE2::new(x, y, 0.0);
        [point.x(), point.y()]
    }

    fn cell_coordinates(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        self.to_local.transform([x, y]).map(|coordinate| coordinate / self.resolution)
    }

    fn cell(&self, column: usize, row: usize) -> bool {
        column < self.width && row < self.height && self.occupied[row * self.width + column]
    }

    /// The outlines of the occupied cells, neighbouring sides joined: the distance to them is the distance to the cells
    /// for everyone outside of one.
    ///
    /// # Errors
    /// How many there are so far, once there are more than `most`.
    pub fn outlines(&self, most: usize) -> Result<Vec<Segment>, usize> {
        let mut sides = Vec::new();
        // Between cells on either side of a grid line there is an outline where just one is occupied.
        let before = |i: usize| i.wrapping_sub(1);
        for row in 0..=self.height {
            let edge = |column: usize| self.cell(column, row) != self.cell(column, before(row));
            for (from, to) in runs(self.width, edge) {
                sides.push(Segment { from: self.corner(from, row), to: self.corner(to, row) });
            }
            if sides.len() > most {
                return Err(sides.len());
            }
        }
        for column in 0..=self.width {
            let edge = |row: usize| self.cell(column, row) != self.cell(before(column), row);
            for (from, to) in runs(self.height, edge) {
                sides.push(Segment { from: self.corner(column, from), to: self.corner(column, to) });
            }
            if sides.len() > most {
                return Err(sides.len());
            }
        }
        Ok(sides)
    }
}

/// The maximal runs from..to of consecutive indices below `count` for which `holds`.
fn runs(count: usize, holds: impl Fn(usize) -> bool) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for i in (0..count).filter(|i| holds(*i)) {
        match runs.last_mut() {
            Some((_, end)) if *end == i => *end += 1,
            _ => runs.push((i, i + 1)),
        }
    }
    runs
}
