//! Fuzz target of occupancy grids: arbitrary cells, thresholds, resolution and origin.

use super::input::InputReader;
use super::plan;
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{
    Cell, FloorPlan, FloorPlanError, Image, PixelClassifier, MapMode, OccupancyGrid, Pixel, RESOLUTION_RANGE, UnknownCells,
};
use motion::sim::settings::QUANTITY_RANGE;

/// Maximum number of arcs that are tested on a grid.
const MAX_ARCS: usize = 3;
const MAX_CELLS_PER_SIDE: usize = 3;

pub fn check_input(input_bytes: &[u8]) {
    let mut fuzz_input = InputReader(input_bytes);
    let Some((grid, unknown_cell_rule)) = read_random_grid(&mut fuzz_input) else { return };
    let [column_count, row_count] = grid.size();
    assert_eq!(grid.cells().len(), column_count * row_count);
    // Most inputs make no floor plan, because its distance field takes a hundred times as long as everything else.
    if fuzz_input.next_below(16) != 1 {
        assert_outlines(&grid.with_unknown(unknown_cell_rule), unknown_cell_rule);
        return;
    }
    let floor_plan = match FloorPlan::from_grid(grid.with_unknown(unknown_cell_rule)) {
        Ok(floor_plan) => floor_plan,
        Err(FloorPlanError::BadGrid(_)) => return,
        Err(floor_plan_error) => panic!("{floor_plan_error}"),
    };
    let grid = floor_plan.grid().expect("made of a grid");
    assert_outlines(grid, unknown_cell_rule);
    for (cell_middle, is_cell_obstacle) in find_middles_and_obstacles(grid, unknown_cell_rule) {
        assert_eq!(floor_plan.test_point(cell_middle, 0.0).is_free, !is_cell_obstacle, "{cell_middle:?} in {grid:?}");
    }
    for _ in 0..MAX_ARCS {
        plan::assert_collision_verdicts(&floor_plan, &mut fuzz_input);
        if fuzz_input.is_empty() {
            break;
        }
    }
}

/// Returns the middle of each cell of the grid, and true if the cell is an obstacle. The list is empty if the coordinates are too large to
/// distinguish cells.
fn find_middles_and_obstacles(grid: &OccupancyGrid, unknown_cell_rule: UnknownCells) -> Vec<([f64; 2], bool)> {
    let ([column_count, row_count], grid_origin, cell_side) = (grid.size(), grid.origin(), grid.resolution());
    let largest_coordinate = grid_origin.x().abs().max(grid_origin.y().abs()) + (column_count + row_count) as f64 * cell_side;
    if cell_side <= 1e3 * f64::EPSILON * largest_coordinate {
        return Vec::new();
    }
    let is_blocking =
        |cell: Cell| cell == Cell::Occupied || (cell == Cell::Unknown && unknown_cell_rule == UnknownCells::Blocked);
    let indexed_cells = grid.cells().enumerate();
    let middle_of_cell = |i: usize| {
        let [u, v] = [i % column_count, i / column_count].map(|cell_index| (cell_index as f64 + 0.5) * cell_side);
        let middle_pose = grid_origin * SE2::new(u, v, 0.0);
        [middle_pose.x(), middle_pose.y()]
    };
    indexed_cells.map(|(i, cell)| (middle_of_cell(i), is_blocking(cell))).collect()
}

/// Asserts that the grid finds the middle of each cell in this cell. Asserts that the total length of the outlines equals the total length
/// of the sides between obstacles and other cells.
fn assert_outlines(grid: &OccupancyGrid, unknown_cell_rule: UnknownCells) {
    let middles_and_obstacles = find_middles_and_obstacles(grid, unknown_cell_rule);
    for (cell_middle, is_obstacle) in &middles_and_obstacles {
        assert_eq!(grid.is_blocked_at(*cell_middle), *is_obstacle, "{cell_middle:?} in {grid:?}");
    }
    let [column_count, row_count] = grid.size();
    let is_obstacle_at = |column_index: usize, row_index: usize| {
        (column_index < column_count && row_index < row_count)
            .then(|| middles_and_obstacles.get(row_index * column_count + column_index))
            .flatten()
            .is_some_and(|middle_and_obstacle| middle_and_obstacle.1)
    };
    let mut obstacle_side_count = 0;
    for row in 0..=row_count {
        for column in 0..=column_count {
            let is_cell_obstacle = is_obstacle_at(column, row);
            obstacle_side_count += usize::from(is_cell_obstacle != is_obstacle_at(column.wrapping_sub(1), row));
            obstacle_side_count += usize::from(is_cell_obstacle != is_obstacle_at(column, row.wrapping_sub(1)));
        }
    }
    let wall_outlines = grid.outlines(usize::MAX).expect("no limit");
    let total_outline_length: f64 = wall_outlines.iter().map(wall_length_of).sum();
    if !middles_and_obstacles.is_empty() {
        assert!((total_outline_length / grid.resolution() - obstacle_side_count as f64).abs() < 1e-3 * (1 + obstacle_side_count) as f64, "{grid:?}");
    }
}

fn wall_length_of(wall: &Segment) -> f64 {
    (wall.to[0] - wall.from[0]).hypot(wall.to[1] - wall.from[1])
}

/// Reads a grid of a few cells, and the setting for its unknown cells.
pub fn read_random_grid(fuzz_input: &mut InputReader) -> Option<(OccupancyGrid, UnknownCells)> {
    let resolution = fuzz_input.draw_number_near(&RESOLUTION_RANGE);
    let [x, y, yaw] = [0; 3].map(|_| fuzz_input.draw_number_near(&QUANTITY_RANGE));
    if !RESOLUTION_RANGE.contains(&resolution) || ![x, y, yaw].iter().all(|origin_coordinate| QUANTITY_RANGE.contains(origin_coordinate)) {
        return None;
    }
    let [image_width, image_height] = [0; 2].map(|_| 1 + fuzz_input.next_below(MAX_CELLS_PER_SIDE));
    let map_mode = fuzz_input.choose_one(&[MapMode::Trinary, MapMode::Scale, MapMode::Raw]);
    let is_negated = fuzz_input.next_bool();
    let [first_threshold, second_threshold] = [0; 2].map(|_| f64::from(fuzz_input.next_byte()) / 255.0);
    let pixel_classifier = PixelClassifier { mode: map_mode, negate: is_negated, occupied_thresh: first_threshold.max(second_threshold), free_thresh: first_threshold.min(second_threshold) };
    let unknown_cell_rule = fuzz_input.choose_one(&[UnknownCells::Free, UnknownCells::Blocked]);
    let is_opaque = fuzz_input.next_bool();
    let pixels: Vec<Pixel> = (0..image_width * image_height)
        .map(|_| Pixel {
            brightness: f32::from(fuzz_input.next_byte()) / 255.0,
            opacity: if is_opaque { 1.0 } else { f32::from(fuzz_input.next_byte()) / 255.0 },
        })
        .collect();
    for pixel in &pixels {
        assert_cell_of_pixel(&pixel_classifier, *pixel);
    }
    let image = Image { width: image_width, height: image_height, pixels };
    Some((OccupancyGrid::new(&image, &pixel_classifier, resolution, SE2::new(x, y, yaw)), unknown_cell_rule))
}

/// Checks the cell of a pixel against the documentation of `map_server`. If the pixel is within rounding of a threshold, both states of the
/// cell are right.
fn assert_cell_of_pixel(pixel_classifier: &PixelClassifier, pixel: Pixel) {
    let PixelClassifier { mode: map_mode, negate: is_negated, occupied_thresh, free_thresh } = *pixel_classifier;
    let pixel_shade = f64::from(pixel.brightness);
    let occupancy = if is_negated { pixel_shade } else { 1.0 - pixel_shade };
    let grey_value = (255.0 * pixel_shade).round();
    let is_near_threshold = |threshold: f64| (occupancy - threshold).abs() < 2.0 * f64::from(f32::EPSILON);
    let expected_cell = match map_mode {
        MapMode::Raw if grey_value == 100.0 => Cell::Occupied,
        MapMode::Raw if grey_value > 100.0 => Cell::Unknown,
        MapMode::Raw => Cell::Free,
        MapMode::Scale if pixel.opacity < 1.0 => Cell::Unknown,
        _ if is_near_threshold(occupied_thresh) || is_near_threshold(free_thresh) => return,
        _ if occupancy > occupied_thresh => Cell::Occupied,
        MapMode::Trinary if occupancy > free_thresh => Cell::Unknown,
        _ => Cell::Free,
    };
    assert_eq!(pixel_classifier.classify_pixel(pixel), expected_cell, "{pixel_classifier:?} of {pixel:?}");
}
