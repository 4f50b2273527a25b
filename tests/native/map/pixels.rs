//! Conversion of pixels to cells as in `map_server`, and valid and malformed PGM files.

use motion::geom::se2::SE2;
use motion::map::{Cell, Image, MAX_PIXELS, MapMode, OccupancyGrid, Pixel, PixelClassifier, read_pgm};

/// As in `map_server`, a cell is occupied if its occupancy is above the threshold, but not if it equals the threshold.
#[test]
fn pixels_are_read_as_map_server_reads_them() {
    let trinary_mode = PixelClassifier::default();
    let pixel = |grey_value: u8| Pixel { brightness: f32::from(grey_value) / 255.0, opacity: 1.0 };
    let new_transparent_pixel = |grey_value: u8| Pixel { opacity: 0.0, ..pixel(grey_value) };
    let scale_mode = PixelClassifier { mode: MapMode::Scale, ..trinary_mode };
    let raw_mode = PixelClassifier { mode: MapMode::Raw, ..trinary_mode };
    let set_occupied_threshold = |occupied_thresh| PixelClassifier { occupied_thresh, ..trinary_mode };
    let negate_with_threshold =
        |occupied_thresh| PixelClassifier { negate: true, ..set_occupied_threshold(occupied_thresh) };
    let with_free_threshold =
        |free_threshold| PixelClassifier { free_thresh: free_threshold, ..trinary_mode };
    let classifier_cases = [
        ("black", trinary_mode, pixel(0), Cell::Occupied),
        ("white", trinary_mode, pixel(255), Cell::Free),
        ("the grey that maps are saved with where nothing is known", trinary_mode, pixel(205), Cell::Unknown),
        ("occupancy 0.192", trinary_mode, pixel(206), Cell::Free),
        ("occupancy 0.651", trinary_mode, pixel(89), Cell::Occupied),
        ("occupancy 0.647", trinary_mode, pixel(90), Cell::Unknown),
        ("transparent black", trinary_mode, new_transparent_pixel(0), Cell::Occupied),
        ("black, negated", negate_with_threshold(0.65), pixel(0), Cell::Free),
        ("white, negated", negate_with_threshold(0.65), pixel(255), Cell::Occupied),
        ("at the threshold", set_occupied_threshold(0.6), pixel(102), Cell::Unknown),
        ("past it", set_occupied_threshold(0.6), pixel(101), Cell::Occupied),
        ("nothing is above 1", set_occupied_threshold(1.0), pixel(0), Cell::Unknown),
        ("at the threshold for free", with_free_threshold(0.2), pixel(204), Cell::Unknown),
        ("below the threshold for free", with_free_threshold(0.2), pixel(205), Cell::Free),
        ("nothing is below 0", with_free_threshold(0.0), pixel(255), Cell::Unknown),
        ("scale, black", scale_mode, pixel(0), Cell::Occupied),
        ("scale, transparent black is unknown", scale_mode, new_transparent_pixel(0), Cell::Unknown),
        ("scale, what is between the thresholds is known in degrees", scale_mode, pixel(150), Cell::Free),
        ("raw, 100", raw_mode, pixel(100), Cell::Occupied),
        ("raw, 99", raw_mode, pixel(99), Cell::Free),
        ("raw, 101 is unknown", raw_mode, pixel(101), Cell::Unknown),
        ("raw, 0 is free", raw_mode, pixel(0), Cell::Free),
        ("raw, 255 is unknown", raw_mode, pixel(255), Cell::Unknown),
        ("raw does not negate", PixelClassifier { negate: true, ..raw_mode }, pixel(100), Cell::Occupied),
        ("raw does not negate", PixelClassifier { negate: true, ..raw_mode }, pixel(155), Cell::Unknown),
    ];
    for (case_name, pixel_classifier, pixel, expected_cell) in classifier_cases {
        assert_eq!(
            pixel_classifier.classify_pixel(pixel),
            expected_cell,
            "{case_name}: {pixel_classifier:?} {pixel:?}"
        );
    }
}

fn shades_of(shade_image: &Image<f32>) -> &[f32] {
    assert_eq!(shade_image.pixels.len(), shade_image.width * shade_image.height);
    &shade_image.pixels
}

#[test]
fn pgm_rasters_may_hold_any_bytes() {
    let image_with_trailer = read_pgm(b"P5 2 1 5\n\x00\x05anything that follows").expect("a valid file");
    assert_eq!(shades_of(&image_with_trailer), [0.0, 1.0]);
    // The first byte of the raster may look like white space or a comment.
    assert_eq!(shades_of(&read_pgm(b"P5 2 1 255\n\n#").expect("two pixels")), [10.0 / 255.0, 35.0 / 255.0]);
    assert_eq!(shades_of(&read_pgm(b"P5 1 1 100\n\xff").expect("a pixel too bright")), [1.0]);
    // Editors on Windows end the lines of a header with two characters.
    for pgm_header in ["P5\r\n2 1\r\n5\r\n", "P5\r\n# by hand\r\n2 1 5\r\n", "P5 2 1 5\r\n"] {
        let file_bytes = [pgm_header.as_bytes(), &[0, 5]].concat();
        assert_eq!(
            shades_of(&read_pgm(&file_bytes).expect("a header of Windows")),
            [0.0, 1.0],
            "{pgm_header:?}"
        );
    }
    // If the file has exactly the expected length, the line feed after the carriage return is the first pixel.
    assert_eq!(shades_of(&read_pgm(b"P5 2 1 255\r\n#").expect("two pixels")), [10.0 / 255.0, 35.0 / 255.0]);
}

#[test]
fn errors_of_malformed_pgm_files_name_line_field_and_value() {
    let files_and_messages: [(&[u8], &str); 13] = [
        (b"", "line 1: the magic number is missing; allowed is P5 or P2"),
        (b"\x89PNG\r\n\x1a\n", r#"line 1: the magic number is "�PNG"; allowed is P5 or P2"#),
        (b"P5\n#384\n", "line 3: the width is missing; allowed is a whole number from 1 to 33554432"),
        (b"P5\n0 3\n255\n", r#"line 2: the width is "0"; allowed is a whole number from 1 to 33554432"#),
        (b"P5\n\xff\"\0 3\n", r#"line 2: the width is "�"�"; allowed is a whole number from 1 to 33554432"#),
        (
            b"P5\n99999999999999999999999 3\n255\n",
            r#"line 2: the width is "99999999999999999999…"; allowed is a whole number from 1 to 33554432"#,
        ),
        (b"P5\n3\n", "line 3: the height is missing; allowed is a whole number from 1 to 11184810"),
        (
            b"P5\n8192\n8192\n255\n",
            r#"line 3: the height is "8192"; allowed is a whole number from 1 to 4096"#,
        ),
        (b"P5\n3 2\n", "line 3: the maximum value is missing; allowed is a whole number from 1 to 65535"),
        (
            b"P5\n3 2\n256\n12345678901",
            "line 3: the length of the raster in bytes is 11; allowed is 12 for 3 × 2 pixels",
        ),
        (
            b"P2\n3 2\n255\n1 2 3\n4 5\n",
            "line 6: a pixel is missing; allowed is a whole number from 0 to 255",
        ),
        (
            b"P2\n3 2\n255\n1 2 3\n4 256 6\n",
            r#"line 5: a pixel is "256"; allowed is a whole number from 0 to 255"#,
        ),
        (
            b"P2\n3 2\n255\n1 2 3\n4 +5 6\n",
            r#"line 5: a pixel is "+5"; allowed is a whole number from 0 to 255"#,
        ),
    ];
    for (file_bytes, expected_message) in files_and_messages {
        let error_message = read_pgm(file_bytes).expect_err("malformed").to_string();
        assert_eq!(error_message, expected_message, "{}", file_bytes.escape_ascii());
    }
    let pgm_header = format!("P2\n{MAX_PIXELS} 1\n255\n");
    let pixel_error = read_pgm(pgm_header.as_bytes()).expect_err("no pixels").to_string();
    assert!(pixel_error.contains(": a pixel is missing"), "{pixel_error}");
}

/// In mode trinary, `map_server` averages opacity with the colours, if the image has transparency.
#[test]
fn transparency_counts_as_a_colour_in_trinary() {
    let are_cells_occupied = |shades_and_opacities: &[(f32, f32)]| -> Vec<bool> {
        let rgba_pixels: Vec<Pixel> =
            shades_and_opacities.iter().map(|&(brightness, opacity)| Pixel { brightness, opacity }).collect();
        let shade_image = Image { width: shades_and_opacities.len(), height: 1, pixels: rgba_pixels };
        let occupancy_grid =
            OccupancyGrid::new(&shade_image, &PixelClassifier::default(), 0.05, SE2::identity());
        occupancy_grid.cells().map(|grid_cell| grid_cell == Cell::Occupied).collect()
    };
    // Opaque black then has the shade (0 + 0 + 0 + 1)/4 = 0.25, dark grey of 60/255 has 0.43, and transparent white 0.75.
    assert_eq!(
        are_cells_occupied(&[(0.0, 1.0), (60.0 / 255.0, 1.0), (1.0, 0.0), (0.0, 0.0)]),
        [true, false, false, true]
    );
    assert_eq!(
        are_cells_occupied(&[(0.0, 1.0), (60.0 / 255.0, 1.0), (1.0, 1.0)]),
        [true, true, false],
        "no transparency"
    );
}
