//! The simulation of the Odometry Decomposer: common random numbers, poses of the legs, drifting frame and curve.

use crate::common::{NOISE_KINDS, pose_distance, seeded_rng};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::sim::odometry_decomposer::{CurvePoint, OdometryDecomposer, OdometryPose, PRESETS, Settings};
use motion::{MotionModel, OdomAlphas, OdometryModel};

pub fn simulation(settings: Settings) -> OdometryDecomposer {
    OdometryDecomposer::new(settings).expect("a valid setting")
}

pub fn settings_of_preset(name: &str) -> Settings {
    let preset = PRESETS.iter().find(|preset| preset.name == name).expect("a preset of that name");
    Settings { from: preset.from, to: preset.to, ..Settings::default() }
}

/// With the rule of Table 5.6 the outcomes equal samples of `OdometryModel` with the same seed.
#[test]
fn the_outcomes_equal_samples_of_the_model() {
    for noise in NOISE_KINDS {
        let settings =
            Settings { from: OdometryPose([0.5, -1.0, 2.0]), noise, samples: 1001, ..Settings::default() };
        let simulation = simulation(settings);
        let [a1, a2, a3, a4, _] = settings.alphas;
        let model = OdometryModel { alphas: OdomAlphas([a1, a2, a3, a4]), noise };
        let mut rng = seeded_rng(settings.seed);
        assert_eq!(simulation.poses().len(), 1001);
        for pose in simulation.poses() {
            let expected_pose = model.sample(&simulation.reading(), &settings.from.into(), &mut rng);
            assert!(pose_distance(pose, &expected_pose) < 1e-14, "{pose:?}, drawn {expected_pose:?}");
        }
    }
}

/// With only α₃, the lengths of the drives differ by constant random numbers times √α₃.
#[test]
fn changed_settings_move_the_same_outcomes() {
    let with_alpha3_only =
        |a3: f64| Settings { alphas: [0.0, 0.0, a3, 0.0, 0.0], ..settings_of_preset("drive-turn") };
    let mut simulation = simulation(with_alpha3_only(0.01));
    let excess_lengths = |simulation: &OdometryDecomposer| -> Vec<f64> {
        simulation.poses().iter().map(|pose| pose.x() - 1.5).collect()
    };
    let lengths_before = excess_lengths(&simulation);
    simulation.configure(with_alpha3_only(0.04)).expect("a valid setting");
    for (lengths_before, after) in lengths_before.iter().zip(excess_lengths(&simulation)) {
        assert!((2.0 * lengths_before - after).abs() < 1e-14);
    }
    // A larger cloud begins with the smaller one.
    let more_samples = Settings { samples: 900, ..with_alpha3_only(0.01) };
    simulation.configure_first(more_samples, 700).expect("a valid setting");
    assert_eq!((simulation.poses().len(), &excess_lengths(&simulation)[..500]), (700, &lengths_before[..]));
    assert_eq!(simulation.add_samples(usize::MAX), 900);
}

#[test]
fn the_leg_poses_follow_the_legs_of_the_reading() {
    for preset in PRESETS {
        for rule in OdometryRule::ALL {
            let simulation = simulation(Settings { rule, ..settings_of_preset(preset.name) });
            let [start, after_rot1, after_drive, end] = simulation.leg_poses();
            let legs = simulation.legs();
            assert_eq!(start, preset.from.into());
            assert_eq!((after_rot1.x(), after_rot1.y()), (start.x(), start.y()));
            assert!(
                ((after_drive.x() - start.x()).hypot(after_drive.y() - start.y()) - legs.trans).abs() < 1e-15
            );
            assert_eq!(
                [after_drive.x(), after_drive.y(), after_drive.theta()],
                [end.x(), end.y(), after_rot1.theta()]
            );
            assert!(pose_distance(&end, &preset.to.into()) < 0.01, "{} by {rule:?}", preset.name);
            let robot_at = |phase| {
                let settings = Settings { phase, ..*simulation.settings() };
                OdometryDecomposer::new(settings).expect("a valid setting").robot_pose()
            };
            for (phase, pose) in [(0.0, start), (1.0, after_rot1), (2.0, after_drive), (3.0, end)] {
                assert!(pose_distance(&robot_at(phase), &pose) < 1e-15, "{phase}");
            }
            assert!((robot_at(1.5).x() - 0.5 * (start.x() + end.x())).abs() < 1e-15);
        }
    }
    // Without noise the leg poses of every outcome equal those of the reading.
    let noise_free_simulation = simulation(Settings { alphas: [0.0; 5], ..Settings::default() });
    assert_eq!(noise_free_simulation.sample_leg_poses(7), [noise_free_simulation.leg_poses(); 7]);
    assert_eq!(noise_free_simulation.sample_leg_poses(usize::MAX).len(), 500);
    let initial_simulation = simulation(Settings::default());
    for (leg_poses, pose) in initial_simulation.sample_leg_poses(20).iter().zip(initial_simulation.poses()) {
        assert_eq!(leg_poses[3], *pose);
    }
}

/// The prediction depends only on the relative motion. A drift of the odometry's frame does not change it.
#[test]
fn the_prediction_does_not_depend_on_the_drift() {
    let with_drift = |drift| simulation(Settings { drift, ..Settings::default() });
    let (without_drift, with_long_drift) = (with_drift(0.0), with_drift(300.0));
    assert_eq!(without_drift.poses(), with_long_drift.poses());
    assert_eq!(without_drift.rule_noises(), with_long_drift.rule_noises());
    let [fixed, drifted] = [&without_drift, &with_long_drift].map(OdometryDecomposer::drifted_odometry);
    assert_eq!(fixed.frame, SE2::identity());
    // The poses in the frame of the odometry are metres away, and the legs are the same.
    assert!((drifted.to.x() - fixed.to.x()).hypot(drifted.to.y() - fixed.to.y()) > 2.0);
    let differences = [
        drifted.legs.rot1 - fixed.legs.rot1,
        drifted.legs.trans - fixed.legs.trans,
        drifted.legs.rot2 - fixed.legs.rot2,
    ];
    assert!(differences.iter().all(|difference| difference.abs() < 1e-14), "{differences:?}");
}

/// The curve contains the values of the readouts. With a large noise of the rotation, the linear estimate `lever` is too large: it exceeds
/// the length of the drive, which no robot can.
#[test]
fn the_curve_contains_the_values_of_the_readouts() {
    for rule in OdometryRule::ALL {
        let simulation = simulation(Settings { rule, ..Settings::default() });
        let stats = simulation.stats();
        let trans = simulation.legs().trans;
        let points = simulation.deviation_curve(2.0 * trans, 3);
        assert_eq!(points.iter().map(|point| point.trans).collect::<Vec<_>>(), [0.0, trans, 2.0 * trans]);
        let CurvePoint { cross_track, lever, along, .. } = points[1];
        assert_eq!((cross_track, lever), (stats.exact_cross_track, stats.lever));
        let of_rule =
            simulation.rule_noises().into_iter().find(|noise| noise.rule == rule).expect("all rules");
        assert_eq!((of_rule.deviations[1], of_rule.cross_track), (along, cross_track));
        assert_eq!(simulation.deviation_curve(1.0, 1).len(), 1);
    }
    let large_noise = simulation(Settings { alphas: [2.0, 2.0, 0.0, 0.0, 0.0], ..Settings::default() });
    let long_drive = large_noise.deviation_curve(10.0, 2)[1];
    assert!(long_drive.cross_track < long_drive.trans && long_drive.lever > 10.0 * long_drive.trans);
}
