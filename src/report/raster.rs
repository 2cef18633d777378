//! A drawing as a PNG file: the same sheet as [`super::svg`] writes, as pixels on white paper.
//!
//! Every item becomes closed outlines that are filled by the non-zero winding rule. A row of pixels is
//! cut into `CUTS` lines; on each, a pixel is covered as far as the filled spans reach into it, and
//!
//! ```text
//! pixel = cover · colour + (1 − cover) · pixel
//! ```
//!
//! Lines have butt ends and round joints. Text is drawn from the outlines of the faces that the PDF
//! uses (`fonts`), so no font has to be installed where the picture is looked at.

use png::{BitDepth, ColorType, Encoder, PixelDimensions, Unit};
use ttf_parser::{GlyphId, OutlineBuilder};

use super::fonts::Fonts;
use super::pdf::PdfError;
use crate::fonts::{Library, Purpose, is_worth_a_font};
use crate::present::drawing::{Anchor, Colour, Drawing, Item, Label, Stroke, WHITE};

/// Pixels of a point: 288 to the inch, about twice what a plot has on the screen.
pub const PIXELS: f64 = 4.0;
/// Lines that a row of pixels is cut into.
const CUTS: usize = 8;
/// Straight pieces of a curve of a letter.
const PIECES: u8 = 6;
/// Longest side of a picture, pixels: a sheet of a metre and a half.
const MOST: f64 = 16_384.0;
/// Width of the outline of a mark that is not filled, points; as in SVG.
const OUTLINE: f64 = 0.7;

type Point = [f64; 2];

/// The drawing as a PNG file, with the fonts of a library where the bundled ones do not do.
///
/// # Errors
/// If a font cannot be used.
pub fn png_file(drawing: &Drawing, library: &Library) -> Result<Vec<u8>, PdfError> {
    let bundled = Fonts::new(&[])?;
    for item in &drawing.items {
        if let Item::Text(label) = item {
            bundled.runs(&label.text, label.bold);
        }
    }
    let mut missing = bundled.missing();
    missing.retain(|c| is_worth_a_font(*c));
    let found = library.covering(&missing, Purpose::Screen);
    let fonts = Fonts::new(&found.faces)?;
    let mut sheet = Sheet::new(drawing);
    for item in &drawing.items {
        sheet.draw(item, &fonts);
    }
    Ok(sheet.file())
}

/// The pixels of a drawing.
struct Sheet {
    size: [usize; 2],
    /// Red, green and blue of each, row by row.
    rgb: Vec<u8>,
}

impl Sheet {
    fn new(drawing: &Drawing) -> Self {
        #[allow(clippy::cast_possible_truncation, reason = "between 1 and MOST")]
        #[allow(clippy::cast_sign_loss, reason = "between 1 and MOST")]
        let side = |points: f64| (points * PIXELS).ceil().clamp(1.0, MOST) as usize;
        let size = [side(drawing.width), side(drawing.height)];
        let rgb = vec![255; 3 * size[0] * size[1]];
        Self { size, rgb }
    }

    fn draw(&mut self, item: &Item, fonts: &Fonts) {
        match item {
            Item::Lines(lines, stroke) => {
                let outlines = lines.iter().flat_map(|line| stroked(line, *stroke));
                self.fill(outlines, stroke.colour);
            }
            Item::Box([x, y], [w, h], colour) => {
                let corners = [[*x, *y], [x + w, *y], [x + w, y + h], [*x, y + h]];
                self.fill([corners.to_vec()], *colour);
            }
            Item::Marks {
                shape,
                at,
                half,
                colour,
                filled,
            } => {
                let outline = |[x, y]: &Point| -> Vec<Point> {
                    let corner = |[dx, dy]: &Point| [x + half * dx, y + half * dy];
                    shape.corners().iter().map(corner).collect()
                };
                for mark in at.iter().map(outline) {
                    if *filled {
                        self.fill([mark], *colour);
                        continue;
                    }
                    let around = [mark.as_slice(), &mark[..2.min(mark.len())]].concat();
                    self.fill([mark], WHITE);
                    self.fill(stroked(&around, Stroke::new(OUTLINE, *colour)), *colour);
                }
            }
            Item::Text(label) => self.fill(letters(label, fonts), label.colour),
        }
    }

    /// Fills what these outlines (points of the drawing) wind around.
    fn fill(&mut self, outlines: impl IntoIterator<Item = Vec<Point>>, Colour(r, g, b): Colour) {
        let [width, height] = self.size;
        let mut crossings = Crossings::of(outlines, height * CUTS);
        let mut cover = vec![0.0_f32; width];
        let rows = self.rgb.chunks_exact_mut(3 * width).enumerate();
        let [first, last] = crossings.rows();
        for (row, pixels) in rows.take(last).skip(first) {
            let mut seen = [width, 0];
            for cut in row * CUTS..(row + 1) * CUTS {
                crossings.spans(cut, |from, to| {
                    let [first, last] = spread(&mut cover, from, to);
                    seen = [seen[0].min(first), seen[1].max(last)];
                });
            }
            for x in seen[0]..seen[1] {
                let part = std::mem::take(&mut cover[x]).min(1.0);
                for (value, ink) in pixels[3 * x..3 * x + 3].iter_mut().zip([r, g, b]) {
                    let mixed = part * f32::from(ink) + (1.0 - part) * f32::from(*value);
                    #[allow(clippy::cast_possible_truncation, reason = "a mean of two bytes")]
                    #[allow(clippy::cast_sign_loss, reason = "a mean of two bytes")]
                    let mixed = mixed.round() as u8;
                    *value = mixed;
                }
            }
        }
    }

    fn file(&self) -> Vec<u8> {
        let mut out = Vec::new();
        let side = |k: usize| u32::try_from(self.size[k]).unwrap_or(u32::MAX);
        let mut encoder = Encoder::new(&mut out, side(0), side(1));
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        #[allow(clippy::cast_possible_truncation, reason = "a few thousand")]
        #[allow(clippy::cast_sign_loss, reason = "a few thousand")]
        let per_metre = (PIXELS * 72.0 / 0.0254).round() as u32;
        encoder.set_pixel_dims(Some(PixelDimensions {
            xppu: per_metre,
            yppu: per_metre,
            unit: Unit::Meter,
        }));
        let written = encoder
            .write_header()
            .and_then(|mut writer| writer.write_image_data(&self.rgb));
        // Only a size that is not that of the pixels can fail, and they were made together.
        debug_assert!(written.is_ok(), "{written:?}");
        out
    }
}

/// Where outlines cross the lines that pixels are cut into.
struct Crossings {
    /// Of each line from `first` on: how far to the right, pixels, and whether the outline goes down.
    lines: Vec<Vec<(f64, bool)>>,
    first: usize,
}

impl Crossings {
    fn of(outlines: impl IntoIterator<Item = Vec<Point>>, count: usize) -> Self {
        let cuts = CUTS as f64 * PIXELS;
        let edges = |outline: Vec<Point>| -> Vec<[Point; 2]> {
            let next = outline.iter().cycle().skip(1);
            outline
                .iter()
                .copied()
                .zip(next.copied())
                .map(|(a, b)| [a, b])
                .collect()
        };
        // x in pixels, y in lines whose middles are at whole numbers.
        let scaled = |[x, y]: Point| [x * PIXELS, y * cuts - 0.5];
        let edges: Vec<[Point; 2]> = outlines.into_iter().flat_map(edges).collect();
        let edges = edges.into_iter().map(|edge| edge.map(scaled));
        let mut lines: Vec<Vec<(f64, bool)>> = Vec::new();
        let mut first = 0;
        let edges: Vec<[Point; 2]> = edges
            .filter(|e| e.iter().flatten().all(|v| v.is_finite()))
            .collect();
        let top = edges
            .iter()
            .flatten()
            .map(|p| p[1])
            .fold(f64::INFINITY, f64::min);
        let bottom = edges.iter().flatten().map(|p| p[1]).fold(0.0, f64::max);
        #[allow(
            clippy::cast_possible_truncation,
            reason = "it is cut to what there is"
        )]
        #[allow(clippy::cast_sign_loss, reason = "it is cut to what there is")]
        let line = |y: f64| y.ceil().clamp(0.0, count as f64) as usize;
        if top.is_finite() {
            first = line(top);
            lines.resize(line(bottom).saturating_sub(first) + 1, Vec::new());
        }
        for [from, to] in edges {
            let down = from[1] < to[1];
            let [above, below] = if down { [from, to] } else { [to, from] };
            for k in line(above[1])..line(below[1]) {
                let along = (k as f64 - above[1]) / (below[1] - above[1]);
                lines[k - first].push((above[0] + along * (below[0] - above[0]), down));
            }
        }
        Self { lines, first }
    }

    /// The rows of pixels that they are in.
    fn rows(&self) -> [usize; 2] {
        [
            self.first / CUTS,
            (self.first + self.lines.len()).div_ceil(CUTS),
        ]
    }

    /// The spans of a line around which the outlines wind, from the left.
    fn spans(&mut self, line: usize, mut each: impl FnMut(f64, f64)) {
        let line = line.checked_sub(self.first);
        let Some(crossings) = line.and_then(|line| self.lines.get_mut(line)) else {
            return;
        };
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut winds = 0_i32;
        let mut from = 0.0;
        for (x, down) in crossings {
            if winds == 0 {
                from = *x;
            }
            winds += if *down { 1 } else { -1 };
            if winds == 0 {
                each(from, *x);
            }
        }
    }
}

/// Adds a span to what a line covers of each pixel; the pixels that it touches.
fn spread(cover: &mut [f32], from: f64, to: f64) -> [usize; 2] {
    let width = cover.len() as f64;
    let (from, to) = (from.clamp(0.0, width), to.clamp(0.0, width));
    #[allow(clippy::cast_possible_truncation, reason = "within the row")]
    #[allow(clippy::cast_sign_loss, reason = "within the row")]
    let [first, last] = [from.floor() as usize, to.ceil() as usize];
    for (x, pixel) in cover.iter_mut().enumerate().take(last).skip(first) {
        let left = from.max(x as f64);
        let right = to.min(x as f64 + 1.0);
        #[allow(clippy::cast_possible_truncation, reason = "a part of one")]
        let part = ((right - left).max(0.0) / CUTS as f64) as f32;
        *pixel += part;
    }
    [first, last]
}

/// The outlines of a line: each piece, and a round joint between two.
fn stroked(line: &[Point], stroke: Stroke) -> Vec<Vec<Point>> {
    let half = 0.5 * stroke.width;
    let mut outlines = Vec::new();
    let pieces = dashes(line, stroke.dash);
    for pair in pieces.iter().flat_map(|piece| piece.windows(2)) {
        let [a, b] = [pair[0], pair[1]];
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        if length > 0.0 {
            // All of them wind the same way, so where they overlap nothing is taken away.
            let n = [-dy * half / length, dx * half / length];
            let beside = |p: Point, sign: f64| [p[0] + sign * n[0], p[1] + sign * n[1]];
            outlines.push(vec![
                beside(a, 1.0),
                beside(b, 1.0),
                beside(b, -1.0),
                beside(a, -1.0),
            ]);
        }
    }
    let joints = pieces.iter().filter(|piece| piece.len() > 2);
    for at in joints.flat_map(|piece| &piece[1..piece.len() - 1]) {
        let corner = |k: u8| {
            let (sin, cos) = (-f64::from(k) * std::f64::consts::TAU / 12.0).sin_cos();
            [at[0] + half * cos, at[1] + half * sin]
        };
        outlines.push((0..12).map(corner).collect());
    }
    outlines
}

/// A line cut into its dashes.
fn dashes(line: &[Point], [dash, gap]: [f64; 2]) -> Vec<Vec<Point>> {
    if dash <= 0.0 || gap <= 0.0 {
        return vec![line.to_vec()];
    }
    let mut out = Vec::new();
    // Where on the pattern the next piece begins.
    let mut phase = 0.0;
    for pair in line.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let at = |s: f64| [0, 1].map(|k| a[k] + (b[k] - a[k]) * s / length);
        let mut s = -phase;
        // A line of this many dashes is longer than any sheet.
        for _ in 0..10_000 {
            if s >= length {
                break;
            }
            if s + dash > 0.0 {
                out.push(vec![at(s.max(0.0)), at((s + dash).min(length))]);
            }
            s += dash + gap;
        }
        phase = (phase + length) % (dash + gap);
    }
    out
}

/// The outlines of a text.
fn letters(label: &Label, fonts: &Fonts) -> Vec<Vec<Point>> {
    let back = match label.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5,
        Anchor::End => 1.0,
    };
    let mut pen = -back * fonts.width(&label.text, label.size, label.bold);
    let mut outlines = Vec::new();
    for run in fonts.runs(&label.text, label.bold) {
        let face = fonts.face(run.face);
        let scale = label.size / f64::from(face.units_per_em());
        for (glyph, _) in run.glyphs {
            let mut outline = Outline::default();
            face.outline_glyph(GlyphId(glyph), &mut outline);
            let place = |[u, v]: Point| {
                let (along, above) = (pen + scale * u, scale * v);
                if label.upwards {
                    [label.at[0] - above, label.at[1] - along]
                } else {
                    [label.at[0] + along, label.at[1] - above]
                }
            };
            let glyph_outlines = outline.0.into_iter();
            outlines.extend(glyph_outlines.map(|line| line.into_iter().map(place).collect()));
            pen += fonts.advance(run.face, glyph) * label.size;
        }
    }
    outlines
}

/// The outlines of a letter, in units of its face, y up.
#[derive(Default)]
struct Outline(Vec<Vec<Point>>);

impl Outline {
    fn add(&mut self, point: Point) {
        if let Some(line) = self.0.last_mut() {
            line.push(point);
        }
    }

    fn last(&self) -> Point {
        let line = self.0.last();
        line.and_then(|line| line.last())
            .copied()
            .unwrap_or_default()
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.push(vec![[x, y].map(f64::from)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add([x, y].map(f64::from));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let [from, by, to] = [self.last(), [x1, y1].map(f64::from), [x, y].map(f64::from)];
        for k in 1..=PIECES {
            let t = f64::from(k) / f64::from(PIECES);
            let u = 1.0 - t;
            self.add([0, 1].map(|i| u * u * from[i] + 2.0 * u * t * by[i] + t * t * to[i]));
        }
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let from = self.last();
        let [a, b, to] = [[x1, y1], [x2, y2], [x, y]].map(|p| p.map(f64::from));
        for k in 1..=PIECES {
            let t = f64::from(k) / f64::from(PIECES);
            let u = 1.0 - t;
            let cubic = |i: usize| {
                u * u * u * from[i] + 3.0 * u * t * (u * a[i] + t * b[i]) + t * t * t * to[i]
            };
            self.add([0, 1].map(cubic));
        }
    }

    fn close(&mut self) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::present::drawing::{INK, Shape};

    fn drawn(items: Vec<Item>) -> Sheet {
        let drawing = Drawing {
            width: 20.0,
            height: 10.0,
            items,
        };
        let fonts = Fonts::new(&[]).unwrap();
        let mut sheet = Sheet::new(&drawing);
        for item in &drawing.items {
            sheet.draw(item, &fonts);
        }
        sheet
    }

    /// How much is black, square points.
    fn black(sheet: &Sheet) -> f64 {
        let dark = |pixel: &[u8]| 1.0 - f64::from(pixel[0]) / 255.0;
        sheet.rgb.chunks_exact(3).map(dark).sum::<f64>() / (PIXELS * PIXELS)
    }

    const BLACK: Colour = Colour(0, 0, 0);

    #[test]
    fn what_is_filled_is_as_large_as_it_is() {
        let all = black(&drawn(vec![Item::Box([2.0, 3.0], [5.3, 2.1], BLACK)]));
        assert!((all - 5.3 * 2.1).abs() < 0.05, "{all}");
        // A line that crosses itself, and reaches beyond the sheet.
        let slanted = vec![[-5.0, 5.0], [30.0, 5.0]];
        let all = black(&drawn(vec![Item::Lines(
            vec![slanted.clone(), slanted],
            Stroke::new(1.0, BLACK),
        )]));
        assert!((all - 20.0).abs() < 0.05, "{all}");
        let corner = vec![[2.0, 8.0], [12.0, 8.0], [12.0, 2.0]];
        let all = black(&drawn(vec![Item::Lines(
            vec![corner.clone()],
            Stroke::new(1.0, BLACK),
        )]));
        assert!((all - 16.0).abs() < 0.3, "{all}");
        let dashed = Stroke::new(1.0, BLACK).dashed(2.0, 1.0);
        let all = black(&drawn(vec![Item::Lines(vec![corner], dashed)]));
        assert!((all - 16.0 * 2.0 / 3.0).abs() < 0.8, "{all}");
        let marks = |filled| Item::Marks {
            shape: Shape::Square,
            at: vec![[10.0, 5.0]],
            half: 3.0,
            colour: BLACK,
            filled,
        };
        let all = black(&drawn(vec![marks(true)]));
        assert!((all - 4.8 * 4.8).abs() < 0.1, "{all}");
        let all = black(&drawn(vec![marks(false)]));
        assert!((all - 4.0 * 4.8 * OUTLINE).abs() < 0.5, "{all}");
        let nowhere = Item::Box([f64::NAN, 0.0], [1.0, 1.0], BLACK);
        assert_eq!(black(&drawn(vec![nowhere])), 0.0);
    }

    #[test]
    fn letters_are_written_where_they_belong() {
        let text = |anchor| {
            let label = Label::new([10.0, 8.0], "ll", 8.0, BLACK);
            drawn(vec![Item::Text(label.anchored(anchor))])
        };
        let middle = |sheet: &Sheet| {
            let width = sheet.size[0];
            let (mut sum, mut all) = (0.0, 0.0);
            for (k, pixel) in sheet.rgb.chunks_exact(3).enumerate() {
                let dark = 1.0 - f64::from(pixel[0]) / 255.0;
                sum += dark * ((k % width) as f64 + 0.5) / PIXELS;
                all += dark;
            }
            sum / all
        };
        let [start, at, end] = [Anchor::Start, Anchor::Middle, Anchor::End].map(text);
        assert!(black(&start) > 4.0, "{}", black(&start));
        assert!((middle(&at) - 10.0).abs() < 0.1, "{}", middle(&at));
        assert!(middle(&start) > 11.0 && middle(&end) < 9.0);
        let upwards = Label {
            upwards: true,
            ..Label::new([10.0, 8.0], "ll", 8.0, BLACK)
        };
        let upwards = drawn(vec![Item::Text(upwards)]);
        let all = [&upwards, &start].map(black);
        assert!((all[0] / all[1] - 1.0).abs() < 0.05, "{all:?}");
        assert!(middle(&upwards) < 10.0, "to the left of its line");
    }

    #[test]
    fn the_file_is_a_png_of_its_size() {
        let mut drawing = Drawing::new(20.0, 10.0);
        drawing.text(Label::new([1.0, 8.0], "µ中", 6.0, INK));
        let bytes = png_file(&drawing, &Library::of([])).unwrap();
        let reader = png::Decoder::new(std::io::Cursor::new(&bytes))
            .read_info()
            .unwrap();
        let info = reader.info();
        assert_eq!([info.width, info.height], [80, 40]);
        assert_eq!(info.pixel_dims.map(|d| d.xppu), Some(11_339));
        assert_eq!(bytes, png_file(&drawing, &Library::of([])).unwrap());
    }
}
