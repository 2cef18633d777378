//! Folds for the cross-validation of a curve: values of the joint, which a controller interpolates between, and runs,
//! which test repetition.

use std::collections::BTreeMap;

use super::columns::Columns;
use crate::text::Text;
use crate::{budget, rounding};

/// The fold of each sample; `None`: it is in every fit.
pub(super) struct Folds {
    of: Vec<Option<usize>>,
    pub(super) count: usize,
    /// In words.
    pub(super) how: Text,
}

impl Folds {
    /// Values of the joint between others, which the curve has to predict from its neighbours. The ends of the
    /// range stay: no table is asked for what lies beyond them.
    pub(super) fn values(columns: &Columns, joint: usize) -> Option<Self> {
        let last = columns.values.len().checked_sub(1)?;
        let part = |q: &f64| {
            let rank = rank(columns, *q);
            (rank > 0 && rank < last).then_some(rank % budget::FOLDS)
        };
        Self {
            of: columns.q.iter().map(part).collect(),
            count: budget::FOLDS,
            how: text!(
                "every {parts}th value of joint {joint}, each held out in turn and predicted by a fit without it",
                parts = budget::FOLDS,
                joint = joint + 1
            ),
        }
        .if_enough()
    }

    /// Runs: how often the joint had been at the value from the same side before; of a single run there and back its
    /// two ways. `None` where the joint was at each value once.
    pub(super) fn runs(columns: &Columns) -> Option<Self> {
        Self::of_each_side(columns).or_else(|| Self::visits(columns, |_| 0))
    }

    /// Whether values come back from the same side.
    pub(super) fn come_back(columns: &Columns) -> bool {
        Self::of_each_side(columns).is_some()
    }

    fn of_each_side(columns: &Columns) -> Option<Self> {
        Self::visits(columns, |dir| i8::from(dir > 0.0) - i8::from(dir < 0.0))
    }

    fn visits(columns: &Columns, side: impl Fn(f64) -> i8) -> Option<Self> {
        let mut seen: BTreeMap<(usize, i8), usize> = BTreeMap::new();
        let visits = columns.q.iter().zip(&columns.dir).map(|(q, dir)| {
            let place = (rank(columns, *q), side(*dir));
            let visit = seen.entry(place).or_insert(0);
            *visit += 1;
            (place, *visit - 1)
        });
        let visits: Vec<((usize, i8), usize)> = visits.collect();
        let runs = seen.values().max().copied().unwrap_or(0);
        let count = runs.min(budget::FOLDS);
        // A value that was visited once belongs to no run that another one could predict.
        let run = |(place, visit): &((usize, i8), usize)| {
            (seen[place] > 1).then_some(visit * count / runs.max(1))
        };
        Self {
            of: visits.iter().map(run).collect(),
            count,
            how: text!("runs, each held out in turn and predicted by a fit without it"),
        }
        .if_enough()
    }

    /// Folds of which at least two hold samples out, and half of the samples are held out once.
    fn if_enough(self) -> Option<Self> {
        let out = self.of.iter().flatten().count();
        (self.count > 1 && 2 * out >= self.of.len() && out > 0).then_some(self)
    }

    pub(super) fn is_in(&self, sample: usize, fold: usize) -> bool {
        self.of[sample] == Some(fold)
    }

    /// All samples.
    pub(super) fn all(&self) -> usize {
        self.of.len()
    }

    /// Samples that are held out once.
    pub(super) fn samples(&self) -> usize {
        self.of.iter().flatten().count()
    }
}

/// Which of the different values a value is.
fn rank(columns: &Columns, q: f64) -> usize {
    columns
        .values
        .partition_point(|v| *v < q - rounding::WRITTEN)
}
