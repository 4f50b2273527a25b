//! Regression panels: squared residuals against squared distance or rotation. The slope of the line is an α.

use crate::calibrate::{Calibration, Model};
use crate::js::js_structs;
use crate::models::OdometryRule;
use crate::sim::settings::Keywords;

/// Regressor of a variance. Each variance has one α for the rotation and one for the distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regressor {
    /// Squared distance, or squared speed.
    Distance,
    /// Squared rotation, or squared turn rate; the sum for both rotations if both add noise.
    Turn,
}

impl Keywords for Regressor {
    const KEYWORDS: &'static [(&'static str, Self)] = &[("distance", Self::Distance), ("turn", Self::Turn)];
}

/// Number of bins of a panel, with about equal numbers of legs. Legs with equal motions are in one bin.
pub const BIN_COUNT: usize = 8;

/// Minimum number of legs in a bin. With fewer legs the standard error of their mean is meaningless.
const MIN_LEGS_PER_BIN: usize = 5;

js_structs! {
    /// Squared innovations of one noise component against a regressor x. The variances due to the other α and to the reference
    /// are subtracted, so that the expectation is α·x.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Panel as "CalibrationPanel" {
        /// Index of the α that is the slope, from 0.
        pub alpha: usize,
        /// Means of the regressor in the bins.
        pub x: Vec<f64>,
        /// Mean squared innovations of the bins, less the variances due to the other α and to the reference.
        pub y: Vec<f64>,
        /// Standard errors of `y`: from the scatter of the squares, or from the model, whichever is larger. In a bin with
        /// one dominating leg the scatter is too small.
        pub error: Vec<f64>,
        /// Slope: the α. It and its interval are null (None) where the log does not identify the α.
        pub slope: Option<f64>,
        /// 95 % interval of the slope.
        pub interval: Option<[f64; 2]>,
    }
}

/// Returns true if the first α of a noise component multiplies the squared translation or speed. For rotations of the odometry models
/// it multiplies the squared rotation.
fn is_translation_first(model: Model, component: usize) -> bool {
    match model {
        Model::Odometry(OdometryRule::Omni) => component > 0,
        Model::Odometry(_) => component == 1,
        Model::Velocity => true,
    }
}

/// Returns the panel of each of the three noise components.
pub fn create_panels(model: Model, calibration: &Calibration, regressor: Regressor) -> [Panel; 3] {
    [0, 1, 2].map(|component| create_panel(model, calibration, component, regressor))
}

fn create_panel(model: Model, calibration: &Calibration, component: usize, regressor: Regressor) -> Panel {
    let Calibration { alphas, intervals, observations, leg_fits, .. } = calibration;
    let position_in_component =
        usize::from(is_translation_first(model, component) != (regressor == Regressor::Distance));
    let component_alphas = model.component_alphas()[component];
    let alpha_index = component_alphas[position_in_component];
    let slope = alphas[alpha_index];
    let leg_points: Vec<[f64; 3]> = observations
        .iter()
        .zip(leg_fits)
        .filter(|(observation, fit)| !observation.residuals[component].is_nan() && !fit.is_outlier)
        // Legs that seem to move sideways are left out. Their readings have turns that the robot did not make, far beyond all
        // others. A check counts these legs.
        .filter(|(observation, _)| !observation.moves_sideways(model))
        .map(|(observation, fit)| {
            let coefficient = observation.coefficients[component][position_in_component];
            let total_variance = fit.stds[component] * fit.stds[component];
            let other_variance = total_variance - slope.unwrap_or(0.0) * coefficient;
            let squared_innovation =
                fit.standardized[component] * fit.standardized[component] * total_variance;
            // The square of a normal variate of variance v has variance 2v².
            [coefficient, squared_innovation - other_variance, 2.0 * total_variance * total_variance]
        })
        .collect();
    let mut panel = Panel {
        alpha: alpha_index,
        x: Vec::new(),
        y: Vec::new(),
        error: Vec::new(),
        slope,
        interval: intervals[alpha_index],
    };
    // A panel has no bins if its α is not identified, for example the α of rotation for legs that hardly turn.
    if slope.is_none() {
        return panel;
    }
    let mut regressor_values: Vec<f64> = leg_points.iter().map(|point| point[0]).collect();
    regressor_values.sort_unstable_by(f64::total_cmp);
    let bin_size = leg_points.len().div_ceil(BIN_COUNT).max(MIN_LEGS_PER_BIN);
    let mut previous_limit = f64::NEG_INFINITY;
    for bin in regressor_values.chunks(bin_size) {
        let bin_limit = bin[bin.len() - 1];
        let bin: Vec<&[f64; 3]> =
            leg_points.iter().filter(|point| point[0] > previous_limit && point[0] <= bin_limit).collect();
        previous_limit = bin_limit;
        let leg_count = bin.len() as f64;
        let sum_over_bin = |term: &dyn Fn(&[f64; 3]) -> f64| bin.iter().map(|point| term(point)).sum::<f64>();
        let [x, y] = [0, 1].map(|column| sum_over_bin(&|point| point[column]) / leg_count);
        let mean_variance =
            sum_over_bin(&|point| (point[1] - y) * (point[1] - y)) / (leg_count * (leg_count - 1.0));
        let model_variance = sum_over_bin(&|point| point[2]) / (leg_count * leg_count);
        if bin.len() >= MIN_LEGS_PER_BIN {
            panel.x.push(x);
            panel.y.push(y);
            panel.error.push(mean_variance.max(model_variance).sqrt());
        }
    }
    panel
}
