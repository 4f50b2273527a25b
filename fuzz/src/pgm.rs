//! Files of maps.

use motion::geom::se2::SE2;
use motion::map::{FloorPlan, Image, Interpretation, MAX_PIXELS, OccupancyGrid, Pixel, read_grid, read_pgm};
use std::fmt::Write;

pub fn run(bytes: &[u8]) {
    match read(bytes) {
        Ok(image) => {
            let Image { width, height, ref pixels } = image;
            assert!(width > 0 && height > 0 && width * height <= MAX_PIXELS);
            assert_eq!(pixels.len(), width * height);
            assert!(pixels.iter().all(|pixel| (0.0..=1.0).contains(&pixel.shade) && pixel.opacity == 1.0));
            if pixels.len() <= 64 {
                assert_written_reads_the_same(&image);
                let grid = OccupancyGrid::new(&image, &Interpretation::default(), 1.0, SE2::identity());
                assert_eq!(
                    read_grid(bytes, &Interpretation::default(), 1.0, SE2::identity()).as_ref(),
                    Ok(&grid)
                );
                assert!(FloorPlan::from_grid(grid).is_ok());
            }
        }
        Err(message) => {
            assert!(message.contains("; allowed is ") && message.len() < 300, "{message}");
        }
    }
}

/// Returns the whole image, or the reason of the refusal.
fn read(bytes: &[u8]) -> Result<Image<Vec<Pixel>>, String> {
    let Image { width, height, pixels } = read_pgm(bytes).map_err(|error| error.to_string())?;
    Ok(Image { width, height, pixels: pixels.map(Pixel::from).collect() })
}

/// Asserts that an image that is written with 16 bits, plain or binary, is read as the same image. Shades may differ by a 65 535th, to
/// which they are rounded.
fn assert_written_reads_the_same(image: &Image<Vec<Pixel>>) {
    const GREATEST: f32 = 65_535.0;
    let mut plain = format!("P2\n{} {}\n{GREATEST}", image.width, image.height);
    let mut binary = format!("P5 {} {} {GREATEST}\n", image.width, image.height).into_bytes();
    for pixel in &image.pixels {
        let value = (pixel.shade * GREATEST).round() as u16;
        write!(plain, " {value}").expect("memory");
        binary.extend(value.to_be_bytes());
    }
    let again = read(plain.as_bytes()).expect("a plain file");
    assert_eq!(again, read(&binary).expect("a binary file"));
    assert_eq!((again.width, again.height), (image.width, image.height));
    for (before, after) in image.pixels.iter().zip(&again.pixels) {
        assert!((before.shade - after.shade).abs() <= 0.51 / GREATEST, "{before:?} {after:?}");
    }
}
