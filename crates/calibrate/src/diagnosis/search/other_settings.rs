//! The same name at another setting that is indistinguishable in the samples (aliasing): at n equal steps of a turn
//! the order k of a gear gives the same samples as n·j ± k, and over equal steps of its travel a screw of one lead the
//! same as one of another.
//!
//! Nothing is assumed of the steps: every setting of the name is tried in its place, so that nearly equal steps, half
//! of a turn or several grids at once are covered.

use crate::diagnosis::evidence::NEIGHBOURS;
use crate::diagnosis::evidence::{Fit, MOST_SETTINGS, Regression};
use crate::effects::{Setting, Term};
use crate::{odds, steps};

use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::evidence::rival::Rival;

/// Whether a term comes round with a setting: of others, as the time of a step, neighbours are an interval.
pub(super) fn comes_round(term: &Term) -> bool {
    let setting = term.effect.about().setting;
    matches!(setting, Setting::Order { .. } | Setting::Listed(_)) && term.coefficients.len() == 2
}

/// Whether two terms are the same name at settings that are not neighbours.
pub(crate) fn at_another_setting(one: &Term, other: &Term) -> bool {
    if one.effect.about().id != other.effect.about().id || one.joint != other.joint {
        return false;
    }
    let apart = (one.setting - other.setting).abs();
    comes_round(one)
        && match one.effect.about().setting {
            Setting::Order { .. } => apart > NEIGHBOURS,
            _ => apart > steps::EQUAL * one.setting.abs(),
        }
}

/// Rivals by other settings of the same names that the samples cannot rule out, of each name likeliest first.
pub(crate) fn open_settings(regression: &Regression, fit: &Fit) -> Vec<Rival> {
    let added = regression.added(fit).into_iter();
    let terms: Vec<&Term> = added.filter(|term| comes_round(term)).collect();
    terms
        .into_iter()
        .flat_map(|term| of_term(regression, fit, term))
        .collect()
}

fn of_term(regression: &Regression, fit: &Fit, term: &Term) -> Vec<Rival> {
    let reduced = regression.without_term(fit, term);
    let there = regression.added(&reduced);
    let enough = fit.ln_evidence - odds::OPEN.nats() - reduced.ln_evidence;
    let mut close: Vec<(f64, &Term)> = regression
        .scan(&reduced, CandidateSubset::Names)
        .iter()
        .filter_map(|score| {
            let other = regression.table.candidates[score.candidate].what.term()?;
            let free = !there.iter().any(|t| t.same_column(other));
            // The scan is of one step; the refit is near it.
            let near = score.ln_odds > enough - 1.0;
            (near && free && at_another_setting(term, other)).then_some((score.ln_odds, other))
        })
        .collect();
    // Where they are equally likely, they stay in the order of their settings.
    let key = |odds: f64| (odds * 1e3).round();
    close.sort_by(|a, b| {
        key(b.0)
            .total_cmp(&key(a.0))
            .then(a.1.setting.total_cmp(&b.1.setting))
    });
    let refitted = close
        .into_iter()
        .take(MOST_SETTINGS)
        .map(|(_, other)| Rival {
            removed: vec![term.clone()],
            instead: vec![other.clone()],
            fit: regression.fit(&reduced.model.with_term(other.clone()), &reduced.shapes),
        });
    refitted
        .filter(|r| r.fit.ln_evidence > fit.ln_evidence - odds::OPEN.nats())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::diagnosis::verdict::equal_steps::equal_steps;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    /// One axis with a gear's error of this order, at these angles.
    fn orders_at(order: f64, angles: &[f64]) -> (Vec<f64>, Option<String>) {
        let stops: Vec<String> = angles
            .iter()
            .map(|q| format!(r#"{{"q_deg":[{q}]}}"#))
            .collect();
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"gear","robot":{{"name":"r","joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-350,350]}}],
            "tool":{{"position_mm":[400,0,300],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.02}},"poses":{{"list":[{}]}},
            "effects":[{{"effect":"gear-transmission-error","joint":1,
            "parameters":{{"order":{order},"amplitude_deg":0.02,"phase_deg":20}}}}],
            "noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":3}}"#,
            stops.join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let (session, _) = simulate(&scenario, 1, unwatched).unwrap();
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let found = prepared.search(&|_| true).unwrap();
        let mut orders: Vec<f64> = prepared
            .regression
            .added(&found.fit)
            .iter()
            .map(|t| t.setting)
            .collect();
        let open = open_settings(&prepared.regression, &found.fit);
        orders.extend(open.iter().flat_map(|r| &r.instead).map(|t| t.setting));
        orders.sort_by(f64::total_cmp);
        (
            orders,
            equal_steps(&prepared, &open).map(|p| p.evidence.to_string()),
        )
    }

    #[test]
    fn orders_that_equal_steps_cannot_part_are_all_said() {
        let angles: Vec<f64> = (0..66).map(|k| 5.0 * f64::from(k) - 165.0).collect();
        let (orders, said) = orders_at(88.0, &angles);
        let wanted = [
            16.0, 56.0, 88.0, 128.0, 160.0, 200.0, 232.0, 272.0, 304.0, 344.0,
        ];
        assert_eq!(orders, wanted);
        let said = said.unwrap();
        assert!(said.contains("equal steps of 5.000°"), "{said}");
    }

    #[test]
    fn uneven_steps_leave_no_other_order() {
        let turn = |k: i32| 330.0 * (f64::from(k) * 0.754_877_666).fract() - 165.0;
        let angles: Vec<f64> = (0..90).map(turn).collect();
        assert_eq!(orders_at(88.0, &angles), (vec![88.0], None));
    }

    #[test]
    fn over_two_turns_an_order_between_whole_ones_is_found() {
        let turn = |k: i32| 690.0 * (f64::from(k) * 0.754_877_666).fract() - 345.0;
        let angles: Vec<f64> = (0..90).map(turn).collect();
        let (orders, _) = orders_at(100.5, &angles);
        assert_eq!(orders.len(), 1);
        assert!((orders[0] - 100.5).abs() < 0.03, "{orders:?}");
    }
}
