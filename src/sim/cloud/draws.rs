//! Common random numbers: noise of variance 1 for every sample, drawn once for a seed.

use crate::geom::lanes::{LANE_COUNT, first_lanes_mask, is_any_lane_set};
use crate::noise::{NoiseKind, draw_four_uniform_triples};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::collections::TryReserveError;
use wide::f64x4;

/// Thresholds of the squared distance of a group of four robots: above the first the group counts as far, above the second as farthest,
/// otherwise as near. The squared distance of a robot is the sum of the squares of its three random numbers of variance 1. That of a group
/// is the largest of its four robots.
///
/// Standard errors are expensive, and therefore computed from a weighted subsample of the groups. A few distant robots may contribute most
/// of a variance, so that distant groups are sampled more densely. With Gaussian noise 1.8 % of the groups are far and 0.07 % farthest.
/// With triangular noise no group is farthest.
const FAR_SQUARED_DISTANCE: f64 = 13.0;
const FARTHEST_SQUARED_DISTANCE: f64 = 20.0;

/// Numbers of groups at the start of the cloud from which the subsample takes near, far and farthest groups. They are the first 2048
/// robots, the first 65 536, and all. With fewer groups the first digit of standard errors would be wrong; more groups would take time.
const SUBSAMPLE_GROUP_LIMITS: [usize; 3] = [512, 16_384, usize::MAX];

#[inline(never)]
fn subsample_group_limit([a, b, c]: &[f64x4; 3]) -> usize {
    let squared_distances = *a * *a + *b * *b + *c * *c;
    let distance_class = [FAR_SQUARED_DISTANCE, FARTHEST_SQUARED_DISTANCE]
        .iter()
        .filter(|threshold| is_any_lane_set(squared_distances.simd_gt(f64x4::splat(**threshold))))
        .count();
    SUBSAMPLE_GROUP_LIMITS[distance_class]
}

/// Common random numbers: three numbers of variance 1 for each sample, in sample order. They depend only on the seed and the kind of noise.
/// Therefore a slider moves the same robots, and a larger cloud begins with the robots of a smaller cloud. Normal and triangular noise are
/// quantiles of the same uniform numbers.
#[derive(Clone, Debug)]
pub struct Draws {
    seed: u64,
    noise_kind: NoiseKind,
    /// Generator with the same stream on every target, which `SmallRng` does not guarantee.
    rng: Xoshiro256PlusPlus,
    /// Three random numbers of variance 1 for each sample, in groups of four samples. The last group may contain numbers of samples beyond
    /// those requested.
    pub unit_noise: Vec<[f64x4; 3]>,
}

impl Draws {
    pub fn new(seed: u64, noise_kind: NoiseKind) -> Self {
        Self { seed, noise_kind, rng: Xoshiro256PlusPlus::seed_from_u64(seed), unit_noise: Vec::new() }
    }

    pub fn reserve(&mut self, sample_count: usize) -> Result<(), TryReserveError> {
        self.unit_noise
            .try_reserve_exact(sample_count.div_ceil(LANE_COUNT).saturating_sub(self.unit_noise.len()))
    }

    pub fn reset_if_changed(&mut self, seed: u64, noise: NoiseKind) {
        if self.seed != seed || self.noise_kind != noise {
            let unit_noise = std::mem::take(&mut self.unit_noise);
            *self = Self { unit_noise, ..Self::new(seed, noise) };
            self.unit_noise.clear();
        }
    }

    /// Draws random numbers of further samples until there are `sample_count` samples. Memory must have been reserved.
    pub fn extend_to(&mut self, sample_count: usize) {
        let Self { noise_kind: noise, rng, unit_noise, .. } = self;
        let (first_group, end_group) = (unit_noise.len(), sample_count.div_ceil(LANE_COUNT));
        while unit_noise.len() < end_group {
            unit_noise.push(draw_four_uniform_triples(rng));
        }
        noise.replace_by_quantiles(unit_noise.get_mut(first_group..).unwrap_or_default().as_flattened_mut());
    }

    /// Returns a weighted subsample of the first `sample_count` robots of the cloud, in groups of four: the random numbers of variance 1 of
    /// each robot, and its weight. The weight is the number of robots that the robot represents, and 0 for SIMD lanes beyond
    /// `sample_count`. All robots of a cloud of up to 2048 are in the subsample.
    pub fn weighted_subsample(&self, sample_count: usize) -> impl Iterator<Item = (&[f64x4; 3], f64x4)> {
        let group_count = sample_count.div_ceil(LANE_COUNT);
        self.unit_noise[..group_count].iter().enumerate().filter_map(move |(group_index, noise)| {
            let group_limit = subsample_group_limit(noise);
            let robot_weight = f64x4::splat((group_count as f64 / group_limit as f64).max(1.0));
            (group_index < group_limit)
                .then(|| (noise, robot_weight & first_lanes_mask(sample_count - LANE_COUNT * group_index)))
        })
    }

    pub fn noise_of_sample(&self, sample_index: usize) -> [f64; 3] {
        self.unit_noise[sample_index / LANE_COUNT]
            .map(|noise_lanes| noise_lanes.to_array()[sample_index % LANE_COUNT])
    }
}
