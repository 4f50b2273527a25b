//! Bytes as numbers and choices.

use std::ops::RangeInclusive;

/// Remaining bytes of the input. After its end all bytes are 0.
pub struct Input<'a>(pub &'a [u8]);

/// Returns true for one in `one_in` inputs, chosen by a hash of all their bytes. Slow checks run for those only.
///
/// A byte of the input is no choice for that, because most mutations of the input keep it.
pub fn turn_of(one_in: u64, bytes: &[u8]) -> bool {
    // FNV-1a.
    let mix = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    let hash = bytes.iter().fold(0xcbf2_9ce4_8422_2325, mix);
    (hash >> 32) % one_in == 0
}

/// Limits of ranges, of settings or of the formats of numbers.
const LIMITS: [f64; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::from_bits(1),
    f64::MIN_POSITIVE,
    f64::EPSILON,
    1e-6,
    0.01,
    std::f64::consts::FRAC_PI_2,
    std::f64::consts::PI,
    -std::f64::consts::PI,
    std::f64::consts::TAU,
    1e5,
    1e6,
    -1e6,
    1_000_000.000_000_000_1,
    1e7,
    1e18,
    9_007_199_254_740_991.0,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
];

impl Input<'_> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let Some((first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        *first
    }

    pub fn bytes<const N: usize>(&mut self) -> [u8; N] {
        std::array::from_fn(|_| self.byte())
    }

    pub fn truth(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// Returns a whole number from 0 that is less than `count`.
    pub fn choice(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count
    }

    pub fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.choice(choices.len())]
    }

    /// Returns any double: a round one, a limit of a range, or one with any bits.
    pub fn number(&mut self) -> f64 {
        match self.choice(8) {
            0 => f64::from_le_bytes(self.bytes()),
            1 => self.of(&LIMITS),
            2 => f64::from(self.byte() as i8),
            3 => f64::from(self.byte() as i8) * 10f64.powi(i32::from(self.byte() as i8) / 4),
            4 => f64::from(i16::from_le_bytes(self.bytes())) * 1e-4,
            _ => f64::from(i16::from_le_bytes(self.bytes())) * 0.01,
        }
    }

    /// Returns a double, mostly in this range.
    pub fn near(&mut self, range: &RangeInclusive<f64>) -> f64 {
        let number = self.number();
        if self.choice(8) == 0 || number.is_nan() {
            return number;
        }
        number.clamp(*range.start(), *range.end())
    }

    /// Returns a double in this range.
    pub fn within(&mut self, range: RangeInclusive<f64>) -> f64 {
        let number = self.number();
        if number.is_nan() { *range.start() } else { number.clamp(*range.start(), *range.end()) }
    }

    /// Returns a whole number, mostly in this range.
    pub fn whole_near(&mut self, range: &RangeInclusive<u64>) -> u64 {
        let whole = match self.choice(4) {
            0 => u64::from_le_bytes(self.bytes()),
            1 => u64::from(u16::from_le_bytes(self.bytes())),
            _ => u64::from(self.byte()),
        };
        if self.choice(8) == 0 { whole } else { whole.clamp(*range.start(), *range.end()) }
    }
}
