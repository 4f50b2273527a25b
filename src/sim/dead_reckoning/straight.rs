//! Variances of a straight drive as functions of its duration (exercise 2).

use super::settings::Settings;
use crate::js::js_structs;
use crate::models::{VelocityAlphas, VelocityCmd, VelocityModel};
use crate::noise::NoiseKind;
use crate::stats::ExactMoments;

/// Decimal logarithms of the first and last duration, in tenths: 0.1 s to 10 s. Crossings at common settings are in this
/// range. Smaller steps would not make the curves look smoother.
const LOG10_DURATIONS_IN_TENTHS: [i32; 2] = [-10, 10];

js_structs! {
    /// Variances of one straight command by its duration.
    #[derive(Clone, Debug, PartialEq)]
    pub struct StraightGrowth {
        /// Δt (s) at even steps of its logarithm.
        pub durations: Vec<f64> as "Float64Array",
        /// Exact variances along the track, m².
        pub along: Vec<f64> as "Float64Array",
        /// Exact variances across the track, m².
        pub across: Vec<f64> as "Float64Array",
        /// Variances along the track to first order in the noise, m²: α₁v²Δt².
        pub along_first_order: Vec<f64> as "Float64Array",
        /// Variances across the track to first order in the noise, m²: ¼α₃v⁴Δt⁴.
        pub across_first_order: Vec<f64> as "Float64Array",
        /// Duration (s) at which both first-order variances are equal: (2/|v|)·√(α₁/α₃). Null (None) if they never are.
        pub crossing: Option<f64>,
    }
}

impl StraightGrowth {
    /// Computes the variances at the speed and noise of the settings. Each duration is one command.
    pub fn new(settings: &Settings) -> Self {
        let v = settings.command.v;
        let [alpha1, _, alpha3, ..] = settings.alphas;
        let model = VelocityModel { alphas: VelocityAlphas(settings.alphas), noise: NoiseKind::Normal };
        let [first, last] = LOG10_DURATIONS_IN_TENTHS;
        let durations: Vec<f64> = (first..=last).map(|i| libm::pow(10.0, f64::from(i) / 10.0)).collect();
        let exact_variances = durations.iter().map(|dt| {
            let cov = ExactMoments::of_velocity(&model, &VelocityCmd { v, omega: 0.0, dt: *dt }).cov;
            (cov[(0, 0)], cov[(1, 1)])
        });
        let (along, across) = exact_variances.unzip();
        let crossing_time = 2.0 / v.abs() * (alpha1 / alpha3).sqrt();
        Self {
            along,
            across,
            along_first_order: durations.iter().map(|dt| alpha1 * v * v * dt * dt).collect(),
            // An arc of length vΔt that turns by a small φ ends ½vΔt·φ to the side.
            across_first_order: (durations.iter())
                .map(|dt| alpha3 * v * v * dt * dt * (0.5 * v * dt) * (0.5 * v * dt))
                .collect(),
            durations,
            crossing: (crossing_time.is_finite() && crossing_time > 0.0).then_some(crossing_time),
        }
    }
}
