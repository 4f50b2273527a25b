//! The JavaScript interface of the core in a browser: its arguments, results, errors and memory.
//!
//! Native tests check the computations of models and simulations. These tests call classes and functions as a page does, and compare
//! results with those of Rust.
#![cfg(target_arch = "wasm32")]
#![allow(
    clippy::disallowed_methods,
    reason = "an expected value may come from the platform's own mathematics"
)]

mod anatomy;
mod banana;
mod calibration;
mod decomposer;
mod memory;
mod models;
mod reckoning;
mod squeeze;
mod support;

wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_browser);
