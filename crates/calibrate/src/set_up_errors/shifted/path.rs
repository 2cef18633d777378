//! The likeliest path of shifts through the rows.

use crate::fit::problem::unusable;
use crate::model::Positions;
use crate::sessions::{Samples, Session};
use crate::text::Text;
use nalgebra::Vector3;

use crate::set_up_errors::nearest::cost_of;

/// More changes than this are no points that were lost.
const MOST_CHANGES: usize = 8;
/// The median length of three coordinates with σ = 1.
pub(super) const MEDIAN_LENGTH: f64 = 1.538;
/// Shifts that are tried, to either side.
pub(super) const MOST_SHIFT: isize = 3;
const STATES: usize = 2 * MOST_SHIFT as usize + 1;
/// The logarithm of the penalty of a change, in addition to that of its place.
const PRICE: f64 = 6.0;
/// What a row without a point costs: as much as one 3 σ off.
const WITHOUT_A_POINT: f64 = 4.0;
/// A row whose point would be behind an end of the file, or would be one that was not measured: a shift that only
/// takes rows out fits nothing.
const NO_POINT_THERE: f64 = 20.0;
/// A shift that ends again has given at least so many rows a point.
const FEWEST_IN_A_ROW: usize = 3;
/// Rows to either side between which the place of a change is sought again.
const NEAR: usize = 4;

/// The measured points of a session; a row whose point does not count has none.
pub(super) struct Points<'s> {
    samples: &'s Samples,
    counts: Vec<bool>,
    size_mm: f64,
}

impl<'s> Points<'s> {
    /// `None` where too few rows have a point.
    pub(super) fn of(session: &'s Session) -> Option<Self> {
        let samples = &session.samples;
        let counts = (0..samples.len()).map(|row| unusable(session, row).is_none());
        let mut points = Self {
            samples,
            counts: counts.collect(),
            size_mm: 0.0,
        };
        let known = || (0..points.len()).filter_map(|row| points.get(row));
        let n = known().count();
        if n < FEWEST_SAMPLES {
            return None;
        }
        let mean: Vector3<f64> = known().sum::<Vector3<f64>>() / n as f64;
        let squares = known().map(|p| (p - mean).norm_squared());
        let variance = squares.sum::<f64>() / n as f64;
        points.size_mm = variance.sqrt();
        (variance > 0.0).then_some(points)
    }

    pub(super) fn len(&self) -> usize {
        self.counts.len()
    }

    /// Spread of the points about their mean, root mean square, mm.
    pub(super) fn size_mm(&self) -> f64 {
        self.size_mm
    }

    pub(super) fn get(&self, row: usize) -> Option<Vector3<f64>> {
        let counts = self.counts.get(row).copied().unwrap_or(false);
        counts.then(|| {
            let [x, y, z] = self.samples.coordinates(row);
            // Of points in a plane z is not measured.
            Vector3::new(x, y, if self.samples.z_mm.is_some() { z } else { 0.0 })
        })
    }

    /// How far the point of one row is from where the robot is predicted at the command of another;
    /// `None` where there is none.
    pub(super) fn deviation_mm(
        &self,
        predicted: &Positions,
        command: usize,
        point: usize,
    ) -> Option<f64> {
        let deviation = self.get(point)? - Vector3::from(predicted.get(command));
        let deviation = deviation.norm();
        deviation.is_finite().then_some(deviation)
    }
}

/// From each of these rows on the point is that of so many rows below; before the first it is the own.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Path {
    pub(super) changes: Vec<(usize, isize)>,
}

impl Path {
    /// Whether no row is shifted.
    pub(super) fn is_none(&self) -> bool {
        self.changes.iter().all(|change| change.1 == 0)
    }

    /// Whether some row is, and not more often than points are lost.
    pub(super) fn is_shift(&self) -> bool {
        !self.is_none() && self.changes.len() <= MOST_CHANGES
    }

    fn shift_of(&self, row: usize) -> isize {
        let last = self.changes.iter().rev().find(|change| change.0 <= row);
        last.map_or(0, |change| change.1)
    }

    /// The row whose point belongs to the command of this one; `None` where it has been lost.
    pub(super) fn point_of(&self, row: usize, rows: usize) -> Option<usize> {
        let at = self.changes.iter().rposition(|change| change.0 <= row);
        let Some(at) = at else { return Some(row) };
        let (first, by) = self.changes[at];
        let point = row.checked_add_signed(by).filter(|point| *point < rows)?;
        // A point is that of one row only: the row above the change has its own.
        let above = first.checked_sub(1);
        let taken = above.and_then(|above| above.checked_add_signed(self.shift_of(above)));
        taken.is_none_or(|taken| point > taken).then_some(point)
    }

    /// Removes shifts that give no row a point, and ones that end after a row or two: they only spare rows points that
    /// do not fit. A missing point next to one too many is a bad row.
    fn drop_empty(&mut self, is_point: impl Fn(usize) -> bool, rows: usize) {
        let mut k = 0;
        while k < self.changes.len() {
            let (first, by) = self.changes[k];
            let end = self.changes.get(k + 1).map_or(rows, |next| next.0);
            let least = if end < rows && by != 0 {
                FEWEST_IN_A_ROW
            } else {
                1
            };
            let own = (first..end).filter_map(|row| row.checked_add_signed(by));
            let points = own.filter(|point| *point < rows && is_point(*point));
            if points.take(least).count() == least {
                k += 1;
            } else {
                self.changes.remove(k);
            }
        }
        let mut before = 0;
        self.changes
            .retain(|(_, by)| std::mem::replace(&mut before, *by) != *by);
    }

    /// Rows whose point is not their own.
    pub(super) fn moved(&self, rows: usize) -> impl Iterator<Item = usize> + '_ {
        (0..rows).filter(|row| self.shift_of(*row) != 0)
    }

    /// What the changes cost in so many rows.
    pub(super) fn price(&self, rows: usize) -> f64 {
        let mut before = 0;
        let mut price = 0.0;
        for (_, by) in &self.changes {
            price += price_of(before, *by, rows);
            before = *by;
        }
        price
    }

    /// What happened, for a person.
    pub(super) fn in_words(&self) -> Text {
        let mut before = 0;
        let mut text = Text::default();
        for (first, by) in &self.changes {
            let (lost, row) = (before - by, first + 1);
            let count = lost.unsigned_abs();
            if !text.is_empty() {
                text += Text::verbatim("; ");
            }
            let away = by.unsigned_abs();
            text += match (first, lost, count) {
                (0, ..) if *by == -1 => text!("all points belong to the command one row below"),
                (0, ..) if *by == 1 => text!("all points belong to the command one row above"),
                (0, ..) if *by < 0 => text!(
                    "all points belong to the command {count} rows below",
                    count = away
                ),
                (0, ..) => text!(
                    "all points belong to the command {count} rows above",
                    count = away
                ),
                (_, 1.., 1) => text!("one point missing at row {row}", row),
                (_, 1.., _) => text!("{count} points missing at row {row}", count, row),
                (_, _, 1) => text!("one point too many at row {row}", row),
                _ => text!("{count} points too many at row {row}", count, row),
            };
            before = *by;
        }
        text
    }
}

/// What a change from one shift to another costs.
fn price_of(from: isize, to: isize, rows: usize) -> f64 {
    if from == to {
        return 0.0;
    }
    let jump = from.abs_diff(to) as f64;
    PRICE * (1.0 + 0.5 * (jump - 1.0)) + (rows.max(2) as f64).ln()
}

/// What a deviation costs.
pub(super) fn cost(deviation_mm: Option<f64>, sigma_mm: f64) -> f64 {
    deviation_mm.map_or(WITHOUT_A_POINT, |r| cost_of(r, sigma_mm))
}

/// What the deviation of a point costs that is that of so many rows below.
pub(super) fn cost_of_shifted(deviation_mm: Option<f64>, by: isize, sigma_mm: f64) -> f64 {
    if by != 0 && deviation_mm.is_none() {
        NO_POINT_THERE
    } else {
        cost(deviation_mm, sigma_mm)
    }
}

/// How many rows there are from which the robot goes farther than this to one that a shift may reach.
pub(super) fn far_steps(predicted: &Positions, mm: f64) -> usize {
    let rows = predicted.x_mm.len();
    let goes = |row: usize, by: usize| {
        let step = Vector3::from(predicted.get(row)) - Vector3::from(predicted.get(row - by));
        step.norm_squared() > mm * mm
    };
    let far = |row: &usize| (1..=MOST_SHIFT as usize).any(|by| by <= *row && goes(*row, by));
    (0..rows).filter(far).count()
}

/// The likeliest path of all rows given the predictions of the robot.
pub(super) fn likeliest(points: &Points<'_>, predicted: &Positions, sigma_mm: f64) -> Path {
    let deviation = |row: usize, by: isize| {
        let point = row.checked_add_signed(by)?;
        points.deviation_mm(predicted, row, point)
    };
    let n = points.len();
    let (mut path, _) = along(0..n, n, |row, by| {
        cost_of_shifted(deviation(row, by), by, sigma_mm)
    });
    path.drop_empty(|point| points.get(point).is_some(), n);
    place_exactly(&mut path, n, &|row, point| {
        cost(
            point.and_then(|p| points.deviation_mm(predicted, row, p)),
            sigma_mm,
        )
    });
    path
}

/// The likeliest path along some rows of so many, and its cost with the prices.
pub(super) fn along(
    some: impl DoubleEndedIterator<Item = usize> + ExactSizeIterator + Clone,
    rows: usize,
    cost: impl Fn(usize, isize) -> f64,
) -> (Path, f64) {
    let shift = |state: usize| state as isize - MOST_SHIFT;
    let prices: [[f64; STATES]; STATES] = std::array::from_fn(|from| {
        std::array::from_fn(|to| price_of(shift(from), shift(to), rows))
    });
    // One byte for each row and state: the state before.
    let mut came_from: Vec<[u8; STATES]> = Vec::with_capacity(some.len());
    let mut so_far = prices[MOST_SHIFT as usize];
    for (k, row) in some.clone().enumerate() {
        let mut next = [0.0; STATES];
        let mut from = [0_u8; STATES];
        for to in 0..STATES {
            let (mut best, mut at) = (so_far[to], to);
            if k > 0 {
                for state in 0..STATES {
                    let own = so_far[state] + prices[state][to];
                    if own < best {
                        (best, at) = (own, state);
                    }
                }
            }
            let inside = row.checked_add_signed(shift(to)).is_some_and(|p| p < rows);
            let own = if inside {
                cost(row, shift(to))
            } else {
                NO_POINT_THERE
            };
            next[to] = best + own;
            from[to] = at as u8;
        }
        so_far = next;
        came_from.push(from);
    }
    let end = (0..STATES).min_by(|a, b| so_far[*a].total_cmp(&so_far[*b]));
    let mut state = end.unwrap_or(MOST_SHIFT as usize);
    let total = so_far[state];
    // Back from the end: a change is where the state of a row is not that of the row before.
    let mut changes = Vec::new();
    for (k, row) in some.enumerate().rev() {
        let before = match k {
            0 => MOST_SHIFT as usize,
            _ => usize::from(came_from[k][state]),
        };
        if before != state {
            changes.push((row, shift(state)));
        }
        state = before;
    }
    changes.reverse();
    (Path { changes }, total)
}

/// Moves every change to the neighbouring row where the points fit best, now that a point belongs to one row only.
fn place_exactly(path: &mut Path, rows: usize, cost: &dyn Fn(usize, Option<usize>) -> f64) {
    for k in 0..path.changes.len() {
        let at = path.changes[k].0;
        if at == 0 {
            continue;
        }
        let least = k
            .checked_sub(1)
            .map_or(1, |before| path.changes[before].0 + 1);
        let most = path.changes.get(k + 1).map_or(rows, |next| next.0) - 1;
        let around = at.saturating_sub(NEAR).max(least)..=(at + NEAR).min(most);
        let part = at.saturating_sub(2 * NEAR)..(at + 2 * NEAR).min(rows);
        let of = |first: usize| {
            let mut moved = path.clone();
            moved.changes[k].0 = first;
            let own = part.clone().map(|row| cost(row, moved.point_of(row, rows)));
            own.sum::<f64>()
        };
        let best = around
            .map(|first| (of(first), first))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, first)) = best {
            path.changes[k].0 = first;
        }
    }
}

/// With fewer samples a shift cannot be distinguished from anything else.
const FEWEST_SAMPLES: usize = 12;

#[cfg(test)]
mod tests {
    use super::*;

    /// Costs of rows whose right shifts are known.
    fn found(right: &[isize]) -> Path {
        along(0..right.len(), right.len(), |row, by| {
            if right[row] == by { 1.0 } else { 30.0 }
        })
        .0
    }

    #[test]
    fn a_change_is_found_where_it_is() {
        let mut right = vec![0; 30];
        assert!(found(&right).is_none());
        right[17..].fill(-1);
        assert_eq!(found(&right).changes, [(17, -1)]);
        right[25..].fill(0);
        assert_eq!(found(&right).changes, [(17, -1), (25, 0)]);
        assert_eq!(found(&[2; 30]).changes, [(0, 2)]);
        assert!(found(&[]).is_none());
    }

    #[test]
    fn a_shift_that_gives_no_row_a_point_is_none() {
        // The last point was not measured.
        let after = |changes: &[(usize, isize)]| {
            let mut path = Path {
                changes: changes.to_vec(),
            };
            path.drop_empty(|point| point < 9, 10);
            path.changes
        };
        assert_eq!(after(&[(7, 2), (8, -1)]), [(8, -1)]);
        assert_eq!(after(&[(7, 2)]), []);
        assert_eq!(after(&[(3, -1), (9, 0)]), [(3, -1)]);
        assert_eq!(
            after(&[(1, -1), (4, 2), (7, -1)]),
            [(1, -1), (4, 2), (7, -1)]
        );
        // A row or two are bad by themselves.
        assert_eq!(after(&[(2, -1), (5, 3), (6, -1)]), [(2, -1)]);
        assert_eq!(after(&[(2, -1), (6, 3), (7, -1)]), [(2, -1)]);
    }

    #[test]
    fn a_point_belongs_to_one_row_only() {
        // One point is missing at row 3: its command has none, and the rows behind have those above.
        let lost = Path {
            changes: vec![(3, -1)],
        };
        let of = |path: &Path| (0..6).map(|row| path.point_of(row, 6)).collect::<Vec<_>>();
        assert_eq!(
            of(&lost),
            [Some(0), Some(1), Some(2), None, Some(3), Some(4)]
        );
        // One is there twice.
        let twice = Path {
            changes: vec![(3, 1)],
        };
        assert_eq!(
            of(&twice),
            [Some(0), Some(1), Some(2), Some(4), Some(5), None]
        );
        assert_eq!(lost.in_words().to_string(), "one point missing at row 4");
        assert_eq!(twice.in_words().to_string(), "one point too many at row 4");
    }

    #[test]
    fn the_correction_pairs_rows_as_the_path_does() {
        let mut session = crate::row_checks::tests::axis(30);
        let x = session.samples.x_mm.clone();
        for changes in [
            vec![(3, -1)],
            vec![(3, 1)],
            vec![(0, 2)],
            vec![(4, -2), (11, 1), (20, 0)],
        ] {
            let path = Path { changes };
            let mut paired = session.clone();
            crate::sessions::SessionCorrection::PairRows(path.changes.clone()).apply(&mut paired);
            for row in 0..30 {
                let expected = path.point_of(row, 30).map_or(f64::NAN, |point| x[point]);
                assert!(
                    paired.samples.x_mm[row].to_bits() == expected.to_bits(),
                    "{path:?} {row}"
                );
            }
        }
        session.samples.select(&[]);
        crate::sessions::SessionCorrection::PairRows(vec![(0, 1), (7, 2)]).apply(&mut session);
        assert!(session.samples.is_empty());
    }
}
