//! `truepose simulate`: from a scenario, or from a robot and a few options, to a session.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use serde_json::json;

use crate::diagnostic::Rejected;
use crate::pipeline::{load_scenario, parse_scenario, save, simulate, write_inline};
use crate::sessions::{Replacing, samples_path};
use crate::simulation::{LoadedScenario, SimulateError, unwatched};

use super::failure::Failure;
use super::output;
use super::requested::Requested;

/// Make a session by simulation, from a scenario or of a robot with hidden effects
#[derive(Debug, Args)]
pub(crate) struct Simulate {
    /// Scenario to play
    #[arg(required_unless_present = "robot", conflicts_with = "robot")]
    scenario: Option<PathBuf>,
    /// Robot to simulate instead of a scenario: a robot file, or a name that `truepose robots` lists; the
    /// scenario is written beside the session
    #[arg(long, value_name = "ROBOT")]
    robot: Option<PathBuf>,
    #[command(flatten)]
    requested: Requested,
    /// Write the session to this file, its samples to a CSV file beside it; - is standard output
    #[arg(long, value_name = "SESSION")]
    out: PathBuf,
    /// Seed of everything random [default: the scenario's]
    #[arg(long)]
    seed: Option<u64>,
    /// Write what was hidden in the session to this file
    #[arg(long, value_name = "TRUTH")]
    truth: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
    /// Print one JSON document that says what was written
    #[arg(long)]
    json: bool,
}

impl Simulate {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = self.out.as_os_str() == "-";
        let truth_to_stdout = self.truth.as_ref().is_some_and(|t| t.as_os_str() == "-");
        output::one_use_of_standard_output(to_stdout, truth_to_stdout, "--out -", "--truth -")?;
        output::one_use_of_standard_output(to_stdout, self.json, "--out -", "--json")?;
        output::one_use_of_standard_output(truth_to_stdout, self.json, "--truth -", "--json")?;
        let (loaded, document) = self.loaded()?;
        output::findings(&loaded.findings);
        // What was simulated of a robot is kept beside the session.
        let beside = document.filter(|_| !to_stdout).map(|document| {
            let path = self.out.with_extension("scenario.json");
            (path, document)
        });
        if let Some((path, _)) = &beside {
            output::can_be_written(path, self.force)?;
        }
        let scenario = loaded.scenario;
        let seed = self.seed.unwrap_or(scenario.seed);
        let (session, truth) = match simulate(&scenario, seed, unwatched) {
            Ok(made) => made,
            Err(SimulateError::Rejected(rejected)) => return Err(rejected.into()),
            Err(error @ SimulateError::Stopped) => return Err(Failure::Failed(error.into())),
        };
        let inputs = output::paths(&loaded.files);
        if let Some(path) = &self.truth {
            // Nothing may be written when something cannot be.
            if !to_stdout {
                let samples = samples_path(&self.out);
                for other in [self.out.as_path(), samples.as_path()] {
                    crate::atomic::refuse_one_file_for_two(path, other)?;
                }
            }
            if let Some((scenario, _)) = &beside {
                crate::atomic::refuse_one_file_for_two(path, scenario)?;
            }
            if !truth_to_stdout {
                output::can_be_written(path, self.force)?;
            }
        }
        let mut samples_file = None;
        if to_stdout {
            let mut stdout = std::io::stdout().lock();
            write_inline(&session, &mut stdout)
                .context(text!("cannot write to standard output"))?;
        } else {
            let replacing = Replacing {
                force: self.force,
                inputs: &inputs,
            };
            samples_file = Some(save(&session, &self.out, replacing)?);
        }
        if let Some((path, document)) = &beside {
            output::document(path, document.as_bytes(), self.force, &loaded.files)?;
        }
        if let Some(path) = &self.truth {
            output::document(path, truth.to_json().as_bytes(), self.force, &loaded.files)?;
        }
        if self.json {
            return output::json(&json!({
                "format": "truepose-simulated/1",
                "session": session.name,
                "file": self.out,
                "samples_file": samples_file,
                "scenario": beside.as_ref().map(|(path, _)| path).or(self.scenario.as_ref()),
                "samples": session.samples.len(),
                "seed": seed,
                "truth": self.truth,
            }));
        }
        Ok(())
    }

    /// The scenario, and its document where no file holds it.
    fn loaded(&self) -> Result<(LoadedScenario, Option<String>), Failure> {
        let Some(name) = &self.robot else {
            let scenario = self.scenario.as_deref().unwrap_or(Path::new(""));
            return Ok((load_scenario(scenario)?, None));
        };
        let (robot, of_library) = output::robot_and_origin(name)?;
        let payload_kg = of_library.and_then(|own| own.payload_kg);
        let request = self.requested.of(robot, payload_kg, self.seed)?;
        let document = request.scenario();
        let mut loaded = parse_scenario(document.as_bytes()).map_err(without_lines)?;
        if of_library.is_none() {
            loaded.files.push(name.clone());
        }
        Ok((loaded, Some(document)))
    }
}

/// What is wrong with a scenario that the options made: there is no text of it whose lines could be looked at.
fn without_lines(mut rejected: Rejected) -> Rejected {
    for finding in &mut rejected.diagnostics {
        (finding.place.line, finding.place.column) = (None, None);
    }
    rejected
}
