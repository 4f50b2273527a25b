//! Maps, exact collision tests of arcs, and motion conditioned on a map.

mod apartment;
mod conditioned;
mod distance_field;
mod floor_plan;
mod free_pose;
mod image_file;
mod occupancy;
mod pgm;
#[cfg(not(widget))]
mod png;
mod wall_tree;

pub use conditioned::{
    AcceptedMotion, CollisionTester, Cost, MAX_DRAWS, MapConditioned, NoAcceptedSample, Sampler, TestedDraw,
};
pub use floor_plan::{CollisionVerdict, FloorPlan, FloorPlanError};
pub use image_file::{ImageError, read_grid};
pub use occupancy::{
    Cell, Image, MapMode, OccupancyGrid, Pixel, PixelClassifier, RESOLUTION_RANGE, UnknownCells,
};
pub use pgm::{MAX_BYTES, MAX_PIXELS, read_pgm};
#[cfg(not(widget))]
pub use png::read_png;
