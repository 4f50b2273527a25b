//! A reference error that is stated too large is reported; one stated correctly is not.

use super::simulated::{MODELS, Simulation};
use crate::common::KINDS;
use motion::calibrate::Undetermined::ReferenceTooCoarse;
use motion::calibrate::{
    Calibration, Model, Options, ReferenceError, Robust, Trajectory, Verdict, calibrate,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::{NoiseKind, Variance};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

/// The reference's stated error, m and rad.
const STATED: ReferenceError = ReferenceError { position: 0.02, heading: 0.02 };

/// Each row independently off.
pub fn off_by(error: ReferenceError, trajectory: &Trajectory, seed: u64) -> Trajectory {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let [place, heading] = [error.position, error.heading].map(|deviation| Variance(deviation * deviation));
    let mut off = |variance| NoiseKind::Normal.sample(variance, &mut rng);
    let rows = trajectory.samples().map(|(time, pose)| {
        let [x, y, theta] = [pose.x() + off(place), pose.y() + off(place), pose.theta() + off(heading)];
        (time, SE2::new(x, y, theta))
    });
    Trajectory::new(rows.collect::<Vec<_>>()).expect("times rise")
}

fn judged(made: &Simulation, reference_error: ReferenceError, rows: [&Trajectory; 2]) -> Calibration {
    let options = Options { reference_error, ..made.options(Robust::No) };
    calibrate(rows[0], rows[1], &options).expect("legs enough")
}

#[test]
fn an_overstated_reference_error_is_reported() {
    // Larger than what the wheels err by, which would hide that it is not there.
    let stated = ReferenceError { position: 0.05, heading: 0.05 };
    let halved = ReferenceError { position: 0.5 * stated.position, heading: 0.5 * stated.heading };
    for (i, model) in MODELS.into_iter().enumerate() {
        let made = Simulation::of(model, KINDS[i % 2], 400, 31);
        let [odometry, exact] = made.log();
        for errs in [ReferenceError::default(), halved] {
            let told = judged(&made, stated, [&odometry, &off_by(errs, &exact, 1)]);
            assert_eq!(told.doubts.verdict, Verdict::Overstated, "{model:?} {errs:?}");
        }
        // An exact reference without a stated error is not overstated.
        let told = judged(&made, ReferenceError::default(), [&odometry, &exact]);
        assert_ne!(told.doubts.verdict, Verdict::Overstated, "{model:?}");
    }
}

/// Residuals of exact wheels are the reference's own. By chance, one log in two hundred is beyond three deviations.
#[test]
fn a_correct_reference_error_is_not_reported_as_overstated() {
    let mut told = 0;
    for model in MODELS {
        for seed in 0..2 {
            let made = Simulation::of(model, NoiseKind::Normal, 300, 40 + seed);
            let [exact, _] = made.log();
            for error in [STATED, ReferenceError { position: 0.0, ..STATED }] {
                let calibration = judged(&made, error, [&exact, &off_by(error, &exact, seed)]);
                told += usize::from(calibration.doubts.verdict == Verdict::Overstated);
            }
        }
    }
    assert!(told < 2, "{told}");
}

#[test]
fn alphas_far_below_the_reference_error_are_undetermined() {
    let made = Simulation::of(Model::Odometry(OdometryRule::Nav2), NoiseKind::Normal, 400, 32);
    let [odometry, reference] = made.log();
    let told = judged(&made, ReferenceError { position: 100.0, heading: 0.0 }, [&odometry, &reference]);
    assert_eq!(told.undetermined[2..], [Some(ReferenceTooCoarse); 2]);
    assert_eq!(told.doubts.verdict, Verdict::Overstated);
}
