//! Moments, skews and contours of clouds, and exact moments of models.

use crate::common::{MAX_STANDARD_ERRORS, Table, seeded_rng, uniform};
use motion::geom::se2::{SE2, wrap_angle};
use motion::sim::banana::{BananaMachine, Settings};
use motion::stats::{
    CartesianMoments, CrossTrack, Ellipse, ExactMoments, ExponentialContour, ExponentialMoments,
    cross_track_skew, predicted_cross_track_skew,
};
use motion::{
    MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, TangentNoiseModel, VelocityAlphas,
    VelocityCmd, VelocityModel,
};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

const U: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };

/// Share 1 − exp(−2²/2) of a two-dimensional Gaussian that lies within two standard deviations.
const TWO_SIGMA_FRACTION: f64 = 0.864_664_716_763_387_3;

/// If ξ is a Gaussian of rank 2, its 2σ contour, mapped by exp, contains the same fraction of robots. The outline separates inside from
/// outside.
#[test]
fn the_exponential_contour_covers_two_deviations() {
    let start = SE2::new(2.0, -1.0, 0.8);
    let alphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]);
    let model = VelocityModel { alphas, noise: NoiseKind::Normal };
    let mut rng = seeded_rng(134);
    let poses: Vec<SE2> = (0..200_000).map(|_| model.sample(&U, &start, &mut rng)).collect();
    let fraction_inside = |moments: &ExponentialMoments| {
        let contour = ExponentialContour::new(moments, &start);
        poses.iter().filter(|pose| contour.contains(pose)).count() as f64 / 200_000.0
    };
    let error = (TWO_SIGMA_FRACTION * (1.0 - TWO_SIGMA_FRACTION) / 200_000.0).sqrt();
    let exact =
        ExponentialMoments { mean: TangentNoiseModel::twist(&U), cov: model.tangent_cov(&U).unwrap() };
    assert!(
        (fraction_inside(&exact) - TWO_SIGMA_FRACTION).abs() < MAX_STANDARD_ERRORS * error,
        "{}",
        fraction_inside(&exact)
    );
    let fitted_fraction = fraction_inside(&ExponentialMoments::from_poses(&poses, &start));
    assert!((fitted_fraction - TWO_SIGMA_FRACTION).abs() < MAX_STANDARD_ERRORS * error, "{fitted_fraction}");

    let contour = ExponentialContour::new(&exact, &start);
    let outline = contour.boundary(48);
    assert_eq!(outline.first(), outline.last());
    for &[x, y] in &outline {
        // In exponential coordinates the outline is the 2σ ellipse of (along, heading).
        let inversion = motion::invert_arc(&start, &SE2::new(x, y, 0.0), 1.0);
        let radius = ((inversion.v_hat - 1.0).powi(2) + (inversion.omega_hat - 0.5).powi(2)) / 0.025;
        assert!((radius - 4.0).abs() < 1e-9, "{radius}");
        for (scale, is_inside) in [(0.99, true), (1.01, false)] {
            let v = 1.0 + scale * (inversion.v_hat - 1.0);
            let turn = 0.5 + scale * (inversion.omega_hat - 0.5);
            assert_eq!(contour.contains(&start.boxplus(Vector3::new(v, 0.0, turn))), is_inside);
        }
    }
}

/// The outline of an ellipsoid is nearly the edge of its projection. Among all ξ that lead to a point of the outline, with any heading,
/// the nearest to the mean is two standard deviations away, or a little less. The test finds it by trying headings.
#[test]
fn the_outline_is_nearly_the_shadow_of_the_ellipsoid() {
    let cases = [
        (
            Vector3::new(1.0, 0.0, 0.5),
            Matrix3::new(0.06, 0.001, 0.002, 0.001, 0.003, -0.006, 0.002, -0.006, 0.08),
        ),
        (Vector3::new(1.4, 0.1, -1.2), Matrix3::new(0.05, 0.0, 0.01, 0.0, 0.02, 0.01, 0.01, 0.01, 0.1)),
    ];
    for (mean, cov) in cases {
        let start = SE2::new(2.0, -1.0, 0.7);
        let inverse_cov = cov.try_inverse().unwrap();
        let heading_std = f64::sqrt(cov[(2, 2)]);
        for [x, y] in ExponentialContour::new(&ExponentialMoments { mean, cov }, &start).boundary(48) {
            let distance = |heading: f64| {
                let relative_pose = start.inverse() * SE2::new(x, y, start.theta() + heading);
                let offset = relative_pose.log_near(heading) - mean;
                offset.dot(&(inverse_cov * offset)).sqrt()
            };
            // Minimizes the distance over 4001 headings within three standard deviations. The step is so small that the
            // minimum is too large by less than 1e-5.
            let headings = (0..=4000).map(|i| mean.z + heading_std * 3.0 * (f64::from(i) / 2000.0 - 1.0));
            let min_distance = headings.map(distance).fold(f64::INFINITY, f64::min);
            assert!((1.9..2.0 + 1e-5).contains(&min_distance), "({x}, {y}): {min_distance}");
        }
    }
}

#[test]
fn predicted_skews_match_the_references() {
    for row in Table::parse(include_str!("../../reference/pushed_skew.csv")).rows() {
        let mean = Vector3::from(row.all(["a", "b", "w"]));
        let [aa, ab, aw, bb, bw, ww] = row.all(["caa", "cab", "caw", "cbb", "cbw", "cww"]);
        let cov = Matrix3::new(aa, ab, aw, ab, bb, bw, aw, bw, ww);
        let skew = predicted_cross_track_skew(&mean, &cov);
        assert!((skew - row.get("skew")).abs() < 1e-12, "{mean} {cov}: {skew}, not {}", row.get("skew"));
    }
}

const MOMENT_COLUMNS: [&str; 8] = ["mx", "my", "sxx", "sxy", "syy", "sxt", "syt", "stt"];

fn assert_exact(exact: &ExactMoments, row: &crate::common::Row<'_>) {
    let computed = [
        exact.mean.x,
        exact.mean.y,
        exact.cov[(0, 0)],
        exact.cov[(0, 1)],
        exact.cov[(1, 1)],
        exact.cov[(0, 2)],
        exact.cov[(1, 2)],
        exact.cov[(2, 2)],
    ];
    for (name, value) in MOMENT_COLUMNS.into_iter().zip(computed) {
        assert!((value - row.get(name)).abs() < 1e-14, "{name}: {value}, not {}", row.get(name));
    }
    assert!((exact.cov - exact.cov.transpose()).amax() < 1e-15);
    let skew = exact.cross_track_skew;
    assert!((skew - row.get("skew")).abs() < 1e-12, "skew {skew}, not {}", row.get("skew"));
}

#[test]
fn exact_moments_match_the_references() {
    for row in Table::parse(include_str!("../../reference/velocity_moments.csv")).rows() {
        let alphas = VelocityAlphas(row.all(["a1", "a2", "a3", "a4", "a5", "a6"]));
        let [v, omega, dt] = row.all(["v", "omega", "dt"]);
        let model = VelocityModel { alphas, noise: row.kind() };
        let exact = ExactMoments::of_velocity(&model, &VelocityCmd { v, omega, dt });
        assert!((exact.mean.z - wrap_angle(omega * dt)).abs() < 1e-15);
        assert_exact(&exact, &row);
    }
    for row in Table::parse(include_str!("../../reference/odometry_moments.csv")).rows() {
        let [rot1, trans, rot2] = row.all(["rot1", "trans", "rot2"]);
        let model =
            OdometryModel { alphas: OdomAlphas(row.all(["a1", "a2", "a3", "a4"])), noise: row.kind() };
        let exact = ExactMoments::of_odometry(&model, &OdomDelta { rot1, trans, rot2 });
        assert!((exact.mean.z - wrap_angle(rot1 + rot2)).abs() < 1e-15);
        assert_exact(&exact, &row);
    }
}

/// In clouds without a spread the skew, its error and the correlation are NaN, and no robot is inside a contour.
#[test]
fn degenerate_clouds_give_nan() {
    let poses_on_line = |heading: f64| {
        let mut rng = seeded_rng(145);
        (0..100)
            .map(|_| {
                let s = uniform(&mut rng, -1.0, 1.0);
                SE2::new(0.1 + s * heading.cos(), 0.7 + s * heading.sin(), heading)
            })
            .collect::<Vec<_>>()
    };
    for cloud in [vec![], poses_on_line(2.0), poses_on_line(-0.3)] {
        let stats = CrossTrack::from_poses(&cloud);
        for value in [stats.skew, stats.skew_error, stats.rho_heading, cross_track_skew(&cloud)] {
            assert!(value.is_nan(), "{stats:?}");
        }
        let cartesian = CartesianMoments::from_poses(&cloud);
        let exponential = ExponentialMoments::from_poses(&cloud, &SE2::identity());
        assert_eq!(cartesian.mean.iter().any(|m| m.is_nan()), cloud.is_empty());
        assert_eq!(exponential.mean.iter().any(|m| m.is_nan()), cloud.is_empty());
        let ellipse = Ellipse::from_moments(&cartesian);
        assert!(cloud.iter().all(|pose| !ellipse.contains([pose.x(), pose.y()])));
        assert_eq!(ellipse.boundary(16).len(), 17);
        assert_eq!(ExponentialContour::new(&exponential, &SE2::identity()).boundary(16).len(), 17);
    }
    // All pairs of poses have the same shape, so that their skew is undefined. Three poses have one.
    let three_poses = [SE2::new(0.0, 0.1, 0.0), SE2::new(1.0, -0.1, 0.0), SE2::new(0.5, -0.1, 0.0)];
    assert!(cross_track_skew(&three_poses[..2]).is_nan());
    assert!((cross_track_skew(&three_poses) - 0.5f64.sqrt()).abs() < 1e-12, "residuals −1, −1 and 2");
    assert!(predicted_cross_track_skew(&Vector3::zeros(), &Matrix3::zeros()).is_nan());
    // With a turn of π, the lateral coordinate moves the end along the heading, so that there is no spread across it.
    for turn in [PI, -PI] {
        let lateral_cov = Matrix3::from_diagonal(&Vector3::y());
        assert!(predicted_cross_track_skew(&Vector3::new(0.0, 0.0, turn), &lateral_cov).is_nan());
    }
    let along_only_model =
        VelocityModel { alphas: VelocityAlphas([0.1, 0.0, 0.0, 0.0, 0.0, 0.0]), noise: NoiseKind::Normal };
    let noise_free_model = VelocityModel { alphas: VelocityAlphas([0.0; 6]), ..along_only_model };
    assert!(ExactMoments::of_velocity(&noise_free_model, &U).cross_track_skew.is_nan());
    assert!(
        ExactMoments::of_velocity(&along_only_model, &VelocityCmd { omega: 0.0, ..U })
            .cross_track_skew
            .is_nan()
    );
}

/// A width of the size of rounding counts as 0, also if robots drive forward and in reverse so that their mean is at the start. Lengths
/// have a standard deviation of a millimetre here, and turns of `turn`.
#[test]
fn a_width_of_the_size_of_rounding_counts_as_zero() {
    const TINY_SPEED: f64 = 1e-6;
    let skews = |turn: f64| {
        let turn_per_speed = turn / TINY_SPEED;
        let velocity_alphas = [1e6, 0.0, turn_per_speed * turn_per_speed, 0.0, 0.0, 0.0];
        let command = VelocityCmd { v: TINY_SPEED, omega: 0.0, dt: 1.0 };
        let settings = Settings { command, velocity_alphas, samples: 1000, ..Settings::default() };
        let simulation = BananaMachine::new(settings).expect("a valid setting");
        let poses: Vec<SE2> = simulation.poses().collect();
        [simulation.stats().cross_track_skew, CrossTrack::from_poses(&poses).skew]
    };
    // The bearing is half the turn. The width of the cloud is therefore 5e-14 of its length.
    assert!(skews(1e-13).into_iter().all(f64::is_nan));
    let [reported, plain] = skews(1e-9);
    assert!((reported - plain).abs() < 1e-9 && plain.is_finite(), "{reported}, not {plain}");
}

/// A spread that is only rounding of a distant cloud counts as 0, too. At a kilometre, coordinates are rounded to 1e-13 m.
#[test]
fn a_width_of_the_size_of_position_rounding_counts_as_zero() {
    const TINY_WIDTH: f64 = 1e-10;
    let skew = |[x, y]: [f64; 2]| {
        let mut rng = seeded_rng(146);
        let mut offset = || uniform(&mut rng, -TINY_WIDTH, TINY_WIDTH);
        let poses: Vec<SE2> = (0..100).map(|_| SE2::new(x + offset(), y + offset(), 0.3)).collect();
        cross_track_skew(&poses)
    };
    for centre in [[1e3, 0.0], [-1e3, 0.0], [0.0, 1e3], [1e3, -1e3]] {
        assert!(skew(centre).is_nan(), "{centre:?}");
    }
    assert!(skew([0.0, 0.0]).is_finite() && skew([1.0, -1.0]).is_finite());
}
