//! The regions, one row each: name, boundaries, samples, and what can be done with it.

use egui::{Align, DragValue, Key, Layout, RichText, TextEdit, Ui, UiBuilder, vec2};

use crate::gui::core::boundaries::{self, End, SNAP_DEG};
use crate::gui::core::by_angle::Count;
use crate::gui::style::{Palette, size, space};
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::present::numbers::{grouped, trimmed};
use crate::present::units::{AngleUnit, Units};
use crate::sessions::regions::Assignment;
use crate::units::rad_from_deg;

use super::row::{self, COLUMNS, name_id};

/// More regions than this are too many to be listed with fields.
const MOST_LISTED: usize = 60;
/// Widest field for an end: all digits that a boundary is shown with.
const WIDEST: f32 = 76.0;
/// Between the columns.
const GAP: f32 = 5.0;
const HEIGHT: f32 = 24.0;

/// The columns in a panel of this width.
fn columns(available: f32) -> [f32; 5] {
    let [name, least, _, samples, more] = COLUMNS;
    let rest = available - name - samples - more - 4.0 * GAP;
    let end = (0.5 * rest).clamp(least, WIDEST);
    [name, end, end, samples, more]
}

pub(super) fn show(ui: &mut Ui, workbench: &Workbench, counts: &[Count]) {
    let regions = &workbench.document().regions;
    let units = workbench.units();
    ui.spacing_mut().item_spacing = vec2(GAP, 3.0);
    ui.spacing_mut().interact_size.y = HEIGHT;
    let columns = columns(ui.available_width());
    head(ui, columns, units);
    for (k, region) in regions.iter().enumerate().take(MOST_LISTED) {
        ui.horizontal(|ui| {
            name(ui, k, &region.name, workbench);
            for end in [End::From, End::To] {
                angle(ui, columns[1], workbench, (k, end));
            }
            samples(ui, workbench, k, counts[k]);
            row::more(ui, regions, k, workbench);
        });
        if let Some(says) = few(counts[k]) {
            note(ui, &says);
        }
    }
    if regions.len() > MOST_LISTED {
        widgets::hint(
            ui,
            say!(
                "and {more} more, to be dragged on the plot",
                more = regions.len() - MOST_LISTED
            ),
        );
    }
}

fn head(ui: &mut Ui, columns: [f32; 5], units: Units) {
    let muted = Palette::of(ui).muted;
    let unit = units.angle_name().trim();
    let names = [
        say!("name").to_owned(),
        say!("from, {unit}", unit),
        say!("to, {unit}", unit),
        say!("samples").to_owned(),
    ];
    ui.horizontal(|ui| {
        for (k, (name, width)) in names.into_iter().zip(columns).enumerate() {
            // The head of the samples ends where their numbers end.
            let layout = if k < 3 {
                Layout::left_to_right(Align::Center)
            } else {
                Layout::right_to_left(Align::Center)
            };
            ui.allocate_ui_with_layout(vec2(width, 16.0), layout, |ui| {
                ui.set_min_width(width);
                let name = RichText::new(name).size(size::SMALL).color(muted);
                ui.add(egui::Label::new(name).extend());
            });
        }
    });
}

/// What a region with few samples can and cannot do.
fn few(count: Count) -> Option<String> {
    match count.fitted {
        0 if count.all == 0 => Some(
            say!("no sample, so no correction: measure here, or merge it with the next").to_owned(),
        ),
        0 => Some(say!(
            one "{count} sample, which cannot be fitted, so no correction",
            "{count} samples, none of which can be fitted, so no correction",
            count = grouped(count.all)
        )),
        1 => Some(
            say!("one sample to fit: a correction, but nothing to tell how sure it is").to_owned(),
        ),
        _ => None,
    }
}

/// A remark below a row, with a mark before it: colour alone says nothing.
fn note(ui: &mut Ui, text: &str) {
    let warning = Palette::of(ui).warning;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = f32::from(space::ROUND);
        let (rect, _) = ui.allocate_exact_size(vec2(10.0, 14.0), egui::Sense::hover());
        let centre = rect.center();
        let corner = |x: f32, y: f32| centre + vec2(x, y);
        let triangle = vec![corner(0.0, -4.5), corner(5.0, 4.0), corner(-5.0, 4.0)];
        ui.painter().add(egui::Shape::closed_line(
            triangle,
            egui::Stroke::new(1.3, warning),
        ));
        let text = RichText::new(text).size(size::SMALL).color(warning);
        ui.add(egui::Label::new(text).wrap());
    });
}

fn name(ui: &mut Ui, region: usize, name: &str, workbench: &Workbench) {
    let id = name_id(ui, region);
    let typed: Option<String> = ui.data_mut(|data| data.get_temp(id));
    let mut text = typed.unwrap_or_else(|| name.to_owned());
    let edit = TextEdit::singleline(&mut text)
        .id(id)
        .margin(egui::Margin::symmetric(4, 4))
        .align(egui::Align2::LEFT_CENTER)
        .clip_text(true);
    let field = ui.add_sized([COLUMNS[0], HEIGHT], edit);
    widgets::label(&field, say!("Name of region {name}", name));
    let field = field.on_hover_text(name);
    let escaped = ui.input(|i| i.key_pressed(Key::Escape));
    if field.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text));
        return;
    }
    if field.lost_focus() && text != name && !escaped {
        workbench.then(move |bench| {
            bench.edit(phrase!("rename region"), |document| {
                document.rename(region, &text)
            })
        });
    }
    ui.data_mut(|data| data.remove::<String>(id));
}

/// The number of an end. It stops at its neighbours, as a boundary that is dragged does.
fn angle(ui: &mut Ui, width: f32, workbench: &Workbench, (k, end): (usize, End)) {
    let (regions, units) = (&workbench.document().regions, workbench.units());
    let (name, at_rad) = match end {
        End::From => (
            say!("From, region {region}", region = regions[k].name),
            regions[k].from_rad,
        ),
        End::To => (
            say!("To, region {region}", region = regions[k].name),
            regions[k].to_rad,
        ),
    };
    let within = workbench.loaded_session().travel();
    let boundary = boundaries::at_end(regions, k, end);
    let room = boundary.and_then(|b| Some((b, boundaries::allowed_range(regions, b, within)?)));
    let Some((boundary, (low, high))) = room else {
        return;
    };
    let digits = if units.angle == AngleUnit::Radian {
        4
    } else {
        2
    };
    let before = units.angle_value(at_rad);
    let mut value = before;
    let field = DragValue::new(&mut value)
        .speed(units.angle_value(rad_from_deg(SNAP_DEG)))
        .custom_formatter(move |value, _| trimmed(value, digits))
        .range(units.angle_value(low)..=units.angle_value(high));
    widgets::cell_number(ui, &name, units.angle_name().trim(), width, field);
    let to_rad = value / units.angle_value(1.0);
    if value != before {
        workbench.then(move |bench| {
            bench.edit(phrase!("move boundary"), |document| {
                document.move_boundary(boundary, to_rad)
            });
        });
    }
}

/// The number of samples; pressed, it shows them.
fn samples(ui: &mut Ui, workbench: &Workbench, k: usize, count: Count) {
    let region = &workbench.document().regions[k];
    let palette = Palette::of(ui);
    let room = egui::Rect::from_min_size(ui.cursor().min, vec2(COLUMNS[3], HEIGHT));
    let number = RichText::new(count.all.to_string());
    let layout = egui::Layout::right_to_left(egui::Align::Center);
    let response = ui
        .scope_builder(UiBuilder::new().max_rect(room).layout(layout), |ui| {
            ui.set_min_size(room.size());
            if count.all == 0 {
                return ui.label(number.color(palette.warning));
            }
            ui.add(egui::Link::new(number))
        })
        .inner;
    if count.all == 0 {
        return;
    }
    let says = match count.all {
        1 => say!("Show the sample of region {region}", region = region.name),
        n => say!(
            "Show the {samples} of region {region}",
            samples = say!(one "{count} sample", "{count} samples", count = grouped(n)),
            region = region.name
        ),
    };
    widgets::label(&response, says.clone());
    if response.on_hover_text(says).clicked() {
        let samples = samples_of(workbench, k);
        workbench.then(|bench| bench.view.mark(samples));
    }
}

/// The samples of a region, in the order of the session.
fn samples_of(workbench: &Workbench, region: usize) -> Vec<usize> {
    let assignment = Assignment::new(&workbench.document().regions);
    let q = &workbench.loaded_session().session.samples.q[0];
    (0..q.len())
        .filter(|i| assignment.region_of(q[*i]) == Some(region))
        .collect()
}
