//! The one way in which this crate computes a squared distance.

/// Squared distance of two points in the square of their unit, as `((dx*dx) + (dy*dy)) + (dz*dz)` in `f32`.
///
/// Every query of this crate decides by this value, so a loop over all points that calls this function is its
/// specification. The order of the two points does not matter.
///
/// # Numerics
///
/// Each step is rounded to nearest, never fused. Squares overflow to infinity from coordinate differences of
/// about 1.8e19 and lose bits below about 1e-19, down to zero near 2.6e-23; queries then see ties, and resolve
/// them as such. No result is negative, and none is NaN unless an argument is, or both are infinite.
#[inline]
pub fn distance_squared(a: [f32; 3], b: [f32; 3]) -> f32 {
    let dx = a[0] - b[0];
    let dy = a[1] - b[1];
    let dz = a[2] - b[2];
    ((dx * dx) + (dy * dy)) + (dz * dz)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_symmetric_to_the_bit_and_adds_from_x_to_z() {
        let (a, b) = ([0.1, 0.7, -3.3], [5.9, 1e-4, 0.2]);
        assert_eq!(distance_squared(a, b).to_bits(), distance_squared(b, a).to_bits());
        // 1 + 2^-24 rounds back to 1 twice, whereas (2^-24 + 2^-24) + 1 would not.
        let tiny = 2f32.powi(-12);
        assert_eq!(distance_squared([1.0, tiny, tiny], [0.0; 3]), 1.0);
    }

    #[test]
    fn overflows_to_infinity_and_underflows_to_zero() {
        assert_eq!(distance_squared([1e30, 0.0, 0.0], [0.0; 3]), f32::INFINITY);
        assert_eq!(distance_squared([f32::MAX; 3], [f32::MIN; 3]), f32::INFINITY);
        assert_eq!(distance_squared([1e-30, 0.0, 0.0], [0.0; 3]), 0.0);
    }
}
