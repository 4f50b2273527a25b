//! Portable grey maps, as `map_server` and most mapping programs write them.

use super::occupancy::{Image, Pixel};
use std::fmt;

/// Why bytes are not a PGM image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PgmError {
    /// What was looked for: "the width".
    pub field: &'static str,
    /// The line of the header where it should have been, from 1.
    pub line: usize,
    pub expected: String,
}

impl fmt::Display for PgmError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {} is not as expected: {}", self.line, self.field, self.expected)
    }
}

impl std::error::Error for PgmError {}

/// Pixels of an image at most: a map of a large hall at 2 cm. More would take seconds and hundreds of megabytes.
pub const MAX_PIXELS: usize = 1 << 24;

/// Bytes of a file at most: a plain one takes six characters a pixel.
pub const MAX_BYTES: usize = 6 * MAX_PIXELS + 4096;

/// The image in `bytes`: PGM, binary (P5) or plain (P2), of 8 or 16 bits.
///
/// # Errors
/// [`PgmError`] with the line of the header, or the line where plain pixels end.
pub fn read_pgm(bytes: &[u8]) -> Result<Image, PgmError> {
    let mut reader = Reader { bytes, at: 0, line: 1 };
    let plain = match reader.token() {
        b"P5" => false,
        b"P2" => true,
        _ => return Err(reader.error("the magic number", "P5 or P2 as the first two bytes")),
    };
    let width = reader.number("the width", 1, MAX_PIXELS)?;
    let height = reader.number("the height", 1, MAX_PIXELS / width)?;
    let greatest = reader.number("the greatest value", 1, 65_535)?;
    let count = width * height;
    let values: Vec<usize> = if plain {
        (0..count).map(|_| reader.number("a pixel", 0, greatest)).collect::<Result<_, _>>()?
    } else {
        let size = if greatest < 256 { 1 } else { 2 };
        // One white space character ends the header.
        let raster = bytes.get(reader.at + 1..).unwrap_or_default();
        if raster.len() < count * size {
            let expected = format!("{} bytes after the header, and there are {}", count * size, raster.len());
            return Err(reader.error("the raster", &expected));
        }
        raster[..count * size]
            .chunks(size)
            .map(|bytes| bytes.iter().fold(0, |value, byte| value * 256 + usize::from(*byte)))
            .collect()
    };
    let pixels = values
        .into_iter()
        .map(|value| Pixel { shade: value.min(greatest) as f32 / greatest as f32, opacity: 1.0 })
        .collect();
    Ok(Image { width, height, pixels })
}

struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Reader<'a> {
    /// The next run of characters that are neither white space nor in a comment; empty at the end.
    fn token(&mut self) -> &'a [u8] {
        let mut in_comment = false;
        while let Some(byte) = self.bytes.get(self.at) {
            match byte {
                b'\n' => {
                    self.line += 1;
                    in_comment = false;
                }
                b'#' => in_comment = true,
                _ if in_comment || byte.is_ascii_whitespace() => (),
                _ => break,
            }
            self.at += 1;
        }
        let from = self.at;
        while self.bytes.get(self.at).is_some_and(|byte| !byte.is_ascii_whitespace() && *byte != b'#') {
            self.at += 1;
        }
        &self.bytes[from..self.at]
    }

    fn number(&mut self, field: &'static str, least: usize, most: usize) -> Result<usize, PgmError> {
        let token = self.token();
        std::str::from_utf8(token)
            .ok()
            .and_then(|text| text.parse().ok())
            .filter(|number| (least..=most).contains(number))
            .ok_or_else(|| self.error(field, &format!("a whole number from {least} to {most}")))
    }

    fn error(&self, field: &'static str, expected: &str) -> PgmError {
        PgmError { field, line: self.line, expected: expected.to_owned() }
    }
}
