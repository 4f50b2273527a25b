//! Distance between an arc and a wall by bisection: an independent reference without the equation of a circle.

use motion::geom::arc::Arc;
use motion::geom::segment::Segment;

pub type Point = [f64; 2];

/// Returns the position after a fraction `f` of the arc, relative to its start.
pub fn position_along(arc: &Arc, f: f64) -> Point {
    let (length, turn) = (f * arc.length, f * arc.turn);
    let (forward, left) = if turn == 0.0 {
        (length, 0.0)
    } else {
        (length * (turn.sin() / turn), length * (0.5 * turn).sin() * ((0.5 * turn).sin() / (0.5 * turn)))
    };
    let (sin, cos) = arc.start.theta().sin_cos();
    [cos * forward - sin * left, sin * forward + cos * left]
}

pub fn difference(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub fn norm(a: Point) -> f64 {
    a[0].hypot(a[1])
}

pub fn distance_to_segment(p: Point, [a, b]: [Point; 2]) -> f64 {
    let (d, r) = (difference(b, a), difference(p, a));
    let length = norm(d);
    if length == 0.0 {
        return norm(r);
    }
    let unit = [d[0] / length, d[1] / length];
    let distance_along = unit[0] * r[0] + unit[1] * r[1];
    if distance_along <= 0.0 {
        norm(r)
    } else if distance_along >= length {
        norm(difference(p, b))
    } else {
        cross(unit, r).abs()
    }
}

pub fn distance_of_segments(p: [Point; 2], q: [Point; 2]) -> f64 {
    let are_on_both_sides = |[a, b]: [Point; 2], [c, d]: [Point; 2]| {
        cross(difference(b, a), difference(c, a)) * cross(difference(b, a), difference(d, a)) < 0.0
    };
    if are_on_both_sides(p, q) && are_on_both_sides(q, p) {
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

/// Returns a lower and an upper bound of the distance. A piece of the arc with length l and turn t deviates from its chord by at most l·t/8.
/// The distance to the piece is therefore that to its chord ± l·t/8. Pieces that cannot contain the nearest point are dropped, and the
/// others are halved until only rounding is left. Halving ends at 1000 pieces, because all may be equally near the centre of the circle.
pub fn distance_by_halving(arc: &Arc, wall: &Segment) -> [f64; 2] {
    let start = [arc.start.x(), arc.start.y()];
    let ends = [difference(wall.from, start), difference(wall.to, start)];
    let pieces = (arc.turn.abs() / 0.5).ceil().max(1.0) as u32;
    let mut size = 1.0 / f64::from(pieces);
    let mut candidates: Vec<f64> = (0..pieces).map(|i| f64::from(i) * size).collect();
    loop {
        let max_deviation = (arc.length * size).abs() * (arc.turn * size).abs() / 8.0;
        let distances: Vec<(f64, f64)> = candidates
            .iter()
            .map(|&f| {
                (f, distance_of_segments([f, (f + size).min(1.0)].map(|f| position_along(arc, f)), ends))
            })
            .collect();
        let min_distance =
            distances.iter().fold(f64::INFINITY, |smallest, (_, distance)| smallest.min(*distance));
        if max_deviation <= 0.1 * f64::EPSILON * extent(arc, wall) || distances.len() > 1000 {
            return [min_distance - max_deviation, min_distance + max_deviation];
        }
        size *= 0.5;
        candidates = distances
            .into_iter()
            .filter(|(_, distance)| *distance <= min_distance + 2.0 * max_deviation)
            .flat_map(|(f, _)| [f, f + size])
            .collect();
    }
}

/// Returns the extent of an arc and a wall, m, to which the rounding of their distance is relative. It is at least 15 m, because random
/// walls are made from coordinates of that size.
pub fn extent(arc: &Arc, wall: &Segment) -> f64 {
    let start = [arc.start.x(), arc.start.y()];
    norm(difference(wall.from, start)).max(norm(difference(wall.to, start))).max(arc.length.abs()).max(15.0)
}
