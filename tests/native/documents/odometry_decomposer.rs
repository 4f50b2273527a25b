//! Comparison of the numbers in the page's text about the Odometry Decomposer, and in doc/model.md, with computed numbers.

use super::{read_model_document, read_page_text};
use crate::common::settings_of_preset;
use crate::simulations::odometry_decomposer::new_simulation;
use motion::models::OdometryRule::{self, Beluga, Nav2, Omni, Table};
use motion::sim::odometry_decomposer::{RuleNoise, Settings};

fn find_rule_noise(settings: Settings, rule: OdometryRule) -> RuleNoise {
    new_simulation(settings).rule_noises().into_iter().find(|noise| noise.rule == rule).expect("all rules")
}

#[test]
fn the_lateral_deviation_grows_faster_than_the_drive() {
    // The page states the exact standard deviation of the lateral end position, which is not the product of lever arm and angle.
    let [printed_rot1_std, printed_lateral_std, printed_growth] = read_page_text().sentence_numbers(
        "the noise of the first rotation: ± # rad at the start are ± # m across at the end. Twice as far it is # times as much",
    );
    let settings = settings_of_preset("all");
    let leg_stats = new_simulation(settings).stats();
    printed_rot1_std.assert_near(find_rule_noise(settings, Table).deviations[0], 0.0);
    printed_lateral_std.assert_near(leg_stats.exact_cross_track, 0.0);
    let [x, y, final_heading] = settings.to;
    let long_drive_settings = Settings { to: [2.0 * x, 2.0 * y, final_heading], ..settings };
    printed_growth.assert_near(
        new_simulation(long_drive_settings).stats().exact_cross_track / leg_stats.exact_cross_track,
        0.0,
    );
}

#[test]
fn only_the_table_adds_noise_of_two_half_turns_in_reverse() {
    let [printed_table_std, printed_localizer_std] = read_page_text().sentence_numbers(
        "adds ± # rad and more; the localizers AMCL of Nav2 and Beluga add ± # for either.",
    );
    let leg_stds_of = |rule| find_rule_noise(settings_of_preset("reverse"), rule).deviations;
    let [rot1_std, _, rot2_std, _] = leg_stds_of(Table);
    printed_table_std.assert_near(rot1_std, 0.0);
    assert!(rot2_std > rot1_std);
    for rule in [Nav2, Beluga] {
        let [rot1_std, _, rot2_std, _] = leg_stds_of(rule);
        printed_localizer_std.assert_near(rot1_std, 0.0);
        printed_localizer_std.assert_near(rot2_std, 0.0);
    }
}

#[test]
fn the_correlation_of_both_rotations_changes_the_heading_deviation_from_difference_to_sum() {
    let [printed_min_std, printed_max_std] = read_page_text().sentence_numbers(
        "No outcome moves, and the standard deviation of the heading goes from # to # rad.",
    );
    let simulate_correlation = |leg_correlation| {
        new_simulation(Settings { correlation: leg_correlation, ..settings_of_preset("all") })
    };
    printed_min_std.assert_near(simulate_correlation(-1.0).stats().exact_heading, 0.0);
    printed_max_std.assert_near(simulate_correlation(1.0).stats().exact_heading, 0.0);
    for (a, b) in simulate_correlation(-1.0).poses().iter().zip(simulate_correlation(1.0).poses()) {
        assert_eq!((a.x(), a.y()), (b.x(), b.y()));
    }
}

#[test]
fn the_deviations_of_the_rules_are_those_in_the_document() {
    let preset_row_names = [("reverse", "reverse"), ("spin", "spin"), ("rest", "at rest")];
    let rule_column_names = [(Table, "Table 5.6"), (Nav2, "Nav2, Beluga"), (Omni, "omnidirectional")];
    for ((preset_name, row_name), (rule, rule_name)) in
        preset_row_names.into_iter().flat_map(|preset_name| rule_column_names.map(|rule| (preset_name, rule)))
    {
        let leg_stds = find_rule_noise(settings_of_preset(preset_name), rule).deviations;
        read_model_document()
            .assert_numbers(&format!("| {row_name} | {rule_name} | # | # | # | # |"), leg_stds);
        if rule == Nav2 {
            assert_eq!(find_rule_noise(settings_of_preset(preset_name), Beluga).deviations, leg_stds);
        }
    }
}

#[test]
fn table_5_6_adds_heading_noise_to_encoders_at_rest() {
    let [printed_heading_std] = read_page_text()
        .sentence_numbers("the heading of a robot that has not moved is uncertain by ± # rad,");
    read_page_text().assert_contains("The encoders have jittered by half a centimetre.");
    let [x, y, _] = settings_of_preset::<Settings>("rest").to;
    assert_eq!((1000.0 * x.hypot(y)).round(), 5.0);
    let leg_stats = new_simulation(settings_of_preset("rest")).stats();
    printed_heading_std.assert_near(leg_stats.exact_heading, 0.0);
}
