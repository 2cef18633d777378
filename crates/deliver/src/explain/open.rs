//! What a diagnosis leaves open: problems of the data, rivals, what has no name, poses that would decide, samples that
//! do not count, what the samples do not determine.

use super::{Block, Detail, Fact, Section, Topic, clean, cleaned, fact};
use crate::diagnosis::{Correction, Diagnosis, Unnamed};
use crate::fit::{Identification, NotIdentifiable};
use crate::present::names::title_of;
use crate::present::numbers::{grouped, significant};
use crate::present::place::described;
use crate::present::poses::{new_reflectors, table};
use crate::set_up_errors::DataProblem;
use crate::standards::grouping::gathered;
use crate::text::{ByTitles, within};

/// Combinations that are listed on one page; of an arm there may be dozens.
pub(super) const MOST_COMBINATIONS: usize = 2;

/// Set-up errors and mistakes of rows: each with its evidence and what to do.
pub(crate) fn data_problems(problems: &[DataProblem]) -> Vec<Section> {
    let _by_titles = ByTitles::begin();
    let sections = problems.iter().enumerate().map(|(index, problem)| {
        let title = say!("Data: {problem}", problem = cleaned(&problem.what));
        let mut facts = Vec::new();
        // Of several that were found together the first has it.
        let before = index
            .checked_sub(1)
            .map(|before| &problems[before].evidence);
        if before != Some(&problem.evidence) {
            facts.push(fact(say!("Evidence"), cleaned(&problem.evidence)));
        }
        facts.push(fact(say!("Proposal"), cleaned(&problem.proposal)));
        Section::of(Topic::DataProblem(index), title, vec![Block::Facts(facts)])
    });
    sections.collect()
}

pub(super) fn rivals(d: &Diagnosis, detail: Detail) -> Option<Section> {
    let says = |names: &[String]| {
        let titles = names.iter().map(|name| title_of(name));
        titles.collect::<Vec<_>>().join(" + ")
    };
    let rivals = d.equivalent.iter().map(|rival| {
        say!(
            "{other} instead of {explanation} (odds {odds} : 1 against it): {separate_by}",
            other = says(&rival.instead),
            explanation = within(&says(&rival.explanation)),
            odds = significant(rival.odds, 2),
            separate_by = cleaned(&rival.separate_by)
        )
    });
    let rivals: Vec<String> = rivals.collect();
    (!rivals.is_empty()).then(|| {
        let title = say!("Effects that the samples cannot tell apart");
        Section::of(
            Topic::Rivals,
            title,
            vec![Block::List(detail.first(rivals))],
        )
    })
}

pub(super) fn unexplained(d: &Diagnosis, detail: Detail) -> Option<Section> {
    let left = &d.unexplained;
    let mut facts = Vec::new();
    if left.present {
        facts.push(fact(say!("Size"), detail.length(left.rms_mm)));
        facts.push(fact(say!("Evidence"), cleaned(&left.description)));
        if let Some(place) = &left.place {
            facts.push(fact(say!("Where"), cleaned(described(place))));
        }
        if !left.resembles.is_empty() {
            let names = left.resembles.iter().map(|name| title_of(name));
            let names = names.collect::<Vec<_>>().join(", ");
            facts.push(fact(say!("Resembles in part"), names));
        }
    }
    (!facts.is_empty()).then(|| {
        let title = say!("Left without a name");
        Section::of(Topic::Unexplained, title, vec![Block::Facts(facts)])
    })
}

pub(super) fn unnamed(d: &Diagnosis, detail: Detail) -> Option<Section> {
    let unnamed = d.unnamed.as_ref()?;
    if let Some(curve) = &unnamed.curve {
        return Some(repeating(unnamed, curve, detail));
    }
    let over: Vec<_> = unnamed.over.iter().map(cleaned).collect();
    let facts = vec![
        fact(say!("Size"), detail.length(unnamed.rms_mm)),
        fact(
            say!("RMS error, cross-validated"),
            detail.lengths(unnamed.held_out_mm),
        ),
        fact(say!("Follows"), over.join(", ")),
    ];
    let says = say!(
        "It is attributed to no effect, but predicts unseen poses, so it is in the model. Outside the measured range it fades to nothing"
    );
    let blocks = vec![Block::Facts(facts), Block::Text(says.to_owned())];
    let title = say!("Predictive, not attributed to an effect");
    Some(Section::of(Topic::Unnamed, title, blocks))
}

/// What repeats over the only joint.
fn repeating(unnamed: &Unnamed, curve: &Correction, detail: Detail) -> Section {
    let mut facts = vec![
        fact(
            say!("Without a name"),
            say!(
                "{size}, over joint {joint}, in the table",
                size = detail.length(unnamed.rms_mm),
                joint = curve.term.joint + 1
            ),
        ),
        fact(
            say!("RMS error, cross-validated"),
            say!(
                "{change} ({how})",
                change = detail.lengths(curve.held_out_mm),
                how = cleaned(&curve.how)
            ),
        ),
    ];
    let others: Vec<_> = unnamed.beside_the_curve().iter().map(cleaned).collect();
    if !others.is_empty() {
        let change = detail.lengths([curve.held_out_mm[1], unnamed.held_out_mm[1]]);
        facts.push(fact(
            say!("In addition"),
            say!("{over}: {change}", over = others.join(", "), change),
        ));
    }
    if let Some(runs_mm) = curve.runs_held_out_mm {
        facts.push(fact(say!("Of another run"), detail.length(runs_mm)));
    } else {
        facts.push(fact(
            say!("Of another run"),
            say!("not known: in a single run what repeats and what drifts look the same"),
        ));
    }
    if let Some(values_mm) = curve.values_held_out_mm {
        facts.push(fact(
            say!("Between its values"),
            say!(
                "{size}: neighbours do not predict a position, measure in smaller steps",
                size = detail.length(values_mm)
            ),
        ));
    }
    let blocks = vec![
        Block::Facts(facts),
        Block::Text(cleaned(&curve.description)),
    ];
    Section::of(Topic::Unnamed, say!("Repeats, and has no name"), blocks)
}

pub(super) fn next_poses(d: &Diagnosis, detail: Detail) -> Option<Section> {
    let poses = &d.next_poses;
    if poses.is_empty() {
        return None;
    }
    let title = if d.equivalent.is_empty() {
        say!("Poses that would make more testable")
    } else {
        say!("Poses that would decide")
    };
    let blocks = if detail.brief {
        vec![Block::Text(say!(
            one "{count} pose: --json lists it, `truepose plan` makes a measuring list",
            "{count} poses: --json lists them, `truepose plan` makes a measuring list",
            count = poses.len()
        ))]
    } else {
        let shown = &poses[..poses.len().min(detail.most)];
        let mut table = table(shown, &d.model.robot);
        for row in &mut table.rows {
            for cell in row.iter_mut() {
                cell.shown = clean(&cell.shown);
            }
        }
        let mut blocks = vec![Block::Table(table)];
        let new = new_reflectors(poses);
        if !new.is_empty() {
            blocks.push(Block::List(new.iter().map(|line| clean(line)).collect()));
        }
        if poses.len() > detail.most {
            let more = poses.len() - detail.most;
            blocks.push(Block::Text(say!("and {more} more", more)));
        }
        blocks
    };
    Some(Section::of(Topic::NextPoses, title, blocks))
}

/// Samples that do not count: suspected ones, and those that are excluded: by hand, or by a correction.
pub(super) fn outliers(answer: &Identification, detail: Detail) -> Option<Section> {
    let outliers = answer.outliers.iter().map(|outlier| {
        fact(
            say!("sample {sample}", sample = outlier.sample + 1),
            if outlier.deviation_mm.is_finite() {
                detail.length(outlier.deviation_mm)
            } else {
                "–".to_owned()
            },
        )
    });
    let outliers: Vec<_> = outliers.collect();
    let by_hand = answer.excluded_in_words();
    if outliers.is_empty() && by_hand.is_none() {
        return None;
    }
    let title = if outliers.is_empty() {
        say!("Excluded samples").to_owned()
    } else {
        say!(
            "Excluded outliers: {excluded} of {all} samples",
            excluded = grouped(outliers.len()),
            all = grouped(answer.samples)
        )
    };
    let mut blocks: Vec<Block> = by_hand.map(Block::Text).into_iter().collect();
    if !outliers.is_empty() {
        if !detail.brief {
            let counted =
                say!("They count in the largest deviation and in no root mean square").to_owned();
            blocks.push(Block::Text(counted));
        }
        blocks.extend(detail.first_facts(outliers));
    }
    Some(Section::of(Topic::Outliers, title, blocks))
}

/// What the samples do not determine; more than so many combinations are only counted on one page.
pub(super) fn not_identifiable(
    open: &[NotIdentifiable],
    detail: Detail,
    most: usize,
) -> Option<Section> {
    if open.is_empty() {
        return None;
    }
    let blocks = if detail.brief && open.len() > most {
        vec![Block::Text(say!(
            one "{count} combination of parameters of which the samples show only the sum; one of them is held (– above), the others carry it: --json lists them", "{count} combinations of parameters of which the samples show only the sum; one of each is held (– above), the others carry it: --json lists them",
            count = open.len()
        ))]
    } else {
        let open = open.iter().take(4 * detail.most);
        by_reason(open.map(|open| (cleaned(&open.combination), cleaned(&open.because))))
    };
    let title = say!("Not identifiable");
    Some(Section::of(Topic::NotIdentifiable, title, blocks))
}

/// Combinations with the reason that they share, each reason once. The one that names the first parameter of its
/// combination is the same for all of them.
fn by_reason(open: impl Iterator<Item = Fact>) -> Vec<Block> {
    let reasons = gathered(open.map(|(combination, because)| {
        let ends = combination.char_indices().map(|(at, c)| at + c.len_utf8());
        let mut named = ends.rev().map(|end| combination[..end].trim_end());
        let own = named.find(|own| own.chars().count() > 2 && because.contains(*own));
        let reason = own.map_or(because.clone(), |own| {
            because.replace(own, say!("the first of each"))
        });
        (reason, (combination, because))
    }));
    let blocks = reasons.into_iter().flat_map(|(reason, facts)| {
        if facts.len() == 1 {
            return vec![Block::Facts(facts)];
        }
        let combinations = facts.into_iter().map(|(combination, _)| combination);
        vec![Block::Text(reason), Block::List(combinations.collect())]
    });
    blocks.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::Text;

    #[test]
    fn a_reason_that_combinations_share_is_said_once() {
        let open = |own: &str, with: &str, why: &str| NotIdentifiable {
            combination: Text::verbatim(format!("{own} with {with}")),
            because: Text::verbatim(format!("only the combination: {own} {why}")),
        };
        let all = [
            open("joint 1: x", "frame: x", "is held"),
            open("joint 1: about x", "frame: about x", "is held"),
            open("joint 2: z", "frame: z", "stays"),
        ];
        let section = not_identifiable(&all, Detail::REPORT, 2).expect("it is said");
        let [Block::Text(reason), Block::List(two), Block::Facts(one)] = &section.blocks[..] else {
            panic!("{:?}", section.blocks);
        };
        assert_eq!(reason, "only the combination: the first of each is held");
        assert_eq!(two.len(), 2);
        assert!(one.len() == 1 && one[0].1.contains("joint 2: z stays"));
    }

    #[test]
    fn the_evidence_of_problems_found_together_is_shown_once() {
        let problem = |evidence: &str| DataProblem {
            what: Text::verbatim("w"),
            evidence: Text::verbatim(evidence),
            proposal: Text::verbatim("p"),
            mend: None,
            samples: Vec::new(),
        };
        let sections = data_problems(&[problem("a"), problem("a"), problem("b"), problem("a")]);
        let facts = sections
            .iter()
            .map(|section| match section.blocks.as_slice() {
                [Block::Facts(facts)] => facts.len(),
                _ => 0,
            });
        assert_eq!(facts.collect::<Vec<_>>(), [2, 1, 2, 2]);
    }
}
