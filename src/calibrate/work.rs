//! What a calibration costs, counted: the same on every machine.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// How many legs were gone through for the likelihood of their residuals, some fifty nanoseconds each; and what else takes so long. Copies
/// count together.
#[derive(Clone, Debug, Default)]
pub(super) struct Work(Arc<AtomicUsize>);

impl Work {
    pub fn add(&self, legs: usize) {
        self.0.fetch_add(legs, Relaxed);
    }

    /// Since its beginning.
    pub fn total(&self) -> usize {
        self.0.load(Relaxed)
    }
}
