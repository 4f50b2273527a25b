//! Dead Reckoning: growth of the uncertainty while a command is driven repeatedly, and predictions of the uncertainty by recursions.

mod rollouts;
mod settings;

pub use rollouts::{MAX_SHOWN_ROBOTS, MeasuredMoments};
pub use settings::*;

use super::cloud::views::nearest_index;
use super::cloud_simulation::cloud_simulation;
use super::settings::{AllowedValues, SettingRules, SettingsError};
use crate::geom::se2::SE2;
use crate::js::js_structs;
use crate::models::{
    Compounding, PolarMotion, TangentNoiseModel, VelocityAlphas, VelocityCmd, VelocityModel, covariance_root,
};
use crate::noise::NoiseKind;
use crate::stats::{Ellipse, ExactMoments, ExponentialContour, ExponentialMoments};
use nalgebra::{Matrix2, Matrix3, Vector3};
use rollouts::{ROLLOUTS_PER_BLOCK, Rollouts};

/// Number of chords of an outline. Fewer chords would have visible corners; more chords would be shorter than a pixel.
const OUTLINE_SEGMENTS: usize = 96;

const MAX_CHORDS: usize = 16;

/// Number of steps, summed over all robots, that are driven in the first block and in each further block. While a handle is dragged, each
/// frame waits for the first block. Further blocks take some milliseconds.
const FIRST_BLOCK_STEPS: usize = 80_000;
const STEPS_PER_BLOCK: usize = 200_000;

/// Simulation of the Dead Reckoning widget: settings, rollouts, and predictions of the recursions.
#[derive(Clone, Debug)]
pub struct DeadReckoning {
    settings: Settings,
    rollouts: Rollouts,
    shown_count: usize,
    predicted_covariances: [Vec<Option<Matrix3<f64>>>; 3],
    measured_moments: Vec<MeasuredMoments>,
    comparisons: [RecursionComparison; 3],
}

/// Statistics of the robots driven, and comparison with the recursions. They are NaN if undefined.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), tsify(rename = "ReckoningStats"))]
pub struct Stats {
    /// Number of robots driven.
    pub n: usize,
    /// Moments of ξ (m, m, rad) about the commanded pose, after the selected step.
    pub measured: ExponentialMoments,
    /// Predicted covariance after the selected step; null (None) if the recursion gives no covariance at this step.
    #[cfg_attr(target_arch = "wasm32", tsify(type = "ByRecursion<number[][] | null>"))]
    pub predicted: ByRecursion<Option<CovarianceRows>>,
    /// Steps with a wrong predicted variance (misses), for the components along, lateral and heading.
    pub misses: ByRecursion<[Misses; 3]>,
}

/// Values for each of the recursions in [`RECURSIONS`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), serde(rename_all = "kebab-case"))]
pub struct ByRecursion<T> {
    /// Value that the chapter's recursion predicts.
    pub chapter: T,
    /// Value that the propagation of first order predicts.
    pub first_order: T,
    /// Value that the propagation of fourth order predicts.
    pub fourth_order: T,
}

/// Covariance matrix as a list of its rows.
pub type CovarianceRows = [[f64; 3]; 3];

js_structs! {
    /// 2σ outlines after a step as x, y pairs, the first point repeated at the end; empty if the recursion gives no covariance at this
    /// step.
    #[derive(Clone, Debug, PartialEq)]
    pub struct StepOutlines {
        /// Outline of the predicted Gaussian in (x, y), m, as in a filter that estimates x, y and θ.
        pub ellipse: Vec<[f64; 2]> as "Float64Array",
        /// Outline in the plane of the predicted Gaussian in exponential coordinates about the commanded pose, m.
        pub exponential: Vec<[f64; 2]> as "Float64Array",
        /// Outline of the predicted Gaussian in (ξ along, ξ lateral), m.
        pub predicted: Vec<[f64; 2]> as "Float64Array",
        /// Outline of the robots' covariance in (ξ along, ξ lateral), m.
        pub measured: Vec<[f64; 2]> as "Float64Array",
    }

    /// Robots and outlines after a step.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Milestone {
        /// x, y (m) and θ (rad) of the robots in the picture.
        pub poses: Vec<[f64; 3]> as "Float64Array",
        /// Outlines by the selected recursion.
        pub outlines: StepOutlines,
    }
}

cloud_simulation!(DeadReckoning);

impl DeadReckoning {
    fn new_empty(settings: Settings) -> Result<Self, SettingsError> {
        let mut rollouts = Rollouts::new(&settings).map_err(|_| SettingsError {
            key: "steps".to_owned(),
            value: f64::from(settings.steps),
            allowed: AllowedValues::FitsInMemory,
        })?;
        let predicted_covariances =
            RECURSIONS.map(|compounding| propagate_covariances(&settings, compounding));
        let measured_moments = rollouts.measured_moments(0);
        let comparisons = compare_recursions(&settings, &predicted_covariances, &measured_moments);
        Ok(Self { settings, rollouts, shown_count: 0, predicted_covariances, measured_moments, comparisons })
    }

    /// Changes the settings and drives the first block of `target_count` robots. [`DeadReckoning::add_samples`] drives the remaining
    /// robots. Robots are kept if the change does not affect them. Errors are those of [`DeadReckoning::new`], and change nothing.
    pub fn configure_first(&mut self, settings: Settings, target_count: usize) -> Result<(), SettingsError> {
        settings.check()?;
        if self.settings.has_same_rollouts(&settings) {
            self.settings = settings;
        } else {
            *self = Self::new_empty(settings)?;
        }
        self.show_samples(
            target_count
                .min(settings.samples)
                .min(self.block_size_for_steps(FIRST_BLOCK_STEPS).max(self.shown_count)),
        );
        Ok(())
    }

    fn show_samples(&mut self, sample_count: usize) {
        if sample_count == self.shown_count {
            return;
        }
        self.rollouts.drive_blocks_to(sample_count);
        self.shown_count = sample_count;
        self.measured_moments = self.rollouts.measured_moments(sample_count);
        self.comparisons =
            compare_recursions(&self.settings, &self.predicted_covariances, &self.measured_moments);
    }

    /// Returns the number of robots that are driven within a few milliseconds.
    pub fn block_size(&self) -> usize {
        self.block_size_for_steps(STEPS_PER_BLOCK)
    }

    fn block_size_for_steps(&self, step_budget: usize) -> usize {
        (step_budget / self.settings.steps as usize).next_multiple_of(ROLLOUTS_PER_BLOCK)
    }

    /// Returns the number of robots driven.
    pub fn shown_count(&self) -> usize {
        self.shown_count
    }

    /// Returns the moments of the robots after each step, from step 1.
    pub fn measured_moments(&self) -> &[MeasuredMoments] {
        &self.measured_moments
    }

    /// Returns the covariance that a recursion predicts after each step; None from the step on at which the covariance is undefined.
    pub fn predicted_covariances(&self, compounding: Compounding) -> &[Option<Matrix3<f64>>] {
        &self.predicted_covariances[compounding as usize]
    }

    /// Returns the comparison of a recursion's predicted variances with those of the robots.
    pub fn comparison(&self, compounding: Compounding) -> &RecursionComparison {
        &self.comparisons[compounding as usize]
    }

    /// Returns the commanded pose after each step.
    pub fn nominal_poses(&self) -> &[SE2] {
        &self.rollouts.nominal_poses
    }

    /// Returns x, y (m) and θ (rad) of the robots in the picture, [`MAX_SHOWN_ROBOTS`] at most, after a step; empty where there is
    /// no such step.
    pub fn poses(&self, step: u32) -> &[[f64; 3]] {
        let Self { settings, rollouts, shown_count, .. } = self;
        let is_step_valid = (1..=settings.steps).contains(&step);
        if is_step_valid { rollouts.poses(step as usize, *shown_count) } else { &[] }
    }

    /// Returns ξ = x_k ⊟ x̄_k of the robots in the picture after the selected step: along (m), lateral (m), heading (rad).
    pub fn twists(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        let step = self.settings.step;
        let nominal_pose = self.nominal_poses()[step as usize - 1];
        self.poses(step).iter().map(move |pose| SE2::from(*pose).boxminus(&nominal_pose).into())
    }

    /// Returns x, y (m) and θ (rad) of one robot after each step; None if the index is too large.
    pub fn rollout(&self, robot_index: usize) -> Option<Vec<[f64; 3]>> {
        (robot_index < self.shown_count).then(|| self.rollouts.rollout(robot_index))
    }

    /// Returns the robot in the picture that is nearest to a point (m) after the selected step, within `search_radius`.
    pub fn find_nearest(&self, target_point: [f64; 2], search_radius: f64) -> Option<usize> {
        let robot_positions = self.poses(self.settings.step).iter().map(|[x, y, _]| [*x, *y]);
        nearest_index(robot_positions, target_point, [search_radius, search_radius])
    }

    /// Returns the moments and predicted covariances after the selected step, and for each recursion the steps at which a predicted
    /// variance is wrong.
    pub fn stats(&self) -> Stats {
        let step_index = self.settings.step as usize - 1;
        let MeasuredMoments { mean, cov, .. } = self.measured_moments()[step_index];
        Stats {
            n: self.shown_count(),
            measured: ExponentialMoments { mean, cov },
            predicted: evaluate_recursions(|compounding| {
                self.predicted_covariances(compounding)[step_index].map(Into::into)
            }),
            misses: evaluate_recursions(|compounding| self.comparison(compounding).misses),
        }
    }

    /// Returns the variances of a straight drive as functions of its duration (exercise 2), with the speed and noise of the current
    /// settings. Each duration is one command.
    pub fn straight_growth(&self) -> StraightGrowth {
        let Settings { command: VelocityCmd { v, .. }, alphas, .. } = self.settings;
        let [alpha1, _, alpha3, ..] = alphas;
        let velocity_model = VelocityModel { alphas: VelocityAlphas(alphas), noise: NoiseKind::Normal };
        let [first_tenth, last_tenth] = LOG10_DURATIONS_IN_TENTHS;
        let drive_durations: Vec<f64> =
            (first_tenth..=last_tenth).map(|i| libm::pow(10.0, f64::from(i) / 10.0)).collect();
        let exact_variances = drive_durations.iter().map(|dt| {
            let straight_motion =
                PolarMotion::of_velocity(&velocity_model, &VelocityCmd { v, omega: 0.0, dt: *dt });
            let cov = ExactMoments::new(&straight_motion).cov;
            (cov[(0, 0)], cov[(1, 1)])
        });
        let (along_variances, across_variances) = exact_variances.unzip();
        let crossing_time = 2.0 / v.abs() * (alpha1 / alpha3).sqrt();
        StraightGrowth {
            along: along_variances,
            across: across_variances,
            along_first_order: drive_durations.iter().map(|dt| alpha1 * v * v * dt * dt).collect(),
            // To first order, an arc of length vΔt that turns by a small φ ends ½vΔt·φ to the side.
            across_first_order: (drive_durations.iter())
                .map(|dt| alpha3 * v * v * dt * dt * (0.5 * v * dt) * (0.5 * v * dt))
                .collect(),
            durations: drive_durations,
            crossing: (crossing_time.is_finite() && crossing_time > 0.0).then_some(crossing_time),
        }
    }

    /// Returns the noise-free path of the command, as x, y pairs from the start.
    pub fn commanded_path(&self) -> Vec<[f64; 2]> {
        let Settings { command: step_command, steps: step_count, .. } = self.settings;
        let twist = TangentNoiseModel::twist(&step_command);
        // Chords of 0.1 rad look like the arc, because they deviate from it by 1/800 of their length.
        let chords_per_step = ((twist.z.abs() * 10.0).ceil() as usize).clamp(1, MAX_CHORDS);
        (0..=chords_per_step * step_count as usize)
            .map(|i| SE2::exp(&(twist * (i as f64 / chords_per_step as f64))).position())
            .collect()
    }

    /// Returns the robots and outlines after each quarter of the path, except at the selected step. A path of fewer than four steps gives
    /// fewer entries.
    pub fn milestones(&self) -> Vec<Milestone> {
        let Settings { step: selected_step, steps: step_count, .. } = self.settings;
        let mut quarter_end_steps: Vec<u32> = (1..=4)
            .map(|quarter_number| ((f64::from(quarter_number * step_count) / 4.0).round() as u32).max(1))
            .collect();
        quarter_end_steps.dedup();
        quarter_end_steps.retain(|step_number| *step_number != selected_step);
        let milestone_of_step = |step_number| {
            Some(Milestone { poses: self.poses(step_number).to_vec(), outlines: self.outlines(step_number)? })
        };
        quarter_end_steps.into_iter().filter_map(milestone_of_step).collect()
    }

    /// Returns the outlines after a step, by the selected recursion; None if there is no such step.
    pub fn outlines(&self, step: u32) -> Option<StepOutlines> {
        let step_index = (step as usize).checked_sub(1)?;
        let nominal_pose = self.nominal_poses().get(step_index)?;
        let MeasuredMoments { mean, cov, .. } = &self.measured_moments()[step_index];
        let measured = if self.shown_count() < 2 { vec![] } else { xi_ellipse_outline(mean, cov) };
        let Some(cov) = self.predicted_covariances(self.settings.compounding)[step_index] else {
            return Some(StepOutlines { ellipse: vec![], exponential: vec![], predicted: vec![], measured });
        };
        let xi_moments = ExponentialMoments { mean: Vector3::zeros(), cov };
        let (sin, cos) = libm::sincos(nominal_pose.theta());
        let heading_rotation = Matrix2::new(cos, -sin, sin, cos);
        let position_cov = heading_rotation * cov.fixed_view::<2, 2>(0, 0) * heading_rotation.transpose();
        let position_ellipse = Ellipse::new(nominal_pose.position().into(), position_cov);
        Some(StepOutlines {
            ellipse: position_ellipse.boundary(OUTLINE_SEGMENTS),
            exponential: ExponentialContour::new(&xi_moments, nominal_pose).boundary(OUTLINE_SEGMENTS),
            predicted: xi_ellipse_outline(&Vector3::zeros(), &cov),
            measured,
        })
    }
}

fn compare_recursions(
    settings: &Settings,
    predicted: &[Vec<Option<Matrix3<f64>>>; 3],
    measured: &[MeasuredMoments],
) -> [RecursionComparison; 3] {
    predicted.each_ref().map(|predicted_covs| RecursionComparison::new(settings, predicted_covs, measured))
}

fn evaluate_recursions<T>(evaluate_recursion: impl Fn(Compounding) -> T) -> ByRecursion<T> {
    let [chapter, first_order, fourth_order] = RECURSIONS.map(evaluate_recursion);
    ByRecursion { chapter, first_order, fourth_order }
}

fn xi_ellipse_outline(mean: &Vector3<f64>, cov: &Matrix3<f64>) -> Vec<[f64; 2]> {
    Ellipse::new(mean.xy(), cov.fixed_view::<2, 2>(0, 0).into_owned()).boundary(OUTLINE_SEGMENTS)
}

/// Recursions whose predictions are compared with the robots, in the order in which the widget lists them.
pub const RECURSIONS: [Compounding; 3] =
    [Compounding::Chapter, Compounding::FirstOrder, Compounding::FourthOrder];

/// Relative error of a predicted variance above which the prediction at this step is wrong (a miss).
pub const MISS_TOLERANCE: f64 = 0.05;

/// Maximum relative standard error of a measured variance at which wrong predictions can be recognized: a quarter of [`MISS_TOLERANCE`]. By
/// chance, some of the dozens of variance ratios deviate by three standard errors, but hardly any by four.
const MAX_STANDARD_ERROR: f64 = MISS_TOLERANCE / 4.0;

/// Standard deviation, relative to the length of the path or in radians, below which a measured spread counts as rounding error.
const NEGLIGIBLE_STD: f64 = 1e-12;

/// Comparison of the variances that a recursion predicts with those of the robots.
#[derive(Clone, Debug, PartialEq)]
pub struct RecursionComparison {
    /// Predicted divided by measured variance of along, lateral and heading after each step; NaN if either variance is undefined.
    pub ratios: Vec<Vector3<f64>>,
    /// Steps with a wrong predicted variance, for along, lateral and heading.
    pub misses: [Misses; 3],
}

js_structs! {
    /// Steps at which the predicted variance of a component differs from the measured variance by more than 5 % (misses).
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Misses {
        /// True if the spread of the robots is above 0, and there are enough robots to recognize wrong predictions.
        pub decidable: bool,
        /// Number of the first step with a wrong prediction; null (None) if there is none, or if wrong predictions cannot be recognized.
        pub first: Option<u32>,
        /// Number of the last step with a wrong prediction; null (None) as for `first`.
        pub last: Option<u32>,
        /// Predicted divided by measured variance after the last step, minus 1; NaN without a prediction or a measured spread.
        pub end: f64,
        /// Standard error of the relative error `end`.
        pub error: f64,
    }
}

impl RecursionComparison {
    /// Compares the predicted with the measured covariances after each step. `None` stands for a step at which the recursion has no
    /// covariance, because its matrix is indefinite.
    fn new(settings: &Settings, predicted: &[Option<Matrix3<f64>>], measured: &[MeasuredMoments]) -> Self {
        let u = &settings.command;
        let negligible_length = NEGLIGIBLE_STD * (u.v * u.dt).abs() * f64::from(settings.steps);
        let negligible_stds = [negligible_length, negligible_length, NEGLIGIBLE_STD];
        let ratios_of = |cov: Option<Matrix3<f64>>, measured: &MeasuredMoments| {
            Vector3::from_fn(|i, _| {
                let measured_variance = measured.cov[(i, i)];
                let has_spread = measured_variance > negligible_stds[i] * negligible_stds[i];
                cov.filter(|_| has_spread).map_or(f64::NAN, |cov| cov[(i, i)] / measured_variance)
            })
        };
        let ratios: Vec<_> =
            predicted.iter().zip(measured).map(|(cov, measured)| ratios_of(*cov, measured)).collect();
        let interval_misses = std::array::from_fn(|component| find_misses(&ratios, measured, component));
        Self { ratios, misses: interval_misses }
    }
}

/// Returns the covariance of ξ that a recursion predicts after each step, from step 1. The start is known exactly. The covariance is None
/// from the step at which the fourth-order terms make it indefinite.
fn propagate_covariances(settings: &Settings, compounding: Compounding) -> Vec<Option<Matrix3<f64>>> {
    let twist = TangentNoiseModel::twist(&settings.command);
    // `ok` hides no error: `from_velocity` succeeds for all allowed settings, because their variances are finite and not negative.
    let tangent_noise = TangentNoiseModel::from_velocity(&settings.model(), &settings.command).ok();
    let mut predicted_cov = Some(Matrix3::zeros());
    (0..settings.steps)
        .map(|_| {
            predicted_cov = predicted_cov
                .zip(tangent_noise)
                .map(|(sigma, tangent_noise)| tangent_noise.propagate(&sigma, &twist, compounding))
                .filter(|next_sigma| covariance_root(next_sigma).is_ok());
            predicted_cov
        })
        .collect()
}

fn find_misses(ratios: &[Vector3<f64>], measured: &[MeasuredMoments], component: usize) -> Misses {
    let defined_ratios =
        || ratios.iter().map(|ratio| ratio[component]).zip(measured).filter(|(ratio, _)| !ratio.is_nan());
    let is_decidable = defined_ratios().next().is_some()
        && defined_ratios().all(|(_, measured)| measured.relative_error[component] <= MAX_STANDARD_ERROR);
    let is_miss = |ratio: &Vector3<f64>| is_decidable && (ratio[component] - 1.0).abs() > MISS_TOLERANCE;
    let step_number_of = |index: usize| index as u32 + 1;
    let [end, error] = match (ratios.last(), measured.last()) {
        (Some(ratio), Some(measured)) => {
            [ratio[component] - 1.0, ratio[component] * measured.relative_error[component]]
        }
        _ => [f64::NAN; 2],
    };
    Misses {
        decidable: is_decidable,
        first: ratios.iter().position(is_miss).map(step_number_of),
        last: ratios.iter().rposition(is_miss).map(step_number_of),
        end,
        error,
    }
}

/// Decimal logarithms, in tenths, of the first and last duration of the curves: 0.1 s to 10 s. For common settings, the duration at which
/// the variances along and across the track are equal is in this range. Smaller intervals would not make the curves look smoother.
const LOG10_DURATIONS_IN_TENTHS: [i32; 2] = [-10, 10];

js_structs! {
    /// Variances of the end of a straight drive, as functions of its duration.
    #[derive(Clone, Debug, PartialEq)]
    pub struct StraightGrowth {
        /// Durations Δt (s) in equal logarithmic steps.
        pub durations: Vec<f64> as "Float64Array",
        /// Exact variances along the track, m².
        pub along: Vec<f64> as "Float64Array",
        /// Exact variances across the track, m².
        pub across: Vec<f64> as "Float64Array",
        /// Variances along the track to first order in the noise, m²: α₁v²Δt².
        pub along_first_order: Vec<f64> as "Float64Array",
        /// Variances across the track to first order in the noise, m²: ¼α₃v⁴Δt⁴.
        pub across_first_order: Vec<f64> as "Float64Array",
        /// Duration (s) at which the variances along and across the path are equal to first order: (2/|v|)·√(α₁/α₃). Null (None) if they never
        /// are.
        pub crossing: Option<f64>,
    }
}
