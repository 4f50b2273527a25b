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
//! with N residuals and q errors. A forward recursion over 3 × 3 blocks (a Kalman filter with the state eᵢ) gives ℓ, and a backward
//! recursion gives its score. V is linear in the parameters, so that the average of observed and expected information is a product of
//! vectors (Gilmour, Thompson and Cullis 1995).

use super::legs::Leg;
use super::matrices::{masked_inverse, product, propagated, quadratic_form, transposed_product};
use super::residuals::{Model, Observation};
use super::result::LegFit;
use super::systematic::{ERROR_COUNT, ErrorMask, Systematic, SystematicError};
use crate::geom::se2::SE2;
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

/// Columns that the recursion carries: the Jacobian of the residual with respect to each systematic error, then the residual.
type Columns = SMatrix<f64, 3, COLUMN_COUNT>;
const COLUMN_COUNT: usize = ERROR_COUNT + 1;
pub(super) type ErrorMatrix = SMatrix<f64, ERROR_COUNT, ERROR_COUNT>;
pub(super) type ErrorVector = SVector<f64, ERROR_COUNT>;

/// Minimum standard deviation of a residual (rad, m or their rates). It keeps the likelihood of a log without noise finite.
const MIN_STD: f64 = 1e-7;

/// Maximum absolute value of residuals and their derivatives. Legs with larger values are not used, because their squares would overflow.
const MAX_ENTRY: f64 = 1e30;

/// Residuals of one leg in the form that the likelihood needs. By default it has no observed component.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Term {
    columns: Columns,
    /// Factors of the α's in the variance of each component.
    coefficients: [[f64; 2]; 3],
    /// False for a component without a residual. Its residual is 0 here, and its variance 1.
    observed: [bool; 3],
    /// Jacobians with respect to the reference's errors at the start and at the end of the leg.
    start: Matrix3<f64>,
    end: Matrix3<f64>,
    /// True if the leg starts at the reference pose at which the previous leg ends.
    pub follows: bool,
}

/// Residuals of several legs, with the model and the systematic errors that are estimated with them.
#[derive(Clone, Debug)]
pub(super) struct Residuals {
    pub model: Model,
    pub estimated: ErrorMask,
    pub terms: Vec<Term>,
}

/// Innovation of one leg: its residual, and optionally the Jacobian of the residual, minus their predictions from the previous legs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Innovation<const N: usize> {
    columns: SMatrix<f64, 3, N>,
    /// Variance of each component; NaN for a component that is not observed.
    variances: [f64; 3],
    /// Inverse covariance.
    weight: Matrix3<f64>,
    /// Kalman gain of the reference's error at the end of the leg.
    gain: Matrix3<f64>,
    /// Determinant of the covariance.
    determinant: f64,
}

/// Kalman filter whose state is the error of the reference at the end of a leg.
pub(super) struct Filter<'a, const N: usize> {
    model: Model,
    parameters: &'a Parameters,
    reference_covariance: Matrix3<f64>,
    /// Mean and covariance of the reference's error at the start of the leg.
    mean: SMatrix<f64, 3, N>,
    prior: Matrix3<f64>,
}

/// Innovations of all legs under given variances, and generalized least squares of the systematic errors.
#[derive(Clone, Debug)]
pub(super) struct FilterResult {
    pub innovations: Vec<Innovation<COLUMN_COUNT>>,
    pub log_likelihood: f64,
    /// Information on all errors, XᵀV⁻¹X.
    pub information: ErrorMatrix,
    /// XᵀV⁻¹r.
    weighted_residual: ErrorVector,
    /// Estimates of the systematic errors β; 0 for those that are not estimated.
    pub errors: ErrorVector,
    /// Covariance of the estimate: the inverse of the information on the errors that are estimated.
    pub covariance: ErrorMatrix,
}

/// Log-likelihood with its derivatives with respect to the parameters.
#[derive(Clone, Debug)]
pub(super) struct Expansion {
    pub filtered: FilterResult,
    /// Sum of the scores of all legs: ½ (rᵀP Vⱼ P r − tr(P Vⱼ)) for each parameter j.
    pub score: Parameters,
    /// tr(P Vⱼ) for each parameter j.
    pub traces: Parameters,
    /// Score of each leg.
    pub scores: Vec<Parameters>,
    pub information: Information,
}

impl Term {
    pub fn new(model: Model, leg: &Leg, observation: &Observation, corrected: &Systematic) -> Self {
        let Observation { residuals, coefficients, jacobian, expected, measured, .. } = observation;
        let error_jacobian = jacobian * corrected.motion_jacobian(model, leg, expected);
        if residuals.iter().chain(&error_jacobian).any(|entry| entry.abs() > MAX_ENTRY) {
            return Self::default();
        }
        let observed = residuals.map(|residual| !residual.is_nan());
        let observed_residuals = residuals.map(|residual| if residual.is_nan() { 0.0 } else { residual });
        let mut columns = Columns::zeros();
        columns.fixed_columns_mut::<ERROR_COUNT>(0).copy_from(&error_jacobian);
        columns.set_column(ERROR_COUNT, &observed_residuals.into());
        // Errors of the reference displace the measured end, whose heading differs from that of the expected end.
        let heading_error = expected.between(measured).theta();
        let end_jacobian = jacobian * SE2::new(0.0, 0.0, heading_error).adjoint();
        let [start, end] =
            corrected.reference_jacobians(measured).map(|pose_jacobian| end_jacobian * pose_jacobian);
        Self { columns, coefficients: *coefficients, observed, start, end, follows: false }
    }

    pub fn with_follows(self, follows: bool) -> Self {
        Self { follows, ..self }
    }

    /// Returns the residual minus the part that these systematic errors explain.
    pub fn residual_without(&self, errors: &ErrorVector) -> Vector3<f64> {
        residual_without_errors(&self.columns, errors)
    }
}

impl<'a, const N: usize> Filter<'a, N> {
    pub fn new(model: Model, parameters: &'a Parameters) -> Self {
        let reference_covariance = reference_covariance(parameters);
        let (mean, prior) = (SMatrix::zeros(), reference_covariance);
        Self { model, parameters, reference_covariance, mean, prior }
    }

    /// Returns the innovation of the next leg, given its columns. `follows` is false for a leg that does not start where the last one ended.
    #[inline(always)]
    pub fn next(&mut self, term: &Term, columns: &SMatrix<f64, 3, N>, follows: bool) -> Innovation<N> {
        if !follows {
            (self.mean, self.prior) = (SMatrix::zeros(), self.reference_covariance);
        }
        let columns = columns - product(&term.start, &self.mean);
        let scaled_end = product(&term.end, &self.reference_covariance);
        let mut covariance =
            propagated(&term.start, &self.prior) + product(&scaled_end, &term.end.transpose());
        let wheels = self.model.wheel_variances(&term.coefficients, self.parameters);
        for k in 0..3 {
            covariance[(k, k)] += wheels[k] + if term.observed[k] { MIN_STD * MIN_STD } else { 1.0 };
        }
        let weight = covariance.try_inverse().unwrap_or_default();
        let gain = product(&scaled_end.transpose(), &weight);
        self.mean = product(&gain, &columns);
        self.prior = self.reference_covariance - product(&gain, &scaled_end);
        let variances = std::array::from_fn(|k| if term.observed[k] { covariance[(k, k)] } else { f64::NAN });
        Innovation { columns, variances, weight, gain, determinant: covariance.determinant() }
    }
}

impl FilterResult {
    /// Returns the standard errors of the systematic errors; 0 for those that are not estimated.
    ///
    /// Each is the larger one of two: that of the covariance C by the likelihood, and that of the sandwich C (Σ gᵦ gᵦᵀ) C with gᵦ the score of a
    /// block of legs. The first counts correlated legs as fewer legs, by the `correlation` of neighbours. The second has correlated legs in one
    /// block.
    pub fn error_stds(&self, correlation: f64) -> [f64; ERROR_COUNT] {
        let Self { innovations, errors, covariance, .. } = self;
        let score_of_leg = |innovation: &Innovation<COLUMN_COUNT>| {
            let weighted = innovation.weight * residual_without_errors(&innovation.columns, errors);
            innovation.columns.fixed_columns::<ERROR_COUNT>(0).tr_mul(&weighted)
        };
        let scores = innovations.chunks(block_length(innovations.len())).map(|block| {
            let score: ErrorVector = block.iter().map(score_of_leg).sum();
            score * score.transpose()
        });
        let sandwich = covariance * scores.sum::<ErrorMatrix>() * covariance;
        let variance_factor = (1.0 + correlation) / (1.0 - correlation);
        std::array::from_fn(|i| (variance_factor * covariance[(i, i)]).max(sandwich[(i, i)]).max(0.0).sqrt())
    }

    /// Returns the innovation of each leg, without the part that the estimated errors explain.
    pub fn leg_fits(&self) -> impl Iterator<Item = LegFit> {
        self.innovations.iter().map(|innovation| {
            innovation.leg_fit(residual_without_errors(&innovation.columns, &self.errors), false)
        })
    }

    /// Returns the estimates of the systematic errors in a mask; 0 for all others.
    pub fn errors_in(&self, mask: &ErrorMask) -> ErrorVector {
        masked_inverse(&self.information, mask).0 * self.weighted_residual
    }
}

/// Returns the number of legs of a block whose scores are summed for a sandwich covariance.
pub(super) fn block_length(legs: usize) -> usize {
    ((2.0 * (legs as f64).cbrt()).ceil() as usize).max(1)
}

impl Innovation<1> {
    /// Returns the innovation as [`LegFit`].
    pub fn fit_of_residual(&self, is_outlier: bool) -> LegFit {
        self.leg_fit(self.columns, is_outlier)
    }
}

impl<const N: usize> Innovation<N> {
    /// Returns an innovation, without the part that systematic errors explain, with its standard deviations and its squared distance.
    fn leg_fit(&self, innovation: Vector3<f64>, is_outlier: bool) -> LegFit {
        let stds = self.variances.map(f64::sqrt);
        LegFit {
            stds,
            standardized: std::array::from_fn(|k| innovation[k] / stds[k]),
            squared: innovation.dot(&(self.weight * innovation)),
            is_outlier,
        }
    }
}

/// Returns the residual minus the part that these systematic errors explain.
#[inline(always)]
fn residual_without_errors(columns: &Columns, errors: &ErrorVector) -> Vector3<f64> {
    Vector3::from_fn(|k, _| {
        columns[(k, ERROR_COUNT)]
            - (0..ERROR_COUNT).map(|error| columns[(k, error)] * errors[error]).sum::<f64>()
    })
}

impl Residuals {
    /// Runs the forward recursion under the given variances.
    pub fn filtered(&self, parameters: &Parameters) -> FilterResult {
        let mut innovations = Vec::with_capacity(self.terms.len());
        let mut filter = Filter::new(self.model, parameters);
        let (mut log_det, mut gram) = (0.0, SMatrix::<f64, COLUMN_COUNT, COLUMN_COUNT>::zeros());
        // Determinants are multiplied, because one logarithm is cheaper than many.
        let mut det = 1.0;
        for term in &self.terms {
            let innovation = filter.next(term, &term.columns, term.follows);
            det *= innovation.determinant;
            if innovation.determinant <= 0.0 {
                // Variances differ by so many orders of magnitude that rounding makes the covariance indefinite.
                log_det = f64::INFINITY;
            } else if !(1e-200..1e200).contains(&det) {
                log_det += libm::log(det);
                det = 1.0;
            }
            gram +=
                transposed_product(&innovation.columns, &product(&innovation.weight, &innovation.columns));
            innovations.push(innovation);
        }
        log_det += libm::log(det.abs());
        let information: ErrorMatrix = gram.fixed_view::<ERROR_COUNT, ERROR_COUNT>(0, 0).into_owned();
        let (covariance, log_det_information) = masked_inverse(&information, &self.estimated);
        let weighted_residual: ErrorVector = gram.fixed_view::<ERROR_COUNT, 1>(0, ERROR_COUNT).into_owned();
        let errors = covariance * weighted_residual;
        let count_true = |flags: &[bool]| flags.iter().filter(|is| **is).count() as f64;
        let residual_count: f64 = self.terms.iter().map(|term| count_true(&term.observed)).sum();
        let degrees_of_freedom = residual_count - count_true(&self.estimated);
        let deviance = log_det + log_det_information + gram[(ERROR_COUNT, ERROR_COUNT)]
            - weighted_residual.dot(&errors)
            + degrees_of_freedom * libm::log(TAU);
        let log_likelihood = -0.5 * deviance;
        FilterResult { innovations, log_likelihood, information, weighted_residual, errors, covariance }
    }

    /// Returns the log-likelihood with its derivatives, from the innovations under the same parameters.
    pub fn expansion(&self, filtered: FilterResult) -> Expansion {
        let FilterResult { innovations, errors, covariance, .. } = &filtered;
        let alphas = self.model.component_alphas();
        let (mut scores, mut traces) = (vec![Parameters::zeros(); self.terms.len()], Parameters::zeros());
        // For each leg: P r, and its projections on the errors of the reference poses at start and end. A and B are the Jacobians by the pose
        // at the start and by that at the end. The projection at a pose is Bᵀ P r of the leg that ends there, plus Aᵀ P r of the leg that
        // starts there. It is stored with the leg that ends there, if there is one.
        let mut projected = vec![[Vector3::zeros(); 3]; self.terms.len()];
        // V⁻¹[X r] of the next leg in the log, its block on the diagonal of V⁻¹, and its Jacobian A.
        let mut next_leg: Option<(Columns, Matrix3<f64>, Matrix3<f64>)> = None;
        for (i, (term, innovation)) in self.terms.iter().zip(innovations).enumerate().rev() {
            let Innovation { columns, weight, gain, .. } = innovation;
            let (mut solved, mut block) = (product(weight, columns), *weight);
            let (mut at_end, mut end_block) = (Columns::zeros(), Matrix3::zeros());
            if let Some((next, next_block, start)) = &next_leg {
                let carried_gain = product(start, gain);
                at_end = transposed_product(start, next);
                solved -= transposed_product(gain, &at_end);
                let off_diagonal = -product(next_block, &carried_gain);
                block -= transposed_product(&carried_gain, &off_diagonal);
                let cross_block = product(&transposed_product(start, &off_diagonal), &term.end);
                end_block =
                    propagated(&start.transpose(), next_block) + cross_block + cross_block.transpose();
            }
            at_end += transposed_product(&term.end, &solved);
            end_block += propagated(&term.end.transpose(), &block);
            // Adds the scores of variances, given V⁻¹[X r] of their components and the block of V⁻¹. Returns P r of the components.
            let mut add_scores = |solved: &Columns,
                                  block: &Matrix3<f64>,
                                  variances: [[(usize, f64); 2]; 3]| {
                let projection = residual_without_errors(solved, errors);
                for (row, variances) in variances.into_iter().enumerate() {
                    // P = V⁻¹ − V⁻¹X C XᵀV⁻¹ with the covariance C of the errors. x is a row of V⁻¹X.
                    let x = std::array::from_fn(|error| solved[(row, error)]);
                    let trace = block[(row, row)] - quadratic_form(covariance, &x);
                    for (parameter, factor) in variances {
                        traces[parameter] += factor * trace;
                        scores[i][parameter] += 0.5 * factor * (projection[row] * projection[row] - trace);
                    }
                }
                projection
            };
            let wheels = [0, 1, 2].map(|row| [0, 1].map(|k| (alphas[row][k], term.coefficients[row][k])));
            let reference = REFERENCE_VARIANCES.map(|variance| [(variance, 1.0), (variance, 0.0)]);
            let leg_projection = add_scores(&solved, &block, wheels);
            let end = add_scores(&at_end, &end_block, reference);
            let start = if term.follows {
                Vector3::zeros()
            } else {
                let start_block = propagated(&term.start.transpose(), &block);
                add_scores(&transposed_product(&term.start, &solved), &start_block, reference)
            };
            projected[i] = [leg_projection, start, end];
            next_leg = term.follows.then_some((solved, block, term.start));
        }
        let information = self.average_information(innovations, &projected, covariance);
        Expansion { filtered, score: scores.iter().sum(), traces, scores, information }
    }

    /// Returns the average information ½ rᵀP Vⱼ P Vₖ P r for each pair of parameters j and k.
    fn average_information(
        &self,
        innovations: &[Innovation<COLUMN_COUNT>],
        projected: &[[Vector3<f64>; 3]],
        covariance: &ErrorMatrix,
    ) -> Information {
        let mut gram = Information::zeros();
        let mut cross_products = SMatrix::<f64, COLUMN_COUNT, PARAMETER_COUNT>::zeros();
        let (mut mean, mut pose) = (SMatrix::<f64, 3, PARAMETER_COUNT>::zeros(), Vector3::zeros());
        let alphas = self.model.component_alphas();
        for ((term, innovation), [projected_noise, start, end]) in
            self.terms.iter().zip(innovations).zip(projected)
        {
            if !term.follows {
                (mean, pose) = (SMatrix::zeros(), *start);
            }
            let mut columns = -product(&term.start, &mean);
            for k in 0..3 {
                for (alpha, factor) in alphas[k].into_iter().zip(term.coefficients[k]) {
                    columns[(k, alpha)] += factor * projected_noise[k];
                }
                for (axis, variance) in REFERENCE_VARIANCES.into_iter().enumerate() {
                    columns[(k, variance)] +=
                        term.start[(k, axis)] * pose[axis] + term.end[(k, axis)] * end[axis];
                }
            }
            let weighted_columns = product(&innovation.weight, &columns);
            gram += transposed_product(&columns, &weighted_columns);
            cross_products += transposed_product(&innovation.columns, &weighted_columns);
            mean = product(&innovation.gain, &columns);
            pose = *end;
        }
        let cross_products = cross_products.fixed_rows::<ERROR_COUNT>(0);
        (gram - cross_products.transpose() * covariance * cross_products) * 0.5
    }
}

/// Returns the covariance R of the reference's error in x, y and θ.
pub(super) fn reference_covariance(parameters: &Parameters) -> Matrix3<f64> {
    Matrix3::from_diagonal(&REFERENCE_VARIANCES.map(|variance| parameters[variance]).into())
}

/// Returns the mask of the systematic errors that are identifiable. The error with the largest standard error relative to its limit is left
/// out, until none exceeds its limit.
pub(super) fn identifiable_errors(information: &ErrorMatrix) -> ErrorMask {
    let mut mask = SystematicError::ALL.map(|error| information[(error as usize, error as usize)] > 0.0);
    loop {
        let (covariance, _) = masked_inverse(information, &mask);
        let relative_std = |error: &usize| {
            covariance[(*error, *error)].sqrt() / SystematicError::ALL[*error].identifiability_limit()
        };
        let candidates = (0..ERROR_COUNT).filter(|error| mask[*error]);
        match candidates.max_by(|a, b| relative_std(a).total_cmp(&relative_std(b))) {
            Some(worst) if relative_std(&worst) > 1.0 => mask[worst] = false,
            _ => return mask,
        }
    }
}
