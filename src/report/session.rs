//! The report of a session: everything that its diagnosis, verification and standards say.

use crate::compensation::decision::{Fitted, Measured, Outcome, Rule};
use crate::compensation::verification::VerifyError;
use crate::compensation::{Remainder, Verification, VerifiedCalibration};
use crate::diagnosis::{Diagnosis, FloorFrom, Verdict};
use crate::effects::{Inputs, JointValues};
use crate::export::Job;
use crate::export::sidecar::measured_poses;
use crate::fit::measured_ranges;
use crate::kinematics::Robot;
use crate::model::Calibration;
use crate::model::format_v1::model_hash;
use crate::numeric::extent;
use crate::present::decision::rests_on;
use crate::present::kinds;
use crate::present::names::{figure, title, title_on};
use crate::sessions::{Session, hash_of_samples};
use crate::standards::Standards;

use super::accuracy;
use super::calibration::values;
use super::document::{Block, Figure, Report, Section, Table, clean, clean_note};
use super::parts::{
    details, fact, foot, gap, implausible, instrument, or_unnamed, parameters, robot_facts,
    signatures, tables, tolerance,
};
use super::plots::gap as gap_plot;
use super::stages::{section as deviations_of, stages};
use super::{Extras, ReportError, history};
use crate::present::numbers::{mm, plain, short};

/// Rows of lists that have no end of their own.
pub(super) const MOST_ROWS: usize = 20;

/// What a report of a session is made from.
#[derive(Debug)]
pub struct Evidence<'a> {
    /// The session that was diagnosed: without the set-up errors that were corrected.
    pub session: &'a Session,
    /// The session as it was read.
    pub given: &'a Session,
    /// What the diagnosis found.
    pub found: &'a Diagnosis,
    /// The model of everything that was found.
    pub all_found: &'a VerifiedCalibration,
    /// The model in use, from which tables are made; `None`: that one.
    pub in_use: Option<&'a VerifiedCalibration>,
    /// The model in use held against the session.
    pub verification: Verification,
    /// The figures of the standards with it, or why there are none.
    pub standards: Result<Standards, VerifyError>,
}

impl Report {
    /// The report of a session.
    ///
    /// # Errors
    /// If the model is another robot's.
    pub fn of_session(evidence: &Evidence, extras: &Extras) -> Result<Self, ReportError> {
        let Evidence {
            session,
            given,
            found,
            all_found,
            in_use,
            ..
        } = *evidence;
        let calibration = in_use.unwrap_or(all_found);
        let verification = &evidence.verification;
        let hash = hash_of_samples(given);
        let told = Told {
            session,
            given,
            found,
            calibration,
            other: difference(calibration, all_found),
            verification,
            model_hash: model_hash(calibration),
        };
        let mut sections: Vec<Section> = details(&extras.details).into_iter().collect();
        sections.extend([told.measured(&hash), told.result(), told.parameters()]);
        sections.extend(told.effects());
        sections.push(told.open());
        let stages = stages(session, calibration, verification, Some(found.floor.mm))?;
        sections.push(deviations_of(&stages));
        sections.push(match &evidence.standards {
            Ok(figures) => accuracy::section(figures),
            Err(error) => return Err(error.clone().into()),
        });
        let history = extras.history.as_ref();
        sections.extend(history.and_then(|h| history::section(h, &given.robot.name)));
        sections.push(told.limits());
        sections.extend(tables(extras, &hash, &told.model_hash));
        sections.push(signatures(extras));
        let subject = or_unnamed(&given.name);
        Ok(Self {
            title: "Calibration report".to_owned(),
            answer: told.answer(),
            logo: extras.details.logo.clone(),
            decision: extras.details.rule.map(|rule| told.decision(rule)),
            headline: told.headline(),
            foot: foot(&subject, &hash),
            subject,
            sections,
        })
    }
}

/// In what a model is not the one that was found; `None` where it is that one.
fn difference(model: &Calibration, found: &Calibration) -> Option<String> {
    if model.model == found.model && model.regions == found.regions {
        return None;
    }
    if !model.regions.is_empty() {
        return Some("corrections by region".to_owned());
    }
    let ids = |c: &Calibration| -> Vec<&'static str> {
        c.model
            .terms()
            .iter()
            .map(|t| t.effect.about().id)
            .collect()
    };
    let (has, had) = (ids(model), ids(found));
    let lacks = |these: &[&'static str], all: &[&'static str], word: &str| {
        let names = all.iter().filter(|id| !these.contains(id));
        let names: Vec<&str> = names.map(|id| title(id)).collect();
        (!names.is_empty()).then(|| format!("{word} {}", names.join(", ")))
    };
    let parts = [lacks(&has, &had, "without"), lacks(&had, &has, "with")];
    let said: Vec<String> = parts.into_iter().flatten().collect();
    Some(if said.is_empty() {
        "the same effects with other values".to_owned()
    } else {
        said.join(", ")
    })
}

/// Everything that is there to be told.
pub(super) struct Told<'a> {
    pub(super) session: &'a Session,
    pub(super) given: &'a Session,
    pub(super) found: &'a Diagnosis,
    calibration: &'a VerifiedCalibration,
    /// In what that model is not the one that was found.
    other: Option<String>,
    verification: &'a Verification,
    model_hash: String,
}

impl Told<'_> {
    pub(super) fn robot(&self) -> &Robot {
        &self.session.robot
    }

    fn answer(&self) -> String {
        let d = self.found;
        let found = match d.verdict {
            Verdict::Noise => "Nothing is missing in the model: the remaining error is noise",
            Verdict::Explained => "Explained: the remaining error is at the noise floor",
            Verdict::PartlyExplained => {
                "Partly explained: an error is left that no effect of the catalogue explains"
            }
            Verdict::Unexplained => {
                "Not explained: an error is left that no effect of the catalogue explains"
            }
        };
        let mut answer = found.to_owned();
        if !d.tested_anything() {
            answer += "; but the samples can show no effect, so that says nothing about the robot";
        }
        if !d.equivalent.is_empty() {
            answer += "; the samples cannot decide between some names";
        }
        if !d.data_problems.is_empty() {
            answer += "; the data had problems, which are named below";
        }
        if !d.identification.quality.converged {
            answer += "; the fit did not converge";
        }
        if let Some(other) = &self.other {
            answer += &format!("; the model in use is another one: {other}");
        }
        answer
    }

    /// Whether the robot is within its tolerance, and what that rests on.
    fn decision(&self, rule: Rule) -> (Outcome, String) {
        let d = self.found;
        let fitted = Fitted {
            fit_mm: d.gap.end_mm,
            held_out_mm: d.held_out.gaps.map(|g| g.end_mm),
            floor_mm: Some(d.floor.mm),
        };
        let none = |because: &str| (Outcome::Undecided, format!("No decision: {because}"));
        let Some(tolerance) = self.session.tolerance_mm else {
            return none("no tolerance is stated");
        };
        match Measured::of(self.session, self.verification, fitted) {
            Err(because) => none(because),
            Ok(measured) => (
                measured.decided(rule, tolerance),
                rests_on(&measured, rule, tolerance),
            ),
        }
    }

    fn headline(&self) -> Vec<Figure> {
        let (d, v) = (self.found, self.verification);
        let figure = |name: &str, value: String, beside: String| Figure {
            name: name.to_owned(),
            value,
            beside,
        };
        let unseen = d.held_out.gaps.map_or_else(
            || "too few samples to hold any out".to_owned(),
            |g| format!("{} cross-validated", mm(g.end_mm)),
        );
        let mut figures = vec![
            figure(
                "RMS error, nominal robot",
                mm(d.gap.start_mm),
                format!("largest {}", mm(v.nominal.max_mm)),
            ),
            if self.other.is_some() {
                let all = format!("{} with everything that was found", mm(d.gap.end_mm));
                figure("RMS error, model in use", mm(v.model.rms_mm), all)
            } else {
                figure("RMS error, model", mm(d.gap.end_mm), unseen)
            },
            figure("Noise floor", mm(d.floor.mm), self.floor_from().to_owned()),
        ];
        figures.push(match (&v.within_tolerance, self.session.tolerance_mm) {
            (Some(within), Some(tolerance)) => figure(
                &format!("Within {} mm", short(tolerance)),
                format!("{} of {}", within.after, within.of),
                format!("with the model; {} as measured", within.before),
            ),
            _ => figure(
                "Corrected commands",
                v.compensated
                    .map_or_else(|| "–".to_owned(), |c| mm(c.gap.rms_mm)),
                "RMS error left by the table".to_owned(),
            ),
        });
        figures
    }

    fn floor_from(&self) -> &'static str {
        match self.found.floor.from {
            FloorFrom::Repeats => "from returns to the same pose",
            FloorFrom::Instrument => "from the instrument's noise",
            FloorFrom::Estimated => "estimated from what is left",
        }
    }

    fn measured(&self, hash: &str) -> Section {
        let s = self.given;
        let mut facts = vec![fact("Session", or_unnamed(&s.name))];
        if !s.note.trim().is_empty() {
            facts.push(fact("Note", clean_note(&s.note)));
        }
        let inputs = Inputs::new(s, JointValues::Commanded);
        facts.extend(robot_facts(self.robot(), &measured_ranges(&inputs)));
        facts.push(fact("Instrument", instrument(&s.instrument)));
        let targets: Vec<String> = s
            .targets
            .iter()
            .take(MOST_ROWS)
            .map(|t| {
                let p = t.position_mm;
                format!(
                    "{} at ({}, {}, {}) mm",
                    clean(&t.name),
                    short(p.x),
                    short(p.y),
                    short(p.z)
                )
            })
            .collect();
        facts.push(fact("Reflectors in the tool", targets.join("; ")));
        facts.push(fact("Samples", self.samples()));
        if let Some(measured) = s.kinds_in_words() {
            facts.push(fact("Measured", measured));
        }
        facts.push(fact("Conditions", self.conditions()));
        facts.push(tolerance(s.tolerance_mm));
        if let Some(by) = &s.compensated_by {
            facts.push(fact(
                "Measured with a table active",
                format!("of model {}", clean(by)),
            ));
        }
        facts.push(fact(
            "Method",
            "robust nonlinear least squares over the effects of the catalogue, found by a forward \
             search with family-wise significance; intervals allow for the search",
        ));
        facts.push(fact(
            "Program",
            format!("truepose {}", env!("CARGO_PKG_VERSION")),
        ));
        facts.push(fact("Hash of robot and samples", hash));
        facts.push(fact("Hash of the model", self.model_hash.clone()));
        Section::new("What was measured", vec![Block::Facts(facts)])
    }

    fn samples(&self) -> String {
        let all = self.session.samples.len();
        let used = self.verification.samples;
        let mut text = format!("{all}");
        if used < all {
            text += &format!(", of which {} cannot be used", all - used);
        }
        if let Some(held) = &self.session.samples.held_out {
            let held = held.iter().filter(|h| **h).count();
            text += &format!(", {held} held out by the file");
        }
        let z = self.session.samples.z_mm.is_some();
        if !self.session.samples.observed.is_empty() {
            return text;
        }
        text += if z { "; x, y, z" } else { "; x, y only" };
        text
    }

    fn conditions(&self) -> String {
        let samples = &self.session.samples;
        let range = |column: &[f64], unit: &str| {
            let [low, high] = extent(column.iter());
            if low > high {
                "not known".to_owned()
            } else if low == high {
                format!("{} {unit}", short(low))
            } else {
                format!("{} to {} {unit}", short(low), short(high))
            }
        };
        let column = |name: &str, column: Option<&Vec<f64>>, unit: &str| {
            let value = column.map_or_else(|| "not recorded".to_owned(), |c| range(c, unit));
            format!("{name} {value}")
        };
        [
            column("load", samples.load_kg.as_ref(), "kg"),
            column("temperature", samples.temperature_c.as_ref(), "°C"),
            column("time", samples.time_s.as_ref(), "s"),
        ]
        .join("; ")
    }

    fn result(&self) -> Section {
        let (d, v) = (self.found, self.verification);
        let mut table =
            Table::headed("RMS error, mm | >Fit | >Cross-validated | >Largest | >Over the floor");
        let times = |mm: f64| {
            if d.floor.mm > 1e-9 {
                format!("× {}", short((mm / d.floor.mm * 10.0).round() / 10.0))
            } else {
                "–".to_owned()
            }
        };
        let held = d.held_out.gaps;
        let mut row = |name: &str, fit: f64, unseen: Option<f64>, largest: Option<f64>| {
            table.row([
                name.to_owned(),
                plain(fit),
                gap(unseen),
                gap(largest),
                times(fit),
            ]);
        };
        row(
            "nominal robot, as measured",
            d.gap.start_mm,
            held.map(|g| g.start_mm),
            Some(v.nominal.max_mm),
        );
        row(
            &d.history
                .get(1)
                .map_or(String::new(), |step| format!("with {}", clean(&step.what))),
            d.gap.identified_mm,
            held.map(|g| g.identified_mm),
            None,
        );
        row(
            "with everything that was found",
            d.gap.end_mm,
            held.map(|g| g.end_mm),
            Some(v.model.max_mm).filter(|_| self.other.is_none()),
        );
        if let Some(other) = &self.other {
            let (rms, max) = (v.model.rms_mm, v.model.max_mm);
            row(
                &format!("with the model in use, {other}"),
                rms,
                None,
                Some(max),
            );
        }
        if let Some(c) = v.compensated {
            row(
                "with corrected commands only",
                c.gap.rms_mm,
                None,
                Some(c.gap.max_mm),
            );
        }
        let mut blocks = vec![
            Block::Text(format!(
                "{}. Noise alone leaves the floor",
                self.what_the_gap_is()
            )),
            Block::Table(table),
        ];
        blocks.extend(self.by_kind());
        blocks.push(Block::List(self.remarks()));
        blocks.push(Block::Plot(
            gap_plot(&d.history, Some(d.floor.mm), self.session.tolerance_mm),
            "The gap step by step; each step keeps what the ones before it brought".to_owned(),
        ));
        Section::new("Result", blocks)
    }

    /// What belongs to the table of the result.
    fn remarks(&self) -> Vec<String> {
        let (d, v) = (self.found, self.verification);
        let mut remarks = vec![format!(
            "cross-validation: {}",
            if d.held_out.gaps.is_some() {
                clean(&d.held_out.how)
            } else {
                "none, there are too few samples".to_owned()
            }
        )];
        if let Some(c) = v.compensated {
            remarks.push(format!(
                "not correctable by joint commands: {}",
                mm(c.cannot_be_removed_by_joints_mm)
            ));
            let homes = measured_poses(&Job::new(self.calibration, "report"));
            remarks.extend(
                Remainder::new(self.calibration, &homes)
                    .says()
                    .iter()
                    .map(|s| clean(s)),
            );
        }
        remarks.extend(self.noise());
        remarks.extend(v.notes.iter().map(|n| clean(n)));
        remarks
    }

    fn what_the_gap_is(&self) -> &'static str {
        if self.session.samples.observed.is_empty() {
            "RMS error is the root mean square of the distance between measured and simulated points"
        } else {
            "RMS error is the root mean square of the residuals, as lengths"
        }
    }

    /// Errors by kind of measurement, where there are other kinds than points.
    fn by_kind(&self) -> Vec<Block> {
        let kinds = &self.found.identification.kinds;
        if kinds.is_empty() {
            return Vec::new();
        }
        vec![
            Block::Text(
                "By kind of measurement, root mean square; an angle counts in the gap as the length \
                 across which it is seen"
                    .to_owned(),
            ),
            Block::Table(kinds::table(kinds)),
        ]
    }

    /// What there is to say of the noise, and of a fit that cannot be relied on.
    fn noise(&self) -> Vec<String> {
        let d = self.found;
        let mut lines = Vec::new();
        if let Some(noise) = &d.unexplained.noise {
            lines.push(format!("measurement noise: {}", noise.says()));
        }
        if let Some(slow) = &d.noise.slow {
            lines.push(format!("slow noise: {}", slow.says()));
        }
        let quality = &d.identification.quality;
        if !quality.converged {
            lines.push(format!("the fit did not converge: {}", quality.stopped));
        }
        lines
    }

    fn parameters(&self) -> Section {
        let d = self.found;
        if self.other.is_some() {
            return values(self.calibration);
        }
        let found = d.found.iter().flat_map(|f| &f.parameters);
        let all = d.identified.iter().chain(found);
        let mut blocks = vec![
            Block::Text(
                "What the real robot does beyond its drawing: a length of −1 mm is 1 mm short. \
                 What was commanded has to be corrected by the opposite"
                    .to_owned(),
            ),
            parameters(all.clone(), self.robot()),
        ];
        blocks.extend(implausible(all, self.robot()));
        let figures = d.found.iter().flat_map(|f| {
            let name = title_on(f.effect, f.joint, self.robot().joints.len());
            let said = f
                .figures
                .iter()
                .map(move |one| format!("{name}: {}", figure(*one)));
            said.collect::<Vec<_>>()
        });
        blocks.extend(figures.map(Block::Text));
        Section::new("Parameters of the real robot", blocks)
    }
}
