//! What the page says under "What to try" of the Banana Machine, computed: the numbers are read from the page.

use crate::common::told::Told;
use crate::common::{SIGMAS, preset, winds_around};
use motion::VelocityCmd;
use motion::sim::banana::{BananaMachine, ModelKind, Settings};

fn machine(settings: Settings) -> BananaMachine {
    BananaMachine::new(settings).expect("a valid setting")
}

fn page() -> Told {
    Told::on_page(include_str!("../../../www/index.html"))
}

#[test]
fn the_opening_is_what_the_page_sends() {
    let [robots] = page().numbers("Send one command to # identical robots");
    assert_eq!(robots.value, Settings::default().samples as f64);
}

/// The robots a square metre in what only one of the outlines encloses: of a million, known to a hundredth.
#[test]
fn the_ellipse_covers_floor_where_few_stop() {
    page().says("where it alone lies, robots stop a seventh as densely as where the outline alone does.");
    let machine = machine(Settings { samples: 1_000_000, ..preset("banana") });
    let contours = machine.contours();
    let enclosing = |at| [&contours.ellipse, &contours.exponential].map(|outline| winds_around(outline, at));
    const STEP: f64 = 0.005;
    let floor = (0..1000).flat_map(|column| (0..1000).map(move |row| (column, row)));
    let cells: Vec<[bool; 2]> = floor
        .map(|(column, row)| enclosing([f64::from(column) * STEP, f64::from(row) * STEP - 2.5]))
        .collect();
    let robots: Vec<[bool; 2]> = machine.poses().map(|pose| enclosing([pose.x(), pose.y()])).collect();
    let density = |which: [bool; 2]| {
        let count = |all: &[[bool; 2]]| all.iter().filter(|each| **each == which).count() as f64;
        count(&robots) / (count(&cells) * STEP * STEP)
    };
    let ratio = density([false, true]) / density([true, false]);
    assert_eq!(ratio.round(), 7.0, "{ratio}");
}

#[test]
fn the_shares_inside_do_not_give_the_hard_arc_away_and_the_skew_does() {
    let [ellipse, outline, skew, any] = page().numbers(
        "do not give the ellipse away, # % and # %. The skew does: #, where any Gaussian in (x, y) has #.",
    );
    let many = Settings { samples: 1_000_000, ..preset("hard") };
    let machine = machine(many);
    let error = SIGMAS * (0.117f64 / 1e6).sqrt();
    ellipse.assert_percent(machine.figures().inside_ellipse, error);
    outline.assert_percent(machine.figures().inside_exponential, error);
    skew.assert(machine.exact().cross_track_skew, 0.0);
    any.assert(machine.table().linearized.cross_track_skew, 0.0);
}

#[test]
fn the_banana_gains_most_and_has_no_skew() {
    let [skew, area, banana, gentle, hard] = page().numbers(
        "so that the skew is # however many robots you send. Yet the ellipse covers # times the floor of the green \
         outline: where it alone lies, robots stop a seventh as densely as where the outline alone does. The Gaussian \
         in ξ gains # nats a robot: more than on the gentle arc, #, and on the hard one, #.",
    );
    let exact = |name| machine(Settings { samples: 1, ..preset(name) }).table().exact;
    assert!(exact("banana").cross_track_skew.abs() < 1e-9 && skew.value == 0.0);
    area.assert(exact("banana").area_ratio, 0.0);
    for (told, name) in [(banana, "banana"), (gentle, "gentle"), (hard, "hard")] {
        told.assert(exact(name).likelihood_gain.pose, 0.0);
    }
    assert!(banana.value > gentle.value.max(hard.value));
}

/// Twenty robots do not rule it out, two thousand do.
#[test]
fn the_error_falls_with_the_root_of_the_robots() {
    page().says("type 20, then 200, then 2000: when does the standard error rule out that the skew is 0? A hundred times the robots leave a tenth of the error.");
    let figures = |samples| machine(Settings { samples, ..Settings::default() }).figures().cross_track;
    let sigmas = [20, 200, 2000].map(|samples| {
        let track = figures(samples);
        track.skew.abs() / track.skew_error
    });
    assert!(sigmas[0] < 2.0 && sigmas[2] > 4.0, "{sigmas:?}");
    let ratio = figures(10_000).skew_error / figures(1_000_000).skew_error;
    assert!((ratio / 10.0 - 1.0).abs() < 0.1, "{ratio}");
}

/// Exercise 4, but for what `isolating_an_alpha_silences_the_others` asserts.
#[test]
fn an_ellipse_is_true_of_alpha_6_and_not_of_alpha_4() {
    page().says("α6 leaves them where they were and blurs the headings. An ellipse on the floor tells the truth about only one of the two.");
    let [omega] = page().numbers("Now turn ω up to #. α4 fans the positions out");
    let only = |alpha| {
        let command = VelocityCmd { omega: omega.value, ..preset("straight").command };
        machine(Settings { command, isolate: Some(alpha), ..Settings::default() })
    };
    let (fan, blur) = (only(4), only(6));
    // All where they were told to stop: the ellipse is that point.
    let end = blur.linearized().mean;
    assert!(blur.poses().all(|pose| (pose.x() - end.x).hypot(pose.y() - end.y) < 1e-12));
    assert!(blur.exact().cov[(2, 2)].sqrt() > 0.05);
    // On a curve: not a line, which an ellipse may be, and with a skew that no Gaussian has.
    assert!(fan.exact().cross_track_skew.abs() > 0.1 && fan.exact_gain().value.floor == f64::INFINITY);
}

#[test]
fn a_shorter_drive_shrinks_the_cloud_and_not_the_circle() {
    let [dt] =
        page().numbers("Shorten Δt to #: the cloud shrinks to less than a tenth, and the circle stays.");
    let after = |dt| {
        let opening = Settings::default();
        machine(Settings { command: VelocityCmd { dt, ..opening.command }, samples: 10, ..opening })
    };
    let size = |dt: f64| {
        let cov = after(dt).exact().cov;
        (cov[(0, 0)] + cov[(1, 1)]).sqrt()
    };
    let circle = |dt: f64| {
        let (machine, end) = (after(dt), after(dt).linearized().mean);
        let [x, y] = machine.contours().additive[0];
        (x - end.x).hypot(y - end.y)
    };
    assert!((circle(1.0) - circle(dt.value)).abs() < 1e-12);
    assert!(size(dt.value) < size(1.0) / 10.0);
}

/// Whatever the seed: of three.
#[test]
fn the_prediction_misses_under_the_odometry_model_alone() {
    let [robots] = page().numbers("the prediction misses: with # robots by more than five standard errors.");
    for (model, misses) in [(ModelKind::Velocity, false), (ModelKind::Odometry, true)] {
        let opening = Settings::default();
        let [a1, a2, a3, a4, ..] = opening.velocity_alphas;
        let velocity_alphas = [a1, a2, a3, a4, 0.0, 0.0];
        for seed in [opening.seed, 11, 12] {
            let settings =
                Settings { model, velocity_alphas, samples: robots.value as usize, seed, ..opening };
            let machine = machine(settings);
            let figures = machine.figures();
            let off =
                (figures.gaussian_skew - figures.cross_track.skew).abs() / figures.cross_track.skew_error;
            assert_eq!(off > 5.0, misses, "{model:?}: {off} standard errors");
            assert!(misses || off < SIGMAS);
        }
    }
}
