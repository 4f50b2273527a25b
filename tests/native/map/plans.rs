//! Floor plans: validity, the apartment, and collision tests that skip no wall.

use crate::common::{sample_signed_log_uniform, sample_uniform, seeded_rng};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{FloorPlan, FloorPlanError, Image, OccupancyGrid, Pixel, PixelClassifier};
use rand::Rng;
use std::f64::consts::{PI, TAU};

const ROOM_BOUNDS: [f64; 4] = [0.0, 0.0, 10.0, 10.0];

fn new_wall(start_x: f64, start_y: f64, end_x: f64, end_y: f64) -> Segment {
    Segment { from: [start_x, start_y], to: [end_x, end_y] }
}

fn sample_point([min_x, min_y, max_x, max_y]: [f64; 4], rng: &mut impl Rng) -> [f64; 2] {
    [sample_uniform(rng, min_x, max_x), sample_uniform(rng, min_y, max_y)]
}

fn sample_arc_from(start_position: [f64; 2], rng: &mut impl Rng) -> Arc {
    let turn = match rng.next_u32() % 3 {
        0 => sample_signed_log_uniform(rng, 1e-18, 1e-3),
        1 => 0.0,
        _ => sample_uniform(rng, -TAU, TAU),
    };
    let length = sample_uniform(rng, -3.0, 3.0);
    Arc { start: SE2::new(start_position[0], start_position[1], sample_uniform(rng, -PI, PI)), length, turn }
}

/// Returns walls whose ends differ by at most `max_extent` m in x and in y. A third of the walls are parallel to an axis.
fn sample_walls(wall_count: usize, max_extent: f64, bounds: [f64; 4], rng: &mut impl Rng) -> Vec<Segment> {
    let [min_x, min_y, max_x, max_y] = bounds;
    (0..wall_count)
        .map(|_| {
            let start_point = sample_point(bounds, rng);
            let mut end_point = [
                start_point[0] + sample_uniform(rng, -max_extent, max_extent),
                start_point[1] + sample_uniform(rng, -max_extent, max_extent),
            ];
            if rng.next_u32().is_multiple_of(3) {
                let constant_axis = (rng.next_u32() % 2) as usize;
                end_point[constant_axis] = start_point[constant_axis];
            }
            Segment {
                from: start_point,
                to: [end_point[0].clamp(min_x, max_x), end_point[1].clamp(min_y, max_y)],
            }
        })
        .collect()
}

#[test]
fn messages_print_large_and_small_numbers_with_an_exponent() {
    let plan_error = FloorPlan::new(Vec::new(), [-2.5e300, 0.0, 1e-9, 1e6]).expect_err("too far");
    assert!(plan_error.to_string().starts_with("bounds is [-2.5e300, 0, 1e-9, 1000000];"), "{plan_error}");
}

#[test]
fn plans_with_too_many_walls_are_refused() {
    let repeated_wall = new_wall(1.0, 1.0, 9.0, 1.0);
    let floor_plan_error =
        FloorPlan::new(vec![repeated_wall; FloorPlan::MAX_WALLS + 1], ROOM_BOUNDS).expect_err("too many");
    assert_eq!(floor_plan_error, FloorPlanError::TooManyWalls(20_001));
    assert_eq!(floor_plan_error.to_string(), "walls has a length of 20001 or more; allowed is at most 20000");
    for wall_count in [0, 1, 16, 17, FloorPlan::MAX_WALLS] {
        let plan = FloorPlan::new(vec![repeated_wall; wall_count], ROOM_BOUNDS).expect("allowed");
        assert_eq!(plan.walls().len(), wall_count);
        assert_eq!(plan.test_point([5.0, 1.5], 0.51).is_free, wall_count == 0);
        assert!(plan.test_point([5.0, 1.5], 0.49).is_free);
    }
}

/// The floor plans are the apartment, rooms with long slanted walls close together, and a rotated grid. Arcs of all sizes turn by up to two
/// circles, and robots have several sizes.
#[test]
fn collision_results_equal_those_of_a_loop_over_all_walls() {
    let mut rng = seeded_rng(9650);
    let new_diagonal_walls = |wall_count: u32| -> Vec<Segment> {
        let end_coordinates = |wall_offset: f64| (wall_offset.min(10.0), (wall_offset - 10.0).max(0.0));
        let wall_offsets = (0..wall_count).map(|i| 20.0 * (f64::from(i) + 0.5) / f64::from(wall_count));
        wall_offsets
            .map(end_coordinates)
            .map(|(larger_coordinate, smaller_coordinate)| {
                new_wall(smaller_coordinate, larger_coordinate, larger_coordinate, smaller_coordinate)
            })
            .collect()
    };
    let new_pixel = |is_dark: bool| Pixel { brightness: if is_dark { 0.0 } else { 1.0 }, opacity: 1.0 };
    let cell_pixels: Vec<_> = (0..1600).map(|_| new_pixel(rng.next_u32().is_multiple_of(40))).collect();
    let cell_image = Image { width: 40, height: 40, pixels: cell_pixels };
    let grid = OccupancyGrid::new(&cell_image, &PixelClassifier::default(), 0.25, SE2::new(3.0, -2.0, 0.4));
    let new_room_plan = |walls| FloorPlan::new(walls, ROOM_BOUNDS).expect("a valid plan");
    let long_walls = sample_walls(12, 10.0, ROOM_BOUNDS, &mut rng);
    let tested_plans = [
        FloorPlan::apartment(),
        new_room_plan(new_diagonal_walls(20)),
        new_room_plan(new_diagonal_walls(300)),
        new_room_plan(long_walls),
        new_room_plan(vec![new_wall(2.0, 2.0, 9.0, 9.0); 300]),
        FloorPlan::from_grid(grid).expect("a small grid"),
    ];
    for (plan_index, plan) in tested_plans.iter().enumerate() {
        let [min_x, min_y, max_x, max_y] = plan.bounds();
        let corners_of_bounds = [[min_x, min_y], [max_x, min_y], [max_x, max_y], [min_x, max_y]];
        let map_corners = plan.grid().map_or(corners_of_bounds, OccupancyGrid::corners);
        let mut verdict_counts = [0; 3];
        for _ in 0..3_000 {
            let start_point = sample_point(plan.bounds(), &mut rng);
            let length_factor = sample_signed_log_uniform(&mut rng, 1e-3, 1.0);
            let arc = sample_arc_from(start_point, &mut rng);
            let turn = if rng.next_u32().is_multiple_of(3) { 2.0 * arc.turn } else { arc.turn };
            let arc = Arc { length: length_factor * arc.length, turn, ..arc };
            let clearance = [0.0, 0.01, 0.13, 0.4][(rng.next_u32() % 4) as usize];
            let arc_end = [arc.end().x(), arc.end().y()];
            let min_distance_over_walls = |distance_to: &dyn Fn(&Segment) -> f64| {
                plan.walls().iter().map(distance_to).fold(f64::INFINITY, f64::min)
            };
            let distance_to_end = min_distance_over_walls(&|wall| wall.distance_to_point(arc_end));
            let distance_to_arc = min_distance_over_walls(&|wall| wall.distance_to_arc(&arc));
            if (distance_to_end - clearance).abs() < 1e-12 || (distance_to_arc - clearance).abs() < 1e-12 {
                continue;
            }
            let is_point_on_map = |plan_point: [f64; 2]| {
                (0..4).all(|i| {
                    let ([x0, y0], [x1, y1]) = (map_corners[i], map_corners[(i + 1) % 4]);
                    (x1 - x0) * (plan_point[1] - y0) - (y1 - y0) * (plan_point[0] - x0) >= 0.0
                })
            };
            let map_edges = (0..4).map(|i| Segment { from: map_corners[i], to: map_corners[(i + 1) % 4] });
            let crosses_edge =
                map_edges.map(|map_edge| map_edge.distance_to_arc(&arc)).fold(f64::INFINITY, f64::min) == 0.0;
            let is_in_occupied_cell =
                |plan_point| plan.grid().is_some_and(|grid| grid.is_blocked_at(plan_point));
            let is_end_free =
                is_point_on_map(arc_end) && !is_in_occupied_cell(arc_end) && distance_to_end > clearance;
            let is_path_free = is_point_on_map(start_point)
                && !crosses_edge
                && !is_in_occupied_cell(start_point)
                && is_end_free
                && distance_to_arc > clearance;
            assert_eq!(
                plan.test_point(arc_end, clearance).is_free,
                is_end_free,
                "{plan_index}: {arc:?} {clearance}"
            );
            assert_eq!(
                plan.test_arc(&arc, clearance).is_free,
                is_path_free,
                "{plan_index}: {arc:?} {clearance}"
            );
            verdict_counts[usize::from(is_end_free) + usize::from(is_path_free)] += 1;
        }
        assert!(verdict_counts.iter().all(|count| *count > 25), "{plan_index}: {verdict_counts:?}");
    }
}

#[test]
fn touching_a_wall_is_not_free() {
    let plan = FloorPlan::new(vec![new_wall(1.0, 2.0, 9.0, 2.0)], ROOM_BOUNDS).expect("a valid plan");
    assert!(!plan.test_point([5.0, 2.25], 0.25).is_free);
    assert!(plan.test_point([5.0, 2.25], 0.2499).is_free);
    assert!(!plan.test_point([5.0, 2.0], 0.0).is_free, "a point on the wall");
    let parallel_arc = Arc { start: SE2::new(4.0, 2.25, 0.0), length: 2.0, turn: 0.0 };
    assert!(!plan.test_arc(&parallel_arc, 0.25).is_free);
    assert!(plan.test_arc(&parallel_arc, 0.2499).is_free);
    // A half circle leads around the end of the wall. Its middle is 0.25 m from the wall's end. All other points are farther away.
    let half_circle = Arc { start: SE2::new(9.0, 2.25, 0.0), length: -0.25 * PI, turn: PI };
    assert!(!plan.test_arc(&half_circle, 0.0).is_free, "in reverse it goes through the wall");
    let half_circle = Arc { length: 0.25 * PI, turn: -PI, ..half_circle };
    assert!(plan.test_arc(&half_circle, 0.2499).is_free && !plan.test_arc(&half_circle, 0.2501).is_free);
}

#[test]
fn the_free_pose_is_in_the_largest_free_square() {
    let apartment_plan = FloorPlan::apartment();
    for clearance in [0.0, 0.13, 0.5, 1.0] {
        let free_pose = apartment_plan.find_free_pose(clearance).expect("there is room");
        assert!(apartment_plan.test_point([free_pose.x(), free_pose.y()], clearance).is_free);
        // The largest room has a free square of 4 m between the closet and the opposite wall.
        assert!((free_pose.x() - 4.0).abs() < 0.1 && (free_pose.y() - 7.0).abs() < 0.1, "{free_pose:?}");
        let straight_arc = Arc { start: free_pose, length: 2.0, turn: 0.0 };
        assert!(apartment_plan.test_arc(&straight_arc, 0.13).is_free, "{free_pose:?}");
    }
    assert_eq!(apartment_plan.find_free_pose(2.5), None, "no room is that large");
    for bounds in [[-3.0, -2.0, 7.0, 5.0], [3.0, 2.0, 7.0, 5.0]] {
        let empty_plan = FloorPlan::new(vec![], bounds).expect("a valid plan");
        let free_pose = empty_plan.find_free_pose(0.3).expect("there is room");
        let [min_x, min_y, max_x, max_y] = bounds;
        let distances_to_edges =
            [free_pose.x() - min_x, max_x - free_pose.x(), free_pose.y() - min_y, max_y - free_pose.y()];
        assert!(
            distances_to_edges.into_iter().all(|distances_to_edges| distances_to_edges > 1.4),
            "not at the edge: {free_pose:?}"
        );
    }
    let walls = (0..=20).map(|i| new_wall(0.0, 0.5 * f64::from(i), 10.0, 0.5 * f64::from(i))).collect();
    let plan_with_narrow_gaps = FloorPlan::new(walls, ROOM_BOUNDS).expect("a valid plan");
    assert!(plan_with_narrow_gaps.find_free_pose(0.3).is_none(), "walls are half a metre apart everywhere");
}
