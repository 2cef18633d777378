//! What only shows when the parts of a session are seen together.
//!
//! Every finding here is about a session that can be read; nearly all of them are notes and
//! warnings, because a strange session is still a session. Set-up errors (a joint's sign,
//! a wrong unit) need a fit and are not looked for here.

use crate::text::Text;
use std::collections::BTreeSet;

use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::{ONCE, quoted};
use crate::kinematics::{JointKind, Robot};
use crate::sessions::domain::{Region, Samples, Session};
use crate::units::deg_from_rad;

/// How many samples are named before the rest is counted.
const NAMED: usize = 8;

/// What is said of a session, in the order of its parts.
struct Said<'a> {
    session: &'a Session,
    file: &'a Place,
    findings: Vec<Diagnostic>,
}

/// Looks at a whole session that was read from `file`.
pub(crate) fn findings(session: &Session, file: &Place) -> Vec<Diagnostic> {
    let findings = Vec::new();
    let mut said = Said {
        session,
        file,
        findings,
    };
    robot(&session.robot, file, &mut said.findings);
    sizes(session, file, &mut said.findings);
    said.regions();
    said.instrument();
    said.targets();
    free_targets(session, file, &mut said.findings);
    said.completeness();
    // How many measurements of which kind there are, where points are not all.
    if let Some(counts) = session.kinds_in_words() {
        said.note("", text!("measured: {counts}", counts));
    }
    said.limits();
    said.conditions();
    if let Some(model) = &session.compensated_by {
        let found = text!(
            "measured with the table of model {model} active: it shows what is left, and nothing \
             compensates it a second time",
            model = quoted(model)
        );
        said.note("compensated_by", found);
    }
    said.findings
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

impl Said<'_> {
    fn place(&self, field: &str) -> Place {
        let file = self.file.clone();
        if field.is_empty() {
            file
        } else {
            file.in_field(field)
        }
    }

    fn note(&mut self, field: &str, found: Text) {
        let note = Diagnostic::note(self.place(field), found);
        self.findings.push(note);
    }

    fn warn(&mut self, field: &str, found: Text, expected: Text) {
        let warning = Diagnostic::warning(self.place(field), found, expected);
        self.findings.push(warning);
    }

    /// Warns of samples, if there are any; `found` is given what names them.
    fn warn_of(&mut self, field: &str, rows: &[usize], found: impl FnOnce(Text) -> Text) {
        if !rows.is_empty() {
            let found = found(which(&self.session.samples, rows));
            let warning = Diagnostic::warning(self.place(field), found, Text::default());
            self.findings.push(warning.about(rows));
        }
    }

    /// As [`Self::warn_of`], where it is only worth knowing.
    fn note_of(&mut self, field: &str, rows: &[usize], found: impl FnOnce(Text) -> Text) {
        if !rows.is_empty() {
            let found = found(which(&self.session.samples, rows));
            let note = Diagnostic::note(self.place(field), found);
            self.findings.push(note.about(rows));
        }
    }

    fn regions(&mut self) {
        let named = |region: &Region| {
            let [from, to] = [region.from_rad, region.to_rad].map(deg_from_rad);
            format!("{} ({from}° to {to}°)", quoted(&region.name))
        };
        let all = &self.session.regions;
        for [earlier, later] in overlaps(all) {
            let (earlier, later) = (named(&all[earlier]), named(&all[later]));
            self.warn(
                "regions",
                text!("regions {earlier} and {later} overlap", earlier, later),
                text!("regions that touch at most; the one listed first owns what both claim"),
            );
        }
        let mut names = BTreeSet::new();
        for region in all.iter().filter(|region| !names.insert(&region.name)) {
            self.warn("regions", twice(&region.name), ONCE.into());
        }
        let joints = &self.session.robot.joints;
        if !all.is_empty() && !matches!(&joints[..], [one] if one.kind == JointKind::Revolute) {
            let found = text!(
                "regions are for a robot with a single revolute joint: they will not be used"
            );
            self.note("regions", found);
        }
    }

    /// Every kind that was measured, and whether its noise is stated.
    fn instrument(&mut self) {
        let session = self.session;
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
            let found =
                text!("the noise of the instrument is not given: it is estimated from the samples");
            self.note(&format!("instrument.{key}"), found);
        }
    }

    fn targets(&mut self) {
        let targets = &self.session.targets;
        let Some(used) = &self.session.samples.target else {
            if targets.len() > 1 {
                let found = text!(
                    "{targets} targets but no column target: every sample is taken to show {target}",
                    targets = targets.len(),
                    target = quoted(&targets[0].name)
                );
                self.warn("targets", found, Text::default());
            }
            return;
        };
        let mut seen = vec![false; targets.len()];
        for &target in used {
            if let Some(seen) = seen.get_mut(target as usize) {
                *seen = true;
            }
        }
        for (target, seen) in targets.iter().zip(seen) {
            if !seen {
                let field = format!("targets.{}", target.name);
                self.note(&field, text!("no sample shows this target"));
            }
        }
    }

    fn completeness(&mut self) {
        let samples = &self.session.samples;
        let all = samples.len();
        let incomplete = samples.incomplete();
        let count = incomplete.len();
        if count == all {
            let found = text!("no sample has its commanded values and anything measured");
            let error = Diagnostic::error(self.file.clone(), found, text!("at least one"));
            self.findings.push(error);
        } else {
            self.warn_of("", &incomplete, |which| {
                text!(
                    one "{count} of {all} samples lacks a commanded value or everything measured and cannot be used: {which}",
                    "{count} of {all} samples lack a commanded value or everything measured and cannot be used: {which}",
                    count, all, which
                )
            });
        }
        let excluded = samples.excluded_by_hand();
        let count = excluded.len();
        self.warn_of("use", &excluded, |which| {
            text!(
                one "{count} of {all} samples is excluded by hand and counts in no figure: {which}",
                "{count} of {all} samples are excluded by hand and count in no figure: {which}",
                count, all, which
            )
        });
        let partly = samples.partly_measured();
        let count = partly.len();
        self.note_of("", &partly, |which| {
            text!(
                one "{count} of {all} samples lacks single coordinates; the others of it are fitted: {which}",
                "{count} of {all} samples lack single coordinates; the others of them are fitted: {which}",
                count, all, which
            )
        });
        if samples.z_mm.is_none() {
            let found = text!("no column for the measured z: the session is planar");
            self.note("", found);
        }
        let held_out = |i: usize| samples.held_out.as_ref().is_some_and(|h| h[i]);
        if (samples.held_out.is_some() || samples.excluded.is_some())
            && (0..all).all(|i| held_out(i) || samples.is_excluded(i))
        {
            let found = text!("every sample is held out or excluded: nothing is left to fit");
            self.warn("use", found, Text::default());
        }
        if let Some([w, x, y, z]) = &samples.orientation_wxyz {
            let norm = |i: usize| (w[i] * w[i] + x[i] * x[i] + y[i] * y[i] + z[i] * z[i]).sqrt();
            // NaN, a missing orientation, is not off.
            let off = rows_where(all, |i| (norm(i) - 1.0).abs() > 0.01);
            self.warn_of("qw, qx, qy, qz", &off, |which| {
                text!(
                    one "{count} measured orientation is not of unit length: {which}",
                    "{count} measured orientations are not of unit length: {which}",
                    count = off.len(),
                    which
                )
            });
        }
    }

    fn limits(&mut self) {
        let Session { robot, samples, .. } = self.session;
        for (number, (joint, q)) in (1..).zip(robot.joints.iter().zip(&samples.q)) {
            let Some(limits) = joint.limits else { continue };
            // A limit of 90° and a command of 90.0° may differ in the last bit.
            let slack = 1e-9 * (limits.to - limits.from);
            let within = limits.from - slack..=limits.to + slack;
            // A command that is missing is not beyond them.
            let beyond = rows_where(q.len(), |i| !q[i].is_nan() && !within.contains(&q[i]));
            self.warn_of("", &beyond, |which| {
                text!(
                    one "{count} sample is beyond the limits of joint {index}: {which}",
                    "{count} samples are beyond the limits of joint {index}: {which}",
                    count = beyond.len(),
                    index = number,
                    which
                )
            });
        }
    }

    fn conditions(&mut self) {
        let samples = &self.session.samples;
        let loads = samples.load_kg.as_deref().unwrap_or_default();
        let celsius = samples.temperature_c.as_deref().unwrap_or_default();
        for (field, wrong, what) in [
            (
                "load_kg",
                rows_where(loads.len(), |i| loads[i] < 0.0),
                phrase!("negative loads"),
            ),
            (
                "temperature_c",
                rows_where(celsius.len(), |i| celsius[i] < -273.15),
                phrase!("temperatures below absolute zero"),
            ),
        ] {
            self.warn_of(field, &wrong, |name| {
                text!("{found}: {name}", found = what, name)
            });
        }
        let mut latest = f64::NEG_INFINITY;
        let time_s = samples.time_s.as_deref().unwrap_or_default();
        let back = rows_where(time_s.len(), |i| {
            let is_back = time_s[i] < latest;
            latest = latest.max(time_s[i]);
            is_back
        });
        self.note_of("time_s", &back, |back| {
            text!(
                "the time does not increase at {back}; file order is taken as measuring order",
                back
            )
        });
        let setups = samples
            .setups
            .as_ref()
            .map_or(0, |setups| setups.names.len());
        if setups > 1 {
            let found = text!(
                "{names} setups: each has a measuring frame of its own",
                names = setups
            );
            self.note("setup", found);
        }
        let lost = samples.lost_reflector();
        self.warn_of("", &lost, |which| {
            text!(
                one "the instrument lost the reflector ({point}) in {count} measurement: {which}",
                "the instrument lost the reflector ({point}) in {count} measurements: {which}",
                point = "0, 0, 0",
                count = lost.len(),
                which
            )
        });
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

fn rows_where(count: usize, mut is_wrong: impl FnMut(usize) -> bool) -> Vec<usize> {
    (0..count).filter(|&row| is_wrong(row)).collect()
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
