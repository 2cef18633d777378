//! A scene as a sheet of its own: its title, the picture, what the signs mean, and what has to be
//! said.

use egui::{Align2, Pos2, Rect, Vec2, vec2};

use super::camera::Camera;
use super::drawing_canvas::{Paper, SCALE, width};
use super::entry::LegendEntry;
use super::items::{Label, Scene};
use super::paint::{Canvas, items, paint};
use super::tint::ColourToken;
use crate::gui::style::tokens::size;
use crate::present::chart::Axis;
use crate::present::chart::panel::Panel;
use crate::present::drawing::{self, Drawing, INK, MUTED};

/// Width and height of the picture on paper, points.
pub(crate) const SIZE: Vec2 = vec2(480.0, 360.0);
/// Height of a line of text, points.
const LINE: f32 = 12.0;
/// Between a sign and its name, and between names, points of a screen.
const BESIDE: f32 = 6.0;
const BETWEEN: f32 = 14.0;
/// Room for the numbers beside and below axes, points.
const AXES: Vec2 = vec2(38.0, 24.0);

/// What stands around a scene.
pub(crate) struct Sheet {
    pub(crate) title: String,
    /// What stands at the axes, and what they show of a mm.
    pub(crate) axes: Option<([String; 2], f64)>,
    pub(crate) legend: Vec<LegendEntry>,
    /// A line each.
    pub(crate) notes: Vec<String>,
}

impl Sheet {
    /// The rectangle of a screen whose picture has this size on paper.
    pub(crate) fn frame(size: Vec2) -> Rect {
        Rect::from_min_size(Pos2::ZERO, size / SCALE)
    }

    /// About how wide small words are, points of a screen.
    pub(crate) fn width(text: &str) -> f32 {
        width(text, size::SMALL)
    }

    /// The sheet with a scene in it.
    pub(crate) fn with(&self, scene: &Scene, camera: &Camera) -> Drawing {
        let frame = camera.frame();
        let size = SCALE * frame.size();
        let room = self.axes.as_ref().map_or(Vec2::ZERO, |_| AXES);
        let mut drawing = Drawing::new(f64::from(size.x + room.x), 0.0);
        let title = drawing::Label::new([0.0, 10.0], &self.title, 8.0, INK);
        drawing.text(title.bold());
        let corner = vec2(room.x, LINE + 6.0);
        if let Some((names, per_mm)) = &self.axes {
            let bounds = camera.transform().bounds();
            let [low, high] = [bounds.min(), bounds.max()];
            let panel = Panel {
                left: corner.x.into(),
                top: corner.y.into(),
                width: size.x.into(),
                height: size.y.into(),
                x: [low[0], high[0]].map(|mm| per_mm * mm),
                y: [low[1], high[1]].map(|mm| per_mm * mm),
            };
            let [across, upwards] = names.clone().map(Axis::numbers);
            panel.frame([&across, &upwards], [9.0, 9.0], &mut drawing);
            panel.x_label(&across.label, &mut drawing);
            panel.y_label(&upwards.label, 6.0, &mut drawing);
        }
        let mut paper = Paper {
            drawing: &mut drawing,
            frame,
            corner,
        };
        paint(scene, camera, &mut paper);
        let mut y = corner.y + size.y + room.y + 4.0;
        y = self.legend(&mut drawing, y, size.x + room.x);
        for line in &self.notes {
            y += LINE;
            let at = [0.0, f64::from(y) - 3.0];
            drawing.text(drawing::Label::new(at, line, 7.0, MUTED));
        }
        drawing.height = f64::from(y + 4.0);
        drawing
    }

    /// Signs with their names, in as many lines as it takes; where the last one ends.
    fn legend(&self, drawing: &mut Drawing, top: f32, wide: f32) -> f32 {
        let frame = Rect::from_min_size(Pos2::ZERO, vec2(wide, 8.0 * LINE) / SCALE);
        let mut paper = Paper {
            drawing,
            frame,
            corner: vec2(0.0, top),
        };
        let line = LINE / SCALE;
        let mut at = Pos2::new(0.0, 0.5 * line);
        for entry in &self.legend {
            let mut label = Label::new([0.0; 3], &entry.name, ColourToken::Muted);
            label.anchor = Align2::LEFT_CENTER;
            let size = paper.size(&label);
            let wide = entry.wide + BESIDE + size.x;
            if at.x > 0.0 && at.x + wide > frame.right() {
                at = Pos2::new(0.0, at.y + line);
            }
            let sign = at + vec2(0.5 * entry.wide, 0.0);
            items(&entry.sign, &Camera::of_signs(sign), &mut paper);
            let name = at + vec2(entry.wide + BESIDE, 0.0);
            if !entry.name.is_empty() {
                paper.words(label.anchor.anchor_size(name, size), &label);
            }
            at.x += wide + BETWEEN;
        }
        if self.legend.is_empty() {
            top
        } else {
            top + SCALE * (at.y + 0.5 * line)
        }
    }
}
