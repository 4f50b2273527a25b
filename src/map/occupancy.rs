//! Occupancy grids as ROS `map_server` stores them.

use super::outlining::Outlining;
use crate::geom::arc::Departure;
use crate::geom::se2::SE2;
use crate::geom::segment::Segment;
use std::ops::{Range, RangeInclusive};

/// How pixels become cells, as `map_server` reads its YAML file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interpretation {
    pub mode: Mode,
    /// Dark pixels are free instead of occupied.
    pub negate: bool,
    /// A cell is occupied where its occupancy, 0 (white) to 1 (black), exceeds this.
    pub occupied_thresh: f64,
    /// In mode trinary a cell is free where its occupancy is below this, and unknown between the two.
    pub free_thresh: f64,
}

/// What is taken where the YAML file says nothing: the grey that maps are saved with where nothing is known, 205 of
/// 255, is not below the threshold.
impl Default for Interpretation {
    fn default() -> Self {
        Self { mode: Mode::Trinary, negate: false, occupied_thresh: 0.65, free_thresh: 0.196 }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Dark pixels are occupied, light ones free, and those between the thresholds unknown.
    Trinary,
    /// Transparent pixels are unknown; of the others the dark ones are occupied, and the rest is free: between the
    /// thresholds `map_server` tells degrees of it.
    Scale,
    /// Pixel values are occupancies from 0 to 100; 100 is occupied, and what is above it unknown.
    Raw,
}

/// What a map says of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Cell {
    Free,
    Occupied,
    Unknown,
}

impl Cell {
    const ALL: [Self; 3] = [Self::Free, Self::Occupied, Self::Unknown];
}

/// What unknown cells are for a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Unknown {
    /// It may be there, as particle filters have it.
    #[default]
    Free,
    /// They are in its way, as occupied ones are.
    Blocked,
}

/// A picture of shades from 0 (black) to 1 (white), row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image<Pixels = Vec<Pixel>> {
    pub width: usize,
    pub height: usize,
    /// width · height of them.
    pub pixels: Pixels,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Mean of the colours.
    pub shade: f32,
    /// From 0 (transparent) to 1.
    pub opacity: f32,
}

/// A pixel as an image has it.
pub trait Coded: Copy + PartialEq + Into<Pixel> {
    /// A byte that most of those which differ have not in common.
    fn byte(self) -> u8;
}

impl Coded for Pixel {
    fn byte(self) -> u8 {
        (self.shade * 255.0) as u8
    }
}

impl Interpretation {
    pub fn cell(&self, pixel: Pixel) -> Cell {
        let Pixel { shade, opacity } = pixel;
        let occupancy = if self.negate { shade } else { 1.0 - shade };
        // Rounded as the shade is, so that a pixel at a threshold is not beyond it.
        let (occupied, free) = (self.occupied_thresh as f32, self.free_thresh as f32);
        // Rounding takes long where there is no instruction for it.
        let value = || (shade * 255.0).round();
        match self.mode {
            Mode::Scale if opacity < 1.0 => Cell::Unknown,
            Mode::Trinary | Mode::Scale if occupancy > occupied => Cell::Occupied,
            // 1 less a rounded shade may be below the threshold that the shade is at.
            Mode::Trinary if occupancy > free - f32::EPSILON => Cell::Unknown,
            Mode::Raw if value() == 100.0 => Cell::Occupied,
            Mode::Raw if value() > 100.0 => Cell::Unknown,
            _ => Cell::Free,
        }
    }
}

/// Sides of a cell, m: from a millimetre to a hundred metres.
pub const RESOLUTION: RangeInclusive<f64> = 1e-3..=100.0;

/// Cells that are compared at once.
pub const MANY: usize = size_of::<u128>();

/// Each of them 1.
const ONES: u128 = u128::from_ne_bytes([1; MANY]);

/// Cells whose marks are made at once: those of millions would be a copy as large as the grid.
pub const PIECE: usize = 1 << 16;

/// Of the codes of many cells, a byte each: 1 where they are of this kind, and 0 elsewhere.
fn marked(codes: u128, kind: Cell) -> u128 {
    // Two codes differ in one of their two bits.
    let differ = codes ^ (ONES * kind as u128);
    ONES & !(differ | differ >> 1)
}

/// Square cells. The occupied ones are in a robot's way, and the unknown ones where one decides so.
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
    /// Row by row from the bottom, as bytes: of those many are compared at once.
    cells: Vec<u8>,
    unknown: Unknown,
}

impl OccupancyGrid {
    /// The grid of an image whose lower left corner is at `origin`, with cells of `resolution` (m, positive). What is
    /// unknown is free, see [`OccupancyGrid::with_unknown`].
    ///
    /// As in `map_server`, opacity counts as a fourth colour in mode trinary if the image has transparency.
    pub fn new<P: Coded, Pixels: Clone + IntoIterator<Item = P>>(
        image: &Image<Pixels>,
        interpretation: &Interpretation,
        resolution: f64,
        origin: SE2,
    ) -> Self {
        let Image { width, height, ref pixels } = *image;
        let mut grid = Self::blank(width, height, resolution, origin);
        if let Some(first) = pixels.clone().into_iter().next() {
            let mut drawing = Drawing::new(interpretation, first);
            drawing.draw(&mut grid, pixels.clone());
            if drawing.again() {
                drawing.draw(&mut grid, pixels.clone());
            }
        }
        grid
    }

    /// One of free cells.
    pub(super) fn blank(width: usize, height: usize, resolution: f64, origin: SE2) -> Self {
        let cells = vec![Cell::Free as u8; width * height];
        let (to_local, unknown) = (Departure::new(origin.inverse()), Unknown::default());
        Self { width, height, resolution, origin, to_local, cells, unknown }
    }

    /// The same cells, the unknown ones being this for a robot.
    #[must_use]
    pub fn with_unknown(self, unknown: Unknown) -> Self {
        Self { unknown, ..self }
    }

    /// Makes the unknown cells this; whether they were something else.
    pub(super) fn change_unknown(&mut self, unknown: Unknown) -> bool {
        std::mem::replace(&mut self.unknown, unknown) != unknown
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

    /// What is known of each cell, row by row from the bottom.
    pub fn cells(&self) -> impl ExactSizeIterator<Item = Cell> + '_ {
        self.cells.iter().map(|code| Cell::ALL[usize::from(*code)])
    }

    /// Of the next cells from one on, in the order of `cells`, as many as are marked at once: 1 where they are of this kind and 0 elsewhere.
    pub fn marks(&self, kind: Cell, from: usize) -> Vec<u8> {
        let cells = self.cells.get(from..).unwrap_or_default();
        let mut marks = cells[..cells.len().min(PIECE)].to_vec();
        let (many, rest) = marks.as_chunks_mut();
        for codes in many {
            *codes = marked(u128::from_ne_bytes(*codes), kind).to_ne_bytes();
        }
        for code in rest {
            *code = marked(u128::from(*code), kind) as u8;
        }
        marks
    }

    /// Whether a point of the plane lies in a cell that is in a robot's way.
    pub fn holds(&self, point: [f64; 2]) -> bool {
        let [column, row] = self.cell_coordinates(point).map(f64::floor);
        let cell = || self.row(row as usize).get(column as usize);
        column >= 0.0 && row >= 0.0 && cell().is_some_and(|code| self.blocks(*code))
    }

    /// The columns in a row, counted from the bottom, of the cells that are not known to be free.
    pub(super) fn not_free(&self, row: usize, mut see: impl FnMut(Range<usize>)) {
        for (i, many) in self.row(row).chunks(MANY).enumerate() {
            let first = MANY * i;
            // Most are all of one kind.
            match many.first_chunk().map(|codes| marked(u128::from_ne_bytes(*codes), Cell::Free)) {
                Some(ONES) => (),
                Some(0) => see(first..first + MANY),
                _ => {
                    let seen = many.iter().enumerate().filter(|(_, code)| **code != Cell::Free as u8);
                    seen.for_each(|(i, _)| see(first + i..first + i + 1));
                }
            }
        }
    }

    /// Whether a cell is known to be free, by its column, in a row counted from the bottom; cells off the grid are not.
    pub(super) fn known_free(&self, row: usize) -> impl Fn(usize) -> bool + '_ {
        let cells = self.row(row);
        move |column| cells.get(column) == Some(&(Cell::Free as u8))
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
        self.point([column as f64, row as f64])
    }

    /// The point of the plane at these coordinates, counted in cells from the origin.
    pub(super) fn point(&self, [column, row]: [f64; 2]) -> [f64; 2] {
        let (x, y) = (column * self.resolution, row * self.resolution);
        let point = self.origin * SE2::new(x, y, 0.0);
        [point.x(), point.y()]
    }

    /// Of a point of the plane, in cells from the origin.
    pub(super) fn cell_coordinates(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        self.to_local.transform([x, y]).map(|coordinate| coordinate / self.resolution)
    }

    /// Which cells are in a robot's way, as `cells`.
    pub(super) fn in_the_way(&self) -> impl Iterator<Item = bool> + '_ {
        self.cells.iter().map(|code| self.blocks(*code))
    }

    pub(super) fn blocks(&self, code: u8) -> bool {
        code == Cell::Occupied as u8 || (code == Cell::Unknown as u8 && self.unknown == Unknown::Blocked)
    }

    /// [`OccupancyGrid::blocks`] of many, 1 in their bytes where it is so.
    pub(super) fn many_blocked(&self, codes: [u8; MANY]) -> u128 {
        let codes = u128::from_ne_bytes(codes);
        match self.unknown {
            Unknown::Free => marked(codes, Cell::Occupied),
            Unknown::Blocked => ONES & !marked(codes, Cell::Free),
        }
    }

    /// The cells of a row, counted from the bottom; none of a row off the grid.
    pub(super) fn row(&self, row: usize) -> &[u8] {
        let from = row.saturating_mul(self.width).min(self.cells.len());
        &self.cells[from..(from + self.width).min(self.cells.len())]
    }

    /// The outlines of the cells that are in a robot's way, neighbouring sides joined: the distance to them is the
    /// distance to the cells for everyone outside of one. First those along the rows, then those along the columns.
    ///
    /// # Errors
    /// So many there are at least, where there are more than `most`.
    pub fn outlines(&self, most: usize) -> Result<Vec<Segment>, usize> {
        let mut outlining = Outlining::default();
        while !outlining.advance(self, most, &mut { usize::MAX })? {}
        Ok(outlining.finish(self))
    }

    pub(super) fn side(&self, from: [usize; 2], to: [usize; 2]) -> Segment {
        Segment { from: self.corner(from[0], from[1]), to: self.corner(to[0], to[1]) }
    }
}

/// How the pixels of an image become the cells of a grid, as many at a time as there are.
#[derive(Clone, Debug)]
pub struct Drawing<P> {
    interpretation: Interpretation,
    /// Whether opacity counts as a fourth colour.
    four_colours: bool,
    /// Whether some pixel was not opaque.
    transparent: bool,
    /// An image has few kinds of pixels: of each byte the latest that has it, and the cell that it becomes.
    known: Box<[(P, u8); 256]>,
    /// The next cell, and how many are left of its row; none before the first.
    at: usize,
    left: usize,
}

impl<P: Coded> Drawing<P> {
    /// `like` is one of the pixels or opaque.
    pub fn new(interpretation: &Interpretation, like: P) -> Self {
        Self {
            interpretation: *interpretation,
            four_colours: false,
            transparent: false,
            known: Box::new([(like, Cell::Free as u8); 256]),
            at: 0,
            left: 0,
        }
    }

    fn code(&mut self, pixel: P) -> u8 {
        let mut pixel = pixel.into();
        self.transparent |= pixel.opacity < 1.0;
        if self.four_colours {
            pixel.shade = (3.0 * pixel.shade + pixel.opacity) / 4.0;
        }
        self.interpretation.cell(pixel) as u8
    }

    /// The next pixels, row by row from the top.
    pub fn draw(&mut self, grid: &mut OccupancyGrid, pixels: impl IntoIterator<Item = P>) {
        if self.left == 0 {
            // The first row of an image is its highest, the first of a grid its lowest.
            (self.at, self.left) = (grid.cells.len().saturating_sub(grid.width), grid.width);
            let like = self.known[0].0;
            *self.known = [(like, self.code(like)); 256];
        }
        let (mut at, mut left) = (self.at, self.left);
        pixels.into_iter().for_each(|pixel| {
            let place = usize::from(pixel.byte());
            if self.known[place].0 != pixel {
                self.known[place] = (pixel, self.code(pixel));
            }
            if let Some(cell) = grid.cells.get_mut(at) {
                *cell = self.known[place].1;
            }
            (at, left) = (at + 1, left.wrapping_sub(1));
            if left == 0 {
                (at, left) = (at.wrapping_sub(2 * grid.width), grid.width);
            }
        });
        (self.at, self.left) = (at, left);
    }

    /// Whether all pixels are to come once more, as opacity counts in an image like this one.
    pub fn again(&mut self) -> bool {
        let again = self.transparent && !self.four_colours && self.interpretation.mode == Mode::Trinary;
        if again {
            (self.four_colours, self.left) = (true, 0);
        }
        again
    }
}
