//! Whether a reference errs less than it is stated to: then what the wheels err by is taken for its error.

use super::doubts::Judged;
use super::legs::FEWEST;
use super::likelihood::Alphas;
use super::model::{Model, Observation};
use super::systematic::inverted;

/// Residuals of which the squares are four fifths of what that error alone would make them: a deviation that is stated a tenth too large.
const SHARE: f64 = 0.8;

/// So many deviations of a mean: of three kinds one is beyond by chance in every two hundredth log of wheels that err by nothing.
const SURE: f64 = 3.0;

/// The variance of a normal error's square by its own.
const OF_SQUARES: f64 = 2.0;

/// By how much more the variance of a mean of such is: neighbours share the place where they meet.
const SHARED: f64 = 1.5;

/// Whether the residuals of some kind are smaller, in the mean, than the reference's stated error alone makes them.
pub(super) fn is_below_it(observations: &[Observation], judged: &[Judged]) -> bool {
    let is_smaller = |kind: usize| {
        let (mut count, mut sum) = (0.0, 0.0);
        for (observation, judged) in observations.iter().zip(judged) {
            let square = observation.residuals[kind] * observation.residuals[kind] / observation.floors[kind];
            if judged.bad <= 0.5 && square.is_finite() {
                count += 1.0;
                sum += square;
            }
        }
        let by_chance = SURE * (SHARED * OF_SQUARES / count).sqrt();
        count >= FEWEST as f64 && sum < count * SHARE.min(1.0 - by_chance)
    };
    (0..3).any(is_smaller)
}

/// Whether the fit would rather have less of the stated error in the variances of some kind: Rao's test of a factor of that part, the α's
/// being free. It tells an error that is stated too large where the wheels err by more.
///
/// With shares of a variance v, φ = floor/v of the error and u = αc/v of each α, and z² = r²/v: of the factor's logarithm the slope is
/// T = ½ Σ w(z² − 1), w = φ − Σ cᵢuᵢ being what is left of φ where the α's, of whose slopes the sum is 0, answer for what they can. It is
/// Σ ½wφ = P for each unit that the factor is off, with the variance P under the model, ¼ Σ w²(z² − 1)² whatever the noise.
pub(super) fn is_too_much_of_all(
    model: Model,
    observations: &[Observation],
    judged: &[Judged],
    alphas: &Alphas,
) -> bool {
    let alphas = model.kinds().map(|kind| kind.alphas.map(|alpha| (alpha, alphas[alpha])));
    let mut told = Vec::with_capacity(3 * observations.len());
    for (observation, judged) in observations.iter().zip(judged).filter(|(_, judged)| judged.bad <= 0.5) {
        let standardized = judged.standardized(observation);
        for (kind, alphas) in alphas.iter().enumerate() {
            let variance = judged.deviations[kind] * judged.deviations[kind];
            let mut shares = [0.0; 6];
            for ((alpha, value), coefficient) in alphas.iter().zip(observation.coefficients[kind]) {
                shares[*alpha] = value * coefficient / variance;
            }
            let errs = observation.floors[kind] / variance;
            let more = standardized[kind] * standardized[kind] - 1.0;
            if (more + errs).is_finite() {
                told.push(Told { kind, errs, shares, more });
            }
        }
    }
    let (mut information, mut of_error) = ([[0.0; 6]; 6], [[0.0; 6]; 3]);
    for Told { kind, errs, shares, .. } in &told {
        for (i, (share, row)) in shares.iter().zip(&mut information).enumerate() {
            of_error[*kind][i] += errs * share;
            row.iter_mut().zip(shares).for_each(|(entry, other)| *entry += share * other);
        }
    }
    let (known, inverse) = inverted(&information);
    (0..3).any(|of| {
        let mut answers = [0.0; 6];
        for i in (0..6).filter(|i| known[*i]) {
            for j in (0..6).filter(|j| known[*j]) {
                answers[i] += inverse[i][j] * of_error[of][j];
            }
        }
        let (mut slope, mut expected, mut variance, mut count) = (0.0, 0.0, 0.0, 0);
        for Told { kind, errs, shares, more } in &told {
            let errs = if *kind == of { *errs } else { 0.0 };
            let answered: f64 = shares.iter().zip(answers).map(|(share, answer)| share * answer).sum();
            let left = errs - answered;
            slope += 0.5 * left * more;
            expected += 0.5 * left * errs;
            variance += 0.25 * left * left * more * more;
            count += usize::from(errs > 0.0);
        }
        let by_chance = SURE * (SHARED * variance.max(expected)).sqrt();
        count >= FEWEST && slope < -by_chance && slope < (SHARE - 1.0) * expected
    })
}

/// A residual: φ, u of each α, and z² − 1.
struct Told {
    kind: usize,
    errs: f64,
    shares: [f64; 6],
    more: f64,
}
