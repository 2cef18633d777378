//! The middle: workspace and charts, beside and below each other. They are split, moved by their
//! handles and pulled at the lines between them; where there is no room for all of them one is
//! shown, and a switch between them.

mod chart;

use egui::{
    Button, Id, IdSalt, Painter, Popup, Rect, Response, Stroke, Ui, Vec2, Visuals, WidgetText,
    accesskit, vec2,
};
use egui_tiles::{
    Behavior, Container, EditAction, Linear, LinearDir, ResizeState, Tile, TileId, Tiles,
    UiResponse,
};

use crate::gui::actions::{self, CHART_BELOW, CHART_BESIDE, CLOSE_CHART};
use crate::gui::style::MIDDLE;
use crate::gui::style::{Palette, space};
use crate::gui::view::{ChartPane, Edge, Key, Pane, Plot, What};
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::gui::workspace;

/// Between panes, points.
const GAP: f32 = 4.0;
/// The least width and height of the workspace and of a chart with their bars, points: so much can be
/// read.
const WORKSPACE: Vec2 = vec2(MIDDLE, 336.0);
const CHART: Vec2 = vec2(244.0, 252.0);

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let panes = &workbench.view.panes;
    let room = ui.available_size();
    let least = panes.tree.root.map(|root| least(&panes.tree.tiles, root));
    if least.is_none_or(|least| least.x <= room.x && least.y <= room.y) {
        tree(ui, workbench);
    } else if let Some(active) = panes.pane(panes.active()) {
        contents(ui, workbench, (panes.active(), active), Some(switch));
    }
}

/// The axis along which the parts of a split stand: 0 across, 1 down.
fn axis(linear: &Linear) -> usize {
    usize::from(linear.dir == LinearDir::Vertical)
}

/// The least that a tile needs, points.
fn least(tiles: &Tiles<Pane>, key: Key) -> Vec2 {
    match tiles.get(key) {
        Some(Tile::Pane(Pane::Workspace)) => WORKSPACE,
        Some(Tile::Container(Container::Linear(linear))) => {
            let along = axis(linear);
            let mut all = Vec2::ZERO;
            all[along] -= GAP;
            for child in &linear.children {
                let least = least(tiles, *child);
                all[along] += least[along] + GAP;
                all[1 - along] = all[1 - along].max(least[1 - along]);
            }
            all
        }
        _ => CHART,
    }
}

/// Gives each part of a tile what it needs at least; those pay for it that have more, in proportion.
fn give_the_least(tiles: &mut Tiles<Pane>, key: Key, room: Vec2) {
    let Some(Tile::Container(Container::Linear(linear))) = tiles.get(key) else {
        return;
    };
    let mut linear = linear.clone();
    let along = axis(&linear);
    let whole = room[along] - GAP * (linear.children.len() as f32 - 1.0);
    let sizes = linear.shares.split(&linear.children, whole);
    let needs = linear
        .children
        .iter()
        .map(|child| least(tiles, *child)[along]);
    let needs: Vec<f32> = needs.collect();
    let more = |(size, need): (&f32, &f32)| (size - need).max(0.0);
    let all_more: f32 = sizes.iter().zip(&needs).map(more).sum();
    let spare = whole - needs.iter().sum::<f32>();
    let part = if all_more > 0.0 {
        spare / all_more
    } else {
        0.0
    };
    for (k, child) in linear.children.iter().enumerate() {
        let mut inner = room;
        inner[along] = needs[k] + more((&sizes[k], &needs[k])) * part;
        // One on average: a pane that is dropped beside them gets as much.
        linear
            .shares
            .set_share(*child, inner[along] / whole * needs.len() as f32);
        give_the_least(tiles, *child, inner);
    }
    tiles.insert(key, Tile::Container(Container::Linear(linear)));
}

/// All panes. They are changed in a copy, which is taken where something was dragged.
fn tree(ui: &mut Ui, workbench: &Workbench) {
    let panes = &workbench.view.panes;
    let mut tree = panes.tree.clone();
    if let Some(root) = tree.root {
        give_the_least(&mut tree.tiles, root, ui.available_size());
    }
    let dragged = tree.dragged_id(ui.ctx());
    let mut middle = Middle {
        workbench,
        palette: Palette::of(ui),
        edited: None,
        dragged: dragged.map(|key| (key, Rect::NOTHING)),
    };
    tree.ui(&mut middle, ui);
    if let Some(root) = tree.root
        && lines(ui, workbench, &mut tree.tiles, root, ui.scope_id())
    {
        middle.edited = Some(EditAction::TileResized);
    }
    match middle.edited {
        Some(EditAction::TileDropped) if !middle.is_at_home(ui.painter()) => {
            workbench.then(move |bench| {
                bench.rearrange(|panes| {
                    panes.take(tree);
                    if let Some(key) = dragged {
                        panes.activate(key);
                    }
                });
            });
        }
        Some(EditAction::TileResized) => workbench.then(move |bench| {
            bench.view.panes.take(tree);
            bench.view.panes.pulled = true;
        }),
        // It is kept for tomorrow once it is let go.
        _ if panes.pulled && !ui.input(|input| input.pointer.any_down()) => {
            workbench.then(|bench| bench.rearrange(|panes| panes.pulled = false));
        }
        _ => {}
    }
}

/// Names the lines between the parts of a tile, and of all that is in it, and has them listen to the arrow keys, which
/// `egui_tiles` does not. Whether one was moved.
fn lines(ui: &Ui, workbench: &Workbench, tiles: &mut Tiles<Pane>, key: Key, around: Id) -> bool {
    let Some(Tile::Container(Container::Linear(linear))) = tiles.get(key) else {
        return false;
    };
    let mut linear = linear.clone();
    let along = axis(&linear);
    let id = around.with(key).with(IdSalt::new("child"));
    let mut moved = false;
    for k in 1..linear.children.len() {
        let [before, after] = [k - 1, k].map(|k| linear.children[k]);
        let line = id.with((key, "resize", k - 1));
        let name = first(tiles, before).map(|pane| name_of(workbench, pane));
        let name = name.unwrap_or_default();
        let says = if along == 0 {
            say!("width of {name}", name)
        } else {
            say!("height of {name}", name)
        };
        ui.ctx().accesskit_node_builder(line, |node| {
            node.set_role(accesskit::Role::Slider);
            node.set_label(says);
        });
        let by = widgets::moved_by_keys(ui, line, along == 0);
        let both = [before, after].map(|key| tiles.rect(key).map_or(0.0, |r| r.size()[along]));
        if by != 0.0 && both[0] + both[1] > 0.0 {
            let shares = &mut linear.shares;
            let by = by * (shares[before] + shares[after]) / (both[0] + both[1]);
            shares[before] += by;
            shares[after] -= by;
            moved = true;
        }
    }
    let children = linear.children.clone();
    if moved {
        tiles.insert(key, Tile::Container(Container::Linear(linear)));
    }
    for child in children {
        moved |= lines(ui, workbench, tiles, child, id);
    }
    moved
}

/// The first pane in a tile.
fn first(tiles: &Tiles<Pane>, key: Key) -> Option<&Pane> {
    match tiles.get(key)? {
        Tile::Pane(pane) => Some(pane),
        Tile::Container(container) => first(tiles, *container.children().next()?),
    }
}

/// How tiles are shown.
struct Middle<'a> {
    workbench: &'a Workbench,
    palette: Palette,
    /// What was done to them.
    edited: Option<EditAction>,
    /// The one that is dragged, and where it stands.
    dragged: Option<(Key, Rect)>,
}

impl Middle<'_> {
    /// Whether what is dragged is still over its own place.
    fn is_at_home(&self, painter: &Painter) -> bool {
        let pointer = painter.ctx().pointer_latest_pos();
        self.dragged
            .is_some_and(|(_, home)| pointer.is_none_or(|at| home.contains(at)))
    }
}

impl Behavior<Pane> for Middle<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, key: TileId, pane: &mut Pane) -> UiResponse {
        let rect = ui.max_rect();
        if let Some((dragged, home)) = &mut self.dragged
            && *dragged == key
        {
            *home = rect;
        }
        ui.shrink_clip_rect(rect);
        let handle = contents(ui, self.workbench, (key, pane), None);
        let panes = &self.workbench.view.panes;
        let pressed = ui.input(|input| input.pointer.any_pressed());
        let active = panes.active() == key;
        if pressed && !active && ui.rect_contains_pointer(rect) {
            self.workbench
                .then(move |bench| bench.view.panes.activate(key));
        }
        if active && panes.panes().len() > 2 {
            let line = Stroke::new(space::RING, self.palette.accent);
            ui.painter().hline(rect.x_range(), rect.top() + 1.0, line);
        }
        if handle.is_some_and(|handle| handle.drag_started()) {
            UiResponse::DragStarted
        } else {
            UiResponse::None
        }
    }

    fn tab_title_for_pane(&mut self, pane: &Pane) -> WidgetText {
        name_of(self.workbench, pane).into()
    }

    /// There are no tabs, and with a bar as high as this no place to drop one is the nearest.
    fn tab_bar_height(&self, _: &egui::Style) -> f32 {
        1e6
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        GAP
    }

    fn min_size(&self) -> f32 {
        CHART.x
    }

    fn resize_stroke(&self, _: &egui::Style, state: ResizeState) -> Stroke {
        match state {
            ResizeState::Idle => Stroke::NONE,
            ResizeState::Hovering | ResizeState::Dragging => {
                Stroke::new(space::RING, self.palette.accent)
            }
        }
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
        self.edited = Some(action);
    }
}

/// What stands above a pane that is shown in place of all.
pub(super) type Above = fn(&mut Ui, &Workbench);

/// A pane with its bar. Its handle, which the pointer moves it by where several are shown.
pub(super) fn contents(
    ui: &mut Ui,
    workbench: &Workbench,
    (key, pane): (Key, &Pane),
    above: Option<Above>,
) -> Option<Response> {
    let whole = ui.available_rect_before_wrap();
    ui.painter()
        .rect_filled(whole, 0.0, Palette::of(ui).surface);
    let inside = egui::UiBuilder::new().max_rect(whole.shrink(f32::from(space::PLOT)));
    let mut handle = None;
    ui.scope_builder(inside, |ui| match pane {
        Pane::Workspace => {
            let mut first = |ui: &mut Ui| {
                handle = Some(grip(ui, workbench, (key, pane)));
            };
            workspace::bar(ui, workbench, above, &mut first);
            workspace::show(ui, workbench);
        }
        Pane::Chart(looked_at) => {
            if let Some(above) = above {
                widgets::row(ui, |ui| above(ui, workbench));
            }
            let place = place(workbench, key, looked_at);
            let mut first = |ui: &mut Ui| {
                handle = Some(grip(ui, workbench, (key, pane)));
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

/// What a pane is moved by, and where it says what can be done with it.
fn grip(ui: &mut Ui, workbench: &Workbench, (key, pane): (Key, &Pane)) -> Response {
    let name = name_of(workbench, pane);
    let says = say!("Arrange {plot}", plot = name);
    let button = widgets::icon_button(ui, widgets::GRIP, &says);
    menu(workbench, (key, pane), &button);
    button.on_hover_text(say!("Drag to move it; click to split, move or close it"))
}

/// Which pane is shown where there is room for one only.
pub(super) fn switch(ui: &mut Ui, workbench: &Workbench) {
    let panes = &workbench.view.panes;
    let several = panes.charts().count() > 1;
    let mut number = 0;
    let names = panes.panes().into_iter().map(|(key, pane)| match pane {
        Pane::Workspace => {
            let name = say!("Workspace").to_owned();
            (key, name.clone(), name)
        }
        Pane::Chart(_) if !several => {
            let name = say!("Chart").to_owned();
            (key, name.clone(), name)
        }
        Pane::Chart(_) => {
            number += 1;
            let long = format!("{number}: {}", name_of(workbench, pane));
            (key, number.to_string(), long)
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
    match pane {
        Pane::Workspace => say!("Workspace").to_owned(),
        Pane::Chart(chart) => workbench.kind(chart).about().name().to_owned(),
    }
}

/// What can be done with a pane: the menu of its handle.
fn menu(workbench: &Workbench, (key, pane): (Key, &Pane), handle: &Response) {
    Popup::menu(handle).show(|ui| {
        ui.set_min_width(220.0);
        let item = |ui: &mut Ui, name: &str, keys: Option<String>, enabled: bool| {
            let button = Button::new(name).shortcut_text(keys.unwrap_or_default());
            actions::item(ui, button, name, enabled).clicked()
        };
        if let Pane::Chart(chart) = pane {
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
        let keys = |action: &actions::Action| active.then(|| action.keys(&handle.ctx));
        for (action, edge) in [(CHART_BESIDE, Edge::Right), (CHART_BELOW, Edge::Bottom)] {
            if item(
                ui,
                &action.label(workbench),
                keys(&action),
                panes.has_room(),
            ) {
                workbench.then(move |bench| bench.add_chart(key, edge));
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
        if *pane != Pane::Workspace {
            ui.separator();
            if item(ui, &CLOSE_CHART.label(workbench), keys(&CLOSE_CHART), true) {
                workbench.then(move |bench| bench.rearrange(|panes| panes.close(key)));
            }
        }
    });
}
