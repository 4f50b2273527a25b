//! `AlphaCalibrator` for JavaScript.

use super::calibration::{calibration_to_js, columns, columns_to_js};
use super::fields::{read_opening, read_settings, whole, word, work};
use super::held::Held;
use super::log::{read_odometry, read_reference};
use super::pictures::read_disc;
use super::values::{Plain, float64_array, object, settings_to_js};
use crate::sim::alpha_calibrator::{AlphaCalibrator, LegView, Log, Panel, Settings, Truth};
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** The true values of the simulated log. */
export interface CalibrationTruth {
  /** Of the rule `table` on legs of 0.25 m or 0.2 rad. */
  alphas: number[];
  clockOffset: number;
  mountYaw: number;
  leverArm: number[];
  distanceScale: number;
  turnScale: number;
}

/** The squared residuals of one noise against what drives it, in bins. */
export interface CalibrationPanel {
  /** The α that is the slope, from 0. */
  alpha: number;
  /** Means of the bins. */
  x: number[];
  /** Mean squared residuals, less what the other α answers for. */
  y: number[];
  /** Standard errors of `y`. */
  error: number[];
  slope: number | null;
  interval: [number, number] | null;
}

/** One leg in the frame of the robot at its beginning, m and rad. */
export interface LegView {
  /** x, y, θ of where it may have ended under the fitted α's times the inflation. */
  outcomes: Float64Array;
  /** The 2σ ellipse of these as x, y pairs; empty where there is no noise. */
  outline: Float64Array;
  /** x, y, θ of where the odometry says that it ended. */
  read: Float64Array;
  /** x, y, θ of where it ended. */
  ended: Float64Array;
}
"#;

/// The α's of a log, how well they are known, and whether the model is any good. It opens with a simulated log. Metres,
/// radians, seconds throughout. Whatever is out of range throws a TypeError or RangeError that names the field, and changes
/// nothing.
#[wasm_bindgen(js_name = AlphaCalibrator)]
pub struct JsAlphaCalibrator(Held<AlphaCalibrator>);

#[wasm_bindgen(js_class = AlphaCalibrator)]
impl JsAlphaCalibrator {
    /// What is left out is as the widget opens.
    #[wasm_bindgen(constructor)]
    pub fn new(
        #[wasm_bindgen(unchecked_optional_param_type = "Partial<AlphaCalibratorSettings>")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(AlphaCalibrator::new(read_opening(options)?)?)))
    }

    /// As the constructor, but for `advance`, which is to be called until it says true: until then there is nothing to show.
    pub fn empty(
        #[wasm_bindgen(unchecked_optional_param_type = "Partial<AlphaCalibratorSettings>")] options: &JsValue,
    ) -> Result<Self, JsValue> {
        Ok(Self(Held::new(AlphaCalibrator::empty(read_opening(options)?)?)))
    }

    /// Changes the settings that are named.
    pub fn configure(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<AlphaCalibratorSettings>")] settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.configure(settings))?)
    }

    /// As `configure`, in slices: `advance` is to be called until it says true. Until then the figures are the former ones.
    pub fn begin(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Partial<AlphaCalibratorSettings>")] settings: &JsValue,
    ) -> Result<(), JsValue> {
        let settings = read_settings(&self.settings(), settings)?;
        Ok(self.0.with(move |machine| machine.begin(settings))?)
    }

    /// Works on what was begun, by a step of its own, however much is asked for; whether all is done.
    pub fn advance(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] steps: &JsValue,
    ) -> Result<bool, JsValue> {
        work("steps", steps)?;
        Ok(self.0.with(AlphaCalibrator::advance))
    }

    /// Puts a log in the place of the present one: odometry and reference as `calibrate` takes them.
    #[wasm_bindgen(js_name = setLog)]
    pub fn set_log(
        &self,
        #[wasm_bindgen(unchecked_param_type = "LoggedPoses | LoggedCommands")] odometry: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "LoggedReference")] reference: &JsValue,
    ) -> Result<(), JsValue> {
        let log = read_log(odometry, reference)?;
        self.0.with(move |machine| machine.set_log(log));
        Ok(())
    }

    /// As `setLog`, in slices like `begin`.
    #[wasm_bindgen(js_name = beginLog)]
    pub fn begin_log(
        &self,
        #[wasm_bindgen(unchecked_param_type = "LoggedPoses | LoggedCommands")] odometry: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "LoggedReference")] reference: &JsValue,
    ) -> Result<(), JsValue> {
        let log = read_log(odometry, reference)?;
        self.0.with(move |machine| machine.begin_log(log));
        Ok(())
    }

    /// How much is done of what was begun, from 0 to 1.
    #[wasm_bindgen(getter)]
    pub fn progress(&self) -> f64 {
        self.0.with(|machine| machine.progress())
    }

    /// How often the figures have become others since the machine was made.
    #[wasm_bindgen(getter)]
    pub fn fits(&self) -> u32 {
        self.0.with(|machine| machine.fits())
    }

    /// Gives up what was begun: settings and figures are the former ones.
    pub fn stop(&self) {
        self.0.with(AlphaCalibrator::stop);
    }

    /// A copy; changing it changes nothing.
    #[wasm_bindgen(getter, unchecked_return_type = "AlphaCalibratorSettings")]
    pub fn config(&self) -> Result<JsValue, JsValue> {
        settings_to_js(&self.settings())
    }

    /// The true values of the simulated log; null where the log is another.
    #[wasm_bindgen(getter, unchecked_return_type = "CalibrationTruth | null")]
    pub fn truth(&self) -> Plain<Option<Truth>> {
        Plain(Ok(self.0.with(|machine| machine.truth())))
    }

    /// Squared residuals of the three noises of the model against the square of the way or of the turn.
    #[wasm_bindgen(unchecked_return_type = "CalibrationPanel[]")]
    pub fn panels(
        &self,
        #[wasm_bindgen(unchecked_param_type = "'way' | 'turn'")] driver: &JsValue,
    ) -> Plain<[Panel; 3]> {
        Plain(word("driver", driver).map(|driver| self.0.with(move |machine| machine.panels(driver))))
    }

    /// One leg, counted from 0; null where there is none of that number.
    #[wasm_bindgen(unchecked_return_type = "LegView | null")]
    pub fn leg(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] index: &JsValue,
    ) -> Result<JsValue, JsValue> {
        let index = whole("index", index, 0..=u64::from(u32::MAX))? as usize;
        let Some(LegView { outcomes, outline, read, ended }) = self.0.with(move |machine| machine.leg(index))
        else {
            return Ok(JsValue::NULL);
        };
        object(&[
            ("outcomes", float64_array(outcomes.as_flattened())?.into()),
            ("outline", float64_array(outline.as_flattened())?.into()),
            ("read", float64_array(&read)?.into()),
            ("ended", float64_array(&ended)?.into()),
        ])
    }

    /// The leg whose way is nearest to a point of the reference and within `radius` of it; −1 for none.
    pub fn nearest(
        &self,
        #[wasm_bindgen(unchecked_param_type = "number")] x: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] y: &JsValue,
        #[wasm_bindgen(unchecked_param_type = "number")] radius: &JsValue,
    ) -> Result<i32, JsValue> {
        let (target, radius) = read_disc(x, y, radius)?;
        Ok(self.0.with(move |machine| machine.nearest(target, radius)).map_or(-1, |index| index as i32))
    }

    /// All that the log says but for its legs, as `calibrate` tells it; of too few legs, without any figure.
    #[wasm_bindgen(getter, unchecked_return_type = "Omit<Calibration, 'legs'>")]
    pub fn stats(&self) -> Result<JsValue, JsValue> {
        let (summary, remove, gaps) = self.0.with(|machine| {
            let gaps =
                machine.log().map(|Log { odometry, reference, .. }| [odometry.gaps(), reference.gaps()]);
            (machine.summary(), machine.shown_settings().removed(), gaps.unwrap_or_default())
        });
        calibration_to_js(&summary, remove, gaps, None)
    }

    /// The legs, as `calibrate` tells them; copies.
    #[wasm_bindgen(getter, unchecked_return_type = "CalibrationLegs")]
    pub fn legs(&self) -> Result<JsValue, JsValue> {
        columns_to_js(&self.0.with(|machine| columns(machine.calibration())))
    }

    /// How many legs there are.
    #[wasm_bindgen(getter)]
    pub fn count(&self) -> usize {
        self.0.with(|machine| machine.legs().len())
    }
}

impl JsAlphaCalibrator {
    fn settings(&self) -> Settings {
        self.0.with(|machine| *machine.settings())
    }
}

fn read_log(odometry: &JsValue, reference: &JsValue) -> Result<Log, JsValue> {
    let odometry = read_odometry("odometry", odometry)?;
    let (reference, error) = read_reference("reference", reference)?;
    Ok(Log { odometry, reference, error })
}
