//! One question at a time, and the latest one after it.

/// One question at a time, and the latest one after it.
#[derive(Debug)]
pub(crate) struct Latest<Q> {
    asked: Option<Q>,
    waiting: Option<Q>,
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
    pub(crate) fn ask(&mut self, question: Q) -> Option<Q> {
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

    /// Whether this is the last that was asked, and has no answer yet.
    pub(crate) fn is_asked(&self, question: &Q) -> bool {
        self.waiting.as_ref().or(self.asked.as_ref()) == Some(question)
    }

    /// Forgets everything that was asked; the last of it.
    pub(crate) fn forget(&mut self) -> Option<Q> {
        let Self { asked, waiting } = std::mem::take(self);
        waiting.or(asked)
    }

    /// The question is answered; the one that is next.
    pub(crate) fn answered(&mut self) -> Option<Q> {
        self.asked = None;
        let next = self.waiting.take()?;
        self.ask(next)
    }
}
