//! Round values along an axis.

/// The largest power of ten that is not above a value above 0, to the last bit on every system: logarithms
/// and powers that a system brings may be a bit off.
#[expect(clippy::cast_possible_truncation, reason = "an exponent")]
#[doc(hidden)]
pub fn decade(value: f64) -> f64 {
    let at = value.log10().floor() as i32;
    let next = ten_to(at + 1);
    if next <= value { next } else { ten_to(at) }
}

fn ten_to(exponent: i32) -> f64 {
    let power = (0..exponent.unsigned_abs()).fold(1.0, |power, _| 10.0 * power);
    if exponent < 0 { 1.0 / power } else { power }
}

/// The largest of these leading digits, or 1, × 10ⁿ that is not above `value`; 1 where that makes
/// no sense.
#[doc(hidden)]
pub fn among(value: f64, digits: &[f64]) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let ten = decade(value);
    let lead = value / ten * (1.0 + 1e-12);
    let digit = digits.iter().copied().find(|d| lead >= *d).unwrap_or(1.0);
    digit * ten
}

/// Round values between two ends, at most about `most` of them, and their distance: in degrees
/// parts of a turn.
pub fn ticks([low, high]: [f64; 2], degrees: bool, most: f64) -> (Vec<f64>, f64) {
    const PARTS_OF_A_TURN: [f64; 9] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0];
    let wanted = (high - low) / most;
    if !(wanted.is_finite() && wanted > 0.0) {
        return (Vec::new(), 1.0);
    }
    let step = if degrees && wanted > 0.5 {
        let mut parts = PARTS_OF_A_TURN.into_iter();
        parts.find(|part| *part >= wanted).unwrap_or(360.0)
    } else {
        let below = among(wanted, &[5.0, 2.0]);
        if below >= wanted * (1.0 - 1e-9) {
            below
        } else {
            among(2.5 * below, &[5.0, 2.0])
        }
    };
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    let values = (0..50_u8).map(|k| first + f64::from(k));
    let values = values.take_while(|k| *k <= last).map(|k| k * step);
    (values.collect(), step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decade_is_the_power_of_ten_itself() {
        for exponent in -12..=12 {
            let power: f64 = format!("1e{exponent}").parse().unwrap();
            for lead in [1.0, 1.0 + 1e-12, 4.0, 9.999] {
                assert_eq!(decade(lead * power), power, "{lead} e{exponent}");
            }
        }
        assert_eq!(among(0.3, &[3.0]), 3.0 * 0.1);
    }

    #[test]
    fn degrees_are_divided_into_parts_of_a_turn() {
        let (marks, step) = ticks([-95.0, 95.0], true, 9.0);
        assert_eq!(marks, [-90.0, -60.0, -30.0, 0.0, 30.0, 60.0, 90.0]);
        assert_eq!(step, 30.0);
    }

    #[test]
    fn lengths_are_divided_decimally() {
        let values = |bounds, most| ticks(bounds, false, most).0;
        assert_eq!(
            values([-0.9, 14.0], 9.0),
            [0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0]
        );
        assert_eq!(values([0.0, 3.3], 4.0), [0.0, 1.0, 2.0, 3.0]);
        assert!(values([f64::NAN, 1.0], 9.0).is_empty());
        assert!(values([1.0, 1.0], 4.0).is_empty());
    }
}
