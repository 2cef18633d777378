//! What to measure next.

use egui::{Grid, Label, RichText, TextStyle, TextWrapMode, Ui, WidgetText};

use crate::diagnosis::NextPose;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::view::What;
use crate::gui::views::copies;
use crate::gui::widgets;
use crate::gui::workbench::{Asked, Command, Workbench};
use crate::present::poses::{new_reflectors, table};
use crate::present::table::Cell;

pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    poses: &[NextPose],
    commands: &mut Vec<Command>,
) {
    const MOST: usize = 24;
    let robot = &workbench.loaded_session().session.robot;
    let table = table(poses, robot);
    let rows = &table.rows[..table.rows.len().min(MOST)];
    let headings: Vec<&str> = table.columns.iter().map(|c| &*c.heading).collect();
    let holds = |k: &usize| rows.iter().any(|row| !row[*k].shown.is_empty());
    let shown: Vec<usize> = (0..SHOWN).filter(holds).collect();
    if is_narrower(ui, &shown, &headings, rows) {
        one_below_the_other(ui, &headings, rows);
    } else {
        side_by_side(ui, &shown, &headings, rows);
    }
    for line in new_reflectors(poses) {
        widgets::hint(ui, line);
    }
    let shown = &poses[..poses.len().min(MOST)];
    if (1..shown.len()).any(|k| shown[..k].iter().any(|earlier| shown[k].repeats(earlier))) {
        let says = say!(
            "Second time: the same pose again, after another one, as once is not enough over the noise"
        );
        widgets::hint(ui, says);
    }
    if poses.len() > MOST {
        let more = poses.len() - MOST;
        widgets::hint(
            ui,
            say!("and {more} more, in the measuring list", more = more),
        );
    }
    copies::button(ui, say!("poses"), || copies::poses(poses, robot));
    if widgets::secondary(ui, say!("Save measuring list…")).clicked() {
        commands.push(Command::Ask(Asked::WhereToExport(What::Poses)));
    }
}

/// Columns that are shown where they hold anything; the last one of the table, why, stands under the pointer.
const SHOWN: usize = 4;
/// Between two columns, points.
const APART: f32 = 14.0;

/// Whether the columns side by side are wider than what is left of the panel.
fn is_narrower(ui: &Ui, shown: &[usize], headings: &[&str], rows: &[Vec<Cell>]) -> bool {
    let width = |text: &str, style: TextStyle| {
        let text = WidgetText::from(text);
        let galley = text.into_galley(ui, Some(TextWrapMode::Extend), f32::INFINITY, style);
        galley.size().x
    };
    let widest = |k: usize| {
        let cells = rows.iter().map(|row| width(&row[k].shown, TextStyle::Body));
        cells.fold(width(headings[k], TextStyle::Small), f32::max)
    };
    let all: f32 = shown.iter().map(|k| widest(*k) + APART).sum();
    all - APART > ui.available_width()
}

fn side_by_side(ui: &mut Ui, shown: &[usize], headings: &[&str], rows: &[Vec<Cell>]) {
    let palette = Palette::of(ui);
    Grid::new("next poses")
        .num_columns(shown.len())
        .spacing([APART, 4.0])
        .min_col_width(0.0)
        .show(ui, |ui| {
            for k in shown {
                let heading = RichText::new(headings[*k]).size(size::SMALL);
                ui.label(heading.color(palette.muted));
            }
            ui.end_row();
            for row in rows {
                for k in shown {
                    let label = ui.label(&row[*k].shown);
                    if *k == 0 {
                        label.on_hover_text(&row[SHOWN].shown);
                    }
                }
                ui.end_row();
            }
        });
}

/// The values of all joints on as many lines as they need, and the rest in small below them.
fn one_below_the_other(ui: &mut Ui, headings: &[&str], rows: &[Vec<Cell>]) {
    for row in rows {
        let pose = Label::new(&row[0].shown).wrap();
        ui.add(pose).on_hover_text(&row[SHOWN].shown);
        let rest = (1..SHOWN).filter(|k| !row[*k].shown.is_empty());
        let rest = rest.map(|k| format!("{} {}", headings[k], row[k].shown));
        widgets::hint(ui, rest.collect::<Vec<_>>().join(", "));
    }
}
