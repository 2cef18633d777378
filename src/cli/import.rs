//! `truepose import`: from a file that an instrument wrote to a session.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::atomic::refuse_to_replace_inputs;
use crate::explain::{self, Detail};
use crate::importers::{
    AngleUnit, Companion, Decimal, IMPORTERS, LengthUnit, Matching, Reading, Separator, Settings,
    TimeUnit, find,
};
use crate::pipeline::{self, import, save, save_with_samples, write_inline};
use crate::present::import_v1::document;
use crate::sessions::{Replacing, Session, read_whole, samples_path};

use super::failure::Failure;
use super::own_options::OwnOptions;
use super::{blocks, output};

/// Make a session of a file that an instrument wrote
#[derive(Debug, Args)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a switch of the command"
)]
pub(crate) struct Import {
    /// Measured file
    file: PathBuf,
    /// What wrote it
    #[arg(long = "as", value_name = "FORMAT", value_parser = PossibleValuesParser::new(IMPORTERS.iter().map(|importer| importer.id)))]
    format: String,
    /// Robot that was measured: the robot object of a session in a file, or a name that `truepose robots` lists
    #[arg(long, value_name = "ROBOT")]
    robot: PathBuf,
    /// Write the session to this file, its samples to a CSV file beside it; - is standard output
    #[arg(long, value_name = "SESSION")]
    out: PathBuf,
    /// Where the robot was sent
    #[arg(
        long,
        value_name = "FILE",
        help = "Commanded positions: a table with q1_deg, … and perhaps name, time_s, dir1, load_kg, …"
    )]
    commands: Option<PathBuf>,
    /// How commands find their measurements
    #[arg(long = "match", value_name = "HOW", help = "How commands find their measurements [default: order; name where both have the same names in another order]", value_parser = PossibleValuesParser::new(["order", "time", "name"]))]
    matching: Option<String>,
    /// Unit of coordinates whose heading does not say it
    #[arg(long, value_parser = PossibleValuesParser::new(LengthUnit::ALL.map(LengthUnit::symbol)))]
    unit: Option<String>,
    /// Unit of joint values whose heading does not say it
    #[arg(long, value_parser = PossibleValuesParser::new(AngleUnit::ALL.map(AngleUnit::symbol)))]
    angle_unit: Option<String>,
    /// Unit of times whose heading does not say it; d: days, as spreadsheets count them
    #[arg(long, value_parser = PossibleValuesParser::new(TimeUnit::ALL.map(TimeUnit::symbol)))]
    time_unit: Option<String>,
    /// Decimal sign
    #[arg(long, value_name = "SIGN", value_parser = PossibleValuesParser::new([".", ","]))]
    decimal: Option<String>,
    /// What separates cells
    #[arg(long, value_parser = PossibleValuesParser::new(["tab", "semicolon", "comma", "spaces"]))]
    separator: Option<String>,
    /// Line of the header, counted from 1; 0: there is none [default: found]
    #[arg(long, value_name = "LINE")]
    header: Option<u64>,
    /// What the columns are
    #[arg(
        long,
        help = "What the columns are, such as name,x_mm,y_mm,z_mm,-; auto: what the heading says",
        value_name = "A,B,…",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    columns: Vec<String>,
    /// What the columns of the commands are, in the same words
    #[arg(
        long,
        value_name = "A,B,…",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    commands_columns: Vec<String>,
    /// Take columns whose headings only suggest what they are as they are proposed
    #[arg(long)]
    confirm: bool,
    /// The rows are in the order in which they were measured: the side from which each joint came
    /// follows from the row before
    #[arg(long)]
    in_measuring_order: bool,
    /// Rigid bodies or markers to take
    #[arg(long, value_name = "NAME")]
    name: Vec<String>,
    /// Turn coordinates whose y points upwards so that z does
    #[arg(long)]
    z_up: bool,
    /// Joint whose position was measured, counted from 1
    #[arg(long, default_value_t = 1)]
    joint: usize,
    /// Points that are known in the base frame: name, x, y, z
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// Fit a scale with the reference points
    #[arg(long, requires = "reference")]
    scale: bool,
    /// Reflectors in the tool frame: name, x, y, z
    #[arg(long, value_name = "FILE")]
    targets: Option<PathBuf>,
    /// With --match time, the seconds to add to a measured time [default: found from the motion]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    clock_offset: Option<f64>,
    #[command(flatten)]
    own: OwnOptions,
    /// Print what was found out as JSON
    #[arg(long)]
    json: bool,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

impl Import {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = self.out.as_os_str() == "-";
        output::one_use_of_standard_output(to_stdout, self.json, "--out -", "--json")?;
        if self.clock_offset.is_some_and(|offset| !offset.is_finite()) {
            return Err(Failure::WrongInput(text!(
                "--clock-offset: a number of seconds is expected"
            )));
        }
        let robot = output::robot(&self.robot)?;
        let bytes = read_whole(&self.file)?;
        let commands = read_companion(self.commands.as_deref())?;
        let reference = read_companion(self.reference.as_deref())?;
        let targets = read_companion(self.targets.as_deref())?;
        let reading = self.reading()?;
        let matching = self.matching.as_deref().map(|how| match how {
            "time" => Matching::Time,
            "name" => Matching::Name,
            _ => Matching::Order,
        });
        let settings = Settings {
            name: session_name(if to_stdout { &self.file } else { &self.out }),
            commands: companion(self.commands.as_deref(), commands.as_deref()),
            matching,
            commands_columns: self.commands_columns.clone(),
            in_measuring_order: self.in_measuring_order,
            clock_offset_s: self.clock_offset,
            reference: companion(self.reference.as_deref(), reference.as_deref()),
            scale: self.scale,
            targets: companion(self.targets.as_deref(), targets.as_deref()),
            ..Settings::new(reading, &robot)
        };
        let imported = import(&bytes, &settings)?;
        output::findings(&imported.findings);
        if to_stdout {
            let mut stdout = std::io::stdout().lock();
            write_inline(&imported.session, &mut stdout)
                .context(text!("cannot write to standard output"))?;
        } else {
            let inputs = self.inputs();
            let replacing = Replacing {
                force: self.force,
                inputs: &inputs,
            };
            self.save(&imported.session, replacing)?;
        }
        if self.json {
            output::json(&document(&imported))?;
        } else if !to_stdout {
            let brings = explain::imported(
                imported.session.samples.len(),
                pipeline::nominal_error(&imported.session),
                imported.matched.as_ref(),
                imported.alignment.as_ref(),
                Detail::TERMINAL,
            );
            output::text(&blocks::section(&brings))?;
        }
        Ok(())
    }

    /// Saves the session. Samples that would replace the measured file itself get another name.
    fn save(&self, session: &Session, replacing: Replacing<'_>) -> Result<(), Failure> {
        let usual = samples_path(&self.out);
        if refuse_to_replace_inputs(&usual, replacing.inputs).is_ok() {
            save(session, &self.out, replacing)?;
            return Ok(());
        }
        let other = self.out.with_extension("samples.csv");
        save_with_samples(session, &self.out, &other, replacing)?;
        output::messages(&[say!(
            "the samples are in {file}: {input} is an input and stays as it is",
            file = other.display(),
            input = usual.display()
        )]);
        Ok(())
    }

    /// Every file that was read: no output may replace one.
    fn inputs(&self) -> Vec<&Path> {
        let beside = [&self.commands, &self.reference, &self.targets];
        let beside = beside.into_iter().flatten().map(PathBuf::as_path);
        [self.file.as_path(), self.robot.as_path()]
            .into_iter()
            .chain(beside)
            .collect()
    }

    fn reading(&self) -> Result<Reading, Failure> {
        let Some(joint) = self.joint.checked_sub(1) else {
            return Err(Failure::WrongInput(text!(
                "--joint: joints are counted from 1"
            )));
        };
        Ok(Reading {
            kind: find(&self.format),
            options: self.own.values.clone(),
            file: Some(self.file.clone()),
            unit: self.unit.as_deref().and_then(LengthUnit::of),
            angle_unit: self.angle_unit.as_deref().and_then(AngleUnit::of),
            time_unit: self.time_unit.as_deref().and_then(TimeUnit::of),
            decimal: self.decimal.as_deref().map(|sign| match sign {
                "," => Decimal::Comma,
                _ => Decimal::Point,
            }),
            separator: self.separator.as_deref().map(|separator| match separator {
                "tab" => Separator::Tab,
                "semicolon" => Separator::Semicolon,
                "comma" => Separator::Comma,
                _ => Separator::Spaces,
            }),
            header: self.header,
            columns: self.columns.clone(),
            confirmed: self.confirm,
            names: self.name.clone(),
            z_up: self.z_up,
            joint,
            ..Reading::default()
        })
    }
}

fn read_companion(path: Option<&Path>) -> Result<Option<Vec<u8>>, Failure> {
    Ok(path.map(read_whole).transpose()?)
}

fn companion<'a>(path: Option<&Path>, bytes: Option<&'a [u8]>) -> Option<Companion<'a>> {
    Some(Companion {
        bytes: bytes?,
        file: path.map(Path::to_path_buf),
    })
}

fn session_name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}
