//! PNG images.

use motion::map::{Image, MAX_PIXELS, read_png};

/// Maximum number of pixels of an image. Larger images are slow, and other tests cover them.
const PIXELS: usize = 1 << 16;

pub fn run(bytes: &[u8]) {
    if (PIXELS..=MAX_PIXELS).contains(&area(bytes)) {
        return;
    }
    read(bytes);
    // Most mutations would end at a checksum.
    read(&corrected(bytes));
}

fn read(bytes: &[u8]) {
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

/// Number of pixels that the header announces, or 0 if the header is cut short.
fn area(bytes: &[u8]) -> usize {
    let side = |at| number(bytes, at).unwrap_or_default();
    side(16).saturating_mul(side(20))
}

fn number(bytes: &[u8], at: usize) -> Option<usize> {
    let four = bytes.get(at..at + 4)?;
    Some(four.iter().fold(0, |number, byte| number << 8 | usize::from(*byte)))
}

/// Returns the image with the checksum of every complete chunk corrected.
fn corrected(bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let mut at = 8;
    while let Some(length) = number(&bytes, at) {
        let end = at + 8 + length;
        if end + 4 > bytes.len() {
            break;
        }
        let checksum = crc32(&bytes[at + 4..end]);
        bytes[end..end + 4].copy_from_slice(&checksum.to_be_bytes());
        at = end + 4;
    }
    bytes
}

fn crc32(bytes: &[u8]) -> u32 {
    let shift = |crc: u32| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg());
    !bytes.iter().fold(!0, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| shift(crc)))
}
