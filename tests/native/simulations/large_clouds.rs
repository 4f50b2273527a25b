//! Statistics of up to ten million robots, compared with sums in twice the precision.

use crate::common::settings_of_preset;
use crate::simulations::banana::{check_in_varied_clouds, new_simulation};
use motion::VelocityCmd;
use motion::geom::se2::{SE2, wrap_angle};
use motion::sim::banana::{BananaMachine, MAX_SAMPLES, Settings, Stats};
use motion::stats::{CartesianMoments, CrossTrackStats, Ellipse};
use nalgebra::Vector3;

/// Sum in twice the precision, which also sums the rounding errors (Knuth's two-sum). Its relative error is 1e-30.
#[derive(Clone, Copy, Default)]
struct CompensatedSum {
    rounded_sum: f64,
    rounding_errors: f64,
}

impl CompensatedSum {
    fn add(&mut self, added_term: f64) {
        let new_sum = self.rounded_sum + added_term;
        let rounded_term = new_sum - self.rounded_sum;
        self.rounding_errors += (self.rounded_sum - (new_sum - rounded_term)) + (added_term - rounded_term);
        self.rounded_sum = new_sum;
    }
}

fn exact_mean(added_terms: impl Iterator<Item = f64>) -> f64 {
    let (mut running_sum, mut term_count) = (CompensatedSum::default(), 0.0);
    for added_term in added_terms {
        running_sum.add(added_term);
        term_count += 1.0;
    }
    (running_sum.rounded_sum + running_sum.rounding_errors) / term_count
}

fn assert_close(quantity_name: &str, actual: f64, exact: f64, value_magnitude: f64) {
    assert!((actual - exact).abs() <= 1e-12 * value_magnitude, "{quantity_name}: {actual} is not {exact}");
}

/// Asserts that statistics of a cloud equal their definitions. `cross_track` holds three of them: skew, skew error, correlation with the heading.
fn assert_exact_moments(poses: &[SE2], computed_moments: &CartesianMoments, cross_track: [f64; 3]) {
    let n = poses.len() as f64;
    let (sin, cos) = (
        exact_mean(poses.iter().map(|pose| libm::sin(pose.theta()))),
        exact_mean(poses.iter().map(|pose| libm::cos(pose.theta()))),
    );
    let mean_heading = libm::atan2(sin, cos);
    let mean_position = [exact_mean(poses.iter().map(SE2::x)), exact_mean(poses.iter().map(SE2::y))];
    assert_close("mean heading", computed_moments.mean.z, mean_heading, 1.0);
    assert_close("mean x", computed_moments.mean.x, mean_position[0], 1.0);
    assert_close("mean y", computed_moments.mean.y, mean_position[1], 1.0);

    let iter_pose_residuals = || {
        poses.iter().map(|pose| {
            Vector3::new(
                pose.x() - mean_position[0],
                pose.y() - mean_position[1],
                wrap_angle(pose.theta() - mean_heading),
            )
        })
    };
    let mean_heading_residual = exact_mean(iter_pose_residuals().map(|r| r.z));
    for i in 0..3 {
        for j in 0..3 {
            let subtract_expected_mean =
                |r: Vector3<f64>, k: usize| if k == 2 { r.z - mean_heading_residual } else { r[k] };
            let expected_cov = exact_mean(
                iter_pose_residuals().map(|r| subtract_expected_mean(r, i) * subtract_expected_mean(r, j)),
            ) * n
                / (n - 1.0);
            let std_product = (computed_moments.cov[(i, i)] * computed_moments.cov[(j, j)]).sqrt();
            assert_close(&format!("cov {i}{j}"), computed_moments.cov[(i, j)], expected_cov, std_product);
        }
    }

    let (sin, cos) = libm::sincos(mean_heading);
    let to_track_coordinates = |r: Vector3<f64>| (r.x * cos + r.y * sin, r.y * cos - r.x * sin, r.z);
    let iter_track_coordinates = || iter_pose_residuals().map(to_track_coordinates);
    let lateral_variance = exact_mean(iter_track_coordinates().map(|(_, d, _)| d * d));
    let lateral_std = lateral_variance.sqrt();
    let expected_skew = exact_mean(iter_track_coordinates().map(|(_, d, _)| (d / lateral_std).powi(3)));
    assert_close("skew", cross_track[0], expected_skew, 1.0);
    let mean_resultant_length = exact_mean(iter_pose_residuals().map(|r| libm::cos(r.z)));
    let (along_lateral_mean, along_lateral_square_mean) = (
        exact_mean(iter_track_coordinates().map(|(a, d, _)| a * d)),
        exact_mean(iter_track_coordinates().map(|(a, d, _)| a * d * d)),
    );
    let heading_factor = 3.0
        * (expected_skew * along_lateral_mean / lateral_variance
            - along_lateral_square_mean / (lateral_variance * lateral_std))
        / mean_resultant_length;
    let influence_on_skew = |(_, d, twist_turn): (f64, f64, f64)| {
        let z = d / lateral_std;
        z * z * z - expected_skew - 3.0 * z - 1.5 * expected_skew * (z * z - 1.0)
            + heading_factor * libm::sin(twist_turn)
    };
    let expected_skew_error = (exact_mean(
        iter_track_coordinates().map(|track_coordinates| influence_on_skew(track_coordinates).powi(2)),
    ) / n)
        .sqrt();
    assert_close("skew error", cross_track[1], expected_skew_error, expected_skew_error);
    let heading_variance = exact_mean(iter_pose_residuals().map(|r| (r.z - mean_heading_residual).powi(2)));
    let expected_correlation = exact_mean(iter_track_coordinates().map(|(_, d, twist_turn)| d * twist_turn))
        / (lateral_variance * heading_variance).sqrt();
    assert_close("rho", cross_track[2], expected_correlation, 1.0);
}

fn assert_stats_are_exact(simulation: &BananaMachine) {
    let poses: Vec<SE2> = simulation.poses().collect();
    let n = poses.len() as f64;
    let cloud_stats @ Stats { cartesian: cartesian_moments, exponential, .. } = *simulation.stats();
    let cross_track =
        [cloud_stats.cross_track_skew, cloud_stats.cross_track_skew_error, cloud_stats.rho_cross_heading];
    assert_exact_moments(&poses, &cartesian_moments, cross_track);

    let pose_twist =
        |pose: &SE2| pose.log_near(simulation.settings().command.omega * simulation.settings().command.dt);
    let iter_robot_twists = || poses.iter().map(pose_twist);
    let twist_mean = Vector3::from_fn(|i, _| exact_mean(iter_robot_twists().map(|pose_twist| pose_twist[i])));
    for i in if simulation.is_exponential_defined() { 0..3 } else { 0..0 } {
        assert_close(&format!("twist {i}"), exponential.mean[i], twist_mean[i], 1.0);
        for j in 0..3 {
            let expected_cov =
                exact_mean(iter_robot_twists().map(|t| (t[i] - twist_mean[i]) * (t[j] - twist_mean[j]))) * n
                    / (n - 1.0);
            let std_product = (exponential.cov[(i, i)] * exponential.cov[(j, j)]).sqrt();
            assert_close(&format!("twist cov {i}{j}"), exponential.cov[(i, j)], expected_cov, std_product);
        }
    }

    let covariance_ellipse = Ellipse::from_moments(&cartesian_moments);
    let inside_count = poses.iter().filter(|pose| covariance_ellipse.contains([pose.x(), pose.y()])).count();
    // Rounding may decide whether one robot on the contour is inside.
    assert_close("coverage", cloud_stats.coverage.ellipse, inside_count as f64 / n, 1.5e12 / n);
}

#[test]
#[ignore = "nightly: 10 million robots"]
fn statistics_of_ten_million_robots_agree_with_exact_sums() {
    let command = VelocityCmd { v: 1.0, omega: 1.2, dt: 1.4 };
    assert_stats_are_exact(&new_simulation(Settings {
        command,
        samples: MAX_SAMPLES,
        ..settings_of_preset("gentle")
    }));
}

/// In some of these clouds robots turn by more than a full circle, or end far from the noise-free pose.
#[test]
fn statistics_of_small_and_unusual_clouds_agree_with_exact_sums() {
    check_in_varied_clouds([1.0, 3.0, 1.9], &[3, 257, 5003], |simulation, _| {
        assert_stats_are_exact(simulation);
        let poses: Vec<SE2> = simulation.poses().collect();
        let CrossTrackStats { skew: track_skew, skew_error, rho_heading } =
            CrossTrackStats::from_poses(&poses);
        let computed_moments = CartesianMoments::from_poses(&poses);
        assert_exact_moments(&poses, &computed_moments, [track_skew, skew_error, rho_heading]);
    });
}
