//! Arc Anatomy: the arc between two poses, what it says was driven, and how likely that is (Tables 5.1 and 5.3).

mod figures;
mod forms;
mod settings;
mod surface;
mod table;

pub use figures::{Bend, Factor, Stats};
pub use forms::{CHAPTERS_THRESHOLD, FormErrors, form_errors, reference};
pub use settings::*;
pub use surface::{LEVELS, Surface};
pub use table::Table;

use super::settings::{Rules, SettingsError};
use crate::geom::arc::Departure;
use crate::geom::se2::SE2;

/// Chords of the Lie path.
const LIE_CHORDS: usize = 64;
/// Ticks on the Lie path, at equal times.
const LIE_TICKS: usize = 8;

/// Lines of the picture: x, y of their points in m.
#[derive(Clone, Debug, PartialEq)]
pub struct Paths {
    /// The way that the command drives without noise.
    pub commanded: Vec<[f64; 2]>,
    /// The arc to the final position.
    pub inverted: Vec<[f64; 2]>,
    /// The arc that v̂ and ω̂ drive.
    pub driven: Vec<[f64; 2]>,
    /// The way of a body that moves by the constant twist ξ: start · exp(tξ), t from 0 to 1. Where γ̂ ≠ 0 it is not the arc
    /// that was driven, and has a lateral velocity, which no wheel allows.
    pub lie: Vec<[f64; 2]>,
    /// Lines from points of the path `lie`, each along the displacement that its lateral velocity alone would make in Δt.
    pub ticks: Vec<[f64; 4]>,
}

/// The simulation behind the widget. All of it follows from the settings at once.
#[derive(Clone, Debug)]
pub struct ArcAnatomy {
    settings: Settings,
}

impl ArcAnatomy {
    /// # Errors
    /// [`SettingsError`] for the first setting out of range.
    pub fn new(settings: Settings) -> Result<Self, SettingsError> {
        settings.check()?;
        Ok(Self { settings })
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// # Errors
    /// As [`ArcAnatomy::new`]; nothing has changed then.
    pub fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
        *self = Self::new(settings)?;
        Ok(())
    }

    pub fn stats(&self) -> Stats {
        Stats::of(&self.settings)
    }

    pub fn table(&self) -> Table {
        Table::of(&self.settings, &self.stats())
    }

    pub fn paths(&self) -> Paths {
        let (start, next) = (self.settings.start(), self.settings.next());
        let Stats { commanded, inverted, driven, .. } = self.stats();
        let xi = next.boxminus(&start);
        let slid = |i: usize, of: usize| start.boxplus(xi * (i as f64 / of as f64));
        let point = |pose: SE2| [pose.x(), pose.y()];
        let tick = |i: usize| {
            let pose = slid(i, LIE_TICKS);
            let [x, y] = Departure::new(pose).transform([0.0, xi.y]);
            [pose.x(), pose.y(), x, y]
        };
        Paths {
            commanded: commanded.arc(start, 1.0).points(),
            inverted: inverted.arc(start, 1.0).points(),
            driven: driven.arc(start, 1.0).points(),
            lie: (0..=LIE_CHORDS).map(|i| point(slid(i, LIE_CHORDS))).collect(),
            ticks: (0..=LIE_TICKS).map(tick).collect(),
        }
    }

    /// Returns the poses of the robot on the commanded arc, on the one that v̂ and ω̂ drive, and on the way of constant twist, after a
    /// share of the time, from 0 to 1.
    pub fn underway(&self, share: f64) -> [SE2; 3] {
        let start = self.settings.start();
        let Stats { commanded, driven, .. } = self.stats();
        let xi = self.settings.next().boxminus(&start);
        [commanded.arc(start, share).end(), driven.arc(start, share).end(), start.boxplus(xi * share)]
    }

    /// Returns the map over positions in the rectangle from `min` to `max` (m, `min` below `max` in both coordinates); None if
    /// no map is selected.
    pub fn surface(&self, min: [f64; 2], max: [f64; 2]) -> Option<Surface> {
        Surface::of(&self.settings, min, max)
    }
}
