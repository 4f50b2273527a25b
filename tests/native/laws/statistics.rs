//! Moments, skew, gains and contours do not depend on the unit and frame of a cloud.

use super::doubles::{any_double, new_proptest_config};
use motion::TangentNoiseModel;
use motion::geom::se2::SE2;
use motion::models::TangentNoiseError;
use motion::stats::{CartesianMoments, CrossTrackStats, Ellipse, ExponentialMoments};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;
use std::f64::consts::PI;

/// Relative rounding error of sums of fifty terms, each accurate to a few units in the last place.
const RELATIVE_ROUNDING: f64 = 256.0 * f64::EPSILON;

/// Returns robots around a pose, with headings that differ by less than a quarter turn. Their mean heading is therefore well defined.
fn any_cloud() -> impl Strategy<Value = Vec<SE2>> {
    let coordinates_strategy = (-1.0..1.0, -1.0..1.0, -1.5..1.5);
    (vec(coordinates_strategy, 1..50), (-5.0..5.0, -5.0..5.0, -PI..PI)).prop_map(
        |(robot_coordinates, (x, y, theta))| {
            let centre_pose = SE2::new(x, y, theta);
            robot_coordinates.into_iter().map(|(x, y, theta)| centre_pose * SE2::new(x, y, theta)).collect()
        },
    )
}

fn any_coordinate_frame() -> impl Strategy<Value = SE2> {
    (-10.0..10.0, -10.0..10.0, -PI..PI).prop_map(|(x, y, theta)| SE2::new(x, y, theta))
}

/// Returns covariances L·Lᵀ with entries of common size, of full or lower rank.
fn any_covariance() -> impl Strategy<Value = Matrix3<f64>> {
    vec(prop_oneof![3 => -1.0..1.0, 1 => Just(0.0)], 6).prop_map(|l| {
        let cov_root = Matrix3::new(l[0], 0.0, 0.0, l[1], l[2], 0.0, l[3], l[4], l[5]);
        cov_root * cov_root.transpose()
    })
}

fn is_close(a: f64, b: f64, number_scale: f64) -> bool {
    a == b || (a.is_nan() && b.is_nan()) || (a - b).abs() <= RELATIVE_ROUNDING * number_scale
}

const MAX_ROBOT_DISTANCE: f64 = 20.0;

proptest! {
    #![proptest_config(new_proptest_config(300))]

    #[test]
    fn moments_transform_with_the_frame(robot_cloud in any_cloud(), other_frame in any_coordinate_frame()) {
        let moved_cloud: Vec<SE2> = robot_cloud.iter().map(|pose| other_frame * *pose).collect();
        let [cloud_moments, moved_moments] = [&robot_cloud, &moved_cloud].map(|robot_cloud| CartesianMoments::from_poses(robot_cloud));
        let expected_mean = other_frame * SE2::new(cloud_moments.mean.x, cloud_moments.mean.y, cloud_moments.mean.z);
        let rotation_matrix = SE2::new(0.0, 0.0, other_frame.theta()).adjoint();
        let expected_cov = rotation_matrix * cloud_moments.cov * rotation_matrix.transpose();
        assert_same_moments((&Vector3::new(expected_mean.x(), expected_mean.y(), expected_mean.theta()), &expected_cov), (&moved_moments.mean, &moved_moments.cov))?;
        let [original_moments, moments_in_other_frame] = [(&robot_cloud, SE2::identity()), (&moved_cloud, other_frame)].map(|(robot_cloud, start_pose)| ExponentialMoments::from_poses(robot_cloud, &start_pose));
        // Other clouds are left out: near a full turn exponential coordinates diverge, and near half a turn the mean heading is ambiguous.
        if robot_cloud.iter().all(|pose| pose.theta().abs() < 2.0) {
            assert_same_moments((&original_moments.mean, &original_moments.cov), (&moments_in_other_frame.mean, &moments_in_other_frame.cov))?;
        }
    }

    /// A change of the unit by a power of two, from 10⁻³⁰ m to 10³⁰ m, changes no bit of dimensionless results. A
    /// mirror image changes their sign only.
    #[test]
    fn cross_track_statistics_do_not_depend_on_the_unit(robot_cloud in any_cloud(), exponent_of_two in -100..100i32, is_mirrored in any::<bool>()) {
        let (length_unit, mirror_sign) = (2f64.powi(exponent_of_two), if is_mirrored { -1.0 } else { 1.0 });
        let scaled_cloud: Vec<SE2> =
            robot_cloud.iter().map(|pose| SE2::new(length_unit * pose.x(), mirror_sign * length_unit * pose.y(), mirror_sign * pose.theta())).collect();
        let (a, b) = (CrossTrackStats::from_poses(&robot_cloud), CrossTrackStats::from_poses(&scaled_cloud));
        for (a, b) in [(a.skew, mirror_sign * b.skew), (a.skew_error, b.skew_error), (a.rho_heading, b.rho_heading)] {
            prop_assert!(is_close(a, b, 0.0), "{} {}", a, b);
        }
    }

    /// The tested points are points of the outline, moved by a billionth towards the centre or away from it.
    #[test]
    fn ellipses_contain_points_inside_their_outline_only(a in 0.01..10.0f64, b in 0.01..10.0f64, correlation in -0.99..0.99f64, exponent_of_two in -300..300i32, cloud_centre in (-9.0..9.0, -9.0..9.0)) {
        let length_unit = 2f64.powi(exponent_of_two);
        let cov = Matrix2::new(a * a, correlation * a * b, correlation * a * b, b * b) * (length_unit * length_unit);
        let cloud_centre = Vector2::new(cloud_centre.0, cloud_centre.1) * length_unit;
        let tested_ellipse = Ellipse::new(cloud_centre, cov);
        let expected_area: f64 = 4.0 * PI * a * b * (1.0 - correlation * correlation).sqrt() * length_unit * length_unit;
        prop_assert!(tested_ellipse.has_area() && (tested_ellipse.area() - expected_area).abs() <= 1e-12 * expected_area, "{} {}", tested_ellipse.area(), expected_area);
        prop_assert!(tested_ellipse.contains(cloud_centre.into()));
        let ellipse_outline = tested_ellipse.boundary(32);
        prop_assert_eq!(ellipse_outline.first(), ellipse_outline.last());
        for outline_point in ellipse_outline {
            let scale_point_from_centre = |distance_factor: f64| (cloud_centre + (Vector2::from(outline_point) - cloud_centre) * distance_factor).into();
            prop_assert!(tested_ellipse.contains(scale_point_from_centre(1.0 - 1e-9)) && !tested_ellipse.contains(scale_point_from_centre(1.0 + 1e-9)), "{:?}", outline_point);
        }
    }

    #[test]
    fn matrices_that_are_not_covariances_are_refused(cov in any_covariance(), entry_indices in (0..3usize, 0..3usize), invalid_entry in any_double(), eigenvalue_reduction in 0.01..1.0) {
        let mut changed_cov = cov;
        changed_cov[entry_indices] = invalid_entry;
        match TangentNoiseModel::new(changed_cov) {
            Ok(tangent_model) => prop_assert_eq!(tangent_model.r, changed_cov),
            Err(covariance_error) => prop_assert_eq!(covariance_error == TangentNoiseError::NotFinite, !invalid_entry.is_finite()),
        }
        let indefinite_matrix = cov - Matrix3::identity() * (cov.symmetric_eigenvalues().min().max(0.0) + eigenvalue_reduction);
        prop_assert_eq!(TangentNoiseModel::new(indefinite_matrix), Err(TangentNoiseError::NotPositiveSemidefinite));
        if entry_indices.0 != entry_indices.1 {
            let mut asymmetric_cov = cov;
            asymmetric_cov[entry_indices] += eigenvalue_reduction * (1.0 + cov.amax());
            prop_assert_eq!(TangentNoiseModel::new(asymmetric_cov), Err(TangentNoiseError::NotSymmetric));
        }
    }
}

fn assert_same_moments(
    (mean, cov): (&Vector3<f64>, &Matrix3<f64>),
    (other_mean, other_cov): (&Vector3<f64>, &Matrix3<f64>),
) -> Result<(), TestCaseError> {
    let (distance_bound, heading_difference) =
        (MAX_ROBOT_DISTANCE, libm::remainder(mean.z - other_mean.z, 2.0 * PI));
    prop_assert!(
        is_close(mean.x, other_mean.x, distance_bound) && is_close(mean.y, other_mean.y, distance_bound),
        "{} {}",
        mean,
        other_mean
    );
    prop_assert!(is_close(heading_difference, 0.0, distance_bound), "{} {}", mean, other_mean);
    let are_close =
        cov.iter().zip(other_cov.iter()).all(|(a, b)| is_close(*a, *b, distance_bound * distance_bound));
    prop_assert!(are_close, "{} {}", cov, other_cov);
    Ok(())
}
