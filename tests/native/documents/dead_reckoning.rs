//! What the page says of dead reckoning, computed: its numbers are read there.

use crate::common::told::{Number, Told};
use motion::Compounding;
use motion::sim::dead_reckoning::{DeadReckoning, NoisePer, PRESETS, Settings, TOLERANCE};

fn page() -> Told {
    Told::on_page(include_str!("../../../www/index.html"))
}

fn machine(settings: Settings) -> DeadReckoning {
    DeadReckoning::new(settings).expect("valid settings")
}

fn preset(name: &str) -> DeadReckoning {
    let preset = PRESETS.iter().find(|preset| preset.name == name).expect("a preset of that name");
    let (command, steps, alphas) = (preset.command, preset.steps, preset.alphas);
    machine(Settings { command, steps, alphas, ..Settings::default() })
}

/// The chapter's ratios against the fourth order, which is right to some thousandths: without the robots' luck.
fn exact(machine: &DeadReckoning, axis: usize) -> Vec<f64> {
    let covs =
        |order| machine.predicted(order).iter().map(move |cov| cov.expect("a covariance")[(axis, axis)]);
    covs(Compounding::Chapter).zip(covs(Compounding::FourthOrder)).map(|(one, other)| one / other).collect()
}

fn off(ratios: &[f64]) -> Vec<usize> {
    (1..=ratios.len()).filter(|k| (ratios[k - 1] - 1.0).abs() > TOLERANCE).collect()
}

/// The presets are those that the widget opens with, or differ from it in what they are about.
#[test]
fn the_widget_opens_with_the_chapters_path() {
    assert_eq!(preset("chapter").settings(), &Settings::default());
}

#[test]
fn the_lateral_miss_is_worse_than_the_six_per_cent() {
    let opening = machine(Settings::default());
    let [told]: [Number; 1] =
        page().numbers("what its own loses by the end: # % of the variance along the track");
    let compared = opening.compared(Compounding::Chapter);
    told.assert_percent(-compared.misses[0].end, 0.0);
    told.assert_percent(1.0 - exact(&opening, 0)[19], 0.0);
    page().says("the Gaussian that the chapter predicts is a line, for its R has no lateral noise");
    assert_eq!(compared.ratios[0].y, 0.0);
    assert!(opening.measured()[0].cov[(1, 1)] > 0.0);
    let [second, fifth]: [Number; 2] =
        page().numbers("At step 2 it predicts # of the lateral variance, at step 5 #.");
    for ratios in [exact(&opening, 1), compared.ratios.iter().map(|ratio| ratio.y).collect()] {
        second.assert(ratios[1], 0.0);
        fifth.assert(ratios[4], 0.0);
    }
    page().says("Choose with Jr: every curve is at 1, to a hundredth.");
    page().says("fourth order looks the same");
    for order in [Compounding::FirstOrder, Compounding::FourthOrder] {
        for ratio in &opening.compared(order).ratios {
            assert!(ratio.iter().all(|ratio| (ratio - 1.0).abs() < 0.01), "{order:?}: {ratio}");
        }
    }
}

#[test]
fn crossings_are_those_of_exercise_7() {
    let [usual]: [Number; 1] = page().numbers("is off by more than 5 % from step # on. Press");
    let [doubled]: [Number; 1] =
        page().numbers("Heading noise doubled: from step # on, which is earlier, but not by half.");
    for (told, name) in [(usual, "chapter"), (doubled, "doubled")] {
        let machine = preset(name);
        let first = machine.compared(Compounding::Chapter).misses[0].first.expect("a miss");
        told.assert(f64::from(first), 0.0);
        told.assert(off(&exact(&machine, 0))[0] as f64, 0.0);
    }
    assert!(doubled.value > usual.value / 2.0);
}

#[test]
fn shorter_steps_lack_less() {
    page().says(
        "along the track nothing is off by 5 % any more, and laterally for half a second instead of three.",
    );
    let (usual, fine) = (preset("chapter"), preset("fine"));
    assert!(off(&exact(&fine, 0)).is_empty());
    assert_eq!(fine.compared(Compounding::Chapter).misses[0].first, None);
    for (machine, seconds) in [(&usual, 3.0), (&fine, 0.5)] {
        let dt = machine.settings().command.dt;
        let last = machine.compared(Compounding::Chapter).misses[1].last.expect("a miss");
        for steps in [f64::from(last), off(&exact(machine, 1)).len() as f64] {
            assert!((steps * dt / seconds - 1.0).abs() < 0.1, "{steps} steps of {dt} s, not {seconds} s");
        }
    }
    page().says("there is less noise, too: the α’s are for a step, of whatever length.");
    let (at_end, finely) = (usual.measured()[19].cov, fine.measured()[199].cov);
    assert!((0..3).all(|i| finely[(i, i)] < 0.5 * at_end[(i, i)]));
    page().says("and headings spread as those of one command of four seconds");
    let whole = machine(Settings { per: NoisePer::Path, ..*fine.settings() });
    let one = {
        let mut settings = *fine.settings();
        (settings.command.dt, settings.steps, settings.step) = (4.0, 1, 1);
        machine(settings)
    };
    let heading = |machine: &DeadReckoning| {
        machine.predicted(Compounding::FirstOrder).last().copied().flatten().expect("a covariance")[(2, 2)]
    };
    assert!((heading(&whole) / heading(&one) - 1.0).abs() < 1e-12);
}

#[test]
fn bananas_bend_after_the_crossing() {
    let [along, across]: [Number; 2] =
        page().numbers("along the track with the power #, across it with the power #. They cross");
    let [usual, sharper]: [Number; 2] =
        page().numbers("They cross after # s; with h four times as large, after # s.");
    let opening = machine(Settings { samples: 1, ..Settings::default() });
    let growth = opening.straight();
    usual.assert(growth.crossing.expect("a crossing"), 0.0);
    let last = growth.durations.len() - 1;
    let power = |of: &[f64]| (of[last] / of[0]).ln() / (growth.durations[last] / growth.durations[0]).ln();
    along.assert(power(&growth.along_first_order), 1e-12);
    across.assert(power(&growth.across_first_order), 1e-12);
    let h = 4.0 * opening.settings().heading_noise().expect("a level");
    let alphas = [0.02, 0.02, h, h, h / 4.0, h / 4.0];
    let doubled = machine(Settings { alphas, samples: 1, ..Settings::default() });
    sharper.assert(doubled.straight().crossing.expect("a crossing"), 0.0);
}
