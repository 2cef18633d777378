//! Effects that the session cannot show.

use super::arena::{Arena, Fit};
use super::candidates::NotTestable;

/// What the conditions forbid, and names of which nothing is left beside the base.
pub(crate) fn not_testable(arena: &Arena, base: &Fit) -> Vec<NotTestable> {
    let mut all = arena.table.not_testable.clone();
    let projected = arena.projected(&base.basis);
    let mut seen: Vec<(&'static str, usize, bool, bool)> = Vec::new();
    for candidate in &arena.table.candidates {
        let Some(term) = candidate.what.term() else {
            continue;
        };
        let about = term.effect.about();
        let visible = arena.factor(&projected, candidate).1 > 0;
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
                    "in these samples it cannot be told from the geometry: frame, zero offsets, \
                     links and tool"
                        .to_owned()
                } else {
                    "in these samples it cannot be told from joint-zero-offset and link-length"
                        .to_owned()
                },
            });
        }
    }
    all
}
