//! Motion models, arc inversion and SE(2) of the chapter for JavaScript, for exercises.

use super::fields::{
    FieldReader, array_item, array_length, check_range, read_array_in_range, read_integer, read_value,
};
use super::values::{JsPose, js_array, pose_to_js, to_plain_js, to_ts, triple_array};
use crate::geom::arc::invert_arc;
use crate::geom::se2::SE2;
use crate::js::js_structs;
use crate::models::{
    Compounding, ConfiguredOdometry, MotionModel, OdomAlphas, OdomDelta, OdometryModel, TangentNoiseModel,
    VelocityAlphas, VelocityCmd, VelocityModel, covariance_root,
};
use crate::noise::NoiseKind;
use crate::sim::banana::MAX_SAMPLES;
use crate::sim::settings::{ALPHA_RANGE, DURATION_RANGE, MAX_SEED, QUANTITY_RANGE};
use js_sys::{Array, Float64Array, RangeError};
use nalgebra::{Matrix3, Vector3};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use tsify::Ts;
use wasm_bindgen::prelude::*;

js_structs! {
    /// Arc that leaves a start pose along its heading and reaches the position of another pose.
    pub struct InvertedArc as "ArcInversion" {
        /// Speed along the arc, m/s; negative in reverse.
        pub v_hat: f64,
        /// Turn rate along the arc, rad/s.
        pub omega_hat: f64,
        /// Rate of the final turn after the arc, rad/s over the same duration.
        pub gamma_hat: f64,
        /// Centre of the arc's circle, m; null for a straight arc.
        pub center: Option<Point>,
        /// Radius, m: positive with the centre to the left of the heading, negative to the right, Infinity for a straight arc.
        pub radius: f64,
        /// Turn of the robot along the arc, rad, −π to π.
        pub turn: f64,
    }

    /// Point of the plane, m.
    pub struct Point {
        pub x: f64,
        pub y: f64,
    }
}

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(typescript_type = "Command")]
    pub type JsCommand;
    #[wasm_bindgen(typescript_type = "OdomDelta")]
    pub type JsReading;
    #[wasm_bindgen(typescript_type = "Twist")]
    pub type JsTwist;
    #[wasm_bindgen(typescript_type = "VelocityModelOptions")]
    pub type JsVelocityModelOptions;
    #[wasm_bindgen(typescript_type = "OdometryModelOptions")]
    pub type JsOdometryModelOptions;
    #[wasm_bindgen(typescript_type = "Propagation")]
    pub type JsPropagation;
}

/// Maximum number of steps of `propagate`, which take a fraction of a second.
const MAX_STEPS: u64 = 100_000;

/// Velocity motion model: noise of speed and turn rate on an arc, and of a final turn after the arc.
#[wasm_bindgen(js_name = VelocityModel)]
pub struct JsVelocityModel(VelocityModel);

#[wasm_bindgen(js_class = VelocityModel)]
impl JsVelocityModel {
    #[wasm_bindgen(constructor)]
    pub fn new(options: &JsVelocityModelOptions) -> Result<Self, JsValue> {
        let fields = FieldReader::new("options", "", options, &["alphas", "noise"])?;
        Ok(Self(VelocityModel { alphas: VelocityAlphas(read_alphas(&fields)?), noise: read_noise(&fields)? }))
    }
}

/// Odometry motion model: noise of the rotation, translation and rotation into which an odometry reading is decomposed.
#[wasm_bindgen(js_name = OdometryModel)]
pub struct JsOdometryModel(ConfiguredOdometry);

#[wasm_bindgen(js_class = OdometryModel)]
impl JsOdometryModel {
    #[wasm_bindgen(constructor)]
    pub fn new(options: &JsOdometryModelOptions) -> Result<Self, JsValue> {
        let fields = FieldReader::new("options", "", options, &["alphas", "noise", "reverseAware"])?;
        let model = OdometryModel { alphas: OdomAlphas(read_alphas(&fields)?), noise: read_noise(&fields)? };
        let reverse_aware = fields.read_or("reverseAware", false, ())?;
        Ok(Self(ConfiguredOdometry { model, reverse_aware }))
    }
}

/// Declares the methods of the JavaScript class of a motion model. `$control` is the type of a command or a reading, which the
/// function `$read_control` reads.
macro_rules! model_methods {
    ($class:ident, $name:literal, $control:ident, $read_control:ident, $(#[$prob_doc:meta])+) => {
        #[wasm_bindgen(js_class = $name)]
        impl $class {
            $(#[$prob_doc])+
            /// The density of a noise of variance 0 counts as 1 if its residual is 0 up to rounding (1e-7), and as 0 otherwise.
            pub fn prob(
                &self,
                next: &JsPose,
                control: &$control,
                start: &JsPose,
            ) -> Result<f64, JsValue> {
                let (next, control, start) =
                    (read_pose("next", next)?, $read_control(control)?, read_pose("start", start)?);
                Ok(self.0.prob(&next, &control, &start))
            }

            /// Returns the density of the sampler over dx dy dθ; null if a variance is 0, infinite if the robot has not moved at all.
            #[wasm_bindgen(js_name = poseDensity, unchecked_return_type = "number | null")]
            pub fn pose_density(
                &self,
                next: &JsPose,
                control: &$control,
                start: &JsPose,
            ) -> Result<JsValue, JsValue> {
                let (next, control, start) =
                    (read_pose("next", next)?, $read_control(control)?, read_pose("start", start)?);
                Ok(to_plain_js(&self.0.pose_density(&next, &control, &start)))
            }

            /// Returns samples of the pose after the motion, as x, y, θ triples. Equal seeds (whole numbers) give equal samples.
            pub fn sample(
                &self,
                control: &$control,
                start: &JsPose,
                count: f64,
                seed: f64,
            ) -> Result<Float64Array, JsValue> {
                let (control, start) = ($read_control(control)?, read_pose("start", start)?);
                let count = read_integer("count", count, 0..=MAX_SAMPLES as u64)? as usize;
                let mut rng = Xoshiro256PlusPlus::seed_from_u64(read_integer("seed", seed, 0..=MAX_SEED)?);
                Ok(triple_array((0..count).map(|_| self.0.sample(&control, &start, &mut rng))))
            }
        }
    };
}
model_methods! {
    JsVelocityModel, "VelocityModel", JsCommand, read_command,
    /// Scoring function of Table 5.1, with a signed radius, for the arc that turns by at most half a circle.
}
model_methods! {
    JsOdometryModel, "OdometryModel", JsReading, read_legs,
    /// Scoring function of Table 5.5, with the variances of the motion between the poses, not of the reading.
}

/// Returns the arc that leaves `start` along its heading and reaches the position of `next` in `dt` seconds (Table 5.1, with a signed
/// radius). Of the arcs on that circle, it is the one that turns by at most half a circle.
#[wasm_bindgen(js_name = invertArc)]
pub fn js_invert_arc(start: &JsPose, next: &JsPose, dt: f64) -> Result<Ts<InvertedArc>, JsValue> {
    let (start, next, dt) =
        (read_pose("start", start)?, read_pose("next", next)?, check_range("dt", dt, &DURATION_RANGE)?);
    let inverted_arc = invert_arc(&start, &next, dt);
    // A straight drive in reverse has the turn rate −0. Adding 0 removes the minus.
    let omega_hat = inverted_arc.omega_hat + 0.0;
    Ok(to_ts(&InvertedArc {
        v_hat: inverted_arc.v_hat,
        omega_hat,
        gamma_hat: inverted_arc.gamma_hat,
        center: inverted_arc.centre(&start).map(|[x, y]| Point { x, y }),
        radius: inverted_arc.radius(),
        turn: omega_hat * dt,
    }))
}

/// Returns rotation, translation and rotation between two odometry poses (Table 5.5). A turn on the spot is all in `rot2`.
#[wasm_bindgen]
pub fn decompose(start: &JsPose, next: &JsPose) -> Result<Ts<OdomDelta>, JsValue> {
    Ok(to_ts(&OdomDelta::from_poses(&read_pose("start", start)?, &read_pose("next", next)?)))
}

/// Returns the covariance, in exponential coordinates about the noise-free pose, after a command was driven several times. The fourth order
/// is a series expansion; noise that is too large for it is refused.
#[wasm_bindgen(unchecked_return_type = "number[][]")]
pub fn propagate(options: &JsPropagation) -> Result<Array, JsValue> {
    let fields =
        FieldReader::new("options", "", options, &["sigma", "command", "alphas", "compounding", "steps"])?;
    let mut sigma = fields.read_optional("sigma", read_covariance)?.unwrap_or_default();
    let command = read_command(&fields.value("command")?)?;
    let model = VelocityModel { alphas: VelocityAlphas(read_alphas(&fields)?), noise: NoiseKind::Normal };
    let compounding = fields.read_or("compounding", Compounding::Chapter, ())?;
    let step_count = fields.read_or("steps", 1u64, 1..=MAX_STEPS)?;
    // `from_velocity` succeeds, because the ranges of the arguments exclude negative and infinite variances.
    let noise_model = TangentNoiseModel::from_velocity(&model, &command)
        .map_err(|model_error| RangeError::new(&model_error.to_string()))?;
    let twist = TangentNoiseModel::twist(&command);
    for step_index in 0..step_count {
        sigma = noise_model.propagate(&sigma, &twist, compounding);
        // The first-order and chapter recursions only add covariances. Only the fourth order can give an indefinite matrix.
        if compounding == Compounding::FourthOrder && covariance_root(&sigma).is_err() {
            let error_message = format!(
                "steps is {step_count}; allowed are at most {step_index} here: the next leaves no covariance, for the noise is too large"
            );
            return Err(RangeError::new(&error_message).into());
        }
    }
    Ok(matrix_rows(&sigma))
}

/// Exponential map: returns the pose to which a twist leads from the origin in one unit of time.
#[wasm_bindgen(js_namespace = se2)]
pub fn exp(twist: &JsTwist) -> Result<JsPose, JsValue> {
    Ok(pose_to_js(SE2::exp(&read_twist("twist", twist)?)))
}

/// Logarithm: returns the twist that leads from the origin to a pose in one unit of time, with a turn of at most half a circle.
#[wasm_bindgen(js_namespace = se2, unchecked_return_type = "number[]")]
pub fn log(pose: &JsPose) -> Result<JsValue, JsValue> {
    Ok(js_array(read_pose("pose", pose)?.log().as_slice()))
}

/// Composition a · b: returns the pose `b`, which is given in the frame of `a`, in the reference frame of `a`.
#[wasm_bindgen(js_namespace = se2)]
pub fn compose(a: &JsPose, b: &JsPose) -> Result<JsPose, JsValue> {
    Ok(pose_to_js(read_pose("a", a)? * read_pose("b", b)?))
}

/// Inverse: returns the origin in the frame of a pose.
#[wasm_bindgen(js_namespace = se2)]
pub fn inverse(pose: &JsPose) -> Result<JsPose, JsValue> {
    Ok(pose_to_js(read_pose("pose", pose)?.inverse()))
}

/// Returns x ⊞ τ = x · exp(τ).
#[wasm_bindgen(js_namespace = se2)]
pub fn boxplus(pose: &JsPose, twist: &JsTwist) -> Result<JsPose, JsValue> {
    Ok(pose_to_js(read_pose("pose", pose)?.boxplus(read_twist("twist", twist)?)))
}

/// Returns a ⊟ b = log(b⁻¹ · a), the twist that leads from `b` to `a`.
#[wasm_bindgen(js_namespace = se2, unchecked_return_type = "number[]")]
pub fn boxminus(a: &JsPose, b: &JsPose) -> Result<JsValue, JsValue> {
    Ok(js_array(read_pose("a", a)?.boxminus(&read_pose("b", b)?).as_slice()))
}

/// Returns the adjoint of a pose, three rows of three.
#[wasm_bindgen(js_namespace = se2, unchecked_return_type = "number[][]")]
pub fn adjoint(pose: &JsPose) -> Result<Array, JsValue> {
    Ok(matrix_rows(&read_pose("pose", pose)?.adjoint()))
}

/// Returns the right Jacobian J_r of a twist, three rows of three: exp(τ + δ) is exp(τ) · exp(J_r δ) to first order.
#[wasm_bindgen(js_namespace = se2, js_name = rightJacobian, unchecked_return_type = "number[][]")]
pub fn right_jacobian(twist: &JsTwist) -> Result<Array, JsValue> {
    Ok(matrix_rows(&SE2::right_jacobian(&read_twist("twist", twist)?)))
}

fn read_alphas<const N: usize>(fields: &FieldReader) -> Result<[f64; N], JsValue> {
    read_array_in_range("alphas", &fields.value("alphas")?, &ALPHA_RANGE)
}

fn read_noise(fields: &FieldReader) -> Result<NoiseKind, JsValue> {
    fields.read_or("noise", NoiseKind::Normal, ())
}

fn read_pose(field_path: &str, js_value: &JsValue) -> Result<SE2, JsValue> {
    Ok(read_value(field_path, js_value, [0.0; 3], ())?.into())
}

fn read_command(js_value: &JsValue) -> Result<VelocityCmd, JsValue> {
    read_value("command", js_value, VelocityCmd { v: 0.0, omega: 0.0, dt: 0.0 }, ())
}

fn read_legs(js_value: &JsValue) -> Result<OdomDelta, JsValue> {
    read_value("control", js_value, OdomDelta { rot1: 0.0, trans: 0.0, rot2: 0.0 }, ())
}

fn read_twist(field_path: &str, js_value: &JsValue) -> Result<Vector3<f64>, JsValue> {
    Ok(read_array_in_range(field_path, js_value, &QUANTITY_RANGE)?.into())
}

fn read_covariance(field_path: &str, js_value: &JsValue) -> Result<Matrix3<f64>, JsValue> {
    let allowed_text = "three rows of three numbers";
    let row_count = array_length(field_path, js_value, allowed_text)?;
    if row_count != 3 {
        return Err(RangeError::new(&format!(
            "{field_path} has length {row_count}; allowed are {allowed_text}"
        ))
        .into());
    }
    let mut covariance_matrix = Matrix3::zeros();
    for i in 0..3 {
        let row: [f64; 3] =
            read_array_in_range(&format!("{field_path}[{i}]"), &array_item(js_value, i)?, &QUANTITY_RANGE)?;
        covariance_matrix.set_row(i, &Vector3::from(row).transpose());
    }
    covariance_root(&covariance_matrix)
        .map_err(|model_error| RangeError::new(&format!("{field_path} is no covariance: {model_error}")))?;
    Ok(covariance_matrix)
}

fn matrix_rows(covariance_matrix: &Matrix3<f64>) -> Array {
    covariance_matrix.row_iter().map(|row| js_array(&[row[0], row[1], row[2]])).collect()
}
