//! A reference error that is stated too small or too large is reported; one stated correctly is not.

use super::simulated::{MODELS, Simulation, Unlike};
use motion::calibrate::Undetermined::ReferenceTooCoarse;
use motion::calibrate::{Model, Options, ReferenceError, Robust, Trajectory, Verdict, calibrate};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::{NoiseKind, Variance};
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

/// The reference errs by about as much as the wheels do on a leg.
const ERRS: ReferenceError = ReferenceError { position: 0.005, heading: 0.002 };

/// Each row independently off.
fn off_by(error: ReferenceError, trajectory: &Trajectory) -> Trajectory {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(0);
    let [place, heading] = [error.position, error.heading].map(|deviation| Variance(deviation * deviation));
    let mut off = |variance| NoiseKind::Normal.sample(variance, &mut rng);
    let rows = trajectory.samples().map(|(time, pose)| {
        let [x, y, theta] = [pose.x() + off(place), pose.y() + off(place), pose.theta() + off(heading)];
        (time, SE2::new(x, y, theta))
    });
    Trajectory::new(rows.collect::<Vec<_>>()).expect("times rise")
}

/// A correct statement may be doubted by chance, in one log of a hundred.
#[test]
fn a_wrongly_stated_reference_error_is_reported() {
    let mut doubted = 0;
    for model in MODELS {
        let made =
            Simulation { unlike: Unlike::Times(0.3), ..Simulation::of(model, NoiseKind::Normal, 1000, 500) };
        let [odometry, exact] = made.log();
        let reference = off_by(ERRS, &exact);
        let verdict = |times: f64| {
            let reference_error =
                ReferenceError { position: times * ERRS.position, heading: times * ERRS.heading };
            let options = Options { reference_error, ..made.options(Robust::No) };
            calibrate(&odometry, &reference, &options).expect("legs enough").doubts.verdict
        };
        assert_eq!(verdict(0.0), Verdict::Understated, "{model:?}");
        assert_eq!(verdict(10.0), Verdict::Overstated, "{model:?}");
        doubted += u32::from([Verdict::Understated, Verdict::Overstated].contains(&verdict(1.0)));
    }
    assert!(doubted < 2, "{doubted}");
}

#[test]
fn alphas_far_below_the_reference_error_are_undetermined() {
    let made = Simulation::of(Model::Odometry(OdometryRule::Nav2), NoiseKind::Normal, 400, 32);
    let [odometry, reference] = made.log();
    let reference_error = ReferenceError { position: 100.0, heading: 0.0 };
    let options = Options { reference_error, ..made.options(Robust::No) };
    let told = calibrate(&odometry, &reference, &options).expect("legs enough");
    assert_eq!(told.undetermined[2..], [Some(ReferenceTooCoarse); 2]);
    assert_eq!(told.doubts.verdict, Verdict::Overstated);
}
