//! The scale of the vectors, what marks and colours mean, and what is not shown: in rows above the
//! plot, so that nothing of it ever covers what was measured, however small the plot is.

use egui::{Align2, Link, Popup, PopupCloseBehavior, Rect, RichText, Ui, vec2};
use egui_plot::PlotTransform;

use crate::gui::layers::OUTLINE;
use crate::gui::scene::paint::Camera;
use crate::gui::scene::screen::Screen;
use crate::gui::scene::{
    ColourToken, Form, Item, Label, LegendEntry, Mark, Place, SIGN, Stroke, Tint,
};
use crate::gui::style::{Palette, size};
use crate::gui::view::Colouring;
use crate::gui::workbench::Workbench;
use crate::present::numbers::trimmed;

use super::layout;
use super::model::{Shown, judged};
use super::robot::Drawn;
use super::scales::{self, HIGH, entry};
use super::scene::SQUARE;

/// The longest that the scale's arrow gets, points.
const LONGEST_SCALE: f64 = 52.0;
/// Room for the arrow and its length in words, points.
const SCALE: f32 = 116.0;

fn symbol(ui: &mut Ui, one: &LegendEntry, palette: &Palette) {
    let room = entry(ui, one.wide, &one.name, palette);
    Screen::symbol(ui.painter(), palette, one, room.center());
}

fn note(ui: &mut Ui, says: &str, palette: &Palette) {
    entry(ui, 0.0, says, palette);
}

fn rows(ui: &mut Ui, contents: impl FnOnce(&mut Ui)) {
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing = vec2(10.0, 1.0);
        ui.spacing_mut().interact_size.y = HIGH;
        ui.horizontal_wrapped(contents);
    });
}

/// The rows over a plot of the plane. Where the scale of the vectors goes: its length is known only
/// when the plot is.
pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    shown: &Shown,
    robot: Option<&Drawn>,
    notes: &[String],
) -> Option<Rect> {
    let palette = &Palette::of(ui);
    let mut scale = None;
    let measured = !workbench.loaded_session().is_empty();
    let low = ui.available_height() < LOW;
    let entries = entries(workbench, shown, robot);
    let scales = scales::entries(ui, workbench, shown, low);
    let marks = |ui: &mut Ui| entries.iter().for_each(|one| symbol(ui, one, palette));
    rows(ui, |ui| {
        if measured {
            scale = Some(entry(ui, SCALE, "", palette));
        }
        if !low {
            marks(ui);
        }
        for one in &scales {
            symbol(ui, one, palette);
        }
        if low {
            folded(ui, marks);
        }
        for says in notes {
            note(ui, says, palette);
        }
    });
    scale
}

/// A plot that would be lower than this has its marks explained behind a button, points.
pub(super) const LOW: f32 = 330.0;

/// A word that shows what the marks mean when it is pressed.
fn folded(ui: &mut Ui, marks: impl FnOnce(&mut Ui)) {
    let word = RichText::new(say!("legend")).size(size::SMALL);
    let word = ui.add(Link::new(word));
    Popup::menu(&word)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .show(|ui| {
            ui.set_max_width(160.0);
            ui.spacing_mut().item_spacing = vec2(10.0, 1.0);
            marks(ui);
        });
}

/// The scale of the vectors: an arrow that stands for a round length, and which.
fn scale(workbench: &Workbench, shown: &Shown, camera: &Camera) -> LegendEntry {
    let units = workbench.units();
    let points_per_mm = camera.points_per_mm();
    // Round in the unit in which it is written.
    let per_mm = units.length_value(1.0);
    let round = layout::scale_mm(shown.magnification, points_per_mm / per_mm, LONGEST_SCALE);
    let mm = round / per_mm;
    let long = mm * shown.magnification * points_per_mm;
    let token = if shown.look.colouring != Colouring::State {
        ColourToken::Muted
    } else if shown.look.answered && shown.look.blend > 0.0 {
        ColourToken::After
    } else {
        ColourToken::Before
    };
    let at = |x: f64| Place::from([x - 0.5 * f64::from(SCALE), 0.0, 0.0]);
    let says = format!(
        "{} {}",
        trimmed(units.length_value(mm), 6),
        units.length_name()
    );
    let says = Label {
        anchor: Align2::LEFT_CENTER,
        ..Label::new(at(long + 8.0), says, ColourToken::Text)
    };
    let arrow = Item::Vector([at(0.0), at(long)], Stroke::new(2.0, token));
    LegendEntry {
        name: String::new(),
        sign: vec![arrow, Item::Label(says)],
        wide: SCALE,
    }
}

/// Draws the scale where there is room for it.
pub(super) fn scale_in(ui: &Ui, room: Rect, workbench: &Workbench, shown: &Shown, camera: &Camera) {
    let scale = scale(workbench, shown, camera);
    Screen::symbol(ui.painter(), &Palette::of(ui), &scale, room.center());
}

/// What the marks mean.
fn entries(workbench: &Workbench, shown: &Shown, robot: Option<&Drawn>) -> Vec<LegendEntry> {
    let mut all = Vec::new();
    if !workbench.loaded_session().is_empty() {
        meanings(&mut all, workbench, shown);
    }
    // Whether the pointer is at a sample or not: nothing moves under the pointer.
    let Some(robot) = robot else {
        return all;
    };
    let tube = [(7.0, ColourToken::Nominal), (4.5, ColourToken::Surface)];
    let tube = tube.map(|(width, token)| LegendEntry::line("", Stroke::new(width, token)).sign);
    all.push(LegendEntry {
        name: say!("robot").to_owned(),
        sign: tube.concat(),
        wide: SIGN,
    });
    if let Some(real) = &robot.real {
        let (name, token) = if real.identified {
            (say!("identified"), ColourToken::After)
        } else {
            (say!("as measured"), ColourToken::Before)
        };
        all.push(LegendEntry::line(name, Stroke::new(2.5, token)));
    }
    all
}

fn meanings(all: &mut Vec<LegendEntry>, workbench: &Workbench, shown: &Shown) {
    let line = |name: &str, width, ink: Tint| LegendEntry::line(name, Stroke::new(width, ink));
    if !shown.paths_mm.is_empty() {
        all.push(line(
            say!("nominal path"),
            1.25,
            ColourToken::Nominal.into(),
        ));
    }
    if shown.look.ghosts() {
        all.push(line(say!("before"), 1.5, ColourToken::Before.clear(0.5)));
        all.push(line(say!("after"), 1.8, ColourToken::After.into()));
    }
    // Where colour says something else, shape alone says what is within the tolerance.
    let colouring = shown.look.colouring;
    let plain = colouring == Colouring::State;
    let middle = ColourToken::Scale(colouring, 0.5);
    let here = [0.0; 3];
    let disc = |token: ColourToken| {
        if plain {
            Mark::filled(here, Form::Disc, 2.8, token)
        } else {
            let edge = Stroke::new(OUTLINE, ColourToken::Text);
            Mark::filled(here, Form::Disc, 4.0, middle).edged(edge)
        }
    };
    if workbench.document().tolerance_mm.is_some() {
        let inner = if plain { ColourToken::Surface } else { middle };
        let edge = Stroke::new(1.4, ColourToken::Outside);
        let diamond = Mark::filled(here, Form::Diamond, 4.2, inner).edged(edge);
        let [within, outside] = [true, false].map(|within| judged(workbench, within));
        all.push(LegendEntry::mark(within, disc(ColourToken::Within)));
        all.push(LegendEntry::mark(outside, diamond));
    } else {
        all.push(LegendEntry::mark(say!("measured"), disc(ColourToken::Text)));
    }
    if !shown.over.is_empty() {
        let square = Mark::filled(here, Form::Square, 0.5 * SQUARE, middle);
        all.push(LegendEntry::mark(
            say!("poses over the joints’ ranges"),
            square,
        ));
    }
}

/// What the legend says of what is not drawn. It stands above the plot, and what is drawn follows
/// from the plot's size: the legend says what the frame before found.
pub(super) struct Notes {
    id: egui::Id,
    before: Vec<String>,
    pub(super) lines: Vec<String>,
}

impl Notes {
    pub(super) fn recall(ui: &Ui, shown: &Shown) -> Self {
        let id = ui.scope_id().with("what is not drawn");
        let before: Vec<String> = ui.data(|data| data.get_temp(id)).unwrap_or_default();
        let said = shown.note().into_iter().chain(before.iter().cloned());
        let lines = said.collect();
        Self { id, before, lines }
    }

    pub(super) fn keep(&self, ui: &Ui, shown: &Shown, transform: &PlotTransform) {
        let now = layout::drawn(shown, layout::counts(shown, transform));
        if now != self.before {
            ui.data_mut(|data| data.insert_temp(self.id, now));
            ui.ctx().request_repaint();
        }
    }
}
