//! Free start pose for a robot that enters a map.

use super::floor_plan::FloorPlan;
use super::occupancy::{Image, OccupancyGrid, PixelClassifier};
use crate::geom::se2::SE2;
use std::borrow::Cow;
use std::f64::consts::TAU;

const HEADING_COUNT: u32 = 72;

/// Number of cells along the longer side of the grid to which a floor plan of walls is converted.
const CELLS_ALONG_LONGER_SIDE: f64 = 256.0;

impl FloorPlan {
    /// Returns a free pose for a disc of radius `clearance` (m): the centre of the largest square that is known to be free, with the
    /// heading of the longest free path. If the disc does not fit there, the first cell where it fits is taken; None if it fits nowhere.
    pub fn find_free_pose(&self, clearance: f64) -> Option<SE2> {
        let occupancy_grid = self.grid().map_or_else(|| Cow::Owned(self.rasterize()), Cow::Borrowed);
        let does_robot_fit = |tested_point: &[f64; 2]| self.test_point(*tested_point, clearance).is_free;
        let [column_count, row_count] = occupancy_grid.size();
        let middle_coordinates = (0..row_count).flat_map(|cell_row| {
            (0..column_count).map(move |cell_column| [cell_column as f64 + 0.5, cell_row as f64 + 0.5])
        });
        let mut cell_middles = middle_coordinates.map(|grid_point| occupancy_grid.world_point(grid_point));
        let square_middle = middle_of_largest_free_square(&occupancy_grid)
            .map(|grid_point| occupancy_grid.world_point(grid_point));
        let [x, y] = square_middle.filter(does_robot_fit).or_else(|| cell_middles.find(does_robot_fit))?;
        Some(SE2::new(x, y, heading_of_longest_path(&occupancy_grid, [x, y], does_robot_fit)))
    }

    /// Converts a floor plan of walls to a grid. Cells that may touch a wall are occupied.
    fn rasterize(&self) -> OccupancyGrid {
        let [min_x, min_y, max_x, max_y] = self.bounds();
        let (map_width, map_height) = (max_x - min_x, max_y - min_y);
        let cell_side = (map_width.max(map_height) / CELLS_ALONG_LONGER_SIDE).min(map_width).min(map_height);
        let [column_count, row_count] =
            [map_width, map_height].map(|side_length| (side_length / cell_side) as usize);
        let is_free = |i: usize| {
            let [cell_column, cell_row] =
                [i % column_count, row_count - 1 - i / column_count].map(|index| index as f64 + 0.5);
            let cell_middle = [min_x + cell_column * cell_side, min_y + cell_row * cell_side];
            self.distance_field().lower_bound(cell_middle) > 0.75 * cell_side
        };
        let brightness_values =
            (0..column_count * row_count).map(|i| f32::from(u8::from(is_free(i)))).collect();
        let map_image = Image { width: column_count, height: row_count, pixels: brightness_values };
        OccupancyGrid::new(&map_image, &PixelClassifier::default(), cell_side, SE2::new(min_x, min_y, 0.0))
    }
}

/// Returns the middle of the largest square of free cells, in cells from the lower left corner; None if no cell is free. Of equally large
/// squares, it is the one whose upper right corner comes first, row by row.
fn middle_of_largest_free_square(occupancy_grid: &OccupancyGrid) -> Option<[f64; 2]> {
    let ([column_count, rows], mut largest_side_so_far, mut square_middle) = (occupancy_grid.size(), 0, None);
    // For each column: side length (cells) of the largest free square whose upper right corner is the cell of the previous row.
    let mut square_sides = vec![0u32; column_count];
    for cell_row in 0..rows {
        let [mut side_at_left, mut side_at_lower_left] = [0, 0];
        for (cell_column, square_side) in square_sides.iter_mut().enumerate() {
            let side_below = *square_side;
            let is_free = occupancy_grid.is_known_free(cell_column, cell_row);
            *square_side = if is_free { 1 + side_below.min(side_at_left).min(side_at_lower_left) } else { 0 };
            (side_at_left, side_at_lower_left) = (*square_side, side_below);
            if *square_side > largest_side_so_far {
                largest_side_so_far = *square_side;
                let half_side = 0.5 * f64::from(largest_side_so_far);
                square_middle = Some([cell_column, cell_row].map(|index| index as f64 + 1.0 - half_side));
            }
        }
    }
    square_middle
}

fn heading_of_longest_path(
    occupancy_grid: &OccupancyGrid,
    [x, y]: [f64; 2],
    does_robot_fit: impl Fn(&[f64; 2]) -> bool,
) -> f64 {
    let is_free = |point: &[f64; 2]| {
        let [cell_column, cell_row] = occupancy_grid.cell_coordinates(*point);
        cell_column >= 0.0
            && cell_row >= 0.0
            && occupancy_grid.is_known_free(cell_column as usize, cell_row as usize)
    };
    let (mut max_steps, mut best_heading) = (0, 0.0);
    for i in 0..HEADING_COUNT {
        let tried_heading = TAU * f64::from(i) / f64::from(HEADING_COUNT);
        let (sin, cos) = libm::sincos(tried_heading);
        let free_steps = (1..)
            .map(|half_cell_steps| 0.5 * occupancy_grid.resolution() * f64::from(half_cell_steps))
            .map(|tested_distance| [x + tested_distance * cos, y + tested_distance * sin])
            .take_while(|point| is_free(point) && does_robot_fit(point))
            .count();
        if free_steps > max_steps {
            (max_steps, best_heading) = (free_steps, tried_heading);
        }
    }
    best_heading
}
