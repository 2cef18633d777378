//! The legend of colours. What colour says is said a second time: a deviation by the vector's
//! length, a direction by its direction, a condition by its width.

use egui::epaint::Mesh;
use egui::{Align2, FontId, Pos2, Rect, Shape, Stroke, Ui, pos2, vec2};

use crate::gui::commands::Workbench;
use crate::gui::layers::{WEDGE, scale_at};
use crate::gui::plots::marks;
use crate::gui::tokens::{Palette, size};
use crate::gui::units::{significant, trimmed};
use crate::gui::view::Colouring;

use super::model::Scene;

/// Length of a scale, points.
const LONG: f32 = 120.0;
/// Thickness of a scale that says nothing by it, points.
const THICK: f32 = 7.0;
/// How much thicker than the vectors a wedge is drawn.
const WEDGE_BY: f32 = 3.0;
/// Pieces of a scale.
const PIECES: u16 = 48;

/// A scale: what it is of, its ends in words, and what colour it has.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    /// What it is of.
    pub(crate) name: String,
    /// Its ends; none for directions.
    pub(crate) ends: Option<[String; 2]>,
    /// What its colour says.
    pub(crate) colouring: Colouring,
}

/// The scales that are in use.
pub(crate) fn scales(workbench: &Workbench, scene: &Scene) -> Vec<Scale> {
    let units = workbench.units();
    let colouring = scene.look.colouring;
    let heat = workbench.heat().is_some();
    let long = significant(units.length_value(scene.look.long_mm), 2);
    let lengths = |name: &str| Scale {
        name: format!("{name}, {}", units.length_name()),
        ends: Some(["0".to_owned(), format!("{long} and more")]),
        colouring: Colouring::Deviation,
    };
    let mut scales = Vec::new();
    match colouring {
        Colouring::State => {}
        Colouring::Deviation => scales.push(lengths("deviation")),
        Colouring::Direction => scales.push(Scale {
            name: "direction".to_owned(),
            ends: None,
            colouring,
        }),
        Colouring::Load | Colouring::Temperature | Colouring::Time => {
            let unit = match colouring {
                Colouring::Load => "kg",
                Colouring::Temperature => "°C",
                _ => "s",
            };
            let conditions = workbench.subject().cloud.conditions;
            let range = colouring.condition().and_then(|k| conditions[k]);
            scales.push(Scale {
                name: format!("{}, {unit}", colouring.name()),
                ends: range.map(|ends| ends.map(|end| trimmed(end, 2))),
                colouring,
            });
        }
    }
    if heat && colouring != Colouring::Deviation {
        scales.push(lengths("heat map"));
    }
    scales
}

/// Shows them at the upper right of the plot.
pub(super) fn show(ui: &Ui, frame: Rect, scene: &Scene, workbench: &Workbench, palette: &Palette) {
    let painter = ui.painter().with_clip_rect(frame);
    let font = FontId::proportional(size::SMALL);
    let mut corner = frame.right_top() + vec2(-12.0 - LONG, 10.0);
    for scale in scales(workbench, scene) {
        let rose = scale.colouring == Colouring::Direction;
        let height = if rose { 58.0 } else { 42.0 };
        let back = Rect::from_min_size(corner, vec2(LONG, height)).expand2(vec2(6.0, 4.0));
        painter.rect_filled(back, 4.0, palette.surface.gamma_multiply(0.85));
        let text = |at: Pos2, align: Align2, text: &str| {
            painter.text(at, align, text, font.clone(), palette.muted);
        };
        text(corner, Align2::LEFT_TOP, &scale.name);
        if rose {
            painter.extend(arrows(corner + vec2(0.5 * LONG, 37.0), palette));
        } else {
            let middle = corner + vec2(0.0, 21.0);
            painter.add(strip(middle, &scale, palette));
            if let Some([low, high]) = &scale.ends {
                text(corner + vec2(0.0, 28.0), Align2::LEFT_TOP, low);
                text(corner + vec2(LONG, 28.0), Align2::RIGHT_TOP, high);
            }
        }
        corner.y += height + 12.0;
    }
}

/// From little to much; a wedge where the width of vectors says the same.
fn strip(middle: Pos2, scale: &Scale, palette: &Palette) -> Shape {
    let wedge = scale.colouring.condition().is_some();
    let half = |part: f32| {
        let wide = WEDGE_BY * (WEDGE[0] + part * (WEDGE[1] - WEDGE[0]));
        0.5 * if wedge { wide } else { THICK }
    };
    let mut mesh = Mesh::default();
    for k in 0..=PIECES {
        let part = f32::from(k) / f32::from(PIECES);
        let color = scale_at(scale.colouring, palette, part);
        let x = middle.x + part * LONG;
        mesh.colored_vertex(pos2(x, middle.y - half(part)), color);
        mesh.colored_vertex(pos2(x, middle.y + half(part)), color);
        if k > 0 {
            let here = 2 * u32::from(k);
            mesh.add_triangle(here - 2, here - 1, here);
            mesh.add_triangle(here - 1, here, here + 1);
        }
    }
    Shape::mesh(mesh)
}

/// Every direction in its colour.
fn arrows(middle: Pos2, palette: &Palette) -> Vec<Shape> {
    const NUMBER: u8 = 12;
    let mut shapes = Vec::new();
    for k in 0..NUMBER {
        let part = f32::from(k) / f32::from(NUMBER);
        let (sin, cos) = (part * std::f32::consts::TAU).sin_cos();
        let along = vec2(cos, -sin);
        let color = scale_at(Colouring::Direction, palette, part);
        let stroke = Stroke::new(2.0, color);
        marks::arrow(
            &mut shapes,
            middle + 7.0 * along,
            middle + 20.0 * along,
            stroke,
        );
    }
    shapes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::commands::Command;
    use crate::gui::testing::workbench;

    #[test]
    fn every_colour_that_says_something_has_a_scale() {
        let mut workbench = workbench();
        let named = |workbench: &Workbench| {
            let scene = Scene::of(workbench);
            let names = scales(workbench, &scene).into_iter().map(|s| s.name);
            names.collect::<Vec<_>>()
        };
        assert!(named(&workbench).is_empty());
        workbench.execute(Command::Colour(Colouring::Deviation));
        assert_eq!(named(&workbench), ["deviation, mm"]);
        workbench.execute(Command::Heat(true));
        workbench.receive();
        // The same scale for both.
        assert_eq!(named(&workbench), ["deviation, mm"]);
        workbench.execute(Command::Colour(Colouring::Direction));
        assert_eq!(named(&workbench), ["direction", "heat map, mm"]);
    }

    #[test]
    fn a_condition_that_was_not_recorded_is_not_offered() {
        let mut workbench = workbench();
        workbench.execute(Command::Colour(Colouring::Temperature));
        let scene = Scene::of(&workbench);
        assert_eq!(scene.look.colouring, Colouring::State);
        assert!(scales(&workbench, &scene).is_empty());
    }
}
