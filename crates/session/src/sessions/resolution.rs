//! The digit of a column of measured values: the largest step of which all of them are multiples.
//!
//! A value that was rounded to a step d carries an error of variance d²/12 that no repetition shows
//! (Widrow & Kollár, *Quantization Noise*, 2008). The steps that instruments and spreadsheets use are
//! 1, 2, 2.5 and 5 of a power of ten, of millimetres or inches, and halves of a millimetre or an inch;
//! of what was rounded in inches a file has fewer digits than that takes, so that a multiple may be
//! missed by half the last digit of the file.

/// With fewer different values a step is an accident.
const FEWEST: usize = 12;
/// So many values, spread evenly, are looked at.
const MOST: usize = 600;
/// The chance that values without a step look like multiples of one has to be below e to the minus this.
const EVIDENCE: f64 = 30.0;
/// Of so many values one may have been typed, or be of another instrument.
const STRANGERS: f64 = 0.005;
/// The finest digit that is looked for, mm.
const FINEST_MM: f64 = 1e-6;
/// One inch, mm.
const INCH_MM: f64 = 25.4;

/// The step of which the values are multiples, mm; `None` where none is found that is at least a
/// micrometre's thousandth. NaN is passed over.
pub fn resolution_mm(values: &[f64]) -> Option<f64> {
    let n = values.len();
    let every = n.div_ceil(MOST).max(1);
    let mut some: Vec<f64> = values
        .iter()
        .step_by(every)
        .map(|v| v.abs())
        .filter(|v| v.is_finite() && *v > 0.0)
        .collect();
    some.sort_by(f64::total_cmp);
    some.dedup();
    if some.len() < FEWEST {
        return None;
    }
    // What is written has so many digits; values that come from elsewhere have all of them.
    let written = decimal(&some);
    steps()
        .into_iter()
        .filter(|step| written.is_none_or(|digit| *step >= digit * 0.999))
        .find(|step| are_multiples(&some, *step, written))
}

/// Whether all values are multiples of a step, mm, however few they are.
pub fn is_rounded_to(values: &[f64], step: f64) -> bool {
    let mut some = values
        .iter()
        .filter(|v| v.is_finite())
        .take(MOST)
        .peekable();
    step > 0.0 && some.peek().is_some() && some.all(|v| misses(*v, step) < float(v.abs(), step))
}

/// Every step that is looked for, the largest first, mm.
fn steps() -> Vec<f64> {
    let mut all = Vec::new();
    for power in -6..=1 {
        let ten = 10.0_f64.powi(power);
        all.extend([1.0, 2.0, 2.5, 5.0].map(|own| own * ten));
        if power >= -5 {
            all.extend([1.0, 2.0, 5.0].map(|own| own * ten * INCH_MM / 10.0));
        }
    }
    for half in 1..=14 {
        let part = 0.5_f64.powi(half);
        all.extend([part, part * INCH_MM]);
    }
    all.retain(|step| (FINEST_MM..=10.0).contains(step));
    all.sort_by(|a, b| b.total_cmp(a));
    all
}

/// The decimal digit in which all values are written, mm.
fn decimal(values: &[f64]) -> Option<f64> {
    (0..=6).map(|places| 10.0_f64.powi(-places)).find(|digit| {
        values
            .iter()
            .all(|v| misses(*v, *digit) < float(*v, *digit))
    })
}

/// How far a value is from the nearest multiple of a step, in steps.
fn misses(value: f64, step: f64) -> f64 {
    let in_steps = value / step;
    (in_steps - in_steps.round()).abs()
}

/// What the representation of numbers alone misses, in steps.
fn float(value: f64, step: f64) -> f64 {
    1e-9 + 8.0 * f64::EPSILON * value / step
}

fn are_multiples(values: &[f64], step: f64, written: Option<f64>) -> bool {
    let of_digit = written.map_or(0.0, |digit| 0.501 * digit / step);
    // The step itself is written exactly: then half a digit is no excuse.
    let exact = written.is_some_and(|digit| misses(step, digit) < 1e-9);
    let window = |v: f64| float(v, step) + if exact { 0.0 } else { of_digit };
    let strangers = values.iter().filter(|v| misses(**v, step) > window(**v));
    let most = STRANGERS * values.len() as f64;
    if strangers.zip(1..).any(|(_, count)| f64::from(count) > most) {
        return false;
    }
    // Of values that are written to a digit so many are multiples of the step by accident.
    let by_accident = match written {
        Some(digit) => share_of_multiples(digit, step, if exact { 0.0 } else { of_digit }),
        None => 1e-3,
    };
    let least = written.is_some_and(|digit| (step / digit - 1.0).abs() < 1e-6);
    least || -(values.len() as f64) * by_accident.ln() > EVIDENCE
}

/// How many of the multiples of a digit are within a window, in steps, of a multiple of a step: all tenths are within
/// half a tenth of some multiple of an eighth.
fn share_of_multiples(digit: f64, step: f64, window: f64) -> f64 {
    let many = 1000;
    let within = |k: &i32| {
        let value = f64::from(*k) * digit;
        misses(value, step) <= window + float(value, step)
    };
    (1..=many).filter(within).count().max(1) as f64 / f64::from(many)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values all over the place.
    fn places(n: usize) -> Vec<f64> {
        (0..n)
            .map(|k| 400.0 * ((k as f64 * 0.618_033_988_7).fract() - 0.5))
            .collect()
    }

    fn rounded(values: &[f64], step: f64, places: i32) -> Vec<f64> {
        let ten = 10.0_f64.powi(places);
        let one = |v: &f64| ((v / step).round() * step * ten).round() / ten;
        values.iter().map(one).collect()
    }

    #[test]
    fn the_step_of_rounded_values_is_found() {
        for (step, places_written) in [
            (0.1, 6),
            (0.05, 6),
            (0.02, 4),
            (0.025, 4),
            (0.01, 2),
            (1.0, 3),
            (0.0254, 4),
            (0.0254, 6),
            (0.00254, 5),
            (0.25, 3),
            (0.031_25, 6),
        ] {
            let found = resolution_mm(&rounded(&places(60), step, places_written));
            let found = found.unwrap_or(0.0);
            assert!((found / step - 1.0).abs() < 1e-9, "{step}: {found}");
        }
    }

    #[test]
    fn every_tenth_is_near_a_multiple_of_an_eighth_and_so_says_nothing_for_it() {
        for places_written in 0..=4 {
            let digit = 10.0_f64.powi(-places_written);
            let found = resolution_mm(&rounded(&places(600), digit, places_written));
            let found = found.unwrap_or(0.0);
            assert!((found / digit - 1.0).abs() < 1e-9, "{digit}: {found}");
        }
    }

    #[test]
    fn values_without_a_step_have_the_digit_in_which_they_are_written() {
        let found = resolution_mm(&rounded(&places(80), 1e-4, 4)).unwrap_or(0.0);
        assert!((found - 1e-4).abs() < 1e-12, "{found}");
        assert_eq!(resolution_mm(&places(200)), None);
        // Few values, or the same again and again, tell nothing.
        assert_eq!(resolution_mm(&rounded(&places(8), 0.1, 1)), None);
        assert_eq!(resolution_mm(&[10.0; 100]), None);
        assert_eq!(resolution_mm(&[f64::NAN; 40]), None);
        assert_eq!(resolution_mm(&[]), None);
    }

    #[test]
    fn one_value_of_hundreds_that_was_typed_is_no_reason_to_doubt() {
        let mut values = rounded(&places(400), 0.1, 4);
        values[17] = 12.3456;
        let found = resolution_mm(&values).unwrap_or(0.0);
        assert!((found - 0.1).abs() < 1e-12, "{found}");
    }
}
