//! The restricted likelihood, against one with a dense covariance.

use super::simulated::{MODELS, Simulation, Violation};
use super::{NAV2, calibrated_log};
use motion::calibrate::{Calibration, Leg, Options, Outliers, Systematic, SystematicError};
use motion::geom::se2::{SE2, wrap_angle};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::f64::consts::TAU;

/// Returns a log of bends in both directions, where no special case of the model applies.
fn drive_in_bends(count: usize) -> Simulation {
    Simulation {
        drive: Some(|leg| [0.3, [0.3, -0.2, 0.1][leg / 3 % 3]]),
        reference_stds: [0.004, 0.01],
        ..Simulation::of(NAV2, count, 12)
    }
}

/// Returns central differences of a motion or of residuals by three coordinates.
fn derivative(value: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Matrix3<f64> {
    const H: f64 = 1e-6;
    let column = |axis: usize| {
        let step = Vector3::from_fn(|k, _| if k == axis { H } else { 0.0 });
        let mut change = value(step) - value(-step);
        change.iter_mut().for_each(|each| *each = wrap_angle(*each));
        change / (2.0 * H)
    };
    Matrix3::from_columns(&[0, 1, 2].map(column))
}

fn coordinates(pose: &SE2) -> Vector3<f64> {
    Vector3::new(pose.x(), pose.y(), pose.theta())
}

/// Returns rot1, trans, rot2 of a motion.
fn reading(motion: &Vector3<f64>) -> Vector3<f64> {
    let first = libm::atan2(motion.y, motion.x);
    Vector3::new(first, libm::hypot(motion.x, motion.y), wrap_angle(motion.z - first))
}

/// Returns the Jacobian of (rot1, trans, rot2) by the motion, at the expected motion.
fn by_motion(leg: &Leg, corrected: &Systematic) -> Matrix3<f64> {
    let expected = coordinates(&expected(leg, corrected));
    derivative(|off| reading(&(expected + off)))
}

/// Returns the motion that the odometry read, with both scales corrected.
fn expected(leg: &Leg, corrected: &Systematic) -> SE2 {
    let twist = leg.odometry[1].boxminus(&leg.odometry[0]);
    SE2::exp(&Vector3::new(
        corrected.distance_scale * twist.x,
        corrected.distance_scale * twist.y,
        corrected.turn_scale * twist.z,
    ))
}

/// Returns the Jacobian of the residuals by the error of the reference at one end of a leg.
fn by_pose(leg: &Leg, corrected: &Systematic, end: usize) -> Matrix3<f64> {
    let motion = |error: Vector3<f64>| {
        let mut poses = leg.reference;
        poses[end] = poses[end] * SE2::new(error.x, error.y, error.z);
        let [from, to] = poses.map(|pose| pose * corrected.base());
        coordinates(&(from.inverse() * to))
    };
    by_motion(leg, corrected) * derivative(motion)
}

/// Returns the derivative of the residuals by a systematic error, for a leg without noise.
fn by_error(leg: &Leg, corrected: &Systematic, error: SystematicError) -> Vector3<f64> {
    const H: f64 = 1e-6;
    let read = expected(leg, corrected);
    let off = |step: f64| {
        let mut changed = *corrected;
        *changed.get_mut(error) += step;
        // Returns a reference that equals the odometry.
        let mount = |of: &Systematic| SE2::new(of.lever_arm[0], of.lever_arm[1], of.mount_yaw);
        let seen = mount(corrected).inverse() * read * mount(corrected);
        let motion = changed.base().inverse() * (seen * changed.base());
        coordinates(&motion) - coordinates(&expected(leg, &changed))
    };
    by_motion(leg, corrected) * (off(H) - off(-H)) / (2.0 * H)
}

/// Returns the restricted log-likelihood by a dense covariance of all residuals.
fn dense_log_likelihood(calibration: &Calibration, errors: &[SystematicError]) -> f64 {
    let Calibration { legs, observations, corrected, alphas, reference_noise, .. } = calibration;
    let count = 3 * legs.len();
    let [position, yaw] = reference_noise.map(|std| std.value * std.value);
    let noise = Matrix3::from_diagonal(&Vector3::new(position, position, yaw));
    // Poses of the reference: each leg ends at a new one. It starts at the end of the previous leg if it follows that leg.
    let (mut by_poses, mut poses) = (DMatrix::zeros(count, 3 * (count + 3)), 0);
    let mut covariance = DMatrix::zeros(count, count);
    let mut residuals = DVector::zeros(count);
    let mut design = DMatrix::zeros(count, errors.len());
    for (i, (leg, observation)) in legs.iter().zip(observations).enumerate() {
        if !leg.follows {
            poses += 1;
        }
        by_poses.fixed_view_mut::<3, 3>(3 * i, 3 * (poses - 1)).copy_from(&by_pose(leg, corrected, 0));
        by_poses.fixed_view_mut::<3, 3>(3 * i, 3 * poses).copy_from(&by_pose(leg, corrected, 1));
        poses += 1;
        for k in 0..3 {
            let [first, second] =
                NAV2.component_alphas()[k].map(|alpha| alphas[alpha].expect("identifiable"));
            let [by_first, by_second] = observation.coefficients[k];
            covariance[(3 * i + k, 3 * i + k)] = first * by_first + second * by_second;
            residuals[3 * i + k] = observation.residuals[k];
        }
        for (column, error) in errors.iter().enumerate() {
            design.fixed_view_mut::<3, 1>(3 * i, column).copy_from(&by_error(leg, corrected, *error));
        }
    }
    for pose in 0..poses {
        let part = by_poses.columns(3 * pose, 3);
        covariance += part * noise * part.transpose();
    }
    let factor = covariance.cholesky().expect("positive definite");
    let log_det =
        |factor: &nalgebra::Cholesky<f64, nalgebra::Dyn>| 2.0 * factor.l().diagonal().map(libm::log).sum();
    let solved = factor.solve(&residuals);
    let mut deviance =
        log_det(&factor) + residuals.dot(&solved) + (count - errors.len()) as f64 * libm::log(TAU);
    if !errors.is_empty() {
        let information = (design.transpose() * factor.solve(&design)).cholesky().expect("positive definite");
        let pull = design.transpose() * solved;
        deviance += log_det(&information) - pull.dot(&information.solve(&pull));
    }
    -0.5 * deviance
}

/// The relative error of Jacobians by central differences is 1e-9, and there are 120 residuals.
#[test]
fn the_recursion_gives_the_likelihood_of_the_dense_covariance() {
    let made = drive_in_bends(40);
    let corrected = [
        SystematicError::MountYaw,
        SystematicError::LeverArmAhead,
        SystematicError::LeverArmLeft,
        SystematicError::DistanceScale,
        SystematicError::TurnScale,
    ];
    for errors in [&corrected[..0], &corrected] {
        let correct = SystematicError::ALL.map(|error| Some(errors.contains(&error)));
        let calibration = calibrated_log(&made.log(), &Options { correct, ..made.options() });
        assert_eq!(calibration.leg_fits.iter().filter(|fit| fit.is_outlier).count(), 0);
        let (found, expected) = (calibration.log_likelihood, dense_log_likelihood(&calibration, errors));
        assert!((found - expected).abs() < 1e-5, "{found} is not {expected}");
    }
}

/// Without turns each component has one α, with a closed form: α̂ is the mean of r²/c over n residuals, and twice the log-likelihood is
/// n(ln s + 1/s − 1) lower at s times that.
#[test]
fn an_interval_ends_where_the_profile_likelihood_has_fallen() {
    let made = Simulation { drive: Some(|_| [0.3, 0.0]), ..Simulation::of(MODELS[3], 400, 3) };
    let stated = Options {
        correct: [Some(false); 6],
        position_std: Some(0.0),
        yaw_std: Some(0.0),
        outliers: Outliers::Keep,
        ..made.options()
    };
    let calibration = calibrated_log(&made.log(), &stated);
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
            let s = end / mean;
            let fall = n * (libm::log(s) + 1.0 / s - 1.0);
            // Intervals may be longer if squared residuals of neighbouring legs are correlated, by chance up to a
            // tenth.
            assert!((3.7..5.2).contains(&fall), "{fall}");
        }
    }
}

/// A robot that errs by a hundredth of what another does, with the same noise otherwise, has α's of a ten-thousandth. Products of the noises
/// are a thousandth from there on: a fortieth of an interval is allowed.
#[test]
fn alphas_and_their_intervals_scale_with_the_noise() {
    for model in [MODELS[1], MODELS[3]] {
        let of = |times: f64| {
            let made = Simulation { violation: Violation::Times(times), ..Simulation::of(model, 1000, 103) };
            let stated = Options { position_std: Some(0.0), yaw_std: Some(0.0), ..made.options() };
            let Calibration { alphas, intervals, .. } = calibrated_log(&made.log(), &stated);
            let scaled = |number: f64| number / (times * times);
            let all = alphas.into_iter().zip(intervals).map(|(alpha, interval)| {
                let [low, high] = interval.expect("identifiable");
                [low, alpha.expect("identifiable"), high].map(scaled)
            });
            all.collect::<Vec<_>>()
        };
        let expected_numbers = of(0.01);
        for (k, (less, expected)) in of(0.001).into_iter().zip(expected_numbers).enumerate() {
            for (number, expected_number) in less.into_iter().zip(expected) {
                let allowed = 0.025 * (expected[2] - expected[0]);
                assert!(
                    (number - expected_number).abs() < allowed,
                    "{model:?} α{}: {less:?} {expected:?}",
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
    let made = Simulation { reference_stds: [0.02, 0.02], ..Simulation::of(NAV2, 400, 5) };
    let log = made.log();
    // Likelihoods of the same residuals: nothing is corrected.
    let calibration = |position_std: Option<f64>, yaw_std: Option<f64>| {
        calibrated_log(&log, &Options { correct: [Some(false); 6], position_std, yaw_std, ..made.options() })
    };
    let estimated = calibration(None, None);
    let [position, yaw] = estimated.reference_noise.map(|std| std.value);
    let at = |position: f64, yaw: f64| calibration(Some(position), Some(yaw)).log_likelihood;
    let top = estimated.log_likelihood;
    assert!((at(position, yaw) - top).abs() < 1e-3, "{} {top}", at(position, yaw));
    for factor in [0.8, 1.25] {
        assert!(at(factor * position, yaw) < top && at(position, factor * yaw) < top, "{factor}");
    }
}
