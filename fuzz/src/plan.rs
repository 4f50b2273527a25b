//! Fuzz target of floor plans: arbitrary walls, and collision verdicts on arcs and points.

use super::input::InputReader;
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, FloorPlanError};

/// Maximum numbers of walls in a floor plan and of tested arcs. The time for the distance field grows with the number of walls.
const MAX_WALLS: usize = 4;
const MAX_ARCS: usize = 3;

pub fn check_input(input_bytes: &[u8]) {
    let mut fuzz_input = InputReader(input_bytes);
    let Some(floor_plan) = read_floor_plan(&mut fuzz_input) else { return };
    for _ in 0..MAX_ARCS {
        assert_collision_verdicts(&floor_plan, &mut fuzz_input);
        if fuzz_input.is_empty() {
            break;
        }
    }
}

/// Reads a floor plan with a few walls from the fuzz input. Returns None if the plan is refused.
pub fn read_floor_plan(fuzz_input: &mut InputReader) -> Option<FloorPlan> {
    let bounds: [f64; 4] = if fuzz_input.next_bool() {
        std::array::from_fn(|_| fuzz_input.next_number())
    } else {
        let [map_left, map_bottom] = [0, 1].map(|_| fuzz_input.draw_number_within(-1e6..=1e6));
        let [map_width, map_height] = [0, 1].map(|_| fuzz_input.draw_number_within(0.01..=1e5));
        [map_left, map_bottom, map_left + map_width, map_bottom + map_height]
    };
    let [map_left, map_bottom, map_right, map_top] = bounds;
    let read_coordinate = |fuzz_input: &mut InputReader, min_coordinate: f64, max_coordinate: f64| {
        let fraction_of_range = f64::from(fuzz_input.next_byte()) / 255.0;
        let coordinate_within_range = min_coordinate + (max_coordinate - min_coordinate) * fraction_of_range;
        if fuzz_input.next_below(16) == 0 { fuzz_input.next_number() } else { coordinate_within_range }
    };
    let wall_count = fuzz_input.next_below(1 + MAX_WALLS);
    let mut walls: Vec<Segment> = Vec::new();
    for i in 0..wall_count {
        let earlier_wall = walls.get(i.wrapping_sub(1)).copied();
        let mut read_point = || [read_coordinate(fuzz_input, map_left, map_right), read_coordinate(fuzz_input, map_bottom, map_top)];
        let wall_start = read_point();
        let wall_end = read_point();
        // Some walls equal the wall before them, or start at its end.
        walls.push(match (fuzz_input.next_below(8), earlier_wall) {
            (0, Some(wall)) => wall,
            (1, Some(wall)) => Segment { from: wall.to, to: wall_end },
            (2, _) => Segment { from: wall_start, to: wall_start },
            (3, _) => Segment { from: wall_start, to: [wall_end[0], wall_start[1]] },
            (4, _) => Segment { from: wall_start, to: [wall_start[0], wall_end[1]] },
            _ => Segment { from: wall_start, to: wall_end },
        });
    }
    let has_valid_bounds = bounds.iter().all(|bound| bound.abs() <= 1e6)
        && [map_right - map_left, map_top - map_bottom].iter().all(|side_length| (0.01..=1e5).contains(side_length));
    // A wall that ends beyond the edge of the map by no more than the rounding error is accepted.
    let edge_tolerance = 1e-12 * bounds.iter().fold(0.0, |max_so_far: f64, bound| max_so_far.max(bound.abs()));
    let is_outside_bounds = |[x, y]: [f64; 2]| {
        !(map_left - edge_tolerance..=map_right + edge_tolerance).contains(&x) || !(map_bottom - edge_tolerance..=map_top + edge_tolerance).contains(&y)
    };
    match FloorPlan::new(walls.clone(), bounds) {
        Ok(floor_plan) => {
            assert!(has_valid_bounds && !walls.iter().any(|wall| is_outside_bounds(wall.from) || is_outside_bounds(wall.to)));
            Some(floor_plan)
        }
        Err(floor_plan_error) => {
            let error_message = floor_plan_error.to_string();
            assert!(error_message.contains("; allowed is "), "{error_message}");
            match floor_plan_error {
                FloorPlanError::BadBounds(refused_bounds) => {
                    assert!(!has_valid_bounds, "{error_message}");
                    super::assertions::assert_same_numbers(&error_message, &refused_bounds, &bounds);
                }
                FloorPlanError::BadWall { wall_index: refused_wall_index, invalid_end: refused_end } => {
                    assert!(refused_wall_index < wall_count, "{error_message}");
                    let [x, y] = refused_end;
                    assert!(!((map_left..=map_right).contains(&x) && (map_bottom..=map_top).contains(&y)), "{error_message}");
                }
                FloorPlanError::TooManyWalls(_)
                | FloorPlanError::BadGrid(_)
                | FloorPlanError::TooManySides(_) => panic!("{error_message}"),
            }
            None
        }
    }
}

/// Returns a random pose, mostly inside the bounds of the floor plan.
pub fn draw_pose(floor_plan: &FloorPlan, fuzz_input: &mut InputReader) -> SE2 {
    let [left, bottom, right, top] = floor_plan.bounds();
    let [x, y] = [[left, right], [bottom, top]].map(|[min_coordinate, max_coordinate]| {
        let fraction_of_range = f64::from(u16::from_le_bytes(fuzz_input.next_bytes())) / 65_535.0;
        min_coordinate + (max_coordinate - min_coordinate) * fraction_of_range
    });
    SE2::new(x, y, fuzz_input.draw_number_within(-1e6..=1e6))
}

/// Asserts that the collision verdicts on an arc and on its end point equal those of a loop over all walls.
pub fn assert_collision_verdicts(floor_plan: &FloorPlan, fuzz_input: &mut InputReader) {
    let start_pose = draw_pose(floor_plan, fuzz_input);
    let arc_length = fuzz_input.draw_number_within(-1e12..=1e12);
    let arc_turn = fuzz_input.draw_number_within(-1e12..=1e12);
    let clearance = fuzz_input.draw_number_within(0.0..=10.0);
    let driven_arc = Arc { start: start_pose, length: arc_length, turn: arc_turn };
    let distance_tolerance = rounding_tolerance_of(floor_plan, &driven_arc, clearance);
    let edge_distance_at = |x: f64, y: f64| signed_distance_from_edge(floor_plan, [x, y]);

    // The smallest distance of the tested points of the path from the edge of the map is an upper bound of the distance of the path. A
    // lower bound is `min_edge_distance - max_distance_to_tested_point`.
    const PATH_INTERVAL_COUNT: u32 = 16;
    let min_edge_distance = (0..=PATH_INTERVAL_COUNT).fold(f64::INFINITY, |min_so_far, i| {
        let path_fraction = f64::from(i) / f64::from(PATH_INTERVAL_COUNT);
        let point_on_path = Arc { length: path_fraction * arc_length, turn: path_fraction * arc_turn, ..driven_arc }.end();
        min_so_far.min(edge_distance_at(point_on_path.x(), point_on_path.y()))
    });
    // Maximum distance of a point of the arc from the nearest tested point.
    let circle_diameter = if arc_turn == 0.0 { f64::INFINITY } else { 2.0 * (arc_length / arc_turn).abs() };
    let max_distance_to_tested_point = (0.5 * arc_length.abs() / f64::from(PATH_INTERVAL_COUNT)).min(circle_diameter);
    let is_in_obstacle = floor_plan.grid().is_some_and(|grid| grid.is_blocked_at([start_pose.x(), start_pose.y()]));
    let min_wall_distance = floor_plan.walls().iter().map(|wall| wall.distance_to_arc(&driven_arc)).fold(f64::INFINITY, f64::min);

    let is_free = floor_plan.test_arc(&driven_arc, clearance).is_free;
    let failure_description = format!("{driven_arc:?} with {clearance} to spare: walls {min_wall_distance}, edge {min_edge_distance}");
    if is_free {
        assert!(min_wall_distance > clearance - distance_tolerance && min_edge_distance >= -distance_tolerance && !is_in_obstacle, "through a wall: {failure_description}");
    } else {
        let is_clearly_free = min_wall_distance > clearance + distance_tolerance && min_edge_distance - max_distance_to_tested_point > distance_tolerance && !is_in_obstacle;
        assert!(!is_clearly_free, "refused for nothing: {failure_description}");
    }

    let end_pose = driven_arc.end();
    let end_point = [end_pose.x(), end_pose.y()];
    let min_wall_distance = floor_plan.walls().iter().map(|wall| wall.distance_to_point(end_point)).fold(f64::INFINITY, f64::min);
    let is_free = floor_plan.test_point(end_point, clearance).is_free;
    let is_in_obstacle = floor_plan.grid().is_some_and(|grid| grid.is_blocked_at(end_point));
    let edge_distance_of_end = edge_distance_at(end_point[0], end_point[1]);
    if is_free {
        assert!(min_wall_distance > clearance - distance_tolerance && edge_distance_of_end >= -distance_tolerance && !is_in_obstacle, "{end_point:?}, {clearance}");
    } else {
        let is_clearly_free = min_wall_distance > clearance + distance_tolerance && edge_distance_of_end > distance_tolerance && !is_in_obstacle;
        assert!(!is_clearly_free, "refused for nothing: {end_point:?}, {clearance}");
    }
}

/// Returns the distance (m) of a point from the edge of the map, which is negative outside of the map.
fn signed_distance_from_edge(floor_plan: &FloorPlan, [x, y]: [f64; 2]) -> f64 {
    let ([x, y], [map_left, map_bottom, map_right, map_top]) = match floor_plan.grid() {
        None => ([x, y], floor_plan.bounds()),
        Some(grid) => {
            let grid_pose = grid.origin().inverse() * SE2::new(x, y, 0.0);
            let [map_width, map_height] = grid.size().map(|cell_count| cell_count as f64 * grid.resolution());
            ([grid_pose.x(), grid_pose.y()], [0.0, 0.0, map_width, map_height])
        }
    };
    (x - map_left).min(map_right - x).min(y - map_bottom).min(map_top - y)
}

/// Returns the rounding tolerance (m) that `FloorPlan` has at the edge of a map: some thousand units in the last place of
/// the largest number.
fn rounding_tolerance_of(floor_plan: &FloorPlan, arc: &Arc, clearance: f64) -> f64 {
    let largest_coordinate = floor_plan.bounds().iter().fold(0.0, |max_so_far: f64, bound| max_so_far.max(bound.abs()));
    1e-12 * (largest_coordinate + arc.length.abs() + clearance)
}
