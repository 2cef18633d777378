//! A sketch on paper: the report's drawing of it, to be saved as SVG.

use egui::Align2;

use crate::report::drawing::{
    AFTER, Anchor, BEFORE, CORRECTED, Colour, Drawing, INK, Item, Label, MUTED, Shape, Stroke,
};
use crate::report::plots::FULL_WIDTH;
use crate::report::plots::panel::{Panel, SMALL};

use super::{Ink, Sketch, Stands};

const LEFT: f64 = 46.0;
const RIGHT: f64 = 8.0;
const TOP: f64 = 34.0;
const HEIGHT: f64 = 200.0;
const BELOW: f64 = 44.0;
/// Half width of a mark, points.
const HALF: f64 = 1.9;
/// What a tolerance is filled with.
const BAND: Colour = Colour(0xdf, 0xee, 0xe9);

fn colour(stands: Stands) -> Colour {
    match stands {
        Stands::Before => BEFORE,
        Stands::After => CORRECTED,
        Stands::Tolerance => AFTER,
        Stands::Reference | Stands::Noise => MUTED,
        Stands::Curve => INK,
    }
}

impl Sketch {
    /// The drawing; `of` is what it belongs to.
    pub(crate) fn on_paper(&self, of: &str) -> Drawing {
        let [low, high] = self.bounds;
        let panel = Panel {
            left: LEFT,
            top: TOP,
            width: FULL_WIDTH - LEFT - RIGHT,
            height: HEIGHT,
            x: [low[0], high[0]],
            y: [low[1], high[1]],
        };
        let mut drawing = Drawing::new(FULL_WIDTH, TOP + HEIGHT + BELOW);
        for ink in &self.inks {
            if let Ink::Band([from, to], _) = ink {
                let [[left, top], [right, bottom]] =
                    [panel.at(low[0], *to), panel.at(high[0], *from)];
                let size = [right - left, bottom - top];
                drawing.items.push(Item::Box([left, top], size, BAND));
            }
        }
        let ticks = if self.ticks.is_empty() { 8 } else { 0 };
        panel.frame([ticks, 5], &mut drawing);
        for (at, word) in &self.ticks {
            let at = [panel.at(*at, low[1])[0], TOP + HEIGHT + SMALL + 2.5];
            let label = Label::new(at, word, SMALL, MUTED).anchored(Anchor::Middle);
            drawing.text(label);
        }
        for ink in &self.inks {
            self.ink(ink, &panel, &mut drawing);
        }
        drawing.text(Label::new([LEFT, 10.0], &self.title, 8.5, INK).bold());
        drawing.text(Label::new([LEFT, 22.0], of, SMALL, MUTED));
        panel.x_label(&self.across, &mut drawing);
        panel.y_label(&self.upwards, 8.0, &mut drawing);
        let note = Label::new([LEFT, TOP + HEIGHT + 38.0], &self.note, SMALL, MUTED);
        drawing.text(note);
        self.legend(&mut drawing);
        drawing
    }

    fn ink(&self, ink: &Ink, panel: &Panel, drawing: &mut Drawing) {
        let [low, high] = self.bounds;
        let at = |p: [f64; 2]| panel.at(p[0], p[1].clamp(low[1], high[1]));
        match ink {
            Ink::Band(..) => {}
            Ink::Bar(from, to, stands, filled) => {
                let ([a, b], [c, d]) = (at(*from), at(*to));
                let corner = [a.min(c), b.min(d)];
                let size = [(c - a).abs(), (d - b).abs()];
                if *filled {
                    drawing.items.push(Item::Box(corner, size, colour(*stands)));
                } else {
                    let [x, y] = corner;
                    let [w, h] = size;
                    let round = vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h], [x, y]];
                    let stroke = Stroke::new(0.8, colour(*stands));
                    drawing.items.push(Item::Lines(vec![round], stroke));
                }
            }
            Ink::Line(points, stands, width, dashed) => {
                let points: Vec<[f64; 2]> = points.iter().map(|p| at(*p)).collect();
                let stroke = Stroke::new(f64::from(*width) * 0.7, colour(*stands));
                let stroke = if *dashed {
                    stroke.dashed(3.5, 2.5)
                } else {
                    stroke
                };
                drawing.items.push(Item::Lines(vec![points], stroke));
            }
            Ink::Marks(marks, stands, filled) => {
                for (shape, side) in [(Shape::Square, 0.0), (Shape::Up, 1.0), (Shape::Down, -1.0)] {
                    let here = marks.iter().filter(|m| m.side == side);
                    let here: Vec<[f64; 2]> = here.map(|m| at(m.at)).collect();
                    if !here.is_empty() {
                        drawing.items.push(Item::Marks {
                            shape,
                            at: here,
                            half: HALF,
                            colour: colour(*stands),
                            filled: *filled,
                        });
                    }
                }
            }
            Ink::Word(place, text, anchor) => {
                let [x, y] = at(*place);
                let (side, gap) = match *anchor {
                    Align2::RIGHT_TOP | Align2::RIGHT_CENTER => (Anchor::End, -2.0),
                    _ => (Anchor::Start, 2.0),
                };
                let below = if anchor.y() == egui::Align::Min {
                    8.0
                } else {
                    2.5
                };
                let label = Label::new([x + gap, y + below], text.trim(), SMALL, MUTED);
                drawing.text(label.anchored(side));
            }
        }
    }

    /// What the marks are, from the right.
    fn legend(&self, drawing: &mut Drawing) {
        let mut right = FULL_WIDTH - RIGHT;
        for (name, stands, filled) in self.legend.iter().rev() {
            let label = Label::new([right, 22.0], name, SMALL, MUTED);
            drawing.text(label.anchored(Anchor::End));
            right -= 3.7 * name.chars().count() as f64 + 8.0;
            drawing.items.push(Item::Marks {
                shape: Shape::Square,
                at: vec![[right, 19.5]],
                half: 2.6,
                colour: colour(*stands),
                filled: *filled,
            });
            right -= 14.0;
        }
    }
}
