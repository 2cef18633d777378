//! How a command fails, and what the terminal and the exit status say then.

use std::fmt;
use std::io::Write;
use std::process::ExitCode;

use crate::atomic::WriteError;
use crate::compensation::NotHandedOut;
use crate::diagnostic::Rejected;
use crate::fit::IdentifyError;

use super::output::plain;

/// The input or the arguments are wrong.
pub(crate) const WRONG_INPUT: u8 = 2;
/// The program could not do its job.
const FAILED: u8 = 1;

/// See the module.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The user can mend it.
    WrongInput(String),
    /// The user cannot.
    Failed(anyhow::Error),
}

impl Failure {
    /// Tells the user, once, and gives the exit status.
    pub(crate) fn report(&self) -> ExitCode {
        let status = match self {
            Self::WrongInput(_) => WRONG_INPUT,
            Self::Failed(_) => FAILED,
        };
        let mut stderr = std::io::stderr().lock();
        // With standard error closed there is nobody left to tell.
        let _ = writeln!(stderr, "truepose: {}", plain(&self.to_string()));
        ExitCode::from(status)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WrongInput(text) => f.write_str(text),
            Self::Failed(error) => write!(f, "{error:#}"),
        }
    }
}

impl From<Rejected> for Failure {
    fn from(rejected: Rejected) -> Self {
        Self::WrongInput(rejected.to_string())
    }
}

impl From<IdentifyError> for Failure {
    fn from(error: IdentifyError) -> Self {
        Self::WrongInput(error.to_string())
    }
}

impl From<NotHandedOut> for Failure {
    fn from(error: NotHandedOut) -> Self {
        Self::Failed(error.into())
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        if error.is_refusal() {
            Self::WrongInput(error.to_string())
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
