//! Image files of maps: PGM, and PNG where the core has its decoder.

use super::occupancy::{Interpretation, OccupancyGrid};
use super::pgm::{PgmError, read_pgm};
#[cfg(not(widget))]
use super::png::{PngError, SIGNATURE, read_png};
use crate::geom::se2::SE2;
use std::fmt;

/// Reason why a file is not the image of a map.
#[derive(Clone, Debug, PartialEq)]
pub enum ImageError {
    Pgm(PgmError),
    #[cfg(not(widget))]
    Png(PngError),
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pgm(error) => error.fmt(f),
            #[cfg(not(widget))]
            Self::Png(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for ImageError {}

/// Makes the grid of an image file as [`OccupancyGrid::new`] does; the first bytes tell PNG from PGM.
///
/// # Errors
/// [`ImageError`] for a file that is neither, or damaged.
pub fn read_grid(
    file: &[u8],
    interpretation: &Interpretation,
    resolution: f64,
    origin: SE2,
) -> Result<OccupancyGrid, ImageError> {
    #[cfg(not(widget))]
    if file.starts_with(&SIGNATURE) {
        let image = read_png(file).map_err(ImageError::Png)?;
        return Ok(OccupancyGrid::new(&image, interpretation, resolution, origin));
    }
    let image = read_pgm(file).map_err(ImageError::Pgm)?;
    Ok(OccupancyGrid::new(&image, interpretation, resolution, origin))
}
