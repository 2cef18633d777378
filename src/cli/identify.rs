//! `truepose identify`: from a session to a model.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::effects::JointValues;
use crate::explain::{self, Detail};
use crate::fit::{DEFAULT_EFFECTS, Identification};
use crate::pipeline;
use crate::present::identification_v1::document;
use crate::sessions::Session;
use crate::sessions::division::RegionChoice;
use crate::set_up_errors::DataProblem;
use crate::units::rad_from_deg;

use super::failure::Failure;
use super::words::headed;
use super::{blocks, output};

/// Identify a session's robot: the full model, or the paper's method by regions
#[derive(Debug, Args)]
pub(crate) struct Identify {
    /// Session to identify
    session: PathBuf,
    /// How to identify
    #[arg(long, value_enum, default_value = "exact")]
    method: Method,
    /// Effects to fit, separated by commas [default: joint-zero-offset,link-length; with several joints the whole geometry]
    #[arg(long, value_delimiter = ',', value_name = "ID")]
    effects: Vec<String>,
    /// Number of uniform regions, or their boundaries in degrees: 6 | -90,-60,… | adaptive [default: the session's, else 6]
    #[arg(long, allow_hyphen_values = true)]
    regions: Option<String>,
    /// Fit the geometry of several joints without weak priors (tool 50 mm; an aligned frame 20 mm,
    /// 20 mrad; links 1 mm, 2 mrad; zero offsets 50 mrad)
    #[arg(long)]
    no_prior: bool,
    /// Joint values to start from
    #[arg(long, value_enum, default_value = "commanded")]
    joint_values: Values,
    /// Write the model to this file; - is standard output
    #[arg(long, value_name = "MODEL")]
    out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Method {
    /// Nonlinear least squares for the named effects
    Exact,
    /// The paper's constant corrections by region
    Regional,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Values {
    /// What the controller was told
    Commanded,
    /// What the controller read back
    Read,
}

impl From<Values> for JointValues {
    fn from(values: Values) -> Self {
        match values {
            Values::Commanded => Self::Commanded,
            Values::Read => Self::Read,
        }
    }
}

impl Identify {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = output::is_standard_output(self.out.as_deref());
        output::one_use_of_standard_output(self.json, to_stdout, "--json", "--out -")?;
        let values = self.joint_values.into();
        if self.method == Method::Regional && !self.effects.is_empty() {
            return Err(Failure::WrongInput(text!(
                "--effects belongs to --method exact; the regional method fits angle and radius by region"
            )));
        }
        if self.method == Method::Exact && self.regions.is_some() {
            return Err(Failure::WrongInput(text!(
                "--regions belongs to --method regional; the exact method needs none"
            )));
        }
        let loaded = output::session(&self.session)?;
        let session = &loaded.session;
        let method = match (self.method, &self.regions) {
            (Method::Exact, _) => pipeline::Method::Exact {
                effects: match self.effects {
                    effects if effects.is_empty() => DEFAULT_EFFECTS.map(str::to_owned).to_vec(),
                    effects => effects,
                },
                with: Vec::new(),
                priors: !self.no_prior,
            },
            (Method::Regional, None) => pipeline::Method::Regional(RegionChoice::FromSession),
            (Method::Regional, Some(text)) => pipeline::Method::Regional(parse_regions(text)?),
        };
        let pipeline::Identified {
            identification: answer,
            calibration,
            data_problems,
        } = pipeline::identify_checked(session, &method, values)?;
        let calibration = || calibration;
        let not_handed_out = output::model(self.out.as_deref(), calibration, &loaded, self.force)?;
        if self.json {
            output::json(&document(&answer, &data_problems))?;
        } else if !to_stdout {
            output::text(&in_words(&answer, session, &data_problems))?;
        }
        not_handed_out.map_or(Ok(()), |why| Err(why.into()))
    }
}

fn parse_regions(text: &str) -> Result<RegionChoice, Failure> {
    let wrong = || {
        Failure::WrongInput(text!(
            "--regions '{given}': expected a number of regions, boundaries in degrees such as -90,-60,-30,0, or adaptive",
            given = text
        ))
    };
    if text.trim() == "adaptive" {
        return Ok(RegionChoice::Adaptive);
    }
    if let Ok(number) = text.trim().parse::<usize>() {
        return Ok(RegionChoice::Uniform(number));
    }
    let boundary = |part: &str| {
        let degrees: f64 = part.trim().parse().map_err(|_| wrong())?;
        if degrees.is_finite() {
            Ok(rad_from_deg(degrees))
        } else {
            Err(wrong())
        }
    };
    let boundaries: Result<Vec<f64>, Failure> = text.split(',').map(boundary).collect();
    Ok(RegionChoice::Boundaries(boundaries?))
}

fn in_words(answer: &Identification, session: &Session, data_problems: &[DataProblem]) -> String {
    let text = headed(&answer.session, answer.samples);
    let sections = explain::identification(answer, session, data_problems, Detail::TERMINAL);
    text + &blocks::sections(&sections)
}
