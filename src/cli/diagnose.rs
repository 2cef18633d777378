//! `truepose diagnose`: what is missing, its name, and how sure that is.

use std::fmt::Write as _;
use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::diagnosis::{
    Allowed, DiagnoseError, Diagnosis, Limit, Options, Progress, Sight, Stopped, Verdict, Watch,
};
use crate::fit::{Estimate, IMPLAUSIBLE};
use crate::paper::RegionalStart;
use crate::pipeline;
use crate::present::diagnosis_v1::document;
use crate::present::kinds;
use crate::present::limits;
use crate::present::names::figure;
use crate::present::numbers::significant;
use crate::present::table::Table;
use crate::sessions::Session;

use super::failure::Failure;
use super::identify::Values;
use super::interrupt::Stopping;
use super::progress_line::ProgressLine;
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
        Self::WrongInput(error.to_string())
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
                        return Err(Failure::WrongInput(format!(
                            "{option} is for one session; expected --json-lines, or nothing for a table"
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
        Progress::Checking => "checking for set-up errors".to_owned(),
        Progress::Preparing => "fitting the geometry, preparing the candidates".to_owned(),
        Progress::Searching { found, percent } => {
            let names = if found.is_empty() {
                "nothing found yet".to_owned()
            } else {
                format!("{} found so far: {}", found.len(), found.join(", "))
            };
            format!("searching, {percent} % of the budget: {names}")
        }
        Progress::Comparing => "comparing with other explanations".to_owned(),
        Progress::Planning => "looking for poses to measure next".to_owned(),
    }
}

fn start_in_words(start: &RegionalStart) -> String {
    let mut table =
        Table::headed("region | >Δθ rad | >Δl1 mm | >of one error: Δθ rad | >Δl1 mm | >after mm");
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
    format!("start: {}\n\n{}\n", start.says, table.aligned(0))
}

fn in_words(d: &Diagnosis) -> String {
    let mut text = String::new();
    let _ = writeln!(text, "{}: {} samples", d.session, d.samples);
    for problem in &d.data_problems {
        let _ = writeln!(
            text,
            "data: {}\n  {}\n  {}",
            problem.what, problem.evidence, problem.proposal
        );
    }
    let verdict = match d.verdict {
        Verdict::Noise => "nothing is missing: the remaining error is noise",
        Verdict::Explained => "explained: the remaining error is at the noise floor",
        Verdict::PartlyExplained => "partly explained: something is left that no name explains",
        Verdict::Unexplained => "something is left that no name explains",
    };
    let _ = writeln!(text, "{verdict}");
    if d.stopped == Some(Stopped::Asked) {
        let _ = writeln!(
            text,
            "stopped on request: this is what was proven until then"
        );
    }
    if !d.tested_anything() {
        let _ = writeln!(
            text,
            "but these samples can show no effect, so that says nothing about the robot"
        );
    }
    let _ = writeln!(
        text,
        "RMS error: nominal {:.4} mm, identified {:.4} mm, with found effects {:.4} mm; noise floor {:.4} mm",
        d.gap.start_mm, d.gap.identified_mm, d.gap.end_mm, d.floor.mm
    );
    if let Some(gaps) = &d.held_out.gaps {
        let _ = writeln!(
            text,
            "cross-validated {:.4} mm, {:.4} mm, {:.4} mm ({})",
            gaps.start_mm, gaps.identified_mm, gaps.end_mm, d.held_out.how
        );
    }
    if !d.identification.kinds.is_empty() {
        text += &kinds::table(&d.identification.kinds).aligned(0);
    }
    noise_in_words(&mut text, d);
    let arm = geometry::is_of_an_arm(&d.identified);
    if arm {
        text += &geometry::table(&d.identified);
    }
    for estimate in &d.identified {
        if !(arm && geometry::is_in_table(estimate)) {
            let _ = writeln!(text, "{}", estimate_in_words(estimate));
        }
    }
    found_in_words(&mut text, d, arm);
    for rival in d.equivalent.iter().take(MOST_RIVALS) {
        let _ = writeln!(
            text,
            "or {} instead of {} (odds {:.1} : 1 against): {}",
            rival.instead.join(" + "),
            rival.explanation.join(" + "),
            rival.odds,
            rival.separate_by
        );
    }
    and_more(&mut text, d.equivalent.len(), MOST_RIVALS, "rival");
    unexplained_in_words(&mut text, d);
    limits_in_words(&mut text, d, arm);
    left_out_in_words(&mut text, d);
    if !d.next_poses.is_empty() {
        let _ = writeln!(
            text,
            "{} poses would {}; --json lists them, `truepose plan` makes a measuring list",
            d.next_poses.len(),
            if d.equivalent.is_empty() {
                "make more testable"
            } else {
                "decide"
            }
        );
    }
    text
}

/// The effects that were found, each with its parameters, its evidence and what to check.
fn found_in_words(text: &mut String, d: &Diagnosis, arm: bool) {
    for found in &d.found {
        let joint = found.joint.filter(|_| d.model.robot.joints.len() > 1);
        let place = joint.map_or_else(String::new, |joint| format!(", joint {joint}"));
        let _ = writeln!(text, "found {}{place}", found.effect);
        if arm {
            let parameters = found.parameters.iter().map(|estimate| {
                let says = estimate_in_words(estimate);
                let own = says
                    .strip_prefix(estimate.effect)
                    .map(|rest| rest.trim_start_matches(": "));
                own.unwrap_or(&says).to_owned()
            });
            let parameters = parameters.collect::<Vec<_>>().join("; ");
            let _ = writeln!(text, "  {parameters}");
        } else {
            for estimate in &found.parameters {
                let _ = writeln!(text, "  {}", estimate_in_words(estimate));
            }
        }
        for one in &found.figures {
            let _ = writeln!(text, "  {}", figure(*one));
        }
        let _ = writeln!(text, "  {}\n  check: {}", found.says, found.check);
    }
}

/// What could not be tested and what was not found; of several joints a line for each reason.
fn limits_in_words(text: &mut String, d: &Diagnosis, arm: bool) {
    let plain = |effect: &str| effect.to_owned();
    if arm {
        for line in limits::not_testable(d, plain) {
            let _ = writeln!(text, "{}: not testable, {}", line.names, line.says);
        }
        let lines = limits::limits(d, plain);
        if !lines.is_empty() {
            let _ = writeln!(text, "not found; detection limits (95 %):");
        }
        let (of_joints, others): (Vec<_>, Vec<_>) =
            lines.into_iter().partition(|line| line.of_joints);
        for line in of_joints {
            let _ = writeln!(text, "  {}: {}", line.names, line.says);
        }
        let others = others
            .into_iter()
            .map(|line| format!("{}: {}", line.names, line.says));
        let others = others.collect::<Vec<_>>().join("; ");
        if !others.is_empty() {
            let _ = writeln!(text, "  {others}");
        }
    } else {
        let robot = &d.model.robot;
        for one in d
            .not_testable
            .iter()
            .filter(|one| limits::applies(robot, one))
        {
            let name = named(d, one.effect, one.joint);
            let _ = writeln!(text, "{name}: not testable, {}", one.because);
        }
        for limit in &d.not_found {
            let name = named(d, limit.effect, limit.joint);
            let _ = writeln!(text, "{name}: {}", limit_in_words(limit));
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

/// Says how many are not listed.
fn and_more(text: &mut String, count: usize, listed: usize, what: &str) {
    match count.saturating_sub(listed) {
        0 => {}
        1 => {
            let _ = writeln!(text, "  and 1 {what} more: --json lists it");
        }
        more => {
            let _ = writeln!(text, "  and {more} {what}s more: --json lists them");
        }
    }
}

/// What the samples do not determine, and which of them were not fitted.
fn left_out_in_words(text: &mut String, d: &Diagnosis) {
    let open = &d.identification.not_identifiable;
    let arm = geometry::is_of_an_arm(&d.identified);
    if arm && open.len() > MOST_OPEN {
        let _ = writeln!(
            text,
            "not identifiable: {} combinations of parameters of which the samples show only the sum; one of each is held (– above), the others carry it: --json lists them",
            open.len()
        );
    }
    let listed = if arm && open.len() > MOST_OPEN {
        0
    } else {
        open.len()
    };
    for open in &open[..listed] {
        let _ = writeln!(
            text,
            "not identifiable: {}: {}",
            open.combination, open.because
        );
    }
    if !d.outliers.is_empty() {
        let _ = writeln!(
            text,
            "excluded outliers: {} of {} samples",
            d.outliers.len(),
            d.samples
        );
    }
    if let Some(says) = d.identification.excluded_in_words() {
        let _ = writeln!(text, "{says}");
    }
    for outlier in d.outliers.iter().take(MOST_OUTLIERS) {
        let _ = writeln!(
            text,
            "  sample {}: {:.3} mm from the model",
            outlier.sample + 1,
            outlier.deviation_mm
        );
    }
    and_more(text, d.outliers.len(), MOST_OUTLIERS, "outlier");
}

/// What there is to say of the noise, and of a fit that cannot be relied on.
fn noise_in_words(text: &mut String, d: &Diagnosis) {
    if let Some(noise) = &d.unexplained.noise {
        let _ = writeln!(text, "measurement noise: {}", noise.says());
    }
    if let Some(slow) = &d.noise.slow {
        let _ = writeln!(text, "slow noise: {}", slow.says());
    }
    let quality = &d.identification.quality;
    if !quality.converged {
        let _ = writeln!(text, "the fit did not converge: {}", quality.stopped);
    }
}

/// What no name explains, and its correction where one was asked for.
fn unexplained_in_words(text: &mut String, d: &Diagnosis) {
    if d.unexplained.present {
        let _ = writeln!(
            text,
            "unexplained: {:.4} mm, {}",
            d.unexplained.rms_mm, d.unexplained.says
        );
        if !d.unexplained.resembles.is_empty() {
            let _ = writeln!(text, "  resembles {}", d.unexplained.resembles.join(", "));
        }
    }
    if let Some(unnamed) = &d.unnamed {
        let _ = writeln!(text, "unnamed: {}", unnamed.says());
    }
    text.push_str(&super::levels::expected_in_words(&d.identification));
    match &d.unexplained.correction {
        None => {}
        Some(Ok(correction)) => {
            let _ = writeln!(
                text,
                "added under the name unexplained: {}\n  RMS error {:.4} → {:.4} mm; cross-validated: {}",
                correction.says, correction.gap_mm[0], correction.gap_mm[1], correction.how
            );
        }
        Some(Err(because)) => {
            let _ = writeln!(text, "no smooth correction was added: {because}");
        }
    }
}

/// From which size an effect would have been seen.
fn limit_in_words(limit: &Limit) -> String {
    let (mut above, mut never) = (Vec::new(), Vec::new());
    for (name, size) in &limit.sizes {
        match limits::sight(limit.effect, name, *size) {
            Sight::Above(size) => above.push(format!("{name} {}", significant(size, 3))),
            Sight::AtAnySize => above.push(format!("{name} 0")),
            Sight::AtNoSize => never.push(*name),
        }
    }
    let mut parts = Vec::new();
    let at_any = |(_, size): &(&str, f64)| Sight::of(*size) == Sight::AtAnySize;
    if limit.sizes.iter().all(at_any) {
        parts.push("detection limit 0: there is no noise".to_owned());
    } else if !above.is_empty() {
        parts.push(format!("detection limit {} (95 %)", above.join(", ")));
    }
    if !never.is_empty() {
        parts.push(format!(
            "not observable with these poses: {}",
            never.join(", ")
        ));
    }
    parts.join("; ")
}

fn estimate_in_words(estimate: &Estimate) -> String {
    let Estimate {
        effect,
        name,
        value,
        ..
    } = estimate;
    let mut text = if estimate.is_whole_number() {
        format!("{effect}: {name} {value}")
    } else {
        let interval = estimate.ci95.map_or_else(
            || "not determined".to_owned(),
            |[low, high]| format!("95 % from {low:.6} to {high:.6}"),
        );
        format!("{effect}: {name} {value:.6} ({interval})")
    };
    if estimate.is_implausible() {
        let _ = write!(text, ", {IMPLAUSIBLE}");
    }
    text
}
