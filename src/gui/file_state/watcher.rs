//! Looks at open files from time to time: whether they are what they were, and whether a file that
//! is followed has grown.
//!
//! The looking itself is [`Watched::look`]; the window's tests call it. In the window a thread does,
//! once a second, and speaks only when something happened.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::Duration;

use crate::diagnostic::Rejected;
use crate::sessions::{Growing, Growth};

use crate::gui::core::disk::{FileChange, Fingerprint};

/// Between two looks.
pub(crate) const EVERY: Duration = Duration::from_secs(1);

/// What to look at from now on.
#[derive(Debug, Clone)]
pub(crate) enum Order {
    /// These files, as they looked when they were read, and the number of this order.
    Files(u64, Vec<Fingerprint>),
    /// This file grows; `None`: follow none.
    Follow(Option<Box<Growing>>),
    /// Whether these files are there.
    Recent(Vec<PathBuf>),
}

#[derive(Debug)]
pub(crate) enum Seen {
    /// A file is not what it was when the order of this number was given; `None`: it is again.
    FileChanged(u64, PathBuf, Option<FileChange>),
    /// The followed file has grown, was rewritten, or cannot be followed any more.
    Grew(Box<Result<Growth, Rejected>>),
    /// A file that was followed, as it is now that it was read to its end.
    Read(Fingerprint),
    /// Which of the recent files are not there.
    Missing(Vec<PathBuf>),
}

#[derive(Debug, Default)]
pub(crate) struct Watched {
    /// With what was said last about each.
    files: Vec<(Fingerprint, Option<FileChange>)>,
    /// The order that these files came with.
    number: u64,
    followed: Option<Box<Growing>>,
    recent: Vec<PathBuf>,
    missing: Vec<PathBuf>,
}

impl Watched {
    /// Looks at something else.
    pub(crate) fn order(&mut self, order: Order) -> Option<Seen> {
        match order {
            Order::Files(number, files) => {
                self.number = number;
                self.files = files.into_iter().map(|f| (f, None)).collect();
            }
            Order::Recent(recent) => self.recent = recent,
            Order::Follow(followed) => {
                let before = std::mem::replace(&mut self.followed, followed)?;
                let print = Fingerprint::of(before.path())?;
                // What was not read is a change that has to be told.
                if before.has_read(print.length()) {
                    let same = self.files.iter_mut().find(|(f, _)| f.path == print.path);
                    if let Some(file) = same {
                        *file = (print.clone(), None);
                    }
                    return Some(Seen::Read(print));
                }
            }
        }
        None
    }

    /// Looks at everything once. What was said is not said again.
    pub(crate) fn look(&mut self) -> Vec<Seen> {
        let mut seen = Vec::new();
        let followed = self.followed.as_ref().map(|f| f.path().to_path_buf());
        for (print, said) in &mut self.files {
            if Some(&print.path) == followed.as_ref() {
                continue;
            }
            // A file that was changed and then taken away is gone, which asks for something else;
            // one that was changed is not read again and again.
            let fate = match said {
                Some(FileChange::Changed) if print.path.is_file() => *said,
                _ => print.look(),
            };
            if fate != *said {
                *said = fate;
                seen.push(Seen::FileChanged(self.number, print.path.clone(), fate));
            }
        }
        if let Some(growing) = &mut self.followed {
            match growing.look() {
                Ok(Growth::Nothing) => {}
                Ok(growth) => seen.push(Seen::Grew(Box::new(Ok(growth)))),
                Err(rejected) => {
                    seen.push(Seen::Grew(Box::new(Err(rejected))));
                    self.followed = None;
                }
            }
        }
        let missing: Vec<PathBuf> = self
            .recent
            .iter()
            .filter(|p| !p.exists())
            .cloned()
            .collect();
        if missing != self.missing {
            self.missing.clone_from(&missing);
            seen.push(Seen::Missing(missing));
        }
        seen
    }

    /// Looks once a second until the orders end.
    pub(crate) fn keep_looking(mut self, orders: &Receiver<Order>, tell: impl Fn(Seen)) {
        loop {
            match orders.recv_timeout(EVERY) {
                Ok(order) => self.order(order).into_iter().for_each(&tell),
                Err(RecvTimeoutError::Disconnected) => return,
                Err(RecvTimeoutError::Timeout) => self.look().into_iter().for_each(&tell),
            }
        }
    }
}

/// Who looks at the disk.
#[derive(Debug)]
pub(crate) enum Watcher {
    /// The caller: [`Watcher::look`] has to be called from time to time.
    Here(Watched),
    /// A thread of its own; it ends with this.
    Thread(Sender<Order>),
}

impl Watcher {
    /// Begins to look on a thread, which tells what it sees.
    pub(crate) fn on_thread(tell: impl Fn(Seen) + Send + 'static) -> Self {
        let (orders, taken) = channel();
        let look = move || Watched::default().keep_looking(&taken, tell);
        let thread = std::thread::Builder::new().name("truepose watcher".to_owned());
        // Without it the window goes on, and notices a change when it saves.
        let _ = thread.spawn(look);
        Self::Thread(orders)
    }

    /// Looks at something else from now on.
    pub(crate) fn order(&mut self, order: Order) -> Option<Seen> {
        match self {
            Self::Here(watched) => watched.order(order),
            Self::Thread(orders) => {
                // A thread that could not be started looks at nothing.
                let _ = orders.send(order);
                None
            }
        }
    }

    /// Looks now, where no thread does.
    pub(crate) fn look(&mut self) -> Vec<Seen> {
        match self {
            Self::Here(watched) => watched.look(),
            Self::Thread(_) => Vec::new(),
        }
    }

    /// Whether the caller has to call [`Self::look`].
    pub(crate) fn wants_looking(&self) -> bool {
        matches!(self, Self::Here(_))
    }
}
