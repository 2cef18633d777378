//! A diagnosis: the verdict with its figures, what was found, what is open, what could not be seen.

use super::{Block, Detail, Fact, Section, Topic, cleaned, fact, found, open, sight};
use crate::diagnosis::{Diagnosis, FloorFrom, Stopped, Verdict};
use crate::fit::{Estimate, Identification, Noise};
use crate::language::spoken;
use crate::present::identification_v1::worst_pose;
use crate::present::kinds;
use crate::text::capital;

/// The whole answer, in the order in which it is read.
#[doc(hidden)]
pub fn diagnosis(d: &Diagnosis, detail: Detail) -> Vec<Section> {
    let _speaking = detail.speaking();
    let mut sections = vec![verdict(d, detail)];
    sections.extend(open::data_problems(&d.data_problems));
    sections.extend(found::effects(d, detail));
    sections.extend(open::rivals(d, detail));
    sections.extend(open::unexplained(d, detail));
    sections.extend(open::unnamed(d, detail));
    sections.extend(open::next_poses(d, detail));
    let fit = &d.identification;
    sections.extend(open::not_identifiable(
        &fit.not_identifiable,
        detail,
        open::MOST_COMBINATIONS,
    ));
    sections.extend(open::outliers(fit, detail));
    sections.extend(sight::limits(d, detail));
    sections.extend(sight::not_testable(d, detail));
    sections
}

/// An effect that was found, with these sizes of it: those of the model in use may be others.
#[doc(hidden)]
pub fn found_effect(d: &Diagnosis, detail: Detail, index: usize, sizes: &[Estimate]) -> Section {
    let _speaking = detail.speaking();
    found::effect(d, detail, index, sizes)
}

/// The verdict in a sentence.
pub(crate) fn answer(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Noise => say!("Nothing is missing in the model: the remaining error is noise"),
        Verdict::Explained => say!("Explained: the remaining error is at the noise floor"),
        Verdict::PartlyExplained => {
            say!("Partly explained: an error is left that no effect of the catalogue explains")
        }
        Verdict::Unexplained => {
            say!("Not explained: an error is left that no effect of the catalogue explains")
        }
    }
}

/// What the verdict is to be read with.
pub(crate) fn remarks(d: &Diagnosis) -> Vec<String> {
    let mut remarks = Vec::new();
    if d.stopped == Some(Stopped::Asked) {
        remarks.push(say!("Diagnosis stopped: this is what was proven until then").to_owned());
    }
    if !d.tested_anything() {
        let nothing = say!("the samples can show no effect, so that says nothing about the robot");
        remarks.push(nothing.to_owned());
    }
    if !d.equivalent.is_empty() {
        remarks.push(say!("the samples cannot decide between some names").to_owned());
    }
    if !d.data_problems.is_empty() {
        remarks.push(say!("the data had problems, which are named below").to_owned());
    }
    if !d.identification.quality.converged {
        remarks.push(say!(
            "the fit did not converge: {stopped}",
            stopped = spoken(d.identification.quality.stopped)
        ));
    }
    remarks
}

fn verdict(d: &Diagnosis, detail: Detail) -> Section {
    let mut blocks: Vec<Block> = remarks(d).into_iter().map(Block::Warning).collect();
    blocks.push(Block::Facts(figures(d, detail)));
    if !d.identification.kinds.is_empty() {
        blocks.push(Block::Table(kinds::table(&d.identification.kinds)));
    }
    blocks.extend(expected(&d.identification, detail));
    Section::of(Topic::Answer, answer(d.verdict), blocks)
}

/// Where the noise floor comes from.
pub(crate) fn floor_from(from: FloorFrom) -> &'static str {
    match from {
        FloorFrom::Repeats => say!("from returns to the same pose"),
        FloorFrom::Instrument => say!("from the instrument's noise"),
        FloorFrom::Estimated => say!("estimated from what is left"),
    }
}

/// The errors on the way, with the floor below which no model comes.
fn figures(d: &Diagnosis, detail: Detail) -> Vec<Fact> {
    let held_out = d.held_out.gaps;
    let error = |fitted: f64, held_out: Option<f64>| match held_out {
        None => detail.length(fitted),
        Some(unseen) => say!(
            "{fitted}; cross-validated {unseen}",
            fitted = detail.length(fitted),
            unseen = detail.length(unseen)
        ),
    };
    let identified = held_out.map(|gaps| gaps.identified_mm);
    let end = held_out.map(|gaps| gaps.end_mm);
    let mut facts = vec![
        fact(
            say!("RMS error, nominal robot"),
            detail.length(d.gap.start_mm),
        ),
        fact(
            say!("RMS error, identified"),
            error(d.gap.identified_mm, identified),
        ),
    ];
    if !d.found.is_empty() || d.unnamed.is_some() {
        let with = say!("RMS error, with what was found");
        facts.push(fact(with, error(d.gap.end_mm, end)));
    }
    let floor = format!(
        "{}, {}",
        detail.length(d.floor.mm),
        floor_from(d.floor.from)
    );
    facts.push(fact(capital(say!("noise floor")), floor));
    facts.extend(noise(d));
    facts.push(fact(say!("Cross-validation"), cleaned(&d.held_out.how)));
    facts
}

/// What there is to say of the noise.
pub(crate) fn noise(d: &Diagnosis) -> Vec<Fact> {
    let stated = d.unexplained.noise.as_ref();
    let stated = stated.map(|noise| spoken(noise.describe()));
    let slow = d.noise.slow.as_ref().map(|slow| spoken(slow.describe()));
    noise_facts(stated, &d.noise, slow)
}

/// What there is to say of the noise against the stated one, of the robot and of what drifts.
pub(super) fn noise_facts(
    stated: Option<String>,
    noise: &Noise,
    slow: Option<String>,
) -> Vec<Fact> {
    let all = [
        (say!("Measurement noise"), stated),
        (
            say!("Repeatability of the robot"),
            noise.describe_robot().map(spoken),
        ),
        (say!("Slow noise"), slow),
    ];
    let all = all.into_iter();
    all.filter_map(|(name, says)| Some(fact(name, says?)))
        .collect()
}

/// The error that the model is expected to make over the joint ranges, where that is known; and where the
/// measured poses show little.
pub(crate) fn expected(answer: &Identification, detail: Detail) -> Vec<Block> {
    let Some(e) = &answer.expected else {
        return Vec::new();
    };
    let says = say!(
        "RMS {rms}, largest {largest}; at the measured poses {measured}",
        rms = detail.length(e.rms_mm),
        largest = detail.length(e.max_mm),
        measured = detail.length(e.measured_rms_mm)
    );
    let expected = say!("Expected error of the model over the joint ranges");
    let mut blocks = vec![Block::Facts(vec![fact(expected, says)])];
    if e.extrapolates() {
        let q = worst_pose(e, &answer.model.robot);
        let q: Vec<String> = q.iter().map(|v| format!("{v:.0}")).collect();
        let q = q.join(", ");
        blocks.push(Block::Warning(say!(
            "Poorly observed: the measured poses show little of the joint ranges; measure near {q} as well",
            q
        )));
    }
    blocks
}
