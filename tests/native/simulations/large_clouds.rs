//! Statistics of up to ten million robots, compared with sums in twice the precision.

use crate::common::preset;
use crate::simulations::banana::simulation;
use motion::geom::se2::{SE2, wrap_angle};
use motion::sim::banana::{BananaMachine, MAX_SAMPLES, ModelKind, Settings, Stats};
use motion::stats::{CartesianMoments, CrossTrack, Ellipse};
use motion::{NoiseKind, VelocityCmd};
use nalgebra::Vector3;

/// Sum in twice the precision (Knuth's two-sum, with a sum of the rounding errors). Its relative error is 1e-30.
#[derive(Clone, Copy, Default)]
struct ExactSum {
    sum: f64,
    rounding: f64,
}

impl ExactSum {
    fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        let rounded_term = sum - self.sum;
        self.rounding += (self.sum - (sum - rounded_term)) + (term - rounded_term);
        self.sum = sum;
    }
}

fn mean(terms: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (ExactSum::default(), 0.0);
    for term in terms {
        sum.add(term);
        count += 1.0;
    }
    (sum.sum + sum.rounding) / count
}

fn assert_close(name: &str, found: f64, expected: f64, scale: f64) {
    assert!((found - expected).abs() <= 1e-12 * scale, "{name}: {found} is not {expected}");
}

/// Asserts that moments of a cloud, and its skew, skew error and correlation with the heading, equal their definitions.
fn assert_exact_moments(poses: &[SE2], cartesian: &CartesianMoments, cross_track: [f64; 3]) {
    let n = poses.len() as f64;
    let (sin, cos) = (
        mean(poses.iter().map(|pose| libm::sin(pose.theta()))),
        mean(poses.iter().map(|pose| libm::cos(pose.theta()))),
    );
    let heading = libm::atan2(sin, cos);
    let centre = [mean(poses.iter().map(SE2::x)), mean(poses.iter().map(SE2::y))];
    assert_close("mean heading", cartesian.mean.z, heading, 1.0);
    assert_close("mean x", cartesian.mean.x, centre[0], 1.0);
    assert_close("mean y", cartesian.mean.y, centre[1], 1.0);

    let residuals = || {
        poses.iter().map(|pose| {
            Vector3::new(pose.x() - centre[0], pose.y() - centre[1], wrap_angle(pose.theta() - heading))
        })
    };
    let mean_turn = mean(residuals().map(|r| r.z));
    for i in 0..3 {
        for j in 0..3 {
            let centred_component = |r: Vector3<f64>, k: usize| if k == 2 { r.z - mean_turn } else { r[k] };
            let cov =
                mean(residuals().map(|r| centred_component(r, i) * centred_component(r, j))) * n / (n - 1.0);
            let scale = (cartesian.cov[(i, i)] * cartesian.cov[(j, j)]).sqrt();
            assert_close(&format!("cov {i}{j}"), cartesian.cov[(i, j)], cov, scale);
        }
    }

    let (sin, cos) = libm::sincos(heading);
    let track_coordinates = |r: Vector3<f64>| (r.x * cos + r.y * sin, r.y * cos - r.x * sin, r.z);
    let all_track_coordinates = || residuals().map(track_coordinates);
    let m2 = mean(all_track_coordinates().map(|(_, d, _)| d * d));
    let sd = m2.sqrt();
    let skew = mean(all_track_coordinates().map(|(_, d, _)| (d / sd).powi(3)));
    assert_close("skew", cross_track[0], skew, 1.0);
    let resultant = mean(residuals().map(|r| libm::cos(r.z)));
    let (ad, add) = (
        mean(all_track_coordinates().map(|(a, d, _)| a * d)),
        mean(all_track_coordinates().map(|(a, d, _)| a * d * d)),
    );
    let heading_factor = 3.0 * (skew * ad / m2 - add / (m2 * sd)) / resultant;
    let influence = |(_, d, turn): (f64, f64, f64)| {
        let z = d / sd;
        z * z * z - skew - 3.0 * z - 1.5 * skew * (z * z - 1.0) + heading_factor * libm::sin(turn)
    };
    let skew_error = (mean(all_track_coordinates().map(|track| influence(track).powi(2))) / n).sqrt();
    assert_close("skew error", cross_track[1], skew_error, skew_error);
    let turn_variance = mean(residuals().map(|r| (r.z - mean_turn).powi(2)));
    let rho = mean(all_track_coordinates().map(|(_, d, turn)| d * turn)) / (m2 * turn_variance).sqrt();
    assert_close("rho", cross_track[2], rho, 1.0);
}

/// Asserts that the simulation's statistics of its cloud equal their definitions.
fn assert_exact(simulation: &BananaMachine) {
    let poses: Vec<SE2> = simulation.poses().collect();
    let n = poses.len() as f64;
    let stats @ Stats { cartesian, exponential, .. } = *simulation.stats();
    let cross_track = [stats.cross_track_skew, stats.cross_track_skew_error, stats.rho_cross_heading];
    assert_exact_moments(&poses, &cartesian, cross_track);

    let twist_of =
        |pose: &SE2| pose.log_near(simulation.settings().command.omega * simulation.settings().command.dt);
    let twists = || poses.iter().map(twist_of);
    let twist_mean = Vector3::from_fn(|i, _| mean(twists().map(|twist_of| twist_of[i])));
    // A cloud that turns a full circle has no exponential coordinates to compare.
    for i in if simulation.is_chart_defined() { 0..3 } else { 0..0 } {
        assert_close(&format!("twist {i}"), exponential.mean[i], twist_mean[i], 1.0);
        for j in 0..3 {
            let cov = mean(twists().map(|t| (t[i] - twist_mean[i]) * (t[j] - twist_mean[j]))) * n / (n - 1.0);
            let scale = (exponential.cov[(i, i)] * exponential.cov[(j, j)]).sqrt();
            assert_close(&format!("twist cov {i}{j}"), exponential.cov[(i, j)], cov, scale);
        }
    }

    let ellipse = Ellipse::from_moments(&cartesian);
    let inside_count = poses.iter().filter(|pose| ellipse.contains([pose.x(), pose.y()])).count();
    // Rounding may decide whether one robot on the contour is inside.
    assert_close("coverage", stats.coverage.ellipse, inside_count as f64 / n, 1.5e12 / n);
}

#[test]
#[ignore = "nightly: 10 million robots"]
fn ten_million_agree_with_exact_sums() {
    let command = VelocityCmd { v: 1.0, omega: 1.2, dt: 1.4 };
    assert_exact(&simulation(Settings { command, samples: MAX_SAMPLES, ..preset("gentle") }));
}

/// Clouds of many shapes. In some of them robots turn by more than a full circle, or end far from the noise-free pose.
#[test]
fn small_and_unusual_clouds_agree_with_exact_sums() {
    for model in [ModelKind::Velocity, ModelKind::Odometry] {
        for noise in [NoiseKind::Normal, NoiseKind::Triangular] {
            for command in
                [[1.0, 0.5, 1.0], [-1.0, 1.2, 1.4], [0.06, -1.5, 1.0], [2.0, 0.0, 2.0], [1.0, 3.0, 1.9]]
            {
                for samples in [3, 257, 5003] {
                    let [v, omega, dt] = command;
                    let command = VelocityCmd { v, omega, dt };
                    let odometry_alphas = [0.02, 0.01, 0.02, 0.01];
                    let settings =
                        Settings { model, noise, command, odometry_alphas, samples, ..preset("gentle") };
                    let simulation = simulation(settings);
                    assert_exact(&simulation);
                    let poses: Vec<SE2> = simulation.poses().collect();
                    let CrossTrack { skew, skew_error, rho_heading } = CrossTrack::from_poses(&poses);
                    let cartesian = CartesianMoments::from_poses(&poses);
                    assert_exact_moments(&poses, &cartesian, [skew, skew_error, rho_heading]);
                }
            }
        }
    }
}
