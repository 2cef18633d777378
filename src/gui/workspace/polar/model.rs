//! What the polar view shows, in mm and rad.
//!
//! Each sample stands at the commanded angle of the joint; how far it is from the nominal circle
//! is a component of its deviation, so many divisions long:
//!
//! ```text
//! r = N + e / division,   division from 1, 2, 5 × 10ⁿ, such that |e| ≤ 5 divisions
//! ```
//!
//! Source: ISO 230-4 (circular tests), where e is the radial deviation of a circular path.

use crate::gui::core::answer::Answer;
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::scale::{FEW, round_down, stride};
use crate::gui::workbench::Workbench;
use crate::present::numbers::trimmed;
use crate::present::units::Units;

/// The largest deviation is at most so many divisions long.
const MOST_DIVISIONS: f64 = 5.0;
/// A smaller division than this would show rounding, mm.
const LEAST_MM: f64 = 1e-5;
/// Angles this close are one, rad: the line goes through the mean of their deviations.
const SAME_RAD: f64 = 0.005;
/// Over a wider gap there is no line, rad.
const GAP_RAD: f64 = 0.45;

/// One sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PolarSample {
    pub(crate) sample: usize,
    /// Commanded angle, rad.
    pub(crate) q: f64,
    /// The component of the deviation before, mm.
    pub(crate) before_mm: f64,
    /// Of what is left, mm.
    pub(crate) after_mm: Option<f64>,
    /// Side from which the joint came; 0 where it is not known.
    pub(crate) side: f64,
}

impl PolarSample {
    /// A sample of a session.
    pub(crate) fn of(
        loaded_session: &LoadedSession,
        answer: Option<&Answer>,
        component: Component,
        sample: usize,
    ) -> Self {
        let of = |e: [f64; 3]| loaded_session.component(e, sample, component);
        Self {
            sample,
            q: loaded_session.q(sample),
            before_mm: of(loaded_session.deviation_before(sample)),
            after_mm: answer.map(|a| of(a.deviation_after(sample))),
            side: loaded_session.side(sample),
        }
    }
}

/// The mean deviation over the angle, of samples that came from one side: angle and mm.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trace {
    pub(crate) side: f64,
    /// Pieces without gaps.
    pub(crate) pieces: Vec<Vec<[f64; 2]>>,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Polar {
    pub(crate) component: Component,
    /// Samples, perhaps thinned; none where their extremes are shown instead.
    pub(crate) spots: Vec<PolarSample>,
    /// One spot for so many samples.
    pub(crate) stride: usize,
    /// Mean deviation before, by side.
    pub(crate) before: Vec<Trace>,
    /// Mean of what is left, by side.
    pub(crate) after: Vec<Trace>,
    pub(crate) division_mm: f64,
    /// So many of the unit in which lengths are written are a millimetre.
    per_mm: f64,
    /// So many divisions inside the nominal circle and outside.
    pub(crate) divisions: [f64; 2],
    /// How far a position may be off, mm.
    pub(crate) tolerance_mm: Option<f64>,
    /// Smallest and largest angle, rad.
    pub(crate) range: [f64; 2],
}

/// Why a session has no polar view, and what shows the same.
fn absent(loaded_session: &LoadedSession) -> Option<&'static str> {
    let robot = &loaded_session.session.robot;
    if loaded_session.is_empty() {
        Some(say!(
            "Nothing was measured yet: the polar view shows deviations around the joint’s angle"
        ))
    } else if robot.joints.len() > 1 {
        Some(say!(
            "This robot has several joints, so that a deviation belongs to no single angle: there is no polar view. The other views show where it is, the chart below over which value of the first joint"
        ))
    } else if !loaded_session.turns() {
        Some(say!(
            "This joint slides, and a length does not close a circle: there is no polar view. The chart below shows the deviation along the joint’s way"
        ))
    } else {
        None
    }
}

impl Polar {
    /// The view as the workbench has it; why there is none otherwise.
    pub(crate) fn of(workbench: &Workbench) -> Result<Self, &'static str> {
        let loaded_session = &**workbench.loaded_session();
        if let Some(because) = absent(loaded_session) {
            return Err(because);
        }
        let (view, answer) = (workbench.view(), workbench.answer());
        let usable = &loaded_session.overview.usable;
        let envelope = workbench.around();
        let stride = stride(usable.len(), FEW);
        let shown: &[u32] = if envelope.is_some() { &[] } else { usable };
        let samples = shown.iter().step_by(stride).map(|s| *s as usize);
        let spots: Vec<PolarSample> = samples
            .map(|sample| PolarSample::of(loaded_session, answer, view.component, sample))
            .collect();
        let only_after = view.only_after && answer.is_some();
        let per_mm = workbench.units().length_value(1.0);
        let mut polar = Self::from_spots(spots, view.component, only_after, per_mm);
        polar.stride = stride;
        polar.tolerance_mm = workbench.document().tolerance_mm;
        if let Some(all) = envelope.and_then(crate::gui::cache::charts::Envelope::extent) {
            let before = all.before_mm.filter(|_| !only_after);
            let ends = before.into_iter().chain(all.after_mm).flatten();
            polar.range = all.x;
            polar.scale_to(ends);
        }
        Ok(polar)
    }

    /// The view of these samples; of what is left alone where it is looked at alone.
    pub(crate) fn from_spots(
        spots: Vec<PolarSample>,
        component: Component,
        only_after: bool,
        per_mm: f64,
    ) -> Self {
        let before = spots.iter().filter(|_| !only_after);
        let before: Vec<_> = before.map(|s| (s.side, s.q, s.before_mm)).collect();
        let after = spots
            .iter()
            .filter_map(|s| Some((s.side, s.q, s.after_mm?)));
        let after: Vec<_> = after.collect();
        let all = before.iter().chain(&after).map(|(_, _, mm)| *mm);
        let all: Vec<f64> = all.filter(|mm| mm.is_finite()).collect();
        let angles = spots.iter().map(|s| s.q).filter(|q| q.is_finite());
        let range = angles.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], q| {
            [a.min(q), b.max(q)]
        });
        let mut polar = Self {
            component,
            stride: 1,
            before: traces(before),
            after: traces(after),
            per_mm,
            division_mm: LEAST_MM,
            divisions: [1.0; 2],
            tolerance_mm: None,
            range,
            spots,
        };
        polar.scale_to(all.into_iter());
        polar
    }

    fn scale_to(&mut self, shown_mm: impl Iterator<Item = f64>) {
        let [low, high] = shown_mm.fold([0.0_f64; 2], |[a, b], mm| [a.min(mm), b.max(mm)]);
        let largest = high.max(-low);
        // Round in the unit in which it is written.
        let round = round_up(largest * self.per_mm / MOST_DIVISIONS);
        self.division_mm = (round / self.per_mm).max(LEAST_MM);
        let most = |mm: f64| (mm / self.division_mm - 1e-9).ceil();
        self.divisions = [-low, high].map(|mm| most(mm).clamp(1.0, MOST_DIVISIONS));
    }

    /// The tolerance band, mm: both ways for a component, outwards for a length; no wider than
    /// what is in sight.
    pub(crate) fn band_mm(&self) -> Option<[f64; 2]> {
        let tolerance = self.tolerance_mm?;
        let [low, high] = self.divisions.map(|most| {
            let most = (most + 0.5) * self.division_mm;
            tolerance.min(most)
        });
        let low = if self.component == Component::Length {
            0.0
        } else {
            -low
        };
        Some([low, high])
    }
}

/// The smallest of 1, 2, 5 × 10ⁿ that is not below `value`; 0 for nothing.
fn round_up(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 0.0;
    }
    let below = round_down(value);
    let next = [1.0, 2.0, 2.5, 5.0].map(|times| times * below);
    let round = |candidate: &f64| (round_down(*candidate) / candidate - 1.0).abs() < 1e-9;
    let enough = |candidate: &f64| *candidate >= value * (1.0 - 1e-9);
    let found = next.into_iter().find(|c| enough(c) && round(c));
    found.unwrap_or(10.0 * below)
}

/// The mean at each angle, side by side.
fn traces(mut values: Vec<(f64, f64, f64)>) -> Vec<Trace> {
    values.retain(|(_, q, mm)| q.is_finite() && mm.is_finite());
    values.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut traces: Vec<Trace> = Vec::new();
    for group in values.chunk_by(|a, b| a.0 == b.0 && b.1 - a.1 < SAME_RAD) {
        let n = group.len() as f64;
        let mean = |of: fn(&(f64, f64, f64)) -> f64| group.iter().map(of).sum::<f64>() / n;
        let (side, point) = (group[0].0, [mean(|v| v.1), mean(|v| v.2)]);
        if traces.last().is_none_or(|last| last.side != side) {
            traces.push(Trace {
                side,
                pieces: Vec::new(),
            });
        }
        let Some(trace) = traces.last_mut() else {
            continue;
        };
        match trace.pieces.last_mut() {
            Some(piece) if piece.last().is_some_and(|p| point[0] - p[0] < GAP_RAD) => {
                piece.push(point);
            }
            _ => trace.pieces.push(vec![point]),
        }
    }
    traces
}

/// `1 division = 0.5 mm`.
pub(crate) fn scale(polar: &Polar, units: Units) -> String {
    let division = units.length_value(polar.division_mm);
    say!(
        "1 division = {length} {unit}",
        length = trimmed(division, 6),
        unit = units.length_name()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::edit::Edit;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::{Command, ViewChange};

    fn spot(sample: usize, q: f64, before_mm: f64) -> PolarSample {
        PolarSample {
            sample,
            q,
            before_mm,
            after_mm: None,
            side: 1.0,
        }
    }

    #[test]
    fn the_largest_deviation_is_at_most_five_divisions_and_the_division_is_round() {
        for largest in [13.8, 0.05, 0.0007, 4.99, 5.0] {
            let polar = Polar::from_spots(
                vec![spot(0, 0.0, largest), spot(1, 1.0, -0.3 * largest)],
                Component::Radial,
                false,
                1.0,
            );
            let drawn = largest / polar.division_mm;
            assert!(drawn <= 5.0 + 1e-9 && drawn > 1.9, "{largest}: {drawn}");
            let [inside, outside] = polar.divisions;
            assert!(drawn <= outside + 1e-9 && 0.3 * drawn <= inside + 1e-9);
            let lead = polar.division_mm / 10f64.powf(polar.division_mm.log10().floor() + 1e-12);
            assert!(
                [1.0, 2.0, 5.0]
                    .iter()
                    .any(|l| (lead / l - 1.0).abs() < 1e-6),
                "{lead}"
            );
        }
    }

    #[test]
    fn nothing_but_zeros_and_missing_values_still_has_a_scale() {
        let zeros = vec![spot(0, 0.0, 0.0), spot(1, 0.0, f64::NAN)];
        let polar = Polar::from_spots(zeros, Component::Radial, false, 1.0);
        assert!(polar.division_mm > 0.0 && polar.divisions == [1.0; 2]);
        assert!(
            Polar::from_spots(Vec::new(), Component::Length, true, 1.0)
                .before
                .is_empty()
        );
    }

    #[test]
    fn a_line_goes_through_the_mean_at_each_angle_and_not_over_gaps() {
        let spots = [(0.0, 1.0), (0.001, 3.0), (0.2, 4.0), (2.0, 5.0)];
        let spots = spots.iter().enumerate();
        let spots = spots.map(|(k, (q, mm))| spot(k, *q, *mm)).collect();
        let polar = Polar::from_spots(spots, Component::Radial, false, 1.0);
        let pieces = &polar.before[0].pieces;
        assert_eq!(pieces.len(), 2);
        assert_eq!(pieces[0].len(), 2);
        assert!((pieces[0][0][1] - 2.0).abs() < 1e-12);
    }

    #[test]
    fn it_shows_what_the_workbench_shows() {
        let mut workbench = workbench();
        workbench.execute(Command::View(ViewChange::Component(Component::Radial)));
        let before = Polar::of(&workbench).expect("the joint turns");
        assert_eq!(before.spots.len(), workbench.loaded_session().len());
        assert!(before.after.is_empty());
        assert_eq!(before.before.len(), 2, "a line for each side");
        workbench.execute(Command::Edit(Edit::Identify));
        workbench.receive();
        workbench.execute(Command::View(ViewChange::OnlyAfter(true)));
        let after = Polar::of(&workbench).expect("the joint turns");
        assert!(after.division_mm < before.division_mm);
        assert!(after.before.is_empty() && after.after.len() == 2);
    }

    #[test]
    fn a_length_is_outside_the_circle_and_so_is_its_tolerance() {
        let mut polar = Polar::from_spots(vec![spot(0, 0.0, 1.0)], Component::Length, false, 1.0);
        polar.tolerance_mm = Some(0.2);
        assert_eq!(polar.band_mm(), Some([0.0, 0.2]));
        polar.component = Component::Radial;
        assert_eq!(polar.band_mm(), Some([-0.2, 0.2]));
        polar.tolerance_mm = Some(1e9);
        let [low, high] = polar.band_mm().expect("there is one");
        assert!(low > -10.0 && low < 0.0 && high > 0.0 && high < 10.0);
    }
}
