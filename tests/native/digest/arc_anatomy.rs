//! What Arc Anatomy tells, in the order in which digest.js asks for it.

use super::configuration::Configuration;
use super::told::{Part, Told};
use motion::sim::arc_anatomy::{
    ArcAnatomy, Bend, CHAPTERS_THRESHOLD, Factor, FormErrors, PRESETS, Paths, Preset, Settings, Stats,
    Surface, Table, form_errors,
};

pub fn parts(configuration: &Configuration) -> Vec<Part> {
    let settings = configuration.settings(opening(configuration));
    let machine = ArcAnatomy::new(settings).expect("valid settings");
    let grid = configuration.grid();
    let underway = [0.0, 0.3, 1.0].map(|share| {
        let poses = machine.underway(share).map(|pose| [pose.x(), pose.y(), pose.theta()]);
        poses.as_flattened().to_vec()
    });
    let told = |each: &[[f64; 2]]| each.as_flattened().to_vec();
    let Paths { commanded, inverted, driven, lie, ticks } = machine.paths();
    let Table { lines, middle, normal } = machine.table();
    let FormErrors { omega, arc, straight, chord, estimated_crossover } = form_errors();
    vec![
        Part::new("statistics", &[&machine.stats()]),
        Part::new("table", &[&lines, &middle, &normal]),
        Part::new(
            "paths",
            &[
                &told(&commanded),
                &told(&inverted),
                &told(&driven),
                &told(&lie),
                &ticks.as_flattened().to_vec(),
                &underway,
            ],
        ),
        Part::new("surface", &[&machine.surface(grid.min, grid.max)]),
        Part::new("forms", &[&omega, &arc, &straight, &chord, &estimated_crossover, &CHAPTERS_THRESHOLD]),
    ]
}

/// As the widget opens, or as the preset that is named.
fn opening(configuration: &Configuration) -> Settings {
    let opening = Settings::default();
    let Some(wanted) = configuration.value.get("preset") else { return opening };
    let Preset { command, next, .. } =
        *PRESETS.iter().find(|preset| wanted == preset.name).expect("a preset of that name");
    Settings { command, next, ..opening }
}

impl Told for Bend {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Self { arc_length, turn, radius, centre, end } = self;
        arc_length.tell(bytes);
        turn.tell(bytes);
        radius.tell(bytes);
        centre.tell(bytes);
        end.tell(bytes);
    }
}

impl Told for Factor {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Self { estimate, residual, deviation, deviations, value, share } = *self;
        [estimate, residual, deviation, deviations, value, share].iter().for_each(|each| each.tell(bytes));
    }
}

impl Told for Stats {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Self { commanded, inverted, driven, last_turn, factors, weakest, prob, share, density, xi } =
            self;
        [commanded, inverted, driven].iter().for_each(|bend| bend.tell(bytes));
        last_turn.tell(bytes);
        factors.tell(bytes);
        weakest.tell(bytes);
        prob.tell(bytes);
        share.tell(bytes);
        density.tell(bytes);
        xi.tell(bytes);
    }
}

impl Told for Surface {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Self { columns, rows, shades, prob, density } = self;
        columns.tell(bytes);
        rows.tell(bytes);
        shades.tell(bytes);
        for lines in [prob, density] {
            lines.iter().map(|line| line.as_flattened().to_vec()).collect::<Vec<_>>().tell(bytes);
        }
    }
}
