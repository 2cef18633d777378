//! Every kind of command and of change by name: a new variant does not compile until it is listed
//! here, and the walk fails until it is among what it does.

use crate::gui::core::edit::Edit;
use crate::gui::workbench::{Command, LeftBehind, Task, ViewChange};

macro_rules! kinds {
    ($all:ident, $of:ident, $type:ident, $before:literal: $($variant:ident $fields:tt),* $(,)?) => {
        pub(super) const $all: &[&str] = &[$(concat!($before, stringify!($variant))),*];

        pub(super) fn $of(one: &$type) -> &'static str {
            match one {
                $(kinds!(@ $type $variant $fields) => concat!($before, stringify!($variant))),*
            }
        }
    };
    (@ $type:ident $variant:ident ()) => { $type::$variant };
    (@ $type:ident $variant:ident (..)) => { $type::$variant(..) };
    (@ $type:ident $variant:ident {..}) => { $type::$variant { .. } };
}

kinds!(
    COMMANDS, command, Command, "":
    Edit(..), Drag(..), EndDrag(), Undo(), Redo(), OpenFile(..), Drop(..), Say(..), ConfirmColumns(), Import(),
    OpenExample(..), Do(..), SaveThen(..), Save(), SaveDespite(), Reload(), Forget(..), KeepRecovery(),
    LookAtDisk(), SaveAs {..}, ExportTo {..}, State(..), KeepRobot {..}, ForgetRobot(..),
    CompareSessions(..), Compensate(..), Adapt(), Search(), Simulate(..), OpenOutside {..}, CopyNumbers(..), Prefer(..),
    Prepare(),
    Leave(), View(..), Ask(..), Left(..), Stop(..),
);

kinds!(
    VIEW_CHANGES, view_change, ViewChange, "":
    KeepMine(), GoTo(..), Look(..), LookFrom(..), Turn(..), Pose(..), Magnify(..),
    PlotSize(..), Blend(..), Colour(..), Heat(..), Component(..), OnlyAfter(..), Hover(..), Select(..), Mark(..),
    Side(..), Panes(..), Pull(..), Activate(..), ActivateNext(), ChartJoint(..), ShowEffect(..), Results(..),
    Resize(..), Draft(..), Sheet(..), Dismiss(), Fit(), FitWorkspace(), FitChart(..),
);

kinds!(LEFT, left, LeftBehind, "Left ": Restore(..), Discard(..), DiscardAll());

kinds!(STOPPED, stopped, Task, "Stop ": Newest(), Search(), Import(), Dialog());

/// Every kind, those within kinds among them.
pub(super) fn all() -> impl Iterator<Item = &'static str> {
    let lists = [COMMANDS, VIEW_CHANGES, LEFT, STOPPED];
    lists.into_iter().flatten().copied()
}

/// The narrowest kind.
pub(super) fn of(one: &Command) -> &'static str {
    match one {
        Command::View(change) => view_change(change),
        Command::Left(one) => left(one),
        Command::Stop(task) => stopped(task),
        other => command(other),
    }
}

kinds!(
    EDITS, edit, Edit, "":
    Open(..), OpenModel {..}, Divide(..), MoveBoundary(..), Adapt(..),
    KeepRegions(), Split(..), Join(..), Delete(..), Rename(..), RegionsOfSession(), Method(..),
    Effect(..), Tolerance(..), Export(..), Add(..), Switch(..), Setup(..), Correct(..), Exclude(..), Recover(..),
    Identify(), IdentifyBy(..),
);

/// These open a dialog of the system, which a test cannot drive.
pub(super) const ASK_THE_SYSTEM: &[&str] = &["Ask", "OpenOutside"];

/// These come only of a background task, which the walk starts.
pub(super) const COME_BACK: &[&str] = &["Open", "OpenModel", "Adapt", "Recover"];
