//! A chart on paper.

use super::panel::{FULL_WIDTH, Panel, SMALL};
use super::{Chart, ColourRole, Entry, Form, Item, LegendSymbol, Ticks, is_wide};
use crate::present::drawing::{
    self, AFTER, Anchor, BEFORE, CORRECTED, Colour, Drawing, INK, Label, MUTED, Shape, Stroke,
    TOLERANCE,
};

const RIGHT: f64 = 8.0;
const BELOW: f64 = 26.0;
/// Height of a line of text, points.
const LINE: f64 = 12.0;
/// Half width of a mark, points.
const HALF: f64 = 1.9;
/// Height of the plot where its axis beside it has numbers, points.
pub(crate) const HEIGHT: f64 = 200.0;
/// Height of a row, where it has words.
const ROW: f64 = 17.0;
/// What a tolerance is filled with.
const BAND: Colour = Colour(0xdf, 0xee, 0xe9);
/// What the interval of a curve is filled with.
const RIBBON: Colour = Colour(0xcf, 0xd4, 0xdb);
const DASH: [f64; 2] = [3.5, 2.5];

impl ColourRole {
    /// Its colour on paper.
    pub fn on_paper(self) -> Colour {
        match self {
            Self::Before => BEFORE,
            Self::After => AFTER,
            Self::Corrected => CORRECTED,
            Self::Tolerance => TOLERANCE,
            Self::Reference | Self::Noise => MUTED,
            Self::Curve => INK,
        }
    }
}

fn shape(form: Form) -> Shape {
    match form {
        Form::Disc => Shape::Square,
        Form::Forwards => Shape::Up,
        Form::Backwards => Shape::Down,
        Form::Diamond => Shape::Diamond,
    }
}

fn dashed(stroke: Stroke, dashed: bool) -> Stroke {
    if dashed {
        stroke.dashed(DASH[0], DASH[1])
    } else {
        stroke
    }
}

impl Chart {
    /// The chart as a file of its own; `of` is what it belongs to.
    pub fn on_paper(&self, of: &str) -> Drawing {
        self.sheet(Some(of), self.height())
    }

    /// The chart for a page whose words say what it belongs to.
    pub fn in_page(&self, height: f64) -> Drawing {
        self.sheet(None, height)
    }

    /// The height that its plot has by itself, points.
    pub fn height(&self) -> f64 {
        match &self.upwards.ticks {
            Ticks::Words(_) => ROW * (self.bounds[1][1] - self.bounds[0][1]),
            Ticks::Plane => 1.5 * HEIGHT,
            _ => HEIGHT,
        }
    }

    fn sheet(&self, of: Option<&str>, height: f64) -> Drawing {
        let [low, high] = self.bounds;
        let rows = matches!(self.upwards.ticks, Ticks::Words(_));
        let left = if rows { 158.0 } else { 46.0 };
        // The title, what it belongs to, and what the marks are.
        let head = if of.is_some() { 2.0 } else { 1.0 };
        let top = LINE * head + 10.0;
        let width = FULL_WIDTH - left - RIGHT;
        let plane = self.upwards.ticks == Ticks::Plane;
        let x = if plane {
            let half = 0.5 * (high[1] - low[1]) * width / height;
            let middle = f64::midpoint(low[0], high[0]);
            [middle - half, middle + half]
        } else {
            [low[0], high[0]]
        };
        let panel = Panel {
            left,
            top,
            width,
            height,
            x,
            y: [low[1], high[1]],
        };
        let foot = if self.note.is_empty() { 0.0 } else { 18.0 };
        let mut drawing = Drawing::new(FULL_WIDTH, top + height + BELOW + foot);
        for item in &self.items {
            if let Item::Ribbon(places, _) = item {
                let corners = |[a, b]: [[f64; 3]; 2]| {
                    let round = [[a[0], a[1]], [b[0], b[1]], [b[0], b[2]], [a[0], a[2]]];
                    (round.map(|[x, y]| panel.at(x, y)).to_vec(), RIBBON)
                };
                let areas = places.windows(2).map(|w| corners([w[0], w[1]]));
                drawing.items.push(drawing::Item::Areas(areas.collect()));
            }
            if let Item::Band([from, to], _) = item {
                let [[left, top], [right, bottom]] =
                    [panel.at(low[0], *to), panel.at(high[0], *from)];
                let size = [right - left, bottom - top];
                let band = drawing::Item::Box([left, top], size, BAND);
                drawing.items.push(band);
            }
        }
        let most = (height / 40.0).max(4.0);
        if !plane {
            panel.frame([&self.across, &self.upwards], [8.0, most], &mut drawing);
        }
        for item in &self.items {
            self.item(item, &panel, &mut drawing);
        }
        let start = if rows { 0.0 } else { left };
        drawing.text(Label::new([start, 10.0], &self.title, 8.5, INK).bold());
        let line = LINE * (head - 1.0) + 10.0;
        if let Some(of) = of {
            drawing.text(Label::new([start, line], of, SMALL, MUTED));
        }
        panel.x_label(&self.across.label, &mut drawing);
        panel.y_label(&self.upwards.label, 8.0, &mut drawing);
        let note = [start, top + height + BELOW + 12.0];
        drawing.text(Label::new(note, &self.note, SMALL, MUTED));
        self.legend(line, &mut drawing);
        drawing
    }

    fn item(&self, item: &Item, panel: &Panel, drawing: &mut Drawing) {
        let [low, high] = self.bounds;
        let at = |p: [f64; 2]| panel.at(p[0].clamp(low[0], high[0]), p[1].clamp(low[1], high[1]));
        match item {
            Item::Band(..) | Item::Ribbon(..) => {}
            Item::Bars(bars, stands, filled) => {
                for [from, to] in bars {
                    let ([a, b], [c, d]) = (at(*from), at(*to));
                    let [x, y] = [a.min(c), b.min(d)];
                    let [w, h] = [(c - a).abs(), (d - b).abs()];
                    let colour = stands.on_paper();
                    drawing.items.push(if *filled {
                        drawing::Item::Box([x, y], [w, h], colour)
                    } else {
                        let round = vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h], [x, y]];
                        drawing::Item::Lines(vec![round], Stroke::new(0.8, colour))
                    });
                }
            }
            Item::Line(points, stands, width, is_dashed) => {
                let points = points.iter().map(|p| at(*p)).collect();
                let stroke = Stroke::new(f64::from(*width) * 0.7, stands.on_paper());
                let stroke = dashed(stroke, *is_dashed);
                drawing
                    .items
                    .push(drawing::Item::Lines(vec![points], stroke));
            }
            Item::Marks(marks, stands, filled) => {
                for form in [Form::Disc, Form::Forwards, Form::Backwards, Form::Diamond] {
                    let here = marks.iter().filter(|m| m.form == form);
                    let here: Vec<[f64; 2]> = here.map(|m| at(m.at)).collect();
                    if !here.is_empty() {
                        drawing.items.push(drawing::Item::Marks {
                            shape: shape(form),
                            at: here,
                            half: HALF,
                            colour: stands.on_paper(),
                            filled: *filled,
                        });
                    }
                }
            }
            Item::Word(word) => {
                let [x, y] = at(word.at);
                let gap = if word.anchor == Anchor::End {
                    -2.0
                } else {
                    2.0
                };
                let below = if word.below { 8.0 } else { 2.5 };
                let label = Label::new([x + gap, y + below], word.text.trim(), SMALL, MUTED);
                drawing.text(label.anchored(word.anchor));
            }
        }
    }

    /// What the marks are, from the right.
    fn legend(&self, line: f64, drawing: &mut Drawing) {
        let mut right = FULL_WIDTH - RIGHT;
        let drawn = |stands: ColourRole| {
            self.items
                .iter()
                .any(|item| item.colour_role() == Some(stands))
        };
        for entry in self.legend.iter().rev() {
            // What was left out is not named either.
            if entry.role == ColourRole::Before && !drawn(ColourRole::Before) {
                continue;
            }
            let name = &entry.on_paper;
            let label = Label::new([right, line], name, SMALL, MUTED);
            drawing.text(label.anchored(Anchor::End));
            right -= width(name) + 8.0;
            drawing.items.push(symbol(entry, [right, line - 2.5]));
            right -= 14.0;
        }
    }
}

/// About how wide a small text is, points.
fn width(text: &str) -> f64 {
    let letter = |c: char| if is_wide(c) { SMALL } else { 3.7 };
    text.chars().map(letter).sum()
}

fn symbol(entry: &Entry, [x, y]: [f64; 2]) -> drawing::Item {
    let colour = entry.role.on_paper();
    let mark = |shape| drawing::Item::Marks {
        shape,
        at: vec![[x, y]],
        half: 2.6,
        colour,
        filled: entry.filled,
    };
    match entry.sign {
        LegendSymbol::Mark(form) => mark(shape(form)),
        LegendSymbol::Bar => mark(Shape::Square),
        LegendSymbol::Band => drawing::Item::Box([x - 4.0, y - 2.5], [7.0, 5.0], BAND),
        LegendSymbol::Line => {
            let stroke = dashed(Stroke::new(1.1, colour), !entry.filled);
            drawing::Item::Lines(vec![vec![[x - 8.0, y], [x + 4.0, y]]], stroke)
        }
    }
}
