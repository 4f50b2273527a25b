//! Arc Anatomy: the arc between two poses, the motion that it implies, and the likelihood of that motion (Tables 5.1 and 5.3).

mod forms;
mod settings;
mod stats;
mod surface;
mod table;

pub use forms::{FormErrors, STRAIGHT_LINE_THRESHOLD, exact_end, form_errors};
pub use settings::*;
pub use stats::{ArcWithCircle, Factor, Stats};
pub use surface::{CONTOUR_LEVELS, Surface};
pub use table::Table;

use super::settings::{Rules, SettingsError};
use crate::geom::arc::PreparedPose;
use crate::geom::se2::SE2;
use crate::js::js_structs;

/// Number of chords of the path of the constant twist.
const TWIST_PATH_CHORDS: usize = 64;
/// Number of ticks on the path of the constant twist, at equal intervals of time.
const TWIST_PATH_TICKS: usize = 8;

js_structs! {
    /// Lines of the picture: x, y pairs of their points, m.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Paths as "AnatomyPaths" {
        /// Noise-free arc of the command.
        pub commanded: Vec<[f64; 2]> as "Float64Array",
        /// Arc to the final position.
        pub inverted: Vec<[f64; 2]> as "Float64Array",
        /// Arc that v̂ and ω̂ drive.
        pub driven: Vec<[f64; 2]> as "Float64Array",
        /// Path of the constant twist ξ: start · exp(tξ) for t from 0 to 1. If γ̂ ≠ 0 it differs from the driven arc, and has a
        /// lateral velocity, which wheels do not allow.
        pub lie: Vec<[f64; 2]> as "Float64Array",
        /// Line segments that start on the path `lie`, as x, y, x, y in m. Each is the displacement that the lateral velocity at its start
        /// would cause within Δt.
        pub ticks: Vec<[f64; 4]> as "Float64Array",
    }
}

/// Simulation of the widget. Every result is computed from the settings when it is read.
#[derive(Clone, Debug)]
pub struct ArcAnatomy {
    settings: Settings,
}

impl ArcAnatomy {
    /// Creates a simulation with these settings.
    ///
    /// # Errors
    /// [`SettingsError`] for the first setting out of range.
    pub fn new(settings: Settings) -> Result<Self, SettingsError> {
        settings.check()?;
        Ok(Self { settings })
    }

    /// Returns the settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Changes the settings.
    /// Errors are those of [`ArcAnatomy::new`], and change nothing.
    pub fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
        *self = Self::new(settings)?;
        Ok(())
    }

    /// Returns the arcs of the command and to the final pose, with the likelihood of that pose.
    pub fn stats(&self) -> Stats {
        Stats::of(&self.settings)
    }

    /// Returns the values of the lines of Table 5.1.
    pub fn table(&self) -> Table {
        Table::of(&self.settings, &self.stats())
    }

    /// Returns the paths to draw.
    pub fn paths(&self) -> Paths {
        let (start, next) = (self.settings.start(), self.settings.next());
        let Stats { commanded, inverted, driven, .. } = self.stats();
        let xi = next.boxminus(&start);
        let pose_on_twist_path = |i: usize, count: usize| start.boxplus(xi * (i as f64 / count as f64));
        let position_of = |pose: SE2| [pose.x(), pose.y()];
        let lateral_velocity_segment = |i: usize| {
            let pose = pose_on_twist_path(i, TWIST_PATH_TICKS);
            let [x, y] = PreparedPose::new(pose).transform_point([0.0, xi.y]);
            [pose.x(), pose.y(), x, y]
        };
        Paths {
            commanded: commanded.leading_part(start, 1.0).points(),
            inverted: inverted.leading_part(start, 1.0).points(),
            driven: driven.leading_part(start, 1.0).points(),
            lie: (0..=TWIST_PATH_CHORDS)
                .map(|i| position_of(pose_on_twist_path(i, TWIST_PATH_CHORDS)))
                .collect(),
            ticks: (0..=TWIST_PATH_TICKS).map(lateral_velocity_segment).collect(),
        }
    }

    /// Returns the poses after a fraction of the time, from 0 to 1: on the commanded arc, on the arc that v̂ and ω̂ drive, and on
    /// the path of the constant twist.
    pub fn poses_at(&self, fraction: f64) -> [SE2; 3] {
        let start_pose = self.settings.start();
        let Stats { commanded, driven, .. } = self.stats();
        let xi = self.settings.next().boxminus(&start_pose);
        [
            commanded.leading_part(start_pose, fraction).end(),
            driven.leading_part(start_pose, fraction).end(),
            start_pose.boxplus(xi * fraction),
        ]
    }

    /// Returns the heat map over the rectangle from `min` to `max` (m, `min` below `max` in both coordinates); None if no heat
    /// map is selected.
    pub fn surface(&self, min: [f64; 2], max: [f64; 2]) -> Option<Surface> {
        Surface::of(&self.settings, min, max)
    }
}
