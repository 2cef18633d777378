//! What a plane and space have in common around their samples: the scale of the vectors above them, for
//! whose length it is told over how many points they are drawn; and the robot's values on a card beside its
//! tool, away from the crowd.

use egui::{Pos2, Rect, Stroke, Ui, Vec2, pos2, vec2};

use crate::gui::cache::cloud::Cloud;
use crate::gui::scene::paint::Camera;
use crate::gui::style::{Palette, size};
use crate::gui::workbench::{Command, ViewChange, Workbench};
use crate::present::numbers::trimmed;

use super::layout;
use super::legend::{self, Notes};
use super::model::{Shown, shown};
use super::robot::Drawn;

/// Samples that are looked at: the cloud's order shows the whole in every beginning.
const SOME: usize = 500;

/// Shows it; `scale` is where there is room for the scale.
pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    (all, robot): (&Shown, Option<&Drawn>),
    camera: &Camera,
    (notes, scale): (Notes, Option<Rect>),
) {
    notes.keep(ui, all, camera.transform());
    if let Some(room) = scale {
        // The legend stands above the plot.
        let mut above = ui.new_child(egui::UiBuilder::new().max_rect(room));
        above.set_clip_rect(room.expand(40.0));
        legend::scale_in(&above, room, workbench, all, camera);
    }
    let Some(robot) = robot else {
        return;
    };
    let view = workbench.view();
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
    let font = egui::FontId::proportional(size::SMALL);
    let row = |text: String, color| ui.painter().layout_no_wrap(text, font.clone(), color);
    let title = drawn
        .sample
        .map(|sample| say!("sample {sample}", sample = sample + 1));
    let head = title.map(|title| row(title, palette.muted));
    let mut rows: Vec<_> = drawn
        .values
        .iter()
        .take(MOST)
        .map(|(name, value)| row(format!("{name} {value}"), palette.text))
        .collect();
    if drawn.values.len() > MOST {
        rows.push(row(
            say!("and {more} more", more = drawn.values.len() - MOST),
            palette.muted,
        ));
    }
    if let Some(real) = &drawn.real {
        let what = if real.identified {
            say!("identified")
        } else {
            say!("measured")
        };
        rows.push(row(
            format!("{what} × {}", trimmed(real.times, 2)),
            palette.muted,
        ));
    }
    rows.splice(0..0, head);
    let high: f32 = rows.iter().map(|r| r.size().y).sum();
    let wide = rows.iter().map(|r| r.size().x).fold(0.0, f32::max);
    let card = vec2(wide + 12.0, high + 6.0);
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
    let mut at = place.min + vec2(6.0, 3.0);
    for galley in rows {
        let next = at.y + galley.size().y;
        painter.galley(at, galley, palette.text);
        at = pos2(at.x, next);
    }
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
pub(super) fn tell_plot_size(
    workbench: &Workbench,
    points_per_mm: f64,
    commands: &mut Vec<Command>,
) {
    let points = 2.0 * workbench.loaded_session().overview.radius_mm * points_per_mm;
    let known = workbench.view().plot_size;
    if points.is_finite() && points > 0.0 && (points / known - 1.0).abs() > ANOTHER {
        commands.push(Command::View(ViewChange::PlotSize(points)));
    }
}
