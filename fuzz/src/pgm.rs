//! Fuzz target of the reader of PGM images: arbitrary bytes.

use motion::geom::se2::SE2;
use motion::map::{FloorPlan, Image, PixelClassifier, MAX_PIXELS, OccupancyGrid, read_grid, read_pgm};
use std::fmt::Write;

pub fn check_input(pgm_bytes: &[u8]) {
    match read_pgm(pgm_bytes).map_err(|pgm_error| pgm_error.to_string()) {
        Ok(image) => {
            let Image { width: image_width, height: image_height, ref pixels } = image;
            assert!(image_width > 0 && image_height > 0 && image_width * image_height <= MAX_PIXELS);
            assert_eq!(pixels.len(), image_width * image_height);
            assert!(pixels.iter().all(|brightness| (0.0..=1.0).contains(brightness)));
            if pixels.len() <= 64 {
                assert_same_after_writing(&image);
                let grid = OccupancyGrid::new(&image, &PixelClassifier::default(), 1.0, SE2::identity());
                assert_eq!(
                    read_grid(pgm_bytes, &PixelClassifier::default(), 1.0, SE2::identity()).as_ref(),
                    Ok(&grid)
                );
                assert!(FloorPlan::from_grid(grid).is_ok());
            }
        }
        Err(error_message) => {
            assert!(error_message.contains("; allowed is ") && error_message.len() < 300, "{error_message}");
        }
    }
}

/// Asserts that an image written with 16 bits, as text or binary, is read as the same image. Shades are rounded to 1/65 535.
fn assert_same_after_writing(image: &Image<f32>) {
    const MAX_GREY_VALUE: f32 = 65_535.0;
    let mut plain_pgm = format!("P2\n{} {}\n{MAX_GREY_VALUE}", image.width, image.height);
    let mut binary_pgm = format!("P5 {} {} {MAX_GREY_VALUE}\n", image.width, image.height).into_bytes();
    for brightness in &image.pixels {
        let grey_value = (brightness * MAX_GREY_VALUE).round() as u16;
        write!(plain_pgm, " {grey_value}").expect("memory");
        binary_pgm.extend(grey_value.to_be_bytes());
    }
    let reread_image = read_pgm(plain_pgm.as_bytes()).expect("a plain file");
    assert_eq!(reread_image, read_pgm(&binary_pgm).expect("a binary file"));
    assert_eq!((reread_image.width, reread_image.height), (image.width, image.height));
    for (brightness, reread_brightness) in image.pixels.iter().zip(&reread_image.pixels) {
        assert!((brightness - reread_brightness).abs() <= 0.51 / MAX_GREY_VALUE, "{brightness} {reread_brightness}");
    }
}
