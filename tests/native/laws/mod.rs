//! The laws of the mathematics and of the edges, held to any doubles that they are for. Where a law does not hold over all
//! doubles, its test says for which ones it does, and why.

pub mod doubles;
mod found;
mod geometry;
mod maps;
mod models;
mod motions;
mod settings;
mod statistics;
