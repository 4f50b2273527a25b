//! Floor plans, occupancy grids and motion that a map restricts.

pub mod conditioned;
mod hard_plans;
mod occupancy;
mod pixels;
mod plans;
mod png;
