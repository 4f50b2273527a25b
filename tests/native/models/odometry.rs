//! The odometry model: decomposition, scoring, density and sampler, and the option for robots that reverse.

use crate::common::density::PolarGrid;
use crate::common::{NOISE_KINDS, derivative_by_noise, sample_uniform, seeded_rng};
use motion::geom::se2::SE2;
use motion::{
    ConfiguredOdometry, MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, RotTransRot, Variance,
};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI};

const ALPHAS: OdomAlphas = OdomAlphas([0.05, 0.02, 0.01, 0.03]);

fn new_model(noise_kind: NoiseKind) -> OdometryModel {
    OdometryModel { alphas: ALPHAS, noise: noise_kind }
}

fn new_odom_delta(rot1: f64, trans: f64, rot2: f64) -> OdomDelta {
    OdomDelta { rot1, trans, rot2 }
}

fn sample_odometry_readings() -> [OdomDelta; 6] {
    [
        new_odom_delta(0.3, 1.0, 0.2),
        new_odom_delta(-0.4, 0.8, 1.0),
        new_odom_delta(0.0, 1.5, 0.0),
        new_odom_delta(1.4, 0.6, -1.2),
        new_odom_delta(-0.9, 1.0, -0.7),
        new_odom_delta(2.2, 0.7, -2.0),
    ]
}

/// Returns the variances of Table 5.6. `angle_used_for` is the angle from which the noise of a rotation is computed.
fn table_variances(reading: &OdomDelta, angle_used_for: impl Fn(f64) -> f64) -> [f64; 3] {
    let [a1, a2, a3, a4] = ALPHAS.0;
    let [rot1_squared, trans_squared, rot2_squared] =
        [angle_used_for(reading.rot1).powi(2), reading.trans.powi(2), angle_used_for(reading.rot2).powi(2)];
    let compute_rot_variance = |rot_squared: f64| a1 * rot_squared + a2 * trans_squared;
    let trans_variance = a3 * trans_squared + a4 * (rot1_squared + rot2_squared);
    [compute_rot_variance(rot1_squared), trans_variance, compute_rot_variance(rot2_squared)]
}

/// Without translation atan2 gives no bearing. The whole turn then counts as the second rotation.
#[test]
fn a_spin_on_the_spot_counts_as_the_second_rotation() {
    for spin_angle in [0.0, 0.4, -2.9, PI] {
        for small_displacement in [0.0, 1e-13, -1e-10] {
            let previous_pose = SE2::new(3.0, -2.0, 1.0);
            let second_pose = SE2::new(3.0 + small_displacement, -2.0 - small_displacement, 1.0 + spin_angle);
            let spin_reading = OdomDelta::from_poses(&previous_pose, &second_pose);
            assert_eq!((spin_reading.rot1, spin_reading.trans), (0.0, 0.0));
            assert!((spin_reading.rot2 - spin_angle).abs() < 1e-15);
        }
    }
    let previous_pose = SE2::identity();
    let reading_of_distance =
        |drive_distance: f64| OdomDelta::from_poses(&previous_pose, &SE2::new(0.0, drive_distance, 0.5));
    assert_eq!(reading_of_distance(1e-9f64.next_down()), new_odom_delta(0.0, 0.0, 0.5));
    assert_eq!(reading_of_distance(1e-9), new_odom_delta(FRAC_PI_2, 1e-9, 0.5 - FRAC_PI_2));
    let u = new_odom_delta(0.0, 0.0, 0.8);
    assert_eq!(new_model(NoiseKind::Normal).pose_density(&u.apply(&previous_pose), &u, &previous_pose), None);
}

/// Table 5.5 computes its variances from the hypothetical motion, not from the reading.
#[test]
fn prob_is_the_score_of_table_5_5() {
    let mut rng = seeded_rng(92);
    let x = SE2::new(1.0, 2.0, -0.5);
    for noise_kind in NOISE_KINDS {
        for u in sample_odometry_readings() {
            for _ in 0..200 {
                let mut perturb_value =
                    |unperturbed_value: f64| unperturbed_value + sample_uniform(&mut rng, -0.4, 0.4);
                let executed_legs =
                    new_odom_delta(perturb_value(u.rot1), perturb_value(u.trans), perturb_value(u.rot2));
                let [rot1_variance, t, rot2_variance] = table_variances(&executed_legs, f64::abs);
                let expected_score = noise_kind.prob(u.rot1 - executed_legs.rot1, Variance(rot1_variance))
                    * noise_kind.prob(u.trans - executed_legs.trans, Variance(t))
                    * noise_kind.prob(u.rot2 - executed_legs.rot2, Variance(rot2_variance));
                let table_score = new_model(noise_kind).prob(&executed_legs.apply(&x), &u, &x);
                assert!(
                    (table_score - expected_score).abs() <= 1e-9 * (1.0 + expected_score),
                    "{executed_legs:?} for {u:?}: {table_score}, not {expected_score}"
                );
            }
        }
    }
}

#[test]
fn without_noise_samples_are_exact_and_there_is_no_density() {
    let mut rng = seeded_rng(93);
    let x = SE2::new(-1.0, 0.5, 2.0);
    for noise_kind in NOISE_KINDS {
        let noise_free_model = OdometryModel { alphas: OdomAlphas([0.0; 4]), noise: noise_kind };
        for u in sample_odometry_readings() {
            let noise_free_end = u.apply(&x);
            assert_eq!(noise_free_model.sample(&u, &x, &mut rng), noise_free_end);
            assert_eq!(noise_free_model.prob(&noise_free_end, &u, &x), 1.0);
            assert_eq!(
                noise_free_model.prob(&noise_free_end.boxplus(Vector3::new(1e-3, 0.0, 0.0)), &u, &x),
                0.0
            );
            assert_eq!(noise_free_model.pose_density(&noise_free_end, &u, &x), None);
            assert_eq!(
                new_model(noise_kind).tangent_cov(&u),
                None,
                "noise of three legs is not one Gaussian in se(2)"
            );
        }
        let no_motion = new_odom_delta(0.0, 0.0, 0.0);
        assert_eq!(new_model(noise_kind).sample(&no_motion, &x, &mut rng), x);
        assert_eq!(new_model(noise_kind).prob(&x, &no_motion, &x), 1.0);
    }
}

/// The density of a pose is the density of the noises of its legs, divided by the Jacobian determinant, which is the translation.
/// Variances are those of the reading.
#[test]
fn the_pose_density_divides_by_the_jacobian() {
    let mut rng = seeded_rng(94);
    let x = SE2::new(1.0, -2.0, 0.3);
    for noise in NOISE_KINDS {
        for u in sample_odometry_readings() {
            let table_variances = table_variances(&u, f64::abs);
            for _ in 0..100 {
                let leg_noise =
                    table_variances.map(|variance| sample_uniform(&mut rng, -1.0, 1.0) * variance.sqrt());
                let executed_legs =
                    new_odom_delta(u.rot1 - leg_noise[0], u.trans - leg_noise[1], u.rot2 - leg_noise[2]);
                let [rot1_variance, t, rot2_variance] = [0, 1, 2]
                    .map(|leg_index| noise.prob(leg_noise[leg_index], Variance(table_variances[leg_index])));
                let expected_density = rot1_variance * t * rot2_variance / executed_legs.trans;
                let density = new_model(noise).pose_density(&executed_legs.apply(&x), &u, &x).unwrap();
                // Motions in reverse or with full turns lead to the same pose. With this noise they add less than 1e-6 to the density.
                assert!(
                    (density / expected_density - 1.0).abs() < 1e-6,
                    "{u:?} at {executed_legs:?}: {density}, not {expected_density}"
                );
            }
        }
    }
}

/// Returns a box around the noise-free pose, which reaches twice as far as triangular noise. The kinks of the triangular density, at
/// multiples of √6 deviations, lie on bounds of cells.
fn grid_around(u: &OdomDelta, x: &SE2, table_variances: [f64; 3]) -> PolarGrid {
    let [rot1, trans, rot2] = table_variances.map(|variance| 2.0 * (6.0 * variance).sqrt());
    PolarGrid::new(x, &u.apply(x), 1.0, [trans, rot1.min(PI / 2.0), rot2.min(PI)], [8; 3])
}

/// The noise is as large as the motion, so that reversed translations and whole turns are part of the density.
#[test]
fn the_pose_density_integrates_to_one_for_large_noise() {
    let x = SE2::new(0.4, 0.4, -2.2);
    for (noise, integral_tolerance, u) in [
        (NoiseKind::Normal, 1e-6, sample_odometry_readings()[5]),
        (NoiseKind::Triangular, 1e-3, new_odom_delta(0.7, 0.8, -0.4)),
    ] {
        let odometry_model = OdometryModel { alphas: OdomAlphas([0.9, 0.9, 1.1, 0.4]), noise };
        let max_distance =
            u.trans + 7.0 * (1.1 * u.trans.powi(2) + 0.4 * (u.rot1.powi(2) + u.rot2.powi(2))).sqrt();
        let density_integral = PolarGrid::around_start(&x, 1.0, max_distance, [14, 8, 8])
            .integrate_density(|pose| odometry_model.pose_density(pose, &u, &x).unwrap());
        assert!((density_integral - 1.0).abs() < integral_tolerance, "{noise:?} {u:?}: {density_integral}");
    }
}

#[test]
fn sampler_and_density_agree() {
    let x = SE2::new(0.5, -0.25, 1.0);
    for (seed, u) in (100..).zip([sample_odometry_readings()[0], sample_odometry_readings()[3]]) {
        for noise in NOISE_KINDS {
            let density_grid = grid_around(&u, &x, table_variances(&u, f64::abs));
            density_grid.assert_samples_fit(&new_model(noise), &u, &x, seed);
        }
    }
}

#[test]
fn cartesian_cov_is_the_linearized_motion() {
    let x = SE2::new(4.0, 1.0, -1.2);
    let odometry_model = new_model(NoiseKind::Normal);
    for u in sample_odometry_readings() {
        let noise_jacobian = derivative_by_noise([0.0; 3], |unit_noise| {
            odometry_model.executed_motion(&u, unit_noise).apply(&x)
        });
        let cov = odometry_model.cartesian_cov(&u, &x);
        assert!((cov - noise_jacobian * noise_jacobian.transpose()).amax() < 1e-8, "{u:?}\n{cov}");
    }
}

/// Half a metre backwards is rot1 ≈ π, rot2 ≈ −π. Table 5.6 adds the noise of two half turns, and `ConfiguredOdometry` adds none.
#[test]
fn reverse_aware_noise_excludes_half_turns() {
    let x = SE2::new(1.0, 1.0, 0.5);
    let backward_reading = OdomDelta::from_poses(&x, &x.boxplus(Vector3::new(-0.5, 0.0, 0.02)));
    assert!(backward_reading.rot1.abs() > 3.0 && backward_reading.rot2.abs() > 3.0, "{backward_reading:?}");
    let effective_angle_of = |angle: f64| angle.abs().min((PI - angle.abs()).abs());
    for noise in NOISE_KINDS {
        let aware_model = ConfiguredOdometry { model: new_model(noise), reverse_aware: true };
        let density_grid =
            grid_around(&backward_reading, &x, table_variances(&backward_reading, effective_angle_of));
        density_grid.assert_samples_fit(&aware_model, &backward_reading, &x, 110);

        let executed_legs = new_odom_delta(
            backward_reading.rot1 + 0.02,
            backward_reading.trans - 0.05,
            backward_reading.rot2 - 0.03,
        );
        let [rot1_variance, t, rot2_variance] =
            table_variances(&OdomDelta::from_poses(&x, &executed_legs.apply(&x)), effective_angle_of);
        let expected_score = noise.prob(0.02, Variance(rot1_variance))
            * noise.prob(0.05, Variance(t))
            * noise.prob(0.03, Variance(rot2_variance));
        assert!(
            (aware_model.prob(&executed_legs.apply(&x), &backward_reading, &x) / expected_score - 1.0).abs()
                < 1e-9
        );
    }
}
