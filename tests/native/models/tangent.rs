//! Gaussian noise in exponential coordinates: density, sampler, and covariances propagated along a path.

use crate::common::{
    MAX_KS_STATISTIC, ReferenceTable, SAMPLE_COUNT, chi_square_limit, sample_uniform, scaled_ks_distance,
    seeded_rng, unit_cdf,
};
use motion::geom::se2::SE2;
use motion::{
    Compounding, MotionModel, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel,
};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

const U: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };

/// Command of one of the twenty steps that the tests compound.
const COMMAND_OF_STEP: VelocityCmd = VelocityCmd { dt: 0.2, ..U };
const FULL_RANK_ALPHAS: VelocityAlphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.005, 0.005]);

fn new_velocity_model(alphas: VelocityAlphas) -> VelocityModel {
    VelocityModel { alphas, noise: NoiseKind::Normal }
}

fn new_full_cov() -> Matrix3<f64> {
    Matrix3::new(0.09, 0.02, 0.03, 0.02, 0.05, -0.02, 0.03, -0.02, 0.12)
}

/// Returns log N(d; 0, cov), computed with the inverse of the covariance.
fn compute_log_gaussian(d: &Vector3<f64>, covariance: &Matrix3<f64>) -> f64 {
    let inverse_cov = covariance.try_inverse().unwrap();
    -0.5 * (d.dot(&(inverse_cov * d)) + covariance.determinant().ln() + 3.0 * (2.0 * PI).ln())
}

fn new_start_poses() -> [SE2; 2] {
    [SE2::identity(), SE2::new(-2.0, 5.0, 2.8)]
}

#[test]
fn log_prob_is_a_gaussian_in_exponential_coordinates() {
    let mut rng = seeded_rng(120);
    for x in new_start_poses() {
        let tangent_model = TangentNoiseModel::new(new_full_cov()).unwrap();
        for _ in 0..500 {
            let twist_deviation = Vector3::from_fn(|_, _| sample_uniform(&mut rng, -1.0, 1.0));
            let next_pose = x.boxplus(Vector3::new(1.0, 0.0, 0.5) + twist_deviation);
            let (log_prob, expected_log_prob) = (
                tangent_model.log_prob(&next_pose, &U, &x),
                compute_log_gaussian(&twist_deviation, &new_full_cov()),
            );
            assert!((log_prob - expected_log_prob).abs() < 1e-8, "{log_prob}, not {expected_log_prob}");
        }
    }
    // Without lateral noise of the wheels, the density is concentrated on a thin sheet.
    let tangent_model = TangentNoiseModel::from_velocity(
        &new_velocity_model(VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.0, 0.0])),
        &U,
    );
    let tangent_model = tangent_model.unwrap();
    let log_prob_at = |xi_deviation: Vector3<f64>| {
        tangent_model.log_prob(&SE2::exp(&(Vector3::new(1.0, 0.0, 0.5) + xi_deviation)), &U, &SE2::identity())
    };
    let peak_log_prob = log_prob_at(Vector3::zeros());
    assert!(
        (log_prob_at(Vector3::new(0.1, 0.0, 0.1)) - peak_log_prob + 0.5 * 2.0 * 0.01 / 0.025).abs() < 1e-6
    );
    assert!(log_prob_at(Vector3::new(0.0, 1e-3, 0.0)) < peak_log_prob - 1e5);
}

/// Without noise of speed or turn, the density has a width of a micrometre or a microradian instead of 0.
#[test]
fn without_noise_in_the_arc_the_density_is_finite() {
    for [along_variance, turn_variance] in [[0.0, 0.025], [0.025, 0.0], [0.0, 0.0]] {
        let [along_alpha, turn_alpha] = [along_variance, turn_variance].map(|variance| 0.8 * variance);
        let alphas = VelocityAlphas([along_alpha, along_alpha, turn_alpha, turn_alpha, 0.01, 0.01]);
        let tangent_model = TangentNoiseModel::from_velocity(&new_velocity_model(alphas), &U).unwrap();
        let log_prob = tangent_model.log_prob(&SE2::exp(&TangentNoiseModel::twist(&U)), &U, &SE2::identity());
        let peak_variances = Vector3::new(along_variance.max(1e-12), turn_variance.max(1e-12), 0.0125);
        // The volume factors of exponential and arc coordinates cancel, except for one factor of 2.
        let expected_log_prob =
            compute_log_gaussian(&Vector3::zeros(), &Matrix3::from_diagonal(&peak_variances)) + 2f64.ln();
        assert!(
            (log_prob - expected_log_prob).abs() < 1e-9,
            "{alphas:?}: {log_prob}, not {expected_log_prob}"
        );
    }
}

/// A density over ξ is the density over poses times dx dy dθ / dξ = sinc²(ξ_ω/2), where ξ_ω is the turn.
#[test]
fn the_tangent_form_has_the_density_of_the_velocity_model() {
    let mut rng = seeded_rng(121);
    let alphas = VelocityAlphas([0.05, 0.05, 0.05, 0.09, 0.01, 0.01]);
    for x in new_start_poses() {
        for (v, omega) in [(1.0, 0.5), (1.0, -0.5), (-1.0, 0.5), (-0.8, -1.0)] {
            let u = VelocityCmd { v, omega, dt: 1.2 };
            let tangent_model = TangentNoiseModel::from_velocity(&new_velocity_model(alphas), &u).unwrap();
            for _ in 0..200 {
                let unit_noise = [(); 3].map(|()| sample_uniform(&mut rng, -2.0, 2.0));
                let next_pose = new_velocity_model(alphas).apply_noise(&u, &x, unit_noise);
                let half_turn = 0.5 * next_pose.boxminus(&x).z;
                let log_volume = 2.0 * (half_turn.sin() / half_turn).ln();
                let expected_log_prob =
                    new_velocity_model(alphas).pose_density(&next_pose, &u, &x).unwrap().ln() + log_volume;
                let log_prob = tangent_model.log_prob(&next_pose, &u, &x);
                assert!(
                    (log_prob - expected_log_prob).abs() < 1e-6,
                    "{u:?} at {next_pose:?}: {log_prob}, not {expected_log_prob}"
                );
            }
        }
    }
}

/// The whitened ξ − τ is standard normal. A Kolmogorov–Smirnov test checks each component, and a χ² test over octants and shells checks all
/// three together.
#[test]
fn sampler_and_density_agree() {
    let x = SE2::new(1.0, 2.0, -0.7);
    let tangent_model = TangentNoiseModel::new(new_full_cov()).unwrap();
    let mut rng = seeded_rng(122);
    let inverse_cov_root = new_full_cov().cholesky().unwrap().l().try_inverse().unwrap();
    let step_twist = Vector3::new(1.0, 0.0, 0.5);
    let whitened_samples: Vec<Vector3<f64>> = (0..SAMPLE_COUNT)
        .map(|_| inverse_cov_root * (tangent_model.sample(&U, &x, &mut rng).boxminus(&x) - step_twist))
        .collect();
    for xi_axis in 0..3 {
        let whitened_component = whitened_samples.iter().map(|w| w[xi_axis]).collect();
        let ks_statistic = scaled_ks_distance(whitened_component, |z| unit_cdf(NoiseKind::Normal, z));
        assert!(ks_statistic < MAX_KS_STATISTIC, "axis {xi_axis}: √n·D = {ks_statistic}");
    }
    const CHI_SQUARE_QUARTILES: [f64; 3] =
        [1.212_532_903_045_966, 2.365_973_884_375_339, 4.108_344_935_632_316];
    let mut sample_counts = [0.0; 32];
    for w in &whitened_samples {
        let octant_index = (0..3).map(|xi_axis| usize::from(w[xi_axis] > 0.0) << xi_axis).sum::<usize>();
        sample_counts[4 * octant_index
            + CHI_SQUARE_QUARTILES.iter().filter(|quartile| w.norm_squared() > **quartile).count()] += 1.0;
    }
    let expected_count = SAMPLE_COUNT as f64 / 32.0;
    let chi_square: f64 =
        sample_counts.iter().map(|cell_count| (cell_count - expected_count).powi(2) / expected_count).sum();
    assert!(chi_square < chi_square_limit(32), "χ² = {chi_square}");
}

#[test]
fn compounding_is_the_recursion_of_the_chapter() {
    let mut rng = seeded_rng(124);
    for r in [new_full_cov(), Matrix3::from_diagonal(&Vector3::new(0.025, 0.0, 0.025))] {
        let tangent_model = TangentNoiseModel::new(r).unwrap();
        for _ in 0..100 {
            let mut sample_within =
                |max_magnitude: f64| sample_uniform(&mut rng, -max_magnitude, max_magnitude);
            let step_twist = Vector3::new(sample_within(2.0), sample_within(2.0), sample_within(3.0));
            let start_cov_root = Matrix3::from_fn(|_, _| sample_within(1.0));
            let sigma = start_cov_root * start_cov_root.transpose();
            let inverse_adjoint = SE2::exp(&step_twist).adjoint().try_inverse().unwrap();
            let expected_cov = inverse_adjoint * sigma * inverse_adjoint.transpose() + r;
            let compounded_cov = tangent_model.compound(&sigma, &step_twist);
            assert!((compounded_cov - expected_cov).amax() < 1e-12, "{compounded_cov}{expected_cov}");
            assert_eq!(tangent_model.propagate(&sigma, &step_twist, Compounding::Chapter), compounded_cov);
        }
    }
    let tangent_model = TangentNoiseModel::from_velocity(&new_velocity_model(FULL_RANK_ALPHAS), &U).unwrap();
    let expected_cov = Matrix3::from_diagonal(&Vector3::new(0.025, 0.0, 0.03125));
    assert!((tangent_model.compound(&Matrix3::zeros(), &Vector3::zeros()) - expected_cov).amax() < 1e-16);
}

/// A step from an exact pose transforms noise inside the arc to J_r R J_rᵀ. Noise of γ̂, which turns the robot after the arc, stays as it is.
#[test]
fn first_order_transforms_the_noise_inside_the_arc_only() {
    let step_twist = TangentNoiseModel::twist(&U);
    let right_jacobian = SE2::right_jacobian(&step_twist);
    let arc_cov = Matrix3::from_diagonal(&Vector3::new(0.025, 0.0, 0.025));
    let turn_cov = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, 0.00625));
    let cov_after_one_step = |noise_model: &TangentNoiseModel| {
        noise_model.propagate(&Matrix3::zeros(), &step_twist, Compounding::FirstOrder)
    };
    let separate_turn_model =
        TangentNoiseModel::from_velocity(&new_velocity_model(FULL_RANK_ALPHAS), &U).unwrap();
    let merged_turn_model = TangentNoiseModel::new(arc_cov + turn_cov).unwrap();
    let [separate_cov, merged_cov] = [&separate_turn_model, &merged_turn_model].map(cov_after_one_step);
    let transform_cov = |covariance: Matrix3<f64>| right_jacobian * covariance * right_jacobian.transpose();
    assert!((separate_cov - (transform_cov(arc_cov) + turn_cov)).amax() < 1e-15);
    assert!((merged_cov - transform_cov(arc_cov + turn_cov)).amax() < 1e-15);
    assert!((separate_cov - merged_cov).amax() > 1e-4);
}

fn propagate_twenty_steps(noise_model: &TangentNoiseModel, compounding: Compounding) -> Matrix3<f64> {
    let step_twist = TangentNoiseModel::twist(&COMMAND_OF_STEP);
    (0..20).fold(Matrix3::zeros(), |sigma, _| noise_model.propagate(&sigma, &step_twist, compounding))
}

#[test]
fn covariances_after_twenty_steps_match_the_references() {
    let tangent_model =
        TangentNoiseModel::from_velocity(&new_velocity_model(FULL_RANK_ALPHAS), &COMMAND_OF_STEP).unwrap();
    let reference_table = ReferenceTable::parse(include_str!("../../reference/compounding.csv"));
    for (csv_row, compounding) in
        reference_table.rows().zip([Compounding::Chapter, Compounding::FirstOrder, Compounding::FourthOrder])
    {
        let [cov_aa, cov_ab, cov_aw, cov_bb, cov_bw, cov_ww] =
            csv_row.cell_numbers(["caa", "cab", "caw", "cbb", "cbw", "cww"]);
        let expected_cov =
            Matrix3::new(cov_aa, cov_ab, cov_aw, cov_ab, cov_bb, cov_bw, cov_aw, cov_bw, cov_ww);
        let sigma = propagate_twenty_steps(&tangent_model, compounding);
        let recursion_name = csv_row.cell_text("order");
        assert!((sigma - expected_cov).amax() < 1e-14, "{recursion_name}: {sigma}{expected_cov}");
    }
}
