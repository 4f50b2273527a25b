//! The Alpha Calibrator's simulation. The result for the simulated log is compared with the simulated α's and errors. Panels and legs
//! are compared with an independent computation.

use crate::common::seeded_rng;
use motion::calibrate::{Calibration, Drive, Leg, SystematicError, Trajectory, Verdict};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::sim::alpha_calibrator::{AlphaCalibrator, Model, Regressor, Settings};
use motion::{NoiseKind, OdomDelta, Variance};
use nalgebra::Vector3;

fn new_simulation(new_settings: Settings) -> AlphaCalibrator {
    AlphaCalibrator::new(new_settings).expect("allowed")
}

/// Returns the poses of the base at start and end of a leg, as measured by the reference.
fn base_poses_of_leg(calibration: &Calibration, leg_index: usize) -> [SE2; 2] {
    calibration.legs[leg_index].reference.map(|pose| pose * calibration.corrected.base())
}

/// Returns for the four α's and the six systematic errors whether their intervals contain the true values.
fn which_intervals_contain_truth(simulation: &AlphaCalibrator) -> Vec<bool> {
    let calibration = simulation.calibration();
    let truth = simulation.truth().expect("a simulated log");
    let [lever_ahead, lever_left] = truth.lever_arm;
    let [distance_scale, turn_scale] = [truth.distance_scale, truth.turn_scale];
    let true_errors =
        [truth.clock_offset, truth.mount_yaw, lever_ahead, lever_left, distance_scale, turn_scale];
    let error_intervals = SystematicError::ALL.map(|error_kind| calibration.interval_of(error_kind));
    let all_intervals = calibration.intervals.iter().copied().chain(error_intervals);
    let contains_true_value = |(confidence_interval, true_value): (Option<[f64; 2]>, f64)| {
        let [lower_bound, upper_bound] = confidence_interval.expect("the log turns and drives");
        (lower_bound..=upper_bound).contains(&true_value)
    };
    all_intervals.zip(truth.alphas.into_iter().chain(true_errors)).map(contains_true_value).collect()
}

#[test]
fn the_initial_intervals_contain_the_true_values() {
    let simulation = new_simulation(Settings::default());
    assert_eq!(which_intervals_contain_truth(&simulation), [true; 10]);
    assert_eq!(simulation.calibration().diagnostics.verdict, Verdict::Consistent);
}

/// With these seeds the variances of the reference are small, but not 0. Any α from some 450 legs has a standard error of 5 % or more.
#[test]
fn a_small_noise_of_the_reference_does_not_narrow_the_intervals_of_alphas() {
    for seed in [107, 178] {
        let simulation = new_simulation(Settings { seed, ..Settings::default() });
        let Calibration { alphas, intervals: all_intervals, .. } = simulation.calibration();
        for (fitted_alpha, interval) in alphas.iter().flatten().zip(all_intervals.iter().flatten()) {
            assert!(interval[1] - interval[0] > 0.2 * fitted_alpha, "{seed}: {fitted_alpha} {interval:?}");
        }
    }
}

#[test]
fn legs_end_after_a_duration_where_one_is_set() {
    let new_settings = Settings { duration: 0.8, ..Settings::default() };
    let mut simulation = new_simulation(new_settings);
    assert!(simulation.legs().len() > 100, "{}", simulation.legs().len());
    for Leg { times: [start_time, end_time], .. } in simulation.legs() {
        assert!((end_time - start_time - 0.8).abs() < 0.06, "{start_time} {end_time}");
    }
    let default_legs = simulation.legs().to_vec();
    simulation.configure(Settings { distance: 3.0, angle: 2.0, ..new_settings }).expect("allowed");
    assert_eq!(simulation.legs(), default_legs);
    simulation.configure(Settings { distance: 3.0, angle: 2.0, ..Settings::default() }).expect("allowed");
    assert!(simulation.legs().len() < default_legs.len() / 2);
}

/// A standard deviation set to 0 is estimated from the log. Any other standard deviation is used as stated.
#[test]
fn the_reference_noise_is_estimated_unless_it_is_stated() {
    let stds_and_whether_stated = |position_std: f64, yaw_std: f64| {
        let simulation = new_simulation(Settings { position_std, yaw_std, ..Settings::default() });
        simulation.calibration().reference_noise.map(|std| (std.value, std.interval[0] == std.interval[1]))
    };
    let [position_std, yaw_std] = stds_and_whether_stated(0.0, 0.003);
    assert_eq!((position_std.1, yaw_std.1), (false, true));
    assert!((yaw_std.0 - 0.003).abs() < 1e-12, "{yaw_std:?}");
    let [position_std, yaw_std] = stds_and_whether_stated(0.004, 0.0);
    assert_eq!((position_std.1, yaw_std.1), (true, false));
    assert!((position_std.0 - 0.004).abs() < 1e-12, "{position_std:?}");
}

/// The plots (panels) of squared residuals, one for each α, are compared with means of squared innovations, from which the variance due to the
/// other α of the residual and to the reference is subtracted.
#[test]
fn panel_points_are_means_of_squared_innovations() {
    let simulation = new_simulation(Settings::default());
    let Calibration { alphas, intervals: all_intervals, observations: leg_observations, leg_fits, .. } =
        simulation.calibration();
    let [rot1_panel, trans_panel, rot2_panel] = simulation.panels(Regressor::Turn);
    assert_eq!([rot1_panel.alpha, trans_panel.alpha, rot2_panel.alpha], [0, 3, 0]);
    assert_eq!(simulation.panels(Regressor::Distance).map(|panel| panel.alpha), [1, 2, 1]);
    assert_eq!((trans_panel.slope, trans_panel.interval), (alphas[3], all_intervals[3]));
    let fitted_slope = alphas[3].expect("the log turns");
    // By the rule of Table 5.6 the variance of `trans` is α₃·trans² + α₄·(rot1² + rot2²).
    let mut regression_points: Vec<[f64; 2]> = leg_observations
        .iter()
        .zip(leg_fits)
        .filter(|(_, leg_fit)| !leg_fit.is_outlier)
        .map(|(leg_observation, leg_fit)| {
            let [rot1, _, rot2] = leg_observation.reading;
            let squared_turns = rot1 * rot1 + rot2 * rot2;
            let [innovation_variance, innovation] =
                [leg_fit.stds[1].powi(2), leg_fit.standardized[1] * leg_fit.stds[1]];
            [squared_turns, innovation * innovation - (innovation_variance - fitted_slope * squared_turns)]
        })
        .collect();
    regression_points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let bin_size = regression_points.len().div_ceil(8);
    let end_of_bin = |i: usize| {
        regression_points.partition_point(|regression_point| {
            regression_point[0] <= regression_points[(i * bin_size).min(regression_points.len()) - 1][0]
        })
    };
    for i in 0..8 {
        let bin_points = &regression_points[if i == 0 { 0 } else { end_of_bin(i) }..end_of_bin(i + 1)];
        let bin_mean_of = |coordinate_index: usize| {
            bin_points.iter().map(|regression_point| regression_point[coordinate_index]).sum::<f64>()
                / bin_points.len() as f64
        };
        assert!(
            (trans_panel.x[i] - bin_mean_of(0)).abs() < 1e-12
                && (trans_panel.y[i] - bin_mean_of(1)).abs() < 1e-12,
            "bin {i}"
        );
    }
    assert_eq!(trans_panel.x.len(), 8);
    // The bins differ from the line by their errors only, because the log is simulated with the model.
    let chi_square_term =
        |i: usize| ((trans_panel.y[i] - fitted_slope * trans_panel.x[i]) / trans_panel.error[i]).powi(2);
    assert!(
        (0..8).map(chi_square_term).sum::<f64>() < 26.1,
        "χ² of 8 bins exceeds 26.1 in one of a thousand logs"
    );
}

/// The log is simulated with the model. Therefore bins that differ by over two or three error bars are as rare as normal errors of that
/// size. This includes bins where one leg with a large turn dominates.
#[test]
#[ignore = "nightly: 40 calibrations"]
fn error_bars_of_panels_overlap_the_fitted_lines() {
    let [mut bin_count, mut bins_over_2_errors, mut bins_over_3_errors] = [0; 3];
    for seed in 0..40 {
        let simulation = new_simulation(Settings { seed, ..Settings::default() });
        for panel in [Regressor::Distance, Regressor::Turn]
            .into_iter()
            .flat_map(|panel_regressor| simulation.panels(panel_regressor))
        {
            let line_slope = panel.slope.expect("the log turns and drives");
            for ((x, y), error_bar) in panel.x.iter().zip(&panel.y).zip(&panel.error) {
                let standard_errors = ((y - line_slope * x) / error_bar).abs();
                bin_count += 1;
                bins_over_2_errors += usize::from(standard_errors > 2.0);
                bins_over_3_errors += usize::from(standard_errors > 3.0);
            }
        }
    }
    let fraction_of_bins = |count_outside: usize| count_outside as f64 / bin_count as f64;
    assert!(
        fraction_of_bins(bins_over_2_errors) < 0.0455 && fraction_of_bins(bins_over_3_errors) < 0.0027,
        "{bins_over_2_errors} and {bins_over_3_errors} of {bin_count}"
    );
}

/// A turn on the spot may end a tenth of a millimetre behind its start. Table 5.6 then counts it as two half turns.
#[test]
fn turns_that_the_robot_did_not_make_are_in_no_panel() {
    let mut simulation = new_simulation(Settings::default());
    let mut rng = seeded_rng(1);
    let mut pose = SE2::identity();
    let odometry_samples: Vec<(f64, SE2)> = (0..3000)
        .map(|row_index| {
            let [forward_step, turn_step] = [[-1e-5, 0.03], [0.03, 0.01], [0.03, 0.0]][row_index / 30 % 3];
            pose = pose.boxplus(Vector3::new(forward_step, 0.0, turn_step));
            (0.1 * row_index as f64, pose)
        })
        .collect();
    let reference_samples = odometry_samples.iter().map(|(sample_time, pose)| {
        let sample_error = |_| NoiseKind::Normal.sample(Variance(1e-6), &mut rng);
        (*sample_time, pose.boxplus([0; 3].map(sample_error).into()))
    });
    let reference_log = Trajectory::new(reference_samples.collect::<Vec<_>>()).expect("times rise");
    let odometry_log = Trajectory::new(odometry_samples).expect("times rise");
    simulation.set_log(vec![Drive { odometry: odometry_log, reference: reference_log }]);
    let rot1_readings =
        simulation.calibration().observations.iter().map(|leg_observation| leg_observation.reading[0]);
    assert!(rot1_readings.filter(|rot1| rot1.abs() > 3.0).count() > 50);
    for panel in simulation.panels(Regressor::Turn) {
        assert!(panel.x.iter().all(|turn_square| *turn_square < 1.0), "{:?}", panel.x);
    }
}

#[test]
fn a_leg_is_shown_in_the_frame_of_its_start() {
    let simulation = new_simulation(Settings { inflation: 4.0, ..Settings::default() });
    let calibration = simulation.calibration();
    let leg_index = 100;
    let leg_view = simulation.leg(leg_index).expect("a leg");
    let [start_pose, end_pose] = base_poses_of_leg(calibration, leg_index);
    let leg_motion = start_pose.inverse() * end_pose;
    assert_eq!(leg_view.ended, [leg_motion.x(), leg_motion.y(), leg_motion.theta()]);
    let [rot1, drive_distance, rot2] = calibration.observations[leg_index].reading;
    let odometry_end = OdomDelta { rot1, trans: drive_distance, rot2 }.apply(&SE2::identity());
    assert!(
        leg_view
            .read
            .iter()
            .zip([odometry_end.x(), odometry_end.y(), odometry_end.theta()])
            .all(|(computed_value, expected_value)| (computed_value - expected_value).abs() < 1e-12)
    );
    // The outcomes are drawn by the rule of Table 5.6, with variances that the inflation multiplies by four.
    let mut alphas = [0.0; 5];
    for (alpha, fitted_alpha) in alphas.iter_mut().zip(&calibration.alphas) {
        *alpha = fitted_alpha.expect("known");
    }
    let leg_variances = OdometryRule::Table
        .variances(&OdomDelta { rot1, trans: drive_distance, rot2 }, &alphas.map(|alpha| 4.0 * alpha));
    let outcome_count = leg_view.outcomes.len() as f64;
    let outcome_variance_of = |quantity_of: &dyn Fn(&[f64; 3]) -> f64| {
        let quantity_mean = leg_view.outcomes.iter().map(quantity_of).sum::<f64>() / outcome_count;
        leg_view.outcomes.iter().map(|outcome| (quantity_of(outcome) - quantity_mean).powi(2)).sum::<f64>()
            / outcome_count
    };
    let drive_variance = outcome_variance_of(&|[x, y, _]| libm::hypot(*x, *y));
    let turn_variance = outcome_variance_of(&|[_, _, theta]| *theta);
    for (computed_variance, expected) in [
        (drive_variance, leg_variances.trans.0),
        (turn_variance, leg_variances.rot1.0 + leg_variances.rot2.0),
    ] {
        let tolerance = 4.0 * (2.0 / outcome_count).sqrt();
        assert!((computed_variance / expected - 1.0).abs() < tolerance, "{computed_variance}, {expected}");
    }
    assert!(simulation.leg(calibration.legs.len()).is_none());
}

#[test]
fn the_nearest_leg_passes_through_the_point() {
    let simulation = new_simulation(Settings::default());
    let calibration = simulation.calibration();
    let [start_pose, end_pose] = base_poses_of_leg(calibration, 7);
    let leg_midpoint = [0.5 * (start_pose.x() + end_pose.x()), 0.5 * (start_pose.y() + end_pose.y())];
    let nearest_index = simulation.find_nearest(leg_midpoint, 1e-9).expect("it leads through there");
    let distance_between = |a: [f64; 2], b: [f64; 2]| libm::hypot(a[0] - b[0], a[1] - b[1]);
    let [leg_start, leg_end] = base_poses_of_leg(calibration, nearest_index).map(|pose| [pose.x(), pose.y()]);
    assert!(
        distance_between(leg_start, leg_midpoint) + distance_between(leg_midpoint, leg_end)
            - distance_between(leg_start, leg_end)
            < 1e-9
    );
    assert_eq!(simulation.find_nearest([1e6, 0.0], 1.0), None);
    assert_eq!(simulation.find_nearest(leg_midpoint, 0.0), None);
}

#[test]
fn changing_the_model_or_the_rule_adjusts_the_other() {
    use motion::sim::settings::SettingRules;
    let change_settings = |apply_change: fn(&mut Settings), changed_key: &str| {
        let settings_before = Settings::default();
        let mut new_settings = settings_before;
        apply_change(&mut new_settings);
        new_settings.adjust_settings(&settings_before, &[changed_key]);
        new_settings
    };
    assert_eq!(change_settings(|s| s.model = Model::Omnidirectional, "model").rule, OdometryRule::Omni);
    assert_eq!(change_settings(|s| s.rule = OdometryRule::Omni, "rule").model, Model::Omnidirectional);
    assert_eq!(change_settings(|s| s.rule = OdometryRule::Nav2, "rule").model, Model::Odometry);
    let conflicting_settings =
        Settings { model: Model::Odometry, rule: OdometryRule::Omni, ..Settings::default() };
    let error_message =
        AlphaCalibrator::new(conflicting_settings).expect_err("they exclude each other").to_string();
    assert_eq!(error_message, "rule is omni; allowed is thrun, nav2 or beluga");
}

#[test]
fn a_restored_fit_equals_the_saved_one_to_the_last_bit() {
    let new_settings = Settings { rule: OdometryRule::Nav2, distance: 0.4, ..Settings::default() };
    let simulation = new_simulation(new_settings);
    let saved_fit = postcard::to_allocvec(simulation.calibration()).expect("plain data");
    let fit = postcard::from_bytes(&saved_fit).expect("a fit");
    let mut restored_simulation = AlphaCalibrator::restore(new_settings, fit).expect("allowed");
    // Missing residuals are NaN, which does not equal itself. Results are therefore compared as text.
    let fit_results = |fit: &AlphaCalibrator| {
        let all_panels =
            [Regressor::Turn, Regressor::Distance].map(|panel_regressor| fit.panels(panel_regressor));
        format!(
            "{:?} {all_panels:?} {:?} {:?}",
            fit.calibration(),
            fit.leg(5),
            fit.find_nearest([0.5, 1.0], 3.0)
        )
    };
    let results_before = fit_results(&simulation);
    assert!(
        fit_results(&restored_simulation) == results_before
            && restored_simulation.truth().is_none()
            && !restored_simulation.is_pending()
    );
    // A change of the factor that inflates the α's changes only predictions. A change of the noise rule requires a new fit to the log.
    restored_simulation.configure(Settings { inflation: 2.0, ..new_settings }).expect("allowed");
    assert!(!restored_simulation.is_pending() && fit_results(&restored_simulation) != results_before);
    restored_simulation.configure(Settings::default()).expect("allowed");
    assert!(
        restored_simulation.is_pending()
            && fit_results(&restored_simulation) == results_before
            && *restored_simulation.fitted_settings() == new_settings
    );
}

#[test]
fn a_log_without_legs_gives_an_empty_calibration() {
    let mut simulation = new_simulation(Settings::default());
    let standing_trajectory = |pose_count: usize| {
        Trajectory::new((0..pose_count).map(|i| (i as f64, SE2::identity()))).expect("times rise")
    };
    simulation.set_log(vec![Drive { odometry: standing_trajectory(10), reference: standing_trajectory(10) }]);
    assert!(simulation.truth().is_none());
    let Calibration { alphas, legs, diagnostics, recommended: recommended_alphas, .. } =
        simulation.calibration();
    assert!(legs.is_empty() && alphas.iter().all(Option::is_none) && recommended_alphas.is_none());
    assert_eq!(diagnostics.verdict, Verdict::Unusable);
    assert!(simulation.leg(0).is_none() && simulation.find_nearest([0.0; 2], 1.0).is_none());
    assert!(
        simulation.panels(Regressor::Turn).iter().all(|panel| panel.x.is_empty() && panel.slope.is_none())
    );
    // A user's log replaces the simulated log. A later change of the simulation's seed does not bring the simulated log back.
    simulation.configure(Settings { seed: 1, ..Settings::default() }).expect("allowed");
    assert!(simulation.truth().is_none());
}
