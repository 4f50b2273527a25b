//! Trajectories of which one has far fewer samples than the other.

use super::simulated::Simulation;
use crate::laws::doubles::cases;
use motion::calibrate::{
    Calibration, Error, LegLength, Model, Options, Robust, Systematic, Trajectory, calibrate, cut,
};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::{NoiseKind, Variance};
use nalgebra::Vector3;
use proptest::prelude::*;
use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

const REAL: Systematic = Systematic {
    clock_offset: 0.0,
    mount_yaw: 0.07,
    lever_arm: [0.1, -0.05],
    distance_scale: 1.02,
    turn_scale: 0.99,
};

/// A robot that winds its way for 800 s, with errors that walk as it drives: odometry and reference, 20 samples a second.
fn winding(seed: u64) -> [Vec<(f64, SE2)>; 2] {
    const STEP: f64 = 0.05;
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut noise = |variance: f64| NoiseKind::Normal.sample(Variance(variance), &mut rng);
    let (mut read, mut truth) = (SE2::identity(), SE2::new(1.0, 2.0, 0.5));
    let mount = SE2::new(REAL.lever_arm[0], REAL.lever_arm[1], REAL.mount_yaw);
    let mut log = [Vec::new(), Vec::new()];
    for row in 0..16_000 {
        let time = STEP * f64::from(row);
        log[0].push((time, read));
        log[1].push((time, truth * mount));
        let way = STEP * (0.35 + 0.2 * libm::sin(0.31 * time));
        let turn = STEP * 0.6 * libm::sin(0.83 * time) * libm::sin(0.137 * time);
        read = read.boxplus(Vector3::new(way / REAL.distance_scale, 0.0, turn / REAL.turn_scale));
        let off = Vector3::new(noise(0.0017 * way), 0.0, noise(0.002 * way + 0.003 * turn.abs()));
        truth = truth.boxplus(Vector3::new(way, 0.0, turn) + off);
    }
    log
}

/// Of its samples each so many-th.
fn thinned(samples: &[(f64, SE2)], first: usize, every: usize) -> Trajectory {
    Trajectory::new(samples.iter().copied().skip(first).step_by(every)).expect("times rise")
}

fn calibrated(odometry: &Trajectory, reference: &Trajectory) -> Calibration {
    let nav2 = Simulation::of(Model::Odometry(OdometryRule::Nav2), NoiseKind::Normal, 0, 0);
    let options = Options { legs: LegLength::Lasted { duration: 1.0 }, ..nav2.options(Robust::No) };
    calibrate(odometry, reference, &options).expect("legs enough")
}

#[test]
#[ignore = "nightly: 60 calibrations"]
fn one_sample_a_leg_is_enough_for_either_trajectory() {
    // Of 20 logs of 780 legs the mean of an α is known to √(2/780/20) = 0.011, α₄, that has a third of the noise, to 0.04: means may be apart by
    // three deviations of a difference. Of 240 intervals a share of 0.95 has the deviation 0.014, and is allowed three.
    const LOGS: u64 = 20;
    const APART: [f64; 4] = [0.05, 0.05, 0.05, 0.17];
    let (mut sums, mut covered) = ([[0.0; 4]; 3], 0);
    for seed in 0..LOGS {
        let [odometry, reference] = winding(seed);
        let whole = calibrated(&thinned(&odometry, 0, 5), &thinned(&reference, 0, 1));
        // A reference of a sample a second, halfway between those at which a leg would end; and likewise of the odometry.
        let sparse = [
            calibrated(&thinned(&odometry, 0, 1), &thinned(&reference, 10, 20)),
            calibrated(&thinned(&odometry, 10, 20), &thinned(&reference, 0, 1)),
        ];
        for (sums, told) in sums.iter_mut().zip([&whole, &sparse[0], &sparse[1]]) {
            sums.iter_mut().zip(&told.estimate.alphas).for_each(|(sum, alpha)| *sum += alpha);
        }
        for (told, error) in sparse.iter().flat_map(|told| Error::ALL.map(|error| (told, error))) {
            let [from, to] = told.interval_of(error).expect("determined");
            covered += u32::from((from..=to).contains(&REAL.get(error)));
        }
    }
    for sparse in [sums[1], sums[2]] {
        for (k, apart) in APART.into_iter().enumerate() {
            let times = sparse[k] / sums[0][k];
            assert!((times - 1.0).abs() < apart, "α{} times {times}", k + 1);
        }
    }
    let share = f64::from(covered) / (12.0 * LOGS as f64);
    assert!(share > 0.95 - 3.0 * 0.014, "{share}");
}

#[test]
fn a_leg_ends_at_a_sample_of_the_sparser_trajectory() {
    let [odometry, reference] = winding(0);
    let length = LegLength::Lasted { duration: 1.0 };
    let has = |samples: &Trajectory, time: f64| samples.samples().any(|(at, _)| (at - time).abs() < 1e-9);
    // The clock of the reference is ahead by 5 s.
    let ahead = |samples: Vec<(f64, SE2)>| {
        samples.into_iter().map(|(time, pose)| (time + 5.0, pose)).collect::<Vec<_>>()
    };
    let reference = ahead(reference);
    for (every, step) in [(1, 1.0), (6, 0.9), (30, 1.5)] {
        let [read, seen] = [thinned(&odometry, 0, 1), thinned(&reference, 7, every)];
        let legs = cut(&read, &seen, length, 5.0);
        assert!(legs.len() > 500);
        for leg in &legs {
            // Next to a reading after a second, or, with a sample each second and a half, at each of these.
            assert!(leg.times.iter().all(|time| has(&seen, time + 5.0)), "{every}: {:?}", leg.times);
            assert!((leg.duration() - step).abs() < 0.301, "{every}: {}", leg.duration());
            for (end, truth) in leg.times.iter().zip(leg.reference) {
                assert_eq!(
                    seen.pose_at(end + 5.0).map(|pose| pose.boxminus(&truth).norm() < 1e-9),
                    Some(true)
                );
            }
            for (end, at) in leg.times.iter().zip(leg.odometry) {
                assert_eq!(read.pose_at(*end), Some(at));
            }
        }
        assert!(legs.windows(2).all(|pair| pair[0].times[1] == pair[1].times[0]));
    }
    // With as many of both it is at the reading, and so it is where the odometry has fewer.
    for (first, odd) in [(0, 1), (3, 20)] {
        let [read, seen] = [thinned(&odometry, first, odd), thinned(&reference, 0, 1)];
        let legs = cut(&read, &seen, length, 5.01);
        assert!(legs.len() > 500 && legs.iter().all(|leg| leg.times.iter().all(|time| has(&read, *time))));
    }
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn the_usual_step_is_the_upper_median(
        steps in prop::collection::vec(
            prop_oneof![1e-6_f64..1e6, Just(0.01), 0.01_f64..0.0101, (1_u64..9).prop_map(f64::from_bits)],
            0..200,
        ),
    ) {
        let mut times = vec![0.0];
        for step in steps {
            let next = times[times.len() - 1] + step;
            if next > times[times.len() - 1] {
                times.push(next);
            }
        }
        let mut sorted: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let expected = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
        let trajectory = Trajectory::new(times.into_iter().map(|time| (time, SE2::identity())));
        let told = trajectory.expect("times that rise").usual_step();
        prop_assert_eq!(told.to_bits(), expected.to_bits());
    }
}
