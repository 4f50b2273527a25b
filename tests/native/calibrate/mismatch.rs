//! Logs whose reference does not belong to the odometry, and errors that a log does not determine.

use super::simulated::Simulation;
use motion::NoiseKind;
use motion::calibrate::{Calibration, Error, Model, Robust, Systematic, Trajectory, Verdict, calibrate};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;

const NAV2: Model = Model::Odometry(OdometryRule::Nav2);

fn simulation(seed: u64) -> Simulation {
    Simulation::of(NAV2, NoiseKind::Normal, 600, seed)
}

fn told(odometry: &Trajectory, reference: &Trajectory) -> Calibration {
    calibrate(odometry, reference, &simulation(0).options(Robust::No)).expect("legs enough")
}

/// The poses made others, each with the number of its sample.
fn edited(
    trajectory: &Trajectory,
    edit: impl FnMut((usize, (f64, SE2))) -> Option<(f64, SE2)>,
) -> Trajectory {
    Trajectory::new(trajectory.samples().enumerate().filter_map(edit).collect::<Vec<_>>())
        .expect("times rise")
}

#[test]
fn a_reference_of_another_drive_or_in_other_units_is_reported() {
    let [odometry, reference] = simulation(1).log();
    let [_, of_another] = simulation(2).log();
    let in_millimetres = |log: &Trajectory| {
        edited(log, |(_, (t, pose))| Some((t, SE2::new(1000.0 * pose.x(), 1000.0 * pose.y(), pose.theta()))))
    };
    let in_degrees = |log: &Trajectory| {
        edited(log, |(_, (t, pose))| Some((t, SE2::new(pose.x(), pose.y(), pose.theta().to_degrees()))))
    };
    let mirrored =
        edited(&reference, |(_, (t, pose))| Some((t, SE2::new(-pose.x(), pose.y(), pose.theta()))));
    for (name, odometry, reference) in [
        ("another", &odometry, &of_another),
        ("degrees", &odometry, &in_degrees(&reference)),
        ("mirrored", &odometry, &mirrored),
        ("odometry in millimetres", &in_millimetres(&odometry), &reference),
    ] {
        let verdict = told(odometry, reference).doubts.verdict;
        assert_eq!(verdict, Verdict::Unrelated, "{name}");
    }
    assert_eq!(told(&odometry, &reference).doubts.verdict, Verdict::Fits);
}

#[test]
fn legs_longer_than_requested_are_reported() {
    let [odometry, reference] = simulation(3).log();
    // A pose every two seconds.
    let sparse = edited(&reference, |(sample, row)| (sample % 40 == 0).then_some(row));
    assert_eq!(told(&odometry, &sparse).doubts.verdict, Verdict::LongLegs);
}

#[test]
fn an_undetermined_error_is_not_removed() {
    let straight = Simulation { straight: 1.0, ..simulation(4) };
    let [odometry, reference] = straight.log();
    let calibration = told(&odometry, &reference);
    let left: Vec<Error> =
        Error::ALL.into_iter().filter(|error| calibration.deviations[*error as usize].is_none()).collect();
    assert!(left.contains(&Error::TurnScale), "{left:?}");
    for error in left.into_iter().filter(|error| *error != Error::ClockOffset) {
        assert_eq!(calibration.removed.get(error), Systematic::NONE.get(error), "{error:?}");
    }
}
