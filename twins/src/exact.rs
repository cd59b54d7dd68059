//! Exact signs and accurately rounded values of sums of products (J. R. Shewchuk, "Adaptive Precision Floating-Point
//! Arithmetic and Fast Robust Geometric Predicates", 1997).
//!
//! The results are exact unless the last bit of a product falls below 2^-1074. With vertices of 32-bit floats, this
//! happens only for points whose coordinates are finer than 2^-700.

/// Unevaluated sum of a 64-bit value and its rounding error, the value first.
pub(super) type Pair = [f64; 2];

/// a b - c d, exactly. The arguments have at most 24 significant bits, like 32-bit floats.
pub(super) fn difference_of_products(a: f64, b: f64, c: f64, d: f64) -> Pair {
    two_sum(a * b, -(c * d))
}

/// Inner product of a vector of exact coefficients and a point, rounded. Its sign is exact, and its relative error is
/// below 2^-51.
pub(super) fn dot(coefficients: &[Pair; 3], point: [f64; 3]) -> f64 {
    let mut terms = [0.0; 12];
    let factors = coefficients.iter().zip(point).flat_map(|([high, low], x)| [(*high, x), (*low, x)]);
    for (pair, (coefficient, x)) in terms.chunks_exact_mut(2).zip(factors) {
        pair.copy_from_slice(&two_product(coefficient, x));
    }
    sum(&terms)
}

/// The same inner product with an exact sign, and an error of at most 2^-50 of the sum of its terms' sizes. It is much faster.
pub(super) fn estimate(coefficients: &[Pair; 3], point: [f64; 3]) -> f64 {
    let (mut value, mut size) = (0.0, 0.0);
    for ([high, _], x) in coefficients.iter().zip(point) {
        value += high * x;
        size += (high * x).abs();
    }
    // Each term is rounded at most four times, each time by up to 2^-53 of its size. The rest is a margin for products
    // that underflow.
    if value.abs() <= size * 2.0_f64.powi(-50) + f64::MIN_POSITIVE {
        value = dot(coefficients, point);
    }
    value
}

/// Sign of the same inner product: 1, 0 or -1.
pub(super) fn dot_sign(coefficients: &[Pair; 3], point: [f64; 3]) -> i8 {
    let value = estimate(coefficients, point);
    i8::from(value > 0.0) - i8::from(value < 0.0)
}

/// Sum a + b and its rounding error (Knuth).
fn two_sum(a: f64, b: f64) -> Pair {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    [sum, (a - a_part) + (b - b_part)]
}

/// Product a b and its rounding error.
fn two_product(a: f64, b: f64) -> Pair {
    let product = a * b;
    [product, a.mul_add(b, -product)]
}

/// Sum of twelve terms, rounded once after it was computed exactly: the terms are added to an expansion of
/// non-overlapping components, which are summed from the smallest.
fn sum(terms: &[f64; 12]) -> f64 {
    let mut expansion = [0.0; 12];
    // Products of values with few bits have no rounding error.
    let terms = terms.iter().filter(|term| **term != 0.0);
    for (count, term) in terms.enumerate() {
        let mut carry = *term;
        for component in expansion.iter_mut().take(count) {
            [carry, *component] = two_sum(carry, *component);
        }
        if let Some(component) = expansion.get_mut(count) {
            *component = carry;
        }
    }
    expansion.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sign survives cancellation that leaves one unit in the last place of a product's error.
    #[test]
    fn sign_survives_cancellation() {
        let epsilon = 2.0_f64.powi(-52);
        let big = 1.0 + epsilon;
        // (1 + e)^2 - (1 + 2 e) = e^2, which rounds away in 64 bits.
        let coefficients = [[big, 0.0], [-(1.0 + 2.0 * epsilon), 0.0], [0.0, 0.0]];
        assert_eq!(big * big - (1.0 + 2.0 * epsilon), 0.0);
        assert_eq!(dot_sign(&coefficients, [big, 1.0, 0.0]), 1);
        assert_eq!(dot(&coefficients, [big, 1.0, 0.0]), epsilon * epsilon);
    }

    /// The low parts of the coefficients decide if the high parts cancel.
    #[test]
    fn low_parts_decide() {
        let coefficients = [[1.0, -1e-30], [-1.0, 0.0], [0.0, 0.0]];
        assert_eq!(dot_sign(&coefficients, [3.0, 3.0, 1.0]), -1);
        assert_eq!(dot_sign(&[[0.0, 0.0]; 3], [3.0, 3.0, 1.0]), 0);
    }

    /// Signs near zero agree with those of 128-bit integers.
    #[test]
    fn agrees_with_integers() {
        let mut state = 1_u64;
        let mut next = |bits: u32| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as i64 % (1 << bits)
        };
        for _ in 0..20_000 {
            let [a, b, c, x, y] = [24, 24, 3, 24, 24].map(&mut next);
            // c z is close to -(a x + b y), so that a x + b y + c z is near zero.
            let z = -(a * x + b * y) / c.max(1);
            let exact = i128::from(a) * i128::from(x) + i128::from(b) * i128::from(y) + i128::from(c) * i128::from(z);
            let pairs = [a, b, c].map(|v| [v as f64, 0.0]);
            let point = [x, y, z].map(|v| v as f64);
            assert_eq!(i128::from(dot_sign(&pairs, point)), exact.signum());
            assert_eq!(dot(&pairs, point), exact as f64);
        }
    }
}
