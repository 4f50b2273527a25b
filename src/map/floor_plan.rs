//! A floor plan, and whether a round robot fits.

use super::apartment;
use super::occupancy::OccupancyGrid;
use crate::geom::arc::Arc;
use crate::geom::segment::Segment;
use static_aabb2d_index::{Control, StaticAABB2DIndex, StaticAABB2DIndexBuilder};
use std::fmt;
use std::ops::RangeInclusive;

/// Walls without thickness inside a rectangle.
#[derive(Clone, Debug)]
pub struct FloorPlan {
    walls: Vec<Segment>,
    /// Least x, least y, greatest x, greatest y, m.
    bounds: [f64; 4],
    /// The walls by their bounding boxes; None where there are none.
    index: Option<StaticAABB2DIndex<f64>>,
    /// The cells that the walls outline, where they do: inside of one nobody is free, however far its sides.
    solid: Option<OccupancyGrid>,
}

/// Why a floor plan is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FloorPlanError {
    /// A bound is beyond ±10⁶ m, or a side shorter than a centimetre or longer than 100 km.
    BadBounds([f64; 4]),
    /// A wall has an end that is not finite or outside the bounds.
    BadWall { index: usize, end: [f64; 2] },
    /// More than [`FloorPlan::MOST_WALLS`] walls.
    TooManyWalls(usize),
}

impl fmt::Display for FloorPlanError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadBounds(bounds) => write!(
                f,
                "bounds is {bounds:?}; allowed is least x, least y, greatest x, greatest y: numbers from -1000000 to \
                 1000000, the sides from 0.01 to 100000"
            ),
            Self::BadWall { index, end } => {
                write!(f, "walls[{index}] ends at {end:?}; allowed is a point inside the bounds")
            }
            Self::TooManyWalls(count) => {
                write!(
                    f,
                    "walls has a length of {count} or more; allowed is at most {}",
                    FloorPlan::MOST_WALLS
                )
            }
        }
    }
}

impl std::error::Error for FloorPlanError {}

/// An answer, and how many walls were measured for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verdict {
    pub free: bool,
    pub wall_tests: usize,
}

/// Where bounds may lie and how far they may be apart, m: what a robot's coordinates may be, and what a screen can show.
const COORDINATE: RangeInclusive<f64> = -1e6..=1e6;
const SIDE: RangeInclusive<f64> = 0.01..=1e5;

impl FloorPlan {
    /// What is still interactive to draw and to index.
    pub const MOST_WALLS: usize = 100_000;

    /// A plan of `walls` within `bounds` (least x, least y, greatest x, greatest y), m.
    ///
    /// # Errors
    /// [`FloorPlanError`] for the first thing that is not as it says.
    pub fn new(walls: Vec<Segment>, bounds: [f64; 4]) -> Result<Self, FloorPlanError> {
        Self::with_solid(walls, bounds, None)
    }

    /// The plan of a grid: its walls are the outlines of the occupied cells, its bounds those of the grid.
    ///
    /// # Errors
    /// [`FloorPlanError`] where there are too many walls, or the grid is too large or too small.
    pub fn from_grid(grid: OccupancyGrid) -> Result<Self, FloorPlanError> {
        let walls = grid.outlines(Self::MOST_WALLS).map_err(FloorPlanError::TooManyWalls)?;
        let mut bounds = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        for [x, y] in grid.corners() {
            bounds = [bounds[0].min(x), bounds[1].min(y), bounds[2].max(x), bounds[3].max(y)];
        }
        Self::with_solid(walls, bounds, Some(grid))
    }

    fn with_solid(
        walls: Vec<Segment>,
        bounds: [f64; 4],
        solid: Option<OccupancyGrid>,
    ) -> Result<Self, FloorPlanError> {
        let [left, bottom, right, top] = bounds;
        let sides = [right - left, top - bottom];
        if !bounds.iter().all(|bound| COORDINATE.contains(bound))
            || !sides.iter().all(|side| SIDE.contains(side))
        {
            return Err(FloorPlanError::BadBounds(bounds));
        }
        if walls.len() > Self::MOST_WALLS {
            return Err(FloorPlanError::TooManyWalls(walls.len()));
        }
        // Rounding may set the corner of a turned grid a little outside its own bounds.
        let slack = 1e-12 * bounds.iter().fold(0.0, |most: f64, bound| most.max(bound.abs()));
        let inside = |[x, y]: [f64; 2]| {
            (left - slack..=right + slack).contains(&x) && (bottom - slack..=top + slack).contains(&y)
        };
        for (index, wall) in walls.iter().enumerate() {
            if let Some(end) = [wall.from, wall.to].into_iter().find(|end| !inside(*end)) {
                return Err(FloorPlanError::BadWall { index, end });
            }
        }
        let index = (!walls.is_empty()).then(|| index_of(&walls));
        Ok(Self { walls, bounds, index, solid })
    }

    /// The apartment of the chapter's widget: 12 m × 9 m, 18 walls.
    pub fn apartment() -> Self {
        let walls = apartment::WALLS.map(|[x0, y0, x1, y1]| Segment { from: [x0, y0], to: [x1, y1] });
        Self::new(walls.to_vec(), apartment::BOUNDS).expect("a constant that the tests build")
    }

    pub fn walls(&self) -> &[Segment] {
        &self.walls
    }

    pub fn bounds(&self) -> [f64; 4] {
        self.bounds
    }

    /// The cells that the walls outline, where they do.
    pub fn grid(&self) -> Option<&OccupancyGrid> {
        self.solid.as_ref()
    }

    /// Whether a disc of radius `clearance` (m) around a point touches no wall and its centre is inside the bounds.
    pub fn point_free(&self, point: [f64; 2], clearance: f64) -> Verdict {
        if !self.holds(point) || self.buried(point) {
            return Verdict { free: false, wall_tests: 0 };
        }
        let [x, y] = point;
        self.keeps_clear([x, y, x, y], clearance, |wall| wall.distance_to_point(point))
    }

    /// Whether a disc of radius `clearance` (m) whose centre drives along `arc` touches no wall and stays inside the
    /// bounds.
    pub fn arc_free(&self, arc: &Arc, clearance: f64) -> Verdict {
        let within = arc.bounding_box();
        if self.leaves_bounds(arc, within) || self.buried([arc.start.x(), arc.start.y()]) {
            return Verdict { free: false, wall_tests: 0 };
        }
        self.keeps_clear(within, clearance, |wall| wall.distance_to_arc(arc))
    }

    /// A point where a disc of radius `clearance` fits, as near as a search in steps of a hundredth of the bounds finds
    /// one to the origin of the map, where mapping robots start; None where it fits nowhere.
    pub fn free_point(&self, clearance: f64) -> Option<[f64; 2]> {
        const STEPS: u32 = 100;
        let [left, bottom, right, top] = self.bounds;
        let at = |from: f64, to: f64, i: u32| from + (to - from) * f64::from(i) / f64::from(STEPS);
        let mut points: Vec<[f64; 2]> = (0..=STEPS)
            .flat_map(|i| (0..=STEPS).map(move |j| [at(left, right, i), at(bottom, top, j)]))
            .collect();
        points.push([0.0, 0.0]);
        points.sort_by(|[ax, ay], [bx, by]| libm::hypot(*ax, *ay).total_cmp(&libm::hypot(*bx, *by)));
        points.into_iter().find(|point| self.point_free(*point, clearance).free)
    }

    /// Whether a point is on the map: on the grid where there is one, which may be turned, else inside the bounds.
    fn holds(&self, point: [f64; 2]) -> bool {
        if let Some(grid) = &self.solid {
            return grid.spans(point);
        }
        let ([x, y], [left, bottom, right, top]) = (point, self.bounds);
        (left..=right).contains(&x) && (bottom..=top).contains(&y)
    }

    /// The corners of the map, in order around it.
    fn corners(&self) -> [[f64; 2]; 4] {
        let [left, bottom, right, top] = self.bounds;
        let of_bounds = [[left, bottom], [right, bottom], [right, top], [left, top]];
        self.solid.as_ref().map_or(of_bounds, OccupancyGrid::corners)
    }

    fn buried(&self, point: [f64; 2]) -> bool {
        self.solid.as_ref().is_some_and(|solid| solid.holds(point))
    }

    fn leaves_bounds(&self, arc: &Arc, within: [f64; 4]) -> bool {
        let [left, bottom, right, top] = within;
        if [[left, bottom], [right, bottom], [right, top], [left, top]]
            .into_iter()
            .all(|corner| self.holds(corner))
        {
            return false;
        }
        let end = arc.end();
        if !self.holds([arc.start.x(), arc.start.y()]) || !self.holds([end.x(), end.y()]) {
            return true;
        }
        // Both ends are inside, so that an arc which leaves crosses an edge.
        let corners = self.corners();
        (0..4).any(|i| Segment { from: corners[i], to: corners[(i + 1) % 4] }.distance_to_arc(arc) == 0.0)
    }

    /// Whether every wall near the box is further than `clearance` by the given measure.
    fn keeps_clear(&self, within: [f64; 4], clearance: f64, distance: impl Fn(&Segment) -> f64) -> Verdict {
        let mut verdict = Verdict { free: true, wall_tests: 0 };
        let Some(index) = &self.index else { return verdict };
        let [left, bottom, right, top] = within;
        let mut visit = |wall: usize| {
            verdict.wall_tests += 1;
            verdict.free = distance(&self.walls[wall]) > clearance;
            if verdict.free { Control::Continue } else { Control::Break(()) }
        };
        index.visit_query(
            left - clearance,
            bottom - clearance,
            right + clearance,
            top + clearance,
            &mut visit,
        );
        verdict
    }
}

fn index_of(walls: &[Segment]) -> StaticAABB2DIndex<f64> {
    let mut builder = StaticAABB2DIndexBuilder::new(walls.len());
    for Segment { from, to } in walls {
        builder.add(from[0].min(to[0]), from[1].min(to[1]), from[0].max(to[0]), from[1].max(to[1]));
    }
    builder.build().expect("as many boxes as announced, and not none")
}
