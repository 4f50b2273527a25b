//! The widgets' simulations: parameters in, buffers and figures out, no browser anywhere.

pub mod banana;
mod cloud;
mod draws;
mod drive;
mod figures;
pub mod picture;
pub mod settings;
pub mod squeeze;
pub mod views;

pub use views::View;
