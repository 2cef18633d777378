//! What to measure next.

use egui::{Grid, RichText, Ui};

use crate::diagnosis::NextPose;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::view::What;
use crate::gui::views::copies;
use crate::gui::widgets::{self};
use crate::gui::workbench::{Command, Workbench};
use crate::present::poses::{new_reflectors, table};

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
    title(ui, say!("next-measure-these-poses-next"));
    Grid::new("next poses")
        .num_columns(4)
        .spacing([14.0, 4.0])
        .min_col_width(0.0)
        .show(ui, |ui| {
            let (table, shown) = (table(poses, robot), 4);
            for column in &table.columns[..shown] {
                let heading = RichText::new(&column.heading).size(size::SMALL);
                ui.label(heading.color(palette.muted));
            }
            ui.end_row();
            for row in table.rows.iter().take(MOST) {
                for (k, cell) in row[..shown].iter().enumerate() {
                    let label = ui.label(&cell.shown);
                    if k == 0 {
                        label.on_hover_text(&row[shown].shown);
                    }
                }
                ui.end_row();
            }
        });
    for line in new_reflectors(poses) {
        widgets::hint(ui, line);
    }
    let shown = &poses[..poses.len().min(MOST)];
    if (1..shown.len()).any(|k| shown[..k].iter().any(|earlier| shown[k].repeats(earlier))) {
        let says = say!("next-second-time-the-same-pose");
        widgets::hint(ui, says);
    }
    if poses.len() > MOST {
        let more = poses.len() - MOST;
        widgets::hint(ui, say!("next-and-more-in-the-measuring", more = more));
    }
    copies::button(ui, say!("next-poses"), || copies::poses(poses, robot));
    if widgets::secondary(ui, say!("next-save-measuring-list")).clicked() {
        commands.push(Command::ChooseWhereToExport(What::Poses));
    }
}
