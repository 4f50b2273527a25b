//! Noises, and probabilities of poses under the models.

use super::doubles::{any_double, doubles_up_to, finite_doubles, proptest_config};
use motion::geom::se2::SE2;
use motion::sim::settings::{ALPHA_RANGE, DURATION_RANGE};
use motion::{
    ConfiguredOdometry, MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, TangentNoiseModel,
    Variance, VelocityAlphas, VelocityCmd, VelocityModel,
};
use proptest::prelude::*;
use std::f64::consts::PI;

fn noise_kinds() -> impl Strategy<Value = NoiseKind> {
    prop_oneof![Just(NoiseKind::Normal), Just(NoiseKind::Triangular)]
}

/// Returns numbers in the range of a setting, including its ends.
fn numbers_in(setting_range: std::ops::RangeInclusive<f64>) -> impl Strategy<Value = f64> {
    let [low, high] = [*setting_range.start(), *setting_range.end()];
    doubles_up_to(high).prop_map(move |number| if low >= 0.0 { number.abs().max(low) } else { number })
}

fn any_alphas<const N: usize>() -> impl Strategy<Value = [f64; N]> {
    proptest::collection::vec(prop_oneof![3 => 0.0..1.0, 2 => numbers_in(ALPHA_RANGE), 1 => Just(0.0)], N)
        .prop_map(|alphas| std::array::from_fn(|i| alphas[i]))
}

fn any_command() -> impl Strategy<Value = VelocityCmd> {
    (doubles_up_to(1e6), doubles_up_to(1e6), numbers_in(DURATION_RANGE))
        .prop_map(|(v, omega, dt)| VelocityCmd { v, omega, dt })
}

fn start_poses() -> impl Strategy<Value = SE2> {
    (doubles_up_to(1e18), doubles_up_to(1e18), doubles_up_to(PI))
        .prop_map(|(x, y, theta)| SE2::new(x, y, theta))
}

fn odometry_readings() -> impl Strategy<Value = OdomDelta> {
    (doubles_up_to(PI), doubles_up_to(1e12), doubles_up_to(PI)).prop_map(|(rot1, trans, rot2)| OdomDelta {
        rot1,
        trans: trans.abs(),
        rot2,
    })
}

/// Returns possible values of a uniform draw: odd multiples of 2⁻⁵⁴. The smallest and largest absolute values are frequent.
fn uniform_draws() -> impl Strategy<Value = f64> {
    let number_spacing = 1.0 / (1u64 << 53) as f64;
    prop_oneof![
        any::<i64>().prop_map(|random_bits| random_bits >> 11),
        (0i64..64).prop_map(|i| (1 << 52) - 1 - i),
        (0i64..64).prop_map(|i| i - (1 << 52)),
        -64i64..64,
        (0u32..53, any::<i64>())
            .prop_map(|(magnitude_shift, random_bits)| random_bits >> 11 >> magnitude_shift),
    ]
    .prop_map(move |integer| (integer as f64 + 0.5) * number_spacing)
}

proptest! {
    #![proptest_config(proptest_config(400))]

    #[test]
    fn quantiles_are_odd_and_finite_and_rise(kind in noise_kinds(), a in uniform_draws(), b in uniform_draws()) {
        let quantile_at = |q: f64| kind.quantile(q);
        prop_assert_eq!(quantile_at(-a).to_bits(), (-quantile_at(a)).to_bits());
        let max_quantile = if kind == NoiseKind::Normal { 8.5 } else { 6f64.sqrt() };
        prop_assert!(quantile_at(a).abs() <= max_quantile && (quantile_at(a) > 0.0) == (a > 0.0), "{}", quantile_at(a));
        // The quantile function is an approximation. Its error may reverse the order of neighbouring quantiles.
        let [low, high] = [a.min(b), a.max(b)].map(quantile_at);
        prop_assert!(low <= high + 2e-15 * high.abs(), "{} {}", low, high);
    }

    /// Residuals are arbitrary. Variances do not overflow when multiplied by six.
    #[test]
    fn noise_densities_are_at_most_their_peak(kind in noise_kinds(), residual in finite_doubles(), variance in doubles_up_to(1e307)) {
        let variance = variance.abs();
        let (density, peak) = (kind.prob(residual, Variance(variance)), kind.prob(0.0, Variance(variance)));
        prop_assert!(density >= 0.0 && density <= peak, "{} {}", density, peak);
        prop_assert_eq!(density.to_bits(), kind.prob(-residual, Variance(variance)).to_bits());
        prop_assert_eq!(Variance::new(variance).is_ok(), true);
    }

    #[test]
    fn negative_and_nan_variances_are_refused(variance in any_double()) {
        prop_assert_eq!(Variance::new(variance).is_ok(), variance >= 0.0);
    }

    #[test]
    fn velocity_likelihoods_are_never_negative_or_nan(
        kind in noise_kinds(), alphas in any_alphas(), u in any_command(), x in start_poses(), x_next in start_poses(),
    ) {
        let model = VelocityModel { alphas: VelocityAlphas(alphas), noise: kind };
        assert_likelihoods_not_negative_or_nan(&model, &u, &x, &x_next)?;
        let has_zero_variance = model.variances(&u).iter().any(|variance| variance.0 == 0.0);
        prop_assert_eq!(model.pose_density(&x_next, &u, &x).is_none(), has_zero_variance);
    }

    #[test]
    fn odometry_likelihoods_are_never_negative_or_nan(
        kind in noise_kinds(), alphas in any_alphas(), u in odometry_readings(), x in start_poses(), x_next in start_poses(), is_reverse_aware in any::<bool>(),
    ) {
        let model = OdometryModel { alphas: OdomAlphas(alphas), noise: kind };
        if is_reverse_aware {
            assert_likelihoods_not_negative_or_nan(&ConfiguredOdometry { model, reverse_aware: true }, &u, &x, &x_next)?;
        } else {
            assert_likelihoods_not_negative_or_nan(&model, &u, &x, &x_next)?;
        }
    }

    #[test]
    fn exponential_likelihoods_are_never_nan(alphas in any_alphas(), u in any_command(), x in start_poses(), x_next in start_poses()) {
        let model = VelocityModel { alphas: VelocityAlphas(alphas), noise: NoiseKind::Normal };
        let tangent_model = TangentNoiseModel::from_velocity(&model, &u).expect("variances of settings");
        let log_prob = tangent_model.log_prob(&x_next, &u, &x);
        prop_assert!(!log_prob.is_nan(), "{}", log_prob);
    }
}

fn assert_likelihoods_not_negative_or_nan<M: MotionModel>(
    model: &M,
    u: &M::Control,
    x: &SE2,
    x_next: &SE2,
) -> Result<(), TestCaseError> {
    for x_next in [x_next, x] {
        let table_score = model.prob(x_next, u, x);
        prop_assert!(table_score >= 0.0, "prob is {}", table_score);
        let density = model.pose_density(x_next, u, x);
        prop_assert!(density.is_none_or(|density| density >= 0.0), "pose_density is {:?}", density);
    }
    Ok(())
}
