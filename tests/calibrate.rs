//! α's from logs: against the models' own densities, and against the α's that simulated logs were made with.

use motion::calibrate::{Component, Estimate, Leg, LegLength, Trajectory, cut, fit, residuals};
use motion::geom::se2::SE2;
use motion::models::OdometryRule;
use motion::{MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, ReverseAware};
use rand::{Rng, RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

const ALPHAS: [f64; 5] = [0.03, 0.01, 0.02, 0.005, 0.015];

/// A leg as a robot drives it: ahead, a turn on the spot or, where the rule knows of it, back.
fn reading(rule: OdometryRule, rng: &mut impl Rng) -> OdomDelta {
    let turn = rng.random_range(-0.6..0.6);
    let way = rng.random_range(0.1..0.4);
    let bend = rng.random_range(-0.3..0.3);
    let motion = match rng.random_range(0..5) {
        0 => SE2::new(0.0, 0.0, turn),
        1 if rule != OdometryRule::Table => SE2::new(-way, 0.1 * bend, bend),
        _ => SE2::new(way, 0.5 * way * bend, bend),
    };
    OdomDelta::from_poses(&SE2::identity(), &motion)
}

/// Legs of which the rule is true.
fn legs(rule: OdometryRule, count: usize, seed: u64) -> Vec<Leg> {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
    (0..count)
        .map(|i| {
            let reading = reading(rule, &mut rng);
            let from = SE2::new(rng.random_range(-5.0..5.0), 1.0, rng.random_range(-3.0..3.0));
            let unit_noise = [0; 3].map(|_| NoiseKind::Normal.sample(motion::Variance(1.0), &mut rng));
            let noise = rule.variances(&reading, &ALPHAS);
            let to = noise.executed(&rule.legs(&reading), unit_noise).poses(&from)[3];
            let start = SE2::new(3.0, -2.0, 0.7);
            let at = i as f64;
            Leg { times: [at, at + 1.0], odometry: [start, reading.apply(&start)], reference: [from, to] }
        })
        .collect()
}

fn estimate(legs: &[Leg], rule: OdometryRule) -> Estimate {
    fit(&residuals(legs, rule), if rule == OdometryRule::Omni { 5 } else { 4 })
}

/// The logarithm of the model's own density of what the legs were.
fn log_density(model: &impl MotionModel<Control = OdomDelta>, legs: &[Leg]) -> f64 {
    legs.iter()
        .map(|leg| {
            let u = OdomDelta::from_poses(&leg.odometry[0], &leg.odometry[1]);
            libm::log(model.pose_density(&leg.reference[1], &u, &leg.reference[0]).expect("no α is 0"))
        })
        .sum()
}

/// Only driven legs: a turn on the spot has no density under the table, whose first rotation has no noise then.
fn driven(rule: OdometryRule, count: usize, seed: u64) -> Vec<Leg> {
    let all = legs(rule, 2 * count, seed);
    all.into_iter()
        .filter(|leg| OdomDelta::from_poses(&leg.odometry[0], &leg.odometry[1]).trans > 0.05)
        .take(count)
        .collect()
}

#[test]
fn no_other_alphas_are_likelier_by_the_models_own_density() {
    let noise = NoiseKind::Normal;
    for rule in [OdometryRule::Table, OdometryRule::Nav2] {
        let legs = driven(rule, 400, 3);
        let best = estimate(&legs, rule);
        let alphas: [f64; 4] = best.alphas.clone().try_into().expect("four");
        let density = |alphas: [f64; 4]| {
            let model = OdometryModel { alphas: OdomAlphas(alphas), noise };
            if rule == OdometryRule::Table {
                log_density(&model, &legs)
            } else {
                log_density(&ReverseAware(model), &legs)
            }
        };
        let top = density(alphas);
        for k in 0..4 {
            for factor in [0.9, 0.99, 1.01, 1.1] {
                let mut others = alphas;
                others[k] *= factor;
                assert!(density(others) < top, "{rule:?}: α{} times {factor}", k + 1);
            }
            // At an end of its interval, with the others as they are there or worse: at least as far below, to a thousandth.
            for end in best.intervals[k].expect("known") {
                let mut others = alphas;
                others[k] = end;
                assert!(end == 0.0 || 2.0 * (top - density(others)) > 3.83, "{rule:?}: α{} = {end}", k + 1);
            }
        }
    }
}

#[test]
fn intervals_are_those_of_the_likelihood() {
    // Of n residuals with one α each: α̂ is the mean of r²/f, and the profile falls by n(ln s + 1/s − 1) at s times that.
    let n = 50;
    let squares: Vec<f64> = (0..n).map(|i| 1.0 + f64::from(i % 7)).collect();
    let residuals = squares
        .iter()
        .map(|square| motion::calibrate::Residual { square: *square, coefficients: [2.0, 0.0] })
        .collect();
    let Estimate { alphas, intervals, .. } = fit(&[Component { alphas: [0, 1], residuals }], 2);
    let mean = squares.iter().sum::<f64>() / (2.0 * f64::from(n));
    assert!((alphas[0] / mean - 1.0).abs() < 1e-6, "{alphas:?}");
    for end in intervals[0].expect("known") {
        let ratio = end / mean;
        let fall = f64::from(n) * (libm::log(ratio) + 1.0 / ratio - 1.0);
        // An end is found to a thousandth of the root of the fall.
        assert!((fall / 3.841_458_82 - 1.0).abs() < 2.1e-3, "{fall}");
    }
    assert!(alphas[1].is_nan() && intervals[1].is_none());
}

#[test]
fn many_legs_tell_the_alphas_to_two_hundredths() {
    // The worst of them has a deviation of 3 % at 10,000 legs: of 0.7 % here, three times of which are allowed.
    for rule in OdometryRule::ALL {
        let count = if rule == OdometryRule::Omni { 5 } else { 4 };
        let Estimate { alphas, intervals, .. } = estimate(&legs(rule, 200_000, 5), rule);
        for k in 0..count {
            let [from, to] = intervals[k].expect("every α is determined");
            assert!(
                from < alphas[k] && alphas[k] < to && to / from < 1.1,
                "{rule:?}: α{}: {from} to {to}",
                k + 1
            );
            assert!((alphas[k] / ALPHAS[k] - 1.0).abs() < 0.02, "{rule:?}: α{} is {}", k + 1, alphas[k]);
        }
    }
}

#[test]
fn ninety_five_of_a_hundred_intervals_have_the_true_value() {
    const SEEDS: u64 = 400;
    for rule in OdometryRule::ALL {
        let count = if rule == OdometryRule::Omni { 5 } else { 4 };
        let mut covered = vec![0; count];
        for seed in 0..SEEDS {
            let Estimate { intervals, .. } = estimate(&legs(rule, 300, 1000 + seed), rule);
            for (k, interval) in intervals.iter().enumerate() {
                let [from, to] = interval.expect("every α is determined");
                covered[k] += u64::from((from..=to).contains(&ALPHAS[k]));
            }
        }
        for (k, covered) in covered.iter().enumerate() {
            let share = *covered as f64 / SEEDS as f64;
            assert!((share - 0.95).abs() <= 0.025, "{rule:?}: α{} {share}", k + 1);
        }
    }
}

#[test]
fn an_alpha_that_is_nothing_may_be_nothing() {
    // Straight legs whose drive alone is wrong, each by as much as the one before: the rotations are perfect.
    let legs: Vec<Leg> = (0..100)
        .map(|i| {
            let at = f64::from(i);
            let off = if i % 2 == 0 { 0.01 } else { -0.01 };
            let [x, true_x] = [0.25, 0.25 + off].map(|x| SE2::new(x, 0.0, 0.0));
            Leg {
                times: [at, at + 1.0],
                odometry: [SE2::identity(), x],
                reference: [SE2::identity(), true_x],
            }
        })
        .collect();
    let Estimate { alphas, intervals, .. } = estimate(&legs, OdometryRule::Table);
    assert!((alphas[2] / (0.01f64 / 0.25).powi(2) - 1.0).abs() < 1e-6, "{alphas:?}");
    // It never turned: two of the α's nobody can know.
    assert!(alphas[0].is_nan() && intervals[0].is_none() && alphas[3].is_nan() && intervals[3].is_none());
}

fn straight(count: usize, step: f64) -> Trajectory {
    let samples = (0..count).map(|i| (0.1 * i as f64, SE2::new(step * i as f64, 0.0, 0.0)));
    Trajectory::new(samples).expect("times rise")
}

#[test]
fn legs_end_as_amcl_ends_them() {
    let odometry = straight(41, 0.0625);
    let length = LegLength::Moved { distance: 0.25, angle: 0.2 };
    let legs = cut(&odometry, &odometry, length);
    // At exactly a quarter of a metre not yet: five steps each.
    assert_eq!(legs.len(), 8);
    for (i, leg) in legs.iter().enumerate() {
        assert_eq!(leg.odometry[1].x() - leg.odometry[0].x(), 0.3125);
        assert_eq!(leg.times[0], odometry.samples().nth(5 * i).expect("there").0);
    }
    // Each axis by itself: 0.24 m along both is no leg, though it is 0.34 m away.
    let diagonal = [(0.0, 0.0), (0.1, 0.24), (0.2, 0.26)].map(|(t, x)| (t, SE2::new(x, x, 0.0)));
    let diagonal = Trajectory::new(diagonal).expect("times rise");
    assert_eq!(cut(&diagonal, &diagonal, length)[0].times, [0.0, 0.2]);
    // Across the half turn the angle is small.
    let turning = [(0.0, 3.1), (0.1, -3.1), (0.2, -2.9)].map(|(t, theta)| (t, SE2::new(0.0, 0.0, theta)));
    let turning = Trajectory::new(turning).expect("times rise");
    assert_eq!(cut(&turning, &turning, length)[0].times, [0.0, 0.2]);
    let timed = cut(&odometry, &odometry, LegLength::Lasted { duration: 0.5 });
    assert_eq!(timed.len(), 8);
}

#[test]
fn no_leg_leads_across_a_gap() {
    let whole = straight(101, 0.1);
    let length = LegLength::Moved { distance: 0.25, angle: 0.2 };
    // A second is missing, ten steps.
    let missing = |t: f64| (4.0 < t) && (t < 5.0);
    let holed = Trajectory::new(whole.samples().filter(|(t, _)| !missing(*t))).expect("times rise");
    for (odometry, reference) in [(&holed, &whole), (&whole, &holed), (&holed, &holed)] {
        let legs = cut(odometry, reference, length);
        assert!(legs.len() > 25);
        assert!(legs.iter().all(|leg| leg.times[1] <= 4.0 + 1e-9 || leg.times[0] >= 5.0 - 1e-9));
    }
    // Nor beyond the ends of the reference.
    let shorter = Trajectory::new(whole.samples().skip(20).take(30)).expect("times rise");
    assert!(
        cut(&whole, &shorter, length)
            .iter()
            .all(|leg| leg.times[0] >= 2.0 - 1e-9 && leg.times[1] <= 4.9 + 1e-9)
    );
}

#[test]
fn between_two_samples_the_robot_drives_an_arc() {
    let twist = motion_twist();
    let ends = [(1.0, SE2::new(2.0, 1.0, 3.0)), (2.0, SE2::new(2.0, 1.0, 3.0).boxplus(twist))];
    let trajectory = Trajectory::new(ends).expect("times rise");
    let there = trajectory.pose_at(1.25).expect("inside");
    let expected = ends[0].1.boxplus(twist * 0.25);
    assert!(there.boxminus(&expected).norm() < 1e-12);
    assert_eq!([0.99, 2.01].map(|time| trajectory.pose_at(time)), [None; 2]);
}

fn motion_twist() -> nalgebra::Vector3<f64> {
    nalgebra::Vector3::new(0.5, 0.1, 0.8)
}

#[test]
fn times_rise_and_numbers_are_numbers() {
    let of = |samples: &[(f64, f64)]| {
        Trajectory::new(samples.iter().map(|(t, x)| (*t, SE2::new(*x, 0.0, 0.0))))
            .map_err(|error| error.to_string())
    };
    assert!(of(&[]).is_ok() && of(&[(1.0, 2.0)]).is_ok());
    assert_eq!(
        of(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0)]),
        Err("sample 2 is not later than the one before, at 1 s; allowed are times that rise".to_owned())
    );
    let not_finite = "sample 1 has a time or a coordinate that is not finite; allowed are finite numbers";
    assert_eq!(of(&[(0.0, 0.0), (f64::NAN, 0.0)]), Err(not_finite.to_owned()));
    assert_eq!(of(&[(0.0, 0.0), (1.0, f64::INFINITY)]), Err(not_finite.to_owned()));
}
