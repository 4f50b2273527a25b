//! Maps that are read in slices: of 4096² pixels, that takes some tenths of a second.

use super::floor_plan::{FloorPlan, FloorPlanError};
use super::occupancy::{Coded, Drawing, Image, Interpretation, OccupancyGrid, Pixel, Unknown};
use super::outlining::Outlining;
use super::pgm::{MANY, PgmError, Raster, Shade};
use crate::geom::se2::SE2;
use std::fmt;

/// Why an image is no map.
#[derive(Clone, Debug, PartialEq)]
pub enum MapError {
    Image(PgmError),
    Plan(FloorPlanError),
    /// Memory does not suffice for what is to be tried in it.
    NoMemory,
}

impl From<PgmError> for MapError {
    fn from(error: PgmError) -> Self {
        Self::Image(error)
    }
}

impl From<FloorPlanError> for MapError {
    fn from(error: FloorPlanError) -> Self {
        Self::Plan(error)
    }
}

impl fmt::Display for MapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Image(error) => error.fmt(f),
            Self::Plan(error) => error.fmt(f),
            Self::NoMemory => f.write_str("samples are more than there is memory for; allowed are fewer"),
        }
    }
}

impl std::error::Error for MapError {}

/// A pixel as images have it: red, green, blue and opacity, from 0 to 255.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colours(pub [u8; 4]);

impl From<Colours> for Pixel {
    fn from(Colours(colours): Colours) -> Self {
        let [red, green, blue, opacity] = colours.map(f32::from);
        Self { shade: (red + green + blue) / 765.0, opacity: opacity / 255.0 }
    }
}

impl Coded for Colours {
    #[inline]
    fn byte(self) -> u8 {
        let [red, green, blue, _] = self.0;
        red.wrapping_add(green).wrapping_add(blue)
    }
}

/// Pixels that are looked at in the time that a distance takes, where they are no numbers in a text.
const PIXELS: usize = 8;

/// A map on its way: of an image's pixels come cells, and of these a plan.
#[derive(Clone, Debug)]
pub struct MapReading {
    /// Its bytes, until all are read.
    image: Vec<u8>,
    pixels: Pixels,
    grid: OccupancyGrid,
    outlining: Outlining,
}

#[derive(Clone, Debug)]
enum Pixels {
    Shades(Raster, Drawing<Shade>),
    /// With the next of them.
    Colours(usize, Drawing<Colours>),
}

impl MapReading {
    /// Begins with a PGM file; the rest is as [`OccupancyGrid::new`] has it.
    ///
    /// # Errors
    /// As [`super::read_pgm`], but for plain pixels, which are not looked at yet.
    pub fn of_pgm(
        file: Vec<u8>,
        interpretation: &Interpretation,
        resolution: f64,
        origin: SE2,
    ) -> Result<Self, MapError> {
        let Image { width, height, pixels: raster } = Raster::begin(&file)?;
        let grid = OccupancyGrid::blank(width, height, resolution, origin);
        let drawing = Drawing::new(&grid, interpretation, raster.shade(0));
        Ok(Self::new(file, Pixels::Shades(raster, drawing), grid))
    }

    /// Begins with red, green, blue and opacity of each pixel.
    pub fn of_colours(
        image: Image<Vec<u8>>,
        interpretation: &Interpretation,
        resolution: f64,
        origin: SE2,
    ) -> Self {
        let Image { width, height, pixels } = image;
        let grid = OccupancyGrid::blank(width, height, resolution, origin);
        let drawing = Drawing::new(&grid, interpretation, Colours([0, 0, 0, u8::MAX]));
        Self::new(pixels, Pixels::Colours(0, drawing), grid)
    }

    fn new(image: Vec<u8>, pixels: Pixels, grid: OccupancyGrid) -> Self {
        Self { image, pixels, grid, outlining: Outlining::default() }
    }

    /// Goes on as far as `work` allows (about that many distances computed); whether all is done. What is unknown may be
    /// something else than the last time.
    ///
    /// # Errors
    /// [`MapError`] where the image ends or is none, or its cells have too many sides.
    pub fn advance(&mut self, unknown: Unknown, work: &mut usize) -> Result<bool, MapError> {
        if !self.draw(work)? {
            return Ok(false);
        }
        self.image = Vec::new();
        if self.grid.change_unknown(unknown) {
            self.outlining = Outlining::default();
        }
        let done = self.outlining.advance(&self.grid, FloorPlan::MAX_WALLS, work);
        Ok(done.map_err(FloorPlanError::TooManyWalls)?)
    }

    /// Makes cells of pixels; whether all is done.
    fn draw(&mut self, work: &mut usize) -> Result<bool, PgmError> {
        let Self { image, pixels, grid, .. } = self;
        match pixels {
            Pixels::Shades(raster, drawing) => {
                let mut values = [0; MANY];
                while raster.left() > 0 && *work > 0 {
                    let count = raster.read(image, &mut values)?;
                    drawing.draw(grid, values[..count].iter().map(|value| raster.shade(*value)));
                    *work = work.saturating_sub(if raster.is_plain { MANY } else { MANY / PIXELS });
                }
                Ok(raster.left() == 0)
            }
            Pixels::Colours(next, drawing) => {
                let colours = image.as_chunks().0;
                while *next < colours.len() && *work > 0 {
                    let some = colours[*next..].iter().take(MANY);
                    *next += some.len();
                    drawing.draw(grid, some.map(|colours| Colours(*colours)));
                    *work = work.saturating_sub(MANY / PIXELS);
                    if *next == colours.len() && drawing.again(grid) {
                        *next = 0;
                    }
                }
                Ok(*next >= colours.len())
            }
        }
    }

    /// The plan; what is left to do is done.
    ///
    /// # Errors
    /// As [`MapReading::advance`], and where the grid is too large or too small.
    pub fn finish(mut self, unknown: Unknown) -> Result<FloorPlan, MapError> {
        while !self.advance(unknown, &mut { usize::MAX })? {}
        let walls = self.outlining.finish(&self.grid);
        Ok(FloorPlan::outlined(self.grid, walls)?)
    }

    /// How much is done, from 0 to 1.
    pub fn done(&self) -> f64 {
        let [columns, rows] = self.grid.size();
        let count = (columns * rows) as f64;
        let drawn = match &self.pixels {
            Pixels::Shades(raster, _) => 1.0 - raster.left() as f64 / count,
            Pixels::Colours(next, _) => *next as f64 / count,
        };
        0.5 * (drawn + self.outlining.done(&self.grid))
    }
}
