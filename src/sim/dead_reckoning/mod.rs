//! Dead Reckoning: one command driven step after step, how uncertainty grows on the way, and how well it is predicted.

mod figures;
mod rollouts;
mod settings;
mod straight;

pub use figures::{Comparison, Misses, RECURSIONS, TOLERANCE};
pub use rollouts::{KEPT, Measured};
pub use settings::*;
pub use straight::StraightGrowth;

use super::cloud::views::Nearest;
use super::settings::{Allowed, Rules, SettingsError};
use crate::geom::se2::SE2;
use crate::models::{Compounding, TangentNoiseModel};
use crate::stats::{Ellipse, ExponentialContour, ExponentialMoments};
use figures::covariances;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use rollouts::Rollouts;

/// Chords of an outline. Fewer would show corners, more would be below a pixel.
const OUTLINE_SEGMENTS: usize = 96;

/// Chords of the commanded arc in a step, at most.
const MOST_CHORDS: usize = 16;

/// Robot steps in a block, which takes some milliseconds.
const BLOCK_STEPS: usize = 200_000;

/// The simulation behind the widget: settings, rollouts, and what recursions say of them.
#[derive(Clone, Debug)]
pub struct DeadReckoning {
    settings: Settings,
    rollouts: Rollouts,
    /// Number of robots driven.
    shown: usize,
    /// By recursion.
    predicted: [Vec<Option<Matrix3<f64>>>; 3],
    measured: Vec<Measured>,
    compared: [Comparison; 3],
}

/// What the robots driven say, and how the recursions compare. Figures without meaning are NaN.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), tsify(rename = "ReckoningStats"))]
pub struct Stats {
    /// Number of robots driven.
    pub n: usize,
    /// Moments of ξ (m, m, rad) about the commanded pose, after the step that is looked at.
    #[cfg_attr(target_arch = "wasm32", tsify(type = "Moments"))]
    pub measured: ExponentialMoments,
    /// Covariance after that step; null (None) where the recursion leaves none.
    #[cfg_attr(target_arch = "wasm32", tsify(type = "ByRecursion<number[][] | null>"))]
    pub predicted: ByRecursion<Option<Covariance>>,
    /// Of along, lateral and heading.
    pub misses: ByRecursion<[Misses; 3]>,
}

/// Something of each of [`RECURSIONS`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize, tsify::Tsify), serde(rename_all = "kebab-case"))]
pub struct ByRecursion<T> {
    pub chapter: T,
    pub first_order: T,
    pub fourth_order: T,
}

/// Rows of a symmetric matrix.
pub type Covariance = [[f64; 3]; 3];

/// 2σ outlines of a step as x, y pairs, closed; empty where the recursion has no covariance left there.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlines {
    /// Of the predicted Gaussian in (x, y), m: what the covariance is to a filter that has no other coordinates.
    pub ellipse: Vec<[f64; 2]>,
    /// Of the predicted Gaussian in exponential coordinates about the commanded pose, on the floor, m.
    pub exponential: Vec<[f64; 2]>,
    /// The same in (ξ along, ξ lateral), m.
    pub predicted: Vec<[f64; 2]>,
    /// That of the robots' own covariance there.
    pub measured: Vec<[f64; 2]>,
}

impl DeadReckoning {
    /// Machine with all of its robots driven.
    ///
    /// # Errors
    /// [`SettingsError`] for the first setting out of range, or where memory does not suffice.
    pub fn new(settings: Settings) -> Result<Self, SettingsError> {
        Self::showing(settings, settings.samples)
    }

    /// Machine that has driven the first `count` robots.
    ///
    /// # Errors
    /// As [`DeadReckoning::new`].
    pub fn showing(settings: Settings, count: usize) -> Result<Self, SettingsError> {
        settings.check()?;
        let mut rollouts = Rollouts::new(&settings).map_err(|_| SettingsError {
            field: "steps".to_owned(),
            value: f64::from(settings.steps),
            allowed: Allowed::LessMemory,
        })?;
        let predicted = RECURSIONS.map(|order| covariances(&settings, order));
        let measured = rollouts.measured(0);
        let compared = compare(&settings, &predicted, &measured);
        let mut machine = Self { settings, rollouts, shown: 0, predicted, measured, compared };
        machine.show(count.min(settings.samples));
        Ok(machine)
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Changes the settings and drives all robots. The same seed has the same luck, however long the path and however many the robots.
    ///
    /// # Errors
    /// As [`DeadReckoning::new`]; nothing has changed then.
    pub fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
        self.configure_first(settings, 0)?;
        self.show(settings.samples);
        Ok(())
    }

    /// Changes the settings and drives the first block of `goal` robots. The others are for [`DeadReckoning::add_samples`]. Robots that
    /// drive as before stay.
    ///
    /// # Errors
    /// As [`DeadReckoning::configure`].
    pub fn configure_first(&mut self, settings: Settings, goal: usize) -> Result<(), SettingsError> {
        settings.check()?;
        if self.settings.drives_as(&settings) {
            self.settings = settings;
        } else {
            *self = Self::showing(settings, 0)?;
        }
        self.show(goal.min(settings.samples).min(self.block().max(self.shown)));
        Ok(())
    }

    /// Drives up to `count` robots more; returns how many are driven then.
    pub fn add_samples(&mut self, count: usize) -> usize {
        self.show(self.shown.saturating_add(count).min(self.settings.samples));
        self.shown
    }

    fn show(&mut self, count: usize) {
        if count == self.shown {
            return;
        }
        self.rollouts.drive_to(count);
        self.shown = count;
        self.measured = self.rollouts.measured(count);
        self.compared = compare(&self.settings, &self.predicted, &self.measured);
    }

    /// Number of robots that are driven within a few milliseconds.
    pub fn block(&self) -> usize {
        (BLOCK_STEPS / self.settings.steps as usize).max(1)
    }

    /// Number of robots driven.
    pub fn shown(&self) -> usize {
        self.shown
    }

    /// What the robots say of each step, the first of which is step 1.
    pub fn measured(&self) -> &[Measured] {
        &self.measured
    }

    /// What a recursion says of each step; None from where on it leaves no covariance.
    pub fn predicted(&self, order: Compounding) -> &[Option<Matrix3<f64>>] {
        &self.predicted[place_of(order)]
    }

    /// How that compares with the robots.
    pub fn compared(&self, order: Compounding) -> &Comparison {
        &self.compared[place_of(order)]
    }

    /// The commanded pose after each step.
    pub fn nominal(&self) -> &[SE2] {
        self.rollouts.nominal()
    }

    /// x, y (m) and θ (rad) of the robots in the picture, [`KEPT`] at most, after a step; empty where there is no such step.
    pub fn poses(&self, step: u32) -> &[[f64; 3]] {
        let Self { settings, rollouts, shown, .. } = self;
        let is_driven = (1..=settings.steps).contains(&step);
        if is_driven { rollouts.poses(step as usize, *shown) } else { &[] }
    }

    /// ξ = x_k ⊟ x̄_k of the robots in the picture after the step that is looked at: along, lateral (m), heading (rad).
    pub fn twists(&self) -> impl ExactSizeIterator<Item = [f64; 3]> {
        let step = self.settings.step;
        let nominal = self.nominal()[step as usize - 1];
        self.poses(step).iter().map(move |[x, y, theta]| SE2::new(*x, *y, *theta).boxminus(&nominal).into())
    }

    /// x, y (m) and θ (rad) of one robot after each step; None where there is no such robot.
    pub fn rollout(&self, index: usize) -> Option<Vec<[f64; 3]>> {
        (index < self.shown).then(|| self.rollouts.rollout(index))
    }

    /// The robot in the picture that is nearest to a point (m) after the step that is looked at, and within `radius` of it.
    pub fn nearest(&self, target: [f64; 2], radius: f64) -> Option<usize> {
        let mut nearest = Nearest::new(target, [radius, radius]);
        self.poses(self.settings.step).iter().for_each(|[x, y, _]| nearest.see([*x, *y]));
        nearest.index()
    }

    pub fn stats(&self) -> Stats {
        let step = self.settings.step as usize - 1;
        let Measured { mean, cov, .. } = self.measured()[step];
        Stats {
            n: self.shown(),
            measured: ExponentialMoments { mean, cov },
            predicted: by_recursion(|order| self.predicted(order)[step].map(Into::into)),
            misses: by_recursion(|order| self.compared(order).misses),
        }
    }

    /// Returns the variances of a straight drive as functions of its duration, with the noise of the current settings.
    pub fn straight_growth(&self) -> StraightGrowth {
        StraightGrowth::new(&self.settings)
    }

    /// The way that the command drives without noise, as x, y pairs from the start.
    pub fn commanded(&self) -> Vec<[f64; 2]> {
        let Settings { command, steps, .. } = self.settings;
        let twist = TangentNoiseModel::twist(&command);
        // A chord of a tenth of a radian is an eight-hundredth of its length off its arc.
        let chords = ((twist.z.abs() * 10.0).ceil() as usize).clamp(1, MOST_CHORDS);
        (0..=chords * steps as usize)
            .map(|i| {
                let pose = SE2::exp(&(twist * (i as f64 / chords as f64)));
                [pose.x(), pose.y()]
            })
            .collect()
    }

    /// The outlines of a step, by the recursion that is looked at; None where there is no such step.
    pub fn outlines(&self, step: u32) -> Option<Outlines> {
        let Settings { steps, compounding, .. } = self.settings;
        (1..=steps).contains(&step).then(|| self.outlines_at(step as usize - 1, compounding))
    }

    fn outlines_at(&self, index: usize, compounding: Compounding) -> Outlines {
        let pose = self.nominal()[index];
        let Measured { mean, cov, .. } = &self.measured()[index];
        let measured = if self.shown() < 2 { vec![] } else { floor_of_xi(mean, cov) };
        let Some(cov) = self.predicted(compounding)[index] else {
            return Outlines { ellipse: vec![], exponential: vec![], predicted: vec![], measured };
        };
        let contour = ExponentialMoments { mean: Vector3::zeros(), cov };
        let (sin, cos) = libm::sincos(pose.theta());
        let turn = Matrix2::new(cos, -sin, sin, cos);
        let plane = turn * cov.fixed_view::<2, 2>(0, 0) * turn.transpose();
        let ellipse = Ellipse::new(Vector2::new(pose.x(), pose.y()), plane);
        Outlines {
            ellipse: ellipse.boundary(OUTLINE_SEGMENTS),
            exponential: ExponentialContour::new(&contour, &pose).boundary(OUTLINE_SEGMENTS),
            predicted: floor_of_xi(&Vector3::zeros(), &cov),
            measured,
        }
    }
}

fn compare(
    settings: &Settings,
    predicted: &[Vec<Option<Matrix3<f64>>>; 3],
    measured: &[Measured],
) -> [Comparison; 3] {
    predicted.each_ref().map(|covs| Comparison::new(settings, covs, measured))
}

fn by_recursion<T>(of: impl Fn(Compounding) -> T) -> ByRecursion<T> {
    let [chapter, first_order, fourth_order] = RECURSIONS.map(of);
    ByRecursion { chapter, first_order, fourth_order }
}

/// The place of a recursion among [`RECURSIONS`].
fn place_of(order: Compounding) -> usize {
    RECURSIONS.iter().position(|each| *each == order).unwrap_or_default()
}

/// The 2σ ellipse of ξ along and lateral.
fn floor_of_xi(mean: &Vector3<f64>, cov: &Matrix3<f64>) -> Vec<[f64; 2]> {
    Ellipse::new(mean.xy(), cov.fixed_view::<2, 2>(0, 0).into_owned()).boundary(OUTLINE_SEGMENTS)
}
