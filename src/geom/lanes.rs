//! Sine and cosine of four angles at once, with the same bits on every target.
//!
//! The scalar functions of this crate come from `libm`, and agree with the functions of this module to [`MAX_SIN_COS_ERROR`]. The
//! polynomials use only +, −, ×, ÷ and comparisons, without fused operations, and so round equally on all targets.

use super::angle::wrap_angle;
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};
use wide::{bytemuck, f64x2, f64x4, u64x4};

/// Number of lanes of a SIMD vector.
pub const LANE_COUNT: usize = 4;

/// Maximum absolute error of sine, cosine and sinc: about 2.5 units in the last place of 1. The polynomials contribute at most 1.9e-16.
pub const MAX_SIN_COS_ERROR: f64 = 6e-16;

/// Values of sin x/x, sin x and cos x for four angles.
#[derive(Clone, Copy)]
pub struct SinCos {
    /// sin x/x, which is 1 at 0.
    pub sinc: f64x4,
    /// sin x.
    pub sin: f64x4,
    /// cos x.
    pub cos: f64x4,
}

/// Polynomials of sine and cosine, whose coefficients are in memory. A WebAssembly engine loads a coefficient from memory with one
/// instruction. A constant in the code takes three.
#[derive(Clone, Copy, Debug)]
pub struct Trigonometry {
    sinc: [f64; 8],
    cos: [f64; 9],
}

impl Default for Trigonometry {
    fn default() -> Self {
        Self { sinc: SINC_COEFFICIENTS, cos: COS_COEFFICIENTS }
    }
}

impl Trigonometry {
    #[inline(always)]
    /// Returns the sines and cosines of angles up to a quarter turn (rad).
    pub fn sin_cos_small_angle(&self, x: f64x4) -> SinCos {
        let (sinc, cos) = self.sinc_and_cos(x * x);
        SinCos { sinc, sin: x * sinc, cos }
    }

    /// Returns the sines and cosines of any finite angles (rad). Angles up to π/2 are fastest.
    #[inline(always)]
    pub fn sin_cos(&self, x: f64x4) -> SinCos {
        if is_any_lane_beyond(x, FRAC_PI_2) { self.sin_cos_any_angle(x) } else { self.sin_cos_small_angle(x) }
    }

    /// Returns the sines and cosines of any finite angles (rad). For an angle up to π/2 the result equals that of
    /// [`Trigonometry::sin_cos_small_angle`] to the bit, unless another of the four angles is beyond a million radians.
    #[inline(never)]
    pub fn sin_cos_any_angle(&self, x: f64x4) -> SinCos {
        if is_any_lane_beyond(x, MAX_REDUCED_ANGLE) {
            let map_lanes = |apply_to_lane: fn(f64) -> f64| f64x4::from(x.to_array().map(apply_to_lane));
            let [sinc, sin, cos] = [super::sinc::sinc, libm::sin, libm::cos].map(map_lanes);
            return SinCos { sinc, sin, cos };
        }
        let half_circles = half_circle_count(x);
        let reduced_sin_cos = self.sin_cos_small_angle(subtract_half_circles(x, half_circles));
        // Parity of `half_circles`: 0 if it is even, ±1 if it is odd. Adding and subtracting twice [`ROUND_TO_INTEGER`] rounds to the
        // nearest even number.
        let half_circle_parity =
            half_circles - (half_circles + 2.0 * ROUND_TO_INTEGER - 2.0 * ROUND_TO_INTEGER);
        let parity_sign = f64x4::splat(1.0) - 2.0 * half_circle_parity.abs();
        let (sin, cos) = (reduced_sin_cos.sin * parity_sign, reduced_sin_cos.cos * parity_sign);
        let sinc = half_circles.simd_eq(f64x4::splat(0.0)).bitselect(reduced_sin_cos.sinc, sin / x);
        SinCos { sinc, sin, cos }
    }

    /// Adds a multiple of π to each half heading h (heading divided by 2, rad), so that it is within π/2 of `branch_centre` (rad). Returns
    /// the sums with their sines and cosines. An odd multiple of π reverses the signs of sine and cosine, but leaves the heading unchanged.
    /// For half headings within π/2 of 0 and of `branch_centre`, the result equals that of [`Trigonometry::sin_cos_small_angle`] to the
    /// bit.
    #[inline(never)]
    pub fn sin_cos_on_branch(&self, half_heading: f64x4, branch_centre: f64) -> (f64x4, SinCos) {
        let mut half_heading_on_branch =
            subtract_half_circles(half_heading, half_circle_count(half_heading - branch_centre));
        if is_any_lane_beyond(half_heading - branch_centre, MAX_REDUCED_ANGLE) {
            let wrap_near =
                |half_heading: f64| branch_centre + 0.5 * wrap_angle(2.0 * (half_heading - branch_centre));
            half_heading_on_branch = half_heading.to_array().map(wrap_near).into();
        }
        (half_heading_on_branch, self.sin_cos_any_angle(half_heading_on_branch))
    }

    /// Returns (sin x/x, cos x) from z = x², for |x| up to π/2. The result is exact at 0.
    ///
    /// Estrin's scheme has as many operations as Horner's scheme, but a chain of dependent operations that is half as long.
    #[inline(always)]
    fn sinc_and_cos(&self, z: f64x4) -> (f64x4, f64x4) {
        let z2 = z * z;
        let z4 = z2 * z2;
        let [a, b, c, d, e, f, g, h] = self.sinc;
        let sinc = ((z * b + a) + z2 * (z * d + c)) + z4 * ((z * f + e) + z2 * (z * h + g));
        let [a, b, c, d, e, f, g, h, i] = self.cos;
        let cos = ((z * b + a) + z2 * (z * d + c)) + z4 * ((z * f + e) + z2 * ((z * h + g) + z2 * i));
        (sinc, cos)
    }
}

#[inline(always)]
fn is_any_lane_beyond(x: f64x4, magnitude_limit: f64) -> bool {
    is_any_lane_set(x.abs().simd_gt(f64x4::splat(magnitude_limit)))
}

#[inline(always)]
pub(crate) fn is_any_lane_set(lane_mask: f64x4) -> bool {
    let [low_lanes, high_lanes] = split_into_lane_pairs(lane_mask);
    (low_lanes | high_lanes).any()
}

#[inline(always)]
pub(crate) fn split_into_lane_pairs(four_lanes: f64x4) -> [f64x2; 2] {
    bytemuck::cast(four_lanes)
}

pub(crate) fn from_lanes(value_of_lane: impl FnMut(usize) -> f64) -> f64x4 {
    f64x4::new(std::array::from_fn(value_of_lane))
}

/// Returns a mask of SIMD lanes: all bits are set in the first `lane_count` lanes, and none in the others.
pub(crate) fn first_lanes_mask(lane_count: usize) -> f64x4 {
    from_lanes(|lane_index| if lane_index < lane_count { f64::from_bits(u64::MAX) } else { 0.0 })
}

/// Returns ln of positive normal numbers, by the same operations as `libm::log`. FreeBSD's e_log.c explains the algorithm.
#[inline(always)]
pub(crate) fn ln(x: f64x4) -> f64x4 {
    /// Upper 32 bits of √2/2, the lower limit of the reduced mantissa.
    const HALF_SQRT_2: u64 = 0x3fe6_a09e << 32;
    const BITS_OF_ONE: u64 = 0x3ff0_0000 << 32;
    const TWO_52: f64 = 4_503_599_627_370_496.0;
    let shifted_bits = x.to_bits() + u64x4::splat(BITS_OF_ONE - HALF_SQRT_2);
    let biased_exponent = f64x4::from_bits((shifted_bits >> 52) | u64x4::splat(TWO_52.to_bits()));
    let binary_exponent = biased_exponent - (TWO_52 + 1023.0);
    let f = f64x4::from_bits((shifted_bits & u64x4::splat((1 << 52) - 1)) + u64x4::splat(HALF_SQRT_2)) - 1.0;
    let half_f_squared = 0.5 * f * f;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even_terms = w * (LOG_COEFFICIENTS[1] + w * (LOG_COEFFICIENTS[3] + w * LOG_COEFFICIENTS[5]));
    let odd_terms = z
        * (LOG_COEFFICIENTS[0]
            + w * (LOG_COEFFICIENTS[2] + w * (LOG_COEFFICIENTS[4] + w * LOG_COEFFICIENTS[6])));
    s * (half_f_squared + (odd_terms + even_terms)) + binary_exponent * LN_2_PARTS[1] - half_f_squared
        + f
        + binary_exponent * LN_2_PARTS[0]
}

#[expect(clippy::excessive_precision, reason = "the digits as published")]
const LN_2_PARTS: [f64; 2] = [6.931_471_803_691_238_164_90e-1, 1.908_214_929_270_587_700_02e-10];
#[expect(clippy::excessive_precision, reason = "the digits as published")]
const LOG_COEFFICIENTS: [f64; 7] = [
    6.666_666_666_666_735_130e-1,
    3.999_999_999_940_941_908e-1,
    2.857_142_874_366_239_149e-1,
    2.222_219_843_214_978_396e-1,
    1.818_357_216_161_805_012e-1,
    1.531_383_769_920_937_332e-1,
    1.479_819_860_511_658_591e-1,
];

/// Maximum angle (rad) that is reduced with [`PI_PARTS`], which give π to 119 bits. The first two parts of π have 33 bits, so that their
/// products with integers of up to 20 bits are exact. Larger angles, which robots do not reach, are reduced by `libm`.
const MAX_REDUCED_ANGLE: f64 = 3e6;
const PI_PARTS: [f64; 3] = [3.141_592_653_468_251_2, 1.215_420_101_260_793_2e-10, 4.044_532_497_591_901e-21];

/// Constant that rounds a number to an integer, if it is added and then subtracted. Twice the constant rounds to an even number.
pub(crate) const ROUND_TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// Returns the number of times that π is subtracted from each angle x so that the remainder is within ±π/2.
#[inline(always)]
fn half_circle_count(x: f64x4) -> f64x4 {
    // Angles within ±π/2 stay as they are: at ±π/2, a rounded quotient might be ±1.
    let is_angle_small = x.abs().simd_le(f64x4::splat(FRAC_PI_2));
    is_angle_small.bitselect(f64x4::splat(0.0), x * FRAC_1_PI + ROUND_TO_INTEGER - ROUND_TO_INTEGER)
}

#[inline(always)]
fn subtract_half_circles(x: f64x4, half_circles: f64x4) -> f64x4 {
    PI_PARTS.iter().fold(x, |angle_so_far, pi_part| angle_so_far - half_circles * *pi_part)
}

/// Coefficients of sin √z/√z, from the lowest power up. The first is 1. The others approximate (sin √z/√z − 1)/z on [0, π²/4] by Remez's
/// exchange, with an error of 1.2e-16.
const SINC_COEFFICIENTS: [f64; 8] = [
    1.0,
    -0.166_666_666_666_662_6,
    0.008_333_333_333_291_249,
    -0.000_198_412_698_265_324_68,
    2.755_731_677_658_774_5e-6,
    -2.505_189_090_803_250_8e-8,
    1.604_841_188_107_557e-10,
    -7.377_031_323_962_015e-13,
];
/// Coefficients of cos √z, from the lowest power up. The coefficients after the 1 fit (cos √z − 1)/z on [0, π²/4] by Remez's exchange, with
/// an error of 4e-18.
const COS_COEFFICIENTS: [f64; 9] = [
    1.0,
    -0.499_999_999_999_999_83,
    0.041_666_666_666_664_37,
    -0.001_388_888_888_878_559,
    2.480_158_727_913_788e-5,
    -2.755_731_652_415_701_6e-7,
    2.087_656_768_481_087e-9,
    -1.146_303_784_775_884_9e-11,
    4.610_277_553_701_395_6e-14,
];
