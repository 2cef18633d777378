//! The file of a laser's own software (`.rtl`): sections, each under a line that ends with `::`.
//!
//! ```text
//! TARGET DATA::
//! Target-count: 3
//! Targets :
//!     0.0000   100.0000   200.0000
//! Flags: 0 0 0
//! RUNS::
//! Run-count: 2
//! DEVIATIONS::
//! Run Target Data:
//!    1     1      0.0000
//!    1     2      1.2000
//! ```
//!
//! The second number of a row is that of its target, from 1; a run goes up or down the targets. The format is not
//! published; seven public programs that read such files agree on it, and for linear axes on targets in mm and
//! deviations in µm. About angles they do not agree.

use super::in_units::Units;
use super::parts::Measurement;
use crate::diagnostic::Diagnostic;
use crate::importers::settings::ReadContext;
use crate::sessions::columns::Unit;
use crate::text::Text;

pub(super) const UNITS: Units = Units {
    target: Unit::Length(1.0),
    measured: Unit::Length(1e-3),
};

/// Whether a text is such a file.
pub(super) fn is_one(text: &str) -> bool {
    let has = |name: &str| text.lines().any(|line| line.trim() == name);
    has("TARGET DATA::") && has("DEVIATIONS::")
}

/// The runs of such a file, in the order of measuring.
pub(super) fn runs(context: &mut ReadContext<'_>) -> Vec<Measurement> {
    if !context.reading.slides {
        context.refuse(
            text!("angles in a file of sections, whose unit is not stated"),
            text!("the same runs as a table, with the unit in the heading of the deviations"),
        );
        return Vec::new();
    }
    let (list, wrong) = parsed(context.text);
    for (line, found, expected) in wrong {
        let place = context.place.clone().at_line(line);
        let finding = Diagnostic::error(place, found, expected);
        context.found.findings.push(finding);
    }
    context.note(text!(
        "targets are read in mm and deviations in µm, as the software of the laser writes them"
    ));
    list
}

/// Measurements, and what is wrong: line, what was found, what was expected.
fn parsed(text: &str) -> (Vec<Measurement>, Vec<(u64, Text, Text)>) {
    let (mut targets, mut list, mut wrong) = (Vec::new(), Vec::<Measurement>::new(), Vec::new());
    let (mut section, mut in_targets) = ("", false);
    for (line, row) in (1..).zip(text.lines()) {
        let row = row.trim();
        if let Some(name) = row.strip_suffix("::") {
            (section, in_targets) = (name, false);
            continue;
        }
        match section {
            "TARGET DATA" => {
                let mut behind = row;
                if row.starts_with(char::is_alphabetic) {
                    in_targets = row.starts_with("Targets");
                    behind = row.split_once(':').map_or("", |(_, behind)| behind);
                }
                for word in behind.split_whitespace().filter(|_| in_targets) {
                    // One that is no number keeps its place: those behind it are counted from it.
                    targets.push(number(word).unwrap_or(f64::NAN));
                    if number(word).is_none() {
                        wrong.push((line, Text::verbatim(word), text!("a number")));
                    }
                }
            }
            "DEVIATIONS" if !(row.is_empty() || row.starts_with(char::is_alphabetic)) => {
                let words: Vec<&str> = row.split_whitespace().collect();
                let read = match words[..] {
                    [run, target, deviation] => (run.parse().ok())
                        .zip(target.parse::<usize>().ok())
                        .zip(number(deviation)),
                    _ => None,
                };
                let Some(((run, target), measured)) = read else {
                    let expected = text!("run, number of the target, deviation");
                    wrong.push((line, Text::verbatim(row), expected));
                    continue;
                };
                let Some(at) = target.checked_sub(1).and_then(|k| targets.get(k)) else {
                    let found = text!("target number {number}", number = target);
                    let count = targets.len();
                    wrong.push((line, found, text!("1 to {count}", count)));
                    continue;
                };
                list.push(Measurement {
                    run,
                    dir: 0.0,
                    target: *at,
                    measured,
                    line,
                });
            }
            _ => {}
        }
    }
    list.sort_by_key(|one| one.run);
    for run in list.chunk_by_mut(|a, b| a.run == b.run) {
        let way = run[run.len() - 1].target - run[0].target;
        let dir = if way == 0.0 { 0.0 } else { way.signum() };
        for one in run {
            one.dir = dir;
        }
    }
    (list, wrong)
}

/// A number, with a point or a comma.
fn number(word: &str) -> Option<f64> {
    let number: f64 = word.replace(',', ".").parse().ok()?;
    number.is_finite().then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "HEADER::\nFile type: x\nTARGET DATA::\nFiletype: Linear\nTarget-count: 3\nTargets :\n 0.0  \
                        100.0\n 200,5\nFlags: 0 0\nUSER-TEXT::\nMachine: 4 5 6\nRUNS::\nRun-count: 2\nDEVIATIONS::\nRun \
                        Target Data: \n 1 1 0.0\n 1 2 1,2\n 1 3 2.4\n 2 3 3.0\n 2 2 1.9\n 2 1 .9\nENVIRONMENT::\n1 2\nEOF::\n";

    #[test]
    fn runs_go_up_and_down_the_targets() {
        assert!(is_one(FILE));
        let (list, wrong) = parsed(FILE);
        assert!(wrong.is_empty());
        let list: Vec<(u64, f64, f64, f64)> = list
            .iter()
            .map(|m| (m.run, m.dir, m.target, m.measured))
            .collect();
        assert_eq!(
            list,
            [
                (1, 1.0, 0.0, 0.0),
                (1, 1.0, 100.0, 1.2),
                (1, 1.0, 200.5, 2.4),
                (2, -1.0, 200.5, 3.0),
                (2, -1.0, 100.0, 1.9),
                (2, -1.0, 0.0, 0.9)
            ]
        );
    }

    #[test]
    fn a_target_that_is_no_number_is_named_and_keeps_its_place() {
        let (list, wrong) = parsed(&FILE.replace(" 0.0  ", " *** "));
        assert_eq!(wrong.iter().map(|one| one.0).collect::<Vec<_>>(), [7]);
        assert_eq!(list[1].target, 100.0);
    }

    #[test]
    fn a_row_without_a_target_is_named_by_its_line() {
        for row in [" 2 4 1.9", " 2 0 1.9", " 2 x 1.9", " 2 2"] {
            let (_, wrong) = parsed(&FILE.replace(" 2 2 1.9", row));
            assert_eq!(
                wrong.iter().map(|one| one.0).collect::<Vec<_>>(),
                [20],
                "{row}"
            );
        }
    }
}
