//! Distance between a driven arc and a wall, compared with an independent reference without the equation of a circle.

use crate::common::distance::{Point, difference, distance_by_halving, extent, norm, position_along};
use crate::common::{seeded, signed_log_uniform, uniform};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use rand::Rng;
use std::f64::consts::{PI, TAU};

// ------------------------------------------------------------------------------------------------- random pairs

fn random_point(rng: &mut impl Rng, reach: f64) -> Point {
    [uniform(rng, -reach, reach), uniform(rng, -reach, reach)]
}

fn random_arc(rng: &mut impl Rng, length: f64, turn: f64) -> Arc {
    let [x, y] = random_point(rng, 5.0);
    Arc { start: SE2::new(x, y, uniform(rng, -PI, PI)), length, turn }
}

/// Returns an arc of up to 8 m in either direction, which turns by up to two circles to either side.
fn any_arc(rng: &mut impl Rng) -> Arc {
    let (length, turn) = (uniform(rng, -8.0, 8.0), uniform(rng, -2.0 * TAU, 2.0 * TAU));
    random_arc(rng, length, turn)
}

fn nearly_straight_arc(rng: &mut impl Rng) -> Arc {
    let (length, turn) = (uniform(rng, -8.0, 8.0), signed_log_uniform(rng, 1e-18, 1e-3));
    random_arc(rng, length, turn)
}

/// Returns a turn almost on the spot.
fn turn_almost_on_the_spot(rng: &mut impl Rng) -> Arc {
    let (length, turn) = (signed_log_uniform(rng, 1e-15, 1e-1), uniform(rng, -2.0 * TAU, 2.0 * TAU));
    random_arc(rng, length, turn)
}

fn any_wall(rng: &mut impl Rng, _: &Arc) -> Segment {
    Segment { from: random_point(rng, 8.0), to: random_point(rng, 8.0) }
}

/// Returns the position in the world of a point that is relative to the start of the arc.
fn to_world(arc: &Arc, local: Point) -> Point {
    [arc.start.x() + local[0], arc.start.y() + local[1]]
}

/// Returns a wall along a tangent of the arc, at a tiny distance.
fn tangent_wall(rng: &mut impl Rng, arc: &Arc) -> Segment {
    let f = uniform(rng, 0.0, 1.0);
    let heading = arc.start.theta() + f * arc.turn;
    let [x, y] = position_along(arc, f);
    let offset = signed_log_uniform(rng, 1e-15, 1e-1);
    let foot = [x - offset * heading.sin(), y + offset * heading.cos()];
    let mut end = || {
        let reach = uniform(rng, -5.0, 5.0);
        to_world(arc, [foot[0] + reach * heading.cos(), foot[1] + reach * heading.sin()])
    };
    Segment { from: end(), to: end() }
}

/// Returns a wall that ends near the end of the arc, or extends beyond it.
fn wall_by_the_end(rng: &mut impl Rng, arc: &Arc) -> Segment {
    let [x, y] = position_along(arc, f64::from(rng.next_u32() % 2));
    let mut offset = || signed_log_uniform(rng, 1e-15, 1e-1);
    let from = to_world(arc, [x + offset(), y + offset()]);
    let to = if rng.next_u32().is_multiple_of(2) {
        random_point(rng, 8.0)
    } else {
        let (heading, reach) = (uniform(rng, -PI, PI), uniform(rng, -3.0, 3.0));
        [from[0] + reach * heading.cos(), from[1] + reach * heading.sin()]
    };
    Segment { from, to }
}

/// Returns a wall with an end near the centre of the arc's circle, where all points of the circle are equally near.
fn wall_from_the_centre(rng: &mut impl Rng, arc: &Arc) -> Segment {
    let (radius, theta) = (arc.length / arc.turn, arc.start.theta());
    let mut offset = || signed_log_uniform(rng, 1e-16, 1e-1);
    let from = to_world(arc, [offset() - radius * theta.sin(), offset() + radius * theta.cos()]);
    let reach = uniform(rng, 0.0, 1.2) * radius;
    let heading = uniform(rng, -PI, PI);
    Segment { from, to: [from[0] + reach * heading.cos(), from[1] + reach * heading.sin()] }
}

/// Returns a wall of length 0.
fn point_wall(rng: &mut impl Rng, _: &Arc) -> Segment {
    let from = random_point(rng, 8.0);
    Segment { from, to: from }
}

type MakeArc = fn(&mut rand_xoshiro::Xoshiro256PlusPlus) -> Arc;
type MakeWall = fn(&mut rand_xoshiro::Xoshiro256PlusPlus, &Arc) -> Segment;

const STRAIGHT_ARC: MakeArc = |rng| {
    let length = uniform(rng, -8.0, 8.0);
    random_arc(rng, length, 0.0)
};
const TURN_ON_THE_SPOT: MakeArc = |rng| {
    let turn = uniform(rng, -TAU, TAU);
    random_arc(rng, 0.0, turn)
};
/// Function that returns an arc of up to a kilometre around a circle of any radius.
const LONG_ARC: MakeArc = |rng| {
    let (length, turn) = (signed_log_uniform(rng, 1.0, 1e3), signed_log_uniform(rng, 1e-6, 30.0));
    random_arc(rng, length, turn)
};

/// Kinds of arcs and walls, and the number of pairs of each.
const ARC_AND_WALL_KINDS: [(&str, MakeArc, MakeWall, u32); 14] = [
    ("any arc, any wall", any_arc, any_wall, 4000),
    ("any arc, tangent", any_arc, tangent_wall, 3000),
    ("any arc, by its end", any_arc, wall_by_the_end, 1500),
    ("any arc, from its centre", any_arc, wall_from_the_centre, 1500),
    ("any arc, point", any_arc, point_wall, 1000),
    ("nearly straight, any wall", nearly_straight_arc, any_wall, 1500),
    ("nearly straight, tangent", nearly_straight_arc, tangent_wall, 2000),
    ("nearly straight, by its end", nearly_straight_arc, wall_by_the_end, 1000),
    ("straight, any wall", STRAIGHT_ARC, any_wall, 1000),
    ("straight, parallel", STRAIGHT_ARC, tangent_wall, 1000),
    ("on the spot", TURN_ON_THE_SPOT, any_wall, 500),
    ("nearly on the spot, any wall", turn_almost_on_the_spot, any_wall, 1000),
    ("nearly on the spot, tangent", turn_almost_on_the_spot, tangent_wall, 1500),
    ("long", LONG_ARC, tangent_wall, 1500),
];

// --------------------------------------------------------------------------------------------------------- tests

/// Both the analytic distance and the reference round coordinates a few times. Their tolerance is eight units in the last place of
/// the extent, which are 0.01 pm in the apartment.
#[test]
fn the_distance_to_an_arc_matches_bisection() {
    let (mut pairs, mut crossing_pairs, mut narrow_bounds) = (0, 0, 0);
    for (seed, (name, make_arc, make_wall, count)) in (0..).zip(ARC_AND_WALL_KINDS) {
        let mut rng = seeded(9000 + seed);
        for _ in 0..count {
            let arc = make_arc(&mut rng);
            let wall = make_wall(&mut rng, &arc);
            let exact = wall.distance_to_arc(&arc);
            let [low, high] = distance_by_halving(&arc, &wall);
            let tolerance = 8.0 * f64::EPSILON * extent(&arc, &wall);
            assert!(
                (low - tolerance..=high + tolerance).contains(&exact),
                "{name}: {exact:e} instead of {low:e} to {high:e}: {arc:?} {wall:?}"
            );
            crossing_pairs += u32::from(exact == 0.0);
            narrow_bounds += u32::from(high - low <= tolerance);
            pairs += 1;
        }
    }
    assert!(
        pairs >= 20_000 && crossing_pairs > pairs / 10 && crossing_pairs < pairs / 2,
        "{crossing_pairs} of {pairs}"
    );
    assert!(narrow_bounds > pairs * 9 / 10, "the reference was sharp for {narrow_bounds} of {pairs}");
}

/// Drawn points of an arc are 1/50 rad apart. A piece of length s and turn φ rises by s·φ/8 over its chord, which is 0.05 mm
/// for an arc of a metre that turns by a radian. Beyond two turns the circle repeats itself, and its chords may be longer.
#[test]
fn chords_of_an_arc_stay_within_a_twentieth_of_a_millimetre() {
    for (length, turn) in [(1.0, 1.0), (-2.0, 0.3), (1.0, -2.0 * TAU), (3.0, 0.004), (1.0, 0.0)] {
        let arc = Arc { start: SE2::new(1.0, -2.0, 0.7), length, turn };
        let points = arc.points();
        let chords = points.len() - 1;
        assert_eq!(points[0], [arc.start.x(), arc.start.y()]);
        assert!(norm(difference(points[chords], to_world(&arc, position_along(&arc, 1.0)))) < 1e-14);
        for (i, ends) in points.windows(2).enumerate() {
            let chord_middle = [0, 1].map(|axis| 0.5 * (ends[0][axis] + ends[1][axis]));
            let arc_middle = to_world(&arc, position_along(&arc, (i as f64 + 0.5) / chords as f64));
            let rise = norm(difference(chord_middle, arc_middle));
            let max_rise = 0.02 * 0.02 / 8.0 * (length / turn.abs().max(0.02)).abs() * 1.001;
            assert!(rise <= max_rise, "{turn}: {rise}");
        }
        assert!(chords <= 640);
    }
}
