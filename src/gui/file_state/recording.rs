//! Records from an instrument on a thread of its own until the window ends it. Only the latest state is
//! kept, and the window is woken once until it has read it: memory is bounded however seldom it looks.

use std::fs::OpenOptions;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};

use crate::gui::core::recording::{Heard, RecordingRequest};
use crate::recorder::Recorder;
use crate::recorder::live::record;
use crate::recorder::source::Address;

/// Between the thread and the window.
#[derive(Debug, Default)]
struct Shared {
    heard: Mutex<Heard>,
    stopped: AtomicBool,
    /// Whether the window was told, and has not looked yet.
    reported: AtomicBool,
}

/// A thread that records; it ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Recording {
    pub(crate) wanted: RecordingRequest,
    shared: Arc<Shared>,
}

/// A recording, as the window knows it.
#[derive(Debug)]
pub(crate) struct UnderWay {
    pub(crate) recording: Recording,
    pub(crate) heard: Heard,
    /// Whether its session was made already.
    pub(crate) opened: bool,
}

impl Recording {
    /// Begins; `tell` says to the window that it should look.
    pub(crate) fn start(
        wanted: RecordingRequest,
        tell: impl Fn() + Send + 'static,
    ) -> Result<Self, String> {
        let address = Address::parse(wanted.address.trim()).map_err(crate::language::spoken)?;
        let shared = Arc::new(Shared::default());
        let (own, path, columns) = (Arc::clone(&shared), wanted.path.clone(), wanted.columns());
        let listen = move || {
            let over = listened(&address, path, columns, &own, &tell);
            if let Ok(mut heard) = own.heard.lock() {
                heard.over = Some(over);
            }
            tell();
        };
        let thread = std::thread::Builder::new().name("truepose recording".to_owned());
        thread.spawn(listen).map_err(|error| error.to_string())?;
        Ok(Self { wanted, shared })
    }

    /// How it stands now.
    pub(crate) fn look(&self) -> Heard {
        self.shared.reported.store(false, Ordering::Relaxed);
        let heard = self.shared.heard.lock();
        heard.map_or_else(|_| Heard::default(), |heard| heard.clone())
    }
}

impl Drop for Recording {
    fn drop(&mut self) {
        self.shared.stopped.store(true, Ordering::Relaxed);
    }
}

fn listened(
    address: &Address,
    path: PathBuf,
    columns: Vec<String>,
    shared: &Shared,
    tell: &impl Fn(),
) -> Result<(), String> {
    let open = move || OpenOptions::new().write(true).create_new(true).open(path);
    let mut recorder = Recorder::new(open, columns);
    let done = record(address, &mut recorder, u64::MAX, &mut |standing| {
        if let Ok(mut heard) = shared.heard.lock() {
            let before = heard.clone();
            heard.state.clone_from(&standing.state);
            heard.recorded = standing.recorded;
            heard.refused = standing.refused;
            heard.breaks = standing.breaks;
            if let Some(last) = standing.left_out.last() {
                heard.last_refused = Some(last.clone());
            }
            if *heard != before && !shared.reported.swap(true, Ordering::Relaxed) {
                tell();
            }
        }
        if shared.stopped.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    if let Some(file) = recorder.out() {
        file.sync_all().map_err(|error| error.to_string())?;
    }
    done.map(drop).map_err(|error| error.to_string())
}
