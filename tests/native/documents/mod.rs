//! Numbers and statements on the page and in doc/, compared with computed numbers.

mod arc_anatomy;
mod banana;
mod dead_reckoning;
mod exercises;
mod odometry_decomposer;
mod squeeze;

use crate::common::text::Text;

/// Returns the text of the page without markup.
fn page() -> Text {
    Text::of_page(include_str!("../../../www/index.html"))
}

fn exercises_document() -> Text {
    Text::of_document(include_str!("../../../doc/exercises.md"))
}

fn model_document() -> Text {
    Text::of_document(include_str!("../../../doc/model.md"))
}
