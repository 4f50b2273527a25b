//! Samples of every model: x, y and heading of the pose, each against its exact distribution by Kolmogorov and Smirnov. The noises by themselves are in `noise.rs`, and what robots execute, in
//! the tests of each model.
//!
//! A right sampler passes one comparison with probability 0.999, and all 60 with 0.94: on these seeds it does.

use crate::common::{KINDS, KOLMOGOROV, SAMPLES, seeded, unit_cdf};
use motion::geom::se2::SE2;
use motion::{
    MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, ReverseAware, TangentNoiseModel,
    VelocityAlphas, VelocityCmd, VelocityModel,
};
use std::f64::consts::PI;

/// Cells of a sum over one noise, by the midpoint rule. Against sixteen times as many it errs by 2e-5 of a probability at worst,
/// a hundredth of what is allowed.
const CELLS: usize = 400;

/// Parts of a cell in which the coordinate hardly depends on the other noise: it is a step there.
const PARTS: usize = 16;

/// Every so many of the sorted samples the distribution function is computed. What may lie between two of them is added to
/// the distance, a tenth of what is allowed.
const STRIDE: usize = 50;

/// √n times the Kolmogorov–Smirnov distance, or up to STRIDE/√n more.
fn distance(mut sample: Vec<f64>, cdf: impl Fn(f64) -> f64) -> f64 {
    sample.sort_unstable_by(f64::total_cmp);
    let n = sample.len() as f64;
    let distance = sample.iter().enumerate().step_by(STRIDE).map(|(i, value)| {
        let probability = cdf(*value);
        (probability - i as f64 / n).max((i + 1) as f64 / n - probability)
    });
    (distance.fold(0.0, f64::max) + STRIDE as f64 / n) * n.sqrt()
}

/// The density of unit-variance noise.
fn unit_density(kind: NoiseKind, z: f64) -> f64 {
    match kind {
        NoiseKind::Normal => (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt(),
        NoiseKind::Triangular => (6f64.sqrt() - z.abs()).max(0.0) / 6.0,
    }
}

/// A coordinate under a value of one unit noise: the other noise scaled and shifted, by its centre and its deviation.
type Given<'a> = &'a dyn Fn(f64) -> [f64; 2];

/// P(coordinate ≤ a), a sum over the noise that is given.
fn cdf(kind: NoiseKind, given: Given) -> impl Fn(f64) -> f64 {
    let reach = match kind {
        // What lies beyond has a probability of 1e-15.
        NoiseKind::Normal => 8.0,
        NoiseKind::Triangular => 6f64.sqrt(),
    };
    let size = 2.0 * reach / CELLS as f64;
    let middle = |cell: usize| (cell as f64 + 0.5) * size - reach;
    let widest = (0..CELLS).map(|cell| given(middle(cell))[1].abs()).fold(0.0, f64::max);
    let terms: Vec<[f64; 3]> = (0..CELLS)
        .flat_map(|cell| {
            let parts = if given(middle(cell))[1].abs() < 0.2 * widest { PARTS } else { 1 };
            let size = size / parts as f64;
            (0..parts)
                .map(move |part| ((cell * parts + part) as f64 + 0.5) * size - reach)
                .map(move |z| [z, size])
        })
        .map(|[z, size]| {
            let [centre, deviation] = given(z);
            // Noise is as likely as its opposite.
            [size * unit_density(kind, z), centre, deviation.abs()]
        })
        .collect();
    move |a| {
        terms
            .iter()
            .map(|[weight, centre, deviation]| weight * unit_cdf(kind, (a - centre) / deviation))
            .sum()
    }
}

/// x, y and heading of poses, each compared with what it should be. Headings keep within (−π, π] here.
fn compare(what: &str, kind: NoiseKind, poses: &[SE2], given: [Given; 3]) {
    assert_eq!(poses.len(), SAMPLES);
    let coordinates: [fn(&SE2) -> f64; 3] = [SE2::x, SE2::y, SE2::theta];
    for ((name, coordinate), given) in ["x", "y", "θ"].into_iter().zip(coordinates).zip(given) {
        let distance = distance(poses.iter().map(coordinate).collect(), cdf(kind, given));
        assert!(distance < KOLMOGOROV, "{what}, {kind:?}: √n·D of {name} is {distance}");
    }
}

/// The chord of an arc of length 1 and this turn, by sines and cosines alone: forward and to the left.
fn chord(turn: f64) -> [f64; 2] {
    if turn.abs() < 1e-4 { [1.0, 0.5 * turn] } else { [turn.sin() / turn, (1.0 - turn.cos()) / turn] }
}

/// A direction in the frame of a pose, in that of the map.
fn turned(pose: &SE2, [forward, left]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = pose.theta().sin_cos();
    [forward * cos - left * sin, forward * sin + left * cos]
}

fn compare_velocity(what: &str, poses: &[SE2], model: &VelocityModel, u: &VelocityCmd, x: &SE2) {
    let [a1, a2, a3, a4, a5, a6] = model.alphas.0;
    let deviation =
        |by_v: f64, by_omega: f64| (by_v * u.v * u.v + by_omega * u.omega * u.omega).sqrt() * u.dt;
    let (length, turn, last) = (deviation(a1, a2), deviation(a3, a4), deviation(a5, a6));
    let along = |axis: usize, origin: f64| {
        move |z: f64| {
            let unit = turned(x, chord(u.omega * u.dt + turn * z))[axis];
            [origin + u.v * u.dt * unit, length * unit]
        }
    };
    let heading = |z: f64| [x.theta() + u.omega * u.dt + turn * z, last];
    compare(what, model.noise, poses, [&along(0, x.x()), &along(1, x.y()), &heading]);
}

/// `aware`: each rotation is charged as the smaller of the two turns that may have made it.
fn compare_odometry(what: &str, poses: &[SE2], model: &OdometryModel, aware: bool, u: &OdomDelta, x: &SE2) {
    let [a1, a2, a3, a4] = model.alphas.0;
    let charged = |rotation: f64| {
        let size = rotation.abs();
        (if aware { size.min((PI - size).abs()) } else { size }).powi(2)
    };
    let (rot1_sq, trans_sq, rot2_sq) = (charged(u.rot1), u.trans * u.trans, charged(u.rot2));
    let rot1 = (a1 * rot1_sq + a2 * trans_sq).sqrt();
    let trans = (a3 * trans_sq + a4 * (rot1_sq + rot2_sq)).sqrt();
    let rot2 = (a1 * rot2_sq + a2 * trans_sq).sqrt();
    let along = |axis: usize, origin: f64| {
        move |z: f64| {
            let (sin, cos) = (u.rot1 + rot1 * z).sin_cos();
            let unit = turned(x, [cos, sin])[axis];
            [origin + u.trans * unit, trans * unit]
        }
    };
    let turn = (u.rot1 + u.rot2).sin().atan2((u.rot1 + u.rot2).cos());
    let heading = |z: f64| [x.theta() + turn + rot1 * z, rot2];
    compare(what, model.noise, poses, [&along(0, x.x()), &along(1, x.y()), &heading]);
}

/// A million draws of a model.
fn drawn<M: MotionModel>(model: &M, u: &M::Control, x: &SE2, seed: u64) -> Vec<SE2> {
    let mut rng = seeded(seed);
    (0..SAMPLES).map(|_| model.sample(u, x, &mut rng)).collect()
}

/// The α's of the widget's opening.
const ALPHAS: VelocityAlphas = VelocityAlphas([0.05, 0.05, 0.05, 0.09, 0.01, 0.01]);
const ODOM_ALPHAS: OdomAlphas = OdomAlphas([0.005, 0.03, 0.05, 0.02]);
const GENTLE: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
const BACK: VelocityCmd = VelocityCmd { v: -1.0, omega: 0.5, dt: 1.0 };

#[test]
fn poses_of_the_velocity_model() {
    let x = SE2::new(1.5, -2.0, 0.3);
    for (seed, u) in (900..).zip([GENTLE, VelocityCmd { v: 1.0, omega: 0.9, dt: 1.1 }, BACK]) {
        for noise in KINDS {
            let model = VelocityModel { alphas: ALPHAS, noise };
            compare_velocity(&format!("{u:?}"), &drawn(&model, &u, &x, seed), &model, &u, &x);
        }
    }
}

#[test]
fn poses_of_the_odometry_model_also_in_reverse() {
    let x = SE2::new(1.5, -2.0, 0.9);
    let readings = [
        OdomDelta { rot1: 0.25, trans: 1.0, rot2: 0.25 },
        OdomDelta { rot1: -0.4, trans: 0.3, rot2: 1.1 },
        OdomDelta { rot1: 3.0, trans: 1.0, rot2: -2.8 },
    ];
    for (seed, u) in (910..).zip(readings) {
        for noise in KINDS {
            let model = OdometryModel { alphas: ODOM_ALPHAS, noise };
            compare_odometry(&format!("{u:?}"), &drawn(&model, &u, &x, seed), &model, false, &u, &x);
            let poses = drawn(&ReverseAware(model), &u, &x, seed + 10);
            compare_odometry(&format!("{u:?}, reverse-aware"), &poses, &model, true, &u, &x);
        }
    }
}

#[test]
fn poses_of_the_tangent_model() {
    let (x, noise) = (SE2::new(1.5, -2.0, 0.3), NoiseKind::Normal);
    let mut rng = seeded(930);
    // With the turn after the arc a small part of the heading's noise, and most of it.
    for alphas in [ALPHAS, VelocityAlphas([0.05, 0.05, 0.005, 0.005, 0.05, 0.05])] {
        let velocity = VelocityModel { alphas, noise };
        let model = TangentNoiseModel::from_velocity(&velocity, &GENTLE).expect("variances");
        let poses: Vec<SE2> = (0..SAMPLES).map(|_| model.sample(&GENTLE, &x, &mut rng)).collect();
        compare_velocity("of the velocity model", &poses, &velocity, &GENTLE, &x);
    }
}
