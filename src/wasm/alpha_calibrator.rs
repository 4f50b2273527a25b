//! JavaScript class `AlphaCalibrator`.

use super::calibration::{calibration_to_js, legs_to_js};
use super::fields::{read_initial_settings, read_integer, read_value};
use super::log::read_logs;
use super::pictures::nearest_index;
use super::simulation_class::simulation_class;
use super::values::to_plain_js;
use crate::sim::alpha_calibrator::{AlphaCalibrator, Regressor};
use js_sys::TypeError;
use wasm_bindgen::prelude::*;

simulation_class! {
    /// Calibration of α's from a log, with confidence intervals and goodness of fit. It opens with a simulated log.
    JsAlphaCalibrator(AlphaCalibrator), "AlphaCalibrator", "AlphaCalibratorSettings", "Partial<AlphaCalibratorSettings>", |simulation|
    /// Settings, and the revision of the fit, in one call. `stats` and `legs` change only if that revision changes.
    read as "AlphaCalibratorView" {
        /// Settings of the present fit. They differ from `config` until a fit with the settings in `config` is finished.
        fitted_config as "fittedConfig": "AlphaCalibratorSettings" = to_plain_js(simulation.fitted_settings());
        /// Revision of the fit, a number that changes with each new fit.
        fit_revision as "fits": "number" = simulation.fit_revision();
        /// True while the settings need another fit, which only a simulation with the log can compute.
        is_pending as "isPending": "boolean" = simulation.is_pending();
    }
    others {
        /// True parameters of the simulated log; null for any other log.
        truth: "CalibrationTruth | null" = to_plain_js(&simulation.truth());
        /// Result of the calibration, without its legs. All α’s are null if the log has too few legs.
        stats: "CalibrationStats" = calibration_to_js(simulation.calibration());
        /// Copy of the legs, in the form that `calibrate` returns.
        legs: "CalibrationLegs" = legs_to_js(simulation.calibration());
        /// Number of legs.
        count: "number" = simulation.legs().len();
    }
}

#[wasm_bindgen(js_class = AlphaCalibrator)]
impl JsAlphaCalibrator {
    /// Creates a simulation with these settings and a fit that another simulation has saved. It has no log, so that settings that need
    /// another fit stay pending.
    #[wasm_bindgen(js_name = restored)]
    pub fn restore(
        #[wasm_bindgen(unchecked_param_type = "Partial<AlphaCalibratorSettings>")] settings: &JsValue,
        saved: &[u8],
    ) -> Result<Self, JsValue> {
        let saved_calibration = postcard::from_bytes(saved)
            .map_err(|_| TypeError::new("saved is no fit; allowed is that of another simulation"))?;
        Ok(Self(AlphaCalibrator::restore(read_initial_settings(settings)?, saved_calibration)?))
    }

    /// Returns the fit as bytes, from which `restored` creates a simulation.
    pub fn save(&self) -> Vec<u8> {
        postcard::to_allocvec(self.0.calibration()).unwrap_or_default()
    }

    /// Replaces the log by the given odometry and reference, in the form that `calibrate` takes.
    #[wasm_bindgen(js_name = setLog)]
    pub fn set_log(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "CalibrationOptions['odometry']")] odometry: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "CalibrationOptions['reference']")] reference: &JsValue,
    ) -> Result<(), JsValue> {
        self.0.set_log(read_logs(odometry, reference)?);
        Ok(())
    }

    /// Returns a diagram for each of the three noise components of the model: squared residuals against the square of the distance or of
    /// the turn.
    #[wasm_bindgen(unchecked_return_type = "CalibrationPanel[]")]
    pub fn panels(
        &self,
        #[wasm_bindgen(unchecked_param_type = "'distance' | 'turn'")] regressor: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let regressor = read_value("regressor", regressor, Regressor::Distance, ())?;
        Ok(to_plain_js(&self.0.panels(regressor)))
    }

    /// Returns one leg by its index, counted from 0; null if there are fewer legs.
    #[wasm_bindgen(unchecked_return_type = "LegView | null")]
    pub fn leg(&self, index: f64) -> Result<JsValue, JsValue> {
        Ok(to_plain_js(&self.0.leg(read_integer("index", index, 0..=u64::from(u32::MAX))? as usize)))
    }

    /// Returns the index of the leg whose path, as measured by the reference, is nearest to a point and within `radius` of it; −1 for none.
    pub fn nearest(&self, x: f64, y: f64, radius: f64) -> Result<i32, JsValue> {
        nearest_index(x, y, radius, |target_point, radius| self.0.find_nearest(target_point, radius))
    }
}
