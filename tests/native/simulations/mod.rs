//! The machine of each figure.

mod alpha_calibrator;
mod arc_anatomy;
mod banana;
mod dead_reckoning;
mod large_clouds;
mod morph;
mod odometry_decomposer;
mod pictures;
mod squeeze;
