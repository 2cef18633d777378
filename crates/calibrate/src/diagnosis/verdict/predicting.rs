//! The model with everything that predicts, named or not.

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::named::{Figures, Named};
use super::repeating::{WithRepeating, with_repeating};
use super::values::Values;
use super::{unnamed, unseen};
use crate::answers::diagnosis::{HeldOut, Unexplained, Unnamed};
use crate::answers::identification::Identification;
use crate::answers::noise::Noise;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::kinematics::JointKind;
use crate::numeric::extent;

/// The model with everything that predicts: undetermined parameters at their expected values, and what repeats without
/// a name.
#[derive(Clone)]
pub(super) struct Predicting<'a> {
    pub(super) values: Values<'a>,
    /// With it, and of the names alone, on the samples that both are judged by.
    pub(super) figures: Figures,
    pub(super) names: Figures,
    pub(super) unnamed: Option<Unnamed>,
    /// The noise given it, where that is known better with it.
    pub(super) noise: Option<Noise>,
    /// Samples that are outliers of the names alone.
    pub(super) come_back: Vec<usize>,
}

impl<'a> Predicting<'a> {
    pub(super) fn with(
        prepared: &PreparedSearch<'a>,
        named: &Named<'a>,
        names: usize,
        unexplained: &Unexplained,
    ) -> Self {
        let completed = completed(prepared, &named.values, names, &named.figures);
        let (values, figures) =
            completed.unwrap_or_else(|| (named.values.clone(), named.figures.clone()));
        let plain = Self {
            values,
            names: figures.clone(),
            figures,
            unnamed: None,
            noise: None,
            come_back: Vec::new(),
        };
        let own = with_repeating(prepared, &plain.values, unexplained, &plain.figures);
        let with_curve = own.map_or(plain.clone(), |own| plain.with_curve(own));
        let unnamed = with_curve.unnamed.as_ref();
        let curve = unnamed.and_then(|unnamed| Some(unnamed.curve.as_ref()?.term.clone()));
        let (values, figures) = (&with_curve.values, &with_curve.figures);
        let rest = unnamed::with_rest(prepared, values, figures, curve.as_ref());
        rest.map_or(with_curve.clone(), |(values, figures, rest)| Self {
            values,
            figures,
            unnamed: Some(match with_curve.unnamed.clone() {
                Some(curve) => curve.and(rest),
                None => rest,
            }),
            ..with_curve
        })
    }

    /// With the curve over the only joint in addition.
    fn with_curve(&self, own: WithRepeating) -> Self {
        let mut names = self.names.clone();
        names.held_out = own.figures.held_out.clone();
        if let Some(gaps) = &mut names.held_out.gaps {
            gaps.end_mm = own.unnamed.held_out_mm[0].min(gaps.identified_mm);
        }
        Self {
            values: self.values.clone(),
            names,
            figures: own.figures,
            unnamed: Some(own.unnamed),
            noise: own.noise,
            come_back: own.come_back,
        }
    }

    /// No error of unseen poses where those that were measured are too few to predict others.
    pub(super) fn unless_little_is_shown(
        mut self,
        prepared: &PreparedSearch,
        identification: &Identification,
    ) -> Self {
        let expected_mm = identification.expected.as_ref().map(|e| e.rms_mm);
        if expected_mm.is_some_and(|mm| mm > self.figures.gap.start_mm)
            && self.values.is_completed()
            && shows_little(&self.values)
            && self.values.problem.session.has_plain_points()
            && unseen::is_cross_fitted(prepared)
        {
            self.figures.held_out = HeldOut::none(text!(
                "the poses predict each other, and say so little of others that the model is expected to be off by more there than the nominal robot was here"
            ));
            self.names.held_out.gaps = None;
        }
        self
    }
}

/// Whether a joint stood still, or there are fewer places than a geometry needs. Where all joints move, poses that
/// were not measured are of the kind that was, however narrow it is, and the error of predicting them is informative.
fn shows_little(values: &Values) -> bool {
    let inputs = &values.problem.inputs;
    let joints = values.model.robot.joints.iter();
    let least = joints.map(|joint| STANDSTILL[usize::from(joint.kind == JointKind::Prismatic)]);
    let least: Vec<f64> = least.collect();
    let stands = |(q, least): (&Cow<[f64]>, &f64)| {
        let [from, to] = extent(q.iter());
        to - from < *least
    };
    let place = |sample: usize| -> Vec<i64> {
        let steps = inputs
            .q
            .iter()
            .zip(&least)
            .map(|(q, least)| q[sample] / least);
        steps.map(|steps| steps.round() as i64).collect()
    };
    let places: BTreeSet<Vec<i64>> = (0..inputs.len()).map(place).collect();
    inputs.q.iter().zip(&least).any(stands) || 3 * places.len() < values.model.coefficient_count()
}

/// A joint whose values differ by less stood still, rad and mm: of a link a turn shows less than a sixtieth, and with a usual
/// noise of 0.02 mm a slide shows its direction no better than to 1/50.
const STANDSTILL: [f64; 2] = [1.0 / 60.0, 1.0];

/// The values with the parameters that no sample determines at their expected values; held-out samples are predicted
/// with them, and where the model has names no worse than `identify` does.
fn completed<'a>(
    prepared: &PreparedSearch,
    values: &Values<'a>,
    names: usize,
    figures: &Figures,
) -> Option<(Values<'a>, Figures)> {
    let completed = values.clone().completed(prepared);
    let mut figures = figures.clone();
    let apart = unseen::of_model(prepared, &completed.model);
    if let (Some(end_mm), Some(gaps)) = (apart, &mut figures.held_out.gaps) {
        if names == 0 {
            gaps.identified_mm = end_mm;
        } else if end_mm > gaps.identified_mm {
            return None;
        }
        gaps.end_mm = end_mm;
    }
    Some((completed, figures))
}
