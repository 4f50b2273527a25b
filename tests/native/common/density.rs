//! Integrals of pose densities, and their comparison with samples.
//!
//! The coordinates are polar, around the start of the motion: signed distance c, bearing β in a half circle, and heading θ relative to
//! `heading_slope` · β. Their volume element is dx dy dθ = |c| dc dβ dθ. A density that grows as 1/|c| towards the start is smooth in these
//! coordinates. The slope is 2 for arcs, which turn by twice their bearing, and 1 for odometry legs, so that cells lie along the cloud.

use super::{SAMPLE_COUNT, chi_square_limit, seeded_rng};
use motion::MotionModel;
use motion::geom::se2::{SE2, wrap_angle};
use std::f64::consts::PI;

/// Nodes on (−1, 1) and weights of the eight-point Gauss–Legendre rule (Abramowitz and Stegun, table 25.4).
const GAUSS_LEGENDRE_RULE: [(f64, f64); 8] = [
    (-0.960_289_856_497_536, 0.101_228_536_290_376),
    (-0.796_666_477_413_627, 0.222_381_034_453_374),
    (-0.525_532_409_916_329, 0.313_706_645_877_887),
    (-0.183_434_642_495_650, 0.362_683_783_378_362),
    (0.183_434_642_495_650, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887),
    (0.796_666_477_413_627, 0.222_381_034_453_374),
    (0.960_289_856_497_536, 0.101_228_536_290_376),
];

/// Box of the polar coordinates (c, β, θ) of poses, divided into equal cells. The coordinates are defined at the top of this file.
pub struct PolarGrid {
    start_pose: SE2,
    heading_slope: f64,
    /// Middle of the box (c, β, θ). Poses in the box differ from it by at most a quarter turn in β and half a turn in θ.
    middle: [f64; 3],
    cell_size: [f64; 3],
    cell_counts: [usize; 3],
}

impl PolarGrid {
    pub fn new(
        start_pose: &SE2,
        middle_pose: &SE2,
        slope: f64,
        half_extent: [f64; 3],
        cell_counts: [usize; 3],
    ) -> Self {
        let (dx, dy) = (middle_pose.x() - start_pose.x(), middle_pose.y() - start_pose.y());
        let motion_bearing = if dx.hypot(dy) > 0.0 { dy.atan2(dx) } else { start_pose.theta() };
        let cell_centre = [dx.hypot(dy), motion_bearing, middle_pose.theta() - slope * motion_bearing];
        let cell_size = [0, 1, 2].map(|axis| 2.0 * half_extent[axis] / cell_counts[axis] as f64);
        Self { start_pose: *start_pose, heading_slope: slope, middle: cell_centre, cell_size, cell_counts }
    }

    pub fn around_start(start_pose: &SE2, slope: f64, max_distance: f64, cell_counts: [usize; 3]) -> Self {
        Self::new(start_pose, start_pose, slope, [max_distance, PI / 2.0, PI], cell_counts)
    }

    fn grid_coordinates_of(&self, pose: &SE2) -> [f64; 3] {
        let (dx, dy) = (pose.x() - self.start_pose.x(), pose.y() - self.start_pose.y());
        let bearing_offset = wrap_angle(dy.atan2(dx) - self.middle[1]);
        let (signed_distance, bearing_offset) = if bearing_offset.abs() <= PI / 2.0 {
            (dx.hypot(dy), bearing_offset)
        } else {
            (-dx.hypot(dy), bearing_offset - PI.copysign(bearing_offset))
        };
        let motion_bearing = self.middle[1] + bearing_offset;
        let heading_offset = wrap_angle(pose.theta() - self.heading_slope * motion_bearing - self.middle[2]);
        [signed_distance, motion_bearing, self.middle[2] + heading_offset]
    }

    fn lower_bound(&self, axis: usize, cell_index: usize) -> f64 {
        self.middle[axis] + (cell_index as f64 - 0.5 * self.cell_counts[axis] as f64) * self.cell_size[axis]
    }

    /// Returns the probability mass of each cell, by an 8 × 8 × 8 Gauss rule in each cell.
    pub fn cell_masses(&self, density_at: impl Fn(&SE2) -> f64) -> Vec<f64> {
        let nodes_and_weights_of = |axis: usize, cell_index: usize| {
            let (cell_lower_bounds, cell_size) = (self.lower_bound(axis, cell_index), self.cell_size[axis]);
            GAUSS_LEGENDRE_RULE.map(|(gauss_node, gauss_weight)| {
                (cell_lower_bounds + 0.5 * (1.0 + gauss_node) * cell_size, 0.5 * gauss_weight * cell_size)
            })
        };
        let mut cell_masses = Vec::with_capacity(self.cell_counts.iter().product());
        for i in 0..self.cell_counts[0] {
            for j in 0..self.cell_counts[1] {
                for k in 0..self.cell_counts[2] {
                    let mut probability_mass = 0.0;
                    for (c, c_weight) in nodes_and_weights_of(0, i) {
                        for (beta, beta_weight) in nodes_and_weights_of(1, j) {
                            let (x, y) =
                                (self.start_pose.x() + c * beta.cos(), self.start_pose.y() + c * beta.sin());
                            for (relative_heading, heading_weight) in nodes_and_weights_of(2, k) {
                                let pose = SE2::new(x, y, self.heading_slope * beta + relative_heading);
                                probability_mass +=
                                    c_weight * beta_weight * heading_weight * c.abs() * density_at(&pose);
                            }
                        }
                    }
                    cell_masses.push(probability_mass);
                }
            }
        }
        cell_masses
    }

    pub fn integrate_density(&self, density_at: impl Fn(&SE2) -> f64) -> f64 {
        self.cell_masses(density_at).iter().sum()
    }

    fn count_poses(&self, poses: &[SE2]) -> Vec<f64> {
        let mut pose_counts = vec![0.0; self.cell_counts.iter().product()];
        for pose in poses {
            let mut flat_index = Some(0);
            for (axis, grid_coordinate) in self.grid_coordinates_of(pose).into_iter().enumerate() {
                let cell_index =
                    ((grid_coordinate - self.lower_bound(axis, 0)) / self.cell_size[axis]).floor();
                let is_inside_grid = cell_index >= 0.0 && cell_index < self.cell_counts[axis] as f64;
                flat_index = flat_index
                    .filter(|_| is_inside_grid)
                    .map(|flat_index| flat_index * self.cell_counts[axis] + cell_index as usize);
            }
            if let Some(flat_index) = flat_index {
                pose_counts[flat_index] += 1.0;
            }
        }
        pose_counts
    }

    pub fn assert_samples_fit<M: MotionModel>(&self, model: &M, u: &M::Control, x: &SE2, seed: u64) {
        let mut rng = seeded_rng(seed);
        let poses: Vec<SE2> = (0..SAMPLE_COUNT).map(|_| model.sample(u, x, &mut rng)).collect();
        let (chi_square, chi_square_limit) =
            self.chi_square(&poses, |pose| model.pose_density(pose, u, x).expect("noise of full rank"));
        assert!(chi_square < chi_square_limit, "seed {seed}: χ² = {chi_square}, limit {chi_square_limit}");
    }

    /// Returns χ² of a sample against the density, and the limit that χ² exceeds with probability 1e-4. Everything outside the box is
    /// one cell, and so are the cells that expect fewer than 20 poses.
    ///
    /// If a kink of the triangular density crosses a cell, the Gauss rule has an error of about 1e-3 of its mass. With 10⁶
    /// samples that changes χ² by about 1, and the limit is above 100.
    fn chi_square(&self, poses: &[SE2], density_at: impl Fn(&SE2) -> f64) -> (f64, f64) {
        let n = poses.len() as f64;
        let mut observed_counts = self.count_poses(poses);
        let mut expected_counts: Vec<f64> =
            self.cell_masses(density_at).iter().map(|probability_mass| probability_mass * n).collect();
        observed_counts.push(n - observed_counts.iter().sum::<f64>());
        expected_counts.push(n - expected_counts.iter().sum::<f64>());
        let (sparse_cells, populated_cells): (Vec<_>, Vec<_>) = observed_counts
            .into_iter()
            .zip(expected_counts)
            .partition(|(_, expected_count)| *expected_count < 20.0);
        let pooled_cell =
            sparse_cells.iter().fold((0.0, 0.0), |(o, e), count_pair| (o + count_pair.0, e + count_pair.1));
        assert!(populated_cells.len() > 40, "{} cells test little", populated_cells.len());
        assert!(
            pooled_cell.1 > -1e-4 * n,
            "the density has more mass than 1: {} poses remain",
            pooled_cell.1
        );
        let chi_square_term_of = |(observed_count, expected_count): &(f64, f64)| {
            (observed_count - expected_count).powi(2) / expected_count
        };
        // The cell that pools all sparse cells is left out if it expects few poses, because the quadrature error may exceed their number.
        let pooled_term = if pooled_cell.1 >= 20.0 { chi_square_term_of(&pooled_cell) } else { 0.0 };
        (
            populated_cells.iter().map(chi_square_term_of).sum::<f64>() + pooled_term,
            chi_square_limit(populated_cells.len() + 1),
        )
    }
}
