//! Dead Reckoning: growth of the uncertainty while a command is driven repeatedly, and predictions of it by recursions.

mod rollouts;
mod settings;
mod stats;
mod straight;

pub use rollouts::{MAX_SHOWN_ROBOTS, MeasuredMoments};
pub use settings::*;
pub use stats::{Comparison, MISS_TOLERANCE, Misses, RECURSIONS};
pub use straight::StraightGrowth;

use super::cloud::views::nearest_index;
use super::cloud_simulation::cloud_simulation;
use super::settings::{AllowedValues, Rules, SettingsError};
use crate::geom::se2::SE2;
use crate::js::js_structs;
use crate::models::{Compounding, TangentNoiseModel};
use crate::stats::{Ellipse, ExponentialContour, ExponentialMoments};
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use rollouts::{ROLLOUTS_PER_BLOCK, Rollouts};
use stats::propagate_covariances;

/// Number of chords of an outline. With fewer, corners would be visible; more would be shorter than a pixel.
const OUTLINE_SEGMENTS: usize = 96;

/// Maximum number of chords of the commanded arc in a step.
const MAX_CHORDS: usize = 16;

/// Number of steps of all robots in the first block, and in further blocks. While a handle is dragged, each frame waits for
/// the first block. Further blocks take some milliseconds.
const FIRST_BLOCK_STEPS: usize = 80_000;
const STEPS_PER_BLOCK: usize = 200_000;

/// Simulation of the widget: settings, rollouts, and predictions of the recursions.
#[derive(Clone, Debug)]
pub struct DeadReckoning {
    settings: Settings,
    rollouts: Rollouts,
    /// Number of robots driven.
    shown_count: usize,
    /// Predicted covariances after each step, by each of [`RECURSIONS`]; None where undefined.
    predicted_covariances: [Vec<Option<Matrix3<f64>>>; 3],
    measured_moments: Vec<MeasuredMoments>,
    comparisons: [Comparison; 3],
}

/// Statistics of the robots driven, and comparison with the recursions. They are NaN if undefined.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), tsify(rename = "ReckoningStats"))]
pub struct Stats {
    /// Number of robots driven.
    pub n: usize,
    /// Moments of ξ (m, m, rad) about the commanded pose, after the selected step.
    #[cfg_attr(target_arch = "wasm32", tsify(type = "Moments"))]
    pub measured: ExponentialMoments,
    /// Predicted covariance after the selected step; null (None) if the recursion has none.
    #[cfg_attr(target_arch = "wasm32", tsify(type = "ByRecursion<number[][] | null>"))]
    pub predicted: ByRecursion<Option<Covariance>>,
    /// Steps at which a prediction is off, for the components along, lateral and heading.
    pub misses: ByRecursion<[Misses; 3]>,
}

/// One value for each of [`RECURSIONS`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), serde(rename_all = "kebab-case"))]
pub struct ByRecursion<T> {
    /// Value for the chapter's recursion.
    pub chapter: T,
    /// Value for the propagation of first order.
    pub first_order: T,
    /// Value for the propagation of fourth order.
    pub fourth_order: T,
}

/// Rows of a symmetric matrix.
pub type Covariance = [[f64; 3]; 3];

js_structs! {
    /// 2σ outlines after a step as x, y pairs, the first point repeated at the end; empty if the recursion has no covariance there.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Outlines as "StepOutlines" {
        /// Outline of the predicted Gaussian in (x, y), m, as in a filter that estimates x, y and θ.
        pub ellipse: Vec<[f64; 2]> as "Float64Array",
        /// Outline of the predicted Gaussian in exponential coordinates about the commanded pose, on the floor, m.
        pub exponential: Vec<[f64; 2]> as "Float64Array",
        /// Outline of the predicted Gaussian in (ξ along, ξ lateral), m.
        pub predicted: Vec<[f64; 2]> as "Float64Array",
        /// Outline of the robots' covariance in (ξ along, ξ lateral), m.
        pub measured: Vec<[f64; 2]> as "Float64Array",
    }
}

cloud_simulation!(DeadReckoning);

impl DeadReckoning {
    fn empty(settings: Settings) -> Result<Self, SettingsError> {
        let mut rollouts = Rollouts::new(&settings).map_err(|_| SettingsError {
            field: "steps".to_owned(),
            value: f64::from(settings.steps),
            allowed: AllowedValues::FitsInMemory,
        })?;
        let predicted_covariances = RECURSIONS.map(|order| propagate_covariances(&settings, order));
        let measured_moments = rollouts.measured_moments(0);
        let comparisons = compare_recursions(&settings, &predicted_covariances, &measured_moments);
        Ok(Self { settings, rollouts, shown_count: 0, predicted_covariances, measured_moments, comparisons })
    }

    /// Changes the settings and drives the first block of `target_count` robots. [`DeadReckoning::add_samples`] drives the others.
    /// Robots stay if the change does not affect them.
    /// Errors are those of [`DeadReckoning::new`], and change nothing.
    pub fn configure_first(&mut self, settings: Settings, target_count: usize) -> Result<(), SettingsError> {
        settings.check()?;
        if self.settings.has_same_rollouts(&settings) {
            self.settings = settings;
        } else {
            *self = Self::empty(settings)?;
        }
        self.show_samples(
            target_count
                .min(settings.samples)
                .min(self.block_size_for_steps(FIRST_BLOCK_STEPS).max(self.shown_count)),
        );
        Ok(())
    }

    fn show_samples(&mut self, count: usize) {
        if count == self.shown_count {
            return;
        }
        self.rollouts.drive_blocks_to(count);
        self.shown_count = count;
        self.measured_moments = self.rollouts.measured_moments(count);
        self.comparisons =
            compare_recursions(&self.settings, &self.predicted_covariances, &self.measured_moments);
    }

    /// Returns the number of robots that are driven within a few milliseconds.
    pub fn block_size(&self) -> usize {
        self.block_size_for_steps(STEPS_PER_BLOCK)
    }

    fn block_size_for_steps(&self, steps: usize) -> usize {
        (steps / self.settings.steps as usize).next_multiple_of(ROLLOUTS_PER_BLOCK)
    }

    /// Returns the number of robots driven.
    pub fn shown_count(&self) -> usize {
        self.shown_count
    }

    /// Returns the moments of the robots after each step; the first is of step 1.
    pub fn measured_moments(&self) -> &[MeasuredMoments] {
        &self.measured_moments
    }

    /// Returns the covariance that a recursion predicts after each step; None from the step on at which it is undefined.
    pub fn predicted_covariances(&self, order: Compounding) -> &[Option<Matrix3<f64>>] {
        &self.predicted_covariances[index_of_recursion(order)]
    }

    /// Returns the comparison of a recursion with the robots.
    pub fn comparison(&self, order: Compounding) -> &Comparison {
        &self.comparisons[index_of_recursion(order)]
    }

    /// Returns the commanded pose after each step.
    pub fn nominal_poses(&self) -> &[SE2] {
        &self.rollouts.nominal_poses
    }

    /// Returns x, y (m) and θ (rad) of the robots in the picture, [`MAX_SHOWN_ROBOTS`] at most, after a step; empty where there is
    /// no such step.
    pub fn poses(&self, step: u32) -> &[[f64; 3]] {
        let Self { settings, rollouts, shown_count, .. } = self;
        let step_exists = (1..=settings.steps).contains(&step);
        if step_exists { rollouts.poses(step as usize, *shown_count) } else { &[] }
    }

    /// Returns ξ = x_k ⊟ x̄_k of the robots in the picture after the selected step: along, lateral (m), heading (rad).
    pub fn twists(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        let step = self.settings.step;
        let nominal_pose = self.nominal_poses()[step as usize - 1];
        self.poses(step).iter().map(move |pose| SE2::from(*pose).boxminus(&nominal_pose).into())
    }

    /// Returns x, y (m) and θ (rad) of one robot after each step; None if the index is too large.
    pub fn rollout(&self, index: usize) -> Option<Vec<[f64; 3]>> {
        (index < self.shown_count).then(|| self.rollouts.rollout(index))
    }

    /// Returns the robot in the picture that is nearest to a point (m) after the selected step, within `radius`.
    pub fn nearest(&self, target: [f64; 2], radius: f64) -> Option<usize> {
        let positions = self.poses(self.settings.step).iter().map(|[x, y, _]| [*x, *y]);
        nearest_index(positions, target, [radius, radius])
    }

    /// Returns the moments and predicted covariances after the selected step, and the misses of all steps.
    pub fn stats(&self) -> Stats {
        let step_index = self.settings.step as usize - 1;
        let MeasuredMoments { mean, cov, .. } = self.measured_moments()[step_index];
        Stats {
            n: self.shown_count(),
            measured: ExponentialMoments { mean, cov },
            predicted: evaluate_recursions(|order| {
                self.predicted_covariances(order)[step_index].map(Into::into)
            }),
            misses: evaluate_recursions(|order| self.comparison(order).misses),
        }
    }

    /// Returns the variances of a straight drive as functions of its duration, with the noise of the current settings.
    pub fn straight_growth(&self) -> StraightGrowth {
        StraightGrowth::new(&self.settings)
    }

    /// Returns the noise-free path of the command, as x, y pairs from the start.
    pub fn commanded_path(&self) -> Vec<[f64; 2]> {
        let Settings { command, steps, .. } = self.settings;
        let twist = TangentNoiseModel::twist(&command);
        // A chord of 0.1 rad deviates from its arc by 1/800 of its length.
        let chords_per_step = ((twist.z.abs() * 10.0).ceil() as usize).clamp(1, MAX_CHORDS);
        (0..=chords_per_step * steps as usize)
            .map(|i| {
                let pose = SE2::exp(&(twist * (i as f64 / chords_per_step as f64)));
                [pose.x(), pose.y()]
            })
            .collect()
    }

    /// Returns the outlines after a step, by the selected recursion; None if there is no such step.
    pub fn outlines(&self, step: u32) -> Option<Outlines> {
        let Settings { steps, compounding, .. } = self.settings;
        (1..=steps).contains(&step).then(|| self.outlines_at_index(step as usize - 1, compounding))
    }

    fn outlines_at_index(&self, index: usize, compounding: Compounding) -> Outlines {
        let pose = self.nominal_poses()[index];
        let MeasuredMoments { mean, cov, .. } = &self.measured_moments()[index];
        let measured = if self.shown_count() < 2 { vec![] } else { xi_ellipse_outline(mean, cov) };
        let Some(cov) = self.predicted_covariances(compounding)[index] else {
            return Outlines { ellipse: vec![], exponential: vec![], predicted: vec![], measured };
        };
        let xi_moments = ExponentialMoments { mean: Vector3::zeros(), cov };
        let (sin, cos) = libm::sincos(pose.theta());
        let heading_rotation = Matrix2::new(cos, -sin, sin, cos);
        let position_cov = heading_rotation * cov.fixed_view::<2, 2>(0, 0) * heading_rotation.transpose();
        let ellipse = Ellipse::new(Vector2::new(pose.x(), pose.y()), position_cov);
        Outlines {
            ellipse: ellipse.boundary(OUTLINE_SEGMENTS),
            exponential: ExponentialContour::new(&xi_moments, &pose).boundary(OUTLINE_SEGMENTS),
            predicted: xi_ellipse_outline(&Vector3::zeros(), &cov),
            measured,
        }
    }
}

fn compare_recursions(
    settings: &Settings,
    predicted: &[Vec<Option<Matrix3<f64>>>; 3],
    measured: &[MeasuredMoments],
) -> [Comparison; 3] {
    predicted.each_ref().map(|covs| Comparison::new(settings, covs, measured))
}

fn evaluate_recursions<T>(of: impl Fn(Compounding) -> T) -> ByRecursion<T> {
    let [chapter, first_order, fourth_order] = RECURSIONS.map(of);
    ByRecursion { chapter, first_order, fourth_order }
}

fn index_of_recursion(order: Compounding) -> usize {
    RECURSIONS.iter().position(|recursion| *recursion == order).unwrap_or_default()
}

fn xi_ellipse_outline(mean: &Vector3<f64>, cov: &Matrix3<f64>) -> Vec<[f64; 2]> {
    Ellipse::new(mean.xy(), cov.fixed_view::<2, 2>(0, 0).into_owned()).boundary(OUTLINE_SEGMENTS)
}
