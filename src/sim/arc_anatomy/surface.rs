//! Heat map over positions, at the heading of the final pose: the score p of Table 5.1, or the probability density of the sampler.

use super::stats::prob;
use super::{FinalPose, Settings, SurfaceKind};
use crate::js::js_structs;
use crate::models::MotionModel;
use crate::stats::trace_level_set;

/// Maximum number of exponentials for a heat map, which take some milliseconds on a phone. The density sums over the full turns
/// that noise may cause. If there are many turns, the heat map has fewer and larger cells.
const MAX_EXPONENTIALS: f64 = 1e5;

/// Maximum number of full turns over which the density of the last turn is summed: nine standard deviations of up to nine
/// radians.
const MAX_LAST_TURNS: f64 = 27.0;

/// Values of the contours, relative to the maximum.
pub const CONTOUR_LEVELS: [f64; 3] = [0.5, 0.1, 0.01];

js_structs! {
    /// Heat map over positions.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Surface as "AnatomySurface" {
        /// Number of cells along x.
        pub columns: usize,
        /// Number of cells along y.
        pub rows: usize,
        /// Values of the cells from 0 to 255, relative to the maximum; row by row from the top. All are 0 if a noise has no variance.
        pub shades: Vec<u8> as "Uint8Array",
        /// Contours of p at a half, a tenth and a hundredth of its maximum, as x, y pairs in m.
        pub prob: Vec<Vec<[f64; 2]>> as "Float64Array[]",
        /// Contours of the sampler's density at the same fractions of its maximum.
        pub density: Vec<Vec<[f64; 2]>> as "Float64Array[]",
    }
}

impl Surface {
    /// Returns the heat map of a rectangle from `min` to `max`; None if no heat map is selected.
    pub(super) fn of(settings: &Settings, min: [f64; 2], max: [f64; 2]) -> Option<Self> {
        if settings.map == SurfaceKind::Nothing {
            return None;
        }
        let (model, start) = (settings.model(), settings.start());
        let winding_count = f64::from(2 * model.max_windings(&settings.command) + 1);
        let max_cells =
            MAX_EXPONENTIALS / (3.0 + 2.0 * winding_count + MAX_LAST_TURNS.min(winding_count + 2.0));
        let [width, height] = [max[0] - min[0], max[1] - min[1]];
        let columns = (max_cells * width / height).sqrt().max(1.0).min(max_cells).floor();
        let rows = (max_cells / columns).max(1.0).floor();
        let cell_size = [width / columns, height / rows];
        let (columns, rows) = (columns as usize, rows as usize);
        let cell_centre = |[column, row]: [f64; 2]| {
            [min[0] + (column + 0.5) * cell_size[0], max[1] - (row + 0.5) * cell_size[1]]
        };
        let evaluate_cells = |function: &dyn Fn(&Settings) -> f64| -> Vec<f64> {
            let cell_value = |i: usize| {
                let [x, y] = cell_centre([(i % columns) as f64, (i / columns) as f64]);
                let next = FinalPose { x, y, theta: settings.next.theta };
                // The density is infinite at the start pose.
                function(&Settings { next, ..*settings }).min(f64::MAX)
            };
            (0..columns * rows).map(cell_value).collect()
        };
        let prob_values = evaluate_cells(&prob);
        let density_values = evaluate_cells(&|settings| {
            model.pose_density(&settings.next(), &settings.command, &start).unwrap_or(0.0)
        });
        let shown_values = if settings.map == SurfaceKind::Prob { &prob_values } else { &density_values };
        let maximum_of = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let shown_maximum = maximum_of(shown_values);
        let shade_of = |value: &f64| {
            if shown_maximum > 0.0 { (255.0 * (value / shown_maximum)).round() as u8 } else { 0 }
        };
        let contours_of = |values: &[f64]| {
            let max_value = maximum_of(values);
            // Contours are interpolated between logarithms, which are closer to linear between cells.
            let log_values: Vec<f64> =
                values.iter().map(|value| libm::log(value.max(f64::MIN_POSITIVE))).collect();
            let log_levels = CONTOUR_LEVELS
                .iter()
                .filter(|_| max_value > 0.0)
                .map(|fraction| libm::log(fraction * max_value));
            let contour_lines = log_levels.flat_map(|level| trace_level_set(&log_values, columns, level));
            contour_lines.map(|line| line.into_iter().map(cell_centre).collect()).collect()
        };
        Some(Self {
            columns,
            rows,
            shades: shown_values.iter().map(shade_of).collect(),
            prob: contours_of(&prob_values),
            density: contours_of(&density_values),
        })
    }
}
