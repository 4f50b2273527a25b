//! Vectors and matrices as plain arrays, for serialization.

use nalgebra::{Matrix3, Vector3};
use serde::{Serialize, Serializer};

pub fn vector<S: Serializer>(vector: &Vector3<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    <[f64; 3]>::from(*vector).serialize(serializer)
}

/// Converts a symmetric matrix to three arrays of three. Its columns are equal to its rows.
pub fn matrix<S: Serializer>(matrix: &Matrix3<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    <[[f64; 3]; 3]>::from(*matrix).serialize(serializer)
}
