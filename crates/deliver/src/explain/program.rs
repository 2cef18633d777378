//! Corrected targets of a table or a robot program: how many, how far off they were and are, what is given up of
//! their orientation, what could not be corrected.

use std::collections::BTreeMap;

use super::{Block, Detail, Fact, Section, Topic, clean, cleaned, fact};
use crate::language;
use crate::present::compensation_v1::{SAID_RAD, Summary};
use crate::present::names::word;
use crate::programs::{Answer, Outcome, SkippedTarget, Written};
use crate::text::{Text, capital, small_angle};

/// Where something is in the file: line and column, from 1.
type LineColumn = (u64, u64);

/// The whole answer; at most so many targets or remarks of a kind are listed, and the others counted.
/// `orientation`: whether the robot could keep one, which fewer than six joints never can.
#[doc(hidden)]
pub fn program(answer: &Answer, orientation: bool, most: usize, detail: Detail) -> Vec<Section> {
    let _speaking = detail.speaking();
    let summary = Summary::new(answer);
    let title = say!(
        "{corrected} of {all} targets corrected",
        corrected = summary.corrected,
        all = summary.targets
    );
    let errors = vec![Block::Facts(errors(&summary, detail))];
    let mut sections = vec![Section::of(Topic::Answer, title, errors)];
    sections.extend(
        orientation
            .then(|| in_part(answer, &summary, most))
            .flatten(),
    );
    // The terminal says them on standard error, each with its file.
    let left = if detail.brief {
        Vec::new()
    } else {
        left_as_they_are(answer)
    };
    let left = left.into_iter().chain(of_lines(&answer.at_run_time));
    sections.extend(listed(Topic::LeftAsIs, say!("Not corrected"), left, most));
    let notes = answer.notes.iter().map(cleaned);
    let notes = of_lines(&answer.remarks).chain(notes);
    sections.extend(listed(Topic::Other, say!("Notes"), notes, most));
    sections
}

/// Why targets were left as they are, those with the same reason in one line at the place of the first.
#[doc(hidden)]
pub fn left_as_they_are(answer: &Answer) -> Vec<String> {
    let mut lines: Vec<(&SkippedTarget, String, Vec<&Outcome>)> = Vec::new();
    let mut known = BTreeMap::new();
    for target in &answer.targets {
        let Err(left) = &target.result else { continue };
        let says = cleaned(&left.explanation);
        let line = *known
            .entry((left.reason.name(), says.clone()))
            .or_insert(lines.len());
        if line == lines.len() {
            lines.push((left, says, Vec::new()));
        }
        lines[line].2.push(target);
    }
    let say = |(left, says, targets): (&SkippedTarget, String, Vec<&Outcome>)| {
        let names: Vec<String> = targets.iter().map(|t| called(&t.name)).collect();
        let says = say!(
            "{targets} unchanged ({reason}): {left}",
            targets = names.join(", "),
            reason = word(left.reason.name()),
            left = says
        );
        at(targets[0].place, &says)
    };
    lines.into_iter().map(say).collect()
}

fn of_lines(lines: &[(u64, u64, Text)]) -> impl Iterator<Item = String> + '_ {
    let line = |(line, column, says): &(u64, u64, Text)| at((*line, *column), &cleaned(says));
    lines.iter().map(line)
}

fn listed(
    topic: Topic,
    title: &str,
    lines: impl Iterator<Item = String>,
    most: usize,
) -> Option<Section> {
    let blocks = first(lines, most)?;
    Some(Section::of(topic, title, blocks))
}

/// The first lines, and how many more there are; `None` where there are none.
fn first(lines: impl Iterator<Item = String>, most: usize) -> Option<Vec<Block>> {
    let mut lines = lines;
    let shown: Vec<String> = lines.by_ref().take(most).collect();
    if shown.is_empty() {
        return None;
    }
    let mut blocks = vec![Block::List(shown)];
    let more = lines.count();
    if more > 0 {
        blocks.push(Block::Text(say!("and {more} more", more)));
    }
    Some(blocks)
}

fn errors(summary: &Summary, detail: Detail) -> Vec<Fact> {
    if summary.corrected == 0 {
        return Vec::new();
    }
    let rms = detail.lengths([summary.before_mm, summary.after_mm]);
    let largest = detail.lengths([summary.max_before_mm, summary.max_after_mm]);
    vec![
        fact(say!("RMS position error, predicted"), rms),
        fact(capital(say!("largest position error")), largest),
    ]
}

/// Targets whose position is corrected in full and whose orientation only as far as small moves of the joints go.
fn in_part(answer: &Answer, summary: &Summary, most: usize) -> Option<Section> {
    let said = |target: &Outcome| {
        let written = target.result.as_ref().ok().filter(|w| is_in_part(w))?;
        let [before, after] = written
            .rotation_rad
            .map(|rad| language::spoken(small_angle(rad, 3)));
        let target_name = called(&target.name);
        let says = if is_worse(written) {
            say!(
                "{target}: {before} became {after}",
                target = target_name,
                before,
                after
            )
        } else {
            say!(
                "{target}: {after} left of {before}",
                target = target_name,
                after,
                before
            )
        };
        Some(at(target.place, &says))
    };
    let targets = answer.targets.iter().filter_map(said);
    let in_part = answer.targets.iter().filter_map(|t| t.result.as_ref().ok());
    let worse = in_part.filter(|w| is_in_part(w) && is_worse(w)).count();
    let largest = language::spoken(small_angle(summary.max_after_rad, 3));
    let title = if worse > 0 {
        say!(
            "Orientation off by more than before: {worse} of {targets}, largest error {largest}",
            worse,
            targets = summary.turned,
            largest
        )
    } else {
        say!(
            "Orientation corrected in part: {targets}, largest error left {largest}",
            targets = summary.turned,
            largest
        )
    };
    let listed = first(targets, most)?;
    let why = say!("The rest of the orientation would take large moves of the joints");
    let blocks = [Block::Text(why.to_owned())].into_iter().chain(listed);
    Some(Section::new(title, blocks.collect()))
}

fn is_in_part(written: &Written) -> bool {
    written.rotation_rad[1] > SAID_RAD
}

/// Whether its orientation is worse than without the correction of its position.
fn is_worse(written: &Written) -> bool {
    written.rotation_rad[1] > written.rotation_rad[0]
}

/// A target's name; rows of a table, which have none, in the reader's language.
fn called(name: &str) -> String {
    let row = name
        .strip_prefix("row ")
        .and_then(|n| n.parse::<u64>().ok());
    row.map_or_else(|| clean(name), |row| say!("row {rows}", rows = row))
}

/// What is said of a place in the file.
fn at((line, column): LineColumn, says: &str) -> String {
    say!("line {line}, column {column}: {says}", line, column, says)
}
