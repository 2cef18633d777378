//! A chart on the screen, and its legend above it, in rows of their own, so that no mark is covered: names with their
//! signs before them.

use egui::epaint::Mesh;
use egui::{
    Align, Align2, Color32, FontId, Label, Painter, Pos2, Rect, Response, RichText, Role, Sense,
    Shape, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use egui_plot::{Axis, Plot, PlotBounds, PlotPoint, PlotTransform};

use crate::present::chart::{Chart, ColourRole, Entry, Item, LegendSymbol, Ticks};
use crate::present::drawing::Anchor;

use crate::gui::charts::{Bar, Shown};
use crate::gui::style::{Palette, size};
use crate::gui::widgets::Words;
use crate::gui::workbench::Workbench;

use crate::gui::plots::{self, many, mark, of_chart, places};

/// What something that stands for this is drawn in.
fn color(stands: ColourRole, palette: &Palette) -> Color32 {
    match stands {
        ColourRole::Before => palette.before,
        ColourRole::After | ColourRole::Corrected => palette.after,
        ColourRole::Reference => palette.nominal,
        ColourRole::Tolerance => palette.within,
        ColourRole::Noise => palette.muted,
        ColourRole::Curve => palette.accent,
    }
}

/// Shows a chart, rings around some samples, and a frame around the bars of one. Charts of another `id` are looked at
/// anew.
pub(crate) fn show(
    ui: &mut Ui,
    id: (&str, bool, u64),
    shown: &Shown,
    ringed: impl Iterator<Item = usize>,
    framed: Option<usize>,
) -> (Response, PlotTransform) {
    let (palette, chart) = (Palette::of(ui), &shown.chart);
    // No closer than their numbers need, which are left out otherwise.
    let beside = label_width(ui.painter(), chart, &palette);
    let room = (ui.available_width() - beside.max(40.0)) / 50.0;
    let plot = plot(id, chart, beside, f64::from(room.clamp(3.0, 9.0)), &palette);
    plots::show(ui, plot, chart.bounds, |painter, transform| {
        let canvas = Canvas::new(transform, painter, &palette, chart);
        let mut shapes = canvas.drawn(shown);
        let at = |sample: usize| shown.series.iter().rev().find_map(|one| one.at(sample));
        let ring = Stroke::new(2.5, palette.accent);
        let ringed = ringed.filter_map(at);
        shapes.extend(ringed.map(|at| Shape::circle_stroke(canvas.at(at), 8.0, ring)));
        let of = |bar: &&Bar| framed.is_some_and(|one| bar.samples.binary_search(&one).is_ok());
        for bar in shown.bars.iter().filter(of) {
            let [from, to] = bar.x.map(|x| canvas.at([x, 0.0]).x);
            let rect = Rect::from_x_y_ranges(from..=to, transform.frame().y_range());
            let stroke = Stroke::new(2.0, palette.accent);
            shapes.push(Shape::rect_stroke(rect, 2.0, stroke, StrokeKind::Inside));
        }
        shapes
    })
}

/// A chart without its axes, so small that its marks are dots.
pub(crate) fn sketch(painter: &Painter, room: Rect, shown: &Shown, palette: &Palette) {
    let [low, high] = shown.chart.bounds;
    let bounds = PlotBounds::from_min_max(low, high);
    let transform = PlotTransform::new(room, bounds, false);
    let canvas = Canvas {
        scale: 0.3,
        ..Canvas::new(&transform, painter, palette, &shown.chart)
    };
    painter.extend(canvas.drawn(shown));
}

/// Room for the words beside a chart, points; none where it has numbers.
fn label_width(painter: &Painter, chart: &Chart, palette: &Palette) -> f32 {
    let Ticks::Words(words) = &chart.upwards.ticks else {
        return 0.0;
    };
    let font = FontId::proportional(size::SMALL);
    let wide = words.iter().map(|(_, word)| {
        let galley = painter.layout_no_wrap(word.clone(), font.clone(), palette.text);
        galley.size().x + 12.0
    });
    wide.fold(0.0, f32::max)
}

fn plot<'a>(
    id: impl std::hash::Hash + std::fmt::Debug,
    chart: &Chart,
    label_width: f32,
    most: f64,
    palette: &Palette,
) -> Plot<'a> {
    let [across, upwards] = [&chart.across, &chart.upwards];
    let lines = [across, upwards].map(|axis| !matches!(axis.ticks, Ticks::Words(_)));
    let [x, y] = [across.ticks.clone(), upwards.ticks.clone()];
    if y == Ticks::Plane {
        return plots::plot(id)
            .data_aspect(1.0)
            .show_axes(false)
            .show_grid(false)
            .set_margin_fraction(egui::Vec2::ZERO);
    }
    plots::plot(id)
        .set_margin_fraction(egui::Vec2::ZERO)
        .grid_color(palette.line)
        .show_grid(lines)
        .x_grid_spacer(move |input| places(&x, input.bounds, most))
        .y_grid_spacer(move |input| places(&y, input.bounds, 4.0))
        .custom_x_axes(of_chart(Axis::X, across, palette, 0.0))
        .custom_y_axes(of_chart(Axis::Y, upwards, palette, label_width))
}

/// What a chart is drawn on.
struct Canvas<'a> {
    transform: &'a PlotTransform,
    painter: &'a Painter,
    palette: &'a Palette,
    /// Whether there is nothing after to be seen through what was before.
    alone: bool,
    /// How large marks and how thick lines are.
    scale: f32,
}

/// A dash and the gap after it, points.
const DASH: [f32; 2] = [5.0, 3.5];

impl<'a> Canvas<'a> {
    fn new(
        transform: &'a PlotTransform,
        painter: &'a Painter,
        palette: &'a Palette,
        chart: &Chart,
    ) -> Self {
        let after = |item: &Item| item.colour_role() == Some(ColourRole::After);
        Self {
            transform,
            painter,
            palette,
            alone: !chart.items.iter().any(after),
            scale: 1.0,
        }
    }

    fn at(&self, [x, y]: [f64; 2]) -> Pos2 {
        self.transform.position_from_point(&PlotPoint::new(x, y))
    }

    /// What is in sight of a chart.
    fn drawn(&self, shown: &Shown) -> Vec<Shape> {
        let bounds = self.transform.bounds();
        let mut shapes = Vec::new();
        for item in shown.in_sight([bounds.min()[0], bounds.max()[0]]) {
            self.draw(&item, &mut shapes);
        }
        shapes
    }

    fn draw(&self, item: &Item, shapes: &mut Vec<Shape>) {
        let palette = self.palette;
        let color = item
            .colour_role()
            .map_or(palette.muted, |s| color(s, palette));
        match item {
            Item::Band([low, high], _) => {
                let frame = self.transform.frame();
                let (low, high) = (self.at([0.0, *low]).y, self.at([0.0, *high]).y);
                let corners = [pos2(frame.left(), high), pos2(frame.right(), low)];
                let rect = Rect::from_two_pos(corners[0], corners[1]);
                shapes.push(Shape::rect_filled(rect, 0.0, color.gamma_multiply(0.14)));
            }
            Item::Bars(bars, _, filled) => {
                for [from, to] in bars {
                    let rect = Rect::from_two_pos(self.at(*from), self.at(*to));
                    if *filled {
                        shapes.push(Shape::rect_filled(rect, 0.0, color.gamma_multiply(0.85)));
                    } else {
                        let stroke = Stroke::new(1.3, color);
                        shapes.push(Shape::rect_filled(rect, 0.0, color.gamma_multiply(0.10)));
                        shapes.push(Shape::rect_stroke(rect, 0.0, stroke, StrokeKind::Inside));
                    }
                }
            }
            Item::Ribbon(places, _) => shapes.push(self.ribbon(places, color.gamma_multiply(0.28))),
            Item::Line(points, _, width, dashed) => {
                let points = points.iter().map(|p| self.at(*p));
                let points: Vec<Pos2> = points.filter(|p| p.is_finite()).collect();
                let stroke = Stroke::new(*width * self.scale, color);
                if *dashed {
                    shapes.extend(Shape::dashed_line(&points, stroke, DASH[0], DASH[1]));
                } else {
                    shapes.push(Shape::line(points, stroke));
                }
            }
            Item::Marks(marks, _, filled) => {
                let (fill, stroke, radius) = if *filled {
                    (color, Stroke::new(0.8, palette.surface), 3.4)
                } else if self.alone {
                    (color.gamma_multiply(0.35), Stroke::new(1.2, color), 3.2)
                } else {
                    let edge = Stroke::new(1.2, color.gamma_multiply(0.75));
                    (Color32::TRANSPARENT, edge, 3.2)
                };
                let places = marks.iter().map(|m| (self.at(m.at), m.form));
                let looks = (radius * self.scale, fill, stroke);
                many(self.painter.ctx(), places, looks, shapes);
            }
            Item::Word(word) => {
                let font = FontId::proportional(size::SMALL);
                let galley = self.painter.layout_no_wrap(word.text.clone(), font, color);
                let across = match word.anchor {
                    Anchor::Start => Align::Min,
                    Anchor::Middle => Align::Center,
                    Anchor::End => Align::Max,
                };
                let upwards = [Align::Center, Align::Min][usize::from(word.below)];
                let anchor = Align2([across, upwards]);
                let rect = anchor.anchor_size(self.at(word.at), galley.size());
                shapes.push(Shape::galley(rect.min, galley, color));
            }
        }
    }

    /// The area between two lines.
    fn ribbon(&self, places: &[[f64; 3]], color: Color32) -> Shape {
        let mut mesh = Mesh::default();
        for ([x, low, high], k) in places.iter().zip(0_u32..) {
            mesh.colored_vertex(self.at([*x, *low]), color);
            mesh.colored_vertex(self.at([*x, *high]), color);
            if k > 0 {
                let [a, b, c, d] = [2 * k - 2, 2 * k - 1, 2 * k, 2 * k + 1];
                mesh.add_triangle(a, b, c);
                mesh.add_triangle(c, b, d);
            }
        }
        Shape::mesh(mesh)
    }
}

/// What stands in the place of a chart that cannot be drawn.
pub(crate) fn empty(ui: &mut Ui, title: &str, why: &str) {
    let high = ui.available_height();
    let shown = ui.vertical_centered(|ui| {
        ui.add_space(0.3 * high);
        ui.set_max_width(460.0);
        ui.bold(title);
        ui.hint(why);
        ui.take_available_height();
    });
    let name = format!("{title}. {why}");
    let response = shown.response;
    response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, name.clone()));
}

// The legend.

/// Height of a row, points.
const HEIGHT: f32 = 18.0;
/// Width of a sign, points.
pub(crate) const SIGN: f32 = 12.0;
/// Between a sign and its name, points.
const GAP: f32 = 4.0;

/// Rows of a legend, as many as it takes; so much lies between entries and between rows, points.
pub(crate) fn rows<R>(ui: &mut Ui, between: Vec2, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let scope = ui.scope(|ui| {
        ui.spacing_mut().item_spacing = between;
        ui.spacing_mut().interact_size.y = HEIGHT;
        ui.horizontal_wrapped(contents).inner
    });
    scope.inner
}

/// A name in this colour, with a sign before it whose shapes lie about the middle of so much room. Where the room is.
pub(crate) fn entry(
    ui: &mut Ui,
    (sign, room): (Vec<Shape>, f32),
    (name, color): (&str, Color32),
    sense: Sense,
) -> (Rect, Response) {
    let font = FontId::proportional(size::SMALL);
    let painter = ui.painter().clone();
    let galley = painter.layout_no_wrap(name.to_owned(), font, color);
    let between = if room > 0.0 && !name.is_empty() {
        GAP
    } else {
        0.0
    };
    let wide = vec2(room + between + galley.size().x, HEIGHT);
    let (rect, response) = ui.allocate_exact_size(wide, sense);
    if sense.senses_click() && (response.hovered() || response.has_focus()) {
        let behind = rect.expand2(vec2(4.0, 0.0));
        painter.rect_filled(behind, 3.0, Palette::of(ui).inset);
    }
    let place = rect.with_max_x(rect.left() + room);
    painter.extend(sign.into_iter().map(|mut shape| {
        shape.translate(place.center().to_vec2());
        shape
    }));
    let at = pos2(
        place.right() + between,
        rect.center().y - 0.5 * galley.size().y,
    );
    painter.galley(at, galley, color);
    (place, response)
}

/// A chart of this height has room for lines more, points.
const HIGH: f32 = 220.0;

/// What the marks of a chart are, and what has to be said; what may go is left out by a press. `shown`: whether it is
/// there; `None`: it cannot go.
pub(crate) fn legend(ui: &mut Ui, chart: &Chart, shown: Option<bool>, workbench: &Workbench) {
    let high = ui.available_height() > HIGH;
    rows(ui, vec2(12.0, 0.0), |ui| {
        for one in &chart.legend {
            let shown = shown.filter(|_| one.may_go);
            if named(ui, one, shown) {
                workbench.then(move |bench| bench.view.only_after = shown == Some(true));
            }
        }
        if !chart.note.is_empty() {
            let note = Label::new(RichText::new(&chart.note).small().weak());
            ui.add(if high { note.wrap() } else { note.truncate() });
        }
    });
}

/// A name with its mark; whether it was pressed.
fn named(ui: &mut Ui, one: &Entry, shown: Option<bool>) -> bool {
    let palette = Palette::of(ui);
    let off = shown == Some(false);
    let text = if off { palette.nominal } else { palette.muted };
    let full = color(one.role, &palette);
    let faded = if off { full.gamma_multiply(0.35) } else { full };
    let sense = shown.map_or(Sense::hover(), |_| Sense::click());
    let name = &one.name;
    let (sign, response) = entry(ui, (symbol(one, faded), SIGN), (name, text), sense);
    response.widget_info(|| match shown {
        Some(shown) => WidgetInfo::selected(Role::CheckBox, true, shown, say!("show {name}", name)),
        None => WidgetInfo::labeled(Role::Label, true, name),
    });
    if off {
        let through = (sign.right() + GAP)..=response.rect.right();
        let y = response.rect.center().y;
        ui.painter().hline(through, y, Stroke::new(1.0, text));
    }
    response.clicked()
}

fn symbol(entry: &Entry, color: Color32) -> Vec<Shape> {
    let square = Rect::from_center_size(egui::Pos2::ZERO, vec2(9.0, 9.0));
    let ends = [-0.5, 0.5].map(|end| pos2(end * SIGN, 0.0));
    let line = Stroke::new(1.8, color);
    match (entry.sign, entry.filled) {
        (LegendSymbol::Mark(form), filled) => {
            let fill = if filled { color } else { Color32::TRANSPARENT };
            vec![mark(
                square.center(),
                3.4,
                form,
                fill,
                Stroke::new(1.2, color),
            )]
        }
        (LegendSymbol::Band, _) => {
            vec![Shape::rect_filled(square, 1.0, color.gamma_multiply(0.3))]
        }
        (LegendSymbol::Bar, true) => vec![Shape::rect_filled(square, 1.0, color)],
        (LegendSymbol::Bar, false) => {
            let edge = Stroke::new(1.5, color);
            vec![Shape::rect_stroke(square, 1.0, edge, StrokeKind::Inside)]
        }
        (LegendSymbol::Line, true) => vec![Shape::line_segment(ends, line)],
        (LegendSymbol::Line, false) => Shape::dashed_line(&ends, line, 3.5, 2.0),
    }
}
