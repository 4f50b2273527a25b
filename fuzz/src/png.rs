//! PNG images.

use motion::map::{Image, MAX_PIXELS, read_png};

/// Maximum number of pixels of an image. Larger images are slow, and other tests cover them.
const MAX_TESTED_PIXELS: usize = 1 << 16;

pub fn run(png_bytes: &[u8]) {
    if (MAX_TESTED_PIXELS..=MAX_PIXELS).contains(&pixel_count(png_bytes)) {
        return;
    }
    assert_read_or_refused(png_bytes);
    // The checksums are corrected, because the reader would otherwise refuse most mutations.
    assert_read_or_refused(&correct_checksums(png_bytes));
}

fn assert_read_or_refused(png_bytes: &[u8]) {
    match read_png(png_bytes) {
        Ok(Image { width, height, pixels }) => {
            assert!(width > 0 && height > 0);
            assert_eq!(pixels.len(), width * height);
        }
        Err(png_error) => {
            let message = png_error.to_string();
            assert!(message.contains("; allowed ") && message.len() < 300, "{message}");
        }
    }
}

/// Returns the number of pixels according to the header, or 0 if the header is cut short.
fn pixel_count(bytes: &[u8]) -> usize {
    let image_side_at = |header_offset| number_at(bytes, header_offset).unwrap_or_default();
    image_side_at(16).saturating_mul(image_side_at(20))
}

fn number_at(png_bytes: &[u8], byte_offset: usize) -> Option<usize> {
    let big_endian_bytes = png_bytes.get(byte_offset..byte_offset + 4)?;
    Some(big_endian_bytes.iter().fold(0, |number_so_far, byte| number_so_far << 8 | usize::from(*byte)))
}

/// Returns the image with the checksum of every complete chunk corrected.
fn correct_checksums(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let mut chunk_start = 8;
    while let Some(data_length) = number_at(&bytes, chunk_start) {
        let data_end = chunk_start + 8 + data_length;
        if data_end + 4 > bytes.len() {
            break;
        }
        let checksum = crc32(&bytes[chunk_start + 4..data_end]);
        bytes[data_end..data_end + 4].copy_from_slice(&checksum.to_be_bytes());
        chunk_start = data_end + 4;
    }
    bytes
}

fn crc32(bytes: &[u8]) -> u32 {
    let shift_crc_bit = |crc_so_far: u32| (crc_so_far >> 1) ^ (0xedb8_8320 & (crc_so_far & 1).wrapping_neg());
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| shift_crc_bit(crc)))
}
