//! `truepose diagnose`: what is missing, its name, and how sure that is.

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::diagnosis::{
    Allowed, DiagnoseError, Diagnosis, Limit, Options, Progress, Sight, Stopped, Verdict, Watch,
};
use crate::fit::{Estimate, IMPLAUSIBLE, NotIdentifiable};
use crate::language::names::{combination, figure};
use crate::language::of_core;
use crate::paper::RegionalStart;
use crate::pipeline;
use crate::present::diagnosis_v1::document;
use crate::present::kinds;
use crate::present::limits;
use crate::present::numbers::significant;
use crate::present::table::Table;
use crate::sessions::Session;
use crate::set_up_errors::DataProblem;

use super::failure::Failure;
use super::identify::Values;
use super::interrupt::Stopping;
use super::progress_line::ProgressLine;
use super::words::{effect, effect_with_id, effects, line, of_core_table, parameter, value};
use super::{fleet, geometry, output};

/// Rivals, outliers and combinations that are listed; an answer about an arm fits on a page.
const MOST_RIVALS: usize = 6;
const MOST_OUTLIERS: usize = 8;
const MOST_OPEN: usize = 2;

/// Find what is missing in the model of a session, name it, and prove it on unseen samples
#[derive(Debug, Args)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a flag of the command line"
)]
pub(crate) struct Diagnose {
    /// Session to diagnose; several, or a folder of them, give a line each
    #[arg(required = true, value_name = "SESSION")]
    sessions: Vec<PathBuf>,
    /// An effect that does not exist for this run; may be given several times
    #[arg(long, value_name = "ID", value_delimiter = ',')]
    without: Vec<String>,
    /// Only these effects are candidates, separated by commas
    #[arg(long, value_name = "ID", value_delimiter = ',')]
    only: Option<Vec<String>>,
    /// Most effects to add [default: a tenth of the number of samples]
    #[arg(long, value_name = "N")]
    max_effects: Option<usize>,
    /// Share of the samples to lock away from everything, such as 0.25 [default: cross-fitted]
    #[arg(long, value_name = "FRACTION", allow_negative_numbers = true)]
    held_out: Option<f64>,
    /// Seed of the simulated noise; names do not depend on it
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Joint values to start from
    #[arg(long, value_enum, default_value = "commanded")]
    joint_values: Values,
    /// Start from the exact model, or show what the paper's regional model misses
    #[arg(long, value_enum, default_value = "exact")]
    start: Start,
    /// Correct what no name explains by a smooth curve over the joint, if that helps on unseen samples
    #[arg(long)]
    correct_unexplained: bool,
    /// Keep the model to geometry and names, without what predicts unseen poses and has no name
    #[arg(long)]
    no_unnamed: bool,
    /// Write the model with what was found to this file; - is standard output
    #[arg(long, value_name = "MODEL")]
    out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Print one line of JSON for each session: its file, then the answer, or why there is none
    #[arg(long, conflicts_with = "json")]
    json_lines: bool,
    /// How many of several sessions are diagnosed at the same time [default: the number of cores]
    #[arg(long, value_name = "N")]
    jobs: Option<NonZeroUsize>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Start {
    /// One model for the whole range
    Exact,
    /// The paper's constant corrections by region
    Regional,
}

impl From<DiagnoseError> for Failure {
    fn from(error: DiagnoseError) -> Self {
        match error {
            DiagnoseError::Rejected(rejected) => rejected.into(),
            other => Self::refused(&other),
        }
    }
}

/// What is asked of each session.
pub(crate) struct Asked {
    options: Options,
    start: Start,
}

impl Asked {
    /// The diagnosis of a session, and the regional model that it started from where asked for.
    pub(crate) fn of(
        &self,
        session: &Session,
        watch: Watch,
    ) -> Result<(Diagnosis, Option<RegionalStart>), Failure> {
        let answer = pipeline::diagnose(session, &self.options, watch)?;
        let values = self.options.joint_values;
        let start = match self.start {
            Start::Exact => None,
            Start::Regional => Some(pipeline::regional_start(session, &answer, values)?),
        };
        Ok((answer, start))
    }
}

impl Diagnose {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = output::is_standard_output(self.out.as_deref());
        output::one_use_of_standard_output(self.json, to_stdout, "--json", "--out -")?;
        // Of several sessions each has its line: an interrupt ends them.
        let one_session =
            self.sessions.len() == 1 && !self.json_lines && !self.sessions[0].is_dir();
        let asked = Asked {
            options: Options {
                allowed: Allowed {
                    without: self.without,
                    only: self.only,
                },
                max_effects: self.max_effects,
                held_out: self.held_out,
                seed: self.seed,
                joint_values: self.joint_values.into(),
                correct_unexplained: self.correct_unexplained,
                keep_when_stopped: one_session,
                without_unnamed: self.no_unnamed,
            },
            start: self.start,
        };
        let one = match &self.sessions[..] {
            [session] if !self.json_lines && !session.is_dir() => session,
            sessions => {
                for (given, option) in [(self.json, "--json"), (self.out.is_some(), "--out")] {
                    if given {
                        return Err(Failure::WrongInput(text!(
                            "{option} is for one session; expected --json-lines, or nothing for a table",
                            option = option
                        )));
                    }
                }
                return fleet::run(sessions, &asked, self.jobs, self.json_lines);
            }
        };
        let loaded = output::session(one)?;
        let session = &loaded.session;
        let (answer, start) = answer_of(&asked, session)?;
        if let Some(out) = &self.out {
            let verified = pipeline::hand_out(&answer.calibration(session), session)?;
            let text = pipeline::write_model(&verified);
            output::document(out, text.as_bytes(), self.force, &loaded.files)?;
        }
        if self.json {
            output::json(&document(&answer, session, start.as_ref()))
        } else if to_stdout {
            Ok(())
        } else {
            let start = start.map_or_else(String::new, |s| start_in_words(&s));
            output::text(&(start + &in_words(&answer)))
        }
    }
}

/// The answer about one session; at an interrupt what is proven until then.
fn answer_of(
    asked: &Asked,
    session: &Session,
) -> Result<(Diagnosis, Option<RegionalStart>), Failure> {
    let stopping = Stopping::at_interrupt();
    let line = ProgressLine::new();
    asked.of(session, &|progress| {
        line.says(&doing(progress));
        !stopping.is_asked()
    })
}

/// What is being done, and how far it is.
fn doing(progress: &Progress) -> String {
    match progress {
        Progress::Checking => say!("checking for set-up errors").to_owned(),
        Progress::Preparing => say!("fitting the geometry, preparing the candidates").to_owned(),
        Progress::Searching { found, percent } => {
            let names = if found.is_empty() {
                say!("nothing found yet").to_owned()
            } else {
                say!(
                    "{count} found so far: {names}",
                    count = found.len(),
                    names = effects(found, ", ")
                )
            };
            say!(
                "searching, {percent} % of the budget: {names}",
                percent = percent,
                names = names
            )
        }
        Progress::Comparing => say!("comparing with other explanations").to_owned(),
        Progress::Planning => say!("looking for poses to measure next").to_owned(),
    }
}

fn start_in_words(start: &RegionalStart) -> String {
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

fn in_words(d: &Diagnosis) -> String {
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
    limits_in_words(&mut text, d, arm);
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

/// What could not be tested and what was not found; of several joints a line for each reason.
fn limits_in_words(text: &mut String, d: &Diagnosis, arm: bool) {
    let not_testable = |name: &str, because: &str| {
        say!(
            "{effect}: not testable, {because}",
            effect = name,
            because = of_core(because)
        )
    };
    let plain = |name: &str| effect(name).into_owned();
    if arm {
        for one in limits::not_testable(d, plain) {
            line(text, not_testable(&of_core(&one.names), &one.says));
        }
        let lines = limits::limits(d, plain);
        if !lines.is_empty() {
            line(text, say!("not found; detection limits (95 %):"));
        }
        let (of_joints, others): (Vec<_>, Vec<_>) =
            lines.into_iter().partition(|line| line.of_joints);
        let says = |one: limits::Line| format!("{}: {}", one.names, one.says);
        for one in of_joints {
            line(text, format!("  {}", says(one)));
        }
        let others = others.into_iter().map(says);
        let others = others.collect::<Vec<_>>().join("; ");
        if !others.is_empty() {
            line(text, format!("  {others}"));
        }
    } else {
        let robot = &d.model.robot;
        for one in d
            .not_testable
            .iter()
            .filter(|one| limits::applies(robot, one))
        {
            let name = named(d, one.effect, one.joint);
            line(text, not_testable(&effect(&name), &one.because));
        }
        for limit in &d.not_found {
            let name = named(d, limit.effect, limit.joint);
            line(
                text,
                format!("{}: {}", effect(&name), limit_in_words(limit)),
            );
        }
    }
}

/// A name, of several joints with its joint, which counts from 0 here and from 1 in what is said.
pub(crate) fn named(d: &Diagnosis, effect: &str, joint: Option<usize>) -> String {
    match joint.filter(|_| d.model.robot.joints.len() > 1) {
        Some(joint) => format!("{effect} {}", joint + 1),
        None => effect.to_owned(),
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
            stopped = of_core(&quality.stopped.to_string())
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
                because = of_core(&because.to_string())
            );
            line(text, none);
        }
    }
}

/// From which size an effect would have been seen.
fn limit_in_words(limit: &Limit) -> String {
    let (mut above, mut never) = (Vec::new(), Vec::new());
    for (name, size) in &limit.sizes {
        match limits::sight(limit.effect, name, *size) {
            Sight::Above(size) => above.push(value(name, &significant(size, 3))),
            Sight::AtAnySize => above.push(value(name, "0")),
            Sight::AtNoSize => never.push(parameter(name)),
        }
    }
    let mut parts = Vec::new();
    let at_any = |(_, size): &(&str, f64)| Sight::of(*size) == Sight::AtAnySize;
    if limit.sizes.iter().all(at_any) {
        parts.push(say!("detection limit 0: there is no noise").to_owned());
    } else if !above.is_empty() {
        parts.push(say!(
            "detection limit {sizes} (95 %)",
            sizes = above.join(", ")
        ));
    }
    if !never.is_empty() {
        parts.push(say!(
            "not observable with these poses: {which}",
            which = never.join(", ")
        ));
    }
    parts.join("; ")
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
    if estimate.is_implausible() {
        text += &format!(", {}", of_core(IMPLAUSIBLE));
    }
    text
}
