//! Region boundaries that the hand moves: real widgets on top of the plot. They can be dragged,
//! focused with the tabulator and moved with the arrow keys; a screen reader sees sliders.

use egui::accesskit::{Action, ActionData};
use egui::{
    CursorIcon, EventFilter, Key, Rect, Response, Role, Sense, Stroke, Ui, Vec2, WidgetInfo, pos2,
};
use egui_plot::{PlotPoint, PlotTransform};

use crate::gui::core::boundaries::{self, SNAP_DEG};
use crate::gui::core::by_angle::RegionContents;
use crate::gui::core::edit::Edit;
use crate::gui::style::{Palette, size, strong};
use crate::gui::workbench::{Command, Workbench};
use crate::present::numbers::grouped;
use crate::present::units::Units;
use crate::units::{deg_from_rad, rad_from_deg};

use super::layout::{HANDLE, around, freest};
use super::model::Dial;

/// Size of a handle, points: large enough for a finger.
const SIZE: f32 = 22.0;
/// Steps of the keyboard: with and without shift.
const STEPS_DEG: (f64, f64) = (5.0, SNAP_DEG);

/// Shows a handle for every boundary and sends what the hand does with it.
pub(crate) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    dial: &Dial,
    transform: &PlotTransform,
    commands: &mut Vec<Command>,
) {
    let document = workbench.document();
    let within = document.loaded_session.travel();
    for (index, boundary) in boundaries::boundaries(&document.regions).iter().enumerate() {
        let [x, y] = dial.at(boundary.at_rad, HANDLE * dial.radius_mm);
        let centre = transform.position_from_point(&PlotPoint::new(x, y));
        if !transform.frame().contains(centre) {
            continue;
        }
        let rect = Rect::from_center_size(centre, Vec2::splat(SIZE));
        let id = ui.scope_id().with(("boundary", index));
        let response = ui
            .interact(rect, id, Sense::click_and_drag())
            .on_hover_cursor(CursorIcon::Grab);
        let at_deg = deg_from_rad(boundary.at_rad);
        response.widget_info(|| {
            let label = say!(
                "boundary at {at}",
                at = workbench.units().angle(boundary.at_rad)
            );
            let mut info = WidgetInfo::slider(ui.is_enabled(), at_deg, label);
            info.role = Role::Slider;
            info
        });
        let room = boundaries::allowed_range(&document.regions, index, within);
        if let Some((low, high)) = room {
            ui.ctx().accesskit_node_builder(id, |node| {
                node.set_min_numeric_value(deg_from_rad(low));
                node.set_max_numeric_value(deg_from_rad(high));
                node.set_numeric_value_step(SNAP_DEG);
                node.add_action(Action::SetValue);
                node.add_action(Action::Increment);
                node.add_action(Action::Decrement);
            });
        }
        if response.drag_started() || response.clicked() {
            response.request_focus();
        }
        if response.dragged()
            && let Some(pointer) = response.interact_pointer_pos()
        {
            let point = transform.value_from_position(pos2(pointer.x, pointer.y));
            let angle = dial.angle_of([point.x, point.y], boundary.at_rad);
            let to = boundaries::snapped_rad(angle);
            commands.push(Command::Drag(Edit::MoveBoundary(index, to)));
        }
        if response.drag_stopped() {
            commands.push(Command::EndDrag);
        }
        if let Some(to_deg) = moved_by_keys(ui, &response, at_deg) {
            let to = rad_from_deg(to_deg);
            commands.push(Command::Edit(Edit::MoveBoundary(index, to)));
        }
        paint(ui, &response);
        if response.dragged() || response.has_focus() {
            let sides = [boundary.joint.below, boundary.joint.above];
            badge(ui, workbench, (at_deg, sides), centre, *transform.frame());
        }
        response.on_hover_text(say!(
            "drag, or press the arrow keys; shift takes larger steps"
        ));
    }
}

fn moved_by_keys(ui: &Ui, response: &Response, at_deg: f64) -> Option<f64> {
    let mut steps = 0.0;
    let mut step_deg = STEPS_DEG.1;
    if response.has_focus() {
        ui.memory_mut(|memory| {
            let filter = EventFilter {
                horizontal_arrows: true,
                vertical_arrows: true,
                ..EventFilter::default()
            };
            memory.set_focus_lock_filter(response.id, filter);
        });
        ui.input(|input| {
            let presses = |key: Key| input.num_presses(key) as f64;
            steps += presses(Key::ArrowUp) + presses(Key::ArrowRight);
            steps -= presses(Key::ArrowDown) + presses(Key::ArrowLeft);
            if input.modifiers.shift {
                step_deg = STEPS_DEG.0;
            }
        });
    }
    let asked = ui.input(|input| {
        steps += input.num_accesskit_action_requests(response.id, Action::Increment) as f64;
        steps -= input.num_accesskit_action_requests(response.id, Action::Decrement) as f64;
        let values = input.accesskit_action_requests(response.id, Action::SetValue);
        values
            .filter_map(|request| match request.data {
                Some(ActionData::NumericValue(value)) => Some(value),
                _ => None,
            })
            .last()
    });
    asked.or_else(|| (steps != 0.0).then_some(at_deg + steps * step_deg))
}

fn paint(ui: &Ui, response: &Response) {
    let palette = Palette::of(ui);
    let busy = response.hovered() || response.dragged() || response.has_focus();
    let fill = if busy {
        palette.accent
    } else {
        palette.surface
    };
    let painter = ui.painter();
    let radius = if busy { 7.5 } else { 6.0 };
    let edge = Stroke::new(2.0, palette.accent);
    painter.circle(response.rect.center(), radius, fill, edge);
    if response.has_focus() {
        let ring = Stroke::new(1.5, palette.accent);
        painter.circle_stroke(response.rect.center(), radius + 3.5, ring);
    }
}

/// Where a boundary is, and what follows for the regions beside it, at once: the whole answer takes
/// its time with many samples, the sums of a region do not.
fn badge(
    ui: &Ui,
    workbench: &Workbench,
    (at_deg, sides): (f64, [Option<usize>; 2]),
    handle: egui::Pos2,
    frame: Rect,
) {
    let loaded_session = workbench.loaded_session();
    let few = loaded_session.len() <= crate::gui::core::scale::FEW;
    let totals = loaded_session.region_totals_if_made();
    let totals = totals.or_else(|| few.then(|| loaded_session.region_totals()));
    let palette = Palette::of(ui);
    let regions = &workbench.document().regions;
    let held = totals.map(|totals| totals.held(regions));
    let font = egui::FontId::proportional(size::SMALL);
    let line = |region: usize| {
        let name = regions.get(region).map_or("", |r| r.name.as_str());
        let says = describe(name, held.as_ref()?.get(region)?, workbench.units());
        Some(
            ui.painter()
                .layout_no_wrap(says, font.clone(), palette.text),
        )
    };
    let angle = ui.painter().layout_no_wrap(
        workbench.units().angle(rad_from_deg(at_deg)),
        strong(size::BODY),
        palette.accent,
    );
    let followed = sides.into_iter().flatten().filter_map(line);
    let lines: Vec<_> = std::iter::once(angle).chain(followed).collect();
    let wide = lines.iter().map(|l| l.size().x).fold(0.0, f32::max);
    let high: f32 = lines.iter().map(|l| l.size().y).sum();
    let room = Vec2::new(wide + 14.0, high + 8.0);
    let places = around(handle, room, 22.0);
    let Some(place) = freest(&places, frame, &[]) else {
        return;
    };
    let painter = ui.painter();
    let edge = Stroke::new(1.0, palette.line);
    painter.rect(place, 4.0, palette.surface, edge, egui::StrokeKind::Inside);
    let mut at = place.min + Vec2::new(7.0, 4.0);
    for line in lines {
        let next = at.y + line.size().y;
        painter.galley(at, line, palette.text);
        at.y = next;
    }
}

/// A region in a line.
fn describe(name: &str, held: &RegionContents, units: Units) -> String {
    match held.correction() {
        None => say!("{name}: no samples", name),
        Some((theta_rad, l1_mm, left_mm)) => say!(
            "{name}: {samples}, Δθ {theta}, Δl1 {l1}, left {left}",
            name,
            samples = say!(one "{count} sample", "{count} samples", count = grouped(held.samples)),
            theta = units.angle(theta_rad),
            l1 = units.length(l1_mm),
            left = units.length(left_mm)
        ),
    }
}
