//! What is said about a sample: all of it, or what matters most.

use crate::gui::core::loaded_session::Component;
use crate::gui::view::Colouring;
use crate::gui::workbench::Workbench;
use crate::present::numbers::trimmed;

/// One line of what is said about a sample: what, and how much.
pub(crate) type Line = (String, String);

/// What matters most of a sample.
pub(crate) fn brief(workbench: &Workbench, sample: usize) -> (String, Vec<Line>) {
    const MOST: usize = 3;
    let loaded_session = &**workbench.loaded_session();
    let (title, all) = about(workbench, sample);
    let joints = loaded_session.session.robot.joints.len();
    let mut lines: Vec<Line> = Vec::new();
    if joints > MOST {
        let values = all.iter().take(joints).map(|(_, value)| value.as_str());
        let mut values: Vec<&str> = values.take(6).collect();
        if joints > values.len() {
            values.push("…");
        }
        lines.push((say!("joints").to_owned(), values.join(", ")));
    } else {
        lines.extend(all.iter().take(joints).cloned());
    }
    let colour = workbench.view().colouring;
    let component = workbench.view().component;
    let matters = |name: &str| {
        [
            say!("excluded"),
            say!("deviation"),
            say!("before"),
            say!("after"),
            say!("tolerance"),
        ]
        .contains(&name)
            || name == colour.name()
            || name == component.name()
    };
    let rest = all.into_iter().skip(joints);
    lines.extend(rest.filter(|(name, _)| matters(name)));
    // Before and after are one line where both are there.
    if let Some(k) = lines.iter().position(|(name, _)| name == say!("before"))
        && lines
            .get(k + 1)
            .is_some_and(|(name, _)| name == say!("after"))
    {
        let after = lines.remove(k + 1).1;
        let before = lines[k].1.trim_end_matches(char::is_alphabetic).trim_end();
        lines[k] = (
            say!("before → after").to_owned(),
            format!("{before} → {after}"),
        );
    }
    (title, lines)
}

/// What is said about a sample.
pub(crate) fn about(workbench: &Workbench, sample: usize) -> (String, Vec<Line>) {
    let loaded_session = &**workbench.loaded_session();
    let units = workbench.units();
    let title = say!("sample {sample}", sample = sample + 1);
    let mut lines = Vec::new();
    let joints = &loaded_session.session.robot.joints;
    for (joint, q) in joints.iter().zip(&loaded_session.session.samples.q) {
        let value = match joint.kind {
            crate::kinematics::JointKind::Revolute => units.angle(q[sample]),
            crate::kinematics::JointKind::Prismatic => units.length(q[sample]),
        };
        lines.push((joint.name.clone(), value));
    }
    let came = match loaded_session.side(sample) {
        s if s > 0.0 => say!("approach +"),
        s if s < 0.0 => say!("approach −"),
        _ => say!("not known"),
    };
    lines.push((say!("approached").to_owned(), came.to_owned()));
    if !loaded_session.usable[sample] {
        lines.push((
            say!("excluded").to_owned(),
            say!("a value is missing").to_owned(),
        ));
        return (title, lines);
    }
    let before = loaded_session.deviation_before(sample);
    let length = |e: [f64; 3]| units.length(loaded_session.component(e, sample, Component::Length));
    let mut shown = before;
    match workbench.answer() {
        None => lines.push((say!("deviation").to_owned(), length(before))),
        Some(answer) => {
            shown = answer.deviation_after(sample);
            lines.push((say!("before").to_owned(), length(before)));
            lines.push((say!("after").to_owned(), length(shown)));
        }
    }
    if let Some(u) = workbench.uncertain().map(|u| u.mm[sample]) {
        lines.push((Colouring::Uncertainty.name().to_owned(), units.length(u)));
    }
    for component in [Component::Tangential, Component::Radial, Component::Axial] {
        if component.out_of_plane() && loaded_session.session.samples.z_mm.is_none() {
            continue;
        }
        let value = loaded_session.component(shown, sample, component);
        lines.push((component.name().to_owned(), units.length(value)));
    }
    let samples = &loaded_session.session.samples;
    let conditions = [
        (say!("load"), &samples.load_kg, "kg"),
        (say!("temperature"), &samples.temperature_c, "°C"),
        (say!("time"), &samples.time_s, "s"),
    ];
    for (name, column, unit) in conditions {
        if let Some(value) = column.as_ref().map(|c| c[sample]).filter(|v| v.is_finite()) {
            lines.push((name.to_owned(), format!("{} {unit}", trimmed(value, 2))));
        }
    }
    let [right, up] = workbench.facing().flat(shown);
    let direction = up.atan2(right).to_degrees();
    lines.push((
        say!("direction").to_owned(),
        format!("{}°", trimmed(direction, 0)),
    ));
    if let Some(tolerance_mm) = workbench.document().tolerance_mm {
        let within = loaded_session.component(shown, sample, Component::Length) <= tolerance_mm;
        let says = if within {
            say!("within")
        } else {
            say!("outside")
        };
        lines.push((say!("tolerance").to_owned(), says.to_owned()));
    }
    (title, lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;

    #[test]
    fn the_hover_names_the_sample_its_angle_and_its_deviation() {
        let workbench = workbench();
        let (title, lines) = about(&workbench, 0);
        assert_eq!(title, "sample 1");
        let says = |what: &str| lines.iter().any(|(name, _)| name == what);
        assert!(says("pan") && says("deviation") && says("direction") && says("tolerance"));
    }
}
