//! What the Alpha Calibrator tells, in the order in which digest.js asks for it.

use super::configuration::Configuration;
use super::told::{Part, Told};
use motion::calibrate::{
    AtLength, Calibration, Doubts, Error, Estimate, HeldOut, Inflation, KindDoubts, Leg, ReferenceError,
    Trajectory,
};
use motion::geom::se2::SE2;
use motion::sim::alpha_calibrator::{AlphaCalibrator, Driver, LegView, Log, Panel, Settings, Truth};

pub fn parts(configuration: &Configuration) -> Vec<Part> {
    let mut machine =
        AlphaCalibrator::new(configuration.settings(Settings::default())).expect("a valid setting");
    let calibration = machine.calibration();
    let Calibration { estimate, bootstrap, doubts, inflation, by_length, .. } = calibration;
    let by_length: Vec<Values> = by_length.iter().map(|at| at_length(at, estimate.alphas.len())).collect();
    let Doubts { kinds, held_out, worst, .. } = doubts;
    let kinds: Vec<Values> = kinds.iter().map(kind).collect();
    let HeldOut { count, coverage, coverage_interval, squared_error, squared_error_interval, log_likelihood } =
        *held_out;
    // A list of four.
    let held_out = Values::of(&[&4usize, &count, &coverage, &coverage_interval, &log_likelihood]);
    let Inflation { factors, coverage: covered, log_likelihood: nats } = inflation;
    let panels = [Driver::Turn, Driver::Way].map(|driver| machine.panels(driver).map(|each| panel(&each)));
    let leg = machine.leg(5).map(|LegView { outcomes, outline, read, ended }| {
        Values::of(&[&outcomes.as_flattened().to_vec(), &outline.as_flattened().to_vec(), &read, &ended])
    });
    let nearest = machine.nearest([0.5, 1.0], 3.0).map_or(-1.0, |index| index as f64);
    let mut parts = vec![
        Part::new(
            "alphas",
            &[&estimate.alphas, &estimate.intervals, bootstrap, &estimate.log_likelihood, &estimate.outliers],
        ),
        Part::new("systematic", &[&systematic(calibration)]),
        Part::new("doubts", &[&kinds, &held_out, &squared_error, &squared_error_interval, worst]),
        Part::new("inflation", &[factors, covered, nats]),
        Part::new("byLength", &[&by_length]),
        Part::new("legs", &[&legs(calibration)]),
        Part::new("truth", &[&machine.truth().map(|known| truth(&known))]),
        Part::new("panels", &[&panels]),
        Part::new("leg", &[&leg]),
        Part::new("nearest", &[&nearest]),
    ];
    // Where legs begin is a log too.
    let log = (calibration.legs.len() > 1).then(|| begins(calibration));
    log.into_iter().for_each(|log| machine.set_log(log));
    let Estimate { alphas, intervals, .. } = &machine.calibration().estimate;
    parts.push(Part::new("log", &[&Values::of(&[&3usize, &machine.fits(), alphas, intervals])]));
    parts
}

fn begins(calibration: &Calibration) -> Log {
    let Calibration { legs, removed, .. } = calibration;
    let trajectory = |pose: &dyn Fn(&Leg) -> SE2| {
        Trajectory::new(legs.iter().map(|leg| (leg.times[0], pose(leg)))).expect("times that rise")
    };
    Log {
        odometry: trajectory(&|leg| leg.odometry[0]),
        reference: trajectory(&|leg| removed.base(&leg.reference[0])),
        error: ReferenceError::default(),
    }
}

/// What was told already: the values of an object, which has no length.
struct Values(Vec<u8>);

impl Values {
    fn of(values: &[&dyn Told]) -> Self {
        let mut bytes = Vec::new();
        values.iter().for_each(|value| value.tell(&mut bytes));
        Self(bytes)
    }
}

impl Told for Values {
    fn tell(&self, bytes: &mut Vec<u8>) {
        bytes.extend(&self.0);
    }
}

fn kind(kind: &KindDoubts) -> Values {
    let KindDoubts {
        count,
        kurtosis,
        kurtosis_expected,
        autocorrelation,
        autocorrelation_limit,
        quantiles,
        ..
    } = kind;
    Values::of(&[count, kurtosis, kurtosis_expected, autocorrelation, autocorrelation_limit, quantiles])
}

/// Of the five, the lever arm has two coordinates.
fn systematic(calibration: &Calibration) -> Vec<Values> {
    let value = |error: Error| {
        calibration.deviations[error as usize].is_some().then(|| calibration.systematic.get(error))
    };
    let one = |error: Error| Values::of(&[&value(error), &calibration.interval_of(error)]);
    let arm = [Error::LeverArmAhead, Error::LeverArmLeft];
    vec![
        one(Error::ClockOffset),
        one(Error::MountYaw),
        Values::of(&[&arm.map(value), &arm.map(|error| calibration.interval_of(error))]),
        one(Error::DistanceScale),
        one(Error::TurnScale),
    ]
}

fn legs(calibration: &Calibration) -> Values {
    let Calibration { legs, observations, judged, removed, .. } = calibration;
    let flat = |poses: [SE2; 2]| poses.into_iter().flat_map(|pose| [pose.x(), pose.y(), pose.theta()]);
    let times: Vec<f64> = legs.iter().flat_map(|leg| leg.times).collect();
    let odometry: Vec<f64> = legs.iter().flat_map(|leg| flat(leg.odometry)).collect();
    let reference: Vec<f64> =
        legs.iter().flat_map(|leg| flat(leg.reference.map(|end| removed.base(&end)))).collect();
    let readings: Vec<f64> = observations.iter().flat_map(|each| each.reading).collect();
    let residuals: Vec<f64> = observations.iter().flat_map(|each| each.residuals).collect();
    let deviations: Vec<f64> = judged.iter().flat_map(|leg| leg.deviations).collect();
    let squared_error: Vec<f64> = judged.iter().map(|leg| leg.squared_error).collect();
    let bad: Vec<f64> = judged.iter().map(|leg| leg.bad).collect();
    let count = legs.len();
    Values::of(&[
        &count,
        &times,
        &odometry,
        &reference,
        &readings,
        &residuals,
        &deviations,
        &squared_error,
        &bad,
    ])
}

/// A list of five.
fn at_length(AtLength { factor, legs, estimate, bootstrap }: &AtLength, count: usize) -> Values {
    let alphas = estimate.as_ref().map_or_else(|| vec![f64::NAN; count], |told| told.alphas.clone());
    let intervals = estimate.as_ref().map_or_else(|| vec![None; count], |told| told.intervals.clone());
    let stretched = if bootstrap.is_empty() { vec![None; count] } else { bootstrap.clone() };
    Values::of(&[&5usize, factor, legs, &alphas, &intervals, &stretched])
}

fn truth(truth: &Truth) -> Values {
    let Truth { alphas, clock_offset, mount_yaw, lever_arm, distance_scale, turn_scale } = truth;
    Values::of(&[alphas, clock_offset, mount_yaw, lever_arm, distance_scale, turn_scale])
}

fn panel(panel: &Panel) -> Values {
    let Panel { alpha, x, y, error, slope, interval } = panel;
    Values::of(&[alpha, x, y, error, slope, interval])
}
