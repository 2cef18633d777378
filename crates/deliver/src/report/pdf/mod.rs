//! A report as PDF on A4: text stays text, plots stay vectors, fonts are embedded as far as they are
//! used. Written directly: the same report gives the same bytes, without any date.
//!
//! `pages` lays the blocks out on what `flow` has room for, `tables` those of them, `fonts` measures and embeds, this file writes. PDF 1.7,
//! ISO 32000-1; fonts as in its clause 9.7 (composite fonts, Identity-H, with a `ToUnicode` map).

mod flow;
mod pages;
mod picture;
mod tables;

use std::collections::BTreeSet;

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};
use sha2::{Digest, Sha256};

use super::document::Report;
use super::fonts::{Embedded, Fonts, Run, Used};
pub use super::pdf_error::PdfError;
use crate::fonts::is_worth_a_font;
use crate::present::drawing::{Anchor, Colour, Drawing, Item, Label, OVERLAP, Stroke};
use flow::PAGE;
use pages::{Mark, pages};
use picture::f32_of;

/// A report as PDF, and what it cannot show.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The document.
    pub bytes: Vec<u8>,
    /// Characters that stand in it as codes: no bundled font has them. [`crate::fonts::cannot_be_shown`] says so in
    /// words.
    pub unshown: BTreeSet<char>,
}

/// The report as PDF.
///
/// # Errors
/// If a font cannot be used.
pub fn pdf(report: &Report) -> Result<Written, PdfError> {
    let fonts = Fonts::new()?;
    let bytes = document(report, pages(report, &fonts), &fonts)?;
    let mut unshown = fonts.missing();
    unshown.retain(|c| is_worth_a_font(*c));
    Ok(Written { bytes, unshown })
}

fn document(
    report: &Report,
    (sheets, marks): (Vec<Drawing>, Vec<Mark>),
    fonts: &Fonts,
) -> Result<Vec<u8>, PdfError> {
    let mut used: Vec<Used> = (0..fonts.count()).map(|_| Used::default()).collect();
    let mut contents: Vec<Vec<u8>> = sheets
        .iter()
        .map(|sheet| content(sheet, fonts, &mut used))
        .collect();
    if let (Some(logo), Some(first)) = (&report.logo, contents.first_mut()) {
        first.extend(picture::drawn(logo));
    }
    Writer::default().document(report, &contents, &marks, fonts, &used)
}

/// Hands out numbers of objects and writes them.
#[derive(Default)]
struct Writer {
    last: i32,
}

impl Writer {
    fn next(&mut self) -> Ref {
        self.last += 1;
        Ref::new(self.last)
    }

    fn document(
        mut self,
        report: &Report,
        contents: &[Vec<u8>],
        marks: &[Mark],
        fonts: &Fonts,
        used: &[Used],
    ) -> Result<Vec<u8>, PdfError> {
        let mut pdf = Pdf::new();
        let (catalog, tree, outline) = (self.next(), self.next(), self.next());
        let pages: Vec<Ref> = contents.iter().map(|_| self.next()).collect();
        let picture = report
            .logo
            .as_ref()
            .map(|logo| picture::pixels(&mut pdf, self.next(), logo));
        let mut names = Vec::new();
        for (face, used) in used.iter().enumerate().filter(|(_, used)| !used.is_empty()) {
            let font = self.next();
            names.push((format!("F{face}"), font));
            self.font(&mut pdf, font, face, fonts, used)?;
        }
        let mut root = pdf.catalog(catalog);
        root.pages(tree)
            .outlines(outline)
            .lang(TextStr(report.language.code()));
        root.viewer_preferences().display_doc_title(true);
        root.finish();
        let count = i32::try_from(pages.len()).unwrap_or(i32::MAX);
        pdf.pages(tree).kids(pages.iter().copied()).count(count);
        let mut hash = Sha256::new();
        for (page, content) in pages.iter().zip(contents) {
            let stream = self.next();
            let mut out = pdf.page(*page);
            out.media_box(Rect::new(0.0, 0.0, f32_of(PAGE[0]), f32_of(PAGE[1])));
            out.parent(tree).contents(stream);
            let mut resources = out.resources();
            let mut dictionary = resources.fonts();
            for (name, font) in &names {
                dictionary.pair(Name(name.as_bytes()), *font);
            }
            dictionary.finish();
            if let (Some(picture), true) = (picture, *page == pages[0]) {
                resources.x_objects().pair(picture::NAME, picture);
            }
            resources.finish();
            out.finish();
            hash.update(content);
            let packed = compress_to_vec_zlib(content, 7);
            pdf.stream(stream, &packed).filter(Filter::FlateDecode);
        }
        self.outline(&mut pdf, outline, marks, &pages);
        let info = self.next();
        let title = format!("{}: {}", report.title, report.subject);
        let producer = format!("truepose {}", env!("CARGO_PKG_VERSION"));
        pdf.document_info(info)
            .title(TextStr(&title))
            .creator(TextStr(&producer))
            .producer(TextStr(&producer));
        let id = hash.finalize()[..16].to_vec();
        pdf.set_file_id((id.clone(), id));
        Ok(pdf.finish())
    }

    /// The sections in the reader's side bar.
    fn outline(&mut self, pdf: &mut Pdf, outline: Ref, marks: &[Mark], pages: &[Ref]) {
        let items: Vec<Ref> = marks.iter().map(|_| self.next()).collect();
        let mut root = pdf.outline(outline);
        if let (Some(first), Some(last)) = (items.first(), items.last()) {
            let count = i32::try_from(items.len()).unwrap_or(i32::MAX);
            root.first(*first).last(*last).count(count);
        }
        root.finish();
        for (k, mark) in marks.iter().enumerate() {
            let mut item = pdf.outline_item(items[k]);
            item.title(TextStr(&mark.title)).parent(outline);
            if let Some(before) = k.checked_sub(1) {
                item.prev(items[before]);
            }
            if let Some(next) = items.get(k + 1) {
                item.next(*next);
            }
            let top = f32_of(PAGE[1] - mark.y + 6.0);
            item.dest().page(pages[mark.page]).xyz(0.0, top, None);
        }
    }

    fn font(
        &mut self,
        pdf: &mut Pdf,
        font: Ref,
        number: usize,
        fonts: &Fonts,
        used: &Used,
    ) -> Result<(), PdfError> {
        let (cid, descriptor, map, file) = (self.next(), self.next(), self.next(), self.next());
        let face = fonts.face(number);
        // A part of a font carries a tag of six letters before its name.
        let letter = ('A'..='Z').nth(number % 26).unwrap_or('A');
        let name = format!("TPAAA{letter}+{}", fonts.name(number));
        let base = Name(name.as_bytes());
        let system = SystemInfo {
            registry: Str(b"Adobe"),
            ordering: Str(b"Identity"),
            supplement: 0,
        };
        pdf.type0_font(font)
            .base_font(base)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(cid)
            .to_unicode(map);
        let embedded = used.embedded(fonts, number)?;
        let mut out = pdf.cid_font(cid);
        out.subtype(match embedded {
            Embedded::TrueType(_) => CidFontType::Type2,
            Embedded::Cff(_) => CidFontType::Type0,
        });
        out.base_font(base).system_info(system);
        out.font_descriptor(descriptor).default_width(0.0);
        // Of outlines after Adobe the number is a CID already.
        if let Embedded::TrueType(_) = embedded {
            out.cid_to_gid_map_predefined(Name(b"Identity"));
        }
        let widths = used
            .glyphs()
            .map(|glyph| f32_of(fonts.advance(number, glyph) * 1000.0));
        out.widths().consecutive(0, widths);
        out.finish();
        let units = face.units_per_em();
        let scaled = |v: f64| f32_of(v * 1000.0 / units);
        let [left, bottom, right, top] = face.bounds().map(scaled);
        let [ascent, descent, capital] = face.heights().map(scaled);
        let mut out = pdf.font_descriptor(descriptor);
        out.name(base)
            .flags(FontFlags::SYMBOLIC)
            .bbox(Rect::new(left, bottom, right, top))
            .italic_angle(0.0)
            .ascent(ascent)
            .descent(descent)
            .cap_height(capital)
            .stem_v(if number == 1 { 110.0 } else { 80.0 });
        match embedded {
            Embedded::TrueType(_) => out.font_file2(file),
            Embedded::Cff(_) => out.font_file3(file),
        };
        out.finish();
        let mut cmap = UnicodeCmap::<u16>::new(Name(b"Custom"), system);
        for (glyph, c) in used.meanings() {
            cmap.pair(glyph, c);
        }
        let packed = compress_to_vec_zlib(&cmap.finish(), 7);
        pdf.stream(map, &packed).filter(Filter::FlateDecode);
        let (Embedded::TrueType(part) | Embedded::Cff(part)) = &embedded;
        let packed = compress_to_vec_zlib(part, 7);
        let mut stream = pdf.stream(file, &packed);
        stream.filter(Filter::FlateDecode);
        match embedded {
            Embedded::TrueType(_) => {
                let length = i32::try_from(part.len()).unwrap_or(i32::MAX);
                stream.pair(Name(b"Length1"), length);
            }
            Embedded::Cff(_) => {
                stream.pair(Name(b"Subtype"), Name(b"CIDFontType0C"));
            }
        }
        Ok(())
    }
}

/// A page's drawing as operators.
fn content(sheet: &Drawing, fonts: &Fonts, used: &mut [Used]) -> Vec<u8> {
    let mut out = Content::new();
    let flip = |[x, y]: [f64; 2]| [f32_of(x), f32_of(sheet.height - y)];
    for item in &sheet.items {
        match item {
            Item::Lines(lines, stroke) => {
                pen(&mut out, *stroke);
                for line in lines {
                    trace(&mut out, line.iter().map(|p| flip(*p)));
                }
                out.stroke();
            }
            Item::Box(corner, [width, height], colour) => {
                fill(&mut out, *colour);
                let [x, y] = flip([corner[0], corner[1] + height]);
                out.rect(x, y, f32_of(*width), f32_of(*height))
                    .fill_nonzero();
            }
            Item::Areas(areas) => {
                for (corners, colour) in areas {
                    fill(&mut out, *colour);
                    pen(&mut out, Stroke::new(OVERLAP, *colour));
                    trace(&mut out, corners.iter().map(|p| flip(*p)));
                    out.close_path().fill_nonzero_and_stroke();
                }
            }
            Item::Marks {
                shape,
                at,
                half,
                colour,
                filled,
            } => {
                if *filled {
                    fill(&mut out, *colour);
                } else {
                    fill(&mut out, crate::present::drawing::WHITE);
                    pen(&mut out, Stroke::new(0.7, *colour));
                }
                for [x, y] in at {
                    let corner = |[dx, dy]: &[f64; 2]| flip([x + half * dx, y + half * dy]);
                    trace(&mut out, shape.corners().iter().map(corner));
                    out.close_path();
                    // One by one, so that a mark covers the one before it.
                    if !filled {
                        out.fill_nonzero_and_stroke();
                    }
                }
                if *filled {
                    out.fill_nonzero();
                }
            }
            Item::Text(label) => text(&mut out, label, sheet.height, fonts, used),
        }
    }
    out.finish().into_vec()
}

/// From point to point.
fn trace(out: &mut Content, points: impl Iterator<Item = [f32; 2]>) {
    for (k, [x, y]) in points.enumerate() {
        if k == 0 {
            out.move_to(x, y);
        } else {
            out.line_to(x, y);
        }
    }
}

fn text(out: &mut Content, label: &Label, height: f64, fonts: &Fonts, used: &mut [Used]) {
    let runs = fonts.runs(&label.text, label.bold);
    let width: f64 = runs.iter().map(|r| r.width).sum::<f64>() * label.size;
    let back = match label.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => width / 2.0,
        Anchor::End => width,
    };
    fill(out, label.colour);
    let mut along = -back;
    for run in runs {
        let [x, y] = label.at;
        let matrix = if label.upwards {
            [0.0, 1.0, -1.0, 0.0, f32_of(x), f32_of(height - y + along)]
        } else {
            [1.0, 0.0, 0.0, 1.0, f32_of(x + along), f32_of(height - y)]
        };
        show(out, &run, matrix, label.size, used);
        along += run.width * label.size;
    }
}

fn show(out: &mut Content, run: &Run, matrix: [f32; 6], size: f64, used: &mut [Used]) {
    if let Some(c) = run.instead_of {
        let mut span = out.begin_marked_content_with_properties(Name(b"Span"));
        span.properties()
            .actual_text(TextStr(c.encode_utf8(&mut [0; 4])));
    }
    let mut bytes = Vec::with_capacity(2 * run.glyphs.len());
    for (glyph, c) in &run.glyphs {
        bytes.extend_from_slice(&used[run.face].number(*glyph, *c).to_be_bytes());
    }
    let name = format!("F{}", run.face);
    out.begin_text();
    out.set_font(Name(name.as_bytes()), f32_of(size));
    out.set_text_matrix(matrix);
    out.show(Str(&bytes));
    out.end_text();
    if run.instead_of.is_some() {
        out.end_marked_content();
    }
}

fn pen(out: &mut Content, stroke: Stroke) {
    let [r, g, b] = parts(stroke.colour);
    out.set_stroke_rgb(r, g, b);
    out.set_line_width(f32_of(stroke.width));
    if stroke.dash[0] > 0.0 {
        out.set_dash_pattern(stroke.dash.map(f32_of), 0.0);
    } else {
        out.set_dash_pattern([], 0.0);
    }
}

fn fill(out: &mut Content, colour: Colour) {
    let [r, g, b] = parts(colour);
    out.set_fill_rgb(r, g, b);
}

fn parts(Colour(r, g, b): Colour) -> [f32; 3] {
    [r, g, b].map(|part| f32_of((f64::from(part) / 255.0 * 1000.0).round() / 1000.0))
}
