//! Numbers and statements in the page and in doc/, computed.

mod arc_anatomy;
mod banana;
mod dead_reckoning;
mod exercises;
mod odometry_decomposer;
mod squeeze;

use crate::common::told::Told;

/// Returns the words of the page.
fn page() -> Told {
    Told::on_page(include_str!("../../../www/index.html"))
}
