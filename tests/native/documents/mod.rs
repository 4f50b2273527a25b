//! Comparison of numbers and statements in the texts of the demo page and of doc/ with computed numbers.

mod arc_anatomy;
mod banana;
mod dead_reckoning;
mod exercises;
mod odometry_decomposer;
mod squeeze;

use crate::common::text::PlainText;

fn read_page_text() -> PlainText {
    PlainText::from_page(include_str!("../../../www/index.md"))
}

fn read_exercises() -> PlainText {
    PlainText::from_document(include_str!("../../../doc/exercises.md"))
}

fn read_model_document() -> PlainText {
    PlainText::from_document(include_str!("../../../doc/model.md"))
}
