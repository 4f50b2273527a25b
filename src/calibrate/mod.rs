//! The α's of a robot, from a log: what its wheels said, and where it really went.
//!
//! A log is cut into [`Leg`]s, as long as those of the filter that is to use the α's; each leg gives residuals whose
//! variances are linear in the α's ([`Component`]); and the α's are those under which the residuals are likeliest, with
//! intervals from the profile of the likelihood ([`fit`]).

mod legs;
mod likelihood;
mod profile;
mod residuals;
mod trajectory;

pub use legs::{Leg, LegLength, cut};
pub use likelihood::{Component, Residual};
pub use profile::{Estimate, fit};
pub use residuals::residuals;
pub use trajectory::{Trajectory, TrajectoryError, TrajectoryFault};
