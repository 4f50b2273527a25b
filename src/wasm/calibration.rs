//! Calibrations as plain JavaScript values.

use super::values::{floats, list, number_or_null, object};
use crate::calibrate::{
    AtLength, Calibration, Doubts, Error, Inflation, KindDoubts, Undetermined, Verdict, Which,
};
use js_sys::Array;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
/** An interval that holds the true value in 95 of 100 logs. */
export type Interval = [number, number];

/** A systematic error: what the reference says of the odometry. Null where the log does not determine it. */
export interface SystematicValue {
  value: number | null;
  interval: Interval | null;
  /** Whether it was removed before the α's were fitted: of what was to be, what the log determines. */
  removed: boolean;
}

/** The residuals of one kind, each by its standard deviation; bad legs left out. */
export interface KindDoubts {
  name: 'rot1' | 'trans' | 'rot2' | 'strafe' | 'v' | 'omega' | 'gamma';
  count: number;
  /** Of each half of the log by itself, in the mean. */
  kurtosis: number;
  /** What that is if the model is true: of normal noise 3, of triangular 2.4 and more, as the reference's own error is normal. */
  kurtosisExpected: number;
  /** Of neighbouring legs; the model says 0. */
  autocorrelation: number;
  /** Below this it is in 95 of 100 logs of which the model is true. */
  autocorrelationLimit: number;
  /** At 0.01, 0.02, … 0.99. */
  quantiles: Float64Array;
}

/** What a log says of a robot's α's. */
export interface Calibration {
  /** Null where this log does not determine one. */
  alphas: (number | null)[];
  /**
   * Why not, null where it does: the robot turned too little (under the velocity model while it drove); it hardly went anywhere;
   * the reference's stated error is larger than what even an α of 1 would make of its turns or ways; or turn and way had one ratio in all legs, so that one α may answer for what is another's.
   */
  undetermined: ('turns-too-little' | 'drives-too-little' | 'reference-too-coarse' | 'one-ratio' | null)[];
  /** By the profile of the likelihood. */
  intervals: (Interval | null)[];
  /** By a bootstrap of blocks of legs, which does not take them for independent. */
  bootstrap: (Interval | null)[];
  /**
   * Reference's time = odometry's time + clockOffset (s); reference's heading = base's heading + mountYaw (rad); the point that
   * the reference follows is at leverArm (m, ahead and to the left) of the base; true distance = distanceScale × odometry's;
   * true turn = turnScale × odometry's.
   */
  systematic: {
    clockOffset: SystematicValue;
    mountYaw: SystematicValue;
    leverArm: { value: [number | null, number | null]; interval: [Interval | null, Interval | null]; removed: boolean };
    distanceScale: SystematicValue;
    turnScale: SystematicValue;
  };
  legs: CalibrationLegs;
  /** Of the residuals, nats. */
  logLikelihood: number;
  /** The share of bad legs; null where none is taken for bad. */
  outliers: number | null;
  doubts: {
    kinds: KindDoubts[];
    /** The second half of the log by the α's of the first; intervals say where a figure is in 95 of 100 logs of which the model is true. */
    heldOut: { count: number; coverage: number; expected: number; interval: Interval; logLikelihood: number };
    /** The mean of (r/σ)² over the held-out residuals. */
    squaredError: { mean: number; interval: Interval };
    /** Places of the legs that are furthest from what was expected, the worst first. */
    worst: number[];
    verdict: 'few-legs' | 'unrelated' | 'long-legs' | 'overstated' | 'correlated' | 'understated' | 'heavy-tails' | 'overconfident' | 'lazy' | 'fits';
  };
  /** What α's larger by a factor make of the held-out half: the share inside of 95 % intervals, and nats a leg. */
  inflation: { factors: Float64Array; coverage: Float64Array; logLikelihood: Float64Array };
  /** By the lengths of legs, from the shortest on; empty unless asked for. */
  byLength: AlphasAtLength[];
  /** How often nothing is known of the way, because a trajectory pauses or is said to break: no leg leads across. */
  gaps: { odometry: number; reference: number };
}

/** The α's of legs of another length, without the systematic errors that those asked for have told. */
export interface AlphasAtLength {
  /** Their distance and angle, or their duration, are those asked for times ¼, ½, 1, 2 or 4. */
  factor: number;
  /** How many were fitted: of more than 20 000 as many are taken evenly. */
  legs: number;
  /**
   * Null where they do not determine one: none where legs are fewer than eight, mostly shorter than four rows of the log, or such that
   * turns of more than half a circle would be lost.
   */
  alphas: (number | null)[];
  intervals: (Interval | null)[];
  /** 95 % too, not taking legs for independent: much longer where a few legs that are far out decide. */
  bootstrap: (Interval | null)[];
}

/** Legs, one after the other in each array. */
export interface CalibrationLegs {
  count: number;
  /** Beginning and end, s. */
  times: Float64Array;
  /** Both ends in the odometry frame, x, y, θ. */
  odometry: Float64Array;
  /** Both ends of the robot's base by the reference, x, y, θ, without the lever arm and the mount's yaw. */
  reference: Float64Array;
  /** rot1, trans, rot2; or v, ω, Δt. */
  readings: Float64Array;
  /** Executed less expected, of the three kinds in their order; NaN of one that a leg does not tell. */
  residuals: Float64Array;
  /** Their standard deviations under the α's. */
  deviations: Float64Array;
  /** Σ (r/σ)². */
  squaredError: Float64Array;
  /** The probability that the leg is bad. */
  bad: Float64Array;
}
"#;

/// Name of each systematic error, and its members of [`Error::ALL`].
pub const SYSTEMATIC: [(&str, &[Error]); 5] = [
    ("clockOffset", &[Error::ClockOffset]),
    ("mountYaw", &[Error::MountYaw]),
    ("leverArm", &[Error::LeverArmAhead, Error::LeverArmLeft]),
    ("distanceScale", &[Error::DistanceScale]),
    ("turnScale", &[Error::TurnScale]),
];

/// All that is told of a calibration; its legs where they are given.
pub fn calibration_to_js(
    calibration: &Calibration,
    remove: Which,
    gaps: [usize; 2],
    legs: Option<JsValue>,
) -> JsValue {
    let Calibration { estimate, undetermined, bootstrap, doubts, inflation, by_length, .. } = calibration;
    let undetermined: Array = undetermined.iter().map(|reason| undetermined_word(*reason)).collect();
    let by_length: Array = by_length.iter().map(|at| at_length_to_js(at, estimate.alphas.len())).collect();
    let [odometry_gaps, reference_gaps] = gaps.map(|gaps| JsValue::from(gaps as f64));
    let told = [
        ("alphas", alphas(&estimate.alphas)),
        ("undetermined", undetermined.into()),
        ("intervals", intervals(&estimate.intervals)),
        ("bootstrap", intervals(bootstrap)),
        ("systematic", systematic_to_js(calibration, remove)),
        ("logLikelihood", estimate.log_likelihood.into()),
        ("outliers", number_or_null(estimate.outliers)),
        ("doubts", doubts_to_js(doubts)),
        ("inflation", inflation_to_js(inflation)),
        ("byLength", by_length.into()),
        ("gaps", object(&[("odometry", odometry_gaps), ("reference", reference_gaps)])),
    ];
    object(&told.into_iter().chain(legs.map(|legs| ("legs", legs))).collect::<Vec<_>>())
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
            Undetermined::ReferenceTooCoarse => "reference-too-coarse",
            Undetermined::OneRatio => "one-ratio",
        };
        word.into()
    })
}

/// Without an estimate none of the α's is told.
fn at_length_to_js(at: &AtLength, count: usize) -> JsValue {
    let (none, unknown) = (vec![f64::NAN; count], vec![None; count]);
    let (told, their, stretched) = at
        .estimate
        .as_ref()
        .map_or((&none, &unknown, &unknown), |told| (&told.alphas, &told.intervals, &at.bootstrap));
    object(&[
        ("factor", at.factor.into()),
        ("legs", (at.legs as f64).into()),
        ("alphas", alphas(told)),
        ("intervals", intervals(their)),
        ("bootstrap", intervals(stretched)),
    ])
}

fn interval(interval: Option<[f64; 2]>) -> JsValue {
    interval.map_or(JsValue::NULL, |interval| list(&interval))
}

fn intervals(intervals: &[Option<[f64; 2]>]) -> JsValue {
    intervals.iter().map(|each| interval(*each)).collect::<Array>().into()
}

fn systematic_to_js(calibration: &Calibration, remove: Which) -> JsValue {
    let value = |error: Error| {
        let determined = calibration.deviations[error as usize].is_some();
        number_or_null(determined.then(|| calibration.systematic.get(error)))
    };
    let of = |error: Error| interval(calibration.interval_of(error));
    let entries = SYSTEMATIC.iter().map(|(key, errors)| {
        let [value, interval] = match errors {
            [error] => [value(*error), of(*error)],
            errors => [
                errors.iter().map(|error| value(*error)).collect::<Array>().into(),
                errors.iter().map(|error| of(*error)).collect::<Array>().into(),
            ],
        };
        let determined = errors.iter().any(|error| calibration.deviations[*error as usize].is_some());
        let removed = (determined && remove[errors[0] as usize]).into();
        (*key, object(&[("value", value), ("interval", interval), ("removed", removed)]))
    });
    object(&entries.collect::<Vec<_>>())
}

fn doubts_to_js(doubts: &Doubts) -> JsValue {
    let Doubts { kinds, held_out, worst, verdict } = doubts;
    let kinds: Array = kinds.iter().map(kind_to_js).collect();
    let worst: Vec<f64> = worst.iter().map(|place| *place as f64).collect();
    object(&[
        ("kinds", kinds.into()),
        (
            "heldOut",
            object(&[
                ("count", (held_out.count as f64).into()),
                ("coverage", held_out.coverage.into()),
                ("expected", 0.95.into()),
                ("interval", list(&held_out.coverage_interval)),
                ("logLikelihood", held_out.log_likelihood.into()),
            ]),
        ),
        (
            "squaredError",
            object(&[
                ("mean", held_out.squared_error.into()),
                ("interval", list(&held_out.squared_error_interval)),
            ]),
        ),
        ("worst", list(&worst)),
        ("verdict", verdict_word(*verdict).into()),
    ])
}

fn kind_to_js(kind: &KindDoubts) -> JsValue {
    object(&[
        ("name", kind.name.into()),
        ("count", (kind.count as f64).into()),
        ("kurtosis", kind.kurtosis.into()),
        ("kurtosisExpected", kind.kurtosis_expected.into()),
        ("autocorrelation", kind.autocorrelation.into()),
        ("autocorrelationLimit", kind.autocorrelation_limit.into()),
        ("quantiles", floats(&kind.quantiles)),
    ])
}

fn verdict_word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::FewLegs => "few-legs",
        Verdict::Unrelated => "unrelated",
        Verdict::LongLegs => "long-legs",
        Verdict::Overstated => "overstated",
        Verdict::Understated => "understated",
        Verdict::HeavyTails => "heavy-tails",
        Verdict::Correlated => "correlated",
        Verdict::Overconfident => "overconfident",
        Verdict::Lazy => "lazy",
        Verdict::Fits => "fits",
    }
}

fn inflation_to_js(inflation: &Inflation) -> JsValue {
    object(&[
        ("factors", floats(&inflation.factors)),
        ("coverage", floats(&inflation.coverage)),
        ("logLikelihood", floats(&inflation.log_likelihood)),
    ])
}

/// Makes arrays of the legs of a calibration, one leg after the other in each.
pub fn columns_to_js(calibration: &Calibration) -> JsValue {
    let Calibration { legs, observations, judged, removed, .. } = calibration;
    let [mut times, mut odometry, mut reference, mut readings, mut residuals] = [const { Vec::new() }; 5];
    let [mut deviations, mut squared_error, mut bad] = [const { Vec::new() }; 3];
    for ((leg, observation), judged) in legs.iter().zip(observations).zip(judged) {
        times.extend_from_slice(&leg.times);
        for [told, pose] in [0, 1].map(|end| [leg.odometry[end], removed.base(&leg.reference[end])]) {
            odometry.extend_from_slice(&[told.x(), told.y(), told.theta()]);
            reference.extend_from_slice(&[pose.x(), pose.y(), pose.theta()]);
        }
        readings.extend_from_slice(&observation.reading);
        residuals.extend_from_slice(&observation.residuals);
        deviations.extend_from_slice(&judged.deviations);
        squared_error.push(judged.squared_error);
        bad.push(judged.bad);
    }
    object(&[
        ("count", (legs.len() as f64).into()),
        ("times", floats(&times)),
        ("odometry", floats(&odometry)),
        ("reference", floats(&reference)),
        ("readings", floats(&readings)),
        ("residuals", floats(&residuals)),
        ("deviations", floats(&deviations)),
        ("squaredError", floats(&squared_error)),
        ("bad", floats(&bad)),
    ])
}
