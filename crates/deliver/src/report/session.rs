//! The report of a session: everything that its diagnosis, verification and standards say.

use crate::compensation::decision::{FittedErrors, MeasuredDeviation, Outcome, Rule};
use crate::compensation::verification::VerifyError;
use crate::compensation::{Remainder, Verification, VerifiedCalibration};
use crate::diagnosis::Diagnosis;
use crate::effects::{Inputs, JointValues};
use crate::explain::{self, Detail, cleaned, fact};
use crate::export::Job;
use crate::export::poses::measured_poses;
use crate::fit::{Estimate, measured_ranges};
use crate::kinematics::Robot;
use crate::language::spoken;
use crate::model::Calibration;
use crate::model::format_v1::model_hash;
use crate::numeric::extent;
use crate::present::chart::in_words;
use crate::present::decision::{self, rests_on};
use crate::present::kinds;
use crate::present::names::title;
use crate::sessions::{Session, hash_of_samples};
use crate::standards::Standards;
use crate::text::{capital, current};

use super::calibration::values;
use super::document::{Block, Figure, Report, Section, Table, clean, clean_note};
use super::parts::{
    details, foot, gap, instrument, or_unnamed, robot_facts, signatures, tables, tolerance,
};
use super::plots::gap as gap_plot;
use super::stages::{section as deviations_of, stages};
use super::{Extras, ReportError, accuracy};
use crate::present::numbers::{mm, plain, short};

/// Rows of lists that have no end of their own.
pub(super) const MOST_ROWS: usize = 20;

/// What a report of a session is made from.
#[derive(Debug)]
pub struct Evidence<'a> {
    /// The session that was diagnosed: without the set-up errors that were corrected.
    pub session: &'a Session,
    /// The session as it was read.
    pub as_read: &'a Session,
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
        let _by_titles = crate::text::ByTitles::begin();
        let _units = crate::text::InUnits::of_documents();
        let Evidence {
            session,
            as_read: given,
            found,
            all_found,
            in_use,
            ..
        } = *evidence;
        let calibration = in_use.unwrap_or(all_found);
        let verification = &evidence.verification;
        let hash = hash_of_samples(given);
        let known = ReportContext {
            session,
            as_read: given,
            found,
            calibration,
            other: difference(calibration, all_found),
            verification,
            model_hash: model_hash(calibration),
        };
        let mut sections: Vec<Section> = details(&extras.details).into_iter().collect();
        sections.extend([known.measured(&hash), known.result(), known.parameters()]);
        let findings = known.findings();
        sections.extend(findings.effects);
        sections.push(findings.open);
        let stages = stages(session, calibration, verification, Some(found.floor.mm))?;
        sections.push(deviations_of(&stages));
        sections.push(match &evidence.standards {
            Ok(figures) => accuracy::section(figures),
            Err(error) => return Err(error.clone().into()),
        });
        sections.push(findings.sight);
        sections.extend(tables(extras, &hash, &known.model_hash));
        sections.push(signatures(extras));
        let subject = or_unnamed(&given.name);
        Ok(Self {
            title: say!("Calibration report").to_owned(),
            answer: known.answer(),
            logo: extras.details.logo.clone(),
            decision: extras.details.rule.map(|rule| known.decision(rule)),
            headline: known.headline(),
            foot: foot(&subject, &hash),
            language: current(),
            subject,
            sections: sections
                .into_iter()
                .map(Section::with_minus_signs)
                .collect(),
        })
    }
}

/// In what a model is not the one that was found; `None` where it is that one.
fn difference(model: &Calibration, found: &Calibration) -> Option<String> {
    if model.model == found.model && model.regions == found.regions {
        return None;
    }
    if !model.regions.is_empty() {
        return Some(say!("corrections by region").to_owned());
    }
    let ids = |c: &Calibration| -> Vec<&'static str> {
        c.model
            .terms()
            .iter()
            .map(|t| t.effect.about().id)
            .collect()
    };
    let (has, had) = (ids(model), ids(found));
    let lacks = |these: &[&'static str], all: &[&'static str]| {
        let names = all.iter().filter(|id| !these.contains(id));
        let names: Vec<&str> = names.map(|id| title(id)).collect();
        (!names.is_empty()).then(|| names.join(", "))
    };
    let less = lacks(&has, &had).map(|names| say!("without {effect}", effect = names));
    let more = lacks(&had, &has).map(|names| say!("with {effect}", effect = names));
    let sentences: Vec<String> = [less, more].into_iter().flatten().collect();
    Some(if sentences.is_empty() {
        say!("the same effects with other values").to_owned()
    } else {
        sentences.join(", ")
    })
}

/// Everything that is there to be translated.
pub(super) struct ReportContext<'a> {
    pub(super) session: &'a Session,
    pub(super) as_read: &'a Session,
    pub(super) found: &'a Diagnosis,
    calibration: &'a VerifiedCalibration,
    /// In what that model is not the one that was found.
    other: Option<String>,
    verification: &'a Verification,
    model_hash: String,
}

impl ReportContext<'_> {
    pub(super) fn robot(&self) -> &Robot {
        &self.session.robot
    }

    /// The answer in one sentence.
    fn answer(&self) -> String {
        let mut all = vec![explain::answer(self.found.verdict).to_owned()];
        all.extend(explain::remarks(self.found));
        if let Some(other) = &self.other {
            all.push(say!("the model in use is another one: {other}", other));
        }
        all.join("; ")
    }

    /// Whether the robot is within its tolerance, and what that rests on.
    fn decision(&self, rule: Rule) -> (Outcome, String) {
        let fitted = FittedErrors::from(self.found);
        let none = |because: &str| (Outcome::Undecided, decision::none(because));
        let Some(tolerance) = self.session.tolerance_mm else {
            return none(say!("no tolerance is stated"));
        };
        match MeasuredDeviation::of(self.session, self.verification, fitted) {
            Err(because) => none(&spoken(because)),
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
            reference: beside,
        };
        let unseen = d.held_out.gaps.map_or_else(
            || say!("too few samples to hold any out").to_owned(),
            |g| say!("{size} cross-validated", size = mm(g.end_mm)),
        );
        let mut figures = vec![
            figure(
                say!("RMS error, nominal robot"),
                mm(d.gap.start_mm),
                say!("largest {size}", size = mm(v.nominal.max_mm)),
            ),
            if self.other.is_some() {
                let all = format!(
                    "{} {}",
                    mm(d.gap.end_mm),
                    say!("with everything that was found")
                );
                figure(say!("RMS error, model in use"), mm(v.model.rms_mm), all)
            } else {
                figure(say!("RMS error, model"), mm(d.gap.end_mm), unseen)
            },
            figure(
                &capital(say!("noise floor")),
                mm(d.floor.mm),
                explain::floor_from(d.floor.from).to_owned(),
            ),
        ];
        figures.push(match (&v.within_tolerance, self.session.tolerance_mm) {
            (Some(within), Some(tolerance)) => figure(
                &say!("Within {tolerance} mm", tolerance = short(tolerance)),
                say!(
                    "{inside} of {all}",
                    inside = within.corrected.unwrap_or(within.after),
                    all = within.of
                ),
                say!(
                    "{how}; {before} as measured",
                    how = match within.corrected {
                        Some(_) => say!("with corrected commands"),
                        None => say!("with the model"),
                    },
                    before = within.before
                ),
            ),
            _ => figure(
                say!("Corrected commands"),
                v.compensated
                    .map_or_else(|| "–".to_owned(), |c| mm(c.gap.rms_mm)),
                say!("RMS error left by the table").to_owned(),
            ),
        });
        figures
    }

    fn measured(&self, hash: &str) -> Section {
        let s = self.as_read;
        let mut facts = vec![fact(say!("Session"), or_unnamed(&s.name))];
        if !s.note.trim().is_empty() {
            facts.push(fact(say!("Note"), clean_note(&s.note)));
        }
        let inputs = Inputs::new(s, JointValues::Commanded);
        facts.extend(robot_facts(self.robot(), &measured_ranges(&inputs)));
        facts.push(fact(capital(say!("instrument")), instrument(&s.instrument)));
        let targets: Vec<String> = s
            .targets
            .iter()
            .take(MOST_ROWS)
            .map(|t| {
                let p = t.position_mm;
                let at = [p.x, p.y, p.z].map(short).join(", ");
                format!("{} ({at}) mm", clean(&t.name))
            })
            .collect();
        facts.push(fact(
            say!("Reflectors in the tool frame"),
            targets.join("; "),
        ));
        facts.push(fact(capital(say!("samples")), self.samples()));
        if let Some(measured) = s.kinds_in_words().map(spoken) {
            facts.push(fact(say!("Measured"), measured));
        }
        facts.push(fact(capital(say!("conditions")), self.conditions()));
        facts.push(tolerance(s.tolerance_mm));
        if let Some(by) = &s.compensated_by {
            facts.push(fact(
                say!("Measured with a correction table active"),
                clean(by),
            ));
        }
        facts.push(fact(
            say!("Method"),
            say!(
                "robust nonlinear least squares over the effects of the catalogue, found by a forward search with family-wise significance; intervals allow for the search"
            ),
        ));
        facts.push(fact(
            say!("Program"),
            format!("truepose {}", env!("CARGO_PKG_VERSION")),
        ));
        facts.push(fact(say!("Hash of robot and samples"), hash));
        facts.push(fact(say!("Hash of the model"), self.model_hash.clone()));
        Section::new(say!("What was measured"), vec![Block::Facts(facts)])
    }

    fn samples(&self) -> String {
        let all = self.session.samples.len();
        let used = self.verification.samples;
        let mut text = format!("{all}");
        if used < all {
            let lost = say!("{count} of them cannot be used", count = all - used);
            text += &format!(", {lost}");
        }
        if let Some(held) = &self.session.samples.held_out {
            let held = held.iter().filter(|h| **h).count();
            let held = say!("{held} held out by the file", held);
            text += &format!(", {held}");
        }
        let z = self.session.samples.z_mm.is_some();
        if !self.session.samples.observed.is_empty() {
            return text;
        }
        text += "; ";
        text += if z { "x, y, z" } else { say!("x, y only") };
        text
    }

    fn conditions(&self) -> String {
        let samples = &self.session.samples;
        let range = |column: &[f64], unit: &str| {
            let [low, high] = extent(column.iter());
            if low > high {
                say!("not known").to_owned()
            } else if low == high {
                format!("{} {unit}", short(low))
            } else {
                say!(
                    "{from} to {to}",
                    from = short(low),
                    to = format!("{} {unit}", short(high))
                )
            }
        };
        let value = |column: Option<&Vec<f64>>, unit: &str| {
            column.map_or_else(|| say!("not recorded").to_owned(), |c| range(c, unit))
        };
        [
            (say!("load"), &samples.load_kg, "kg"),
            (say!("temperature"), &samples.temperature_c, "°C"),
            (say!("time"), &samples.time_s, "s"),
        ]
        .map(|(name, column, unit)| format!("{name} {}", value(column.as_ref(), unit)))
        .join("; ")
    }

    fn result(&self) -> Section {
        let (d, v) = (self.found, self.verification);
        let mut table = Table::headed(say!(
            "RMS error, mm | >Fit | >Cross-validated | >Largest | >Over the floor"
        ));
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
            say!("nominal robot"),
            d.gap.start_mm,
            held.map(|g| g.start_mm),
            Some(v.nominal.max_mm),
        );
        row(
            &d.history.get(1).map_or(String::new(), |step| {
                say!("with {effect}", effect = in_words(&clean(&step.what)))
            }),
            d.gap.identified_mm,
            held.map(|g| g.identified_mm),
            None,
        );
        row(
            say!("with everything that was found"),
            d.gap.end_mm,
            held.map(|g| g.end_mm),
            Some(v.model.max_mm).filter(|_| self.other.is_none()),
        );
        if let Some(other) = &self.other {
            let (rms, max) = (v.model.rms_mm, v.model.max_mm);
            row(
                &format!("{} ({other})", say!("RMS error, model in use")),
                rms,
                None,
                Some(max),
            );
        }
        if let Some(c) = v.compensated {
            row(
                say!("with corrected commands"),
                c.gap.rms_mm,
                None,
                Some(c.gap.max_mm),
            );
        }
        let mut blocks = vec![
            Block::text(say!(
                "RMS error is the root mean square of the residuals, as lengths. Noise alone leaves the floor"
            )),
            Block::Table(table),
        ];
        blocks.extend(self.by_kind());
        blocks.extend(explain::expected(&d.identification, Detail::REPORT));
        blocks.push(Block::List(self.remarks()));
        blocks.push(Block::Plot(
            gap_plot(&d.history, Some(d.floor.mm), self.session.tolerance_mm),
            capital(say!("the gap step by step")),
        ));
        Section::new(say!("Result"), blocks)
    }

    /// What belongs to the table of the result.
    fn remarks(&self) -> Vec<String> {
        let (d, v) = (self.found, self.verification);
        let how = cleaned(&d.held_out.how);
        let mut remarks = vec![say!("cross-validation: {how}", how)];
        if let Some(c) = v.compensated {
            remarks.push(say!(
                "not correctable by joint commands: {size}",
                size = mm(c.cannot_be_removed_by_joints_mm)
            ));
            let range = measured_poses(&Job::new(self.calibration, ""));
            let inputs = Inputs::new(self.session, JointValues::Commanded);
            let [in_file, of_session] =
                [&range, &inputs].map(|inputs| Remainder::new(self.calibration, inputs).describe());
            let lines = explain::not_correctable(&in_file, &of_session);
            remarks.extend(lines.iter().map(cleaned));
        }
        let noise = explain::noise(d).into_iter();
        remarks.extend(noise.map(|(name, says)| format!("{name}: {says}")));
        remarks.extend(v.notes.iter().map(cleaned));
        remarks
    }

    /// Errors by kind of measurement, where there are other kinds than points.
    fn by_kind(&self) -> Vec<Block> {
        let kinds = &self.found.identification.kinds;
        if kinds.is_empty() {
            return Vec::new();
        }
        vec![
            Block::text(say!(
                "By kind of measurement, root mean square; an angle counts in the RMS error as the length across which it is seen"
            )),
            Block::Table(kinds::table(kinds)),
        ]
    }

    fn parameters(&self) -> Section {
        let d = self.found;
        if self.other.is_some() {
            return values(self.calibration);
        }
        let found = d.found.iter().flat_map(|f| &f.parameters);
        let all = d.identified.iter().chain(found);
        let all: Vec<Estimate> = all.cloned().collect();
        let mut blocks = vec![Block::text(say!(
            "Deviations of the real robot from the nominal model: a length of −1 mm is 1 mm short. Commands are corrected by the opposite"
        ))];
        blocks.extend(explain::values(&all, self.robot(), Detail::REPORT));
        Section::new(say!("Parameters of the real robot"), blocks)
    }
}
