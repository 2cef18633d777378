//! What the window's own tests start from: a workbench whose tasks run at once.

use std::sync::Arc;

use crate::simulation::unwatched;

use crate::gui::core::loaded_session::{Origin, Subject};
use crate::gui::core::simulate::{Chosen, Form};
use crate::gui::jobs::{Jobs, Runner};
use crate::gui::views::pictures::drawing;
use crate::gui::workbench::Workbench;

/// A workbench on a simulated session: both directions, backlash and a little noise.
pub(crate) fn workbench() -> Workbench {
    let form = Form {
        effects: Chosen::new("backlash").into_iter().collect(),
        ..Form::default()
    };
    let session = form.session(unwatched).expect("the form is valid");
    let subject = Subject::new(session, Vec::new(), Origin::Simulated);
    let jobs = Jobs::new(Runner::AtOnce, Arc::new(|| {}));
    Workbench::new(Arc::new(subject), jobs, drawing)
}
