//! Fonts of a few letters, made in memory: every letter is a box as wide as its font says. Enough of
//! `OpenType` 1.9 for a `TrueType` font that can be read, drawn and cut.

#![allow(unreachable_pub, reason = "included in several tests")]

use std::collections::BTreeSet;

/// A font to be made.
#[derive(Debug, Clone)]
pub struct Tiny {
    pub family: &'static str,
    pub letters: &'static str,
    /// Regular is 400.
    pub weight: u16,
    /// What its licence lets be embedded, as `OS/2` has it; 2: nothing.
    pub fs_type: u16,
    /// Of a thousandth of its size.
    pub advance: u16,
}

impl Tiny {
    pub fn new(family: &'static str, letters: &'static str) -> Self {
        Self {
            family,
            letters,
            weight: 400,
            fs_type: 0,
            advance: 1000,
        }
    }

    pub fn file(&self) -> Vec<u8> {
        self.at(0)
    }

    /// The font as it stands in a file from this place on.
    fn at(&self, base: usize) -> Vec<u8> {
        let letters: BTreeSet<char> = self.letters.chars().collect();
        let glyphs = u16::try_from(letters.len() + 1).expect("a few letters");
        let mut tables = [
            (*b"OS/2", self.os2()),
            (*b"cmap", cmap(&letters)),
            (*b"glyf", vec![]),
            (*b"head", head()),
            (*b"hhea", hhea(glyphs)),
            (*b"hmtx", vec![]),
            (*b"loca", vec![]),
            (*b"maxp", maxp(glyphs)),
            (*b"name", self.name()),
            (*b"post", post()),
        ];
        for k in 0..=glyphs {
            tables[6].1.extend(u32::from(k * 36).to_be_bytes());
        }
        for _ in 0..glyphs {
            tables[2].1.extend(self.letter());
            tables[5].1.extend(words(&[self.advance, 50]));
        }
        let mut file = words(&[1, 0, 10, 128, 3, 32]);
        let mut content = Vec::new();
        for (tag, table) in tables {
            let place = base + 12 + 16 * 10 + content.len();
            file.extend(tag);
            for word in [0, place, table.len()] {
                file.extend(u32::try_from(word).expect("a small file").to_be_bytes());
            }
            content.extend(table);
            content.resize(content.len().next_multiple_of(4), 0);
        }
        file.extend(content);
        file
    }

    /// A box.
    fn letter(&self) -> Vec<u8> {
        let right = self.advance - 50;
        let mut glyph = words(&[1, 50, 0, right, 800, 3, 0]);
        glyph.extend([1; 4]);
        let width = right - 50;
        glyph.extend(words(&[50, 0, width, 0]));
        glyph.extend(words(&[0, 800, 0, 0_u16.wrapping_sub(800)]));
        glyph.resize(36, 0);
        glyph
    }

    fn os2(&self) -> Vec<u8> {
        let mut table = words(&[3, 500, self.weight, 5, self.fs_type]);
        table.resize(96, 0);
        table
    }

    fn name(&self) -> Vec<u8> {
        let family: Vec<u8> = self
            .family
            .encode_utf16()
            .flat_map(u16::to_be_bytes)
            .collect();
        let length = u16::try_from(family.len()).expect("a short name");
        let mut table = words(&[0, 2, 30]);
        for id in [1, 6] {
            table.extend(words(&[3, 1, 0x409, id, length, 0]));
        }
        table.extend(family);
        table
    }
}

/// Several fonts in one file.
pub fn collection(fonts: &[Tiny]) -> Vec<u8> {
    let head = 12 + 4 * fonts.len();
    let mut file = b"ttcf".to_vec();
    file.extend(words(&[
        1,
        0,
        0,
        u16::try_from(fonts.len()).expect("a few"),
    ]));
    let mut content = Vec::new();
    for font in fonts {
        let place = head + content.len();
        file.extend(u32::try_from(place).expect("a small file").to_be_bytes());
        content.extend(font.at(place));
    }
    file.extend(content);
    file
}

fn words(words: &[u16]) -> Vec<u8> {
    words.iter().flat_map(|w| w.to_be_bytes()).collect()
}

/// Format 12: one group for each letter.
fn cmap(letters: &BTreeSet<char>) -> Vec<u8> {
    let count = u32::try_from(letters.len()).expect("a few letters");
    let mut table = words(&[0, 1, 3, 10, 0, 12, 12, 0]);
    for word in [16 + 12 * count, 0, count] {
        table.extend(word.to_be_bytes());
    }
    for (k, c) in (1_u32..).zip(letters) {
        for word in [u32::from(*c), u32::from(*c), k] {
            table.extend(word.to_be_bytes());
        }
    }
    table
}

/// 1000 units, long places in `loca`.
fn head() -> Vec<u8> {
    let mut table = words(&[1, 0, 1, 0, 0, 0, 0x5F0F, 0x3CF5, 0, 1000]);
    table.resize(36, 0);
    table.extend(words(&[0, 0, 1000, 800, 0, 8, 2, 1, 0]));
    table
}

fn hhea(glyphs: u16) -> Vec<u8> {
    let mut table = words(&[1, 0, 800, 0_u16.wrapping_sub(200), 0]);
    table.resize(34, 0);
    table.extend(words(&[glyphs]));
    table
}

fn maxp(glyphs: u16) -> Vec<u8> {
    let mut table = words(&[1, 0, glyphs, 4, 1]);
    table.resize(32, 0);
    table
}

/// No names of glyphs.
fn post() -> Vec<u8> {
    let mut table = words(&[3, 0]);
    table.resize(32, 0);
    table
}
