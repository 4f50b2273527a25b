//! Methods that all simulations with a cloud of samples have.

/// Implements the methods that create and configure a simulation, and show more of its samples.
///
/// The simulation must have the field `settings`, a function `new_empty` that creates it without samples from valid settings, and the methods
/// `configure_first`, `show_samples` and `shown_count`.
macro_rules! cloud_simulation {
    ($simulation:ident) => {
        impl $simulation {
            /// Creates a simulation that shows all samples. Fails with [`SettingsError`] for the first setting out of range, or where
            /// memory does not suffice for the samples.
            pub fn new(settings: Settings) -> Result<Self, SettingsError> {
                Self::with_shown_count(settings, settings.samples)
            }

            /// Creates a simulation that shows the first `sample_count` samples. Errors are those of `new`.
            pub fn with_shown_count(settings: Settings, sample_count: usize) -> Result<Self, SettingsError> {
                settings.check()?;
                let mut new_simulation = Self::new_empty(settings)?;
                new_simulation.show_samples(sample_count.min(settings.samples));
                Ok(new_simulation)
            }

            /// Returns the settings.
            pub fn settings(&self) -> &Settings {
                &self.settings
            }

            /// Changes the settings and shows all samples, drawn from the same random numbers. Errors are those of `configure_first`, and
            /// change nothing.
            pub fn configure(&mut self, settings: Settings) -> Result<(), SettingsError> {
                self.configure_first(settings, 0)?;
                self.add_samples(settings.samples);
                Ok(())
            }

            /// Shows up to `sample_count` more samples, and returns the total number of samples shown.
            pub fn add_samples(&mut self, sample_count: usize) -> usize {
                let target_count = self.shown_count().saturating_add(sample_count).min(self.settings.samples);
                if target_count > self.shown_count() {
                    self.show_samples(target_count);
                }
                self.shown_count()
            }
        }
    };
}
pub(super) use cloud_simulation;
