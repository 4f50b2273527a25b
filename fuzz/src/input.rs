//! Reader of numbers and choices from the bytes of a fuzz input.

use std::ops::RangeInclusive;

/// Remaining bytes of a fuzz input. After its end, bytes are read as 0.
pub struct InputReader<'a>(pub &'a [u8]);

/// Returns true for one in `selection_interval` inputs, selected by a hash of all bytes. Slow checks run for the selected inputs only.
///
/// A single byte cannot select inputs, because most mutations of an input keep that byte.
pub fn is_selected_by_hash(selection_interval: u64, input_bytes: &[u8]) -> bool {
    // Hash function FNV-1a.
    let mix_byte =
        |input_hash: u64, byte: &u8| (input_hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    let input_hash = input_bytes.iter().fold(0xcbf2_9ce4_8422_2325, mix_byte);
    (input_hash >> 32) % selection_interval == 0
}

/// Limits of the ranges of settings, and limits of the range of doubles.
const RANGE_AND_DOUBLE_LIMITS: [f64; 24] = [
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

impl InputReader<'_> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn next_byte(&mut self) -> u8 {
        let Some((first_byte, remaining_bytes)) = self.0.split_first() else { return 0 };
        self.0 = remaining_bytes;
        *first_byte
    }

    pub fn next_bytes<const N: usize>(&mut self) -> [u8; N] {
        std::array::from_fn(|_| self.next_byte())
    }

    pub fn next_bool(&mut self) -> bool {
        self.next_byte() & 1 == 1
    }

    /// Returns a random integer from 0 to `exclusive_limit` − 1.
    pub fn next_below(&mut self, exclusive_limit: usize) -> usize {
        usize::from(self.next_byte()) % exclusive_limit
    }

    pub fn choose_one<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.next_below(choices.len())]
    }

    /// Returns an arbitrary double: a round number, a limit of a range, or any bits.
    pub fn next_number(&mut self) -> f64 {
        match self.next_below(8) {
            0 => f64::from_le_bytes(self.next_bytes()),
            1 => self.choose_one(&RANGE_AND_DOUBLE_LIMITS),
            2 => f64::from(self.next_byte() as i8),
            3 => f64::from(self.next_byte() as i8) * 10f64.powi(i32::from(self.next_byte() as i8) / 4),
            4 => f64::from(i16::from_le_bytes(self.next_bytes())) * 1e-4,
            _ => f64::from(i16::from_le_bytes(self.next_bytes())) * 0.01,
        }
    }

    /// Returns a random double, mostly in the given range.
    pub fn draw_number_near(&mut self, range: &RangeInclusive<f64>) -> f64 {
        let drawn_number = self.next_number();
        if self.next_below(8) == 0 || drawn_number.is_nan() {
            return drawn_number;
        }
        drawn_number.clamp(*range.start(), *range.end())
    }

    /// Returns a random double in the given range.
    pub fn draw_number_within(&mut self, range: RangeInclusive<f64>) -> f64 {
        let number = self.next_number();
        if number.is_nan() { *range.start() } else { number.clamp(*range.start(), *range.end()) }
    }

    /// Returns a random whole number, mostly in the given range.
    pub fn draw_integer_near(&mut self, range: &RangeInclusive<u64>) -> u64 {
        let integer = match self.next_below(4) {
            0 => u64::from_le_bytes(self.next_bytes()),
            1 => u64::from(u16::from_le_bytes(self.next_bytes())),
            _ => u64::from(self.next_byte()),
        };
        if self.next_below(8) == 0 { integer } else { integer.clamp(*range.start(), *range.end()) }
    }
}
