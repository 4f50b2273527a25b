//! Line segments, and their exact distance to points and to arcs.

use super::arc::{Arc, LocalArc};
use std::f64::consts::PI;

/// Line segment between two points, m. Its length may be 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// First end: x and y, m.
    pub from: [f64; 2],
    /// Second end: x and y, m.
    pub to: [f64; 2],
}

impl Segment {
    /// Returns the distance (m) from a point to the nearest point of the segment.
    pub fn distance_to_point(&self, point: [f64; 2]) -> f64 {
        let [x, y] = self.offset_from_nearest_point(point);
        libm::hypot(x, y)
    }

    /// Returns the point of the segment that is nearest to a given point.
    pub fn nearest_point(&self, point: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.offset_from_nearest_point(point);
        [point[0] - x, point[1] - y]
    }

    /// Returns the squared distance to a point. Distances below 10⁻¹⁶² m underflow to 0.
    pub(crate) fn squared_distance_to_point(&self, point: [f64; 2]) -> f64 {
        let nearest_offset = self.offset_from_nearest_point(point);
        dot_product(nearest_offset, nearest_offset)
    }

    fn offset_from_nearest_point(&self, point: [f64; 2]) -> [f64; 2] {
        let direction = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let offset_from_start = [point[0] - self.from[0], point[1] - self.from[1]];
        let squared_length = dot_product(direction, direction);
        let t = if squared_length > 0.0 {
            (dot_product(offset_from_start, direction) / squared_length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        [offset_from_start[0] - t * direction[0], offset_from_start[1] - t * direction[1]]
    }

    /// Returns the distance (m) between the segment and an arc, which is 0 if they cross.
    ///
    /// The nearest points are a crossing, or an end of the segment or arc and a point of the other, or inner points of both. At inner
    /// points the segment is parallel to the arc and outside the arc's circle. Inside the circle there is no minimum at inner points,
    /// because the distance to the circle is concave along a line.
    pub fn distance_to_arc(&self, arc: &Arc) -> f64 {
        self.distance_to_local_arc(&arc.local_arc())
    }

    pub(crate) fn distance_to_local_arc(&self, arc: &LocalArc) -> f64 {
        let local_segment =
            Self { from: arc.transform_to_local(self.from), to: arc.transform_to_local(self.to) };
        if local_segment.crosses_arc(arc) { 0.0 } else { local_segment.distance_without_crossing(arc) }
    }

    /// Returns the maximum distance (m) of the points of an arc to the right of the line through the segment. The ends of the arc must lie
    /// on the line or to its left.
    pub(crate) fn max_distance_on_right(&self, arc: &Arc) -> f64 {
        let direction = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        let direction_length = libm::hypot(direction[0], direction[1]);
        // The point of the arc that is furthest from the line is where the arc is parallel to the line.
        let segment_bearing = libm::atan2(direction[1], direction[0]) - arc.start.theta();
        let parallel_turn = libm::remainder(segment_bearing * arc.turn.signum(), PI);
        let first_parallel_turn = if parallel_turn < 0.0 { parallel_turn + PI } else { parallel_turn };
        [first_parallel_turn, first_parallel_turn + PI]
            .into_iter()
            .map(|parallel_turn| parallel_turn / arc.turn.abs())
            .filter(|arc_fraction| *arc_fraction < 1.0)
            .map(|arc_fraction| arc.leading_part(arc_fraction).end())
            .map(|pose| {
                ((pose.x() - self.from[0]) * direction[1] - (pose.y() - self.from[1]) * direction[0])
                    / direction_length
            })
            .fold(0.0, f64::max)
    }

    fn crosses_arc(&self, arc: &LocalArc) -> bool {
        let Self { from, to: end_point } = *self;
        let direction = [end_point[0] - from[0], end_point[1] - from[1]];
        // The crossings of the segment with the circle solve a quadratic equation in the position along the segment.
        let a = 0.5 * arc.curvature * dot_product(direction, direction);
        let b = arc.curvature * dot_product(from, direction) - direction[1];
        let c = arc.circle_equation_value(from);
        // The discriminant b² − 4ac is rearranged to avoid cancellation if the segment is much longer than the radius.
        let line_offset = arc.curvature * (from[0] * direction[1] - from[1] * direction[0]);
        let quadratic_discriminant =
            direction[1] * direction[1] - line_offset * (line_offset + 2.0 * direction[0]);
        if quadratic_discriminant < 0.0 {
            return false;
        }
        let q = -0.5 * (b + quadratic_discriminant.sqrt().copysign(b));
        [q / a, c / q].into_iter().any(|t| {
            (0.0..=1.0).contains(&t)
                && arc.contains_nearest_circle_point([from[0] + t * direction[0], from[1] + t * direction[1]])
        })
    }

    fn distance_without_crossing(&self, arc: &LocalArc) -> f64 {
        let Self { from, to: end_point } = *self;
        let direction = [end_point[0] - from[0], end_point[1] - from[1]];
        let squared_length = dot_product(direction, direction);
        let mut min_distance = [
            arc.distance_to_point(from),
            arc.distance_to_point(end_point),
            self.distance_to_point([0.0, 0.0]),
            self.distance_to_point(arc.end),
        ]
        .into_iter()
        .fold(f64::INFINITY, f64::min);
        // If the nearest point is inside the segment, it is the foot of the perpendicular from the circle's centre to the segment. A
        // straight arc has no centre.
        if arc.curvature > 0.0 && squared_length > 0.0 {
            let t = (direction[1] / arc.curvature - dot_product(from, direction)) / squared_length;
            if (0.0..=1.0).contains(&t) {
                // A foot of the perpendicular inside the circle is farther from the arc than the nearest point of the segment. Including it
                // in the minimum therefore does no harm. If the segment touches the circle, rounding may move the foot inside, and it must
                // be included.
                min_distance = min_distance
                    .min(arc.distance_to_point([from[0] + t * direction[0], from[1] + t * direction[1]]));
            }
        }
        min_distance
    }
}

fn dot_product(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
