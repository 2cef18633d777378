//! The answer of `truepose diagnose` in words.

use crate::diagnosis::{Diagnosis, Stopped, Verdict};
use crate::fit::{Estimate, NotIdentifiable};
use crate::language::names::figure;
use crate::language::{of_core, spoken};
use crate::paper::RegionalStart;
use crate::present::kinds;
use crate::present::table::Table;
use crate::set_up_errors::DataProblem;

use super::words::{combination, effect, effect_with_id, effects, line, of_core_table, value};
use super::{geometry, undetected};

/// Rivals, outliers and combinations that are listed; an answer about an arm fits on a page.
const MOST_RIVALS: usize = 6;
const MOST_OUTLIERS: usize = 8;
const MOST_OPEN: usize = 2;

/// The regional model that a diagnosis was begun with.
pub(super) fn start_in_words(start: &RegionalStart) -> String {
    let mut table = Table::headed(say!(
        "region | >Δθ rad | >Δl1 mm | >of one error: Δθ rad | >Δl1 mm | >after mm"
    ));
    for (region, (theta, l1)) in start.regional.regions.iter().zip(&start.of_one_error) {
        let c = &region.correction;
        let seven = |value: f64| format!("{value:.7}");
        table.row([
            c.name.clone(),
            seven(c.theta_rad),
            seven(c.l1_mm),
            seven(*theta),
            seven(*l1),
            format!("{:.4}", region.rms_after_mm),
        ]);
    }
    let start = say!("start: {start}", start = of_core(&start.says));
    format!("{start}\n\n{}\n", table.aligned(0))
}

/// The answer.
pub(super) fn in_words(d: &Diagnosis) -> String {
    let mut text = String::new();
    let samples = say!(
        "{session}: {samples} samples",
        session = d.session,
        samples = d.samples
    );
    line(&mut text, samples);
    for problem in &d.data_problems {
        line(&mut text, data_problem(problem));
    }
    let verdict = match d.verdict {
        Verdict::Noise => say!("nothing is missing: the remaining error is noise"),
        Verdict::Explained => say!("explained: the remaining error is at the noise floor"),
        Verdict::PartlyExplained => {
            say!("partly explained: something is left that no name explains")
        }
        Verdict::Unexplained => say!("something is left that no name explains"),
    };
    line(&mut text, verdict);
    if d.stopped == Some(Stopped::Asked) {
        let stopped = say!("stopped on request: this is what was proven until then");
        line(&mut text, stopped);
    }
    if !d.tested_anything() {
        let nothing =
            say!("but these samples can show no effect, so that says nothing about the robot");
        line(&mut text, nothing);
    }
    errors_in_words(&mut text, d);
    if !d.identification.kinds.is_empty() {
        text += &of_core_table(kinds::table(&d.identification.kinds), 0).aligned(0);
    }
    noise_in_words(&mut text, d);
    let arm = geometry::is_of_an_arm(&d.identified);
    if arm {
        text += &geometry::table(&d.identified);
    }
    for estimate in &d.identified {
        if !(arm && geometry::is_in_table(estimate)) {
            line(&mut text, estimate_in_words(estimate));
        }
    }
    found_in_words(&mut text, d, arm);
    for rival in d.equivalent.iter().take(MOST_RIVALS) {
        let rival = say!(
            "or {instead} instead of {explanation} (odds {odds} : 1 against): {separate_by}",
            instead = effects(&rival.instead, " + "),
            explanation = effects(&rival.explanation, " + "),
            odds = format!("{:.1}", rival.odds),
            separate_by = of_core(&rival.separate_by)
        );
        line(&mut text, rival);
    }
    match d.equivalent.len().saturating_sub(MOST_RIVALS) {
        0 => {}
        more => {
            let more = say!(one "and {count} rival more: --json lists it", "and {count} rivals more: --json lists them", count = more);
            line(&mut text, format!("  {more}"));
        }
    }
    unexplained_in_words(&mut text, d);
    undetected::in_words(&mut text, d, arm);
    left_out_in_words(&mut text, d);
    let poses = d.next_poses.len();
    if poses > 0 && d.equivalent.is_empty() {
        let poses = say!(
            "{poses} poses would make more testable; --json lists them, `truepose plan` makes a measuring list",
            poses = poses
        );
        line(&mut text, poses);
    } else if poses > 0 {
        let poses = say!(
            "{poses} poses would decide; --json lists them, `truepose plan` makes a measuring list",
            poses = poses
        );
        line(&mut text, poses);
    }
    text
}

/// A problem of the data: what it is, what shows it, what to do.
pub(super) fn data_problem(problem: &DataProblem) -> String {
    let what = say!("data: {what}", what = of_core(&problem.what));
    let evidence = of_core(&problem.evidence);
    format!("{what}\n  {evidence}\n  {}", of_core(&problem.proposal))
}

fn errors_in_words(text: &mut String, d: &Diagnosis) {
    let four = |mm: f64| format!("{mm:.4}");
    let errors = say!(
        "RMS error: nominal {nominal} mm, identified {identified} mm, with found effects {found} mm; noise floor {floor} mm",
        nominal = four(d.gap.start_mm),
        identified = four(d.gap.identified_mm),
        found = four(d.gap.end_mm),
        floor = four(d.floor.mm)
    );
    line(text, errors);
    if let Some(gaps) = &d.held_out.gaps {
        let errors = say!(
            "cross-validated {nominal} mm, {identified} mm, {found} mm ({how})",
            nominal = four(gaps.start_mm),
            identified = four(gaps.identified_mm),
            found = four(gaps.end_mm),
            how = of_core(&d.held_out.how)
        );
        line(text, errors);
    }
}

/// The effects that were found, each with its parameters, its evidence and what to check.
fn found_in_words(text: &mut String, d: &Diagnosis, arm: bool) {
    for found in &d.found {
        let joint = found.joint.filter(|_| d.model.robot.joints.len() > 1);
        let name = effect_with_id(found.effect);
        let found_line = match joint {
            Some(joint) => say!(
                "found {effect}, joint {joint}",
                effect = name,
                joint = joint
            ),
            None => say!("found {effect}", effect = name),
        };
        line(text, found_line);
        if arm {
            let parameters = found.parameters.iter().map(value_in_words);
            let parameters = parameters.collect::<Vec<_>>().join("; ");
            line(text, format!("  {parameters}"));
        } else {
            for estimate in &found.parameters {
                line(text, format!("  {}", estimate_in_words(estimate)));
            }
        }
        for one in &found.figures {
            line(text, format!("  {}", figure(*one)));
        }
        line(text, format!("  {}", of_core(&found.says)));
        let check = say!("check: {check}", check = of_core(found.check));
        line(text, format!("  {check}"));
    }
}

/// What the samples do not determine, and which of them were not fitted.
fn left_out_in_words(text: &mut String, d: &Diagnosis) {
    let open = &d.identification.not_identifiable;
    let arm = geometry::is_of_an_arm(&d.identified);
    if arm && open.len() > MOST_OPEN {
        let open = say!(
            "not identifiable: {combinations} combinations of parameters of which the samples show only the sum; one of each is held (– above), the others carry it: --json lists them",
            combinations = open.len()
        );
        line(text, open);
    } else {
        for open in open {
            line(text, not_identifiable(open));
        }
    }
    if !d.outliers.is_empty() {
        line(text, excluded_outliers(d.outliers.len(), d.samples));
    }
    if let Some(says) = d.identification.excluded_in_words() {
        line(text, of_core(&says));
    }
    for outlier in d.outliers.iter().take(MOST_OUTLIERS) {
        let outlier = say!(
            "sample {sample}: {deviation} mm from the model",
            sample = outlier.sample + 1,
            deviation = format!("{:.3}", outlier.deviation_mm)
        );
        line(text, format!("  {outlier}"));
    }
    match d.outliers.len().saturating_sub(MOST_OUTLIERS) {
        0 => {}
        more => {
            let more = say!(one "and {count} outlier more: --json lists it", "and {count} outliers more: --json lists them", count = more);
            line(text, format!("  {more}"));
        }
    }
}

/// What the samples do not determine.
pub(super) fn not_identifiable(open: &NotIdentifiable) -> String {
    say!(
        "not identifiable: {combination}: {because}",
        combination = combination(&open.combination),
        because = of_core(&open.because)
    )
}

/// How many samples count as outliers.
pub(super) fn excluded_outliers(excluded: usize, all: usize) -> String {
    say!(
        "excluded outliers: {excluded} of {all} samples",
        excluded = excluded,
        all = all
    )
}

/// What there is to say of the noise, and of a fit that cannot be relied on.
fn noise_in_words(text: &mut String, d: &Diagnosis) {
    if let Some(noise) = &d.unexplained.noise {
        line(
            text,
            say!("measurement noise: {noise}", noise = of_core(&noise.says())),
        );
    }
    if let Some(slow) = &d.noise.slow {
        line(
            text,
            say!("slow noise: {slow}", slow = of_core(&slow.says())),
        );
    }
    let quality = &d.identification.quality;
    if !quality.converged {
        let stopped = say!(
            "the fit did not converge: {stopped}",
            stopped = of_core(quality.stopped)
        );
        line(text, stopped);
    }
}

/// What no name explains, and its correction where one was asked for.
fn unexplained_in_words(text: &mut String, d: &Diagnosis) {
    if d.unexplained.present {
        let unexplained = say!(
            "unexplained: {rms} mm, {says}",
            rms = format!("{:.4}", d.unexplained.rms_mm),
            says = of_core(&d.unexplained.says)
        );
        line(text, unexplained);
        if !d.unexplained.resembles.is_empty() {
            let resembles = say!(
                "resembles {effects}",
                effects = effects(&d.unexplained.resembles, ", ")
            );
            line(text, format!("  {resembles}"));
        }
    }
    if let Some(unnamed) = &d.unnamed {
        let unnamed = say!("unnamed: {says}", says = of_core(&unnamed.says()));
        line(text, unnamed);
    }
    text.push_str(&super::levels::expected_in_words(&d.identification));
    match &d.unexplained.correction {
        None => {}
        Some(Ok(correction)) => {
            let added = say!(
                "added under the name unexplained: {says}",
                says = of_core(&correction.says)
            );
            line(text, added);
            let error = say!(
                "RMS error {before} → {after} mm; cross-validated: {how}",
                before = format!("{:.4}", correction.gap_mm[0]),
                after = format!("{:.4}", correction.gap_mm[1]),
                how = of_core(&correction.how)
            );
            line(text, format!("  {error}"));
        }
        Some(Err(because)) => {
            let none = say!(
                "no smooth correction was added: {because}",
                because = of_core(because)
            );
            line(text, none);
        }
    }
}

fn estimate_in_words(estimate: &Estimate) -> String {
    format!("{}: {}", effect(estimate.effect), value_in_words(estimate))
}

/// A parameter with its value and interval.
fn value_in_words(estimate: &Estimate) -> String {
    let mut text = if estimate.is_whole_number() {
        value(estimate.name, &estimate.value.to_string())
    } else {
        let interval = estimate.ci95.map_or_else(
            || say!("not determined").to_owned(),
            |[low, high]| {
                say!(
                    "95 % from {from} to {to}",
                    from = format!("{low:.6}"),
                    to = format!("{high:.6}")
                )
            },
        );
        let value = value(estimate.name, &format!("{:.6}", estimate.value));
        format!("{value} ({interval})")
    };
    if let Some(says) = estimate.implausible() {
        text += &format!(", {}", spoken(&says));
    }
    text
}
