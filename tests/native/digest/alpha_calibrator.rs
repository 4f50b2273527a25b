//! Digested values of the Alpha Calibrator, in the order of digest.js.

use super::configuration::Configuration;
use super::told::{Part, Told};
use motion::calibrate::{
    Calibration, Check, Estimate, Persistence, Recommended, SystematicError, WindowCoverage,
};
use motion::sim::alpha_calibrator::{AlphaCalibrator, Settings, Truth};

pub fn parts(configuration: &Configuration) -> Vec<Part> {
    let machine = AlphaCalibrator::new(configuration.settings(Settings::default())).expect("a valid setting");
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
    vec![
        Part::new("alphas", &[alphas, intervals, log_likelihood]),
        Part::new("systematic", &[&systematic(calibration)]),
        Part::new("noise", &[&reference_noise.map(|std| estimate(&std)), &estimate(correlation), length]),
        Part::new("diagnostics", &[&checks, &windows, &recommended]),
        Part::new("truth", &[&machine.truth().map(|known| truth(&known))]),
    ]
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

fn truth(truth: &Truth) -> Values {
    let Truth { alphas, clock_offset, mount_yaw, lever_arm, distance_scale, turn_scale } = truth;
    Values::of(&[alphas, clock_offset, mount_yaw, lever_arm, distance_scale, turn_scale])
}
