//! The chapter's listings and its worked example.

mod listings;
mod worked_example;
