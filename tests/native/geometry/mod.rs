//! Poses, arcs and the arithmetic beneath them.

mod arc;
mod double_double;
mod group_laws;
mod lanes;
