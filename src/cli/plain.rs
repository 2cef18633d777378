//! Text for a terminal.

/// Text without what a terminal would obey. A name in a file may hold control characters, and those
/// could move the cursor, change what was printed before, or rename the window.
pub(crate) fn plain(text: &str) -> String {
    let harmless = |c: char| {
        if c.is_control() && !matches!(c, '\n' | '\t') {
            '\u{FFFD}'
        } else {
            c
        }
    };
    text.chars().map(harmless).collect()
}
