//! Image files of maps: PGM, and PNG in builds with a PNG decoder.

use super::occupancy::{OccupancyGrid, PixelClassifier};
use super::pgm::{PgmError, read_pgm};
#[cfg(not(widget))]
use super::png::{PNG_SIGNATURE, PngError, read_png};
use crate::geom::se2::SE2;
use thiserror::Error;

/// Reason why a file is not the image of a map.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ImageError {
    /// The PGM image is invalid.
    #[error(transparent)]
    Pgm(#[from] PgmError),
    /// The PNG image is invalid.
    #[cfg(not(widget))]
    #[error(transparent)]
    Png(#[from] PngError),
}

/// Makes the grid of an image file with [`OccupancyGrid::new`]. The first bytes distinguish PNG from PGM.
///
/// # Errors
/// [`ImageError`] for a file that is neither, or damaged.
pub fn read_grid(
    file_bytes: &[u8],
    classifier: &PixelClassifier,
    resolution: f64,
    origin: SE2,
) -> Result<OccupancyGrid, ImageError> {
    #[cfg(not(widget))]
    if file_bytes.starts_with(&PNG_SIGNATURE) {
        let image = read_png(file_bytes)?;
        return Ok(OccupancyGrid::new(&image, classifier, resolution, origin));
    }
    let image = read_pgm(file_bytes)?;
    Ok(OccupancyGrid::new(&image, classifier, resolution, origin))
}
