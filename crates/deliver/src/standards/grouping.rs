//! Samples that belong together: equal in every column that counts, each approach counted once.

use std::cmp::Ordering;

use super::points::Points;

/// Columns by which samples are told apart; a missing value is a value of its own.
pub(super) struct Keys(Vec<Vec<u64>>);

impl Keys {
    /// The conditions that a test holds fixed: reflector, load, measuring frame, the size of the
    /// joints' speeds; not the temperature, which drifts by itself.
    pub(super) fn of_conditions(points: &Points<'_>) -> Self {
        let inputs = &points.inputs;
        let mut keys = Self(Vec::new());
        keys.0.extend(
            inputs
                .target
                .as_ref()
                .map(|t| t.iter().map(|t| u64::from(*t)).collect()),
        );
        keys.0.extend(inputs.load_kg.as_ref().map(|c| bits(c)));
        keys.0.extend(inputs.setup.as_ref().map(|c| bits(c)));
        for speed in inputs.speed.iter().flatten() {
            keys.0
                .push(speed.iter().map(|v| v.abs().to_bits()).collect());
        }
        keys
    }

    pub(super) fn and(mut self, column: &[f64]) -> Self {
        self.0.push(bits(column));
        self
    }

    /// The samples that `counts` picks, in groups of equal keys; groups in the order of their first
    /// sample, samples in measuring order.
    pub(super) fn groups(&self, n: usize, counts: impl Fn(usize) -> bool) -> Vec<Vec<usize>> {
        let mut order: Vec<usize> = (0..n).filter(|i| counts(*i)).collect();
        order.sort_by(|a, b| self.compare(*a, *b).then(a.cmp(b)));
        let same = |a: &usize, b: &usize| self.compare(*a, *b) == Ordering::Equal;
        let mut groups: Vec<Vec<usize>> = order.chunk_by(same).map(<[usize]>::to_vec).collect();
        groups.sort_by_key(|group| group.first().copied());
        groups
    }

    fn compare(&self, a: usize, b: usize) -> Ordering {
        let columns = self.0.iter().map(|c| c[a].cmp(&c[b]));
        columns.fold(Ordering::Equal, Ordering::then)
    }
}

fn bits(column: &[f64]) -> Vec<u64> {
    // Adding 0 turns −0 into 0.
    column.iter().map(|v| (v + 0.0).to_bits()).collect()
}

/// Number of the stay at a pose that each sample belongs to: it rises when the command or the side
/// changes. Readings of one stay are one approach.
pub(super) fn stays(points: &Points<'_>) -> Vec<usize> {
    let inputs = &points.inputs;
    let mut stays = Vec::with_capacity(inputs.len());
    let mut stay = 0;
    for i in 0..inputs.len() {
        let moved = |before: usize| {
            inputs.q.iter().any(|q| q[i] != q[before])
                || inputs.dir.iter().flatten().any(|d| d[i] != d[before])
        };
        stay += usize::from(i > 0 && moved(i - 1));
        stays.push(stay);
    }
    stays
}

/// The first sample of each stay.
pub(super) fn once_per_stay(samples: &[usize], stays: &[usize]) -> Vec<usize> {
    let mut kept: Vec<usize> = Vec::with_capacity(samples.len());
    for &i in samples {
        if kept.last().is_none_or(|last| stays[*last] != stays[i]) {
            kept.push(i);
        }
    }
    kept
}

/// What has the same key together, in the order in which the keys come first.
pub(crate) fn gathered<K: PartialEq, V>(all: impl IntoIterator<Item = (K, V)>) -> Vec<(K, Vec<V>)> {
    let mut groups: Vec<(K, Vec<V>)> = Vec::new();
    for (key, value) in all {
        match groups.iter_mut().find(|(known, _)| *known == key) {
            Some((_, own)) => own.push(value),
            None => groups.push((key, vec![value])),
        }
    }
    groups
}
