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
use super::matrices::{Wide, inverse, product};
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

/// Columns that the recursion carries: the Jacobian of the residual by each systematic error, then the residual.
type Columns = Wide<3>;
const RESIDUAL: usize = ERROR_COUNT;
type Gram = Wide<{ RESIDUAL + 1 }>;
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
    /// Number of components of them that are observed.
    count: usize,
    model: Model,
    estimated: ErrorMask,
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

/// Innovations of all legs under given variances, with the least squares that follow from them.
#[derive(Clone, Debug)]
pub(super) struct Filtered {
    pub innovations: Vec<Innovation>,
    pub least_squares: LeastSquares,
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
    pub filtered: Filtered,
    /// rᵀP Vⱼ P r and tr(P Vⱼ) of each parameter; the score is half of their difference.
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
        let by_errors = observation.jacobian * corrected.motion_jacobian(model, leg, &observation.expected);
        // Squares of huge numbers would overflow: such a leg is not used.
        if residuals.iter().chain(&by_errors).any(|entry| entry.abs() > MAX_ENTRY) {
            let [start, end] = [Matrix3::zeros(); 2];
            return Self {
                columns: Wide::ZERO,
                coefficients: [[0.0; 2]; 3],
                observed: [false; 3],
                start,
                end,
            };
        }
        let observed = residuals.map(|residual| !residual.is_nan());
        let columns = Wide::from_fn(|k, column| match column {
            RESIDUAL if observed[k] => residuals[k],
            0..RESIDUAL => by_errors[(k, column)],
            _ => 0.0,
        });
        let [start, end] = corrected.reference_jacobians(leg).map(|by_error| observation.jacobian * by_error);
        Self { columns, coefficients: observation.coefficients, observed, start, end }
    }
}

impl Filtered {
    /// Returns the sandwich covariance of the systematic errors, C (Σ gᵦ gᵦᵀ) C. C is the covariance by the likelihood, and gᵦ the score of a
    /// block of `length` legs. The sandwich is right even if the legs of a block are correlated.
    pub fn sandwich(&self, length: usize) -> ErrorMatrix {
        let LeastSquares { errors, covariance, .. } = self.least_squares;
        let mut scatter = ErrorMatrix::zeros();
        for block in self.innovations.chunks(length) {
            let mut score = ErrorVector::zeros();
            for Innovation { columns, weight, .. } in block {
                let jacobian: SMatrix<f64, 3, ERROR_COUNT> = columns.block(0);
                score += jacobian.transpose() * (weight * unexplained(columns, &errors));
            }
            scatter += score * score.transpose();
        }
        covariance * scatter * covariance
    }

    /// Returns the error of each leg with its standard deviations, as the fit has them.
    pub fn leg_fits(&self) -> impl Iterator<Item = LegFit> {
        self.innovations.iter().map(|innovation| innovation.leg_fit(&self.least_squares.errors, false))
    }
}

impl Innovation {
    /// Returns the leg under the fit, with these systematic errors.
    pub fn leg_fit(&self, errors: &ErrorVector, is_outlier: bool) -> LegFit {
        let innovation = unexplained(&self.columns, errors);
        let stds = self.variances.map(f64::sqrt);
        LegFit {
            stds,
            standardized: std::array::from_fn(|k| innovation[k] / stds[k]),
            squared: innovation.dot(&(self.weight * innovation)),
            is_outlier,
        }
    }
}

/// Returns the residual less what these systematic errors explain.
#[inline(always)]
fn unexplained(columns: &Columns, errors: &ErrorVector) -> Vector3<f64> {
    let mut unexplained = Vector3::zeros();
    for k in 0..3 {
        let row = columns.row(k);
        let mut explained = row[0] * errors[0];
        for error in 1..ERROR_COUNT {
            explained += row[error] * errors[error];
        }
        unexplained[k] = row[RESIDUAL] - explained;
    }
    unexplained
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

    /// Tells of each leg whether it starts at the reference pose at which the leg before it ends.
    pub fn follows(&self) -> impl Iterator<Item = bool> {
        self.chosen.iter().map(|(_, follows)| *follows)
    }

    fn terms(&self) -> impl DoubleEndedIterator<Item = (&Term, bool)> + ExactSizeIterator {
        self.chosen.iter().map(|(term, follows)| (&self.terms[*term], *follows))
    }

    /// Runs the forward recursion, and adds the innovation of each leg to a list if there is one.
    fn filter(&self, parameters: &Parameters, mut innovations: Option<&mut Vec<Innovation>>) -> LeastSquares {
        let reference = reference_variances(parameters);
        let (mut log_det, mut gram) = (0.0, Gram::ZERO);
        let at_start = (Columns::ZERO, Matrix3::from_diagonal(&reference));
        let (mut mean, mut prior) = at_start;
        // A product is cheaper than as many logarithms.
        let mut det = 1.0;
        for (term, follows) in self.terms() {
            if !follows {
                (mean, prior) = at_start;
            }
            let columns = term.columns.plus(&mean.multiplied(&-term.start));
            let by_end = scaled(&term.end, &reference);
            let mut covariance = product(&product(&term.start, &prior), &term.start.transpose())
                + product(&by_end, &term.end.transpose());
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
            let gain = product(&by_end.transpose(), &weight);
            gram.add_product(&columns, &columns.multiplied(&weight));
            mean = columns.multiplied(&gain);
            prior = Matrix3::from_diagonal(&reference) - scaled(&product(&gain, &term.end), &reference);
            if let Some(all) = &mut innovations {
                let variance = |k: usize| if term.observed[k] { covariance[(k, k)] } else { f64::NAN };
                let variances = [variance(0), variance(1), variance(2)];
                all.push(Innovation { columns, variances, weight, gain });
            }
        }
        self.least_squares_of(log_det + libm::log(det.max(f64::MIN_POSITIVE)), &gram)
    }

    /// Returns the least squares by ln|V| and [X r]ᵀV⁻¹[X r].
    fn least_squares_of(&self, log_det: f64, gram: &Gram) -> LeastSquares {
        let information: ErrorMatrix = gram.block(0);
        let (covariance, log_det_information) = masked_inverse(&information, &self.estimated);
        let pull: ErrorVector = gram.block(RESIDUAL);
        let errors = covariance * pull;
        let free = self.count as f64 - self.estimated.iter().filter(|is| **is).count() as f64;
        let deviance = log_det + log_det_information + gram.row(RESIDUAL)[RESIDUAL] - pull.dot(&errors)
            + free * libm::log(TAU);
        LeastSquares { log_likelihood: -0.5 * deviance, information, errors, covariance }
    }

    pub fn least_squares(&self, parameters: &Parameters) -> LeastSquares {
        self.filter(parameters, None)
    }

    /// Returns the innovation of each leg, and the systematic errors that explain a part of them.
    pub fn filtered(&self, parameters: &Parameters) -> Filtered {
        let mut innovations = Vec::with_capacity(self.chosen.len());
        let least_squares = self.filter(parameters, Some(&mut innovations));
        Filtered { innovations, least_squares }
    }

    /// Returns the log-likelihood with its derivatives, from the innovations under the same parameters.
    pub fn expansion(&self, filtered: Filtered) -> Expansion {
        let LeastSquares { errors, covariance, .. } = filtered.least_squares;
        // With a row x of V⁻¹X, x C xᵀ is the part by which a diagonal entry of P is smaller than that of V⁻¹: errors are estimated.
        let estimated =
            Wide::<ERROR_COUNT>::from_fn(|i, j| if j < ERROR_COUNT { covariance[(i, j)] } else { 0.0 });
        let alphas = self.model.component_alphas();
        let mut expansion = Expansion {
            filtered,
            quadratic: Parameters::zeros(),
            trace: Parameters::zeros(),
            information: Information::zeros(),
            scores: vec![Parameters::zeros(); self.len()],
        };
        // P r of each leg, and Bᵀ P r of the leg before plus Aᵀ P r of the leg after the reference poses at its start and end.
        // The start is 0 if another leg ends there, because that leg has the pose already.
        let mut projected = vec![[Vector3::zeros(); 3]; self.len()];
        // V⁻¹[X r] of the leg after, its block on the diagonal of V⁻¹, and A of it.
        let mut after: Option<(Columns, Matrix3<f64>, Matrix3<f64>)> = None;
        let innovations = &expansion.filtered.innovations;
        for (i, ((term, follows), innovation)) in self.terms().zip(innovations).enumerate().rev() {
            let Innovation { columns, weight, gain, .. } = innovation;
            let (mut solved, mut block) = (columns.multiplied(weight), *weight);
            let (mut at_end, mut end_block) = (Columns::ZERO, Matrix3::zeros());
            if let Some((next, next_block, start)) = &after {
                let through = product(start, gain);
                at_end = next.multiplied(&start.transpose());
                solved = solved.plus(&at_end.multiplied(&-gain.transpose()));
                let off_diagonal = -product(next_block, &through);
                block -= product(&through.transpose(), &off_diagonal);
                let cross = product(&product(&start.transpose(), &off_diagonal), &term.end);
                let of_start = product(&product(&start.transpose(), next_block), start);
                end_block = of_start + cross + cross.transpose();
            }
            at_end = at_end.plus(&solved.multiplied(&term.end.transpose()));
            end_block += product(&product(&term.end.transpose(), &block), &term.end);
            let own = unexplained(&solved, &errors);
            let score = &mut expansion.scores[i];
            let mut add = |parameter: usize, factor: f64, square: f64, trace: f64| {
                expansion.quadratic[parameter] += factor * square;
                expansion.trace[parameter] += factor * trace;
                score[parameter] += 0.5 * factor * (square - trace);
            };
            for component in 0..3 {
                let trace = block[(component, component)] - estimated.quadratic_form(solved.row(component));
                for (alpha, factor) in alphas[component].into_iter().zip(term.coefficients[component]) {
                    add(alpha, factor, own[component] * own[component], trace);
                }
            }
            let mut add_pose = |solved: &Columns, block: &Matrix3<f64>| {
                let projected = unexplained(solved, &errors);
                for row in 0..3 {
                    let trace = block[(row, row)] - estimated.quadratic_form(solved.row(row));
                    add(REFERENCE_VARIANCES[row], 1.0, projected[row] * projected[row], trace);
                }
                projected
            };
            let end = add_pose(&at_end, &end_block);
            let start = if follows && i > 0 {
                Vector3::zeros()
            } else {
                let start_block = product(&product(&term.start.transpose(), &block), &term.start);
                add_pose(&solved.multiplied(&term.start.transpose()), &start_block)
            };
            projected[i] = [own, start, end];
            after = (follows && i > 0).then_some((solved, block, term.start));
        }
        expansion.information = self.average_information(innovations, &projected, &covariance);
        expansion
    }

    /// Returns the average information of each two parameters j and k, ½ rᵀP Vⱼ P Vₖ P r.
    fn average_information(
        &self,
        innovations: &[Innovation],
        projected: &[[Vector3<f64>; 3]],
        covariance: &ErrorMatrix,
    ) -> Information {
        let (mut gram, mut cross) = (Wide::<PARAMETER_COUNT>::ZERO, Wide::<ERROR_COUNT>::ZERO);
        let (mut mean, mut pose) = (Wide::<3>::ZERO, Vector3::zeros());
        let alphas = self.model.component_alphas();
        for (((term, follows), innovation), [own, start, end]) in self.terms().zip(innovations).zip(projected)
        {
            if !follows {
                (mean, pose) = (Wide::ZERO, *start);
            }
            let mut working = Wide::<3>::ZERO;
            for k in 0..3 {
                let row = working.row_mut(k);
                for (alpha, factor) in alphas[k].into_iter().zip(term.coefficients[k]) {
                    row[alpha] += factor * own[k];
                }
                for (by, variance) in REFERENCE_VARIANCES.into_iter().enumerate() {
                    row[variance] += term.start[(k, by)] * pose[by] + term.end[(k, by)] * end[by];
                }
            }
            working = working.plus(&mean.multiplied(&-term.start));
            let weighted = working.multiplied(&innovation.weight);
            gram.add_product(&working, &weighted);
            cross.add_product(&innovation.columns, &weighted);
            mean = working.multiplied(&innovation.gain);
            pose = *end;
        }
        let gram: Information = gram.block(0);
        let cross: SMatrix<f64, ERROR_COUNT, PARAMETER_COUNT> = cross.block(0);
        (gram - cross.transpose() * covariance * cross) * 0.5
    }
}

/// Multiplies the columns of a matrix by the numbers of a vector.
#[inline(always)]
fn scaled(matrix: &Matrix3<f64>, by: &Vector3<f64>) -> Matrix3<f64> {
    let mut scaled = *matrix;
    for column in 0..3 {
        for row in 0..3 {
            scaled[(row, column)] *= by[column];
        }
    }
    scaled
}

/// Returns the variances of the reference's error: the diagonal of its covariance R.
pub(super) fn reference_variances(parameters: &Parameters) -> Vector3<f64> {
    REFERENCE_VARIANCES.map(|variance| parameters[variance]).into()
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
