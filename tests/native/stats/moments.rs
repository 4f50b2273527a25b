//! Moments, skews and contours of clouds, and exact moments of models.

use crate::common::{MAX_STANDARD_ERRORS, ReferenceTable, sample_uniform, seeded_rng};
use motion::geom::se2::{SE2, wrap_angle};
use motion::models::PolarMotion;
use motion::sim::banana::{BananaMachine, Settings};
use motion::stats::{
    CartesianMoments, CrossTrackStats, Ellipse, ExactMoments, ExponentialContour, ExponentialMoments,
    cross_track_skew, predicted_cross_track_skew,
};
use motion::{
    MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, TangentNoiseModel, VelocityAlphas,
    VelocityCmd, VelocityModel,
};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

const COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };

const TWO_SIGMA_FRACTION: f64 = 0.864_664_716_763_387_3;

/// If ξ is a Gaussian of rank 2, its 2σ contour contains 86.5 % of the robots, also after mapping to the plane by exp. The outline
/// separates the robots inside from those outside.
#[test]
fn the_exponential_contour_covers_the_fraction_of_two_sigma() {
    let start_pose = SE2::new(2.0, -1.0, 0.8);
    let alphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]);
    let model = VelocityModel { alphas, noise: NoiseKind::Normal };
    let mut rng = seeded_rng(134);
    let poses: Vec<SE2> = (0..200_000).map(|_| model.sample(&COMMAND, &start_pose, &mut rng)).collect();
    let inside_share_of = |cloud_moments: &ExponentialMoments| {
        let contour_outline = ExponentialContour::new(cloud_moments, &start_pose);
        poses.iter().filter(|pose| contour_outline.contains(pose)).count() as f64 / 200_000.0
    };
    let standard_error = (TWO_SIGMA_FRACTION * (1.0 - TWO_SIGMA_FRACTION) / 200_000.0).sqrt();
    let exact_moments = ExponentialMoments {
        mean: TangentNoiseModel::twist(&COMMAND),
        cov: model.tangent_cov(&COMMAND).unwrap(),
    };
    assert!(
        (inside_share_of(&exact_moments) - TWO_SIGMA_FRACTION).abs() < MAX_STANDARD_ERRORS * standard_error,
        "{}",
        inside_share_of(&exact_moments)
    );
    let fitted_fraction = inside_share_of(&ExponentialMoments::from_poses(&poses, &start_pose));
    assert!(
        (fitted_fraction - TWO_SIGMA_FRACTION).abs() < MAX_STANDARD_ERRORS * standard_error,
        "{fitted_fraction}"
    );

    let contour_outline = ExponentialContour::new(&exact_moments, &start_pose);
    let shadow_outline = contour_outline.boundary(48);
    assert_eq!(shadow_outline.first(), shadow_outline.last());
    for &[x, y] in &shadow_outline {
        // In exponential coordinates the outline is the 2σ ellipse of (along, heading).
        let inverted_arc = motion::invert_arc(&start_pose, &SE2::new(x, y, 0.0), 1.0);
        let squared_sigmas =
            ((inverted_arc.v_hat - 1.0).powi(2) + (inverted_arc.omega_hat - 0.5).powi(2)) / 0.025;
        assert!((squared_sigmas - 4.0).abs() < 1e-9, "{squared_sigmas}");
        for (scale_about_centre, is_inside) in [(0.99, true), (1.01, false)] {
            let v = 1.0 + scale_about_centre * (inverted_arc.v_hat - 1.0);
            let omega = 0.5 + scale_about_centre * (inverted_arc.omega_hat - 0.5);
            assert_eq!(contour_outline.contains(&start_pose.boxplus(Vector3::new(v, 0.0, omega))), is_inside);
        }
    }
}

/// The outline is nearly the edge of the ellipsoid's projection. Many ξ lead to a point of the outline, each with another
/// heading. The nearest to the mean is two standard deviations away, or a little less.
#[test]
fn the_outline_is_nearly_the_projection_of_the_ellipsoid() {
    let moment_cases = [
        (
            Vector3::new(1.0, 0.0, 0.5),
            Matrix3::new(0.06, 0.001, 0.002, 0.001, 0.003, -0.006, 0.002, -0.006, 0.08),
        ),
        (Vector3::new(1.4, 0.1, -1.2), Matrix3::new(0.05, 0.0, 0.01, 0.0, 0.02, 0.01, 0.01, 0.01, 0.1)),
    ];
    for (mean, cov) in moment_cases {
        let start_pose = SE2::new(2.0, -1.0, 0.7);
        let inverse_cov = cov.try_inverse().unwrap();
        let heading_std = f64::sqrt(cov[(2, 2)]);
        for [x, y] in ExponentialContour::new(&ExponentialMoments { mean, cov }, &start_pose).boundary(48) {
            let distance_with_heading = |heading: f64| {
                let relative_pose = start_pose.inverse() * SE2::new(x, y, start_pose.theta() + heading);
                let twist_offset = relative_pose.log_near(heading) - mean;
                twist_offset.dot(&(inverse_cov * twist_offset)).sqrt()
            };
            // The distance is minimized over 4001 headings within three standard deviations. Their spacing makes the minimum
            // too large by less than 1e-5.
            let tested_headings =
                (0..=4000).map(|i| mean.z + heading_std * 3.0 * (f64::from(i) / 2000.0 - 1.0));
            let min_distance = tested_headings.map(distance_with_heading).fold(f64::INFINITY, f64::min);
            assert!((1.9..2.0 + 1e-5).contains(&min_distance), "({x}, {y}): {min_distance}");
        }
    }
}

#[test]
fn predicted_skews_match_the_references() {
    for csv_row in ReferenceTable::parse(include_str!("../../reference/pushed_skew.csv")).rows() {
        let mean = Vector3::from(csv_row.cell_numbers(["a", "b", "w"]));
        let [cov_aa, cov_ab, cov_aw, cov_bb, cov_bw, cov_ww] =
            csv_row.cell_numbers(["caa", "cab", "caw", "cbb", "cbw", "cww"]);
        let cov = Matrix3::new(cov_aa, cov_ab, cov_aw, cov_ab, cov_bb, cov_bw, cov_aw, cov_bw, cov_ww);
        let skew = predicted_cross_track_skew(&mean, &cov);
        assert!(
            (skew - csv_row.cell_number("skew")).abs() < 1e-12,
            "{mean} {cov}: {skew}, not {}",
            csv_row.cell_number("skew")
        );
    }
}

fn assert_moments_of_row(exact_moments: &ExactMoments, row: &crate::common::ReferenceRow<'_>) {
    let (mean, cov) = (exact_moments.mean, exact_moments.cov);
    let means_by_column = [("mx", mean.x), ("my", mean.y)];
    let named_covariances =
        [("sxx", 0, 0), ("sxy", 0, 1), ("syy", 1, 1), ("sxt", 0, 2), ("syt", 1, 2), ("stt", 2, 2)]
            .map(|(column_name, i, j)| (column_name, cov[(i, j)]));
    for (column_name, computed_value) in means_by_column.into_iter().chain(named_covariances) {
        assert!(
            (computed_value - row.cell_number(column_name)).abs() < 1e-14,
            "{column_name}: {computed_value}, not {}",
            row.cell_number(column_name)
        );
    }
    assert!((exact_moments.cov - exact_moments.cov.transpose()).amax() < 1e-15);
    let skew = exact_moments.cross_track_skew;
    assert!((skew - row.cell_number("skew")).abs() < 1e-12, "skew {skew}, not {}", row.cell_number("skew"));
}

#[test]
fn exact_moments_match_the_references() {
    for row in ReferenceTable::parse(include_str!("../../reference/velocity_moments.csv")).rows() {
        let alphas = VelocityAlphas(row.cell_numbers(["a1", "a2", "a3", "a4", "a5", "a6"]));
        let [v, omega, duration] = row.cell_numbers(["v", "omega", "dt"]);
        let model = VelocityModel { alphas, noise: row.noise_kind() };
        let exact_moments =
            ExactMoments::new(&PolarMotion::of_velocity(&model, &VelocityCmd { v, omega, dt: duration }));
        assert!((exact_moments.mean.z - wrap_angle(omega * duration)).abs() < 1e-15);
        assert_moments_of_row(&exact_moments, &row);
    }
    for row in ReferenceTable::parse(include_str!("../../reference/odometry_moments.csv")).rows() {
        let [rot1, trans, rot2] = row.cell_numbers(["rot1", "trans", "rot2"]);
        let model = OdometryModel {
            alphas: OdomAlphas(row.cell_numbers(["a1", "a2", "a3", "a4"])),
            noise: row.noise_kind(),
        };
        let exact_moments =
            ExactMoments::new(&PolarMotion::of_odometry(&model, &OdomDelta { rot1, trans, rot2 }, 0.0));
        assert!((exact_moments.mean.z - wrap_angle(rot1 + rot2)).abs() < 1e-15);
        assert_moments_of_row(&exact_moments, &row);
    }
}

/// In clouds without a width, the skew, its error and the correlation are NaN, and no robot is inside a contour.
#[test]
fn degenerate_clouds_give_nan() {
    let create_poses_on_line = |heading: f64| {
        let mut rng = seeded_rng(145);
        (0..100)
            .map(|_| {
                let s = sample_uniform(&mut rng, -1.0, 1.0);
                SE2::new(0.1 + s * heading.cos(), 0.7 + s * heading.sin(), heading)
            })
            .collect::<Vec<_>>()
    };
    for line_cloud in [vec![], create_poses_on_line(2.0), create_poses_on_line(-0.3)] {
        let cross_track = CrossTrackStats::from_poses(&line_cloud);
        for skew_statistic in
            [cross_track.skew, cross_track.skew_error, cross_track.rho_heading, cross_track_skew(&line_cloud)]
        {
            assert!(skew_statistic.is_nan(), "{cross_track:?}");
        }
        let cartesian_moments = CartesianMoments::from_poses(&line_cloud);
        let exponential_moments = ExponentialMoments::from_poses(&line_cloud, &SE2::identity());
        assert_eq!(cartesian_moments.mean.iter().any(|m| m.is_nan()), line_cloud.is_empty());
        assert_eq!(exponential_moments.mean.iter().any(|m| m.is_nan()), line_cloud.is_empty());
        let covariance_ellipse = Ellipse::from_moments(&cartesian_moments);
        assert!(line_cloud.iter().all(|pose| !covariance_ellipse.contains([pose.x(), pose.y()])));
        assert_eq!(covariance_ellipse.boundary(16).len(), 17);
        assert_eq!(ExponentialContour::new(&exponential_moments, &SE2::identity()).boundary(16).len(), 17);
    }
    // Two poses have no skew, because every pair has the same shape. Three poses have a skew.
    let three_poses = [SE2::new(0.0, 0.1, 0.0), SE2::new(1.0, -0.1, 0.0), SE2::new(0.5, -0.1, 0.0)];
    assert!(cross_track_skew(&three_poses[..2]).is_nan());
    assert!((cross_track_skew(&three_poses) - 0.5f64.sqrt()).abs() < 1e-12, "residuals −1, −1 and 2");
    assert!(predicted_cross_track_skew(&Vector3::zeros(), &Matrix3::zeros()).is_nan());
    // With a turn of π, the lateral coordinate moves the end along the heading, so that the cloud has no width across it.
    for commanded_turn in [PI, -PI] {
        let lateral_cov = Matrix3::from_diagonal(&Vector3::y());
        assert!(predicted_cross_track_skew(&Vector3::new(0.0, 0.0, commanded_turn), &lateral_cov).is_nan());
    }
    let along_only_model =
        VelocityModel { alphas: VelocityAlphas([0.1, 0.0, 0.0, 0.0, 0.0, 0.0]), noise: NoiseKind::Normal };
    let noise_free_model = VelocityModel { alphas: VelocityAlphas([0.0; 6]), ..along_only_model };
    assert!(
        ExactMoments::new(&PolarMotion::of_velocity(&noise_free_model, &COMMAND)).cross_track_skew.is_nan()
    );
    assert!(
        ExactMoments::new(&PolarMotion::of_velocity(
            &along_only_model,
            &VelocityCmd { omega: 0.0, ..COMMAND }
        ))
        .cross_track_skew
        .is_nan()
    );
}

/// If the width of a cloud is of the size of rounding, it counts as 0, even if the mean is at the start because as many robots drive in
/// reverse as forward.
#[test]
fn a_width_of_the_size_of_rounding_counts_as_zero() {
    const TINY_SPEED: f64 = 1e-6;
    let reported_and_plain_skew = |motion_turn: f64| {
        let turn_per_speed = motion_turn / TINY_SPEED;
        let velocity_alphas = [1e6, 0.0, turn_per_speed * turn_per_speed, 0.0, 0.0, 0.0];
        let tiny_command = VelocityCmd { v: TINY_SPEED, omega: 0.0, dt: 1.0 };
        let settings =
            Settings { command: tiny_command, velocity_alphas, samples: 1000, ..Settings::default() };
        let simulation = BananaMachine::new(settings).expect("a valid setting");
        let poses: Vec<SE2> = simulation.poses().collect();
        [simulation.stats().cross_track_skew, CrossTrackStats::from_poses(&poses).skew]
    };
    // The bearing is half the turn, so that the width of the cloud is 5e-14 of its length.
    assert!(reported_and_plain_skew(1e-13).into_iter().all(f64::is_nan));
    let [reported_skew, plain_skew] = reported_and_plain_skew(1e-9);
    assert!(
        (reported_skew - plain_skew).abs() < 1e-9 && plain_skew.is_finite(),
        "{reported_skew}, not {plain_skew}"
    );
}

/// If the width of a distant cloud is of the size of rounding, the width counts as 0. At a kilometre, coordinates are rounded to 1e-13 m.
#[test]
fn a_width_of_the_size_of_position_rounding_counts_as_zero() {
    const TINY_WIDTH: f64 = 1e-10;
    let skew_around = |[x, y]: [f64; 2]| {
        let mut rng = seeded_rng(146);
        let mut sample_offset = || sample_uniform(&mut rng, -TINY_WIDTH, TINY_WIDTH);
        let poses: Vec<SE2> =
            (0..100).map(|_| SE2::new(x + sample_offset(), y + sample_offset(), 0.3)).collect();
        cross_track_skew(&poses)
    };
    for cloud_centre in [[1e3, 0.0], [-1e3, 0.0], [0.0, 1e3], [1e3, -1e3]] {
        assert!(skew_around(cloud_centre).is_nan(), "{cloud_centre:?}");
    }
    assert!(skew_around([0.0, 0.0]).is_finite() && skew_around([1.0, -1.0]).is_finite());
}
