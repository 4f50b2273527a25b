//! Quantile function of the normal distribution: Wichura, Algorithm AS 241, Applied Statistics 37 (1988), in its double
//! precision form PPND16.
#![expect(clippy::excessive_precision, reason = "the digits as published")]

use crate::geom::lanes::{LANE_COUNT, from_lanes, is_any_lane_set, ln};
use std::ops::{Add, Div, Mul};
use wide::{bytemuck, f64x4};

const CENTRE_HALF_WIDTH: f64 = 0.425;

/// Returns Φ⁻¹(½ + q) by PPND16 of AS 241. It is a rational function of degree 7 over 7 in each of three ranges.
#[inline(never)]
pub(super) fn normal_quantile(q: f64) -> f64 {
    if q.abs() <= CENTRE_HALF_WIDTH {
        let r = 0.180_625 - q * q;
        return q * rational_function(r, &CENTRE_NUMERATOR, &CENTRE_DENOMINATOR);
    }
    let r = (-libm::log(0.5 - q.abs())).sqrt();
    let tail_quantile = if r <= 5.0 {
        rational_function(r - 1.6, &MIDDLE_NUMERATOR, &MIDDLE_DENOMINATOR)
    } else {
        rational_function(r - 5.0, &FAR_NUMERATOR, &FAR_DENOMINATOR)
    };
    tail_quantile.copysign(q)
}

/// Number of SIMD vectors in a chunk, from which the numbers in the tails are gathered into full vectors. Smaller chunks would leave more
/// vectors incomplete. The 1024 numbers of a chunk take 10 kB of stack.
pub(super) const CHUNK_VECTORS: usize = 256;

/// Replaces each number q of a chunk by Φ⁻¹(½ + q), with the same bits as [`normal_quantile`]. One number in seven is in a tail, and every
/// second vector contains one. Gathering these numbers into full vectors saves most of their cost, and avoids unpredictable branches.
pub(super) fn replace_chunk_by_quantiles(centred_probabilities: &mut [f64x4]) {
    let mut tail_numbers = [0.0; LANE_COUNT * CHUNK_VECTORS + LANE_COUNT];
    let mut tail_indices = [0u16; LANE_COUNT * CHUNK_VECTORS + LANE_COUNT];
    let mut tail_count = 0;
    for (vector_index, q) in centred_probabilities.iter_mut().enumerate() {
        let tail_mask = q.abs().simd_gt(f64x4::splat(CENTRE_HALF_WIDTH)).to_bitmask();
        for (lane_index, lane_probability) in q.to_array().into_iter().enumerate() {
            // Storing every number avoids a branch. Only numbers in a tail advance `tail_count`; other numbers are overwritten.
            tail_numbers[tail_count] = lane_probability;
            tail_indices[tail_count] = (LANE_COUNT * vector_index + lane_index) as u16;
            tail_count += (tail_mask >> lane_index & 1) as usize;
        }
        let r = f64x4::splat(0.180_625) - *q * *q;
        *q *= rational_function(r, &CENTRE_NUMERATOR, &CENTRE_DENOMINATOR);
    }
    let chunk_numbers: &mut [f64] = bytemuck::cast_slice_mut(centred_probabilities);
    for (tail_vector, vector_indices) in
        tail_numbers[..tail_count].chunks(LANE_COUNT).zip(tail_indices[..tail_count].chunks(LANE_COUNT))
    {
        let tail_quantiles =
            tail_quantile_lanes(from_lanes(|lane_index| *tail_vector.get(lane_index).unwrap_or(&0.45)));
        for (number_index, tail_quantile) in vector_indices.iter().zip(tail_quantiles.to_array()) {
            chunk_numbers[usize::from(*number_index)] = tail_quantile;
        }
    }
}

#[inline(always)]
fn tail_quantile_lanes(q: f64x4) -> f64x4 {
    let r = (-ln(f64x4::splat(0.5) - q.abs())).sqrt();
    if is_any_lane_set(r.simd_gt(f64x4::splat(5.0))) {
        return q.to_array().map(normal_quantile).into();
    }
    rational_function(r - 1.6, &MIDDLE_NUMERATOR, &MIDDLE_DENOMINATOR).copysign(q)
}

#[inline(always)]
fn rational_function<T>(r: T, numerator_coefficients: &[f64; 8], denominator_coefficients: &[f64; 8]) -> T
where
    T: Copy + From<f64> + Mul<Output = T> + Add<f64, Output = T> + Div<Output = T>,
{
    evaluate_by_horner(r, numerator_coefficients) / evaluate_by_horner(r, denominator_coefficients)
}

#[inline(always)]
fn evaluate_by_horner<T>(r: T, polynomial_coefficients: &[f64; 8]) -> T
where
    T: Copy + From<f64> + Mul<Output = T> + Add<f64, Output = T>,
{
    let highest_coefficient = T::from(polynomial_coefficients[7]);
    polynomial_coefficients[..7].iter().rev().fold(highest_coefficient, |sum_so_far, c| sum_so_far * r + *c)
}

const CENTRE_NUMERATOR: [f64; 8] = [
    3.387_132_872_796_366_608,
    1.331_416_678_917_843_774_5e2,
    1.971_590_950_306_551_442_7e3,
    1.373_169_376_550_946_112_5e4,
    4.592_195_393_154_987_145_7e4,
    6.726_577_092_700_870_085_3e4,
    3.343_057_558_358_812_810_5e4,
    2.509_080_928_730_122_672_7e3,
];
const CENTRE_DENOMINATOR: [f64; 8] = [
    1.0,
    4.231_333_070_160_091_125_2e1,
    6.871_870_074_920_579_083e2,
    5.394_196_021_424_751_107_7e3,
    2.121_379_430_158_659_586_7e4,
    3.930_789_580_009_271_061e4,
    2.872_908_573_572_194_267_4e4,
    5.226_495_278_852_854_561e3,
];
const MIDDLE_NUMERATOR: [f64; 8] = [
    1.423_437_110_749_683_577_34,
    4.630_337_846_156_545_295_9,
    5.769_497_221_460_691_405_5,
    3.647_848_324_763_204_605_04,
    1.270_458_252_452_368_382_58,
    2.417_807_251_774_506_117_7e-1,
    2.272_384_498_926_918_458_33e-2,
    7.745_450_142_783_414_076_4e-4,
];
const MIDDLE_DENOMINATOR: [f64; 8] = [
    1.0,
    2.053_191_626_637_758_821_87,
    1.676_384_830_183_803_849_4,
    6.897_673_349_851_000_045_5e-1,
    1.481_039_764_274_800_745_9e-1,
    1.519_866_656_361_645_719_66e-2,
    5.475_938_084_995_344_946e-4,
    1.050_750_071_644_416_843_24e-9,
];
const FAR_NUMERATOR: [f64; 8] = [
    6.657_904_643_501_103_777_2,
    5.463_784_911_164_114_369_9,
    1.784_826_539_917_291_335_8,
    2.965_605_718_285_048_912_3e-1,
    2.653_218_952_657_612_309_3e-2,
    1.242_660_947_388_078_438_6e-3,
    2.711_555_568_743_487_578_15e-5,
    2.010_334_399_292_288_132_65e-7,
];
const FAR_DENOMINATOR: [f64; 8] = [
    1.0,
    5.998_322_065_558_879_376_9e-1,
    1.369_298_809_227_358_053_1e-1,
    1.487_536_129_085_061_485_25e-2,
    7.868_691_311_456_132_591e-4,
    1.846_318_317_510_054_681_8e-5,
    1.421_511_758_316_445_888_7e-7,
    2.044_263_103_389_939_785_64e-15,
];
