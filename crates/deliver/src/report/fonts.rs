//! The fonts of a page and of a picture: which face has a character, how wide it is, and which glyphs were used.
//!
//! Inter comes first; what its cut lacks (Cyrillic, Vietnamese, …) is taken from Ubuntu Light, then
//! from Hack, then from Noto Sans SC ([`crate::fonts`]). A character that none of
//! them has is written as its code, `[U+4E2D]`, and is under the code as itself for copying
//! or searches the text.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use subsetter::GlyphRemapper;

use super::pdf::PdfError;
use crate::fonts::{Face, INTER, INTER_SEMI_BOLD, NOTO_SANS_SC, cff_table};
use crate::present::chart::is_wide;

/// Every bundled face, by its number.
const FILES: [(&str, &[u8]); 5] = [
    ("Inter-Regular", INTER),
    ("Inter-SemiBold", INTER_SEMI_BOLD),
    ("Ubuntu-Light", epaint_default_fonts::UBUNTU_LIGHT),
    ("Hack-Regular", epaint_default_fonts::HACK_REGULAR),
    ("NotoSansSC-Regular", NOTO_SANS_SC),
];

/// A piece of text in one face.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Run {
    /// Number of the face.
    pub(super) face: usize,
    /// Glyphs, each with the character it stands for.
    pub(super) glyphs: Vec<(u16, char)>,
    /// Width at a size of 1.
    pub(super) width: f64,
    /// The character that is meant, where a code stands for it.
    pub(super) instead_of: Option<char>,
}

/// One face and its file.
struct Source {
    name: &'static str,
    data: &'static [u8],
    face: Face<'static>,
}

/// The fonts of a report, with the glyphs that it uses.
pub(super) struct Fonts {
    sources: Vec<Source>,
    /// What was asked for, and no face has.
    missing: RefCell<BTreeSet<char>>,
}

impl Fonts {
    pub(super) fn new() -> Result<Self, PdfError> {
        let source = |(name, data): &(&'static str, &'static [u8])| {
            let face = Face::parse(data).ok_or_else(|| PdfError::Font((*name).to_owned()))?;
            Ok(Source { name, data, face })
        };
        Ok(Self {
            sources: FILES.iter().map(source).collect::<Result<_, _>>()?,
            missing: RefCell::default(),
        })
    }

    pub(super) fn count(&self) -> usize {
        self.sources.len()
    }

    pub(super) fn name(&self, face: usize) -> &str {
        self.sources[face].name
    }

    pub(super) fn face(&self, face: usize) -> &Face<'static> {
        &self.sources[face].face
    }

    /// Characters that were asked for so far, and that no face has.
    pub(super) fn missing(&self) -> BTreeSet<char> {
        self.missing.borrow().clone()
    }

    /// The text in runs of one face each.
    pub(super) fn runs(&self, text: &str, bold: bool) -> Vec<Run> {
        let first = usize::from(bold);
        let order: Vec<usize> = std::iter::once(first).chain(2..self.count()).collect();
        let mut runs: Vec<Run> = Vec::new();
        for c in text.chars() {
            let found = order.iter().find_map(|face| {
                let glyph = self.face(*face).glyph(c)?;
                Some((*face, glyph))
            });
            let Some((face, glyph)) = found else {
                self.missing.borrow_mut().insert(c);
                runs.push(self.code(c, first));
                continue;
            };
            let width = self.advance(face, glyph);
            match runs.last_mut() {
                Some(run) if run.face == face && run.instead_of.is_none() => {
                    run.glyphs.push((glyph, c));
                    run.width += width;
                }
                _ => runs.push(Run {
                    face,
                    glyphs: vec![(glyph, c)],
                    width,
                    instead_of: None,
                }),
            }
        }
        runs
    }

    /// The code of a character that no face has.
    fn code(&self, c: char, face: usize) -> Run {
        let text = format!("[U+{:04X}]", u32::from(c));
        let glyph = |c: char| self.face(face).glyph(c).unwrap_or(0);
        let glyphs: Vec<(u16, char)> = text.chars().map(|c| (glyph(c), c)).collect();
        Run {
            face,
            width: glyphs.iter().map(|(g, _)| self.advance(face, *g)).sum(),
            glyphs,
            instead_of: Some(c),
        }
    }

    /// Width of a glyph at a size of 1.
    pub(super) fn advance(&self, face: usize, glyph: u16) -> f64 {
        let face = self.face(face);
        face.advance(glyph) / face.units_per_em()
    }

    /// Width of a text, points.
    pub(super) fn width(&self, text: &str, size: f64, bold: bool) -> f64 {
        self.runs(text, bold).iter().map(|r| r.width).sum::<f64>() * size
    }

    /// A text in lines that are no wider than `width`; a word that is wider is cut. Letters of East Asian scripts are
    /// words of their own, without spaces between them.
    pub(super) fn wrapped(&self, text: &str, size: f64, bold: bool, width: f64) -> Vec<String> {
        let space = self.width(" ", size, bold);
        let mut lines: Vec<String> = Vec::new();
        let mut line = String::new();
        let mut used = 0.0;
        let words = text.split(' ').filter(|w| !w.is_empty());
        let parts = words.flat_map(|word| {
            let parts = breakable(word).into_iter().enumerate();
            parts.map(|(k, part)| (part, k == 0))
        });
        for (word, is_first) in parts {
            let long = self.width(word, size, bold);
            let apart = if is_first { space } else { 0.0 };
            if !line.is_empty() && used + apart + long > width {
                lines.push(std::mem::take(&mut line));
                used = 0.0;
            }
            if long > width {
                for c in word.chars() {
                    let wide = self.width(c.encode_utf8(&mut [0; 4]), size, bold);
                    if !line.is_empty() && used + wide > width {
                        lines.push(std::mem::take(&mut line));
                        used = 0.0;
                    }
                    line.push(c);
                    used += wide;
                }
                continue;
            }
            if !line.is_empty() && is_first {
                line.push(' ');
                used += space;
            }
            line.push_str(word);
            used += long;
        }
        if !line.is_empty() || lines.is_empty() {
            lines.push(line);
        }
        lines
    }
}

/// A word in the parts between which a line may end: beside a letter of an East Asian script, but not before what
/// closes and not behind what opens (GB/T 15834: no mark at the beginning of a line but those that open).
pub(super) fn breakable(word: &str) -> Vec<&str> {
    const CLOSES: &str = "，。；：、？！）》」』”’,.;:)%…";
    const OPENS: &str = "（《「『“‘(";
    let mut parts = Vec::new();
    let mut from = 0;
    let letters = word.char_indices().zip(word.chars().skip(1));
    for ((at, c), next) in letters {
        let wide = is_wide(c) || is_wide(next);
        if wide && !CLOSES.contains(next) && !OPENS.contains(c) {
            parts.push(&word[from..at + c.len_utf8()]);
            from = at + c.len_utf8();
        }
    }
    parts.push(&word[from..]);
    parts
}

/// The glyphs of one face that a document uses, under their numbers in the embedded part.
#[derive(Default)]
pub(super) struct Used {
    numbers: GlyphRemapper,
    means: BTreeMap<u16, char>,
}

impl Used {
    /// The number of a glyph in the embedded part.
    pub(super) fn number(&mut self, glyph: u16, c: char) -> u16 {
        let number = self.numbers.remap(glyph);
        self.means.entry(number).or_insert(c);
        number
    }

    pub(super) fn is_empty(&self) -> bool {
        self.means.is_empty()
    }

    /// What each number means, in ascending order.
    pub(super) fn meanings(&self) -> impl Iterator<Item = (u16, char)> {
        self.means.iter().map(|(number, c)| (*number, *c))
    }

    /// The glyphs in the order of their numbers.
    pub(super) fn glyphs(&self) -> impl Iterator<Item = u16> {
        self.numbers.remapped_gids()
    }

    /// The part of the face that is embedded.
    pub(super) fn embedded(&self, fonts: &Fonts, face: usize) -> Result<Embedded, PdfError> {
        let source = &fonts.sources[face];
        let cut = subsetter::subset(source.data, 0, &self.numbers);
        let cut = cut.map_err(|_| PdfError::Font(source.name.to_owned()))?;
        Ok(match cff_table(&cut) {
            Some(table) => Embedded::Cff(table.to_vec()),
            None => Embedded::TrueType(cut),
        })
    }
}

/// A part of a font, as ISO 32000-1, table 126, has it in a file.
pub(super) enum Embedded {
    /// A font with its tables, for `FontFile2`.
    TrueType(Vec<u8>),
    /// The table of outlines alone, for `FontFile3` of the kind `CIDFontType0C`.
    Cff(Vec<u8>),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_character_is_shown_or_named() {
        let fonts = Fonts::new().unwrap();
        let runs = fonts.runs("Ось ± 中ก", false);
        let faces: Vec<usize> = runs.iter().map(|r| r.face).collect();
        assert_eq!(faces, [2, 0, 4, 0], "Cyrillic, Inter, Chinese, a code");
        assert_eq!(runs[3].instead_of, Some('ก'));
        let code: String = runs[3].glyphs.iter().map(|(_, c)| c).collect();
        assert_eq!(code, "[U+0E01]");
    }

    #[test]
    fn what_the_report_writes_is_in_inter() {
        let fonts = Fonts::new().unwrap();
        for bold in [false, true] {
            let runs = fonts.runs("0123456789.−+–…→↑↓·×°µ≤Δθσχ√ ⅓".trim_end_matches('⅓'), bold);
            assert_eq!(runs.len(), 1, "{runs:?}");
            assert_eq!(runs[0].face, usize::from(bold));
        }
    }

    #[test]
    fn lines_keep_within_their_width_and_lose_nothing() {
        let fonts = Fonts::new().unwrap();
        let text = "a long line with averyveryveryverylongword in it";
        let lines = fonts.wrapped(text, 9.0, false, 60.0);
        assert!(
            lines
                .iter()
                .all(|l| fonts.width(l, 9.0, false) <= 60.0 + 1e-9)
        );
        let letters = |s: &str| s.chars().filter(|c| *c != ' ').collect::<String>();
        assert_eq!(letters(&lines.concat()), letters(text));
        assert_eq!(fonts.wrapped("", 9.0, false, 60.0), [""]);
    }

    #[test]
    fn lines_end_beside_letters_of_east_asian_scripts() {
        let parts = breakable("在 0.2 mm 以内");
        assert_eq!(parts, ["在", " 0.2 mm ", "以", "内"]);
        assert_eq!(
            breakable("误差（均方根）。"),
            ["误", "差", "（均", "方", "根）。"]
        );
        assert_eq!(breakable("cross-validated"), ["cross-validated"]);
        assert_eq!(breakable(""), [""]);
    }
}
