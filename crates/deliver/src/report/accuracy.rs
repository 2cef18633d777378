//! The standards' figures in a report.

use crate::kinematics::JointKind;
use crate::present::chart::{Axis, AxisDeviation, AxisStage, FULL_WIDTH, shortened};
use crate::present::drawing::Drawing;
use crate::present::poses::sides;
use crate::standards::Standards;
use crate::standards::pose::PoseTest;
use crate::text::capital;

use super::document::{Block, Section, Table, clean};
use crate::explain;
use crate::present::numbers::{plain, short};

/// Poses that the table shows, those of the largest error first.
const POSES: usize = 8;
/// Axes that are plotted: the joints of an arm that are tested one by one.
const MOST_PLOTS: usize = 7;
/// Height of a plot of two, points.
const HEIGHT: f64 = 120.0;

pub(super) fn section(standards: &Standards) -> Section {
    let mut blocks = vec![Block::text(say!(
        "As measured, and as the same approaches would have come out with corrected commands; the definitions are those of ISO 230-2:2014 and ISO 9283:1998"
    ))];
    blocks.extend(plots(standards));
    for section in explain::standards(standards, 1) {
        blocks.push(Block::Heading(section.title));
        blocks.extend(section.blocks);
    }
    pose_blocks(&standards.poses, &mut blocks);
    Section::new(say!("Accuracy and repeatability"), blocks)
}

/// The deviation of each axis over its position, run by run: as measured with what the table corrects, and below it
/// what is left as predicted with the table, in a scale of its own.
fn plots(standards: &Standards) -> impl Iterator<Item = Block> {
    let tested = standards.axes.iter().take(MOST_PLOTS);
    tested.filter_map(|axis| {
        let series = axis.series.first()?;
        let chart = |stage, title: &str| {
            let made = AxisDeviation {
                axis,
                series,
                stage,
                across: Axis::turning(
                    say!(
                        "joint {joint} ({name}), {unit}",
                        joint = axis.joint + 1,
                        name = shortened(&clean(&axis.name), 40),
                        unit = axis.kind.sign().trim()
                    ),
                    axis.kind == JointKind::Revolute,
                ),
                position: &|at| at,
                unit: (axis.unit, 1.0),
            };
            let mut chart = made.chart(title.to_owned(), String::new());
            // The title says what the runs are.
            chart.legend.remove(0);
            chart.in_page(HEIGHT)
        };
        let mut sheet = Drawing::new(FULL_WIDTH, 0.0);
        let mut place = |drawing: &Drawing| {
            sheet.place(drawing, [0.0, sheet.height]);
            sheet.height += drawing.height;
        };
        place(&chart(AxisStage::Measured, &capital(say!("as measured"))));
        let caption = if series.corrected.is_some() {
            place(&chart(AxisStage::Predicted, say!("As predicted with the table")));
            say!(
                "Deviation over the position of {axis}, a line for each run: whole in positive, dashed in negative direction. The thick line is what the table corrects, with its 95 % interval; the scales differ",
                axis = clean(&axis.name)
            )
        } else {
            say!(
                "Deviation over the position of {axis}, a line for each run: whole in positive, dashed in negative direction",
                axis = clean(&axis.name)
            )
        };
        Some(Block::Plot(sheet, caption))
    })
}

/// The poses of the largest error.
fn pose_blocks(test: &PoseTest, blocks: &mut Vec<Block>) {
    if test.poses.is_empty() {
        return;
    }
    let show = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), plain);
    let mut worst: Vec<usize> = (0..test.poses.len()).collect();
    let size = |k: &usize| test.poses[*k].before.accuracy;
    worst.sort_by(|a, b| size(b).total_cmp(&size(a)).then(a.cmp(b)));
    let shown = worst.len().min(POSES);
    if test.poses.len() > shown {
        blocks.push(Block::Text(say!(
            "The {shown} poses of {all} with the largest AP:",
            shown,
            all = test.poses.len()
        )));
    }
    let mut table = Table::headed(say!(
        "Pose | Side | Reflector | >n | >AP, mm | >RP, mm | >AP corrected | >RP corrected"
    ));
    for k in worst.into_iter().take(shown) {
        let pose = &test.poses[k];
        let after =
            |pick: fn(&crate::standards::Attained) -> f64| show(pose.after.as_ref().map(pick));
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
}
