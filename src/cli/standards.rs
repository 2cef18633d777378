//! `truepose standards`: accuracy and repeatability after ISO 230-2 and ISO 9283.

use std::path::PathBuf;

use clap::Args;

use crate::language::spoken;
use crate::pipeline;
use crate::present::standards::groups;
use crate::present::standards_v1::document;
use crate::standards::Standards as Figures;

use super::failure::Failure;
use super::output;
use super::words::line;

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
    let mut text = String::new();
    let samples = say!(
        "{session}: {samples} samples",
        session = s.session,
        samples = s.samples
    );
    line(&mut text, samples);
    for group in groups(s, SHOWN) {
        let of = match &group.of {
            poses if poses.is_empty() => String::new(),
            joint => format!("{}, ", spoken(joint)),
        };
        text += &format!(
            "\n{}, {of}{}: {}\n",
            group.standard,
            group.unit,
            spoken(&group.says)
        );
        if !group.rows.is_empty() {
            text += &group.table().aligned(4);
        }
        for missing in &group.missing {
            line(&mut text, format!("  {}", spoken(missing)));
        }
    }
    for note in &s.notes {
        line(&mut text, say!("note: {note}", note = spoken(note)));
    }
    text
}
