//! A quasi-random point set that is good at any length.

/// Dimensions: three for the point on the receiver, three for the lamp, two for the direction.
pub(crate) const DIMENSIONS: usize = 8;

/// Point number `index` of the Kronecker sequence of the generalised golden ratio (Roberts 2018), moved by `shift`
/// around the unit cube (Cranley and Patterson 1976). With independent shifts the means of two sets are independent and
/// unbiased.
pub(crate) fn point(index: u64, shift: &[f64; DIMENSIONS]) -> [f64; DIMENSIONS] {
    std::array::from_fn(|axis| {
        // 64-bit fixed point keeps every digit however long the sequence.
        let turned = index.wrapping_mul(STEPS[axis]) as f64 / 18_446_744_073_709_551_616.0;
        let moved = turned + shift[axis];
        (if moved >= 1.0 { moved - 1.0 } else { moved }).clamp(f64::EPSILON, 1.0 - f64::EPSILON)
    })
}

/// The fractions of the powers of 1 / g in units of 2^-64, where g^9 = g + 1.
const STEPS: [u64; DIMENSIONS] = steps();

const fn steps() -> [u64; DIMENSIONS] {
    // Fixed point by Newton's iteration, which a constant can do in plain arithmetic.
    let mut g = 1.0f64;
    let mut round = 0;
    while round < 60 {
        let mut power = 1.0;
        let mut i = 0;
        while i < DIMENSIONS {
            power *= g;
            i += 1;
        }
        let ninth = power * g;
        g -= (ninth - g - 1.0) / (9.0 * power - 1.0);
        round += 1;
    }
    let mut steps = [0; DIMENSIONS];
    let mut fraction = 1.0;
    let mut axis = 0;
    while axis < DIMENSIONS {
        fraction /= g;
        steps[axis] = (fraction * 18_446_744_073_709_551_616.0) as u64 | 1;
        axis += 1;
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_converge_faster_than_random_ones() {
        let n = 4096;
        let mean: f64 = (0..n)
            .map(|i| {
                let p = point(i, &[0.3; DIMENSIONS]);
                p.iter().map(|x| (std::f64::consts::TAU * x).cos() + x).sum::<f64>()
            })
            .sum::<f64>()
            / n as f64;
        // Random points would be off by about sqrt(8 (1/2 + 1/12) / 4096) = 0.034.
        assert!((mean - 4.0).abs() < 0.003, "{mean}");
    }
}
