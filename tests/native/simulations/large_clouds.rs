//! What ten million robots say, against sums that lose nothing; and what a refresh costs in memory.

use motion::geom::se2::{SE2, wrap_angle};
use motion::sim::View;
use motion::sim::banana::{BananaMachine, Figures, MAX_SAMPLES, ModelKind, Settings};
use motion::sim::picture::RAMP;
use motion::sim::views::Grid;
use motion::stats::Ellipse;
use motion::{NoiseKind, VelocityCmd};
use nalgebra::Vector3;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// A sum in twice the digits (Knuth's two-sum, the error added up as well): exact to 1e-30 of the sum of sizes.
#[derive(Clone, Copy, Default)]
struct Exact {
    sum: f64,
    lost: f64,
}

impl Exact {
    fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        let of_term = sum - self.sum;
        self.lost += (self.sum - (sum - of_term)) + (term - of_term);
        self.sum = sum;
    }
}

fn mean(terms: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (Exact::default(), 0.0);
    for term in terms {
        sum.add(term);
        count += 1.0;
    }
    (sum.sum + sum.lost) / count
}

/// The figures by their definitions, a pass each.
fn check(machine: &BananaMachine) {
    let poses: Vec<SE2> = machine.poses().collect();
    let n = poses.len() as f64;
    let Figures { cartesian, exponential, cross_track, inside_ellipse, .. } = *machine.figures();
    let close = |name: &str, found: f64, expected: f64, size: f64| {
        assert!((found - expected).abs() <= 1e-12 * size, "{name}: {found} is not {expected}");
    };

    let (sin, cos) = (
        mean(poses.iter().map(|pose| libm::sin(pose.theta()))),
        mean(poses.iter().map(|pose| libm::cos(pose.theta()))),
    );
    let heading = libm::atan2(sin, cos);
    let centre = [mean(poses.iter().map(SE2::x)), mean(poses.iter().map(SE2::y))];
    close("mean heading", cartesian.mean.z, heading, 1.0);
    close("mean x", cartesian.mean.x, centre[0], 1.0);
    close("mean y", cartesian.mean.y, centre[1], 1.0);

    let residuals = || {
        poses.iter().map(|pose| {
            Vector3::new(pose.x() - centre[0], pose.y() - centre[1], wrap_angle(pose.theta() - heading))
        })
    };
    let mean_turn = mean(residuals().map(|r| r.z));
    for i in 0..3 {
        for j in 0..3 {
            let shift = |r: Vector3<f64>, k: usize| if k == 2 { r.z - mean_turn } else { r[k] };
            let cov = mean(residuals().map(|r| shift(r, i) * shift(r, j))) * n / (n - 1.0);
            let size = (cartesian.cov[(i, i)] * cartesian.cov[(j, j)]).sqrt();
            close(&format!("cov {i}{j}"), cartesian.cov[(i, j)], cov, size);
        }
    }

    let twist = |pose: &SE2| pose.log_near(machine.settings().command.omega * machine.settings().command.dt);
    let twists = || poses.iter().map(twist);
    let twist_mean = Vector3::from_fn(|i, _| mean(twists().map(|twist| twist[i])));
    // Without a chart nothing is said of it.
    for i in if machine.chart_holds() { 0..3 } else { 0..0 } {
        close(&format!("twist {i}"), exponential.mean[i], twist_mean[i], 1.0);
        for j in 0..3 {
            let cov = mean(twists().map(|t| (t[i] - twist_mean[i]) * (t[j] - twist_mean[j]))) * n / (n - 1.0);
            let size = (exponential.cov[(i, i)] * exponential.cov[(j, j)]).sqrt();
            close(&format!("twist cov {i}{j}"), exponential.cov[(i, j)], cov, size);
        }
    }

    let (sin, cos) = libm::sincos(heading);
    let across = |r: Vector3<f64>| (r.x * cos + r.y * sin, r.y * cos - r.x * sin, r.z);
    let tracks = || residuals().map(across);
    let m2 = mean(tracks().map(|(_, d, _)| d * d));
    let sd = m2.sqrt();
    let skew = mean(tracks().map(|(_, d, _)| (d / sd).powi(3)));
    close("skew", cross_track.skew, skew, 1.0);
    let resultant = mean(residuals().map(|r| libm::cos(r.z)));
    let (ad, add) = (mean(tracks().map(|(a, d, _)| a * d)), mean(tracks().map(|(a, d, _)| a * d * d)));
    let by_heading = 3.0 * (skew * ad / m2 - add / (m2 * sd)) / resultant;
    let influence = |(_, d, turn): (f64, f64, f64)| {
        let z = d / sd;
        z * z * z - skew - 3.0 * z - 1.5 * skew * (z * z - 1.0) + by_heading * libm::sin(turn)
    };
    let skew_error = (mean(tracks().map(|track| influence(track).powi(2))) / n).sqrt();
    close("skew error", cross_track.skew_error, skew_error, skew_error);
    let turn_variance = mean(residuals().map(|r| (r.z - mean_turn).powi(2)));
    let rho = mean(tracks().map(|(_, d, turn)| d * turn)) / (m2 * turn_variance).sqrt();
    close("rho", cross_track.rho_heading, rho, 1.0);

    let ellipse = Ellipse::from_moments(&cartesian);
    let inside = poses.iter().filter(|pose| ellipse.contains([pose.x(), pose.y()])).count();
    // On the contour itself, rounding may decide about one.
    close("coverage", inside_ellipse, inside as f64 / n, 1.5e12 / n);
}

#[test]
fn ten_million_agree_with_exact_sums() {
    const { assert!(MAX_SAMPLES == 10_000_000) };
    let command = VelocityCmd { v: 1.0, omega: 1.2, dt: 1.4 };
    check(&machine(Settings { command, samples: MAX_SAMPLES, ..Settings::default() }));
}

/// Clouds of every shape, among them such as turn beyond the circle or lie far from where noise-free robots end.
#[test]
fn small_and_odd_clouds_agree_with_exact_sums() {
    for model in [ModelKind::Velocity, ModelKind::Odometry] {
        for noise in [NoiseKind::Normal, NoiseKind::Triangular] {
            for command in
                [[1.0, 0.5, 1.0], [-1.0, 1.2, 1.4], [0.06, -1.5, 1.0], [2.0, 0.0, 2.0], [1.0, 3.0, 1.9]]
            {
                for samples in [3, 5, 257, 1022, 20_003] {
                    let [v, omega, dt] = command;
                    let command = VelocityCmd { v, omega, dt };
                    let odometry_alphas = [0.02, 0.01, 0.02, 0.01];
                    check(&machine(Settings {
                        model,
                        noise,
                        command,
                        odometry_alphas,
                        samples,
                        ..Settings::default()
                    }));
                }
            }
        }
    }
}

fn machine(settings: Settings) -> BananaMachine {
    BananaMachine::new(settings).expect("a valid setting")
}

/// In slices, in one go, or grown in batches: the same figures to the last bit.
#[test]
fn slices_change_nothing() {
    let settings = Settings { samples: 10_007, ..Settings::default() };
    let whole = machine(Settings { seed: 11, ..settings });
    for slice in [1, 100, 257, 9999, 1_000_000] {
        let mut sliced = machine(settings);
        let before = *sliced.figures();
        sliced.begin(Settings { seed: 11, ..settings }).expect("a valid setting");
        assert_eq!(
            format!("{:?}", sliced.figures()),
            format!("{before:?}"),
            "the former ones until all is done"
        );
        let mut slices = 1;
        while !sliced.advance(slice) {
            assert!(sliced.shown() <= 10_007);
            assert_eq!(sliced.poses().count(), sliced.shown());
            slices += 1;
        }
        // Two passes in blocks of 256 poses, or whatever is asked for.
        assert!(slices <= 2 * 10_007usize.div_ceil(slice.clamp(1, 256)) + 2);
        assert_eq!(format!("{:?}", sliced.figures()), format!("{:?}", whole.figures()));
        assert!(sliced.poses().eq(whole.poses()));
    }
}

/// Counts what this thread allocates.
struct Counting;

thread_local! {
    static ALLOCATED: Cell<(usize, usize)> = const { Cell::new((0, 0)) };
}

fn note(bytes: usize) {
    let (count, sum) = ALLOCATED.get();
    ALLOCATED.set((count + 1, sum + bytes));
}

// SAFETY: everything is left to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        note(layout.size());
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        note(size);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_slider_allocates_nothing_and_a_pose_takes_forty_bytes() {
    let settings = Settings { samples: 100_000, ..Settings::default() };
    let before = ALLOCATED.get();
    let mut machine = machine(settings);
    let (_, after) = ALLOCATED.get();
    // Beside the poses: the quadrature's nodes, once a process.
    assert!(after - before.1 <= 40 * 100_000 + 4096, "{} bytes", after - before.1);

    let grid = Grid { min: [-1.0, -2.0], max: [2.0, 2.0], columns: 960, rows: 720 };
    let mut event = |omega: f64| {
        let command = VelocityCmd { omega, ..settings.command };
        machine.configure(Settings { command, ..settings }).expect("a valid setting");
        for view in [View::Plane, View::Twist] {
            let pixels = machine.paint(view, &grid, &[[255; 4]; RAMP]).expect("there is memory");
            assert_eq!(pixels.len(), 960 * 720);
        }
    };
    event(0.4);
    let before = ALLOCATED.get();
    (0..20).for_each(|i| event(0.5 + 0.01 * f64::from(i)));
    assert_eq!(ALLOCATED.get(), before, "nothing is allocated in the steady state");
}
