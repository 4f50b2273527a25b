//! Occupancy grids: exact distances to cells, outlines, unknown cells, and free poses.

use crate::common::{sample_uniform, seeded_rng};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::map::{
    Cell, FloorPlan, FloorPlanError, Image, OccupancyGrid, Pixel, PixelClassifier, UnknownCells,
};
use rand::Rng;
use std::f64::consts::{FRAC_PI_2, PI};

const BLACK_PIXEL: Pixel = Pixel { brightness: 0.0, opacity: 1.0 };
const WHITE_PIXEL: Pixel = Pixel { brightness: 1.0, opacity: 1.0 };

struct DrawnGrid {
    width: usize,
    height: usize,
    /// Cells row by row from the top, as in the image.
    occupied: Vec<bool>,
    resolution: f64,
    /// x, y and yaw of the lower left corner.
    origin: [f64; 3],
}

impl DrawnGrid {
    fn new_random(rng: &mut impl Rng) -> Self {
        let (width, height) = (1 + (rng.next_u32() % 12) as usize, 1 + (rng.next_u32() % 12) as usize);
        let occupied_fraction = sample_uniform(rng, 0.05, 0.9);
        let occupied =
            (0..width * height).map(|_| sample_uniform(rng, 0.0, 1.0) < occupied_fraction).collect();
        let grid_yaw =
            if rng.next_u32().is_multiple_of(3) { FRAC_PI_2 } else { sample_uniform(rng, -PI, PI) };
        let origin = [sample_uniform(rng, -50.0, 50.0), sample_uniform(rng, -50.0, 50.0), grid_yaw];
        Self { width, height, occupied, resolution: sample_uniform(rng, 0.02, 0.5), origin }
    }

    fn create_grid(&self) -> OccupancyGrid {
        let cell_pixels =
            self.occupied.iter().map(|occupied| if *occupied { BLACK_PIXEL } else { WHITE_PIXEL }).collect();
        let image = Image { width: self.width, height: self.height, pixels: cell_pixels };
        let [x, y, grid_yaw] = self.origin;
        OccupancyGrid::new(&image, &PixelClassifier::default(), self.resolution, SE2::new(x, y, grid_yaw))
    }

    /// Returns the map position (m) of a point whose coordinates are given in cells, along the axes of the grid.
    fn map_position_of(&self, column_coordinate: f64, row_coordinate: f64) -> [f64; 2] {
        let ([x, y, grid_yaw], (u, v)) =
            (self.origin, (column_coordinate * self.resolution, row_coordinate * self.resolution));
        [x + u * grid_yaw.cos() - v * grid_yaw.sin(), y + u * grid_yaw.sin() + v * grid_yaw.cos()]
    }

    /// Returns the distance (m) from a point to the nearest occupied cell, which is 0 inside of a cell.
    fn distance_to_occupied_cell(&self, [x, y]: [f64; 2]) -> f64 {
        let ([origin_x, origin_y, grid_yaw], cell_side) = (self.origin, self.resolution);
        let u = (x - origin_x) * grid_yaw.cos() + (y - origin_y) * grid_yaw.sin();
        let v = (y - origin_y) * grid_yaw.cos() - (x - origin_x) * grid_yaw.sin();
        let axis_distance_to_cell = |grid_coordinate: f64, cell_index: usize| {
            let cell_start = cell_index as f64 * cell_side;
            (cell_start - grid_coordinate).max(grid_coordinate - cell_start - cell_side).max(0.0)
        };
        let occupied_indices = (0..self.occupied.len()).filter(|i| self.occupied[*i]);
        occupied_indices
            .map(|i| {
                axis_distance_to_cell(u, i % self.width)
                    .hypot(axis_distance_to_cell(v, self.height - 1 - i / self.width))
            })
            .fold(f64::INFINITY, f64::min)
    }
}

#[test]
fn distances_to_walls_equal_distances_to_cells() {
    let mut rng = seeded_rng(9900);
    let (mut inside_count, mut outside_count) = (0, 0);
    for _ in 0..100 {
        let grid_cells = DrawnGrid::new_random(&mut rng);
        let plan = FloorPlan::from_grid(grid_cells.create_grid()).expect("a small grid");
        let [map_left, map_bottom, map_right, map_top] = plan.bounds();
        for _ in 0..50 {
            let column_coordinate = sample_uniform(&mut rng, 0.0, grid_cells.width as f64);
            let row_coordinate = sample_uniform(&mut rng, 0.0, grid_cells.height as f64);
            let point = grid_cells.map_position_of(column_coordinate, row_coordinate);
            assert!((map_left..=map_right).contains(&point[0]) && (map_bottom..=map_top).contains(&point[1]));
            let cell_distance = grid_cells.distance_to_occupied_cell(point);
            if cell_distance == 0.0 {
                assert!(
                    grid_cells.create_grid().is_blocked_at(point) && !plan.test_point(point, 0.0).is_free,
                    "inside a cell"
                );
                inside_count += 1;
                continue;
            }
            let wall_distance =
                plan.walls().iter().map(|wall| wall.distance_to_point(point)).fold(f64::INFINITY, f64::min);
            // Fifty metres from the origin the corners are rounded by 1e-14 m.
            assert!(
                wall_distance == cell_distance || (wall_distance - cell_distance).abs() < 1e-13,
                "{wall_distance}, {cell_distance}"
            );
            let robot_radius = sample_uniform(&mut rng, 0.0, 1.0);
            if (robot_radius - cell_distance).abs() > 1e-12 {
                assert_eq!(plan.test_point(point, robot_radius).is_free, cell_distance > robot_radius);
            }
            outside_count += 1;
        }
    }
    assert!(inside_count > 1000 && outside_count > 1000, "{inside_count} {outside_count}");
}

/// Sides of neighbouring cells on one line form one wall. Between two occupied cells there is no wall, and walls meet at corners.
#[test]
fn sides_of_neighbouring_cells_form_one_wall() {
    let drawn_rows = ["##.", "#..", "..#"];
    let occupied = drawn_rows
        .iter()
        .flat_map(|drawn_row| drawn_row.chars().map(|drawn_cell| drawn_cell == '#'))
        .collect();
    let grid_cells = DrawnGrid { width: 3, height: 3, occupied, resolution: 0.5, origin: [1.0, 2.0, 0.0] };
    let plan = FloorPlan::from_grid(grid_cells.create_grid()).expect("a small grid");
    let mut walls: Vec<[f64; 4]> =
        plan.walls().iter().map(|wall| [wall.from[0], wall.from[1], wall.to[0], wall.to[1]]).collect();
    walls.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    let expected_bound = [
        [1.0, 2.5, 1.0, 3.5],
        [1.0, 2.5, 1.5, 2.5],
        [1.0, 3.5, 2.0, 3.5],
        [1.5, 2.5, 1.5, 3.0],
        [1.5, 3.0, 2.0, 3.0],
        [2.0, 2.0, 2.0, 2.5],
        [2.0, 2.0, 2.5, 2.0],
        [2.0, 2.5, 2.5, 2.5],
        [2.0, 3.0, 2.0, 3.5],
        [2.5, 2.0, 2.5, 2.5],
    ];
    assert_eq!(walls, expected_bound);
    assert_eq!(plan.bounds(), [1.0, 2.0, 2.5, 3.5]);
    let rotated_cells = DrawnGrid { origin: [1.0, 2.0, FRAC_PI_2], ..grid_cells };
    let map_bounds = FloorPlan::from_grid(rotated_cells.create_grid()).expect("a small grid").bounds();
    for (map_bound, expected_bound) in map_bounds.into_iter().zip([-0.5, 2.0, 1.0, 3.5]) {
        assert!((map_bound - expected_bound).abs() < 1e-15, "{map_bounds:?}");
    }
}

#[test]
fn a_grid_of_too_many_walls_is_refused() {
    let cells_per_side = 320;
    let occupied = (0..cells_per_side * cells_per_side)
        .map(|i| i / cells_per_side % 2 == 0 && i % cells_per_side % 2 == 0)
        .collect();
    let separate_cells = DrawnGrid {
        width: cells_per_side,
        height: cells_per_side,
        occupied,
        resolution: 0.05,
        origin: [0.0; 3],
    };
    let plan_error = FloorPlan::from_grid(separate_cells.create_grid()).err();
    assert_eq!(plan_error, Some(FloorPlanError::TooManySides(20_001)));
    let error_message = plan_error.map(|plan_error| plan_error.to_string()).unwrap_or_default();
    assert_eq!(
        error_message,
        "image has blocked cells with 20001 sides or more; allowed are at most 20000: remove specks or use larger cells"
    );
}

/// The origin of a grid is a field of the map file. The error message names this field.
#[test]
fn a_grid_outside_the_range_of_coordinates_is_refused() {
    let create_grid = |resolution, origin| {
        DrawnGrid { width: 3, height: 2, occupied: vec![false; 6], resolution, origin }.create_grid()
    };
    assert!(FloorPlan::from_grid(create_grid(0.5, [-1e6, 1e6 - 1.0, 0.0])).is_ok());
    for (resolution, origin) in [(0.5, [1e6 - 1.0, 0.0, 0.0]), (4e4, [0.0; 3]), (0.004, [0.0; 3])] {
        let plan_error = FloorPlan::from_grid(create_grid(resolution, origin)).err();
        assert!(matches!(plan_error, Some(FloorPlanError::BadGrid(_))), "{plan_error:?}");
        let refusal_message = plan_error.map(|plan_error| plan_error.to_string()).unwrap_or_default();
        assert!(refusal_message.starts_with("origin has the cells from ["), "{refusal_message}");
    }
}

/// Returns a grid with cells of 10 cm that are drawn as `#` (occupied), `?` (unknown) and `.` (free). The first row is at the
/// top.
fn parse_drawn_grid(drawn_rows: &[&str], unknown_cells: UnknownCells) -> OccupancyGrid {
    let shade_of_cell = |drawn_cell| match drawn_cell {
        '#' => 0.0,
        '?' => 0.5,
        _ => 1.0,
    };
    let cell_pixels = drawn_rows.iter().flat_map(|drawn_row| drawn_row.chars()).map(shade_of_cell).collect();
    let image = Image::<f32> { width: drawn_rows[0].len(), height: drawn_rows.len(), pixels: cell_pixels };
    OccupancyGrid::new(&image, &PixelClassifier::default(), 0.1, SE2::identity()).with_unknown(unknown_cells)
}

/// The heading is that of the longest free straight path. Unknown cells do not count as free.
#[test]
fn the_free_pose_is_in_the_largest_free_square() {
    let drawn_rows = [
        "????????????????",
        "????????????????",
        "##########??????",
        "#........#??????",
        "#........#??????",
        "#...............",
        "#........#??????",
        "##########??????",
    ];
    for unknown_cells in [UnknownCells::Free, UnknownCells::Blocked] {
        let plan = FloorPlan::from_grid(parse_drawn_grid(&drawn_rows, unknown_cells)).expect("a small grid");
        let free_pose = plan.find_free_pose(0.1).expect("there is room");
        // The pose is in the middle of the first square of four free cells, and heads through the door.
        assert!((free_pose.x() - 0.3).abs() + (free_pose.y() - 0.3).abs() < 1e-12, "{free_pose:?}");
        assert!(plan.test_point([free_pose.x(), free_pose.y()], 0.1).is_free);
        let straight_arc = Arc { start: free_pose, length: 0.5, turn: 0.0 };
        assert!(plan.test_arc(&straight_arc, 0.0).is_free && free_pose.theta().abs() < 0.5, "{free_pose:?}");
    }
    let find_free_pose_in_rows = |drawn_rows: [&str; 3], unknown_cells, robot_radius| {
        let plan = FloorPlan::from_grid(parse_drawn_grid(&drawn_rows, unknown_cells)).expect("a small grid");
        plan.find_free_pose(robot_radius)
    };
    let free_pose = find_free_pose_in_rows(["###", "#.#", "###"], UnknownCells::Free, 0.0499);
    assert_eq!(free_pose.expect("there is room").theta(), 0.0);
    // All cells are unknown, and count as free or blocked as the setting says.
    let free_pose = find_free_pose_in_rows(["???"; 3], UnknownCells::Free, 0.1).expect("there is room");
    assert!((free_pose.x() - 0.05).abs() + (free_pose.y() - 0.05).abs() < 1e-12, "the first: {free_pose:?}");
    let blocked_grid = parse_drawn_grid(&["???"; 3], UnknownCells::Blocked);
    assert!(blocked_grid.cells().all(|cell| cell == Cell::Unknown), "the cells themselves are unchanged");
    assert_eq!(find_free_pose_in_rows(["???"; 3], UnknownCells::Blocked, 0.1), None);
}
