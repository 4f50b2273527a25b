//! The likelihood of variances that are sums, v = c + Σ αₖ fₖ, each α 0 or more; and where it is largest.

use super::bad::{Bad, BadAgain, Robust};
use super::density::{Density, LogProduct, ROOT_6, ROOT_TAU};
use super::model::{Model, Observation};
use super::trajectory::sort;
use super::work::Work;
use crate::noise::NoiseKind;
use std::ops::Range;

/// What the α's are at a point: of as many as there may be, six.
pub(super) type Alphas = [f64; 6];

/// A leg's part of the likelihood.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// How large the residuals are; 0 of one that is not told.
    sizes: [f64; 3],
    coefficients: [[f64; 2]; 3],
    /// 1 of a residual that is not told, of which nothing then depends.
    floors: [f64; 3],
    /// The standard deviations of what is not the wheels' noise.
    blurs: [f64; 3],
    told: [bool; 3],
    /// Its place among the squares by the other way; none where it is past their end.
    other_way: u32,
}

impl Row {
    /// How large a residual is without what else there is of it: further away its density is below the smallest double.
    #[inline(always)]
    fn least_size(&self, kind: usize) -> f64 {
        (self.sizes[kind] - FARTHEST * self.blurs[kind]).max(0.0)
    }

    #[inline(always)]
    fn density(&self, noise: NoiseKind, sizes: &[f64; 3], variances: &[f64; 3]) -> Density {
        match noise {
            NoiseKind::Normal => Density::normal(sizes, variances),
            NoiseKind::Triangular => {
                // Which alone are triangular.
                let of_wheels = std::array::from_fn(|k| {
                    if self.told[k] { (variances[k] - self.floors[k]).max(0.0) } else { 1.0 }
                });
                Density::triangular(sizes, &self.blurs, &of_wheels)
            }
        }
    }
}

/// What all legs say.
#[derive(Clone, Debug)]
pub struct Evidence {
    pub(super) pairs: [[usize; 2]; 3],
    pub(super) noise: NoiseKind,
    rows: Vec<Row>,
    /// The α's of which some residual says anything.
    pub(super) told: [bool; 6],
    other_ways: Vec<[f64; 3]>,
    pub(super) work: Work,
}

impl Evidence {
    pub fn new<'a>(
        model: Model,
        noise: NoiseKind,
        observations: impl IntoIterator<Item = &'a Observation>,
    ) -> Self {
        let mut evidence = Self::none(model, noise, Work::default());
        observations.into_iter().for_each(|each| evidence.add(each));
        evidence
    }

    /// Of no legs yet; what it costs to go through them is counted as work.
    pub(super) fn none(model: Model, noise: NoiseKind, work: Work) -> Self {
        let pairs = model.kinds().map(|kind| kind.alphas);
        Self { pairs, noise, rows: Vec::new(), told: [false; 6], other_ways: Vec::new(), work }
    }

    /// A residual that nothing would make uncertain is not told: its variance is 0 under all α's.
    pub(super) fn add(&mut self, observation: &Observation) {
        let Observation { residuals, coefficients, floors, unknown, other_way, .. } = observation;
        let told: [bool; 3] = std::array::from_fn(|k| {
            residuals[k].is_finite() && (coefficients[k] != [0.0; 2] || floors[k] > 0.0)
        });
        let size =
            |residuals: &[f64; 3]| std::array::from_fn(|k| if told[k] { residuals[k].abs() } else { 0.0 });
        self.rows.push(Row {
            sizes: size(residuals),
            coefficients: std::array::from_fn(|k| if told[k] { coefficients[k] } else { [0.0; 2] }),
            floors: std::array::from_fn(|k| if told[k] { floors[k] + unknown[k] } else { 1.0 }),
            blurs: std::array::from_fn(|k| if told[k] { (floors[k] + unknown[k]).sqrt() } else { 0.0 }),
            told,
            other_way: if other_way.is_some() { self.other_ways.len() as u32 } else { u32::MAX },
        });
        let row = &self.rows[self.rows.len() - 1];
        for (pair, coefficients) in self.pairs.iter().zip(&row.coefficients) {
            for i in 0..2 {
                self.told[pair[i]] |= coefficients[i] > 0.0;
            }
        }
        self.other_ways.extend(other_way.as_ref().map(size));
    }

    /// How often all legs were gone through so far; parts of them count as such.
    pub fn passes(&self) -> f64 {
        self.work.total() as f64 / self.rows.len() as f64
    }

    fn residuals_told(&self) -> usize {
        self.rows.iter().map(|row| row.told.iter().filter(|told| **told).count()).sum()
    }

    /// Where to begin, as if noise were normal: of each kind its two α's answer for half of what is there, without the hundredths that
    /// are far from the rest.
    pub(super) fn beginning(&self, robust: Robust) -> Parameters {
        self.work.add(self.rows.len());
        let mut alphas = [0.0f64; 6];
        let mut spreads = [1.0; 3];
        for (kind, pair) in self.pairs.iter().enumerate() {
            let told = || self.rows.iter().filter(|row| row.told[kind]);
            let mut sizes: Vec<f64> = told()
                .step_by(1 + self.rows.len() / ENOUGH_FOR_A_MEDIAN)
                .map(|row| row.sizes[kind])
                .collect();
            if sizes.is_empty() {
                continue;
            }
            sort(&mut sizes);
            let median = sizes[sizes.len() / 2];
            let most = median * median * FAR;
            let (mut count, mut sum, mut coefficients) = (0.0, 0.0, [0.0; 2]);
            for row in told() {
                let square = row.sizes[kind] * row.sizes[kind];
                count += 1.0;
                sum += if robust == Robust::No { square } else { square.min(most) };
                coefficients[0] += row.coefficients[kind][0];
                coefficients[1] += row.coefficients[kind][1];
            }
            for (k, coefficients) in pair.iter().zip(coefficients) {
                if coefficients > 0.0 {
                    // Of perfect ones too something: the scoring goes down from there.
                    alphas[*k] = alphas[*k].max((0.5 * sum / coefficients).max(1e-12));
                }
            }
            spreads[kind] = most.max(sum / count).max(1e-12);
        }
        let bad = match robust {
            Robust::No => None,
            Robust::Stated(share) => Some(Bad { share, spreads }),
            Robust::Estimated => Some(Bad { share: 0.02, spreads }),
        };
        Parameters { alphas, bad, noise: NoiseKind::Normal }
    }

    /// How near to the edge of its triangle (as a share of its length) a residual has to be for the likelihood not to be a parabola, where
    /// α's are about as well known as so many legs tell them.
    pub(super) fn width(&self) -> f64 {
        (EDGE / (self.rows.len() as f64).sqrt()).min(1.0)
    }

    /// By what factor, 1 or more, these α's have to be larger for all residuals to be inside of their triangles by this share of their
    /// length; not finite where no factor is large enough.
    pub(super) fn widening(&self, alphas: &Alphas, widened: &[usize], share: f64) -> f64 {
        self.work.add(self.rows.len());
        let part = 6.0 * (1.0 - share) * (1.0 - share);
        let (mut others, mut these) = (*alphas, [0.0; 6]);
        for &k in widened {
            (others[k], these[k]) = (0.0, alphas[k]);
        }
        let mut factor: f64 = 1.0;
        for row in &self.rows {
            let (fixed, widened) = (self.variances(row, &others), self.variances(row, &these));
            for k in 0..3 {
                let size = row.least_size(k);
                let missing = size * size / part - fixed[k];
                if missing > factor * (widened[k] - row.floors[k]) {
                    factor = missing / (widened[k] - row.floors[k]);
                }
            }
        }
        factor
    }

    /// The legs with a residual so near to the edge of its triangle (in its length) that no parabola has their likelihood;
    /// of normal noise none.
    pub(super) fn edge(&self, at: &Parameters) -> Self {
        let work = self.work.clone();
        let mut edge = Self { rows: Vec::new(), other_ways: Vec::new(), work, ..*self };
        if at.noise == NoiseKind::Normal {
            return edge;
        }
        self.work.add(self.rows.len());
        let width = self.width();
        let [least, most] = [1.0 - width, 1.0 + width].map(|ratio| 6.0 * ratio * ratio);
        for row in &self.rows {
            let variances = self.variances(row, &at.alphas);
            let other_way = self.other_ways.get(row.other_way as usize);
            // What is blurred as far as that is nearly one again.
            let sharp: [bool; 3] =
                std::array::from_fn(|k| row.blurs[k] * row.blurs[k] < 6.0 * width * width * variances[k]);
            let near = |sizes: &[f64; 3]| {
                (0..3).filter(|k| sharp[*k]).any(|k| {
                    let near = NEAR * row.blurs[k];
                    let [nearest, farthest] = [sizes[k] - near, sizes[k] + near];
                    farthest * farthest > least * variances[k]
                        && nearest.max(0.0) * nearest < most * variances[k]
                })
            };
            if near(&row.sizes) || other_way.is_some_and(near) {
                let place = edge.other_ways.len() as u32;
                edge.other_ways.extend(other_way);
                edge.rows.push(Row { other_way: if other_way.is_some() { place } else { u32::MAX }, ..*row });
            }
        }
        edge
    }

    /// How far a step may go without any residual leaving its triangle, as a share of it.
    pub(super) fn reach(&self, from: &Alphas, to: &Alphas) -> f64 {
        self.work.add(self.rows.len());
        let mut reach: f64 = 1.0;
        for row in &self.rows {
            let [before, after] = [from, to].map(|alphas| self.variances(row, alphas));
            for k in 0..3 {
                let square = row.least_size(k) * row.least_size(k);
                let [left, then] = [6.0 * before[k] - square, 6.0 * after[k] - square];
                if left > 0.0 && left + reach * (then - left) < 0.0 {
                    reach = left / (left - then);
                }
            }
        }
        reach
    }

    pub(super) fn legs(&self) -> usize {
        self.rows.len()
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
    fn density(&self, row: &Row, variances: &[f64; 3], at: &Parameters) -> (Density, f64) {
        let mut density = row.density(at.noise, &row.sizes, variances);
        if let Some(sizes) = self.other_ways.get(row.other_way as usize) {
            density = density.or_of(|| row.density(at.noise, sizes, variances));
        }
        let Some(Bad { share, spreads }) = &at.bad else { return (density, 0.0) };
        let wider: [f64; 3] =
            std::array::from_fn(|k| if row.told[k] { variances[k] + spreads[k] } else { 1.0 });
        let far = Density::normal(&row.sizes, &wider);
        let powers = if at.noise == NoiseKind::Triangular {
            row.told.iter().filter(|told| **told).map(|_| ROOT_6 / ROOT_TAU).product()
        } else {
            1.0
        };
        density.times(1.0 - share).or(&far.times(share * powers))
    }

    /// The logarithm of the likelihood (nats), its derivatives, and what Fisher expects of the second ones. With `robust` also what the
    /// bad legs are likely to be if this is what the others are.
    pub(super) fn slope(&self, at: &Parameters, robust: Robust) -> Slope {
        let mut logs = LogProduct::EMPTY;
        let (mut exponents, mut gradients, mut informations) = (0.0, [[0.0; 2]; 3], [[0.0; 3]; 3]);
        let mut blurred = 0;
        let mut again = at.bad.filter(|_| robust != Robust::No).map(BadAgain::new);
        for row in &self.rows {
            let variances = self.variances(row, &at.alphas);
            let (density, part) = self.density(row, &variances, at);
            logs.multiply(density.factor);
            exponents += density.exponent;
            blurred += usize::from(density.blurred);
            for kind in 0..3 {
                let [f, g] = row.coefficients[kind];
                let (slope, information) = (density.by_variance[kind], density.information[kind]);
                gradients[kind][0] += f * slope;
                gradients[kind][1] += g * slope;
                informations[kind][0] += f * f * information;
                informations[kind][1] += f * g * information;
                informations[kind][2] += g * g * information;
            }
            if let Some(again) = &mut again {
                again.add(&row.told, &row.sizes, &variances, part);
            }
        }
        self.work.add(self.rows.len() + BLURRED * blurred);
        let constant = match at.noise {
            NoiseKind::Normal => libm::log(ROOT_TAU),
            NoiseKind::Triangular => libm::log(ROOT_6),
        };
        let total = logs.log() + exponents - constant * self.residuals_told() as f64;
        // With a variance of 0 the logarithm is infinite, and so is the share, or none.
        let log_likelihood = if total.is_finite() { total } else { f64::NEG_INFINITY };
        let bad = again.map(|again| again.likeliest(robust));
        let mut slope = Slope { log_likelihood, gradient: [0.0; 6], information: [[0.0; 6]; 6], bad };
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

    /// Of each of these legs: its variances, the probability that it is bad, and the derivatives of its logarithm by the α's.
    pub(super) fn each(&self, at: &Parameters, legs: Range<usize>) -> impl Iterator<Item = LegDensity> {
        self.work.add(legs.len());
        self.rows[legs].iter().map(move |row| {
            let variances = self.variances(row, &at.alphas);
            let (density, bad) = self.density(row, &variances, at);
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
        self.work.add(self.rows.len());
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
}

/// A residual's square is far from the rest beyond this many medians of them: of a normal distribution one in 25,000 is, of a
/// mixture of straight legs and turns a few in a hundred are.
const FAR: f64 = 8.0 / 0.454_936;

/// Deviations at which a normal density is about 10⁻²⁰⁰.
const FARTHEST: f64 = 30.0;

/// Deviations within which the rounded end of a triangle is no parabola.
const NEAR: f64 = 3.0;

/// A row with a residual near a blurred corner takes as long as so many others besides.
const BLURRED: usize = 4;

/// So many tell a median to a hundredth.
const ENOUGH_FOR_A_MEDIAN: usize = 10_000;

/// For [`Evidence::width`]: a few deviations of an α, and 400 residuals on either side of the edge, of however many legs.
const EDGE: f64 = 20.0;

/// Where the likelihood is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Parameters {
    pub alphas: Alphas,
    pub bad: Option<Bad>,
    /// What noise is taken for.
    pub noise: NoiseKind,
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
    pub information: [Alphas; 6],
    /// What the bad legs are likely to be, if that was asked for.
    pub bad: Option<Bad>,
}
