//! The report of a session: runs the diagnosis and says everything that came out.

use crate::compensation::verification::moved_by_correction;
use crate::compensation::{Remainder, Verification, verify};
use crate::diagnosis::anonymous::Where;
use crate::diagnosis::blunders::mend;
use crate::diagnosis::{Diagnosis, FloorFrom, Found, Options, Verdict, Watch, diagnose};
use crate::effects::{self, JointValues};
use crate::export::Job;
use crate::export::sidecar::measured_poses;
use crate::identification::gap::{Deviations, deviations};
use crate::identification::problem::Problem;
use crate::kinematics::Robot;
use crate::model::format_v1::model_hash;
use crate::model::{Calibration, Model};
use crate::sessions::{Session, hash_of_samples};
use crate::standards::standards;

use super::accuracy::{self, sides};
use super::document::{Block, Figure, Report, Section, Table, clean};
use super::drawing::{AFTER, BEFORE, CORRECTED};
use super::numbers::{mm, plain, short, three_digits};
use super::parts::{
    fact, foot, gap, instrument, of_joint, or_unnamed, parameters, robot_facts, signatures, tables,
    title, tolerance, unit_of_joint,
};
use super::plots::{Stage, Stages, deviation, waterfall, workspace};
use super::{Extras, ReportError};

/// Rows of lists that have no end of their own.
const MOST_ROWS: usize = 20;

impl Report {
    /// The report of a session. `watch` is told of progress and may stop it.
    ///
    /// # Errors
    /// If the session cannot be diagnosed, or `watch` stops it.
    pub fn of_session(
        session: &Session,
        options: &Options,
        extras: &Extras,
        watch: Watch,
    ) -> Result<Self, ReportError> {
        let found = diagnose(session, options, watch)?;
        Self::of_diagnosis(session, &found, options, extras)
    }

    /// The report of a session whose diagnosis is there already.
    ///
    /// # Errors
    /// If no sample can be used.
    pub fn of_diagnosis(
        session: &Session,
        found: &Diagnosis,
        options: &Options,
        extras: &Extras,
    ) -> Result<Self, ReportError> {
        // What is reported is the session that was diagnosed: with its blunders mended.
        let mended = mend(session, options);
        let calibration = found.calibration(&mended.session);
        let verification = verify(&calibration, &mended.session)?;
        let hash = hash_of_samples(session);
        let told = Told {
            session: &mended.session,
            given: session,
            found,
            calibration: &calibration,
            verification: &verification,
            model_hash: model_hash(&found.calibration(session)),
        };
        let mut sections = vec![told.measured(&hash), told.result(), told.parameters()];
        sections.extend(told.effects());
        sections.push(told.open());
        let stages = stages(
            &mended.session,
            &calibration,
            &verification,
            Some(found.floor.mm),
        )?;
        sections.push(told.workspace(&stages));
        let figures = standards(&mended.session, Some(&calibration))?;
        sections.push(accuracy::section(&figures));
        sections.push(told.limits());
        sections.extend(tables(extras, &hash, &told.model_hash));
        sections.push(signatures(extras));
        let subject = or_unnamed(&session.name);
        Ok(Self {
            title: "Calibration report".to_owned(),
            answer: told.answer(),
            headline: told.headline(),
            foot: foot(&subject, &hash),
            subject,
            sections,
        })
    }
}

/// A session's samples as measured, with corrected commands, and against the model.
///
/// # Errors
/// If the calibration is another robot's.
pub fn stages(
    session: &Session,
    calibration: &Calibration,
    verification: &Verification,
    floor_mm: Option<f64>,
) -> Result<Stages, ReportError> {
    let problem = Problem::new(session, JointValues::Commanded);
    let nominal = Model::nominal(calibration.model.robot.clone());
    let before = deviations(&problem, &nominal);
    let mut stages = vec![Stage {
        name: "As measured".to_owned(),
        colour: BEFORE,
        deviations: before.clone(),
    }];
    if let Some(moved) = moved_by_correction(calibration, session)? {
        let mut corrected = Deviations::default();
        for i in 0..before.length_mm.len() {
            let planar = session.samples.z_mm.is_none();
            let by = moved.get(i);
            let e: [f64; 3] = std::array::from_fn(|k| {
                let by = if planar && k == 2 { 0.0 } else { by[k] };
                before.axes_mm[k][i] + by
            });
            corrected.length_mm.push(crate::lanes::dot(e, e).sqrt());
            for (column, e) in corrected.axes_mm.iter_mut().zip(e) {
                column.push(e);
            }
        }
        stages.push(Stage {
            name: "With corrected commands".to_owned(),
            colour: CORRECTED,
            deviations: corrected,
        });
    }
    stages.push(Stage {
        name: "Against the model".to_owned(),
        colour: AFTER,
        deviations: verification.after.clone(),
    });
    // Deviations are shown over the joint that moved farthest, in its own unit.
    let joints = &session.robot.joints;
    let travel = |k: usize| {
        let finite = session.samples.q[k].iter().filter(|v| v.is_finite());
        let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
            (a.min(*v), b.max(*v))
        });
        (high - low).max(0.0)
    };
    let farthest = (0..joints.len())
        .rev()
        .max_by(|a, b| travel(*a).total_cmp(&travel(*b)));
    let k = farthest.unwrap_or(0);
    let dir = session.samples.dir.get(k).and_then(Option::as_ref);
    let n = session.samples.len();
    Ok(Stages {
        nominal: nominal.predict(&problem.inputs),
        over: format!(
            "joint {} ({}), {}",
            k + 1,
            or_unnamed(&joints[k].name),
            unit_of_joint(&joints[k]).trim()
        ),
        values: problem.inputs.q[k]
            .iter()
            .map(|q| of_joint(*q, &joints[k]))
            .collect(),
        side: (0..n)
            .map(|i| dir.map_or(0.0, |d| if d[i].is_nan() { 0.0 } else { d[i] }))
            .collect(),
        stages,
        floor_mm,
        tolerance_mm: session.tolerance_mm,
    })
}

/// Everything that is there to be told.
struct Told<'a> {
    session: &'a Session,
    given: &'a Session,
    found: &'a Diagnosis,
    calibration: &'a Calibration,
    verification: &'a Verification,
    model_hash: String,
}

impl Told<'_> {
    fn robot(&self) -> &Robot {
        &self.session.robot
    }

    fn answer(&self) -> String {
        let d = self.found;
        let found = match d.verdict {
            Verdict::Noise => "Nothing is missing in the model: what is left is noise",
            Verdict::Explained => "What was missing has a name, and what is left is noise",
            Verdict::PartlyExplained => {
                "A part of what was missing has a name; something is left that no name explains"
            }
            Verdict::Unexplained => "Something is missing in the model that no name explains",
        };
        let mut answer = found.to_owned();
        if !d.equivalent.is_empty() {
            answer += "; the samples cannot decide between some names";
        }
        if !d.data_problems.is_empty() {
            answer += "; the data had problems, which are named below";
        }
        answer
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
            |g| format!("{} on unseen samples", mm(g.end_mm)),
        );
        let mut figures = vec![
            figure(
                "Gap as measured",
                mm(d.gap.start_mm),
                format!("largest {}", mm(v.nominal.max_mm)),
            ),
            figure("Gap to the model", mm(d.gap.end_mm), unseen),
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
                "gap that the table alone leaves".to_owned(),
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
            facts.push(fact("Note", clean(&s.note)));
        }
        facts.extend(robot_facts(self.robot(), &self.found.measured));
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
        Section {
            title: "What was measured".to_owned(),
            blocks: vec![Block::Facts(facts)],
        }
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
        text += if z { "; x, y, z" } else { "; x, y only" };
        text
    }

    fn conditions(&self) -> String {
        let samples = &self.session.samples;
        let range = |column: &[f64], unit: &str| {
            let finite = column.iter().filter(|v| v.is_finite());
            let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| {
                (a.min(*v), b.max(*v))
            });
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
        let mut table = Table::new(&["Gap, mm", ">Fit", ">Unseen", ">Largest", ">Over the floor"]);
        let times = |mm: f64| {
            if d.floor.mm > 0.0 {
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
            "with zero offset and link length",
            d.gap.identified_mm,
            held.map(|g| g.identified_mm),
            None,
        );
        row(
            "with everything that was found",
            d.gap.end_mm,
            held.map(|g| g.end_mm),
            Some(v.model.max_mm),
        );
        if let Some(c) = v.compensated {
            row(
                "with corrected commands only",
                c.gap.rms_mm,
                None,
                Some(c.gap.max_mm),
            );
        }
        let mut blocks = vec![
            Block::Text(
                "The gap is the root mean square of the distance between measured and simulated \
                 points. Noise alone leaves the floor"
                    .to_owned(),
            ),
            Block::Table(table),
        ];
        let mut remarks = vec![format!(
            "unseen samples: {}",
            if d.held_out.gaps.is_some() {
                clean(&d.held_out.how)
            } else {
                "none, there are too few samples".to_owned()
            }
        )];
        if let Some(c) = v.compensated {
            remarks.push(format!(
                "no joint can remove {}: that stays, whatever a table says",
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
        remarks.extend(v.notes.iter().map(|n| clean(n)));
        blocks.push(Block::List(remarks));
        blocks.push(Block::Plot(
            waterfall(&d.history, Some(d.floor.mm), self.session.tolerance_mm),
            "The gap step by step; each step keeps what the ones before it brought".to_owned(),
        ));
        Section {
            title: "Result".to_owned(),
            blocks,
        }
    }

    fn parameters(&self) -> Section {
        let d = self.found;
        let found = d.found.iter().flat_map(|f| &f.parameters);
        Section {
            title: "Parameters of the real robot".to_owned(),
            blocks: vec![
                Block::Text(
                    "What the real robot does beyond its drawing: a length of −1 mm is 1 mm short. \
                     What was commanded has to be corrected by the opposite"
                        .to_owned(),
                ),
                parameters(d.identified.iter().chain(found), self.robot()),
            ],
        }
    }

    fn effects(&self) -> Option<Section> {
        let found = &self.found.found;
        if found.is_empty() {
            return None;
        }
        Some(Section {
            title: "What was missing, by name".to_owned(),
            blocks: found.iter().flat_map(|f| self.effect(f)).collect(),
        })
    }

    fn effect(&self, f: &Found) -> [Block; 2] {
        let about = effects::find(f.effect).map(effects::Effect::about);
        let percent = format!("{:.1} %", f.share * 100.0);
        let unseen = f.held_out_mm.map_or_else(
            || "too few samples".to_owned(),
            |[before, after]| format!("{} → {} mm", plain(before), plain(after)),
        );
        let mut facts = vec![
            fact("Evidence", sentence(&f.says)),
            fact(
                "Gap on the fit",
                format!("{} → {} mm", plain(f.gap_mm[0]), plain(f.gap_mm[1])),
            ),
            fact("Gap on unseen samples", unseen),
            fact("Share of what was explained", percent),
        ];
        if let Some(about) = about {
            facts.push(fact("Usual cause", about.cause));
        }
        facts.push(fact("Check on the machine", f.check));
        [
            Block::Heading(title(f.effect, f.joint, self.robot())),
            Block::Facts(facts),
        ]
    }

    fn open(&self) -> Section {
        let d = self.found;
        let mut blocks = Vec::new();
        for problem in &d.data_problems {
            blocks.push(Block::Heading(format!("Data: {}", clean(&problem.what))));
            blocks.push(Block::Facts(vec![
                fact("Evidence", clean(&problem.evidence)),
                fact("Proposal", clean(&problem.proposal)),
            ]));
        }
        if d.unexplained.present {
            blocks.push(Block::Heading("Left without a name".to_owned()));
            let mut facts = vec![
                fact(
                    "Size",
                    format!("{} root mean square", mm(d.unexplained.rms_mm)),
                ),
                fact("Evidence", clean(&d.unexplained.says)),
            ];
            if let Some(place) = &d.unexplained.place {
                facts.push(fact("Where", clean(&place_in_words(place))));
            }
            if !d.unexplained.resembles.is_empty() {
                let names = d
                    .unexplained
                    .resembles
                    .iter()
                    .map(|n| title(n, None, self.robot()));
                facts.push(fact(
                    "Resembles in part",
                    names.collect::<Vec<_>>().join(", "),
                ));
            }
            blocks.push(Block::Facts(facts));
        }
        if !d.equivalent.is_empty() {
            blocks.push(Block::Heading(
                "Names that the samples cannot tell apart".to_owned(),
            ));
            let mut table = Table::new(&[
                "In the model",
                "Could be instead",
                ">Odds against",
                "What would tell",
            ]);
            for rival in &d.equivalent {
                table.row([
                    rival.explanation.join(" + "),
                    rival.instead.join(" + "),
                    format!("{:.1} : 1", rival.odds),
                    clean(&rival.separate_by),
                ]);
            }
            blocks.push(Block::Table(table));
        }
        blocks.extend(self.next_poses());
        blocks.extend(self.outliers());
        if blocks.is_empty() {
            blocks.push(Block::Text(
                "Nothing: no data problem, no rival explanation, nothing left without a name, no \
                 suspected sample"
                    .to_owned(),
            ));
        }
        Section {
            title: "What stays open".to_owned(),
            blocks,
        }
    }

    fn next_poses(&self) -> Vec<Block> {
        let poses = &self.found.next_poses;
        if poses.is_empty() {
            return Vec::new();
        }
        let mut table = Table::new(&["Joints", "Side", "Reflector", "Speed", ">Load", "Why"]);
        let joints = &self.robot().joints;
        let values = |q: &[f64]| {
            let each = joints.iter().zip(q).map(|(joint, q)| {
                format!("{}{}", short(of_joint(*q, joint)), unit_of_joint(joint))
            });
            each.collect::<Vec<_>>().join(", ")
        };
        for pose in poses.iter().take(MOST_ROWS) {
            let place = pose
                .target_mm
                .map(|[x, y, z]| format!(" at ({}, {}, {}) mm", short(x), short(y), short(z)));
            let target = pose.target.as_deref().map_or_else(|| "–".to_owned(), clean);
            table.row([
                values(&pose.q),
                sides(&pose.dir),
                target + &place.unwrap_or_default(),
                pose.speed
                    .as_ref()
                    .map_or_else(|| "–".to_owned(), |s| values(s) + "/s"),
                pose.load_kg
                    .map_or_else(|| "–".to_owned(), |kg| format!("{} kg", short(kg))),
                clean(&pose.why),
            ]);
        }
        let mut blocks = vec![
            Block::Heading("Poses that would decide".to_owned()),
            Block::Table(table),
        ];
        if poses.len() > MOST_ROWS {
            blocks.push(Block::Text(format!("and {} more", poses.len() - MOST_ROWS)));
        }
        blocks
    }

    fn outliers(&self) -> Vec<Block> {
        let outliers = &self.found.outliers;
        if outliers.is_empty() {
            return Vec::new();
        }
        let mut table = Table::new(&["Sample", ">Off by, mm"]);
        for outlier in outliers.iter().take(MOST_ROWS) {
            table.row([
                (outlier.sample + 1).to_string(),
                plain(outlier.deviation_mm),
            ]);
        }
        let mut text = "They count in the largest deviation and in no root mean square".to_owned();
        if outliers.len() > MOST_ROWS {
            text += &format!("; {} of {} are listed", MOST_ROWS, outliers.len());
        }
        vec![
            Block::Heading(format!("Suspected samples: {}", outliers.len())),
            Block::Text(text),
            Block::Table(table),
        ]
    }

    fn workspace(&self, stages: &Stages) -> Section {
        let (places, magnification) = workspace(stages);
        let corrected = stages.stages.len() > 2;
        let caption = format!(
            "Measured points with their deviations, magnified {} times{}",
            short(magnification),
            if corrected {
                "; corrected commands act through the joints alone, the model holds what a \
                 controller can be told besides"
            } else {
                ""
            }
        );
        Section {
            title: "Deviations".to_owned(),
            blocks: vec![
                Block::Plot(places, caption),
                Block::Plot(
                    deviation(stages),
                    "Length of the deviation; the scales differ from panel to panel".to_owned(),
                ),
            ],
        }
    }

    fn limits(&self) -> Section {
        let d = self.found;
        let mut blocks = Vec::new();
        if !d.not_testable.is_empty() {
            blocks.push(Block::Heading("Not testable with this session".to_owned()));
            let mut table = Table::new(&["Effect", "Why"]);
            for n in d.not_testable.iter().take(4 * MOST_ROWS) {
                let name = title(n.effect, n.joint.map(|j| j + 1), self.robot());
                table.row([name, clean(&n.because)]);
            }
            blocks.push(Block::Table(table));
        }
        if !d.not_found.is_empty() {
            blocks.push(Block::Heading(
                "Not found, and how large it could be unseen".to_owned(),
            ));
            let mut table = Table::new(&["Effect", "Would have been seen above (95 %)"]);
            for limit in d.not_found.iter().take(4 * MOST_ROWS) {
                let sizes = limit.sizes.iter().map(|(name, size)| {
                    let (stem, unit) = super::numbers::in_words(name);
                    format!("{stem} {} {unit}", three_digits(*size))
                });
                let name = title(limit.effect, limit.joint.map(|j| j + 1), self.robot());
                table.row([name, sizes.collect::<Vec<_>>().join(", ")]);
            }
            blocks.push(Block::Table(table));
        }
        if blocks.is_empty() {
            blocks.push(Block::Text(
                "Every effect of the catalogue is in the model".to_owned(),
            ));
        }
        Section {
            title: "What the session could not show".to_owned(),
            blocks,
        }
    }
}

fn sentence(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| {
        first.to_uppercase().collect::<String>() + chars.as_str()
    })
}

fn place_in_words(place: &Where) -> String {
    match place {
        Where::Range { variable, from, to } => {
            format!("{variable} from {} to {}", short(*from), short(*to))
        }
        Where::Cycles {
            variable,
            cycles_per_turn,
        } => format!("{} cycles per turn of {variable}", short(*cycles_per_turn)),
    }
}
