//! What only shows when the parts of a session are seen together.
//!
//! Every finding here is about a session that can be read; nearly all of them are notes and
//! warnings, because a strange session is still a session. Set-up errors (a joint's sign,
//! a wrong unit) need a fit and are not looked for here.

use crate::text::{Template, Text};
use std::collections::BTreeSet;

use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::{ONCE, quoted};
use crate::kinematics::{JointKind, Robot};
use crate::sessions::domain::{Region, Samples, Session};
use crate::units::deg_from_rad;

/// How many samples are named before the rest is counted.
const NAMED: usize = 8;

/// Looks at a whole session that was read from `file`.
pub(crate) fn findings(session: &Session, file: &Place) -> Vec<Diagnostic> {
    let mut findings = Vec::new();
    robot(&session.robot, file, &mut findings);
    sizes(session, file, &mut findings);
    regions(session, file, &mut findings);
    instrument(session, file, &mut findings);
    targets(session, file, &mut findings);
    free_targets(session, file, &mut findings);
    completeness(&session.samples, file, &mut findings);
    kinds(session, file, &mut findings);
    limits(session, file, &mut findings);
    conditions(&session.samples, file, &mut findings);
    if let Some(model) = &session.compensated_by {
        let found = text!(
            "measured with the table of model {model} active: it shows what is left, and nothing \
             compensates it a second time",
            model = quoted(model)
        );
        let place = file.clone().in_field("compensated_by");
        findings.push(Diagnostic::note(place, found));
    }
    findings
}

/// Looks at a robot alone.
pub fn robot(robot: &Robot, file: &Place, findings: &mut Vec<Diagnostic>) {
    findings.extend(robot.out_of_range(file));
    for (index, joint) in robot.joints.iter().enumerate() {
        let mut earlier = robot.joints[..index].iter();
        if earlier.any(|other| other.name == joint.name) {
            let place = file.clone().in_field(format!("robot.joints[{index}].name"));
            let found = twice(&joint.name);
            findings.push(Diagnostic::warning(place, found, ONCE));
        }
    }
}

fn twice(name: &str) -> Text {
    text!("{name} a second time", name = quoted(name))
}

/// What a fit has parameters for is counted: its equations grow with the square of their number.
pub(super) fn sizes(session: &Session, file: &Place, findings: &mut Vec<Diagnostic>) {
    let references = &session.instrument.references;
    let setups = session.samples.setups.as_ref();
    let setups = setups.map_or(0, |setups| setups.names.len());
    // An arm's targets are parameters of its fit.
    let one_joint = session.robot.joints.len() <= 1;
    for (field, count, most) in [
        ("setup", setups, 300),
        (
            "targets",
            session.targets.len(),
            if one_joint { 1_000_000 } else { 600 },
        ),
        ("anchors", references.anchors.len(), 600),
        ("stations", references.stations.len(), 300),
        ("planes", references.planes.len(), 600),
        ("sockets", references.sockets.len(), 600),
    ] {
        if count > most {
            findings.push(Diagnostic::error(
                file.clone().in_field(field),
                Text::verbatim(count.to_string()),
                text!("at most {most} in one session", most),
            ));
        }
    }
}

/// Regions that overlap with one that begins before them, each once: never more findings than regions,
/// however many a file lists.
fn overlaps(regions: &[Region]) -> Vec<[usize; 2]> {
    let mut by_start: Vec<usize> = (0..regions.len()).collect();
    by_start.sort_by(|&a, &b| regions[a].from_rad.total_cmp(&regions[b].from_rad));
    let mut pairs = Vec::new();
    // The one that reaches farthest so far.
    let mut farthest: Option<usize> = None;
    for index in by_start {
        if let Some(other) = farthest.filter(|&k| regions[index].from_rad < regions[k].to_rad) {
            pairs.push([index.min(other), index.max(other)]);
        }
        if farthest.is_none_or(|other| regions[index].to_rad > regions[other].to_rad) {
            farthest = Some(index);
        }
    }
    pairs.sort_by_key(|&[earlier, later]| (later, earlier));
    pairs
}

fn regions(session: &Session, file: &Place, findings: &mut Vec<Diagnostic>) {
    let place = || file.clone().in_field("regions");
    let named = |region: &Region| {
        format!(
            "{} ({}° to {}°)",
            quoted(&region.name),
            deg_from_rad(region.from_rad),
            deg_from_rad(region.to_rad)
        )
    };
    let all = &session.regions;
    for [earlier, later] in overlaps(all) {
        let (earlier, later) = (named(&all[earlier]), named(&all[later]));
        findings.push(Diagnostic::warning(
            place(),
            text!("regions {earlier} and {later} overlap", earlier, later),
            text!("regions that touch at most; the one listed first owns what both claim"),
        ));
    }
    let mut names = BTreeSet::new();
    for region in all.iter().filter(|region| !names.insert(&region.name)) {
        findings.push(Diagnostic::warning(place(), twice(&region.name), ONCE));
    }
    let joints = &session.robot.joints;
    let one_revolute = joints.len() == 1 && joints[0].kind == JointKind::Revolute;
    if !session.regions.is_empty() && !one_revolute {
        let found =
            text!("regions are for a robot with a single revolute joint: they will not be used");
        findings.push(Diagnostic::note(place(), found));
    }
}

/// Every kind that was measured, and whether its noise is stated.
fn instrument(session: &Session, file: &Place, findings: &mut Vec<Diagnostic>) {
    let mut silent: Vec<&str> = if session.has_plain_points() {
        // A million of them are not asked what else they might be.
        let stated = session.instrument.sigma_mm.is_some();
        if stated { Vec::new() } else { vec!["sigma_mm"] }
    } else {
        let kinds = session.measured_kinds().into_iter();
        let silent = kinds.filter(|kind| !kind.stated).map(|kind| kind.sigma_key);
        silent.collect()
    };
    silent.dedup();
    for key in silent {
        let place = file.clone().in_field(format!("instrument.{key}"));
        let found =
            text!("the noise of the instrument is not given: it is estimated from the samples");
        findings.push(Diagnostic::note(place, found));
    }
}

/// How many measurements of which kind there are, where points are not all.
fn kinds(session: &Session, file: &Place, findings: &mut Vec<Diagnostic>) {
    if let Some(counts) = session.kinds_in_words() {
        findings.push(Diagnostic::note(
            file.clone(),
            text!("measured: {counts}", counts),
        ));
    }
}

fn targets(session: &Session, file: &Place, findings: &mut Vec<Diagnostic>) {
    let Some(used) = &session.samples.target else {
        if session.targets.len() > 1 {
            let place = file.clone().in_field("targets");
            let found = text!(
                "{targets} targets but no column target: every sample is taken to show {target}",
                targets = session.targets.len(),
                target = quoted(&session.targets[0].name)
            );
            findings.push(Diagnostic::warning(place, found, Text::default()));
        }
        return;
    };
    let mut seen = vec![false; session.targets.len()];
    for &target in used {
        if let Some(seen) = seen.get_mut(target as usize) {
            *seen = true;
        }
    }
    for (target, _) in session
        .targets
        .iter()
        .zip(&seen)
        .filter(|(_, seen)| !**seen)
    {
        let place = file.clone().in_field(format!("targets.{}", target.name));
        findings.push(Diagnostic::note(
            place,
            text!("no sample shows this target"),
        ));
    }
}

/// Targets of unknown place that there are not: the one that was meant would be taken for known.
pub(super) fn free_targets(session: &Session, file: &Place, findings: &mut Vec<Diagnostic>) {
    let is_known = |name: &String| session.targets.iter().any(|own| own.name == *name);
    let free = session.instrument.free_targets.iter();
    for name in free.filter(|name| !is_known(name)) {
        let place = file.clone().in_field("instrument.free_targets");
        let found = text!("{name} is not declared", name = quoted(name));
        let names = session.targets.iter().map(|own| quoted(&own.name));
        let expected = Text::verbatim(names.collect::<Vec<_>>().join(", "));
        findings.push(Diagnostic::error(place, found, expected));
    }
}

fn completeness(samples: &Samples, file: &Place, findings: &mut Vec<Diagnostic>) {
    let count = samples.len();
    let incomplete = samples.incomplete();
    if incomplete.len() == count {
        let found = text!("no sample has its commanded values and anything measured");
        findings.push(Diagnostic::error(
            file.clone(),
            found,
            text!("at least one"),
        ));
    } else if !incomplete.is_empty() {
        let found = text!(
                one "{count} of {all} samples lacks a commanded value or everything measured and cannot be used: {which}",
                "{count} of {all} samples lack a commanded value or everything measured and cannot be used: {which}",
                count = incomplete.len(),
                all = count,
            which = which(samples, &incomplete)
        );
        findings.push(Diagnostic::warning(file.clone(), found, Text::default()).about(&incomplete));
    }
    let excluded = samples.excluded_by_hand();
    if !excluded.is_empty() {
        let found = text!(
            one "{count} of {all} samples is excluded by hand and counts in no figure: {which}", "{count} of {all} samples are excluded by hand and count in no figure: {which}",
            count = excluded.len(),
            all = count,
            which = which(samples, &excluded)
        );
        findings.push(
            Diagnostic::warning(file.clone().in_field("use"), found, Text::default())
                .about(&excluded),
        );
    }
    let partly = samples.partly_measured();
    if !partly.is_empty() {
        let found = text!(
            one "{count} of {all} samples lacks single coordinates; the others of it are fitted: {which}", "{count} of {all} samples lack single coordinates; the others of them are fitted: {which}",
            count = partly.len(),
            all = count,
            which = which(samples, &partly)
        );
        findings.push(Diagnostic::note(file.clone(), found).about(&partly));
    }
    if samples.z_mm.is_none() {
        let found = text!("no column for the measured z: the session is planar");
        findings.push(Diagnostic::note(file.clone(), found));
    }
    let held_out = |i: usize| samples.held_out.as_ref().is_some_and(|h| h[i]);
    if (samples.held_out.is_some() || samples.excluded.is_some())
        && (0..count).all(|i| held_out(i) || samples.is_excluded(i))
    {
        let found = text!("every sample is held out or excluded: nothing is left to fit");
        findings.push(Diagnostic::warning(
            file.clone().in_field("use"),
            found,
            Text::default(),
        ));
    }
    if let Some([w, x, y, z]) = &samples.orientation_wxyz {
        let norm = |i: usize| (w[i] * w[i] + x[i] * x[i] + y[i] * y[i] + z[i] * z[i]).sqrt();
        // NaN, a missing orientation, is not off.
        let off: Vec<usize> = (0..count)
            .filter(|&i| (norm(i) - 1.0).abs() > 0.01)
            .collect();
        if !off.is_empty() {
            let found = text!(
                one "{count} measured orientation is not of unit length: {which}", "{count} measured orientations are not of unit length: {which}",
                count = off.len(),
                which = which(samples, &off)
            );
            let place = file.clone().in_field("qw, qx, qy, qz");
            findings.push(Diagnostic::warning(place, found, Text::default()).about(&off));
        }
    }
}

fn limits(session: &Session, file: &Place, findings: &mut Vec<Diagnostic>) {
    for (index, (joint, q)) in session
        .robot
        .joints
        .iter()
        .zip(&session.samples.q)
        .enumerate()
    {
        let Some(limits) = joint.limits else { continue };
        // A limit of 90° and a command of 90.0° may differ in the last bit.
        let slack = 1e-9 * (limits.to - limits.from);
        let beyond: Vec<usize> = (0..q.len())
            .filter(|&i| q[i] < limits.from - slack || q[i] > limits.to + slack)
            .collect();
        if !beyond.is_empty() {
            let found = text!(
                one "{count} sample is beyond the limits of joint {index}: {which}",
                "{count} samples are beyond the limits of joint {index}: {which}",
                count = beyond.len(),
                index = index + 1,
                which = which(&session.samples, &beyond)
            );
            findings.push(Diagnostic::warning(file.clone(), found, Text::default()).about(&beyond));
        }
    }
}

fn conditions(samples: &Samples, file: &Place, findings: &mut Vec<Diagnostic>) {
    let mut warn = |field: &str, wrong: Vec<usize>, what: Template| {
        if !wrong.is_empty() {
            let found = text!(
                "{found}: {name}",
                found = what,
                name = which(samples, &wrong)
            );
            let place = file.clone().in_field(field);
            findings.push(Diagnostic::warning(place, found, Text::default()).about(&wrong));
        }
    };
    let negative_load = rows_where(samples.load_kg.as_deref(), |kg| kg < 0.0);
    warn("load_kg", negative_load, phrase!("negative loads"));
    let too_cold = rows_where(samples.temperature_c.as_deref(), |celsius| {
        celsius < -273.15
    });
    warn(
        "temperature_c",
        too_cold,
        phrase!("temperatures below absolute zero"),
    );
    if let Some(time_s) = &samples.time_s {
        let back = backwards(time_s);
        if !back.is_empty() {
            let found = text!(
                "the time does not increase at {back}; file order is taken as measuring order",
                back = which(samples, &back)
            );
            let place = file.clone().in_field("time_s");
            findings.push(Diagnostic::note(place, found).about(&back));
        }
    }
    if let Some(setups) = &samples.setups
        && setups.names.len() > 1
    {
        let found = text!(
            "{names} setups: each has a measuring frame of its own",
            names = setups.names.len()
        );
        findings.push(Diagnostic::note(file.clone().in_field("setup"), found));
    }
    let lost = samples.lost_reflector();
    if !lost.is_empty() {
        let found = text!(
            one "the instrument lost the reflector ({point}) in {count} measurement: {which}",
            "the instrument lost the reflector ({point}) in {count} measurements: {which}",
            point = "0, 0, 0",
            count = lost.len(),
            which = which(samples, &lost)
        );
        let warning = Diagnostic::warning(file.clone(), found, Text::default());
        findings.push(warning.about(&lost));
    }
}

fn rows_where(column: Option<&[f64]>, is_wrong: impl Fn(f64) -> bool) -> Vec<usize> {
    let values = column.unwrap_or_default().iter().enumerate();
    let wrong = values.filter(|(_, value)| is_wrong(**value));
    wrong.map(|(row, _)| row).collect()
}

/// Samples whose time is before that of an earlier one.
fn backwards(time_s: &[f64]) -> Vec<usize> {
    let mut latest = f64::NEG_INFINITY;
    let mut back = Vec::new();
    for (index, &time) in time_s.iter().enumerate() {
        if time < latest {
            back.push(index);
        } else if !time.is_nan() {
            latest = time;
        }
    }
    back
}

/// Names samples by their lines, or by their numbers where they have none.
fn which(samples: &Samples, rows: &[usize]) -> Text {
    let number = |&row: &usize| samples.line.get(row).unwrap_or(row as u64 + 1).to_string();
    let named: Vec<String> = rows.iter().take(NAMED).map(number).collect();
    let list = named.join(", ");
    let list = match rows.len().saturating_sub(NAMED) {
        0 => Text::verbatim(list),
        more => text!("{first} and {more} more", first = list, more),
    };
    match (samples.line.is_empty(), rows.len()) {
        (true, 1) => text!("sample {sample}", sample = list),
        (true, _) => text!("samples {samples}", samples = list),
        (false, 1) => text!("line {line}", line = list),
        (false, _) => text!("lines {list}", list),
    }
}

#[cfg(test)]
mod tests {
    use crate::sessions::parse_with_csv;

    fn describe(extra: &str, csv: &str) -> Vec<String> {
        let document = format!(
            r#"{{"format":"truepose-session/1","name":"s","robot":{{"name":"r","joints":[{{"name":"pan",
            "kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-90,90]}}],
            "tool":{{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}}}},
            "instrument":{{"name":"tracker","sigma_mm":0.03}},{extra}"samples":{{"file":"s.csv"}}}}"#
        );
        let loaded = parse_with_csv(document.as_bytes(), csv.as_bytes()).unwrap();
        loaded.findings.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_sound_session_has_nothing_to_say() {
        assert_eq!(
            describe("", "q1_deg,x_mm,y_mm,z_mm\n-90,0,-250,300\n90,0,250,300\n"),
            [""; 0]
        );
    }

    #[test]
    fn regions_that_overlap_are_named() {
        let regions = r#""regions":[{"name":"a","from_deg":0,"to_deg":30},{"name":"b","from_deg":20,"to_deg":50},
            {"name":"c","from_deg":50,"to_deg":60}],"#;
        let findings = describe(regions, "q1_deg,x_mm,y_mm,z_mm\n1,2,3,4\n");
        assert_eq!(findings.len(), 1, "{findings:?}");
        assert!(
            findings[0].contains("regions 'a'") && findings[0].contains("'b'"),
            "{findings:?}"
        );
    }

    #[test]
    fn samples_that_cannot_be_used_are_reported_once_with_their_lines() {
        let findings = describe(
            "",
            "q1_deg,x_mm,y_mm,z_mm\n1,,3,4\n2,2,3,4\n3,2,,4\n,2,3,4\n",
        );
        assert_eq!(findings.len(), 3, "{findings:?}");
        assert!(
            findings[0].contains("1 of 4 samples lacks a commanded value")
                && findings[0].contains("line 5"),
            "{findings:?}"
        );
        assert!(
            findings[1].contains("2 of 4 samples lack single coordinates")
                && findings[1].contains("lines 2, 4"),
            "{findings:?}"
        );
        assert!(findings[2].contains("measured: 4 points"), "{findings:?}");
    }

    #[test]
    fn strange_conditions_are_said() {
        let csv = "q1_deg,x_mm,y_mm,z_mm,time_s,load_kg,temperature_c,use,setup\n\
                   100,0,0,0,5,-1,-300,held-out,a\n2,2,3,4,3,0,20,held-out,b\n";
        let findings = describe("", csv).join("\n");
        for part in [
            "beyond the limits of joint 1: line 2",
            "negative loads: line 2",
            "below absolute zero: line 2",
            "does not increase at line 3",
            "every sample is held out",
            "2 setups",
            "lost the reflector (0, 0, 0) in 1 measurement: line 2",
        ] {
            assert!(findings.contains(part), "{part}: {findings}");
        }
    }
}
