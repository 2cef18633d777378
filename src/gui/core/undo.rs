//! Undo and redo: whole documents, one entry for each finished gesture.
//!
//! Documents share what did not change behind `Arc`s, so that keeping many costs little. While a
//! gesture (a drag) is under way the document changes many times; only its state before the
//! gesture is kept.

use crate::text::Template;
use std::sync::Arc;

/// Entries that are kept; the oldest goes first.
const MOST_ENTRIES: usize = 200;

#[derive(Debug, Clone)]
struct Entry<D> {
    document: Arc<D>,
    what: Template,
}

#[derive(Debug, Clone)]
pub(crate) struct History<D> {
    present: Arc<D>,
    past: Vec<Entry<D>>,
    future: Vec<Entry<D>>,
    /// The document before the gesture that is under way.
    gesture: Option<Entry<D>>,
}

impl<D: PartialEq> History<D> {
    /// A history that starts here.
    pub(crate) fn new(document: D) -> Self {
        Self {
            present: Arc::new(document),
            past: Vec::new(),
            future: Vec::new(),
            gesture: None,
        }
    }

    /// The document as it is now.
    pub(crate) fn present(&self) -> &Arc<D> {
        &self.present
    }

    /// A finished change.
    pub(crate) fn change(&mut self, document: D, what: Template) {
        self.finish_gesture();
        if *self.present == document {
            return;
        }
        let before = std::mem::replace(&mut self.present, Arc::new(document));
        self.keep(Entry {
            document: before,
            what,
        });
    }

    /// A change within a gesture; the first one begins it.
    pub(crate) fn change_within_gesture(&mut self, document: D, what: Template) {
        if self.gesture.as_ref().is_some_and(|g| g.what != what) {
            self.finish_gesture();
        }
        if *self.present == document {
            return;
        }
        let before = std::mem::replace(&mut self.present, Arc::new(document));
        self.gesture.get_or_insert(Entry {
            document: before,
            what,
        });
    }

    /// Ends the gesture that is under way: one entry, unless it came back to where it began.
    pub(crate) fn finish_gesture(&mut self) {
        if let Some(entry) = self.gesture.take()
            && *entry.document != *self.present
        {
            self.keep(entry);
        }
    }

    fn keep(&mut self, entry: Entry<D>) {
        self.past.push(entry);
        self.future.clear();
        if self.past.len() > MOST_ENTRIES {
            self.past.remove(0);
        }
    }

    /// Changes every document that is kept, the present one included, without an entry: something
    /// came to be true of all of them. `change` answers `None` where it leaves one as it is.
    pub(crate) fn rewrite(&mut self, change: impl Fn(&D) -> Option<D>) {
        let rewrite = |document: &mut Arc<D>| {
            if let Some(next) = change(document) {
                *document = Arc::new(next);
            }
        };
        rewrite(&mut self.present);
        let entries = self.past.iter_mut().chain(&mut self.future);
        for entry in entries.chain(&mut self.gesture) {
            rewrite(&mut entry.document);
        }
    }

    /// What the next undo takes back.
    pub(crate) fn undoes(&self) -> Option<Template> {
        let open = self.gesture.as_ref().or(self.past.last());
        open.map(|entry| entry.what)
    }

    /// What the next redo brings back.
    pub(crate) fn redoes(&self) -> Option<Template> {
        self.future.last().map(|entry| entry.what)
    }

    /// Takes the last change back. Whether there was one.
    pub(crate) fn undo(&mut self) -> bool {
        self.finish_gesture();
        let Some(Entry { document, what }) = self.past.pop() else {
            return false;
        };
        let after = std::mem::replace(&mut self.present, document);
        self.future.push(Entry {
            document: after,
            what,
        });
        true
    }

    /// Brings the last undone change back. Whether there was one.
    pub(crate) fn redo(&mut self) -> bool {
        self.finish_gesture();
        let Some(Entry { document, what }) = self.future.pop() else {
            return false;
        };
        let before = std::mem::replace(&mut self.present, document);
        self.past.push(Entry {
            document: before,
            what,
        });
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A name that no person reads.
    fn step(name: &'static str) -> Template {
        Template::new("", name, "")
    }

    #[test]
    fn a_gesture_is_one_entry_however_many_steps_it_has() {
        let mut history = History::new(0);
        for k in 1..=50 {
            history.change_within_gesture(k, step("drag"));
        }
        history.finish_gesture();
        assert_eq!(history.undoes(), Some(step("drag")));
        assert!(history.undo());
        assert_eq!(**history.present(), 0);
        assert!(!history.undo());
        assert!(history.redo());
        assert_eq!(**history.present(), 50);
    }

    #[test]
    fn a_gesture_that_comes_back_leaves_no_entry() {
        let mut history = History::new(7);
        history.change_within_gesture(8, step("drag"));
        history.change_within_gesture(7, step("drag"));
        history.finish_gesture();
        assert_eq!(history.undoes(), None);
    }

    #[test]
    fn undo_in_the_middle_of_a_gesture_takes_the_gesture_back() {
        let mut history = History::new(1);
        history.change(2, step("type"));
        history.change_within_gesture(3, step("drag"));
        assert!(history.undo());
        assert_eq!(**history.present(), 2);
    }

    #[test]
    fn a_new_change_after_undo_forgets_what_was_undone() {
        let mut history = History::new(1);
        history.change(2, step("a"));
        history.undo();
        history.change(3, step("b"));
        assert!(!history.redo());
        assert_eq!(**history.present(), 3);
    }

    #[test]
    fn what_came_to_be_true_of_all_is_no_step_of_its_own() {
        let mut history = History::new(1);
        history.change(2, step("a"));
        history.change(3, step("b"));
        history.undo();
        history.rewrite(|d| (*d != 1).then_some(10 * d));
        assert_eq!(**history.present(), 20);
        history.redo();
        assert_eq!(**history.present(), 30);
        history.undo();
        history.undo();
        assert_eq!(**history.present(), 1);
    }

    #[test]
    fn the_history_does_not_grow_without_end() {
        let mut history = History::new(0);
        for k in 1..=2 * MOST_ENTRIES {
            history.change(k, step("count"));
        }
        let mut undone = 0;
        while history.undo() {
            undone += 1;
        }
        assert_eq!(undone, MOST_ENTRIES);
    }
}
