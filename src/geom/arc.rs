//! Circular arcs driven from a pose, in the chord form.
//!
//! A robot at the origin with heading 0 drives the signed length `s` while turning by `φ`. It ends at distance s · sinc(φ/2) on the bearing
//! φ/2. The formula equals the arc update of Table 5.3 with the radius r = s/φ cancelled. The formula needs no branch for straight lines.
//! It loses no digits as φ → 0, where the centre of the circle goes to infinity.

use super::angle::wrap_angle;
use super::lanes::{SinCos, Trigonometry};
use super::se2::SE2;
use super::sinc::{sinc, unit_arc_end};
use std::f64::consts::{PI, TAU};
use std::ops::{Add, Mul};
use wide::f64x4;

/// Returns the end of an arc of signed length `arc_length` (m) that turns by `arc_turn` (rad), in the frame of its start: x forward, y left.
/// The end is (s·sin φ/φ, s·(1 − cos φ)/φ), with (1 − cos φ)/φ = sin(φ/2)·sinc(φ/2).
pub fn arc_end(arc_length: f64, arc_turn: f64) -> (f64, f64) {
    let (forward_offset, left_offset) = unit_arc_end(arc_turn);
    (arc_length * forward_offset, arc_length * left_offset)
}

/// Controls that explain the motion between two poses: an arc at (v̂, ω̂), then a final rotation at the rate γ̂.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcInversion {
    /// Translational velocity along the arc, m/s, which is negative in reverse.
    pub v_hat: f64,
    /// Rotational velocity along the arc, rad/s, with |ω̂·Δt| ≤ π.
    pub omega_hat: f64,
    /// Rate of the final rotation over Δt, rad/s, with |γ̂·Δt| ≤ π.
    pub gamma_hat: f64,
}

impl ArcInversion {
    /// Returns the signed radius v̂/ω̂ of the arc (m). It is positive if the centre is to the left of the heading, and infinite if the arc
    /// is straight.
    pub fn radius(&self) -> f64 {
        if self.omega_hat == 0.0 { f64::INFINITY } else { self.v_hat / self.omega_hat }
    }

    /// Returns the centre of the circle of an arc that leaves `x` (m, in the frame in which `x` is given): (x − r·sin θ, y + r·cos θ).
    /// None if the arc is straight, or if the coordinates of the centre exceed the range of doubles.
    pub fn centre(&self, x: &SE2) -> Option<[f64; 2]> {
        let radius = self.radius();
        let (sin, cos) = libm::sincos(x.theta());
        let centre = [x.x() - radius * sin, x.y() + radius * cos];
        radius.is_finite().then_some(centre)
    }
}

/// Returns the arc that leaves `x` along its heading and reaches the position of `x_next` in `dt` seconds. It is Table 5.1,
/// lines 1–8, with a signed radius.
///
/// The displacement in the frame of `x` has distance d and bearing β. The arc turns by φ = 2β, and v̂Δt = d / sinc(β).
/// Several arcs of the circle lead there, in both directions and with several revolutions. This is the one with |φ| ≤ π. It
/// is driven in reverse if the displacement points backwards. γ̂ = wrap(θ′ − θ − φ)/Δt.
///
/// Without displacement the result is a turn on the spot with γ̂ = 0.
///
/// `dt` must be positive. Both poses must be in the same frame, on which the result does not depend.
///
/// ```
/// use motion::{geom::se2::SE2, invert_arc};
///
/// let arc = invert_arc(&SE2::identity(), &SE2::new(1.0, 1.0, 2.0), 1.0);
/// assert!((arc.radius() - 1.0).abs() < 1e-12);
/// assert!((arc.omega_hat + arc.gamma_hat - 2.0).abs() < 1e-12);
/// ```
pub fn invert_arc(x: &SE2, x_next: &SE2, dt: f64) -> ArcInversion {
    let relative_pose = x.motion_to(x_next);
    let end_distance = libm::hypot(relative_pose.x(), relative_pose.y());
    if end_distance == 0.0 {
        return ArcInversion { v_hat: 0.0, omega_hat: relative_pose.theta() / dt, gamma_hat: 0.0 };
    }
    let drive_sign = if relative_pose.x() < 0.0 { -1.0 } else { 1.0 };
    let bearing = libm::atan2(drive_sign * relative_pose.y(), drive_sign * relative_pose.x());
    let arc_turn = 2.0 * bearing;
    ArcInversion {
        v_hat: drive_sign * end_distance / sinc(bearing) / dt,
        omega_hat: arc_turn / dt,
        gamma_hat: wrap_angle(relative_pose.theta() - arc_turn) / dt,
    }
}

/// Returns the signed length (m) and turn (rad) of an arc from `x` along its heading to the position of `x_next`. Of all such
/// arcs, it is the one whose turn is nearest to `near_turn` (rad). It may be driven in reverse, and with several revolutions.
///
/// All such arcs lie on one circle, where the length driven is proportional to the turn. Without displacement the length
/// is 0; along a straight line, which closes no circle, the turn is 0.
pub fn arc_with_turn_near(x: &SE2, x_next: &SE2, near_turn: f64) -> (f64, f64) {
    let ArcInversion { v_hat: arc_length, omega_hat: arc_turn, .. } = invert_arc(x, x_next, 1.0);
    let full_circle_count = ((near_turn - arc_turn) / TAU).round();
    if full_circle_count == 0.0 || arc_turn == 0.0 {
        return (arc_length, arc_turn);
    }
    let total_turn = arc_turn + full_circle_count * TAU;
    (arc_length * (total_turn / arc_turn), total_turn)
}

/// Path of a point that leaves `start` along its heading and drives the signed `length` (m) while it turns by `turn` (rad, any size).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Pose at the start.
    pub start: SE2,
    /// Length, m, which is negative in reverse.
    pub length: f64,
    /// Turn, rad, counter-clockwise.
    pub turn: f64,
}

impl Arc {
    /// Returns the end pose of the arc.
    pub fn end(&self) -> SE2 {
        let DrivenArc { end: [x, y], heading, .. } =
            PreparedPose::new(self.start).drive(self.length, self.turn);
        SE2::new(x, y, heading)
    }

    /// Returns points on the arc that are at most about one degree of its turn apart. The polyline through them is within 0.05 mm of an arc
    /// of 1 m and 1 rad. Arcs beyond two revolutions have points further apart.
    pub fn points(&self) -> Vec<[f64; 2]> {
        let chord_count = (self.turn.abs() / 0.02).clamp(1.0, 640.0).ceil();
        (0..=chord_count as u32)
            .map(|i| self.leading_part(f64::from(i) / chord_count).end().position())
            .collect()
    }

    /// Returns the first part of the arc, whose length is `length_fraction` of the length of the arc.
    pub(crate) fn leading_part(&self, length_fraction: f64) -> Self {
        Self { length: self.length * length_fraction, turn: self.turn * length_fraction, ..*self }
    }

    pub(crate) fn local_arc(&self) -> LocalArc {
        let (sin, cos) = libm::sincos(self.start.theta());
        let drive_sign = if self.length < 0.0 { -1.0 } else { 1.0 };
        let length = self.length.abs();
        // A drive in reverse is mirrored into a forward drive with the opposite turn, and a right turn into a left turn.
        let turn = self.turn * drive_sign;
        let turn_sign = if turn < 0.0 { -1.0 } else { 1.0 };
        let turn = turn.abs();
        let arc_curvature = if length > MIN_ARC_LENGTH && turn > MIN_ARC_TURN { turn / length } else { 0.0 };
        LocalArc {
            local_origin: self.start.position(),
            forward_axis: [drive_sign * cos, drive_sign * sin],
            left: [-turn_sign * sin, turn_sign * cos],
            length,
            turn,
            curvature: arc_curvature,
            end: arc_end(length, turn).into(),
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PreparedPose {
    pub pose: SE2,
    sin: f64,
    cos: f64,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct DrivenArc {
    pub arc: Arc,
    pub end: [f64; 2],
    /// Heading at the end in (−π, π], rad.
    pub heading: f64,
    /// sinc(φ/2), which is the length of the chord divided by the length of the arc.
    chord_ratio: f64,
}

impl PreparedPose {
    pub fn new(pose: SE2) -> Self {
        let (sin, cos) = libm::sincos(pose.theta());
        Self { pose, sin, cos }
    }

    #[inline(always)]
    pub fn transform_point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.pose.x() + (self.cos * x - self.sin * y), self.pose.y() + (self.sin * x + self.cos * y)]
    }

    /// Returns the arc of `length` (m) and `turn` (rad) from this pose, with its end.
    #[inline(always)]
    pub fn drive(&self, length: f64, turn: f64) -> DrivenArc {
        let half_turn = 0.5 * turn;
        let half_sine = libm::sin(half_turn);
        let chord_ratio = if half_turn == 0.0 { 1.0 } else { half_sine / half_turn };
        let (forward_offset, left_offset) = (length * sinc(turn), length * (half_sine * chord_ratio));
        self.create_driven_arc(length, turn, chord_ratio, self.transform_point([forward_offset, left_offset]))
    }

    /// Computes four arcs from this pose in SIMD lanes. Returns a function from the lane index to the arc. The ends differ from those of
    /// [`PreparedPose::drive`] by less than 2e-15 · length.
    #[inline(always)]
    pub fn drive_four_arcs(
        &self,
        turn_trigonometry: &Trigonometry,
        arc_length: f64x4,
        turn: f64x4,
    ) -> impl Fn(usize) -> DrivenArc {
        // The chord of an arc has the bearing φ/2.
        let SinCos { sinc, sin, cos } = turn_trigonometry.sin_cos(turn * 0.5);
        let chord_length = arc_length * sinc;
        let (forward_offset, left_offset) = (chord_length * cos, chord_length * sin);
        let x = (forward_offset * self.cos - left_offset * self.sin) + self.pose.x();
        let y = (forward_offset * self.sin + left_offset * self.cos) + self.pose.y();
        let [arc_length, turn, sinc, x, y] = [arc_length, turn, sinc, x, y].map(f64x4::to_array);
        let start_pose = *self;
        move |i| start_pose.create_driven_arc(arc_length[i], turn[i], sinc[i], [x[i], y[i]])
    }

    fn create_driven_arc(&self, arc_length: f64, turn: f64, chord_ratio: f64, end: [f64; 2]) -> DrivenArc {
        let heading = wrap_angle(self.pose.theta() + wrap_angle(turn));
        DrivenArc { arc: Arc { start: self.pose, length: arc_length, turn }, end, heading, chord_ratio }
    }
}

impl DrivenArc {
    /// Returns the arc as one or two pieces of up to half a turn. The part of the arc after a full turn is omitted, because it covers the
    /// same circle again.
    pub fn split_into_pieces(&self) -> impl Iterator<Item = ArcPiece> {
        let Arc { start, length: arc_length, turn: arc_turn } = self.arc;
        let start_point = start.position();
        if arc_turn.abs() <= PI {
            let arc_piece =
                ArcPiece::new(start_point, self.end, arc_length.abs(), arc_turn, self.chord_ratio);
            return [Some(arc_piece), None].into_iter().flatten();
        }
        let piece_fraction = 0.5 * (TAU / arc_turn.abs()).min(1.0);
        let (arc_length, arc_turn) = (piece_fraction * arc_length, piece_fraction * arc_turn);
        let DrivenArc { end: middle_position, chord_ratio, .. } =
            PreparedPose::new(start).drive(arc_length, arc_turn);
        let end_point = if piece_fraction < 0.5 { start_point } else { self.end };
        [(start_point, middle_position), (middle_position, end_point)]
            .map(|(start, end)| Some(ArcPiece::new(start, end, arc_length.abs(), arc_turn, chord_ratio)))
            .into_iter()
            .flatten()
    }

    pub fn bounding_box(&self) -> [f64; 4] {
        let ([x0, y0], [x1, y1]) = (self.arc.start.position(), self.end);
        if self.arc.turn.abs() > PI {
            let circle_diameter = 2.0 * (self.arc.length / self.arc.turn).abs();
            return [x0 - circle_diameter, y0 - circle_diameter, x0 + circle_diameter, y0 + circle_diameter];
        }
        // The box contains the chord, and the chord shifted sideways by φ/2π of its length. The sagitta is less: tan(φ/4)/2 of the length.
        let sagitta_ratio = self.arc.turn / TAU;
        let (sagitta_x, sagitta_y) = (sagitta_ratio * (y1 - y0), sagitta_ratio * (x0 - x1));
        [
            x0.min(x1) + sagitta_x.min(0.0),
            y0.min(y1) + sagitta_y.min(0.0),
            x0.max(x1) + sagitta_x.max(0.0),
            y0.max(y1) + sagitta_y.max(0.0),
        ]
    }
}

/// Approximation of an arc of up to half a turn, for fast computation of its points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ArcPiece {
    middle_point: [f64; 2],
    travel_direction: [f64; 2],
    curvature: f64,
    pub half_length: f64,
    /// Maximum error of a computed point of the arc, m.
    pub max_error: f64,
}

impl ArcPiece {
    /// Creates the piece between two points. `length` (m) is positive, `turn` is in rad, and `chord_ratio` is sinc(φ/2).
    fn new(start: [f64; 2], end: [f64; 2], length: f64, turn: f64, chord_ratio: f64) -> Self {
        let (inverse_chord, arc_curvature) =
            if length > MIN_ARC_LENGTH { (1.0 / (length * chord_ratio), turn / length) } else { (0.0, 0.0) };
        let chord_direction = [(end[0] - start[0]) * inverse_chord, (end[1] - start[1]) * inverse_chord];
        let half_length = 0.5 * length;
        let uncorrected_piece = Self {
            middle_point: [0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])],
            travel_direction: chord_direction,
            curvature: arc_curvature,
            half_length,
            max_error: 0.0,
        };
        let [_, sagitta]: [f64; 2] = uncorrected_piece.local_point(half_length);
        let middle_point = [
            uncorrected_piece.middle_point[0] + sagitta * chord_direction[1],
            uncorrected_piece.middle_point[1] - sagitta * chord_direction[0],
        ];
        let half_turn_squared = 0.25 * turn * turn;
        Self {
            middle_point,
            max_error: half_length * half_turn_squared * half_turn_squared * half_turn_squared / 2000.0,
            ..uncorrected_piece
        }
    }

    /// Returns the coordinates, ahead and to the left of the middle of the arc piece, of the point `s` metres after the middle. `T` is a
    /// number or four SIMD lanes.
    #[inline(always)]
    fn local_point<T>(&self, s: T) -> [T; 2]
    where
        T: Copy + Mul<Output = T> + Mul<f64, Output = T> + Add<f64, Output = T>,
    {
        let turn_from_middle = s * self.curvature;
        let turn_squared = turn_from_middle * turn_from_middle;
        [
            s * (turn_squared * (turn_squared * (1.0 / 120.0) + -1.0 / 6.0) + 1.0),
            s * turn_from_middle * (turn_squared * (turn_squared * (1.0 / 720.0) + -1.0 / 24.0) + 0.5),
        ]
    }

    #[inline(always)]
    pub fn points_at(&self, s: f64x4) -> [f64x4; 2] {
        let [ahead_offset, left_offset] = self.local_point(s);
        let [cos, sin] = self.travel_direction;
        [
            (ahead_offset * cos - left_offset * sin) + self.middle_point[0],
            (ahead_offset * sin + left_offset * cos) + self.middle_point[1],
        ]
    }
}

/// Turn (rad) below which an arc counts as straight. Such an arc deviates from a line by less than rounding. A much larger limit would
/// cause visible errors. A much smaller limit would let the curvature underflow.
const MIN_ARC_TURN: f64 = 1e-30;

/// Length (m) below which arcs count as points. The curvature of a shorter arc can be so large that its product with the area of a map
/// (some km²) exceeds the range of doubles.
const MIN_ARC_LENGTH: f64 = 1e-100;

/// Arc in the frame of its start, mirrored so that it leads forward and to the left. It starts at the origin along x, with
/// length, turn and curvature κ ≥ 0. No formula uses the centre, which is far away or undefined if κ is small.
pub(crate) struct LocalArc {
    local_origin: [f64; 2],
    forward_axis: [f64; 2],
    left: [f64; 2],
    pub length: f64,
    pub turn: f64,
    pub curvature: f64,
    pub end: [f64; 2],
}

impl LocalArc {
    pub fn transform_to_local(&self, point: [f64; 2]) -> [f64; 2] {
        let (dx, dy) = (point[0] - self.local_origin[0], point[1] - self.local_origin[1]);
        [dx * self.forward_axis[0] + dy * self.forward_axis[1], dx * self.left[0] + dy * self.left[1]]
    }

    /// Returns κ|p|²/2 − y of a point p: 0 on the circle (or line) of the arc, positive outside the circle (or right of the line).
    pub fn circle_equation_value(&self, [x, y]: [f64; 2]) -> f64 {
        0.5 * self.curvature * (x * x + y * y) - y
    }

    /// Returns true if the point of the circle nearest to `point` belongs to the arc.
    pub fn contains_nearest_circle_point(&self, [x, y]: [f64; 2]) -> bool {
        if self.curvature == 0.0 {
            return (0.0..=self.length).contains(&x);
        }
        let bearing = libm::atan2(self.curvature * x, 1.0 - self.curvature * y);
        (if bearing < 0.0 { bearing + TAU } else { bearing }) <= self.turn
    }

    pub fn distance_to_point(&self, point: [f64; 2]) -> f64 {
        let distance_to_ends =
            libm::hypot(point[0], point[1]).min(libm::hypot(point[0] - self.end[0], point[1] - self.end[1]));
        if !self.contains_nearest_circle_point(point) {
            return distance_to_ends;
        }
        // |p − c| − 1/κ = (|p − c|² − 1/κ²)/(|p − c| + 1/κ). Numerator and denominator are multiplied by κ, because the centre c may be far away.
        let scaled_centre_distance = libm::hypot(self.curvature * point[0], 1.0 - self.curvature * point[1]);
        (2.0 * self.circle_equation_value(point) / (1.0 + scaled_centre_distance)).abs().min(distance_to_ends)
    }
}
