//! Occupancy grids: exact distances to their cells, `map_server`'s reading of pixels, and PGM files good and bad.
#![allow(
    clippy::disallowed_methods,
    reason = "an expected value may come from the platform's own mathematics"
)]

mod common;

use common::{seeded, uniform};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{
    Cell, FloorPlan, FloorPlanError, Image, Interpretation, MAX_PIXELS, Mode, OccupancyGrid, PgmError, Pixel,
    Shades, Unknown, read_pgm,
};
use rand::Rng;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const TRINARY: Interpretation =
    Interpretation { mode: Mode::Trinary, negate: false, occupied_thresh: 0.65, free_thresh: 0.196 };
const BLACK: Pixel = Pixel { shade: 0.0, opacity: 1.0 };
const WHITE: Pixel = Pixel { shade: 1.0, opacity: 1.0 };

/// A grid of which the tests know every cell.
struct Cells {
    width: usize,
    height: usize,
    /// Row by row from the top, as in the image.
    occupied: Vec<bool>,
    resolution: f64,
    /// x, y and yaw of the lower left corner.
    origin: [f64; 3],
}

impl Cells {
    fn random(rng: &mut impl Rng) -> Self {
        let (width, height) = (1 + (rng.next_u32() % 12) as usize, 1 + (rng.next_u32() % 12) as usize);
        let density = uniform(rng, 0.05, 0.9);
        let occupied = (0..width * height).map(|_| uniform(rng, 0.0, 1.0) < density).collect();
        let yaw = if rng.next_u32().is_multiple_of(3) { FRAC_PI_2 } else { uniform(rng, -PI, PI) };
        let origin = [uniform(rng, -50.0, 50.0), uniform(rng, -50.0, 50.0), yaw];
        Self { width, height, occupied, resolution: uniform(rng, 0.02, 0.5), origin }
    }

    fn grid(&self) -> OccupancyGrid {
        let pixels = self.occupied.iter().map(|occupied| if *occupied { BLACK } else { WHITE });
        let image = Image { width: self.width, height: self.height, pixels };
        let [x, y, yaw] = self.origin;
        OccupancyGrid::new(&image, &TRINARY, self.resolution, SE2::new(x, y, yaw))
    }

    /// Where a point of the grid's own axes, in cells, stands in the map.
    fn in_map(&self, column: f64, row: f64) -> [f64; 2] {
        let ([x, y, yaw], (u, v)) = (self.origin, (column * self.resolution, row * self.resolution));
        [x + u * yaw.cos() - v * yaw.sin(), y + u * yaw.sin() + v * yaw.cos()]
    }

    /// The distance to the nearest occupied cell, each measured as a square; 0 inside of one.
    fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        let ([x0, y0, yaw], size) = (self.origin, self.resolution);
        let u = (x - x0) * yaw.cos() + (y - y0) * yaw.sin();
        let v = (y - y0) * yaw.cos() - (x - x0) * yaw.sin();
        let outside = |at: f64, cell: usize| {
            let low = cell as f64 * size;
            (low - at).max(at - low - size).max(0.0)
        };
        let occupied = (0..self.occupied.len()).filter(|i| self.occupied[*i]);
        occupied
            .map(|i| outside(u, i % self.width).hypot(outside(v, self.height - 1 - i / self.width)))
            .fold(f64::INFINITY, f64::min)
    }
}

// ----------------------------------------------------------------------------------------------------- distances

/// The walls made of a grid are as far from everyone outside the occupied cells as the cells themselves.
#[test]
fn the_walls_are_as_far_as_the_cells() {
    let mut rng = seeded(9900);
    let (mut inside, mut outside) = (0, 0);
    for _ in 0..400 {
        let cells = Cells::random(&mut rng);
        let plan = FloorPlan::from_grid(cells.grid()).expect("a small grid");
        let [left, bottom, right, top] = plan.bounds();
        for _ in 0..50 {
            let column = uniform(&mut rng, 0.0, cells.width as f64);
            let row = uniform(&mut rng, 0.0, cells.height as f64);
            let point = cells.in_map(column, row);
            assert!((left..=right).contains(&point[0]) && (bottom..=top).contains(&point[1]));
            let distance = cells.distance(point);
            if distance == 0.0 {
                assert!(cells.grid().holds(point) && !plan.point_free(point, 0.0).free, "inside a cell");
                inside += 1;
                continue;
            }
            let nearest =
                plan.walls().iter().map(|wall| wall.distance_to_point(point)).fold(f64::INFINITY, f64::min);
            // Fifty metres from the origin the corners are rounded by 1e-14 m.
            assert!(nearest == distance || (nearest - distance).abs() < 1e-13, "{nearest}, {distance}");
            let clearance = uniform(&mut rng, 0.0, 1.0);
            if (clearance - distance).abs() > 1e-12 {
                assert_eq!(plan.point_free(point, clearance).free, distance > clearance);
            }
            outside += 1;
        }
    }
    assert!(inside > 4000 && outside > 4000, "{inside} {outside}");
}

/// Arcs through a grid, judged by looking at 200 points of each.
#[test]
fn arcs_are_judged_by_the_cells() {
    let mut rng = seeded(9901);
    let (mut free, mut blocked, mut buried) = (0, 0, 0);
    for _ in 0..300 {
        let cells = Cells::random(&mut rng);
        let grid = cells.grid();
        let (origin, side) = (grid.origin(), grid.resolution());
        let [right, top] = [cells.width as f64 * side, cells.height as f64 * side];
        let plan = FloorPlan::from_grid(grid).expect("a small grid");
        // How far inside the edge of the map, which turns with the grid.
        let depth = |x: f64, y: f64| {
            let local = origin.inverse() * SE2::new(x, y, 0.0);
            local.x().min(right - local.x()).min(local.y()).min(top - local.y())
        };
        for _ in 0..30 {
            let at = cells.in_map(
                uniform(&mut rng, 0.0, cells.width as f64),
                uniform(&mut rng, 0.0, cells.height as f64),
            );
            let length = uniform(&mut rng, -2.0, 2.0) * cells.resolution;
            let start = SE2::new(at[0], at[1], uniform(&mut rng, -PI, PI));
            let arc = Arc { start, length, turn: uniform(&mut rng, -TAU, TAU) };
            let clearance = uniform(&mut rng, 0.0, 0.7) * cells.resolution;
            let (mut least, mut edge) = (f64::INFINITY, f64::INFINITY);
            for i in 0..=200 {
                let f = f64::from(i) / 200.0;
                let end = Arc { length: f * arc.length, turn: f * arc.turn, ..arc }.end();
                let room = cells.distance([end.x(), end.y()]) - clearance;
                edge = edge.min(depth(end.x(), end.y()));
                least = least.min(room);
            }
            // Between two of the points either distance falls by half their spacing at most.
            let between = 0.5 * length.abs() / 200.0;
            let verdict = plan.arc_free(&arc, clearance).free;
            if least <= -1e-12 || edge <= -1e-12 {
                assert!(!verdict, "{arc:?}");
                blocked += 1;
                buried += u32::from(cells.distance(at) == 0.0);
            } else if least > between && edge > between {
                assert!(verdict, "{arc:?}");
                free += 1;
            }
        }
    }
    assert!(free > 500 && blocked > 500 && buried > 500, "{free} {blocked} {buried}");
}

/// Deep inside a block there is no wall within reach, and yet nobody is free there.
#[test]
fn a_block_is_solid() {
    let side = 40;
    let cells = Cells {
        width: side,
        height: side,
        occupied: vec![true; side * side],
        resolution: 1.0,
        origin: [-20.0, -20.0, 0.0],
    };
    let plan = FloorPlan::from_grid(cells.grid()).expect("four walls");
    assert_eq!(plan.walls().len(), 4, "{:?}", plan.walls());
    assert!(!plan.point_free([0.0, 0.0], 0.1).free);
    let inside = Arc { start: SE2::new(0.0, 0.0, 0.5), length: 3.0, turn: 1.0 };
    assert!(!plan.arc_free(&inside, 0.1).free);
    assert_eq!(plan.open_place(0.1), None);
}

/// Neighbouring sides are one wall, sides between two occupied cells are none, and corners touch.
#[test]
fn outlines_are_joined() {
    let picture = ["##.", "#..", "..#"];
    let occupied = picture.iter().flat_map(|row| row.chars().map(|cell| cell == '#')).collect();
    let cells = Cells { width: 3, height: 3, occupied, resolution: 0.5, origin: [1.0, 2.0, 0.0] };
    let plan = FloorPlan::from_grid(cells.grid()).expect("a small grid");
    let mut walls: Vec<[f64; 4]> =
        plan.walls().iter().map(|Segment { from, to }| [from[0], from[1], to[0], to[1]]).collect();
    walls.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    let expected = [
        [1.0, 2.5, 1.5, 2.5],
        [1.0, 2.5, 1.0, 3.5],
        [1.0, 3.5, 2.0, 3.5],
        [1.5, 2.5, 1.5, 3.0],
        [1.5, 3.0, 2.0, 3.0],
        [2.0, 2.0, 2.5, 2.0],
        [2.0, 2.0, 2.0, 2.5],
        [2.0, 2.5, 2.5, 2.5],
        [2.0, 3.0, 2.0, 3.5],
        [2.5, 2.0, 2.5, 2.5],
    ];
    let mut expected = expected.to_vec();
    expected.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    assert_eq!(walls, expected);
    assert_eq!(plan.bounds(), [1.0, 2.0, 2.5, 3.5]);
    let turned = Cells { origin: [1.0, 2.0, FRAC_PI_2], ..cells };
    let bounds = FloorPlan::from_grid(turned.grid()).expect("a small grid").bounds();
    for (bound, expected) in bounds.into_iter().zip([-0.5, 2.0, 1.0, 3.5]) {
        assert!((bound - expected).abs() < 1e-15, "{bounds:?}");
    }
}

#[test]
fn a_grid_of_too_many_walls_is_refused() {
    let side = 320;
    let occupied = (0..side * side).map(|i| i / side % 2 == 0 && i % side % 2 == 0).collect();
    let dots = Cells { width: side, height: side, occupied, resolution: 0.05, origin: [0.0; 3] };
    // 160 · 160 cells that stand alone, with four sides each.
    let error = FloorPlan::from_grid(dots.grid()).err();
    // Counted no further than the row or column that passed the limit.
    assert!(matches!(error, Some(FloorPlanError::TooManyWalls(100_001..=100_320))), "{error:?}");
}

// -------------------------------------------------------------------------------------------- map_server's pixels

/// As `map_server` reads them: occupied where the occupancy is above the threshold, not where it is at it.
#[test]
fn pixels_are_read_as_map_server_reads_them() {
    let pixel = |value: u8| Pixel { shade: f32::from(value) / 255.0, opacity: 1.0 };
    let clear = |value: u8| Pixel { opacity: 0.0, ..pixel(value) };
    let scale = Interpretation { mode: Mode::Scale, ..TRINARY };
    let raw = Interpretation { mode: Mode::Raw, ..TRINARY };
    let at = |occupied_thresh| Interpretation { occupied_thresh, ..TRINARY };
    let negated = |occupied_thresh| Interpretation { negate: true, ..at(occupied_thresh) };
    let free_below = |free_thresh| Interpretation { free_thresh, ..TRINARY };
    let cases = [
        ("black", TRINARY, pixel(0), Cell::Occupied),
        ("white", TRINARY, pixel(255), Cell::Free),
        ("the grey that maps are saved with where nothing is known", TRINARY, pixel(205), Cell::Unknown),
        ("which is free by another threshold", free_below(0.25), pixel(205), Cell::Free),
        ("occupancy 0.192", TRINARY, pixel(206), Cell::Free),
        ("occupancy 0.651", TRINARY, pixel(89), Cell::Occupied),
        ("occupancy 0.647", TRINARY, pixel(90), Cell::Unknown),
        ("transparent black", TRINARY, clear(0), Cell::Occupied),
        ("black, negated", negated(0.65), pixel(0), Cell::Free),
        ("white, negated", negated(0.65), pixel(255), Cell::Occupied),
        ("occupancy 0.651, negated", negated(0.65), pixel(166), Cell::Occupied),
        ("occupancy 0.647, negated", negated(0.65), pixel(165), Cell::Unknown),
        ("at the threshold", at(0.6), pixel(102), Cell::Unknown),
        ("past it", at(0.6), pixel(101), Cell::Occupied),
        ("at the threshold of 0.2", at(0.2), pixel(204), Cell::Unknown),
        ("at the threshold, negated", negated(0.6), pixel(153), Cell::Unknown),
        ("past it, negated", negated(0.6), pixel(154), Cell::Occupied),
        ("at the threshold of 0.2, negated", negated(0.2), pixel(51), Cell::Unknown),
        ("nothing is above 1", at(1.0), pixel(0), Cell::Unknown),
        ("at the threshold for free", free_below(0.2), pixel(204), Cell::Unknown),
        ("below the threshold for free", free_below(0.2), pixel(205), Cell::Free),
        ("nothing is below 0", free_below(0.0), pixel(255), Cell::Unknown),
        ("scale, black", scale, pixel(0), Cell::Occupied),
        ("scale, transparent black is unknown", scale, clear(0), Cell::Unknown),
        ("scale, transparent white is unknown", scale, clear(255), Cell::Unknown),
        ("scale, white", scale, pixel(255), Cell::Free),
        ("scale, what is between the thresholds is known in degrees", scale, pixel(150), Cell::Free),
        ("raw, 100", raw, pixel(100), Cell::Occupied),
        ("raw, 99", raw, pixel(99), Cell::Free),
        ("raw, 101 is unknown", raw, pixel(101), Cell::Unknown),
        ("raw, 0 is free", raw, pixel(0), Cell::Free),
        ("raw, 255 is unknown", raw, pixel(255), Cell::Unknown),
        ("raw does not negate", Interpretation { negate: true, ..raw }, pixel(100), Cell::Occupied),
        ("raw does not negate", Interpretation { negate: true, ..raw }, pixel(155), Cell::Unknown),
    ];
    for (name, interpretation, pixel, cell) in cases {
        assert_eq!(interpretation.cell(pixel), cell, "{name}: {interpretation:?} {pixel:?}");
    }
}

// ----------------------------------------------------------------------------------------------------------- PGM

fn shades(image: &Image<Shades>) -> Vec<f32> {
    assert_eq!(image.pixels.len(), image.width * image.height);
    assert!(image.pixels.clone().all(|pixel| pixel.opacity == 1.0));
    image.pixels.clone().map(|pixel| pixel.shade).collect()
}

#[test]
fn pgm_files_are_read() {
    let expected = [0.0, 1.0, 0.2, 0.4, 0.6, 0.8];
    let mut wide = b"P5 3 2 65535\n".to_vec();
    wide.extend([0u16, 65535, 13107, 26214, 39321, 52428].into_iter().flat_map(u16::to_be_bytes));
    let mut after = b"P5\n# made by hand\n3 2\n255\n\x00\xff\x33\x66\x99\xcc".to_vec();
    after.extend(b"anything that follows");
    let files: [&[u8]; 7] = [
        b"P2\n3 2\n255\n0 255 51\n102 153 204\n",
        b"P2 3 2 5 0 5 1 2 3 4",
        b"P2 # plain\n#comment\n 3 # width\n\t2\r\n#\n255\n0 255 #51\n51 102 153 204#end",
        b"P5 3 2 255\n\x00\xff\x33\x66\x99\xcc",
        b"P5\n3\n2\n5\n\x00\x05\x01\x02\x03\x04",
        &after,
        &wide,
    ];
    for file in files {
        let image = read_pgm(file).expect("a valid file");
        assert_eq!((image.width, image.height), (3, 2));
        for (shade, expected) in shades(&image).into_iter().zip(expected) {
            assert!((shade - expected).abs() < 1e-7, "{file:?}: {:?}", shades(&image));
        }
    }
    // The first byte of the raster may look like white space or a comment.
    assert_eq!(shades(&read_pgm(b"P5 2 1 255\n\n#").expect("two pixels")), [10.0 / 255.0, 35.0 / 255.0]);
    assert_eq!(shades(&read_pgm(b"P5 1 1 100\n\xff").expect("a pixel too bright")), [1.0]);
}

/// The first row of the file is the top of the map.
#[test]
fn the_image_stands_upright() {
    let image = read_pgm(b"P2 2 3 1  0 1  1 1  1 1").expect("a valid file");
    let plan = FloorPlan::from_grid(OccupancyGrid::new(&image, &TRINARY, 0.5, SE2::new(10.0, 20.0, 0.0)));
    let plan = plan.expect("one cell");
    assert!(!plan.point_free([10.25, 21.25], 0.0).free, "the cell at the upper left");
    assert!(plan.point_free([10.25, 20.25], 0.7).free && plan.point_free([10.75, 21.25], 0.2).free);
    assert_eq!((plan.walls().len(), plan.bounds()), (4, [10.0, 20.0, 11.0, 21.5]));
}

/// A sentence that names the line, the field, its value and what is allowed.
#[test]
fn malformed_pgm_files_are_explained() {
    let cases: [(&[u8], &str); 24] = [
        (b"", "line 1: the magic number is missing; allowed is P5 or P2"),
        (b"P6 1 1 255 abc", r#"line 1: the magic number is "P6"; allowed is P5 or P2"#),
        (b"\x89PNG\r\n\x1a\n", r#"line 1: the magic number is "�PNG"; allowed is P5 or P2"#),
        (b"# only\n# comments", "line 2: the magic number is missing; allowed is P5 or P2"),
        (b"P5", "line 1: the width is missing; allowed is a whole number from 1 to 16777216"),
        (b"P5\n#384\n", "line 3: the width is missing; allowed is a whole number from 1 to 16777216"),
        (b"P5\n0 3\n255\n", r#"line 2: the width is "0"; allowed is a whole number from 1 to 16777216"#),
        (b"P5\n-3 3\n255\n", r#"line 2: the width is "-3"; allowed is a whole number from 1 to 16777216"#),
        (b"P5\n3.5 3\n255\n", r#"line 2: the width is "3.5"; allowed is a whole number from 1 to 16777216"#),
        (
            b"P5\nwide 3\n255\n",
            r#"line 2: the width is "wide"; allowed is a whole number from 1 to 16777216"#,
        ),
        (b"P5\n\xff\"\0 3\n", r#"line 2: the width is "�"�"; allowed is a whole number from 1 to 16777216"#),
        (
            b"P5\n99999999999999999999999 3\n255\n",
            r#"line 2: the width is "99999999999999999999…"; allowed is a whole number from 1 to 16777216"#,
        ),
        (b"P5\n3\n", "line 3: the height is missing; allowed is a whole number from 1 to 5592405"),
        (
            b"P5\n8192\n8192\n255\n",
            r#"line 3: the height is "8192"; allowed is a whole number from 1 to 2048"#,
        ),
        (b"P5\n3 2\n", "line 3: the greatest value is missing; allowed is a whole number from 1 to 65535"),
        (b"P5\n3 2\n0\n", r#"line 3: the greatest value is "0"; allowed is a whole number from 1 to 65535"#),
        (
            b"P5\n3 2\n65536\n",
            r#"line 3: the greatest value is "65536"; allowed is a whole number from 1 to 65535"#,
        ),
        (b"P5\n3 2\n255", "line 3: the length of the raster in bytes is 0; allowed is 6 for 3 × 2 pixels"),
        (
            b"P5\n3 2\n255\n12345",
            "line 3: the length of the raster in bytes is 5; allowed is 6 for 3 × 2 pixels",
        ),
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
            b"P2\n3 2\n255\n1 2 3\n4 five 6\n",
            r#"line 5: a pixel is "five"; allowed is a whole number from 0 to 255"#,
        ),
        (
            b"P2\n3 2\n255\n1 2 3\n4 +5 6\n",
            r#"line 5: a pixel is "+5"; allowed is a whole number from 0 to 255"#,
        ),
    ];
    for (file, sentence) in cases {
        assert_eq!(read_pgm(file).expect_err("malformed").to_string(), sentence, "{}", file.escape_ascii());
    }
    let huge = format!("P2\n{MAX_PIXELS} 1\n255\n");
    assert_eq!(read_pgm(huge.as_bytes()).expect_err("no pixels").field, "a pixel");
}

/// Whatever the bytes, there is an image of the announced size or an explanation, and no panic.
#[test]
fn no_bytes_break_the_reader() {
    let mut rng = seeded(9902);
    let mut valid: Vec<Vec<u8>> = [
        b"P2\n# a comment\n4 3\n255\n0 255 51 7\n102 153 204 8\n1 2 3 4\n".as_slice(),
        b"P5\n# CREATOR: by hand\n4 3\n255\n\x00\xff\x33\x66\x99\xcc\x01\x02\x03\x04\x05\x06",
        b"P5 2 2 65535\n\x00\x01\x02\x03\x04\x05\x06\x07",
    ]
    .map(<[u8]>::to_vec)
    .to_vec();
    valid.push(b"P5 ".to_vec());
    let words: [&[u8]; 8] =
        [b"P5", b"P2", b"\n", b"#", b" 16777216 ", b" 65535 ", b" 18446744073709551616 ", b" -1 "];
    let (mut read, mut refused) = (0, 0);
    for _ in 0..100_000 {
        let mut bytes = if rng.next_u32().is_multiple_of(4) {
            let mut bytes: Vec<u8> =
                (0..rng.next_u32() % 40).map(|_| (rng.next_u32() & 0xff) as u8).collect();
            bytes.splice(0..0, *b"P5 ");
            bytes
        } else {
            valid[(rng.next_u32() % 4) as usize].clone()
        };
        for _ in 0..rng.next_u32() % 4 {
            let at = (rng.next_u32() as usize) % (bytes.len() + 1);
            match rng.next_u32() % 4 {
                0 => bytes.truncate(at),
                1 if at < bytes.len() => bytes[at] = (rng.next_u32() & 0xff) as u8,
                2 if at < bytes.len() => drop(bytes.remove(at)),
                _ => drop(bytes.splice(at..at, words[(rng.next_u32() % 8) as usize].iter().copied())),
            }
        }
        match read_pgm(&bytes) {
            Ok(image) => {
                assert!(shades(&image).iter().all(|shade| (0.0..=1.0).contains(shade)));
                let grid = OccupancyGrid::new(&image, &TRINARY, 0.05, SE2::identity());
                assert!(FloorPlan::from_grid(grid).is_ok());
                read += 1;
            }
            Err(PgmError { field, line, value, allowed }) => {
                let lines = 1 + bytes.iter().filter(|byte| **byte == b'\n').count();
                assert!(![field, &value, &allowed].contains(&"") && (1..=lines).contains(&line));
                assert!(value.chars().count() <= 23 && !value.contains(char::is_control), "{value}");
                refused += 1;
            }
        }
    }
    assert!(read > 10_000 && refused > 10_000, "{read} {refused}");
}

/// `map_server` averages opacity in with the colours in mode trinary, if the image has transparency at all.
#[test]
fn transparency_counts_as_a_colour_in_trinary() {
    let interpretation =
        Interpretation { mode: Mode::Trinary, negate: false, occupied_thresh: 0.65, free_thresh: 0.196 };
    let occupied = |pixels: &[(f32, f32)]| -> Vec<bool> {
        let pixels: Vec<Pixel> = pixels.iter().map(|&(shade, opacity)| Pixel { shade, opacity }).collect();
        let image = Image { width: pixels.len(), height: 1, pixels };
        let grid = OccupancyGrid::new(&image, &interpretation, 0.05, SE2::identity());
        grid.cells().iter().map(|cell| *cell == Cell::Occupied).collect()
    };
    // Opaque black is (0 + 0 + 0 + 1)/4 = 0.25 of white then, dark grey 60/255 is 0.43 of it, clear white 0.75.
    assert_eq!(
        occupied(&[(0.0, 1.0), (60.0 / 255.0, 1.0), (1.0, 0.0), (0.0, 0.0)]),
        [true, false, false, true]
    );
    assert_eq!(
        occupied(&[(0.0, 1.0), (60.0 / 255.0, 1.0), (1.0, 1.0)]),
        [true, true, false],
        "no transparency"
    );
}

/// A turned map ends where its image does, not where a box around it does.
#[test]
fn the_edge_of_a_turned_map_turns_with_it() {
    let empty = Cells {
        width: 100,
        height: 50,
        occupied: vec![false; 5000],
        resolution: 0.1,
        origin: [1.0, 2.0, 0.6],
    };
    let plan = FloorPlan::from_grid(empty.grid()).expect("no walls");
    let at = |x: f64, y: f64| {
        let point = SE2::new(1.0, 2.0, 0.6) * SE2::new(x, y, 0.0);
        [point.x(), point.y()]
    };
    for (x, y, inside) in
        [(5.0, 2.5, true), (0.1, 0.1, true), (9.9, 4.9, true), (-0.1, 2.0, false), (5.0, 5.1, false)]
    {
        assert_eq!(plan.point_free(at(x, y), 0.05).free, inside, "({x}, {y})");
    }
    let [left, _, _, top] = plan.bounds();
    assert!(
        !plan.point_free([left + 0.1, top - 0.1], 0.05).free,
        "a corner of the box that is no part of the map"
    );
    let [x, y] = at(5.0, 4.5);
    let across = Arc { start: SE2::new(x, y, 0.6), length: 2.0, turn: 2.0 * PI };
    assert!(!plan.arc_free(&across, 0.05).free, "a circle that leaves and comes back");
    assert!(plan.arc_free(&Arc { turn: -2.0 * PI, ..across }, 0.05).free);
}

// -------------------------------------------------------------------------------------------------- what is unknown

/// A grid of ones of `#` (occupied), `?` (unknown) and `.` (free), the first row at the top, cells of 10 cm.
fn drawn(rows: &[&str], unknown: Unknown) -> OccupancyGrid {
    let shade = |cell| match cell {
        '#' => 0.0,
        '?' => 0.5,
        _ => 1.0,
    };
    let pixels =
        rows.iter().flat_map(|row| row.chars()).map(|cell| Pixel { shade: shade(cell), opacity: 1.0 });
    let image = Image { width: rows[0].len(), height: rows.len(), pixels };
    OccupancyGrid::new(&image, &TRINARY, 0.1, SE2::identity()).with_unknown(unknown)
}

/// Blocked, an unknown cell is to a robot what an occupied one is; free, it is what a free one is.
#[test]
fn unknown_cells_are_what_one_decides() {
    let mut rng = seeded(31_415);
    let random: Vec<String> = (0..30)
        .map(|_| (0..30).map(|_| ['#', '?', '.', '.', '.', '.'][(rng.next_u32() % 6) as usize]).collect())
        .collect();
    let with =
        |from: &str, to: &str| -> Vec<String> { random.iter().map(|row| row.replace(from, to)).collect() };
    let plan = |rows: &[String], unknown| {
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        FloorPlan::from_grid(drawn(&rows, unknown)).expect("a small grid")
    };
    for (unknown, alike) in [(Unknown::Blocked, with("?", "#")), (Unknown::Free, with("?", "."))] {
        let (one, other) = (plan(&random, unknown), plan(&alike, Unknown::Free));
        assert_eq!(one.walls(), other.walls(), "{unknown:?}");
        for _ in 0..20_000 {
            let start = SE2::new(
                uniform(&mut rng, 0.0, 3.0),
                uniform(&mut rng, 0.0, 3.0),
                uniform(&mut rng, -PI, PI),
            );
            let arc = Arc { start, length: uniform(&mut rng, 0.0, 0.5), turn: uniform(&mut rng, -2.0, 2.0) };
            let clearance = uniform(&mut rng, 0.0, 0.1);
            let point = [start.x(), start.y()];
            assert_eq!(one.point_free(point, clearance), other.point_free(point, clearance), "{point:?}");
            assert_eq!(one.arc_free(&arc, clearance), other.arc_free(&arc, clearance), "{arc:?}");
        }
    }
    let grid = drawn(&["#?."], Unknown::Blocked);
    assert_eq!(grid.cells(), [Cell::Occupied, Cell::Unknown, Cell::Free], "it stays known which is which");
}

// ------------------------------------------------------------------------------------------------ a place to start

/// In the middle of the largest square that is known to be free, heading along the longest way known to be free.
#[test]
fn a_robot_is_put_in_the_open() {
    let rows = [
        "????????????????",
        "????????????????",
        "##########??????",
        "#........#??????",
        "#........#??????",
        "#...............",
        "#........#??????",
        "##########??????",
    ];
    for unknown in [Unknown::Free, Unknown::Blocked] {
        let plan = FloorPlan::from_grid(drawn(&rows, unknown)).expect("a small grid");
        let place = plan.open_place(0.1).expect("there is room");
        // The first of the squares of four cells, and the way through the door.
        assert!((place.x() - 0.3).abs() + (place.y() - 0.3).abs() < 1e-12, "{place:?}");
        assert!(plan.point_free([place.x(), place.y()], 0.1).free);
        let way = Arc { start: place, length: 0.5, turn: 0.0 };
        assert!(plan.arc_free(&way, 0.0).free && place.theta().abs() < 0.5, "{place:?}");
    }
    // Where the robot just fits, there is no way at all.
    let shut = FloorPlan::from_grid(drawn(&["###", "#.#", "###"], Unknown::Free)).expect("a small grid");
    assert_eq!(shut.open_place(0.0499).expect("there is room").theta(), 0.0);
    // Nothing is known, but something is free; or nothing is.
    let unknown = drawn(&["???", "???", "???"], Unknown::Free);
    let place = FloorPlan::from_grid(unknown).expect("no walls").open_place(0.1).expect("there is room");
    assert!((place.x() - 0.05).abs() + (place.y() - 0.05).abs() < 1e-12, "the first: {place:?}");
    let blocked = drawn(&["???", "???", "???"], Unknown::Blocked);
    assert_eq!(FloorPlan::from_grid(blocked).expect("four walls").open_place(0.1), None);
}

/// The place that is found has room on every random grid where any of its cells has, whatever the grid's turn.
#[test]
fn a_place_is_found_where_there_is_one() {
    let mut rng = seeded(27_182);
    let (mut found, mut none) = (0, 0);
    for _ in 0..2000 {
        let cells = Cells::random(&mut rng);
        let clearance = cells.resolution * uniform(&mut rng, 0.0, 2.0);
        let plan = FloorPlan::from_grid(cells.grid()).expect("a small grid");
        let middles = (0..cells.height).flat_map(|row| (0..cells.width).map(move |column| (column, row)));
        let room = middles
            .map(|(column, row)| cells.in_map(column as f64 + 0.5, row as f64 + 0.5))
            .any(|middle| plan.point_free(middle, clearance).free);
        if let Some(place) = plan.open_place(clearance) {
            assert!(plan.point_free([place.x(), place.y()], clearance).free, "{place:?}");
            found += 1;
        } else {
            assert!(!room);
            none += 1;
        }
    }
    assert!(found > 300 && none > 100, "{found} {none}");
}

/// Where nothing is known to be free, the robot is put into the first cell, row by row from the bottom, in whose middle it fits.
#[test]
fn the_first_place_with_room_is_found() {
    let mut rng = seeded(27_183);
    let (mut first, mut later, mut none) = (0, 0, 0);
    for _ in 0..2000 {
        let cells = Cells::random(&mut rng);
        let clearance = cells.resolution * uniform(&mut rng, 0.0, 4.0);
        let grey = Pixel { shade: 205.0 / 255.0, ..WHITE };
        let pixels = cells.occupied.iter().map(|occupied| if *occupied { BLACK } else { grey });
        let image = Image { width: cells.width, height: cells.height, pixels };
        let [x, y, yaw] = cells.origin;
        let grid = OccupancyGrid::new(&image, &TRINARY, cells.resolution, SE2::new(x, y, yaw));
        let plan = FloorPlan::from_grid(grid).expect("a small grid");
        let middles = (0..cells.height).flat_map(|row| (0..cells.width).map(move |column| (column, row)));
        let expected = middles
            .enumerate()
            .map(|(i, (column, row))| (i, cells.in_map(column as f64 + 0.5, row as f64 + 0.5)))
            .find(|(_, middle)| plan.point_free(*middle, clearance).free);
        let place = plan.open_place(clearance).map(|place| [place.x(), place.y()]);
        match (expected, place) {
            (Some((i, [x, y])), Some(place)) => {
                // Coordinates up to 56 m, rounded by a few of their last bits.
                assert!((place[0] - x).abs().max((place[1] - y).abs()) < 1e-12, "{place:?} {x} {y}");
                *if i == 0 { &mut first } else { &mut later } += 1;
            }
            (None, None) => none += 1,
            (expected, place) => panic!("{place:?} instead of {expected:?}"),
        }
    }
    assert!(first > 100 && later > 300 && none > 300, "{first} {later} {none}");
}
