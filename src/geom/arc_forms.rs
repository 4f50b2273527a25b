//! Exercise 1: rounding and truncation errors of three formulas for the end of a motion at small turn rates: arc, straight line and chord.
//! An error is the difference from the same motion in double-double arithmetic.

use super::arc::arc_end;
use crate::js::js_structs;
use std::f64::consts::TAU;
use std::ops::{Add, Div, Mul, Sub};

const SPEED: f64 = 1.0;
const ARC_DURATION: f64 = 0.1;

/// Turn rate |ω̂| (rad/s) below which the code of the book's chapter drives a straight line.
const STRAIGHT_LINE_THRESHOLD: f64 = 1e-6;

/// Decimal exponents of the first and last turn rate (rad/s), and number of turn rates per decade.
const FIRST_AND_LAST_DECADE: [i32; 2] = [-12, 1];
const POINTS_PER_DECADE: i32 = 8;

const HEADING_COUNT: u32 = 24;

js_structs! {
    /// Errors (m) of three formulas for the end of a motion at 1 m/s for 0.1 s, by turn rate: root mean squares over all headings.
    #[derive(Clone, Debug, PartialEq)]
    pub struct FormErrors {
        /// Turn rates, rad/s.
        pub omega: Vec<f64> as "Float64Array",
        /// Error (m) of the arc: x − (v/ω) sin θ + (v/ω) sin(θ + ωΔt), and likewise for y.
        pub arc: Vec<f64> as "Float64Array",
        /// Error (m) of the straight line: x + vΔt cos θ, and likewise for y.
        pub straight: Vec<f64> as "Float64Array",
        /// Error (m) of the chord: the distance vΔt sinc(ωΔt/2) in the direction θ + ωΔt/2.
        pub chord: Vec<f64> as "Float64Array",
        /// Turn rate √(2ε)/Δt (rad/s), with the machine epsilon ε, at which the errors of arc and straight line are estimated to be equal.
        pub estimated_crossover: f64,
        /// Turn rate (rad/s) below which the chapter’s code uses the straight line.
        pub threshold: f64,
    }
}

/// Returns the errors of the three formulas, relative to the same motion in double-double arithmetic.
pub fn form_errors() -> FormErrors {
    let [first_index, end_index] =
        FIRST_AND_LAST_DECADE.map(|decade_exponent| decade_exponent * POINTS_PER_DECADE);
    let omega: Vec<f64> =
        (first_index..=end_index).map(|i| libm::exp10(f64::from(i) / f64::from(POINTS_PER_DECADE))).collect();
    let rms_errors: Vec<[f64; 3]> = omega.iter().map(|omega| rms_errors_at(*omega)).collect();
    let errors_of_form =
        |form_index: usize| rms_errors.iter().map(|form_errors| form_errors[form_index]).collect();
    FormErrors {
        arc: errors_of_form(0),
        straight: errors_of_form(1),
        chord: errors_of_form(2),
        estimated_crossover: (2.0 * f64::EPSILON).sqrt() / ARC_DURATION,
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
            [end_by_arc(heading, omega), end_by_straight_line(heading), end_by_chord(heading, omega)];
        for (squared_error, form_end) in squared_errors.iter_mut().zip(form_ends) {
            for (form_coordinate, exact_coordinate) in form_end.into_iter().zip(true_end) {
                let coordinate_error = (DoubleDouble::from(form_coordinate) - exact_coordinate).to_f64();
                *squared_error += coordinate_error * coordinate_error;
            }
        }
    }
    squared_errors.map(|squared_error| (squared_error / f64::from(HEADING_COUNT)).sqrt())
}

fn end_by_arc(theta: f64, omega: f64) -> [f64; 2] {
    let arc_radius = SPEED / omega;
    let end_heading = theta + omega * ARC_DURATION;
    [
        arc_radius * libm::sin(end_heading) - arc_radius * libm::sin(theta),
        arc_radius * libm::cos(theta) - arc_radius * libm::cos(end_heading),
    ]
}

fn end_by_straight_line(theta: f64) -> [f64; 2] {
    let driven_length = SPEED * ARC_DURATION;
    [driven_length * libm::cos(theta), driven_length * libm::sin(theta)]
}

fn end_by_chord(theta: f64, omega: f64) -> [f64; 2] {
    let (ahead_offset, left_offset) = arc_end(SPEED * ARC_DURATION, omega * ARC_DURATION);
    let (sin, cos) = libm::sincos(theta);
    [cos * ahead_offset - sin * left_offset, sin * ahead_offset + cos * left_offset]
}

fn exact_end(theta: f64, omega: f64) -> [DoubleDouble; 2] {
    let half_turn = DoubleDouble::product(0.5 * omega, ARC_DURATION);
    let chord_length = DoubleDouble::product(SPEED, ARC_DURATION) * half_turn.sinc();
    let (sin, cos) = (DoubleDouble::from(theta) + half_turn).sin_cos();
    [chord_length * cos, chord_length * sin]
}

/// Number with twice the digits of a double, as the sum `high` + `low` of two doubles, which have 106 bits together.
///
/// Sums and products use the error-free transformations of Dekker (Numerische Mathematik 18, 1971) and Knuth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    /// Double nearest to the number.
    pub high: f64,
    /// Difference of the number from `high`, at most half a unit in the last place of `high`.
    pub low: f64,
}

/// Factor 2²⁷ + 1, which splits a double into halves of 26 bits, so that products of halves are exact.
const SPLIT_FACTOR: f64 = 134_217_729.0;

/// Number of terms of the series of sine and cosine for angles up to π/8. The first omitted term is below 2⁻¹¹⁰ of the sum.
const SERIES_TERM_COUNT: i32 = 12;

/// Number of times that the angle is halved before the series is evaluated, and doubled afterwards.
const HALVING_COUNT: i32 = 4;

fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: b - (high - a) }
}

fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    let rounded_b = high - a;
    DoubleDouble { high, low: (a - (high - rounded_b)) + (b - rounded_b) }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, addend: Self) -> Self {
        let (high_sum, low_sum) = (two_sum(self.high, addend.high), two_sum(self.low, addend.low));
        let high_sum = quick_two_sum(high_sum.high, high_sum.low + low_sum.high);
        quick_two_sum(high_sum.high, high_sum.low + low_sum.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, subtrahend: Self) -> Self {
        self + Self { high: -subtrahend.high, low: -subtrahend.low }
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    /// Returns the product, with a relative error of at most 2⁻¹⁰².
    fn mul(self, factor: Self) -> Self {
        let high_product = Self::product(self.high, factor.high);
        quick_two_sum(high_product.high, high_product.low + (self.high * factor.low + self.low * factor.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    /// Returns the quotient, with a relative error of at most 2⁻¹⁰⁴: the quotient of doubles, corrected by its remainder.
    fn div(self, divisor: Self) -> Self {
        let quotient = self.high / divisor.high;
        let division_remainder = self - divisor * Self::from(quotient);
        quick_two_sum(quotient, division_remainder.high / divisor.high)
    }
}

impl DoubleDouble {
    /// Returns a · b without rounding error, as long as nothing under- or overflows.
    pub fn product(a: f64, b: f64) -> Self {
        let split_in_halves = |x: f64| {
            let scaled_x = SPLIT_FACTOR * x;
            let high = scaled_x - (scaled_x - x);
            [high, x - high]
        };
        let high = a * b;
        let ([a_high, a_low], [b_high, b_low]) = (split_in_halves(a), split_in_halves(b));
        Self { high, low: ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low }
    }

    /// Returns the double nearest to the number.
    pub fn to_f64(self) -> f64 {
        self.high + self.low
    }

    /// Returns the sine and cosine of an angle within a full circle, with an error below 1e-30.
    ///
    /// The function evaluates Taylor's series for a sixteenth of the angle, and then doubles the angle four times: sin 2a = 2 sin a cos a
    /// and 1 − cos 2a = 2 sin² a. Computing 1 − cos a instead of cos a loses no digits.
    pub fn sin_cos(self) -> (Self, Self) {
        let angle_divisor = f64::from(1 << HALVING_COUNT);
        let a = Self { high: self.high / angle_divisor, low: self.low / angle_divisor };
        let angle_squared = a * a;
        // The series are a − a³/3! + … for the sine, and ½a² − a⁴/4! + … for the versine 1 − cos a.
        let mut sine_sum = Self::from(1.0);
        let mut versine_sum = Self::from(1.0);
        for k in (1..SERIES_TERM_COUNT).rev() {
            let n = f64::from(2 * k);
            sine_sum = Self::from(1.0) - angle_squared * sine_sum / Self::from(n * (n + 1.0));
            versine_sum = Self::from(1.0) - angle_squared * versine_sum / Self::from((n + 1.0) * (n + 2.0));
        }
        let mut sine_sum = a * sine_sum;
        let mut versine_sum = angle_squared * versine_sum / Self::from(2.0);
        for _ in 0..HALVING_COUNT {
            let small_angle_cosine = Self::from(1.0) - versine_sum;
            let (half_sine, half_versine) = (sine_sum * small_angle_cosine, sine_sum * sine_sum);
            (sine_sum, versine_sum) = (half_sine + half_sine, half_versine + half_versine);
        }
        (sine_sum, Self::from(1.0) - versine_sum)
    }

    /// Returns sin(a)/a of an angle within a full circle, and 1 at 0.
    pub fn sinc(self) -> Self {
        if self.high == 0.0 { Self::from(1.0) } else { self.sin_cos().0 / self }
    }
}
