//! Sections and blocks as cards: what an answer says, in the window's look. What the window adds to a section (buttons,
//! the explanation of an effect) is put below it by the caller.

use egui::{Grid, Response, RichText, Ui};

use crate::explain::{Block, Section};
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::widgets;
use crate::present::table::Table;

/// How a section's title looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Title {
    /// As the name of something.
    Plain,
    /// As an answer, in this colour.
    Large(egui::Color32),
}

/// A section's title; what it returns can be explained.
pub(crate) fn title(ui: &mut Ui, section: &Section, look: Title) -> Response {
    let text = RichText::new(&section.title);
    let text = match look {
        Title::Plain => text.font(strong(size::BODY)),
        Title::Large(color) => text.font(strong(size::HEADING)).color(color),
    };
    ui.add(egui::Label::new(text).wrap())
}

/// What belongs to it.
pub(crate) fn show(ui: &mut Ui, blocks: &[Block]) {
    for (index, block) in blocks.iter().enumerate() {
        match block {
            Block::Heading(text) => {
                ui.label(RichText::new(text).font(strong(size::SMALL)));
            }
            Block::Text(text) => widgets::hint(ui, text),
            Block::Warning(text) => {
                let text = RichText::new(text).color(Palette::of(ui).warning);
                ui.add(egui::Label::new(text).wrap());
            }
            Block::List(points) => {
                for point in points {
                    widgets::hint(ui, point);
                }
            }
            Block::Facts(facts) => {
                for (name, value) in facts {
                    widgets::fact(ui, name, value);
                }
            }
            Block::Table(own) => table(ui, index, own),
            // What is drawn or signed is for paper: the window has its own charts.
            Block::Plot(..) | Block::Sign(_) => {}
        }
    }
}

/// The same, its lists as what must not be overlooked.
pub(crate) fn warned(ui: &mut Ui, blocks: &[Block]) {
    for block in blocks {
        match block {
            Block::List(points) => {
                for point in points {
                    widgets::wrong(ui, point);
                }
            }
            other => show(ui, std::slice::from_ref(other)),
        }
    }
}

/// Columns of a table from which on it is wide.
const WIDE: usize = 5;

fn table(ui: &mut Ui, index: usize, table: &Table) {
    let muted = Palette::of(ui).muted;
    egui::ScrollArea::horizontal()
        .id_salt(("table", index))
        .show(ui, |ui| {
            // Wide tables in small letters, as the panel is narrow.
            let (letters, apart) = if table.columns.len() > WIDE {
                (size::SMALL, 6.0)
            } else {
                (size::BODY, 12.0)
            };
            let grid = Grid::new(("table of an answer", index)).spacing([apart, 4.0]);
            grid.min_col_width(0.0).show(ui, |ui| {
                for column in &table.columns {
                    let heading = RichText::new(&column.heading);
                    let heading = heading.size(size::SMALL).color(muted);
                    if column.right {
                        widgets::cell_right(ui, heading);
                    } else {
                        ui.label(heading);
                    }
                }
                ui.end_row();
                for row in &table.rows {
                    for (cell, column) in row.iter().zip(&table.columns) {
                        if column.right {
                            widgets::cell_right(ui, RichText::new(&cell.shown).size(letters));
                        } else {
                            ui.label(RichText::new(&cell.shown).size(letters));
                        }
                    }
                    ui.end_row();
                }
            });
        });
}
