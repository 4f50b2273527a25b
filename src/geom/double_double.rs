//! Double-double arithmetic: numbers with twice the digits of a double, for checking formulas in doubles.
//!
//! A number is the sum of two doubles, 106 bits in all. The second double is at most half a unit in the last place of the first. Sums
//! and products use the error-free transformations of Dekker (Numerische Mathematik 18, 1971) and Knuth.

use std::ops::{Add, Mul, Neg, Sub};

/// A number as `high` + `low`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    /// Nearest double.
    pub high: f64,
    /// Remainder, at most half a unit in the last place of `high`.
    pub low: f64,
}

/// 2²⁷ + 1 splits a double into halves of 26 bits, whose products are exact.
const SPLITTER: f64 = 134_217_729.0;

/// Number of terms of the series of sine and cosine for angles up to π/8. The first omitted term is below 2⁻¹¹⁰ of the sum.
const SERIES_TERM_COUNT: i32 = 12;

/// Number of times that the angle is halved before the series, and doubled after it.
const HALVING_COUNT: i32 = 4;

/// Returns a + b without rounding error, if |a| ≥ |b|.
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: b - (high - a) }
}

/// Returns a + b without rounding error.
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

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    /// Returns the sum, with a relative error of at most 2⁻¹⁰⁵.
    fn add(self, other: Self) -> Self {
        let (sum, low_sum) = (two_sum(self.high, other.high), two_sum(self.low, other.low));
        let sum = quick_two_sum(sum.high, sum.low + low_sum.high);
        quick_two_sum(sum.high, sum.low + low_sum.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    /// Returns the product, with a relative error of at most 2⁻¹⁰².
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        quick_two_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl DoubleDouble {
    /// Returns a · b without rounding error, as long as nothing under- or overflows.
    pub fn product(a: f64, b: f64) -> Self {
        let split_in_halves = |x: f64| {
            let scaled_x = SPLITTER * x;
            let high = scaled_x - (scaled_x - x);
            [high, x - high]
        };
        let high = a * b;
        let ([a1, a2], [b1, b2]) = (split_in_halves(a), split_in_halves(b));
        Self { high, low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 }
    }

    /// Returns the nearest double.
    pub fn to_f64(self) -> f64 {
        self.high + self.low
    }

    /// Returns the quotient by a double, with a relative error of at most 2⁻¹⁰⁴.
    pub fn divided_by(self, divisor: f64) -> Self {
        let high = self.high / divisor;
        let remainder = self - Self::product(high, divisor);
        quick_two_sum(high, remainder.high / divisor)
    }

    /// Returns the sine and cosine of an angle within a full circle, with an error below 1e-30.
    ///
    /// It evaluates Taylor's series for a sixteenth of the angle, and then doubles the angle four times: sin 2a = 2 sin a cos a
    /// and 1 − cos 2a = 2 sin² a. Computing 1 − cos a instead of cos a loses no digits.
    pub fn sin_cos(self) -> (Self, Self) {
        let angle_divisor = f64::from(1 << HALVING_COUNT);
        let a = Self { high: self.high / angle_divisor, low: self.low / angle_divisor };
        let angle_squared = a * a;
        // Sine a − a³/3! + …, and versine 1 − cos a = ½a² − a⁴/4! + …
        let mut sine = Self::from(1.0);
        let mut versine = Self::from(1.0);
        for k in (1..SERIES_TERM_COUNT).rev() {
            let n = f64::from(2 * k);
            sine = Self::from(1.0) - (angle_squared * sine).divided_by(n * (n + 1.0));
            versine = Self::from(1.0) - (angle_squared * versine).divided_by((n + 1.0) * (n + 2.0));
        }
        let mut sine = a * sine;
        let mut versine = (angle_squared * versine).divided_by(2.0);
        for _ in 0..HALVING_COUNT {
            let cosine = Self::from(1.0) - versine;
            (sine, versine) = (times_two(sine * cosine), times_two(sine * sine));
        }
        (sine, Self::from(1.0) - versine)
    }

    /// Returns sin(a)/a of an angle as [`DoubleDouble::sin_cos`] takes it; 1 at 0.
    pub fn sinc(self) -> Self {
        if self.high == 0.0 {
            return Self::from(1.0);
        }
        let (sine, _) = self.sin_cos();
        // A quotient in doubles, corrected by its remainder.
        let quotient = sine.high / self.high;
        let remainder = sine - self * Self::from(quotient);
        quick_two_sum(quotient, remainder.high / self.high)
    }
}

fn times_two(x: DoubleDouble) -> DoubleDouble {
    DoubleDouble { high: 2.0 * x.high, low: 2.0 * x.low }
}
