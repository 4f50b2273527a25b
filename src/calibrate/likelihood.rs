//! The likelihood of variances that are sums, v = c + Σ αₖ fₖ, each α 0 or more; and where it is largest.

use super::density::{Density, LogProduct};
use super::model::{Model, Observation};
use super::trajectory::sort;
use crate::noise::NoiseKind;

/// What the α's are at a point: of as many as there may be, six.
pub(super) type Alphas = [f64; 6];

/// Whether some legs are bad, as where a reference jumps: off by more than any motion explains.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Robust {
    /// None is.
    #[default]
    No,
    /// This share of them is, 0 < share < 1.
    Stated(f64),
    /// As many as makes the log likeliest.
    Estimated,
}

/// A leg's part of the likelihood.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Of the residuals; 0 of one that is not told.
    squares: [f64; 3],
    coefficients: [[f64; 2]; 3],
    /// 1 of a residual that is not told, of which nothing then depends.
    floors: [f64; 3],
    told: [bool; 3],
    /// Its place among the squares by the other way; none where it is past their end.
    other_way: u32,
}

/// What all legs say.
#[derive(Clone, Debug)]
pub struct Evidence {
    pairs: [[usize; 2]; 3],
    noise: NoiseKind,
    rows: Vec<Row>,
    other_ways: Vec<[f64; 3]>,
}

impl Evidence {
    pub fn new<'a>(
        model: Model,
        noise: NoiseKind,
        observations: impl IntoIterator<Item = &'a Observation>,
    ) -> Self {
        let mut evidence = Self {
            pairs: model.kinds().map(|kind| kind.alphas),
            noise,
            rows: Vec::new(),
            other_ways: Vec::new(),
        };
        observations.into_iter().for_each(|each| evidence.add(each));
        evidence
    }

    /// A residual that nothing would make uncertain is not told: its variance is 0 under all α's.
    fn add(&mut self, observation: &Observation) {
        let Observation { residuals, coefficients, floors, other_way, .. } = observation;
        let told: [bool; 3] = std::array::from_fn(|k| {
            residuals[k].is_finite() && (coefficients[k] != [0.0; 2] || floors[k] > 0.0)
        });
        let square = |residuals: &[f64; 3]| {
            std::array::from_fn(|k| if told[k] { residuals[k] * residuals[k] } else { 0.0 })
        };
        self.rows.push(Row {
            squares: square(residuals),
            coefficients: std::array::from_fn(|k| if told[k] { coefficients[k] } else { [0.0; 2] }),
            floors: std::array::from_fn(|k| if told[k] { floors[k] } else { 1.0 }),
            told,
            other_way: if other_way.is_some() { self.other_ways.len() as u32 } else { u32::MAX },
        });
        self.other_ways.extend(other_way.as_ref().map(square));
    }

    fn residuals_told(&self) -> usize {
        self.rows.iter().map(|row| row.told.iter().filter(|told| **told).count()).sum()
    }

    /// Where to begin: of each kind its two α's answer for half of what is there, without the hundredths that are far from the
    /// rest.
    pub(super) fn beginning(&self, robust: Robust) -> Parameters {
        let mut alphas = [0.0f64; 6];
        let mut spreads = [1.0; 3];
        for (kind, pair) in self.pairs.iter().enumerate() {
            let told = || self.rows.iter().filter(|row| row.told[kind]);
            let mut squares: Vec<f64> = told().map(|row| row.squares[kind]).collect();
            if squares.is_empty() {
                continue;
            }
            sort(&mut squares);
            let most = squares[squares.len() / 2] * FAR;
            let sum: f64 = told()
                .map(|row| if robust == Robust::No { row.squares[kind] } else { row.squares[kind].min(most) })
                .sum();
            for (i, k) in pair.iter().enumerate() {
                let coefficients: f64 = told().map(|row| row.coefficients[kind][i]).sum();
                if coefficients > 0.0 {
                    // Of perfect ones too something: the scoring goes down from there.
                    alphas[*k] = alphas[*k].max((0.5 * sum / coefficients).max(1e-12));
                }
            }
            spreads[kind] = (most.max(sum / squares.len() as f64)).max(1e-12);
        }
        // No residual may be outside of its triangle.
        if self.noise == NoiseKind::Triangular && robust == Robust::No {
            let largest = self.rows.iter().flat_map(|row| {
                let variances = self.variances(row, &alphas);
                (0..3).map(move |k| row.squares[k] / (6.0 * variances[k]))
            });
            let widen = largest.fold(0.0, f64::max);
            if widen >= 0.9 {
                alphas = alphas.map(|alpha| alpha * widen / 0.8);
            }
        }
        let bad = match robust {
            Robust::No => None,
            Robust::Stated(share) => Some(Bad { share, spreads }),
            Robust::Estimated => Some(Bad { share: 0.02, spreads }),
        };
        Parameters { alphas, bad }
    }

    #[inline(always)]
    fn variances(&self, row: &Row, alphas: &Alphas) -> [f64; 3] {
        std::array::from_fn(|kind| {
            let [first, second] = self.pairs[kind];
            let [f, g] = row.coefficients[kind];
            row.floors[kind] + alphas[first] * f + alphas[second] * g
        })
    }

    /// The density of a row, and the probability that it is bad.
    #[inline(always)]
    fn density(&self, row: &Row, variances: &[f64; 3], bad: Option<&Bad>) -> (Density, f64) {
        let mut density = Density::of(self.noise, &row.squares, variances);
        if let Some(squares) = self.other_ways.get(row.other_way as usize) {
            density = density.or(&Density::of(self.noise, squares, variances)).0;
        }
        let Some(Bad { share, spreads }) = bad else { return (density, 0.0) };
        let wider: [f64; 3] =
            std::array::from_fn(|k| if row.told[k] { variances[k] + spreads[k] } else { variances[k] });
        let far = Density::normal(&row.squares, &wider);
        let powers = if self.noise == NoiseKind::Triangular {
            row.told.iter().filter(|told| **told).map(|_| 1.0 / ROOT_TAU).product()
        } else {
            1.0
        };
        density.times(1.0 - share).or(&far.times(share * powers))
    }

    /// The logarithm of the likelihood (nats), its derivatives, and what Fisher expects of the second ones.
    pub(super) fn slope(&self, at: &Parameters) -> Slope {
        let mut logs = LogProduct::EMPTY;
        let (mut exponents, mut gradients, mut informations) = (0.0, [[0.0; 2]; 3], [[0.0; 3]; 3]);
        for row in &self.rows {
            let variances = self.variances(row, &at.alphas);
            let (density, _) = self.density(row, &variances, at.bad.as_ref());
            logs.multiply(density.factor);
            exponents += density.exponent;
            for kind in 0..3 {
                let [f, g] = row.coefficients[kind];
                let (slope, information) = (density.by_variance[kind], density.information[kind]);
                gradients[kind][0] += f * slope;
                gradients[kind][1] += g * slope;
                informations[kind][0] += f * f * information;
                informations[kind][1] += f * g * information;
                informations[kind][2] += g * g * information;
            }
        }
        let constant = match self.noise {
            NoiseKind::Normal => libm::log(ROOT_TAU) * self.residuals_told() as f64,
            NoiseKind::Triangular => 0.0,
        };
        let total = logs.log() + exponents - constant;
        // With a variance of 0 the logarithm is infinite, and so is the share, or none.
        let log_likelihood = if total.is_finite() { total } else { f64::NEG_INFINITY };
        let mut slope = Slope { log_likelihood, gradient: [0.0; 6], information: [[0.0; 6]; 6] };
        for (kind, [first, second]) in self.pairs.into_iter().enumerate() {
            slope.gradient[first] += gradients[kind][0];
            slope.gradient[second] += gradients[kind][1];
            let [ff, fg, gg] = informations[kind];
            slope.information[first][first] += ff;
            slope.information[first][second] += fg;
            slope.information[second][first] += fg;
            slope.information[second][second] += gg;
        }
        slope
    }

    /// Of every leg: its variances, the probability that it is bad, and the derivatives of its logarithm by the α's.
    pub(super) fn each(&self, at: &Parameters) -> impl Iterator<Item = LegDensity> {
        self.rows.iter().map(move |row| {
            let variances = self.variances(row, &at.alphas);
            let (density, bad) = self.density(row, &variances, at.bad.as_ref());
            let mut gradient = [0.0; 6];
            for (kind, [first, second]) in self.pairs.into_iter().enumerate() {
                gradient[first] += row.coefficients[kind][0] * density.by_variance[kind];
                gradient[second] += row.coefficients[kind][1] * density.by_variance[kind];
            }
            LegDensity {
                variances: std::array::from_fn(|k| row.told[k].then_some(variances[k])),
                bad,
                gradient,
            }
        })
    }

    /// By how much the logarithms of the residuals' variances change with each α: in the mean, and Σ of the squares and products.
    pub(super) fn log_variances_by(&self, at: &Parameters) -> (Alphas, [Alphas; 6]) {
        let (mut count, mut mean, mut squares) = (0.0, [0.0; 6], [[0.0; 6]; 6]);
        for row in &self.rows {
            let variances = self.variances(row, &at.alphas);
            for kind in (0..3).filter(|kind| row.told[*kind] && variances[*kind] > 0.0) {
                let (pair, slopes) = (self.pairs[kind], row.coefficients[kind].map(|f| f / variances[kind]));
                count += 1.0;
                for (k, slope) in pair.into_iter().zip(slopes) {
                    mean[k] += slope;
                    pair.into_iter().zip(slopes).for_each(|(l, other)| squares[k][l] += slope * other);
                }
            }
        }
        (mean.map(|sum| sum / count), squares)
    }

    /// Bad legs as they are likeliest under the α's, by a step of expectation and maximization.
    fn bad_again(&self, at: &Parameters, robust: Robust) -> Option<Bad> {
        let bad = at.bad.as_ref()?;
        let (mut shares, mut spread, mut usual) = (0.0, [[0.0; 2]; 3], [[0.0; 2]; 3]);
        for row in &self.rows {
            let variances = self.variances(row, &at.alphas);
            let (_, part) = self.density(row, &variances, Some(bad));
            shares += part;
            for k in (0..3).filter(|k| row.told[*k]) {
                // A step of scoring: of u = v + w by w.
                let precision = 1.0 / (variances[k] + bad.spreads[k]);
                spread[k][0] += part * precision * (row.squares[k] * precision - 1.0);
                spread[k][1] += part * precision * precision;
                usual[k][0] += (1.0 - part) * variances[k];
                usual[k][1] += 1.0 - part;
            }
        }
        let share = match robust {
            Robust::Estimated => shares / self.rows.len() as f64,
            _ => bad.share,
        };
        let spreads = std::array::from_fn(|k| {
            let step = if spread[k][1] > 0.0 { spread[k][0] / spread[k][1] } else { 0.0 };
            let least = if usual[k][1] > 0.0 { LEAST_SPREAD * usual[k][0] / usual[k][1] } else { 0.0 };
            // Not by more than tenfold at once: far from the maximum the step is too long.
            (bad.spreads[k] + step).max(0.1 * bad.spreads[k]).min(10.0 * bad.spreads[k]).max(least)
        });
        Some(Bad { share: share.clamp(1e-9, 0.5), spreads })
    }
}

/// √(2π).
pub(super) const ROOT_TAU: f64 = 2.506_628_274_631_000_5;

/// A residual's square is far from the rest beyond this many medians of them: of a normal distribution one in 25,000 is, of a
/// mixture of straight legs and turns a few in a hundred are.
const FAR: f64 = 8.0 / 0.454_936;

/// A bad leg is at least three times as uncertain as others usually are, or it could not be told from them.
const LEAST_SPREAD: f64 = 8.0;

/// Where the likelihood is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Parameters {
    pub alphas: Alphas,
    pub bad: Option<Bad>,
}

/// The legs that are off by more than any motion explains: how many there are, and the variance of each kind that they have
/// besides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bad {
    pub share: f64,
    pub spreads: [f64; 3],
}

/// What the parameters make of a leg.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegDensity {
    /// Of the residuals that it tells.
    pub variances: [Option<f64>; 3],
    /// The probability that it is bad.
    pub bad: f64,
    /// The derivatives of its log-likelihood by the α's.
    pub gradient: Alphas,
}

/// The log-likelihood at a point, and how it changes about that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slope {
    pub log_likelihood: f64,
    pub gradient: Alphas,
    information: [Alphas; 6],
}

impl Slope {
    /// What is known of an α when all others are estimated with it: the inverse of its variance, were the likelihood a
    /// parabola.
    pub fn information_of(&self, alpha: usize, free: &[usize]) -> f64 {
        let mut left = self.information;
        // The Schur complement, one variable out after the other.
        for out in free.iter().copied().filter(|other| *other != alpha) {
            let row = left[out];
            if row[out] > 0.0 {
                for each in &mut left {
                    let factor = each[out] / row[out];
                    each.iter_mut().zip(row).for_each(|(entry, of_row)| *entry -= factor * of_row);
                }
            }
        }
        left[alpha][alpha]
    }

    /// The maximum of the parabola at `from` with this `gradient` over all `free` α's that are 0 or more, the others as they are in
    /// `at`.
    pub fn maximum(&self, gradient: &Alphas, from: &Alphas, mut at: Alphas, free: &[usize]) -> Alphas {
        // From coordinate to coordinate: what is left over another step of the whole takes care of.
        for _ in 0..SWEEPS {
            let before = at;
            for &k in free {
                let curvature = self.information[k][k];
                if curvature > 0.0 {
                    let pull: f64 = (0..6).map(|l| self.information[k][l] * (from[l] - at[l])).sum();
                    at[k] = (at[k] + (gradient[k] + pull) / curvature).max(0.0);
                }
            }
            if (0..6).all(|k| (at[k] - before[k]).abs() <= 1e-13 * at[k]) {
                break;
            }
        }
        at
    }

    /// How much the parabola promises for a step, nats.
    fn promised(&self, from: &Alphas, to: &Alphas) -> f64 {
        let step: Alphas = std::array::from_fn(|k| to[k] - from[k]);
        (0..6)
            .map(|k| {
                step[k]
                    * (self.gradient[k] - 0.5 * (0..6).map(|l| self.information[k][l] * step[l]).sum::<f64>())
            })
            .sum()
    }
}

/// Of the maximum of a parabola, through all α's in turn: two of them nearly alike settle within a few hundred.
const SWEEPS: usize = 300;

/// Of the whole: ten are usual, and a hundred where triangular noise has the maximum in a narrow corner.
pub(super) const STEPS: usize = 200;

/// What another step has to promise, nats: less is a thousandth of a deviation, and of many legs below the rounding of their sum.
const ENOUGH: f64 = 1e-6;

/// What a step has to have brought for another one, nats: along the edge of a triangle they become ever smaller, and a hundredth of
/// this does not move an interval's end.
const GAINED: f64 = 1e-4;

/// The parameters under which the legs are likeliest, from `start` on; α's that are not `free` stay as they are, and so do the
/// bad legs without `robust`. Steps are at most as many as said.
pub(super) fn maximize(
    evidence: &Evidence,
    start: Parameters,
    free: &[usize],
    robust: Robust,
    steps: usize,
) -> (Parameters, Slope) {
    let mut at = start;
    let mut here = evidence.slope(&at);
    for _ in 0..steps {
        let before = here.log_likelihood;
        if robust != Robust::No {
            let bad = evidence.bad_again(&at, robust);
            let there = evidence.slope(&Parameters { bad, ..at });
            if there.log_likelihood > before {
                (at, here) = (Parameters { bad, ..at }, there);
            }
        }
        let step = better(evidence, &at, &here, free);
        if let Some(step) = step {
            (at, here) = step;
        }
        let gained = here.log_likelihood - before;
        if gained.is_nan() || gained <= GAINED {
            break;
        }
    }
    (at, here)
}

/// A step that makes the legs likelier; none where there is no such.
fn better(evidence: &Evidence, at: &Parameters, here: &Slope, free: &[usize]) -> Option<(Parameters, Slope)> {
    let aim = here.maximum(&here.gradient, &at.alphas, at.alphas, free);
    let promised = here.promised(&at.alphas, &aim);
    if promised.is_nan() || promised < ENOUGH {
        return None;
    }
    // Where the parabola promises too much, less of it.
    let mut share = 1.0;
    while share > 1e-4 {
        let alphas = std::array::from_fn(|k| at.alphas[k] + share * (aim[k] - at.alphas[k]));
        let to = Parameters { alphas, ..*at };
        let there = evidence.slope(&to);
        if there.log_likelihood > here.log_likelihood {
            return Some((to, there));
        }
        // Outside of a triangle there is no telling how far.
        share *= if there.log_likelihood.is_finite() { 0.5 } else { 0.25 };
    }
    None
}
