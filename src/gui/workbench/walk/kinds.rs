//! Every kind of command and of change by name: a new variant does not compile until it is listed
//! here, and the walk fails until it is among what it does.

use crate::gui::core::edit::Edit;
use crate::gui::workbench::Command;

macro_rules! kinds {
    ($all:ident, $of:ident, $type:ident: $($variant:ident $fields:tt),* $(,)?) => {
        pub(super) const $all: &[&str] = &[$(stringify!($variant)),*];

        pub(super) fn $of(one: &$type) -> &'static str {
            match one {
                $(kinds!(@ $type $variant $fields) => stringify!($variant)),*
            }
        }
    };
    (@ $type:ident $variant:ident ()) => { $type::$variant };
    (@ $type:ident $variant:ident (..)) => { $type::$variant(..) };
    (@ $type:ident $variant:ident {..}) => { $type::$variant { .. } };
}

kinds!(
    COMMANDS, command, Command:
    Edit(..), Drag(..), EndDrag(), Undo(), Redo(), ChooseFile(), OpenFile(..), Drop(..), Say(..),
    ConfirmColumns(), ChooseBeside(..), Import(), OpenExample(..), Do(..), SaveThen(..), Save(), SaveDespite(), Reload(), KeepMine(),
    Follow(..), Forget(..), Restore(..), DiscardLeft(..), DiscardAllLeft(), ChooseImport(), KeepRecovery(), LookAtDisk(),
    ChooseWhereToSave(), SaveAs {..}, ChooseWhereToExport(..), ExportTo {..}, State(..), KeepRobot {..}, ForgetRobot(..), Record(..), StopRecording(), ChooseLogo(), CompareSessions(..), ChooseFolder(), ChooseTargets(), Compensate(..), Adapt(), Type {..},
    Search(), FindLetters(..), FindNamesOfLanguages(), DismissLetters(), Simulate(..), Cancel(), StopSearch(), OpenOutside {..}, StopLooking(), GoTo(..), Look(..), Magnify(..), PlotSize(..), Blend(..),
    Colour(..), Heat(..), Component(..), OnlyAfter(..), Hover(..), Select(..), Mark(..), Side(..),
    Results(..), Panes(..), Pull(..), Activate(..), ActivateNext(), ChartJoint(..), ShowEffect(..), CopyNumbers(..), LookAround(), LookFrom(..), Turn(..), Pose(..), Canvas(..), Prefer(..), Resize(..), Draft(..), Sheet(..), Leave(), Dismiss(), Fit(), FitWorkspace(), FitChart(..),
);

kinds!(
    EDITS, edit, Edit:
    Open(..), OpenModel {..}, Divide(..), MoveBoundary(..), PlaceBoundary(..), Adapt(..),
    KeepRegions(), Split(..), Join(..), Delete(..), Rename(..), RegionsOfSession(), Method(..),
    Effect(..), Tolerance(..), Export(..), Add(..), Switch(..), Setup(..), Correct(..), Exclude(..), Recover(..),
    Identify(), IdentifyBy(..),
);

/// These open a dialog of the system, which a test cannot drive.
pub(super) const ASK_THE_SYSTEM: &[&str] = &[
    "ChooseFile",
    "ChooseImport",
    "ChooseWhereToSave",
    "ChooseWhereToExport",
    "ChooseBeside",
    "ChooseTargets",
    "ChooseLogo",
    "ChooseFolder",
    "OpenOutside",
];

/// These come only of a background task, which the walk starts.
pub(super) const COME_BACK: &[&str] = &["Open", "OpenModel", "Adapt", "Recover"];
