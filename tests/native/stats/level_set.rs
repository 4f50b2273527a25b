//! Contour lines of known fields, and of the heat maps of Arc Anatomy.

use crate::common::{sample_uniform, seeded_rng};
use motion::geom::se2::SE2;
use motion::sim::arc_anatomy::{ArcAnatomy, CONTOUR_LEVELS, HeatMapKind, Settings, Surface};
use motion::stats::trace_level_set;
use motion::{MotionModel, NoiseKind, VelocityAlphas, VelocityModel};

#[test]
fn the_mean_of_the_corners_decides_how_a_saddle_is_connected() {
    for (contour_level, are_low_corners_cut_off) in [(0.4, true), (0.6, false)] {
        let contour_lines = trace_level_set(&[1.0, 0.0, 0.0, 1.0], 2, contour_level);
        assert_eq!(contour_lines.len(), 2);
        // In a saddle cell, two contour lines separate either both low corners or both high corners from the rest.
        let is_cut_off = |corner: [f64; 2]| {
            contour_lines.iter().any(|contour_line| {
                contour_line.iter().all(|[x, y]| (x - corner[0]).abs() + (y - corner[1]).abs() < 1.0)
            })
        };
        for (cell_corners, should_be_cut_off) in [
            ([[1.0, 0.0], [0.0, 1.0]], are_low_corners_cut_off),
            ([[0.0, 0.0], [1.0, 1.0]], !are_low_corners_cut_off),
        ] {
            assert_eq!(cell_corners.into_iter().all(is_cut_off), should_be_cut_off, "{contour_lines:?}");
        }
    }
}

/// The tested field is random noise. Each edge of a cell between a value above the level and a value below it is crossed once. Lines are
/// closed or end at the rim, and successive points are at most a cell apart.
#[test]
fn contours_of_noise_contain_every_crossing() {
    let mut rng = seeded_rng(21);
    let (columns, rows) = (23, 17);
    let random_field: Vec<f64> = (0..columns * rows).map(|_| sample_uniform(&mut rng, -1.0, 1.0)).collect();
    let mut crossing_count = 0;
    for i in 0..columns * rows {
        let is_crossed = |k: usize| usize::from((random_field[i] > 0.2) != (random_field[k] > 0.2));
        crossing_count += if i % columns + 1 < columns { is_crossed(i + 1) } else { 0 };
        crossing_count += if i / columns + 1 < rows { is_crossed(i + columns) } else { 0 };
    }
    let contour_lines = trace_level_set(&random_field, columns, 0.2);
    let mut point_count = 0;
    for outline in &contour_lines {
        let is_closed = outline.len() > 2 && outline.first() == outline.last();
        point_count += outline.len() - usize::from(is_closed);
        let is_on_rim =
            |[x, y]: [f64; 2]| x == 0.0 || y == 0.0 || x == (columns - 1) as f64 || y == (rows - 1) as f64;
        assert!(is_closed || (is_on_rim(outline[0]) && is_on_rim(outline[outline.len() - 1])), "{outline:?}");
        for edge in outline.windows(2) {
            assert!((edge[1][0] - edge[0][0]).abs().max((edge[1][1] - edge[0][1]).abs()) <= 1.0);
        }
    }
    assert_eq!(point_count, crossing_count);
}

#[test]
fn small_or_flat_fields_have_no_lines() {
    for (field_values, columns) in [(vec![], 0), (vec![1.0], 1), (vec![1.0, 0.0], 2), (vec![1.0; 12], 4)] {
        assert!(trace_level_set(&field_values, columns, 0.5).is_empty());
    }
}

fn new_heat_map(settings: Settings) -> Surface {
    let simulation = ArcAnatomy::new(settings).expect("valid settings");
    simulation.surface([-0.5, -1.0], [2.0, 1.5]).expect("a map")
}

/// The models compute the densities at contour points. In a cell of h = 0.028 m, linear interpolation of log p has an error of h²/8 times the
/// second derivative. The derivative is largest across the drive, where the arc's turn changes by 2/d per metre at the distance d. From
/// d = 0.7 m on, (2/d)² · (1/σ_ω² + 1/σ_γ²) is below 770, so that the error of log p is at most 0.075.
#[test]
fn contours_lie_at_the_levels_of_the_models() {
    let settings = Settings { map: HeatMapKind::Density, ..Settings::default() };
    let Surface { columns: column_count, rows: row_count, shades, prob, density } = new_heat_map(settings);
    assert!(column_count * row_count == shades.len() && (5_000..=10_000).contains(&shades.len()));
    let model = VelocityModel { alphas: VelocityAlphas(settings.alphas), noise: NoiseKind::Normal };
    let start_pose = SE2::identity();
    let density_at_point = |[x, y]: [f64; 2], surface_kind: HeatMapKind| {
        let next_pose = SE2::new(x, y, settings.next[2]);
        match surface_kind {
            HeatMapKind::Prob => model.prob(&next_pose, &settings.command, &start_pose),
            _ => model.pose_density(&next_pose, &settings.command, &start_pose).expect("noise of full rank"),
        }
    };
    let centre_of = |i: usize| {
        let [cell_x, cell_y] = [i % column_count, i / column_count].map(|cell_index| cell_index as f64 + 0.5);
        [-0.5 + 2.5 * cell_x / column_count as f64, 1.5 - 2.5 * cell_y / row_count as f64]
    };
    for (contour_lines, surface_kind) in [(&prob, HeatMapKind::Prob), (&density, HeatMapKind::Density)] {
        let max_density =
            (0..shades.len()).map(|i| density_at_point(centre_of(i), surface_kind)).fold(0.0, f64::max);
        assert!(contour_lines.len() >= CONTOUR_LEVELS.len());
        for contour_point in contour_lines.iter().flatten().filter(|[x, y]| x.hypot(*y) > 0.7) {
            let relative_density = density_at_point(*contour_point, surface_kind) / max_density;
            let nearest_level = CONTOUR_LEVELS.into_iter().min_by(|a, b| {
                (relative_density / a).ln().abs().total_cmp(&(relative_density / b).ln().abs())
            });
            assert!(
                (relative_density / nearest_level.expect("a level") - 1.0).abs() < 0.078,
                "{contour_point:?} {relative_density}"
            );
        }
    }
    let max_density =
        (0..shades.len()).map(|i| density_at_point(centre_of(i), HeatMapKind::Density)).fold(0.0, f64::max);
    for (i, cell_shade) in shades.iter().enumerate() {
        let expected_shade = 255.0 * density_at_point(centre_of(i), HeatMapKind::Density) / max_density;
        assert!((f64::from(*cell_shade) - expected_shade).abs() <= 0.5 + 1e-9);
    }
}

#[test]
fn a_heat_map_without_noise_is_empty() {
    let settings = Settings { alphas: [0.0; 6], map: HeatMapKind::Prob, ..Settings::default() };
    let Surface { shades, prob, density, .. } = new_heat_map(settings);
    assert!(shades.iter().all(|cell_shade| *cell_shade == 0) && prob.is_empty() && density.is_empty());
}
