//! The simulation of the Odometry Decomposer: common random numbers, poses of the legs, drift of the odometry frame, and deviation curve.

use crate::common::{NOISE_KINDS, max_difference, seeded_rng, settings_of_preset};
use motion::models::OdometryRule;
use motion::sim::odometry_decomposer::{OdometryDecomposer, Settings};
use motion::sim::settings::SettingRules;
use motion::{MotionModel, OdomAlphas, OdometryModel};

pub fn new_simulation(settings: Settings) -> OdometryDecomposer {
    OdometryDecomposer::new(settings).expect("a valid setting")
}

#[test]
fn the_outcomes_equal_samples_of_the_model() {
    for noise in NOISE_KINDS {
        let settings = Settings { from: [0.5, -1.0, 2.0], noise, samples: 1001, ..Settings::default() };
        let simulation = new_simulation(settings);
        let [alpha1, alpha2, alpha3, alpha4, _] = settings.alphas;
        let odometry_model = OdometryModel { alphas: OdomAlphas([alpha1, alpha2, alpha3, alpha4]), noise };
        let mut rng = seeded_rng(settings.seed);
        assert_eq!(simulation.poses().len(), 1001);
        for pose in simulation.poses() {
            let expected_pose = odometry_model.sample(&simulation.reading(), &settings.from.into(), &mut rng);
            assert!(max_difference(pose, &expected_pose) < 1e-14, "{pose:?}, drawn {expected_pose:?}");
        }
    }
}

/// If only α₃ is above 0, the drives differ in length by fixed random numbers times √α₃.
#[test]
fn changed_settings_move_the_same_outcomes() {
    let settings_with_alpha3_only =
        |alpha3: f64| Settings { alphas: [0.0, 0.0, alpha3, 0.0, 0.0], ..settings_of_preset("drive-turn") };
    let mut simulation = new_simulation(settings_with_alpha3_only(0.01));
    let length_errors_of = |simulation: &OdometryDecomposer| -> Vec<f64> {
        simulation.poses().iter().map(|pose| pose.x() - 1.5).collect()
    };
    let lengths_before = length_errors_of(&simulation);
    simulation.configure(settings_with_alpha3_only(0.04)).expect("a valid setting");
    for (length_before, length_after) in lengths_before.iter().zip(length_errors_of(&simulation)) {
        assert!((2.0 * length_before - length_after).abs() < 1e-14);
    }
    let settings_with_more_samples = Settings { samples: 900, ..settings_with_alpha3_only(0.01) };
    simulation.configure_first(settings_with_more_samples, 700).expect("a valid setting");
    assert_eq!((simulation.poses().len(), &length_errors_of(&simulation)[..500]), (700, &lengths_before[..]));
    assert_eq!(simulation.add_samples(usize::MAX), 900);
}

#[test]
fn the_leg_poses_follow_the_legs_of_the_reading() {
    for (preset_name, preset) in Settings::PRESETS {
        for rule in OdometryRule::ALL {
            let simulation = new_simulation(Settings { rule, ..*preset });
            let [start_pose, pose_after_rot1, pose_after_drive, final_pose] = simulation.leg_poses();
            let reading_legs = simulation.legs();
            assert_eq!(start_pose, preset.from.into());
            assert_eq!((pose_after_rot1.x(), pose_after_rot1.y()), (start_pose.x(), start_pose.y()));
            assert!(
                ((pose_after_drive.x() - start_pose.x()).hypot(pose_after_drive.y() - start_pose.y())
                    - reading_legs.trans)
                    .abs()
                    < 1e-15
            );
            assert_eq!(
                [pose_after_drive.x(), pose_after_drive.y(), pose_after_drive.theta()],
                [final_pose.x(), final_pose.y(), pose_after_rot1.theta()]
            );
            assert!(max_difference(&final_pose, &preset.to.into()) < 0.01, "{preset_name} by {rule:?}");
            let robot_pose_at = |animation_phase| {
                let settings = Settings { phase: animation_phase, ..*simulation.settings() };
                OdometryDecomposer::new(settings).expect("a valid setting").robot_pose()
            };
            for (motion_phase, pose) in
                [(0.0, start_pose), (1.0, pose_after_rot1), (2.0, pose_after_drive), (3.0, final_pose)]
            {
                assert!(max_difference(&robot_pose_at(motion_phase), &pose) < 1e-15, "{motion_phase}");
            }
            assert!((robot_pose_at(1.5).x() - 0.5 * (start_pose.x() + final_pose.x())).abs() < 1e-15);
        }
    }
    let noise_free_simulation = new_simulation(Settings { alphas: [0.0; 5], ..Settings::default() });
    assert_eq!(noise_free_simulation.sample_leg_poses(7), [noise_free_simulation.leg_poses(); 7]);
    assert_eq!(noise_free_simulation.sample_leg_poses(usize::MAX).len(), 500);
    let initial_simulation = new_simulation(Settings::default());
    for (leg_poses, pose) in initial_simulation.sample_leg_poses(20).iter().zip(initial_simulation.poses()) {
        assert_eq!(leg_poses[3], *pose);
    }
}

#[test]
fn the_prediction_does_not_depend_on_the_drift() {
    let simulate_drift =
        |drift_seconds| new_simulation(Settings { drift: drift_seconds, ..Settings::default() });
    let (simulation_without_drift, simulation_with_long_drift) = (simulate_drift(0.0), simulate_drift(300.0));
    assert_eq!(simulation_without_drift.poses(), simulation_with_long_drift.poses());
    assert_eq!(simulation_without_drift.rule_noises(), simulation_with_long_drift.rule_noises());
    let [fixed_odometry, drifted_odometry] =
        [&simulation_without_drift, &simulation_with_long_drift].map(OdometryDecomposer::drifted_odometry);
    assert_eq!(fixed_odometry.poses[0], [0.0; 3]);
    assert!(
        (drifted_odometry.poses[2][0] - fixed_odometry.poses[2][0])
            .hypot(drifted_odometry.poses[2][1] - fixed_odometry.poses[2][1])
            > 2.0
    );
    let [a, b] = [&drifted_odometry, &fixed_odometry].map(|odometry_view| odometry_view.legs);
    let leg_differences = [a.rot1 - b.rot1, a.trans - b.trans, a.rot2 - b.rot2];
    assert!(leg_differences.iter().all(|leg_difference| leg_difference.abs() < 1e-14), "{leg_differences:?}");
}

/// With a large noise of the rotation, the linear estimate `lever_estimate` exceeds the length of the drive, which is impossible for robots.
#[test]
fn the_curve_contains_the_values_of_the_readouts() {
    for rule in OdometryRule::ALL {
        let simulation = new_simulation(Settings { rule, ..Settings::default() });
        let leg_stats = simulation.stats();
        let drive_distance = simulation.legs().trans;
        let curve_points = simulation.deviation_curve(2.0 * drive_distance, 3);
        assert_eq!(
            curve_points.iter().map(|[distance, ..]| *distance).collect::<Vec<_>>(),
            [0.0, drive_distance, 2.0 * drive_distance]
        );
        let [_, cross_track, lever_estimate, along_deviation] = curve_points[1];
        assert_eq!((cross_track, lever_estimate), (leg_stats.exact_cross_track, leg_stats.lever));
        let rule_noise =
            simulation.rule_noises().into_iter().find(|noise| noise.rule == rule).expect("all rules");
        assert_eq!((rule_noise.deviations[1], rule_noise.cross_track), (along_deviation, cross_track));
        assert_eq!(simulation.deviation_curve(1.0, 1).len(), 1);
    }
    let noisy_simulation =
        new_simulation(Settings { alphas: [2.0, 2.0, 0.0, 0.0, 0.0], ..Settings::default() });
    let [distance, cross_track, lever_estimate, _] = noisy_simulation.deviation_curve(10.0, 2)[1];
    assert!(cross_track < distance && lever_estimate > 10.0 * distance);
}
