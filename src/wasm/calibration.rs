//! What a log says of a robot's α's, as plain JavaScript values.

use super::calibrate::SYSTEMATIC;
use super::values::{float64_array, list, number_or_null, object};
use crate::calibrate::{
    AtLength, Calibration, Doubts, Error, Inflation, KindDoubts, Undetermined, Verdict, Which,
};
use crate::geom::se2::SE2;
use js_sys::Array;
use wasm_bindgen::prelude::*;

/// All that is told of a calibration, with its legs.
pub fn calibration_to_js(
    calibration: &Calibration,
    remove: Which,
    gaps: [usize; 2],
    legs: JsValue,
) -> Result<JsValue, JsValue> {
    let Calibration { estimate, undetermined, bootstrap, doubts, inflation, by_length, .. } = calibration;
    let undetermined: Array = undetermined.iter().map(|reason| undetermined_word(*reason)).collect();
    let by_length = by_length
        .iter()
        .map(|at| at_length_to_js(at, estimate.alphas.len()))
        .collect::<Result<Array, JsValue>>()?;
    let [odometry_gaps, reference_gaps] = gaps.map(|gaps| JsValue::from(gaps as f64));
    object(&[
        ("alphas", alphas(&estimate.alphas)),
        ("undetermined", undetermined.into()),
        ("intervals", intervals(&estimate.intervals)?),
        ("bootstrap", intervals(bootstrap)?),
        ("systematic", systematic_to_js(calibration, remove)?),
        ("logLikelihood", estimate.log_likelihood.into()),
        ("outliers", number_or_null(estimate.outliers)),
        ("doubts", doubts_to_js(doubts)?),
        ("inflation", inflation_to_js(inflation)?),
        ("byLength", by_length.into()),
        ("gaps", object(&[("odometry", odometry_gaps), ("reference", reference_gaps)])?),
        ("legs", legs),
    ])
}

fn known(number: f64) -> JsValue {
    number_or_null(Some(number).filter(|number| !number.is_nan()))
}

fn alphas(alphas: &[f64]) -> JsValue {
    alphas.iter().map(|alpha| known(*alpha)).collect::<Array>().into()
}

fn undetermined_word(reason: Option<Undetermined>) -> JsValue {
    reason.map_or(JsValue::NULL, |reason| {
        let word = match reason {
            Undetermined::TurnsTooLittle => "turns-too-little",
            Undetermined::DrivesTooLittle => "drives-too-little",
            Undetermined::OneRatio => "one-ratio",
        };
        word.into()
    })
}

/// Without an estimate none of the α's is told.
fn at_length_to_js(at: &AtLength, count: usize) -> Result<JsValue, JsValue> {
    let (none, unknown) = (vec![f64::NAN; count], vec![None; count]);
    let (told, their) =
        at.estimate.as_ref().map_or((&none, &unknown), |told| (&told.alphas, &told.intervals));
    object(&[
        ("factor", at.factor.into()),
        ("legs", (at.legs as f64).into()),
        ("alphas", alphas(told)),
        ("intervals", intervals(their)?),
    ])
}

fn interval(interval: Option<[f64; 2]>) -> Result<JsValue, JsValue> {
    interval.map_or(Ok(JsValue::NULL), |interval| list(&interval))
}

fn intervals(intervals: &[Option<[f64; 2]>]) -> Result<JsValue, JsValue> {
    Ok(intervals.iter().map(|each| interval(*each)).collect::<Result<Array, JsValue>>()?.into())
}

fn systematic_to_js(calibration: &Calibration, remove: Which) -> Result<JsValue, JsValue> {
    let value = |error: Error| {
        let determined = calibration.deviations[error as usize].is_some();
        number_or_null(determined.then(|| calibration.systematic.get(error)))
    };
    let of = |error: Error| interval(calibration.interval_of(error));
    let entries = SYSTEMATIC.iter().map(|(key, errors)| {
        let [value, interval] = match errors {
            [error] => [value(*error), of(*error)?],
            errors => [
                errors.iter().map(|error| value(*error)).collect::<Array>().into(),
                errors.iter().map(|error| of(*error)).collect::<Result<Array, JsValue>>()?.into(),
            ],
        };
        let removed = remove[errors[0] as usize].into();
        Ok((*key, object(&[("value", value), ("interval", interval), ("removed", removed)])?))
    });
    object(&entries.collect::<Result<Vec<_>, JsValue>>()?)
}

fn doubts_to_js(doubts: &Doubts) -> Result<JsValue, JsValue> {
    let Doubts { kinds, held_out, worst, verdict } = doubts;
    let kinds = kinds.iter().map(kind_to_js).collect::<Result<Array, JsValue>>()?;
    let worst: Vec<f64> = worst.iter().map(|place| *place as f64).collect();
    object(&[
        ("kinds", kinds.into()),
        (
            "heldOut",
            object(&[
                ("count", (held_out.count as f64).into()),
                ("coverage", held_out.coverage.into()),
                ("expected", 0.95.into()),
                ("interval", list(&held_out.coverage_interval)?),
                ("logLikelihood", held_out.log_likelihood.into()),
            ])?,
        ),
        (
            "squaredError",
            object(&[
                ("mean", held_out.squared_error.into()),
                ("interval", list(&held_out.squared_error_interval)?),
            ])?,
        ),
        ("worst", list(&worst)?),
        ("verdict", verdict_word(*verdict).into()),
    ])
}

fn kind_to_js(kind: &KindDoubts) -> Result<JsValue, JsValue> {
    object(&[
        ("name", kind.name.into()),
        ("count", (kind.count as f64).into()),
        ("kurtosis", kind.kurtosis.into()),
        ("autocorrelation", kind.autocorrelation.into()),
        ("autocorrelationLimit", kind.autocorrelation_limit.into()),
        ("quantiles", float64_array(&kind.quantiles)?.into()),
    ])
}

fn verdict_word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::FewLegs => "few-legs",
        Verdict::HeavyTails => "heavy-tails",
        Verdict::Correlated => "correlated",
        Verdict::Overconfident => "overconfident",
        Verdict::Lazy => "lazy",
        Verdict::Fits => "fits",
    }
}

fn inflation_to_js(inflation: &Inflation) -> Result<JsValue, JsValue> {
    object(&[
        ("factors", float64_array(&inflation.factors)?.into()),
        ("coverage", float64_array(&inflation.coverage)?.into()),
        ("logLikelihood", float64_array(&inflation.log_likelihood)?.into()),
    ])
}

/// The legs of a calibration.
pub fn legs_to_js(calibration: &Calibration) -> Result<JsValue, JsValue> {
    let Calibration { legs, observations, judged, removed, .. } = calibration;
    let array = |numbers: Vec<f64>| float64_array(&numbers).map(JsValue::from);
    let pose = |pose: SE2| [pose.x(), pose.y(), pose.theta()];
    object(&[
        ("count", (legs.len() as f64).into()),
        ("times", array(legs.iter().flat_map(|leg| leg.times).collect())?),
        ("odometry", array(legs.iter().flat_map(|leg| leg.odometry).flat_map(pose).collect())?),
        (
            "reference",
            array(
                legs.iter().flat_map(|leg| leg.reference).flat_map(|end| pose(removed.base(&end))).collect(),
            )?,
        ),
        ("readings", array(observations.iter().flat_map(|each| each.reading).collect())?),
        ("residuals", array(observations.iter().flat_map(|each| each.residuals).collect())?),
        ("deviations", array(judged.iter().flat_map(|leg| leg.deviations).collect())?),
        ("squaredError", array(judged.iter().map(|leg| leg.squared_error).collect())?),
        ("bad", array(judged.iter().map(|leg| leg.bad).collect())?),
    ])
}
