//! Step 2: where the joint gets corrections of its own.

mod row;
mod rows;

use egui::{
    Align, Align2, DragValue, FontId, Layout, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use crate::gui::core::boundaries;
use crate::gui::core::by_angle::Count;
use crate::gui::core::document::{Division, Method};
use crate::gui::core::edit::Edit;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::Step;
use crate::gui::workbench::{Command, ViewChange, Workbench, of_field};
use crate::gui::{help, widgets};
use crate::numeric::single;
use crate::present::numbers::grouped;

use super::{Progress, StepView};

/// Regions that are offered when there are none: the paper's number.
const OFFERED: usize = 6;

/// More even regions than this are a slip of the keyboard.
const MOST_EVEN: usize = 360;

pub(super) const STEP: StepView = StepView {
    step: Step::Regions,
    show,
    next,
    state,
};

fn state(workbench: &Workbench) -> (String, Progress) {
    let document = workbench.document();
    if document.regions.is_empty() {
        return (say!("optional").to_owned(), Progress::Open);
    }
    let used = document.identified && document.method == Method::Regional;
    let regions =
        say!(one "{count} region", "{count} regions", count = grouped(document.regions.len()));
    let caption = if used {
        regions
    } else {
        say!("optional, {regions}", regions)
    };
    (caption, Progress::of(used))
}

fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let loaded_session = workbench.loaded_session();
    if loaded_session.is_empty() {
        widgets::hint(
            ui,
            say!(
                "Regions divide what was measured: open a session that was measured on this robot"
            ),
        );
        return;
    }
    let counts = loaded_session
        .angles()
        .by_region(&workbench.document().regions);
    division(ui, workbench, commands);
    if workbench.document().regions.is_empty() {
        none(ui, workbench);
        return;
    }
    ui.add_space(space::TIGHT);
    strip(ui, workbench, &counts);
    rows::show(ui, workbench, &counts, commands);
    left_out(ui, workbench, &counts);
}

/// How the range is divided.
fn division(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let document = workbench.document();
    let present = document.regions.len();
    let number = if present == 0 { OFFERED } else { present };
    let kinds = [
        (0, say!("Uniform")),
        (1, say!("Manual")),
        (2, say!("Adaptive")),
    ];
    let now = match document.division {
        _ if present == 0 => 3,
        Division::Even => 0,
        Division::Given => 1,
        Division::Adaptive(_) => 2,
    };
    let chosen = widgets::row(ui, |ui| {
        let chosen = widgets::segmented(ui, &kinds, now);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            widgets::question(ui, help::REGION);
        });
        chosen
    });
    match chosen {
        Some(0) => commands.push(Command::Edit(Edit::Divide(number))),
        Some(1) if present > 0 => commands.push(Command::Edit(Edit::KeepRegions)),
        Some(1) => commands.push(Command::Edit(Edit::RegionsOfSession)),
        Some(_) => commands.push(Command::Adapt),
        None => {}
    }
    match &document.division {
        Division::Even => evenly(ui, workbench, commands),
        Division::Given => {
            widgets::hint(
                ui,
                say!("Drag a boundary on the plot, or type it; the identification follows at once"),
            );
            own(ui, workbench, commands);
        }
        Division::Adaptive(decision) => {
            widgets::hint(ui, decision.describe(workbench.units()));
        }
    }
}

fn evenly(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let present = workbench.document().regions.len();
    let mut number = if present == 0 { OFFERED } else { present };
    let before = number;
    ui.horizontal(|ui| {
        let field = DragValue::new(&mut number)
            .range(1..=MOST_EVEN)
            .speed(0.1)
            .suffix(if before == 1 {
                say!(in "unit", " region")
            } else {
                say!(in "unit", " regions")
            });
        let response = widgets::cell_number(ui, say!("Number of regions"), "", 110.0, field);
        let divide = present == 0 && ui.button(say!("Divide")).clicked();
        let edit = (number != before || divide).then_some(Edit::Divide(number));
        commands.extend(of_field(&response, edit));
    });
}

/// Offers the regions that the session brings along.
fn own(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let own = &workbench.loaded_session().session.regions;
    if own.is_empty() || own[..] == workbench.document().regions[..] {
        return;
    }
    let button = ui.button(say!("Reset to session"));
    if button
        .on_hover_text(say!("take the regions that the session brings along"))
        .clicked()
    {
        commands.push(Command::Edit(Edit::RegionsOfSession));
    }
}

/// There are no regions, and what that means.
fn none(ui: &mut Ui, workbench: &Workbench) {
    let range = crate::sessions::division::range_to_divide(&workbench.loaded_session().session);
    widgets::hint(
        ui,
        if range.is_some() {
            say!(
                "There are no regions: nothing is corrected by region. Divide the range evenly, or where the data ask for it"
            )
        } else {
            say!(
                "There are no regions, because all samples are at one angle: there is no range to divide. Give the joint its limits in Session, or measure at other angles. The full model in Identify needs no regions"
            )
        },
    );
}

/// What no region covers.
fn left_out(ui: &mut Ui, workbench: &Workbench, counts: &[Count]) {
    let loaded_session = workbench.loaded_session();
    let regions = &workbench.document().regions;
    let gaps = boundaries::gaps(regions, loaded_session.travel());
    let outside = loaded_session.angles().total().all - counts.iter().map(|c| c.all).sum::<usize>();
    if let Some((from, to)) = gaps.first() {
        let units = workbench.units();
        let gap = format!("{} … {}", units.angle(*from), units.angle(*to));
        let more = match gaps.len() {
            1 => gap,
            n => say!("{gap} and {n} more", gap, n = n - 1),
        };
        let says = match outside {
            0 => say!("{more}: in no region, and no sample is there", more),
            n => say!(
                one "{more}: in no region; {count} sample there gets no correction",
                "{more}: in no region; {count} samples there get no correction",
                more,
                count = n
            ),
        };
        widgets::hint(ui, says);
    } else if outside > 0 {
        widgets::hint(
            ui,
            say!(
                one "{count} sample is in no region and gets no correction",
                "{count} samples are in no region and get no correction",
                count = outside
            ),
        );
    }
}

fn next(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let document = workbench.document();
    let regional = document.identified && document.method == Method::Regional;
    let loaded_session = workbench.loaded_session();
    let possible = loaded_session.single_revolute()
        && !loaded_session.is_empty()
        && !document.regions.is_empty();
    if possible && !regional {
        let says = say!("Optional: fills the next step, Identify, region by region");
        widgets::hint_above_the_button(ui, says);
        if widgets::primary(ui, say!("Identify by region")).clicked() {
            commands.push(Command::Edit(Edit::IdentifyBy(Method::Regional)));
        }
        return;
    }
    if widgets::primary(ui, say!("Continue to identify")).clicked() {
        commands.push(Command::View(ViewChange::GoTo(Step::Identify)));
    }
}

/// Height of the strip and of the samples in it, points.
const HEIGHT: f32 = 40.0;
const SAMPLES: f32 = 14.0;
/// Columns of samples.
const BINS: u16 = 68;

/// The range as a strip: which part belongs to which region, and where the samples are.
fn strip(ui: &mut Ui, workbench: &Workbench, counts: &[Count]) {
    let loaded_session = workbench.loaded_session();
    let (from, to) = loaded_session.travel();
    let regions = &workbench.document().regions;
    let ends = regions.iter().flat_map(|r| [r.from_rad, r.to_rad]);
    let (low, high) = ends.fold((from, to), |(a, b), end| (a.min(end), b.max(end)));
    if low >= high {
        return;
    }
    let palette = Palette::of(ui);
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT + 16.0), Sense::hover());
    let band = Rect::from_min_size(rect.min, vec2(rect.width(), HEIGHT));
    let x = |rad: f64| band.left() + band.width() * single((rad - low) / (high - low));
    let painter = ui.painter_at(rect);
    painter.rect_filled(band, 4.0, palette.inset);
    for (k, region) in regions.iter().enumerate() {
        let part = Rect::from_x_y_ranges(x(region.from_rad)..=x(region.to_rad), band.y_range());
        painter.rect_filled(part, 0.0, palette.sectors[k % 2]);
        painter.rect_filled(
            Rect::from_min_size(part.min, vec2(part.width(), 2.0)),
            0.0,
            palette.accent,
        );
        let empty = counts.get(k).is_some_and(|c| c.fitted == 0);
        if part.width() > 14.0 {
            let color = if empty { palette.warning } else { palette.text };
            let at = pos2(part.center().x, band.top() + 13.0);
            let name = if empty {
                format!("{} –", region.name)
            } else {
                region.name.clone()
            };
            let font = strong(size::SMALL);
            let galley = widgets::cut(ui, &name, font, color, part.width() - 4.0);
            let place = Align2::CENTER_CENTER.anchor_size(at, galley.size());
            painter.galley(place.min, galley, color);
        }
    }
    let width = (high - low) / f64::from(BINS);
    let bins = (0..BINS).map(|bin| {
        let start = low + f64::from(bin) * width;
        // The last one has its end in it.
        let end = if bin + 1 == BINS {
            high + 1e-9
        } else {
            start + width
        };
        loaded_session.angles().between(start, end).all
    });
    let bins: Vec<usize> = bins.collect();
    let most = bins.iter().copied().max().unwrap_or(0).max(1);
    let column = band.width() / f32::from(BINS);
    for (bin, n) in bins.iter().enumerate().filter(|(_, n)| **n > 0) {
        let height = (SAMPLES * (*n as f32 / most as f32)).max(2.0);
        let left = band.left() + column * bin as f32;
        let bar = Rect::from_min_max(
            pos2(left + 0.5, band.bottom() - 1.0 - height),
            pos2(left + column - 0.5, band.bottom() - 1.0),
        );
        painter.rect_filled(bar, 0.0, palette.nominal);
    }
    for region in regions.iter() {
        for end in [region.from_rad, region.to_rad] {
            painter.vline(x(end), band.y_range(), Stroke::new(1.0, palette.accent));
        }
    }
    let units = workbench.units();
    let font = FontId::proportional(size::SMALL);
    let label = |at: f32, align: Align2, rad: f64| {
        let place = pos2(at, band.bottom() + 9.0);
        painter.text(place, align, units.angle(rad), font.clone(), palette.muted);
    };
    label(band.left(), Align2::LEFT_CENTER, low);
    label(band.right(), Align2::RIGHT_CENTER, high);
    let says = say!(
        "{regions} from {low} to {high}, and where the samples are",
        regions = say!(one "{count} region", "{count} regions", count = grouped(regions.len())),
        low = units.angle(low),
        high = units.angle(high)
    );
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, says.clone()));
    response.on_hover_ui_at_pointer(|ui| {
        let Some(pointer) = ui.ctx().pointer_hover_pos() else {
            return;
        };
        let at = low + f64::from((pointer.x - band.left()) / band.width()) * (high - low);
        let inside = regions
            .iter()
            .position(|r| (r.from_rad..=r.to_rad).contains(&at));
        ui.label(match inside {
            Some(k) => say!(
                "region {name}, {from} … {to}: {samples}",
                name = regions[k].name,
                from = units.angle(regions[k].from_rad),
                to = units.angle(regions[k].to_rad),
                samples =
                    say!(one "{count} sample", "{count} samples", count = grouped(counts[k].all))
            ),
            None => say!("in no region").to_owned(),
        });
    });
}
