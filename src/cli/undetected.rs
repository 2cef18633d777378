//! What a diagnosis could not test, and what it did not find, in words.

use crate::diagnosis::{Diagnosis, Limit, Sight};
use crate::language::of_core;
use crate::present::limits;
use crate::present::numbers::significant;

use super::words::{effect, line, parameter, value};

/// What could not be tested and what was not found; of several joints a line for each reason.
pub(super) fn in_words(text: &mut String, d: &Diagnosis, arm: bool) {
    let not_testable = |name: &str, because: &str| {
        say!(
            "{effect}: not testable, {because}",
            effect = name,
            because = of_core(because)
        )
    };
    let plain = |name: &str| effect(name).into_owned();
    if arm {
        for one in limits::not_testable(d, plain) {
            line(text, not_testable(&of_core(&one.names), &one.says));
        }
        let lines = limits::limits(d, plain);
        if !lines.is_empty() {
            line(text, say!("not found; detection limits (95 %):"));
        }
        let (of_joints, others): (Vec<_>, Vec<_>) =
            lines.into_iter().partition(|line| line.of_joints);
        let says = |one: limits::Line| format!("{}: {}", one.names, one.says);
        for one in of_joints {
            line(text, format!("  {}", says(one)));
        }
        let others = others.into_iter().map(says);
        let others = others.collect::<Vec<_>>().join("; ");
        if !others.is_empty() {
            line(text, format!("  {others}"));
        }
    } else {
        let robot = &d.model.robot;
        for one in d
            .not_testable
            .iter()
            .filter(|one| limits::applies(robot, one))
        {
            let name = named(d, one.effect, one.joint);
            line(text, not_testable(&effect(&name), &one.because));
        }
        for limit in &d.not_found {
            let name = named(d, limit.effect, limit.joint);
            line(
                text,
                format!("{}: {}", effect(&name), limit_in_words(limit)),
            );
        }
    }
}

/// A name, of several joints with its joint, which counts from 0 here and from 1 in what is said.
pub(crate) fn named(d: &Diagnosis, effect: &str, joint: Option<usize>) -> String {
    match joint.filter(|_| d.model.robot.joints.len() > 1) {
        Some(joint) => format!("{effect} {}", joint + 1),
        None => effect.to_owned(),
    }
}

/// From which size an effect would have been seen.
fn limit_in_words(limit: &Limit) -> String {
    let (mut above, mut never) = (Vec::new(), Vec::new());
    for (name, size) in &limit.sizes {
        match limits::sight(limit.effect, name, *size) {
            Sight::Above(size) => above.push(value(name, &significant(size, 3))),
            Sight::AtAnySize => above.push(value(name, "0")),
            Sight::AtNoSize => never.push(parameter(name)),
        }
    }
    let mut parts = Vec::new();
    let at_any = |(_, size): &(&str, f64)| Sight::of(*size) == Sight::AtAnySize;
    if limit.sizes.iter().all(at_any) {
        parts.push(say!("detection limit 0: there is no noise").to_owned());
    } else if !above.is_empty() {
        parts.push(say!(
            "detection limit {sizes} (95 %)",
            sizes = above.join(", ")
        ));
    }
    if !never.is_empty() {
        parts.push(say!(
            "not observable with these poses: {which}",
            which = never.join(", ")
        ));
    }
    parts.join("; ")
}
