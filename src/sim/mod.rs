//! Simulations of the widgets. They compute buffers and statistics from settings, and do not depend on a browser.

pub mod alpha_calibrator;
pub mod arc_anatomy;
pub mod banana;
mod cloud;
mod cloud_simulation;
pub mod dead_reckoning;
mod noise_level;
pub mod odometry_decomposer;
pub mod settings;
pub mod squeeze;

pub use cloud::{picture, views};
