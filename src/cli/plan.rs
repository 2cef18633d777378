//! `truepose plan`: what to measure next, or first.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use nalgebra::Point3;
use serde::Deserialize;
use serde::de::IgnoredAny;

use crate::design::PlanOptions;
use crate::diagnosis::Options;
use crate::explain::{self, Detail};
use crate::pipeline::{self, measuring_list, measuring_program};
use crate::present::plan_v1::document;
use crate::programs::language_of;

use super::failure::Failure;
use super::{blocks, output};

/// Say what to measure: poses that decide what a session leaves open and unlock what it cannot
/// show, or a first measurement of a robot
#[derive(Debug, Args)]
pub(crate) struct Plan {
    /// Session that was measured, or the robot alone (a session's `robot` object in a file, or a name that
    /// `truepose robots` lists)
    #[arg(value_name = "SESSION|ROBOT")]
    input: PathBuf,
    /// Number of poses; with --separate and a session at most so many [default: as many as are
    /// needed; 60 for a robot with one joint]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    poses: Option<usize>,
    /// Two effects to tell apart, such as backlash,tracking-lag; ID:JOINT for another joint than 1
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    separate: Vec<String>,
    /// Noise of the instrument on every axis, mm [default: the session's; 0.03 for a robot]
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    sigma: Option<f64>,
    /// Heaviest load that the robot may carry for a test, kg [default: the session's, else 3]
    #[arg(long, value_name = "KG", allow_negative_numbers = true)]
    load: Option<f64>,
    /// The test cube of ISO 9283 instead, with its poses and paths
    #[arg(long, conflicts_with_all = ["poses", "separate", "sigma", "load", "accuracy", "instrument", "cone"])]
    iso9283: bool,
    /// As many poses as bring the expected error of the model of a robot with several joints below this
    /// at 95 % of the places within the joint ranges, mm
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    accuracy: Option<f64>,
    /// Where the instrument stands that is to measure a robot with several joints, in its base frame, mm:
    /// targets in the robot's shadow are left out [default: a session's own place, if it states one]
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    instrument: Option<Vec<f64>>,
    /// A target is seen from within this angle of where it faces, away from the tool's origin [default:
    /// from everywhere]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    cone: Option<f64>,
    /// Seed of everything random
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Write the poses to this file: a table with the column names of a session, or a program of joint
    /// moves that stops at each; - is standard output
    #[arg(long, value_name = "POSES.csv")]
    out: Option<PathBuf>,
    /// What to write [default: by the file's ending, else csv]
    #[arg(long = "as", value_name = "LANGUAGE", value_parser = PossibleValuesParser::new(["csv", "rapid", "krl", "urscript"]))]
    language: Option<String>,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
    /// Print JSON (truepose-plan/1)
    #[arg(long)]
    json: bool,
}

impl Plan {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = output::is_standard_output(self.out.as_deref());
        output::one_use_of_standard_output(self.json, to_stdout, "--json", "--out -")?;
        if self.iso9283 {
            let session = is_a_session(&self.input);
            let out = self.out.as_deref().map(|out| (out, self.force));
            return super::test_cube::run(&self.input, session, out, self.json);
        }
        let separate = match &self.separate[..] {
            [] => None,
            [a, b] => Some([a.clone(), b.clone()]),
            other => {
                return Err(Failure::WrongInput(text!(
                    one "--separate names {count} effect; expected two, such as backlash,tracking-lag", "--separate names {count} effects; expected two, such as backlash,tracking-lag",
                    count = other.len()
                )));
            }
        };
        let options = PlanOptions {
            poses: self.poses,
            separate,
            sigma_mm: self.sigma,
            load_kg: self.load,
            accuracy_mm: self.accuracy,
            instrument_mm: self.instrument.as_deref().map(place).transpose()?,
            cone_rad: self.cone.map(f64::to_radians),
            diagnosis: Options {
                seed: self.seed,
                ..Options::default()
            },
        };
        let (plan, files) = if is_a_session(&self.input) {
            let loaded = output::session(&self.input)?;
            let plan = pipeline::plan_session(&loaded.session, &options, &|_| true)?;
            (plan, loaded.files)
        } else {
            let robot = output::robot(&self.input)?;
            let plan = pipeline::plan_robot(&robot, &options)?;
            (plan, vec![self.input.clone()])
        };
        if let Some(out) = &self.out {
            let list = match self.language(out) {
                "csv" => measuring_list(&plan.poses, &plan.robot),
                language => {
                    measuring_program(&plan.poses, &plan.robot, language).map_err(|error| {
                        Failure::WrongAt(out.display().to_string(), error.describe())
                    })?
                }
            };
            output::document(out, list.as_bytes(), self.force, &files)?;
        }
        if self.json {
            output::json(&document(&plan))
        } else if to_stdout {
            Ok(())
        } else {
            output::text(&blocks::sections(&explain::plan(&plan, Detail::TERMINAL)))
        }
    }

    /// The language of what is written.
    fn language<'s>(&'s self, out: &Path) -> &'s str {
        let by_name = || language_of(out, b"").map(|language| language.id);
        self.language.as_deref().or_else(by_name).unwrap_or("csv")
    }
}

fn place(numbers: &[f64]) -> Result<Point3<f64>, Failure> {
    match *numbers {
        [x, y, z] if numbers.iter().all(|v| v.is_finite()) => Ok(Point3::new(x, y, z)),
        _ => Err(Failure::WrongInput(text!(
            one "--instrument has {count} number; expected X,Y,Z in mm, such as 2500,0,800", "--instrument has {count} numbers; expected X,Y,Z in mm, such as 2500,0,800",
            count = numbers.len()
        ))),
    }
}

/// What a session has and a robot's file has not.
#[derive(Deserialize)]
struct Keys {
    format: Option<IgnoredAny>,
    robot: Option<IgnoredAny>,
    samples: Option<IgnoredAny>,
}

/// Whether a document is a session. What cannot be read is left to the reader of sessions, which
/// says what is wrong with it.
fn is_a_session(path: &Path) -> bool {
    if output::is_a_robots_name(path) {
        return false;
    }
    let regular = std::fs::metadata(path).is_ok_and(|m| m.is_file());
    let bytes = if regular {
        std::fs::read(path).unwrap_or_default()
    } else {
        Vec::new()
    };
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    match serde_json::from_slice::<Keys>(text) {
        Ok(keys) => keys.format.is_some() || keys.robot.is_some() || keys.samples.is_some(),
        Err(_) => true,
    }
}
