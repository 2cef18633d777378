//! What a session could not show, and from which size an effect would have been seen, of a robot with
//! several joints: one line a reason, one line an effect, with its joints together.
//!
//! What never applies to such a robot is not said. A limit beyond the sizes that any machine has is no
//! limit: the effect is not observable with these poses.

use crate::diagnosis::{Detectability, Diagnosis, Limit};
use crate::effects::find;
use crate::kinematics::Robot;
use crate::standards::grouping::gathered;
use crate::text::{Text, by_titles, current};

use super::names::parameter;
use super::numbers::significant;
use super::units::Units;

/// A line: whom it is about, and what is said.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    /// Effects with their joints.
    pub(crate) names: String,
    /// Whether it is about joints, not about the whole robot or the instrument.
    pub(crate) of_joints: bool,
    /// In the language of this thread.
    pub(crate) text: String,
}

/// Joints, counted from 0, as they are said: `joint 2`, `joints 1–3, 5`.
pub(crate) fn joints_in_words(joints: &[usize]) -> String {
    let mut sorted = joints.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    let mut parts: Vec<String> = Vec::new();
    for run in sorted.chunk_by(|a, b| b - a == 1) {
        match *run {
            [one] => parts.push((one + 1).to_string()),
            [one, two] => parts.extend([one, two].map(|joint| (joint + 1).to_string())),
            [first, .., last] => parts.push(format!("{}–{}", first + 1, last + 1)),
            [] => {}
        }
    }
    let joints = parts.join(", ");
    if sorted.len() > 1 {
        say!("joints {joints}", joints)
    } else {
        say!("joint {joint}", joint = joints)
    }
}

/// An effect with its joints; of a robot with one joint, or of an effect that belongs to none, the
/// effect alone.
fn with_joints(name: &str, joints: &[Option<usize>], robot: &Robot) -> String {
    let numbers: Vec<usize> = joints.iter().flatten().copied().collect();
    if numbers.is_empty() || robot.joint_count() == 1 {
        return name.to_owned();
    }
    format!("{name}, {}", joints_in_words(&numbers))
}

/// Whether an effect can be of a robot like this at all.
pub(crate) fn applies(robot: &Robot, effect: &str, joint: Option<usize>) -> bool {
    let kinds: Vec<_> = robot.joints.iter().map(|joint| joint.kind).collect();
    let needs = find(effect).map_or(&[][..], |effect| effect.about().needs);
    needs.iter().all(|need| need.suits(&kinds, joint))
}

/// What a limit says: a size that no machine has is one that these poses do not show.
pub fn sight(effect: &str, name: &str, size: f64) -> Detectability {
    let seen = Detectability::of(size);
    let about = find(effect).map(super::super::effects::Effect::about);
    // A size stands for the parameters of its own form: a sliding joint has others, and a ratio of a
    // mode none.
    let limit = about.and_then(|about| {
        let own = about
            .form
            .quantities()
            .iter()
            .any(|quantity| quantity.name == name);
        about.implausible_above.filter(|_| own)
    });
    match (seen, limit) {
        (Detectability::Above(size), Some(limit)) if size > limit => Detectability::AtNoSize,
        _ => seen,
    }
}

/// What is not testable, a line for each reason; `name` is what an effect is called.
pub(crate) fn not_testable(d: &Diagnosis, name: impl Fn(&str) -> String) -> Vec<Line> {
    let robot = &d.model.robot;
    let all = d.not_testable.iter();
    let all = all.filter(|one| applies(robot, one.effect, one.joint));
    let line = |(because, all): (&Text, Vec<(&str, Option<usize>)>)| {
        let effects = gathered(all).into_iter();
        let names = effects.map(|(effect, joints)| with_joints(&name(effect), &joints, robot));
        Line {
            names: names.collect::<Vec<_>>().join("; "),
            of_joints: true,
            text: because.spoken_with(current(), by_titles()),
        }
    };
    let reasons = gathered(all.map(|one| (&one.because, (one.effect, one.joint))));
    reasons.into_iter().map(line).collect()
}

/// The limits of a diagnosis (95 %), a line for each effect; `name` is what an effect is called.
pub(crate) fn limits(d: &Diagnosis, name: impl Fn(&str) -> String) -> Vec<Line> {
    limits_of(&d.model.robot, &d.not_found, name)
}

/// Limits (95 %), a line for each effect; `name` is what an effect is called.
pub(crate) fn limits_of(
    robot: &Robot,
    limits: &[Limit],
    name: impl Fn(&str) -> String,
) -> Vec<Line> {
    let line = |(effect, limits): (&str, Vec<&Limit>)| {
        let joints: Vec<Option<usize>> = limits.iter().map(|limit| limit.joint).collect();
        Line {
            names: with_joints(&name(effect), &joints, robot),
            of_joints: joints.iter().any(Option::is_some),
            text: limits_in_words(effect, &limits),
        }
    };
    let effects = gathered(limits.iter().map(|limit| (limit.effect, limit)));
    effects.into_iter().map(line).collect()
}

/// Parameters of one unit over the joints, and the joints that show one of them at no size.
struct Sizes {
    unit: &'static str,
    names: Vec<String>,
    from: f64,
    to: f64,
}

fn limits_in_words(effect: &str, limits: &[&Limit]) -> String {
    let mut seen: Vec<Sizes> = Vec::new();
    let (mut without_noise, mut hidden) = (false, Vec::new());
    for limit in limits {
        for (name, size) in &limit.sizes {
            let (words, unit) = parameter(name);
            match sight(effect, name, *size) {
                Detectability::AtAnySize => without_noise = true,
                Detectability::AtNoSize => hidden.push((words, limit.joint)),
                Detectability::Above(size) => match seen.iter_mut().find(|s| s.unit == unit) {
                    Some(sizes) => {
                        sizes.from = sizes.from.min(size);
                        sizes.to = sizes.to.max(size);
                        if !sizes.names.contains(&words) {
                            sizes.names.push(words);
                        }
                    }
                    None => seen.push(Sizes {
                        unit,
                        names: vec![words],
                        from: size,
                        to: size,
                    }),
                },
            }
        }
    }
    let mut parts = Vec::new();
    if without_noise {
        parts.push(say!("any size, there is no noise").to_owned());
    }
    if !seen.is_empty() {
        let sizes: Vec<String> = seen.iter().map(Sizes::in_words).collect();
        parts.push(sizes.join(", "));
    }
    if !hidden.is_empty() {
        parts.push(hidden_in_words(
            &hidden,
            limits,
            seen.is_empty() && !without_noise,
        ));
    }
    parts.join("; ")
}

fn hidden_in_words(hidden: &[(String, Option<usize>)], limits: &[&Limit], all: bool) -> String {
    if all {
        return say!("not observable with these poses").to_owned();
    }
    let mut names: Vec<&str> = hidden.iter().map(|(name, _)| name.as_str()).collect();
    names.dedup();
    let joints: Vec<usize> = hidden.iter().filter_map(|(_, joint)| *joint).collect();
    let which = if limits.len() > 1 && !joints.is_empty() {
        joints_in_words(&joints)
    } else {
        names.join(", ")
    };
    say!("not observable with these poses: {which}", which)
}

impl Sizes {
    fn in_words(&self) -> String {
        let name = match &self.names[..] {
            [first, .., last] if self.names.len() > 3 => format!("{first} … {last}"),
            names => names.join(", "),
        };
        let (factor, unit) = Units::spoken().of_unit(self.unit);
        let [from, to] = [self.from, self.to].map(|size| significant(factor * size, 2));
        let sizes = if from == to {
            from
        } else {
            say!("{from} to {to}", from, to)
        };
        format!("{name} {sizes} {unit}")
            .replace(" °", "°")
            .trim_end()
            .to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_are_said_together() {
        for (joints, said) in [
            (&[1][..], "joint 2"),
            (&[0, 1, 2, 3, 4, 5], "joints 1–6"),
            (&[4, 0, 1, 2], "joints 1–3, 5"),
            (&[0, 1, 3, 3], "joints 1, 2, 4"),
        ] {
            assert_eq!(joints_in_words(joints), said);
        }
    }

    #[test]
    fn a_size_that_no_machine_has_is_not_observable() {
        let limit = |effect, size| sight(effect, "width_deg", size);
        assert_eq!(limit("backlash", 0.02), Detectability::Above(0.02));
        assert_eq!(limit("backlash", 167.0), Detectability::AtNoSize);
        assert_eq!(
            sight("backlash", "order", 167.0),
            Detectability::Above(167.0)
        );
    }

    #[test]
    fn limits_of_several_joints_are_one_range() {
        let limit = |joint, size| Limit {
            effect: "backlash",
            joint: Some(joint),
            sizes: vec![("width_deg", size)],
        };
        let all = [limit(0, 0.003), limit(1, 0.0242), limit(2, 40.0)];
        let all: Vec<&Limit> = all.iter().collect();
        let says = limits_in_words("backlash", &all);
        assert_eq!(
            says,
            "width 0.0030 to 0.024°; not observable with these poses: joint 3"
        );
        assert_eq!(
            limits_in_words("backlash", &all[2..]),
            "not observable with these poses"
        );
    }
}
