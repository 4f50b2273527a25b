//! PNG images: every colour type is read exactly, and damaged or too large images are refused.

use crate::common::seeded_rng;
use motion::geom::se2::SE2;
use motion::map::{PixelClassifier, read_grid, read_png};
use png::{BitDepth, ColorType, Encoder, Filter};
use rand::Rng;

struct PngFormat {
    color_type: ColorType,
    bit_depth: u32,
    palette: Option<Vec<u8>>,
    transparency: Option<Vec<u8>>,
}

/// Returns the PNG file of an image, from its samples pixel by pixel.
fn encode_png(png_format: &PngFormat, image_width: u32, channel_values: &[u16]) -> Vec<u8> {
    let row_length = image_width as usize * png_format.color_type.samples();
    let mut packed_rows = Vec::new();
    for sample_row in channel_values.chunks(row_length) {
        let bit_depth = png_format.bit_depth as usize;
        let binary_row: String =
            sample_row.iter().map(|channel_value| format!("{channel_value:0bit_depth$b}")).collect();
        let row_bytes = binary_row.as_bytes().chunks(8).map(|byte_digits| {
            let digits_and_places = byte_digits.iter().zip((0..8).rev());
            digits_and_places.map(|(bit_digit, bit_place)| (bit_digit - b'0') << bit_place).sum::<u8>()
        });
        packed_rows.extend(row_bytes);
    }
    let mut file_bytes = Vec::new();
    let mut png_encoder =
        Encoder::new(&mut file_bytes, image_width, (channel_values.len() / row_length) as u32);
    png_encoder.set_color(png_format.color_type);
    png_encoder.set_depth(BitDepth::from_u8(png_format.bit_depth as u8).expect("a depth"));
    png_encoder.set_filter(Filter::Adaptive);
    // A gamma chunk changes the shades in browsers. The tested reader must ignore this chunk.
    png_encoder.set_source_gamma(png::ScaledFloat::new(0.3));
    if let Some(palette) = &png_format.palette {
        png_encoder.set_palette(palette.clone());
    }
    if let Some(transparency) = &png_format.transparency {
        png_encoder.set_trns(transparency.clone());
    }
    png_encoder.write_header().expect("a header").write_image_data(&packed_rows).expect("an image");
    file_bytes
}

fn encode_grey_png(image_width: u32, channel_values: &[u16]) -> Vec<u8> {
    let grey_format =
        PngFormat { color_type: ColorType::Grayscale, bit_depth: 8, palette: None, transparency: None };
    encode_png(&grey_format, image_width, channel_values)
}

#[test]
fn every_kind_of_image_is_decoded_exactly() {
    let mut rng = seeded_rng(9911);
    let color_types_and_depths = [
        (ColorType::Grayscale, &[1, 2, 4, 8, 16][..]),
        (ColorType::Rgb, &[8, 16]),
        (ColorType::Indexed, &[1, 2, 4, 8]),
        (ColorType::GrayscaleAlpha, &[8, 16]),
        (ColorType::Rgba, &[8, 16]),
    ];
    for (color_type, bit_depths) in color_types_and_depths {
        for (&bit_depth, (image_width, image_height)) in
            bit_depths.iter().flat_map(|bit_depth| [(bit_depth, (1, 1)), (bit_depth, (33, 17))])
        {
            for has_transparency in [false, true] {
                let sample_count = image_width as usize * image_height * color_type.samples();
                let mut draw_below = |exclusive_limit: u32| (rng.next_u32() % exclusive_limit) as u16;
                let channel_values: Vec<u16> =
                    (0..sample_count).map(|_| draw_below(1 << bit_depth)).collect();
                let palette: Vec<u8> = (0..3 << bit_depth.min(8)).map(|_| draw_below(256) as u8).collect();
                let palette_opacities: Vec<u8> =
                    (0..1 << (bit_depth.min(8) - 1)).map(|_| draw_below(256) as u8).collect();
                let first_pixel = &channel_values[..color_type.samples()];
                let transparency = match color_type {
                    ColorType::Indexed => palette_opacities.clone(),
                    _ => first_pixel.iter().flat_map(|channel_value| channel_value.to_be_bytes()).collect(),
                };
                let has_transparent_colour =
                    has_transparency && !matches!(color_type, ColorType::GrayscaleAlpha | ColorType::Rgba);
                let png_format = PngFormat {
                    color_type,
                    bit_depth,
                    palette: (color_type == ColorType::Indexed).then(|| palette.clone()),
                    transparency: has_transparent_colour.then_some(transparency),
                };
                let max_sample = f64::from((1u32 << bit_depth) - 1);
                let scale_to_byte =
                    |channel_value: u16| (255.0 * f64::from(channel_value) / max_sample).round() as u8;
                let expected_pixels: Vec<[u8; 4]> = channel_values
                    .chunks(color_type.samples())
                    .map(|channel_values| {
                        let sample_bytes: Vec<u8> = channel_values
                            .iter()
                            .map(|channel_value| scale_to_byte(*channel_value))
                            .collect();
                        let opacity =
                            if has_transparent_colour && channel_values == first_pixel { 0 } else { 255 };
                        match *sample_bytes {
                            [_] if color_type == ColorType::Indexed => {
                                let palette_index = usize::from(channel_values[0]);
                                let opacity =
                                    palette_opacities.get(palette_index).filter(|_| has_transparent_colour);
                                let [red, green, blue] = [0, 1, 2].map(|k| palette[3 * palette_index + k]);
                                [red, green, blue, opacity.copied().unwrap_or(255)]
                            }
                            [grey_value] => [grey_value, grey_value, grey_value, opacity],
                            [grey_value, opacity] => [grey_value, grey_value, grey_value, opacity],
                            [red, green, blue] => [red, green, blue, opacity],
                            [red, green, blue, opacity] => [red, green, blue, opacity],
                            _ => unreachable!("four samples at most"),
                        }
                    })
                    .collect();
                let decoded_image =
                    read_png(&encode_png(&png_format, image_width, &channel_values)).expect("an image");
                assert_eq!((decoded_image.width, decoded_image.height), (image_width as usize, image_height));
                assert_eq!(
                    decoded_image.pixels, expected_pixels,
                    "{color_type:?} {bit_depth} {image_width} {has_transparency}"
                );
            }
        }
    }
}

#[test]
fn an_image_that_is_cut_short_is_refused() {
    let file_bytes = encode_grey_png(20, &[7; 400]);
    assert!(read_png(&file_bytes).is_ok());
    for cut_length in 0..file_bytes.len() {
        let error_message = read_png(&file_bytes[..cut_length]).expect_err("it ends").to_string();
        let error_offset = error_message
            .strip_prefix("the PNG image is damaged or cut short before byte ")
            .and_then(|remaining_message| {
                remaining_message.strip_suffix(&format!(" of {cut_length}; allowed is a complete one"))
            })
            .expect(&error_message);
        assert!(error_offset.parse::<usize>().is_ok_and(|offset| offset <= cut_length), "{error_message}");
    }
    let grid_error = read_grid(&file_bytes[..60], &PixelClassifier::default(), 0.05, SE2::identity());
    assert_eq!(grid_error.expect_err("it ends"), read_png(&file_bytes[..60]).expect_err("it ends"));
}
