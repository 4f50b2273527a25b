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

/// A pixel as an image has it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Raw {
    Shade(Shade),
    /// Red, green, blue and opacity, from 0 to 255.
    Colours([u8; 4]),
}

impl From<Raw> for Pixel {
    fn from(raw: Raw) -> Self {
        match raw {
            Raw::Shade(shade) => shade.into(),
            Raw::Colours(colours) => {
                let [red, green, blue, opacity] = colours.map(f32::from);
                Self { shade: (red + green + blue) / 765.0, opacity: opacity / 255.0 }
            }
        }
    }
}

impl Coded for Raw {
    #[inline]
    fn byte(self) -> u8 {
        match self {
            Self::Shade(shade) => shade.byte(),
            Self::Colours([red, green, blue, _]) => red.wrapping_add(green).wrapping_add(blue),
        }
    }
}

const OPAQUE: Raw = Raw::Colours([0, 0, 0, u8::MAX]);

/// Pixels that are looked at in the time that a distance takes, where they are no numbers in a text.
const PIXELS: usize = 8;

/// A map on its way: of an image's pixels come cells, and of these a plan.
#[derive(Clone, Debug)]
pub struct MapReading {
    /// Its bytes, until all are read.
    image: Vec<u8>,
    source: Source,
    drawing: Drawing<Raw>,
    grid: OccupancyGrid,
    outlining: Outlining,
}

/// Where in the bytes of an image its pixels are.
#[derive(Clone, Debug)]
enum Source {
    Pgm(Raster),
    /// Four bytes a pixel; the next of them.
    Colours(usize),
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
        let image = Image { width, height, pixels: file };
        Ok(Self::new(image, Source::Pgm(raster), interpretation, resolution, origin))
    }

    /// Begins with red, green, blue and opacity of each pixel.
    pub fn of_colours(
        image: Image<Vec<u8>>,
        interpretation: &Interpretation,
        resolution: f64,
        origin: SE2,
    ) -> Self {
        Self::new(image, Source::Colours(0), interpretation, resolution, origin)
    }

    fn new(
        Image { width, height, pixels: image }: Image<Vec<u8>>,
        source: Source,
        interpretation: &Interpretation,
        resolution: f64,
        origin: SE2,
    ) -> Self {
        let grid = OccupancyGrid::blank(width, height, resolution, origin);
        let drawing = Drawing::new(interpretation, OPAQUE);
        Self { image, source, drawing, grid, outlining: Outlining::default() }
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
        Ok(done.map_err(FloorPlanError::TooManySides)?)
    }

    /// Makes cells of pixels; whether all is done.
    fn draw(&mut self, work: &mut usize) -> Result<bool, PgmError> {
        let Self { image, source, drawing, grid, .. } = self;
        let (mut values, mut pixels) = ([0; MANY], [OPAQUE; MANY]);
        while *work > 0 {
            let (count, cost) = match source {
                Source::Pgm(raster) => {
                    let count = raster.read(image, &mut values)?;
                    for (pixel, value) in pixels.iter_mut().zip(&values) {
                        *pixel = Raw::Shade(raster.shade(*value));
                    }
                    (count, if raster.is_plain { MANY } else { MANY / PIXELS })
                }
                Source::Colours(next) => {
                    let colours = image.as_chunks().0.get(*next..).unwrap_or_default();
                    pixels
                        .iter_mut()
                        .zip(colours)
                        .for_each(|(pixel, colours)| *pixel = Raw::Colours(*colours));
                    let count = colours.len().min(MANY);
                    *next += count;
                    (count, MANY / PIXELS)
                }
            };
            if count > 0 {
                drawing.draw(grid, pixels[..count].iter().copied());
                *work = work.saturating_sub(cost);
            } else if drawing.again() {
                *source = Source::Colours(0);
            } else {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The plan, once all is done.
    ///
    /// # Errors
    /// [`MapError`] where the grid is too large or too small.
    pub fn finish(self) -> Result<FloorPlan, MapError> {
        let walls = self.outlining.finish(&self.grid);
        Ok(FloorPlan::outlined(self.grid, walls)?)
    }

    /// How much is done, from 0 to 1.
    pub fn done(&self) -> f64 {
        let [columns, rows] = self.grid.size();
        let count = columns * rows;
        let drawn = match &self.source {
            Source::Pgm(raster) => count - raster.left(),
            Source::Colours(next) => *next,
        };
        0.5 * (drawn as f64 / count as f64 + self.outlining.done(&self.grid))
    }
}
