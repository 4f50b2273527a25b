//! Digested values of the Alpha Calibrator, in the order of digest.js.

use super::configuration::Configuration;
use super::told::{Part, Told};
use motion::calibrate::{
    Calibration, Check, Estimate, Leg, Persistence, Recommended, SystematicError, Trajectory, WindowCoverage,
};
use motion::geom::se2::SE2;
use motion::sim::alpha_calibrator::{AlphaCalibrator, Driver, LegView, Log, Panel, Settings, Truth};

pub fn parts(configuration: &Configuration) -> Vec<Part> {
    let mut machine =
        AlphaCalibrator::new(configuration.settings(Settings::default())).expect("a valid setting");
    let calibration = machine.calibration();
    let Calibration { alphas, intervals, log_likelihood, reference_noise, persistence, diagnostics, .. } =
        calibration;
    let Persistence { correlation, length } = persistence;
    let checks: Vec<Values> = diagnostics.checks.iter().map(check).collect();
    let windows: Vec<Values> = diagnostics.windows.iter().map(window).collect();
    let recommended = calibration
        .recommended
        .as_ref()
        .map(|Recommended { alphas, inflation, .. }| Values::of(&[alphas, inflation]));
    let panels = [Driver::Turn, Driver::Way].map(|driver| machine.panels(driver).map(|each| panel(&each)));
    let leg = machine.leg(5).map(|LegView { outcomes, outline, read, ended }| {
        Values::of(&[&outcomes.as_flattened().to_vec(), &outline.as_flattened().to_vec(), &read, &ended])
    });
    let nearest = machine.nearest([0.5, 1.0], 3.0).map_or(-1.0, |index| index as f64);
    let mut parts = vec![
        Part::new("alphas", &[alphas, intervals, log_likelihood]),
        Part::new("systematic", &[&systematic(calibration)]),
        Part::new("noise", &[&reference_noise.map(|std| estimate(&std)), &estimate(correlation), length]),
        Part::new("diagnostics", &[&checks, &windows, &recommended]),
        Part::new("legs", &[&legs(calibration)]),
        Part::new("truth", &[&machine.truth().map(|known| truth(&known))]),
        Part::new("panels", &[&panels]),
        Part::new("leg", &[&leg]),
        Part::new("nearest", &[&nearest]),
    ];
    // The poses at which legs begin are used as a log of their own.
    let log = (calibration.legs.len() > 1).then(|| begins(calibration));
    log.into_iter().for_each(|log| machine.set_log(vec![log]));
    let Calibration { alphas, intervals, .. } = machine.calibration();
    parts.push(Part::new("log", &[&Values::of(&[&3usize, &machine.fits(), alphas, intervals])]));
    parts
}

fn begins(calibration: &Calibration) -> Log {
    let Calibration { legs, corrected, .. } = calibration;
    let trajectory = |pose: &dyn Fn(&Leg) -> SE2| {
        Trajectory::new(legs.iter().map(|leg| (leg.times[0], pose(leg)))).expect("times that rise")
    };
    Log {
        odometry: trajectory(&|leg| leg.odometry[0]),
        reference: trajectory(&|leg| corrected.base(&leg.reference[0])),
    }
}

/// Bytes of several values that are digested without their number, as the fields of an object are.
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

fn estimate(Estimate { value, interval }: &Estimate) -> Values {
    Values::of(&[value, interval])
}

fn check(Check { value, expected, passed, .. }: &Check) -> Values {
    Values::of(&[value, expected, passed])
}

fn window(WindowCoverage { length, count, coverage, nees }: &WindowCoverage) -> Values {
    Values::of(&[length, count, coverage, nees])
}

/// The lever arm, one of the five errors, has two coordinates.
fn systematic(calibration: &Calibration) -> Vec<Values> {
    let value = |error: SystematicError| {
        calibration.systematic_stds[error as usize].is_some().then(|| calibration.systematic.get(error))
    };
    let one = |error: SystematicError| {
        let [constant, corrected] =
            [calibration.is_constant, calibration.is_corrected].map(|mask| mask[error as usize]);
        Values::of(&[&value(error), &calibration.interval_of(error), &constant, &corrected])
    };
    let arm = [SystematicError::LeverArmAhead, SystematicError::LeverArmLeft];
    let either = |mask: [bool; 6]| arm.iter().any(|error| mask[*error as usize]);
    vec![
        one(SystematicError::ClockOffset),
        one(SystematicError::MountYaw),
        Values::of(&[
            &arm.map(value),
            &arm.map(|error| calibration.interval_of(error)),
            &either(calibration.is_constant),
            &either(calibration.is_corrected),
        ]),
        one(SystematicError::DistanceScale),
        one(SystematicError::TurnScale),
    ]
}

fn legs(calibration: &Calibration) -> Values {
    let Calibration { legs, observations, leg_fits, corrected, .. } = calibration;
    let flat = |poses: [SE2; 2]| poses.into_iter().flat_map(|pose| [pose.x(), pose.y(), pose.theta()]);
    let times: Vec<f64> = legs.iter().flat_map(|leg| leg.times).collect();
    let odometry: Vec<f64> = legs.iter().flat_map(|leg| flat(leg.odometry)).collect();
    let reference: Vec<f64> =
        legs.iter().flat_map(|leg| flat(leg.reference.map(|end| corrected.base(&end)))).collect();
    let readings: Vec<f64> = observations.iter().flat_map(|each| each.reading).collect();
    let residuals: Vec<f64> = observations.iter().flat_map(|each| each.residuals).collect();
    let observed = |numbers: &dyn Fn(usize) -> [f64; 3]| -> Vec<f64> {
        let of = |leg: usize| {
            let (numbers, residuals) = (numbers(leg), observations[leg].residuals);
            (0..3).map(move |k| if residuals[k].is_nan() { f64::NAN } else { numbers[k] })
        };
        (0..legs.len()).flat_map(of).collect()
    };
    let squared: Vec<f64> = leg_fits.iter().map(|fit| fit.squared).collect();
    let outliers: Vec<bool> = leg_fits.iter().map(|fit| fit.is_outlier).collect();
    Values::of(&[
        &legs.len(),
        &times,
        &odometry,
        &reference,
        &readings,
        &residuals,
        &observed(&|leg| leg_fits[leg].standardized),
        &observed(&|leg| leg_fits[leg].stds),
        &squared,
        &outliers,
    ])
}

fn truth(truth: &Truth) -> Values {
    let Truth { alphas, clock_offset, mount_yaw, lever_arm, distance_scale, turn_scale } = truth;
    Values::of(&[alphas, clock_offset, mount_yaw, lever_arm, distance_scale, turn_scale])
}

fn panel(panel: &Panel) -> Values {
    let Panel { alpha, x, y, error, slope, interval } = panel;
    Values::of(&[alpha, x, y, error, slope, interval])
}
