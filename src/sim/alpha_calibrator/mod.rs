//! The Alpha Calibrator: fits α's to a log, with confidence intervals and goodness of fit.

pub mod example;
mod settings;

pub use settings::*;

use super::cloud::draws::Draws;
use super::settings::{SettingRules, SettingsError, keywords};
use crate::calibrate::{self, Calibration, Drive, Leg, calibrate};
use crate::geom::se2::SE2;
use crate::geom::segment::Segment;
use crate::js::js_structs;
use crate::models::{OdomDelta, OdometryRule, RuleAlphas, VelocityAlphas, VelocityCmd, VelocityModel};
use crate::stats::{CartesianMoments, Ellipse};
use std::cell::OnceCell;

const OUTCOME_COUNT: usize = 400;

const OUTLINE_SEGMENTS: usize = 64;

js_structs! {
    /// True parameters of the simulated log, which a calibration should find.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Truth as "CalibrationTruth" {
        /// Noise parameters of the rule of Table 5.6, on legs of 0.25 m or 0.2 rad.
        pub alphas: [f64; 4],
        /// Time by the reference's clock minus time by the odometry's clock, s.
        pub clock_offset: f64,
        /// Yaw of the reference's sensor on the robot, rad.
        pub mount_yaw: f64,
        /// Position of the reference's sensor on the robot, m ahead and to the left.
        pub lever_arm: [f64; 2],
        /// True distances divided by those of the odometry.
        pub distance_scale: f64,
        /// True turns divided by those of the odometry.
        pub turn_scale: f64,
    }

    /// One leg of a log in the frame of the robot at the leg's start, m and rad.
    #[derive(Clone, Debug, PartialEq)]
    pub struct LegView {
        /// End poses x, y, θ drawn from the model, with the fitted α’s multiplied by the setting `inflation`.
        pub outcomes: Vec<[f64; 3]> as "Float64Array",
        /// 2σ ellipse of the drawn positions as x, y pairs; empty without noise.
        pub outline: Vec<[f64; 2]> as "Float64Array",
        /// End pose x, y, θ measured by odometry.
        pub read: [f64; 3] as "Float64Array",
        /// End pose x, y, θ measured by the reference, without its systematic errors.
        pub ended: [f64; 3] as "Float64Array",
    }
}

/// Simulation of the Alpha Calibrator widget: settings, a log, and the fit to the log, which is computed on first use.
#[derive(Clone, Debug)]
pub struct AlphaCalibrator {
    settings: Settings,
    log_source: LogSource,
    current_fit: Fit,
    /// Revision of the fit: a number that increases when the log changes, or a setting on which the fit depends.
    fit_revision: u32,
}

#[derive(Clone, Debug)]
enum LogSource {
    Simulated,
    Loaded(Vec<Drive>),
    /// No log: the fit was saved by another simulation, which has the log.
    Restored,
}

/// Calibration, computed on first use, and the settings from which it is computed.
#[derive(Clone, Debug)]
struct Fit {
    settings: Settings,
    calibration: OnceCell<Calibration>,
}

impl AlphaCalibrator {
    /// Creates a simulation with the simulated log. Fails with [`SettingsError`] for the first setting out of range.
    pub fn new(settings: Settings) -> Result<Self, SettingsError> {
        Self::from_source(settings, LogSource::Simulated, OnceCell::new())
    }

    /// Creates a simulation without a log, with a fit that another simulation has saved. Settings that need another fit stay
    /// [pending](AlphaCalibrator::is_pending). Fails with [`SettingsError`] for the first setting out of range.
    pub fn restore(settings: Settings, calibration: Calibration) -> Result<Self, SettingsError> {
        Self::from_source(settings, LogSource::Restored, OnceCell::from(calibration))
    }

    fn from_source(
        settings: Settings,
        log_source: LogSource,
        calibration: OnceCell<Calibration>,
    ) -> Result<Self, SettingsError> {
        settings.check()?;
        Ok(Self { settings, log_source, current_fit: Fit { settings, calibration }, fit_revision: 1 })
    }

    /// Returns the settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Returns the settings of the fit. They differ from [`AlphaCalibrator::settings`] while the current settings are pending.
    pub fn fitted_settings(&self) -> &Settings {
        &self.current_fit.settings
    }

    /// Returns true while the settings need another fit, which only a simulation with the log can compute.
    pub fn is_pending(&self) -> bool {
        !self.current_fit.settings.has_same_fit(&self.settings)
    }

    /// Changes the settings. Errors are those of [`AlphaCalibrator::new`], and change nothing.
    pub fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
        settings.check()?;
        let is_same_log =
            !matches!(self.log_source, LogSource::Simulated) || self.settings.seed == settings.seed;
        self.settings = settings;
        self.current_fit.settings.copy_prediction_settings(&settings);
        if !is_same_log || self.is_pending() {
            self.invalidate_fit();
        }
        Ok(())
    }

    /// Replaces the log by the logs of `drives`.
    pub fn set_log(&mut self, drives: Vec<Drive>) {
        self.log_source = LogSource::Loaded(drives);
        self.invalidate_fit();
    }

    fn invalidate_fit(&mut self) {
        if !matches!(self.log_source, LogSource::Restored) {
            self.current_fit = Fit { settings: self.settings, calibration: OnceCell::new() };
            self.fit_revision += 1;
        }
    }

    /// Returns the revision of the fit, a number that changes with each new fit.
    pub fn fit_revision(&self) -> u32 {
        self.fit_revision
    }

    /// Returns the calibration, which is empty if the log has too few legs.
    pub fn calibration(&self) -> &Calibration {
        self.current_fit.calibration.get_or_init(|| {
            let Settings { seed, .. } = self.current_fit.settings;
            let calibration_options = self.current_fit.settings.options();
            let drives = match &self.log_source {
                LogSource::Simulated => &[example::simulate_log(seed)],
                LogSource::Loaded(drives) => &drives[..],
                LogSource::Restored => &[],
            };
            calibrate(drives, &calibration_options)
                .unwrap_or_else(|_| Calibration::empty(calibration_options.model))
        })
    }

    /// Returns the true parameters, if the log is simulated. Its α's hold for the simulated leg length and odometry rule.
    pub fn truth(&self) -> Option<Truth> {
        matches!(self.log_source, LogSource::Simulated).then_some(example::TRUE_PARAMETERS)
    }

    /// Returns the legs of the log, drive by drive in the order of time.
    pub fn legs(&self) -> &[Leg] {
        &self.calibration().legs
    }

    /// Returns a diagram for each noise component of the model: squared residuals against the regressor.
    pub fn panels(&self, regressor: Regressor) -> [Panel; 3] {
        let calibration_model = self.current_fit.settings.model();
        [0, 1, 2].map(|component_index| {
            create_panel(calibration_model, self.calibration(), component_index, regressor)
        })
    }

    /// Returns one leg in the frame of the leg's start; None if the index is too large.
    pub fn leg(&self, index: usize) -> Option<LegView> {
        let leg = self.legs().get(index)?;
        let leg_reading = self.calibration().observations[index].reading;
        let mut outcome_draws = Draws::new(self.current_fit.settings.seed, self.current_fit.settings.noise);
        outcome_draws.extend_to(OUTCOME_COUNT);
        let outcome_poses: Vec<SE2> = (0..OUTCOME_COUNT)
            .map(|index| self.outcome_pose(&leg_reading, outcome_draws.noise_of_sample(index)))
            .collect();
        let outcome_ellipse = Ellipse::from_moments(&CartesianMoments::from_poses(&outcome_poses));
        let outline =
            if outcome_ellipse.has_area() { outcome_ellipse.boundary(OUTLINE_SEGMENTS) } else { vec![] };
        let odometry_end = self.outcome_pose(&leg_reading, [0.0; 3]);
        let reference_end = self.calibration().corrected.motion(leg);
        let end_poses = outcome_poses.into_iter().map(Into::into).collect();
        Some(LegView { outcomes: end_poses, outline, read: odometry_end.into(), ended: reference_end.into() })
    }

    /// Returns the end pose that the fitted model predicts for an odometry reading or command, with the noise `unit_noise` (three numbers
    /// of variance 1).
    fn outcome_pose(&self, leg_reading: &[f64; 3], unit_noise: [f64; 3]) -> SE2 {
        let (settings, calibration) = (&self.current_fit.settings, self.calibration());
        // An α that the log does not identify counts as 0.
        let inflated_alpha =
            |k: usize| settings.inflation * calibration.alphas.get(k).copied().flatten().unwrap_or(0.0);
        let [first_coordinate, second_coordinate, third_coordinate] = *leg_reading;
        if settings.model == Model::Velocity {
            let fitted_model = VelocityModel {
                alphas: VelocityAlphas(std::array::from_fn(inflated_alpha)),
                noise: settings.noise,
            };
            let command = VelocityCmd { v: first_coordinate, omega: second_coordinate, dt: third_coordinate };
            return fitted_model.apply_noise(&command, &SE2::identity(), unit_noise);
        }
        let leg_reading =
            OdomDelta { rot1: first_coordinate, trans: second_coordinate, rot2: third_coordinate };
        let alphas: RuleAlphas = std::array::from_fn(inflated_alpha);
        let [.., end_pose] = settings
            .rule
            .variances(&leg_reading, &alphas)
            .executed_motion(&leg_reading, unit_noise)
            .poses(&SE2::identity());
        end_pose
    }

    /// Returns the index of the leg whose path is nearest to a point (m), within `radius`.
    pub fn find_nearest(&self, point: [f64; 2], radius: f64) -> Option<usize> {
        let corrected_errors = &self.calibration().corrected;
        let distance_to_path_of = |leg: &Leg| {
            let [leg_start, leg_end] = leg.reference.map(|pose| (pose * corrected_errors.base()).position());
            Segment { from: leg_start, to: leg_end }.distance_to_point(point)
        };
        let path_distances = self.legs().iter().map(distance_to_path_of).enumerate();
        path_distances
            .filter(|(_, distance_to_path_of)| *distance_to_path_of < radius)
            .min_by(|(_, a), (_, b)| a.total_cmp(b))
            .map(|(index, _)| index)
    }
}

/// Regressor of the variance of a noise component. Each component has one α for a rotation, and one for a distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regressor {
    /// Squared distance of a leg, or squared speed of a command.
    Distance,
    /// Squared rotation or squared turn rate; a sum of squares if several rotations add noise.
    Turn,
}

keywords!(Regressor: "distance" = Self::Distance, "turn" = Self::Turn);

/// Maximum number of bins of a panel (diagram). Bins have about equal numbers of legs. Legs with equal motions are in one bin.
pub const BIN_COUNT: usize = 8;

/// Minimum number of legs in a bin. With fewer legs the standard error of their mean is meaningless.
const MIN_LEGS_PER_BIN: usize = 5;

js_structs! {
    /// Diagram of the squared innovations of one noise component against a regressor x. The variances due to the component's other α and to
    /// the reference are subtracted, so that the expectation is α·x.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Panel as "CalibrationPanel" {
        /// Index (from 0) of the α that is the slope of the line through the origin.
        pub alpha: usize,
        /// Mean of the regressor in each bin.
        pub x: Vec<f64>,
        /// Mean squared innovation in each bin, less the variances due to the component's other α and to the reference.
        pub y: Vec<f64>,
        /// Standard errors of `y`: from the scatter of the squared innovations, or from the model, whichever is larger. In a bin that one
        /// leg dominates the scatter is too small.
        pub error: Vec<f64>,
        /// Fitted α, which is the slope of the line; null (None) if the log does not identify the α.
        pub slope: Option<f64>,
        /// 95 % interval of the slope; null (None) if the log does not identify the α.
        pub interval: Option<[f64; 2]>,
    }
}

/// Returns true if the first α of a noise component multiplies the squared translation or speed. For rotations of the odometry models
/// it multiplies the squared rotation.
fn is_translation_first(calibration_model: calibrate::Model, component: usize) -> bool {
    match calibration_model {
        calibrate::Model::Odometry(OdometryRule::Omni) => component > 0,
        calibrate::Model::Odometry(_) => component == 1,
        calibrate::Model::Velocity => true,
    }
}

fn create_panel(
    calibration_model: calibrate::Model,
    calibration: &Calibration,
    component: usize,
    regressor: Regressor,
) -> Panel {
    let Calibration { alphas, intervals: alpha_intervals, observations: leg_observations, leg_fits, .. } =
        calibration;
    let position_in_component =
        usize::from(is_translation_first(calibration_model, component) != (regressor == Regressor::Distance));
    let component_alphas = calibration_model.component_alphas()[component];
    let alpha_index = component_alphas[position_in_component];
    let fitted_alpha = alphas[alpha_index];
    let leg_points: Vec<[f64; 3]> = leg_observations
        .iter()
        .zip(leg_fits)
        .filter(|(leg_observation, leg_fit)| {
            !leg_observation.residuals[component].is_nan() && !leg_fit.is_outlier
        })
        // Legs with sideways motion are omitted, because their odometry readings have large rotations that the robot did not make. A check
        // of the diagnostics counts these legs.
        .filter(|(leg_observation, _)| !leg_observation.moves_sideways(calibration_model))
        .map(|(leg_observation, leg_fit)| {
            let alpha_coefficient = leg_observation.coefficients[component][position_in_component];
            let total_variance = leg_fit.stds[component] * leg_fit.stds[component];
            let variance_from_other_noise = total_variance - fitted_alpha.unwrap_or(0.0) * alpha_coefficient;
            let squared_innovation =
                leg_fit.standardized[component] * leg_fit.standardized[component] * total_variance;
            // The square of a normal variate of variance v has variance 2v².
            [
                alpha_coefficient,
                squared_innovation - variance_from_other_noise,
                2.0 * total_variance * total_variance,
            ]
        })
        .collect();
    let mut scatter_panel = Panel {
        alpha: alpha_index,
        x: Vec::new(),
        y: Vec::new(),
        error: Vec::new(),
        slope: fitted_alpha,
        interval: alpha_intervals[alpha_index],
    };
    if fitted_alpha.is_none() {
        return scatter_panel;
    }
    let mut regressor_values: Vec<f64> = leg_points.iter().map(|point| point[0]).collect();
    regressor_values.sort_unstable_by(f64::total_cmp);
    let bin_size = leg_points.len().div_ceil(BIN_COUNT).max(MIN_LEGS_PER_BIN);
    let mut previous_bin_end = f64::NEG_INFINITY;
    for leg_bin in regressor_values.chunks(bin_size) {
        let bin_end = leg_bin[leg_bin.len() - 1];
        let leg_bin: Vec<&[f64; 3]> =
            leg_points.iter().filter(|point| point[0] > previous_bin_end && point[0] <= bin_end).collect();
        previous_bin_end = bin_end;
        let leg_count = leg_bin.len() as f64;
        let sum_over_bin =
            |term_of: &dyn Fn(&[f64; 3]) -> f64| leg_bin.iter().copied().map(term_of).sum::<f64>();
        let [x, y] =
            [0, 1].map(|coordinate_index| sum_over_bin(&|point| point[coordinate_index]) / leg_count);
        let mean_variance =
            sum_over_bin(&|point| (point[1] - y) * (point[1] - y)) / (leg_count * (leg_count - 1.0));
        let model_variance = sum_over_bin(&|point| point[2]) / (leg_count * leg_count);
        if leg_bin.len() >= MIN_LEGS_PER_BIN {
            scatter_panel.x.push(x);
            scatter_panel.y.push(y);
            scatter_panel.error.push(mean_variance.max(model_variance).sqrt());
        }
    }
    scatter_panel
}
