//! Effects that the session cannot show.

use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::table::NotTestable;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;

/// Effects that the conditions rule out, and names that are linearly dependent on the base.
pub(crate) fn not_testable(regression: &Regression, base: &Fit) -> Vec<NotTestable> {
    let mut all = regression.table.not_testable.clone();
    let around = regression.projections(base, CandidateSubset::Names);
    let mut seen: Vec<(&'static str, usize, bool, bool)> = Vec::new();
    for candidate in &regression.table.candidates {
        let Some(term) = candidate.what.term() else {
            continue;
        };
        let about = term.effect.about();
        let visible = around.factor(candidate).1 > 0;
        match seen
            .iter_mut()
            .find(|s| s.0 == about.id && s.1 == term.joint)
        {
            Some(one) => one.2 |= visible,
            None => seen.push((about.id, term.joint, visible, about.per_joint)),
        }
    }
    for (effect, joint, visible, per_joint) in seen {
        if !visible {
            all.push(NotTestable {
                effect,
                joint: per_joint.then_some(joint),
                because: if base.model.robot.joints.len() > 1 {
                    text!("in these samples it cannot be told from the geometry: frame, zero offsets, links and tool")
                } else {
                    text!("in these samples it cannot be told from joint-zero-offset and link-length")
                },
            });
        }
    }
    all
}
