//! The velocity model: scoring, density and sampler.

use crate::common::density::PolarGrid;
use crate::common::{NOISE_KINDS, derivative_by_noise, sample_uniform, seeded_rng};
use motion::geom::se2::SE2;
use motion::{MotionModel, NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

const ALPHAS_WITHOUT_LAST_TURN: VelocityAlphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0]);
const ALPHAS_WITH_LAST_TURN: VelocityAlphas = VelocityAlphas([0.05, 0.05, 0.05, 0.09, 0.01, 0.01]);

fn new_model(alphas: VelocityAlphas, noise_kind: NoiseKind) -> VelocityModel {
    VelocityModel { alphas, noise: noise_kind }
}

fn new_command(v: f64, omega: f64, duration: f64) -> VelocityCmd {
    VelocityCmd { v, omega, dt: duration }
}

fn noise_free_end_of(u: &VelocityCmd, x: &SE2) -> SE2 {
    new_model(ALPHAS_WITHOUT_LAST_TURN, NoiseKind::Normal).apply_noise(u, x, [0.0; 3])
}

/// Returns commands with all signs of v and ω, straight drives, and turns on the spot.
fn new_commands() -> Vec<VelocityCmd> {
    let command_signs = [(1.0, 0.5), (1.0, -0.5), (-1.0, 0.5), (-1.0, -0.5)];
    let mut all_commands: Vec<_> = command_signs.map(|(v, omega)| new_command(v, omega, 1.0)).to_vec();
    all_commands.extend(command_signs.map(|(v, omega)| new_command(0.3 * v, 4.0 * omega, 0.8)));
    all_commands.extend(
        [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)].map(|(v, omega)| new_command(v, omega, 1.3)),
    );
    all_commands
}

fn new_start_poses() -> [SE2; 3] {
    [SE2::identity(), SE2::new(-3.0, 7.0, 2.5), SE2::new(40.0, 0.1, -PI / 2.0)]
}

#[test]
fn prob_falls_off_as_the_noise_does() {
    // At one standard deviation, a Gaussian density is exp(−1/2) of its maximum, and a triangular density 1 − 1/√6.
    for (noise_kind, expected_ratio) in
        [(NoiseKind::Normal, (-0.5f64).exp()), (NoiseKind::Triangular, 1.0 - 1.0 / 6f64.sqrt())]
    {
        let velocity_model = new_model(ALPHAS_WITH_LAST_TURN, noise_kind);
        for u in new_commands().into_iter().filter(|u| u.v != 0.0) {
            for x in new_start_poses() {
                let peak_score = velocity_model.prob(&noise_free_end_of(&u, &x), &u, &x);
                for perturbed_control in 0..3 {
                    for residual_sign in [1.0, -1.0] {
                        let mut unit_noise = [0.0; 3];
                        unit_noise[perturbed_control] = residual_sign;
                        let table_score =
                            velocity_model.prob(&velocity_model.apply_noise(&u, &x, unit_noise), &u, &x);
                        assert!(
                            (table_score / peak_score - expected_ratio).abs() < 1e-9,
                            "{noise_kind:?} {u:?} noise {unit_noise:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn without_noise_samples_are_exact_and_prob_is_zero_or_one() {
    let mut rng = seeded_rng(53);
    for noise in NOISE_KINDS {
        let noise_free_model = new_model(VelocityAlphas([0.0; 6]), noise);
        for u in new_commands() {
            for x in new_start_poses() {
                let end_pose = noise_free_end_of(&u, &x);
                assert_eq!(noise_free_model.sample(&u, &x, &mut rng), end_pose);
                assert_eq!(noise_free_model.prob(&end_pose, &u, &x), 1.0);
                assert_eq!(
                    noise_free_model.prob(&end_pose.boxplus(Vector3::new(0.0, 0.0, 1e-3)), &u, &x),
                    0.0
                );
            }
        }
        let standstill_command = new_command(0.0, 0.0, 1.0);
        for x in new_start_poses() {
            assert_eq!(new_model(ALPHAS_WITH_LAST_TURN, noise).sample(&standstill_command, &x, &mut rng), x);
            assert_eq!(new_model(ALPHAS_WITH_LAST_TURN, noise).prob(&x, &standstill_command, &x), 1.0);
        }
    }
}

/// If γ̂ has no variance, γ̂ must be 0 up to rounding. This rounding is proportional to the distance from the origin divided by |v|Δt².
#[test]
fn samples_far_from_the_origin_have_a_positive_score() {
    let mut rng = seeded_rng(56);
    for (start_distance, u) in [
        (1000.0, new_command(1.0, 0.5, 0.01)),
        (100.0, new_command(-0.05, 0.05, 0.01)),
        (10.0, new_command(0.01, 0.0, 0.02)),
    ] {
        for alphas in [ALPHAS_WITHOUT_LAST_TURN, VelocityAlphas([0.0; 6])] {
            for _ in 0..1000 {
                let mut sample_within = |max_abs: f64| sample_uniform(&mut rng, -max_abs, max_abs);
                let x =
                    SE2::new(sample_within(start_distance), sample_within(start_distance), sample_within(PI));
                let unit_noise = [sample_within(2.0), sample_within(2.0), 0.0];
                let end_pose = new_model(alphas, NoiseKind::Normal).apply_noise(&u, &x, unit_noise);
                assert!(
                    new_model(alphas, NoiseKind::Normal).prob(&end_pose, &u, &x) > 0.0,
                    "{u:?} from {x:?} to {end_pose:?}"
                );
            }
        }
    }
}

/// Returns a grid around the noise-free pose, which reaches twice as far as triangular noise. The kinks of the triangular density, at
/// multiples of √6 deviations, lie on bounds of cells. In bearing, the grid reaches half as far as the noise of the turn: a chord turns
/// by half of the arc's turn.
fn new_grid_around(velocity_model: &VelocityModel, u: &VelocityCmd, x: &SE2) -> PolarGrid {
    let [v, omega, max_last_turn] =
        velocity_model.variances(u).map(|variance| 2.0 * (6.0 * variance.0).sqrt() * u.dt);
    PolarGrid::new(x, &noise_free_end_of(u, x), 2.0, [v, 0.5 * omega, max_last_turn], [8; 3])
}

/// With noise as large as the motion, robots also drive backwards and turn by more than a circle. On the spot, v̂ has either sign.
#[test]
fn the_pose_density_integrates_to_one_for_large_noise() {
    let x = SE2::new(1.0, -1.0, -2.0);
    let alphas_of_large_noise = VelocityAlphas([0.5, 0.5, 1.5, 1.5, 0.5, 0.5]);
    for (noise, tolerance, v, omega) in
        [(NoiseKind::Normal, 1e-5, 0.6, 0.9), (NoiseKind::Triangular, 2e-3, 0.0, 1.2)]
    {
        let u = new_command(v, omega, 1.5);
        let velocity_model = new_model(alphas_of_large_noise, noise);
        // No robot is further away than the length of its arc, and none drives seven standard deviations more than commanded.
        let max_distance = (v.abs() + 7.0 * velocity_model.variances(&u)[0].0.sqrt()) * u.dt;
        let integrate_over_cells = |cell_counts| {
            PolarGrid::around_start(&x, 2.0, max_distance, [cell_counts; 3])
                .integrate_density(|pose| velocity_model.pose_density(pose, &u, &x).unwrap())
        };
        // Arcs of a full turn end near the start. The integrand has a corner there, and the error is proportional to the width
        // of a cell. Extrapolation from two numbers of cells removes that error.
        let extrapolated_integral = 2.0 * integrate_over_cells(12) - integrate_over_cells(6);
        assert!((extrapolated_integral - 1.0).abs() < tolerance, "{noise:?} {u:?}: {extrapolated_integral}");
    }
}

/// The last turn γ̂ does not move the robot. Its noise therefore does not change the density of positions, even if the noise exceeds a full
/// turn. The density is summed over equally spaced headings. For noise of at least 0.1 rad, the sum is accurate to 1e-12.
#[test]
fn the_noise_of_the_last_turn_does_not_change_the_density_of_positions() {
    const HEADING_COUNT: u32 = 128;
    let x = SE2::new(1.0, -1.0, -2.0);
    let u = new_command(1.0, 0.5, 1.0);
    for (a, b) in [(1.0, 0.2), (0.8, 0.1)] {
        let end_position = x * SE2::new(a, b, 0.0);
        let density_of_position = |last_turn_std: f64| -> f64 {
            let alpha5 = last_turn_std * last_turn_std;
            let velocity_model =
                new_model(VelocityAlphas([0.05, 0.05, 0.05, 0.09, alpha5, 0.0]), NoiseKind::Normal);
            let heading_spacing = TAU / f64::from(HEADING_COUNT);
            let turned_poses = (0..HEADING_COUNT)
                .map(|i| SE2::new(end_position.x(), end_position.y(), heading_spacing * f64::from(i)));
            turned_poses.map(|pose| velocity_model.pose_density(&pose, &u, &x).unwrap()).sum::<f64>()
                * heading_spacing
        };
        let expected_density = density_of_position(0.1);
        assert!(expected_density > 0.01);
        for std in [0.5, 3.0, 8.99, 9.01, 30.0, 1000.0] {
            let computed_density = density_of_position(std);
            assert!(
                (computed_density / expected_density - 1.0).abs() < 1e-11,
                "{std}: {computed_density}, not {expected_density}"
            );
        }
    }
}

#[test]
fn sampler_and_density_agree() {
    let x = SE2::new(0.5, -0.25, 1.0);
    let small_alphas = VelocityAlphas(ALPHAS_WITH_LAST_TURN.0.map(|large_alpha| 0.1 * large_alpha));
    let alphas_and_velocities = [(ALPHAS_WITH_LAST_TURN, -1.0, 0.5), (small_alphas, 0.9, 3.6)];
    for (seed, (alphas, v, omega)) in (60..).zip(alphas_and_velocities) {
        let u = new_command(v, omega, 1.0);
        for noise in NOISE_KINDS {
            let velocity_model = new_model(alphas, noise);
            new_grid_around(&velocity_model, &u, &x).assert_samples_fit(&velocity_model, &u, &x, seed);
        }
    }
}

#[test]
fn the_tables_prob_differs_from_the_density_by_a_few_percent() {
    let (u, x) = (new_command(1.0, 0.5, 1.0), SE2::identity());
    let velocity_model = new_model(ALPHAS_WITH_LAST_TURN, NoiseKind::Normal);
    let polar_grid = new_grid_around(&velocity_model, &u, &x);
    let density_masses = polar_grid.cell_masses(|pose| velocity_model.pose_density(pose, &u, &x).unwrap());
    let score_masses = polar_grid.cell_masses(|pose| velocity_model.prob(pose, &u, &x));
    let total_score: f64 = score_masses.iter().sum();
    let total_variation: f64 =
        density_masses.iter().zip(&score_masses).map(|(d, s)| 0.5 * (d - s / total_score).abs()).sum();
    assert!((0.02..0.15).contains(&total_variation), "total variation {total_variation}");
}

#[test]
fn cartesian_cov_is_the_linearized_arc() {
    for u in new_commands() {
        for x in new_start_poses() {
            for alphas in [ALPHAS_WITHOUT_LAST_TURN, ALPHAS_WITH_LAST_TURN] {
                let velocity_model = new_model(alphas, NoiseKind::Normal);
                let noise_jacobian = derivative_by_noise([0.0; 3], |unit_noise| {
                    velocity_model.apply_noise(&u, &x, unit_noise)
                });
                let expected_cov = noise_jacobian * noise_jacobian.transpose();
                let cov = velocity_model.cartesian_cov(&u, &x);
                assert!((cov - expected_cov).amax() < 1e-8, "{u:?} from {x:?}\n{cov}{expected_cov}");
            }
        }
    }
}
