//! An identification: its errors, the geometry, what each level of correction brings, parameters, regions, and what
//! it is to be read with.

use super::detail::{held_out, with_largest};
use super::diagnosis::{expected, noise_facts};
use super::values;
use super::{Block, Detail, Fact, Section, Topic, cleaned, fact, open};
use crate::answers::noise::StatedNoise;
use crate::fit::{Identification, UnusableReason};
use crate::fit::{RegionResult, gap::Spread};
use crate::language::spoken;
use crate::present::chart::shortened;
use crate::present::identification_v1::degrees;
use crate::present::kinds;
use crate::present::table::{Cell, Column, Table};
use crate::present::units::Units;
use crate::sessions::Session;
use crate::set_up_errors::DataProblem;

/// The whole answer, in the order in which it is read.
#[doc(hidden)]
pub fn identification(
    answer: &Identification,
    session: &Session,
    data_problems: &[DataProblem],
    detail: Detail,
) -> Vec<Section> {
    let _speaking = detail.speaking();
    let title = if answer.regions.is_empty() {
        say!("Identification, full model")
    } else {
        say!("Identification by region, errors in the plane of motion")
    };
    let mut blocks = vec![Block::Facts(errors(answer, detail))];
    if !answer.kinds.is_empty() {
        blocks.push(Block::Table(kinds::table(&answer.kinds)));
    }
    blocks.extend(expected(answer, detail));
    let mut sections = vec![Section::of(Topic::Answer, title, blocks)];
    sections.extend(open::data_problems(data_problems));
    if !answer.parameters.is_empty() {
        let blocks = values(&answer.parameters, &session.robot, detail);
        sections.push(Section::new(say!("Identified parameters"), blocks));
    }
    if !answer.regions.is_empty() {
        let table = Block::Table(regions(&answer.regions));
        let title = say!("Correction of each region");
        sections.push(Section::new(title, vec![table]));
    }
    sections.extend(remarks_on_fit(answer, session, detail));
    sections
}

fn errors(answer: &Identification, detail: Detail) -> Vec<Fact> {
    let error = |error: &Spread| with_largest(error.rms_mm, error.max_mm, detail);
    let gap = &answer.gap;
    let mut facts = vec![
        fact(say!("RMS error, nominal robot"), error(&gap.before)),
        fact(say!("RMS error, identified"), error(&gap.after)),
    ];
    if let Some(unseen) = &answer.held_out {
        let (before, after) = (unseen.before.rms_mm, unseen.after.rms_mm);
        facts.push(held_out(before, after, unseen.samples, detail));
    }
    facts
}

/// What each level of correction would bring.
fn levels(answer: &Identification) -> Option<Section> {
    if answer.levels.is_empty() {
        return None;
    }
    let mut table = Table::headed(say!(
        "level of correction | >parameters | >RMS, mm | >cross-validated: mean | >RMS | >95 % | >largest"
    ));
    for level in &answer.levels {
        let unseen = level.cross_validated;
        let unseen = unseen.map(|e| [e.mean_mm, e.rms_mm, e.p95_mm, e.max_mm]);
        let errors = [level.rms_mm]
            .into_iter()
            .chain(unseen.into_iter().flatten());
        let mut cells = vec![spoken(level.what), level.parameters.to_string()];
        cells.extend(errors.map(|mm| format!("{mm:.4}")));
        table.row(cells);
    }
    let title = say!("Levels of correction");
    Some(Section::new(title, vec![Block::Table(table)]))
}

/// Letters of a region's name in a narrow panel: its numbers keep their places, however long it is.
const MOST_LETTERS: usize = 10;

/// The corrections of regions for a narrow panel and in its units: each with half of its interval below it, where
/// there are intervals, and what the error was below what it is.
#[doc(hidden)]
pub fn corrections(results: &[RegionResult], intervals: bool, units: Units) -> Block {
    let (angle, length) = (units.angle_name().trim(), units.length_name());
    let mut table = Table::of([
        Column::words(say!("region")),
        Column::numbers(format!("Δθ, {angle}")),
        Column::numbers(format!("Δl1, {length}")),
        Column::numbers(format!("{}, {length}", say!("RMS error"))),
    ]);
    for result in results {
        let c = &result.correction;
        let cell = |value, interval, unit| {
            let (value, half, _) = units.with_interval(value, interval, unit);
            Cell::from(if intervals {
                format!("{value}\n{half}")
            } else {
                value
            })
        };
        let theta = result.theta_ci95.map(|ends| ends.map(degrees));
        let before = units.length_number(result.rms_before_mm);
        let was = say!("was {rms_before}", rms_before = before);
        table.row([
            shortened(&c.name, MOST_LETTERS).into(),
            cell(degrees(c.theta_rad), theta, "°"),
            cell(c.l1_mm, result.l1_ci95, "mm"),
            format!("{}\n{was}", units.length_number(result.rms_after_mm)).into(),
        ]);
    }
    Block::Table(table)
}

fn regions(results: &[RegionResult]) -> Table {
    let mut table = Table::headed(say!(
        "region | >from ° | >to ° | >samples | >Δθ rad | >Δl1 mm | >before mm | >after mm"
    ));
    for r in results {
        let c = &r.correction;
        table.row([
            c.name.clone(),
            format!("{:.3}", degrees(c.from_rad)),
            format!("{:.3}", degrees(c.to_rad)),
            c.samples.to_string(),
            format!("{:.7}", c.theta_rad),
            format!("{:.7}", c.l1_mm),
            format!("{:.4}", r.rms_before_mm),
            format!("{:.4}", r.rms_after_mm),
        ]);
    }
    table
}

/// What was wrong in the session, with evidence and proposal.
#[doc(hidden)]
pub fn problems_of_data(problems: &[DataProblem], detail: Detail) -> Vec<Section> {
    let _speaking = detail.speaking();
    open::data_problems(problems)
}

/// What each level of correction would bring, what the samples do not determine, the noise, notes, and samples that do not count.
#[doc(hidden)]
pub fn remarks_on_fit(answer: &Identification, session: &Session, detail: Detail) -> Vec<Section> {
    let _speaking = detail.speaking();
    let not_identifiable =
        open::not_identifiable(&answer.not_identifiable, detail, open::MOST_COMBINATIONS);
    let outliers = open::outliers(answer, detail);
    let all = [
        levels(answer),
        not_identifiable,
        notes(answer, session, detail),
        outliers,
        unusable(answer, detail),
    ];
    all.into_iter().flatten().collect()
}

fn notes(answer: &Identification, session: &Session, detail: Detail) -> Option<Section> {
    let mut blocks = Vec::new();
    let quality = &answer.quality;
    if !quality.converged {
        blocks.push(Block::Warning(say!(
            "the fit did not converge: {stopped}",
            stopped = spoken(quality.stopped)
        )));
    }
    let mut facts = noise(answer, session);
    if detail.brief {
        facts.push(fact(
            say!("Solver"),
            say!(
                "{stopped}; {rank} of {coefficients} coefficients determined, condition {condition}",
                stopped = spoken(quality.stopped),
                rank = quality.rank,
                coefficients = quality.coefficients,
                condition = format!("{:.1}", quality.condition)
            ),
        ));
    }
    if !facts.is_empty() {
        blocks.push(Block::Facts(facts));
    }
    if !answer.notes.is_empty() {
        let notes = answer.notes.iter().map(cleaned);
        blocks.push(Block::List(notes.collect()));
    }
    (!blocks.is_empty()).then(|| Section::new(say!("Notes"), blocks))
}

/// The noise that the fit allows for.
fn noise(answer: &Identification, session: &Session) -> Vec<Fact> {
    let Some(noise) = &answer.noise else {
        return Vec::new();
    };
    let stated = noise.against_stated(session).filter(StatedNoise::differs);
    let stated = stated.map(|stated| spoken(stated.describe()));
    let slow = noise.slow.as_ref().map(|slow| {
        let says = slow.says_of_remaining_error(answer.gap.after.rms_mm);
        spoken(&says)
    });
    noise_facts(stated, noise, slow)
}

/// Samples that could not be used, each with the reason.
fn unusable(answer: &Identification, detail: Detail) -> Option<Section> {
    let lost = answer.left_out.iter();
    let lost = lost.filter(|one| one.because != UnusableReason::Excluded);
    let facts: Vec<Fact> = lost
        .map(|one| {
            let sample = say!("sample {sample}", sample = one.sample + 1);
            (sample, spoken(one.because.describe()))
        })
        .collect();
    (!facts.is_empty()).then(|| {
        let title = say!("Samples that cannot be used");
        Section::of(Topic::Outliers, title, detail.first_facts(facts))
    })
}
