//! Numbers of the Odometry Decomposer on the page and of the rules in doc/model.md, compared with computed ones.

use super::{model_document, page};
use crate::simulations::odometry_decomposer::{settings_of_preset, simulation};
use motion::models::OdometryRule::{self, Beluga, Nav2, Omni, Table};
use motion::sim::odometry_decomposer::{OdometryPose, RuleNoise, Settings};

fn noise_of(settings: Settings, rule: OdometryRule) -> RuleNoise {
    simulation(settings).rule_noises().into_iter().find(|noise| noise.rule == rule).expect("all rules")
}

#[test]
fn the_lever_grows_faster_than_the_drive() {
    // The page states the exact standard deviation at the end, not lever arm times angle.
    let [deviation, lateral, growth] = page().numbers(
        "the noise of the first rotation: ± # rad at the start are ± # m across at the end. Twice as far it is # times as much",
    );
    let settings = settings_of_preset("all");
    let stats = simulation(settings).stats();
    deviation.assert(noise_of(settings, Table).deviations[0], 0.0);
    lateral.assert(stats.exact_cross_track, 0.0);
    let OdometryPose([x, y, theta]) = settings.to;
    let long_drive = Settings { to: OdometryPose([2.0 * x, 2.0 * y, theta]), ..settings };
    growth.assert(simulation(long_drive).stats().exact_cross_track / stats.exact_cross_track, 0.0);
}

#[test]
fn only_the_table_adds_noise_of_two_half_turns_in_reverse() {
    let [of_table, of_localizers] =
        page().numbers("adds ± # rad and more; the localizers AMCL of Nav2 and Beluga add ± # for either.");
    let deviations_of = |rule| noise_of(settings_of_preset("reverse"), rule).deviations;
    let [rot1_deviation, _, rot2_deviation, _] = deviations_of(Table);
    of_table.assert(rot1_deviation, 0.0);
    assert!(rot2_deviation > rot1_deviation);
    for rule in [Nav2, Beluga] {
        let [rot1_deviation, _, rot2_deviation, _] = deviations_of(rule);
        of_localizers.assert(rot1_deviation, 0.0);
        of_localizers.assert(rot2_deviation, 0.0);
    }
}

#[test]
fn correlation_changes_the_heading_deviation_from_difference_to_sum() {
    let [min_deviation, max_deviation] =
        page().numbers("No outcome moves, and the standard deviation of the heading goes from # to # rad.");
    let simulation_with = |correlation| simulation(Settings { correlation, ..settings_of_preset("all") });
    min_deviation.assert(simulation_with(-1.0).stats().exact_heading, 0.0);
    max_deviation.assert(simulation_with(1.0).stats().exact_heading, 0.0);
    for (a, b) in simulation_with(-1.0).poses().iter().zip(simulation_with(1.0).poses()) {
        assert_eq!((a.x(), a.y()), (b.x(), b.y()));
    }
}

/// Table of doc/model.md: standard deviations of the first rotation, the drive and the second rotation of its three
/// readings.
#[test]
fn the_variances_of_the_rules_are_those_in_the_document() {
    let presets = [("reverse", "reverse"), ("spin", "spin"), ("rest", "at rest")];
    let rules = [(Table, "Table 5.6"), (Nav2, "Nav2, Beluga"), (Omni, "omnidirectional")];
    for ((preset, row_name), (rule, name)) in
        presets.into_iter().flat_map(|preset| rules.map(|rule| (preset, rule)))
    {
        let deviations = noise_of(settings_of_preset(preset), rule).deviations;
        model_document().assert(&format!("| {row_name} | {name} | # | # | # | # |"), deviations);
        if rule == Nav2 {
            assert_eq!(noise_of(settings_of_preset(preset), Beluga).deviations, deviations);
        }
    }
}

#[test]
fn encoders_at_rest_are_noisy_by_the_table_alone() {
    let [heading] = page().numbers("the heading of a robot that has not moved is uncertain by ± # rad,");
    page().assert_says("The encoders have jittered by half a centimetre.");
    let at_rest = settings_of_preset("rest");
    assert_eq!((1000.0 * at_rest.to.0[0].hypot(at_rest.to.0[1])).round(), 5.0);
    let stats = simulation(at_rest).stats();
    heading.assert(stats.exact_heading, 0.0);
}
