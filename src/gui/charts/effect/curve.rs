//! What one found effect does: the residual of the model without it, all other effects as they
//! were fitted, and the effect's own curve through it.
//!
//! ```text
//! residual = measured − p(without),      curve = p(with) − p(without)
//! ```
//!
//! Both are the model's own predictions ([`Model::predict`]) and nothing else. Where the effect
//! depends on nothing but the chart's variable (and the side) its curve is one line, drawn densely
//! from poses between the samples; that it is one is tried out on the samples. Elsewhere, as with
//! a droop that also depends on the pose, it is a value for each sample.

use crate::diagnosis::Diagnosis;
use crate::effects::{Inputs, JointValues, Over as Follows, Term};
use crate::gui::core::loaded_session::{Component, LoadedSession};
use crate::gui::core::overview::stride;
use crate::gui::core::quantity::{Over, Variable};
use crate::gui::core::search::{Search, terms};
use crate::lanes::minus;
use crate::model::Model;
use crate::numeric::extent;

/// Samples that are looked at to find out which component an effect has.
const SOME: usize = 500;
/// Points of a line.
const FINE: usize = 721;
/// A line that misses the effect at the samples by less than this part of its size is its curve.
const SAME: f64 = 0.02;

/// A sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EffectSample {
    pub(crate) sample: usize,
    /// Where it stands along the chart, inner units.
    pub(crate) x: f64,
    /// The component of the residual without the effect, mm.
    pub(crate) residual_mm: f64,
    /// The component of what the effect does, mm.
    pub(crate) effect_mm: f64,
    /// Side from which the joint came.
    pub(crate) side: f64,
}

/// A line of the effect's curve.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    /// Side from which the joint comes; 0: any.
    pub(crate) side: f64,
    /// Where along the chart, and how much, mm.
    pub(crate) points: Vec<[f64; 2]>,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EffectCurve {
    /// Name of the effect.
    pub(crate) effect: &'static str,
    /// What the chart stands over.
    pub(crate) over: Over,
    /// All samples that can be shown, by their place along the chart.
    pub(crate) spots: Vec<EffectSample>,
    /// The curve; empty where the effect depends on more than the variable.
    pub(crate) lines: Vec<Line>,
    /// Smallest and largest of everything, zero between them, mm.
    pub(crate) extent_mm: [f64; 2],
}

/// The model with everything that was found, and the model without one of it.
fn models(diagnosis: &Diagnosis, index: usize) -> Option<(Term, Model, Model)> {
    let terms = terms(diagnosis);
    let term = terms.get(index)?.clone()?;
    let mut with = diagnosis.model.clone();
    if !with.terms().iter().any(|t| t.same_column(&term)) {
        with = with.with_term(term.clone());
    }
    let without = with.without(|t| t.same_column(&term));
    Some((term, with, without))
}

/// What an effect's curve stands over: what it depends on.
fn over(term: &Term, loaded_session: &LoadedSession) -> Over {
    let variable = match term.effect.about().over {
        Follows::Load => Variable::Load,
        Follows::Temperature => Variable::Temperature,
        Follows::Time => Variable::Time,
        Follows::Speed => Variable::Speed,
        Follows::Travel => Variable::Travel,
        Follows::Angle | Follows::Side => Variable::Joint,
    };
    let joint = term.joint;
    let over = |variable| Over { variable, joint };
    let column = over(variable).column(loaded_session);
    let first = column.and_then(|c| c.iter().copied().find(|v| v.is_finite()));
    let changes = |c: &[f64]| c.iter().any(|v| v.is_finite() && Some(*v) != first);
    let varies = column.is_some_and(changes) || variable == Variable::Travel;
    // A load that never changes says nothing over the load.
    over(if varies { variable } else { Variable::Joint })
}

/// The component that an effect has most of.
pub(crate) fn strongest(
    loaded_session: &LoadedSession,
    diagnosis: &Diagnosis,
    index: usize,
) -> Option<Component> {
    let (_, with, without) = models(diagnosis, index)?;
    let usable = &loaded_session.overview.usable;
    let some = usable.iter().step_by(stride(usable.len(), SOME));
    let some: Vec<usize> = some.map(|s| *s as usize).collect();
    let inputs = Inputs::new(&loaded_session.session, JointValues::Commanded).select(&some);
    let (with, without) = (with.predict(&inputs), without.predict(&inputs));
    let planar = loaded_session.session.samples.z_mm.is_none();
    let offered = Component::ALL
        .into_iter()
        .filter(|c| *c != Component::Length && !(planar && c.out_of_plane()));
    let size = |component: &Component| -> f64 {
        let square = |(k, sample): (usize, &usize)| {
            let e = minus(with.get(k), without.get(k));
            loaded_session.component(e, *sample, *component).powi(2)
        };
        some.iter().enumerate().map(square).sum()
    };
    let sizes: Vec<_> = offered.map(|c| (size(&c), c)).collect();
    // Of equals the first: they are offered in the order in which they are understood.
    let largest = sizes.iter().map(|s| s.0).fold(0.0, f64::max);
    let found = sizes.iter().find(|s| s.0 >= largest * (1.0 - 1e-9));
    found.map(|s| s.1)
}

impl EffectCurve {
    /// The curve of a found effect, in one component.
    pub(super) fn of(
        loaded_session: &LoadedSession,
        search: &Search,
        index: usize,
        component: Component,
    ) -> Option<Self> {
        let diagnosis = search.answer.as_ref().ok()?;
        let (term, with, without) = models(diagnosis, index)?;
        let inputs = Inputs::new(&loaded_session.session, JointValues::Commanded);
        let (p_with, p_without) = (with.predict(&inputs), without.predict(&inputs));
        let over = over(&term, loaded_session);
        let planar = loaded_session.session.samples.z_mm.is_none();
        let at = |sample: usize| match over.variable {
            Variable::Travel => {
                let travel = inputs.travel[over.joint].as_ref();
                travel.map_or(f64::NAN, |travel| travel[sample])
            }
            _ => over.of(loaded_session, sample),
        };
        let flat = |mut e: [f64; 3]| {
            if planar {
                e[2] = 0.0;
            }
            e
        };
        let spot = |sample: &u32| {
            let sample = *sample as usize;
            let e = flat(minus(
                loaded_session.measured(sample),
                p_without.get(sample),
            ));
            let d = flat(minus(p_with.get(sample), p_without.get(sample)));
            EffectSample {
                sample,
                x: at(sample),
                residual_mm: loaded_session.component(e, sample, component),
                effect_mm: loaded_session.component(d, sample, component),
                side: loaded_session.side(over.joint, sample),
            }
        };
        let mut spots: Vec<EffectSample> =
            loaded_session.overview.usable.iter().map(spot).collect();
        spots.retain(|s| s.x.is_finite() && s.residual_mm.is_finite());
        spots.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.sample.cmp(&b.sample)));
        let sides: &[f64] =
            if term.effect.about().over.has_sides() && over.variable != Variable::Speed {
                &[-1.0, 1.0]
            } else {
                &[0.0]
            };
        let ends = spots.first().zip(spots.last()).map(|(a, b)| [a.x, b.x]);
        let line = |side: &f64| {
            let [from, to] = ends?;
            let inputs = between(&inputs, &spots, over, *side, [from, to])?;
            let nominal = Model::nominal(loaded_session.session.robot.clone()).predict(&inputs);
            let (a, b) = (with.predict(&inputs), without.predict(&inputs));
            let point = |(k, x): (usize, f64)| {
                let d = flat(minus(a.get(k), b.get(k)));
                [x, loaded_session.component_at(d, nominal.get(k), component)]
            };
            Some(Line {
                side: *side,
                points: places([from, to]).enumerate().map(point).collect(),
            })
        };
        let lines: Option<Vec<Line>> = sides.iter().map(line).collect();
        let lines = lines
            .filter(|lines| follow(lines, &spots))
            .unwrap_or_default();
        let curve = lines.iter().flat_map(|l| l.points.iter().map(|p| p[1]));
        let all = spots.iter().flat_map(|s| [s.residual_mm, s.effect_mm]);
        let all = all.chain(curve).chain([0.0]);
        Some(Self {
            effect: term.effect.about().id,
            over,
            extent_mm: extent(all),
            spots,
            lines,
        })
    }

    /// Where it begins and ends along the chart.
    pub(crate) fn ends(&self) -> [f64; 2] {
        let ends = self.spots.first().zip(self.spots.last());
        ends.map_or([0.0, 1.0], |(a, b)| [a.x, b.x])
    }
}

/// Places along a line.
fn places([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    let last = (FINE - 1) as f64;
    (0..FINE).map(move |k| from + (to - from) * k as f64 / last)
}

/// Poses from one end of the chart to the other; what is not its variable is as at the sample in
/// the middle.
fn between(
    inputs: &Inputs,
    spots: &[EffectSample],
    over: Over,
    side: f64,
    ends: [f64; 2],
) -> Option<Inputs<'static>> {
    let middle = spots.get(spots.len() / 2)?.sample;
    let mut poses = inputs.select(&[middle; FINE]);
    let column: Vec<f64> = places(ends).collect();
    match over.variable {
        Variable::Joint => poses.q[over.joint] = column.into(),
        Variable::Time => poses.time_s = Some(column.into()),
        Variable::Load => poses.load_kg = Some(column.into()),
        Variable::Temperature => {
            let warmth = |t: f64| t - crate::effects::inputs::REFERENCE_TEMPERATURE_C;
            poses.above_20_c = Some(column.into_iter().map(warmth).collect());
        }
        Variable::Speed => poses.speed[over.joint] = Some(column.into()),
        // The first sample has come from infinitely far.
        Variable::Travel => poses.travel[over.joint] = Some(column),
    }
    if side != 0.0 {
        poses.dir[over.joint] = Some(vec![side; FINE].into());
    }
    Some(poses)
}

/// Whether lines say at every sample what the effect is there.
fn follow(lines: &[Line], spots: &[EffectSample]) -> bool {
    let (mut missed, mut all) = (0.0, 0.0);
    for spot in spots {
        let line = lines.iter().find(|l| l.side == 0.0 || l.side == spot.side);
        let Some(line) = line else {
            return false;
        };
        missed += (line.at(spot.x) - spot.effect_mm).powi(2);
        all += spot.effect_mm * spot.effect_mm;
    }
    missed <= SAME * SAME * all
}

impl Line {
    /// The curve between its points.
    pub(crate) fn at(&self, x: f64) -> f64 {
        let above = self.points.partition_point(|p| p[0] < x);
        let above = above.clamp(1, self.points.len() - 1);
        let [a, b] = [self.points[above - 1], self.points[above]];
        let part = if b[0] > a[0] {
            (x - a[0]) / (b[0] - a[0])
        } else {
            0.0
        };
        a[1] + (b[1] - a[1]) * part.clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::gui::testing::workbench;
    use crate::gui::workbench::Workbench;

    /// A workbench on which a search has found the backlash that the simulation hid.
    fn searched() -> (Workbench, Arc<Search>) {
        let mut workbench = workbench();
        workbench.execute(Workbench::search);
        workbench.receive();
        let search = Search::of(
            Arc::clone(workbench.loaded_session()),
            &crate::gui::jobs::Watch::default(),
        );
        (workbench, Arc::new(search))
    }

    #[test]
    fn the_curve_is_the_difference_of_the_two_models_and_runs_through_the_residual() {
        let (workbench, search) = searched();
        let loaded_session = Arc::clone(workbench.loaded_session());
        let diagnosis = search.answer.as_ref().expect("it can be searched");
        let index = diagnosis.found.iter().position(|f| f.effect == "backlash");
        let index = index.expect("the backlash is found");
        let component = strongest(&loaded_session, diagnosis, index).expect("it has one");
        assert_eq!(component, Component::Tangential);
        let curve =
            EffectCurve::of(&loaded_session, &search, index, component).expect("it has a curve");
        assert_eq!(curve.over.variable, Variable::Joint);

        // What the models say, worked out here from the model with and without the term.
        let with = &diagnosis.model;
        let without = with.without(|t| t.effect.about().id == "backlash");
        assert_eq!(without.terms().len() + 1, with.terms().len());
        let inputs = Inputs::new(&loaded_session.session, JointValues::Commanded);
        let (a, b) = (with.predict(&inputs), without.predict(&inputs));
        for spot in &curve.spots {
            let d = minus(a.get(spot.sample), b.get(spot.sample));
            let e = minus(loaded_session.measured(spot.sample), b.get(spot.sample));
            let of = |v| loaded_session.component(v, spot.sample, component);
            assert!((spot.effect_mm - of(d)).abs() < 1e-12);
            assert!((spot.residual_mm - of(e)).abs() < 1e-12);
        }
        assert_eq!(curve.spots.len(), loaded_session.len());

        // Play depends on the side: a line for each, apart by the width times the radius.
        let [negative, positive] = &curve.lines[..] else {
            panic!("a line for each side, not {}", curve.lines.len());
        };
        let width_mm = 0.05_f64.to_radians() * 245.0;
        let apart = negative.at(0.3) - positive.at(0.3);
        assert!(
            (apart - width_mm).abs() < 0.05 * width_mm,
            "{apart} {width_mm}"
        );
        let rms = |left: fn(&EffectSample) -> f64| {
            let squares = curve.spots.iter().map(|s| left(s).powi(2)).sum::<f64>();
            (squares / curve.spots.len() as f64).sqrt()
        };
        let left_without = rms(|s| s.residual_mm);
        let left_with = rms(|s| s.residual_mm - s.effect_mm);
        assert!(left_with < 0.5 * left_without, "{left_with} {left_without}");
    }

    #[test]
    fn an_effect_that_is_not_there_has_no_curve() {
        let (workbench, search) = searched();
        let curve = EffectCurve::of(workbench.loaded_session(), &search, 99, Component::X);
        assert_eq!(curve, None);
    }

    #[test]
    fn effects_stand_over_what_they_depend_on() {
        let workbench = workbench();
        let loaded_session = workbench.loaded_session();
        let term = |id: &str| {
            let effect = crate::effects::find(id).expect("it is in the catalogue");
            over(&Term::absent(effect, 0, 0.0), loaded_session).variable
        };
        assert_eq!(term("frame-drift"), Variable::Time);
        assert_eq!(term("lost-motion"), Variable::Travel);
        assert_eq!(term("encoder-eccentricity"), Variable::Joint);
        // The load never changes in this session: over it there would be nothing to see.
        assert_eq!(term("link-droop"), Variable::Joint);
    }
}
