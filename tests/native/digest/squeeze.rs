//! Digested values of Map Squeeze, in the order of digest.js.

use super::configuration::{Configuration, number, numbers, ramp};
use super::told::{Part, Told};
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{Cell, FloorPlan, Interpretation, Mode, OccupancyGrid, read_pgm};
use motion::sim::squeeze::{Attempt, MapSqueeze, PRESETS, Settings, Stats};
use serde_json::Value;

pub fn parts(configuration: &Configuration) -> Vec<Part> {
    let mut machine =
        MapSqueeze::new(configuration.settings(opening(configuration))).expect("a valid setting");
    if let Some(name) = configuration.value.get("map") {
        let map = &configuration.all["maps"][name.as_str().expect("a name")];
        match map.get("plan") {
            Some(plan) => machine.set_plan(read_plan(plan)),
            None => {
                machine.set_grid(read_map(map, &configuration.all["images"])).expect("not too many walls")
            }
        }
    }
    let attempts = machine.attempts();
    let shown = attempts.len();
    let poses: Vec<f64> =
        attempts.iter().flat_map(|Attempt { pose, .. }| [pose.x(), pose.y(), pose.theta()]).collect();
    let verdicts: Vec<u8> = attempts.iter().map(Attempt::verdict).collect();
    let plan = machine.plan();
    let walls: Vec<f64> =
        plan.walls().iter().flat_map(|Segment { from, to }| [from[0], from[1], to[0], to[1]]).collect();
    let statistics = Part::new(
        "statistics",
        &[
            &shown,
            &machine.start_free(),
            &machine.open_place(),
            &machine.settings().noise(),
            &machine.stats(),
        ],
    );
    let map = Part::new("map", &[&plan.bounds(), &walls, &plan.grid()]);
    let pixels = machine.paint(&configuration.grid(), &[ramp(0), ramp(1), ramp(2)]);
    vec![
        map,
        Part::new("poses", &[&poses]),
        Part::new("verdicts", &[&verdicts]),
        statistics,
        Part::new("picture", &[&pixels.as_flattened().to_vec()]),
    ]
}

/// Returns the initial settings of the widget, at the start of the configuration's preset.
fn opening(configuration: &Configuration) -> Settings {
    let opening = Settings::default();
    let Some(wanted) = configuration.value.get("preset") else { return opening };
    let (_, start) = *PRESETS.iter().find(|(name, _)| wanted == name).expect("a preset of that name");
    Settings { start, ..opening }
}

fn read_plan(plan: &Value) -> FloorPlan {
    let walls = plan["walls"].as_array().expect("walls").iter().map(|wall| {
        let [x0, y0, x1, y1] = numbers(wall);
        Segment { from: [x0, y0], to: [x1, y1] }
    });
    FloorPlan::new(walls.collect(), numbers(&plan["bounds"])).expect("a valid plan")
}

fn read_map(map: &Value, images: &Value) -> OccupancyGrid {
    let lines = images[map["image"].as_str().expect("a name")].as_array().expect("lines");
    let text: String = lines.iter().map(|line| format!("{}\n", line.as_str().expect("a line"))).collect();
    let description = &map["description"];
    let [x, y, yaw] = numbers(&description["origin"]);
    let interpretation = Interpretation {
        mode: match description["mode"].as_str() {
            None | Some("trinary") => Mode::Trinary,
            Some("scale") => Mode::Scale,
            Some("raw") => Mode::Raw,
            Some(other) => panic!("{other} is no mode"),
        },
        negate: number(&description["negate"]) == 1.0,
        occupied_thresh: number(&description["occupied_thresh"]),
        free_thresh: number(&description["free_thresh"]),
    };
    let image = read_pgm(text.as_bytes()).expect("a PGM file");
    OccupancyGrid::new(&image, &interpretation, number(&description["resolution"]), SE2::new(x, y, yaw))
}

impl Told for &OccupancyGrid {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.size().iter().for_each(|size| size.tell(bytes));
        self.resolution().tell(bytes);
        let origin = self.origin();
        [origin.x(), origin.y(), origin.theta()].tell(bytes);
        for kind in [Cell::Occupied, Cell::Unknown] {
            self.cells().map(|cell| cell == kind).collect::<Vec<_>>().tell(bytes);
        }
    }
}

impl Told for Stats {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let Self { attempts, drawn, accepted, acceptance_rate, through_wall, .. } = self;
        attempts.tell(bytes);
        drawn.tell(bytes);
        accepted.tell(bytes);
        acceptance_rate.tell(bytes);
        through_wall.tell(bytes);
        self.through_wall_rate.tell(bytes);
        self.through_wall_interval.tell(bytes);
        self.draws_per_accepted.tell(bytes);
        self.wall_tests_per_accepted.tell(bytes);
        self.gave_up.tell(bytes);
    }
}
