//! Floor plans with any walls, and collision verdicts on arcs and points in them.

use super::input::Input;
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, FloorPlanError};

/// Maximum numbers of walls in a plan and of tested arcs. The time for the distance field grows with the number of walls.
const MAX_WALLS: usize = 4;
const MAX_ARCS: usize = 3;

pub fn run(bytes: &[u8]) {
    let mut input = Input(bytes);
    let Some(plan) = read_plan(&mut input) else { return };
    for _ in 0..MAX_ARCS {
        assert_collision_verdicts(&plan, &mut input);
        if input.is_empty() {
            break;
        }
    }
}

/// Reads a plan of a few walls. Returns None if the plan is refused.
pub fn read_plan(input: &mut Input) -> Option<FloorPlan> {
    let bounds: [f64; 4] = if input.next_bool() {
        std::array::from_fn(|_| input.next_number())
    } else {
        let [left, bottom] = [0, 1].map(|_| input.draw_number_within(-1e6..=1e6));
        let [width, height] = [0, 1].map(|_| input.draw_number_within(0.01..=1e5));
        [left, bottom, left + width, bottom + height]
    };
    let [left, bottom, right, top] = bounds;
    let next_coordinate = |input: &mut Input, low: f64, high: f64| {
        let fraction = f64::from(input.next_byte()) / 255.0;
        let number_inside = low + (high - low) * fraction;
        if input.next_below(16) == 0 { input.next_number() } else { number_inside }
    };
    let wall_count = input.next_below(1 + MAX_WALLS);
    let mut walls: Vec<Segment> = Vec::new();
    for i in 0..wall_count {
        let earlier_wall = walls.get(i.wrapping_sub(1)).copied();
        let mut next_point = || [next_coordinate(input, left, right), next_coordinate(input, bottom, top)];
        let wall_start = next_point();
        let wall_end = next_point();
        // Some walls equal the previous wall, or start at its end.
        walls.push(match (input.next_below(8), earlier_wall) {
            (0, Some(wall)) => wall,
            (1, Some(wall)) => Segment { from: wall.to, to: wall_end },
            (2, _) => Segment { from: wall_start, to: wall_start },
            (3, _) => Segment { from: wall_start, to: [wall_end[0], wall_start[1]] },
            (4, _) => Segment { from: wall_start, to: [wall_start[0], wall_end[1]] },
            _ => Segment { from: wall_start, to: wall_end },
        });
    }
    let has_valid_bounds = bounds.iter().all(|bound| bound.abs() <= 1e6)
        && [right - left, top - bottom].iter().all(|side| (0.01..=1e5).contains(side));
    // The edge has a tolerance for rounding.
    let edge_tolerance = 1e-12 * bounds.iter().fold(0.0, |largest: f64, bound| largest.max(bound.abs()));
    let is_outside = |[x, y]: [f64; 2]| {
        !(left - edge_tolerance..=right + edge_tolerance).contains(&x) || !(bottom - edge_tolerance..=top + edge_tolerance).contains(&y)
    };
    match FloorPlan::new(walls.clone(), bounds) {
        Ok(plan) => {
            assert!(has_valid_bounds && !walls.iter().any(|wall| is_outside(wall.from) || is_outside(wall.to)));
            Some(plan)
        }
        Err(error) => {
            let message = error.to_string();
            assert!(message.contains("; allowed is "), "{message}");
            match error {
                FloorPlanError::BadBounds(refused_bounds) => {
                    assert!(!has_valid_bounds, "{message}");
                    super::assertions::assert_same_numbers(&message, &refused_bounds, &bounds);
                }
                FloorPlanError::BadWall { index, end } => {
                    assert!(index < wall_count, "{message}");
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
    SE2::new(x, y, input.draw_number_within(-1e6..=1e6))
}

/// Asserts that the verdicts on an arc and on its end are those of a loop over all walls.
pub fn assert_collision_verdicts(plan: &FloorPlan, input: &mut Input) {
    let start_pose = random_pose(plan, input);
    let length = input.draw_number_within(-1e12..=1e12);
    let turn = input.draw_number_within(-1e12..=1e12);
    let clearance = input.draw_number_within(0.0..=10.0);
    let arc = Arc { start: start_pose, length, turn };
    let tolerance = rounding_error(plan, &arc, clearance);
    let depth_inside = |x: f64, y: f64| depth_inside(plan, [x, y]);

    // Upper bound of the distance of the path from the edge of the map, computed at some points of the path.
    // `min_depth - max_distance_to_tested_point` is a lower bound.
    const INTERVAL_COUNT: u32 = 16;
    let min_depth = (0..=INTERVAL_COUNT).fold(f64::INFINITY, |smallest, i| {
        let f = f64::from(i) / f64::from(INTERVAL_COUNT);
        let point_on_path = Arc { length: f * length, turn: f * turn, ..arc }.end();
        smallest.min(depth_inside(point_on_path.x(), point_on_path.y()))
    });
    // Upper bound of the distance of any point of the arc from the nearest tested point.
    let circle_diameter = if turn == 0.0 { f64::INFINITY } else { 2.0 * (length / turn).abs() };
    let max_distance_to_tested_point = (0.5 * length.abs() / f64::from(INTERVAL_COUNT)).min(circle_diameter);
    let is_in_obstacle = plan.grid().is_some_and(|grid| grid.is_blocked_at([start_pose.x(), start_pose.y()]));
    let wall_distance = plan.walls().iter().map(|wall| wall.distance_to_arc(&arc)).fold(f64::INFINITY, f64::min);

    let is_free = plan.test_arc(&arc, clearance).free;
    let failure_description = format!("{arc:?} with {clearance} to spare: walls {wall_distance}, edge {min_depth}");
    if is_free {
        assert!(wall_distance > clearance - tolerance && min_depth >= -tolerance && !is_in_obstacle, "through a wall: {failure_description}");
    } else {
        let is_clear = wall_distance > clearance + tolerance && min_depth - max_distance_to_tested_point > tolerance && !is_in_obstacle;
        assert!(!is_clear, "refused for nothing: {failure_description}");
    }

    let end_pose = arc.end();
    let end_point = [end_pose.x(), end_pose.y()];
    let wall_distance = plan.walls().iter().map(|wall| wall.distance_to_point(end_point)).fold(f64::INFINITY, f64::min);
    let is_free = plan.test_point(end_point, clearance).free;
    let is_in_obstacle = plan.grid().is_some_and(|grid| grid.is_blocked_at(end_point));
    let depth_of_end = depth_inside(end_point[0], end_point[1]);
    if is_free {
        assert!(wall_distance > clearance - tolerance && depth_of_end >= -tolerance && !is_in_obstacle, "{end_point:?}, {clearance}");
    } else {
        let is_clear = wall_distance > clearance + tolerance && depth_of_end > tolerance && !is_in_obstacle;
        assert!(!is_clear, "refused for nothing: {end_point:?}, {clearance}");
    }
}

/// Returns the distance (m) of a point from the edge of the map, which is negative outside of the map.
fn depth_inside(plan: &FloorPlan, [x, y]: [f64; 2]) -> f64 {
    let ([x, y], [left, bottom, right, top]) = match plan.grid() {
        None => ([x, y], plan.bounds()),
        Some(grid) => {
            let point_in_grid = grid.origin().inverse() * SE2::new(x, y, 0.0);
            let [width, height] = grid.size().map(|count| count as f64 * grid.resolution());
            ([point_in_grid.x(), point_in_grid.y()], [0.0, 0.0, width, height])
        }
    };
    (x - left).min(right - x).min(y - bottom).min(top - y)
}

/// Returns the rounding tolerance (m) that `FloorPlan` has at the edge of a map: some thousand units in the last place of
/// the largest number.
fn rounding_error(plan: &FloorPlan, arc: &Arc, clearance: f64) -> f64 {
    let largest_coordinate = plan.bounds().iter().fold(0.0, |largest: f64, bound| largest.max(bound.abs()));
    1e-12 * (largest_coordinate + arc.length.abs() + clearance)
}
