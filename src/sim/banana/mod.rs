//! The Banana Machine: samples of the end pose after one command from the origin.

mod settings;
mod stats;

pub use settings::*;
use stats::DefinedCoordinates;
pub use stats::{Contours, Coverage, Sample, Stats, Table, TableColumn};

use super::cloud::drive::NoisyDrive;
use super::cloud::picture::{self, Ramp};
use super::cloud::views::{ViewGrid, nearest_index};
use super::cloud::{Cloud, START_POSE};
use super::cloud_simulation::cloud_simulation;
use super::settings::{SettingRules, SettingsError};
use crate::geom::arc::{Arc, ArcInversion, arc_with_turn_near};
use crate::geom::lanes::LANE_COUNT;
use crate::geom::se2::SE2;
use crate::geom::unbend::find_arc;
use crate::models::{
    ConfiguredOdometry, MotionModel, OdomAlphas, OdomDelta, OdometryModel, PolarMotion, RotTransRot,
    TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel,
};
use crate::stats::{
    CartesianMoments, Ellipse, ExactGain, ExactMoments, ExponentialContour, ExponentialMoments,
    LikelihoodGain,
};
use nalgebra::{Matrix2, Matrix3, Vector3};
use std::array;
use std::f64::consts::TAU;
use wide::f64x4;

impl Settings {
    fn polar_motion(&self, command: &VelocityCmd) -> PolarMotion {
        match self.model_with_input(*command) {
            ModelWithInput::Velocity(model, command) => PolarMotion::of_velocity(&model, &command),
            ModelWithInput::Odometry(model, odometry_reading) => {
                PolarMotion::of_odometry(&model, &odometry_reading, command.omega * command.dt)
            }
        }
    }

    /// Returns the selected model with its input: the command, or the odometry reading of noise-free wheels for the command.
    fn model_with_input(&self, command: VelocityCmd) -> ModelWithInput {
        match self.model {
            ModelKind::Velocity => {
                let alphas = VelocityAlphas(self.effective_alphas(self.velocity_alphas));
                ModelWithInput::Velocity(VelocityModel { alphas, noise: self.noise }, command)
            }
            ModelKind::Odometry => {
                let alphas = OdomAlphas(self.effective_alphas(self.odometry_alphas));
                let odometry_reading = OdomDelta::from_poses(&START_POSE, &command_end(&command));
                let model = OdometryModel { alphas, noise: self.noise };
                ModelWithInput::Odometry(
                    ConfiguredOdometry { model, reverse_aware: self.reverse_aware },
                    odometry_reading,
                )
            }
        }
    }
}

enum ModelWithInput {
    Velocity(VelocityModel, VelocityCmd),
    Odometry(ConfiguredOdometry, OdomDelta),
}

impl ModelWithInput {
    fn executed_motion(&self, unit_noise: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Velocity(model, command) => {
                let ArcInversion { v_hat, omega_hat, gamma_hat } = model.executed_motion(command, unit_noise);
                [v_hat, omega_hat, gamma_hat]
            }
            Self::Odometry(model, odometry_reading) => {
                let OdomDelta { rot1, trans, rot2 } = model.executed_motion(odometry_reading, unit_noise);
                [rot1, trans, rot2]
            }
        }
    }

    fn linearized_cov(&self) -> Matrix3<f64> {
        match self {
            Self::Velocity(model, command) => model.cartesian_cov(command, &START_POSE),
            Self::Odometry(model, odometry_reading) => model.cartesian_cov(odometry_reading, &START_POSE),
        }
    }
}

/// Returns the command whose end pose is drawn at the point (x, y) of the picture, with the duration of `near_command`. `morph` is the
/// stage of the transition from the plane (0) to exponential coordinates (1). In the plane many arcs lead to a point. The arc with the turn
/// nearest to the turn of `near_command` is taken. At other stages the search starts at `near_command`, which is returned if there is no
/// solution.
pub fn command_drawn_at([x, y]: [f64; 2], near_command: &VelocityCmd, morph: f64) -> VelocityCmd {
    let VelocityCmd { v, omega, dt } = *near_command;
    let found_arc = if morph == 0.0 {
        Some(arc_with_turn_near(&START_POSE, &SE2::new(x, y, 0.0), omega * dt).into())
    } else {
        find_arc([x, y], [v * dt, omega * dt], morph)
    };
    found_arc.map_or(*near_command, |[length, turn]| VelocityCmd { v: length / dt, omega: turn / dt, dt })
}

fn command_end(command: &VelocityCmd) -> SE2 {
    SE2::exp(&TangentNoiseModel::twist(command))
}

/// Minimum distance of the mean turn from a full circle, in standard deviations, at which exponential coordinates count as defined. At a
/// full circle the coordinates diverge. With a smaller distance, single samples of a large cloud would dominate the moments.
const MIN_SIGMAS_TO_FULL_CIRCLE: f64 = 4.0;

/// Maximum number of points of a curve of the exact skew. As each point takes about ten microseconds, a curve takes at most 0.1 s.
pub const MAX_CURVE_POINTS: u64 = 10_000;

/// Standard deviation (m) in x and y of additive noise, the model that the chapter argues against: x_t = x̄ + ε with the noise-free end x̄.
/// It is √(½ tr Σ) on the arc of the preset "gentle", rounded. For other distances the standard deviation would differ.
pub const ADDITIVE_NOISE_STD: f64 = 0.2;

/// Number of samples of the first block. A device four times slower than a laptop computes and draws them in a few milliseconds.
const FIRST_BLOCK_SAMPLES: usize = 10_000;

/// Number of chords of an outline. The sagitta of 128 chords is 0.03 % of the radius, a fifth of a pixel on the largest screen.
pub const OUTLINE_SEGMENTS: usize = 128;

/// Simulation of the Banana Machine widget: settings, random numbers, and the cloud shown.
#[derive(Clone, Debug)]
pub struct BananaMachine {
    settings: Settings,
    cloud: Cloud,
    stats: Stats,
    picture_pixels: Vec<[u8; 4]>,
}

cloud_simulation!(BananaMachine);

impl BananaMachine {
    fn new_empty(settings: Settings) -> Result<Self, SettingsError> {
        let noisy_drive = NoisyDrive::new(&settings.polar_motion(&settings.command));
        let mut cloud = Cloud::new(settings.seed, settings.noise, noisy_drive);
        cloud.reserve(settings.samples).map_err(|_| SettingsError::out_of_memory(settings.samples))?;
        let cloud_stats = cloud.drive_and_summarize(settings.seed, settings.noise, noisy_drive, 0);
        let stats = Stats::of_cloud(0, &cloud_stats, DefinedCoordinates { pose: false, arc: false });
        Ok(Self { settings, cloud, stats, picture_pixels: Vec::new() })
    }

    /// Changes the settings and shows the first block of `target_count` samples. [`BananaMachine::add_samples`] shows the remaining
    /// samples. Errors are those of [`BananaMachine::new`], and change nothing.
    pub fn configure_first(&mut self, settings: Settings, target_count: usize) -> Result<(), SettingsError> {
        settings.check()?;
        self.cloud.reserve(settings.samples).map_err(|_| SettingsError::out_of_memory(settings.samples))?;
        self.settings = settings;
        self.show_samples(target_count.min(settings.samples).min(FIRST_BLOCK_SAMPLES));
        Ok(())
    }

    fn show_samples(&mut self, sample_count: usize) {
        let Settings { seed, noise: noise_kind, command, .. } = self.settings;
        let noisy_drive = NoisyDrive::new(&self.settings.polar_motion(&command));
        let cloud_stats = self.cloud.drive_and_summarize(seed, noise_kind, noisy_drive, sample_count);
        self.stats = Stats::of_cloud(sample_count, &cloud_stats, self.defined_coordinates());
    }

    /// Returns the number of samples that can be added within a few milliseconds. Adding a block needs new sums over all samples. Therefore
    /// a block is as large as the cloud shown, and at least four times as large as the first block.
    pub fn block_size(&self) -> usize {
        self.shown_count().max(4 * FIRST_BLOCK_SAMPLES)
    }

    /// Returns the number of samples shown.
    pub fn shown_count(&self) -> usize {
        self.cloud.shown_count
    }

    /// Returns the samples shown, in sample order.
    pub fn poses(&self) -> impl ExactSizeIterator<Item = SE2> {
        (0..self.shown_count()).map(|index| self.cloud.pose(index))
    }

    /// Returns the exponential coordinates of the samples shown (along, lateral, heading), on the branch of the
    /// logarithm that belongs to the commanded turn.
    pub fn twists(&self) -> impl ExactSizeIterator<Item = Vector3<f64>> {
        self.poses().map(|pose| self.twist(&pose))
    }

    fn twist(&self, pose: &SE2) -> Vector3<f64> {
        let VelocityCmd { omega, dt, .. } = self.settings.command;
        pose.log_near(omega * dt)
    }

    /// Returns the statistics of the samples shown.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// Returns true if the robots turn by less than a full circle, so that exponential coordinates are defined. Otherwise statistics and
    /// contours in these coordinates are undefined.
    pub fn is_exponential_defined(&self) -> bool {
        self.defined_coordinates().pose
    }

    fn defined_coordinates(&self) -> DefinedCoordinates {
        let VelocityCmd { omega, dt, .. } = self.settings.command;
        let is_defined = |std: f64| (omega * dt).abs() + MIN_SIGMAS_TO_FULL_CIRCLE * std < TAU;
        DefinedCoordinates {
            pose: is_defined(self.cloud.drive.turn_std()),
            arc: is_defined(self.cloud.drive.arc_turn_std()),
        }
    }

    /// Returns the model's mean τ and covariance R_u in exponential coordinates. The heading variance includes the variance of the final
    /// turn. None for the odometry model, whose noise is not additive in these coordinates.
    pub fn tangent_moments(&self) -> Option<ExponentialMoments> {
        match self.settings.model_with_input(self.settings.command) {
            ModelWithInput::Velocity(model, command) => {
                let [.., gamma_variance] = model.variances(&command);
                let mut cov = model.tangent_cov(&command)?;
                cov[(2, 2)] += command.dt * command.dt * gamma_variance.0;
                Some(ExponentialMoments { mean: TangentNoiseModel::twist(&command), cov })
            }
            ModelWithInput::Odometry(..) => None,
        }
    }

    /// Returns the mean and covariance that an EKF predicts by linearization: the noise-free end pose, and J·Σ·Jᵀ with the Jacobian J of
    /// the motion and the covariance Σ of its noise.
    pub fn linearized_moments(&self) -> CartesianMoments {
        let end_pose = command_end(&self.settings.command);
        CartesianMoments {
            mean: Vector3::new(end_pose.x(), end_pose.y(), end_pose.theta()),
            cov: self.settings.model_with_input(self.settings.command).linearized_cov(),
        }
    }

    /// Returns the exact moments of the model, by quadrature.
    pub fn exact_moments(&self) -> ExactMoments {
        ExactMoments::new(&self.settings.polar_motion(&self.settings.command))
    }

    /// Returns the exact likelihood gain of exponential coordinates, and their exact moments, by quadrature.
    pub fn exact_gain(&self) -> ExactGain {
        ExactGain::new(&self.settings.polar_motion(&self.settings.command))
    }

    /// Returns linearized, exact and measured moments of the pose, and the model's moments of its exponential coordinates.
    pub fn table(&self) -> Table {
        let linearized = self.linearized_moments();
        let Stats { cartesian: cartesian_moments, cross_track_skew, likelihood_gain, area_ratio, .. } =
            self.stats;
        Table {
            // The linearization is a Gaussian in (x, y, θ), which has no skew. Its likelihood gain is 0, because to first order in the
            // noise the Gaussians in all coordinate systems are the same.
            linearized: TableColumn {
                mean: linearized.mean,
                cov: linearized.cov,
                cross_track_skew: 0.0,
                likelihood_gain: LikelihoodGain { pose: 0.0, floor: 0.0 },
                area_ratio: 1.0,
            },
            exact: self.exact_column(),
            measured: TableColumn {
                mean: cartesian_moments.mean,
                cov: cartesian_moments.cov,
                cross_track_skew,
                likelihood_gain,
                area_ratio,
            },
            tangent: self.tangent_moments(),
        }
    }

    #[inline(never)]
    fn exact_column(&self) -> TableColumn {
        let (ExactMoments { mean, cov, cross_track_skew }, exact_gain) =
            (self.exact_moments(), self.exact_gain());
        let exact_ellipse = Ellipse::from_moments(&CartesianMoments { mean, cov });
        let exact_contour = ExponentialContour::new(&exact_gain.exponential_moments, &START_POSE);
        let area_ratio = exact_contour.area_ratio(&exact_ellipse, OUTLINE_SEGMENTS);
        TableColumn { mean, cov, cross_track_skew, likelihood_gain: exact_gain.likelihood_gain, area_ratio }
    }

    /// Returns the exact cross-track skew at `point_count` evenly spaced turn rates from `first_omega` to `last_omega` (rad/s), with all
    /// other settings unchanged.
    pub fn skew_curve(&self, first_omega: f64, last_omega: f64, point_count: usize) -> Vec<f64> {
        let omega_step = (last_omega - first_omega) / (point_count.max(2) - 1) as f64;
        (0..point_count)
            .map(|i| {
                let omega = first_omega + omega_step * i as f64;
                let command = VelocityCmd { omega, ..self.settings.command };
                ExactMoments::new(&self.settings.polar_motion(&command)).cross_track_skew
            })
            .collect()
    }

    /// Returns the commanded arc, and the 2σ outlines of the fitted and predicted Gaussians.
    pub fn contours(&self) -> Contours {
        let Stats { cartesian: cartesian_moments, exponential: exponential_moments, .. } = &self.stats;
        let outline_or_empty = |is_defined: bool, outline_points: Vec<[f64; 2]>| {
            if is_defined { outline_points } else { Vec::new() }
        };
        let has_outlines = self.shown_count() > 1;
        let has_exponential = has_outlines && self.is_exponential_defined();
        let VelocityCmd { v, omega, dt } = self.settings.command;
        let contour = ExponentialContour::new(exponential_moments, &START_POSE);
        let (linearized, additive_variance) =
            (self.linearized_moments(), ADDITIVE_NOISE_STD * ADDITIVE_NOISE_STD);
        Contours {
            command: arc_points(v * dt, omega * dt),
            ellipse: outline_or_empty(
                has_outlines,
                Ellipse::from_moments(cartesian_moments).boundary(OUTLINE_SEGMENTS),
            ),
            linearized: Ellipse::from_moments(&linearized).boundary(OUTLINE_SEGMENTS),
            exponential: outline_or_empty(has_exponential, contour.boundary(OUTLINE_SEGMENTS)),
            twist_ellipse: outline_or_empty(has_exponential, contour.ellipse.boundary(OUTLINE_SEGMENTS)),
            additive: Ellipse::new(linearized.mean.xy(), Matrix2::from_diagonal_element(additive_variance))
                .boundary(OUTLINE_SEGMENTS),
        }
    }

    /// Returns the shown sample with the given index, from 0; None if fewer samples are shown.
    pub fn inspect(&self, index: usize) -> Option<Sample> {
        let pose = (index < self.shown_count()).then(|| self.cloud.pose(index))?;
        let model_with_input = self.settings.model_with_input(self.settings.command);
        let executed_motion = model_with_input.executed_motion(self.cloud.draws.noise_of_sample(index));
        let ([v_hat, omega_hat, gamma_hat], legs, path_points) = match model_with_input {
            ModelWithInput::Velocity(_, VelocityCmd { dt, .. }) => {
                (executed_motion, None, arc_points(executed_motion[0] * dt, executed_motion[1] * dt))
            }
            ModelWithInput::Odometry(..) => {
                let [rot1, trans, rot2] = executed_motion;
                let path_points = vec![START_POSE.position(), pose.position()];
                ([f64::NAN; 3], Some(OdomDelta { rot1, trans, rot2 }), path_points)
            }
        };
        let (pose, twist) = (pose.into(), self.twist(&pose).into());
        Some(Sample { pose, twist, v_hat, omega_hat, gamma_hat, legs, path: path_points })
    }

    /// Returns the executed motions of the samples shown: v̂ (m/s), ω̂ and γ̂ (rad/s). Under the odometry model they are
    /// δ̂_rot1 (rad), δ̂_trans (m) and δ̂_rot2 (rad).
    pub fn executed_motions(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        let model_with_input = self.settings.model_with_input(self.settings.command);
        (0..self.shown_count())
            .map(move |index| model_with_input.executed_motion(self.cloud.draws.noise_of_sample(index)))
    }

    /// Returns the noise-free odometry reading of the command.
    pub fn reading(&self) -> OdomDelta {
        OdomDelta::from_poses(&START_POSE, &command_end(&self.settings.command))
    }

    /// Counts the shown samples in each cell of a grid over a picture: see [`picture::count_samples_in_cells`].
    pub fn density(&self, morph: f64, view_grid: &ViewGrid) -> Vec<u32> {
        picture::count_samples_in_cells(&self.cloud, morph, view_grid)
    }

    /// Paints the density of the shown samples: see [`picture::paint_cell_counts`].
    pub fn paint_picture(&mut self, morph: f64, view_grid: &ViewGrid, colour_ramp: &Ramp) -> &[[u8; 4]] {
        let cell_counts = self.density(morph, view_grid);
        self.picture_pixels =
            picture::paint_cell_counts(cell_counts.as_chunks().0, array::from_ref(colour_ramp));
        &self.picture_pixels
    }

    /// Returns the shown sample nearest to a point of the picture, inside the ellipse of the given radii around it.
    pub fn find_nearest(&self, morph: f64, target_point: [f64; 2], search_radii: [f64; 2]) -> Option<usize> {
        let points_of_group = |[x, y]: [f64x4; 2]| {
            let (x, y) = (x.to_array(), y.to_array());
            (0..LANE_COUNT).map(move |lane_index| [x[lane_index], y[lane_index]])
        };
        nearest_index(self.cloud.point_groups(morph).flat_map(points_of_group), target_point, search_radii)
    }
}

fn arc_points(length: f64, turn: f64) -> Vec<[f64; 2]> {
    Arc { start: START_POSE, length, turn }.points()
}
