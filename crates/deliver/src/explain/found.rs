//! What a search found: each effect with its size, its evidence and what to check on the machine.

use super::{Block, Detail, Fact, Section, Topic, fact};
use crate::answers::diagnosis::FamilyP;
use crate::diagnosis::{Diagnosis, FoundEffect};
use crate::effects;
use crate::fit::Estimate;
use crate::language::spoken as spoken_text;
use crate::present::names::{figure, parameter, title_of, title_on, usual_size};
use crate::present::numbers::{significant, trimmed};
use crate::text::{capital, spoken, within};

/// Odds beyond these are said to be more, as the models behind them are no better than that.
const MOST_ODDS: f64 = 1000.0;

pub(super) fn effects(d: &Diagnosis, detail: Detail) -> impl Iterator<Item = Section> {
    let found = d.found.iter().enumerate();
    found.map(move |(index, found)| effect(d, detail, index, &found.parameters))
}

/// An effect that was found, with these sizes of it.
pub(super) fn effect(d: &Diagnosis, detail: Detail, index: usize, sizes: &[Estimate]) -> Section {
    let found = &d.found[index];
    let title = title_on(found.effect, found.joint, d.model.robot.joints.len());
    let title = if detail.brief {
        // With its id, which is what options take.
        format!("{title} ({})", found.effect)
    } else {
        title
    };
    let check = fact(say!("Check on the machine"), spoken(found.check));
    let notes = found.notes.iter();
    let notes = notes.map(|note| fact(capital(say!("note")), spoken_text(note)));
    let implausible = sizes.iter().filter_map(implausible);
    let figures = found.figures.iter().map(|one| Block::Text(figure(*one)));
    let sizes = sizes.iter().map(|one| size(detail, one));
    let blocks: Vec<Block> = if detail.brief {
        let sizes = sizes.map(|(name, size)| format!("{name} {size}"));
        let sizes = fact(say!("Size"), sizes.collect::<Vec<_>>().join("; "));
        let evidence = fact(say!("Evidence"), evidence(detail, found));
        let facts = [sizes, evidence].into_iter().chain(notes).chain([check]);
        let facts = Block::Facts(facts.collect());
        [facts]
            .into_iter()
            .chain(figures)
            .chain(implausible)
            .collect()
    } else {
        // What is read first, and what it rests on.
        let first = Block::Facts(sizes.chain([check]).collect());
        let mut facts = Vec::from(evidence_in_facts(detail, found));
        let share = format!("{:.1} %", found.share * 100.0);
        facts.push(fact(say!("Share of what was explained"), share));
        if let Some(effect) = effects::find(found.effect) {
            facts.push(fact(
                capital(say!("usual cause")),
                spoken(effect.about().cause),
            ));
        }
        facts.extend(notes);
        let more = Block::Facts(facts);
        let first = [first].into_iter().chain(implausible);
        first.chain([more]).chain(figures).collect()
    };
    Section::of(Topic::Found(index), title, blocks)
}

/// A parameter with half of its 95 % interval.
fn size(detail: Detail, one: &Estimate) -> Fact {
    let (name, unit) = parameter(one.name);
    let units = detail.units.unwrap_or_default();
    let (value, half, unit) = units.estimate(one, unit);
    let size = format!("{value} {half}");
    let size = format!("{} {unit}", size.trim_end());
    (name, size.trim_end().replace(" °", "°"))
}

/// What is said of a size that no machine has.
fn implausible(one: &Estimate) -> Option<Block> {
    let says = spoken_text(&one.implausible()?);
    let (name, usual) = (parameter(one.name).0, usual_size(one));
    Some(Block::Warning(format!("{name}: {says} ({usual})")))
}

/// How often noise alone looks like this.
fn chance(own: FamilyP) -> String {
    say!(
        "p {sign} {p} (chance that noise alone looks like this)",
        sign = if own.bound { '<' } else { '=' },
        p = trimmed(own.p, 4)
    )
}

/// How much likelier it is than the next name.
fn odds(found: &FoundEffect) -> String {
    match found.next.as_ref().map(|next| title_of(next)) {
        None => say!("no other effect was a candidate").to_owned(),
        Some(next) if found.odds_over_next > MOST_ODDS => say!(
            "more than 1000 times likelier than the next candidate ({next})",
            next = within(&next)
        ),
        Some(next) => say!(
            "{odds} times likelier than the next candidate ({next})",
            odds = significant(found.odds_over_next, 2),
            next = within(&next)
        ),
    }
}

fn evidence(detail: Detail, found: &FoundEffect) -> String {
    let unseen = found
        .held_out_mm
        .map(|gap| say!("cross-validated RMS error {gap}", gap = detail.lengths(gap)));
    let all = [Some(chance(found.p_familywise)), Some(odds(found)), unseen];
    let all: Vec<String> = all.into_iter().flatten().collect();
    all.join("; ")
}

fn evidence_in_facts(detail: Detail, found: &FoundEffect) -> [Fact; 3] {
    let fitted = detail.lengths(found.gap_mm);
    let errors = match found.held_out_mm {
        None => fitted,
        Some(unseen) => say!(
            "{fitted}; cross-validated {unseen}",
            fitted,
            unseen = detail.lengths(unseen)
        ),
    };
    [
        fact(say!("Evidence"), chance(found.p_familywise)),
        fact(say!("Odds"), odds(found)),
        fact(say!("RMS error"), errors),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chance_has_no_more_digits_than_are_simulated() {
        let said = |p, bound| chance(FamilyP { p, bound });
        let behind = "(chance that noise alone looks like this)";
        assert_eq!(said(5e-4, true), format!("p < 0.0005 {behind}"));
        assert_eq!(
            said(0.001_952_841_276, false),
            format!("p = 0.002 {behind}")
        );
    }
}
