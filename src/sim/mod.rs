//! The widgets' simulations: parameters in, buffers and figures out, no browser anywhere.

pub mod banana;
mod cloud;
pub mod settings;
pub mod squeeze;

pub use cloud::View;
pub use cloud::{picture, views};
