//! Several orders over the same joint, fitted together.
//!
//! A search adds one order after the other, and the first of some neighbours settles between them: a number that is
//! optimal for it alone and wrong together with the others. So all orders are tried as whole numbers at once, and each
//! is refined given the others. The uncertainty of an order that is not whole adds to that of amplitudes and phases:
//! with D the derivative of the rows with respect to the orders and J all other columns,
//!
//! ```text
//! V = (Dᵀ (1 − J J⁺) D)⁻¹,   cov(β) = (JᵀJ)⁻¹ + J⁺D V (J⁺D)ᵀ
//! ```

use nalgebra::DMatrix;

use crate::effects::{Term, stated};
use crate::fit::noise::Noise;
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::linear::{Basis, gram, reject_all};
use crate::model::Model;
use crate::{budget, rounding};

use crate::diagnosis::candidates::table::Candidate;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;

fn takes_fractions(term: &Term) -> bool {
    term.effect.about().setting.takes_fractions()
}

fn is_fraction(term: &Term) -> bool {
    takes_fractions(term) && term.setting.fract() != 0.0
}

/// The likeliest of a fit's orders as they are, all of them whole, and each refined given the others.
pub(crate) fn together(regression: &Regression, fit: Fit) -> Fit {
    let orders = |fit: &Fit| -> Vec<Term> {
        let added = regression.added(fit).into_iter().cloned();
        added.filter(takes_fractions).collect()
    };
    let own = orders(&fit);
    if own.len() < 2 || !own.iter().any(is_fraction) {
        return fit;
    }
    // Sets before single orders: rounded one by one, an order between two keeps both away.
    let joints = 0..regression.base.robot.joints.len();
    let sets = joints.filter_map(|joint| whole_set(regression, &fit, joint));
    let whole: Vec<Fit> = sets.chain(all_whole(regression, &fit, &own)).collect();
    let mut best = fit;
    for next in whole {
        if next.ln_evidence > best.ln_evidence + 1e-3 {
            best = next;
        }
    }
    for _ in 0..budget::ROUNDS {
        let before = best.ln_evidence;
        for term in orders(&best) {
            let reduced = regression.without_term(&best, &term);
            let refined = regression.refined_order(&reduced, &at(&term, term.setting.round()));
            let taken = regression
                .added(&reduced)
                .iter()
                .any(|t| t.same_column(&refined));
            if taken || refined.same_column(&term) {
                continue;
            }
            let absent = Term::absent(refined.effect, refined.joint, refined.setting);
            let next = regression.fit(&reduced.model.with_term(absent), &reduced.shapes);
            if next.ln_evidence > best.ln_evidence {
                best = next;
            }
        }
        if best.ln_evidence <= before + 1e-3 {
            break;
        }
    }
    best
}

/// The fit with every order at the whole number next to it, where these differ.
fn all_whole(regression: &Regression, fit: &Fit, orders: &[Term]) -> Option<Fit> {
    let mut reduced = fit.model.clone();
    let mut whole: Vec<Term> = Vec::new();
    for term in orders {
        reduced = reduced.without(|t| t.same_column(term));
        let next = at(term, term.setting.round());
        if whole.iter().any(|t| t.same_column(&next)) {
            return None;
        }
        whole.push(next);
    }
    let absent = |t: &Term| Term::absent(t.effect, t.joint, t.setting);
    let model = whole.iter().fold(reduced, |m, t| m.with_term(absent(t)));
    Some(regression.fit(&model, &fit.shapes))
}

/// Orders that are at most so far apart are of one set …
const TOGETHER: f64 = 4.0;
/// … and so far around them whole numbers are tried in their place …
const AROUND: f64 = 3.0;
/// … of sets of so many at most.
const MOST_OF_A_SET: usize = 4;

/// The fit with the likeliest set of whole orders in the place of neighbouring ones of which some are fractions: as
/// many, or one more. From one order between two no step leads to both.
fn whole_set(regression: &Regression, fit: &Fit, joint: usize) -> Option<Fit> {
    let added = regression.added(fit).into_iter();
    let mut own: Vec<Term> = added
        .filter(|t| t.joint == joint && takes_fractions(t))
        .cloned()
        .collect();
    own.sort_by(|a, b| a.setting.total_cmp(&b.setting));
    let first = own.iter().position(is_fraction)?;
    let near = |t: &Term| (t.setting - own[first].setting).abs() <= TOGETHER;
    let set: Vec<Term> = own.iter().filter(|t| near(t)).cloned().collect();
    let (low, high) = (set.first()?.setting, set.last()?.setting);
    if set.len() > MOST_OF_A_SET {
        return None;
    }
    let model = fit.model.without(|t| set.iter().any(|s| s.same_column(t)));
    let reduced = regression.fit(&model, &fit.shapes);
    let there = regression.added(&reduced);
    let candidates: Vec<&Candidate> = regression
        .table
        .candidates
        .iter()
        .filter(|c| {
            c.what.term().is_some_and(|t| {
                let inside = t.setting >= low - AROUND && t.setting <= high + AROUND;
                let free = !there.iter().any(|o| o.same_column(t));
                inside && free && t.joint == joint && takes_fractions(t)
            })
        })
        .collect();
    let terms: Vec<&Term> = candidates.iter().filter_map(|c| c.what.term()).collect();
    let mut free = regression.white_columns(&candidates);
    reject_all(&reduced.basis.q, &mut free);
    let all = gram(&free);
    let pulls = free.tr_mul(&reduced.residual);
    let gain = |of: &[usize]| {
        let at: Vec<usize> = of.iter().flat_map(|k| [2 * k, 2 * k + 1]).collect();
        let own = all.select_rows(&at).select_columns(&at);
        let pull = pulls.select_rows(&at);
        own.cholesky().map_or(0.0, |c| pull.dot(&c.solve(&pull)))
    };
    let mut best: Option<Fit> = None;
    for count in set.len().max(2)..=(set.len() + 1).min(MOST_OF_A_SET) {
        let sets = sets_of(terms.len(), count).into_iter();
        let Some((_, likeliest)) = sets
            .map(|s| (gain(&s), s))
            .max_by(|a, b| a.0.total_cmp(&b.0))
        else {
            continue;
        };
        let with = likeliest.iter().map(|k| terms[*k].clone());
        let model = with.fold(reduced.model.clone(), |m, t| m.with_term(t));
        let next = regression.fit(&model, &reduced.shapes);
        if best
            .as_ref()
            .is_none_or(|b| next.ln_evidence > b.ln_evidence)
        {
            best = Some(next);
        }
    }
    best
}

/// Every choice of `count` of so many, each in ascending order.
fn sets_of(of: usize, count: usize) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..count {
        let longer = all.iter().flat_map(|set| {
            let from = set.last().map_or(0, |last| last + 1);
            (from..of).map(|next| [set.as_slice(), &[next]].concat())
        });
        all = longer.collect();
    }
    all
}

fn at(term: &Term, setting: f64) -> Term {
    Term {
        setting,
        ..term.clone()
    }
}

/// The uncertainty of the orders of a fitted model that are not whole.
pub(crate) struct OrderSpread {
    orders: Vec<Term>,
    /// V, and `J⁺D V (J⁺D)ᵀ` of the model's coefficients.
    variance: DMatrix<f64>,
    contribution: DMatrix<f64>,
}

impl OrderSpread {
    /// `None` where every order is whole, or where the samples do not determine them.
    pub(crate) fn of(problem: &Problem, model: &Model) -> Option<Self> {
        // An order that follows from a gear ratio is not fitted.
        let fitted = |t: &&Term| is_fraction(t) && stated(&model.robot, t).is_none();
        let fractions = model.terms().iter().filter(fitted);
        let orders: Vec<Term> = fractions.cloned().collect();
        if orders.is_empty() {
            return None;
        }
        let part = problem.thinned(budget::SAMPLES);
        let rows = Rows::of(&part).seen_by(model);
        let moved = |order: &Term, by: f64| {
            let terms = model.terms().iter().map(|t| Term {
                setting: t.setting + if t.same_column(order) { by } else { 0.0 },
                ..t.clone()
            });
            rows.extract(&Model::new(model.robot.clone(), terms.collect()))
                .0
        };
        let (_, columns) = rows.extract(model);
        let of_kinds = problem.observed.as_ref();
        let of_kinds = of_kinds.map(|layer| Noise::white(layer.unit_mm));
        let noise = problem.noise.as_ref().or(of_kinds.as_ref())?;
        let basis = Basis::new(&noise.whitened(&rows, &columns));
        let mut free = DMatrix::zeros(rows.len(), orders.len());
        let mut along = DMatrix::zeros(columns.ncols(), orders.len());
        for (k, order) in orders.iter().enumerate() {
            let change = (moved(order, -rounding::DIFFERENCE) - moved(order, rounding::DIFFERENCE))
                / (2.0 * rounding::DIFFERENCE);
            let change = noise.whitened_vector(&rows, &change);
            along.set_column(k, &basis.solve(&change));
            free.set_column(k, &basis.reject(&change));
        }
        let share = rows.count() as f64 / problem.rows().max(1) as f64;
        let variance = free.tr_mul(&free).cholesky()?.inverse() * share;
        Some(Self {
            contribution: &along * &variance * along.transpose(),
            variance,
            orders,
        })
    }

    /// Adds the uncertainty of the orders to a covariance of the coefficients, which may be followed by others.
    pub(crate) fn add_to(&self, covariance: &mut DMatrix<f64>) {
        let own = self.contribution.nrows();
        if covariance.nrows() >= own {
            let mut block = covariance.view_mut((0, 0), (own, own));
            block += &self.contribution;
        }
    }

    /// The 95 % interval of one of the orders.
    pub(crate) fn interval(&self, order: &Term) -> Option<[f64; 2]> {
        let at = self.orders.iter().position(|t| t.same_column(order))?;
        let half = 1.96 * self.variance[(at, at)].sqrt();
        half.is_finite()
            .then_some([order.setting - half, order.setting + half])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::candidates::table::CandidateKind;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    #[test]
    fn neighbouring_orders_that_settled_between_each_other_become_whole_together() {
        let turn = |k: i32| 330.0 * (f64::from(k) * 0.754_877_666).fract() - 165.0;
        let stops: Vec<String> = (0..200)
            .map(|k| format!(r#"{{"q_deg":[{}]}}"#, turn(k)))
            .collect();
        let effect = |order: u32, amplitude: f64| {
            format!(
                r#"{{"effect":"gear-transmission-error","joint":1,"parameters":{{"order":{order},
                "amplitude_deg":{amplitude},"phase_deg":{}}}}}"#,
                7 * order
            )
        };
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"wheel","robot":{{"name":"r","joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-170,170]}}],
            "tool":{{"position_mm":[400,0,300],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.02}},"poses":{{"list":[{}]}},
            "effects":[{},{},{}],"noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":3}}"#,
            stops.join(","),
            effect(20, 0.015),
            effect(21, 0.03),
            effect(22, 0.015)
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let (session, _) = simulate(&scenario, 1, unwatched).unwrap();
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let gear = |what: &CandidateKind| what.term().filter(|t| takes_fractions(t)).cloned();
        let mut candidates = regression.table.candidates.iter();
        let gear = candidates.find_map(|c| gear(&c.what)).unwrap();
        let model = [20.3, 21.2, 22.3]
            .iter()
            .fold(regression.base.clone(), |m, k| {
                m.with_term(Term::absent(gear.effect, gear.joint, *k))
            });
        let fit = together(regression, regression.fit(&model, &[]));
        let settings: Vec<f64> = regression.added(&fit).iter().map(|t| t.setting).collect();
        assert_eq!(settings, [20.0, 21.0, 22.0]);
        assert!(OrderSpread::of(&prepared.problem, &fit.model).is_none());

        // An order that is not whole makes its phase uncertain.
        let model = regression
            .base
            .with_term(Term::absent(gear.effect, gear.joint, 21.1));
        let alone = regression.fit(&model, &[]);
        let spread = OrderSpread::of(&prepared.problem, &alone.model).unwrap();
        let mut covariance = DMatrix::zeros(
            alone.model.coefficient_count(),
            alone.model.coefficient_count(),
        );
        spread.add_to(&mut covariance);
        assert!(covariance.trace() > 0.0);
        let order = alone
            .model
            .terms()
            .iter()
            .find(|t| t.setting == 21.1)
            .unwrap();
        let [low, high] = spread.interval(order).unwrap();
        assert!(
            low < 21.1 && 21.1 < high && high - low < 0.2,
            "{low} {high}"
        );
    }
}
