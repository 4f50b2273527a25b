//! What an Odometry Decomposer tells, in the order in which digest.js asks for it.

use super::configuration::Configuration;
use super::told::{Part, Told};
use motion::OdomDelta;
use motion::geom::se2::SE2;
use motion::sim::odometry_decomposer::{
    CurvePoint, OdometryDecomposer, PRESETS, Preset, RuleFigures, Settings, Stats,
};

pub fn parts(configuration: &Configuration) -> Vec<Part> {
    let machine =
        OdometryDecomposer::new(configuration.settings(opening(configuration))).expect("a valid setting");
    let flat = |poses: &[SE2]| -> Vec<f64> {
        poses.iter().flat_map(|pose| [pose.x(), pose.y(), pose.theta()]).collect()
    };
    let drifted = machine.drifted();
    let curve: Vec<f64> = machine
        .curve(3.0, 31)
        .iter()
        .flat_map(|CurvePoint { trans, cross_track, lever, along }| [*trans, *cross_track, *lever, *along])
        .collect();
    let nearest = machine.nearest([1.0, 0.8], 0.5).map_or(-1.0, |index| index as f64);
    vec![
        Part::new("poses", &[&flat(machine.poses())]),
        Part::new(
            "linkages",
            &[&flat(&machine.linkage()), &flat(machine.ghosts(9).as_flattened()), &machine.robot()],
        ),
        Part::new("rules", &[&machine.rules()]),
        Part::new("statistics", &[&machine.poses().len(), &machine.stats(), &nearest]),
        Part::new("curve", &[&curve]),
        Part::new("drifted", &[&flat(&[drifted.frame, drifted.from, drifted.to]), &Legs(drifted.legs)]),
    ]
}

/// As the widget opens, with the preset that is named.
fn opening(configuration: &Configuration) -> Settings {
    let opening = Settings::default();
    let Some(wanted) = configuration.value.get("preset") else { return opening };
    let Preset { from, to, .. } =
        *PRESETS.iter().find(|preset| wanted == preset.name).expect("a preset of that name");
    Settings { from, to, ..opening }
}

struct Legs(OdomDelta);

impl Told for Legs {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let OdomDelta { rot1, trans, rot2 } = self.0;
        [rot1, trans, rot2].iter().for_each(|leg| leg.tell(bytes));
    }
}

impl Told for RuleFigures {
    fn tell(&self, bytes: &mut Vec<u8>) {
        Legs(self.legs).tell(bytes);
        self.deviations.tell(bytes);
        self.cross_track.tell(bytes);
        self.heading.tell(bytes);
    }
}

impl Told for Stats {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.n.tell(bytes);
        let Self { cross_track, cross_track_error, exact_cross_track, lever, .. } = *self;
        let Self { heading, heading_error, exact_heading, independent_heading, .. } = *self;
        for figure in [
            cross_track,
            cross_track_error,
            exact_cross_track,
            lever,
            heading,
            heading_error,
            exact_heading,
            independent_heading,
        ] {
            figure.tell(bytes);
        }
    }
}
