//! Monte Carlo rollouts: many robots drive one command repeatedly, four at a time. Sums after each step give mean and covariance.

use super::settings::Settings;
use crate::geom::lanes::{LANE_COUNT, SinCos, Trigonometry, first_lanes_mask, is_any_lane_set};
use crate::geom::se2::SE2;
use crate::models::{PolarMotion, TangentNoiseModel};
use crate::noise::{NoiseKind, draw_four_uniform_triples};
use crate::sim::cloud::drive::MAX_SHORT_FORMULA_ANGLE;
use crate::stats::non_negative;
use crate::stats::sums::{CompensatedSums, add_to_block};
use nalgebra::{Matrix3, Vector3};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::collections::TryReserveError;
use wide::f64x4;

/// Number of groups of four robots in a block. A block is driven through all steps before the next block; its 256 robots take 8 kB. The
/// compensated sums of each block would take noticeable time in smaller blocks. Larger blocks would not fit into the first-level cache.
const GROUPS_PER_BLOCK: usize = 64;
pub const ROLLOUTS_PER_BLOCK: usize = GROUPS_PER_BLOCK * LANE_COUNT;

/// Number of the summed powers and products of ξ = (a, l, h): a, l, h; their squares, cubes and fourth powers; al, ah, lh.
const SUMMED_TERM_COUNT: usize = 15;

/// Step of a robot, as a change of its error pose e = x̄⁻¹·x: e_k = exp(−τ)·e_{k−1}·exp(τ + w)·(a turn by γ̂Δt). The numbers do not grow
/// with the path, so that they keep their digits.
#[derive(Clone, Copy, Debug)]
struct StepInErrorFrame {
    /// Mean and standard deviation of the length of the arc (m) and of half its turn (rad).
    length: [f64; 2],
    half_turn: [f64; 2],
    half_last_turn_std: f64,
    step_end: [f64x4; 2],
    sin: f64,
    cos: f64,
    trigonometry: Trigonometry,
}

#[derive(Clone, Copy)]
struct ErrorPoses {
    x: f64x4,
    y: f64x4,
    half_heading: f64x4,
    sin: f64x4,
    cos: f64x4,
}

/// Moments of the robots after one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredMoments {
    /// Mean of ξ = x_k ⊟ x̄_k in the order (along, lateral, heading): m, m, rad.
    pub mean: Vector3<f64>,
    /// Sample covariance of ξ, 3 × 3.
    pub cov: Matrix3<f64>,
    /// Relative standard errors of the variances along, lateral and heading, from the fourth moments: √((κ − 1)/n). NaN for a variance of
    /// 0.
    pub relative_error: Vector3<f64>,
}

/// Maximum number of robots in the picture, because more dots would not be distinguishable. A pose takes 24 bytes.
pub const MAX_SHOWN_ROBOTS: usize = 600;

#[derive(Clone, Debug)]
pub struct Rollouts {
    step_in_error_frame: StepInErrorFrame,
    seed: u64,
    /// Random generator of the next block. Each block has its own stream of numbers, and a longer path continues that stream. The first
    /// steps of a robot therefore depend on the seed alone.
    block_rng: Xoshiro256PlusPlus,
    driven_count: usize,
    sums_by_step: Vec<CompensatedSums<SUMMED_TERM_COUNT>>,
    /// Commanded pose after each step.
    pub nominal_poses: Vec<SE2>,
    /// Poses x, y (m) and θ (rad) of the first robots, step after step.
    poses: Vec<[f64; 3]>,
}

impl StepInErrorFrame {
    fn new(settings: &Settings) -> Self {
        let PolarMotion { length: length_lanes, bearing: bearing_lanes, last_turn, .. } =
            PolarMotion::of_velocity(&settings.model(), &settings.command);
        let trigonometry = Trigonometry::default();
        let mean_sin_cos = trigonometry.sin_cos(f64x4::splat(bearing_lanes[0]));
        let chord_length = f64x4::splat(length_lanes[0]) * mean_sin_cos.sinc;
        let (sin, cos) = libm::sincos(2.0 * bearing_lanes[0]);
        Self {
            length: length_lanes,
            half_turn: bearing_lanes,
            half_last_turn_std: 0.5 * last_turn[1],
            step_end: [chord_length * mean_sin_cos.cos, chord_length * mean_sin_cos.sin],
            sin,
            cos,
            trigonometry,
        }
    }

    /// Drives four robots by one step, and returns their exponential coordinates ξ.
    #[inline(always)]
    fn drive_one_step(&self, error_poses: &mut ErrorPoses, unit_noise: &[f64x4; 3]) -> [f64x4; 3] {
        let length_lanes = unit_noise[0] * self.length[1] + self.length[0];
        let turn_noise = unit_noise[1] * self.half_turn[1];
        let SinCos { sinc, sin, cos } = self.trigonometry.sin_cos(turn_noise + self.half_turn[0]);
        let chord_length = length_lanes * sinc;
        // The bearing of the chord is the heading of the robot plus half the turn of its arc.
        let heading_sin = 2.0 * error_poses.sin * error_poses.cos;
        let heading_cos = 1.0 - 2.0 * error_poses.sin * error_poses.sin;
        let x = error_poses.x + chord_length * (heading_cos * cos - heading_sin * sin) - self.step_end[0];
        let y = error_poses.y + chord_length * (heading_sin * cos + heading_cos * sin) - self.step_end[1];
        let half_turn = error_poses.half_heading + (turn_noise + unit_noise[2] * self.half_last_turn_std);
        let is_outside_short_formula =
            is_any_lane_set(half_turn.abs().simd_gt(f64x4::splat(MAX_SHORT_FORMULA_ANGLE)));
        let (half_heading, SinCos { sinc, sin, cos }) = if is_outside_short_formula {
            self.trigonometry.sin_cos_on_branch(half_turn, 0.0)
        } else {
            (half_turn, self.trigonometry.sin_cos_small_angle(half_turn))
        };
        let h_cot_h = cos / sinc;
        let (x, y) = (x * self.cos + y * self.sin, y * self.cos - x * self.sin);
        *error_poses = ErrorPoses { x, y, half_heading, sin, cos };
        [h_cot_h * x + half_heading * y, h_cot_h * y - half_heading * x, half_heading * 2.0]
    }
}

impl Rollouts {
    /// Creates rollouts without robots. Fails with [`TryReserveError`] if memory does not suffice for the robots in the picture.
    pub fn new(settings: &Settings) -> Result<Self, TryReserveError> {
        let step_count = settings.steps as usize;
        let mut poses = Vec::new();
        poses.try_reserve_exact(step_count * MAX_SHOWN_ROBOTS)?;
        poses.resize(step_count * MAX_SHOWN_ROBOTS, [0.0; 3]);
        let twist = TangentNoiseModel::twist(&settings.command);
        Ok(Self {
            step_in_error_frame: StepInErrorFrame::new(settings),
            seed: settings.seed,
            block_rng: Xoshiro256PlusPlus::seed_from_u64(settings.seed),
            driven_count: 0,
            sums_by_step: vec![CompensatedSums::new(); step_count],
            nominal_poses: (1..=step_count).map(|k| SE2::exp(&(twist * k as f64))).collect(),
            poses,
        })
    }

    /// Drives blocks of robots, as many complete blocks as `target_count` robots contain. If more robots have been driven already, driving
    /// starts again from the first block. [`Rollouts::measured_moments`] drives the remaining robots.
    pub fn drive_blocks_to(&mut self, target_count: usize) {
        if target_count < self.driven_count {
            self.block_rng = Xoshiro256PlusPlus::seed_from_u64(self.seed);
            self.driven_count = 0;
            self.sums_by_step.fill(CompensatedSums::new());
        }
        while self.driven_count + ROLLOUTS_PER_BLOCK <= target_count {
            let mut sums = std::mem::take(&mut self.sums_by_step);
            self.drive_next_block(ROLLOUTS_PER_BLOCK, &mut sums);
            self.sums_by_step = sums;
            self.block_rng.jump();
            self.driven_count += ROLLOUTS_PER_BLOCK;
        }
    }

    /// Returns the moments of `target_count` robots after each step. Robots of the last, incomplete block are driven again.
    pub fn measured_moments(&mut self, target_count: usize) -> Vec<MeasuredMoments> {
        let moments_of = |sums: &[CompensatedSums<SUMMED_TERM_COUNT>]| {
            sums.iter().map(|sums| moments_from_sums(&sums.totals(), target_count as f64)).collect()
        };
        if target_count == self.driven_count {
            return moments_of(&self.sums_by_step);
        }
        let mut sums = self.sums_by_step.clone();
        self.drive_next_block(target_count - self.driven_count, &mut sums);
        moments_of(&sums)
    }

    #[inline(never)]
    fn drive_next_block(&mut self, robot_count: usize, sums: &mut [CompensatedSums<SUMMED_TERM_COUNT>]) {
        let Self { step_in_error_frame: error_step, block_rng, driven_count, nominal_poses, poses, .. } =
            self;
        let mut robot_block = RobotBlock::new(block_rng.clone());
        for (k, (sums, nominal_poses)) in sums.iter_mut().zip(nominal_poses).enumerate() {
            robot_block.drive_one_step(error_step);
            for (i, xi) in robot_block.noise_or_xi.iter().enumerate() {
                let remaining_robot_count = robot_count.saturating_sub(LANE_COUNT * i);
                if remaining_robot_count >= LANE_COUNT {
                    add_to_sums(sums, *xi);
                } else {
                    let lane_mask = first_lanes_mask(remaining_robot_count);
                    add_to_sums(sums, xi.map(|lane_values| lane_values & lane_mask));
                }
            }
            sums.flush_block();
            let robot_poses =
                poses[k * MAX_SHOWN_ROBOTS..][..MAX_SHOWN_ROBOTS].iter_mut().skip(*driven_count);
            for (i, pose) in robot_poses.take(ROLLOUTS_PER_BLOCK).enumerate() {
                *pose = robot_block.groups[i / LANE_COUNT].pose(i % LANE_COUNT, nominal_poses);
            }
        }
    }

    /// Returns x, y (m) and θ (rad) of the first `robot_count` robots, at most [`MAX_SHOWN_ROBOTS`], after step `step_number` (from 1).
    pub fn poses(&self, step_number: usize, robot_count: usize) -> &[[f64; 3]] {
        &self.poses[(step_number - 1) * MAX_SHOWN_ROBOTS..][..robot_count.min(MAX_SHOWN_ROBOTS)]
    }

    /// Returns x, y (m) and θ (rad) of one robot after each step.
    pub fn rollout(&self, robot_index: usize) -> Vec<[f64; 3]> {
        let mut block_rng = Xoshiro256PlusPlus::seed_from_u64(self.seed);
        (0..robot_index / ROLLOUTS_PER_BLOCK).for_each(|_| block_rng.jump());
        let (group_index, lane_index) =
            (robot_index % ROLLOUTS_PER_BLOCK / LANE_COUNT, robot_index % LANE_COUNT);
        let mut robot_block = RobotBlock::new(block_rng);
        let pose_after = |nominal_pose| {
            robot_block.drive_one_step(&self.step_in_error_frame);
            robot_block.groups[group_index].pose(lane_index, nominal_pose)
        };
        self.nominal_poses.iter().map(pose_after).collect()
    }
}

impl ErrorPoses {
    fn pose(&self, lane_index: usize, nominal_pose: &SE2) -> [f64; 3] {
        let [x, y, half_heading] =
            [self.x, self.y, self.half_heading].map(|lane_values| lane_values.to_array()[lane_index]);
        (*nominal_pose * SE2::new(x, y, 2.0 * half_heading)).into()
    }
}

struct RobotBlock {
    rng: Xoshiro256PlusPlus,
    groups: [ErrorPoses; GROUPS_PER_BLOCK],
    /// Random numbers of each step. The exponential coordinates ξ after the step replace them.
    noise_or_xi: [[f64x4; 3]; GROUPS_PER_BLOCK],
}

impl RobotBlock {
    fn new(rng: Xoshiro256PlusPlus) -> Self {
        let [zeros, one_lanes] = [0.0, 1.0].map(f64x4::splat);
        let zero_errors = ErrorPoses { x: zeros, y: zeros, half_heading: zeros, sin: zeros, cos: one_lanes };
        Self { rng, groups: [zero_errors; GROUPS_PER_BLOCK], noise_or_xi: [[zeros; 3]; GROUPS_PER_BLOCK] }
    }

    #[inline(never)]
    fn drive_one_step(&mut self, error_step: &StepInErrorFrame) {
        let Self { rng, groups, noise_or_xi } = self;
        noise_or_xi.iter_mut().for_each(|robot_noise| *robot_noise = draw_four_uniform_triples(rng));
        NoiseKind::Normal.replace_by_quantiles(noise_or_xi.as_flattened_mut());
        for (error_poses, robot_noise) in groups.iter_mut().zip(noise_or_xi) {
            *robot_noise = error_step.drive_one_step(error_poses, robot_noise);
        }
    }
}

#[inline(always)]
fn add_to_sums(sums: &mut CompensatedSums<SUMMED_TERM_COUNT>, [a, l, h]: [f64x4; 3]) {
    let [aa, ll, hh] = [a * a, l * l, h * h];
    let power_products =
        [a, l, h, aa, ll, hh, a * aa, l * ll, h * hh, aa * aa, ll * ll, hh * hh, a * l, a * h, l * h];
    add_to_block(&mut sums.block_sums, power_products);
}

/// Minimum number of robots whose kurtosis is reliable enough for standard errors of variances.
const MIN_RELIABLE_COUNT: f64 = 30.0;

fn moments_from_sums(sums: &[f64; SUMMED_TERM_COUNT], n: f64) -> MeasuredMoments {
    let [a, l, h, aa, ll, hh, .., al, ah, lh] = sums.map(|product_sum| product_sum / n);
    let mean = Vector3::new(a, l, h);
    let mut covariance = Matrix3::new(aa, al, ah, al, ll, lh, ah, lh, hh) - mean * mean.transpose();
    for i in 0..3 {
        covariance[(i, i)] = non_negative(covariance[(i, i)]);
    }
    let relative_error = Vector3::from_fn(|i, _| {
        let [m, mean_square, mean_cube, mean_fourth] = [0, 3, 6, 9].map(|k| sums[k + i] / n);
        let second_moment = covariance[(i, i)];
        let fourth_moment =
            mean_fourth - 4.0 * m * mean_cube + 6.0 * m * m * mean_square - 3.0 * m * m * m * m;
        let kurtosis =
            if second_moment > 0.0 { fourth_moment / (second_moment * second_moment) } else { f64::NAN };
        let kurtosis_error = non_negative(kurtosis - 1.0) / n;
        // The kurtosis of a few robots is unreliable; for two robots it is always 1. Therefore the standard error is at least that of a
        // normal distribution. `f64::max` would hide a NaN.
        let gaussian_error = if n < MIN_RELIABLE_COUNT { 2.0 / (n - 1.0) } else { 0.0 };
        if kurtosis_error < gaussian_error { gaussian_error.sqrt() } else { kurtosis_error.sqrt() }
    });
    MeasuredMoments { mean, cov: covariance * (n / (n - 1.0)), relative_error }
}
