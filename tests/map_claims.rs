//! What the page, the widget and doc/model.md say of motion in the apartment, computed: every "more", "less" and "first",
//! and every share to the digits it is told in.
#![allow(
    clippy::disallowed_methods,
    reason = "an expected value may come from the platform's own mathematics"
)]

mod common;

use common::{SIGMAS, mean, seeded};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::map::{FloorPlan, MapConditioned, Sampler};
use motion::noise::centred_uniform;
use motion::sim::squeeze::{MapSqueeze, PRESETS, Settings, alphas_of_noise};
use motion::{NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};

/// Which of the presets.
const DOORWAY: usize = 0;
const WALL: usize = 1;
const CORRIDOR: usize = 2;

/// The opening, elsewhere, with another sampler and another turn rate.
fn settings(place: usize, sampler: Sampler, omega: f64) -> Settings {
    let command = VelocityCmd { omega, ..Settings::default().command };
    let steps = sampler.parts();
    let samples = 100_000.min(800_000 / steps as usize);
    Settings { start: PRESETS[place].1, sampler, steps, command, samples, seed: 3, ..Settings::default() }
}

fn machine(settings: Settings) -> MapSqueeze {
    MapSqueeze::new(settings).expect("valid settings")
}

/// The share through a wall, and its standard error.
fn through(settings: Settings) -> (f64, f64) {
    let machine = machine(settings);
    assert!(!machine.gave_up(), "{settings:?}");
    let (share, count) = (machine.tally().through_wall_rate(), machine.tally().accepted as f64);
    // Of a share of 0, that of one in all.
    (share, ((share * (1.0 - share)).max(1.0 / count) / count).sqrt())
}

fn in_parts(place: usize, parts: u32, omega: f64) -> (f64, f64) {
    through(settings(place, Sampler::SubStepped(parts), omega))
}

/// A share that is told in per cent, to within `rounding` of them.
fn assert_told((share, error): (f64, f64), told: f64, rounding: f64, what: &str) {
    let off = (100.0 * share - told).abs();
    assert!(off < 100.0 * SIGMAS * error + rounding, "{what}: {share} ± {error} instead of {told} %");
}

/// Beyond the errors of both.
fn assert_less(one: (f64, f64), other: (f64, f64), what: &str) {
    assert!(other.0 - one.0 > SIGMAS * one.1.hypot(other.1), "{what}: {one:?} is not less than {other:?}");
}

/// "Most of what is accepted lies behind it", and "only what stopped short of the wall is left".
#[test]
fn facing_the_wall_most_of_what_is_accepted_lies_behind_it() {
    let behind = |sampler| {
        let machine = machine(settings(WALL, sampler, 0.0));
        let accepted: Vec<f64> =
            machine.attempts().iter().filter(|a| a.accepted).map(|a| a.pose.y()).collect();
        // The wall ahead stands at y = 3.8; those who turn aside end before it too.
        accepted.iter().filter(|y| **y > 3.8).count() as f64 / accepted.len() as f64
    };
    assert!(behind(Sampler::Endpoint) > 0.8);
    assert_eq!(behind(Sampler::WholeArc), 0.0);
}

/// "One of the two climbs and stalls just below; the other gets there before half a radian a second, and falls again."
#[test]
fn forty_per_cent_is_reached_by_turning_and_not_by_noise() {
    let at = |n: f64, omega: f64| {
        through(Settings { alphas: alphas_of_noise(n), ..settings(DOORWAY, Sampler::Endpoint, omega) })
    };
    let by_noise = [0.04, 0.08, 0.12, 0.2].map(|n| at(n, 0.0));
    by_noise.windows(2).for_each(|pair| assert_less(pair[0], pair[1], "more noise, more through the wall"));
    // To the end of the slider.
    for n in [0.24, 0.28, 0.32, 0.36, 0.4] {
        let many = Settings { samples: 1_000_000, ..settings(DOORWAY, Sampler::Endpoint, 0.0) };
        let (share, error) = through(Settings { alphas: alphas_of_noise(n), ..many });
        assert!(share > 0.385 && share + SIGMAS * error < 0.4, "n = {n}: {share} ± {error}");
    }
    let (share, error) = at(0.12, 0.4);
    assert!(share - SIGMAS * error > 0.4, "{share} ± {error}");
    let by_turning = [0.0, 0.2, 0.4].map(|omega| at(0.12, omega));
    by_turning.windows(2).for_each(|pair| assert_less(pair[0], pair[1], "up to there it climbs"));
    let beyond = [0.5, 0.7, 1.0, 1.5].map(|omega| at(0.12, omega));
    beyond.windows(2).for_each(|pair| assert_less(pair[1], pair[0], "and falls again"));
}

/// "Straight ahead fewer and fewer pass as k grows, until nothing does; with ω = 0.5 more and more do at first, from 41 to
/// 50 % at k = 6, and then fewer."
#[test]
fn more_parts_let_fewer_pass_at_the_doorway_but_not_on_a_bend() {
    for (place, at_sixteen) in [(DOORWAY, 0.4), (CORRIDOR, 0.04)] {
        let endpoint = through(settings(place, Sampler::Endpoint, 0.0));
        let shares: Vec<(f64, f64)> =
            [2, 4, 8, 16].map(|parts| in_parts(place, parts, 0.0)).into_iter().collect();
        assert_less(shares[0], endpoint, "two parts");
        shares.windows(2).for_each(|pair| assert_less(pair[1], pair[0], "more parts"));
        assert_told(shares[3], at_sixteen, 0.05, "at k = 16");
        assert!(in_parts(place, 64, 0.0).0 < 1e-3, "next to nothing at the end of the slider");
    }
    // The numbers of samples that the page asks for, or opens with.
    for samples in [600, 10_000] {
        let opening =
            Settings { sampler: Sampler::SubStepped(64), steps: 64, samples, ..Settings::default() };
        assert_eq!(machine(opening).tally().through_wall, 0);
    }

    let bend = |place, parts| in_parts(place, parts, 0.5);
    for (place, endpoint, told) in [
        (DOORWAY, 41.0, [(4, 46.0), (6, 50.0), (8, 48.0), (16, 19.0)]),
        (CORRIDOR, 53.0, [(4, 60.0), (6, 63.0), (8, 65.0), (12, 55.0)]),
    ] {
        let first = through(settings(place, Sampler::Endpoint, 0.5));
        assert_told(first, endpoint, 0.5, "the endpoint on a bend");
        for (parts, share) in told {
            assert_told(bend(place, parts), share, 0.5, &format!("{place}: {parts} parts on a bend"));
        }
        assert_less(first, bend(place, 4), "four parts on a bend let more pass");
        assert_less(bend(place, 4), bend(place, 6), "and six still more");
    }
    assert_less(bend(DOORWAY, 8), bend(DOORWAY, 6), "at the doorway six are the worst");
    assert_less(
        bend(DOORWAY, 16),
        through(settings(DOORWAY, Sampler::Endpoint, 0.5)),
        "and sixteen better than one",
    );
    assert_less(bend(CORRIDOR, 6), bend(CORRIDOR, 8), "in the corridor it is eight");
    assert_less(bend(CORRIDOR, 12), bend(CORRIDOR, 8), "and then fewer pass");
}

/// "The share through the wall rises, from 93 to more than 99 %", and "from k = 16 on […] the robot stands wedged".
#[test]
fn facing_the_wall_more_parts_make_it_worse() {
    let shares = [2, 4, 8].map(|parts| in_parts(WALL, parts, 0.0));
    shares.windows(2).for_each(|pair| assert_less(pair[0], pair[1], "more parts"));
    assert_told(through(settings(WALL, Sampler::Endpoint, 0.0)), 86.7, 0.5, "one part");
    for (share, told, rounding) in [(shares[0], 93.0, 0.5), (shares[1], 98.0, 0.5), (shares[2], 99.8, 0.05)] {
        assert_told(share, told, rounding, "facing the wall");
    }
    assert!(!machine(settings(WALL, Sampler::SubStepped(12), 0.0)).gave_up());
    for parts in [16, 24, 32, 64] {
        for samples in [600, 10_000] {
            let many = Settings { samples, ..settings(WALL, Sampler::SubStepped(parts), 0.0) };
            assert!(machine(many).gave_up(), "{parts} parts");
        }
    }
}

/// "The noise of one part is independent of the others' and averages out, so that the spread shrinks as 1/√k."
#[test]
fn the_spread_shrinks_with_the_root_of_the_parts() {
    let plan = FloorPlan::new(Vec::new(), [-50.0, -50.0, 50.0, 50.0]).expect("an open field");
    for parts in [1u32, 4, 16, 64] {
        let along = Settings {
            start: [0.0; 3],
            alphas: [0.12, 0.0, 0.0, 0.0, 0.0, 0.0],
            samples: 12_500,
            ..settings(DOORWAY, Sampler::SubStepped(parts), 0.0)
        };
        let mut machine = machine(along);
        machine.set_plan(plan.clone());
        let x: Vec<f64> = machine.attempts().iter().map(|attempt| attempt.pose.x()).collect();
        let middle = mean(&x);
        let variance = mean(&x.iter().map(|x| (x - middle) * (x - middle)).collect::<Vec<_>>());
        // α₁v²Δt²/k; of a Gaussian's variance, the relative error is √(2/n).
        let expected = 0.12 * 4.0 / f64::from(parts);
        let error = (2.0 / 12_500.0_f64).sqrt();
        assert!((variance / expected - 1.0).abs() < SIGMAS * error, "{parts}: {variance} of {expected}");
    }
}

/// "A wider one fits in fewer places and meets more walls", draw by draw.
#[test]
fn a_wider_robot_meets_more() {
    for place in [DOORWAY, WALL, CORRIDOR] {
        let clouds = [0.05, 0.13, 0.2, 0.4].map(|clearance| {
            machine(Settings { clearance, samples: 20_000, ..settings(place, Sampler::Endpoint, 0.3) })
        });
        for pair in clouds.windows(2) {
            let both = pair[0].attempts().iter().zip(pair[1].attempts());
            assert!(both.clone().all(|(thin, wide)| thin.end_free || !wide.end_free));
            assert!(both.clone().all(|(thin, wide)| thin.path_free || !wide.path_free));
            assert!(pair[1].tally().accepted < pair[0].tally().accepted);
        }
    }
}

/// "Between 0.1 and 9 % of the accepted samples get the other verdict (200 000 samples a preset, n from 0.12 to 0.2, ω from 0
/// to 1; the doorway 6 to 9 %)", judged by the geodesic instead of the arc.
#[test]
fn judged_by_the_geodesic_some_get_the_other_verdict() {
    let plan = FloorPlan::apartment();
    for (place, [x, y, theta]) in PRESETS {
        let start = SE2::new(x, y, theta);
        for (n, omega) in [(0.12, 0.0), (0.12, 0.5), (0.12, 1.0), (0.2, 0.0), (0.2, 0.5), (0.2, 1.0)] {
            let model =
                VelocityModel { alphas: VelocityAlphas(alphas_of_noise(n)), noise: NoiseKind::Normal };
            let conditioned =
                MapConditioned { model, plan: &plan, clearance: 0.13, sampler: Sampler::Endpoint };
            let command = VelocityCmd { v: 1.0, omega, dt: 2.0 };
            let judging = conditioned.judging(&command, &start);
            let mut rng = seeded(93);
            let (mut accepted, mut differ) = (0u32, 0u32);
            for _ in 0..40_000 {
                let noise = std::array::from_fn(|_| NoiseKind::Normal.quantile(centred_uniform(&mut rng)));
                let draw = judging.judge(noise);
                if !draw.end.free {
                    continue;
                }
                // exp(s·ξ), 0 ≤ s ≤ 1, is an arc too: it leaves in the direction of (ξ along, ξ lateral).
                let xi = draw.pose.boxminus(&start);
                let leaving = SE2::new(x, y, theta + xi.y.atan2(xi.x));
                let geodesic = Arc { start: leaving, length: xi.xy().norm(), turn: xi.z };
                accepted += 1;
                differ += u32::from(plan.arc_free(&geodesic, 0.13).free != draw.path.free);
            }
            let share = f64::from(differ) / f64::from(accepted);
            let error = SIGMAS * (share * (1.0 - share) / f64::from(accepted)).sqrt();
            let least = if place == "doorway" { 0.06 } else { 0.001 };
            println!("{place} {n} {omega}: {share}");
            assert!(share + error > least && share - error < 0.09, "{place}, n = {n}, ω = {omega}: {share}");
        }
    }
}
