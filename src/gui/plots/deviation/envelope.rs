//! The chart of many samples: what lies between the smallest and the largest deviation in each
//! column of pixels.
//!
//! Samples are sorted by the joint's value once, for each side from which it came, and above them
//! stands a tree of extremes, sixteen to one. A column then costs a few looks at the tree, and a
//! frame as much as it has columns, for any number of samples.

use crate::gui::outcome::Answer;
use crate::gui::subject::{Component, Subject};

/// How many of one level make one of the next.
const FAN: usize = 16;

/// Smallest and largest of nothing.
const NOTHING: [f32; 2] = [f32::INFINITY, f32::NEG_INFINITY];

/// Values with a tree of their extremes. What is not finite is passed over.
#[derive(Debug, Clone, Default, PartialEq)]
struct Extremes {
    values: Vec<f32>,
    levels: Vec<Vec<[f32; 2]>>,
}

impl Extremes {
    fn new(values: Vec<f32>) -> Self {
        let mut levels: Vec<Vec<[f32; 2]>> = Vec::new();
        if values.len() > FAN {
            levels.push(values.chunks(FAN).map(of_values).collect());
        }
        while let Some(last) = levels.last()
            && last.len() > FAN
        {
            let next = last.chunks(FAN).map(of_pairs).collect();
            levels.push(next);
        }
        Self { values, levels }
    }

    /// Smallest and largest of the values from `from` to before `to`.
    fn of(&self, mut from: usize, mut to: usize) -> [f32; 2] {
        let mut found = NOTHING;
        let mut level = 0;
        let take = |level: usize, from: usize, to: usize| match level {
            0 => of_values(&self.values[from..to]),
            _ => of_pairs(&self.levels[level - 1][from..to]),
        };
        loop {
            let (first, last) = (from.div_ceil(FAN), to / FAN);
            if first >= last || level >= self.levels.len() {
                return both(found, take(level, from, to));
            }
            found = both(found, take(level, from, first * FAN));
            found = both(found, take(level, last * FAN, to));
            (from, to, level) = (first, last, level + 1);
        }
    }
}

fn of_values(values: &[f32]) -> [f32; 2] {
    let finite = values.iter().filter(|v| v.is_finite());
    finite.fold(NOTHING, |[a, b], v| [a.min(*v), b.max(*v)])
}

fn of_pairs(pairs: &[[f32; 2]]) -> [f32; 2] {
    pairs.iter().copied().fold(NOTHING, both)
}

fn both(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// Samples that the joint reached from one side.
#[derive(Debug, Clone, PartialEq)]
struct Track {
    side: f64,
    samples: Vec<u32>,
    q: Vec<f64>,
    before: Extremes,
    after: Option<Extremes>,
}

/// A column: from where to where along the chart, and what lies in it, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Column {
    /// From this value of joint 1 to that, rad or mm.
    pub(crate) q: [f64; 2],
    /// Smallest and largest deviation before.
    pub(crate) before_mm: Option<[f64; 2]>,
    /// Smallest and largest of what is left.
    pub(crate) after_mm: Option<[f64; 2]>,
}

/// See the module.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Envelope {
    tracks: Vec<Track>,
}

impl Envelope {
    /// Sorts the samples of a session.
    pub(crate) fn of(subject: &Subject, answer: Option<&Answer>, component: Component) -> Self {
        let usable = &subject.overview.usable;
        let track = |side: f64| {
            let of_side = |sample: &u32| subject.side(*sample as usize) == side;
            let mut samples: Vec<u32> = usable.iter().copied().filter(of_side).collect();
            let q = |sample: u32| subject.q(sample as usize);
            samples.sort_unstable_by(|a, b| q(*a).total_cmp(&q(*b)).then(a.cmp(b)));
            let values = |deviation: &dyn Fn(usize) -> [f64; 3]| {
                let value = |sample: &u32| {
                    let sample = *sample as usize;
                    single(subject.component(deviation(sample), sample, component))
                };
                Extremes::new(samples.iter().map(value).collect())
            };
            Track {
                side,
                q: samples.iter().map(|sample| q(*sample)).collect(),
                before: values(&|sample| subject.deviation_before(sample)),
                after: answer.map(|answer| values(&|sample| answer.deviation_after(sample))),
                samples,
            }
        };
        let tracks = [-1.0, 0.0, 1.0].into_iter().map(track);
        Self {
            tracks: tracks.filter(|t| !t.samples.is_empty()).collect(),
        }
    }

    /// Smallest and largest value of joint 1, and of the deviations before and after.
    pub(crate) fn extent(&self) -> Option<Column> {
        let ends = |t: &Track| Some([*t.q.first()?, *t.q.last()?]);
        let q = self.tracks.iter().filter_map(ends);
        let q = q.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        let whole = self.tracks.iter().map(|t| t.column(q, 0, t.q.len()));
        whole.reduce(|a, b| Column {
            q,
            before_mm: widest(a.before_mm, b.before_mm),
            after_mm: widest(a.after_mm, b.after_mm),
        })
    }

    /// How many samples are between two values of joint 1.
    pub(crate) fn count(&self, q: [f64; 2]) -> usize {
        let ranges = self.tracks.iter().map(|t| t.range(q));
        ranges.map(|(from, to)| to - from).sum()
    }

    /// The samples between two values of joint 1, thinned to about `most`.
    pub(crate) fn samples(&self, q: [f64; 2], most: usize) -> impl Iterator<Item = usize> {
        let step = self.count(q).div_ceil(most).max(1);
        let of_track = move |t: &Track| {
            let (from, to) = t.range(q);
            let samples: Vec<u32> = t.samples[from..to].iter().copied().step_by(step).collect();
            samples
        };
        let samples = self.tracks.iter().flat_map(of_track);
        samples.map(|sample| sample as usize)
    }

    /// The columns of each side between two values of joint 1; those without a sample are left out.
    pub(crate) fn columns(&self, [low, high]: [f64; 2], number: usize) -> Vec<Column> {
        let width = (high - low) / number as f64;
        let mut columns = Vec::new();
        if !(width > 0.0 && width.is_finite()) {
            return columns;
        }
        for track in &self.tracks {
            let mut from = track.q.partition_point(|q| *q < low);
            for k in 0..number {
                let end = low + width * (k + 1) as f64;
                let to = from + track.q[from..].partition_point(|q| *q < end);
                if to > from {
                    columns.push(track.column([end - width, end], from, to));
                }
                from = to;
            }
        }
        columns
    }

    /// Whether samples came from different sides.
    pub(crate) fn sides(&self) -> bool {
        self.tracks.iter().any(|t| t.side != 0.0)
    }
}

impl Track {
    fn range(&self, [low, high]: [f64; 2]) -> (usize, usize) {
        let from = self.q.partition_point(|q| *q < low);
        let to = self.q.partition_point(|q| *q <= high);
        (from, to.max(from))
    }

    fn column(&self, q: [f64; 2], from: usize, to: usize) -> Column {
        let known =
            |[low, high]: [f32; 2]| (low <= high).then(|| [f64::from(low), f64::from(high)]);
        Column {
            q,
            before_mm: known(self.before.of(from, to)),
            after_mm: self.after.as_ref().and_then(|a| known(a.of(from, to))),
        }
    }
}

fn widest(a: Option<[f64; 2]>, b: Option<[f64; 2]>) -> Option<[f64; 2]> {
    match (a, b) {
        (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].max(b[1])]),
        (one, other) => one.or(other),
    }
}

#[allow(clippy::cast_possible_truncation, reason = "drawn in single precision")]
fn single(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::commands::Command;
    use crate::gui::edit::Edit;
    use crate::gui::testing::workbench;

    #[test]
    fn the_tree_knows_the_extremes_of_every_range() {
        let value = |k: u32| f32::from(u8::try_from(k.wrapping_mul(97) % 251).expect("small"));
        let mut values: Vec<f32> = (0..5000).map(value).collect();
        values[17] = f32::NAN;
        values[4000] = f32::INFINITY;
        let tree = Extremes::new(values.clone());
        for (from, to) in [
            (0, 5000),
            (0, 1),
            (3, 3),
            (15, 17),
            (16, 4096),
            (4001, 4999),
        ] {
            assert_eq!(
                tree.of(from, to),
                of_values(&values[from..to]),
                "{from}..{to}"
            );
        }
    }

    #[test]
    fn columns_hold_what_the_samples_hold() {
        let mut workbench = workbench();
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        let (subject, answer) = (workbench.subject(), workbench.answer());
        let envelope = Envelope::of(subject, answer, Component::Radial);
        let all = envelope.extent().expect("there are samples");
        let columns = envelope.columns([all.q[0], all.q[1] + 1e-9], 7);
        for side in [-1.0, 1.0] {
            let of_side = |i: &usize| subject.side(*i) == side;
            for sample in (0..subject.len()).filter(of_side) {
                let q = subject.q(sample);
                let e = subject.deviation_before(sample);
                let mm = subject.component(e, sample, Component::Radial);
                let holds = |c: &&Column| {
                    let [low, high] = c.before_mm.expect("a column has samples");
                    c.q[0] <= q && q <= c.q[1] && low - 1e-6 <= mm && mm <= high + 1e-6
                };
                assert!(columns.iter().any(|c| holds(&c)), "{sample}");
            }
        }
        assert!(columns.len() <= 14 && columns.iter().all(|c| c.after_mm.is_some()));
        assert_eq!(envelope.count(all.q), subject.len());
        assert_eq!(envelope.samples(all.q, 10_000).count(), subject.len());
        assert!(envelope.samples(all.q, 20).count() <= 22);
    }

    #[test]
    fn an_envelope_of_nothing_is_empty() {
        let envelope = Envelope { tracks: Vec::new() };
        assert_eq!(envelope.extent(), None);
        assert!(envelope.columns([0.0, 1.0], 10).is_empty());
        assert!(envelope.columns([0.0, 0.0], 10).is_empty());
    }
}
