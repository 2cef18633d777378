//! The middle: workspace and charts, beside and below each other. They are split, moved by their
//! handles and pulled by the grips between them; where there is no room for all of them one is
//! shown, and a switch between them.

mod chart;

use egui::{
    Button, Id, Painter, Popup, Rect, Response, Role, Sense, Stroke, Ui, Vec2, Visuals, WidgetInfo,
    WidgetText, vec2,
};
use egui_tiles::{
    Behavior, Container, EditAction, Linear, LinearDir, ResizeState, TileId, Tiles, Tree,
    UiResponse,
};

use crate::gui::actions::{CHART_BELOW, CHART_BESIDE, CLOSE_CHART, WindowState};
use crate::gui::style::layout::MIDDLE;
use crate::gui::style::{Palette, space};
use crate::gui::view::{ChartPane, Content, Edge, Key, Pane, Panes, Plot, SplitShare, Tile, What};
use crate::gui::widgets::{self, Gripped};
use crate::gui::workbench::Workbench;
use crate::gui::workspace;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let panes = &workbench.view.panes;
    let room = ui.available_size();
    if fits(&panes.root, room) {
        tree(ui, workbench);
    } else if let Some(active) = panes.pane(panes.active()) {
        contents(ui, workbench, active, Some(switch));
        settle(ui, active.key);
    }
}

/// Another plot in the place of all is laid out before anybody sees it: in one pass it finds its
/// bounds, in the next it measures its axes.
fn settle(ui: &Ui, key: Key) {
    const UNSEEN: u8 = 2;
    let id = ui.scope_id().with("alone");
    let (before, left) = ui.data(|data| data.get_temp(id)).unwrap_or((key, 0));
    let left: u8 = if before == key { left } else { UNSEEN };
    if left > 0 {
        ui.ctx().request_discard("another plot");
    }
    ui.data_mut(|data| data.insert_temp(id, (key, left.saturating_sub(1))));
}

/// Between panes, points.
const GAP: f32 = 4.0;
/// The least width and height of the workspace and of a chart with their bars, points: so much can be
/// read.
const WORKSPACE: [f32; 2] = [MIDDLE, 336.0];
const CHART: [f32; 2] = [244.0, 252.0];
/// No pane has such a number.
const SPLITS: u64 = 1 << 32;

/// The least that a tile needs along an axis, points: 0 across, 1 down.
fn least(tile: &Tile, axis: usize) -> f32 {
    match (tile, tile.parts()) {
        (Tile::Pane(pane), _) if pane.shows == Content::Workspace => WORKSPACE[axis],
        (_, Some((side_by_side, parts))) => {
            let each = parts.iter().map(|part| least(&part.tile, axis));
            if side_by_side == (axis == 0) {
                each.sum::<f32>() + GAP * (parts.len() as f32 - 1.0)
            } else {
                each.fold(0.0, f32::max)
            }
        }
        _ => CHART[axis],
    }
}

/// Whether there is room for all panes.
fn fits(root: &Tile, room: Vec2) -> bool {
    least(root, 0) <= room.x && least(root, 1) <= room.y
}

/// The room of each part: as its share says, but no less than it needs.
fn divided(parts: &[SplitShare], axis: usize, room: f32) -> Vec<f32> {
    let room = room - GAP * (parts.len() as f32 - 1.0);
    let needs: Vec<f32> = parts.iter().map(|part| least(&part.tile, axis)).collect();
    let mut tight = vec![false; parts.len()];
    loop {
        let taken: f32 = (0..parts.len())
            .filter(|k| tight[*k])
            .map(|k| needs[k])
            .sum();
        let shares: f32 = (0..parts.len())
            .filter(|k| !tight[*k])
            .map(|k| parts[k].share)
            .sum();
        let of = |k: usize| {
            if tight[k] {
                needs[k]
            } else {
                (room - taken) * parts[k].share / shares
            }
        };
        let short: Vec<usize> = (0..parts.len())
            .filter(|k| !tight[*k] && of(*k) < needs[*k])
            .collect();
        if short.is_empty() {
            return (0..parts.len()).map(of).collect();
        }
        for k in short {
            tight[k] = true;
        }
    }
}

/// A tile and what is in it, with shares as they are shown in so much room.
fn laid_out(tile: &Tile, room: Vec2, tiles: &mut Tiles<Key>, splits: &mut u64) -> TileId {
    let Some((side_by_side, parts)) = tile.parts() else {
        let key = if let Tile::Pane(pane) = tile {
            pane.key
        } else {
            0
        };
        let id = TileId::from_u64(u64::from(key));
        tiles.insert(id, egui_tiles::Tile::Pane(key));
        return id;
    };
    let id = TileId::from_u64(SPLITS + *splits);
    *splits += 1;
    let axis = usize::from(!side_by_side);
    let along = if side_by_side { room.x } else { room.y };
    let dir = if side_by_side {
        LinearDir::Horizontal
    } else {
        LinearDir::Vertical
    };
    let mut linear = Linear::new(dir, Vec::new());
    for (part, size) in parts.iter().zip(divided(parts, axis, along)) {
        let inner = if side_by_side {
            Vec2::new(size, room.y)
        } else {
            Vec2::new(room.x, size)
        };
        let child = laid_out(&part.tile, inner, tiles, splits);
        linear.add_child(child);
        // One on average: a pane that is dropped beside them gets as much.
        linear
            .shares
            .set_share(child, size / along * parts.len() as f32);
    }
    tiles.insert(id, egui_tiles::Tile::Container(Container::Linear(linear)));
    id
}

/// The tiles as they are after they were dragged.
fn taken_over(tiles: &Tiles<Key>, id: TileId, panes: &Panes) -> Option<Tile> {
    let container = match tiles.get(id)? {
        egui_tiles::Tile::Pane(key) => return Some(Tile::Pane(panes.pane(*key)?.clone())),
        egui_tiles::Tile::Container(container) => container,
    };
    let (side_by_side, share): (bool, Box<dyn Fn(TileId) -> f32>) = match container {
        Container::Linear(linear) => {
            let shares = linear.shares.clone();
            let side_by_side = linear.dir == LinearDir::Horizontal;
            (side_by_side, Box::new(move |id| shares[id]))
        }
        // None can come about.
        Container::Tabs(_) | Container::Grid(_) => (true, Box::new(|_| 1.0)),
    };
    let parts = container.children().filter_map(|child| {
        let tile = taken_over(tiles, *child, panes)?;
        Some(SplitShare {
            share: share(*child),
            tile,
        })
    });
    let parts = parts.collect();
    Some(if side_by_side {
        Tile::Beside(parts)
    } else {
        Tile::Below(parts)
    })
}

/// The tree of panes as tiles of `egui_tiles`, which lays them out and lets them be dragged; the grips
/// between them are those of the window, which have a name and listen to the arrow keys.
fn tree(ui: &mut Ui, workbench: &Workbench) {
    let panes = &workbench.view.panes;
    let room = ui.available_rect_before_wrap();
    let mut tiles = Tiles::default();
    let root = laid_out(&panes.root, room.size(), &mut tiles, &mut 0);
    let mut tree = Tree::new(Id::unique("panes"), root, tiles);
    let dragged = tree.dragged_id(ui.ctx());
    let mut middle = Middle {
        workbench,
        panes,
        palette: Palette::of(ui),
        dropped: false,
        dragged: dragged.map(|id| (id, Rect::NOTHING)),
    };
    tree.ui(&mut middle, ui);
    let dropped = middle.dropped && !middle.is_at_home(ui.painter());
    if let Some(root) = tree.root.filter(|_| dropped)
        && let Some(root) = taken_over(&tree.tiles, root, panes)
    {
        let mut next = panes.arranged(root);
        if let Some(TileId(key)) = dragged {
            next.activate(Key::try_from(key).unwrap_or_default());
        }
        workbench.then(move |bench| bench.arrange(next));
    } else if dragged.is_none() {
        pulled(ui, workbench, &panes.root, room, &mut Vec::new());
    }
}

/// The grips between the parts of a tile, and of all that is in it; `way` leads to it.
fn pulled(ui: &Ui, workbench: &Workbench, tile: &Tile, area: Rect, way: &mut Vec<usize>) {
    let Some((side_by_side, parts)) = tile.parts() else {
        return;
    };
    let axis = usize::from(!side_by_side);
    let sizes = divided(parts, axis, area.size()[axis]);
    let mut from = area.min[axis];
    for (k, part) in parts.iter().enumerate() {
        let to = from + sizes[k];
        let mut inner = area;
        (inner.min[axis], inner.max[axis]) = (from, to);
        way.push(k);
        pulled(ui, workbench, &part.tile, inner, way);
        way.pop();
        if k + 1 < parts.len() {
            let mut gap = area;
            (gap.min[axis], gap.max[axis]) = (to, to + GAP);
            let name = first(&part.tile).map(|pane| name_of(workbench, pane));
            let name = name.unwrap_or_default();
            let says = if side_by_side {
                say!("width of {name}", name)
            } else {
                say!("height of {name}", name)
            };
            let id = Id::unique("between panes").with((&*way, k));
            let Some(gripped) = widgets::grip_between(ui, id, &says, gap, side_by_side) else {
                from = to + GAP;
                continue;
            };
            let both = sizes[k] + sizes[k + 1];
            let needs = [k, k + 1].map(|k| least(&parts[k].tile, axis));
            let (at, kept) = match gripped {
                Gripped::To(at) => (at - 0.5 * GAP - from, false),
                Gripped::LetGo(at) => (at - 0.5 * GAP - from, true),
                Gripped::Usual => (0.5 * both, true),
            };
            let at = at.min(both - needs[1]).max(needs[0]);
            let mut sizes = sizes.clone();
            (sizes[k], sizes[k + 1]) = (at, both - at);
            let mut panes = workbench.view.panes.clone();
            resize(&mut panes.root, way, &sizes);
            workbench.then(move |bench| {
                if kept {
                    bench.arrange(panes);
                } else {
                    bench.view.panes = panes;
                }
            });
        }
        from = to + GAP;
    }
}

/// The first pane in a tile.
fn first(tile: &Tile) -> Option<&Pane> {
    match tile {
        Tile::Pane(pane) => Some(pane),
        Tile::Beside(parts) | Tile::Below(parts) => first(&parts.first()?.tile),
    }
}

/// Gives the parts of the split that a way leads to these sizes.
fn resize(tile: &mut Tile, way: &[usize], sizes: &[f32]) {
    let (Tile::Beside(parts) | Tile::Below(parts)) = tile else {
        return;
    };
    if let [next, rest @ ..] = way {
        if let Some(part) = parts.get_mut(*next) {
            resize(&mut part.tile, rest, sizes);
        }
        return;
    }
    let all: f32 = sizes.iter().sum();
    for (part, size) in parts.iter_mut().zip(sizes) {
        part.share = size / all;
    }
}

/// How tiles are shown.
struct Middle<'a> {
    workbench: &'a Workbench,
    panes: &'a Panes,
    palette: Palette,
    /// Whether one was dropped.
    dropped: bool,
    /// The one that is dragged, and where it stands.
    dragged: Option<(TileId, Rect)>,
}

impl Middle<'_> {
    /// Whether what is dragged is still over its own place.
    fn is_at_home(&self, painter: &Painter) -> bool {
        let pointer = painter.ctx().pointer_latest_pos();
        self.dragged
            .is_some_and(|(_, home)| pointer.is_none_or(|at| home.contains(at)))
    }
}

impl Behavior<Key> for Middle<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, id: TileId, key: &mut Key) -> UiResponse {
        let Some(pane) = self.panes.pane(*key) else {
            return UiResponse::None;
        };
        let rect = ui.max_rect();
        if let Some((dragged, home)) = &mut self.dragged
            && *dragged == id
        {
            *home = rect;
        }
        ui.shrink_clip_rect(rect);
        let handle = contents(ui, self.workbench, pane, None);
        let pressed = ui.input(|input| input.pointer.any_pressed());
        let active = self.panes.active() == *key;
        if pressed && !active && ui.rect_contains_pointer(rect) {
            let key = *key;
            self.workbench
                .then(move |bench| bench.view.panes.activate(key));
        }
        if active && self.panes.panes().len() > 2 {
            let line = Stroke::new(space::RING, self.palette.accent);
            ui.painter().hline(rect.x_range(), rect.top() + 1.0, line);
        }
        if handle.is_some_and(|handle| handle.drag_started()) {
            UiResponse::DragStarted
        } else {
            UiResponse::None
        }
    }

    fn tab_title_for_pane(&mut self, key: &Key) -> WidgetText {
        let pane = self.panes.pane(*key);
        let name = pane.map(|pane| name_of(self.workbench, pane));
        name.unwrap_or_default().into()
    }

    /// There are no tabs, and with a bar as high as this no place to drop one is the nearest.
    fn tab_bar_height(&self, _: &egui::Style) -> f32 {
        1e6
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        GAP
    }

    /// The grips do it.
    fn is_container_resizable(&self, _: &Tiles<Key>, _: TileId) -> bool {
        false
    }

    fn resize_stroke(&self, _: &egui::Style, _: ResizeState) -> Stroke {
        Stroke::NONE
    }

    fn dragged_overlay_color(&self, _: &Visuals) -> egui::Color32 {
        self.palette.background.gamma_multiply(0.6)
    }

    fn paint_drag_preview(&self, _: &Visuals, painter: &Painter, _: Option<Rect>, preview: Rect) {
        if self.is_at_home(painter) {
            return;
        }
        let fill = self.palette.accent.gamma_multiply(0.2);
        let edge = Stroke::new(space::RING, self.palette.accent);
        painter.rect(preview, 4.0, fill, edge, egui::StrokeKind::Inside);
    }

    fn on_edit(&mut self, action: EditAction) {
        self.dropped |= action == EditAction::TileDropped;
    }
}

/// What stands above a pane that is shown in place of all.
pub(super) type Above = fn(&mut Ui, &Workbench);

/// A pane with its bar. Its handle, which the pointer moves it by where several are shown.
pub(super) fn contents(
    ui: &mut Ui,
    workbench: &Workbench,
    pane: &Pane,
    above: Option<Above>,
) -> Option<Response> {
    let whole = ui.available_rect_before_wrap();
    ui.painter()
        .rect_filled(whole, 0.0, Palette::of(ui).surface);
    let inside = egui::UiBuilder::new().max_rect(whole.shrink(f32::from(space::PLOT)));
    let mut handle = None;
    ui.scope_builder(inside, |ui| match &pane.shows {
        Content::Workspace => {
            let mut first = |ui: &mut Ui| {
                handle = Some(grip(ui, workbench, pane));
            };
            workspace::bar(ui, workbench, above, &mut first);
            workspace::show(ui, workbench);
        }
        Content::Chart(looked_at) => {
            if let Some(above) = above {
                widgets::row(ui, |ui| above(ui, workbench));
            }
            let place = place(workbench, pane.key, looked_at);
            let mut first = |ui: &mut Ui| {
                handle = Some(grip(ui, workbench, pane));
            };
            chart::show(ui, workbench, place, &mut first);
        }
    });
    handle
}

fn place<'a>(workbench: &Workbench, key: Key, pane: &'a ChartPane) -> chart::Place<'a> {
    let mut charts = workbench.view.panes.charts();
    let number = charts.position(|(one, _)| one == key).map_or(1, |k| k + 1);
    let several = workbench.view.panes.charts().count() > 1;
    chart::Place {
        key,
        pane,
        number: several.then_some(number),
    }
}

/// Six dots: what a pane is moved by, and where it says what can be done with it.
fn grip(ui: &mut Ui, workbench: &Workbench, pane: &Pane) -> Response {
    let name = name_of(workbench, pane);
    let says = say!("Arrange {plot}", plot = name);
    let (button, color) = widgets::bare_button(ui, &says, Sense::click_and_drag());
    for (x, y) in [
        (-3.0, -5.0),
        (3.0, -5.0),
        (-3.0, 0.0),
        (3.0, 0.0),
        (-3.0, 5.0),
        (3.0, 5.0),
    ] {
        ui.painter()
            .circle_filled(button.rect.center() + vec2(x, y), 1.5, color);
    }
    menu(ui, workbench, pane, &button);
    button.on_hover_text(say!("Drag to move it; click to split, move or close it"))
}

/// Which pane is shown where there is room for one only.
pub(super) fn switch(ui: &mut Ui, workbench: &Workbench) {
    let panes = &workbench.view.panes;
    let several = panes.charts().count() > 1;
    let mut number = 0;
    let names = panes.panes().into_iter().map(|pane| match pane.shows {
        Content::Workspace => {
            let name = say!("Workspace").to_owned();
            (pane.key, name.clone(), name)
        }
        Content::Chart(_) if !several => {
            let name = say!("Chart").to_owned();
            (pane.key, name.clone(), name)
        }
        Content::Chart(_) => {
            number += 1;
            let long = format!("{number}: {}", name_of(workbench, pane));
            (pane.key, number.to_string(), long)
        }
    });
    let names: Vec<(Key, String, String)> = names.collect();
    let named: Vec<(Key, &str, &str)> = names
        .iter()
        .map(|(key, short, long)| (*key, short.as_str(), long.as_str()))
        .collect();
    if let Some(key) = widgets::segmented_named(ui, &named, panes.active()) {
        workbench.then(move |bench| bench.view.panes.activate(key));
    }
}

/// What a pane is called.
pub(super) fn name_of(workbench: &Workbench, pane: &Pane) -> String {
    match &pane.shows {
        Content::Workspace => say!("Workspace").to_owned(),
        Content::Chart(chart) => workbench.kind(chart).about().name().to_owned(),
    }
}

/// What can be done with a pane: the menu of its handle.
fn menu(ui: &Ui, workbench: &Workbench, pane: &Pane, handle: &Response) {
    let ctx = ui.ctx().clone();
    let now = WindowState {
        ctx: &ctx,
        workbench,
    };
    let key = pane.key;
    Popup::menu(handle).show(|ui| {
        ui.set_min_width(220.0);
        let item = |ui: &mut Ui, name: &str, keys: Option<String>, enabled: bool| {
            let button = Button::new(name).shortcut_text(keys.unwrap_or_default());
            let response = ui.add_enabled(enabled, button);
            response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
            response.clicked()
        };
        if let Content::Chart(chart) = &pane.shows {
            let id = workbench.kind(chart).about().id;
            let plot = Plot::Chart(id);
            for (name, what) in [
                (say!("Save data…"), What::Numbers(id)),
                (say!("Save picture…"), What::Picture(plot)),
            ] {
                if item(ui, name, None, true) {
                    workbench.then(move |bench| bench.view.panes.activate(key));
                    workbench.then(move |bench| bench.choose_where_to_export(what));
                }
            }
            if item(ui, say!("Copy numbers"), None, true) {
                workbench.then(move |bench| bench.view.panes.activate(key));
                workbench.then(move |bench| bench.copy_numbers(id));
            }
            if item(ui, say!("Fit chart to view"), None, true) {
                workbench.then(move |bench| bench.view.panes.fit(key));
            }
            ui.separator();
        }
        let panes = &workbench.view.panes;
        let active = panes.active() == key;
        // The keys are for the active pane.
        let keys = |action: &crate::gui::actions::Action| active.then(|| action.keys(&ctx));
        for (action, edge) in [(CHART_BESIDE, Edge::Right), (CHART_BELOW, Edge::Bottom)] {
            if item(ui, &action.label(now), keys(&action), panes.has_room()) {
                let with = workbench.with_chart(key, edge);
                workbench.then(move |bench| bench.arrange(with));
            }
        }
        if panes.panes().len() > 1 {
            ui.separator();
            for edge in Edge::ALL {
                let name = match edge {
                    Edge::Left => say!("Move to the left"),
                    Edge::Right => say!("Move to the right"),
                    Edge::Top => say!("Move to the top"),
                    Edge::Bottom => say!("Move to the bottom"),
                };
                if item(ui, name, None, true) {
                    workbench.then(move |bench| bench.rearrange(|panes| panes.move_to(key, edge)));
                }
            }
        }
        if pane.shows != Content::Workspace {
            ui.separator();
            if item(ui, &CLOSE_CHART.label(now), keys(&CLOSE_CHART), true) {
                workbench.then(move |bench| bench.rearrange(|panes| panes.close(key)));
            }
        }
    });
}
