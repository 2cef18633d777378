//! The samples as they are uploaded: where each was measured, how far off it was, under what
//! conditions.
//!
//! Lengths are mm of the measuring frame, in single precision from the middle of the workspace:
//! 0.03 µm at half a metre. Samples stand in an order whose every beginning is spread evenly over
//! the session (steps of the golden ratio), so that the first of them show the whole. Every nth
//! sample would not: where reflectors or directions alternate it is always the same of them.

use crate::numeric::{extent, single};
use std::sync::Arc;

use crate::gui::core::loaded_session::LoadedSession;
use crate::sessions::Samples;

/// Measured point, deviation before, and load, temperature and time from 0 to 1, below 0 where
/// there is none.
pub(crate) type Place = [f32; 9];

/// A row of the [`Remainder`].
pub(crate) type RemainderRow = [f32; 5];

#[derive(Debug, Clone, Default)]
pub(crate) struct Cloud {
    /// What is known of each sample that can be used.
    pub(crate) places: Vec<Place>,
    pub(crate) samples: Vec<u32>,
    /// The middle of the workspace, mm of the measuring frame.
    pub(crate) centre_mm: [f64; 3],
    /// Smallest and largest load (kg), temperature (°C) and time (s), where they differ.
    pub(crate) conditions: [Option<[f64; 2]>; 3],
}

/// What an answer leaves of the deviations, mm, 1 where the sample is suspected, and the uncertainty of
/// the model there from 0 to 1, below 0 where it is not shown; in the order of the [`Cloud`].
#[derive(Debug, Clone, Default)]
pub(crate) struct Remainder {
    /// One for each sample of the cloud.
    pub(crate) rows: Vec<RemainderRow>,
}

impl Cloud {
    /// That of a session: made when it is first wanted, in the background if possible.
    pub(crate) fn of(loaded_session: &LoadedSession) -> Arc<Self> {
        loaded_session
            .drawn
            .get_or_make(|| Self::new(loaded_session))
    }

    /// The usable samples of a session.
    fn new(loaded_session: &LoadedSession) -> Self {
        let usable = &loaded_session.overview.usable;
        let samples: Vec<u32> = spread(usable.len()).map(|k| usable[k]).collect();
        let [low, high] = loaded_session.overview.measured_mm;
        let centre_mm = std::array::from_fn(|k| {
            let middle = 0.5 * (low[k] + high[k]);
            if middle.is_finite() { middle } else { 0.0 }
        });
        let columns = columns(&loaded_session.session.samples);
        let conditions = columns.map(|column| column.and_then(|c| range(c, usable)));
        let place = |sample: &u32| {
            let sample = *sample as usize;
            let at = loaded_session.measured(sample);
            let before = loaded_session.deviation_before(sample);
            let mut place = [-1.0; 9];
            for k in 0..3 {
                place[k] = single(at[k] - centre_mm[k]);
                place[3 + k] = single(before[k]);
                if let (Some(column), Some([low, high])) = (columns[k], conditions[k]) {
                    let part = (column[sample] - low) / (high - low);
                    place[6 + k] = if part.is_finite() { single(part) } else { -1.0 };
                }
            }
            place
        };
        Self {
            places: samples.iter().map(place).collect(),
            samples,
            centre_mm,
            conditions,
        }
    }

    /// What an answer leaves, of each sample here.
    pub(crate) fn remainder(&self, after_mm: &[Vec<f64>; 3], suspected: &[bool]) -> Remainder {
        let row = |sample: &u32| {
            let sample = *sample as usize;
            let mark = if suspected[sample] { 1.0 } else { 0.0 };
            let [x, y, z] = [0, 1, 2].map(|k| single(after_mm[k][sample]));
            [x, y, z, mark, -1.0]
        };
        Remainder {
            rows: self.samples.iter().map(row).collect(),
        }
    }
}

/// Load, temperature and time.
fn columns(samples: &Samples) -> [Option<&[f64]>; 3] {
    [
        samples.load_kg.as_deref(),
        samples.temperature_c.as_deref(),
        samples.time_s.as_deref(),
    ]
}

/// Smallest and largest value, where there are two.
fn range(column: &[f64], usable: &[u32]) -> Option<[f64; 2]> {
    let values = usable.iter().map(|i| column[*i as usize]);
    let [low, high] = extent(values);
    (low < high && (high - low).is_finite()).then_some([low, high])
}

/// 0 … count in an order whose every beginning is spread evenly: multiples, modulo the count, of
/// a step that has no divisor with it and is nearly its golden section.
fn spread(count: usize) -> impl Iterator<Item = usize> {
    let common = |mut a: usize, mut b: usize| {
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    // 0.618034 of any count that memory holds, without rounding.
    let mut step = (count / 1_000_000 * 618_034 + count % 1_000_000 * 618_034 / 1_000_000).max(1);
    while common(step, count) > 1 {
        step += 1;
    }
    let next = move |k: &usize| Some((k + step) % count);
    std::iter::successors((count > 0).then_some(0), next).take(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;

    #[test]
    fn every_beginning_of_the_order_is_spread_evenly() {
        for count in [0_usize, 1, 2, 3, 100, 1000, 4097] {
            let order: Vec<usize> = spread(count).collect();
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(sorted.iter().copied().eq(0..count), "{count}");
        }
        // No gap is much wider than the mean one; the step is whole, the golden section is not.
        for (count, first) in [(100_000, 500), (1_000_008, 6_000), (36_000, 1_000)] {
            let mut some: Vec<usize> = spread(count).take(first).collect();
            some.sort_unstable();
            let widest = some.windows(2).map(|pair| pair[1] - pair[0]).max();
            assert!(widest <= Some(4 * count / first), "{count} {widest:?}");
        }
        // Whatever alternates is met in all its forms.
        for period in [2, 3, 4, 16] {
            let mut met: Vec<usize> = spread(1_000_000).take(64).map(|k| k % period).collect();
            met.sort_unstable();
            met.dedup();
            assert_eq!(met.len(), period);
        }
    }

    #[test]
    fn the_cloud_holds_what_the_session_holds() {
        let workbench = workbench();
        let loaded_session = workbench.loaded_session();
        let cloud = Cloud::of(loaded_session);
        assert_eq!(cloud.places.len(), loaded_session.overview.usable.len());
        for (place, sample) in cloud.places.iter().zip(&cloud.samples) {
            let measured = loaded_session.measured(*sample as usize);
            let before = loaded_session.deviation_before(*sample as usize);
            for k in 0..3 {
                let at = f64::from(place[k]) + cloud.centre_mm[k];
                assert!((at - measured[k]).abs() < 1e-4);
                assert!((f64::from(place[3 + k]) - before[k]).abs() < 1e-5);
            }
        }
    }
}
