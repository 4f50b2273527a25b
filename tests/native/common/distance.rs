//! Distance between an arc and a wall by bisection: an independent reference without the equation of a circle.

use motion::geom::arc::Arc;
use motion::geom::segment::Segment;

pub type Point = [f64; 2];

pub fn position_along_arc(arc: &Arc, f: f64) -> Point {
    let (length, turn) = (f * arc.length, f * arc.turn);
    let (forward_offset, left_offset) = if turn == 0.0 {
        (length, 0.0)
    } else {
        (length * (turn.sin() / turn), length * (0.5 * turn).sin() * ((0.5 * turn).sin() / (0.5 * turn)))
    };
    let (sin, cos) = arc.start.theta().sin_cos();
    [cos * forward_offset - sin * left_offset, sin * forward_offset + cos * left_offset]
}

pub fn subtract_points(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub fn cross_product(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub fn norm_of(a: Point) -> f64 {
    a[0].hypot(a[1])
}

pub fn distance_to_segment(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (d, r) = (subtract_points(b, a), subtract_points(p, a));
    let segment_length = norm_of(d);
    if segment_length == 0.0 {
        return norm_of(r);
    }
    let unit_direction = [d[0] / segment_length, d[1] / segment_length];
    let projected_length = unit_direction[0] * r[0] + unit_direction[1] * r[1];
    if projected_length <= 0.0 {
        norm_of(r)
    } else if projected_length >= segment_length {
        norm_of(subtract_points(p, b))
    } else {
        cross_product(unit_direction, r).abs()
    }
}

pub fn distance_between_segments(p: [Point; 2], q: [Point; 2]) -> f64 {
    let are_ends_on_both_sides = |[a, b]: [Point; 2], [c, d]: [Point; 2]| {
        cross_product(subtract_points(b, a), subtract_points(c, a))
            * cross_product(subtract_points(b, a), subtract_points(d, a))
            < 0.0
    };
    if are_ends_on_both_sides(p, q) && are_ends_on_both_sides(q, p) {
        return 0.0;
    }
    [
        distance_to_segment(p[0], q),
        distance_to_segment(p[1], q),
        distance_to_segment(q[0], p),
        distance_to_segment(q[1], p),
    ]
    .into_iter()
    .fold(f64::INFINITY, f64::min)
}

/// Returns a lower and an upper bound of the distance between an arc and a wall. A piece of the arc with length l and turn t deviates
/// from its chord by at most l·t/8. Pieces that cannot contain the nearest point are dropped, and the others are halved until only
/// rounding is left. Halving ends at 1000 pieces, because a wall that ends at the centre of the circle is equally near to all pieces.
pub fn bound_distance(arc: &Arc, wall: &Segment) -> [f64; 2] {
    let arc_start = [arc.start.x(), arc.start.y()];
    let wall_ends = [subtract_points(wall.from, arc_start), subtract_points(wall.to, arc_start)];
    let piece_count = (arc.turn.abs() / 0.5).ceil().max(1.0) as u32;
    let mut piece_fraction = 1.0 / f64::from(piece_count);
    let mut piece_starts: Vec<f64> = (0..piece_count).map(|i| f64::from(i) * piece_fraction).collect();
    loop {
        let chord_deviation = (arc.length * piece_fraction).abs() * (arc.turn * piece_fraction).abs() / 8.0;
        let piece_starts_and_distances: Vec<(f64, f64)> = piece_starts
            .iter()
            .map(|&f| {
                (
                    f,
                    distance_between_segments(
                        [f, (f + piece_fraction).min(1.0)].map(|f| position_along_arc(arc, f)),
                        wall_ends,
                    ),
                )
            })
            .collect();
        let min_distance = piece_starts_and_distances
            .iter()
            .fold(f64::INFINITY, |min_so_far, (_, piece_distance)| min_so_far.min(*piece_distance));
        if chord_deviation <= 0.1 * f64::EPSILON * extent_of(arc, wall)
            || piece_starts_and_distances.len() > 1000
        {
            return [min_distance - chord_deviation, min_distance + chord_deviation];
        }
        piece_fraction *= 0.5;
        piece_starts = piece_starts_and_distances
            .into_iter()
            .filter(|(_, piece_distance)| *piece_distance <= min_distance + 2.0 * chord_deviation)
            .flat_map(|(f, _)| [f, f + piece_fraction])
            .collect();
    }
}

/// Returns the extent of an arc and a wall (m), to which the rounding of their distance is proportional. It is at least 15 m, the size of
/// the coordinates of random walls.
pub fn extent_of(arc: &Arc, wall: &Segment) -> f64 {
    let arc_start = [arc.start.x(), arc.start.y()];
    norm_of(subtract_points(wall.from, arc_start))
        .max(norm_of(subtract_points(wall.to, arc_start)))
        .max(arc.length.abs())
        .max(15.0)
}
