//! The machine of each figure.

mod alpha_calibrator;
pub mod arc_anatomy;
pub mod banana;
pub mod dead_reckoning;
mod large_clouds;
mod morph;
pub mod odometry_decomposer;
mod pictures;
mod squeeze;
