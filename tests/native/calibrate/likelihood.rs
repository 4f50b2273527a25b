//! The restricted likelihood and its maximum, compared with a likelihood that is computed from a dense covariance matrix.

use super::simulated::{MODELS, Simulation, Violation};
use super::{NAV2, calibrate_log, calibrate_simulation, options_of};
use motion::calibrate::{Calibration, Drive, Leg, LegLength, Options, Outliers, Systematic, SystematicError};
use motion::geom::se2::{SE2, wrap_angle};
use motion::sim::alpha_calibrator::example::simulate_log;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

/// Returns a simulation of bends to the left and to the right, where no special case of the model applies.
fn new_bend_simulation(leg_count: usize) -> Simulation {
    Simulation {
        velocity_of_leg: Some(|leg_index| [0.3, [0.3, -0.2, 0.1][leg_index / 3 % 3]]),
        reference_stds: [0.004, 0.01],
        ..Simulation::new(NAV2, leg_count, 12)
    }
}

/// Returns the Jacobian of a function at 0, by central differences. Angles are wrapped.
fn jacobian_of(evaluate_at: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Matrix3<f64> {
    const H: f64 = 1e-6;
    let jacobian_column_of = |axis_index: usize| {
        let argument_offset = Vector3::from_fn(|k, _| if k == axis_index { H } else { 0.0 });
        let mut central_difference = evaluate_at(argument_offset) - evaluate_at(-argument_offset);
        central_difference.iter_mut().for_each(|difference| *difference = wrap_angle(*difference));
        central_difference / (2.0 * H)
    };
    Matrix3::from_columns(&[0, 1, 2].map(jacobian_column_of))
}

fn coordinates_of(pose: &SE2) -> Vector3<f64> {
    Vector3::new(pose.x(), pose.y(), pose.theta())
}

fn odometry_reading_of(robot_motion: &Vector3<f64>) -> Vector3<f64> {
    let bearing = libm::atan2(robot_motion.y, robot_motion.x);
    Vector3::new(bearing, libm::hypot(robot_motion.x, robot_motion.y), wrap_angle(robot_motion.z - bearing))
}

/// Returns the Jacobian of (rot1, trans, rot2) with respect to the motion, at the expected motion.
fn reading_jacobian_of(leg: &Leg, systematic_errors: &Systematic) -> Matrix3<f64> {
    let expected_motion = coordinates_of(&expected_motion_of(leg, systematic_errors));
    jacobian_of(|motion_offset| odometry_reading_of(&(expected_motion + motion_offset)))
}

/// Returns the motion that the odometry measured, with the scales of distance and turn corrected.
fn expected_motion_of(leg: &Leg, systematic_errors: &Systematic) -> SE2 {
    let twist = leg.odometry[1].boxminus(&leg.odometry[0]);
    SE2::exp(&Vector3::new(
        systematic_errors.distance_scale * twist.x,
        systematic_errors.distance_scale * twist.y,
        systematic_errors.turn_scale * twist.z,
    ))
}

/// Returns the Jacobian of the residuals with respect to the pose error of the reference at one end of a leg.
fn pose_jacobian(leg: &Leg, systematic_errors: &Systematic, end_index: usize) -> Matrix3<f64> {
    let motion_with_pose_error = |pose_error: Vector3<f64>| {
        let mut reference_poses = leg.reference;
        reference_poses[end_index] =
            reference_poses[end_index] * SE2::new(pose_error.x, pose_error.y, pose_error.z);
        let [start_pose, end_pose] = reference_poses.map(|pose| pose * systematic_errors.base());
        coordinates_of(&(start_pose.inverse() * end_pose))
    };
    reading_jacobian_of(leg, systematic_errors) * jacobian_of(motion_with_pose_error)
}

fn error_derivative(leg: &Leg, systematic_errors: &Systematic, error_kind: SystematicError) -> Vector3<f64> {
    const H: f64 = 1e-6;
    let odometry_motion = expected_motion_of(leg, systematic_errors);
    let motion_error_after = |error_change: f64| {
        let mut changed_errors = *systematic_errors;
        *changed_errors.get_mut(error_kind) += error_change;
        // In the simulated reference, the sensor is mounted with `systematic_errors`, and the robot executes the motion that
        // odometry measured.
        let mount_pose_of = |mounting_errors: &Systematic| {
            SE2::new(mounting_errors.lever_arm[0], mounting_errors.lever_arm[1], mounting_errors.mount_yaw)
        };
        let reference_motion =
            mount_pose_of(systematic_errors).inverse() * odometry_motion * mount_pose_of(systematic_errors);
        let measured_motion = changed_errors.base().inverse() * (reference_motion * changed_errors.base());
        coordinates_of(&measured_motion) - coordinates_of(&expected_motion_of(leg, &changed_errors))
    };
    reading_jacobian_of(leg, systematic_errors) * (motion_error_after(H) - motion_error_after(-H)) / (2.0 * H)
}

/// Returns the restricted log-likelihood, from a dense covariance matrix of the residuals of all legs but the outliers.
fn compute_dense_log_likelihood(calibration: &Calibration, error_kinds: &[SystematicError]) -> f64 {
    let Calibration { legs, observations, leg_fits, corrected, alphas, reference_noise, .. } = calibration;
    let fitted_legs: Vec<usize> = (0..legs.len()).filter(|leg| !leg_fits[*leg].is_outlier).collect();
    let residual_count = 3 * fitted_legs.len();
    let [position_variance, yaw_variance] =
        reference_noise.map(|std_estimate| std_estimate.value * std_estimate.value);
    let reference_covariance =
        Matrix3::from_diagonal(&Vector3::new(position_variance, position_variance, yaw_variance));
    // `pose_count` counts poses of the reference. Successive legs share a pose. Any other leg starts at a new pose.
    let (mut pose_jacobians, mut pose_count) = (DMatrix::zeros(residual_count, 3 * (residual_count + 3)), 0);
    let mut residual_covariance = DMatrix::zeros(residual_count, residual_count);
    let mut stacked_residuals = DVector::zeros(residual_count);
    let mut design_matrix = DMatrix::zeros(residual_count, error_kinds.len());
    for (i, leg_index) in fitted_legs.into_iter().enumerate() {
        let (leg, observation) = (&legs[leg_index], &observations[leg_index]);
        if !leg.follows || leg_fits[leg_index - 1].is_outlier {
            pose_count += 1;
        }
        pose_jacobians
            .fixed_view_mut::<3, 3>(3 * i, 3 * (pose_count - 1))
            .copy_from(&pose_jacobian(leg, corrected, 0));
        pose_jacobians
            .fixed_view_mut::<3, 3>(3 * i, 3 * pose_count)
            .copy_from(&pose_jacobian(leg, corrected, 1));
        pose_count += 1;
        for k in 0..3 {
            let [first_alpha, second_alpha] =
                NAV2.component_alphas()[k].map(|alpha_index| alphas[alpha_index].expect("identifiable"));
            let [first_coefficient, second_coefficient] = observation.coefficients[k];
            residual_covariance[(3 * i + k, 3 * i + k)] =
                first_alpha * first_coefficient + second_alpha * second_coefficient;
            stacked_residuals[3 * i + k] = observation.residuals[k];
        }
        for (column_index, error_kind) in error_kinds.iter().enumerate() {
            let residual_derivative = error_derivative(leg, corrected, *error_kind);
            design_matrix.fixed_view_mut::<3, 1>(3 * i, column_index).copy_from(&residual_derivative);
        }
    }
    for pose_index in 0..pose_count {
        let pose_jacobian = pose_jacobians.columns(3 * pose_index, 3);
        residual_covariance += pose_jacobian * reference_covariance * pose_jacobian.transpose();
    }
    let cholesky_factor = residual_covariance.cholesky().expect("positive definite");
    let log_det = |cholesky_factor: &nalgebra::Cholesky<f64, nalgebra::Dyn>| {
        2.0 * cholesky_factor.l().diagonal().map(libm::log).sum()
    };
    let weighted_residuals = cholesky_factor.solve(&stacked_residuals);
    let mut minus_two_log_likelihood = log_det(&cholesky_factor)
        + stacked_residuals.dot(&weighted_residuals)
        + (residual_count - error_kinds.len()) as f64 * libm::log(TAU);
    if !error_kinds.is_empty() {
        let error_information = (design_matrix.transpose() * cholesky_factor.solve(&design_matrix))
            .cholesky()
            .expect("positive definite");
        let error_gradient = design_matrix.transpose() * weighted_residuals;
        minus_two_log_likelihood +=
            log_det(&error_information) - error_gradient.dot(&error_information.solve(&error_gradient));
    }
    -0.5 * minus_two_log_likelihood
}

/// The tolerance allows for 120 residuals, whose Jacobians by central differences have a relative error of 1e-9.
#[test]
fn the_filter_gives_the_likelihood_of_a_dense_covariance_matrix() {
    let sim = new_bend_simulation(40);
    let five_errors = [
        SystematicError::MountYaw,
        SystematicError::LeverArmAhead,
        SystematicError::LeverArmLeft,
        SystematicError::DistanceScale,
        SystematicError::TurnScale,
    ];
    for corrected_kinds in [&five_errors[..0], &five_errors] {
        let correction_options =
            SystematicError::ALL.map(|error_kind| Some(corrected_kinds.contains(&error_kind)));
        let calibration = calibrate_log(
            &sim.simulate_log(),
            &Options { correct: correction_options, ..sim.calibration_options() },
        );
        assert_eq!(calibration.leg_fits.iter().filter(|leg_fit| leg_fit.is_outlier).count(), 0);
        let (log_likelihood, dense_value) =
            (calibration.log_likelihood, compute_dense_log_likelihood(&calibration, corrected_kinds));
        assert!((log_likelihood - dense_value).abs() < 1e-5, "{log_likelihood} is not {dense_value}");
    }
}

/// A search with a wrong score ends beside the maximum. At the maximum, each derivative of the likelihood is 0, up to the tolerance of the
/// search: 0.014 in units of the parameter's standard error.
#[test]
fn a_fit_with_outliers_and_breaks_maximizes_the_likelihood_of_a_dense_covariance_matrix() {
    let sim = Simulation {
        jump_fraction: 0.1,
        velocity_of_leg: Some(|leg_index| [0.3, [0.7, -0.5, 0.1][leg_index / 3 % 3]]),
        ..new_bend_simulation(80)
    };
    let [odometry_log, reference_log] = sim.simulate_log();
    let reference_with_breaks = reference_log.with_breaks_before([200, 500]);
    let corrected_kinds = [SystematicError::DistanceScale, SystematicError::TurnScale];
    let correction_options =
        SystematicError::ALL.map(|error_kind| Some(corrected_kinds.contains(&error_kind)));
    let fit = calibrate_log(
        &[odometry_log, reference_with_breaks],
        &Options { correct: correction_options, ..sim.calibration_options() },
    );
    let outlier_count = fit.leg_fits.iter().filter(|leg_fit| leg_fit.is_outlier).count();
    assert!(outlier_count >= 4 && fit.lost.across_breaks == 2, "{outlier_count} {:?}", fit.lost);
    let log_likelihood_of =
        |calibration: &Calibration| compute_dense_log_likelihood(calibration, &corrected_kinds);
    assert!((fit.log_likelihood - log_likelihood_of(&fit)).abs() < 1e-5);
    for parameter in 0..6 {
        let log_likelihood_at = |relative_change: f64| {
            let mut changed_fit = fit.clone();
            match parameter {
                0..4 => {
                    changed_fit.alphas[parameter] =
                        fit.alphas[parameter].map(|alpha| (1.0 + relative_change) * alpha)
                }
                _ => changed_fit.reference_noise[parameter - 4].value *= (1.0 + relative_change).sqrt(),
            }
            log_likelihood_of(&changed_fit)
        };
        const H: f64 = 1e-3;
        let [below, middle, above] = [-H, 0.0, H].map(log_likelihood_at);
        let (gradient, curvature) = ((above - below) / (2.0 * H), (2.0 * middle - above - below) / (H * H));
        assert!(gradient.abs() < 0.014 * curvature.sqrt(), "parameter {parameter}: {gradient} {curvature}");
    }
}

/// An error of the reference of 20 mm on legs of 16 mm changes the first rotation by several radians, and the second by as much in the
/// opposite direction. Their sum, the turn of the leg, stays small if the second rotation is not wrapped.
#[test]
fn rotations_of_a_short_leg_add_up_to_its_turn() {
    let sim = Simulation {
        velocity_of_leg: Some(|_| [0.02, 0.1]),
        leg_length: LegLength::Duration { duration: 0.8 },
        reference_stds: [0.02, 0.02],
        ..Simulation::new(NAV2, 200, 9)
    };
    let reading_residuals =
        calibrate_simulation(&sim).observations.into_iter().map(|observation| observation.residuals);
    let (max_rotation, max_turn) =
        reading_residuals.fold((0.0, 0.0), |(rotation_so_far, turn_so_far), [rot1, _, rot2]| {
            (f64::max(rotation_so_far, rot2.abs()), f64::max(turn_so_far, (rot1 + rot2).abs()))
        });
    assert!(max_rotation > PI && max_turn < 0.2, "{max_rotation} {max_turn}");
}

/// The innovation of a leg equals its residual if the filter knows nothing about the reference's error at the start of the leg. That holds
/// for the leg after an outlier.
#[test]
fn an_outlier_shares_no_reference_error_with_the_next_leg() {
    let sim =
        Simulation { jump_fraction: 0.05, reference_stds: [0.005, 0.002], ..Simulation::new(NAV2, 300, 8) };
    let uncorrected_options = Options { correct: [Some(false); 6], ..sim.calibration_options() };
    let Calibration { leg_fits, legs, observations: leg_observations, .. } =
        calibrate_log(&sim.simulate_log(), &uncorrected_options);
    assert!(leg_fits.iter().filter(|leg_fit| leg_fit.is_outlier).count() > 10);
    for (i, (leg_fit, observation)) in leg_fits.iter().zip(leg_observations).enumerate() {
        let has_no_prior_error = !legs[i].follows || leg_fits[i - 1].is_outlier;
        let leg_innovation = leg_fit.standardized[1] * leg_fit.stds[1];
        assert_eq!((leg_innovation - observation.residuals[1]).abs() < 1e-12, has_no_prior_error, "leg {i}");
    }
}

/// Without turns each component has one α. Its estimate α̂ is the mean of r²/c over n residuals r with variances αc. At α = s·α̂ the deviance
/// is higher by n(ln s + 1/s − 1).
#[test]
fn an_interval_ends_where_the_profile_likelihood_has_fallen() {
    let sim = Simulation { velocity_of_leg: Some(|_| [0.3, 0.0]), ..Simulation::new(MODELS[3], 400, 3) };
    let exact_options = Options {
        correct: [Some(false); 6],
        position_std: Some(0.0),
        yaw_std: Some(0.0),
        outliers: Outliers::Keep,
        ..sim.calibration_options()
    };
    let calibration = calibrate_log(&sim.simulate_log(), &exact_options);
    let leg_count = calibration.legs.len() as f64;
    for (component_index, alpha_index) in [(1, 2), (2, 4)] {
        let estimate_alpha = |observation: &motion::calibrate::Observation| {
            observation.residuals[component_index].powi(2) / observation.coefficients[component_index][0]
        };
        let expected_alpha = calibration.observations.iter().map(estimate_alpha).sum::<f64>() / leg_count;
        let fitted_alpha = calibration.alphas[alpha_index].expect("identifiable");
        assert!((fitted_alpha / expected_alpha - 1.0).abs() < 1e-3, "{fitted_alpha} {expected_alpha}");
        for interval_bound in calibration.intervals[alpha_index].expect("identifiable") {
            let alpha_ratio = interval_bound / expected_alpha;
            let minus_two_log_likelihood = leg_count * (libm::log(alpha_ratio) + 1.0 / alpha_ratio - 1.0);
            // At the ends of a 95 % interval the deviance is 3.84, or higher if neighbouring squared residuals are correlated by chance.
            assert!((3.7..5.2).contains(&minus_two_log_likelihood), "{minus_two_log_likelihood}");
        }
    }
}

/// α's are proportional to the square of the noise. Noise factors of 0.01 and 0.001 are compared, where products of noises are negligible. A
/// difference of a fortieth of an interval is allowed.
#[test]
fn alphas_and_their_intervals_scale_with_the_noise() {
    for model in [MODELS[1], MODELS[3]] {
        let calibrate_scaled_noise = |std_factor: f64| {
            let sim = Simulation {
                noise_violation: Violation::ScaledNoise(std_factor),
                ..Simulation::new(model, 1000, 103)
            };
            let exact_options =
                Options { position_std: Some(0.0), yaw_std: Some(0.0), ..sim.calibration_options() };
            let Calibration { alphas, intervals: alpha_intervals, .. } =
                calibrate_log(&sim.simulate_log(), &exact_options);
            let divide_by_squared_factor = |interval_bound: f64| interval_bound / (std_factor * std_factor);
            let bounds_and_alphas = alphas.into_iter().zip(alpha_intervals).map(|(alpha, alpha_interval)| {
                let [lower_bound, upper_bound] = alpha_interval.expect("identifiable");
                [lower_bound, alpha.expect("identifiable"), upper_bound].map(divide_by_squared_factor)
            });
            bounds_and_alphas.collect::<Vec<_>>()
        };
        let bounds_of_larger_noise = calibrate_scaled_noise(0.01);
        for (k, (scaled_bounds, expected_bounds)) in
            calibrate_scaled_noise(0.001).into_iter().zip(bounds_of_larger_noise).enumerate()
        {
            for (interval_bound, expected_bound) in scaled_bounds.into_iter().zip(expected_bounds) {
                let bound_tolerance = 0.025 * (expected_bounds[2] - expected_bounds[0]);
                assert!(
                    (interval_bound - expected_bound).abs() < bound_tolerance,
                    "{model:?} α{}: {scaled_bounds:?} {expected_bounds:?}",
                    k + 1
                );
            }
        }
    }
}

#[test]
fn the_estimated_noise_of_the_reference_as_an_option_gives_the_same_likelihood() {
    let sim = Simulation { reference_stds: [0.02, 0.02], ..Simulation::new(NAV2, 1500, 5) };
    let simulated_log = sim.simulate_log();
    // Systematic errors are not corrected, so that both likelihoods are of the same residuals.
    let calibrate_with_stds = |[position_std, yaw_std]: [Option<f64>; 2]| {
        calibrate_log(
            &simulated_log,
            &Options { correct: [Some(false); 6], position_std, yaw_std, ..sim.calibration_options() },
        )
    };
    let fit = calibrate_with_stds([None, None]);
    let fit_with_options = calibrate_with_stds(fit.reference_noise.map(|noise_std| Some(noise_std.value)));
    let [log_likelihood, likelihood_with_options] = [fit.log_likelihood, fit_with_options.log_likelihood];
    assert!(
        (likelihood_with_options - log_likelihood).abs() < 1e-3,
        "{likelihood_with_options} {log_likelihood}"
    );
}

/// The reference jumps by half a metre and back. If the legs with the jumps are kept, the likelihood has a lower, local maximum at zero
/// reference noise.
#[test]
fn the_search_finds_the_larger_of_two_maxima() {
    let Drive { odometry: odometry_log, reference: reference_log } = simulate_log(3);
    let log_likelihood_with = |position_std| {
        let keep_options = Options { outliers: Outliers::Keep, position_std, ..options_of(MODELS[0]) };
        calibrate_log(&[odometry_log.clone(), reference_log.clone()], &keep_options).log_likelihood
    };
    let [likelihood_of_estimate, likelihood_of_option] = [None, Some(0.04)].map(log_likelihood_with);
    assert!(likelihood_of_estimate > likelihood_of_option, "{likelihood_of_estimate}");
}
