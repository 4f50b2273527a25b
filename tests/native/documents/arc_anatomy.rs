//! Comparison of the numbers in the page's text about Arc Anatomy with numbers that its simulation computes.

use super::read_page_text;
use crate::common::settings_of_preset;
use crate::common::text::PrintedNumber;
use crate::simulations::arc_anatomy::stats_of;
use motion::sim::arc_anatomy::{ArcAnatomy, HeatMapKind, Settings, Stats};

/// Returns settings in which the final pose has the heading of the arc's end. The wedge that shows the final turn is then empty.
fn remove_wedge(settings: Settings) -> Settings {
    let arc_heading = stats_of(settings).driven.end[2];
    Settings { next: [settings.next[0], settings.next[1], arc_heading], ..settings }
}

#[test]
fn the_last_turn_explains_the_low_probability() {
    let [printed_sigma_count, printed_factor_percentage, printed_product_percentage] = read_page_text().sentence_numbers(
        "The last turn is off by # standard deviations: that factor alone leaves # % of its peak, all three leave # %.",
    );
    let Stats { factors: density_factors, weakest: weakest_index, share, .. } = stats_of(Settings::default());
    assert_eq!(weakest_index, 2);
    printed_sigma_count.assert_near(density_factors[2].deviations, 0.0);
    printed_factor_percentage.assert_percent(density_factors[2].share, 0.0);
    printed_product_percentage.assert_percent(share, 0.0);
    let [printed_remaining_percentage] = read_page_text()
        .sentence_numbers("With the heading of the arc the wedge is gone: # % are left, and the position");
    let Stats { factors: density_factors, share, .. } = stats_of(remove_wedge(Settings::default()));
    printed_remaining_percentage.assert_percent(share, 0.0);
    assert!((density_factors[2].share - 1.0).abs() < 1e-12);
}

#[test]
fn the_printed_table_gives_nearly_no_probability_to_arcs_to_the_right() {
    let [printed_speed]: [PrintedNumber; 1] = read_page_text()
        .sentence_numbers("and v̂, the speed along the arc, comes out as # m/s in a right turn.");
    for preset_name in ["right", "reverse"] {
        let settings = Settings { printed: true, ..settings_of_preset(preset_name) };
        let Stats { factors: density_factors, share, inverted: inverted_arc, .. } = stats_of(settings);
        assert!(inverted_arc.radius < 0.0 && share < 1e-15);
        printed_speed.assert_near(-density_factors[0].estimate.abs(), 0.0);
        assert!(density_factors[0].estimate * settings.command.v < 0.0);
        // With the unsigned radius of the printed table, contours of equal score stay near the start. With the signed radius they do not.
        let max_contour_distance = |settings: Settings| {
            let heat_map = ArcAnatomy::new(Settings { map: HeatMapKind::Prob, ..settings })
                .expect("valid settings")
                .surface([-2.0, -2.0], [2.0, 2.0])
                .expect("a map");
            heat_map.prob.iter().flatten().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max)
        };
        assert!(
            max_contour_distance(settings) < 0.5
                && max_contour_distance(settings_of_preset(preset_name)) > 1.0,
            "{}",
            max_contour_distance(settings)
        );
    }
}
