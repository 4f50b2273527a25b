//! Digested values of Dead Reckoning, in the order of digest.js.

use super::configuration::Configuration;
use super::told::{Part, Told};
use motion::sim::dead_reckoning::{DeadReckoning, Misses, Outlines, PRESETS, RECURSIONS, Settings, Stats};
use nalgebra::Vector3;

pub fn parts(configuration: &Configuration) -> Vec<Part> {
    let machine =
        DeadReckoning::new(configuration.settings(opening(configuration))).expect("a valid setting");
    let step = machine.settings().step;
    let none = Vector3::repeat(f64::NAN);
    let of_each = |what: &dyn Fn(usize) -> Vector3<f64>| -> Vec<f64> {
        (0..machine.measured().len()).flat_map(|k| <[f64; 3]>::from(what(k))).collect()
    };
    let ratios = Plain(RECURSIONS.map(|order| of_each(&|k| machine.compared(order).ratios[k])));
    let predicted = Plain(
        RECURSIONS.map(|order| of_each(&|k| machine.predicted(order)[k].map_or(none, |cov| cov.diagonal()))),
    );
    let measured = of_each(&|k| machine.measured()[k].cov.diagonal());
    let errors = of_each(&|k| machine.measured()[k].relative_error);
    let flat = |poses: &[[f64; 3]]| poses.as_flattened().to_vec();
    let twists: Vec<f64> = machine.twists().flatten().collect();
    let Outlines { ellipse, exponential, predicted: of_xi, measured: of_robots } =
        machine.outlines(step).expect("a step");
    let points = |outline: Vec<[f64; 2]>| outline.as_flattened().to_vec();
    vec![
        Part::new("statistics", &[&machine.shown(), &machine.settings().heading_noise(), &machine.stats()]),
        Part::new("steps", &[&ratios, &predicted, &measured, &errors]),
        Part::new("poses", &[&flat(machine.poses(step)), &twists, &flat(machine.poses(1))]),
        Part::new("outlines", &[&points(ellipse), &points(exponential), &points(of_xi), &points(of_robots)]),
    ]
}

/// Returns the initial settings of the widget, with the configuration's preset.
fn opening(configuration: &Configuration) -> Settings {
    let opening = Settings::default();
    let Some(name) = configuration.value.get("preset") else { return opening };
    let preset = PRESETS.iter().find(|preset| name == preset.name).expect("a preset of that name");
    Settings { command: preset.command, steps: preset.steps, alphas: preset.alphas, ..opening }
}

/// Values that are digested without their number, as the fields of an object are.
struct Plain<T, const N: usize>([T; N]);

impl<T: Told, const N: usize> Told for Plain<T, N> {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.0.iter().for_each(|value| value.tell(bytes));
    }
}

impl Told for Misses {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Self { told, first, last, end, error } = self;
        let values: [&dyn Told; 5] = [told, first, last, end, error];
        values.iter().for_each(|value| value.tell(bytes));
    }
}

impl Told for Stats {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Self { n, measured, predicted, misses } = self;
        let values: [&dyn Told; 9] = [
            n,
            &measured.mean,
            &measured.cov,
            &predicted.chapter,
            &predicted.first_order,
            &predicted.fourth_order,
            &misses.chapter,
            &misses.first_order,
            &misses.fourth_order,
        ];
        values.iter().for_each(|value| value.tell(bytes));
    }
}
