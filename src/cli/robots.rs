//! `truepose robots`: the library of robots.

use std::path::PathBuf;

use clap::Args;

use crate::language::spoken;
use crate::present::names::word;
use crate::present::robots_v1::{self, figure};
use crate::present::table::Table;
use crate::robots::{LibraryRobot, Reference, find, named, source};
use crate::sessions::robot_document;

use super::failure::Failure;
use super::output;
use super::words::line;

/// List the robots of the library, or write one as a robot file
#[derive(Debug, Args)]
pub(crate) struct Robots {
    /// Maker, model or kind, or parts of them, such as ur5e, "kuka kr 6", scara
    #[arg(value_name = "TEXT")]
    text: Vec<String>,
    /// Write the robot with this name to this file, for --robot of other programs and of your own;
    /// - is standard output
    #[arg(long, value_name = "ROBOT.json")]
    out: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
    /// Print JSON (truepose-robot-list/1)
    #[arg(long)]
    json: bool,
}

impl Robots {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let text = self.text.join(" ");
        let to_stdout = output::is_standard_output(self.out.as_deref());
        output::one_use_of_standard_output(to_stdout, self.json, "--out -", "--json")?;
        if let Some(out) = &self.out {
            let robot = one(&text)?;
            let document = robot_document(&robot.robot);
            output::document(out, document.as_bytes(), self.force, &[])?;
            return if self.json {
                output::json(&robots_v1::document(&[robot]))
            } else {
                Ok(())
            };
        }
        let found = find(&text);
        if found.is_empty() {
            // Its error proposes the nearest names.
            one(&text)?;
        }
        if self.json {
            return output::json(&robots_v1::document(&found));
        }
        let mut shown = listed(&found);
        if found.len() > 1 {
            line(
                &mut shown,
                say!(one "{count} robot", "{count} robots", count = found.len()),
            );
        }
        // A text may be the name of one robot and the beginning of others' names.
        let one = match found[..] {
            [one] => Some(one),
            _ => named(&text).ok(),
        };
        if let Some(robot) = one {
            if found.len() > 1 {
                line(&mut shown, format!("\n{} {}", robot.id, robot.title()));
            }
            shown.push_str(&described(robot));
        }
        output::text(&shown)
    }
}

fn one(text: &str) -> Result<&'static LibraryRobot, Failure> {
    named(text).map_err(|error| Failure::refused(error.describe()))
}

fn listed(robots: &[&LibraryRobot]) -> String {
    let mut table = Table::headed(say!(
        "name | maker | model | kind | >joints | >reach mm | >load kg | >repeatability mm"
    ));
    for robot in robots {
        table.row(vec![
            robot.id.clone(),
            robot.maker.clone(),
            robot.model.clone(),
            word(robot.kind.name()),
            robot.robot.joint_count().to_string(),
            figure(robot.reach_mm),
            figure(robot.payload_kg),
            figure(robot.repeatability_mm),
        ]);
    }
    table.aligned(0)
}

/// Ranges, and where the numbers come from.
fn described(robot: &LibraryRobot) -> String {
    let mut text = String::new();
    for (k, joint) in robot.robot.joints.iter().enumerate() {
        let range = joint.limits.map_or(say!("no limits").to_owned(), |limits| {
            let [from, to] =
                [limits.from, limits.to].map(|end| figure(Some(joint.kind.to_display(end))));
            format!("{from} … {to}{}", joint.kind.sign())
        });
        let mut sentence = say!(
            "joint {joint} {name}: {range}",
            joint = k + 1,
            name = joint.name,
            range
        );
        if let Some(ratio) = robot.gear_ratios.get(k) {
            let gear = say!("gear {ratio}", ratio = figure(Some(*ratio)));
            sentence += &format!(", {gear}");
        }
        line(&mut text, sentence);
    }
    let references = [
        (say!("geometry and ranges"), Some(&robot.sources.geometry)),
        (
            say!("reach, load, repeatability"),
            robot.sources.figures.as_ref(),
        ),
        (say!("gear ratios"), robot.sources.gears.as_ref()),
        (
            say!("positions checked against"),
            robot.sources.checked_positions.as_ref(),
        ),
        (
            say!("reach checked against"),
            robot.sources.checked_reach.as_ref(),
        ),
    ];
    for (what, reference) in references {
        if let Some(reference) = reference {
            line(&mut text, format!("{what}: {}", referred(reference)));
        }
    }
    if !robot.not_checked.is_empty() {
        let parts = spoken(robot.not_checked());
        line(&mut text, say!("not checked: {parts}", parts));
    }
    let mut keys: Vec<&str> = Vec::new();
    for reference in references.iter().filter_map(|reference| reference.1) {
        if !keys.contains(&reference.source.as_str()) {
            keys.push(&reference.source);
        }
    }
    for (key, source) in keys.iter().filter_map(|key| Some((key, source(key)?))) {
        let at = [source.at.as_str(), source.commit.as_deref().unwrap_or("")];
        let at: Vec<&str> = at.into_iter().filter(|part| !part.is_empty()).collect();
        let at = at.join(" ");
        let licence = &source.licence;
        line(
            &mut text,
            say!("source {key}: {at} ({licence})", key, at, licence),
        );
    }
    if let Some(note) = &robot.note {
        line(&mut text, note);
    }
    text
}

fn referred(reference: &Reference) -> String {
    let what = source(&reference.source).map_or(reference.source.as_str(), |found| &found.what);
    format!("{what}: {}", reference.place)
}
