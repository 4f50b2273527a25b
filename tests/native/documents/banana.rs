//! Comparison of the numbers about the Banana Machine, in the page's text and in doc/statistics.md, with computed numbers.

use super::read_page_text;
use crate::common::text::{PlainText, PrintedNumber};
use crate::common::{MAX_STANDARD_ERRORS, is_point_inside, settings_of_preset};
use crate::simulations::banana::new_simulation;
use motion::VelocityCmd;
use motion::sim::banana::{BananaMachine, ModelKind, Settings};

fn read_statistics_document() -> PlainText {
    PlainText::from_document(include_str!("../../../doc/statistics.md"))
}

#[test]
fn presets_equal_those_printed_in_the_document() {
    for (preset_name, printed_label) in [
        ("straight", "Straight"),
        ("gentle", "Gentle arc"),
        ("hard", "Hard arc"),
        ("pivot", "Pivot"),
        ("banana", "Banana"),
        ("worked", "Worked example"),
    ] {
        let printed_numbers: [PrintedNumber; 9] = read_statistics_document()
            .sentence_numbers(&format!("| {printed_label} | #, #, # | #, #, #, #, #, # |"));
        let Settings { command: preset_command, velocity_alphas: [a1, a2, a3, a4, a5, a6], .. } =
            settings_of_preset(preset_name);
        assert_eq!(
            printed_numbers.map(|printed_number| printed_number.value),
            [preset_command.v, preset_command.omega, preset_command.dt, a1, a2, a3, a4, a5, a6],
            "{preset_name}"
        );
    }
}

#[test]
fn numbers_in_the_table_and_on_the_page_are_those_of_the_simulation() {
    const ROBOT_COUNT: usize = 300_000;
    let coverage_error = MAX_STANDARD_ERRORS * (0.117 / ROBOT_COUNT as f64).sqrt();
    let simulate_preset =
        |preset_name| new_simulation(Settings { samples: ROBOT_COUNT, ..settings_of_preset(preset_name) });
    let assert_row = |banana_machine: &BananaMachine, printed_row: [PrintedNumber; 4]| {
        let [printed_floor_gain, printed_area_ratio, printed_ellipse_percentage, printed_skew] = printed_row;
        let exact_column = banana_machine.table().exact;
        printed_floor_gain.assert_near(exact_column.likelihood_gain.floor, 0.0);
        printed_area_ratio.assert_near(exact_column.area_ratio, 0.0);
        printed_ellipse_percentage.assert_percent(banana_machine.stats().coverage.ellipse, coverage_error);
        printed_skew.assert_near(exact_column.cross_track_skew, 1e-12);
        exact_column
    };
    let worked_example_row = read_statistics_document()
        .sentence_numbers("| 1, 0.5, 1; α₁₋₄ = 0.02, α₅,₆ = 0 | ∞ | # | # | # % | # |");
    assert_row(&simulate_preset("worked"), worked_example_row);
    let [(gentle_exact, _), (hard_exact, hard_simulation), (banana_exact, _)] = [
        ("gentle", "| 1, 0.5, 1; (0.05, 0.05, 0.05, 0.09, 0.01, 0.01)"),
        ("hard", "| 1, 1.2, 1.4; the same"),
        ("banana", "| 1, 0, 2; (0.002, 0.002, 0.1, 0.1, 0.002, 0.002)"),
    ]
    .map(|(preset_name, row_start)| {
        let [printed_pose_gain, printed_row @ ..]: [PrintedNumber; 5] =
            read_statistics_document().sentence_numbers(&format!("{row_start} | # | # | # | # % | # |"));
        let banana_machine = simulate_preset(preset_name);
        let exact_column = assert_row(&banana_machine, printed_row);
        printed_pose_gain.assert_near(exact_column.likelihood_gain.pose, 0.0);
        (exact_column, banana_machine)
    });
    let [printed_ellipse_percentage, printed_outline_percentage, printed_skew, printed_gaussian_skew] = read_page_text().sentence_numbers(
        "do not give the ellipse away, # % and # %. The cross-track skew, the lopsidedness across the path, does: #, \
         where any Gaussian in (x, y) has #, and so has the banana.",
    );
    printed_ellipse_percentage.assert_percent(hard_simulation.stats().coverage.ellipse, coverage_error);
    printed_outline_percentage.assert_percent(hard_simulation.stats().coverage.exponential, coverage_error);
    printed_skew.assert_near(hard_exact.cross_track_skew, 0.0);
    printed_gaussian_skew.assert_near(hard_simulation.table().linearized.cross_track_skew, 0.0);
    assert!(banana_exact.cross_track_skew.abs() < 1e-9);
    let [banana_gain, gentle_gain, hard_gain] =
        [&banana_exact, &gentle_exact, &hard_exact].map(|exact_column| exact_column.likelihood_gain.pose);
    read_page_text().assert_numbers(
        "The ellipse covers # times the floor of the green outline: where it alone lies, robots stop a seventh as \
         densely as where the outline alone does. The Gaussian in ξ fits better: a log-likelihood gain of # nats a robot \
         (# nat: e times as likely); on the gentle arc it is #, on the hard one #.",
        [banana_exact.area_ratio, banana_gain, 1.0, gentle_gain, hard_gain],
    );
    assert_eq!(Settings::default(), settings_of_preset("banana"));
    let opening_simulation = new_simulation(Settings::default());
    read_statistics_document().assert_numbers(
        "α₁₋₄ = 0.02, α₅,₆ = 0: skew #; the Gentle arc's α = (0.05, 0.05, 0.05, 0.09, 0.01, 0.01): #.",
        [new_simulation(settings_of_preset("worked")), new_simulation(settings_of_preset("gentle"))]
            .map(|banana_machine| banana_machine.exact_moments().cross_track_skew),
    );
    read_statistics_document().assert_numbers(
        "The widget opens with # robots. They give the skew of the Banana to ±#.",
        [opening_simulation.settings().samples as f64, opening_simulation.stats().cross_track_skew_error],
    );
}

/// Densities in the areas that only one of the two outlines encloses have relative errors of 2 % with these 300,000 robots.
#[test]
fn the_ellipse_covers_floor_where_few_robots_stop() {
    read_page_text().assert_contains(
        "where it alone lies, robots stop a seventh as densely as where the outline alone does.",
    );
    let banana_machine = new_simulation(Settings { samples: 300_000, ..settings_of_preset("banana") });
    let contour_outlines = banana_machine.contours();
    let is_inside_outlines = |floor_point| {
        [&contour_outlines.ellipse, &contour_outlines.exponential]
            .map(|contour_outline| is_point_inside(contour_outline, floor_point))
    };
    const CELL_SIZE: f64 = 0.02;
    let cell_indices =
        (0..250).flat_map(|column_index| (0..250).map(move |row_index| (column_index, row_index)));
    let cell_flags: Vec<[bool; 2]> = cell_indices
        .map(|(column_index, row_index)| {
            is_inside_outlines([f64::from(column_index) * CELL_SIZE, f64::from(row_index) * CELL_SIZE - 2.5])
        })
        .collect();
    let robot_flags: Vec<[bool; 2]> =
        banana_machine.poses().map(|pose| is_inside_outlines([pose.x(), pose.y()])).collect();
    let robot_density_in = |inside_outlines: [bool; 2]| {
        let count_points = |inside_flags: &[[bool; 2]]| {
            inside_flags.iter().filter(|flags| **flags == inside_outlines).count() as f64
        };
        count_points(&robot_flags) / (count_points(&cell_flags) * CELL_SIZE * CELL_SIZE)
    };
    let density_ratio = robot_density_in([false, true]) / robot_density_in([true, false]);
    assert_eq!(density_ratio.round(), 7.0, "{density_ratio}");
}

#[test]
fn a_tenth_of_the_time_shrinks_the_cloud_to_less_than_a_tenth() {
    read_page_text().assert_contains(
        "In a tenth of the time the cloud shrinks to less than a tenth, and the circle stays:",
    );
    let long_drive_settings: Settings = settings_of_preset("gentle");
    let short_drive_settings = Settings {
        command: VelocityCmd { dt: long_drive_settings.command.dt / 10.0, ..long_drive_settings.command },
        ..long_drive_settings
    };
    let [long_drive_simulation, short_drive_simulation] = [long_drive_settings, short_drive_settings]
        .map(|drive_settings| new_simulation(Settings { samples: 10, ..drive_settings }));
    let position_std_of = |banana_machine: &BananaMachine| {
        let exact_cov = banana_machine.table().exact.cov;
        (exact_cov[(0, 0)] + exact_cov[(1, 1)]).sqrt()
    };
    assert!(
        position_std_of(&short_drive_simulation) < 0.1 * position_std_of(&long_drive_simulation),
        "{} {}",
        position_std_of(&short_drive_simulation),
        position_std_of(&long_drive_simulation)
    );
}

#[test]
fn the_predicted_skew_is_wrong_under_the_odometry_model() {
    let [robot_count, min_standard_errors] = read_page_text()
        .sentence_numbers("and the prediction misses: with # robots by more than # standard errors.");
    let settings = Settings { samples: robot_count.value as usize, ..settings_of_preset("gentle") };
    let mut velocity_alphas = settings.velocity_alphas;
    velocity_alphas[4..].fill(0.0);
    let skew_miss_of = |settings| {
        let banana_machine = new_simulation(settings);
        let cloud_stats = banana_machine.stats();
        (cloud_stats.cross_track_skew - cloud_stats.gaussian_skew).abs() / cloud_stats.cross_track_skew_error
    };
    assert!(skew_miss_of(Settings { velocity_alphas, ..settings }) < MAX_STANDARD_ERRORS);
    assert!(skew_miss_of(Settings { model: ModelKind::Odometry, ..settings }) > min_standard_errors.value);
}

#[test]
fn a_hundred_times_the_robots_reduce_the_error_to_a_tenth() {
    read_page_text().assert_contains("A hundred times the robots leave a tenth of the standard error.");
    let skew_error_of = |sample_count| {
        new_simulation(Settings { samples: sample_count, ..settings_of_preset("gentle") })
            .stats()
            .cross_track_skew_error
    };
    let error_ratio = skew_error_of(2000) / skew_error_of(200_000);
    assert!((error_ratio - 10.0).abs() < 1.0, "{error_ratio}");
}
