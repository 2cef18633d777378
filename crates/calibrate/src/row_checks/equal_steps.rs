//! Commands on an equal grid: of a wave along the joint they show orders below half a turn over the
//! step only; orders above it look like others ("aliases").

/// With fewer different values a grid is an accident.
const FEWEST: usize = 6;
/// A value may miss its place by so large a share of the step: what controllers round.
const MISSES: f64 = 1e-3;

/// The step of the grid on which all values of a joint are, in their unit; `None` where they are on
/// none. NaN is passed over; the grid need not be full.
pub fn equal_step(values: &[f64]) -> Option<f64> {
    let mut all: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    all.sort_by(f64::total_cmp);
    let (first, last) = (*all.first()?, *all.last()?);
    let same = 1e-7 * (last - first);
    all.dedup_by(|b, a| (*b - *a).abs() <= same);
    if all.len() < FEWEST {
        return None;
    }
    let gaps = all.windows(2).map(|pair| pair[1] - pair[0]);
    let step = gaps.fold(f64::INFINITY, f64::min);
    // A share of what an even grid would have is left out at most: else any step would do.
    let places = (last - first) / step;
    if places > 4.0 * all.len() as f64 {
        return None;
    }
    // The ends tell the step best.
    let step = (last - first) / places.round();
    let on_grid = |value: &f64| {
        let place = (value - first) / step;
        (place - place.round()).abs() < MISSES
    };
    all.iter().all(on_grid).then_some(step)
}

/// The largest order (waves a turn) that equal steps of so many radians can tell from all below it.
pub fn largest_order(step_rad: f64) -> f64 {
    std::f64::consts::PI / step_rad
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_equal_grid_has_its_step() {
        let grid: Vec<f64> = (0..69).map(|k| -170.0 + 5.0 * f64::from(k)).collect();
        assert!((equal_step(&grid).unwrap_or(0.0) - 5.0).abs() < 1e-12);
        // In any order, with repeats, with holes, and with what is missing.
        let some = grid.iter().chain(&grid).copied().enumerate();
        let mut some: Vec<f64> = some.filter(|(k, _)| k % 3 != 1).map(|(_, v)| v).collect();
        some.reverse();
        assert!((equal_step(&some).unwrap_or(0.0) - 5.0).abs() < 1e-9);
        assert!((equal_step(&[&grid[..], &[f64::NAN]].concat()).unwrap_or(0.0) - 5.0).abs() < 1e-9);
        assert!((largest_order(5.0_f64.to_radians()) - 36.0).abs() < 1e-9);
    }

    #[test]
    fn uneven_values_are_on_no_grid() {
        let uneven: Vec<f64> = (0..69)
            .map(|k| -170.0 + 5.0 * f64::from(k) + (f64::from(k) * 1.7).sin())
            .collect();
        assert_eq!(equal_step(&uneven), None);
        assert_eq!(equal_step(&[]), None);
        assert_eq!(equal_step(&[1.0; 30]), None);
        assert_eq!(equal_step(&[1.0, 2.0, 3.0]), None);
    }
}
