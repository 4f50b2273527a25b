//! `AlphaCalibrator` for JavaScript.

use super::calibration::{calibration_to_js, columns_to_js};
use super::face::configured;
use super::fields::{read_opening, whole, word};
use super::log::read_logs;
use super::pictures::index_of;
use super::values::{object, plain, settings_to_js};
use crate::sim::alpha_calibrator::{AlphaCalibrator, RestoreError};
use js_sys::TypeError;
use wasm_bindgen::prelude::*;

configured! {
    /// The α's of a log, how well they are known, and whether the model is any good. It opens with a simulated log.
    JsAlphaCalibrator(AlphaCalibrator), "AlphaCalibrator", "AlphaCalibratorSettings", "Partial<AlphaCalibratorSettings>"
}

#[wasm_bindgen(js_class = AlphaCalibrator)]
impl JsAlphaCalibrator {
    /// A machine of these settings with the fit that another has saved. It has no log: settings that need another fit are pending.
    pub fn restored(
        #[wasm_bindgen(unchecked_param_type = "Partial<AlphaCalibratorSettings>")] settings: &JsValue,
        saved: &[u8],
    ) -> Result<Self, JsValue> {
        match AlphaCalibrator::restored(read_opening(settings)?, saved) {
            Ok(machine) => Ok(Self(machine)),
            Err(RestoreError::Settings(error)) => Err(error.into()),
            Err(RestoreError::Bytes) => {
                Err(TypeError::new("saved is no fit; allowed is that of another machine").into())
            }
        }
    }

    /// The fit, for `restored`.
    pub fn save(&self) -> Vec<u8> {
        self.0.saved()
    }

    /// Settings and the number of the fit, at once: `stats` and `legs` are others only if that is.
    #[wasm_bindgen(
        unchecked_return_type = "Pick<AlphaCalibrator, 'config' | 'fittedConfig' | 'fits' | 'isPending'>"
    )]
    pub fn read(&self) -> JsValue {
        object(&[
            ("config", self.config()),
            ("fittedConfig", self.fitted_config()),
            ("fits", self.fits().into()),
            ("isPending", self.is_pending().into()),
        ])
    }

    /// Settings of the fit; those of `config` unless they are pending.
    #[wasm_bindgen(getter, js_name = fittedConfig, unchecked_return_type = "AlphaCalibratorSettings")]
    pub fn fitted_config(&self) -> JsValue {
        settings_to_js(self.0.fitted_settings())
    }

    /// True while the settings need another fit, which only the machine with the log can make.
    #[wasm_bindgen(getter, js_name = isPending)]
    pub fn is_pending(&self) -> bool {
        self.0.is_pending()
    }

    /// Puts a log in the place of the present one: odometry and reference as `calibrate` takes them.
    #[wasm_bindgen(js_name = setLog)]
    pub fn set_log(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "CalibrationOptions['odometry']")] odometry: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "CalibrationOptions['reference']")] reference: &JsValue,
    ) -> Result<(), JsValue> {
        self.0.set_log(read_logs(odometry, reference)?);
        Ok(())
    }

    /// Number of the fit: another one has another number.
    #[wasm_bindgen(getter)]
    pub fn fits(&self) -> u32 {
        self.0.fits()
    }

    /// The true values of the simulated log; null where the log is another.
    #[wasm_bindgen(getter, unchecked_return_type = "CalibrationTruth | null")]
    pub fn truth(&self) -> Result<JsValue, JsValue> {
        plain(&self.0.truth())
    }

    /// Squared residuals of the three noises of the model against the square of the way or of the turn.
    #[wasm_bindgen(unchecked_return_type = "CalibrationPanel[]")]
    pub fn panels(
        &self,
        #[wasm_bindgen(unchecked_param_type = "'way' | 'turn'")] driver: &JsValue,
    ) -> Result<JsValue, JsValue> {
        plain(&self.0.panels(word("driver", driver)?))
    }

    /// One leg, counted from 0; null where there is none of that number.
    #[wasm_bindgen(unchecked_return_type = "LegView | null")]
    pub fn leg(&self, index: f64) -> Result<JsValue, JsValue> {
        plain(&self.0.leg(whole("index", index, 0..=u64::from(u32::MAX))? as usize))
    }

    /// The leg whose way is nearest to a point of the reference and within `radius` of it; −1 for none.
    pub fn nearest(&self, x: f64, y: f64, radius: f64) -> Result<i32, JsValue> {
        index_of(x, y, radius, |target, radius| self.0.nearest(target, radius))
    }

    /// Result of the calibration without its legs; of a log with too few legs, one without any figure.
    #[wasm_bindgen(getter, unchecked_return_type = "Omit<Calibration, 'legs'>")]
    pub fn stats(&self) -> Result<JsValue, JsValue> {
        calibration_to_js(self.0.calibration(), None)
    }

    /// Copies of the legs, in the form that `calibrate` returns.
    #[wasm_bindgen(getter, unchecked_return_type = "CalibrationLegs")]
    pub fn legs(&self) -> JsValue {
        columns_to_js(self.0.calibration())
    }

    /// Number of legs.
    #[wasm_bindgen(getter)]
    pub fn count(&self) -> usize {
        self.0.legs().len()
    }
}
