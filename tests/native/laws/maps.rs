//! Plans, grids and files of maps.

use super::doubles::{any_double, cases};
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, FloorPlanError, Pixel, read_pgm};
use proptest::collection::vec;
use proptest::prelude::*;

/// Side of the square that contains the walls and motions, m.
const SIDE: f64 = 20.0;

/// Rounding error of a distance in both computations: about a thousand units in the last place of a coordinate (m).
const ROUNDING: f64 = 1e-12;

fn points() -> impl Strategy<Value = [f64; 2]> {
    let coordinate = || prop_oneof![2 => 0.0..=SIDE, 1 => (0..=20u8).prop_map(f64::from)];
    [coordinate(), coordinate()]
}

fn walls() -> impl Strategy<Value = Vec<Segment>> {
    vec((points(), points()).prop_map(|(from, to)| Segment { from, to }), 0..12)
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn bounds_are_accepted_or_reported(bounds in [any_double(), any_double(), any_double(), any_double()]) {
        let [left, bottom, right, top] = bounds;
        let good = bounds.iter().all(|bound| bound.abs() <= 1e6)
            && [right - left, top - bottom].iter().all(|side| (0.01..=1e5).contains(side));
        match FloorPlan::new(Vec::new(), bounds) {
            Ok(plan) => prop_assert!(good && plan.bounds() == bounds),
            Err(FloorPlanError::BadBounds(named)) => {
                prop_assert!(!good);
                prop_assert_eq!(named.map(f64::to_bits), bounds.map(f64::to_bits));
            }
            Err(error) => prop_assert!(false, "{}", error),
        }
    }

    #[test]
    fn walls_are_accepted_or_reported(walls in walls(), end in [any_double(), any_double()], at in any::<u8>(), last in any::<bool>()) {
        let index = usize::from(at) % (walls.len() + 1);
        let wall = if last { Segment { from: [1.0, 1.0], to: end } } else { Segment { from: end, to: [1.0, 1.0] } };
        let mut walls = walls;
        walls.insert(index, wall);
        let good = end.iter().all(|coordinate| (-ROUNDING..=SIDE + ROUNDING).contains(coordinate));
        match FloorPlan::new(walls, [0.0, 0.0, SIDE, SIDE]) {
            Ok(_) => prop_assert!(good),
            Err(FloorPlanError::BadWall { index: named, end: at }) => {
                prop_assert!(!good && named == index);
                prop_assert_eq!(at.map(f64::to_bits), end.map(f64::to_bits));
            }
            Err(error) => prop_assert!(false, "{}", error),
        }
    }
}

/// Returns allowed separators between two words of a header.
fn gaps() -> impl Strategy<Value = String> {
    prop_oneof![
        "[ \t\r\n]{1,3}",
        "[ ]?#[ -~]{0,12}\n",
        Just("\n# made by a program\n# in two lines\n".to_owned()),
    ]
}

proptest! {
    #![proptest_config(cases(250))]

    /// The result does not depend on the layout of the file.
    #[test]
    fn pgm_headers_may_have_any_white_space_and_comments(
        (width, height) in (1..6usize, 1..6usize), greatest in 1..=65_535u32, seeds in vec(any::<u32>(), 36),
        gaps in vec(gaps(), 40), cut in any::<usize>(),
    ) {
        let values: Vec<u32> = seeds.into_iter().take(width * height).map(|seed| seed % (greatest + 1)).collect();
        let mut plain = "P2".to_owned();
        for (number, gap) in [width as u32, height as u32, greatest].iter().chain(&values).zip(&gaps) {
            plain.push_str(gap);
            plain.push_str(&number.to_string());
        }
        let mut binary = format!("P5{}{width}{}{height}{}{greatest}\n", gaps[0], gaps[1], gaps[2]).into_bytes();
        for value in &values {
            let bytes = value.to_be_bytes();
            binary.extend(if greatest < 256 { &bytes[3..] } else { &bytes[2..] });
        }
        let image = read_pgm(plain.as_bytes()).expect("a plain file");
        prop_assert!(image.pixels.clone().eq(read_pgm(&binary).expect("a binary file").pixels));
        prop_assert_eq!((image.width, image.height), (width, height));
        for (pixel, value) in image.pixels.zip(&values) {
            prop_assert_eq!(Pixel::from(pixel).shade, *value as f32 / greatest as f32);
        }
        // A truncated binary file is refused; a plain one too, unless the cut is in or after its last number.
        prop_assert!(read_pgm(&binary[..cut % binary.len()]).is_err());
        let last = plain.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        prop_assert!(read_pgm(&plain.as_bytes()[..cut % (last + 1)]).is_err());
    }

}
