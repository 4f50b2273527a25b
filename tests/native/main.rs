//! Native tests of the crate, in one executable.
#![allow(
    clippy::disallowed_methods,
    reason = "an expected value may come from the platform's own mathematics"
)]

mod calibrate;
mod chapter {
    mod listings;
    mod worked_example;
}
mod common;
mod digest;
mod documents;
#[path = "../fuzz.rs"]
mod fuzz;
mod geometry {
    mod arc;
    mod arc_forms;
    mod group_laws;
    mod lanes;
}
/// Property tests of mathematical laws and of limits of inputs, with arbitrary doubles. If a law does not hold for all
/// doubles, its test says why, and for which doubles it holds.
mod laws {
    pub mod doubles;
    mod geometry;
    mod maps;
    mod models;
    mod motions;
    mod regressions;
    mod statistics;
}
/// Floor plans, occupancy grids and motion that a map restricts.
mod map {
    pub mod conditioned;
    mod hard_plans;
    mod occupancy;
    mod pixels;
    mod plans;
    mod png;
}
mod models {
    mod noise;
    mod odometry;
    mod odometry_rules;
    mod tangent;
    mod velocity;
}
mod simulations {
    mod alpha_calibrator;
    pub mod arc_anatomy;
    pub mod banana;
    pub mod dead_reckoning;
    mod large_clouds;
    mod morph;
    pub mod odometry_decomposer;
    mod pictures;
    mod squeeze;
}
mod stats {
    mod coverage;
    mod gain;
    mod level_set;
    mod moments;
}
