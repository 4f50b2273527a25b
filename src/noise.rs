//! Zero-mean noises of the chapter: `sample(b²)` and `prob(a, b²)` of Tables 5.2 and 5.4, with variances as arguments.
//!
//! Each random number is the quantile of one uniform number. Both kinds of noise therefore give similar robots for the same seed. No result
//! depends on the mathematics library of a platform.

mod quantile;

use crate::geom::angle::wrap_angle;
use crate::geom::lanes::LANE_COUNT;
use crate::geom::sinc::sinc;
use crate::numbers::format_number;
use rand::Rng;
use std::f64::consts::{PI, TAU};
use thiserror::Error;
use wide::f64x4;

/// Variance b², in the square of the unit of the perturbed quantity. The type prevents passing a standard deviation by
/// mistake. [`Variance::new`] checks the value; the public field is not checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variance(pub f64);

impl Variance {
    /// Creates a variance, after checking that it is 0 or more. Fails with [`NegativeVariance`] if `b2` is negative or not a number.
    pub fn new(b2: f64) -> Result<Self, NegativeVariance> {
        if b2 >= 0.0 { Ok(Self(b2)) } else { Err(NegativeVariance(b2)) }
    }
}

/// Error of [`Variance::new`] for a number that is negative or NaN.
#[derive(Clone, Copy, Debug, Error)]
#[error("variance is {}; a number that is 0 or more is needed", format_number(*.0))]
pub struct NegativeVariance(pub f64);

/// Largest residual that counts as 0 for a noise of zero variance (m/s or rad/s, or m or rad for rotations and translations of odometry).
///
/// Inverting an arc of 0.01 s at 1 m/s, a kilometre from the origin, gives an error of up to 4e-9 in γ̂. At lower speeds the error is
/// larger. A smaller bound would therefore reject poses of the sampler itself. The bound does not hide real deviations from a command,
/// which are far larger than 0.1 µm/s.
const MAX_ZERO_RESIDUAL: f64 = 1e-7;

/// √6: the triangular density of variance b² is positive within ±√6·b.
const SQRT_6: f64 = 2.449_489_742_783_178;

/// Distribution of a zero-mean noise.
///
/// ```
/// use motion::{NoiseKind, Variance};
///
/// let variance = Variance::new(0.04)?;
/// assert!(NoiseKind::Normal.prob(0.0, variance) > NoiseKind::Normal.prob(0.2, variance));
/// assert_eq!(NoiseKind::Triangular.prob(0.5, variance), 0.0);
/// # Ok::<(), motion::NegativeVariance>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseKind {
    /// Normal distribution.
    Normal,
    /// Symmetric triangle on ±√6·b: bounded, so that there are no extreme draws.
    Triangular,
}

impl NoiseKind {
    /// Returns a random number of variance `b2`; 0 if the variance is 0, NaN if it is negative or NaN. Consumes one 64-bit number of `rng`.
    pub fn sample<R: Rng + ?Sized>(self, b2: Variance, rng: &mut R) -> f64 {
        self.quantile(draw_centred_uniform(rng)) * b2.0.sqrt()
    }

    pub(crate) fn sample_unit_triple<R: Rng + ?Sized>(self, rng: &mut R) -> [f64; 3] {
        std::array::from_fn(|_| self.quantile(draw_centred_uniform(rng)))
    }

    /// Returns the density of the noise of variance `b2` at the residual `a`, in the inverse of a's unit.
    ///
    /// For a variance of 0 the result is 1 if `a` is 0 up to rounding (1e-7), and 0 otherwise. In a product of densities, a residual
    /// without noise therefore changes nothing if it is 0. Otherwise it makes the product 0.
    pub fn prob(self, a: f64, b2: Variance) -> f64 {
        let Variance(b2) = b2;
        if b2 == 0.0 {
            return if a.abs() <= MAX_ZERO_RESIDUAL { 1.0 } else { 0.0 };
        }
        match self {
            Self::Normal => libm::exp(-0.5 * a * a / b2) / (2.0 * PI * b2).sqrt(),
            Self::Triangular => {
                let half_width = (6.0 * b2).sqrt();
                (half_width - a.abs()).max(0.0) / (6.0 * b2)
            }
        }
    }

    /// Returns E[sin² ε] of a noise ε of variance `b2` (rad²), which is (1 − E[cos 2ε])/2: for a Gaussian (1 −
    /// e^(−2b²))/2, for the triangle (1 − sinc²(√6·b))/2. Relative error below 1e-10.
    pub fn mean_squared_sine(self, b2: Variance) -> f64 {
        let Variance(b2) = b2;
        match self {
            Self::Normal => -0.5 * libm::expm1(-2.0 * b2),
            // The series up to b⁴ is used for small b. Its next term is then smaller than the rounding error of 1 − sinc².
            Self::Triangular if b2 < 1e-5 => b2 * (1.0 - 0.8 * b2),
            Self::Triangular => {
                let sinc_of_deviation = sinc(SQRT_6 * b2.sqrt());
                0.5 * (1.0 - sinc_of_deviation * sinc_of_deviation)
            }
        }
    }

    /// Replaces each number q by the quantile of the probability ½ + q. The results have the same bits as those of [`NoiseKind::quantile`].
    pub(crate) fn replace_by_quantiles(self, centred_probabilities: &mut [f64x4]) {
        match self {
            Self::Normal => centred_probabilities
                .chunks_mut(quantile::CHUNK_VECTORS)
                .for_each(quantile::replace_chunk_by_quantiles),
            Self::Triangular => centred_probabilities
                .iter_mut()
                .for_each(|q| *q = *q * (SQRT_6 * 2.0) / (1.0 + (1.0 - 2.0 * q.abs()).sqrt())),
        }
    }

    /// Returns the quantile of the probability ½ + `q`, for a variance of 1 and q in (−½, ½). It is odd and increasing in q.
    ///
    /// The relative error for normal noise is below 1e-15 (Wichura, Algorithm AS 241, Applied Statistics 37, 1988).
    pub fn quantile(self, q: f64) -> f64 {
        match self {
            Self::Normal => quantile::normal_quantile(q),
            // √6·(1 − √(1 − 2|q|)), expanded so that nothing cancels near the middle.
            Self::Triangular => q * (SQRT_6 * 2.0) / (1.0 + (1.0 - 2.0 * q.abs()).sqrt()),
        }
    }
}

/// Returns the product of independent densities. The product is 0 if one density is 0, even if another density has overflowed to infinity.
pub(crate) fn product_or_zero<const N: usize>(density_factors: [f64; N]) -> f64 {
    if density_factors.contains(&0.0) { 0.0 } else { density_factors.into_iter().product() }
}

/// Returns the density at the angle `a` of noise of variance `b2` wrapped around the circle: Σₖ prob(a + 2πk), per radian. For a variance
/// of 0 the result is that of [`NoiseKind::prob`].
pub(crate) fn wrapped_density(noise_kind: NoiseKind, a: f64, b2: Variance) -> f64 {
    let a = wrap_angle(a);
    let std = b2.0.sqrt();
    match noise_kind {
        // For a standard deviation above 9 rad, the wrapped Gaussian is uniform to the last bit: its first harmonic is exp(−b²/2) < 1e-17.
        NoiseKind::Normal if std > 9.0 => 1.0 / TAU,
        NoiseKind::Normal => {
            // A term at more than nine standard deviations is below the rounding error of the sum.
            let max_full_turns = (9.0 * std / TAU).ceil() as i32;
            (-max_full_turns..=max_full_turns).map(|k| noise_kind.prob(a + f64::from(k) * TAU, b2)).sum()
        }
        NoiseKind::Triangular if std == 0.0 => noise_kind.prob(a, b2),
        NoiseKind::Triangular => {
            let half_width = SQRT_6 * std;
            // Sums half_width − x over x = first, first + 2π, … up to half_width: the terms of the triangular density on one side of its
            // peak.
            let density_sum_on_side = |first_term: f64| {
                let term_count = ((half_width - first_term) / TAU).ceil().max(0.0);
                term_count * (half_width - first_term) - TAU * term_count * (term_count - 1.0) / 2.0
            };
            let abs_angle = a.abs();
            (density_sum_on_side(abs_angle) + density_sum_on_side(TAU - abs_angle))
                / (half_width * half_width)
        }
    }
}

/// Returns a uniform number in (−½, ½). It is one of the 2⁵³ odd multiples of 2⁻⁵⁴, all equally likely. The distribution is exactly
/// symmetric. It contains neither 0 nor ±½, whose quantiles are infinite.
#[inline(always)]
pub fn draw_centred_uniform<R: Rng + ?Sized>(rng: &mut R) -> f64 {
    const UNIFORM_SPACING: f64 = 1.0 / (1u64 << 53) as f64;
    let signed_integer = rng.next_u64() as i64 >> 11;
    (signed_integer as f64 + 0.5) * UNIFORM_SPACING
}

/// Returns three numbers of [`draw_centred_uniform`] for each of four samples, drawn sample by sample.
#[inline(always)]
pub(crate) fn draw_four_uniform_triples<R: Rng + ?Sized>(rng: &mut R) -> [f64x4; 3] {
    let mut uniform_triples = [[0.0; LANE_COUNT]; 3];
    for lane_index in 0..LANE_COUNT {
        uniform_triples
            .iter_mut()
            .for_each(|uniform_numbers| uniform_numbers[lane_index] = draw_centred_uniform(rng));
    }
    uniform_triples.map(f64x4::from)
}
