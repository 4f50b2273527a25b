//! Distance between a driven arc and a wall, compared with an independent reference without the equation of a circle.

use crate::common::distance::{
    Point, bound_distance, extent_of, norm_of, position_along_arc, subtract_points,
};
use crate::common::{sample_signed_log_uniform, sample_uniform, seeded_rng};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use rand::Rng;
use std::f64::consts::{PI, TAU};

fn sample_point(rng: &mut impl Rng, max_coordinate: f64) -> Point {
    [
        sample_uniform(rng, -max_coordinate, max_coordinate),
        sample_uniform(rng, -max_coordinate, max_coordinate),
    ]
}

fn new_arc_anywhere(rng: &mut impl Rng, arc_length: f64, arc_turn: f64) -> Arc {
    let [x, y] = sample_point(rng, 5.0);
    Arc { start: SE2::new(x, y, sample_uniform(rng, -PI, PI)), length: arc_length, turn: arc_turn }
}

/// Returns an arc of up to 8 m in either direction, which turns by up to two circles to either side.
fn sample_arc(rng: &mut impl Rng) -> Arc {
    let (arc_length, arc_turn) = (sample_uniform(rng, -8.0, 8.0), sample_uniform(rng, -2.0 * TAU, 2.0 * TAU));
    new_arc_anywhere(rng, arc_length, arc_turn)
}

fn sample_nearly_straight_arc(rng: &mut impl Rng) -> Arc {
    let (arc_length, arc_turn) =
        (sample_uniform(rng, -8.0, 8.0), sample_signed_log_uniform(rng, 1e-18, 1e-3));
    new_arc_anywhere(rng, arc_length, arc_turn)
}

fn sample_turn_nearly_on_the_spot(rng: &mut impl Rng) -> Arc {
    let (arc_length, arc_turn) =
        (sample_signed_log_uniform(rng, 1e-15, 1e-1), sample_uniform(rng, -2.0 * TAU, 2.0 * TAU));
    new_arc_anywhere(rng, arc_length, arc_turn)
}

fn sample_wall(rng: &mut impl Rng, _: &Arc) -> Segment {
    Segment { from: sample_point(rng, 8.0), to: sample_point(rng, 8.0) }
}

fn to_absolute(arc: &Arc, relative_point: Point) -> Point {
    [arc.start.x() + relative_point[0], arc.start.y() + relative_point[1]]
}

fn sample_tangent_wall(rng: &mut impl Rng, arc: &Arc) -> Segment {
    let arc_fraction = sample_uniform(rng, 0.0, 1.0);
    let tangent_heading = arc.start.theta() + arc_fraction * arc.turn;
    let [x, y] = position_along_arc(arc, arc_fraction);
    let tangent_offset = sample_signed_log_uniform(rng, 1e-15, 1e-1);
    let tangent_point =
        [x - tangent_offset * tangent_heading.sin(), y + tangent_offset * tangent_heading.cos()];
    let mut sample_end = || {
        let tangent_length = sample_uniform(rng, -5.0, 5.0);
        to_absolute(
            arc,
            [
                tangent_point[0] + tangent_length * tangent_heading.cos(),
                tangent_point[1] + tangent_length * tangent_heading.sin(),
            ],
        )
    };
    Segment { from: sample_end(), to: sample_end() }
}

fn sample_wall_near_end(rng: &mut impl Rng, arc: &Arc) -> Segment {
    let [x, y] = position_along_arc(arc, f64::from(rng.next_u32() % 2));
    let mut sample_offset = || sample_signed_log_uniform(rng, 1e-15, 1e-1);
    let near_end = to_absolute(arc, [x + sample_offset(), y + sample_offset()]);
    let other_end = if rng.next_u32().is_multiple_of(2) {
        sample_point(rng, 8.0)
    } else {
        let (heading, point_distance) = (sample_uniform(rng, -PI, PI), sample_uniform(rng, -3.0, 3.0));
        [near_end[0] + point_distance * heading.cos(), near_end[1] + point_distance * heading.sin()]
    };
    Segment { from: near_end, to: other_end }
}

/// Returns a wall with an end near the centre of the arc's circle, where all points of the circle are equally near.
fn sample_wall_from_centre(rng: &mut impl Rng, arc: &Arc) -> Segment {
    let (radius, theta) = (arc.length / arc.turn, arc.start.theta());
    let mut sample_offset = || sample_signed_log_uniform(rng, 1e-16, 1e-1);
    let near_end =
        to_absolute(arc, [sample_offset() - radius * theta.sin(), sample_offset() + radius * theta.cos()]);
    let point_distance = sample_uniform(rng, 0.0, 1.2) * radius;
    let heading = sample_uniform(rng, -PI, PI);
    Segment {
        from: near_end,
        to: [near_end[0] + point_distance * heading.cos(), near_end[1] + point_distance * heading.sin()],
    }
}

fn sample_point_wall(rng: &mut impl Rng, _: &Arc) -> Segment {
    let wall_point = sample_point(rng, 8.0);
    Segment { from: wall_point, to: wall_point }
}

type ArcGenerator = fn(&mut rand_xoshiro::Xoshiro256PlusPlus) -> Arc;
type WallGenerator = fn(&mut rand_xoshiro::Xoshiro256PlusPlus, &Arc) -> Segment;

const SAMPLE_STRAIGHT_ARC: ArcGenerator = |rng| {
    let arc_length = sample_uniform(rng, -8.0, 8.0);
    new_arc_anywhere(rng, arc_length, 0.0)
};
const SAMPLE_TURN_ON_THE_SPOT: ArcGenerator = |rng| {
    let arc_turn = sample_uniform(rng, -TAU, TAU);
    new_arc_anywhere(rng, 0.0, arc_turn)
};
/// Generator of arcs of up to a kilometre around a circle of any radius.
const SAMPLE_LONG_ARC: ArcGenerator = |rng| {
    let (arc_length, arc_turn) =
        (sample_signed_log_uniform(rng, 1.0, 1e3), sample_signed_log_uniform(rng, 1e-6, 30.0));
    new_arc_anywhere(rng, arc_length, arc_turn)
};

const ARC_AND_WALL_KINDS: [(&str, ArcGenerator, WallGenerator, u32); 14] = [
    ("any arc, any wall", sample_arc, sample_wall, 4000),
    ("any arc, tangent", sample_arc, sample_tangent_wall, 3000),
    ("any arc, by its end", sample_arc, sample_wall_near_end, 1500),
    ("any arc, from its centre", sample_arc, sample_wall_from_centre, 1500),
    ("any arc, point", sample_arc, sample_point_wall, 1000),
    ("nearly straight, any wall", sample_nearly_straight_arc, sample_wall, 1500),
    ("nearly straight, tangent", sample_nearly_straight_arc, sample_tangent_wall, 2000),
    ("nearly straight, by its end", sample_nearly_straight_arc, sample_wall_near_end, 1000),
    ("straight, any wall", SAMPLE_STRAIGHT_ARC, sample_wall, 1000),
    ("straight, parallel", SAMPLE_STRAIGHT_ARC, sample_tangent_wall, 1000),
    ("on the spot", SAMPLE_TURN_ON_THE_SPOT, sample_wall, 500),
    ("nearly on the spot, any wall", sample_turn_nearly_on_the_spot, sample_wall, 1000),
    ("nearly on the spot, tangent", sample_turn_nearly_on_the_spot, sample_tangent_wall, 1500),
    ("long", SAMPLE_LONG_ARC, sample_tangent_wall, 1500),
];

/// Both the analytic distance and the reference round coordinates a few times. The tolerance is eight units in the last place of the
/// extent.
#[test]
fn the_distance_of_arc_and_wall_equals_the_bisected_distance() {
    let (mut pair_total, mut crossing_count, mut narrow_bounds_count) = (0, 0, 0);
    for (seed, (kind_name, make_arc, make_wall, pair_count_of_kind)) in (0..).zip(ARC_AND_WALL_KINDS) {
        let mut rng = seeded_rng(9000 + seed);
        for _ in 0..pair_count_of_kind {
            let arc = make_arc(&mut rng);
            let wall = make_wall(&mut rng, &arc);
            let computed_distance = wall.distance_to_arc(&arc);
            let [min_distance, max_distance] = bound_distance(&arc, &wall);
            let tolerance = 8.0 * f64::EPSILON * extent_of(&arc, &wall);
            assert!(
                (min_distance - tolerance..=max_distance + tolerance).contains(&computed_distance),
                "{kind_name}: {computed_distance:e} instead of {min_distance:e} to {max_distance:e}: {arc:?} {wall:?}"
            );
            crossing_count += u32::from(computed_distance == 0.0);
            narrow_bounds_count += u32::from(max_distance - min_distance <= tolerance);
            pair_total += 1;
        }
    }
    assert!(
        pair_total >= 20_000 && crossing_count > pair_total / 10 && crossing_count < pair_total / 2,
        "{crossing_count} of {pair_total}"
    );
    assert!(
        narrow_bounds_count > pair_total * 9 / 10,
        "the reference was sharp for {narrow_bounds_count} of {pair_total}"
    );
}

/// Points of a drawn arc are 1/50 rad apart. A piece of length s and turn φ deviates by s·φ/8 from its chord. That is 0.05 mm for an arc of
/// a metre that turns by a radian. Beyond two turns the circle repeats itself, so that its chords may be longer.
#[test]
fn chords_of_an_arc_stay_within_a_twentieth_of_a_millimetre() {
    for (arc_length, arc_turn) in [(1.0, 1.0), (-2.0, 0.3), (1.0, -2.0 * TAU), (3.0, 0.004), (1.0, 0.0)] {
        let arc = Arc { start: SE2::new(1.0, -2.0, 0.7), length: arc_length, turn: arc_turn };
        let chord_points = arc.points();
        let chord_count = chord_points.len() - 1;
        assert_eq!(chord_points[0], [arc.start.x(), arc.start.y()]);
        assert!(
            norm_of(subtract_points(
                chord_points[chord_count],
                to_absolute(&arc, position_along_arc(&arc, 1.0))
            )) < 1e-14
        );
        for (i, chord_ends) in chord_points.windows(2).enumerate() {
            let middle_of_chord =
                [0, 1].map(|axis_index| 0.5 * (chord_ends[0][axis_index] + chord_ends[1][axis_index]));
            let arc_middle =
                to_absolute(&arc, position_along_arc(&arc, (i as f64 + 0.5) / chord_count as f64));
            let chord_deviation = norm_of(subtract_points(middle_of_chord, arc_middle));
            let max_deviation = 0.02 * 0.02 / 8.0 * (arc_length / arc_turn.abs().max(0.02)).abs() * 1.001;
            assert!(chord_deviation <= max_deviation, "{arc_turn}: {chord_deviation}");
        }
        assert!(chord_count <= 640);
    }
}
