//! The bar over the workspace plot: from where it is looked at, what is shown, and how.

use crate::text::stretch;
use egui::{Align, ComboBox, Layout, Ui};

use crate::gui::plots::{gestures, picture};
use crate::gui::style::space;
use crate::gui::view::{Aspect, Plane, Plot};
use crate::gui::widgets::{self, title};
use crate::gui::workbench::Workbench;

use super::display::{
    beneath, blend, colouring, everything, folded, length_folded, magnification, scale_for,
};

/// What stands at the beginning of the bar.
pub(crate) type First<'a> = &'a mut dyn FnMut(&mut Ui);

/// Room for it, points.
const FIRST: f32 = 32.0;

/// Something else that stands in the bar.
pub(crate) type ExtraControls = fn(&mut Ui, &Workbench);

/// How much of the bar there is room for.
#[derive(Clone, Copy, PartialEq)]
enum Fold {
    /// All of it side by side.
    Open,
    /// The length of vectors is behind a button.
    Narrow,
    /// So is how anything is drawn.
    Tight,
}

/// Shows the bar; `beside` stands above it, `first` at its beginning.
pub(crate) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    extra: Option<ExtraControls>,
    first: First<'_>,
) {
    let view = &workbench.view;
    let drawn = !workbench.loaded_session().is_empty();
    let blends = drawn && workbench.answer().is_some();
    let mut room = ui.available_size();
    room.x /= stretch();
    let beside_first = room.x - FIRST;
    let fold = match room {
        _ if room.y < TIGHT || view.in_space() && beside_first < SPACE_NARROW => Fold::Tight,
        _ if room.x < if view.in_space() { SPACE_WIDE } else { WIDE } => Fold::Narrow,
        _ => Fold::Open,
    };
    let least = if fold == Fold::Tight {
        ROOMY_FOLDED
    } else {
        ROOMY
    };
    let roomy = beside_first > least && extra.is_none();
    // A row of its own would take a sixth of a low plot: before that the slider stands without its words.
    let bare = !roomy && beside_first > least - WORDS && extra.is_none();
    if let Some(beside) = extra {
        widgets::row(ui, |ui| {
            beside(ui, workbench);
            if blends {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    blend(ui, workbench);
                });
            }
        });
    }
    let row = Row {
        drawn,
        blends: blends && (roomy || bare),
        least: match blends {
            _ if extra.is_some() => f32::INFINITY,
            true => WITH_BLEND,
            false => TITLED,
        },
        fold,
    };
    row.show(ui, workbench, first);
    if !drawn {
        return;
    }
    if fold != Fold::Tight {
        widgets::row(ui, |ui| {
            if fold == Fold::Narrow {
                length_folded(ui, workbench);
            } else {
                magnification(ui, workbench);
                scale_for(ui, workbench);
            }
            beneath(ui, workbench);
            colouring(ui, workbench);
        });
    }
    if blends && !roomy && !bare && extra.is_none() {
        ui.horizontal(|ui| {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                blend(ui, workbench);
            });
        });
    }
}

/// The first row of the bar.
struct Row {
    /// Whether there are samples to draw.
    drawn: bool,
    /// Whether the slider from before to after stands in it.
    blends: bool,
    /// The room above which the plot has a title, points.
    least: f32,
    fold: Fold,
}

impl Row {
    fn show(&self, ui: &mut Ui, workbench: &Workbench, first: First<'_>) {
        widgets::row(ui, |ui| {
            first(ui);
            if ui.available_width() > self.least * stretch() {
                title(ui, say!("Workspace"));
            }
            ways(ui, workbench, self.fold);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                if self.drawn {
                    picture(ui, Plot::Workspace, None, workbench);
                }
                if gestures::fit(ui, say!("Fit to view")) {
                    workbench.then(|bench| bench.view.fit_workspace());
                }
                if self.drawn && self.fold == Fold::Tight {
                    folded(ui, say!("display"), say!("How it is drawn"), |ui| {
                        everything(ui, workbench);
                    });
                }
                if self.blends {
                    ui.add_space(space::TIGHT);
                    blend(ui, workbench);
                }
            });
        });
    }
}

/// The ways to look at the workspace.
fn ways(ui: &mut Ui, workbench: &Workbench, fold: Fold) {
    let view = &workbench.view;
    let planes = Plane::ALL.map(|plane| ((Aspect::Plane, plane), plane.name()));
    let space = ((Aspect::Space, view.plane), say!("3-D"));
    let views = [planes[0], planes[1], planes[2], space];
    let now = (view.aspect, view.plane);
    let beside = if fold == Fold::Tight {
        ICONS + DISPLAY
    } else {
        ICONS
    };
    let room = ui.available_width() - beside * stretch();
    let chosen = if widgets::width_of_segments(ui, &views) <= room {
        widgets::segmented(ui, &views, now)
    } else {
        let named = views.iter().find(|(one, _)| *one == now);
        let list = ComboBox::from_id_salt("ways to look").width(NARROW_LIST);
        let list = list.selected_text(named.map_or("", |(_, name)| *name));
        widgets::list(ui, say!("View"), list, views, now)
    };
    match chosen {
        Some((Aspect::Plane, plane)) => workbench.then(move |bench| bench.view.look_in(plane)),
        Some((Aspect::Space, _)) => workbench.then(move |bench| bench.view.look_from(None)),
        None => {}
    }
}

/// Widths in the same row as the choice of view, points: two icons, and the *display* button. The choice becomes a list
/// where the row is too narrow for all of them.
const ICONS: f32 = 76.0;

const DISPLAY: f32 = 78.0;

const NARROW_LIST: f32 = 64.0;

/// With less room the plot has no title, and before and after stand in a row of their own, points.
const TITLED: f32 = 440.0;

const WITH_BLEND: f32 = 590.0;

const ROOMY: f32 = 420.0;

/// The words at the ends of the slider from before to after, points.
const WORDS: f32 = 80.0;

/// The same with a button for how anything is drawn.
const ROOMY_FOLDED: f32 = 570.0;

/// With less room what is seldom changed stands behind a button, points.
const WIDE: f32 = 590.0;

/// The same in space, where there is more of it, and below which all of it does.
const SPACE_WIDE: f32 = 760.0;

const SPACE_NARROW: f32 = 510.0;

/// With less height all of it does, points.
const TIGHT: f32 = 270.0;
