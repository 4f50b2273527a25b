//! Maps, exact collision tests of arcs, and motion conditioned on a map.

mod apartment;
mod conditioned;
mod distance_field;
mod floor_plan;
mod occupancy;
mod open_place;
mod pgm;
#[cfg(not(widget))]
mod png;
mod reading;
mod wall_tree;

pub use conditioned::{
    AcceptedMotion, Cost, Draw, DrawTester, MAX_DRAWS, MapConditioned, NoAcceptedSample, Sampler,
};
pub use floor_plan::{FloorPlan, FloorPlanError, Verdict};
pub use occupancy::{Cell, Image, Interpretation, Mode, OccupancyGrid, Pixel, RESOLUTION_RANGE, Unknown};
pub use pgm::{MAX_BYTES, MAX_PIXELS, PgmError, Shade, Shades, read_pgm};
#[cfg(not(widget))]
pub use png::{PngError, read_png};
pub use reading::{ImageError, read_grid};
