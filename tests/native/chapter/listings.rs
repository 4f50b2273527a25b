//! Models as readers of the chapter may write them, which implement the trait as the chapter prints it: two methods and a type.

use motion::geom::se2::{SE2, wrap_angle};
use motion::{
    MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, Variance, VelocityAlphas, VelocityCmd,
    VelocityModel, invert_arc,
};
use nalgebra::{Matrix3, Vector3};
use rand::{Rng, SeedableRng, rngs::SmallRng};

/// Velocity model with centre and radius of the arc, as in a first solution of exercise 1.
struct RadiusModel {
    alphas: VelocityAlphas,
    noise_kind: NoiseKind,
}

impl RadiusModel {
    fn variances(&self, u: &VelocityCmd) -> [Variance; 3] {
        let a = self.alphas.0;
        [0, 2, 4].map(|i| Variance(a[i] * u.v.powi(2) + a[i + 1] * u.omega.powi(2)))
    }
}

impl MotionModel for RadiusModel {
    type Control = VelocityCmd;

    fn sample<R: Rng + ?Sized>(&self, u: &VelocityCmd, x: &SE2, rng: &mut R) -> SE2 {
        let [v, omega, gamma_hat] = self.variances(u).map(|variance| self.noise_kind.sample(variance, rng));
        let (v_hat, omega_hat) = (u.v + v, u.omega + omega);
        let (arc_radius, end_heading) = (v_hat / omega_hat, x.theta() + omega_hat * u.dt);
        SE2::new(
            x.x() + arc_radius * (end_heading.sin() - x.theta().sin()),
            x.y() - arc_radius * (end_heading.cos() - x.theta().cos()),
            wrap_angle(end_heading + gamma_hat * u.dt),
        )
    }

    fn prob(&self, x_next: &SE2, u: &VelocityCmd, x: &SE2) -> f64 {
        let inverted_arc = invert_arc(x, x_next, u.dt);
        let noise_residuals =
            [u.v - inverted_arc.v_hat, u.omega - inverted_arc.omega_hat, inverted_arc.gamma_hat];
        self.variances(u)
            .iter()
            .zip(noise_residuals)
            .map(|(variance, noise_residual)| self.noise_kind.prob(noise_residual, *variance))
            .product()
    }

    fn tangent_cov(&self, u: &VelocityCmd) -> Option<Matrix3<f64>> {
        let [v, omega, _] = self.variances(u).map(|variance| variance.0 * u.dt * u.dt);
        Some(Matrix3::from_diagonal(&Vector3::new(v, 0.0, omega)))
    }
}

struct MinimalOdometryModel {
    alphas: OdomAlphas,
}

impl MotionModel for MinimalOdometryModel {
    type Control = OdomDelta;

    fn sample<R: Rng + ?Sized>(&self, u: &OdomDelta, x: &SE2, rng: &mut R) -> SE2 {
        OdometryModel { alphas: self.alphas, noise: NoiseKind::Normal }.sample(u, x, rng)
    }

    fn prob(&self, x_next: &SE2, u: &OdomDelta, x: &SE2) -> f64 {
        OdometryModel { alphas: self.alphas, noise: NoiseKind::Normal }.prob(x_next, u, x)
    }
}

const COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
const ALPHAS: VelocityAlphas = VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.01, 0.01]);

#[test]
fn a_readers_velocity_model_equals_the_crates_model() {
    let readers_model = RadiusModel { alphas: ALPHAS, noise_kind: NoiseKind::Normal };
    let crate_model = VelocityModel { alphas: ALPHAS, noise: NoiseKind::Normal };
    let x = SE2::new(2.0, -1.0, 0.4);
    let (mut rng1, mut crate_rng) = (SmallRng::seed_from_u64(7), SmallRng::seed_from_u64(7));
    for _ in 0..1000 {
        let (readers_pose, expected_pose) =
            (readers_model.sample(&COMMAND, &x, &mut rng1), crate_model.sample(&COMMAND, &x, &mut crate_rng));
        // If ω̂ is small, the position loses digits, because the radius v̂/ω̂ multiplies the rounding errors of two sines, 2e-16 each.
        let position_tolerance = 1e-15 * (1.0 + 4.0 / invert_arc(&x, &expected_pose, 1.0).omega_hat.abs());
        assert!(
            (readers_pose.x() - expected_pose.x()).abs() < position_tolerance
                && (readers_pose.y() - expected_pose.y()).abs() < position_tolerance
        );
        assert!((readers_pose.theta() - expected_pose.theta()).abs() < 1e-15 * 4.0);
        let [prob, expected_prob] = [
            readers_model.prob(&expected_pose, &COMMAND, &x),
            crate_model.prob(&expected_pose, &COMMAND, &x),
        ];
        assert!((prob - expected_prob).abs() <= 1e-14 * expected_prob);
    }
    assert_eq!(readers_model.tangent_cov(&COMMAND), crate_model.tangent_cov(&COMMAND));
}

#[test]
fn methods_that_a_model_does_not_implement_return_none() {
    let readers_model = MinimalOdometryModel { alphas: OdomAlphas([0.1; 4]) };
    let x = SE2::identity();
    let u = OdomDelta::from_poses(&x, &SE2::new(1.0, 0.2, 0.3));
    assert_eq!(
        (readers_model.pose_density(&u.apply(&x), &u, &x), readers_model.tangent_cov(&u)),
        (None, None)
    );
    assert!(readers_model.prob(&u.apply(&x), &u, &x) > 0.0);
    assert!(readers_model.sample(&u, &x, &mut SmallRng::seed_from_u64(1)).x().is_finite());
}
