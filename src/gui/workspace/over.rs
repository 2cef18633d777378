//! What a plane and space have in common around their samples: the scale of the vectors above them, for
//! whose length it is told over how many points they are drawn; and the robot's values on a card beside its
//! tool, away from the crowd.

use egui::text::{LayoutJob, TextFormat};
use egui::{FontId, Pos2, Rect, Response, Stroke, Ui, Vec2, vec2};

use crate::gui::cache::cloud::Cloud;
use crate::gui::scene::paint::Camera;
use crate::gui::style::{Palette, size};
use crate::gui::workbench::Workbench;
use crate::present::numbers::trimmed;

use super::layout;
use super::legend::{self, Notes};
use super::model::{Shown, shown};
use super::pointer::{hover, under};
use super::robot::Drawn;

/// Samples that are looked at: the cloud's order shows the whole in every beginning.
const SOME: usize = 500;

/// What a plane and space show alike: samples and robot, what is said of them, and where there is room for the scale.
pub(super) struct Seen {
    pub(super) shown: Shown,
    pub(super) robot: Option<Drawn>,
    notes: Notes,
    scale: Option<Rect>,
}

impl Seen {
    /// As the workbench has it, with the rows over the plot.
    pub(super) fn of(ui: &mut Ui, workbench: &Workbench) -> Self {
        let (shown, robot) = (Shown::of(workbench), Drawn::of(workbench));
        let notes = Notes::recall(ui, &shown);
        let scale = legend::show(ui, workbench, &shown, robot.as_ref(), &notes.lines);
        Self {
            shown,
            robot,
            notes,
            scale,
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
        self.notes.keep(ui, &self.shown, camera.transform());
        show(ui, workbench, self, camera);
        let under = pointer.and_then(|at| under(workbench, &self.shown, camera, at));
        hover(response, workbench, under);
    }
}

fn show(ui: &mut Ui, workbench: &Workbench, seen: &Seen, camera: &Camera) {
    let all = &seen.shown;
    if let Some(room) = seen.scale {
        // The legend stands above the plot.
        let mut above = ui.new_child(egui::UiBuilder::new().max_rect(room));
        above.set_clip_rect(room.expand(40.0));
        legend::scale_in(&above, room, workbench, all, camera);
    }
    let Some(robot) = &seen.robot else {
        return;
    };
    let view = &workbench.view;
    // Only needed where something is written.
    let crowd = if view.selected.is_some() && view.hovered.is_none() {
        vector_points(workbench, all, camera)
    } else {
        Vec::new()
    };
    let written = robot.asked_for && view.hovered.is_none();
    values(ui, camera, robot, written, &crowd, &Palette::of(ui));
}

/// Points on the vectors of some samples, so many that a crowd is seen.
fn vector_points(workbench: &Workbench, all: &Shown, camera: &Camera) -> Vec<Pos2> {
    let loaded_session = workbench.loaded_session();
    let cloud = Cloud::of(loaded_session);
    let samples = cloud.samples.iter().take(SOME);
    let points = samples.flat_map(|sample| {
        let sample = *sample as usize;
        let (at, e) = (loaded_session.measured(sample), shown(workbench, sample));
        [0.0, 0.5, 1.0].map(|part| {
            let more = part * (all.magnification - 1.0);
            camera.at([0, 1, 2].map(|k| at[k] + more * e[k]))
        })
    });
    points
        .filter(|p| p.x.is_finite() && p.y.is_finite())
        .collect()
}

/// The joint values beside the tool, where they are least in the way; only said, not `written`,
/// where the card at the pointer has them.
fn values(
    ui: &mut Ui,
    camera: &Camera,
    drawn: &Drawn,
    written: bool,
    obstacles: &[Pos2],
    palette: &Palette,
) {
    const MOST: usize = 8;
    let says = drawn.describe();
    let frame = camera.frame();
    let chain = drawn.corners_mm.iter();
    let chain: Vec<Pos2> = chain.map(|p| camera.at(p.coords.into())).collect();
    let tool = chain.last().copied();
    let Some(tool) = tool.filter(|t| written && frame.contains(*t)) else {
        label(
            ui,
            Rect::from_min_size(frame.left_top(), Vec2::splat(1.0)),
            &says,
        );
        return;
    };
    let font = FontId::proportional(size::SMALL);
    let mut text = LayoutJob::default();
    let mut row = |words: String, color| {
        let line = if text.is_empty() {
            words
        } else {
            format!("\n{words}")
        };
        text.append(&line, 0.0, TextFormat::simple(font.clone(), color));
    };
    if let Some(sample) = drawn.sample {
        row(say!("sample {sample}", sample = sample + 1), palette.muted);
    }
    for (name, value) in drawn.values.iter().take(MOST) {
        row(format!("{name} {value}"), palette.text);
    }
    if drawn.values.len() > MOST {
        let more = drawn.values.len() - MOST;
        row(say!("and {more} more", more), palette.muted);
    }
    if let Some(real) = &drawn.real {
        let what = if real.identified {
            say!("identified")
        } else {
            say!("measured")
        };
        row(
            format!("{what} × {}", trimmed(real.times, 2)),
            palette.muted,
        );
    }
    let text = ui.painter().layout_job(text);
    let card = text.size() + vec2(12.0, 6.0);
    let places = layout::everywhere(tool, card, 16.0, frame);
    let along = |pair: &[Pos2]| {
        let (from, to) = (pair[0], pair[1]);
        (0..=8_u8).map(move |k| from.lerp(to, f32::from(k) / 8.0))
    };
    let chain: Vec<Pos2> = chain.windows(2).flat_map(along).collect();
    let Some(place) = layout::freest(&places, frame, &[obstacles, &chain, &chain, &chain]) else {
        label(ui, Rect::from_center_size(tool, Vec2::splat(1.0)), &says);
        return;
    };
    let painter = ui.painter().with_clip_rect(frame);
    painter.rect(
        place,
        4.0,
        palette.surface.gamma_multiply(0.9),
        Stroke::new(1.0, palette.line),
        egui::StrokeKind::Inside,
    );
    painter.galley(place.min + vec2(6.0, 3.0), text, palette.text);
    label(ui, place, &says);
}

/// A line for screen readers.
fn label(ui: &Ui, place: Rect, says: &str) {
    let id = ui.scope_id().with("robot");
    let response = ui.interact(place, id, egui::Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, says));
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
