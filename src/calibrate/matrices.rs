//! Products and inverses of the small matrices of the likelihood.

use nalgebra::{Matrix3, SMatrix};

/// Returns the product of two matrices.
#[inline(always)]
pub(super) fn product<const N: usize>(left: &Matrix3<f64>, right: &SMatrix<f64, 3, N>) -> SMatrix<f64, 3, N> {
    transposed_product(&left.transpose(), right)
}

/// Returns the product of the transpose of a matrix and another matrix. In WebAssembly a call of nalgebra's general product takes longer than the
/// product itself; the module would be larger if this one were inlined there.
#[cfg_attr(target_arch = "wasm32", inline(never))]
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
pub(super) fn transposed_product<const M: usize, const N: usize>(
    left: &SMatrix<f64, 3, M>,
    right: &SMatrix<f64, 3, N>,
) -> SMatrix<f64, M, N> {
    let mut product = SMatrix::<f64, M, N>::zeros();
    for (product_column, [x, y, z]) in product.data.0.iter_mut().zip(&right.data.0) {
        for (entry, [a, b, c]) in product_column.iter_mut().zip(&left.data.0) {
            *entry = a * x + b * y + c * z;
        }
    }
    product
}

/// Returns xᵀ M x.
#[inline(always)]
pub(super) fn quadratic_form<const N: usize>(matrix: &SMatrix<f64, N, N>, x: &[f64; N]) -> f64 {
    let columns = matrix.data.0.iter().zip(x);
    columns.map(|(column, x_j)| x_j * column.iter().zip(x).map(|(entry, x_i)| entry * x_i).sum::<f64>()).sum()
}

/// Returns the covariance J C Jᵀ of a linear function with the Jacobian J.
#[inline(always)]
pub(super) fn propagated(jacobian: &Matrix3<f64>, covariance: &Matrix3<f64>) -> Matrix3<f64> {
    product(&product(jacobian, covariance), &jacobian.transpose())
}

/// Relative amount by which the diagonal of a matrix is increased before it is inverted, because rows may be collinear.
const REGULARIZATION: f64 = 1e-9;

/// Returns the inverse of the submatrix that a mask selects, with 0 elsewhere, and the logarithm of its determinant. The matrix is an
/// information. Variables without information are not selected.
pub(super) fn masked_inverse<const N: usize>(
    information: &SMatrix<f64, N, N>,
    mask: &[bool; N],
) -> (SMatrix<f64, N, N>, f64) {
    // The diagonal is scaled to 1, because variables differ by orders of magnitude.
    let scales: [f64; N] = std::array::from_fn(|i| {
        if mask[i] && information[(i, i)] > 0.0 { 1.0 / information[(i, i)].sqrt() } else { 0.0 }
    });
    let scaled_information = SMatrix::<f64, N, N>::from_fn(|i, j| {
        if i == j { 1.0 + REGULARIZATION } else { information[(i, j)] * scales[i] * scales[j] }
    });
    let Some(cholesky) = nalgebra::Cholesky::new(scaled_information) else { return (SMatrix::zeros(), 0.0) };
    let inverse = cholesky.inverse();
    let selected_scales = scales.iter().filter(|scale| **scale > 0.0);
    let log_det =
        cholesky.ln_determinant() - 2.0 * selected_scales.map(|scale| libm::log(*scale)).sum::<f64>();
    (SMatrix::from_fn(|i, j| inverse[(i, j)] * scales[i] * scales[j]), log_det)
}
