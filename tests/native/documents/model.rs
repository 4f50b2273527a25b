//! Figures of the Banana Machine in doc/model.md, read there and computed.

use crate::common::told::{Number, Told};
use crate::common::{SIGMAS, preset};
use motion::sim::banana::{BananaMachine, Settings};

fn machine(settings: Settings) -> BananaMachine {
    BananaMachine::new(settings).expect("a valid setting")
}

fn document() -> Told {
    Told::in_document(include_str!("../../../doc/model.md"))
}

#[test]
fn the_presets_are_those_in_the_document() {
    for (name, label) in
        [("straight", "Straight"), ("gentle", "Gentle arc"), ("hard", "Hard arc"), ("pivot", "Pivot")]
    {
        let told: [Number; 3] = document().numbers(&format!("| {label} | #, #, # | |"));
        let command = preset(name).command;
        assert_eq!(told.map(|number| number.value), [command.v, command.omega, command.dt], "{name}");
    }
    for (name, label) in [("banana", "Banana"), ("worked", "Worked example")] {
        let told: [Number; 9] = document().numbers(&format!("| {label} | #, #, # | #, #, #, #, #, # |"));
        let Settings { command: c, velocity_alphas: [a1, a2, a3, a4, a5, a6], .. } = preset(name);
        assert_eq!(told.map(|number| number.value), [c.v, c.omega, c.dt, a1, a2, a3, a4, a5, a6], "{name}");
    }
}

/// Shares to 4.5 standard errors of a million robots.
#[test]
fn the_gains_are_those_in_the_document() {
    let row = |name, gains: &[Number], [area, ellipse, skew]: [Number; 3]| {
        let machine = machine(Settings { samples: 1_000_000, ..preset(name) });
        let exact = machine.table().exact;
        let computed = [exact.likelihood_gain.floor, exact.likelihood_gain.pose];
        gains.iter().rev().zip(computed).for_each(|(told, gain)| told.assert(gain, 0.0));
        area.assert(exact.area_ratio, 0.0);
        ellipse.assert_percent(machine.figures().inside_ellipse, SIGMAS * (0.117f64 / 1e6).sqrt());
        skew.assert(exact.cross_track_skew, 1e-12);
    };
    for (name, what) in [
        ("gentle", "| 1, 0.5, 1; the widget's opening ones"),
        ("hard", "| 1, 1.2, 1.4; the same"),
        ("banana", "| 1, 0, 2; (0.002, 0.002, 0.1, 0.1, 0.002, 0.002)"),
    ] {
        let [pose, floor, rest @ ..]: [Number; 5] =
            document().numbers(&format!("{what} | # | # | # | # % | # |"));
        row(name, &[pose, floor], rest);
    }
    let [floor, rest @ ..]: [Number; 4] =
        document().numbers("| 1, 0.5, 1; α₁₋₄ = 0.02, α₅,₆ = 0 | ∞ | # | # | # % | # |");
    row("worked", &[floor], rest);
}

#[test]
fn the_exact_skews_are_those_in_the_document() {
    let [worked, opening] = document().numbers(
        "α₁₋₄ = 0.02, α₅,₆ = 0: skew #; the widget's opening α = (0.05, 0.05, 0.05, 0.09, 0.01, 0.01): #.",
    );
    worked.assert(machine(preset("worked")).exact().cross_track_skew, 0.0);
    let opened = machine(Settings::default());
    opening.assert(opened.exact().cross_track_skew, 0.0);
    let [robots, error] = document()
        .numbers("The widget opens with # robots: at the opening command they tell the skew to ±#,");
    assert_eq!(robots.value, opened.settings().samples as f64);
    error.assert(opened.figures().cross_track.skew_error, 0.0);
}
