//! What plots are made of: axes in the window's type, with a label wherever one fits; marks, and a drawing in plot
//! coordinates: shape says what colour says, a triangle points the way that the joint came. A plot itself is a model
//! (what is shown), a layout (where it goes; both are tested without pixels) and paint (egui).

pub(crate) mod chart;

use std::fmt::Debug;
use std::hash::Hash;

use egui::epaint::{Mesh, Tessellator, Vertex};
use egui::{
    Color32, Context, FontId, Painter, Pos2, Rangef, Response, RichText, Role, Shape, Stroke, Ui,
    Vec2, WidgetInfo, vec2,
};
use egui_plot::{Axis, AxisHints, GridMark, Plot, PlotResponse, PlotTransform, PlotUi};

use crate::gui::charts::{self, ChartKind};
use crate::gui::style::{Palette, size};
use crate::gui::view::Plot as Picture;
use crate::gui::view::What;
use crate::gui::widgets::{self, Buttons, Does};
use crate::gui::workbench::Workbench;
use crate::present::chart::{Form, Ticks, ticks};
use crate::present::numbers::trimmed;
use crate::text::{Template, spoken, within};

/// Saves a plot as a file.
pub(crate) fn picture(ui: &mut Ui, plot: Picture, workbench: &Workbench) {
    let name = match plot {
        Picture::Workspace => say!("Workspace").to_owned(),
        Picture::Chart(id) => charts::find(id).map_or_else(String::new, ChartKind::name),
    };
    let says = say!("Save picture: {plot}…", plot = within(&name));
    let button = ui.icon_button(widgets::SAVE, &says);
    button.on_hover_text(&says).does(workbench, move |bench| {
        bench.choose_where_to_export(What::Picture(plot));
    });
}

/// Names a chart for those who do not see it, and says what is seen in it.
pub(crate) fn figure(response: &Response, name: &str, says: String) {
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, name));
    response
        .ctx
        .accesskit_node_builder(response.id, |node| node.set_description(says));
}

/// An axis with this label; `shown` turns a value of the plot into the one that is written.
pub(crate) fn axis<'a>(
    axis: Axis,
    label: String,
    palette: &Palette,
    shown: impl Fn(f64) -> f64 + 'a,
) -> Vec<AxisHints<'a>> {
    let label = RichText::new(label).small().weak();
    let room = match axis {
        Axis::X => Rangef::new(34.0, 56.0),
        Axis::Y => Rangef::new(18.0, 28.0),
    };
    let hints = AxisHints::new(axis)
        .label(label)
        .label_spacing(room)
        .tick_label_color(palette.muted)
        .tick_label_font(FontId::proportional(size::SMALL))
        .formatter(move |mark, _| trimmed(shown(mark.value), 4));
    vec![match axis {
        Axis::X => hints,
        Axis::Y => hints.min_thickness(40.0),
    }]
}

/// A chart's axis, with a word for each place where it has words, `width` the widest of them: known before it is laid out,
/// so that the plot stands where it stays from its first frame on.
pub(super) fn of_chart<'a>(
    side: Axis,
    of: &crate::present::chart::Axis,
    palette: &Palette,
    width: f32,
) -> Vec<AxisHints<'a>> {
    let hints = axis(side, of.label.clone(), palette, |x| x);
    let Ticks::Words(words) = of.ticks.clone() else {
        return hints;
    };
    let color = match side {
        Axis::X => palette.muted,
        Axis::Y => palette.text,
    };
    let named = move |place: f64| {
        let word = words.iter().find(|(at, _)| (at - place).abs() < 0.5);
        word.map_or_else(String::new, |(_, word)| word.clone())
    };
    let hint = hints.into_iter().next_back();
    let hint = hint.map(|hint| hint.label_spacing(Rangef::new(10.0, 16.0)));
    let hint = hint.map(|hint| hint.min_thickness(width));
    let hint = hint.map(|hint| hint.tick_label_color(color));
    let named = hint.map(|hint| hint.formatter(move |mark, _| named(mark.value)));
    Vec::from_iter(named)
}

/// Where a chart's axis has labels between two ends, at most about `most` of them.
pub(super) fn places(of: &Ticks, bounds: (f64, f64), most: f64) -> Vec<GridMark> {
    match of {
        Ticks::Words(words) => {
            // What lies closer to another than it is wide is not named.
            let apart = words.windows(2).map(|two| (two[0].0 - two[1].0).abs());
            let step_size = apart.reduce(f64::min).unwrap_or(1.0);
            let mark = |(value, _): &(f64, String)| GridMark {
                value: *value,
                step_size,
            };
            words.iter().map(mark).collect()
        }
        Ticks::Plane => Vec::new(),
        other => steps(bounds, *other == Ticks::Degrees, most),
    }
}

/// Grid lines at round numbers of the unit in which values are written, `per` of it for one of the plot's.
pub(crate) fn steps_in(per: f64, (low, high): (f64, f64), lines: f64) -> Vec<GridMark> {
    let marks = steps((low * per, high * per), false, lines).into_iter();
    let back = |mark: GridMark| GridMark {
        value: mark.value / per,
        step_size: mark.step_size / per,
    };
    marks.map(back).collect()
}

/// Grid lines at round numbers, at most about `lines`, so that each gets its label: in degrees at
/// parts of a turn.
fn steps((low, high): (f64, f64), degrees: bool, lines: f64) -> Vec<GridMark> {
    let (values, step_size) = ticks([low, high], degrees, lines);
    let mark = |value| GridMark { value, step_size };
    values.into_iter().map(mark).collect()
}

/// Corners of forms that look to the right, of a radius of 1.
const DIAMOND: [[f32; 2]; 4] = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
const TRIANGLE: [[f32; 2]; 3] = [[1.25, 0.0], [-0.75, 1.1], [-0.75, -1.1]];

/// A mark of a chart.
pub(crate) fn mark(at: Pos2, radius: f32, form: Form, fill: Color32, stroke: Stroke) -> Shape {
    let (corners, radius): (&[[f32; 2]], f32) = match form {
        Form::Disc => {
            return Shape::Circle(egui::epaint::CircleShape {
                center: at,
                radius,
                fill,
                stroke,
            });
        }
        Form::Diamond => (&DIAMOND, 1.3 * radius),
        Form::Forwards => (&TRIANGLE, radius),
        Form::Backwards => (&TRIANGLE, -radius),
    };
    let corners = corners.iter().map(|[x, y]| at + vec2(*x, *y) * radius);
    Shape::convex_polygon(corners.collect(), fill, stroke)
}

/// Adds many marks that look alike but for their form. Paths are one mesh: each form is tessellated once and then
/// set down wherever it stands, at a tenth of what as many paths cost. Filled discs stay shapes, since epaint has
/// them in its atlas of glyphs, which may grow until the frame ends.
pub(crate) fn many(
    ctx: &Context,
    places: impl ExactSizeIterator<Item = (Pos2, Form)>,
    (radius, fill, stroke): (f32, Color32, Stroke),
    shapes: &mut Vec<Shape>,
) {
    let following = places.len();
    let options = ctx.tessellation_options(|options| *options);
    // No text and no prepared disc is among them.
    let mut tessellator = Tessellator::new(ctx.pixels_per_point(), options, [1, 1], Vec::new());
    let mut stamps: Vec<(Form, Mesh)> = Vec::new();
    let mut mesh = Mesh::default();
    for (at, form) in places {
        if form == Form::Disc && fill != Color32::TRANSPARENT {
            shapes.push(mark(at, radius, form, fill, stroke));
            continue;
        }
        let known = stamps.iter().position(|(of, _)| *of == form);
        let stamp = known.unwrap_or_else(|| {
            let mut stamp = Mesh::default();
            let shape = mark(Pos2::ZERO, radius, form, fill, stroke);
            tessellator.tessellate_shape(shape, &mut stamp);
            // Room for those that follow, as if all looked like this one.
            if stamps.is_empty() {
                mesh.vertices.reserve(following * stamp.vertices.len());
                mesh.indices.reserve(following * stamp.indices.len());
            }
            stamps.push((form, stamp));
            stamps.len() - 1
        });
        set_down(&mut mesh, &stamps[stamp].1, at);
    }
    if !mesh.is_empty() {
        shapes.push(Shape::mesh(mesh));
    }
}

/// Adds a mesh about the origin, moved to a place.
fn set_down(mesh: &mut Mesh, stamp: &Mesh, at: Pos2) {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "as many as the indices of a mesh can name"
    )]
    let first = mesh.vertices.len() as u32;
    mesh.indices
        .extend(stamp.indices.iter().map(|index| first + index));
    let moved = |vertex: &Vertex| Vertex {
        pos: vertex.pos + at.to_vec2(),
        ..*vertex
    };
    mesh.vertices.extend(stamp.vertices.iter().map(moved));
}

/// What the mouse does.
const GESTURES: [Template; 4] = [
    phrase!("wheel or pinch: zoom, with Shift along a chart's axis"),
    phrase!("drag: move; in the 3-D view orbit, with Shift move"),
    phrase!("drag with the right button: show a part"),
    phrase!("double click, or Home: fit the view"),
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

/// Shows it with a drawing in it, the wheel going closer. It fits these bounds (smallest and largest corner) until it
/// is looked at otherwise.
pub(crate) fn show(
    ui: &mut Ui,
    plot: Plot<'_>,
    bounds: [[f64; 2]; 2],
    draw: impl FnOnce(&Painter, &PlotTransform) -> Vec<Shape>,
) -> (Response, PlotTransform) {
    let [[left, low], [right, high]] = bounds;
    let plot = plot.include_x(left).include_x(right);
    let plot = plot.include_y(low).include_y(high);
    let PlotResponse {
        response,
        transform,
        ..
    } = plot.show(ui, |plot| {
        let closer = closer(plot.ctx());
        let reached = plot.response().contains_pointer();
        if reached && closer != Vec2::splat(1.0) && sound(plot, closer) {
            plot.zoom_bounds_around_hovered(closer);
        }
    });
    // Axes are laid out with the room that they took in the frame before.
    widgets::settle(ui, response.id, *transform.frame());
    let painter = ui.painter().with_clip_rect(*transform.frame());
    painter.extend(draw(&painter, &transform));
    (response, transform)
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
    let says = format!("{name}\n{}", GESTURES.map(spoken).join("\n"));
    let button = ui.icon_button(widgets::FIT, name);
    button.on_hover_text(says).clicked()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_round_in_the_unit_in_which_they_are_written() {
        let per_mm = 1.0 / 25.4;
        let marks = steps_in(per_mm, (-420.0, 420.0), 9.0);
        let inches: Vec<f64> = marks.iter().map(|mark| mark.value * per_mm).collect();
        assert_eq!(inches.len(), 7, "{inches:?}");
        for inch in inches {
            assert!((inch / 5.0 - (inch / 5.0).round()).abs() < 1e-9, "{inch}");
        }
    }
}
