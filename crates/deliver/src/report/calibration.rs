//! The report of a model file: what it holds, and what only a session can show.

use crate::compensation::VerifiedCalibration;
use crate::compensation::decision::Outcome;
use crate::explain::{self, Detail, fact};
use crate::fit::uncertainty::{all_estimates, normal_95};
use crate::model::Calibration;
use crate::model::format_v1::model_hash;
use crate::present::decision;
use crate::units::deg_from_rad;

use super::Extras;
use super::document::{Block, Figure, Report, Section, Table, clean};
use super::parts::{details, foot, gap, or_unnamed, robot_facts, signatures, tables, tolerance};
use super::plots::gap as gap_plot;
use crate::present::chart::in_words;
use crate::present::numbers::{mm, plain};
use crate::text::{capital, current};

impl Report {
    /// The report of a model file.
    pub fn of_model(calibration: &VerifiedCalibration, extras: &Extras) -> Self {
        let _by_titles = crate::text::ByTitles::begin();
        let _units = crate::text::InUnits::of_documents();
        let hash = model_hash(calibration);
        let tolerance_mm = extras.details.tolerance_mm.or(calibration.tolerance_mm);
        let mut sections = vec![
            origin(calibration, tolerance_mm, &hash),
            history(calibration, tolerance_mm),
            values(calibration),
        ];
        if let Some(details) = details(&extras.details) {
            sections.insert(0, details);
        }
        sections.extend(tables(extras, &calibration.samples_hash, &hash));
        sections.push(missing());
        sections.push(signatures(extras));
        let subject = or_unnamed(&calibration.session);
        Self {
            title: say!("Calibration report of a model").to_owned(),
            answer: say!(
                "What the model file holds; the evidence for it is in the session that it came from"
            )
            .to_owned(),
            logo: extras.details.logo.clone(),
            decision: extras.details.rule.map(|_| {
                let because = say!("only a session has the measured positions that it needs");
                (Outcome::Undecided, decision::none(because))
            }),
            headline: headline(calibration),
            foot: foot(&subject, &calibration.samples_hash),
            language: current(),
            subject,
            sections: sections
                .into_iter()
                .map(Section::with_minus_signs)
                .collect(),
        }
    }
}

fn headline(c: &Calibration) -> Vec<Figure> {
    let step = |name: &str, step: Option<&crate::model::ResidualStep>| {
        step.map(|s| Figure {
            name: name.to_owned(),
            value: mm(s.gap_mm),
            reference: s.held_out_mm.map_or_else(String::new, |u| {
                say!("{size} cross-validated", size = mm(u))
            }),
        })
    };
    let ends = [
        step(say!("RMS error, nominal robot"), c.history.first()),
        step(
            say!("RMS error, model"),
            c.history.last().filter(|_| c.history.len() > 1),
        ),
    ];
    ends.into_iter().flatten().collect()
}

fn origin(c: &Calibration, tolerance_mm: Option<f64>, hash: &str) -> Section {
    let mut facts = vec![fact(say!("Session"), or_unnamed(&c.session))];
    facts.extend(robot_facts(&c.model.robot, &c.measured));
    facts.push(tolerance(tolerance_mm));
    if let Some(by) = &c.compensated_by {
        facts.push(fact(
            say!("Measured with a correction table active"),
            clean(by),
        ));
    }
    facts.push(fact(
        say!("Made by"),
        format!("truepose {}", clean(&c.program_version)),
    ));
    facts.push(fact(
        say!("Reported by"),
        format!("truepose {}", env!("CARGO_PKG_VERSION")),
    ));
    facts.push(fact(
        say!("Hash of robot and samples"),
        clean(&c.samples_hash),
    ));
    facts.push(fact(say!("Hash of the model"), hash));
    Section::new(
        say!("Where the model comes from"),
        vec![Block::Facts(facts)],
    )
}

fn history(c: &Calibration, tolerance_mm: Option<f64>) -> Section {
    let mut table = Table::headed(say!(
        "Step | >RMS error on the fit, mm | >Cross-validated, mm"
    ));
    let mut steps = c.history.clone();
    for step in &mut steps {
        step.what = clean(&step.what);
        table.row([
            in_words(&step.what),
            plain(step.gap_mm),
            gap(step.held_out_mm),
        ]);
    }
    Section::new(
        capital(say!("the gap step by step")),
        vec![
            Block::Table(table),
            Block::Plot(
                gap_plot(&steps, None, tolerance_mm),
                say!("Each step keeps what the ones before it brought").to_owned(),
            ),
        ],
    )
}

pub(super) fn values(c: &Calibration) -> Section {
    let mut blocks = Vec::new();
    let all = all_estimates(c, normal_95());
    if !all.is_empty() {
        blocks.push(Block::text(say!(
                "Deviations of the real robot from the nominal model: a length of −1 mm is 1 mm short. Intervals are from the model's covariance, for many samples"
            )));
        blocks.extend(explain::values(&all, &c.model.robot, Detail::REPORT));
    }
    if !c.regions.is_empty() {
        let mut table = Table::headed(say!(
            "Region | >From, ° | >To, ° | >Samples | >Δθ, ° | >Δl1, mm"
        ));
        for region in &c.regions {
            table.row([
                clean(&region.name),
                plain(deg_from_rad(region.from_rad)),
                plain(deg_from_rad(region.to_rad)),
                region.samples.to_string(),
                plain(deg_from_rad(region.theta_rad)),
                plain(region.l1_mm),
            ]);
        }
        blocks.push(Block::text(say!(
            "Corrections by region: what to add to the joint's command and along the radius at home"
        )));
        blocks.push(Block::Table(table));
    }
    if blocks.is_empty() {
        blocks.push(Block::text(say!(
            "The model is the nominal robot: no effect is in it"
        )));
    }
    Section::new(say!("Parameters of the real robot"), blocks)
}

fn missing() -> Section {
    Section::new(
        say!("What only a session can show"),
        vec![Block::text(say!(
            "The evidence for each name: the chance that noise alone looks like it, the odds over other names, what stays unexplained, what could not be tested; deviations in the workspace and over the joints; accuracy and repeatability after ISO 230-2 and ISO 9283; what corrected commands leave on measured samples"
        ))],
    )
}
