//! Approximate distance to the nearest wall from any point of a map.

use super::occupancy::OccupancyGrid;
use super::wall_tree::WallTree;
use crate::geom::lanes::{ROUND_TO_INTEGER, from_lanes};
use std::f64::consts::FRAC_1_SQRT_2;
use wide::f64x4;

/// Grid of square cells over the bounds of a map, each with a lower bound on the distance of its points to the nearest wall. Most collision
/// tests need only this bound, so that their duration hardly depends on the number of walls.
#[derive(Clone, Debug)]
pub(super) struct DistanceField {
    min_corner: [f64; 2],
    cells_per_metre: f64,
    column_count: usize,
    last_indices: [f64; 2],
    /// Half the diagonal of a cell, m: the resolution of the distance field.
    pub cell_radius: f64,
    /// Uncertainty (m) of the distance from the middle of a cell to the nearest wall.
    cell_uncertainty: f64,
    /// Lower bound of each cell, m, row by row from the bottom. It is negative if a wall passes through the cell or its neighbour, −∞
    /// inside an occupied cell of the map, and [`NOT_COMPUTED`] if unknown.
    lower_bounds: Vec<f32>,
}

/// Number of cells for each wall, and minimum and maximum number of cells of a map. With fewer cells, the bounds on distances would decide
/// fewer collision tests; more cells take longer to fill. The apartment's cells have sides of 4 cm and take a millisecond; 2²⁰ cells take 4
/// MB. Fuzzing fills millions of fields, and therefore uses few cells. The number of cells does not change the results of collision tests.
const CELLS_PER_WALL: f64 = MIN_CELLS;
const MIN_CELLS: f64 = if cfg!(fuzzing) { 64.0 } else { 4096.0 };
const MAX_CELLS: f64 = 1_048_576.0;

/// Maximum number of distances to walls, or to nodes of the wall tree, that are computed for a block of cells: a fixed number, plus a
/// number for each cell. If more walls are near, filling the field would take seconds. The lower bound of a cell is then [`NOT_COMPUTED`],
/// and collision tests search the tree.
const MAX_WALLS_PER_BLOCK: usize = 32;
const MAX_WALLS_PER_CELL: usize = 3;

/// Accepted error of the distance from a block of cells to the nearest wall, as a fraction of half the block's diagonal. Walls closer
/// together than this error are measured as one wall. A map whose walls fit into a single leaf of the wall tree is measured exactly.
const MAX_RELATIVE_ERROR: f64 = 0.125;

const NOT_COMPUTED: f32 = f32::MIN;

/// Distance from a block of cells to the nearest wall, in units of half the block's diagonal, beyond which the block is not divided.
const UNDIVIDED_DISTANCE_RATIO: f64 = 8.0;

impl DistanceField {
    /// Fills the field from the walls of a tree within `map_bounds` (minimum x, minimum y, maximum x, maximum y; m). `occupied_grid` is the
    /// grid whose occupied cells the walls outline, if there is one.
    pub fn new(wall_tree: &WallTree, map_bounds: [f64; 4], occupied_grid: Option<&OccupancyGrid>) -> Self {
        let mut field_builder = FieldBuilder::new(wall_tree, map_bounds, occupied_grid);
        let root_candidates =
            if wall_tree.is_leaf(1) { walls_of_node(wall_tree, 1).collect() } else { vec![WallSet::Node(1)] };
        let whole_width =
            field_builder.distance_field.column_count.max(field_builder.row_count).next_power_of_two();
        field_builder.fill_block(&root_candidates, [0, 0], whole_width);
        field_builder.distance_field
    }

    /// Returns a lower bound (m) on the distance from a point inside the bounds to the nearest wall.
    #[inline(always)]
    pub fn lower_bound(&self, [x, y]: [f64; 2]) -> f64 {
        // Rounding can move a point slightly outside the bounds; it then belongs to the nearest cell.
        let cell_column =
            (((x - self.min_corner[0]) * self.cells_per_metre) as u32 as usize).min(self.column_count - 1);
        let cell_row = ((y - self.min_corner[1]) * self.cells_per_metre) as u32 as usize;
        self.lower_bound_of_cell(cell_row * self.column_count + cell_column)
    }

    #[inline(always)]
    fn lower_bound_of_cell(&self, cell_index: usize) -> f64 {
        f64::from(self.lower_bounds.get(cell_index).copied().unwrap_or(NOT_COMPUTED))
    }

    #[inline(always)]
    pub fn lower_bounds(&self, points: &[f64x4; 2]) -> f64x4 {
        let zero_lanes = f64x4::splat(0.0);
        // A point on the border between two cells may be rounded into either cell, because the lower bound of a cell also holds on its
        // border.
        let [cell_column, cell_row] = [0, 1].map(|axis_index| {
            let cell_coordinate =
                (points[axis_index] - self.min_corner[axis_index]) * self.cells_per_metre - 0.5;
            cell_coordinate.fast_max(zero_lanes).fast_min(f64x4::splat(self.last_indices[axis_index]))
                + ROUND_TO_INTEGER
                - ROUND_TO_INTEGER
        });
        // The last bits of the sum of `ROUND_TO_INTEGER` and a small integer are that integer.
        let cell_indices = (cell_row * self.column_count as f64 + cell_column + ROUND_TO_INTEGER).to_array();
        from_lanes(|i| self.lower_bound_of_cell(cell_indices[i].to_bits() as u32 as usize))
    }

    /// Returns an upper bound (m) on the distance to the nearest wall, given a lower bound; −∞ inside an occupied cell.
    pub fn upper_bound(&self, lower_bound: f64) -> f64 {
        // With the distance d from the middle of the cell to the nearest wall, the lower bound is d − radius, and the upper bound is d +
        // radius. In an undivided block d is only known up to a factor of (1 + 1/8)/(1 − 1/8).
        let cell_radius = 1.001 * self.cell_radius;
        let upper_bound = (UNDIVIDED_DISTANCE_RATIO + 1.0) / (UNDIVIDED_DISTANCE_RATIO - 1.0)
            * (lower_bound + cell_radius + self.cell_uncertainty)
            + cell_radius;
        if lower_bound == f64::from(NOT_COMPUTED) { f64::INFINITY } else { upper_bound }
    }
}

struct FieldBuilder<'a> {
    wall_tree: &'a WallTree,
    occupied_grid: Option<&'a OccupancyGrid>,
    distance_field: DistanceField,
    row_count: usize,
    cell_side: f64,
    rounding_slack: f64,
    /// Candidates for the wall nearest to the current block: unmeasured walls, and measured walls with their distances (m).
    unmeasured_walls: Vec<WallSet>,
    measured_walls: Vec<(f64, WallSet)>,
}

#[derive(Clone, Copy, Debug)]
enum WallSet {
    Wall(u32),
    Node(u32),
}

fn walls_of_node(wall_tree: &WallTree, node_index: usize) -> impl Iterator<Item = WallSet> {
    wall_tree.wall_range(node_index).map(|wall_index| WallSet::Wall(wall_index as u32))
}

impl<'a> FieldBuilder<'a> {
    fn new(wall_tree: &'a WallTree, map_bounds: [f64; 4], occupied_grid: Option<&'a OccupancyGrid>) -> Self {
        let [min_x, min_y, max_x, max_y] = map_bounds;
        let (width, height) = (max_x - min_x, max_y - min_y);
        let cell_count = (CELLS_PER_WALL * wall_tree.walls.len() as f64).clamp(MIN_CELLS, MAX_CELLS);
        // The second term limits the number of cells in a row to `cell_count` if the map is narrow.
        let cell_side = (width * height / cell_count).sqrt().max(width.max(height) / cell_count);
        let [column_count, row_count] =
            [width, height].map(|side_length| (side_length / cell_side).ceil() as usize + 1);
        let cell_radius = FRAC_1_SQRT_2 * cell_side;
        Self {
            wall_tree,
            occupied_grid,
            distance_field: DistanceField {
                min_corner: [min_x, min_y],
                cells_per_metre: 1.0 / cell_side,
                column_count,
                last_indices: [column_count, row_count]
                    .map(|cell_count_along_side| cell_count_along_side as f64 - 1.0),
                cell_radius,
                cell_uncertainty: if wall_tree.is_leaf(1) { 0.0 } else { MAX_RELATIVE_ERROR * cell_radius },
                lower_bounds: vec![NOT_COMPUTED; column_count * row_count],
            },
            row_count,
            cell_side,
            rounding_slack: rounding_bound(&map_bounds),
            unmeasured_walls: Vec::new(),
            measured_walls: Vec::new(),
        }
    }

    fn fill_block(
        &mut self,
        candidate_walls: &[WallSet],
        [first_column, first_row]: [usize; 2],
        width: usize,
    ) {
        if first_column >= self.distance_field.column_count || first_row >= self.row_count {
            return;
        }
        let [end_column, end_row] = [
            (first_column + width).min(self.distance_field.column_count),
            (first_row + width).min(self.row_count),
        ];
        let block_centre = self.block_centre([first_column, first_row], width);
        let block_radius = width as f64 * self.distance_field.cell_radius;
        let block_uncertainty = width as f64 * self.distance_field.cell_uncertainty;
        let Some([min_distance, max_distance]) =
            self.measure_candidates(candidate_walls, block_centre, width, block_uncertainty)
        else {
            return;
        };
        if width > 1
            && min_distance
                <= UNDIVIDED_DISTANCE_RATIO * block_radius + block_uncertainty / MAX_RELATIVE_ERROR
        {
            let max_lower_bound = max_distance + 2.0 * block_radius + self.rounding_slack;
            let is_near = |(lower_bound, _): &&(f64, WallSet)| *lower_bound <= max_lower_bound;
            let nearby_wall_sets: Vec<_> =
                self.measured_walls.iter().filter(is_near).map(|(_, wall_set)| *wall_set).collect();
            let half_width = width / 2;
            for [column, row] in [[0, 0], [half_width, 0], [0, half_width], [half_width, half_width]] {
                self.fill_block(&nearby_wall_sets, [first_column + column, first_row + row], half_width);
            }
            return;
        }
        // If `min_distance > block_radius`, no wall passes through the block: the whole block is either inside or outside of the occupied
        // cells.
        let is_in_blocked_cell = min_distance > block_radius
            && self.occupied_grid.is_some_and(|occupied_grid| occupied_grid.is_blocked_at(block_centre));
        for row in first_row..end_row {
            for column in first_column..end_column {
                let [x, y] = self.block_centre([column, row], 1);
                let max_offset = self.distance_field.cell_radius
                    + ((x - block_centre[0]) * (x - block_centre[0])
                        + (y - block_centre[1]) * (y - block_centre[1]))
                        .sqrt();
                // The bound is reduced by the fraction 1e-6 of the distance, which is more than the error of rounding it to an f32.
                let cell_lower_bound = if is_in_blocked_cell {
                    f64::NEG_INFINITY
                } else {
                    min_distance * (1.0 - 1e-6) - max_offset - self.rounding_slack
                };
                self.distance_field.lower_bounds[row * self.distance_field.column_count + column] =
                    cell_lower_bound as f32;
            }
        }
    }

    /// Returns a lower and an upper bound (m) on the distance from the middle of a block to the nearest wall, at most `allowed_uncertainty`
    /// apart. None if too many walls are near. Afterwards `measured_walls` has all walls or nodes that may be nearest to a point of the block.
    fn measure_candidates(
        &mut self,
        candidate_walls: &[WallSet],
        block_centre: [f64; 2],
        width: usize,
        allowed_uncertainty: f64,
    ) -> Option<[f64; 2]> {
        let Self { wall_tree, unmeasured_walls, measured_walls, .. } = self;
        // A wall can be nearest to a point of the block only if its distance from the middle exceeds the smallest distance by at most the
        // diameter of the block.
        let max_distance_excess = 2.0 * width as f64 * self.distance_field.cell_radius + self.rounding_slack;
        measured_walls.clear();
        unmeasured_walls.clear();
        unmeasured_walls.extend_from_slice(candidate_walls);
        let mut least_upper_bound = f64::INFINITY;
        let mut measured_count = 0;
        while let Some(wall_set) = unmeasured_walls.pop() {
            measured_count += 1;
            if measured_count > MAX_WALLS_PER_BLOCK + MAX_WALLS_PER_CELL * width * width {
                return None;
            }
            let distance_to_wall =
                |wall: usize| wall_tree.walls[wall].squared_distance_to_point(block_centre).sqrt();
            let lower_bound = match wall_set {
                WallSet::Wall(wall) => distance_to_wall(wall as usize),
                WallSet::Node(node) => wall_tree.wall_nodes[node as usize].lower_bound(block_centre),
            };
            if lower_bound > least_upper_bound + max_distance_excess {
                continue;
            }
            if lower_bound < least_upper_bound {
                least_upper_bound = least_upper_bound.min(match wall_set {
                    WallSet::Wall(_) => lower_bound,
                    WallSet::Node(node) => distance_to_wall(wall_tree.wall_range(node as usize).start),
                });
            }
            if width == 1 && least_upper_bound <= allowed_uncertainty {
                return Some([0.0, least_upper_bound]);
            }
            match wall_set {
                WallSet::Node(node)
                    if lower_bound < least_upper_bound - allowed_uncertainty
                        || wall_tree.wall_nodes[node as usize].capsule_radius > 0.5 * max_distance_excess =>
                {
                    if wall_tree.is_leaf(node as usize) {
                        unmeasured_walls.extend(walls_of_node(wall_tree, node as usize));
                    } else {
                        unmeasured_walls.extend([2 * node, 2 * node + 1].map(WallSet::Node));
                    }
                }
                _ => measured_walls.push((lower_bound, wall_set)),
            }
        }
        Some([
            measured_walls.iter().map(|(lower_bound, _)| *lower_bound).fold(least_upper_bound, f64::min),
            least_upper_bound,
        ])
    }

    fn block_centre(&self, first_cell: [usize; 2], width: usize) -> [f64; 2] {
        std::array::from_fn(|axis_index| {
            self.distance_field.min_corner[axis_index]
                + (first_cell[axis_index] as f64 + 0.5 * width as f64) * self.cell_side
        })
    }
}

#[inline(never)]
pub(super) fn rounding_bound(coordinates: &[f64]) -> f64 {
    1e-12 * coordinates.iter().fold(0.0, |largest: f64, plan_coordinate| largest.max(plan_coordinate.abs()))
}
