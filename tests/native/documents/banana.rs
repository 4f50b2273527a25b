//! Numbers of the Banana Machine on the page, read there and computed.

use crate::common::told::Told;
use crate::common::{SIGMAS, preset, winds_around};
use motion::sim::banana::{BananaMachine, Settings};

fn machine(settings: Settings) -> BananaMachine {
    BananaMachine::new(settings).expect("a valid setting")
}

fn page() -> Told {
    Told::on_page(include_str!("../../../www/index.html"))
}

/// The robots a square metre in what only one of the outlines encloses: of a million, known to a hundredth.
#[test]
fn the_ellipse_covers_floor_where_few_robots_stop() {
    page().says("where it alone lies, robots stop a seventh as densely as where the outline alone does.");
    let machine = machine(Settings { samples: 300_000, ..preset("banana") });
    let contours = machine.contours();
    let enclosing = |at| [&contours.ellipse, &contours.exponential].map(|outline| winds_around(outline, at));
    const STEP: f64 = 0.01;
    let floor = (0..500).flat_map(|column| (0..500).map(move |row| (column, row)));
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
fn the_skew_reveals_the_hard_arc_and_the_shares_do_not() {
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
fn the_banana_has_the_largest_gain_and_no_skew() {
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
