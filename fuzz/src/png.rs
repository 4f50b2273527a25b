//! Fuzz target of the reader of PNG images: arbitrary bytes.

use motion::map::{Image, MAX_PIXELS, read_png};

/// Maximum number of pixels of an image. Larger images are slow, and other tests cover them.
const MAX_TESTED_PIXELS: usize = 1 << 16;

pub fn check_input(png_bytes: &[u8]) {
    if (MAX_TESTED_PIXELS..=MAX_PIXELS).contains(&read_pixel_count(png_bytes)) {
        return;
    }
    assert_read_or_refused(png_bytes);
    // The checksums are corrected, because the reader would otherwise refuse most mutations.
    assert_read_or_refused(&correct_checksums(png_bytes));
}

fn assert_read_or_refused(png_bytes: &[u8]) {
    match read_png(png_bytes) {
        Ok(Image { width: image_width, height: image_height, pixels }) => {
            assert!(image_width > 0 && image_height > 0);
            assert_eq!(pixels.len(), image_width * image_height);
        }
        Err(png_error) => {
            let error_message = png_error.to_string();
            assert!(error_message.contains("; allowed ") && error_message.len() < 300, "{error_message}");
        }
    }
}

/// Returns the number of pixels according to the header, or 0 if the header is cut short.
fn read_pixel_count(png_bytes: &[u8]) -> usize {
    let read_side_at = |header_offset| read_u32_at(png_bytes, header_offset).unwrap_or_default();
    read_side_at(16).saturating_mul(read_side_at(20))
}

fn read_u32_at(png_bytes: &[u8], byte_offset: usize) -> Option<usize> {
    let four_bytes = png_bytes.get(byte_offset..byte_offset + 4)?;
    Some(four_bytes.iter().fold(0, |number_so_far, byte| number_so_far << 8 | usize::from(*byte)))
}

/// Returns a copy of the image in which the checksum of every complete chunk is corrected.
fn correct_checksums(png_bytes: &[u8]) -> Vec<u8> {
    let mut png_bytes = png_bytes.to_vec();
    let mut chunk_start = 8;
    while let Some(chunk_data_length) = read_u32_at(&png_bytes, chunk_start) {
        let chunk_data_end = chunk_start + 8 + chunk_data_length;
        if chunk_data_end + 4 > png_bytes.len() {
            break;
        }
        let checksum = compute_crc32(&png_bytes[chunk_start + 4..chunk_data_end]);
        png_bytes[chunk_data_end..chunk_data_end + 4].copy_from_slice(&checksum.to_be_bytes());
        chunk_start = chunk_data_end + 4;
    }
    png_bytes
}

fn compute_crc32(checked_bytes: &[u8]) -> u32 {
    let advance_crc_by_bit = |crc_before_bit: u32| (crc_before_bit >> 1) ^ (0xedb8_8320 & (crc_before_bit & 1).wrapping_neg());
    !checked_bytes.iter().fold(!0, |crc_before_byte, byte| (0..8).fold(crc_before_byte ^ u32::from(*byte), |crc_before_byte, _| advance_crc_by_bit(crc_before_byte)))
}
