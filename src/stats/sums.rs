//! Sums of millions of terms, four at a time. Terms are summed in blocks without compensation. The sums of blocks are added to a total
//! whose rounding errors are compensated.

use crate::geom::lanes::split_into_lane_pairs;
use wide::{f64x2, f64x4};

#[derive(Clone, Debug)]
pub struct CompensatedSums<const N: usize> {
    /// Sums of the current block, which [`add_to_block`] increases.
    pub block_sums: [f64x2; N],
    total_sums: [f64x2; N],
    rounding_errors: [f64x2; N],
}

impl<const N: usize> CompensatedSums<N> {
    pub fn new() -> Self {
        let zero_sums = [f64x2::splat(0.0); N];
        Self { block_sums: zero_sums, total_sums: zero_sums, rounding_errors: zero_sums }
    }

    pub fn flush_block(&mut self) {
        flush_blocks(&mut self.block_sums, &mut self.total_sums, &mut self.rounding_errors);
    }

    pub fn totals(&self) -> [f64; N] {
        std::array::from_fn(|i| compensated_total(self.total_sums[i], self.rounding_errors[i]))
    }
}

/// Adds the sums of blocks to the totals, and the rounding errors of these additions to `rounding_errors` (Knuth's two-sum).
#[inline(never)]
fn flush_blocks(block_sums: &mut [f64x2], totals: &mut [f64x2], rounding_errors: &mut [f64x2]) {
    for ((block, total_sum), rounding_error) in block_sums.iter_mut().zip(totals).zip(rounding_errors) {
        let block_sum = std::mem::replace(block, f64x2::splat(0.0));
        let new_total = *total_sum + block_sum;
        let rounded_term = new_total - *total_sum;
        *rounding_error += (*total_sum - (new_total - rounded_term)) + (block_sum - rounded_term);
        *total_sum = new_total;
    }
}

#[inline(never)]
fn compensated_total(total_lanes: f64x2, compensation_lanes: f64x2) -> f64 {
    let ([a, b], [c, d]) = (total_lanes.to_array(), compensation_lanes.to_array());
    (a + b) + (c + d)
}

#[inline(always)]
pub fn add_to_block<const N: usize>(block: &mut [f64x2; N], summed_terms: [f64x4; N]) {
    for i in 0..N {
        let [lower_lanes, upper_lanes] = split_into_lane_pairs(summed_terms[i]);
        block[i] += lower_lanes + upper_lanes;
    }
}

/// Sums over pairs of numbers a and b: of a, b, a², a·b and b².
pub type PairSums = CompensatedSums<5>;

impl PairSums {
    pub fn add(&mut self, [a, b]: [f64x4; 2], lane_mask: f64x4) {
        let (a, b) = (a & lane_mask, b & lane_mask);
        add_to_block(&mut self.block_sums, [a, b, a * a, a * b, b * b]);
    }

    pub fn subtract(&mut self, [a, b]: [f64x4; 2], lane_mask: f64x4) {
        let (a, b) = (a & lane_mask, b & lane_mask);
        add_to_block(&mut self.block_sums, [-a, -b, -(a * a), -(a * b), -(b * b)]);
    }
}
