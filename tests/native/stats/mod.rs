//! Statistics of clouds and exact figures of models.

mod coverage;
mod gain;
mod level_set;
mod moments;
