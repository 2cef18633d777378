//! Samples are worked on in blocks of [`LANES`], so that one virtual call serves many samples and
//! the compiler can turn the loops into vector instructions.
//!
//! [`sin_cos`] is branch-free for the same reason. Its polynomials are the minimax kernels on
//! [−π/4, π/4] of degree 13 and 14 that fdlibm made common; the argument is reduced by
//! subtracting n·π/2 in three parts (Cody & Waite 1980).

/// Samples in a block.
pub const LANES: usize = 64;

/// One number for each sample of a block.
pub type Lanes = [f64; LANES];

/// A vector for each sample of a block: x, y and z lanes.
pub type Lanes3 = [Lanes; 3];

/// Adding and subtracting this rounds a double to a whole number (1.5·2⁵²).
const ROUNDER: f64 = 6755399441055744.0;
/// π/2 in parts of 33 bits, so that their product with a whole number below 2²⁰ is exact.
const HALF_PI_1: f64 = f64::from_bits(0x3FF9_21FB_5440_0000);
const HALF_PI_2: f64 = f64::from_bits(0x3DD0_B461_1A60_0000);
const HALF_PI_3: f64 = f64::from_bits(0x3BA3_198A_2E03_7073);

/// Sine and cosine of an angle in rad, to about one unit in the last place for |x| below 10⁶.
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    let shifted = x * std::f64::consts::FRAC_2_PI + ROUNDER;
    let n = shifted - ROUNDER;
    let quadrant = shifted.to_bits();
    let r = ((x - n * HALF_PI_1) - n * HALF_PI_2) - n * HALF_PI_3;

    let z = r * r;
    let sin_tail = -1.66666666666666324348e-1
        + z * (8.33333333332248946124e-3
            + z * (-1.98412698298579493134e-4
                + z * (2.75573137070700676789e-6
                    + z * (-2.50507602534068634195e-8 + z * 1.58969099521155010221e-10))));
    let sin_r = r + r * z * sin_tail;
    let cos_tail = 4.16666666666666019037e-2
        + z * (-1.38888888888741095749e-3
            + z * (2.48015872894767294178e-5
                + z * (-2.75573143513906633035e-7
                    + z * (2.08757232129817482790e-9 + z * -1.13596475577881948265e-11))));
    // 1 − z/2 loses the last bits of z; they are put back.
    let half = 0.5 * z;
    let one_less = 1.0 - half;
    let cos_r = one_less + (((1.0 - one_less) - half) + z * z * cos_tail);

    // Odd quadrants swap sine and cosine; bit 1 gives the signs.
    let swap = (quadrant & 1).wrapping_neg();
    let (s, c) = (sin_r.to_bits(), cos_r.to_bits());
    let sin_sign = (quadrant & 2) << 62;
    let cos_sign = ((quadrant.wrapping_add(1)) & 2) << 62;
    (
        f64::from_bits(((s & !swap) | (c & swap)) ^ sin_sign),
        f64::from_bits(((c & !swap) | (s & swap)) ^ cos_sign),
    )
}

/// Cross product of two vectors.
#[inline]
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Scalar product of two vectors.
#[inline]
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a + b·k`.
#[inline]
pub fn add_scaled(a: [f64; 3], b: [f64; 3], k: f64) -> [f64; 3] {
    [a[0] + b[0] * k, a[1] + b[1] * k, a[2] + b[2] * k]
}

/// `a − b`.
#[inline]
pub fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a·k`.
#[inline]
pub fn scaled(a: [f64; 3], k: f64) -> [f64; 3] {
    [a[0] * k, a[1] * k, a[2] * k]
}

/// `m·v`, m by rows.
#[inline]
pub fn times(m: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

/// The vector turned about a unit axis by the angle whose sine and cosine are given (Rodrigues).
#[inline]
pub fn turned(v: [f64; 3], axis: [f64; 3], sin: f64, cos: f64) -> [f64; 3] {
    let along = dot(axis, v) * (1.0 - cos);
    let across = cross(axis, v);
    [
        v[0] * cos + across[0] * sin + axis[0] * along,
        v[1] * cos + across[1] * sin + axis[1] * along,
        v[2] * cos + across[2] * sin + axis[2] * along,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sine_and_cosine_agree_with_the_standard_library(x in -1.0e6..1.0e6_f64) {
            let (s, c) = sin_cos(x);
            prop_assert!((s - x.sin()).abs() < 2.3e-16, "sin {x}: {s}");
            prop_assert!((c - x.cos()).abs() < 2.3e-16, "cos {x}: {c}");
        }
    }

    #[test]
    fn quadrants_and_zero_are_exact() {
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        let (s, c) = sin_cos(std::f64::consts::FRAC_PI_2);
        assert_eq!(s, 1.0);
        assert!(c.abs() < 1e-16);
        assert_eq!(sin_cos(std::f64::consts::PI).1, -1.0);
    }
}
