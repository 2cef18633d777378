//! How a command fails, and what the terminal and the exit status say then.

use std::error::Error;
use std::fmt;
use std::io::Write;
use std::process::ExitCode;

use crate::atomic::WriteError;
use crate::compensation::{NotHandedOut, VerifyError};
use crate::diagnosis::DiagnoseError;
use crate::diagnostic::Rejected;
use crate::export::ExportError;
use crate::fit::IdentifyError;
use crate::language::{finding, spoken};
use crate::text::Text;

use super::plain::plain;

/// The input or the arguments are wrong.
pub(crate) const WRONG_INPUT: u8 = 2;
/// The program could not do its job.
const FAILED: u8 = 1;

/// See the module. `Display` is English, as documents have it.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The user can mend it.
    WrongInput(Text),
    /// The same, of this file or option.
    WrongAt(String, Text),
    /// The user can mend the places of files that are named.
    Rejected(Rejected),
    /// The user cannot.
    Failed(anyhow::Error),
}

impl Failure {
    /// An input that the core refused, in its words.
    pub(super) fn refused(says: Text) -> Self {
        Self::WrongInput(says)
    }

    /// Tells the user, once, and gives the exit status.
    pub(crate) fn report(&self) -> ExitCode {
        let status = match self {
            Self::WrongInput(_) | Self::WrongAt(..) | Self::Rejected(_) => WRONG_INPUT,
            Self::Failed(_) => FAILED,
        };
        let mut stderr = std::io::stderr().lock();
        // With standard error closed there is nothing left to write to.
        let _ = writeln!(stderr, "truepose: {}", plain(&self.spoken()));
        ExitCode::from(status)
    }

    /// In the language of this thread.
    pub(super) fn spoken(&self) -> String {
        match self {
            Self::WrongInput(text) => spoken(text),
            Self::WrongAt(place, text) => format!("{place}: {}", spoken(text)),
            Self::Rejected(rejected) => {
                let findings: Vec<String> = rejected.diagnostics.iter().map(finding).collect();
                findings.join("\n")
            }
            Self::Failed(error) => {
                let own = error.downcast_ref::<Text>().map(spoken);
                let own = own.unwrap_or_else(|| spoken(in_words(error.as_ref())));
                let causes = error.chain().skip(1).map(|one| spoken(in_words(one)));
                let all: Vec<String> = [own].into_iter().chain(causes).collect();
                all.join(": ")
            }
        }
    }
}

/// What an error says: one of the core in a sentence, any other in its own words.
fn in_words(error: &(dyn Error + 'static)) -> Text {
    if let Some(error) = error.downcast_ref::<WriteError>() {
        error.describe()
    } else if let Some(error) = error.downcast_ref::<NotHandedOut>() {
        error.describe()
    } else if let Some(error) = error.downcast_ref::<ExportError>() {
        error.describe()
    } else {
        Text::verbatim(error.to_string())
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WrongInput(text) => write!(f, "{text}"),
            Self::WrongAt(place, text) => write!(f, "{place}: {text}"),
            Self::Rejected(rejected) => write!(f, "{rejected}"),
            Self::Failed(error) => write!(f, "{error:#}"),
        }
    }
}

impl From<Rejected> for Failure {
    fn from(rejected: Rejected) -> Self {
        Self::Rejected(rejected)
    }
}

macro_rules! refused {
    ($($error:ident)*) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                match error {
                    $error::Rejected(rejected) => rejected.into(),
                    other => Self::refused(other.describe()),
                }
            }
        })*
    };
}

refused! { IdentifyError DiagnoseError VerifyError }

impl From<NotHandedOut> for Failure {
    fn from(error: NotHandedOut) -> Self {
        Self::Failed(error.into())
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        if error.is_refusal() {
            Self::refused(error.describe())
        } else {
            Self::Failed(error.into())
        }
    }
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        Self::Failed(error)
    }
}
