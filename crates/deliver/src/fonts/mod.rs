//! Letters: which the bundled fonts have, and where a font for the others is found on the machine.
//!
//! Four fonts travel with the program: Inter in two weights, Ubuntu Light (Cyrillic, Greek,
//! Vietnamese) and Hack (arrows, mathematical signs). The tens of thousands of Chinese, Japanese and
//! Korean characters would add megabytes, and nearly every machine on which they are written has a
//! font with them. So: only where a text holds a character M that none of the bundled fonts has, the
//! faces that are installed are looked through ([`Library`]), and of those the face
//!
//! ```text
//! f* = argmax over f in the first class that has any of M of ( |C(f) ∩ M|, −r(f) )
//! ```
//!
//! is taken, then the same for what it leaves of M, up to [`MOST_FACES`] faces. C(f) is what the face
//! has. Classes, in this order: the families of a list (Noto Sans CJK, Source Han Sans, Microsoft
//! `YaHei`, `PingFang`, Hiragino, …), other families of Noto Sans, all others. The rank r goes by the place in that
//! list, then upright before slanted, nearest to the regular weight, the path and the number in the
//! file: the same machine gives the same face. Characters of Japanese or Korean alone (kana, hangul)
//! let their families come first in the list; ideographs alone are taken for Chinese.
//!
//! Conventions. A face is looked at only if it has outlines and its file can be read. Characters
//! that are never drawn (controls, joiners, variation selectors) and private ones, which mean
//! something else in every font, are not looked for.
//!
//! What is not done: scripts from right to left and scripts whose letters join or reorder (Arabic,
//! Devanagari, …) are found, but a PDF has their letters one by one, from left to right; a text in
//! two languages that write one ideograph in two ways is written in one of the two; no line is broken
//! by the rules of Chinese or Japanese typesetting; fonts installed while the program runs are seen
//! when it is started again.
//!
//! Source of the tables that are read: `OpenType` 1.9, `cmap`, `OS/2`, `name`.

mod face;
mod library;
#[cfg(test)]
mod tests;
#[cfg(test)]
#[path = "../../../../tests/support/tiny_font.rs"]
pub(crate) mod tiny_font;
mod unshown;

pub(crate) use face::{Face, cff_table};
pub use library::{FaceSelection, Library, MOST_FACES, Purpose, SystemFace};
pub use unshown::{cannot_be_shown, is_worth_a_font};

/// Inter, regular.
pub const INTER: &[u8] = include_bytes!("../../assets/fonts/Inter-Regular.ttf");

/// Inter, semi-bold.
pub const INTER_SEMI_BOLD: &[u8] = include_bytes!("../../assets/fonts/Inter-SemiBold.ttf");

#[cfg(test)]
mod words {
    use super::*;

    #[test]
    fn what_is_not_drawn_needs_no_font() {
        for c in ['中', '한', 'ア', '\u{3000}', 'ก', '😀', 'a'] {
            assert!(is_worth_a_font(c), "{c:?}");
        }
        for c in [
            '\n',
            '\u{200D}',
            '\u{FE0F}',
            '\u{E000}',
            '\u{FFFF}',
            '\u{1FFFE}',
            '\u{FEFF}',
        ] {
            assert!(!is_worth_a_font(c), "{c:?}");
        }
    }

    #[test]
    fn what_cannot_be_shown_is_said_with_what_to_do() {
        let says = |text: &str| cannot_be_shown(&text.chars().collect()).to_string();
        assert_eq!(
            says("中"),
            "no font here has 中 (U+4E2D); install one, such as Noto Sans CJK, and start the \
             program again"
        );
        let many = says("中国机器人");
        assert!(
            many.contains("中 (U+4E2D), 人 (U+4EBA) and 3 more;"),
            "{many}"
        );
        assert!(!says("ก").contains("CJK"));
    }
}
