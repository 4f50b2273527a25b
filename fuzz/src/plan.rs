//! Floor plans of any walls, and verdicts on motions in them.

use super::input::Input;
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, FloorPlanError};

/// Maximum number of walls of a plan, whose distance field grows with it, and number of arcs that are tested.
const WALLS: usize = 4;
const ARCS: usize = 3;

pub fn run(bytes: &[u8]) {
    let mut input = Input(bytes);
    let Some(plan) = read(&mut input) else { return };
    for _ in 0..ARCS {
        assert_verdict(&plan, &mut input);
        if input.is_empty() {
            break;
        }
    }
}

/// Reads a plan of a few walls; None if it is refused.
pub fn read(input: &mut Input) -> Option<FloorPlan> {
    let bounds: [f64; 4] = if input.truth() {
        std::array::from_fn(|_| input.number())
    } else {
        let [left, bottom] = [0, 1].map(|_| input.within(-1e6..=1e6));
        let [width, height] = [0, 1].map(|_| input.within(0.01..=1e5));
        [left, bottom, left + width, bottom + height]
    };
    let [left, bottom, right, top] = bounds;
    let of = |input: &mut Input, low: f64, high: f64| {
        let share = f64::from(input.byte()) / 255.0;
        let inside = low + (high - low) * share;
        if input.choice(16) == 0 { input.number() } else { inside }
    };
    let count = input.choice(1 + WALLS);
    let mut walls: Vec<Segment> = Vec::new();
    for i in 0..count {
        let known = walls.get(i.wrapping_sub(1)).copied();
        let mut point = || [of(input, left, right), of(input, bottom, top)];
        let from = point();
        let to = point();
        // Corners, and walls over walls.
        walls.push(match (input.choice(8), known) {
            (0, Some(wall)) => wall,
            (1, Some(wall)) => Segment { from: wall.to, to },
            (2, _) => Segment { from, to: from },
            (3, _) => Segment { from, to: [to[0], from[1]] },
            (4, _) => Segment { from, to: [from[0], to[1]] },
            _ => Segment { from, to },
        });
    }
    let are_good = bounds.iter().all(|bound| bound.abs() <= 1e6)
        && [right - left, top - bottom].iter().all(|side| (0.01..=1e5).contains(side));
    // The edge has a tolerance for rounding.
    let edge = 1e-12 * bounds.iter().fold(0.0, |most: f64, bound| most.max(bound.abs()));
    let is_outside = |[x, y]: [f64; 2]| {
        !(left - edge..=right + edge).contains(&x) || !(bottom - edge..=top + edge).contains(&y)
    };
    match FloorPlan::new(walls.clone(), bounds) {
        Ok(plan) => {
            assert!(are_good && !walls.iter().any(|wall| is_outside(wall.from) || is_outside(wall.to)));
            Some(plan)
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains("; allowed is "), "{message}");
            match error {
                FloorPlanError::BadBounds(which) => {
                    assert!(!are_good, "{message}");
                    super::laws::assert_same_numbers(&message, &which, &bounds);
                }
                FloorPlanError::BadWall { index, end } => {
                    assert!(index < count, "{message}");
                    let [x, y] = end;
                    assert!(!((left..=right).contains(&x) && (bottom..=top).contains(&y)), "{message}");
                }
                FloorPlanError::TooManyWalls(_)
                | FloorPlanError::BadGrid(_)
                | FloorPlanError::TooManySides(_) => panic!("{message}"),
            }
            None
        }
    }
}

/// Returns a pose, mostly inside the bounds.
pub fn pose(plan: &FloorPlan, input: &mut Input) -> SE2 {
    let [left, bottom, right, top] = plan.bounds();
    let [x, y] = [[left, right], [bottom, top]].map(|[low, high]| {
        let share = f64::from(u16::from_le_bytes(input.bytes())) / 65_535.0;
        low + (high - low) * share
    });
    SE2::new(x, y, input.within(-1e6..=1e6))
}

/// Asserts that the verdicts on an arc and on its end are those of a loop over all walls.
pub fn assert_verdict(plan: &FloorPlan, input: &mut Input) {
    let start = pose(plan, input);
    let length = input.within(-1e12..=1e12);
    let turn = input.within(-1e12..=1e12);
    let clearance = input.within(0.0..=10.0);
    let arc = Arc { start, length, turn };
    let tolerance = rounding_error(plan, &arc, clearance);
    let depth = |x: f64, y: f64| depth(plan, [x, y]);

    // Upper bound of the least distance of the path from the edge of the map, by some of its points.
    // `least - between` is a lower bound.
    const CHORDS: u32 = 16;
    let least = (0..=CHORDS).fold(f64::INFINITY, |least, i| {
        let f = f64::from(i) / f64::from(CHORDS);
        let at = Arc { length: f * length, turn: f * turn, ..arc }.end();
        least.min(depth(at.x(), at.y()))
    });
    // No point of an arc is further from a looked-at one than half the piece between two, or the circle is wide.
    let circle = if turn == 0.0 { f64::INFINITY } else { 2.0 * (length / turn).abs() };
    let between = (0.5 * length.abs() / f64::from(CHORDS)).min(circle);
    let buried = plan.grid().is_some_and(|grid| grid.is_blocked_at([start.x(), start.y()]));
    let room = plan.walls().iter().map(|wall| wall.distance_to_arc(&arc)).fold(f64::INFINITY, f64::min);

    let found = plan.arc_free(&arc, clearance).free;
    let about = format!("{arc:?} with {clearance} to spare: room {room}, at the edge {least}");
    if found {
        assert!(room > clearance - tolerance && least >= -tolerance && !buried, "through a wall: {about}");
    } else {
        let clear = room > clearance + tolerance && least - between > tolerance && !buried;
        assert!(!clear, "refused for nothing: {about}");
    }

    let end = arc.end();
    let point = [end.x(), end.y()];
    let room = plan.walls().iter().map(|wall| wall.distance_to_point(point)).fold(f64::INFINITY, f64::min);
    let found = plan.point_free(point, clearance).free;
    let buried = plan.grid().is_some_and(|grid| grid.is_blocked_at(point));
    let inside = depth(point[0], point[1]);
    if found {
        assert!(room > clearance - tolerance && inside >= -tolerance && !buried, "{point:?}, {clearance}");
    } else {
        let clear = room > clearance + tolerance && inside > tolerance && !buried;
        assert!(!clear, "refused for nothing: {point:?}, {clearance}");
    }
}

/// Returns the distance (m) of a point inside the map from its edge; negative outside.
fn depth(plan: &FloorPlan, [x, y]: [f64; 2]) -> f64 {
    let ([x, y], [left, bottom, right, top]) = match plan.grid() {
        None => ([x, y], plan.bounds()),
        Some(grid) => {
            let local = grid.origin().inverse() * SE2::new(x, y, 0.0);
            let [columns, rows] = grid.size().map(|count| count as f64 * grid.resolution());
            ([local.x(), local.y()], [0.0, 0.0, columns, rows])
        }
    };
    (x - left).min(right - x).min(y - bottom).min(top - y)
}

/// Tolerance for rounding in m, as `FloorPlan` has it at the edge of a map: some thousand units in the last place of the
/// largest number.
fn rounding_error(plan: &FloorPlan, arc: &Arc, clearance: f64) -> f64 {
    let furthest = plan.bounds().iter().fold(0.0, |most: f64, bound| most.max(bound.abs()));
    1e-12 * (furthest + arc.length.abs() + clearance)
}
