//! Characters that the bundled fonts do not have.

use std::collections::BTreeSet;

use crate::text::Text;

/// Whether a font is worth looking for: the character is drawn, and means the same in every font.
pub fn is_worth_a_font(c: char) -> bool {
    let never_drawn = matches!(
        c,
        '\u{AD}'
            | '\u{34F}'
            | '\u{61C}'
            | '\u{115F}'..='\u{1160}'
            | '\u{17B4}'..='\u{17B5}'
            | '\u{180B}'..='\u{180F}'
            | '\u{200B}'..='\u{200F}'
            | '\u{2028}'..='\u{202E}'
            | '\u{2060}'..='\u{206F}'
            | '\u{3164}'
            | '\u{FE00}'..='\u{FE0F}'
            | '\u{FEFF}'
            | '\u{FFA0}'
            | '\u{FFF0}'..='\u{FFFB}'
            | '\u{E0000}'..='\u{E0FFF}'
    );
    let private = matches!(
        c,
        '\u{E000}'..='\u{F8FF}' | '\u{F0000}'..='\u{FFFFD}' | '\u{100000}'..='\u{10FFFD}'
    );
    let none = u32::from(c) & 0xFFFE == 0xFFFE || matches!(c, '\u{FDD0}'..='\u{FDEF}');
    !(c.is_control() || never_drawn || private || none)
}

/// What to say of characters that no font has: which, and what to do.
pub fn cannot_be_shown(unshown: &BTreeSet<char>) -> Text {
    const NAMED: usize = 2;
    let named: Vec<String> = unshown
        .iter()
        .take(NAMED)
        .map(|c| format!("{c} (U+{:04X})", u32::from(*c)))
        .collect();
    let named = named.join(", ");
    let characters = match unshown.len().saturating_sub(NAMED) {
        0 => Text::verbatim(named),
        more => text!("{first} and {more} more", first = named, more),
    };
    if unshown.iter().any(|c| is_east_asian(*c)) {
        text!(
            "no font here has {characters}; install one, such as Noto Sans CJK, and start the program again",
            characters
        )
    } else {
        text!(
            "no font here has {characters}; install one and start the program again",
            characters
        )
    }
}

pub(super) fn is_kana(c: char) -> bool {
    matches!(c, '\u{3041}'..='\u{30FF}' | '\u{31F0}'..='\u{31FF}' | '\u{FF66}'..='\u{FF9F}')
}

pub(super) fn is_hangul(c: char) -> bool {
    matches!(c, '\u{1100}'..='\u{11FF}' | '\u{3130}'..='\u{318F}' | '\u{AC00}'..='\u{D7A3}')
}

/// Whether a character belongs to Chinese, Japanese or Korean.
pub(super) fn is_east_asian(c: char) -> bool {
    is_hangul(c)
        || matches!(
            c,
            '\u{2E80}'..='\u{A4CF}' | '\u{F900}'..='\u{FAFF}' | '\u{FE30}'..='\u{FE4F}'
                | '\u{FF00}'..='\u{FFEF}' | '\u{20000}'..='\u{3FFFD}'
        )
}
