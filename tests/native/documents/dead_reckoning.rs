//! Comparison of the numbers in the page's text about Dead Reckoning with numbers that its simulation computes.

use super::{read_exercises, read_page_text};
use crate::common::text::PrintedNumber;
use crate::common::{MAX_STANDARD_ERRORS, settings_of_preset};
use crate::simulations::dead_reckoning::new_simulation;
use motion::Compounding;
use motion::sim::dead_reckoning::{DeadReckoning, MISS_TOLERANCE, Settings};

fn simulation_of_preset(preset_name: &str) -> DeadReckoning {
    new_simulation(settings_of_preset(preset_name))
}

/// Returns the predicted variances of an axis after each step, divided by those of the fourth order, which are accurate to a few
/// thousandths.
fn divide_by_fourth_order(simulation: &DeadReckoning, recursion: Compounding, axis_index: usize) -> Vec<f64> {
    let predicted_variances_by = |recursion| {
        simulation
            .predicted_covariances(recursion)
            .iter()
            .map(move |cov_or_none| cov_or_none.expect("a covariance")[(axis_index, axis_index)])
    };
    predicted_variances_by(recursion)
        .zip(predicted_variances_by(Compounding::FourthOrder))
        .map(|(predicted_variance, fourth_order_variance)| predicted_variance / fourth_order_variance)
        .collect()
}

fn missed_steps_of(variance_ratios: &[f64]) -> Vec<usize> {
    (1..=variance_ratios.len()).filter(|k| (variance_ratios[k - 1] - 1.0).abs() > MISS_TOLERANCE).collect()
}

#[test]
fn printed_variance_errors_of_the_recursion_equal_those_of_the_simulation() {
    let initial_simulation = new_simulation(Settings::default());
    let [printed_percentage]: [PrintedNumber; 1] = read_page_text()
        .sentence_numbers("what its own loses by the end: # % of the variance along the track");
    let chapter_comparison = initial_simulation.comparison(Compounding::Chapter);
    printed_percentage.assert_percent(-chapter_comparison.misses[0].end, 0.0);
    printed_percentage
        .assert_percent(1.0 - divide_by_fourth_order(&initial_simulation, Compounding::Chapter, 0)[19], 0.0);
    let [printed_along_loss, printed_lateral_loss]: [PrintedNumber; 2] = read_page_text().sentence_numbers(
        "After the chapter’s 20 steps the variance along the track is # % below that of 50\u{202f}000 robots. Across the track \
         it is 0 after step 1, and # % too small at the end.",
    );
    for (printed_percentage, axis_index) in [(printed_along_loss, 0), (printed_lateral_loss, 1)] {
        printed_percentage.assert_percent(-chapter_comparison.misses[axis_index].end, 0.0);
        printed_percentage.assert_percent(
            1.0 - divide_by_fourth_order(&initial_simulation, Compounding::Chapter, axis_index)[19],
            0.0,
        );
    }
    read_page_text().assert_contains("The Gaussian that the chapter predicts is a line, for its R, the noise covariance of one step, has no lateral noise");
    assert_eq!(chapter_comparison.ratios[0].y, 0.0);
    assert!(initial_simulation.measured_moments()[0].cov[(1, 1)] > 0.0);
    let [printed_ratio_at_2, printed_ratio_at_5]: [PrintedNumber; 2] =
        read_page_text().sentence_numbers("At step 2 it predicts # of the lateral variance, at step 5 #.");
    for lateral_variance_ratios in [
        divide_by_fourth_order(&initial_simulation, Compounding::Chapter, 1),
        chapter_comparison.ratios.iter().map(|axis_ratios| axis_ratios.y).collect(),
    ] {
        printed_ratio_at_2.assert_near(lateral_variance_ratios[1], 0.0);
        printed_ratio_at_5.assert_near(lateral_variance_ratios[4], 0.0);
    }
    read_page_text().assert_contains(
        "With the right Jacobian Jr, the turn during a step, every ratio is 1 to a hundredth, and fourth order looks the same.",
    );
    for recursion in [Compounding::FirstOrder, Compounding::FourthOrder] {
        for variance_ratio in &initial_simulation.comparison(recursion).ratios {
            assert!(
                variance_ratio.iter().all(|variance_ratio| (variance_ratio - 1.0).abs() < 0.01),
                "{recursion:?}: {variance_ratio}"
            );
        }
    }
}

/// The ratio to a variance measured with n robots has the standard error √(2/n), or more if the tails are heavy.
#[test]
fn ratios_and_crossings_are_those_of_exercise_7() {
    let exercises_text = read_exercises();
    let simulations = ["chapter", "doubled"].map(simulation_of_preset);
    for k in [1, 2, 5, 10, 20] {
        let step_ratios_of = |recursion| {
            [0, 1, 2].map(|axis_index| divide_by_fourth_order(&simulations[0], recursion, axis_index)[k - 1])
        };
        let [[a, b, c], [d, e, f]] = [Compounding::Chapter, Compounding::FirstOrder].map(step_ratios_of);
        exercises_text.assert_numbers(&format!("| {k} | # | # | # | # | # | # |"), [a, b, c, d, e, f]);
    }
    let first_missed_steps = simulations.map(|simulation| {
        let ratio_tolerance = MAX_STANDARD_ERRORS * (2.3 / simulation.settings().samples as f64).sqrt();
        let variance_ratios = &simulation.comparison(Compounding::FourthOrder).ratios;
        assert!(variance_ratios.iter().all(|recursion_ratios| {
            recursion_ratios.iter().all(|variance_ratio| (variance_ratio - 1.0).abs() < ratio_tolerance)
        }));
        let first_missed_step = simulation.comparison(Compounding::Chapter).misses[0].first.expect("a miss");
        assert_eq!(
            first_missed_step as usize,
            missed_steps_of(&divide_by_fourth_order(&simulation, Compounding::Chapter, 0))[0]
        );
        f64::from(first_missed_step)
    });
    exercises_text.assert_numbers(
        "off by more than 5 % from step # on. With the heading's standard deviation doubled (α₃ to α₆ four times as \
         large) it is from step # on",
        first_missed_steps,
    );
    read_page_text().assert_numbers(
        "it is off by more than 5 % from step # on, and with the heading σ doubled from step # on, which is earlier, \
         but not by half.",
        first_missed_steps,
    );
    assert!(first_missed_steps[1] > first_missed_steps[0] / 2.0);
}

#[test]
fn the_crossing_times_are_those_of_exercise_2() {
    let initial_simulation = new_simulation(Settings { samples: 1, ..Settings::default() });
    let straight_growth = initial_simulation.straight_growth();
    let last_index = straight_growth.durations.len() - 1;
    let growth_exponent_of = |variances_by_step: &[f64]| {
        (variances_by_step[last_index] / variances_by_step[0]).ln()
            / (straight_growth.durations[last_index] / straight_growth.durations[0]).ln()
    };
    let growth_exponents = [&straight_growth.along_first_order, &straight_growth.across_first_order]
        .map(|variances| growth_exponent_of(variances));
    let heading_alpha = 4.0 * initial_simulation.settings().heading_noise().expect("a level");
    let alphas = [0.02, 0.02, heading_alpha, heading_alpha, heading_alpha / 4.0, heading_alpha / 4.0];
    let doubled_simulation = new_simulation(Settings { alphas, samples: 1, ..Settings::default() });
    let crossing_times = [&straight_growth, &doubled_simulation.straight_growth()]
        .map(|straight_growth| straight_growth.crossing.expect("a crossing"));
    let exercises_text = read_exercises();
    read_page_text().assert_numbers(
        "along the track with the power #, across it with the power #. They cross",
        growth_exponents,
    );
    exercises_text.assert_numbers("grows with the power # of Δt, across it with #. ", growth_exponents);
    read_page_text()
        .assert_numbers("They cross after # s; with the heading σ doubled, after # s.", crossing_times);
    exercises_text.assert_numbers(
        "with α₁ = α₃ after # s, and with the heading's σ doubled (α₃ four times as large) after # s",
        crossing_times,
    );
}

#[test]
fn with_two_hundred_steps_the_lateral_variance_is_wrong_for_half_a_second() {
    read_page_text().assert_contains(
        "In 200 shorter steps, the predicted variance along the track stays within 5 %. The lateral variance is off for the first half second only, instead of three seconds:",
    );
    let [chapter_simulation, fine_simulation] = ["chapter", "fine"].map(simulation_of_preset);
    assert_eq!(fine_simulation.settings().steps, 200);
    assert!(missed_steps_of(&divide_by_fourth_order(&fine_simulation, Compounding::Chapter, 0)).is_empty());
    for (simulation, expected_half_seconds) in [(&fine_simulation, 1.0), (&chapter_simulation, 6.0)] {
        let missed_steps = missed_steps_of(&divide_by_fourth_order(simulation, Compounding::Chapter, 1));
        let miss_duration =
            *missed_steps.last().expect("it misses") as f64 * simulation.settings().command.dt;
        assert_eq!((2.0 * miss_duration).round(), expected_half_seconds, "{miss_duration}");
    }
}
