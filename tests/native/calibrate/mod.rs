//! α's from logs: against the models' own densities, and against the α's and the errors that simulated logs were made with.

mod doubts;
mod errors;
mod fits;
mod leg_lengths;
mod logs;
mod mismatch;
mod passes;
mod simulated;
mod sparse;
mod standing;
mod stated;
mod undetermined;
