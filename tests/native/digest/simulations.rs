//! Digested results of each simulation, in the order of digest.js.

use super::configuration::{Configuration, number_of, numbers_of, test_ramp};
use super::encoding::HashedPart;
use motion::calibrate::{Estimate, Recommendation, SystematicError};
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{Cell, FloorPlan, MapMode, OccupancyGrid, PixelClassifier, read_pgm};
use motion::sim::View;
use motion::sim::alpha_calibrator::AlphaCalibrator;
use motion::sim::banana::{BananaMachine, TableColumn};
use motion::sim::dead_reckoning::{DeadReckoning, Misses, RECURSIONS};
use motion::sim::squeeze::{Attempt, MapSqueeze};
use motion::stats::LikelihoodGain;
use nalgebra::Vector3;
use serde_json::Value;

pub fn banana_machine(configuration: &Configuration) -> Vec<HashedPart> {
    let mut simulation = BananaMachine::new(configuration.settings()).expect("a valid setting");
    let (reading, contours, table) = (simulation.reading(), simulation.contours(), simulation.table());
    let stats = *simulation.stats();
    let gain_fields_of = |likelihood_gain: LikelihoodGain| (likelihood_gain.pose, likelihood_gain.floor);
    let column_values =
        |c: TableColumn| (c.mean, c.cov, c.cross_track_skew, gain_fields_of(c.likelihood_gain), c.area_ratio);
    let stats = (
        stats.n,
        (stats.cartesian.mean, stats.cartesian.cov),
        (stats.exponential.mean, stats.exponential.cov),
        (stats.cross_track_skew, stats.cross_track_skew_error, stats.gaussian_skew, stats.rho_cross_heading),
        (stats.coverage.ellipse, stats.coverage.exponential),
        (gain_fields_of(stats.likelihood_gain), gain_fields_of(stats.likelihood_gain_error)),
        stats.area_ratio,
    );
    let table_columns =
        (column_values(table.linearized), column_values(table.exact), column_values(table.measured));
    let encoded_outlines = (
        flat_list(&contours.command),
        flat_list(&contours.ellipse),
        flat_list(&contours.linearized),
        flat_list(&contours.exponential),
        flat_list(&contours.twist_ellipse),
        flat_list(&contours.additive),
    );
    let mut paint_view = |view| flat_list(simulation.paint(view, &configuration.grid(), &test_ramp(0)));
    let [plane_pixels, twist_pixels] = [View::Plane, View::Twist].map(&mut paint_view);
    vec![
        HashedPart::new("poses", simulation.poses().flat_map(pose_coordinates).collect::<Vec<_>>()),
        HashedPart::new("twists", simulation.twists().flat_map(<[f64; 3]>::from).collect::<Vec<_>>()),
        HashedPart::new("executed", simulation.executed_motions().flatten().collect::<Vec<_>>()),
        HashedPart::new(
            "statistics",
            (
                simulation.shown_count(),
                simulation.is_exponential_defined(),
                (reading.rot1, reading.trans, reading.rot2),
                stats,
            ),
        ),
        HashedPart::new("table", (table_columns, table.tangent.map(|moments| (moments.mean, moments.cov)))),
        HashedPart::new("contours", encoded_outlines),
        HashedPart::new("plane", plane_pixels),
        HashedPart::new("twist", twist_pixels),
    ]
}

pub fn map_squeeze(configuration: &Configuration) -> Vec<HashedPart> {
    let mut simulation = MapSqueeze::new(configuration.settings()).expect("a valid setting");
    if let Some(map_name) = configuration.settings_json.get("map") {
        let map_json = &configuration.configurations_json["maps"][map_name.as_str().expect("a name")];
        match map_json.get("plan") {
            Some(plan) => simulation.set_plan(read_plan(plan)),
            None => simulation
                .set_grid(read_grid(map_json, &configuration.configurations_json["images"]))
                .expect("not too many walls"),
        }
    }
    let (plan, stats, noise) = (simulation.plan(), simulation.stats(), simulation.settings().noise());
    let attempts = simulation.attempts();
    let wall_ends: Vec<_> = plan.walls().iter().map(|Segment { from, to }| [*from, *to]).collect();
    let grid_fields = plan.grid().map(|grid| {
        let [columns, rows] = grid.size();
        let [are_occupied, are_unknown] = [Cell::Occupied, Cell::Unknown]
            .map(|cell_kind| grid.cells().map(|cell| cell == cell_kind).collect::<Vec<_>>());
        (columns, rows, grid.resolution(), pose_coordinates(grid.origin()), are_occupied, are_unknown)
    });
    let encoded_stats = (
        (stats.attempts, stats.drawn, stats.accepted, stats.acceptance_rate),
        (stats.through_wall, stats.through_wall_rate, stats.through_wall_interval),
        (stats.draws_per_accepted, stats.wall_tests_per_accepted, stats.gave_up),
    );
    vec![
        HashedPart::new("map", (plan.bounds(), flat_list(wall_ends.as_flattened()), grid_fields)),
        HashedPart::new(
            "poses",
            attempts.iter().flat_map(|attempt| pose_coordinates(attempt.pose)).collect::<Vec<_>>(),
        ),
        HashedPart::new("verdicts", attempts.iter().map(Attempt::verdict_bits).collect::<Vec<_>>()),
        HashedPart::new(
            "statistics",
            (attempts.len(), simulation.is_start_free(), simulation.find_free_pose(), noise, encoded_stats),
        ),
        HashedPart::new(
            "picture",
            flat_list(simulation.paint(&configuration.grid(), &[0, 1, 2].map(test_ramp))),
        ),
    ]
}

pub fn dead_reckoning(configuration: &Configuration) -> Vec<HashedPart> {
    let simulation = DeadReckoning::new(configuration.settings()).expect("a valid setting");
    let (settings, stats) = (simulation.settings(), simulation.stats());
    let values_by_step = |vector_of_step: &dyn Fn(usize) -> Vector3<f64>| -> Vec<f64> {
        (0..simulation.measured_moments().len()).flat_map(|k| <[f64; 3]>::from(vector_of_step(k))).collect()
    };
    let undefined_variances = Vector3::repeat(f64::NAN);
    let [variance_ratios, predicted_variances] = [
        RECURSIONS.map(|recursion| values_by_step(&|k| simulation.comparison(recursion).ratios[k])),
        RECURSIONS.map(|recursion| {
            values_by_step(&|k| {
                simulation.predicted_covariances(recursion)[k]
                    .map_or(undefined_variances, |cov| cov.diagonal())
            })
        }),
    ]
    .map(<(_, _, _)>::from);
    let measured_variances = values_by_step(&|k| simulation.measured_moments()[k].cov.diagonal());
    let relative_errors = values_by_step(&|k| simulation.measured_moments()[k].relative_error);
    let encoded_misses =
        [stats.misses.chapter, stats.misses.first_order, stats.misses.fourth_order].map(|misses_by_axis| {
            misses_by_axis
                .map(|Misses { decidable, first, last, end, error }| (decidable, first, last, end, error))
        });
    let encoded_predictions =
        (stats.predicted.chapter, stats.predicted.first_order, stats.predicted.fourth_order);
    let statistics = (
        stats.n,
        (stats.measured.mean, stats.measured.cov),
        encoded_predictions,
        <(_, _, _)>::from(encoded_misses),
    );
    let outlines = simulation.outlines(settings.step).expect("a step");
    vec![
        HashedPart::new("statistics", (simulation.shown_count(), settings.heading_noise(), statistics)),
        HashedPart::new("steps", (variance_ratios, predicted_variances, measured_variances, relative_errors)),
        HashedPart::new(
            "poses",
            (
                flat_list(simulation.poses(settings.step)),
                simulation.twists().flatten().collect::<Vec<_>>(),
                flat_list(simulation.poses(1)),
            ),
        ),
        HashedPart::new(
            "outlines",
            (
                flat_list(&outlines.ellipse),
                flat_list(&outlines.exponential),
                flat_list(&outlines.predicted),
                flat_list(&outlines.measured),
            ),
        ),
    ]
}

pub fn alpha_calibrator(configuration: &Configuration) -> Vec<HashedPart> {
    let simulation = AlphaCalibrator::new(configuration.settings()).expect("a valid setting");
    let calibration = simulation.calibration();
    let estimate_fields_of = |Estimate { value, interval }: &Estimate| (*value, *interval);
    let estimate_of = |error: SystematicError| {
        calibration.systematic_stds[error as usize].map(|_| calibration.systematic.get(error))
    };
    let interval_of = |error: SystematicError| calibration.interval_of(error);
    let is_constant_and_corrected = |error_kinds: &[SystematicError]| {
        let [is_constant, is_corrected] = [calibration.is_constant, calibration.is_corrected]
            .map(|error_flags| error_kinds.iter().any(|error| error_flags[*error as usize]));
        (is_constant, is_corrected)
    };
    let error_fields = |error| (estimate_of(error), interval_of(error), is_constant_and_corrected(&[error]));
    let lever_arm = [SystematicError::LeverArmAhead, SystematicError::LeverArmLeft];
    let systematic_errors = (
        // The number of errors comes first, because JavaScript has them as a list. The lever arm is one error with two coordinates.
        5usize,
        error_fields(SystematicError::ClockOffset),
        error_fields(SystematicError::MountYaw),
        (lever_arm.map(estimate_of), lever_arm.map(interval_of), is_constant_and_corrected(&lever_arm)),
        error_fields(SystematicError::DistanceScale),
        error_fields(SystematicError::TurnScale),
    );
    let reference_noise = calibration.reference_noise.each_ref().map(estimate_fields_of);
    let encoded_checks: Vec<_> = calibration
        .diagnostics
        .checks
        .iter()
        .map(|check| (check.value, check.expected, check.passed))
        .collect();
    let encoded_windows: Vec<_> = calibration
        .diagnostics
        .windows
        .iter()
        .map(|window| (window.length, window.count, window.coverage, window.nees))
        .collect();
    let encoded_recommendation = calibration
        .recommended
        .as_ref()
        .map(|Recommendation { alphas, inflation, .. }| (alphas.clone(), *inflation));
    let encoded_truth = simulation.truth().map(|simulated_truth| {
        let alphas = (simulated_truth.alphas, simulated_truth.clock_offset, simulated_truth.mount_yaw);
        (alphas, simulated_truth.lever_arm, simulated_truth.distance_scale, simulated_truth.turn_scale)
    });
    let encoded_persistence =
        (estimate_fields_of(&calibration.persistence.correlation), calibration.persistence.length);
    vec![
        HashedPart::new(
            "alphas",
            (calibration.alphas.clone(), calibration.intervals.clone(), calibration.log_likelihood),
        ),
        HashedPart::new("systematic", systematic_errors),
        HashedPart::new("noise", (reference_noise, encoded_persistence)),
        HashedPart::new("diagnostics", (encoded_checks, encoded_windows, encoded_recommendation)),
        HashedPart::new("truth", encoded_truth),
    ]
}

fn pose_coordinates(pose: SE2) -> [f64; 3] {
    [pose.x(), pose.y(), pose.theta()]
}

fn flat_list<T: Copy, const N: usize>(rows: &[[T; N]]) -> Vec<T> {
    rows.as_flattened().to_vec()
}

fn read_plan(plan: &Value) -> FloorPlan {
    let walls = plan["walls"].as_array().expect("walls").iter().map(|wall| {
        let [x0, y0, x1, y1] = numbers_of(wall);
        Segment { from: [x0, y0], to: [x1, y1] }
    });
    FloorPlan::new(walls.collect(), numbers_of(&plan["bounds"])).expect("a valid plan")
}

fn read_grid(map_json: &Value, images_json: &Value) -> OccupancyGrid {
    let image_lines = images_json[map_json["image"].as_str().expect("a name")].as_array().expect("lines");
    let image_text: String =
        image_lines.iter().map(|image_line| format!("{}\n", image_line.as_str().expect("a line"))).collect();
    let description = &map_json["description"];
    let [x, y, yaw] = numbers_of(&description["origin"]);
    let interpretation = PixelClassifier {
        mode: match description["mode"].as_str() {
            None | Some("trinary") => MapMode::Trinary,
            Some("scale") => MapMode::Scale,
            Some("raw") => MapMode::Raw,
            Some(unknown_mode) => panic!("{unknown_mode} is no mode"),
        },
        negate: number_of(&description["negate"]) == 1.0,
        occupied_thresh: number_of(&description["occupied_thresh"]),
        free_thresh: number_of(&description["free_thresh"]),
    };
    let image = read_pgm(image_text.as_bytes()).expect("a PGM file");
    OccupancyGrid::new(&image, &interpretation, number_of(&description["resolution"]), SE2::new(x, y, yaw))
}
