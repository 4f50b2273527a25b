//! Floor plans of any walls, and verdicts on motions in them.

use super::input::Input;
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, FloorPlanError};

/// Maximum number of walls of a plan, and of tested arcs. The time for the distance field grows with the number of walls.
const MAX_WALLS: usize = 4;
const MAX_ARCS: usize = 3;

pub fn run(bytes: &[u8]) {
    let mut input = Input(bytes);
    let Some(plan) = read_plan(&mut input) else { return };
    for _ in 0..MAX_ARCS {
        assert_verdict(&plan, &mut input);
        if input.is_empty() {
            break;
        }
    }
}

/// Reads a plan of a few walls; None if it is refused.
pub fn read_plan(input: &mut Input) -> Option<FloorPlan> {
    let bounds: [f64; 4] = if input.next_bool() {
        std::array::from_fn(|_| input.next_number())
    } else {
        let [left, bottom] = [0, 1].map(|_| input.number_within(-1e6..=1e6));
        let [width, height] = [0, 1].map(|_| input.number_within(0.01..=1e5));
        [left, bottom, left + width, bottom + height]
    };
    let [left, bottom, right, top] = bounds;
    let coordinate = |input: &mut Input, low: f64, high: f64| {
        let fraction = f64::from(input.next_byte()) / 255.0;
        let number_inside = low + (high - low) * fraction;
        if input.next_choice(16) == 0 { input.next_number() } else { number_inside }
    };
    let count = input.next_choice(1 + MAX_WALLS);
    let mut walls: Vec<Segment> = Vec::new();
    for i in 0..count {
        let earlier_wall = walls.get(i.wrapping_sub(1)).copied();
        let mut point = || [coordinate(input, left, right), coordinate(input, bottom, top)];
        let from = point();
        let to = point();
        // Some walls equal the previous wall, or start at its end.
        walls.push(match (input.next_choice(8), earlier_wall) {
            (0, Some(wall)) => wall,
            (1, Some(wall)) => Segment { from: wall.to, to },
            (2, _) => Segment { from, to: from },
            (3, _) => Segment { from, to: [to[0], from[1]] },
            (4, _) => Segment { from, to: [from[0], to[1]] },
            _ => Segment { from, to },
        });
    }
    let are_valid_bounds = bounds.iter().all(|bound| bound.abs() <= 1e6)
        && [right - left, top - bottom].iter().all(|side| (0.01..=1e5).contains(side));
    // The edge has a tolerance for rounding.
    let edge_tolerance = 1e-12 * bounds.iter().fold(0.0, |largest: f64, bound| largest.max(bound.abs()));
    let is_outside = |[x, y]: [f64; 2]| {
        !(left - edge_tolerance..=right + edge_tolerance).contains(&x) || !(bottom - edge_tolerance..=top + edge_tolerance).contains(&y)
    };
    match FloorPlan::new(walls.clone(), bounds) {
        Ok(plan) => {
            assert!(are_valid_bounds && !walls.iter().any(|wall| is_outside(wall.from) || is_outside(wall.to)));
            Some(plan)
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains("; allowed is "), "{message}");
            match error {
                FloorPlanError::BadBounds(refused_bounds) => {
                    assert!(!are_valid_bounds, "{message}");
                    super::laws::assert_same_numbers(&message, &refused_bounds, &bounds);
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
pub fn random_pose(plan: &FloorPlan, input: &mut Input) -> SE2 {
    let [left, bottom, right, top] = plan.bounds();
    let [x, y] = [[left, right], [bottom, top]].map(|[low, high]| {
        let fraction = f64::from(u16::from_le_bytes(input.next_bytes())) / 65_535.0;
        low + (high - low) * fraction
    });
    SE2::new(x, y, input.number_within(-1e6..=1e6))
}

/// Asserts that the verdicts on an arc and on its end are those of a loop over all walls.
pub fn assert_verdict(plan: &FloorPlan, input: &mut Input) {
    let start = random_pose(plan, input);
    let length = input.number_within(-1e12..=1e12);
    let turn = input.number_within(-1e12..=1e12);
    let clearance = input.number_within(0.0..=10.0);
    let arc = Arc { start, length, turn };
    let tolerance = rounding_error(plan, &arc, clearance);
    let depth_inside = |x: f64, y: f64| depth_inside(plan, [x, y]);

    // Upper bound of the distance of the path from the edge of the map, from some points of the path.
    // `min_depth - half_chord` is a lower bound.
    const CHORD_COUNT: u32 = 16;
    let min_depth = (0..=CHORD_COUNT).fold(f64::INFINITY, |smallest, i| {
        let f = f64::from(i) / f64::from(CHORD_COUNT);
        let point_on_path = Arc { length: f * length, turn: f * turn, ..arc }.end();
        smallest.min(depth_inside(point_on_path.x(), point_on_path.y()))
    });
    // A point of the arc is at most half the length between two tested points from one of them, and at most the circle's diameter.
    let circle_diameter = if turn == 0.0 { f64::INFINITY } else { 2.0 * (length / turn).abs() };
    let half_chord = (0.5 * length.abs() / f64::from(CHORD_COUNT)).min(circle_diameter);
    let is_in_obstacle = plan.grid().is_some_and(|grid| grid.is_blocked_at([start.x(), start.y()]));
    let wall_distance = plan.walls().iter().map(|wall| wall.distance_to_arc(&arc)).fold(f64::INFINITY, f64::min);

    let is_free = plan.test_arc(&arc, clearance).free;
    let situation = format!("{arc:?} with {clearance} to spare: walls {wall_distance}, edge {min_depth}");
    if is_free {
        assert!(wall_distance > clearance - tolerance && min_depth >= -tolerance && !is_in_obstacle, "through a wall: {situation}");
    } else {
        let is_clear = wall_distance > clearance + tolerance && min_depth - half_chord > tolerance && !is_in_obstacle;
        assert!(!is_clear, "refused for nothing: {situation}");
    }

    let end = arc.end();
    let point = [end.x(), end.y()];
    let wall_distance = plan.walls().iter().map(|wall| wall.distance_to_point(point)).fold(f64::INFINITY, f64::min);
    let is_free = plan.test_point(point, clearance).free;
    let is_in_obstacle = plan.grid().is_some_and(|grid| grid.is_blocked_at(point));
    let depth_of_end = depth_inside(point[0], point[1]);
    if is_free {
        assert!(wall_distance > clearance - tolerance && depth_of_end >= -tolerance && !is_in_obstacle, "{point:?}, {clearance}");
    } else {
        let is_clear = wall_distance > clearance + tolerance && depth_of_end > tolerance && !is_in_obstacle;
        assert!(!is_clear, "refused for nothing: {point:?}, {clearance}");
    }
}

/// Returns the distance (m) of a point inside the map from its edge; negative outside.
fn depth_inside(plan: &FloorPlan, [x, y]: [f64; 2]) -> f64 {
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
    let largest_coordinate = plan.bounds().iter().fold(0.0, |largest: f64, bound| largest.max(bound.abs()));
    1e-12 * (largest_coordinate + arc.length.abs() + clearance)
}
