//! α's from logs: against the models' own densities, and against the α's and the errors that simulated logs were made with.

mod errors;
mod fits;
mod logs;
mod passes;
mod same;
mod simulated;
