//! Reader of PGM images, in which `map_server` and most mapping programs store maps.

use super::image_file::ImageError;
use super::occupancy::Image;

/// Largest number of pixels of an image: a map of 250 m × 250 m at 5 cm has 5000 × 5000.
pub const MAX_PIXELS: usize = 1 << 25;

/// Maximum size of a file, bytes. A plain file takes six characters for a pixel.
pub const MAX_BYTES: usize = 6 * MAX_PIXELS + 4096;

const MAX_QUOTED_CHARACTERS: usize = 20;

/// Reads the brightness values of a PGM image, binary (P5) or plain (P2), of 8 or 16 bits. The maximum value of the header is white. Fails
/// with [`ImageError`], which names the line and the field that is not allowed.
pub fn read_pgm(file_bytes: &[u8]) -> Result<Image<f32>, ImageError> {
    let mut token_reader = TokenReader { file_bytes, byte_position: 0, line: 1 };
    let is_plain_pgm = match token_reader.next_token() {
        b"P5" => false,
        b"P2" => true,
        token => return Err(token_reader.create_error("the magic number", token, "P5 or P2".to_owned())),
    };
    let width = token_reader.read_number("the width", 1, MAX_PIXELS)?;
    let height = token_reader.read_number("the height", 1, MAX_PIXELS / width)?;
    let max_value = token_reader.read_number("the maximum value", 1, 65_535)?;
    let pixel_count = width * height;
    let brightness_of = |pixel_value: usize| pixel_value.min(max_value) as f32 / max_value as f32;
    if is_plain_pgm {
        let pixel_results =
            (0..pixel_count).map(|_| token_reader.read_number("a pixel", 0, max_value).map(brightness_of));
        return Ok(Image { width, height, pixels: pixel_results.collect::<Result<_, _>>()? });
    }
    let bytes_per_pixel = if max_value < 256 { 1 } else { 2 };
    let raster_byte_count = pixel_count * bytes_per_pixel;
    // One white space character ends the header. Carriage return and line feed count as one if all pixels follow them.
    let is_crlf = file_bytes[token_reader.byte_position..].starts_with(b"\r\n")
        && file_bytes.len() >= token_reader.byte_position + 2 + raster_byte_count;
    let available_bytes =
        file_bytes.get(token_reader.byte_position + if is_crlf { 2 } else { 1 }..).unwrap_or_default();
    let Some(raster_bytes) = available_bytes.get(..raster_byte_count) else {
        let (line_number, byte_count) = (token_reader.line, available_bytes.len());
        return Err(ImageError(format!(
            "line {line_number}: the length of the raster in bytes is {byte_count}; allowed is {raster_byte_count} for {width} × {height} pixels"
        )));
    };
    let decode_pixel =
        |pixel: &[u8]| pixel.iter().fold(0, |pixel_value, byte| 256 * pixel_value + usize::from(*byte));
    let brightness_values =
        raster_bytes.chunks(bytes_per_pixel).map(|pixel| brightness_of(decode_pixel(pixel))).collect();
    Ok(Image { width, height, pixels: brightness_values })
}

struct TokenReader<'a> {
    file_bytes: &'a [u8],
    byte_position: usize,
    line: usize,
}

impl<'a> TokenReader<'a> {
    /// Returns the next token: characters that are neither white space nor in a comment. The token is empty at the end of the file.
    fn next_token(&mut self) -> &'a [u8] {
        let mut is_in_comment = false;
        while let Some(byte) = self.file_bytes.get(self.byte_position) {
            match byte {
                b'\n' => {
                    self.line += 1;
                    is_in_comment = false;
                }
                b'#' => is_in_comment = true,
                _ if is_in_comment || byte.is_ascii_whitespace() => (),
                _ => break,
            }
            self.byte_position += 1;
        }
        let token_start = self.byte_position;
        while self
            .file_bytes
            .get(self.byte_position)
            .is_some_and(|byte| !byte.is_ascii_whitespace() && *byte != b'#')
        {
            self.byte_position += 1;
        }
        &self.file_bytes[token_start..self.byte_position]
    }

    fn read_number(&mut self, field_name: &'static str, min: usize, max: usize) -> Result<usize, ImageError> {
        let token = self.next_token();
        let digit_text = str::from_utf8(token).ok().filter(|_| token.iter().all(u8::is_ascii_digit));
        digit_text
            .and_then(|digit_text| digit_text.parse().ok())
            .filter(|parsed_number| (min..=max).contains(parsed_number))
            .ok_or_else(|| {
                self.create_error(field_name, token, format!("a whole number from {min} to {max}"))
            })
    }

    fn create_error(&self, field_name: &'static str, token: &[u8], allowed_text: String) -> ImageError {
        // Bytes that are not printable, such as pixels of another image format, are shown as replacement characters.
        let to_printable = |byte: &u8| {
            if byte.is_ascii_graphic() { char::from(*byte) } else { char::REPLACEMENT_CHARACTER }
        };
        let mut actual_text = String::from("missing");
        if !token.is_empty() {
            let quoted_token: String = token.iter().take(MAX_QUOTED_CHARACTERS).map(to_printable).collect();
            actual_text =
                format!("\"{quoted_token}{}\"", if token.len() > MAX_QUOTED_CHARACTERS { "…" } else { "" });
        }
        ImageError(format!("line {}: {field_name} is {actual_text}; allowed is {allowed_text}", self.line))
    }
}
