//! Sine and cosine of several angles at once, in a form that the compiler turns into vector code.
//!
//! ```text
//! x = k π/2 + r,   k whole, |r| ≤ π/4:   sin x and cos x are ± sin r or ± cos r, as k mod 4 says
//! sin r = r − r³/3! + … + r¹⁷/17!,       cos r = 1 − r²/2! + … + r¹⁶/16!
//! ```
//!
//! The terms left out are below 3e-18. π/2 is subtracted in two parts, the first of 33 bits, so that k times it is
//! exact for |k| < 2²⁰; the rounding of the second is below 1e-21 (Cody & Waite, *Software Manual for the Elementary
//! Functions*, 1980). There is no branch and no table in the loop, so two or four angles go through the processor
//! together; an angle too large for the reduction is left to the standard library, and the answer for each angle does
//! not depend on the others.
//!
//! Largest absolute error: 2.3e-16 over ±1e5 rad, against the standard library (a test).

use std::f64::consts::FRAC_2_PI;

use crate::lanes::{LANES, Lanes};

/// Beyond this angle (rad) k π/2 is no longer exact enough.
const LARGEST_RAD: f64 = 1e5;

const HALF_PI_HIGH: f64 = 1.5707963267341256;
const HALF_PI_LOW: f64 = 6.077100506506192e-11;

/// Adding 1.5·2⁵² leaves no bits for a fraction: the sum is rounded to a whole number, which is then in the low bits.
const ROUNDING: f64 = 6755399441055744.0;

/// Writes the sines and cosines of `angles_rad`; all three slices have one length.
#[inline(always)]
#[allow(
    clippy::inline_always,
    reason = "a part of wide loops: only what stands inside them is compiled for wide vectors"
)]
pub fn sin_cos_all(angles_rad: &[f64], sines: &mut [f64], cosines: &mut [f64]) {
    let count = angles_rad.len();
    let (sines, cosines) = (&mut sines[..count], &mut cosines[..count]);
    if are_small(angles_rad) {
        for i in 0..count {
            (sines[i], cosines[i]) = sin_cos_small(angles_rad[i]);
        }
    } else {
        for i in 0..count {
            (sines[i], cosines[i]) = sin_cos(angles_rad[i]);
        }
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "as sin_cos_all")]
fn are_small(angles_rad: &[f64]) -> bool {
    // Not a comparison with > : a NaN has to take the careful way too.
    angles_rad
        .iter()
        .fold(true, |small, angle| small & (angle.abs() <= LARGEST_RAD))
}

/// Sine and cosine of one angle, rad.
#[inline]
pub fn sin_cos(angle_rad: f64) -> (f64, f64) {
    if angle_rad.abs() <= LARGEST_RAD {
        sin_cos_small(angle_rad)
    } else {
        angle_rad.sin_cos()
    }
}

/// Sine and cosine of one angle of moderate size, rad: nothing is checked, so that a loop around it
/// becomes vector code. As good as [`sin_cos`] up to 1e5 rad, to 1e-9 up to 1e7, and finite for
/// every finite angle up to 1e15.
#[inline(always)]
#[allow(
    clippy::inline_always,
    reason = "the loop above becomes vector code only with this body inside it"
)]
pub fn sin_cos_small(x: f64) -> (f64, f64) {
    let shifted = x * FRAC_2_PI + ROUNDING;
    let quadrant = shifted.to_bits();
    let k = shifted - ROUNDING;
    let r = (x - k * HALF_PI_HIGH) - k * HALF_PI_LOW;
    let r2 = r * r;

    // Estrin's grouping: the terms in pairs, so that few of them wait for each other.
    let r4 = r2 * r2;
    let r8 = r4 * r4;
    let sine_low = (-1.0 / 6.0 + r2 * (1.0 / 120.0)) + r4 * (-1.0 / 5040.0 + r2 * (1.0 / 362880.0));
    let sine_high = (-1.0 / 39916800.0 + r2 * (1.0 / 6227020800.0))
        + r4 * (-1.0 / 1307674368000.0 + r2 * (1.0 / 355687428096000.0));
    let sine = r + r * r2 * (sine_low + r8 * sine_high);
    let cosine_low =
        (1.0 / 24.0 + r2 * (-1.0 / 720.0)) + r4 * (1.0 / 40320.0 + r2 * (-1.0 / 3628800.0));
    let cosine_high =
        (1.0 / 479001600.0 + r2 * (-1.0 / 87178291200.0)) + r4 * (1.0 / 20922789888000.0);
    let cosine = 1.0 - (0.5 * r2 - r4 * (cosine_low + r8 * cosine_high));

    // Odd quadrants exchange the two; the second bit of k, or of k + 1, is the sign.
    let exchange = 0u64.wrapping_sub(quadrant & 1);
    let (s, c) = (sine.to_bits(), cosine.to_bits());
    let sine_bits = (s & !exchange) | (c & exchange);
    let cosine_bits = (c & !exchange) | (s & exchange);
    let sine_sign = (quadrant & 2) << 62;
    let cosine_sign = (quadrant.wrapping_add(1) & 2) << 62;
    (
        f64::from_bits(sine_bits ^ sine_sign),
        f64::from_bits(cosine_bits ^ cosine_sign),
    )
}

/// Sines and cosines of angles of moderate size in all lanes, each as [`sin_cos_small`] has it.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as sin_cos_all")]
pub fn sin_cos_lanes(angles_rad: &Lanes) -> (Lanes, Lanes) {
    let (mut sines, mut cosines) = ([0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        (sines[i], cosines[i]) = sin_cos_small(angles_rad[i]);
    }
    (sines, cosines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_4, PI};

    fn assert_agrees(angle: f64) {
        let (sine, cosine) = sin_cos(angle);
        let (true_sine, true_cosine) = angle.sin_cos();
        assert!((sine - true_sine).abs() <= 2.3e-16, "sin {angle}");
        assert!((cosine - true_cosine).abs() <= 2.3e-16, "cos {angle}");
    }

    #[test]
    fn it_agrees_with_the_standard_library_to_the_last_digit() {
        for step in -200_000..=200_000 {
            assert_agrees(f64::from(step) * 7.7e-5);
            assert_agrees(f64::from(step) * 0.499_93);
        }
    }

    #[test]
    fn it_agrees_at_every_border_of_a_quadrant() {
        for eighth in -4000..=4000 {
            let border = f64::from(eighth) * FRAC_PI_4;
            for angle in [border, border.next_up(), border.next_down()] {
                assert_agrees(angle);
            }
        }
    }

    #[test]
    fn small_angles_keep_their_relative_digits() {
        for exponent in 1..300 {
            let angle = 10.0_f64.powi(-exponent);
            let (sine, _) = sin_cos(angle);
            assert!((sine / angle.sin() - 1.0).abs() < 3e-16);
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
    }

    #[test]
    fn huge_angles_and_nan_take_the_standard_way() {
        for angle in [1e6, -1e15, 1e300] {
            assert_eq!(sin_cos(angle), angle.sin_cos());
        }
        let mut sines = [0.0; 3];
        let mut cosines = [0.0; 3];
        sin_cos_all(&[PI, f64::NAN, 1e9], &mut sines, &mut cosines);
        assert!(sines[1].is_nan() && cosines[1].is_nan());
        assert_eq!((sines[2], cosines[2]), 1e9_f64.sin_cos());
    }
}
