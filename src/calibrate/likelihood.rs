//! Restricted likelihood (REML) of all residuals of a log.
//!
//! The residual of leg i is rᵢ = wᵢ + Aᵢ eᵢ₋₁ + Bᵢ eᵢ + Xᵢ β, with
//! - wᵢ the noise of the wheels, of covariance Dᵢ = diag(Σ αₖ cᵢₖ),
//! - eᵢ the error of the reference at the end of the leg, of covariance R = diag(σ_p², σ_p², σ_θ²),
//! - β the systematic errors.
//!
//! A pose ends one leg and starts the next. So V = Cov(r) is block tridiagonal:
//!
//! ℓ = −½ [ln|V| + ln|XᵀV⁻¹X| + rᵀV⁻¹r − rᵀV⁻¹X (XᵀV⁻¹X)⁻¹ XᵀV⁻¹r − (N − q) ln 2π],
//!
//! with N residuals and q errors. One forward recursion over 3 × 3 blocks gives it (a Kalman filter whose state is eᵢ), a backward one the
//! score. V is linear in the parameters, so that the average of observed and expected information is a product of vectors (Gilmour,
//! Thompson and Cullis 1995).

use super::legs::Leg;
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

/// Columns that the recursion carries: the residual and the Jacobian of each systematic error.
const COLUMN_COUNT: usize = 1 + ERROR_COUNT;
type Columns = SMatrix<f64, 3, COLUMN_COUNT>;
type Gram = SMatrix<f64, COLUMN_COUNT, COLUMN_COUNT>;
pub(super) type ErrorMatrix = SMatrix<f64, ERROR_COUNT, ERROR_COUNT>;
type ErrorVector = SVector<f64, ERROR_COUNT>;

/// Least standard deviation of a residual (rad, m or their rates). With it, a log without noise has a finite likelihood.
const MIN_STD: f64 = 1e-7;

/// Largest absolute value of residuals and their derivatives. Legs with larger ones are not used.
const MAX_ENTRY: f64 = 1e30;

/// Residuals of one leg as the likelihood sees them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Term {
    columns: Columns,
    /// Factors of the α's in the variance of each component.
    coefficients: [[f64; 2]; 3],
    /// False for a component without a residual. Its residual is 0 here, and its variance 1.
    observed: [bool; 3],
    /// Jacobians by the reference's errors at the start and at the end of the leg.
    start: Matrix3<f64>,
    end: Matrix3<f64>,
}

/// Residuals of several legs, with the model and the systematic errors that are estimated with them.
#[derive(Clone, Debug)]
pub(super) struct Residuals {
    terms: Rc<Vec<Term>>,
    /// Indices of the terms that are used. Each has true if its leg starts at the reference pose at which the leg before it ends.
    chosen: Vec<(usize, bool)>,
    model: Model,
    pub estimated: ErrorMask,
}

/// Innovation of one leg: its residual, and the Jacobians of it, less what the legs before predict.
#[derive(Clone, Copy, Debug)]
pub(super) struct Innovation {
    columns: Columns,
    /// Variance of each component; NaN of one that is not observed.
    variances: [f64; 3],
    /// Inverse covariance.
    weight: Matrix3<f64>,
    /// Kalman gain of the reference's error at the end of the leg.
    gain: Matrix3<f64>,
}

/// Generalized least squares of the systematic errors under given variances.
#[derive(Clone, Copy, Debug)]
pub(super) struct LeastSquares {
    pub log_likelihood: f64,
    /// Information on all errors, XᵀV⁻¹X.
    pub information: ErrorMatrix,
    /// Estimate of β; 0 of errors that are not estimated.
    pub errors: ErrorVector,
    /// Covariance of the estimate: the inverse of the information on the errors that are estimated.
    pub covariance: ErrorMatrix,
}

/// Log-likelihood with its derivatives by the parameters.
#[derive(Clone, Debug)]
pub(super) struct Expansion {
    pub least_squares: LeastSquares,
    /// rᵀP Vⱼ P r and tr(P Vⱼ) of each parameter; the score is half of their difference.
    pub quadratic: Parameters,
    pub trace: Parameters,
    pub information: Information,
    /// Score of each leg.
    pub scores: Vec<Parameters>,
}

impl Expansion {
    pub fn score(&self) -> Parameters {
        (self.quadratic - self.trace) * 0.5
    }
}

impl Term {
    pub fn new(model: Model, leg: &Leg, observation: &Observation, corrected: &Systematic) -> Self {
        let residuals = Vector3::from(observation.residuals);
        let by_errors = observation.jacobian * corrected.motion_jacobian(model, leg, &observation.expected);
        // Squares of huge numbers would overflow: such a leg is not used.
        let is_sane = !residuals.iter().chain(&by_errors).any(|entry| entry.abs() > MAX_ENTRY);
        let observed = residuals.map(|residual| is_sane && !residual.is_nan());
        let mut columns = Columns::zeros();
        let [mut start, mut end] =
            corrected.reference_jacobians(leg).map(|by_error| observation.jacobian * by_error);
        if is_sane {
            columns.set_column(0, &residuals.map(|residual| if residual.is_nan() { 0.0 } else { residual }));
            columns.fixed_columns_mut::<ERROR_COUNT>(1).copy_from(&by_errors);
        } else {
            [start, end] = [Matrix3::zeros(); 2];
        }
        Self {
            columns,
            coefficients: if is_sane { observation.coefficients } else { [[0.0; 2]; 3] },
            observed: observed.into(),
            start,
            end,
        }
    }
}

impl Innovation {
    /// Returns the innovation of the residual, less what these systematic errors explain.
    fn unexplained(&self, errors: &ErrorVector) -> Vector3<f64> {
        self.columns.column(0) - self.columns.fixed_columns::<ERROR_COUNT>(1) * errors
    }

    /// Returns the leg under the fit, with these systematic errors.
    pub fn leg_fit(&self, errors: &ErrorVector, is_outlier: bool) -> LegFit {
        let innovation = self.unexplained(errors);
        let stds = self.variances.map(f64::sqrt);
        LegFit {
            stds,
            standardized: std::array::from_fn(|k| innovation[k] / stds[k]),
            squared: innovation.dot(&(self.weight * innovation)),
            is_outlier,
        }
    }
}

impl Residuals {
    pub fn new(
        model: Model,
        estimated: ErrorMask,
        terms: &Rc<Vec<Term>>,
        chosen: Vec<(usize, bool)>,
    ) -> Self {
        Self { terms: Rc::clone(terms), chosen, model, estimated }
    }

    /// Number of legs.
    pub fn len(&self) -> usize {
        self.chosen.len()
    }

    fn terms(&self) -> impl DoubleEndedIterator<Item = (&Term, bool)> + ExactSizeIterator {
        self.chosen.iter().map(|(term, follows)| (&self.terms[*term], *follows))
    }

    /// Runs the forward recursion, and adds the innovation of each leg to a list if there is one.
    fn filter(&self, parameters: &Parameters, mut innovations: Option<&mut Vec<Innovation>>) -> LeastSquares {
        let reference = reference_covariance(parameters);
        let (mut log_det, mut gram) = (0.0, Gram::zeros());
        let (mut mean, mut prior) = (Columns::zeros(), reference);
        // A product is cheaper than as many logarithms.
        let mut det = 1.0;
        for (term, follows) in self.terms() {
            if !follows {
                (mean, prior) = (Columns::zeros(), reference);
            }
            let columns = term.columns - term.start * mean;
            let mut covariance =
                term.start * prior * term.start.transpose() + term.end * reference * term.end.transpose();
            let wheels = self.model.wheel_variances(&term.coefficients, parameters);
            for (component, is_observed) in term.observed.into_iter().enumerate() {
                let floor = if is_observed { MIN_STD * MIN_STD } else { 1.0 };
                covariance[(component, component)] += wheels[component] + floor;
            }
            let weight = covariance.try_inverse().unwrap_or_else(Matrix3::zeros);
            det *= covariance.determinant();
            if !(1e-200..1e200).contains(&det) {
                log_det += libm::log(det.max(f64::MIN_POSITIVE));
                det = 1.0;
            }
            let gain = reference * term.end.transpose() * weight;
            gram += columns.transpose() * (weight * columns);
            mean = gain * columns;
            prior = reference - gain * term.end * reference;
            if let Some(all) = &mut innovations {
                let variance = |k: usize| if term.observed[k] { covariance[(k, k)] } else { f64::NAN };
                all.push(Innovation { columns, variances: std::array::from_fn(variance), weight, gain });
            }
        }
        self.least_squares_of(log_det + libm::log(det.max(f64::MIN_POSITIVE)), &gram)
    }

    /// Returns the least squares by ln|V| and [r X]ᵀV⁻¹[r X].
    fn least_squares_of(&self, log_det: f64, gram: &Gram) -> LeastSquares {
        let information: ErrorMatrix = gram.fixed_view::<ERROR_COUNT, ERROR_COUNT>(1, 1).into_owned();
        let (covariance, log_det_information) = masked_inverse(&information, &self.estimated);
        let pull: ErrorVector = gram.fixed_view::<ERROR_COUNT, 1>(1, 0).into_owned();
        let errors = covariance * pull;
        let count =
            self.terms().flat_map(|(term, _)| term.observed).filter(|is_observed| *is_observed).count();
        let free = count as f64 - self.estimated.iter().filter(|is| **is).count() as f64;
        let deviance =
            log_det + log_det_information + gram[(0, 0)] - pull.dot(&errors) + free * libm::log(TAU);
        LeastSquares { log_likelihood: -0.5 * deviance, information, errors, covariance }
    }

    pub fn least_squares(&self, parameters: &Parameters) -> LeastSquares {
        self.filter(parameters, None)
    }

    /// Returns the innovation of each leg, and the systematic errors that explain a part of them.
    pub fn innovations(&self, parameters: &Parameters) -> (Vec<Innovation>, LeastSquares) {
        let mut innovations = Vec::with_capacity(self.chosen.len());
        let least_squares = self.filter(parameters, Some(&mut innovations));
        (innovations, least_squares)
    }

    /// Returns the sandwich covariance of the systematic errors, C (Σ gᵦ gᵦᵀ) C. C is the covariance by the likelihood, and gᵦ the score of a
    /// block of `length` legs. The sandwich is right even if the legs of a block are correlated.
    pub fn sandwich(&self, parameters: &Parameters, length: usize) -> ErrorMatrix {
        let (innovations, LeastSquares { errors, covariance, .. }) = self.innovations(parameters);
        let mut scatter = ErrorMatrix::zeros();
        for block in innovations.chunks(length) {
            let mut score = ErrorVector::zeros();
            for innovation in block {
                let jacobian = innovation.columns.fixed_columns::<ERROR_COUNT>(1);
                score += jacobian.transpose() * (innovation.weight * innovation.unexplained(&errors));
            }
            scatter += score * score.transpose();
        }
        covariance * scatter * covariance
    }

    /// Returns the log-likelihood with its derivatives.
    pub fn expansion(&self, parameters: &Parameters) -> Expansion {
        let (innovations, least_squares) = self.innovations(parameters);
        let LeastSquares { errors, covariance, .. } = least_squares;
        let alphas = self.model.component_alphas();
        let mut expansion = Expansion {
            least_squares,
            quadratic: Parameters::zeros(),
            trace: Parameters::zeros(),
            information: Information::zeros(),
            scores: vec![Parameters::zeros(); self.len()],
        };
        // P r of each leg, and Bᵀ P r of the leg before plus Aᵀ P r of the leg after the reference poses at its start and end.
        // The start is 0 if another leg ends there, because that leg has the pose already.
        let mut projected = vec![[Vector3::zeros(); 3]; self.len()];
        let project = |solved: &Columns| solved.column(0) - solved.fixed_columns::<ERROR_COUNT>(1) * errors;
        // Part by which a diagonal entry of P is smaller than that of V⁻¹, because systematic errors are estimated.
        let known = |solved: &Columns, row: usize| {
            let row = solved.fixed_view::<1, ERROR_COUNT>(row, 1);
            (row * covariance).dot(&row)
        };
        // V⁻¹[r X] of the leg after, and its block on the diagonal of V⁻¹.
        let mut after: Option<(Columns, Matrix3<f64>)> = None;
        for (i, ((term, follows), Innovation { columns, weight, gain, .. })) in
            self.terms().zip(&innovations).enumerate().rev()
        {
            let (mut solved, mut block) = (weight * columns, *weight);
            let (mut at_end, mut end_block) = (Columns::zeros(), Matrix3::zeros());
            if let Some((next, next_block)) = after {
                let start = self.terms[self.chosen[i + 1].0].start;
                let through = start * gain;
                at_end = start.transpose() * next;
                solved -= gain.transpose() * at_end;
                let off_diagonal = -next_block * through;
                block -= through.transpose() * off_diagonal;
                let cross = start.transpose() * off_diagonal * term.end;
                end_block = start.transpose() * next_block * start + cross + cross.transpose();
            }
            at_end += term.end.transpose() * solved;
            end_block += term.end.transpose() * block * term.end;
            let own = project(&solved);
            let score = &mut expansion.scores[i];
            let mut add = |parameter: usize, factor: f64, square: f64, trace: f64| {
                expansion.quadratic[parameter] += factor * square;
                expansion.trace[parameter] += factor * trace;
                score[parameter] += 0.5 * factor * (square - trace);
            };
            for component in 0..3 {
                let trace = block[(component, component)] - known(&solved, component);
                for (alpha, factor) in alphas[component].into_iter().zip(term.coefficients[component]) {
                    add(alpha, factor, own[component] * own[component], trace);
                }
            }
            let mut add_pose = |solved: &Columns, block: &Matrix3<f64>| {
                let projected = project(solved);
                for row in 0..3 {
                    let trace = block[(row, row)] - known(solved, row);
                    add(REFERENCE_VARIANCES[row], 1.0, projected[row] * projected[row], trace);
                }
                projected
            };
            let end = add_pose(&at_end, &end_block);
            let start = if follows && i > 0 {
                Vector3::zeros()
            } else {
                add_pose(&(term.start.transpose() * solved), &(term.start.transpose() * block * term.start))
            };
            projected[i] = [own, start, end];
            after = (follows && i > 0).then_some((solved, block));
        }
        expansion.information = self.average_information(&innovations, &projected, &covariance);
        expansion
    }

    /// Returns the average information of each two parameters j and k, ½ rᵀP Vⱼ P Vₖ P r.
    fn average_information(
        &self,
        innovations: &[Innovation],
        projected: &[[Vector3<f64>; 3]],
        covariance: &ErrorMatrix,
    ) -> Information {
        type Working = SMatrix<f64, 3, PARAMETER_COUNT>;
        let (mut gram, mut cross) =
            (Information::zeros(), SMatrix::<f64, ERROR_COUNT, PARAMETER_COUNT>::zeros());
        let (mut mean, mut pose) = (Working::zeros(), Vector3::zeros());
        let alphas = self.model.component_alphas();
        for (((term, follows), innovation), [own, start, end]) in self.terms().zip(innovations).zip(projected)
        {
            if !follows {
                (mean, pose) = (Working::zeros(), *start);
            }
            let mut working = Working::zeros();
            for component in 0..3 {
                for (alpha, factor) in alphas[component].into_iter().zip(term.coefficients[component]) {
                    working[(component, alpha)] += factor * own[component];
                }
            }
            for row in 0..3 {
                let moved = term.start.column(row) * pose[row] + term.end.column(row) * end[row];
                let mut column = working.column_mut(REFERENCE_VARIANCES[row]);
                column += moved;
            }
            working -= term.start * mean;
            let weighted = innovation.weight * working;
            gram += working.transpose() * weighted;
            cross += innovation.columns.fixed_columns::<ERROR_COUNT>(1).transpose() * weighted;
            mean = innovation.gain * working;
            pose = *end;
        }
        (gram - cross.transpose() * covariance * cross) * 0.5
    }
}

/// Returns the covariance R of the reference's error.
pub(super) fn reference_covariance(parameters: &Parameters) -> Matrix3<f64> {
    Matrix3::from_diagonal(&REFERENCE_VARIANCES.map(|variance| parameters[variance]).into())
}

/// Returns the inverse of the rows and columns in the mask, 0 elsewhere, and the logarithm of their determinant.
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

/// Returns the systematic errors that are identifiable. They are chosen one after the other, the one with the smallest standard error
/// first. The choice ends when all other errors, estimated together with the chosen ones, have too large a standard error.
pub(super) fn identifiable_errors(information: &ErrorMatrix) -> ErrorMask {
    let (mut swept, mut chosen) = (*information, [false; ERROR_COUNT]);
    loop {
        let known = |error: usize| {
            let limit = SystematicError::ALL[error].identifiability_limit();
            swept[(error, error)] * limit * limit
        };
        let next = (0..ERROR_COUNT).filter(|error| !chosen[*error]).map(|error| (error, known(error)));
        let Some((pivot, _)) = next.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, known)| *known > 1.0)
        else {
            return chosen;
        };
        chosen[pivot] = true;
        sweep(&mut swept, pivot);
    }
}

/// Sweeps a symmetric matrix by one of its variables (Gauss and Jordan).
fn sweep(matrix: &mut ErrorMatrix, pivot: usize) {
    let scale = matrix[(pivot, pivot)];
    let row = matrix.row(pivot) / scale;
    for i in (0..ERROR_COUNT).filter(|i| *i != pivot) {
        let factor = matrix[(i, pivot)];
        for j in 0..ERROR_COUNT {
            matrix[(i, j)] -= factor * row[j];
        }
        matrix[(i, pivot)] = -factor / scale;
    }
    matrix.set_row(pivot, &row);
    matrix[(pivot, pivot)] = 1.0 / scale;
}
