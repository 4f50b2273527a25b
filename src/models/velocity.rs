//! The velocity motion model: Tables 5.1 and 5.3.

use super::{MotionModel, TangentNoiseModel};
use crate::geom::arc::{ArcInversion, arc_end, invert_arc};
use crate::geom::se2::SE2;
use crate::noise::{NoiseKind, Variance, product_or_zero, wrapped_density};
use nalgebra::{Matrix3, Vector3};
use rand::Rng;
use std::f64::consts::TAU;

/// Velocity command: `v` (m/s) and `omega` (rad/s, counter-clockwise) held for `dt` (s, positive).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityCmd {
    /// Speed, m/s, which is negative in reverse.
    pub v: f64,
    /// Turn rate, rad/s, counter-clockwise.
    pub omega: f64,
    /// Duration, s.
    pub dt: f64,
}

/// Noise parameters α₁…α₆: the variances of v̂, ω̂ and γ̂ are α₁v² + α₂ω², α₃v² + α₄ω² and α₅v² + α₆ω². Each is 0 or more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityAlphas(pub [f64; 6]);

/// Velocity motion model of Tables 5.1 and 5.3. The robot drives an exact arc with (v̂, ω̂) instead of (v, ω), and then turns
/// on the spot by γ̂Δt.
///
/// ```
/// use motion::geom::se2::SE2;
/// use motion::{MotionModel, NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};
/// use rand::{SeedableRng, rngs::SmallRng};
///
/// let model = VelocityModel { alphas: VelocityAlphas([0.02, 0.02, 0.02, 0.02, 0.01, 0.01]), noise: NoiseKind::Normal };
/// let command = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
/// let end = model.sample(&command, &SE2::identity(), &mut SmallRng::seed_from_u64(7));
/// assert!(model.prob(&end, &command, &SE2::identity()) > 0.0);
/// assert!(model.pose_density(&end, &command, &SE2::identity()).is_some());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityModel {
    /// Noise parameters α₁ to α₆.
    pub alphas: VelocityAlphas,
    /// Distribution of the noise.
    pub noise: NoiseKind,
}

/// Maximum number of full turns in each direction that [`VelocityModel::pose_density`] adds up. More turns would matter only if the
/// standard deviation of the turn exceeded 44 rad.
const MAX_WINDINGS: f64 = 64.0;

impl VelocityModel {
    /// Returns the variances of v̂ (m²/s²), ω̂ and γ̂ (rad²/s²) under the command.
    pub fn variances(&self, u: &VelocityCmd) -> [Variance; 3] {
        let [a1, a2, a3, a4, a5, a6] = self.alphas.0;
        let (v2, omega2) = (u.v * u.v, u.omega * u.omega);
        [Variance(a1 * v2 + a2 * omega2), Variance(a3 * v2 + a4 * omega2), Variance(a5 * v2 + a6 * omega2)]
    }

    /// Returns the motion that the robot executes when the noises of v̂, ω̂ and γ̂ take the values `unit_noise` times their standard
    /// deviations. With the same `unit_noise`, the motion changes continuously with the command and the α's.
    pub fn executed_motion(&self, u: &VelocityCmd, unit_noise: [f64; 3]) -> ArcInversion {
        let [v_std, omega_std, gamma_std] = self.noise_stds(u);
        ArcInversion {
            v_hat: u.v + v_std * unit_noise[0],
            omega_hat: u.omega + omega_std * unit_noise[1],
            gamma_hat: gamma_std * unit_noise[2],
        }
    }

    pub(crate) fn noise_stds(&self, u: &VelocityCmd) -> [f64; 3] {
        self.variances(u).map(|variance| variance.0.sqrt())
    }

    /// Returns the number of full turns in each direction, beyond the turn nearest to the commanded turn, that
    /// [`VelocityModel::pose_density`] adds up.
    pub(crate) fn max_windings(&self, u: &VelocityCmd) -> i32 {
        let [_, omega_std, _] = self.noise_stds(u);
        (9.0 * omega_std * u.dt / TAU).ceil().min(MAX_WINDINGS) as i32
    }

    /// Returns the pose reached from `x` if the noises are `unit_noise` times their standard deviations (Table 5.3 after its draws).
    pub fn apply_noise(&self, u: &VelocityCmd, x: &SE2, unit_noise: [f64; 3]) -> SE2 {
        let ArcInversion { v_hat, omega_hat, gamma_hat } = self.executed_motion(u, unit_noise);
        let (forward_offset, left_offset) = arc_end(v_hat * u.dt, omega_hat * u.dt);
        *x * SE2::new(forward_offset, left_offset, (omega_hat + gamma_hat) * u.dt)
    }

    /// Returns the 3 × 3 covariance of (x, y, θ) that an EKF carries. The arc is linearized in (v̂, ω̂, γ̂) at the command. The covariance
    /// is in the frame of `x` (m², m·rad, rad²). The covariance does not depend on the shape of the noise.
    ///
    /// The formula is R·(J_r R_u J_rᵀ + diag(0, 0, Δt²·Var γ̂))·Rᵀ with R_u = Δt²·diag(Var v̂, 0, Var ω̂). J_r is the right Jacobian of
    /// SE(2) at the commanded twist. R is the rotation to the final heading.
    pub fn cartesian_cov(&self, u: &VelocityCmd, x: &SE2) -> Matrix3<f64> {
        let [length_var, turn_var, last_turn_var] =
            self.variances(u).map(|Variance(variance)| u.dt * u.dt * variance);
        let twist = TangentNoiseModel::twist(u);
        let right_jacobian = SE2::right_jacobian(&twist);
        let noise_cov = Matrix3::from_diagonal(&Vector3::new(length_var, 0.0, turn_var));
        let arc_cov = right_jacobian * noise_cov * right_jacobian.transpose();
        let body_cov = arc_cov + Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, last_turn_var));
        let rotation_adjoint = SE2::new(0.0, 0.0, x.theta() + twist.z).adjoint();
        rotation_adjoint * body_cov * rotation_adjoint.transpose()
    }
}

impl MotionModel for VelocityModel {
    type Control = VelocityCmd;

    fn prob(&self, x_next: &SE2, u: &VelocityCmd, x: &SE2) -> f64 {
        let inverted_arc = invert_arc(x, x_next, u.dt);
        let [v_variance, omega_variance, gamma_variance] = self.variances(u);
        product_or_zero([
            self.noise.prob(u.v - inverted_arc.v_hat, v_variance),
            self.noise.prob(u.omega - inverted_arc.omega_hat, omega_variance),
            self.noise.prob(inverted_arc.gamma_hat, gamma_variance),
        ])
    }

    /// Returns the density over dx dy dθ, or None if a variance is 0.
    ///
    /// The map (v̂, ω̂, γ̂) → (x, y, θ) has the determinant d · sinc(φ/2) · Δt³/2. Here d is the distance between the positions, and φ the
    /// turn of the arc. The circle through both positions can be driven by φ + 2πk for every integer k.
    fn pose_density(&self, x_next: &SE2, u: &VelocityCmd, x: &SE2) -> Option<f64> {
        let variances = self.variances(u);
        if variances.iter().any(|variance| variance.0 == 0.0) {
            return None;
        }
        let [v_variance, omega_variance, gamma_variance] = variances;
        let inverted_arc = invert_arc(x, x_next, u.dt);
        let relative_pose = x.motion_to(x_next);
        let end_distance = libm::hypot(relative_pose.x(), relative_pose.y());
        let shortest_turn = inverted_arc.omega_hat * u.dt;
        let squared_distance_times_dt = end_distance * end_distance * u.dt;
        if squared_distance_times_dt == 0.0 {
            return Some(if self.noise.prob(u.v, v_variance) > 0.0 { f64::INFINITY } else { 0.0 });
        }
        // All arcs that lead to the pose are on one circle, so that their lengths are proportional to their turns. On a straight line there
        // is no full turn.
        let density_of_turn = |full_turns: f64| {
            let (v_hat, arc_turn) = if full_turns == 0.0 {
                (inverted_arc.v_hat, shortest_turn)
            } else if inverted_arc.omega_hat == 0.0 {
                return 0.0;
            } else {
                let arc_turn = shortest_turn + TAU * full_turns;
                (inverted_arc.v_hat * (arc_turn / shortest_turn), arc_turn)
            };
            // Because |sinc(φ/2)| = d/|v̂Δt|, the determinant is d²Δt/(2|v̂|) times Δt (from the final turn γ̂Δt).
            product_or_zero([
                2.0 * v_hat.abs() / squared_distance_times_dt,
                self.noise.prob(v_hat - u.v, v_variance),
                self.noise.prob(arc_turn / u.dt - u.omega, omega_variance),
            ])
        };
        // A range of nine standard deviations contains every turn whose Gaussian density is above the rounding error of the sum.
        let nearest_winding = ((u.omega * u.dt - shortest_turn) / TAU).round();
        let max_windings = self.max_windings(u);
        let arc_density: f64 =
            (-max_windings..=max_windings).map(|k| density_of_turn(nearest_winding + f64::from(k))).sum();

        let last_turn = relative_pose.theta() - shortest_turn;
        let dt2 = u.dt * u.dt;
        Some(product_or_zero([
            arc_density,
            wrapped_density(self.noise, last_turn, Variance(dt2 * gamma_variance.0)),
        ]))
    }

    fn sample<R: Rng + ?Sized>(&self, u: &VelocityCmd, x: &SE2, rng: &mut R) -> SE2 {
        self.apply_noise(u, x, self.noise.sample_unit_triple(rng))
    }

    /// R_u = Δt² · diag(α₁v² + α₂ω², 0, α₃v² + α₄ω²): a wheelset that rolls without slip has no lateral noise. γ̂ is
    /// not part of it, because it turns the robot after the arc; see [`TangentNoiseModel::from_velocity`].
    fn tangent_cov(&self, u: &VelocityCmd) -> Option<Matrix3<f64>> {
        let [v_variance, omega_variance, _] = self.variances(u);
        let dt2 = u.dt * u.dt;
        Some(Matrix3::from_diagonal(&Vector3::new(dt2 * v_variance.0, 0.0, dt2 * omega_variance.0)))
    }
}
