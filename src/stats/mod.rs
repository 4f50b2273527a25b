//! Statistics of a cloud of poses: moments, cross-track skew, 2σ contours. Exact values of the same quantities for a model, by quadrature.

mod contour;
mod cross_track;
mod exact;
mod exact_gain;
mod gain;
mod level_set;
mod moments;
pub mod quadrature;
pub(crate) mod sums;
pub(crate) mod two_pass;

pub use contour::{Ellipse, ExponentialContour};
pub use cross_track::{CrossTrackStats, cross_track_skew};
pub use exact::{ExactMoments, predicted_cross_track_skew};
pub use exact_gain::ExactGain;
pub use gain::{LikelihoodGain, MeasuredGain};
pub use level_set::trace_level_set;
pub(crate) use moments::non_negative;
pub use moments::{CartesianMoments, ExponentialMoments};
