//! What the window's own tests start from: a workbench whose tasks run at once.

use std::sync::Arc;

use crate::simulation::unwatched;

use super::commands::Workbench;
use super::simulate::{Chosen, Form};
use super::subject::{Origin, Subject};
use super::tasks::{Runner, Tasks};

/// A workbench on a simulated session: both directions, backlash and a little noise.
pub(crate) fn workbench() -> Workbench {
    let form = Form {
        effects: Chosen::new("backlash").into_iter().collect(),
        ..Form::default()
    };
    let session = form.session(unwatched).expect("the form is valid");
    let subject = Subject::new(session, Vec::new(), Origin::Simulated);
    let tasks = Tasks::new(Runner::AtOnce, Arc::new(|| {}));
    Workbench::new(Arc::new(subject), tasks)
}
