//! Region boundaries that the hand moves: real widgets on top of the plots. They can be dragged,
//! focused with the tabulator and moved with the arrow keys; a screen reader sees sliders.

use egui::accesskit::{Action, ActionData};
use egui::{
    CursorIcon, EventFilter, Id, Key, Pos2, Rect, Response, Role, Sense, Stroke, Ui, Vec2,
    WidgetInfo,
};

use crate::gui::core::regions::{self, SNAP_DEG};
use crate::gui::style::Palette;
use crate::gui::workbench::Workbench;
use crate::units::{deg_from_rad, rad_from_deg};

/// Size of a handle, points: large enough for a finger.
const SIZE: f32 = 22.0;
/// Steps of the keyboard: with and without shift.
const STEPS_DEG: (f64, f64) = (5.0, SNAP_DEG);

/// Where the handles of a plot are, and what angle a place on it is, near another angle; rad.
pub(crate) struct Handles<'a> {
    pub(crate) at: &'a dyn Fn(f64) -> Pos2,
    pub(crate) angle: &'a dyn Fn(Pos2, f64) -> f64,
    pub(crate) frame: Rect,
    /// What a screen reader calls the handle of a boundary at this angle.
    pub(crate) name: fn(String) -> String,
}

fn id(ui: &Ui, index: usize) -> Id {
    ui.scope_id().with(("boundary", index))
}

/// Gives a press on a handle to that handle. egui gives it to what the pointer is on by the time of the frame, and a
/// quick hand has left the handle by then, so that the plot would be moved. To be asked before the plot is shown.
pub(crate) fn grab(ui: &Ui, workbench: &Workbench) {
    let press = ui.input(|i| {
        let (from, to) = (i.pointer.press_origin()?, i.pointer.latest_pos()?);
        i.pointer.primary_pressed().then_some((from, to))
    });
    let Some((from, to)) = press else { return };
    let count = regions::boundaries(&workbench.document().regions).len();
    let left = |id: &Id| {
        let rect = ui.ctx().read_response(*id).map(|handle| handle.rect);
        rect.is_some_and(|rect| rect.contains(from) && !rect.contains(to))
    };
    let mut handles = (0..count).map(|index| id(ui, index));
    if ui.ctx().layer_id_at(from) == Some(ui.layer_id())
        && let Some(handle) = handles.find(left)
    {
        ui.ctx().set_dragged_id(handle);
    }
}

/// Shows a handle for every boundary and sends what the hand does with it.
pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, handles: &Handles<'_>) {
    let document = workbench.document();
    let within = document.loaded_session.travel();
    for (index, boundary) in regions::boundaries(&document.regions).iter().enumerate() {
        let centre = (handles.at)(boundary.at_rad);
        if !handles.frame.contains(centre) {
            continue;
        }
        let rect = Rect::from_center_size(centre, Vec2::splat(SIZE));
        let id = id(ui, index);
        let response = ui
            .interact(rect, id, Sense::click_and_drag())
            .on_hover_cursor(CursorIcon::Grab);
        let at_deg = deg_from_rad(boundary.at_rad);
        response.widget_info(|| {
            let label = (handles.name)(workbench.units().angle(boundary.at_rad));
            let mut info = WidgetInfo::slider(ui.is_enabled(), at_deg, label);
            info.role = Role::Slider;
            info
        });
        let room = regions::allowed_range(&document.regions, index, within);
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
            let to = regions::snapped_rad((handles.angle)(pointer, boundary.at_rad));
            workbench.edits(phrase!("move boundary"), move |document| {
                document.move_boundary(index, to)
            });
        }
        if let Some(to_deg) = moved_by_keys(ui, &response, at_deg) {
            let to = rad_from_deg(to_deg);
            workbench.edits(phrase!("move boundary"), move |document| {
                document.move_boundary(index, to)
            });
        }
        paint(ui, &response);
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
