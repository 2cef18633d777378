//! What stands in the middle of the window: the workspace and charts, beside and below each other.
//!
//! The tree of panes is a document of its own beside the preferences, so whatever is read is brought into a form that
//! can be shown: one workspace, not too many charts, shares that are numbers.

use serde::{Deserialize, Serialize};

use crate::gui::core::loaded_session::Component;
use crate::gui::core::quantity::Quantity;

/// Charts at once, at most.
const MOST_CHARTS: usize = 6;

/// The workspace's share of what it shares with the first chart.
const WORKSPACE: f32 = 0.66;

/// All panes, and which of them the keys are for.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Panes {
    pub(crate) root: Tile,
    #[serde(skip)]
    active: Key,
    /// The chart that was active last.
    #[serde(skip)]
    chart: Key,
}

impl Default for Panes {
    /// The workspace, and below it the chart that suits the step.
    fn default() -> Self {
        let part = |share, shows| SplitShare {
            share,
            tile: Tile::Pane(Pane { key: 0, shows }),
        };
        let chart = Content::Chart(ChartPane::default());
        let parts = vec![
            part(WORKSPACE, Content::Workspace),
            part(1.0 - WORKSPACE, chart),
        ];
        Self::of(Tile::Below(parts))
    }
}

impl Panes {
    /// These tiles, brought into a form that can be shown.
    pub(crate) fn of(root: Tile) -> Self {
        let panes = Self {
            root,
            active: 0,
            chart: 0,
        };
        panes.sound(|_| true)
    }

    /// Brought into a form that can be shown; of charts only those that are `known`.
    pub(crate) fn sound(self, known: impl Fn(&str) -> bool) -> Self {
        let (mut workspaces, mut charts, mut keys) = (0, 0, Vec::new());
        let mut next = self.panes().iter().map(|pane| pane.key).max().unwrap_or(0);
        let root = self.root.map(DEEPEST, &mut |mut pane| {
            let fits = match &pane.shows {
                Content::Workspace => {
                    workspaces += 1;
                    workspaces == 1
                }
                Content::Chart(chart) => {
                    let known = chart.chart.as_deref().is_none_or(&known);
                    charts += usize::from(known);
                    known && charts <= MOST_CHARTS
                }
            };
            if pane.key == 0 || keys.contains(&pane.key) {
                next += 1;
                pane.key = next;
            }
            keys.push(pane.key);
            fits.then_some(Tile::Pane(pane))
        });
        let Some(root) = root.filter(|_| workspaces > 0) else {
            return Self::default();
        };
        let mut panes = Self { root, ..self };
        let there = |key: Key| panes.panes().iter().any(|pane| pane.key == key);
        let workspace = |pane: &&&Pane| pane.shows == Content::Workspace;
        if !there(panes.active) {
            let all = panes.panes();
            panes.active = all.iter().find(workspace).map_or(0, |pane| pane.key);
        }
        if panes.active_chart().is_none() {
            let first = panes.charts().next();
            panes.chart = first.map_or(0, |(key, _)| key);
        }
        panes
    }

    /// All panes, from the left to the right and down.
    pub(crate) fn panes(&self) -> Vec<&Pane> {
        let mut all = Vec::new();
        self.root.gather(&mut all);
        all
    }

    /// All charts.
    pub(crate) fn charts(&self) -> impl Iterator<Item = (Key, &ChartPane)> {
        self.panes()
            .into_iter()
            .filter_map(|pane| match &pane.shows {
                Content::Chart(chart) => Some((pane.key, chart)),
                Content::Workspace => None,
            })
    }

    /// The pane of this number.
    pub(crate) fn pane(&self, key: Key) -> Option<&Pane> {
        self.panes().into_iter().find(|pane| pane.key == key)
    }

    /// The chart in a pane, to be changed.
    pub(crate) fn chart_mut(&mut self, key: Key) -> Option<&mut ChartPane> {
        match &mut self.root.find(key)?.shows {
            Content::Chart(chart) => Some(chart),
            Content::Workspace => None,
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
        let workspace = all.iter().find(|pane| pane.shows == Content::Workspace);
        workspace.map_or(0, |pane| pane.key)
    }

    /// The pane that keys are for.
    pub(crate) fn active(&self) -> Key {
        self.active
    }

    /// The chart that is active, or was so last.
    pub(crate) fn active_chart(&self) -> Option<(Key, &ChartPane)> {
        self.charts().find(|(key, _)| *key == self.chart)
    }

    pub(crate) fn activate(&mut self, key: Key) {
        match self.pane(key).map(|pane| &pane.shows) {
            Some(Content::Workspace) => self.active = key,
            Some(Content::Chart(_)) => (self.active, self.chart) = (key, key),
            None => {}
        }
    }

    /// The next pane becomes the active one.
    pub(crate) fn activate_next(&mut self) {
        let keys: Vec<Key> = self.panes().iter().map(|pane| pane.key).collect();
        let here = keys.iter().position(|key| *key == self.active);
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
        let shows = Content::Chart(chart);
        let new = self.panes().iter().map(|pane| pane.key).max().unwrap_or(0) + 1;
        let mut added = Some(Pane { key: new, shows });
        let root = self.root.clone().map(DEEPEST, &mut |pane| {
            let here = if pane.key == key { added.take() } else { None };
            let pane = Tile::Pane(pane);
            Some(match here {
                None => pane,
                Some(new) => at_edge(pane, 0.5, Tile::Pane(new), edge),
            })
        });
        self.take(root);
        self.activate(new);
    }

    /// Takes a chart away; its neighbours take its room.
    pub(crate) fn close(&mut self, key: Key) {
        let all = self.panes();
        let here = all.iter().position(|pane| pane.key == key);
        let charts = |pane: &&&Pane| pane.shows != Content::Workspace && pane.key != key;
        let after = all.iter().skip(here.unwrap_or(0)).find(charts);
        let next = after.or_else(|| all.iter().rev().find(charts));
        let next = next.map_or(self.workspace(), |pane| pane.key);
        if key == self.workspace() || here.is_none() {
            return;
        }
        let root = self.root.clone().map(DEEPEST, &mut |pane| {
            (pane.key != key).then_some(Tile::Pane(pane))
        });
        self.take(root);
        self.activate(next);
    }

    /// Puts a pane at an edge of the whole middle.
    pub(crate) fn move_to(&mut self, key: Key, edge: Edge) {
        let mut moved = None;
        let rest = self.root.clone().map(DEEPEST, &mut |pane| {
            if pane.key == key {
                moved = Some(pane);
                return None;
            }
            Some(Tile::Pane(pane))
        });
        let (Some(moved), Some(rest)) = (moved, rest) else {
            return;
        };
        let share = if moved.shows == Content::Workspace {
            WORKSPACE
        } else {
            1.0 - WORKSPACE
        };
        self.take(Some(at_edge(rest, share, Tile::Pane(moved), edge)));
        self.activate(key);
    }

    /// The same panes, arranged like this.
    pub(crate) fn arranged(&self, root: Tile) -> Self {
        Self {
            root,
            ..self.clone()
        }
        .sound(|_| true)
    }

    fn take(&mut self, root: Option<Tile>) {
        if let Some(root) = root {
            *self = self.arranged(root);
        }
    }

    /// Whether the panes are as they are by default.
    pub(crate) fn are_usual(&self) -> bool {
        // As they are kept: without numbers.
        let kept = |panes: &Self| serde_json::to_value(panes).ok();
        kept(self) == kept(&Self::default())
    }

    /// Whether both have the same panes in the same arrangement, whatever their shares.
    pub(crate) fn outline(&self) -> String {
        fn of(tile: &Tile, text: &mut String) {
            match tile {
                Tile::Pane(pane) => *text += &format!("{} ", pane.key),
                Tile::Beside(parts) | Tile::Below(parts) => {
                    let beside = matches!(tile, Tile::Beside(_));
                    text.push(if beside { '[' } else { '(' });
                    for part in parts {
                        of(&part.tile, text);
                    }
                    text.push(')');
                }
            }
        }
        let mut text = String::new();
        of(&self.root, &mut text);
        text
    }
}

/// Splits within splits, at most.
pub(super) const DEEPEST: usize = 8;

/// A pane by its number: it keeps it while it is moved.
pub(crate) type Key = u32;

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
    /// What a scatter has across and upwards; `None`: as it begins.
    pub(crate) axes: Option<[Quantity; 2]>,
    /// Counts up when it is to show everything.
    #[serde(skip)]
    pub(crate) fitted: u64,
}

/// What stands in a pane.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Content {
    Workspace,
    Chart(ChartPane),
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pane {
    #[serde(skip)]
    pub(crate) key: Key,
    pub(crate) shows: Content,
}

/// A part of a split, and how much of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SplitShare {
    pub(crate) share: f32,
    pub(crate) tile: Tile,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Tile {
    Pane(Pane),
    /// Side by side.
    Beside(Vec<SplitShare>),
    /// One below the other.
    Below(Vec<SplitShare>),
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

    fn is_sideways(self) -> bool {
        matches!(self, Self::Left | Self::Right)
    }
}

impl Tile {
    /// Of a split: whether its parts stand side by side, and which they are.
    pub(crate) fn parts(&self) -> Option<(bool, &[SplitShare])> {
        match self {
            Self::Pane(_) => None,
            Self::Beside(parts) => Some((true, parts)),
            Self::Below(parts) => Some((false, parts)),
        }
    }

    pub(super) fn split(side_by_side: bool, parts: Vec<SplitShare>) -> Self {
        if side_by_side {
            Self::Beside(parts)
        } else {
            Self::Below(parts)
        }
    }

    /// Whether its parts stand side by side, and which they are.
    fn into_parts(self) -> Result<(bool, Vec<SplitShare>), Self> {
        match self {
            Self::Beside(parts) => Ok((true, parts)),
            Self::Below(parts) => Ok((false, parts)),
            pane @ Self::Pane(_) => Err(pane),
        }
    }

    pub(super) fn gather<'a>(&'a self, all: &mut Vec<&'a Pane>) {
        match self {
            Self::Pane(pane) => all.push(pane),
            Self::Beside(parts) | Self::Below(parts) => {
                for part in parts {
                    part.tile.gather(all);
                }
            }
        }
    }

    pub(super) fn find(&mut self, key: Key) -> Option<&mut Pane> {
        match self {
            Self::Pane(pane) => (pane.key == key).then_some(pane),
            Self::Beside(parts) | Self::Below(parts) => {
                parts.iter_mut().find_map(|part| part.tile.find(key))
            }
        }
    }

    /// The same with every pane exchanged for what `of` makes of it, nothing that is empty or alone in
    /// a split, and no split within one of its own direction.
    pub(super) fn map(
        self,
        depth: usize,
        of: &mut impl FnMut(Pane) -> Option<Self>,
    ) -> Option<Self> {
        let (side_by_side, parts) = match self.into_parts() {
            Err(Self::Pane(pane)) => return of(pane),
            Err(_) => return None,
            Ok(split) => split,
        };
        if depth == 0 {
            return None;
        }
        let mut kept: Vec<SplitShare> = Vec::new();
        for SplitShare { share, tile } in parts {
            let Some(tile) = tile.map(depth - 1, of) else {
                continue;
            };
            let share = if share.is_finite() && share > 0.0 {
                share.clamp(1e-3, 1e6)
            } else {
                1.0
            };
            match tile.into_parts() {
                Ok((same, inner)) if same == side_by_side => {
                    let all: f32 = inner.iter().map(|part| part.share).sum();
                    kept.extend(inner.into_iter().map(|part| SplitShare {
                        share: share * part.share / all,
                        ..part
                    }));
                }
                Ok((other, inner)) => kept.push(SplitShare {
                    share,
                    tile: Self::split(other, inner),
                }),
                Err(tile) => kept.push(SplitShare { share, tile }),
            }
        }
        if kept.len() < 2 {
            return kept.pop().map(|part| part.tile);
        }
        let all: f32 = kept.iter().map(|part| part.share).sum();
        for part in &mut kept {
            part.share /= all;
        }
        Some(Self::split(side_by_side, kept))
    }
}

/// A tile at an edge of another, with its share of both.
pub(super) fn at_edge(tile: Tile, share: f32, new: Tile, edge: Edge) -> Tile {
    let part = |share, tile| SplitShare { share, tile };
    let mut parts = vec![part(1.0 - share, tile), part(share, new)];
    if matches!(edge, Edge::Left | Edge::Top) {
        parts.reverse();
    }
    Tile::split(edge.is_sideways(), parts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::core::loaded_session::Component;
    use crate::gui::core::quantity::Quantity;

    fn keys(panes: &Panes) -> Vec<Key> {
        panes.panes().iter().map(|pane| pane.key).collect()
    }

    #[test]
    fn a_chart_is_split_off_beside_and_below_and_closed_again() {
        let mut panes = Panes::default();
        assert_eq!(panes.outline(), "(1 2 )");
        panes.split(2, Edge::Right, ChartPane::default());
        assert_eq!(panes.outline(), "(1 [2 3 ))");
        assert_eq!(panes.active(), 3);
        panes.split(3, Edge::Right, ChartPane::default());
        assert_eq!(
            panes.outline(),
            "(1 [2 3 4 ))",
            "one split, not one in another"
        );
        panes.split(1, Edge::Left, ChartPane::default());
        assert_eq!(panes.outline(), "([5 1 )[2 3 4 ))");
        for key in [3, 5, 2, 4] {
            panes.close(key);
            assert_eq!(panes.clone().sound(|_| true), panes);
        }
        assert_eq!(panes.outline(), "1 ");
        assert_eq!(panes.active(), 1);
        assert!(panes.active_chart().is_none());
        panes.close(1);
        assert_eq!(panes.outline(), "1 ", "the workspace stays");
        panes.split(1, Edge::Bottom, ChartPane::default());
        assert_eq!(panes.outline(), "(1 2 )");
    }

    #[test]
    fn shares_are_kept_where_a_pane_is_split_and_given_to_the_neighbours_where_it_is_closed() {
        let mut panes = Panes::default();
        let share = |panes: &Panes, k: usize| panes.root.parts().expect("a split").1[k].share;
        panes.split(2, Edge::Right, ChartPane::default());
        assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
        panes.close(3);
        assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
        // Stacked, the new one has half of what it is split from.
        panes.split(2, Edge::Bottom, ChartPane::default());
        assert_eq!(panes.outline(), "(1 2 3 )");
        assert!((share(&panes, 1) - share(&panes, 2)).abs() < 1e-6);
        assert!((share(&panes, 0) - WORKSPACE).abs() < 1e-6);
    }

    #[test]
    fn a_pane_is_moved_to_any_edge_of_the_middle() {
        for (edge, outline) in [
            (Edge::Left, "[2 1 )"),
            (Edge::Right, "[1 2 )"),
            (Edge::Top, "(2 1 )"),
            (Edge::Bottom, "(1 2 )"),
        ] {
            let mut panes = Panes::default();
            panes.move_to(2, edge);
            assert_eq!(panes.outline(), outline);
            panes.move_to(99, edge);
            assert_eq!(panes.outline(), outline);
        }
        let mut alone = Panes::default();
        alone.close(2);
        alone.move_to(1, Edge::Left);
        assert_eq!(alone.outline(), "1 ");
    }

    #[test]
    fn there_are_never_too_many_charts_and_always_one_workspace() {
        let mut panes = Panes::default();
        for _ in 0..20 {
            panes.split(panes.active(), Edge::Left, ChartPane::default());
        }
        assert_eq!(panes.charts().count(), MOST_CHARTS);
        assert!(!panes.has_room());
        let part = |tile: Tile| SplitShare {
            share: f32::NAN,
            tile,
        };
        let pane = |shows: Content| Tile::Pane(Pane { key: 7, shows });
        let chart = |name: &str| {
            let chart = Some(name.to_owned());
            pane(Content::Chart(ChartPane {
                chart,
                ..ChartPane::default()
            }))
        };
        let read = |tiles: Vec<Tile>| {
            let root = Tile::Beside(tiles.into_iter().map(part).collect());
            let panes = Panes {
                root,
                active: 0,
                chart: 0,
            };
            panes.sound(|name| name != "gone")
        };
        let workspace = || pane(Content::Workspace);
        assert_eq!(read(vec![]), Panes::default());
        assert_eq!(
            read(vec![chart("histogram")]),
            Panes::default(),
            "no workspace"
        );
        let two = read(vec![
            workspace(),
            chart("histogram"),
            chart("gone"),
            workspace(),
        ]);
        assert_eq!(two.charts().count(), 1);
        assert_eq!(keys(&two).len(), 2);
        let (_, parts) = two.root.parts().expect("a split");
        assert!(parts.iter().all(|part| (part.share - 0.5).abs() < 1e-6));
        let mut deep = workspace();
        for k in 0..40 {
            deep = Tile::split(k % 2 == 0, vec![part(deep), part(chart("x"))]);
        }
        assert_eq!(Panes::of(deep), Panes::default());
    }

    #[test]
    fn what_is_kept_comes_back() {
        let mut panes = Panes::default();
        panes.split(1, Edge::Right, ChartPane::default());
        panes.split(3, Edge::Bottom, ChartPane::default());
        if let Some(chart) = panes.chart_mut(3) {
            chart.chart = Some("scatter".to_owned());
            chart.component = Some(Component::Radial);
            chart.axes = Some([Quantity::Order, Quantity::Measured(2)]);
        }
        let text = serde_json::to_string(&panes).expect("it can be written");
        let read: Panes = serde_json::from_str(&text).expect("it can be read");
        let read = read.sound(|_| true);
        let again = serde_json::to_string(&read).expect("it can be written");
        assert_eq!(again, text);
        assert_eq!(read.outline().len(), panes.outline().len());
        assert!(!read.are_usual() && Panes::default().are_usual());
    }

    #[test]
    fn the_next_plot_is_the_next_in_sight_and_after_the_last_the_first() {
        let mut panes = Panes::default();
        panes.split(1, Edge::Right, ChartPane::default());
        let order = keys(&panes);
        panes.activate(order[0]);
        for key in order.iter().cycle().skip(1).take(7) {
            panes.activate_next();
            assert_eq!(panes.active(), *key);
        }
    }
}
