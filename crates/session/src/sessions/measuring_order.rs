//! The order in which samples were measured: that of the file, unless a clock contradicts it.
//!
//! A file that was sorted after the measurement (by angle, by target) keeps the times of its rows, and
//! whatever depends on what came before (travel since a reversal, drift, slow noise) needs the clock's
//! order. A clock that begins anew (a restart, midnight, the next visit) is none of that: then the time
//! falls back to where it began.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a share of a number of rows"
)]

/// So many falls of the clock, or this share of the samples, are no accident of one row.
const LEAST_FALLS: usize = 2;
const LEAST_SHARE: f64 = 0.02;
/// A clock that falls back to within so many usual steps of its beginning has begun anew.
const ANEW: f64 = 0.5;

/// How often the clock runs backwards without beginning anew, where that is no accident; else `None`.
/// A missing time is NaN.
pub fn falls_of_the_clock(time_s: &[f64]) -> Option<usize> {
    let mut last = f64::NAN;
    let (mut falls, mut first) = (0, f64::INFINITY);
    for &time in time_s.iter().filter(|time| time.is_finite()) {
        falls += usize::from(time < last);
        first = first.min(time);
        last = time;
    }
    let least = LEAST_FALLS.max((LEAST_SHARE * time_s.len() as f64).ceil() as usize);
    if falls < least {
        return None;
    }
    let known: Vec<f64> = time_s.iter().copied().filter(|t| t.is_finite()).collect();
    let mut steps: Vec<f64> = known.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.retain(|step| *step > 0.0);
    steps.sort_by(f64::total_cmp);
    let step = steps.get(steps.len() / 2).copied().unwrap_or(0.0);
    let sorted = known
        .windows(2)
        .filter(|pair| pair[1] < pair[0] && pair[1] > first + ANEW * step)
        .count();
    (sorted >= least).then_some(sorted)
}

/// The samples in the order in which they were measured, where that is not the order of the file. A
/// sample without a time stays behind the one before it.
pub fn measuring_order(time_s: Option<&[f64]>) -> Option<Vec<usize>> {
    let time_s = time_s?;
    falls_of_the_clock(time_s)?;
    let mut last = f64::NEG_INFINITY;
    let bridged: Vec<f64> = time_s
        .iter()
        .map(|&time| {
            if time.is_finite() {
                last = time;
            }
            last
        })
        .collect();
    let mut order: Vec<usize> = (0..time_s.len()).collect();
    order.sort_by(|a, b| bridged[*a].total_cmp(&bridged[*b]).then(a.cmp(b)));
    Some(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Times 8 s apart, in the order of some other column.
    fn sorted_by(other: impl Fn(usize) -> usize, n: usize) -> Vec<f64> {
        let mut rows: Vec<usize> = (0..n).collect();
        rows.sort_by_key(|row| other(*row));
        rows.iter().map(|row| 8.0 * *row as f64).collect()
    }

    #[test]
    fn a_file_that_was_sorted_is_put_back_into_the_order_of_its_clock() {
        let time_s = sorted_by(|row| row * 37 % 80, 80);
        let order = measuring_order(Some(&time_s)).expect("sorted");
        let times: Vec<f64> = order.iter().map(|row| time_s[*row]).collect();
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
        // By target as well.
        assert!(measuring_order(Some(&sorted_by(|row| row % 5, 80))).is_some());
    }

    #[test]
    fn a_clock_that_begins_anew_leaves_the_order_of_the_file() {
        let visits: Vec<f64> = (0..120).map(|row| f64::from(row % 20) * 8.0).collect();
        assert_eq!(measuring_order(Some(&visits)), None);
        let as_measured: Vec<f64> = (0..120).map(f64::from).collect();
        assert_eq!(measuring_order(Some(&as_measured)), None);
        // One time that was typed wrong.
        let mut one = as_measured;
        one[40] = 90.0;
        assert_eq!(measuring_order(Some(&one)), None);
        for time_s in [&[][..], &[1.0], &[f64::NAN, f64::NAN, f64::NAN], &[3.0; 5]] {
            assert_eq!(measuring_order(Some(time_s)), None);
        }
        assert_eq!(measuring_order(None), None);
    }

    #[test]
    fn a_sample_without_a_time_stays_behind_the_one_before_it() {
        let mut time_s = sorted_by(|row| row * 37 % 80, 80);
        time_s[10] = f64::NAN;
        let order = measuring_order(Some(&time_s)).expect("sorted");
        let at = |row| order.iter().position(|own| *own == row);
        assert_eq!(at(10), at(9).map(|at| at + 1));
    }
}
