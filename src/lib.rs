//! Probabilistic motion models of a planar robot: one command, a distribution of outcomes.
//!
//! The models are those of an online book's chapter "Probabilistic Motion Models". The chapter follows Thrun, Burgard and Fox,
//! *Probabilistic Robotics*, chapter 5, and Long et al., "The Banana Distribution is Gaussian", RSS 2012. The crate also has statistics of
//! clouds of poses, and the simulations of the chapter's widgets. The examples also need the crates `rand` and `rand_xoshiro`.
//!
//! ```
//! use motion::geom::se2::SE2;
//! use motion::{MotionModel, NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};
//! use rand::SeedableRng;
//! use rand_xoshiro::Xoshiro256PlusPlus;
//!
//! let model = VelocityModel { alphas: VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]), noise: NoiseKind::Normal };
//! let command = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
//! let mut rng = Xoshiro256PlusPlus::seed_from_u64(7);
//! let poses: Vec<SE2> = (0..10_000).map(|_| model.sample(&command, &SE2::identity(), &mut rng)).collect();
//! // A Gaussian in (x, y) has a skew of 0.
//! assert!(motion::stats::cross_track_skew(&poses) < -0.2);
//! ```
//!
//! # Units and frames
//! Metres, seconds, radians; angles counter-clockwise, headings in (−π, π]. The body frame has x ahead and y to the
//! left. Twists have the order (v_x, v_y, ω), exponential coordinates (along, lateral, heading). Perturbations act on
//! the right, in the body frame: x ⊞ τ = x · exp(τ).
//!
//! # Symbols
//! | symbol | in the crate | meaning |
//! |---|---|---|
//! | u = (v, ω), Δt | [`VelocityCmd`] | commanded velocities, held for Δt |
//! | α₁…α₆, α₁…α₄ | [`VelocityAlphas`], [`OdomAlphas`] | variance coefficients of the noise |
//! | b² | [`Variance`] | a variance, never a standard deviation |
//! | v̂, ω̂, γ̂ | [`ArcInversion`] | velocities executed, and the rate of the turn after the arc |
//! | δ_rot1, δ_trans, δ_rot2 | [`OdomDelta`] | rotate, drive, rotate |
//! | τ | [`TangentNoiseModel::twist`] | the twist that a command asks for |
//! | R_u | [`MotionModel::tangent_cov`] | noise covariance in exponential coordinates |
//! | ξ = x_t ⊟ x_{t−1} | [`geom::se2::SE2::boxminus`] | exponential coordinates of a motion |
//!
//! No result depends on a platform's mathematics library: the same seed gives the same poses, to the bit, natively and in a browser.

#![warn(missing_docs)]

pub mod calibrate;
pub mod geom;
mod js;
pub mod map;
pub mod models;
pub mod noise;
mod numbers;
pub mod sim;
pub mod stats;

#[cfg(target_arch = "wasm32")]
mod wasm;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub use geom::arc::{ArcInversion, invert_arc};
pub use models::{
    Compounding, ConfiguredOdometry, MotionModel, OdomAlphas, OdomDelta, OdometryModel, RotTransRot,
    TangentNoiseError, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel,
};
pub use nalgebra;
pub use noise::{NegativeVariance, NoiseKind, Variance};
