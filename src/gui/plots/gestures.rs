//! How plots are looked at with the mouse, the same in all of them: the wheel goes closer about the
//! pointer, as in drawing programs and on maps; dragging moves; a double click shows everything.

use crate::text::{Template, spoken};
use std::fmt::Debug;
use std::hash::Hash;

use egui::{Context, Rect, Response, RichText, Ui, Vec2, vec2};
use egui_plot::{Plot, PlotResponse, PlotUi};

use crate::gui::style::size;
use crate::gui::widgets;

/// What is done with the mouse, and what it does; the help and the tooltips say the same.
pub(crate) const GESTURES: [(Template, Template); 7] = [
    (phrase!("wheel, or pinch"), phrase!("zoom at the pointer")),
    (
        phrase!("Shift and wheel"),
        phrase!("zoom along a chart's axis"),
    ),
    (phrase!("drag"), phrase!("move")),
    (
        phrase!("drag with the right button"),
        phrase!("show a part"),
    ),
    (phrase!("drag in the 3-D view"), phrase!("orbit")),
    (
        phrase!("Shift or middle button and drag in the 3-D view"),
        phrase!("move"),
    ),
    (phrase!("double click, or Home"), phrase!("fit the view")),
];

/// So much scrolling goes closer by a factor of e, points: a notch of a wheel is 40.
const SCROLL: f32 = 300.0;
/// The smallest and the largest span that can be gone to, in what the axes show.
const SPANS: [f64; 2] = [1e-9, 1e9];

/// A plot of this name that shows everything until the mouse asks for something else.
pub(crate) fn plot<'a>(id: impl Hash + Debug) -> Plot<'a> {
    Plot::new(id)
        .show_x(false)
        .show_y(false)
        .show_background(false)
        .show_crosshair(false)
        .allow_scroll(false)
}

/// Shows it, with the wheel going closer.
pub(crate) fn show<'a>(
    ui: &mut Ui,
    plot: Plot<'a>,
    add: impl FnOnce(&mut PlotUi<'a>) + 'a,
) -> PlotResponse<()> {
    let shown = plot.show(ui, |plot| {
        add(plot);
        let closer = closer(plot.ctx());
        let reached = plot.response().contains_pointer();
        if reached && closer != Vec2::splat(1.0) && sound(plot, closer) {
            plot.zoom_bounds_around_hovered(closer);
        }
    });
    settle(&shown.response);
    shown
}

/// Axes are laid out with the room that they took in the frame before: whatever the plot's size
/// was, there is another frame until it stays.
fn settle(response: &Response) {
    let id = response.id.with("settled");
    let before: Option<Rect> = response.ctx.data(|data| data.get_temp(id));
    if before != Some(response.rect) {
        response
            .ctx
            .data_mut(|data| data.insert_temp(id, response.rect));
        response.ctx.request_repaint();
    }
}

/// How much closer the wheel goes in this frame, along the axis below and upwards.
pub(crate) fn closer(ctx: &Context) -> Vec2 {
    let (scrolled, shift) = ctx.input(|i| (i.smooth_scroll_delta(), i.modifiers.shift));
    if shift {
        // egui turns the wheel sideways with Shift.
        let along = scrolled.x + scrolled.y;
        return vec2((along / SCROLL).exp(), 1.0);
    }
    Vec2::splat((scrolled.y / SCROLL).exp())
}

fn sound(plot: &PlotUi<'_>, closer: Vec2) -> bool {
    let bounds = plot.plot_bounds();
    let [x, y] = [bounds.width(), bounds.height()];
    let then = [x / f64::from(closer.x), y / f64::from(closer.y)];
    then.into_iter().all(|span| {
        let [least, most] = SPANS;
        (least..=most).contains(&span)
    })
}

/// Four corners: shows everything again. Says how to look at a part.
pub(crate) fn fit(ui: &mut Ui, name: &str) -> bool {
    let button = widgets::icon_button(ui, widgets::FIT, name);
    let response = button.on_hover_ui(|ui| {
        ui.set_max_width(320.0);
        widgets::bold(ui, name);
        for (how, what) in GESTURES {
            let says = format!("{}: {}", spoken(how), spoken(what));
            ui.label(RichText::new(says).size(size::SMALL));
        }
    });
    response.clicked()
}
