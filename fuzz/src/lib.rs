//! Properties of any input: one function a target, called by cargo-fuzz and by the tests of the package.

pub mod anatomy;
pub mod banana;
pub mod calibrate;
pub mod decomposer;
pub mod grid;
pub mod input;
pub mod laws;
pub mod pgm;
pub mod plan;
pub mod png;
pub mod reckoning;
pub mod settings;
pub mod squeeze;
