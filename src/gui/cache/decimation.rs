//! Which samples a plot draws where it cannot draw all: the largest deviations always, and of the
//! rest so many that the whole is seen.
//!
//! The plane is cut into cells; of each cell the sample with the largest deviation stays, before
//! and after, and the largest of all stay wherever they are. What room is left goes to samples in
//! the cloud's order, whose every beginning is spread evenly.

use std::collections::BTreeMap;

use super::cloud::Cloud;
use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::view::Plane;

/// So many samples are drawn by shapes; each is a point and up to two vectors.
pub(crate) const MOST: usize = 2_500;
/// Of them the largest of all, before and after.
const LARGEST: usize = 250;
/// Cells along each side.
const CELLS: f64 = 26.0;

/// Which of many marks are drawn. In ascending order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Thinned {
    pub(crate) samples: Vec<u32>,
}

impl Thinned {
    /// Looks at every sample once; takes its time.
    pub(crate) fn of(
        loaded_session: &LoadedSession,
        answer: Option<&Answer>,
        plane: Plane,
    ) -> Self {
        let usable = &loaded_session.overview.usable;
        let lengths = [
            Some(&loaded_session.before.length_mm),
            answer.map(|a| &a.lengths_mm),
        ];
        let mut kept: Vec<u32> = Vec::with_capacity(2 * MOST);
        for lengths in lengths.into_iter().flatten() {
            kept.extend(largest(usable, lengths));
            kept.extend(largest_of_cells(loaded_session, lengths, plane));
        }
        kept.sort_unstable();
        kept.dedup();
        let extremes = kept.clone();
        let cloud = Cloud::of(loaded_session);
        let others = cloud.samples.iter().copied();
        let others = others.filter(|sample| extremes.binary_search(sample).is_err());
        kept.extend(others.take(MOST.saturating_sub(extremes.len())));
        kept.sort_unstable();
        Self { samples: kept }
    }
}

fn largest(usable: &[u32], lengths_mm: &[f64]) -> Vec<u32> {
    let length = |sample: u32| {
        let length = lengths_mm[sample as usize];
        if length.is_nan() { -1.0 } else { length }
    };
    let mut samples = usable.to_vec();
    if samples.len() > LARGEST {
        let longer = |a: &u32, b: &u32| length(*b).total_cmp(&length(*a)).then(a.cmp(b));
        samples.select_nth_unstable_by(LARGEST, longer);
        samples.truncate(LARGEST);
    }
    samples
}

/// The one with the largest length in each cell that holds any.
fn largest_of_cells(loaded_session: &LoadedSession, lengths_mm: &[f64], plane: Plane) -> Vec<u32> {
    let axes = plane.axes();
    let [low, high] = loaded_session.overview.nominal_mm;
    let side = axes.map(|k| high[k] - low[k]);
    let cell_mm = side[0].max(side[1]).max(1.0) / CELLS;
    let mut cells: BTreeMap<[i32; 2], (f64, u32)> = BTreeMap::new();
    for sample in &loaded_session.overview.usable {
        let (at, length) = (
            loaded_session.measured(*sample as usize),
            lengths_mm[*sample as usize],
        );
        if length.is_nan() {
            continue;
        }
        // What was measured far away counts with the outermost cells.
        let cell = axes.map(|k| whole((at[k] - low[k]) / cell_mm));
        let best = cells.entry(cell).or_insert((length, *sample));
        if length > best.0 {
            *best = (length, *sample);
        }
    }
    cells.into_values().map(|(_, sample)| sample).collect()
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "clamped to what a cell can be"
)]
fn whole(place: f64) -> i32 {
    place.floor().clamp(-2.0, CELLS + 2.0) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::edit::Edit;
    use crate::gui::core::simulate::Form;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::{Command, Workbench};

    fn many() -> Workbench {
        let mut workbench = workbench();
        workbench.execute(Command::Simulate(Form {
            step_deg: 0.02,
            ..Form::default()
        }));
        workbench.receive();
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        workbench
    }

    #[test]
    fn the_largest_deviations_are_never_thinned_away() {
        let workbench = many();
        let (loaded_session, answer) = (workbench.loaded_session(), workbench.answer());
        assert_eq!(loaded_session.len(), 18_002);
        let thinned = Thinned::of(loaded_session, answer, Plane::Xy);
        assert!(thinned.samples.len() <= MOST, "{}", thinned.samples.len());
        assert!(thinned.samples.windows(2).all(|pair| pair[0] < pair[1]));
        let after = &answer.expect("it is identified").lengths_mm;
        for lengths in [&loaded_session.before.length_mm, after] {
            let mut order: Vec<u32> = loaded_session.overview.usable.clone();
            order.sort_by(|a, b| lengths[*b as usize].total_cmp(&lengths[*a as usize]));
            for sample in &order[..LARGEST] {
                assert!(thinned.samples.binary_search(sample).is_ok(), "{sample}");
            }
        }
    }

    #[test]
    fn the_rest_shows_the_whole() {
        let workbench = many();
        let loaded_session = workbench.loaded_session();
        let thinned = Thinned::of(loaded_session, None, Plane::Xy);
        let mut met = [0; 18];
        for sample in &thinned.samples {
            let degrees = loaded_session.q(*sample as usize).to_degrees() + 90.0;
            met[crate::numeric::whole(degrees / 10.0).min(17)] += 1;
        }
        assert!(met.iter().all(|n| *n > MOST / 40), "{met:?}");
    }
}
