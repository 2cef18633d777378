//! `truepose diagnose`: what is missing, its name, and how sure that is.

use std::path::PathBuf;

use clap::Args;

use crate::diagnosis::{Allowed, Diagnosis, Options, Progress};
use crate::paper::RegionalStart;
use crate::present::diagnosis_v1::document;
use crate::sessions::Session;

use super::asked::{IdentificationTask, Start};
use super::diagnosed::{in_words, start_in_words};
use super::failure::Failure;
use super::identify::Values;
use super::interrupt::Stopping;
use super::output;
use super::progress_line::ProgressLine;
use super::words::effects;

/// Find what is missing in the model of a session, name it, and prove it on unseen samples
#[derive(Debug, Args)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a flag of the command line"
)]
pub(crate) struct Diagnose {
    /// Session to diagnose
    session: PathBuf,
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
    /// Seed of what is drawn where poses are proposed; names do not depend on it
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Joint values to start from
    #[arg(long, value_enum, default_value = "commanded")]
    joint_values: Values,
    /// Start from the exact model, or show what the paper's regional model misses
    #[arg(long, value_enum, default_value = "exact")]
    start: Start,
    /// Accepted and without effect: what repeats and has no name is in the model
    #[arg(long, hide = true)]
    correct_unexplained: bool,
    /// Keep the model to geometry and names, without what repeats or predicts unseen poses and has no name
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
}

impl Diagnose {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = output::is_standard_output(self.out.as_deref());
        output::one_use_of_standard_output(self.json, to_stdout, "--json", "--out -")?;
        let asked = IdentificationTask {
            options: Options {
                allowed: Allowed {
                    without: self.without,
                    only: self.only,
                },
                max_effects: self.max_effects,
                held_out: self.held_out,
                seed: self.seed,
                joint_values: self.joint_values.into(),
                keep_when_stopped: true,
                without_unnamed: self.no_unnamed,
                threads: None,
            },
            start: self.start,
        };
        let loaded = output::session(&self.session)?;
        let session = &loaded.session;
        let (answer, start) = answer_of(&asked, session)?;
        let calibration = || answer.calibration(session);
        let not_handed_out = output::model(self.out.as_deref(), calibration, &loaded, self.force)?;
        if self.json {
            output::json(&document(&answer, session, start.as_ref()))?;
        } else if !to_stdout {
            let start = start.map_or_else(String::new, |s| start_in_words(&s));
            output::text(&(start + &in_words(&answer)))?;
        }
        not_handed_out.map_or(Ok(()), |why| Err(why.into()))
    }
}

/// The answer about one session; at an interrupt what is proven until then.
fn answer_of(
    asked: &IdentificationTask,
    session: &Session,
) -> Result<(Diagnosis, Option<RegionalStart>), Failure> {
    let stopping = Stopping::at_interrupt();
    let line = ProgressLine::new();
    asked.of(session, &|progress| {
        line.describe(&doing(progress));
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
                percent,
                names
            )
        }
        Progress::Comparing => say!("comparing with other explanations").to_owned(),
        Progress::Planning => say!("looking for poses to measure next").to_owned(),
    }
}
