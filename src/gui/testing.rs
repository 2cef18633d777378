//! What the window's own tests start from: a workbench whose tasks run at once.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::simulation::unwatched;

use super::views::copies::drawing;
use crate::gui::core::loaded_session::{LoadedSession, Origin};
use crate::gui::core::simulate::{Chosen, Form};
use crate::gui::jobs::{Jobs, Runner};
use crate::gui::workbench::Workbench;

/// A workbench on a simulated session: both directions, backlash and a little noise.
pub(crate) fn workbench() -> Workbench {
    let form = Form {
        effects: Chosen::new("backlash").into_iter().collect(),
        ..Form::default()
    };
    let (session, _) = form.session(unwatched).expect("the form is valid");
    let loaded_session = LoadedSession::new(session, Vec::new(), Origin::Simulated);
    let jobs = Jobs::new(Runner::AtOnce, Arc::new(|| {}));
    Workbench::new(Arc::new(loaded_session), jobs, drawing)
}

/// A session in this folder of one joint of a URDF, whose link looks like this mesh.
pub(crate) fn session_of_a_urdf(folder: &Path, mesh: &str) -> PathBuf {
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).expect("written");
        path
    };
    write("arm.obj", mesh);
    write(
        "arm.urdf",
        r#"<robot name="arm"><link name="base"/><link name="arm"><visual><geometry>
        <mesh filename="arm.obj"/></geometry></visual></link><joint name="j" type="continuous">
        <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint></robot>"#,
    );
    write(
        "session.json",
        r#"{"format": "truepose-session/1", "name": "arm", "targets": {"SMR": [250, 0, 300]},
        "robot": {"name": "arm", "urdf": {"file": "arm.urdf", "base": "base", "tip": "arm"}},
        "samples": {"columns": {"q1_deg": [0, 30, 60], "x_mm": [250, 216.5, 125],
        "y_mm": [0, 125, 216.5], "z_mm": [300, 300, 300]}}}"#,
    )
}
