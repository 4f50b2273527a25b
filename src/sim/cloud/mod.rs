//! Cloud of robots that start at the origin: random numbers, end poses, and statistics.

pub(super) mod draws;
pub(super) mod drive;
pub mod picture;
pub mod views;

use crate::geom::lanes::{LANE_COUNT, first_lanes_mask};
use crate::geom::se2::SE2;
use crate::noise::NoiseKind;
use crate::stats::two_pass::{CloudStats, FirstPass, SecondPass};
use draws::Draws;
use drive::NoisyDrive;
use std::collections::TryReserveError;
use std::ops::Range;
use wide::f64x4;

/// Start pose of every robot: the origin, heading along x.
pub const START_POSE: SE2 = SE2::identity();

/// Number of groups of four that are summed without compensation of rounding errors (256 poses). With fewer groups, compensation would take
/// noticeable time; with more groups, the rounding error would grow in proportion.
const GROUPS_PER_BLOCK: usize = 64;

/// Cloud as a structure of arrays in groups of four samples. A sample takes 24 bytes of noise and 16 of position. Headings
/// and logarithms are cheap to compute, and not stored.
#[derive(Clone, Debug)]
pub struct Cloud {
    pub draws: Draws,
    pub drive: NoisyDrive,
    positions: Vec<[f64x4; 2]>,
    pub shown_count: usize,
}

impl Cloud {
    pub fn new(seed: u64, noise_kind: NoiseKind, drive: NoisyDrive) -> Self {
        Self { draws: Draws::new(seed, noise_kind), drive, positions: Vec::new(), shown_count: 0 }
    }

    pub fn reserve(&mut self, sample_count: usize) -> Result<(), TryReserveError> {
        self.draws.reserve(sample_count)?;
        let group_count = sample_count.div_ceil(LANE_COUNT);
        self.positions.try_reserve_exact(group_count.saturating_sub(self.positions.len()))
    }

    /// Drives the first `shown_count` samples, and returns the statistics of their end poses. Memory for the samples must be reserved.
    pub fn drive_and_summarize(
        &mut self,
        seed: u64,
        noise: NoiseKind,
        drive: NoisyDrive,
        shown_count: usize,
    ) -> CloudStats {
        self.draws.reset_if_changed(seed, noise);
        (self.drive, self.shown_count) = (drive, shown_count);
        // The sums contain differences from the expected mean. If the mean of the cloud is far from the expected mean, the first pass is
        // repeated.
        let (reference_point, jacobian_scale) = drive.nominal_coordinates();
        let mut first_pass = self.run_first_pass(FirstPass::new(reference_point, jacobian_scale));
        if let Some(better_point) = first_pass.better_reference_point(shown_count) {
            first_pass = self.run_first_pass(FirstPass::new(better_point, first_pass.jacobian_scale));
        }
        let regular_sums = drive.sums_of_regular_arc_deviations(first_pass.unit_noise.totals());
        let mut second_pass = SecondPass::new(first_pass.moments(shown_count, regular_sums), &START_POSE);
        for sample_block in blocks_of_samples(shown_count) {
            for (group_range, lane_mask) in sample_block {
                let noise = &self.draws.unit_noise[group_range.clone()];
                add_to_second_pass(&drive, noise, &self.positions[group_range], lane_mask, &mut second_pass);
            }
            second_pass.flush_block();
        }
        let weighted_robots = self.draws.weighted_subsample(shown_count).map(|(noise, robot_weights)| {
            let (poses, four_arcs) = drive.coordinates_of_four(noise);
            (poses, four_arcs, robot_weights)
        });
        second_pass.stats(shown_count, weighted_robots)
    }

    fn run_first_pass(&mut self, mut first_pass: FirstPass) -> FirstPass {
        let Self { draws, drive, positions, shown_count } = self;
        for sample_block in blocks_of_samples(*shown_count) {
            let end_group = sample_block[1].0.end;
            draws.extend_to(end_group * LANE_COUNT);
            if positions.len() < end_group {
                positions.resize(end_group, [f64x4::splat(0.0); 2]);
            }
            for (group_range, lane_mask) in sample_block {
                let noise = &draws.unit_noise[group_range.clone()];
                add_to_first_pass(drive, noise, &mut positions[group_range], lane_mask, &mut first_pass);
            }
            first_pass.flush_block();
        }
        first_pass
    }

    #[inline(always)]
    pub fn pose(&self, sample_index: usize) -> SE2 {
        let [group_index, lane_index] = [sample_index / LANE_COUNT, sample_index % LANE_COUNT];
        let [x, y] = self.positions[group_index].map(|four_lanes| four_lanes.to_array()[lane_index]);
        let half_heading = self.drive.compute_motions(&self.draws.unit_noise[group_index]).half_heading;
        SE2::new(x, y, 2.0 * half_heading.to_array()[lane_index])
    }

    /// Returns the points of the samples in a picture, in groups of four. `morph_fraction` is 0 for positions (x, y), and 1 for exponential
    /// coordinates (along, heading). In the last group, SIMD lanes without a sample are infinitely far away.
    #[inline(always)]
    pub fn point_groups(&self, morph_fraction: f64) -> impl Iterator<Item = [f64x4; 2]> {
        let points_of_group = move |group_index: usize| match morph_fraction {
            0.0 => self.positions[group_index],
            1.0 => {
                let four_motions = self.drive.compute_motions(&self.draws.unit_noise[group_index]);
                let poses = self.drive.poses(&four_motions, &self.positions[group_index]);
                [poses.along, poses.half_heading * 2.0]
            }
            _ => {
                let four_motions = self.drive.compute_motions(&self.draws.unit_noise[group_index]);
                self.drive.morphed_points(&four_motions, &self.positions[group_index], morph_fraction)
            }
        };
        let (full_groups, used_lane_count) = (self.shown_count / LANE_COUNT, self.shown_count % LANE_COUNT);
        let mask_points = move |point_lanes: f64x4| {
            first_lanes_mask(used_lane_count).bitselect(point_lanes, f64x4::splat(f64::INFINITY))
        };
        let last_group = (used_lane_count > 0).then(|| points_of_group(full_groups).map(mask_points));
        (0..full_groups).map(points_of_group).chain(last_group)
    }
}

/// Divides `sample_count` samples into blocks of groups of four, at least one block. Each block has two ranges of groups, each with its
/// mask of SIMD lanes: full groups of four samples, and groups with unused lanes.
fn blocks_of_samples(sample_count: usize) -> impl Iterator<Item = [(Range<usize>, f64x4); 2]> {
    let group_count = sample_count.div_ceil(LANE_COUNT);
    let lane_mask = first_lanes_mask(sample_count % LANE_COUNT);
    (0..group_count.div_ceil(GROUPS_PER_BLOCK).max(1)).map(move |i| {
        let (first_group, end_group) = (GROUPS_PER_BLOCK * i, group_count.min(GROUPS_PER_BLOCK * (i + 1)));
        let full_groups = first_group.max(end_group.min(sample_count / LANE_COUNT));
        [(first_group..full_groups, first_lanes_mask(LANE_COUNT)), (full_groups..end_group, lane_mask)]
    })
}

/// Drives the robots, four at a time, writes their end positions, and adds them to the sums of the first pass.
#[inline(never)]
fn add_to_first_pass(
    drive: &NoisyDrive,
    noise: &[[f64x4; 3]],
    end_points: &mut [[f64x4; 2]],
    lane_mask: f64x4,
    first_pass: &mut FirstPass,
) {
    let is_full_group = lane_mask.all();
    for (noise, end_points) in noise.iter().zip(end_points) {
        let four_motions = drive.compute_motions(noise);
        let (four_arcs, are_arcs_regular);
        (*end_points, four_arcs, are_arcs_regular) = drive.end_points(&four_motions);
        let poses = drive.poses(&four_motions, end_points);
        first_pass.add(&poses, [noise[0], noise[1]], lane_mask);
        if is_full_group {
            first_pass.multiply_jacobians(&poses, &four_arcs);
        } else {
            first_pass.multiply_masked_jacobians(&poses, &four_arcs, lane_mask);
        }
        if !are_arcs_regular {
            first_pass.add_irregular_arcs(&four_arcs, drive.regular_arc_deviations(noise), lane_mask);
        }
    }
}

#[inline(never)]
fn add_to_second_pass(
    drive: &NoisyDrive,
    noise: &[[f64x4; 3]],
    end_points: &[[f64x4; 2]],
    lane_mask: f64x4,
    second_pass: &mut SecondPass,
) {
    for (noise, end_points) in noise.iter().zip(end_points) {
        second_pass.add(&drive.poses(&drive.compute_motions(noise), end_points), lane_mask);
    }
}
