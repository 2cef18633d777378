//! Files beside the measured one: commands, reference points, targets.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use nalgebra::Point3;
use sha2::{Digest, Sha256};

use crate::diagnostic::Rejected;
use crate::document::number::{ONCE, hexadecimal, quoted};
use crate::importers::columns::Columns;
use crate::importers::formats::{csv, tracker};
use crate::importers::job::{Companion, Job};
use crate::importers::matching::{BEARABLE, listed_names};
use crate::importers::role::Role;
use crate::importers::settings::{About, ReadContext, Reading};
use crate::sessions::Target;
use crate::sessions::columns::{Quantity, Unit};
use crate::sessions::default_targets;
use crate::tables::encoding;
use crate::text::Text;

/// The heading of points with names.
pub(crate) const POINTS: &str = "name,x_mm,y_mm,z_mm";

impl Job<'_> {
    /// Reads a file beside the measured one: commands, which may have a header such as this, or else points with names.
    pub(crate) fn companion(
        &mut self,
        companion: &Companion<'_>,
        commands: Option<&str>,
    ) -> Result<Columns, Rejected> {
        let header = commands.unwrap_or(POINTS);
        let mut findings = Vec::new();
        let decoded = encoding::decode(companion.bytes, &companion.place(), &mut findings);
        let (text, encoding) = match decoded {
            Ok(decoded) => decoded,
            Err(error) => return self.refused(vec![*error]),
        };
        let are_commands = commands.is_some();
        let read_with = |asked: &[About]| {
            let given = self.reading;
            // What was said about the measured file holds here only where this file does not tell.
            let asks = |about| asked.contains(&about);
            let reading = Reading {
                file: companion.file.clone(),
                unit: given.unit.filter(|_| asks(About::Unit)),
                angle_unit: given.angle_unit.filter(|_| asks(About::AngleUnit)),
                time_unit: given.time_unit.filter(|_| asks(About::TimeUnit)),
                decimal: given.decimal.filter(|_| asks(About::Decimal)),
                reach_mm: given.reach_mm,
                joints: given.joints.clone(),
                columns: if are_commands {
                    self.settings.commands_columns.clone()
                } else {
                    Vec::new()
                },
                ..Reading::default()
            };
            let mut context = ReadContext::new(&text, companion.bytes, &reading, self.part);
            let columns = if are_commands {
                csv::read_any(&mut context)
            } else {
                tracker::read(&mut context)
            };
            let columns = columns.filter(|_| !context.is_open());
            (context.found, columns)
        };
        let (mut found, mut columns) = read_with(&[]);
        if !found.questions.is_empty() {
            let asked: Vec<About> = found
                .questions
                .iter()
                .map(|question| question.about)
                .collect();
            (found, columns) = read_with(&asked);
        }
        findings.append(&mut found.findings);
        let Some(columns) = columns else {
            findings.extend(found.questions.iter().map(|question| {
                let mut diagnostic = question.as_diagnostic();
                if question.about == About::Columns {
                    diagnostic.expected = if are_commands {
                        text!(
                            "a header such as {header}, or --commands-columns with what each column is",
                            header
                        )
                    } else {
                        text!("a header such as {header}", header)
                    };
                }
                diagnostic
            }));
            return self.refused(findings);
        };
        self.findings.append(&mut findings);
        let file = file_in_words(companion.file.as_ref(), companion.bytes);
        self.sentences.push(text!(
            "{found}: {name}",
            found = file,
            name = encoding.name()
        ));
        Ok(columns)
    }

    /// Points with their names, mm.
    pub(crate) fn named_points(
        &mut self,
        companion: &Companion<'_>,
    ) -> Result<BTreeMap<String, Point3<f64>>, Rejected> {
        let columns = self.companion(companion, None)?;
        let place = companion.place();
        let (Some(names), Some(points)) = (columns.points(), columns.places()) else {
            return self.refuse_at(
                place,
                text!("no names, or not all of x, y and z"),
                Text::verbatim(POINTS),
            );
        };
        let mut named = BTreeMap::new();
        for (row, (name, point)) in names.iter().zip(points).enumerate() {
            let place = match columns.lines.get(row) {
                Some(line) => place.clone().at_line(line),
                None => place.clone(),
            };
            if name.is_empty() || point.coords.iter().any(|v| !v.is_finite()) {
                return self.refuse_at(
                    place,
                    text!("a point without a name or a coordinate"),
                    Text::verbatim(POINTS),
                );
            }
            if named.insert((*name).to_owned(), point).is_some() {
                return self.refuse_at(
                    place,
                    text!("{name} a second time", name = quoted(name)),
                    ONCE,
                );
            }
        }
        Ok(named)
    }

    /// Reflectors: those of the file that was given, or one at the tool's origin.
    pub(crate) fn targets(&mut self, columns: &Columns) -> Result<Vec<Target>, Rejected> {
        if let Some(companion) = &self.settings.targets {
            let named = self.named_points(companion)?;
            let targets = named
                .into_iter()
                .map(|(name, position_mm)| Target { name, position_mm });
            return Ok(targets.collect());
        }
        let used = columns.texts(Role::Known(Quantity::Target, Some(Unit::Fixed)));
        let used: BTreeSet<&str> = used
            .unwrap_or_default()
            .into_iter()
            .filter(|name| !name.is_empty())
            .collect();
        let used: Vec<&str> = used.into_iter().collect();
        match used[..] {
            [] => Ok(default_targets()),
            [name] => {
                self.note(text!(
                    "target {name} is taken to sit at the tool's origin",
                    name = quoted(name)
                ));
                Ok(vec![at_origin(name)])
            }
            _ => {
                let names = used.iter().map(|name| quoted(name));
                let found = text!(
                    "several targets whose positions are not stated: {names}",
                    names = listed_names(names, BEARABLE)
                );
                self.refuse(
                    found,
                    text!("--targets with their names and positions in the tool frame"),
                )
            }
        }
    }
}

fn at_origin(name: &str) -> Target {
    Target {
        name: name.to_owned(),
        position_mm: Point3::origin(),
    }
}

/// A file by its name and what is in it.
pub(crate) fn file_in_words(file: Option<&PathBuf>, bytes: &[u8]) -> Text {
    let hash = hexadecimal(&Sha256::digest(bytes));
    match file.and_then(|file| file.file_name()) {
        Some(name) => Text::verbatim(format!("{} (sha256 {hash})", name.to_string_lossy())),
        None => text!("a file (sha256 {hash})", hash),
    }
}
