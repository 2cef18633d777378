//! What stands in the middle of the window: the workspace and charts, as tiles beside and below each other.
//!
//! The tiles are kept beside the preferences, so what is read is looked through before it is shown: one workspace, not
//! too many charts, each tile in one place.

use egui::Id;
use egui_tiles::{Container, Linear, LinearDir, SimplificationOptions, Tile, TileId, Tiles, Tree};
use serde::{Deserialize, Serialize};

use crate::gui::core::loaded_session::Component;

/// Charts at once, at most.
const MOST_CHARTS: usize = 6;

/// The workspace's share of what it shares with the first chart.
const WORKSPACE: f32 = 0.66;

/// A pane by its tile, which it keeps while it is moved.
pub(crate) type Key = TileId;

/// What stands in a pane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Pane {
    Workspace,
    Chart(ChartPane),
}

/// How a chart is looked at.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, rename_all = "kebab-case")]
pub(crate) struct ChartPane {
    /// The chart by its name; `None`: what suits the step.
    pub(crate) chart: Option<String>,
    /// `None`: that of the view.
    pub(crate) component: Option<Component>,
    /// The joint that it is about, counted from 0; `None`: that of the view.
    pub(crate) joint: Option<usize>,
    /// Counts up when it is to show everything.
    #[serde(skip)]
    pub(crate) fitted: u64,
}

/// An edge of a pane, or of the whole middle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Edge {
    Left,
    Right,
    Top,
    Bottom,
}

impl Edge {
    pub(crate) const ALL: [Self; 4] = [Self::Left, Self::Right, Self::Top, Self::Bottom];

    fn direction(self) -> LinearDir {
        match self {
            Self::Left | Self::Right => LinearDir::Horizontal,
            Self::Top | Self::Bottom => LinearDir::Vertical,
        }
    }
}

/// All panes, and which of them the keys are for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Panes {
    pub(crate) tree: Tree<Pane>,
    /// The pane that keys are for; without one it is the workspace.
    #[serde(skip)]
    active: Option<Key>,
    /// The chart that was active last.
    #[serde(skip)]
    chart: Option<Key>,
    /// Whether a line between them is being pulled.
    #[serde(skip)]
    pub(crate) pulled: bool,
}

impl Default for Panes {
    /// The workspace, and below it the chart that suits the step.
    fn default() -> Self {
        let mut tiles = Tiles::default();
        let workspace = tiles.insert_pane(Pane::Workspace);
        let chart = tiles.insert_pane(Pane::Chart(ChartPane::default()));
        let both = Linear::new_binary(LinearDir::Vertical, [workspace, chart], WORKSPACE);
        let root = tiles.insert_container(both);
        Self {
            tree: Tree::new(Id::unique("panes"), root, tiles),
            active: None,
            chart: None,
            pulled: false,
        }
    }
}

impl Panes {
    /// As they were kept, with those charts only that are `known`; the usual ones where they cannot be shown.
    pub(crate) fn sound(mut self, known: impl Fn(&str) -> bool) -> Self {
        if !self.can_be_shown() {
            return Self::default();
        }
        self.tree.tiles.recompute_next_tile_id();
        let is_gone = |chart: &ChartPane| !chart.chart.as_deref().is_none_or(&known);
        let gone = self.charts().filter(|(_, chart)| is_gone(chart));
        for key in gone.map(|(key, _)| key).collect::<Vec<_>>() {
            self.close(key);
        }
        self
    }

    /// Whether there is one workspace, not too many charts, and each tile in one place.
    fn can_be_shown(&self) -> bool {
        let tiles = &self.tree.tiles;
        let mut seen: Vec<Key> = self.tree.root.into_iter().collect();
        let mut is_new = |key: Key| {
            let new = !seen.contains(&key);
            seen.push(key);
            new
        };
        let each_once = tiles.iter().all(|(key, tile)| match tile {
            Tile::Pane(_) => key.0 < 1 << 32,
            Tile::Container(Container::Linear(linear)) => {
                let mut shares = linear.shares.iter();
                key.0 < 1 << 32
                    && shares.all(|(_, share)| (1e-3..1e3).contains(share))
                    && linear.children.iter().all(|child| is_new(*child))
            }
            Tile::Container(Container::Tabs(_) | Container::Grid(_)) => false,
        });
        each_once && {
            let all = self.panes();
            let charts = self.charts().count();
            all.len() == charts + 1 && charts <= MOST_CHARTS
        }
    }

    /// All panes, from the left to the right and down.
    pub(crate) fn panes(&self) -> Vec<(Key, &Pane)> {
        let mut all = Vec::new();
        let mut open: Vec<Key> = self.tree.root.into_iter().collect();
        while let Some(key) = open.pop() {
            match self.tree.tiles.get(key) {
                Some(Tile::Pane(pane)) => all.push((key, pane)),
                Some(Tile::Container(split)) => open.extend(split.children_vec().iter().rev()),
                None => {}
            }
        }
        all
    }

    /// All charts.
    pub(crate) fn charts(&self) -> impl Iterator<Item = (Key, &ChartPane)> {
        self.panes()
            .into_iter()
            .filter_map(|(key, pane)| match pane {
                Pane::Chart(chart) => Some((key, chart)),
                Pane::Workspace => None,
            })
    }

    pub(crate) fn pane(&self, key: Key) -> Option<&Pane> {
        self.tree.tiles.get_pane(&key)
    }

    /// The chart in a pane, to be changed.
    pub(crate) fn chart_mut(&mut self, key: Key) -> Option<&mut ChartPane> {
        match self.tree.tiles.get_mut(key)? {
            Tile::Pane(Pane::Chart(chart)) => Some(chart),
            Tile::Pane(Pane::Workspace) | Tile::Container(_) => None,
        }
    }

    /// The chart in a pane shows everything again.
    pub(crate) fn fit(&mut self, key: Key) {
        if let Some(pane) = self.chart_mut(key) {
            pane.fitted += 1;
        }
    }

    pub(crate) fn workspace(&self) -> Key {
        let all = self.panes();
        let workspace = all.iter().find(|(_, pane)| **pane == Pane::Workspace);
        workspace.map_or(TileId::from_u64(0), |(key, _)| *key)
    }

    /// The pane that keys are for.
    pub(crate) fn active(&self) -> Key {
        let active = self.active.filter(|key| self.pane(*key).is_some());
        active.unwrap_or_else(|| self.workspace())
    }

    /// The chart that is active, or was so last.
    pub(crate) fn active_chart(&self) -> Option<(Key, &ChartPane)> {
        let last = self.charts().find(|(key, _)| Some(*key) == self.chart);
        last.or_else(|| self.charts().next())
    }

    pub(crate) fn activate(&mut self, key: Key) {
        match self.pane(key) {
            Some(Pane::Workspace) => self.active = Some(key),
            Some(Pane::Chart(_)) => (self.active, self.chart) = (Some(key), Some(key)),
            None => {}
        }
    }

    /// The next pane becomes the active one.
    pub(crate) fn activate_next(&mut self) {
        let keys: Vec<Key> = self.panes().iter().map(|(key, _)| *key).collect();
        let here = keys.iter().position(|key| *key == self.active());
        let next = here.map_or(0, |here| (here + 1) % keys.len());
        self.activate(keys[next]);
    }

    /// Whether there is room for another chart.
    pub(crate) fn has_room(&self) -> bool {
        self.charts().count() < MOST_CHARTS
    }

    /// Puts a chart at an edge of a pane, in half of its room.
    pub(crate) fn split(&mut self, key: Key, edge: Edge, chart: ChartPane) {
        if !self.has_room() || self.pane(key).is_none() {
            return;
        }
        let new = self.tree.tiles.insert_pane(Pane::Chart(chart));
        self.put(new, 0.5, key, edge);
        self.activate(new);
    }

    /// Takes a chart away; its neighbours take its room.
    pub(crate) fn close(&mut self, key: Key) {
        let keys: Vec<Key> = self.charts().map(|(key, _)| key).collect();
        let Some(here) = keys.iter().position(|chart| *chart == key) else {
            return;
        };
        let next = keys.get(here + 1).or(keys[..here].last());
        self.tree.remove_recursively(key);
        self.simplify();
        self.activate(next.copied().unwrap_or_else(|| self.workspace()));
    }

    /// Puts a pane at an edge of the whole middle.
    pub(crate) fn move_to(&mut self, key: Key, edge: Edge) {
        let parent = self.tree.tiles.parent_of(key);
        let Some(split) = parent.and_then(|parent| self.container(parent)) else {
            return;
        };
        split.remove_child(key);
        self.simplify();
        let share = match self.pane(key) {
            Some(Pane::Workspace) => WORKSPACE,
            _ => 1.0 - WORKSPACE,
        };
        if let Some(root) = self.tree.root {
            self.put(key, share, root, edge);
        }
        self.activate(key);
    }

    /// Puts a tile at an edge of another, with this share of what that has.
    fn put(&mut self, new: Key, share: f32, at: Key, edge: Edge) {
        let parent = self.tree.tiles.parent_of(at);
        let (children, first) = match edge {
            Edge::Left | Edge::Top => ([new, at], share),
            Edge::Right | Edge::Bottom => ([at, new], 1.0 - share),
        };
        let both = Linear::new_binary(edge.direction(), children, first);
        let both = self.tree.tiles.insert_container(both);
        if let Some(split) = parent.and_then(|parent| self.container(parent)) {
            let _ = split.replace_child(at, both);
        } else {
            self.tree.root = Some(both);
        }
        self.simplify();
    }

    fn container(&mut self, key: Key) -> Option<&mut Container> {
        match self.tree.tiles.get_mut(key)? {
            Tile::Container(container) => Some(container),
            Tile::Pane(_) => None,
        }
    }

    /// Nothing is alone in a split, and no split stands within one of its own direction.
    fn simplify(&mut self) {
        self.tree.simplify(&SimplificationOptions::default());
    }

    /// Takes tiles that were dragged.
    pub(crate) fn take(&mut self, tree: Tree<Pane>) {
        let next = Self { tree, ..*self };
        if next.can_be_shown() {
            *self = next;
        }
    }

    /// Whether the panes are as they are by default.
    pub(crate) fn are_usual(&self) -> bool {
        self.outline() == Self::default().outline()
    }

    /// Panes, splits and shares in words, whatever their tiles are called: `(workspace 0.66 chart 0.34)` where one
    /// stands below the other, with square brackets side by side.
    pub(crate) fn outline(&self) -> String {
        self.tree
            .root
            .map_or(String::new(), |root| self.outline_of(root))
    }

    fn outline_of(&self, key: Key) -> String {
        match self.tree.tiles.get(key) {
            Some(Tile::Pane(Pane::Workspace)) => "workspace".to_owned(),
            Some(Tile::Pane(Pane::Chart(chart))) if *chart == ChartPane::default() => {
                "chart".to_owned()
            }
            Some(Tile::Pane(Pane::Chart(chart))) => chart.chart.clone().unwrap_or_default(),
            Some(Tile::Container(Container::Linear(linear))) => {
                let shares = linear.shares.split(&linear.children, 1.0);
                let parts = linear.children.iter().zip(shares);
                let parts =
                    parts.map(|(child, share)| format!("{} {share:.2}", self.outline_of(*child)));
                let parts = parts.collect::<Vec<_>>().join(" ");
                match linear.dir {
                    LinearDir::Horizontal => format!("[{parts}]"),
                    LinearDir::Vertical => format!("({parts})"),
                }
            }
            _ => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(panes: &Panes) -> Vec<Key> {
        panes.panes().iter().map(|(key, _)| *key).collect()
    }

    fn share(panes: &Panes, k: usize) -> f32 {
        let root = panes.tree.root.and_then(|root| panes.tree.tiles.get(root));
        let Some(Tile::Container(Container::Linear(linear))) = root else {
            panic!("a split");
        };
        linear.shares.split(&linear.children, 1.0)[k]
    }

    /// A chart that is known by its name.
    fn chart(name: &str) -> ChartPane {
        ChartPane {
            chart: Some(name.to_owned()),
            ..ChartPane::default()
        }
    }

    #[test]
    fn a_chart_is_split_off_beside_and_below_and_closed_again() {
        let mut panes = Panes::default();
        assert_eq!(panes.outline(), "(workspace 0.66 chart 0.34)");
        let [workspace, first] = keys(&panes)[..] else {
            panic!("two");
        };
        panes.split(first, Edge::Right, chart("b"));
        assert_eq!(panes.outline(), "(workspace 0.66 [chart 0.50 b 0.50] 0.34)");
        let b = panes.active();
        assert_eq!(panes.pane(b), Some(&Pane::Chart(chart("b"))));
        panes.split(b, Edge::Right, chart("c"));
        let beside = "[chart 0.50 b 0.25 c 0.25]";
        assert_eq!(panes.outline(), format!("(workspace 0.66 {beside} 0.34)"));
        panes.split(workspace, Edge::Left, chart("d"));
        let above = "[d 0.50 workspace 0.50]";
        assert_eq!(panes.outline(), format!("({above} 0.66 {beside} 0.34)"));
        for (key, _) in panes.clone().charts() {
            panes.close(key);
            assert_eq!(panes.clone().sound(|_| true), panes);
        }
        assert_eq!(panes.outline(), "workspace");
        assert_eq!(panes.active(), workspace);
        assert!(panes.active_chart().is_none());
        panes.close(workspace);
        assert_eq!(panes.outline(), "workspace", "the workspace stays");
        panes.split(workspace, Edge::Bottom, ChartPane::default());
        assert_eq!(panes.outline(), "(workspace 0.50 chart 0.50)");
    }

    #[test]
    fn shares_are_kept_where_a_pane_is_split_and_given_to_the_neighbours_where_it_is_closed() {
        let mut panes = Panes::default();
        let first = keys(&panes)[1];
        panes.split(first, Edge::Right, ChartPane::default());
        assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
        panes.close(panes.active());
        assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
        // Stacked, the new one has half of what it is split from.
        panes.split(first, Edge::Bottom, ChartPane::default());
        assert_eq!(keys(&panes).len(), 3);
        assert!((share(&panes, 1) - share(&panes, 2)).abs() < 1e-6);
        assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
    }

    #[test]
    fn a_pane_is_moved_to_any_edge_of_the_middle() {
        for (edge, outline) in [
            (Edge::Left, "[chart 0.34 workspace 0.66]"),
            (Edge::Right, "[workspace 0.66 chart 0.34]"),
            (Edge::Top, "(chart 0.34 workspace 0.66)"),
            (Edge::Bottom, "(workspace 0.66 chart 0.34)"),
        ] {
            let mut panes = Panes::default();
            panes.move_to(keys(&panes)[1], edge);
            assert_eq!(panes.outline(), outline);
            panes.move_to(TileId::from_u64(99), edge);
            assert_eq!(panes.outline(), outline);
        }
        let mut alone = Panes::default();
        alone.close(keys(&alone)[1]);
        alone.move_to(alone.workspace(), Edge::Left);
        assert_eq!(alone.outline(), "workspace");
    }

    #[test]
    fn there_are_never_too_many_charts_and_always_one_workspace() {
        let mut panes = Panes::default();
        for _ in 0..20 {
            panes.split(panes.active(), Edge::Left, ChartPane::default());
        }
        assert_eq!(panes.charts().count(), MOST_CHARTS);
        assert!(!panes.has_room());
        let of = |all: &[Pane]| {
            let mut panes = Panes::default();
            let mut tiles = Tiles::default();
            let children = all
                .iter()
                .map(|pane| tiles.insert_pane(pane.clone()))
                .collect();
            let root = tiles.insert_horizontal_tile(children);
            panes.tree = Tree::new(Id::unique("panes"), root, tiles);
            panes.sound(|name| name != "gone")
        };
        let shows = |name: &str| Pane::Chart(chart(name));
        let usual = Panes::default().outline();
        assert_eq!(of(&[]).outline(), usual);
        assert_eq!(of(&[shows("x")]).outline(), usual, "no workspace");
        let two = of(&[Pane::Workspace, shows("x"), shows("gone")]);
        assert_eq!(two.outline(), "[workspace 0.50 x 0.50]");
        let workspaces = [Pane::Workspace, Pane::Workspace];
        assert_eq!(of(&workspaces).outline(), usual);
        let mut many = vec![Pane::Workspace];
        many.extend((0..7).map(|_| shows("x")));
        assert_eq!(of(&many).outline(), usual);
        // A split that is a part of itself.
        let mut round = Panes::default();
        let root = round.tree.root.expect("a split");
        round.container(root).expect("a split").add_child(root);
        assert_eq!(round.sound(|_| true).outline(), usual);
    }

    #[test]
    fn what_is_kept_comes_back() {
        let mut panes = Panes::default();
        panes.split(panes.workspace(), Edge::Right, ChartPane::default());
        panes.split(panes.active(), Edge::Bottom, ChartPane::default());
        if let Some(chart) = panes.chart_mut(panes.active()) {
            chart.chart = Some("histogram".to_owned());
            chart.component = Some(Component::Radial);
            chart.joint = Some(2);
        }
        let text = serde_json::to_string(&panes).expect("it can be written");
        let read: Panes = serde_json::from_str(&text).expect("it can be read");
        let mut read = read.sound(|_| true);
        assert_eq!(read.tree, panes.tree);
        assert!(!read.are_usual() && Panes::default().are_usual());
        read.split(read.workspace(), Edge::Left, ChartPane::default());
        assert_eq!(read.charts().count(), 4, "new tiles are others");
    }

    #[test]
    fn the_next_plot_is_the_next_in_sight_and_after_the_last_the_first() {
        let mut panes = Panes::default();
        panes.split(panes.workspace(), Edge::Right, ChartPane::default());
        let order = keys(&panes);
        panes.activate(order[0]);
        for key in order.iter().cycle().skip(1).take(7) {
            panes.activate_next();
            assert_eq!(panes.active(), *key);
        }
    }
}
