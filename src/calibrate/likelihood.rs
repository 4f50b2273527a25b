//! Restricted likelihood (REML) of all residuals of a log.
//!
//! The residual of leg i is rᵢ = wᵢ + Aᵢ eᵢ₋₁ + Bᵢ eᵢ + Xᵢ β, with
//! - wᵢ the noise of the wheels, of covariance Dᵢ = diag(Σ αₖ cᵢₖ),
//! - eᵢ the error of the reference at the end of the leg, of covariance R = diag(σ_p², σ_p², σ_θ²),
//! - β the systematic errors.
//!
//! A reference pose ends one leg and starts the next, so that V = Cov(r) is block tridiagonal. The log-likelihood is
//!
//! ℓ = −½ [ln|V| + ln|XᵀV⁻¹X| + rᵀV⁻¹r − rᵀV⁻¹X (XᵀV⁻¹X)⁻¹ XᵀV⁻¹r − (N − q) ln 2π],
//!
//! with N residuals and q errors. A Kalman filter with the state eᵢ gives ℓ: it turns residuals into innovations νᵢ, which are independent, with
//! covariances Fᵢ. Derivatives of the innovations give the score, and the Fisher information Σ ½ tr(F⁻¹ ∂ⱼF F⁻¹ ∂ₖF) + ∂ⱼνᵀ F⁻¹ ∂ₖν (Harvey
//! 1989, 3.4).

use super::residuals::{ERROR_COUNT, ErrorMask, Model, Observation, SystematicError};
use super::result::LegFit;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use std::f64::consts::TAU;

/// Largest number of α's of a model.
pub(super) const MAX_ALPHAS: usize = 6;

/// Indices of the parameters σ_p² and σ_θ².
pub(super) const POSITION_VARIANCE: usize = MAX_ALPHAS;
pub(super) const YAW_VARIANCE: usize = MAX_ALPHAS + 1;

/// Indices of the parameters that are the variances of the reference in x, y and θ.
const REFERENCE_VARIANCES: [usize; 3] = [POSITION_VARIANCE, POSITION_VARIANCE, YAW_VARIANCE];

/// Number of variance parameters: α's, 0 where the model has fewer, then σ_p² (m²) and σ_θ² (rad²).
pub(super) const PARAMETER_COUNT: usize = MAX_ALPHAS + 2;
pub(super) type Parameters = SVector<f64, PARAMETER_COUNT>;
pub(super) type Information = SMatrix<f64, PARAMETER_COUNT, PARAMETER_COUNT>;

/// Columns that the Kalman filter predicts: the Jacobian of the residual with respect to each systematic error, then the residual.
pub(super) type Columns = SMatrix<f64, 3, COLUMN_COUNT>;
const COLUMN_COUNT: usize = ERROR_COUNT + 1;
pub(super) type ErrorMatrix = SMatrix<f64, ERROR_COUNT, ERROR_COUNT>;
pub(super) type ErrorVector = SVector<f64, ERROR_COUNT>;

/// Minimum standard deviation of a residual (rad, m or their rates), which keeps the likelihood of a log without noise finite.
const MIN_STD: f64 = 1e-7;

/// Mask of the parameters that are fitted. All other parameters are kept fixed.
pub(super) type FreeMask = [bool; PARAMETER_COUNT];

/// Residuals of successive legs, with the model, and the parameters and systematic errors that are fitted to them.
#[derive(Clone, Debug)]
pub(super) struct Residuals<'a> {
    pub model: Model,
    pub free: FreeMask,
    pub estimated: ErrorMask,
    pub observations: &'a [Observation],
    /// True for each leg that is fitted.
    pub is_fitted: Vec<bool>,
}

/// Innovation of one leg: its residual and the Jacobian of the residual, minus their predictions from the previous legs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Innovation {
    columns: Columns,
    /// Variance of each component; NaN for a component that is not observed.
    variances: [f64; 3],
    /// Inverse covariance of the innovation.
    weight: Matrix3<f64>,
    /// Kalman gain of the reference's error at the end of the leg.
    gain: Matrix3<f64>,
    determinant: f64,
    is_fitted: bool,
}

/// Innovations of all legs under given variances, and generalized least squares of the systematic errors.
#[derive(Clone, Debug)]
pub(super) struct FilterResult {
    pub innovations: Vec<Innovation>,
    pub log_likelihood: f64,
    /// Information on all systematic errors, XᵀV⁻¹X.
    pub information: ErrorMatrix,
    /// XᵀV⁻¹r.
    weighted_residual: ErrorVector,
    /// Estimates of the systematic errors β; 0 for errors that are not estimated.
    pub errors: ErrorVector,
    /// Covariance of the estimate: the inverse of the information on the errors that are estimated.
    pub covariance: ErrorMatrix,
}

/// Log-likelihood at `parameters`, with its derivatives with respect to the fitted parameters; 0 for fixed parameters.
#[derive(Clone, Debug)]
pub(super) struct Expansion {
    pub parameters: Parameters,
    pub filter_result: FilterResult,
    /// Sum of the scores of all legs.
    pub score: Parameters,
    pub scores: Vec<Parameters>,
    pub information: Information,
    /// Inverse of the information; 0 for parameters without information.
    pub covariance: Information,
}

impl Residuals<'_> {
    /// Returns the innovations of all legs, by a Kalman filter whose state is the error of the reference at the end of a leg. Nothing is
    /// known about this error after a leg that is not fitted, and before a leg that does not follow the previous leg.
    pub fn innovations(&self, parameters: &Parameters) -> impl Iterator<Item = Innovation> {
        let reference_covariance = reference_covariance(parameters);
        let (mut mean, mut prior_covariance) = (Columns::zeros(), reference_covariance);
        self.observations.iter().zip(&self.is_fitted).map(move |(leg, is_fitted)| {
            let [start, end] = &leg.reference_jacobians;
            if !leg.follows {
                (mean, prior_covariance) = (Columns::zeros(), reference_covariance);
            }
            let columns = leg.columns - product(start, &mean);
            let scaled_end = product(end, &reference_covariance);
            let mut covariance =
                propagated(start, &prior_covariance) + product(&scaled_end, &end.transpose());
            let wheel_variances = self.model.wheel_variances(&leg.coefficients, parameters);
            let is_unobserved = leg.residuals.map(f64::is_nan);
            for k in 0..3 {
                covariance[(k, k)] +=
                    wheel_variances[k] + if is_unobserved[k] { 1.0 } else { MIN_STD * MIN_STD };
            }
            let weight = covariance.try_inverse().unwrap_or_default();
            let gain = product(&scaled_end.transpose(), &weight);
            (mean, prior_covariance) = (Columns::zeros(), reference_covariance);
            if *is_fitted {
                mean = product(&gain, &columns);
                prior_covariance -= product(&gain, &scaled_end);
            }
            let variances =
                std::array::from_fn(|k| if is_unobserved[k] { f64::NAN } else { covariance[(k, k)] });
            let determinant = covariance.determinant();
            Innovation { columns, variances, weight, gain, determinant, is_fitted: *is_fitted }
        })
    }
}

impl FilterResult {
    /// Returns the standard errors of the systematic errors; 0 for errors that are not estimated.
    ///
    /// Each standard error is the larger of two estimates. The covariance C by the likelihood counts correlated legs as fewer legs, by the
    /// `correlation` of neighbours. The sandwich C (Σ gᵦ gᵦᵀ) C has correlated legs in one block, with gᵦ the score of a block of legs.
    pub fn error_stds(&self, correlation: f64) -> [f64; ERROR_COUNT] {
        let Self { innovations, errors, covariance, .. } = self;
        let score_of_leg = |innovation: &Innovation| {
            let weighted_residual = innovation.weight * innovation.without(errors);
            innovation.columns.fixed_columns::<ERROR_COUNT>(0).tr_mul(&weighted_residual)
        };
        let scores = innovations.chunks(legs_per_score_block(innovations.len())).map(|block| {
            let fitted_legs = block.iter().filter(|leg| leg.is_fitted);
            let score: ErrorVector = fitted_legs.map(score_of_leg).sum();
            score * score.transpose()
        });
        let sandwich = covariance * scores.sum::<ErrorMatrix>() * covariance;
        let variance_factor = (1.0 + correlation) / (1.0 - correlation);
        std::array::from_fn(|i| (variance_factor * covariance[(i, i)]).max(sandwich[(i, i)]).max(0.0).sqrt())
    }

    /// Returns the innovation of each leg, without the part that systematic errors explain.
    pub fn leg_fits(&self, errors: &ErrorVector) -> Vec<LegFit> {
        self.innovations.iter().map(|innovation| innovation.leg_fit(errors)).collect()
    }

    /// Returns the estimates of the systematic errors in a mask; 0 for all others.
    pub fn errors_in(&self, error_mask: &ErrorMask) -> ErrorVector {
        masked_inverse(&self.information, error_mask).0 * self.weighted_residual
    }
}

/// Returns the number of legs of a block whose scores are summed for a sandwich covariance.
pub(super) fn legs_per_score_block(leg_count: usize) -> usize {
    ((2.0 * (leg_count as f64).cbrt()).ceil() as usize).max(1)
}

impl Innovation {
    /// Returns the innovation minus the part that the systematic `errors` explain.
    fn without(&self, errors: &ErrorVector) -> Vector3<f64> {
        self.columns * -errors.push(-1.0)
    }

    /// Returns the innovation, without the part that systematic errors explain, with its standard deviations and its squared Mahalanobis
    /// distance.
    pub fn leg_fit(&self, errors: &ErrorVector) -> LegFit {
        let (innovation, stds) = (self.without(errors), self.variances.map(f64::sqrt));
        LegFit {
            stds,
            standardized: std::array::from_fn(|k| innovation[k] / stds[k]),
            squared: innovation.dot(&(self.weight * innovation)),
            is_outlier: !self.is_fitted,
        }
    }
}

impl Residuals<'_> {
    pub fn filter_result(&self, parameters: &Parameters) -> FilterResult {
        let innovations: Vec<Innovation> = self.innovations(parameters).collect();
        let (mut log_det, mut gram) = (0.0, SMatrix::<f64, COLUMN_COUNT, COLUMN_COUNT>::zeros());
        let mut residual_count = 0;
        for Innovation { columns, variances, weight, determinant, .. } in
            innovations.iter().filter(|leg| leg.is_fitted)
        {
            residual_count += variances.iter().filter(|variance| !variance.is_nan()).count();
            // If variances differ by many orders of magnitude, rounding can make the covariance indefinite.
            log_det += if *determinant > 0.0 { libm::log(*determinant) } else { f64::INFINITY };
            gram += columns.tr_mul(&product(weight, columns));
        }
        let information: ErrorMatrix = gram.fixed_view::<ERROR_COUNT, ERROR_COUNT>(0, 0).into_owned();
        let (covariance, log_det_information) = masked_inverse(&information, &self.estimated);
        let weighted_residual: ErrorVector = gram.fixed_view::<ERROR_COUNT, 1>(0, ERROR_COUNT).into_owned();
        let errors = covariance * weighted_residual;
        let estimated_count = self.estimated.iter().filter(|is_estimated| **is_estimated).count();
        let degrees_of_freedom = residual_count as f64 - estimated_count as f64;
        let deviance = log_det + log_det_information + gram[(ERROR_COUNT, ERROR_COUNT)]
            - weighted_residual.dot(&errors)
            + degrees_of_freedom * libm::log(TAU);
        let log_likelihood = -0.5 * deviance;
        FilterResult { innovations, log_likelihood, information, weighted_residual, errors, covariance }
    }

    /// Returns the expansion of the log-likelihood around parameters, from the result of the Kalman filter with these parameters.
    ///
    /// With the estimated errors β, their covariance C, and M = (−β, 1)(−β, 1)ᵀ + C, the score of a leg with the columns N = (X, r) after
    /// the prediction is −½ tr[(F⁻¹ − F⁻¹ N M Nᵀ F⁻¹) ∂F] − tr[M Nᵀ F⁻¹ ∂N]. The derivatives of a leg follow from those of the previous
    /// leg, which have a prime. K' is the gain of the previous leg, T = A K', and G = A − T B'.
    ///
    /// - ∂F = S + B ∂R Bᵀ with S = T S' Tᵀ + G ∂R Gᵀ + ∂D
    /// - ∂N = −T (∂N' − S' F'⁻¹N') − G ∂R B'ᵀ F'⁻¹N'
    pub fn expansion(&self, parameters: &Parameters, filter_result: FilterResult) -> Expansion {
        let unit_parameters: [Parameters; PARAMETER_COUNT] = std::array::from_fn(|j| Parameters::ith(j, 1.0));
        let reference_derivatives = unit_parameters.map(|unit| reference_covariance(&unit));
        let contrast = -filter_result.errors.push(-1.0);
        let mut error_weights = contrast * contrast.transpose();
        let mut error_block = error_weights.fixed_view_mut::<ERROR_COUNT, ERROR_COUNT>(0, 0);
        error_block += filter_result.covariance;
        let mut covariance_derivatives = [Matrix3::zeros(); PARAMETER_COUNT];
        let mut column_derivatives = [Columns::zeros(); PARAMETER_COUNT];
        let (mut gain_before, mut end_before) = (Matrix3::zeros(), Matrix3::zeros());
        let (mut weighted_before, mut information) = (Columns::zeros(), Information::zeros());
        let mut scores = vec![Parameters::zeros(); self.observations.len()];
        for ((leg, innovation), score) in
            self.observations.iter().zip(&filter_result.innovations).zip(&mut scores)
        {
            let [start, end] = &leg.reference_jacobians;
            let Innovation { columns, weight, gain, is_fitted, .. } = innovation;
            if !leg.follows || !is_fitted {
                (gain_before, end_before) = Default::default();
            }
            if !is_fitted {
                continue;
            }
            let transition_matrix = product(start, &gain_before);
            let start_gain = start - product(&transition_matrix, &end_before);
            let end_weighted = product(&end_before.transpose(), &weighted_before);
            let weighted = product(weight, columns);
            let column_scores = product(&weighted, &error_weights);
            let covariance_scores = weight - product(&column_scores, &weighted.transpose());
            let mut relative_derivatives = [Matrix3::zeros(); PARAMETER_COUNT];
            let mut innovation_derivatives = [Vector3::zeros(); PARAMETER_COUNT];
            for j in (0..PARAMETER_COUNT).filter(|j| self.free[*j]) {
                let (derivative, start_covariance) =
                    (&mut column_derivatives[j], &mut covariance_derivatives[j]);
                let change = product(start_covariance, &weighted_before) - *derivative;
                *derivative = product(&transition_matrix, &change);
                *start_covariance = propagated(&transition_matrix, start_covariance);
                let wheel_variances = self.model.wheel_variances(&leg.coefficients, &unit_parameters[j]);
                for k in 0..3 {
                    start_covariance[(k, k)] += wheel_variances[k];
                }
                let mut covariance = *start_covariance;
                if j >= MAX_ALPHAS {
                    let reference = &reference_derivatives[j];
                    *derivative -= product(&product(&start_gain, reference), &end_weighted);
                    *start_covariance += propagated(&start_gain, reference);
                    covariance = *start_covariance + propagated(end, reference);
                }
                score[j] = -0.5 * covariance_scores.dot(&covariance) - column_scores.dot(derivative);
                relative_derivatives[j] = product(weight, &covariance);
                innovation_derivatives[j] = *derivative * contrast;
                let weighted_derivative = product(weight, &innovation_derivatives[j]);
                let transposed_derivative = relative_derivatives[j].transpose();
                for k in 0..=j {
                    information[(j, k)] += 0.5 * transposed_derivative.dot(&relative_derivatives[k])
                        + weighted_derivative.dot(&innovation_derivatives[k]);
                }
            }
            (weighted_before, gain_before, end_before) = (weighted, *gain, *end);
        }
        information.fill_upper_triangle_with_lower_triangle();
        let (covariance, _) = masked_inverse(&information, &self.free);
        let score = scores.iter().sum();
        Expansion { parameters: *parameters, filter_result, score, scores, information, covariance }
    }
}

/// Returns the covariance R of the reference's error in x, y and θ.
pub(super) fn reference_covariance(parameters: &Parameters) -> Matrix3<f64> {
    Matrix3::from_diagonal(&REFERENCE_VARIANCES.map(|variance| parameters[variance]).into())
}

/// Returns the mask of the systematic errors in `candidate_errors` that are identifiable. The error with the largest standard error relative to
/// its limit is removed until no error exceeds its limit.
pub(super) fn identifiable_errors(information: &ErrorMatrix, candidate_errors: ErrorMask) -> ErrorMask {
    let mut error_mask: ErrorMask = std::array::from_fn(|i| candidate_errors[i] && information[(i, i)] > 0.0);
    loop {
        let (covariance, _) = masked_inverse(information, &error_mask);
        let relative_std_of = |error: &usize| {
            covariance[(*error, *error)].sqrt() / SystematicError::ALL[*error].identifiability_limit()
        };
        let remaining_errors = (0..ERROR_COUNT).filter(|error| error_mask[*error]);
        match remaining_errors.max_by(|a, b| relative_std_of(a).total_cmp(&relative_std_of(b))) {
            Some(worst_error) if relative_std_of(&worst_error) > 1.0 => error_mask[worst_error] = false,
            _ => return error_mask,
        }
    }
}

/// Returns the product of two matrices. In WebAssembly a call of nalgebra's general product takes longer than the product itself.
// The function is not inlined, because many copies would make the module larger.
#[inline(never)]
fn product<const N: usize, const K: usize>(
    left_matrix: &SMatrix<f64, 3, K>,
    right_matrix: &SMatrix<f64, K, N>,
) -> SMatrix<f64, 3, N> {
    let mut product = SMatrix::<f64, 3, N>::zeros();
    for ([x, y, z], factors) in product.data.0.iter_mut().zip(&right_matrix.data.0) {
        for ([a, b, c], factor) in left_matrix.data.0.iter().zip(factors) {
            *x += a * factor;
            *y += b * factor;
            *z += c * factor;
        }
    }
    product
}

/// Returns the covariance J C Jᵀ of a linear function with the Jacobian J.
pub(super) fn propagated(jacobian: &Matrix3<f64>, covariance: &Matrix3<f64>) -> Matrix3<f64> {
    product(&product(jacobian, covariance), &jacobian.transpose())
}

/// Relative amount by which the diagonal of a matrix is increased before it is inverted, because rows may be collinear.
const REGULARIZATION: f64 = 1e-9;

/// Returns the inverse of the submatrix of an information matrix that a mask selects, with 0 elsewhere, and the logarithm of the
/// submatrix's determinant. Variables without information are not selected.
pub(super) fn masked_inverse<const N: usize>(
    information: &SMatrix<f64, N, N>,
    free_mask: &[bool; N],
) -> (SMatrix<f64, N, N>, f64) {
    // The diagonal is scaled to 1, because variables differ by orders of magnitude.
    let scales: [f64; N] = std::array::from_fn(|i| {
        if free_mask[i] && information[(i, i)] > 0.0 { 1.0 / information[(i, i)].sqrt() } else { 0.0 }
    });
    let scaled_information = SMatrix::<f64, N, N>::from_fn(|i, j| {
        if i == j { 1.0 + REGULARIZATION } else { information[(i, j)] * scales[i] * scales[j] }
    });
    let Some(cholesky) = nalgebra::Cholesky::new(scaled_information) else { return (SMatrix::zeros(), 0.0) };
    let scaled_covariance = cholesky.inverse();
    let selected_scales = scales.iter().filter(|scale| **scale > 0.0);
    let log_det =
        cholesky.ln_determinant() - 2.0 * selected_scales.map(|scale| libm::log(*scale)).sum::<f64>();
    (SMatrix::from_fn(|i, j| scaled_covariance[(i, j)] * scales[i] * scales[j]), log_det)
}
