//! `cargo bench`: the kernels behind `npm run bench` without WebAssembly, and the sampler of each model against a plain
//! loop over the chapter's formulas.
#![allow(
    clippy::disallowed_methods,
    reason = "the plain loops use the platform's mathematics, as a reader's would; nobody sees their results"
)]

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use motion::geom::se2::SE2;
use motion::sim::View;
use motion::sim::banana::{BananaMachine, Settings};
use motion::sim::picture::RAMP;
use motion::sim::squeeze::{self, MapSqueeze};
use motion::sim::views::Grid;
use motion::{
    MotionModel, NoiseKind, OdomAlphas, OdomDelta, OdometryModel, TangentNoiseModel, VelocityAlphas,
    VelocityCmd, VelocityModel,
};
use nalgebra::{Matrix3, Vector3};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::{PI, TAU};

fn main() {
    // What is faster must not be so by doing something else.
    agree("velocity", velocity::of_the_crate(), velocity::by_hand());
    agree("odometry", odometry::of_the_crate(), odometry::by_hand());
    agree("tangent", tangent::of_the_crate(), tangent::by_hand());
    divan::main();
}

/// As in benches/scene.js.
const ALPHAS: [f64; 6] = [0.05, 0.05, 0.05, 0.09, 0.01, 0.01];
const COMMAND: VelocityCmd = VelocityCmd { v: 1.0, omega: 0.5, dt: 1.0 };
const PICTURE: Grid = Grid { min: [-0.2, -0.6], max: [2.2, 1.2], columns: 960, rows: 720 };
/// Poses that a sampler draws in one iteration.
const DRAWS: usize = 10_000;

fn settings(samples: usize) -> Settings {
    Settings { velocity_alphas: ALPHAS, command: COMMAND, samples, ..Settings::default() }
}

/// The slider's command at an event: it never stays.
fn command(event: u32) -> VelocityCmd {
    VelocityCmd { omega: 0.5 + 0.001 * f64::from(event % 100), ..COMMAND }
}

/// One event of the slider: figures, contours and picture.
#[divan::bench(args = [100_000, 1_000_000], sample_count = 20)]
fn refresh(bencher: Bencher, samples: usize) {
    let mut machine = BananaMachine::new(settings(samples)).expect("settings in range");
    let mut event = 0;
    bencher.counter(ItemsCount::new(samples)).bench_local(|| {
        event += 1;
        let settings = Settings { command: command(event), ..*machine.settings() };
        machine.configure(settings).expect("settings in range");
        black_box(machine.figures());
        black_box(machine.contours());
        picture(&mut machine);
    });
}

fn picture(machine: &mut BananaMachine) {
    black_box(machine.paint(View::Plane, &PICTURE, &[[0; 4]; RAMP]).expect("memory"));
}

/// Every robot drawn anew.
#[divan::bench(sample_count = 20)]
fn new_seed(bencher: Bencher) {
    const SAMPLES: usize = 100_000;
    let mut machine = BananaMachine::new(settings(SAMPLES)).expect("settings in range");
    bencher.counter(ItemsCount::new(SAMPLES)).bench_local(|| {
        let settings = Settings { seed: machine.settings().seed + 1, ..*machine.settings() };
        machine.configure(settings).expect("settings in range");
        black_box(machine.figures());
    });
}

/// Conditioned samples with both verdicts, the robot dragged about.
#[divan::bench(sample_count = 20)]
fn map_squeeze(bencher: Bencher) {
    const SAMPLES: usize = 100_000;
    let settings = squeeze::Settings { samples: SAMPLES, ..squeeze::Settings::default() };
    let mut machine = MapSqueeze::new(settings).expect("settings in range");
    let mut event = 0;
    bencher.counter(ItemsCount::new(SAMPLES)).bench_local(|| {
        event += 1;
        let [x, y, theta] = settings.start;
        let start = [x + 0.001 * f64::from(event % 100), y, theta];
        machine.configure(squeeze::Settings { start, ..settings }).expect("settings in range");
        black_box(machine.tally());
    });
}

/// Draws a pose reached from another.
trait Sampler: FnMut(&SE2, &mut Xoshiro256PlusPlus) -> SE2 {}
impl<F: FnMut(&SE2, &mut Xoshiro256PlusPlus) -> SE2> Sampler for F {}

fn start() -> SE2 {
    SE2::new(1.0, 2.0, 0.3)
}

/// Runs a sampler many times, its poses all used.
fn draw(bencher: Bencher, mut sample: impl Sampler) {
    let (start, mut rng) = (start(), Xoshiro256PlusPlus::seed_from_u64(7));
    bencher.counter(ItemsCount::new(DRAWS)).bench_local(|| {
        for _ in 0..DRAWS {
            black_box(sample(black_box(&start), &mut rng));
        }
    });
}

/// Panics unless two samplers have the same means and variances of x, y and heading, within five standard errors.
fn agree(model: &str, mut one: impl Sampler, mut other: impl Sampler) {
    const COUNT: usize = 100_000;
    let cloud = |sample: &mut dyn FnMut(&SE2, &mut Xoshiro256PlusPlus) -> SE2, seed| {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
        let poses: Vec<SE2> = (0..COUNT).map(|_| sample(&start(), &mut rng)).collect();
        [SE2::x, SE2::y, SE2::theta].map(|coordinate| moments(poses.iter().map(coordinate)))
    };
    let (ours, plain) = (cloud(&mut one, 1), cloud(&mut other, 2));
    for (axis, (a, b)) in ours.iter().zip(&plain).enumerate() {
        let error = (2.0 / COUNT as f64).sqrt();
        let (mean, variance) = ((a[0] - b[0]).abs(), (a[1] - b[1]).abs());
        assert!(mean <= 5.0 * error * a[1].sqrt(), "{model}: mean {axis} is {} and {}", a[0], b[0]);
        // The variance of a mean square is the fourth moment less the square of the second.
        let spread = (a[2] - a[1] * a[1]).sqrt();
        assert!(variance <= 5.0 * error * spread, "{model}: variance {axis} is {} and {}", a[1], b[1]);
    }
}

/// Mean, variance and fourth central moment.
fn moments(values: impl Iterator<Item = f64> + Clone) -> [f64; 3] {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let about = |power| values.clone().map(|value| (value - mean).powi(power)).sum::<f64>() / count;
    [mean, about(2), about(4)]
}

/// A uniform number in (0, 1).
fn uniform(rng: &mut impl Rng) -> f64 {
    ((rng.next_u64() >> 11) as f64 + 0.5) / (1u64 << 53) as f64
}

/// A normal number of variance `b2`, by Box and Muller.
fn normal(b2: f64, rng: &mut impl Rng) -> f64 {
    b2.sqrt() * (-2.0 * uniform(rng).ln()).sqrt() * (TAU * uniform(rng)).cos()
}

fn wrapped(angle: f64) -> f64 {
    PI - (PI - angle).rem_euclid(TAU)
}

mod velocity {
    use super::*;

    pub fn of_the_crate() -> impl Sampler {
        let model = VelocityModel { alphas: VelocityAlphas(ALPHAS), noise: NoiseKind::Normal };
        move |start: &SE2, rng: &mut Xoshiro256PlusPlus| model.sample(&black_box(COMMAND), start, rng)
    }

    /// Table 5.3.
    pub fn by_hand() -> impl Sampler {
        |start: &SE2, rng: &mut Xoshiro256PlusPlus| {
            let VelocityCmd { v, omega, dt } = black_box(COMMAND);
            let [a1, a2, a3, a4, a5, a6] = black_box(ALPHAS);
            let v_hat = v + normal(a1 * v * v + a2 * omega * omega, rng);
            let omega_hat = omega + normal(a3 * v * v + a4 * omega * omega, rng);
            let gamma_hat = normal(a5 * v * v + a6 * omega * omega, rng);
            let (theta, radius) = (start.theta(), v_hat / omega_hat);
            let turned = theta + omega_hat * dt;
            SE2::new(
                start.x() - radius * theta.sin() + radius * turned.sin(),
                start.y() + radius * theta.cos() - radius * turned.cos(),
                wrapped(turned + gamma_hat * dt),
            )
        }
    }

    #[divan::bench]
    fn sample(bencher: Bencher) {
        draw(bencher, of_the_crate());
    }

    #[divan::bench]
    fn plain(bencher: Bencher) {
        draw(bencher, by_hand());
    }
}

mod odometry {
    use super::*;

    const READING: OdomDelta = OdomDelta { rot1: 0.25, trans: 0.99, rot2: 0.25 };
    const LEG_ALPHAS: [f64; 4] = [0.05, 0.05, 0.05, 0.05];

    pub fn of_the_crate() -> impl Sampler {
        let model = OdometryModel { alphas: OdomAlphas(LEG_ALPHAS), noise: NoiseKind::Normal };
        move |start: &SE2, rng: &mut Xoshiro256PlusPlus| model.sample(&black_box(READING), start, rng)
    }

    /// Table 5.6, from a reading.
    pub fn by_hand() -> impl Sampler {
        |start: &SE2, rng: &mut Xoshiro256PlusPlus| {
            let OdomDelta { rot1, trans, rot2 } = black_box(READING);
            let [a1, a2, a3, a4] = black_box(LEG_ALPHAS);
            let rot1_hat = rot1 - normal(a1 * rot1 * rot1 + a2 * trans * trans, rng);
            let trans_hat = trans - normal(a3 * trans * trans + a4 * (rot1 * rot1 + rot2 * rot2), rng);
            let rot2_hat = rot2 - normal(a1 * rot2 * rot2 + a2 * trans * trans, rng);
            let bearing = start.theta() + rot1_hat;
            SE2::new(
                start.x() + trans_hat * bearing.cos(),
                start.y() + trans_hat * bearing.sin(),
                wrapped(bearing + rot2_hat),
            )
        }
    }

    #[divan::bench]
    fn sample(bencher: Bencher) {
        draw(bencher, of_the_crate());
    }

    #[divan::bench]
    fn plain(bencher: Bencher) {
        draw(bencher, by_hand());
    }
}

mod tangent {
    use super::*;

    const VARIANCES: [f64; 3] = [0.05, 0.001, 0.07];

    pub fn of_the_crate() -> impl Sampler {
        let covariance = Matrix3::from_diagonal(&Vector3::from(VARIANCES));
        let model = TangentNoiseModel::new(covariance).expect("a covariance");
        move |start: &SE2, rng: &mut Xoshiro256PlusPlus| model.sample(&black_box(COMMAND), start, rng)
    }

    /// x ⊞ (τ + w), with exp in closed form.
    pub fn by_hand() -> impl Sampler {
        |start: &SE2, rng: &mut Xoshiro256PlusPlus| {
            let VelocityCmd { v, omega, dt } = black_box(COMMAND);
            let [along, lateral, turn] = black_box(VARIANCES);
            let (vx, vy) = (v * dt + normal(along, rng), normal(lateral, rng));
            let w = omega * dt + normal(turn, rng);
            let (a, b) = (w.sin() / w, (1.0 - w.cos()) / w);
            let (forward, left) = (a * vx - b * vy, b * vx + a * vy);
            let (sin, cos) = start.theta().sin_cos();
            SE2::new(
                start.x() + cos * forward - sin * left,
                start.y() + sin * forward + cos * left,
                wrapped(start.theta() + w),
            )
        }
    }

    #[divan::bench]
    fn sample(bencher: Bencher) {
        draw(bencher, of_the_crate());
    }

    #[divan::bench]
    fn plain(bencher: Bencher) {
        draw(bencher, by_hand());
    }
}
