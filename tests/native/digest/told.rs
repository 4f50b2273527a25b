//! Digest of a machine's results: the same bytes as digest.js makes of the JavaScript results.

use motion::geom::se2::SE2;
use nalgebra::{Matrix3, Vector3};
use sha2::{Digest, Sha256};

/// Bits that are written for every NaN. IEEE 754 and WebAssembly leave sign and payload of a computed NaN open, and processors and
/// engines differ in them.
const NAN: u64 = 0x7ff8_0000_0000_0000;

/// Values that can be written as doubles, in eight bytes each, the lowest byte first. A list is preceded by its length;
/// a missing value is NaN.
pub trait Told {
    fn tell(&self, bytes: &mut Vec<u8>);
}

impl Told for f64 {
    fn tell(&self, bytes: &mut Vec<u8>) {
        let bits = if self.is_nan() { NAN } else { self.to_bits() };
        bytes.extend(bits.to_le_bytes());
    }
}

macro_rules! told_as_double {
    ($($type:ty),+) => {$(
        impl Told for $type {
            fn tell(&self, bytes: &mut Vec<u8>) {
                (*self as f64).tell(bytes);
            }
        }
    )+};
}
told_as_double!(u8, u32, usize);

impl Told for bool {
    fn tell(&self, bytes: &mut Vec<u8>) {
        u8::from(*self).tell(bytes);
    }
}

impl<T: Told> Told for [T] {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.len().tell(bytes);
        self.iter().for_each(|each| each.tell(bytes));
    }
}

impl<T: Told, const N: usize> Told for [T; N] {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.as_slice().tell(bytes);
    }
}

impl<T: Told> Told for Vec<T> {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.as_slice().tell(bytes);
    }
}

impl<T: Told> Told for Option<T> {
    fn tell(&self, bytes: &mut Vec<u8>) {
        match self {
            Some(value) => value.tell(bytes),
            None => f64::NAN.tell(bytes),
        }
    }
}

impl Told for Vector3<f64> {
    fn tell(&self, bytes: &mut Vec<u8>) {
        self.as_slice().tell(bytes);
    }
}

impl Told for Matrix3<f64> {
    fn tell(&self, bytes: &mut Vec<u8>) {
        <[[f64; 3]; 3]>::from(*self).tell(bytes);
    }
}

impl Told for SE2 {
    fn tell(&self, bytes: &mut Vec<u8>) {
        [self.x(), self.y(), self.theta()].iter().for_each(|number| number.tell(bytes));
    }
}

/// Named part of a machine's results, with its hash.
pub struct Part(pub &'static str, pub String);

impl Part {
    pub fn new(name: &'static str, told: &[&dyn Told]) -> Self {
        let mut bytes = Vec::new();
        told.iter().for_each(|each| each.tell(&mut bytes));
        // With 64 bits, one change in 10¹⁹ would go unnoticed.
        Self(name, hex(&Sha256::digest(bytes))[..16].to_owned())
    }
}

pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
