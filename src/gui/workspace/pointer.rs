//! The sample under the pointer, in every plot of samples, and the card beside it: what matters of it, and
//! everything once it is chosen.

use std::sync::Arc;

use egui::{
    Area, Button, Color32, Context, CursorIcon, FontId, Galley, Id, Order, Pos2, Rect, Role, Sense,
    Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2,
};

use crate::gui::actions::{EXCLUDE, WindowState};
use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::joint_value;
use crate::gui::style::{DARK, LIGHT, size, strong};
use crate::gui::view::{Colouring, ViewState};
use crate::gui::workbench::{Command, ViewChange, Workbench};
use crate::present::numbers::trimmed;

use super::layout;
use super::model::judged;

/// A sample is under the pointer within this many points.
pub(super) const REACH: f32 = 14.0;

/// Sends what is under the pointer, and says what it is.
pub(crate) fn hover(
    response: &egui::Response,
    workbench: &Workbench,
    under: Option<usize>,
    commands: &mut Vec<Command>,
) {
    if workbench.poses() {
        return;
    }
    let left = left(response, &response.ctx);
    if (response.hovered() || left) && under != workbench.view().hovered {
        commands.push(Command::View(ViewChange::Hover(under)));
    }
    if response.clicked() || response.secondary_clicked() && under.is_some() {
        commands.push(Command::View(ViewChange::Select(under)));
    }
    if workbench.view().selected.is_some() {
        response.context_menu(|ui| sample_menu(ui, workbench, commands));
    }
    if let Some(sample) = under
        && let Some(pointer) = response.hover_pos()
    {
        response.ctx.set_cursor_icon(CursorIcon::PointingHand);
        card(&response.ctx, workbench, sample, pointer, response.rect);
    }
}

/// What can be done with the chosen samples.
pub(crate) fn sample_menu(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let ctx = ui.ctx().clone();
    let now = WindowState {
        ctx: &ctx,
        workbench,
    };
    let button = Button::new(EXCLUDE.label(now)).shortcut_text(EXCLUDE.keys(&ctx));
    let name = EXCLUDE.label(now);
    let response = ui.add_enabled(EXCLUDE.enabled(now), button);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    if response.clicked() {
        commands.push(EXCLUDE.command(now));
        ui.close();
    }
}

/// The samples that a finding is about, no more than can be told apart.
pub(crate) fn marked(view: &ViewState, samples: usize) -> impl Iterator<Item = usize> + '_ {
    const MOST: usize = 2000;
    let there = view.marked.iter().copied().filter(move |s| *s < samples);
    there.take(MOST)
}

/// Whether the pointer has just left this widget.
fn left(response: &egui::Response, ctx: &egui::Context) -> bool {
    let id = response.id.with("was hovered");
    let now = response.hovered();
    ctx.data_mut(|data| {
        let before: bool = data.get_temp(id).unwrap_or_default();
        data.insert_temp(id, now);
        before && !now
    })
}

/// From the pointer to the card, points: a mark under the pointer is at most 14 away, and its ring
/// has a radius of 9.
const GAP: f32 = 26.0;
const MARGIN: Vec2 = vec2(10.0, 7.0);
/// Between a name and its value, and between two columns of both.
const BETWEEN: f32 = 12.0;
const COLUMNS: f32 = 18.0;
/// More lines than this stand in two columns.
const TALL: usize = 5;

fn card(ctx: &Context, workbench: &Workbench, sample: usize, pointer: Pos2, frame: Rect) {
    let dark = ctx.global_style().visuals.dark_mode;
    let palette = if dark { DARK } else { LIGHT };
    let chosen = workbench.view().selected == Some(sample);
    let (title, lines) = if chosen {
        about(workbench, sample)
    } else {
        brief(workbench, sample)
    };
    let text = |text: &str, font: FontId, color: Color32| {
        ctx.fonts_mut(|fonts| fonts.layout_no_wrap(text.to_owned(), font, color))
    };
    let small = || FontId::proportional(size::SMALL);
    let head = text(&title, strong(size::BODY), palette.text);
    let hint = (!chosen).then(|| text(say!("click for more"), small(), palette.muted));
    let rows: Vec<[Arc<Galley>; 2]> = lines
        .iter()
        .map(|(name, value)| {
            [
                text(name, small(), palette.muted),
                text(value, small(), palette.text),
            ]
        })
        .collect();
    let sizes: Vec<[Vec2; 2]> = rows
        .iter()
        .map(|row| [row[0].size(), row[1].size()])
        .collect();
    let top = head.size().y + 4.0;
    let hint_wide = hint.as_ref().map_or(0.0, |hint| hint.size().x + BETWEEN);
    let least = head.size().x + hint_wide;
    let (places, wide, high) = places(&sizes, least);
    let all = vec2(wide, top + high) + 2.0 * MARGIN;
    let window = ctx.content_rect().shrink(4.0);
    let card = layout::card(pointer, all, GAP, frame, window);
    let says = spoken(&title, &lines);
    let area = Area::new(Id::unique("sample card"))
        .order(Order::Tooltip)
        .fixed_pos(card.min)
        .constrain(false)
        .interactable(false);
    area.show(ctx, |ui| {
        let (rect, response) = ui.allocate_exact_size(all, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Tooltip, true, says.clone()));
        let painter = ui.painter();
        let edge = Stroke::new(1.0, palette.line);
        let round = f32::from(crate::gui::style::space::ROUND);
        painter.add(ui.visuals().popup_shadow.as_shape(rect, round));
        painter.rect(rect, round, palette.surface, edge, StrokeKind::Inside);
        let corner = rect.min + MARGIN;
        if let Some(hint) = hint {
            let y = corner.y + 0.5 * (head.size().y - hint.size().y);
            let x = rect.right() - MARGIN.x - hint.size().x;
            painter.galley(pos2(x, y), hint, palette.muted);
        }
        painter.galley(corner, head, palette.text);
        for (row, [name, value]) in rows.into_iter().zip(places) {
            let below = corner + vec2(0.0, top);
            let [a, b] = row;
            painter.galley(below + name, a, palette.muted);
            painter.galley(below + value, b, palette.text);
        }
    });
}

/// The card in one line.
fn spoken(title: &str, lines: &[Line]) -> String {
    let parts: Vec<String> = lines.iter().map(|(n, v)| format!("{n} {v}")).collect();
    say!("card of {title}: {parts}", title, parts = parts.join(", "))
}

/// Where names and values of these sizes stand, with values flush right in each column; and width
/// and height of all of it, at least so wide.
fn places(sizes: &[[Vec2; 2]], least: f32) -> (Vec<[Vec2; 2]>, f32, f32) {
    let columns = if sizes.len() > TALL { 2 } else { 1 };
    let in_one = sizes.len().div_ceil(columns).max(1);
    let wide = |column: &[[Vec2; 2]]| {
        let of = |k: usize| column.iter().map(|row| row[k].x).fold(0.0, f32::max);
        of(0) + BETWEEN + of(1)
    };
    let mut widths: Vec<f32> = sizes.chunks(in_one).map(wide).collect();
    let gaps = COLUMNS * widths.len().saturating_sub(1) as f32;
    let more = (least - widths.iter().sum::<f32>() - gaps).max(0.0);
    if let Some(last) = widths.last_mut() {
        *last += more;
    }
    let mut places = Vec::with_capacity(sizes.len());
    let (mut left, mut high) = (0.0, 0.0_f32);
    for (column, wide) in sizes.chunks(in_one).zip(&widths) {
        let mut y = 0.0;
        for [name, value] in column {
            places.push([vec2(left, y), vec2(left + wide - value.x, y)]);
            y += name.y.max(value.y) + 2.0;
        }
        high = high.max(y);
        left += wide + COLUMNS;
    }
    let all = widths.iter().sum::<f32>() + gaps;
    (places, all.max(least), high)
}

/// One line of what is said about a sample: what, and how much.
type Line = (String, String);

/// What matters most of a sample.
fn brief(workbench: &Workbench, sample: usize) -> (String, Vec<Line>) {
    const MOST: usize = 3;
    let loaded_session = &**workbench.loaded_session();
    let (title, all) = about(workbench, sample);
    let joints = loaded_session.session.robot.joints.len();
    let mut lines: Vec<Line> = Vec::new();
    if joints > MOST {
        let values = all.iter().take(joints).map(|(_, value)| value.as_str());
        let mut values: Vec<&str> = values.take(6).collect();
        if joints > values.len() {
            values.push("…");
        }
        lines.push((say!("joints").to_owned(), values.join(", ")));
    } else {
        lines.extend(all.iter().take(joints).cloned());
    }
    let colour = workbench.view().colouring;
    let component = workbench.view().component;
    let matters = |name: &str| {
        [
            say!("excluded"),
            say!("deviation"),
            say!("before"),
            say!("after"),
            say!("tolerance"),
        ]
        .contains(&name)
            || name == colour.name()
            || name == component.name()
    };
    let rest = all.into_iter().skip(joints);
    lines.extend(rest.filter(|(name, _)| matters(name)));
    // Before and after are one line where both are there.
    if let Some(k) = lines.iter().position(|(name, _)| name == say!("before"))
        && lines
            .get(k + 1)
            .is_some_and(|(name, _)| name == say!("after"))
    {
        let after = lines.remove(k + 1).1;
        let before = lines[k].1.trim_end_matches(char::is_alphabetic).trim_end();
        lines[k] = (
            say!("before → after").to_owned(),
            format!("{before} → {after}"),
        );
    }
    (title, lines)
}

/// What is said about a sample.
fn about(workbench: &Workbench, sample: usize) -> (String, Vec<Line>) {
    let loaded_session = &**workbench.loaded_session();
    let units = workbench.units();
    let title = say!("sample {sample}", sample = sample + 1);
    let mut lines = Vec::new();
    let joints = &loaded_session.session.robot.joints;
    for (joint, q) in joints.iter().zip(&loaded_session.session.samples.q) {
        lines.push((
            joint.name.clone(),
            joint_value(units, joint.kind, q[sample]),
        ));
    }
    let came = match loaded_session.side(sample) {
        s if s > 0.0 => say!("approach +"),
        s if s < 0.0 => say!("approach −"),
        _ => say!("not known"),
    };
    lines.push((say!("approached").to_owned(), came.to_owned()));
    if !loaded_session.usable[sample] {
        lines.push((
            say!("excluded").to_owned(),
            say!("a value is missing").to_owned(),
        ));
        return (title, lines);
    }
    let before = loaded_session.deviation_before(sample);
    let length = |e: [f64; 3]| units.length(loaded_session.component(e, sample, Component::Length));
    let mut shown = before;
    match workbench.answer() {
        None => lines.push((say!("deviation").to_owned(), length(before))),
        Some(answer) => {
            shown = answer.deviation_after(sample);
            lines.push((say!("before").to_owned(), length(before)));
            lines.push((say!("after").to_owned(), length(shown)));
        }
    }
    if let Some(u) = workbench.uncertain().map(|u| u.mm[sample]) {
        lines.push((Colouring::Uncertainty.name().to_owned(), units.length(u)));
    }
    for component in [Component::Tangential, Component::Radial, Component::Axial] {
        if component.out_of_plane() && loaded_session.session.samples.z_mm.is_none() {
            continue;
        }
        let value = loaded_session.component(shown, sample, component);
        lines.push((component.name().to_owned(), units.length(value)));
    }
    let samples = &loaded_session.session.samples;
    let conditions = [
        (say!("load"), &samples.load_kg, "kg"),
        (say!("temperature"), &samples.temperature_c, "°C"),
        (say!("time"), &samples.time_s, "s"),
    ];
    for (name, column, unit) in conditions {
        if let Some(value) = column.as_ref().map(|c| c[sample]).filter(|v| v.is_finite()) {
            lines.push((name.to_owned(), format!("{} {unit}", trimmed(value, 2))));
        }
    }
    let [right, up] = workbench.facing().flat(shown);
    let direction = up.atan2(right).to_degrees();
    lines.push((
        say!("direction").to_owned(),
        format!("{}°", trimmed(direction, 0)),
    ));
    if let Some(tolerance_mm) = workbench.document().tolerance_mm {
        let within = loaded_session.component(shown, sample, Component::Length) <= tolerance_mm;
        let says = judged(workbench, within);
        lines.push((say!("tolerance").to_owned(), says.to_owned()));
    }
    (title, lines)
}

#[cfg(test)]
mod tests {
    use crate::gui::testing::workbench;

    use super::*;

    #[test]
    fn rows_stand_below_one_another_and_many_of_them_in_two_columns() {
        let row = [vec2(40.0, 14.0), vec2(60.0, 14.0)];
        let (few, wide, high) = places(&[row; 3], 0.0);
        assert_eq!((wide, high), (112.0, 48.0));
        assert!(few.windows(2).all(|pair| pair[1][0].y > pair[0][0].y));
        let (many, wide, high) = places(&[row; 12], 0.0);
        assert_eq!((wide, high), (242.0, 96.0));
        for [name, value] in &many {
            assert!(name.x + row[0].x <= value.x && value.x + row[1].x <= wide);
            assert!(value.y + row[1].y <= high);
        }
    }

    #[test]
    fn the_title_fits_even_where_there_is_nothing_to_say() {
        let (places, wide, high) = places(&[], 130.0);
        assert!(places.is_empty() && wide == 130.0 && high == 0.0);
    }

    #[test]
    fn the_hover_names_the_sample_its_angle_and_its_deviation() {
        let workbench = workbench();
        let (title, lines) = about(&workbench, 0);
        assert_eq!(title, "sample 1");
        let says = |what: &str| lines.iter().any(|(name, _)| name == what);
        assert!(says("pan") && says("deviation") && says("direction") && says("tolerance"));
    }
}
