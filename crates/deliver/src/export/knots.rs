//! Few entries for a curve: straight lines between some of its points that stay close to all.
//!
//! From an entry the line goes to the farthest point that it can reach without leaving any point
//! in between by more than `within`: the slopes that do are a cone, which narrows from point to
//! point (Imai & Iri 1988; Reumann & Witkam 1974). All columns share the entries. One pass; for a
//! given number of entries `within` is halved and doubled until they suffice.

/// Indices of entries, the first and the last point among them, such that linear interpolation
/// misses no point of any column by more than `within`.
pub(super) fn entries_within(places: &[f64], columns: &[&[f64]], within: f64) -> Vec<usize> {
    let last = places.len().saturating_sub(1);
    let mut entries = vec![0];
    let mut from = 0;
    while from < last {
        from = farthest(places, columns, within, from);
        entries.push(from);
    }
    entries
}

fn farthest(places: &[f64], columns: &[&[f64]], within: f64, from: usize) -> usize {
    let mut cones = vec![(f64::NEG_INFINITY, f64::INFINITY); columns.len()];
    let mut reached = from + 1;
    for to in from + 1..places.len() {
        let run = places[to] - places[from];
        let slope = |column: &[f64], by: f64| (column[to] + by - column[from]) / run;
        let sees = |(column, cone): (&&[f64], &(f64, f64))| {
            let slope = slope(column, 0.0);
            slope >= cone.0 && slope <= cone.1
        };
        if columns.iter().zip(&cones).all(sees) {
            reached = to;
        }
        for (column, cone) in columns.iter().zip(&mut cones) {
            cone.0 = cone.0.max(slope(column, -within));
            cone.1 = cone.1.min(slope(column, within));
        }
        if cones.iter().any(|(low, high)| low > high) {
            break;
        }
    }
    reached
}

/// At most `most` entries (at least 2), missing the points by as little as that allows, but not by
/// less than `enough`, which would be waste.
pub(super) fn at_most(places: &[f64], columns: &[&[f64]], enough: f64, most: usize) -> Vec<usize> {
    let entries = entries_within(places, columns, enough);
    if entries.len() <= most || places.len() <= 2 {
        return entries;
    }
    let (mut too_fine, mut coarse) = (enough, enough.max(1e-12));
    let mut best = loop {
        coarse *= 2.0;
        let entries = entries_within(places, columns, coarse);
        if entries.len() <= most {
            break entries;
        }
        too_fine = coarse;
        if !coarse.is_finite() {
            // Only columns that are not finite come here.
            return vec![0, places.len() - 1];
        }
    };
    for _ in 0..40 {
        let middle = 0.5 * (too_fine + coarse);
        let entries = entries_within(places, columns, middle);
        if entries.len() <= most {
            (coarse, best) = (middle, entries);
        } else {
            too_fine = middle;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compensation::SortedTable;
    use proptest::prelude::*;

    fn missed(places: &[f64], column: &[f64], entries: &[usize]) -> f64 {
        let pick = |of: &[f64]| entries.iter().map(|k| of[*k]).collect();
        let table = SortedTable::new(pick(places), pick(column)).expect("it ascends");
        let off = places
            .iter()
            .zip(column)
            .map(|(q, v)| (table.at(*q) - v).abs());
        off.fold(0.0, f64::max)
    }

    #[test]
    fn a_line_needs_its_ends_and_a_corner_one_more() {
        let places: Vec<f64> = (0..=100).map(f64::from).collect();
        let line: Vec<f64> = places.iter().map(|q| 2.0 * q - 3.0).collect();
        assert_eq!(entries_within(&places, &[&line], 1e-9), [0, 100]);
        let corner: Vec<f64> = places.iter().map(|q| (q - 37.0).max(0.0)).collect();
        assert_eq!(
            entries_within(&places, &[&line, &corner], 1e-9),
            [0, 37, 100]
        );
    }

    #[test]
    fn few_entries_do_better_than_equal_steps_where_the_curve_is_local() {
        let places: Vec<f64> = (0..=2000).map(|k| f64::from(k) * 0.1).collect();
        let bump = |q: &f64| (-((q - 60.0) / 1.5).powi(2)).exp();
        let column: Vec<f64> = places.iter().map(bump).collect();
        let entries = at_most(&places, &[&column], 0.0, 21);
        assert!(entries.len() <= 21);
        let equal: Vec<usize> = (0..=20).map(|k| k * 100).collect();
        let (free, equal) = (
            missed(&places, &column, &entries),
            missed(&places, &column, &equal),
        );
        assert!(free < 0.05 * equal, "{free} {equal}");
    }

    proptest! {
        #[test]
        fn no_point_is_missed_by_more_than_was_asked(
            values in prop::collection::vec(-1.0..1.0f64, 2..80),
            within in 0.0..1.0f64,
        ) {
            let places: Vec<f64> = (0..values.len()).map(|k| k as f64 * 0.5).collect();
            let entries = entries_within(&places, &[&values], within);
            prop_assert_eq!(entries.first(), Some(&0));
            prop_assert_eq!(entries.last(), Some(&(values.len() - 1)));
            prop_assert!(missed(&places, &values, &entries) <= within + 1e-12);
        }
    }
}
