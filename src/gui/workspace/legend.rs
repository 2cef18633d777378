//! The scale of the vectors, what marks and colours mean, and what is not shown: in rows above the
//! plot, so that nothing of it ever covers what was measured, however small the plot is. What colour says is said a
//! second time: a deviation by the vector's length, a direction by its direction, a condition by its width.

use egui::{
    Align2, Color32, FontId, Label, Link, Popup, PopupCloseBehavior, Pos2, Rect, RichText, Role,
    Sense, Shape, Stroke, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};

use crate::gui::core::overview::FEW;
use crate::gui::layers::scale_at;
use crate::gui::plots::chart::{self, SIGN};
use crate::gui::plots::mark;
use crate::gui::style::{Palette, size};
use crate::gui::workbench::Workbench;
use crate::numeric::single;
use crate::present::chart::Form;
use crate::present::numbers::{significant, trimmed};

use super::fitting;
use super::model::{Shown, judged};
use super::pen::{Camera, Pen};

/// The longest that the scale's arrow gets, points.
const LONGEST_SCALE: f64 = 52.0;
/// Room for the arrow and its length in words, points; and for what is said where not everything is drawn.
const SCALE: f32 = 116.0;
const NOTES: f32 = 240.0;

/// A name, and its sign about the middle of so much room.
type Entry = (String, Vec<Shape>, f32);

fn show_entry(ui: &mut Ui, (name, sign, room): Entry) -> Rect {
    let muted = Palette::of(ui).muted;
    let (place, response) = chart::entry(ui, (sign, room), (&name, muted), Sense::hover());
    let label = say!("legend: {name}", name);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, label.clone()));
    place
}

/// The rows over a plot of the plane. Where the scale of the vectors goes, after everything else: its length is known
/// only when the plot is.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, shown: &Shown, robot: bool) -> Option<Rect> {
    let low = ui.available_height() < LOW;
    let marks = entries(workbench, shown, robot, &Palette::of(ui));
    let bar = colour_bar(ui, workbench, shown, if low { SHORT } else { LONG });
    chart::rows(ui, vec2(10.0, 1.0), |ui| {
        let all = |ui: &mut Ui| {
            for one in marks {
                show_entry(ui, one);
            }
        };
        if low {
            bar.map(|bar| show_entry(ui, bar));
            folded(ui, all);
        } else {
            all(ui);
            bar.map(|bar| show_entry(ui, bar));
        }
        if let Some(says) = shown.note() {
            show_entry(ui, (says, Vec::new(), 0.0));
        }
        let many = if shown.samples > FEW { NOTES } else { 0.0 };
        let measured = !workbench.loaded_session().is_empty();
        measured.then(|| show_entry(ui, (String::new(), Vec::new(), SCALE + many)))
    })
}

/// A plot that would be lower than this has its marks explained behind a button, points.
pub(super) const LOW: f32 = 330.0;

/// A word that shows what the marks mean when it is pressed.
fn folded(ui: &mut Ui, marks: impl FnOnce(&mut Ui)) {
    let word = RichText::new(say!("legend")).small();
    let word = ui.add(Link::new(word));
    Popup::menu(&word)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .show(|ui| {
            ui.set_max_width(160.0);
            ui.spacing_mut().item_spacing = vec2(10.0, 1.0);
            marks(ui);
        });
}

/// Draws the scale of the vectors: an arrow that stands for a round length, and which; behind it what is not drawn.
pub(super) fn scale_in(
    ui: &mut Ui,
    room: Rect,
    workbench: &Workbench,
    shown: &Shown,
    camera: &Camera,
) {
    let units = workbench.units();
    let points_per_mm = camera.points_per_mm();
    // Round in the unit in which it is written.
    let per_mm = units.length_value(1.0);
    let magnification = shown.look.magnification;
    let round = fitting::scale_mm(magnification, points_per_mm / per_mm, LONGEST_SCALE);
    let long = single(round / per_mm * magnification * points_per_mm);
    let says = format!("{} {}", trimmed(round, 6), units.length_name());
    let palette = Palette::of(ui);
    let color = if shown.look.answered && shown.look.blend > 0.0 {
        palette.after
    } else {
        palette.before
    };
    // The legend stands above the plot.
    let pen = Pen {
        painter: &ui.painter().with_clip_rect(room.expand(40.0)),
        palette: &palette,
    };
    let ends = [room.left_center(), room.left_center() + vec2(long, 0.0)];
    pen.arrow(ends, Stroke::new(2.0, color));
    let beside = ends[1] + vec2(8.0, 0.0);
    pen.label(beside, Align2::LEFT_CENTER, says, palette.text);
    let notes = fitting::drawn(shown, fitting::counts(shown, &camera.transform));
    if !notes.is_empty() {
        let notes = RichText::new(notes.join(" · ")).small().weak();
        let room = room.with_min_x(room.left() + SCALE);
        let mut beside = ui.new_child(UiBuilder::new().max_rect(room));
        beside.set_clip_rect(room);
        beside.add(Label::new(notes).truncate());
    }
}

/// Pieces of lines, one over the other.
fn line<const N: usize>(name: &str, strokes: [(f32, Color32); N]) -> Entry {
    let ends = [-0.5, 0.5].map(|end| pos2(end * SIGN, 0.0));
    let pieces = strokes.map(|(width, color)| Shape::line_segment(ends, Stroke::new(width, color)));
    (name.to_owned(), pieces.into(), SIGN)
}

fn sign(name: &str, (form, radius): (Form, f32), fill: Color32, edge: Stroke) -> Entry {
    let mark = mark(Pos2::ZERO, radius, form, fill, edge);
    (name.to_owned(), vec![mark], SIGN)
}

/// What the marks mean.
fn entries(workbench: &Workbench, shown: &Shown, robot: bool, palette: &Palette) -> Vec<Entry> {
    let mut all = Vec::new();
    if !shown.paths_mm.is_empty() {
        all.push(line(say!("nominal path"), [(1.25, palette.nominal)]));
    }
    if shown.look.ghosts() {
        let before = palette.before.gamma_multiply(0.5);
        all.push(line(say!("before"), [(1.5, before)]));
        all.push(line(say!("after"), [(1.8, palette.after)]));
    }
    let disc = |name: &str, color| sign(name, (Form::Disc, 2.8), color, Stroke::NONE);
    let measured = !workbench.loaded_session().is_empty();
    if measured && workbench.document().tolerance_mm.is_some() {
        let edge = Stroke::new(1.4, palette.outside);
        let [within, outside] = [true, false].map(|within| judged(workbench, within));
        all.push(disc(within, palette.within));
        let open = (Form::Diamond, 3.2);
        all.push(sign(outside, open, palette.surface, edge));
    } else if measured {
        all.push(disc(say!("measured"), palette.text));
    }
    if robot {
        let tube = [(7.0, palette.nominal), (4.5, palette.surface)];
        all.push(line(say!("robot"), tube));
    }
    all
}

/// Length of the scale, points; and in a low plot.
const LONG: f32 = 96.0;
const SHORT: f32 = 64.0;
/// Thickness of the scale, points.
const THICK: f32 = 7.0;
/// Pieces of the scale.
const PIECES: u16 = 48;

/// The name of the scale of lengths and what its end says; none without the heat map.
fn scale(workbench: &Workbench, shown: &Shown) -> Option<[String; 2]> {
    workbench.heat()?;
    let units = workbench.units();
    let long = significant(units.length_value(shown.look.long_mm), 2);
    let name = format!("{}, {}", say!("heat map"), units.length_name());
    Some([name, format!("≥ {long}")])
}

/// The scale as an entry of the legend: from little to much.
fn colour_bar(ui: &Ui, workbench: &Workbench, shown: &Shown, long: f32) -> Option<Entry> {
    let [name, high] = scale(workbench, shown)?;
    let palette = Palette::of(ui);
    let laid_out = |says: &str| {
        let font = FontId::proportional(size::SMALL);
        let painter = ui.painter();
        painter.layout_no_wrap(says.to_owned(), font, palette.muted)
    };
    let [low, high] = ["0", &high].map(laid_out);
    let before = low.size().x + 4.0;
    let wide = before + long + 4.0 + high.size().x;
    let left = before - 0.5 * wide;
    let mut shapes = Vec::new();
    for (x, galley) in [(-0.5 * wide, low), (left + long + 4.0, high)] {
        let at = pos2(x, -0.5 * galley.size().y);
        shapes.push(Shape::galley(at, galley, palette.muted));
    }
    for k in 0..PIECES {
        let [from, to] = [k, k + 1].map(|k| left + long * f32::from(k) / f32::from(PIECES));
        let color = scale_at(&palette, f32::from(k) / f32::from(PIECES - 1));
        let piece = Rect::from_x_y_ranges(from..=to, -0.5 * THICK..=0.5 * THICK);
        shapes.push(Shape::rect_filled(piece, 0.0, color));
    }
    Some((name, shapes, wide))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::style::testing::{ColourVision, colour_distance, lightness};
    use crate::gui::style::{DARK, LIGHT, STOPS};
    use crate::gui::testing::workbench;

    #[test]
    fn the_scale_of_the_heat_map_follows_from_before_to_after() {
        let mut workbench = workbench();
        workbench.execute(|bench| bench.identify(None));
        workbench.execute(|bench| bench.view.heat = true);
        workbench.receive();
        let mut end_mm = |blend: f32| {
            workbench.execute(|bench| bench.view.blend = blend);
            let scale = scale(&workbench, &Shown::of(&workbench));
            let [_, end] = scale.expect("the heat map's");
            end.trim_start_matches("≥ ")
                .parse::<f64>()
                .expect("a number")
        };
        let [before, between, after] = [0.0, 0.5, 1.0].map(&mut end_mm);
        assert!(before > 2.0 * after, "{before} {after}");
        assert!(
            before > between && between > after,
            "{before} {between} {after}"
        );
    }

    const THEMES: [(&str, Palette); 2] = [("light", LIGHT), ("dark", DARK)];

    #[test]
    fn a_sequential_scale_gets_steadily_darker_or_lighter_for_everybody() {
        for (theme, palette) in THEMES {
            for sight in ColourVision::ALL {
                let lightness: Vec<f64> = (0..=20_u8)
                    .map(|k| scale_at(&palette, f32::from(k) / 20.0))
                    .map(|color| lightness(color, sight))
                    .collect();
                let way = (lightness[20] - lightness[0]).signum();
                for pair in lightness.windows(2) {
                    let step = way * (pair[1] - pair[0]);
                    assert!(step > 0.4, "{theme}, {sight:?}: {lightness:?}");
                }
                let all = (lightness[20] - lightness[0]).abs();
                assert!(all > 35.0, "{theme}, {sight:?}: {all}");
            }
        }
    }

    #[test]
    fn neighbouring_steps_of_the_scale_can_be_told_apart_by_everybody() {
        // About 2.3 is just noticeable (Mahy et al. 1994).
        const NOTICEABLE: f64 = 4.6;
        for (theme, palette) in THEMES {
            for sight in ColourVision::ALL {
                for k in 0..STOPS - 1 {
                    let at = |k: usize| scale_at(&palette, k as f32 / (STOPS - 1) as f32);
                    let found = colour_distance(at(k), at(k + 1), sight);
                    assert!(found > NOTICEABLE, "{theme}, {sight:?}, {k}: {found}");
                }
            }
        }
    }
}
