//! The list of everything that can be done.

use std::path::PathBuf;

use egui::Response;

use crate::gui::core::compensated::CompensationRequest;
use crate::gui::core::edit::Edit;
use crate::gui::core::loaded_session::Component;
use crate::gui::core::robot_table::RobotTable;
use crate::gui::core::setup::SetupForm;
use crate::gui::core::simulate::Form;
use crate::gui::file_state::machines::Stated;
use crate::gui::import_draft::{Companion, ImportAnswers};
use crate::gui::preferences::{Preferences, Sizes};
use crate::gui::view::{
    Camera, Colouring, Key, NextAction, Panes, Plane, Sheet, Side, Standard, Step, What,
};

/// What a field sends that can be dragged: what it changes, and at the end of a drag that it was let
/// go.
pub(crate) fn of_field(response: &Response, edit: Option<Edit>) -> impl Iterator<Item = Command> {
    let (dragged, released) = (response.dragged(), response.drag_stopped());
    let change = if dragged {
        Command::Drag
    } else {
        Command::Edit
    };
    let end = released.then_some(Command::EndDrag);
    edit.map(change).into_iter().chain(end)
}

/// One thing that can be done.
#[derive(Debug, Clone)]
pub(crate) enum Command {
    /// A finished change of the document.
    Edit(Edit),
    /// A change within a gesture.
    Drag(Edit),
    EndDrag,
    /// Take the last change back.
    Undo,
    Redo,
    /// Open a file with the system's program for it, or show it in its folder.
    OpenOutside {
        path: PathBuf,
        in_folder: bool,
    },
    OpenFile(PathBuf),
    /// Open what was dropped on the window.
    Drop(Vec<PathBuf>),
    /// Say something about the foreign file on the sheet.
    Say(Box<ImportAnswers>),
    /// Its columns were looked at, and are right.
    ConfirmColumns,
    /// Make a session of it.
    Import,
    /// Open a session that comes with the program.
    OpenExample(usize),
    /// Do it, whatever is lost.
    Do(NextAction),
    /// Save what would be lost, then do it.
    SaveThen(NextAction),
    /// Write the session to its own file; ask for one where it has none.
    Save,
    /// The same, although the file changed since it was read.
    SaveDespite,
    /// Read the session's file again.
    Reload,
    /// Take a file out of the recent ones.
    Forget(PathBuf),
    /// Keep what is not saved against a crash.
    KeepRecovery,
    /// Look whether open files are what they were.
    LookAtDisk,
    /// Write the session to this file.
    SaveAs {
        path: PathBuf,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// Write the table, or the model, to this file.
    ExportTo {
        what: What,
        path: PathBuf,
        /// Whether files that are there may be replaced.
        replace: bool,
    },
    /// Remember a robot that was typed, and save it as a file if that is wanted.
    KeepRobot {
        table: Box<RobotTable>,
        save: bool,
    },
    /// Forget the robot that was typed under this name.
    ForgetRobot(String),
    /// Report details are these now.
    State(Box<Stated>),
    /// Compare the sessions of a folder, and show what changed.
    CompareSessions(PathBuf),
    /// Correct its targets by the model that is shown, and show what changes.
    Compensate(CompensationRequest),
    /// Divide the joint's range where the samples ask for it.
    Adapt,
    /// Search for what is missing.
    Search,
    /// Prepare the export whose preparation was cancelled.
    Prepare,
    /// Make a session by simulation.
    Simulate(Form),
    /// Copy what this chart shows as a table.
    CopyNumbers(&'static str),
    /// Show numbers, colours and text like this.
    Prefer(Preferences),
    Leave,
    /// Ask for a file or a folder.
    Ask(Asked),
    /// Change what is shown of the document.
    View(ViewChange),
    /// What a window that is gone has left behind.
    Left(LeftBehind),
    /// Stop what is under way.
    Stop(Task),
}

impl Command {
    /// Opens a sheet, in place of the one that is open.
    pub(crate) fn sheet(sheet: Sheet) -> Self {
        Self::View(ViewChange::Sheet(Some(sheet)))
    }

    /// Closes the sheet that is open.
    pub(crate) fn no_sheet() -> Self {
        Self::View(ViewChange::Sheet(None))
    }
}

/// A file or folder that the user is asked for.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Asked {
    /// Ask for a file to open.
    File,
    /// Ask for a file beside it.
    Beside(Companion),
    /// Ask for a file that an instrument wrote.
    Import,
    /// Ask for a file to save to.
    WhereToSave,
    /// Ask for a file to export to.
    WhereToExport(What),
    /// Ask for a folder of sessions.
    Folder,
    /// Ask for a picture for the head of the report.
    Logo,
    /// Ask for a table of targets or a robot program to be corrected.
    Targets,
}

/// A change of how the document is looked at.
#[derive(Debug, Clone)]
pub(crate) enum ViewChange {
    /// Go on with what is here, whatever is on the disk.
    KeepMine,
    GoTo(Step),
    /// Look at the workspace in this plane.
    Look(Plane),
    /// Look at the workspace in three dimensions, from this side if one is named.
    LookFrom(Option<Standard>),
    /// Look at it from here.
    Turn(Camera),
    /// Draw the robot at these joint values, rad or mm; `None`: at a sample.
    Pose(Option<Vec<f64>>),
    /// Draw error vectors so much longer; `None`: so that they are readable.
    Magnify(Option<f64>),
    /// The workspace is drawn over so many points where all of it is in sight.
    PlotSize(f64),
    /// From before, 0, to after, 1.
    Blend(f32),
    /// Let the colour of error vectors say this.
    Colour(Colouring),
    /// Show the heat map, or hide it.
    Heat(bool),
    /// Show this component in the chart.
    Component(Component),
    /// Show only what is left in the chart.
    OnlyAfter(bool),
    /// The pointer is on this sample.
    Hover(Option<usize>),
    Select(Option<usize>),
    /// Choose these samples: a finding is about them.
    Mark(Vec<usize>),
    /// Show this on the right-hand side.
    Side(Side),
    /// Arrange workspace and charts like this.
    Panes(Box<Panes>),
    /// The same while it is pulled; remembered only once it is let go.
    Pull(Box<Panes>),
    /// Keys are for this pane; where there is room for one only, it is shown.
    Activate(Key),
    /// The same for the next pane.
    ActivateNext,
    /// Let charts be about this joint, counted from 0.
    ChartJoint(usize),
    /// Show the curve of an effect that was found, by its place in the answer.
    ShowEffect(usize),
    /// Open the right-hand side, or shut it.
    Results(bool),
    /// Give panels these sizes; remembered only once that is preferred.
    Resize(Sizes),
    /// Robot and instrument as they are being typed, while that makes no robot.
    Draft(Option<Box<SetupForm>>),
    /// Open, change or close a sheet.
    Sheet(Option<Sheet>),
    Dismiss,
    /// Show everything again.
    Fit,
    /// The upper plot shows everything again.
    FitWorkspace,
    /// The chart in this pane shows everything again.
    FitChart(Key),
}

/// What becomes of what a window that is gone has left behind.
#[derive(Debug, Clone)]
pub(crate) enum LeftBehind {
    /// Bring back what a window that is gone has left behind.
    Restore(usize),
    /// Throw it away.
    Discard(usize),
    /// Throw all of it away.
    DiscardAll,
}

/// Work that is under way.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Task {
    /// Drop the task that is under way.
    Newest,
    /// End the search that is under way; what it has found stays in sight.
    Search,
    /// Go on without an answer of the system's dialog.
    Dialog,
    /// Stops looking at a foreign file; saying something looks again.
    Import,
}
