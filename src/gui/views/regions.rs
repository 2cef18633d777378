//! Step 2: where the joint gets corrections of its own, one row each.

use egui::{Align, DragValue, FontId, Grid, Layout, RichText, Ui, vec2};

use crate::diagnostic::Severity;
use crate::gui::core::document::{Document, Method};
use crate::gui::core::regions::{self, Count, Division, End, SNAP_DEG};
use crate::gui::style::{Palette, size, space};
use crate::gui::view::Step;
use crate::gui::views::session;
use crate::gui::widgets::{self, Buttons, Does, Forms, Words};
use crate::gui::workbench::Workbench;
use crate::gui::{actions, help};
use crate::present::numbers::{grouped, trimmed};
use crate::present::units::AngleUnit;
use crate::sessions::Region;
use crate::sessions::regions::Assignment;
use crate::units::rad_from_deg;

/// Regions that are offered when there are none: the paper's number.
const OFFERED: usize = 6;

/// More even regions than this are a slip of the keyboard.
const MOST_EVEN: usize = 360;

pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    if loaded_session.is_empty() {
        ui.hint(say!("Open a session that was measured on this robot"));
        return;
    }
    division(ui, workbench);
    if workbench.document().regions.is_empty() {
        none(ui, workbench);
        return;
    }
    ui.add_space(space::TIGHT);
    let counted = workbench.counted();
    rows(ui, workbench, &counted.0);
    left_out(ui, workbench, counted.1);
}

/// How the range is divided.
fn division(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    let present = document.regions.len();
    let number = if present == 0 { OFFERED } else { present };
    let kinds = [
        (Some(0), say!("Uniform")),
        (Some(1), say!("Manual")),
        (Some(2), say!("Adaptive")),
    ];
    let now = match document.division {
        _ if present == 0 => None,
        Division::Even => Some(0),
        Division::Given => Some(1),
        Division::Adaptive(_) => Some(2),
    };
    let chosen = ui.row(|ui| {
        let chosen = ui.segmented(&kinds, now);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.question(help::REGION);
        });
        chosen
    });
    match chosen.flatten() {
        Some(0) => workbench.edits(move |document| document.divide(number)),
        Some(1) if present > 0 => workbench.then(|bench| bench.replace(Document::keep_regions)),
        Some(1) => workbench.edits(Document::regions_of_session),
        Some(_) => workbench.then(Workbench::adapt),
        None => {}
    }
    match &document.division {
        Division::Even => evenly(ui, number, workbench),
        Division::Given => ui.hint(say!("Drag a boundary on the plot, or type it")),
        Division::Adaptive(decision) => ui.hint(decision.describe(workbench.units())),
    }
}

fn evenly(ui: &mut Ui, before: usize, workbench: &Workbench) {
    let mut number = before;
    let field = DragValue::new(&mut number)
        .range(1..=MOST_EVEN)
        .speed(0.1)
        .suffix(if before == 1 {
            say!(in "unit", " region")
        } else {
            say!(in "unit", " regions")
        });
    ui.cell_number(say!("Number of regions"), "", 110.0, field);
    if number != before {
        workbench.edits(move |document| document.divide(number));
    }
}

/// Whether regions were made or changed here, by hand.
fn are_by_hand(workbench: &Workbench) -> bool {
    let document = workbench.document();
    let own = &document.loaded_session.session.regions;
    document.division == Division::Given && own[..] != document.regions[..]
}

/// There are no regions, and what that means.
fn none(ui: &mut Ui, workbench: &Workbench) {
    let range =
        crate::sessions::division::range_to_divide(&workbench.loaded_session().session).ok();
    ui.hint(if range.is_some() {
        say!(
            "There are no regions: nothing is corrected by region. Divide the range evenly, or where the data ask for it"
        )
    } else {
        say!(
            "There are no regions, because all samples are at one angle: there is no range to divide. Give the joint its limits in Session, or measure at other angles. The full model in Identify needs no regions"
        )
    });
}

/// What no region covers.
fn left_out(ui: &mut Ui, workbench: &Workbench, outside: usize) {
    let regions = &workbench.document().regions;
    let gaps = regions::gaps(regions, workbench.loaded_session().travel());
    if let Some((from, to)) = gaps.first() {
        let units = workbench.units();
        let gap = format!("{} … {}", units.angle(*from), units.angle(*to));
        let more = match gaps.len() {
            1 => gap,
            n => say!("{first} and {more} more", first = gap, more = n - 1),
        };
        ui.hint(say!("{more}: in no region", more));
    }
    if outside > 0 {
        ui.hint(say!(
            one "{count} sample is in no region and gets no correction",
            "{count} samples are in no region and get no correction",
            count = outside
        ));
    }
}

pub(super) fn next(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    let regional = document.identified && document.method == Method::Regional;
    let possible = workbench.loaded_session().single_revolute() && !document.regions.is_empty();
    // A diagnosis replaces what is identified by region: only to who has made regions is it the next thing.
    let wanted = are_by_hand(workbench) && !document.identified;
    if possible && !regional {
        let text = say!("Identify by region");
        let button = if wanted {
            ui.primary(text)
        } else {
            ui.secondary(text)
        };
        button.does(workbench, |bench| bench.identify(Some(Method::Regional)));
        if wanted {
            return;
        }
    }
    actions::go_on(ui, workbench, Step::Identify);
}

/// Widths of a name, of a number of samples at least, and of what can be done; the ends share what is left.
const COLUMNS: [f32; 3] = [38.0, 36.0, 26.0];
/// Narrowest and widest field for an end: all digits that a boundary is shown with.
const END: [f32; 2] = [54.0, 76.0];
/// Between the columns.
const GAP: f32 = 5.0;
const HEIGHT: f32 = 24.0;
/// More regions than this are too many to be listed with fields.
const MOST_LISTED: usize = 60;

fn rows(ui: &mut Ui, workbench: &Workbench, counts: &[Count]) {
    let regions = &workbench.document().regions;
    let unit = workbench.units().angle_name().trim();
    let [name_wide, number, menu] = COLUMNS;
    let font = FontId::proportional(size::SMALL);
    let number = number.max(widgets::width_of(ui, say!("samples"), font));
    let rest = ui.available_width() - (name_wide + number + menu + 4.0 * GAP);
    let end = (0.5 * rest).clamp(END[0], END[1]);
    ui.spacing_mut().interact_size = vec2(menu, HEIGHT);
    ui.spacing_mut().button_padding = vec2(4.0, 2.0);
    let grid = Grid::new("regions").spacing([GAP, 3.0]);
    grid.min_col_width(0.0).show(ui, |ui| {
        ui.caption(say!("name"));
        ui.caption(&say!("from, {unit}", unit));
        ui.caption(&say!("to, {unit}", unit));
        ui.caption(say!("samples"));
        ui.end_row();
        for (k, region) in regions.iter().enumerate().take(MOST_LISTED) {
            name(ui, k, &region.name, workbench);
            for which in [End::From, End::To] {
                angle(ui, end, workbench, (k, which));
            }
            samples(ui, workbench, k, counts[k]);
            more(ui, regions, k, workbench);
            ui.end_row();
        }
    });
    for (region, count) in regions.iter().zip(counts).take(MOST_LISTED) {
        if let Some(says) = few(*count) {
            session::finding(ui, Severity::Warning, |ui| {
                ui.label(RichText::new(of(region, &says)).small());
            });
        }
    }
    if regions.len() > MOST_LISTED {
        ui.hint(say!("and {more} more", more = regions.len() - MOST_LISTED));
    }
}

/// A part of a region, by name, for those who do not see where it stands.
fn of(region: &Region, what: &str) -> String {
    let region = say!("region {name}", name = region.name);
    format!("{region}: {what}")
}

/// What can be done with a region.
fn more(ui: &mut Ui, regions: &[Region], k: usize, workbench: &Workbench) {
    let next = regions::next_to(regions, k).map(|_| k);
    let first = next.or_else(|| regions::before(regions, k)).unwrap_or(k);
    let menu = ui.menu_button("…", |ui| {
        ui.set_min_width(180.0);
        ui.button(say!("Split in half"))
            .does(workbench, move |bench| bench.edit(|d| d.split(k)));
        ui.button(say!("Merge with neighbour"))
            .does(workbench, move |bench| bench.edit(|d| d.join(first)));
        ui.button(say!("Delete"))
            .does(workbench, move |bench| bench.edit(|d| d.delete(k)));
    });
    widgets::label(&menu.response, of(&regions[k], say!("Edit")));
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

fn name(ui: &mut Ui, region: usize, name: &str, workbench: &Workbench) {
    let says = of(&workbench.document().regions[region], say!("name"));
    let size = vec2(COLUMNS[0], HEIGHT);
    if let Some(text) = widgets::text_when_complete(ui, &says, name, size) {
        workbench.edits(move |document| document.rename(region, &text));
    }
}

/// The number of an end. It stops at its neighbours, as a boundary that is dragged does.
fn angle(ui: &mut Ui, width: f32, workbench: &Workbench, (k, end): (usize, End)) {
    let (regions, units) = (&workbench.document().regions, workbench.units());
    let (end_says, at_rad) = match end {
        End::From => (say!("from"), regions[k].from_rad),
        End::To => (say!("to"), regions[k].to_rad),
    };
    let name = of(&regions[k], end_says);
    let within = workbench.loaded_session().travel();
    let boundary = regions::at_end(regions, k, end);
    let room = boundary.and_then(|b| Some((b, regions::allowed_range(regions, b, within)?)));
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
    ui.cell_number(&name, units.angle_name().trim(), width, field);
    let to_rad = value / units.angle_value(1.0);
    if value != before {
        workbench.edits(move |document| document.move_boundary(boundary, to_rad));
    }
}

/// The number of samples; pressed, it shows them.
fn samples(ui: &mut Ui, workbench: &Workbench, k: usize, count: Count) {
    let region = &workbench.document().regions[k];
    let number = RichText::new(count.all.to_string());
    let room = [COLUMNS[1], HEIGHT];
    if count.all == 0 {
        let warning = Palette::of(ui).warning;
        ui.add_sized(room, egui::Label::new(number.color(warning)));
        return;
    }
    let response = ui.add_sized(room, egui::Link::new(number));
    let says = say!(one "{count} sample", "{count} samples", count = grouped(count.all));
    widgets::label(&response, of(region, &says));
    if response.clicked() {
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
