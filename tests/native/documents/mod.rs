//! Numbers and statements in the page and in doc/, computed.

mod arc_anatomy;
mod banana;
mod dead_reckoning;
mod exercises;
mod odometry_decomposer;
mod squeeze;
