//! Plans, grids and files of maps.

use super::doubles::{any_double, cases};
use crate::common::distance::point_to_line;
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, FloorPlanError, Pixel, read_pgm};
use proptest::collection::vec;
use proptest::prelude::*;

/// The side of the place that walls and motions are put in, m.
const SIDE: f64 = 20.0;

/// What neither side can tell of a distance here: a thousand units in the last place of a place this wide.
const ROUNDING: f64 = 1e-12;

fn points() -> impl Strategy<Value = [f64; 2]> {
    let coordinate = || prop_oneof![2 => 0.0..=SIDE, 1 => (0..=20u8).prop_map(f64::from)];
    [coordinate(), coordinate()]
}

fn walls() -> impl Strategy<Value = Vec<Segment>> {
    vec((points(), points()).prop_map(|(from, to)| Segment { from, to }), 0..12)
}

fn arcs() -> impl Strategy<Value = Arc> {
    let length = prop_oneof![-10.0..10.0, -0.1..0.1, Just(0.0)];
    let turn = prop_oneof![-3.0..3.0, -30.0..30.0, Just(0.0), -1e-9..1e-9];
    (points(), -3.2..3.2, length, turn).prop_map(|([x, y], theta, length, turn)| Arc {
        start: SE2::new(x, y, theta),
        length,
        turn,
    })
}

fn plan(walls: Vec<Segment>) -> FloorPlan {
    FloorPlan::new(walls, [0.0, 0.0, SIDE, SIDE]).expect("walls inside the bounds")
}

/// Least and greatest that the distance from the way to a wall can be, by the distance of many points of the way.
fn looked_at(arc: &Arc, walls: &[Segment]) -> [f64; 2] {
    const CHORDS: u32 = 500;
    let least = (0..=CHORDS).map(|i| {
        let f = f64::from(i) / f64::from(CHORDS);
        let at = Arc { length: f * arc.length, turn: f * arc.turn, ..*arc }.end();
        let room = walls.iter().map(|Segment { from, to }| point_to_line([at.x(), at.y()], [*from, *to]));
        room.fold(f64::INFINITY, f64::min)
    });
    let least = least.fold(f64::INFINITY, f64::min);
    [least - 0.5 * arc.length.abs() / f64::from(CHORDS), least]
}

/// How far inside the bounds the way stays, likewise.
fn inside(arc: &Arc) -> [f64; 2] {
    const CHORDS: u32 = 500;
    let depths = (0..=CHORDS).map(|i| {
        let f = f64::from(i) / f64::from(CHORDS);
        let at = Arc { length: f * arc.length, turn: f * arc.turn, ..*arc }.end();
        at.x().min(at.y()).min(SIDE - at.x()).min(SIDE - at.y())
    });
    let least = depths.fold(f64::INFINITY, f64::min);
    [least - 0.5 * arc.length.abs() / f64::from(CHORDS), least]
}

proptest! {
    #![proptest_config(cases(150))]

    /// Against points along the way; between two of them either verdict will do.
    #[test]
    fn verdicts_match_points_along_the_arc(walls in walls(), arc in arcs(), clearance in 0.0..2.0f64) {
        let ([nearest, near], [shallowest, shallow]) = (looked_at(&arc, &walls), inside(&arc));
        let free = plan(walls).arc_free(&arc, clearance).free;
        if near < clearance - ROUNDING || shallow < -ROUNDING {
            prop_assert!(!free, "room {}, depth {}", near, shallow);
        }
        if nearest > clearance + ROUNDING && shallowest > ROUNDING {
            prop_assert!(free, "room {}, depth {}", nearest, shallowest);
        }
    }

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

/// What may stand between two words of a header.
fn gaps() -> impl Strategy<Value = String> {
    prop_oneof![
        "[ \t\r\n]{1,3}",
        "[ ]?#[ -~]{0,12}\n",
        Just("\n# made by a program\n# in two lines\n".to_owned()),
    ]
}

proptest! {
    #![proptest_config(cases(250))]

    /// The same picture, however its file is laid out.
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
        // Cut anywhere, a binary file is refused; a plain one too, unless the cut is in or behind its last number.
        prop_assert!(read_pgm(&binary[..cut % binary.len()]).is_err());
        let last = plain.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        prop_assert!(read_pgm(&plain.as_bytes()[..cut % (last + 1)]).is_err());
    }

}
