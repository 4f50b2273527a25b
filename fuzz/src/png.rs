//! PNG images.

use motion::map::{Image, MAX_PIXELS, read_png};

/// Maximum number of pixels of an image. Larger images are slow, and other tests cover them.
const MAX_TESTED_PIXELS: usize = 1 << 16;

pub fn run(bytes: &[u8]) {
    if (MAX_TESTED_PIXELS..=MAX_PIXELS).contains(&pixel_count(bytes)) {
        return;
    }
    assert_read_or_refused(bytes);
    // The checksums are corrected, because the reader would otherwise refuse most mutations.
    assert_read_or_refused(&correct_checksums(bytes));
}

fn assert_read_or_refused(bytes: &[u8]) {
    match read_png(bytes) {
        Ok(Image { width, height, pixels }) => {
            assert!(width > 0 && height > 0);
            assert_eq!(pixels.len(), width * height);
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains("; allowed ") && message.len() < 300, "{message}");
        }
    }
}

/// Returns the number of pixels according to the header, or 0 if the header is cut short.
fn pixel_count(bytes: &[u8]) -> usize {
    let image_side_at = |offset| number_at(bytes, offset).unwrap_or_default();
    image_side_at(16).saturating_mul(image_side_at(20))
}

fn number_at(bytes: &[u8], offset: usize) -> Option<usize> {
    let big_endian_bytes = bytes.get(offset..offset + 4)?;
    Some(big_endian_bytes.iter().fold(0, |number, byte| number << 8 | usize::from(*byte)))
}

/// Returns the image with the checksum of every complete chunk corrected.
fn correct_checksums(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let mut chunk_start = 8;
    while let Some(length) = number_at(&bytes, chunk_start) {
        let data_end = chunk_start + 8 + length;
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
    let shift_bit = |crc: u32| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg());
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| shift_bit(crc)))
}
