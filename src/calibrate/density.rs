//! How likely the three residuals of a leg are, and which variances would make them likelier.

/// √(2π).
pub(super) const ROOT_TAU: f64 = 2.506_628_274_631_000_5;

/// √6.
pub(super) const ROOT_6: f64 = 2.449_489_742_783_178;

/// 95 % of a normal distribution are within so many deviations.
pub(super) const NORMAL_95: f64 = 1.959_963_984_540_054;

/// The density of a leg's residuals: `factor` · exp(`exponent`), so that neither is too small for a double.
#[derive(Clone, Copy, Debug)]
pub(super) struct Density {
    pub factor: f64,
    pub exponent: f64,
    /// The derivatives of its logarithm by the variances.
    pub by_variance: [f64; 3],
    /// What is expected of minus the second ones, or what stands for that.
    pub information: [f64; 3],
    /// Whether what a blur has made of a triangle's corners had to be computed, which takes long.
    pub blurred: bool,
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
            blurred: false,
        }
    }

    /// Π (c − |r|)/c² with c = √(6v), without its powers of 6; and where a residual is off by something else too, whose standard
    /// deviation is `blur`, of the sum of both: (R(r + c) − 2R(r) + R(r − c))/c², R(y) being the mean of (y + blur · N(0, 1))₊. The sharp end of a
    /// triangle would have one residual, off by what no motion has done, decide on the variance.
    ///
    /// Its information is infinite at the ends of a sharp support: for that stands minus the second derivative itself, or 0 in the middle,
    /// where that is negative. Of a residual that is not told r is 0 and v is 1.
    #[inline(always)]
    pub fn triangular(sizes: &[f64; 3], blurs: &[f64; 3], variances: &[f64; 3]) -> Self {
        let ends = variances.map(|variance| (6.0 * variance).sqrt());
        let left: [f64; 3] = std::array::from_fn(|k| ends[k] - sizes[k]);
        // Away from the corners, as nearly all are, a blur makes no difference.
        if !(0..3).all(|k| left[k] > ROUND * blurs[k] && sizes[k] >= ROUND * blurs[k]) {
            return Self::blurred(sizes, blurs, variances);
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
            blurred: false,
        }
    }

    #[inline(never)]
    fn blurred(sizes: &[f64; 3], blurs: &[f64; 3], variances: &[f64; 3]) -> Self {
        let nothing = Self {
            factor: 0.0,
            exponent: 0.0,
            by_variance: [0.0; 3],
            information: [0.0; 3],
            blurred: *blurs != [0.0; 3],
        };
        let mut density = Self { factor: 1.0, ..nothing };
        for k in 0..3 {
            let (size, blur, variance) = (sizes[k], blurs[k], variances[k]);
            if blur > BLUNT * variance.sqrt() {
                let precision = 1.0 / (variance + blur * blur);
                let share = size * size * precision;
                density.factor *= precision.sqrt() * (ROOT_6 / ROOT_TAU);
                density.exponent -= 0.5 * share;
                density.by_variance[k] = 0.5 * precision * (share - 1.0);
                density.information[k] = 0.5 * precision * precision;
                continue;
            }
            let (precision, end) = (1.0 / variance, (6.0 * variance).sqrt());
            let [value, slope, bend] = triangle(size / end, blur / end);
            if value.is_nan() || value <= 0.0 {
                return nothing;
            }
            let [slope, bend] = [slope / value, bend / value];
            density.factor *= value * end * precision / ROOT_6;
            density.by_variance[k] = 0.5 * precision * (slope - 2.0);
            density.information[k] =
                0.25 * (slope * slope + slope - 4.0 - bend).max(0.0) * (precision * precision);
        }
        density
    }

    /// With that of other residuals under the same variances. Rare, and long code in few places.
    #[inline(never)]
    pub fn or_of(&self, other: impl FnOnce() -> Self) -> Self {
        self.or(&other()).0
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
            return (Self { blurred: self.blurred, ..*other }, 1.0);
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
            blurred: self.blurred,
        };
        (sum, part)
    }
}

/// By so many deviations of the triangle a normal error hides it: what is left of its kurtosis is −0.6/(1 + 25²)², and the sum is normal.
const BLUNT: f64 = 25.0;

/// So many deviations away from a corner there is nothing of what a blur has made of it: a share of 10⁻⁹ of the blur.
const ROUND: f64 = 5.7;

/// The triangle from −1 to 1, blurred, at u ≥ 0: n = R(u + 1) − 2R(u) + R(u − 1), and its first two derivatives by the end where that is 1.
fn triangle(u: f64, blur: f64) -> [f64; 3] {
    if blur == 0.0 {
        return [1.0 - u, 1.0, 0.0];
    }
    // At so many deviations from a corner: the density, the probability beyond, and the mean of what is beyond.
    let corner = |z: f64| {
        // Outside, what is beyond each of them is all that there is.
        if u < 1.0 && z > ROUND {
            return [0.0; 3];
        }
        let density = libm::exp(-0.5 * z * z) / ROOT_TAU;
        let beyond = 0.5 * libm::erfc(z * std::f64::consts::FRAC_1_SQRT_2);
        [density, beyond, density - z * beyond]
    };
    let [left, middle, right] = [u + 1.0, u, (u - 1.0).abs()].map(|distance| corner(distance / blur));
    let value = (1.0 - u).max(0.0) + blur * (left[2] - 2.0 * middle[2] + right[2]);
    let slope = if u < 1.0 { 1.0 - left[1] - right[1] } else { right[1] - left[1] };
    [value, slope, (left[0] + right[0]) / blur]
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
