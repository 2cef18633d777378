//! One face of a font file: which glyph a character has, and how wide it is. The tables are read by `skrifa`, which the
//! window's text layout uses too.

use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::{GlyphMetrics, Metrics};
use skrifa::raw::TableProvider;
use skrifa::{FontRef, GlyphId, MetadataProvider, Tag};

/// Outlines after Adobe, in place of the table `glyf` of a `TrueType` font.
const CFF: Tag = Tag::new(b"CFF ");

/// A face whose tables can be read. Measures are in units of which [`Face::units_per_em`] make the size.
pub(crate) struct Face<'f> {
    characters: Charmap<'f>,
    widths: GlyphMetrics<'f>,
    metrics: Metrics,
}

impl<'f> Face<'f> {
    /// The face of this number in a file; `None` where its tables cannot be read.
    pub(crate) fn parse(data: &'f [u8]) -> Option<Self> {
        let font = FontRef::new(data).ok()?;
        font.head().ok()?;
        font.hhea().ok()?;
        let metrics = Metrics::new(&font, Size::unscaled(), LocationRef::default());
        // As OpenType has it; nothing else can be divided by.
        let sound = (16..=16384).contains(&metrics.units_per_em) && metrics.glyph_count > 0;
        sound.then(|| Self {
            characters: font.charmap(),
            widths: GlyphMetrics::new(&font, Size::unscaled(), LocationRef::default()),
            metrics,
        })
    }

    /// The glyph of a character.
    pub(crate) fn glyph(&self, c: char) -> Option<u16> {
        let glyph = self.characters.map(c)?.to_u32();
        u16::try_from(glyph).ok().filter(|glyph| *glyph != 0)
    }

    /// How far the pen goes on behind a glyph.
    pub(crate) fn advance(&self, glyph: u16) -> f64 {
        let width = self.widths.advance_width(GlyphId::from(glyph));
        f64::from(width.unwrap_or(0.0))
    }

    /// Units in the size of the letters.
    pub(crate) fn units_per_em(&self) -> f64 {
        f64::from(self.metrics.units_per_em)
    }

    /// What all glyphs lie in: left, bottom, right, top.
    pub(crate) fn bounds(&self) -> [f64; 4] {
        let bounds = self.metrics.bounds.unwrap_or_default();
        [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(f64::from)
    }

    /// From the line to the top and to the bottom (below 0) of a line of text, and to the top of capitals.
    pub(crate) fn heights(&self) -> [f64; 3] {
        let metrics = &self.metrics;
        let capital = metrics.cap_height.unwrap_or(metrics.ascent);
        [metrics.ascent, metrics.descent, capital].map(f64::from)
    }
}

/// The table of outlines after Adobe of a font.
pub(crate) fn cff_table(font: &[u8]) -> Option<&[u8]> {
    let font = FontRef::from_index(font, 0).ok()?;
    Some(font.table_data(CFF)?.as_bytes())
}
