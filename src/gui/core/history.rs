//! Undo and redo: documents as they were, and what led from one to the next.

use std::sync::{Arc, Weak};

use crate::text::Template;

use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::LoadedSession;

/// Entries that are kept; the oldest goes first.
const MOST_ENTRIES: usize = 200;

/// A document and, where its session differs from another in nothing but what is excluded, that other session and
/// what: a million samples are not kept once for each that was excluded.
#[derive(Debug)]
struct Kept {
    document: Document,
    /// The session as it was, for as long as anybody looks at it, and what is excluded of the one in the document.
    excluding: Option<(Weak<LoadedSession>, Vec<usize>)>,
}

impl Kept {
    fn of(document: Arc<Document>) -> Self {
        let mut document = Arc::unwrap_or_clone(document);
        let made_of = document.loaded_session.made_of();
        let made_of = made_of.map(|(whole, excluded)| (Arc::clone(whole), excluded));
        let excluding = made_of.map(|(whole, excluded)| {
            let session = std::mem::replace(&mut document.loaded_session, whole);
            (Arc::downgrade(&session), excluded)
        });
        Self {
            document,
            excluding,
        }
    }

    fn whole(self) -> Arc<Document> {
        let mut document = self.document;
        if let Some((session, excluded)) = self.excluding {
            let again = || {
                Arc::new(LoadedSession::excluding(
                    &document.loaded_session,
                    &excluded,
                ))
            };
            document.loaded_session = session.upgrade().unwrap_or_else(again);
        }
        Arc::new(document)
    }
}

#[derive(Debug)]
struct Entry {
    document: Kept,
    what: Template,
}

/// Undo and redo: whole documents, one entry for each finished gesture.
///
/// Documents share what did not change behind `Arc`s, so that keeping many costs little. While a
/// gesture (a drag) is under way the document changes many times; only its state before the
/// gesture is kept.
pub(crate) struct History {
    present: Arc<Document>,
    past: Vec<Entry>,
    future: Vec<Entry>,
    /// The document before the gesture that is under way.
    gesture: Option<Arc<Document>>,
}

impl History {
    /// A history that starts here.
    pub(crate) fn new(document: Document) -> Self {
        Self {
            present: Arc::new(document),
            past: Vec::new(),
            future: Vec::new(),
            gesture: None,
        }
    }

    /// The document as it is now.
    pub(crate) fn present(&self) -> &Arc<Document> {
        &self.present
    }

    /// A finished change.
    pub(crate) fn change(&mut self, document: Document) {
        self.finish_gesture();
        self.change_within_gesture(document);
        self.finish_gesture();
    }

    /// A change within a gesture; the first one begins it.
    pub(crate) fn change_within_gesture(&mut self, document: Document) {
        if *self.present != document {
            let before = std::mem::replace(&mut self.present, Arc::new(document));
            self.gesture.get_or_insert(before);
        }
    }

    /// Ends the gesture that is under way: one entry, unless it came back to where it began.
    pub(crate) fn finish_gesture(&mut self) {
        let before = self.gesture.take();
        let Some(before) = before.filter(|before| **before != *self.present) else {
            return;
        };
        let what = Document::edit(&before, &self.present);
        let document = Kept::of(before);
        self.past.push(Entry { document, what });
        self.future.clear();
        if self.past.len() > MOST_ENTRIES {
            self.past.remove(0);
        }
    }

    /// What the next undo takes back.
    pub(crate) fn undoes(&self) -> Option<Template> {
        let open = self.gesture.as_ref();
        let open = open.map(|before| Document::edit(before, &self.present));
        open.or_else(|| Some(self.past.last()?.what))
    }

    /// What the next redo brings back.
    pub(crate) fn redoes(&self) -> Option<Template> {
        self.future.last().map(|entry| entry.what)
    }

    /// Takes the last change back. Whether there was one.
    pub(crate) fn undo(&mut self) -> bool {
        self.finish_gesture();
        step(&mut self.present, &mut self.past, &mut self.future)
    }

    /// Brings the last undone change back. Whether there was one.
    pub(crate) fn redo(&mut self) -> bool {
        self.finish_gesture();
        step(&mut self.present, &mut self.future, &mut self.past)
    }
}

/// The newest entry of one side is the present one now, which is kept on the other. Whether there was one.
fn step(present: &mut Arc<Document>, from: &mut Vec<Entry>, to: &mut Vec<Entry>) -> bool {
    let Some(Entry { document, what }) = from.pop() else {
        return false;
    };
    let document = std::mem::replace(present, document.whole());
    to.push(Entry {
        document: Kept::of(document),
        what,
    });
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A document that differs from others by its tolerance.
    fn document(tolerance: i32) -> Document {
        thread_local! {
            static FIRST: Document = crate::gui::testing::workbench().document().clone();
        }
        Document {
            tolerance_mm: Some(f64::from(tolerance)),
            ..FIRST.with(Clone::clone)
        }
    }

    fn present(history: &History) -> f64 {
        history.present().tolerance_mm.expect("it has one")
    }

    #[test]
    fn a_gesture_is_one_entry_however_many_steps_it_has() {
        let mut history = History::new(document(0));
        for k in 1..=50 {
            history.change_within_gesture(document(k));
        }
        history.finish_gesture();
        assert!(history.undoes().is_some());
        assert!(history.undo());
        assert_eq!(present(&history), 0.0);
        assert!(!history.undo());
        assert!(history.redo());
        assert_eq!(present(&history), 50.0);
    }

    #[test]
    fn a_gesture_that_comes_back_leaves_no_entry() {
        let mut history = History::new(document(7));
        history.change_within_gesture(document(8));
        history.change_within_gesture(document(7));
        history.finish_gesture();
        assert_eq!(history.undoes(), None);
    }

    #[test]
    fn undo_in_the_middle_of_a_gesture_takes_the_gesture_back() {
        let mut history = History::new(document(1));
        history.change(document(2));
        history.change_within_gesture(document(3));
        assert!(history.undo());
        assert_eq!(present(&history), 2.0);
    }

    #[test]
    fn a_new_change_after_undo_forgets_what_was_undone() {
        let mut history = History::new(document(1));
        history.change(document(2));
        history.undo();
        history.change(document(3));
        assert!(!history.redo());
        assert_eq!(present(&history), 3.0);
    }

    #[test]
    fn the_history_does_not_grow_without_end() {
        let mut history = History::new(document(0));
        for k in 1..=2 * i32::try_from(MOST_ENTRIES).unwrap() {
            history.change(document(k));
        }
        let mut undone = 0;
        while history.undo() {
            undone += 1;
        }
        assert_eq!(undone, MOST_ENTRIES);
    }
}
