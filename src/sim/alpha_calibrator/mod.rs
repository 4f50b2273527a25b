//! The Alpha Calibrator: the α's of a log, how well they are known, and whether the model is any good.

pub mod example;
mod panels;
mod settings;

pub use panels::{BINS, Driver, Panel};
pub use settings::*;

use super::cloud::draws::Draws;
use super::settings::{Rules, SettingsError};
use crate::calibrate::{Calibration, Drive, Leg, Trajectory, calibrate};
use crate::geom::se2::SE2;
use crate::models::{OdomDelta, RuleAlphas, VelocityAlphas, VelocityCmd, VelocityModel};
use crate::stats::{CartesianMoments, Ellipse};
use panels::panels;
use std::sync::Arc;

/// Outcomes that are drawn of a leg.
pub const OUTCOMES: usize = 400;

/// Chords of the outline of a leg's cloud.
const OUTLINE_SEGMENTS: usize = 64;

/// What a robot's wheels said, and where it really was.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    pub odometry: Trajectory,
    pub reference: Trajectory,
}

/// What is known of the log that the widget opens with.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(target_arch = "wasm32", derive(serde::Serialize), serde(rename_all = "camelCase"))]
pub struct Truth {
    pub alphas: [f64; 4],
    pub clock_offset: f64,
    pub mount_yaw: f64,
    pub lever_arm: [f64; 2],
    pub distance_scale: f64,
    pub turn_scale: f64,
}

/// One leg in the frame of the robot at its beginning, m and rad.
#[derive(Clone, Debug, PartialEq)]
pub struct LegView {
    /// Where it may have ended under the fitted α's.
    pub outcomes: Vec<[f64; 3]>,
    /// The 2σ ellipse of these; empty where there is no noise.
    pub outline: Vec<[f64; 2]>,
    /// Where the odometry says that it ended.
    pub read: [f64; 3],
    /// Where it ended.
    pub ended: [f64; 3],
}

/// The simulation behind the widget: settings, a log, and what is fitted to it.
#[derive(Clone, Debug)]
pub struct AlphaCalibrator {
    settings: Settings,
    /// Log and calibration that are shown.
    shown: Shown,
    /// Source of the log that is to be fitted next.
    next: Option<Source>,
    /// Number of completed fits.
    fits: u32,
}

/// Where a log is from.
#[derive(Clone, Debug)]
enum Source {
    /// Of this seed; made when it is needed first, which takes as long as a frame has.
    Simulated(u64, Option<Arc<Log>>),
    Own(Arc<Log>),
}

impl Source {
    fn made(&mut self) -> &Log {
        match self {
            Self::Simulated(seed, log) => log.get_or_insert_with(|| Arc::new(example::example(*seed))),
            Self::Own(log) => log,
        }
    }
}

/// What is fitted to which log, and under which settings.
#[derive(Clone, Debug)]
struct Shown {
    settings: Settings,
    source: Source,
    calibration: Calibration,
}

impl AlphaCalibrator {
    /// The widget as it opens, with the simulated log.
    ///
    /// # Errors
    /// [`SettingsError`] for the first setting out of range.
    pub fn new(settings: Settings) -> Result<Self, SettingsError> {
        let mut machine = Self::empty(settings)?;
        machine.finish();
        Ok(machine)
    }

    /// A machine that has begun with the simulated log, and shows nothing of it yet.
    ///
    /// # Errors
    /// As [`AlphaCalibrator::new`].
    pub fn empty(settings: Settings) -> Result<Self, SettingsError> {
        settings.check()?;
        let source = Source::Simulated(settings.seed, None);
        let shown =
            Shown { settings, source: source.clone(), calibration: Calibration::empty(settings.model()) };
        Ok(Self { settings, shown, next: Some(source), fits: 0 })
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Changes the settings.
    ///
    /// # Errors
    /// As [`AlphaCalibrator::new`]; nothing has changed then.
    pub fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
        self.begin(settings)?;
        self.finish();
        Ok(())
    }

    /// As [`AlphaCalibrator::configure`], but the fit is left to [`AlphaCalibrator::advance`]. Until then the figures are the former ones.
    ///
    /// # Errors
    /// As [`AlphaCalibrator::configure`].
    pub fn begin(&mut self, settings: Settings) -> Result<(), SettingsError> {
        settings.check()?;
        let before = std::mem::replace(&mut self.settings, settings);
        if !before.fits_as(&settings) {
            let source = match self.latest() {
                Source::Simulated(seed, _) if *seed != settings.seed => {
                    Source::Simulated(settings.seed, None)
                }
                same => same.clone(),
            };
            self.next = Some(source);
        }
        if self.next.is_none() {
            self.shown.settings = settings;
        }
        Ok(())
    }

    /// Begins with another log, as [`AlphaCalibrator::begin`] with other settings.
    pub fn begin_log(&mut self, log: Log) {
        self.next = Some(Source::Own(Arc::new(log)));
    }

    /// Puts another log in the place of the present one.
    pub fn set_log(&mut self, log: Log) {
        self.begin_log(log);
        self.finish();
    }

    /// The log of what was begun last, whether that is complete or not.
    fn latest(&self) -> &Source {
        self.next.as_ref().unwrap_or(&self.shown.source)
    }

    /// Fits the log that was begun, if any; returns true. A log with too few legs ends in a calibration without legs.
    pub fn advance(&mut self) -> bool {
        let Some(mut source) = self.next.take() else { return true };
        let Log { odometry, reference } = source.made();
        let drive = Drive { odometry, reference };
        let calibration = calibrate(&[drive], &self.settings.options());
        let calibration = calibration.unwrap_or_else(|_| Calibration::empty(self.settings.model()));
        self.shown = Shown { settings: self.settings, source, calibration };
        self.fits += 1;
        true
    }

    fn finish(&mut self) {
        self.advance();
    }

    /// How often the figures have become others.
    pub fn fits(&self) -> u32 {
        self.fits
    }

    /// Progress of what was begun, 0 or 1.
    pub fn progress(&self) -> f64 {
        f64::from(u8::from(self.next.is_none()))
    }

    /// Gives up what was begun: settings and figures are the former ones.
    pub fn stop(&mut self) {
        self.next = None;
        self.settings = self.shown.settings;
    }

    /// What is fitted.
    pub fn calibration(&self) -> &Calibration {
        &self.shown.calibration
    }

    /// The log that it is fitted to; None before anything is.
    pub fn log(&self) -> Option<&Log> {
        match &self.shown.source {
            Source::Simulated(_, log) => log.as_deref(),
            Source::Own(log) => Some(log),
        }
    }

    /// The true values, where the log is simulated; the α's belong to the legs and to the rule that it was simulated with.
    pub fn truth(&self) -> Option<Truth> {
        matches!(self.shown.source, Source::Simulated(..)).then_some(Truth {
            alphas: example::ALPHAS,
            clock_offset: example::CLOCK_OFFSET,
            mount_yaw: example::MOUNT_YAW,
            lever_arm: example::LEVER_ARM,
            distance_scale: example::DISTANCE_SCALE,
            turn_scale: example::TURN_SCALE,
        })
    }

    pub fn legs(&self) -> &[Leg] {
        &self.calibration().legs
    }

    /// Squared residuals against what drives them.
    pub fn panels(&self, driver: Driver) -> [Panel; 3] {
        panels(self.shown.settings.model(), self.calibration(), driver)
    }

    /// One leg from its beginning; None where there is no such leg.
    pub fn leg(&self, index: usize) -> Option<LegView> {
        let leg = self.legs().get(index)?;
        let reading = self.calibration().observations[index].reading;
        let mut draws = Draws::new(self.shown.settings.seed, self.shown.settings.noise);
        draws.extend_to(OUTCOMES);
        let outcomes: Vec<[f64; 3]> =
            (0..OUTCOMES).map(|outcome| self.outcome(&reading, draws.of(outcome))).map(numbers).collect();
        let poses: Vec<SE2> = outcomes.iter().map(|[x, y, theta]| SE2::new(*x, *y, *theta)).collect();
        let cloud = Ellipse::from_moments(&CartesianMoments::from_poses(&poses));
        let outline = if cloud.has_area() { cloud.boundary(OUTLINE_SEGMENTS) } else { vec![] };
        let read = self.outcome(&reading, [0.0; 3]);
        let [from, to] = leg.reference.map(|pose| self.calibration().corrected.base(&pose));
        let ended = from.inverse() * to;
        Some(LegView { outcomes, outline, read: numbers(read), ended: numbers(ended) })
    }

    /// Where a leg ends with such noise.
    fn outcome(&self, reading: &[f64; 3], unit_noise: [f64; 3]) -> SE2 {
        let Shown { settings, calibration, .. } = &self.shown;
        // An α that the log does not identify adds nothing.
        let alpha =
            |k: usize| settings.inflation * calibration.alphas.get(k).copied().flatten().unwrap_or(0.0);
        let [first, second, third] = *reading;
        if settings.model == Model::Velocity {
            let model =
                VelocityModel { alphas: VelocityAlphas(std::array::from_fn(alpha)), noise: settings.noise };
            let command = VelocityCmd { v: first, omega: second, dt: third };
            return model.apply_noise(&command, &SE2::identity(), unit_noise);
        }
        let legs = OdomDelta { rot1: first, trans: second, rot2: third };
        let alphas: RuleAlphas = std::array::from_fn(alpha);
        let [.., end] =
            settings.rule.variances(&legs, &alphas).executed(&legs, unit_noise).poses(&SE2::identity());
        end
    }

    /// The leg whose way is nearest to a point (m) and within `radius` of it.
    pub fn nearest(&self, [x, y]: [f64; 2], radius: f64) -> Option<usize> {
        let corrected = &self.calibration().corrected;
        let distance = |leg: &Leg| {
            let [from, to] = leg.reference.map(|pose| corrected.base(&pose));
            let [dx, dy] = [to.x() - from.x(), to.y() - from.y()];
            let [px, py] = [x - from.x(), y - from.y()];
            let square = dx * dx + dy * dy;
            let share = if square > 0.0 { ((px * dx + py * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
            libm::hypot(px - share * dx, py - share * dy)
        };
        let near = self.legs().iter().map(distance).enumerate();
        near.filter(|(_, distance)| *distance < radius)
            .min_by(|(_, one), (_, other)| one.total_cmp(other))
            .map(|(index, _)| index)
    }
}

fn numbers(pose: SE2) -> [f64; 3] {
    [pose.x(), pose.y(), pose.theta()]
}
