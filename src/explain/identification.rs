//! An identification: what belongs to it beside its figures and parameters, which every place shows in its own way.

use super::{Block, Detail, Fact, Section, Topic, cleaned, fact, open};
use crate::answers::noise::StatedNoise;
use crate::fit::{Identification, Unusable};
use crate::language::spoken;
use crate::sessions::Session;
use crate::text::ByTitles;

/// What the samples do not determine, the noise, notes, and samples that do not count.
pub(crate) fn remarks_on_fit(
    answer: &Identification,
    session: &Session,
    detail: Detail,
) -> Vec<Section> {
    let _by_titles = ByTitles::begin();
    let not_identifiable = open::not_identifiable(&answer.not_identifiable, detail, usize::MAX);
    let outliers = open::outliers(answer, detail);
    let all = [
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
    let stated = stated.map(|stated| fact(say!("Measurement noise"), spoken(stated.says())));
    let slow = noise.slow.as_ref().map(|slow| {
        let says = slow.says_of_remaining_error();
        fact(say!("Slow noise"), spoken(&says))
    });
    stated.into_iter().chain(slow).collect()
}

/// Samples that could not be used, each with the reason.
fn unusable(answer: &Identification, detail: Detail) -> Option<Section> {
    let lost = answer.left_out.iter();
    let lost = lost.filter(|one| one.because != Unusable::Excluded);
    let facts: Vec<Fact> = lost
        .map(|one| {
            let sample = say!("sample {sample}", sample = one.sample + 1);
            (sample, spoken(one.because.says()))
        })
        .collect();
    (!facts.is_empty()).then(|| {
        let title = say!("Samples that cannot be used");
        Section::of(Topic::Outliers, title, detail.first_facts(facts))
    })
}
