//! Exercise 1: rounding and truncation errors of the arc, the straight line and the chord at small turn rates.

use crate::geom::arc::arc_end;
use crate::geom::double_double::DoubleDouble;
use crate::js::js_structs;
use std::f64::consts::TAU;

/// Speed, m/s, and duration, s, of the arcs of Exercise 1.
const SPEED: f64 = 1.0;
const DURATION: f64 = 0.1;

/// Turn rate |ω̂| (rad/s) below which the chapter's code uses the straight line.
pub const STRAIGHT_LINE_THRESHOLD: f64 = 1e-6;

/// Turn rates from 10⁻¹² to 10 rad/s, and their number for each factor of ten.
const FIRST_AND_LAST_DECADE: [i32; 2] = [-12, 1];
const POINTS_PER_DECADE: i32 = 8;

/// Number of headings over which the error is averaged (root mean square).
const HEADING_COUNT: u32 = 24;

js_structs! {
    /// Errors (m) of three forms for the end of a motion at 1 m/s for 0.1 s, by turn rate. Each is the root mean square over all
    /// headings.
    #[derive(Clone, Debug, PartialEq)]
    pub struct FormErrors {
        /// Turn rates, rad/s.
        pub omega: Vec<f64> as "Float64Array",
        /// Error (m) of x − (v/ω) sin θ + (v/ω) sin(θ + ωΔt), and y likewise.
        pub arc: Vec<f64> as "Float64Array",
        /// Error (m) of x + vΔt cos θ, and y likewise.
        pub straight: Vec<f64> as "Float64Array",
        /// Error (m) of the chord: the distance vΔt sinc(ωΔt/2) in the direction θ + ωΔt/2.
        pub chord: Vec<f64> as "Float64Array",
        /// Turn rate √(2ε)/Δt (rad/s) at which the errors of arc and straight line are estimated to be equal.
        pub estimated_crossover: f64,
        /// Turn rate (rad/s) below which the chapter’s code uses the straight line.
        pub threshold: f64,
    }
}

/// Returns the errors of the three forms, relative to the same motion in double-double arithmetic.
pub fn form_errors() -> FormErrors {
    let [first, last] = FIRST_AND_LAST_DECADE.map(|exponent| exponent * POINTS_PER_DECADE);
    let omega: Vec<f64> =
        (first..=last).map(|i| libm::exp10(f64::from(i) / f64::from(POINTS_PER_DECADE))).collect();
    let rms_errors: Vec<[f64; 3]> = omega.iter().map(|omega| rms_errors_at(*omega)).collect();
    let errors_of_form = |form: usize| rms_errors.iter().map(|error| error[form]).collect();
    FormErrors {
        arc: errors_of_form(0),
        straight: errors_of_form(1),
        chord: errors_of_form(2),
        estimated_crossover: (2.0 * f64::EPSILON).sqrt() / DURATION,
        threshold: STRAIGHT_LINE_THRESHOLD,
        omega,
    }
}

fn rms_errors_at(omega: f64) -> [f64; 3] {
    let mut squared_errors = [0.0; 3];
    for i in 0..HEADING_COUNT {
        // The headings avoid the axes, along which one of the coordinates would be exact.
        let heading = TAU * (f64::from(i) + 0.37) / f64::from(HEADING_COUNT) - 0.5 * TAU;
        let true_end = exact_end(heading, omega);
        let form_ends =
            [arc_form_end(heading, omega), straight_form_end(heading), chord_form_end(heading, omega)];
        for (square, end) in squared_errors.iter_mut().zip(form_ends) {
            for (coordinate, exact_coordinate) in end.into_iter().zip(true_end) {
                let coordinate_error = (DoubleDouble::from(coordinate) - exact_coordinate).to_f64();
                *square += coordinate_error * coordinate_error;
            }
        }
    }
    squared_errors.map(|square| (square / f64::from(HEADING_COUNT)).sqrt())
}

fn arc_form_end(theta: f64, omega: f64) -> [f64; 2] {
    let radius = SPEED / omega;
    let end_heading = theta + omega * DURATION;
    [
        radius * libm::sin(end_heading) - radius * libm::sin(theta),
        radius * libm::cos(theta) - radius * libm::cos(end_heading),
    ]
}

fn straight_form_end(theta: f64) -> [f64; 2] {
    let length = SPEED * DURATION;
    [length * libm::cos(theta), length * libm::sin(theta)]
}

fn chord_form_end(theta: f64, omega: f64) -> [f64; 2] {
    let (ahead, left) = arc_end(SPEED * DURATION, omega * DURATION);
    let (sin, cos) = libm::sincos(theta);
    [cos * ahead - sin * left, sin * ahead + cos * left]
}

/// Returns the end of the motion in double-double arithmetic.
pub fn exact_end(theta: f64, omega: f64) -> [DoubleDouble; 2] {
    let half_turn = DoubleDouble::product(0.5 * omega, DURATION);
    let chord_length = DoubleDouble::product(SPEED, DURATION) * half_turn.sinc();
    let (sin, cos) = (DoubleDouble::from(theta) + half_turn).sin_cos();
    [chord_length * cos, chord_length * sin]
}
