//! Probabilistic motion models of a planar robot.

pub mod geom;
pub mod models;
pub mod noise;
pub mod sim;
pub mod stats;

pub use geom::arc::{ArcInversion, invert_arc};
pub use models::{
    Compounding, MotionModel, OdomAlphas, OdomDelta, OdometryModel, ReverseAware, TangentNoiseError,
    TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel,
};
pub use noise::{NegativeVariance, NoiseKind, Variance};

#[cfg(target_arch = "wasm32")]
mod wasm;
