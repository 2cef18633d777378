//! Letters: which the bundled fonts have.
//!
//! Five fonts travel with the program: Inter in two weights, Ubuntu Light (Cyrillic, Greek, Vietnamese), Hack (arrows,
//! mathematical signs), and of Noto Sans SC what the Chinese catalogue and GB 2312 have. A character
//! that none of them has is a box in the window and its code in a PDF, and the export says which.
//!
//! Source of the tables that are read: `OpenType` 1.9, `cmap`, `OS/2`, `name`.

mod face;
mod unshown;

pub(crate) use face::{Face, cff_table};
pub use unshown::{cannot_be_shown, is_worth_a_font};

/// Inter, regular.
pub const INTER: &[u8] = include_bytes!("../../assets/fonts/Inter-Regular.ttf");

/// Inter, semi-bold.
pub const INTER_SEMI_BOLD: &[u8] = include_bytes!("../../assets/fonts/Inter-SemiBold.ttf");

/// Noto Sans SC, regular.
pub const NOTO_SANS_SC: &[u8] = include_bytes!("../../assets/fonts/NotoSansSC-Regular.otf");

#[cfg(test)]
mod words {
    use super::*;
    use crate::text::Language;

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
    fn the_chinese_catalogue_can_be_read() {
        let face = Face::parse(NOTO_SANS_SC).unwrap();
        let lacking: String = crate::text::characters(Language::Chinese)
            .chain("中文深圳".chars())
            .filter(|c| face.glyph(*c).is_none())
            .collect();
        assert_eq!(lacking, "");
    }

    #[test]
    fn what_cannot_be_shown_is_said() {
        let says = |text: &str| cannot_be_shown(&text.chars().collect()).to_string();
        assert_eq!(says("ก"), "no bundled font has ก (U+0E01)");
        let many = says("กขคงจ");
        assert!(
            many.ends_with("ก (U+0E01), ข (U+0E02) and 3 more"),
            "{many}"
        );
    }
}
