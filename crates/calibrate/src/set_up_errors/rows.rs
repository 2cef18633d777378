//! The rows for which a change holds.

use super::nearest::Nominal;
use super::thresholds::{MOVED_MM, SAME_MM};
use crate::effects::JointValues;
use crate::fit::problem::unusable;
use crate::fit::spread::spread;
use crate::row_checks::in_order;
use crate::sessions::{Group, Session, in_rows};
use crate::text::Text;

/// The rows of a session in measuring order, and those of them that count.
pub(super) struct RowsInOrder {
    /// Every row.
    order: Vec<usize>,
    /// Places in it of rows with a point that counts.
    pub(super) counted: Vec<usize>,
}

/// Rows for which something holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    All,
    /// From one of the rows that count up to and without another, in measuring order.
    Stretch(usize, usize),
    /// A setup or a target.
    Group(Group, usize),
}

impl RowsInOrder {
    /// At most so many, spread evenly.
    pub(super) fn of(session: &Session, most: usize) -> Self {
        let samples = &session.samples;
        let order = in_order(samples);
        let held_out = samples.held_out.as_deref();
        let counts = |row: usize| {
            unusable(session, row).is_none() && !held_out.is_some_and(|held_out| held_out[row])
        };
        let counts: Vec<bool> = order.iter().map(|row| counts(*row)).collect();
        let counted = spread(&counts, most);
        Self { order, counted }
    }

    /// Without those that are sent to the place of the one before once more: they have no new information on what
    /// moves.
    pub(super) fn of_new_places(mut self, session: &Session) -> Self {
        let samples = &session.samples;
        let order = &self.order;
        let is_again = |a: usize, b: usize| {
            let target = |row: usize| samples.target.as_ref().map(|target| target[row]);
            target(a) == target(b) && samples.q.iter().all(|q| q[a] == q[b])
        };
        let mut before = None;
        self.counted.retain(|place| {
            let row = order[*place];
            let is_new = before.is_none_or(|before| !is_again(before, row));
            before = Some(row);
            is_new
        });
        self
    }

    /// Without those whose point stayed where it was while the commands moved on: the robot stood at a stop, or the
    /// instrument was locked on a point. They look like a home that moves with every row.
    pub(super) fn of_moving_points(mut self, session: &Session, values: JointValues) -> Self {
        let few = self.select(session);
        let nominal = Nominal::of(&few, values);
        let pairs = nominal.pairs(&nominal.inputs);
        let stays = |a: usize, b: usize| {
            let [commanded, measured] = [pairs[a].0 - pairs[b].0, pairs[a].1 - pairs[b].1];
            measured.norm() < SAME_MM && commanded.norm() > MOVED_MM
        };
        let still =
            |k: usize| (k > 0 && stays(k - 1, k)) || (k + 1 < pairs.len() && stays(k, k + 1));
        let mut k = 0..;
        self.counted.retain(|_| !k.next().is_some_and(still));
        self
    }

    /// How many count.
    pub(super) fn len(&self) -> usize {
        self.counted.len()
    }

    /// The row of one that counts.
    pub(super) fn row(&self, k: usize) -> usize {
        self.order[self.counted[k]]
    }

    /// The rows that count, of a session of their own.
    pub(super) fn select(&self, session: &Session) -> Session {
        let rows: Vec<Option<usize>> = (0..self.len()).map(|k| Some(self.row(k))).collect();
        session.of_rows(&rows)
    }

    /// Which of those that count are in a part.
    pub(super) fn mask(&self, session: &Session, part: Part) -> Vec<bool> {
        let is_in = |k: usize| match part {
            Part::All => true,
            Part::Stretch(first, end) => (first..end).contains(&k),
            Part::Group(group, index) => group.of(session, self.row(k)) == Some(index),
        };
        (0..self.len()).map(is_in).collect()
    }

    /// All rows of a part, those too that do not count, as stretches of the file.
    pub(super) fn ranges(&self, session: &Session, part: Part) -> Vec<(usize, usize)> {
        let n = self.order.len();
        let mut rows: Vec<usize> = match part {
            Part::All => (0..n).collect(),
            Part::Stretch(first, end) => {
                let from = if first == 0 { 0 } else { self.counted[first] };
                let to = self.counted.get(end).copied().unwrap_or(n);
                self.order[from..to].to_vec()
            }
            Part::Group(group, index) => {
                let own = |row: &usize| group.of(session, *row) == Some(index);
                (0..n).filter(own).collect()
            }
        };
        rows.sort_unstable();
        in_rows::ranges(&rows)
    }

    /// What holds for a part, and for which.
    pub(super) fn described(&self, session: &Session, part: Part, what: &Text) -> Text {
        let ranges = self.ranges(session, part);
        match part {
            Part::All => what.clone(),
            Part::Group(group, index) => text!(
                "{what}, in the samples of {thing}",
                what,
                thing = group.called(group.name_of(session, index))
            ),
            Part::Stretch(..) => match ranges.as_slice() {
                [(first, end)] if *end == self.order.len() => {
                    text!("{what}, from sample {sample} on", what, sample = first + 1)
                }
                ranges => text!("{what}, in {rows}", what, rows = in_rows::listed(ranges)),
            },
        }
    }
}
