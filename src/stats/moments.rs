//! Means and covariances of a cloud, in Cartesian and in exponential coordinates.

use crate::geom::se2::{SE2, wrap_angle};
use crate::js::js_structs;
use nalgebra::{Matrix3, Vector3};

js_structs! {
    /// Mean and covariance of (x, y, θ): m, m, rad, in the frame of the poses.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct CartesianMoments {
        /// Arithmetic mean position and circular mean heading in (−π, π].
        pub mean: Vector3<f64> as "number[]",
        /// Sample covariance (over n − 1), 3 × 3. Headings count as the shortest turn from the mean heading.
        pub cov: Matrix3<f64> as "number[][]",
    }
}

impl CartesianMoments {
    /// Returns the moments of `poses`. All are NaN without poses. The covariance is NaN for a single pose.
    pub fn from_poses(poses: &[SE2]) -> Self {
        let heading = mean_heading(poses);
        // Offset from the first pose, so that equal poses have residuals of exactly 0.
        let offset_of = |pose: &SE2| {
            Vector3::new(pose.x() - poses[0].x(), pose.y() - poses[0].y(), wrap_angle(pose.theta() - heading))
        };
        let (mean_offset, cov) = mean_and_cov(poses.iter().map(offset_of), poses.len());
        let (x, y) = poses.first().map_or((f64::NAN, f64::NAN), |pose| (pose.x(), pose.y()));
        Self { mean: Vector3::new(x + mean_offset.x, y + mean_offset.y, heading), cov }
    }
}

js_structs! {
    /// Mean and covariance of ξ = x_t ⊟ x_{t−1} in the order (along, lateral, heading): m, m, rad.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct ExponentialMoments {
        /// Arithmetic mean of ξ.
        pub mean: Vector3<f64> as "number[]",
        /// Sample covariance (over n − 1), 3 × 3.
        pub cov: Matrix3<f64> as "number[][]",
    }
}

impl ExponentialMoments {
    /// Returns the moments of ξ = pose ⊟ start of `poses`, which were all driven from the pose `start_pose`. They are NaN as in
    /// [`CartesianMoments::from_poses`].
    ///
    /// The turn of each ξ is on the branch within π of the mean turn, so that poses on both sides of a half turn stay together. For other
    /// clouds ξ equals x_t ⊟ x_{t−1}.
    pub fn from_poses(poses: &[SE2], start_pose: &SE2) -> Self {
        let mean_turn = wrap_angle(mean_heading(poses) - start_pose.theta());
        let start_inverse = start_pose.inverse();
        let twists = poses.iter().map(|pose| (start_inverse * *pose).log_near(mean_turn));
        let first_twist = twists.clone().next().unwrap_or_else(Vector3::zeros);
        let (mean_offset, cov) = mean_and_cov(twists.map(|twist| twist - first_twist), poses.len());
        Self { mean: first_twist + mean_offset, cov }
    }
}

fn mean_heading(poses: &[SE2]) -> f64 {
    let Some(first_pose) = poses.first() else { return f64::NAN };
    let (mut sin_sum, mut cos_sum) = (0.0, 0.0);
    for pose in poses {
        // Angles are relative to the first heading, so that the sines of equal headings sum to exactly 0.
        let (s, c) = libm::sincos(pose.theta() - first_pose.theta());
        sin_sum += s;
        cos_sum += c;
    }
    wrap_angle(first_pose.theta() + libm::atan2(sin_sum, cos_sum))
}

/// Replaces a negative variance, which rounding may have caused, by 0. NaN stays NaN.
pub(crate) fn non_negative(variance: f64) -> f64 {
    if variance < 0.0 { 0.0 } else { variance }
}

fn mean_and_cov(
    sample_vectors: impl Iterator<Item = Vector3<f64>> + Clone,
    vector_count: usize,
) -> (Vector3<f64>, Matrix3<f64>) {
    let vector_count = vector_count as f64;
    let mean = sample_vectors.clone().sum::<Vector3<f64>>() / vector_count;
    let scatter_matrix =
        sample_vectors.map(|vector| (vector - mean) * (vector - mean).transpose()).sum::<Matrix3<f64>>();
    (mean, if vector_count > 1.0 { scatter_matrix / (vector_count - 1.0) } else { Matrix3::repeat(f64::NAN) })
}
