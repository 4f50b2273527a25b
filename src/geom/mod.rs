//! Plane geometry: angles, poses and their group, circular arcs. No robotics and no randomness.

pub mod angle;
pub mod arc;
pub mod arc_forms;
pub mod lanes;
pub mod se2;
pub mod segment;
pub mod sinc;
pub mod unbend;
