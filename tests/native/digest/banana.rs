//! Digested values of a Banana Machine, in the order of digest.js.

use super::configuration::{Configuration, ramp};
use super::told::{Part, Told};
use motion::OdomDelta;
use motion::sim::View;
use motion::sim::banana::{BananaMachine, Figures, PRESETS, Settings, Stats, Table, TableColumn};
use motion::stats::{CartesianMoments, ExponentialMoments, LikelihoodGain};

const VIEWS: [View; 2] = [View::Plane, View::Twist];

pub fn parts(configuration: &Configuration) -> Vec<Part> {
    let settings = configuration.settings(opening(configuration));
    let mut machine = BananaMachine::new(settings).expect("a valid setting");
    let (shown, grid) = (machine.shown(), configuration.grid());
    let poses: Vec<f64> = machine.poses().flat_map(|pose| [pose.x(), pose.y(), pose.theta()]).collect();
    let twists: Vec<f64> = machine.twists().flat_map(<[f64; 3]>::from).collect();
    let executed: Vec<f64> = machine.executed().flatten().collect();
    let contours = machine.contours();
    let mut pictures = VIEWS.map(|view| machine.paint(view, &grid, &ramp(0)).as_flattened().to_vec());
    let [plane, twist] = &mut pictures;
    vec![
        Part::new("poses", &[&poses]),
        Part::new("twists", &[&twists]),
        Part::new("executed", &[&executed]),
        Part::new("statistics", &[&shown, &machine.chart_holds(), &machine.reading(), &machine.stats()]),
        Part::new("table", &[&machine.table()]),
        Part::new(
            "contours",
            &[
                &contours.command.as_flattened().to_vec(),
                &contours.ellipse.as_flattened().to_vec(),
                &contours.linearized.as_flattened().to_vec(),
                &contours.exponential.as_flattened().to_vec(),
                &contours.twist_ellipse.as_flattened().to_vec(),
                &contours.additive.as_flattened().to_vec(),
            ],
        ),
        Part::new("plane", &[plane]),
        Part::new("twist", &[twist]),
    ]
}

/// Returns the default settings with the command of the configuration's preset.
fn opening(configuration: &Configuration) -> Settings {
    let opening = Settings::default();
    let Some(name) = configuration.value.get("preset") else { return opening };
    let preset = PRESETS.iter().find(|preset| name == preset.name).expect("a preset of that name");
    Settings { command: preset.command, ..opening }
}

/// Numbers that are digested without their count, as the fields of an object are.
struct Plain<const N: usize>([f64; N]);

impl<const N: usize> Told for Plain<N> {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.0.iter().for_each(|number| number.tell(bytes));
    }
}

impl Told for OdomDelta {
    fn tell(&self, bytes: &mut Vec<u8>) {
        Plain([self.rot1, self.trans, self.rot2]).tell(bytes);
    }
}

impl Told for CartesianMoments {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.mean.tell(bytes);
        self.cov.tell(bytes);
    }
}

impl Told for ExponentialMoments {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.mean.tell(bytes);
        self.cov.tell(bytes);
    }
}

impl Told for LikelihoodGain {
    fn tell(&self, bytes: &mut Vec<u8>) {
        Plain([self.pose, self.floor]).tell(bytes);
    }
}

impl Told for Stats {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Self { n, figures } = self;
        let Figures { cartesian, exponential, cross_track, gaussian_skew, inside_ellipse, .. } = figures;
        n.tell(bytes);
        cartesian.tell(bytes);
        exponential.tell(bytes);
        Plain([cross_track.skew, cross_track.skew_error, *gaussian_skew, cross_track.rho_heading])
            .tell(bytes);
        Plain([*inside_ellipse, figures.inside_exponential]).tell(bytes);
        figures.gain.value.tell(bytes);
        figures.gain.error.tell(bytes);
        figures.area_ratio.tell(bytes);
    }
}

impl Told for TableColumn {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.mean.tell(bytes);
        self.cov.tell(bytes);
        self.cross_track_skew.tell(bytes);
        self.likelihood_gain.tell(bytes);
        self.area_ratio.tell(bytes);
    }
}

impl Told for Table {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Self { linearized, exact, measured, tangent } = self;
        [linearized, exact, measured].iter().for_each(|column| column.tell(bytes));
        tangent.tell(bytes);
    }
}
