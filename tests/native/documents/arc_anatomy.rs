//! What the page says under "What to try" of Arc Anatomy, computed: the numbers are read from the page.

use crate::common::told::{Number, Told};
use motion::sim::arc_anatomy::{ArcAnatomy, FinalPose, Mapped, PRESETS, Settings, Stats};

fn page() -> Told {
    Told::on_page(include_str!("../../../www/index.html"))
}

fn preset(name: &str) -> Settings {
    let preset = PRESETS.iter().find(|preset| preset.name == name).expect("a preset of that name");
    Settings { command: preset.command, next: preset.next, ..Settings::default() }
}

fn stats(settings: Settings) -> Stats {
    ArcAnatomy::new(settings).expect("valid settings").stats()
}

/// As the robot is turned until the wedge is gone.
fn without_wedge(settings: Settings) -> Settings {
    let theta = stats(settings).driven.end[2];
    Settings { next: FinalPose { theta, ..settings.next }, ..settings }
}

#[test]
fn the_last_turn_is_the_culprit() {
    let [off, alone, all] = page().numbers(
        "The robot stands # standard deviations of the last turn off, and that factor alone leaves # % of its peak; all \
         three leave # %.",
    );
    let Stats { factors, weakest, share, .. } = stats(Settings::default());
    assert_eq!(weakest, 2);
    off.assert(factors[2].deviations, 0.0);
    alone.assert_percent(factors[2].share, 0.0);
    all.assert_percent(share, 0.0);
    let [left] = page().numbers("until the wedge is gone: # % are left, and the position");
    let Stats { factors, share, .. } = stats(without_wedge(Settings::default()));
    left.assert_percent(share, 0.0);
    assert!((factors[2].share - 1.0).abs() < 1e-12);
    // From the keyboard it goes by 5°, and comes near.
    let key = std::f64::consts::PI / 36.0;
    let Settings { next, .. } = Settings::default();
    let best = (0..20)
        .map(|presses| {
            stats(Settings {
                next: FinalPose { theta: next.theta - f64::from(presses) * key, ..next },
                ..Settings::default()
            })
            .share
        })
        .fold(0.0, f64::max);
    left.assert_percent(best, 0.0);
}

#[test]
fn as_printed_p_is_gone_where_the_centre_is_to_the_right() {
    let [v]: [Number; 1] = page().numbers("and v̂ comes out as # m/s.");
    for name in ["right", "reverse"] {
        let printed = Settings { printed: true, ..preset(name) };
        let Stats { factors, share, inverted, .. } = stats(printed);
        assert!(inverted.radius < 0.0 && share < 1e-15);
        // In reverse it is the command that goes the other way.
        v.assert(-factors[0].estimate.abs(), 0.0);
        assert!(factors[0].estimate * printed.command.v < 0.0);
        // All that is left is about the start: where it is shaded, and where it would be with a sign.
        let furthest = |settings: Settings| {
            let surface = ArcAnatomy::new(Settings { map: Mapped::Prob, ..settings })
                .expect("valid settings")
                .surface([-2.0, -2.0], [2.0, 2.0])
                .expect("a map");
            surface.prob.iter().flatten().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max)
        };
        assert!(furthest(printed) < 0.5 && furthest(preset(name)) > 1.0, "{}", furthest(printed));
    }
}

/// Of both maps the summit, by its innermost contour.
#[test]
fn the_density_has_its_summit_nearer_to_the_start() {
    page().says("the density has its summit nearer to the start.");
    for name in ["left", "right", "reverse", "straight"] {
        let (mut prob, mut density) = ([0.0; 2], [0.0; 2]);
        let (mut p_top, mut d_top) = (0.0, 0.0);
        let settings = preset(name);
        for i in 0..200 {
            for k in 0..200 {
                let at = [f64::from(i) * 0.02 - 1.99, f64::from(k) * 0.02 - 1.99];
                let next = FinalPose { x: at[0], y: at[1], ..settings.next };
                let Stats { prob: p, density: d, .. } = stats(Settings { next, ..settings });
                let d = d.expect("noise of full rank");
                if p > p_top {
                    (p_top, prob) = (p, at);
                }
                if d > d_top {
                    (d_top, density) = (d, at);
                }
            }
        }
        let [p, d] = [prob, density].map(|[x, y]| x.hypot(y));
        assert!(d < p - 0.02, "{name}: {d} {p}");
    }
}

#[test]
fn the_ticks_go_with_the_wedge() {
    page().says("Turn the robot until the wedge is gone, and the ticks go with it.");
    let lateral = |settings| stats(settings).xi[1].abs();
    assert!(lateral(Settings::default()) > 0.1 && lateral(without_wedge(Settings::default())) < 1e-12);
}
