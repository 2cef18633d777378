//! Degrees for the file that become the very same radians again.
//!
//! Reading multiplies by π/180, writing has to undo that. The product is rounded, so that dividing
//! may miss by a bit; the neighbours are tried and the one with the fewest digits is taken, so that
//! 95.3 in a file stays 95.3. An angle that came from degrees always comes back to the last bit;
//! one that a program made in radians may lie between two products, and then moves by at most one
//! unit in the last place, once.

use crate::units::{deg_from_rad, rad_from_deg};

/// The degrees to write for this angle.
pub fn degrees(rad: f64) -> f64 {
    let near = deg_from_rad(rad);
    if near == 0.0 || !near.is_finite() {
        return near;
    }
    let below = near.next_down();
    let above = near.next_up();
    let candidates = [near, below, above, below.next_down(), above.next_up()];
    let exact = candidates
        .into_iter()
        .filter(|deg| rad_from_deg(*deg) == rad);
    let error = |deg: &f64| (rad_from_deg(*deg) - rad).abs();
    exact
        .min_by_key(|deg| digits(*deg))
        .or_else(|| {
            candidates
                .into_iter()
                .min_by(|a, b| error(a).total_cmp(&error(b)))
        })
        .unwrap_or(near)
}

/// Length of the shortest text that reads as this number.
fn digits(value: f64) -> usize {
    use std::fmt::Write;
    struct Length(usize);
    impl Write for Length {
        fn write_str(&mut self, text: &str) -> std::fmt::Result {
            self.0 += text.len();
            Ok(())
        }
    }
    let mut length = Length(0);
    // Counting never fails.
    let _ = write!(length, "{value:e}");
    length.0
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn degrees_of_a_file_stay_as_they_were_written() {
        for i in -40_000..40_000 {
            let deg = f64::from(i) / 100.0;
            assert_eq!(degrees(rad_from_deg(deg)), deg);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        #[test]
        fn what_came_from_degrees_comes_back_to_the_last_bit(deg in prop::num::f64::NORMAL) {
            let rad = rad_from_deg(deg);
            prop_assume!(rad.is_normal() && deg.abs() < 1e300);
            prop_assert_eq!(rad_from_deg(degrees(rad)).to_bits(), rad.to_bits());
        }

        #[test]
        fn any_angle_moves_by_one_bit_at_most_and_only_once(rad in -1e4..1e4f64) {
            let once = rad_from_deg(degrees(rad));
            prop_assert!(once == rad || once == rad.next_up() || once == rad.next_down());
            prop_assert_eq!(rad_from_deg(degrees(once)), once);
        }
    }
}
