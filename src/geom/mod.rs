//! Plane geometry: angles, poses and their group, circular arcs. This module knows nothing about robots or random numbers.

pub mod angle;
pub mod arc;
pub mod arc_forms;
pub mod lanes;
pub mod se2;
pub mod segment;
pub mod sinc;
pub mod unbend;
