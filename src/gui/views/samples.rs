//! Sample by sample: what was measured where, and whether it is within the tolerance; as measured, or by a
//! column. Any number of rows: they are sorted once, and only those in sight are made.

use egui::{Align, CursorIcon, Layout, RichText, Role, Sense, Ui, WidgetInfo};
use egui_extras::{Column, TableBuilder, TableRow};

use crate::gui::actions::EXCLUDE;
use crate::gui::core::quantity::Scale;
use crate::gui::style::{Palette, size};
use crate::gui::view::Sorting;
use crate::gui::views::copies;
use crate::gui::workbench::Workbench;
use crate::gui::workspace::judged;
use crate::present::numbers::trimmed;
use crate::present::units::in_unit;

const ROW: f32 = 22.0;
/// A name, and its unit below it.
const HEAD: f32 = 34.0;
/// Width of the sample's number, and of its mark.
const NUMBER: f32 = 50.0;
const MARK: f32 = 20.0;
/// A head as wide as this has room for its unit beside its name.
const ROOM_FOR_UNITS: f32 = 76.0;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let palette = Palette::of(ui);
    let units = workbench.units();
    let loaded_session = workbench.loaded_session();
    let answer = workbench.answer();
    let view = &workbench.view;
    let mut sorting = view.sorting;
    let order = workbench.order();
    let place = |sample: usize| order.as_ref()?.iter().position(|s| *s as usize == sample);
    let brought = brought(ui, workbench);
    copies::button(ui, workbench, say!("samples"), || {
        copies::samples(workbench)
    });
    let between = 4.0 * ui.spacing().item_spacing.x + ui.spacing().scroll.allocated_width();
    let wide = (ui.available_width() - NUMBER - MARK - between) / 3.0;
    let wide = wide.clamp(50.0, 96.0).floor();
    // A column has one number of decimals, so that its numbers can be compared at a glance.
    let like_before = loaded_session.gap_before.map_or(1.0, |gap| gap.rms_mm);
    let like_after = answer.map_or(1.0, |a| a.identification.gap.after.rms_mm);
    let mut table = TableBuilder::new(ui)
        .striped(false)
        .sense(Sense::click() | Sense::hover())
        .cell_layout(Layout::right_to_left(Align::Center))
        .column(Column::exact(NUMBER))
        .columns(Column::exact(wide), 3)
        .column(Column::exact(MARK))
        .auto_shrink([false, false]);
    if let Some((sample, align)) = brought {
        table = table
            .scroll_to_row(place(sample).unwrap_or(sample), align)
            .animate_scrolling(false);
    }
    let scale = Scale::of_joint(units, loaded_session.turns());
    let mut hovered = None;
    table
        .header(HEAD, |mut header| {
            sorting = heads(&mut header, [&scale.unit, units.length_name()], sorting);
        })
        .body(|body| {
            body.rows(ROW, loaded_session.len(), |mut row| {
                let sample = order.as_ref().map(|order| order[row.index()] as usize);
                let sample = sample.unwrap_or(row.index());
                let excluded = loaded_session.session.samples.is_excluded(sample);
                let marked = view.marked.binary_search(&sample).is_ok();
                row.set_selected(view.selected == Some(sample) || marked);
                row.set_hovered(view.hovered == Some(sample));
                let before = loaded_session.before.length_mm[sample];
                let after = answer.map(|a| a.after.length_mm[sample]);
                let q = trimmed(scale.shown(loaded_session.q(sample)), 3);
                let text = |text: String| {
                    let text = RichText::new(text);
                    if excluded {
                        text.strikethrough().color(palette.muted)
                    } else {
                        text
                    }
                };
                let number = text((sample + 1).to_string()).color(palette.muted);
                let left = after.map(|mm| units.length_like(mm, like_after));
                let cells = [
                    ("number", number),
                    ("angle", text(q)),
                    ("before", text(units.length_like(before, like_before))),
                    ("after", text(left.unwrap_or_default())),
                ];
                for (what, text) in cells {
                    cell(&mut row, sample, what, |ui| drop(ui.label(text)));
                }
                let shown = after.unwrap_or(before);
                cell(&mut row, sample, "tolerance", |ui| {
                    held_against(ui, workbench, (!excluded).then_some(shown));
                });
                let response = row.response();
                if response.hovered() {
                    hovered = Some(sample);
                }
                let marked = view.marked.contains(&sample);
                if response.clicked() || response.secondary_clicked() && !marked {
                    workbench.then(move |bench| bench.view.select(Some(sample)));
                }
                response.context_menu(|ui| drop(EXCLUDE.item(ui, workbench)));
            });
        });
    if sorting != view.sorting {
        workbench.then(move |bench| bench.view.sorting = sorting);
    }
    point_at(ui, hovered, workbench);
}

/// Says which row the pointer is on, where that is another than before.
fn point_at(ui: &Ui, hovered: Option<usize>, workbench: &Workbench) {
    let id = ui.scope_id().with("row under the pointer");
    let before = ui.data_mut(|data| data.get_temp::<Option<usize>>(id));
    ui.data_mut(|data| data.insert_temp(id, hovered));
    if before.flatten() != hovered {
        workbench.then(move |bench| bench.view.hovered = hovered);
    }
}

/// The row that is brought into sight in this frame, and to where. A sample that is chosen or pointed
/// at elsewhere is brought once; under the pointer nothing moves.
fn brought(ui: &Ui, workbench: &Workbench) -> Option<(usize, Option<Align>)> {
    let view = &workbench.view;
    let here = ui.rect_contains_pointer(ui.available_rect_before_wrap());
    let elsewhere = view.hovered.filter(|_| !here);
    let wanted = elsewhere.or(view.selected);
    let id = ui.scope_id().with("shown sample");
    let last: Option<Option<usize>> = ui.data_mut(|data| data.get_temp(id));
    ui.data_mut(|data| data.insert_temp(id, wanted));
    if here || last.flatten() == wanted {
        return None;
    }
    // What is only pointed at moves the table no farther than it must.
    let align = elsewhere.is_none().then_some(Align::Center);
    wanted.map(|row| (row, align))
}

/// The heads of all columns; how the rows are sorted after a click on one.
fn heads(header: &mut TableRow<'_, '_>, [angle, length]: [&str; 2], sorting: Sorting) -> Sorting {
    let heads = [
        say!("sample").to_owned(),
        in_unit(say!("angle"), angle),
        in_unit(say!("before"), length),
        in_unit(say!("after"), length),
        String::new(),
    ];
    let mut after = sorting;
    for (head, by) in heads.iter().zip(0..) {
        if heading(header, head, by, sorting) {
            after = after_click(sorting, by);
        }
    }
    after
}

/// The head of a column, which sorts by it; the last is a mark, and needs a name all the same.
/// Whether it was pressed.
fn heading(header: &mut TableRow<'_, '_>, head: &str, by: usize, sorting: Sorting) -> bool {
    let sorted = (sorting != Sorting::default() && sorting.by == by).then_some(sorting.descending);
    let (_, cell) = header.col(|ui| {
        let palette = Palette::of(ui);
        let color = if sorted.is_some() {
            palette.text
        } else {
            palette.muted
        };
        // Where there is no room for the unit and the arrow, the unit stands below.
        let narrow = ui.available_width() < ROOM_FOR_UNITS;
        let shown = head.replacen(", ", if narrow { "\n" } else { ", " }, 1);
        // A click on the words sorts as well.
        let head = RichText::new(shown).small().color(color);
        let head = egui::Label::new(head).selectable(false).wrap();
        ui.add(head.halign(Align::Max));
        if let Some(descending) = sorted {
            let sign = if descending { "▼" } else { "▲" };
            ui.label(RichText::new(sign).size(size::TINY).color(palette.accent));
        }
    });
    let name = if head.is_empty() {
        say!("tolerance")
    } else {
        head
    };
    let name = match sorted {
        None => say!("column {name}", name),
        Some(true) => say!("column {name}, largest first", name),
        Some(false) => say!("column {name}, smallest first", name),
    };
    cell.widget_info(|| WidgetInfo::labeled(Role::ColumnHeader, true, name.clone()));
    let cell = cell.on_hover_cursor(CursorIcon::PointingHand);
    let clicked = cell.clicked();
    if !head.is_empty() {
        cell.on_hover_text(head);
    }
    clicked
}

/// A cell of a row; it can be pressed, and so it has a name.
fn cell(row: &mut TableRow<'_, '_>, sample: usize, what: &str, contents: impl FnOnce(&mut Ui)) {
    let name = say!("row {sample}, {what}", sample = sample + 1, what);
    let (_, response) = row.col(|ui| {
        // Text that can be selected would keep clicks on the numbers from the row.
        ui.style_mut().interaction.selectable_labels = false;
        contents(ui);
    });
    response.widget_info(|| WidgetInfo::labeled(Role::Cell, true, name.clone()));
}

/// A sample's deviation against the tolerance, mm; without one it is excluded.
fn held_against(ui: &mut Ui, workbench: &Workbench, shown_mm: Option<f64>) {
    let palette = Palette::of(ui);
    match (shown_mm, workbench.document().tolerance_mm) {
        (None, _) => {
            let says = say!("excluded");
            sign(ui, "×", palette.muted, says);
        }
        (Some(mm), Some(tolerance_mm)) if mm.is_finite() => {
            let within = mm <= tolerance_mm;
            let (mark, color) = if within {
                ("●", palette.within)
            } else {
                ("◇", palette.outside)
            };
            sign(ui, mark, color, judged(workbench, within));
        }
        _ => {}
    }
}

/// What is said of a sample by a sign.
fn sign(ui: &mut Ui, sign: &str, color: egui::Color32, says: &str) {
    let shown = ui.label(RichText::new(sign).color(color));
    shown.widget_info(|| WidgetInfo::labeled(Role::Image, true, says));
    shown.on_hover_text(says);
}

/// How rows are sorted after a click on the head of this column: the largest first, then the smallest, then in the
/// order of measuring.
fn after_click(now: Sorting, by: usize) -> Sorting {
    let first = by != 0;
    let next = |descending| Sorting { by, descending };
    match (now.by == by, now.descending == first) {
        (false, _) => next(first),
        (true, true) => next(!first),
        (true, false) => Sorting::default(),
    }
}
