//! Sections and blocks as cards: what an answer says, in the window's look. What the window adds to a section (buttons,
//! the explanation of an effect) is put below it by the caller.

use egui::{Grid, Response, RichText, TextStyle, TextWrapMode, Ui, WidgetText};

use crate::explain::{Block, Section};
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::widgets;
use crate::present::numbers::with_minus_signs;
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
            Block::Text(text) => widgets::hint(ui, with_minus_signs(text)),
            Block::Warning(text) => {
                let text = RichText::new(with_minus_signs(text)).color(Palette::of(ui).warning);
                ui.add(egui::Label::new(text).wrap());
            }
            Block::List(points) => {
                for point in points {
                    widgets::hint(ui, with_minus_signs(point));
                }
            }
            Block::Facts(facts) => {
                for (name, value) in facts {
                    widgets::fact(ui, name, with_minus_signs(value));
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
                    widgets::wrong(ui, &with_minus_signs(point));
                }
            }
            other => show(ui, std::slice::from_ref(other)),
        }
    }
}

/// Columns of a table from which on it is wide.
const WIDE: usize = 5;

/// A table, wide ones in small letters; where it is wider than the panel, its rows one below the other.
fn table(ui: &mut Ui, index: usize, table: &Table) {
    let (letters, apart) = if table.columns.len() > WIDE {
        (size::SMALL, 5.0)
    } else {
        (size::BODY, 12.0)
    };
    if width_of(ui, table, letters, apart) > ui.available_width() {
        return one_below_the_other(ui, table);
    }
    let muted = Palette::of(ui).muted;
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
                let cell = RichText::new(with_minus_signs(&cell.shown)).size(letters);
                if column.right {
                    widgets::cell_right(ui, cell);
                } else {
                    ui.label(cell);
                }
            }
            ui.end_row();
        }
    });
}

/// How much room a table takes without a line that breaks, points.
fn width_of(ui: &Ui, table: &Table, letters: f32, apart: f32) -> f32 {
    let width = |text: &str, letters: f32| {
        let text = WidgetText::from(RichText::new(text).size(letters));
        let galley = text.into_galley(
            ui,
            Some(TextWrapMode::Extend),
            f32::INFINITY,
            TextStyle::Body,
        );
        galley.size().x
    };
    let columns = table.columns.iter().enumerate().map(|(k, column)| {
        let cells = table.rows.iter().filter_map(|row| row.get(k));
        let cells = cells.map(|cell| width(&with_minus_signs(&cell.shown), letters));
        cells.fold(width(&column.heading, size::SMALL), f32::max) + apart
    });
    columns.sum::<f32>() - apart
}

/// Each row: what it is, and below it what its other columns hold.
fn one_below_the_other(ui: &mut Ui, table: &Table) {
    let in_a_line = |text: &str| with_minus_signs(text).replace('\n', " ");
    for row in &table.rows {
        let mut cells = row.iter().zip(&table.columns);
        if let Some((first, column)) = cells.next() {
            // A number alone says nothing; a name says what it is. Nothing stands for the name above.
            let name = in_a_line(&first.shown);
            let name = if name.starts_with(|c: char| c.is_ascii_digit()) {
                format!("{} {name}", in_a_line(&column.heading))
            } else {
                name
            };
            if !name.trim().is_empty() {
                ui.label(RichText::new(name.trim()).font(strong(size::SMALL)));
            }
        }
        let rest = cells.filter(|(cell, _)| !["", "–"].contains(&cell.shown.as_str()));
        let rest = rest.map(|(cell, column)| {
            let (heading, cell) = (in_a_line(&column.heading), in_a_line(&cell.shown));
            // The unit of a column is behind its number, as in a sentence.
            match heading.split_once(", ").filter(|_| column.right) {
                Some((heading, unit)) => format!("{heading} {cell} {unit}"),
                None => format!("{heading} {cell}"),
            }
        });
        let rest = rest.collect::<Vec<_>>().join("; ");
        widgets::hint(ui, if rest.is_empty() { "–" } else { &rest });
    }
}
