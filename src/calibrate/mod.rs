//! The α's of a robot, from a log: what its wheels said, and where it really went.
//!
//! [`calibrate`] does it all, [`Calibrating`] in steps. A log is two [`Trajectory`]s. It is cut into [`Leg`]s as long as those of the
//! filter that is to use the α's; each leg gives an [`Observation`], residuals whose variances are linear in the α's; what is
//! [`Systematic`] is found by least squares, and the α's are those under which the residuals are likeliest. `doc/calibration.md`
//! has the formulas.

mod bad;
mod bootstrap;
mod calibrating;
mod calibration;
mod clock;
mod density;
mod doubts;
mod judging;
mod leg_lengths;
mod legs;
mod likelihood;
mod maximum;
mod mismatch;
mod model;
mod overstated;
mod profile;
mod stages;
mod systematic;
mod trajectory;
mod undetermined;
mod work;

pub use bad::Robust;
pub use calibrating::{Calibrating, calibrate};
pub use calibration::{CalibrateError, Calibration, Options, ReferenceError};
pub use doubts::{Doubts, HeldOut, Inflation, Judged, KindDoubts, Verdict};
pub use leg_lengths::{AtLength, FACTORS};
pub use legs::{FEWEST, Leg, LegLength, cut};
pub use likelihood::Evidence;
pub use model::{Kind, Model, Observation, Uncertainty};
pub use profile::{Estimate, fit};
pub use systematic::{ERRORS, Error, Systematic, Which};
pub(crate) use trajectory::sort;
pub use trajectory::{Trajectory, TrajectoryError, TrajectoryFault};
pub use undetermined::Undetermined;
