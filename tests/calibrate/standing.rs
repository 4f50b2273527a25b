//! Robots that start, stop and turn off where a leg ends, and stand or hardly move all through some.

use crate::simulated::{ALPHAS, MODELS, Simulation, Unlike};
use motion::NoiseKind;
use motion::calibrate::{ERRORS, Error, LegLength, Robust, Systematic, Trajectory, Verdict, calibrate};
use motion::geom::se2::SE2;
use nalgebra::Vector3;

/// v (m/s) and ω (rad/s) of a leg of a second: standing, hardly turning, turning on the spot, straight on, bends.
fn started_and_stopped(leg: usize) -> [f64; 2] {
    let mixed = leg.wrapping_mul(0x9e37_79b9).wrapping_add(leg / 7) >> 8;
    let part = (mixed / 16 % 64) as f64 / 64.0;
    match mixed % 8 {
        0 => [0.0, 0.0],
        1 => [0.0, 1e-3 * (part - 0.5)],
        2 => [0.0, 1.6 * (part - 0.5)],
        3 | 4 => [0.2 + 0.4 * part, 0.0],
        _ => [0.2 + 0.4 * part, 1.4 * (part - 0.5)],
    }
}

/// A clock that is known to some milliseconds has a robot that stands move by as many millimetres, where its own noise is none: a single
/// such leg would decide on the α's and on the clock. Against the fits of which no error is removed, for there are none: the noise is the
/// same in both, and the ratio of the means is allowed three of its deviations, and three hundredths, for velocity commands have two left: of
/// logs made with other seeds α₃ was 1.022 ± 0.005. The shares of intervals and verdicts are allowed three deviations, below 95 % and the 94 %
/// of `doubts`.
#[test]
fn a_leg_that_shows_no_more_than_the_clocks_error_does_not_decide() {
    const LOGS: u64 = 30;
    let (mut held, mut of, mut fits, mut logs) = (0, 0, 0, 0);
    // The robot never backs up, without which three of the rules are one.
    let [table, _, _, omnidirectional, velocity] = MODELS.map(|model| (model, NoiseKind::Normal));
    for (model, noise) in [table, omnidirectional, velocity, (table.0, NoiseKind::Triangular)] {
        let pairs: Vec<[Vec<f64>; 2]> = (0..LOGS)
            .map(|seed| {
                let simulation = Simulation {
                    legs: LegLength::Lasted { duration: 1.0 },
                    drive: Some(started_and_stopped),
                    ..Simulation::of(model, noise, 600, 9_000 + seed)
                };
                let [odometry, reference] = simulation.log();
                let [with, without] = [true, false].map(|remove| {
                    let mut options = simulation.options(Robust::No);
                    options.remove = [remove; 6];
                    calibrate(&odometry, &reference, &options).expect("legs enough")
                });
                for (interval, alpha) in with.estimate.intervals.iter().zip(ALPHAS) {
                    of += 1;
                    held += u32::from(interval.is_some_and(|[from, to]| from <= alpha && alpha <= to));
                }
                logs += 1;
                fits += u32::from(with.doubts.verdict == Verdict::Fits);
                [with, without].map(|told| told.estimate.alphas)
            })
            .collect();
        for alpha in 0..model.alphas() {
            let mean = |k: usize| pairs.iter().map(|pair| pair[k][alpha]).sum::<f64>() / LOGS as f64;
            let (ratio, without) = (mean(0) / mean(1), mean(1));
            let square = pairs
                .iter()
                .map(|[with, without]| (with[alpha] - ratio * without[alpha]).powi(2))
                .sum::<f64>();
            let deviation = square.sqrt() / LOGS as f64 / without;
            assert!(
                (ratio - 1.0).abs() < 0.03 + 3.0 * deviation,
                "{model:?} {noise:?} α{}: {ratio} ± {deviation}",
                alpha + 1
            );
            assert!(deviation < 0.05, "{model:?} {noise:?} α{}: {deviation}", alpha + 1);
        }
    }
    let least = |share: f64, of: u32| share - 3.0 * (share * (1.0 - share) / f64::from(of)).sqrt();
    assert!(f64::from(held) / f64::from(of) > least(0.95, of), "{held} of {of}");
    assert!(f64::from(fits) / f64::from(logs) > least(0.94, logs), "{fits} of {logs}");
}

/// Of wheels that err by nothing most legs are exact whatever the clocks, and the others must not pass for bad: those in which the robot starts,
/// stops or turns off tell the offset. The reference has samples when the odometry has, and twice and once a second between these. An error is known as
/// well as by a reference that errs by a millimetre, and is the true one but for rounding and the last step.
#[test]
fn of_a_robot_without_noise_the_clock_is_found() {
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
            assert!(off.abs() < 0.05 * deviation, "{error:?} is off by {off} of {deviation}, every {every}");
            assert!((1e-6..3e-3).contains(&deviation), "{error:?}: {deviation}, every {every}");
        }
        assert!(told.estimate.alphas.iter().all(|alpha| *alpha < 1e-7), "{:?}", told.estimate);
    }
}

/// Of wheels that err by a millimetre and less in a leg, and an exact reference, bad legs are found as of any other: where none is, the α's are
/// those that are fitted without any, and of such as err by a millimetre the true ones. Both to four deviations, of which a 95 % interval is as
/// long.
#[test]
fn of_a_robot_with_hardly_any_noise_no_leg_passes_for_bad() {
    for (times, deviation) in [(1e-2, (|_| 0.1) as fn(f64) -> f64), (1e-4, |_| 0.01)] {
        for model in MODELS {
            let mut simulation = Simulation::of(model, NoiseKind::Normal, 2000, 3);
            simulation.unlike = Unlike::Changing(deviation);
            let [odometry, reference] = simulation.log();
            let [plain, robust] = [Robust::No, Robust::Estimated].map(|robust| {
                calibrate(&odometry, &reference, &simulation.options(robust)).expect("legs enough").estimate
            });
            for (k, with) in robust.alphas.iter().enumerate() {
                let alpha = plain.alphas[k];
                let [low, high] = plain.intervals[k].expect("it is determined");
                let near = |value: f64| (value - alpha).abs() <= high - low;
                let case = format!("{model:?}, {times} times, α{}: {alpha} and {with}", k + 1);
                assert!(near(*with), "{case}");
                assert!(times < 1e-2 || near(times * ALPHAS[k]), "{case}");
            }
            assert!(robust.alphas.iter().any(|alpha| *alpha > 0.0), "{model:?}, {times} times");
        }
    }
}
