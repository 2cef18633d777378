//! The standards' figures in a report.

use crate::compensation::verification::VerifyError;
use crate::standards::axis::AxisTest;
use crate::standards::pose::PoseTest;
use crate::standards::{Positioning, Standards, at_least};

use super::document::{Block, Section, Table, clean};
use super::numbers::{plain, short};

/// Poses that the table shows, those of the largest error first.
const POSES: usize = 8;

pub(super) fn section(standards: &Standards) -> Section {
    let mut blocks = vec![Block::Text(
        "As measured, and as the same approaches would have come out with corrected commands; the \
         definitions are those of ISO 230-2:2014 and ISO 9283:1998"
            .to_owned(),
    )];
    for axis in &standards.axes {
        axis_blocks(axis, &mut blocks);
    }
    pose_blocks(&standards.poses, standards.compensated, &mut blocks);
    if !standards.notes.is_empty() {
        blocks.push(Block::List(standards.notes.clone()));
    }
    Section {
        title: "Accuracy and repeatability".to_owned(),
        blocks,
    }
}

/// The section of a session that they say nothing of.
pub(super) fn none(because: &VerifyError) -> Section {
    Section {
        title: "Accuracy and repeatability".to_owned(),
        blocks: vec![Block::Text(format!(
            "No figures after ISO 230-2 and ISO 9283: {}",
            clean(&because.to_string())
        ))],
    }
}

fn axis_blocks(axis: &AxisTest, blocks: &mut Vec<Block>) {
    let unit = if axis.unit == "arcsec" {
        "seconds of arc"
    } else {
        "mm"
    };
    blocks.push(Block::Heading(format!(
        "Positioning of joint {} ({}), ISO 230-2",
        axis.joint + 1,
        clean(&axis.name)
    )));
    if let Some(missing) = &axis.missing {
        blocks.push(Block::Text(format!("No figures: {missing}")));
    }
    let Some(series) = axis.series.first() else {
        return;
    };
    let [up, down] = series.before.fewest_runs();
    blocks.push(Block::Text(format!(
        "{}; {} positions, each approached {} from below and {} from above; figures in {unit}",
        clean(&series.fixed.in_words(axis)),
        series.before.positions.len(),
        at_least(up),
        at_least(down),
    )));
    let mut table = Table::new(&["Symbol", "Figure", ">As measured", ">Corrected commands"]);
    let digits = if axis.unit == "mm" { 4 } else { 1 };
    let show = |v: Option<f64>| {
        v.map_or_else(
            || "–".to_owned(),
            |v| format!("{v:.digits$}").replace('-', "−"),
        )
    };
    let after = series.after.as_ref().map(Positioning::rows);
    for (k, (symbol, name, before)) in series.before.rows().into_iter().enumerate() {
        if before.is_none() {
            continue;
        }
        let corrected = after
            .as_ref()
            .map_or_else(|| "–".to_owned(), |rows| show(rows[k].2));
        table.row([symbol.to_owned(), name.to_owned(), show(before), corrected]);
    }
    blocks.push(Block::Table(table));
    let mut remarks = series.missing.clone();
    let others = axis.series.len() - 1 + axis.more;
    if others > 0 {
        remarks.push(format!(
            "the session holds {others} more series of this joint under other conditions; the \
             program's command for the standards lists them"
        ));
    }
    if !remarks.is_empty() {
        blocks.push(Block::List(remarks));
    }
}

fn pose_blocks(test: &PoseTest, compensated: bool, blocks: &mut Vec<Block>) {
    blocks.push(Block::Heading("Poses, ISO 9283".to_owned()));
    if test.poses.is_empty() && test.paths.is_empty() {
        blocks.push(Block::Text(format!(
            "No figures: {}",
            test.missing.join("; ")
        )));
        return;
    }
    let (before, after) = (test.largest(false), test.largest(true));
    let mut table = Table::new(&[
        "Symbol",
        "Largest over poses and paths, mm",
        ">As measured",
        ">Corrected commands",
    ]);
    let show = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), plain);
    for ((symbol, name, before), (_, _, after)) in before.rows().into_iter().zip(after.rows()) {
        if before.is_none() && symbol.ends_with('T') {
            continue;
        }
        let corrected = if compensated {
            show(after)
        } else {
            "–".to_owned()
        };
        table.row([symbol.to_owned(), name.to_owned(), show(before), corrected]);
    }
    blocks.push(Block::Table(table));
    let mut worst: Vec<usize> = (0..test.poses.len()).collect();
    let size = |k: &usize| test.poses[*k].before.accuracy;
    worst.sort_by(|a, b| size(b).total_cmp(&size(a)).then(a.cmp(b)));
    let shown = worst.len().min(POSES);
    if test.poses.len() > shown {
        blocks.push(Block::Text(format!(
            "The {shown} poses of {} with the largest AP:",
            test.poses.len()
        )));
    }
    let mut table = Table::new(&[
        "Pose",
        "Side",
        "Reflector",
        ">n",
        ">AP, mm",
        ">RP, mm",
        ">AP corrected",
        ">RP corrected",
    ]);
    for k in worst.into_iter().take(shown) {
        let pose = &test.poses[k];
        let after = |pick: fn(&crate::standards::pose::Attained) -> f64| {
            show(pose.after.as_ref().map(pick))
        };
        table.row([
            pose.q
                .iter()
                .map(|q| short(*q))
                .collect::<Vec<_>>()
                .join(", "),
            sides(&pose.dir),
            pose.target.as_deref().map_or_else(|| "–".to_owned(), clean),
            pose.cycles.to_string(),
            plain(pose.before.accuracy),
            plain(pose.before.repeatability),
            after(|a| a.accuracy),
            after(|a| a.repeatability),
        ]);
    }
    blocks.push(Block::Table(table));
    if !test.missing.is_empty() {
        blocks.push(Block::List(test.missing.clone()));
    }
}

/// Sides as arrows: ↑ from below, ↓ from above, · not known.
pub(super) fn sides(dir: &[f64]) -> String {
    let arrow = |d: &f64| match *d {
        d if d > 0.0 => "↑",
        d if d < 0.0 => "↓",
        _ => "·",
    };
    dir.iter().map(arrow).collect::<Vec<_>>().join(" ")
}
