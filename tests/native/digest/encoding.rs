//! Digest of the results of a simulation. The digested bytes equal those that digest.js makes from the JavaScript results.

use motion::geom::se2::SE2;
use nalgebra::{Matrix3, Vector3};
use sha2::{Digest, Sha256};

/// Bits that are written for every NaN, because IEEE 754 and WebAssembly leave the sign and payload of a computed NaN open.
const NAN_BITS: u64 = 0x7ff8_0000_0000_0000;

/// Encoding of values as doubles of eight bytes, with the lowest byte first. A list begins with its length, a tuple stands
/// for the fields of an object, and a missing value is NaN.
pub trait Encode {
    fn encode(&self, encoded_bytes: &mut Vec<u8>);
}

impl Encode for f64 {
    fn encode(&self, encoded_bytes: &mut Vec<u8>) {
        let double_bits = if self.is_nan() { NAN_BITS } else { self.to_bits() };
        encoded_bytes.extend(double_bits.to_le_bytes());
    }
}

macro_rules! encode_as {
    ($($type:ty: |$value:ident| $other:expr;)+) => {$(
        impl Encode for $type {
            fn encode(&self, bytes: &mut Vec<u8>) {
                let $value = self;
                $other.encode(bytes);
            }
        }
    )+};
}
encode_as! {
    u8: |value| f64::from(*value);
    u32: |value| f64::from(*value);
    usize: |value| (*value as f64);
    bool: |value| u8::from(*value);
    Vector3<f64>: |value| value.as_slice();
    Matrix3<f64>: |value| <[[f64; 3]; 3]>::from(*value);
    SE2: |pose| (pose.x(), pose.y(), pose.theta());
}

impl<T: Encode> Encode for [T] {
    fn encode(&self, encoded_bytes: &mut Vec<u8>) {
        self.len().encode(encoded_bytes);
        self.iter().for_each(|list_item| list_item.encode(encoded_bytes));
    }
}

impl<T: Encode, const N: usize> Encode for [T; N] {
    fn encode(&self, encoded_bytes: &mut Vec<u8>) {
        self.as_slice().encode(encoded_bytes);
    }
}

impl<T: Encode> Encode for Vec<T> {
    fn encode(&self, encoded_bytes: &mut Vec<u8>) {
        self.as_slice().encode(encoded_bytes);
    }
}

impl<T: Encode> Encode for Option<T> {
    fn encode(&self, encoded_bytes: &mut Vec<u8>) {
        match self {
            Some(present_value) => present_value.encode(encoded_bytes),
            None => f64::NAN.encode(encoded_bytes),
        }
    }
}

macro_rules! encode_fields {
    ($($($name:ident)+;)+) => {$(
        impl<$($name: Encode),+> Encode for ($($name,)+) {
            #[allow(non_snake_case)]
            fn encode(&self, bytes: &mut Vec<u8>) {
                let ($($name,)+) = self;
                $($name.encode(bytes);)+
            }
        }
    )+};
}
encode_fields! {
    A B;
    A B C;
    A B C D;
    A B C D E;
    A B C D E F;
    A B C D E F G;
}

pub struct HashedPart(pub &'static str, pub String);

impl HashedPart {
    pub fn new(part_name: &'static str, part_results: impl Encode) -> Self {
        let mut encoded_bytes = Vec::new();
        part_results.encode(&mut encoded_bytes);
        // The first 64 bits of the hash are enough: only one change in 10¹⁹ would go unnoticed.
        Self(part_name, format_hex(&Sha256::digest(encoded_bytes))[..16].to_owned())
    }
}

pub fn format_hex(encoded_bytes: &[u8]) -> String {
    encoded_bytes.iter().map(|digest_byte| format!("{digest_byte:02x}")).collect()
}
