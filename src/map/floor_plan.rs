//! Floor plans, and collision tests of a round robot.

use super::apartment;
use super::distance_field::{DistanceField, rounding_bound};
use super::occupancy::OccupancyGrid;
use super::wall_tree::{WallNode, WallTree};
use crate::geom::arc::{Arc, ArcPiece, DrivenArc, LocalArc, PreparedPose};
use crate::geom::lanes::{LANE_COUNT, is_any_lane_set};
use crate::geom::segment::Segment;
use crate::numbers::format_number;
use std::cell::OnceCell;
use std::ops::RangeInclusive;
use std::sync::OnceLock;
use thiserror::Error;
use wide::f64x4;

/// Floor plan: walls without thickness inside a rectangle.
#[derive(Clone, Debug)]
pub struct FloorPlan {
    walls: Vec<Segment>,
    plan_bounds: [f64; 4],
    /// Cells of the grid from which the floor plan was made, if any. The walls are the outlines of its occupied cells. A point inside an
    /// occupied cell is never free.
    occupied_grid: Option<OccupancyGrid>,
    /// Search structures of the collision tests, created by the first test.
    collision_index: OnceLock<CollisionIndex>,
}

#[derive(Clone, Debug)]
struct CollisionIndex {
    wall_tree: WallTree,
    distance_field: DistanceField,
}

/// Reason why a floor plan is refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum FloorPlanError {
    /// A bound of the floor plan is beyond ±10⁶ m, or the plan is narrower than a centimetre or wider than 100 km in x or y.
    #[error(
        "bounds is [{}]; allowed is min x, min y, max x, max y: numbers from -1000000 to 1000000, the sides from 0.01 to 100000",
        join_numbers(.0)
    )]
    BadBounds([f64; 4]),
    /// An end of a wall is not finite or outside the bounds.
    #[error("walls[{wall_index}] ends at [{}]; allowed is a point inside the bounds", join_numbers(.invalid_end))]
    BadWall {
        /// Index (from 0) of the wall with the invalid end.
        wall_index: usize,
        /// Position (m) of the invalid end of the wall, or of its start if neither end is valid.
        invalid_end: [f64; 2],
    },
    /// The floor plan has more than [`FloorPlan::MAX_WALLS`] walls.
    #[error("walls has a length of {0} or more; allowed is at most {max}", max = FloorPlan::MAX_WALLS)]
    TooManyWalls(usize),
    /// The bounds of a grid exceed the range that is allowed for a floor plan.
    #[error(
        "origin has the cells from [{}] to [{}]; allowed are coordinates from -1000000 to 1000000, and a grid with sides from 0.01 to 100000",
        join_numbers(&.0[..2]),
        join_numbers(&.0[2..])
    )]
    BadGrid([f64; 4]),
    /// The outlines of the occupied cells of a grid have more than [`FloorPlan::MAX_WALLS`] sides.
    #[error(
        "image has blocked cells with {0} sides or more; allowed are at most {max}: remove specks or use larger cells",
        max = FloorPlan::MAX_WALLS
    )]
    TooManySides(usize),
}

fn join_numbers(joined_numbers: &[f64]) -> String {
    joined_numbers.iter().copied().map(format_number).collect::<Vec<_>>().join(", ")
}

/// Result of a collision test, and the number of wall distances that it took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CollisionVerdict {
    /// True if the pose or the motion is free of collisions.
    pub is_free: bool,
    /// Number of wall distances that were computed: 0 in most tests. A wall near several pieces of a motion counts for each piece.
    pub wall_tests: usize,
}

impl CollisionVerdict {
    pub(super) const FREE: Self = Self { is_free: true, wall_tests: 0 };
    const BLOCKED: Self = Self { is_free: false, wall_tests: 0 };
}

/// Allowed coordinates of the bounds of a floor plan, m. A robot's coordinates have the same range.
const COORDINATE_RANGE: RangeInclusive<f64> = -1e6..=1e6;
const SIDE_RANGE: RangeInclusive<f64> = 0.01..=1e5;

impl FloorPlan {
    /// Maximum number of walls of a floor plan.
    pub const MAX_WALLS: usize = 20_000;

    /// Creates a floor plan of `walls` within `bounds` (minimum x, minimum y, maximum x, maximum y), m. Fails with [`FloorPlanError`] for
    /// the first wall or bound that is not allowed.
    pub fn new(walls: Vec<Segment>, bounds: [f64; 4]) -> Result<Self, FloorPlanError> {
        Self::with_grid(walls, bounds, None)
    }

    /// Returns the floor plan of a grid. Its walls are the outlines of the blocked cells; its bounds are those of the grid. Fails with
    /// [`FloorPlanError`] if there are too many walls, or the grid is too large or too small.
    pub fn from_grid(occupancy_grid: OccupancyGrid) -> Result<Self, FloorPlanError> {
        let walls = occupancy_grid.outlines(Self::MAX_WALLS).map_err(FloorPlanError::TooManySides)?;
        let mut bounds = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        for [x, y] in occupancy_grid.corners() {
            bounds = [bounds[0].min(x), bounds[1].min(y), bounds[2].max(x), bounds[3].max(y)];
        }
        Self::with_grid(walls, bounds, Some(occupancy_grid))
    }

    fn with_grid(
        walls: Vec<Segment>,
        bounds: [f64; 4],
        occupied_grid: Option<OccupancyGrid>,
    ) -> Result<Self, FloorPlanError> {
        let [min_x, min_y, max_x, max_y] = bounds;
        let side_lengths = [max_x - min_x, max_y - min_y];
        if !bounds.iter().all(|bound_coordinate| COORDINATE_RANGE.contains(bound_coordinate))
            || !side_lengths.iter().all(|side_length| SIDE_RANGE.contains(side_length))
        {
            let bounds_error =
                if occupied_grid.is_some() { FloorPlanError::BadGrid } else { FloorPlanError::BadBounds };
            return Err(bounds_error(bounds));
        }
        if walls.len() > Self::MAX_WALLS {
            return Err(FloorPlanError::TooManyWalls(walls.len()));
        }
        // Walls may end outside the bounds by a rounding error, as corners of a rotated grid do.
        let rounding_slack = rounding_bound(&bounds);
        let is_inside = |[x, y]: [f64; 2]| {
            (min_x - rounding_slack..=max_x + rounding_slack).contains(&x)
                && (min_y - rounding_slack..=max_y + rounding_slack).contains(&y)
        };
        for (wall_index, wall) in walls.iter().enumerate() {
            if let Some(invalid_end) = [wall.from, wall.to].into_iter().find(|wall_end| !is_inside(*wall_end))
            {
                return Err(FloorPlanError::BadWall { wall_index, invalid_end });
            }
        }
        Ok(Self { walls, plan_bounds: bounds, occupied_grid, collision_index: OnceLock::new() })
    }

    /// Creates the floor plan of the apartment in which the widget Map Squeeze opens: 12 m × 9 m, 18 walls.
    pub fn apartment() -> Self {
        Self::new(apartment::WALLS.to_vec(), apartment::APARTMENT_BOUNDS)
            .unwrap_or_else(|_| unreachable!("a constant that the tests build"))
    }

    /// Returns the walls. For a floor plan made from a grid, they are the outlines of the blocked cells.
    pub fn walls(&self) -> &[Segment] {
        &self.walls
    }

    /// Returns the smallest x and y and the largest x and y, m.
    pub fn bounds(&self) -> [f64; 4] {
        self.plan_bounds
    }

    /// Returns the grid from which the floor plan was made; None if it was made from walls.
    pub fn grid(&self) -> Option<&OccupancyGrid> {
        self.occupied_grid.as_ref()
    }

    /// Tests whether a disc of radius `clearance` (m) around a point touches no wall and its centre is inside the bounds.
    pub fn test_point(&self, point: [f64; 2], clearance: f64) -> CollisionVerdict {
        if !self.contains_point(point) {
            return CollisionVerdict::BLOCKED;
        }
        let distance_field = self.distance_field();
        let nearest_lower_bound = distance_field.lower_bound(point);
        if nearest_lower_bound > clearance {
            return CollisionVerdict::FREE;
        }
        if distance_field.upper_bound(nearest_lower_bound) <= clearance || self.is_in_blocked_cell(point) {
            return CollisionVerdict::BLOCKED;
        }
        let mut wall_tests = 0;
        let is_free = self.are_near_walls_clear(
            point,
            clearance,
            &mut wall_tests,
            |wall_node| wall_node.is_farther_than(point, clearance),
            |wall| wall.distance_to_point(point) > clearance,
        );
        CollisionVerdict { is_free, wall_tests }
    }

    /// Tests whether a disc of radius `clearance` (m) whose centre drives along `arc` touches no wall and stays inside the bounds.
    pub fn test_arc(&self, arc: &Arc, clearance: f64) -> CollisionVerdict {
        let driven_arc = PreparedPose::new(arc.start).drive(arc.length, arc.turn);
        self.test_arc_after_end(&driven_arc, self.test_point(driven_arc.end, clearance), clearance)
    }

    /// Tests an arc whose end was tested before, see [`FloorPlan::test_arc`]. The cost includes that of the earlier test.
    pub(super) fn test_arc_after_end(
        &self,
        driven_arc: &DrivenArc,
        end_verdict: CollisionVerdict,
        clearance: f64,
    ) -> CollisionVerdict {
        let start_point = driven_arc.arc.start.position();
        if !end_verdict.is_free || self.leaves_bounds(driven_arc) || self.is_in_blocked_cell(start_point) {
            return CollisionVerdict { is_free: false, ..end_verdict };
        }
        let mut arc_sweep = ArcSweep {
            floor_plan: self,
            distance_field: self.distance_field(),
            arc: &driven_arc.arc,
            clearance,
            local_arc: OnceCell::new(),
            wall_tests: end_verdict.wall_tests,
        };
        let is_free = driven_arc
            .split_into_pieces()
            .all(|arc_piece| arc_sweep.is_free(&arc_piece, -arc_piece.half_length, arc_piece.half_length));
        CollisionVerdict { is_free, wall_tests: arc_sweep.wall_tests }
    }

    fn collision_index(&self) -> &CollisionIndex {
        self.collision_index.get_or_init(|| {
            let wall_tree = WallTree::new(&self.walls, self.plan_bounds);
            let distance_field =
                DistanceField::new(&wall_tree, self.plan_bounds, self.occupied_grid.as_ref());
            CollisionIndex { wall_tree, distance_field }
        })
    }

    pub(super) fn distance_field(&self) -> &DistanceField {
        &self.collision_index().distance_field
    }

    /// Returns true if a point is on the map: on its grid, which may be rotated, or inside the bounds if there is no grid.
    #[inline(always)]
    fn contains_point(&self, point: [f64; 2]) -> bool {
        if let Some(occupancy_grid) = &self.occupied_grid {
            return occupancy_grid.contains(point);
        }
        let ([x, y], [min_x, min_y, max_x, max_y]) = (point, self.plan_bounds);
        (min_x..=max_x).contains(&x) && (min_y..=max_y).contains(&y)
    }

    fn list_corners(&self) -> [[f64; 2]; 4] {
        let [min_x, min_y, max_x, max_y] = self.plan_bounds;
        let bounds_corners = [[min_x, min_y], [max_x, min_y], [max_x, max_y], [min_x, max_y]];
        self.occupied_grid.as_ref().map_or(bounds_corners, OccupancyGrid::corners)
    }

    #[inline(always)]
    fn is_in_blocked_cell(&self, point: [f64; 2]) -> bool {
        self.occupied_grid.as_ref().is_some_and(|occupied_grid| occupied_grid.is_blocked_at(point))
    }

    fn leaves_bounds(&self, driven_arc: &DrivenArc) -> bool {
        let (arc, [min_x, min_y, max_x, max_y]) = (&driven_arc.arc, driven_arc.bounding_box());
        let mut box_corners = [[min_x, min_y], [max_x, min_y], [max_x, max_y], [min_x, max_y]].into_iter();
        if box_corners.all(|box_corner| self.contains_point(box_corner)) {
            return false;
        }
        if !self.contains_point(arc.start.position()) || !self.contains_point(driven_arc.end) {
            return true;
        }
        // Both ends of the arc were tested above and are inside the map. An arc that only touches an edge of the map counts as inside, up
        // to rounding.
        let corners = self.list_corners();
        let rounding_slack = rounding_bound(corners.as_flattened());
        (0..4).any(|i| {
            let map_edge = Segment { from: corners[i], to: corners[(i + 1) % 4] };
            map_edge.max_distance_on_right(arc) > rounding_slack
        })
    }

    /// Tests whether `is_wall_clear` holds for every wall whose bounding box is within `max_distance` (m) of a point in x and in y. Nodes
    /// of the wall tree for which `is_node_clear` holds are skipped.
    fn are_near_walls_clear(
        &self,
        [x, y]: [f64; 2],
        max_distance: f64,
        wall_tests: &mut usize,
        is_node_clear: impl FnMut(&WallNode) -> bool,
        mut is_wall_clear: impl FnMut(&Segment) -> bool,
    ) -> bool {
        self.collision_index().wall_tree.are_all_walls_clear(is_node_clear, |wall| {
            let Segment { from: wall_start, to: wall_end } = wall;
            let is_near = wall_start[0].min(wall_end[0]) <= x + max_distance
                && wall_start[0].max(wall_end[0]) >= x - max_distance
                && wall_start[1].min(wall_end[1]) <= y + max_distance
                && wall_start[1].max(wall_end[1]) >= y - max_distance;
            !is_near || {
                *wall_tests += 1;
                is_wall_clear(wall)
            }
        })
    }
}

struct ArcSweep<'a> {
    floor_plan: &'a FloorPlan,
    distance_field: &'a DistanceField,
    arc: &'a Arc,
    clearance: f64,
    /// Arc in the frame of its start. It is computed when the distance to a wall is needed for the first time.
    local_arc: OnceCell<LocalArc>,
    wall_tests: usize,
}

impl ArcSweep<'_> {
    /// Tests whether the disc is free on an arc piece between `start_offset` and `end_offset` (m, from the middle of the piece). The
    /// interval is divided into four parts, one for each SIMD lane.
    fn is_free(&mut self, piece: &ArcPiece, start_offset: f64, end_offset: f64) -> bool {
        let distance_field = self.distance_field;
        let half_part_length = (end_offset - start_offset) / (2 * LANE_COUNT) as f64;
        let needed_distance = self.clearance + piece.max_error + half_part_length;
        let part_middles =
            piece.points_at(f64x4::new([1.0, 3.0, 5.0, 7.0]) * half_part_length + start_offset);
        let lower_bounds = distance_field.lower_bounds(&part_middles);
        if !is_any_lane_set(lower_bounds.simd_le(f64x4::splat(needed_distance))) {
            return true;
        }
        let part_lower_bounds = lower_bounds.to_array();
        let min_lower_bound = part_lower_bounds.into_iter().fold(f64::INFINITY, f64::min);
        if distance_field.upper_bound(min_lower_bound) <= self.clearance - piece.max_error {
            return false;
        }
        // A part of the arc that is no longer than the diagonal of a cell is not divided, because the distance field is too coarse.
        // Distances to walls are computed instead.
        let is_divisible = half_part_length > distance_field.cell_radius;
        let [x, y] = part_middles.map(|coordinate_lanes| coordinate_lanes.to_array());
        (0..LANE_COUNT).all(|i| {
            part_lower_bounds[i] > needed_distance
                || if is_divisible {
                    let part_start = start_offset + (2 * i) as f64 * half_part_length;
                    self.is_free(piece, part_start, part_start + 2.0 * half_part_length)
                } else {
                    self.are_walls_clear([x[i], y[i]], half_part_length + piece.max_error, piece.max_error)
                }
        })
    }

    /// Tests whether all walls near a part of the arc are farther away than the clearance. For most walls the distance to the middle of the
    /// part decides.
    fn are_walls_clear(&mut self, part_middle: [f64; 2], part_radius: f64, max_error: f64) -> bool {
        let (arc, clearance) = (self.arc, self.clearance);
        let get_local_arc = || self.local_arc.get_or_init(|| arc.local_arc());
        let (clear_distance, blocked_distance) = (part_radius + clearance, (clearance - max_error).max(0.0));
        self.floor_plan.are_near_walls_clear(
            part_middle,
            clear_distance,
            &mut self.wall_tests,
            |wall_node| {
                wall_node.is_farther_than(part_middle, clear_distance)
                    // Testing a node of the wall tree saves time only if its capsule is thinner than the length of the tested part of the
                    // arc.
                    || wall_node.capsule_radius < part_radius
                        && wall_node.capsule_axis.distance_to_local_arc(get_local_arc()) - wall_node.capsule_radius > clearance
            },
            |wall| {
                let squared_distance = wall.squared_distance_to_point(part_middle);
                let is_clear = squared_distance > clear_distance * clear_distance;
                if is_clear || squared_distance < blocked_distance * blocked_distance {
                    return is_clear;
                }
                wall.distance_to_local_arc(get_local_arc()) > clearance
            },
        )
    }
}
