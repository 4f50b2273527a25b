//! The JavaScript interface of the core in a browser: values in and out, errors by class and message, memory freed.
//!
//! Native tests check what the models and simulations compute. Here every class and function is called as by a page, and its results are
//! compared with those of Rust.
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
