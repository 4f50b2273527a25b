//! Logs of robots without noise, and the scaling of alphas with the noise.

use super::simulated::{MODELS, Simulation, Unlike};
use motion::NoiseKind;
use motion::calibrate::{ERRORS, Error, Robust, Systematic, Trajectory, calibrate};
use motion::geom::se2::SE2;
use nalgebra::Vector3;

/// Of wheels that err by nothing most legs are exact whatever the clocks, and the others must not pass for bad: those in which the robot starts,
/// stops or turns off tell the offset. The reference has samples when the odometry has, and twice and once a second between these. All errors are
/// true but for rounding, and known to nearly that.
#[test]
fn the_clock_offset_of_a_robot_without_noise_is_exact() {
    const STEP: f64 = 0.01;
    const OFFSET: f64 = 0.123;
    let (mut pose, mut samples) = (SE2::identity(), Vec::new());
    for row in 0..20_000_u32 {
        samples.push((STEP * f64::from(row), pose));
        let phase = row / 170;
        let turn = [0.7, -0.5, 0.9][phase as usize / 3 % 3];
        let twist = [[0.0, turn], [0.4, 0.0], [0.4, 0.3]][phase as usize % 3];
        pose = pose.boxplus(Vector3::new(twist[0], 0.0, twist[1]) * STEP);
    }
    let odometry = Trajectory::new(samples.iter().copied().step_by(2)).expect("times rise");
    for (first, every) in [(0, 2), (0, 10), (7, 50), (7, 100)] {
        let later = samples.iter().skip(first).step_by(every).map(|(time, pose)| (time + OFFSET, *pose));
        let reference = Trajectory::new(later).expect("times rise");
        let mut options = Simulation::of(MODELS[0], NoiseKind::Normal, 400, 0).options(Robust::No);
        options.remove = [true; ERRORS];
        let told = calibrate(&odometry, &reference, &options).expect("legs enough");
        let exact = Systematic { clock_offset: OFFSET, ..Systematic::NONE };
        for error in Error::ALL {
            let deviation = told.deviations[error as usize].expect("it is determined");
            let off = told.systematic.get(error) - exact.get(error);
            assert!(off.abs() < 1e-12, "{error:?} is off by {off}, every {every}");
            assert!(deviation < 1e-6, "{error:?}: {deviation}, every {every}");
        }
        assert!(told.estimate.alphas.iter().all(|alpha| *alpha < 1e-7), "{:?}", told.estimate);
    }
}

/// A robot that errs by a hundredth of what another does, with the same noise otherwise, has α's of a ten-thousandth, with their intervals, and the
/// same verdict: also where the wheels err by so little (3.5 mm a leg, down to rounding) that it first turns out an exact reference. Of second
/// order in the noise is a thousandth from 3.5 mm on, and the rounds stop within a hundredth of the deviation of each of six errors: a fortieth of an
/// interval is allowed.
#[test]
fn alphas_and_their_intervals_scale_with_the_noise() {
    for model in [MODELS[0], MODELS[4]] {
        for robust in [Robust::No, Robust::Estimated] {
            let [usual, less @ ..] = [0.1, 0.015, 1e-5].map(|times| {
                let mut simulation = Simulation::of(model, NoiseKind::Normal, 1500, 103);
                simulation.unlike = Unlike::Times(times);
                let [odometry, reference] = simulation.log();
                let told =
                    calibrate(&odometry, &reference, &simulation.options(robust)).expect("legs enough");
                let scaled = |alpha: f64| alpha / (times * times);
                let intervals = told.estimate.intervals.into_iter();
                (
                    times,
                    told.estimate.alphas.into_iter().map(scaled).collect::<Vec<_>>(),
                    intervals.map(|pair| pair.expect("it is determined").map(scaled)).collect::<Vec<_>>(),
                    told.doubts.verdict,
                )
            });
            for (times, alphas, intervals, verdict) in less {
                assert_eq!(verdict, usual.3, "{model:?}, {robust:?}, {times}");
                for k in 0..model.alphas() {
                    let [from, to] = usual.2[k];
                    let case = format!("{model:?}, {robust:?}, {times} times, α{}", k + 1);
                    let pairs = [(alphas[k], usual.1[k]), (intervals[k][0], from), (intervals[k][1], to)];
                    for (told, expected) in pairs {
                        assert!(
                            (told - expected).abs() < 0.025 * (to - from),
                            "{case}: {told} for {expected}"
                        );
                    }
                }
            }
        }
    }
}
