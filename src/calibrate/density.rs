//! How likely the three residuals of a leg are, and which variances would make them likelier.

use super::likelihood::ROOT_6;
use crate::noise::NoiseKind;

/// The density of a leg's residuals: `factor` · exp(`exponent`), so that neither is too small for a double.
#[derive(Clone, Copy, Debug)]
pub(super) struct Density {
    pub factor: f64,
    pub exponent: f64,
    /// The derivatives of its logarithm by the variances.
    pub by_variance: [f64; 3],
    /// What is expected of minus the second ones, or what stands for that.
    pub information: [f64; 3],
}

impl Density {
    /// Π N(rₖ; 0, vₖ) without its powers of 2π: of a residual that is not told r is 0 and v is 1.
    #[inline(always)]
    pub fn normal(sizes: &[f64; 3], variances: &[f64; 3]) -> Self {
        let precisions = variances.map(|variance| 1.0 / variance);
        let shares: [f64; 3] = std::array::from_fn(|k| sizes[k] * sizes[k] * precisions[k]);
        Self {
            factor: (precisions[0] * precisions[1] * precisions[2]).sqrt(),
            exponent: -0.5 * (shares[0] + shares[1] + shares[2]),
            by_variance: std::array::from_fn(|k| 0.5 * precisions[k] * (shares[k] - 1.0)),
            information: precisions.map(|precision| 0.5 * precision * precision),
        }
    }

    /// Π (c − |r|)/c² with c = √(6v), without its powers of 6: of a residual that is not told r is 0 and v is 1. At the ends of its support its information is
    /// infinite: for that stands minus the second derivative itself, or 0 in the middle, where that is negative.
    #[inline(always)]
    pub fn triangular(sizes: &[f64; 3], variances: &[f64; 3]) -> Self {
        let ends = variances.map(|variance| (6.0 * variance).sqrt());
        let left: [f64; 3] = std::array::from_fn(|k| ends[k] - sizes[k]);
        if !left.iter().all(|left| *left > 0.0) {
            return Self { factor: 0.0, exponent: 0.0, by_variance: [0.0; 3], information: [0.0; 3] };
        }
        let precisions = variances.map(|variance| 1.0 / variance);
        // By the part of the half triangle that is left outside of the residual.
        let inverse: [f64; 3] = std::array::from_fn(|k| ends[k] / left[k]);
        Self {
            factor: (0..3).map(|k| left[k] * precisions[k] / ROOT_6).product(),
            exponent: 0.0,
            by_variance: std::array::from_fn(|k| 0.5 * precisions[k] * (inverse[k] - 2.0)),
            information: std::array::from_fn(|k| {
                let bend = inverse[k] * (inverse[k] + 1.0) - 4.0;
                0.25 * bend.max(0.0) * (precisions[k] * precisions[k])
            }),
        }
    }

    #[inline(always)]
    pub fn of(noise: NoiseKind, sizes: &[f64; 3], variances: &[f64; 3]) -> Self {
        match noise {
            NoiseKind::Normal => Self::normal(sizes, variances),
            NoiseKind::Triangular => Self::triangular(sizes, variances),
        }
    }

    /// With that of other residuals under the same variances. Rare, and long code in few places.
    #[inline(never)]
    pub fn or_of(&self, noise: NoiseKind, sizes: &[f64; 3], variances: &[f64; 3]) -> Self {
        self.or(&Self::of(noise, sizes, variances)).0
    }

    #[inline(always)]
    pub fn times(self, weight: f64) -> Self {
        Self { factor: weight * self.factor, ..self }
    }

    /// The sum of both, and the part of it that is `other`.
    #[inline(always)]
    pub fn or(&self, other: &Self) -> (Self, f64) {
        let ratio = other.factor / self.factor * libm::exp(other.exponent - self.exponent);
        if ratio.is_nan() || self.factor == 0.0 {
            return (*other, 1.0);
        }
        let part = if ratio < 1.0 { ratio / (1.0 + ratio) } else { 1.0 / (1.0 + 1.0 / ratio) };
        let both = |a: f64, b: f64| (1.0 - part) * a + part * b;
        // About the larger of the two, so that no sum overflows.
        let [factor, exponent] = if ratio < 1.0 {
            [self.factor * (1.0 + ratio), self.exponent]
        } else {
            [other.factor * (1.0 + 1.0 / ratio), other.exponent]
        };
        let sum = Self {
            factor,
            exponent,
            by_variance: std::array::from_fn(|k| both(self.by_variance[k], other.by_variance[k])),
            information: std::array::from_fn(|k| both(self.information[k], other.information[k])),
        };
        (sum, part)
    }
}

/// The logarithm of a product of very many numbers, with one logarithm: their exponents are whole numbers, and the product of
/// their mantissas is kept small.
#[derive(Clone, Copy, Debug)]
pub(super) struct LogProduct {
    exponents: i64,
    mantissas: f64,
    /// Of what has no exponent of its own: 0, infinity, the smallest doubles.
    rest: f64,
}

const MANTISSA: u64 = (1 << 52) - 1;
const ONE: u64 = 1023 << 52;

impl LogProduct {
    pub const EMPTY: Self = Self { exponents: 0, mantissas: 1.0, rest: 0.0 };

    #[inline(always)]
    pub fn multiply(&mut self, number: f64) {
        if !number.is_normal() {
            self.rest += libm::log(number);
            return;
        }
        let bits = number.to_bits();
        self.exponents += (bits >> 52) as i64 - 1023;
        self.mantissas *= f64::from_bits((bits & MANTISSA) | ONE);
        // Each is below 2.
        if self.mantissas > 1e300 {
            let bits = self.mantissas.to_bits();
            self.exponents += (bits >> 52) as i64 - 1023;
            self.mantissas = f64::from_bits((bits & MANTISSA) | ONE);
        }
    }

    pub fn log(&self) -> f64 {
        self.exponents as f64 * std::f64::consts::LN_2 + libm::log(self.mantissas) + self.rest
    }
}
