//! What to measure next.

use egui::{Grid, RichText, Ui};

use crate::diagnosis::NextPose;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::units::trimmed;
use crate::gui::view::What;
use crate::gui::views::copies;
use crate::gui::widgets::{self};
use crate::gui::workbench::{Command, Workbench};
use crate::kinematics::{Joint, JointKind};
use crate::units::deg_from_rad;

use crate::gui::views::names::title;

pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    poses: &[NextPose],
    commands: &mut Vec<Command>,
) {
    const MOST: usize = 24;
    let palette = Palette::of(ui);
    let robot = &workbench.subject().session.robot;
    title(ui, "Measure these poses next");
    Grid::new("next poses")
        .num_columns(4)
        .spacing([14.0, 4.0])
        .min_col_width(0.0)
        .show(ui, |ui| {
            for head in ["pose", "from", "reflector", "conditions"] {
                ui.label(RichText::new(head).size(size::SMALL).color(palette.muted));
            }
            ui.end_row();
            for (k, pose) in poses.iter().take(MOST).enumerate() {
                let q = pose.q.iter().zip(&robot.joints);
                let q = q.map(|(q, joint)| match joint.kind {
                    JointKind::Revolute => format!("{}°", trimmed(deg_from_rad(*q), 2)),
                    JointKind::Prismatic => format!("{} mm", trimmed(*q, 2)),
                });
                ui.label(q.collect::<Vec<_>>().join(" "))
                    .on_hover_text(&pose.why);
                let side = |d: &f64| match *d {
                    d if d > 0.0 => "+",
                    d if d < 0.0 => "−",
                    _ => "any",
                };
                ui.label(pose.dir.iter().map(side).collect::<Vec<_>>().join(" "));
                ui.label(pose.target.as_deref().unwrap_or(""));
                let again = poses[..k].iter().any(|earlier| pose.repeats(earlier));
                ui.label(conditions(pose, &robot.joints, again));
                ui.end_row();
            }
        });
    for line in new_reflectors(poses) {
        widgets::hint(ui, line);
    }
    let shown = &poses[..poses.len().min(MOST)];
    if (1..shown.len()).any(|k| shown[..k].iter().any(|earlier| shown[k].repeats(earlier))) {
        let says = "Second time: the same pose again, after another one, as once is not enough over \
                    the noise";
        widgets::hint(ui, says);
    }
    if poses.len() > MOST {
        let more = poses.len() - MOST;
        widgets::hint(ui, format!("and {more} more, in the measuring list"));
    }
    copies::button(ui, "poses", || copies::poses(poses, robot));
    if widgets::secondary(ui, "Save measuring list…").clicked() {
        commands.push(Command::ChooseWhereToExport(What::Poses));
    }
}

/// Where each reflector sits that the session does not have.
fn new_reflectors(poses: &[NextPose]) -> Vec<String> {
    let mut lines = Vec::new();
    for pose in poses {
        let (Some(name), Some(at)) = (&pose.target, pose.target_mm) else {
            continue;
        };
        let [x, y, z] = at.map(|mm| trimmed(mm, 2));
        let line = format!(
            "{name} is a new reflector: mount it at ({x}, {y}, {z}) mm in the tool frame, and survey \
             where it really is"
        );
        if !lines.contains(&line) {
            lines.push(line);
        }
    }
    lines
}

fn conditions(pose: &NextPose, joints: &[Joint], again: bool) -> String {
    let speeds = pose.speed.iter().flatten().zip(joints);
    let speed = speeds.map(|(v, joint)| match joint.kind {
        JointKind::Revolute => format!("{}°/s", trimmed(deg_from_rad(*v), 2)),
        JointKind::Prismatic => format!("{} mm/s", trimmed(*v, 2)),
    });
    let load = pose.load_kg.map(|kg| format!("{} kg", trimmed(kg, 2)));
    let warm = pose.temperature_c.map(|t| format!("{} °C", trimmed(t, 1)));
    let again = again.then(|| "second time".to_owned());
    let all: Vec<String> = speed.chain(load).chain(warm).chain(again).collect();
    all.join(", ")
}
