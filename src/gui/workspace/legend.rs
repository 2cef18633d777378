//! The scale of the vectors, what marks and colours mean, and what is not shown: in rows above the
//! plot, so that nothing of it ever covers what was measured, however small the plot is.

use egui::{
    Align2, Color32, FontId, Link, Painter, Popup, PopupCloseBehavior, Pos2, Rect, RichText,
    Stroke, Ui, Vec2, pos2, vec2,
};
use egui_plot::PlotTransform;

use crate::gui::layers::{OUTLINE, scale_at};
use crate::gui::plots::marks;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::view::Colouring;
use crate::gui::workbench::Workbench;
use crate::numeric::single;
use crate::present::numbers::trimmed;

use super::drawn::SQUARE;
use super::layout;
use super::model::Scene;
use super::polar::Polar;
use super::robot::Drawn;
use super::scales::{self, HIGH, entry};

/// The longest that the scale's arrow gets, points.
const LONGEST_SCALE: f64 = 52.0;
/// Room for the arrow and its length in words, points.
const SCALE: f32 = 116.0;
/// A mark of the legend.
#[derive(Clone, Copy)]
enum Sign {
    Line(Color32, f32),
    Dashes(Color32),
    Disc(Color32),
    /// Filled with what colour says.
    Filled(Color32),
    Ring(Color32),
    /// What it is filled with, and its edge.
    Diamond(Color32, Color32),
    Triangle(f64),
    Tube,
    Band(Color32),
    /// As wide as it is drawn, points.
    Square(Color32, f32),
}

impl Sign {
    fn paint(self, painter: &Painter, at: Pos2, palette: &Palette) {
        let half = vec2(7.0, 0.0);
        let ends = [at - half, at + half];
        match self {
            Self::Line(color, width) => {
                painter.line_segment(ends, Stroke::new(width, color));
            }
            Self::Dashes(color) => {
                let stroke = Stroke::new(1.25, color);
                painter.extend(egui::Shape::dashed_line(&ends, stroke, 4.0, 2.5));
            }
            Self::Disc(color) => {
                painter.add(marks::disc(at, 2.8, color));
            }
            Self::Filled(color) => {
                let edge = Stroke::new(OUTLINE, palette.text);
                painter.add(marks::pointing(at, 4.0, 0.0, color, edge));
            }
            Self::Ring(color) => {
                painter.add(marks::ring(at, 3.4, Stroke::new(1.2, color)));
            }
            Self::Diamond(fill, color) => {
                let edge = Stroke::new(1.4, color);
                painter.add(marks::diamond(at, 4.2, fill, edge));
            }
            Self::Triangle(side) => {
                let edge = Stroke::new(1.2, palette.muted);
                painter.add(marks::pointing(at, 3.4, side, Color32::TRANSPARENT, edge));
            }
            Self::Tube => {
                for (width, color) in [(7.0, palette.nominal), (4.5, palette.surface)] {
                    painter.line_segment(ends, Stroke::new(width, color));
                }
            }
            Self::Band(color) => {
                let rect = Rect::from_center_size(at, vec2(14.0, 8.0));
                painter.rect_filled(rect, 1.0, color.gamma_multiply(0.3));
            }
            Self::Square(color, width) => {
                let rect = Rect::from_center_size(at, Vec2::splat(width));
                painter.rect_filled(rect, 0.0, color);
            }
        }
    }
}

fn sign(ui: &mut Ui, name: &str, sign: Sign, palette: &Palette) {
    let room = entry(ui, 14.0, name, palette);
    sign.paint(ui.painter(), room.center(), palette);
}

fn note(ui: &mut Ui, says: &str, palette: &Palette) {
    entry(ui, 0.0, says, palette);
}

fn rows(ui: &mut Ui, contents: impl FnOnce(&mut Ui)) {
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = vec2(10.0, 1.0);
        ui.spacing_mut().interact_size.y = HIGH;
        ui.horizontal_wrapped(contents);
    });
}

/// The rows over a plot of the plane. Where the scale of the vectors goes: its length is known only
/// when the plot is.
pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    scene: &Scene,
    robot: Option<&Drawn>,
    notes: &[String],
    palette: &Palette,
) -> Option<Rect> {
    let mut scale = None;
    let measured = !workbench.subject().is_empty();
    let low = ui.available_height() < LOW;
    let marks = |ui: &mut Ui| {
        if measured {
            meanings(ui, workbench, scene, palette);
        }
        // Whether somebody points at a sample or not: nothing moves under the pointer.
        if let Some(robot) = robot {
            sign(ui, say!("robot"), Sign::Tube, palette);
            match &robot.real {
                Some(real) if real.identified => {
                    sign(
                        ui,
                        say!("identified"),
                        Sign::Line(palette.after, 2.5),
                        palette,
                    );
                }
                Some(_) => sign(
                    ui,
                    say!("as measured"),
                    Sign::Line(palette.before, 2.5),
                    palette,
                ),
                None => {}
            }
        }
    };
    rows(ui, |ui| {
        if measured {
            scale = Some(entry(ui, SCALE, "", palette));
        }
        if !low {
            marks(ui);
        }
        scales::show(ui, scene, workbench, low, palette);
        if low {
            folded(ui, marks);
        }
        for says in notes {
            note(ui, says, palette);
        }
    });
    scale
}

/// A plot that would be lower than this has its marks explained behind a button, points.
pub(super) const LOW: f32 = 330.0;

/// A word that shows what the marks mean when it is pressed.
fn folded(ui: &mut Ui, marks: impl FnOnce(&mut Ui)) {
    let word = RichText::new(say!("legend")).size(size::SMALL);
    let word = ui.add(Link::new(word));
    Popup::menu(&word)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .show(|ui| {
            ui.set_max_width(160.0);
            ui.spacing_mut().item_spacing = vec2(10.0, 1.0);
            marks(ui);
        });
}

/// The scale's arrow, where there is room for it.
pub(super) fn scale(
    ui: &Ui,
    room: Rect,
    scene: &Scene,
    transform: &PlotTransform,
    workbench: &Workbench,
    palette: &Palette,
) {
    let units = workbench.units();
    let points_per_mm = transform.dpos_dvalue_x().abs();
    let mm = layout::scale_mm(scene.magnification, points_per_mm, LONGEST_SCALE);
    let long = single(mm * scene.magnification * points_per_mm);
    let color = if scene.look.colouring != Colouring::State {
        palette.muted
    } else if scene.look.answered && scene.look.blend > 0.0 {
        palette.after
    } else {
        palette.before
    };
    let from = pos2(room.left(), room.center().y);
    let mut shapes = Vec::new();
    let stroke = Stroke::new(2.0, color);
    marks::arrow(&mut shapes, from, from + vec2(long, 0.0), stroke);
    ui.painter().extend(shapes);
    let says = format!(
        "{} {}",
        trimmed(units.length_value(mm), 6),
        units.length_name()
    );
    ui.painter().text(
        from + vec2(long + 8.0, 0.0),
        Align2::LEFT_CENTER,
        says,
        FontId::proportional(size::SMALL),
        palette.text,
    );
}

/// What the marks mean.
fn meanings(ui: &mut Ui, workbench: &Workbench, scene: &Scene, palette: &Palette) {
    if !scene.paths_mm.is_empty() {
        sign(
            ui,
            say!("nominal path"),
            Sign::Line(palette.nominal, 1.25),
            palette,
        );
    }
    if scene.look.ghosts() {
        let faint = palette.before.gamma_multiply(0.5);
        sign(ui, say!("before"), Sign::Line(faint, 1.5), palette);
        sign(ui, say!("after"), Sign::Line(palette.after, 1.8), palette);
    }
    // Where colour says something else, shape alone says what is within the tolerance.
    let colouring = scene.look.colouring;
    let plain = colouring == Colouring::State;
    let middle = scale_at(colouring, palette, 0.5);
    let disc = |color| {
        if plain {
            Sign::Disc(color)
        } else {
            Sign::Filled(middle)
        }
    };
    if workbench.document().tolerance_mm.is_some() {
        let inner = if plain { palette.surface } else { middle };
        sign(ui, say!("within"), disc(palette.within), palette);
        sign(
            ui,
            say!("outside"),
            Sign::Diamond(inner, palette.outside),
            palette,
        );
    } else {
        sign(ui, say!("measured"), disc(palette.text), palette);
    }
    if !scene.over.is_empty() {
        let square = Sign::Square(middle, SQUARE);
        sign(ui, say!("poses over the joints’ ranges"), square, palette);
    }
}

/// The rows over the polar view.
pub(super) fn polar(ui: &mut Ui, workbench: &Workbench, polar: &Polar, palette: &Palette) {
    let answered = workbench.answer().is_some();
    let only_after = workbench.view().only_after && answered;
    let many = workbench.around().is_some();
    let low = ui.available_height() < LOW;
    let marks = |ui: &mut Ui| {
        sign(
            ui,
            say!("nominal circle"),
            Sign::Line(palette.nominal, 1.75),
            palette,
        );
        if !only_after {
            sign(ui, say!("before"), Sign::Ring(palette.before), palette);
        }
        if answered {
            sign(ui, say!("after"), Sign::Disc(palette.after), palette);
        }
        if !many {
            if !only_after {
                sign(
                    ui,
                    say!("mean before"),
                    Sign::Dashes(palette.before),
                    palette,
                );
            }
            if answered {
                sign(
                    ui,
                    say!("mean after"),
                    Sign::Line(palette.after, 1.5),
                    palette,
                );
            }
        }
        if polar.spots.iter().any(|s| s.side != 0.0) {
            sign(ui, say!("moving positive"), Sign::Triangle(1.0), palette);
            sign(ui, say!("negative"), Sign::Triangle(-1.0), palette);
        }
        if polar.tolerance_mm.is_some() {
            sign(ui, say!("tolerance"), Sign::Band(palette.within), palette);
        }
    };
    rows(ui, |ui| {
        let says = super::polar::scale(polar, workbench.units());
        note(ui, &says, palette);
        if low {
            folded(ui, marks);
        } else {
            marks(ui);
        }
        if many {
            note(
                ui,
                say!("from the smallest to the largest at each angle"),
                palette,
            );
        }
    });
}
