//! Gaussian noise in exponential coordinates, and the growth of its covariance along a path.

use super::{VelocityCmd, VelocityModel};
use crate::geom::arc::invert_arc;
use crate::geom::se2::SE2;
use crate::geom::sinc::sinc;
use crate::noise::{NoiseKind, Variance};
use nalgebra::{Matrix3, Vector3};
use rand::Rng;
use std::f64::consts::PI;
use thiserror::Error;

/// Motion x_t = x_{t−1} ⊞ (τ + w) with w ~ N(0, R).
///
/// [`TangentNoiseModel::from_velocity`] adds the final turn γ̂Δt, whose variance is Δt²(α₅v² + α₆ω²).
///
/// R is 3 × 3 in the order (along, lateral, heading), m², m·rad, rad², in the body frame of x_{t−1} (right
/// perturbation). It may be singular: a wheelset has no lateral noise.
///
/// ```
/// use motion::{Compounding, NoiseKind, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel};
/// use nalgebra::Matrix3;
///
/// let command = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
/// let velocity = VelocityModel { alphas: VelocityAlphas([0.02; 6]), noise: NoiseKind::Normal };
/// let model = TangentNoiseModel::from_velocity(&velocity, &command)?;
/// let step = |sigma| model.propagate(&sigma, &TangentNoiseModel::twist(&command), Compounding::FirstOrder);
/// let after_two = step(step(Matrix3::zeros()));
/// assert!(after_two.trace() > 2.0 * model.r.trace());
/// # Ok::<(), motion::TangentNoiseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentNoiseModel {
    /// Covariance R. To change it, create a model with [`TangentNoiseModel::new`], because the model also stores the Cholesky factor of R.
    pub r: Matrix3<f64>,
    last_turn_variance: f64,
    cov_root: Matrix3<f64>,
}

/// Recursion that propagates the covariance of x_k ⊟ x̄_k by one step of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compounding {
    /// The chapter's recursion A·Σ·Aᵀ + R, A = Ad(exp(τ)⁻¹). It approximates exp(τ + w) by exp(τ)·exp(w).
    Chapter,
    /// Recursion A·Σ·Aᵀ + J_r(τ)·R·J_r(τ)ᵀ, which is right to first order in w.
    FirstOrder,
    /// Recursion of [`Compounding::FirstOrder`] with the fourth-order terms of Barfoot and Furgale (2014), eq. 55.
    FourthOrder,
}

/// Reason why a matrix is not a covariance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum TangentNoiseError {
    /// An entry is infinite or NaN.
    #[error("the matrix has an entry that is not finite; a covariance has none")]
    NotFinite,
    /// The matrix differs from its transpose by more than rounding.
    #[error("the matrix differs from its transpose; a covariance is symmetric")]
    NotSymmetric,
    /// The matrix has a negative eigenvalue.
    #[error("the matrix has a negative variance in some direction; a covariance has none")]
    NotPositiveSemidefinite,
}

/// Tolerance for symmetry and positive semidefiniteness of R, relative to its largest entry. A smaller tolerance would refuse computed
/// covariances because of rounding. A larger tolerance would accept matrices that are not covariances.
const RELATIVE_TOLERANCE: f64 = 1e-12;

/// Variance (m² and rad²) that [`TangentNoiseModel::log_prob`] adds to the diagonal of R, so that a singular R has a density. It is a
/// lateral standard deviation of a micrometre. A larger variance would change measurable densities. With a smaller variance, rounding
/// errors of a residual would give density 0.
const PADDING_VARIANCE: f64 = 1e-12;

impl TangentNoiseModel {
    /// Creates the model with the covariance `r` of the exponential coordinates, and without noise of a final rotation. Fails with
    /// [`TangentNoiseError`] if `r` is not a covariance.
    pub fn new(r: Matrix3<f64>) -> Result<Self, TangentNoiseError> {
        Self::with_last_turn(r, 0.0)
    }

    /// Returns the velocity model under one command, with the final turn γ̂Δt kept apart: R = R_u, and a turn of variance Δt²(α₅v² + α₆ω²)
    /// after the arc. Only the variances of the velocity model are used; the noise here is Gaussian. Fails with [`TangentNoiseError`] if
    /// the α's or the command make a variance negative or not finite.
    pub fn from_velocity(velocity_model: &VelocityModel, u: &VelocityCmd) -> Result<Self, TangentNoiseError> {
        let [length_var, turn_var, last_turn_var] =
            velocity_model.variances(u).map(|Variance(variance)| u.dt * u.dt * variance);
        Self::with_last_turn(Matrix3::from_diagonal(&Vector3::new(length_var, 0.0, turn_var)), last_turn_var)
    }

    fn with_last_turn(r: Matrix3<f64>, last_turn_variance: f64) -> Result<Self, TangentNoiseError> {
        if !last_turn_variance.is_finite() {
            return Err(TangentNoiseError::NotFinite);
        }
        if last_turn_variance < 0.0 {
            return Err(TangentNoiseError::NotPositiveSemidefinite);
        }
        Ok(Self { r, last_turn_variance, cov_root: covariance_root(&r)? })
    }

    /// Returns τ = (vΔt, 0, ωΔt), whose exponential is the arc of the command.
    pub fn twist(u: &VelocityCmd) -> Vector3<f64> {
        Vector3::new(u.v * u.dt, 0.0, u.omega * u.dt)
    }

    /// Returns a random draw of the next pose x_t.
    pub fn sample<R: Rng + ?Sized>(&self, u: &VelocityCmd, x: &SE2, rng: &mut R) -> SE2 {
        let w = self.cov_root * Vector3::from(NoiseKind::Normal.sample_unit_triple(rng));
        let last_turn = NoiseKind::Normal.sample(Variance(self.last_turn_variance), rng);
        x.boxplus(Self::twist(u) + w) * SE2::new(0.0, 0.0, last_turn)
    }

    /// Returns the logarithm of the density of ξ = x_t ⊟ x_{t−1}, over dξ in the order (along, lateral, heading).
    ///
    /// Without a turn after the arc it is log N(ξ; τ, R + 10⁻¹²·I). Multiplied by sinc⁻²(ξ_ω/2), the density would be over dx dy dθ. With a
    /// turn after the arc, the density is that of the noisy motion (v̂Δt, ω̂Δt, γ̂Δt) that leads to x_t by an arc of at most half a turn.
    /// It is multiplied by sinc²(ξ_ω/2) and divided by v̂Δt·sinc²(ω̂Δt/2)/2, the determinant of the map from noisy motions to (x, y, θ).
    pub fn log_prob(&self, x_next: &SE2, u: &VelocityCmd, x: &SE2) -> f64 {
        if self.last_turn_variance == 0.0 {
            let padded_cov = self.r + Matrix3::identity() * PADDING_VARIANCE;
            return log_gaussian_density(&(x_next.boxminus(x) - Self::twist(u)), &padded_cov);
        }
        let inverted_arc = invert_arc(x, x_next, u.dt);
        let (arc_length, arc_turn) = (inverted_arc.v_hat * u.dt, inverted_arc.omega_hat * u.dt);
        let twist_residual =
            Vector3::new(arc_length - u.v * u.dt, arc_turn - u.omega * u.dt, inverted_arc.gamma_hat * u.dt);
        let noise_variances = Vector3::new(
            self.r[(0, 0)] + PADDING_VARIANCE,
            self.r[(2, 2)] + PADDING_VARIANCE,
            self.last_turn_variance,
        );
        let twist_sinc = sinc(0.5 * x.motion_to(x_next).theta());
        let arc_sinc = sinc(0.5 * arc_turn);
        log_gaussian_density(&twist_residual, &Matrix3::from_diagonal(&noise_variances))
            + libm::log(2.0 * twist_sinc * twist_sinc / (arc_length.abs() * arc_sinc * arc_sinc))
    }

    /// Returns Σ_k from Σ_{k−1} by the recursion of the book's chapter, which is `propagate` with [`Compounding::Chapter`].
    pub fn compound(&self, sigma: &Matrix3<f64>, step_twist: &Vector3<f64>) -> Matrix3<f64> {
        self.propagate(sigma, step_twist, Compounding::Chapter)
    }

    /// Returns the covariance of x_k ⊟ x̄_k after a step by `step_twist`, from the covariance `sigma` of x_{k−1} ⊟ x̄_{k−1}. Both
    /// covariances are 3 × 3, in the body frame of their pose. The turn after the arc happens at the end of the arc. Its variance is
    /// therefore added to that of the heading, without J_r.
    pub fn propagate(
        &self,
        sigma: &Matrix3<f64>,
        step_twist: &Vector3<f64>,
        compounding: Compounding,
    ) -> Matrix3<f64> {
        let inverse_adjoint = SE2::exp(step_twist).inverse().adjoint();
        let transported_cov = inverse_adjoint * sigma * inverse_adjoint.transpose();
        let last_turn_cov = Matrix3::from_diagonal(&Vector3::new(0.0, 0.0, self.last_turn_variance));
        if compounding == Compounding::Chapter {
            return transported_cov + self.r + last_turn_cov;
        }
        let jacobian = SE2::right_jacobian(step_twist);
        let step_cov = jacobian * self.r * jacobian.transpose() + last_turn_cov;
        let first_order_cov = transported_cov + step_cov;
        match compounding {
            Compounding::FourthOrder => first_order_cov + fourth_order_terms(&transported_cov, &step_cov),
            _ => first_order_cov,
        }
    }
}

/// Returns the fourth-order part of the covariance of log(exp(a)·exp(b)) for independent a and b with covariances `a` and `b`. The part is
/// (𝒜_a·b + b·𝒜_aᵀ + 𝒜_b·a + a·𝒜_bᵀ)/12 + ℬ/4, with 𝒜_a = E[ad(a)²] and ℬ = E[ad(a)·b·ad(a)ᵀ].
fn fourth_order_terms(a: &Matrix3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    let mean_square_of = |factor_cov| {
        expected_adjoint_product(factor_cov, |left_adjoint, right_adjoint| left_adjoint * right_adjoint)
    };
    let one_sided_terms = mean_square_of(a) * b + mean_square_of(b) * a;
    let two_sided_term = expected_adjoint_product(a, |left_adjoint, right_adjoint| {
        left_adjoint * b * right_adjoint.transpose()
    });
    (one_sided_terms + one_sided_terms.transpose()) / 12.0 + two_sided_term / 4.0
}

/// Returns E[f(ad(ξ), ad(ξ))] for a bilinear f and ξ of covariance `cov`. ad is linear, so that the expectation is a sum over the basis
/// twists.
fn expected_adjoint_product(
    cov: &Matrix3<f64>,
    bilinear_form: impl Fn(&Matrix3<f64>, &Matrix3<f64>) -> Matrix3<f64>,
) -> Matrix3<f64> {
    let basis_adjoints =
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|basis_twist| small_adjoint(&basis_twist));
    let mut expectation_sum = Matrix3::zeros();
    for (i, left_adjoint) in basis_adjoints.iter().enumerate() {
        for (j, right_adjoint) in basis_adjoints.iter().enumerate() {
            expectation_sum += bilinear_form(left_adjoint, right_adjoint) * cov[(i, j)];
        }
    }
    expectation_sum
}

fn small_adjoint(twist: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -twist.z, twist.y, twist.z, 0.0, -twist.x, 0.0, 0.0, 0.0)
}

/// Returns log N(residual; 0, cov) for a positive definite `cov`. The result is −∞ if `cov` is not positive definite after rounding.
fn log_gaussian_density(twist_residual: &Vector3<f64>, cov: &Matrix3<f64>) -> f64 {
    let Some(cov_root) = cov.cholesky().map(|cholesky| cholesky.unpack()) else { return f64::NEG_INFINITY };
    let log_det: f64 = (0..3).map(|i| 2.0 * libm::log(cov_root[(i, i)])).sum();
    // The squared norm of the whitened residual avoids a division by a variance, which may underflow.
    let Some(whitened_residual) = cov_root.solve_lower_triangular(twist_residual) else {
        return f64::NEG_INFINITY;
    };
    -0.5 * (whitened_residual.norm_squared() + log_det + 3.0 * libm::log(2.0 * PI))
}

/// Returns a lower triangular L with L·Lᵀ = cov. Columns of L for directions without variance are 0.
pub(crate) fn covariance_root(cov: &Matrix3<f64>) -> Result<Matrix3<f64>, TangentNoiseError> {
    if cov.iter().any(|cov_entry| !cov_entry.is_finite()) {
        return Err(TangentNoiseError::NotFinite);
    }
    if (cov - cov.transpose()).amax() > RELATIVE_TOLERANCE * cov.amax() {
        return Err(TangentNoiseError::NotSymmetric);
    }
    let mut cov_root = Matrix3::zeros();
    for j in 0..3 {
        let remaining_covariance =
            |row: usize| cov[(row, j)] - (0..j).map(|k| cov_root[(row, k)] * cov_root[(j, k)]).sum::<f64>();
        let remaining_column = [remaining_covariance(0), remaining_covariance(1), remaining_covariance(2)];
        let (remaining_variance, rounding_variance) =
            (remaining_column[j], RELATIVE_TOLERANCE * cov[(j, j)].abs());
        if remaining_variance > rounding_variance {
            for row in j..3 {
                cov_root[(row, j)] = remaining_column[row] / remaining_variance.sqrt();
            }
            continue;
        }
        // A coordinate without remaining variance must have no remaining covariance, because |c_ij| ≤ √(c_ii · c_jj).
        let has_no_covariance =
            |row: usize| remaining_column[row].abs() <= (rounding_variance * cov[(row, row)].abs()).sqrt();
        if remaining_variance < -rounding_variance || !(j + 1..3).all(has_no_covariance) {
            return Err(TangentNoiseError::NotPositiveSemidefinite);
        }
    }
    Ok(cov_root)
}
