//! Digested values of a Banana Machine, in the order of digest.js.

use super::configuration::{Configuration, ramp};
use super::told::{Part, Told};
use motion::geom::arc::ArcInversion;
use motion::geom::se2::SE2;
use motion::sim::View;
use motion::sim::banana::{
    BananaMachine, Executed, Figures, PRESETS, Sample, Settings, Stats, Table, TableColumn, command_reaching,
};
use motion::stats::{CartesianMoments, ExponentialMoments, LikelihoodGain};
use motion::{OdomDelta, VelocityCmd};

const VIEWS: [View; 2] = [View::Plane, View::Twist];

pub fn parts(configuration: &Configuration) -> Vec<Part> {
    let settings = configuration.settings(opening(configuration));
    let mut machine = BananaMachine::new(settings).expect("a valid setting");
    let (shown, grid) = (machine.shown(), configuration.grid());
    let poses: Vec<f64> = machine.poses().flat_map(|pose| [pose.x(), pose.y(), pose.theta()]).collect();
    let twists: Vec<f64> = machine.twists().flat_map(<[f64; 3]>::from).collect();
    let executed: Vec<f64> = machine.executed().flatten().collect();
    let contours = machine.contours();
    let inspected: Vec<Inspected> = (0..shown)
        .step_by(501)
        .map(|index| Inspected(machine.inspect(index).expect("a sample that is shown")))
        .collect();
    let nearest =
        VIEWS.map(|view| machine.nearest(view, [0.9, 0.2], [0.5, 0.3]).map_or(-1.0, |index| index as f64));
    let reaching = [[1.0, 0.5], [-0.3, 0.8], [0.0, 0.0], [2.0, -1.5]].map(|[x, y]| {
        let VelocityCmd { v, omega, .. } = command_reaching(x, y, &settings.command);
        Plain([v, omega])
    });
    let densities = VIEWS.map(|view| machine.density(view, &grid));
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
        Part::new("curve", &[&machine.skew_curve(-3.0, 3.0, 25)]),
        Part::new("samples", &[&inspected, &nearest, &reaching]),
        Part::new("densities", &[&densities]),
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

struct Inspected(Sample);

impl Told for Inspected {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Sample { pose, twist, executed, path } = &self.0;
        let pose_of = |pose: &SE2| [pose.x(), pose.y(), pose.theta()];
        pose_of(pose).tell(bytes);
        twist.tell(bytes);
        let (rates, legs) = match *executed {
            Executed::Arc { arc: ArcInversion { v_hat, omega_hat, gamma_hat }, .. } => {
                ([v_hat, omega_hat, gamma_hat], None)
            }
            Executed::Legs(legs) => ([f64::NAN; 3], Some(legs)),
        };
        Plain(rates).tell(bytes);
        legs.tell(bytes);
        path.as_flattened().tell(bytes);
        pose.theta().tell(bytes);
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
