//! A model held against a session: what it leaves there, and what its corrected commands would.

use super::detail::{held_out, to_the_nanometre as length, with_largest};
use super::{Block, Detail, Fact, Section, Topic, cleaned, fact, open};
use crate::compensation::Verification;
use crate::present::numbers::grouped;

/// The figures, what is wrong with the samples, suspected outliers, notes.
#[doc(hidden)]
pub fn verification(v: &Verification, detail: Detail) -> Vec<Section> {
    let _speaking = detail.speaking();
    let figures = errors(v, detail).into_iter().chain(corrected(v, detail));
    let figures = vec![Block::Facts(figures.collect())];
    let mut sections = vec![Section::new(say!("Held against this session"), figures)];
    sections.extend(open::data_problems(&v.data_problems));
    if !v.outliers.is_empty() {
        let samples = v.outliers.iter().map(|sample| (sample + 1).to_string());
        let samples = samples.collect::<Vec<_>>().join(", ");
        let listed = vec![Block::Text(say!("samples {samples}", samples))];
        let title = say!("Suspected outliers");
        sections.push(Section::of(Topic::Outliers, title, listed));
    }
    if !v.notes.is_empty() {
        let notes = v.notes.iter().map(cleaned).collect();
        sections.push(Section::new(say!("Notes"), vec![Block::List(notes)]));
    }
    sections
}

fn errors(v: &Verification, detail: Detail) -> Vec<Fact> {
    let length = |length_mm: f64| length(length_mm, detail);
    let error = |rms_mm: f64, largest_mm: f64| with_largest(rms_mm, largest_mm, detail);
    let (nominal, model) = (&v.nominal, &v.model);
    let mut facts = vec![
        fact(
            say!("RMS error, nominal robot"),
            error(nominal.rms_mm, nominal.max_mm),
        ),
        fact(say!("RMS error, model"), error(model.rms_mm, model.max_mm)),
    ];
    if let Some(trimmed) = &v.trimmed {
        let sentence = say!(
            "{model} with the model, {excluded} of {all} samples set aside",
            model = length(trimmed.model_mm),
            excluded = grouped(trimmed.set_aside),
            all = grouped(v.samples)
        );
        facts.push(fact(say!("without suspected ones"), sentence));
    }
    if let Some(unseen) = &v.held_out {
        let (nominal, model) = (unseen.nominal_mm, unseen.model_mm);
        facts.push(held_out(nominal, model, unseen.samples, detail));
    }
    facts
}

fn corrected(v: &Verification, detail: Detail) -> Vec<Fact> {
    let mut facts = Vec::new();
    if let Some(within) = &v.within_tolerance {
        let sentence = say!(
            "{before} of {all} before, {after} with the model",
            before = grouped(within.before),
            all = grouped(within.of),
            after = grouped(within.after)
        );
        facts.push(fact(say!("within tolerance"), sentence));
    }
    if let Some(compensated) = &v.compensated {
        let sentence = say!(
            "{rms} (largest {largest}); not correctable by joint commands {left}",
            rms = length(compensated.gap.rms_mm, detail),
            largest = length(compensated.gap.max_mm, detail),
            left = length(compensated.cannot_be_removed_by_joints_mm, detail)
        );
        facts.push(fact(say!("with corrected commands"), sentence));
    }
    facts
}
