//! What the sides of the window are pulled by.

use egui::{Rect, Ui};

use crate::gui::preferences::{Preferences, Sizes};
use crate::gui::style::layout::Layout;
use crate::gui::widgets::{self, Gripped};
use crate::gui::workbench::{Command, ViewChange, Workbench};

/// What the sides can be pulled by.
pub(crate) fn show(
    ui: &Ui,
    workbench: &Workbench,
    layout: Layout,
    middle: Rect,
    commands: &mut Vec<Command>,
) {
    let preferences = workbench.view().preferences;
    let mut pulled = |gripped: Option<Gripped>, set: &dyn Fn(&mut Sizes, Option<f32>)| {
        let mut sizes = preferences.sizes;
        let done = match gripped {
            None => return,
            Some(Gripped::To(x)) => {
                set(&mut sizes, Some(x));
                return commands.push(Command::View(ViewChange::Resize(sizes)));
            }
            Some(Gripped::LetGo(x)) => Some(x),
            Some(Gripped::Usual) => None,
        };
        set(&mut sizes, done);
        commands.push(Command::Prefer(Preferences {
            sizes,
            ..preferences
        }));
    };
    let left = widgets::grip(ui, say!("steps"), middle, middle.left());
    pulled(left, &|sizes, x| sizes.left = x);
    if let Some(width) = layout.right {
        // The samples, where they stand beside the results, keep their width.
        let end = middle.right() + width;
        let right = widgets::grip(ui, say!("results"), middle, middle.right());
        pulled(right, &|sizes, x| sizes.right = x.map(|x| end - x));
    }
}
