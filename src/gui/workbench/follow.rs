//! Samples that come while the window is open.
//!
//! A file is followed that something else goes on writing: the watcher reads what is new; a task puts it
//! behind the samples that are there and brings the answer along, so that the window goes from one session
//! with its answer to the next. An instrument is recorded: its lines become the samples of a new session
//! of the robot that is open, which the window opens and follows.

use std::path::Path;
use std::sync::Arc;

use crate::diagnostic::Rejected;
use crate::gui::cache::cloud::Cloud;
use crate::gui::cache::identified::IdentifiedAnswer;
use crate::gui::core::document::{Document, Question};
use crate::gui::core::loaded_session::LoadedSession;
use crate::gui::file_state::recording::{Heard, Recording, RecordingRequest, UnderWay};
use crate::gui::file_state::watcher::Order;
use crate::gui::jobs::Watch;
use crate::gui::view::{Message, NextAction};
use crate::language::finding;
use crate::pipeline;
use crate::sessions::{Growing, Growth, Replacing, Samples, Session, save_document};

use super::Workbench;

/// A session that has grown, with the answer to what was asked of it.
struct Extended {
    from: Arc<LoadedSession>,
    to: Arc<LoadedSession>,
    identified: Option<IdentifiedAnswer>,
}

impl Workbench {
    /// Follows the session's samples file, or stops.
    pub(super) fn follow(&mut self, on: bool) {
        self.waiting_samples = None;
        if !on {
            if self.file_state.followed.is_some() {
                self.set_followed(None);
                self.order(Order::Follow(None));
            }
            return;
        }
        let Some(path) = self.samples_file() else {
            return self.complain(
                say!("There is no file to follow"),
                [say!(
                    "The samples of this session are not in a file of their own"
                )],
            );
        };
        let growing = Growing::new(&self.loaded_session().session, path);
        let lineage = self.loaded_session().lineage;
        self.set_followed(Some(lineage));
        self.order(Order::Follow(Some(Box::new(growing))));
        self.look_at_disk();
    }

    pub(super) fn take_growth(&mut self, growth: Result<Growth, Rejected>) {
        if self.following().is_none() {
            return;
        }
        match growth {
            Ok(Growth::Nothing) => {}
            Ok(Growth::More(samples)) => {
                self.count_new(samples.len());
                self.extend(samples, false);
            }
            Ok(Growth::Anew(samples)) => {
                let before = self.loaded_session().len();
                let grown = samples.len() >= before && starts_with(&samples, self.loaded_session());
                self.count_new(samples.len().saturating_sub(before));
                if !grown {
                    self.view.message = Some(Message::done(
                        say!("The file was rewritten and is read anew").to_owned(),
                        Vec::new(),
                    ));
                }
                if samples.len() != before || !grown {
                    self.extend(samples, true);
                }
            }
            Err(rejected) => {
                self.set_followed(None);
                let lines = rejected.diagnostics.iter().take(5).map(finding);
                let mut details: Vec<String> = lines.collect();
                details.push(
                    say!(
                        "What was read before is still here; correct the file, then follow it again"
                    )
                    .to_owned(),
                );
                self.complain(say!("The file cannot be followed any further"), details);
            }
        }
    }

    /// Puts samples behind those of the session, or in their place.
    fn extend(&mut self, samples: Samples, anew: bool) {
        if self.extending {
            // One at a time; what comes in between waits together.
            match &mut self.waiting_samples {
                Some((waiting, _)) if !anew => waiting.append(samples),
                waiting => *waiting = Some((samples, anew)),
            }
            return;
        }
        self.extending = true;
        let from = Arc::clone(self.loaded_session());
        let question = self.document().question();
        let work = move || {
            let mut session = from.session.clone();
            if anew {
                session.samples = samples;
            } else {
                session.samples.append(samples);
            }
            let to = Arc::new(LoadedSession::with_samples(&from, session));
            Cloud::of(&to);
            let outcome = question.map(|question| {
                let question = Question {
                    loaded_session: Arc::clone(&to),
                    ..question
                };
                IdentifiedAnswer::of(question, &Watch::default())
            });
            Extended {
                from,
                to,
                identified: outcome,
            }
        };
        self.jobs.quietly(work, Self::take_extended);
    }

    fn take_extended(&mut self, extended: Extended) {
        self.extending = false;
        let Extended {
            from,
            to,
            identified: outcome,
        } = extended;
        if !Arc::ptr_eq(&from, self.loaded_session()) {
            // The robot was edited or something was undone meanwhile: from the start, with what
            // is here now.
            if self.following().is_some() {
                self.follow(true);
            }
            return;
        }
        self.history.rewrite(|document| {
            Arc::ptr_eq(&document.loaded_session, &from).then(|| Document {
                loaded_session: Arc::clone(&to),
                ..document.clone()
            })
        });
        self.grow_on_file(&from, &to);
        if let Some(outcome) = outcome {
            self.identified = Some(Arc::new(outcome));
        }
        self.forget_missing_samples();
        self.refresh_answer();
        self.keep_preparing();
        if let Some((samples, anew)) = self.waiting_samples.take() {
            self.extend(samples, anew);
        }
    }

    /// What is being recorded, and how it stands.
    pub(crate) fn recording(&self) -> Option<(&RecordingRequest, &Heard)> {
        let under_way = self.file_state.recording.as_ref()?;
        Some((&under_way.recording.wanted, &under_way.heard))
    }

    /// Begins to record.
    pub(super) fn record(&mut self, mut wanted: RecordingRequest) {
        wanted.path = self.placed(&wanted.path);
        let title = say!("Nothing can be recorded");
        if let Some(problem) = wanted.problem() {
            return self.complain(title, vec![problem]);
        }
        let post = self.jobs.post();
        let tell = move || post(Box::new(Self::hear));
        match Recording::start(wanted, tell) {
            Err(problem) => self.complain(title, vec![problem]),
            Ok(recording) => {
                self.file_state.recording = Some(UnderWay {
                    recording,
                    heard: Heard::default(),
                    opened: false,
                });
                self.view.sheet = None;
            }
        }
    }

    /// Ends it; what was recorded stays, and is followed no more.
    pub(super) fn stop_recording(&mut self) {
        let Some(under_way) = self.file_state.recording.take() else {
            return;
        };
        let heard = under_way.recording.look();
        // Lines that came last are read before.
        self.look_at_disk();
        if heard.recorded > 0 {
            let path = under_way.recording.wanted.path.clone();
            let title = say!(
                "Recorded {path}: {says}",
                path = path.display(),
                says = heard.describe()
            );
            self.view.message = Some(Message::done(title, Vec::new()));
        }
    }

    /// Takes what was heard.
    fn hear(&mut self) {
        let Some(under_way) = &mut self.file_state.recording else {
            return;
        };
        under_way.heard = under_way.recording.look();
        if let Some(Err(problem)) = &under_way.heard.over {
            let details = vec![
                problem.clone(),
                say!("What was recorded before is in the file").to_owned(),
            ];
            self.file_state.recording = None;
            return self.complain(say!("The recording ended"), details);
        }
        if under_way.heard.recorded > 0 && !under_way.opened {
            under_way.opened = true;
            let wanted = under_way.recording.wanted.clone();
            self.open_recording(wanted);
        }
    }

    /// Makes a session of the open robot and the table that grows. A table that has other columns is
    /// opened as what an instrument wrote.
    fn open_recording(&mut self, wanted: RecordingRequest) {
        let session = self.new_session(&wanted);
        let work = move || {
            let path = wanted.session();
            let made = save_document(&session, &path, Replacing::default());
            match made.map(|()| pipeline::load(&path)) {
                Ok(Ok(_)) => (path, true),
                Ok(Err(_)) => {
                    // It was made a moment ago, and says nothing that is not here still.
                    let _ = std::fs::remove_file(&path);
                    (wanted.path, false)
                }
                Err(_) => (wanted.path, false),
            }
        };
        self.jobs.quietly(work, |bench: &mut Self, (path, follow)| {
            bench.file_state.to_follow = follow.then(|| path.clone());
            bench.ask_then(NextAction::Open(path));
        });
    }

    /// A session of this robot and instrument without samples.
    fn new_session(&self, wanted: &RecordingRequest) -> Session {
        let open = &self.loaded_session().session;
        let name = wanted.path.file_stem().unwrap_or_default();
        Session {
            name: name.to_string_lossy().into_owned(),
            note: String::new(),
            robot: open.robot.clone(),
            targets: open.targets.clone(),
            instrument: open.instrument.clone(),
            tolerance_mm: self.document().tolerance_mm,
            regions: Vec::new(),
            compensated_by: open.compensated_by.clone(),
            samples: Samples::default(),
            path: None,
        }
    }

    /// A session was opened: the one that is being recorded is followed.
    pub(super) fn follow_recording(&mut self, path: Option<&Path>) {
        if path.is_some() && self.file_state.to_follow.take().as_deref() == path {
            self.follow(true);
        }
    }
}

/// Whether the samples begin with those of the session.
fn starts_with(samples: &Samples, loaded_session: &LoadedSession) -> bool {
    let before = &loaded_session.session.samples;
    let begins = |all: &[f64], start: &[f64]| {
        let pairs = all.iter().zip(start);
        start.len() <= all.len() && pairs.into_iter().all(|(a, b)| a.to_bits() == b.to_bits())
    };
    begins(&samples.x_mm, &before.x_mm) && begins(&samples.y_mm, &before.y_mm)
}
