//! All numbers of the chapter's worked example: v = 1, ω = 0.5, Δt = 1, α₁₋₄ = 0.02, α₅,₆ = 0, from the origin.
//!
//! The tests use `SmallRng`, as the chapter's listing does. Printed numbers are checked to half a unit of their last digit. Measured
//! numbers are checked to 4.5 standard errors, which are estimated from 100 batches of the sample. The tolerance is √2 times larger,
//! because the chapter's measurements have their own errors.

use crate::common::{MAX_STANDARD_ERRORS, estimate_with_standard_error};
use approx::assert_relative_eq;
use motion::geom::se2::SE2;
use motion::models::PolarMotion;
use motion::stats::{CartesianMoments, ExactMoments, ExponentialMoments};
use motion::{MotionModel, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel};
use nalgebra::{Matrix3, Vector3};
use rand::{SeedableRng, rngs::SmallRng};

const U: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
const ALPHAS: VelocityAlphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]);
const MODEL: VelocityModel = VelocityModel { alphas: ALPHAS, noise: NoiseKind::Normal };
const SAMPLE_COUNT: usize = 200_000;

fn sample_cloud(velocity_model: &VelocityModel) -> Vec<SE2> {
    let mut rng = SmallRng::seed_from_u64(7);
    (0..SAMPLE_COUNT).map(|_| velocity_model.sample(&U, &SE2::identity(), &mut rng)).collect()
}

fn assert_equals_printed(computed_value: f64, printed: f64, decimals: i32, quantity: &str) {
    let tolerance = 0.5 * 10f64.powi(-decimals) * (1.0 + 1e-9);
    assert!((computed_value - printed).abs() <= tolerance, "{quantity}: {computed_value}, printed {printed}");
}

/// Asserts that a printed estimate agrees with a measured one. Both estimates come from 200 000 samples each.
fn assert_printed_estimate(quantity: &str, measured: f64, standard_error: f64, printed: f64, decimals: i32) {
    let tolerance = MAX_STANDARD_ERRORS * 2f64.sqrt() * standard_error + 0.5 * 10f64.powi(-decimals);
    assert!(
        (measured - printed).abs() < tolerance,
        "{quantity}: {measured} ± {standard_error}, printed {printed}"
    );
}

#[test]
fn the_arc_and_the_exponential_map_end_at_the_printed_pose() {
    let velocity_model = VelocityModel { alphas: VelocityAlphas([0.0; 6]), noise: NoiseKind::Normal };
    let end_of_arc = velocity_model.sample(&U, &SE2::identity(), &mut SmallRng::seed_from_u64(0));
    let twist_end = SE2::exp(&Vector3::new(U.v * U.dt, 0.0, U.omega * U.dt));
    for end_pose in [end_of_arc, twist_end] {
        assert_relative_eq!(end_pose.x(), 0.958_851_077_208, epsilon = 1e-12);
        assert_relative_eq!(end_pose.y(), 0.244_834_876_219, epsilon = 1e-12);
        assert_eq!(end_pose.theta(), 0.5);
    }
    assert_relative_eq!(end_of_arc.x(), 2.0 * 0.5f64.sin(), epsilon = 1e-15);
    assert_relative_eq!(end_of_arc.y(), 2.0 * (1.0 - 0.5f64.cos()), epsilon = 1e-15);
}

#[test]
fn linearized_moments_equal_the_printed_table() {
    let cov = MODEL.cartesian_cov(&U, &SE2::identity());
    for (cov_entry, printed, quantity) in [
        ((0, 0), 0.023645, "Σxx"),
        ((1, 1), 0.007002, "Σyy"),
        ((2, 2), 0.025000, "Σθθ"),
        ((0, 1), 0.003963, "Σxy"),
        ((0, 2), -0.004063, "Σxθ"),
        ((1, 2), 0.011730, "Σyθ"),
    ] {
        assert_equals_printed(cov[cov_entry], printed, 6, quantity);
        assert_relative_eq!(cov[cov_entry], cov[(cov_entry.1, cov_entry.0)], epsilon = 1e-17);
    }
    assert_equals_printed(cov[(1, 2)] / (cov[(1, 1)] * cov[(2, 2)]).sqrt(), 0.887, 3, "ρyθ");
    // The columns of the Jacobian are the derivatives of the arc with respect to v and ω. With a single α of 1 the covariance is the
    // outer product of one column.
    let linearized_covariance_of = |alphas: [f64; 6]| {
        let velocity_model = VelocityModel { alphas: VelocityAlphas(alphas), noise: NoiseKind::Normal };
        velocity_model.cartesian_cov(&U, &SE2::identity())
    };
    let covariance_by_v = linearized_covariance_of([1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let covariance_by_omega = linearized_covariance_of([0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    assert_equals_printed(covariance_by_v[(0, 0)].sqrt(), 0.958851, 6, "∂x/∂v");
    assert_equals_printed(covariance_by_v[(1, 0)] / covariance_by_v[(0, 0)].sqrt(), 0.244835, 6, "∂y/∂v");
    assert_eq!(covariance_by_v[(2, 2)], 0.0);
    assert_equals_printed(covariance_by_omega[(0, 2)], -0.162537, 6, "∂x/∂ω");
    assert_equals_printed(covariance_by_omega[(1, 2)], 0.469181, 6, "∂y/∂ω");
    assert_relative_eq!(covariance_by_omega[(2, 2)], 1.0, epsilon = 1e-15);
}

#[test]
fn exact_moments_equal_the_printed_table() {
    let exact_moments = ExactMoments::new(&PolarMotion::of_velocity(&MODEL, &U));
    assert_equals_printed(exact_moments.mean.x, 0.955006501, 9, "mean x");
    assert_equals_printed(exact_moments.mean.y, 0.243321663, 9, "mean y");
    assert_eq!(exact_moments.mean.z, 0.5);
    assert_equals_printed(exact_moments.cov[(0, 0)], 0.023497983, 9, "Σxx");
    assert_equals_printed(exact_moments.cov[(1, 1)], 0.007057304, 9, "Σyy");
    assert_equals_printed(exact_moments.cross_track_skew, -0.30056, 5, "skew");
    let opening_alphas = VelocityAlphas([0.05, 0.05, 0.05, 0.09, 0.01, 0.01]);
    let opening_moments =
        ExactMoments::new(&PolarMotion::of_velocity(&VelocityModel { alphas: opening_alphas, ..MODEL }, &U));
    assert_equals_printed(opening_moments.cross_track_skew, -0.43093, 5, "skew of the opening command");
}

#[test]
fn measured_moments_agree_with_the_printed_table() {
    let pose_cloud = sample_cloud(&MODEL);
    let exact_moments = ExactMoments::new(&PolarMotion::of_velocity(&MODEL, &U));
    let exact_correlation =
        exact_moments.cov[(1, 2)] / (exact_moments.cov[(1, 1)] * exact_moments.cov[(2, 2)]).sqrt();
    let cov_entry_of = |i, j| move |poses: &[SE2]| CartesianMoments::from_poses(poses).cov[(i, j)];
    let xi_mean_of = |i| move |poses: &[SE2]| ExponentialMoments::from_poses(poses, &SE2::identity()).mean[i];
    let xi_cov = |i| move |poses: &[SE2]| ExponentialMoments::from_poses(poses, &SE2::identity()).cov[(i, i)];
    let lateral_heading_correlation_of = |poses: &[SE2]| {
        let cov = CartesianMoments::from_poses(poses).cov;
        cov[(1, 2)] / (cov[(1, 1)] * cov[(2, 2)]).sqrt()
    };
    type Statistic = Box<dyn Fn(&[SE2]) -> f64>;
    let named_statistics: [(&str, Statistic, f64, i32, f64); 10] = [
        ("Σxx", Box::new(cov_entry_of(0, 0)), 0.02355, 5, exact_moments.cov[(0, 0)]),
        ("Σyy", Box::new(cov_entry_of(1, 1)), 0.00710, 5, exact_moments.cov[(1, 1)]),
        ("Σxθ", Box::new(cov_entry_of(0, 2)), -0.00403, 5, exact_moments.cov[(0, 2)]),
        ("ρyθ", Box::new(lateral_heading_correlation_of), 0.878, 3, exact_correlation),
        ("E ξ along", Box::new(xi_mean_of(0)), 1.0005, 4, 1.0),
        ("E ξ heading", Box::new(xi_mean_of(2)), 0.4994, 4, 0.5),
        ("Cov ξ along", Box::new(xi_cov(0)), 0.02508, 5, 0.025),
        ("Cov ξ heading", Box::new(xi_cov(2)), 0.02505, 5, 0.025),
        ("skew", Box::new(motion::stats::cross_track_skew), -0.301, 3, exact_moments.cross_track_skew),
        ("E x", Box::new(|poses| CartesianMoments::from_poses(poses).mean.x), 0.955, 3, exact_moments.mean.x),
    ];
    for (quantity, statistic_of, printed, decimals, exact_value) in named_statistics {
        let (measured, standard_error) = estimate_with_standard_error(&pose_cloud, statistic_of);
        assert!(
            (measured - exact_value).abs() < MAX_STANDARD_ERRORS * standard_error,
            "{quantity}: {measured} ± {standard_error}, exactly {exact_value}"
        );
        assert_printed_estimate(quantity, measured, standard_error, printed, decimals);
    }
    let exponential_moments = ExponentialMoments::from_poses(&pose_cloud, &SE2::identity());
    assert!(
        exponential_moments.mean.y.abs() < 1e-15 && exponential_moments.cov[(1, 1)] < 1e-30,
        "printed 0.0000 and 0.00000"
    );
}

/// The predicted heading variance includes the last turn γ̂. The prediction omits the small variance that the last turn adds to the lateral
/// exponential coordinate.
#[test]
fn a_last_turn_adds_variance_to_the_lateral_coordinate() {
    let velocity_model =
        VelocityModel { alphas: VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.005, 0.005]), ..MODEL };
    let pose_cloud = sample_cloud(&velocity_model);
    let tangent_model = TangentNoiseModel::from_velocity(&velocity_model, &U).unwrap();
    let predicted_cov = tangent_model.compound(&Matrix3::zeros(), &TangentNoiseModel::twist(&U));
    assert_relative_eq!(predicted_cov[(2, 2)], 0.03125, epsilon = 1e-16);
    assert_eq!(predicted_cov[(1, 1)], 0.0);
    let exponential_variance =
        |i| move |poses: &[SE2]| ExponentialMoments::from_poses(poses, &SE2::identity()).cov[(i, i)];
    for (xi_component, printed) in [(2, 0.0312), (1, 0.0016)] {
        let (measured, standard_error) =
            estimate_with_standard_error(&pose_cloud, exponential_variance(xi_component));
        assert_printed_estimate(&format!("axis {xi_component}"), measured, standard_error, printed, 4);
    }
}
