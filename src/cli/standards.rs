//! `truepose standards`: accuracy and repeatability after ISO 230-2 and ISO 9283.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;

use truepose::model::format_v1::load_model;
use truepose::standards::axis::{AxisTest, Series};
use truepose::standards::format_v1::Document;
use truepose::standards::pose::PoseTest;
use truepose::standards::{self, Positioning};

use super::failure::Failure;
use super::output;

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
        let calibration = self.model.as_ref().map(load_model).transpose()?;
        let loaded = truepose::sessions::load(&self.session)?;
        output::messages(&loaded.findings);
        let figures = standards::standards(&loaded.session, calibration.as_ref())
            .map_err(|error| Failure::WrongInput(error.to_string()))?;
        if self.json {
            output::json(&Document::new(&figures))
        } else {
            output::text(&in_words(&figures))
        }
    }
}

fn in_words(s: &standards::Standards) -> String {
    let mut text = format!("{}: {} samples\n", s.session, s.samples);
    for axis in &s.axes {
        axis_in_words(axis, &mut text);
    }
    poses_in_words(&s.poses, s.compensated, &mut text);
    for note in &s.notes {
        let _ = writeln!(text, "note: {note}");
    }
    text
}

fn axis_in_words(axis: &AxisTest, text: &mut String) {
    let _ = writeln!(
        text,
        "\nISO 230-2, joint {} ({}), {}",
        axis.joint + 1,
        axis.name,
        axis.unit
    );
    if let Some(missing) = &axis.missing {
        let _ = writeln!(text, "  none: {missing}");
    }
    for series in axis.series.iter().take(SHOWN) {
        series_in_words(axis, series, text);
    }
    let more = axis.more + axis.series.len().saturating_sub(SHOWN);
    if more > 0 {
        let _ = writeln!(
            text,
            "  {more} more series with fewer positions or approaches"
        );
    }
}

fn series_in_words(axis: &AxisTest, series: &Series, text: &mut String) {
    let [up, down] = series.before.fewest_runs();
    let _ = writeln!(
        text,
        "  {}: {} positions, each approached {} from below and {} from above",
        series.fixed.in_words(axis),
        series.before.positions.len(),
        standards::at_least(up),
        standards::at_least(down),
    );
    let head = if series.after.is_some() {
        "  corrected"
    } else {
        ""
    };
    let _ = writeln!(text, "    {:<37}{:>11}{head}", "", "measured");
    let rows = series.before.rows();
    let after = series.after.as_ref().map(Positioning::rows);
    for (k, (symbol, name, before)) in rows.into_iter().enumerate() {
        if before.is_none() {
            continue;
        }
        let after = after
            .as_ref()
            .map(|rows| format!("{:>11}", figure(rows[k].2, axis)));
        let after = after.unwrap_or_default();
        let _ = writeln!(
            text,
            "    {symbol:<7}{name:<30}{:>11}{after}",
            figure(before, axis)
        );
    }
    for missing in &series.missing {
        let _ = writeln!(text, "    {missing}");
    }
}

fn figure(value: Option<f64>, axis: &AxisTest) -> String {
    let digits = if axis.unit == "mm" { 4 } else { 2 };
    value.map_or_else(|| "–".to_owned(), |v| format!("{v:.digits$}"))
}

fn poses_in_words(test: &PoseTest, compensated: bool, text: &mut String) {
    let _ = writeln!(
        text,
        "\nISO 9283, mm: {} poses, {} from several directions, {} paths",
        test.poses.len(),
        test.variations.len(),
        test.paths.len()
    );
    if !test.poses.is_empty() || !test.paths.is_empty() {
        let head = if compensated { "  corrected" } else { "" };
        let _ = writeln!(
            text,
            "  {:<36}{:>11}{head}",
            "largest over the poses", "measured"
        );
        let (before, after) = (test.largest(false), test.largest(true));
        let show = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), |v| format!("{v:.4}"));
        for ((symbol, name, before), (_, _, after)) in before.rows().into_iter().zip(after.rows()) {
            if before.is_none() && symbol.ends_with('T') {
                continue;
            }
            let after = if compensated {
                format!("{:>11}", show(after))
            } else {
                String::new()
            };
            let _ = writeln!(text, "  {symbol:<4}{name:<32}{:>11}{after}", show(before));
        }
    }
    for missing in &test.missing {
        let _ = writeln!(text, "  {missing}");
    }
}
