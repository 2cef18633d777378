//! `truepose standards`: accuracy and repeatability after ISO 230-2 and ISO 9283.

use std::path::PathBuf;

use clap::Args;

use crate::explain::standards;
use crate::pipeline;
use crate::present::standards_v1::document;
use crate::standards::Standards as Figures;

use super::failure::Failure;
use super::words::headed;
use super::{blocks, output};

/// Series of an axis that the text shows; --json has more.
const SHOWN: usize = 3;

/// State accuracy and repeatability after ISO 230-2 and ISO 9283
#[derive(Debug, Args)]
pub(crate) struct Standards {
    /// Session to take the figures from
    session: PathBuf,
    /// State them with this model's corrected commands as well
    #[arg(long, value_name = "MODEL")]
    model: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Standards {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let calibration = self.model.as_ref().map(pipeline::load_model).transpose()?;
        let loaded = output::session(&self.session)?;
        let figures = pipeline::standards(&loaded.session, calibration.as_deref())?;
        if self.json {
            output::json(&document(&figures))
        } else {
            output::text(&in_words(&figures))
        }
    }
}

fn in_words(s: &Figures) -> String {
    let text = headed(&s.session, s.samples);
    text + &blocks::sections(&standards(s, SHOWN))
}
