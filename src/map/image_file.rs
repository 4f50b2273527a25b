//! Image files of maps: PGM, and PNG in builds with a PNG decoder.

use super::occupancy::{OccupancyGrid, PixelClassifier};
use super::pgm::read_pgm;
#[cfg(not(widget))]
use super::png::{PNG_SIGNATURE, read_png};
use crate::geom::se2::SE2;
use thiserror::Error;

/// Reason why a file is not the image of a map, as a text with what is wrong, where, and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct ImageError(pub(super) String);

/// Makes the grid of an image file with [`OccupancyGrid::new`]. The first bytes distinguish PNG from PGM. Fails with [`ImageError`] for a
/// file that is neither, or damaged.
pub fn read_grid(
    file_bytes: &[u8],
    pixel_classifier: &PixelClassifier,
    resolution: f64,
    origin: SE2,
) -> Result<OccupancyGrid, ImageError> {
    #[cfg(not(widget))]
    if file_bytes.starts_with(&PNG_SIGNATURE) {
        return Ok(OccupancyGrid::new(&read_png(file_bytes)?, pixel_classifier, resolution, origin));
    }
    Ok(OccupancyGrid::new(&read_pgm(file_bytes)?, pixel_classifier, resolution, origin))
}
