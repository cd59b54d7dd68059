//! Eigenvectors of small symmetric matrices, by Jacobi's method (G. Golub and C. Van Loan, "Matrix Computations", 4th
//! edition, section 8.5).

/// An eigenvalue and its unit eigenvector.
#[derive(Clone, Copy, Debug)]
pub(super) struct Eigen<const N: usize> {
    pub value: f64,
    pub vector: [f64; N],
}

/// Largest number of sweeps; about six suffice.
const SWEEPS: u32 = 50;

/// Eigenvalues and eigenvectors of a symmetric matrix, the smallest eigenvalue first.
pub(super) fn symmetric<const N: usize>(mut a: [[f64; N]; N]) -> [Eigen<N>; N] {
    let mut vectors = [[0.0; N]; N];
    for (i, vector) in vectors.iter_mut().enumerate() {
        vector[i] = 1.0;
    }
    for _ in 0..SWEEPS {
        let off: f64 = pairs::<N>().map(|(p, q)| a[p][q] * a[p][q]).sum();
        let size: f64 = a.as_flattened().iter().map(|v| v * v).sum();
        if off <= 1e-34 * size {
            break;
        }
        for (p, q) in pairs::<N>() {
            if a[p][q] == 0.0 {
                continue;
            }
            // This rotation in the plane of p and q makes their common element 0.
            let theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
            let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
            let c = 1.0 / t.hypot(1.0);
            let s = t * c;
            for row in &mut a {
                [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
            }
            for i in 0..N {
                [a[p][i], a[q][i]] = [c * a[p][i] - s * a[q][i], s * a[p][i] + c * a[q][i]];
                let [x, y] = [vectors[p][i], vectors[q][i]];
                [vectors[p][i], vectors[q][i]] = [c * x - s * y, s * x + c * y];
            }
        }
    }
    let mut found = vectors.map(|vector| Eigen { value: 0.0, vector });
    for (i, eigen) in found.iter_mut().enumerate() {
        eigen.value = a[i][i];
    }
    found.sort_by(|x, y| x.value.total_cmp(&y.value));
    found
}

/// Indices of the elements above the diagonal.
fn pairs<const N: usize>() -> impl Iterator<Item = (usize, usize)> {
    (0..N).flat_map(|p| (p + 1..N).map(move |q| (p, q)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_eigenvalues() {
        // The matrix has the eigenvalues 1, 2 and 4 with the eigenvectors (1, -1, 0), (1, 1, -1) and (1, 1, 2),
        // scaled.
        let vectors = [[1.0, -1.0, 0.0], [1.0, 1.0, -1.0], [1.0, 1.0, 2.0]];
        let mut matrix = [[0.0; 3]; 3];
        for (value, vector) in [1.0, 2.0, 4.0].into_iter().zip(vectors) {
            let squared: f64 = vector.iter().map(|v| v * v).sum();
            for i in 0..3 {
                for j in 0..3 {
                    matrix[i][j] += value * vector[i] * vector[j] / squared;
                }
            }
        }
        for ((found, value), vector) in symmetric(matrix).iter().zip([1.0, 2.0, 4.0]).zip(vectors) {
            assert!((found.value - value).abs() < 1e-12);
            let dot: f64 = found.vector.iter().zip(vector).map(|(a, b)| a * b).sum();
            let squared: f64 = vector.iter().map(|v| v * v).sum();
            assert!((dot.abs() - squared.sqrt()).abs() < 1e-12);
        }
    }
}
