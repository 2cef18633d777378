//! The answer of `truepose plan` in words.

use std::fmt::Write as _;

use crate::design::geometry::Geometry;
use crate::design::needs::Untestable;
use crate::design::pair_separation::Separation;
use crate::design::plan::{Plan, Subject};
use crate::diagnosis::{Detectability, NextPose};
use crate::language::spoken;
use crate::present::numbers::significant;
use crate::present::table::width;

use super::words::{effect, effects, line, padded, parameter, value};

/// How much room names of effects take in a list of limits, at least.
const NAMES: usize = 28;

/// The answer.
pub(super) fn in_words(plan: &Plan) -> String {
    let mut text = String::new();
    let head = match plan.subject {
        Subject::Session => say!(
            "{session}: to measure next, {poses} poses",
            session = plan.name,
            poses = plan.poses.len()
        ),
        Subject::Robot => say!(
            "{robot}: a first measurement, {poses} poses",
            robot = plan.name,
            poses = plan.poses.len()
        ),
    };
    line(&mut text, head);
    for [explanation, instead] in &plan.open {
        let open = say!(
            "open: {explanation} or {instead}",
            explanation = effects(explanation, " + "),
            instead = effects(instead, " + ")
        );
        line(&mut text, open);
    }
    if let Some(separation) = &plan.separation {
        line(&mut text, separated(separation));
    }
    if plan.poses.is_empty() && plan.separation.is_none() {
        let nothing = say!(
            "nothing is ambiguous and no pose unlocks anything; --poses N lists poses that sharpen what can be seen"
        );
        line(&mut text, nothing);
    }
    text.push_str(&table(plan));
    for target in &plan.targets {
        let at = target.position_mm;
        let new = plan
            .poses
            .iter()
            .any(|p| p.target_mm.is_some() && p.target.as_ref() == Some(&target.name));
        if new {
            let new = say!(
                "reflector {target}: at ({at}) mm in the tool frame; survey where it really is, and declare it in \
                 the session's targets",
                target = target.name,
                at = format!("{:.0}, {:.0}, {:.0}", at.x, at.y, at.z)
            );
            line(&mut text, new);
        }
    }
    for (names, locked) in grouped(&plan.enables) {
        let enabled = say!(
            "{effect} becomes testable: {needs}",
            effect = names,
            needs = needs(locked)
        );
        line(&mut text, enabled);
    }
    for (names, locked) in grouped(&plan.cannot) {
        let help = if locked.needs.is_empty() {
            say!("no pose helps").to_owned()
        } else {
            needs(locked)
        };
        let stays = say!(
            "{effect} stays untestable, {because}: {help}",
            effect = names,
            because = spoken(&locked.because),
            help = help
        );
        line(&mut text, stays);
    }
    if let Some(geometry) = &plan.geometry {
        of_geometry(geometry, plan, &mut text);
    }
    if !plan.poses.is_empty() && !plan.seen_above().is_empty() {
        limits(plan, &mut text);
    }
    text
}

/// What the poses do for two effects that are to be told apart.
fn separated(separation: &Separation) -> String {
    let [a, b] = separation.between.map(|n| effect(n.id));
    if let Some(because) = &separation.impossible {
        return say!(
            "no pose tells {a} from {b}: {because}",
            a = a,
            b = b,
            because = spoken(because)
        );
    }
    let percent = |share: f64| format!("{:.1}", 100.0 * share);
    let [before, back_before] = separation.left_before.map(percent);
    let [after, back_after] = separation.left_after.map(percent);
    let mut text = say!(
        "what {b} cannot imitate of {a}: {before} % now, {after} % with these poses; the other way round \
         {back_before} % and {back_after} %",
        b = b,
        a = a,
        before = before,
        after = after,
        back_before = back_before,
        back_after = back_after
    );
    if separation.poses.is_empty() {
        text += say!("; what is there decides already");
    } else if !separation.decided {
        text += say!("; an effect that is just seen may stay undecided, more poses would help");
    }
    text
}

fn of_geometry(geometry: &Geometry, plan: &Plan, text: &mut String) {
    let so_far = match plan.subject {
        Subject::Session => say!("with the session alone").to_owned(),
        Subject::Robot => say!("with {poses} random poses", poses = plan.poses.len()),
    };
    let four = |mm: f64| format!("{mm:.4}");
    let (before, after) = (&geometry.before, &geometry.after);
    let index = say!(
        "geometry: {parameters} parameters; observability index {before} mm {so_far}, {after} mm with these poses",
        parameters = geometry.parameters,
        before = four(before.observability),
        so_far = so_far,
        after = four(after.observability)
    );
    line(text, index);
    let error = say!(
        "expected error of the model over the joint ranges: RMS {before} mm {so_far}, {after} mm with these poses; 95 \
         % of the places {p95_before} and {p95_after} mm",
        before = four(before.error.rms_mm),
        so_far = so_far,
        after = four(after.error.rms_mm),
        p95_before = four(before.error.p95_mm),
        p95_after = four(after.error.p95_mm)
    );
    line(text, error);
    if let Some((mm, poses)) = geometry.enough {
        let enough = say!(
            "{poses} poses are enough for {mm} mm at 95 % of the places",
            poses = poses,
            mm = mm
        );
        line(text, enough);
    }
    let each = geometry.curve.iter().map(|(poses, error)| {
        say!(
            "{poses} poses {mm} mm",
            poses = poses,
            mm = four(error.p95_mm)
        )
    });
    let each = each.collect::<Vec<_>>().join(", ");
    line(text, say!("95 % of the places with {poses}", poses = each));
    let surroundings = say!(
        "limits are all that is known of the surroundings: look where the way between the poses leads"
    );
    line(text, surroundings);
}

fn limits(plan: &Plan, text: &mut String) {
    let head = say!(
        "with these poses and a noise of {sigma} mm an effect will be seen (95 %) above",
        sigma = format!("{:.4}", plan.sigma_mm)
    );
    line(text, head);
    let limits = plan.seen_above();
    let names: Vec<String> = limits
        .iter()
        .map(|limit| effect(&named(limit.effect, limit.joint)).into_owned())
        .collect();
    let wide = names.iter().map(|name| width(name) + 2).max();
    let wide = wide.unwrap_or(0).max(NAMES);
    for (limit, name) in limits.iter().zip(&names) {
        let sizes: Vec<String> = limit
            .sizes
            .iter()
            .map(|(name, size)| match Detectability::of(*size) {
                Detectability::Above(size) => value(name, &significant(size, 3)),
                Detectability::AtAnySize => value(name, "0"),
                Detectability::AtNoSize => {
                    say!("{parameter} of no size", parameter = parameter(name))
                }
            })
            .collect();
        line(
            text,
            format!("  {}{}", padded(name, wide), sizes.join(", ")),
        );
    }
    for pair in &plan.expected.alike {
        let alike = say!(
            "{one} and {other} will look alike (correlation {correlation})",
            one = effect(&named(pair.one.0, pair.one.1.map(|j| j + 1))),
            other = effect(&named(pair.other.0, pair.other.1.map(|j| j + 1))),
            correlation = format!("{:.3}", pair.correlation)
        );
        line(text, alike);
    }
}

fn named(effect: &str, joint: Option<usize>) -> String {
    joint.map_or_else(|| effect.to_owned(), |joint| format!("{effect} {joint}"))
}

/// Joints that lack the same for the same effect stand together.
fn grouped(all: &[Untestable]) -> Vec<(String, &Untestable)> {
    let mut groups: Vec<(String, &Untestable)> = Vec::new();
    for locked in all {
        let number = locked.joint.map(|j| j + 1);
        let same = |g: &&mut (String, &Untestable)| {
            g.1.effect == locked.effect && g.1.because == locked.because
        };
        if let (Some(group), Some(number)) = (groups.iter_mut().find(same), number) {
            let _ = write!(group.0, ", {number}");
        } else {
            let name = named(locked.effect, number);
            groups.push((effect(&name).into_owned(), locked));
        }
    }
    groups
}

fn needs(locked: &Untestable) -> String {
    let says: Vec<_> = locked.needs.iter().map(|n| spoken(n.says())).collect();
    says.join("; ")
}

fn table(plan: &Plan) -> String {
    let mut text = String::new();
    for (k, pose) in plan.poses.iter().enumerate() {
        let _ = writeln!(
            text,
            "{:>4}  {}  {}",
            k + 1,
            pose_in_words(pose, plan),
            spoken(&pose.why)
        );
    }
    text
}

fn pose_in_words(pose: &NextPose, plan: &Plan) -> String {
    let mut words: Vec<String> = Vec::new();
    for (j, joint) in plan.robot.joints.iter().enumerate() {
        let (q, unit) = (joint.kind.outer(pose.q[j]), joint.kind.sign());
        let side = match pose.dir[j] {
            d if d > 0.0 => "↑",
            d if d < 0.0 => "↓",
            _ => " ",
        };
        words.push(format!("{:>9}{side}", format!("{q:.1}{unit}")));
    }
    if let Some(target) = &pose.target {
        words.push(format!("{target:>3}"));
    }
    if let Some(speed) = &pose.speed {
        let moving: Vec<String> = speed
            .iter()
            .zip(&plan.robot.joints)
            .map(|(s, joint)| format!("{:.0}{}/s", joint.kind.outer(*s), joint.kind.sign()))
            .collect();
        words.push(format!("{:>6}", moving.join(" ")));
    }
    if let Some(load) = pose.load_kg {
        words.push(format!("{load:>4} kg"));
    }
    if let Some(temperature) = pose.temperature_c {
        words.push(format!("{temperature:>5.1} °C"));
    }
    words.join(" ")
}
