//! The Banana Machine: one command from the origin, thousands of outcomes.

use super::draws::Draws;
use super::settings::{MAX_SAMPLES, SettingsError, check_alphas, check_command, check_whole};
use super::views::{Grid, View, density, nearest};
use crate::geom::arc::{Arc, ArcInversion, invert_arc};
use crate::geom::se2::SE2;
use crate::models::{
    MotionModel, OdomAlphas, OdomDelta, OdometryModel, TangentNoiseModel, VelocityAlphas, VelocityCmd,
    VelocityModel,
};
use crate::noise::NoiseKind;
use crate::stats::{
    CartesianMoments, CrossTrack, Ellipse, ExactMoments, ExponentialContour, ExponentialMoments,
    predicted_cross_track_skew,
};
use nalgebra::{Matrix3, Vector3};
use std::collections::TryReserveError;
use std::f64::consts::TAU;

/// Which of the chapter's models the machine runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelKind {
    Velocity,
    /// Fed with the reading that noise-free wheels would give for the command.
    Odometry,
}

/// Everything a user sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    pub model: ModelKind,
    pub noise: NoiseKind,
    pub command: VelocityCmd,
    /// Each model keeps its own α's, so that switching back and forth loses nothing.
    pub velocity_alphas: [f64; 6],
    pub odometry_alphas: [f64; 4],
    /// The number of the only α in effect (1 for α₁), all others counting as 0; None for all of them.
    pub isolate: Option<usize>,
    pub samples: usize,
    /// Up to [`super::settings::MAX_SEED`].
    pub seed: u64,
}

impl Default for Settings {
    /// The widget's opening state.
    fn default() -> Self {
        Self {
            model: ModelKind::Velocity,
            noise: NoiseKind::Normal,
            command: VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 },
            velocity_alphas: [0.05, 0.05, 0.05, 0.09, 0.01, 0.01],
            odometry_alphas: [0.05, 0.05, 0.05, 0.05],
            isolate: None,
            samples: 2000,
            seed: 7,
        }
    }
}

impl Settings {
    /// The α's of the present model as set, whether isolated or not.
    pub fn alphas(&self) -> &[f64] {
        match self.model {
            ModelKind::Velocity => &self.velocity_alphas,
            ModelKind::Odometry => &self.odometry_alphas,
        }
    }

    fn check(&self) -> Result<(), SettingsError> {
        check_command(&self.command)?;
        check_alphas(self.alphas())?;
        check_whole("samples", self.samples as f64, 1, MAX_SAMPLES as u64)?;
        if let Some(number) = self.isolate {
            check_whole("isolate", number as f64, 1, self.alphas().len() as u64)?;
        }
        check_whole("seed", self.seed as f64, 0, super::settings::MAX_SEED).map(|_| ())
    }

    /// The α's in effect.
    fn effective<const N: usize>(&self, alphas: [f64; N]) -> [f64; N] {
        std::array::from_fn(
            |i| if self.isolate.is_none_or(|number| number == i + 1) { alphas[i] } else { 0.0 },
        )
    }

    /// The model in effect, with its control for a command.
    fn motion(&self, command: VelocityCmd) -> Motion {
        match self.model {
            ModelKind::Velocity => {
                let alphas = VelocityAlphas(self.effective(self.velocity_alphas));
                Motion::Velocity(VelocityModel { alphas, noise: self.noise }, command)
            }
            ModelKind::Odometry => {
                let alphas = OdomAlphas(self.effective(self.odometry_alphas));
                let reading = OdomDelta::from_poses(&START, &command_end(&command));
                Motion::Odometry(OdometryModel { alphas, noise: self.noise }, reading)
            }
        }
    }
}

/// A model with its control.
enum Motion {
    Velocity(VelocityModel, VelocityCmd),
    Odometry(OdometryModel, OdomDelta),
}

impl Motion {
    fn exact(&self) -> ExactMoments {
        match self {
            Self::Velocity(model, command) => ExactMoments::of_velocity(model, command),
            Self::Odometry(model, reading) => ExactMoments::of_odometry(model, reading),
        }
    }

    fn linearized_cov(&self) -> Matrix3<f64> {
        match self {
            Self::Velocity(model, command) => model.cartesian_cov(command, &START),
            Self::Odometry(model, reading) => model.cartesian_cov(reading, &START),
        }
    }

    fn drive(&self, unit_noise: [f64; 3]) -> SE2 {
        match self {
            Self::Velocity(model, command) => model.apply_noise(command, &START, unit_noise),
            Self::Odometry(model, reading) => model.apply_noise(reading, &START, unit_noise),
        }
    }
}

/// Every robot starts at the origin, heading along x.
const START: SE2 = SE2::identity();

/// The commands of the widget's presets.
pub const PRESETS: [(&str, VelocityCmd); 4] = [
    ("straight", VelocityCmd { v: 1.0, omega: 0.0, dt: 2.0 }),
    ("gentle", VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 }),
    ("hard", VelocityCmd { v: 1.0, omega: 1.2, dt: 1.4 }),
    ("pivot", VelocityCmd { v: 0.06, omega: 1.5, dt: 1.0 }),
];

/// The command whose arc ends at (x, y), with the duration of `near` and, of the arcs that lead there (forward or in
/// reverse, round the circle or not), the one whose turn is nearest to that of `near`.
pub fn command_reaching(x: f64, y: f64, near: &VelocityCmd) -> VelocityCmd {
    let dt = near.dt;
    let ArcInversion { v_hat, omega_hat, .. } = invert_arc(&START, &SE2::new(x, y, 0.0), dt);
    let windings = ((near.omega - omega_hat) * dt / TAU).round();
    if windings == 0.0 || omega_hat == 0.0 {
        return VelocityCmd { v: v_hat, omega: omega_hat, dt };
    }
    // On one circle the length driven is proportional to the turn.
    let omega = omega_hat + windings * TAU / dt;
    VelocityCmd { v: v_hat * (omega / omega_hat), omega, dt }
}

fn command_end(command: &VelocityCmd) -> SE2 {
    SE2::exp(&TangentNoiseModel::twist(command))
}

/// What the shown samples say, and what the models say of them. Figures without meaning (no spread, too few
/// samples) are NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    pub cartesian: CartesianMoments,
    pub exponential: ExponentialMoments,
    pub cross_track: CrossTrack,
    /// The cross-track skew of the Gaussian with the exponential moments.
    pub gaussian_skew: f64,
    /// Shares of the samples inside the two 2σ contours.
    pub inside_ellipse: f64,
    pub inside_exponential: f64,
}

/// Standard deviations of the turn that must keep short of a whole circle for exponential coordinates to make sense.
/// There ξ runs to infinity; with fewer, single samples of a large cloud would already spoil its moments.
const CHART_SIGMAS: f64 = 4.0;

impl Figures {
    fn of(poses: &[SE2], twists: &[Vector3<f64>], chart_holds: bool) -> Self {
        let cartesian = CartesianMoments::from_poses(poses);
        let exponential = ExponentialMoments::from_twists(if chart_holds { twists } else { &[] });
        let share = |view: View, ellipse: &Ellipse| {
            let points = poses.iter().zip(twists).map(|(pose, twist)| view.point(pose, twist));
            let inside = points.filter(|point| ellipse.contains(*point)).count();
            if ellipse.has_area() { inside as f64 / poses.len() as f64 } else { f64::NAN }
        };
        Self {
            cartesian,
            exponential,
            cross_track: CrossTrack::from_poses(poses),
            gaussian_skew: predicted_cross_track_skew(&exponential.mean, &exponential.cov),
            inside_ellipse: share(View::Plane, &Ellipse::from_moments(&cartesian)),
            inside_exponential: share(View::Twist, ExponentialContour::new(&exponential, &START).ellipse()),
        }
    }
}

/// The curves drawn over the cloud, as (x, y) in m but for `twist_ellipse`, (m, rad). Outlines are closed; empty
/// where fewer than two samples are shown, or without a chart to be drawn in.
#[derive(Clone, Debug, PartialEq)]
pub struct Contours {
    /// The arc of the command, open.
    pub command: Vec<[f64; 2]>,
    pub ellipse: Vec<[f64; 2]>,
    /// The 2σ ellipse of an EKF.
    pub linearized: Vec<[f64; 2]>,
    pub exponential: Vec<[f64; 2]>,
    /// The 2σ ellipse of the exponential moments in (along, heading).
    pub twist_ellipse: Vec<[f64; 2]>,
}

/// One sample, explained.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    pub pose: SE2,
    pub twist: Vector3<f64>,
    /// The arc and last turn that led to it; under the odometry model, which knows no arc, that would lead to it.
    pub executed: ArcInversion,
    /// That arc.
    pub path: Vec<[f64; 2]>,
}

/// Chords of an outline: at 128 the sagitta is 0.03 % of the radius, a fifth of a pixel on the largest screen.
const OUTLINE_SEGMENTS: usize = 128;

/// The simulation behind the widget: settings, draws, and the cloud shown.
#[derive(Clone, Debug)]
pub struct BananaMachine {
    settings: Settings,
    draws: Draws,
    poses: Vec<SE2>,
    /// ξ = pose ⊟ start, one for each pose, on the branch of the logarithm that belongs to the commanded turn.
    twists: Vec<Vector3<f64>>,
    figures: Figures,
}

impl BananaMachine {
    /// A machine with its cloud complete.
    ///
    /// # Errors
    /// [`SettingsError`] for the first setting out of range, or where memory does not suffice for the samples.
    pub fn new(settings: Settings) -> Result<Self, SettingsError> {
        let mut machine = Self {
            settings: Settings { samples: 0, ..settings },
            draws: Draws::new(settings.seed, settings.noise),
            poses: Vec::new(),
            twists: Vec::new(),
            figures: Figures::of(&[], &[], true),
        };
        machine.configure(settings)?;
        Ok(machine)
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Changes the settings. The same robots, with the same luck, drive under the new ones. A complete cloud stays
    /// complete; one that is still growing keeps its count, as far as there are samples for it.
    ///
    /// # Errors
    /// As [`BananaMachine::new`]; nothing has changed then.
    pub fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
        settings.check()?;
        let complete = self.poses.len() == self.settings.samples;
        let shown = if complete { settings.samples } else { self.poses.len().min(settings.samples) };
        let no_memory = |_| SettingsError::no_memory(settings.samples);
        self.poses.try_reserve_exact(settings.samples.saturating_sub(self.poses.len())).map_err(no_memory)?;
        self.twists
            .try_reserve_exact(settings.samples.saturating_sub(self.twists.len()))
            .map_err(no_memory)?;
        self.draws.prepare(settings.seed, settings.noise, settings.samples).map_err(no_memory)?;
        self.settings = settings;
        self.restart();
        self.grow(shown);
        Ok(())
    }

    /// Takes every sample off the picture; the draws remain.
    pub fn restart(&mut self) {
        self.poses.clear();
        self.twists.clear();
        self.figures = Figures::of(&[], &[], true);
    }

    /// Shows up to `count` samples more; returns how many are shown.
    pub fn grow(&mut self, count: usize) -> usize {
        let shown = self.poses.len();
        let end = shown.saturating_add(count).min(self.settings.samples);
        let motion = self.settings.motion(self.settings.command);
        self.poses
            .extend(self.draws.unit_noise()[shown..end].iter().map(|unit_noise| motion.drive(*unit_noise)));
        let VelocityCmd { omega, dt, .. } = self.settings.command;
        self.twists.extend(self.poses[shown..].iter().map(|pose| pose.log_near(omega * dt)));
        self.figures = Figures::of(&self.poses, &self.twists, self.chart_holds());
        end
    }

    /// The samples shown, in sample order.
    pub fn poses(&self) -> &[SE2] {
        &self.poses
    }

    /// Their exponential coordinates (along, lateral, heading).
    pub fn twists(&self) -> &[Vector3<f64>] {
        &self.twists
    }

    pub fn figures(&self) -> &Figures {
        &self.figures
    }

    /// Whether the robots keep short of turning a whole circle, where exponential coordinates end. Where not, every
    /// figure and contour in them is undefined.
    pub fn chart_holds(&self) -> bool {
        let VelocityCmd { omega, dt, .. } = self.settings.command;
        let turn_variance = self.exact().cov[(2, 2)];
        (omega * dt).abs() + CHART_SIGMAS * turn_variance.sqrt() < TAU
    }

    /// R_u and τ: mean and covariance in exponential coordinates as the model has them, the variance of the turn after
    /// the arc added to the heading. None for the odometry model, whose noise is not additive there.
    pub fn tangent(&self) -> Option<ExponentialMoments> {
        match self.settings.motion(self.settings.command) {
            Motion::Velocity(model, command) => {
                let [.., last] = model.variances(&command);
                let mut cov = model.tangent_cov(&command)?;
                cov[(2, 2)] += command.dt * command.dt * last.0;
                Some(ExponentialMoments { mean: TangentNoiseModel::twist(&command), cov })
            }
            Motion::Odometry(..) => None,
        }
    }

    /// Mean and covariance by the linearization that an EKF uses: the noise-free end, and J·Σ·Jᵀ.
    pub fn linearized(&self) -> CartesianMoments {
        let end = command_end(&self.settings.command);
        CartesianMoments {
            mean: Vector3::new(end.x(), end.y(), end.theta()),
            cov: self.settings.motion(self.settings.command).linearized_cov(),
        }
    }

    /// The model's own moments, by quadrature.
    pub fn exact(&self) -> ExactMoments {
        self.settings.motion(self.settings.command).exact()
    }

    /// The exact cross-track skew at `points` rotational velocities spread evenly from `first` to `last` (rad/s), all
    /// else as set.
    pub fn skew_curve(&self, first: f64, last: f64, points: usize) -> Vec<f64> {
        let step = (last - first) / (points.max(2) - 1) as f64;
        (0..points)
            .map(|i| {
                let omega = first + step * i as f64;
                self.settings.motion(VelocityCmd { omega, ..self.settings.command }).exact().cross_track_skew
            })
            .collect()
    }

    /// The curves over the cloud.
    pub fn contours(&self) -> Contours {
        let Figures { cartesian, exponential, .. } = &self.figures;
        let if_any = |holds: bool, outline: Vec<[f64; 2]>| if holds { outline } else { Vec::new() };
        let enough = self.poses.len() > 1;
        let charted = enough && self.chart_holds();
        let VelocityCmd { v, omega, dt } = self.settings.command;
        let contour = ExponentialContour::new(exponential, &START);
        Contours {
            command: arc_points(v * dt, omega * dt),
            ellipse: if_any(enough, Ellipse::from_moments(cartesian).boundary(OUTLINE_SEGMENTS)),
            linearized: Ellipse::from_moments(&self.linearized()).boundary(OUTLINE_SEGMENTS),
            exponential: if_any(charted, contour.boundary(OUTLINE_SEGMENTS)),
            twist_ellipse: if_any(charted, contour.ellipse().boundary(OUTLINE_SEGMENTS)),
        }
    }

    /// Sample `index` of those shown.
    pub fn inspect(&self, index: usize) -> Option<Sample> {
        let (pose, twist) = (*self.poses.get(index)?, *self.twists.get(index)?);
        let dt = self.settings.command.dt;
        let executed = match self.settings.motion(self.settings.command) {
            Motion::Velocity(model, command) => model.executed(&command, self.draws.unit_noise()[index]),
            Motion::Odometry(..) => invert_arc(&START, &pose, dt),
        };
        Some(Sample { pose, twist, executed, path: arc_points(executed.v_hat * dt, executed.omega_hat * dt) })
    }

    /// How many of the shown samples lie in each cell of a grid over a view: see [`density`].
    ///
    /// # Errors
    /// As [`density`].
    pub fn density(&self, view: View, grid: &Grid) -> Result<Vec<u32>, TryReserveError> {
        density(self.points(view), grid)
    }

    /// The shown sample nearest to a point of a view: see [`nearest`].
    pub fn nearest(&self, view: View, target: [f64; 2], radii: [f64; 2]) -> Option<usize> {
        nearest(self.points(view), target, radii)
    }

    fn points(&self, view: View) -> impl Iterator<Item = [f64; 2]> {
        self.poses.iter().zip(&self.twists).map(move |(pose, twist)| view.point(pose, twist))
    }
}

/// The points of an arc from the start.
fn arc_points(length: f64, turn: f64) -> Vec<[f64; 2]> {
    Arc { start: START, length, turn }.points()
}
