//! One question at a time, and the latest one after it.

/// One question at a time, and the latest one after it.
#[derive(Debug)]
pub(super) struct Latest<Q> {
    pub(super) asked: Option<Q>,
    pub(super) waiting: Option<Q>,
}

impl<Q> Default for Latest<Q> {
    fn default() -> Self {
        Self {
            asked: None,
            waiting: None,
        }
    }
}

impl<Q: PartialEq + Clone> Latest<Q> {
    /// The question, if it is to be worked on now.
    pub(super) fn ask(&mut self, question: Q) -> Option<Q> {
        if self.asked.as_ref() == Some(&question) {
            self.waiting = None;
            None
        } else if self.asked.is_some() {
            self.waiting = Some(question);
            None
        } else {
            self.asked = Some(question.clone());
            Some(question)
        }
    }

    pub(super) fn is_asked(&self, question: &Q) -> bool {
        self.waiting.as_ref().or(self.asked.as_ref()) == Some(question)
    }

    /// The question is answered; the one that is next.
    pub(super) fn answered(&mut self) -> Option<Q> {
        self.asked = None;
        let next = self.waiting.take()?;
        self.ask(next)
    }
}
