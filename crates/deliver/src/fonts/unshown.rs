//! Characters that the bundled fonts do not have.

use std::collections::BTreeSet;

use crate::text::Text;

/// Whether a character is drawn, and means the same in every font.
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

/// What to say of characters that no font has: which.
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
    text!("no bundled font has {characters}", characters)
}
