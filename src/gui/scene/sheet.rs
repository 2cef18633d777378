//! A scene on paper: a sheet with its title, the picture, what the signs mean and what has to be said;
//! its items in the colours of the light theme, cut where it ends.

use egui::{Align, Align2, Pos2, Rect, Vec2, pos2, vec2};

use crate::gui::style::{LIGHT, size};
use crate::present::chart::panel::Panel;
use crate::present::chart::{Axis, is_wide};
use crate::present::drawing::{self, Anchor, Colour, Drawing, INK, Item, MUTED};

use super::paint::Camera;
use super::paint::{Canvas, items, paint};
use super::{ColourToken, Stroke, Tint};
use super::{Label, LegendEntry, Scene};

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

/// Points on paper for each point of the screen: lines and letters are finer there.
const SCALE: f32 = 0.64;
/// A letter of small type is about so wide, parts of its size.
const LETTER: f32 = 0.53;
/// What lets more than this through is not drawn, of 255.
const HARDLY: u8 = 12;
/// Corners of a disc.
const CORNERS: u8 = 12;

/// A part of a drawing.
pub(super) struct Paper<'a> {
    pub(super) drawing: &'a mut Drawing,
    /// What is drawn of a picture, points of a screen.
    pub(super) frame: Rect,
    /// Where its corner is on the sheet.
    pub(super) corner: Vec2,
}

impl Paper<'_> {
    fn on_sheet(&self, at: Pos2) -> [f64; 2] {
        let p = self.corner + SCALE * (at - self.frame.min);
        [p.x, p.y].map(f64::from)
    }

    fn stroke(stroke: Stroke) -> drawing::Stroke {
        let width = f64::from(SCALE * stroke.width);
        drawing::Stroke::new(width, colour(stroke.colour))
    }

    /// Neighbours of one kind are one item.
    fn lines(&mut self, lines: Vec<Vec<[f64; 2]>>, stroke: Stroke) {
        let stroke = Self::stroke(stroke);
        match self.drawing.items.last_mut() {
            Some(Item::Lines(there, of)) if *of == stroke => there.extend(lines),
            _ if lines.is_empty() => {}
            _ => self.drawing.items.push(Item::Lines(lines, stroke)),
        }
    }

    fn filled(&mut self, corners: &[Pos2], colour: Colour) {
        let corners = within(corners, self.frame);
        if corners.len() < 3 {
            return;
        }
        let area = (
            corners.into_iter().map(|p| self.on_sheet(p)).collect(),
            colour,
        );
        match self.drawing.items.last_mut() {
            Some(Item::Areas(there)) => there.push(area),
            _ => self.drawing.items.push(Item::Areas(vec![area])),
        }
    }
}

/// About how wide words of a size are, points.
fn width(text: &str, size: f32) -> f32 {
    let letter = |c: char| if is_wide(c) { 1.0 } else { LETTER };
    text.chars().map(letter).sum::<f32>() * size
}

/// The words of a label, or as many letters as it has room for.
fn cut_short(label: &Label) -> String {
    let most = label.most.unwrap_or(f32::INFINITY);
    let mut text = label.text.clone();
    while width(&text, label.size) > most && text.chars().count() > 1 {
        text.pop();
        text.pop();
        text.push('…');
    }
    text
}

/// On paper nothing shines through: it is mixed with white.
fn colour(ink: Tint) -> Colour {
    let [r, g, b, a] = ink.color(&LIGHT).to_array();
    let [r, g, b] = [r, g, b].map(|part| part.saturating_add(255 - a));
    Colour(r, g, b)
}

impl Canvas for Paper<'_> {
    fn line(&mut self, points: Vec<Pos2>, stroke: Stroke) {
        let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut last = None;
        for pair in points.windows(2) {
            let Some([from, to]) = cut([pair[0], pair[1]], self.frame) else {
                continue;
            };
            let ends = [from, to].map(|p| self.on_sheet(p));
            match lines.last_mut() {
                Some(line) if last == Some(from) => line.push(ends[1]),
                _ => lines.push(ends.to_vec()),
            }
            last = Some(to);
        }
        self.lines(lines, stroke);
    }

    fn area(&mut self, corners: Vec<Pos2>, fill: Option<Tint>, edge: Option<Stroke>) {
        if let Some(ink) = fill {
            self.filled(&corners, colour(ink));
        }
        if let Some(edge) = edge {
            let around = corners.iter().chain(corners.first()).copied().collect();
            self.line(around, edge);
        }
    }

    fn disc(&mut self, at: Pos2, radius: f32, fill: Option<Tint>, edge: Option<Stroke>) {
        let corner = |k: u8| {
            let (sin, cos) = (std::f32::consts::TAU * f32::from(k) / f32::from(CORNERS)).sin_cos();
            at + radius * vec2(cos, sin)
        };
        self.area((0..CORNERS).map(corner).collect(), fill, edge);
    }

    /// In 32 steps of each colour, so that neighbours share one.
    fn triangles(&mut self, triangles: &mut dyn Iterator<Item = ([Pos2; 3], Tint)>) {
        for (corners, ink) in triangles {
            let Colour(r, g, b) = colour(ink);
            self.filled(&corners, Colour(r | 7, g | 7, b | 7));
        }
    }

    fn net(&mut self, corners: &[(Pos2, Tint)], across: usize) {
        for here in across..corners.len() {
            // What is hardly there must not hide what is beneath.
            let there = corners[here].1.color(&LIGHT).a() > HARDLY;
            if there && here % across > 0 {
                let cell = [here, here - 1, here - across - 1, here - across];
                let cell = cell.map(|k| corners[k].0);
                self.filled(&cell, colour(corners[here].1));
            }
        }
    }

    fn size(&self, label: &Label) -> Vec2 {
        let wide = width(&cut_short(label), label.size);
        vec2(wide, 1.2 * label.size)
    }

    fn words(&mut self, place: Rect, label: &Label) {
        if !self.frame.contains(place.center()) {
            return;
        }
        let (x, anchor) = match label.anchor.x() {
            Align::Min => (place.left(), Anchor::Start),
            Align::Center => (place.center().x, Anchor::Middle),
            Align::Max => (place.right(), Anchor::End),
        };
        let at = self.on_sheet(pos2(x, place.center().y + 0.35 * label.size));
        let size = f64::from(SCALE * label.size);
        let text = drawing::Label::new(at, cut_short(label), size, colour(label.colour));
        self.drawing.text(drawing::Label {
            bold: label.bold,
            ..text.anchored(anchor)
        });
    }

    /// Shaft and sides of the head: many arrows of one colour are one path.
    fn arrow(&mut self, [tail, neck, tip]: [Pos2; 3], stroke: Stroke) {
        let half = 0.5 * (tip - neck);
        let across = vec2(-half.y, half.x);
        self.line(vec![tail, tip], stroke);
        self.line(vec![neck + across, tip, neck - across], stroke);
    }
}

/// The part of a line that is within a frame (Liang & Barsky 1984).
fn cut([from, to]: [Pos2; 2], frame: Rect) -> Option<[Pos2; 2]> {
    let (mut first, mut last) = (0.0_f32, 1.0_f32);
    for k in 0..2 {
        let along = to[k] - from[k];
        for (way, room) in [
            (-along, from[k] - frame.min[k]),
            (along, frame.max[k] - from[k]),
        ] {
            if way == 0.0 && room < 0.0 || !room.is_finite() {
                return None;
            }
            if way < 0.0 {
                first = first.max(room / way);
            } else if way > 0.0 {
                last = last.min(room / way);
            }
        }
    }
    let at = |t: f32| match t {
        0.0 => from,
        1.0 => to,
        _ => from + t * (to - from),
    };
    (first < last).then(|| [at(first), at(last)])
}

/// The part of a polygon that is within a frame (Sutherland & Hodgman 1974).
fn within(corners: &[Pos2], frame: Rect) -> Vec<Pos2> {
    let mut corners = corners.to_vec();
    for (k, sign, most) in [
        (0, -1.0, -frame.min.x),
        (0, 1.0, frame.max.x),
        (1, -1.0, -frame.min.y),
        (1, 1.0, frame.max.y),
    ] {
        let beyond = |p: &Pos2| sign * p[k] - most;
        let before = corners.clone();
        corners.clear();
        for (from, to) in before.iter().zip(before.iter().cycle().skip(1)) {
            let [a, b] = [from, to].map(beyond);
            if a <= 0.0 {
                corners.push(*from);
            }
            if (a <= 0.0) != (b <= 0.0) {
                corners.push(*from + a / (a - b) * (*to - *from));
            }
        }
    }
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Rect = Rect::from_min_max(pos2(10.0, 20.0), pos2(410.0, 320.0));

    #[test]
    fn a_line_is_cut_where_the_sheet_ends() {
        let across = cut([pos2(-50.0, 100.0), pos2(500.0, 100.0)], FRAME);
        assert_eq!(across, Some([pos2(10.0, 100.0), pos2(410.0, 100.0)]));
        let inside = [pos2(11.0, 22.0), pos2(30.0, 40.0)];
        assert_eq!(cut(inside, FRAME), Some(inside));
        assert_eq!(cut([pos2(-5.0, -5.0), pos2(-5.0, 900.0)], FRAME), None);
        assert_eq!(cut([pos2(f32::NAN, 1.0), pos2(20.0, 30.0)], FRAME), None);
    }

    #[test]
    fn an_area_is_cut_where_the_sheet_ends() {
        let inside = [pos2(11.0, 22.0), pos2(30.0, 40.0), pos2(19.0, 60.0)];
        assert_eq!(within(&inside, FRAME), inside);
        let all = [
            pos2(-400.0, -300.0),
            pos2(1800.0, -300.0),
            pos2(-400.0, 1500.0),
        ];
        let around = within(&all, FRAME);
        let twice_the_size: f32 = around
            .iter()
            .zip(around.iter().cycle().skip(1))
            .map(|(a, b)| a.x * b.y - b.x * a.y)
            .sum();
        assert!(
            (twice_the_size - 2.0 * 400.0 * 300.0).abs() < 1.0,
            "{around:?}"
        );
        let outside = [pos2(9.0, 30.0), pos2(1.0, 35.0), pos2(9.0, 39.0)];
        assert!(within(&outside, FRAME).is_empty());
    }

    #[test]
    fn what_is_seen_through_is_mixed_with_white() {
        use crate::gui::scene::ColourToken;
        assert_eq!(colour(ColourToken::Surface.into()), Colour(255, 255, 255));
        assert_eq!(
            colour(ColourToken::Before.clear(0.0)),
            Colour(255, 255, 255)
        );
        let Colour(r, g, b) = colour(ColourToken::Before.clear(0.5));
        let [r0, g0, b0, _] = LIGHT.before.to_array();
        for (mixed, full) in [(r, r0), (g, g0), (b, b0)] {
            let wanted = f32::midpoint(f32::from(full), 255.0);
            assert!((f32::from(mixed) - wanted).abs() < 2.0, "{mixed} {wanted}");
        }
    }
}
