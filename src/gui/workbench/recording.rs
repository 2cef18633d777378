//! Recording from an instrument: its lines become the samples of a new session of the robot that is
//! open, which the window opens and follows.

use std::path::Path;

use crate::gui::file_state::recording::{Heard, Recording, RecordingRequest, UnderWay};
use crate::gui::view::{Message, NextAction};
use crate::pipeline;
use crate::sessions::{Replacing, Samples, Session, save_document};

use super::Workbench;

impl Workbench {
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
