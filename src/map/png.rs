//! PNG images of maps, decoded pixel for pixel. Gamma and colour profiles are ignored.

use super::image_file::ImageError;
use super::occupancy::Image;
use super::pgm::MAX_PIXELS;
use png::{BitDepth, ColorType, Decoder, DecodingError, Info, Limits, Transformations};
use std::io::Cursor;

/// First bytes of every PNG image.
pub const PNG_SIGNATURE: [u8; 8] = *b"\x89PNG\r\n\x1a\n";

/// Decodes a PNG image of any kind into red, green, blue and opacity; samples of 16 bits are rounded to 8 bits. Fails with [`ImageError`]
/// for an image that is cut short, damaged or too large.
pub fn read_png(png_bytes: &[u8]) -> Result<Image<[u8; 4]>, ImageError> {
    let mut byte_cursor = Cursor::new(png_bytes);
    let image_size = Decoder::new(&mut byte_cursor).read_header_info().map(Info::size);
    let (width, height) = image_size.map_err(|_| damage_error(&byte_cursor))?;
    if u64::from(width) * u64::from(height) > MAX_PIXELS as u64 {
        let error_message = format!("image has {width} × {height} pixels; allowed are at most {MAX_PIXELS}");
        return Err(ImageError(error_message));
    }
    byte_cursor.set_position(0);
    let image_pixels = decode_pixels(&mut byte_cursor).map_err(|_| damage_error(&byte_cursor))?;
    Ok(Image { width: width as usize, height: height as usize, pixels: image_pixels })
}

fn damage_error(byte_cursor: &Cursor<&[u8]>) -> ImageError {
    let (read_position, byte_count) = (byte_cursor.position(), byte_cursor.get_ref().len());
    ImageError(format!(
        "the PNG image is damaged or cut short before byte {read_position} of {byte_count}; allowed is a complete one"
    ))
}

fn decode_pixels(byte_cursor: &mut Cursor<&[u8]>) -> Result<Vec<[u8; 4]>, DecodingError> {
    let mut png_decoder = Decoder::new_with_limits(byte_cursor, Limits { bytes: 8 * MAX_PIXELS });
    png_decoder.set_transformations(Transformations::EXPAND);
    png_decoder.set_ignore_text_chunk(true);
    png_decoder.set_ignore_iccp_chunk(true);
    let mut png_reader = png_decoder.read_info()?;
    let (color_type, bit_depth) = png_reader.output_color_type();
    let mut raw_bytes = vec![0; png_reader.output_buffer_size().unwrap_or_default()];
    png_reader.next_frame(&mut raw_bytes)?;
    png_reader.finish()?;
    if bit_depth == BitDepth::Sixteen {
        // Samples of 16 bits are scaled to 8 bits with rounding, by the factor 65535/255 = 257.
        let to_byte = |png_bytes: &[u8; 2]| ((u32::from(u16::from_be_bytes(*png_bytes)) + 128) / 257) as u8;
        raw_bytes = raw_bytes.as_chunks().0.iter().map(to_byte).collect();
    }
    let with_full_opacity = |[red, green, blue]: [u8; 3]| [red, green, blue, u8::MAX];
    Ok(match color_type {
        ColorType::Grayscale => raw_bytes.iter().map(|grey| with_full_opacity([*grey; 3])).collect(),
        ColorType::GrayscaleAlpha => {
            raw_bytes.as_chunks().0.iter().map(|&[grey, opacity]| [grey, grey, grey, opacity]).collect()
        }
        ColorType::Rgb => raw_bytes.as_chunks().0.iter().map(|rgb| with_full_opacity(*rgb)).collect(),
        ColorType::Rgba => raw_bytes.as_chunks().0.to_vec(),
        ColorType::Indexed => unreachable!("a palette is expanded"),
    })
}
