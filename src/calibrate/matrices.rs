//! Products of the small matrices of the likelihood.
//!
//! In WebAssembly a call of a general product takes longer than the product itself. Products are therefore inlined, except two whose
//! code is long. Products of wide matrices use explicit SIMD vectors.

// Loops over indices compile to less code than iterators over two arrays.
#![allow(clippy::needless_range_loop)]

use nalgebra::{Matrix3, SMatrix};
use wide::{bytemuck, f64x2};

/// Number of columns of a wide matrix.
pub(super) const WIDTH: usize = 8;

const VECTORS_PER_ROW: usize = WIDTH / 2;

/// Matrix of `ROWS` rows and [`WIDTH`] columns, stored row by row.
#[derive(Clone, Copy, Debug)]
pub(super) struct WideMatrix<const ROWS: usize>([[f64x2; VECTORS_PER_ROW]; ROWS]);

impl<const ROWS: usize> WideMatrix<ROWS> {
    pub const ZERO: Self = Self([[f64x2::ZERO; VECTORS_PER_ROW]; ROWS]);

    pub fn from_fn(entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut matrix = Self::ZERO;
        for row in 0..ROWS {
            (0..WIDTH).for_each(|column| matrix.row_mut(row)[column] = entry(row, column));
        }
        matrix
    }

    #[inline(always)]
    pub fn row(&self, row: usize) -> &[f64; WIDTH] {
        bytemuck::cast_ref(&self.0[row])
    }

    #[inline(always)]
    pub fn row_mut(&mut self, row: usize) -> &mut [f64; WIDTH] {
        bytemuck::cast_mut(&mut self.0[row])
    }

    /// Returns a block of this matrix that begins at `column` of its first row.
    pub fn block<const R: usize, const C: usize>(&self, column: usize) -> SMatrix<f64, R, C> {
        SMatrix::from_fn(|i, j| self.row(i)[column + j])
    }

    /// Returns vᵀ M v with M the first `ROWS` columns of this matrix, and v the first `ROWS` entries of `vector`.
    #[inline(always)]
    pub fn quadratic_form(&self, vector: &[f64; WIDTH]) -> f64 {
        let mut product = [f64x2::ZERO; VECTORS_PER_ROW];
        for row in 0..ROWS {
            for pair in 0..VECTORS_PER_ROW {
                product[pair] += f64x2::splat(vector[row]) * self.0[row][pair];
            }
        }
        let product: &[f64; WIDTH] = bytemuck::cast_ref(&product);
        let mut sum = 0.0;
        for row in 0..ROWS {
            sum += product[row] * vector[row];
        }
        sum
    }

    /// Adds the product of the transpose of `left`'s first `ROWS` columns and `right`.
    #[inline(always)]
    pub fn add_product(&mut self, left: &WideMatrix<3>, right: &WideMatrix<3>) {
        for row in 0..ROWS {
            let left_column = [left.row(0)[row], left.row(1)[row], left.row(2)[row]];
            let product = right.row_combination(left_column);
            for pair in 0..VECTORS_PER_ROW {
                self.0[row][pair] += product[pair];
            }
        }
    }
}

impl WideMatrix<3> {
    /// Returns the product `left` · `self`.
    #[inline(never)]
    pub fn left_multiplied(&self, left: &Matrix3<f64>) -> Self {
        let mut product = Self::ZERO;
        for row in 0..3 {
            product.0[row] = self.row_combination([left[(row, 0)], left[(row, 1)], left[(row, 2)]]);
        }
        product
    }

    #[inline(always)]
    pub fn with_added(mut self, other: &Self) -> Self {
        for row in 0..3 {
            for pair in 0..VECTORS_PER_ROW {
                self.0[row][pair] += other.0[row][pair];
            }
        }
        self
    }

    /// Returns a linear combination of the rows.
    #[inline(always)]
    fn row_combination(&self, [a, b, c]: [f64; 3]) -> [f64x2; VECTORS_PER_ROW] {
        let [a, b, c] = [f64x2::splat(a), f64x2::splat(b), f64x2::splat(c)];
        let mut sum = [f64x2::ZERO; VECTORS_PER_ROW];
        for pair in 0..VECTORS_PER_ROW {
            sum[pair] = a * self.0[0][pair] + b * self.0[1][pair] + c * self.0[2][pair];
        }
        sum
    }
}

/// Returns the product of two matrices.
#[inline(never)]
pub(super) fn product(left: &Matrix3<f64>, right: &Matrix3<f64>) -> Matrix3<f64> {
    let mut product = Matrix3::zeros();
    for column in 0..3 {
        for row in 0..3 {
            product[(row, column)] = left[(row, 0)] * right[(0, column)]
                + left[(row, 1)] * right[(1, column)]
                + left[(row, 2)] * right[(2, column)];
        }
    }
    product
}

/// Returns the inverse of a matrix (0 if the matrix is singular), and its determinant.
#[inline(always)]
pub(super) fn inverse(matrix: &Matrix3<f64>) -> (Matrix3<f64>, f64) {
    let row = |row: usize| [matrix[(row, 0)], matrix[(row, 1)], matrix[(row, 2)]];
    let [a, b, c] = [row(0), row(1), row(2)];
    let first_cofactors = cross_product(&b, &c);
    let determinant = a[0] * first_cofactors[0] + a[1] * first_cofactors[1] + a[2] * first_cofactors[2];
    let adjugate = Matrix3::from([first_cofactors, cross_product(&c, &a), cross_product(&a, &b)]);
    (if determinant == 0.0 { Matrix3::zeros() } else { adjugate / determinant }, determinant)
}

#[inline(always)]
fn cross_product(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
