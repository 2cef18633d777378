//! How far long work is: one line on standard error that is written over, where that is a terminal.

use std::cell::RefCell;
use std::io::{IsTerminal, Write, stderr};

use crate::present::table::width;

use super::plain::plain;

/// Longer ones would wrap, and could not be written over.
const WIDEST: usize = 78;

/// The line, gone when it is dropped.
pub(crate) struct ProgressLine {
    shown: RefCell<String>,
    is_seen: bool,
}

impl ProgressLine {
    pub(crate) fn new() -> Self {
        Self {
            shown: RefCell::default(),
            is_seen: stderr().is_terminal(),
        }
    }

    /// Shows this in place of what was there.
    pub(crate) fn describe(&self, text: &str) {
        if !self.is_seen {
            return;
        }
        let text = cut(&plain(text));
        let mut shown = self.shown.borrow_mut();
        if *shown != text {
            // There is no place to report that standard error takes nothing.
            let _ = write!(stderr(), "\r\u{1b}[K{text}");
            let _ = stderr().flush();
            *shown = text;
        }
    }
}

/// As much of a text as fits into the line.
fn cut(text: &str) -> String {
    let mut taken = 0;
    let fits = |c: &char| {
        taken += width(c.encode_utf8(&mut [0; 4]));
        taken <= WIDEST
    };
    text.chars().take_while(fits).collect()
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        if !self.shown.borrow().is_empty() {
            let _ = write!(stderr(), "\r\u{1b}[K");
        }
    }
}
