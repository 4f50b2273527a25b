//! Comparison of the fractions that the page's text and doc/model.md state for Map Squeeze with computed fractions.

use super::{read_model_document, read_page_text};
use crate::common::text::PrintedNumber;
use crate::common::{MAX_STANDARD_ERRORS, seeded_rng};
use motion::geom::arc::Arc;
use motion::geom::se2::SE2;
use motion::map::{FloorPlan, MapConditioned, Sampler};
use motion::noise::draw_centred_uniform;
use motion::sim::settings::SettingRules;
use motion::sim::squeeze::{MapSqueeze, Settings, alphas_of_noise_level};
use motion::{NoiseKind, VelocityAlphas, VelocityCmd, VelocityModel};

/// Indices in `PRESETS` of the starts at the doorway, at the wall and in the corridor.
const DOORWAY_PRESET: usize = 0;
const WALL_PRESET: usize = 1;
const CORRIDOR_PRESET: usize = 2;

fn new_settings(preset_index: usize, map_sampler: Sampler, omega: f64) -> Settings {
    let turned_command = VelocityCmd { omega, ..Settings::default().command };
    let part_count = map_sampler.part_count();
    let sample_count = 100_000.min(800_000 / part_count as usize);
    Settings {
        start: Settings::PRESETS[preset_index].1.start,
        sampler: map_sampler,
        steps: part_count,
        command: turned_command,
        samples: sample_count,
        seed: 3,
        ..Settings::default()
    }
}

fn new_simulation(settings: Settings) -> MapSqueeze {
    MapSqueeze::new(settings).expect("valid settings")
}

fn fraction_through_wall_of(settings: Settings) -> (f64, f64) {
    let simulation = new_simulation(settings);
    assert!(!simulation.stats().gave_up, "{settings:?}");
    let (fraction, accepted_count) =
        (simulation.stats().through_wall_rate, simulation.stats().accepted as f64);
    // A fraction of 0 would have a standard error of 0. The standard error of a single sample through the wall is used instead.
    (fraction, ((fraction * (1.0 - fraction)).max(1.0 / accepted_count) / accepted_count).sqrt())
}

fn fraction_in_parts(preset_index: usize, part_count: u32, omega: f64) -> (f64, f64) {
    fraction_through_wall_of(new_settings(preset_index, Sampler::SubStepped(part_count), omega))
}

fn assert_printed_percentage((fraction, standard_error): (f64, f64), printed_percentage: PrintedNumber) {
    printed_percentage.assert_percent(fraction, MAX_STANDARD_ERRORS * standard_error);
}

/// Asserts that `smaller_fraction` is less than `larger_fraction` by more than [`MAX_STANDARD_ERRORS`] of their difference.
fn assert_smaller_fraction(smaller_fraction: (f64, f64), larger_fraction: (f64, f64), case_name: &str) {
    assert!(
        larger_fraction.0 - smaller_fraction.0
            > MAX_STANDARD_ERRORS * smaller_fraction.1.hypot(larger_fraction.1),
        "{case_name}: {smaller_fraction:?} is not less than {larger_fraction:?}"
    );
}

#[test]
fn most_accepted_samples_lie_behind_the_wall() {
    let [printed_fraction] = read_page_text().sentence_numbers(
        "Drive at a wall # % of what is accepted went through a wall, where the robot could never have gone. Test the \
         whole arc, and only what stopped short of the wall is left.",
    );
    assert_printed_percentage(
        fraction_through_wall_of(new_settings(WALL_PRESET, Sampler::Endpoint, 0.0)),
        printed_fraction,
    );
    let fraction_behind_wall = |map_sampler| {
        let simulation = new_simulation(new_settings(WALL_PRESET, map_sampler, 0.0));
        let accepted_ys: Vec<f64> =
            simulation.attempts().iter().filter(|a| a.accepted).map(|a| a.pose.y()).collect();
        // The wall ahead is at y = 3.8. Robots that turn aside count as in front of it.
        accepted_ys.iter().filter(|y| **y > 3.8).count() as f64 / accepted_ys.len() as f64
    };
    assert!(fraction_behind_wall(Sampler::Endpoint) > 0.8);
    assert_eq!(fraction_behind_wall(Sampler::WholeArc), 0.0);
}

#[test]
fn a_third_of_the_accepted_motions_went_through_a_wall_at_the_doorway() {
    let [printed_noise_level, printed_fraction] = read_page_text().sentence_numbers(
        "straight ahead at noise level #, # % of the accepted motions went through a wall.",
    );
    assert_eq!(Settings::default().alphas, alphas_of_noise_level(printed_noise_level.value));
    assert_printed_percentage(
        fraction_through_wall_of(new_settings(DOORWAY_PRESET, Sampler::Endpoint, 0.0)),
        printed_fraction,
    );
}

#[test]
#[ignore = "nightly: 30 clouds of 100,000"]
fn fractions_through_walls_by_substeps_are_those_in_the_documents() {
    let printed_fractions = read_model_document().sentence_numbers(
        "On a straight command it falls with k: to # % at k = 16 facing the doorway, and to # % in the corridor.",
    );
    for (preset_index, printed_fraction) in
        [DOORWAY_PRESET, CORRIDOR_PRESET].into_iter().zip::<[PrintedNumber; 2]>(printed_fractions)
    {
        assert_printed_percentage(fraction_in_parts(preset_index, 16, 0.0), printed_fraction);
        assert!(fraction_in_parts(preset_index, 64, 0.0).0 < 1e-3, "nearly nothing at the end of the slider");
    }
    let [printed_omega, printed_endpoint_percentage, printed_parts_percentage, printed_part_count] = read_page_text().sentence_numbers(
        "With ω = # more pass at first, from # % by the endpoint test to # % in # parts, and only then fewer.",
    );
    assert_printed_percentage(
        fraction_through_wall_of(new_settings(DOORWAY_PRESET, Sampler::Endpoint, printed_omega.value)),
        printed_endpoint_percentage,
    );
    assert_printed_percentage(
        fraction_in_parts(DOORWAY_PRESET, printed_part_count.value as u32, printed_omega.value),
        printed_parts_percentage,
    );
    let printed_numbers: [_; 10] = read_model_document().sentence_numbers(
        "At the doorway it is # % at k = 1, # % at 4, # % at 6, # % at 8, and # % at 16. In the corridor it rises from # % \
         over # and # % to # % at k = 8, and falls to # % at 12.",
    );
    let (doorway_percentages, corridor_percentages) = printed_numbers.split_at(5);
    for (preset_index, part_counts, printed_percentages) in [
        (DOORWAY_PRESET, [4, 6, 8, 16], doorway_percentages),
        (CORRIDOR_PRESET, [4, 6, 8, 12], corridor_percentages),
    ] {
        assert_printed_percentage(
            fraction_through_wall_of(new_settings(preset_index, Sampler::Endpoint, printed_omega.value)),
            printed_percentages[0],
        );
        for (part_count, &printed_percentage) in part_counts.into_iter().zip(&printed_percentages[1..]) {
            assert_printed_percentage(
                fraction_in_parts(preset_index, part_count, printed_omega.value),
                printed_percentage,
            );
        }
    }
}

#[test]
#[ignore = "nightly: clouds of 100,000"]
fn more_substeps_facing_the_wall_send_more_samples_through_it() {
    let through_wall_fractions = [2, 4, 8].map(|part_count| fraction_in_parts(WALL_PRESET, part_count, 0.0));
    through_wall_fractions
        .windows(2)
        .for_each(|fraction_pair| assert_smaller_fraction(fraction_pair[0], fraction_pair[1], "more parts"));
    let [printed_with_endpoint, printed_with_2_parts, printed_with_4_parts, printed_with_8_parts, printed_wedged_parts] = read_model_document().sentence_numbers(
        "it rises from # % at k = 1 to # %, # % and # % at k = 2, 4 and 8. From k = # on, so few parts reach across that \
         the widget gives up.",
    );
    assert_printed_percentage(
        fraction_through_wall_of(new_settings(WALL_PRESET, Sampler::Endpoint, 0.0)),
        printed_with_endpoint,
    );
    through_wall_fractions
        .into_iter()
        .zip([printed_with_2_parts, printed_with_4_parts, printed_with_8_parts])
        .for_each(|(fraction, printed_percentage)| assert_printed_percentage(fraction, printed_percentage));
    let [printed_first_parts, printed_last_parts, printed_first_fraction, printed_last_fraction] =
        read_page_text()
            .sentence_numbers("go from # parts to #. The share through the wall rises, from # % to # %:");
    assert_eq!((printed_first_parts.value, printed_last_parts.value), (2.0, 8.0));
    assert_printed_percentage(through_wall_fractions[0], printed_first_fraction);
    assert_printed_percentage(through_wall_fractions[2], printed_last_fraction);
    read_page_text().assert_contains(
        "From 16 parts on hardly one is long enough to jump, and the robot stands wedged before the wall.",
    );
    assert_eq!(printed_wedged_parts.value, 16.0);
    assert!(!new_simulation(new_settings(WALL_PRESET, Sampler::SubStepped(12), 0.0)).stats().gave_up);
    for part_count in [16, 24, 32, 64] {
        for sample_count in [600, 10_000] {
            let settings = Settings {
                samples: sample_count,
                ..new_settings(WALL_PRESET, Sampler::SubStepped(part_count), 0.0)
            };
            assert!(new_simulation(settings).stats().gave_up, "{part_count} parts");
        }
    }
}

#[test]
#[ignore = "nightly: clouds of 100,000"]
fn testing_the_geodesic_changes_the_documented_fraction_of_verdicts() {
    let [min_percent, max_percent, doorway_min_percentage, doorway_max_percentage] = read_model_document().sentence_numbers(
        "between # and # % of the accepted samples get the other verdict (n from 0.12 to 0.2, ω from 0 to 1; the doorway \
         # to # %)",
    );
    assert_eq!(max_percent.value, doorway_max_percentage.value);
    let floor_plan = FloorPlan::apartment();
    for &(preset_name, Settings { start: [x, y, theta], .. }) in Settings::PRESETS {
        let start_pose = SE2::new(x, y, theta);
        for (n, omega) in [(0.12, 0.0), (0.12, 0.5), (0.12, 1.0), (0.2, 0.0), (0.2, 0.5), (0.2, 1.0)] {
            let model =
                VelocityModel { alphas: VelocityAlphas(alphas_of_noise_level(n)), noise: NoiseKind::Normal };
            let conditioned_model =
                MapConditioned { model, plan: &floor_plan, clearance: 0.13, sampler: Sampler::Endpoint };
            let turned_command = VelocityCmd { v: 1.0, omega, dt: 2.0 };
            let collision_tester = conditioned_model.collision_tester(&turned_command, &start_pose);
            let mut rng = seeded_rng(93);
            let (mut accepted_count, mut differing_count) = (0u32, 0u32);
            for _ in 0..40_000 {
                let unit_noise =
                    std::array::from_fn(|_| NoiseKind::Normal.quantile(draw_centred_uniform(&mut rng)));
                let tested_draw = collision_tester.test_draw(unit_noise);
                if !tested_draw.end_verdict.is_free {
                    continue;
                }
                // The geodesic exp(s·ξ), 0 ≤ s ≤ 1, is also an arc. It starts in the direction of (ξ along, ξ lateral).
                let xi = tested_draw.pose.boxminus(&start_pose);
                let geodesic_start = SE2::new(x, y, theta + xi.y.atan2(xi.x));
                let geodesic_arc = Arc { start: geodesic_start, length: xi.xy().norm(), turn: xi.z };
                accepted_count += 1;
                differing_count += u32::from(
                    floor_plan.test_arc(&geodesic_arc, 0.13).is_free != tested_draw.path_verdict.is_free,
                );
            }
            let differing_fraction = f64::from(differing_count) / f64::from(accepted_count);
            let tolerance = MAX_STANDARD_ERRORS
                * (differing_fraction * (1.0 - differing_fraction) / f64::from(accepted_count)).sqrt();
            let min_percent = if preset_name == "doorway" { doorway_min_percentage } else { min_percent };
            let (min_percent, max_percent) = (min_percent.value / 100.0, max_percent.value / 100.0);
            assert!(
                differing_fraction + tolerance > min_percent && differing_fraction - tolerance < max_percent,
                "{preset_name}, n = {n}, ω = {omega}: {differing_fraction}"
            );
        }
    }
}
