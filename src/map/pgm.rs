//! Portable grey maps, as `map_server` and most mapping programs write them.

use super::occupancy::{Coded, Image, Pixel};
use std::fmt;

/// Why bytes are not a PGM image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PgmError {
    /// What was looked for: "the width".
    pub field: &'static str,
    /// The line of the header where it should have been, from 1.
    pub line: usize,
    /// What is there instead, as a sentence quotes it.
    pub value: String,
    pub allowed: String,
}

impl fmt::Display for PgmError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { field, line, value, allowed } = self;
        write!(f, "line {line}: {field} is {value}; allowed is {allowed}")
    }
}

impl std::error::Error for PgmError {}

/// Pixels of an image at most: a map of a large hall at 2 cm. More would take seconds and hundreds of megabytes.
pub const MAX_PIXELS: usize = 1 << 24;

/// Bytes of a file at most: a plain one takes six characters a pixel.
pub const MAX_BYTES: usize = 6 * MAX_PIXELS + 4096;

/// Characters of what is there instead that are quoted.
const QUOTED: usize = 20;

/// The image in `bytes`: PGM, binary (P5) or plain (P2), of 8 or 16 bits. All of it is looked at, and none of it copied.
///
/// # Errors
/// [`PgmError`] with the line of the header, or the line where plain pixels end.
pub fn read_pgm(bytes: &[u8]) -> Result<Image<Shades<'_>>, PgmError> {
    let Image { width, height, pixels: raster } = Raster::begin(bytes)?;
    let mut looked_at = raster.clone();
    while looked_at.is_plain && looked_at.read(bytes, &mut [0; MANY])? > 0 {}
    Ok(Image { width, height, pixels: Shades { bytes, raster } })
}

/// Pixels that are read at once.
pub const MANY: usize = 256;

/// Where in the bytes of a file its pixels are, row by row from the top, and how far they were read.
#[derive(Clone, Debug)]
pub struct Raster {
    left: usize,
    greatest: usize,
    /// Whether they are numbers, of which nobody knows before they are read that they are as they should be.
    pub is_plain: bool,
    at: usize,
    line: usize,
}

impl Raster {
    /// Reads the header of a file.
    pub fn begin(bytes: &[u8]) -> Result<Image<Self>, PgmError> {
        let mut reader = Reader { bytes, at: 0, line: 1 };
        let is_plain = match reader.token() {
            b"P5" => false,
            b"P2" => true,
            token => return Err(reader.error("the magic number", token, "P5 or P2".to_owned())),
        };
        let width = reader.number("the width", 1, MAX_PIXELS)?;
        let height = reader.number("the height", 1, MAX_PIXELS / width)?;
        let greatest = reader.number("the greatest value", 1, 65_535)?;
        let left = width * height;
        let Reader { mut at, line, .. } = reader;
        let mut raster = Self { left, greatest, is_plain, at, line };
        if !is_plain {
            // One white space character ends the header.
            at += 1;
            let (there, wanted) = (bytes.len().saturating_sub(at), left * raster.size());
            if there < wanted {
                let allowed = format!("{wanted} for {width} × {height} pixels");
                let (field, value) = ("the length of the raster in bytes", there.to_string());
                return Err(PgmError { field, line, value, allowed });
            }
            raster.at = at;
        }
        Ok(Image { width, height, pixels: raster })
    }

    /// Bytes of a pixel that is none of a plain file.
    fn size(&self) -> usize {
        if self.greatest < 256 { 1 } else { 2 }
    }

    /// Pixels that are still to be read.
    pub fn left(&self) -> usize {
        self.left
    }

    /// Reads as many values as there are, and as there is place for, of the same bytes; how many. What kind of raster it is,
    /// is asked once.
    #[inline(never)]
    pub fn read(&mut self, bytes: &[u8], place: &mut [u16]) -> Result<usize, PgmError> {
        let count = self.left.min(place.len());
        let values = &mut place[..count];
        if count == 0 {
            return Ok(count);
        }
        if self.is_plain {
            let mut reader = Reader { bytes, at: self.at, line: self.line };
            for value in values {
                *value = reader.number("a pixel", 0, self.greatest)? as u16;
            }
            (self.at, self.line) = (reader.at, reader.line);
        } else {
            let size = self.size();
            let raster = &bytes[self.at..][..count * size];
            self.at += raster.len();
            if size == 1 {
                values.iter_mut().zip(raster).for_each(|(value, byte)| *value = u16::from(*byte));
            } else {
                // The higher one first.
                let pairs = raster.as_chunks().0;
                values.iter_mut().zip(pairs).for_each(|(value, pair)| *value = u16::from_be_bytes(*pair));
            }
        }
        self.left -= count;
        Ok(count)
    }

    pub fn shade(&self, value: u16) -> Shade {
        let greatest = self.greatest as u16;
        Shade { value: value.min(greatest), greatest }
    }
}

/// A pixel of a PGM image: a value from 0 (black) to the greatest (white).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shade {
    value: u16,
    greatest: u16,
}

impl From<Shade> for Pixel {
    fn from(Shade { value, greatest }: Shade) -> Self {
        Self { shade: f32::from(value) / f32::from(greatest), opacity: 1.0 }
    }
}

impl Coded for Shade {
    #[inline]
    fn byte(self) -> u8 {
        self.value as u8
    }
}

/// The pixels of a PGM image, row by row from the top, each read when it is asked for: as numbers they would take several
/// times the memory of the file.
#[derive(Clone, Debug)]
pub struct Shades<'a> {
    bytes: &'a [u8],
    /// All numbers in it are as they should be.
    raster: Raster,
}

impl Iterator for Shades<'_> {
    type Item = Shade;

    fn next(&mut self) -> Option<Shade> {
        let mut value = [0];
        let count = self.raster.read(self.bytes, &mut value).unwrap_or_default();
        (count > 0).then(|| self.raster.shade(value[0]))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.raster.left, Some(self.raster.left))
    }

    #[inline]
    fn fold<B, F: FnMut(B, Shade) -> B>(mut self, first: B, mut f: F) -> B {
        let (mut result, mut values) = (first, [0; MANY]);
        while let count @ 1.. = self.raster.read(self.bytes, &mut values).unwrap_or_default() {
            for value in &values[..count] {
                result = f(result, self.raster.shade(*value));
            }
        }
        result
    }
}

impl ExactSizeIterator for Shades<'_> {}

/// Of decimal digits; none that is larger than a file may hold.
fn number(token: &[u8]) -> Option<usize> {
    let value = token.iter().try_fold(0, |value: usize, digit| {
        let digit = digit.is_ascii_digit().then(|| usize::from(digit - b'0'))?;
        Some(value * 10 + digit).filter(|value| *value <= MAX_PIXELS)
    })?;
    (!token.is_empty()).then_some(value)
}

/// Of a number that is read the short way: of any that is allowed.
const USUAL_DIGITS: usize = 8;

#[derive(Clone, Debug)]
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

    /// The next token, where no comment is before it, as a number of a few digits; None for any other, which is still to come
    /// then. Nearly all of a plain image are of this kind, of which there may be millions.
    #[inline(never)]
    fn usual_number(&mut self) -> Option<usize> {
        let Self { bytes, mut at, mut line } = *self;
        while let Some(byte) = bytes.get(at).filter(|byte| byte.is_ascii_whitespace()) {
            line += usize::from(*byte == b'\n');
            at += 1;
        }
        let (from, mut value) = (at, 0);
        while let Some(digit) = bytes.get(at).filter(|byte| byte.is_ascii_digit()) {
            value = value * 10 + usize::from(digit - b'0');
            at += 1;
            if at - from > USUAL_DIGITS {
                return None;
            }
        }
        let ends = bytes.get(at).is_none_or(|byte| byte.is_ascii_whitespace() || *byte == b'#');
        (ends && at > from).then(|| {
            *self = Self { bytes, at, line };
            value
        })
    }

    fn number(&mut self, field: &'static str, least: usize, most: usize) -> Result<usize, PgmError> {
        let mut usual = self.clone();
        if let Some(number) = usual.usual_number().filter(|number| (least..=most).contains(number)) {
            *self = usual;
            return Ok(number);
        }
        let token = self.token();
        number(token)
            .filter(|number| (least..=most).contains(number))
            .ok_or_else(|| self.error(field, token, format!("a whole number from {least} to {most}")))
    }

    fn error(&self, field: &'static str, token: &[u8], allowed: String) -> PgmError {
        // What is no letter of a text may be anything, the pixels of another kind of image among it.
        let readable = |byte: &u8| {
            if byte.is_ascii_graphic() { char::from(*byte) } else { char::REPLACEMENT_CHARACTER }
        };
        let mut value = String::from("missing");
        if !token.is_empty() {
            let shown: String = token.iter().take(QUOTED).map(readable).collect();
            value = format!("\"{shown}{}\"", if token.len() > QUOTED { "…" } else { "" });
        }
        PgmError { field, line: self.line, value, allowed }
    }
}
