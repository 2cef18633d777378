//! The list of everything that can be done.

use std::path::PathBuf;

use crate::gui::edit::Edit;
use crate::gui::simulate::Form;
use crate::gui::subject::Component;
use crate::gui::tasks::What;
use crate::gui::view::{AngleUnit, Canvas, Colouring, LengthUnit, Lower, Plane, Sheet, Side, Step};

/// One thing that can be done.
#[derive(Debug, Clone)]
pub(crate) enum Command {
    /// A finished change of the document.
    Edit(Edit),
    /// A change within a gesture.
    Drag(Edit),
    /// The gesture is over.
    EndDrag,
    /// Take the last change back.
    Undo,
    /// Bring it back again.
    Redo,
    /// Ask for a file to open.
    ChooseFile,
    /// Read this file.
    OpenFile(PathBuf),
    /// Open a session that comes with the program.
    OpenExample(usize),
    /// Ask for a file to save to.
    ChooseWhereToSave,
    /// Write the session to this file.
    SaveAs {
        /// The file.
        path: PathBuf,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// Ask for a file to export to.
    ChooseWhereToExport(What),
    /// Write the table, or the model, to this file.
    ExportTo {
        /// What.
        what: What,
        /// The file.
        path: PathBuf,
        /// Whether files that are there may be replaced.
        replace: bool,
    },
    /// Search for what is missing.
    Search,
    /// Make a session by simulation.
    Simulate(Form),
    /// Drop the task that is under way.
    Cancel,
    /// Drop the search that is under way.
    StopSearch,
    /// Show this step.
    GoTo(Step),
    /// Look at the workspace in this plane.
    Look(Plane),
    /// Draw error vectors so much longer; `None`: so that they are readable.
    Magnify(Option<f64>),
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
    /// Choose this sample.
    Select(Option<usize>),
    /// Show this on the right-hand side.
    Side(Side),
    /// Show this below the workspace in the step that finds the gap.
    Lower(Lower),
    /// Draw what there is for each sample on this.
    Canvas(Canvas),
    /// Show lengths in this unit.
    Length(LengthUnit),
    /// Show angles in this unit.
    Angle(AngleUnit),
    /// Light, dark, or as the system has it.
    Theme(egui::ThemePreference),
    /// Open, change or close a sheet.
    Sheet(Option<Sheet>),
    /// Close the window, saved or not.
    Leave,
    /// The message was read.
    Dismiss,
    /// Show everything again.
    Fit,
}
