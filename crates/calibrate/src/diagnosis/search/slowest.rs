//! The slowest alias of a wave: over equal steps a wave gives the same samples as slower ones and quicker ones,
//!
//! ```text
//! f' = |f − n/h|   (f in waves per rad or mm, h the step, n whole)
//! ```
//!
//! (Nyquist: nothing quicker than half a wave a step can be distinguished from a slower one.) Between the steps they
//! differ, and a table has to follow one: the slowest, whose error is the smallest where it is wrong. Where the name
//! has no such setting it is withdrawn, and a curve over the joint takes its place.

use std::f64::consts::TAU;

use crate::effects::{Setting, Term};
use crate::{odds, rounding};

use super::found::SearchResult;
use super::other_settings::comes_round;
use super::prepare::PreparedSearch;
use crate::diagnosis::evidence::{Fit, Regression};
use crate::model::shapes::{Direction, Profile, Shape, Variable};
use crate::steps::step_of;

/// Puts the slowest reading in the place of each wave.
pub(crate) fn readings(prepared: &PreparedSearch, found: &mut SearchResult) {
    let regression = &prepared.regression;
    let waves = regression
        .added(&found.fit)
        .into_iter()
        .filter(|t| comes_round(t));
    let waves: Vec<Term> = waves.cloned().collect();
    for term in waves {
        let Some(slower) = Slower::than(regression, &term) else {
            continue;
        };
        let reduced = regression.without_term(&found.fit, &term);
        let free = |other: &Term| {
            !regression
                .added(&reduced)
                .iter()
                .any(|t| t.same_column(other))
        };
        if let Some(other) = slower.as_name(regression, &term).filter(|o| free(o)) {
            let other = regression.refined_order(&reduced, &other);
            let model = reduced.model.with_term(other);
            let fit = regression.fit(&model, &reduced.shapes);
            if fit.ln_evidence > found.fit.ln_evidence - odds::OPEN.nats() {
                found.fit = fit;
            }
            continue;
        }
        let fit = slower.as_shape(regression, &reduced, &term);
        // The steps are nearly equal, and part the readings.
        let same = 0.5 * regression.m() * (fit.rss / found.fit.rss.max(f64::MIN_POSITIVE)).ln();
        if same < odds::OPEN.nats() {
            found.fit = fit;
            found.withdrawn.push(term);
        }
    }
}

/// A slower wave that is the same samples.
struct Slower {
    /// Waves per rad or mm.
    frequency: f64,
}

impl Slower {
    /// `None` where there is none.
    fn than(regression: &Regression, term: &Term) -> Option<Self> {
        if regression.is_stated(term) {
            return None;
        }
        let own = match term.effect.about().setting {
            Setting::Order { .. } => term.setting / TAU,
            _ => 1.0 / term.setting,
        };
        let step = step_of(&regression.rows.inputs.q[term.joint])?;
        let per_step = own * step;
        let frequency = (per_step - per_step.round()).abs() / step;
        (frequency < own * (1.0 - rounding::WRITTEN)).then_some(Self { frequency })
    }

    /// The same name at that setting, where it has it.
    fn as_name(&self, regression: &Regression, term: &Term) -> Option<Term> {
        let at = |setting: f64| Term {
            setting,
            ..term.clone()
        };
        let setting = term.effect.about().setting;
        if let Setting::Order { from, to } = setting {
            let order = self.frequency * TAU;
            let inside = order >= f64::from(from) && order <= f64::from(to);
            let fractions = setting.takes_fractions();
            return inside.then(|| at(if fractions { order } else { order.round() }));
        }
        let candidates = regression.table.candidates.iter();
        let mut names = candidates.filter_map(|c| c.what.term());
        let is = |other: &&Term| {
            other.effect.about().id == term.effect.about().id
                && other.joint == term.joint
                && (other.setting * self.frequency - 1.0).abs() < rounding::WRITTEN
        };
        names.find(is).cloned()
    }

    /// A wave without a name.
    fn as_shape(&self, regression: &Regression, reduced: &Fit, term: &Term) -> Fit {
        let placed = regression.placed(Shape {
            variable: Variable::Joint(term.joint),
            direction: Direction::Tangential(term.joint),
            profile: Profile::Periodic {
                cycles: self.frequency * TAU,
                harmonics: 1,
            },
            tried: 1.0,
        });
        let shapes = reduced.shapes.iter().cloned().chain([placed]);
        regression.fit(&reduced.model, &shapes.collect::<Vec<_>>())
    }
}
