//! An effect that was found, as a card: how large it is, what to check on the machine, a small curve; what that rests
//! on is below *More*.

use std::borrow::Cow;

use egui::{CursorIcon, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

use crate::diagnosis::Diagnosis;
use crate::explain::{Block, Detail, Section, found_effect};
use crate::fit::Estimate;
use crate::gui::charts::effect::{self, EffectCurve};
use crate::gui::core::answer::term_of;
use crate::gui::core::scale::stride;
use crate::gui::plots::disc;
use crate::gui::style::{Palette, size, space};
use crate::gui::widgets;
use crate::gui::workbench::Workbench;

use super::blocks::{self, curve_link};

/// What stands below its title.
pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    (d, index, section): (&Diagnosis, usize, &Section),
) {
    let section = in_use(workbench, d, index).map_or(Cow::Borrowed(section), Cow::Owned);
    let is_facts = |block: &&Block| matches!(block, Block::Facts(_));
    let rest = section.blocks.iter().skip(1).position(|b| is_facts(&b));
    let (first, more) = section.blocks.split_at(rest.map_or(0, |rest| rest + 1));
    blocks::show(ui, first);
    match workbench.sketch(index) {
        Some(curve) => sketch(ui, workbench, (index, curve)),
        None => curve_link(ui, workbench, index),
    }
    in_the_model(ui, workbench, d, index);
    ui.push_id(index, |ui| {
        widgets::folded(ui, say!("More"), size::SMALL, |ui| blocks::show(ui, more));
    });
}

/// The same with the sizes that the model in use has: with fewer effects in it, it is another fit than the search's.
fn in_use(workbench: &Workbench, d: &Diagnosis, index: usize) -> Option<Section> {
    let found = &d.found[index];
    let term = term_of(d, found)?;
    let mut added = workbench.document().in_the_model();
    added.find(|t| t.same_column(&term))?;
    let all = &workbench.answer()?.identification.parameters;
    let of_it = |one: &&Estimate| one.effect == found.effect && one.joint == found.joint;
    let sizes: Vec<Estimate> = all.iter().filter(of_it).cloned().collect();
    let detail = Detail::window(workbench.units());
    (!sizes.is_empty()).then(|| found_effect(d, detail, index, &sizes))
}

/// Height of a small curve, points, and how many samples are behind it at most.
const HIGH: f32 = 46.0;
const MOST: usize = 240;

/// What is left without the effect, and what it does; a click shows the chart of it.
fn sketch(ui: &mut Ui, workbench: &Workbench, (index, curve): (usize, &EffectCurve)) {
    let palette = Palette::of(ui);
    let view = &workbench.view;
    let shown = workbench.shows(effect::ID) && view.effect == index;
    let sense = if shown {
        Sense::hover()
    } else {
        Sense::click()
    };
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), HIGH), sense);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, !shown, say!("Show its curve")));
    let edge = if shown || response.hovered() || response.has_focus() {
        palette.accent
    } else {
        palette.line
    };
    let round = f32::from(space::ROUND);
    let inside = egui::StrokeKind::Inside;
    ui.painter()
        .rect(rect, round, palette.surface, Stroke::new(1.0, edge), inside);
    ui.painter()
        .extend(drawn(rect.shrink2(vec2(6.0, 4.0)), curve, &palette));
    if response.clicked() {
        workbench.then(move |bench| bench.show_effect(index));
    }
    if !shown {
        let response = response.on_hover_cursor(CursorIcon::PointingHand);
        response.on_hover_text(say!("Show its curve"));
    }
}

fn drawn(room: Rect, curve: &EffectCurve, palette: &Palette) -> Vec<Shape> {
    let ends = curve.spots.first().zip(curve.spots.last());
    let [from, to] = ends.map_or([0.0, 1.0], |(a, b)| [a.x, b.x]);
    let [low, high] = curve.extent_mm;
    let part = |value: f64, low: f64, high: f64| {
        crate::numeric::single((value - low) / (high - low).max(1e-12))
    };
    let at = |x: f64, mm: f64| {
        let across = egui::lerp(room.left()..=room.right(), part(x, from, to));
        pos2(
            across,
            egui::lerp(room.bottom()..=room.top(), part(mm, low, high)),
        )
    };
    let zero = [at(from, 0.0), at(to, 0.0)];
    let mut shapes = vec![Shape::line_segment(zero, Stroke::new(1.0, palette.line))];
    let some = || curve.spots.iter().step_by(stride(curve.spots.len(), MOST));
    let residual = palette.before.gamma_multiply(0.55);
    shapes.extend(some().map(|s| disc(at(s.x, s.residual_mm), 1.4, residual)));
    if curve.lines.is_empty() {
        shapes.extend(some().map(|s| disc(at(s.x, s.effect_mm), 1.6, palette.accent)));
    }
    let stroke = Stroke::new(1.8, palette.accent);
    for line in &curve.lines {
        let points: Vec<_> = line.points.iter().map(|[x, mm]| at(*x, *mm)).collect();
        if line.side < 0.0 {
            shapes.extend(Shape::dashed_line(&points, stroke, 4.0, 3.0));
        } else {
            shapes.push(Shape::line(points, stroke));
        }
    }
    shapes
}

/// Adds the effect to the model, or switches it off there.
fn in_the_model(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis, index: usize) {
    let Some(term) = term_of(d, &d.found[index]) else {
        return;
    };
    let mut added = workbench.document().added.iter();
    match added.position(|a| a.term.same_column(&term)) {
        None => {
            // The button that stands out is the one at the foot of the step, which adds all of them.
            if widgets::secondary(ui, say!("Add to model")).clicked() {
                workbench.then(move |bench| bench.add(&[term]));
            }
        }
        Some(index) => {
            let mut on = workbench.document().added[index].on;
            if ui.checkbox(&mut on, say!("in the model")).changed() {
                workbench.then(move |bench| bench.switch(index, on));
            }
        }
    }
}
