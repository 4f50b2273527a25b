//! Reader of PGM images, in which `map_server` and most mapping programs store maps.

use super::occupancy::{Image, Pixel};
use thiserror::Error;

/// Reason why bytes are not a PGM image.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}: {field} is {value}; allowed is {allowed}")]
pub struct PgmError {
    /// Name of the field: "the width".
    pub field: &'static str,
    /// Line of the header (from 1) in which the field should have been.
    pub line: usize,
    /// Text found instead, as the message quotes it.
    pub value: String,
    /// Values that are allowed, as the message lists them.
    pub allowed: String,
}

/// Largest number of pixels of an image: a map of 250 m × 250 m at 5 cm has 5000 × 5000.
pub const MAX_PIXELS: usize = 1 << 25;

/// Maximum size of a file, bytes. A plain file takes six characters for a pixel.
pub const MAX_BYTES: usize = 6 * MAX_PIXELS + 4096;

/// Maximum number of characters that an error quotes.
const MAX_QUOTED_CHARACTERS: usize = 20;

/// Reads a PGM image, binary (P5) or plain (P2), of 8 or 16 bits. Checks the whole file without copying it.
///
/// # Errors
/// [`PgmError`] with the line of the header, or the line where plain pixels end.
pub fn read_pgm(bytes: &[u8]) -> Result<Image<PgmPixels<'_>>, PgmError> {
    let mut reader = Reader { bytes, position: 0, line: 1 };
    let is_plain = match reader.next_token() {
        b"P5" => false,
        b"P2" => true,
        token => return Err(reader.error("the magic number", token, "P5 or P2".to_owned())),
    };
    let width = reader.read_number("the width", 1, MAX_PIXELS)?;
    let height = reader.read_number("the height", 1, MAX_PIXELS / width)?;
    let max_value = reader.read_number("the maximum value", 1, 65_535)?;
    let count = width * height;
    let coding = if is_plain {
        let mut pixels = reader.clone();
        for _ in 0..count {
            pixels.read_number("a pixel", 0, max_value)?;
        }
        PixelCoding::Plain
    } else {
        let (coding, size) = if max_value < 256 { (PixelCoding::Bytes, 1) } else { (PixelCoding::Words, 2) };
        let raster_bytes = count * size;
        // One white space character ends the header. Windows editors write two: carriage return and line feed.
        let is_crlf = bytes[reader.position..].starts_with(b"\r\n")
            && bytes.len() >= reader.position + 2 + raster_bytes;
        reader.position += if is_crlf { 2 } else { 1 };
        let available_bytes = bytes.len().saturating_sub(reader.position);
        if available_bytes < raster_bytes {
            let allowed = format!("{raster_bytes} for {width} × {height} pixels");
            let (field, value) = ("the length of the raster in bytes", available_bytes.to_string());
            return Err(PgmError { field, line: reader.line, value, allowed });
        }
        coding
    };
    Ok(Image {
        width,
        height,
        pixels: PgmPixels { reader, remaining: count, max_value: max_value as u16, coding },
    })
}

/// Coding of the pixels of a file.
#[derive(Clone, Copy, Debug)]
enum PixelCoding {
    /// Decimal numbers.
    Plain,
    Bytes,
    /// Two bytes each, the higher one first.
    Words,
}

/// Pixel of a PGM image, from 0 (black) to the maximum of the header (white).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PgmPixel {
    value: u16,
    max_value: u16,
}

impl From<PgmPixel> for Pixel {
    fn from(PgmPixel { value, max_value }: PgmPixel) -> Self {
        Self { shade: f32::from(value) / f32::from(max_value), opacity: 1.0 }
    }
}

/// Iterator over the pixels of a PGM image, row by row from the top. Storing them as numbers would take several times the memory
/// of the file.
#[derive(Clone, Debug)]
pub struct PgmPixels<'a> {
    reader: Reader<'a>,
    /// Number of pixels that are still to be read. They have been checked.
    remaining: usize,
    max_value: u16,
    coding: PixelCoding,
}

impl Iterator for PgmPixels<'_> {
    type Item = PgmPixel;

    fn next(&mut self) -> Option<PgmPixel> {
        self.remaining = self.remaining.checked_sub(1)?;
        let Self { reader: Reader { bytes, position, .. }, max_value, .. } = *self;
        let value = match self.coding {
            PixelCoding::Plain => parse_decimal(self.reader.next_token())? as u16,
            PixelCoding::Bytes => {
                self.reader.position += 1;
                u16::from(*bytes.get(position)?)
            }
            PixelCoding::Words => {
                self.reader.position += 2;
                u16::from_be_bytes(*bytes.get(position..)?.first_chunk()?)
            }
        };
        Some(PgmPixel { value: value.min(max_value), max_value })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.remaining, Some(self.remaining))
    }
}

impl ExactSizeIterator for PgmPixels<'_> {}

/// Parses decimal digits; None for a number larger than [`MAX_PIXELS`].
fn parse_decimal(token: &[u8]) -> Option<usize> {
    let value = token.iter().try_fold(0, |value: usize, digit| {
        let digit = digit.is_ascii_digit().then(|| usize::from(digit - b'0'))?;
        Some(value * 10 + digit).filter(|value| *value <= MAX_PIXELS)
    })?;
    (!token.is_empty()).then_some(value)
}

/// Reader of the words of a header, and of plain pixels.
#[derive(Clone, Debug)]
struct Reader<'a> {
    bytes: &'a [u8],
    position: usize,
    line: usize,
}

impl<'a> Reader<'a> {
    /// Returns the next run of characters that are neither white space nor in a comment; empty at the end.
    fn next_token(&mut self) -> &'a [u8] {
        let mut in_comment = false;
        while let Some(byte) = self.bytes.get(self.position) {
            match byte {
                b'\n' => {
                    self.line += 1;
                    in_comment = false;
                }
                b'#' => in_comment = true,
                _ if in_comment || byte.is_ascii_whitespace() => (),
                _ => break,
            }
            self.position += 1;
        }
        let from = self.position;
        while self.bytes.get(self.position).is_some_and(|byte| !byte.is_ascii_whitespace() && *byte != b'#') {
            self.position += 1;
        }
        &self.bytes[from..self.position]
    }

    fn read_number(&mut self, field: &'static str, min: usize, max: usize) -> Result<usize, PgmError> {
        let token = self.next_token();
        parse_decimal(token)
            .filter(|number| (min..=max).contains(number))
            .ok_or_else(|| self.error(field, token, format!("a whole number from {min} to {max}")))
    }

    fn error(&self, field: &'static str, token: &[u8], allowed: String) -> PgmError {
        // Other bytes may be pixels of another image format. A message cannot show them.
        let printable_char = |byte: &u8| {
            if byte.is_ascii_graphic() { char::from(*byte) } else { char::REPLACEMENT_CHARACTER }
        };
        let mut value = String::from("missing");
        if !token.is_empty() {
            let quoted_token: String = token.iter().take(MAX_QUOTED_CHARACTERS).map(printable_char).collect();
            value =
                format!("\"{quoted_token}{}\"", if token.len() > MAX_QUOTED_CHARACTERS { "…" } else { "" });
        }
        PgmError { field, line: self.line, value, allowed }
    }
}
