//! A reference error that is stated too small is reported by the correlation of neighbouring legs.

use super::overstated::off_by;
use super::simulated::{MODELS, Simulation, Unlike};
use motion::NoiseKind;
use motion::calibrate::{Calibration, Model, Options, ReferenceError, Robust, Verdict, calibrate};
use motion::models::OdometryRule;

/// What the reference errs by: about as much as the wheels do on a leg.
const ERRS: ReferenceError = ReferenceError { position: 0.005, heading: 0.002 };

fn simulation(model: Model, seed: u64) -> Simulation {
    Simulation { unlike: Unlike::Times(0.3), ..Simulation::of(model, NoiseKind::Normal, 1000, 500 + seed) }
}

/// A log of a thousand legs of each of five models, by a reference of which this share of what it errs by is stated.
fn each(stated: f64, robust: Robust, mut see: impl FnMut(&Calibration)) {
    let reference_error = ReferenceError { position: stated * ERRS.position, heading: stated * ERRS.heading };
    for model in MODELS {
        let made = simulation(model, 0);
        let [odometry, exact] = made.log();
        let options = Options { reference_error, ..made.options(robust) };
        see(&calibrate(&odometry, &off_by(ERRS, &exact, 0), &options).expect("legs enough"));
    }
}

fn told(stated: f64, robust: Robust) -> usize {
    let mut told = 0;
    each(stated, robust, |calibration| {
        told += usize::from(calibration.doubts.verdict == Verdict::Understated);
    });
    told
}

#[test]
fn an_unstated_reference_error_is_reported() {
    assert_eq!(told(0.0, Robust::No), MODELS.len());
    assert_eq!(told(0.0, Robust::Estimated), MODELS.len());
}

/// A heading is in the second rotation of a leg and in the first of the next, with opposite signs.
#[test]
fn an_unstated_heading_error_is_reported() {
    let errs = ReferenceError { position: 0.0, heading: 0.005 };
    for rule in [OdometryRule::Table, OdometryRule::Nav2] {
        for seed in 0..2 {
            let made = simulation(Model::Odometry(rule), seed);
            let [odometry, exact] = made.log();
            let told = calibrate(&odometry, &off_by(errs, &exact, seed), &made.options(Robust::No));
            assert_eq!(told.expect("legs enough").doubts.verdict, Verdict::Understated, "{rule:?} {seed}");
        }
    }
}

/// The verdict is given for 96 of a hundred such logs.
#[test]
fn a_reference_error_stated_by_half_is_usually_reported() {
    assert!(told(0.5, Robust::No) > 3);
}

/// By chance, one log in two hundred is beyond three deviations.
#[test]
fn a_correct_reference_error_is_not_reported() {
    assert!(told(1.0, Robust::No) < 2);
}
