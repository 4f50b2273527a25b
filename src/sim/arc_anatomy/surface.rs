//! p and the density of the sampler over positions, for the heading of the final pose.

use super::figures::prob;
use super::{FinalPose, Mapped, Settings};
use crate::models::MotionModel;
use crate::stats::level_set;

/// Exponentials that a map may take, some milliseconds' work on a phone: cells become larger where noise could turn the robot
/// round many times, each of which counts.
const MOST_EXPONENTIALS: f64 = 1e5;

/// Windings of the last turn that are summed at most: those of nine deviations of up to nine radians.
const LAST_TURNS: f64 = 27.0;

/// Contours are at these shares of the highest value.
pub const LEVELS: [f64; 3] = [0.5, 0.1, 0.01];

/// A map of positions.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    pub columns: usize,
    pub rows: usize,
    /// Values of the heat map over its highest one, in 255ths: cell by cell, row by row from the top. All 0 where a noise has no
    /// variance.
    pub shades: Vec<u8>,
    /// Contours of p and of the density, of the outermost level last; x, y, m.
    pub prob: Vec<Vec<[f64; 2]>>,
    pub density: Vec<Vec<[f64; 2]>>,
}

impl Surface {
    /// Returns the map of a rectangle from `min` to `max`; None if no map is selected.
    pub(super) fn of(settings: &Settings, min: [f64; 2], max: [f64; 2]) -> Option<Self> {
        if settings.map == Mapped::Nothing {
            return None;
        }
        let (model, start) = (settings.model(), settings.start());
        let windings = f64::from(2 * model.windings(&settings.command) + 1);
        let most = MOST_EXPONENTIALS / (3.0 + 2.0 * windings + LAST_TURNS.min(windings + 2.0));
        let [width, height] = [max[0] - min[0], max[1] - min[1]];
        let columns = (most * width / height).sqrt().max(1.0).min(most).floor();
        let rows = (most / columns).max(1.0).floor();
        let side = [width / columns, height / rows];
        let (columns, rows) = (columns as usize, rows as usize);
        // The middle of a cell, counted from the top.
        let place =
            |[column, row]: [f64; 2]| [min[0] + (column + 0.5) * side[0], max[1] - (row + 0.5) * side[1]];
        let field = |value: &dyn Fn(&Settings) -> f64| -> Vec<f64> {
            let at = |i: usize| {
                let [x, y] = place([(i % columns) as f64, (i / columns) as f64]);
                let next = FinalPose { x, y, theta: settings.next.theta };
                // Infinite where the robot has not moved at all.
                value(&Settings { next, ..*settings }).min(f64::MAX)
            };
            (0..columns * rows).map(at).collect()
        };
        let prob = field(&prob);
        let density = field(&|at| model.pose_density(&at.next(), &at.command, &start).unwrap_or(0.0));
        let mapped = if settings.map == Mapped::Prob { &prob } else { &density };
        let highest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let most = highest(mapped);
        let shade = |value: &f64| if most > 0.0 { (255.0 * (value / most)).round() as u8 } else { 0 };
        let contours = |values: &[f64]| {
            let top = highest(values);
            // Lines are interpolated between logarithms, which bend less between the cells.
            let logs: Vec<f64> = values.iter().map(|value| libm::log(value.max(f64::MIN_POSITIVE))).collect();
            let levels = LEVELS.iter().filter(|_| top > 0.0).map(|share| libm::log(share * top));
            let lines = levels.flat_map(|level| level_set(&logs, columns, level));
            lines.map(|line| line.into_iter().map(place).collect()).collect()
        };
        Some(Self {
            columns,
            rows,
            shades: mapped.iter().map(shade).collect(),
            prob: contours(&prob),
            density: contours(&density),
        })
    }
}
