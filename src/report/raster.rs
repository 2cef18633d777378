//! A drawing as a PNG file: the same sheet as [`super::svg`] writes, as pixels on white paper, drawn by
//! `tiny-skia`.
//!
//! Text is drawn from the outlines of the faces that the PDF uses (`fonts`), so no font has to be installed
//! where the picture is looked at.

use png::{BitDepth, ColorType, Encoder, PixelDimensions, Unit};
use skrifa::outline::OutlinePen;
use tiny_skia::{FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, StrokeDash, Transform};

use super::fonts::Fonts;
use super::pdf::PdfError;
use crate::fonts::{Library, Purpose, is_worth_a_font};
use crate::numeric::single;
use crate::present::drawing::{Anchor, Colour, Drawing, Item, Label, OVERLAP, Stroke, WHITE};

/// Pixels of a point: 288 to the inch, about twice what a plot has on the screen.
pub const PIXELS: f64 = 4.0;
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
    Ok(pixels(drawing, &fonts).map_or_else(Vec::new, |sheet| file(&sheet)))
}

/// The pixels of a drawing; `None` where there is no memory for them.
fn pixels(drawing: &Drawing, fonts: &Fonts) -> Option<Pixmap> {
    #[allow(clippy::cast_possible_truncation, reason = "between 1 and MOST")]
    #[allow(clippy::cast_sign_loss, reason = "between 1 and MOST")]
    let side = |points: f64| (points * PIXELS).ceil().clamp(1.0, MOST) as u32;
    let mut sheet = Pixmap::new(side(drawing.width), side(drawing.height))?;
    sheet.fill(tiny_skia::Color::WHITE);
    for item in &drawing.items {
        draw(&mut sheet, item, fonts);
    }
    Some(sheet)
}

fn draw(sheet: &mut Pixmap, item: &Item, fonts: &Fonts) {
    match item {
        Item::Lines(lines, stroke) => {
            for line in lines {
                trace(sheet, path(line, false), *stroke);
            }
        }
        Item::Box([x, y], [w, h], colour) => {
            let corners = [[*x, *y], [x + w, *y], [x + w, y + h], [*x, y + h]];
            fill(sheet, path(&corners, true), *colour, in_points());
        }
        Item::Areas(areas) => {
            for (corners, colour) in areas {
                fill(sheet, path(corners, true), *colour, in_points());
                trace(sheet, path(corners, true), Stroke::new(OVERLAP, *colour));
            }
        }
        Item::Marks {
            shape,
            at,
            half,
            colour,
            filled,
        } => {
            for [x, y] in at {
                let corner = |[dx, dy]: &Point| [x + half * dx, y + half * dy];
                let corners: Vec<Point> = shape.corners().iter().map(corner).collect();
                let inside = if *filled { *colour } else { WHITE };
                fill(sheet, path(&corners, true), inside, in_points());
                if !filled {
                    trace(sheet, path(&corners, true), Stroke::new(OUTLINE, *colour));
                }
            }
        }
        Item::Text(label) => write(sheet, label, fonts),
    }
}

/// From points of the drawing to pixels.
fn in_points() -> Transform {
    Transform::from_scale(single(PIXELS), single(PIXELS))
}

/// `None` for what is nowhere.
fn path(line: &[Point], closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for (k, [x, y]) in line.iter().enumerate() {
        let [x, y] = [single(*x), single(*y)];
        if k == 0 {
            builder.move_to(x, y);
        } else {
            builder.line_to(x, y);
        }
    }
    if closed {
        builder.close();
    }
    builder.finish()
}

fn paint(Colour(r, g, b): Colour) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(r, g, b, 255);
    paint
}

fn fill(sheet: &mut Pixmap, path: Option<Path>, colour: Colour, to_pixels: Transform) {
    if let Some(path) = path {
        let rule = FillRule::Winding;
        sheet.fill_path(&path, &paint(colour), rule, to_pixels, None);
    }
}

fn trace(sheet: &mut Pixmap, path: Option<Path>, stroke: Stroke) {
    let [dash, gap] = stroke.dash.map(single);
    let pen = tiny_skia::Stroke {
        width: single(stroke.width),
        line_join: LineJoin::Round,
        dash: StrokeDash::new(vec![dash, gap], 0.0),
        ..Default::default()
    };
    if let Some(path) = path {
        sheet.stroke_path(&path, &paint(stroke.colour), &pen, in_points(), None);
    }
}

fn write(sheet: &mut Pixmap, label: &Label, fonts: &Fonts) {
    let back = match label.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5,
        Anchor::End => 1.0,
    };
    let turned = if label.upwards { -90.0 } else { 0.0 };
    let [x, y] = label.at.map(single);
    let along = in_points().pre_translate(x, y).pre_rotate(turned);
    let mut pen = -back * fonts.width(&label.text, label.size, label.bold);
    for run in fonts.runs(&label.text, label.bold) {
        let face = fonts.face(run.face);
        let scale = single(label.size / face.units_per_em());
        for (glyph, _) in run.glyphs {
            let mut outline = Outline(PathBuilder::new());
            face.draw(glyph, &mut outline);
            // Letters stand upwards, the sheet goes down.
            let letter = along
                .pre_translate(single(pen), 0.0)
                .pre_scale(scale, -scale);
            fill(sheet, outline.0.finish(), label.colour, letter);
            pen += fonts.advance(run.face, glyph) * label.size;
        }
    }
}

/// The outlines of a letter, in units of its face, y up.
struct Outline(PathBuilder);

impl OutlinePen for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.0.close();
    }
}

/// `tiny-skia` could write it as well, but without the size of a pixel.
fn file(sheet: &Pixmap) -> Vec<u8> {
    let mut out = Vec::new();
    let mut encoder = Encoder::new(&mut out, sheet.width(), sheet.height());
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
    // The paper is white: every pixel covers what is behind it.
    let opaque = sheet.data().chunks_exact(4).flat_map(|pixel| &pixel[..3]);
    let rgb: Vec<u8> = opaque.copied().collect();
    let written = encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&rgb));
    // Only a size that is not that of the pixels can fail, and they were made together.
    debug_assert!(written.is_ok(), "{written:?}");
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::present::drawing::{INK, Shape};

    fn drawn(items: Vec<Item>) -> Pixmap {
        let drawing = Drawing {
            width: 20.0,
            height: 10.0,
            items,
        };
        pixels(&drawing, &Fonts::new(&[]).unwrap()).unwrap()
    }

    fn dark(pixel: &[u8]) -> f64 {
        1.0 - f64::from(pixel[0]) / 255.0
    }

    /// How much is black, square points.
    fn black(sheet: &Pixmap) -> f64 {
        let pixels = sheet.data().chunks_exact(4);
        pixels.map(dark).sum::<f64>() / (PIXELS * PIXELS)
    }

    const BLACK: Colour = Colour(0, 0, 0);

    #[test]
    fn what_is_filled_is_as_large_as_it_is() {
        let all = black(&drawn(vec![Item::Box([2.0, 3.0], [5.25, 2.125], BLACK)]));
        assert!((all - 5.25 * 2.125).abs() < 0.05, "{all}");
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
        // Neighbours leave no seam of paper, whatever way their edges run.
        let square = [[2.0, 2.0], [12.0, 2.0], [12.0, 8.0], [2.0, 8.0]];
        let halves = [[0, 1, 2], [0, 2, 3]];
        let halves = halves.map(|three| (three.map(|k| square[k]).to_vec(), BLACK));
        let halves = drawn(vec![Item::Areas(halves.to_vec())]);
        for x in 10..=46 {
            // Along the diagonal that both share.
            let pixel = halves.pixel(x, 8 + (x - 8) * 6 / 10).unwrap();
            assert!(pixel.red() < 8, "{x}: {pixel:?}");
        }
        let all = black(&halves);
        assert!(
            all > 60.0 && all < (10.0 + OVERLAP) * (6.0 + OVERLAP),
            "{all}"
        );
        let marks = |filled| Item::Marks {
            shape: Shape::Square,
            at: vec![[10.0, 5.0]],
            // Its sides fall on whole pixels; the library rounds others to quarters.
            half: 3.125,
            colour: BLACK,
            filled,
        };
        let all = black(&drawn(vec![marks(true)]));
        assert!((all - 5.0 * 5.0).abs() < 0.1, "{all}");
        let all = black(&drawn(vec![marks(false)]));
        // The width of a side is rounded to a quarter of a pixel.
        let rounding = 4.0 * 5.0 * 0.25 / PIXELS;
        assert!((all - 4.0 * 5.0 * OUTLINE).abs() < rounding, "{all}");
        let nowhere = Item::Box([f64::NAN, 0.0], [1.0, 1.0], BLACK);
        assert_eq!(black(&drawn(vec![nowhere])), 0.0);
    }

    #[test]
    fn letters_are_written_where_they_belong() {
        let text = |anchor| {
            let label = Label::new([10.0, 8.0], "ll", 8.0, BLACK);
            drawn(vec![Item::Text(label.anchored(anchor))])
        };
        let middle = |sheet: &Pixmap| {
            let width = sheet.width() as usize;
            let (mut sum, mut all) = (0.0, 0.0);
            for (k, pixel) in sheet.data().chunks_exact(4).enumerate() {
                sum += dark(pixel) * ((k % width) as f64 + 0.5) / PIXELS;
                all += dark(pixel);
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
