//! Noises and motion models.

mod noise;
mod odometry;
mod odometry_rules;
mod tangent;
mod velocity;
