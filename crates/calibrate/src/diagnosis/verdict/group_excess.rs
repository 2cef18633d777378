//! Whether the residuals belong to one group of samples: a target, a socket, a setup, a station, a plane, an anchor
//! whose residuals are larger than those of the others of its kind.

use super::excess::excess_of;
use crate::model::shapes::Where;
use crate::odds;
use crate::sessions::{Group, Session};

/// With fewer samples a group shows nothing.
const FEWEST: usize = 5;

/// The group, from its first sample to its last (counted from 1), where it is one. `lengths_mm` are the residuals of
/// every sample.
pub(crate) fn place(session: &Session, lengths_mm: &[f64]) -> Option<Where> {
    let known = || (0..lengths_mm.len()).filter(|i| lengths_mm[*i].is_finite());
    let mut tried = 0.0;
    let mut best: Option<(f64, Group, usize)> = None;
    for group in Group::ALL.into_iter().filter(|g| g.count(session) > 1) {
        for index in 0..group.count(session) {
            let mean_square = |inside: bool| {
                let own = known().filter(|i| {
                    let of = group.of(session, *i);
                    of.is_some() && (of == Some(index)) == inside
                });
                let squares: Vec<f64> = own.map(|i| lengths_mm[i].powi(2)).collect();
                let n = squares.len();
                (n >= FEWEST).then(|| (squares.iter().sum::<f64>() / n as f64, n as f64))
            };
            let (Some(own), Some(others)) = (mean_square(true), mean_square(false)) else {
                continue;
            };
            tried += 1.0;
            let ratio2 = own.0 / others.0.max(f64::MIN_POSITIVE);
            let p = excess_of(ratio2, own.1, others.1, 3.0).p;
            if best.is_none_or(|best| p < best.0) {
                best = Some((p, group, index));
            }
        }
    }
    let (_, group, index) = best.filter(|best| best.0 * tried < odds::CLEAR.chance())?;
    let rows: Vec<usize> = known()
        .filter(|i| group.of(session, *i) == Some(index))
        .collect();
    Some(Where::Range {
        variable: format!("{} {}", group.name(), group.name_of(session, index)),
        from: *rows.first()? as f64 + 1.0,
        to: *rows.last()? as f64 + 1.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    /// One axis that is measured with two targets, so many samples.
    fn axis(count: usize) -> Session {
        let text = format!(
            r#"{{"format":"truepose-scenario/1","name":"r","robot":{{"name":"r","joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-170,170]}}],
            "tool":{{"position_mm":[320,0,210],"quaternion_wxyz":[1,0,0,0]}}}},
            "targets":{{"A":[0,0,0],"B":[90,30,50]}},"instrument":{{"name":"t","sigma_mm":0.02}},
            "poses":{{"random":{{"count":{count}}}}},"effects":[],"noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":4}}"#
        );
        let scenario = parse_scenario(text.as_bytes()).unwrap().scenario;
        simulate(&scenario, 1, unwatched).unwrap().0
    }

    #[test]
    fn one_target_that_leaves_more_is_the_place() {
        let session = axis(60);
        let n = session.samples.len();
        assert_eq!(place(&session, &vec![0.03; n]), None);
        let own = |i: usize| Group::Target.of(&session, i) == Some(1);
        let more: Vec<f64> = (0..n).map(|i| if own(i) { 0.12 } else { 0.03 }).collect();
        let Some(Where::Range { variable, .. }) = place(&session, &more) else {
            panic!("a place");
        };
        assert_eq!(variable, "target B");
    }
}
