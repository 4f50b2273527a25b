//! Likelihood gains and ratios of areas: compared with their definitions and references, and undefined for degenerate clouds.

use crate::common::{NOISE_KINDS, Table, mean, preset, variance};
use motion::geom::arc::{arc_with_turn_near, chord};
use motion::geom::se2::{SE2, wrap_angle};
use motion::sim::banana::{BananaMachine, ModelKind, PRESETS, Preset, Settings, Stats};
use motion::stats::{CartesianMoments, ExactGain};
use motion::{VelocityAlphas, VelocityCmd, VelocityModel};
use nalgebra::{DMatrix, DVector, Vector3};
use std::f64::consts::TAU;

const GENTLE_ALPHAS: [f64; 6] = [0.05, 0.05, 0.05, 0.09, 0.01, 0.01];
/// α's with noise mainly in the turn, which bend the cloud strongly and without skew.
const BANANA_ALPHAS: [f64; 6] = [0.002, 0.002, 0.1, 0.1, 0.002, 0.002];
const GENTLE_COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
const SHARP_COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 1.2, dt: 1.4 };
const STRAIGHT_COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.0, dt: 2.0 };

fn simulation(command: VelocityCmd, velocity_alphas: [f64; 6], samples: usize) -> BananaMachine {
    let settings = Settings { command, velocity_alphas, samples, ..Settings::default() };
    BananaMachine::new(settings).expect("a valid setting")
}

fn poses(simulation: &BananaMachine) -> Vec<SE2> {
    simulation.poses().collect()
}

/// Returns value and standard error of the likelihood gain of poses, and of that of positions (x, y).
fn gains(stats: &Stats) -> [[f64; 2]; 2] {
    let (value, error) = (stats.likelihood_gain, stats.likelihood_gain_error);
    [[value.pose, error.pose], [value.floor, error.floor]]
}

fn assert_close(name: &str, computed: f64, expected: f64, allowed: f64) {
    let are_equal = computed == expected || computed.is_nan() && expected.is_nan();
    assert!(are_equal || (computed - expected).abs() <= allowed, "{name}: {computed} is not {expected}");
}

// --------------------------------------------------------------------------------------------- the definition

/// Returns the log-density at each point of the Gaussian with the moments of all points, by inverse and determinant.
fn log_densities(points: &[DVector<f64>]) -> Vec<f64> {
    let (n, size) = (points.len() as f64, points[0].len());
    let mean = points.iter().sum::<DVector<f64>>() / n;
    let scatter = |p: &DVector<f64>| (p - &mean) * (p - &mean).transpose();
    let cov = points.iter().map(scatter).sum::<DMatrix<f64>>() / (n - 1.0);
    let (precision, volume) =
        (cov.clone().try_inverse().unwrap(), (TAU.powi(size as i32) * cov.determinant()).sqrt());
    let log_density_at = |p: &DVector<f64>| -0.5 * (p - &mean).dot(&(&precision * (p - &mean))) - volume.ln();
    points.iter().map(log_density_at).collect()
}

/// Returns the determinant of a map's Jacobian, by differences of fourth order. Its absolute error is about 1e-13.
fn determinant(map: impl Fn(&DVector<f64>) -> DVector<f64>, at: &DVector<f64>) -> f64 {
    const STEP: f64 = 1e-3;
    let columns: Vec<DVector<f64>> = (0..at.len())
        .map(|i| {
            let difference = |steps: f64| {
                let mut shifted_points = [at.clone(), at.clone()];
                shifted_points[0][i] += steps * STEP;
                shifted_points[1][i] -= steps * STEP;
                (map(&shifted_points[0]) - map(&shifted_points[1])) / (2.0 * steps * STEP)
            };
            (4.0 * difference(1.0) - difference(2.0)) / 3.0
        })
        .collect();
    DMatrix::from_columns(&columns).determinant()
}

/// Returns two gains in log-density of each robot. The gain of its pose compares a Gaussian in exponential coordinates with one in x, y, θ.
/// The gain of its position compares a Gaussian in arc coordinates with one in x, y.
fn robot_gains(cloud: &[SE2], turn: f64) -> [Vec<f64>; 2] {
    let heading = CartesianMoments::from_poses(cloud).mean.z;
    let coordinates: Vec<_> = cloud
        .iter()
        .map(|p| DVector::from_vec(vec![p.x(), p.y(), wrap_angle(p.theta() - heading)]))
        .collect();
    let positions: Vec<_> = cloud.iter().map(|p| DVector::from_vec(vec![p.x(), p.y()])).collect();
    let twists: Vec<_> =
        cloud.iter().map(|p| DVector::from_column_slice(p.log_near(turn).as_slice())).collect();
    let arcs: Vec<_> = cloud
        .iter()
        .map(|p| arc_with_turn_near(&SE2::identity(), p, turn))
        .map(|(length, turn)| DVector::from_vec(vec![length, turn]))
        .collect();
    let pose_of_twist = |xi: &DVector<f64>| {
        let pose = SE2::exp(&Vector3::new(xi[0], xi[1], xi[2]));
        DVector::from_vec(vec![pose.x(), pose.y(), xi[2]])
    };
    let position_of_arc = |arc: &DVector<f64>| {
        let (x, y) = chord(arc[0], arc[1]);
        DVector::from_vec(vec![x, y])
    };
    let gains_of =
        |cartesian: &[DVector<f64>], curved: &[DVector<f64>], map: &dyn Fn(&DVector<f64>) -> DVector<f64>| {
            let (cartesian, log) = (log_densities(cartesian), log_densities(curved));
            let robots = curved.iter().zip(cartesian.iter().zip(&log));
            robots.map(|(at, (cartesian, log))| log - determinant(map, at).abs().ln() - cartesian).collect()
        };
    [gains_of(&coordinates, &twists, &pose_of_twist), gains_of(&positions, &arcs, &position_of_arc)]
}

/// The simulation computes the gain from sums, for every model and size. It computes the error from all robots up to 2048, and from a sample
/// of a larger cloud.
#[test]
fn the_gain_equals_its_definition_over_all_poses() {
    for model in [ModelKind::Velocity, ModelKind::Odometry] {
        for noise in NOISE_KINDS {
            for [v, omega, dt] in
                [[1.0, 0.5, 1.0], [-1.0, 1.2, 1.4], [0.06, -1.5, 1.0], [2.0, 0.0, 2.0], [1.0, 2.2, 1.2]]
            {
                for samples in [1, 3, 4, 257, 2048, 5_003] {
                    let command = VelocityCmd { v, omega, dt };
                    let odometry_alphas = [0.02, 0.01, 0.02, 0.01];
                    let settings =
                        Settings { model, noise, command, odometry_alphas, samples, ..preset("gentle") };
                    let simulation = BananaMachine::new(settings).expect("a valid setting");
                    let gains_found = gains(simulation.stats());
                    let case_name = format!("{model:?} {noise:?} {command:?} {samples}");
                    if samples > 4 {
                        let robot_gains = robot_gains(&poses(&simulation), omega * dt);
                        for ([value, error], robot_gains) in gains_found.into_iter().zip(robot_gains) {
                            assert_close(&case_name, value, mean(&robot_gains), 1e-9);
                            if samples <= 2048 {
                                let expected = (variance(&robot_gains) / samples as f64).sqrt();
                                assert_close(&case_name, error, expected, 1e-8 * expected);
                            }
                        }
                    }
                    assert_eq!(gains_found[0][0].is_nan(), samples < 4, "{case_name}");
                    assert_eq!(gains_found[1][0].is_nan(), samples < 3, "{case_name}");
                }
            }
        }
    }
}

// ---------------------------------------------------------------------------------------------- exact values

/// The references integrate each noise up to 6 or 6.6 standard deviations. Their steps do not end at the jump between two branches. Both
/// change a gain by up to 1e-6. Where an outline crosses itself, a chord may belong to either loop, which changes an area by up to 1e-4.
#[test]
fn exact_gains_match_the_references() {
    for row in Table::parse(include_str!("../../reference/likelihood_gain.csv")).rows() {
        let velocity_alphas = row.all(["a1", "a2", "a3", "a4", "a5", "a6"]);
        let [v, omega, dt] = row.all(["v", "omega", "dt"]);
        let command = VelocityCmd { v, omega, dt };
        let settings =
            Settings { command, velocity_alphas, noise: row.kind(), samples: 1, ..Settings::default() };
        let exact = BananaMachine::new(settings).expect("a valid setting").table().exact;
        let name = format!("{command:?} {velocity_alphas:?}");
        assert_close(&name, exact.likelihood_gain.pose, row.get("pose"), 1e-6);
        assert_close(&name, exact.likelihood_gain.floor, row.get("floor"), 1e-6);
        assert_close(&name, exact.area_ratio, row.get("area_ratio"), 1e-4);
        let model = VelocityModel { alphas: VelocityAlphas(velocity_alphas), noise: row.kind() };
        assert_eq!(ExactGain::of_velocity(&model, &command).value.floor, exact.likelihood_gain.floor);
    }
}

/// The last turn γ̂ does not change the position.
#[test]
fn the_gain_on_the_floor_does_not_depend_on_the_last_turn() {
    for Preset { command, .. } in PRESETS {
        let floor_gains = |last: f64| {
            let simulation = simulation(command, [0.05, 0.05, 0.05, 0.09, last, last], 10_000);
            [simulation.stats().likelihood_gain.floor, simulation.exact_gain().value.floor]
        };
        let without_turn = floor_gains(0.0);
        assert!(without_turn.iter().all(|gain| gain.is_finite()), "{command:?}");
        for last_turn_alpha in [1e-9, 0.01, 0.3] {
            for (gain, without_turn) in floor_gains(last_turn_alpha).into_iter().zip(without_turn) {
                assert_close("floor", gain, without_turn, 1e-12);
            }
        }
    }
    // The gain on the floor is also defined if headings spread over a full turn, where exponential coordinates are undefined.
    let wide_cloud = simulation(GENTLE_COMMAND, [0.05, 0.05, 0.05, 0.09, 5.0, 5.0], 10_000);
    assert!(!wide_cloud.is_chart_defined());
    let Stats { likelihood_gain: gain, likelihood_gain_error: error, area_ratio, .. } = wide_cloud.stats();
    assert!(gain.pose.is_nan() && error.pose.is_nan() && area_ratio.is_nan());
    assert_close(
        "floor",
        gain.floor,
        simulation(GENTLE_COMMAND, GENTLE_ALPHAS, 10_000).stats().likelihood_gain.floor,
        1e-12,
    );
}

// --------------------------------------------------------------------------------------------------- the areas

/// The expected areas are those of the drawn outlines, by the shoelace formula.
#[test]
fn the_area_ratio_is_that_of_the_drawn_outlines() {
    let area = |outline: &[[f64; 2]]| -> f64 {
        outline.windows(2).map(|w| 0.5 * (w[0][0] * w[1][1] - w[1][0] * w[0][1])).sum::<f64>().abs()
    };
    for (command, alphas) in [
        (GENTLE_COMMAND, GENTLE_ALPHAS),
        (SHARP_COMMAND, GENTLE_ALPHAS),
        (STRAIGHT_COMMAND, BANANA_ALPHAS),
        (VelocityCmd { v: -1.0, ..SHARP_COMMAND }, BANANA_ALPHAS),
    ] {
        let simulation = simulation(command, alphas, 5000);
        let contours = simulation.contours();
        let ratio = area(&contours.ellipse) / area(&contours.exponential);
        assert_close("ratio", simulation.stats().area_ratio, ratio, 1e-12 * ratio);
    }
}

/// The reported error is compared with the standard deviation of the ratio over independent clouds. Over 20,000 clouds of 1000 robots it is
/// 0.89 to 0.99 times that, because it is computed from the outline in arc coordinates instead of the one in ξ.
#[test]
fn the_error_of_the_area_ratio_matches_its_deviation_over_clouds() {
    const CLOUDS: usize = 300;
    for Preset { name, command, alphas } in PRESETS {
        let stats_of = |seed: usize| {
            let seed = seed as u64;
            let settings =
                Settings { command, velocity_alphas: alphas, samples: 1000, seed, ..Settings::default() };
            *BananaMachine::new(settings).expect("a valid setting").stats()
        };
        let clouds: Vec<Stats> = (0..CLOUDS).map(stats_of).collect();
        let ratio_std = variance(&clouds.iter().map(|cloud| cloud.area_ratio).collect::<Vec<_>>()).sqrt();
        let mean_error = mean(&clouds.iter().map(|cloud| cloud.area_ratio_error).collect::<Vec<_>>());
        // The relative standard error of a standard deviation is 1/√(2·CLOUDS).
        assert_close(name, mean_error / ratio_std, 0.94, 0.05 + 4.0 / (2.0 * CLOUDS as f64).sqrt());
    }
}

// ---------------------------------------------------------------------------------------- undefined and infinite

/// Without the last turn γ̂ the poses lie on a curved surface, which is a plane in exponential coordinates.
#[test]
fn the_gain_is_infinite_if_only_exponential_coordinates_have_no_volume() {
    for noise in NOISE_KINDS {
        for Preset { command, .. } in PRESETS {
            for samples in [5, 2000, 30_000] {
                let velocity_alphas = [0.05, 0.05, 0.05, 0.09, 0.0, 0.0];
                let settings = Settings { command, velocity_alphas, noise, samples, ..Settings::default() };
                let flat_simulation = BananaMachine::new(settings).expect("a valid setting");
                let Stats { likelihood_gain: value, likelihood_gain_error: error, .. } =
                    flat_simulation.stats();
                assert!(
                    value.pose == f64::INFINITY && error.pose.is_nan(),
                    "{command:?} {samples}: {value:?}"
                );
                assert!(value.floor.is_finite() && error.floor > 0.0, "{command:?} {samples}");
                let exact = flat_simulation.table().exact.likelihood_gain;
                assert!(exact.pose == f64::INFINITY && exact.floor.is_finite(), "{command:?}");
            }
            // With a tiny variance of γ̂ the gain is finite. It grows by half a nat if that variance falls by a factor e.
            let pose_gain = |last: f64| {
                simulation(command, [0.05, 0.05, 0.05, 0.09, last, last], 5000).stats().likelihood_gain.pose
            };
            assert_close("growth", pose_gain(1e-16) - pose_gain(1e-14), 100f64.ln() / 2.0, 1e-4);
        }
    }
    // The cloud is a curve in the plane, and a straight line in exponential coordinates.
    let fan = simulation(STRAIGHT_COMMAND, [0.0, 0.0, 0.02, 0.0, 0.0, 0.0], 2000);
    let Stats { likelihood_gain: gain, area_ratio, .. } = fan.stats();
    assert!(gain.pose == f64::INFINITY && gain.floor == f64::INFINITY && area_ratio.is_nan());
    assert_eq!(fan.table().exact.likelihood_gain, *gain);
}

/// For robots on a line through the start the gain is undefined, for any headings.
#[test]
fn robots_on_a_line_have_no_gain() {
    for (command, alphas) in [
        (STRAIGHT_COMMAND, [0.1, 0.0, 0.0, 0.0, 0.0, 0.0]),
        (STRAIGHT_COMMAND, [0.1, 0.0, 0.0, 0.0, 0.1, 0.0]),
        (GENTLE_COMMAND, [0.1, 0.1, 0.0, 0.0, 0.0, 0.0]),
    ] {
        let simulation = simulation(command, alphas, 5000);
        for gain in [simulation.stats().likelihood_gain, simulation.table().exact.likelihood_gain] {
            assert!(gain.pose.is_nan() && gain.floor.is_nan(), "{command:?} {alphas:?}: {gain:?}");
        }
        assert!(simulation.stats().area_ratio.is_nan() && simulation.stats().coverage.ellipse.is_nan());
    }
}
