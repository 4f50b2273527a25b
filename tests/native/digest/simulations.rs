//! Results of each simulation that the digest contains, in the order of digest.js.

use super::configuration::{Configuration, new_test_ramp, to_number, to_numbers};
use super::encoding::HashedPart;
use motion::calibrate::{Estimate, SystematicError};
use motion::geom::se2::SE2;
use motion::geom::segment::Segment;
use motion::map::{Cell, FloorPlan, MapMode, OccupancyGrid, PixelClassifier, read_pgm};
use motion::sim::alpha_calibrator::AlphaCalibrator;
use motion::sim::banana::{BananaMachine, TableColumn};
use motion::sim::dead_reckoning::{DeadReckoning, Misses, RECURSIONS};
use motion::sim::squeeze::{Attempt, MapSqueeze};
use motion::stats::LikelihoodGain;
use nalgebra::Vector3;
use serde_json::Value;

pub fn hash_banana_machine(configuration: &Configuration) -> Vec<HashedPart> {
    let mut simulation = BananaMachine::new(configuration.read_settings()).expect("a valid setting");
    let (odometry_reading, cloud_contours, table) =
        (simulation.reading(), simulation.contours(), simulation.table());
    let stats = *simulation.stats();
    let gain_fields_of = |likelihood_gain: LikelihoodGain| (likelihood_gain.pose, likelihood_gain.floor);
    let fields_of_column =
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
        (fields_of_column(table.linearized), fields_of_column(table.exact), fields_of_column(table.measured));
    let outline_coordinates = (
        flatten(&cloud_contours.command),
        flatten(&cloud_contours.ellipse),
        flatten(&cloud_contours.linearized),
        flatten(&cloud_contours.exponential),
        flatten(&cloud_contours.twist_ellipse),
        flatten(&cloud_contours.additive),
    );
    let mut paint_stage = |morph_fraction| {
        flatten(simulation.paint_picture(morph_fraction, &configuration.view_grid(), &new_test_ramp(0)))
    };
    let [plane_pixels, twist_pixels] = [0.0, 1.0].map(&mut paint_stage);
    vec![
        HashedPart::new("poses", simulation.poses().flat_map(coordinates_of).collect::<Vec<_>>()),
        HashedPart::new("twists", simulation.twists().flat_map(<[f64; 3]>::from).collect::<Vec<_>>()),
        HashedPart::new("executed", simulation.executed_motions().flatten().collect::<Vec<_>>()),
        HashedPart::new(
            "statistics",
            (
                simulation.shown_count(),
                simulation.is_exponential_defined(),
                (odometry_reading.rot1, odometry_reading.trans, odometry_reading.rot2),
                stats,
            ),
        ),
        HashedPart::new("table", (table_columns, table.tangent.map(|moments| (moments.mean, moments.cov)))),
        HashedPart::new("contours", outline_coordinates),
        HashedPart::new("plane", plane_pixels),
        HashedPart::new("twist", twist_pixels),
    ]
}

pub fn hash_map_squeeze(configuration: &Configuration) -> Vec<HashedPart> {
    let mut simulation = MapSqueeze::new(configuration.read_settings()).expect("a valid setting");
    if let Some(map_name) = configuration.settings_json.get("map") {
        let map_json = &configuration.configurations_json["maps"][map_name.as_str().expect("a name")];
        match map_json.get("plan") {
            Some(floor_plan) => simulation.set_plan(read_floor_plan(floor_plan)),
            None => simulation
                .set_grid(read_grid(map_json, &configuration.configurations_json["images"]))
                .expect("not too many walls"),
        }
    }
    let (floor_plan, stats, noise_level) =
        (simulation.plan(), simulation.stats(), simulation.settings().noise());
    let shown_attempts = simulation.attempts();
    let wall_ends: Vec<_> = floor_plan.walls().iter().map(|wall| [wall.from, wall.to]).collect();
    let grid_fields = floor_plan.grid().map(|grid| {
        let [column_count, rows] = grid.size();
        let [occupied_flags, are_unknown] = [Cell::Occupied, Cell::Unknown]
            .map(|cell_kind| grid.cells().map(|grid_cell| grid_cell == cell_kind).collect::<Vec<_>>());
        (column_count, rows, grid.resolution(), coordinates_of(grid.origin()), occupied_flags, are_unknown)
    });
    let stat_fields = (
        (stats.attempts, stats.drawn, stats.accepted, stats.acceptance_rate),
        (stats.through_wall, stats.through_wall_rate, stats.through_wall_interval),
        (stats.draws_per_accepted, stats.wall_tests_per_accepted, stats.gave_up),
    );
    vec![
        HashedPart::new("map", (floor_plan.bounds(), flatten(wall_ends.as_flattened()), grid_fields)),
        HashedPart::new(
            "poses",
            shown_attempts.iter().flat_map(|attempt| coordinates_of(attempt.pose)).collect::<Vec<_>>(),
        ),
        HashedPart::new("verdicts", shown_attempts.iter().map(Attempt::verdict_bits).collect::<Vec<_>>()),
        HashedPart::new(
            "statistics",
            (
                shown_attempts.len(),
                simulation.is_start_free(),
                simulation.plan().find_free_pose(simulation.settings().clearance),
                noise_level,
                stat_fields,
            ),
        ),
        HashedPart::new(
            "picture",
            flatten(simulation.paint_picture(&configuration.view_grid(), &[0, 1, 2].map(new_test_ramp))),
        ),
    ]
}

pub fn hash_dead_reckoning(configuration: &Configuration) -> Vec<HashedPart> {
    let simulation = DeadReckoning::new(configuration.read_settings()).expect("a valid setting");
    let (settings, stats) = (simulation.settings(), simulation.stats());
    let flatten_by_step = |vector_at_step: &dyn Fn(usize) -> Vector3<f64>| -> Vec<f64> {
        (0..simulation.measured_moments().len()).flat_map(|k| <[f64; 3]>::from(vector_at_step(k))).collect()
    };
    let undefined_variances = Vector3::repeat(f64::NAN);
    let [variance_ratios, predicted_variances] = [
        RECURSIONS.map(|compounding| flatten_by_step(&|k| simulation.comparison(compounding).ratios[k])),
        RECURSIONS.map(|compounding| {
            flatten_by_step(&|k| {
                simulation.predicted_covariances(compounding)[k]
                    .map_or(undefined_variances, |cov| cov.diagonal())
            })
        }),
    ]
    .map(<(_, _, _)>::from);
    let measured_variances = flatten_by_step(&|k| simulation.measured_moments()[k].cov.diagonal());
    let relative_errors = flatten_by_step(&|k| simulation.measured_moments()[k].relative_error);
    let miss_fields = [stats.misses.chapter, stats.misses.first_order, stats.misses.fourth_order]
        .map(|axis_misses| axis_misses.map(|m: Misses| (m.decidable, m.first, m.last, m.end, m.error)));
    let predicted_covs = (stats.predicted.chapter, stats.predicted.first_order, stats.predicted.fourth_order);
    let stats_fields =
        (stats.n, (stats.measured.mean, stats.measured.cov), predicted_covs, <(_, _, _)>::from(miss_fields));
    let step_outlines = simulation.outlines(settings.step).expect("a step");
    vec![
        HashedPart::new("statistics", (simulation.shown_count(), settings.heading_noise(), stats_fields)),
        HashedPart::new("steps", (variance_ratios, predicted_variances, measured_variances, relative_errors)),
        HashedPart::new(
            "poses",
            (
                flatten(simulation.poses(settings.step)),
                simulation.twists().flatten().collect::<Vec<_>>(),
                flatten(simulation.poses(1)),
            ),
        ),
        HashedPart::new(
            "outlines",
            (
                flatten(&step_outlines.ellipse),
                flatten(&step_outlines.exponential),
                flatten(&step_outlines.predicted),
                flatten(&step_outlines.measured),
            ),
        ),
    ]
}

pub fn hash_alpha_calibrator(configuration: &Configuration) -> Vec<HashedPart> {
    let simulation = AlphaCalibrator::new(configuration.read_settings()).expect("a valid setting");
    let calibration = simulation.calibration();
    let estimate_fields_of = |error_estimate: &Estimate| (error_estimate.value, error_estimate.interval);
    let estimate_of = |error: SystematicError| {
        calibration.systematic_stds[error as usize].map(|_| calibration.systematic.get(error))
    };
    let interval_of = |error: SystematicError| calibration.interval_of(error);
    let is_constant_and_corrected = |error_kinds: &[SystematicError]| {
        let [is_error_constant, is_error_corrected] = [calibration.is_constant, calibration.is_corrected]
            .map(|error_flags| error_kinds.iter().any(|error_kind| error_flags[*error_kind as usize]));
        (is_error_constant, is_error_corrected)
    };
    let error_fields = |error| (estimate_of(error), interval_of(error), is_constant_and_corrected(&[error]));
    let lever_arm = [SystematicError::LeverArmAhead, SystematicError::LeverArmLeft];
    let systematic_errors = (
        // The length of JavaScript's list of errors is encoded first. The lever arm is a single error with two coordinates.
        5usize,
        error_fields(SystematicError::ClockOffset),
        error_fields(SystematicError::MountYaw),
        (lever_arm.map(estimate_of), lever_arm.map(interval_of), is_constant_and_corrected(&lever_arm)),
        error_fields(SystematicError::DistanceScale),
        error_fields(SystematicError::TurnScale),
    );
    let reference_noise = calibration.reference_noise.each_ref().map(estimate_fields_of);
    let check_fields: Vec<_> = calibration
        .diagnostics
        .checks
        .iter()
        .map(|diagnostic_check| (diagnostic_check.value, diagnostic_check.expected, diagnostic_check.passed))
        .collect();
    let window_fields: Vec<_> = calibration
        .diagnostics
        .windows
        .iter()
        .map(|leg_window| (leg_window.length, leg_window.count, leg_window.coverage, leg_window.nees))
        .collect();
    let recommendation_fields = calibration
        .recommended
        .as_ref()
        .map(|recommended_alphas| (recommended_alphas.alphas.clone(), recommended_alphas.inflation));
    let truth_fields = simulation.truth().map(|simulated_truth| {
        let first_fields = (simulated_truth.alphas, simulated_truth.clock_offset, simulated_truth.mount_yaw);
        (first_fields, simulated_truth.lever_arm, simulated_truth.distance_scale, simulated_truth.turn_scale)
    });
    let persistence_fields =
        (estimate_fields_of(&calibration.persistence.correlation), calibration.persistence.length);
    vec![
        HashedPart::new(
            "alphas",
            (calibration.alphas.clone(), calibration.intervals.clone(), calibration.log_likelihood),
        ),
        HashedPart::new("systematic", systematic_errors),
        HashedPart::new("noise", (reference_noise, persistence_fields)),
        HashedPart::new("diagnostics", (check_fields, window_fields, recommendation_fields)),
        HashedPart::new("truth", truth_fields),
    ]
}

fn coordinates_of(pose: SE2) -> [f64; 3] {
    [pose.x(), pose.y(), pose.theta()]
}

fn flatten<T: Copy, const N: usize>(row_arrays: &[[T; N]]) -> Vec<T> {
    row_arrays.as_flattened().to_vec()
}

fn read_floor_plan(plan_json: &Value) -> FloorPlan {
    let walls = plan_json["walls"].as_array().expect("walls").iter().map(|wall| {
        let [start_x, start_y, end_x, end_y] = to_numbers(wall);
        Segment { from: [start_x, start_y], to: [end_x, end_y] }
    });
    FloorPlan::new(walls.collect(), to_numbers(&plan_json["bounds"])).expect("a valid plan")
}

fn read_grid(map_json: &Value, images_json: &Value) -> OccupancyGrid {
    let image_lines = images_json[map_json["image"].as_str().expect("a name")].as_array().expect("lines");
    let image_text: String =
        image_lines.iter().map(|image_line| format!("{}\n", image_line.as_str().expect("a line"))).collect();
    let description = &map_json["description"];
    let [x, y, yaw] = to_numbers(&description["origin"]);
    let pixel_classifier = PixelClassifier {
        mode: match description["mode"].as_str() {
            None | Some("trinary") => MapMode::Trinary,
            Some("scale") => MapMode::Scale,
            Some("raw") => MapMode::Raw,
            Some(unknown_mode) => panic!("{unknown_mode} is no mode"),
        },
        negate: to_number(&description["negate"]) == 1.0,
        occupied_thresh: to_number(&description["occupied_thresh"]),
        free_thresh: to_number(&description["free_thresh"]),
    };
    let image = read_pgm(image_text.as_bytes()).expect("a PGM file");
    OccupancyGrid::new(&image, &pixel_classifier, to_number(&description["resolution"]), SE2::new(x, y, yaw))
}
