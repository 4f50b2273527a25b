//! Laws of noises, and of probabilities of poses under the models.

use super::doubles::{any_double, doubles_up_to, finite_doubles, new_proptest_config};
use motion::geom::se2::SE2;
use motion::sim::settings::{ALPHA_RANGE, DURATION_RANGE};
use motion::{
    ConfiguredOdometry, MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, TangentNoiseModel,
    Variance, VelocityAlphas, VelocityCmd, VelocityModel,
};
use proptest::prelude::*;
use std::f64::consts::PI;

fn any_noise_kind() -> impl Strategy<Value = NoiseKind> {
    prop_oneof![Just(NoiseKind::Normal), Just(NoiseKind::Triangular)]
}

fn numbers_in(setting_range: std::ops::RangeInclusive<f64>) -> impl Strategy<Value = f64> {
    let [range_start, range_end] = [*setting_range.start(), *setting_range.end()];
    doubles_up_to(range_end).prop_map(move |drawn_number| {
        if range_start >= 0.0 { drawn_number.abs().max(range_start) } else { drawn_number }
    })
}

fn any_alphas<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    proptest::collection::vec(prop_oneof![3 => 0.0..1.0, 2 => numbers_in(ALPHA_RANGE), 1 => Just(0.0)], N)
        .prop_map(|alphas| std::array::from_fn(|i| alphas[i]))
}

fn any_command() -> impl Strategy<Value = VelocityCmd> {
    (doubles_up_to(1e6), doubles_up_to(1e6), numbers_in(DURATION_RANGE))
        .prop_map(|(v, omega, dt)| VelocityCmd { v, omega, dt })
}

fn any_start_pose() -> impl Strategy<Value = SE2> {
    (doubles_up_to(1e18), doubles_up_to(1e18), doubles_up_to(PI))
        .prop_map(|(x, y, theta)| SE2::new(x, y, theta))
}

fn any_odometry_reading() -> impl Strategy<Value = OdomDelta> {
    (doubles_up_to(PI), doubles_up_to(1e12), doubles_up_to(PI)).prop_map(|(rot1, trans, rot2)| OdomDelta {
        rot1,
        trans: trans.abs(),
        rot2,
    })
}

/// Returns possible values of a uniform draw: odd multiples of 2⁻⁵⁴. The smallest and largest absolute values are frequent.
fn any_uniform_draw() -> impl Strategy<Value = f64> {
    let spacing_of_draws = 1.0 / (1u64 << 53) as f64;
    prop_oneof![
        any::<i64>().prop_map(|random_bits| random_bits >> 11),
        (0i64..64).prop_map(|i| (1 << 52) - 1 - i),
        (0i64..64).prop_map(|i| i - (1 << 52)),
        -64i64..64,
        (0u32..53, any::<i64>()).prop_map(|(right_shift, random_bits)| random_bits >> 11 >> right_shift),
    ]
    .prop_map(move |step_count| (step_count as f64 + 0.5) * spacing_of_draws)
}

proptest! {
    #![proptest_config(new_proptest_config(400))]

    #[test]
    fn noise_quantiles_are_odd_and_finite_and_rise(noise_kind in any_noise_kind(), a in any_uniform_draw(), b in any_uniform_draw()) {
        let quantile_of = |q: f64| noise_kind.quantile(q);
        prop_assert_eq!(quantile_of(-a).to_bits(), (-quantile_of(a)).to_bits());
        let max_quantile = if noise_kind == NoiseKind::Normal { 8.5 } else { 6f64.sqrt() };
        prop_assert!(quantile_of(a).abs() <= max_quantile && (quantile_of(a) > 0.0) == (a > 0.0), "{}", quantile_of(a));
        // The quantile function is an approximation. Its error may reverse the order of neighbouring quantiles.
        let [range_start, range_end] = [a.min(b), a.max(b)].map(quantile_of);
        prop_assert!(range_start <= range_end + 2e-15 * range_end.abs(), "{} {}", range_start, range_end);
    }

    /// Residuals have any finite value. Variances are small enough not to overflow when multiplied by six.
    #[test]
    fn noise_densities_are_at_most_their_peak(noise_kind in any_noise_kind(), noise_residual in finite_doubles(), noise_variance in doubles_up_to(1e307)) {
        let noise_variance = noise_variance.abs();
        let (density, peak_density) = (noise_kind.prob(noise_residual, Variance(noise_variance)), noise_kind.prob(0.0, Variance(noise_variance)));
        prop_assert!(density >= 0.0 && density <= peak_density, "{} {}", density, peak_density);
        prop_assert_eq!(density.to_bits(), noise_kind.prob(-noise_residual, Variance(noise_variance)).to_bits());
    }

    #[test]
    fn negative_and_nan_variances_are_refused(noise_variance in any_double()) {
        prop_assert_eq!(Variance::new(noise_variance).is_ok(), noise_variance >= 0.0);
    }

    #[test]
    fn velocity_likelihoods_are_never_negative_or_nan(
        noise_kind in any_noise_kind(), alphas in any_alphas(), u in any_command(), x in any_start_pose(), x_next in any_start_pose(),
    ) {
        let velocity_model = VelocityModel { alphas: VelocityAlphas(alphas), noise: noise_kind };
        assert_likelihoods_are_valid(&velocity_model, &u, &x, &x_next)?;
        let has_zero_variance = velocity_model.variances(&u).iter().any(|noise_variance| noise_variance.0 == 0.0);
        prop_assert_eq!(velocity_model.pose_density(&x_next, &u, &x).is_none(), has_zero_variance);
    }

    #[test]
    fn odometry_likelihoods_are_never_negative_or_nan(
        noise_kind in any_noise_kind(), alphas in any_alphas(), u in any_odometry_reading(), x in any_start_pose(), x_next in any_start_pose(), is_reverse_aware in any::<bool>(),
    ) {
        let velocity_model = OdometryModel { alphas: OdomAlphas(alphas), noise: noise_kind };
        if is_reverse_aware {
            assert_likelihoods_are_valid(&ConfiguredOdometry { model: velocity_model, reverse_aware: true }, &u, &x, &x_next)?;
        } else {
            assert_likelihoods_are_valid(&velocity_model, &u, &x, &x_next)?;
        }
    }

    #[test]
    fn exponential_likelihoods_are_never_nan(alphas in any_alphas(), u in any_command(), x in any_start_pose(), x_next in any_start_pose()) {
        let velocity_model = VelocityModel { alphas: VelocityAlphas(alphas), noise: NoiseKind::Normal };
        let tangent_model = TangentNoiseModel::from_velocity(&velocity_model, &u).expect("variances of settings");
        let log_prob = tangent_model.log_prob(&x_next, &u, &x);
        prop_assert!(!log_prob.is_nan(), "{}", log_prob);
    }
}

fn assert_likelihoods_are_valid<M: MotionModel>(
    velocity_model: &M,
    u: &M::Control,
    x: &SE2,
    x_next: &SE2,
) -> Result<(), TestCaseError> {
    for x_next in [x_next, x] {
        let pose_likelihood = velocity_model.prob(x_next, u, x);
        prop_assert!(pose_likelihood >= 0.0, "prob is {}", pose_likelihood);
        let density = velocity_model.pose_density(x_next, u, x);
        prop_assert!(density.is_none_or(|density| density >= 0.0), "pose_density is {:?}", density);
    }
    Ok(())
}
