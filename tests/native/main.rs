//! Native tests of the crate, in one program.
#![allow(
    clippy::disallowed_methods,
    reason = "an expected value may come from the platform's own mathematics"
)]

mod calibrate;
mod chapter;
mod common;
mod digest;
mod documents;
#[path = "../fuzz.rs"]
mod fuzz;
mod geometry;
mod laws;
mod map;
mod models;
mod settings;
mod simulations;
mod stats;
