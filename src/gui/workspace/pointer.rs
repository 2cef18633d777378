//! What lies over a plot of samples: the one under the pointer and the card beside it, with what matters of it, and
//! everything once it is chosen; the robot's values on a card beside its tool; and over how many points the workspace
//! is drawn.

use egui::{
    CursorIcon, Id, Key, PopupAnchor, Pos2, Rect, Response, Role, Sense, Stroke, Tooltip, Ui, Vec2,
    WidgetInfo,
};

use crate::gui::actions::EXCLUDE;
use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::joint_value;
use crate::gui::core::regions::{self, SNAP_DEG};
use crate::gui::style::Palette;
use crate::gui::view::ViewState;
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::gui::workspace::model::{Shown, judged};
use crate::gui::workspace::pen::Camera;
use crate::gui::workspace::robot::Drawn;
use crate::gui::workspace::{fitting, legend};
use crate::present::numbers::trimmed;
use crate::units::{deg_from_rad, rad_from_deg};

/// A sample is under the pointer within this many points.
const REACH: f64 = 14.0;

/// Marks that are less than this apart on the screen stand on one another, points.
const SAME: f64 = 3.0;

/// A mark: how far it is from the pointer, points, how near to the viewer, mm, and its sample.
type Candidate = (f64, f64, usize);

/// The nearest to the pointer; of those that stand on one another there, the nearest to the viewer.
fn picked(candidates: &[Candidate]) -> Option<usize> {
    let least = candidates.iter().map(|c| c.0).fold(f64::INFINITY, f64::min);
    let there = candidates.iter().filter(|c| c.0 <= least + SAME);
    let first = |a: &&Candidate, b: &&Candidate| a.1.total_cmp(&b.1).then(b.2.cmp(&a.2));
    there.max_by(first).map(|c| c.2)
}

/// The sample within `reach` points of one in the picture. Only what is drawn is there: the first `points` of the cloud.
fn under(
    workbench: &Workbench,
    shown: &Shown,
    camera: &Camera,
    (at, (reach, points)): (Pos2, (f64, usize)),
) -> Option<usize> {
    let facing = &shown.look.facing;
    let at = camera.transform.value_from_position(at);
    let cloud = workbench.loaded_session().cloud();
    let [x, y] = facing.flat(cloud.centre_mm);
    let drawn = cloud.places.iter().zip(&cloud.samples).take(points);
    let found = drawn.filter_map(|(place, sample)| {
        let p = [0, 1, 2].map(|k| f64::from(place[k]));
        let [right, up] = facing.flat(p);
        let distance = (x + right - at.x).hypot(y + up - at.y) * camera.points_per_mm();
        (distance <= reach).then(|| (distance, facing.nearness(p), *sample as usize))
    });
    picked(&found.collect::<Vec<_>>())
}

/// Sends what is under the pointer, and says what it is.
pub(crate) fn hover(response: &egui::Response, workbench: &Workbench, under: Option<usize>) {
    if workbench.poses() {
        return;
    }
    let left = left(response, &response.ctx);
    if (response.hovered() || left) && under != workbench.view.hovered {
        workbench.then(move |bench| bench.view.hovered = under);
    }
    if response.clicked() || response.secondary_clicked() && under.is_some() {
        workbench.then(move |bench| bench.view.select(under));
    }
    if workbench.view.selected.is_some() {
        response.context_menu(|ui| drop(EXCLUDE.item(ui, workbench)));
    }
    if let Some(sample) = under.filter(|_| response.hovered()) {
        response.ctx.set_cursor_icon(CursorIcon::PointingHand);
        card(response, workbench, sample);
    }
}

/// The samples that a finding is about, no more than can be told apart.
pub(crate) fn marked(view: &ViewState, samples: usize) -> impl Iterator<Item = usize> + '_ {
    const MOST: usize = 2000;
    let there = view.marked.iter().copied().filter(move |s| *s < samples);
    there.take(MOST)
}

/// Whether the pointer has just left this widget.
fn left(response: &egui::Response, ctx: &egui::Context) -> bool {
    let id = response.id.with("was hovered");
    let now = response.hovered();
    ctx.data_mut(|data| {
        let before: bool = data.get_temp(id).unwrap_or_default();
        data.insert_temp(id, now);
        before && !now
    })
}

/// From the pointer to the card, points: a mark under the pointer is at most 14 away, and its ring
/// has a radius of 9.
const GAP: f32 = 26.0;

/// What is said of a sample, beside the pointer.
fn card(response: &Response, workbench: &Workbench, sample: usize) {
    let chosen = workbench.view.selected == Some(sample);
    let said = about(workbench, sample, chosen);
    let id = Id::unique("sample card");
    let ctx = response.ctx.clone();
    let tip = Tooltip::always_open(ctx, response.layer_id, id, PopupAnchor::Pointer);
    tip.gap(GAP).show(|ui| {
        let card = ui.scope(|ui| {
            widgets::facts(ui, &said);
        });
        let says = spoken(&said.0, &said.1);
        let info = || WidgetInfo::labeled(Role::Tooltip, true, says.clone());
        card.response.widget_info(info);
    });
}

/// The card in one line.
fn spoken(title: &str, lines: &[Line]) -> String {
    let parts: Vec<String> = lines.iter().map(|(n, v)| format!("{n} {v}")).collect();
    say!("card of {title}: {parts}", title, parts = parts.join(", "))
}

/// One line of what is said about a sample: what, and how much.
type Line = (String, String);

/// What is said about a sample: all of it, or what matters most.
fn about(workbench: &Workbench, sample: usize, all: bool) -> (String, Vec<Line>) {
    const MOST: usize = 3;
    let loaded_session = &**workbench.loaded_session();
    let units = workbench.units();
    let title = say!("sample {sample}", sample = sample + 1);
    let mut lines: Vec<Line> = Vec::new();
    let joints = &loaded_session.session.robot.joints;
    let joints = joints.iter().zip(&loaded_session.session.samples.q);
    let joints = joints.map(|(joint, q)| {
        let value = joint_value(units, joint.kind, q[sample]);
        (joint.name.clone(), value)
    });
    if all || joints.len() <= MOST {
        lines.extend(joints);
    } else {
        let values: Vec<String> = joints.map(|(_, value)| value).collect();
        lines.push((say!("joints").to_owned(), values.join(", ")));
    }
    let mut line = |name: &str, value: String| lines.push((name.to_owned(), value));
    if all {
        let came = match loaded_session.side(0, sample) {
            s if s > 0.0 => say!("approach +"),
            s if s < 0.0 => say!("approach −"),
            _ => say!("not known"),
        };
        line(say!("approached"), came.to_owned());
    }
    if !loaded_session.usable[sample] {
        line(say!("excluded"), say!("a value is missing").to_owned());
        return (title, lines);
    }
    let before = loaded_session.deviation_before(sample);
    let length = |e: [f64; 3]| units.length(loaded_session.component(e, sample, Component::Length));
    let mut shown = before;
    match workbench.answer() {
        None => line(say!("deviation"), length(before)),
        Some(answer) => {
            shown = answer.deviation_after(sample);
            line(say!("before"), length(before));
            line(say!("after"), length(shown));
        }
    }

    for component in [Component::Tangential, Component::Radial, Component::Axial] {
        let measured = !component.out_of_plane() || loaded_session.session.samples.z_mm.is_some();
        if !measured || !all && component != workbench.view.component {
            continue;
        }
        let value = loaded_session.component(shown, sample, component);
        line(component.name(), units.length(value));
    }
    if all {
        let samples = &loaded_session.session.samples;
        let conditions = [
            (say!("load"), &samples.load_kg, "kg"),
            (say!("temperature"), &samples.temperature_c, "°C"),
            (say!("time"), &samples.time_s, "s"),
        ];
        for (name, column, unit) in conditions {
            if let Some(value) = column.as_ref().map(|c| c[sample]).filter(|v| v.is_finite()) {
                line(name, format!("{} {unit}", trimmed(value, 2)));
            }
        }
        let [right, up] = workbench.facing().flat(shown);
        let direction = up.atan2(right).to_degrees();
        line(say!("direction"), format!("{}°", trimmed(direction, 0)));
    }
    if let Some(tolerance_mm) = workbench.document().tolerance_mm {
        let within = loaded_session.component(shown, sample, Component::Length) <= tolerance_mm;
        line(say!("tolerance"), judged(workbench, within).to_owned());
    }
    (title, lines)
}

/// What a plane and space show alike: samples and robot, what is said of them, and where there is room for the scale.
pub(super) struct Seen {
    pub(super) shown: Shown,
    pub(super) robot: Option<Drawn>,
    scale: Option<Rect>,
}

impl Seen {
    /// As the workbench has it, with the rows over the plot.
    pub(super) fn of(ui: &mut Ui, workbench: &Workbench) -> Self {
        let (shown, robot) = (Shown::of(workbench), Drawn::of(workbench));
        Self {
            scale: legend::show(ui, workbench, &shown, robot.is_some()),
            shown,
            robot,
        }
    }

    /// What lies over the plot, and what the pointer is on.
    pub(super) fn finish(
        &self,
        ui: &mut Ui,
        workbench: &Workbench,
        camera: &Camera,
        (response, pointer): (&Response, Option<Pos2>),
    ) {
        if let Some(room) = self.scale {
            legend::scale_in(ui, room, workbench, &self.shown, camera);
        }
        if let Some(robot) = &self.robot {
            label(ui, workbench, camera, robot);
        }
        let [points, _] = fitting::counts(&self.shown, &camera.transform);
        let within = (REACH, points);
        let under = pointer.and_then(|at| under(workbench, &self.shown, camera, (at, within)));
        hover(response, workbench, under);
    }
}

/// Where the robot's tool is, for a screen reader.
fn label(ui: &Ui, workbench: &Workbench, camera: &Camera, drawn: &Drawn) {
    let frame = camera.frame();
    let tool = drawn.corners_mm.last();
    let tool = tool.map(|p| camera.at(p.coords.into()));
    let at = tool.filter(|tool| frame.contains(*tool));
    let place = Rect::from_min_size(at.unwrap_or(frame.left_top()), Vec2::splat(1.0));
    let id = ui.scope_id().with("robot");
    let response = ui.interact(place, id, egui::Sense::hover());
    let says = drawn.describe(workbench);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &says));
}

/// The points has to be another by this share for vectors to be drawn for it.
const ANOTHER: f64 = 0.03;

/// Says over how many points the workspace is drawn where all of it is in sight, where that has changed.
pub(super) fn tell_plot_size(workbench: &Workbench, points_per_mm: f64) {
    let points = 2.0 * workbench.loaded_session().overview.radius_mm * points_per_mm;
    let known = workbench.view.plot_size;
    if points.is_finite() && points > 0.0 && (points / known - 1.0).abs() > ANOTHER {
        workbench.then(move |bench| bench.view.plot_size = points);
    }
}

// Region boundaries that the hand moves: real widgets on top of the plots. They can be dragged,
// focused with the tabulator and moved with the arrow keys; a screen reader sees sliders.

/// Size of a handle, points: large enough for a finger.
const SIZE: f32 = 22.0;
/// Steps of the keyboard: without and with shift.
const STEPS_DEG: [f64; 2] = [SNAP_DEG, 5.0];

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
pub(crate) fn boundary_handles(ui: &mut Ui, workbench: &Workbench, handles: &Handles<'_>) {
    let document = workbench.document();
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
        let label = (handles.name)(workbench.units().angle(boundary.at_rad));
        let at_deg = deg_from_rad(boundary.at_rad);
        response.widget_info(|| WidgetInfo::slider(ui.is_enabled(), at_deg, &label));
        if response.drag_started() || response.clicked() {
            response.request_focus();
        }
        let pointer = response.interact_pointer_pos();
        let pointer = pointer.filter(|_| response.dragged());
        let to = pointer.map(|at| regions::snapped_rad((handles.angle)(at, boundary.at_rad)));
        let by_keys = || Some(rad_from_deg(at_deg + moved_by_keys(ui, &response)?));
        if let Some(to) = to.or_else(by_keys) {
            workbench.edits(move |document| document.move_boundary(index, to));
        }
        paint(ui, &response);
    }
}

/// By how much the keys move it, degrees.
fn moved_by_keys(ui: &Ui, response: &Response) -> Option<f64> {
    if !response.has_focus() {
        return None;
    }
    widgets::keep_arrows(ui, response.id);
    ui.input(|input| {
        let presses = |key: Key| input.num_presses(key) as f64;
        let on = presses(Key::ArrowUp) + presses(Key::ArrowRight);
        let steps = on - presses(Key::ArrowDown) - presses(Key::ArrowLeft);
        let step = STEPS_DEG[usize::from(input.modifiers.shift)];
        (steps != 0.0).then_some(steps * step)
    })
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
}

#[cfg(test)]
mod tests {
    use crate::gui::testing::workbench;
    use crate::gui::view::Camera as View;

    use super::*;

    #[test]
    fn the_hover_names_the_sample_its_angle_and_its_deviation() {
        let workbench = workbench();
        let (title, lines) = about(&workbench, 0, true);
        assert_eq!(title, "sample 1");
        let says = |what: &str| lines.iter().any(|(name, _)| name == what);
        assert!(says("pan") && says("deviation") && says("direction") && says("tolerance"));
    }

    #[test]
    fn of_marks_on_one_another_the_nearest_to_the_viewer_is_picked() {
        let mark = |sample, distance, nearness| (distance, nearness, sample);
        assert_eq!(picked(&[]), None);
        // Two on one another, and one beside them that is nearer to the viewer still.
        let marks = [
            mark(7, 1.0, -300.0),
            mark(8, 2.5, 200.0),
            mark(9, 9.0, 900.0),
        ];
        assert_eq!(picked(&marks), Some(8));
        assert_eq!(picked(&[mark(5, 1.0, 2.0), mark(4, 1.0, 2.0)]), Some(4));
    }

    #[test]
    fn every_sample_that_is_drawn_is_found_where_it_is_from_every_side() {
        let mut workbench = workbench();
        let tilted = View::default().orbited([40.0, 25.0]);
        for camera in [View::default(), tilted] {
            workbench.execute(|bench| bench.view.look_in_space());
            workbench.execute(|bench| bench.view.camera = camera);
            let shown = Shown::of(&workbench);
            let facing = workbench.facing();
            // 100 points for a mm.
            let frame = Rect::from_center_size(Pos2::ZERO, Vec2::splat(200.0));
            let camera = Camera::showing(facing, [[-1.0; 2], [1.0; 2]], frame);
            let loaded_session = workbench.loaded_session();
            for sample in loaded_session.overview.usable.iter().map(|s| *s as usize) {
                let p = loaded_session.measured(sample);
                let all = loaded_session.len();
                let found = under(&workbench, &shown, &camera, (camera.at(p), (14.0, all)));
                let found = found.expect("it is there");
                let q = loaded_session.measured(found);
                let apart = facing.flat([0, 1, 2].map(|k| q[k] - p[k]));
                assert!(100.0 * apart[0].hypot(apart[1]) < SAME + 0.1);
                assert!(facing.nearness(q) > facing.nearness(p) - 1e-3);
            }
            let nowhere = camera.at_flat([1e5, 1e5]);
            let nowhere = under(&workbench, &shown, &camera, (nowhere, (14.0, 9)));
            assert_eq!(nowhere, None);
        }
    }
}
