//! Where the next line goes: pages of A4 that fill from the top.

use crate::present::chart::FULL_WIDTH;
use crate::present::drawing::{Colour, Drawing, Label, Stroke};
use crate::report::fonts::Fonts;

/// A4, points.
pub(super) const PAGE: [f64; 2] = [595.28, 841.89];
pub(super) const LEFT: f64 = 54.0;
pub(super) const TOP: f64 = 52.0;
pub(super) const BOTTOM: f64 = PAGE[1] - 62.0;
/// Size of the running text, points.
pub(super) const TEXT: f64 = 8.8;
pub(super) const LINE: f64 = 12.6;
pub(super) const NAMES: f64 = 132.0;

/// Pages as they fill.
pub(super) struct Flow<'f> {
    pub(super) fonts: &'f Fonts,
    pub(super) pages: Vec<Drawing>,
    pub(super) y: f64,
}

impl Flow<'_> {
    pub(super) fn page(&mut self) -> &mut Drawing {
        if self.pages.is_empty() {
            self.pages.push(Drawing::new(PAGE[0], PAGE[1]));
        }
        let last = self.pages.len() - 1;
        &mut self.pages[last]
    }

    /// Turns the page where less than `height` is left.
    pub(super) fn room_for(&mut self, height: f64) {
        if self.y + height > BOTTOM && self.y > TOP {
            self.pages.push(Drawing::new(PAGE[0], PAGE[1]));
            self.y = TOP;
        }
    }

    pub(super) fn rule(&mut self, y: f64, width: f64, colour: Colour) {
        self.page().line(
            [LEFT, y],
            [LEFT + FULL_WIDTH, y],
            Stroke::new(width, colour),
        );
    }

    /// One line of text, and down by its height.
    pub(super) fn line_of(
        &mut self,
        text: &str,
        size: f64,
        height: f64,
        bold: bool,
        colour: Colour,
        x: f64,
    ) {
        self.room_for(height);
        let at = [x, self.y + height / 2.0 + size * 0.35];
        let mut label = Label::new(at, text, size, colour);
        label.bold = bold;
        self.page().text(label);
        self.y += height;
    }

    pub(super) fn paragraph(&mut self, text: &str, size: f64, height: f64, colour: Colour) {
        for line in self.fonts.wrapped(text, size, false, FULL_WIDTH) {
            self.line_of(&line, size, height, false, colour, LEFT);
        }
    }
}
