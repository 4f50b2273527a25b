//! Property tests of mathematical laws and of the limits of inputs, with arbitrary doubles. Where a law does not hold for all
//! doubles, its test says for which ones it does, and why.

pub mod doubles;
mod found;
mod geometry;
mod maps;
mod models;
mod motions;
mod settings;
mod statistics;
