//! The restricted likelihood, compared with one that is computed from a dense covariance matrix.

use super::simulated::{MODELS, Simulation, Violation};
use super::{NAV2, calibrated_log};
use motion::calibrate::{Calibration, Leg, Options, Outliers, Systematic, SystematicError};
use motion::geom::se2::{SE2, wrap_angle};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::f64::consts::TAU;

/// Returns a log of bends in both directions, where no special case of the model applies.
fn bending_drive(count: usize) -> Simulation {
    Simulation {
        drive: Some(|leg| [0.3, [0.3, -0.2, 0.1][leg / 3 % 3]]),
        reference_stds: [0.004, 0.01],
        ..Simulation::of(NAV2, count, 12)
    }
}

/// Returns the Jacobian of a motion or of residuals with respect to three coordinates, by central differences.
fn derivative(function: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Matrix3<f64> {
    const H: f64 = 1e-6;
    let column = |axis: usize| {
        let step = Vector3::from_fn(|k, _| if k == axis { H } else { 0.0 });
        let mut difference = function(step) - function(-step);
        difference.iter_mut().for_each(|angle| *angle = wrap_angle(*angle));
        difference / (2.0 * H)
    };
    Matrix3::from_columns(&[0, 1, 2].map(column))
}

fn coordinates(pose: &SE2) -> Vector3<f64> {
    Vector3::new(pose.x(), pose.y(), pose.theta())
}

/// Returns rot1, trans, rot2 of a motion.
fn reading_of(motion: &Vector3<f64>) -> Vector3<f64> {
    let bearing = libm::atan2(motion.y, motion.x);
    Vector3::new(bearing, libm::hypot(motion.x, motion.y), wrap_angle(motion.z - bearing))
}

/// Returns the Jacobian of (rot1, trans, rot2) with respect to the motion, at the expected motion.
fn reading_jacobian(leg: &Leg, corrected: &Systematic) -> Matrix3<f64> {
    let expected_motion = coordinates(&expected_motion(leg, corrected));
    derivative(|offset| reading_of(&(expected_motion + offset)))
}

/// Returns the motion that the odometry read, with both scales corrected.
fn expected_motion(leg: &Leg, corrected: &Systematic) -> SE2 {
    let twist = leg.odometry[1].boxminus(&leg.odometry[0]);
    SE2::exp(&Vector3::new(
        corrected.distance_scale * twist.x,
        corrected.distance_scale * twist.y,
        corrected.turn_scale * twist.z,
    ))
}

/// Returns the Jacobian of the residuals with respect to the pose error of the reference at one end of a leg.
fn pose_jacobian(leg: &Leg, corrected: &Systematic, end: usize) -> Matrix3<f64> {
    let motion = |error: Vector3<f64>| {
        let mut poses = leg.reference;
        poses[end] = poses[end] * SE2::new(error.x, error.y, error.z);
        let [from, to] = poses.map(|pose| pose * corrected.base());
        coordinates(&(from.inverse() * to))
    };
    reading_jacobian(leg, corrected) * derivative(motion)
}

/// Returns the derivative of the residuals with respect to a systematic error, for a leg without noise.
fn error_derivative(leg: &Leg, corrected: &Systematic, error: SystematicError) -> Vector3<f64> {
    const H: f64 = 1e-6;
    let odometry_motion = expected_motion(leg, corrected);
    let motion_error = |step: f64| {
        let mut changed_errors = *corrected;
        *changed_errors.get_mut(error) += step;
        // The reference has the corrected errors, and its robot moves as the odometry says.
        let mount = |e: &Systematic| SE2::new(e.lever_arm[0], e.lever_arm[1], e.mount_yaw);
        let reference_motion = mount(corrected).inverse() * odometry_motion * mount(corrected);
        let motion = changed_errors.base().inverse() * (reference_motion * changed_errors.base());
        coordinates(&motion) - coordinates(&expected_motion(leg, &changed_errors))
    };
    reading_jacobian(leg, corrected) * (motion_error(H) - motion_error(-H)) / (2.0 * H)
}

/// Returns the restricted log-likelihood, from a dense covariance matrix of all residuals.
fn dense_log_likelihood(calibration: &Calibration, errors: &[SystematicError]) -> f64 {
    let Calibration { legs, observations, corrected, alphas, reference_noise, .. } = calibration;
    let count = 3 * legs.len();
    let [position, yaw] = reference_noise.map(|std| std.value * std.value);
    let reference_covariance = Matrix3::from_diagonal(&Vector3::new(position, position, yaw));
    // Number of poses of the reference. A leg ends at a new pose. It starts at the last pose if it follows another leg, and else at a new one.
    let (mut jacobians, mut poses) = (DMatrix::zeros(count, 3 * (count + 3)), 0);
    let mut covariance = DMatrix::zeros(count, count);
    let mut residuals = DVector::zeros(count);
    let mut design_matrix = DMatrix::zeros(count, errors.len());
    for (i, (leg, observation)) in legs.iter().zip(observations).enumerate() {
        if !leg.follows {
            poses += 1;
        }
        jacobians.fixed_view_mut::<3, 3>(3 * i, 3 * (poses - 1)).copy_from(&pose_jacobian(leg, corrected, 0));
        jacobians.fixed_view_mut::<3, 3>(3 * i, 3 * poses).copy_from(&pose_jacobian(leg, corrected, 1));
        poses += 1;
        for k in 0..3 {
            let [first, second] =
                NAV2.component_alphas()[k].map(|alpha| alphas[alpha].expect("identifiable"));
            let [first_coefficient, second_coefficient] = observation.coefficients[k];
            covariance[(3 * i + k, 3 * i + k)] = first * first_coefficient + second * second_coefficient;
            residuals[3 * i + k] = observation.residuals[k];
        }
        for (column, error) in errors.iter().enumerate() {
            design_matrix
                .fixed_view_mut::<3, 1>(3 * i, column)
                .copy_from(&error_derivative(leg, corrected, *error));
        }
    }
    for pose in 0..poses {
        let jacobian = jacobians.columns(3 * pose, 3);
        covariance += jacobian * reference_covariance * jacobian.transpose();
    }
    let cholesky = covariance.cholesky().expect("positive definite");
    let log_det = |cholesky: &nalgebra::Cholesky<f64, nalgebra::Dyn>| {
        2.0 * cholesky.l().diagonal().map(libm::log).sum()
    };
    let weighted_residuals = cholesky.solve(&residuals);
    let mut deviance = log_det(&cholesky)
        + residuals.dot(&weighted_residuals)
        + (count - errors.len()) as f64 * libm::log(TAU);
    if !errors.is_empty() {
        let information = (design_matrix.transpose() * cholesky.solve(&design_matrix))
            .cholesky()
            .expect("positive definite");
        let gradient = design_matrix.transpose() * weighted_residuals;
        deviance += log_det(&information) - gradient.dot(&information.solve(&gradient));
    }
    -0.5 * deviance
}

/// The relative error of Jacobians by central differences is 1e-9, and there are 120 residuals.
#[test]
fn the_recursion_gives_the_likelihood_of_the_dense_covariance() {
    let sim = bending_drive(40);
    let corrected_errors = [
        SystematicError::MountYaw,
        SystematicError::LeverArmAhead,
        SystematicError::LeverArmLeft,
        SystematicError::DistanceScale,
        SystematicError::TurnScale,
    ];
    for errors in [&corrected_errors[..0], &corrected_errors] {
        let correct = SystematicError::ALL.map(|error| Some(errors.contains(&error)));
        let calibration = calibrated_log(&sim.log(), &Options { correct, ..sim.options() });
        assert_eq!(calibration.leg_fits.iter().filter(|fit| fit.is_outlier).count(), 0);
        let (found, expected) = (calibration.log_likelihood, dense_log_likelihood(&calibration, errors));
        assert!((found - expected).abs() < 1e-5, "{found} is not {expected}");
    }
}

/// Without turns each component has one α. Its estimate α̂ is the mean of r²/c over n residuals r with variances αc. At α = s·α̂ twice the
/// log-likelihood is n(ln s + 1/s − 1) lower.
#[test]
fn an_interval_ends_where_the_profile_likelihood_has_fallen() {
    let sim = Simulation { drive: Some(|_| [0.3, 0.0]), ..Simulation::of(MODELS[3], 400, 3) };
    let exact_options = Options {
        correct: [Some(false); 6],
        position_std: Some(0.0),
        yaw_std: Some(0.0),
        outliers: Outliers::Keep,
        ..sim.options()
    };
    let calibration = calibrated_log(&sim.log(), &exact_options);
    let n = calibration.legs.len() as f64;
    // The noise of translation and strafe grows with the distance only.
    for (component, alpha) in [(1, 2), (2, 4)] {
        let ratio = |observation: &motion::calibrate::Observation| {
            observation.residuals[component].powi(2) / observation.coefficients[component][0]
        };
        let mean = calibration.observations.iter().map(ratio).sum::<f64>() / n;
        let fitted = calibration.alphas[alpha].expect("identifiable");
        assert!((fitted / mean - 1.0).abs() < 1e-3, "{fitted} {mean}");
        for end in calibration.intervals[alpha].expect("identifiable") {
            let scale = end / mean;
            let deviance = n * (libm::log(scale) + 1.0 / scale - 1.0);
            // Intervals may be longer if squared residuals of neighbouring legs are correlated, by chance up to a
            // tenth.
            assert!((3.7..5.2).contains(&deviance), "{deviance}");
        }
    }
}

/// If a robot has the noise of another times 1/100, its α's are those of the other times 1/10,000. Factors of 0.01 and 0.001 are compared,
/// where products of noises are negligible. A difference of a fortieth of an interval is allowed.
#[test]
fn alphas_and_their_intervals_scale_with_the_noise() {
    for model in [MODELS[1], MODELS[3]] {
        let fit_with_noise = |times: f64| {
            let sim = Simulation { violation: Violation::Times(times), ..Simulation::of(model, 1000, 103) };
            let exact_options = Options { position_std: Some(0.0), yaw_std: Some(0.0), ..sim.options() };
            let Calibration { alphas, intervals, .. } = calibrated_log(&sim.log(), &exact_options);
            let divided_by_square = |number: f64| number / (times * times);
            let results = alphas.into_iter().zip(intervals).map(|(alpha, interval)| {
                let [low, high] = interval.expect("identifiable");
                [low, alpha.expect("identifiable"), high].map(divided_by_square)
            });
            results.collect::<Vec<_>>()
        };
        let results_of_larger_noise = fit_with_noise(0.01);
        for (k, (smaller, expected)) in
            fit_with_noise(0.001).into_iter().zip(results_of_larger_noise).enumerate()
        {
            for (number, expected_number) in smaller.into_iter().zip(expected) {
                let allowed = 0.025 * (expected[2] - expected[0]);
                assert!(
                    (number - expected_number).abs() < allowed,
                    "{model:?} α{}: {smaller:?} {expected:?}",
                    k + 1
                );
            }
        }
    }
}

/// The estimated noise of the reference maximizes the likelihood: stated as an option it gives the same likelihood, and
/// any other value a smaller one.
#[test]
fn the_noise_of_the_reference_maximizes_the_likelihood() {
    let sim = Simulation { reference_stds: [0.02, 0.02], ..Simulation::of(NAV2, 400, 5) };
    let log = sim.log();
    // Without corrections all likelihoods are of the same residuals.
    let calibration = |position_std: Option<f64>, yaw_std: Option<f64>| {
        calibrated_log(&log, &Options { correct: [Some(false); 6], position_std, yaw_std, ..sim.options() })
    };
    let estimate = calibration(None, None);
    let [position, yaw] = estimate.reference_noise.map(|std| std.value);
    let value_at = |position: f64, yaw: f64| calibration(Some(position), Some(yaw)).log_likelihood;
    let maximum = estimate.log_likelihood;
    assert!((value_at(position, yaw) - maximum).abs() < 1e-3, "{} {maximum}", value_at(position, yaw));
    for factor in [0.8, 1.25] {
        assert!(
            value_at(factor * position, yaw) < maximum && value_at(position, factor * yaw) < maximum,
            "{factor}"
        );
    }
}
