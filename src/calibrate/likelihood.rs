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
use super::matrices::{WideMatrix, inverse, product};
use super::residuals::{Model, Observation};
use super::result::LegFit;
use super::systematic::{ERROR_COUNT, ErrorMask, Systematic, SystematicError};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use std::f64::consts::TAU;
use std::rc::Rc;

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
type JacobianAndResidual = WideMatrix<3>;
const RESIDUAL_COLUMN: usize = ERROR_COUNT;
type Gram = WideMatrix<{ RESIDUAL_COLUMN + 1 }>;
pub(super) type ErrorMatrix = SMatrix<f64, ERROR_COUNT, ERROR_COUNT>;
type ErrorVector = SVector<f64, ERROR_COUNT>;

/// Minimum standard deviation of a residual (rad, m or their rates). It keeps the likelihood of a log without noise finite.
const MIN_STD: f64 = 1e-7;

/// Maximum absolute value of residuals and their derivatives. Legs with larger values are not used.
const MAX_ENTRY: f64 = 1e30;

/// Residuals of one leg in the form that the likelihood needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term {
    columns: JacobianAndResidual,
    /// Factors of the α's in the variance of each component.
    coefficients: [[f64; 2]; 3],
    /// False for a component without a residual. Its residual is 0 here, and its variance 1.
    observed: [bool; 3],
    /// Jacobians with respect to the reference's errors at the start and at the end of the leg.
    start: Matrix3<f64>,
    end: Matrix3<f64>,
}

/// Residuals of several legs, with the model and the systematic errors that are estimated with them.
#[derive(Clone, Debug)]
pub(super) struct Residuals {
    terms: Rc<Vec<Term>>,
    /// Indices of the terms that are used, each with true if its leg starts at the reference pose at which the previous leg ends.
    chosen: Vec<(usize, bool)>,
    /// Number of observed components of the used terms.
    count: usize,
    model: Model,
    estimated: ErrorMask,
}

/// Innovation of one leg: its residual, and the Jacobian of the residual, minus their predictions from the previous legs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Innovation {
    columns: JacobianAndResidual,
    /// Variance of each component; NaN for a component that is not observed.
    variances: [f64; 3],
    /// Inverse covariance.
    weight: Matrix3<f64>,
    /// Kalman gain of the reference's error at the end of the leg.
    gain: Matrix3<f64>,
}

/// Innovations of all legs under given variances, with the resulting least-squares estimate.
#[derive(Clone, Debug)]
pub(super) struct FilterResult {
    pub innovations: Vec<Innovation>,
    pub least_squares: LeastSquares,
}

/// Generalized least squares of the systematic errors under given variances.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeastSquares {
    pub log_likelihood: f64,
    /// Information on all errors, XᵀV⁻¹X.
    pub information: ErrorMatrix,
    /// Estimates of the systematic errors β; 0 for those that are not estimated.
    pub errors: ErrorVector,
    /// Covariance of the estimate: the inverse of the information on the errors that are estimated.
    pub covariance: ErrorMatrix,
}

/// Log-likelihood with its derivatives with respect to the parameters.
#[derive(Clone, Debug)]
pub(super) struct Expansion {
    pub filtered: FilterResult,
    /// rᵀP Vⱼ P r and tr(P Vⱼ) for each parameter j. The score is half of their difference.
    pub quadratic: Parameters,
    pub trace: Parameters,
    pub information: Information,
    /// Score of each leg.
    pub scores: Vec<Parameters>,
}

impl Expansion {
    pub fn log_likelihood(&self) -> f64 {
        self.filtered.least_squares.log_likelihood
    }

    pub fn score(&self) -> Parameters {
        (self.quadratic - self.trace) * 0.5
    }
}

impl Term {
    pub fn new(model: Model, leg: &Leg, observation: &Observation, corrected: &Systematic) -> Self {
        let residuals = observation.residuals;
        let error_jacobian =
            observation.jacobian * corrected.motion_jacobian(model, leg, &observation.expected);
        // A leg with huge numbers is not used, because their squares would overflow.
        if residuals.iter().chain(&error_jacobian).any(|entry| entry.abs() > MAX_ENTRY) {
            let [start, end] = [Matrix3::zeros(); 2];
            return Self {
                columns: WideMatrix::ZERO,
                coefficients: [[0.0; 2]; 3],
                observed: [false; 3],
                start,
                end,
            };
        }
        let observed = residuals.map(|residual| !residual.is_nan());
        let columns = WideMatrix::from_fn(|k, column| match column {
            RESIDUAL_COLUMN if observed[k] => residuals[k],
            0..RESIDUAL_COLUMN => error_jacobian[(k, column)],
            _ => 0.0,
        });
        let [start, end] = corrected
            .reference_jacobians(leg)
            .map(|reference_jacobian| observation.jacobian * reference_jacobian);
        Self { columns, coefficients: observation.coefficients, observed, start, end }
    }
}

impl FilterResult {
    /// Returns the sandwich covariance of the systematic errors, C (Σ gᵦ gᵦᵀ) C. C is the covariance by the likelihood, and gᵦ the score of a
    /// block of `length` legs. The sandwich is right even if the legs of a block are correlated.
    pub fn sandwich(&self, length: usize) -> ErrorMatrix {
        let LeastSquares { errors, covariance, .. } = self.least_squares;
        let mut score_products = ErrorMatrix::zeros();
        for block in self.innovations.chunks(length) {
            let mut score = ErrorVector::zeros();
            for Innovation { columns, weight, .. } in block {
                let jacobian: SMatrix<f64, 3, ERROR_COUNT> = columns.block(0);
                score += jacobian.transpose() * (weight * residual_without_errors(columns, &errors));
            }
            score_products += score * score.transpose();
        }
        covariance * score_products * covariance
    }

    /// Returns the innovation of each leg, with its standard deviations under the fit.
    pub fn leg_fits(&self) -> impl Iterator<Item = LegFit> {
        self.innovations.iter().map(|innovation| innovation.leg_fit(&self.least_squares.errors, false))
    }
}

impl Innovation {
    /// Returns the innovation without the part that these systematic errors explain, with its standard deviations.
    pub fn leg_fit(&self, errors: &ErrorVector, is_outlier: bool) -> LegFit {
        let innovation = residual_without_errors(&self.columns, errors);
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
fn residual_without_errors(columns: &JacobianAndResidual, errors: &ErrorVector) -> Vector3<f64> {
    let mut residual = Vector3::zeros();
    for k in 0..3 {
        let row = columns.row(k);
        let mut explained_part = row[0] * errors[0];
        for error in 1..ERROR_COUNT {
            explained_part += row[error] * errors[error];
        }
        residual[k] = row[RESIDUAL_COLUMN] - explained_part;
    }
    residual
}

impl Residuals {
    pub fn new(
        model: Model,
        estimated: ErrorMask,
        terms: &Rc<Vec<Term>>,
        chosen: Vec<(usize, bool)>,
    ) -> Self {
        let observed = chosen.iter().flat_map(|(term, _)| terms[*term].observed);
        let count = observed.filter(|is_observed| *is_observed).count();
        Self { terms: Rc::clone(terms), chosen, count, model, estimated }
    }

    /// Number of legs.
    pub fn len(&self) -> usize {
        self.chosen.len()
    }

    /// Returns, for each leg, true if it starts at the reference pose at which the previous leg ends.
    pub fn follows(&self) -> impl Iterator<Item = bool> {
        self.chosen.iter().map(|(_, follows)| *follows)
    }

    fn terms(&self) -> impl DoubleEndedIterator<Item = (&Term, bool)> + ExactSizeIterator {
        self.chosen.iter().map(|(term, follows)| (&self.terms[*term], *follows))
    }

    /// Runs the forward recursion. Adds the innovation of each leg to `innovations`, if given.
    fn filter(&self, parameters: &Parameters, mut innovations: Option<&mut Vec<Innovation>>) -> LeastSquares {
        let reference_variances = reference_variances(parameters);
        let (mut log_det, mut gram) = (0.0, Gram::ZERO);
        let initial_state = (JacobianAndResidual::ZERO, Matrix3::from_diagonal(&reference_variances));
        let (mut mean, mut prior) = initial_state;
        // Determinants are multiplied, because one logarithm is cheaper than many.
        let mut det = 1.0;
        for (term, follows) in self.terms() {
            if !follows {
                (mean, prior) = initial_state;
            }
            let columns = term.columns.with_added(&mean.left_multiplied(&-term.start));
            let scaled_end = with_scaled_columns(&term.end, &reference_variances);
            let mut covariance = product(&product(&term.start, &prior), &term.start.transpose())
                + product(&scaled_end, &term.end.transpose());
            let wheels = self.model.wheel_variances(&term.coefficients, parameters);
            for k in 0..3 {
                covariance[(k, k)] += wheels[k] + if term.observed[k] { MIN_STD * MIN_STD } else { 1.0 };
            }
            let (weight, determinant) = inverse(&covariance);
            det *= determinant;
            if !(1e-200..1e200).contains(&det) {
                log_det += libm::log(det.max(f64::MIN_POSITIVE));
                det = 1.0;
            }
            let gain = product(&scaled_end.transpose(), &weight);
            gram.add_product(&columns, &columns.left_multiplied(&weight));
            mean = columns.left_multiplied(&gain);
            prior = Matrix3::from_diagonal(&reference_variances)
                - with_scaled_columns(&product(&gain, &term.end), &reference_variances);
            if let Some(innovations) = &mut innovations {
                let variance = |k: usize| if term.observed[k] { covariance[(k, k)] } else { f64::NAN };
                let variances = [variance(0), variance(1), variance(2)];
                innovations.push(Innovation { columns, variances, weight, gain });
            }
        }
        self.least_squares_of(log_det + libm::log(det.max(f64::MIN_POSITIVE)), &gram)
    }

    /// Returns the least-squares estimate from ln|V| and [X r]ᵀV⁻¹[X r].
    fn least_squares_of(&self, log_det: f64, gram: &Gram) -> LeastSquares {
        let information: ErrorMatrix = gram.block(0);
        let (covariance, log_det_information) = masked_inverse(&information, &self.estimated);
        let weighted_residual: ErrorVector = gram.block(RESIDUAL_COLUMN);
        let errors = covariance * weighted_residual;
        let degrees_of_freedom = self.count as f64 - self.estimated.iter().filter(|is| **is).count() as f64;
        let deviance = log_det + log_det_information + gram.row(RESIDUAL_COLUMN)[RESIDUAL_COLUMN]
            - weighted_residual.dot(&errors)
            + degrees_of_freedom * libm::log(TAU);
        LeastSquares { log_likelihood: -0.5 * deviance, information, errors, covariance }
    }

    pub fn least_squares(&self, parameters: &Parameters) -> LeastSquares {
        self.filter(parameters, None)
    }

    /// Returns the innovation of each leg, and the least-squares estimate of the systematic errors.
    pub fn filtered(&self, parameters: &Parameters) -> FilterResult {
        let mut innovations = Vec::with_capacity(self.chosen.len());
        let least_squares = self.filter(parameters, Some(&mut innovations));
        FilterResult { innovations, least_squares }
    }

    /// Returns the log-likelihood with its derivatives, from the innovations under the same parameters.
    pub fn expansion(&self, filtered: FilterResult) -> Expansion {
        let LeastSquares { errors, covariance, .. } = filtered.least_squares;
        // For a row x of V⁻¹X, a diagonal entry of P is smaller than that of V⁻¹ by x C xᵀ, because errors are estimated.
        let covariance_rows =
            WideMatrix::<ERROR_COUNT>::from_fn(|i, j| if j < ERROR_COUNT { covariance[(i, j)] } else { 0.0 });
        let alphas = self.model.component_alphas();
        let mut expansion = Expansion {
            filtered,
            quadratic: Parameters::zeros(),
            trace: Parameters::zeros(),
            information: Information::zeros(),
            scores: vec![Parameters::zeros(); self.len()],
        };
        // For each leg: P r, the weighted residuals, and their projections on the errors of the reference poses at start and end. A and B are
        // the Jacobians by the pose at the start and by that at the end. The projection at a pose is Bᵀ P r of the leg that ends there, plus
        // Aᵀ P r of the leg that starts there. It is stored with the leg that ends there, if there is one.
        let mut projected = vec![[Vector3::zeros(); 3]; self.len()];
        // V⁻¹[X r] of the next leg in the log, its block on the diagonal of V⁻¹, and its Jacobian A.
        let mut next_leg: Option<(JacobianAndResidual, Matrix3<f64>, Matrix3<f64>)> = None;
        let innovations = &expansion.filtered.innovations;
        for (i, ((term, follows), innovation)) in self.terms().zip(innovations).enumerate().rev() {
            let Innovation { columns, weight, gain, .. } = innovation;
            let (mut solved, mut block) = (columns.left_multiplied(weight), *weight);
            let (mut at_end, mut end_block) = (JacobianAndResidual::ZERO, Matrix3::zeros());
            if let Some((next, next_block, start)) = &next_leg {
                let carried_gain = product(start, gain);
                at_end = next.left_multiplied(&start.transpose());
                solved = solved.with_added(&at_end.left_multiplied(&-gain.transpose()));
                let off_diagonal = -product(next_block, &carried_gain);
                block -= product(&carried_gain.transpose(), &off_diagonal);
                let cross_block = product(&product(&start.transpose(), &off_diagonal), &term.end);
                let start_product = product(&product(&start.transpose(), next_block), start);
                end_block = start_product + cross_block + cross_block.transpose();
            }
            at_end = at_end.with_added(&solved.left_multiplied(&term.end.transpose()));
            end_block += product(&product(&term.end.transpose(), &block), &term.end);
            let leg_projection = residual_without_errors(&solved, &errors);
            let score = &mut expansion.scores[i];
            let mut add_to_score = |parameter: usize, factor: f64, square: f64, trace: f64| {
                expansion.quadratic[parameter] += factor * square;
                expansion.trace[parameter] += factor * trace;
                score[parameter] += 0.5 * factor * (square - trace);
            };
            for component in 0..3 {
                let trace =
                    block[(component, component)] - covariance_rows.quadratic_form(solved.row(component));
                for (alpha, factor) in alphas[component].into_iter().zip(term.coefficients[component]) {
                    add_to_score(alpha, factor, leg_projection[component] * leg_projection[component], trace);
                }
            }
            let mut add_reference_error = |solved: &JacobianAndResidual, block: &Matrix3<f64>| {
                let projection = residual_without_errors(solved, &errors);
                for row in 0..3 {
                    let trace = block[(row, row)] - covariance_rows.quadratic_form(solved.row(row));
                    add_to_score(REFERENCE_VARIANCES[row], 1.0, projection[row] * projection[row], trace);
                }
                projection
            };
            let end = add_reference_error(&at_end, &end_block);
            let start = if follows && i > 0 {
                Vector3::zeros()
            } else {
                let start_block = product(&product(&term.start.transpose(), &block), &term.start);
                add_reference_error(&solved.left_multiplied(&term.start.transpose()), &start_block)
            };
            projected[i] = [leg_projection, start, end];
            next_leg = (follows && i > 0).then_some((solved, block, term.start));
        }
        expansion.information = self.average_information(innovations, &projected, &covariance);
        expansion
    }

    /// Returns the average information ½ rᵀP Vⱼ P Vₖ P r for each pair of parameters j and k.
    fn average_information(
        &self,
        innovations: &[Innovation],
        projected: &[[Vector3<f64>; 3]],
        covariance: &ErrorMatrix,
    ) -> Information {
        let (mut gram, mut cross_products) =
            (WideMatrix::<PARAMETER_COUNT>::ZERO, WideMatrix::<ERROR_COUNT>::ZERO);
        let (mut mean, mut pose) = (WideMatrix::<3>::ZERO, Vector3::zeros());
        let alphas = self.model.component_alphas();
        for (((term, follows), innovation), [projected_noise, start, end]) in
            self.terms().zip(innovations).zip(projected)
        {
            if !follows {
                (mean, pose) = (WideMatrix::ZERO, *start);
            }
            let mut columns = WideMatrix::<3>::ZERO;
            for k in 0..3 {
                let row = columns.row_mut(k);
                for (alpha, factor) in alphas[k].into_iter().zip(term.coefficients[k]) {
                    row[alpha] += factor * projected_noise[k];
                }
                for (axis, variance) in REFERENCE_VARIANCES.into_iter().enumerate() {
                    row[variance] += term.start[(k, axis)] * pose[axis] + term.end[(k, axis)] * end[axis];
                }
            }
            columns = columns.with_added(&mean.left_multiplied(&-term.start));
            let weighted_columns = columns.left_multiplied(&innovation.weight);
            gram.add_product(&columns, &weighted_columns);
            cross_products.add_product(&innovation.columns, &weighted_columns);
            mean = columns.left_multiplied(&innovation.gain);
            pose = *end;
        }
        let gram: Information = gram.block(0);
        let cross_block: SMatrix<f64, ERROR_COUNT, PARAMETER_COUNT> = cross_products.block(0);
        (gram - cross_block.transpose() * covariance * cross_block) * 0.5
    }
}

/// Returns a matrix whose columns are multiplied by the numbers of a vector.
#[inline(always)]
fn with_scaled_columns(matrix: &Matrix3<f64>, factors: &Vector3<f64>) -> Matrix3<f64> {
    let mut scaled_matrix = *matrix;
    for column in 0..3 {
        for row in 0..3 {
            scaled_matrix[(row, column)] *= factors[column];
        }
    }
    scaled_matrix
}

/// Returns the variances of the reference's error: the diagonal of its covariance R.
pub(super) fn reference_variances(parameters: &Parameters) -> Vector3<f64> {
    REFERENCE_VARIANCES.map(|variance| parameters[variance]).into()
}

/// Returns the inverse of the submatrix that the mask selects, with 0 elsewhere, and the logarithm of its determinant.
fn masked_inverse(information: &ErrorMatrix, mask: &ErrorMask) -> (ErrorMatrix, f64) {
    let (mut inverse, mut log_det) = (*information, 0.0);
    for pivot in (0..ERROR_COUNT).filter(|pivot| mask[*pivot]) {
        log_det += libm::log(inverse[(pivot, pivot)].max(f64::MIN_POSITIVE));
        sweep(&mut inverse, pivot);
    }
    for i in 0..ERROR_COUNT {
        for j in 0..ERROR_COUNT {
            if !(mask[i] && mask[j]) {
                inverse[(i, j)] = 0.0;
            }
        }
    }
    (inverse, log_det)
}

/// Returns the mask of the systematic errors that are identifiable. Errors are added one after the other, the one with the smallest standard error
/// relative to its limit first. The search ends when each other error, estimated together with the added ones, would exceed its limit.
pub(super) fn identifiable_errors(information: &ErrorMatrix) -> ErrorMask {
    let (mut swept_information, mut chosen) = (*information, [false; ERROR_COUNT]);
    loop {
        let information_ratio_of = |error: usize| {
            let error_limit = SystematicError::ALL[error].identifiability_limit();
            swept_information[(error, error)] * error_limit * error_limit
        };
        let candidates = (0..ERROR_COUNT)
            .filter(|error| !chosen[*error])
            .map(|error| (error, information_ratio_of(error)));
        let Some((pivot, _)) = candidates
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .filter(|(_, information_ratio)| *information_ratio > 1.0)
        else {
            return chosen;
        };
        chosen[pivot] = true;
        sweep(&mut swept_information, pivot);
    }
}

/// Applies the sweep operator (a Gauss–Jordan step) to one variable of a symmetric matrix.
fn sweep(matrix: &mut ErrorMatrix, pivot: usize) {
    let pivot_value = matrix[(pivot, pivot)];
    let row = matrix.row(pivot) / pivot_value;
    for i in (0..ERROR_COUNT).filter(|i| *i != pivot) {
        let row_factor = matrix[(i, pivot)];
        for j in 0..ERROR_COUNT {
            matrix[(i, j)] -= row_factor * row[j];
        }
        matrix[(i, pivot)] = -row_factor / pivot_value;
    }
    matrix.set_row(pivot, &row);
    matrix[(pivot, pivot)] = 1.0 / pivot_value;
}
