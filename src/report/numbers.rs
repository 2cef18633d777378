//! Numbers as a reader wants them: as many digits as the interval supports, a real minus sign.

/// A length in mm, as [`plain`].
pub(super) fn mm(value: f64) -> String {
    format!("{} mm", plain(value))
}

/// A value without a unit, four decimals; scientific where those would show nothing. What is left
/// of rounding is 0.
pub(super) fn plain(value: f64) -> String {
    if value.abs() > 1e-9 && value.abs() < 5e-5 {
        return minus(&format!("{value:.1e}"));
    }
    if value.abs() >= 1e7 {
        return minus(&format!("{value:.4e}"));
    }
    minus(&format!("{value:.4}"))
}

/// At most four decimals, without trailing zeros.
pub(super) fn short(value: f64) -> String {
    let text = plain(value);
    if text.contains('e') || !text.contains('.') {
        return text;
    }
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "−0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

/// A size with three significant digits.
pub(super) fn three_digits(size: f64) -> String {
    if size.abs() < 1e-9 {
        return "0".to_owned();
    }
    minus(&format!("{size:.*}", decimals_for(size, 3)))
}

/// A value and its interval, with two significant digits of half its width.
pub(super) fn with_interval(value: f64, interval: Option<[f64; 2]>) -> (String, String) {
    let Some([low, high]) = interval else {
        return (plain(value), "not determined".to_owned());
    };
    let half = (high - low) / 2.0;
    let decimals = if half > 0.0 {
        decimals_for(half, 2).min(6)
    } else {
        6
    };
    let show = |v: f64| minus(&format!("{v:.decimals$}"));
    (show(value), format!("{} … {}", show(low), show(high)))
}

/// Decimals at which `size` shows so many significant digits.
fn decimals_for(size: f64, digits: i32) -> usize {
    let magnitude = if size == 0.0 || !size.is_finite() {
        0.0
    } else {
        size.abs().log10().floor()
    };
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to a small whole number"
    )]
    let decimals = (f64::from(digits) - 1.0 - magnitude).clamp(0.0, 9.0) as usize;
    decimals
}

fn minus(text: &str) -> String {
    let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero {
        text.trim_start_matches('-').to_owned()
    } else {
        text.replace('-', "−")
    }
}

/// The unit that a parameter's name carries.
pub(super) fn unit_of(name: &str) -> (&str, &'static str) {
    const UNITS: [(&str, &str); 14] = [
        ("_urad_per_nm", "µrad/(N·m)"),
        ("_deg_per_degc", "°/°C"),
        ("deg_per_degc", "°/°C"),
        ("ppm_per_degc", "ppm/°C"),
        ("mm_per_degc", "mm/°C"),
        ("_mm_per_h", "mm/h"),
        ("mm_per_kg", "mm/kg"),
        ("_mrad", "mrad"),
        ("_rad", "rad"),
        ("_deg", "°"),
        ("_ppm", "ppm"),
        ("_mm", "mm"),
        ("_um", "µm"),
        ("_s", "s"),
    ];
    for (ending, unit) in UNITS {
        if let Some(stem) = name.strip_suffix(ending) {
            return (stem, unit);
        }
    }
    (name, "")
}

/// The name of a parameter in words, with its unit.
pub(super) fn in_words(name: &str) -> (String, &'static str) {
    let (stem, unit) = unit_of(name);
    let stem = if stem.is_empty() { "value" } else { stem };
    (stem.replace('_', " "), unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_follow_the_interval() {
        let (value, interval) = with_interval(-0.350486, Some([-0.351278, -0.349695]));
        assert_eq!((&*value, &*interval), ("−0.35049", "−0.35128 … −0.34969"));
        assert_eq!(with_interval(2.0, None).1, "not determined");
        assert_eq!(plain(-0.0), "0.0000");
        assert_eq!(short(250.0), "250");
        assert_eq!(short(-1.5), "−1.5");
        assert_eq!(three_digits(0.00376), "0.00376");
        assert_eq!(plain(3e-9), "3.0e−9");
    }

    #[test]
    fn units_come_from_names() {
        assert_eq!(in_words("amplitude_deg"), ("amplitude".to_owned(), "°"));
        assert_eq!(in_words("mm_per_kg"), ("value".to_owned(), "mm/kg"));
        assert_eq!(in_words("x_mm_per_h"), ("x".to_owned(), "mm/h"));
        assert_eq!(in_words("about_x_mrad"), ("about x".to_owned(), "mrad"));
    }
}
